/* glTF as assimp reads it: integer positions, normals and texture coordinates (KHR_mesh_quantization, and texture
 * coordinates of any), numbers that are replaced, texture coordinates that KHR_texture_transform names.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_GLTF_FLOATS_H
#define SIM_GLTF_FLOATS_H

#include <stddef.h>

/* A whole file that the model names, malloc'ed; NULL: there is none, or it may not be read. */
typedef char *sim_gltf_read(const char *path, size_t *bytes);

/* Put that into the text. *text: the model's file, malloc'ed, with a '\0' behind it, as it is then; other files, and
 * those without any of it, stay as they are. Return SIM_OK; SIM_REFUSED, said why. */
int sim_gltf_floats(const char *file, char **text, size_t *bytes, sim_gltf_read *read);

#endif
