/* PLY: the header's promises against the body, text or binary. Elements that assimp does not know are cut out.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scan.h"
#include "sim.h"

#define ELEMENTS_MAX 16
#define PROPERTIES_MAX 64

enum format { FORMAT_NONE, FORMAT_ASCII, FORMAT_LITTLE, FORMAT_BIG };
enum role { ROLE_OTHER, ROLE_POSITION, ROLE_INDICES, ROLE_UV };

struct type {
    const char *name[2];
    uint8_t bytes;
    char kind; /* i signed, u unsigned, f floating */
};

static const struct type types[] = {
    { { "char", "int8" }, 1, 'i' },    { { "uchar", "uint8" }, 1, 'u' },
    { { "short", "int16" }, 2, 'i' },  { { "ushort", "uint16" }, 2, 'u' },
    { { "int", "int32" }, 4, 'i' },    { { "uint", "uint32" }, 4, 'u' },
    { { "float", "float32" }, 4, 'f' }, { { "double", "float64" }, 8, 'f' },
};

struct property {
    const struct type *count; /* NULL unless a list */
    const struct type *type;
    enum role role;
};

struct element {
    char name[32];
    unsigned long long n;
    struct property property[PROPERTIES_MAX];
    int n_properties;
    const char *head[2], *body[2]; /* from and to: its lines of the header, its records */
};

struct ply {
    const char *file;
    struct sim_ply *out;
    struct sim_lost *lost;
    double *value; /* [n_values] of the face in hand, of its list of uv */
    size_t n_values, room, n_corners;
    const char *p, *end;
    unsigned long line;
    enum format format;
    struct element element[ELEMENTS_MAX];
    int n_elements;
    const char *picture; /* the last texture's name, in the text; NULL: none so far */
    size_t picture_length;
    unsigned long long n_vertices, n_faces;
};

static int cut_off(const struct ply *s, const struct element *e, unsigned long long i)
{
    return sim_refuse(s->file, s->format == FORMAT_ASCII ? s->line : 0,
                      "cut off: it ends in %s %llu of %llu; get the whole file", e->name, i + 1,
                      e->n);
}

/* ---- Header ---------------------------------------------------------------------------------- */

/* The next line's words, at most n, into one buffer. -1 at the end of the file. */
static int take_words(struct ply *s, char text[256], char *word[], int n)
{
    if (s->p >= s->end)
        return -1;
    size_t length = 0;
    for (; s->p < s->end && *s->p != '\n' && *s->p != '\r'; s->p++)
        if (length < 255)
            text[length++] = *s->p;
    text[length] = '\0';
    if (s->p < s->end && *s->p == '\r')
        s->p++;
    if (s->p < s->end && *s->p == '\n')
        s->p++;
    s->line++;
    int count = 0;
    for (char *w = strtok(text, " \t"); w != NULL && count < n; w = strtok(NULL, " \t"))
        word[count++] = w;
    return count;
}

static const struct type *find_type(const char *name)
{
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (strcmp(types[i].name[0], name) == 0 || strcmp(types[i].name[1], name) == 0)
            return &types[i];
    return NULL;
}

static int take_property(struct ply *s, char *word[], int n)
{
    static const char *const colors[] = { "red", "r", "green", "g", "blue", "b" };
    const int is_list = n == 5 && strcmp(word[1], "list") == 0;
    if (s->n_elements == 0 || (!is_list && n != 3) ||
        s->element[s->n_elements - 1].n_properties == PROPERTIES_MAX)
        return sim_refuse(s->file, s->line - 1, "a property that makes no sense here");
    struct element *e = &s->element[s->n_elements - 1];
    struct property *p = &e->property[e->n_properties++];
    const char *name = word[n - 1];
    p->count = is_list ? find_type(word[2]) : NULL;
    p->type = find_type(word[n - 2]);
    if (p->type == NULL || (is_list && (p->count == NULL || p->count->kind == 'f')))
        return sim_refuse(s->file, s->line - 1, "a property of unknown type");
    p->role = ROLE_OTHER;
    if (strcmp(e->name, "vertex") == 0 && !is_list && strlen(name) == 1 && strchr("xyz", name[0]))
        p->role = ROLE_POSITION;
    if (strcmp(e->name, "face") == 0 && is_list && strncmp(name, "vertex_ind", 10) == 0)
        p->role = ROLE_INDICES;
    if (strcmp(e->name, "face") == 0 && is_list && strcmp(name, "texcoord") == 0)
        p->role = ROLE_UV;
    for (size_t i = 0; !is_list && i < sizeof colors / sizeof colors[0]; i++)
        s->out->colors |= strcmp(e->name, "vertex") == 0 && strcmp(name, colors[i]) == 0;
    if (strcmp(e->name, "vertex") == 0 && strcmp(name, "diffuse_red") == 0)
        sim_lose(s->lost, SIM_LOST_COLORS, name);
    if (strcmp(e->name, "face") == 0 && (strcmp(name, "red") == 0 || strcmp(name, "diffuse_red") == 0))
        sim_lose(s->lost, SIM_LOST_COLORS, "of faces");
    return SIM_OK;
}

