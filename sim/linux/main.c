/* zstrip-linux: a scene or model on a panel, strip by strip. While a thread of the HAL sends one strip, the next is
 * drawn into the other buffer.
 *
 * Signals set a flag, which is looked at before each strip and each frame, and after each wait: what is on the wire is
 * sent to its end (a message cannot be broken off), then the panel goes to sleep.
 *
 * SPDX-License-Identifier: MIT
 */
#define _POSIX_C_SOURCE 200809L
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal.h"
#include "linux.h"
#include "linux_options.h"
#include "panel.h"
#include "sim.h"
#include "source.h"
#include "zs_damage.h"
#include "zstrip.h"

#define RATE 30u          /* frames of the animation a second */
#define STATS_EVERY 32u
#define COLUMNS 8u        /* that --partial tells apart */
#define FAILURES_MAX 3u   /* frames in a row that the panel did not take */
#define TE_MS 1000u       /* without an edge: longer than any panel takes for a picture */
#define STOPPED (-199)    /* by a signal; no code of zstrip.h, hal.h or panel.h */

static volatile sig_atomic_t stop;

/* Sums of --stats, in us but for the counts. */
struct tally {
    uint64_t since, draw;
    uint64_t busy;              /* in the panel's functions */
    uint64_t hidden;            /* of draw, while the strip before was on the wire */
    struct linux_sent sent;     /* at its beginning */
    uint32_t frames;
};

static struct linux_options options;
static struct source source;
static struct zs_renderer renderer;
static struct panel panel;
static struct panel_config glass;
static struct tally tally;
static void *arena, *scratch;
static uint64_t *sums; /* of --partial */
static struct zs_strip_hashes panel_sums;
static uint64_t given; /* when panel_send returned that began the strip that is out */
static int use_te, is_lit;

static void on_signal(int number)
{
    (void)number;
    stop = 1;
}

/* Calls that a signal interrupts return. A SIGHUP that is ignored stays so: nohup. A reader of --stats that goes away
 * must not leave the panel lit. */
static void catch_signals(void)
{
    struct sigaction action = { .sa_handler = on_signal }, before;
    (void)sigemptyset(&action.sa_mask);
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        (void)sigaction(SIGHUP, &action, NULL);
    action.sa_handler = SIG_IGN;
    (void)sigaction(SIGPIPE, &action, NULL);
}

/* ---- Sending ----------------------------------------------------------------------------------------------- */

/* The changed columns of a strip, widened to whole bytes and pages of the controller. */
static struct panel_rect changed(const struct zs_strip *s)
{
    const uint32_t grain = panel_grain(&glass).x;
    const uint32_t x = s->dirty_x / grain * grain;
    const uint32_t end = (s->dirty_x + s->dirty_w + grain - 1u) / grain * grain;
    return (struct panel_rect){ (uint16_t)x, s->y, (uint16_t)(end - x), s->h };
}

static int submit(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    if (stop)
        return STOPPED;
    const uint64_t from = hal_ticks();
    const struct panel_rect rect = changed(s);
    const int err = panel_send(&panel, &rect, s->px + rect.x * 2u, s->w * 2u);
    given = hal_ticks();
    tally.busy += given - from;
    return err;
}

static int wait(void *ctx)
{
    (void)ctx;
    const uint64_t from = hal_ticks();
    const int err = panel_wait(&panel);
    const struct linux_sent sent = linux_sent();
    const uint64_t first = given > sent.last_from ? given : sent.last_from; /* drawn from given to from */
    const uint64_t last = from < sent.last_to ? from : sent.last_to;
    tally.hidden += last > first ? last - first : 0;
    tally.busy += hal_ticks() - from;
    return err;
}

/* ---- Saying --------------------------------------------------------------------------------------------------- */

static const char *words(int err)
{
    if (err == HAL_ERR_BUS || err == HAL_ERR_TIMEOUT)
        return linux_why();
    return err > -100 ? zs_error_string(err) : panel_strerror(err);
}

