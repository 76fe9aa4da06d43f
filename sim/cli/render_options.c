/* The table of options, and what they must not be together.
 *
 * SPDX-License-Identifier: MIT
 */
#include "render_options.h"

#include <stddef.h>
#include <string.h>

#include "frame.h"
#include "line_style.h"
#include "method_names.h"
#include "option_table.h"
#include "sim.h"

const char sim_options_help[] =
    "usage: zsim render MODEL --out FRAME.png [options]\n"
    "Draws a model (OBJ, PLY, STL, glTF and what else assimp reads) strip by strip, as boards do.\n"
    "\n"
    "Output\n"
    "  --out F.png          the frame; its 8-bit channels are the RGB565 bits, repeated\n"
    "  --depth-out D.pgm    depth keys, 16-bit PGM; 65535: nothing drawn\n"
    "  --id-out I.u32       little-endian uint32 a pixel: triangle in file order + 1; 0: none\n"
    "  --stats S.json       what the frame took, an object of numbers\n"
    "  --reference          all of it from the double-precision reference instead\n"
    "  --compare            draw both, print how far the frame is from the reference\n"
    "  --show depth|complexity|overdraw|tested|strips\n"
    "                       false colours and a legend in --out in place of the frame: distance; how many\n"
    "                       triangles cover a pixel, hidden ones too; how often it was written; how often\n"
    "                       a key was compared there; set-ups of each strip, as bars. --stats has the sum\n"
    "Frame\n"
    "  --size WxH           px, 1 to 4096 (240x240)\n"
    "  --strip ROWS         rows to a strip (16)\n"
    "  --depth float|recip|linear|e3m13|e4m12|e5m11\n"
    "                       mapping of depth keys (float: e3m13 while far <= 128 near, e4m12 while\n"
    "                       far <= 32768 near, else e5m11; orthographic views: linear)\n"
    "  --depth-bits N       8 to 16 (16)\n"
    "  --subpixel 4|8       sub-pixel bits (8)\n"
    "  --method " SIM_METHOD_WORDS "\n"
    "                       how hidden surfaces are removed (zbuffer); zsim gallery shows what each gets right and\n"
    "                       takes\n"
    "  --tris N, --verts N  pool sizes, up to 65534 (ample); small ones take more passes\n"
    "  --buffers 1|2        strip buffers (2)\n"
    "  --fast LIST          accelerators to draw with, the same frame: all, none, names with commas between,\n"
    "                       or all but some, as all-tiles-touch (all). There are:\n"
    "                       %s\n"
    "  --threads N          draw by N threads, 1 to 64, each with an arena of its own: the same frame;\n"
    "                       --stats has draw_us then, the time that drawing took, and draw_busiest_us, that\n"
    "                       of a processor for the thread that took most\n"
    "Panel\n"
    "  --panel NAME:WxH     the frame goes through this panel's driver and the model of its controller\n"
    "                       into --out: what its viewer sees. --size is its picture's then. There are:\n"
    "                       %s\n"
    "  --rotate DEGREES     0, 90, 180 or 270: how far the picture is turned clockwise on the glass (0)\n"
    "  --invert, --bgr      the glass shows negatives, or has blue for red, and the driver is told so\n"
    "  --spi HZ             clock of its wire, for the time in --stats (62500000; grey and one-bit\n"
    "                       panels 10000000)\n"
    "Camera, in the model's units; what is not given frames the model\n"
    "  --eye x,y,z --at x,y,z --up x,y,z (0,1,0)\n"
    "  --fov DEGREES        vertical (45); orthographic views show as much at --at\n"
    "  --near N --far F     distances along the view\n"
    "  --projection perspective|orthographic (perspective)\n"
    "Look\n"
    "  --shade id|flat|smooth|textured|textured-flat|unlit (flat)\n"
    "                       textured: texels times smooth light, textured-flat: times a face's,\n"
    "                       unlit: texels alone; faces without a texture: smooth, flat, raw\n"
    "  --style solid|wire|hidden-line|points\n"
    "                       the model's edges alone, those that its faces do not hide, or its vertices (solid),\n"
    "                       in white or the --color\n"
    "  --line-width N       px, of lines and points, 1 to 64 (1)\n"
    "  --texture T.png      one picture (PNG or JPEG) for all faces in place of the model's own.\n"
    "                       A side that is no power of two up to 1024 becomes the nearest one by\n"
    "                       averaging areas (texture_resampled of --stats); alpha is dropped\n"
    "  --texture-format 565|pal8|pal4\n"
    "                       how texels are stored: RGB565, or 256 or 16 colours of it (565)\n"
    "  --wrap repeat|clamp  beyond the picture's border (as the model says, else repeat)\n"
    "  --cull back|front|none (back)\n"
    "  --background RRGGBB (000000)\n"
    "  --color RRGGBB       one colour for the whole model\n"
    "  --light x,y,z        direction towards the light (over the camera's left shoulder)\n"
    "  --ambient A --diffuse D  0 to 1 (0.25, 0.75)\n"
    "\n"
    "An option's value may follow after a space or an equals sign.\n"
    "Exit status: 0 done; 1 refused, nothing written; 2 the command line makes no sense.\n";

