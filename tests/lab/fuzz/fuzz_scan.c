/* A libFuzzer target: the readers that look model files through before assimp does. The first byte chooses: o OBJ, m
 * MTL, p PLY, s STL, f OFF, g glTF, b a .glb; the rest is the file.
 *
 *   what is refused is refused with one line that names the file, and nothing is kept
 *   an OBJ file that passes names only points and texture coordinates that there are, and its cleaned text passes again
 *   with the same faces
 *   a glTF file whose integers became floats has none that would
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "gltf_floats.h"
#include "scan.h"
#include "sim.h"
#include "target.h"

const char target_name[] = "fuzz_scan";
const char *const target_words[] = {
    "\nv ", "\nvt ", "\nvn ", "\nf ", "\nusemtl ", "\nmtllib ", "\no ", "\ng ", "\np ", "\nl ", "1/2/3", "-1//-1",
    "1/1", "\\\n", "1e400", "nan", "inf", "-0", "1e-320", "4294967296", "99999999999999999999", "#", "\r\n",
    "newmtl ", "map_Kd ", "Kd ", "-s 1 1 1", "-o ", "-clamp on", "-mm 0 1", "-bm ", "-imfchan r", "ply\n",
    "format ascii 1.0\n", "format binary_little_endian 1.0\n", "format binary_big_endian 1.0\n", "element vertex ",
    "element face ", "property list uchar int vertex_indices\n", "property float x\n", "property double y\n",
    "property list uint8 uint32 vertex_index\n", "property list double char c\n", "end_header\n", "comment ",
    "solid ", "facet normal 0 0 1", "outer loop", "vertex ", "endloop", "endfacet", "endsolid", "{}", "[]",
    "\"meshes\":[", "\"primitives\":[", "\"attributes\":{", "\"POSITION\":0", "\"TEXCOORD_0\":1", "\"accessors\":[",
    "\"bufferViews\":[", "\"buffers\":[", "\"bufferView\":0", "\"buffer\":0", "\"componentType\":5122",
    "\"count\":1", "\"type\":\"VEC2\"", "\"byteOffset\":", "\"byteStride\":", "\"sparse\":",
    "\"normalized\":true", "\"uri\":\"data:,", NULL
};

size_t target_seed(uint32_t k, uint8_t *to, size_t room)
{
    (void)k, (void)to, (void)room; /* all in the corpus's text */
    return 0;
}

static char *ended(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (!text)
        abort();
    if (size)
        memcpy(text, data, size);
    text[size] = 0;
    return text;
}

static int finite_number(double v)
{
    return v - v == 0;
}

static void obj_right(const struct sim_obj *o)
{
    size_t corners = 0;
    for (size_t f = 0; f < o->n_faces; f++) {
        EXPECT(o->count[f] >= 3);
        corners += o->count[f];
    }
    EXPECT(corners == o->n_corners);
    for (size_t c = 0; c < o->n_corners; c++)
        EXPECT(o->corner[c] < o->n_points && (o->corner_uv[c] == SIM_NONE || o->corner_uv[c] < o->n_uvs));
    for (size_t v = 0; v < o->n_points; v++)
        EXPECT(finite_number(o->point[v][0]) && finite_number(o->point[v][1]) && finite_number(o->point[v][2]));
    for (size_t v = 0; v < o->n_uvs; v++)
        EXPECT(finite_number(o->uv[v][0]) && finite_number(o->uv[v][1]));
    EXPECT(!memchr(o->text, 0, o->text_bytes));
}

static void obj(const char *text, size_t bytes)
{
    static struct said said;
    struct sim_obj o, again;
    said_begin(&said);
    const int status = sim_obj_scan(&o, "x.obj", text, bytes);
    said_end(&said);
    EXPECT(status == SIM_OK || status == SIM_REFUSED);
    EXPECT(said.lines == (status != SIM_OK));
    if (status != SIM_OK) {
        EXPECT(strstr(said.text, "x.obj") && o.n_points == 0 && o.n_faces == 0 && !o.point && !o.corner && !o.text);
        sim_obj_free(&o);
        return;
    }
    obj_right(&o);
    char *cleaned = ended((const uint8_t *)o.text, o.text_bytes);
    said_begin(&said);
    const int twice = sim_obj_scan(&again, "again.obj", cleaned, o.text_bytes);
    said_end(&said);
    EXPECT(twice == SIM_OK && again.n_faces == o.n_faces && again.n_points == o.n_points);
    EXPECT(again.n_corners == o.n_corners &&
           (!o.n_corners || memcmp(again.corner, o.corner, o.n_corners * sizeof *o.corner) == 0));
    sim_obj_free(&again);
    sim_obj_free(&o);
    free(cleaned);
}

