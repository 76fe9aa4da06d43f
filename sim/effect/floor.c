/* The floor's mesh and where it lies.
 *
 * SPDX-License-Identifier: MIT
 */
#include "floor.h"

#include <math.h>
#include <string.h>

#include "vec.h"

#define STEPS 16000 /* half of its side */
#define DROP 0.02   /* below the model's lowest point, of the model's radius */
#define WIDE 1.8    /* half of its side, of the model's radius */

static void build(struct sim_floor *f)
{
    const int n = SIM_FLOOR_CELLS, row = n + 1;
    static const struct zs_rgb light = ZS_RGB(0xd8d4c8), dark = ZS_RGB(0x8c8880);
    for (int k = 0; k < row * row; k++) {
        f->pos[k][0] = (int16_t)((2 * (k % row) - n) * STEPS / n);
        f->pos[k][1] = 0;
        f->pos[k][2] = (int16_t)((2 * (k / row) - n) * STEPS / n);
        f->normal[k][1] = 32767;
    }
    for (int k = 0; k < n * n; k++) {
        const uint16_t a = (uint16_t)(k / n * row + k % n), c = (uint16_t)(a + row);
        const uint16_t t[2][3] = { { a, c, (uint16_t)(c + 1) }, { a, (uint16_t)(c + 1), (uint16_t)(a + 1) } };
        memcpy(f->tri[2 * k], t, sizeof t);
        for (int i = 2 * k; i < 2 * k + 2; i++) {
            f->face_normal[i][1] = 32767;
            f->face_rgb[i] = (k % n + k / n) & 1 ? dark : light;
        }
    }
}

void sim_floor_lay(struct sim_floor *f, const struct sim_model *model, const struct sim_scene *scene,
                   const double up[3])
{
    double right[3], front[3], lowest = INFINITY;
    const double length = sqrt(sim_dot(up, up));
    memset(f, 0, sizeof *f);
    for (int k = 0; k < 3; k++)
        f->up[k] = up[k] / length;
    for (uint32_t i = 0; i < model->n_points; i++)
        lowest = fmin(lowest, sim_dot(model->point[i], f->up));
    const double down = sim_dot(model->center, f->up) - lowest + DROP * model->radius;
    for (int k = 0; k < 3; k++)
        f->point[k] = model->center[k] - down * f->up[k];
    f->half = WIDE * model->radius;

    const double other[3] = { fabs(f->up[0]) > 0.9 ? 0.0 : 1.0, fabs(f->up[0]) > 0.9 ? 1.0 : 0.0, 0.0 };
    sim_cross(front, other, f->up);
    const double size = sqrt(sim_dot(front, front));
    for (int k = 0; k < 3; k++)
        front[k] /= size;
    sim_cross(right, f->up, front);
    for (int k = 0; k < 3; k++) {
        const double axis[3] = { right[k], f->up[k], front[k] };
        for (int j = 0; j < 3; j++)
            f->instance.pose.rot[3 * k + j] = (zs_q2_30)lrint(axis[j] * 1073741823.0);
        f->instance.pose.pos[k] = (int32_t)lrint((f->point[k] - scene->origin[k]) / scene->unit);
    }
    build(f);
    f->mesh = (struct zs_mesh){
        .pos = (const int16_t(*)[3])f->pos, .tri = (const uint16_t(*)[3])f->tri,
        .normal = (const zs_q1_15(*)[3])f->normal, .face_normal = (const zs_q1_15(*)[3])f->face_normal,
        .face_rgb = f->face_rgb, .n_verts = sizeof f->pos / sizeof f->pos[0],
        .n_tris = sizeof f->tri / sizeof f->tri[0], .radius = 22628,
        .scale = (zs_uq16_16)lrint(f->half / scene->unit / STEPS * 65536.0)
    };
    f->material = (struct zs_material){ .shader = &zs_shade_flat };
    f->instance.mesh = &f->mesh;
    f->instance.material = &f->material;
}

void sim_floor_half(struct sim_floor_cells *half, const struct sim_floor *floor, int dark)
{
    const int n = SIM_FLOOR_CELLS;
    uint32_t to = 0;
    for (int k = 0; k < n * n; k++)
        for (int i = 2 * k; i < 2 * k + 2 && ((k % n + k / n) & 1) == dark; i++, to++) {
            memcpy(half->tri[to], floor->tri[i], sizeof half->tri[to]);
            memcpy(half->face_normal[to], floor->face_normal[i], sizeof half->face_normal[to]);
            half->face_rgb[to] = floor->face_rgb[i];
        }
    half->mesh = floor->mesh;
    half->mesh.tri = (const uint16_t(*)[3])half->tri;
    half->mesh.face_normal = (const zs_q1_15(*)[3])half->face_normal;
    half->mesh.face_rgb = half->face_rgb;
    half->mesh.n_tris = to;
    half->instance = floor->instance;
    half->instance.mesh = &half->mesh;
}
