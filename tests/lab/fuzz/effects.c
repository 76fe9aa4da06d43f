/* Effects for random scenes: see effects.h.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effects.h"

#include <stdlib.h>
#include <string.h>

#include "picture.h"
#include "world.h"

#define T EFFECT_TEXTURE
#define L EFFECT_LIT
#define SIX(family, prefix)                                                                                           \
    { &zs_##prefix##_raw, family "_raw", 0 }, { &zs_##prefix##_flat, family "_flat", 0 },                             \
        { &zs_##prefix##_smooth, family "_smooth", 0 }, { &zs_##prefix##_texture, family "_texture", T },             \
        { &zs_##prefix##_texture_flat, family "_texture_flat", T },                                                   \
    {                                                                                                                 \
        &zs_##prefix##_texture_smooth, family "_texture_smooth", T                                                    \
    }
#define THREE(name, needs)                                                                                            \
    { &zs_shade_##name, #name, needs }, { &zs_shade_##name##_flat, #name "_flat", needs },                            \
    {                                                                                                                 \
        &zs_shade_##name##_smooth, #name "_smooth", needs                                                             \
    }
#define ONE(name, needs)                                                                                              \
    {                                                                                                                 \
        &zs_shade_##name, #name, needs                                                                                \
    }

/* Shaders that are made of others, by effects_make. */
static struct zs_layered mix_lit, add_gloss, door_phong, mix_shadowed, mix_filtered;
static struct zs_filtered soft_gloss, soft_phong, soft_shadowed;
#define MADE(of, needs)                                                                                               \
    {                                                                                                                 \
        &of.shader, #of, needs                                                                                        \
    }

const struct kind_effect kind_effects[EFFECT_KINDS] = { ONE(lit_face, L),
                                                        ONE(lit, L),
                                                        ONE(phong, L),
                                                        ONE(phong_near, L),
                                                        ONE(texture_lit, T | L),
                                                        ONE(texture_tinted, T | L),
                                                        ONE(texture_gloss, T | L),
                                                        ONE(texture_gloss_tinted, T | L),
                                                        ONE(texture_phong, T | L),
                                                        SIX("blend", blend),
                                                        SIX("add", add),
                                                        SIX("stipple", stipple),
                                                        THREE(bilinear, T),
                                                        THREE(mipmap, T),
                                                        THREE(mipmap_bilinear, T),
                                                        THREE(cutout, T | EFFECT_BUFFER),
                                                        ONE(matcap, T),
                                                        ONE(shadowed_flat, EFFECT_SHADOWED),
                                                        ONE(shadowed_smooth, EFFECT_SHADOWED),
                                                        ONE(shadowed_lit, EFFECT_LAMP_MAP),
                                                        ONE(shadowed_texture, EFFECT_LAMP_MAP | T),
                                                        ONE(shadowed_phong, EFFECT_LAMP_MAP),
                                                        ONE(shadowed_texture_phong, EFFECT_LAMP_MAP | T),
                                                        MADE(mix_lit, L),
                                                        MADE(add_gloss, T | L),
                                                        MADE(door_phong, L),
                                                        MADE(mix_shadowed, EFFECT_LAMP_MAP),
                                                        MADE(mix_filtered, T | L),
                                                        MADE(soft_phong, T | L),
                                                        MADE(soft_shadowed, EFFECT_LAMP_MAP | T),
                                                        ONE(disc, 0),
                                                        ONE(shadow, EFFECT_PLAIN),
                                                        ONE(smooth_ordered, 0),
                                                        ONE(smooth_blue, 0),
                                                        ONE(plain, 0),
                                                        ONE(none, 0),
                                                        ONE(window, EFFECT_PLAIN) };

const struct kind_texel kind_alpha_texels[EFFECT_TEXELS] = { { &zs_texel_4444, "4444", 16, 0 },
                                                             { &zs_texel_pal8a, "pal8a", 8, 256 },
                                                             { &zs_texel_pal4a, "pal4a", 4, 16 } };

int effects_of(const struct zs_shader *shader)
{
    for (int k = 0; k < EFFECT_KINDS; k++)
        if (kind_effects[k].shader == shader)
            return k;
    return -1;
}

static struct zs_rgb any_rgb(struct prng *p)
{
    const struct zs_rgb rgb = { (uint8_t)prng_next(p), (uint8_t)prng_next(p), (uint8_t)prng_next(p) };
    return rgb;
}

