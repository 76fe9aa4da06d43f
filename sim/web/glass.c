/* A panel's glass that is fed with what goes over a wire, as an emulated board sends it.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>

#include "engine.h"
#include "panel_frame.h"
#include "sim.h"

/* Words of a stream: a byte, and these */
#define DATA 0x100u     /* D/C is high */
#define RESET 0x200u    /* RESET went low, no byte */
#define DESELECT 0x800u /* CS went high, no byte */

static struct {
    struct pm_glass glass;
    struct pm_model *model;
    struct sim_picture shown;
} web_glass;

/* A module, powered on. invert: its glass shows negatives until it is told to invert. */
WEB_EXPORT(glass_begin) int web_glass_begin(const char *name, int invert)
{
    const struct sim_panel_wish wish = { .name = name, .invert = invert };
    pm_free(web_glass.model);
    web_glass.model = NULL;
    const int status = sim_panel_glass(&wish, NULL, &web_glass.glass);
    if (status == SIM_OK)
        web_glass.model = pm_new(&web_glass.glass);
    return web_glass.model != NULL ? SIM_OK : SIM_REFUSED;
}

WEB_EXPORT(glass_feed) void web_glass_feed(const uint16_t *word, uint32_t n)
{
    struct pm_model *m = web_glass.model;
    for (uint32_t i = 0; m != NULL && i < n; i++) {
        if (word[i] & RESET)
            pm_reset(m);
        else if (word[i] & DESELECT)
            pm_deselect(m);
        else
            pm_byte(m, (uint8_t)word[i], (word[i] & DATA) != 0);
    }
}

/* What is seen, [height][width][3]; NULL: there is no glass, or its controller did not understand what came, which is
 * said. */
WEB_EXPORT(glass_picture) const uint8_t *web_glass_picture(void)
{
    const struct pm_problem *problem;
    if (web_glass.model == NULL)
        return NULL;
    if (pm_problems(web_glass.model, &problem) > 0) {
        (void)sim_refuse(NULL, 0, "the panel did not understand %s", problem->text);
        return NULL;
    }
    sim_picture_free(&web_glass.shown);
    sim_panel_picture(&web_glass.shown, web_glass.model, &web_glass.glass, 0);
    return web_glass.shown.rgb;
}
