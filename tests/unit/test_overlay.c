/* Overlays: each item against a reference that asks of every pixel of the frame, in doubles, whether and how it is
 * covered; all items in strips against all at once; frames of which only what changed was drawn.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "cases.h"
#include "overlay/items.h"
#include "picture.h"
#include "zs_damage.h"

#define W_MAX 70
#define H_MAX 60
#define ITEMS 12

struct frame {
    int w, h;
    uint16_t px[H_MAX][W_MAX]; /* RGB565 */
};

/* ---- Random items ------------------------------------------------------------------------------ */

struct stock { /* what items point at, in blocks as long as they must be */
    struct zs_sprite sprite[3];
    void *block[16];
    int blocks;
    char *text[4];
    uint32_t code[4][40]; /* its code points; '\n' too */
    int n_codes[4];
    struct zs_item item[ITEMS];
    uint32_t n;
};

static void *block(struct stock *s, struct prng *p, size_t bytes)
{
    uint8_t *at = malloc(bytes ? bytes : 1);
    for (size_t k = 0; k < bytes; k++)
        at[k] = (uint8_t)prng_next(p);
    return s->block[s->blocks++] = at;
}

static void sprite_make(struct stock *s, struct prng *p, struct zs_sprite *sp)
{
    const uint32_t w = 1 + prng_pick(p, 21), h = 1 + prng_pick(p, 12);
    *sp = (struct zs_sprite){
        .w = (uint16_t)w, .h = (uint16_t)h, .format = (uint8_t)prng_pick(p, 3), .alpha_kind = (uint8_t)prng_pick(p, 5)
    };
    const uint32_t row = sp->format == ZS_SPRITE_565 ? 2 * w : sp->format == ZS_SPRITE_PAL8 ? w : (w + 1) / 2;
    sp->pixel = block(s, p, row * h);
    sp->n_colors = sp->format == ZS_SPRITE_PAL8 ? 256 : 16;
    sp->palette = sp->format == ZS_SPRITE_565 ? NULL : block(s, p, 2u * sp->n_colors);
    sp->key = sp->format == ZS_SPRITE_565 ? ((const uint16_t *)sp->pixel)[prng_pick(p, w * h)]
                                          : (uint16_t)prng_pick(p, 16);
    if (sp->alpha_kind > ZS_ALPHA_KEY)
        sp->alpha = block(s, p,
                          h * (sp->alpha_kind == ZS_ALPHA_8   ? w
                               : sp->alpha_kind == ZS_ALPHA_4 ? (w + 1) / 2
                                                              : (w + 7) / 8));
    sp->left = (uint8_t)prng_pick(p, w + 1);
    sp->right = (uint8_t)prng_pick(p, w - sp->left + 1);
    sp->top = (uint8_t)prng_pick(p, h + 1);
    sp->bottom = (uint8_t)prng_pick(p, h - sp->top + 1);
}

static size_t encode(uint8_t *out, uint32_t c)
{
    if (c < 0x80)
        return out[0] = (uint8_t)c, 1;
    if (c < 0x800)
        return out[0] = (uint8_t)(0xc0 | c >> 6), out[1] = (uint8_t)(0x80 | (c & 63)), 2;
    if (c < 0x10000)
        return out[0] = (uint8_t)(0xe0 | c >> 12), out[1] = (uint8_t)(0x80 | (c >> 6 & 63)),
               out[2] = (uint8_t)(0x80 | (c & 63)), 3;
    out[0] = (uint8_t)(0xf0 | c >> 18);
    out[1] = (uint8_t)(0x80 | (c >> 12 & 63));
    out[2] = (uint8_t)(0x80 | (c >> 6 & 63));
    return out[3] = (uint8_t)(0x80 | (c & 63)), 4;
}

#define NONE 0xfffffu /* a code point that no font has */
/* Bytes that are no UTF-8, each one box; what follows must be no continuation. */
static const char *const broken[] = { "\x80",
                                      "\xbf",
                                      "\xff",
                                      "\xf8",
                                      "\xc3",
                                      "\xe2\x82",
                                      "\xf0\x9f\x98",
                                      "\xc0\x80",
                                      "\xc1\x81",
                                      "\xe0\x81\x81",
                                      "\xed\xa0\x80",
                                      "\xf4\x90\x80\x80",
                                      "\xf0\x80\x81\x81",
                                      "\xf7\xbf\xbf\xbf" };

static void text_make(struct stock *s, struct prng *p, int k)
{
    static const uint32_t kinds[] = {
        0x20, 0x5f, 0xa0, 0x60, 0x100, 0x80, 0x2010, 0x200, 0x2600, 0x40, 0x1f600, 0x40
    };
    uint8_t bytes[200];
    size_t n = 0;
    const int glyphs = (int)prng_pick(p, 16);
    for (s->n_codes[k] = 0; s->n_codes[k] < glyphs; s->n_codes[k]++) {
        uint32_t *c = &s->code[k][s->n_codes[k]];
        const uint32_t kind = prng_pick(p, 8);
        if (kind == 7) {
            *c = '\n';
            bytes[n++] = '\n';
        } else if (kind == 6) {
            const char *b = broken[prng_pick(p, sizeof broken / sizeof *broken)];
            if (n && bytes[n - 1] >= 0x80 && ((uint8_t)b[0] & 0xc0) == 0x80)
                b = "\xff"; /* else it might go on */
            memcpy(bytes + n, b, strlen(b));
            n += strlen(b);
            *c = NONE;
        } else {
            const uint32_t at = kind < 3 ? 0 : 2 * (kind - 2);
            *c = kinds[at] + prng_pick(p, kinds[at + 1]);
            n += encode(bytes + n, *c);
        }
    }
    s->text[k] = block(s, p, n + 1);
    memcpy(s->text[k], bytes, n);
    s->text[k][n] = 0;
}

