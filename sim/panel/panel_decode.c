/* A stream is read whole, fed to the model of the controller, and looked at where it says so.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel_decode.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"
#include "input_file.h"
#include "moving_picture.h"
#include "option_help.h"
#include "option_table.h"
#include "panel_frame.h"
#include "panel_model.h"
#include "sim.h"

/* Words of a stream: a byte and its D/C level, or marks. */
enum { DATA = 0x100, RESET = 0x200, FRAME = 0x400, DESELECT = 0x800, MARKS = 0xe00, WORD = 0xfff };
enum { TEXT = 0x1000 }; /* or with this, a character */

struct request {
    const char *stream, *out, *raw;
    const char *moving; /* NULL: no moving picture */
    long delay;         /* of its frames, ms */
    struct sim_panel_wish panel;
    int full; /* flag: pictures are whole by their pixels, not by marks */
    int help;
};

#define AT(field) offsetof(struct request, field)

static const struct sim_option table[] = {
    SIM_PANEL_OPTIONS(struct request, panel, "the module. There are:"),
    { "--decode", SIM_OPTION_FILE, AT(stream), .value = "STREAM",
      .help =
          "little-endian uint16: bits 0-7 a byte and bit 8 its D/C level (1 data), or marks: bit 9 RESET was pulled "
          "low, bit 10 a frame is whole, bit 11 chip select went high; or, with bit 12, bits 0-7 a character of "
          "text, which is printed and changes nothing" },
    { "--out", SIM_OPTION_FILE, AT(out), .value = "F_%03d.png",
      .help = "a picture for each frame mark, numbered from 0; without marks, one at the end" },
    { "--raw", SIM_OPTION_FILE, AT(raw), .value = "F_%03d.bin",
      .help = "the same as RGB565, most significant byte first, or a byte for each level or bit" },
    { "--moving", SIM_OPTION_FILE, AT(moving), .value = "F.png",
      .help = "all of them as one animated PNG, too, or a GIF or MP4 where the name ends so" },
    { "--delay", SIM_OPTION_COUNT, AT(delay), 0, 10, 65535, .value = "MS", .help = "of a picture in it (80)" },
    { "--full", SIM_OPTION_FLAG, AT(full),
      .help = "for programs that draw whole frames: a picture each time that as many pixels came as the glass has, "
              "since it was switched on; marks of frames are not looked at" },
    SIM_HELP_OPTIONS(AT(help)),
};

static const struct sim_help help = {
    "zsim panel --panel NAME:WxH --decode STREAM --out F_%03d.png [options]",
    "Decodes what went over a panel's wire, as its controller would, into what is seen on its glass.",
    "Prints lines of text, counts, and what the controller would not have understood.\n"
    "Exit status: 0 done; 1 refused, or the stream has problems (its pictures are written); 2 the command line "
    "makes no sense.",
};

/* ---- Command line -------------------------------------------------------------------------------------- */

static int parse(struct request *rq, int argc, char **argv)
{
    char seen[N_TABLE] = { 0 };
    for (int i = 0; i < argc; i++) {
        const int status = sim_option_take(table, N_TABLE, rq, seen, argc, argv, &i);
        if (status != SIM_OK)
            return status;
    }
    const int status = rq->help ? SIM_OK : sim_options_in_range(table, N_TABLE, rq, seen, NULL);
    if (status != SIM_OK)
        return status;
    if (!rq->help && (rq->panel.name == NULL || rq->stream == NULL || rq->out == NULL))
        return sim_usage("panel: %s is missing: zsim panel --panel NAME:WxH --decode STREAM --out F_%%03d.png",
                         rq->panel.name == NULL ? "--panel"
                         : rq->stream == NULL   ? "--decode"
                                                : "--out");
    return SIM_OK;
}

