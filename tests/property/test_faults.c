/* From the renderer through a panel's driver over a bus that fails into the model of its controller: whatever failed,
 * and wherever in a frame, the error reaches the caller and the next good frame is right.
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fault.h"
#include "panel.h"
#include "panel_bus.h"
#include "picture.h"
#include "scenes.h"
#include "zs_damage.h"

#define COLUMNS 5u
#define ROWS 16

static const struct {
    const char *name;
    struct panel_config config;
} modules[] = {
    { "st7789:135x240", { .type = &panel_st7789, .width = 135, .height = 240, .rotate = 1 } },
    { "ssd1306:128x64", { .type = &panel_ssd1306, .width = 128, .height = 64 } },
    { "ssd0323:128x64", { .type = &panel_ssd0323, .width = 128, .height = 64, .rotate = 3 } },
};

/* A module, its driver over a bus that can fail, and a renderer. */
struct chain {
    struct pm_glass glass;
    struct sim_panel_bus end;
    struct hal_fault fault;
    struct panel panel;
    struct zs_config config;
    struct zs_renderer r;
    uint32_t *arena, *scratch;
    uint64_t *sum; /* NULL: without zs_damage_compare */
    struct zs_strip_hashes sums;
    struct demo_frame frame;
    int locked, n_idle, n_done;
    int ended; /* a semaphore: given by done, taken by idle */
};

static int submit(void *ctx, const struct zs_strip *s)
{
    const struct panel_rect rect = { s->x, s->y, s->w, s->h };
    return panel_send(ctx, &rect, s->px, 0);
}

static int wait(void *ctx)
{
    return panel_wait(ctx);
}

static int lock(void *ctx)
{
    return ((struct chain *)ctx)->locked++;
}

static void unlock(void *ctx)
{
    ((struct chain *)ctx)->locked--;
}

static void idle(void *ctx)
{
    struct chain *c = ctx;
    c->n_idle++;
    c->ended -= c->ended > 0;
}

static void done(void *ctx)
{
    struct chain *c = ctx;
    c->n_done++;
    c->ended++;
}

static int set_up(struct chain *c, const struct panel_config *config)
{
    return panel_init(&c->panel, config, &c->fault.bus, c->scratch, panel_scratch_bytes(config, 240u * ROWS));
}

static void chain_open(struct chain *c, unsigned module, uint8_t buffers, int compares)
{
    const struct panel_config *config = &modules[module].config;
    memset(c, 0, sizeof *c);
    assert_int_equal(pm_glass_named(&c->glass, modules[module].name), 1);
    sim_panel_bus_init(&c->end, pm_new(&c->glass));
    hal_fault_init(&c->fault, &c->end.bus);
    c->fault.bus.hooks = (struct hal_hooks){ c, idle, done, lock, unlock };
    c->scratch = malloc(panel_scratch_bytes(config, 240u * ROWS) + 4u);
    assert_int_equal(set_up(c, config), HAL_ERR_NONE);
    c->config = picture_config(panel_width(&c->panel), panel_height(&c->panel), demo_cubes.depth);
    c->config.strip_h = ROWS;
    c->config.buffers = buffers;
    c->arena = malloc(zs_arena_bytes(&c->config));
    assert_int_equal(zs_init(&c->r, &c->config, c->arena, zs_arena_bytes(&c->config)), ZS_OK);
    if (compares) {
        c->sum = malloc(ZS_STRIPS(c->config.height, ROWS) * COLUMNS * sizeof *c->sum);
        assert_int_equal(damage_compare_anew(&c->r, &c->sums, c->sum, COLUMNS), ZS_OK);
    }
}

static void chain_close(struct chain *c)
{
    pm_free(c->end.model);
    free(c->arena);
    free(c->scratch);
    free(c->sum);
}

