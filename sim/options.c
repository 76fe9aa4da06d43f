/* Parsing: one table of options, one function for each kind of value. A value that is not of its
 * kind is a usage error; one that is, but lies outside its range, is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include "options.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "value.h"

#define COORD_MAX 1e30 /* keeps products of three lengths inside a double */

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
    "Frame\n"
    "  --size WxH           px, 1 to 4096 (240x240)\n"
    "  --strip ROWS         rows to a strip (16)\n"
    "  --depth float|recip|linear|e3m13|e4m12|e5m11\n"
    "                       mapping of depth keys (float: e3m13 while far <= 128 near, e4m12 while\n"
    "                       far <= 32768 near, else e5m11; orthographic views: linear)\n"
    "  --depth-bits N       8 to 16 (16)\n"
    "  --subpixel 4|8       sub-pixel bits (8)\n"
    "  --tris N, --verts N  pool sizes, up to 65534 (ample); small ones take more passes\n"
    "  --buffers 1|2        strip buffers (2)\n"
    "  --skip-off BITS      switch skips off, enum zs_skip or-ed (0)\n"
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

enum kind {
    KIND_FILE,
    KIND_SIZE,
    KIND_COUNT,
    KIND_NUMBER,
    KIND_VECTOR,
    KIND_RGB,
    KIND_CHOICE,
    KIND_FLAG
};

/* Choices are written as the number of the word; the enums of struct sim_options count alike. */
struct option {
    const char *name;
    enum kind kind;
    size_t to;         /* offset of the value: const char *, long, double, struct zs_rgb, int ... */
    size_t has;        /* offset of an int that becomes 1; 0: none */
    double lo, hi;     /* range of a count or number, both ends inside; equal: none */
    const char *words; /* "a|b|c": choices, or the only counts there are; else NULL */
};

#define AT(field) offsetof(struct sim_options, field)

static const struct option table[] = {
    { "--out", KIND_FILE, AT(out), 0, 0, 0, NULL },
    { "--depth-out", KIND_FILE, AT(depth_out), 0, 0, 0, NULL },
    { "--id-out", KIND_FILE, AT(id_out), 0, 0, 0, NULL },
    { "--stats", KIND_FILE, AT(stats), 0, 0, 0, NULL },
    { "--size", KIND_SIZE, AT(size), AT(has_size), 0, 0, NULL },
    { "--strip", KIND_COUNT, AT(strip), 0, 0, 0, NULL },
    { "--tris", KIND_COUNT, AT(tris), 0, 1, ZS_POOL_MAX, NULL },
    { "--verts", KIND_COUNT, AT(verts), 0, 3, ZS_POOL_MAX, NULL },
    { "--depth-bits", KIND_COUNT, AT(depth_bits), 0, 8, 16, NULL },
    { "--skip-off", KIND_COUNT, AT(skip_off), 0, 0, 63, NULL },
    { "--subpixel", KIND_COUNT, AT(subpixel), 0, 0, 0, "4|8" },
    { "--buffers", KIND_COUNT, AT(buffers), 0, 0, 0, "1|2" },
    { "--eye", KIND_VECTOR, AT(eye), AT(has_eye), 0, 0, NULL },
    { "--at", KIND_VECTOR, AT(at), AT(has_at), 0, 0, NULL },
    { "--up", KIND_VECTOR, AT(up), 0, 0, 0, NULL },
    { "--light", KIND_VECTOR, AT(light), AT(has_light), 0, 0, NULL },
    { "--fov", KIND_NUMBER, AT(fov), 0, 0, 0, NULL },
    { "--near", KIND_NUMBER, AT(near_z), AT(has_near), 0, 0, NULL },
    { "--far", KIND_NUMBER, AT(far_z), AT(has_far), 0, 0, NULL },
    { "--ambient", KIND_NUMBER, AT(ambient), 0, 0, 1, NULL },
    { "--diffuse", KIND_NUMBER, AT(diffuse), 0, 0, 1, NULL },
    { "--background", KIND_RGB, AT(background), 0, 0, 0, NULL },
    { "--color", KIND_RGB, AT(color), AT(has_color), 0, 0, NULL },
    { "--projection", KIND_CHOICE, AT(projection), 0, 0, 0, "perspective|orthographic" },
    { "--depth", KIND_CHOICE, AT(depth), 0, 0, 0, "recip|linear|e3m13|e4m12|e5m11|float" },
    { "--shade", KIND_CHOICE, AT(shade), 0, 0, 0, "id|flat|smooth|textured|textured-flat|unlit" },
    { "--texture", KIND_FILE, AT(texture), 0, 0, 0, NULL },
    { "--texture-format", KIND_CHOICE, AT(texel), 0, 0, 0, "565|pal8|pal4" },
    { "--wrap", KIND_CHOICE, AT(clamp), AT(has_wrap), 0, 0, "repeat|clamp" },
    { "--cull", KIND_CHOICE, AT(cull), 0, 0, 0, "back|front|none" },
    { "--panel", KIND_FILE, AT(panel.name), 0, 0, 0, NULL },
    { "--rotate", KIND_CHOICE, AT(panel.turns), AT(has_turns), 0, 0, "0|90|180|270" },
    { "--invert", KIND_FLAG, AT(panel.invert), 0, 0, 0, NULL },
    { "--bgr", KIND_FLAG, AT(panel.bgr), 0, 0, 0, NULL },
    { "--spi", KIND_COUNT, AT(spi_hz), AT(has_spi), 1000, 1e9, NULL },
    { "--reference", KIND_FLAG, AT(reference), 0, 0, 0, NULL },
    { "--compare", KIND_FLAG, AT(compare), 0, 0, 0, NULL },
    { "--help", KIND_FLAG, AT(help), 0, 0, 0, NULL },
    { "-h", KIND_FLAG, AT(help), 0, 0, 0, NULL },
};

