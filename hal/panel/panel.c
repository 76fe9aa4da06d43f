/* What all controllers have in common; what differs is data in struct panel_type.
 *
 * A function that uses the bus is take (checks, the lock, set-up again after a failure), its commands, give. take and
 * give are the only places that set `broken` and `locked`, so every way out leaves both right.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel.h"

#include <stddef.h>

#include "panel_type.h"

enum state { UNUSABLE, AWAKE, ASLEEP };

#define AFTER_RESET_MS 5 /* all controllers here take commands by then */

/* ---- Commands ------------------------------------------------------------------------------------------ */

static int command(struct panel *p, uint8_t code, const uint8_t *args, uint32_t n)
{
    struct hal_bus *bus = p->bus;
    if (!p->config.type->args_low)
        return bus->command(bus, code, args, n);
    int err = bus->command(bus, code, NULL, 0);
    for (uint32_t i = 0; i < n && !err; i++)
        err = bus->command(bus, args[i], NULL, 0);
    return err;
}

/* A script of panel_type.h; NULL is an empty one. */
static int run(struct panel *p, const uint8_t *script)
{
    int err = HAL_ERR_NONE;
    for (const uint8_t *at = script; at && *at && !err; at += 1u + *at)
        err = command(p, at[1], at + 2, *at - 1u);
    return err;
}

static void pause_ms(struct panel *p, uint32_t ms)
{
    if (ms)
        p->bus->delay(p->bus, ms * 1000u);
}

static int send_rotation(struct panel *p)
{
    const struct panel_type *type = p->config.type;
    const uint8_t turned = type->rotation[p->config.rotate];
    const uint8_t bits = p->config.bgr ? turned ^ type->bgr : turned;
    return type->rotate ? command(p, type->rotate, &bits, 1) : HAL_ERR_NONE;
}

static int send_inversion(struct panel *p)
{
    return command(p, p->config.type->invert[p->config.invert], NULL, 0);
}

static int send_level(struct panel *p)
{
    const struct panel_type *type = p->config.type;
    const uint8_t level = (uint8_t)((255u - p->config.dim) >> type->level_shift);
    return type->level ? command(p, type->level, &level, 1) : HAL_ERR_NONE;
}

/* ---- Sizes and places ---------------------------------------------------------------------------------- */

static const struct panel_glass *glass_of(const struct panel_config *config)
{
    const struct panel_type *type = config->type;
    for (uint32_t i = 0; i < type->n_glass; i++)
        if (type->glass[i].width == config->width && type->glass[i].height == config->height)
            return &type->glass[i];
    return NULL;
}

/* The glass's left top pixel in the controller's RAM, px; 0: it is not all in there, or not shown. A strict type's
 * set-up shows the rows of its table's glass: another y0 would only move what is written. */
static int origin(const struct panel_config *config, int32_t *x, int32_t *y)
{
    const struct panel_type *type = config->type;
    const struct panel_glass *glass = glass_of(config);
    const int own = glass && !config->x0 && !config->y0;
    *x = own ? glass->x0 : config->x0;
    *y = own ? glass->y0 : config->y0;
    return (!type->strict || (glass && *y == glass->y0)) && config->width && config->height && *x >= 0 && *y >= 0 &&
           (uint32_t)*x % type->grain.x == 0 && (uint32_t)*y % type->grain.y == 0 &&
           *x + config->width <= type->ram_width && *y + config->height <= type->ram_height;
}

/* Set p->x0 and y0: what is added to the picture's coordinates (the glass's, where the picture is turned by convert).
 * Mirrored, the glass has what is left of the RAM on its other side before it. */
static void place(struct panel *p)
{
    const struct panel_config *c = &p->config;
    const uint32_t turns = c->type->rotate ? c->rotate : 0;
    int32_t x, y;
    (void)origin(c, &x, &y);
    const int32_t far_x = c->type->ram_width - c->width - x;
    const int32_t far_y = c->type->by_scan ? y : c->type->ram_height - c->height - y;
    const int32_t at_x[4] = { x, y, far_x, far_y }, at_y[4] = { y, far_x, far_y, x };
    p->x0 = (int16_t)at_x[turns];
    p->y0 = (int16_t)at_y[turns];
}

