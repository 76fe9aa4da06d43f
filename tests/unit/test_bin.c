/* Pools and bins (core/bin.c): strips of rows, packing, room; what is held stays as it was, in order.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "core/bin.h"
#include "core/cull.h"
#include "core/xform.h"
#include "picture.h"
#include "zs_shader.h"

#define H 64
#define STRIP 7
#define STRIPS ((H + STRIP - 1) / STRIP)

/* ---- Strips ---------------------------------------------------------------------------------- */

/* Every row by every strip height, without a division. */
static void rows_have_their_strips(void **state)
{
    static uint32_t arena[200000];
    for (uint32_t h = 1; h <= ZS_SIZE_MAX; h++) {
        struct zs_renderer r;
        const struct zs_config c = { .width = 1, .height = ZS_SIZE_MAX, .strip_h = (uint16_t)h, .max_tris = 1,
                                     .max_verts = 3, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                     .depth = &zs_depth_recip };
        assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
        for (int32_t row = 0; row < ZS_SIZE_MAX; row++)
            if (zs_bin_strip(&r, row) != row / (int32_t)h)
                fail_msg("row %d by %u", (int)row, (unsigned)h);
    }
}

/* The first strip that is drawn of any rows. */
static int first_case(uint64_t seed)
{
    static uint32_t arena[2000];
    struct prng p = { seed };
    struct zs_renderer r;
    const int32_t height = prng_range(&p, 1, 100), h = prng_range(&p, 1, height);
    const struct zs_config c = { .width = 1, .height = (uint16_t)height, .strip_h = (uint16_t)h, .max_tris = 1,
                                 .max_verts = 3, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                 .depth = &zs_depth_recip };
    CASE_CHECK(zs_init(&r, &c, arena, sizeof arena) == ZS_OK);
    r.walk_y = 0;
    r.walk_y_end = c.height;
    r.strip = (uint16_t)prng_pick(&p, r.n_strips);
    r.band_end = (uint16_t)prng_range(&p, r.strip + 1, r.n_strips);
    for (int n = 0; n < 50; n++) {
        const int32_t y0 = prng_range(&p, -50, height - 1), y1 = prng_range(&p, y0 < 0 ? 1 : y0 + 1, height + 50);
        uint32_t want = ZS_NIL;
        for (int32_t s = r.strip; s < r.band_end && want == ZS_NIL; s++)
            if (y0 < (s + 1) * h && y1 > s * h)
                want = (uint32_t)s;
        if (zs_bin_place(&r, y0, y1) != want)
            return case_wrong("rows [%d, %d) in strips [%u, %u) of %d: %u, not %u", y0, y1, r.strip, r.band_end, h,
                              zs_bin_place(&r, y0, y1), want);
    }
    return 1;
}

/* ---- A scene of one mesh, binned by hand ----------------------------------------------------- */

#define VERTS 300
#define TRIS_MAX 60
#define POOL_MAX 90

static struct {
    int16_t pos[VERTS][3];
    uint16_t tri[1][3];
    struct zs_mesh mesh;
    struct zs_material material;
    struct zs_instance instance[3];
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
    struct zs_renderer r;
    uint32_t arena[4000];
} world;

/* Attributes that tell whose they are. */
#define ATTRS 2
static void own_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    (void)s;
    out[0] = (uint16_t)(v * 3u);
    out[1] = (uint16_t)(v ^ 0x1234u);
}

/* Nothing is drawn here. */
static void no_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    (void)job;
    (void)row;
    (void)from;
    (void)to;
    abort();
}

static const struct zs_shader shader = { .vertex = own_vertex, .run = no_run, .n_varyings = ATTRS };

static int instance_next(uint32_t number)
{
    struct zs_renderer *r = &world.r;
    struct zs_bounds b;
    CASE_CHECK(zs_cull_bounds(&b, r, &world.instance[number]) == ZS_OK && zs_xform_instance(r, number, &b));
    r->vert_base = r->n_verts;
    r->direct = 0;
    return 1;
}

