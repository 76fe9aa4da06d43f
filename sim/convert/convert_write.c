/* C text: objects and files (convert_arrays.c: arrays; convert_figures.c: what is said of them). The same numbers make
 * the same bytes: nothing of the machine, the day or the folder is in them.
 *
 * Initialisers name the fields that they set, in the order of the members, so that C11 and C++20 take them alike.
 *
 * SPDX-License-Identifier: MIT
 */
#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "convert.h"
#include "convert_text.h"
#include "image.h"
#include "sim.h"
#include "zs_lights.h"
#include "zs_method.h"

static void upper(char out[64], const char *name)
{
    size_t i = 0;
    for (; name[i] != '\0' && i < 63; i++)
        out[i] = (char)toupper((unsigned char)name[i]);
    out[i] = '\0';
}

/* ---- Objects --------------------------------------------------------------------------------- */

static const char *shader_name(const struct sim_paint *p)
{
    static const char *const names[3][SIM_SHADER_TEXTURE_SMOOTH + 1] = {
        [SIM_ALPHA_OPAQUE] = { "zs_shade_raw", "zs_shade_flat", "zs_shade_smooth", "zs_shade_texture",
                               "zs_shade_texture_flat", "zs_shade_texture_smooth" },
        [SIM_ALPHA_MASK] = { "", "", "", "zs_shade_cutout", "zs_shade_cutout_flat", "zs_shade_cutout_smooth" },
        [SIM_ALPHA_BLEND] = { "zs_blend_raw", "zs_blend_flat", "zs_blend_smooth", "zs_blend_texture",
                              "zs_blend_texture_flat", "zs_blend_texture_smooth" },
    };
    if (p->lit)
        return p->shader == SIM_SHADER_TEXTURE_SMOOTH ? "zs_shade_texture_gloss"
               : p->shader == SIM_SHADER_SMOOTH       ? "zs_shade_lit"
                                                      : "zs_shade_lit_face";
    return names[p->alpha_mode][p->shader];
}

static const struct {
    const char *type, *array, *define;
} forms[] = { [SIM_FORM_MATERIAL] = { "zs_material", "material", "MATERIALS" },
              [SIM_FORM_BLEND] = { "zs_blend", "blend", "BLENDS" },
              [SIM_FORM_LIT] = { "zs_lit_material", "lit", "LITS" } };
#define N_FORMS (sizeof forms / sizeof forms[0])

/* Paints of a form before one. */
static uint32_t count_paints(const struct sim_pieces *p, enum sim_form form, uint32_t before)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < before; i++)
        n += sim_paint_form(&p->paint[i]) == form;
    return n;
}

static uint32_t all_paints(const struct sim_pieces *p, enum sim_form form)
{
    return count_paints(p, form, p->n_paints);
}

/* Does a texture have alpha? */
static int has_alpha(const struct sim_conversion *c)
{
    int yes = 0;
    for (uint32_t i = 0; i < c->made.n_packed; i++)
        yes |= c->made.packed[i].format >= SIM_TEXELS_4444;
    return yes;
}

/* Highlights or emission on a texture? */
static int has_gloss(const struct sim_paint *p)
{
    return p->lit && p->shader == SIM_SHADER_TEXTURE_SMOOTH;
}

static int needs_four(const struct sim_pieces *p)
{
    for (uint32_t i = 0; i < p->n_paints; i++)
        if (has_gloss(&p->paint[i]))
            return 1;
    return 0;
}

static const char *attrs_name(const struct sim_pieces *p)
{
    int textured = 0, smooth = 0, both = 0;
    for (uint32_t i = 0; i < p->n_paints; i++) {
        const enum sim_shader s = p->paint[i].shader;
        both |= s == SIM_SHADER_TEXTURE_SMOOTH;
        smooth |= s == SIM_SHADER_SMOOTH;
        textured |= s == SIM_SHADER_TEXTURE || s == SIM_SHADER_TEXTURE_FLAT;
    }
    return needs_four(p) ? "ZS_VARYINGS_TEXTURE_GLOSS"
           : both        ? "ZS_VARYINGS_TEXTURE_SMOOTH"
           : smooth   ? "ZS_VARYINGS_SMOOTH"
           : textured ? "ZS_VARYINGS_TEXTURE"
                      : "ZS_VARYINGS_FLAT";
}