/* Where a rectangle of the picture is on the glass at rotate 0. */
static struct panel_rect unturned(const struct panel_config *c, const struct panel_rect *r)
{
    const uint16_t far_x = (uint16_t)(c->width - (c->rotate == 1 ? r->y + r->h : r->x + r->w));
    const uint16_t far_y = (uint16_t)(c->height - (c->rotate == 3 ? r->x + r->w : r->y + r->h));
    switch (c->rotate) {
    case 1: return (struct panel_rect){ far_x, r->x, r->h, r->w };
    case 2: return (struct panel_rect){ far_x, far_y, r->w, r->h };
    case 3: return (struct panel_rect){ r->y, far_y, r->h, r->w };
    default: return *r;
    }
}

static int send_range(struct panel *p, uint8_t code, uint32_t first, uint32_t last)
{
    const uint8_t wide[4] = { (uint8_t)(first >> 8), (uint8_t)first, (uint8_t)(last >> 8), (uint8_t)last };
    const uint8_t narrow[2] = { (uint8_t)first, (uint8_t)last };
    return p->config.type->wide ? command(p, code, wide, 4) : command(p, code, narrow, 2);
}

/* Let the pixels that come go into a rectangle of the picture. */
static int send_window(struct panel *p, const struct panel_rect *rect)
{
    const struct panel_type *type = p->config.type;
    const int swapped = type->by_scan && p->config.rotate & 1; /* x steps rows, y columns */
    const struct panel_rect r = type->rotate ? *rect : unturned(&p->config, rect);
    const uint32_t step_x = type->grain.x, step_y = type->grain.y;
    const uint32_t x = (uint32_t)(r.x + p->x0) / step_x, w = r.w / step_x;
    const uint32_t y = (uint32_t)(r.y + p->y0) / step_y, h = r.h / step_y;
    int err = send_range(p, swapped ? type->rows : type->columns, x, x + w - 1u);
    err = err ? err : send_range(p, swapped ? type->columns : type->rows, y, y + h - 1u);
    return err || !type->write ? err : command(p, type->write, NULL, 0);
}

/* ---- Set-up -------------------------------------------------------------------------------------------- */

/* Everything but sleep and on: may be sent at any time, and leaves the panel the same. */
static int set_up(struct panel *p)
{
    const struct panel_type *type = p->config.type;
    const struct panel_glass *glass = glass_of(&p->config);
    int err = run(p, type->setup);
    err = err || !glass ? err : run(p, glass->setup);
    err = err || !p->config.lsb_first ? err : run(p, type->lsb_first);
    err = err || !p->config.te ? err : run(p, type->te);
    err = err ? err : send_rotation(p);
    err = err ? err : send_inversion(p);
    return err ? err : send_level(p);
}

/* Bytes of n pixels on the wire, rounded up. */
static uint32_t wire_bytes(const struct panel_type *type, uint32_t n)
{
    switch (type->format) {
    case PANEL_MONO: return n / 8u + (n % 8u != 0);
    case PANEL_GREY4: return n / 2u + n % 2u;
    default: return 2u * n;
    }
}

/* All of the picture black: zeros in every format, as many at a time as scratch holds whole pixels of. */
static int clear(struct panel *p)
{
    static const _Alignas(4) uint8_t black[128] = { 0 };
    const int own = p->n_scratch <= sizeof black;
    const uint8_t *zeros = own ? black : p->scratch;
    const uint32_t most = own ? (uint32_t)sizeof black : p->n_scratch & ~3u;
    const struct panel_rect all = { 0, 0, panel_width(p), panel_height(p) };
    uint32_t left = wire_bytes(p->config.type, (uint32_t)all.w * all.h);
    for (uint32_t i = 0; !own && i < most && i < left; i++)
        p->scratch[i] = 0;
    int err = send_window(p, &all);
    while (left && !err) {
        const uint32_t n = left < most ? left : most;
        err = p->bus->data(p->bus, zeros, n);
        err = err ? err : p->bus->wait(p->bus);
        left -= n;
    }
    return err;
}

/* Out of sleep, where the controller was reset or has just been told to sleep; else it changes nothing. */
static int rouse(struct panel *p)
{
    const int err = run(p, p->config.type->wake);
    pause_ms(p, p->config.type->wake_ms); /* also after an error: the command may have arrived */
    return err;
}

