/* The scene that a budget is for: a demo scene or a model, drawn here and counted; or numbers alone.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "budget.h"
#include "demo_frame.h"
#include "frame.h"
#include "line_style.h"
#include "losses.h"
#include "model.h"
#include "render.h"
#include "core/frame.h"
#include "core/fx.h"
#include "core/job.h"
#include "core/view.h"
#include "core/xform.h"
#include "zs_filter.h"
#include "zs_method.h"
#include "zs_shader.h"
#include "core/cull.h"
#include "scene_parts.h"
#include "shader_table.h"
#include "record_sizes.h"
#include "scenes.h"
#include "sim.h"
#include "framing.h"

/* ---- What a request is where nothing is said ----------------------------------------------------- */

void budget_defaults(struct budget_request *rq)
{
    memset(rq, 0, sizeof *rq);
    sim_options_defaults(&rq->o);
    rq->coverage = 50.0;
    rq->complexity = 1.5;
    rq->instances = 1;
    rq->orbit = (struct sim_orbit)SIM_ORBIT_HOME;
    rq->core = SIM_CORE_M3;
    rq->bar = 15.0;
    rq->ram = 16384;
    rq->color_bits = rq->bits_of_depth = rq->access_bits = 32;
    rq->samples = 1;
    rq->fragments = 4.0;
}

/* ---- What is linked, and its data --------------------------------------------------------------- */

static uint32_t shade_bit(const struct zs_shader *s)
{
    const struct zs_shader *const order[] = { &zs_shade_raw,     &zs_shade_flat,         &zs_shade_smooth,
                                              &zs_shade_texture, &zs_shade_texture_flat, &zs_shade_texture_smooth };
    uint32_t bit = 0;
    for (uint32_t i = 0; i < sizeof order / sizeof order[0]; i++)
        bit |= order[i] == s ? 1u << i : 0u;
    return bit;
}

static uint32_t texel_bit(const struct zs_texel *t)
{
    return t == &zs_texel_565 || t == &zs_texel_4444   ? 1u
           : t == &zs_texel_pal8 || t == &zs_texel_pal8a ? 2u
                                                         : 4u;
}

static uint32_t texture_bytes(const struct zs_texture *t)
{
    const uint32_t texels = 1u << (t->log2_w + t->log2_h);
    return RECORD_zs_texture + (t->format == &zs_texel_565 ? 2u * texels : t->format == &zs_texel_pal8 ? texels :
                                texels / 2u) +
           (t->palette ? 2u * t->n_colors : 0u);
}

/* Every array that there is. */
static uint32_t mesh_bytes(const struct zs_mesh *m)
{
    const uint32_t v = 6u + (m->pos_lo ? 3u : 0u) + (m->normal ? 6u : 0u) + (m->vertex_rgb ? 3u : 0u) +
                       (m->uv ? 4u : 0u);
    const uint32_t t = 6u + (m->face_normal ? 6u : 0u) + (m->face_rgb ? 3u : 0u) + (m->face_raw ? 2u : 0u);
    return RECORD_zs_mesh + v * m->n_verts + t * m->n_tris + (uint32_t)sizeof(struct zs_cluster) * m->n_clusters;
}

/* Each mesh and texture of a pass once, unless passes before have it. */
static void add_data(struct budget *b, const struct zs_pass *passes, uint32_t pass)
{
    const struct zs_scene *scene = passes[pass].scene;
    for (uint32_t i = 0; i < scene->n_instances; i++) {
        const struct zs_instance *in = &scene->instance[i];
        const struct zs_texture *t = in->material->texture;
        int mesh = 1, material = 1, texture = t != NULL;
        for (uint32_t p = 0; p <= pass; p++)
            for (uint32_t k = 0; k < (p < pass ? passes[p].scene->n_instances : i); k++) {
                const struct zs_instance *before = &passes[p].scene->instance[k];
                mesh &= before->mesh != in->mesh;
                material &= before->material != in->material;
                texture &= before->material->texture != t;
            }
        b->data += mesh ? mesh_bytes(in->mesh) : 0u;
        b->data += (material ? RECORD_zs_material : 0u) + (texture ? texture_bytes(t) : 0u);
        const struct zs_shader *plain = sim_costs_plain(in->material->shader);
        b->shades |= shade_bit(plain != NULL ? plain : in->material->shader);
        b->states |= in->depth_state != NULL;
        if (t != NULL)
            b->texels |= texel_bit(t->format);
    }
}

/* ---- Frames ------------------------------------------------------------------------------------- */

