/* The table of `zsim demo`: what the pipeline did, and how far the frames are from the double-precision reference.
 *
 * SPDX-License-Identifier: MIT
 */
#include "demo_table.h"

#include <stdio.h>

#include "sim.h"
#include "texel_numbers.h"
#include "reference_frame.h"

static void add_diff(struct sim_demo_tally *sum, const struct ref_diff *d)
{
    struct ref_diff *s = &sum->diff;
    s->pixels += d->pixels;
    s->ref_drawn += d->ref_drawn;
    s->id_differ += d->id_differ;
    s->missing += d->missing;
    s->extra += d->extra;
    s->channels += d->channels;
    s->channel_off += d->channel_off;
    s->channel_off_one += d->channel_off_one;
    s->z_compared += d->z_compared;
    sum->z_sum += d->z_mean_rel * (double)d->z_compared;
}

int sim_demo_compare(struct sim_demo_tally *sum, const struct demo_frame *f, const struct demo *demo,
                     const struct zs_config *config, const struct sim_frame *frame)
{
    const size_t n = (size_t)config->width * config->height;
    struct ref_image ours = { .rgb565 = frame->rgb565,
                              .key = frame->no_keys ? NULL : frame->key,
                              .id = sim_alloc(n, sizeof(uint32_t)),
                              .texel = sim_alloc(n, sizeof(uint32_t)) }; /* colours are compared where it is the same */
    struct sim_reference_frame truth;
    struct ref_diff diff;
    int err = sim_frame_ids(ours.id, &f->scene, &f->camera, config);
    if (!err)
        err = sim_frame_texels(ours.texel, &f->scene, &f->camera, config);
    if (!err) {
        err = sim_reference_frame_draw(&truth, &f->scene, &f->camera, config);
        if (!err)
            err = ref_compare(&ours, &truth.image, &truth.depth, &truth.camera, config->width, config->height, &diff);
        sim_reference_frame_free(&truth);
    }
    if (!err)
        add_diff(sum, &diff);
    SIM_FREE(ours.id, ours.texel);
    return err ? sim_refuse(demo->name, 0, "the reference could not draw it (%d)", err) : SIM_OK;
}

void sim_demo_table_head(long first)
{
    printf("Triangles and pixels: frame %ld. Error against the double-precision reference: all frames.\n\n", first);
    printf("%-13s %6s %6s | %6s %5s %5s %5s %5s %5s %5s | %7s %7s | %7s %6s %6s | %7s %7s %7s %6s %7s\n",
           "scene", "in", "drawn", "view", "near", "far", "side", "back", "zero", "empty", "tested",
           "written", "arena", "passes", "frames", "wrong", "cover", "depth", "colour", "by one");
}

static double percent(size_t part, size_t whole)
{
    return whole ? 100.0 * (double)part / (double)whole : 0.0;
}

void sim_demo_table_row(const struct demo *demo, const struct sim_demo_tally *t)
{
    const struct zs_stats *s = &t->stats;
    const struct ref_diff *d = &t->diff;
    printf("%-13s %6u %6u | %6u %5u %5u %5u %5u %5u %5u | %7u %7u | %7u %6u %6u |", demo->name,
           s->tris_in, s->tris_drawn, s->tris_frustum, s->tris_near, s->tris_far, s->tris_offscreen,
           s->tris_facing, s->tris_zero, s->tris_empty, s->pixels_tested, s->pixels_written,
           t->arena, t->passes_max, t->frames);
    if (t->not_compared) {
        printf(" %7s %7s %7s %6s %7s\n", "-", "-", "-", "-", "-");
        return;
    }
    printf(" %6.3f%% %6.3f%% %7.1e %6zu %6.2f%%\n", percent(d->id_differ, d->ref_drawn),
           percent(d->missing + d->extra, d->ref_drawn),
           d->z_compared ? t->z_sum / (double)d->z_compared : 0.0, d->channel_off,
           percent(d->channel_off_one, d->channels));
}

void sim_demo_table_foot(void)
{
    puts("\nin, drawn: triangles. Rejected because: view - the instance's sphere is out of view; near, far;\n"
         "side - beside the frame; back - the culled face; zero - no area after snapping; empty - no sample\n"
         "in the box. tested, written: pixels. arena: bytes, all of the renderer's RAM but its own struct.\n"
         "wrong: drawn pixels that show another triangle than the reference does. cover: pixels missing or\n"
         "too many. depth: mean relative error of the distances that 16-bit keys stand for. colour: channel\n"
         "values more than one RGB565 code off, where triangle and texel are the same. by one: those one code\n"
         "off. Scenes with effects are not compared (-).");
}