/* The accelerators for the shaders and texel formats that are in it, after those of the frame. Those of transparent and
 * cut-out materials have none, nor have those of highlights on textures; where nothing is of an opaque shader's, it is
 * not named. */
static void accelerators(FILE *f, const struct sim_conversion *c)
{
    static const char *const names[] = { "RAW", "FLAT", "SMOOTH", "TEXTURE", "TEXTURE_FLAT", "TEXTURE_SMOOTH" };
    static const char *const formats[] = {
        [SIM_TEXELS_565] = "565", [SIM_TEXELS_PAL8] = "PAL8", [SIM_TEXELS_PAL4] = "PAL4"
    };
    const size_t n_names = sizeof names / sizeof names[0], n_formats = sizeof formats / sizeof formats[0];
    unsigned shaders = 0, texels = 0;
    for (uint32_t i = 0; i < c->made.pieces.n_paints; i++) {
        const struct sim_paint *p = &c->made.pieces.paint[i];
        if (p->alpha_mode != SIM_ALPHA_OPAQUE || has_gloss(p))
            continue;
        shaders |= 1u << p->shader;
        if (p->texture != SIM_NO_TEXTURE)
            texels |= 1u << c->made.packed[p->texture].format;
    }
    (void)fputs("ZS_FAST_FRAME, ZS_FAST_CLUSTERS", f);
    for (size_t i = 0; i < n_names; i++)
        if (shaders >> i & 1u)
            (void)fprintf(f, ", ZS_FAST_%s", names[i]);
    for (size_t i = 0; i < n_formats; i++)
        if (texels >> i & 1u && formats[i] != NULL)
            (void)fprintf(f, ", ZS_FAST_%s", formats[i]);
}

/* ", .what = NAME_what_part", or nothing */
static void pointer(FILE *f, int there, const char *name, const char *what, uint32_t part)
{
    if (there)
        (void)fprintf(f, ", .%s = %s_%s_%" PRIu32, what, name, what, part);
}

static void mesh_object(FILE *f, const char *name, uint32_t part, const struct sim_piece *p, const struct sim_steps *s)
{
    (void)fprintf(f, "    { .pos = %s_pos_%" PRIu32, name, part);
    pointer(f, s->fine, name, "pos_lo", part);
    pointer(f, 1, name, "tri", part);
    pointer(f, p->normal != NULL, name, "normal", part);
    pointer(f, p->face_normal != NULL, name, "face_normal", part);
    pointer(f, p->vertex_rgb != NULL, name, "vertex_rgb", part);
    pointer(f, p->face_rgb != NULL, name, "face_rgb", part);
    pointer(f, p->face_raw != NULL, name, "face_raw", part);
    (void)fprintf(f,
                  ",\n      .n_verts = %" PRIu32 "u, .n_tris = %" PRIu32 "u, .scale = %" PRIu32
                  "u, .center = { %d, %d, %d }, .radius = %u",
                  p->n_verts, p->n_tris, s->scale, p->center[0], p->center[1], p->center[2], p->radius);
    if (p->uv != NULL)
        (void)fprintf(f, ",\n      .uv = %s_uv_%" PRIu32 ", .uv_bits = %u", name, part, p->uv_bits);
    if (p->cluster != NULL)
        (void)fprintf(f, ",\n      .cluster = %s_cluster_%" PRIu32 ", .n_clusters = %" PRIu32 "u", name, part,
                      p->n_clusters);
    pointer(f, p->bvh != NULL, name, "bvh", part);
    (void)fputs(" },\n", f);
}

