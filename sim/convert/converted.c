/* From a file to what firmware holds of it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "converted.h"

#include <stdlib.h>
#include <string.h>

#include "model_shape.h"
#include "sim.h"

/* Structs on a 32-bit machine, bytes. */
#define MESH_BYTES 72u
#define MATERIAL_BYTES 16u
#define BLEND_BYTES 20u
#define LIT_BYTES 32u
#define LAMP_BYTES 48u
#define LIGHTING_BYTES 12u
#define SHINE_BYTES 272u
#define TEXTURE_BYTES 20u
#define INSTANCE_BYTES 64u

void sim_convert_defaults(struct sim_convert_options *o)
{
    *o = (struct sim_convert_options){ .look = SIM_LOOK_DEFAULT, .texture_size = { 256, 256 } };
}

/* ---- Loading --------------------------------------------------------------------------------- */

/* A look that was asked for, and is not there. */
static int refuse_untextured(const struct sim_model *model, const char *file)
{
    if (model->lost_materials != NULL)
        return sim_refuse(file, 0,
                          "no textures: its material file %s cannot be read; put it beside the "
                          "model, or name a picture by --texture",
                          model->lost_materials);
    int placed = 0;
    for (uint32_t t = 0; model->has_uv != NULL && t < model->n_tris; t++)
        placed |= model->has_uv[t];
    if (!placed)
        return sim_refuse(file, 0,
                          "has no texture coordinates; unwrap it in a modeller, or give --shade smooth or flat");
    return sim_refuse(file, 0,
                      "no face of it has a texture and coordinates for it; name a picture by "
                      "--texture, or give --shade smooth or flat");
}

static int is_textured(const struct sim_convert_options *o)
{
    return o->look == SIM_LOOK_TEXTURED || o->look == SIM_LOOK_TEXTURED_FLAT ||
           o->look == SIM_LOOK_UNLIT;
}

/* Are texels lit by more than a brightness? Only smooth light does that. */
static int lights_texels(const struct sim_model *model, const struct sim_convert_options *o)
{
    int lit = o->lit;
    for (uint32_t i = 0; !o->opaque && i < model->n_materials; i++)
        lit |= model->material[i].texture != SIM_NO_TEXTURE && model->material[i].alpha_mode == SIM_ALPHA_OPAQUE &&
               sim_material_lights(&model->material[i], 1);
    return lit;
}

/* Smooth where the file has normals; else each face is flat, if need be by normals of its own at its corners. */
static enum sim_look look_of(struct sim_model *model, const struct sim_convert_options *o)
{
    if (model->n_textures == 0)
        return model->file_normals ? SIM_LOOK_SMOOTH : SIM_LOOK_FLAT;
    if (!model->file_normals && !lights_texels(model, o))
        return SIM_LOOK_TEXTURED_FLAT;
    if (!model->file_normals)
        sim_model_flatten(model);
    return SIM_LOOK_TEXTURED;
}

/* Without a word from the user, a colour for all makes textures unwanted. */
int sim_convert_load(struct sim_model *model, struct sim_convert_options *o)
{
    const int asked = is_textured(o) || o->texture != NULL,
              free_choice = o->look == SIM_LOOK_DEFAULT;
    const struct sim_want want = {
        .normals = 1, .textures = asked || (free_choice && !o->has_color), .picture = o->texture,
        .lenient = free_choice, .wrap = (enum sim_wrap)o->wrap, .color = o->has_color ? &o->color : NULL,
        .limits = o->limits, .simplify = o->simplify
    };
    memset(model, 0, sizeof *model);
    if (o->texture != NULL && !free_choice && !is_textured(o))
        return sim_refuse(o->input, 0, "--texture needs --shade textured, textured-flat or unlit");
    int status = sim_model_load(model, o->input, &want);
    if (status == SIM_OK && asked && model->n_textures == 0)
        status = refuse_untextured(model, o->input);
    o->by_material = o->chosen = free_choice;
    if (status == SIM_OK && free_choice)
        o->look = look_of(model, o);
    if (status != SIM_OK)
        sim_model_free(model);
    return status;
}

/* ---- Converting ------------------------------------------------------------------------------ */

int sim_converted_make(struct sim_converted *out, const struct sim_model *model,
                       const struct sim_convert_options *o)
{
    const struct sim_steps_want want = { o->unit, o->keep_origin, o->precise };
    memset(out, 0, sizeof *out);
    int status = sim_steps_choose(&out->steps, model, &want);
    if (status != SIM_OK)
        return status;
    uint32_t(*size)[2] = sim_alloc(model->n_textures, sizeof *size);
    for (uint32_t i = 0; i < model->n_textures; i++)
        sim_packed_size(size[i], &model->texture[i], o->texture_size);
    status = sim_pieces_make(&out->pieces, model, &out->steps, o, (const uint32_t(*)[2])size);
    free(size);
    out->packed = sim_alloc(model->n_textures, sizeof *out->packed);
    while (status == SIM_OK && out->n_packed < model->n_textures) {
        status = sim_packed_make(&out->packed[out->n_packed], &model->texture[out->n_packed], model->file,
                               o);
        out->n_packed += status == SIM_OK;
    }
    return status;
}

void sim_converted_free(struct sim_converted *c)
{
    for (uint32_t i = 0; i < c->n_packed; i++)
        sim_packed_free(&c->packed[i]);
    free(c->packed);
    sim_pieces_free(&c->pieces);
    memset(c, 0, sizeof *c);
}

void sim_converted_bytes(struct sim_converted_bytes *out, const struct sim_converted *c)
{
    struct sim_flash *s = &out->mesh;
    const struct sim_pieces *p = &c->pieces;
    sim_pieces_flash(s, p, c->steps.fine);
    out->texels = 0;
    for (uint32_t i = 0; i < c->n_packed; i++)
        out->texels += c->packed[i].texel_bytes + c->packed[i].palette_bytes;
    out->structs = p->n_pieces * (MESH_BYTES + INSTANCE_BYTES) + c->n_packed * TEXTURE_BYTES;
    static const size_t of_form[] = { [SIM_FORM_MATERIAL] = MATERIAL_BYTES, [SIM_FORM_BLEND] = BLEND_BYTES,
                                      [SIM_FORM_LIT] = LIT_BYTES };
    uint8_t powers[128];
    int lit = 0;
    for (uint32_t i = 0; i < p->n_paints; i++) {
        out->structs += of_form[sim_paint_form(&p->paint[i])];
        lit |= p->paint[i].lit;
    }
    out->structs += (lit ? LAMP_BYTES + LIGHTING_BYTES : 0u) + SHINE_BYTES * sim_paint_powers(powers, p);
    out->total = s->pos + s->pos_lo + s->tri + s->normal + s->face_normal + s->rgb + s->uv +
                 s->cluster + s->bvh + out->texels + out->structs;
}
