/* Parts by name, and what fits them.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "budget.h"
#include "core/depth.h"
#include "panel.h"
#include "record_sizes.h"
#include "sim.h"

#define KB 1024u

/* RAM is what lies together and a program can use; flash of parts without any is what their boards have. Clocks are the
 * largest of the data sheet, but for the RP2040: 125 MHz is what its boards start with. SPI: the fastest clock as a
 * master.
 * Looked up: RP2040 datasheet (1.1; SPI 62.5 Mbit/s); STM32F103x8 DS5319, STM32F103xC DS5792 (2 and 3 SPIs, 18 Mbit/s),
 * STM32F405 DS8626 (3 SPIs, 42 Mbit/s; 112 + 16 KB of SRAM, 64 KB of CCM, RM0090 2.1), STM32F411xE DS10314, STM32F401xC
 * DS9716 (memory and clock, page 1); nRF51 and nRF52832: register FREQUENCY of SPI ends at 8 Mbit/s; nRF52840: SPIM3 at
 * 32; LM3S6965: SSI at half the clock at most (the maker's library); ESP32-C3: 400 KB of SRAM, of which 16 KB are
 * cache, SPI2 at 80 MHz (ESP-IDF, spi_master.h).
 * Taken from these, not looked up again: memory of nRF51822 PS v3.4, nRF52832 PS v1.8, nRF52840 PS v1.7, LM3S6965
 * (1.4); SPI of STM32F401 and F411; STM32F746 DS10916; SAM D21 DS40001882, LPC176x UM10360 (1.3: two banks, the larger
 * one) and GD32VF103 (table 2, CB), whose SPI clocks are not given. */
const struct budget_part budget_parts[] = {
    { "rp2040", SIM_CORE_RP2040, 125, 62.5, 264 * KB, 2048 * KB, "Raspberry Pi Pico, Cortex-M0+ (133 MHz at most)" },
    { "stm32f103c8", SIM_CORE_M3, 72, 18, 20 * KB, 64 * KB, "Cortex-M3, Blue Pill" },
    { "stm32f103rc", SIM_CORE_M3, 72, 18, 48 * KB, 256 * KB, "Cortex-M3" },
    { "stm32f401cc", SIM_CORE_M4, 84, 42, 64 * KB, 256 * KB, "Cortex-M4, Black Pill" },
    { "stm32f405", SIM_CORE_M4, 168, 42, 128 * KB, 1024 * KB, "Cortex-M4; 64 KB more of CCM" },
    { "stm32f411", SIM_CORE_M4, 100, 50, 128 * KB, 512 * KB, "Cortex-M4, Black Pill" },
    { "stm32f746", SIM_CORE_M7, 216, 50, 320 * KB, 1024 * KB, "Cortex-M7" },
    { "nrf51822", SIM_CORE_M0, 16, 8, 16 * KB, 256 * KB, "micro:bit v1, Cortex-M0" },
    { "nrf52832", SIM_CORE_M4, 64, 8, 64 * KB, 512 * KB, "Cortex-M4" },
    { "nrf52840", SIM_CORE_M4, 64, 32, 256 * KB, 1024 * KB, "Cortex-M4" },
    { "samd21", SIM_CORE_M0, 48, 0, 32 * KB, 256 * KB, "SAMD21G18, Cortex-M0+" },
    { "lm3s6965", SIM_CORE_M3, 50, 25, 64 * KB, 256 * KB, "Cortex-M3" },
    { "lpc1768", SIM_CORE_M3, 100, 0, 32 * KB, 512 * KB, "Cortex-M3; 32 KB more in another bank" },
    { "gd32vf103", SIM_CORE_RV32, 108, 0, 32 * KB, 128 * KB, "RV32IMAC" },
    { "esp32-c3", SIM_CORE_RV32, 160, 80, 384 * KB, 4096 * KB, "RV32IMC" },
};
const uint32_t n_budget_parts = sizeof budget_parts / sizeof budget_parts[0];

const char *const budget_usual_parts[BUDGET_USUAL_PARTS] = { "rp2040", "stm32f405", "esp32-c3" };

static int begins(const char *text, const char *with)
{
    return strncasecmp(text, with, strlen(with)) == 0;
}

