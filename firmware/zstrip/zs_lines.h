/* Lines and points in place of a mesh's triangles; a mesh's edges; hidden lines.
 *
 *     static const uint16_t pair[2][2] = { { 0, 1 }, { 1, 2 } };
 *     static const struct zs_lines wire = { ZS_LINES(pair, 2), .width = 1 };
 *     static const struct zs_material ink = { .shader = &zs_shade_plain, .rgb = ZS_RGB(0xffffff),
 *                                             .primitive = &wire.primitive };
 *
 * An instance of this material draws the lines between vertices of its mesh, depth-tested as
 * triangles are, with any shader, depth mapping, depth state and method. The frame stays a function
 * of scene, camera and profile. Draw a mesh's faces and its edges by two instances, with one pose.
 *
 * Hidden lines: faces by zs_shade_none, which writes keys alone, pushed back by
 * ZS_HIDDEN_LINE_STATE; then edges. firmware/examples/hidden_line.c is a whole program. With all
 * edges of a mesh, what is drawn is within a pixel of what is visible. Only an edge that is sunk
 * into another part, by less than faces are pushed back, may show for a few px. Silhouettes alone
 * may have gaps of a few px, where the face beside one is thinner than half a px. Take
 * zs_depth_recip, or zs_depth_linear with an orthographic camera: the bias follows their slopes.
 *
 * Which pixels: those that the rules of OpenGL and Direct3D give an aliased line, a parallelogram.
 * Ends are snapped as vertices are. Where |dx| >= |dy| between them (else with x and y exchanged),
 * both ends are moved outwards by half a px in x, and in y by that half px times dy / dx, rounded
 * to a sub-pixel, halves away from 0. The corners are width / 2 above and below them. A pixel is
 * drawn if its middle is inside, or on a left or a level upper side: `width` pixels in each column
 * (row) from the one end's to the other's. A line of length 0 is one column. Swapping the ends
 * changes nothing but the dashes, and of a line of length 0 and one key, which end's colour is to
 * the left. Keys and varyings of corners are those of the ends: on the line,
 * they belong to a place at most half a px away.
 *
 * Clipping: near, far and the guard band cut a line in camera units, as they cut the side of a
 * triangle. A point is drawn if its vertex is between near and far.
 *
 * Statistics: tris_in and what follows count lines and points. tris_facing stays 0, `cull` has no
 * effect. Each is two triangles and four vertices of the pools.
 *
 * Shaders: the face stage gets the line's number in place of a triangle's; where that triangle has
 * a vertex that there is not, its value is 0 instead. There may be no more
 * lines or points than the mesh has triangles, else ZS_ERR_MESH, unless the shader has no face
 * stage, or is zs_shade_plain, or zs_shade_raw and the mesh has no face_raw.
 * What zs_damage_track sees is the material, not what it points to: after a change of a struct
 * zs_lines or of its numbers, zs_invalidate, unless pose or camera have changed too.
 * Errors of zs_frame_begin: ZS_ERR_NULL (a pointer), ZS_ERR_RANGE (width or size; a line that
 * reaches 2^29 world units beyond its mesh, which takes a focal length below 300 px), ZS_ERR_MESH.
 * Cost on a Cortex-M3, in instructions: 3,200 a line of 7 to 10 px, most of them two set-ups; 2,300
 * with zs_shade_raw and ZS_FAST_RAW. A dash 3,400. A point of 3 px 2,800.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_LINES_H
#define ZS_LINES_H

#include "zstrip.h"

ZS_C_BEGIN

extern const struct zs_shader zs_shade_plain; /* the material's rgb, unlit; ZS_VARYINGS_FLAT */
extern const struct zs_shader zs_shade_none;  /* no colour: keys alone are written */

/* ---- Lines ---------------------------------------------------------------------------------- */

struct zs_primitive_ops;
extern const struct zs_primitive_ops zs_lines_ops;
extern const struct zs_primitive_ops zs_points_ops;

