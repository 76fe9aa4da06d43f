/* Driver, bus, model.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel_frame.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"

const char *sim_panel_list(int indent)
{
    static char lines[1024];
    const char *at = pm_glass_list();
    size_t n = 0, column = (size_t)indent;
    while (*at != '\0' && n + 64 + (size_t)indent < sizeof lines) {
        const size_t length = strcspn(at, " ") + (strchr(at, ' ') != NULL);
        if (n > 0 && column + length > 100) {
            n += (size_t)sprintf(lines + n - 1, "\n%*s", indent, "") - 1; /* over the blank */
            column = (size_t)indent;
        }
        memcpy(lines + n, at, length);
        n += length;
        column += length;
        at += length;
    }
    lines[n] = '\0';
    return lines;
}

static const struct panel_type *driver_of(const char *name, size_t length)
{
    for (uint32_t i = 0; i < n_panel_types; i++)
        if (strlen(panel_name(panel_types[i])) == length && memcmp(panel_name(panel_types[i]), name, length) == 0)
            return panel_types[i];
    return NULL;
}

int sim_panel_of(const struct sim_panel_wish *wish, const char *file, struct panel_config *config,
                 struct pm_glass *glass)
{
    if (!pm_glass_named(glass, wish->name))
        return sim_refuse(file, 0, "--panel %s is not known; there are %s", wish->name, pm_glass_list());
    glass->inverted = wish->invert != 0;
    glass->bgr = wish->bgr != 0;
    memset(config, 0, sizeof *config);
    config->type = driver_of(wish->name, strcspn(wish->name, ":"));
    config->width = glass->width;
    config->height = glass->height;
    config->rotate = (uint8_t)wish->turns;
    config->invert = glass->inverted;
    config->bgr = glass->bgr;
    if (config->type == NULL)
        return sim_refuse(file, 0, "--panel %s has a model and no driver", wish->name);
    return SIM_OK;
}

int sim_panel_check_strip(const struct sim_panel_wish *wish, const char *file, long rows, long height)
{
    struct panel_config config;
    struct pm_glass glass;
    const int status = sim_panel_of(wish, file, &config, &glass);
    if (status != SIM_OK || rows >= height)
        return status;
    const long grain = panel_grain(&config).y;
    if (rows % grain == 0)
        return SIM_OK;
    return sim_refuse(file, 0, "--strip %ld: %s takes %ld rows at a time, so give a multiple of that, such as %ld",
                      rows, wish->name, grain, (rows / grain + 1) * grain);
}

int sim_panel_begin(struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file, uint32_t rows)
{
    struct panel_config config;
    memset(p, 0, sizeof *p);
    const int status = sim_panel_of(wish, file, &config, &p->glass);
    if (status != SIM_OK)
        return status;
    p->model = pm_new(&p->glass);
    if (p->model == NULL)
        return sim_refuse(file, 0, "out of memory for the panel's RAM");
    sim_panel_bus_init(&p->bus, p->model);
    const uint32_t n_px = rows * (config.rotate & 1 ? config.height : config.width);
    const uint32_t n = panel_scratch_bytes(&config, n_px);
    p->scratch = n > 0 ? sim_alloc(n, 1) : NULL;
    const int err = panel_init(&p->panel, &config, &p->bus.bus, p->scratch, n);
    p->setup = *pm_counts(p->model);
    return err == HAL_OK ? SIM_OK : sim_refuse(file, 0, "--panel %s: %s", wish->name, panel_strerror(err));
}

void sim_panel_free(struct sim_panel_frame *p)
{
    pm_free(p->model);
    free(p->scratch);
    memset(p, 0, sizeof *p);
}

static int submit(void *ctx, const struct zs_strip *strip)
{
    struct sim_panel_frame *p = ctx;
    const struct panel_rect rect = { strip->x, strip->y, strip->w, strip->h };
    return p->err = panel_send(&p->panel, &rect, strip->px, 0);
}

static int wait(void *ctx)
{
    struct sim_panel_frame *p = ctx;
    return p->err = panel_wait(&p->panel);
}

struct zs_sink sim_panel_sink(struct sim_panel_frame *p)
{
    return (struct zs_sink){ submit, wait, p };
}

int sim_panel_check(const struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file)
{
    const struct pm_problem *problem;
    if (p->err != HAL_OK)
        return sim_refuse(file, 0, "--panel %s: %s", wish->name, panel_strerror(p->err));
    pm_end(p->model);
    if (pm_problems(p->model, &problem) > 0)
        return sim_refuse(file, 0, "--panel %s: the driver's bytes are wrong: %s", wish->name, problem[0].text);
    return SIM_OK;
}

uint8_t *sim_panel_picture(const struct sim_panel_frame *p)
{
    const size_t n = (size_t)p->glass.width * p->glass.height;
    uint8_t *glass = sim_alloc(n, 3), *seen = sim_alloc(n, 3);
    pm_picture(p->model, glass, NULL);
    pm_view(&p->glass, p->panel.config.rotate, glass, seen, 3);
    free(glass);
    return seen;
}
