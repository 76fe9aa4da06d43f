/* What the counting of costs (costs_count.c) shares: callbacks that look on, what they stand for, and what was counted.
 *
 * Instances are copied, with materials and textures, so that what they name is ours: each of our structs begins with
 * the renderer's, and knows the one that it stands for, and so do accelerators of their shaders and texel formats.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_COSTS_LOOK_H
#define SIM_COSTS_LOOK_H

#include "core/fast.h"
#include "core/method.h"
#include "core/rows.h"
#include "costs.h"
#include "frame.h"
#include "shade/texture.h"
#include "shader_table.h"
#include "zs_blend.h"
#include "zs_lights.h"
#include "zs_pass.h"
#include "zs_shader.h"
#include "zs_shadow.h"

enum kind { KIND_SOLID, KIND_SMOOTH, KIND_TEXTURE };

struct our_shader {
    struct zs_shader shader;
    const struct zs_shader *of;
    enum kind kind;
    enum sim_cost vertex, face;
    const struct zs_shader *like; /* the shader whose stages an effect's are made of; NULL: this is none */
    int shines, blends, adds;     /* flags: it has highlights; it is blended; by addition */
    int lit;    /* flag: its material has lamps */
    int effect; /* flag: what the stages do not know; drawn in the general way, and its work counted */
    int begins; /* flag: how its runs begin is in what its vertices take */
    const struct zs_material *whole; /* a program's own shader's material: it may be longer than what is copied */
    int own;    /* flag: leaves pixels out, and takes as long for them */
    struct sim_effect_work work;
    struct sim_shader_made made; /* what it is made of */
};
struct our_texel {
    struct zs_texel texel;
    const struct zs_texel *of;
    const struct zs_fast_texel *fast_of; /* NULL: the list has none for it */
    enum sim_cost fetch, won;
};
struct our_fast {
    struct zs_fast fast;
    const struct zs_fast *of; /* NULL: the list has none for the shader */
};
struct thing { /* an instance's copies */
    struct our_shader shader;
    struct our_texel texel;
    struct our_fast fast;      /* of the shader ... */
    struct zs_fast texel_fast; /* ... and of the texel format */
    struct zs_fast_texel texel_hooks;
    union { /* as the shader takes it */
        struct zs_material material;
        struct zs_blend blend;
        struct zs_lit_material lit;
        struct zs_shadowed_material shadowed;
        struct zs_shadowed_lit shadowed_lit;
        struct zs_shadowed_phong shadowed_phong;
    } as;
    struct zs_texture texture;
};

struct shape {
    double rows, spans, px;
    int tilted; /* flag: keys differ */
    double edges, divided, divided64; /* edges taken up; of these, where a core without a divider divides; in 64 bits */
};

/* The frame in hand: callbacks that get texels alone know of no other way to it. */
struct sim_now {
    struct zs_depth depth;
    const struct zs_depth *of;
    double *n;
    struct zs_renderer *r;
    uint64_t tested;  /* pixels found here */
    double setups;    /* counted here */
    uint32_t band_end, walks, checksum;
    const struct zs_fast_batch *batch_of; /* what `batch` stands for */
    struct zs_fast_batch batch;
    struct zs_fast batch_fast, divides; /* divides: what the list has for all textured shaders */
    struct binned { /* what it was handed, in the first walk, [0], and in the others */
        double instances, tris, boxed;
        double gathered; /* of tris: of meshes that were not transformed at once */
    } binned[2];
    uint32_t unpacked, band; /* when it met a full pool: vertices not packed yet, the band's end */
    const struct zs_job *job; /* whose run is coloured; NULL: none */
    const struct zs_shader *own; /* its shader, while it has another's stages called */
    uint8_t wide, huge; /* flags, of the triangle that was set up last: how its planes are found */
    uint8_t linear;    /* flag: keys are linear on the screen in this view */
    uint8_t lit;       /* flag: the small triangle in hand is drawn lit */
    uint8_t testing;   /* flag: the piece in hand is tested */
    uint8_t untouched;     /* flag: a triangle of this strip was drawn on untouched pixels */
    uint8_t tiles;     /* flag: triangles are asked what they hide */
    struct shape shape;  /* of the triangle that was set up last */
    zs_piece_fn *piece;  /* what on_piece stands for */
    struct zs_vertex cover[3]; /* the last triangle that hides others */
    double before[SIM_COST_N]; /* counts when the strip in hand began */
    double slowest[2][SIM_CORES]; /* what the slowest strip takes of what is counted while it is drawn: of strips that
                                     begin with a walk over the scene, [1], and of the others */
    double (*strip)[SIM_COUNT_STRIPS]; /* the same of each: sim_counted.strip */
    uint32_t neighbours;               /* strips of one number there */
    uint16_t walked[SIM_COUNT_STRIPS], strips[SIM_COUNT_STRIPS]; /* of them: walks that they began with; how many */
    struct zs_method method; /* ours, where the configuration has another than the depth buffer's ... */
    const struct zs_method *method_of; /* ... and what it stands for; NULL: the depth buffer */
    zs_piece_fn *method_span;          /* what on_method_span stands for */
    const struct zs_tri *method_tri;   /* the triangle whose rows it was handed last, and its last row */
    int32_t method_row;
    uint32_t sorted;                   /* zs_stats.sorted when a list was made last */
    double windows;    /* pixels of windows that were drawn */
    uint32_t walk;     /* number of the walk, and of ... */
    uint32_t instance; /* ... the instance in hand, UINT32_MAX: none */
};
extern struct sim_now sim_now;

