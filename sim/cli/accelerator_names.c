/* Accelerators by name.
 *
 * SPDX-License-Identifier: MIT
 */
#include "accelerator_names.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "accelerator_table.h"
#include "sim.h"

#define ALL sizeof((const struct zs_fast *const[]){ ZS_FAST_ALL, ZS_FAST_END })
static_assert(ALL == (KNOWN + 1) * sizeof(struct zs_fast *) && KNOWN <= SIM_FAST_MAX, "all that ZS_FAST_ALL names");

/* The number of a name; KNOWN: there is none such, said so. */
static size_t find(const char *name, size_t length)
{
    size_t k = 0;
    while (k < KNOWN && (strlen(known[k].name) != length || memcmp(known[k].name, name, length) != 0))
        k++;
    if (k == KNOWN)
        (void)sim_usage("--fast: there is no accelerator '%.*s'; there are all, none, %s", (int)length, name,
                        sim_fast_list());
    return k;
}

static void fill(struct sim_fast *fast, const char wanted[KNOWN])
{
    size_t n = 0;
    for (size_t k = 0; k < KNOWN; k++)
        if (wanted[k])
            fast->list[n++] = known[k].fast;
    fast->list[n] = NULL;
}

/* Names, each but the first behind `between`, are wanted, or not. */
static int take_names(char wanted[KNOWN], const char *text, char between, char want)
{
    for (;;) {
        const char *end = strchr(text, between);
        const size_t length = end != NULL ? (size_t)(end - text) : strlen(text), k = find(text, length);
        if (k == KNOWN)
            return SIM_USAGE;
        wanted[k] = want;
        if (end == NULL)
            return SIM_OK;
        text = end + 1;
    }
}

int sim_fast_take(struct sim_fast *fast, const char *text)
{
    char wanted[KNOWN];
    int status = SIM_OK;
    const int some = text != NULL && strcmp(text, "all") != 0;
    const int without = some && strncmp(text, "all-", 4) == 0;
    memset(wanted, !some || without, sizeof wanted);
    if (without)
        status = take_names(wanted, text + 4, '-', 0);
    else if (some && strcmp(text, "none") != 0)
        status = take_names(wanted, text, ',', 1);
    fill(fast, wanted);
    return status;
}

void sim_fast_without(struct sim_fast *fast, const struct zs_fast *const *list, const struct zs_fast *gone)
{
    size_t n = 0;
    for (; list != NULL && *list != NULL && n < SIM_FAST_MAX; list++)
        if (*list != gone)
            fast->list[n++] = *list;
    fast->list[n] = NULL;
}

const char *sim_fast_list(void)
{
    static char names[512];
    size_t n = 0;
    for (size_t k = 0; k < KNOWN && n + 64 < sizeof names; k++)
        n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", k == 0 ? "" : ", ", known[k].name);
    return names;
}
