/* False colours.
 *
 * SPDX-License-Identifier: MIT
 */
#include "false_colors.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pixel_counts.h"
#include "accelerator_names.h"
#include "gen/font.h"
#include "sim.h"
#include "scene_reference.h"
#include "write_counts.h"

/* The legend, px: a line of text, a bar, its numbers. */
#define WIDTH_LEAST 220
#define TEXT_Y 4
#define BAR_Y (TEXT_Y + FONT_H + 3)
#define BAR_H 8
#define NUMBER_Y (BAR_Y + BAR_H + 3)
#define LEGEND_H (NUMBER_Y + FONT_H + 4)
#define LETTER_W (FONT_W + 1)

#define MOST_LEAST 8u /* counts up to it have the same colours in all pictures */
#define WHITE 0xffffu
#define BLACK 0u
#define GREY 0x4208u /* drawn, and no key compared */

struct canvas {
    uint32_t w, h, frame_h; /* px; the legend begins at frame_h */
    uint16_t *px;           /* [h][w] RGB565 */
};

/* ---- Colours ------------------------------------------------------------------------------------------- */

/* 0: blue ... 1: white. */
static uint16_t ramp(double t)
{
    static const struct zs_rgb stop[] = { { 0, 0, 140 },   { 0, 110, 255 }, { 0, 200, 200 }, { 40, 200, 40 },
                                          { 250, 220, 0 }, { 250, 60, 0 },  { 255, 255, 255 } };
    const int last = (int)(sizeof stop / sizeof stop[0]) - 1;
    const double at = t * last;
    const int k = at >= last ? last - 1 : (int)at;
    const double part = at - k;
    const struct zs_rgb *a = &stop[k], *b = a + 1;
    return zs_rgb565((uint8_t)(a->r + (b->r - a->r) * part + 0.5), (uint8_t)(a->g + (b->g - a->g) * part + 0.5),
                     (uint8_t)(a->b + (b->b - a->b) * part + 0.5));
}

/* Of a count: black is 0, white the top of the scale. */
static uint16_t count_color(uint32_t n, uint32_t top)
{
    return n == 0 ? BLACK : ramp((double)(n - 1) / (double)(top - 1));
}

/* The top of the scale of counts up to `most`. */
static uint32_t scale_top(uint32_t most)
{
    return most < MOST_LEAST ? MOST_LEAST : most;
}

/* ---- Legend -------------------------------------------------------------------------------------------- */

/* Small letters become capitals; what the font lacks is a blank. */
static void text_put(struct canvas *c, uint32_t x, uint32_t y, const char *text)
{
    for (; *text != '\0' && x + FONT_W <= c->w; text++, x += LETTER_W) {
        const uint8_t *rows = font_rows((char)toupper((unsigned char)*text));
        for (uint32_t j = 0; rows != NULL && j < FONT_H; j++)
            for (uint32_t i = 0; i < FONT_W; i++)
                if (rows[j] >> (FONT_W - 1 - i) & 1)
                    c->px[(y + j) * c->w + x + i] = WHITE;
    }
}

/* A number below the bar, about its middle at column x, inside the picture. */
static void number_put(struct canvas *c, uint32_t x, const char *text)
{
    const uint32_t w = (uint32_t)strlen(text) * LETTER_W, half = w / 2;
    const uint32_t left = x < half ? 0 : x - half;
    text_put(c, left + w > c->w ? c->w - w : left, c->frame_h + NUMBER_Y, text);
}

static void bar_column(struct canvas *c, uint32_t x, uint16_t color)
{
    for (uint32_t y = 0; y < BAR_H; y++)
        c->px[(c->frame_h + BAR_Y + y) * c->w + x] = color;
}

/* A block for each count from 0 to the top, numbered where there is room. */
static void count_legend(struct canvas *c, uint32_t top)
{
    char text[16];
    const uint64_t n = (uint64_t)top + 1;
    (void)snprintf(text, sizeof text, "%u", top);
    const double room = (double)(strlen(text) + 1) * LETTER_W, block = (double)c->w / (double)n;
    uint64_t step = 1;
    for (int k = 0; (double)step * block < room; k++) /* 1, 2, 5, 10, 20 ... */
        step = k % 3 == 1 ? step / 2 * 5 : step * 2;
    for (uint32_t x = 0; x < c->w; x++)
        bar_column(c, x, count_color((uint32_t)(x * n / c->w), top));
    for (uint64_t v = 0; v < n; v += step) {
        (void)snprintf(text, sizeof text, "%u", (uint32_t)v);
        number_put(c, (uint32_t)(((double)v + 0.5) * block), text);
    }
}

