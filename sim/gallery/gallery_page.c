/* The gallery's page.
 *
 * SPDX-License-Identifier: MIT
 */
#define _GNU_SOURCE /* open_memstream */
#include "gallery_page.h"

#include <stdlib.h>

#include "base64.h"
#include "sim.h"

/* A picture as a PNG in a data URI. */
static void put_picture(FILE *f, const struct sim_picture *p, const char *what)
{
    char *png = NULL;
    size_t n = 0;
    FILE *to = open_memstream(&png, &n);
    if (to == NULL || sim_png_write(to, "gallery", p->width, p->height, p->rgb) != SIM_OK || fclose(to) != 0)
        exit(SIM_REFUSED);
    char *const text = sim_alloc(SIM_BASE64_CHARS(n), 1);
    sim_base64_encode(text, png, n);
    (void)fprintf(f, "<img width=%u height=%u alt=\"%s\" src=\"data:image/png;base64,%s\">\n", p->width, p->height,
                  what, text);
    SIM_FREE(png, text);
}

static void put_count(FILE *f, double n)
{
    if (n >= 1e6)
        (void)fprintf(f, "<td>%.2f M", n / 1e6);
    else
        (void)fprintf(f, "<td>%.0f", n);
}

static void put_card(FILE *f, const struct sim_method *m, const struct gallery_shot *shot,
                     const char *const scene[GALLERY_SCENES])
{
    (void)fprintf(
        f, "<section id=%s><h2>%s</h2>\n<p>%s <em>%s</em></p>\n<p><code>zsim render MODEL --method %s</code></p>\n",
        m->name, m->title, m->take, m->fails, m->name);
    for (size_t i = 0; i < GALLERY_SCENES; i++) {
        (void)fputs("<figure>\n", f);
        put_picture(f, &shot[i].picture, scene[i]);
        put_picture(f, &shot[i].overdraw, "overdraw");
        (void)fprintf(f, "<figcaption>%s: %u wrong pixels of %u; %.2f writes a visible pixel<br>%u bytes of RAM, %u of "
                         "them depth; %s%.2f M instructions</figcaption></figure>\n",
                      scene[i], shot[i].wrong, shot[i].pixels,
                      shot[i].visible ? (double)shot[i].written / (double)shot[i].visible : 0.0, shot[i].arena_bytes,
                      shot[i].depth_bytes, shot[i].estimated ? "~" : "", shot[i].instructions / 1e6);
    }
    (void)fputs("</section>\n", f);
}

static void put_effect(FILE *f, const struct gallery_effect *e, const struct sim_picture *picture)
{
    (void)fprintf(f, "<section id=%s class=effect><h2>%s</h2>\n", e->id, e->title);
    put_picture(f, picture, e->title);
    (void)fprintf(f, "<p>%s <em>%s</em></p>\n<p><code>zsim render MODEL %s</code></p></section>\n", e->take, e->fails,
                  e->options);
}

static void put_row(FILE *f, const struct sim_method *m, const struct gallery_shot *s)
{
    (void)fprintf(f, "<tr><th>%s", m->title);
    put_count(f, s->arena_bytes);
    put_count(f, s->depth_bytes);
    (void)fprintf(f, "<td>%s%.2f M", s->estimated ? "~" : "", s->instructions / 1e6);
    put_count(f, s->stats.pixels_tested);
    put_count(f, s->written);
    put_count(f, s->visible);
    put_count(f, s->stats.sorted);
    put_count(f, s->stats.splits);
    put_count(f, s->stats.rays);
    put_count(f, s->wrong);
    (void)fputs("\n", f);
}

void gallery_page_write(FILE *f, struct gallery_shot (*shot)[GALLERY_SCENES], const char *const scene[GALLERY_SCENES],
                        const struct sim_picture *effect)
{
    (void)fputs(
        "<!DOCTYPE html>\n<html lang=en><meta charset=utf-8><title>zstrip: visible surfaces</title>\n"
        "<style>body{font:16px sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem}figure{display:inline-block;"
        "margin:.5rem}figcaption{font-size:.8rem}table{border-collapse:collapse}td,th{padding:.2rem .6rem;text-align:"
        "right;border-bottom:1px solid #ccc}th{text-align:left}"
        ".effect{display:inline-block;width:17rem;vertical-align:top;margin:.5rem}"
        ".effect code{font-size:.75rem}img{max-width:100%;height:auto;outline:1px solid #ccc}</style>\n"
        "<h1>Which surfaces are seen: the methods side by side</h1>\n"
        "<p>Each method draws the same scenes with integers alone, strip by strip. The left picture is the frame, "
        "the right one its overdraw: how often each pixel was coloured.</p>\n",
        f);
    for (size_t i = 0; i < GALLERY_SCENES; i++) {
        (void)fprintf(
            f,
            "<h2>Scene %s</h2>\n<table><tr><th>method<th>arena, bytes<th>of it depth<th>instructions, Cortex-M3"
            "<th>fragments<th>writes<th>visible<th>sorted<th>splits<th>rays<th>wrong pixels\n",
            scene[i]);
        for (size_t m = 0; m < SIM_METHODS; m++)
            put_row(f, &sim_methods[m], &shot[m][i]);
        (void)fputs("</table>\n", f);
    }
    (void)fputs(
        "<p>Fragments: pixels of triangles before hidden ones are left out. Wrong pixels: those that do not show the "
        "triangle that the double-precision reference shows. Instructions with a ~ are estimates of zsim budget; make "
        "gallery counts them on an emulated core.</p>\n",
        f);
    for (size_t m = 0; m < SIM_METHODS; m++)
        put_card(f, &sim_methods[m], shot[m], scene);
    for (size_t k = 0; k < GALLERY_EFFECTS; k++) {
        if (k == 0 || k == GALLERY_LINES)
            (void)fprintf(f, "<h1>%s</h1>\n<p>The demo's teapot by options of zsim render. A program that uses none of "
                             "them does not link them.</p>\n",
                          k == 0 ? "Lines and points" : "Light, transparency, reflection, shadow");
        put_effect(f, &gallery_effects[k], &effect[k]);
    }
    (void)fputs("</html>\n", f);
}
