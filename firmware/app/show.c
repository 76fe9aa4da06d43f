/* The show: a scene on the board's panel, for ever; show.h has what there is to choose. While one strip is on the wire
 * the next is drawn, also from one frame to the next: a frame's last strip leaves while the vertices of the next one
 * are worked on.
 *
 * The animation follows the clock: a board that cannot keep its pace leaves frames of it out and counts them as late.
 * Every STATS_EVERY frames a line of numbers is written. An error of the panel is written too, what is left of the
 * frame is dropped, and the driver sets the panel up again before the next.
 *
 * With two cores pair.h shares the frame out; strips then leave by interrupts, also while this core draws.
 *
 * SPDX-License-Identifier: MIT
 */
#include "hal.h"
#include "line.h"
#include "panel.h"
#include "show.h"
#if SHOW_PIECE
#include "pieces.h"
#endif
#if SHOW_CORES == 2
#include "pair.h"
#include "second.h"
#endif

#define STATS_EVERY 32u
#define US_A_SECOND 1000000u

static const struct panel_config glass = {
    .type = &SHOW_PANEL, .width = SHOW_GLASS_WIDTH, .height = SHOW_GLASS_HEIGHT, .rotate = SHOW_ROTATE,
    .invert = SHOW_INVERT, .bgr = SHOW_BGR
};

/* A test writes into the flash image: frames * step numbers, 0, step, 2 step ..., are drawn without regard to the
 * clock; then the show stops. frames 0: for ever, by the clock. */
struct show_test {
    uint32_t frames, step;
};
extern const struct show_test show_test;
const struct show_test show_test = { .step = 1 };

/* What the loop is at: for a debugger, and for a test that counts cycles. */
enum show_phase { SHOW_ELSE, SHOW_DRAW, SHOW_SEND, SHOW_WAIT };
#if SHOW_CORES == 2
extern volatile uint8_t pair_phase[2]; /* pair.c's, by core */
#define show_phase pair_phase[0]
#else
extern volatile uint8_t show_phase;
volatile uint8_t show_phase;
#endif

/* Sums since the last line of statistics, in ticks. */
struct tally {
    uint64_t since;          /* when it was begun */
    uint64_t draw, busy;     /* drawing; in the panel's functions, with two cores in waiting for the other one too */
    uint32_t frames, late;   /* late: took longer than a frame of the animation */
#if SHOW_CORES == 2
    uint64_t draw_2;         /* draw of the second core */
#endif
};

#if SHOW_CORES == 1
static struct zs_renderer renderer;
#endif
static struct demo_frame frame;
static struct panel panel;
static struct tally tally;
static uint64_t wire; /* ticks that a frame takes in the panel's functions when nothing is drawn meanwhile */

#if SHOW_CORES == 2
#define COLUMNS_2 ",draw 1 us,stack 1"
#else
#define COLUMNS_2
#endif

static void report(int err)
{
    put("# ");
#if SHOW_CORES == 2
    put(err == PAIR_ERR_STOPPED ? "core 1 stopped: core 0 draws alone" : "");
    if (err != PAIR_ERR_STOPPED)
#endif
        put(err > -100 ? zs_error_string(err) : panel_strerror(err));
    put_end();
}

static uint64_t us(uint64_t ticks)
{
    const uint32_t hz = hal_tick_hz();
    return hz ? ticks * US_A_SECOND / hz : 0;
}

/* Of the drawing, the percentage that went on behind the wire: what the wire takes, less what was waited for. */
static uint32_t hidden(void)
{
    const uint64_t all = wire * tally.frames;
    const uint64_t behind = all > tally.busy ? all - tally.busy : 0;
    const uint64_t percent = tally.draw ? behind * 100u / tally.draw : 100u;
    return percent > 100u ? 100u : (uint32_t)percent;
}

static void statistics(uint64_t now)
{
    const uint64_t took = us(now - tally.since);
    const uint64_t tenths = took ? (uint64_t)tally.frames * 10u * US_A_SECOND / took : 0;
    const uint64_t field[] = { tally.frames, tenths / 10u, us(tally.draw) / tally.frames, us(wire), hidden(),
#if SHOW_CORES == 2
                               tally.late, pair_stats()->passes, hal_stack_used(), us(tally.draw_2) / tally.frames,
                               second_stack_used() };
#else
                               tally.late, zs_frame_stats(&renderer)->passes, hal_stack_used() };