#define N_TABLE (sizeof table / sizeof table[0])

static int take_vector(const char *text, double v[3])
{
    const char *end;
    return sim_value_double(text, ',', &end, &v[0]) && sim_value_double(end + 1, ',', &end, &v[1]) &&
           sim_value_double(end + 1, '\0', &end, &v[2]);
}

static int take_count(const char *text, const char *words, long *count)
{
    const char *end;
    return (words == NULL || sim_value_choice(text, words) >= 0) && sim_value_long(text, &end, count) &&
           *end == '\0';
}

/* A value into its place; 0 where it is not of its option's kind. */
static int take_value(const struct option *opt, const char *text, void *to)
{
    const char *end;
    int word;
    switch (opt->kind) {
    case KIND_FILE:
        *(const char **)to = text;
        return text[0] != '\0';
    case KIND_SIZE:
        return sim_value_size(text, to);
    case KIND_COUNT:
        return take_count(text, opt->words, to);
    case KIND_NUMBER:
        return sim_value_double(text, '\0', &end, to);
    case KIND_VECTOR:
        return take_vector(text, to);
    case KIND_RGB:
        return sim_value_rgb(text, to);
    case KIND_CHOICE:
        word = sim_value_choice(text, opt->words);
        *(int *)to = word >= 0 ? word : 0;
        return word >= 0;
    case KIND_FLAG:
        break;
    }
    return 0;
}

static const char *wanted(const struct option *opt)
{
    static const char *const names[] = {
        [KIND_FILE] = "a file name",      [KIND_SIZE] = "WIDTHxHEIGHT",
        [KIND_COUNT] = "a whole number",  [KIND_NUMBER] = "a number",
        [KIND_VECTOR] = "numbers x,y,z",  [KIND_RGB] = "a colour RRGGBB",
        [KIND_CHOICE] = "a word",         [KIND_FLAG] = "no value",
    };
    return opt->words != NULL ? opt->words : names[opt->kind];
}

/* What is understood and still cannot be done. file: the model, to name it. */
static int check_range(const struct option *opt, const void *at, const char *file)
{
    const int is_number = opt->kind == KIND_NUMBER, is_vector = opt->kind == KIND_VECTOR;
    const double *v = at;
    for (int k = 0; is_number || (is_vector && k < 3); k++) {
        if (!isfinite(v[k]))
            return sim_refuse(
                file, 0, "%s holds a number that is not finite; give ordinary numbers", opt->name);
        if (fabs(v[k]) > COORD_MAX)
            return sim_refuse(file, 0, "%s %g is beyond %g; scale the scene down", opt->name, v[k],
                              COORD_MAX);
        if (is_number)
            break;
    }
    const double value = is_number                 ? v[0]
                         : opt->kind == KIND_COUNT ? (double)*(const long *)at
                                                   : 0.0;
    if (opt->lo < opt->hi && (value < opt->lo || value > opt->hi))
        return sim_refuse(file, 0, "%s %g is outside its range, %g to %g", opt->name, value,
                          opt->lo, opt->hi);
    return SIM_OK;
}

