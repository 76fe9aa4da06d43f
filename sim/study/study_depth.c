/* zsim study depth: what depth mappings keep apart.
 *
 *   separation  the least distance between two walls that are never drawn the wrong way round: walls that lie aslant by
 *               less than 1 %, in steps of parts of a bucket, in both orders, closer and closer; beside it the width of
 * a bucket by formula. near is 1 fight       a floor and another one, turned about the line ahead by 0.07 degrees; the
 * pixels that show the wrong one cure        a floor with a stripe 0.5 % above it, and what helps curve       keys of
 * walls between near 0.1 and far 1
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "study_walls.h"
#include "frame.h"
#include "sim.h"
#include "study_measure.h"

#define NEAR STUDY_WALLS_NEAR
#define SIDE 240  /* px, of the floors' pictures */
#define HEIGHT 20 /* of the eye above the floors, times near */
#define FAR 1000  /* of the floors, times near */

enum part { SEPARATION, FIGHT, CURE, CURVE };
static const char *const part_name[] = { "separation", "fight", "cure", "curve" };

enum cure { BASE, MORE_BITS, NEAR_OUT, FAR_IN, OFFSET, MAPPING, BOTH, N_CURES };
static const struct {
    const char *name;
    int mapping, bits;
    double near_z, far_z;
    int offset; /* buckets */
} cures[N_CURES] = {
    { "as it is", 0, 12, 1, FAR, 0 },
    { "16 bits", 0, 16, 1, FAR, 0 },
    { "near plane at 40", 0, 12, 40, FAR, 0 },
    { "far plane at 820", 0, 12, 1, 820, 0 },
    { "offset of 2 buckets", 0, 12, 1, FAR, -2 },
    { "default mapping", 5, 12, 1, FAR, 0 },
    { "default mapping and 16 bits", 5, 16, 1, FAR, 0 },
};

static struct run {
    enum part part;
    int mapping, bits, cure;
    double near_z, far_z, z;
} *runs;
static size_t n_runs;
static int phases; /* positions of the walls within a bucket */

/* ---- The plan ---------------------------------------------------------------------------------------------------- */

static void add(struct run run)
{
    runs = sim_grow(runs, n_runs + 1, sizeof *runs);
    runs[n_runs++] = run;
}

static void plan_separation(enum study_effort effort)
{
    static const double ratio[] = { 1000, 100, 10, 10000, 100000 };
    static const double place[] = {
        1.2, 3, 10, 30, 80, 300, 800, 3000, 8000, 30000, 80000
    }; /* not near an octave's end */
    const double last_of_ten = 7.9; /* at 10 times near the places end at 0.3 far without it, else at 0.8 */
    const int step = effort == STUDY_QUICK ? 8 : 1;
    const size_t ratios = effort == STUDY_QUICK ? 1 : 5;
    for (size_t r = 0; r < ratios; r++)
        for (int m = 0; m < STUDY_MAPPINGS; m++)
            for (int bits = 8; bits <= 16; bits += step) {
                for (size_t p = 0; p < sizeof place / sizeof place[0] && place[p] <= 0.81 * ratio[r]; p++)
                    if (effort != STUDY_QUICK || p % 3 == 1 || place[p] == 800)
                        add((struct run){ SEPARATION, m, bits, 0, 1, ratio[r], place[p] });
                if (ratio[r] == 10)
                    add((struct run){ SEPARATION, m, bits, 0, 1, ratio[r], last_of_ten });
            }
}

static size_t plan(enum study_effort effort)
{
    n_runs = 0;
    phases = effort == STUDY_QUICK ? 6 : 16;
    plan_separation(effort);
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        for (int bits = 8; bits <= 16; bits += effort == STUDY_QUICK ? 8 : 1)
            add((struct run){ FIGHT, m, bits, 0, 1, FAR, 0 });
    for (int c = 0; c < N_CURES; c++)
        add((struct run){ CURE, cures[c].mapping, cures[c].bits, c, cures[c].near_z, cures[c].far_z, 0 });
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        for (int k = 0; k < 36; k += effort == STUDY_QUICK ? 12 : 1)
            add((struct run){ CURVE, m, 16, 0, 0.1, 1, 0.1 * pow(10, (k + 0.5) / 36.0) });
    return n_runs;
}

