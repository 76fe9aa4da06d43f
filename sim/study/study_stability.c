/* zsim study stability: does the error stay where ranges end? One quantity at a time, to beyond what is accepted; there
 * the row says by which name it is refused.
 *
 *   scale      a ball of radius 1000 steps, scale 2^value, as large on the screen
 *   distance   a ball as far away as 2^value times its radius, as large on the screen by a longer lens
 *   near       near plane at 2^-value of the ball's distance
 *   sliver     triangles 2^value times as long as wide, corners on sub-pixels, so that their pixels are known exactly
 *   rotation   value composed rotations, the same one again and again; how far a point 160 px from the middle is off
 *   wander     the same, another one each time
 *   ratio      a textured floor whose far end is 2^value times as far as its near one
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "one.h"
#include "prng.h"
#include "rotation_drift.h"
#include "sim.h"
#include "study_measure.h"

#define W 160 /* px */
#define H 120
#define COLUMNS 20 /* of the ball */
#define ROWS 12
#define VERTS (COLUMNS * (ROWS - 1) + 2)
#define TRIS (2 * COLUMNS * (ROWS - 1))
#define RADIUS 1000 /* steps */
#define SLIVERS 40
#define EXACT_Z 32768 /* a world unit there is 1/256 px at a focal length of 128 px */

enum part { SCALE, DISTANCE, NEAR, SLIVER, ROTATION, WANDER, RATIO, N_PARTS };
static const char *const part_name[N_PARTS] = { "scale", "distance", "near", "sliver", "rotation", "wander", "ratio" };

static struct run {
    enum part part;
    int value;
} *runs;
static size_t n_runs;

static void add(enum part part, int from, int to, int by)
{
    for (int v = from; v <= to; v += by) {
        runs = sim_grow(runs, n_runs + 1, sizeof *runs);
        runs[n_runs++] = (struct run){ part, v };
    }
}

static size_t plan(enum study_effort effort)
{
    const int by = effort == STUDY_QUICK ? 8 : 1;
    n_runs = 0;
    add(SCALE, -16, 16, by);
    add(DISTANCE, 1, 22, effort == STUDY_QUICK ? 7 : 1);
    add(NEAR, 1, 23, effort == STUDY_QUICK ? 11 : 1);
    add(SLIVER, 0, 20, by);
    for (int v = 1, top = effort == STUDY_QUICK ? 1000 : 1000000; v <= top; v *= effort == STUDY_QUICK ? 1000 : 10)
        add(ROTATION, v, v, 1);
    for (int v = 1, top = effort == STUDY_QUICK ? 1000 : 1000000; v <= top; v *= effort == STUDY_QUICK ? 1000 : 10)
        add(WANDER, v, v, 1);
    add(RATIO, 1, 20, by);
    return n_runs;
}

static void describe(size_t i, struct study_text *row)
{
    study_put(row, "%s", part_name[runs[i].part]);
    study_put(row, "%d", runs[i].value);
}

/* ---- Scenes ------------------------------------------------------------------------------------------------------ */

struct stage {
    struct sim_one one;
    struct zs_texture texture;
    uint16_t texel[256 * 256];
    int16_t pos[VERTS][3];
    uint8_t pos_lo[VERTS][3];
    int16_t uv[VERTS][2];
    uint16_t tri[TRIS][3], raw[TRIS];
};

static void stage_begin(struct stage *s)
{
    memset(s, 0, sizeof *s);
    sim_one_open(&s->one, W, H);
    for (size_t k = 0; k < TRIS; k++)
        s->raw[k] = (uint16_t)(0x2104u + k * 2654435761u % 0xc000u);
    s->one.mesh = (struct zs_mesh){
        .pos = (const int16_t(*)[3])s->pos, .tri = (const uint16_t(*)[3])s->tri, .face_raw = s->raw,
        .scale = ZS_Q16_ONE, .radius = RADIUS + 2
    };
    s->one.config.max_tris = s->one.config.max_verts = 1024;
    (void)zs_camera_perspective(&s->one.camera, 8192, H, 1, 2);
}

