/* OBJ text. One pass over tokens; a backslash at the end of a line is a space, a '#' that starts a
 * token ends the line. Positive indices may point forwards, so they are checked at the end.
 *
 * SPDX-License-Identifier: MIT
 */
#include <assimp/material.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "scan.h"
#include "sim.h"

struct buffer {
    char *text;
    size_t n, room;
};

struct scan {
    struct sim_obj *obj;
    const char *file;
    const char *p, *end;
    unsigned long line;
    size_t n_normals;
    size_t point_room, corner_room, face_room, uv_room;
    float (*rgb)[3];          /* [point_room], colours of vertices; -1: none */
    int colored;              /* flag: some vertex has one */
    int used, bare;           /* flags: there was a usemtl; a face stood before it */
    uint32_t *corner_normal;  /* [corner_room], or SIM_NONE */
    unsigned long *face_line; /* [face_room] */
    size_t texture_max;       /* the largest vt index, 1 .., and its line */
    unsigned long texture_line;
    struct buffer vertices, body; /* of the cleaned text; mtllib goes before, as assimp looks names up as it reads */
};

struct token {
    const char *p;
    size_t n;
};

static void __attribute__((format(printf, 2, 3))) emit(struct buffer *b, const char *format, ...)
{
    for (;;) {
        va_list args;
        va_start(args, format);
        const int n = vsnprintf(b->text ? b->text + b->n : NULL, b->room - b->n, format, args);
        va_end(args);
        if ((size_t)n < b->room - b->n) {
            b->n += (size_t)n;
            return;
        }
        b->room = 2 * b->room + (size_t)n + 4096;
        b->text = sim_grow(b->text, b->room, 1);
    }
}

static int is_newline(char c)
{
    return c == '\n' || c == '\r';
}

static int is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* Step over one line end, "\n", "\r" or "\r\n". */
static void take_newline(struct scan *s)
{
    if (s->p < s->end && *s->p == '\r' && s->p + 1 < s->end && s->p[1] == '\n')
        s->p++;
    if (s->p < s->end)
        s->p++;
    s->line++;
}

/* At a backslash that ends its line? */
static int at_continuation(const struct scan *s)
{
    return *s->p == '\\' && s->p + 1 < s->end && is_newline(s->p[1]);
}

/* The next token of the line; 0 at its end. */
static int next_token(struct scan *s, struct token *t)
{
    while (s->p < s->end) {
        if (at_continuation(s)) {
            s->p++;
            take_newline(s);
        } else if (is_space(*s->p)) {
            s->p++;
        } else {
            break;
        }
    }
    if (s->p < s->end && *s->p == '#')
        while (s->p < s->end && !is_newline(*s->p))
            s->p++;
    t->p = s->p;
    while (s->p < s->end && !is_newline(*s->p) && !is_space(*s->p) && !at_continuation(s))
        s->p++;
    t->n = (size_t)(s->p - t->p);
    return t->n > 0;
}

static int token_is(const struct token *t, const char *word)
{
    return t->n == strlen(word) && memcmp(t->p, word, t->n) == 0;
}

/* A token as text for a message. */
static const char *shown(const struct token *t)
{
    static char text[40];
    (void)snprintf(text, sizeof text, "%.*s", t->n < 32 ? (int)t->n : 32, t->p);
    return text;
}

static int take_number(struct scan *s, const struct token *t, double *out)
{
    char *end;
    *out = strtod(t->p, &end); /* stops at the file's last '\0' at the latest */
    if (end != t->p + t->n || memchr(t->p, 'x', t->n) != NULL || memchr(t->p, 'X', t->n) != NULL)
        return sim_refuse(s->file, s->line, "'%s' is not a number", shown(t));
    if (!isfinite(*out))
        return sim_refuse(s->file, s->line,
                          "'%s' is not a finite number; export the model again without it",
                          shown(t));
    return SIM_OK;
}