static void describe(size_t i, struct study_text *row)
{
    const struct run *r = &runs[i];
    study_put(row, "%s", part_name[r->part]);
    study_put(row, "%s", study_mapping[r->mapping].name);
    study_put(row, "%d", r->bits);
    study_put(row, "%g", r->near_z);
    study_put(row, "%g", r->far_z);
    if (r->z > 0)
        study_put(row, "%.6g", r->z);
    else
        study_skip(row, 1);
    study_put(row, "%s", r->part == CURE ? cures[r->cure].name : "");
}

/* ---- Separation
 * -------------------------------------------------------------------------------------------------------- */

/* Two walls `gap` apart at z and a part of a bucket nearer, in both orders. */
static int holds(const struct run *r, double gap, double bucket)
{
    static const double slope[2][2] = { { 0.004, 0.003 }, { -0.0035, 0.0045 } };
    const int n = bucket > 0.001 * r->z ? phases : 2; /* aslant walls cross many of the finer buckets by themselves */
    for (int k = 0; k < n; k++)
        for (int swap = 1; swap >= 0; swap--) {
            const double z = (r->z - bucket * k / n) * NEAR;
            struct study_wall w[2];
            if (z < 1.01 * NEAR)
                continue;
            study_wall(&w[0], z, slope[k % 2]);
            study_wall(&w[1], z + gap * NEAR, slope[k % 2]); /* the same plane, farther */
            const int good = study_walls_in_order(study_mapping[r->mapping].depth, r->bits, r->far_z, w, swap);
            if (good != 1)
                return good;
        }
    return 1;
}

/* The least gap that holds, in the unit of near; 0: none that leaves the farther wall before far; < 0: refused. */
static double least_gap(const struct run *r)
{
    const double bucket = study_bucket(r->mapping, r->bits, r->near_z, r->far_z, r->z), most = 0.95 * r->far_z - r->z;
    double good = bucket < most / 2 ? 2 * bucket : most, bad = 0;
    for (int got; (got = holds(r, good, bucket)) != 1; good = fmin(2 * good, most)) {
        if (got < 0)
            return -1;
        if (good >= most)
            return 0;
        bad = good;
    }
    while (good - bad > 0.01 * good) {
        const double mid = (good + bad) / 2;
        if (holds(r, mid, bucket) == 1)
            good = mid;
        else
            bad = mid;
    }
    return good;
}

static int measure_separation(const struct run *r, struct study_text *row)
{
    const double gap = least_gap(r), bucket = study_bucket(r->mapping, r->bits, r->near_z, r->far_z, r->z);
    if (gap < 0)
        return sim_refuse(NULL, 0, "study depth: two walls could not be drawn");
    if (gap > 0)
        study_put(row, "%.4g", gap);
    else
        study_skip(row, 1);
    study_put(row, "%.4g", bucket);
    if (gap > 0)
        study_put(row, "%.3f", gap / bucket);
    else
        study_skip(row, 1);
    study_skip(row, 3);
    return SIM_OK;
}

/* ---- Floors
 * -------------------------------------------------------------------------------------------------------------- */

struct floors {
    struct zs_mesh mesh[2];
    int16_t pos[2][4][3];
    uint8_t lo[2][4][3];
    struct zs_instance instance[2];
    struct zs_scene scene;
    struct zs_camera camera;
    struct zs_config config;
};

