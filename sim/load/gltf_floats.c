/* glTF: integer positions, normals and texture coordinates become floats, in a buffer that is added to the file's
 * text: assimp 5.2.5 takes their bytes for those of floats. So do numbers of which some are replaced (sparse), where
 * others stand between them. Texture coordinates that an extension names are named by the texture. What else is wrong
 * with a file is left to assimp to say.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gltf_floats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base64.h"
#include "json_text.h"
#include "material.h"
#include "scan.h"
#include "sim.h"

struct list {
    struct sim_text all, *item;
    size_t n;
};

static struct list list_of(struct sim_text of, const char *name)
{
    struct list list = { .all = sim_text_member(of, name) };
    struct sim_text left = sim_text_inside(list.all), value;
    while (list.all.p != NULL && *list.all.p == '[' && sim_text_next(&left, NULL, &value)) {
        if ((list.n & (list.n - 1)) == 0)
            list.item = sim_grow(list.item, 2 * list.n + 1, sizeof *list.item);
        list.item[list.n++] = value;
    }
    return list;
}

/* ---- Buffers --------------------------------------------------------------------------------- */

/* A buffer's bytes; data NULL: they are not there. own: malloc'ed, else NULL. */
struct bytes {
    const uint8_t *data;
    uint8_t *own;
    size_t n;
};

struct gltf {
    const char *file;
    sim_gltf_read *read;
    struct sim_text json, root; /* all of it, and the object */
    struct sim_text binary;     /* of a .glb what its second chunk holds */
    const char *rest;           /* behind the JSON's chunk */
    struct list accessors, views, buffers, materials;
    struct bytes *buffer; /* [buffers.n], those that were needed so far */
    float *out;
    size_t n, room;
};

static struct bytes load_buffer(const struct gltf *g, size_t i)
{
    struct bytes b = { 0 };
    const struct sim_text uri = sim_text_member(g->buffers.item[i], "uri");
    if (uri.p == NULL || uri.end - uri.p < 2) {
        b.data = i == 0 ? (const uint8_t *)g->binary.p : NULL;
        b.n = b.data != NULL ? (size_t)(g->binary.end - g->binary.p) : 0;
        return b;
    }
    const char *comma = memchr(uri.p, ',', (size_t)(uri.end - uri.p));
    if (sim_text_begins(uri, "data:")) {
        b.own = comma != NULL ? sim_base64_decode(comma + 1, uri.end - 1, &b.n) : NULL;
    } else {
        const char *slash = strrchr(g->file, '/');
        const int folder = slash != NULL ? (int)(slash - g->file) + 1 : 0, length = (int)(uri.end - uri.p) - 2;
        char *path = sim_alloc((size_t)(folder + length) + 1, 1);
        (void)snprintf(path, (size_t)(folder + length) + 1, "%.*s%.*s", folder, g->file, length, uri.p + 1);
        b.own = (uint8_t *)g->read(path, &b.n);
        if (b.own == NULL) {
            sim_decode_percents(path);
            b.own = (uint8_t *)g->read(path, &b.n);
        }
        free(path);
    }
    b.data = b.own;
    return b;
}

/* What stands in place of a part of the JSON. */
struct edit {
    const char *from, *to;
    char *text; /* malloc'ed */
};
#define SPARSE_MAX 100000000u /* rows that nothing says but their count */
#define EDIT_ROOM 160 /* of its text, but for a buffer's data */

/* ---- Accessors ------------------------------------------------------------------------------- */

static uint64_t size_of(uint64_t type) /* bytes; 0: there is no such type */
{
    return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : type == 5125 || type == 5126 ? 4 : 0;
}

static double value_of(const uint8_t *p, uint64_t type, int normalized)
{
    static const double largest[4] = { 127.0, 255.0, 32767.0, 65535.0 };
    uint32_t raw = 0;
    float f;
    for (uint64_t k = 0; k < size_of(type); k++)
        raw |= (uint32_t)p[k] << (8 * k);
    memcpy(&f, &raw, sizeof f);
    if (type > 5123)
        return type == 5126 ? (double)f : (double)raw;
    const double v = type == 5120 ? (double)(int8_t)raw : type == 5122 ? (double)(int16_t)raw : (double)raw;
    return normalized ? fmax(v / largest[type - 5120], -1.0) : v;
}

static uint64_t number(struct sim_text of, const char *name, uint64_t usual)
{
    return sim_text_number(sim_text_member(of, name), usual);
}

/* Where numbers are: rows of so many bytes, from one to the next. */
struct rows {
    const uint8_t *p; /* NULL: they are not there */
    uint64_t stride;
};