struct zs_lines {
    struct zs_primitive primitive; /* set by ZS_LINES */
    const uint16_t (*line)[2];     /* [n], vertex numbers; one >= n_verts: not drawn */
    uint8_t width;                 /* px, 1 .. 64; 0: 1 */
    uint8_t on, off; /* dashes: px along x or y, whichever is longer, from the first end on, that
                        are drawn and left out in turn; on or off 0: no dashes. Where a line is
                        clipped, dashes begin there */
};

struct zs_points {
    struct zs_primitive primitive; /* set by ZS_POINTS */
    const uint16_t *point;         /* [n], vertex numbers; NULL: vertices 0 .. n - 1 */
    uint8_t size;                  /* px, side of a square around the vertex, 1 .. 64; 0: 1 */
};

/* The first members of both, for an initialiser. */
#define ZS_LINES(line_, n_) .primitive = { .ops = &zs_lines_ops, .n = (n_) }, .line = (line_)
#define ZS_POINTS(point_, n_) .primitive = { .ops = &zs_points_ops, .n = (n_) }, .point = (point_)

/* Initialiser of the depth state of faces in front of whose edges lines are drawn: moved back by as
 * much as a key changes over 1 1/2 px, and two buckets. */
#define ZS_HIDDEN_LINE_STATE                                                                       \
    {                                                                                              \
        ZS_DEPTH_LESS, 0, 2, 384                                                                   \
    }

/* ---- The edges of a mesh -------------------------------------------------------------------- */

/* An edge: two vertices, and the triangles at its sides. Vertices in one place count as one. */
struct zs_mesh_edge {
    uint16_t v[2];
    uint16_t tri[2]; /* [1]: ZS_EDGE_NO_TRI where there is one, or more than two */
};
#define ZS_EDGE_NO_TRI 65535u

enum zs_edge_kind {
    ZS_EDGE_BORDER = 1,     /* one triangle, or more than two of them */
    ZS_EDGE_CREASE = 2,     /* the normals differ by more than an angle */
    ZS_EDGE_SILHOUETTE = 4, /* one side faces the eye, the other one does not */
    ZS_EDGE_SMOOTH = 8,     /* none of these */
    ZS_EDGE_ALL = 15
};

/* Find the edges of a mesh. For set-up: n log n steps; 4,400 instructions a triangle of 2,800.
 *
 * edge    [3 * n_tris], memory of the caller; the edges are edge[0 .. n - 1] afterwards.
 * Return  n, the number of edges; ZS_ERR_NULL; ZS_ERR_SIZE: more than 65534 triangles. Triangles
 *         with a vertex number out of range, or with two corners at one place, have no edges. */
int32_t zs_edges_of(struct zs_mesh_edge *edge, const struct zs_mesh *mesh);

/* Choose edges, in their order, as lines to draw.
 *
 * line      [room], memory of the caller; room for all edges always suffices.
 * n         the number of edges.
 * kinds     enum zs_edge_kind, or-ed.
 * crease    the angle, 0 .. ZS_DEGREES(180). Normals are rounded to 2^-15: for edges of exactly 45
 *           degrees give 44.
 * instance  for ZS_EDGE_SILHOUETTE, and with ZS_EDGE_SMOOTH: its pose, scale and the mesh,
 * camera    seen from there; else both may be NULL, and no edge counts as silhouette.
 * Cost      two normals an edge: 3,300 instructions on a Cortex-M3, 560 with zs_mesh.face_normal.
 * Return    the number of lines, at most room: the new primitive.n. */
uint32_t zs_edges_choose(uint16_t (*line)[2], uint32_t room, const struct zs_mesh_edge *edge,
                         uint32_t n, const struct zs_mesh *mesh, uint32_t kinds, zs_turn crease,
                         const struct zs_instance *instance, const struct zs_camera *camera);

/* The face stage of zs_shade_plain: it reads nothing of the mesh. */
uint16_t zs_plain_face(const struct zs_shading *s, uint32_t t);

ZS_C_END

#endif