static int16_t rounded(double v)
{
    return (int16_t)floor(v + 0.5);
}

static void put_triangle(struct stage *s, int a, int b, int c)
{
    uint16_t *t = s->tri[s->one.mesh.n_tris++];
    t[0] = (uint16_t)a;
    t[1] = (uint16_t)b;
    t[2] = (uint16_t)c;
}

/* Column k, row r of 1 .. ROWS - 1; the poles are the last two vertices. */
static int ball_at(int k, int r)
{
    return r == 0 ? VERTS - 2 : r == ROWS ? VERTS - 1 : (r - 1) * COLUMNS + k % COLUMNS;
}

static void make_ball(struct stage *s)
{
    const double pi = 3.14159265358979323846;
    for (int r = 0; r <= ROWS; r++)
        for (int k = 0; k < COLUMNS; k++) {
            const double a = 2 * pi * (k + 0.3) / COLUMNS, b = pi * r / ROWS;
            const double bump = RADIUS * (0.9 + 0.1 * sin(3 * a) * sin(5 * b));
            int16_t *p = s->pos[ball_at(k, r)];
            p[0] = rounded(bump * sin(b) * cos(a));
            p[1] = rounded(bump * cos(b));
            p[2] = rounded(bump * sin(b) * sin(a));
        }
    for (int r = 0; r < ROWS; r++)
        for (int k = 0; k < COLUMNS; k++) {
            if (r > 0)
                put_triangle(s, ball_at(k, r), ball_at(k + 1, r), ball_at(k, r + 1));
            if (r < ROWS - 1)
                put_triangle(s, ball_at(k + 1, r), ball_at(k + 1, r + 1), ball_at(k, r + 1));
        }
    s->one.mesh.n_verts = VERTS;
    zs_pose_turn(&s->one.instance.pose, 5000, 3500, 900);
}

/* A camera on a ball of this radius at this distance: it fills half of the frame's height. */
static void look(struct stage *s, double radius, double distance, double near_z)
{
    s->one.instance.pose.pos[2] = (int32_t)-distance;
    s->one.camera.focal = (zs_uq32_32)(fmin(H / 4.0 * distance / radius, 0x1p31) * 0x1p32);
    s->one.camera.z_near = (zs_q48_16)(near_z * 65536);
    s->one.camera.z_far = (zs_q48_16)((distance + 1.5 * radius) * 65536);
}

static void make_scaled(struct stage *s, int value)
{
    const double radius = RADIUS * ldexp(1, value), distance = fmax(1, floor(4 * radius));
    make_ball(s);
    s->one.mesh.scale = value > 15 ? ZS_Q16_ONE << (value - 15) : ZS_Q16_ONE;
    s->one.instance.pose.scale = (zs_uq16_16)(ldexp(65536, value > 15 ? 15 : value));
    look(s, radius, distance, distance - 1.5 * radius);
}

static void make_distant(struct stage *s, int value)
{
    make_ball(s);
    look(s, RADIUS, ldexp(RADIUS, value), ldexp(RADIUS, value) - 1.5 * RADIUS);
    if (value > 19)
        s->one.instance.pose.pos[2] = -(int32_t)fmin(ldexp(RADIUS, value), 2147483647.0);
}

/* Radius 2^14 units at 4 radii. */
static void make_near(struct stage *s, int value)
{
    make_ball(s);
    s->one.instance.pose.scale = 16 * ZS_Q16_ONE;
    look(s, RADIUS * 16, RADIUS * 64, RADIUS * 64 * ldexp(1, -value));
}

/* A corner at sub-pixel (x, y) from the middle, y down, at EXACT_Z or twice as far. */
static void put_exact(struct stage *s, int v, int32_t x, int32_t y, int farther)
{
    const int32_t p[3] = { x * (1 << farther), -y * (1 << farther), -(EXACT_Z << farther) };
    for (int c = 0; c < 3; c++) {
        s->pos[v][c] = (int16_t)(p[c] >> 8);
        s->pos_lo[v][c] = (uint8_t)(p[c] & 255);
    }
}

