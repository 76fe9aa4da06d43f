/* The table of options, and what they must not be together.
 *
 * SPDX-License-Identifier: MIT
 */
#include "render_options.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

#include "frame.h"
#include "framing.h"
#include "line_style.h"
#include "load_options.h"
#include "method_names.h"
#include "option_help.h"
#include "option_table.h"
#include "sim.h"
#include "simplify.h"
#include "turntable.h"

#define AT(field) offsetof(struct sim_options, field)

static const struct sim_option table[] = {
    { "Output", SIM_OPTION_HEADING },
    { "--out", SIM_OPTION_FILE, AT(out), .value = "F.png",
      .help = "the frame; its 8-bit channels are the RGB565 bits, repeated. It is needed" },
    { "--depth-out", SIM_OPTION_FILE, AT(depth_out), .value = "D.pgm",
      .help = "depth keys, 16-bit PGM; 65535: nothing drawn" },
    { "--id-out", SIM_OPTION_FILE, AT(id_out), .value = "I.u32",
      .help = "little-endian uint32 a pixel: triangle in file order + 1; 0: none" },
    { "--turntable", SIM_OPTION_COUNT, AT(turntable), 0, 1, SIM_TURNTABLE_MAX,
      .help = "N views, {range}, of the model as it turns once around; --out is an animated PNG then, or a GIF or MP4 "
              "where its name ends so" },
    { "--stats", SIM_OPTION_FILE, AT(stats), .value = "S.json", 
      .help = "what the frame took, an object of numbers; - (as for the other files) is standard output" },
    { "--explain", SIM_OPTION_FLAG, AT(explain),
      .help = "what is wrong with the picture, in sentences on stderr; without it on a terminal, if nothing is seen" },
    { "--reference", SIM_OPTION_FLAG, AT(reference), .help = "all of it from the double-precision reference instead" },
    { "--compare", SIM_OPTION_FLAG, AT(compare), .help = "draw both, print how far the frame is from the reference" },
    { "--show", SIM_OPTION_CHOICE, AT(show), .words = SIM_SHOW_WORDS,
      .help = "false colours and a legend in --out in place of the frame. depth: distance; complexity: how many "
              "triangles cover a pixel, hidden ones too; overdraw: how often it was written; tested: how often a key "
              "was compared there; strips: set-ups of each strip, as bars. --stats has the sum (frame)" },
    { "Frame", SIM_OPTION_HEADING },
    { "--size", SIM_OPTION_SIZE, AT(size), AT(has_size), 1, ZS_SIZE_MAX, .help = "px (240x240)" },
    { "--strip", SIM_OPTION_COUNT, AT(strip), .value = "ROWS", .help = "rows to a strip, at least 1 (16)" },
    { "--depth", SIM_OPTION_CHOICE, AT(depth), .words = SIM_DEPTH_WORDS,
      .help = "mapping of depth keys (float: e3m13 while far <= 128 near, e4m12 while far <= 32768 near, else e5m11; "
              "orthographic views: linear)" },
    { "--depth-bits", SIM_OPTION_COUNT, AT(depth_bits), 0, 8, 16, .help = "bits of a depth key (16)" },
    { "--subpixel", SIM_OPTION_COUNT, AT(subpixel), .words = "4|8", .help = "sub-pixel bits (8)" },
    { "--method", SIM_OPTION_CHOICE, AT(method), .words = SIM_METHOD_WORDS,
      .help = "how hidden surfaces are removed (zbuffer); zsim gallery shows what each gets right and takes" },
    { "--tris", SIM_OPTION_COUNT, AT(tris), 0, 1, ZS_POOL_MAX,
      .help = "triangles that memory has room for, {range}; few take more passes for the same frame (ample)" },
    { "--verts", SIM_OPTION_COUNT, AT(verts), 0, 3, ZS_POOL_MAX, .help = "vertices that it has room for (ample)" },
    { "--buffers", SIM_OPTION_COUNT, AT(buffers), .words = "1|2", .help = "strip buffers (2)" },
    { "--fast", SIM_OPTION_TEXT, AT(fast_names), .value = "LIST", .list = sim_fast_list,
      .help = "accelerators to draw with, the same frame: all, none, names with commas between, or all but some, as "
              "all-tiles-touch (all). There are:" },
    { "--threads", SIM_OPTION_COUNT, AT(threads), 0, 1, SIM_THREADS_MAX,
      .help = "draw by N threads, {range}, each with an arena of its own: the same frame; --stats has draw_us then, "
              "the time that drawing took, and draw_busiest_us, that of a processor for the thread that took most" },
    { "Panel", SIM_OPTION_HEADING },
    SIM_PANEL_OPTIONS(struct sim_options, panel,
                      "the frame goes through this panel's driver and the model of its controller into --out: what "
                      "its viewer sees. --size is its picture's then. There are:"),
    { "--spi", SIM_OPTION_COUNT, AT(spi_hz), AT(has_spi), 1000, 1e9, .value = "HZ",
      .help = "clock of its wire, for the time in --stats (st7789 and gc9a01 62500000, ssd1351 20000000, ili9341 and "
              "ssd1306 10000000, ssd0323 4000000)" },
    { "Camera, in the model's units; what is not given frames the model", SIM_OPTION_HEADING },
    { "--eye", SIM_OPTION_VECTOR, AT(eye), AT(has_eye), .help = "where it stands" },
    { "--at", SIM_OPTION_VECTOR, AT(at), AT(has_at), .help = "what it looks at" },
    { "--up", SIM_OPTION_VECTOR, AT(up), .help = "what is up in the picture (0,1,0)" },
    { "--fov", SIM_OPTION_NUMBER, AT(fov), .value = "DEGREES",
      .help = "field of view, vertical, between 0 and 180 (45); orthographic views show as much at --at" },
    { "--near", SIM_OPTION_NUMBER, AT(near_z), AT(has_near),
      .help = "distance along the view at which it begins; in perspective more than 0" },
    { "--far", SIM_OPTION_NUMBER, AT(far_z), AT(has_far), .help = "distance at which it ends" },
    { "--projection", SIM_OPTION_CHOICE, AT(projection), .words = "perspective|orthographic",
      .help = "does what is far look smaller? (perspective)" },
    { "Look", SIM_OPTION_HEADING },
    { "--shade", SIM_OPTION_CHOICE, AT(shade), .words = "id|flat|smooth|textured|textured-flat|unlit",
      .help = "id: a colour for each triangle's number, flat: light of its face, smooth: of its vertices, textured: "
              "texels times smooth light, textured-flat: times a face's, unlit: texels alone; of these, faces without "
              "a texture are smooth, flat, raw (as zsim convert: smooth if the file has normals, else flat; if the "
              "model has a texture, textured or textured-flat)" },
    { "--mesh", SIM_OPTION_CHOICE, AT(mesh), .words = "convert|file",
      .help = "convert: the mesh that zsim convert writes, which firmware draws; file: faces as the file has them, in "
              "its order, on a grid of 24 bits, to measure the renderer by itself (convert)" },
    { "--precise", SIM_OPTION_FLAG, AT(precise), .help = "24 bits a coordinate instead of 16, as of zsim convert" },
    { "--style", SIM_OPTION_CHOICE, AT(style), .words = SIM_STYLE_WORDS,
      .help = "solid: its faces; or wire: the model's edges alone, hidden-line: those that its faces do not hide, "
              "points: its vertices, in white or the --color (solid)" },
    { "--line-width", SIM_OPTION_COUNT, AT(line_width), 0, 1, 64,
      .help = "px, of the lines and points of --style; no matter to solid (1)" },
    { "--edges", SIM_OPTION_TEXT, AT(edges), .value = "LIST",
      .help = "which edges --style wire and hidden-line draw: all, or names with commas between. border: of one face; "
              "crease: its faces meet at --crease or more; silhouette: one of them faces the eye, the other does not, "
              "as in border,silhouette (all)" },
    { "--crease", SIM_OPTION_NUMBER, AT(crease), AT(has_crease), 0, 180, .value = "DEGREES",
      .help = "the angle of --edges crease: between what its faces look at (30)" },
    { "--dash", SIM_OPTION_TEXT, AT(dash), .value = "ON,OFF",
      .help = "px that a line of --style wire and hidden-line is drawn for and left out for, in turn (without gaps)" },
    { "--texture", SIM_OPTION_FILE, AT(texture), .value = "T.png",
      .help = "one picture (PNG or JPEG) for all faces in place of the model's own. A side that is no power of two up "
              "to 1024 becomes the nearest one by averaging areas (texture_resampled of --stats); alpha is dropped" },
    { "--texture-format", SIM_OPTION_CHOICE, AT(texel), AT(has_texel), .words = "565|pal8|pal4",
      .help = "how texels are stored: RGB565, or 256 or 16 colours of it (as zsim convert: the smallest that is good "
              "enough; with --mesh file 565)" },
    { "--wrap", SIM_OPTION_CHOICE, AT(clamp), AT(has_wrap), .words = "repeat|clamp",
      .help = "beyond the picture's border (as the model says, else repeat)" },
    { "--cull", SIM_OPTION_CHOICE, AT(cull), .words = "back|front|none",
      .help = "which sides of faces are not drawn (back)" },
    { "--background", SIM_OPTION_RGB, AT(background), .help = "where nothing is drawn (000000)" },
    { "--color", SIM_OPTION_RGB, AT(color), AT(has_color), .help = "one colour for the whole model" },
    { "--light", SIM_OPTION_TEXTS, AT(effects.light_texts), .value = "LIGHT",
      .help = "x,y,z: direction towards the light (over the camera's left shoulder). Or TYPE:X,Y,Z[:RRGGBB[:RANGE]], "
              "which may be given four times: dir, in that direction, point, at that place, or spot, there and aimed "
              "at the middle of the model; beyond RANGE a point or spot has no effect" },
    { "--ambient", SIM_OPTION_NUMBER, AT(ambient), 0, 0, 1, .value = "A",
      .help = "how bright a face is that no light falls on (0.25)" },
    { "--diffuse", SIM_OPTION_NUMBER, AT(diffuse), 0, 0, 1, .value = "D",
      .help = "what is added where a face looks straight at the light (0.75)" },
    SIM_EFFECT_OPTIONS(struct sim_options, effects),
    SIM_SIMPLIFY_OPTION(struct sim_options, simplify, 0),
    SIM_LOAD_OPTIONS(struct sim_options, limits),
    { "Else", SIM_OPTION_HEADING },
    SIM_HELP_OPTIONS(AT(help)),
};