#endif
    put(show.demo->name);
    for (uint32_t i = 0; i < sizeof field / sizeof field[0]; i++) {
        put(",");
        put_number(field[i]);
        if (i == 1) { /* frames a second have a tenth */
            put(".");
            put_number(tenths % 10u);
        }
    }
    put_end();
    const struct tally none = { .since = now };
    tally = none;
}

/* ---- A frame ---------------------------------------------------------------------------------------------------- */

#if SHOW_CORES == 2

static uint32_t began;    /* ticks, modulo 2^32: when the strip that is out was */
static uint32_t on_wire;  /* ticks that strips were, modulo 2^32 */
static uint8_t broken;    /* the last frame was dropped */

static void arrived(void *ctx)
{
    (void)ctx;
    pair_arrived();
}

static int send(void *ctx, const struct zs_strip *strip)
{
    const struct panel_rect rect = { (uint16_t)(SHOW_X + strip->x), (uint16_t)(SHOW_Y + strip->y), strip->w, strip->h };
    began = (uint32_t)hal_ticks();
    return panel_send(ctx, &rect, strip->px, 0);
}

static int wait(void *ctx)
{
    on_wire += (uint32_t)hal_ticks() - began;
    return panel_wait(ctx);
}

/* Draw frame t; its last strips may be out, or wait for it, when this returns; alone: none is. What the driver does
 * after a failure takes too long for an interrupt: a command is sent first that changes nothing. */
static int draw_frame(uint32_t t, int alone)
{
    const uint64_t from = hal_ticks(), draw = pair_ticks(0), draw_2 = pair_ticks(1), waited = pair_waited();
    show_phase = SHOW_DRAW;
    show.demo->pose(&frame, t, SHOW_WIDTH, SHOW_HEIGHT);
    show_phase = SHOW_ELSE;
    tally.draw += hal_ticks() - from;
    int err = broken ? panel_invert(&panel, SHOW_INVERT) : 0;
    err = err ? err : pair_frame(&frame.scene, &frame.camera);
    if (alone) {
        err = err ? err : pair_flush();
        wire = on_wire;
    }
    broken = err != 0;
    tally.draw += pair_ticks(0) - draw;
    tally.draw_2 += pair_ticks(1) - draw_2;
    tally.busy += pair_waited() - waited;
    return err;
}

static int wait_for_panel(void)
{
    return pair_flush();
}

static int start_drawing(const struct zs_config *config)
{
    uint32_t *const arena[2] = { show.arena, show.arena_2 };
    const struct zs_sink sink = { .submit = send, .wait = wait, .ctx = &panel };
    const int err = pair_init(config, arena, show.arena_bytes, &sink);
    hal_bus()->hooks.done = arrived;
    if (!err && pair_alone())
        hal_write("# core 1 does not answer: core 0 draws alone\n");
    return err;
}

#else

/* Pixels that are converted leave from scratch: the strip's own memory is free as soon as they are begun. */
static const int converted = SHOW_PIXEL_BITS < 16;

static int wait_for_panel(void)
{
    const uint64_t from = hal_ticks();
    show_phase = SHOW_WAIT;
    const int err = panel_wait(&panel);
    show_phase = SHOW_ELSE;
    tally.busy += hal_ticks() - from;
    return err;
}

static int send(const struct zs_strip *strip)
{
    const struct panel_rect rect = { (uint16_t)(SHOW_X + strip->x), (uint16_t)(SHOW_Y + strip->y), strip->w, strip->h };
    const uint64_t from = hal_ticks();
    show_phase = SHOW_SEND;
    const int err = panel_send(&panel, &rect, strip->px, 0);
    show_phase = SHOW_ELSE;
    tally.busy += hal_ticks() - from;
    return err;
}

#if SHOW_PIECE
static int begin_drawing(void)
{
    static struct zs_pass_memory memory[PIECE_PASSES_MAX];
    const struct piece *piece = (const struct piece *)show.demo; /* its first member */
    return piece_begin(&renderer, piece, &frame.scene, &frame.camera, memory);
}
#else
static int begin_drawing(void)
{
    return zs_frame_begin(&renderer, &frame.scene, &frame.camera);
}
#endif