static void any_unit(struct prng *p, zs_q2_30 out[3])
{
    const int32_t v[3] = { prng_range(p, -99, 99), prng_range(p, -99, 99), prng_range(p, 1, 99) };
    (void)zs_unit(out, v);
}

static int32_t within(struct prng *p, int64_t size)
{
    const int32_t most = (int32_t)(size > ZS_WORLD_MAX ? ZS_WORLD_MAX : size);
    return prng_range(p, -most, most);
}

static void lamps(struct effects *e, struct prng *p, int64_t size)
{
    for (int i = 0; i < ZS_LIGHTS_MAX; i++) {
        struct zs_lamp *l = &e->lamp[i];
        l->kind = (uint8_t)(one_in(p, 2) ? ZS_LAMP_DIRECTIONAL : prng_pick(p, 3));
        l->rgb = any_rgb(p);
        l->strength = one_in(p, 3) ? 0 : prng_pick(p, 4 * ZS_Q16_ONE + 1);
        any_unit(p, l->dir);
        for (int k = 0; k < 3; k++)
            l->pos[k] = within(p, 2 * size);
        l->range = one_in(p, 3) ? 0 : (uint32_t)(size > 1 << 29 ? 1 << 30 : 2 * size);
        l->half = one_in(p, 3) ? 0 : (uint32_t)(size > 1 << 30 ? 1 << 30 : size);
        l->outer = prng_range(p, -ZS_Q30_ONE, ZS_Q30_ONE / 2);
        l->inner = l->outer + ZS_Q30_ONE / 256 + prng_range(p, 0, ZS_Q30_ONE / 4);
    }
    e->lighting.lamp = e->lamp;
    e->lighting.n_lamps = one_in(p, 2) ? 1 : prng_pick(p, ZS_LIGHTS_MAX + 1);
    e->lighting.ambient = any_rgb(p);
    e->single = e->lighting;
    e->single.n_lamps = 1;
    if (zs_shine_set(&e->shine, 1 + prng_pick(p, 255)))
        abort();
}

static void lines(struct effects *e, struct prng *p)
{
    const uint32_t most = 1u << prng_pick(p, 9); /* of small numbers, and of some that there are not */
    for (uint32_t i = 0; i < EFFECT_LINES; i++)
        for (int k = 0; k < 2; k++)
            e->line[i][k] = (uint16_t)(one_in(p, 60) ? prng_next(p) : prng_pick(p, most + 3u));
    e->lines =
        (struct zs_lines){ ZS_LINES((const uint16_t(*)[2])e->line, 1 + prng_pick(p, one_in(p, 3) ? EFFECT_LINES : 8)),
                           .width = (uint8_t)(one_in(p, 8) ? prng_pick(p, 65) : prng_pick(p, 5)),
                           .on = (uint8_t)prng_pick(p, 6), .off = (uint8_t)prng_pick(p, 6) };
    e->points = (struct zs_points){ ZS_POINTS(one_in(p, 2) ? NULL : e->line[0],
                                              1 + prng_pick(p, one_in(p, 3) ? EFFECT_LINES : 8)),
                                    .size = (uint8_t)(one_in(p, 8) ? prng_pick(p, 65) : prng_pick(p, 5)) };
}

static void items(struct effects *e, struct prng *p)
{
    static const struct zs_item_kind *const kinds[] = { &zs_item_fill,   &zs_item_outline, &zs_item_line,
                                                        &zs_item_text,   &zs_item_bar,     &zs_item_arc,
                                                        &zs_item_needle, &zs_item_ticks };
    static const char *const texts[] = { "21 \302\260C", "A\nbc", "\xff~" };
    for (int k = 0; k < EFFECT_ITEMS; k++) {
        struct zs_item *i = &e->item[k];
        memset(i, 0, sizeof *i);
        i->kind = kinds[prng_pick(p, KINDS(kinds))];
        i->x = (int16_t)prng_range(p, -20, 100);
        i->y = (int16_t)prng_range(p, -20, 100);
        i->w = (int16_t)prng_range(p, 0, 60);
        i->h = (int16_t)prng_range(p, 0, 60);
        i->color = (uint16_t)prng_next(p);
        i->back = (uint16_t)prng_next(p);
        i->clear = (uint8_t)(one_in(p, 2) ? 0 : prng_next(p));
        i->back_clear = (uint8_t)prng_next(p);
        i->size = (uint8_t)prng_pick(p, 4);
        i->flags = (uint8_t)prng_pick(p, 8);
        i->value = (uint16_t)(i->kind == &zs_item_ticks ? prng_pick(p, 30) : prng_next(p));
        i->from = (zs_turn)prng_next(p);
        i->sweep = (zs_turn)prng_next(p);
        i->text = texts[prng_pick(p, KINDS(texts))];
    }
    e->overlay = (struct zs_overlay){
        .item = e->item, .n = 1 + prng_pick(p, EFFECT_ITEMS), .memory = e->memory, .room = EFFECT_ITEMS
    };
}

