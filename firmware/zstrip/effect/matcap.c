/* Sphere-mapped environment: the texture is looked up by the normal in the camera's axes.
 *
 * x and y of the normal, -1 .. 1, become the middles of the image's first and last texels, so that
 * no rounding wraps to the other side. Rotations are taken in q1_15, so that all products fit 32
 * bits: each of six elements is off by 2^-16, and two sums are rounded to 2^-16. x is off by at
 * most 2 (sqrt 3 + 1) 2^-16 = 2^-13.5, and the place in the image by half of that.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/fx.h"
#include "core/usual.h"
#include "shade/texture.h"
#include "zs_environment.h"
#include "zs_shader.h"

/* Return row . n, q1_15, nearest. row: q2_30, n: q1_15, both of length 1, or n of up to sqrt 3:
 * then the sum is below 2^31. */
static int32_t dot(const zs_q2_30 row[3], const int32_t n[3])
{
    int32_t sum = 1 << 14;
    for (int k = 0; k < 3; k++)
        sum += ((row[k] + (1 << 14)) >> 15) * n[k];
    return zs_max32(zs_min32(sum >> 15, 32767), -32767);
}

static void matcap_vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const struct zs_instance *const in = s->instance;
    const zs_q2_30 *const rot = zs_usual_rotation(in->pose.rot), *const axes = s->camera->rot;
    const uint32_t bits = in->mesh->uv_bits;
    const zs_q1_15 *const normal = in->mesh->normal[v];
    const int32_t n[3] = { normal[0], normal[1], normal[2] };
    int32_t world[3];
    for (int k = 0; k < 3; k++)
        world[k] = dot(rot + 3 * k, n);
    for (int k = 0; k < 2; k++) {
        const uint32_t log2 = k ? in->material->texture->log2_h : in->material->texture->log2_w;
        const int32_t at = dot(axes + 3 * k, world), one = 1 << bits;
        const int32_t half = (one - (one >> log2)) * (k ? -at : at); /* q15 halves, < 2^30 */
        out[k] = (uint16_t)(32768 + (one >> 1) + ((half + (1 << 15)) >> 16));
    }
}

static int matcap_check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_texture *const t = in->material->texture;
    const uint32_t bits = in->mesh->uv_bits;
    (void)config;
    const int err = zs_texture_error(t);
    if (err)
        return err;
    return in->mesh->normal && bits <= 15 && bits > zs_maxu32(t->log2_w, t->log2_h) ? ZS_OK
                                                                                    : ZS_ERR_MESH;
}

const struct zs_shader zs_shade_matcap = {
    .vertex = matcap_vertex, .start = zs_texture_start, .run = zs_texture_run,
    .check = matcap_check, .n_varyings = ZS_VARYINGS_TEXTURE, .opaque = ZS_TEXTURED
};
