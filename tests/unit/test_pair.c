/* Two cores that share a frame (firmware/app/pair.c) on a machine that is made up, in every order that seeds come upon.
 *
 * pair.c is compiled for a race detector (-fsanitize=thread), which puts a call before each of its accesses to memory.
 * The detector is not linked: those calls are here, and each is a place where another one may go on: the first core's
 * thread, its interrupt, which the thread then waits for, or the second core. Which one does is drawn from the seed,
 * and so are strips in a frame, buffers, how long drawing and sending take, pauses, and what fails.
 *
 * Modelled   second.h as it promises, and no more: a wake is the other core's alone; several calls become one; a sleep
 *            may end for no reason. An interrupt before the first core's sleep ends that, too. A renderer whose buffers
 *            take turns by what it has drawn. A sink that fails; frames that are refused; a second core
 *            that does not start, or stops for ever anywhere but with the lock.
 * Looked at  Strips leave once, in their order, whole, none missing; nothing is drawn over a strip that is not out; an
 *            error comes back once, and nothing is out then; no core sleeps that could draw, nor leaves a frame that is
 *            not drawn, nor goes on by the clock alone; the second core is stopped where it stands still, and only
 *            then.
 * Not        Cores that see each other's writes in another order, so no missing barrier is found; what a compiler makes
 *            of pair.c elsewhere; strips' numbers beyond 2^32; hal/rp2040/second. The Pico's images run on an emulated
 *            RP2040 (tests/boards/pico).
 *
 * SPDX-License-Identifier: MIT
 */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <ucontext.h>
#include <unistd.h>

#include <cmocka.h>

#include "cases.h"
#include "hal.h"
#include "pair.h"
#include "prng.h"
#include "second.h"
#include "zs_share.h"

#define FRAMES 30u
#define STRIPS_MAX 9u
#define STEPS 1000000u    /* of the scheduler */
#define PAUSE_US 3000000u /* longer than pair.c's patience */
#define STACK 65536u
#define ERR_SUBMIT (-201)
#define ERR_WAIT (-202)

/* What may happen; submit, wait, refused: one in so many, 0: none. */
struct mode {
    const char *name;
    uint32_t seeds, submit, wait, refused;
    int pauses, no_start, dies;
};
static const struct mode modes[] = {
    { "pair_frames", 500 },
    { "pair_submit_fails", 500, .submit = 10 },
    { "pair_wait_fails", 500, .wait = 10 },
    { "pair_frames_refused", 500, .refused = 4 },
    { "pair_all_fail", 500, .submit = 20, .wait = 20, .refused = 4 },
    { "pair_pauses", 500, .pauses = 1 },
    { "pair_pauses_and_all_fail", 500, .submit = 20, .wait = 20, .refused = 4, .pauses = 1 },
    { "pair_second_does_not_start", 200, .submit = 20, .wait = 20, .refused = 4, .no_start = 1 },
    { "pair_second_dies", 500, .dies = 1 },
    { "pair_second_dies_and_all_fail", 500, .submit = 20, .wait = 20, .refused = 4, .pauses = 1, .dies = 1 },
};
#define N_MODES (sizeof modes / sizeof modes[0])

/* What a mode's seeds have come to, the last of them, and why it failed: written by the processes that play them. */
struct seen {
    uint32_t frames, refused, submit, wait, stopped, anew, alone, sent, shared, seed;
    char why[120];
};
static struct seen *seen;
static const struct mode *mode;
static struct prng chance; /* the seed's */

__attribute__((noreturn)) static void wrong(const char *why)
{
    (void)snprintf(seen->why, sizeof seen->why, "%s", why);
    _exit(1);
}

static int one_in(uint32_t n)
{
    return n && prng_pick(&chance, n) == 0;
}

/* ---- Who runs ---------------------------------------------------------------------------------------------------- */

enum who { THREAD, SECOND, INTERRUPT, NOBODY }; /* the first two are cores' numbers */