static void made(struct effects *e, struct prng *p)
{
    const uint8_t alpha = (uint8_t)prng_next(p);
    if (zs_filtered_set(&soft_gloss, &zs_shade_texture_gloss, &zs_filter_linear) ||
        zs_filtered_set(&soft_phong, &zs_shade_texture_phong, &zs_filter_levels) ||
        zs_filtered_set(&soft_shadowed, &zs_shade_shadowed_texture, &zs_filter_levels_linear) ||
        zs_layered_set(&mix_lit, &zs_shade_lit, &zs_layer_mix, alpha) ||
        zs_layered_set(&add_gloss, &zs_shade_texture_gloss, &zs_layer_add, alpha) ||
        zs_layered_set(&door_phong, &zs_shade_phong_near, &zs_layer_door, alpha) ||
        zs_layered_set(&mix_shadowed, &zs_shade_shadowed_phong, &zs_layer_mix, alpha) ||
        zs_layered_set(&mix_filtered, &soft_gloss.shader, &zs_layer_mix, alpha))
        abort();
    door_phong.phase = (uint8_t)prng_pick(p, 64);
    zs_layered_fog(prng_pick(p, 2) ? &mix_lit : &add_gloss, &e->fog);
}

void effects_make(struct effects *e, struct prng *p, int64_t size)
{
    memset(e, 0, sizeof *e);
    made(e, p);
    lamps(e, p, size);
    lines(e, p);
    items(e, p);
    struct zs_rgb sky[4];
    for (int k = 0; k < 4; k++)
        sky[k] = any_rgb(p);
    zs_sky_gradient(&e->sky, sky);
    e->fog.color = (uint16_t)prng_next(p);
    e->fog.curve = (uint8_t)prng_pick(p, 2);
    e->fog.sky = (uint8_t)prng_pick(p, 8);
    e->fog.start = within(p, size);
    e->fog.end = (int32_t)(e->fog.start + 1 + (size > 1 << 28 ? 1 << 28 : size));
    e->lift.bias = (int16_t)prng_range(p, -40, -1);
}

int effects_map(struct effects *e, struct prng *p, const struct zs_instance *in, uint32_t n, int64_t size)
{
    struct zs_instance *casters = malloc((n ? n : 1u) * sizeof *casters);
    const struct zs_depth_state bias = { .bias = 4, .slope_bias = 544 };
    const struct zs_scene scene = { .instance = casters,
                                    .n_instances = casters ? zs_shadow_casters(casters, in, n, &bias) : 0 };
    const int32_t reach = (int32_t)(size > ZS_WORLD_MAX / 8 ? ZS_WORLD_MAX / 8 : size) + 4, none[3] = { 0, 0, 0 };
    struct zs_camera light;
    memset(&light, 0, sizeof light);
    (void)zs_camera_orthographic(&light, 3 * reach, -3 * reach, 3 * reach);
    (void)zs_camera_orbit(&light, none, reach / 4 + 1, (zs_turn)prng_next(p), (int16_t)prng_range(p, 4000, 16000));
    struct zs_config c = picture_config(1 + (int32_t)prng_pick(p, EFFECT_MAP), 1 + (int32_t)prng_pick(p, EFFECT_MAP),
                                        &zs_depth_linear);
    c.max_tris = c.max_verts = 3000;
    c.fast = NULL;
    e->map = (struct zs_shadow_map){ .key = e->key, .w = c.width, .h = c.height, .soft = (uint8_t)prng_pick(p, 2) };
    uint16_t *first = malloc(2u * c.width * c.height);
    struct zs_renderer *r = malloc(sizeof *r);
    int err[2], same = 1;
    for (int way = 0; way < 2; way++) {
        void *arena = malloc(zs_arena_bytes(&c));
        if (!arena || !first || !r || !casters || zs_init(r, &c, arena, zs_arena_bytes(&c)))
            abort();
        err[way] = zs_shadow_map_draw(&e->map, r, &scene, &light);
        free(arena);
        if (way == 0 && !err[0])
            memcpy(first, e->key, 2u * c.width * c.height);
        c.strip_h = (uint16_t)(1 + prng_pick(p, c.height));
        c.max_tris = (uint16_t)(1 + prng_pick(p, 60));
        c.max_verts = (uint16_t)(3 + prng_pick(p, 90));
    }
    same = err[0] == err[1] && (err[0] || memcmp(first, e->key, 2u * c.width * c.height) == 0);
    free(first);
    free(r);
    free(casters);
    return same;
}