/* Those that `place` says by its view and offset. */
static int find_rows(struct rows *out, struct gltf *g, struct sim_text place, uint64_t count, uint64_t row)
{
    const uint64_t view = number(place, "bufferView", UINT64_MAX);
    *out = (struct rows){ NULL, 0 };
    if (view >= g->views.n)
        return SIM_OK;
    const struct sim_text v = g->views.item[view];
    const uint64_t b = number(v, "buffer", UINT64_MAX), stride = number(v, "byteStride", 0);
    const uint64_t start = number(v, "byteOffset", 0) + number(place, "byteOffset", 0);
    if (b >= g->buffers.n)
        return SIM_OK;
    if (g->buffer[b].data == NULL)
        g->buffer[b] = load_buffer(g, (size_t)b);
    if (g->buffer[b].data == NULL)
        return SIM_OK;
    out->stride = stride > 0 ? stride : row;
    if (count == 0 || start + (count - 1) * out->stride + row > g->buffer[b].n)
        return sim_refuse(g->file, 0, "an accessor goes beyond its buffer; get the whole file");
    out->p = g->buffer[b].data + start;
    return SIM_OK;
}

/* What an accessor of integers or floats says of its numbers: count rows of n. */
struct shape {
    uint64_t type, count, n;
    int normalized;
};

/* A row from p to element i of those that begin at `first`. */
static void put_row(struct gltf *g, size_t first, uint64_t i, const uint8_t *p, const struct shape *s)
{
    for (uint64_t k = 0; k < s->n; k++)
        g->out[first + i * s->n + k] = (float)value_of(p + k * size_of(s->type), s->type, s->normalized);
}

/* Rows that take the place of some. number: the accessor's. */
static int put_sparse(struct gltf *g, struct sim_text sparse, size_t first, const struct shape *s, size_t accessor)
{
    const struct sim_text indices = sim_text_member(sparse, "indices");
    const uint64_t type = number(indices, "componentType", 0), count = number(sparse, "count", 0);
    const uint64_t row = s->n * size_of(s->type);
    struct rows at, values;
    if (type != 5121 && type != 5123 && type != 5125)
        return sim_refuse(g->file, 0, "an accessor makes no sense; export the model again");
    int status = find_rows(&at, g, indices, count, size_of(type));
    if (status == SIM_OK)
        status = find_rows(&values, g, sim_text_member(sparse, "values"), count, row);
    if (status == SIM_OK && (at.p == NULL || values.p == NULL))
        status = sim_refuse(g->file, 0, "an accessor makes no sense; export the model again");
    for (uint64_t k = 0; status == SIM_OK && k < count; k++) {
        const uint64_t i = (uint64_t)value_of(at.p + k * at.stride, type, 0);
        if (i >= s->count)
            status = sim_refuse(g->file, 0, "accessor %zu replaces element %llu of %llu", accessor,
                                (unsigned long long)i, (unsigned long long)s->count);
        else
            put_row(g, first, i, values.p + k * values.stride, s);
    }
    return status;
}

/* Does assimp read its numbers as they are? It takes integers for floats, and where some are replaced (sparse), it
 * takes the others as if there were nothing between them. */
static int is_read(const struct gltf *g, struct sim_text a, struct sim_text attribute, const struct shape *s)
{
    const uint64_t view = number(a, "bufferView", UINT64_MAX);
    const uint64_t stride = view < g->views.n ? number(g->views.item[view], "byteStride", 0) : 0;
    const int strided = stride > 0 && stride != s->n * size_of(s->type);
    return !(sim_text_member(a, "sparse").p != NULL && strided) &&
           (s->type == 5126 || sim_text_begins(attribute, "COLOR_"));
}

/* Its numbers go behind those in g->out, where assimp would take others, and into edit what then stands for it.
 * attribute: what it is in a mesh. */
