/* What becomes of an instance: where it is, what its triangles come to, and what is wrong with its
 * numbers.
 *
 * SPDX-License-Identifier: MIT
 */
#include "core/cold.h"
#include "core/fx.h"
#include "core/method.h"
#include "core/primitive.h"
#include "core/usual.h"
#include "support/explain.h"
#include "zs_shader.h"

#define TYPED 4096u /* a scale below this may have been typed as a whole number */
#define SMALL_PX 4u /* an instance of fewer pixels across shows nothing of its mesh */
#define FEW_PX 16u  /* the same of most of its triangles */
#define EARLIER 16u /* instances before one in which its mesh or texture is looked for */

/* ---- Places ---------------------------------------------------------------------------------- */

uint64_t zs_explain_size(const struct zs_explainer *e, const struct zs_bounds *b)
{
    const struct zs_camera *const c = &e->r->camera;
    const uint64_t across = 2u * (uint64_t)b->r; /* <= 2^47 */
    int64_t z = b->c[2] > c->z_near ? b->c[2] : c->z_near;
    if (c->projection == ZS_ORTHOGRAPHIC)
        return zs_muldiv_u64(across, (uint64_t)e->r->config.height << 16, (uint64_t)c->height);
    z = z > b->r / 1024 ? z : b->r / 1024 + 1;                 /* across / z <= 2^12 */
    return zs_muldiv_u64(across, c->focal >> 16, (uint64_t)z); /* <= 2^12 * 2^39 */
}

int zs_explain_eye_inside(const struct zs_bounds *b)
{
    int64_t most = b->r; /* < 2^48 */
    int shift = 0;
    for (int k = 0; k < 3; k++)
        most |= zs_size64(b->c[k]);
    while (most >> shift >> 30)
        shift++;
    int64_t square = 0; /* < 3 * 2^60 */
    for (int k = 0; k < 3; k++)
        square += (b->c[k] >> shift) * (b->c[k] >> shift);
    return square < (b->r >> shift) * (b->r >> shift);
}

/* An instance whose sphere is out of view. */
static void say_out(struct zs_explainer *e, uint32_t i, const struct zs_bounds *b)
{
    const struct zs_camera *const c = &e->r->camera;
    const int64_t begins = b->c[2] - b->r, ends = b->c[2] + b->r;
    if (begins > c->z_far)
        ZS_SAY(e, "instance % is out of view: it begins $ beyond far = $; move it, or raise far.",
               i, begins - c->z_far, c->z_far);
    else if (ends < 0 && c->z_near > ends)
        ZS_SAY(e,
               "instance % is behind the camera: it ends $ behind the eye; turn the camera "
               "(zs_camera_look_at), or move it.",
               i, -ends);
    else if (ends < c->z_near)
        ZS_SAY(e,
               "instance % is out of view: it ends $ before near = $; move it away, or lower "
               "near.",
               i, c->z_near - ends, c->z_near);
    else {
        ZS_PIECE(e, "instance % is beside the picture: its centre is $ ahead of the eye, $", i,
                 b->c[2], zs_size64(b->c[0]));
        ZS_PIECE(e, b->c[0] < 0 ? " to the left, $" : " to the right, $", zs_size64(b->c[1]));
        ZS_SAY(e, b->c[1] < 0 ? " up; zs_camera_look_at looks at it."
                              : " down; zs_camera_look_at looks at it.");
    }
}