static uint32_t next_size(uint32_t verts)
{
    const uint32_t n = verts + verts / 16u + 1u;
    return n < ZS_POOL_MAX ? n : ZS_POOL_MAX;
}

/* The least pools of the method that was asked for, or of the one that sorts what is transparent. */
static void hold_method(struct zs_config *c, const struct sim_method *method)
{
    if (c->method == &zs_method_transparent) {
        c->max_tris = c->max_tris < 2 ? 2 : c->max_tris;
        c->max_verts = c->max_verts < 6 ? 6 : c->max_verts;
    } else {
        sim_method_apply(c, method);
    }
}

static int draw_passes(void *ctx, struct zs_renderer *r, const struct zs_sink *sink)
{
    const struct sim_drawn_scene *d = ctx;
    struct zs_pass_memory memory[SIM_COUNT_PASSES];
    return d->passes == 1 ? zs_render(r, d->pass[0].scene, d->pass[0].camera, sink)
                          : zs_render_passes(r, d->pass, memory, d->passes, sink);
}

/* Pools that take the scene in one walk, where none were asked for; then counts. */
static int count_scene(struct budget *b, const struct budget_request *rq, const char *name,
                       struct sim_drawn_scene *d)
{
    struct zs_config *c = &b->config;
    const char *why = NULL;
    int err = ZS_OK;
    for (int tries = 0; !err && !(rq->has_tris && rq->has_verts) && tries < 64; tries++) {
        struct sim_frame frame;
        const struct sim_drawing drawing = { draw_passes, d, c->width, c->height, sim_frame_no_keys(c) };
        err = sim_frame_render_by(&frame, &drawing, c, NULL, NULL);
        if (err)
            break;
        const uint32_t tris = frame.stats.max_tris_used, verts = frame.stats.max_verts_used;
        const uint32_t passes = frame.stats.passes;
        sim_frame_free(&frame);
        if (tries > 0 && (passes == 1u || rq->has_tris || rq->has_verts))
            break;
        if (!rq->has_tris && tries == 0)
            c->max_tris = sim_method_pool(&sim_methods[rq->o.method], tris);
        if (!rq->has_verts)
            c->max_verts = (uint16_t)(tries == 0 ? (verts < 3u ? 3u : verts)
                                                 : next_size(c->max_verts));
        hold_method(c, &sim_methods[rq->o.method]);
    }
    err = err ? err : sim_costs_count_passes(&b->counted, d->pass, d->passes, c);
    if (err)
        why = err == SIM_FRAME_BROKEN ? "its frame could not be counted" : zs_error_string(err);
    for (uint32_t k = 0; k < d->passes; k++) {
        b->n_instances += d->pass[k].scene->n_instances;
        add_data(b, d->pass, k);
    }
    return why ? sim_refuse(name, 0, "%s", why) : SIM_OK;
}

static void set_config(struct budget *b, const struct budget_request *rq, uint16_t width, uint16_t height,
                       uint8_t attrs,
                       const struct zs_depth *depth)
{
    struct zs_config *c = &b->config;
    sim_frame_config(c, width, height, attrs);
    c->strip_h = (uint16_t)(rq->o.strip < height ? rq->o.strip : height);
    c->buffers = (uint8_t)rq->o.buffers;
    c->depth = depth;
    if (rq->has_tris)
        c->max_tris = (uint16_t)rq->o.tris;
    if (rq->has_verts)
        c->max_verts = (uint16_t)rq->o.verts;
    sim_method_apply(c, &sim_methods[rq->o.method]);
}

static const struct zs_depth *mapping(const struct budget_request *rq)
{
    return rq->o.depth == SIM_DEPTH_recip ? &zs_depth_recip : rq->o.depth == SIM_DEPTH_linear ? &zs_depth_linear :
        &zs_depth_float;
}

static int refuse_scene(const char *name)
{
    char names[512] = "";
    for (uint32_t i = 0; i < n_demos; i++)
        (void)snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", demos[i]->name);
    return sim_refuse(NULL, 0, "--scene %s: there is no such scene; there are %s", name, names);
}

/* Is there a shader of effect/? */
static int has_effects(const struct zs_scene *scene)
{
    for (uint32_t i = 0; i < scene->n_instances; i++)
        if (shade_bit(scene->instance[i].material->shader) == 0)
            return 1;
    return 0;
}