static const uint16_t quad[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_material paint[2] = {
    { .shader = &zs_shade_raw, .rgb = { 40, 150, 90 }, .cull = ZS_CULL_NONE },
    { .shader = &zs_shade_raw, .rgb = { 250, 220, 90 }, .cull = ZS_CULL_NONE }
};

/* A floor HEIGHT below the eye from 45 to 800, `wide` times as wide as far each way; higher by `level`, and turned
 * about the line ahead by `turn` at its farther right corner, as parts of HEIGHT. */
static void floor_set(struct floors *f, int k, double wide, double level, double turn)
{
    static const double z[4] = { 45, 45, 800, 800 }, side[4] = { -1, 1, 1, -1 };
    const double unit = 800.0 * NEAR / 25000.0;
    for (int c = 0; c < 4; c++) {
        const double p[3] = { side[c] * wide * z[c], -HEIGHT * (1 - (level + side[c] * turn * z[c] / 800)), -z[c] };
        for (int axis = 0; axis < 3; axis++) {
            const double steps = floor(p[axis] * NEAR / unit * 256.0 + 0.5), whole = floor(steps / 256.0);
            f->pos[k][c][axis] = (int16_t)whole;
            f->lo[k][c][axis] = (uint8_t)(steps - whole * 256.0);
        }
    }
    f->mesh[k] = (struct zs_mesh){ .pos = (const int16_t(*)[3])f->pos[k],
                                   .pos_lo = (const uint8_t(*)[3])f->lo[k],
                                   .tri = quad,
                                   .n_verts = 4,
                                   .n_tris = 2,
                                   .scale = (zs_uq16_16)(unit * 65536.0),
                                   .center = { 0, 0, -12500 },
                                   .radius = 24000 };
    f->instance[k] = (struct zs_instance){ .mesh = &f->mesh[k], .material = &paint[k] };
    zs_pose_identity(&f->instance[k].pose);
}

static void floors_make(struct floors *f, const struct run *r)
{
    memset(f, 0, sizeof *f);
    floor_set(f, 0, 0.6, 0, 0);
    if (r->part == CURE)
        floor_set(f, 1, 0.3, 0.005, 0);
    else
        floor_set(f, 1, 0.6, 0, 0.03);
    f->scene = (struct zs_scene){ .instance = f->instance, .n_instances = 2, .background = zs_rgb565(150, 200, 240) };
    (void)zs_camera_perspective(&f->camera, 8192, SIDE, NEAR, 2 * NEAR);
    f->camera.z_near = (zs_q48_16)(r->near_z * NEAR * 65536.0);
    f->camera.z_far = (zs_q48_16)(r->far_z * NEAR * 65536.0);
    sim_frame_config(&f->config, SIDE, SIDE, ZS_VARYINGS_FLAT);
    f->config.depth = study_mapping[r->mapping].depth;
    f->config.depth_bits = (uint8_t)r->bits;
    f->config.max_tris = f->config.max_verts = 256;
}

static int floors_draw(struct study_frame *out, const struct run *r)
{
    struct floors f;
    const struct zs_depth_state nearer = { .bias = (int16_t)(r->part == CURE ? cures[r->cure].offset : 0) };
    floors_make(&f, r);
    if (nearer.bias)
        f.instance[1].depth_state = &nearer;
    const int err = study_frame_open(out, &f.scene, &f.camera, &f.config);
    return err ? sim_refuse(NULL, 0, "study depth: two floors could not be drawn: %s", zs_error_string(err)) : SIM_OK;
}

static int measure_floors(const struct run *r, struct study_text *row)
{
    struct study_frame frame;
    const int status = floors_draw(&frame, r);
    if (status != SIM_OK)
        return status;
    study_skip(row, 3);
    study_put(row, "%zu", frame.surface);
    study_put(row, "%zu", frame.diff.ref_drawn);
    study_skip(row, 1);
    study_frame_free(&frame);
    return SIM_OK;
}

/* ---- Curve
 * --------------------------------------------------------------------------------------------------------------- */

static int measure_curve(const struct run *r, struct study_text *row)
{
    static const double square[2] = { 0, 0 };
    struct study_wall wall;
    struct zs_instance in = { .mesh = &wall.mesh, .material = &paint[0] };
    struct zs_camera camera;
    struct zs_config config;
    struct sim_frame frame;
    const struct zs_scene scene = { .instance = &in, .n_instances = 1 };
    study_wall(&wall, r->z * 10 * 65536, square);
    zs_pose_identity(&in.pose);
    (void)zs_camera_perspective(&camera, 8192, STUDY_WALLS_H, 65536, 655360);
    sim_frame_config(&config, STUDY_WALLS_W, STUDY_WALLS_H, ZS_VARYINGS_FLAT);
    config.depth = study_mapping[r->mapping].depth;
    config.max_tris = config.max_verts = 64;
    const int err = sim_frame_render(&frame, &scene, &camera, &config, NULL);
    if (err)
        return sim_refuse(NULL, 0, "study depth: a wall could not be drawn: %s", zs_error_string(err));
    study_skip(row, 5);
    study_put(row, "%u", frame.key[STUDY_WALLS_W * STUDY_WALLS_H / 2 + STUDY_WALLS_W / 2]);
    sim_frame_free(&frame);
    return SIM_OK;
}

static int measure(size_t i, struct study_text *row)
{
    const struct run *r = &runs[i];
    if (r->part == SEPARATION)
        return measure_separation(r, row);
    return r->part == CURVE ? measure_curve(r, row) : measure_floors(r, row);
}

/* ---- What follows
 * ---------------------------------------------------------------------------------------------------------- */

/* A data block of gnuplot: the rows of a part with this mapping and these bits. y: 0 separation and 1 bucket, percent
 * of the distance; 2 percent of pixels wrong; 3 key, of 1. */
static size_t block(FILE *f, const struct study_table *t, enum part part, int m, int bits, double ratio, int y)
{
    size_t n = 0;
    (void)fprintf(f, "$%s_%d_%d_%g_%d << EOD\n", part_name[part], m, bits, ratio, y);
    for (size_t r = 0; r < t->n_rows; r++) {
        if (!study_is(t, r, "part", part_name[part]) || !study_is(t, r, "mapping", study_mapping[m].name) ||
            (bits && study_number(t, r, "bits") != bits) || study_number(t, r, "far") != ratio)
            continue;
        const double z = study_number(t, r, "z"), x = y == 2 ? study_number(t, r, "bits") : z;
        const double v = y == 0   ? 100 * study_number(t, r, "separation") / z
                         : y == 1 ? 100 * study_number(t, r, "bucket") / z
                         : y == 2 ? 100 * study_number(t, r, "wrong") / study_number(t, r, "pixels")
                                  : study_number(t, r, "key") / 65535;
        if (!isnan(v))
            (void)fprintf(f, "%.6g\t%.6g\n", x, v), n++;
    }
    (void)fprintf(f, "EOD\n");
    return n;
}

/* Open a plot of 860 x height px, with the mappings' lines; `set` are gnuplot's settings. Return NULL after a
 * sentence. */
static FILE *plot_open(struct study_page *page, const char *name, int height, const char *set)
{
    FILE *f = study_plot_open(page, name, 860, height);
    if (!f)
        return NULL;
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        (void)fprintf(f, "set linetype %d lc rgb '%s' lw %s pt %d ps %s\n", m + 1, study_mapping[m].color,
                      m == 5 ? "1.2 dt 2" : "1.8", m == 5 ? 6 : 7, m == 5 ? "0.9" : "0.5");
    (void)fputs(set, f);
    return f;
}

/* Formulas of all mappings as lines over z from n to f, percent of the distance. */
static void formula(FILE *f, int m, int bits, double near_z, double far_z, const char *name)
{
    (void)fprintf(f, "$%s_%d << EOD\n", name, m);
    for (int k = 0; k <= 400; k++) {
        const double z = near_z * pow(far_z / near_z, k / 400.0);
        (void)fprintf(f, "%.6g\t%.6g\n", z, 100 * study_bucket(m, bits, near_z, far_z, z) / z);
    }
    (void)fprintf(f, "EOD\n");
}

static int plot_separation(struct study_page *page, const struct study_table *t)
{
    FILE *f = plot_open(page, "separation", 480,
                        "set logscale xy\nset xlabel 'distance / near'\n"
                        "set ylabel 'least separation, % of the distance'\n"
                        "set yrange [0.001:10]\nset xrange [1:1000]\n");
    if (!f)
        return SIM_REFUSED;
    for (int m = 0; m < STUDY_MAPPINGS; m++) {
        (void)block(f, t, SEPARATION, m, 16, 1000, 0);
        formula(f, m, 16, 1, 1000, "formula");
    }
    (void)fputs("plot ", f);
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        (void)fprintf(f,
                      "$formula_%d with lines lt %d title '%s%s', $separation_%d_16_1000_0 with points lt %d notitle%s",
                      m, m + 1, study_mapping[m].name, m == 5 ? " (default)" : "", m, m + 1, m < 5 ? ", " : "\n");
    return study_plot_close(
        page, "Far at 1,000 times near, keys of 16 bits: the width of a bucket by formula (lines), and the "
              "least separation of two walls that the renderer never swaps (dots). Lower is better.");
}

/* The worst separation over all distances, percent of the distance; INFINITY: at one none holds. */
static double worst_separation(const struct study_table *t, const char *mapping, int bits, double ratio)
{
    double worst = 0;
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "part", "separation") && study_is(t, r, "mapping", mapping) &&
            study_number(t, r, "bits") == bits && study_number(t, r, "far") == ratio) {
            const double gap = study_number(t, r, "separation");
            worst = isnan(gap) ? (double)INFINITY : fmax(worst, 100 * gap / study_number(t, r, "z"));
        }
    return worst;
}

