/* The builder of meshes and textures behind gen_meshes: integers only, so that every machine writes
 * the same bytes.
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
    GEN_FACE_RAW = 16, /* face colours as RGB565: lit by gen_bake if that was called */
    GEN_UV = 32,       /* texture coordinates, as given to gen_uv */
    GEN_CLUSTERS = 64  /* of triangles as they come: where parts of a mesh are out of view, as of land that is flown
                          over (12 % of flyover's instructions); what is seen whole takes up to 0.6 % more, and 2 % of
                          flash */
};

struct gen_rgb {
    uint8_t r, g, b;
};

struct gen_mesh {
    const char *name;
    int64_t pos[GEN_VERTS_MAX][3]; /* steps; must fit int16 when written */
    int16_t normal[GEN_VERTS_MAX][3];
    int64_t uv[GEN_VERTS_MAX][2]; /* 2^-uv_bits of a texture's size */
    struct gen_rgb vertex_rgb[GEN_VERTS_MAX];
    uint32_t tri[GEN_TRIS_MAX][3];
    struct gen_rgb face_rgb[GEN_TRIS_MAX], face_raw[GEN_TRIS_MAX];
    uint32_t n_verts, n_tris;
    uint32_t uv_bits; /* 0 .. 15; the caller sets it */
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

/* Texture coordinates of a vertex: u to the right, v down, int16 of 2^-uv_bits each. */
void gen_uv(struct gen_mesh *m, uint32_t vertex, int64_t u, int64_t v);

/* A rectangle with vertices, a normal and coordinates of its own: from its top left corner to the
 * right and down, as seen from its front. uv: at that corner, and at the one across. */
void gen_panel(struct gen_mesh *m, const int64_t corner[3], const int64_t right[3],
               const int64_t down[3], const int64_t uv[2][2]);

/* A side of a cube about the origin, for gen_panel: its first corner, and its edges from there. side: the directions
 * right and down, -1, 0 or 1 each, as seen from outside, or from within. half: of an edge. */
void gen_box_side(int64_t corner[3], int64_t right[3], int64_t down[3], const int8_t side[2][3], int64_t half,
                  int from_outside);

/* Vertex normals from the triangles around each place, weighted by area: vertices at one place get
 * one normal, so that the seams of textures do not show in the light. After the last triangle. */
void gen_smooth(struct gen_mesh *m);

/* face_raw = face_rgb lit from a direction of any length: (ambient + (256 - ambient) cos) / 256. */
void gen_bake(struct gen_mesh *m, const int64_t dir[3], int64_t ambient);

/* Check the mesh, write it to DIR/meshes.c and add its line to meshes.h. Ends the program on failure.
 * scale  uq16_16, world units to a step. */
void gen_write(const struct gen_mesh *m, unsigned parts, uint32_t scale);

/* ---- Textures ---- */

#define GEN_IMAGE_MAX 256 /* texels each way */

enum gen_format { GEN_565, GEN_PAL8, GEN_PAL4, GEN_PAL8A };
enum gen_clamp { GEN_REPEAT = 0, GEN_CLAMP = 3 }; /* both ways: enum zs_clamp */

struct gen_image {
    const char *name;
    int64_t w, h;            /* texels, powers of two */
    uint32_t n_levels;       /* of mipmaps, of GEN_565; 0: none */
    struct gen_rgb px[GEN_IMAGE_MAX][GEN_IMAGE_MAX]; /* [row from the top][column] */
    uint8_t alpha[GEN_IMAGE_MAX][GEN_IMAGE_MAX]; /* of GEN_PAL8A; 0 at first */
};

/* A black image of a power of two each way. The name becomes texture_NAME. Static storage: one
 * image at a time. */
struct gen_image *gen_image(const char *name, int64_t w, int64_t h);

/* What leaves the image comes back at its other side, so that what is drawn can be repeated. */
void gen_dot(struct gen_image *im, int64_t x, int64_t y, struct gen_rgb rgb);
void gen_box(struct gen_image *im, int64_t x, int64_t y, int64_t w, int64_t h, struct gen_rgb rgb);
/* Every texel, by what is at its place. */
void gen_paint(struct gen_image *im, struct gen_rgb (*at)(int64_t x, int64_t y));
/* Capitals, digits and what font.c has besides: 5 x 7 dots in cells of 6, each dot wide x high
 * texels. x, y: the top left of the first. */
void gen_text(struct gen_image *im, int64_t x, int64_t y, int64_t wide, int64_t high,
              const char *text, struct gen_rgb rgb);

/* Check the image, write it to DIR/meshes.c and add its line to meshes.h. Ends the program on
 * failure: a palette takes 256 or 16 colours after rounding to RGB565. */
void gen_texture(const struct gen_image *im, enum gen_format format, enum gen_clamp clamp);

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
/* Smooth noise of a cubic lattice, and the sum of so many octaves of it, each twice as fine and
 * half as strong: 0 .. 65535. at in 2^-16 of a cell, >= 0; repeats after `cells` (of the first). */
int64_t gen_noise(const int64_t at[3], int64_t cells, uint32_t seed);
int64_t gen_fractal(const int64_t at[3], int64_t cells, int octaves, uint32_t seed);

/* ---- Meshes and textures, one function a file ---- */

void gen_teapot(void);  /* teapot, tea, table, texture glaze */
void gen_shapes(void);  /* cube, knot */
void gen_terrain(void); /* terrain, and terrain_low, of a quarter of its triangles */
void gen_city(void);    /* city, car */
void gen_bench(void);   /* bumpy, bumpy_uv, layer, sheet, corridor, slivers, plain, texture map */
void gen_globe(void);   /* globe, sky, textures earth, moon, stars */
void gen_hall(void);    /* hall_floor, _ceiling, _walls, _columns, poster, sign, crate */
void gen_hall_textures(void); /* tiles, planks, bricks, marble, crate, poster, sign */
void gen_cockpit(void);       /* cockpit_panel, _bow, _fin, texture cloud */
void gen_forest(void);        /* forest_..., textures of it */
void gen_stilllife(void); /* still_...: fruit, vase, bowl, glass, mirror, table; texture still_wood */

#endif
