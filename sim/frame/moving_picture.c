/* Chunks of a PNG by hand (PNG specification, third edition: acTL, fcTL, fdAT), compressed by zlib, rows by the filter
 * whose bytes are smallest. GIF89a with its LZW, codes of 2 to 12 bits.
 *
 * SPDX-License-Identifier: MIT
 */
#include "moving_picture.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>

#include "image.h"
#include "output_file.h"
#include "palette.h"
#include "sim.h"

/* ---- What has changed ------------------------------------------------------------------------ */

struct rect {
    uint32_t x, y, w, h;
};

/* The smallest rectangle of frame k that is not as in the one before; one pixel where all is; all of frame 0. */
static struct rect changed(const struct sim_moving *m, uint32_t k)
{
    const size_t row = 3 * (size_t)m->width;
    uint32_t x0 = m->width, x1 = 0, y0 = m->height, y1 = 0;
    if (k == 0)
        return (struct rect){ 0, 0, m->width, m->height };
    for (uint32_t y = 0; y < m->height; y++) {
        const uint8_t *now = m->frame[k] + y * row, *then = m->frame[k - 1] + y * row;
        if (memcmp(now, then, row) == 0)
            continue;
        uint32_t a = 0, b = m->width;
        while (memcmp(now + 3 * (size_t)a, then + 3 * (size_t)a, 3) == 0)
            a++;
        while (memcmp(now + 3 * (size_t)(b - 1), then + 3 * (size_t)(b - 1), 3) == 0)
            b--;
        x0 = a < x0 ? a : x0;
        x1 = b > x1 ? b : x1;
        y0 = y < y0 ? y : y0;
        y1 = y + 1;
    }
    return x1 == 0 ? (struct rect){ 0, 0, 1, 1 } : (struct rect){ x0, y0, x1 - x0, y1 - y0 };
}

static int written(FILE *f, const char *name)
{
    return ferror(f) ? sim_refuse(name, 0, "cannot be written: %s",
                                  errno != 0 ? strerror(errno) : "the disk may be full")
                     : SIM_OK;
}

/* ---- PNG ------------------------------------------------------------------------------------- */

static void put32(uint8_t *to, uint32_t n)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(n >> (24 - 8 * i));
}

/* A chunk: the first `lead` bytes from one place, the rest from another. */
static void chunk(FILE *f, const char type[4], const uint8_t *lead, size_t n_lead,
                  const uint8_t *data, size_t n)
{
    uint8_t head[8], tail[4];
    put32(head, (uint32_t)(n_lead + n));
    memcpy(head + 4, type, 4);
    uLong sum = crc32(0, head + 4, 4);
    sum = n_lead > 0 ? crc32(sum, lead, (uInt)n_lead) : sum;
    sum = n > 0 ? crc32(sum, data, (uInt)n) : sum;
    put32(tail, (uint32_t)sum);
    (void)fwrite(head, 1, sizeof head, f);
    if (n_lead > 0)
        (void)fwrite(lead, 1, n_lead, f);
    if (n > 0)
        (void)fwrite(data, 1, n, f);
    (void)fwrite(tail, 1, sizeof tail, f);
}

