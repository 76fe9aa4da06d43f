/* The mesh builder behind gen_meshes: integers only, so that every machine writes the same bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef GEN_H
#define GEN_H

#include <stdint.h>

#define GEN_VERTS_MAX 16384u
#define GEN_TRIS_MAX 32768u
#define GEN_Q30 ((int64_t)1 << 30)

/* Which arrays a mesh is written with, or-ed. */
enum gen_parts {
    GEN_NORMAL = 1,      /* vertex normals, as given to gen_vert_normal */
    GEN_FACE_NORMAL = 2, /* face normals, computed from the integer positions */
    GEN_VERTEX_RGB = 4,
    GEN_FACE_RGB = 8,
    GEN_FACE_RAW = 16    /* face colours as RGB565: lit by gen_bake if that was called */
};

struct gen_rgb {
    uint8_t r, g, b;
};

struct gen_mesh {
    const char *name;
    int64_t pos[GEN_VERTS_MAX][3]; /* steps; must fit int16 when written */
    int16_t normal[GEN_VERTS_MAX][3];
    struct gen_rgb vertex_rgb[GEN_VERTS_MAX];
    uint32_t tri[GEN_TRIS_MAX][3];
    struct gen_rgb face_rgb[GEN_TRIS_MAX], face_raw[GEN_TRIS_MAX];
    uint32_t n_verts, n_tris;
};

/* An empty mesh. The name becomes mesh_NAME. Static storage: one mesh at a time. */
struct gen_mesh *gen_begin(const char *name);

/* Append a vertex or a triangle (counter-clockwise from outside); return its number. */
uint32_t gen_vert(struct gen_mesh *m, int64_t x, int64_t y, int64_t z);
uint32_t gen_vert_normal(struct gen_mesh *m, const int64_t pos[3], const int64_t normal[3],
                         struct gen_rgb rgb);
uint32_t gen_tri(struct gen_mesh *m, uint32_t a, uint32_t b, uint32_t c, struct gen_rgb rgb);

/* Two triangles, a b c and a c d. */
void gen_quad(struct gen_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d,
              struct gen_rgb rgb);

/* face_raw = face_rgb lit from a direction of any length: (ambient + (256 - ambient) cos) / 256. */
void gen_bake(struct gen_mesh *m, const int64_t dir[3], int64_t ambient);

/* Check the mesh, write DIR/mesh_NAME.c and add its line to meshes.h. Ends the program on failure.
 * scale  uq16_16, world units to a step. */
void gen_write(const struct gen_mesh *m, unsigned parts, uint32_t scale);

void gen_open(const char *dir); /* once, before the first mesh; makes meshes.h */
void gen_close(void);           /* once, after the last: ends meshes.h, prints the sum */

/* ---- Arithmetic ---- */

int64_t gen_div(int64_t a, int64_t b); /* nearest, halves away from 0; b > 0 */
int64_t gen_sin(int64_t turn);         /* q30, error < 2^-27; 65536 to the turn, any sign */
int64_t gen_cos(int64_t turn);
uint64_t gen_sqrt(uint64_t v);         /* floor */
uint32_t gen_hash(uint32_t a, uint32_t b, uint32_t seed);
void gen_cross(int64_t out[3], const int64_t a[3], const int64_t b[3]); /* |component| < 2^30 */
void gen_fit(int64_t v[3], int64_t limit);        /* shrink until |component| <= limit */
void gen_unit(int64_t v[3], int64_t one);         /* to this length, rounded; v is not 0 */
struct gen_rgb gen_mix(struct gen_rgb a, struct gen_rgb b, int64_t t, int64_t t_max);
struct gen_rgb gen_hue(int64_t turn); /* bright rainbow, 65536 to the turn */

/* ---- The meshes, one function a file's family ---- */

void gen_teapot(void);  /* teapot, tea, table */
void gen_shapes(void);  /* cube, knot */
void gen_terrain(void); /* terrain */
void gen_city(void);    /* city, car */
void gen_bench(void);   /* bumpy, layer, sheet, corridor, slivers */

#endif