/* A distance in few letters, which the font has: 1.23e+10 is 1.23e10. */
static void distance_text(char *text, size_t room, double z)
{
    (void)snprintf(text, room, fabs(z) >= 1000.0 && fabs(z) < 1e7 ? "%.0f" : "%.3g", z);
    char *plus = strchr(text, '+');
    if (plus != NULL)
        memmove(plus, plus + 1, strlen(plus));
}

static void distance_legend(struct canvas *c, double nearest, double farthest)
{
    char text[5][32];
    size_t longest = 0;
    for (uint32_t x = 0; x < c->w; x++)
        bar_column(c, x, ramp(1.0 - (x + 0.5) / c->w));
    for (int k = 0; k <= 4; k++) {
        distance_text(text[k], sizeof text[k], nearest + (farthest - nearest) * k / 4.0);
        longest = strlen(text[k]) > longest ? strlen(text[k]) : longest;
    }
    for (uint32_t k = 0; k <= 4; k += (longest + 2) * LETTER_W * 4 > c->w ? 2 : 1)
        number_put(c, c->w * k / 4, text[k]);
}

/* ---- Pictures ------------------------------------------------------------------------------------------ */

uint32_t sim_show_width(uint32_t w)
{
    return w < WIDTH_LEAST ? WIDTH_LEAST : w;
}

uint32_t sim_show_height(uint32_t h)
{
    return h + LEGEND_H;
}

/* Of the frame, which lies at the left. */
static uint16_t *pixel(struct canvas *c, const struct sim_frame *f, size_t i)
{
    return &c->px[i / f->width * c->w + i % f->width];
}

static void show_counts(struct canvas *c, struct sim_show_sum *sum, const struct sim_frame *f, const uint32_t *map,
                        const char *what)
{
    const size_t n = (size_t)f->width * f->height;
    uint32_t most = 0, visible = 0;
    char text[64];
    for (size_t i = 0; i < n; i++) {
        most = map[i] > most ? map[i] : most;
        visible += map[i] > 0;
        sum->sum += map[i];
    }
    for (size_t i = 0; i < n; i++)
        *pixel(c, f, i) = count_color(map[i], scale_top(most));
    sum->most = most;
    (void)snprintf(text, sizeof text, "%s - mean %.2f - most %u", what, visible > 0 ? sum->sum / visible : 0.0, most);
    text_put(c, 1, c->frame_h + TEXT_Y, text);
    count_legend(c, scale_top(most));
}

static void show_tested(struct canvas *c, struct sim_show_sum *sum, const struct sim_counts *counts)
{
    const struct sim_frame *f = &counts->frame;
    const size_t n = (size_t)f->width * f->height;
    uint32_t *map = sim_alloc(n, sizeof *map);
    for (size_t i = 0; i < n; i++)
        map[i] = counts->tested[i] - counts->untested[i];
    show_counts(c, sum, f, map, "tested");
    for (size_t i = 0; i < n; i++)
        if (map[i] == 0 && counts->untested[i])
            *pixel(c, f, i) = GREY;
    free(map);
}

static void show_distances(struct canvas *c, const struct sim_frame *f, const struct zs_camera *camera,
                           const struct zs_config *config, double unit)
{
    const size_t n = (size_t)f->width * f->height;
    const struct ref_depth depth = { sim_reference_mapping(config->depth, camera), config->depth_bits };
    struct ref_camera eye;
    double *z = sim_alloc(n, sizeof *z), nearest = DBL_MAX, farthest = -DBL_MAX;
    sim_reference_camera(&eye, camera);
    for (size_t i = 0; i < n; i++) {
        if (f->key[i] == ZS_DEPTH_CLEAR)
            continue;
        z[i] = ref_key_to_z(&depth, &eye, f->key[i]) * unit;
        nearest = z[i] < nearest ? z[i] : nearest;
        farthest = z[i] > farthest ? z[i] : farthest;
    }
    const double span = farthest > nearest ? farthest - nearest : 1.0;
    for (size_t i = 0; i < n; i++)
        *pixel(c, f, i) = f->key[i] == ZS_DEPTH_CLEAR ? BLACK : ramp(1.0 - (z[i] - nearest) / span);
    free(z);
    const int drawn = farthest >= nearest;
    text_put(c, 1, c->frame_h + TEXT_Y, drawn ? "distance" : "distance - nothing drawn");
    if (drawn)
        distance_legend(c, nearest, farthest);
}

