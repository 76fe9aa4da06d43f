/* fast/fast_texture.c: set-up. Its rows are as fast_solid.c's (small_proof.c), and what they draw is compared with the
 * stages' by tests/unit/test_texture.c.
 *
 * SPDX-License-Identifier: MIT
 */
#undef ZS_STATS
#define ZS_STATS 0
#include "prove.h"

#define zs_recip_inline recip_in_line /* fx.c, which is here for its tables, has one too */
/* As zs_recip (prove.h). */
/*@ assigns \result \from a;
    ensures bound: 0x80000000 <= \result; */
static inline uint32_t zs_recip_inline(uint32_t a);
#include "../../lib/internals.h"

/* Proved by quotients (plane_proof.c). */
/*@ requires 2 <= lz <= 18 && (least_shift == 2 || least_shift == 5);
    requires -0x400000000000 <= n <= 0x400000000000;
    assigns \result \from n, rcp, lz, least_shift;
    ensures bound: \result == -2147483648 || -1073741824 <= \result <= 1073741824;
    ensures key: least_shift == 5 ==> (\result == -2147483648 || -134217728 <= \result <= 134217728); */
int32_t zs_plane_quotient(int64_t n, uint32_t rcp, int32_t lz, int32_t least_shift);
/* Proved by palettes below. */
/*@ requires job->sampler.unlit == 0;
    assigns \result \from t, job;
    assigns job->sampler.unlit, job->r->lit \from *t, job->r->lit;
    ensures either: \result == t || \result == &job->r->lit.texture;
    ensures unlit: job->sampler.unlit == 0 || job->sampler.unlit == 1; */
static ZS_NOINLINE const struct zs_texture *palette_lit(struct zs_job *job, const struct zs_texture *t);
#include "fast/fast_texture.c"

#include "any_tiny.h"
static uint16_t attr[3 * 3];
static struct zs_texture texture;
static struct zs_mesh mesh;
static struct zs_shader shader;
static struct zs_material material;
static struct zs_instance instance;
static struct zs_scene scene;

/* What rows are given, as small_rows (small_proof.c). */
static void rows_of(struct zs_job *j, const struct zs_texture *t, struct zs_texel_rows *w)
{
    (void)j;
    (void)t;
    //@ assert spans: w->sides.side[0] < 0x400000 && w->sides.side[2] < 0x400000;
    //@ assert rows: w->sides.row < w->sides.end <= w->sides.row + 65;
    //@ assert middle: w->sides.row <= w->sides.mid <= w->sides.row + 65;
    //@ assert shifts: 22 <= w->column <= 31 && 22 <= w->row <= 31;
}

static void any_textured(int32_t x, int32_t y, int32_t from, uint32_t uv_bits)
{
    static const struct zs_texel format = { 0 };
    static const struct zs_fast_texel texel = { .small = rows_of, .small_lit = rows_of };
    any_tiny(x, y);
    for (int c = 0; c < 2; c++)
        for (int k = 0; k < 3; k++) /* differences below 2^14: others are turned away, a relation of three */
            attr[3 * k + c] = (uint16_t)any_u32(0, (1u << 14) - 1u);
    for (int k = 0; k < 3; k++)
        attr[3 * k + 2] = (uint16_t)any_u32(0, 65535);
    tri.paint = (uint16_t)any_u32(0, 65535);
    renderer.attr = attr;
    renderer.config.varyings = 3;
    renderer.vert = pool;
    renderer.view.piece_base = any_u32(0x00ffffffu, UINT32_MAX);
    renderer.view.piece_shift = (uint8_t)any_u32(19, 31);
    renderer.view.key_known = any_u32(0, UINT32_MAX);
    renderer.view.key_slow = any_u32(0, UINT32_MAX);
    renderer.stats.tris_setup = 0;
    texture.format = &format;
    texture.log2_w = (uint8_t)any_u32(0, ZS_TEXTURE_LOG2_MAX);
    texture.log2_h = (uint8_t)any_u32(0, ZS_TEXTURE_LOG2_MAX);
    texture.clamp = (uint8_t)any_u32(0, 3);
    mesh.uv_bits = (uint8_t)uv_bits;
    shader.n_varyings = (uint8_t)any_u32(2, 3);
    material.shader = &shader;
    material.texture = &texture;
    job.texture = &texture;
    instance.mesh = &mesh;
    instance.material = &material;
    scene.instance = &instance;
    scene.n_instances = 1;
    renderer.scene = &scene;
    job.shader = &shader;
    job.texel = &texel;
    job.r = &renderer;
    job.tri = &tri;
    job.width = job.pitch = any_i32(1, ZS_SIZE_MAX);
    job.y0 = zs_first_sample(y) + from;
    job.y1 = job.y0 + any_i32(1, ZS_SIZE_MAX);
    if (any_u32(0, 1))
        (void)draw_unlit(&job);
    else
        (void)draw_lit(&job);
}

