/* In passes, where it has some.
 *
 * SPDX-License-Identifier: MIT
 */
#include "demo_frame.h"

#include <string.h>

static const struct demo *own;
static const char *own_name;

void sim_demo_own(const struct demo *demo, const char *name)
{
    own = demo;
    own_name = name;
}

int sim_demo_is_own(const struct demo *demo)
{
    return demo == own;
}

uint32_t sim_demo_count(void)
{
    return n_demos + n_pieces + (own != NULL);
}

const struct demo *sim_demo_at(uint32_t i)
{
    return i < n_demos ? demos[i] : i < n_demos + n_pieces ? &pieces[i - n_demos]->demo : own;
}

const char *sim_demo_name(const struct demo *demo)
{
    return demo == own ? own_name : demo->name;
}

const struct demo *sim_demo_named(const char *name)
{
    for (uint32_t i = 0; i < sim_demo_count(); i++)
        if (strcmp(sim_demo_name(sim_demo_at(i)), name) == 0)
            return sim_demo_at(i);
    return NULL;
}

const struct piece *sim_demo_piece(const struct demo *demo)
{
    for (uint32_t i = 0; i < n_pieces; i++)
        if (demo == &pieces[i]->demo)
            return pieces[i];
    return NULL;
}

void sim_demo_method(struct zs_config *config, const struct demo *demo, int method)
{
    const struct piece *piece = sim_demo_piece(demo);
    sim_method_apply(config, &sim_methods[method]);
    if (piece != NULL && piece->method != NULL)
        config->method = piece->method;
}

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

int sim_demo_render(struct sim_frame *frame, const struct demo *demo, const struct demo_frame *f,
                    const struct zs_config *config, const char *what, const struct zs_sink *to)
{
    struct posed posed = { sim_demo_piece(demo), f };
    const struct sim_drawing drawing = { draw, &posed, config->width, config->height, 0 };
    if (posed.piece == NULL)
        return sim_frame_render_to(frame, &f->scene, &f->camera, config, what, to);
    return sim_frame_render_by(frame, &drawing, config, what, to);
}
