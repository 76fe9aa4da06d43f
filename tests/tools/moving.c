/* Animated PNGs and GIFs, read by their specifications and nothing of sim/.
 * moving FILE        "WIDTH HEIGHT FRAMES DELAY CHANGED": ms of all frames together; pixels in rectangles of all frames
 * moving FILE K      frame K as it is seen, 3 bytes a pixel, to standard output
 * moving FILE K X Y W H    this part of it
 * moving FILE K box  "LEFT TOP RIGHT BOTTOM COLOR": what of it is not of its first pixel's colour
 * moving FILE all [box]    the pixels of all frames one after the other, or a line each
 * What is not as it should be is said in a line, exit status 1. Of PNGs those of 8-bit RGB, not interlaced.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static uint8_t *file;
static size_t n_file;
static uint32_t width, height, n_frames, delay_ms;
static unsigned long changed;
static long wanted = -1, part[4]; /* part: x, y, width, height */
static int box, all;              /* flags */
static uint8_t *seen;             /* [height][width][3] */

static _Noreturn void bad(const char *what)
{
    printf("%s\n", what);
    exit(1);
}

static void need(int sound, const char *what)
{
    if (!sound)
        bad(what);
}

static void print_box(void)
{
    uint32_t x0 = width, y0 = height, x1 = 0, y1 = 0;
    for (uint32_t i = 0; i < width * height; i++)
        if (memcmp(seen + 3 * (size_t)i, seen, 3) != 0) {
            const uint32_t x = i % width, y = i / width;
            x0 = x < x0 ? x : x0;
            y0 = y < y0 ? y : y0;
            x1 = x > x1 ? x : x1;
            y1 = y;
        }
    printf("%u %u %u %u %02x%02x%02x\n", x0, y0, x1, y1, seen[0], seen[1], seen[2]);
}

static void frame_done(uint32_t k)
{
    const long w = part[2] > 0 ? part[2] : width, h = part[3] > 0 ? part[3] : height;
    if ((long)k != wanted && !all)
        return;
    need(part[0] + w <= width && part[1] + h <= height,
         "the picture is smaller than the part of it");
    if (box)
        print_box();
    for (long y = 0; !box && y < h; y++)
        (void)fwrite(seen + 3 * (size_t)((part[1] + y) * width + part[0]), 3, (size_t)w, stdout);
}

static void begin(uint32_t w, uint32_t h)
{
    need(w > 0 && h > 0 && w < 65536 && h < 65536, "no size");
    width = w;
    height = h;
    seen = calloc((size_t)w * h, 3);
}

/* ---- PNG --------------------------------------------------------------------------------------------------------- */

static uint32_t be(const uint8_t *p, int n)
{
    uint32_t value = 0;
    for (int i = 0; i < n; i++)
        value = value << 8 | p[i];
    return value;
}

/* Bit by bit, as the annex of the specification defines it. */
static uint32_t crc(const uint8_t *p, size_t n)
{
    uint32_t c = 0xffffffffu;
    for (size_t i = 0; i < n; i++) {
        c ^= p[i];
        for (int k = 0; k < 8; k++)
            c = c & 1 ? 0xedb88320u ^ c >> 1 : c >> 1;
    }
    return ~c;
}

struct area {
    uint32_t x, y, w, h;
};

static void show(const struct area *a, const uint8_t *packed, size_t n)
{
    const size_t row = 3 * (size_t)a->w;
    uLongf got = (row + 1) * a->h;
    uint8_t *raw = malloc(got + 1);
    need(a->w > 0 && a->h > 0 && a->x + a->w <= width && a->y + a->h <= height,
         "a frame is larger than the picture");
    need(uncompress(raw, &got, packed, n) == Z_OK && got == (row + 1) * a->h,
         "a frame has other bytes than pixels");
    changed += (unsigned long)a->w * a->h;
    for (uint32_t y = 0; y < a->h; y++) {
        uint8_t *now = raw + y * (row + 1) + 1;
        const uint8_t *above = y > 0 ? now - row - 1 : NULL;
        need(now[-1] < 5, "no such filter");
        for (size_t i = 0; i < row; i++) {
            const int left = i > 2 ? now[i - 3] : 0, up = above ? above[i] : 0,
                      corner = above && i > 2 ? above[i - 3] : 0;
            const int guess = left + up - corner;
            const int dl = abs(guess - left), du = abs(guess - up), dc = abs(guess - corner);
            const int by[5] = { 0, left, up, (left + up) / 2,
                                dl <= du && dl <= dc ? left
                                : du <= dc           ? up
                                                     : corner };
            now[i] = (uint8_t)(now[i] + by[now[-1]]);
        }
        memcpy(seen + 3 * ((size_t)(a->y + y) * width + a->x), now, row);
    }
    free(raw);
}