static jmp_buf place[4]; /* of NOBODY: the scheduler. Many times as quick as swapcontext, which calls the kernel */
static ucontext_t start[3];
static char stack[3][STACK];
static int started[3];
static enum who running = NOBODY, lock = NOBODY;
static uint32_t switching, favour, idly; /* one in so many places; the second core's per cent; one sleep in so many */
static uint32_t steps, dies_at;
static uint32_t held_up, held_until;     /* a core that does not get on; the step */
static uint64_t now, until;              /* us; when the first core's sleep ends, 0: never */
static int asleep[2], woken[2];
static int serving, ended, called;       /* the interrupt: it has begun; why it is due */
static int over;                         /* the program */
static int is_on, dead, stops;           /* the second core */
static void (*on_call)(void);
static struct {
    const void *px; /* NULL: nothing is out */
    uint32_t strip, lands_at;
    int slow, landed; /* slow: the second core's time may run out meanwhile */
} flight;

static void leave(void)
{
    if (!_setjmp(place[running]))
        _longjmp(place[NOBODY], 1);
}

static void may_leave(void)
{
    if (running != NOBODY && one_in(switching))
        leave();
}

static uint32_t core(void)
{
    return running == SECOND;
}

static void begin(enum who who, void (*run)(void))
{
    (void)getcontext(&start[who]);
    start[who].uc_stack.ss_sp = stack[who];
    start[who].uc_stack.ss_size = STACK;
    makecontext(&start[who], run, 0);
}

/* Until it leaves. */
static void go_on(void)
{
    if (_setjmp(place[NOBODY]))
        return;
    if (started[running])
        _longjmp(place[running], 1);
    started[running] = 1;
    (void)setcontext(&start[running]);
}

static void interrupts(void)
{
    for (;;) {
        if (ended && (!called || one_in(2))) {
            ended = 0;
            pair_arrived();
        } else {
            called = 0;
            on_call();
        }
        serving = 0;
        woken[THREAD] = 1;
        leave();
    }
}

/* What happens beside the two cores. */
static void world(void)
{
    if (mode->dies && steps >= dies_at && lock != SECOND)
        dead = 1;
    if (flight.px && !flight.landed && steps >= flight.lands_at)
        ended = flight.landed = 1;
    for (int i = 0; i < 2; i++)
        if (asleep[i] && woken[i])
            asleep[i] = woken[i] = 0;
    if (asleep[THREAD] && until && now >= until)
        asleep[THREAD] = 0;
    if (steps >= held_until && one_in(500)) { /* one core gets on alone for a while */
        held_up = prng_pick(&chance, 2);
        held_until = steps + prng_pick(&chance, 1000);
    }
}

static enum who choose(void)
{
    const int due = serving || ended || called;
    const int first = due || !asleep[THREAD], other = is_on && !dead && !asleep[SECOND];
    if (!first && !other)
        return NOBODY;
    if (other && (!first || (steps < held_until ? held_up == THREAD : prng_pick(&chance, 100) < favour)))
        return SECOND;
    if (serving || (due && (asleep[THREAD] || one_in(4)))) {
        serving = 1;
        return INTERRUPT;
    }
    return THREAD;
}

static int could_draw(uint32_t c);

static void nobody_runs(void)
{
    const int clock = is_on && dead && until; /* is what helps then */
    for (uint32_t c = 0; c < 2; c++)
        if (could_draw(c) && !(c == SECOND && dead))
            wrong("a core sleeps that could draw");
    if (flight.px && !flight.landed && !(flight.slow && clock))
        return;
    if (!clock)
        wrong(until ? "a wake is lost: only the clock goes on" : "both cores sleep for ever");
    now = until;
}

static void schedule(void)
{
    while (!over) {
        if (++steps > STEPS)
            wrong("it has no end");
        world();
        running = choose();
        if (running != NOBODY)
            go_on();
        else
            nobody_runs();
        running = NOBODY;
    }
}

/* What the compiler puts into pair.c. */
#define ACCESS(name) \
    void __tsan_##name(void *at) \
    { \
        (void)at; \
        may_leave(); \
    }
#define RANGE(name) \
    void __tsan_##name(void *at, long n) \
    { \
        (void)at, (void)n; \
        may_leave(); \
    }
ACCESS(read1) ACCESS(read2) ACCESS(read4) ACCESS(read8) ACCESS(read16)
ACCESS(write1) ACCESS(write2) ACCESS(write4) ACCESS(write8) ACCESS(write16)
RANGE(read_range) RANGE(write_range)

