/* Texels: size, format, packing.
 *
 * SPDX-License-Identifier: MIT
 */
#include "texel_pack.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

#define GOOD_DB 36.0 /* a difference that one must look for */
#define PAL4_MAX 16u

void sim_packed_size(uint32_t size[2], const struct sim_texture *texture, const long most[2])
{
    size[0] = texture->image.width;
    size[1] = texture->image.height;
    for (int k = 0; k < 2; k++)
        while (size[k] > (uint32_t)most[k])
            size[k] /= 2;
}

/* The mean of what each new texel covers, as the file holds the values; malloc'ed. */
static uint8_t (*shrink(const struct sim_image *image, const uint32_t size[2]))[3]
{
    uint8_t(*out)[3] = sim_alloc((size_t)size[0] * size[1], sizeof *out);
    const uint32_t across = image->width / size[0], down = image->height / size[1],
                   n = across * down;
    for (uint32_t y = 0; y < size[1]; y++)
        for (uint32_t x = 0; x < size[0]; x++)
            for (int c = 0; c < 3; c++) {
                uint32_t sum = n / 2; /* 2^20 * 255 < 2^32 */
                for (uint32_t i = 0; i < n; i++)
                    sum += image->rgb[(size_t)(y * down + i / across) * image->width + x * across +
                                      i % across][c];
                out[(size_t)y * size[0] + x][c] = (uint8_t)(sum / n);
            }
    return out;
}

/* The same of its alpha, or NULL. */
static uint8_t *shrink_alpha(const struct sim_image *image, const uint32_t size[2])
{
    if (image->alpha == NULL)
        return NULL;
    uint8_t *out = sim_alloc((size_t)size[0] * size[1], 1);
    const uint32_t across = image->width / size[0], down = image->height / size[1], n = across * down;
    for (uint32_t y = 0; y < size[1]; y++)
        for (uint32_t x = 0; x < size[0]; x++) {
            uint32_t sum = n / 2;
            for (uint32_t i = 0; i < n; i++)
                sum += image->alpha[(size_t)(y * down + i / across) * image->width + x * across + i % across];
            out[(size_t)y * size[0] + x] = (uint8_t)(sum / n);
        }
    return out;
}

void sim_texture_halve(struct sim_texture *texture, const long most[2])
{
    uint32_t size[2];
    sim_packed_size(size, texture, most);
    const struct sim_image small = { size[0], size[1], shrink(&texture->image, size),
                                     shrink_alpha(&texture->image, size) };
    sim_image_free(&texture->image);
    texture->image = small;
}

static void make_565(struct sim_packed_texels *s, const struct sim_pixels *px, int dither)
{
    const size_t n = (size_t)px->w * px->h;
    s->format = SIM_TEXELS_565;
    s->texel = sim_alloc(n, sizeof *s->texel);
    s->texel_bytes = 2 * n;
    sim_rgb565_map(s->texel, px, dither);
    s->loss = sim_rgb565_loss(px, s->texel);
    s->exact = 1;
}

/* The left texel in the low four bits. */
static void pack(uint8_t *index, size_t n)
{
    for (size_t i = 0; i < n / 2; i++)
        index[i] = (uint8_t)(index[2 * i] | index[2 * i + 1] << 4);
}

static void make_palette(struct sim_packed_texels *s, const struct sim_pixels *px, enum sim_texels format,
                         uint32_t reserve, int dither)
{
    const size_t n = (size_t)px->w * px->h;
    uint16_t *shown = sim_alloc(n, sizeof *shown), *best = sim_alloc(n, sizeof *best);
    s->format = format;
    s->index = sim_alloc(n, 1);
    s->n_colors =
        sim_palette_build(s->palette, (format == SIM_TEXELS_PAL4 ? PAL4_MAX : SIM_PALETTE_MAX) - reserve, px);
    sim_palette_map(s->index, px, s->palette, s->n_colors, 0);
    sim_rgb565_map(best, px, 0);
    for (size_t i = 0; i < n; i++)
        shown[i] = s->palette[s->index[i]];
    s->exact = memcmp(shown, best, n * sizeof *shown) == 0;
    if (dither && !s->exact)
        sim_palette_map(s->index, px, s->palette, s->n_colors, 1);
    for (size_t i = 0; i < n; i++)
        shown[i] = s->palette[s->index[i]];
    s->loss = sim_rgb565_loss(px, shown);
    s->palette_bytes = 2 * s->n_colors;
    s->texel_bytes = format == SIM_TEXELS_PAL4 ? n / 2 : n;
    if (format == SIM_TEXELS_PAL4 && reserve == 0)
        pack(s->index, n);
    free(shown);
    free(best);
}