static void read_png(void)
{
    struct area area = { 0 };
    uint8_t *data = malloc(n_file);
    size_t n_data = 0, at = 8;
    uint32_t sequence = 0, told = 0, shown = 0;
    int ended = 0, has_data = 0;
    while (!ended) {
        need(at + 12 <= n_file, "it ends in a chunk");
        const uint32_t n = be(file + at, 4);
        const uint8_t *type = file + at + 4, *body = type + 4;
        need(n <= n_file - at - 12, "a chunk is longer than the file");
        need(crc(type, n + 4) == be(body + n, 4), "a check sum is wrong");
        const int is_control = !memcmp(type, "fcTL", 4), is_end = !memcmp(type, "IEND", 4);
        if ((is_control || is_end) && n_data > 0) {
            show(&area, data, n_data);
            frame_done(shown++);
            n_data = 0;
        }
        if (!memcmp(type, "IHDR", 4)) {
            begin(be(body, 4), be(body + 4, 4));
            need(body[8] == 8 && body[9] == 2 && body[12] == 0, "not 8-bit RGB");
            area = (struct area){ 0, 0, width, height };
        } else if (!memcmp(type, "acTL", 4)) {
            need(n == 8 && !has_data && be(body + 4, 4) == 0, "it does not repeat for ever");
            told = be(body, 4);
        } else if (is_control) {
            need(n == 26 && told > 0 && be(body, 4) == sequence++, "frames are out of order");
            area = (struct area){ be(body + 12, 4), be(body + 16, 4), be(body + 4, 4),
                                  be(body + 8, 4) };
            need(be(body + 22, 2) == 1000 && body[24] == 0 && body[25] == 0,
                 "a frame does not stay");
            delay_ms += be(body + 20, 2);
        } else if (!memcmp(type, "IDAT", 4)) {
            need(shown == 0, "IDAT after the first frame");
            memcpy(data + n_data, body, n);
            n_data += n;
            has_data = 1;
        } else if (!memcmp(type, "fdAT", 4)) {
            need(n > 4 && has_data && be(body, 4) == sequence++, "data are out of order");
            memcpy(data + n_data, body + 4, n - 4);
            n_data += n - 4;
        }
        ended = is_end;
        at += n + 12;
    }
    need(at == n_file, "there is something behind its end");
    need(told == 0 || told == shown, "it has not as many frames as it says");
    n_frames = shown;
    free(data);
}

/* ---- GIF --------------------------------------------------------------------------------------------------------- */

static size_t at;

static uint32_t next(int n)
{
    uint32_t value = 0;
    need(at + (size_t)n <= n_file, "it ends too early");
    for (int i = 0; i < n; i++)
        value |= (uint32_t)file[at++] << 8 * i;
    return value;
}

/* Blocks of one stream, joined. */
static uint8_t *blocks(size_t *n)
{
    uint8_t *out = malloc(n_file);
    uint32_t some;
    for (*n = 0; (some = next(1)) > 0; *n += some) {
        need(at + some <= n_file, "it ends in a block");
        memcpy(out + *n, file + at, some);
        at += some;
    }
    return out;
}