static const struct zs_item_kind *const kinds[] = { &zs_item_fill,   &zs_item_outline, &zs_item_line,
                                                    &zs_item_sprite, &zs_item_text,    &zs_item_bar,
                                                    &zs_item_arc,    &zs_item_needle,  &zs_item_ticks };

static int16_t place(struct prng *p, int size)
{
    static const int16_t ends[] = { INT16_MIN, INT16_MAX, INT16_MIN + 1, -1, 0 };
    return prng_pick(p, 12) ? (int16_t)prng_range(p, -size / 2, size + size / 4) : ends[prng_pick(p, 5)];
}

static void item_make(struct stock *s, struct prng *p, struct zs_item *item, int w, int h)
{
    const struct zs_item_kind *kind = kinds[prng_pick(p, 9)];
    *item = (struct zs_item){
        .kind = kind, .x = place(p, w), .y = place(p, h), .w = place(p, w), .h = place(p, h),
        .color = (uint16_t)prng_next(p), .back = (uint16_t)prng_next(p), .value = (uint16_t)prng_next(p),
        .clear = prng_pick(p, 2) ? (uint8_t)prng_next(p) : 0, .size = (uint8_t)prng_pick(p, 5),
        .flags = (uint8_t)prng_pick(p, 8), .from = (zs_turn)prng_next(p),
        .sweep = (zs_turn)(prng_pick(p, 4) ? prng_next(p) : prng_pick(p, 4) << 14),
        .back_clear = prng_pick(p, 2) ? (uint8_t)prng_next(p) : 0
    };
    if (!prng_pick(p, 6))
        item->value = prng_pick(p, 2) ? 65535 : 0;
    if (kind == &zs_item_arc || kind == &zs_item_needle || kind == &zs_item_ticks) {
        item->w = (int16_t)(prng_pick(p, 20) ? prng_pick(p, 40) : prng_pick(p, 2048));
        item->h = (int16_t)(prng_pick(p, 20) ? prng_pick(p, 20) : prng_pick(p, 2048));
        item->value = kind == &zs_item_ticks ? (uint16_t)prng_pick(p, 20) : item->value;
    }
    if (kind == &zs_item_sprite) {
        item->sprite = &s->sprite[prng_pick(p, 3)];
        item->w = (int16_t)(prng_pick(p, 2) ? 0 : prng_range(p, -1, w));
        item->h = (int16_t)(prng_pick(p, 2) ? 0 : prng_range(p, -1, h));
    }
    item->text = s->text[prng_pick(p, 4)];
}

static void stock_make(struct stock *s, struct prng *p, int w, int h)
{
    s->blocks = 0;
    for (int k = 0; k < 3; k++)
        sprite_make(s, p, &s->sprite[k]);
    for (int k = 0; k < 4; k++)
        text_make(s, p, k);
    s->n = prng_pick(p, ITEMS + 1);
    for (uint32_t k = 0; k < s->n; k++)
        item_make(s, p, &s->item[k], w, h);
}

static void stock_free(struct stock *s)
{
    while (s->blocks)
        free(s->block[--s->blocks]);
}

/* ---- The reference ----------------------------------------------------------------------------- */

struct cover {
    double alpha; /* 0: not covered */
    uint16_t color;
    int either; /* too close to an edge to say: old or covered */
};

static struct cover covered(const struct zs_item *i, int back)
{
    return (struct cover){ (255 - (back ? i->back_clear : i->clear)) / 255.0, back ? i->back : i->color, 0 };
}

static const struct cover not = { 0, 0, 0 };

static struct cover ref_line(const struct zs_item *i, int x, int y)
{
    double ax = i->x, ay = i->y, bx = i->x + i->w, by = i->y + i->h, px = x, py = y, t;
    if (fabs(by - ay) > fabs(bx - ax)) { /* steep: the axes change places */
        t = ax, ax = ay, ay = t, t = bx, bx = by, by = t, t = px, px = py, py = t;
    }
    if (bx < ax)
        t = ax, ax = bx, bx = t, t = ay, ay = by, by = t;
    if (px < ax || px > bx)
        return not ;
    return py == ay + (bx > ax ? round((by - ay) * (px - ax) / (bx - ax)) : 0) ? covered(i, 0) : not ;
}

/* A sprite's pixel at k of n, along an axis; -1: none */
static int slice(int k, int n, int size, int near, int far)
{
    if (k < near)
        return k;
    if (n - k <= far)
        return size - (n - k);
    return near + far == size ? -1 : near + (k - near) % (size - near - far);
}

