/* assimp, loaded where a model is: as a library that zsim is linked with, it and those that it needs took half of the
 * time of a command that reads no model (zsim help: 15 ms, now 8), and a quarter under the tests' sanitizers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "assimp_library.h"
#include "sim.h"
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <dlfcn.h>
#include <stddef.h>

#define LIBRARY "libassimp.so" /* of the headers that zsim is compiled with, by the link beside them */

/* A function of assimp's, which is to be found first. RETURN: return, or nothing */
#define CALL(result, name, RETURN, parameters, arguments)                                                              \
    static result(*library_##name) parameters;                                                                         \
    result name parameters { RETURN library_##name arguments; }

CALL(const struct aiScene *, aiImportFileEx, return, (const char *file, unsigned flags, struct aiFileIO *io),
     (file, flags, io))
CALL(void, aiReleaseImport, , (const struct aiScene *scene), (scene))
CALL(const char *, aiGetErrorString, return, (void), ())
CALL(void, aiAttachLogStream, , (const struct aiLogStream *stream), (stream))
CALL(enum aiReturn, aiDetachLogStream, return, (const struct aiLogStream *stream), (stream))
CALL(enum aiReturn, aiGetMaterialString, return,
     (const struct aiMaterial *m, const char *key, unsigned type, unsigned index, struct aiString *out),
     (m, key, type, index, out))
CALL(enum aiReturn, aiGetMaterialColor, return,
     (const struct aiMaterial *m, const char *key, unsigned type, unsigned index, struct aiColor4D *out),
     (m, key, type, index, out))
CALL(enum aiReturn, aiGetMaterialFloatArray, return,
     (const struct aiMaterial *m, const char *key, unsigned type, unsigned index, ai_real *out, unsigned *most),
     (m, key, type, index, out, most))
CALL(enum aiReturn, aiGetMaterialIntegerArray, return,
     (const struct aiMaterial *m, const char *key, unsigned type, unsigned index, int *out, unsigned *most),
     (m, key, type, index, out, most))
CALL(enum aiReturn, aiGetMaterialUVTransform, return,
     (const struct aiMaterial *m, const char *key, unsigned type, unsigned index, struct aiUVTransform *out),
     (m, key, type, index, out))

int sim_assimp_open(const char *file)
{
#define FIND(name) { #name, (void **)&library_##name }
    static const struct {
        const char *name;
        void **at;
    } calls[] = {
        FIND(aiImportFileEx),           FIND(aiReleaseImport),     FIND(aiGetErrorString),
        FIND(aiAttachLogStream),        FIND(aiDetachLogStream),   FIND(aiGetMaterialString),
        FIND(aiGetMaterialColor),       FIND(aiGetMaterialFloatArray),
        FIND(aiGetMaterialIntegerArray), FIND(aiGetMaterialUVTransform),
    };
    static void *library;
    if (library != NULL)
        return SIM_OK;
    void *const opened = dlopen(LIBRARY, RTLD_NOW | RTLD_LOCAL);
    for (size_t i = 0; opened != NULL && i < sizeof calls / sizeof calls[0]; i++)
        if ((*calls[i].at = dlsym(opened, calls[i].name)) == NULL)
            return sim_refuse(file, 0, "cannot be loaded: assimp: %s; build zsim anew", dlerror());
    if (opened == NULL)
        return sim_refuse(file, 0, "cannot be loaded: %s; install libassimp-dev", dlerror());
    library = opened;
    return SIM_OK;
}