static int world_open(struct prng *p)
{
    memset(&world.mesh, 0, sizeof world.mesh);
    for (uint32_t v = 0; v < VERTS; v++) {
        world.pos[v][0] = (int16_t)prng_range(p, -H * 128, H * 128);
        world.pos[v][1] = (int16_t)prng_range(p, -H * 128, H * 128);
        world.pos[v][2] = 0;
    }
    world.mesh.pos = (const int16_t (*)[3])world.pos;
    world.mesh.tri = (const uint16_t (*)[3])world.tri;
    world.mesh.n_verts = VERTS;
    world.mesh.n_tris = 1;
    world.mesh.scale = ZS_Q16_ONE;
    world.mesh.radius = 20000;
    world.material = (struct zs_material){ .shader = &shader };
    for (int k = 0; k < 3; k++) {
        world.instance[k] = (struct zs_instance){ .mesh = &world.mesh, .material = &world.material };
        zs_pose_identity(&world.instance[k].pose);
        world.instance[k].pose.pos[2] = -PIXEL_Z;
    }
    world.scene = (struct zs_scene){ .instance = world.instance, .n_instances = 3 };
    world.camera = pixel_camera(H, 0);
    world.config = picture_config(H, H, &zs_depth_linear);
    world.config.strip_h = STRIP;
    world.config.varyings = ATTRS;
    world.config.fast = NULL;
    world.config.max_tris = (uint16_t)prng_range(p, 1, TRIS_MAX);
    world.config.max_verts = (uint16_t)prng_range(p, 3, POOL_MAX);
    CASE_CHECK(zs_arena_bytes(&world.config) <= sizeof world.arena);
    CASE_CHECK(zs_init(&world.r, &world.config, world.arena, sizeof world.arena) == ZS_OK);
    CASE_CHECK(zs_frame_begin(&world.r, &world.scene, &world.camera) == ZS_OK);
    world.r.strip = (uint16_t)prng_pick(p, STRIPS);
    world.r.band_end = STRIPS;
    world.r.walk_y = 0;
    world.r.walk_y_end = world.config.height;
    zs_bin_empty(&world.r);
    return instance_next(0);
}

/* What a triangle is made of, wherever it lies. */
struct copy {
    struct zs_vertex v[3];
    uint16_t src[3], attr[3][ATTRS], paint, instance;
    uint32_t strip;
};

static void copy_of(struct copy *out, uint32_t t, uint32_t strip)
{
    const struct zs_renderer *r = &world.r;
    memset(out, 0, sizeof *out);
    for (int k = 0; k < 3; k++) {
        const uint32_t slot = r->tri[t].v[k];
        out->v[k] = r->vert[slot];
        out->src[k] = r->vert_src[slot];
        memcpy(out->attr[k], &r->attr[slot * ATTRS], sizeof out->attr[k]);
    }
    out->paint = r->tri[t].paint;
    out->instance = r->tri[t].instance;
    out->strip = strip;
}

/* All that is binned, in pool order. Return how many; -1: bins do not hold each once, the newest first. */
static int32_t all_of(struct copy out[TRIS_MAX])
{
    const struct zs_renderer *r = &world.r;
    uint32_t n = 0;
    uint8_t seen[TRIS_MAX] = { 0 };
    for (uint32_t s = r->strip; s < r->band_end; s++)
        for (uint32_t t = r->bin[s], last = r->n_tris; t != ZS_NIL; last = t, t = r->tri[t].next) {
            if (t >= last || seen[t])
                return -1;
            seen[t] = 1;
            copy_of(&out[t], t, s);
            n++;
        }
    return n == r->n_tris ? (int32_t)n : -1;
}