/* Averages of a frame. hidden: of the drawing, the percentage that went on while the strip before was on the wire. */
static void say_stats(void)
{
    const struct linux_sent now = linux_sent();
    const uint64_t n = tally.frames, took = hal_ticks() - tally.since, wire = now.us - tally.sent.us;
    const uint64_t percent = tally.draw ? tally.hidden * 100u / tally.draw : 100u;
    if (!n)
        return;
    (void)printf("%s,%lu,%.1f,%lu,%lu,%lu,%u,%lu,%lu\n", source.name, (unsigned long)n,
                 took ? 1e6 * (double)n / (double)took : 0.0, (unsigned long)(tally.draw / n),
                 (unsigned long)(wire / n), (unsigned long)percent,
                 (unsigned)zs_frame_stats(&renderer)->passes, (unsigned long)((now.bytes - tally.sent.bytes) / n),
                 (unsigned long)((now.messages - tally.sent.messages) / n));
    (void)fflush(stdout);
}

static void begin_tally(void)
{
    tally = (struct tally){ .since = hal_ticks(), .sent = linux_sent() };
}

/* ---- Frames ---------------------------------------------------------------------------------------------------- */

/* The animation's frame for now, after waiting for it where it is still the one shown last. */
static uint32_t by_the_clock(uint64_t start, uint32_t last)
{
    const uint64_t step = (hal_ticks() - start) * RATE / hal_tick_hz();
    if (step > last)
        return (uint32_t)step;
    const uint64_t due = start + ((uint64_t)last + 1u) * hal_tick_hz() / RATE, now = hal_ticks();
    if (due > now)
        hal_bus()->delay(hal_bus(), (uint32_t)(due - now));
    return last + 1u;
}

/* Until the edge that a frame begins with; SIM_OK, also where it does not come. A signal just before the wait is seen
 * after it. */
static int wait_for_edge(void)
{
    const int came = use_te ? linux_wait_edge(TE_MS) : 1;
    if (came < 0)
        return sim_refuse(NULL, 0, "%s", linux_why());
    if (came || stop)
        return SIM_OK;
    (void)sim_refuse(NULL, 0, "--te %s: no edge came for %u ms; frames are drawn without it from now on, check the "
                     "wire and that the panel drives it", options.te, TE_MS);
    use_te = 0;
    return SIM_OK;
}

/* Frames that the panel did not take. */
struct lost {
    uint32_t in_a_row, all;
};

/* One frame, counted. SIM_OK, also where it was broken off or not taken. */
static int show_frame(uint32_t t, struct lost *lost)
{
    const struct zs_sink sink = { .submit = submit, .wait = wait };
    if (wait_for_edge() != SIM_OK)
        return SIM_REFUSED;
    const uint64_t from = hal_ticks(), busy = tally.busy;
    source_pose(&source, t);
    const int err = zs_render(&renderer, source.scene, source.camera, &sink);
    tally.draw += hal_ticks() - from - (tally.busy - busy);
    tally.frames++;
    if (err == ZS_OK || err == STOPPED) {
        if (!is_lit && !stop)
            hal_backlight(255); /* not before there is something to see */
        is_lit = 1;
        lost->in_a_row = 0;
        return SIM_OK;
    }
    (void)zs_invalidate(&renderer, NULL); /* what broke the transfer may have reset the panel */
    (void)sim_refuse(NULL, 0, "frame %u: %s", (unsigned)t, words(err));
    lost->all++;
    return err > -100 || ++lost->in_a_row == FAILURES_MAX ? SIM_REFUSED : SIM_OK;
}

static int show(void)
{
    const uint64_t start = hal_ticks();
    struct lost lost = { 0, 0 };
    uint32_t t = 0;
    int status = SIM_OK;
    if (options.stats)
        (void)puts("scene,frames,frames/s,draw us,wire us,hidden %,passes,bytes,messages");
    begin_tally();
    for (uint32_t i = 0; status == SIM_OK && !stop && (!options.frames || i < (uint32_t)options.frames); i++) {
        if (i > 0)
            t = options.frames ? i * (uint32_t)options.step : by_the_clock(start, t);
        if (!stop)
            status = show_frame(t, &lost);
        if (options.stats && tally.frames == STATS_EVERY) {
            say_stats();
            begin_tally();
        }
    }
    if (options.stats)
        say_stats();
    return options.frames && lost.all ? SIM_REFUSED : status; /* each of --frames was asked for */
}

/* ---- From dark to dark ----------------------------------------------------------------------------------- */

