/* Structures as they lie in memory, then each array that the model points to, in the order of the table. The pointers
 * themselves only say whether an array is there.
 *
 * SPDX-License-Identifier: MIT
 */
#include "model_pack.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "sim.h"

#define COUNT_MAX (UINT32_MAX / 3u)

/* A new field of these that is a pointer needs a row below, or lines in pack_rest and unpack_rest; and what others rely
 * on needs a check. */
#if UINTPTR_MAX > 0xffffffffu
_Static_assert(sizeof(struct sim_model) == 1664, "struct sim_model has changed: so has what model_pack.c carries");
_Static_assert(sizeof(struct sim_material) == 32, "struct sim_material has changed: so has what model_pack.c carries");
_Static_assert(sizeof(struct sim_texture) == 48, "struct sim_texture has changed: so has what model_pack.c carries");
#endif

static const struct array {
    size_t to, size, count; /* the pointer, an element's bytes, and the uint32_t that says how many */
} arrays[] = {
#define ARRAY(field, n)                                                                                               \
    {                                                                                                                 \
        offsetof(struct sim_model, field), sizeof *((struct sim_model *)0)->field, offsetof(struct sim_model, n)      \
    }
    ARRAY(point, n_points),     ARRAY(tri, n_tris),    ARRAY(normal, n_tris),       ARRAY(rgb, n_tris),
    ARRAY(uv, n_tris),          ARRAY(has_uv, n_tris), ARRAY(tri_material, n_tris), ARRAY(material, n_materials),
    ARRAY(texture, n_textures),
};
#define N_ARRAYS (sizeof arrays / sizeof arrays[0])

static void *pointer_of(const struct sim_model *model, const struct array *a)
{
    void *p;
    memcpy(&p, (const char *)model + a->to, sizeof p);
    return p;
}

static uint32_t count_of(const struct sim_model *model, const struct array *a)
{
    uint32_t n;
    memcpy(&n, (const char *)model + a->count, sizeof n);
    return n;
}

/* ---- Out ------------------------------------------------------------------------------------- */

static void put(FILE *f, const void *from, size_t size, size_t n)
{
    (void)fwrite(from, size, n, f);
}

static void put_text(FILE *f, const char *text)
{
    const uint64_t n = text != NULL ? strlen(text) : 0;
    put(f, &n, sizeof n, 1);
    if (n > 0)
        put(f, text, 1, n);
}

void sim_model_pack(FILE *f, const struct sim_model *model)
{
    put(f, model, sizeof *model, 1);
    for (size_t i = 0; i < N_ARRAYS; i++)
        if (pointer_of(model, &arrays[i]) != NULL)
            put(f, pointer_of(model, &arrays[i]), arrays[i].size, count_of(model, &arrays[i]));
    put_text(f, model->lost_materials);
    for (uint32_t i = 0; i < model->n_materials; i++)
        put_text(f, model->material[i].name);
    for (uint32_t i = 0; i < model->n_textures; i++) {
        const struct sim_texture *t = &model->texture[i];
        put_text(f, t->name);
        put(f, t->image.rgb, sizeof *t->image.rgb, (size_t)t->image.width * t->image.height);
        if (t->image.alpha != NULL)
            put(f, t->image.alpha, 1, (size_t)t->image.width * t->image.height);
    }
}

/* ---- In -------------------------------------------------------------------------------------- */

struct block {
    const char *at;
    uint64_t left; /* bytes */
    int ok;
};

static void get(struct block *b, void *to, uint64_t n)
{
    b->ok = b->ok && n <= b->left;
    if (!b->ok || n == 0)
        return;
    memcpy(to, b->at, (size_t)n);
    b->at += n;
    b->left -= n;
}

/* n elements, malloc'ed; NULL where there are fewer. */
static void *get_array(struct block *b, uint64_t n, size_t size)
{
    b->ok = b->ok && n <= b->left / size;
    if (!b->ok)
        return NULL;
    void *to = sim_grow(NULL, (size_t)n, size);
    get(b, to, n * size);
    return to;
}

/* A text, malloc'ed even where the block ends before. */
static char *get_text(struct block *b)
{
    uint64_t n = 0;
    get(b, &n, sizeof n);
    n = b->ok && n <= b->left ? n : 0;
    char *text = sim_alloc((size_t)n + 1, 1);
    get(b, text, n);
    return text;
}

/* Arrays, of structures too, whose own pointers are cleared; but of alpha, whether there is any, which get_rest
 * replaces. */
