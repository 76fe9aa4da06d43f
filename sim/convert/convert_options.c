/* Parsing of `zsim convert`: one table of options. A value that is not of its kind is a usage
 * error; one that is, but lies outside its range, is refused.
 *
 * SPDX-License-Identifier: MIT
 */
#include "convert_options.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "sim.h"
#include "value.h"

#define NAME_MAX_CHARS 40
#define UNIT_MIN 1e-30
#define UNIT_MAX 1e30

const char sim_convert_help[] =
    "usage: zsim convert MODEL --name NAME --out DIR [options]\n"
    "Turns a model (OBJ, glTF, STL, PLY and what else assimp reads) or a picture (PNG, JPEG) into\n"
    "const C for firmware: DIR/NAME.h and DIR/NAME.c, and prints what they take.\n"
    "\n"
    "  --name NAME          what every name in them begins with; a C identifier\n"
    "  --out DIR            the folder, made if there is none\n"
    "Mesh\n"
    "  --shade flat|smooth|textured|textured-flat|unlit|raw\n"
    "                       the shader, and with it what is written: normals, texture "
    "coordinates,\n"
    "                       colours (textured if the model has a texture, else smooth if the file "
    "has\n"
    "                       normals, else flat). textured is smooth too; parts without texture "
    "are\n"
    "                       smooth, flat or raw. unlit: texels as they are; raw: colours as they "
    "are\n"
    "  --unit N             world units to a unit of the model (a power of ten, so that it spans "
    "1000\n"
    "                       or more; the camera stands on whole world units)\n"
    "  --center yes|no      yes: 0,0,0 is the middle of the model's box; no: the file's own "
    "origin,\n"
    "                       which costs precision where that is not the middle (yes)\n"
    "  --precise            24 bits a coordinate instead of 16\n"
    "  --face-normals yes|no  with flat shading: 6 bytes a triangle, or work at run time (yes)\n"
    "  --cull back|front|none  which sides are not drawn (back)\n"
    "  --color RRGGBB       one colour for the whole model\n"
    "  --map F.u32          for each triangle written, in order, its number in the file + 1, as "
    "in\n"
    "                       zsim render --id-out; little-endian uint32\n"
    "Textures\n"
    "  --texture FILE       this picture for all faces, in place of the model's own\n"
    "  --wrap file|repeat|clamp  what lies beyond a picture's edge (as the file says)\n"
    "  --texture-size WxH   most texels each way, powers of two up to 1024 (256x256)\n"
    "  --texture-format auto|565|pal8|pal4  2, 1 or 1/2 byte a texel (auto: the smallest that is "
    "as good\n"
    "                       as 565, or whose PSNR is 36 dB or more)\n"
    "  --dither             spread what a format cannot show over the neighbours\n"
    "\n"
    "An option's value may follow after a space or an equals sign.\n"
    "Exit status: 0 done; 1 refused, nothing written; 2 the command line makes no sense.\n";

enum kind { KIND_TEXT, KIND_PATH, KIND_NUMBER, KIND_SIZE, KIND_RGB, KIND_CHOICE, KIND_FLAG };

/* Choices are written as the number of the word. */
struct option {
    const char *name;
    enum kind kind;
    size_t to;         /* offset of the value */
    int for_models;    /* 1: pictures have no use for it */
    int shown;         /* 1: part of what the generated files say made them */
    const char *words; /* "a|b|c" */
};

#define AT(field) offsetof(struct sim_convert_options, field)

static const struct option table[] = {
    { "--name", KIND_TEXT, AT(name), 0, 1, NULL },
    { "--out", KIND_PATH, AT(out), 0, 0, NULL },
    { "--shade", KIND_CHOICE, AT(look), 1, 1, "flat|smooth|textured|textured-flat|unlit|raw" },
    { "--unit", KIND_NUMBER, AT(unit), 1, 1, NULL },
    { "--center", KIND_CHOICE, AT(keep_origin), 1, 1, "yes|no" },
    { "--precise", KIND_FLAG, AT(precise), 1, 1, NULL },
    { "--face-normals", KIND_CHOICE, AT(no_face_normals), 1, 1, "yes|no" },
    { "--cull", KIND_CHOICE, AT(cull), 1, 1, "back|front|none" },
    { "--color", KIND_RGB, AT(color), 1, 1, NULL },
    { "--map", KIND_PATH, AT(map), 1, 0, NULL },
    { "--texture", KIND_PATH, AT(texture), 1, 1, NULL },
    { "--wrap", KIND_CHOICE, AT(wrap), 0, 1, "file|repeat|clamp" },
    { "--texture-size", KIND_SIZE, AT(texture_size), 0, 1, NULL },
    { "--texture-format", KIND_CHOICE, AT(texels), 0, 1, "auto|565|pal8|pal4" },
    { "--dither", KIND_FLAG, AT(dither), 0, 1, NULL },
    { "--help", KIND_FLAG, AT(help), 0, 0, NULL },
    { "-h", KIND_FLAG, AT(help), 0, 0, NULL },
};

