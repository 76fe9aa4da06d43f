/* What happened on a panel's pins, from QEMU's trace of a PL061's edges on standard input.
 *
 *   wire FOLDER NAME...     one name for each time that line 7, MARK, is high
 *
 * FOLDER/NAME.stream  the bytes as `zsim panel --decode` takes them: little-endian uint16, bits 0-7 a byte, bit 8 its
 *                     D/C level; bit 9 RESET went low, bit 10 a frame is whole, bit 11 chip select went high
 * FOLDER/NAME.wire    lines "key value" (see report), and "problem TEXT" for what no panel would stand: clock edges
 *                     without chip select, a byte cut short or D/C changed in its middle, a bus that is not mode 0
 * Frames: each begins with a window whose first row lies no lower than that of the window before, and the last ends
 * with the last data byte. The first is the driver's clearing to black. That is so where windows go down the picture:
 * with the MIPI command set at any rotation, with an SSD1351 or SSD1306 that is not turned; else only the last counts.
 * What QEMU writes besides is passed on to standard error. The trace has no times: edges have an order alone.
 *
 * SPDX-License-Identifier: MIT
 */
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { SCK, MOSI, CS, TE, DC, RESET, LIGHT, MARK, LINES };
enum { DATA = 0x100, WENT_RESET = 0x200, FRAME = 0x400, DESELECT = 0x800, MARKS = 0xe00 };
enum { PROBLEMS = 8 };

static const char *const name_of[LINES] = { "SCK", "MOSI", "CS", "TE", "DC", "RESET", "BACKLIGHT", "MARK" };

/* One run: while MARK is high. */
static struct {
    const char *name; /* NULL: none */
    uint16_t *words;
    size_t n, room, bytes;
    size_t cs_pulses, longest, selected; /* bytes while CS is low: at most, now */
    size_t *edges, n_edges;              /* rising edges of TE: the number of words before each */
    size_t n_problems;
    char problem[PROBLEMS][100];
    char pins[4096];                     /* edges of RESET and BACKLIGHT, and how many bytes went before each */
} run;

static int level[LINES];
static unsigned shift, bits, first_dc;

static void *grown(void *at, size_t bytes)
{
    void *p = realloc(at, bytes);
    if (p == NULL) {
        perror("wire");
        exit(1);
    }
    return p;
}

static void problem(const char *what)
{
    if (run.n_problems < PROBLEMS)
        (void)snprintf(run.problem[run.n_problems], sizeof run.problem[0], "byte %zu: %s", run.bytes, what);
    run.n_problems++;
}

static void word(unsigned w)
{
    if (run.n == run.room) {
        run.room = run.room ? 2 * run.room : 4096;
        run.words = grown(run.words, run.room * sizeof *run.words);
    }
    run.words[run.n++] = (uint16_t)w;
}

/* ---- Edges -------------------------------------------------------------------------------------------------- */

static void pin_seen(int line, int to)
{
    const size_t at = strlen(run.pins);
    (void)snprintf(run.pins + at, sizeof run.pins - at, " %zu:%s%d", run.bytes, name_of[line], to);
}

static void bit(void)
{
    if (level[CS])
        problem("clock without chip select");
    if (!level[RESET])
        problem("clock while RESET is low");
    if (bits == 0)
        first_dc = (unsigned)level[DC];
    shift = shift << 1 | (unsigned)level[MOSI];
    if (++bits < 8)
        return;
    word((shift & 0xffu) | (first_dc ? DATA : 0u));
    bits = 0;
    run.bytes++;
    run.selected++;
}

static void select_edge(int to)
{
    if (level[SCK])
        problem("chip select changed while the clock was high: not mode 0");
    if (bits != 0)
        problem("a byte was cut short");
    bits = 0;
    if (to) {
        word(DESELECT);
        run.cs_pulses++;
        if (run.longest < run.selected)
            run.longest = run.selected;
    }
    run.selected = 0;
}

static void te_edge(int to)
{
    if (!to)
        return;
    run.edges = grown(run.edges, (run.n_edges + 1) * sizeof *run.edges);
    run.edges[run.n_edges++] = run.n;
}

static void edge(int line, int to)
{
    if (line == SCK && to)
        bit();
    if (line == MOSI && level[SCK] && !level[CS])
        problem("MOSI changed while the clock was high: not mode 0");
    if (line == CS)
        select_edge(to);
    if (line == DC && bits != 0)
        problem("D/C changed in the middle of a byte");
    if (line == TE)
        te_edge(to);
    if (line == RESET && !to)
        word(WENT_RESET);
    if (line == RESET || line == LIGHT)
        pin_seen(line, to);
}

/* ---- Frames ------------------------------------------------------------------------------------------------- */

/* Does a window's rows stand at words[i]? Then its first one. 2Bh is the MIPI command set's, 75h the SSD1351's, both
 * with arguments as data; 22h is the SSD1306's, its pages, with arguments as commands. */
static int rows_at(size_t i, unsigned *row)
{
    const unsigned code = run.words[i], as = code == 0x22 ? 0 : DATA;
    unsigned args[2] = { 0 }, n = 0;
    if (code != 0x2b && code != 0x75 && code != 0x22)
        return 0;
    for (size_t k = i + 1; k < run.n && n < 2; k++) {
        if (run.words[k] & MARKS)
            continue; /* chip select may go up in between */
        if ((run.words[k] & DATA) != as)
            return 0;
        args[n++] = run.words[k] & 0xffu;
    }
    *row = code == 0x2b && n == 2 ? args[0] << 8 | args[1] : args[0];
    return n == 2;
}

/* Edges of TE from the word before `from` to that before `to`. */
static size_t edges_between(size_t from, size_t to)
{
    size_t n = 0;
    for (size_t i = 0; i < run.n_edges; i++)
        n += run.edges[i] > from && run.edges[i] <= to;
    return n;
}