static void make_slivers(struct stage *s, int value)
{
    struct prng r = { (uint64_t)value + 1 };
    for (int k = 0; k < SLIVERS; k++) {
        const double angle = prng_real(&r, 0, 6.28), length = 110 * 256;
        const double wide = fmax(length * ldexp(1, -value), 1);
        const int32_t x = prng_range(&r, -60 * 256, 60 * 256), y = prng_range(&r, -45 * 256, 45 * 256);
        const int32_t dx = (int32_t)(length / 2 * cos(angle)), dy = (int32_t)(length / 2 * sin(angle));
        const int32_t ex = (int32_t)lround(-wide * sin(angle)), ey = (int32_t)lround(wide * cos(angle));
        put_exact(s, 3 * k, x - dx, y - dy, k & 1);
        put_exact(s, 3 * k + 1, x + dx, y + dy, k >> 1 & 1);
        put_exact(s, 3 * k + 2, x - dx + ex, y - dy + ey, k >> 2 & 1);
        put_triangle(s, 3 * k, 3 * k + 1, 3 * k + 2);
    }
    s->one.mesh.pos_lo = (const uint8_t(*)[3])s->pos_lo;
    s->one.mesh.n_verts = 3 * SLIVERS;
    s->one.mesh.scale = 256 * ZS_Q16_ONE;
    s->one.mesh.radius = 2000;
    s->one.material.cull = ZS_CULL_NONE;
    s->one.camera.focal = (zs_uq32_32)128 << 32;
    s->one.camera.z_near = (zs_q48_16)(EXACT_Z / 2) * 65536;
    s->one.camera.z_far = (zs_q48_16)(EXACT_Z * 4) * 65536;
}

static void make_floor(struct stage *s, int value)
{
    const double reach = 0x1p22, near_end = ldexp(reach, -value), unit = reach / 32000;
    static const double side[4] = { -1, 1, 1, -1 };
    for (int v = 0; v < 4; v++) {
        const double z = v < 2 ? near_end : reach;
        const double p[3] = { side[v] * (v < 2 ? 1.2 * near_end : fmin(reach, 40 * near_end)), -0.4 * near_end, -z };
        for (int c = 0; c < 3; c++) {
            const double steps = floor(p[c] / unit * 256 + 0.5), whole = floor(steps / 256);
            s->pos[v][c] = (int16_t)whole;
            s->pos_lo[v][c] = (uint8_t)(steps - whole * 256);
        }
        s->uv[v][0] = (int16_t)(8 + side[v] * 4096 * (v < 2 ? 0.03 : 1)); /* 16 to a texel: not on a border */
        s->uv[v][1] = (int16_t)(v < 2 ? 4096 - 8 : 8);
    }
    for (uint32_t k = 0; k < 65536; k++)
        s->texel[k] = (uint16_t)(((k >> 3 ^ k >> 11) & 1u ? 0xffffu : 0x3186u) ^ (k & 7u) << 6);
    put_triangle(s, 0, 1, 2);
    put_triangle(s, 0, 2, 3);
    s->texture = (struct zs_texture){ .format = &zs_texel_565, .texel = s->texel, .log2_w = 8, .log2_h = 8 };
    s->one.material = (struct zs_material){ .shader = &zs_shade_texture, .cull = ZS_CULL_NONE, .texture = &s->texture };
    s->one.mesh.pos_lo = (const uint8_t(*)[3])s->pos_lo;
    s->one.mesh.uv = (const int16_t(*)[2])s->uv;
    s->one.mesh.uv_bits = 12;
    s->one.mesh.n_verts = 4;
    s->one.mesh.scale = (zs_uq16_16)(unit * 65536);
    s->one.mesh.radius = 50000;
    s->one.camera.z_near = (zs_q48_16)(near_end / 2 * 65536);
    s->one.camera.z_far = (zs_q48_16)(reach * 2 * 65536);
}