static struct cover ref_sprite(const struct zs_item *i, int x, int y)
{
    const struct zs_sprite *s = i->sprite;
    const int w = i->w ? i->w : s->w, h = i->h ? i->h : s->h, px = x - i->x, py = y - i->y;
    if (px < 0 || py < 0 || px >= w || py >= h)
        return not ;
    const int u = slice(px, w, s->w, s->left, s->right), v = slice(py, h, s->h, s->top, s->bottom);
    if (u < 0 || v < 0)
        return not ;
    const uint8_t *b = s->pixel, *a = s->alpha;
    const int byte = b[v * ((s->w + 1) / 2) + u / 2];
    const int value = s->format == ZS_SPRITE_565    ? ((const uint16_t *)s->pixel)[v * s->w + u]
                      : s->format == ZS_SPRITE_PAL8 ? b[v * s->w + u]
                      : u % 2                       ? byte / 16
                                                    : byte % 16;
    double alpha = 1;
    if (s->alpha_kind == ZS_ALPHA_KEY)
        alpha = value != s->key;
    else if (s->alpha_kind == ZS_ALPHA_MASK)
        alpha = a[v * ((s->w + 7) / 8) + u / 8] >> (7 - u % 8) & 1;
    else if (s->alpha_kind == ZS_ALPHA_4)
        alpha = (u % 2 ? a[v * ((s->w + 1) / 2) + u / 2] / 16 : a[v * ((s->w + 1) / 2) + u / 2] % 16) / 15.0;
    else if (s->alpha_kind == ZS_ALPHA_8)
        alpha = a[v * s->w + u] / 255.0;
    return (struct cover){ alpha * (255 - i->clear) / 255.0, s->palette ? s->palette[value] : (uint16_t)value, 0 };
}

static struct cover ref_text(const struct stock *s, const struct zs_item *i, int x, int y)
{
    int k = 0, scale = i->size ? i->size : 1, py = y - i->y;
    while (s->text[k] != i->text)
        k++;
    const uint32_t *code = s->code[k], *const end = code + s->n_codes[k];
    for (; code <= end; py -= 8 * scale) {
        int n = 0;
        while (code + n < end && code[n] != '\n')
            n++;
        const int width = n * 6 * scale;
        const int px = x - i->x + (i->flags & ZS_ITEM_RIGHT ? width : i->flags & ZS_ITEM_CENTER ? width / 2 : 0);
        if (py >= 0 && py < 8 * scale && px >= 0 && px < width && px / scale % 6 < 5) {
            uint8_t rows[8];
            zs_font_glyph(rows, code[px / (6 * scale)]);
            return rows[py / scale] >> (4 - px / scale % 6) & 1 ? covered(i, 0) : not ;
        }
        code += n + 1;
    }
    return not ;
}

#define PI 3.14159265358979323846

static double sweep_of(const struct zs_item *i)
{
    return i->sweep ? i->sweep : 65536;
}

static struct cover ref_arc(const struct zs_item *i, int x, int y)
{
    const double dx = x - i->x, dy = y - i->y, d = hypot(dx, dy), part = round(sweep_of(i) * i->value / 65535.0);
    if (d > i->w + 0.5 || (i->h && i->h <= i->w && d < i->w - i->h + 0.5))
        return not ;
    double at = atan2(dx, -dy) / (2 * PI) * 65536 - i->from;
    at -= 65536 * floor(at / 65536);
    const double near = 0.13 / (d > 0.1 ? d : 0.01) / (2 * PI) * 65536; /* so many turns are 0.13 px */
    struct cover c = at < part ? covered(i, 0) : at < sweep_of(i) ? covered(i, 1) : not ;
    const double ends[] = { 0, part, sweep_of(i), 65536 };
    for (int k = 0; k < 4; k++)
        c.either |= fabs(at - ends[k]) < near &&
                    !((k == 0 || k == 3) && sweep_of(i) == 65536 && (part == 0 || part == 65536)) &&
                    !(k == 2 && sweep_of(i) == 65536 && (part == 0 || part == 65536)) &&
                    !(k == 1 && (part == 0 || part == sweep_of(i)) && sweep_of(i) == 65536);
    return c;
}

static struct cover ref_needle(const struct zs_item *i, int x, int y)
{
    const double angle = (i->from + round(sweep_of(i) * i->value / 65535.0)) / 65536 * 2 * PI;
    const double ux = sin(angle), uy = -cos(angle), dx = x - i->x, dy = y - i->y;
    const double along = ux * dx + uy * dy, aside = fabs(ux * dy - uy * dx), length = i->w + i->h;
    const double half = length > 0 ? i->size * (i->w - along) / length / 2 : 0;
    double inside = fmin(along + i->h, i->w - along); /* px from the ends, from the sides */
    inside = fmin(inside, (half > 0.5 ? half : 0.5) - aside);
    struct cover c = inside >= 0 ? covered(i, 0) : not ;
    c.either = fabs(inside) < 0.25;
    return c;
}

static struct cover ref(const struct stock *s, const struct zs_item *i, int x, int y)
{
    const int px = x - i->x, py = y - i->y;
    if (i->kind == &zs_item_line)
        return ref_line(i, x, y);
    if (i->kind == &zs_item_sprite)
        return ref_sprite(i, x, y);
    if (i->kind == &zs_item_text)
        return ref_text(s, i, x, y);
    if (i->kind == &zs_item_arc)
        return ref_arc(i, x, y);
    if (i->kind == &zs_item_needle)
        return ref_needle(i, x, y);
    if (px < 0 || py < 0 || px >= i->w || py >= i->h)
        return not ;
    if (i->kind == &zs_item_bar)
        return covered(i, i->flags & ZS_ITEM_UP ? py < i->h - round(i->h * i->value / 65535.0)
                                                : px >= round(i->w * i->value / 65535.0));
    const int size = i->size ? i->size : 1;
    if (i->kind == &zs_item_outline && px >= size && py >= size && px < i->w - size && py < i->h - size)
        return not ;
    return covered(i, 0);
}

/* ---- Drawing ----------------------------------------------------------------------------------- */

