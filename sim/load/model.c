/* Loading. assimp reads the file, out of memory, without post-processing; this file checks what it gives, puts
 * nodes in their places, cuts polygons into triangles (polygon.c) and welds equal positions.
 *
 * OBJ: assimp is handed the text that sim_obj_scan cleaned. Positions and the order of faces are
 * the scan's own (double precision); colours and normals are assimp's, after a check that both
 * agree face by face.
 *
 * SPDX-License-Identifier: MIT
 */
#include "model.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "assimp_library.h"
#include "gltf_floats.h"
#include "material.h"
#include "memory_file.h"
#include "model_shape.h"
#include "outside.h"
#include "polygon.h"
#include "scan.h"
#include "sim.h"
#include "simplify.h"
#include "vec.h"

#define COORD_MAX 1e30  /* products of three lengths fit a double */
#define DEPTH_MAX 256   /* of nodes below nodes */

enum family { FAMILY_OBJ, FAMILY_PLY, FAMILY_STL, FAMILY_OFF, FAMILY_OTHER };

/* One corner of a face, as it will be stored. */
struct corner {
    uint32_t point;
    float normal[3];
    struct zs_rgb rgb;
    double uv[2]; /* v down */
};

/* The face in hand, all [room]. */
struct polygon {
    struct corner *corner;
    double (*point)[3];
    uint32_t (*tri)[3];
    unsigned room;
};

/* The file, and what is known while it is loaded. */
struct load {
    struct sim_model *model;
    const char *file;
    enum family family;
    char *text; /* the whole file, '\0' behind it; of an OBJ only until it is scanned */
    size_t bytes;
    struct sim_obj obj;
    struct sim_ply ply;
    struct sim_mtl mtl;          /* OBJ: its material files */
    struct sim_use *use;         /* [n_materials], how each uses its texture; NULL: not wanted */
    int gltf;                    /* flag: it is one */
    int has_materials;           /* OBJ: a material file was read */
    const struct sim_want *want;
    const struct aiScene *scene;
    int wide_materials;          /* flag: an OBJ's material file has been refused */
    char complaint[200];         /* of assimp's about indices; else empty */
    struct sim_weld weld;
    size_t face, corner;         /* OBJ, PLY with uv of corners: next of the scan */
    struct polygon polygon;
};

/* ---- Reading --------------------------------------------------------------------------------- */

static enum family family_of(const char *file)
{
    static const struct {
        const char *end;
        enum family family;
    } known[] = { { ".obj", FAMILY_OBJ }, { ".ply", FAMILY_PLY }, { ".stl", FAMILY_STL },
                  { ".off", FAMILY_OFF } };
    const size_t n = strlen(file);
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (n >= 4 && strcasecmp(file + n - 4, known[i].end) == 0)
            return known[i].family;
    return FAMILY_OTHER;
}

static int read_file(struct load *l)
{
    struct stat st;
    if (stat(l->file, &st) != 0)
        return sim_refuse(l->file, 0, "cannot be read: %s", strerror(errno));
    if (S_ISDIR(st.st_mode))
        return sim_refuse(l->file, 0, "is a directory; name a model file in it");
    if (!S_ISREG(st.st_mode))
        return sim_refuse(l->file, 0, "is not a regular file; copy the model to one");
    if (st.st_size == 0)
        return sim_refuse(l->file, 0, "is empty; get the model again");
    FILE *f = fopen(l->file, "rb");
    if (f == NULL)
        return sim_refuse(l->file, 0, "cannot be read: %s", strerror(errno));
    l->bytes = (size_t)st.st_size;
    l->text = sim_grow(NULL, l->bytes + 1, 1);
    const size_t got = fread(l->text, 1, l->bytes, f);
    const int bad = ferror(f);
    (void)fclose(f);
    if (bad || got != l->bytes)
        return sim_refuse(l->file, 0, "cannot be read: %s",
                          bad ? strerror(errno) : "it got shorter");
    l->text[got] = '\0';
    return SIM_OK;
}

/* Is text in characters of 16 or 32 bits, each with one byte that is not 0? Then say so. */
static int check_wide(const char *file, const char *text, size_t bytes)
{
    for (size_t unit = 2; unit <= 4; unit += 2) {
        size_t at = unit, most = bytes < 64 ? bytes : 64; /* the first one may be a byte order mark */
        unsigned places = 0;                              /* bits: which byte of a character is not 0 */
        for (; at + unit <= most; at += unit) {
            unsigned filled = 0;
            for (size_t k = 0; k < unit; k++)
                filled |= text[at + k] != 0 ? 1u << k : 0u;
            places |= filled != 0 ? filled : 1u << 8;
        }
        if (at >= 5 * unit && (places == 1u || places == 1u << (unit - 1)))
            return sim_refuse(file, 0, "is UTF-%u text; save it as UTF-8, as by iconv -f UTF-%u -t UTF-8",
                              8 * (unsigned)unit, 8 * (unsigned)unit);
    }
    return SIM_OK;
}