/* A pattern holds at most one %d, with a width or not; nothing else that begins with %. */
static int check_pattern(const char *option, const char *pattern)
{
    const char *p = strchr(pattern, '%');
    if (p == NULL)
        return SIM_OK;
    const size_t digits = strspn(p + 1, "0123456789");
    if (digits > 2 || p[1 + digits] != 'd' || strchr(p + 2 + digits, '%') != NULL)
        return sim_usage("panel: %s takes one number, such as %%03d, not '%s'", option, pattern);
    return SIM_OK;
}

/* A pattern with a number put in. 0: it has no place for one. */
static int file_name(char *name, size_t room, const char *pattern, unsigned number)
{
    const char *p = strchr(pattern, '%');
    if (p == NULL) {
        (void)snprintf(name, room, "%s", pattern);
        return 0;
    }
    char *end;
    const long width = strtol(p + 1, &end, 10);
    (void)snprintf(name, room, "%.*s%0*u%s", (int)(p - pattern), pattern, (int)width, number, end + 1);
    return 1;
}

/* ---- Stream -------------------------------------------------------------------------------------------- */

static int is_word(uint16_t word)
{
    if (word & TEXT)
        return (word & ~(TEXT | 255)) == 0;
    return (word & ~WORD) == 0 && !(word & MARKS && word & ~MARKS);
}

/* All of a stream's words, malloc'ed. */
static int load(const char *name, uint16_t **words, size_t *n)
{
    uint8_t *raw;
    size_t bytes;
    const int status = sim_file_read(name, &raw, &bytes);
    if (status != SIM_OK)
        return status;
    *n = bytes / 2;
    *words = sim_alloc(*n, sizeof **words);
    for (size_t i = 0; i < *n; i++)
        (*words)[i] = (uint16_t)(raw[2 * i] | raw[2 * i + 1] << 8);
    free(raw);
    if (bytes % 2 != 0)
        return sim_refuse(name, 0, "has %zu bytes: a stream is made of uint16, two bytes each", bytes);
    for (size_t i = 0; i < *n; i++)
        if (!is_word((*words)[i]))
            return sim_refuse(name, 0, "word %zu is 0x%04X: not a byte with its D/C level, a mark or a character", i,
                              (*words)[i]);
    return SIM_OK;
}

/* ---- Pictures ------------------------------------------------------------------------------------------ */

/* Pictures that are kept for --moving. */
struct frames {
    uint8_t **rgb;
    uint32_t n, width, height;
};

static int save_moving(struct frames *all, const struct request *rq, int status)
{
    if (status == SIM_OK && rq->moving != NULL) {
        const struct sim_moving m = { all->width, all->height, all->n, (uint32_t)rq->delay, all->rgb };
        status = sim_moving_save(rq->moving, &m);
    }
    for (uint32_t i = 0; i < all->n; i++)
        free(all->rgb[i]);
    free(all->rgb);
    return status;
}

/* What the viewer sees now, into the files of a number, and to *all's frames. */
static int look(const struct pm_model *model, const struct pm_glass *glass, const struct request *rq, unsigned number,
                struct frames *all)
{
    char png[4096], raw[4096];
    struct sim_picture seen;
    if (!file_name(png, sizeof png, rq->out, number) && number > 0)
        return sim_refuse(rq->out, 0, "the stream has more than one frame; number them, as in frame_%%03d.png");
    if (rq->raw != NULL)
        (void)file_name(raw, sizeof raw, rq->raw, number);
    sim_panel_picture(&seen, model, glass, rq->panel.turns);
    const int status = sim_picture_save(&seen, png, rq->raw != NULL ? raw : NULL);
    if (status == SIM_OK && rq->moving != NULL) {
        all->width = seen.width;
        all->height = seen.height;
        all->rgb = sim_grow(all->rgb, (size_t)all->n + 1, sizeof *all->rgb);
        all->rgb[all->n++] = seen.rgb;
        seen.rgb = NULL;
    }
    sim_picture_free(&seen);
    return status;
}

/* ---- Command ------------------------------------------------------------------------------------------- */

/* Text as lines "text ..."; in_line: flag, one is begun. */
static void print_text(int *in_line, uint8_t c)
{
    if (!*in_line)
        (void)printf("text ");
    (void)putchar(c == '\n' || (c >= ' ' && c <= '~') ? c : '?');
    *in_line = c != '\n';
}