static struct frame frame_make(struct prng *p, int w, int h)
{
    struct frame f = { .w = w, .h = h };
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
            f.px[y][x] = (uint16_t)prng_next(p);
    return f;
}

/* Draw items on a frame in strips, each in a block of its own; columns [x0, x1) alone. */
static void draw(struct frame *f, const struct zs_item *item, uint32_t n, int strip_h, int x0, int x1)
{
    struct zs_overlay o = { .item = item, .n = n };
    for (int y0 = 0; y0 < f->h; y0 += strip_h) {
        const int y1 = y0 + strip_h < f->h ? y0 + strip_h : f->h;
        uint16_t *color = malloc((size_t)(y1 - y0) * (size_t)f->w * 2u);
        const struct zs_target t = {
            .color = color, .y0 = (uint16_t)y0, .y1 = (uint16_t)y1, .x0 = (uint16_t)x0, .x1 = (uint16_t)x1,
            .pitch = (uint32_t)f->w
        };
        for (int y = y0; y < y1; y++)
            for (int x = 0; x < f->w; x++)
                color[(y - y0) * f->w + x] = zs_wire16(f->px[y][x]);
        zs_overlay_draw(&o, &t);
        for (int y = y0; y < y1; y++)
            for (int x = 0; x < f->w; x++)
                f->px[y][x] = zs_wire16(color[(y - y0) * f->w + x]);
        free(color);
    }
}

static double channel(uint16_t c, int k)
{
    return k == 0 ? c >> 11 : k == 1 ? c >> 5 & 63 : c & 31;
}

/* Whether a pixel is what a cover makes of the old one: less than one code away, and itself where nothing or all
 * covers. */
static int mixed(uint16_t now, uint16_t old, const struct cover *c)
{
    if (c->alpha == 0 || c->alpha == 1)
        return now == (c->alpha == 1 ? c->color : old);
    for (int k = 0; k < 3; k++)
        if (fabs(channel(now, k) - (c->alpha * channel(c->color, k) + (1 - c->alpha) * channel(old, k))) >= 1)
            return 0;
    return 1;
}

/* Ticks are the lines between the points on two circles, where rounding is in no doubt. */
static int ticks_same(const struct zs_item *i, const struct frame *before, const struct frame *after)
{
    struct zs_item line[21];
    uint32_t n = 0;
    for (int k = 0; k < i->value + (i->sweep != 0); k++) {
        const double turns = i->from + (i->value ? floor(sweep_of(i) * k / i->value) : 0), a = turns / 65536 * 2 * PI;
        const double at[4] = { i->w * sin(a), -i->w * cos(a), (i->w - i->h) * sin(a), -(i->w - i->h) * cos(a) };
        for (int j = 0; j < 4; j++)
            if (fabs(at[j] - floor(at[j]) - 0.5) < 0.08 || fabs(i->x + at[j]) > 32000 || fabs(i->y + at[j]) > 32000)
                return 1;
        const double x = round(at[0]), y = round(at[1]);
        line[n] = *i;
        line[n].kind = &zs_item_line;
        line[n].x = (int16_t)(i->x + x);
        line[n].y = (int16_t)(i->y + y);
        line[n].w = (int16_t)(round(at[2]) - x);
        line[n++].h = (int16_t)(round(at[3]) - y);
    }
    struct frame f = *before;
    draw(&f, line, n, f.h, 0, f.w);
    return memcmp(&f, after, sizeof f) == 0;
}

static unsigned drawn, unsure;

static int number(const struct zs_item_kind *kind)
{
    int k = 0;
    while (kinds[k] != kind)
        k++;
    return k;
}

/* Whether an item makes of a frame what the reference does. */
static int item_right(const struct stock *s, const struct zs_item *i, const struct frame *before,
                      const struct frame *after)
{
    int32_t box[4] = { 0, 0, 0, 0 };
    if (i->kind->check && i->kind->check(i))
        return memcmp(before, after, sizeof *after) == 0 ? 1 : case_wrong("what is wrong is drawn");
    i->kind->bounds(i, box);
    for (int y = 0; y < after->h; y++)
        for (int x = 0; x < after->w; x++) {
            const uint16_t old = before->px[y][x], is = after->px[y][x];
            if (is != old && (x < box[0] || y < box[1] || x >= box[2] || y >= box[3]))
                return case_wrong("kind %d: (%d, %d) is out of its bounds", number(i->kind), x, y);
            if (i->kind == &zs_item_ticks)
                continue;
            struct cover c = ref(s, i, x, y), front = covered(i, 0), back = covered(i, 1);
            if (!(c.either ? is == old || mixed(is, old, &front) || mixed(is, old, &back) : mixed(is, old, &c)))
                return case_wrong("kind %d at (%d, %d): %04x on %04x, alpha %f of %04x", number(i->kind), x, y, is,
                                  old, c.alpha, c.color);
            drawn += c.alpha > 0;
            unsure += c.either != 0;
        }
    return i->kind != &zs_item_ticks || ticks_same(i, before, after) || case_wrong("ticks");
}