static void table_worst(struct study_page *page, const struct study_table *t)
{
    static const double ratio[] = { 10, 100, 1000, 10000, 100000 };
    study_table_open(page, "far / near|recip|linear|e3m13|e4m12|e5m11|float (default)");
    for (size_t k = 0; k < sizeof ratio / sizeof ratio[0]; k++) {
        char text[512];
        size_t n = (size_t)snprintf(text, sizeof text, "%g", ratio[k]);
        if (worst_separation(t, "recip", 16, ratio[k]) <= 0)
            continue;
        for (int m = 0; m < STUDY_MAPPINGS; m++) {
            const double worst = worst_separation(t, study_mapping[m].name, 16, ratio[k]);
            n += (size_t)(isinf(worst) ? snprintf(text + n, sizeof text - n, "|none")
                                       : snprintf(text + n, sizeof text - n, "|%.3g %%", worst));
        }
        study_table_row(page, "%s", text);
    }
    study_table_close(page,
                      "16 bits: the least separation that is never swapped, worst over the distances up to 0.8 far. "
                      "none: at some distance, no separation before far is safe.");
}

static int plot_bits(struct study_page *page, const struct study_table *t)
{
    FILE *f = plot_open(page, "fight", 420,
                        "set xlabel 'bits of a key'\nset ylabel '% of the floor that shows the wrong one'\n"
                        "set yrange [0:*]\nset xrange [7.8:16.2]\n");
    if (!f)
        return SIM_REFUSED;
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        (void)block(f, t, FIGHT, m, 0, FAR, 2);
    (void)fputs("plot ", f);
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        (void)fprintf(f, "$fight_%d_0_%d_2 with linespoints lt %d title '%s%s'%s", m, FAR, m + 1, study_mapping[m].name,
                      m == 5 ? " (default)" : "", m < 5 ? ", " : "\n");
    return study_plot_close(page,
                            "Two floors that cross at 0.07 degrees, far at 1,000 times near: z-fighting by bits.");
}