#define AT(field) offsetof(struct sim_options, field)

static const struct sim_option table[] = {
    { "--out", SIM_OPTION_FILE, AT(out) }, { "--depth-out", SIM_OPTION_FILE, AT(depth_out) },
    { "--id-out", SIM_OPTION_FILE, AT(id_out) }, { "--stats", SIM_OPTION_FILE, AT(stats) },
    { "--size", SIM_OPTION_SIZE, AT(size), AT(has_size), 1, ZS_SIZE_MAX },
    { "--strip", SIM_OPTION_COUNT, AT(strip) },
    { "--tris", SIM_OPTION_COUNT, AT(tris), 0, 1, ZS_POOL_MAX },
    { "--verts", SIM_OPTION_COUNT, AT(verts), 0, 3, ZS_POOL_MAX },
    { "--depth-bits", SIM_OPTION_COUNT, AT(depth_bits), 0, 8, 16 },
    { "--fast", SIM_OPTION_TEXT, AT(fast_names) },
    { "--threads", SIM_OPTION_COUNT, AT(threads), 0, 1, SIM_THREADS_MAX },
    { "--subpixel", SIM_OPTION_COUNT, AT(subpixel), .words = "4|8" },
    { "--buffers", SIM_OPTION_COUNT, AT(buffers), .words = "1|2" },
    { "--eye", SIM_OPTION_VECTOR, AT(eye), AT(has_eye) }, { "--at", SIM_OPTION_VECTOR, AT(at), AT(has_at) },
    { "--up", SIM_OPTION_VECTOR, AT(up) }, { "--light", SIM_OPTION_VECTOR, AT(light), AT(has_light) },
    { "--fov", SIM_OPTION_NUMBER, AT(fov) }, { "--near", SIM_OPTION_NUMBER, AT(near_z), AT(has_near) },
    { "--far", SIM_OPTION_NUMBER, AT(far_z), AT(has_far) },
    { "--ambient", SIM_OPTION_NUMBER, AT(ambient), 0, 0, 1 },
    { "--diffuse", SIM_OPTION_NUMBER, AT(diffuse), 0, 0, 1 },
    { "--background", SIM_OPTION_RGB, AT(background) }, { "--color", SIM_OPTION_RGB, AT(color), AT(has_color) },
    { "--projection", SIM_OPTION_CHOICE, AT(projection), .words = "perspective|orthographic" },
    { "--depth", SIM_OPTION_CHOICE, AT(depth), .words = "recip|linear|e3m13|e4m12|e5m11|float" },
    { "--shade", SIM_OPTION_CHOICE, AT(shade), .words = "id|flat|smooth|textured|textured-flat|unlit" },
    { "--texture", SIM_OPTION_FILE, AT(texture) },
    { "--texture-format", SIM_OPTION_CHOICE, AT(texel), .words = "565|pal8|pal4" },
    { "--wrap", SIM_OPTION_CHOICE, AT(clamp), AT(has_wrap), .words = "repeat|clamp" },
    { "--show", SIM_OPTION_CHOICE, AT(show), .words = SIM_SHOW_WORDS },
    { "--style", SIM_OPTION_CHOICE, AT(style), .words = SIM_STYLE_WORDS },
    { "--line-width", SIM_OPTION_COUNT, AT(line_width), 0, 1, 64 },
    { "--method", SIM_OPTION_CHOICE, AT(method), .words = SIM_METHOD_WORDS },
    { "--cull", SIM_OPTION_CHOICE, AT(cull), .words = "back|front|none" },
    SIM_PANEL_OPTIONS(struct sim_options, panel),
    { "--spi", SIM_OPTION_COUNT, AT(spi_hz), AT(has_spi), 1000, 1e9 },
    { "--reference", SIM_OPTION_FLAG, AT(reference) }, { "--compare", SIM_OPTION_FLAG, AT(compare) },
    SIM_HELP_OPTIONS(AT(help)),
};