static int take_accessor(struct gltf *g, size_t number_of, struct sim_text attribute, struct edit *edit, size_t *edits)
{
    const struct sim_text a = g->accessors.item[number_of], sparse = sim_text_member(a, "sparse");
    const struct sim_text kind = sim_text_member(a, "type"), flag = sim_text_member(a, "normalized");
    const struct shape s = { number(a, "componentType", 0), number(a, "count", 0),
                             sim_text_is(kind, "VEC2")   ? 2
                             : sim_text_is(kind, "VEC3") ? 3
                             : sim_text_is(kind, "VEC4") ? 4
                                                         : 0,
                             flag.p != NULL && *flag.p == 't' };
    const uint64_t row = s.n * size_of(s.type);
    const size_t first = g->n;
    struct rows base;
    if (row == 0 || s.type == 5125 || is_read(g, a, attribute, &s))
        return SIM_OK;
    int status = find_rows(&base, g, a, s.count, row);
    if (status != SIM_OK || (base.p == NULL && sparse.p == NULL))
        return status;
    if (base.p == NULL && sim_text_member(a, "bufferView").p != NULL)
        return SIM_OK;
    if (s.count > SPARSE_MAX && base.p == NULL)
        return sim_refuse(g->file, 0, "an accessor makes no sense; export the model again");
    edit[*edits] = (struct edit){ a.p, a.end, sim_alloc(EDIT_ROOM, 1) };
    (void)snprintf(edit[(*edits)++].text, EDIT_ROOM,
                   "{\"bufferView\":%zu,\"byteOffset\":%zu,\"componentType\":5126,\"count\":%llu,\"type\":\"VEC%d\"}",
                   g->views.n, first * sizeof *g->out, (unsigned long long)s.count, (int)s.n);
    g->n += s.n * s.count;
    if (g->n > g->room) {
        g->room = 2 * g->room + s.n * s.count;
        g->out = sim_grow(g->out, g->room, sizeof *g->out);
    }
    memset(g->out + first, 0, s.n * s.count * sizeof *g->out);
    for (uint64_t i = 0; base.p != NULL && i < s.count; i++)
        put_row(g, first, i, base.p + i * base.stride, &s);
    return sparse.p != NULL ? put_sparse(g, sparse, first, &s, number_of) : SIM_OK;
}

/* Does one of a list name what is not there yet, and would be once a view and a buffer are added? */
static int names_missing(const struct list *list, const char *what, size_t n)
{
    for (size_t i = 0; i < list->n; i++)
        if (number(list->item[i], what, 0) >= n)
            return 1;
    return 0;
}

/* What meshes use each accessor for: a string, or none. */
static struct sim_text *find_uses(const struct gltf *g)
{
    struct sim_text *use = sim_alloc(g->accessors.n + 1, sizeof *use);
    struct sim_text meshes = sim_text_inside(sim_text_member(g->root, "meshes")), mesh, primitive, key, value;
    while (sim_text_next(&meshes, NULL, &mesh)) {
        struct sim_text primitives = sim_text_inside(sim_text_member(mesh, "primitives"));
        while (sim_text_next(&primitives, NULL, &primitive)) {
            struct sim_text attributes = sim_text_inside(sim_text_member(primitive, "attributes"));
            while (sim_text_next(&attributes, &key, &value)) {
                const uint64_t i = sim_text_number(value, UINT64_MAX);
                if (i < g->accessors.n && (sim_text_is(key, "POSITION") || sim_text_is(key, "NORMAL") ||
                                           sim_text_begins(key, "TEXCOORD_") ||
                                           (sim_text_begins(key, "COLOR_") && use[i].p == NULL)))
                    use[i] = key;
            }
        }
    }
    return use;
}

/* ---- Texture coordinates --------------------------------------------------------------------- */

/* assimp does not read which ones KHR_texture_transform names: it gets them as those of the texture itself, where the
 * first of two members of a name counts. */
static void take_texture(struct sim_text texture, struct edit *edit, size_t *edits)
{
    const struct sim_text extensions = sim_text_member(texture, "extensions");
    const uint64_t of = number(sim_text_member(extensions, "KHR_texture_transform"), "texCoord", UINT64_MAX);
    if (texture.p == NULL || *texture.p != '{' || of == UINT64_MAX || of == number(texture, "texCoord", 0))
        return;
    edit[*edits] = (struct edit){ texture.p + 1, texture.p + 1, sim_alloc(EDIT_ROOM, 1) };
    (void)snprintf(edit[(*edits)++].text, EDIT_ROOM, "\"texCoord\":%llu,", (unsigned long long)of);
}

/* Of a material: its base colour's, and that of KHR_materials_pbrSpecularGlossiness. */
static void take_textures(struct sim_text material, struct edit *edit, size_t *edits)
{
    const struct sim_text glossy = sim_text_member(sim_text_member(material, "extensions"),
                                                   "KHR_materials_pbrSpecularGlossiness");
    take_texture(sim_text_member(sim_text_member(material, "pbrMetallicRoughness"), "baseColorTexture"), edit, edits);
    take_texture(sim_text_member(glossy, "diffuseTexture"), edit, edits);
}

static int uses_transform(struct sim_text root)
{
    struct sim_text names = sim_text_inside(sim_text_member(root, "extensionsUsed")), name;
    while (sim_text_next(&names, NULL, &name))
        if (sim_text_is(name, "KHR_texture_transform"))
            return 1;
    return 0;
}

/* ---- The new text ---------------------------------------------------------------------------- */

static int by_place(const void *a, const void *b)
{
    const struct edit *x = a, *y = b;
    return (x->from > y->from) - (x->from < y->from);
}