void __tsan_init(void)
{
}

void __tsan_func_entry(void *from)
{
    (void)from;
}

void __tsan_func_exit(void)
{
}

/* ---- hal.h and second.h ------------------------------------------------------------------------------------------ */

uint64_t hal_ticks(void)
{
    may_leave();
    return now;
}

uint32_t hal_tick_hz(void)
{
    return 1000000;
}

int second_start(void (*run)(void), void (*call)(void))
{
    on_call = call;
    if (mode->no_start)
        return HAL_ERR_TIMEOUT;
    begin(SECOND, run);
    is_on = 1;
    called = one_in(2); /* nobody asked for it */
    return HAL_ERR_NONE;
}

void second_stop(void)
{
    if (!dead || !is_on)
        wrong("the second core is stopped, and runs");
    is_on = 0;
    stops++;
}

void second_call(void)
{
    if (running == INTERRUPT)
        wrong("a call from an interrupt");
    may_leave();
    called = 1;
    may_leave();
}

void second_wake(void)
{
    may_leave();
    woken[!core()] = 1;
    may_leave();
}

void second_sleep(uint32_t most_us)
{
    const uint32_t c = core();
    if (running == INTERRUPT || lock == running)
        wrong("a sleep in an interrupt, or with the lock");
    may_leave();
    if (one_in(idly))
        return;
    if (c == THREAD)
        until = most_us ? now + most_us : 0;
    asleep[c] = !woken[c];
    woken[c] = 0;
    if (asleep[c])
        leave();
}

void second_barrier(void)
{
    may_leave();
}

void second_lock(void)
{
    if (running == INTERRUPT || lock == running)
        wrong("the lock in an interrupt, or twice");
    may_leave();
    while (lock != NOBODY)
        leave();
    lock = running;
    may_leave();
}

void second_unlock(void)
{
    may_leave();
    lock = NOBODY; /* whoever has it: a second_lock that is missing shall be found by what comes of it */
    may_leave();
}

/* ---- The renderers ----------------------------------------------------------------------------------------------- */

struct buffer {
    uint32_t strip;
    int busy, whole; /* drawn into, and not out; drawn to its end */
};
static struct renderer {
    const struct zs_renderer *is;
    int open;
    uint32_t steps;   /* that have ended, of all frames */
    uint32_t at, drawn; /* strips given out or left out; drawn */
    struct buffer buffer[2];
} renderers[2];
static uint32_t n_renderers, strips, buffers, slowness; /* of the second core */
static int made;         /* by the sink: the error that has not come back yet */
static int told_stopped; /* PAIR_ERR_STOPPED has come back */
static struct zs_scene scenes[2];
static struct zs_camera cameras[2];
static uint32_t frame;              /* that was not refused. Strip i of it has number frame * strips + i */
static uint32_t begun;              /* whichever */
static int refusing;
static uint32_t drawn_in[STRIPS_MAX]; /* by strip: the frame that it was drawn in last */

static struct renderer *of(const struct zs_renderer *r)
{
    if (renderers[core()].is != r || running == INTERRUPT)
        wrong("a renderer on the other core");
    return &renderers[core()];
}

static struct buffer *buffer_of(struct renderer *r)
{
    return &r->buffer[buffers == 1 ? 0 : r->drawn % 2];
}

/* Strips of the frame that nobody has begun to draw; none, where an error ends it. */
static uint32_t left(void)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < strips; i++)
        n += drawn_in[i] != frame;
    return made || stops > told_stopped ? 0 : n;
}

/* Not where it waits for the other one to end a step: one that is dead may have done it, and not have said so. */
static int could_draw(uint32_t c)
{
    const int waits = !stops && (dead ? !renderers[c].at : renderers[c].steps > renderers[!c].steps);
    return !waits && renderers[c].open && !buffer_of(&renderers[c])->busy && left();
}

static void work(void)
{
    for (uint32_t n = prng_pick(&chance, core() ? slowness : 6); n; n--) {
        now++;
        may_leave();
    }
}