static int plot_curve(struct study_page *page, const struct study_table *t)
{
    FILE *f = plot_open(page, "curve", 440,
                        "set xlabel 'distance'\nset ylabel 'key / 65,535'\nset yrange [0:1]\nset xrange [0.1:1]\n");
    if (!f)
        return SIM_REFUSED;
    for (int m = 0; m < STUDY_MAPPINGS; m++) {
        (void)block(f, t, CURVE, m, 16, 1, 3);
        (void)fprintf(f, "$key_%d << EOD\n", m);
        for (int k = 0; k <= 300; k++) {
            const double z = 0.1 + 0.9 * k / 300.0;
            (void)fprintf(f, "%.6g\t%.6g\n", z, study_key(m, 16, 0.1, 1, z) / 65535);
        }
        (void)fputs("EOD\n", f);
    }
    (void)fputs("plot ", f);
    for (int m = 0; m < STUDY_MAPPINGS; m++)
        (void)fprintf(f, "$key_%d with lines lt %d title '%s%s', $curve_%d_16_1_3 with points lt %d notitle%s", m,
                      m + 1, study_mapping[m].name, m == 5 ? " (default)" : "", m, m + 1, m < 5 ? ", " : "\n");
    return study_plot_close(
        page, "Near 0.1, far 1: which part of all keys lies before a distance; formulas (lines), and keys of "
              "walls that were drawn (dots). recip is the perspective projection's own.");
}