/* Each item against the reference; then all of them in strips and in columns, as drawn one after another. */
static int item_case(uint64_t seed)
{
    struct prng p = { seed };
    struct stock s;
    const int w = prng_pick(&p, 8) ? prng_range(&p, 1, W_MAX) : 1, h = prng_pick(&p, 8) ? prng_range(&p, 1, H_MAX) : 1;
    struct frame now = frame_make(&p, w, h), start = now;
    stock_make(&s, &p, w, h);
    for (uint32_t k = 0; k < s.n; k++) {
        const struct frame before = now;
        draw(&now, &s.item[k], 1, h, 0, w);
        if ((s.item[k].kind->check && s.item[k].kind->check(&s.item[k])) || !item_right(&s, &s.item[k], &before, &now))
            return case_wrong("item %u", k);
    }
    for (int k = 0; k < 4; k++) {
        struct frame f = start;
        const int rows = k ? prng_range(&p, 1, h) : 1, x0 = prng_range(&p, 0, w - 1), x1 = prng_range(&p, x0 + 1, w);
        draw(&f, s.item, s.n, rows, k % 2 ? x0 : 0, k % 2 ? x1 : w);
        for (int y = 0; y < h; y++)
            for (int x = 0; x < w; x++)
                if (f.px[y][x] != (k % 2 && (x < x0 || x >= x1) ? start.px[y][x] : now.px[y][x]))
                    return case_wrong("strips of %d rows, columns %d to %d: (%d, %d)", rows, x0, x1, x, y);
    }
    stock_free(&s);
    return 1;
}

static void items_are_those_of_the_reference(void **state)
{
    drawn = unsure = 0;
    CASES(item_case, 3000);
    if (cases_all())
        assert_true(drawn > 400000 && unsure < drawn / 25);
}

/* Every kind, its numbers at the ends of their types, in frames of 1x1 and 7x5 by strips of a row. */
static void stress_44_ends_of_int16(void **state)
{
    static const int16_t ends[] = { INT16_MIN, INT16_MIN + 1, -1, 0, 1, 4, INT16_MAX - 1, INT16_MAX };
    struct prng p = { 1 };
    struct stock s;
    stock_make(&s, &p, 7, 5);
    for (int k = 0; k < 9 * 8 * 8 * 8 * 8; k++) {
        const struct zs_item item = {
            .kind = kinds[k % 9], .x = ends[k / 9 % 8], .y = ends[k / 72 % 8], .w = ends[k / 576 % 8],
            .h = ends[k / 4608], .color = 0x1234, .back = 0x4321, .value = (uint16_t)(k % 3 * 9),
            .clear = (uint8_t)(k % 4 * 60), .size = (uint8_t)(k % 5), .sprite = &s.sprite[k % 3], .text = s.text[k % 4]
        };
        struct frame before = frame_make(&p, k % 2 ? 7 : 1, k % 2 ? 5 : 1), whole = before, rows = before;
        draw(&whole, &item, 1, whole.h, 0, whole.w);
        draw(&rows, &item, 1, 1, 0, rows.w);
        assert_memory_equal(&whole, &rows, sizeof rows);
        assert_true(item_right(&s, &item, &before, &whole));
    }
    stock_free(&s);
}

/* 200 half clear items in one place: as one after another; the colour comes within a code and stays there. */
static void stress_45_many_in_one_place(void **state)
{
    static struct zs_item many[200];
    struct prng p = { 2 };
    for (int k = 0; k < 200; k++)
        many[k] = (struct zs_item){ .kind = &zs_item_fill, .w = 9, .h = 9, .color = 0x7bcf, .clear = 128 };
    struct frame f = frame_make(&p, 9, 9);
    draw(&f, many, 200, 2, 0, 9);
    for (int k = 0; k < 81; k++)
        for (int c = 0; c < 3; c++)
            assert_true(fabs(channel(f.px[k / 9][k % 9], c) - channel(0x7bcf, c)) <= 1);
}

/* Items of all kinds over each other, clear ones too: the last one of a list is on top, in strips of any height. */
static void stress_49_overlapping_overlays(void **state)
{
    struct prng p = { 4 };
    struct stock s;
    stock_make(&s, &p, 40, 30);
    struct zs_item pile[90];
    for (int k = 0; k < 90; k++)
        pile[k] = (struct zs_item){
            .kind = kinds[k % 9], .x = (int16_t)prng_range(&p, 5, 12), .y = (int16_t)prng_range(&p, 4, 9),
            .w = (int16_t)prng_range(&p, 8, 24), .h = (int16_t)prng_range(&p, 8, 18), .color = (uint16_t)prng_next(&p),
            .back = (uint16_t)prng_next(&p), .value = (uint16_t)prng_range(&p, 0, 300),
            .clear = (uint8_t)(k % 2 ? prng_range(&p, 0, 255) : 0), .size = 1, .sprite = &s.sprite[k % 3],
            .text = s.text[k % 4]
        };
    struct frame one = frame_make(&p, 40, 30), start = one;
    for (int k = 0; k < 90; k++)
        draw(&one, &pile[k], 1, 30, 0, 40);
    for (int rows = 1; rows <= 30; rows++) {
        struct frame f = start;
        draw(&f, pile, 90, rows, 0, 40);
        assert_memory_equal(&f, &one, sizeof f);
    }
    const struct zs_item cover = { .kind = &zs_item_fill, .w = 40, .h = 30, .color = 0x1234 };
    draw(&one, &cover, 1, 7, 0, 40);
    for (int k = 0; k < 40 * 30; k++)
        assert_int_equal(one.px[k / 40][k % 40], one.px[0][0]);
    assert_memory_not_equal(&one, &start, sizeof one);
    stock_free(&s);
}

