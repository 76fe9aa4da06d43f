/* Bytes and the wire.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdlib.h>
#include <string.h>

#include "budget.h"
#include "core/depth.h"
#include "panel.h"
#include "record_sizes.h"
#include "sim.h"
#include "zs_damage.h"

enum budget_cpu budget_cpu_of(enum sim_core core)
{
    return core == SIM_CORE_M0 || core == SIM_CORE_RP2040 ? BUDGET_M0 : BUDGET_M3;
}

int budget_bytes_known(enum sim_core core)
{
    return core != SIM_CORE_RV32;
}

void budget_ram(struct budget_ram *ram, const struct budget_request *rq, const struct zs_config *c,
                uint32_t n_instances)
{
    const uint32_t rows = c->strip_h < c->height ? c->strip_h : c->height;
    const struct sim_method *method = sim_method_of(c); /* NULL: zs_method_transparent, without records of its own */
    memset(ram, 0, sizeof *ram);
    ram->color = ZS_COLOR_BYTES(c->width, rows, c->buffers);
    ram->depth = c->depth->span == NULL ? ZS_DEPTH_BYTES(c->width, rows) : 0u;
    ram->tiles = ZS_DRAWN_BYTES(rows) + ZS_BOUND_BYTES(c->width, c->height, rows);
    ram->bins = ZS_BIN_BYTES(c->height, rows);
    ram->tris = ZS_TRI_BYTES(c->max_tris);
    ram->verts = (uint32_t)sizeof(struct zs_vertex) * c->max_verts;
    ram->attrs = ZS_VERT_BYTES(c->max_verts, c->varyings) - ZS_VERT_BYTES(c->max_verts, 0);
    ram->numbers = ZS_VERT_BYTES(c->max_verts, 0) - ram->verts;
    ram->arena = zs_arena_bytes(c);
    ram->shared = method ? ram->tris - ZS_TRI_BYTES(budget_method_holds(method, c->max_tris)) : 0u;
    ram->renderer = RECORD_zs_renderer;
    ram->scene = RECORD_zs_scene + RECORD_zs_camera + RECORD_zs_config + n_instances * RECORD_zs_instance;
    ram->watch = (uint32_t)(ZS_STRIPS(c->height, rows) * 8u * (uint32_t)rq->watch);
    ram->track = rq->track ? 4u * ZS_DAMAGE_WORDS(rq->track, c->height, rows) : 0u;
    if (rq->o.panel.name != NULL) {
        struct panel_config config;
        struct pm_glass glass;
        ram->panel = RECORD_panel;
        if (sim_panel_config(&rq->o.panel, NULL, &config, &glass) == SIM_OK)
            ram->scratch = panel_scratch_bytes(&config, (uint32_t)c->width * rows);
    }
    ram->fixed = ram->renderer + ram->scene + ram->watch + ram->track + ram->panel + ram->scratch;
    for (int k = 0; k < BUDGET_CPUS; k++) {
        ram->stack[k] = record_stack_render[k];
        ram->total[k] = ram->arena + ram->fixed + ram->stack[k];
    }
}

static void add(struct budget_flash *flash, const struct record_bytes *bytes)
{
    flash->zstrip += bytes->zstrip;
    flash->library += bytes->library;
}

void budget_flash(struct budget_flash *flash, const struct budget_request *rq, const struct budget *b,
                  enum budget_cpu cpu)
{
    const struct zs_depth *depth = b->config.depth;
    const int mapping = depth == &zs_depth_recip ? 1 : depth == &zs_depth_linear ? 2 : 0;
    memset(flash, 0, sizeof *flash);
    const unsigned shades = b->shades & 63u; /* none: shaders of the scene's own alone, counted as raw */
    add(flash, &record_flash[cpu][mapping][shades ? shades : 1u]);
    add(flash, &record_pose[cpu]);
    if (b->texels & 1u)
        add(flash, &record_texel_565[cpu]);
    if (b->texels & 2u)
        add(flash, &record_texel_pal8[cpu]);
    if (b->texels & 4u)
        add(flash, &record_texel_pal4[cpu]);
    if (b->clusters)
        add(flash, &record_clusters[cpu]);
    if (rq->state || b->states)
        add(flash, &record_state[cpu]);
    if (rq->watch)
        add(flash, &record_watch[cpu]);
    if (rq->track)
        add(flash, &record_track[cpu]);
    const size_t length = rq->o.panel.name ? strcspn(rq->o.panel.name, ":") : 0;
    for (size_t i = 0; i < sizeof record_panels / sizeof record_panels[0]; i++)
        if (length && strlen(record_panels[i].name) == length && memcmp(record_panels[i].name, rq->o.panel.name,
                                                                        length) == 0)
            flash->panel = record_panels[i].bytes[cpu];
    flash->data = b->data;
    flash->total = flash->zstrip + flash->library + flash->panel + flash->data;
}

