/* Textures that a file repeats mirrored.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "mirrored.h"
#include "sim.h"

unsigned sim_mirror_leaves(const struct sim_model *model, uint32_t material, unsigned axes)
{
    unsigned out = 0;
    for (uint32_t t = 0; axes != 0 && t < model->n_tris; t++)
        for (int i = 0; model->tri_material[t] == material && model->has_uv[t] && i < 6; i++) {
            const double at = model->uv[t][i / 2][i % 2];
            out |= at < 0.0 || at > 1.0 ? 1u << i % 2 : 0u;
        }
    return out & axes;
}

int sim_mirror_picture(struct sim_image *image, unsigned axes, const char *name)
{
    const uint32_t w = image->width, h = image->height;
    const uint32_t w2 = axes & SIM_AXIS_U ? 2 * w : w, h2 = axes & SIM_AXIS_V ? 2 * h : h;
    const size_t n = (size_t)w2 * h2;
    if (axes == 0)
        return SIM_OK;
    if (w2 > SIM_IMAGE_MAX || h2 > SIM_IMAGE_MAX || n > 1u << 27)
        return sim_refuse(name, 0, "is repeated mirrored, and %u x %u px are too many to be doubled; make the picture "
                                   "smaller, or give --wrap repeat or --wrap clamp", w, h);
    uint8_t(*rgb)[3] = sim_alloc(n, sizeof *rgb);
    uint8_t *alpha = image->alpha != NULL ? sim_alloc(n, 1) : NULL;
    for (size_t to = 0; to < n; to++) {
        const size_t x = to % w2, y = to / w2;
        const size_t from = (y < h ? y : 2 * h - 1 - y) * w + (x < w ? x : 2 * w - 1 - x);
        memcpy(rgb[to], image->rgb[from], 3);
        if (alpha != NULL)
            alpha[to] = image->alpha[from];
    }
    sim_image_free(image);
    *image = (struct sim_image){ w2, h2, rgb, alpha };
    return SIM_OK;
}

void sim_mirror_uv(struct sim_model *model, uint32_t material, unsigned axes)
{
    for (uint32_t t = 0; t < model->n_tris; t++)
        for (int i = 0; model->tri_material[t] == material && i < 6; i++)
            model->uv[t][i / 2][i % 2] *= axes >> i % 2 & 1 ? 0.5 : 1.0;
}
