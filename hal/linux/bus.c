/* The panel's bus. Commands are sent where they are called for; pixels by a thread, while the caller draws on.
 *
 * D/C separates a command from its arguments and from pixels, and may change only between messages: a command byte
 * is a message of its own, whatever it costs, and so are its arguments. CS rises in between, which the controllers of
 * hal/panel allow.
 *
 * hooks.done is called by that thread, before wait can return; it may not call the bus.
 *
 * SPDX-License-Identifier: MIT
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <signal.h>
#include <string.h>

#include "hal.h"
#include "parts.h"

#define RESET_US 10000u /* controllers want 10 us; modules may have a capacitor on the line */

static struct hal_bus the_bus;

static struct gpio_line *dc_line, *reset_line;
static int dc_level; /* 0, 1; -1: not known */
static uint8_t ready; /* from start to stop */
static uint8_t begun; /* from data until wait; the caller's */

/* What both threads see, behind the mutex. */
static pthread_t thread;
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t changed = PTHREAD_COND_INITIALIZER;
static const uint8_t *out; /* to be sent, or being sent; NULL: nothing */
static uint32_t n_out;
static int outcome; /* enum hal_err, of what was sent last */
static uint8_t quit;

/* ---- The thread ---------------------------------------------------------------------------------------------- */

static void *run(void *unused)
{
    (void)pthread_mutex_lock(&mutex);
    for (;;) {
        while (!out && !quit)
            (void)pthread_cond_wait(&changed, &mutex);
        if (!out)
            break;
        (void)pthread_mutex_unlock(&mutex);
        const int err = linux_spi_send(out, n_out);
        (void)pthread_mutex_lock(&mutex);
        outcome = err;
        out = NULL;
        (void)pthread_cond_broadcast(&changed);
        if (the_bus.hooks.done)
            the_bus.hooks.done(the_bus.hooks.ctx);
    }
    (void)pthread_mutex_unlock(&mutex);
    return unused;
}

/* Signals are the caller's business: the thread takes none. */
static int start_thread(void)
{
    sigset_t all, before;
    (void)sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    const int why = pthread_create(&thread, NULL, run, NULL);
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    return why;
}

static int is_out(void)
{
    (void)pthread_mutex_lock(&mutex);
    const int is = out != NULL;
    (void)pthread_mutex_unlock(&mutex);
    return is;
}

/* ---- The verbs ----------------------------------------------------------------------------------------------- */

static int set_dc(int level)
{
    if (level == dc_level)
        return HAL_ERR_NONE;
    dc_level = gpio_set(dc_line, level) ? -1 : level;
    return dc_level == level ? HAL_ERR_NONE : linux_fail_line("D/C");
}

/* Why a call is refused: for its arguments, or for what it comes after. */
static int refusal(int bad_argument)
{
    return bad_argument ? HAL_ERR_ARG : !ready || begun ? HAL_ERR_STATE : HAL_ERR_NONE;
}

static int command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    (void)bus;
    int err = refusal(n && !args);
    err = err ? err : set_dc(0);
    err = err ? err : linux_spi_send(&code, 1);
    err = err || !n ? err : set_dc(1);
    return err || !n ? err : linux_spi_send(args, n);
}

static int data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    (void)bus;
    const int refused = refusal(!bytes || !n), err = refused ? refused : set_dc(1);
    if (err)
        return err;
    begun = 1;
    (void)pthread_mutex_lock(&mutex);
    out = bytes;
    n_out = n;
    (void)pthread_cond_broadcast(&changed);
    (void)pthread_mutex_unlock(&mutex);
    return HAL_ERR_NONE;
}

static int wait(struct hal_bus *bus)
{
    if (!begun)
        return HAL_ERR_NONE;
    while (bus->hooks.idle && is_out())
        bus->hooks.idle(bus->hooks.ctx);
    (void)pthread_mutex_lock(&mutex);
    while (out)
        (void)pthread_cond_wait(&changed, &mutex);
    const int err = outcome;
    (void)pthread_mutex_unlock(&mutex);
    begun = 0;
    return err;
}

static int reset(struct hal_bus *bus)
{
    (void)bus;
    if (refusal(0))
        return HAL_ERR_STATE;
    if (!reset_line->held)
        return HAL_ERR_NONE;
    int err = gpio_set(reset_line, 0);
    linux_pause_us(RESET_US);
    err = gpio_set(reset_line, 1) || err;
    return err ? linux_fail_line("RESET") : HAL_ERR_NONE;
}

static void delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus;
    linux_pause_us(us);
}

static struct hal_bus the_bus = { .command = command, .data = data, .wait = wait, .reset = reset, .delay = delay };

struct hal_bus *hal_bus(void)
{
    return &the_bus;
}

int linux_bus_start(struct gpio_line *dc, struct gpio_line *reset_or_none)
{
    dc_line = dc;
    reset_line = reset_or_none;
    dc_level = -1;
    quit = 0;
    const int why = start_thread();
    if (why)
        return linux_fail(HAL_ERR_BUS, "there is no thread to send with: %s; end other programs of this user, or raise "
                          "its limit (ulimit -u)", strerror(why));
    ready = 1;
    return HAL_ERR_NONE;
}

void linux_bus_stop(void)
{
    if (!ready)
        return;
    (void)wait(&the_bus);
    ready = 0;
    (void)pthread_mutex_lock(&mutex);
    quit = 1;
    (void)pthread_cond_broadcast(&changed);
    (void)pthread_mutex_unlock(&mutex);
    (void)pthread_join(thread, NULL);
}
