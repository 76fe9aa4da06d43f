/* Groups of instances that are out of view, found in the order of the scene.
 *
 * A group that is left out must change nothing: not a pixel, and not the camera units, which are chosen from the instances
 * that zs_cull_sphere lets pass. So whatever that culls is what may be left out. Let S be what the group's sphere is enlarged
 * by, s an instance's slack there, e and f the errors of the two distances from a plane, and all lengths true but those two:
 * the instance's sphere lies in the group's, so that its distance is at most the group's + R - r. From group < -(R + S)
 * follows instance < -r - S + e + f. With the sizes of the way's three parts, added, + R or + origins no less than the
 * instance's reach (zs_bounds), s is at most reach / 2^16 + 1, and e + f below reach / 2^18 + 4, as world units are not split
 * here. reach / 2^15 + 8 holds all of it.
 *
 * In the walk vertices may be 8 camera units beside where they should be; group_slack is no less than that. It does not
 * differ between zs_frame_begin and the walks, so that the walks meet no instance that was not checked.
 *
 * Groups may be any bytes: what they leave out may be wrong, but nothing beyond the scene's instances is read.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/pipeline.h"


static int beside(const int32_t side[2], int64_t lateral, int64_t z, int64_t radius)
{
    return ((z * side[1] - zs_size64(lateral) * side[0]) >> 30) < -radius; /* < 2^63 */
}

/* A way in world units along an axis of the camera. */
static int64_t along(const zs_q2_30 axis[3], const int32_t way[3])
{
    return (zs_mul_ss(axis[0], way[0]) + zs_mul_ss(axis[1], way[1]) + zs_mul_ss(axis[2], way[2])) >> 30; /* < 2^33 */
}

/* Axis by axis, since most groups are before near, or beside one side. */
static int out_of_view(const struct zs_renderer *r, const struct zs_group *g)
{
    const struct zs_camera *camera = &r->camera;
    const struct zs_view *view = &r->view;
    int32_t way[3];
    int64_t reach = zs_maxu32(g->radius, g->origins); /* world units; < 2^34 */
    for (int k = 0; k < 3; k++) {
        way[k] = (int32_t)((uint32_t)g->center[k] - (uint32_t)camera->pos[k]);
        reach += zs_size32(way[k]);
    }
    const int64_t radius = g->radius + (reach >> 15) + 8 + r->group_slack; /* < 2^33 */
    const int64_t z = -along(camera->rot + 6, way);
    if ((z + radius) * 65536 < camera->z_near || (z - radius) * 65536 > camera->z_far)
        return 1;
    const int64_t x = along(camera->rot, way);
    if (view->perspective)
        return beside(view->side[0], x, z, radius) || beside(view->side[1], along(camera->rot + 3, way), z, radius);
    return (zs_size64(x) - radius) * 65536 > zs_cull_half_width(camera, view) ||
           (zs_size64(along(camera->rot + 3, way)) - radius) * 65536 > camera->height / 2 + 1;
}

static uint32_t group_next(struct zs_renderer *r, const struct zs_scene *scene, uint32_t number)
{
    const struct zs_groups *groups = scene->groups;
    uint32_t at = r->group;
    for (; at < groups->n_groups; at++) {
        const struct zs_group *g = &groups->group[at];
        if (g->first < number || g->n == 0) /* of no use */
            continue;
        if (g->first > number)
            break;
        if (out_of_view(r, g)) {
            number += g->n;
            at = zs_maxu32(at + 1u, g->next) - 1u;
        }
    }
    r->group = (uint16_t)zs_minu32(at, UINT16_MAX);
    return number;
}

const struct zs_group_kernel zs_group_kernel = { group_next };

