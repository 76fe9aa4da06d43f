/* glTF: is a .glb all there, and of a version that is read? And what assimp's complaints mean.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "scan.h"
#include "sim.h"

static int ends_in(const char *file, const char *end)
{
    const size_t n = strlen(file), k = strlen(end);
    return n >= k && strcasecmp(file + n - k, end) == 0;
}

static uint32_t u32(const char *p)
{
    const unsigned char *b = (const unsigned char *)p;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

int sim_gltf_check(const char *file, const char *text, size_t bytes)
{
    if (!ends_in(file, ".glb") || bytes < 4 || memcmp(text, "glTF", 4) != 0)
        return SIM_OK;
    if (bytes < 20 || u32(text + 8) > bytes)
        return sim_refuse(file, 0, "cut off: it is shorter than its header says; get the whole file");
    if (u32(text + 4) != 2)
        return sim_refuse(file, 0, "is glTF %u, which is not read; export it as glTF 2.0", u32(text + 4));
    return SIM_OK;
}

struct sim_text sim_gltf_json(const char *file, const char *text, size_t bytes)
{
    const struct sim_text none = { NULL, NULL };
    if (ends_in(file, ".gltf"))
        return (struct sim_text){ text, text + bytes };
    if (!ends_in(file, ".glb") || bytes < 20 || u32(text + 12) > bytes - 20)
        return none;
    return (struct sim_text){ text + 20, text + 20 + u32(text + 12) };
}

/* Does a list of strings have one? */
static int has(struct sim_text list, struct sim_text string)
{
    struct sim_text left = sim_text_inside(list), value;
    while (sim_text_next(&left, NULL, &value))
        if (value.end - value.p == string.end - string.p &&
            memcmp(value.p, string.p, (size_t)(string.end - string.p)) == 0)
            return 1;
    return 0;
}

void sim_gltf_extensions(struct sim_lost *lost, const char *file, const char *text, size_t bytes)
{
    static const char *const known[] = { "KHR_materials_unlit", "KHR_texture_transform", "KHR_mesh_quantization",
                                         "KHR_materials_pbrSpecularGlossiness", "KHR_draco_mesh_compression",
                                         "KHR_materials_variants" };
    struct sim_text json = sim_gltf_json(file, text, bytes), root;
    if (json.p == NULL || !sim_text_next(&json, NULL, &root))
        return;
    const struct sim_text required = sim_text_member(root, "extensionsRequired");
    const struct sim_text lists[2] = { required, sim_text_member(root, "extensionsUsed") };
    for (int k = 0; k < 2; k++) {
        struct sim_text names = sim_text_inside(lists[k]), name;
        while (sim_text_next(&names, NULL, &name)) {
            int read = !sim_text_begins(name, "") ||
                       (k == 1 && (has(required, name) || !(sim_text_begins(name, "KHR_materials_") ||
                                                            sim_text_is(name, "EXT_mesh_gpu_instancing"))));
            for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
                read |= sim_text_is(name, known[i]);
            char plain[64];
            (void)snprintf(plain, sizeof plain, "%.*s", (int)(name.end - name.p < 65 ? name.end - name.p - 2 : 63),
                           name.p + 1);
            if (!read)
                sim_lose(lost, SIM_LOST_EXTENSION, plain);
        }
    }
}

/* The key of a member, which is to be another name; p NULL: it is not there. */
static struct sim_text key_of(struct sim_text object, const char *name)
{
    struct sim_text left = sim_text_inside(object), key, value;
    while (object.p != NULL && *object.p == '{' && sim_text_next(&left, &key, &value))
        if (sim_text_is(key, name))
            return key;
    return (struct sim_text){ NULL, NULL };
}

static int has_incomplete_skin(struct sim_text root)
{
    struct sim_text skins = sim_text_inside(sim_text_member(root, "skins")), skin;
    while (sim_text_next(&skins, NULL, &skin))
        if (sim_text_member(skin, "inverseBindMatrices").p == NULL)
            return 1;
    return 0;
}

/* The name of a node's mesh; "": it has none. */
static void name_of_mesh(char out[40], struct sim_text root, struct sim_text node)
{
    struct sim_text meshes = sim_text_inside(sim_text_member(root, "meshes")), mesh = { NULL, NULL };
    uint64_t i = sim_text_number(sim_text_member(node, "mesh"), 0);
    while (sim_text_next(&meshes, NULL, &mesh) && i > 0)
        i--;
    const struct sim_text name = sim_text_member(mesh, "name");
    const int known = i == 0 && name.p != NULL && sim_text_begins(name, "");
    (void)snprintf(out, 40, "%.*s", known ? (int)(name.end - name.p < 41 ? name.end - name.p - 2 : 39) : 0,
                   known ? name.p + 1 : "");
}

void sim_gltf_skins(struct sim_lost *lost, const char *file, char *text, size_t bytes)
{
    struct sim_text json = sim_gltf_json(file, text, bytes), root, node;
    if (json.p == NULL || !sim_text_next(&json, NULL, &root) || !has_incomplete_skin(root))
        return;
    struct sim_text nodes = sim_text_inside(sim_text_member(root, "nodes"));
    while (sim_text_next(&nodes, NULL, &node)) {
        const struct sim_text key = key_of(node, "skin");
        char name[40] = "";
        if (key.p == NULL)
            continue;
        if (lost[SIM_LOST_SKIN].n == 0)
            name_of_mesh(name, root, node);
        sim_lose(lost, SIM_LOST_SKIN, name);
        text[key.p + 1 - text] = '-';
    }
    text[key_of(root, "skins").p + 1 - text] = '-';
}

const char *sim_gltf_words(const char *file, const char *heard)
{
    static const struct {
        const char *heard, *words;
    } known[] = {
        { "No suitable reader",
          "its JSON does not end or is broken, or it is no glTF 2.0; get the whole file, or export it as glTF 2.0" },
        { "missing the \"uri\" attribute",
          "a buffer has no data; where it is compressed (EXT_meshopt_compression), export it uncompressed" },
        { "GLTF: No scene", "no scene in it; export the model again" },
        { "recursive reference", "its nodes hold each other in a ring; export the model again" },
        { "GLTF: Accessor with", "an accessor goes beyond its buffer; get the whole file" },
        { "exceeds size of actual data", "its buffer is shorter than it says; get the whole file" },
        { "Unsupported Component Type", "an accessor makes no sense; export the model again" },
        { "data is null when extracting", "an accessor has no data; export the model again" },
        { "is out of bounds", "it names parts that are not there; export the model again" },
        { "Missing section", "it names parts that are not there; export the model again" },
        { "has no faces", "no faces in it; zsim draws polygons" },
        { "out-of-range indices", "its faces name vertices that are not there; export the model again" },
    };
    static char missing[200];
    if (!ends_in(file, ".glb") && !ends_in(file, ".gltf"))
        return NULL;
    const char *name = strstr(heard, "could not open referenced file \"");
    if (name != NULL) {
        name = strchr(name, '"') + 1;
        (void)snprintf(missing, sizeof missing, "it names %.*s, which is not there; put that file beside it",
                       (int)(strcspn(name, "\"") < 100 ? strcspn(name, "\"") : 100), name);
        return missing;
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strstr(heard, known[i].heard) != NULL)
            return known[i].words;
    return NULL;
}