/* ---- Files for assimp: the model as it was checked, of an OBJ the cleaned text, and what it names ----------- */

/* A whole regular file that the model may name, with a '\0' behind it, or NULL. malloc'ed. */
static char *read_text(const char *path, size_t *bytes)
{
    struct stat st;
    FILE *f = sim_outside_allows(path) && stat(path, &st) == 0 && S_ISREG(st.st_mode) ? fopen(path, "rb") : NULL;
    if (f == NULL)
        return NULL;
    char *text = sim_alloc((size_t)st.st_size + 1, 1);
    *bytes = fread(text, 1, (size_t)st.st_size, f);
    (void)fclose(f);
    return text;
}

/* "mtllib a.mtl b.mtl" names two files, where there is none of that whole name: their texts, one after the other.
 * NULL: none is there. `path` becomes the first that is not; "": all are. */
static char *read_several(const struct load *l, char *path, size_t *bytes)
{
    const char *slash = strrchr(l->file, '/');
    const size_t folder = slash != NULL ? (size_t)(slash - l->file) + 1 : 0, n = strlen(path);
    char *name = sim_alloc(n + 1, 1), *all = NULL, *missing = NULL;
    if (folder > n || strncmp(path, l->file, folder) != 0 || strpbrk(path + folder, " \t") == NULL) {
        free(name);
        return NULL;
    }
    *bytes = 0;
    for (const char *at = path + folder; *at != '\0'; at += strspn(at, " \t")) {
        const size_t length = strcspn(at, " \t");
        size_t more;
        (void)snprintf(name, n + 1, "%.*s%.*s", (int)folder, path, (int)length, at);
        char *text = read_text(name, &more);
        if (text == NULL && missing == NULL)
            missing = strcpy(sim_alloc(n + 1, 1), name);
        if (text != NULL) {
            all = sim_grow(all, *bytes + more + 2, 1);
            memcpy(all + *bytes, text, more);
            *bytes += more;
            all[(*bytes)++] = '\n';
            all[*bytes] = '\0';
        }
        free(text);
        at += length;
    }
    if (all != NULL)
        (void)strcpy(path, missing != NULL ? missing : "");
    free(missing);
    free(name);
    return all;
}

/* A material file of an OBJ: for assimp, and for a scan of its own. */
static char *read_materials(struct load *l, const char *name, size_t *bytes)
{
    char *path = strcpy(sim_alloc(strlen(name) + 1, 1), name);
    char *text = read_text(path, bytes);
    for (char *p = path; *p != '\0'; p++)
        if (*p == '\\')
            *p = '/';
    if (text == NULL)
        text = read_text(path, bytes);
    if (text == NULL) {
        text = read_several(l, path, bytes);
        if (text != NULL && path[0] != '\0' && l->model->lost_materials == NULL)
            l->model->lost_materials = strcpy(sim_alloc(strlen(path) + 1, 1), path);
    }
    if (text == NULL && l->model->lost_materials == NULL) {
        l->model->lost_materials = path;
        return NULL;
    }
    if (l->wide_materials || (text != NULL && check_wide(path, text, *bytes) != SIM_OK)) {
        l->wide_materials = 1; /* said once; assimp tries other names */
        free(text);
        text = NULL;
    }
    free(path);
    if (text != NULL) {
        l->has_materials = 1;
        sim_mtl_scan(&l->mtl, text, *bytes);
    }
    return text;
}

static struct aiFile *stream_open(struct aiFileIO *io, const char *name, const char *mode)
{
    struct load *l = (struct load *)io->UserData;
    const int obj = l->family == FAMILY_OBJ;
    if (mode[0] != 'r')
        return NULL;
    if (strcmp(name, l->file) == 0)
        return sim_memory_file(obj ? l->obj.text : l->text, obj ? l->obj.text_bytes : l->bytes, NULL);
    size_t bytes;
    char *own = obj ? read_materials(l, name, &bytes) : read_text(name, &bytes);
    if (own == NULL && !obj && strchr(name, '%') != NULL) { /* glTF names files by URIs */
        char *plain = strcpy(sim_alloc(strlen(name) + 1, 1), name);
        sim_decode_percents(plain);
        own = read_text(plain, &bytes);
        free(plain);
    }
    return own != NULL ? sim_memory_file(own, bytes, own) : NULL;
}

static void stream_close(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    sim_memory_file_close(file);
}

/* ---- Checks ---------------------------------------------------------------------------------- */