static int draw(struct chain *c, uint32_t t)
{
    const struct zs_sink sink = { .submit = submit, .wait = wait, .ctx = &c->panel };
    demo_cubes.pose(&c->frame, t, c->config.width, c->config.height);
    const int err = zs_render(&c->r, &c->frame.scene, &c->frame.camera, &sink);
    assert_int_equal(c->locked, 0); /* the bus is nobody's, whatever happened */
    return err;
}

/* Does the glass show what it shows where nothing ever failed? */
static void glass_is_right(struct chain *c, unsigned module, uint32_t t, const char *name)
{
    static uint16_t seen[240 * 240], want[240 * 240];
    struct chain good;
    chain_open(&good, module, 1, 0);
    assert_int_equal(draw(&good, t), ZS_OK);
    assert_true(pm_lit(c->end.model));
    pm_picture(c->end.model, NULL, seen);
    pm_picture(good.end.model, NULL, want);
    const int n = c->glass.width * c->glass.height;
    for (int i = 0; i < n; i++)
        if (seen[i] != want[i])
            fail_msg("%s, %s: pixel %d of the glass", modules[module].name, name, i);
    chain_close(&good);
}

static uint32_t demo_cubes_instances(struct chain *c)
{
    demo_cubes.pose(&c->frame, 0, c->config.width, c->config.height);
    return c->frame.scene.n_instances;
}

static const struct {
    enum hal_fault_kind kind;
    const char *name;
    int err; /* of zs_render in the frame that it hits */
} kinds[] = {
    { HAL_FAULT_REFUSE, "refused", HAL_ERR_BUS },   { HAL_FAULT_CUT, "cut", HAL_ERR_BUS },
    { HAL_FAULT_STUCK, "stuck", HAL_ERR_TIMEOUT },  { HAL_FAULT_LATE, "late", ZS_OK },
    { HAL_FAULT_COMMAND, "command", HAL_ERR_BUS }, { HAL_FAULT_TWICE, "twice", ZS_OK },
};

/* Every kind at every verb of a frame. Two frames of motion before and one after. */
static void the_frame_after_a_fault_is_right(void **state)
{
    unsigned n_hit = 0;
    for (unsigned m = 0; m < sizeof modules / sizeof modules[0]; m++)
        for (unsigned k = 0; k < sizeof kinds / sizeof kinds[0]; k++)
            for (int variant = 0; variant < 4; variant++) {
                struct chain c;
                chain_open(&c, m, (uint8_t)(1 + variant % 2), variant / 2);
                for (uint32_t at = 1, hit = 1; hit && at < 100; at++) {
                    assert_int_equal(draw(&c, 2 * at), ZS_OK);
                    (void)zs_invalidate(&c.r, NULL);
                    hal_fault_set(&c.fault, kinds[k].kind, at, 1);
                    c.fault.n_hit = 0;
                    const int err = draw(&c, 2 * at + 1);
                    hit = c.fault.n_hit;
                    assert_int_equal(err, hit ? kinds[k].err : ZS_OK);
                    hal_fault_set(&c.fault, HAL_FAULT_NONE, 0, 0);
                    const uint32_t next = at % 2 ? 2 * at + 1 : 2 * at + 2; /* the same frame, or one further */
                    assert_int_equal(draw(&c, next), ZS_OK);
                    if (hit && (at < 4 || at % 5 == 0))
                        glass_is_right(&c, m, next, kinds[k].name);
                    n_hit += hit;
                }
                if (kinds[k].kind == HAL_FAULT_LATE)
                    assert_true(c.n_idle >= 1000);
                chain_close(&c);
            }
    print_message("%u faults in %u chains\n", n_hit, (unsigned)(sizeof modules / sizeof modules[0]));
}

