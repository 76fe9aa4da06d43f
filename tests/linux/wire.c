/* What happened on a panel's pins, from QEMU's trace of a PL061's edges on standard input.
 *
 *   wire FOLDER NAME...     one name for each time that line 7, MARK, is high
 *
 * FOLDER/NAME.stream  the bytes as `zsim panel --decode` takes them: little-endian uint16, bits 0-7 a byte, bit 8 its
 *                     D/C level; bit 9 RESET went low, bit 10 a frame is whole, bit 11 chip select went high
 * FOLDER/NAME.wire    lines "key value" (see report), and "problem TEXT" for what no panel would stand: clock edges
 *                     without chip select, a byte cut short or D/C changed in its middle, a bus that is not mode 0
 * Frames, for controllers with the MIPI command set: each begins with a row address (2Bh) that lies no lower on the
 * picture than the one before, and all end with the last data byte. The first is the driver's clearing to black.
 * What QEMU writes besides is passed on to standard error. The trace has no times: edges have an order alone.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    char pins[4096];                     /* edges of RESET and BACKLIGHT, and where bytes went in between */
    int talked;
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
    (void)snprintf(run.pins + at, sizeof run.pins - at, " %s%s%d", run.talked ? "bytes " : "", name_of[line], to);
    run.talked = 0;
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
    run.talked = 1;
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

/* Does a row address stand at words[i]? Then its first row. */
static int rows_at(size_t i, unsigned *row)
{
    if (run.words[i] != 0x2b)
        return 0;
    unsigned args[2], n = 0;
    for (size_t k = i + 1; k < run.n && n < 2 && (run.words[k] & (DATA | DESELECT)); k++)
        if (!(run.words[k] & MARKS)) /* chip select may go up between a command and its arguments */
            args[n++] = run.words[k] & 0xffu;
    *row = n == 2 ? args[0] << 8 | args[1] : 0;
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
    (void)fprintf(report, "bytes %zu\ncs_pulses %zu\nlongest %zu\nedges %zu\npins%s%s\nlevels RESET%d BACKLIGHT%d\n",
                  run.bytes, run.cs_pulses, run.longest, run.n_edges, run.pins, run.talked ? " bytes" : "",
                  level[RESET], level[LIGHT]);
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

int main(int argc, char **argv)
{
    static const char output[] = "pl061_set_output ", input[] = "pl061_input_change ";
    char text[512];
    int next = 2;
    while (argc > 2 && fgets(text, sizeof text, stdin)) {
        const int out = !strncmp(text, output, sizeof output - 1);
        const size_t n = strlen(text);
        if (!out && strncmp(text, input, sizeof input - 1)) {
            (void)fputs(text, stderr);
            continue;
        }
        /* "... setting output 0 to 1", "... input 3 changed to 1": read from the end, for speed */
        const int line = text[n - (out ? sizeof "0 to 1" : sizeof "3 changed to 1")] - '0', to = text[n - 2] - '0';
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