/* Is a picture whole, after all of its pixels? *from: the pixels that came before it. */
static int is_full(const struct pm_model *model, const struct pm_glass *glass, uint64_t *from)
{
    const uint64_t now = pm_counts(model)->pixels, whole = (uint64_t)glass->width * glass->height;
    if (!pm_lit(model)) /* it is being cleared */
        *from = now;
    if (now - *from < whole)
        return 0;
    *from += whole;
    return 1;
}

static int decode(struct pm_model *model, const struct pm_glass *glass, const struct request *rq,
                  const uint16_t *words, size_t n)
{
    unsigned frames = 0;
    struct frames all = { 0 };
    uint64_t from = 0;
    int status = SIM_OK, in_line = 0;
    for (size_t i = 0; status == SIM_OK && i < n; i++) {
        if (words[i] & TEXT) {
            print_text(&in_line, (uint8_t)words[i]);
            continue;
        }
        if (!(words[i] & MARKS))
            pm_byte(model, (uint8_t)words[i], words[i] & DATA);
        if (words[i] & RESET)
            pm_reset(model);
        if (rq->full ? is_full(model, glass, &from) : words[i] & FRAME)
            status = look(model, glass, rq, frames++, &all);
        if (words[i] & DESELECT)
            pm_deselect(model);
    }
    if (in_line)
        print_text(&in_line, '\n');
    pm_end(model);
    if (status == SIM_OK && frames == 0)
        status = look(model, glass, rq, frames++, &all);
    status = save_moving(&all, rq, status);
    if (status == SIM_OK)
        (void)printf("frames %u\n", frames);
    return status;
}

static void print_counts(const struct pm_counts *c)
{
    (void)printf("bytes %llu\ncommand_bytes %llu\ndata_bytes %llu\ntransactions %llu\ncommands %llu\nwindows %llu\n"
                 "pixel_bytes %llu\npixels %llu\nresets %llu\n",
                 (unsigned long long)c->bytes, (unsigned long long)c->command_bytes,
                 (unsigned long long)c->data_bytes, (unsigned long long)c->transactions,
                 (unsigned long long)c->commands, (unsigned long long)c->windows,
                 (unsigned long long)c->pixel_bytes, (unsigned long long)c->pixels, (unsigned long long)c->resets);
}

static int report(const struct pm_model *model, const char *stream)
{
    const struct pm_problem *problem;
    const size_t n = pm_problems(model, &problem);
    print_counts(pm_counts(model));
    (void)printf("problems %zu\n", n);
    for (size_t i = 0; i < n; i++)
        (void)printf("%s\n", problem[i].text);
    if (n > 0)
        return sim_refuse(stream, 0, "%s%s", problem[0].text, n > 1 ? "; more problems follow" : "");
    return SIM_OK;
}

int sim_panel(int argc, char **argv)
{
    struct request rq = { .delay = 80 };
    struct pm_glass glass;
    uint16_t *words = NULL;
    size_t n = 0;
    int status = parse(&rq, argc, argv);
    if (status == SIM_OK && rq.help) {
        sim_option_help(table, N_TABLE, &help);
        return SIM_OK;
    }
    if (status == SIM_OK)
        status = check_pattern("--out", rq.out);
    if (status == SIM_OK && rq.raw != NULL)
        status = check_pattern("--raw", rq.raw);
    if (status == SIM_OK)
        status = sim_panel_glass(&rq.panel, NULL, &glass);
    if (status == SIM_OK)
        status = load(rq.stream, &words, &n);
    if (status == SIM_OK) {
        struct pm_model *model = pm_new(&glass);
        if (model == NULL)
            status = sim_refuse(NULL, 0, "out of memory for the panel's RAM");
        if (status == SIM_OK)
            status = decode(model, &glass, &rq, words, n);
        if (status == SIM_OK)
            status = report(model, rq.stream);
        pm_free(model);
    }
    free(words);
    return status;
}
