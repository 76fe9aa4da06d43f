/* What a frame in RAM would take: what strips do without.
 *
 * SPDX-License-Identifier: MIT
 */
#include <stdio.h>

#include "budget.h"
#include "sim.h"

struct whole {
    double width, height, color_bits, depth_bits, samples, fragments, accesses, access_bits;
};

static void print(const struct whole *w, int csv)
{
    const double px = w->width * w->height;
    const double color = px * w->samples * w->color_bits / 8.0, depth = px * w->samples * w->depth_bits / 8.0;
    const double traffic = px * w->fragments * w->accesses * w->access_bits / 8.0;
    if (csv) {
        printf("figure,value,unit\nbuffer_color,%.0f,bytes\nbuffer_depth,%.0f,bytes\nbuffer,%.0f,bytes\n", color, depth,
               color + depth);
        if (w->accesses > 0.0)
            printf("traffic,%.0f,bytes\n", traffic);
        return;
    }
    if (w->color_bits + w->depth_bits > 0.0)
        printf("%.0fx%.0f, %.0f bits of colour and %.0f of depth, %.0f sample%s a pixel: "
               "%.0f + %.0f = %.0f bytes, %.1f MB\n",
               w->width, w->height, w->color_bits, w->depth_bits, w->samples, w->samples > 1.0 ? "s" : "", color, depth,
               color + depth, (color + depth) / 1e6);
    if (w->accesses > 0.0)
        printf("%.0fx%.0f, depth complexity %g, %.0f accesses of %.0f bits a fragment: %.0f bytes a frame, %.1f MB\n",
               w->width,
               w->height, w->fragments, w->accesses, w->access_bits, traffic, traffic / 1e6);
}

int budget_textbook(const struct budget_request *rq)
{
    static const struct whole classic[] = {
        { 1920, 1080, 64, 32, 1, 0, 0, 0 },
        { 1920, 1080, 64, 32, 4, 0, 0, 0 },
        { 1280, 1024, 0, 0, 1, 4, 5, 32 },
    };
    if (rq->has_buffer) {
        const struct whole w = { (double)rq->buffer[0], (double)rq->buffer[1], (double)rq->color_bits,
            (double)rq->bits_of_depth,
                                 (double)rq->samples, rq->fragments, (double)rq->accesses, (double)rq->access_bits };
        print(&w, rq->csv);
        return SIM_OK;
    }
    for (size_t i = 0; i < sizeof classic / sizeof classic[0]; i++)
        print(&classic[i], 0);
    return SIM_OK;
}