/* An instance in view of which no triangle is drawn: the most frequent reason. */
static void say_rejected(struct zs_explainer *e, uint32_t i, const struct zs_bounds *b,
                         const struct zs_stats *s)
{
    const struct zs_camera *const c = &e->r->camera;
    const uint32_t small = s->tris_empty + s->tris_zero;
    const uint32_t n = s->tris_in, beside = s->tris_offscreen + s->tris_frustum;
    if (zs_explain_eye_inside(b) && s->tris_facing >= n / 4u)
        ZS_SAY(e,
               "the camera is inside instance %, whose radius is $: move it out, lower its "
               "scale, or draw its inner side (ZS_CULL_NONE).",
               i, b->r);
    else if (s->tris_index >= n - n / 2u)
        ZS_SAY(e, "instance %: % of % triangles name a vertex that is not there; n_verts is %.", i,
               s->tris_index, n, e->scene->instance[i].mesh->n_verts);
    else if (s->tris_facing == n)
        ZS_SAY(e,
               "instance %: % of % triangles face away: the winding is wrong, or material.cull, or "
               "they are seen from behind (ZS_CULL_NONE).",
               i, n, n);
    else if (small >= n - n / 2u || small + s->tris_facing == n)
        ZS_SAY(e,
               zs_explain_size(e, b) < FEW_PX << 16
                   ? "instance %: % of % triangles are smaller than a pixel: it is $ px across; "
                     "raise its scale, or move it nearer."
                   : "instance %: % of % triangles are too thin for a pixel, or have no area: it "
                     "is $ px across.",
               i, small, n, (int64_t)zs_explain_size(e, b));
    else if (s->tris_near > s->tris_far && s->tris_near > beside)
        ZS_SAY(e, "instance %: % of % triangles lie before near = $: move it away, or lower near.",
               i, s->tris_near, n, c->z_near);
    else if (s->tris_far > beside)
        ZS_SAY(e, "instance %: % of % triangles lie beyond far = $: move it, or raise far.", i,
               s->tris_far, n, c->z_far);
    else if (beside >= s->tris_facing)
        ZS_SAY(e,
               "instance %: % of % triangles lie beside the picture, % face away: "
               "zs_camera_look_at looks at it.",
               i, beside, n, s->tris_facing);
    else
        ZS_SAY(e, "instance %: % of % triangles face away, % lie beside the picture.", i,
               s->tris_facing, n, beside);
}

/* A scale that was given as a whole number. Return 1 if it was said. */
static int say_scale(struct zs_explainer *e, uint32_t i)
{
    const struct zs_instance *const in = &e->scene->instance[i];
    const int pose = in->pose.scale && in->pose.scale < TYPED;
    const uint32_t typed = pose ? in->pose.scale : in->mesh->scale;
    struct zs_bounds b;
    zs_explain_bounds(e, i, &b);
    if (!typed || typed >= TYPED || (b.r >= 65536 && typed >= 16u) ||
        zs_explain_size(e, &b) >= SMALL_PX << 16)
        return 0;
    ZS_PIECE(e, "instance %: ", i);
    ZS_SAY(e,
           pose ? "pose.scale is %/65536: was % * ZS_Q16_ONE meant?"
                : "mesh.scale is %/65536: was % * ZS_Q16_ONE meant?",
           typed, typed);
    return 1;
}

int zs_explain_unseen(struct zs_explainer *e, uint32_t i, struct zs_seen *seen)
{
    const struct zs_instance *const in = &e->scene->instance[i];
    const struct zs_seen none = { .uniform = 0 };
    struct zs_bounds b;
    *seen = none;
    zs_explain_bounds(e, i, &b);
    if (zs_primitives_of(in) == 0) {
        ZS_SAY(e,
               in->material->primitive
                   ? "instance % has nothing to draw: the n of its lines or points is 0."
                   : "instance % has nothing to draw: mesh.n_tris is 0.",
               i);
        return 1;
    }
    if (zs_cull_sphere(&b, &e->r->camera, &e->r->view)) {
        say_out(e, i, &b);
        return 1;
    }
    if (say_scale(e, i))
        return 1;
    zs_explain_draw(e, in, 0, seen);
    if (seen->stats.tris_drawn == 0)
        say_rejected(e, i, &b, &seen->stats);
    else if (seen->colored == 0 && zs_explain_size(e, &b) < SMALL_PX << 16)
        ZS_SAY(e, "instance % is $ px across and $ ahead: raise its scale, or move it nearer.", i,
               (int64_t)zs_explain_size(e, &b), b.c[2]);
    else if (seen->colored == 0)
        ZS_SAY(e,
               "instance %: % triangles are drawn and colour no pixel: alpha is 0, texels are "
               "transparent, or the shader leaves pixels out.",
               i, seen->stats.tris_drawn);
    else if (seen->visible == 0)
        ZS_SAY(e,
               "instance % has the background's colour on all of its % pixels: change one of "
               "the two.",
               i, seen->colored);
    else
        return 0;
    return 1;
}

