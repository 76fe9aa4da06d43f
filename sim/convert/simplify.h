/* Fewer triangles.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SIMPLIFY_H
#define SIM_SIMPLIFY_H

#include <stdio.h>

#include "option_table.h"

struct sim_model;

/* A row of a table, into a const char * that is a member of `type`; uses: its flags (option_table.h). */
#define SIM_SIMPLIFY_OPTION(type, member, uses)                                                    \
    {                                                                                              \
        "--simplify", SIM_OPTION_TEXT, offsetof(type, member),                                     \
            .use = uses, .value = "N",                                                             \
            .help = "fewer triangles: N of them, or as few as an error allows, 0.01 or 1% of the " \
                    "model's size. Triangles are "                                                 \
                    "numbered as they are then. Prints how many there were and are"                \
    }

/* Is that a value for --simplify? SIM_OK; SIM_USAGE, said why. NULL is none. */
int sim_simplify_check(const char *text);

/* Fewer triangles for a model whose normals and bounds are there, as text says, which was checked. Borders, and seams
 * of materials, texture coordinates, colours and normals stay. Where normals of single faces leave too many seams,
 * those around a point become one. Points that are left are as they were; bounds are not found again. */
void sim_simplify(struct sim_model *model, const char *text);

/* A line: before and after. Nothing where the model was not simplified. */
void sim_simplify_print(FILE *f, const char *lead, const struct sim_model *model);

#endif