/* The row of a fight with the most wrong pixels that has these bits. */
static size_t worst_fight(const struct study_table *t, int bits)
{
    size_t worst = t->n_rows;
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "part", "fight") && study_number(t, r, "bits") == bits &&
            (worst == t->n_rows || study_number(t, r, "wrong") > study_number(t, worst, "wrong")))
            worst = r;
    return worst;
}

static int mapping_of(const char *name)
{
    int m = 0;
    while (m < STUDY_MAPPINGS - 1 && strcmp(study_mapping[m].name, name))
        m++;
    return m;
}

/* Floors side by side; *wrong: of the first. */
static int picture(struct study_page *page, const char *name, const struct run *run, unsigned n, unsigned columns,
                   const char *caption)
{
    const unsigned width = columns * SIDE, height = (n + columns - 1) / columns * SIDE;
    uint8_t *rgb = sim_alloc((size_t)width * height, 3);
    int status = SIM_OK;
    memset(rgb, 255, (size_t)width * height * 3);
    for (unsigned k = 0; k < n && status == SIM_OK; k++) {
        struct study_frame frame;
        status = floors_draw(&frame, &run[k]);
        if (status != SIM_OK)
            break;
        for (unsigned y = 0; y < SIDE - 2; y++)
            study_sheet_put(rgb, width, k % columns * SIDE, k / columns * SIDE + y, frame.rgb565 + (size_t)y * SIDE,
                            NULL, SIDE - 2, 1);
        study_frame_free(&frame);
    }
    if (status == SIM_OK)
        status = study_picture(page, name, width, height, rgb, caption);
    free(rgb);
    return status;
}

static int report_fights(struct study_page *page, const struct study_table *t)
{
    const size_t bad = worst_fight(t, 16);
    char caption[512];
    int m = mapping_of(study_cell(t, bad, "mapping"));
    const struct run two[2] = { { FIGHT, m, 16, 0, 1, FAR, 0 }, { FIGHT, 5, 16, 0, 1, FAR, 0 } };
    double of[STUDY_MAPPINGS] = { 0 };
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "part", "fight") && study_number(t, r, "bits") == 16)
            of[mapping_of(study_cell(t, r, "mapping"))] = study_number(t, r, "wrong");
    (void)snprintf(caption, sizeof caption,
                   "The worst case with 16 bits, %s (%.0f pixels of %.0f wrong), and the default mapping "
                   "(%.0f). In truth the border is the upright line in the middle.",
                   study_mapping[m].name, of[m], study_number(t, bad, "pixels"), of[5]);
    return picture(page, "fight-worst", two, 2, 2, caption);
}