static void material_object(FILE *f, const char *name, const struct sim_paint *p)
{
    static const char *const culls[] = { "ZS_CULL_BACK", "ZS_CULL_FRONT", "ZS_CULL_NONE" };
    const enum sim_form form = sim_paint_form(p);
    (void)fprintf(f, "    %s{ .shader = &%s, .rgb = { %d, %d, %d }, .cull = %s",
                  form != SIM_FORM_MATERIAL ? "{ .material = " : "", shader_name(p), p->rgb.r, p->rgb.g, p->rgb.b,
                  culls[p->cull]);
    if (p->texture != SIM_NO_TEXTURE)
        (void)fprintf(f, ", .texture = &%s_texture[%" PRIu32 "]", name, p->texture);
    if (form == SIM_FORM_BLEND)
        (void)fprintf(f, " }, .alpha = %u", p->alpha);
    if (form == SIM_FORM_LIT)
        (void)fprintf(f, " },\n      .lighting = &%s_lighting", name);
    if (p->power > 0)
        (void)fprintf(f, ", .shine = &%s_shine_%u, .specular = { %d, %d, %d }", name, p->power, p->specular.r,
                      p->specular.g, p->specular.b);
    if (form == SIM_FORM_LIT)
        (void)fprintf(f, ", .emission = { %d, %d, %d }%s", p->emission.r, p->emission.g, p->emission.b,
                      p->two_sided ? ", .flags = ZS_LIT_TWO_SIDED" : "");
    (void)fputs(" },", f);
    if (p->name[0] != '\0') {
        (void)fputs(" /* ", f);
        sim_text_quote(f, p->name);
        (void)fputs(" */", f);
    }
    (void)fputc('\n', f);
}

/* Light for lit materials, and the powers of their highlights as tables. */
static void lighting(FILE *f, const struct sim_conversion *c)
{
    const char *name = c->options.name;
    uint8_t power[128];
    const uint32_t n = sim_paint_powers(power, &c->made.pieces);
    (void)fprintf(
        f,
        "\nstruct zs_lamp %s_lamp[1] = {\n    { .rgb = { 255, 255, 255 }, .strength = %uu, .dir = { 400000000, "
        "700000000, 709169576 } }\n};\nconst struct zs_lighting %s_lighting = { .lamp = %s_lamp, .n_lamps = 1, "
        ".ambient = { %d, %d, %d } };\n",
        name, SIM_LIT_STRENGTH, name, name, SIM_LIT_AMBIENT, SIM_LIT_AMBIENT, SIM_LIT_AMBIENT);
    for (uint32_t i = 0; i < n; i++) {
        struct zs_shine shine;
        (void)zs_shine_set(&shine, power[i]);
        (void)fprintf(f,
                      "static const struct zs_shine %s_shine_%u = { .scale = %" PRIu32 "u, .least = %u, .level = {\n",
                      name, power[i], shine.scale, shine.least);
        struct sim_text_row row = { f, 0 };
        for (size_t k = 0; k < sizeof shine.level; k++)
            sim_text_put(&row, "%d,", shine.level[k]);
        (void)fputs("\n} };\n", f);
    }
}

static void materials(FILE *f, const struct sim_conversion *c, enum sim_form form)
{
    const struct sim_pieces *p = &c->made.pieces;
    const uint32_t n = all_paints(p, form);
    if (n == 0)
        return;
    if (form == SIM_FORM_LIT)
        lighting(f, c);
    (void)fprintf(f, "\nconst struct %s %s_%s[%" PRIu32 "] = {\n", forms[form].type, c->options.name,
                  forms[form].array, n);
    for (uint32_t i = 0; i < p->n_paints; i++)
        if (sim_paint_form(&p->paint[i]) == form)
            material_object(f, c->options.name, &p->paint[i]);
    (void)fputs("};\n", f);
}

static void texture_object(FILE *f, const char *name, uint32_t part, const struct sim_packed_texels *s)
{
    static const char *const clamps[] = { "0", "ZS_CLAMP_U", "ZS_CLAMP_V", "ZS_CLAMP_U | ZS_CLAMP_V" };
    (void)fprintf(f, "    { .format = &zs_texel_%s, .texel = %s_texel_%" PRIu32, sim_texels_name(s->format), name,
                  part);
    if (s->n_colors > 0)
        (void)fprintf(f, ", .palette = %s_palette_%" PRIu32 ", .n_colors = %" PRIu32, name, part, s->n_colors);
    (void)fprintf(f, ",\n      .log2_w = %u, .log2_h = %u, .clamp = %s", sim_texture_log2(s->w),
                  sim_texture_log2(s->h), clamps[s->clamp & 3]);
    if (s->n_levels > 1)
        (void)fprintf(f, ", .n_levels = %" PRIu32, s->n_levels);
    if (s->alpha_least > 0)
        (void)fprintf(f, ", .alpha_least = %u", s->alpha_least);
    (void)fputs(" },\n", f);
}