static void make(struct stage *s, const struct run *r)
{
    static void (*const of[N_PARTS])(struct stage *, int) = { [SCALE] = make_scaled,
                                                              [DISTANCE] = make_distant,
                                                              [NEAR] = make_near,
                                                              [SLIVER] = make_slivers,
                                                              [RATIO] = make_floor };
    stage_begin(s);
    of[r->part](s, r->value);
}

/* ---- Runs
 * --------------------------------------------------------------------------------------------------------------- */

static double percent(size_t part, size_t whole)
{
    return whole ? 100.0 * (double)part / (double)whole : 0.0;
}

static int measure(size_t i, struct study_text *row)
{
    const struct run *r = &runs[i];
    if (r->part == ROTATION || r->part == WANDER) {
        study_put(row, "OK");
        study_skip(row, 7);
        study_put(row, "%.4g", sim_rotation_drift(1, (uint32_t)r->value, r->part == WANDER));
        return SIM_OK;
    }
    struct stage *s = sim_alloc(1, sizeof *s);
    struct study_frame f;
    make(s, r);
    const int err = study_frame_open(&f, &s->one.scene, &s->one.camera, &s->one.config);
    free(s);
    if (err < -100)
        return sim_refuse(NULL, 0, "study stability: %s %d: a frame is broken (%d)", part_name[r->part], r->value, err);
    study_put(row, "%s", study_error_name(err));
    if (err) {
        study_skip(row, 8);
        return SIM_OK;
    }
    study_put(row, "%zu", f.diff.ref_drawn);
    study_put(row, "%.4g", percent(f.diff.id_differ, f.diff.ref_drawn));
    study_put(row, "%.4g", percent(f.diff.missing + f.diff.extra, f.diff.ref_drawn));
    study_put(row, "%zu", f.unexplained);
    study_put(row, "%.4g", f.key_beyond);
    study_put(row, "%.4g", percent(f.diff.texel_differ, f.diff.texels));
    study_put(row, "%.4g", f.diff.texel_max_distance);
    study_skip(row, 1);
    study_frame_free(&f);
    return SIM_OK;
}

/* ---- What follows
 * -------------------------------------------------------------------------------------------------------- */

/* What a part is judged by. */
static const struct {
    const char *title, *axis, *of, *column, *column2; /* columns are added */
    double bound;                                     /* promised; 0: none */
} judged[N_PARTS] = {
    { "scale", "log2 of the scale", "wrong or missing pixels, %", "wrong", "cover", 0 },
    { "distance", "log2 of distance / radius", "wrong or missing pixels, %", "wrong", "cover", 0 },
    { "near plane", "log2 of distance / near", "depth beyond snapping, buckets", "key_beyond", NULL, 0.505 },
    { "slivers", "log2 of length / width", "wrong or missing pixels, %", "wrong", "cover", 0 },
    { "the same rotation", "rotations", "sub-pixels", "drift", NULL, 1 },
    { "random rotations", "rotations", "sub-pixels", "drift", NULL, 1 },
    { "ratio of w", "log2 of the ratio", "texels", "texel_worst", NULL, 0.5 },
};

static double error_of(const struct study_table *t, size_t r, enum part p)
{
    return study_number(t, r, judged[p].column) + (judged[p].column2 ? study_number(t, r, judged[p].column2) : 0);
}