/* ---- Code in RAM -------------------------------------------------------------------------------- */

/* pico.ld copies what draws to RAM: of the renderer all but cameras and checks, the HAL, the panel's driver, libgcc and
 * libc. It is more than the flash on record, which is of -O2: the Pico's is compiled with -O3, and for the RP2040's
 * divider and lanes. Bytes more, the most of 30 programs of one shader, several and all; tests/tools/budget.sh compares
 * images with the sum. */
enum {
    CODE_HAL = 5600,     /* the HAL, veneers, clusters' accelerator; -O3 of what all share */
    CODE_SMOOTH = 3800,  /* where colours are interpolated, ... */
    CODE_TEXTURE = 6500, /* ... and texels: the lanes' own loops */
    CODE_TEXT = 4300,    /* a line of text with its font, as of main.c of zsim new */
    CODE_EFFECTS = 8192, /* of materials with effects, the most */
    HAL_STATICS = 300,   /* its output, flags, SPI */
    STACK_RESERVED = 4096
};

static uint32_t method_code(const struct budget *b)
{
    static const struct {
        const char *name;
        uint32_t bytes;
    } of[] = { { "hiz", 3700 }, { "depthsort", 9700 }, { "coverage", 10100 }, { "raycast", 6800 } };
    for (size_t i = 0; i < sizeof of / sizeof of[0]; i++)
        if (strcmp(b->method->name, of[i].name) == 0)
            return of[i].bytes;
    return 0;
}

void budget_ram_code(struct budget_ram *ram, const struct budget_request *rq, const struct budget *b)
{
    struct budget_flash flash;
    budget_flash(&flash, rq, b, BUDGET_M0);
    ram->code = flash.zstrip + flash.library + flash.panel + CODE_HAL + CODE_TEXT + HAL_STATICS + method_code(b) +
                (b->shades & 4u ? CODE_SMOOTH : 0u) + (b->shades & 56u ? CODE_TEXTURE : 0u) +
                (b->effects ? CODE_EFFECTS : 0u);
    ram->reserved = STACK_RESERVED > ram->stack[BUDGET_M0] ? STACK_RESERVED - ram->stack[BUDGET_M0] : 0u;
}

double budget_ram_on(const struct budget_ram *ram, enum sim_core core)
{
    return ram->total[budget_cpu_of(core)] + (core == SIM_CORE_RP2040 ? (double)ram->code + ram->reserved : 0.0);
}

/* ---- The wire ----------------------------------------------------------------------------------- */

/* A frame of the picture's size through the driver, into the model of the controller, which counts. */
int budget_wire(struct budget_wire *wire, const struct budget_request *rq, const struct zs_config *c)
{
    struct sim_panel_frame panel;
    const size_t n = (size_t)c->width * c->strip_h * 2u;
    uint16_t *px = sim_alloc(n / 2u, sizeof *px);
    int status = sim_panel_begin(&panel, &rq->o.panel, "budget", c->strip_h);
    const struct zs_sink sink = sim_panel_sink(&panel);
    for (uint32_t y = 0; status == SIM_OK && y < c->height; y += c->strip_h) {
        const uint16_t h = (uint16_t)(c->height - y < c->strip_h ? c->height - y : c->strip_h);
        const struct zs_strip strip = { .y = (uint16_t)y, .w = c->width, .h = h, .px = (const uint8_t *)px,
                                        .n_bytes = (uint32_t)c->width * h * 2u, .dirty_w = c->width };
        if (sink.submit(sink.ctx, &strip) || sink.wait(sink.ctx))
            status = sim_panel_check(&panel, &rq->o.panel, "budget");
    }
    if (status == SIM_OK) {
        const struct pm_counts *now = pm_counts(panel.model), *then = &panel.setup;
        wire->bytes = (double)(now->bytes - then->bytes);
        wire->pixel_bytes = (double)(now->pixel_bytes - then->pixel_bytes);
        wire->windows = (double)(now->windows - then->windows);
        wire->ms = 8e3 * wire->bytes / (double)rq->o.spi_hz;
    }
    sim_panel_free(&panel);
    free(px);
    return status;
}

int budget_take(struct budget *b, const struct budget_request *rq)
{
    budget_ram(&b->ram, rq, &b->config, b->n_instances);
    for (int c = 0; c < BUDGET_CPUS; c++)
        budget_flash(&b->flash[c], rq, b, (enum budget_cpu)c);
    budget_ram_code(&b->ram, rq, b);
    b->has_wire = rq->o.panel.name != NULL;
    struct zs_config sent = b->config; /* what the panel gets */
    if (b->samples > 1) {
        sent.width /= 2u;
        sent.height /= 2u;
        sent.strip_h /= 2u;
    }
    return b->has_wire ? budget_wire(&b->wire, rq, &sent) : SIM_OK;
}