static int report_cures(struct study_page *page, const struct study_table *t)
{
    struct run run[N_CURES];
    double wrong[N_CURES] = { 0 };
    study_table_open(page, "cure|mapping|bits|near|far|pixels wrong");
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "part", "cure")) {
            int c = 0;
            while (c < N_CURES - 1 && !study_is(t, r, "cure", cures[c].name))
                c++;
            wrong[c] = study_number(t, r, "wrong");
            run[c] = (struct run){ CURE, cures[c].mapping, cures[c].bits, c, cures[c].near_z, cures[c].far_z, 0 };
            study_table_row(page, "%s|%s|%s|%s|%s|%s", cures[c].name, study_cell(t, r, "mapping"),
                            study_cell(t, r, "bits"), study_cell(t, r, "near"), study_cell(t, r, "far"),
                            study_cell(t, r, "wrong"));
        }
    study_table_close(
        page, "A stripe that lies 0.5 % of the eye's height above a floor, 45 to 800 times near away, and how many "
              "pixels show the floor in its place.");
    study_say(
        page,
        "Of %.0f wrong pixels, the near plane 40 times as far out leaves %.0f, the far plane drawn in %.0f, 16 bits in "
        "place of 12 %.0f, and the default mapping, which moves no plane, %.0f. An offset leaves %.0f, and is right "
        "only for what is known to lie on top.",
        wrong[BASE], wrong[NEAR_OUT], wrong[FAR_IN], wrong[MORE_BITS], wrong[MAPPING], wrong[OFFSET]);
    return picture(page, "cures", run, N_CURES, 4,
                   "The same in this order: as it is, 16 bits, near plane out, far plane in; "
                   "offset, default mapping, both it and 16 bits.");
}

static int report(struct study_page *page, const struct study_table *t)
{
    double least = 10, most = 0;
    size_t n = 0;
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "part", "separation") && !isnan(study_number(t, r, "buckets")) &&
            study_number(t, r, "bucket") < 0.02 * study_number(t, r, "z")) {
            least = fmin(least, study_number(t, r, "buckets"));
            most = fmax(most, study_number(t, r, "buckets"));
            n++;
        }
    study_say(
        page,
        "Varied: the mapping from distance to key, its bits from 8 to 16, how far the far plane is, and the distance. "
        "Two walls are drawn closer and closer, until the farther one shows.");
    int status = plot_separation(page, t);
    if (status != SIM_OK)
        return status;
    table_worst(page, t);
    study_say(
        page,
        "With far at 1,000 times near and 16 bits, recip needs %.3g %% of the distance at worst, the default mapping "
        "%.3g %%: that is what decides. What was measured lies between %.2f and %.2f times the formula's bucket in all "
        "%zu runs in which that is below 2 %% of the distance.",
        worst_separation(t, "recip", 16, 1000), worst_separation(t, "float", 16, 1000), least, most, n);
    study_head(page, "Two floors that nearly coincide");
    status = plot_bits(page, t);
    if (status == SIM_OK)
        status = report_fights(page, t);
    if (status != SIM_OK)
        return status;
    study_head(page, "Cures");
    status = report_cures(page, t);
    if (status != SIM_OK)
        return status;
    study_head(page, "Where the keys go");
    return plot_curve(page, t);
}

const struct study study_depth = {
    .name = "depth", .what = "what depth mappings keep apart",
    .params = "part,mapping,bits,near,far,z,cure", .results = "separation,bucket,buckets,wrong,pixels,key",
    .runs = plan, .describe = describe, .measure = measure, .report = report,
};
