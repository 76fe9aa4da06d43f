/* A libFuzzer target: a panel's byte stream into the model of its controller, and through `zsim panel`. Byte 0: the
 * module; byte 1: bits 0 to 2 of struct pm_glass, bit 3 time passes, bit 7 the command too; then words as of `zsim
 * panel --decode`, the last of which may be cut.
 *
 *   counts add up; what the glass shows is of its format, and black where it is dark
 *   problems are sentences about bytes of the stream
 *   the command takes exactly the streams without problems, and refuses the others with one line
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "panel.h"
#include "panel_decode.h"
#include "panel_model.h"
#include "sim.h"
#include "target.h"

enum { DATA = 0x100, RESET = 0x200, FRAME = 0x400, DESELECT = 0x800, TEXT = 0x1000 };
enum { SSD0323_RAM = 128 * 80 }; /* pixels, and what one of its commands may draw by itself: a rectangle */
enum { INVERTED = 1, BGR = 2, MIRRORED = 4, TIME = 8, COMMAND = 128 };

const char target_name[] = "fuzz_panel";
const char *const target_words[] = { /* words of two bytes; the high one of a command is 0, which a text cannot hold */
    "\x2c", "\x2a", "\x2b", "\x36", "\x3a", "\x11", "\x29", "\x10", "\x01", "\x12", "\x33", "\x37", "\x20", "\x21",
    "\x28", "\x3c", "\x5c", "\x15", "\x75", "\xa0", "\xa1", "\xa8", "\xae", "\xaf", "\xfd", "\xd5", "\x8d", "\xb1",
    "\xca", "\x26",
    "\x22", "\x23", "\x24", "\x25", "\x27", "\x2e", "\x2f", "\xe7", "\x01\x01", "\xff\x01", "\x10\x01", "\xb0\x01", NULL
};

/* ---- Modules and seeds ------------------------------------------------------------------------------------ */

/* The kth module of the list, modulo their number. */
static void module_name(uint32_t k, char name[40])
{
    const char *list = pm_glass_list(), *p = list;
    uint32_t n = 1;
    for (const char *c = list; *c; c++)
        n += *c == ',';
    for (k %= n; k; k--)
        p = strchr(p, ',') + 1;
    p += strspn(p, " ");
    const size_t bytes = strcspn(p, ",");
    EXPECT(bytes < 40);
    memcpy(name, p, bytes);
    name[bytes] = 0;
}

struct recorder {
    struct hal_bus bus;
    uint8_t *to;
    size_t n, room;
};

static void word(struct hal_bus *bus, uint32_t value)
{
    struct recorder *r = (struct recorder *)(void *)bus;
    if (r->n + 2 <= r->room) {
        r->to[r->n++] = (uint8_t)value;
        r->to[r->n++] = (uint8_t)(value >> 8);
    }
}

static int rec_command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    word(bus, code);
    for (uint32_t i = 0; i < n; i++)
        word(bus, DATA | args[i]);
    word(bus, DESELECT);
    return HAL_ERR_NONE;
}

static int rec_data(struct hal_bus *bus, const uint8_t *bytes, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++)
        word(bus, DATA | bytes[i]);
    word(bus, DESELECT);
    return HAL_ERR_NONE;
}

static int rec_wait(struct hal_bus *bus)
{
    (void)bus;
    return HAL_ERR_NONE;
}

static int rec_reset(struct hal_bus *bus)
{
    word(bus, RESET);
    return HAL_ERR_NONE;
}

static void rec_delay(struct hal_bus *bus, uint32_t us)
{
    (void)bus, (void)us;
}

/* What the drivers send: set-up, and two small windows. */
size_t target_seed(uint32_t k, uint8_t *to, size_t room)
{
    static const struct panel_type *const types[] = { &panel_st7789, &panel_ili9341, &panel_gc9a01, &panel_ssd1351,
                                                      &panel_ssd0323, &panel_ssd1306 };
    static uint32_t scratch[4096];
    static const uint8_t px[2 * 16 * 4] = { 1, 2, 3, 4, 5 };
    static const char *const names[] = { "st7789", "ili9341", "gc9a01", "ssd1351", "ssd0323", "ssd1306" };
    char name[40];
    if (k >= 24 || room < 2)
        return 0;
    module_name(k, name);
    struct pm_glass glass;
    EXPECT(pm_glass_named(&glass, name));
    struct panel_config config = { .width = glass.width, .height = glass.height };
    for (int t = 0; t < 6; t++)
        if (strncmp(name, names[t], strlen(names[t])) == 0)
            config.type = types[t];
    struct recorder r = { { rec_command, rec_data, rec_wait, rec_reset, rec_delay, { 0 } }, to, 2, room };
    struct panel panel;
    to[0] = (uint8_t)k;
    to[1] = (uint8_t)(k & 1 ? COMMAND : 0);
    if (!config.type || panel_init(&panel, &config, &r.bus, scratch, sizeof scratch) != HAL_ERR_NONE)
        return 0;
    const struct panel_rect rect = { 0, 8, 16, 4 };
    for (int n = 0; n < 2; n++)
        if (panel_send(&panel, &rect, px, 0) == HAL_ERR_NONE)
            (void)panel_wait(&panel);
    return r.n;
}

/* ---- The target ------------------------------------------------------------------------------------------- */

static int is_word(uint32_t w)
{
    const uint32_t marks = w & (RESET | FRAME | DESELECT);
    if (w & TEXT)
        return w < TEXT + 256;
    return w < TEXT && (!marks || w == marks);
}