static inline struct our_shader *sim_shader_of(const struct zs_shader *shader)
{
    return (struct our_shader *)(uintptr_t)shader;
}

/* A triangle's rows in a strip (costs_shape.c). */
void sim_look_shape(struct shape *s, const struct zs_job *job);

/* ---- Stages (costs_look.c) ---------------------------------------------------------------------- */

/* Callbacks that look on, of a shader, a texel format, and their accelerators; other fields are 0. */
extern const struct zs_shader sim_look_shader;
extern const struct zs_texel sim_look_texel;
extern const struct zs_fast sim_look_fast;
extern const struct zs_fast_texel sim_look_fast_texel;
/* Let sim_now.depth stand for a mapping. */
void sim_look_depth(const struct zs_depth *of);
/* Find the shape of the triangle in hand, and count it as one that is set up the general way. plain: of one colour by
 * an effect; such small ones are in no probe, and count as larger ones. */
void sim_look_setup(const struct zs_job *job, int plain);
/* Call the run function that the job's shader stands for. A shader that is made of others is the job's meanwhile. */
void sim_look_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
static inline void sim_look_as(struct zs_job *job, const struct our_shader *s)
{
    if (s->made.is_made)
        job->shader = s->of;
}
/* Is each triangle of a mesh asked what it hides, in a frame so wide? */
int sim_look_all_asked(uint32_t width, const struct zs_mesh *mesh);

/* ---- Other methods than the depth buffer (costs_method.c) --------------------------------------- */

int sim_look_is(const struct zs_method *method);
int sim_look_is_hiz(void);
/* Put a method that looks on in the place of a configuration's. */
void sim_look_method(struct zs_config *config);
/* What the statistics say that methods did so far. */
void sim_look_count_method(void);

/* ---- Effects (costs_effect.c) ------------------------------------------------------------------- */

/* Draw and count a run of an effect. */
void sim_look_effect_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to);
/* Of a shader that is an effect's: its work is counted. Where texels are fetched in the general way, those are counted
 * as a texture's. */
void sim_look_copy_effect(struct our_shader *s, const struct zs_texture *texture);
/* Count the lamps that reach n pixels of columns [from, to), by some of these columns. */
void sim_look_lamps(const struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to, double n,
                    struct our_shader *s);
/* Have the triangles of a pass's scene highlights on their texture? Of the one that has been set up. */
int sim_look_gloss(const struct zs_job *job, const struct our_shader *s);
/* What effects take: their shaders, and hooks over what is drawn. */
void sim_look_effects(struct sim_counted *out, const struct zs_scene *scene, const struct thing *things);
/* Its hooks and what lies behind it, in a viewport of w x h px. */
void sim_look_around(struct sim_counted *out, const struct zs_pass *pass, const struct sim_frame *frame, int hooks);

/* ---- Copies (costs_copy.c) ---------------------------------------------------------------------- */

/* Copy what an instance names, and have it name the copies. */
void sim_look_copy(struct zs_instance *in, struct thing *t, const struct zs_fast *const *list);
/* Accelerators of the frame, and those of n things; the caller frees the list. */
const struct zs_fast **sim_look_list(const struct zs_fast *const *list, const struct thing *things, size_t n);

#endif
