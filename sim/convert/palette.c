/* The quantiser.
 *
 * Boxes of colours are cut in two until there are enough: always the box with the largest squared
 * error, at the place on one of its three axes that leaves the least (the criterion of Wu, Graphics
 * Gems II, 1991, here over the colours themselves and not over a grid). Then colours and means are
 * matched in turns (Lloyd 1982), with the means rounded to RGB565, since that is what the display
 * shows: for given matches the rounded mean is the best value there is. Means that meet leave
 * entries free; those go to the colours that are farthest off.
 *
 * Images of more than EXACT_MAX different colours are first gathered into cells of 4 x 4 x 4
 * values, each with its mean.
 *
 * SPDX-License-Identifier: MIT
 */
#include "palette.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zstrip.h"

#define EXACT_MAX 65536u
#define CELL_BITS 6 /* a channel, where there are more */
#define TURNS_MAX 40
#define REFILLS_MAX 8

/* A colour of the image and how many pixels have it. */
struct color {
    double c[3]; /* 0 .. 255 */
    double n;
};

struct colors {
    struct color *at;
    uint32_t n;
};

/* A consecutive run of colours. */
struct box {
    uint32_t first, n;
    double error; /* squared, around the mean */
    double gain;  /* what the best cut takes off it; 0: cannot be cut */
    int axis;     /* of that cut */
    uint32_t cut; /* colours before it, along that axis */
};

static void to_rgb(double out[3], uint16_t c)
{
    out[0] = (double)(c >> 11) * 255.0 / 31.0;
    out[1] = (double)(c >> 5 & 63) * 255.0 / 63.0;
    out[2] = (double)(c & 31) * 255.0 / 31.0;
}

static double at_most(double v, double most)
{
    return v < 0.0 ? 0.0 : v > most ? most : v;
}

static uint16_t to_565(const double c[3])
{
    const double r = rint(at_most(c[0], 255.0) * 31.0 / 255.0);
    const double g = rint(at_most(c[1], 255.0) * 63.0 / 255.0);
    const double b = rint(at_most(c[2], 255.0) * 31.0 / 255.0);
    return (uint16_t)((uint32_t)r << 11 | (uint32_t)g << 5 | (uint32_t)b);
}

static double distance(const double a[3], const double b[3])
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/* ---- Colours of an image --------------------------------------------------------------------- */

/* Every pixel as red, green, blue of 8 bits, ascending, into at[] and from there into spare[]. */
static void sort_pixels(uint32_t *at, uint32_t *spare, const struct sim_pixels *image)
{
    const size_t n = (size_t)image->w * image->h;
    for (size_t i = 0; i < n; i++)
        at[i] = (uint32_t)image->rgb[i][0] << 16 | (uint32_t)image->rgb[i][1] << 8 | image->rgb[i][2];
    for (int shift = 0; shift < 24; shift += 8) { /* three passes, the last into spare[] */
        size_t first[257] = { 0 };
        for (size_t i = 0; i < n; i++)
            first[(at[i] >> shift & 255) + 1]++;
        for (int k = 0; k < 256; k++)
            first[k + 1] += first[k];
        for (size_t i = 0; i < n; i++)
            spare[first[at[i] >> shift & 255]++] = at[i];
        uint32_t *const swap = at;
        at = spare;
        spare = swap;
    }
}

/* Each colour that there is. None, where there are more than EXACT_MAX. */
static struct colors gather_all(const struct sim_pixels *image)
{
    const size_t pixels = (size_t)image->w * image->h;
    uint32_t *at = sim_alloc(pixels, sizeof *at), *sorted = sim_alloc(pixels, sizeof *sorted);
    struct colors out = { NULL, 0 };
    sort_pixels(at, sorted, image);
    size_t n = 0;
    for (size_t i = 0; i < pixels; i++)
        n += i == 0 || sorted[i] != sorted[i - 1];
    if (n <= EXACT_MAX) {
        out.at = sim_alloc(n, sizeof *out.at);
        for (size_t i = 0; i < pixels; i++) {
            if (i == 0 || sorted[i] != sorted[i - 1]) {
                struct color *c = &out.at[out.n++];
                for (int k = 0; k < 3; k++)
                    c->c[k] = sorted[i] >> (16 - 8 * k) & 255;
            }
            out.at[out.n - 1].n += 1.0;
        }
    }
    free(at);
    free(sorted);
    return out;
}

