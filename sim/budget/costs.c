/* What one of each costs: as on record, or as it was fitted since.
 *
 * SPDX-License-Identifier: MIT
 */
#include "costs.h"

#include <string.h>

#include "stage_costs.h"

const char *const sim_core_names[SIM_CORES] = { "M0", "M3", "M4", "M7", "rv32imc", "RP2040" };

static double replaced[SIM_CORES][SIM_COST_N];
static char is_replaced[SIM_CORES];

void sim_costs_set(enum sim_core core, const double cost[SIM_COST_N])
{
    memcpy(replaced[core], cost, sizeof replaced[core]);
    is_replaced[core] = 1;
}

double sim_cost_of(enum sim_core core, enum sim_cost cost)
{
    const double effect = sim_effect_cost(core, cost);
    if (effect >= 0.0)
        return effect;
    if (is_replaced[core])
        return replaced[core][cost];
    for (size_t i = 0; i < sizeof stage_costs / sizeof stage_costs[0]; i++)
        if (strcmp(stage_costs[i].name, sim_cost_names[cost].name) == 0)
            return stage_costs[i].cost[core];
    return 0.0;
}

double sim_cost_error(enum sim_core core)
{
    return stage_error[core];
}

double sim_cost_method_error(void)
{
    return method_error;
}

double sim_costs_sum(enum sim_core core, const struct sim_counted *counted)
{
    double sum = 0.0;
    for (int k = 0; k < SIM_COST_N; k++)
        if (counted->n[k] != 0.0)
            sum += counted->n[k] * sim_cost_of(core, (enum sim_cost)k);
    return sum + counted->effects[core];
}