/* assimp drops or bends faces whose indices are wrong (glTF, OFF and others) and only logs it. */
static void hear(const char *message, char *user)
{
    static const char *const alarms[] = { "out of range", "out-of-range", "nvalid vertex index",
                                          "nvalid face index", "nvalid triangle index" };
    struct load *l = (struct load *)user;
    const char *text = strstr(message, "T0: ");
    if (l->complaint[0] != '\0' || (strncmp(message, "Warn", 4) && strncmp(message, "Error", 5)))
        return;
    for (size_t i = 0; i < sizeof alarms / sizeof alarms[0]; i++)
        if (strstr(message, alarms[i]) != NULL)
            (void)snprintf(l->complaint, sizeof l->complaint, "%.*s",
                           (int)strcspn(text != NULL ? text + 4 : message, "\n"),
                           text != NULL ? text + 4 : message);
}

static int import(struct load *l)
{
    struct aiFileIO io = { stream_open, stream_close, (aiUserData)l };
    struct aiLogStream log = { hear, (char *)l };
    if (sim_assimp_open(l->file) != SIM_OK)
        return SIM_REFUSED;
    sim_progress("loading", 0, 1);
    if (l->family != FAMILY_OBJ) /* the scan has seen its indices */
        aiAttachLogStream(&log);
    l->scene = aiImportFileEx(l->file, 0, &io);
    if (l->family != FAMILY_OBJ)
        (void)aiDetachLogStream(&log);
    if (sim_outside_check() != SIM_OK || l->wide_materials)
        return SIM_REFUSED;
    if (l->scene == NULL && l->complaint[0] == '\0') {
        const char *why = aiGetErrorString();
        if (why != NULL && strstr(why, "bad_alloc") != NULL && sim_no_memory != NULL)
            return sim_refuse(NULL, 0, "%s", sim_no_memory);
        const char *words = why != NULL ? sim_gltf_words(l->file, why) : NULL;
        if (words != NULL)
            return sim_refuse(l->file, 0, "%s", words);
        if (why != NULL && strstr(why, "No suitable reader") != NULL)
            return sim_refuse(l->file, 0, "is of no format that is known by its name or its bytes; zsim reads OBJ, "
                                          "PLY, STL, glTF and what else assimp reads: export the model as one of "
                                          "these");
        return sim_refuse(l->file, 0, "cannot be loaded: %s; the file may be damaged or cut off",
                          why != NULL && why[0] != '\0' ? why : "unknown format");
    }
    if (l->complaint[0] != '\0' && sim_gltf_words(l->file, l->complaint) != NULL)
        return sim_refuse(l->file, 0, "%s", sim_gltf_words(l->file, l->complaint));
    if (l->complaint[0] != '\0')
        return sim_refuse(l->file, 0, "is not sound: %s; export the model again", l->complaint);
    if (l->scene->mRootNode == NULL || l->scene->mNumMeshes == 0)
        return sim_refuse(l->file, 0, "no faces in it; zsim draws polygons");
    return SIM_OK;
}

/* A mesh's faces: enough corners, indices in range. Points and lines are left out where the format
 * has such elements. */
static int check_mesh(const struct load *l, const struct aiMesh *mesh)
{
    for (unsigned v = 0; v < mesh->mNumVertices; v++) {
        const struct aiVector3D *p = &mesh->mVertices[v];
        if (l->family != FAMILY_OBJ && !(isfinite(p->x) && isfinite(p->y) && isfinite(p->z)))
            return sim_refuse(
                l->file, 0,
                "vertex %u of mesh '%s' has a coordinate that is not finite; export the "
                "model again",
                v + 1, mesh->mName.data);
    }
    for (unsigned f = 0; f < mesh->mNumFaces; f++) {
        const struct aiFace *face = &mesh->mFaces[f];
        if (face->mNumIndices < 3 && l->family != FAMILY_OTHER)
            return sim_refuse(l->file, 0, "face %u has %u vertices; it needs at least 3", f + 1,
                              face->mNumIndices);
        for (unsigned k = 0; k < face->mNumIndices; k++)
            if (face->mIndices[k] >= mesh->mNumVertices)
                return sim_refuse(
                    l->file, 0, "vertex index %u of face %u in mesh '%s' is out of range: %u exist",
                    face->mIndices[k], f + 1, mesh->mName.data, mesh->mNumVertices);
    }
    return SIM_OK;
}

/* ---- Triangles ------------------------------------------------------------------------------- */

/* Called for a mesh in its place. m: to the model's space. */
typedef int (*visit)(struct load *l, const struct aiMesh *mesh, const double m[12]);

static void place(double out[12], const double parent[12], const struct aiMatrix4x4 *t)
{
    const double c[12] = { (double)t->a1, (double)t->a2, (double)t->a3, (double)t->a4,
                           (double)t->b1, (double)t->b2, (double)t->b3, (double)t->b4,
                           (double)t->c1, (double)t->c2, (double)t->c3, (double)t->c4 };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            out[4 * i + j] = parent[4 * i] * c[j] + parent[4 * i + 1] * c[4 + j] +
                             parent[4 * i + 2] * c[8 + j] + (j == 3 ? parent[4 * i + 3] : 0.0);
}

