/* Times of a frame, from costs.
 *
 * SPDX-License-Identifier: MIT
 */
#include <math.h>
#include <string.h>

#include "budget.h"

double budget_cpi(const struct budget_request *rq, enum sim_core core)
{
    static const double assumed[SIM_CORES] = {
        [SIM_CORE_M3] = 1.4, [SIM_CORE_M4] = 1.4, [SIM_CORE_M7] = 0.9, [SIM_CORE_RV32] = 1.4
    };
    return core == SIM_CORE_RP2040 || core == SIM_CORE_M0 ? 1.0 : rq->has_cpi ? rq->cpi : assumed[core];
}

double budget_error(const struct budget *b, enum sim_core core)
{
    const double error = b->method->method ? sim_cost_method_error() : sim_cost_error(core);
    return b->counted.has_effects ? fmax(error, sim_effects_error()) : error;
}

int budget_of_all(const struct budget_request *rq)
{
    return rq->o.fast_names == NULL || strcmp(rq->o.fast_names, "all") == 0;
}

int budget_has_time(const struct budget *b)
{
    return !(b->guessed && b->method->method);
}

/* Cortex-M0 and M0+: what was counted on the RP2040, whose core it is. */
double budget_cycles(const struct budget_request *rq, const struct budget *b, enum sim_core core)
{
    if (!budget_has_time(b) || !budget_of_all(rq))
        return (double)NAN;
    return sim_costs_sum(core == SIM_CORE_M0 ? SIM_CORE_RP2040 : core, &b->counted) * budget_cpi(rq, core);
}

double budget_wire_ms(const struct budget_request *rq, const struct budget *b, const struct budget_part *part)
{
    const double asked = (double)rq->o.spi_hz / 1e6;
    const int slower = part && part->spi_mhz > 0.0 && part->spi_mhz < asked && !(rq->part && rq->o.has_spi);
    return !b->has_wire ? 0.0 : slower ? b->wire.ms * asked / part->spi_mhz : b->wire.ms;
}

/* A frame in two buffers, as zs_render sends it: while a strip is drawn, the one before is on the wire, and it follows
 * when that has left. The frame has ended when the last one has. */
static double two_buffers_ms(const struct budget_request *rq, const struct budget *b, enum sim_core core, double mhz,
                             double wire)
{
    const struct sim_counted *c = &b->counted;
    const enum sim_core of = core == SIM_CORE_M0 ? SIM_CORE_RP2040 : core;
    const uint32_t n = c->n_strips ? c->n_strips : ZS_STRIPS(b->config.height, b->config.strip_h);
    const double same = (c->n_strips ? c->effects[of] : sim_costs_sum(of, c)) / n; /* of each */
    double drawn = 0.0, sent = 0.0; /* when */
    for (uint32_t i = 0; i < n; i++) {
        const double cycles = (c->n_strips ? c->strip[of][i] : 0.0) + same;
        drawn = fmax(drawn + cycles * budget_cpi(rq, core) / (mhz * 1e3), sent);
        sent = drawn + wire / n;
    }
    return sent;
}

void budget_totals(struct budget_totals *t, const struct budget_request *rq, const struct budget *b, enum sim_core core,
                   double mhz, double wire)
{
    const enum budget_cpu cpu = budget_cpu_of(core);
    t->ram = budget_ram_on(&b->ram, core) + (double)rq->app_ram;
    t->flash = budget_bytes_known(core) ? b->flash[cpu].total + (double)rq->app_flash : (double)NAN;
    t->draw_ms = mhz > 0.0 ? budget_cycles(rq, b, core) / (mhz * 1e3) : (double)NAN;
    t->fps_single = 1e3 / (t->draw_ms + wire);
    t->fps_double = isnan(t->draw_ms) ? (double)NAN : 1e3 / two_buffers_ms(rq, b, core, mhz, wire);
    t->fps = b->config.buffers == 2 ? t->fps_double : t->fps_single;
    t->frame_ms = 1e3 / t->fps;
}
