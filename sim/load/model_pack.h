/* A model as one block of bytes, from the process that loads it to the one that uses it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_MODEL_PACK_H
#define SIM_MODEL_PACK_H

#include <stdio.h>

#include "model.h"

/* Write it; errors show in ferror(f). */
void sim_model_pack(FILE *f, const struct sim_model *model);

/* Read what was written by the same program. What it says is not trusted: lengths are held against the bytes that there
 * are before there is memory for them, and all that other parts of the program rely on is checked (model.h).
 * file    becomes model->file, borrowed.
 * want    what was asked for.
 * Return  SIM_OK; SIM_REFUSED, nothing said, *model empty. sim_model_free in either case. */
int sim_model_unpack(struct sim_model *model, const void *block, size_t bytes, const char *file,
                     const struct sim_want *want);

#endif
