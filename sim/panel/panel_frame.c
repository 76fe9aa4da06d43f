/* Driver, bus, model.
 *
 * SPDX-License-Identifier: MIT
 */
#include "panel_frame.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"

static const struct panel_type *driver_of(const char *name, size_t length)
{
    for (uint32_t i = 0; i < n_panel_types; i++)
        if (strlen(panel_name(panel_types[i])) == length && memcmp(panel_name(panel_types[i]), name, length) == 0)
            return panel_types[i];
    return NULL;
}

int sim_panel_glass(const struct sim_panel_wish *wish, const char *file, struct pm_glass *glass)
{
    if (!pm_glass_named(glass, wish->name))
        return sim_refuse(file, 0, "--panel %s is not known; there are %s", wish->name, pm_glass_list());
    glass->inverted = wish->invert != 0;
    glass->bgr = wish->bgr != 0;
    return SIM_OK;
}

int sim_panel_config(const struct sim_panel_wish *wish, const char *file, struct panel_config *config,
                     struct pm_glass *glass)
{
    const int status = sim_panel_glass(wish, file, glass);
    if (status != SIM_OK)
        return status;
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

static int check_strip(const struct sim_panel_wish *wish, const char *file, const struct panel_config *config,
                       long rows, long height)
{
    const long grain = panel_grain(config).y;
    if (rows >= height || rows % grain == 0)
        return SIM_OK;
    return sim_refuse(file, 0, "--strip %ld: %s takes %ld rows at a time, so give a multiple of that, such as %ld",
                      rows, wish->name, grain, (rows / grain + 1) * grain);
}

long sim_panel_hz(const char *name, long fastest)
{
    static const struct {
        const char *name;
        long hz;
    } of[] = { { "ssd1351:", 20000000 }, { "ili9341:", 10000000 }, { "ssd1306:", 10000000 }, { "ssd0323:", 4000000 } };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        if (strncmp(name, of[i].name, strlen(of[i].name)) == 0)
            return of[i].hz < fastest ? of[i].hz : fastest;
    return fastest;
}

int sim_panel_take(const struct sim_panel_wish *wish, const char *file, int has_size, long size[2], long strip,
                   struct pm_glass *glass)
{
    struct panel_config config;
    if (wish->name == NULL && (wish->has_turns || wish->invert || wish->bgr))
        return sim_usage("%s is for a --panel, which is missing", wish->has_turns ? "--rotate"
                                                                  : wish->invert  ? "--invert"
                                                                                  : "--bgr");
    if (wish->name == NULL)
        return SIM_OK;
    const int status = sim_panel_config(wish, file, &config, glass);
    if (status != SIM_OK)
        return status;
    const int turned = wish->turns & 1;
    const long w = turned ? glass->height : glass->width, h = turned ? glass->width : glass->height;
    if (has_size && (size[0] != w || size[1] != h))
        return sim_refuse(file, 0,
                          "--size %ldx%ld is not the picture of --panel %s --rotate %d, %ldx%ld; leave it out",
                          size[0], size[1], wish->name, 90 * wish->turns, w, h);
    size[0] = w;
    size[1] = h;
    return check_strip(wish, file, &config, strip, h);
}

int sim_panel_begin(struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file, uint32_t rows)
{
    struct panel_config config;
    memset(p, 0, sizeof *p);
    const int status = sim_panel_config(wish, file, &config, &p->glass);
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
    return err == HAL_ERR_NONE ? SIM_OK : sim_refuse(file, 0, "--panel %s: %s", wish->name, panel_strerror(err));
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
    return (struct zs_sink){ .submit = submit, .wait = wait, .ctx = p };
}

int sim_panel_check(const struct sim_panel_frame *p, const struct sim_panel_wish *wish, const char *file)
{
    const struct pm_problem *problem;
    if (p->err != HAL_ERR_NONE)
        return sim_refuse(file, 0, "--panel %s: %s", wish->name, panel_strerror(p->err));
    pm_end(p->model);
    if (pm_problems(p->model, &problem) > 0)
        return sim_refuse(file, 0, "--panel %s: the driver's bytes are wrong: %s", wish->name, problem[0].text);
    return SIM_OK;
}

void sim_panel_picture(struct sim_picture *p, const struct pm_model *model, const struct pm_glass *glass, int turns)
{
    const size_t n = (size_t)glass->width * glass->height;
    uint8_t *rgb = sim_alloc(n, 3);
    uint16_t *raw = sim_alloc(n, sizeof *raw);
    p->width = turns & 1 ? glass->height : glass->width;
    p->height = turns & 1 ? glass->width : glass->height;
    p->rgb = sim_alloc(n, 3);
    p->raw = sim_alloc(n, sizeof *p->raw);
    p->raw_bytes = pm_glass_format(glass) == PM_RGB565 ? 2 : 1;
    pm_picture(model, rgb, raw);
    pm_view(glass, turns, rgb, p->rgb, 3);
    pm_view(glass, turns, raw, p->raw, sizeof *raw);
    free(rgb);
    free(raw);
}
