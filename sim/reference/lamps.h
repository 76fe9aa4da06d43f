/*
 * lamps.h - the light of several lamps on a surface, in double precision: what ref_render asks where a ref_light has
 * lamps. It shares no code with firmware/.
 */
#ifndef SIM_REFERENCE_LAMPS_H
#define SIM_REFERENCE_LAMPS_H

#include "reference.h"

/*
 * Light at a point p with normal n (any length; 0: no lamp lights it), towards whom `camera` looks from.
 * diffuse: ambient + sum of lamp * max(0, n . l), times which a surface's colour is seen; more: what comes on top,
 * specular * sum of lamp * max(0, n . h)^power where n . l > 0, and the emission. h lies half-way between l and the
 * viewer, who is far away along the view axis. Not clamped.
 * side: a normal that says which side of a two-sided surface is the front, n or the face's.
 */
void ref_lamps_at(const struct ref_light *light, const struct ref_triangle *t, const struct ref_camera *camera,
                  const double p[3], const double n[3], const double side[3], double diffuse[3],
                  double more[3]);

/* How much of a colour the fog takes at a distance z, 0..1. */
double ref_fog_at(const struct ref_fog *fog, double z);

#endif