/* The line's numbers: the first eight into v, their count into *n. */
static int take_numbers(struct scan *s, const char *what, int at_least, double v[8], int *n)
{
    struct token t;
    const unsigned long line = s->line;
    for (*n = 0; next_token(s, &t); (*n)++) {
        double x;
        const int status = take_number(s, &t, &x);
        if (status != SIM_OK)
            return status;
        if (*n < 8)
            v[*n] = x;
    }
    if (*n < at_least)
        return sim_refuse(s->file, line, "%s with %d of its %d numbers; the file may be cut off",
                          what, *n, at_least);
    return SIM_OK;
}

static int take_point(struct scan *s)
{
    double v[8];
    int n;
    const int status = take_numbers(s, "a vertex", 3, v, &n);
    if (status != SIM_OK)
        return status;
    struct sim_obj *obj = s->obj;
    if (obj->n_points == s->point_room) {
        s->point_room = 2 * s->point_room + 1024;
        obj->point = sim_grow(obj->point, s->point_room, sizeof *obj->point);
        s->rgb = sim_grow(s->rgb, s->point_room, sizeof *s->rgb);
    }
    if (obj->n_points >= SIM_NONE - 1)
        return sim_refuse(s->file, s->line, "more than 2^32 - 2 vertices; split the model");
    for (int k = 0; k < 3; k++)
        s->rgb[obj->n_points][k] = n >= 6 ? (float)fmin(fmax(v[3 + k], 0.0), 1.0) : -1.0f;
    s->colored |= n >= 6;
    memcpy(obj->point[obj->n_points++], v, sizeof *obj->point);
    return SIM_OK;
}

static int take_normal(struct scan *s)
{
    double v[8];
    int n;
    const int status = take_numbers(s, "a normal", 3, v, &n);
    if (status == SIM_OK) {
        s->n_normals++;
        emit(&s->vertices, "vn %.9g %.9g %.9g\n", v[0], v[1], v[2]);
    }
    return status;
}

/* Texture coordinates are not handed to assimp: these are the ones that count. */
static int take_texture(struct scan *s)
{
    struct sim_obj *obj = s->obj;
    double v[8] = { 0.0, 0.0 }; /* v may be left out */
    int n;
    const int status = take_numbers(s, "a texture coordinate", 1, v, &n);
    if (obj->n_uvs == s->uv_room) {
        s->uv_room = 2 * s->uv_room + 1024;
        obj->uv = sim_grow(obj->uv, s->uv_room, sizeof *obj->uv);
    }
    memcpy(obj->uv[obj->n_uvs++], v, sizeof *obj->uv);
    return status;
}

/* One index of a corner at *p: to 0 .. (not yet checked at the upper end), SIM_NONE where it is
 * left out. */
static int take_index(struct scan *s, const struct token *t, const char **p, const char *what,
                      size_t so_far, uint32_t *out)
{
    const char *end = t->p + t->n;
    *out = SIM_NONE;
    if (*p == end || **p == '/')
        return SIM_OK;
    char *stop;
    const long long i = strtoll(*p, &stop, 10);
    if (stop == *p || stop > end || (stop != end && *stop != '/'))
        return sim_refuse(s->file, s->line, "'%s' is not a corner of a face", shown(t));
    *p = stop;
    if (i == 0)
        return sim_refuse(s->file, s->line, "%s index 0; indices count from 1, or back from -1",
                          what);
    if ((i < 0 && (unsigned long long)-(i + 1) >= so_far) || i >= (long long)SIM_NONE)
        return sim_refuse(s->file, s->line, "%s index %lld is out of range: there are %zu so far",
                          what, i, so_far);
    *out = (uint32_t)(i < 0 ? (long long)so_far + i : i - 1);
    return SIM_OK;
}

static void add_corner(struct scan *s, uint32_t point, uint32_t texture, uint32_t normal)
{
    struct sim_obj *obj = s->obj;
    if (obj->n_corners == s->corner_room) {
        s->corner_room = 2 * s->corner_room + 1024;
        obj->corner = sim_grow(obj->corner, s->corner_room, sizeof *obj->corner);
        obj->corner_uv = sim_grow(obj->corner_uv, s->corner_room, sizeof *obj->corner_uv);
        s->corner_normal = sim_grow(s->corner_normal, s->corner_room, sizeof *s->corner_normal);
    }
    obj->corner[obj->n_corners] = point;
    obj->corner_uv[obj->n_corners] = texture;
    s->corner_normal[obj->n_corners++] = normal;
}