const struct sim_option *sim_options_rows(size_t *n)
{
    *n = N_TABLE;
    return table;
}

void sim_options_help(void)
{
    static const struct sim_help help = {
        "zsim render MODEL --out FRAME.png [options]",
        "Draws a model (OBJ, PLY, STL, glTF and what else assimp reads) strip by strip, as boards do: what zsim "
        "convert "
        "writes. What the file has that is not carried over is named.",
        "Exit status: 0 done; 1 refused, nothing written; 2 the command line makes no sense.",
    };
    sim_option_help(table, N_TABLE, &help);
}

static int check_rest(const struct sim_options *o)
{
    const char *file = o->model;
    if (o->strip < 1)
        return sim_refuse(file, 0, "--strip %ld: a strip has at least 1 row", o->strip);
    if (!(o->fov > 0.0 && o->fov < 180.0))
        return sim_refuse(file, 0, "--fov %g: the field of view lies between 0 and 180 degrees", o->fov);
    if (o->has_near && o->projection == ZS_PERSPECTIVE && o->near_z <= 0.0)
        return sim_refuse(file, 0, "--near %g: a perspective view needs a near plane beyond 0", o->near_z);
    if (o->has_far && o->projection == ZS_PERSPECTIVE && o->far_z <= 0.0)
        return sim_refuse(file, 0, "--far %g: a perspective view needs a far plane beyond 0", o->far_z);
    if (o->has_near && o->has_far && o->near_z >= o->far_z)
        return sim_refuse(file, 0, "--near %g is not less than --far %g", o->near_z, o->far_z);
    if (o->has_eye && o->has_at && o->eye[0] == o->at[0] && o->eye[1] == o->at[1] && o->eye[2] == o->at[2])
        return sim_refuse(file, 0, "--eye equals --at: there is no direction to look in");
    if (o->up[0] == 0.0 && o->up[1] == 0.0 && o->up[2] == 0.0)
        return sim_refuse(file, 0, "--up 0,0,0 has no direction; try 0,1,0");
    if (o->light[0] == 0.0 && o->light[1] == 0.0 && o->light[2] == 0.0 && o->has_light)
        return sim_refuse(file, 0, "--light 0,0,0 has no direction");
    if (o->projection == ZS_ORTHOGRAPHIC && o->depth != SIM_DEPTH_DEFAULT && !sim_depths[o->depth].any_camera)
        return sim_refuse(file, 0, "--depth %s: an orthographic view takes linear depth only",
                          sim_depths[o->depth].name);
    if (o->texture != NULL && !sim_options_textured(o) && o->shade != SIM_SHADE_DEFAULT)
        return sim_refuse(file, 0,
                          "--texture %s is not drawn without --shade textured, textured-flat or "
                          "unlit",
                          o->texture);
    return SIM_OK;
}

