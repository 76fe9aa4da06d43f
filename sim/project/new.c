/* A folder that holds all that a program needs: the model as C, main.c, what builds and tests it, the renderer. It is
 * made of zstrip's sources, which must be there. Whatever is refused leaves no folder.
 *
 * SPDX-License-Identifier: MIT
 */
#include "new.h"

#include <errno.h>
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "convert.h"
#include "convert_options.h"
#include "option_help.h"
#include "option_table.h"
#include "output_file.h"
#include "project_files.h"
#include "sim.h"
#include "zs_lights.h"
#include "zstrip.h"

#define TEMPLATES "sim/project/template"
#define NAME_MAX_CHARS 40

struct request {
    const char *out;
    int board, help;
    char **convert; /* the model, and the options of zsim convert */
    int n_convert;
};

#define AT(field) offsetof(struct request, field)

static const struct sim_option table[] = {
    { "--out", SIM_OPTION_PATH, AT(out), .value = "DIR",
      .help = "the folder, which must not be there yet; its name becomes the program's. It is needed" },
    { "--board", SIM_OPTION_CHOICE, AT(board), .words = "pico|stm32f405|lm3s6965|host|linux",
      .help = "where it is to run; host: a program on this machine; linux: one for a panel on spidev and libgpiod "
              "(pico)" },
    { "--name, --map, --bvh", SIM_OPTION_WORD, .help = "are not taken; all other options are those of zsim convert" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim new MODEL --out DIR [--board BOARD] [options of zsim convert]",
    "Makes a project around a model: main.c with a frame counter, a Makefile, CMakeLists.txt, a test, and all of the "
    "renderer. `make -C DIR show` draws it; for the Pico, in an emulator.",
    "Exit status: 0 done; 1 refused, nothing written; 2 the command line makes no sense.",
};

/* ---- Boards ------------------------------------------------------------------------------------------------ */

/* What a program is given on a board. */
struct board {
    const char *name, *hal;
    const char *panel;    /* as zsim panel has it */
    const char *glass;    /* the fields of struct panel_config */
    const char *packages; /* what it takes beside gcc and make to build it and to run it here */
    uint32_t w, h, rows, buffers;
    uint32_t pixel_bits; /* on the wire */
    uint32_t arena;      /* bytes, at most: the part's RAM without code in it, statics and stack */
};

#define ST7789 ".type = &panel_st7789, .width = W, .height = H, .invert = 1"
#define ARM_PACKAGES "gcc-arm-none-eabi and libnewlib-arm-none-eabi"
static const struct board boards[] = {
    { "pico", "rp2040", "st7789:240x240 --invert", ST7789, "; the Pico " ARM_PACKAGES ", its emulator nodejs and npm",
      240, 240, 24, 2, 16, 150000 },
    { "stm32f405", "stm32f4", "st7789:240x240 --invert", ST7789, "; the board " ARM_PACKAGES, 240, 240, 24, 2, 16,
      100000 },
    { "lm3s6965", "lm3s6965", "ssd0323:128x64", ".type = &panel_ssd0323, .width = W, .height = H",
      "; the board " ARM_PACKAGES, 128, 64, 8, 1, 4, 40000 },
    { "host", "host", "st7789:240x240 --invert", ST7789, "", 240, 240, 24, 2, 16, 4000000 },
    { "linux", "linux", "st7789:240x240 --invert", ST7789, "; the program for the panel pkg-config and libgpiod-dev",
      240, 240, 24, 2, 16, 4000000 },
};

/* ---- Command line ------------------------------------------------------------------------------------------ */

static int is_own(const char *arg)
{
    const size_t n = strcspn(arg, "=");
    for (size_t i = 0; i < N_TABLE; i++)
        if (table[i].kind != SIM_OPTION_WORD && strlen(table[i].name) == n && strncmp(table[i].name, arg, n) == 0)
            return 1;
    return 0;
}

static int parse(struct request *rq, int argc, char **argv)
{
    static const char *const refused[] = { "--name", "--map", "--bvh" };
    char seen[N_TABLE] = { 0 };
    rq->convert = sim_alloc((size_t)argc + 5, sizeof *rq->convert);
    for (int i = 0; i < argc; i++) {
        for (size_t k = 0; k < 3; k++)
            if (strncmp(argv[i], refused[k], strlen(refused[k])) == 0)
                return sim_usage("new: %s is not taken: the model's files are model.c and model.h", refused[k]);
        if (!is_own(argv[i])) {
            rq->convert[rq->n_convert++] = argv[i];
            continue;
        }
        const int status = sim_option_take(table, N_TABLE, rq, seen, argc, argv, &i);
        if (status != SIM_OK)
            return status;
    }
    if (!rq->help && rq->n_convert == 0)
        return sim_usage("new: a model is missing: zsim new MODEL --out DIR");
    if (!rq->help && rq->out == NULL)
        return sim_usage("new: --out is missing: zsim new MODEL --out DIR");
    return SIM_OK;
}

/* The last name of a path; slashes at its end do not count. */
static void last_name(char *name, size_t room, const char *path)
{
    size_t end = strlen(path);
    while (end > 1 && path[end - 1] == '/')
        end--;
    size_t from = end;
    while (from > 0 && path[from - 1] != '/')
        from--;
    (void)snprintf(name, room, "%.*s", (int)(end - from), path + from);
}

/* make, cmake and the linker are to take the name as it is. */
static int check_name(const char *name)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    static const char all[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    const size_t n = strlen(name);
    if (n == 0 || n > NAME_MAX_CHARS || strchr(letters, name[0]) == NULL || strspn(name, all) != n)
        return sim_refuse(
            NULL, 0,
            "--out %s: the folder's name becomes the program's: a letter, then letters, digits, _ and -, "
            "at most %d",
            name, NAME_MAX_CHARS);
    return SIM_OK;
}

/* ---- Memory -------------------------------------------------------------------------------------------------- */

/* The number that "#define MODEL_<what> N" has in the model's header; 0: none. */
static uint32_t defined(const char *header, const char *what)
{
    char line[256], word[64];
    unsigned long value = 0;
    FILE *f = fopen(header, "r");
    while (f != NULL && value == 0 && fgets(line, sizeof line, f) != NULL)
        if (sscanf(line, "#define MODEL_%63s %lu", word, &value) != 2 || strcmp(word, what) != 0)
            value = 0;
    if (f != NULL)
        (void)fclose(f);
    return (uint32_t)value;
}

/* Has the model's header a value of that name, as "ZS_VARYINGS_TEXTURE_GLOSS"? */
static int names(const char *header, const char *what)
{
    char line[256];
    int found = 0;
    FILE *f = fopen(header, "r");
    while (f != NULL && !found && fgets(line, sizeof line, f) != NULL)
        found = strncmp(line, "#define ", 8) == 0 && strstr(line, what) != NULL;
    if (f != NULL)
        (void)fclose(f);
    return found;
}

static uint32_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* Triangles and vertices at a time: all of the model's where they fit, else shares of the RAM as the model has them. */
static void choose_pools(const struct board *b, uint32_t pool[2], uint32_t n_tris, uint32_t n_verts, uint32_t varyings)
{
    uint32_t part = 1024;
    do {
        pool[0] = least(ZS_POOL_MAX, n_tris * part / 1024u + 8u);
        pool[1] = least(ZS_POOL_MAX, n_verts * part / 1024u + 8u);
        part -= part / 16u + 1u;
    } while (part > 8u && ZS_ARENA_BYTES(b->w, b->h, b->rows, pool[0], pool[1], varyings, b->buffers) > b->arena);
}

/* ---- Files --------------------------------------------------------------------------------------------------- */

/* Each file or folder of zstrip that a project gets, and where. */
static int copy_sources(const char *sources, const char *out, int with_emulator)
{
    static const char *const copied[][2] = {
        { "firmware/zstrip", "zstrip/firmware/zstrip" },
        { "firmware/boards", "zstrip/firmware/boards" },
        { "hal", "zstrip/hal" },
        { "LICENSE", "zstrip/LICENSE" },
        { "tests/boards/elf.mjs", "zstrip/emulator/elf.mjs" },
        { "tests/boards/pico/pico.mjs", "zstrip/emulator/pico.mjs" },
        { "tests/boards/pico/second.mjs", "zstrip/emulator/second.mjs" },
        { "tests/boards/pico/xip.mjs", "zstrip/emulator/xip.mjs" },
        { "tests/boards/pico/frames.mjs", "zstrip/emulator/frames.mjs" },
        { "tests/boards/pico/package.json", "zstrip/emulator/package.json" },
        { "tests/boards/pico/package-lock.json", "zstrip/emulator/package-lock.json" },
    };
    int status = SIM_OK;
    for (size_t i = 0; status == SIM_OK && i < (with_emulator ? sizeof copied / sizeof copied[0] : 4); i++) {
        char from[PATH_MAX], to[PATH_MAX];
        if (snprintf(from, sizeof from, "%s/%s", sources, copied[i][0]) >= (int)sizeof from ||
            snprintf(to, sizeof to, "%s/%s", out, copied[i][1]) >= (int)sizeof to)
            return sim_refuse(out, 0, "its path is too long");
        status = sim_tree_copy(from, to);
    }
    return status;
}

/* How display.c gets its panel's bus on Linux. */
static const char linux_wire_text[] =
    "#if HAL_LINUX\n"
    "    static const struct linux_wiring wiring = { .spi = \"/dev/spidev0.0\", .hz = 32000000, .dc = \"GPIO25\",\n"
    "                                                .reset = \"GPIO27\", .backlight = \"GPIO18\" };\n"
    "    linux_wire(&wiring);\n"
    "#endif\n";
/* ... and how it says more of an error. */
static const char linux_why_text[] =
    "#if HAL_LINUX\n"
    "        hal_write(linux_why()); /* more of it */\n"
    "        hal_write(\"\\n\");\n"
    "#endif\n";

/* The light of a scene in which something shines: that of the model's lamp. */
static const char lit_text[] =
    "#ifdef MODEL_LITS /* what shines has its light from there */\n"
    "                                    .light = { .dir = { model_lamp[0].dir[0], model_lamp[0].dir[1],\n"
    "                                                        model_lamp[0].dir[2] },\n"
    "                                               .ambient = ZS_Q16_ONE / 4, .diffuse = ZS_Q16_ONE * 3 / 4 },\n"
    "#endif\n";

static int write_templates(const struct request *rq, const char *sources, const char *name, const char *input)
{
    static const char *const files[][2] = { { "main.c", "main.c" },
                                            { "display.c", "display.c" },
                                            { "display.h", "display.h" },
                                            { "Makefile", "Makefile" },
                                            { "test.sh", "test.sh" },
                                            { "readme", "README.md" },
                                            { "CMakeLists.txt", "CMakeLists.txt" },
                                            { "gitignore", ".gitignore" } };
    const struct board *b = &boards[rq->board];
    char number[6][16], model[256], convert[512] = "zsim convert", zsim[PATH_MAX + 1], header[PATH_MAX];
    char scratch[96] = "", elf[64], from[PATH_MAX], to[PATH_MAX];
    const int is_linux = strcmp(b->name, "linux") == 0, is_pico = strcmp(b->name, "pico") == 0;
    uint32_t pool[2];
    (void)snprintf(header, sizeof header, "%s/model.h", rq->out);
    const int gloss = names(header, "ZS_VARYINGS_TEXTURE_GLOSS"); /* else three are the most that convert writes */
    choose_pools(b, pool, defined(header, "TRIANGLES"), defined(header, "VERTICES"),
                 gloss ? ZS_VARYINGS_TEXTURE_GLOSS : ZS_VARYINGS_TEXTURE_SMOOTH);
    const uint32_t values[6] = { b->w, b->h, b->rows, pool[0], pool[1], b->buffers };
    for (int i = 0; i < 6; i++)
        (void)snprintf(number[i], sizeof number[i], "%lu", (unsigned long)values[i]);
    last_name(model, sizeof model, input);
    (void)snprintf(elf, sizeof elf, "%.50s.elf", name);
    const ssize_t n = readlink("/proc/self/exe", zsim, PATH_MAX);
    zsim[n > 0 ? n : 0] = '\0';
    if (b->pixel_bits < 16)
        (void)snprintf(scratch, sizeof scratch,
                       "static uint32_t scratch[W * ROWS * %lu / 32]; /* pixels as the panel "
                       "takes them */\n",
                       (unsigned long)b->pixel_bits);
    const struct sim_word word[] = {
        { "NAME", name },
        { "MODEL", model },
        { "BOARD", b->name },
        { "HAL", b->hal },
        { "W", number[0] },
        { "H", number[1] },
        { "ROWS", number[2] },
        { "TRIS", number[3] },
        { "VERTS", number[4] },
        { "BUFFERS", number[5] },
        { "GLASS", b->glass },
        { "PANEL", b->panel },
        { "ZSIM", zsim },
        { "CONVERT", convert },
        { "SCRATCH", scratch },
        { "SCRATCH_ARGS", scratch[0] != '\0' ? "scratch, sizeof scratch" : "NULL, 0" },
        { "INCLUDES", is_linux ? "#if HAL_LINUX /* not with BOARD=host */\n#include \"linux.h\"\n#endif\n" : "" },
        { "WIRE", is_linux ? linux_wire_text : "" },
        { "WHY", is_linux ? linux_why_text : "" },
        { "SHOW",
          is_pico ? "make show              # the program in an emulated Pico: pictures, and frames a second\n" : "" },
        { "IMAGE", is_linux ? "the program for the panel: build/fw/linux/" : "what is flashed, in build/fw/" },
        { "IMAGE_OF", is_linux ? elf : b->name },
        { "LIGHT", defined(header, "LITS") > 0 ? lit_text : "" },
        { "UNIT", b->pixel_bits < 16 ? "1" : "2" },
        { "DEFINES", gloss ? "-DZS_VARYINGS_MAX=4" : "" },
        { "OPTIONS", gloss ? "target_compile_options(zstrip PUBLIC -DZS_VARYINGS_MAX=4)\n" : "" },
        { "EMULATED", is_pico ? ", of the emulated Pico" : "" },
        { "PACKAGES", b->packages },
    };
    int status = SIM_OK;
    for (size_t i = 0; status == SIM_OK && i < sizeof files / sizeof files[0]; i++) {
        (void)snprintf(from, sizeof from, "%s/" TEMPLATES "/%s", sources, files[i][0]);
        (void)snprintf(to, sizeof to, "%s/%s", rq->out, files[i][1]);
        status = sim_template_write(from, to, word, sizeof word / sizeof word[0]);
    }
    return status;
}

/* ---- Command ------------------------------------------------------------------------------------------------- */

static int make_project(struct request *rq, const char *sources, const char *name)
{
    static char name_option[] = "--name", model[] = "model", out_option[] = "--out";
    rq->convert[rq->n_convert++] = name_option;
    rq->convert[rq->n_convert++] = model;
    rq->convert[rq->n_convert++] = out_option;
    rq->convert[rq->n_convert++] = (char *)(uintptr_t)rq->out;
    const struct board *b = &boards[rq->board];
    struct sim_convert_options convert;
    int status = sim_convert_parse(&convert, rq->n_convert, rq->convert); /* for the model's name */
    free(convert.command);
    if (status == SIM_OK && sim_is_picture(convert.input))
        status = sim_refuse(convert.input, 0, "is a picture; zsim new takes a model, zsim convert takes pictures");
    if (status == SIM_OK)
        status = sim_convert(rq->n_convert, rq->convert);
    if (status == SIM_OK)
        status = copy_sources(sources, rq->out, strcmp(b->name, "pico") == 0);
    if (status == SIM_OK)
        status = write_templates(rq, sources, name, convert.input);
    if (status == SIM_OK)
        (void)printf("%s: the program is main.c; make -C %s show%s\n", rq->out, rq->out,
                     strcmp(b->name, "pico") == 0 ? "" : " BOARD=host");
    return status;
}

/* Is a folder in one that a project gets a copy of? */
static int is_copied(const char *sources, const char *folder)
{
    static const char *const parts[] = { "firmware", "hal", "sim", "tests" };
    char *const at = realpath(folder, NULL);
    char part[PATH_MAX];
    int inside = 0;
    for (size_t i = 0; at != NULL && i < sizeof parts / sizeof parts[0]; i++) {
        (void)snprintf(part, sizeof part, "%s/%s", sources, parts[i]);
        char *const real = realpath(part, NULL);
        const size_t n = real != NULL ? strlen(real) : 0;
        inside |= n > 0 && strncmp(at, real, n) == 0 && at[n] == '/';
        free(real);
    }
    free(at);
    return inside;
}

int sim_new(int argc, char **argv)
{
    struct request rq = { 0 };
    char name[256], *sources = NULL;
    int status = parse(&rq, argc, argv);
    if (status == SIM_OK && rq.help) {
        sim_option_help(table, N_TABLE, &help);
        free(rq.convert);
        return SIM_OK;
    }
    if (status == SIM_OK) {
        last_name(name, sizeof name, rq.out);
        status = check_name(name);
    }
    if (status == SIM_OK && (sources = sim_sources_find()) == NULL)
        status = SIM_REFUSED;
    if (status == SIM_OK && mkdir(rq.out, 0777) != 0)
        status = errno == EEXIST ? sim_refuse(rq.out, 0, "is there already; name another folder, or remove it")
                                 : sim_refuse(rq.out, 0, "cannot be made a folder: %s", strerror(errno));
    else if (status == SIM_OK) {
        sim_output_unfinished(rq.out);
        status = is_copied(sources, rq.out)
                     ? sim_refuse(rq.out, 0, "is among zstrip's sources; name a folder elsewhere")
                     : make_project(&rq, sources, name);
        if (status != SIM_OK)
            sim_tree_remove(rq.out);
        sim_output_unfinished(NULL);
    }
    free(sources);
    free(rq.convert);
    return status;
}