static int take_corner(struct scan *s, const struct token *t)
{
    const char *p = t->p;
    const char *end = t->p + t->n;
    uint32_t point, texture = SIM_NONE, normal = SIM_NONE;
    int status = take_index(s, t, &p, "vertex", s->obj->n_points, &point);
    if (status == SIM_OK && point == SIM_NONE)
        status = sim_refuse(s->file, s->line, "'%s' is not a corner of a face", shown(t));
    if (status == SIM_OK && p < end) {
        p++;
        status = take_index(s, t, &p, "texture", s->obj->n_uvs, &texture);
    }
    if (status == SIM_OK && p < end) {
        p++;
        status = take_index(s, t, &p, "normal", s->n_normals, &normal);
    }
    if (status == SIM_OK && p < end)
        status = sim_refuse(s->file, s->line, "'%s' is not a corner of a face", shown(t));
    if (status != SIM_OK)
        return status;
    if (texture != SIM_NONE && texture >= s->texture_max) {
        s->texture_max = (size_t)texture + 1;
        s->texture_line = s->line;
    }
    add_corner(s, point, texture, normal);
    return SIM_OK;
}

static int take_face(struct scan *s)
{
    struct sim_obj *obj = s->obj;
    const size_t first = obj->n_corners;
    const unsigned long line = s->line;
    struct token t;
    while (next_token(s, &t)) {
        const int status = take_corner(s, &t);
        if (status != SIM_OK)
            return status;
    }
    const size_t n = obj->n_corners - first;
    if (n < 3)
        return sim_refuse(s->file, line, "a face of %zu vertices; it needs at least 3", n);
    if (obj->n_faces == s->face_room) {
        s->face_room = 2 * s->face_room + 1024;
        obj->count = sim_grow(obj->count, s->face_room, sizeof *obj->count);
        s->face_line = sim_grow(s->face_line, s->face_room, sizeof *s->face_line);
    }
    obj->count[obj->n_faces] = (uint32_t)n;
    s->face_line[obj->n_faces++] = line;
    s->bare |= !s->used;
    emit(&s->body, "f");
    for (size_t i = first; i < obj->n_corners; i++) {
        if (s->corner_normal[i] == SIM_NONE)
            emit(&s->body, " %lu", (unsigned long)obj->corner[i] + 1);
        else
            emit(&s->body, " %lu//%lu", (unsigned long)obj->corner[i] + 1,
                 (unsigned long)s->corner_normal[i] + 1);
    }
    emit(&s->body, "\n");
    return SIM_OK;
}

/* A name may hold spaces: it goes to the end of the line, which a backslash does not move. 0: there is none. */
static int take_name(struct scan *s, const char *keyword, struct buffer *out)
{
    while (s->p < s->end && is_space(*s->p))
        s->p++;
    const char *from = s->p;
    while (s->p < s->end && !is_newline(*s->p))
        s->p++;
    const char *to = s->p;
    while (to > from && is_space(to[-1]))
        to--;
    if (to == from || to - from >= 4096 || memchr(from, '\0', (size_t)(to - from)) != NULL)
        return 0;
    emit(out, "%s %.*s%s\n", keyword, (int)(to - from), from, to[-1] == '\\' ? " " : ""); /* else the line goes on */
    return 1;
}

