/* Parsing: one table of options, one function for each kind of value. A value that is not of its
 * kind is a usage error; one that is, but lies outside its range, is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include "options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

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
    "  --depth recip|linear mapping of depth keys (recip; linear for orthographic views)\n"
    "  --depth-bits N       8 to 16 (16)\n"
    "  --subpixel 4|8       sub-pixel bits (8)\n"
    "  --tris N, --verts N  pool sizes, up to 65534 (ample); small ones take more passes\n"
    "  --buffers 1|2        strip buffers (2)\n"
    "  --skip-off BITS      switch skips off, enum zs_skip or-ed (0)\n"
    "Camera, in the model's units; what is not given frames the model\n"
    "  --eye x,y,z --at x,y,z --up x,y,z (0,1,0)\n"
    "  --fov DEGREES        vertical (45); orthographic views show as much at --at\n"
    "  --near N --far F     distances along the view\n"
    "  --projection perspective|orthographic (perspective)\n"
    "Look\n"
    "  --shade id|flat|smooth (flat)\n"
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

struct option {
    const char *name;
    enum kind kind;
    void *to;          /* const char *, long, double, double[3], struct zs_rgb, enum, int */
    int *has;          /* set to 1, or NULL */
    double lo, hi;     /* range of a count or number, both ends inside */
    const char *words; /* choices "a|b|c": number 0, 1, 2 */
};

/* A whole string that is an integer. */
static int parse_long(const char *text, const char **end, long *out)
{
    char *e;
    errno = 0;
    *out = strtol(text, &e, 10); /* saturates */
    *end = e;
    return e != text && !(text[0] >= '\t' && text[0] <= ' ');
}

/* One decimal number up to `stop`; may come out infinite or NaN. */
static int parse_double(const char *text, char stop, const char **end, double *out)
{
    char *e;
    if (text[0] <= ' ' || strspn(text, "+-0123456789.eEinfatyINFATY") == 0)
        return 0;
    for (const char *p = text; *p != '\0' && *p != stop; p++)
        if (*p == 'x' || *p == 'X') /* no hexadecimal */
            return 0;
    *out = strtod(text, &e);
    *end = e;
    return e != text && *e == stop;
}

static int parse_rgb(const char *text, struct zs_rgb *out)
{
    if (text[0] == '#')
        text++;
    if (strlen(text) != 6 || strspn(text, "0123456789abcdefABCDEF") != 6)
        return 0;
    const unsigned long v = strtoul(text, NULL, 16);
    out->r = (uint8_t)(v >> 16);
    out->g = (uint8_t)(v >> 8);
    out->b = (uint8_t)v;
    return 1;
}

/* The place of a word in "a|b|c", or -1. */
static int parse_choice(const char *text, const char *words)
{
    const size_t n = strlen(text);
    for (int i = 0; words != NULL; i++) {
        const char *bar = strchr(words, '|');
        const size_t length = bar != NULL ? (size_t)(bar - words) : strlen(words);
        if (length == n && memcmp(words, text, n) == 0)
            return i;
        words = bar != NULL ? bar + 1 : NULL;
    }
    return -1;
}

static int take_size(const struct option *opt, const char *text)
{
    long *size = opt->to;
    const char *end;
    if (!parse_long(text, &end, &size[0]) || (*end != 'x' && *end != 'X') ||
        !parse_long(end + 1, &end, &size[1]) || *end != '\0')
        return sim_usage("--size wants WIDTHxHEIGHT, not '%s'", text);
    return SIM_OK;
}

static int take_count(const struct option *opt, const char *text)
{
    const char *end;
    if (!parse_long(text, &end, opt->to) || *end != '\0')
        return sim_usage("%s wants a whole number, not '%s'", opt->name, text);
    return SIM_OK;
}