static void textures(FILE *f, const struct sim_conversion *c)
{
    const char *name = c->options.name;
    for (uint32_t i = 0; i < c->made.n_packed; i++) {
        const struct sim_packed_texels *s = &c->made.packed[i];
        (void)fprintf(f, "\n/* Texture %" PRIu32 ": ", i);
        sim_text_quote(f, sim_text_last_name(c->model.texture[i].name));
        (void)fprintf(f, ", %" PRIu32 " x %" PRIu32 " texels, rows from the top", s->w, s->h);
        (void)fputs(s->n_levels > 1 ? "; then its coarser levels */\n" : " */\n", f);
        if (s->texel != NULL)
            sim_convert_numbers(f, name, i, "texel", s->texel, NULL, s->texel_bytes / 2);
        else
            sim_convert_numbers(f, name, i, "texel", NULL, s->index, s->texel_bytes);
        if (s->n_colors > 0)
            sim_convert_numbers(f, name, i, "palette", s->palette, NULL, sim_packed_palette(s));
    }
    if (c->made.n_packed == 0)
        return;
    (void)fprintf(f, "\nconst struct zs_texture %s_texture[%" PRIu32 "] = {\n", name, c->made.n_packed);
    for (uint32_t i = 0; i < c->made.n_packed; i++)
        texture_object(f, name, i, &c->made.packed[i]);
    (void)fputs("};\n", f);
}

static void meshes(FILE *f, const struct sim_conversion *c)
{
    const struct sim_pieces *p = &c->made.pieces;
    const char *name = c->options.name;
    for (uint32_t i = 0; i < p->n_pieces; i++)
        sim_convert_arrays(f, name, i, &p->piece[i], c->made.steps.fine);
    (void)fprintf(f, "\nconst struct zs_mesh %s_mesh[%" PRIu32 "] = {\n", name, p->n_pieces);
    for (uint32_t i = 0; i < p->n_pieces; i++)
        mesh_object(f, name, i, &p->piece[i], &c->made.steps);
    (void)fputs("};\n", f);
    for (size_t form = 0; form < N_FORMS; form++)
        materials(f, c, (enum sim_form)form);
    (void)fprintf(f, "\nconst struct zs_instance %s_instance[%" PRIu32 "] = {\n", name, p->n_pieces);
    for (uint32_t i = 0; i < p->n_pieces; i++) {
        const uint32_t paint = p->piece[i].paint;
        const enum sim_form form = sim_paint_form(&p->paint[paint]);
        (void)fprintf(f, "    { .mesh = &%s_mesh[%" PRIu32 "], .material = &%s_%s[%" PRIu32 "]%s },\n", name, i, name,
                      forms[form].array, count_paints(p, form, paint), form != SIM_FORM_MATERIAL ? ".material" : "");
    }
    (void)fputs("};\n", f);
}

/* ---- Files ----------------------------------------------------------------------------------- */

static void first_line(FILE *f, const struct sim_conversion *c)
{
    (void)fprintf(f, "/* Made by: %s\n * Do not edit this file: convert again.\n", c->options.command);
}

/* In world units, from the mesh's 0,0,0. */
struct box {
    long lo[3], hi[3], radius, middle[3];
};