static int bring_up(struct panel *p)
{
    const struct panel_type *type = p->config.type;
    int err = p->bus->reset(p->bus);
    pause_ms(p, err ? 0 : AFTER_RESET_MS);
    err = err ? err : run(p, type->reset);
    pause_ms(p, err ? 0 : type->reset_ms);
    err = err ? err : command(p, type->off, NULL, 0);
    err = err ? err : set_up(p);
    err = err ? err : rouse(p);
    err = err ? err : command(p, type->off, NULL, 0); /* the first may have been taken for an argument */
    err = err ? err : clear(p);
    return err ? err : command(p, type->on, NULL, 0);
}

/* ---- The bus, taken and given back --------------------------------------------------------------------- */

static int lock(struct panel *p)
{
    const struct hal_hooks *hooks = &p->bus->hooks;
    if (hooks->lock && hooks->lock(hooks->ctx))
        return HAL_ERR_BUSY;
    p->locked = 1;
    return HAL_ERR_NONE;
}

/* Give the bus back. Returns err. */
static int give(struct panel *p, int err)
{
    const struct hal_hooks *hooks = &p->bus->hooks;
    p->broken = p->broken || err;
    p->locked = 0;
    if (hooks->unlock)
        hooks->unlock(hooks->ctx);
    return err;
}

/* May this panel, in this state, be spoken to? */
static int ready(const struct panel *p, uint8_t state)
{
    if (!p)
        return HAL_ERR_ARG;
    if (p->state != state)
        return PANEL_ERR_STATE;
    return p->locked ? HAL_ERR_STATE : HAL_ERR_NONE;
}

/* Take the bus for a panel that is ready; after a failure set it up anew, and wake it: what broke the transfer may have
 * reset the controller. On a negative return it is given back. */
static int take(struct panel *p)
{
    int err = lock(p);
    if (err || !p->broken)
        return err;
    err = set_up(p);
    if (!err && p->state == AWAKE) {
        err = rouse(p);
        err = err ? err : command(p, p->config.type->on, NULL, 0);
    }
    if (err)
        return give(p, err);
    p->broken = 0;
    return HAL_ERR_NONE;
}

/* ---- What panel.h offers ------------------------------------------------------------------------------- */

enum panel_format panel_format(const struct panel_type *type)
{
    return (enum panel_format)type->format;
}

const char *panel_name(const struct panel_type *type)
{
    return type->name;
}

static int converts(const struct panel_config *config)
{
    return config->type->format != PANEL_RGB565 || (config->lsb_first && !config->type->lsb_first);
}

uint32_t panel_scratch_bytes(const struct panel_config *config, uint32_t n_px)
{
    return converts(config) ? wire_bytes(config->type, n_px) : 0;
}

struct panel_grain panel_grain(const struct panel_config *config)
{
    const struct panel_grain grain = config->type->grain, turned = { grain.y, grain.x };
    return config->rotate & 1 ? turned : grain;
}

uint16_t panel_width(const struct panel *panel)
{
    return panel->config.rotate & 1 ? panel->config.height : panel->config.width;
}

uint16_t panel_height(const struct panel *panel)
{
    return panel->config.rotate & 1 ? panel->config.width : panel->config.height;
}

static int init_refusal(const struct panel_config *config, const void *scratch, uint32_t n_scratch)
{
    int32_t x, y;
    if (!config->type)
        return HAL_ERR_ARG;
    if (config->rotate > 3)
        return PANEL_ERR_ROTATE;
    if (!origin(config, &x, &y))
        return PANEL_ERR_SIZE;
    const uint32_t least = panel_scratch_bytes(config, (uint32_t)config->type->grain.x * config->type->grain.y);
    if (n_scratch < least || (n_scratch && !scratch) || (uintptr_t)scratch % 4u)
        return PANEL_ERR_SCRATCH;
    return HAL_ERR_NONE;
}

int panel_init(struct panel *panel, const struct panel_config *config, struct hal_bus *bus, void *scratch,
               uint32_t n_scratch)
{
    if (!panel)
        return HAL_ERR_ARG;
    panel->state = UNUSABLE;
    if (!config || !bus)
        return HAL_ERR_ARG;
    int err = init_refusal(config, scratch, n_scratch);
    if (err)
        return err;
    *panel = (struct panel){ .config = *config, .bus = bus, .scratch = scratch, .n_scratch = n_scratch };
    panel->config.invert = config->invert != 0;
    place(panel);
    err = lock(panel);
    if (err)
        return err;
    err = give(panel, bring_up(panel));
    panel->state = err ? UNUSABLE : AWAKE;
    return err;
}