static uint32_t cell_of(const uint8_t c[3])
{
    const int drop = 8 - CELL_BITS;
    return (uint32_t)(c[0] >> drop) << 2 * CELL_BITS | (uint32_t)(c[1] >> drop) << CELL_BITS |
           (uint32_t)(c[2] >> drop);
}

/* The means of cells, ascending by cell, so that the order of pixels does not matter. */
static struct colors gather_cells(const struct sim_pixels *image)
{
    const size_t cells = (size_t)1 << 3 * CELL_BITS;
    uint32_t *slot = sim_alloc(cells, sizeof *slot);
    struct colors out = { NULL, 0 };
    for (size_t i = 0; i < (size_t)image->w * image->h; i++)
        slot[cell_of(image->rgb[i])] = 1;
    for (size_t i = 0; i < cells; i++)
        if (slot[i] != 0)
            slot[i] = ++out.n;
    out.at = sim_alloc(out.n, sizeof *out.at);
    for (size_t i = 0; i < (size_t)image->w * image->h; i++) {
        struct color *c = &out.at[slot[cell_of(image->rgb[i])] - 1];
        for (int k = 0; k < 3; k++)
            c->c[k] += image->rgb[i][k]; /* sums are whole numbers: exact in any order */
        c->n += 1.0;
    }
    for (uint32_t i = 0; i < out.n; i++)
        for (int k = 0; k < 3; k++)
            out.at[i].c[k] /= out.at[i].n;
    free(slot);
    return out;
}

/* The image rounded to RGB565, if that has few enough colours. 0: it has more. */
static uint32_t exact_palette(uint16_t *palette, uint32_t most, const struct sim_pixels *image)
{
    uint8_t *seen = sim_alloc(65536, 1);
    uint32_t n = 0;
    for (size_t i = 0; i < (size_t)image->w * image->h && n <= most; i++) {
        const uint8_t *c = image->rgb[i];
        uint8_t *s = &seen[zs_rgb565(c[0], c[1], c[2])];
        n += *s == 0;
        *s = 1;
    }
    if (n > most)
        n = 0;
    for (uint32_t c = 0, k = 0; c < 65536 && n > 0; c++)
        if (seen[c])
            palette[k++] = (uint16_t)c;
    free(seen);
    return n;
}

/* ---- Cutting --------------------------------------------------------------------------------- */

/* The colours of every box, sorted along each axis: box by box the same colours in each of the three.
 * They are sorted once; a cut keeps the order. */
struct sorted {
    struct color *at[3], *spare;
};

/* Along one axis, then the others: an order in which no two different colours are equal. */
static int compare(const void *left, const void *right, int axis)
{
    const double *a = ((const struct color *)left)->c, *b = ((const struct color *)right)->c;
    for (int i = 0; i < 3; i++) {
        const int k = (axis + i) % 3;
        if (a[k] < b[k] || a[k] > b[k])
            return a[k] < b[k] ? -1 : 1;
    }
    return 0;
}

static int by_red(const void *a, const void *b)
{
    return compare(a, b, 0);
}

static int by_green(const void *a, const void *b)
{
    return compare(a, b, 1);
}

static int by_blue(const void *a, const void *b)
{
    return compare(a, b, 2);
}

static int (*const by_axis[3])(const void *, const void *) = { by_red, by_green, by_blue };

static struct sorted sort_colors(const struct colors *colors)
{
    struct sorted s = { .spare = sim_alloc(colors->n, sizeof *s.spare) };
    for (int axis = 0; axis < 3; axis++) {
        s.at[axis] = sim_alloc(colors->n, sizeof *s.at[axis]);
        memcpy(s.at[axis], colors->at, colors->n * sizeof *colors->at);
        qsort(s.at[axis], colors->n, sizeof *s.at[axis], by_axis[axis]);
    }
    return s;
}

static void free_sorted(struct sorted *s)
{
    for (int axis = 0; axis < 3; axis++)
        free(s->at[axis]);
    free(s->spare);
}

/* Sums of a run of colours: pixels, channels. */
struct sums {
    double n, c[3];
};

static void add(struct sums *s, const struct color *c)
{
    s->n += c->n;
    for (int k = 0; k < 3; k++)
        s->c[k] += c->n * c->c[k];
}

/* |sum|^2 / n: what the mean of a run takes off the sum of squares. */
static double weight(const struct sums *s)
{
    return (s->c[0] * s->c[0] + s->c[1] * s->c[1] + s->c[2] * s->c[2]) / s->n;
}

