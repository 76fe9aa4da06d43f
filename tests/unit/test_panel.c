/* Panel drivers over a bus that records, is strict about the contract of hal.h, and fails where it is told to.
 * What the bytes show on the glass is for the panel model; here it is which bytes go, when, and what happens if they
 * do not.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "cases.h"
#include "kept.h"
#include "panel.h"

#define SIDE 320 /* px, the longest of a picture */

/* ---- The wire ------------------------------------------------------------------------------------------ */

enum kind { CODE, ARG, PIXEL, RESET }; /* D/C low; D/C high after it; a byte of data; the RESET line */

struct wire {
    struct hal_bus bus; /* first: the driver hands it back */
    uint16_t *log;      /* kind << 8 | byte */
    uint32_t n, room;
    const uint8_t *out; /* borrowed; NULL: nothing is */
    uint32_t n_out, sum_out;
    uint32_t transfers;      /* data begun */
    uint32_t verbs, fail_at; /* verbs so far; the one that fails, counted from 1; 0: none */
    uint32_t pause_us;       /* all delays */
    int held, refuse, locks; /* lock taken; lock says no; times taken */
};

static uint32_t fnv1a(const uint8_t *at, uint32_t n)
{
    uint32_t sum = 2166136261u;
    for (uint32_t i = 0; i < n; i++)
        sum = (sum ^ at[i]) * 16777619u;
    return sum;
}

static void put(struct wire *w, enum kind kind, uint8_t byte)
{
    if (w->n == w->room) {
        w->room = w->room ? 2 * w->room : 4096;
        uint16_t *log = sim_kept(w->room * sizeof *log);
        assert_non_null(log);
        if (w->n)
            memcpy(log, w->log, w->n * sizeof *log);
        sim_kept_end(w->log);
        w->log = log;
    }
    w->log[w->n++] = (uint16_t)(kind << 8 | byte);
}

static int verb(struct wire *w)
{
    assert_true(w->held); /* the hooks' lock is held whenever the bus is used */
    return ++w->verbs == w->fail_at ? HAL_ERR_BUS : HAL_ERR_NONE;
}

static int wire_command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    struct wire *w = (struct wire *)bus;
    assert_true(args || !n);
    assert_null(w->out);
    if (verb(w)) {
        put(w, CODE, code); /* half of it arrives */
        return HAL_ERR_BUS;
    }
    put(w, CODE, code);
    for (uint32_t i = 0; i < n; i++)
        put(w, ARG, args[i]);
    return HAL_ERR_NONE;
}

static int wire_data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    struct wire *w = (struct wire *)bus;
    assert_non_null(bytes);
    assert_true(n > 0 && (uintptr_t)bytes % 2 == 0);
    assert_null(w->out);
    if (verb(w))
        return HAL_ERR_BUS;
    for (uint32_t i = 0; i < n; i++)
        put(w, PIXEL, bytes[i]);
    w->out = bytes;
    w->n_out = n;
    w->sum_out = fnv1a(bytes, n);
    w->transfers++;
    return HAL_ERR_NONE;
}

static int wire_wait(struct hal_bus *bus)
{
    struct wire *w = (struct wire *)bus;
    const int err = verb(w);
    if (w->out)
        assert_int_equal(fnv1a(w->out, w->n_out), w->sum_out);
    w->out = NULL;
    return err;
}

static int wire_reset(struct hal_bus *bus)
{
    struct wire *w = (struct wire *)bus;
    assert_null(w->out);
    if (verb(w))
        return HAL_ERR_BUS;
    put(w, RESET, 0);
    return HAL_ERR_NONE;
}

static void wire_delay(struct hal_bus *bus, uint32_t us)
{
    struct wire *w = (struct wire *)bus;
    assert_null(w->out);
    w->pause_us += us;
}

static int wire_lock(void *ctx)
{
    struct wire *w = ctx;
    assert_false(w->held);
    if (w->refuse)
        return 1;
    w->held = 1;
    w->locks++;
    return 0;
}

static void wire_unlock(void *ctx)
{
    struct wire *w = ctx;
    assert_true(w->held);
    assert_null(w->out);
    w->held = 0;
}

static struct wire wire_new(void)
{
    return (struct wire){ .bus = { wire_command, wire_data, wire_wait, wire_reset, wire_delay, { 0 } } };
}

/* The hooks' context is the wire itself, which must not move from here on. */
static void wire_hook(struct wire *w)
{
    w->bus.hooks = (struct hal_hooks){ .ctx = w, .lock = wire_lock, .unlock = wire_unlock };
}

/* Does the log go on at `at` with these n entries? */
static int goes_on(const struct wire *w, uint32_t at, const uint16_t *with, uint32_t n)
{
    return at + n <= w->n && memcmp(w->log + at, with, n * sizeof *with) == 0;
}

/* ---- The glass, from the datasheets -------------------------------------------------------------------- */

struct sheet {
    const struct panel_type *type;
    uint16_t width, height;
    uint8_t offset[4][2]; /* of the picture in the controller's addresses at each rotation; px */
    uint8_t columns, rows, write, wide; /* commands of the window; write 0: none; wide: two bytes an address */
    uint8_t turns;  /* 0: the controller turns; 1: it does, in RAM columns and rows; 2: the driver turns */
    uint8_t per_column, per_row; /* px of the glass in one address */
    uint8_t args_low;
};