/* Texts of nothing, of line feeds, of one byte that begins a sequence; a list of nothing. */
static void stress_46_empty_text(void **state)
{
    static const char *const texts[] = { "", "\n", "\n\n\n", " ", "\xf0", "\xe2", "\xc3" };
    for (unsigned k = 0; k < sizeof texts / sizeof *texts; k++) {
        char *exact_size = malloc(strlen(texts[k]) + 1);
        strcpy(exact_size, texts[k]);
        struct frame f = { .w = 20, .h = 10 };
        const struct zs_item item = {
            .kind = &zs_item_text, .color = 0xffff, .text = exact_size, .flags = (uint8_t)(k % 4)
        };
        int32_t box[4];
        draw(&f, &item, 1, 1, 0, 20);
        draw(&f, &item, 0, 1, 0, 20);
        item.kind->bounds(&item, box);
        assert_int_equal(zs_overlay_text_width(exact_size), k < 3 ? 0 : 6);
        assert_int_equal(box[3] - box[1], k == 1 ? 16 : k == 2 ? 32 : 8);
        free(exact_size);
    }
}

/* ---- What changes ------------------------------------------------------------------------------ */

static int glass_take(void *ctx, const struct zs_strip *s)
{
    struct frame *f = ctx;
    for (uint32_t y = 0; y < s->h; y++)
        for (uint32_t x = s->dirty_x; x < (uint32_t)s->dirty_x + s->dirty_w; x++)
            f->px[s->y + y][x] = (uint16_t)(s->px[2 * (y * s->w + x)] << 8 | s->px[2 * (y * s->w + x) + 1]);
    f->h += s->h;
    return 0;
}

static void stripes(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    for (uint32_t k = 0; k < n; k++)
        out[k] = (uint16_t)((x + k) * 2053u + y * 40503u);
}

static unsigned quiet;

/* A glass that gets what changed alone shows what is drawn whole, while items come, go, move and change; two
 * overlays. */
static int change_case(uint64_t seed)
{
    struct prng p = { seed };
    struct stock s;
    const int w = prng_range(&p, 1, W_MAX), h = prng_range(&p, 1, H_MAX), rows = prng_range(&p, 1, h);
    struct zs_config c = picture_config(w, h, &zs_depth_linear);
    static const struct zs_background sky = { .fill = stripes };
    static uint32_t arena[2][1 << 15], track[ZS_DAMAGE_WORDS(0, H_MAX, 1)];
    static uint64_t sums[H_MAX * W_MAX];
    struct zs_strip_hashes hashes;
    struct zs_renderer whole, part;
    struct zs_camera camera;
    uint32_t memory[2][ZS_OVERLAY_WORDS(ITEMS)];
    stock_make(&s, &p, w, h);
    for (uint32_t k = 0; k < ZS_OVERLAY_WORDS(ITEMS); k++)
        memory[0][k] = memory[1][k] = (uint32_t)prng_next(&p);
    struct zs_overlay over[2] = { { .item = s.item, .n = s.n, .memory = memory[0], .room = ITEMS },
                                  { .item = s.item, .memory = prng_pick(&p, 8) ? memory[1] : NULL, .room = ITEMS } };
    const struct zs_resolve hook[2] = { { .draw = zs_overlay_draw, .changes = zs_overlay_changes, .ctx = &over[0] },
                                        { .draw = zs_overlay_draw, .changes = zs_overlay_changes, .ctx = &over[1] } };
    const struct zs_scene scene = { .sky = &sky, .resolve = hook, .n_resolves = 2 };
    c.strip_h = (uint16_t)rows;
    c.max_tris = c.max_verts = 8;
    c.fast = NULL;
    CASE_CHECK(!zs_camera_orthographic(&camera, 24, 1, 100));
    CASE_CHECK(!zs_init(&whole, &c, arena[0], sizeof arena[0]) && !zs_init(&part, &c, arena[1], sizeof arena[1]));
    CASE_CHECK(!zs_damage_track(&part, track, 0));
    CASE_CHECK(!prng_pick(&p, 2) || !zs_damage_columns(&part, 1));
    CASE_CHECK(!prng_pick(&p, 2) || !damage_compare_anew(&part, &hashes, sums, 1u + prng_pick(&p, (uint32_t)w)));
    struct frame glass = { .w = w }, full = { .w = w };
    for (int t = 0; t < 12; t++) {
        const struct zs_sink to_glass = { .submit = glass_take, .ctx = &glass },
                             to_full = { .submit = glass_take, .ctx = &full };
        for (uint32_t k = prng_pick(&p, 3); k; k--) {
            struct zs_item *i = &s.item[prng_pick(&p, ITEMS)];
            if ((uint32_t)(i - s.item) >= s.n)
                item_make(&s, &p, &s.item[s.n++], w, h);
            else if (prng_pick(&p, 2))
                item_make(&s, &p, i, w, h);
            else if (prng_pick(&p, 3) == 0)
                i->x++;
            else if (prng_pick(&p, 2))
                i->value += 5000;
            else if (s.text[0][0])
                s.text[0][strlen(s.text[0]) / 2] = (char)('0' + t); /* in place; may break a sequence */
        }
        over[0].n = prng_pick(&p, 6) ? s.n : prng_pick(&p, s.n + 1);
        over[1].n = prng_pick(&p, 6) ? s.n / 2 : 0;
        over[1].item = s.item + s.n - over[1].n;
        CASE_CHECK(zs_render(&part, &scene, &camera, &to_glass) == ZS_OK);
        CASE_CHECK(zs_render(&whole, &scene, &camera, &to_full) == ZS_OK);
        quiet += zs_frame_stats(&part)->strips_skipped > 0;
        CASE_CHECK(memcmp(glass.px, full.px, sizeof full.px) == 0);
    }
    stock_free(&s);
    return 1;
}

