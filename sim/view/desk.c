/* The side is one list of rows, from the top.
 *
 * SPDX-License-Identifier: MIT
 */
#include "desk.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "sim.h"

/* Where the next row of the side goes. */
struct column {
    struct view_canvas *canvas;
    int x, y, pitch;
};

/* ---- Rows -------------------------------------------------------------------------------------------- */

static void heading(struct column *at, const char *text)
{
    at->y += at->pitch / 2;
    view_canvas_text(at->canvas, at->x, at->y, VIEW_ACCENT, 0, VIEW_SIDE_CELLS, text);
    at->y += at->pitch;
    view_canvas_fill(at->canvas, at->x, at->y, VIEW_SIDE_CELLS * VIEW_CELL_W, 1, VIEW_LINE);
    at->y += 4;
}

/* A name on the left, what it is on the right. */
__attribute__((format(printf, 4, 5)))
static void row(struct column *at, uint16_t color, const char *name, const char *format, ...)
{
    char text[VIEW_SIDE_CELLS + 64];
    va_list args;
    va_start(args, format);
    (void)vsnprintf(text, sizeof text, format, args);
    va_end(args);
    const int n = (int)strlen(name);
    view_canvas_text(at->canvas, at->x, at->y, VIEW_DIM, 0, VIEW_SIDE_CELLS, name);
    view_canvas_text(at->canvas, at->x + VIEW_SIDE_CELLS * VIEW_CELL_W, at->y, color, ZS_ITEM_RIGHT,
                     VIEW_SIDE_CELLS - n - 1, text);
    at->y += at->pitch;
}

static void settings(struct column *at, const struct view_desk *d)
{
    heading(at, "Settings");
    for (int i = 0; i < n_view_settings; i++) {
        const struct view_setting *s = &view_settings[i];
        char name[32], text[VIEW_VALUE_MAX], key[2] = { s->key };
        if (!view_setting_there(s, d->wish))
            continue;
        (void)snprintf(name, sizeof name, "  %s", s->name);
        view_setting_text(s, d->wish, d->shot, text);
        view_canvas_text(at->canvas, at->x, at->y, VIEW_ACCENT, 0, 3, key);
        row(at, view_words_get(d->wish, s->option) != NULL ? VIEW_INK : VIEW_DIM, name, "%s", text);
    }
}

static void frame(struct column *at, const struct view_desk *d)
{
    const struct zs_stats *s = &d->shot->seen.frame.stats;
    const uint32_t view = s->tris_frustum + s->tris_offscreen + s->tris_near + s->tris_far;
    const char *start = view_words_get(&d->shot->words, "--start");
    heading(at, "Frame");
    if (d->shot->words.model == NULL)
        row(at, VIEW_INK, "of the animation", "%s of %u", start != NULL ? start : "0", d->shot->n_frames);
    row(at, VIEW_INK, "triangles drawn", "%u of %u", s->tris_drawn, s->tris_in);
    row(at, s->passes > 1 ? VIEW_ACCENT : VIEW_INK, "passes", "%u", s->passes);
    heading(at, "Skipped");
    row(at, VIEW_INK, "in clusters turned away", "%u", s->tris_cluster);
    row(at, VIEW_INK, "triangles turned away", "%u", s->tris_facing);
    row(at, VIEW_INK, "out of view", "%u", view);
    row(at, VIEW_INK, "too small to be seen", "%u", s->tris_empty + s->tris_zero);
    row(at, VIEW_INK, "set-ups hidden", "%u of %u", s->tris_hidden, s->tris_hidden + s->tris_setup);
    row(at, VIEW_INK, "pixels untested", "%u of %u", s->pixels_untested, s->pixels_tested);
}

static void memory(struct column *at, const struct view_figures *f)
{
    const struct budget_ram *r = &f->ram;
    heading(at, f->plain ? "RAM, bytes, of plain faces" : "RAM, bytes");
    if (!f->known) {
        row(at, VIEW_INK, "not counted", "-");
        return;
    }
    row(at, VIEW_INK, "strip buffers", "%u", r->color);
    row(at, VIEW_INK, "depth keys, tiles, bins", "%u", r->depth + r->tiles + r->bins);
    row(at, VIEW_INK, "triangles", "%u", r->tris);
    row(at, VIEW_INK, "vertices", "%u", r->verts + r->numbers + r->attrs);
    row(at, VIEW_INK, "renderer, scene, panel", "%u", r->fixed);
    row(at, VIEW_INK, "together, with the stack", "%u", r->total[BUDGET_M3]);
}

static void speed(struct column *at, const struct view_figures *f)
{
    char text[64];
    (void)snprintf(text, sizeof text, "Frames a second, give or take %.0f %%", f->error);
    heading(at, f->error > 0.0 ? text : "Frames a second, estimated");
    for (int i = 0; i < BUDGET_USUAL_PARTS; i++) {
        char name[32];
        (void)snprintf(name, sizeof name, "%s%s", budget_usual_parts[i],
                       f->known && f->too_small[i] ? ", too small" : "");
        if (f->known && isfinite(f->fps[i]))
            row(at, VIEW_INK, name, "%.1f", f->fps[i]);
        else
            row(at, VIEW_INK, name, "-");
    }
}

