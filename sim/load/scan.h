/* What assimp does not check: text and headers of model files, looked through before it reads them.
 *
 * assimp 5.2.5 lets NaN, two-vertex faces and missing indices pass, repeats the last line of a PLY
 * that was cut off, names no lines, keeps single-precision positions, and takes the options of a
 * map_Kd for a part of its name.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_SCAN_H
#define SIM_SCAN_H

#include <stddef.h>
#include <stdint.h>

#include "json_text.h"
#include "losses.h"

#define SIM_NONE UINT32_MAX

/* An OBJ file's points and faces, exactly as written, and the same file cleaned up for assimp. */
struct sim_obj {
    double (*point)[3]; /* [n_points], every `v` */
    uint32_t *corner;   /* [n_corners], point of a face's corner */
    uint32_t *count;    /* [n_faces], corners of a face, >= 3 */
    double (*uv)[2];     /* [n_uvs], every `vt`, as written: v upwards */
    uint32_t *corner_uv; /* [n_corners], its uv, or SIM_NONE */
    size_t n_points, n_corners, n_faces, n_uvs;
    size_t n_lines;  /* elements that are points and lines */
    size_t n_curves; /* elements that are curves and surfaces */
    char *text; /* absolute indices, no groups, no elements but faces: assimp keeps its order */
    size_t text_bytes;
};

/* Look through the text of an OBJ file, which ends in a '\0' at text[bytes].
 * Return SIM_OK; SIM_REFUSED, said why, *obj empty. sim_obj_free in either case. */
int sim_obj_scan(struct sim_obj *obj, const char *file, const char *text, size_t bytes);
void sim_obj_free(struct sim_obj *obj);

/* What an MTL file says of a material: its diffuse colour and texture (map_Kd), and how else it looks. */
struct sim_mtl_entry {
    char *name;
    char *picture;    /* as written; NULL: none */
    char *mask;       /* map_d, likewise */
    double d;         /* opacity, by d or Tr; 1 where it is not given */
    double ke[3], ks[3], ns; /* 0 where they are not given */
    uint64_t other_maps; /* bits of enum sim_lost_kind: textures that are passed over */
    double kd[3];     /* 1 1 1 where it is not given */
    double scale[2], shift[2]; /* -s and -o: uv = scale * given + shift, v upwards; 1 and 0 */
    int clamp;        /* flag: -clamp on */
};

struct sim_mtl {
    struct sim_mtl_entry *entry;
    size_t n;
};

/* Add the materials of an MTL file, which ends in a '\0' at text[bytes]. What is not understood is
 * passed over. */
void sim_mtl_scan(struct sim_mtl *mtl, const char *text, size_t bytes);
void sim_mtl_free(struct sim_mtl *mtl);

/* The material of a name, the last one where there are several; NULL: none. */
const struct sim_mtl_entry *sim_mtl_find(const struct sim_mtl *mtl, const char *name);

/* Texture coordinates that a PLY's faces give their corners (`texcoord`, as MeshLab writes it), of which assimp takes
 * one pair a vertex; and whether its vertices have colours: assimp makes black ones of alpha alone. */
struct sim_ply {
    int colors; /* flag */
    float (*uv)[2]; /* [n_uvs], corners in file order: v upwards, NaN where a face has none; NULL: no face has any */
    size_t n_uvs, room;
};

/* Refuse a PLY or STL file that is cut off, or in which a face is wrong, or a .glb by its header; note colours that are
 * not read. Text as above; sim_ply_free in any case. Elements that assimp does not know are cut out of a PLY's; of an
 * STL's, words get small letters, and what is between solids becomes blanks. */
int sim_gltf_check(const char *file, const char *text, size_t bytes);
int sim_ply_check(struct sim_ply *ply, struct sim_lost *lost, const char *file, char *text, size_t *bytes);
void sim_ply_free(struct sim_ply *ply);
int sim_stl_check(struct sim_lost *lost, const char *file, char *text, size_t bytes);

/* Of an OFF file: note colours that are not read. */
void sim_off_look(struct sim_lost *lost, const char *text, size_t bytes);

/* Of a glTF file: note the extensions that are not read: all that it requires, and those of how it looks. Other files:
 * nothing. */
void sim_gltf_extensions(struct sim_lost *lost, const char *file, const char *text, size_t bytes);

/* Of a glTF file with skins that have no matrices of their own, by which assimp would crash: all of its skins get
 * another name in the text, and are noted. */
void sim_gltf_skins(struct sim_lost *lost, const char *file, char *text, size_t bytes);

/* The JSON of a glTF file; p NULL: it has none. A .glb's stands behind 20 bytes. */
struct sim_text sim_gltf_json(const char *file, const char *text, size_t bytes);

/* A sentence for what assimp says of a glTF file; NULL: none is known. */
const char *sim_gltf_words(const char *file, const char *heard);

#endif