static int check_panel(struct sim_options *o)
{
    struct pm_glass glass;
    if (o->panel.name == NULL && o->has_spi)
        return sim_usage("--spi is for a --panel, which is missing");
    if (o->panel.name != NULL && o->reference)
        return sim_usage("--reference does not go through a panel: leave --panel out, or use --compare");
    const int status = sim_panel_take(&o->panel, o->model, o->has_size, o->size, o->strip, &glass);
    if (o->panel.name != NULL && status == SIM_OK)
        o->effects.levels = pm_glass_format(&glass) == PM_MONO    ? SIM_LEVELS_MONO
                            : pm_glass_format(&glass) == PM_GREY4 ? SIM_LEVELS_GREY
                                                                  : SIM_LEVELS_565;
    if (o->panel.name != NULL && status == SIM_OK && !o->has_spi)
        o->spi_hz = sim_panel_hz(o->panel.name, SIM_PANEL_HZ);
    return status;
}

int sim_options_textured(const struct sim_options *o)
{
    return o->shade >= SIM_SHADE_TEXTURED && o->shade <= SIM_SHADE_UNLIT;
}

int sim_options_smooth(const struct sim_options *o)
{
    return o->shade == SIM_SHADE_SMOOTH || o->shade == SIM_SHADE_TEXTURED;
}