static int take_element(struct ply *s, const char *line, char *word[], int n)
{
    char *end = NULL;
    if (n != 3 || s->n_elements == ELEMENTS_MAX || strlen(word[1]) > 31 || word[2][0] == '-')
        return sim_refuse(s->file, s->line - 1, "an element that makes no sense");
    struct element *e = &s->element[s->n_elements++];
    e->n_properties = 0;
    e->head[0] = line;
    e->n = strtoull(word[2], &end, 10);
    if (*end != '\0')
        return sim_refuse(s->file, s->line - 1, "'%s' is not a count", word[2]);
    memcpy(e->name, word[1], strlen(word[1]) + 1);
    if (strcmp(e->name, "vertex") == 0)
        s->n_vertices = e->n;
    if (strcmp(e->name, "face") == 0)
        s->n_faces = e->n;
    if (strcmp(e->name, "tristrips") == 0 && e->n > 0)
        sim_lose(s->lost, SIM_LOST_STRIPS, "");
    return SIM_OK;
}

/* assimp takes the last one alone. */
static void take_picture(struct ply *s, const char *name)
{
    const size_t n = strcspn(name, "\r\n");
    if (s->picture != NULL && (n != s->picture_length || memcmp(name, s->picture, n) != 0)) {
        char lost[40];
        (void)snprintf(lost, sizeof lost, "%.*s", (int)(s->picture_length < 39 ? s->picture_length : 39), s->picture);
        sim_lose(s->lost, SIM_LOST_FURTHER_TEXTURE, lost);
    }
    s->picture = name;
    s->picture_length = n;
}

static int take_format(struct ply *s, const char *name)
{
    s->format = strcmp(name, "ascii") == 0                  ? FORMAT_ASCII
                : strcmp(name, "binary_little_endian") == 0 ? FORMAT_LITTLE
                : strcmp(name, "binary_big_endian") == 0    ? FORMAT_BIG
                                                            : FORMAT_NONE;
    return s->format != FORMAT_NONE ? SIM_OK
                                    : sim_refuse(s->file, s->line - 1, "unknown format '%s'", name);
}

/* Do faces stand before vertices? */
static int is_behind(const struct ply *s)
{
    int face = 0;
    for (int k = 0; k < s->n_elements; k++) {
        face |= strcmp(s->element[k].name, "face") == 0;
        if (strcmp(s->element[k].name, "vertex") == 0)
            return face;
    }
    return 0;
}

/* Do vertices, if there are any, have three coordinates? */
static int has_places(const struct ply *s)
{
    for (int k = 0; k < s->n_elements; k++) {
        int n = 0;
        for (int i = 0; i < s->element[k].n_properties; i++)
            n += s->element[k].property[i].role == ROLE_POSITION;
        if (strcmp(s->element[k].name, "vertex") == 0 && s->element[k].n > 0)
            return n == 3;
    }
    return 1;
}

