/* MTL text: the lines newmtl, Kd, d, Tr, Ke, Ks, Ns, map_Kd and map_d; of other maps, that they are there.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "losses.h"
#include "scan.h"
#include "sim.h"

struct word {
    const char *p;
    size_t n;
};

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* The next word of a line that ends at `end`; *at moves behind it. 0 at the end. */
static int next_word(const char **at, const char *end, struct word *w)
{
    while (*at < end && is_blank(**at))
        (*at)++;
    w->p = *at;
    while (*at < end && !is_blank(**at))
        (*at)++;
    w->n = (size_t)(*at - w->p);
    return w->n > 0;
}

static int is(const struct word *w, const char *text)
{
    return w->n == strlen(text) && strncasecmp(w->p, text, w->n) == 0;
}

static int number(const struct word *w, double *out)
{
    char text[64], *end;
    if (w->n == 0 || w->n >= sizeof text)
        return 0;
    memcpy(text, w->p, w->n);
    text[w->n] = '\0';
    *out = strtod(text, &end);
    return *end == '\0' && isfinite(*out);
}

/* Up to `most` numbers; how many there were. What is no number stays unread. */
static int numbers(const char **at, const char *end, double *out, int most)
{
    struct word w;
    int n = 0;
    for (const char *ahead = *at; n < most && next_word(&ahead, end, &w); n++) {
        double value;
        if (!number(&w, &value))
            break;
        out[n] = value;
        *at = ahead;
    }
    return n;
}

/* What is left of a line, without blanks around it; malloc'ed, NULL where there is nothing. */
static char *rest(const char *at, const char *end)
{
    while (at < end && is_blank(*at))
        at++;
    while (end > at && is_blank(end[-1]))
        end--;
    if (end == at)
        return NULL;
    char *text = sim_alloc((size_t)(end - at) + 1, 1);
    memcpy(text, at, (size_t)(end - at));
    return text;
}

static void take_color(double out[3], const char *at, const char *end)
{
    double c[3];
    const int n = numbers(&at, end, c, 3);
    for (int k = 0; k < 3 && n > 0; k++)
        out[k] = c[k < n ? k : n - 1]; /* one number stands for all */
}

static void take_opacity(struct sim_mtl_entry *e, int inverse, const char *at, const char *end)
{
    double d;
    if (numbers(&at, end, &d, 1) == 1) /* -halo, which depends on the view, is no number */
        e->d = fmin(fmax(inverse ? 1.0 - d : d, 0.0), 1.0);
}

/* Options, which of a mask do not count, then the name up to the line's end: it may hold blanks. */
static void take_map(struct sim_mtl_entry *e, char **name, const char *at, const char *end)
{
    static const char *const one[] = { "-blendu", "-blendv", "-boost", "-texres", "-bm",
                                       "-imfchan", "-type", "-cc" };
    const char *ahead = at;
    struct word w;
    double ignored[3];
    while (next_word(&ahead, end, &w) && w.p[0] == '-') {
        double value[3];
        int known = 1;
        if (is(&w, "-s") || is(&w, "-o")) {
            double *to = name != &e->picture ? ignored : is(&w, "-s") ? e->scale : e->shift;
            const int n = numbers(&ahead, end, value, 3);
            memcpy(to, value, sizeof *to * (size_t)(n < 2 ? n : 2));
        } else if (is(&w, "-t")) {
            (void)numbers(&ahead, end, ignored, 3);
        } else if (is(&w, "-mm")) {
            (void)numbers(&ahead, end, ignored, 2);
        } else if (is(&w, "-clamp")) {
            const int on = next_word(&ahead, end, &w) && is(&w, "on");
            e->clamp = name == &e->picture ? on : e->clamp;
        } else {
            known = 0;
            for (size_t i = 0; i < sizeof one / sizeof one[0]; i++)
                known |= is(&w, one[i]);
            if (known)
                (void)next_word(&ahead, end, &w);
        }
        if (!known) /* the name begins with a minus */
            break;
        at = ahead;
    }
    free(*name);
    *name = rest(at, end);
}

_Static_assert(SIM_LOST_KINDS <= 64, "other_maps has bits for all");

