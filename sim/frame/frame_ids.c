/* Which triangle is seen at each pixel: the scene drawn with the triangles' numbers as colours, 16 bits at a time.
 *
 * SPDX-License-Identifier: MIT
 */
#include "frame.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zs_shader.h"

/* Instances of copies of their meshes, painted with 16 bits of the numbers. */
struct painted {
    struct zs_instance *instance;
    struct zs_mesh *mesh;
    struct zs_material *material;
    uint16_t *raw; /* of all triangles */
};

static uint64_t count_tris(const struct zs_scene *scene)
{
    uint64_t n = 0;
    for (uint32_t i = 0; i < scene->n_instances; i++)
        n += scene->instance[i].mesh->n_tris;
    return n;
}

static void paint(struct painted *p, const struct zs_scene *scene, uint64_t n_tris, int shift)
{
    size_t at = 0;
    for (uint64_t t = 0; t < n_tris; t++)
        p->raw[t] = (uint16_t)((t + 1u) >> shift);
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        p->instance[i] = scene->instance[i];
        p->mesh[i] = *scene->instance[i].mesh;
        p->material[i] = *scene->instance[i].material;
        p->mesh[i].face_raw = p->raw + at;
        p->material[i].shader = &zs_shade_raw;
        p->instance[i].mesh = &p->mesh[i];
        p->instance[i].material = &p->material[i];
        at += p->mesh[i].n_tris;
    }
}

int sim_frame_ids(uint32_t *id, const struct zs_scene *scene, const struct zs_camera *camera,
                  const struct zs_config *config)
{
    const uint64_t n_tris = count_tris(scene);
    const uint32_t n = scene->n_instances;
    struct painted p = { sim_alloc(n, sizeof *p.instance), sim_alloc(n, sizeof *p.mesh),
                         sim_alloc(n, sizeof *p.material), sim_alloc(n_tris, sizeof *p.raw) };
    struct zs_scene raw = *scene;
    raw.instance = p.instance;
    raw.background = 0;
    const size_t pixels = (size_t)config->width * config->height;
    memset(id, 0, pixels * sizeof *id);
    int err = ZS_OK;
    for (int shift = 0; err == ZS_OK && n_tris >> shift > 0 && shift < 32; shift += 16) {
        struct sim_frame frame;
        paint(&p, scene, n_tris, shift);
        err = sim_frame_render(&frame, &raw, camera, config, "numbering");
        for (size_t i = 0; err == ZS_OK && i < pixels; i++)
            if (frame.key[i] != ZS_DEPTH_CLEAR)
                id[i] |= (uint32_t)frame.rgb565[i] << shift;
        sim_frame_free(&frame);
    }
    SIM_FREE(p.instance, p.mesh, p.material, p.raw);
    return err;
}