static int take_header(struct ply *s)
{
    char text[256], *word[6];
    int n = take_words(s, text, word, 6);
    if (n != 1 || strcmp(word[0], "ply") != 0)
        return sim_refuse(s->file, 1, "not a PLY file: its first line is not `ply`");
    for (const char *line = s->p; (n = take_words(s, text, word, 6)) >= 0; line = s->p) {
        int status = SIM_OK;
        if (s->n_elements > 0 && n > 0 && (strcmp(word[0], "element") == 0 || strcmp(word[0], "end_header") == 0))
            s->element[s->n_elements - 1].head[1] = line;
        if (n >= 3 && strcmp(word[0], "comment") == 0 && strcmp(word[1], "TextureFile") == 0)
            take_picture(s, line + (word[2] - text));
        if (n == 0 || strcmp(word[0], "comment") == 0 || strcmp(word[0], "obj_info") == 0)
            continue;
        if (strcmp(word[0], "end_header") == 0 && s->format != FORMAT_NONE && is_behind(s))
            return sim_refuse(s->file, 0, "its faces stand before its vertices; export the model again");
        if (strcmp(word[0], "end_header") == 0 && s->format != FORMAT_NONE && !has_places(s))
            return sim_refuse(s->file, 0, "its vertices have no x, y and z; export the model again");
        if (strcmp(word[0], "end_header") == 0)
            return s->format != FORMAT_NONE ? SIM_OK
                                            : sim_refuse(s->file, 0, "a header without a format");
        if (strcmp(word[0], "format") == 0 && n >= 2)
            status = take_format(s, word[1]);
        else if (strcmp(word[0], "element") == 0)
            status = take_element(s, line, word, n);
        else if (strcmp(word[0], "property") == 0)
            status = take_property(s, word, n);
        else
            status = sim_refuse(s->file, s->line - 1, "'%s' does not belong in a header", word[0]);
        if (status != SIM_OK)
            return status;
    }
    return sim_refuse(s->file, s->line, "cut off: its header has no end; get the whole file");
}

/* ---- Body ------------------------------------------------------------------------------------ */

/* A number of the body: 1; 0 at the end of the line or file; -1 not a number. */
static int take_ascii(struct ply *s, double *out)
{
    while (s->p < s->end && (*s->p == ' ' || *s->p == '\t'))
        s->p++;
    if (s->p >= s->end || *s->p == '\n' || *s->p == '\r')
        return 0;
    char *end;
    *out = strtod(s->p, &end);
    if (end == s->p || !(*end == '\0' || strchr(" \t\r\n", *end)))
        return -1;
    s->p = end;
    return 1;
}

static int take_binary(struct ply *s, const struct type *t, double *out)
{
    unsigned char b[8];
    if ((size_t)(s->end - s->p) < t->bytes)
        return 0;
    for (int i = 0; i < t->bytes; i++) /* to little-endian */
        b[i] = (unsigned char)s->p[s->format == FORMAT_LITTLE ? i : t->bytes - 1 - i];
    s->p += t->bytes;
    uint64_t u = 0;
    for (int i = 0; i < t->bytes; i++)
        u |= (uint64_t)b[i] << (8 * i);
    if (t->kind == 'f' && t->bytes == 4) {
        const uint32_t u32 = (uint32_t)u;
        float f;
        memcpy(&f, &u32, sizeof f);
        *out = (double)f;
    } else if (t->kind == 'f') {
        memcpy(out, &u, sizeof *out);
    } else if (t->kind == 'i' && u >> (8 * t->bytes - 1)) {
        *out = (double)u - ldexp(1.0, 8 * t->bytes);
    } else {
        *out = (double)u;
    }
    return 1;
}

static int take_value(struct ply *s, const struct type *t, const struct element *e,
                      unsigned long long i, double *out)
{
    const int got = s->format == FORMAT_ASCII ? take_ascii(s, out) : take_binary(s, t, out);
    if (got < 0)
        return sim_refuse(s->file, s->line, "%s %llu holds something that is not a number", e->name,
                          i + 1);
    return got > 0 ? SIM_OK : cut_off(s, e, i);
}

static int take_list(struct ply *s, const struct property *p, const struct element *e,
                     unsigned long long i)
{
    const unsigned long line = s->format == FORMAT_ASCII ? s->line : 0;
    double n, v;
    int status = take_value(s, p->count, e, i, &n);
    if (status != SIM_OK)
        return status;
    if (!(n >= 0.0 && n <= 1e9) || n != floor(n))
        return sim_refuse(s->file, line, "%s %llu is a list of %g", e->name, i + 1, n);
    if (p->role == ROLE_INDICES && n < 3.0)
        return sim_refuse(s->file, line, "face %llu has %g vertices; it needs at least 3", i + 1,
                          n);
    if (p->role == ROLE_INDICES)
        s->n_corners = (size_t)n;
    for (long k = 0; k < (long)n; k++) {
        status = take_value(s, p->type, e, i, &v);
        if (status != SIM_OK)
            return status;
        if (p->role == ROLE_INDICES && !(v >= 0.0 && v < (double)s->n_vertices && v == floor(v)))
            return sim_refuse(s->file, line,
                              "vertex index %g of face %llu is out of range: 0 to %llu exist", v,
                              i + 1, s->n_vertices - 1);
        if (p->role == ROLE_UV && s->n_values == s->room)
            s->value = sim_grow(s->value, s->room = 2 * s->room + 8, sizeof *s->value);
        if (p->role == ROLE_UV)
            s->value[s->n_values++] = v;
    }
    return SIM_OK;
}