void sim_options_defaults(struct sim_options *o)
{
    memset(o, 0, sizeof *o);
    o->size[0] = o->size[1] = 240;
    o->strip = 16;
    o->line_width = 1;
    o->crease = 30.0;
    o->lines.kinds = ZS_EDGE_ALL;
    o->depth_bits = 16;
    o->buffers = 2;
    o->up[1] = 1.0;
    o->fov = 45.0;
    o->ambient = 0.25;
    o->diffuse = 0.75;
    o->shade = SIM_SHADE_DEFAULT;
    o->depth = SIM_DEPTH_DEFAULT;
    o->subpixel = 8;
    sim_effects_defaults(&o->effects);
    (void)sim_fast_take(&o->fast, NULL);
}

static int take_arguments(struct sim_options *o, char seen[N_TABLE], int argc, char **argv)
{
    int only_names = 0, status = SIM_OK;
    for (int i = 0; status == SIM_OK && i < argc; i++)
        status = !only_names && sim_is_option(argv[i]) ? sim_option_take(table, N_TABLE, o, seen, argc, argv, &i)
                                                       : sim_model_take(&o->model, argv[i], &only_names);
    return status;
}

static int check_method(const struct sim_options *o)
{
    const struct sim_method *method = &sim_methods[o->method];
    if (!method->method)
        return SIM_OK;
    if (o->reference)
        return sim_usage("--method is about the renderer: leave --reference out");
    if (!method->keys && o->depth_out)
        return sim_usage("--method %s keeps no depth keys: leave --depth-out out", method->name);
    if (method->depth && o->depth_bits != 16)
        return sim_usage("--method %s keeps no depth keys: leave --depth-bits out", method->name);
    if (o->show != SIM_SHOW_FRAME && o->show != SIM_SHOW_OVERDRAW)
        return sim_usage("--method %s: of --show there is overdraw", method->name);
    if (method->depth && o->depth != SIM_DEPTH_DEFAULT)
        return sim_usage("--method %s brings its depth mapping: leave --depth out", method->name);
    return SIM_OK;
}

