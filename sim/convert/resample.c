/* Resampling: separable, by area. A new texel j of m out of n old ones covers [j n/m, (j + 1) n/m);
 * an old one counts with the part of it that lies in there. That is one rule for both directions,
 * keeps the mean, and copies where n = m.
 *
 * SPDX-License-Identifier: MIT
 */
#include "resample.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

uint8_t sim_texture_log2(uint32_t side)
{
    uint8_t log2 = 0;
    while (side >> 1 >> log2)
        log2++;
    return log2;
}

/* The power of two that a side becomes. */
static uint32_t nearest_power(uint32_t n)
{
    const double log2_n = rint(log2((double)n));
    return log2_n >= ZS_TEXTURE_LOG2_MAX ? SIM_TEXTURE_MAX : 1u << (unsigned)log2_n;
}

/* One line of n values, `step` apart, to m values: the mean of what each covers. */
static void resample_line(const float *in, size_t n, size_t in_step, float *out, size_t m,
                          size_t out_step)
{
    const double span = (double)n / (double)m;
    for (size_t j = 0; j < m; j++) {
        const double from = (double)j * span, to = (double)(j + 1) * span;
        double sum = 0.0;
        for (size_t i = (size_t)from; i < n && (double)i < to; i++)
            sum += (double)in[i * in_step] *
                   (fmin(to, (double)(i + 1)) - fmax(from, (double)i));
        out[j * out_step] = (float)(sum / span);
    }
}

/* One channel of the image, or 3, its alpha, 0 .. 255, to w x h values; malloc'ed. */
static float *resample(const struct sim_image *image, int channel, uint32_t w, uint32_t h)
{
    const size_t old_w = image->width, old_h = image->height;
    float *line = sim_alloc(old_w, sizeof *line), *half = sim_alloc(w * old_h, sizeof *half);
    float *out = sim_alloc((size_t)w * h, sizeof *out);
    for (size_t y = 0; y < old_h; y++) {
        for (size_t x = 0; x < old_w; x++)
            line[x] = (float)(channel < 3 ? image->rgb[y * old_w + x][channel]
                                          : image->alpha[y * old_w + x]);
        resample_line(line, old_w, 1, half + y * w, w, 1);
    }
    for (size_t x = 0; x < w; x++)
        resample_line(half + x, old_h, w, out + x, h, w);
    free(line);
    free(half);
    return out;
}

void sim_texture_make(struct sim_texture *out, struct sim_image *image, const char *name,
                      const double factor[3])
{
    const uint32_t w = nearest_power(image->width), h = nearest_power(image->height);
    const size_t n = (size_t)w * h;
    memset(out, 0, sizeof *out);
    out->name = strcpy(sim_alloc(strlen(name) + 1, 1), name);
    out->file_width = image->width;
    out->file_height = image->height;
    out->image = (struct sim_image){ w, h, sim_alloc(n, sizeof *out->image.rgb),
                                     image->alpha != NULL ? sim_alloc(n, 1) : NULL };
    for (int c = 0; c < 3; c++) {
        float *value = resample(image, c, w, h);
        for (size_t i = 0; i < n; i++)
            out->image.rgb[i][c] =
                (uint8_t)(fmin(255.0, (double)value[i] * (factor != NULL ? factor[c] : 1.0)) + 0.5);
        free(value);
    }
    if (image->alpha != NULL) {
        float *value = resample(image, 3, w, h);
        for (size_t i = 0; i < n; i++)
            out->image.alpha[i] = (uint8_t)((double)value[i] + 0.5);
        free(value);
    }
    sim_image_free(image);
}

void sim_texture_free(struct sim_texture *texture)
{
    free(texture->name);
    sim_image_free(&texture->image);
    memset(texture, 0, sizeof *texture);
}

uint16_t *sim_texture_565(const struct sim_texture *texture)
{
    const struct sim_image *image = &texture->image;
    const size_t n = (size_t)image->width * image->height;
    uint16_t *code = sim_alloc(n, sizeof *code);
    for (size_t i = 0; i < n; i++)
        code[i] = zs_rgb565(image->rgb[i][0], image->rgb[i][1], image->rgb[i][2]);
    return code;
}