/* Of the face in hand: two numbers for each corner, or none. */
static void take_uvs(struct ply *s)
{
    struct sim_ply *out = s->out;
    if (out->n_uvs + s->n_corners > out->room)
        out->uv = sim_grow(out->uv, out->room = 2 * out->room + s->n_corners, sizeof *out->uv);
    for (size_t i = 0; i < s->n_corners; i++, out->n_uvs++)
        for (size_t k = 0; k < 2; k++)
            out->uv[out->n_uvs][k] = s->n_values == 2 * s->n_corners ? (float)s->value[2 * i + k] : NAN;
    s->n_corners = s->n_values = 0;
}

static int take_record(struct ply *s, const struct element *e, unsigned long long i)
{
    int has_uv = 0;
    for (int k = 0; k < e->n_properties; k++) {
        const struct property *p = &e->property[k];
        double v = 0.0;
        const int status =
            p->count != NULL ? take_list(s, p, e, i) : take_value(s, p->type, e, i, &v);
        if (status != SIM_OK)
            return status;
        if (p->role == ROLE_POSITION && !isfinite(v))
            return sim_refuse(
                s->file, s->format == FORMAT_ASCII ? s->line : 0,
                "vertex %llu has a coordinate that is not finite; export the model again", i + 1);
        has_uv |= p->role == ROLE_UV;
    }
    if (has_uv)
        take_uvs(s);
    return SIM_OK;
}

/* Text: skip empty lines before a record and the rest of the line after it. */
static void skip_lines(struct ply *s, int rest)
{
    if (s->format != FORMAT_ASCII)
        return;
    while (rest && s->p < s->end && *s->p != '\n' && *s->p != '\r')
        s->p++;
    while (s->p < s->end && strchr(" \t\r\n", *s->p) && *s->p != '\0') {
        if (*s->p == '\n' || (*s->p == '\r' && (s->p + 1 == s->end || s->p[1] != '\n')))
            s->line++;
        s->p++;
    }
}

static void cut(char *text, size_t *bytes, const char *const range[2])
{
    memmove(text + (range[0] - text), range[1], *bytes - (size_t)(range[1] - text) + 1);
    *bytes -= (size_t)(range[1] - range[0]);
}

/* assimp takes the records of elements that it does not know for those of faces behind them, and ends where there are
 * triangle strips. */
static void cut_unknown(const struct ply *s, char *text, size_t *bytes)
{
    static const char *const known[] = { "vertex", "face", "edge", "material" };
    for (int part = 0; part < 2; part++) /* from behind, so that what is still to be cut stays in place */
        for (int k = s->n_elements - 1; k >= 0; k--) {
            const struct element *e = &s->element[k];
            int is_known = 0;
            for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
                is_known |= strcmp(e->name, known[i]) == 0;
            if (!is_known)
                cut(text, bytes, part == 0 ? e->body : e->head);
        }
}

void sim_ply_free(struct sim_ply *ply)
{
    free(ply->uv);
    *ply = (struct sim_ply){ 0 };
}

int sim_ply_check(struct sim_ply *out, struct sim_lost *lost, const char *file, char *text, size_t *n)
{
    const size_t bytes = *n;
    struct ply *s = sim_alloc(1, sizeof *s);
    s->file = file;
    s->out = out;
    s->lost = lost;
    s->p = text;
    s->end = text + bytes;
    s->line = 1;
    int status = take_header(s);
    if (status == SIM_OK && s->n_faces == 0 && lost[SIM_LOST_STRIPS].n > 0)
        status = sim_refuse(file, 0, "its faces are triangle strips, which are not read; export it with faces");
    if (status == SIM_OK && s->n_faces == 0)
        status = sim_refuse(file, 0, "no faces in it; zsim draws polygons");
    skip_lines(s, 0);
    for (int k = 0; status == SIM_OK && k < s->n_elements; k++) {
        struct element *e = &s->element[k];
        e->body[0] = s->p;
        for (unsigned long long i = 0; status == SIM_OK && i < e->n && e->n_properties > 0; i++) {
            status = take_record(s, e, i);
            if (status == SIM_OK)
                skip_lines(s, 1);
            if (i % 4096 == 0)
                sim_progress("checking", (size_t)(s->p - text), bytes);
        }
        e->body[1] = s->p;
    }
    if (status == SIM_OK)
        cut_unknown(s, text, n);
    SIM_FREE(s->value, s);
    return status;
}
