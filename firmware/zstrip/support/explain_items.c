/* What is wrong with the items of an overlay: one that is not drawn among others that are.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "support/explain.h"
#include "zs_overlay.h"

/* Degrees that were typed for turns. */
static int typed(zs_turn sweep)
{
    static const uint16_t usual[] = { 45, 60, 90, 120, 180, 240, 270, 300, 360 };
    for (uint32_t k = 0; k < sizeof usual / sizeof usual[0]; k++)
        if (sweep == usual[k])
            return 1;
    return 0;
}

static void say_item(struct zs_explainer *e, uint32_t hook, uint32_t n, const struct zs_item *item)
{
    const struct zs_config *const c = &e->r->config;
    const int err = item->kind->check ? item->kind->check(item) : ZS_OK;
    int32_t box[4];
    if (err) {
        ZS_PIECE(e, "item % of resolve hook % is not drawn: ", n, hook);
        ZS_PIECE(e, zs_error_string(err));
        ZS_SAY(e, ".");
        return;
    }
    item->kind->bounds(item, box);
    if (box[0] < box[2] && box[1] < box[3] &&
        (box[0] >= c->width || box[1] >= c->height || box[2] <= 0 || box[3] <= 0))
        ZS_SAY(e,
               "item % of resolve hook % lies beside the picture, which is % x %: its left top "
               "corner is at % %; kind NULL draws none.",
               n, hook, c->width, c->height, box[0], box[1]);
    if (typed(item->sweep))
        ZS_SAY(e,
               "item % of resolve hook % sweeps over %/65536 of a turn: was ZS_DEGREES(%) meant?",
               n, hook, item->sweep, item->sweep);
}

void zs_explain_items(struct zs_explainer *e, uint32_t k)
{
    const struct zs_resolve *const hook = &e->scene->resolve[k];
    const struct zs_overlay *const overlay = hook->ctx;
    for (uint32_t i = 0; overlay->item && i < overlay->n; i++)
        if (overlay->item[i].kind)
            say_item(e, k, i, &overlay->item[i]);
    if (e->tracked && !hook->changes)
        ZS_SAY(e,
               "resolve hook % has no `changes`, and zs_damage_track is on: what it draws anew is "
               "not seen; zs_overlay_changes tells.",
               k);
}
