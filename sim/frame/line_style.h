/* A scene as lines or points: wireframe, hidden lines, points.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_LINE_STYLE_H
#define SIM_LINE_STYLE_H

#include "zs_lines.h"

enum sim_style { SIM_STYLE_SOLID, SIM_STYLE_WIRE, SIM_STYLE_HIDDEN_LINE, SIM_STYLE_POINTS };
#define SIM_STYLE_WORDS "solid|wire|hidden-line|points" /* in their order */

/* What of a scene is drawn, and how. */
struct sim_line_wish {
    enum sim_style style;
    struct zs_rgb ink;
    uint8_t width;   /* px, of lines; the side of points */
    uint8_t on, off; /* px of dashes and gaps; 0: none */
    uint32_t kinds;  /* enum zs_edge_kind, or-ed, of wire and hidden-line */
    zs_turn crease;  /* the angle from which on an edge is a crease */
};

/* The kinds of edges that a list names: "all", or border, crease and silhouette with commas between; dashes by
 * "ON,OFF". SIM_OK; SIM_USAGE, said why. */
int sim_edges_take(uint32_t *kinds, const char *list);
int sim_dash_take(uint8_t *on, uint8_t *off, const char *text);

struct sim_styled {
    struct zs_scene scene;
    uint32_t n_lines; /* or points, of all instances */
    struct zs_instance *instance;
    struct zs_material *material; /* of the lines of each instance; then that of all faces */
    struct zs_lines *lines;
    struct zs_points *points;
    uint16_t (**line)[2]; /* of each instance */
    uint32_t n;           /* instances of the scene that it was made of */
};

/* Make a scene of lines or points from one of triangles, which it borrows.
 *
 * camera  the frame's: which edges are silhouettes is seen from there.
 * Return  SIM_OK; SIM_REFUSED, said why. sim_styled_free in either case. */
int sim_styled_make(struct sim_styled *out, const struct zs_scene *scene, const struct zs_camera *camera,
                    const struct sim_line_wish *wish);
void sim_styled_free(struct sim_styled *styled);

#endif
