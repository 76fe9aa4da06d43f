/* Times of a frame, from costs or from what was measured.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "budget.h"
#include "record_methods.h"

double budget_cpi(const struct budget_request *rq, enum sim_core core)
{
    static const double assumed[SIM_CORES] = {
        [SIM_CORE_M3] = 1.4, [SIM_CORE_M4] = 1.4, [SIM_CORE_M7] = 0.9, [SIM_CORE_RV32] = 1.4
    };
    return core == SIM_CORE_RP2040 || core == SIM_CORE_M0 ? 1.0 : rq->has_cpi ? rq->cpi : assumed[core];
}

double budget_measured(const struct budget *b, enum sim_core core)
{
    for (size_t i = 0; b->scene && i < sizeof record_methods / sizeof record_methods[0]; i++)
        if (strcmp(record_methods[i].core, sim_core_names[core]) == 0 &&
            strcmp(record_methods[i].method, b->method->name) == 0 && strcmp(record_methods[i].scene, b->scene) == 0)
            return record_methods[i].instructions;
    return 0.0;
}

/* Cortex-M0 and M0+: what was counted on the RP2040, whose core it is. */
double budget_cycles(const struct budget_request *rq, const struct budget *b, enum sim_core core)
{
    if (b->method->method) {
        const double n = budget_measured(b, core == SIM_CORE_M0 ? SIM_CORE_RP2040 : core);
        return n > 0.0 ? n * budget_cpi(rq, core) : (double)NAN;
    }
    return sim_costs_sum(core == SIM_CORE_M0 ? SIM_CORE_RP2040 : core, &b->counted) * budget_cpi(rq, core);
}

double budget_wire_ms(const struct budget_request *rq, const struct budget *b, const struct budget_part *part)
{
    const double asked = (double)rq->o.spi_hz / 1e6;
    const int slower = part && part->spi_mhz > 0.0 && part->spi_mhz < asked && !(rq->part && rq->o.has_spi);
    return !b->has_wire ? 0.0 : slower ? b->wire.ms * asked / part->spi_mhz : b->wire.ms;
}

void budget_totals(struct budget_totals *t, const struct budget_request *rq, const struct budget *b, enum sim_core core,
                   double mhz, double wire)
{
    const enum budget_cpu cpu = budget_cpu_of(core);
    t->ram = b->ram.total[cpu] + (double)rq->app_ram;
    t->flash = b->flash[cpu].total + (double)rq->app_flash;
    t->draw_ms = mhz > 0.0 ? budget_cycles(rq, b, core) / (mhz * 1e3) : (double)NAN;
    t->frame_ms = b->config.buffers == 2 ? fmax(t->draw_ms, wire) : t->draw_ms + wire;
    t->fps = 1e3 / t->frame_ms;
    t->fps_single = 1e3 / (t->draw_ms + wire);
}