static void picture_right(const struct pm_model *model, const struct pm_glass *glass)
{
    const size_t n = (size_t)glass->width * glass->height;
    uint8_t *rgb = malloc(3 * n), *seen = malloc(3 * n);
    uint16_t *raw = malloc(2 * n);
    if (!rgb || !seen || !raw)
        abort();
    pm_picture(model, rgb, raw);
    const enum pm_format format = pm_glass_format(glass);
    const uint16_t most = format == PM_RGB565 ? 65535 : format == PM_GREY4 ? 15 : 1;
    for (size_t i = 0; i < n; i++) {
        EXPECT(raw[i] <= most && (pm_lit(model) || raw[i] == 0));
        if (format == PM_RGB565)
            EXPECT(rgb[3 * i] >> 3 == raw[i] >> 11 && rgb[3 * i + 1] >> 2 == (raw[i] >> 5 & 63) &&
                   rgb[3 * i + 2] >> 3 == (raw[i] & 31));
        else
            EXPECT(rgb[3 * i] == raw[i] * (format == PM_GREY4 ? 17 : 255) && rgb[3 * i] == rgb[3 * i + 2]);
    }
    for (int turns = 0; turns < 4; turns++)
        pm_view(glass, turns, rgb, seen, 3);
    free(rgb);
    free(seen);
    free(raw);
}

static size_t problems_right(const struct pm_model *model)
{
    const struct pm_problem *problem;
    const size_t n = pm_problems(model, &problem);
    EXPECT(n <= 1000);
    for (size_t i = 0; i < n; i++) {
        EXPECT(problem[i].at <= pm_counts(model)->bytes && problem[i].text[0]);
        EXPECT(memchr(problem[i].text, 0, sizeof problem[i].text) && !strchr(problem[i].text, '\n'));
    }
    return n;
}

/* Feed the words; the number of problems. */
static size_t feed(const struct pm_glass *glass, const uint8_t *data, size_t n, int timed)
{
    struct pm_model *model = pm_new(glass);
    uint64_t bytes = 0, data_bytes = 0, resets = 0;
    EXPECT(model);
    for (size_t i = 0; i < n; i++) {
        const uint32_t w = data[2 * i] | (uint32_t)data[2 * i + 1] << 8;
        if (w & TEXT || !is_word(w))
            continue;
        if (w & RESET) {
            pm_reset(model);
            resets++;
        } else if (w & DESELECT) {
            pm_deselect(model);
        } else if (!(w & FRAME)) {
            pm_byte(model, (uint8_t)w, w & DATA);
            bytes++;
            data_bytes += (w & DATA) != 0;
        }
        if (timed)
            pm_elapsed(model, (uint32_t)w << (i % 12));
    }
    pm_end(model);
    const struct pm_counts *c = pm_counts(model);
    EXPECT(c->bytes == bytes && c->data_bytes == data_bytes && c->command_bytes == bytes - data_bytes);
    EXPECT(c->resets == resets && c->pixel_bytes <= bytes && c->transactions <= bytes && c->commands <= bytes);
    EXPECT(c->windows <= c->commands);
    EXPECT(c->pixels <= 8 * c->pixel_bytes + (glass->controller == PM_SSD0323 ? c->commands * SSD0323_RAM : 0));
    (void)pm_light(model);
    const size_t problems = problems_right(model);
    picture_right(model, glass);
    pm_free(model);
    return problems;
}

static void command(const char *name, unsigned flags, const uint8_t *data, size_t size, int good)
{
    static struct said said;
    static int stream = -1;
    char decode[64], out[128];
    if (stream < 0)
        stream = memfd_create("stream", 0);
    if (stream < 0 || ftruncate(stream, 0) || pwrite(stream, data, size, 0) != (ssize_t)size)
        abort();
    snprintf(decode, sizeof decode, "/proc/self/fd/%d", stream);
    snprintf(out, sizeof out, "%s/fuzz_panel-%d-%%d.png", P_tmpdir, (int)getpid());
    char *argv[] = { "--panel", (char *)(uintptr_t)name, "--decode", decode, "--out", out,
                     flags & INVERTED ? "--invert" : "--bgr", "--bgr" };
    said_begin(&said);
    const int status = sim_panel(flags & BGR ? 8 : flags & INVERTED ? 7 : 6, argv);
    said_end(&said);
    for (int k = 0; k < 4; k++) {
        char made[140];
        snprintf(made, sizeof made, "%s/fuzz_panel-%d-%d.png", P_tmpdir, (int)getpid(), k);
        (void)unlink(made);
    }
    EXPECT(status == (good ? SIM_OK : SIM_REFUSED) && said.lines == (status != SIM_OK));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2)
        return 0;
    char name[40];
    struct pm_glass glass;
    module_name(data[0], name);
    EXPECT(pm_glass_named(&glass, name));
    const unsigned flags = data[1];
    if (flags & INVERTED)
        glass.inverted = 1;
    if (flags & BGR)
        glass.bgr = 1;
    if (flags & MIRRORED && !(flags & COMMAND))
        glass.mirrored = 1;
    const size_t n = (size - 2) / 2;
    size_t frames = 0, odd = (size - 2) % 2;
    for (size_t i = 0; i < n; i++) {
        const uint32_t w = data[2 + 2 * i] | (uint32_t)data[3 + 2 * i] << 8;
        odd += !is_word(w);
        frames += w == FRAME;
    }
    const size_t problems = feed(&glass, data + 2, n, flags & TIME && !(flags & COMMAND));
    if (flags & COMMAND && frames < 4)
        command(name, flags, data + 2, size - 2, !odd && !problems);
    return 0;
}
