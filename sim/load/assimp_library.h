/* assimp, loaded where a model is.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_ASSIMP_LIBRARY_H
#define SIM_ASSIMP_LIBRARY_H

/* Before any other call of assimp, as often as one likes. SIM_OK, or SIM_REFUSED with a sentence where it is not
 * there; file: the model that it says it of. assimp stays until the program ends. */
int sim_assimp_open(const char *file);

#endif