void effects_cover(struct effects *e, struct prng *p, union effect_material *m, const struct zs_texture *texture,
                   uint32_t without)
{
    const struct kind_effect *kind = &kind_effects[prng_pick(p, EFFECT_KINDS)];
    while (kind->needs & without)
        kind = &kind_effects[prng_pick(p, EFFECT_KINDS)];
    memset(m, 0, sizeof *m);
    m->material.shader = kind->shader;
    m->material.rgb = any_rgb(p);
    m->material.cull = (uint8_t)prng_pick(p, 3);
    m->material.texture = texture;
    if (kind->needs & EFFECT_LAMP_MAP)
        for (int i = 0; i < ZS_LIGHTS_MAX; i++)
            m->phong.map[i] = i == 0 || one_in(p, 2) ? &e->map : NULL;
    if (kind->needs & (EFFECT_LIT | EFFECT_LAMP_MAP)) {
        m->lit.lighting = kind->needs & EFFECT_LAMP_MAP ? &e->single : &e->lighting;
        if (kind->shader == &zs_shade_shadowed_phong || kind->shader == &zs_shade_shadowed_texture_phong ||
            kind->shader == &mix_shadowed.shader)
            m->lit.lighting = &e->lighting;
        m->lit.shine = one_in(p, 3) ? NULL : &e->shine;
        m->lit.specular = any_rgb(p);
        m->lit.emission = any_rgb(p);
        m->lit.flags = (uint8_t)prng_pick(p, 8);
        if (kind->shader == &zs_shade_phong) { /* directional lamps alone */
            m->lit.flags &= (uint8_t)~ZS_LIT_NEAR_VIEWER;
            for (uint32_t i = 0; i < ZS_LIGHTS_MAX; i++)
                e->lamp[i].kind = ZS_LAMP_DIRECTIONAL;
        }
    } else if (kind->needs & EFFECT_SHADOWED) {
        m->shadowed.map = &e->map;
    } else {
        m->blend.alpha = (uint8_t)(one_in(p, 6) ? prng_pick(p, 2) * 255u : prng_next(p));
        m->blend.phase = (uint8_t)prng_pick(p, 64);
    }
    if (kind->shader == &zs_shade_plain ? !one_in(p, 3) : one_in(p, 8))
        m->material.primitive = one_in(p, 2) ? &e->lines.primitive : &e->points.primitive;
}

int effects_hook(struct effects *e, struct prng *p, enum effect_hook kind, const struct zs_config *config,
                 const struct zs_camera *camera, struct zs_resolve *hook)
{
    static const struct zs_dither_format *const formats[] = { &zs_dither_rgb332, &zs_dither_grey4, &zs_dither_mono };
    const struct zs_resolve hooks[EFFECT_HOOKS] = {
        [EFFECT_FOG] = { .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = &e->fog },
        [EFFECT_DITHER] = { .draw = zs_dither_draw, .ctx = &e->dither },
        [EFFECT_OVERLAY] = { .draw = zs_overlay_draw, .changes = zs_overlay_changes, .ctx = &e->overlay }
    };
    e->dither.format = formats[prng_pick(p, KINDS(formats))];
    e->dither.pattern = prng_pick(p, 2) ? &zs_dither_ordered : &zs_dither_blue;
    if (kind == EFFECT_FOG && zs_fog_set(&e->fog, config, camera))
        return 0;
    *hook = hooks[kind];
    return 1;
}