static void mtl(const char *text, size_t bytes)
{
    struct sim_mtl m = { 0 };
    sim_mtl_scan(&m, text, bytes);
    const size_t n = m.n;
    for (size_t i = 0; i < n; i++) {
        const struct sim_mtl_entry *e = &m.entry[i];
        EXPECT(e->name && sim_mtl_find(&m, e->name) && strcmp(sim_mtl_find(&m, e->name)->name, e->name) == 0);
        for (int k = 0; k < 3; k++)
            EXPECT(finite_number(e->kd[k]));
        for (int k = 0; k < 2; k++)
            EXPECT(finite_number(e->scale[k]) && finite_number(e->shift[k]));
        EXPECT(e->clamp == 0 || e->clamp == 1);
    }
    sim_mtl_scan(&m, text, bytes); /* another library is added */
    EXPECT(m.n == 2 * n);
    sim_mtl_free(&m);
}

static void check(int (*fn)(struct sim_lost *, const char *, const char *, size_t), const char *file, const char *text,
                  size_t bytes)
{
    static struct said said;
    struct sim_lost lost[SIM_LOST_KINDS] = { { 0 } };
    said_begin(&said);
    const int status = fn(lost, file, text, bytes);
    said_end(&said);
    EXPECT(status == SIM_OK || status == SIM_REFUSED);
    EXPECT(said.lines == (status != SIM_OK) && (status == SIM_OK || strstr(said.text, file)));
}

static char *no_file(const char *path, size_t *bytes)
{
    (void)path, (void)bytes;
    return NULL;
}

static int floats(struct sim_lost *lost, const char *file, const char *text, size_t bytes)
{
    size_t n = bytes;
    char *own = ended((const uint8_t *)text, bytes);
    sim_gltf_extensions(lost, file, text, bytes);
    sim_gltf_skins(lost, file, own, bytes);
    EXPECT(strlen(own) == strlen(text));
    const int status = sim_gltf_floats(file, &own, &n, no_file);
    size_t twice = n;
    EXPECT(status == SIM_OK || n == bytes);
    if (status == SIM_OK && n != bytes)
        EXPECT(sim_gltf_floats(file, &own, &twice, no_file) == SIM_OK && twice == n);
    free(own);
    return status;
}

static int ply(struct sim_lost *lost, const char *file, const char *text, size_t bytes)
{
    size_t n = bytes;
    char *own = ended((const uint8_t *)text, bytes);
    struct sim_ply out = { 0 };
    const int status = sim_ply_check(&out, lost, file, own, &n);
    EXPECT(n <= bytes && own[n] == '\0' && (status == SIM_OK || n == bytes));
    EXPECT(out.n_uvs <= out.room && (out.uv != NULL || out.n_uvs == 0));
    sim_ply_free(&out);
    free(own);
    return status;
}

static int stl(struct sim_lost *lost, const char *file, const char *text, size_t bytes)
{
    struct sim_lost again[SIM_LOST_KINDS] = { { 0 } };
    char *own = ended((const uint8_t *)text, bytes);
    const int status = sim_stl_check(lost, file, own, bytes);
    EXPECT(own[bytes] == '\0');
    if (status == SIM_OK)
        EXPECT(sim_stl_check(again, file, own, bytes) == SIM_OK &&
               again[SIM_LOST_CORNERS].n == lost[SIM_LOST_CORNERS].n);
    free(own);
    return status;
}

static int off(struct sim_lost *lost, const char *file, const char *text, size_t bytes)
{
    (void)file;
    sim_off_look(lost, text, bytes);
    EXPECT(lost[SIM_LOST_COLORS].n <= 1);
    return SIM_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (!size)
        return 0;
    const size_t bytes = size - 1;
    char *text = ended(data + 1, bytes);
    switch (data[0]) {
    case 'o': obj(text, bytes); break;
    case 'm': mtl(text, bytes); break;
    case 'p': check(ply, "x.ply", text, bytes); break;
    case 's': check(stl, "x.stl", text, bytes); break;
    case 'f': check(off, "x.off", text, bytes); break;
    case 'g': check(floats, "x.gltf", text, bytes); break;
    case 'b': check(floats, "x.glb", text, bytes); break;
    default: break;
    }
    free(text);
    return 0;
}
