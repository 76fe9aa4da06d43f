/* Whole frames through the public interface, for comparing.
 *
 * Every arena is exactly zs_arena_bytes() long and filled with junk, so that the sanitizer sees a
 * byte too many and nothing can rely on what lay there.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef TESTS_PICTURE_H
#define TESTS_PICTURE_H

#include <stdint.h>

#include "prng.h"
#include "zs_damage.h"
#include "zs_pass.h"
#include "zstrip.h"

struct picture {
    int err;         /* of zs_init or zs_render; the rest is empty then */
    int32_t w, h;
    uint16_t *color; /* [h][w], RGB565 */
    uint16_t *key;   /* [h][w]; 0 where there is no depth memory */
    uint32_t covered; /* pixels whose key is not ZS_DEPTH_CLEAR */
    struct zs_stats stats;
};

/* zs_damage_compare with sums of their own, of which nothing is known: `memory` is as in zs_strip_hashes_init. */
int damage_compare_anew(struct zs_renderer *r, struct zs_strip_hashes *sums, uint64_t *memory, uint32_t columns);

/* Room for everything in one pass, one strip buffer, one strip, all accelerators. */
struct zs_config picture_config(int32_t w, int32_t h, const struct zs_depth *depth);
/* Another way to draw the same frame: strips, buffers, accelerators, and mostly small pools, of at least so many
 * triangles and vertices. */
void picture_any_way(struct prng *p, struct zs_config *c, int32_t tris, int32_t verts);
/* Draw a frame by zs_render. To be freed whatever err is. */
struct picture picture_draw(const struct zs_config *config, const struct zs_scene *scene,
                            const struct zs_camera *camera);
/* The same in passes, by zs_render_passes. */
struct picture picture_passes(const struct zs_config *config, const struct zs_pass *pass, uint32_t n);
void picture_free(struct picture *p);
/* Several: PICTURES_FREE(&a, &b) */
#define PICTURES_FREE(...) pictures_free((struct picture *const[]){ __VA_ARGS__, NULL })
void pictures_free(struct picture *const *p);
/* 1: it was drawn, and covers more than so many pixels. Else say that it does not. */
int picture_shows(const struct picture *p, uint32_t pixels);
/* 1: same size, colours and keys. Else say where they differ first, with a name for the case. */
int picture_same(const struct picture *a, const struct picture *b, const char *name);
/* The same for two pictures that are of no use afterwards: both are freed, their statistics stay. */
int picture_drawn_alike(struct picture *want, struct picture *is, const char *name);
/* ... where it is right, too, that both were refused with the same error. */
int picture_alike(struct picture *want, struct picture *is, const char *name);
/* 1: drawn another way, it is that picture. Else say where they differ first, with a name for the case. */
int picture_again(const struct picture *want, const struct zs_config *config, const struct zs_scene *scene,
                  const struct zs_camera *camera, const char *name);
/* What drawing it ends with; the picture is of no interest. */
int picture_error(const struct zs_config *config, const struct zs_scene *scene, const struct zs_camera *camera);
/* 1: tris_in is tris_drawn and all rejects. */
int stats_add_up(const struct zs_stats *s);

/* One triangle mesh in world units of `scale`, at the origin, seen by a camera there. */
struct lone {
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance instance;
    struct zs_scene scene;
    int16_t pos[9][3];
    uint16_t tri[7][3];
};
/* A configuration for it: small pools. */
struct zs_config lone_config(int32_t w, int32_t h, const struct zs_depth *depth);
/* n <= 9 corners as a fan; raw colours 1 .. n - 2, no culling. pos in the mesh's steps. */
void lone_set(struct lone *l, const int16_t (*pos)[3], int n, zs_uq16_16 scale);

/* A camera at the origin for which one world unit is 1/256 px: at any distance (perspective 0), or
 * at the distance PIXEL_Z. Near is 1, far 2 * PIXEL_Z. */
#define PIXEL_Z 32768
struct zs_camera pixel_camera(int32_t height_px, int perspective);

#endif
