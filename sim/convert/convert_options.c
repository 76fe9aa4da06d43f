/* Parsing of `zsim convert`, by sim's option table.
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

#include "converted.h"
#include "load_options.h"
#include "option_help.h"
#include "option_table.h"
#include "sim.h"
#include "simplify.h"

#define NAME_MAX_CHARS 40
#define UNIT_MIN 1e-30
#define UNIT_MAX 1e30

/* How an option is used. */
enum {
    FOR_MODELS = 1, /* pictures have no use for it */
    SHOWN = 2       /* part of what the generated files say made them */
};

#define AT(field) offsetof(struct sim_convert_options, field)

static const struct sim_option table[] = {
    { "Output", SIM_OPTION_HEADING },
    { "--name", SIM_OPTION_TEXT, AT(name), .use = SHOWN,
      .help = "what every name in the files begins with; a C identifier. It is needed" },
    { "--out", SIM_OPTION_PATH, AT(out), .value = "DIR", .help = "the folder, made if there is none. It is needed" },
    { "Mesh", SIM_OPTION_HEADING },
    { "--shade", SIM_OPTION_CHOICE, AT(look), .use = FOR_MODELS | SHOWN,
      .words = "flat|smooth|textured|textured-flat|unlit|raw",
      .help =
          "the shader, and with it what is written: normals, texture coordinates, colours (smooth if the file has "
          "normals, else flat; if the model has a texture, textured, or textured-flat without normals and highlights). "
          "textured is smooth too; parts without texture are smooth, flat or raw. unlit: texels as they are; raw: "
          "colours as they are" },
    { "--unit", SIM_OPTION_NUMBER, AT(unit), AT(has_unit), UNIT_MIN, UNIT_MAX, .use = FOR_MODELS | SHOWN,
      .help =
          "world units to a unit of the model (a power of ten, so that it spans 1000 or more; the camera stands on "
          "whole world units)" },
    { "--center", SIM_OPTION_CHOICE, AT(keep_origin), .use = FOR_MODELS | SHOWN, .words = "yes|no",
      .help =
          "yes: 0,0,0 is the middle of the model's box; no: the file's own origin, which costs precision where that "
          "is not the middle (yes)" },
    { "--precise", SIM_OPTION_FLAG, AT(precise), .use = FOR_MODELS | SHOWN,
      .help = "24 bits a coordinate instead of 16" },
    { "--face-normals", SIM_OPTION_CHOICE, AT(no_face_normals), .use = FOR_MODELS | SHOWN, .words = "yes|no",
      .help = "with flat shading: 6 bytes a triangle, or work at run time (yes)" },
    { "--cull", SIM_OPTION_CHOICE, AT(cull), .use = FOR_MODELS | SHOWN, .words = "back|front|none",
      .help = "which sides are not drawn (back)" },
    { "--color", SIM_OPTION_RGB, AT(color), AT(has_color), .use = FOR_MODELS | SHOWN,
      .help = "one colour for the whole model" },
    { "--bvh", SIM_OPTION_FLAG, AT(bvh), .use = FOR_MODELS | SHOWN,
      .help = "a hierarchy of spheres for zs_method_raycast, 16 bytes a node" },
    SIM_SIMPLIFY_OPTION(struct sim_convert_options, simplify, FOR_MODELS | SHOWN),
    { "--map", SIM_OPTION_PATH, AT(map), .use = FOR_MODELS, .value = "F.u32",
      .help = "for each triangle written, in order, its number in the file + 1, as in zsim render --id-out; "
              "little-endian uint32" },
    { "Textures", SIM_OPTION_HEADING },
    { "--texture", SIM_OPTION_PATH, AT(texture), .use = FOR_MODELS | SHOWN,
      .help = "this picture for all faces, in place of the model's own" },
    { "--wrap", SIM_OPTION_CHOICE, AT(wrap), .use = SHOWN, .words = "file|repeat|clamp",
      .help = "what lies beyond a picture's edge (file: as the model's says)" },
    { "--texture-size", SIM_OPTION_SIZE, AT(texture_size), .use = SHOWN,
      .help = "most texels each way, powers of two up to 1024 (256x256)" },
    { "--texture-format", SIM_OPTION_CHOICE, AT(texels), .use = SHOWN, .words = "auto|565|pal8|pal4",
      .help = "2, 1 or 1/2 byte a texel; 4444, pal8a or pal4a where a material uses its alpha (auto: the smallest "
              "that is as good as 565, or whose PSNR is 36 dB or more)" },
    { "--dither", SIM_OPTION_FLAG, AT(dither), .use = SHOWN,
      .help = "spread what a format cannot show over the neighbours" },
    { "--mipmap", SIM_OPTION_FLAG, AT(mipmap), .use = SHOWN,
      .help = "coarser levels too, for the mipmap shaders of zs_filter.h: means of the picture's values as the file "
              "has them, without gamma; a third more texels" },
    SIM_LOAD_OPTIONS(struct sim_convert_options, limits),
    { "Else", SIM_OPTION_HEADING },
    SIM_HELP_OPTIONS(AT(help)),
};

void sim_convert_help(void)
{
    static const struct sim_help help = {
        "zsim convert MODEL --name NAME --out DIR [options]",
        "Turns a model (OBJ, glTF, STL, PLY and what else assimp reads) or a picture (PNG, JPEG) into const C for "
        "firmware: DIR/NAME.h and DIR/NAME.c, and prints what they take, and what the file has that is not carried "
        "over.",
        "Exit status: 0 done; 1 refused, nothing written; 2 the command line makes no sense.",
    };
    sim_option_help(table, N_TABLE, &help);
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

static void say_option(char **command, const struct sim_option *opt, const char *value)
{
    if (!(opt->use & SHOWN))
        return;
    say(command, opt->name);
    if (value != NULL)
        say(command, opt->kind == SIM_OPTION_PATH ? bare(value) : value);
}

/* ---- Arguments ------------------------------------------------------------------------------- */

static int take_option(struct sim_convert_options *o, char **said, int argc, char **argv, int *i)
{
    char seen[N_TABLE] = { 0 };
    const int at = *i;
    const int status = sim_option_take(table, N_TABLE, o, seen, argc, argv, i);
    if (status != SIM_OK)
        return status;
    const struct sim_option *opt = &table[(const char *)memchr(seen, 1, N_TABLE) - seen];
    if (opt->kind == SIM_OPTION_COUNT && sim_options_in_range(table, N_TABLE, o, seen, NULL) != SIM_OK)
        return SIM_REFUSED;
    const char *equals = strchr(argv[at], '=');
    if ((opt->use & FOR_MODELS) && !o->for_models) {
        o->for_models = 1;
        o->model_option = opt->name;
    }
    say_option(said, opt, equals != NULL ? equals + 1 : *i > at ? argv[*i] : NULL);
    return SIM_OK;
}

static int take_arguments(struct sim_convert_options *o, char **said, int argc, char **argv)
{
    int only_names = 0, status = SIM_OK;
    for (int i = 0; status == SIM_OK && i < argc; i++)
        status = !only_names && sim_is_option(argv[i]) ? take_option(o, said, argc, argv, &i)
                                                       : sim_model_take(&o->input, argv[i], &only_names);
    return status;
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
    const int status = sim_simplify_check(o->simplify);
    return status == SIM_OK ? check_name(o->name) : status;
}

int sim_convert_parse(struct sim_convert_options *o, int argc, char **argv)
{
    static const char form[] = "zsim convert MODEL --name NAME --out DIR";
    char *said = NULL;
    sim_convert_defaults(o);
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