/* Codes to n indices. Each string is the one before and a byte. */
static void decode(uint8_t *out, size_t n, const uint8_t *code, size_t n_code, unsigned bits)
{
    static uint16_t prefix[4096];
    static uint8_t last[4096];
    const unsigned clear = 1u << bits, end = clear + 1;
    unsigned size = bits + 1, known = clear + 2, before = 4096;
    size_t pos = 0, got = 0;
    for (;;) {
        unsigned now = 0;
        need(pos + size <= 8 * n_code, "its codes end too early");
        for (unsigned i = 0; i < size; i++, pos++)
            now |= (unsigned)(code[pos / 8] >> pos % 8 & 1) << i;
        if (now == end)
            break;
        if (now == clear) {
            size = bits + 1;
            known = clear + 2;
            before = 4096;
            continue;
        }
        need(now < known || (now == known && before < 4096), "a code that is not known yet");
        uint8_t text[4097];
        unsigned length = 0, from = now == known ? before : now;
        if (now == known)
            length++; /* its last byte is its first */
        for (; from > end; from = prefix[from])
            text[length++] = last[from];
        text[length++] = (uint8_t)from;
        text[0] = now == known ? (uint8_t)from : text[0];
        need(got + length <= n, "more pixels than the frame has");
        while (length > 0)
            out[got++] = text[--length];
        if (before < 4096 && known < 4096) {
            prefix[known] = (uint16_t)before;
            last[known++] = (uint8_t)from;
            size += known == 1u << size && size < 12;
        }
        before = now;
    }
    need(got == n && n_code - (pos + 7) / 8 == 0, "fewer pixels than the frame has, or more codes");
}

static void gif_frame(const uint8_t *palette)
{
    const uint32_t x = next(2), y = next(2), w = next(2), h = next(2);
    need(next(1) == 0, "a palette of a frame, or interlaced");
    need(w > 0 && h > 0 && x + w <= width && y + h <= height, "a frame is larger than the picture");
    const unsigned bits = next(1);
    size_t n;
    uint8_t *code = blocks(&n), *index = malloc((size_t)w * h);
    decode(index, (size_t)w * h, code, n, bits);
    changed += (unsigned long)w * h;
    for (uint32_t i = 0; i < w * h; i++)
        memcpy(seen + 3 * ((size_t)(y + i / w) * width + x + i % w), palette + 3 * index[i], 3);
    free(code);
    free(index);
    frame_done(n_frames++);
}

static void read_gif(void)
{
    at = 6;
    const uint32_t w = next(2), h = next(2), flags = next(1);
    int repeats = 0;
    begin(w, h);
    (void)next(2);
    need(flags == 0xf7, "no palette of 256 colours");
    const uint8_t *palette = file + at;
    at += 768;
    for (;;) {
        const uint32_t what = next(1);
        if (what == ';')
            break;
        if (what == ',') {
            gif_frame(palette);
            continue;
        }
        need(what == 0x21, "no such block");
        const uint32_t kind = next(1);
        size_t n;
        uint8_t *body = blocks(&n);
        if (kind == 0xf9) {
            need(n == 4 && body[0] == 4, "a frame does not stay");
            delay_ms += 10 * (body[1] + 256u * body[2]);
        } else if (kind == 0xff) {
            repeats = n == 14 && memcmp(body, "NETSCAPE2.0\1\0\0", 14) == 0;
        }
        free(body);
    }
    need(repeats && at == n_file,
         "it does not repeat for ever, or there is something behind its end");
}

int main(int argc, char **argv)
{
    FILE *f = argc >= 2 ? fopen(argv[1], "rb") : NULL;
    need(f != NULL, "no such file");
    file = malloc(1 << 24);
    n_file = fread(file, 1, 1 << 24, f);
    (void)fclose(f);
    all = argc > 2 && strcmp(argv[2], "all") == 0;
    wanted = all ? 0 : argc > 2 ? atol(argv[2]) : -1;
    box = argc == 4;
    for (int i = 0; i < 4 && argc == 7; i++)
        part[i] = atol(argv[3 + i]);
    need(n_file > 32, "it is empty");
    if (memcmp(file, "\x89PNG\r\n\x1a\n", 8) == 0)
        read_png();
    else if (memcmp(file, "GIF89a", 6) == 0)
        read_gif();
    else
        bad("neither PNG nor GIF89a");
    if (wanted < 0)
        printf("%u %u %u %u %lu\n", width, height, n_frames, delay_ms, changed);
    free(seen);
    free(file);
    return wanted >= (long)n_frames;
}