static void find_box(struct box *box, const struct sim_conversion *c)
{
    const double unit = (double)c->made.steps.scale / 65536.0 / 256.0; /* world units to 1/256 step */
    double lo[3] = { INFINITY, INFINITY, INFINITY }, hi[3] = { -INFINITY, -INFINITY, -INFINITY }, most = 0.0;
    for (uint32_t i = 0; i < c->made.pieces.n_pieces; i++)
        for (uint32_t v = 0; v < c->made.pieces.piece[i].n_verts; v++)
            for (int k = 0; k < 3; k++) {
                lo[k] = fmin(lo[k], c->made.pieces.piece[i].fine[v][k] * unit);
                hi[k] = fmax(hi[k], c->made.pieces.piece[i].fine[v][k] * unit);
            }
    for (int k = 0; k < 3; k++) {
        box->lo[k] = (long)floor(lo[k]);
        box->hi[k] = (long)ceil(hi[k]);
        box->middle[k] = c->options.keep_origin ? lrint((lo[k] + hi[k]) / 2.0) : 0;
    }
    for (uint32_t i = 0; i < c->made.pieces.n_pieces; i++)
        for (uint32_t v = 0; v < c->made.pieces.piece[i].n_verts; v++) {
            double squared = 0.0;
            for (int k = 0; k < 3; k++) {
                const double d = c->made.pieces.piece[i].fine[v][k] * unit - (double)box->middle[k];
                squared += d * d;
            }
            most = fmax(most, squared);
        }
    box->radius = (long)ceil(sqrt(most));
}

static void describe_place(FILE *f, const struct sim_conversion *c, const struct box *box)
{
    const struct sim_steps *s = &c->made.steps;
    char text[4][32];
    (void)fprintf(f, " * Size       %ld x %ld x %ld world units; a unit of the model is %s of them.\n",
                  box->hi[0] - box->lo[0], box->hi[1] - box->lo[1], box->hi[2] - box->lo[2],
                  sim_text_exact(text[0], s->unit));
    (void)fprintf(f, " * Place      0,0,0 is %s.\n",
                  c->options.keep_origin ? "the model's own origin" : "the middle of the model's box");
    (void)fprintf(f, " * Positions  in the model's units: %s %s %s + %s * n, n as in the arrays%s.\n",
                  sim_text_exact(text[0], s->origin[0]), sim_text_exact(text[1], s->origin[1]),
                  sim_text_exact(text[2], s->origin[2]),
                  sim_text_exact(text[3], s->step), s->fine ? " (pos + pos_lo / 256)" : "");
}

static void describe_use(FILE *f, const char *name, const char *big)
{
    (void)fprintf(f,
                  " * Use        a scene's .instance can be %s_instance, and .n_instances %s_INSTANCES. To "
                  "move\n"
                  " *            the model, copy all of it to RAM and give every instance the same pose:\n"
                  " *                struct zs_instance %s[%s_INSTANCES];\n"
                  " *                memcpy(%s, %s_instance, sizeof %s);\n",
                  name, big, name, big, name, name, name);
}

static void defines(FILE *f, const struct sim_conversion *c, const char *big, const struct box *b)
{
    const struct sim_pieces *p = &c->made.pieces;
    (void)fprintf(f, "#define %s_INSTANCES %" PRIu32 "u\n", big, p->n_pieces);
    for (size_t form = 0; form < N_FORMS; form++)
        if (all_paints(p, (enum sim_form)form) > 0)
            (void)fprintf(f, "#define %s_%s %" PRIu32 "u\n", big, forms[form].define,
                          all_paints(p, (enum sim_form)form));
    if (all_paints(p, SIM_FORM_BLEND) > 0)
        (void)fprintf(
            f, "#define %s_METHOD (&zs_method_transparent) /* zs_config.method: sorts what is transparent */\n", big);
    (void)fprintf(f, "#define %s_TRIANGLES %" PRIu32 "u\n", big, p->n_tris);
    (void)fprintf(f, "#define %s_VERTICES %" PRIu32 "u\n", big, p->n_verts);
    (void)fprintf(f, "#define %s_VARYINGS %s /* zs_config.varyings, at least */\n", big, attrs_name(p));
    if (needs_four(p))
        (void)fprintf(f,
                      "#if ZS_VARYINGS_MAX < 4\n#error \"%s.h: highlights on textures have four varyings; compile this "
                      "and all of zstrip with -DZS_VARYINGS_MAX=4\"\n#endif\n",
                      c->options.name);
    (void)fprintf(f, "/* For a list of accelerators (zs_fast.h), which ends with ZS_FAST_END: zs_config.fast */\n");
    (void)fprintf(f, "#define %s_FAST ", big);
    accelerators(f, c);
    (void)fputc('\n', f);
    (void)fprintf(f, "#define %s_LO { %ld, %ld, %ld } /* world units: its box, its middle, */\n", big, b->lo[0],
                  b->lo[1], b->lo[2]);
    (void)fprintf(f, "#define %s_HI { %ld, %ld, %ld } /* and how far from the middle it reaches */\n", big, b->hi[0],
                  b->hi[1], b->hi[2]);
    (void)fprintf(f, "#define %s_MIDDLE { %ld, %ld, %ld }\n", big, b->middle[0], b->middle[1], b->middle[2]);
    (void)fprintf(f, "#define %s_RADIUS %ld\n", big, b->radius);
}