static int take_vector(const struct option *opt, const char *text)
{
    double *v = opt->to;
    const char *end;
    if (!parse_double(text, ',', &end, &v[0]) || !parse_double(end + 1, ',', &end, &v[1]) ||
        !parse_double(end + 1, '\0', &end, &v[2]))
        return sim_usage("%s wants three numbers x,y,z, not '%s'", opt->name, text);
    return SIM_OK;
}

static int take_value(const struct option *opt, const char *text)
{
    const char *end;
    int i;
    if (opt->has != NULL)
        *opt->has = 1;
    switch (opt->kind) {
    case KIND_FILE:
        *(const char **)opt->to = text;
        return text[0] != '\0' ? SIM_OK : sim_usage("%s wants a file name", opt->name);
    case KIND_SIZE:
        return take_size(opt, text);
    case KIND_COUNT:
        return take_count(opt, text);
    case KIND_NUMBER:
        if (!parse_double(text, '\0', &end, opt->to))
            return sim_usage("%s wants a number, not '%s'", opt->name, text);
        return SIM_OK;
    case KIND_VECTOR:
        return take_vector(opt, text);
    case KIND_RGB:
        if (!parse_rgb(text, opt->to))
            return sim_usage("%s wants a colour RRGGBB, not '%s'", opt->name, text);
        return SIM_OK;
    case KIND_CHOICE:
        i = parse_choice(text, opt->words);
        if (i < 0)
            return sim_usage("%s wants %s, not '%s'", opt->name, opt->words, text);
        *(int *)opt->to = i;
        return SIM_OK;
    case KIND_FLAG:
        break;
    }
    return sim_usage("%s takes no value", opt->name);
}

/* What is understood and still cannot be done. file: the model, to name it. */
static int check_range(const struct option *opt, const char *file)
{
    const int is_number = opt->kind == KIND_NUMBER, is_vector = opt->kind == KIND_VECTOR;
    const double *v = opt->to;
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
                         : opt->kind == KIND_COUNT ? (double)*(long *)opt->to
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
    if (o->projection == ZS_ORTHOGRAPHIC && o->depth == SIM_DEPTH_RECIP)
        return sim_refuse(file, 0, "--depth recip: an orthographic view takes linear depth only");
    return SIM_OK;
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
}

