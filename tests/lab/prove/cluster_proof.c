/* clusters.c and cluster_setup.c: what each cluster is asked. That the margins hold is facts.c's.
 *
 * SPDX-License-Identifier: MIT
 */
#include "prove.h"

#include "fast/cluster_setup.c"
#include "fast/clusters.c"

static struct zs_renderer renderer;
static struct zs_clusters kept;
static struct zs_mesh mesh;
static struct zs_instance instance;
static struct zs_cluster cluster;

static void any_cluster(void)
{
    for (int k = 0; k < 3; k++) {
        cluster.center[k] = (int16_t)any_i32(-32768, 32767);
        cluster.axis[k] = (int8_t)any_i32(-128, 127);
        mesh.center[k] = (int16_t)any_i32(-32768, 32767);
    }
    cluster.radius = (uint16_t)any_u32(0, 65535);
    cluster.height = (uint16_t)any_u32(0, 65535);
    cluster.cutoff = (int8_t)any_i32(-128, 127);
}

/* PROVE turned: clusters of any bytes, every shift 0 .. 20 and 31, the eye's parts up to 2^16, every margin, both signs
 * of cone: no product beyond 32 or 64 bits */
void turned(void)
{
    for (int32_t shift = 0; shift <= ZS_EYE_SHIFT_MAX + 1; shift++) {
        any_cluster();
        kept.eye_shift = (uint8_t)(shift > ZS_EYE_SHIFT_MAX ? 31 : shift);
        for (int k = 0; k < 3; k++)
            kept.eye[k] = any_i32(-(1 << 16), 1 << 16);
        kept.margin = any_u32(0, UINT32_MAX);
        kept.thin = any_u32(0, UINT32_MAX);
        kept.cone = -1;
        (void)turned_away(&kept, &mesh, &cluster);
        kept.cone = 1;
        (void)turned_away(&kept, &mesh, &cluster);
    }
}

/*@ assigns \result \from *k, *mesh, *c;
    ensures \result == 0 || \result == 1; */
static int turned_away(const struct zs_clusters *k, const struct zs_mesh *mesh, const struct zs_cluster *c);

/* PROVE spheres -eva-use-spec=zs_recip,turned_away: clusters of any bytes, up to six planes with normals up to 2^12 + 1
 * and constants up to 3.9 * 2^28: no sum beyond 32 bits */
void spheres(void)
{
    any_cluster();
    mesh.cluster = &cluster;
    instance.mesh = &mesh;
    renderer.xform.instance = &instance;
    struct zs_clusters *c = &renderer.clusters;
    c->n_planes = (uint8_t)any_u32(0, 6);
    c->n_whole = (uint8_t)any_u32(0, 6);
    c->cone = (int8_t)any_i32(-1, 1);
    c->sure = any_i32(0, 1 << 27);
    for (int k = 0; k < 6; k++) {
        c->at[k] = any_i32(-1046898278, 1046898278);
        for (int j = 0; j < 3; j++)
            c->plane[k][j] = (int16_t)any_i32(-4097, 4097);
    }
    (void)left_out(&renderer, 0);
}

/* PROVE in_steps: every scale by its leading zeros 16 .. 63, -20 .. 12 bits, lengths below 2^50 that come out below
 * 2^30: shifts and what is cut */
void in_steps(void)
{
    for (int32_t lz = 16; lz <= 63; lz++)
        for (int32_t bits = -20; bits <= 12; bits++) {
            const struct ruler by = { any_u32(1u << 31, UINT32_MAX), lz };
            const int64_t most = (int64_t)1 << zs_min32(50, 79 - lz - bits - 2);
            (void)steps(&by, any_i64(-most, most), bits);
        }
}