/* Several in a row: each frame says so, the first good one is right. */
static void a_bus_that_stays_broken(void **state)
{
    struct chain c;
    chain_open(&c, 0, 2, 1);
    assert_int_equal(draw(&c, 0), ZS_OK);
    hal_fault_set(&c.fault, HAL_FAULT_STUCK, 1, HAL_FAULT_EVER);
    for (uint32_t t = 1; t < 4; t++)
        assert_int_equal(draw(&c, t), HAL_ERR_TIMEOUT);
    hal_fault_set(&c.fault, HAL_FAULT_COMMAND, 1, HAL_FAULT_EVER);
    assert_int_equal(draw(&c, 4), HAL_ERR_BUS);
    hal_fault_set(&c.fault, HAL_FAULT_NONE, 0, 0);
    assert_int_equal(draw(&c, 4), ZS_OK);
    glass_is_right(&c, 0, 4, "broken for long");
    chain_close(&c);
}

/* A panel that lost its supply for a moment: nothing tells, but set up again and declared invalid it is right. One that
 * never becomes ready: the caller is told, and it can be tried again. */
static void a_panel_that_was_reset_or_is_dead(void **state)
{
    for (unsigned m = 0; m < sizeof modules / sizeof modules[0]; m++)
        for (int compares = 0; compares < 2; compares++) {
            struct chain c;
            chain_open(&c, m, 2, compares);
            assert_int_equal(draw(&c, 0), ZS_OK);
            hal_fault_set(&c.fault, HAL_FAULT_LOST, 2, 1);
            (void)zs_invalidate(&c.r, NULL);
            assert_int_equal(draw(&c, 1), ZS_OK);
            assert_int_equal(c.fault.n_hit, 1);
            assert_false(pm_lit(c.end.model));
            hal_fault_set(&c.fault, HAL_FAULT_DEAD, 1, 2);
            assert_int_equal(set_up(&c, &modules[m].config), HAL_ERR_TIMEOUT);
            assert_int_equal(draw(&c, 1), compares ? ZS_OK : PANEL_ERR_STATE); /* nothing changed: nothing sent */
            assert_int_equal(set_up(&c, &modules[m].config), HAL_ERR_TIMEOUT);
            assert_int_equal(set_up(&c, &modules[m].config), HAL_ERR_NONE);
            assert_int_equal(zs_invalidate(&c.r, NULL), ZS_OK);
            assert_int_equal(draw(&c, 1), ZS_OK);
            glass_is_right(&c, m, 1, "after a reset");
            chain_close(&c);
        }
}

/* What broke the transfer also reset the controller, as a discharge does: that the bus failed is enough to know. */
static void a_fault_that_resets_the_panel(void **state)
{
    for (unsigned m = 0; m < sizeof modules / sizeof modules[0]; m++) {
        struct chain c;
        chain_open(&c, m, 2, 0);
        assert_int_equal(draw(&c, 0), ZS_OK);
        hal_fault_set(&c.fault, HAL_FAULT_STUCK, 2, 1);
        assert_int_equal(draw(&c, 1), HAL_ERR_TIMEOUT);
        assert_int_equal(c.end.bus.reset(&c.end.bus), HAL_ERR_NONE);
        assert_false(pm_lit(c.end.model));
        assert_int_equal(draw(&c, 1), ZS_OK);
        glass_is_right(&c, m, 1, "after a fault with a reset");
        chain_close(&c);
    }
}

/* Another user holds the bus: nothing is sent, the caller is told. */
static int busy(void *ctx)
{
    return 1;
}

static void a_bus_that_is_taken(void **state)
{
    struct chain c;
    chain_open(&c, 0, 2, 1);
    assert_int_equal(draw(&c, 0), ZS_OK);
    const uint64_t before = pm_counts(c.end.model)->bytes;
    c.fault.bus.hooks.lock = busy;
    assert_int_equal(draw(&c, 1), HAL_ERR_BUSY);
    assert_int_equal(pm_counts(c.end.model)->bytes, before);
    c.fault.bus.hooks.lock = lock;
    assert_int_equal(draw(&c, 1), ZS_OK);
    glass_is_right(&c, 0, 1, "after it was taken");
    chain_close(&c);
}