/* All meshes of all nodes, parents first, children in order. The stack stands in for recursion. */
static int walk(struct load *l, visit call)
{
    struct {
        const struct aiNode *node;
        unsigned child;
        double m[12];
    } stack[DEPTH_MAX];
    static const double identity[12] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
    int depth = 0;
    const struct aiNode *node = l->scene->mRootNode;
    const double *parent = identity;
    for (;;) {
        if (depth == DEPTH_MAX)
            return sim_refuse(l->file, 0, "nodes stand more than %d deep; flatten the model",
                              DEPTH_MAX);
        stack[depth].node = node;
        stack[depth].child = 0;
        place(stack[depth].m, parent, &node->mTransformation);
        for (unsigned i = 0; i < node->mNumMeshes; i++) {
            const int status = call(l, l->scene->mMeshes[node->mMeshes[i]], stack[depth].m);
            if (status != SIM_OK)
                return status;
        }
        depth++;
        while (depth > 0 && stack[depth - 1].child == stack[depth - 1].node->mNumChildren)
            depth--;
        if (depth == 0)
            return SIM_OK;
        parent = stack[depth - 1].m;
        node = stack[depth - 1].node->mChildren[stack[depth - 1].child++];
    }
}

static int count_mesh(struct load *l, const struct aiMesh *mesh, const double m[12])
{
    (void)m;
    const int status = check_mesh(l, mesh);
    uint64_t n = l->model->n_tris;
    for (unsigned f = 0; status == SIM_OK && f < mesh->mNumFaces; f++)
        n += mesh->mFaces[f].mNumIndices < 3 ? 0u : mesh->mFaces[f].mNumIndices - 2u;
    if (n > UINT32_MAX / 3u)
        return sim_refuse(l->file, 0, "more than %u triangles; split the model", UINT32_MAX / 3u);
    l->model->n_tris = (uint32_t)n;
    return status;
}

static uint8_t to_byte(float c)
{
    return c >= 1.0f ? 255 : c > 0.0f ? (uint8_t)(c * 255.0f + 0.5f) : 0; /* NaN: 0 */
}

static struct zs_rgb to_rgb(const struct aiColor4D *c)
{
    return (struct zs_rgb){ to_byte(c->r), to_byte(c->g), to_byte(c->b) };
}

/* A colour of the scene: glTF's are light. */
static struct zs_rgb shown_rgb(const struct load *l, const struct aiColor4D *c)
{
    const struct aiColor4D shown = { (float)sim_srgb((double)c->r), (float)sim_srgb((double)c->g),
                                     (float)sim_srgb((double)c->b), c->a };
    return to_rgb(l->gltf ? &shown : c);
}

static struct zs_rgb material_rgb(const struct load *l, const struct aiMaterial *material)
{
    const struct zs_rgb plain = { 204, 204, 204 };
    struct aiColor4D c;
    if (l->want->color != NULL)
        return *l->want->color;
    if ((l->family == FAMILY_OBJ && !l->has_materials) || l->family == FAMILY_PLY ||
        l->family == FAMILY_STL || l->family == FAMILY_OFF) /* assimp makes one up: 0.6 or 1 */
        return plain;
    struct aiString name;
    if (aiGetMaterialString(material, AI_MATKEY_NAME, &name) == aiReturn_SUCCESS &&
        strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0) /* 0.6 */
        return plain;
    if (l->family == FAMILY_OBJ) { /* assimp takes 0.6 where there is no Kd, and green and blue of one number as 0 */
        const struct sim_mtl_entry *mtl = sim_mtl_find(&l->mtl, name.data);
        if (mtl == NULL)
            return plain;
        return to_rgb(&(struct aiColor4D){ (float)mtl->kd[0], (float)mtl->kd[1], (float)mtl->kd[2], 1.0f });
    }
    if (aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &c) != aiReturn_SUCCESS)
        return plain;
    return shown_rgb(l, &c);
}

/* Do materials come from the file, and not from assimp or an OBJ's own scan? */
static int has_looks(const struct load *l)
{
    return l->family == FAMILY_OTHER;
}

static int is_black(struct zs_rgb c)
{
    return c.r == 0 && c.g == 0 && c.b == 0;
}