static int of_demo(struct budget *b, const struct budget_request *rq)
{
    const struct demo *d = sim_demo_named(rq->scene);
    if (d == NULL)
        return refuse_scene(rq->scene);
    const int own = !rq->o.has_size && rq->o.panel.name == NULL;
    const uint16_t w = own ? d->width : (uint16_t)rq->o.size[0], h = own ? d->height : (uint16_t)rq->o.size[1];
    struct demo_frame *f = sim_alloc(1, sizeof *f);
    set_config(b, rq, w, h, (uint8_t)d->varyings, d->depth);
    sim_demo_pose(f, d, (uint32_t)rq->frame, w, h, &rq->orbit);
    sim_demo_method(&b->config, d, rq->o.method);
    struct zs_pass whole = { .scene = &f->scene, .camera = &f->camera };
    const struct piece *piece = sim_demo_piece(d);
    struct sim_drawn_scene drawn = { .pass = piece != NULL && piece->n_passes > 0 ? piece->pass : &whole,
                                     .passes = piece != NULL && piece->n_passes > 0 ? piece->n_passes : 1u };
    const int status = count_scene(b, rq, d->name, &drawn);
    for (const struct zs_fast *const *fast = d->fast; *fast != NULL; fast++)
        b->clusters |= *fast == &zs_fast_clusters;
    for (uint32_t k = 0; k < drawn.passes; k++)
        b->effects |= has_effects(drawn.pass[k].scene);
    free(f);
    return status;
}

struct counting {
    struct budget *b;
    const struct budget_request *rq;
};

/* A model's frame, as it is drawn, effects and all. Of four samples a pixel pools, strips and bytes are those of the
 * frame of twice the size each way that the renderer draws. */
static int count_drawn(void *ctx, const struct sim_drawn_scene *d)
{
    const struct counting *of = ctx;
    struct budget *b = of->b;
    struct zs_config *c = &b->config;
    set_config(b, of->rq, d->config.width, d->config.height, d->config.varyings, d->config.depth);
    if (d->samples > 1) {
        b->samples = (uint32_t)d->samples;
        c->strip_h = d->config.strip_h;
    }
    if (d->config.method == &zs_method_transparent)
        c->method = d->config.method;
    struct sim_drawn_scene drawn = *d;
    const int status = count_scene(b, of->rq, of->rq->o.model, &drawn);
    if (d->samples > 1)
        sim_effects_add_samples(&b->counted, (double)c->width * c->height / (double)d->samples);
    b->data = (uint32_t)d->data_bytes;
    b->clusters = 1;
    b->effects = has_effects(d->scene);
    if (status == SIM_OK && b->effects && !of->rq->quiet)
        (void)fprintf(stderr,
                      "%s: %s: the code of materials with transparency, highlights or emission is not in the flash; "
                      "%s\n",
                      sim_program, of->rq->o.model, "it is 1 to 8 KB");
    return status;
}

/* Its bytes are those of its materials. Lines and points count as the faces that they are in place of. */
int budget_model(struct budget *b, const struct budget_request *rq, const struct sim_model *model)
{
    struct counting counting = { b, rq };
    struct sim_options o = rq->o;
    struct sim_kept_scene own = { 0 };
    memset(b, 0, sizeof *b);
    b->method = &sim_methods[rq->o.method];
    o.style = SIM_STYLE_SOLID;
    const int status = sim_render_scene(rq->kept != NULL ? rq->kept : &own, model, &o, count_drawn, &counting);
    sim_kept_free(&own);
    return status;
}

static int of_model(struct budget *b, const struct budget_request *rq)
{
    struct budget_request with = *rq;
    struct sim_model model = { 0 };
    int status = sim_scene_load(&model, &with.o);
    if (status == SIM_OK)
        status = budget_model(b, &with, &model);
    if (status == SIM_OK && !rq->quiet) {
        char lead[4200];
        (void)snprintf(lead, sizeof lead, "%s: %s: ", sim_program, with.o.model);
        sim_lost_materials_print(stderr, lead, model.lost_materials);
    }
    sim_model_free(&model);
    return status;
}

/* ---- Numbers
 * ------------------------------------------------------------------------------------------------------------ */

static enum sim_shade shade_of(const struct budget_request *rq)
{
    return rq->o.shade == SIM_SHADE_DEFAULT ? SIM_SHADE_FLAT : rq->o.shade;
}

/* Counts of a scene of which only numbers are known: triangles of one size all over what is covered, half as high again
 * as wide at worst, in no order; most of them as near to affine as such triangles are. */