/* Whatever an item is drawn from has changed when it is another number, and has not changed the next time. */
static void every_field_is_noticed(void **state)
{
    static const uint16_t px[2][16];
    static const uint8_t alpha[32];
    struct zs_sprite sprite = { .pixel = px[0], .palette = px[0], .alpha = alpha, .w = 4, .h = 4 };
    struct zs_item item = { .kind = &zs_item_sprite, .w = 8, .h = 8, .sprite = &sprite };
    uint32_t memory[ZS_OVERLAY_WORDS(1)];
    struct zs_overlay over = { .item = &item, .n = 1, .memory = memory, .room = 1 };
    struct zs_rect rect;
    assert_int_equal(zs_overlay_changes(&over, &rect), 1);
#define IS(value) (zs_overlay_changes(&over, &rect) == (value) && !zs_overlay_changes(&over, &rect))
#define NOTICED(field) assert_true(IS(0) && ((field)++, IS(1)) && ((field)--, IS(1)))
    NOTICED(item.x), NOTICED(item.y), NOTICED(item.w), NOTICED(item.h), NOTICED(item.color), NOTICED(item.back);
    NOTICED(item.clear), NOTICED(item.back_clear), NOTICED(item.size), NOTICED(item.flags), NOTICED(item.value);
    NOTICED(item.from), NOTICED(item.sweep);
    NOTICED(sprite.palette), NOTICED(sprite.alpha), NOTICED(sprite.w), NOTICED(sprite.h), NOTICED(sprite.key);
    NOTICED(sprite.format), NOTICED(sprite.alpha_kind), NOTICED(sprite.left), NOTICED(sprite.top);
    NOTICED(sprite.right), NOTICED(sprite.bottom);
#undef NOTICED
    sprite.pixel = px[1];
    assert_true(IS(1));
    item.sprite = NULL;
    assert_true(IS(1));
    item.kind = &zs_item_text;
    item.text = "a";
    assert_true(IS(1));
    item.text = "b";
    assert_true(IS(1));
#undef IS
}

/* ---- Letters ----------------------------------------------------------------------------------- */

static void letters(const char *text, const char *const rows[8])
{
    struct frame f = { .w = W_MAX, .h = 8 };
    const struct zs_item item = { .kind = &zs_item_text, .color = 0xffff, .text = text };
    const uint32_t width = zs_overlay_text_width(text);
    draw(&f, &item, 1, 3, 0, f.w);
    for (int y = 0; y < 8; y++) {
        char got[W_MAX + 1] = { 0 };
        for (uint32_t x = 0; x < width; x++)
            got[x] = f.px[y][x] ? '#' : '.';
        assert_string_equal(got, rows[y]);
    }
}

static void letters_look_like_this(void **state)
{
    letters("Ag7\xc2\xb0",
            (const char *const[]){ ".###........#####..##...", "#...#...........#.#..#..", "#...#..####....#..#..#..",
                                   "#...#.#...#....#...##...", "#####.#...#...#.........", "#...#..####...#.........",
                                   "#...#.....#...#.........", ".......###.............." });
    letters("\xc3\x84\xc3\xa9\xc4\x8d\xc5\x82",
            (const char *const[]){ ".#.#.....#...#.#...##...", "........#.....#.....#...", ".###...###...###....##..",
                                   "#...#.#...#.#.......#...", "#####.#####.#......##...", "#...#.#.....#...#...#...",
                                   "#...#..###...###...###..", "........................" });
    letters("\xe2\x86\x92\xff.",
            (const char *const[]){ "......#####.......", "..#...#...#.......", "...#..#.#.#.......",
                                   "#####.#...#.......", "...#..#.#.#.......", "..#...#...#...##..",
                                   "......#####...##..", ".................." });
}

/* Every code point that the font has looks like no other, but for those that are meant to; and none has gone. */
static void every_letter_is_another(void **state)
{
    static const uint32_t ranges[][2] = { { 0x20, 0x7e },     { 0xa1, 0x17f },    { 0x218, 0x21b },
                                          { 0x3a9, 0x3a9 },   { 0x2018, 0x2026 }, { 0x20ac, 0x20ac },
                                          { 0x2190, 0x2193 }, { 0x25a0, 0x25a0 } };
    static uint8_t seen[600][8];
    uint8_t box[8], rows[8];
    int n = 0, same = 0, missing = 0;
    zs_font_glyph(box, NONE);
    for (unsigned r = 0; r < sizeof ranges / sizeof *ranges; r++)
        for (uint32_t c = ranges[r][0]; c <= ranges[r][1]; c++) {
            zs_font_glyph(rows, c);
            for (int y = 0; y < 8; y++)
                assert_in_range(rows[y], 0, 31);
            if (memcmp(rows, box, 8) == 0) {
                missing++;
                continue;
            }
            for (int k = 0; k < n; k++)
                if (memcmp(rows, seen[k], 8) == 0) {
                    same++;
                    if (c < 0xff || (c < 0x180 && c != 0x110))
                        assert_true(c == 0xa6 || c == 0xad || c == 0xb4 || c == 0xba);
                }
            memcpy(seen[n++], rows, 8);
        }
    assert_int_equal(n, 310);
    assert_int_equal(same, 13);
    assert_int_equal(missing, 34);
}