/* The file's materials, without textures; at least one. */
static void fill_materials(struct load *l)
{
    struct sim_model *model = l->model;
    const unsigned n = l->scene->mNumMaterials;
    model->n_materials = n > 0 ? n : 1;
    model->material = sim_alloc(model->n_materials, sizeof *model->material);
    for (uint32_t i = 0; i < model->n_materials; i++) {
        struct sim_material *to = &model->material[i];
        struct aiString name = { .length = 0 };
        if (i < n)
            (void)aiGetMaterialString(l->scene->mMaterials[i], AI_MATKEY_NAME, &name);
        to->name = strcpy(sim_alloc(strlen(name.data) + 1, 1), name.data);
        to->rgb = i < n ? material_rgb(l, l->scene->mMaterials[i])
                        : (struct zs_rgb){ 204, 204, 204 };
        to->texture = SIM_NO_TEXTURE;
        sim_material_look(to, i < n && has_looks(l) ? l->scene->mMaterials[i] : NULL, sim_mtl_find(&l->mtl, to->name));
        if (l->want->color == NULL && is_black(to->rgb) && !is_black(to->emission)) { /* it shines, and that is all */
            to->rgb = to->emission;
            to->emission = (struct zs_rgb){ 0, 0, 0 };
            to->unlit = 1;
        }
    }
    if (l->want->textures)
        l->use = sim_alloc(model->n_materials, sizeof *l->use);
    for (uint32_t i = 0; l->use != NULL && i < model->n_materials; i++) {
        sim_material_use(&l->use[i], i < n ? l->scene->mMaterials[i] : NULL,
                         sim_mtl_find(&l->mtl, model->material[i].name));
        l->use[i].alpha_mode = model->material[i].alpha_mode;
        l->use[i].alpha_least = model->material[i].alpha_least;
    }
}

/* What materials that faces use have and no model keeps. OBJ: as its material files say. */
static void count_losses(struct load *l)
{
    struct sim_model *model = l->model;
    enum { USED = 1, PLACED = 2 }; /* by a face; by one with texture coordinates */
    uint8_t *used = sim_alloc(model->n_materials, 1);
    for (uint32_t t = 0; t < model->n_tris; t++)
        used[model->tri_material[t]] |= model->has_uv != NULL && model->has_uv[t] ? USED | PLACED : USED;
    sim_losses_count(model->lost, l->scene, l->family == FAMILY_OBJ ? NULL : used);
    if (l->family == FAMILY_STL) /* assimp's: the format has none */
        memset(&model->lost[SIM_LOST_VERTEX_ALPHA], 0, sizeof *model->lost);
    for (size_t i = 0; i < l->obj.n_lines; i++)
        sim_lose(model->lost, SIM_LOST_LINES, "");
    for (size_t i = 0; i < l->obj.n_curves; i++)
        sim_lose(model->lost, SIM_LOST_CURVES, "");
    for (uint32_t i = 0; i < model->n_materials; i++) /* all of it is to be cut out */
        if (used[i] && model->material[i].alpha_mode == SIM_ALPHA_MASK && model->material[i].alpha < 255 &&
            model->material[i].alpha_least == 255)
            sim_lose(model->lost, SIM_LOST_OPACITY, model->material[i].name);
    for (uint32_t i = 0; l->use != NULL && l->want->picture == NULL && i < model->n_materials; i++)
        if (used[i] == USED && l->use[i].path[0] != '\0')
            sim_lose(model->lost, SIM_LOST_UNPLACED, model->material[i].name);
    for (uint32_t i = 0; l->family == FAMILY_OBJ && i < model->n_materials; i++) {
        const struct sim_mtl_entry *mtl = used[i] ? sim_mtl_find(&l->mtl, model->material[i].name) : NULL;
        for (int kind = 0; mtl != NULL && kind < SIM_LOST_KINDS; kind++)
            if (mtl->other_maps >> kind & 1)
                sim_lose(model->lost, (enum sim_lost_kind)kind, model->material[i].name);
        if (used[i] && mtl == NULL && l->has_materials && model->material[i].name[0] != '\0' &&
            strcmp(model->material[i].name, AI_DEFAULT_MATERIAL_NAME) != 0)
            sim_lose(model->lost, SIM_LOST_MATERIAL, model->material[i].name);
        if (mtl != NULL && mtl->mask != NULL && mtl->picture == NULL)
            sim_lose(model->lost, SIM_LOST_OPACITY_MAP, model->material[i].name);
    }
    free(used);
}

/* What the faces of one mesh share. */
struct placement {
    const double *m;   /* [12], to the model's space */
    double normals[9]; /* its cofactors */
    int mirrored;      /* flag */
    struct zs_rgb rgb;
    struct aiColor4D base; /* glTF: what vertex colours are multiplied by; else 1 */
    uint32_t material;
    const struct sim_use *use; /* NULL: no uv are wanted */
};

static void take_normal(float out[3], const struct aiMesh *mesh, unsigned v,
                        const double inverse[9])
{
    double n[3] = { 0.0, 0.0, 0.0 };
    const double in[3] = { (double)mesh->mNormals[v].x, (double)mesh->mNormals[v].y,
                           (double)mesh->mNormals[v].z };
    for (int k = 0; k < 3; k++)
        n[k] = sim_dot(inverse + 3 * k, in);
    if (!isfinite(n[0]) || !isfinite(n[1]) || !isfinite(n[2]) || !(sim_unit(n) > 0.0))
        return; /* 0 0 0: found from the faces later */
    for (int k = 0; k < 3; k++)
        out[k] = (float)n[k];
}