static int take_line(struct scan *s)
{
    struct token t;
    int status = SIM_OK;
    if (next_token(s, &t)) {
        if (token_is(&t, "v"))
            status = take_point(s);
        else if (token_is(&t, "vn"))
            status = take_normal(s);
        else if (token_is(&t, "vt"))
            status = take_texture(s);
        else if (token_is(&t, "f"))
            status = take_face(s);
        else if (token_is(&t, "l") || token_is(&t, "p"))
            s->obj->n_lines++;
        else if (token_is(&t, "curv") || token_is(&t, "surf"))
            s->obj->n_curves++;
        else if (token_is(&t, "mtllib"))
            (void)take_name(s, "mtllib", &s->vertices);
        else if (token_is(&t, "usemtl"))
            s->used |= take_name(s, "usemtl", &s->body);
    }
    while (status == SIM_OK && next_token(s, &t)) {
    }
    take_newline(s);
    return status;
}

/* What could only be known at the end. */
static int check_faces(const struct scan *s)
{
    const struct sim_obj *obj = s->obj;
    size_t i = 0;
    for (size_t f = 0; f < obj->n_faces; f++) {
        for (uint32_t k = 0; k < obj->count[f]; k++, i++) {
            if (obj->corner[i] >= obj->n_points)
                return sim_refuse(s->file, s->face_line[f],
                                  "vertex index %lu is out of range: the file has %zu",
                                  (unsigned long)obj->corner[i] + 1, obj->n_points);
            if (s->corner_normal[i] != SIM_NONE && s->corner_normal[i] >= s->n_normals)
                return sim_refuse(s->file, s->face_line[f],
                                  "normal index %lu is out of range: the file has %zu",
                                  (unsigned long)s->corner_normal[i] + 1, s->n_normals);
        }
    }
    if (s->texture_max > obj->n_uvs)
        return sim_refuse(s->file, s->texture_line,
                          "texture index %zu is out of range: the file has %zu", s->texture_max,
                          obj->n_uvs);
    if (obj->n_faces == 0)
        return sim_refuse(s->file, 0, "no faces in it; zsim draws `f` elements of OBJ text");
    return SIM_OK;
}

/* Colours of no vertex or of all: assimp counts only vertices that have one, so it gives others' to them. */
static void emit_points(struct scan *s)
{
    for (size_t i = 0; i < s->obj->n_points; i++) {
        const double *p = s->obj->point[i];
        const float *c = s->rgb[i];
        if (s->colored)
            emit(&s->vertices, "v %.9g %.9g %.9g %.9g %.9g %.9g\n", p[0], p[1], p[2], (double)c[0], (double)c[1],
                 (double)c[2]);
        else
            emit(&s->vertices, "v %.9g %.9g %.9g\n", p[0], p[1], p[2]);
    }
}

int sim_obj_scan(struct sim_obj *obj, const char *file, const char *text, size_t bytes)
{
    memset(obj, 0, sizeof *obj);
    struct scan s = { .obj = obj, .file = file, .p = text, .end = text + bytes, .line = 1 };
    if (bytes >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        s.p += 3; /* byte order mark */
    emit(&s.vertices, "# cleaned by zsim\n"); /* assimp refuses files of less than 16 bytes */
    int status = SIM_OK;
    while (status == SIM_OK && s.p < s.end) {
        status = take_line(&s);
        if (s.line % 4096 == 0)
            sim_progress("reading", (size_t)(s.p - text), bytes);
    }
    if (status == SIM_OK)
        status = check_faces(&s);
    if (status == SIM_OK) {
        emit_points(&s);
        if (s.used && s.bare) /* else assimp gives the first faces the next material */
            emit(&s.vertices, "usemtl " AI_DEFAULT_MATERIAL_NAME "\n");
        obj->text_bytes = s.vertices.n + s.body.n;
        obj->text = sim_grow(s.vertices.text, obj->text_bytes, 1);
        memcpy(obj->text + s.vertices.n, s.body.text, s.body.n);
        s.vertices.text = NULL;
    } else {
        sim_obj_free(obj);
    }
    SIM_FREE(s.vertices.text, s.body.text, s.rgb, s.corner_normal, s.face_line);
    return status;
}

void sim_obj_free(struct sim_obj *obj)
{
    SIM_FREE(obj->point, obj->corner, obj->corner_uv, obj->uv, obj->count, obj->text);
    memset(obj, 0, sizeof *obj);
}
