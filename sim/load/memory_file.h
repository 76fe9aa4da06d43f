/* A text in memory, as a file for assimp.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MEMORY_FILE_H
#define SIM_MEMORY_FILE_H

#include <assimp/cfileio.h>

/* Open a text for reading. own: NULL, or what is freed when the file is closed; text stays where it is until then. */
struct aiFile *sim_memory_file(const char *text, size_t bytes, char *own);
void sim_memory_file_close(struct aiFile *file);

#endif