static void find_cut(struct box *box, const struct sorted *sorted)
{
    struct sums all = { 0 };
    double squares = 0.0;
    for (uint32_t i = 0; i < box->n; i++) {
        const struct color *c = &sorted->at[0][box->first + i];
        add(&all, c);
        for (int k = 0; k < 3; k++)
            squares += c->n * c->c[k] * c->c[k];
    }
    box->error = squares - weight(&all);
    box->gain = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        struct sums low = { 0 };
        for (uint32_t i = 0; i + 1 < box->n; i++) {
            add(&low, &sorted->at[axis][box->first + i]);
            const struct sums high = {
                all.n - low.n, { all.c[0] - low.c[0], all.c[1] - low.c[1], all.c[2] - low.c[2] }
            };
            const double gain = weight(&low) + weight(&high) - weight(&all);
            if (gain > box->gain) {
                box->gain = gain;
                box->axis = axis;
                box->cut = i + 1;
            }
        }
    }
}

/* Of a box, its low colours first, in all three orders; along its own axis they are. */
static void part(struct sorted *sorted, const struct box *box)
{
    const struct color *first_high = &sorted->at[box->axis][box->first + box->cut];
    for (int i = 1; i < 3; i++) {
        struct color *at = sorted->at[(box->axis + i) % 3] + box->first;
        uint32_t low = 0, high = 0;
        for (uint32_t k = 0; k < box->n; k++)
            if (compare(&at[k], first_high, box->axis) < 0)
                at[low++] = at[k];
            else
                sorted->spare[high++] = at[k];
        memcpy(at + low, sorted->spare, high * sizeof *at);
    }
}

/* Means of boxes, into mean; return how many. */
static uint32_t cut_boxes(double (*mean)[3], uint32_t most, const struct colors *colors)
{
    struct sorted sorted = sort_colors(colors);
    struct box box[SIM_PALETTE_MAX];
    uint32_t n = 1;
    box[0] = (struct box){ .first = 0, .n = colors->n };
    find_cut(&box[0], &sorted);
    while (n < most) {
        uint32_t worst = 0;
        for (uint32_t i = 1; i < n; i++)
            if (box[i].gain > 0.0 && (box[worst].gain <= 0.0 || box[i].error > box[worst].error))
                worst = i;
        struct box *b = &box[worst];
        if (b->gain <= 0.0)
            break;
        part(&sorted, b);
        box[n] = (struct box){ .first = b->first + b->cut, .n = b->n - b->cut };
        b->n = b->cut;
        find_cut(b, &sorted);
        find_cut(&box[n++], &sorted);
    }
    for (uint32_t i = 0; i < n; i++) {
        struct sums s = { 0 };
        for (uint32_t k = 0; k < box[i].n; k++)
            add(&s, &sorted.at[0][box[i].first + k]);
        for (int k = 0; k < 3; k++)
            mean[i][k] = s.c[k] / s.n;
    }
    free_sorted(&sorted);
    return n;
}

/* ---- Matching -------------------------------------------------------------------------------- */

/* Entries by red, so that a search ends where red alone is farther off than the best. */
struct entries {
    double entry[SIM_PALETTE_MAX][3]; /* red ascending */
    uint32_t index[SIM_PALETTE_MAX];  /* of that entry in the palette */
    uint32_t n;
};

static void put_entry(struct entries *e, uint16_t value)
{
    double c[3];
    to_rgb(c, value);
    uint32_t i = e->n++;
    for (; i > 0 && e->entry[i - 1][0] > c[0]; i--) {
        memcpy(e->entry[i], e->entry[i - 1], sizeof e->entry[i]);
        e->index[i] = e->index[i - 1];
    }
    memcpy(e->entry[i], c, sizeof c);
    e->index[i] = e->n - 1;
}

static void put_entries(struct entries *e, const uint16_t *palette, uint32_t n)
{
    e->n = 0;
    for (uint32_t i = 0; i < n; i++)
        put_entry(e, palette[i]);
}

/* The first entry of the palette that no other is nearer than: *at is where it stands by red, in, of
 * a colour like it, a guess, and out. */