/* How normals go with a placement: its cofactors, with the sign that keeps outside outside. */
static double cofactors(double out[9], const double m[12])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            out[3 * i + j] = m[4 * a + c] * m[4 * b + d] - m[4 * a + d] * m[4 * b + c];
        }
    const double det = m[0] * out[0] + m[1] * out[1] + m[2] * out[2];
    for (int k = 0; k < 9 && det < 0.0; k++)
        out[k] = -out[k];
    return det;
}

/* The position of a corner. OBJ: the scan's, *ok cleared where assimp's is another one. */
static void take_position(struct load *l, const struct aiVector3D *v, const double m[12],
                          double out[3], int *ok)
{
    const double in[3] = { (double)v->x, (double)v->y, (double)v->z };
    if (l->family != FAMILY_OBJ) {
        for (int k = 0; k < 3; k++)
            out[k] = m[4 * k] * in[0] + m[4 * k + 1] * in[1] + m[4 * k + 2] * in[2] + m[4 * k + 3];
        return;
    }
    memcpy(out, l->obj.point[l->obj.corner[l->corner++]], 3 * sizeof(double));
    for (int k = 0; k < 3; k++)
        if (fabs(out[k]) < 1e37 && fabs(in[k] - out[k]) > 1e-5 * fabs(out[k]) + 1e-36)
            *ok = 0;
}

/* The texture coordinates of the corner whose position was taken last; 0 where it has none.
 * OBJ, and PLY where faces have them: the scan's. */
static int take_uv(struct load *l, const struct aiMesh *mesh, unsigned v,
                   const struct sim_use *use, double out[2])
{
    double in[2];
    if (l->family == FAMILY_OBJ) {
        const uint32_t n = l->obj.corner_uv[l->corner - 1];
        if (n == SIM_NONE)
            return 0;
        memcpy(in, l->obj.uv[n], sizeof in);
    } else if (l->ply.uv != NULL) {
        in[0] = (double)l->ply.uv[l->corner][0];
        in[1] = (double)l->ply.uv[l->corner++][1];
        if (isnan(in[0]) || isnan(in[1]))
            return 0;
    } else {
        const struct aiVector3D *uv = use->channel < AI_MAX_NUMBER_OF_TEXTURECOORDS
                                          ? mesh->mTextureCoords[use->channel]
                                          : NULL;
        if (uv == NULL)
            return 0;
        in[0] = (double)uv[v].x;
        in[1] = (double)uv[v].y;
    }
    out[0] = use->uv[0][0] * in[0] + use->uv[0][1] * in[1] + use->uv[0][2];
    out[1] = 1.0 - (use->uv[1][0] * in[0] + use->uv[1][1] * in[1] + use->uv[1][2]);
    return 1;
}

static void add_triangle(struct sim_model *model, const struct placement *at, int has_uv,
                         const struct corner *a, const struct corner *b, const struct corner *c)
{
    const struct corner *corner[3] = { a, at->mirrored ? c : b, at->mirrored ? b : c };
    const uint32_t t = model->n_tris++;
    for (int i = 0; i < 3; i++) {
        model->tri[t][i] = corner[i]->point;
        model->rgb[t][i] = corner[i]->rgb;
        if (model->normal != NULL)
            memcpy(model->normal[t][i], corner[i]->normal, sizeof corner[i]->normal);
        if (model->uv != NULL && has_uv)
            memcpy(model->uv[t][i], corner[i]->uv, sizeof corner[i]->uv);
    }
    model->tri_material[t] = at->material;
    if (model->uv != NULL)
        model->has_uv[t] = (uint8_t)has_uv;
}

static struct zs_rgb corner_rgb(const struct load *l, const struct aiMesh *mesh, unsigned v, const struct placement *at)
{
    if (mesh->mColors[0] == NULL || l->want->color != NULL || is_black(shown_rgb(l, &at->base)))
        return at->rgb;
    struct aiColor4D c = mesh->mColors[0][v];
    const int none = l->family == FAMILY_OBJ   ? c.r < 0.0f /* by the scan */
                     : l->family == FAMILY_PLY ? !l->ply.colors
                                               : l->family == FAMILY_STL && c.a < 1.0f; /* by assimp */
    if (none)
        return at->rgb;
    c.r *= at->base.r;
    c.g *= at->base.g;
    c.b *= at->base.b;
    return shown_rgb(l, &c);
}

/* One corner of a face; *ok is cleared where assimp's is not the scan's, *has_uv where it has no
 * texture coordinates. */
