/* A file's bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_INPUT_FILE_H
#define SIM_INPUT_FILE_H

#include <stddef.h>
#include <stdint.h>

/* All of a regular file, malloc'ed, with a 0 behind its *n bytes. SIM_OK; SIM_REFUSED, said why, *bytes NULL. */
int sim_file_read(const char *name, uint8_t **bytes, size_t *n);

#endif