int zs_explain_fate(struct zs_explainer *e, uint32_t i, struct zs_seen *seen)
{
    const int unseen = zs_explain_unseen(e, i, seen);
    if (!unseen)
        ZS_SAY(e,
               "instance % colours % pixels where nothing hides it: % of % triangles are drawn, "
               "% face away, % are beside the picture, % before near, % beyond far.",
               i, seen->colored, seen->stats.tris_drawn, seen->stats.tris_in,
               seen->stats.tris_facing, seen->stats.tris_offscreen, seen->stats.tris_near,
               seen->stats.tris_far);
    return unseen;
}

/* ---- Numbers --------------------------------------------------------------------------------- */

/* Return 1, 2 or 3 digits of degrees if s, a sine, is that of an angle which was typed as degrees,
 * and not made a turn by ZS_DEGREES; else 0. */
static uint32_t typed_degrees(zs_q2_30 s)
{
    static const uint16_t usual[] = { 15, 20, 30, 45, 60, 90, 120, 135, 180, 270 };
    for (uint32_t k = 0; k < sizeof usual / sizeof usual[0]; k++)
        if (zs_size32((int32_t)zs_size32(s) - zs_sin(usual[k])) < 64u)
            return usual[k];
    return 0;
}

/* Of a pose that is turned about one axis alone. */
static void say_turned(struct zs_explainer *e, uint32_t i)
{
    static const uint8_t at[3] = { 2, 7, 3 }; /* the sine of yaw, pitch, roll */
    const zs_q2_30 *const rot = e->scene->instance[i].pose.rot;
    uint32_t turned = 0, n = 0;
    for (int k = 0; k < 3; k++)
        if (zs_size32(rot[at[k]]) > 64u) {
            turned = typed_degrees(rot[at[k]]);
            n++;
        }
    if (n == 1 && turned && rot[0] > 0 && rot[4] > 0)
        ZS_SAY(e, "instance % is turned by %/65536 of a turn: was ZS_DEGREES(%) meant?", i, turned,
               turned);
}

void zs_explain_camera_turned(struct zs_explainer *e)
{
    const zs_q2_30 *const rot = e->r->camera.rot; /* sines: [2] of yaw, [7] of pitch */
    const uint32_t yaw = typed_degrees(rot[2]), pitch = typed_degrees(rot[7]);
    if ((yaw | pitch) && (yaw || zs_size32(rot[2]) < 64u) && (pitch || zs_size32(rot[7]) < 64u) &&
        rot[0] > 0 && rot[4] > 0)
        ZS_SAY(e,
               "the camera is turned by % and raised by %, of 65536 to a turn: was ZS_DEGREES "
               "meant?",
               yaw, pitch);
}

static int same_pose(const struct zs_pose *a, const struct zs_pose *b)
{
    int differ = a->scale != b->scale;
    for (int k = 0; k < 9; k++)
        differ |= a->rot[k] != b->rot[k] || a->pos[k % 3] != b->pos[k % 3];
    return !differ;
}

/* The same mesh in the same place, drawn before: this one's pixels are never nearer. */
static void say_doubled(struct zs_explainer *e, uint32_t i, uint32_t k)
{
    const struct zs_instance *const in = &e->scene->instance[i], *const was = in - (i - k);
    const struct zs_material *const m = in->material, *const before = was->material;
    if (in->mesh != was->mesh || !same_pose(&in->pose, &was->pose) || in->depth_state ||
        was->depth_state || m->primitive || before->primitive || m->cull != before->cull ||
        m->shader->position != before->shader->position || !before->shader->opaque || !e->r->depth)
        return;
    ZS_SAY(e, "instance % is hidden by instance %: the same mesh in the same place; move it.", i,
           k);
}

/* Stages of a shader that are not called. */
static void say_stages(struct zs_explainer *e, uint32_t i)
{
    const struct zs_shader *const shader = e->scene->instance[i].material->shader;
    if (shader->position && !shader->place)
        ZS_SAY(e,
               "instance %: its shader's position is not called: ZS_POSITIONS (zs_shader.h) sets "
               "what calls it.",
               i);
    if (shader->layer && e->r->config.method->once)
        ZS_SAY(e,
               "instance %: its shader mixes with what is behind it, and config.method colours "
               "each pixel once: take zs_method_transparent.",
               i);
    if (shader->fragment && !shader->by_fragment)
        ZS_SAY(e,
               "instance %: its shader's fragment is not called: ZS_FRAGMENTS (zs_shader.h) sets "
               "what calls it.",
               i);
}