/* Bin triangles of any three vertices, top first, until a pool is full. */
static int fill(struct prng *p)
{
    struct zs_renderer *r = &world.r;
    for (uint32_t n = 0, instance = 0; r->n_tris < r->config.max_tris; n++) {
        uint16_t index[3];
        uint32_t slot[3], first = prng_pick(p, VERTS - 12u);
        if (prng_pick(p, 20) == 0 && instance < 2 && !instance_next(++instance))
            return 0;
        for (uint32_t k = 0; k < 3; k++)
            index[k] = (uint16_t)(first + 4u * k + prng_pick(p, 4));
        const uint32_t verts = r->n_verts;
        if (!zs_bin_corners(r, index, slot)) {
            CASE_CHECK(r->n_verts == r->config.max_verts);
            return 1;
        }
        CASE_CHECK(r->n_verts <= verts + 3u);
        for (int k = 0; k < 3; k++) {
            struct zs_vertex want;
            zs_xform_screen(r, index[k], &want);
            CASE_CHECK(slot[k] >= r->vert_base && r->vert_src[slot[k]] == index[k]);
            CASE_CHECK(!memcmp(&r->vert[slot[k]], &want, sizeof want));
        }
        int top = 0;
        for (int k = 1; k < 3; k++)
            top = r->vert[slot[k]].y < r->vert[slot[top]].y ? k : top;
        const uint32_t keep = slot[0];
        slot[0] = slot[top];
        slot[top] = keep;
        const int32_t y0 = zs_first_sample(r->vert[slot[0]].y);
        int32_t y1 = y0;
        for (int k = 0; k < 3; k++) {
            const int32_t y = zs_first_sample(r->vert[slot[k]].y);
            y1 = y > y1 ? y : y1;
        }
        const uint32_t strip = y1 > 0 && y0 < H && y0 < y1 ? zs_bin_place(r, y0, y1) : ZS_NIL;
        if (strip == ZS_NIL)
            continue; /* its vertices are nobody's */
        for (int k = 0; k < 3; k++)
            zs_bin_corner(r, slot[k], ATTRS);
        zs_bin_add(r, slot, (uint16_t)n, strip);
    }
    return 1;
}

/* How many vertices some triangle holds; of the current instance, in *own. */
static uint32_t held(uint32_t *own)
{
    const struct zs_renderer *r = &world.r;
    uint8_t of[POOL_MAX] = { 0 };
    uint32_t n = 0;
    *own = 0;
    for (uint32_t t = 0; t < r->n_tris; t++)
        for (int k = 0; k < 3; k++)
            of[r->tri[t].v[k]] = 1;
    for (uint32_t v = 0; v < r->n_verts; v++) {
        n += of[v];
        *own += of[v] && v >= r->vert_base;
    }
    return n;
}

/* The map has the largest power of two that is at most max_verts. */
static uint32_t entries_less_one(void)
{
    uint32_t n = 1;
    while (n * 2u <= world.config.max_verts)
        n *= 2u;
    return n - 1u;
}

/* Vertices of the current instance that are held are found where they are. */
static int found_again(void)
{
    struct zs_renderer *r = &world.r;
    for (uint32_t v = r->vert_base; v < r->n_verts; v++) {
        const uint16_t index[3] = { r->vert_src[v], r->vert_src[v], r->vert_src[v] };
        uint32_t slot[3];
        const uint32_t n = r->n_verts, transformed = r->stats.verts_transformed;
        if (r->vert_map[index[0] & entries_less_one()] != v)
            continue; /* another vertex has its entry */
        CASE_CHECK(zs_bin_corners(r, index, slot) && slot[0] == v && slot[2] == v);
        CASE_CHECK(r->n_verts == n && r->stats.verts_transformed == transformed);
    }
    return 1;
}

/* ---- Packing and room ------------------------------------------------------------------------ */

static uint32_t dropped_verts, dropped_tris, bands[STRIPS + 1], no_room;

static int pack_case(uint64_t seed)
{
    static struct copy before[TRIS_MAX], after[TRIS_MAX];
    struct prng p = { seed };
    struct zs_renderer *r = &world.r;
    uint32_t own, own_after;
    if (!world_open(&p) || !fill(&p))
        return 0;
    const int32_t n = all_of(before);
    CASE_CHECK(n >= 0);
    const uint32_t kept = held(&own);
    dropped_verts += r->n_verts - kept;
    zs_bin_pack(r);
    CASE_CHECK(r->n_verts == kept && r->vert_packed == kept && held(&own_after) == kept && own_after == own);
    CASE_CHECK(r->n_verts - r->vert_base == own);
    CASE_CHECK(all_of(after) == n && !memcmp(before, after, (size_t)n * sizeof *before));
    return found_again();
}

/* How many vertices the triangles of strips before `end` hold. */
static uint32_t held_by(const struct copy *all, const uint16_t (*slot)[3], uint32_t n, uint32_t end)
{
    uint8_t of[POOL_MAX] = { 0 };
    uint32_t held_verts = 0;
    for (uint32_t t = 0; t < n; t++)
        for (int k = 0; k < 3 && all[t].strip < end; k++) {
            held_verts += !of[slot[t][k]];
            of[slot[t][k]] = 1;
        }
    return held_verts;
}

