/* Explanations: what the files explain_*.c share. Internal.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_SUPPORT_EXPLAIN_H
#define ZS_SUPPORT_EXPLAIN_H

#include "core/cull.h"
#include "zs_explain.h"

#define ZS_EXPLAIN_MOST 16u /* sentences */
#define ZS_EXPLAIN_PIECE 48u

struct zs_explainer {
    struct zs_renderer *r;
    const struct zs_scene *scene;
    const struct zs_camera *camera;
    void (*say)(void *ctx, const char *text);
    void *ctx;
    uint32_t said, n; /* sentences; characters in `text` */
    char text[ZS_EXPLAIN_PIECE];
    uint8_t tracked; /* 1: by zs_damage_track */
};

/* What is seen of a scene, or of one of its instances alone. */
struct zs_seen {
    struct zs_stats stats;
    uint32_t colored;  /* pixels that something was drawn on */
    uint32_t visible;  /* of these: not of the background's colour */
    uint32_t sum;      /* a hash of the picture */
    uint8_t brightest; /* 0 .. 31, of all channels of these pixels */
    uint8_t uniform;   /* 1: all pixels of the frame are colored, in one colour */
};

/* Say a sentence. In form, % is the next number, $ the next one as a length, q48_16. */
void zs_explain_say(struct zs_explainer *e, const char *form, const int64_t *number);
#define ZS_SAY(e, ...) ZS_SAY_(e, __VA_ARGS__, 0)
#define ZS_SAY_(e, form, ...) zs_explain_say(e, form, (const int64_t[]){ __VA_ARGS__ })
/* A piece of one: it goes on. */
void zs_explain_piece(struct zs_explainer *e, const char *form, const int64_t *number);
#define ZS_PIECE(e, ...) ZS_PIECE_(e, __VA_ARGS__, 0)
#define ZS_PIECE_(e, form, ...) zs_explain_piece(e, form, (const int64_t[]){ __VA_ARGS__ })

/* Draw the scene, or one of its instances without accelerators, and look at it. light NULL: the
 * scene's. zs_frame_begin must accept the scene. */
void zs_explain_draw(struct zs_explainer *e, const struct zs_instance *one,
                     const struct zs_light *light, struct zs_seen *seen);

/* Say why zs_frame_begin refuses the scene. */
void zs_explain_refused(struct zs_explainer *e);
/* Say why nothing is seen of instance i. Return 1 if something was said, else *seen is what is seen
 * of it. */
int zs_explain_unseen(struct zs_explainer *e, uint32_t i, struct zs_seen *seen);
/* Say what becomes of instance i. Return 1 if nothing is seen of it. *seen: as above. */
int zs_explain_fate(struct zs_explainer *e, uint32_t i, struct zs_seen *seen);
/* Say what is wrong with the numbers of instance i. seen 0: zs_explain_unseen was called for it.
 * room: overwritten. */
void zs_explain_instance_data(struct zs_explainer *e, uint32_t i, int seen, struct zs_seen *room);
/* Say what is wrong with its mesh. */
void zs_explain_mesh(struct zs_explainer *e, uint32_t i);
/* Say what its shape spoils: a hole, parts that cover others. It is drawn, and nothing was said. */
void zs_explain_shape(struct zs_explainer *e, uint32_t i, struct zs_seen *room);
/* Say what is wrong with its texture; mesh, texture: 1 if no instance before has it. */
void zs_explain_texture(struct zs_explainer *e, uint32_t i, int mesh, int texture);
/* Say that the camera's angles were typed as degrees. */
void zs_explain_camera_turned(struct zs_explainer *e);
/* Say what is wrong with the light's fields; all: what is seen of the scene. Return 1 if something
 * was said. */
int zs_explain_light(struct zs_explainer *e, const struct zs_seen *all);
/* Say why the picture is black or dark. */
void zs_explain_dark(struct zs_explainer *e, const struct zs_seen *all);
/* Say that near or far cuts all that is in view. */
void zs_explain_cut(struct zs_explainer *e);
/* Say what is wrong with the order of instances without depth memory, or with near and far. */
void zs_explain_depth(struct zs_explainer *e);
/* Say what is wrong with the resolve hooks. */
void zs_explain_hooks(struct zs_explainer *e);
/* Say what is wrong with the items of hook k, an overlay. */
void zs_explain_items(struct zs_explainer *e, uint32_t k);

/* A sphere's width on the screen, uq_16 px, where it is ahead; below 2^51. */
uint64_t zs_explain_size(const struct zs_explainer *e, const struct zs_bounds *b);

/* Return 1 if the eye is in the sphere. */
int zs_explain_eye_inside(const struct zs_bounds *b);

/* The bounding sphere of an instance that zs_frame_begin accepts. */
static inline void zs_explain_bounds(const struct zs_explainer *e, uint32_t i, struct zs_bounds *b)
{
    (void)zs_cull_bounds(b, e->r, &e->scene->instance[i]);
}

#endif