static const struct sheet sheets[] = {
    { &panel_st7789, 240, 240, { { 0, 0 }, { 0, 0 }, { 0, 80 }, { 80, 0 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 },
    { &panel_st7789, 240, 320, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 },
    { &panel_st7789, 135, 240, { { 52, 40 }, { 40, 53 }, { 53, 40 }, { 40, 52 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 },
    { &panel_ili9341, 240, 320, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 },
    { &panel_gc9a01, 240, 240, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 },
    { &panel_ssd1351, 128, 128, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x15, 0x75, 0x5c, 0, 1, 1, 1, 0 },
    { &panel_ssd1351, 128, 96, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x15, 0x75, 0x5c, 0, 1, 1, 1, 0 },
    { &panel_ssd0323, 128, 64, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x15, 0x75, 0, 0, 2, 2, 1, 1 },
    { &panel_ssd1306, 128, 64, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x21, 0x22, 0, 0, 2, 1, 8, 1 },
    { &panel_ssd1306, 128, 32, { { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }, 0x21, 0x22, 0, 0, 2, 1, 8, 1 },
    { &panel_ssd1306, 64, 48, { { 32, 0 }, { 32, 0 }, { 32, 0 }, { 32, 0 } }, 0x21, 0x22, 0, 0, 2, 1, 8, 1 },
    { &panel_ssd1306, 72, 40, { { 28, 0 }, { 28, 0 }, { 28, 0 }, { 28, 0 } }, 0x21, 0x22, 0, 0, 2, 1, 8, 1 },
    { &panel_st7789, 240, 280, { { 0, 20 }, { 20, 0 }, { 0, 20 }, { 20, 0 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 },
    { &panel_st7789, 172, 320, { { 34, 0 }, { 0, 34 }, { 34, 0 }, { 0, 34 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 },
    { &panel_st7789, 170, 320, { { 35, 0 }, { 0, 35 }, { 35, 0 }, { 0, 35 } }, 0x2a, 0x2b, 0x2c, 1, 0, 1, 1, 0 }
};
#define N_SHEETS (sizeof sheets / sizeof *sheets)

static uint32_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static uint32_t most(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

/* Where the picture's pixel (x, y) is on the glass: the picture stands turned clockwise on it. */
static void on_glass(const struct sheet *s, int rotate, uint32_t x, uint32_t y, uint32_t *gx, uint32_t *gy)
{
    const uint32_t w = s->width, h = s->height;
    *gx = rotate == 0 ? x : rotate == 1 ? w - 1 - y : rotate == 2 ? w - 1 - x : y;
    *gy = rotate == 0 ? y : rotate == 1 ? x : rotate == 2 ? h - 1 - y : h - 1 - x;
}

static uint32_t put_range(const struct sheet *s, uint16_t *to, uint8_t code, uint32_t first, uint32_t last)
{
    const uint16_t arg = (uint16_t)((s->args_low ? CODE : ARG) << 8);
    uint32_t n = 0;
    to[n++] = (uint16_t)(CODE << 8 | code);
    for (int k = 0; k < 2; k++) {
        const uint32_t address = k ? last : first;
        if (s->wide)
            to[n++] = (uint16_t)(arg | address >> 8);
        to[n++] = (uint16_t)(arg | (address & 255));
    }
    return n;
}

/* The log entries of a rectangle's window; how many. */
static uint32_t window(const struct sheet *s, int rotate, const struct panel_rect *r, uint16_t to[16])
{
    uint32_t x[2] = { r->x, r->x + r->w - 1u }, y[2] = { r->y, r->y + r->h - 1u };
    if (s->turns == 2) {
        uint32_t a[2], b[2];
        for (int k = 0; k < 2; k++)
            on_glass(s, rotate, x[k], y[k], &a[k], &b[k]);
        x[0] = least(a[0], a[1]), x[1] = most(a[0], a[1]), y[0] = least(b[0], b[1]), y[1] = most(b[0], b[1]);
    }
    const int across = s->turns == 1 && rotate % 2; /* the picture's x counts rows */
    const uint8_t for_x = across ? s->rows : s->columns, for_y = across ? s->columns : s->rows;
    const uint8_t *o = s->offset[rotate];
    uint32_t n = put_range(s, to, for_x, (x[0] + o[0]) / s->per_column, (x[1] + o[0]) / s->per_column);
    n += put_range(s, to + n, for_y, (y[0] + o[1]) / s->per_row, (y[1] + o[1]) / s->per_row);
    if (s->write)
        to[n++] = (uint16_t)(CODE << 8 | s->write);
    return n;
}

static uint32_t bits_a_pixel(const struct sheet *s)
{
    return s->type == &panel_ssd1306 ? 1 : s->type == &panel_ssd0323 ? 4 : 16;
}

static uint32_t step_x(const struct sheet *s, int rotate)
{
    return rotate % 2 ? s->per_row : s->per_column;
}

static uint32_t step_y(const struct sheet *s, int rotate)
{
    return rotate % 2 ? s->per_column : s->per_row;
}

/* A rectangle of the picture that the panel can take. */
static struct panel_rect random_rect(struct prng *p, const struct sheet *s, int rotate)
{
    const uint32_t sx = step_x(s, rotate), sy = step_y(s, rotate);
    const uint32_t cx = (rotate % 2 ? s->height : s->width) / sx, cy = (rotate % 2 ? s->width : s->height) / sy;
    const uint32_t x = prng_pick(p, cx), y = prng_pick(p, cy);
    const uint32_t w = 1 + prng_pick(p, cx - x), h = 1 + prng_pick(p, prng_pick(p, 2) ? least(cy - y, 8) : cy - y);
    return (struct panel_rect){ (uint16_t)(x * sx), (uint16_t)(y * sy), (uint16_t)(w * sx), (uint16_t)(h * sy) };
}

/* ---- A panel on a wire --------------------------------------------------------------------------------- */

static _Alignas(4) uint8_t px[SIDE * (SIDE + 4) * 2], scratch[SIDE * SIDE * 2];

static void fill_px(struct prng *p)
{
    for (uint32_t i = 0; i < sizeof px; i++)
        px[i] = (uint8_t)prng_next(p);
}

static struct panel_config config_of(const struct sheet *s, int rotate)
{
    return (struct panel_config){ s->type, s->width, s->height, .rotate = (uint8_t)rotate };
}

static int bring_up(struct panel *panel, struct wire *w, const struct panel_config *config)
{
    wire_hook(w);
    return panel_init(panel, config, &w->bus, scratch, panel_scratch_bytes(config, SIDE * SIDE));
}

/* ---- Windows and bytes --------------------------------------------------------------------------------- */

/* The log after `at` is the window of r and then its pixels; where these begin, 0 if not. */
static uint32_t sent(const struct wire *w, uint32_t at, const struct sheet *s, int rotate, const struct panel_rect *r)
{
    uint16_t want[16];
    const uint32_t n = window(s, rotate, r, want), bytes = (uint32_t)r->w * r->h * bits_a_pixel(s) / 8;
    if (!goes_on(w, at, want, n) || w->n != at + n + bytes)
        return 0;
    for (uint32_t i = at + n; i < w->n; i++)
        if (w->log[i] >> 8 != PIXEL)
            return 0;
    return at + n;
}

static int window_case(uint64_t seed)
{
    struct prng p = { seed };
    const struct sheet *s = &sheets[seed % N_SHEETS];
    int rotate = (int)(seed / N_SHEETS % 4);
    struct wire w = wire_new();
    struct panel panel;
    const struct panel_config config = config_of(s, prng_pick(&p, 2) ? rotate : 0);
    CASE_CHECK(bring_up(&panel, &w, &config) == HAL_ERR_NONE);
    if (config.rotate != rotate)
        CASE_CHECK(panel_rotate(&panel, (uint8_t)rotate) == HAL_ERR_NONE);
    for (int k = 0; k < 20; k++) {
        const struct panel_rect r = random_rect(&p, s, rotate);
        const uint32_t at = w.n;
        CASE_CHECK(panel_send(&panel, &r, px, 0) == HAL_ERR_NONE);
        CASE_CHECK(panel_wait(&panel) == HAL_ERR_NONE && !w.held);
        if (!sent(&w, at, s, rotate, &r))
            return case_wrong("%s %ux%u at rotation %d: window of %u %u %u %u", panel_name(s->type), s->width,
                              s->height, rotate, r.x, r.y, r.w, r.h);
    }
    sim_kept_end(w.log);
    return 1;
}

/* Glass of any size anywhere in the RAM: mirrored, what is left of the RAM on its other side comes first. */
static void glass_of_ones_own(void **state)
{
    static const uint8_t at[4][2] = { { 10, 30 }, { 30, 130 }, { 130, 90 }, { 90, 10 } }; /* 240 x 320 of RAM */
    for (int rotate = 0; rotate < 4; rotate++) {
        const struct panel_config c = { &panel_st7789, 100, 200, 10, 30, .rotate = (uint8_t)rotate };
        const struct panel_rect r = { 1, 2, 3, 4 };
        struct sheet s = sheets[0];
        memcpy(s.offset[rotate], at[rotate], 2);
        struct wire w = wire_new();
        struct panel panel;
        assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
        const uint32_t from = w.n;
        assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
        assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
        assert_true(sent(&w, from, &s, rotate, &r));
        sim_kept_end(w.log);
    }
}

/* Colour goes out as it is, from where it is; rows apart, one by one. */
static void colour_is_not_copied(void **state)
{
    const struct sheet *s = &sheets[0];
    struct wire w = wire_new();
    struct panel panel;
    const struct panel_config config = config_of(s, 1);
    assert_int_equal(bring_up(&panel, &w, &config), HAL_ERR_NONE);
    const struct panel_rect r = { 7, 11, 13, 5 };
    uint32_t at = w.n;
    w.transfers = 0;
    assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
    assert_ptr_equal(w.out, px);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    assert_int_equal(w.transfers, 1);
    at = w.n;
    assert_int_equal(panel_send(&panel, &r, px, 34), HAL_ERR_NONE);
    assert_ptr_equal(w.out, px + 4 * 34);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    assert_int_equal(w.transfers, 6);
    const uint32_t first = sent(&w, at, s, 1, &r);
    assert_true(first);
    for (uint32_t i = 0; i < 13 * 2 * 5; i++)
        assert_int_equal(w.log[first + i] & 255, px[i / 26 * 34 + i % 26]);
    sim_kept_end(w.log);
}

/* ---- Conversion ---------------------------------------------------------------------------------------- */

/* The picture's pixel (x, y) at from, 0 .. 255. */
static int grey_of(const uint8_t *from, int lsb_first)
{
    const int v = lsb_first ? from[1] * 256 + from[0] : from[0] * 256 + from[1];
    const int r = v / 2048, g = v / 32 % 64, b = v % 32;
    return (77 * (r * 8 + r / 4) + 150 * (g * 4 + g / 16) + 29 * (b * 8 + b / 4) + 128) / 256;
}

/* The 8 x 8 dither matrix by its recursion, not by a table. */
static int bayer_of(uint32_t x, uint32_t y)
{
    int v = 0;
    for (int bit = 0; bit < 3; bit++) {
        const int bx = (int)(x >> bit & 1), by = (int)(y >> bit & 1);
        v = v * 4 + (bx ^ by) * 2 + by;
    }
    return v;
}

/* What must be on the wire for r, by setting every pixel of the picture where the glass has it. */
static void expected(const struct sheet *s, const struct panel_config *c, const struct panel_rect *r, uint32_t stride,
                     uint8_t *to)
{
    uint32_t ax, ay, bx, by;
    on_glass(s, c->rotate, r->x, r->y, &ax, &ay);
    on_glass(s, c->rotate, r->x + r->w - 1u, r->y + r->h - 1u, &bx, &by);
    const uint32_t left = least(ax, bx), top = least(ay, by), wide = most(ax, bx) - left + 1;
    memset(to, 0, (size_t)r->w * r->h * 2);
    for (uint32_t j = 0; j < r->h; j++)
        for (uint32_t i = 0; i < r->w; i++) {
            const uint8_t *from = px + j * stride + i * 2;
            const int grey = grey_of(from, c->lsb_first);
            uint32_t gx, gy;
            on_glass(s, c->rotate, r->x + i, r->y + j, &gx, &gy);
            gx -= left, gy -= top;
            if (bits_a_pixel(s) == 4)
                to[(gy * wide + gx) / 2] |= (uint8_t)((grey * 15 + 127) / 255 << (gx % 2 ? 0 : 4));
            else if (bits_a_pixel(s) == 1)
                to[gy / 8 * wide + gx] |=
                    (uint8_t)((grey > 255 * (2 * bayer_of(r->x + i, r->y + j) + 1) / 128) << gy % 8);
            else
                memcpy(to + (j * r->w + i) * 2, (uint8_t[]){ from[1], from[0] }, 2);
        }
}

static int convert_case(uint64_t seed)
{
    static uint8_t want[SIDE * SIDE * 2];
    struct prng p = { seed };
    const struct sheet *s = &sheets[3 + seed % 9]; /* all but ST7789, which converts nothing */
    struct panel_config c = config_of(s, (int)prng_pick(&p, 4));
    c.lsb_first = bits_a_pixel(s) == 16 || prng_pick(&p, 2);
    struct wire w = wire_new();
    struct panel panel;
    fill_px(&p);
    CASE_CHECK(bring_up(&panel, &w, &c) == HAL_ERR_NONE);
    for (int k = 0; k < 4; k++) {
        const struct panel_rect r = random_rect(&p, s, c.rotate);
        const uint32_t stride = prng_pick(&p, 2) ? 0 : r.w * 2u + 2u * prng_pick(&p, 4), at = w.n;
        const uint32_t n = panel_scratch_bytes(&c, (uint32_t)r.w * r.h);
        CASE_CHECK(n == (uint32_t)r.w * r.h * bits_a_pixel(s) / 8);
        memset(scratch, 0xa5, sizeof scratch);
        expected(s, &c, &r, stride ? stride : r.w * 2u, want);
        CASE_CHECK(panel_send(&panel, &r, px, stride) == HAL_ERR_NONE);
        CASE_CHECK(panel_wait(&panel) == HAL_ERR_NONE);
        const uint32_t first = sent(&w, at, s, c.rotate, &r);
        CASE_CHECK(first != 0);
        for (uint32_t i = 0; i < n; i++)
            if ((w.log[first + i] & 255) != want[i])
                return case_wrong("%s rotation %d, %u %u %u %u: byte %u is %02x, not %02x", panel_name(s->type),
                                  c.rotate, r.x, r.y, r.w, r.h, i, w.log[first + i] & 255, want[i]);
        for (uint32_t i = n; i < sizeof scratch; i++)
            CASE_CHECK(scratch[i] == 0xa5);
    }
    sim_kept_end(w.log);
    return 1;
}

static void conversion_is_the_formula(void **state)
{
    assert_int_equal(bayer_of(7, 0), 42);
    assert_int_equal(bayer_of(0, 1), 48);
    CASES(convert_case, 600);
}

/* ---- Setting up ---------------------------------------------------------------------------------------- */

static int is_on(const struct sheet *s, uint16_t entry)
{
    return entry == (CODE << 8 | (s->wide ? 0x29 : 0xaf));
}

/* How often the entries occur in the log. */
static uint32_t count(const struct wire *w, const uint16_t *entries, uint32_t n)
{
    uint32_t found = 0;
    for (uint32_t i = 0; i + n <= w->n; i++)
        found += goes_on(w, i, entries, n);
    return found;
}
#define CODED(c) ((uint16_t)(CODE << 8 | (c)))
#define ARGUED(c) ((uint16_t)(ARG << 8 | (c)))
#define COUNT(w, ...) count(w, (uint16_t[]){ __VA_ARGS__ }, sizeof((uint16_t[]){ __VA_ARGS__ }) / sizeof(uint16_t))

/* Reset first; switched off, and awake; not lit before all of the glass is black, in as few transfers as the scratch
 * allows; lit last of all. */
static void dark_until_black(void **state)
{
    static const uint32_t rooms[] = { 8, 1003, sizeof scratch };
    for (uint32_t k = 0; k < 4 * N_SHEETS * 3; k++) {
        const uint32_t room = rooms[k / 4 / N_SHEETS], most = room > 128 ? room / 4 * 4 : 128;
        const struct sheet *s = &sheets[k / 4 % N_SHEETS];
        const struct panel_config c = config_of(s, (int)(k % 4));
        const struct panel_rect all = { 0, 0, k % 2 ? s->height : s->width, k % 2 ? s->width : s->height };
        const uint32_t bytes = (uint32_t)all.w * all.h * bits_a_pixel(s) / 8;
        uint16_t want[16];
        const uint32_t n = window(s, (int)(k % 4), &all, want);
        struct wire w = wire_new();
        struct panel panel;
        wire_hook(&w);
        memset(scratch, 0xa5, sizeof scratch);
        assert_int_equal(panel_init(&panel, &c, &w.bus, scratch, room), HAL_ERR_NONE);
        assert_int_equal(w.transfers, (bytes + most - 1) / most);
        for (uint32_t i = room; i < sizeof scratch; i++)
            assert_true(scratch[i] == 0xa5);
        assert_int_equal(w.log[0], RESET << 8);
        assert_int_equal(w.log[w.log[1] == CODED(0x01) ? 2 : 1], CODED(s->wide ? 0x28 : 0xae));
        assert_int_equal(COUNT(&w, CODED(0x11)), s->wide);
        if (s->args_low)
            assert_int_equal(s->type == &panel_ssd1306 ? COUNT(&w, CODED(0x8d), CODED(0x14)) :
                                                         COUNT(&w, CODED(0xad), CODED(0x03)), 1);
        assert_true(w.n > 1 + n + bytes && is_on(s, w.log[w.n - 1]));
        assert_true(goes_on(&w, w.n - 1 - bytes - n, want, n));
        for (uint32_t i = w.n - 1 - bytes; i < w.n - 1; i++)
            assert_int_equal(w.log[i], PIXEL << 8);
        if (!s->args_low) /* there an argument may look like it */
            for (uint32_t i = 0; i < w.n - 1; i++)
                assert_false(is_on(s, w.log[i]));
        assert_true(w.pause_us >= 5000 && w.pause_us <= 300000);
        assert_true(!s->wide || w.pause_us >= 245000);
        assert_int_equal(w.locks, 1);
        assert_false(w.held);
        assert_int_equal(panel_width(&panel), all.w);
        assert_int_equal(panel_height(&panel), all.h);
        sim_kept_end(w.log);
    }
}

/* Rotation, colour order, inversion and brightness, read in the datasheets. */
static void settings_are_sent(void **state)
{
    static const struct {
        const struct panel_type *type;
        uint8_t turn, at[4], bgr;      /* command of rotation, its argument, what bgr toggles */
        uint8_t straight, inverted;    /* commands */
        uint8_t light, shift;          /* command of brightness */
    } want[] = {
        { &panel_st7789, 0x36, { 0x00, 0x60, 0xc0, 0xa0 }, 0x08, 0x20, 0x21, 0x51, 0 },
        { &panel_ili9341, 0x36, { 0x40, 0x20, 0x80, 0xe0 }, 0x08, 0x20, 0x21, 0x51, 0 },
        { &panel_gc9a01, 0x36, { 0x00, 0x60, 0xc0, 0xa0 }, 0x08, 0x20, 0x21, 0x51, 0 },
        { &panel_ssd1351, 0xa0, { 0x74, 0x77, 0x66, 0x65 }, 0x04, 0xa6, 0xa7, 0xc7, 4 },
        { &panel_ssd0323, 0, { 0 }, 0, 0xa4, 0xa7, 0x81, 1 },
        { &panel_ssd1306, 0, { 0 }, 0, 0xa6, 0xa7, 0x81, 0 }
    };
    for (uint32_t k = 0; k < 6 * 8; k++) {
        const uint32_t i = k / 8, rotate = k % 4, set = k / 4 % 2;
        uint32_t at = 0;
        while (sheets[at].type != want[i].type)
            at++;
        struct panel_config c = config_of(&sheets[at], (int)rotate);
        c.bgr = c.invert = (uint8_t)set;
        c.dim = set ? 75 : 0;
        struct wire w = wire_new();
        struct panel panel;
        assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
        const uint16_t arg = (uint16_t)((sheets[at].args_low ? CODE : ARG) << 8);
        const uint8_t bits = want[i].at[rotate] ^ (set ? want[i].bgr : 0), level = (set ? 180 : 255) >> want[i].shift;
        if (want[i].turn)
            assert_int_equal(COUNT(&w, CODED(want[i].turn), (uint16_t)(arg | bits)), 1);
        assert_true(COUNT(&w, CODED(set ? want[i].inverted : want[i].straight)) >= 1);
        assert_int_equal(COUNT(&w, CODED(set ? want[i].straight : want[i].inverted)), 0);
        assert_int_equal(COUNT(&w, CODED(want[i].light), (uint16_t)(arg | level)), 1);
        sim_kept_end(w.log);
    }
}

static void bytes_of_the_other_order(void **state)
{
    struct panel_config c = config_of(&sheets[0], 0);
    struct wire w = wire_new();
    struct panel panel;
    assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
    assert_int_equal(COUNT(&w, CODED(0xb0)), 0);
    c.lsb_first = 1;
    assert_int_equal(panel_scratch_bytes(&c, 100), 0); /* ST7789 is told */
    assert_int_equal(panel_init(&panel, &c, &w.bus, NULL, 0), HAL_ERR_NONE);
    assert_int_equal(COUNT(&w, CODED(0xb0), ARGUED(0x00), ARGUED(0xf8)), 1);
    const struct panel_rect r = { 0, 0, 10, 10 };
    assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
    assert_ptr_equal(w.out, px);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    sim_kept_end(w.log);
}

/* TEON only where it was asked for, and only where there is a pin for it. */
static void tearing_effect(void **state)
{
    for (uint32_t i = 0; i < N_SHEETS; i++)
        for (uint8_t te = 0; te < 2; te++) {
            struct panel_config c = config_of(&sheets[i], 0);
            struct wire w = wire_new();
            struct panel panel;
            c.te = te;
            assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
            if (!sheets[i].args_low)
                assert_int_equal(COUNT(&w, CODED(0x35), ARGUED(0x00)), te && bits_a_pixel(&sheets[i]) == 16 &&
                                                                       sheets[i].type != &panel_ssd1351);
            sim_kept_end(w.log);
        }
}

/* What the grain is, and which glass has which commons. */
static void tables(void **state)
{
    assert_int_equal(n_panel_types, 6);
    for (uint32_t i = 0; i < n_panel_types; i++)
        for (uint32_t k = 0; k < i; k++)
            assert_string_not_equal(panel_name(panel_types[i]), panel_name(panel_types[k]));
    for (uint32_t k = 0; k < 4 * N_SHEETS; k++) {
        const struct panel_config c = config_of(&sheets[k / 4], (int)(k % 4));
        const struct panel_grain g = panel_grain(&c);
        assert_int_equal(g.x, step_x(&sheets[k / 4], (int)(k % 4)));
        assert_int_equal(g.y, step_y(&sheets[k / 4], (int)(k % 4)));
        assert_int_equal(panel_scratch_bytes(&c, 800), bits_a_pixel(&sheets[k / 4]) == 16 ? 0 :
                                                       100 * bits_a_pixel(&sheets[k / 4]));
    }
    static const struct { uint8_t sheet, lines, pins; } mono[] = { { 8, 63, 0x12 }, { 9, 31, 0x02 }, { 10, 47, 0x12 },
                                                                   { 11, 39, 0x12 } };
    for (uint32_t i = 0; i < 4; i++) {
        const struct panel_config c = config_of(&sheets[mono[i].sheet], 0);
        struct wire w = wire_new();
        struct panel panel;
        assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
        assert_int_equal(COUNT(&w, CODED(0xa8), CODED(mono[i].lines)), 1);
        assert_int_equal(COUNT(&w, CODED(0xda), CODED(mono[i].pins)), 1);
        sim_kept_end(w.log);
    }
    for (uint32_t i = 5; i < 7; i++) { /* SSD1351: lines */
        const struct panel_config c = config_of(&sheets[i], 0);
        struct wire w = wire_new();
        struct panel panel;
        assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
        assert_int_equal(COUNT(&w, CODED(0xca), ARGUED(sheets[i].height - 1)), 1);
        sim_kept_end(w.log);
    }
    for (int err = -130; err <= 0; err++)
        assert_non_null(panel_strerror(err));
    assert_string_equal(panel_strerror(-130), panel_strerror(1));
}

/* ---- Refusals ------------------------------------------------------------------------------------------ */

static void bad_configurations(void **state)
{
    const struct {
        struct panel_config config;
        uint32_t n_scratch;
        int err;
    } bad[] = {
        { { NULL, 240, 240 }, 0, HAL_ERR_ARG },
        { { &panel_st7789, 240, 240, .rotate = 4 }, 0, PANEL_ERR_ROTATE },
        { { &panel_st7789, 241, 240 }, 0, PANEL_ERR_SIZE },
        { { &panel_st7789, 240, 321 }, 0, PANEL_ERR_SIZE },
        { { &panel_st7789, 0, 240 }, 0, PANEL_ERR_SIZE },
        { { &panel_st7789, 240, 0 }, 0, PANEL_ERR_SIZE },
        { { &panel_st7789, 135, 240, 106, 40 }, 0, PANEL_ERR_SIZE },
        { { &panel_st7789, 135, 240, 52, 81 }, 0, PANEL_ERR_SIZE },
        { { &panel_st7789, 135, 240, -1, 0 }, 0, PANEL_ERR_SIZE },
        { { &panel_st7789, 135, 240, 0, -1 }, 0, PANEL_ERR_SIZE },
        { { &panel_gc9a01, 240, 320 }, 0, PANEL_ERR_SIZE },
        { { &panel_ssd1351, 128, 64 }, 0, PANEL_ERR_SIZE },
        { { &panel_ssd1306, 128, 32, 0, 32 }, 0, PANEL_ERR_SIZE }, /* rows that the glass would not show */
        { { &panel_ssd1306, 64, 48, 32, 8 }, 0, PANEL_ERR_SIZE },
        { { &panel_ssd1351, 128, 96, 0, 32 }, 0, PANEL_ERR_SIZE },
        { { &panel_ssd1306, 128, 56 }, 4096, PANEL_ERR_SIZE },
        { { &panel_ssd1306, 64, 48, 32, 4 }, 4096, PANEL_ERR_SIZE },
        { { &panel_ssd0323, 128, 64, 0, 17 }, 4096, PANEL_ERR_SIZE },
        { { &panel_ssd0323, 128, 64 }, 0, PANEL_ERR_SCRATCH },
        { { &panel_ssd1306, 128, 64 }, 0, PANEL_ERR_SCRATCH },
        { { &panel_ili9341, 240, 320, .lsb_first = 1 }, 1, PANEL_ERR_SCRATCH }
    };
    struct wire w = wire_new();
    struct panel panel = { 0 };
    const struct panel_rect r = { 0, 0, 8, 8 };
    const struct panel_config good = config_of(&sheets[0], 0);
    assert_int_equal(bring_up(&panel, &w, &good), HAL_ERR_NONE);
    w.verbs = 0, w.locks = 0;
    for (uint32_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(panel_init(&panel, &bad[i].config, &w.bus, scratch, bad[i].n_scratch), bad[i].err);
        assert_int_equal(panel_send(&panel, &r, px, 0), PANEL_ERR_STATE);
    }
    const struct panel_config mono = config_of(&sheets[8], 0);
    assert_int_equal(panel_init(&panel, &mono, &w.bus, NULL, 4096), PANEL_ERR_SCRATCH);
    assert_int_equal(panel_init(&panel, &mono, &w.bus, scratch + 2, 4096), PANEL_ERR_SCRATCH);
    assert_int_equal(panel_init(NULL, &mono, &w.bus, scratch, 4096), HAL_ERR_ARG);
    for (int k = 0; k < 2; k++) { /* one that is awake cannot be used then */
        panel.locked = 0;
        assert_int_equal(bring_up(&panel, &w, &good), HAL_ERR_NONE);
        assert_int_equal(panel_init(&panel, k ? &mono : NULL, k ? NULL : &w.bus, scratch, 4096), HAL_ERR_ARG);
        assert_int_equal(panel_send(&panel, &r, px, 0), PANEL_ERR_STATE);
    }
    w.verbs = 0, w.locks = 0;
    w.refuse = 1;
    assert_int_equal(panel_init(&panel, &mono, &w.bus, scratch, 4096), HAL_ERR_BUSY);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    assert_int_equal(w.verbs, 0);
    assert_int_equal(w.locks, 0);
    sim_kept_end(w.log);
}

static void bad_rectangles(void **state)
{
    struct wire w = wire_new();
    struct panel panel;
    const struct panel_config c = config_of(&sheets[11], 1); /* 72x40 turned: 40 x 72, grain 8 x 1 */
    const struct {
        struct panel_rect rect;
        int err;
    } bad[] = { { { 0, 0, 0, 1 }, PANEL_ERR_RECT },     { { 0, 0, 8, 0 }, PANEL_ERR_RECT },
                { { 40, 0, 8, 1 }, PANEL_ERR_RECT },    { { 0, 72, 8, 1 }, PANEL_ERR_RECT },
                { { 8, 0, 40, 1 }, PANEL_ERR_RECT },    { { 0, 65535, 8, 2 }, PANEL_ERR_RECT },
                { { 65528, 0, 16, 1 }, PANEL_ERR_RECT }, { { 4, 0, 8, 1 }, PANEL_ERR_GRAIN },
                { { 8, 0, 4, 1 }, PANEL_ERR_GRAIN },    { { 36, 0, 4, 1 }, PANEL_ERR_GRAIN },
                { { 0, 0, 40, 33 }, PANEL_ERR_SCRATCH } };
    wire_hook(&w);
    assert_int_equal(panel_init(&panel, &c, &w.bus, scratch, panel_scratch_bytes(&c, 40 * 32)), HAL_ERR_NONE);
    const uint32_t verbs = w.verbs;
    const int locks = w.locks;
    for (uint32_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(panel_send(&panel, &bad[i].rect, px, 0), bad[i].err);
    const struct panel_rect good = { 8, 3, 32, 1 };
    assert_int_equal(panel_send(&panel, &good, px + 1, 0), HAL_ERR_ARG);
    assert_int_equal(panel_send(&panel, &good, px, 65), HAL_ERR_ARG);
    assert_int_equal(panel_send(&panel, &good, px, 62), HAL_ERR_ARG);
    assert_int_equal(panel_send(&panel, &good, NULL, 0), HAL_ERR_ARG);
    assert_int_equal(panel_send(&panel, NULL, px, 0), HAL_ERR_ARG);
    assert_int_equal(panel_send(NULL, &good, px, 0), HAL_ERR_ARG);
    assert_int_equal(panel_wait(NULL), HAL_ERR_ARG);
    assert_int_equal(panel_rotate(&panel, 4), PANEL_ERR_ROTATE);
    w.refuse = 1;
    assert_int_equal(panel_send(&panel, &good, px, 0), HAL_ERR_BUSY);
    assert_int_equal(panel_rotate(&panel, 2), HAL_ERR_BUSY);
    assert_int_equal(panel_invert(&panel, 1), HAL_ERR_BUSY);
    assert_int_equal(panel_sleep(&panel), HAL_ERR_BUSY);
    w.refuse = 0;
    assert_int_equal(w.verbs, verbs);
    assert_int_equal(w.locks, locks);
    assert_int_equal(panel_send(&panel, &good, px, 0), HAL_ERR_NONE); /* and none of that left a trace */
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    assert_int_equal(panel_rotate(&panel, 0), HAL_ERR_NONE); /* now 72 x 40, grain 1 x 8 */
    const uint32_t turned = w.verbs;
    assert_int_equal(panel_send(&panel, &(struct panel_rect){ 5, 4, 3, 8 }, px, 0), PANEL_ERR_GRAIN);
    assert_int_equal(panel_send(&panel, &(struct panel_rect){ 5, 8, 3, 4 }, px, 0), PANEL_ERR_GRAIN);
    assert_int_equal(w.verbs, turned);
    assert_int_equal(panel_rotate(&panel, 1), HAL_ERR_NONE);
    const struct panel_rect bottom = { 0, 40, 40, 32 };
    assert_int_equal(panel_send(&panel, &bottom, px, 0), HAL_ERR_NONE);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    sim_kept_end(w.log);
}

static void one_thing_at_a_time(void **state)
{
    struct wire w = wire_new();
    struct panel panel;
    const struct panel_config c = config_of(&sheets[0], 0);
    const struct panel_rect r = { 0, 0, 8, 8 };
    assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
    assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
    const uint32_t verbs = w.verbs;
    assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_STATE);
    assert_int_equal(panel_rotate(&panel, 1), HAL_ERR_STATE);
    assert_int_equal(panel_invert(&panel, 1), HAL_ERR_STATE);
    assert_int_equal(panel_brightness(&panel, 1), HAL_ERR_STATE);
    assert_int_equal(panel_sleep(&panel), HAL_ERR_STATE);
    assert_int_equal(panel_wake(&panel), PANEL_ERR_STATE);
    assert_int_equal(w.verbs, verbs);
    assert_true(w.held);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    assert_false(w.held);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    assert_int_equal(panel_sleep(&panel), HAL_ERR_NONE);
    assert_int_equal(panel_send(&panel, &r, px, 0), PANEL_ERR_STATE);
    assert_int_equal(panel_rotate(&panel, 1), PANEL_ERR_STATE);
    assert_int_equal(panel_sleep(&panel), PANEL_ERR_STATE);
    assert_int_equal(panel_wake(&panel), HAL_ERR_NONE);
    assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    sim_kept_end(w.log);
}

/* Sleep and wake as the datasheets want them, with what they want between. */
static void sleeping(void **state)
{
    for (uint32_t k = 0; k < N_SHEETS; k++) {
        const struct sheet *s = &sheets[k];
        const struct panel_config c = config_of(s, 0);
        struct wire w = wire_new();
        struct panel panel;
        assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
        w.n = w.pause_us = 0;
        assert_int_equal(panel_sleep(&panel), HAL_ERR_NONE);
        assert_int_equal(w.log[0], CODED(s->wide ? 0x28 : 0xae));
        assert_int_equal(COUNT(&w, CODED(0x10)), s->wide || s->type == &panel_ssd1306);
        assert_int_equal(w.pause_us, s->wide ? 120000 : 0);
        w.n = w.pause_us = 0;
        assert_int_equal(panel_wake(&panel), HAL_ERR_NONE);
        assert_true(is_on(s, w.log[w.n - 1]));
        assert_int_equal(COUNT(&w, CODED(0x11)), s->wide);
        assert_int_equal(w.pause_us, s->wide ? 120000 : 0);
        for (uint32_t fail = 1; s->wide && COUNT(&w, CODED(0x11)) < 2; fail++) { /* it fails, and may have arrived */
            w.fail_at = 0;
            assert_int_equal(panel_sleep(&panel), HAL_ERR_NONE);
            w.fail_at = w.verbs + fail;
            w.n = w.pause_us = 0;
            assert_int_equal(panel_wake(&panel), HAL_ERR_BUS);
            if (COUNT(&w, CODED(0x11)) == 1) { /* so the next call sends no set-up within the controller's 120 ms */
                assert_int_equal(w.pause_us, 120000);
                assert_int_equal(panel_wake(&panel), HAL_ERR_NONE);
                break;
            }
        }
        assert_false(w.held);
        sim_kept_end(w.log);
    }
}

/* ---- Failures ------------------------------------------------------------------------------------------ */

static const struct panel_rect thirds[3] = { { 0, 0, 32, 8 }, { 8, 8, 16, 16 }, { 0, 24, 24, 8 } };

/* Set up, three rectangles, one of rows apart, up to the call that fails with HAL_ERR_BUS. 0: none did,
 * 1: panel_init, 2: one of the others. */
static int scenario(struct panel *panel, struct wire *w, const struct panel_config *c)
{
    int err = bring_up(panel, w, c);
    assert_true(!err || err == HAL_ERR_BUS);
    if (err)
        return 1;
    for (int k = 0; k < 3 && !err; k++) {
        err = panel_send(panel, &thirds[k], px, k == 1 ? 40 : 0);
        assert_true(!err || err == HAL_ERR_BUS);
        if (!err)
            err = panel_wait(panel);
        assert_false(w->held);
    }
    return err ? 2 : 0;
}

/* The bus fails at verb k, once. Afterwards all is as it was, and the next rectangle comes after the set-up. */
static int fails_at(const struct sheet *s, const struct panel_config *c, uint32_t k, const struct wire *whole)
{
    struct wire w = wire_new();
    struct panel panel;
    w.fail_at = k;
    const int failed = scenario(&panel, &w, c);
    CASE_CHECK(failed && !w.held && !w.out && !panel.locked);
    if (failed == 1) {
        CASE_CHECK(panel_send(&panel, &thirds[0], px, 0) == PANEL_ERR_STATE);
        CASE_CHECK(panel_wait(&panel) == HAL_ERR_NONE && panel_sleep(&panel) == PANEL_ERR_STATE);
        CASE_CHECK(w.verbs == k);
        w.n = 0;
        CASE_CHECK(bring_up(&panel, &w, c) == HAL_ERR_NONE);
        CASE_CHECK(goes_on(whole, 0, w.log, w.n));
    } else {
        w.fail_at = w.verbs + 1; /* and once more, in the window: what is now the state of the panel is known */
        CASE_CHECK(panel_send(&panel, &thirds[1], px, 0) == HAL_ERR_BUS && !w.held);
        w.n = 0;
        CASE_CHECK(panel_send(&panel, &thirds[0], px, 0) == HAL_ERR_NONE && panel_wait(&panel) == HAL_ERR_NONE);
        uint16_t want[16];
        const uint32_t n = window(s, c->rotate, &thirds[0], want), bytes = 32 * 8 * bits_a_pixel(s) / 8;
        const uint32_t before = w.n - bytes - n;
        CASE_CHECK(w.n > bytes + n && goes_on(&w, before, want, n) && is_on(s, w.log[before - 1]));
        uint32_t at = 0; /* what comes before the window is the set-up of panel_init */
        while (at < whole->n && !goes_on(whole, at, w.log, before - 1))
            at++;
        CASE_CHECK(at < whole->n && before > 6);
    }
    const uint32_t at = w.n;
    CASE_CHECK(panel_send(&panel, &thirds[1], px, 0) == HAL_ERR_NONE && panel_wait(&panel) == HAL_ERR_NONE);
    CASE_CHECK(sent(&w, at, s, c->rotate, &thirds[1])); /* no set-up any more */
    sim_kept_end(w.log);
    return 1;
}

static int failure_case(uint64_t seed)
{
    const struct sheet *s = &sheets[seed % N_SHEETS];
    const struct panel_config c = config_of(s, (int)(seed / N_SHEETS % 4 & 2));
    struct wire whole = wire_new();
    struct panel panel;
    CASE_CHECK(scenario(&panel, &whole, &c) == 0);
    for (uint32_t k = 1; k <= whole.verbs; k++) {
        if (k > 200 && k + 200 < whole.verbs && k % 97) /* the clearing of a large glass: one as another */
            continue;
        if (!fails_at(s, &c, k, &whole))
            return case_wrong("%s %ux%u, verb %u of %u", panel_name(s->type), s->width, s->height, k, whole.verbs);
    }
    sim_kept_end(whole.log);
    return 1;
}

/* The first send after a failure sends the set-up, whatever failed: that is what fails_at skips over. */
static void set_up_follows_each_kind_of_failure(void **state)
{
    for (uint32_t k = 0; k < N_SHEETS; k++) {
        const struct panel_config c = config_of(&sheets[k], 0);
        const struct panel_rect r = { 0, 0, 16, 8 };
        for (uint32_t verb_at = 1; verb_at <= 16; verb_at++) {
            struct wire w = wire_new();
            struct panel panel;
            assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
            uint32_t at = w.n;
            assert_int_equal(panel_send(&panel, &r, px, 40), HAL_ERR_NONE);
            assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
            const uint32_t usual = w.n - at;
            w.fail_at = w.verbs + verb_at;
            int err = panel_send(&panel, &r, px, 40);
            err = err ? err : panel_wait(&panel);
            if (w.verbs < w.fail_at) { /* there were fewer verbs */
                sim_kept_end(w.log);
                break;
            }
            assert_int_equal(err, HAL_ERR_BUS);
            at = w.n;
            assert_int_equal(panel_send(&panel, &r, px, 40), HAL_ERR_NONE);
            assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
            assert_true(w.n - at > usual + 6);
            if (sheets[k].args_low) /* a command that was cut off swallows these */
                assert_true(goes_on(&w, at, (uint16_t[]){ CODED(0xe3), CODED(0xe3) }, 2));
            at = w.n;
            assert_int_equal(panel_send(&panel, &r, px, 40), HAL_ERR_NONE);
            assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
            assert_int_equal(w.n - at, usual);
            sim_kept_end(w.log);
        }
    }
}

/* What the bus failed to tell is told with the next set-up; sleep that failed is left by panel_wake alone. */
static void settings_outlive_failures(void **state)
{
    const struct panel_rect r = { 0, 0, 16, 8 };
    const struct panel_config c = config_of(&sheets[2], 0);
    struct wire w = wire_new();
    struct panel panel;
    assert_int_equal(bring_up(&panel, &w, &c), HAL_ERR_NONE);
    w.fail_at = w.verbs + 1;
    assert_int_equal(panel_invert(&panel, 1), HAL_ERR_BUS);
    w.fail_at = w.verbs + 1;
    assert_int_equal(panel_brightness(&panel, 99), HAL_ERR_BUS); /* in the set-up: not taken over */
    assert_int_equal(panel_brightness(&panel, 99), HAL_ERR_NONE);
    w.fail_at = w.verbs + 1;
    assert_int_equal(panel_rotate(&panel, 3), HAL_ERR_BUS);
    assert_int_equal(panel_width(&panel), 240);
    w.n = 0;
    assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    assert_int_equal(COUNT(&w, CODED(0x21)), 1);
    assert_int_equal(COUNT(&w, CODED(0x51), ARGUED(99)), 1);
    assert_int_equal(COUNT(&w, CODED(0x36), ARGUED(0xa0)), 1);
    assert_int_equal(COUNT(&w, CODED(0x2a), ARGUED(0), ARGUED(40), ARGUED(0), ARGUED(55)), 1);
    for (uint32_t k = 1; k <= 2; k++) {
        w.fail_at = w.verbs + k;
        assert_int_equal(panel_sleep(&panel), HAL_ERR_BUS);
        assert_int_equal(panel_send(&panel, &r, px, 0), PANEL_ERR_STATE);
        w.fail_at = w.verbs + k;
        assert_int_equal(panel_wake(&panel), HAL_ERR_BUS);
        assert_int_equal(panel_send(&panel, &r, px, 0), PANEL_ERR_STATE);
        w.n = 0;
        assert_int_equal(panel_wake(&panel), HAL_ERR_NONE);
        assert_int_equal(COUNT(&w, CODED(0x36), ARGUED(0xa0)), 1); /* set up, woken, on */
        assert_true(goes_on(&w, w.n - 2, (uint16_t[]){ CODED(0x11), CODED(0x29) }, 2));
        assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
        assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
        assert_int_equal(panel_sleep(&panel), HAL_ERR_NONE);
        w.fail_at = w.verbs + k;
        assert_int_equal(panel_wake(&panel), HAL_ERR_BUS); /* in the waking itself */
        assert_int_equal(panel_send(&panel, &r, px, 0), PANEL_ERR_STATE);
        assert_int_equal(panel_wake(&panel), HAL_ERR_NONE);
        assert_false(w.held);
    }
    w.fail_at = w.verbs + 1; /* broken, and then in the set-up of sleep */
    assert_int_equal(panel_invert(&panel, 0), HAL_ERR_BUS);
    w.refuse = 1;
    assert_int_equal(panel_sleep(&panel), HAL_ERR_BUSY); /* nothing has changed */
    assert_int_equal(panel_wake(&panel), PANEL_ERR_STATE);
    w.refuse = 0;
    w.fail_at = w.verbs + 1;
    assert_int_equal(panel_sleep(&panel), HAL_ERR_BUS);
    assert_int_equal(panel_send(&panel, &r, px, 0), PANEL_ERR_STATE);
    assert_int_equal(panel_wake(&panel), HAL_ERR_NONE);
    assert_int_equal(panel_send(&panel, &r, px, 0), HAL_ERR_NONE);
    assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
    sim_kept_end(w.log);
}

static const struct CMUnitTest tests[] = {
    CASES_TEST(rectangles_send_their_window_and_no_more, window_case, 4 * N_SHEETS * 4),
    cmocka_unit_test(glass_of_ones_own),
    cmocka_unit_test(colour_is_not_copied),
    cmocka_unit_test(conversion_is_the_formula),
    cmocka_unit_test(dark_until_black),
    cmocka_unit_test(settings_are_sent),
    cmocka_unit_test(bytes_of_the_other_order),
    cmocka_unit_test(tearing_effect),
    cmocka_unit_test(tables),
    cmocka_unit_test(bad_configurations),
    cmocka_unit_test(bad_rectangles),
    cmocka_unit_test(one_thing_at_a_time),
    cmocka_unit_test(sleeping),
    CASES_TEST(every_failure_is_said_and_mended, failure_case, N_SHEETS),
    cmocka_unit_test(set_up_follows_each_kind_of_failure),
    cmocka_unit_test(settings_outlive_failures)
};

CASES_MAIN(tests)