#define N_TABLE (sizeof table / sizeof table[0])

/* ---- Values ---------------------------------------------------------------------------------- */

static int take_value(const struct option *opt, const char *text, void *to)
{
    const char *end;
    switch (opt->kind) {
    case KIND_TEXT:
    case KIND_PATH:
        *(const char **)to = text;
        return text[0] != '\0';
    case KIND_NUMBER:
        return sim_value_double(text, '\0', &end, to);
    case KIND_SIZE:
        return sim_value_size(text, to);
    case KIND_RGB:
        return sim_value_rgb(text, to);
    case KIND_CHOICE:
        *(int *)to = sim_value_choice(text, opt->words);
        return *(int *)to >= 0;
    case KIND_FLAG:
        break;
    }
    return 0;
}

static const char *wanted(const struct option *opt)
{
    static const char *const names[] = {
        [KIND_TEXT] = "a name",       [KIND_PATH] = "a file or folder", [KIND_NUMBER] = "a number",
        [KIND_SIZE] = "WIDTHxHEIGHT", [KIND_RGB] = "a colour RRGGBB",   [KIND_CHOICE] = "a word",
        [KIND_FLAG] = "no value",
    };
    return opt->words != NULL ? opt->words : names[opt->kind];
}

/* ---- The name -------------------------------------------------------------------------------- */

static int is_in(const char *text, const char *const *list, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (strcmp(list[i], text) == 0)
            return 1;
    return 0;
}

static int is_keyword(const char *name)
{
    static const char *const keywords[] = {
        "alignas",
        "alignof",
        "and",
        "and_eq",
        "asm",
        "auto",
        "bitand",
        "bitor",
        "bool",
        "break",
        "case",
        "catch",
        "char",
        "char16_t",
        "char32_t",
        "char8_t",
        "class",
        "co_await",
        "co_return",
        "co_yield",
        "compl",
        "concept",
        "const",
        "const_cast",
        "consteval",
        "constexpr",
        "constinit",
        "continue",
        "decltype",
        "default",
        "delete",
        "do",
        "double",
        "dynamic_cast",
        "else",
        "enum",
        "explicit",
        "export",
        "extern",
        "false",
        "float",
        "for",
        "friend",
        "goto",
        "if",
        "inline",
        "int",
        "long",
        "mutable",
        "namespace",
        "new",
        "noexcept",
        "not",
        "not_eq",
        "nullptr",
        "operator",
        "or",
        "or_eq",
        "private",
        "protected",
        "public",
        "register",
        "reinterpret_cast",
        "requires",
        "restrict",
        "return",
        "short",
        "signed",
        "sizeof",
        "static",
        "static_assert",
        "static_cast",
        "struct",
        "switch",
        "template",
        "this",
        "thread_local",
        "throw",
        "true",
        "try",
        "typedef",
        "typeid",
        "typename",
        "typeof",
        "typeof_unqual",
        "union",
        "unsigned",
        "using",
        "virtual",
        "void",
        "volatile",
        "wchar_t",
        "while",
        "xor",
        "xor_eq",
    };
    return is_in(name, keywords, sizeof keywords / sizeof keywords[0]);
}

/* Headers that NAME.h would hide from the compiler. */
static int is_header(const char *name)
{
    static const char *const headers[] = {
        "assert",      "complex",   "ctype",   "errno",    "fenv",   "float",    "inttypes",
        "iso646",      "limits",    "locale",  "math",     "setjmp", "signal",   "stdalign",
        "stdarg",      "stdatomic", "stdbool", "stddef",   "stdint", "stdio",    "stdlib",
        "stdnoreturn", "string",    "tgmath",  "threads",  "time",   "uchar",    "wchar",
        "wctype",      "unistd",    "config",  "renderer", "zstrip", "pipeline", "rotation",
        "rows",        "fx",        "hal",
    };
    return is_in(name, headers, sizeof headers / sizeof headers[0]);
}

static int check_name(const char *name)
{
    size_t n = 0;
    while (isascii((unsigned char)name[n]) && (isalnum((unsigned char)name[n]) || name[n] == '_'))
        n++;
    if (name[n] != '\0' || !isalpha((unsigned char)name[0]))
        return sim_refuse(
            NULL, 0,
            "--name %s is not a C identifier; take letters, digits and underscores, and "
            "begin with a letter",
            name);
    if (n > NAME_MAX_CHARS)
        return sim_refuse(NULL, 0, "--name %s has more than %d characters; take a shorter one",
                          name, NAME_MAX_CHARS);
    if (is_keyword(name))
        return sim_refuse(NULL, 0, "--name %s is a keyword of C or C++; take another", name);
    if (is_header(name))
        return sim_refuse(NULL, 0, "--name %s would hide the header %s.h; take another", name,
                          name);
    if (strncasecmp(name, "zs_", 3) == 0 || strcasecmp(name, "zs") == 0)
        return sim_refuse(NULL, 0, "--name %s belongs to the library; take another", name);
    return SIM_OK;
}

