/* What a frame took.
 *
 * SPDX-License-Identifier: MIT
 */
#include "stats.h"

#include <math.h>

void sim_json_begin(struct sim_json *json, FILE *f)
{
    json->file = f;
    json->n = 0;
    (void)fputs("{", f);
}

void sim_json_number(struct sim_json *json, const char *key, double value)
{
    (void)fprintf(json->file, "%s\n  \"%s\": ", json->n++ > 0 ? "," : "", key);
    if (isfinite(value))
        (void)fprintf(json->file, "%.17g", value);
    else
        (void)fputs("null", json->file);
}

void sim_json_vector(struct sim_json *json, const char *key, const double v[3])
{
    char name[64];
    for (int k = 0; k < 3; k++) {
        (void)snprintf(name, sizeof name, "%s_%c", key, "xyz"[k]);
        sim_json_number(json, name, v[k]);
    }
}

void sim_json_end(struct sim_json *json)
{
    (void)fputs("\n}\n", json->file);
}

static double mean(uint32_t n, uint32_t of)
{
    return of > 0 ? (double)n / (double)of : 0.0;
}

static void counts(struct sim_json *json, const struct zs_stats *s, uint32_t visible)
{
    const struct {
        const char *key;
        uint32_t value;
    } all[] = {
        { "instances_in", s->instances_in },
        { "instances_culled", s->instances_culled },
        { "triangles_in", s->tris_in },
        { "triangles_drawn", s->tris_drawn },
        { "triangles_clipped", s->tris_clipped },
        { "rejected_frustum", s->tris_frustum },
        { "rejected_near", s->tris_near },
        { "rejected_far", s->tris_far },
        { "rejected_offscreen", s->tris_offscreen },
        { "rejected_facing", s->tris_facing },
        { "rejected_zero_area", s->tris_zero },
        { "rejected_empty", s->tris_empty },
        { "rejected_index", s->tris_index },
        { "vertices_transformed", s->verts_transformed },
        { "triangle_setups", s->tris_setup },
        { "instances_hidden", s->instances_hidden },
        { "triangles_hidden", s->tris_hidden },
        { "pixels_tested", s->pixels_tested },
        { "pixels_untested", s->pixels_untested },
        { "pixels_written", s->pixels_written },
        { "pixels_visible", visible },
        { "strips", s->strips },
        { "passes", s->passes },
        { "sorted", s->sorted },
        { "splits", s->splits },
        { "rays", s->rays },
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        sim_json_number(json, all[i].key, (double)all[i].value);
    sim_json_number(json, "depth_complexity", mean(s->pixels_tested, visible));
    sim_json_number(json, "overdraw", mean(s->pixels_written, visible));
}

void sim_stats_frame(struct sim_json *json, const struct sim_frame *frame,
                     const struct zs_config *config)
{
    const struct zs_stats *s = &frame->stats;
    const uint16_t rows = config->strip_h < config->height ? config->strip_h : config->height;
    const uint32_t color = ZS_COLOR_BYTES(config->width, rows, config->buffers);
    const uint32_t depth = frame->no_depth ? 0 : ZS_DEPTH_BYTES(config->width, rows);
    const uint32_t bins = ZS_BIN_BYTES(config->height, rows);
    const struct {
        const char *name;
        uint32_t given, used;
    } pool[] = {
        { "color", color, color },
        { "depth", depth, depth },
        { "bins", bins, bins },
        { "tris", ZS_TRI_BYTES(config->max_tris), ZS_TRI_BYTES(s->max_tris_used) },
        { "verts", ZS_VERT_BYTES(config->max_verts, config->varyings),
          ZS_VERT_BYTES(s->max_verts_used, config->varyings) },
    };
    char key[32];
    uint32_t used = 0;
    counts(json, s, sim_frame_visible(frame));
    sim_json_number(json, "tris_given", config->max_tris);
    sim_json_number(json, "tris_used", (double)s->max_tris_used);
    sim_json_number(json, "verts_given", config->max_verts);
    sim_json_number(json, "verts_used", (double)s->max_verts_used);
    for (size_t i = 0; i < sizeof pool / sizeof pool[0]; i++) {
        (void)snprintf(key, sizeof key, "%s_bytes_given", pool[i].name);
        sim_json_number(json, key, (double)pool[i].given);
        (void)snprintf(key, sizeof key, "%s_bytes_used", pool[i].name);
        sim_json_number(json, key, (double)pool[i].used);
        used += pool[i].used;
    }
    sim_json_number(json, "depth_bytes", (double)depth);
    sim_json_number(json, "arena_bytes", (double)frame->arena_bytes);
    sim_json_number(json, "arena_bytes_used", (double)used);
}
