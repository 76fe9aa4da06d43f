/* Textures on an RP2040: rows of affine triangles, lit or not, in one loop, with the address of the
 * texel, light and key in the interpolators. A lit pixel takes 48 cycles, an unlit one 22: 1.2 of
 * 12.1 million cycles in scene china, 1.5 of 11.3 in globe. Small triangles go through all stages
 * in one function, which keeps what is the same for an instance: 0.45 of 8.57 in china. 3,130
 * bytes.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fast.h"
#include "core/fx.h"
#include "fast/lanes.h"
#include "fast/set_up_parts.h"
#include "shade/stages.h"
#include "shade/texels.h"
#include "shade/texture.h"

/* Lanes: column and row of the texel, whose sum is its address; light, uq1_10, and above it the
 * key. */
#if ZS_RP2040

/* Test the pixel. To r3: where its texel is; to r7: the light. */
#define TEST                                                                                       \
    ZS_LANES_POP_1(r7)                                                                             \
    ZS_LANES_POP_0(r3)                                                                             \
    "lsrs r2, r7, #16\n\tldrh r6, [r4, r5]\n\tcmp r2, r6\n\tbcs 4f\n\tstrh r2, [r4, r5]\n\t"
#define STORE "mov r6, r9\n\tadd r6, r4\n\trev16 r3, r3\n\tstrh r3, [r6, r5]\n"

/* Fetch the texel to r3. */
#define FETCH_565 "ldrh r3, [r3]\n\t"
#define FETCH_PAL8 "ldrb r3, [r3]\n\tldr r6, [sp, #20]\n\tlsls r3, #1\n\tldrh r3, [r6, r3]\n\t"

/* zs_texture_shine: r3 by the light in r7. Channels times light to r1: red above blue; r3: green.
 */
#define SHINE                                                                                      \
    "mov r6, r1\n\tuxth r7, r7\n\t"                                                                \
    "lsrs r1, r3, #11\n\tlsls r1, #16\n\tlsls r2, r3, #27\n\tlsrs r2, #27\n\tadds r1, r2\n\t"      \
    "lsls r3, #21\n\tlsrs r3, #26\n\tmuls r1, r7\n\tmuls r3, r7\n\t"                               \
    "movs r2, #1\n\tlsls r2, #9\n\tadds r3, r2\n\tadds r1, r2\n\tlsls r2, #16\n\tadds r1, r2\n\t"  \
    "subs r7, #1\n\tlsrs r7, #10\n\tbne 6f\n\t" /* 0, or more than 1 */                            \
    "lsrs r3, #10\n\tlsls r3, #5\n\tlsrs r2, r1, #26\n\tlsls r1, #16\n\tlsrs r1, #26\n"            \
    "7:\n\t"                                                                                       \
    "orrs r3, r1\n\tlsls r2, #11\n\torrs r3, r2\n\tmov r1, r6\n\t"
#define HELD                                                                                       \
    "6:\n\tlsrs r3, #10\n\tcmp r3, #63\n\tbls 8f\n\tmovs r3, #63\n8:\n\tlsls r3, #5\n\t"           \
    "lsrs r2, r1, #26\n\tcmp r2, #31\n\tbls 8f\n\tmovs r2, #31\n8:\n\t"                            \
    "lsls r1, #16\n\tlsrs r1, #26\n\tcmp r1, #31\n\tbls 7b\n\tmovs r1, #31\n\tb 7b"

ZS_LANES_ROWS(rows_565, TEST FETCH_565 STORE, "")
ZS_LANES_ROWS(rows_pal8, TEST FETCH_PAL8 STORE, "")
ZS_LANES_ROWS(lit_565, TEST FETCH_565 SHINE STORE, HELD)
ZS_LANES_ROWS(lit_pal8, TEST FETCH_PAL8 SHINE STORE, HELD)

#else

ZS_ALWAYS_INLINE int pixel(struct zs_lanes *lanes, const struct zs_lanes_set *w, uint16_t *depth,
                           uint16_t *color, zs_read_fn *read, int lit)
{
    const uint32_t key = zs_lanes_pop(&lanes[1]), at = zs_lanes_pop(&lanes[0]);
    if (key >> 16 >= *depth)
        return 0;
    *depth = (uint16_t)(key >> 16);
    const uint32_t c = read(w->texel, w->palette, read == zs_read_565 ? at >> 1 : at);
    *color = zs_wire16((uint16_t)(lit ? zs_texture_shine(c, key & 0xffffu) : c));
    return 1;
}

#define PIXEL(name, read, lit)                                                                     \
    static int name(struct zs_lanes *lanes, const struct zs_lanes_set *w, uint16_t *depth,         \
                    uint16_t *color)                                                               \
    {                                                                                              \
        return pixel(lanes, w, depth, color, read, lit);                                           \
    }
PIXEL(pixel_565, zs_read_565, 0)
PIXEL(pixel_pal8, zs_read_pal8, 0)
PIXEL(pixel_lit_565, zs_read_565, 1)
PIXEL(pixel_lit_pal8, zs_read_pal8, 1)
ZS_LANES_ROWS(rows_565, pixel_565, "")
ZS_LANES_ROWS(rows_pal8, pixel_pal8, "")
ZS_LANES_ROWS(lit_565, pixel_lit_565, "")
ZS_LANES_ROWS(lit_pal8, pixel_lit_pal8, "")

#endif

