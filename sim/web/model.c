/* A model that the page read.
 *
 * SPDX-License-Identifier: MIT
 */
#include "engine.h"

int web_model_draw(struct sim_rendered *out, const struct sim_model *model, const struct sim_options *o)
{
    return sim_render_all(out, model, o);
}