/* The smallest format that is good enough. */
static void choose(struct sim_packed_texels *s, const struct sim_pixels *px, int dither)
{
    static const enum sim_texels small[2] = { SIM_TEXELS_PAL4, SIM_TEXELS_PAL8 };
    for (int i = px->w < 2; i < 2; i++) {
        make_palette(s, px, small[i], 0, 0);
        const int good = s->exact || s->loss.psnr_db >= GOOD_DB;
        if (good && s->palette_bytes + s->texel_bytes <= 2 * (size_t)px->w * px->h) {
            if (dither && !s->exact) {
                free(s->index);
                make_palette(s, px, small[i], 0, 1);
            }
            return;
        }
        free(s->index);
        s->index = NULL;
        s->n_colors = 0;
        s->palette_bytes = 0;
    }
    make_565(s, px, dither);
}

/* ---- Alpha ----------------------------------------------------------------------------------- */

/* Texels of a mask: one entry more, which is not drawn. What it hides has no colour to keep. */
static void make_mask(struct sim_packed_texels *s, const struct sim_pixels *px, const uint8_t *alpha,
                      enum sim_texels format, int dither)
{
    const size_t n = (size_t)px->w * px->h;
    uint8_t(*rgb)[3] = sim_alloc(n, sizeof *rgb);
    size_t first = 0;
    while (first < n && alpha[first] < s->alpha_least)
        first++;
    for (size_t i = 0; i < n; i++)
        memcpy(rgb[i], px->rgb[alpha[i] >= s->alpha_least ? i : first < n ? first : 0], sizeof rgb[i]);
    const struct sim_pixels seen = { px->w, px->h, (const uint8_t(*)[3])rgb };
    make_palette(s, &seen, format, 1, dither);
    for (size_t i = 0; i < n; i++)
        s->index[i] = alpha[i] >= s->alpha_least ? s->index[i] : (uint8_t)s->n_colors;
    s->palette[s->n_colors] = s->palette[0];
    s->n_colors++;
    for (uint32_t i = 0; i < s->n_colors; i++)
        s->palette[s->n_colors + i] = i + 1 < s->n_colors ? 255 : 0;
    s->palette_bytes = 4 * (size_t)s->n_colors;
    if (format == SIM_TEXELS_PAL4)
        pack(s->index, n);
    s->format = format == SIM_TEXELS_PAL4 ? SIM_TEXELS_PAL4A : SIM_TEXELS_PAL8A;
    free(rgb);
}

static uint16_t four(uint8_t v)
{
    return (uint16_t)((v * 15u + 127u) / 255u);
}

static void make_4444(struct sim_packed_texels *s, const struct sim_pixels *px, const uint8_t *alpha)
{
    const size_t n = (size_t)px->w * px->h;
    uint16_t *shown = sim_alloc(n, sizeof *shown);
    s->format = SIM_TEXELS_4444;
    s->texel = sim_alloc(n, sizeof *s->texel);
    s->texel_bytes = 2 * n;
    for (size_t i = 0; i < n; i++) {
        const uint16_t c[3] = { four(px->rgb[i][0]), four(px->rgb[i][1]), four(px->rgb[i][2]) };
        s->texel[i] = (uint16_t)(c[0] << 12 | c[1] << 8 | c[2] << 4 | four(alpha[i]));
        shown[i] = zs_rgb565((uint8_t)(17 * c[0]), (uint8_t)(17 * c[1]), (uint8_t)(17 * c[2]));
    }
    s->loss = sim_rgb565_loss(px, shown);
    free(shown);
}

