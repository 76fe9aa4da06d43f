/* A filter in a textured shader of any kind: after that shader's start, the texture's copy gets a
 * format that filters; runs are that shader's. The filtered shader is a copy of it; while its
 * stages are called, it is the job's.
 *
 * SPDX-License-Identifier: MIT
 */
#include "effect/filter.h"

static void start(struct zs_job *job)
{
    const struct zs_filtered *const f = zs_filtered_of(job);
    job->shader = f->of;
    f->of->start(job);
    job->shader = &f->shader;
    f->kind->instead(job);
}

void zs_filtered_run(struct zs_job *job, const struct zs_row *row, int32_t from, int32_t to)
{
    const struct zs_filtered *const f = zs_filtered_of(job);
    job->shader = f->of;
    f->of->run(job, row, from, to);
    job->shader = &f->shader;
}

/* A layer (zs_blend.h) of a filtered shader has that one's check, and it as its `of`. */
static const struct zs_filtered *behind(const struct zs_instance *in)
{
    const struct zs_shader *shader = in->material->shader;
    while (shader->start != start)
        shader = ((const struct zs_filtered *)(const void *)shader)->of;
    return (const struct zs_filtered *)(const void *)shader;
}

static int check(const struct zs_instance *in, const struct zs_config *config)
{
    const struct zs_filtered *const f = behind(in);
    const int err = f->of->check(in, config);
    return err || !f->kind->check ? err : f->kind->check(in->material->texture);
}

int zs_filtered_set(struct zs_filtered *filtered, const struct zs_shader *of,
                    const struct zs_filter_kind *kind)
{
    if (!filtered || !of || !of->run || !kind)
        return ZS_ERR_NULL;
    if (of->span || of->opaque != ZS_TEXTURED)
        return ZS_ERR_RANGE;
    filtered->shader = *of;
    filtered->shader.opaque = 1; /* it is filtered once */
    filtered->shader.start = start;
    filtered->shader.run = kind->run;
    filtered->shader.check = check;
    filtered->of = of;
    filtered->kind = kind;
    return ZS_OK;
}