int zs_init_build(struct zs_renderer *r, const struct zs_config *config, void *arena, size_t bytes, uint32_t build)
{
    (void)config, (void)arena, (void)bytes, (void)build;
    renderers[n_renderers++].is = r;
    return ZS_OK;
}

int zs_frame_begin(struct zs_renderer *r, const struct zs_scene *scene, const struct zs_camera *camera)
{
    struct renderer *const my = of(r);
    if (scene != &scenes[begun % 2] || camera != &cameras[begun % 2])
        wrong("another frame's scene");
    work();
    my->at = 0;
    my->open = !refusing;
    return refusing ? ZS_ERR_RANGE : ZS_OK;
}

void zs_share_set(struct zs_share *share, struct zs_renderer *one, struct zs_renderer *two, uint32_t part)
{
    if (running != THREAD || one != renderers[0].is || two != renderers[1].is || part > 65536)
        wrong("another pair is shared");
    if (renderers[0].steps != renderers[1].steps && !stops)
        wrong("a frame is shared before the last one's steps have ended");
    (void)share;
}

/* Each step sees all that both have done before. */
int zs_share_step(struct zs_share *share, uint32_t c, uint32_t step)
{
    struct renderer *const my = &renderers[c], *const other = &renderers[!c];
    if (c != core() || running == INTERRUPT || !my->open || my->at)
        wrong("a step of another core, or out of a frame");
    if (my->steps % ZS_SHARE_STEPS != step || (other->steps < my->steps && !stops))
        wrong("a step too early");
    work();
    if (other->steps > my->steps + 1)
        wrong("the other core did not wait for this step");
    my->steps++;
    if (step == ZS_SHARE_STEPS - 1)
        share->joined = (int32_t)(begun % 5 != 0);
    seen->shared++;
    return 0;
}

int zs_frame_skip(struct zs_renderer *r)
{
    struct renderer *const my = of(r);
    if (!my->open || my->at >= strips)
        wrong("no strip to leave out");
    my->at++;
    return 1;
}

int zs_frame_strip(struct zs_renderer *r, struct zs_strip *out)
{
    struct renderer *const my = of(r);
    struct buffer *const b = buffer_of(my);
    if (!my->open || my->at >= strips)
        wrong("no strip to draw");
    if (b->busy)
        wrong("a strip is drawn over one that is not out");
    if (my->steps % ZS_SHARE_STEPS || renderers[!core()].steps < my->steps)
        if (!stops)
            wrong("a strip is drawn before both have taken all steps");
    if (drawn_in[my->at] == frame)
        wrong("a strip is drawn twice");
    drawn_in[my->at] = frame;
    *b = (struct buffer) { frame * strips + my->at, 1, 0 };
    work();
    out->y = (uint16_t)my->at;
    may_leave();
    out->px = (const uint8_t *)b;
    may_leave();
    b->whole = 1;
    my->at++;
    my->drawn++;
    return 1;
}

int zs_frame_end(struct zs_renderer *r)
{
    if (of(r)->open && left() > 1) /* one may be the other core's, which has not begun it yet */
        wrong("a core leaves a frame that is not drawn");
    of(r)->open = 0;
    return ZS_OK;
}

const struct zs_stats *zs_frame_stats(const struct zs_renderer *r)
{
    (void)r;
    return NULL;
}

/* ---- The sink ---------------------------------------------------------------------------------------------------- */

static uint32_t expected; /* strip */

static int submit(void *ctx, const struct zs_strip *s)
{
    const struct buffer *const b = (const struct buffer *)(const void *)s->px;
    if (running != INTERRUPT || flight.px)
        wrong("submit outside of the interrupt, or with a strip out");
    if (made)
        wrong("submit after an error");
    work();
    if (!b || !b->busy || !b->whole || s->y != b->strip % strips)
        wrong("a strip is sent that is not drawn");
    if (b->strip != expected)
        wrong("a strip out of its order");
    if (one_in(mode->submit)) {
        seen->submit++;
        return made = ERR_SUBMIT;
    }
    flight.px = s->px;
    flight.strip = b->strip;
    flight.landed = 0;
    flight.slow = mode->dies && one_in(50);
    flight.lands_at = steps + prng_pick(&chance, flight.slow ? 20000 : 300);
    return 0;
}