/* A half circle has the ray from which it begins, and not the one at which it ends. */
static void a_ray_is_of_one_side(void **state)
{
    struct frame f = { .w = 9, .h = 9 };
    const struct zs_item half = {
        .kind = &zs_item_arc, .x = 4, .y = 4, .w = 3, .h = 2, .sweep = 32768, .value = 65535, .color = 0xffff,
        .back_clear = 255
    };
    draw(&f, &half, 1, 9, 0, 9);
    assert_int_equal(f.px[1][4], 0xffff);
    assert_int_equal(f.px[4][7], 0xffff);
    assert_int_equal(f.px[7][4], 0);
    assert_int_equal(f.px[4][1], 0);
}

/* The centre of a filled circle in two parts is painted, whatever the parts. */
static void a_circle_in_parts_has_its_centre(void **state)
{
    for (uint32_t sweep = 4096; sweep < 65536; sweep += 4096)
        for (uint32_t value = 0; value < 65536; value += 4369) {
            struct frame f = { .w = 9, .h = 9 };
            const struct zs_item disc = { .kind = &zs_item_arc, .x = 4, .y = 4, .w = 3, .sweep = (zs_turn)sweep,
                                          .value = (uint16_t)value, .color = 0xffff, .back = 0xffff };
            draw(&f, &disc, 1, 9, 0, 9);
            assert_int_equal(f.px[4][4], 0xffff);
        }
}

/* ---- What is wrong ----------------------------------------------------------------------------- */

static void wrong_items_are_named(void **state)
{
    static const uint16_t px[4] = { 1, 2, 3, 4 };
    static const struct zs_sprite good = { .pixel = px, .w = 2, .h = 2 };
    struct zs_sprite bad[7] = { good, good, good, good, good, good, good };
    uint32_t memory[ZS_OVERLAY_WORDS(1)];
    bad[0].pixel = NULL, bad[1].format = ZS_SPRITE_PAL8, bad[2].alpha_kind = ZS_ALPHA_8, bad[3].w = 0,
    bad[4].format = 3;
    bad[5].left = 2, bad[5].right = 1, bad[6].alpha_kind = 5, bad[6].alpha = (const uint8_t *)px;
    const struct {
        struct zs_item item;
        int err;
    } t[] = { { { .kind = NULL }, ZS_OK },
              { { .kind = &zs_item_sprite, .sprite = &good }, ZS_OK },
              { { .kind = &zs_item_sprite }, ZS_ERR_NULL },
              { { .kind = &zs_item_sprite, .sprite = &bad[0] }, ZS_ERR_NULL },
              { { .kind = &zs_item_sprite, .sprite = &bad[1] }, ZS_ERR_NULL },
              { { .kind = &zs_item_sprite, .sprite = &bad[2] }, ZS_ERR_NULL },
              { { .kind = &zs_item_sprite, .sprite = &bad[3] }, ZS_ERR_TEXTURE },
              { {
                    .kind = &zs_item_sprite,
                    .sprite = &bad[4],
                },
                ZS_ERR_NULL },
              { { .kind = &zs_item_sprite, .sprite = &bad[5] }, ZS_ERR_TEXTURE },
              { { .kind = &zs_item_sprite, .sprite = &bad[6] }, ZS_ERR_TEXTURE },
              { { .kind = &zs_item_text }, ZS_ERR_NULL },
              { { .kind = &zs_item_text, .text = "a", .size = 5 }, ZS_ERR_RANGE },
              { { .kind = &zs_item_text, .text = "" }, ZS_OK },
              { { .kind = &zs_item_arc, .w = 2048 }, ZS_ERR_RANGE },
              { { .kind = &zs_item_needle, .w = -1 }, ZS_ERR_RANGE },
              { { .kind = &zs_item_ticks, .value = 1001 }, ZS_ERR_RANGE } };
    for (unsigned k = 0; k < sizeof t / sizeof *t; k++) {
        struct frame f = { .w = 9, .h = 9 }, before = f;
        const struct zs_overlay o = { .item = &t[k].item, .n = 1 };
        assert_int_equal(zs_overlay_check(&o), t[k].err);
        draw(&f, &t[k].item, 1, 9, 0, 9);
        if (t[k].err)
            assert_memory_equal(&f, &before, sizeof f);
    }
    const struct zs_item two[2] = { { .kind = NULL }, { .kind = NULL } };
    const struct zs_overlay more = { .item = two, .n = 2, .memory = memory, .room = 1 }, none = { .n = 1 },
                            empty = { .n = 0 };
    assert_int_equal(zs_overlay_check(&more), ZS_ERR_SIZE);
    assert_int_equal(zs_overlay_check(&none), ZS_ERR_NULL);
    assert_int_equal(zs_overlay_check(NULL), ZS_ERR_NULL);
    assert_int_equal(zs_overlay_check(&empty), ZS_OK);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_field_is_noticed),
    cmocka_unit_test(letters_look_like_this),
    cmocka_unit_test(every_letter_is_another),
    cmocka_unit_test(wrong_items_are_named),
    cmocka_unit_test(a_ray_is_of_one_side),
    cmocka_unit_test(a_circle_in_parts_has_its_centre),
    cmocka_unit_test(items_are_those_of_the_reference),
    cmocka_unit_test(stress_44_ends_of_int16),
    cmocka_unit_test(stress_45_many_in_one_place),
    cmocka_unit_test(stress_46_empty_text),
    cmocka_unit_test(stress_49_overlapping_overlays),
    CASES_COUNTS(what_changed_is_enough, change_case, 300, { "quiet frames", &quiet, 600 }),
};
CASES_MAIN(tests)
