/* In passes, where it has some.
 *
 * SPDX-License-Identifier: MIT
 */
#include "piece_frame.h"

struct posed {
    const struct piece *piece;
    const struct demo_frame *f;
};

static int draw(void *ctx, struct zs_renderer *r, const struct zs_sink *sink)
{
    static struct zs_pass_memory memory[PIECE_PASSES_MAX];
    const struct posed *p = ctx;
    return piece_render(r, p->piece, &p->f->scene, &p->f->camera, memory, sink);
}

int sim_piece_render(struct sim_frame *frame, const struct piece *piece, const struct demo_frame *f,
                     const struct zs_config *config, const char *what, const struct zs_sink *to)
{
    struct posed posed = { piece, f };
    const struct sim_drawing drawing = { draw, &posed, config->width, config->height, 0 };
    return sim_frame_render_by(frame, &drawing, config, what, to);
}