static int wait_for(void *ctx)
{
    struct buffer *const b = (struct buffer *)(uintptr_t)flight.px;
    if (running != INTERRUPT || !flight.px || !flight.landed)
        wrong("wait outside of the interrupt, or too early");
    if (b->strip != flight.strip || !b->busy || !b->whole)
        wrong("a strip is drawn over while it is sent");
    flight.px = NULL;
    if (one_in(mode->wait)) {
        seen->wait++;
        return made = ERR_WAIT;
    }
    b->busy = 0;
    expected++;
    seen->sent++;
    return 0;
}

/* ---- The first core's program ------------------------------------------------------------------------------------ */

static void error_is_back(int err)
{
    if (err == PAIR_ERR_STOPPED) {
        if (told_stopped++ || !stops)
            wrong("stopped twice, or not at all");
        seen->stopped++;
    } else if (err != made) {
        wrong(made ? "another error comes back" : "an error comes back that nobody made");
    }
    if (flight.px)
        wrong("an error comes back, and a strip is out");
    for (int i = 0; i < 4; i++)
        renderers[i / 2].buffer[i % 2].busy = 0;
    expected = (frame + 1) * strips;
    made = 0;
}

static void all_is_out(void)
{
    if (made)
        wrong("an error does not come back");
    if (flight.px || expected != (frame + 1) * strips)
        wrong("not all strips are out");
}

static void flush(void)
{
    const int err = pair_flush();
    if (err)
        error_is_back(err);
    else
        all_is_out();
}

static void one_frame(void)
{
    const int was_dead = dead;
    refusing = one_in(mode->refused);
    begun++;
    frame += !refusing;
    const int err = pair_frame(&scenes[begun % 2], &cameras[begun % 2]);
    if (err == ZS_ERR_RANGE && refusing) {
        all_is_out();
        seen->refused++;
    } else if (err) {
        error_is_back(err);
    } else if (refusing) {
        wrong("a frame that is refused comes back well");
    } else {
        seen->frames++;
    }
    if (was_dead && is_on)
        wrong("the second core has stopped, and nobody saw it");
    if (pair_alone() != !is_on)
        wrong("pair_alone");
}

static void pause_a_while(void)
{
    if (one_in(2))
        flush();
    if (one_in(2))
        for (uint32_t n = 3000; n || flight.px || ended || called || serving; n -= n > 0)
            leave();
    now += PAUSE_US;
}

/* Where the second core has stopped: pair_init once more, and both draw again, as if nothing had been. */
static void draw_anew(const struct zs_config *config, uint32_t *const arena[2], const struct zs_sink *sink)
{
    memset(renderers, 0, sizeof renderers);
    n_renderers = 0;
    dead = stops = told_stopped = 0;
    dies_at = UINT32_MAX;
    started[SECOND] = asleep[SECOND] = woken[SECOND] = 0;
    if (pair_init(config, arena, 16, sink) != ZS_OK || pair_alone())
        wrong("pair_init once more");
    for (uint32_t i = 0; i < FRAMES; i++)
        one_frame();
    flush();
    if (pair_alone())
        wrong("alone after pair_init");
    seen->anew++;
}

static void program(void)
{
    static uint32_t words[2][4];
    uint32_t *const arena[2] = { words[0], words[1] };
    const struct zs_config config = { .width = 240, .height = (uint16_t)(strips * 10), .strip_h = 10,
                                      .buffers = (uint8_t)buffers };
    const struct zs_sink sink = { .submit = submit, .wait = wait_for };
    if (pair_init(&config, arena, sizeof words[0], &sink) != ZS_OK)
        wrong("pair_init");
    for (uint32_t i = 0; i < FRAMES; i++) {
        one_frame();
        if (mode->pauses && one_in(3))
            pause_a_while();
    }
    flush();
    if (pair_ticks(0) > now || pair_ticks(1) > now || pair_waited() > now)
        wrong("more ticks than there were");
    seen->alone += (uint32_t)pair_alone();
    if (told_stopped)
        draw_anew(&config, arena, &sink);
    over = 1;
    leave();
}

/* ---- Seeds ------------------------------------------------------------------------------------------------------- */