static void guess(struct budget *b, const struct budget_request *rq)
{
    const struct zs_config *c = &b->config;
    const enum sim_shade shade = shade_of(rq);
    const int solid = shade == SIM_SHADE_ID || shade == SIM_SHADE_FLAT, smooth = shade == SIM_SHADE_SMOOTH;
    const int linear = c->depth == &zs_depth_linear;
    const double tris = c->max_tris, all = (double)rq->scene_tris, verts = (double)rq->scene_verts;
    const double covered = rq->coverage / 100.0 * c->width * c->height, tested = covered * rq->complexity;
    /* each of n wins by odds of 1/n */
    const double won = covered * (1.0 + 0.9 * log(rq->complexity < 1.0 ? 1.0 : rq->complexity));
    const double area = tested / tris, high = 1.1 * sqrt(2.0 * area), rows = tris * high;
    const double spans = rows * (area < 4.0 ? 0.35 + 0.65 * area / 4.0 : 1.0);
    const double setups = tris * (1.0 + high / c->strip_h), in_sight = verts * (tris / all + 0.1 > 1.0 ? 1.0 :
                                                                                tris / all + 0.1);
    const enum sim_cost texel = rq->o.texel == SIM_TEXEL_565 ? SIM_COST_fetch_565_px
                                : rq->o.texel == SIM_TEXEL_PAL8 ? SIM_COST_fetch_pal8_px : SIM_COST_fetch_pal4_px;
    const enum sim_cost direct = rq->o.texel == SIM_TEXEL_565 ? SIM_COST_won_565
                                 : rq->o.texel == SIM_TEXEL_PAL8 ? SIM_COST_won_pal8 : SIM_COST_won_pal4;
    /* three edges, half of them not steep; taken up again after every 16 rows and in every strip, both of the sides */
    const double again = (high > 16.0 ? rows / 16.0 : 0.0) + setups - tris;
    const double edges = 3.0 * tris + 2.0 * again, divided = 1.5 * tris + 2.0 * again;
    double *n = b->counted.n;
    n[SIM_COST_frame] = 1;
    n[SIM_COST_strip] = ZS_STRIPS(c->height, c->strip_h);
    n[SIM_COST_clear_px] = n[SIM_COST_strip] * c->width * c->strip_h;
    n[SIM_COST_instance] = (double)b->n_instances;
    n[linear ? SIM_COST_vertex_linear : c->depth == &zs_depth_recip ? SIM_COST_vertex_recip : SIM_COST_vertex] = verts;
    n[SIM_COST_tri] = all;
    n[SIM_COST_tri_box] = n[SIM_COST_tri_bin] = tris;
    if (shade == SIM_SHADE_FLAT || shade == SIM_SHADE_TEXTURED_FLAT)
        n[SIM_COST_face_flat_given] = tris;
    if (!solid)
        n[smooth ? SIM_COST_light_smooth : shade == SIM_SHADE_TEXTURED ? SIM_COST_light_texture :
          SIM_COST_attr_texture] = in_sight;
    /* keys of recip do not say that texels are affine */
    if (!smooth && !linear && (solid || c->depth != &zs_depth_recip) && high <= 64.0) {
        const int lit = shade == SIM_SHADE_TEXTURED ||
                        (shade == SIM_SHADE_TEXTURED_FLAT && rq->o.texel != SIM_TEXEL_PAL4);
        n[solid ? SIM_COST_setup_small : SIM_COST_setup_small_texel] = n[SIM_COST_tilt_small] = setups;
        n[SIM_COST_edge_small_div] = divided;
        n[solid ? SIM_COST_row_small : SIM_COST_row_small_texel] = rows;
        n[solid ? SIM_COST_span_small : SIM_COST_span_small_texel] = spans;
        n[solid ? SIM_COST_px_small : SIM_COST_px_small_texel] = tested;
        n[solid ? SIM_COST_won_small : direct] = won;
        n[SIM_COST_setup_small_lit] = lit ? setups : 0.0;
        n[SIM_COST_span_small_lit] = lit ? spans : 0.0;
        n[SIM_COST_won_small_lit] = lit ? won : 0.0;
        return;
    }
    const int wide = high > 64.0, huge = high > 128.0;
    const double planes = smooth ? 3.0 : solid ? 0.0 : shade == SIM_SHADE_TEXTURED ? 3.0 : 2.0;
    n[SIM_COST_setup] = setups;
    n[SIM_COST_setup_wide] = wide ? setups : 0.0;
    n[SIM_COST_tilt] = huge ? 0.0 : setups;
    n[SIM_COST_plane_mid] = wide && !huge ? planes * setups : 0.0;
    n[SIM_COST_plane_wide] = huge ? (1.0 + planes) * setups : 0.0;
    n[SIM_COST_row] = rows;
    n[SIM_COST_edge] = edges;
    n[huge ? SIM_COST_edge_div64 : SIM_COST_edge_div] = divided;
    if (smooth)
        n[SIM_COST_start_smooth] = setups;
    else if (!solid)
        n[SIM_COST_start_texture] = setups;
    if (shade == SIM_SHADE_TEXTURED)
        n[SIM_COST_start_light] = setups;
    if (solid && !linear) {
        n[SIM_COST_span_solid] = spans;
        n[SIM_COST_px_solid] = tested;
        n[SIM_COST_won_solid] = won;
    } else if (smooth && !linear) {
        n[SIM_COST_span_smooth] = spans;
        n[SIM_COST_px_smooth] = tested;
        n[SIM_COST_won_smooth] = won;
    } else if (shade == SIM_SHADE_UNLIT && !linear) {
        n[SIM_COST_span_direct] = spans;
        n[SIM_COST_px_direct] = tested;
        n[direct] = won;
    } else {
        const double runs = spans * won / tested;
        n[linear ? SIM_COST_span_linear : SIM_COST_span_runs] = spans;
        n[linear ? SIM_COST_px_linear : SIM_COST_px_runs] = tested;
        n[SIM_COST_setup_linear] = linear ? setups : 0.0;
        n[SIM_COST_won_runs] = won;
        n[SIM_COST_run] = runs;
        n[smooth ? SIM_COST_run_smooth_px : solid ? SIM_COST_run_solid_px : texel] = won;
        if (!solid && !smooth)
            n[SIM_COST_fetch] = runs;
        if (shade == SIM_SHADE_TEXTURED || shade == SIM_SHADE_TEXTURED_FLAT) {
            n[SIM_COST_shine] = runs;
            n[SIM_COST_shine_px] = won;
        }
    }
}