static uint32_t nearest(const struct entries *e, uint32_t *at, const double c[3], double *squared)
{
    uint32_t from = *at, best = *at;
    double least = distance(e->entry[best], c);
    while (from + 1 < e->n && e->entry[from][0] < c[0])
        from++;
    while (from > 0 && e->entry[from][0] > c[0])
        from--;
    for (int up = 0; up < 2; up++)
        for (uint32_t i = up ? from + 1 : from; i < e->n; i = up ? i + 1 : i - 1) { /* 0 - 1: ends */
            const double red = e->entry[i][0] - c[0];
            if (red * red > least)
                break;
            const double d = distance(e->entry[i], c);
            if (d < least || (d <= least && e->index[i] < e->index[best])) {
                least = d;
                best = i;
            }
        }
    *at = best;
    *squared = least;
    return e->index[best];
}

static int by_value(const void *a, const void *b)
{
    return (int)*(const uint16_t *)a - (int)*(const uint16_t *)b;
}

/* Round means to RGB565, drop what is there twice. */
static uint32_t round_means(uint16_t *palette, double (*mean)[3], uint32_t n)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < n; i++)
        palette[i] = to_565(mean[i]);
    qsort(palette, n, sizeof *palette, by_value);
    for (uint32_t i = 0; i < n; i++)
        if (kept == 0 || palette[kept - 1] != palette[i])
            palette[kept++] = palette[i];
    return kept;
}

/* One turn: match colours with entries, and entries with their colours. */
struct match {
    double error; /* squared, of the entries as they came in */
    double mean[SIM_PALETTE_MAX][3];
    uint32_t n; /* means: entries that some colour chose */
};

static void match(struct match *m, const uint16_t *palette, uint32_t n, const struct colors *colors)
{
    struct entries entries;
    struct sums sum[SIM_PALETTE_MAX] = { { 0 } };
    uint32_t at = 0;
    put_entries(&entries, palette, n);
    m->error = 0.0;
    for (uint32_t i = 0; i < colors->n; i++) {
        double squared;
        add(&sum[nearest(&entries, &at, colors->at[i].c, &squared)], &colors->at[i]);
        m->error += squared * colors->at[i].n;
    }
    m->n = 0;
    for (uint32_t i = 0; i < n; i++)
        if (sum[i].n > 0.0) {
            for (int k = 0; k < 3; k++)
                m->mean[m->n][k] = sum[i].c[k] / sum[i].n;
            m->n++;
        }
}

/* Entries up to most, each the colour that is then farthest off, by pixels. */
static void refill(uint16_t *palette, uint32_t n, uint32_t most, const struct colors *colors)
{
    struct entries entries;
    double *squared = sim_alloc(colors->n, sizeof *squared), c[3];
    uint32_t at = 0;
    put_entries(&entries, palette, n);
    for (uint32_t i = 0; i < colors->n; i++)
        nearest(&entries, &at, colors->at[i].c, &squared[i]);
    for (; n < most; n++) {
        uint32_t worst = 0;
        for (uint32_t i = 1; i < colors->n; i++)
            if (squared[i] * colors->at[i].n > squared[worst] * colors->at[worst].n)
                worst = i;
        palette[n] = to_565(colors->at[worst].c);
        to_rgb(c, palette[n]);
        for (uint32_t i = 0; i < colors->n; i++)
            squared[i] = fmin(squared[i], distance(c, colors->at[i].c));
    }
    free(squared);
}

/* Turns until nothing changes. The best palette seen stays in best. */
static void refine(uint16_t *best, uint32_t *n_best, double *least, const uint16_t *from,
                   uint32_t n, struct match *m, const struct colors *colors)
{
    uint16_t now[SIM_PALETTE_MAX], next[SIM_PALETTE_MAX];
    memcpy(now, from, n * sizeof *now);
    for (int turn = 0; turn < TURNS_MAX; turn++) {
        match(m, now, n, colors);
        if (m->error < *least) {
            *least = m->error;
            *n_best = n;
            memcpy(best, now, n * sizeof *now);
        }
        const uint32_t n_next = round_means(next, m->mean, m->n);
        if (n_next == n && memcmp(next, now, n * sizeof *now) == 0)
            return;
        n = n_next;
        memcpy(now, next, n * sizeof *now);
    }
}