/* What effects cannot be together with. */
static int check_effects(const struct sim_options *o)
{
    const struct sim_effect_options *e = &o->effects;
    const int lit = e->specular_text != NULL || e->per_pixel || e->n_lights > 0;
    if (!sim_effects_any(e))
        return SIM_OK;
    if (o->id_out != NULL)
        return sim_usage("effects have no numbers: leave --id-out out");
    const char *unknown = o->reference || o->compare ? sim_effects_unreferenced(e) : NULL;
    if (unknown != NULL)
        return sim_usage("%s is not known to the reference: leave it out, or --compare and --reference; lights, "
                         "--specular, --per-pixel, --alpha, --fog and --filter are compared", unknown);
    if (o->method != 0 || o->style != SIM_STYLE_SOLID)
        return sim_usage("effects are drawn by --method zbuffer and --style solid: leave those out");
    if (o->show != SIM_SHOW_FRAME || o->threads != 0 || (e->samples > 1 && o->depth_out != NULL))
        return sim_usage("effects: leave --show and --threads out, and --depth-out with --samples 4");
    if (e->samples > 1 && (o->size[0] > ZS_SIZE_MAX / 2 || o->size[1] > ZS_SIZE_MAX / 2))
        return sim_refuse(o->model, 0, "--samples 4: the frame may be at most %d px wide and high", ZS_SIZE_MAX / 2);
    if (e->n_lights > 0 && o->has_light)
        return sim_usage("--light x,y,z is the only light: write it as dir:x,y,z beside others");
    if (lit && o->shade != SIM_SHADE_FLAT && !sim_options_smooth(o) && o->shade != SIM_SHADE_DEFAULT)
        return sim_usage("--light TYPE:..., --specular and --per-pixel need --shade flat, smooth or textured");
    if (e->per_pixel && !sim_options_smooth(o))
        return sim_usage("--per-pixel needs --shade smooth or textured, which have normals at the vertices");
    if (e->shadow == SIM_SHADOW_MAP && !sim_options_smooth(o) && o->shade != SIM_SHADE_FLAT &&
        o->shade != SIM_SHADE_DEFAULT)
        return sim_usage("--shadow map needs --shade flat, smooth or textured");
    if (e->environment != NULL && o->shade != SIM_SHADE_SMOOTH)
        return sim_usage("--environment needs --shade smooth, since it goes by normals");
    if (e->filter != SIM_FILTER_NEAREST && !sim_options_textured(o) && e->environment == NULL)
        return sim_usage("--filter needs --shade textured, textured-flat or unlit, or an --environment");
    if (e->environment != NULL && (e->specular_text != NULL || e->per_pixel))
        return sim_usage("--environment has its lights in its picture: leave %s out, or --environment",
                         e->specular_text != NULL ? "--specular" : "--per-pixel");
    if (e->environment != NULL && e->n_lights > 0 && e->shadow == SIM_SHADOW_NONE)
        return sim_usage("--environment has its lights in its picture: leave --light TYPE:... out, or let it throw a "
                         "--shadow");
    const char *bits = e->environment != NULL           ? "--environment, whose picture has"
                       : e->per_pixel                   ? "--per-pixel, whose colours have"
                       : e->shadow == SIM_SHADOW_MAP    ? "--shadow map, whose colours have"
                                                        : NULL;
    if (bits != NULL && e->dither != SIM_DITHER_NONE && o->panel.name == NULL)
        return sim_usage("--dither and %s no more bits than RGB565: leave one out, or name a grey or one-bit --panel",
                         bits);
    if (e->filter == SIM_FILTER_MIPMAP && o->has_texel && o->texel != SIM_TEXEL_565)
        return sim_usage("--filter mipmap makes its levels in --texture-format 565: leave the other one out");
    if (e->has_blend && !e->has_alpha)
        return sim_usage("--blend needs --alpha, which says how much");
    return SIM_OK;
}