/* ---- Parts of the window ----------------------------------------------------------------------------- */

static void side(struct view_canvas *c, const struct view_desk *d, int x)
{
    const int fits = c->h / VIEW_SIDE_LINES;
    struct column at = { c, x + VIEW_MARGIN, VIEW_MARGIN / 2,
                         fits >= VIEW_PITCH ? VIEW_PITCH : fits < VIEW_CELL_H ? VIEW_CELL_H : fits };
    view_canvas_fill(c, x, 0, VIEW_SIDE_W, c->h, VIEW_SIDE);
    settings(&at, d);
    frame(&at, d);
    memory(&at, d->figures);
    speed(&at, d->figures);
}

static void bar(struct view_canvas *c, const struct view_desk *d, int w, int y)
{
    const int n = (w - 2 * VIEW_MARGIN) / VIEW_CELL_W;
    view_canvas_fill(c, 0, y, w, 1, VIEW_LINE);
    y += VIEW_MARGIN / 2;
    const int lines = view_canvas_lines(c, VIEW_MARGIN, y, d->refused ? VIEW_ACCENT : VIEW_INK, n, VIEW_BAR_LINES - 1,
                                        VIEW_PITCH, d->said);
    (void)view_canvas_lines(c, VIEW_MARGIN, y + lines * VIEW_PITCH, VIEW_DIM, n, VIEW_BAR_LINES - lines, VIEW_PITCH,
                            d->line);
}

static void keys(struct view_canvas *c, int of_model)
{
    static const char *const rows[][2] = {
        { "drag", "turn it; with another button move it" },
        { "wheel, + -", "nearer, farther" },
        { "arrows", "turn it by 5 degrees" },
        { "space", "let it turn, or stand still" },
        { "0", "show all of it" },
        { "a letter", "its setting on the right, one on" },
        { "Shift", "with a letter: one back" },
        { "Backspace", "settings as they were at first" },
        { "p", "write the picture as PNG" },
        { "F5", "load the file again" },
        { "h, F1", "these keys" },
        { "q, Escape", "end" },
    };
    static const char *const of_scene[][2] = { { "drag", "turn it" },
                                               { "wheel, + -", "nearer, farther" },
                                               { "left, right", "another frame; with Shift turn it" },
                                               { "space", "play it, or stand still" },
                                               { "0", "its own camera" } };
    const int n_scene = sizeof of_scene / sizeof of_scene[0];
    const int n = sizeof rows / sizeof rows[0], w = 50 * VIEW_CELL_W, h = (n + 2) * VIEW_PITCH;
    int y = VIEW_MARGIN;
    view_canvas_fill(c, VIEW_MARGIN, y, w, h, VIEW_SIDE);
    y += VIEW_PITCH;
    for (int i = 0; i < n; i++, y += VIEW_PITCH) {
        const char *const *text = !of_model && i < n_scene ? of_scene[i] : rows[i];
        view_canvas_text(c, 2 * VIEW_MARGIN, y, VIEW_ACCENT, 0, 12, text[0]);
        view_canvas_text(c, 2 * VIEW_MARGIN + 12 * VIEW_CELL_W, y, VIEW_INK, 0, 36, text[1]);
    }
}

int view_desk_scale(const struct sim_picture *picture, int w, int h)
{
    const int x = (w - VIEW_SIDE_W) / (int)picture->width, y = (h - VIEW_BAR_H) / (int)picture->height;
    const int scale = x < y ? x : y;
    return scale < 1 ? 1 : scale;
}

void view_desk_draw(const struct view_desk *d, struct view_canvas *c, uint32_t *to, int w, int h, int pitch)
{
    const int left = w > VIEW_SIDE_W ? w - VIEW_SIDE_W : 0, top = h > VIEW_BAR_H ? h - VIEW_BAR_H : 0; /* of any size */
    const int scale = view_desk_scale(&d->shot->seen.shown, w, h);
    const struct sim_picture *p = &d->shot->seen.shown;
    const int part_w = (int)p->width * scale > left ? left / scale : (int)p->width; /* of one that is too large */
    const int part_h = (int)p->height * scale > top ? top / scale : (int)p->height;
    view_canvas_size(c, w, h);
    view_canvas_fill(c, 0, 0, w, h, VIEW_BACK);
    side(c, d, left);
    bar(c, d, left, top);
    if (d->keys)
        keys(c, d->shot->words.model != NULL);
    view_canvas_show(c, to, pitch);
    if (!d->keys)
        view_canvas_picture(to, pitch, (left - part_w * scale) / 2, (top - part_h * scale) / 2, scale, p,
                            (uint32_t)part_w, (uint32_t)part_h);
}