static void play(uint32_t seed)
{
    chance.state = seed;
    strips = 1 + prng_pick(&chance, STRIPS_MAX);
    buffers = 1 + prng_pick(&chance, 2);
    switching = 1 + prng_pick(&chance, 6);
    favour = 10 + prng_pick(&chance, 80);
    slowness = one_in(3) ? 26 : 6;
    idly = prng_pick(&chance, 2) * 10;
    dies_at = prng_pick(&chance, 20000);
    expected = strips; /* frame 1's first */
    begin(THREAD, program);
    begin(INTERRUPT, interrupts);
    schedule();
}

extern char __data_start[], _end[]; /* the linker's: all variables of this program, pair.c's among them */

/* Seeds in a process, until one fails: seen->seed. Before each all variables are put back, stacks included, so that
 * pair.c is as it is when a board starts. 0: all is well. */
static int try(uint32_t from, uint32_t to, uint32_t step)
{
    int status;
    seen->why[0] = 0;
    seen->seed = from;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (!child) {
        static const int caught[] = { SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGSYS }; /* by cmocka: it would go on here */
        for (size_t i = 0; i < sizeof caught / sizeof caught[0]; i++)
            (void)signal(caught[i], SIG_DFL);
        const size_t n = (size_t)(_end - __data_start);
        char *const kept = malloc(n);
        if (!kept)
            wrong("no memory");
        memcpy(kept, __data_start, n);
        for (uint32_t seed = from; seed <= to; seed += step) {
            memcpy(__data_start, kept, n);
            seen->seed = seed;
            (void)alarm(20);
            play(seed);
        }
        _exit(0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    if (WIFSIGNALED(status))
        (void)snprintf(seen->why, sizeof seen->why, "ended by signal %d", WTERMSIG(status));
    return status;
}

static void say(void)
{
    print_message("%u frames, %u refused, %u strips sent, errors: %u of submit, %u of wait, %u second cores stopped\n",
                  seen->frames, seen->refused, seen->sent, seen->submit, seen->wait, seen->stopped);
}

static const char *me;

static void seeds(void **state)
{
    uint32_t tried = 0, bad = 0;
    mode = *state;
    memset(seen, 0, sizeof *seen);
    const uint32_t step = (uint32_t)cases_step(mode->seeds);
    for (uint32_t seed = 1; seed <= mode->seeds; seed = seen->seed + step) {
        const int status = try(seed, mode->seeds, step);
        tried += (seen->seed - seed) / step + 1;
        if (status && !bad++)
            print_error("seed %u: %s; run it again: %s %s %u\n", seen->seed, seen->why, me, mode->name, seen->seed);
    }
    if (bad)
        fail_msg("%u of %u seeds fail", bad, tried);
    print_message("%u seeds: ", tried);
    say();
    /* all that the mode is for has happened */
    assert_int_equal(mode->submit > 0, seen->submit > tried);
    assert_int_equal(mode->wait > 0, seen->wait > tried);
    assert_int_equal(mode->refused > 0, seen->refused > tried);
    assert_int_equal(mode->dies, seen->stopped > tried / 4);
    assert_int_equal(seen->anew, seen->stopped);
    assert_true(mode->dies || seen->alone == (mode->no_start ? tried : 0));
    assert_int_equal(!mode->no_start, seen->shared > 0);
    assert_true(seen->frames > tried * FRAMES / 4);
}

/* Usage: test_pair            every mode
 *        test_pair MODE SEED  one seed, and what it came to */
int main(int argc, char **argv)
{
    struct CMUnitTest tests[N_MODES];
    me = argv[0];
    seen = mmap(NULL, sizeof *seen, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (seen == MAP_FAILED)
        return 2;
    for (size_t i = 0; i < N_MODES; i++) {
        tests[i] = (struct CMUnitTest) { modes[i].name, seeds, NULL, NULL, (void *)(uintptr_t)&modes[i] };
        if (argc == 3 && !strcmp(argv[1], modes[i].name)) {
            mode = &modes[i];
            const uint32_t seed = (uint32_t)strtoul(argv[2], NULL, 10);
            if (try(seed, seed, 1))
                print_error("%s\n", seen->why);
            say();
            return seen->why[0] != 0;
        }
    }
    if (argc != 1)
        return 2;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