static int take_corner(struct load *l, const struct aiMesh *mesh, unsigned v,
                       const struct placement *at, struct corner *out, int *ok, int *has_uv)
{
    double p[3];
    *out = (struct corner){ .rgb = corner_rgb(l, mesh, v, at) };
    take_position(l, &mesh->mVertices[v], at->m, p, ok);
    for (int i = 0; i < 3; i++)
        if (!(fabs(p[i]) <= COORD_MAX))
            return sim_refuse(l->file, 0, "coordinate %g is beyond %g; scale the model down", p[i],
                              COORD_MAX);
    out->point = sim_weld_point(&l->weld, l->model, p);
    if (l->want->normals && mesh->mNormals != NULL && l->family != FAMILY_STL) {
        take_normal(out->normal, mesh, v, at->normals);
        l->model->file_normals = 1;
    }
    if (at->use != NULL && !take_uv(l, mesh, v, at->use, out->uv))
        *has_uv = 0;
    if (!(fabs(out->uv[0]) <= SIM_UV_MAX && fabs(out->uv[1]) <= SIM_UV_MAX))
        return sim_refuse(l->file, 0,
                          "vertex %u of mesh '%s' has the texture coordinates %g, %g; the picture "
                          "is 0 to 1, and zsim takes up to %g",
                          v + 1, mesh->mName.data, out->uv[0], out->uv[1], SIM_UV_MAX);
    return SIM_OK;
}

static void make_room(struct polygon *p, unsigned n)
{
    if (n <= p->room)
        return;
    p->room = n;
    p->corner = sim_grow(p->corner, n, sizeof *p->corner);
    p->point = sim_grow(p->point, n, sizeof *p->point);
    p->tri = sim_grow(p->tri, n, sizeof *p->tri);
}

static int add_face(struct load *l, const struct aiMesh *mesh, const struct aiFace *face,
                    const struct placement *at)
{
    struct sim_model *model = l->model;
    struct polygon *const p = &l->polygon;
    const uint32_t n = face->mNumIndices;
    int has_uv = 1, status = SIM_OK;
    int ok = l->family != FAMILY_OBJ ||
             (l->face < l->obj.n_faces && l->obj.count[l->face++] == face->mNumIndices);
    if (l->ply.uv != NULL && at->use != NULL)
        ok = n <= l->ply.n_uvs - l->corner;
    make_room(p, n);
    for (unsigned k = 0; ok && k < n; k++) {
        status = take_corner(l, mesh, face->mIndices[k], at, &p->corner[k], &ok, &has_uv);
        if (status != SIM_OK)
            return status;
        memcpy(p->point[k], model->point[p->corner[k].point], sizeof p->point[k]);
    }
    if (ok) {
        sim_polygon_cut((const double (*)[3])p->point, n, p->tri);
        for (unsigned t = 0; t + 2 < n; t++)
            add_triangle(model, at, has_uv, &p->corner[p->tri[t][0]], &p->corner[p->tri[t][1]],
                         &p->corner[p->tri[t][2]]);
    }
    return ok ? SIM_OK
              : sim_refuse(l->file, 0,
                           "the loader gave other faces than the file holds, from face %zu on; "
                           "please report this file",
                           l->face);
}

static int fill_mesh(struct load *l, const struct aiMesh *mesh, const double m[12])
{
    struct placement at = { .m = m, .base = { 1.0f, 1.0f, 1.0f, 1.0f } };
    int status = SIM_OK;
    at.mirrored = cofactors(at.normals, m) < 0.0;
    at.material = mesh->mMaterialIndex < l->model->n_materials ? mesh->mMaterialIndex : 0;
    at.rgb = l->model->material[at.material].rgb;
    if (l->gltf && at.material < l->scene->mNumMaterials)
        (void)aiGetMaterialColor(l->scene->mMaterials[at.material], AI_MATKEY_COLOR_DIFFUSE, &at.base);
    at.use = l->use != NULL ? &l->use[at.material] : NULL;
    for (unsigned f = 0; status == SIM_OK && f < mesh->mNumFaces; f++) {
        if (mesh->mFaces[f].mNumIndices >= 3)
            status = add_face(l, mesh, &mesh->mFaces[f], &at);
        if (f % 4096 == 0)
            sim_progress("building", f, mesh->mNumFaces);
    }
    return status;
}

/* ---- Load ------------------------------------------------------------------------------------ */

static int look_through(struct load *l)
{
    int status = read_file(l);
    if (status == SIM_OK)
        status = check_wide(l->file, l->text, l->bytes);
    if (status == SIM_OK && l->family == FAMILY_OBJ)
        status = sim_obj_scan(&l->obj, l->file, l->text, l->bytes);
    if (status == SIM_OK && l->family == FAMILY_PLY)
        status = sim_ply_check(&l->ply, l->model->lost, l->file, l->text, &l->bytes);
    if (status == SIM_OK && l->family == FAMILY_STL)
        status = sim_stl_check(l->model->lost, l->file, l->text, l->bytes);
    if (status == SIM_OK && l->family == FAMILY_OFF)
        sim_off_look(l->model->lost, l->text, l->bytes);
    if (status == SIM_OK && l->family == FAMILY_OTHER)
        status = sim_gltf_check(l->file, l->text, l->bytes);
    if (status == SIM_OK && l->family == FAMILY_OTHER)
        sim_gltf_extensions(l->model->lost, l->file, l->text, l->bytes);
    if (status == SIM_OK && l->family == FAMILY_OTHER)
        sim_gltf_skins(l->model->lost, l->file, l->text, l->bytes);
    l->gltf = l->family == FAMILY_OTHER && sim_gltf_json(l->file, l->text, l->bytes).p != NULL;
    if (status == SIM_OK && l->gltf)
        status = sim_gltf_floats(l->file, &l->text, &l->bytes, read_text);
    if (l->family == FAMILY_OBJ) {
        free(l->text);
        l->text = NULL;
    }
    return status;
}