static int of_numbers(struct budget *b, const struct budget_request *rq)
{
    static const struct {
        uint8_t attrs, bit;
    } of[] = { [SIM_SHADE_ID] = { ZS_VARYINGS_FLAT, 1 },
               [SIM_SHADE_FLAT] = { ZS_VARYINGS_FLAT, 2 },
               [SIM_SHADE_SMOOTH] = { ZS_VARYINGS_SMOOTH, 4 },
               [SIM_SHADE_TEXTURED] = { ZS_VARYINGS_TEXTURE_SMOOTH, 32 },
               [SIM_SHADE_TEXTURED_FLAT] = { ZS_VARYINGS_TEXTURE, 16 },
               [SIM_SHADE_UNLIT] = { ZS_VARYINGS_TEXTURE, 8 } };
    const enum sim_shade shade = shade_of(rq);
    const uint32_t v = 6u + (sim_options_smooth(&rq->o) ? 6u : 0u) + (sim_options_textured(&rq->o) ? 4u : 0u);
    const uint32_t t = 6u + (shade == SIM_SHADE_FLAT || shade == SIM_SHADE_TEXTURED_FLAT ? 6u : 0u);
    set_config(b, rq, (uint16_t)rq->o.size[0], (uint16_t)rq->o.size[1], of[shade].attrs, mapping(rq));
    b->shades = of[shade].bit;
    if (sim_options_textured(&rq->o))
        b->texels = rq->o.texel == SIM_TEXEL_565 ? 1u : rq->o.texel == SIM_TEXEL_PAL8 ? 2u : 4u;
    b->n_instances = (uint32_t)rq->instances;
    b->data =
        (uint32_t)rq->scene_verts * v + (uint32_t)rq->scene_tris * t +
        b->n_instances * (RECORD_zs_mesh + RECORD_zs_material);
    b->guessed = 1;
    guess(b, rq);
    return SIM_OK;
}

void budget_frame(struct budget *b, const struct budget_request *rq, const struct zs_config *config,
                  const struct zs_stats *stats)
{
    memset(b, 0, sizeof *b);
    b->method = &sim_methods[rq->o.method];
    b->config = *config;
    if (!rq->has_tris)
        b->config.max_tris = (uint16_t)(stats->max_tris_used < 1 ? 1 : stats->max_tris_used);
    if (!rq->has_verts)
        b->config.max_verts = (uint16_t)(stats->max_verts_used < 3 ? 3 : stats->max_verts_used);
    b->n_instances = stats->instances_in;
    sim_effects_unknown(&b->counted, "a frame that was not counted");
}

int budget_scene(struct budget *b, const struct budget_request *rq)
{
    memset(b, 0, sizeof *b);
    b->method = &sim_methods[rq->o.method];
    return rq->scene ? of_demo(b, rq) : rq->o.model ? of_model(b, rq) : of_numbers(b, rq);
}
