/* What effects take: instructions of a pixel and of a vertex, as make effects-record measured them, and RAM by pool.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <string.h>

#include "budget.h"
#include "record_effects.h"
#include "sim.h"
#include "zs_fog.h"
#include "zs_overlay.h"

#define MAP_SIDE 64u /* of the shadow map that is reckoned with */

/* Of one pixel or vertex; < 0: not measured on this core. */
static double one(const char *core, const char *name)
{
    for (size_t i = 0; i < sizeof record_effects / sizeof record_effects[0]; i++)
        if (strcmp(record_effects[i].core, core) == 0 && strcmp(record_effects[i].name, name) == 0)
            return record_effects[i].hundred / 100.0;
    return -1.0;
}

/* Bytes of the arena with four samples a pixel (zs_supersample.h: a frame of twice the size each way). */
static uint32_t samples_arena(const struct zs_config *from)
{
    struct zs_config c = *from;
    c.width = (uint16_t)(2u * c.width);
    c.height = (uint16_t)(2u * c.height);
    c.strip_h = (uint16_t)(2u * c.strip_h);
    return zs_arena_bytes(&c);
}

static void print_bytes(const struct budget_request *rq, const struct zs_config *c)
{
    const struct {
        const char *name;
        uint32_t bytes;
    } ram[] = { { "four samples a pixel", samples_arena(c) - zs_arena_bytes(c) },
                { "shadow map, 64x64", 2u * MAP_SIDE * MAP_SIDE },
                { "flat shadow", 6u * c->max_verts },
                { "fog", (uint32_t)sizeof(struct zs_fog) },
                { "overlay, an item", (uint32_t)sizeof(uint32_t) * ZS_OVERLAY_WORDS(1) },
                { "varying of a vertex", (uint32_t)(ZS_VERT_BYTES(c->max_verts, 1) - ZS_VERT_BYTES(c->max_verts, 0)) },
                { "lights, blending, filters, dither", 0 } };
    if (!rq->csv)
        printf("\nRAM, bytes more\n");
    for (size_t i = 0; i < sizeof ram / sizeof ram[0]; i++)
        printf(rq->csv ? "ram,%s,%u,,\n" : "  %-34s %9u\n", ram[i].name, ram[i].bytes);
}

int budget_effects(const struct budget_request *rq, const struct budget *b)
{
    const struct zs_config *c = &b->config;
    const double pixels = (double)c->width * c->height;
    if (rq->csv)
        puts("kind,name,M0,M3,RP2040");
    else
        printf(
            "Instructions a pixel, depth-tested, without accelerators, and a vertex with its share of two triangles,\n"
            "more than zs_shade_raw's; cycles on the RP2040; a screen of %ux%u of it\n"
            "  %-34s %9s %9s %9s %12s\n",
            c->width, c->height, "", "M0", "M3", "RP2040", "RP2040, M");
    for (size_t i = 0; i < sizeof record_effects / sizeof record_effects[0]; i++) {
        const char *const name = record_effects[i].name;
        const double m0 = one("M0", name), rp2040 = one("RP2040", name), m3 = one("M3", name);
        if (strcmp(record_effects[i].core, "M3") != 0)
            continue;
        const int vertex = strncmp(name, "a vertex", 8) == 0;
        if (rq->csv)
            printf("%s,\"%s\",%.2f,%.2f,%.2f\n", vertex ? "vertex" : "pixel", name, m0, m3, rp2040);
        else
            printf(vertex ? "  %-34s %9.0f %9.0f %9.0f\n" : "  %-34s %9.1f %9.1f %9.1f %12.2f\n", name, m0, m3, rp2040,
                   rp2040 * pixels / 1e6);
    }
    if (!rq->csv)
        printf("  Measured on a card in runs of 80 and 160 px; what begins a run is in it. Short runs take more.\n");
    print_bytes(rq, c);
    return SIM_OK;
}