static uint8_t paeth(int a, int b, int c)
{
    const int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return (uint8_t)(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
}

/* A row of n bytes by a filter; above: the row before, or zeros. Return the sum of its bytes as signed ones. */
static unsigned long filter_row(uint8_t *to, const uint8_t *row, const uint8_t *above, size_t n,
                                int filter)
{
    unsigned long sum = 0;
    for (size_t i = 0; i < n; i++) {
        const int a = i >= 3 ? row[i - 3] : 0, b = above[i], c = i >= 3 ? above[i - 3] : 0;
        const int from = filter == 1   ? a
                         : filter == 2 ? b
                         : filter == 3 ? (a + b) / 2
                         : filter == 4 ? paeth(a, b, c)
                                       : 0;
        to[i] = (uint8_t)(row[i] - from);
        sum += to[i] < 128 ? to[i] : 256u - to[i];
    }
    return sum;
}

/* A rectangle of a frame, filtered and compressed; malloc'ed. */
static uint8_t *compressed(const struct sim_moving *m, const uint8_t *rgb, const struct rect *r,
                           size_t *n)
{
    const size_t row = 3 * (size_t)r->w, all = (row + 1) * r->h;
    uint8_t *raw = sim_alloc(all, 1), *best = sim_alloc(row, 1), *zeros = sim_alloc(row, 1);
    const uint8_t *above = zeros;
    for (uint32_t y = 0; y < r->h; y++) {
        const uint8_t *from = rgb + 3 * ((size_t)(r->y + y) * m->width + r->x);
        uint8_t *to = raw + y * (row + 1);
        unsigned long least = 0;
        for (int filter = 0; filter < 5; filter++) {
            const unsigned long sum = filter_row(best, from, above, row, filter);
            if (filter > 0 && sum >= least)
                continue;
            least = sum;
            to[0] = (uint8_t)filter;
            memcpy(to + 1, best, row);
        }
        above = from;
    }
    uLongf room = compressBound((uLong)all);
    uint8_t *out = sim_alloc(room, 1);
    const int status = compress2(out, &room, raw, (uLong)all, 9);
    *n = status == Z_OK ? room : 0;
    SIM_FREE(raw, best, zeros);
    return out;
}

int sim_moving_png(FILE *f, const char *name, const struct sim_moving *m)
{
    static const uint8_t signature[8] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    uint8_t ihdr[13] = { [8] = 8, [9] = 2 }, actl[8] = { 0 };
    uint32_t sequence = 0;
    int ok = 1;
    (void)fwrite(signature, 1, sizeof signature, f);
    put32(ihdr, m->width);
    put32(ihdr + 4, m->height);
    chunk(f, "IHDR", ihdr, sizeof ihdr, NULL, 0);
    put32(actl, m->n_frames); /* and 0: for ever */
    chunk(f, "acTL", actl, sizeof actl, NULL, 0);
    for (uint32_t k = 0; ok && k < m->n_frames; k++) {
        const struct rect r = changed(m, k);
        uint8_t fctl[26] = { 0 },
                number[4]; /* the last two: it stays, and replaces what was there */
        size_t n;
        uint8_t *data = compressed(m, m->frame[k], &r, &n);
        put32(fctl, sequence++);
        put32(fctl + 4, r.w);
        put32(fctl + 8, r.h);
        put32(fctl + 12, r.x);
        put32(fctl + 16, r.y);
        fctl[20] = (uint8_t)(m->delay_ms >> 8);
        fctl[21] = (uint8_t)m->delay_ms;
        fctl[22] = 1000 >> 8;
        fctl[23] = 1000 & 255;
        chunk(f, "fcTL", fctl, sizeof fctl, NULL, 0);
        put32(number, sequence);
        if (k == 0)
            chunk(f, "IDAT", NULL, 0, data, n);
        else
            chunk(f, "fdAT", number, sizeof number, data, n);
        sequence += k > 0;
        ok = n > 0;
        free(data);
        sim_progress("animated PNG", k, m->n_frames);
    }
    chunk(f, "IEND", NULL, 0, NULL, 0);
    return ok ? written(f, name)
              : sim_refuse(name, 0, "cannot be written: its frames are too large to compress");
}

/* ---- GIF ------------------------------------------------------------------------------------- */

#define CODES 4096u

/* Codes into bits, bits into blocks of at most 255 bytes. */
struct bits {
    FILE *f;
    uint8_t block[256]; /* [0]: how many follow */
    uint32_t held;
    unsigned n_held;
};

static void put_byte(struct bits *b, uint8_t byte)
{
    b->block[++b->block[0]] = byte;
    if (b->block[0] == 255) {
        (void)fwrite(b->block, 1, 256, b->f);
        b->block[0] = 0;
    }
}

static void put_code(struct bits *b, uint32_t code, unsigned size)
{
    b->held |= code << b->n_held;
    for (b->n_held += size; b->n_held >= 8; b->n_held -= 8) {
        put_byte(b, (uint8_t)b->held);
        b->held >>= 8;
    }
}

/* Strings of the table by their last code and next byte: child[code][byte], 0 where there is none. */
static void lzw(FILE *f, const uint8_t *index, size_t n)
{
    uint16_t(*child)[256] = sim_alloc(CODES, sizeof *child);
    struct bits b = { .f = f };
    const uint32_t clear = 256, end = 257;
    uint32_t next = 258, code = index[0];
    unsigned size = 9;
    (void)putc(8, f);
    put_code(&b, clear, size);
    for (size_t i = 1; i < n; i++) {
        if (child[code][index[i]] != 0) {
            code = child[code][index[i]];
            continue;
        }
        put_code(&b, code, size);
        if (next < CODES) {
            child[code][index[i]] = (uint16_t)next;
            size += next == 1u << size; /* the reader's table is one behind */
            next++;
        } else {
            put_code(&b, clear, size);
            memset(child, 0, CODES * sizeof *child);
            next = 258;
            size = 9;
        }
        code = index[i];
    }
    put_code(&b, code, size);
    size += next == 1u << size && size < 12;
    put_code(&b, end, size);
    if (b.n_held > 0)
        put_byte(&b, (uint8_t)b.held);
    if (b.block[0] > 0)
        (void)fwrite(b.block, 1, b.block[0] + 1u, f);
    (void)putc(0, f);
    free(child);
}

/* Of up to 16 frames, one below the other. */
static uint32_t choose_colors(uint16_t palette[SIM_PALETTE_MAX], const struct sim_moving *m)
{
    const uint32_t n = m->n_frames < 16 ? m->n_frames : 16;
    const size_t size = (size_t)m->width * m->height;
    uint8_t(*all)[3] = sim_alloc(n * size, sizeof *all);
    for (uint32_t k = 0; k < n; k++)
        memcpy(all[k * size], m->frame[(size_t)k * m->n_frames / n], 3 * size);
    const struct sim_pixels pixels = { m->width, m->height * n, (const uint8_t(*)[3])all };
    const uint32_t colors = sim_palette_build(palette, SIM_PALETTE_MAX, &pixels);
    free(all);
    return colors;
}

static void put16(FILE *f, uint32_t n)
{
    (void)putc((int)(n & 255), f);
    (void)putc((int)(n >> 8 & 255), f);
}

static void gif_frame(FILE *f, const struct sim_moving *m, uint32_t k, const uint16_t *palette,
                      uint32_t n_colors)
{
    const struct rect r = changed(m, k);
    const size_t n = (size_t)r.w * r.h;
    uint8_t(*rgb)[3] = sim_alloc(n, sizeof *rgb), *index = sim_alloc(n, 1);
    for (uint32_t y = 0; y < r.h; y++)
        memcpy(rgb[(size_t)y * r.w], m->frame[k] + 3 * ((size_t)(r.y + y) * m->width + r.x),
               3 * (size_t)r.w);
    const struct sim_pixels pixels = { r.w, r.h, (const uint8_t(*)[3])rgb };
    sim_palette_map(index, &pixels, palette, n_colors, 0);
    (void)fwrite("\x21\xf9\x04\x04", 1, 4, f); /* it stays */
    put16(f, (m->delay_ms + 5) / 10);
    put16(f, 0);
    (void)putc(',', f);
    put16(f, r.x);
    put16(f, r.y);
    put16(f, r.w);
    put16(f, r.h);
    (void)putc(0, f);
    lzw(f, index, n);
    SIM_FREE(rgb, index);
}

int sim_moving_gif(FILE *f, const char *name, const struct sim_moving *m)
{
    uint16_t palette[SIM_PALETTE_MAX] = { 0 };
    const uint32_t colors = choose_colors(palette, m);
    (void)fwrite("GIF89a", 1, 6, f);
    put16(f, m->width);
    put16(f, m->height);
    (void)fwrite("\xf7\0\0", 1, 3, f); /* 256 colours of 8 bits */
    for (uint32_t i = 0; i < SIM_PALETTE_MAX; i++) {
        uint8_t rgb[3];
        sim_rgb565_expand(rgb, palette[i]);
        (void)fwrite(rgb, 1, 3, f);
    }
    (void)fwrite("\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 1, 19, f);
    for (uint32_t k = 0; k < m->n_frames; k++) {
        gif_frame(f, m, k, palette, colors);
        sim_progress("GIF", k, m->n_frames);
    }
    (void)putc(';', f);
    return written(f, name);
}

int sim_moving_write(const struct sim_output *out, const struct sim_moving *m)
{
    const char *path = out->name;
    const size_t n = strlen(path);
    const char *end = n >= 4 ? path + n - 4 : "";
    int status;
    if (strcasecmp(end, ".mp4") == 0)
        status = sim_moving_mp4(out->temporary != NULL ? out->temporary : out->path, path, m);
    else if (strcasecmp(end, ".gif") == 0)
        status = sim_moving_gif(out->file, path, m);
    else
        status = sim_moving_png(out->file, path, m);
    sim_progress_end();
    return status;
}

int sim_moving_save(const char *path, const struct sim_moving *m)
{
    struct sim_output out;
    const int status = sim_output_open(&out, path);
    return status != SIM_OK ? status : sim_output_end(sim_moving_write(&out, m), &out, 1);
}
