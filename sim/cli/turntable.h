/* A model seen from all around.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_TURNTABLE_H
#define SIM_TURNTABLE_H

#include "model.h"
#include "moving_picture.h"
#include "render_options.h"

#define SIM_TURNTABLE_MAX 360 /* frames */
#define SIM_TURNTABLE_MS 3000 /* once around */

/* View k of n: the eye of the options, or the one that frames the model, turned k/n of a full turn to the right about
 * the upright axis through what it looks at. *out is *o with that view. SIM_OK; SIM_REFUSED, said why. */
int sim_turntable_view(struct sim_options *out, const struct sim_options *o,
                       const struct sim_model *model, uint32_t k, uint32_t n);

/* All n frames. lost: [SIM_LOST_KINDS], what of the model is not in them; may be NULL. sim_turntable_free in any
 * case. */
int sim_turntable_draw(struct sim_moving *m, struct sim_lost *lost, const struct sim_options *o,
                       const struct sim_model *model, uint32_t n);
void sim_turntable_free(struct sim_moving *m);

/* Set eye, at and fov so that the model is whole in every view of a turn, as close as that allows, seen from slightly
 * above; o->up and o->size are given. */
void sim_turntable_frame(struct sim_options *o, const struct sim_model *model);

#endif