static uint64_t other_map(const struct word *w)
{
    static const struct {
        const char *word;
        enum sim_lost_kind kind;
    } known[] = { { "map_Bump", SIM_LOST_NORMAL_MAP },   { "bump", SIM_LOST_NORMAL_MAP },
                  { "norm", SIM_LOST_NORMAL_MAP },       { "disp", SIM_LOST_NORMAL_MAP },
                  { "map_Ks", SIM_LOST_SPECULAR_MAP },   { "map_Ns", SIM_LOST_SPECULAR_MAP },
                  { "map_Ke", SIM_LOST_EMISSION_MAP },   { "map_Pr", SIM_LOST_METAL_MAP },
                  { "map_Pm", SIM_LOST_METAL_MAP },      { "map_Ka", SIM_LOST_OTHER_MAP },
                  { "refl", SIM_LOST_OTHER_MAP },        { "decal", SIM_LOST_OTHER_MAP },
                  { "map_disp", SIM_LOST_NORMAL_MAP },   { "map_norm", SIM_LOST_NORMAL_MAP },
                  { "map_Kn", SIM_LOST_NORMAL_MAP },     { "map_opacity", SIM_LOST_OPACITY_MAP },
                  { "map_Tr", SIM_LOST_OPACITY_MAP },    { "map_emissive", SIM_LOST_EMISSION_MAP } };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (is(w, known[i].word))
            return (uint64_t)1 << known[i].kind;
    return w->n > 4 && strncasecmp(w->p, "map_", 4) == 0 && !is(w, "map_aat") ? (uint64_t)1 << SIM_LOST_OTHER_MAP : 0;
}

static void take_line(struct sim_mtl *mtl, const char *at, const char *end)
{
    struct word w;
    if (!next_word(&at, end, &w))
        return;
    if (is(&w, "newmtl")) {
        char *given = rest(at, end), *name = given != NULL ? given : sim_alloc(1, 1);
        mtl->entry = sim_grow(mtl->entry, mtl->n + 1, sizeof *mtl->entry);
        mtl->entry[mtl->n++] = (struct sim_mtl_entry){ .name = name,
                                                       .kd = { 1.0, 1.0, 1.0 },
                                                       .d = 1.0,
                                                       .scale = { 1.0, 1.0 } };
        return;
    }
    struct sim_mtl_entry *e = mtl->n > 0 ? &mtl->entry[mtl->n - 1] : NULL;
    if (e == NULL)
        return;
    if (is(&w, "Kd"))
        take_color(e->kd, at, end);
    else if (is(&w, "Ke"))
        take_color(e->ke, at, end);
    else if (is(&w, "Ks"))
        take_color(e->ks, at, end);
    else if (is(&w, "Ns"))
        (void)numbers(&at, end, &e->ns, 1);
    else if (is(&w, "d") || is(&w, "Tr"))
        take_opacity(e, is(&w, "Tr"), at, end);
    else if (is(&w, "map_Kd"))
        take_map(e, &e->picture, at, end);
    else if (is(&w, "map_d"))
        take_map(e, &e->mask, at, end);
    else
        e->other_maps |= other_map(&w);
}

void sim_mtl_scan(struct sim_mtl *mtl, const char *text, size_t bytes)
{
    const char *end = text + bytes;
    if (bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3; /* byte order mark */
    for (const char *at = text; at < end;) {
        const char *stop = at;
        while (stop < end && *stop != '\n' && *stop != '\r')
            stop++;
        take_line(mtl, at, stop);
        at = stop < end ? stop + 1 : end;
    }
}

const struct sim_mtl_entry *sim_mtl_find(const struct sim_mtl *mtl, const char *name)
{
    for (size_t i = mtl->n; i-- > 0;)
        if (strcmp(mtl->entry[i].name, name) == 0)
            return &mtl->entry[i];
    return NULL;
}

void sim_mtl_free(struct sim_mtl *mtl)
{
    for (size_t i = 0; i < mtl->n; i++) {
        free(mtl->entry[i].name);
        free(mtl->entry[i].picture);
        free(mtl->entry[i].mask);
    }
    free(mtl->entry);
    memset(mtl, 0, sizeof *mtl);
}
