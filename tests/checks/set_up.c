/* What fast/set_up.c has in assembler against the core's functions, on an emulated board. Ends with
 * status 0 where all is right.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "core/depth.h"
#include "core/job.h"
#include "core/plane.h"
#include "fast/set_up.h"
#include "hal.h"
#include "shade/stages.h"
#include "triangles.h"
#include "zs_fast.h"
#include "zs_renderer.h"
#include "zs_shader.h"

#define TRIANGLES 200000u

/* The core's way, as core/raster.c has it. Sets *tri_end alone if there are no rows. */
static enum zs_set_up by_core(struct zs_job *job)
{
    const struct zs_vertex *pool = job->r->vert;
    const uint16_t *v = job->tri->v;
    const struct zs_vertex *a = &pool[v[0]], *b = &pool[v[1]], *c = &pool[v[2]];
    const int32_t b_row = zs_first_sample(b->y), c_row = zs_first_sample(c->y);
    job->row = zs_max32(zs_first_sample(a->y), job->y0);
    job->row_mid = zs_min32(b_row, c_row);
    job->tri_end = zs_max32(b_row, c_row);
    job->row_end = zs_min32(job->tri_end, job->y1);
    if (job->row >= job->row_end)
        return ZS_SET_UP_NONE;
    job->cut_end = zs_min32(job->row_end, job->row + ZS_CUT_ROWS);
    zs_plane_sides(job, a, b, c);
    if (job->geom.area <= 0)
        return ZS_SET_UP_NOT;
    zs_plane_geom(job);
    job->saturates = zs_maxu32(zs_maxu32(a->d, b->d), c->d) >= job->key_limit;
    zs_plane32(&job->geom, a->d, b->d, c->d, ZS_PLANE_KEY, &job->key);
    job->key.base += 0x8000u;
    return ZS_SET_UP_ROWS;
}

static int same(const struct zs_job *a, const struct zs_job *b)
{
    return !memcmp(&a->row, &b->row, sizeof(a->row) * 5) &&
           !memcmp(&a->key, &b->key, sizeof(a->key)) &&
           !memcmp(a->v, b->v, sizeof(a->v)) && !memcmp(&a->geom, &b->geom, sizeof(a->geom)) &&
           a->mid_right == b->mid_right && a->saturates == b->saturates;
}

/* Three colours that differ by up to 2^most, or less, in three channels. */
static void random_colors(uint16_t *attr, uint32_t n, uint32_t most)
{
    for (uint32_t k = 0; k < 3u; k++) {
        const uint16_t first = (uint16_t)next();
        for (uint32_t v = 0; v < 3u; v++)
            attr[n * v + k] = (uint16_t)(first ^ next() >> (32u - most));
    }
}

/* Compare the colours' planes of a job that is set up. Return 1 if they are the same; *n: of how many. */
static int same_colors(struct zs_job *fast, struct zs_job *core, uint32_t *n)
{
    *core = *fast;
    if (!zs_set_up_smooth(fast))
        return !memcmp(fast->c, core->c, sizeof(fast->c)) && fast->sub_log2 == core->sub_log2;
    zs_smooth_start(core);
    ++*n;
    return !memcmp(fast->c, core->c, sizeof(fast->c)) && fast->sub_log2 == core->sub_log2;
}

/* The same for a texture, of a random size and a random unit of coordinates. */
static int same_texture(struct zs_job *fast, struct zs_job *core, uint32_t *n)
{
    static struct zs_texture texture = { .format = &zs_texel_565 };
    static struct zs_mesh mesh;
    static struct zs_material material = { .texture = &texture };
    static const struct zs_instance instance = { .mesh = &mesh, .material = &material };
    static const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    static const struct zs_fast *const by[2] = { &zs_fast_texture, &zs_fast_texture_smooth };
    const struct zs_fast *const of = by[next() % 2u];
    texture.log2_w = (uint8_t)(next() % 11u);
    texture.log2_h = (uint8_t)(next() % 11u);
    mesh.uv_bits = (uint8_t)(next() % 16u);
    material.shader = of->shader;
    fast->r->scene = &scene;
    fast->shader = of->shader;
    fast->texture = &texture;
    fast->fast = of;
    memset(&fast->sampler, 0, sizeof(fast->sampler));
    *core = *fast;
    zs_texture_start(core);
    if (!of->start(fast))
        return 1;
    ++*n;
    return !memcmp(fast->c, core->c, sizeof(fast->c[0]) * of->shader->n_varyings) &&
           fast->sub_log2 == core->sub_log2 && fast->sampler.texture == core->sampler.texture &&
           fast->sampler.direct == core->sampler.direct && fast->sampler.wide == core->sampler.wide &&
           fast->sampler.unlit == core->sampler.unlit;
}

int main(void)
{
    static struct zs_renderer r;
    static struct zs_vertex pool[3];
    static struct zs_job fast, core;
    static struct zs_tri tri = { .v = { 0, 1, 2 } };
    static uint16_t attr[3 * ZS_VARYINGS_MAX];
    uint32_t n[3] = { 0, 0, 0 }, colored = 0, textured = 0, wrong = 0;
    if (hal_init())
        hal_exit(2);
    r.vert = pool;
    r.attr = attr;
    r.view.depth = &zs_depth_float; /* as its set-up leaves e3m13 */
    r.view.perspective = 1;
    r.view.key_top = 0xffff0000u;
    r.view.key_fraction = 29;
    r.view.key_octaves = 7;
    r.view.key_slow = (1u << 29) - 1u;
    r.view.key_known = 0xffffffffu - (2u << 29);
    for (uint32_t t = 0; t < TRIANGLES && !wrong; t++) {
        random_triangle(pool, within(80000), within(80000), 256 << next() % 7u, next(), 1u + next() % 31u);
        memset(&fast, 0xa5, sizeof(fast));
        fast.r = &r;
        fast.tri = &tri;
        fast.y0 = (pool[0].y >> ZS_SUBPX_BITS) + within(80);
        fast.y1 = fast.y0 + 60;
        fast.key_limit = 0xfffe0000u;
        fast.piece_shift = 29;
        fast.key_slow = r.view.key_slow;
        fast.key_known = r.view.key_known;
        r.config.varyings = (uint8_t)(3u + next() % (ZS_VARYINGS_MAX - 2u));
        random_colors(attr, r.config.varyings, 1u + next() % 16u);
        core = fast;
        const enum zs_set_up did = zs_set_up(&fast);
        if (did != ZS_SET_UP_NOT && by_core(&core) != did)
            wrong = 1;
        if (did == ZS_SET_UP_ROWS && !same(&fast, &core))
            wrong = 2;
        if (did == ZS_SET_UP_NONE && fast.tri_end != core.tri_end)
            wrong = 3;
        if (did == ZS_SET_UP_ROWS && !same_colors(&fast, &core, &colored))
            wrong = 5;
        if (did == ZS_SET_UP_ROWS && !same_texture(&fast, &core, &textured))
            wrong = 6;
        n[did]++;
    }
    /* each outcome is one that was looked at */
    if (!wrong && (n[0] < TRIANGLES / 10u || n[1] < TRIANGLES / 10u || n[2] < TRIANGLES / 10u ||
                   colored < TRIANGLES / 20u || textured < TRIANGLES / 40u))
        wrong = 4;
    if (wrong)
        hal_write(wrong == 4 ? "outcomes are seldom\n" : "they differ\n");
    hal_exit((int)wrong);
}