/* OFF's colours may be whole numbers up to 255: then some are above 1. */
static void scale_colors(const struct aiMesh *mesh)
{
    struct aiColor4D *const c = mesh->mColors[0];
    float most = 0.0f;
    for (unsigned v = 0; c != NULL && v < mesh->mNumVertices; v++)
        most = fmaxf(most, fmaxf(fmaxf(c[v].r, c[v].g), fmaxf(c[v].b, c[v].a)));
    for (unsigned v = 0; most > 1.0f && v < mesh->mNumVertices; v++)
        c[v] = (struct aiColor4D){ c[v].r / 255.0f, c[v].g / 255.0f, c[v].b / 255.0f, c[v].a / 255.0f };
}

static int build(struct load *l)
{
    struct sim_model *model = l->model;
    for (unsigned i = 0; l->family == FAMILY_OFF && i < l->scene->mNumMeshes; i++)
        scale_colors(l->scene->mMeshes[i]);
    int status = walk(l, count_mesh);
    if (status == SIM_OK && model->n_tris == 0)
        status = sim_refuse(l->file, 0, "no faces in it; zsim draws polygons");
    if (status != SIM_OK)
        return status;
    const size_t n = model->n_tris, corners = 3 * n;
    sim_weld_begin(&l->weld, corners);
    model->point = sim_alloc(corners, sizeof *model->point);
    model->tri = sim_alloc(n, sizeof *model->tri);
    model->rgb = sim_alloc(n, sizeof *model->rgb);
    model->normal = l->want->normals ? sim_alloc(n, sizeof *model->normal) : NULL;
    model->uv = l->want->textures ? sim_alloc(n, sizeof *model->uv) : NULL;
    model->has_uv = l->want->textures ? sim_alloc(n, 1) : NULL;
    model->tri_material = sim_alloc(n, sizeof *model->tri_material);
    fill_materials(l);
    model->n_tris = 0;
    status = walk(l, fill_mesh);
    sim_weld_end(&l->weld);
    free(l->polygon.corner);
    free(l->polygon.point);
    free(l->polygon.tri);
    if (status == SIM_OK && l->ply.uv != NULL && l->use != NULL && l->corner != l->ply.n_uvs)
        status = sim_refuse(l->file, 0, "the loader gave %zu of %zu corners; please report this file", l->corner,
                            l->ply.n_uvs);
    if (status == SIM_OK && l->family == FAMILY_OBJ && l->face != l->obj.n_faces)
        status = sim_refuse(l->file, 0, "the loader gave %zu of %zu faces; please report this file",
                            l->face, l->obj.n_faces);
    model->point = sim_grow(model->point, model->n_points, sizeof *model->point);
    if (status == SIM_OK)
        status = sim_model_fill_bounds(model);
    if (status == SIM_OK && l->want->normals)
        sim_model_fill_normals(model, l->gltf); /* as the format wants it */
    if (status == SIM_OK)
        count_losses(l);
    if (status == SIM_OK && l->want->simplify != NULL) {
        sim_simplify(model, l->want->simplify);
        status = sim_model_fill_bounds(model);
    }
    if (status == SIM_OK && l->want->textures)
        status = sim_material_textures(model, l->scene, l->use, l->want);
    return status;
}

int sim_model_read(struct sim_model *model, const char *file, const struct sim_want *want)
{
    memset(model, 0, sizeof *model);
    struct load l = { .model = model, .file = file, .family = family_of(file), .want = want };
    model->file = file;
    model->single = l.family != FAMILY_OBJ;
    sim_outside_begin(file, want->limits.outside);
    int status = look_through(&l);
    if (status == SIM_OK)
        status = import(&l);
    free(l.text);
    if (status == SIM_OK)
        status = build(&l);
    if (l.scene != NULL)
        aiReleaseImport(l.scene);
    sim_outside_forget();
    sim_obj_free(&l.obj);
    sim_ply_free(&l.ply);
    sim_mtl_free(&l.mtl);
    for (uint32_t i = 0; l.use != NULL && i < model->n_materials; i++)
        SIM_FREE(l.use[i].path, l.use[i].mask);
    free(l.use);
    if (status != SIM_OK)
        sim_model_free(model);
    return status;
}