static int set_up_renderer(void)
{
    const long height = options.size[1];
    const uint32_t rows = (uint32_t)(options.strip < height ? options.strip : height);
    const struct zs_config config = {
        .width = (uint16_t)options.size[0], .height = (uint16_t)height, .strip_h = (uint16_t)rows,
        .max_tris = ZS_POOL_MAX, .max_verts = ZS_POOL_MAX, .varyings = source.attrs, .buffers = 2,
        .subpixel_bits = (uint8_t)options.subpixel, .depth_bits = 16, .depth = source.depth, .fast = source.fast
    };
    const uint32_t bytes = zs_arena_bytes(&config);
    arena = sim_alloc(bytes, 1);
    int err = zs_init(&renderer, &config, arena, bytes);
    if (err == ZS_OK && options.partial) {
        sums = sim_alloc(ZS_STRIPS(height, rows) * COLUMNS, sizeof *sums);
        err = zs_strip_hashes_init(&panel_sums, sums, config.width, config.height, rows, COLUMNS);
        err = err ? err : zs_damage_compare(&renderer, &panel_sums);
    }
    return err == ZS_OK ? SIM_OK : sim_refuse(NULL, 0, "the renderer cannot be set up: %s", zs_error_string(err));
}

static int set_up_panel(void)
{
    const uint32_t n = 2u * (uint32_t)(options.size[0] * options.strip); /* also without pixels to convert: to clear */
    scratch = sim_alloc(n, 1);
    const int err = panel_init(&panel, &glass, hal_bus(), scratch, n);
    return err == HAL_ERR_NONE ? SIM_OK : sim_refuse(NULL, 0, "the panel cannot be set up: %s", words(err));
}

/* Why the machine could not be used; where a line was not found, those that there are. */
static int refuse_wiring(int err)
{
    (void)sim_refuse(NULL, 0, "%s", linux_why());
    if (err == HAL_ERR_ARG)
        linux_list_lines(stderr);
    return SIM_REFUSED;
}

static int run(void)
{
    catch_signals();
    const int err = hal_init();
    if (err)
        return refuse_wiring(err);
    int status = stop ? SIM_OK : set_up_panel();
    if (status == SIM_OK && !stop)
        status = show();
    hal_backlight(0);
    const int dark = panel_sleep(&panel);
    if (dark != HAL_ERR_NONE && dark != PANEL_ERR_STATE) /* it was set up */
        status = sim_refuse(NULL, 0, "the panel cannot be put to sleep: %s", words(dark));
    linux_close();
    return status;
}

static int dry_run(void)
{
    static const double px_bytes[] = { [PANEL_RGB565] = 2.0, [PANEL_GREY4] = 0.5, [PANEL_MONO] = 0.125 };
    const double bytes = (double)(options.size[0] * options.size[1]) * px_bytes[panel_format(glass.type)];
    const double us = 8e6 * bytes / (double)options.speed;
    (void)printf("%-10s %s, picture %ldx%ld of %s\n", "panel", options.panel.name, options.size[0], options.size[1],
                 source.name);
    const int err = linux_describe(stdout);
    (void)printf("%-10s %.0f bytes of pixels a frame, %.0f us on the wire: at most %.1f frames/s\n", "frame", bytes, us,
                 1e6 / us);
    (void)fflush(stdout);
    return err ? refuse_wiring(err) : SIM_OK;
}

static int prepare(struct linux_wiring *wiring)
{
    struct pm_glass model;
    int status = sim_panel_config(&options.panel, NULL, &glass, &model);
    if (status == SIM_OK)
        status = source_open(&source, &options);
    *wiring = (struct linux_wiring){ options.spi, (uint32_t)options.speed, (uint8_t)options.mode, options.dc,
                                     options.reset, options.backlight, options.te };
    linux_wire(wiring);
    use_te = options.te != NULL;
    glass.te = (uint8_t)use_te;
    return status;
}

int main(int argc, char **argv)
{
    static struct linux_wiring wiring;
    sim_program = "zstrip-linux";
    int status = linux_options_parse(&options, argc, argv);
    if (status == SIM_OK && options.help) {
        linux_options_help();
        return SIM_OK;
    }
    if (status == SIM_OK)
        status = prepare(&wiring);
    if (status == SIM_OK && options.dry_run)
        status = dry_run();
    else if (status == SIM_OK && (status = set_up_renderer()) == SIM_OK)
        status = run();
    source_close();
    free(arena);
    free(scratch);
    free(sums);
    if (fflush(stdout) != 0 && status == SIM_OK)
        status = SIM_REFUSED;
    return status;
}