static int plot(struct study_page *page, const struct study_table *t)
{
    FILE *f = study_plot_open(page, "errors", 900, 1000);
    if (!f)
        return SIM_REFUSED;
    (void)fputs("set multiplot layout 4,2\nset key off\nset yrange [0:*]\n", f);
    for (int p = 0; p < N_PARTS; p++) {
        double most = 0;
        (void)fprintf(f, "$ok%d << EOD\n", p);
        for (size_t r = 0; r < t->n_rows; r++)
            if (study_is(t, r, "part", part_name[p]) && study_is(t, r, "status", "OK")) {
                (void)fprintf(f, "%s\t%.6g\n", study_cell(t, r, "value"), error_of(t, r, (enum part)p));
                most = fmax(most, error_of(t, r, (enum part)p));
            }
        (void)fprintf(f, "EOD\n$refused%d << EOD\n-999\t0\n", p);
        for (size_t r = 0; r < t->n_rows; r++)
            if (study_is(t, r, "part", part_name[p]) && !study_is(t, r, "status", "OK"))
                (void)fprintf(f, "%s\t0\n", study_cell(t, r, "value"));
        const int log = p == ROTATION || p == WANDER;
        (void)fprintf(
            f,
            "EOD\n%sset logscale x\nset title '%s'\nset xlabel '%s'\nset ylabel '%s'\nset yrange [0:%g]\nset xrange "
            "[%s]\nplot $ok%d with linespoints lc rgb '#1f77b4' pt 7 ps 0.5, $refused%d with points pt 2 ps 0.8 lc rgb "
            "'#d62728'",
            log ? "" : "un", judged[p].title, judged[p].axis, judged[p].of,
            most > 0 ? 1.2 * fmax(most, judged[p].bound) : 1,
            p == SCALE ? "-17:17"
            : log      ? "1:1e6"
                       : "0:24",
            p, p);
        if (judged[p].bound > 0)
            (void)fprintf(f, ", %g with lines dt 2 lc rgb '#888888'", judged[p].bound);
        (void)fputs("\n", f);
    }
    (void)fputs("unset multiplot\n", f);
    return study_plot_close(
        page, "Errors over the range of each quantity. Crosses: refused by name. Dashed: what is promised.");
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Half of a part's errors are below it. */
static double median(const struct study_table *t, enum part p)
{
    double *error = sim_alloc(t->n_rows, sizeof *error);
    size_t n = 0;
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "part", part_name[p]) && study_is(t, r, "status", "OK"))
            error[n++] = error_of(t, r, p);
    qsort(error, n, sizeof *error, by_size);
    const double v = n ? error[n / 2] : 0;
    free(error);
    return v;
}

static void table(struct study_page *page, const struct study_table *t)
{
    study_table_open(
        page,
        "what|from|to|error, median|where the range ends|worst|at||promised|pixels that nothing explains|refused");
    for (int p = 0; p < N_PARTS; p++) {
        size_t first = t->n_rows, last = first, worst = first;
        double unexplained = 0;
        char refused[256] = "";
        size_t n = 0;
        for (size_t r = 0; r < t->n_rows; r++) {
            if (!study_is(t, r, "part", part_name[p]))
                continue;
            if (!study_is(t, r, "status", "OK")) {
                if (!strstr(refused, study_cell(t, r, "status")) && n < sizeof refused - 60)
                    n += (size_t)snprintf(refused + n, sizeof refused - n, "%sfrom %s: %s", n ? ", " : "",
                                          study_cell(t, r, "value"), study_cell(t, r, "status"));
                continue;
            }
            first = first == t->n_rows ? r : first;
            last = r;
            if (worst == t->n_rows || error_of(t, r, (enum part)p) > error_of(t, worst, (enum part)p))
                worst = r;
            if (!isnan(study_number(t, r, "unexplained")))
                unexplained += study_number(t, r, "unexplained");
        }
        if (first == t->n_rows)
            continue;
        char promised[32] = "";
        if (judged[p].bound > 0)
            (void)snprintf(promised, sizeof promised, "%g", judged[p].bound);
        study_table_row(page, "%s|%s|%s|%.3g|%.3g|%.3g|%s|%s|%s|%.0f|%s", judged[p].title,
                        study_cell(t, first, "value"), study_cell(t, last, "value"), median(t, (enum part)p),
                        error_of(t, last, (enum part)p), error_of(t, worst, (enum part)p),
                        study_cell(t, worst, "value"), judged[p].of, promised, unexplained, refused);
    }
    study_table_close(
        page, "Values are log2 but for rotations. Explained: by a corner snapped to sub-pixels and camera units, or by "
              "keys within 1.01 buckets (sim/compare/error_bound.h).");
}