static size_t apply(char *out, struct sim_text all, struct edit *edit, size_t n)
{
    char *to = out;
    qsort(edit, n, sizeof *edit, by_place);
    for (size_t i = 0; i <= n; i++) {
        const char *stop = i < n ? edit[i].from : all.end;
        memcpy(to, all.p, (size_t)(stop - all.p));
        to += stop - all.p;
        if (i < n) {
            to = stpcpy(to, edit[i].text);
            all.p = edit[i].to;
        }
    }
    return (size_t)(to - out);
}

static void put_u32(char *p, size_t v)
{
    for (int k = 0; k < 4; k++)
        p[k] = (char)(v >> (8 * k) & 255);
}

/* A view and a buffer of what is in g->out. */
static void add_buffer(struct gltf *g, struct edit *edit, size_t *n)
{
    const size_t raw = g->n * sizeof *g->out, code = SIM_BASE64_CHARS(raw) - 1;
    const char *const views = g->views.all.end - 1, *const buffers = g->buffers.all.end - 1;
    struct edit *const view = &edit[(*n)++], *const buffer = &edit[(*n)++];
    *view = (struct edit){ views, views, sim_alloc(EDIT_ROOM, 1) };
    (void)snprintf(view->text, EDIT_ROOM, ",{\"buffer\":%zu,\"byteLength\":%zu}", g->buffers.n, raw);
    *buffer = (struct edit){ buffers, buffers, sim_alloc(EDIT_ROOM + code, 1) };
    const int at = snprintf(buffer->text, EDIT_ROOM,
                            ",{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,", raw);
    sim_base64_encode(buffer->text + at, g->out, raw);
    (void)strcat(buffer->text + at + code, "\"}");
}

/* n: of edits. */
static void rewrite(struct gltf *g, struct edit *edit, size_t n, char **text, size_t *bytes)
{
    const size_t head = (size_t)(g->json.p - *text), rest = (size_t)(*text + *bytes - g->rest);
    size_t room = *bytes + 5;
    for (size_t i = 0; i < n; i++)
        room += strlen(edit[i].text);
    char *out = sim_alloc(room, 1);
    memcpy(out, *text, head);
    size_t length = apply(out + head, g->json, edit, n);
    while (head > 0 && length % 4 != 0)
        out[head + length++] = ' ';
    memcpy(out + head + length, g->rest, rest);
    *bytes = head + length + rest;
    if (head > 0) {
        put_u32(out + 8, *bytes);
        put_u32(out + 12, length);
    }
    free(*text);
    *text = out;
}

int sim_gltf_floats(const char *file, char **text, size_t *bytes, sim_gltf_read *read)
{
    struct gltf g = { .file = file, .read = read, .json = sim_gltf_json(file, *text, *bytes) };
    const char *end = *text + *bytes;
    struct sim_text left = g.json;
    if (g.json.p == NULL || !sim_text_next(&left, NULL, &g.root))
        return SIM_OK;
    g.rest = g.json.end;
    while (g.json.p > *text && g.rest < end && (g.rest - g.json.p) % 4 != 0) /* chunks of a .glb are whole words */
        g.rest++;
    if (g.json.p > *text && end - g.rest >= 8)
        g.binary = (struct sim_text){ g.rest + 8, end };
    g.accessors = list_of(g.root, "accessors");
    g.views = list_of(g.root, "bufferViews");
    g.buffers = list_of(g.root, "buffers");
    g.buffer = sim_alloc(g.buffers.n + 1, sizeof *g.buffer);
    g.materials = list_of(g.root, "materials");
    struct sim_text *use = find_uses(&g);
    struct edit *edit = sim_alloc(g.accessors.n + 2 * g.materials.n + 2, sizeof *edit);
    size_t n = 0;
    int status = SIM_OK;
    for (size_t i = 0; status == SIM_OK && i < g.accessors.n; i++)
        if (use[i].p != NULL)
            status = take_accessor(&g, i, use[i], edit, &n);
    if (status == SIM_OK && g.n > 0 &&
        (names_missing(&g.accessors, "bufferView", g.views.n) || names_missing(&g.views, "buffer", g.buffers.n)))
        status = sim_refuse(file, 0, "it names parts that are not there; export the model again");
    if (status == SIM_OK && g.n > 0)
        add_buffer(&g, edit, &n);
    for (size_t i = 0; status == SIM_OK && i < g.materials.n && uses_transform(g.root); i++)
        take_textures(g.materials.item[i], edit, &n);
    if (status == SIM_OK && n > 0)
        rewrite(&g, edit, n, text, bytes);
    for (size_t i = 0; i < n; i++)
        free(edit[i].text);
    for (size_t i = 0; i < g.buffers.n; i++)
        free(g.buffer[i].own);
    SIM_FREE(g.materials.item, g.accessors.item, g.views.item, g.buffers.item, g.buffer, g.out, use, edit);
    return status;
}