static void get_arrays(struct block *b, struct sim_model *model, const struct sim_model *head)
{
    for (size_t i = 0; i < N_ARRAYS; i++) {
        void *p = pointer_of(head, &arrays[i]) != NULL ? get_array(b, count_of(head, &arrays[i]), arrays[i].size)
                                                       : NULL;
        memcpy((char *)model + arrays[i].to, &p, sizeof p);
    }
    model->n_materials = model->material != NULL ? model->n_materials : 0;
    model->n_textures = model->texture != NULL ? model->n_textures : 0;
    for (uint32_t i = 0; i < model->n_materials; i++)
        model->material[i].name = NULL;
    for (uint32_t i = 0; i < model->n_textures; i++) {
        model->texture[i].name = NULL;
        model->texture[i].image.rgb = NULL;
        model->texture[i].image.alpha = model->texture[i].image.alpha != NULL ? (uint8_t *)model : NULL;
    }
}

static int is_side(uint32_t n)
{
    return n >= 1 && n <= SIM_TEXTURE_MAX && (n & (n - 1)) == 0;
}

static void get_rest(struct block *b, struct sim_model *model, const struct sim_model *head)
{
    char *lost = get_text(b);
    if (head->lost_materials != NULL)
        model->lost_materials = lost;
    else
        free(lost);
    for (uint32_t i = 0; i < model->n_materials; i++)
        model->material[i].name = get_text(b);
    for (uint32_t i = 0; i < model->n_textures; i++) {
        struct sim_texture *t = &model->texture[i];
        const int has_alpha = t->image.alpha != NULL;
        t->image.alpha = NULL;
        t->name = get_text(b);
        b->ok = b->ok && is_side(t->image.width) && is_side(t->image.height) && t->clamp <= (ZS_CLAMP_U | ZS_CLAMP_V);
        t->image.rgb = get_array(b, (uint64_t)t->image.width * t->image.height, sizeof *t->image.rgb);
        if (has_alpha)
            t->image.alpha = get_array(b, (uint64_t)t->image.width * t->image.height, 1);
    }
    for (int i = 0; i < SIM_LOST_KINDS; i++)
        model->lost[i].first[sizeof model->lost[i].first - 1] = '\0';
}

/* ---- Checks ---------------------------------------------------------------------------------- */

static int within(const double *value, size_t n, double most)
{
    int ok = 1;
    for (size_t i = 0; i < n; i++)
        ok &= fabs(value[i]) <= most;
    return ok;
}

static int faces_are_sound(const struct sim_model *m)
{
    int ok = 1;
    for (uint32_t t = 0; t < m->n_tris; t++) {
        ok &= m->tri_material[t] < m->n_materials;
        for (int k = 0; k < 3; k++)
            ok &= m->tri[t][k] < m->n_points;
        for (int k = 0; m->normal != NULL && k < 9; k++)
            ok &= fabsf(m->normal[t][k / 3][k % 3]) <= 1.001f;
        ok &= m->has_uv == NULL || m->has_uv[t] <= 1;
    }
    return ok && (m->uv == NULL || within(m->uv[0][0], 6 * (size_t)m->n_tris, SIM_UV_MAX));
}

static int is_sound(const struct sim_model *m, const struct sim_want *want)
{
    int ok = m->point != NULL && m->tri != NULL && m->rgb != NULL && m->tri_material != NULL && m->n_materials > 0 &&
             m->n_tris > 0 && m->n_tris <= COUNT_MAX && m->n_points > 0 &&
             (m->normal != NULL) == (want->normals != 0) && (m->uv != NULL) == (want->textures != 0) &&
             (m->has_uv != NULL) == (want->textures != 0);
    ok = ok && within(m->point[0], 3 * (size_t)m->n_points, 1e30) && within(m->lo, 3, 1e30) &&
         within(m->hi, 3, 1e30) && within(m->center, 3, 1e30) && m->radius > 0.0 && m->radius <= 1e31 &&
         faces_are_sound(m);
    for (uint32_t i = 0; ok && i < m->n_materials; i++) {
        const struct sim_material *own = &m->material[i];
        ok = (own->texture == SIM_NO_TEXTURE || own->texture < m->n_textures) && own->alpha_mode <= SIM_ALPHA_BLEND &&
             own->power <= 128;
    }
    for (uint32_t i = 0; ok && i < m->n_textures; i++)
        ok = m->texture[i].alpha_mode <= SIM_ALPHA_BLEND;
    return ok;
}

int sim_model_unpack(struct sim_model *model, const void *block, size_t bytes, const char *file,
                     const struct sim_want *want)
{
    struct block b = { block, bytes, 1 };
    struct sim_model head = { 0 };
    get(&b, &head, sizeof head);
    *model = head;
    model->file = file;
    model->lost_materials = NULL;
    get_arrays(&b, model, &head);
    get_rest(&b, model, &head);
    if (b.ok && b.left == 0 && is_sound(model, want))
        return SIM_OK;
    sim_model_free(model);
    return SIM_REFUSED;
}