/* Lines and points of vertices that are not there, and lines in the surface of their own mesh. */
static void say_lines(struct zs_explainer *e, uint32_t i, struct zs_seen *seen)
{
    const struct zs_instance *const in = &e->scene->instance[i];
    const struct zs_depth_state *const state = in->depth_state;
    for (uint32_t k = 0; e->r->depth && k < i; k++) {
        const struct zs_instance *const was = in - (i - k);
        if (was->mesh->pos != in->mesh->pos || was->material->primitive ||
            !was->material->shader->opaque || !same_pose(&in->pose, &was->pose) ||
            was->depth_state || (state && (state->func || state->bias < 0)))
            continue;
        ZS_SAY(e,
               "instance %: its lines or points lie in the surface of instance %, which hides "
               "parts: give instance % the depth_state ZS_HIDDEN_LINE_STATE.",
               i, k, k);
        break;
    }
    zs_explain_draw(e, in, 0, seen);
    if (seen->stats.tris_index)
        ZS_SAY(e,
               "instance %: % of its lines or points name a vertex that is not there: n_verts "
               "is %.",
               i, seen->stats.tris_index, in->mesh->n_verts);
}

/* Colours of a mesh that its shader does not read: without them the picture is the same. */
static void say_colors(struct zs_explainer *e, uint32_t i, struct zs_seen *seen)
{
    struct zs_instance one = e->scene->instance[i];
    const struct zs_rgb *const rgb = &one.material->rgb;
    const struct zs_rgb *const own = one.mesh->face_rgb ? one.mesh->face_rgb : one.mesh->vertex_rgb;
    const uint32_t n = one.mesh->face_rgb ? one.mesh->n_tris : one.mesh->n_verts;
    struct zs_mesh mesh = *one.mesh;
    uint32_t k = 0;
    while (own && k < n && own[k].r == rgb->r && own[k].g == rgb->g && own[k].b == rgb->b)
        k++;
    if (!own || k == n || !(rgb->r | rgb->g | rgb->b) || one.material->texture ||
        one.material->primitive)
        return;
    for (uint32_t j = 0; j < e->scene->n_instances; j++)
        if (j != i && e->scene->instance[j].mesh == one.mesh)
            return; /* which may read them */
    zs_explain_draw(e, &one, 0, seen);
    const uint32_t sum = seen->sum;
    mesh.face_rgb = mesh.vertex_rgb = 0;
    mesh.face_raw = 0;
    one.mesh = &mesh;
    zs_explain_draw(e, &one, 0, seen);
    if (seen->colored && seen->sum == sum)
        ZS_SAY(e,
               "instance %: its shader does not read the colours of its mesh: zs_shade_flat reads "
               "face_rgb, zs_shade_smooth vertex_rgb.",
               i);
}

/* ---- All of it ------------------------------------------------------------------------------- */

void zs_explain_instance_data(struct zs_explainer *e, uint32_t i, int seen, struct zs_seen *room)
{
    const struct zs_instance *const in = &e->scene->instance[i];
    const struct zs_texture *const x = in->material->texture;
    const uint32_t before = e->said;
    uint32_t mesh = i, texture = i; /* the first instances, of these, that have them */
    for (uint32_t k = i > EARLIER ? i - EARLIER : 0; k < i; k++) {
        const struct zs_instance *const other = &e->scene->instance[k];
        mesh = mesh == i && other->mesh == in->mesh ? k : mesh;
        texture = texture == i && other->material->texture == x ? k : texture;
    }
    if (seen) {
        (void)say_scale(e, i);
        if (mesh != i)
            say_doubled(e, i, mesh);
    }
    say_turned(e, i);
    say_stages(e, i);
    if (mesh == i)
        zs_explain_mesh(e, i);
    if (x)
        zs_explain_texture(e, i, mesh == i, texture == i);
    if (seen && in->material->primitive)
        say_lines(e, i, room);
    if (seen && e->said == before)
        say_colors(e, i, room);
    if (seen && e->said == before)
        zs_explain_shape(e, i, room);
}