/* ---- The command, for a comment -------------------------------------------------------------- */

static const char *bare(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* One more word; what could end a comment or a line becomes an underscore. */
static void say(char **command, const char *word)
{
    const size_t n = *command != NULL ? strlen(*command) : 0;
    char *to = sim_grow(*command, n + strlen(word) + 2, 1);
    *command = to;
    to += n;
    if (n > 0)
        *to++ = ' ';
    for (; *word != '\0'; word++)
        *to++ = isascii((unsigned char)*word) &&
                        (isalnum((unsigned char)*word) || strchr("._,+=@#-", *word) != NULL)
                    ? *word
                    : '_';
    *to = '\0';
}

static void say_option(char **command, const struct option *opt, const char *value)
{
    if (!opt->shown)
        return;
    say(command, opt->name);
    if (value != NULL)
        say(command, opt->kind == KIND_PATH ? bare(value) : value);
}

/* ---- Arguments ------------------------------------------------------------------------------- */

static const struct option *find(const char *arg, size_t length)
{
    for (size_t k = 0; k < N_TABLE; k++)
        if (strlen(table[k].name) == length && memcmp(table[k].name, arg, length) == 0)
            return &table[k];
    return NULL;
}

static int take_option(struct sim_convert_options *o, char **said, int argc, char **argv, int *i)
{
    const char *arg = argv[*i];
    const size_t length = strcspn(arg, "=");
    const struct option *opt = find(arg, length);
    if (opt == NULL)
        return sim_usage("unknown option '%s'", arg);
    char *to = (char *)o + opt->to;
    const char *value = arg[length] == '=' ? arg + length + 1 : NULL;
    if (opt->kind == KIND_FLAG) {
        if (value != NULL)
            return sim_usage("%s wants no value, not '%s'", opt->name, value);
        *(int *)(void *)to = 1;
    } else {
        if (value == NULL && *i + 1 >= argc)
            return sim_usage("%s wants a value: %s", opt->name, wanted(opt));
        if (value == NULL)
            value = argv[++*i];
        if (!take_value(opt, value, to))
            return sim_usage("%s wants %s, not '%s'", opt->name, wanted(opt), value);
    }
    if (opt->for_models && !o->for_models) {
        o->for_models = 1;
        o->model_option = opt->name;
    }
    o->has_color |= opt->kind == KIND_RGB;
    o->has_unit |= opt->kind == KIND_NUMBER;
    say_option(said, opt, value);
    return SIM_OK;
}

static int take_arguments(struct sim_convert_options *o, char **said, int argc, char **argv)
{
    int only_names = 0;
    for (int i = 0; i < argc; i++) {
        int status = SIM_OK;
        if (!only_names && strcmp(argv[i], "--") == 0)
            only_names = 1;
        else if (!only_names && argv[i][0] == '-' && argv[i][1] != '\0')
            status = take_option(o, said, argc, argv, &i);
        else if (o->input != NULL)
            status = sim_usage("one model at a time: '%s' is one too many", argv[i]);
        else
            o->input = argv[i];
        if (status != SIM_OK)
            return status;
    }
    return SIM_OK;
}

static int check_values(const struct sim_convert_options *o)
{
    if (o->has_unit && !(o->unit >= UNIT_MIN && o->unit <= UNIT_MAX))
        return sim_refuse(o->input, 0, "--unit %g is outside its range, %g to %g", o->unit,
                          UNIT_MIN, UNIT_MAX);
    for (int k = 0; k < 2; k++) {
        const long side = o->texture_size[k];
        if (side < 1 || side > (long)SIM_TEXTURE_MAX || (side & (side - 1)) != 0)
            return sim_refuse(o->input, 0,
                              "--texture-size %ldx%ld: each side is a power of two, 1 to %u texels",
                              o->texture_size[0], o->texture_size[1], SIM_TEXTURE_MAX);
    }
    return check_name(o->name);
}

int sim_convert_parse(struct sim_convert_options *o, int argc, char **argv)
{
    static const char form[] = "zsim convert MODEL --name NAME --out DIR";
    char *said = NULL;
    *o = (struct sim_convert_options){ .look = SIM_LOOK_DEFAULT, .texture_size = { 256, 256 } };
    const int status = take_arguments(o, &said, argc, argv);
    if (status == SIM_OK && o->input != NULL) {
        say(&o->command, "zsim");
        say(&o->command, "convert");
        say(&o->command, bare(o->input));
        if (said != NULL) {
            const size_t n = strlen(o->command);
            o->command = sim_grow(o->command, n + strlen(said) + 2, 1);
            (void)snprintf(o->command + n, strlen(said) + 2, " %s", said);
        }
    }
    free(said);
    if (status != SIM_OK || o->help)
        return status;
    if (o->input == NULL || o->input[0] == '\0')
        return sim_usage("a model is missing: %s", form);
    if (o->name == NULL)
        return sim_usage("--name is missing: %s", form);
    if (o->out == NULL)
        return sim_usage("--out is missing: %s", form);
    return check_values(o);
}
