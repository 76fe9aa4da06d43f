/* Instances from front to back, where that changes no pixel: what is nearer comes first, so that what lies behind it loses
 * its pixels before they are coloured, or is found hidden whole.
 *
 * On equal keys the earlier instance wins, and triangles are drawn with a strict comparison in the order of the walk. So an
 * instance may go before an earlier one only where no key of the one can equal a key of the other: where its farthest key is less
 * than the other's nearest. Keys of an instance lie between those of the nearest and the farthest point of its sphere, by
 * more than what drawn keys are off by (MARGIN, hidden.c). Two whose ranges touch stay as they are in the scene.
 *
 * Instances are collected by the walk, up to ZS_ORDER_MAX, and put in order where one of them has a mesh of ZS_ORDER_DENSE
 * triangles or more: for less it does not pay. What has a state is drawn where it stands, after all that come before it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/pipeline.h"
#include "core/rotation.h"


#ifndef ZS_ORDER_DENSE
#define ZS_ORDER_DENSE 200u /* triangles; tests take less. Order takes 200 instructions an instance, 300 more if any is moved */
#endif

/* Camera units between which an instance lies, as zs_cull_walk has it, but for one axis alone. */
static void extent(int32_t z[2], const struct zs_renderer *r, uint32_t number)
{
    const struct zs_instance *in = &r->scene->instance[number];
    const struct zs_mesh *mesh = in->mesh;
    const struct zs_camera *camera = &r->camera;
    const zs_q2_30 *const away = &camera->rot[6];
    const uint64_t scale = (uint64_t)mesh->scale * in->pose.scale; /* q32_32, <= 2^47 */
    int32_t from[3], center[3];
    uint64_t far = 0, out = 0;
    zs_q2_30 axis[3];
    for (int k = 0; k < 3; k++) {
        from[k] = in->pose.pos[k] - camera->pos[k];
        center[k] = mesh->center[k];
        far += (uint32_t)zs_abs32(from[k]);
        out += (uint32_t)zs_abs32(center[k]);
        const int32_t column[3] = { in->pose.rot[k], in->pose.rot[3 + k], in->pose.rot[6 + k] };
        axis[k] = (zs_q2_30)zs_round_shift(zs_dot(away, column), 30);
    }
    const int64_t at = zs_round_shift(zs_dot(away, from), 14) + zs_mulshift_s64(zs_dot(axis, center), scale, 46); /* q48_16 */
    const uint64_t size = (((uint64_t)mesh->radius + 1u) * scale >> 16) + 1u;
    const uint64_t reach = (far << 16) + ((out + 1u) * scale >> 16) + size; /* at least zs_bounds.reach */
    const int64_t beyond = (int64_t)(size + (reach >> 16) + 16u) + ((8 << 19) >> (zs_min32(r->view.shift, 28) + 3)) + 1;
    z[0] = zs_view_length(&r->view, -at - beyond) - 1;
    z[1] = zs_view_length(&r->view, -at + beyond) + 1;
    if (z[1] < r->view.z_near || z[0] > r->view.z_far)
        z[0] = z[1] = INT32_MAX; /* not drawn: behind all others */
}

/* A key of what is z away, and what drawn keys may be nearer or farther by. */
static uint16_t key_at(const struct zs_renderer *r, int32_t z, int32_t sign)
{
    const struct zs_point p = { { 0, 0, zs_min32(zs_max32(z, r->view.z_near), r->view.z_far) } };
    struct zs_vertex at;
    (void)zs_xform_project(r, &p, &at);
    return (uint16_t)zs_hidden_key(r, at.d, sign);
}

static int pays(const struct zs_renderer *r, uint32_t number)
{
    return r->scene->instance[number].mesh->n_tris >= ZS_ORDER_DENSE;
}

/* Is there one behind one that comes later, and one of the two pays? */
static int worth_it(const struct zs_renderer *r, int32_t z[][2])
{
    for (uint32_t i = 0; i < r->n_turns; i++)
        for (uint32_t k = i + 1u; k < r->n_turns; k++)
            if (z[k][1] < z[i][0] && z[i][0] < INT32_MAX && (pays(r, r->turn[i]) || pays(r, r->turn[k])))
                return 1;
    return 0;
}

void zs_order_sort(struct zs_renderer *r)
{
    uint16_t *const turn = r->turn, near[ZS_ORDER_MAX]; /* nearest keys, in the order of turn */
    int32_t z[ZS_ORDER_MAX][2];
    uint32_t dense = 0;
    for (uint32_t i = 0; i < r->n_turns; i++)
        dense += (uint32_t)pays(r, turn[i]);
    if (dense == 0)
        return;
    for (uint32_t i = 0; i < r->n_turns; i++)
        extent(z[i], r, turn[i]);
    if (!worth_it(r, z))
        return;
    for (uint32_t i = 0; i < r->n_turns; i++) {
        const uint16_t number = turn[i], nearest = key_at(r, z[i][0], -1), farthest = key_at(r, z[i][1], 1);
        uint32_t k = i;
        for (; k > 0 && farthest < near[k - 1u]; k--) {
            turn[k] = turn[k - 1u];
            near[k] = near[k - 1u];
        }
        turn[k] = number;
        near[k] = nearest;
        r->stats.instances_earlier += r->counting && k < i;
    }
}