#define N_TABLE (sizeof table / sizeof table[0])

static int check_rest(const struct sim_options *o)
{
    const char *file = o->model;
    if (o->strip < 1)
        return sim_refuse(file, 0, "--strip %ld: a strip has at least 1 row", o->strip);
    if (!(o->fov > 0.0 && o->fov < 180.0))
        return sim_refuse(file, 0, "--fov %g: the field of view lies between 0 and 180 degrees",
                          o->fov);
    if (o->has_near && o->projection == ZS_PERSPECTIVE && o->near_z <= 0.0)
        return sim_refuse(file, 0, "--near %g: a perspective view needs a near plane beyond 0",
                          o->near_z);
    if (o->has_far && o->projection == ZS_PERSPECTIVE && o->far_z <= 0.0)
        return sim_refuse(file, 0, "--far %g: a perspective view needs a far plane beyond 0",
                          o->far_z);
    if (o->has_near && o->has_far && o->near_z >= o->far_z)
        return sim_refuse(file, 0, "--near %g is not less than --far %g", o->near_z, o->far_z);
    if (o->has_eye && o->has_at && o->eye[0] == o->at[0] && o->eye[1] == o->at[1] &&
        o->eye[2] == o->at[2])
        return sim_refuse(file, 0, "--eye equals --at: there is no direction to look in");
    if (o->up[0] == 0.0 && o->up[1] == 0.0 && o->up[2] == 0.0)
        return sim_refuse(file, 0, "--up 0,0,0 has no direction; try 0,1,0");
    if (o->light[0] == 0.0 && o->light[1] == 0.0 && o->light[2] == 0.0 && o->has_light)
        return sim_refuse(file, 0, "--light 0,0,0 has no direction");
    if (o->projection == ZS_ORTHOGRAPHIC && o->depth != SIM_DEPTH_LINEAR &&
        o->depth != SIM_DEPTH_DEFAULT)
        return sim_refuse(file, 0, "--depth %s: an orthographic view takes linear depth only",
                          o->depth == SIM_DEPTH_RECIP   ? "recip"
                          : o->depth == SIM_DEPTH_E3M13 ? "e3m13"
                          : o->depth == SIM_DEPTH_E4M12 ? "e4m12"
                          : o->depth == SIM_DEPTH_E5M11 ? "e5m11"
                                                        : "float");
    if (o->texture != NULL && !sim_options_textured(o))
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
    if (o->panel.name != NULL && status == SIM_OK && !o->has_spi)
        o->spi_hz = pm_glass_format(&glass) == PM_RGB565 ? 62500000 : 10000000;
    return status;
}

int sim_options_textured(const struct sim_options *o)
{
    return o->shade >= SIM_SHADE_TEXTURED;
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
    o->depth_bits = 16;
    o->buffers = 2;
    o->up[1] = 1.0;
    o->fov = 45.0;
    o->ambient = 0.25;
    o->diffuse = 0.75;
    o->shade = SIM_SHADE_FLAT;
    o->depth = SIM_DEPTH_DEFAULT;
    o->subpixel = 8;
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
    if (o->show != SIM_SHOW_FRAME && o->show != SIM_SHOW_OVERDRAW)
        return sim_usage("--method %s: of --show there is overdraw", method->name);
    if (method->depth && o->depth != SIM_DEPTH_DEFAULT)
        return sim_usage("--method %s brings its depth mapping: leave --depth out", method->name);
    return SIM_OK;
}

static int check_style(const struct sim_options *o)
{
    if (o->style == SIM_STYLE_SOLID)
        return SIM_OK;
    if (o->reference || o->compare || o->id_out != NULL)
        return sim_usage("--style: lines and points have no reference and no numbers: leave --reference, --compare and "
                         "--id-out out");
    if (!sim_methods[o->method].keys)
        return sim_usage("--style: lines are drawn by --method zbuffer or hiz");
    if (o->show != SIM_SHOW_FRAME)
        return sim_usage("--style: leave --show out");
    return SIM_OK;
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
    status = check_method(o);
    if (status == SIM_OK)
        status = check_style(o);
    if (status == SIM_OK)
        status = sim_fast_take(&o->fast, o->fast_names);
    if (status != SIM_OK)
        return status;
    status = sim_options_in_range(table, N_TABLE, o, seen, o->model);
    if (status == SIM_OK)
        status = check_rest(o);
    return status == SIM_OK ? check_panel(o) : status;
}