/* hooks.done comes once for all bytes that data has taken over, whatever became of them: a semaphore is given once. */
static void each_transfer_is_done_once(void **state)
{
    static const _Alignas(2) uint8_t px[64] = { 0 };
    struct chain c;
    chain_open(&c, 0, 2, 0);
    for (int kind = HAL_FAULT_NONE; kind <= HAL_FAULT_LOST; kind++) {
        hal_fault_set(&c.fault, (enum hal_fault_kind)kind, 1, 1);
        c.n_done = 0;
        const int taken = c.fault.bus.data(&c.fault.bus, px, sizeof px) == HAL_ERR_NONE;
        assert_int_equal(taken, kind != HAL_FAULT_REFUSE);
        (void)c.fault.bus.wait(&c.fault.bus);
        assert_int_equal(c.n_done, kind == HAL_FAULT_TWICE ? 2 : taken);
    }
    chain_close(&c);
}

/* Power comes on, and all memory holds junk: renderer, arena, panel, scratch, what zs_damage_compare and
 * zs_damage_track are given, and the controller's RAM. */
static void power_on_with_junk_in_memory(void **state)
{
    static const uint8_t patterns[] = { 0x00, 0xff, 0xa5, 0x5a, 0x80, 0x01 };
    for (unsigned m = 0; m < sizeof modules / sizeof modules[0]; m++)
        for (unsigned k = 0; k <= sizeof patterns; k++) {
            struct chain c;
            chain_open(&c, m, 2, 1);
            const struct zs_config config = c.config;
            const uint32_t n = demo_cubes_instances(&c), strips = ZS_STRIPS(config.height, ROWS);
            const size_t words = ZS_DAMAGE_WORDS(n, config.height, ROWS);
            uint32_t *memory = malloc(words * sizeof *memory);
            const struct {
                void *at;
                size_t bytes;
            } all[] = { { &c.r, sizeof c.r }, { c.arena, zs_arena_bytes(&config) }, { &c.panel, sizeof c.panel },
                        { c.scratch, panel_scratch_bytes(&modules[m].config, 240u * ROWS) },
                        { c.sum, strips * COLUMNS * sizeof *c.sum }, { memory, words * sizeof *memory } };
            uint32_t noise = 1;
            for (unsigned a = 0; a < sizeof all / sizeof all[0]; a++)
                for (size_t i = 0; i < all[a].bytes; i++) {
                    noise = noise * 1664525u + 1013904223u;
                    ((uint8_t *)all[a].at)[i] = k < sizeof patterns ? patterns[k] : (uint8_t)(noise >> 24);
                }
            pm_free(c.end.model);
            sim_panel_bus_init(&c.end, pm_new(&c.glass));
            assert_int_equal(set_up(&c, &modules[m].config), HAL_ERR_NONE);
            assert_int_equal(zs_init(&c.r, &config, c.arena, zs_arena_bytes(&config)), ZS_OK);
            if (k % 2)
                assert_int_equal(damage_compare_anew(&c.r, &c.sums, c.sum, COLUMNS), ZS_OK);
            if (k / 2 % 2)
                assert_int_equal(zs_damage_track(&c.r, memory, n), ZS_OK);
            for (uint32_t t = 0; t < 3; t++) {
                assert_int_equal(draw(&c, 5 + t), ZS_OK);
                glass_is_right(&c, m, 5 + t, "after power-on");
            }
            free(memory);
            chain_close(&c);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_frame_after_a_fault_is_right),
        cmocka_unit_test(a_bus_that_stays_broken),
        cmocka_unit_test(a_panel_that_was_reset_or_is_dead),
        cmocka_unit_test(a_fault_that_resets_the_panel),
        cmocka_unit_test(a_bus_that_is_taken),
        cmocka_unit_test(each_transfer_is_done_once),
        cmocka_unit_test(power_on_with_junk_in_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