/* What is said of lines, where there are lines. */
static int take_lines(struct sim_options *o)
{
    const char *said = o->edges != NULL ? "--edges" : o->has_crease ? "--crease" : o->dash != NULL ? "--dash" : NULL;
    int status = SIM_OK;
    if (said != NULL && o->style != SIM_STYLE_WIRE && o->style != SIM_STYLE_HIDDEN_LINE)
        return sim_usage("%s is about lines: add --style wire or hidden-line", said);
    if (o->edges != NULL)
        status = sim_edges_take(&o->lines.kinds, o->edges);
    if (status == SIM_OK && o->has_crease && (o->edges == NULL || !(o->lines.kinds & ZS_EDGE_CREASE)))
        return sim_usage("--crease is the angle of --edges crease, which is missing");
    if (status == SIM_OK && o->dash != NULL)
        status = sim_dash_take(&o->lines.on, &o->lines.off, o->dash);
    return status;
}

static int check_style(const struct sim_options *o)
{
    if (o->style == SIM_STYLE_SOLID)
        return SIM_OK;
    if (o->reference || o->compare || o->id_out != NULL)
        return sim_usage(
            "--style: lines and points have no reference and no numbers: leave --reference, --compare and "
            "--id-out out");
    if (!sim_methods[o->method].keys)
        return sim_usage("--style: lines are drawn by --method zbuffer or hiz");
    if (o->show != SIM_SHOW_FRAME)
        return sim_usage("--style: leave --show out");
    return SIM_OK;
}

/* Does a name end as a picture of another kind? */
static int is_no_png(const char *name)
{
    static const char *const other[] = { ".jpg", ".jpeg", ".gif", ".bmp", ".ppm", ".webp", ".mp4" };
    const char *end = strrchr(name, '.');
    for (size_t k = 0; end != NULL && k < sizeof other / sizeof other[0]; k++)
        if (strcasecmp(end, other[k]) == 0)
            return 1;
    return 0;
}

int sim_options_parse(struct sim_options *o, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    sim_options_defaults(o);
    int status = take_arguments(o, seen, argc, argv);
    if (status != SIM_OK || o->help)
        return status;
    if (o->model == NULL || o->model[0] == '\0')
        return sim_usage("a model is missing: zsim render MODEL --out FRAME.png");
    if (o->out == NULL)
        return sim_usage("--out is missing: zsim render MODEL --out FRAME.png");
    if (o->turntable == 0 && is_no_png(o->out))
        return sim_usage("--out %s: the frame is a PNG; name it .png (--turntable writes GIF and MP4, too)", o->out);
    if (o->reference && o->compare)
        return sim_usage("--compare draws the reference too: leave --reference out");
    if (o->threads != 0 && o->reference)
        return sim_usage("--threads is about the renderer: leave --reference out");
    if (o->threads != 0 && o->panel.name != NULL)
        return sim_usage("--threads draws strips in any order, and a panel takes them from the top: leave one out");
    if (o->show != SIM_SHOW_FRAME && o->reference)
        return sim_usage("--show is about what the renderer does: leave --reference out");
    if (o->show != SIM_SHOW_FRAME && o->panel.name != NULL)
        return sim_usage("--show does not go through a panel: leave --panel out");
    if (o->turntable != 0 && (o->depth_out != NULL || o->id_out != NULL || o->stats != NULL || o->reference ||
                              o->compare || o->show != SIM_SHOW_FRAME))
        return sim_usage("--turntable writes pictures alone: leave --depth-out, --id-out, --stats, --reference, "
                         "--compare and --show out");
    status = sim_simplify_check(o->simplify);
    if (status != SIM_OK)
        return status;
    status = sim_effects_take(&o->effects, o->light, &o->has_light, o->model);
    if (status == SIM_OK)
        status = check_effects(o);
    if (status == SIM_OK)
        status = check_method(o);
    if (status == SIM_OK) /* what is wrong by itself, before what it does not go with */
        status = sim_options_in_range(table, N_TABLE, o, seen, o->model);
    if (status == SIM_OK)
        status = take_lines(o);
    if (status == SIM_OK)
        status = check_style(o);
    if (status == SIM_OK)
        status = sim_fast_take(&o->fast, o->fast_names);
    if (status == SIM_OK)
        status = check_rest(o);
    return status == SIM_OK ? check_panel(o) : status;
}