/* PROVE small_textures -eva-split-return-function=zs_small_look:0:1,zs_small_place:0:1:2,zs_small_keys:0:1
 * -eva-use-spec=recip_in_line,zs_plane_quotient,palette_lit: every triangle of up to 2^14 sub-pixels each way,
 * coordinates that differ by less than 2^14, every uv_bits, any texture, keys and pieces of 2^19 .. 2^31, its top
 * corner at both ends of its range and at 0, there on a sample and a sub-pixel beside it, strips from above it, from
 * its first rows, middle ones and last */
void small_textures(void)
{
    static const int32_t at[3] = { COORD_LO + 1, 0, COORD_HI - 1 - 255 }, part[3] = { 0, 128, 129 };
    static const int32_t from[5] = { -1, 0, 1, 31, 64 };
    for (int i = 0; i < 9; i++)
        for (int k = 0; k < 5; k++)
            for (uint32_t uv_bits = 0; uv_bits <= 15; uv_bits++)
                any_textured(at[i / 3] + part[i % 3], at[i / 3] + part[i % 3], from[k], uv_bits);
}

static uint16_t colors[ZS_LIT_COLORS], *lit_at;

static void a_light(uint16_t *out, int32_t n, uint32_t level, uint32_t step)
{
    (void)level;
    ASSERT(out == lit_at && n <= ZS_LIT_COLORS && step == 0);
    for (int32_t k = 0; k < n; k++)
        out[k] = (uint16_t)any_u32(0, 65535);
}

/* PROVE palettes -eva-min-loop-unroll=70: palettes of 1 .. 64 colours, any, and larger ones, formats without: one is
 * lit where it has up to 64 colours, once for the same light; nothing beyond them is read or written */
void palettes(void)
{
    static struct zs_texel format;
    lit_at = renderer.lit.color;
    shader.light = a_light;
    shader.n_varyings = 2;
    job.shader = &shader;
    job.r = &renderer;
    job.tri = &tri;
    texture.format = &format;
    texture.palette = colors;
    for (int k = 0; k < ZS_LIT_COLORS; k++)
        colors[k] = (uint16_t)any_u32(0, 65535);
    for (int n = 0; n <= ZS_LIT_COLORS + 1; n++) {
        format.colors_max = n ? 256 : 0;
        texture.n_colors = (uint16_t)n;
        tri.paint = (uint16_t)any_u32(0, 65535);
        renderer.lit.of = 0;
        const int takes = n > 0 && n <= ZS_LIT_COLORS;
        for (int twice = 0; twice < 2; twice++) {
            job.sampler.unlit = 0;
            const struct zs_texture *const t = palette_lit(&job, &texture);
            ASSERT(t == (takes ? &renderer.lit.texture : &texture));
            ASSERT(job.sampler.unlit == takes);
            ASSERT(!takes || t->palette == renderer.lit.color);
        }
    }
}
