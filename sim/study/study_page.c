/* Sections, plots and the page of studies. A study's section lies in DIR/NAME.section; the page is all sections there
 * are, in one file: pictures and plots are data URIs.
 *
 * SPDX-License-Identifier: MIT
 */
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base64.h"
#include "image.h"
#include "output_file.h"
#include "run_program.h"
#include "sim.h"
#include "study.h"
#include "study_rows.h"

struct study_page {
    const char *dir;
    const struct study *study;
    struct sim_output section;
    FILE *plot;
    char script[4096], svg[4096]; /* of the plot that is open, or was last */
    int no_gnuplot;               /* flag: said already */
};

static const char *const order[] = { "time", "depth", "memory", "stability" };

static const char style[] =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 "
    "1rem;color:#222;background:#fff}"
    "h1,h2,h3{line-height:1.2}h2{margin-top:3rem;border-bottom:1px solid #ccc}figure{margin:1.5rem 0}"
    "figcaption{color:#555;font-size:.9em}img{max-width:100%;height:auto}img.px{image-rendering:pixelated}"
    "table{border-collapse:collapse;font-size:.9em;font-variant-numeric:tabular-nums}"
    "td,th{padding:.15rem .5rem;text-align:right;border-bottom:1px solid #ddd}"
    "td:first-child,th:first-child{text-align:left}td{white-space:nowrap}.wide{overflow-x:auto}"
    ".wide table{font-size:.8em}";

/* ---- Parts of a section ------------------------------------------------------------------------------------------ */

void study_say(struct study_page *page, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    (void)fputs("<p>", page->section.file);
    (void)vfprintf(page->section.file, format, args);
    (void)fputs("</p>\n", page->section.file);
    va_end(args);
}

void study_head(struct study_page *page, const char *title)
{
    (void)fprintf(page->section.file, "<h3>%s</h3>\n", title);
}

static int embed(struct study_page *page, const char *path, const char *kind, const char *attributes,
                 const char *caption)
{
    size_t n;
    char *const in = study_read(path, &n);
    if (!in)
        return sim_refuse(path, 0, "cannot be read: %s", strerror(errno));
    char *const text = sim_alloc(SIM_BASE64_CHARS(n), 1);
    sim_base64_encode(text, in, n);
    (void)fprintf(page->section.file,
                  "<figure><img %s alt=\"\" src=\"data:image/%s;base64,%s\"><figcaption>%s</figcaption></figure>\n",
                  attributes, kind, text, caption);
    SIM_FREE(in, text);
    return SIM_OK;
}

int study_picture(struct study_page *page, const char *name, unsigned width, unsigned height, const unsigned char *rgb,
                  const char *caption)
{
    char path[4096], size[64];
    (void)snprintf(path, sizeof path, "%s/%s-%s.png", page->dir, page->study->name, name);
    (void)snprintf(size, sizeof size, "class=px width=%u height=%u", width, height);
    const int status = sim_png_save(path, width, height, rgb);
    return status == SIM_OK ? embed(page, path, "png", size, caption) : status;
}

/* Cells: text with bars between. */
static void cells(FILE *out, const char *tag, const char *text)
{
    (void)fprintf(out, "<tr><%s>", tag);
    for (; *text; text++)
        if (*text == '|')
            (void)fprintf(out, "</%s><%s>", tag, tag);
        else
            (void)fputc(*text, out);
    (void)fprintf(out, "</%s></tr>\n", tag);
}

void study_table_open(struct study_page *page, const char *columns)
{
    (void)fputs("<figure class=wide><table>\n", page->section.file);
    cells(page->section.file, "th", columns);
}

void study_table_row(struct study_page *page, const char *format, ...)
{
    char text[2048];
    va_list args;
    va_start(args, format);
    (void)vsnprintf(text, sizeof text, format, args);
    va_end(args);
    cells(page->section.file, "td", text);
}

void study_table_close(struct study_page *page, const char *caption)
{
    (void)fprintf(page->section.file, "</table><figcaption>%s</figcaption></figure>\n", caption);
}

/* ---- Plots ------------------------------------------------------------------------------------------------------- */