int sim_options_parse(struct sim_options *o, int argc, char **argv)
{
    int projection = 0, depth = -1, shade = SIM_SHADE_FLAT, cull = 0, subpixel = 1, buffers = 1;
    int positional_only = 0;
    set_defaults(o);
    const double pool = ZS_POOL_MAX;
    const struct option table[] = {
        { "--out", KIND_FILE, &o->out, NULL, 0, 0, NULL },
        { "--depth-out", KIND_FILE, &o->depth_out, NULL, 0, 0, NULL },
        { "--id-out", KIND_FILE, &o->id_out, NULL, 0, 0, NULL },
        { "--stats", KIND_FILE, &o->stats, NULL, 0, 0, NULL },
        { "--size", KIND_SIZE, o->size, NULL, 0, 0, NULL },
        { "--strip", KIND_COUNT, &o->strip, NULL, 0, 0, NULL },
        { "--tris", KIND_COUNT, &o->tris, &(int){ 0 }, 1, pool, NULL },
        { "--verts", KIND_COUNT, &o->verts, &(int){ 0 }, 3, pool, NULL },
        { "--depth-bits", KIND_COUNT, &o->depth_bits, NULL, 8, 16, NULL },
        { "--skip-off", KIND_COUNT, &o->skip_off, NULL, 0, 31, NULL },
        { "--eye", KIND_VECTOR, o->eye, &o->has_eye, 0, 0, NULL },
        { "--at", KIND_VECTOR, o->at, &o->has_at, 0, 0, NULL },
        { "--up", KIND_VECTOR, o->up, NULL, 0, 0, NULL },
        { "--light", KIND_VECTOR, o->light, &o->has_light, 0, 0, NULL },
        { "--fov", KIND_NUMBER, &o->fov, NULL, 0, 0, NULL },
        { "--near", KIND_NUMBER, &o->near_z, &o->has_near, 0, 0, NULL },
        { "--far", KIND_NUMBER, &o->far_z, &o->has_far, 0, 0, NULL },
        { "--ambient", KIND_NUMBER, &o->ambient, NULL, 0, 1, NULL },
        { "--diffuse", KIND_NUMBER, &o->diffuse, NULL, 0, 1, NULL },
        { "--background", KIND_RGB, &o->background, NULL, 0, 0, NULL },
        { "--color", KIND_RGB, &o->color, &o->has_color, 0, 0, NULL },
        { "--projection", KIND_CHOICE, &projection, NULL, 0, 0, "perspective|orthographic" },
        { "--depth", KIND_CHOICE, &depth, NULL, 0, 0, "recip|linear" },
        { "--shade", KIND_CHOICE, &shade, NULL, 0, 0, "id|flat|smooth" },
        { "--cull", KIND_CHOICE, &cull, NULL, 0, 0, "back|front|none" },
        { "--subpixel", KIND_CHOICE, &subpixel, NULL, 0, 0, "4|8" },
        { "--buffers", KIND_CHOICE, &buffers, NULL, 0, 0, "1|2" },
        { "--reference", KIND_FLAG, &o->reference, NULL, 0, 0, NULL },
        { "--compare", KIND_FLAG, &o->compare, NULL, 0, 0, NULL },
        { "--help", KIND_FLAG, &o->help, NULL, 0, 0, NULL },
    };
    const size_t n_table = sizeof table / sizeof table[0];
    int seen[sizeof table / sizeof table[0]] = { 0 };

    for (int i = 0; i < argc; i++) {
        const char *arg = argv[i];
        if (!positional_only && strcmp(arg, "--") == 0) {
            positional_only = 1;
            continue;
        }
        if (positional_only || arg[0] != '-' || arg[1] == '\0') {
            if (o->model != NULL)
                return sim_usage("one model at a time: '%s' is one too many", arg);
            o->model = arg;
            continue;
        }
        const size_t length = strcspn(arg, "=");
        size_t k = 0;
        while (k < n_table &&
               (strlen(table[k].name) != length || memcmp(table[k].name, arg, length) != 0))
            k++;
        if (strcmp(arg, "-h") == 0) {
            o->help = 1;
            continue;
        }
        if (k == n_table)
            return sim_usage("unknown option '%s'", arg);
        seen[k] = 1;
        if (table[k].kind == KIND_FLAG && arg[length] == '\0') {
            *(int *)table[k].to = 1;
            continue;
        }
        if (arg[length] == '\0' && i + 1 >= argc)
            return sim_usage("%s wants a value", table[k].name);
        const int status = take_value(&table[k], arg[length] == '=' ? arg + length + 1 : argv[++i]);
        if (status != SIM_OK)
            return status;
    }
    if (o->help)
        return SIM_OK;
    if (o->model == NULL || o->model[0] == '\0')
        return sim_usage("a model is missing: zsim render MODEL --out FRAME.png");
    if (o->out == NULL)
        return sim_usage("--out is missing: zsim render MODEL --out FRAME.png");
    if (o->reference && o->compare)
        return sim_usage("--compare draws the reference too: leave --reference out");
    o->projection = projection ? ZS_ORTHOGRAPHIC : ZS_PERSPECTIVE;
    o->depth = (enum sim_depth)(depth + 1);
    o->shade = (enum sim_shade)shade;
    o->cull = (enum zs_cull)cull;
    o->subpixel = subpixel ? 8 : 4;
    o->buffers = buffers + 1;
    for (size_t k = 0; k < n_table; k++) {
        const int status = seen[k] ? check_range(&table[k], o->model) : SIM_OK;
        if (status != SIM_OK)
            return status;
    }
    return check_rest(o);
}
