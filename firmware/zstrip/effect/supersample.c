/* Supersampling: strips of samples are averaged, in place, before they are sent.
 *
 * A pixel of the panel is written where samples have been read already: pixel (x, y) lies at y w +
 * x in the buffer, w the panel's width, and no sample before 4 y w + 2 x is read after it. So the
 * buffer of the strip is enough.
 *
 * The arithmetic of a pixel. A word holds two samples, each as it lies in memory, most significant
 * byte first. If the word is rotated by half, the samples change places. FIELDS picks from a word
 * the bits of a sample that would be repeated in both halves, so that no channel is cut in two and
 * 5 or 6 bits are free above each: here from the lower half's sample some bits, from the upper
 * half's the others. Of word and rotated word together, all bits of both samples are picked, once.
 * The sum of four samples has two bits more in each channel; there is room for them.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "zs_damage.h"
#include "zs_supersample.h"

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define FIELDS 0x07e0f81fu /* green | red, blue */
#define HALF (2u << 21 | 2u << 11 | 2u)
#else
#define FIELDS 0x1f07e0f8u /* bytes swapped: blue, green | green, red */
#define HALF (2u << 24 | 2u << 13 | 2u << 3)
#endif

/* Load two samples from an address that is a multiple of 4. Their order does not matter. */
static inline uint32_t two(const uint16_t *at)
{
#if defined(__GNUC__)
    return *(const zs_pair *)(const void *)at;
#else
    return at[0] | (uint32_t)at[1] << 16;
#endif
}

static inline uint32_t picked(uint32_t w)
{
    return (w & FIELDS) + ((w >> 16 | w << 16) & FIELDS);
}

/* Average n pixels: out[n], from the rows above[2 n] and below[2 n]. */
static void average_row(uint16_t *out, const uint16_t *above, const uint16_t *below, uint32_t n)
{
    for (uint16_t *const end = out + n; out != end; out++, above += 2, below += 2) {
        const uint32_t sum = picked(two(above)) + picked(two(below)) + HALF; /* a field < 2^8 */
        const uint32_t mean = sum >> 2 & FIELDS;
        *out = (uint16_t)(mean | mean >> 16);
    }
}

void zs_supersample_strip(const struct zs_supersample *s, struct zs_strip *strip)
{
    const uint16_t *const window = s->renderer->window; /* drawn columns; even (zs_damage.h) */
    /* the renderer's own buffer, which it gives out as const */
    uint16_t *const px = (uint16_t *)(uintptr_t)(const void *)strip->px;
    const uint32_t samples = strip->w, w = samples / 2u, rows = strip->h / 2u;
    const uint32_t x0 = window[0] / 2u, x1 = window[1] / 2u;
    const uint32_t first = strip->dirty_x / 2u,
                   end = (strip->dirty_x + (uint32_t)strip->dirty_w + 1u) / 2u;
    const struct zs_target target = {
        .color = px, .y0 = (uint16_t)(strip->y / 2u), .y1 = (uint16_t)(strip->y / 2u + rows),
        .x0 = (uint16_t)x0, .x1 = (uint16_t)x1, .pitch = w
    };
    if (strip->dirty_w) {
        for (uint32_t y = 0; y < rows; y++) {
            const uint16_t *const above = px + (2u * y * samples + 2u * x0);
            average_row(px + (y * w + x0), above, above + samples, x1 - x0);
        }
        for (uint32_t k = 0; s->resolve && k < s->n_resolves; k++)
            s->resolve[k].draw(s->resolve[k].ctx, &target);
        strip->dirty_x = (uint16_t)first;
        strip->dirty_w = (uint16_t)(end - first);
    }
    strip->y = target.y0;
    strip->w = (uint16_t)w;
    strip->h = (uint16_t)rows;
    strip->n_bytes = w * rows * 2u;
    strip->depth = 0;
}

static int submit(void *ctx, const struct zs_strip *strip)
{
    const struct zs_supersample *s = ctx;
    struct zs_strip pixels = *strip;
    zs_supersample_strip(s, &pixels);
    return s->inner->submit(s->inner->ctx, &pixels);
}

static int wait(void *ctx)
{
    const struct zs_sink *inner = ((const struct zs_supersample *)ctx)->inner;
    return inner->wait ? inner->wait(inner->ctx) : 0;
}

static int end(void *ctx)
{
    const struct zs_sink *inner = ((const struct zs_supersample *)ctx)->inner;
    return inner->end ? inner->end(inner->ctx) : 0;
}

int zs_supersample_init(struct zs_supersample *s, struct zs_renderer *r,
                        const struct zs_sink *inner)
{
    if (!s || !r || !inner || !inner->submit)
        return ZS_ERR_NULL;
    if (r->ready != 1)
        return ZS_ERR_SEQUENCE;
    if ((r->config.width | r->config.height | r->config.strip_h) & 1)
        return ZS_ERR_SIZE;
    s->sink.submit = submit;
    s->sink.wait = wait;
    s->sink.end = end;
    s->sink.ctx = s;
    s->resolve = 0;
    s->n_resolves = 0;
    s->renderer = r;
    s->inner = inner;
    return ZS_OK;
}

int zs_supersample_invalidate(const struct zs_supersample *s, const struct zs_rect *rect)
{
    if (!s)
        return ZS_ERR_NULL;
    if (!rect)
        return zs_invalidate(s->renderer, 0);
    const uint32_t most = 65535u /
                          2u; /* of a frame of at most ZS_SIZE_MAX: beyond it all the same */
    const struct zs_rect samples = { (uint16_t)(2u * zs_minu32(rect->x, most)),
                                     (uint16_t)(2u * zs_minu32(rect->y, most)),
                                     (uint16_t)(2u * zs_minu32(rect->w, most)),
                                     (uint16_t)(2u * zs_minu32(rect->h, most)) };
    return zs_invalidate(s->renderer, &samples);
}
