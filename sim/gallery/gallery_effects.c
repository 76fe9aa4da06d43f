/* A teapot as a model, and what is done to it.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gallery_effects.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "meshes.h"
#include "model.h"
#include "render.h"
#include "sim.h"

#define POT "--size 240x180 --background 2a3a50 --eye 1.1,0.9,1.65 "

const struct gallery_effect gallery_effects[GALLERY_EFFECTS] = {
    { "wire", "Wireframe", POT "--style wire", "All edges, as lines of 1 to 64 px, clipped exactly, dashed if need be.",
      "Edges behind the thing are drawn, too." },
    { "hidden-line", "Hidden lines", POT "--style hidden-line",
      "Drawings, and panels of one bit: the edges that no face hides. Faces are drawn first, into the depth buffer "
      "alone and pushed back a little.",
      "An edge that is sunk into another part by less than that may show for a few px." },
    { "outline", "Silhouette and creases", POT "--style hidden-line --edges border,crease,silhouette --crease 40",
      "Technical drawings, cartoons over shaded faces: few lines say the shape. Silhouettes are chosen anew as the eye "
      "moves.",
      "A silhouette may have gaps of a few px where the face beside it is thinner than half a px." },
    { "dashed", "Dashed lines", POT "--style wire --edges border,crease,silhouette --crease 40 --dash 5,4",
      "Hidden edges of a drawing, guides, grids: px along x or y, whichever is longer.",
      "Dashes begin anew at each edge, and where it is clipped. Each is a line of its own: 3,400 instructions." },
    { "points", "Points", POT "--style points --line-width 2",
      "Vertices, scans, stars: squares of 1 to 64 px, tested against depth.",
      "No face hides them, but for faces that are drawn with them." },
    { "lights", "Coloured lights",
      POT "--shade smooth --light point:1,1.4,0.8:ffb050:4 --light dir:-1,0.6,0.3:3060ff --ambient 0.1 --color ffffff",
      "Up to four lamps, directional, at a point or in a cone, at faces or vertices. Each lamp costs at each vertex.",
      "Light at vertices misses what falls between them." },
    { "per-pixel", "Highlights, light by pixel", POT "--shade smooth --per-pixel --specular 40:0.8",
      "Phong shading: normals are interpolated. Take it for few pixels that shine.", "It costs at each pixel." },
    { "textured-highlights", "Highlights on a texture",
      POT "--shade textured --per-pixel --specular 20:0.9 --filter bilinear",
      "Polished wood, wet stone: light multiplies the texture, the highlight is added on top.",
      "730 instructions a pixel; at the vertices, without --per-pixel, 54 to 175." },
    { "alpha", "Alpha blending", POT "--shade smooth --alpha 0.5",
      "Glass. Triangles are sorted after the opaque ones, tested against depth and not written.",
      "Crossing faces are mixed in one order: depth sort splits them." },
    { "add", "Additive blending", POT "--shade smooth --alpha 0.5 --blend add",
      "Light, fire, glow. It needs no order.", "It never darkens." },
    { "screen-door", "Screen-door transparency", POT "--shade smooth --alpha 0.5 --blend screen-door",
      "A pattern of whole pixels. It needs no order and writes depth.", "The pattern is seen." },
    { "bilinear", "Bilinear filtering", POT "--eye 0.5,0.6,0.9 --shade textured --filter bilinear",
      "Textures that are looked at closely.", "Textures far away still flicker: mipmaps." },
    { "mipmap", "Mipmaps", POT "--eye 5,4,8 --fov 20 --shade textured --filter mipmap",
      "Textures far away: a smaller image is read. It takes a third more flash.", "Slanted surfaces are blurred." },
    { "samples", "Four samples a pixel", POT "--shade flat --samples 4",
      "Edges without steps. Four times the pixels and four times the strip's memory.", "Textures gain little." },
    { "fog", "Fog", POT "--shade smooth --fog linear:1.5:2.9:2a3a50",
      "Distance, and a far plane that is not seen. It goes by depth keys, whatever is drawn.",
      "Transparent faces have no key of their own." },
    { "dither", "Dithering",
      POT "--size 128x64 --background 000000 --shade smooth --dither blue --panel ssd1306:128x64 --color ffffff",
      "Panels of few colours: blue noise or a Bayer matrix, stable from frame to frame.", "Fine lines fray." },
    { "shadow-planar", "Flat shadow", POT "--shade smooth --shadow planar",
      "A shadow on a floor: the mesh, flattened along the light.", "It falls on one plane alone." },
    { "shadow-map", "Shadow map", POT "--shade smooth --shadow map --light 1,1.2,0.4",
      "Shadows of all on all, by a 16-bit depth map of the light's view.",
      "Edges are steps of texels; 128 KB for 256x256." },
    { "shadow-lights", "Shadows of two lights, with highlights",
      POT "--shade smooth --shadow map --light dir:1,1.4,0.6:ffd8a0 --light dir:-1,1.2,0.5:5070ff --specular 40:0.7",
      "A map for each light, and light at each pixel.", "2,000 instructions a pixel, and the maps' memory." },
    { "environment", "Environment map", POT "--shade smooth --environment IMAGE",
      "Chrome and light from all sides at no cost: a texture that is looked up by the normal.",
      "It does not change when the thing moves." },
    { "mirror", "Mirror", POT "--shade smooth --mirror",
      "A floor, a wall, a rear-view mirror: a pass seen in the mirror's plane alone.", "The scene is walked twice." },
    { "together", "Together: glass, fog, shadows in a mirror",
      POT "--shade smooth --alpha 0.6 --specular 30:0.8 --shadow planar --mirror --fog linear:1.6:4.5:2a3a50 "
          "--samples 4",
      "Any shader can be a layer; fog comes before the glass and before the mirror, at its own distance.",
      "Three passes: each walks its part of the scene." },
};

/* ---- The model ------------------------------------------------------------------------------------------------- */