uint32_t sim_palette_build(uint16_t palette[SIM_PALETTE_MAX], uint32_t most,
                           const struct sim_pixels *image)
{
    uint32_t n = exact_palette(palette, most, image);
    if (n > 0)
        return n;
    struct colors colors = gather_all(image);
    if (colors.n == 0)
        colors = gather_cells(image);
    struct match *m = sim_alloc(1, sizeof *m);
    uint16_t from[SIM_PALETTE_MAX];
    double least = INFINITY;
    uint32_t n_from = cut_boxes(m->mean, most, &colors);
    n_from = round_means(from, m->mean, n_from);
    for (int i = 0; i < REFILLS_MAX; i++) {
        const double before = least;
        refine(palette, &n, &least, from, n_from, m, &colors);
        if (least >= before)
            break;
        memcpy(from, palette, n * sizeof *from);
        if (n == most)
            break;
        refill(from, n, most, &colors);
        n_from = most;
    }
    free(m);
    free(colors.at);
    return n;
}

/* ---- Texels ---------------------------------------------------------------------------------- */

/* Where a colour goes: into the palette, or to RGB565. */
struct target {
    struct entries entries; /* none: RGB565 */
    uint32_t at;           /* of the colour before */
};

static uint32_t choose(struct target *t, const double c[3], double shown[3])
{
    double squared;
    if (t->entries.n == 0) {
        const uint16_t v = to_565(c);
        to_rgb(shown, v);
        return v;
    }
    const uint32_t i = nearest(&t->entries, &t->at, c, &squared);
    memcpy(shown, t->entries.entry[t->at], 3 * sizeof *shown);
    return i;
}

/* What a row hands on to the next, with a pixel of air at both ends. */
static void hand_on(double (*here)[3], double (*below)[3], uint32_t at, int step,
                    const double lost[3])
{
    for (int k = 0; k < 3; k++) {
        here[at + (uint32_t)step][k] += lost[k] * 7.0 / 16.0;
        below[at - (uint32_t)step][k] += lost[k] * 3.0 / 16.0;
        below[at][k] += lost[k] * 5.0 / 16.0;
        below[at + (uint32_t)step][k] += lost[k] * 1.0 / 16.0;
    }
}

static void map(struct target *t, const struct sim_pixels *image, int dither, uint8_t *index,
                uint16_t *value)
{
    double(*row[2])[3] = { sim_alloc(image->w + 2, sizeof **row),
                           sim_alloc(image->w + 2, sizeof **row) };
    for (uint32_t y = 0; y < image->h; y++) {
        double(*here)[3] = row[y & 1], (*below)[3] = row[~y & 1];
        const int step = y & 1 ? -1 : 1;
        memset(below, 0, (image->w + 2) * sizeof *below);
        for (uint32_t i = 0; i < image->w; i++) {
            const uint32_t x = y & 1 ? image->w - 1 - i : i;
            const size_t at = (size_t)y * image->w + x;
            double c[3], shown[3], lost[3];
            for (int k = 0; k < 3; k++) /* what cannot be shown is not carried on for ever */
                c[k] = at_most(image->rgb[at][k] + here[x + 1][k], 255.0);
            const uint32_t v = choose(t, c, shown);
            if (index != NULL)
                index[at] = (uint8_t)v;
            else
                value[at] = (uint16_t)v;
            for (int k = 0; k < 3; k++)
                lost[k] = c[k] - shown[k];
            if (dither)
                hand_on(here, below, x + 1, step, lost);
        }
    }
    free(row[0]);
    free(row[1]);
}

void sim_palette_map(uint8_t *index, const struct sim_pixels *image, const uint16_t *palette,
                     uint32_t n_colors, int dither)
{
    struct target t = { .at = 0 };
    put_entries(&t.entries, palette, n_colors);
    map(&t, image, dither, index, NULL);
}

void sim_rgb565_map(uint16_t *out, const struct sim_pixels *image, int dither)
{
    struct target t = { .at = 0 };
    map(&t, image, dither, NULL, out);
}

struct sim_loss sim_rgb565_loss(const struct sim_pixels *image, const uint16_t *have)
{
    struct sim_loss loss = { 0.0, 0.0 };
    const size_t n = (size_t)image->w * image->h;
    double squared = 0.0;
    for (size_t i = 0; i < n; i++) {
        double shown[3];
        to_rgb(shown, have[i]);
        for (int k = 0; k < 3; k++) {
            const double off = fabs(shown[k] - image->rgb[i][k]);
            squared += off * off;
            loss.worst = fmax(loss.worst, off);
        }
    }
    loss.psnr_db = 10.0 * log10(255.0 * 255.0 * 3.0 * (double)n / squared);
    return loss;
}