FILE *study_plot_open(struct study_page *page, const char *name, int width, int height)
{
    (void)snprintf(page->script, sizeof page->script, "%s/%s-%s.plot", page->dir, page->study->name, name);
    (void)snprintf(page->svg, sizeof page->svg, "%s/%s-%s.svg", page->dir, page->study->name, name);
    page->plot = fopen(page->script, "wb");
    if (!page->plot) {
        (void)sim_refuse(page->script, 0, "cannot be written: %s", strerror(errno));
        return NULL;
    }
    (void)fprintf(page->plot,
                  "set encoding utf8\n"
                  "set terminal svg size %d,%d background '#ffffff' font 'sans-serif,14'\n"
                  "set grid lc rgb '#dddddd'\nset border 3 lc rgb '#888888'\nset tics nomirror\n"
                  "set key outside right top Left reverse\nset datafile separator tab\n",
                  width, height);
    return page->plot;
}

/* gnuplot's exit status; 127: there is none. What it draws goes to `to`. Scripts are UTF-8, of which it warns where the
 * locale is another. */
static int run_gnuplot(const char *script, const char *to)
{
    posix_spawn_file_actions_t files;
    const char *const words[] = { "env", "LC_ALL=C.UTF-8", "gnuplot", script, NULL };
    (void)posix_spawn_file_actions_init(&files);
    (void)posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, to, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    return sim_run_program(words, &files);
}

int study_plot_close(struct study_page *page, const char *caption)
{
    char made[4104];
    (void)snprintf(made, sizeof made, "%s.part", page->svg);
    const int bad = ferror(page->plot) | fclose(page->plot);
    if (bad)
        return sim_refuse(page->script, 0, "cannot be written: %s", strerror(errno));
    if (page->no_gnuplot)
        return SIM_OK;
    (void)fflush(NULL);
    const int status = run_gnuplot(page->script, made);
    if (status < 0 || status == 127) {
        (void)unlink(made);
        page->no_gnuplot = 1;
        study_say(page, "Plots are missing here: gnuplot was not installed.");
        return SIM_OK;
    }
    if (status || rename(made, page->svg)) {
        (void)unlink(made);
        return sim_refuse(page->script, 0, "gnuplot could not draw this (%d)", status);
    }
    return embed(page, page->svg, "svg+xml", "", caption);
}

/* ---- The page
 * -------------------------------------------------------------------------------------------------------- */

struct study_page *study_page_open(const char *dir, const struct study *study, size_t runs)
{
    struct study_page *page = sim_alloc(1, sizeof *page);
    char path[4096];
    page->dir = dir;
    page->study = study;
    (void)snprintf(path, sizeof path, "%s/%s.section", dir, study->name);
    if (sim_output_open(&page->section, path) != SIM_OK) {
        free(page);
        return NULL;
    }
    (void)fprintf(page->section.file, "<section id=%s><h2>%s: %s</h2>\n<p>%zu runs, every one a row of %s.csv.</p>\n",
                  study->name, study->name, study->what, runs, study->name);
    return page;
}

static int write_index(const char *dir)
{
    char path[4096];
    struct sim_output out = { 0 };
    (void)snprintf(path, sizeof path, "%s/index.html", dir);
    const int status = sim_output_open(&out, path);
    if (status != SIM_OK)
        return status;
    (void)fprintf(out.file,
                  "<!DOCTYPE html>\n<html lang=en><meta charset=utf-8><title>zstrip: what settings give</title>\n"
                  "<meta name=viewport content=\"width=device-width\"><style>%s</style>\n"
                  "<h1>zstrip: what settings give</h1>\n",
                  style);
    for (size_t k = 0; k < sizeof order / sizeof order[0]; k++) {
        char buffer[65536];
        (void)snprintf(path, sizeof path, "%s/%s.section", dir, order[k]);
        FILE *in = fopen(path, "rb");
        if (!in) {
            (void)fprintf(out.file, "<section id=%s><h2>%s</h2><p>Not run yet: zsim study %s</p></section>\n", order[k],
                          order[k], order[k]);
            continue;
        }
        for (size_t n; (n = fread(buffer, 1, sizeof buffer, in)) > 0;)
            (void)fwrite(buffer, 1, n, out.file);
        (void)fclose(in);
    }
    (void)fputs("</html>\n", out.file);
    return sim_output_commit(&out, 1);
}

int study_page_close(struct study_page *page, int status)
{
    const int no_gnuplot = page->no_gnuplot;
    if (status == SIM_OK) {
        (void)fputs("</section>\n", page->section.file);
        status = sim_output_commit(&page->section, 1);
        if (status == SIM_OK)
            status = write_index(page->dir);
    } else {
        sim_output_abort(&page->section);
    }
    if (status == SIM_OK && no_gnuplot)
        status = sim_refuse(NULL, 0,
                            "gnuplot is not installed (package gnuplot-nox): %s/%s.csv and the page are written, "
                            "without plots",
                            page->dir, page->study->name);
    free(page);
    return status;
}