static void show_strips(struct canvas *c, struct sim_show_sum *sum, const struct sim_counts *counts, uint32_t rows)
{
    const struct sim_frame *f = &counts->frame;
    const size_t n = (size_t)f->width * f->height;
    uint32_t most = 0;
    char text[64];
    for (uint32_t s = 0; s < counts->n_strips; s++) {
        most = counts->setups[s] > most ? counts->setups[s] : most;
        sum->sum += counts->setups[s];
    }
    for (size_t i = 0; i < n; i++) {
        const uint32_t y = (uint32_t)(i / f->width), v = counts->setups[y / rows];
        const int gap = rows > 2 && y % rows == rows - 1; /* between bars */
        if (!gap && (uint64_t)(i % f->width) * most < (uint64_t)v * f->width)
            *pixel(c, f, i) = count_color(v, scale_top(most));
        else
            *pixel(c, f, i) = f->rgb565[i] >> 2 & 0x39e7; /* a quarter of its brightness */
    }
    sum->most = most;
    (void)snprintf(text, sizeof text, "set-ups a strip - mean %.1f - most %u", sum->sum / counts->n_strips, most);
    text_put(c, 1, c->frame_h + TEXT_Y, text);
    count_legend(c, scale_top(most));
}

/* The overdraw of a method: its frame is drawn by no other, so the shader counts. */
static int show_writes(struct sim_picture *out, struct sim_show_sum *sum, const struct zs_scene *scene,
                       const struct zs_camera *camera, const struct zs_config *config)
{
    const struct sim_frame size = { .width = config->width, .height = config->height };
    struct canvas c = { sim_show_width(config->width), sim_show_height(config->height), config->height, NULL };
    uint32_t *written = sim_alloc((size_t)config->width * config->height, sizeof *written);
    const int err = sim_writes_count(written, NULL, scene, camera, config);
    if (!err) {
        c.px = sim_alloc((size_t)c.w * c.h, sizeof *c.px);
        show_counts(&c, sum, &size, written, "overdraw");
        sim_picture_565(out, c.w, c.h, c.px);
    }
    SIM_FREE(written, c.px);
    return err;
}

int sim_show_draw(struct sim_picture *out, struct sim_show_sum *sum, enum sim_show kind, const struct zs_scene *scene,
                  const struct zs_camera *camera, const struct zs_config *config, double unit)
{
    struct sim_counts counts;
    struct sim_show_sum none, *to = sum != NULL ? sum : &none;
    struct zs_config with = *config;
    struct sim_fast fast;
    sim_fast_without(&fast, config->fast, &zs_fast_tiles);
    if (kind == SIM_SHOW_COMPLEXITY)
        with.fast = fast.list;
    memset(to, 0, sizeof *to);
    memset(out, 0, sizeof *out);
    if (config->method)
        return show_writes(out, to, scene, camera, config);
    const int err = sim_counts_draw(&counts, scene, camera, &with);
    if (err != ZS_OK)
        return err;
    struct canvas c = { sim_show_width(config->width), sim_show_height(config->height), config->height, NULL };
    c.px = sim_alloc((size_t)c.w * c.h, sizeof *c.px);
    if (kind == SIM_SHOW_DEPTH)
        show_distances(&c, &counts.frame, camera, config, unit);
    else if (kind == SIM_SHOW_STRIPS)
        show_strips(&c, to, &counts, config->strip_h);
    else if (kind == SIM_SHOW_OVERDRAW)
        show_counts(&c, to, &counts.frame, counts.written, "overdraw");
    else if (kind == SIM_SHOW_COMPLEXITY)
        show_counts(&c, to, &counts.frame, counts.tested, "complexity");
    else
        show_tested(&c, to, &counts);
    sim_picture_565(out, c.w, c.h, c.px);
    free(c.px);
    sim_counts_free(&counts);
    return ZS_OK;
}
