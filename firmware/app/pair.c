/* Two renderers and one frame: see pair.h.
 *
 * Strips have numbers that go on from frame to frame. `next` is the first that nobody draws yet, taken under the lock;
 * `sent` the first that is not out. A strip that is drawn lies in slot[number % SLOTS] and says so in drawn[]. Neither
 * core has more than its buffers drawn and not out, so that slots are never too few.
 *
 * While a frame is drawn the first core's thread writes what describes it, its interrupt `sent` and `out`, either core
 * its own of two and drawn[] of its own strips. `next` has the lock. The error is written by the first core, thread or
 * interrupt; whoever writes what lets the second core go on or end wakes it. Between frames the first core's thread
 * sets all right.
 *
 * A frame begins with steps (zs_share.h), each of which either core ends before the other one begins the next. Where
 * pools do not hold what one walk bins, each core bins for itself, and some frames later the steps are tried again.
 *
 * SPDX-License-Identifier: MIT
 */
#include "pair.h"

#include "hal.h"
#include "second.h"
#include "zs_share.h"
#if SHOW_PIECE
#include "pieces.h"
#include "show.h"
#endif

#define SLOTS 4u    /* two cores, two buffers each */
#define APART 32u /* frames, after one whose parts did not fit into the pools */
#define LOOK_US 10000u /* how often the first core looks whether the other one gets on */

/* What each core is at: for a debugger, and for a test that counts cycles. The numbers are show.c's. */
enum pair_phase { PAIR_ELSE, PAIR_DRAW, PAIR_SEND, PAIR_WAIT };
extern volatile uint8_t pair_phase[2];
volatile uint8_t pair_phase[2];

static struct zs_renderer renderer[2];
static struct zs_sink sink;
static uint32_t strips; /* in a frame */
static uint8_t buffers, alone;

/* The frame. The second core reads these between `posted` and `ended`. */
static const struct zs_scene *the_scene;
static const struct zs_camera *the_camera;
static uint32_t first;
static volatile uint32_t end;           /* first + strips */
static volatile uint32_t posted, ended; /* frames that the second core was given, and is through with */

static struct zs_strip slot[SLOTS];
static volatile uint32_t drawn[SLOTS];
static volatile uint32_t next = 1, sent = 1;
static volatile uint8_t out, arrived; /* strip `sent` is in the sink's hands; its transfer has ended */
static volatile int32_t failed;       /* why no more of the frame is drawn and sent; 0: it is */

/* Binning. steps: how many each core has ended. */
static struct zs_share walk;
static volatile uint32_t steps[2];
static uint32_t cut = 1u << 15;       /* 2^-16 of the triangles: the first core's */
static uint32_t binning[2];           /* ticks of a core in step 0 */
static uint32_t apart;                /* frames in which each core still bins for itself */
static volatile uint8_t sharing;      /* 1: this frame has steps */

static uint32_t held[2][2];           /* of a core, by buffer: the strip that was drawn there last */
static uint32_t taken[2];             /* strips by a core: its buffers take turns */
static int begun[2];                  /* of a core: what zs_frame_begin said */
static uint64_t drawing[2], waited;   /* ticks */
static volatile uint32_t calls;       /* ticks in interrupts, modulo 2^32 */

/* ---- Sending: in an interrupt of the first core ------------------------------------------------------------------ */

static void take_back(void)
{
    const int err = sink.wait(sink.ctx);
    out = 0;
    if (err)
        failed = err;
    else
        sent = sent + 1u;
    second_wake();
}

static void give(void)
{
    second_barrier();
    arrived = 0;
    const int err = sink.submit(sink.ctx, &slot[sent % SLOTS]);
    out = !err;
    if (err) {
        failed = err;
        second_wake();
    }
}

static void send(void)
{
    const uint64_t from = hal_ticks();
    const uint8_t phase = pair_phase[0];
    pair_phase[0] = PAIR_SEND;
    if (out && arrived)
        take_back();
    if (!out && !failed && drawn[sent % SLOTS] == sent)
        give();
    pair_phase[0] = phase;
    calls += (uint32_t)(hal_ticks() - from);
}

void pair_arrived(void)
{
    arrived = 1;
    send();
}

/* ---- Waiting ----------------------------------------------------------------------------------------------------- */

static uint32_t seen;  /* what look_after saw last ... */
static uint64_t since; /* ... and since when, in ticks */

/* The second core gets no further: since its frame was posted, nothing has been taken, sent or ended for too long. */
static void look_after(void)
{
    const uint32_t now = next + sent + ended + posted + steps[0] + steps[1];
    const uint64_t ticks = hal_ticks();
    if (now != seen || ended == posted) {
        seen = now;
        since = ticks;
    } else if ((ticks - since) * 1000000u > (uint64_t)PAIR_PATIENCE_US * hal_tick_hz()) {
        second_stop();
        alone = 1;
        ended = posted;
        if (!failed)
            failed = PAIR_ERR_STOPPED;
    }
}

static void rest(uint32_t core)
{
    if (core) {
        second_sleep(0);
        return;
    }
    const uint64_t from = hal_ticks();
    pair_phase[0] = PAIR_WAIT;
    second_sleep(LOOK_US);
    pair_phase[0] = PAIR_ELSE;
    waited += hal_ticks() - from;
    look_after();
}

/* ---- Drawing: on either core ------------------------------------------------------------------------------------- */