/* The light of a job, uq1_31, with half of 2^-10 added. */
static struct zs_plane light_of(const struct zs_job *job)
{
    struct zs_plane p = { 0, 0, 0 };
    if (job->shader->n_varyings == 3) {
        p = job->c[2];
        p.base *= 2u;
        p.gx *= 2u;
        p.gy *= 2u;
    } else if (!job->sampler.unlit) {
        p.base = (uint32_t)job->tri->paint << 16;
    }
    p.base += ZS_TEXTURE_LIGHT_HALF;
    return p;
}

static struct zs_lanes_set set_of(const struct zs_texture *t)
{
    const uint32_t log2_w = t->log2_w, log2_h = t->log2_h, two = t->format->log2_bits == 4;
    const struct zs_lanes_set set = {
        { ZS_LANES_FIELD(32u - two - log2_w, two, two + log2_w - 1u),
          ZS_LANES_FIELD(32u - two - log2_w - log2_h, two + log2_w, two + log2_w + log2_h - 1u),
          ZS_LANES_FIELD(ZS_TEXTURE_LIGHT_SHIFT, 0u, 10u), ZS_LANES_FIELD(0u, 16u, 31u) },
        ZS_RP2040 ? (uint32_t)(uintptr_t)t->texel : 0u, t->palette, t->texel
    };
    return set;
}

int zs_lanes_texture_rows(struct zs_job *job)
{
    const struct zs_texture *t = job->sampler.texture;
    const int two = t->format->log2_bits == 4;
    const struct zs_plane light = light_of(job);
    const struct zs_lanes_set set = set_of(t);
    if (t->format->log2_bits < 3)
        return 0;
    if (job->sampler.unlit)
        zs_lanes_draw(job, &set, &light, two ? rows_565 : rows_pal8);
    else
        zs_lanes_draw(job, &set, &light, two ? lit_565 : lit_pal8);
    return 1;
}

#if ZS_LANES_USED && ZS_SET_UP

/* Set job->kept for the instance of job->tri. Return 0 if it is not for zs_lanes_texture_draw. */
static ZS_NOINLINE __attribute__((used)) int ready(struct zs_job *job)
{
    const struct zs_texture *t = job->texture;
    struct zs_kept *k = &job->kept;
    if (k->of == job->tri->instance)
        return 1;
    if (!job->texel || t->clamp || !t->log2_w || !t->log2_h || t->format->log2_bits < 3)
        return 0;
    zs_texture_set_of(job, &k->set);
    k->lanes = set_of(t);
    k->of = job->tri->instance;
    return 1;
}

/* Set the light and the palette of a triangle whose planes are set. Return what draws its rows. */
static __attribute__((used)) zs_lanes_fn *begun(struct zs_job *job)
{
    const struct zs_shader *shader = job->shader;
    const struct zs_texture *t = job->texture;
    struct zs_kept *k = &job->kept;
    const int two = t->format->log2_bits == 4;
    job->sampler.unlit = !shader->light ||
                         (!k->set.lit && job->tri->paint == ZS_TEXTURE_FULL_LIGHT);
    if (!job->sampler.unlit && job->fast->lit)
        t = job->fast->lit(job, t);
    k->lanes.palette = t->palette;
    k->light = light_of(job);
    return job->sampler.unlit ? (two ? rows_565 : rows_pal8) : (two ? lit_565 : lit_pal8);
}

static __attribute__((used)) void go_on(struct zs_job *job)
{
    zs_lanes_go_on(job, &job->kept.lanes, &job->kept.light, begun(job));
}

/* A triangle whose coordinates are not as zs_set_up_texture has them. */
static __attribute__((used)) void otherwise(struct zs_job *job)
{
    zs_texture_start(job);
    (void)job->rows(job);
}

/* Stages of a small triangle one after the other, with all registers saved once. */
ZS_NAKED int zs_lanes_texture_draw(struct zs_job *job __attribute__((unused)))
{
    __asm__ volatile(
        ".syntax unified\n\t" ZS_SAVED
        "push {r0, r1, r2}\n\tbl ready\n\tcmp r0, #0\n\tbeq 4f\n"
        "9:\n\tldr r0, [sp]\n\tbl zs_set_up_rows_part\n\tcmp r0, %[rows]\n\tbcc 11f\n\tbhi 2f\n\t"
        "str r3, [sp, #4]\n\tstr r4, [sp, #8]\n\tldr r0, [sp]\n\tldr r1, 9f\n\tadds r1, r0\n\t"
        "bl zs_set_up_texture_part\n\tcmp r0, #0\n\tbeq 6f\n\t"
        "ldr r0, [sp]\n\tbl begun\n\tmovs r7, r0\n\tldr r0, [sp]\n\tldr r1, 9f + 4\n\t"
        "adds r1, r0\n\tldr r2, 9f + 8\n\tadds r2, r0\n\tldr r3, [sp, #4]\n\tldr r4, [sp, #8]\n\t"
        "blx r7\n\tb 3f\n"
        "2:\n\tmovs r0, #0\n"
        ZS_DRAWN("9f + 12", "9f + 16", "12")
        ZS_OTHERWISE("9f + 12")
        ".align 2\n9:\n\t.word %c[set], %c[lanes], %c[light], %c[stats], %c[chain]\n"
        :
        : ZS_CHAIN_OF, ZS_DRAWN_OF, [chain] "i"(AT(chain)), [rows] "i"(ZS_SET_UP_ROWS),
          [end] "i"(AT(cut_end)), [row_end] "i"(AT(row_end)),
          [r] "i"(AT(r)), [set] "i"(AT(kept.set)), [lanes] "i"(AT(kept.lanes)),
          [light] "i"(AT(kept.light)));
}

#endif