const struct budget_part *budget_part_named(const char *name)
{
    const struct budget_part *found = NULL;
    uint32_t n = 0;
    for (uint32_t i = 0; i < n_budget_parts; i++)
        if (begins(budget_parts[i].name, name)) {
            if (strlen(budget_parts[i].name) == strlen(name))
                return &budget_parts[i];
            found = &budget_parts[i];
            n++;
        }
    return n == 1 ? found : NULL;
}

/* Those that begin so. */
static const char *list(const char *with)
{
    static char text[512];
    size_t at = 0;
    text[0] = '\0';
    for (uint32_t i = 0; i < n_budget_parts && at < sizeof text - 32u; i++)
        if (begins(budget_parts[i].name, with))
            at += (size_t)snprintf(text + at, sizeof text - at, "%s%s", at ? ", " : "", budget_parts[i].name);
    return text;
}

const char *budget_part_list(void)
{
    return list("");
}

int budget_part_refuse(const char *option, const char *name)
{
    const char *some = *name ? list(name) : "";
    return *some ? sim_refuse(NULL, 0, "%s %s: which of them? There are %s", option, name, some)
                 : sim_refuse(NULL, 0, "%s %s: there is no such part; there are %s", option, name, list(""));
}

/* ---- Fit ---------------------------------------------------------------------------------------- */

/* Bytes that are left of a part with so many rows, triangles and vertices; < 0: it does not fit. */
static double left(const struct budget_request *rq, const struct budget *b, const struct budget_part *part, long rows,
                   long tris, long verts)
{
    struct zs_config c = b->config;
    struct budget_ram ram;
    c.strip_h = (uint16_t)rows;
    c.max_tris = (uint16_t)tris;
    c.max_verts = (uint16_t)verts;
    budget_ram(&ram, rq, &c, b->n_instances);
    budget_ram_code(&ram, rq, b);
    return (double)part->ram - budget_ram_on(&ram, part->core) - (double)rq->app_ram;
}

static long verts_for(const struct budget *b, long tris)
{
    const long n = (tris * b->config.max_verts + b->config.max_tris - 1) / b->config.max_tris;
    return n < 3 ? 3 : n > (long)ZS_POOL_MAX ? (long)ZS_POOL_MAX : n;
}

/* The most triangles, with vertices in proportion; 0: none. */
static long most_tris(const struct budget_request *rq, const struct budget *b, const struct budget_part *part,
                      long rows)
{
    long fits = 0, over = (long)ZS_POOL_MAX + 1;
    while (over - fits > 1) {
        const long mid = (fits + over) / 2;
        if (left(rq, b, part, rows, mid, verts_for(b, mid)) >= 0.0)
            fits = mid;
        else
            over = mid;
    }
    return fits;
}

static long grain_of(const struct budget_request *rq)
{
    struct panel_config config;
    struct pm_glass glass;
    if (rq->o.panel.name == NULL || sim_panel_config(&rq->o.panel, NULL, &config, &glass) != SIM_OK)
        return 1;
    return panel_grain(&config).y;
}