static int picture(struct study_page *page, const struct study_table *t)
{
    size_t worst = t->n_rows;
    char caption[256];
    struct study_frame f;
    for (size_t r = 0; r < t->n_rows; r++)
        if (study_is(t, r, "status", "OK") && !isnan(study_number(t, r, "wrong")) &&
            (worst == t->n_rows || study_number(t, r, "wrong") + study_number(t, r, "cover") >
                                       study_number(t, worst, "wrong") + study_number(t, worst, "cover")))
            worst = r;
    if (worst == t->n_rows)
        return SIM_OK;
    struct stage *s = sim_alloc(1, sizeof *s);
    uint8_t *rgb = sim_alloc((size_t)2 * W * H, 3);
    make(s, &runs[worst]);
    const int err = study_frame_open(&f, &s->one.scene, &s->one.camera, &s->one.config);
    int status = err ? sim_refuse(NULL, 0, "study stability: %s", zs_error_string(err)) : SIM_OK;
    if (!err) {
        study_sheet_put(rgb, 2 * W, 0, 0, f.rgb565, NULL, W, H);
        study_sheet_put(rgb, 2 * W, W, 0, f.rgb565, f.wrong, W, H);
        study_frame_free(&f);
        (void)snprintf(caption, sizeof caption,
                       "The worst case: %s at %s, %s %% of the pixels show another triangle, %s %% are missing "
                       "or too many (right, in magenta: of another plane).",
                       study_cell(t, worst, "part"), study_cell(t, worst, "value"), study_cell(t, worst, "wrong"),
                       study_cell(t, worst, "cover"));
        status = study_picture(page, "worst", 2 * W, H, rgb, caption);
    }
    free(rgb);
    free(s);
    return status;
}

/* The worst of what has a bound, as a part of it, and of what has none. */
static void say_worst(struct study_page *page, const struct study_table *t)
{
    double part = -1, most = -1;
    int of = 0, in = 0;
    const char *at = "";
    for (int p = 0; p < N_PARTS; p++)
        for (size_t r = 0; r < t->n_rows; r++) {
            if (!study_is(t, r, "part", part_name[p]) || !study_is(t, r, "status", "OK"))
                continue;
            const double error = error_of(t, r, (enum part)p), bound = judged[p].bound;
            if (bound > 0 && error / bound > part) {
                part = error / bound;
                of = p;
            } else if (!(bound > 0) && error > most) {
                most = error;
                in = p;
                at = study_cell(t, r, "value");
            }
        }
    study_say(page,
              "Where a bound is promised, the worst is %.1f %% of it (%s); where none is, at most %.2g %% of the "
              "pixels are wrong (%s, at %s).",
              100 * part, judged[of].title, most, judged[in].title, at);
}

static int report(struct study_page *page, const struct study_table *t)
{
    size_t refused = 0;
    double unexplained = 0;
    for (size_t r = 0; r < t->n_rows; r++) {
        refused += !study_is(t, r, "status", "OK");
        if (!isnan(study_number(t, r, "unexplained")))
            unexplained += study_number(t, r, "unexplained");
    }
    study_say(page,
              "Varied, one at a time: the scale of a model, how far away it is, the near plane, how thin triangles "
              "are, how often "
              "rotations were composed, and how much farther a floor's end is than its beginning. Each against the "
              "double-precision reference, to beyond what the renderer accepts.");
    const int status = plot(page, t);
    if (status != SIM_OK)
        return status;
    study_say(page,
              "Of %zu runs, %zu were refused, each by a name; of the pixels of all others, %.0f cannot be explained by "
              "corners "
              "snapped to sub-pixels or keys rounded to buckets.",
              t->n_rows, refused, unexplained);
    say_worst(page, t);
    table(page, t);
    return picture(page, t);
}

const struct study study_stability = {
    .name = "stability", .what = "the worst error where ranges end",
    .params = "part,value", .results = "status,pixels,wrong,cover,unexplained,key_beyond,texels_off,texel_worst,drift",
    .runs = plan, .describe = describe, .measure = measure, .report = report,
};
