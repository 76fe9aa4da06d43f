/* Files of C that gen_meshes writes: what meshes and textures share.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef OUT_H
#define OUT_H

#include <stdint.h>
#include <stdio.h>

#include "gen.h"

/* One line to stderr that names `name`; ends the program. */
_Noreturn void out_die(const char *what, const char *name);

/* DIR/meshes.c, where the mesh or texture `name` begins: its arrays are called NAME_pos and so on. One
 * file for all: a compiler starts once, not 72 times for each core. */
FILE *out_begin(const char *name);

/* An array of a file, filled up to 100 columns a line. */
struct out_rows {
    FILE *f;
    int column;
};

/* static const TYPE MESH_NAME[n]INNER = { ... }; */
struct out_rows out_array(FILE *f, const char *type, const char *name, uint32_t n,
                          const char *inner);
void out_row(struct out_rows *r, const char *text); /* with its comma */
void out_row2(struct out_rows *r, int64_t a, int64_t b);
void out_row3(struct out_rows *r, int64_t a, int64_t b, int64_t c);
void out_array_end(const struct out_rows *r);
void out_field(FILE *f, const char *name); /* .NAME = MESH_NAME, */

/* A line of meshes.h and one of the list: what there is, and how large. */
void out_declare(const char *type, const char *prefix, const char *name, const char *size,
                 uint32_t bytes);

/* As zs_rgb565. */
uint16_t out_rgb565(struct gen_rgb c);

#endif