int budget_fit(const struct budget_request *rq, const struct budget *b)
{
    static const long rows[] = { 2, 4, 8, 16, 24, 32, 40, 48, 60, 80, 120, 160, 240 };
    const struct budget_part *part = budget_part_named(rq->fit);
    if (!part)
        return budget_part_refuse("--fit", rq->fit);
    const long grain = grain_of(rq), height = b->config.height, tris = b->config.max_tris, verts = b->config.max_verts;
    long most_rows = 0;
    for (long r = grain; r <= height + grain - 1; r += grain) {
        const long h = r < height ? r : height;
        if (left(rq, b, part, h, tris, verts) >= 0.0)
            most_rows = h;
    }
    const long most = most_tris(rq, b, part, b->config.strip_h);
    if (!most_rows && !most)
        return sim_refuse(NULL, 0,
                          "--fit %s: not even one triangle fits in strips of %ld rows; lower --strip or --buffers",
                              rq->fit,
                          (long)b->config.strip_h);
    if (rq->csv)
        printf("figure,value,unit\nfit_strip,%ld,rows\nfit_tris,%ld,triangles\nfit_verts,%ld,vertices\n", most_rows,
               most,
               most ? verts_for(b, most) : 0L);
    else {
        printf("%s: %u bytes of RAM, %ld of them for the rest of the program\n", part->text, part->ram, rq->app_ram);
        if (!budget_bytes_known(part->core))
            printf("  " BUDGET_UNKNOWN_BYTES ": the Cortex-M3's stack stands in\n");
        if (most_rows)
            printf("  %ld triangles and %ld vertices fit in strips of up to %ld rows; %.0f bytes are left then\n",
                   tris, verts,
                   most_rows, left(rq, b, part, most_rows, tris, verts));
        else
            printf("  %ld triangles and %ld vertices do not fit in strips of any height\n", tris, verts);
        if (most)
            printf("  strips of %u rows leave room for %ld triangles and %ld vertices; %.0f bytes are left then\n",
                   b->config.strip_h, most, verts_for(b, most), left(rq, b, part, b->config.strip_h, most,
                                                                     verts_for(b, most)));
        else
            printf("  strips of %u rows leave no room for triangles\n", b->config.strip_h);
        printf("\n  %6s %10s %9s   vertices in proportion; fewer of either take more passes, never a pixel\n", "rows",
               "triangles",
               "vertices");
        for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
            if (rows[i] <= height && rows[i] % grain == 0) {
                const long n = most_tris(rq, b, part, rows[i]);
                printf("  %6ld %10ld %9ld\n", rows[i], n, n ? verts_for(b, n) : 0L);
            }
    }
    return SIM_OK;
}

/* ---- Methods ------------------------------------------------------------------------------------- */

uint32_t budget_method_holds(const struct sim_method *method, uint32_t pool)
{
    uint32_t n = pool;
    while (n > 0 && method->records && sim_method_pool(method, n) > pool)
        n--;
    return n;
}

/* Pools of a method for a scene of which so many triangles are seen in a strip at once. Bytes; with renderer, scene and
 * stack (Cortex-M0+). */
static double method_takes(const struct budget_request *rq, const struct budget *b, const struct sim_method *m,
                           long tris, struct budget_ram *ram)
{
    struct zs_config c = b->config;
    c.max_tris = sim_method_pool(m, (uint32_t)tris);
    c.max_verts = (uint16_t)verts_for(b, tris);
    sim_method_apply(&c, m);
    budget_ram(ram, rq, &c, b->n_instances);
    return (double)ram->total[BUDGET_M0] + (double)rq->app_ram;
}

int budget_methods(const struct budget_request *rq, const struct budget *b)
{
    const struct zs_config *c = &b->config;
    if (rq->csv)
        puts("method,tris,verts,color,depth,records,arena,ram");
    else
        printf("%ux%u in strips of %u rows, %u buffer%s; %ld bytes of RAM on a Cortex-M0+, stack %u of them\n"
               "  %-11s %9s %9s %8s %8s %8s %8s   more take more walks\n",
               c->width, c->height, c->strip_h, c->buffers, c->buffers == 1 ? "" : "s", rq->ram,
               record_stack_render[BUDGET_M0], "method", "triangles", "vertices", "strips", "keys", "records", "arena");
    for (size_t k = 0; k < SIM_METHODS; k++) {
        const struct sim_method *m = &sim_methods[k];
        struct budget_ram ram = { 0 };
        long fits = 0, over = (long)ZS_POOL_MAX + 1;
        if (m->depth == NULL && c->depth->span != NULL) /* it has depth memory, as --depth says */
            continue;
        while (over - fits > 1) {
            const long mid = (fits + over) / 2;
            if (sim_method_pool(m, (uint32_t)mid) < ZS_POOL_MAX && method_takes(rq, b, m, mid, &ram) <= (double)rq->ram)
                fits = mid;
            else
                over = mid;
        }
        (void)method_takes(rq, b, m, fits ? fits : 1, &ram);
        const long verts = fits ? verts_for(b, fits) : 0L;
        if (rq->csv)
            printf("%s,%ld,%ld,%u,%u,%u,%u,%u\n", m->name, fits, verts, ram.color, ram.depth, ram.shared, ram.arena,
                   ram.total[BUDGET_M0]);
        else
            printf("  %-11s %9ld %9ld %8u %8u %8u %8u%s\n", m->name, fits, verts, ram.color, ram.depth, ram.shared,
                   ram.arena, fits ? "" : "   too small");
    }
    return SIM_OK;
}