static int check_rest(const struct sim_options *o)
{
    const char *file = o->model;
    for (int k = 0; k < 2; k++)
        if (o->size[k] < 1 || o->size[k] > ZS_SIZE_MAX)
            return sim_refuse(file, 0, "--size %ldx%ld: the frame must be 1 to %d px wide and high",
                              o->size[0], o->size[1], ZS_SIZE_MAX);
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

/* A panel's picture is the frame: takes its size over. */
static int check_panel(struct sim_options *o)
{
    struct panel_config config;
    struct pm_glass glass;
    if (o->panel.name == NULL && (o->has_turns || o->panel.invert || o->panel.bgr || o->has_spi))
        return sim_usage("%s is for a --panel, which is missing", o->has_turns      ? "--rotate"
                                                                 : o->panel.invert ? "--invert"
                                                                 : o->panel.bgr    ? "--bgr"
                                                                                   : "--spi");
    if (o->panel.name == NULL)
        return SIM_OK;
    if (o->reference)
        return sim_usage("--reference does not go through a panel: leave --panel out, or use --compare");
    const int status = sim_panel_of(&o->panel, o->model, &config, &glass);
    if (status != SIM_OK)
        return status;
    const int turned = o->panel.turns & 1;
    const long w = turned ? glass.height : glass.width, h = turned ? glass.width : glass.height;
    if (o->has_size && (o->size[0] != w || o->size[1] != h))
        return sim_refuse(o->model, 0,
                          "--size %ldx%ld is not the picture of --panel %s --rotate %d, %ldx%ld; leave it out",
                          o->size[0], o->size[1], o->panel.name, 90 * o->panel.turns, w, h);
    o->size[0] = w;
    o->size[1] = h;
    if (!o->has_spi)
        o->spi_hz = pm_glass_format(&glass) == PM_RGB565 ? 62500000 : 10000000;
    return sim_panel_check_strip(&o->panel, o->model, o->strip, h);
}

int sim_options_textured(const struct sim_options *o)
{
    return o->shade >= SIM_SHADE_TEXTURED;
}

int sim_options_smooth(const struct sim_options *o)
{
    return o->shade == SIM_SHADE_SMOOTH || o->shade == SIM_SHADE_TEXTURED;
}

static void set_defaults(struct sim_options *o)
{
    memset(o, 0, sizeof *o);
    o->size[0] = o->size[1] = 240;
    o->strip = 16;
    o->depth_bits = 16;
    o->buffers = 2;
    o->up[1] = 1.0;
    o->fov = 45.0;
    o->ambient = 0.25;
    o->diffuse = 0.75;
    o->shade = SIM_SHADE_FLAT;
    o->depth = SIM_DEPTH_DEFAULT;
    o->subpixel = 8;
}

static const struct option *find(const char *arg, size_t length)
{
    for (size_t k = 0; k < N_TABLE; k++)
        if (strlen(table[k].name) == length && memcmp(table[k].name, arg, length) == 0)
            return &table[k];
    return NULL;
}

/* One option with its value, at argv[*i]. */
static int take_option(struct sim_options *o, char seen[N_TABLE], int argc, char **argv, int *i)
{
    const char *arg = argv[*i];
    const size_t length = strcspn(arg, "=");
    const struct option *opt = find(arg, length);
    if (opt == NULL)
        return sim_usage("unknown option '%s'", arg);
    char *base = (char *)o;
    const char *value = arg[length] == '=' ? arg + length + 1 : NULL;
    seen[opt - table] = 1;
    if (opt->kind == KIND_FLAG && value == NULL) {
        *(int *)(void *)(base + opt->to) = 1;
        return SIM_OK;
    }
    if (value == NULL && *i + 1 >= argc)
        return sim_usage("%s wants a value: %s", opt->name, wanted(opt));
    if (value == NULL)
        value = argv[++*i];
    if (!take_value(opt, value, base + opt->to))
        return sim_usage("%s wants %s, not '%s'", opt->name, wanted(opt), value);
    if (opt->has != 0)
        *(int *)(void *)(base + opt->has) = 1;
    return SIM_OK;
}

static int take_arguments(struct sim_options *o, char seen[N_TABLE], int argc, char **argv)
{
    int only_names = 0;
    for (int i = 0; i < argc; i++) {
        int status = SIM_OK;
        if (!only_names && strcmp(argv[i], "--") == 0)
            only_names = 1;
        else if (!only_names && argv[i][0] == '-' && argv[i][1] != '\0')
            status = take_option(o, seen, argc, argv, &i);
        else if (o->model != NULL)
            status = sim_usage("one model at a time: '%s' is one too many", argv[i]);
        else
            o->model = argv[i];
        if (status != SIM_OK)
            return status;
    }
    return SIM_OK;
}

int sim_options_parse(struct sim_options *o, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    set_defaults(o);
    int status = take_arguments(o, seen, argc, argv);
    if (status != SIM_OK || o->help)
        return status;
    if (o->model == NULL || o->model[0] == '\0')
        return sim_usage("a model is missing: zsim render MODEL --out FRAME.png");
    if (o->out == NULL)
        return sim_usage("--out is missing: zsim render MODEL --out FRAME.png");
    if (o->reference && o->compare)
        return sim_usage("--compare draws the reference too: leave --reference out");
    for (size_t k = 0; status == SIM_OK && k < N_TABLE; k++)
        if (seen[k])
            status = check_range(&table[k], (const char *)o + table[k].to, o->model);
    if (status == SIM_OK)
        status = check_rest(o);
    return status == SIM_OK ? check_panel(o) : status;
}