/* A mask has alphas of 0 and 255, which a palette holds; what blends has all. */
static void make_alpha(struct sim_packed_texels *s, const struct sim_pixels *px, const uint8_t *alpha, uint8_t mode,
                       const struct sim_convert_options *o)
{
    if (mode == SIM_ALPHA_BLEND || o->texels == SIM_TEXELS_565) {
        make_4444(s, px, alpha);
        return;
    }
    if (o->texels != SIM_TEXELS_PAL8 && px->w >= 2) {
        make_mask(s, px, alpha, SIM_TEXELS_PAL4, o->dither);
        if (o->texels == SIM_TEXELS_PAL4 || s->exact || s->loss.psnr_db >= GOOD_DB)
            return;
        free(s->index);
    }
    make_mask(s, px, alpha, SIM_TEXELS_PAL8, o->dither);
}

uint32_t sim_packed_palette(const struct sim_packed_texels *packed)
{
    return packed->n_colors * (packed->format == SIM_TEXELS_PAL8A || packed->format == SIM_TEXELS_PAL4A ? 2u : 1u);
}

/* ---- All of it ------------------------------------------------------------------------------- */

/* Append a coarser level: the mean of what its texels cover of the picture, by the nearest colours. */
static void add_level(struct sim_packed_texels *s, const struct sim_image *image, const uint32_t size[2], int dither)
{
    uint8_t(*rgb)[3] = shrink(image, size);
    const struct sim_pixels px = { size[0], size[1], (const uint8_t(*)[3])rgb };
    const size_t n = (size_t)px.w * px.h;
    if (s->texel != NULL) {
        s->texel = sim_grow(s->texel, s->texel_bytes / 2 + n, sizeof *s->texel);
        sim_rgb565_map(s->texel + s->texel_bytes / 2, &px, dither);
        s->texel_bytes += 2 * n;
    } else {
        s->index = sim_grow(s->index, s->texel_bytes + n, 1);
        sim_palette_map(s->index + s->texel_bytes, &px, s->palette, s->n_colors, dither);
        if (s->format == SIM_TEXELS_PAL4)
            pack(s->index + s->texel_bytes, n);
        s->texel_bytes += s->format == SIM_TEXELS_PAL4 ? n / 2 : n;
    }
    s->n_levels++;
    free(rgb);
}

static void add_levels(struct sim_packed_texels *s, const struct sim_image *image, int dither)
{
    const uint32_t least = s->format == SIM_TEXELS_PAL4 ? 2 : 1;
    for (uint32_t size[2] = { s->w / 2, s->h / 2 }; size[0] >= least && size[1] >= 1; size[0] /= 2, size[1] /= 2)
        add_level(s, image, size, dither && !s->exact);
}

int sim_packed_make(struct sim_packed_texels *out, const struct sim_texture *texture, const char *file,
                    const struct sim_convert_options *o)
{
    uint32_t size[2];
    memset(out, 0, sizeof *out);
    sim_packed_size(size, texture, o->texture_size);
    if (o->texels == SIM_TEXELS_PAL4 && size[0] < 2)
        return sim_refuse(
            file, 0, "pal4 stores two texels in a byte and the texture is one wide; take pal8");
    uint8_t(*rgb)[3] = shrink(&texture->image, size);
    const struct sim_pixels px = { size[0], size[1], (const uint8_t(*)[3])rgb };
    out->w = size[0];
    out->h = size[1];
    out->clamp = texture->clamp;
    sim_progress("texture", 0, 1);
    const uint8_t mode = o->opaque || o->no_alpha ? SIM_ALPHA_OPAQUE : texture->alpha_mode;
    uint8_t *alpha = mode != SIM_ALPHA_OPAQUE ? shrink_alpha(&texture->image, size) : NULL;
    out->alpha_least = mode == SIM_ALPHA_MASK ? texture->alpha_least : 0;
    if (alpha != NULL)
        make_alpha(out, &px, alpha, mode, o);
    else if (o->texels == SIM_TEXELS_AUTO)
        choose(out, &px, o->dither);
    else if (o->texels == SIM_TEXELS_565)
        make_565(out, &px, o->dither);
    else
        make_palette(out, &px, (enum sim_texels)o->texels, 0, o->dither);
    free(rgb);
    free(alpha);
    out->n_levels = 1;
    if (o->mipmap && mode == SIM_ALPHA_OPAQUE)
        add_levels(out, &texture->image, o->dither);
    return SIM_OK;
}

void sim_packed_free(struct sim_packed_texels *packed)
{
    SIM_FREE(packed->texel, packed->index);
    memset(packed, 0, sizeof *packed);
}