/* Take strip *n for a core, as soon as the buffer is free that its renderer draws into next. 0: none is left. */
static int take(uint32_t core, uint32_t *n)
{
    uint32_t *const last = &held[core][buffers == 1 ? 0 : taken[core] & 1u];
    for (;;) {
        int got = 0;
        second_lock();
        *n = next;
        const int left = *n != end && !failed;
        if (left && (int32_t)(sent - *last) > 0) {
            *last = *n;
            next = *n + 1u;
            taken[core]++;
            got = 1;
        }
        second_unlock();
        if (got)
            second_wake(); /* it may have been the last: the other one need not wait */
        if (got || !left)
            return got;
        rest(core);
    }
}

static void draws(uint32_t core, uint64_t *from, uint32_t *before)
{
    pair_phase[core] = PAIR_DRAW;
    *from = hal_ticks();
    *before = calls;
}

static void has_drawn(uint32_t core, uint64_t from, uint32_t before)
{
    pair_phase[core] = PAIR_ELSE;
    drawing[core] += hal_ticks() - from - (core ? 0 : calls - before);
}

#if SHOW_PIECE
static int begin(struct zs_renderer *r, uint32_t core)
{
    static struct zs_pass_memory memory[2][PIECE_PASSES_MAX];
    const struct piece *piece = (const struct piece *)show.demo; /* its first member */
    return piece_begin(r, piece, the_scene, the_camera, memory[core]);
}
#else
static int begin(struct zs_renderer *r, uint32_t core)
{
    (void)core;
    return zs_frame_begin(r, the_scene, the_camera);
}
#endif

/* Bin the frame together. */
static void bin(uint32_t core)
{
    uint64_t from;
    uint32_t before;
    for (uint32_t step = 0; step < ZS_SHARE_STEPS; step++) {
        const uint64_t spent = drawing[core];
        draws(core, &from, &before);
        (void)zs_share_step(&walk, core, step);
        has_drawn(core, from, before);
        if (!step)
            binning[core] = (uint32_t)(drawing[core] - spent);
        second_barrier();
        const uint32_t now = steps[core] + 1u;
        steps[core] = now;
        second_wake();
        while ((int32_t)(steps[!core] - now) < 0 && !alone)
            rest(core);
        second_barrier();
    }
}

/* Give the core that took longer fewer of the next frame's triangles. */
static void balance(void)
{
    const uint64_t a = binning[0], b = binning[1];
    if (a > b)
        cut -= (uint32_t)(cut * (a - b) / (2u * a));
    else if (b)
        cut += (uint32_t)((65536u - cut) * (b - a) / (2u * b));
}

static void share(uint32_t core)
{
    struct zs_renderer *r = &renderer[core];
    uint64_t from;
    uint32_t at = first, before, n;
    draws(core, &from, &before);
    begun[core] = begin(r, core);
    has_drawn(core, from, before);
    if (!begun[core] && sharing)
        bin(core);
    while (!begun[core] && take(core, &n)) {
        draws(core, &from, &before);
        for (; at != n; at++)
            (void)zs_frame_skip(r);
        (void)zs_frame_strip(r, &slot[n % SLOTS]); /* there is one, and a frame is open */
        at++;
        has_drawn(core, from, before);
        second_barrier();
        drawn[n % SLOTS] = n;
        second_call();
    }
    (void)zs_frame_end(r);
}

static void second(void)
{
    for (;;) {
        while (ended == posted)
            second_sleep(0);
        second_barrier();
        share(1);
        second_barrier();
        ended = posted;
        second_wake();
    }
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

int pair_init(const struct zs_config *config, uint32_t *const arena[2], uint32_t bytes, const struct zs_sink *to)
{
    for (uint32_t i = 0; i < 2; i++) {
        const int err = zs_init(&renderer[i], config, arena[i], bytes);
        if (err)
            return err;
        taken[i] = 0;
    }
    sink = *to;
    strips = ZS_STRIPS(config->height, config->strip_h);
    buffers = config->buffers == 2 ? 2 : 1;
    steps[0] = steps[1] = 0; /* a core that stopped in a frame was behind */
    end = first = next = sent;
    since = hal_ticks();
    alone = second_start(second, send) != HAL_ERR_NONE;
    return ZS_OK;
}

/* After an error, when the second core has ended: nothing is out, every buffer is free. */
static int settle(void)
{
    const int err = failed;
    while (out)
        second_sleep(LOOK_US);
    next = sent = end;
    failed = 0;
    return err;
}

int pair_frame(const struct zs_scene *scene, const struct zs_camera *camera)
{
    the_scene = scene;
    the_camera = camera;
    first = end;
    apart -= apart != 0;
    sharing = !alone && !apart;
    zs_share_set(&walk, &renderer[0], &renderer[1], cut);
    second_barrier();
    end = first + strips;
    if (!alone)
        posted = posted + 1u;
    second_wake();
    share(0);
    while (ended != posted)
        rest(0);
    second_barrier();
    if (sharing && !begun[0]) {
        apart = walk.joined ? 0 : APART;
        balance();
    }
    if (begun[0]) { /* both refuse it; what was drawn before it leaves */
        end = first;
        const int err = pair_flush();
        return err ? err : begun[0];
    }
    return failed ? settle() : ZS_OK;
}

int pair_flush(void)
{
    while (sent != end && !failed)
        rest(0);
    return failed ? settle() : ZS_OK;
}

int pair_alone(void)
{
    return alone;
}

uint64_t pair_ticks(uint32_t core)
{
    return drawing[core];
}

uint64_t pair_waited(void)
{
    return waited;
}

const struct zs_stats *pair_stats(void)
{
    return zs_frame_stats(&renderer[0]);
}