/* A sphere's picture, brown below and blue above, with a window. */
static struct sim_image sphere_image(void)
{
    struct sim_image image = { .width = 64, .height = 64 };
    image.rgb = sim_alloc(64 * 64, sizeof *image.rgb);
    for (int i = 0; i < 64 * 64; i++) {
        const double u = (i % 64 - 31.5) / 32.0, v = (i / 64 - 31.5) / 32.0;
        const double sky[3] = { 120 - 70 * v, 160 - 50 * v, 235 },
                     earth[3] = { 110 - 60 * v, 84 - 46 * v, 60 - 40 * v };
        const int window = u > -0.6 && u < -0.2 && v > -0.7 && v < -0.3;
        for (int k = 0; k < 3; k++)
            image.rgb[i][k] = (uint8_t)(window ? 255 : v < 0.02 ? sky[k] : earth[k]);
    }
    return image;
}

/* A pattern that shows how texels are read. */
static struct sim_image squares_image(void)
{
    struct sim_image image = { .width = 32, .height = 32 };
    image.rgb = sim_alloc(32 * 32, sizeof *image.rgb);
    for (int i = 0; i < 32 * 32; i++) {
        static const uint8_t color[2][3] = { { 226, 92, 60 }, { 250, 240, 214 } };
        memcpy(image.rgb[i], color[(i % 32 / 4 + i / 32 / 4) & 1], 3);
    }
    return image;
}

/* The teapot of the demo, its sphere's radius 1. */
static void make_model(struct sim_model *m, const struct sim_options *o)
{
    const struct zs_mesh *mesh = &mesh_teapot;
    const double scale = 1.0 / mesh->radius, uv = ldexp(1.0, -mesh->uv_bits);
    const struct zs_rgb blue = ZS_RGB(0x4a90d8), own = o->has_color ? o->color : blue;
    const int textured = sim_options_textured(o);
    memset(m, 0, sizeof *m);
    m->file = "teapot";
    m->n_points = mesh->n_verts;
    m->n_tris = mesh->n_tris;
    m->point = sim_alloc(m->n_points, sizeof *m->point);
    m->tri = sim_alloc(m->n_tris, sizeof *m->tri);
    m->normal = sim_alloc(m->n_tris, sizeof *m->normal);
    m->rgb = sim_alloc(m->n_tris, sizeof *m->rgb);
    m->uv = sim_alloc(m->n_tris, sizeof *m->uv);
    m->has_uv = sim_alloc(m->n_tris, 1);
    m->tri_material = sim_alloc(m->n_tris, sizeof *m->tri_material);
    for (uint32_t v = 0; v < m->n_points; v++)
        for (int k = 0; k < 3; k++) {
            m->point[v][k] = (mesh->pos[v][k] - mesh->center[k]) * scale;
            m->lo[k] = fmin(m->lo[k], m->point[v][k]);
            m->hi[k] = fmax(m->hi[k], m->point[v][k]);
        }
    for (uint32_t t = 0; t < m->n_tris; t++)
        for (int c = 0; c < 3; c++) {
            const uint16_t v = mesh->tri[t][c];
            m->tri[t][c] = v;
            m->rgb[t][c] = own;
            m->has_uv[t] = 1;
            for (int k = 0; k < 3; k++)
                m->normal[t][c][k] = (float)(mesh->normal[v][k] / 32767.0);
            for (int k = 0; k < 2; k++)
                m->uv[t][c][k] = mesh->uv[v][k] * uv;
        }
    m->radius = 1.0;
    m->n_materials = 1;
    m->material = sim_alloc(1, sizeof *m->material);
    m->material->name = sim_alloc(1, 1);
    m->material->rgb = own;
    m->material->texture = textured ? 0 : SIM_NO_TEXTURE;
    if (textured) {
        struct sim_image image = squares_image();
        m->texture = sim_alloc(1, sizeof *m->texture);
        m->n_textures = 1;
        sim_texture_make(m->texture, &image, "squares", NULL);
    }
}

/* ---- A card ---------------------------------------------------------------------------------------------------- */

#define WORDS_MAX 40

int gallery_effect_draw(struct sim_picture *out, const struct gallery_effect *effect)
{
    char text[512], *word[WORDS_MAX];
    int n = 0, status;
    struct sim_options o;
    struct sim_model model;
    (void)snprintf(text, sizeof text, "teapot --out F.png %s", effect->options);
    for (char *at = strtok(text, " "); at != NULL && n < WORDS_MAX; at = strtok(NULL, " "))
        word[n++] = at;
    status = sim_options_parse(&o, n, word);
    if (status != SIM_OK)
        return status;
    make_model(&model, &o);
    struct sim_image sphere = sphere_image();
    o.effects.environment_image = &sphere;
    status = sim_render_model(out, NULL, &model, &o);
    sim_image_free(&sphere);
    sim_model_free(&model);
    return status;
}
