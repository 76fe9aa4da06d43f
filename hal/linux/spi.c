/* spidev: bytes out, whole messages at a time. The kernel copies a message once, from where the caller has it; a longer
 * transfer is cut into messages of at most `limit` bytes, the module's parameter bufsiz. Between messages CS may rise:
 * the controllers of hal/panel go on where they were.
 *
 * An ioctl returns when the last bit is out, so that D/C may change then. It cannot be broken off by a signal.
 *
 * SPDX-License-Identifier: MIT
 */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hal.h"
#include "parts.h"

#define BUFSIZ_PATH "/sys/module/spidev/parameters/bufsiz"
#define BUFSIZ_DEFAULT 4096u

static int device = -1;
static uint32_t limit;
static struct linux_sent sent;
static const char *name;

/* ---- Opening ------------------------------------------------------------------------------------------------- */

uint32_t linux_spi_limit(void)
{
    char text[16] = { 0 };
    const int f = open(BUFSIZ_PATH, O_RDONLY | O_CLOEXEC);
    if (f < 0)
        return BUFSIZ_DEFAULT;
    const ssize_t n = read(f, text, sizeof text - 1);
    (void)close(f);
    const unsigned long bytes = n > 0 ? strtoul(text, NULL, 10) : 0;
    return bytes > 0 && bytes <= INT32_MAX ? (uint32_t)bytes : BUFSIZ_DEFAULT;
}

static int refuse_device(const char *path, int why)
{
    char other[DEV_NAME];
    if (why == EACCES || why == EPERM)
        return linux_refuse_access("", path, why);
    if (why == ENOENT && linux_next_device("spidev", "", other))
        return linux_fail(HAL_ERR_BUS, "there is no %s; there is /dev/%s", path, other);
    if (why == ENOENT)
        return linux_fail(HAL_ERR_BUS, "there is no %s, SPI is off; on a Raspberry Pi put dtparam=spi=on into "
                          "/boot/firmware/config.txt and reboot, elsewhere load the overlay that gives a spidev", path);
    if (why == ENODEV || why == ENXIO)
        return linux_fail(HAL_ERR_BUS, "%s has no device behind it any more; load its driver or overlay again", path);
    if (why == ENOTTY)
        return linux_fail(HAL_ERR_BUS, "%s is no spidev; name one, such as /dev/spidev0.0", path);
    if (why == ENOMEM)
        return linux_fail(HAL_ERR_BUS, "%s: there is no memory for its buffers of %lu bytes; ask for less, by "
                          "spidev.bufsiz on the kernel's command line", path, (unsigned long)linux_spi_limit());
    return linux_fail(HAL_ERR_BUS, "%s cannot be used: %s; the kernel's log (dmesg) tells more", path, strerror(why));
}

int linux_spi_look(const struct linux_wiring *wiring)
{
    struct stat st;
    if (stat(wiring->spi, &st) || access(wiring->spi, R_OK | W_OK))
        return refuse_device(wiring->spi, errno);
    return S_ISCHR(st.st_mode) ? HAL_ERR_NONE : refuse_device(wiring->spi, ENOTTY);
}

/* One setting of the device; EINVAL is about the value. */
static int set(unsigned long request, const void *value)
{
    int n;
    do
        n = ioctl(device, request, value);
    while (n < 0 && errno == EINTR);
    return n < 0 ? errno : 0;
}

static int configure(const struct linux_wiring *w)
{
    const uint8_t bits = 8;
    int why = set(SPI_IOC_WR_MODE, &w->mode);
    if (why == EINVAL)
        return linux_fail(HAL_ERR_BUS, "%s: its controller has no SPI mode %u; take another device", w->spi, w->mode);
    if (!why)
        why = set(SPI_IOC_WR_BITS_PER_WORD, &bits);
    if (why == EINVAL)
        return linux_fail(HAL_ERR_BUS, "%s: its controller does not send words of 8 bits; take another device", w->spi);
    if (!why)
        why = set(SPI_IOC_WR_MAX_SPEED_HZ, &w->hz);
    if (why == EINVAL)
        return linux_fail(HAL_ERR_BUS, "%s: its controller cannot be clocked at %lu Hz; ask for another speed", w->spi,
                          (unsigned long)w->hz);
    return why ? refuse_device(w->spi, why) : HAL_ERR_NONE;
}

int linux_spi_open(const struct linux_wiring *wiring)
{
    static const struct linux_sent nothing;
    name = wiring->spi;
    sent = nothing;
    limit = linux_spi_limit();
    device = open(name, O_RDWR | O_CLOEXEC);
    if (device < 0)
        return refuse_device(name, errno);
    const int err = configure(wiring);
    if (err)
        linux_spi_close();
    return err;
}

void linux_spi_close(void)
{
    if (device >= 0)
        (void)close(device);
    device = -1;
}

/* ---- Sending --------------------------------------------------------------------------------------------------- */

static int refuse_message(uint32_t n, int why)
{
    if (why == ESHUTDOWN || why == ENODEV)
        return linux_fail(HAL_ERR_BUS, "%s is gone: its driver was taken away; load it again and start anew", name);
    if (why == EINVAL)
        return linux_fail(HAL_ERR_BUS, "%s: its controller refuses %u bytes at this speed; ask for another speed, or a "
                          "smaller spidev.bufsiz", name, (unsigned)n);
    if (why == ETIMEDOUT)
        return linux_fail(HAL_ERR_TIMEOUT, "%s: its controller did not send %u bytes in its time; ask for another "
                          "speed", name, (unsigned)n);
    return linux_fail(HAL_ERR_BUS, "%s: %u bytes were not sent: %s; the kernel's log (dmesg) tells more", name,
                      (unsigned)n, strerror(why));
}

static int send_message(const uint8_t *bytes, uint32_t n)
{
    const struct spi_ioc_transfer transfer = { .tx_buf = (uintptr_t)bytes, .len = n };
    int taken;
    do /* EINTR: it was not begun */
        taken = ioctl(device, SPI_IOC_MESSAGE(1), &transfer);
    while (taken < 0 && errno == EINTR);
    return taken < 0 ? refuse_message(n, errno) : HAL_ERR_NONE;
}

int linux_spi_send(const uint8_t *bytes, uint32_t n)
{
    sent.last_from = hal_ticks();
    int err = HAL_ERR_NONE;
    while (n && !err) {
        const uint32_t part = n < limit ? n : limit;
        err = send_message(bytes, part);
        sent.bytes += err ? 0 : part;
        sent.messages++;
        bytes += part;
        n -= part;
    }
    sent.last_to = hal_ticks();
    sent.us += sent.last_to - sent.last_from;
    return err;
}

struct linux_sent linux_spi_sent(void)
{
    return sent;
}