static int has_room(uint32_t used, uint32_t all, uint32_t share, uint32_t more)
{
    const uint32_t least = all / share + more;
    return all - used >= (least < all ? least : all);
}

/* Where the band should end: strips go, each time at least one and an eighth of the triangles, until an eighth of both
 * pools is free; of vertices a quarter in one strip and in the first walk.
 * *room: 0 if one strip is left and it is not. */
static uint32_t band_wanted(const struct copy *all, const uint16_t (*slot)[3], uint32_t n, int *room)
{
    const struct zs_renderer *r = &world.r;
    uint32_t end = r->band_end, left = n;
    for (;;) {
        const uint32_t share = end - r->strip == 1 || r->counting ? 4 : 8;
        *room = has_room(left, r->config.max_tris, 8, 1) &&
                has_room(held_by(all, slot, n, end), r->config.max_verts, share, 3);
        if (*room || end - r->strip == 1)
            return end;
        const uint32_t before = left;
        do {
            end--;
            for (uint32_t t = 0; t < n; t++)
                left -= all[t].strip == end;
        } while (end - r->strip > 1 && before - left <= before / 8u);
    }
}

static int room_case(uint64_t seed)
{
    static struct copy before[TRIS_MAX], after[TRIS_MAX];
    static uint16_t slot[TRIS_MAX][3];
    struct prng p = { seed };
    struct zs_renderer *r = &world.r;
    if (!world_open(&p) || !fill(&p))
        return 0;
    const uint32_t used = r->n_tris, band = r->band_end;
    const int32_t n = all_of(before);
    for (uint32_t t = 0; t < used; t++)
        memcpy(slot[t], r->tri[t].v, sizeof slot[t]);
    int want_room;
    r->counting = (uint8_t)prng_pick(&p, 2);
    const uint32_t want = band_wanted(before, (const uint16_t (*)[3])slot, used, &want_room);
    if (prng_pick(&p, 4) == 0) { /* vertices that nobody holds are gone already */
        zs_bin_pack(r);
        (void)all_of(before);
    }
    r->direct = 1;
    const int room = zs_bin_room(r);
    CASE_CHECK(n >= 0 && !r->direct && r->band_end == want && room == want_room);
    CASE_CHECK(r->stats.max_tris_used == used && r->stats.max_verts_used >= r->n_verts);
    /* what begins below the band is gone, the others are as they were; bins below have the numbers of those gone */
    uint32_t kept = 0, gone[STRIPS] = { 0 };
    for (int32_t t = 0; t < n; t++)
        if (before[t].strip < r->band_end)
            before[kept++] = before[t];
        else
            gone[before[t].strip]++;
    CASE_CHECK(r->n_tris == kept && all_of(after) == (int32_t)kept && !memcmp(before, after, kept * sizeof *before));
    for (uint32_t s = r->band_end; s < band; s++)
        CASE_CHECK(r->bin[s] == gone[s]);
    uint32_t own;
    CASE_CHECK(!room || (held(&own) == r->n_verts && r->n_verts - r->vert_base == own));
    dropped_tris += (uint32_t)n - kept;
    bands[r->band_end - r->strip]++;
    no_room += !room;
    return found_again();
}

static void room_is_made_from_below(void **state)
{
    dropped_tris = no_room = 0;
    memset(bands, 0, sizeof bands);
    CASES(room_case, 8000);
    print_message("%u triangles dropped; bands of 1 to 5 strips: %u %u %u %u %u; no room %u times\n", dropped_tris,
                  bands[1], bands[2], bands[3], bands[4], bands[5], no_room);
    assert_true(!cases_all() ||
                (dropped_tris > 10000 && bands[1] > 200 && bands[2] > 200 && bands[5] > 20 && no_room > 100));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rows_have_their_strips),
    CASES_TEST(the_first_strip_of_rows, first_case, 20000),
    CASES_COUNT(packing_keeps_what_is_held, pack_case, 4000, &dropped_verts, 4000, "vertices dropped"),
    cmocka_unit_test(room_is_made_from_below),
};

CASES_MAIN(tests)