static int send_refusal(const struct panel *p, const struct panel_rect *r, const uint8_t *px, uint32_t stride)
{
    if (!r || !px || (uintptr_t)px % 2u)
        return HAL_ERR_ARG;
    if (!r->w || !r->h || (uint32_t)r->x + r->w > panel_width(p) || (uint32_t)r->y + r->h > panel_height(p))
        return PANEL_ERR_RECT;
    if (stride % 2u || (stride && stride < r->w * 2u))
        return HAL_ERR_ARG;
    const struct panel_grain grain = panel_grain(&p->config);
    const uint32_t step_x = grain.x, step_y = grain.y;
    if (r->x % step_x || r->w % step_x || r->y % step_y || r->h % step_y)
        return PANEL_ERR_GRAIN;
    return panel_scratch_bytes(&p->config, (uint32_t)r->w * r->h) > p->n_scratch ? PANEL_ERR_SCRATCH : HAL_ERR_NONE;
}

/* Begin to send the pixels; of rows that lie apart, wait for all but the last. */
static int send_pixels(struct panel *p, const struct panel_rect *r, const uint8_t *px, uint32_t stride)
{
    struct hal_bus *bus = p->bus;
    const uint32_t dense = r->w * 2u;
    if (converts(&p->config)) {
        const struct panel_part part = { .px = px, .stride = stride, .rect = r, .rotate = p->config.rotate,
                                         .lsb_first = p->config.lsb_first };
        p->config.type->convert(&part, p->scratch);
        return bus->data(bus, p->scratch, wire_bytes(p->config.type, (uint32_t)r->w * r->h));
    }
    if (stride == dense)
        return bus->data(bus, px, dense * r->h);
    int err = bus->data(bus, px, dense);
    for (uint32_t row = 1; row < r->h && !err; row++) {
        err = bus->wait(bus);
        err = err ? err : bus->data(bus, px + row * stride, dense);
    }
    return err;
}

int panel_send(struct panel *panel, const struct panel_rect *rect, const uint8_t *px, uint32_t stride)
{
    int err = ready(panel, AWAKE);
    err = err ? err : send_refusal(panel, rect, px, stride);
    err = err ? err : take(panel);
    if (err)
        return err;
    err = send_window(panel, rect);
    err = err ? err : send_pixels(panel, rect, px, stride ? stride : rect->w * 2u);
    return err ? give(panel, err) : HAL_ERR_NONE;
}

int panel_wait(struct panel *panel)
{
    if (!panel)
        return HAL_ERR_ARG;
    return panel->locked ? give(panel, panel->bus->wait(panel->bus)) : HAL_ERR_NONE;
}

int panel_rotate(struct panel *panel, uint8_t rotate)
{
    int err = ready(panel, AWAKE);
    if (!err && rotate > 3)
        err = PANEL_ERR_ROTATE;
    err = err ? err : take(panel);
    if (err)
        return err;
    panel->config.rotate = rotate;
    place(panel);
    err = send_rotation(panel);
    return give(panel, err ? err : clear(panel));
}

int panel_invert(struct panel *panel, uint8_t invert)
{
    int err = ready(panel, AWAKE);
    err = err ? err : take(panel);
    if (err)
        return err;
    panel->config.invert = invert != 0;
    return give(panel, send_inversion(panel));
}

int panel_brightness(struct panel *panel, uint8_t level)
{
    int err = ready(panel, AWAKE);
    err = err ? err : take(panel);
    if (err)
        return err;
    panel->config.dim = (uint8_t)(255u - level);
    return give(panel, send_level(panel));
}

int panel_sleep(struct panel *panel)
{
    int err = ready(panel, AWAKE);
    if (err)
        return err;
    err = take(panel);
    if (err == HAL_ERR_BUSY)
        return err;
    panel->state = ASLEEP; /* also where it fails: who knows what arrived; panel_wake puts it right */
    if (err)
        return err;
    err = command(panel, panel->config.type->off, NULL, 0);
    err = err ? err : run(panel, panel->config.type->sleep);
    pause_ms(panel, panel->config.type->wake_ms);
    return give(panel, err);
}

int panel_wake(struct panel *panel)
{
    int err = ready(panel, ASLEEP);
    err = err ? err : take(panel);
    if (err)
        return err;
    err = rouse(panel);
    err = err ? err : command(panel, panel->config.type->on, NULL, 0);
    if (!err)
        panel->state = AWAKE;
    return give(panel, err);
}
