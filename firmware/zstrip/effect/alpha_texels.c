/* Texels with alpha: formats, and fetching of a run.
 *
 * zs_texture_run computes the coordinates of a run and calls the texture's format for it. Here a
 * copy of the texture has a format of its own, whose fetch writes alphas too, and the run goes to a
 * buffer in place of the strip.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/pass.h"
#include "effect/alpha_texels.h"
#include "shade/texels.h"
#include "zs_filter.h"

/* ---- Formats --------------------------------------------------------------------------------- */

/* A texel's colour, RGB565; if `both`, with its alpha, 0 .. 255, in the upper half. A palette that
 * an accelerator has lit has no alphas. */
typedef uint32_t read_fn(const struct zs_texture *t, uint32_t at, int both);

ZS_ALWAYS_INLINE uint32_t read_4444(const struct zs_texture *t, uint32_t at, int both)
{
    (void)both;
    const uint32_t c = ((const uint16_t *)t->texel)[at];
    const uint32_t r = c >> 12, g = c >> 8 & 15u, b = c >> 4 & 15u, a = c & 15u;
    return a * 17u << 16 | (r << 1 | r >> 3) << 11 | (g << 2 | g >> 2) << 5 | (b << 1 | b >> 3);
}

ZS_ALWAYS_INLINE uint32_t colored(const struct zs_texture *t, uint32_t k, int both)
{
    return (both ? (uint32_t)t->palette[t->n_colors + k] << 16 : 0u) | t->palette[k];
}

ZS_ALWAYS_INLINE uint32_t read_pal8a(const struct zs_texture *t, uint32_t at, int both)
{
    return colored(t, ((const uint8_t *)t->texel)[at], both);
}

ZS_ALWAYS_INLINE uint32_t read_pal4a(const struct zs_texture *t, uint32_t at, int both)
{
    const uint32_t two = ((const uint8_t *)t->texel)[at >> 1];
    return colored(t, two >> ((at & 1u) << 2) & 15u, both);
}

ZS_KERNEL_INLINE void fetch(const struct zs_texture *t, uint16_t *out, int32_t n,
                            const struct zs_walk *walk, read_fn *read, int both)
{
    const uint32_t right = zs_texture_cut(t->log2_w), down = zs_texture_cut(t->log2_h);
    uint32_t u = walk->u, v = walk->v;
    for (uint16_t *end = out + n; out != end; out++, u += walk->du, v += walk->dv) {
        const uint32_t c = read(t, ((v >> down) << t->log2_w) + (u >> right), both);
        *out = zs_wire16((uint16_t)c);
        if (both)
            out[ZS_ALPHA_RUN] = (uint16_t)(c >> 16);
    }
}

#if ZS_NO_FAST
#define GATHER(name)
#define GATHERS(name) 0
#else
#define GATHER(name)                                                                               \
    static void gather_##name(const struct zs_texture *t, uint16_t *out, int32_t n,                \
                              const uint32_t *at)                                                  \
    {                                                                                              \
        for (uint16_t *const end = out + n; out != end; out++, at++) {                             \
            const uint32_t c = read_##name(t, *at, 1);                                             \
            *out = zs_wire16((uint16_t)c);                                                         \
            out[ZS_ALPHA_RUN] = (uint16_t)(c >> 16);                                               \
        }                                                                                          \
    }
#define GATHERS(name) gather_##name
#endif

#define FORMAT(name, colors_max_, log2_bits_)                                                      \
    static void fetch_##name(const struct zs_texture *t, uint16_t *out, int32_t n,                 \
                             const struct zs_walk *walk)                                           \
    {                                                                                              \
        fetch(t, out, n, walk, read_##name, 0);                                                    \
    }                                                                                              \
    static void both_##name(const struct zs_texture *t, uint16_t *out, int32_t n,                  \
                            const struct zs_walk *walk)                                            \
    {                                                                                              \
        fetch(t, out, n, walk, read_##name, 1);                                                    \
    }                                                                                              \
    GATHER(name)                                                                                   \
    const struct zs_texel zs_texel_##name = { .fetch = fetch_##name,                               \
                                              .own = fetch_##name,                                 \
                                              .both = both_##name,                                 \
                                              .gather = GATHERS(name),                             \
                                              .colors_max = colors_max_,                           \
                                              .log2_bits = log2_bits_ }

FORMAT(4444, 0, 4);
FORMAT(pal8a, 256, 3);
FORMAT(pal4a, 16, 2);

/* ---- A texture in place of the instance's ---------------------------------------------------- */

/* r->lit has room for a copy of a texture. Shaders with a lit palette there use an accelerator, and
 * those that call this have none; the level that no light has tells the accelerator that the copy
 * is not its own. */
#define NO_LEVEL 65535u

struct zs_texture *zs_texture_instead(struct zs_job *job)
{
    struct zs_lit *lit = &job->r->lit;
    lit->of = zs_instance_of(job->r, job->tri->instance)->material->texture;
    lit->level = NO_LEVEL;
    lit->texture = *lit->of;
    job->sampler.texture = &lit->texture;
    job->gather = 0;
    return &lit->texture;
}

const struct zs_texture *zs_texture_behind(const struct zs_texture *instead)
{
    return ((const struct zs_lit *)(const void *)((const char *)instead -
                                                  offsetof(struct zs_lit, texture)))
        ->of;
}

/* ---- Runs ------------------------------------------------------------------------------------ */

static void fetch_alpha(const struct zs_texture *t, uint16_t *out, int32_t n,
                        const struct zs_walk *walk)
{
    t = zs_texture_behind(t);
    if (t->format->both) {
        t->format->both(t, out, n, walk);
        return;
    }
    t->format->own(t, out, n, walk);
    for (int32_t i = 0; i < n; i++)
        out[ZS_ALPHA_RUN + i] = 255;
}

/* Where texels lie far apart, an accelerator divides for a piece of a run at a time, and gathers:
 * cut-outs and blended textures in perspective take a third less. */
static void gather_alpha(const struct zs_texture *t, uint16_t *out, int32_t n, const uint32_t *at)
{
    t = zs_texture_behind(t);
    t->format->gather(t, out, n, at);
}

static const struct zs_texel with_alpha = { .fetch = fetch_alpha };

void zs_alpha_start(struct zs_job *job)
{
    zs_texture_start(job);
    struct zs_texture *const t = zs_texture_instead(job);
    if (t->format->gather)
        job->gather = ZS_IF_FAST(gather_alpha);
    t->format = &with_alpha;
}

void zs_alpha_fetch(struct zs_job *job, const struct zs_row *row, int32_t r0, int32_t n,
                    uint16_t px[2 * ZS_ALPHA_RUN])
{
    uint16_t *const color = job->color;
    struct zs_row here = *row;
    here.at = -r0;
    job->color = px;
    zs_texture_run(job, &here, r0, r0 + n);
    job->color = color;
}