void sim_convert_header(FILE *f, const struct sim_conversion *c)
{
    const char *name = c->options.name;
    const int has_mesh = c->made.pieces.n_pieces > 0;
    char big[64];
    struct box box = { 0 };
    struct sim_converted_bytes bytes;
    sim_converted_bytes(&bytes, &c->made);
    upper(big, name);
    first_line(f, c);
    (void)fprintf(f, " *\n * Flash      %zu bytes; %s.c says what for.\n", bytes.total, name);
    if (has_mesh) {
        find_box(&box, c);
        describe_place(f, c, &box);
        describe_use(f, name, big);
    }
    (void)fprintf(f, " */\n#ifndef %s_H\n#define %s_H\n\n#include \"zstrip.h\"\n%s%s\n", big, big,
                  all_paints(&c->made.pieces, SIM_FORM_BLEND) > 0 ? "#include \"zs_blend.h\"\n" : "",
                  all_paints(&c->made.pieces, SIM_FORM_LIT) > 0 ? "#include \"zs_lights.h\"\n" : "");
    if (has_mesh)
        defines(f, c, big, &box);
    if (c->made.n_packed > 0)
        (void)fprintf(f, "#define %s_TEXTURES %" PRIu32 "u\n", big, c->made.n_packed);
    (void)fputs("\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n", f);
    if (has_mesh) {
        (void)fprintf(f, "extern const struct zs_instance %s_instance[%s_INSTANCES]; /* one to a mesh */\n", name,
                      big);
        (void)fprintf(f, "extern const struct zs_mesh %s_mesh[%s_INSTANCES];\n", name, big);
        for (size_t form = 0; form < N_FORMS; form++)
            if (all_paints(&c->made.pieces, (enum sim_form)form) > 0)
                (void)fprintf(f, "extern const struct %s %s_%s[%s_%s];\n", forms[form].type, name, forms[form].array,
                              big, forms[form].define);
        if (all_paints(&c->made.pieces, SIM_FORM_LIT) > 0)
            (void)fprintf(f,
                          "/* The light of %s_lit, in RAM; zs_scene.light is for the others. To have them alike:\n"
                          " *     memcpy(%s_lamp[0].dir, scene.light.dir, sizeof %s_lamp[0].dir); */\n"
                          "extern struct zs_lamp %s_lamp[1];\nextern const struct zs_lighting %s_lighting;\n",
                          name, name, name, name, name);
    }
    if (c->made.n_packed > 0)
        (void)fprintf(f, "extern const struct zs_texture %s_texture[%s_TEXTURES];\n", name, big);
    (void)fputs("\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n", f);
}

void sim_convert_source(FILE *f, const struct sim_conversion *c)
{
    first_line(f, c);
    (void)fputs(" *\n", f);
    sim_convert_figures(f, c, " *   ");
    (void)fprintf(f, " */\n#include \"%s.h\"\n", c->options.name);
    if (has_alpha(c))
        (void)fputs("#include \"zs_filter.h\"\n", f);
    if (c->options.bvh)
        (void)fputs("#include \"zs_method.h\"\n", f);
    textures(f, c);
    if (c->made.pieces.n_pieces > 0)
        meshes(f, c);
}

void sim_convert_map(FILE *f, const struct sim_conversion *c)
{
    for (uint32_t i = 0; i < c->made.pieces.n_pieces; i++)
        for (uint32_t t = 0; t < c->made.pieces.piece[i].n_tris; t++) {
            const uint32_t id = c->made.pieces.piece[i].source[t] + 1;
            sim_u32_write(f, &id, 1);
        }
}