static void put(FILE *f, unsigned w)
{
    (void)putc((int)(w & 0xffu), f);
    (void)putc((int)(w >> 8), f);
}

/* The stream with its frame marks; "frame_edges": for each frame but the first, how many edges of TE came between the
 * beginning of the one before and its own; "frame_bytes": what each was on the wire. */
static void write_stream(FILE *stream, FILE *report)
{
    size_t last = 0, begun = 0, bytes = 0, n_frames = 0;
    unsigned row, row_before = 0;
    char edges[1024] = "", sizes[1024] = "";
    for (size_t i = 0; i < run.n; i++)
        if (run.words[i] & DATA)
            last = i;
    for (size_t i = 0; i < run.n; i++) {
        if (rows_at(i, &row)) {
            if (n_frames && row <= row_before) {
                put(stream, FRAME);
                (void)snprintf(edges + strlen(edges), sizeof edges - strlen(edges), " %zu", edges_between(begun, i));
                (void)snprintf(sizes + strlen(sizes), sizeof sizes - strlen(sizes), " %zu", bytes);
            }
            if (!n_frames || row <= row_before) {
                n_frames++;
                begun = i;
                bytes = 0;
            }
            row_before = row;
        }
        put(stream, run.words[i]);
        bytes += !(run.words[i] & MARKS);
        if (i == last && (run.words[i] & DATA)) {
            put(stream, FRAME);
            (void)snprintf(sizes + strlen(sizes), sizeof sizes - strlen(sizes), " %zu", bytes);
        }
    }
    (void)fprintf(report, "frames %zu\nframe_edges%s\nframe_bytes%s\n", n_frames, edges, sizes);
}

/* The last words without data: what the panel was told in the end, such as 28 10. */
static void write_end(FILE *report)
{
    size_t i = run.n;
    while (i > 0 && !(run.words[i - 1] & DATA))
        i--;
    (void)fputs("end", report);
    for (; i < run.n; i++)
        if (!(run.words[i] & MARKS))
            (void)fprintf(report, " %02x", (unsigned)run.words[i]);
    (void)fputc('\n', report);
}

/* ---- Runs --------------------------------------------------------------------------------------------------- */

static void begin(const char *name)
{
    memset(&run, 0, sizeof run);
    run.name = name;
    bits = 0;
}

static FILE *create(const char *folder, const char *kind)
{
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/%s.%s", folder, run.name, kind);
    FILE *f = fopen(path, "wb");
    if (f == NULL) {
        perror(path);
        exit(1);
    }
    return f;
}

static void finish(const char *folder)
{
    FILE *stream = create(folder, "stream"), *report = create(folder, "wire");
    if (!level[CS])
        problem("chip select was left low");
    write_stream(stream, report);
    write_end(report);
    (void)fprintf(report, "bytes %zu\ncs_pulses %zu\nlongest %zu\nedges %zu\npins%s\nlevels RESET%d BACKLIGHT%d\n",
                  run.bytes, run.cs_pulses, run.longest, run.n_edges, run.pins, level[RESET], level[LIGHT]);
    for (size_t i = 0; i < run.n_problems && i < PROBLEMS; i++)
        (void)fprintf(report, "problem %s\n", run.problem[i]);
    if (fclose(stream) || fclose(report)) {
        perror("wire");
        exit(1);
    }
    free(run.words);
    free(run.edges);
    run.name = NULL;
}

/* ---- The trace ---------------------------------------------------------------------------------------------- */

/* The next line, its end taken off, and its length; NULL: no more. QEMU writes line by line, hundreds in a
 * millisecond: a reader that waited for each would be woken for each, which took as long as all the rest. */
static char *next_line(size_t *length)
{
    static const struct timespec pause = { 0, 1000000 };
    static char text[1 << 18];
    static size_t at, end;
    char *stop;
    while ((stop = memchr(text + at, '\n', end - at)) == NULL) {
        memmove(text, text + at, end - at);
        end -= at;
        at = 0;
        const ssize_t n = end < sizeof text ? read(STDIN_FILENO, text + end, sizeof text - end) : 0;
        if (n <= 0)
            return NULL;
        end += (size_t)n;
        (void)nanosleep(&pause, NULL);
    }
    char *line = text + at;
    *stop = '\0';
    *length = (size_t)(stop - line);
    at += *length + 1;
    return line;
}

int main(int argc, char **argv)
{
    static const char output[] = "pl061_set_output ", input[] = "pl061_input_change ";
    char *text;
    size_t n;
    int next = 2;
    (void)fcntl(STDIN_FILENO, F_SETPIPE_SZ, 1 << 20);
    while (argc > 2 && (text = next_line(&n)) != NULL) {
        const int out = !strncmp(text, output, sizeof output - 1);
        if (!out && strncmp(text, input, sizeof input - 1)) {
            (void)fprintf(stderr, "%s\n", text);
            continue;
        }
        /* "... setting output 0 to 1", "... input 3 changed to 1": read from the end, for speed */
        const int line = text[n - (out ? strlen("0 to 1") : strlen("3 changed to 1"))] - '0', to = text[n - 1] - '0';
        if (line < 0 || line >= LINES || (to & ~1) || (out && line == TE))
            continue;
        if (line == MARK && to && next < argc)
            begin(argv[next++]);
        if (run.name)
            edge(line, to);
        level[line] = to;
        if (line == MARK && !to && run.name)
            finish(argv[1]);
    }
    if (argc < 3 || next < argc)
        (void)fprintf(stderr, "wire: %s\n", argc < 3 ? "usage: wire FOLDER NAME..." : "not every run was seen");
    return argc < 3 || next < argc;
}