static int begin(uint32_t t)
{
    const uint64_t from = hal_ticks();
    show_phase = SHOW_DRAW;
    show.demo->pose(&frame, t, SHOW_WIDTH, SHOW_HEIGHT);
    const int err = begin_drawing();
    show_phase = SHOW_ELSE;
    tally.draw += hal_ticks() - from;
    return err;
}

static int next_strip(struct zs_strip *strip)
{
    const uint64_t from = hal_ticks();
    show_phase = SHOW_DRAW;
    const int got = zs_frame_strip(&renderer, strip);
    show_phase = SHOW_ELSE;
    tally.draw += hal_ticks() - from;
    return got;
}

/* Draw frame t and send it; its last strip may be out when this returns. alone: wait for each strip before the next is
 * drawn. */
static int draw_frame(uint32_t t, int alone)
{
    const int each = alone || (SHOW_BUFFERS == 1 && !converted);
    struct zs_strip strip;
    int err = begin(t), got;
    while (!err && (got = next_strip(&strip)) != 0) {
        err = got < 0 ? got : wait_for_panel();
        if (!err)
            err = send(&strip);
        if (!err && each)
            err = wait_for_panel();
    }
    (void)zs_frame_end(&renderer);
    return err;
}

static int start_drawing(const struct zs_config *config)
{
    return zs_init(&renderer, config, show.arena, show.arena_bytes);
}

#endif

/* ---- Frames ----------------------------------------------------------------------------------------------- */

static int set_up(void)
{
    const struct zs_config config = { .width = SHOW_WIDTH, .height = SHOW_HEIGHT, .strip_h = show.rows,
                                      .max_tris = show.tris, .max_verts = show.verts, .varyings = show.varyings,
                                      .buffers = SHOW_BUFFERS, .subpixel_bits = SHOW_SUBPIXEL, .depth_bits = 16,
                                      .depth = SHOW_MAPPING, .fast = show.demo->fast,
#ifdef SHOW_METHOD
                                      .method = &SHOW_METHOD
#elif SHOW_PIECE
                                      .method = ((const struct piece *)show.demo)->method
#endif
    };
    const int err = start_drawing(&config);
    if (err)
        return err;
    return panel_init(&panel, &glass, hal_bus(), show.scratch, show.scratch_bytes);
}

/* The animation's frame for now, after waiting for it where it is still the one shown last. */
static uint32_t by_the_clock(uint64_t start, uint32_t last)
{
    const uint32_t hz = hal_tick_hz();
    if (!hz)
        return last + 1u;
    const uint64_t now = hal_ticks() - start;
    const uint64_t step = now * show.rate / hz;
    if (step > last)
        return (uint32_t)step;
    const uint64_t due = ((uint64_t)last + 1u) * hz / show.rate; /* ticks since the start */
    hal_bus()->delay(hal_bus(), (uint32_t)us(due - now));
    return last + 1u;
}

/* One frame, counted. */
static void show_frame(uint32_t t, int alone)
{
    const uint64_t from = hal_ticks();
    const int err = draw_frame(t, alone);
    if (err)
        report(err);
    tally.frames++;
    tally.late += (hal_ticks() - from) * show.rate > hal_tick_hz();
}

/* The first frame tells what the wire takes by itself; it is not counted. */
static void first_frame(void)
{
    show_frame(0, 1);
    if (SHOW_CORES == 1)
        wire = tally.busy;
    hal_backlight(255);
    const struct tally none = { .since = hal_ticks() };
    tally = none;
}

int main(void)
{
    if (hal_init())
        hal_exit(1);
    int err;
    while ((err = set_up()) != 0) { /* a panel that was plugged in late is found */
        report(err);
        hal_bus()->delay(hal_bus(), US_A_SECOND);
    }
    hal_write("scene,frames,frames/s,draw us,wire us,hidden %,late,passes,stack" COLUMNS_2 "\n");
    first_frame();
    const volatile struct show_test *test = &show_test; /* not what the compiler knows: what flash says */
    const uint32_t frames = test->frames, step = test->step;
    const uint64_t start = tally.since;
    uint32_t t = 0;
    for (uint32_t i = 1; !frames || i < frames; i++) {
        t = frames ? i * step : by_the_clock(start, t);
        show_frame(t, 0);
        if (tally.frames == STATS_EVERY)
            statistics(hal_ticks());
    }
    err = wait_for_panel();
    if (err)
        report(err);
    if (tally.frames)
        statistics(hal_ticks());
    hal_exit(0);
}
