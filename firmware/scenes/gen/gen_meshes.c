/* gen_meshes OUTDIR: write every mesh and texture of the scenes as C, OUTDIR/meshes.c and
 * OUTDIR/meshes.h.
 *
 * OUTDIR must exist. Integers only: the files are the same bytes on every machine. They are built,
 * never committed.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: gen_meshes OUTDIR\n", stderr);
        return 2;
    }
    gen_open(argv[1]);
    gen_teapot();
    gen_shapes();
    gen_terrain();
    gen_city();
    gen_bench();
    gen_globe();
    gen_hall();
    gen_hall_textures();
    gen_stilllife();
    gen_cockpit();
    gen_forest();
    gen_close();
    return 0;
}
