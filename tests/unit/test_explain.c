/* zs_explain: each mistake that a newcomer makes ends in an error by name, or in the sentence that says it; a picture
 * in which nothing is wrong gets none. Mistakes are made in a scene that is right: it gets no sentence before.
 *
 * SPDX-License-Identifier: MIT
 */
#include "cases.h"

#include <string.h>

#include "examples.h"
#include "picture.h"
#include "scenes.h"
#include "shapes.h"
#include "zs_blend.h"
#include "zs_damage.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_explain.h"
#include "zs_fast.h"
#include "zs_filter.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_lines.h"
#include "zs_method.h"
#include "zs_overlay.h"
#include "zs_pass.h"
#include "zs_shadow.h"

/* ---- What is said ---------------------------------------------------------------------------- */

struct words {
    char text[8192];
    size_t n;
    unsigned long_pieces;
};

static void hear(void *ctx, const char *text)
{
    struct words *w = ctx;
    const size_t n = strlen(text);
    w->long_pieces += n == 0 || n > 47;
    assert_true(w->n + n < sizeof w->text);
    memcpy(w->text + w->n, text, n + 1);
    w->n += n;
}

static uint32_t lines(const struct words *w)
{
    uint32_t n = 0;
    for (const char *c = w->text; *c; c++)
        n += *c == '\n';
    return n;
}

/* ---- A scene in which all is right ----------------------------------------------------------- */

#define W 64
#define H 48

struct world {
    struct zs_config config;
    struct zs_camera camera;
    struct zs_scene scene;
    struct zs_instance instance[3];
    struct zs_mesh cube, sheet; /* closed; open: a sheet of 8 x 8 quads that lies in y = 0 */
    struct zs_material red, green;
    struct zs_texture texture;
    struct zs_blend glass;
    struct zs_lit_material lit;
    struct zs_lighting lighting;
    struct zs_lamp lamp;
    struct zs_shine shine;
    struct zs_fog fog;
    struct zs_overlay overlay;
    struct zs_item item;
    struct zs_lines lines;
    struct zs_resolve hook;
    struct zs_sink sink;
    int sent;       /* what submit returns */
    int camera_err; /* of the function that set the camera */
    int fog_err, shine_err;
    uint32_t arena_short;
};

static const int16_t corner[8][3] = { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 },
                                      { -1, -1, 1 },  { 1, -1, 1 },  { 1, 1, 1 },  { -1, 1, 1 } };
static const uint16_t face[12][3] = { { 4, 5, 6 }, { 4, 6, 7 }, { 1, 0, 3 }, { 1, 3, 2 }, { 5, 1, 2 }, { 5, 2, 6 },
                                      { 0, 4, 7 }, { 0, 7, 3 }, { 7, 6, 2 }, { 7, 2, 3 }, { 0, 1, 5 }, { 0, 5, 4 } };
static uint16_t face_inwards[12][3], face_beyond[12][3];
static zs_q1_15 normal[8][3], normal_inwards[8][3], normal_long[8][3];
static const int16_t uv[8][2] = { { 0, 0 }, { 4096, 0 }, { 4096, 4096 }, { 0, 4096 },
                                  { 0, 0 }, { 4096, 0 }, { 4096, 4096 }, { 0, 4096 } };
static const int16_t uv_ones[8][2] = {
    { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }
};
static const uint8_t texel[4][4] = { { 0, 1, 0, 1 }, { 1, 0, 1, 0 }, { 0, 1, 0, 1 }, { 1, 0, 1, 0 } };
static const uint16_t palette[2] = { 0xffff, 0xf800 };
static int16_t sheet_pos[81][3];
static uint16_t sheet_tri[128][3], sheet_turned[128][3];

static int submit(void *ctx, const struct zs_strip *strip)
{
    (void)strip;
    return ((const struct world *)ctx)->sent;
}

static void fill_arrays(void)
{
    for (int t = 0; t < 12; t++)
        for (int k = 0; k < 3; k++) {
            face_inwards[t][k] = face[t][2 - k];
            face_beyond[t][k] = (uint16_t)(face[t][k] + (t >= 7 ? 8 : 0));
        }
    for (int v = 0; v < 8; v++)
        for (int k = 0; k < 3; k++) {
            normal[v][k] = (zs_q1_15)(corner[v][k] * 18918); /* 32767 / sqrt(3) */
            normal_inwards[v][k] = (zs_q1_15)(corner[v][k] * -18918);
            normal_long[v][k] = (zs_q1_15)(corner[v][k] * 32767);
        }
    for (int v = 0; v < 81; v++) {
        sheet_pos[v][0] = (int16_t)(v % 9 * 100 - 400);
        sheet_pos[v][1] = 0;
        sheet_pos[v][2] = (int16_t)(v / 9 * 100 - 400);
    }
    for (int t = 0; t < 128; t++) {
        const int v = t / 2 / 8 * 9 + t / 2 % 8;
        const int of[2][3] = { { v, v + 9, v + 10 }, { v, v + 10, v + 1 } };
        for (int k = 0; k < 3; k++) {
            sheet_tri[t][k] = (uint16_t)of[t % 2][k];
            sheet_turned[t][k] = (uint16_t)of[t % 2][2 - k];
        }
    }
}

/* A red cube of 2,000 units, 5,000 ahead, slightly turned. */
static void world_cube(struct world *w)
{
    static const int32_t eye[3] = { 0, 2500, 4500 }, middle[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    fill_arrays();
    memset(w, 0, sizeof *w);
    static const struct zs_fast *const fast[] = { ZS_FAST_ALL, ZS_FAST_END };
    const struct zs_config config = {
        .width = W, .height = H, .strip_h = 8, .max_tris = 64, .max_verts = 64, .varyings = ZS_VARYINGS_SMOOTH,
        .depth = &zs_depth_float
    };
    const struct zs_mesh cube = {
        .pos = corner, .tri = face, .n_verts = 8, .n_tris = 12, .scale = 1000 * ZS_Q16_ONE, .radius = 2
    };
    const struct zs_mesh sheet = {
        .pos = sheet_pos, .tri = sheet_tri, .n_verts = 81, .n_tris = 128, .scale = 5 * ZS_Q16_ONE, .radius = 566
    };
    const struct zs_rgb red = ZS_RGB(0xe63c28), green = ZS_RGB(0x30a040);
    w->config = config;
    w->config.fast = fast;
    w->cube = cube;
    w->sheet = sheet;
    w->red.shader = w->green.shader = &zs_shade_flat;
    w->red.rgb = red;
    w->green.rgb = green;
    w->instance[0].mesh = &w->cube;
    w->instance[0].material = &w->red;
    zs_pose_turn(&w->instance[0].pose, ZS_DEGREES(25), 0, 0);
    w->scene.instance = w->instance;
    w->scene.n_instances = 1;
    w->scene.background = ZS_RGB565(0x0a143c);
    w->sink.submit = submit;
    w->sink.ctx = w;
    w->texture.format = &zs_texel_pal8;
    w->texture.texel = texel;
    w->texture.palette = palette;
    w->texture.n_colors = 2;
    w->texture.log2_w = w->texture.log2_h = 2;
    assert_int_equal(zs_camera_perspective(&w->camera, ZS_DEGREES(45), H, 1000, 20000), ZS_OK);
    assert_int_equal(zs_camera_look_at(&w->camera, eye, middle, up), ZS_OK);
}

/* The same with another shader. */
static void world_shaded(struct world *w, const struct zs_shader *shader)
{
    w->red.shader = shader;
    w->red.texture = &w->texture;
    w->cube.normal = normal;
    w->cube.uv = uv;
    w->cube.uv_bits = 12;
}

/* Another cube, behind the first one and to the right. */
static void world_two(struct world *w)
{
    w->instance[1] = w->instance[0];
    w->instance[1].material = &w->green;
    w->instance[1].pose.pos[0] = 900;
    w->instance[1].pose.pos[2] = -4000;
    w->scene.n_instances = 2;
}

/* The same, of some pixels that lie within the last rows of a strip. */
static void small_and_low(struct world *w)
{
    w->instance[0].pose.scale = ZS_Q16_ONE / 6;
    w->instance[0].pose.pos[1] = -520;
}

static void world_sheet(struct world *w)
{
    w->instance[0].mesh = &w->sheet;
    w->config.max_tris = w->config.max_verts = 200;
}

/* ---- One world ------------------------------------------------------------------------------- */

/* Draw it as a program does, and hear what is said. Return the error of zs_init or zs_render. */
static int world_hear(struct world *w, struct words *words, uint32_t *said)
{
    struct zs_renderer r;
    const uint32_t bytes = zs_arena_bytes(&w->config) - w->arena_short, room = bytes ? bytes : 65536u;
    uint32_t *arena = malloc(room);
    memset(&r, 0x5a, sizeof r);
    memset(words, 0, sizeof *words);
    memset(arena, 0xa5, room);
    int err = zs_init(&r, &w->config, arena, room);
    if (err) {
        *said = zs_explain_init(&r, &w->config, arena, room, hear, words);
    } else {
        /* nothing is read beyond the last instance */
        const uint32_t n = w->scene.n_instances <= 3u ? w->scene.n_instances : 0u;
        struct zs_instance *const given = w->instance, *const exact = malloc(n * sizeof *exact + 1u);
        if (w->scene.instance == given && n) {
            memcpy(exact, given, n * sizeof *exact);
            w->scene.instance = exact;
        }
        err = zs_render(&r, &w->scene, &w->camera, &w->sink);
        const struct zs_stats before = *zs_frame_stats(&r);
        *said = zs_explain(&r, &w->scene, &w->camera, hear, words);
        assert_memory_equal(&before, zs_frame_stats(&r), sizeof before);
        if (w->scene.instance == exact)
            w->scene.instance = given;
        free(exact);
    }
    free(arena);
    return err;
}

static void assert_right(struct world *w, const char *name)
{
    struct words words;
    uint32_t said;
    const int err = world_hear(w, &words, &said);
    if (err || said || words.n)
        fail_msg("%s: %s; %s", name, zs_error_string(err), words.text);
}

/* A mistake: err is what zs_init or zs_render returns, and `first` how the first sentence begins; a star stands for
 * any text. */
struct mistake {
    const char *name;
    void (*ready)(struct world *w); /* what the right scene has besides; NULL: nothing */
    void (*make)(struct world *w);
    int err;
    const char *first;
    uint32_t n; /* sentences; 0: one */
};

/* 1: text begins with the pattern. */
static int begins(const char *text, const char *pattern)
{
    const char *star = strchr(pattern, '*');
    const size_t n = star ? (size_t)(star - pattern) : strlen(pattern);
    if (strncmp(text, pattern, n) != 0)
        return 0;
    if (!star)
        return 1;
    for (text += n; *text && *text != '\n'; text++)
        if (begins(text, star + 1))
            return 1;
    return 0;
}

static void check_mistake(const struct mistake *m)
{
    struct world w;
    struct words words;
    uint32_t said;
    world_cube(&w);
    if (m->ready)
        m->ready(&w);
    assert_right(&w, m->name);
    m->make(&w);
    const int err = world_hear(&w, &words, &said);
    if (err != m->err || !begins(words.text, m->first) || said != (m->n ? m->n : 1u) || said != lines(&words) ||
        words.long_pieces)
        fail_msg("%s: %d, %u sentences, %u too long\n%s", m->name, err, said, words.long_pieces, words.text);
}

/* ---- Mistakes: nothing is seen --------------------------------------------------------------- */

static void too_far(struct world *w)
{
    w->instance[0].pose.pos[2] = -120000;
}

static void behind(struct world *w)
{
    w->instance[0].pose.pos[2] = 30000;
}

static void beside(struct world *w)
{
    w->instance[0].pose.pos[0] = -9000;
}

static void before_near(struct world *w)
{
    w->camera.z_near = 15000 * 65536;
}

static void fills(struct world *w)
{
    w->instance[0].pose.scale = 4 * ZS_Q16_ONE;
    zs_pose_turn(&w->instance[0].pose, 0, ZS_DEGREES(-29), 0);
}

static void contains_camera(struct world *w)
{
    w->cube.scale = 20000 * ZS_Q16_ONE;
}

static void pose_scale_1(struct world *w)
{
    w->instance[0].pose.scale = 1;
}

static void mesh_scale_1000(struct world *w)
{
    w->cube.scale = 1000;
}

static void all_subpixel(struct world *w)
{
    w->instance[0].pose.scale = ZS_Q16_ONE / 400;
    w->scene.background = 0;
}

static void angle_45(struct world *w)
{
    const struct zs_camera as = w->camera;
    w->camera_err = zs_camera_perspective(&w->camera, 45, H, 1000, 20000);
    memcpy(w->camera.rot, as.rot, sizeof as.rot);
    memcpy(w->camera.pos, as.pos, sizeof as.pos);
}

static void turn_90(struct world *w)
{
    zs_pose_turn(&w->instance[0].pose, 90, 0, 0);
}

static void turn_45_pitch(struct world *w)
{
    zs_pose_turn(&w->instance[0].pose, 0, (zs_turn)-45, 0);
}

static void sheet_winding(struct world *w)
{
    static struct zs_cluster part[8];
    for (uint32_t k = 0; k < 8; k++)
        part[k] = (struct zs_cluster){ .first = 16 * k, .n_tris = 16, .center = { 0, 0, (int16_t)(100 * k - 350) },
                                       .radius = 404, .axis = { 0, -127, 0 }, .cutoff = 1, .height = 1000 };
    w->sheet.cluster = part;
    w->sheet.n_clusters = 8;
    w->sheet.tri = (const uint16_t(*)[3])sheet_turned;
}

static void cube_winding(struct world *w)
{
    w->cube.tri = (const uint16_t(*)[3])face_inwards;
}

static void wrong_cull(struct world *w)
{
    w->green.cull = ZS_CULL_FRONT;
    w->instance[0].material = &w->green;
}

static void no_triangles(struct world *w)
{
    w->cube.n_tris = 0;
}

static void no_instances(struct world *w)
{
    w->scene.n_instances = 0;
}

static void all_indices_beyond(struct world *w)
{
    w->cube.n_verts = 1;
}

static void same_as_background(struct world *w)
{
    w->red.shader = &zs_shade_raw;
    w->scene.background = ZS_RGB565(0xe63c28);
}

static void black_on_black(struct world *w)
{
    memset(&w->red.rgb, 0, sizeof w->red.rgb);
    w->scene.background = 0;
}

static void with_glass(struct world *w)
{
    w->glass.material = w->red;
    w->glass.material.shader = &zs_blend_flat;
    w->glass.alpha = 128;
    w->instance[0].material = &w->glass.material;
}

static void alpha_0(struct world *w)
{
    w->glass.alpha = 0;
}

static void check_all(const struct mistake *m, size_t n)
{
    for (size_t k = 0; k < n; k++)
        check_mistake(&m[k]);
}
#define CHECK_ALL(table) check_all(table, sizeof(table) / sizeof(table)[0])

static const struct mistake unseen[] = {
    { "too far", NULL, too_far, ZS_OK,
      "instance 0 is out of view: it begins 87047 beyond far = 20000; move it, or raise far.\n" },
    { "behind", NULL, behind, ZS_OK, "instance 0 is behind the camera: it ends * behind the eye" },
    { "beside", NULL, beside, ZS_OK,
      "instance 0 is beside the picture: its centre is 5148 ahead of the eye, 9000 to the left" },
    { "before near", NULL, before_near, ZS_OK, "instance 0 is out of view: it ends * before near = 15000" },
    { "fills", NULL, fills, ZS_OK, "instance 0 fills the picture with one colour: it is * across" },
    { "contains", NULL, contains_camera, ZS_OK, "the camera is inside instance 0, whose radius is 60000" },
    { "pose.scale 1", NULL, pose_scale_1, ZS_OK, "instance 0: pose.scale is 1/65536: was 1 * ZS_Q16_ONE meant?\n" },
    { "mesh.scale 1000", NULL, mesh_scale_1000, ZS_OK,
      "instance 0: mesh.scale is 1000/65536: was 1000 * ZS_Q16_ONE meant?\n" },
    { "subpixel", NULL, all_subpixel, ZS_OK, "instance 0*raise its scale, or move it nearer" },
    { "45", NULL, angle_45, ZS_OK, "the camera sees less than one degree: was ZS_DEGREES meant", 2 },
    { "turn 90", NULL, turn_90, ZS_OK, "instance 0 is turned by 90/65536 of a turn: was ZS_DEGREES(90) meant?\n" },
    { "pitch -45", NULL, turn_45_pitch, ZS_OK, "instance 0 is turned by 45/65536 of a turn: was ZS_DEGREES(45)" },
    { "winding, open", world_sheet, sheet_winding, ZS_OK,
      "instance 0: 128 of 128 triangles face away: the winding is wrong" },
    { "winding, closed", NULL, cube_winding, ZS_OK, "instance 0 is wound inwards" },
    { "culling", world_sheet, wrong_cull, ZS_OK, "instance 0: 128 of 128 triangles face away: the winding is wrong" },
    { "no triangles", NULL, no_triangles, ZS_OK, "instance 0 has nothing to draw: mesh.n_tris is 0" },
    { "no instances", NULL, no_instances, ZS_OK, "the scene has no instance: n_instances is 0.\n" },
    { "n_verts 1", NULL, all_indices_beyond, ZS_OK,
      "instance 0: 12 of 12 triangles name a vertex that is not there; n_verts is 1", 2 },
    { "background", NULL, same_as_background, ZS_OK, "instance 0 has the background's colour on all of its * pixels" },
    { "black on black", NULL, black_on_black, ZS_OK, "instance 0 has the background's colour on all of its * pixels",
      2 },
    { "alpha 0", with_glass, alpha_0, ZS_OK, "instance 0: * triangles are drawn and colour no pixel: alpha is 0" },
};

static void nothing_is_seen(void **state)
{
    CHECK_ALL(unseen);
}

/* ---- Mistakes: it is dark -------------------------------------------------------------------- */

static void lit_right(struct world *w)
{
    w->scene.light.dir[2] = ZS_Q30_ONE;
    w->scene.light.ambient = ZS_Q16_ONE / 4;
    w->scene.light.diffuse = ZS_Q16_ONE / 4 * 3;
}

static void diffuse_1(struct world *w)
{
    w->scene.light.diffuse = 1;
    w->scene.light.ambient = 0;
}

static void ambient_100(struct world *w)
{
    w->scene.light.ambient = 100;
    w->scene.light.diffuse = 0;
}

static void light_of_255(struct world *w)
{
    w->scene.light.ambient = 64;
    w->scene.light.diffuse = 191;
}

static void dir_0_0_1(struct world *w)
{
    w->scene.light.dir[2] = 1;
    w->scene.light.ambient = 0;
}

static void dir_q15(struct world *w)
{
    w->scene.light.dir[2] = 32767;
}

static void dir_long(struct world *w)
{
    w->scene.light.dir[0] = w->scene.light.dir[1] = ZS_Q30_ONE;
}

static void no_light(struct world *w)
{
    w->scene.light.ambient = w->scene.light.diffuse = 0;
}

static void light_from_behind(struct world *w)
{
    w->scene.light.dir[2] = -ZS_Q30_ONE;
    w->scene.light.ambient = 0;
}

/* Levels of the brightest channel, of 31: 2 is dark, and may be meant; 1 is as good as black. */
static void lit_to_2(struct world *w)
{
    w->scene.light.ambient = 4000;
}

static void lit_to_1(struct world *w)
{
    w->scene.light.ambient = 2300;
}

static void no_colour(struct world *w)
{
    memset(&w->red.rgb, 0, sizeof w->red.rgb);
}

static void black_faces(struct world *w)
{
    static const struct zs_rgb black[12];
    w->cube.face_rgb = black;
}

/* The mesh has colours of its own: black is not what none was given for. */
static void black_all(struct world *w)
{
    no_colour(w);
    black_faces(w);
}

static void with_lamps(struct world *w)
{
    const struct zs_lamp sun = { .dir = { 0, 0, ZS_Q30_ONE } };
    w->lamp = sun;
    w->lighting.lamp = &w->lamp;
    w->lighting.n_lamps = 1;
    assert_int_equal(zs_shine_set(&w->shine, 20), ZS_OK);
    w->lit.material = w->red;
    w->lit.material.shader = &zs_shade_lit_face;
    w->lit.lighting = &w->lighting;
    w->lit.shine = &w->shine;
    w->instance[0].material = &w->lit.material;
}

static void lamp_strength_1(struct world *w)
{
    w->lamp.strength = 1;
}

static void lamp_dir_1(struct world *w)
{
    w->lamp.dir[2] = 1;
}

static void lamp_dir_0(struct world *w)
{
    w->lamp.dir[2] = 0;
}

static void power_0(struct world *w)
{
    memset(&w->shine, 0, sizeof w->shine);
    w->shine_err = zs_shine_set(&w->shine, 0);
}

static const struct mistake dark[] = {
    { "diffuse 1", lit_right, diffuse_1, ZS_OK, "the light's diffuse is 1/65536: was ZS_Q16_ONE meant?\n" },
    { "ambient 100", lit_right, ambient_100, ZS_OK, "the light's ambient is 100/65536: was ZS_Q16_ONE meant?\n" },
    { "light of 255", lit_right, light_of_255, ZS_OK,
      "the light's diffuse is 191/65536: was ZS_Q16_ONE meant?\nthe light's ambient is 64/65536", 2 },
    { "dir 0 0 1", lit_right, dir_0_0_1, ZS_OK, "the light's dir has length 0, and 1 is ZS_Q30_ONE" },
    { "dir in q1_15", lit_right, dir_q15, ZS_OK, "the light's dir has length 0, and 1 is ZS_Q30_ONE" },
    { "dir too long", lit_right, dir_long, ZS_OK, "the light's dir has length 1.732, and 1 is ZS_Q30_ONE" },
    { "no light", lit_right, no_light, ZS_OK, "the light's ambient and diffuse are 0: give one" },
    { "from behind", lit_right, light_from_behind, ZS_OK, "all that is seen is dark: the light comes from behind it" },
    { "one level", lit_to_2, lit_to_1, ZS_OK, "the light's ambient is 2300/65536, its diffuse 0/65536: 1 is" },
    { "no colour", NULL, no_colour, ZS_OK, "instance 0 is black: its material's rgb is 0" },
    { "black faces", NULL, black_faces, ZS_OK, "all that is drawn is black: colours, texture or lamps are" },
    { "black faces, no colour", NULL, black_all, ZS_OK, "all that is drawn is black: colours, texture or lamps are" },
    { "strength 1", with_lamps, lamp_strength_1, ZS_OK, "all that is drawn is black: colours, texture or lamps are" },
    { "lamp 0 0 1", with_lamps, lamp_dir_1, ZS_ERR_VECTOR, "instance 0 is refused: a lamp of its lighting has a dir" },
    { "lamp 0 0 0", with_lamps, lamp_dir_0, ZS_ERR_VECTOR,
      "instance 0 is refused: a lamp of its lighting has a dir that is not 1 long: give it a direction, and zs_unit" },
    { "power 0", with_lamps, power_0, ZS_ERR_RANGE,
      "instance 0 is refused: its material has a field out of range: lamps, flags, a shine that" },
};

static void it_is_dark(void **state)
{
    CHECK_ALL(dark);
}

/* ---- Mistakes: parts are wrong --------------------------------------------------------------- */

static void radius_0(struct world *w)
{
    w->cube.radius = 0;
}

static void some_indices_beyond(struct world *w)
{
    w->cube.tri = (const uint16_t(*)[3])face_beyond;
}

static void smooth(struct world *w)
{
    world_shaded(w, &zs_shade_smooth);
    w->red.texture = NULL;
}

static void normals_inwards(struct world *w)
{
    w->cube.normal = (const zs_q1_15(*)[3])normal_inwards;
}

static void normals_long(struct world *w)
{
    w->cube.normal = (const zs_q1_15(*)[3])normal_long;
}

static void textured(struct world *w)
{
    world_shaded(w, &zs_shade_texture);
}

static void uv_as_ones(struct world *w)
{
    w->cube.uv = uv_ones;
}

static void uv_bits_0(struct world *w)
{
    w->cube.uv_bits = 0;
}

static void not_read(struct world *w)
{
    world_shaded(w, &zs_shade_flat);
    w->texture.log2_w = 222;
}

static void few_colours(struct world *w)
{
    w->texture.n_colors = 1;
}

static void two_without_depth(struct world *w)
{
    const struct zs_instance near_one = w->instance[0];
    world_two(w);
    w->instance[0] = w->instance[1];
    w->instance[0].pose.pos[2] = -9000;
    w->instance[1] = near_one;
    w->config.depth = &zs_depth_none;
}

static void near_first(struct world *w)
{
    const struct zs_instance far_one = w->instance[0];
    w->instance[0] = w->instance[1];
    w->instance[1] = far_one;
}

static void recip(struct world *w)
{
    w->config.depth = &zs_depth_recip;
}

static void near_1(struct world *w)
{
    w->camera.z_near = 65536 / 8;
}

static void with_fog(struct world *w)
{
    w->fog.color = ZS_RGB565(0x8090a0);
    w->fog.start = 3000;
    w->fog.end = 9000;
    w->hook.draw = zs_fog_draw;
    w->hook.ctx = &w->fog;
    w->scene.resolve = &w->hook;
    w->scene.n_resolves = 1;
    assert_int_equal(zs_fog_set(&w->fog, &w->config, &w->camera), ZS_OK);
}

static void fog_end_before_start(struct world *w)
{
    struct zs_fog fog = { .color = w->fog.color, .start = 9000, .end = 3000 };
    w->fog_err = zs_fog_set(&fog, &w->config, &w->camera);
    w->fog = fog;
}

static void fog_too_close(struct world *w)
{
    w->fog.start = 100;
    w->fog.end = 1100;
    assert_int_equal(zs_fog_set(&w->fog, &w->config, &w->camera), ZS_OK);
}

static void with_overlay(struct world *w)
{
    static const struct zs_item bar = { .kind = &zs_item_fill, .x = 4, .y = 4, .w = 20, .h = 5, .color = 0xffff };
    w->item = bar;
    w->overlay.item = &w->item;
    w->overlay.n = 1;
    w->hook.draw = zs_overlay_draw;
    w->hook.ctx = &w->overlay;
    w->scene.resolve = &w->hook;
    w->scene.n_resolves = 1;
}

static void overlay_off(struct world *w)
{
    w->item.y = 240;
}

static const struct mistake wrong[] = {
    { "radius 0", NULL, radius_0, ZS_OK,
      "instance 0: vertex 0 lies outside the mesh's sphere: radius is 0, and 2 holds all of them.\n" },
    { "n_verts", NULL, some_indices_beyond, ZS_OK,
      "instance 0: triangle 7 of its mesh names a vertex that is not there: n_verts is 8" },
    { "normals inwards", smooth, normals_inwards, ZS_OK,
      "instance 0: mesh.normal points away from the side that is seen, on 12 of 12 triangles" },
    { "normals too long", smooth, normals_long, ZS_OK,
      "instance 0: its mesh has a vertex normal whose length is neither 1 nor 0 (number 0)" },
    { "uv 0 and 1", textured, uv_as_ones, ZS_OK,
      "instance 0: mesh.uv spans less than a texel: 4096 is all of the texture with uv_bits 12" },
    { "uv_bits 0", textured, uv_bits_0, ZS_OK, "instance 0: mesh.uv repeats the texture 4096 times: uv_bits is 0" },
    { "a texture that no shader reads", NULL, not_read, ZS_OK, "instance 0: its texture has ", 2 },
    { "n_colors", textured, few_colours, ZS_OK,
      "instance 0: its texture has a texel that its palette does not hold (number 1)" },
    { "no depth memory", two_without_depth, near_first, ZS_OK, "instance 1 is behind instance 0 and drawn over it" },
    { "near 1/8", recip, near_1, ZS_OK, "instance 0 has * depth keys from front to back" },
    { "fog the wrong way", with_fog, fog_end_before_start, ZS_OK,
      "resolve hook 0 gives all that is drawn one colour" },
    { "fog too close", with_fog, fog_too_close, ZS_OK, "resolve hook 0 gives all that is drawn one colour" },
    { "overlay off", with_overlay, overlay_off, ZS_OK,
      "resolve hook 0 changes no pixel: what it draws is beside the picture" },
};

static void parts_are_wrong(void **state)
{
    CHECK_ALL(wrong);
}

/* ---- Mistakes: it is slow -------------------------------------------------------------------- */

static void pools_of_20(struct world *w)
{
    w->config.max_tris = w->config.max_verts = 20;
}

static void pool_of_4(struct world *w)
{
    w->config.max_tris = 4;
}

static void strips_of_1(struct world *w)
{
    w->config.strip_h = 1;
}

static void linear(struct world *w)
{
    w->config.depth = &zs_depth_linear;
}

static const struct mistake slow[] = {
    { "pools of 20", world_sheet, pools_of_20, ZS_OK,
      "the frame takes * passes; one needs max_tris 128 (it is 20) max_verts 81 (it is 20).\n" },
    { "pool of 4", world_sheet, pool_of_4, ZS_OK, "the frame takes * passes; one needs max_tris 128 (it is 4).\n" },
    { "strips of a row", NULL, strips_of_1, ZS_OK, "strips of 1 rows are slow: 16 take 3840 bytes more" },
    { "linear", NULL, linear, ZS_OK, "the depth mapping computes each pixel's key by itself" },
};

static void it_is_slow(void **state)
{
    CHECK_ALL(slow);
}

/* The number behind a name in what was said; `is` where it is not. */
static uint16_t named(const struct words *words, const char *name, uint16_t is)
{
    const char *const at = strstr(words->text, name);
    return at ? (uint16_t)strtoul(at + strlen(name), NULL, 10) : is;
}

/* 1: with the pools that a sentence names, the frame is drawn in one pass, and is the same. 0: wrong. -1: no sentence
 * about passes. */
static int one_pass(struct world *w, const char *name)
{
    struct words words;
    uint32_t said;
    CASE_CHECK(world_hear(w, &words, &said) == ZS_OK);
    if (!strstr(words.text, "one needs max_"))
        return strstr(words.text, "one needs") ? case_wrong("%s: %s", name, words.text) : -1;
    struct picture was = picture_draw(&w->config, &w->scene, &w->camera);
    w->config.max_tris = named(&words, " max_tris ", w->config.max_tris);
    w->config.max_verts = named(&words, " max_verts ", w->config.max_verts);
    struct picture p = picture_draw(&w->config, &w->scene, &w->camera);
    const int once = p.err == ZS_OK && p.stats.passes == 1, same = picture_same(&was, &p, name);
    const uint32_t passes = p.stats.passes;
    PICTURES_FREE(&was, &p);
    return !once ? case_wrong("%s: error %d, %u passes\n%s", name, p.err, passes, words.text) : same;
}

/* More than pools can hold. */
static void no_pool_is_enough(void **state)
{
    static int16_t many[40000][3];
    struct world w;
    struct words words;
    uint32_t said;
    world_cube(&w);
    world_two(&w);
    world_sheet(&w);
    memcpy(many, sheet_pos, sizeof sheet_pos);
    w.sheet.pos = (const int16_t(*)[3])many;
    w.sheet.n_verts = 40000;
    w.instance[1].mesh = &w.sheet;
    w.config.max_tris = 4;
    assert_int_equal(world_hear(&w, &words, &said), ZS_OK);
    assert_non_null(strstr(words.text, " passes; pools of 65534 do not hold it in one: larger ones take fewer.\n"));
}

/* The pools that a sentence names take the scene in one pass. */
static void one_pass_is_one(void **state)
{
    struct world w;
    world_cube(&w);
    world_sheet(&w);
    pools_of_20(&w);
    assert_int_equal(one_pass(&w, "a sheet"), 1);
}

/* ---- Errors ---------------------------------------------------------------------------------- */

static void camera_near_0(struct world *w)
{
    memset(&w->camera, 0, sizeof w->camera);
    w->camera_err = zs_camera_perspective(&w->camera, ZS_DEGREES(45), H, 0, 20000);
}

static void camera_far(struct world *w)
{
    w->camera.z_far = w->camera.z_near;
}

static void camera_ends(struct world *w)
{
    w->camera.z_near = INT64_MIN;
    w->camera.z_far = INT64_MAX;
}

static void camera_focal(struct world *w)
{
    w->camera.focal = 0;
}

static void camera_rot(struct world *w)
{
    w->camera.rot[0] = 65536;
}

static void light_256(struct world *w)
{
    w->scene.light.ambient = 256 * ZS_Q16_ONE;
}

static void light_dir_2(struct world *w)
{
    w->scene.light.dir[0] = INT32_MAX;
}

static void second(struct world *w)
{
    world_two(w);
}

static void no_mesh(struct world *w)
{
    w->instance[1].mesh = NULL;
}

static void no_material(struct world *w)
{
    w->instance[1].material = NULL;
}

static void no_shader(struct world *w)
{
    w->green.shader = NULL;
}

static void no_normals(struct world *w)
{
    w->green.shader = &zs_shade_smooth;
}

static void no_texture(struct world *w)
{
    w->green.shader = &zs_shade_texture;
}

static void no_varyings(struct world *w)
{
    w->config.varyings = 0;
}

static void rot_q16(struct world *w)
{
    for (int k = 0; k < 9; k++)
        w->instance[0].pose.rot[k] = k % 4 ? 0 : 65536;
}

static void pos_beyond(struct world *w)
{
    w->instance[0].pose.pos[1] = INT32_MIN;
}

static void too_large(struct world *w)
{
    w->cube.scale = w->instance[0].pose.scale = 60000 * ZS_Q16_ONE;
}

static void cull_3(struct world *w)
{
    w->red.cull = 3;
}

static void log2_64(struct world *w)
{
    w->texture.log2_w = w->texture.log2_h = 64;
}

static void orthographic(struct world *w)
{
    w->camera.projection = ZS_ORTHOGRAPHIC;
    w->camera.height = 5000 * 65536;
}

static void no_array(struct world *w)
{
    w->scene.instance = NULL;
}

static void sky_null(struct world *w)
{
    static const struct zs_background none = { .fill = NULL };
    w->scene.sky = &none;
}

static void sink_fails(struct world *w)
{
    w->sent = 16;
}

static void no_depth_mapping(struct world *w)
{
    w->config.depth = NULL;
}

static void no_rows(struct world *w)
{
    w->config.strip_h = 0;
}

static void too_few_verts(struct world *w)
{
    w->config.max_verts = 2;
}

static void short_arena(struct world *w)
{
    w->arena_short = 400;
}

static void painter_with_depth(struct world *w)
{
    w->config.method = &zs_method_painter;
}

static const struct mistake refused[] = {
    { "near 0", NULL, camera_near_0, ZS_ERR_CAMERA, "the camera is refused: near = 0 and far = 0" },
    { "far", NULL, camera_far, ZS_ERR_CAMERA, "the camera is refused: near = 1000 and far = 1000" },
    { "near and far, the least and the most", NULL, camera_ends, ZS_ERR_CAMERA,
      "the camera is refused: near = -140737488355328 and far = 140737488355328" },
    { "focal", NULL, camera_focal, ZS_ERR_CAMERA, "the camera is refused: its focal length is 0 px" },
    { "camera.rot", NULL, camera_rot, ZS_ERR_CAMERA, "the camera is refused: rot is no rotation" },
    { "ambient", NULL, light_256, ZS_ERR_RANGE, "the light is refused: ambient is 16777216" },
    { "light.dir", NULL, light_dir_2, ZS_ERR_RANGE, "the light is refused: its dir is longer than 1" },
    { "mesh NULL", second, no_mesh, ZS_ERR_NULL, "instance 1 is refused: mesh is NULL.\n" },
    { "material NULL", second, no_material, ZS_ERR_NULL, "instance 1 is refused: material is NULL.\n" },
    { "shader NULL", second, no_shader, ZS_ERR_NULL, "instance 1 is refused: material.shader is NULL.\n" },
    { "no normals", second, no_normals, ZS_ERR_MESH,
      "instance 1 is refused: its shader needs what is NULL: mesh.normal, mesh.uv, material.texture, or one of" },
    { "no texture", second, no_texture, ZS_ERR_NULL,
      "instance 1 is refused: its shader needs what is NULL: mesh.normal, mesh.uv, material.texture, or more" },
    { "varyings", smooth, no_varyings, ZS_ERR_VARYINGS,
      "instance 0 is refused: its shader takes 3 varyings, and config.varyings is 0.\n" },
    { "pose.rot", NULL, rot_q16, ZS_ERR_RANGE, "instance 0 is refused: pose.rot is no rotation" },
    { "pose.pos", NULL, pos_beyond, ZS_ERR_RANGE,
      "instance 0 is refused: pose.pos is 0 -2147483648 0, and 536870912 is the most.\n" },
    { "scale", NULL, too_large, ZS_ERR_RANGE,
      "instance 0 is refused: it is too large: 2 steps, of 3600000000 world units each" },
    { "cull", NULL, cull_3, ZS_ERR_MESH, "instance 0 is refused: material.cull is 3.\n" },
    { "log2_w", textured, log2_64, ZS_ERR_TEXTURE, "instance 0 is refused: its texture's log2_w is 64, log2_h 64" },
    { "float, orthographic", NULL, orthographic, ZS_ERR_DEPTH,
      "the depth mapping takes perspective cameras: zs_depth_linear" },
    { "instance NULL", NULL, no_array, ZS_ERR_NULL, "scene.instance is NULL, and n_instances is 1.\n" },
    { "sky", NULL, sky_null, ZS_ERR_NULL, "scene.sky.fill is NULL.\n" },
    { "sink", NULL, sink_fails, 16,
      "the last frame ended after 1 of 6 strips: a function of the sink returned an error" },
    { "mapping", NULL, no_depth_mapping, ZS_ERR_NULL, "config.depth is NULL: take &zs_depth_float" },
    { "strip_h", NULL, no_rows, ZS_ERR_SIZE, "config.strip_h is 0: it takes 1 to 65535.\n" },
    { "max_verts", NULL, too_few_verts, ZS_ERR_SIZE, "config.max_verts is 2: it takes 3 to 65534.\n" },
    { "arena", NULL, short_arena, ZS_ERR_ARENA, "the arena has * bytes, and * are needed: ZS_ARENA_BYTES" },
    { "painter", NULL, painter_with_depth, ZS_ERR_DEPTH,
      "config.method does not take this config.depth: zs_method.h says which" },
};

static void errors_name_the_thing(void **state)
{
    CHECK_ALL(refused);
}

/* ---- More mistakes ---------------------------------------------------------------------------- */

/* Triangle t has its corners from `from` on, by where it is in the mesh. */
static void turn_triangles(struct world *w, const uint8_t from[3])
{
    static uint16_t tri[36][3];
    for (int t = 0; t < 36; t++)
        for (int k = 0; k < 3; k++)
            tri[t][k] = t >= 12 ? 0 : (uint16_t)(face[t][t % 2 ? k : from[k]]);
    w->cube.tri = (const uint16_t(*)[3])tri;
}

static void with_lines(struct world *w)
{
    static const uint16_t side[4][2] = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 } };
    const struct zs_lines lines = { ZS_LINES(side, 4), .width = 2 };
    w->lines = lines;
    w->red.shader = &zs_shade_plain;
    w->red.primitive = &w->lines.primitive;
}

/* A pane of glass before a cube: both in the order in which they are right. */
static void glass_behind(struct world *w)
{
    two_without_depth(w);
    w->config.depth = &zs_depth_float;
    w->config.fast = NULL;
    with_glass(w);
    w->instance[1].material = w->instance[0].material;
    w->instance[0].material = &w->green;
}

static void with_spot(struct world *w)
{
    with_lamps(w);
    w->lamp.kind = ZS_LAMP_SPOT;
    w->lamp.pos[2] = 4000;
    w->lamp.pos[1] = 2000;
    w->lamp.dir[2] = -ZS_Q30_ONE;
    w->lamp.inner = zs_cos(ZS_DEGREES(40));
    w->lamp.outer = zs_cos(ZS_DEGREES(50));
}

static const int32_t origin[3] = { 0, 0, 0 }, y_up[3] = { 0, 1, 0 };
static const int32_t in_metres[3] = { 0, 2, 4 }, beyond[3] = { 0, 5000, 9000 }, eye_usual[3] = { 0, 2500, 4500 };
static const uint8_t turned[3] = { 2, 1, 0 }, twice[3] = { 0, 0, 0 };
static zs_q1_15 no_normal[12][3], face_in[12][3];
static int16_t no_uv[8][2];
static const struct zs_rgb grey[12] = { { 128, 128, 128 } };
static const uint16_t raw_grey[12] = { 0x8410 };

static void face_normals_inwards(struct world *w)
{
    for (uint32_t t = 0; t < 12; t++) {
        zs_light_face_normal(face_in[t], &w->cube, t);
        for (int k = 0; k < 3; k++)
            face_in[t][k] = (zs_q1_15)-face_in[t][k];
    }
    w->cube.face_normal = (const zs_q1_15(*)[3])face_in;
}

/* Each is a line: a function for the table below. */
#define MAKE(name, ...) \
    static void name(struct world *w) \
    { \
        __VA_ARGS__; \
    }
MAKE(eye_in_metres, w->camera_err = zs_camera_look_at(&w->camera, in_metres, origin, y_up))
MAKE(looks_away, w->camera_err = zs_camera_look_at(&w->camera, eye_usual, beyond, y_up))
MAKE(orbit_in_degrees, w->camera_err = zs_camera_orbit(&w->camera, origin, 5000, 30, 20))
MAKE(orbit_of_5, w->camera_err = zs_camera_orbit(&w->camera, origin, 5, 0, ZS_DEGREES(20)))
MAKE(camera_0, memset(&w->camera, 0, sizeof w->camera))
MAKE(near_in_units, w->camera.z_near = 1000; w->camera.z_far = 20000)
MAKE(focal_in_px, w->camera.focal = 58)
MAKE(focal_q16, w->camera.focal = 58u << 16)
MAKE(eye_q16, w->camera.pos[1] *= 65536)
MAKE(pos_q16, w->instance[0].pose.pos[0] = 100 * 65536)
MAKE(scale_q8, w->instance[0].pose.scale = 256)
MAKE(no_scale, w->cube.scale = 0)
MAKE(mirrored, w->instance[0].pose.rot[0] *= -1)
MAKE(rgb_565, w->red.rgb.r = 28; w->red.rgb.g = 14; w->red.rgb.b = 5)
MAKE(rgb_of_1, w->red.rgb.r = 1; w->red.rgb.g = w->red.rgb.b = 0)
MAKE(vertex_rgb, no_colour(w); w->cube.vertex_rgb = grey)
MAKE(face_rgb, no_colour(w); w->cube.face_rgb = grey)
MAKE(face_raw, no_colour(w); w->cube.face_raw = raw_grey)
MAKE(n_tris_36, turn_triangles(w, twice); w->cube.n_tris = 36)
MAKE(half_empty, turn_triangles(w, twice))
MAKE(half_turned, turn_triangles(w, turned))
MAKE(radius_in_units, w->cube.radius = 2000)
MAKE(middle_off, w->cube.center[0] = 1000)
MAKE(normals_0, w->cube.normal = (const zs_q1_15(*)[3])no_normal)
MAKE(face_normals_0, w->cube.face_normal = (const zs_q1_15(*)[3])no_normal)
MAKE(uv_0, w->cube.uv = (const int16_t(*)[2])no_uv)
MAKE(palette_null, w->texture.palette = NULL)
MAKE(texel_null, w->texture.texel = NULL)
MAKE(format_null, w->texture.format = NULL)
MAKE(colors_0, w->texture.n_colors = 0)
MAKE(flat_with_texture, w->red.shader = &zs_shade_flat)
MAKE(smooth_with_texture, w->red.shader = &zs_shade_smooth)
MAKE(two_of_one, w->scene.n_instances = 2)
MAKE(in_one_place, w->instance[1].pose = w->instance[0].pose)
MAKE(glass_first, near_first(w))
MAKE(diffuse_1000, w->scene.light.diffuse = 1000; w->scene.light.ambient = 300)
MAKE(ambient_full, w->scene.light.ambient = w->scene.light.diffuse = ZS_Q16_ONE)
MAKE(from_behind, w->scene.light.dir[2] = -ZS_Q30_ONE)
MAKE(no_lamps, w->lighting.n_lamps = 0)
MAKE(lamp_range_1, w->lamp.range = 1)
MAKE(spot_away, w->lamp.dir[2] = ZS_Q30_ONE)
MAKE(spot_angles, w->lamp.inner = ZS_DEGREES(40); w->lamp.outer = ZS_DEGREES(50))
MAKE(no_lines, w->lines.primitive.n = 0)
MAKE(wide_lines, w->lines.width = 100)
MAKE(lines_of_none, w->red.shader = &zs_shade_none)
MAKE(no_text, w->item.kind = &zs_item_text)
MAKE(no_items, w->overlay.item = NULL)
MAKE(hooks_0, w->scene.n_resolves = 0)
MAKE(hook_null, w->scene.resolve = NULL)
MAKE(subpixel_16, w->config.subpixel_bits = 16)
MAKE(depth_24, w->config.depth_bits = 24)
MAKE(step_40000, w->instance[0].pose.scale = 40 * ZS_Q16_ONE)
MAKE(height_1, w->camera_err = zs_camera_perspective(&w->camera, ZS_DEGREES(45), 1, 1000, 20000);
     w->camera_err |= zs_camera_look_at(&w->camera, eye_usual, origin, y_up))

#define I0 "instance 0"
#define BLACK I0 " is black: its material's rgb is 0, and of its mesh, zs_shade_raw reads face_raw alone"
static const struct mistake more[] = {
    { "eye in metres", NULL, eye_in_metres, 0, "the camera is inside instance 0, whose radius is 3000" },
    { "looks away", NULL, looks_away, 0, I0 " is behind the camera: it ends * behind the eye" },
    { "orbit 30 20", NULL, orbit_in_degrees, 0, "the camera is turned by 30 and raised by 20, of 65536" },
    { "orbit of 5", NULL, orbit_of_5, 0, "the camera is inside instance 0" },
    { "camera 0", NULL, camera_0, ZS_ERR_CAMERA, "the camera is refused: near = 0 and far = 0" },
    { "near in units", NULL, near_in_units, 0, I0 " is out of view: it begins * beyond far = 0.305" },
    { "focal in px", NULL, focal_in_px, ZS_ERR_CAMERA, "the camera is refused: its focal length is 0 px" },
    { "focal in q16", NULL, focal_q16, 0, I0 ": * triangles are smaller than a pixel: it is 0.001 px" },
    { "height 1", NULL, height_1, 0, I0 ": * triangles are smaller than a pixel: it is 1.* px" },
    { "eye in q16", NULL, eye_q16, 0, I0 " is out of view: it begins * beyond far = 20000" },
    { "pos in q16", NULL, pos_q16, 0, I0 " is beside the picture: * 6553600 to the right" },
    { "scale in q8", NULL, scale_q8, 0, I0 ": * triangles are smaller than a pixel" },
    { "no scale", NULL, no_scale, 0, I0 ": * triangles are smaller than a pixel" },
    { "a step of 40000", NULL, step_40000, ZS_ERR_RANGE,
      I0 " is refused: it is too large: 2 steps, of 40000 world units each; steps of 32767 units are the most" },
    { "mirrored", NULL, mirrored, ZS_ERR_RANGE, I0 " is refused: pose.rot is no rotation" },
    { "rgb of 5 bits", NULL, rgb_565, 0, "all colours are dark: a channel of material.rgb has 8 bits" },
    { "rgb of 0 and 1", NULL, rgb_of_1, 0, "all that is drawn is black: colours, texture or lamps are" },
    { "vertex_rgb, flat", NULL, vertex_rgb, 0, BLACK },
    { "face_rgb, smooth", smooth, face_rgb, 0, BLACK },
    { "face_raw, flat", NULL, face_raw, 0, BLACK },
    { "n_tris of numbers", NULL, n_tris_36, 0, I0 ": 30 of 36 triangles name a vertex twice, and are never drawn" },
    { "an array half filled", NULL, half_empty, 0, I0 ": 6 of 12 triangles name a vertex twice" },
    { "wound both ways", NULL, half_turned, 0, I0 ": triangles 0 and * of its mesh are neighbours, and wound" },
    { "radius in units", NULL, radius_in_units, 0, I0 ": mesh.radius is 2000 steps of the mesh, and 2 holds" },
    { "centre", NULL, middle_off, 0, I0 " is out of view", 2 },
    { "normals 0", smooth, normals_0, 0, I0 ": all normals of its mesh are 0: it gets ambient light alone" },
    { "face normals 0", NULL, face_normals_0, 0, I0 ": all normals of its mesh are 0" },
    { "face normals inwards", NULL, face_normals_inwards, 0, I0 ": mesh.face_normal points away * 12 of 12" },
    { "uv 0", textured, uv_0, 0, I0 ": all of mesh.uv is the same: one texel is all that is seen" },
    { "no palette", textured, palette_null, ZS_ERR_NULL, I0 " is refused: its texture's palette is NULL" },
    { "no texel", textured, texel_null, ZS_ERR_NULL, I0 " is refused: its texture's texel is NULL" },
    { "no format", textured, format_null, ZS_ERR_NULL, I0 " is refused: its texture's format is NULL" },
    { "no colours", textured, colors_0, 0, I0 ": its texture has a palette whose number of colours" },
    { "a texture, flat", textured, flat_with_texture, 0, I0 " has a texture, and its shader reads none" },
    { "a texture, smooth", textured, smooth_with_texture, 0, I0 " has a texture, and its shader reads none" },
    { "two of one", NULL, two_of_one, ZS_ERR_NULL, "instance 1 is refused: mesh is NULL" },
    { "in one place", world_two, in_one_place, 0, "instance 1 is hidden by instance 0: the same mesh in the same" },
    { "glass first", glass_behind, glass_first, 0, "instance 1 is behind instance 0, which is transparent, and" },
    { "diffuse 1000", lit_right, diffuse_1000, 0, "the light's ambient is 300/65536, its diffuse 1000/65536: 1 is" },
    { "ambient full", lit_right, ambient_full, 0, "the light's ambient is full, so diffuse adds nothing" },
    { "from behind", lit_right, from_behind, 0, "the light falls on nothing that is seen: its dir points from" },
    { "no lamps", with_lamps, no_lamps, 0, "all that is drawn is black: * scene.light is none" },
    { "range 1", with_spot, lamp_range_1, 0, "all that is drawn is black: * at range, half and dir" },
    { "spot away", with_spot, spot_away, 0, "all that is drawn is black: * at range, half and dir" },
    { "spot angles", with_spot, spot_angles, ZS_ERR_RANGE, I0 " is refused: its material has a field out of range" },
    { "no lines", with_lines, no_lines, 0, I0 " has nothing to draw: the n of its lines or points is 0" },
    { "wide lines", with_lines, wide_lines, ZS_ERR_RANGE, I0 " is refused: the width of its lines, or the size" },
    { "lines of no colour", with_lines, lines_of_none, 0, I0 ": 4 triangles are drawn and colour no pixel" },
    { "no text", with_overlay, no_text, 0, "resolve hook 0 changes no pixel" },
    { "no items", with_overlay, no_items, 0, "resolve hook 0 changes no pixel" },
    { "n_resolves 0", with_overlay, hooks_0, 0, "scene.resolve is given, and no hook is called: n_resolves is 0" },
    { "no hook", with_overlay, hook_null, ZS_ERR_NULL, "scene.resolve, or draw of a hook, is NULL" },
    { "16 sub-pixel bits", NULL, subpixel_16, ZS_ERR_SIZE, "config.subpixel_bits is 16: it takes 8, or 4" },
    { "24 depth bits", NULL, depth_24, ZS_ERR_DEPTH, "config.depth_bits is 24: it takes 8 to 16" },
};

static void more_mistakes(void **state)
{
    CHECK_ALL(more);
}

/* ---- Mistakes in counts and sizes, which nothing else shows ------------------------------------ */

/* A picture of 2^w x 2^h texels, as pictures are: neighbours are alike, the borders are not. */
static void picture_565(struct world *w, uint32_t log2_w, uint32_t log2_h)
{
    static uint16_t image[64 * 64];
    struct prng p = { log2_w * 8 + log2_h };
    for (uint32_t i = 0; i < 1u << (log2_w + log2_h); i++) {
        const uint32_t x = i % (1u << log2_w), y = i >> log2_w;
        const uint32_t red = (x << 5 >> log2_w) * 7 / 8 + prng_pick(&p, 3), green = (y << 6 >> log2_h) * 7 / 8;
        image[i] = (uint16_t)(red << 11 | (green + prng_pick(&p, 5)) << 5 | (20u - (red >> 1)));
    }
    w->texture.format = &zs_texel_565;
    w->texture.texel = image;
    w->texture.palette = NULL;
    w->texture.log2_w = (uint8_t)log2_w;
    w->texture.log2_h = (uint8_t)log2_h;
}

/* The same with 16 colours. */
static void picture_pal4(struct world *w, uint32_t log2_w, uint32_t log2_h)
{
    static uint8_t number[64 * 64 / 2];
    static uint16_t greys[16];
    picture_565(w, log2_w, log2_h);
    const uint16_t *const image = w->texture.texel;
    memset(number, 0, sizeof number);
    for (uint32_t i = 0; i < 1u << (log2_w + log2_h); i++)
        number[i / 2] |= (uint8_t)(((image[i] >> 12) + (image[i] >> 7 & 15)) / 2 << i % 2 * 4);
    for (uint32_t k = 0; k < 16; k++)
        greys[k] = (uint16_t)(k << 12 | k << 7 | k << 1);
    w->texture.format = &zs_texel_pal4;
    w->texture.texel = number;
    w->texture.palette = greys;
    w->texture.n_colors = 16;
}

static void world_torus(struct world *w)
{
    static struct shape torus;
    shape_begin(&torus);
    shape_torus(&torus, 12, 8, 6000, 2500);
    shape_end(&torus);
    torus.mesh.scale = ZS_Q16_ONE / 6;
    torus.mesh.radius += 2;
    w->instance[0].mesh = &torus.mesh;
    w->config.max_tris = w->config.max_verts = 900;
    zs_pose_turn(&w->instance[0].pose, 0, ZS_DEGREES(60), 0);
}

static void with_orthographic(struct world *w)
{
    w->config.depth = &zs_depth_linear;
    w->camera.projection = ZS_ORTHOGRAPHIC;
    w->camera.height = (zs_q48_16)5000 << 16;
}

MAKE(wide_picture, textured(w); picture_565(w, 6, 4))
MAKE(high_picture, textured(w); picture_565(w, 4, 6))
MAKE(square_picture, textured(w); picture_565(w, 5, 5))
MAKE(wide_pal4, textured(w); picture_pal4(w, 6, 4))
MAKE(one_color, textured(w); w->texture.log2_w = w->texture.log2_h = 2)
MAKE(exchanged, const uint8_t h = w->texture.log2_h; w->texture.log2_h = w->texture.log2_w; w->texture.log2_w = h)
MAKE(log2_less, w->texture.log2_w--)
MAKE(log2_more, w->texture.log2_w++; w->texture.log2_h--)
MAKE(log2_0, w->texture.log2_w = w->texture.log2_h = 0)
MAKE(uv_bits_16, w->cube.uv_bits = 16)
MAKE(tris_3, w->cube.n_tris = 3)
MAKE(tris_6, w->cube.n_tris = 6)
MAKE(tris_of_half_a_sheet, w->sheet.n_tris = 64)
MAKE(near_in_it, w->camera.z_near = 5000 << 16)
MAKE(far_in_it, w->camera.z_far = 5200 << 16)
MAKE(without_depth, w->config.depth = &zs_depth_none)
MAKE(both_sides_without_depth, w->config.depth = &zs_depth_none; w->red.cull = ZS_CULL_NONE)
MAKE(front_culled, w->red.cull = ZS_CULL_FRONT)
MAKE(height_in_units, w->camera.height = 5000)
MAKE(face_rgb_smooth, w->cube.face_rgb = grey)
MAKE(vertex_rgb_flat, w->cube.vertex_rgb = grey)
MAKE(vertex_rgb_flat_green, w->cube.vertex_rgb = grey; w->red.rgb = (struct zs_rgb)ZS_RGB(0x00ff00))
MAKE(vertex_rgb_flat_blue, w->cube.vertex_rgb = grey; w->red.rgb = (struct zs_rgb)ZS_RGB(0x0000ff))
static const uint16_t side_beyond[4][2] = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 8 } };
MAKE(line_beyond, const struct zs_lines lines = { ZS_LINES(side_beyond, 4), .width = 2 }; w->lines = lines)

static const struct zs_depth_state no_keys = { .read_only = 1 };
MAKE(near_reads_only, const struct zs_instance near_one = w->instance[0]; w->instance[1].pose.pos[2] = -9000;
     w->instance[0] = near_one; w->instance[0].depth_state = &no_keys)
MAKE(far_reads_only, near_first(w); w->instance[0].pose.pos[2] = -9000; w->instance[0].depth_state = &no_keys)

static void ends_meet(struct world *w)
{
    w->camera.z_near = -100000 * (zs_q48_16)ZS_Q16_ONE;
    w->camera.z_far = w->camera.z_near + 1;
}

static void orthographic_far(struct world *w)
{
    w->camera.z_far = w->camera.z_near;
}

static void windows_under_hiz(struct world *w)
{
    w->red.shader = &zs_shade_window;
    w->config.method = &zs_method_hiz;
}

static void no_lines_macro(struct world *w)
{
    w->lines.primitive.ops = NULL;
}

/* In view, and so far away that a sub-pixel is too fine. */
static void far_and_low(struct world *w)
{
    w->camera.height = 65536 * 4;
    w->camera.z_far = (int64_t)ZS_WORLD_MAX * 65536;
    memset(w->camera.rot, 0, sizeof w->camera.rot);
    memset(w->camera.pos, 0, sizeof w->camera.pos);
    w->instance[0].pose.pos[2] = -15000000;
}

#define HOLE "its back is seen, which is not drawn: it has a hole"
#define ROWS_ARE(n) I0 ": the rows of its texture look " n " texels long, and log2_w is "
#define COLORS I0 ": its shader does not read the colours of its mesh"
static const struct mistake sizes[] = {
    { "near and far, orthographic", with_orthographic, orthographic_far, ZS_ERR_CAMERA,
      "the camera is refused: near = 1000 and far = 1000; near < far is needed: look at what zs_camera_orthographic" },
    { "windows under hiz", NULL, windows_under_hiz, ZS_ERR_DEPTH,
      I0 " is refused: its shader does not go with config.method, or with config.depth" },
    { "ZS_LINES", with_lines, no_lines_macro, ZS_ERR_NULL,
      I0 " is refused: material.primitive has no ops: ZS_LINES or ZS_POINTS sets it.\n" },
    { "near and far, next to each other", with_orthographic, ends_meet, ZS_ERR_NEAR,
      "the camera is refused: near = -100000 and far = -100000 are closer to each other than 2^-29 of the distance" },
    { "far and low", with_orthographic, far_and_low, ZS_ERR_RANGE,
      I0 " is refused: the camera's height is 4, too small for it" },
    { "3 of 12 triangles", NULL, tris_3, 0, I0 ": 1 of 8 vertices are in no triangle: is mesh.n_tris right? It is 3." },
    { "half of a sheet", world_sheet, tris_of_half_a_sheet, 0, I0 ": 36 of 81 vertices are in no triangle" },
    { "6 of 12 triangles", NULL, tris_6, 0, I0 ": on * pixels " HOLE " (is mesh.n_tris right?)" },
    { "6 of 12, smooth", smooth, tris_6, 0, I0 ": on * pixels " HOLE " (is mesh.n_tris right?)" },
    { "near in it", NULL, near_in_it, 0, "near = 5000 cuts instance 0, which begins 2852 before it: lower near.\n" },
    { "far in it", NULL, far_in_it, 0, "far = 5200 cuts instance 0, which ends 2948 beyond it: raise far.\n" },
    { "near in it, orthographic", with_orthographic, near_in_it, 0, "near = 5000 cuts instance 0" },
    { "far in it, orthographic", with_orthographic, far_in_it, 0, "far = 5200 cuts instance 0" },
    { "no depth memory, concave", world_torus, without_depth, 0, I0 " is not convex, and there is no depth memory" },
    { "no depth memory, both sides", NULL, both_sides_without_depth, 0, I0 " is not convex, and there is no" },
    { "read_only, and nearer", world_two, near_reads_only, 0,
      "instance 1 is behind instance 0, whose depth_state is read_only, and drawn over it: list it before.\n" },
    { "ZS_CULL_FRONT", NULL, front_culled, 0, I0 ": material.cull is ZS_CULL_FRONT: its far side is seen from inside" },
    { "height in units", with_orthographic, height_in_units, ZS_ERR_RANGE,
      I0 " is refused: the camera's height is 0.076, too small for it: was 5000 * 65536 meant?\n" },
    { "face_rgb, smooth, and red", smooth, face_rgb_smooth, 0, COLORS },
    { "vertex_rgb, flat, and red", NULL, vertex_rgb_flat, 0, COLORS },
    { "vertex_rgb, flat, and green", NULL, vertex_rgb_flat_green, 0, COLORS },
    { "vertex_rgb, flat, and blue", NULL, vertex_rgb_flat_blue, 0, COLORS },
    { "a line beyond", with_lines, line_beyond, 0, I0 ": 1 of its lines or points name a vertex that is not there" },
    { "log2_w for log2_h", wide_picture, exchanged, 0, ROWS_ARE("64") "4, which is 16: are log2_w and log2_h right" },
    { "log2_h for log2_w", high_picture, log2_more, 0, ROWS_ARE("16") "5, which is 32" },
    { "log2_w too small", wide_picture, log2_less, 0, ROWS_ARE("64") "5, which is 32" },
    { "log2_w too small, square", square_picture, log2_less, 0, ROWS_ARE("32") "4, which is 16" },
    { "log2_w too large", square_picture, log2_more, 0, ROWS_ARE("32") "6, which is 64" },
    { "log2_w too small, pal4", wide_pal4, log2_less, 0, ROWS_ARE("64") "5, which is 32" },
    { "log2_w too large, pal4", wide_pal4, exchanged, 0, ROWS_ARE("64") "4, which is 16" },
    { "log2 0", one_color, log2_0, 0, I0 ": its texture is one texel: log2_w and log2_h are 0; of 64, it is 6.\n" },
    { "uv_bits 16", textured, uv_bits_16, ZS_ERR_MESH, I0 " is refused: mesh.uv_bits is 16, and 15 is the most.\n" },
};

static void sizes_are_wrong(void **state)
{
    CHECK_ALL(sizes);
}

/* ---- More that is refused, and why nothing of an instance is drawn ----------------------------- */

/* The sphere of its mesh, of which a part is in view, reaches farther than its triangles. */
static void sphere_of_4(struct world *w)
{
    w->cube.radius = 4;
}

/* A sliver of 3 px between the samples. */
static void sliver(struct world *w)
{
    static const int16_t pos[3][3] = { { -200, -200, 0 }, { 200, 200, 0 }, { 203, 197, 0 } };
    static const uint16_t tri[1][3] = { { 0, 2, 1 } };
    w->sheet.pos = pos;
    w->sheet.tri = tri;
    w->sheet.n_verts = 3;
    w->sheet.n_tris = 1;
    w->sheet.radius = 284;
    w->sheet.scale = ZS_Q16_ONE * 6 / 10;
    w->instance[0].mesh = &w->sheet;
    w->instance[0].pose.pos[0] = 30;
    zs_pose_turn(&w->instance[0].pose, 0, 0, 0);
}

/* 3,200 triangles on a few pixels. */
static int16_t dense_pos[41 * 41][3];
static uint16_t dense_tri[3200][3];
static void dense(struct world *w)
{
    for (int v = 0; v < 41 * 41; v++) {
        dense_pos[v][0] = (int16_t)(v % 41 * 20 - 400);
        dense_pos[v][2] = (int16_t)(v / 41 * 20 - 400);
    }
    for (int t = 0; t < 3200; t++) {
        const int v = t / 2 / 40 * 41 + t / 2 % 40;
        const int of[2][3] = { { v, v + 41, v + 42 }, { v, v + 42, v + 1 } };
        for (int k = 0; k < 3; k++)
            dense_tri[t][k] = (uint16_t)of[t % 2][k];
    }
    w->sheet.pos = (const int16_t(*)[3])dense_pos;
    w->sheet.tri = (const uint16_t(*)[3])dense_tri;
    w->sheet.n_verts = 41 * 41;
    w->sheet.n_tris = 3200;
    w->sheet.scale = ZS_Q16_ONE * 7 / 4;
    w->instance[0].mesh = &w->sheet;
    w->config.max_tris = w->config.max_verts = 4000;
}

static const struct zs_depth_state func_9 = { .func = 9 };
MAKE(projection_7, w->camera.projection = 7)
MAKE(height_0, w->camera.height = 0)
MAKE(eye_beyond, w->camera.pos[1] = INT32_MIN)
MAKE(state_9, w->instance[0].depth_state = &func_9)
MAKE(verts_70000, w->cube.n_verts = 70000)
MAKE(instances_70000, w->scene.n_instances = 70000)
MAKE(pos_null, w->cube.pos = NULL)
MAKE(tri_null, w->cube.tri = NULL)
MAKE(texture_null, w->red.texture = NULL)
MAKE(diffuse_256, w->scene.light.diffuse = 256 * ZS_Q16_ONE)
MAKE(eye_beyond_orthographic, w->camera.pos[0] = INT32_MAX)
MAKE(height_most, w->camera.height = INT64_MAX)
MAKE(subpixel_5, w->config.subpixel_bits = 5)
MAKE(depth_bits_7, w->config.depth_bits = 7)
MAKE(light_dir_orthographic, w->scene.light.dir[0] = INT32_MAX)
MAKE(all_near, sphere_of_4(w); w->camera.z_near = 7300 << 16)
MAKE(all_far, sphere_of_4(w); w->camera.z_far = 3000 << 16)
MAKE(all_beside, sphere_of_4(w); w->instance[0].pose.pos[0] = 5500)
MAKE(away_or_beside, all_beside(w); w->cube.n_tris = 6)
MAKE(a_pixel_orthographic, with_orthographic(w); w->instance[0].pose.scale = ZS_Q16_ONE / 40)

static const struct mistake more_refused[] = {
    { "projection", NULL, projection_7, ZS_ERR_CAMERA, "the camera is refused: projection is 7.\n" },
    { "height 0", with_orthographic, height_0, ZS_ERR_CAMERA, "the camera is refused: its height is 0: zs_camera_o" },
    { "the eye", NULL, eye_beyond, ZS_ERR_RANGE, "the camera is refused: pos is 0 -2147483648 4500, and" },
    { "func", NULL, state_9, ZS_ERR_RANGE, I0 " is refused: depth_state.func is 9.\n" },
    { "n_verts", NULL, verts_70000, ZS_ERR_MESH, I0 " is refused: mesh.n_verts is 70000, and 65535 is the most.\n" },
    { "n_instances", NULL, instances_70000, ZS_ERR_SIZE, "scene.n_instances is 70000, and 65535 is the most.\n" },
    { "pos NULL", NULL, pos_null, ZS_ERR_MESH, I0 " is refused: mesh.pos is NULL.\n" },
    { "tri NULL", NULL, tri_null, ZS_ERR_MESH, I0 " is refused: mesh.tri is NULL.\n" },
    { "texture NULL", textured, texture_null, ZS_ERR_NULL,
      I0 " is refused: its shader needs what is NULL: material.texture, or more of its" },
    { "diffuse", NULL, diffuse_256, ZS_ERR_RANGE, "the light is refused: ambient is *, diffuse is 16777216" },
    { "the eye, orthographic", with_orthographic, eye_beyond_orthographic, ZS_ERR_RANGE,
      "the camera is refused: pos is 2147483647 2500 4500, and" },
    { "height, the most", with_orthographic, height_most, ZS_ERR_CAMERA, "the camera is refused: its height is " },
    { "light.dir, orthographic", with_orthographic, light_dir_orthographic, ZS_ERR_RANGE, "the light is refused: its" },
    { "subpixel_bits", NULL, subpixel_5, ZS_ERR_SIZE, "config.subpixel_bits is 5: it takes 8, or 4.\n" },
    { "depth_bits", NULL, depth_bits_7, ZS_ERR_DEPTH, "config.depth_bits is 7: it takes 8 to 16.\n" },
    { "before near", NULL, all_near, 0, I0 ": 12 of 12 triangles lie before near = 7300: move it away, or lower" },
    { "beyond far", NULL, all_far, 0, I0 ": 12 of 12 triangles lie beyond far = 3000: move it, or raise far.\n" },
    { "beside", NULL, all_beside, 0, I0 ": * of 12 triangles lie beside the picture, * face away: zs_camera_look_at" },
    { "away or beside", NULL, away_or_beside, 0, I0 ": 4 of 6 triangles face away, 2 lie beside the picture.\n" },
    { "a sliver", NULL, sliver, 0, I0 " is * px across and * ahead: raise its scale, or move it nearer.\n" },
    { "a pixel, orthographic", NULL, a_pixel_orthographic, 0,
      I0 ": * of 12 triangles are smaller than a pixel: it is * px across; raise its scale" },
    { "dense", NULL, dense, 0, "* triangles in view are smaller than a pixel: take a mesh of fewer.\n" },
};

static void more_is_refused(void **state)
{
    CHECK_ALL(more_refused);
}

/* zs_init, and what it is given. */
static void set_up_is_refused(void **state)
{
    (void)state;
    static uint32_t arena[20000];
    static const char *const because[] = { "the renderer is NULL.\n", "config is NULL.\n", "arena is NULL.\n",
                                           "the arena is not aligned to 4 bytes: ZS_ARENA defines one that is.\n" };
    struct zs_renderer r;
    struct world w;
    struct words words;
    world_cube(&w);
    for (unsigned k = 0; k < 4; k++) {
        void *const at = k == 2 ? NULL : k == 3 ? (char *)arena + 2 : (char *)arena;
        memset(&words, 0, sizeof words);
        const uint32_t said = zs_explain_init(k == 0 ? NULL : &r, k == 1 ? NULL : &w.config, at, sizeof arena - 4,
                                              hear, &words);
        assert_int_equal(said, 1);
        assert_string_equal(words.text, because[k]);
    }
    memset(&words, 0, sizeof words);
    assert_int_equal(zs_explain_init_build(&r, &w.config, arena, sizeof arena, hear, &words, ZS_BUILD + 1u), 1);
    assert_true(begins(words.text, "zs_init refuses: "));
    assert_non_null(strstr(words.text, zs_error_string(ZS_ERR_BUILD)));
}

/* ---- Mistakes in parts, while the rest is right ----------------------------------------------- */

static void two_apart(struct world *w)
{
    world_two(w);
    w->instance[1].mesh = &w->sheet;
    w->instance[0].pose.scale = w->instance[1].pose.scale = ZS_Q16_ONE / 4;
    w->instance[0].pose.pos[0] = -1200;
    w->instance[1].pose.pos[0] = 1200;
    w->instance[1].pose.pos[2] = 0;
}

static void ramp(struct world *w)
{
    static const int16_t along[8][2] = { { 0, 0 }, { 0, 4096 }, { 0, 4096 }, { 0, 0 },
                                         { 0, 0 }, { 0, 4096 }, { 0, 4096 }, { 0, 0 } };
    textured(w);
    w->cube.uv = along;
    w->texture.log2_w = 0;
}

static void two_in_order(struct world *w)
{
    two_without_depth(w);
    w->config.depth = &zs_depth_float;
}

static void two_items(struct world *w)
{
    static struct zs_item item[2];
    with_overlay(w);
    item[0] = item[1] = w->item;
    item[1].kind = &zs_item_text;
    item[1].text = "HUD";
    w->overlay.item = item;
    w->overlay.n = 2;
}

static void two_dials(struct world *w)
{
    two_items(w);
    struct zs_item *const dial = (struct zs_item *)(uintptr_t)&w->overlay.item[1];
    const struct zs_item arc = { .kind = &zs_item_arc, .x = 40, .y = 30, .w = 12, .h = 3, .color = 0xffff,
                                 .value = 40000, .sweep = ZS_DEGREES(270) };
    *dial = arc;
}

static struct zs_item *second_item(struct world *w)
{
    return (struct zs_item *)(uintptr_t)&w->overlay.item[1];
}

/* Every other column is left out. */
static void columns(const struct zs_instance *instance, struct zs_fragment *f)
{
    (void)instance;
    if (f->x & 1u)
        *f->color = zs_wire565(200, 90, 30);
}

static void raised(const struct zs_shading *s, uint32_t v, int16_t out[3])
{
    (void)s;
    for (int k = 0; k < 3; k++)
        out[k] = corner[v][k];
}

static void shade_1(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    (void)s;
    out[0] = (uint16_t)(v * 8000u);
}

static struct zs_shader own;

static void own_shader(struct world *w)
{
    const struct zs_shader mine = { .fragment = columns, ZS_FRAGMENTS, .vertex = shade_1, .n_varyings = 1,
                                    .position = raised, ZS_POSITIONS };
    own = mine;
    two_in_order(w);
    near_first(w);
    w->config.width = 8 * W; /* wide enough for accelerators to rely on it */
    w->config.height = 8 * H;
    w->camera.focal *= 8;
    w->green.shader = &zs_shade_raw;
    w->red.shader = &own;
}

static void edges_before_faces(struct world *w)
{
    static const uint16_t side[4][2] = { { 4, 5 }, { 5, 6 }, { 6, 7 }, { 7, 4 } };
    static const struct zs_depth_state back = ZS_HIDDEN_LINE_STATE;
    const struct zs_lines lines = { ZS_LINES(side, 4), .width = 1 };
    w->config.depth = &zs_depth_recip;
    world_two(w);
    w->lines = lines;
    w->instance[1].pose = w->instance[0].pose;
    w->instance[0].depth_state = &back;
    w->green.shader = &zs_shade_plain;
    w->green.primitive = &w->lines.primitive;
}

static const struct zs_depth_state always = { .func = ZS_DEPTH_ALWAYS }, near_bias = { .bias = -30000 },
                                   far_bias = { .bias = 30000 };
static uint16_t face_1[12][3];
static void indices_from_1(struct world *w)
{
    for (int t = 0; t < 12; t++)
        for (int k = 0; k < 3; k++)
            face_1[t][k] = (uint16_t)(face[t][k] + 1);
    w->cube.tri = (const uint16_t(*)[3])face_1;
}

static struct zs_dither dither = { .format = &zs_dither_grey4, .pattern = &zs_dither_ordered };

static void with_dither(struct world *w)
{
    dither.pattern = &zs_dither_ordered;
    w->hook.draw = zs_dither_draw;
    w->hook.ctx = &dither;
    w->scene.resolve = &w->hook;
    w->scene.n_resolves = 1;
}

static void point_lamp(struct world *w)
{
    with_lamps(w);
    w->lamp.kind = ZS_LAMP_POINT;
    w->lamp.pos[1] = 3000;
    w->lamp.pos[2] = 4000;
    w->lamp.dir[2] = 0;
}

static void with_stipple(struct world *w)
{
    with_glass(w);
    w->glass.material.shader = &zs_stipple_flat;
}

MAKE(alpha_1, w->glass.alpha = 1)
MAKE(fog_not_set, memset(w->fog.from, 0, sizeof w->fog.from))
MAKE(fog_beyond_far, w->fog.start = 30000; w->fog.end = 60000;
     w->fog_err = zs_fog_set(&w->fog, &w->config, &w->camera))
MAKE(fog_without_depth, w->config.depth = &zs_depth_none)
MAKE(lamp_in_it, w->lamp.pos[1] = w->lamp.pos[2] = 0)
MAKE(lamp_far, w->lamp.pos[1] = w->lamp.pos[2] = 4000 << 10; w->lamp.half = 4000)
MAKE(strength_of_255, w->lamp.strength = 255)
MAKE(strength_5, w->lamp.strength = 5 * ZS_Q16_ONE)
MAKE(five_lamps, w->lighting.n_lamps = 5)
MAKE(shine_not_set, memset(&w->shine, 0, sizeof w->shine))
MAKE(no_pattern, dither.pattern = NULL)
MAKE(levels_of_nothing, w->texture.n_levels = 9)
MAKE(raycast_glass, w->config.method = &zs_method_raycast)
MAKE(item_clear, w->item.clear = 255)
MAKE(text_of_size_9, w->item.kind = &zs_item_text; w->item.text = "HUD"; w->item.size = 9)
MAKE(scale_below_0, w->instance[0].pose.scale = (zs_uq16_16)-65536)
MAKE(far_in_second, w->camera.z_far = 9000 << 16)
MAKE(near_in_first, w->camera.z_near = 4000 << 16)
MAKE(log2_w_0, w->texture.log2_w = 0)
MAKE(log2_h_0, w->texture.log2_h = 0)
MAKE(far_always, w->instance[1].depth_state = &always; near_first(w); w->instance[0].depth_state = NULL;
     w->instance[1].depth_state = &always)
MAKE(torus_always, w->instance[0].depth_state = &always)
MAKE(far_biased, w->instance[0].depth_state = &near_bias)
MAKE(near_biased, w->instance[1].depth_state = &far_bias)
MAKE(item_off, second_item(w)->x = 64)
MAKE(item_no_text, second_item(w)->text = NULL)
MAKE(item_no_sprite, second_item(w)->kind = &zs_item_sprite)
MAKE(sweep_270, second_item(w)->sweep = 270)
MAKE(not_opaque, own.opaque = 1)
MAKE(no_positions, own.place = NULL)
MAKE(no_fragments, own.start = NULL; own.run = NULL; own.by_fragment = 0)
MAKE(fragment_null, own.fragment = NULL)
MAKE(copied_run, own.start = zs_shade_raw.start; own.run = zs_shade_raw.run; own.by_fragment = 0)
MAKE(varyings_0, own.n_varyings = 0)
MAKE(edges_in_faces, w->instance[0].depth_state = NULL)
static const struct zs_points all_points = { ZS_POINTS(NULL, 8), .size = 3 };
MAKE(points_in_faces, w->green.primitive = &all_points.primitive; edges_in_faces(w))

static const struct mistake partial[] = {
    { "far in one of two", world_two, far_in_second, 0,
      "far = 9000 cuts instance 1, which ends * beyond it: raise far.\n" },
    { "near in one of two", world_two, near_in_first, 0, "near = 4000 cuts instance 0, which begins" },
    { "a hole beside another", two_apart, tris_6, 0, I0 ": on * pixels " HOLE },
    { "log2_w 0", textured, log2_w_0, 0,
      I0 ": its texture is one texel wide, and mesh.uv runs across it: log2_w is 0" },
    { "log2_h 0", textured, log2_h_0, 0,
      I0 ": its texture is one texel high, and mesh.uv runs across it: log2_h is 0" },
    { "far always", two_in_order, far_always, 0,
      "instance 1 is behind instance 0, and drawn over it: its depth_state" },
    { "concave always", world_torus, torus_always, 0,
      I0 " is not convex, and its depth_state.func is ZS_DEPTH_ALWAYS" },
    { "far one biased", two_in_order, far_biased, 0, I0 " is behind instance 1, and drawn over it: * depth keys lie" },
    { "near one biased", two_in_order, near_biased, 0,
      I0 " is behind instance 1, and drawn over it: * depth keys lie" },
    { "an item off", two_items, item_off, 0, "item 1 of resolve hook 0 lies beside the picture, which is 64 x 48" },
    { "an item without text", two_items, item_no_text, 0,
      "item 1 of resolve hook 0 is not drawn: a required pointer is NULL.\n" },
    { "an item without sprite", two_items, item_no_sprite, 0,
      "item 1 of resolve hook 0 is not drawn: a required pointer is NULL.\n" },
    { "a sweep of 270", two_dials, sweep_270, 0, "item 1 of resolve hook 0 sweeps over 270/65536 of a turn: was" },
    { "opaque, and not", own_shader, not_opaque, 0,
      "without accelerators it is another picture: a shader that leaves" },
    { "no ZS_POSITIONS", own_shader, no_positions, 0, I0 ": its shader's position is not called: ZS_POSITIONS" },
    { "no ZS_FRAGMENTS", own_shader, no_fragments, ZS_ERR_NULL, I0 " is refused: its shader has no ZS_FRAGMENTS" },
    { "no fragment", own_shader, fragment_null, ZS_ERR_NULL, I0 " is refused: its shader's fragment stage is NULL" },
    { "run of another", own_shader, copied_run, 0, I0 ": its shader's fragment is not called: ZS_FRAGMENTS" },
    { "n_varyings 0", own_shader, varyings_0, ZS_ERR_VARYINGS, I0 " is refused: its shader has a vertex stage, and" },
    { "indices from 1", NULL, indices_from_1, 0,
      I0 ": triangle 1 of its mesh names vertex 8, and none names vertex 0" },
    { "alpha 1", with_glass, alpha_1, 0, I0 ": 6 triangles are drawn and colour no pixel: alpha is 0" },
    { "stipple 1", with_stipple, alpha_1, 0, I0 ": 6 triangles are drawn and colour no pixel: alpha is 0" },
    { "fog not set", with_fog, fog_not_set, 0, "resolve hook 0 gives all that is drawn one colour" },
    { "fog beyond far", with_fog, fog_beyond_far, 0, "resolve hook 0 changes no pixel" },
    { "fog without depth", with_fog, fog_without_depth, 0, "resolve hook 0 changes no pixel" },
    { "lamp in it", point_lamp, lamp_in_it, 0, "all that is drawn is black: * look at strength" },
    { "lamp far", point_lamp, lamp_far, 0, "all that is drawn is black: * at range, half and dir" },
    { "strength 255", with_lamps, strength_of_255, 0, "all that is drawn is black: * look at strength: 1 is" },
    { "strength 5", with_lamps, strength_5, ZS_ERR_RANGE,
      I0 " is refused: its material has a field out of range: lamps" },
    { "five lamps", with_lamps, five_lamps, ZS_ERR_RANGE,
      I0 " is refused: its material has a field out of range: lamps" },
    { "shine not set", with_lamps, shine_not_set, ZS_ERR_RANGE, I0 " is refused: its material * zs_shine_set has not" },
    { "no pattern", with_dither, no_pattern, 0, "resolve hook 0 changes no pixel" },
    { "levels of nothing", textured, levels_of_nothing, 0, I0 ": its texture has more mipmap levels than" },
    { "glass by rays", with_glass, raycast_glass, 0,
      I0 ": its shader mixes with what is behind it, and config.method" },
    { "clear 255", with_overlay, item_clear, 0, "resolve hook 0 changes no pixel" },
    { "text of size 9", with_overlay, text_of_size_9, 0, "resolve hook 0 changes no pixel" },
    { "a scale below 0", NULL, scale_below_0, ZS_ERR_RANGE, I0 " is refused: it is too large: 2 steps" },
    { "edges in faces", edges_before_faces, edges_in_faces, 0,
      "instance 1: its lines or points lie in the surface of instance 0, which hides parts: give instance 0 the" },
    { "points in faces", edges_before_faces, points_in_faces, 0,
      "instance 1: its lines or points lie in the surface of instance 0" },
};

static void parts_of_it_are_wrong(void **state)
{
    CHECK_ALL(partial);
}

/* ---- The cause of a refusal, and no other ---------------------------------------------------- */

static void too_many_lines(struct world *w)
{
    static const uint16_t side[13][2] = { { 0, 1 } };
    const struct zs_lines lines = { ZS_LINES(side, 13) };
    w->lines = lines;
    w->red.primitive = &w->lines.primitive; /* the shader reads face_rgb */
}

static void lit_lines(struct world *w)
{
    with_lamps(w);
    with_lines(w);
    w->lit.material.primitive = &w->lines.primitive;
    w->lamp.strength = 5 * ZS_Q16_ONE;
}

static void matcap(struct world *w)
{
    textured(w);
    w->red.shader = &zs_shade_matcap;
    w->cube.uv_bits = 2;
}

static void mipmap_9(struct world *w)
{
    textured(w);
    w->red.shader = &zs_shade_mipmap;
    w->texture.n_levels = 9;
}

/* Beyond far, too, what is out of range is refused. */
static void wide_and_far(struct world *w)
{
    with_lines(w);
    w->lines.width = 64;
    w->camera.focal = (zs_uq32_32)20 << 32;
    w->instance[0].pose.pos[2] = -(1 << 28);
}

static void wide_and_high(struct world *w)
{
    with_orthographic(w);
    with_lines(w);
    w->lines.width = 64;
    w->camera.height = (zs_q48_16)1 << 46;
}

static const struct zs_depth_state far_shadow = { .bias = 5, .slope_bias = 2 };
static void shadow_away(struct world *w)
{
    w->red.shader = &zs_shade_shadow;
    w->instance[0].depth_state = &far_shadow;
}

static void perspective_map(struct world *w)
{
    static uint16_t key[8 * 8];
    static uint32_t arena[4000];
    static struct zs_shadow_map map = { .key = key, .w = 8, .h = 8 };
    static struct zs_shadowed_material shadowed;
    const struct zs_scene empty = { .n_instances = 0 };
    const struct zs_config c = { .width = 8, .height = 8, .strip_h = 8, .max_tris = 9, .max_verts = 9,
                                 .depth = &zs_depth_recip };
    struct zs_renderer r;
    struct zs_camera at;
    assert_int_equal(zs_init(&r, &c, arena, sizeof arena), ZS_OK);
    assert_int_equal(zs_camera_perspective(&at, ZS_DEGREES(60), 8, 500, 12000), ZS_OK);
    assert_int_equal(zs_shadow_map_draw(&map, &r, &empty, &at), ZS_OK);
    shadowed.material = w->red;
    shadowed.material.shader = &zs_shade_shadowed_flat;
    shadowed.map = &map;
    w->instance[0].material = &shadowed.material;
}

MAKE(lines_null, with_lines(w); w->lines.line = NULL)
MAKE(pool_of_2, w->config.max_tris = 2; w->config.max_verts = 6)
MAKE(far_close, w->camera.z_far = w->camera.z_near + 999)
MAKE(far_beyond, w->camera.z_far = ((zs_q48_16)ZS_FAR_MAX + 1) * 65536)
MAKE(low, with_orthographic(w); w->camera.height = 8)
MAKE(transparent_1, w->config.method = &zs_method_transparent; w->config.max_tris = 1)
MAKE(raycast_3, w->config.method = &zs_method_raycast; w->config.max_tris = 3; w->config.max_verts = 5)

#define ENDS "near is at most 2^29, far 2^44, far - near at least far / 65536.\n"
static const struct mistake causes[] = {
    { "lines, small pools", with_lines, pool_of_2, ZS_OK,
      "the frame takes * passes; one needs max_tris 8 (it is 2) max_verts 24 (it is 6).\n" },
    { "more lines than triangles", NULL, too_many_lines, ZS_ERR_MESH,
      I0 " is refused: it has 13 lines or points, and its mesh 12 triangles, of which its shader reads the colours: "
      "zs_shade_plain takes any.\n" },
    { "lines NULL", NULL, lines_null, ZS_ERR_NULL, I0 " is refused: its lines are NULL: ZS_LINES sets them.\n" },
    { "lit lines", NULL, lit_lines, ZS_ERR_RANGE,
      I0 " is refused: its material has a field out of range: lamps, flags, a shine that zs_shine_set has not set, "
      "or a shadow map too fine for its size.\n" },
    { "matcap", NULL, matcap, ZS_ERR_MESH,
      I0 " is refused: mesh.uv_bits is 2, and its texture's log2_w 2, log2_h 2: its shader takes more bits than "
      "both, 15 at most.\n" },
    { "nine levels", NULL, mipmap_9, ZS_ERR_TEXTURE,
      I0 " is refused: its texture's log2_w is 2, log2_h 2, clamp 0, n_levels 9: it has no room for so many levels "
      "(zs_filter.h).\n" },
    { "wide lines, far away", NULL, wide_and_far, ZS_ERR_RANGE,
      I0 " is refused: its lines or points reach 536870912 world units beyond it: for their width, the camera's focal "
      "length of 20 px is too short, or its height too large.\n" },
    { "wide lines, orthographic", NULL, wide_and_high, ZS_ERR_RANGE,
      I0 " is refused: its lines or points reach 536870912 world units beyond it" },
    { "a shadow's bias", NULL, shadow_away, ZS_ERR_RANGE,
      I0 " is refused: its depth_state has .bias 5, .slope_bias 2, .read_only 0, .func 0: its shader takes a bias "
      "below 0 alone.\n" },
    { "a perspective map", NULL, perspective_map, ZS_ERR_CAMERA,
      I0 " is refused: its shadow map was drawn by a perspective camera: zs_shade_shadowed_lit takes those, and its "
      "shader takes orthographic ones.\n" },
    { "far - near", NULL, far_close, ZS_ERR_CAMERA, "the camera is refused: near = 1000 and far = 1000: " ENDS },
    { "far, the most", NULL, far_beyond, ZS_ERR_CAMERA,
      "the camera is refused: near = 1000 and far = 17592186044417: " ENDS },
    { "a low height", NULL, low, ZS_ERR_RANGE,
      "the camera is refused: its height is 0, too small beside near = 1000: was 8 * 65536 meant?\n" },
    { "transparent", NULL, transparent_1, ZS_ERR_SIZE, "for config.method, max_tris is 1: it takes 2 to 65534.\n" },
    { "raycast", NULL, raycast_3, ZS_ERR_SIZE,
      "for config.method, max_tris is 3: it takes 4 to 65534.\n"
      "for config.method, max_verts is 5: it takes 6 to 65534.\n", 2 },
};

static void causes_are_right(void **state)
{
    CHECK_ALL(causes);
}

/* A large picture without accelerators is slow. */
static void no_accelerators(void **state)
{
    struct world w;
    struct words words;
    uint32_t said;
    for (int large = 0; large < 2; large++) {
        world_cube(&w);
        w.config.fast = NULL;
        w.config.width = large ? 320 : W;
        w.config.height = large ? 240 : H;
        w.camera.focal *= (uint32_t)(w.config.height / H);
        assert_int_equal(world_hear(&w, &words, &said), ZS_OK);
        assert_int_equal(said, large);
    }
    assert_non_null(strstr(words.text, "config.fast is NULL: accelerators (zs_fast.h) draw the same frame in less"));
}

/* ---- Nothing is wrong ------------------------------------------------------------------------ */

/* All demo and bench scenes, as boards draw them. */
static void scenes_are_right(void **state)
{
    static struct demo_frame f;
    for (uint32_t d = 0; d < n_demos; d++)
        for (uint32_t t = 0; t < demos[d]->frames; t += demos[d]->frames / 3u + 1u) {
            const struct demo *demo = demos[d];
            struct world w;
            struct words words;
            uint32_t said;
            world_cube(&w);
            demo->pose(&f, t, demo->width, demo->height);
            w.config = picture_config(demo->width, demo->height, demo->depth);
            w.config.max_tris = w.config.max_verts = 20000;
            w.config.strip_h = 24;
            w.config.fast = demo->fast;
            w.scene = f.scene;
            w.camera = f.camera;
            const int err = world_hear(&w, &words, &said);
            if (err || said)
                fail_msg("%s, frame %u: %s\n%s", demo->name, t, zs_error_string(err), words.text);
        }
}

/* The examples, each as it calls zs_render (tests.mk wraps the calls). */
static struct words words_of_examples;
static int listening;
static uint32_t said_of_examples, frames_of_examples, passes_of_examples;

int __real_zs_render(struct zs_renderer *r, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_sink *sink);
int __wrap_zs_render(struct zs_renderer *r, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_sink *sink);
int __wrap_zs_render(struct zs_renderer *r, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_sink *sink)
{
    const int err = __real_zs_render(r, scene, camera, sink);
    if (listening) {
        said_of_examples += zs_explain(r, scene, camera, hear, &words_of_examples);
        frames_of_examples++;
    }
    return err;
}

int __real_zs_render_passes(struct zs_renderer *r, const struct zs_pass *pass, struct zs_pass_memory *memory,
                            uint32_t n, const struct zs_sink *sink);
int __wrap_zs_render_passes(struct zs_renderer *r, const struct zs_pass *pass, struct zs_pass_memory *memory,
                            uint32_t n, const struct zs_sink *sink);
int __wrap_zs_render_passes(struct zs_renderer *r, const struct zs_pass *pass, struct zs_pass_memory *memory,
                            uint32_t n, const struct zs_sink *sink)
{
    const int err = __real_zs_render_passes(r, pass, memory, n, sink);
    for (uint32_t k = 0; listening && k < n; k++)
        said_of_examples += zs_explain(r, pass[k].scene, pass[k].camera, hear, &words_of_examples);
    passes_of_examples += n;
    return err;
}

static int no_panel(void *ctx, const struct zs_strip *strip)
{
    (void)ctx;
    (void)strip;
    return 0;
}

static void examples_are_right(void **state)
{
#define EXAMPLE(name) { #name, example_##name },
    static const struct {
        const char *name;
        int (*draw)(uint32_t, const struct zs_sink *);
    } example[] = { EXAMPLES(EXAMPLE) };
    const struct zs_sink sink = { .submit = no_panel };
    const uint32_t n = sizeof example / sizeof example[0];
    listening = 1;
    for (uint32_t k = 0; k < n; k++)
        for (uint32_t t = 0; t < 3; t++) {
            if (example[k].draw == example_explain && t > 0)
                continue; /* wrong on purpose */
            memset(&words_of_examples, 0, sizeof words_of_examples);
            said_of_examples = 0;
            assert_int_equal(example[k].draw(t, &sink), ZS_OK);
            if (said_of_examples)
                fail_msg("%s, frame %u: %s", example[k].name, t, words_of_examples.text);
        }
    listening = 0;
    assert_true(frames_of_examples > 40 && passes_of_examples > 10);
}

/* What is unusual, and right. */
static void sky_fill(void *ctx, uint16_t *out, uint16_t x, uint16_t y, uint16_t n)
{
    (void)ctx;
    (void)x;
    for (uint16_t i = 0; i < n; i++)
        out[i] = zs_wire565((uint8_t)y, 100, 200);
}

static void night(struct world *w)
{
    w->scene.light.ambient = 1; /* as zs_light says */
}

static void sky_alone(struct world *w)
{
    static const struct zs_background sky = { .fill = sky_fill };
    w->scene.sky = &sky;
    w->scene.n_instances = 0;
}

static void tall_strips(struct world *w)
{
    w->config.strip_h = 65535;
}

static void a_far_one_more(struct world *w)
{
    world_two(w);
    w->instance[1].pose.pos[2] = -500000;
}

static void an_empty_one_more(struct world *w)
{
    world_two(w);
    w->instance[1].mesh = &w->sheet;
    w->sheet.n_tris = 0;
}

static void black_beside_red(struct world *w)
{
    world_two(w);
    memset(&w->green.rgb, 0, sizeof w->green.rgb);
}

static void inside_a_room(struct world *w)
{
    world_two(w);
    w->instance[1].pose.scale = 9 * ZS_Q16_ONE;
    w->instance[1].pose.pos[0] = w->instance[1].pose.pos[2] = 0;
    w->instance[1].mesh = &w->sheet; /* stands for the mesh of the room */
    w->sheet = w->cube;
    w->sheet.tri = (const uint16_t(*)[3])face_inwards;
}

static void hull(struct world *w)
{
    world_two(w);
    w->green.cull = ZS_CULL_FRONT; /* an outline: its far side, a bit larger */
    w->instance[1].pose = w->instance[0].pose;
    w->instance[1].pose.scale = ZS_Q16_ONE * 17 / 16;
}

static void small_steps(struct world *w)
{
    static int16_t fine[8][3];
    for (int v = 0; v < 8; v++)
        for (int k = 0; k < 3; k++)
            fine[v][k] = (int16_t)(corner[v][k] * 18000);
    w->cube.pos = (const int16_t(*)[3])fine;
    w->cube.radius = 31178;
    w->cube.scale = 3641; /* of 65536: 1,000 units */
}

static void few_bits(struct world *w)
{
    w->config.depth_bits = 10;
    w->config.subpixel_bits = 4;
}

static void far_ones_first(struct world *w)
{
    two_without_depth(w);
}

static void methods(struct world *w)
{
    two_without_depth(w);
    near_first(w);
    w->config.method = &zs_method_painter;
    w->config.max_tris = 400;
}

static void light_unused(struct world *w)
{
    w->red.shader = &zs_shade_raw;
    w->scene.light.dir[0] = ZS_Q30_ONE;
}

static void normals_of_half(struct world *w)
{
    static zs_q1_15 half[8][3];
    smooth(w);
    for (int v = 0; v < 8; v++)
        for (int k = 0; k < 3; k++)
            half[v][k] = v < 4 ? normal_inwards[v][k] : normal[v][k];
    w->cube.normal = (const zs_q1_15(*)[3])half;
}

static void turned_by_both(struct world *w)
{
    zs_pose_turn(&w->instance[0].pose, ZS_DEGREES(25), 0, 90);
}

static void a_grain(struct world *w)
{
    world_two(w);
    w->instance[1].mesh = &w->sheet;
    w->sheet = w->cube;
    w->sheet.scale = 5000;
}

static void sheet_below_overlay(struct world *w)
{
    world_sheet(w);
    with_overlay(w);
}

static void fog_behind(struct world *w)
{
    with_fog(w);
    w->fog.start = 15000;
    w->fog.end = 19000;
    assert_int_equal(zs_fog_set(&w->fog, &w->config, &w->camera), ZS_OK);
}

static void telescope(struct world *w)
{
    static const int32_t middle[3] = { 0, 0, 0 };
    assert_int_equal(zs_camera_perspective(&w->camera, ZS_DEGREES(2), H, 50000, 200000), ZS_OK);
    assert_int_equal(zs_camera_orbit(&w->camera, middle, 120000, ZS_DEGREES(10), ZS_DEGREES(20)), ZS_OK);
}

/* A backdrop: drawn first, without keys. */
static void backdrop(struct world *w)
{
    world_two(w);
    far_reads_only(w);
}

static void unusual_is_right(void **state)
{
    static void (*const change[])(struct world *) = { backdrop,
                                                      ramp,
                                                      with_dither,
                                                      point_lamp,
                                                      with_stipple,
                                                      two_apart,
                                                      two_in_order,
                                                      two_items,
                                                      two_dials,
                                                      own_shader,
                                                      edges_before_faces,
                                                      light_unused,
                                                      normals_of_half,
                                                      turned_by_both,
                                                      a_grain,
                                                      sheet_below_overlay,
                                                      fog_behind,
                                                      telescope,
                                                      night,
                                                      sky_alone,
                                                      tall_strips,
                                                      a_far_one_more,
                                                      an_empty_one_more,
                                                      black_beside_red,
                                                      inside_a_room,
                                                      hull,
                                                      small_steps,
                                                      few_bits,
                                                      far_ones_first,
                                                      methods,
                                                      with_overlay,
                                                      with_fog,
                                                      with_glass,
                                                      with_lamps,
                                                      textured,
                                                      small_and_low,
                                                      smooth };
    for (size_t k = 0; k < sizeof change / sizeof change[0]; k++) {
        struct world w;
        char name[32];
        world_cube(&w);
        change[k](&w);
        (void)snprintf(name, sizeof name, "unusual %zu", k);
        assert_right(&w, name);
    }
}

/* ---- Random scenes in which nothing is wrong -------------------------------------------------- */

static int32_t either(struct prng *p, int32_t most)
{
    return prng_range(p, -most, most);
}

static void random_shape(struct prng *p, struct shape *s, uint32_t kinds)
{
    shape_begin(s);
    switch (prng_pick(p, kinds)) {
    case 0:
        shape_sphere(s, 4 + prng_pick(p, 8), 5 + prng_pick(p, 12), prng_range(p, 300, 9000));
        break;
    case 1:
        shape_torus(s, 6 + prng_pick(p, 8), 5 + prng_pick(p, 8), prng_range(p, 3000, 9000), prng_range(p, 300, 1500));
        break;
    default:
        shape_ground(s, 4 + prng_pick(p, 8), prng_range(p, 2000, 9000), 200, 1 + prng_pick(p, 1000));
    }
    shape_end(s);
}

/* Some shapes in front of a camera, by any shader, light, mapping, strips, pools and accelerators; one of them, in the
 * middle, is surely seen. Some of the others may be out of view, hidden, or far. */
static int right_case(uint64_t seed)
{
    static const struct zs_shader *const shader[3] = { &zs_shade_raw, &zs_shade_flat, &zs_shade_smooth };
    static struct shape shape[3];
    struct prng p = { seed };
    struct world w;
    struct words words;
    struct zs_material material[3];
    uint32_t said, n = 0;
    int32_t at[3] = { either(&p, 100000), either(&p, 100000), either(&p, 100000) };
    world_cube(&w);
    memset(material, 0, sizeof material);
    memset(w.instance, 0, sizeof w.instance);
    w.scene.n_instances = 1 + prng_pick(&p, 3);
    for (uint32_t i = 0; i < w.scene.n_instances; i++) {
        struct zs_instance *in = &w.instance[i];
        random_shape(&p, &shape[i], i ? 3 : 2); /* a ground may be seen edge on */
        shape[i].mesh.scale = (zs_uq16_16)prng_range(&p, 3000, 300000);
        shape[i].mesh.pos_lo = prng_pick(&p, 2) ? (const uint8_t(*)[3])shape[i].pos_lo : NULL;
        shape[i].mesh.radius += 2;
        const uint32_t paint = prng_pick(&p, 2);
        material[i].shader = shader[prng_pick(&p, 3)];
        if (paint || material[i].shader != &zs_shade_flat)
            shape[i].mesh.face_rgb = NULL;
        if (paint || material[i].shader != &zs_shade_smooth)
            shape[i].mesh.vertex_rgb = NULL;
        material[i].rgb.r = (uint8_t)prng_range(&p, 60, 255);
        material[i].rgb.g = (uint8_t)prng_pick(&p, 256);
        material[i].rgb.b = (uint8_t)prng_pick(&p, 256);
        material[i].cull = (uint8_t)(i || shape[i].mesh.n_verts == 0 ? ZS_CULL_BACK : ZS_CULL_NONE);
        in->mesh = &shape[i].mesh;
        in->material = &material[i];
        zs_pose_turn(&in->pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), (zs_turn)prng_next(&p));
        n += shape[i].mesh.n_tris;
    }
    const int32_t radius = (int32_t)((uint64_t)shape[0].mesh.radius * shape[0].mesh.scale >> 16);
    const int32_t distance = radius * prng_range(&p, 3, 9);
    for (uint32_t i = 0; i < w.scene.n_instances; i++)
        for (int k = 0; k < 3; k++)
            w.instance[i].pose.pos[k] = at[k] + (i ? either(&p, 4 * radius) : 0);
    w.scene.background = (uint16_t)prng_next(&p);
    const int32_t near = distance / 10 + 1, far = distance * 30;
    const int perspective = prng_pick(&p, 4) != 0;
    CASE_CHECK((perspective ? zs_camera_perspective(&w.camera, (zs_turn)prng_range(&p, ZS_DEGREES(20), ZS_DEGREES(90)),
                                                    H, near, far)
                            : zs_camera_orthographic(&w.camera, prng_range(&p, 3, 8) * radius, near, far)) == ZS_OK);
    CASE_CHECK(zs_camera_orbit(&w.camera, at, distance, (zs_turn)prng_next(&p), (int16_t)either(&p, 16000)) == ZS_OK);
    if (prng_pick(&p, 2)) {
        int32_t dir[3]; /* from the camera's side, so that it falls on what is seen */
        for (int k = 0; k < 3; k++)
            dir[k] = either(&p, 50) + (w.camera.rot[6 + k] >> 23);
        CASE_CHECK(zs_unit(w.scene.light.dir, dir) == ZS_OK);
        w.scene.light.ambient = (zs_uq16_16)prng_range(&p, ZS_Q16_ONE / 6, ZS_Q16_ONE);
        w.scene.light.diffuse = (zs_uq16_16)prng_range(&p, ZS_Q16_ONE / 20, ZS_Q16_ONE);
    }
    w.config.depth = !perspective ? &zs_depth_linear : prng_pick(&p, 2) ? &zs_depth_float : &zs_depth_recip;
    picture_any_way(&p, &w.config, (int32_t)n, (int32_t)n);
    w.config.strip_h = (uint16_t)prng_range(&p, 4, H);
    w.config.max_tris = (uint16_t)prng_range(&p, (int32_t)n, 4 * (int32_t)n);
    w.config.max_verts = (uint16_t)prng_range(&p, (int32_t)n, 4 * (int32_t)n);
    const int err = world_hear(&w, &words, &said);
    return err == ZS_OK && said == 0 ? 1 : case_wrong("%s\n%s", zs_error_string(err), words.text);
}

/* ---- Pools of what is not a mesh's triangles alone ------------------------------------------- */

#define POOLS_METHOD(name_, depth_, tris_, verts_, records_) { &zs_method_##name_, depth_, records_ },
static const struct {
    const struct zs_method *method;
    const struct zs_depth *depth; /* NULL: any with depth memory */
    int records;
} pools_method[] = { { NULL, NULL, 0 }, { &zs_method_transparent, NULL, 0 }, ZS_METHOD_EACH(POOLS_METHOD) };
static unsigned pools_named[4]; /* of triangles, lines, dashes, points */

/* Up to three of a shape, by triangles in any order, lines, dashes or points, by any method, with accelerators or none,
 * partly cut by near, far and the frame, in small pools: those that a sentence names take it in one pass. */
static int pools_case(uint64_t seed)
{
    static struct shape shape;
    static struct zs_mesh_edge edge[3 * SHAPE_TRIS];
    static uint16_t line[3 * SHAPE_TRIS][2];
    struct prng p = { seed };
    struct world w;
    struct zs_points points = { ZS_POINTS(NULL, 0), .size = 3 };
    world_cube(&w);
    random_shape(&p, &shape, 3);
    for (uint32_t t = shape.mesh.n_tris; --t && seed % 3;)
        for (uint32_t k = 0, other = prng_pick(&p, t + 1u); k < 3; k++) {
            const uint16_t was = shape.tri[t][k];
            shape.tri[t][k] = shape.tri[other][k];
            shape.tri[other][k] = was;
        }
    shape.mesh.radius += 2;
    const struct zs_lines lines = { ZS_LINES(line, 0), .width = (uint8_t)prng_range(&p, 1, 3),
                                    .on = (uint8_t)prng_range(&p, 4, 9), .off = (uint8_t)prng_range(&p, 4, 9) };
    const uint32_t kind = (uint32_t)seed % 4u;
    w.lines = lines;
    w.lines.on = kind == 2 ? w.lines.on : 0;
    w.lines.primitive.n =
        zs_edges_choose(line, 3 * SHAPE_TRIS, edge, (uint32_t)zs_edges_of(edge, &shape.mesh), &shape.mesh,
                        ZS_EDGE_ALL, 0, NULL, NULL);
    points.primitive.n = shape.mesh.n_verts;
    w.red.primitive = kind == 0 ? NULL : kind == 3 ? &points.primitive : &w.lines.primitive;
    w.red.shader = kind ? &zs_shade_plain : &zs_shade_flat;
    w.red.cull = (uint8_t)prng_pick(&p, 3);
    w.scene.n_instances = 1 + prng_pick(&p, 3);
    const int32_t radius = shape.mesh.radius;
    for (uint32_t i = 0; i < w.scene.n_instances; i++) {
        w.instance[i] = w.instance[0];
        w.instance[i].mesh = &shape.mesh;
        zs_pose_turn(&w.instance[i].pose, (zs_turn)prng_next(&p), (zs_turn)prng_next(&p), 0);
        for (int k = 0; k < 3; k++)
            w.instance[i].pose.pos[k] = either(&p, radius);
    }
    static const int32_t middle[3] = { 0, 0, 0 };
    const int32_t distance = radius / 4 * prng_range(&p, 1, 16), near = prng_range(&p, 1, distance);
    CASE_CHECK(zs_camera_perspective(&w.camera, ZS_DEGREES(60), H, near, distance + radius) == ZS_OK);
    CASE_CHECK(zs_camera_orbit(&w.camera, middle, distance, (zs_turn)prng_next(&p), (int16_t)either(&p, 16000)) ==
               ZS_OK);
    const uint32_t way = prng_pick(&p, sizeof pools_method / sizeof pools_method[0]);
    w.config.method = pools_method[way].method;
    if (pools_method[way].depth)
        w.config.depth = pools_method[way].depth;
    w.config.fast = prng_pick(&p, 2) ? w.config.fast : NULL;
    w.config.strip_h = (uint16_t)prng_range(&p, 4, H);
    const int32_t least = pools_method[way].records ? 90 : 6; /* with less, they take long */
    w.config.max_tris = (uint16_t)prng_range(&p, least, 2 * least + 50);
    w.config.max_verts = (uint16_t)prng_range(&p, least, 2 * least + 50);
    char name[48];
    (void)snprintf(name, sizeof name, "kind %u, method %u", kind, way);
    const int is = one_pass(&w, name);
    pools_named[kind] += is == 1;
    return is != 0;
}

/* ---- What is asked changes nothing ------------------------------------------------------------ */

static uint16_t glass_px[W * H];

static int keep_px(void *ctx, const struct zs_strip *s)
{
    *(uint32_t *)ctx += (uint32_t)s->dirty_w * s->h;
    for (uint32_t y = 0; y < s->h; y++)
        memcpy(&glass_px[(s->y + y) * W + s->dirty_x], s->px + 2u * (y * s->w + s->dirty_x), 2u * s->dirty_w);
    return 0;
}

/* Under zs_damage_track: bytes that changed without zs_invalidate, an overlay that tells no changes. */
static void damage_tracking_is_explained(void **state)
{
    static uint32_t memory[ZS_DAMAGE_WORDS(2, H, 8)], arena[20000], items[ZS_OVERLAY_WORDS(2)];
    static struct zs_rgb colors[12];
    static const char stale[] = "the panel shows another picture, in * strips: bytes have changed";
    for (int changes = 0; changes < 2; changes++) {
        struct zs_renderer r;
        struct zs_strip_hashes sums;
        uint64_t hashes[H * 2];
        struct world w;
        world_cube(&w);
        two_items(&w);
        w.overlay.memory = items;
        w.overlay.room = 2;
        w.hook.changes = changes ? zs_overlay_changes : NULL;
        w.cube.face_rgb = (const struct zs_rgb *)colors;
        memset(colors, 99, sizeof colors);
        assert_int_equal(zs_init(&r, &w.config, arena, sizeof arena), ZS_OK);
        assert_int_equal(damage_compare_anew(&r, &sums, hashes, 2), ZS_OK);
        assert_int_equal(zs_damage_track(&r, memory, 2), ZS_OK);
        for (int frame = 0; frame < 4; frame++) {
            struct words words = { .n = 0 };
            for (int k = 0; k < 12 && frame >= 2; k++)
                colors[k].r = frame == 2 ? 255 : 20; /* the first is not told */
            if (frame == 3)
                assert_int_equal(zs_invalidate(&r, NULL), ZS_OK);
            assert_int_equal(zs_render(&r, &w.scene, &w.camera, &w.sink), ZS_OK);
            const uint32_t said = zs_explain(&r, &w.scene, &w.camera, hear, &words);
            assert_int_equal(said, (changes ? 0u : 1u) + (frame == 2 ? 1u : 0u));
            if (!changes)
                assert_true(begins(words.text, "resolve hook 0 has no `changes`, and zs_damage_track is on"));
            else if (frame == 2)
                assert_true(begins(words.text, stale));
        }
        world_two(&w);
        w.instance[2] = w.instance[0];
        w.instance[2].pose.pos[0] = -900;
        w.scene.n_instances = 3; /* the memory is for two */
        struct words words = { .n = 0 };
        assert_int_not_equal(zs_render(&r, &w.scene, &w.camera, &w.sink), ZS_OK);
        assert_int_equal(zs_explain(&r, &w.scene, &w.camera, hear, &words), 1);
        assert_string_equal(words.text, "zs_damage_track has memory for 2 instances, and n_instances is 3.\n");
    }
}

/* The next frames are what they are without a question between, also what of them is sent. */
static void asking_changes_nothing(void **state)
{
    for (int mode = 0; mode < 8; mode++) {
        static uint16_t plain[6][W * H];
        static struct zs_stats counted[6];
        static uint32_t sent[6], memory[ZS_DAMAGE_WORDS(2, H, 8)], arena[20000];
        for (int ask = 0; ask < 2; ask++) {
            struct zs_renderer r;
            struct zs_strip_hashes sums;
            uint64_t hashes[H * 2];
            struct world w;
            struct words words = { .n = 0 };
            world_cube(&w);
            world_two(&w);
            memset(glass_px, 0, sizeof glass_px);
            w.config.buffers = (uint8_t)(1 + mode % 2);
            w.config.fast = picture_config(W, H, &zs_depth_float).fast;
            assert_int_equal(zs_init(&r, &w.config, arena, sizeof arena), ZS_OK);
            if (mode / 2 == 1)
                assert_int_equal(damage_compare_anew(&r, &sums, hashes, 1), ZS_OK);
            if (mode / 2 >= 2)
                assert_int_equal(zs_damage_track(&r, memory, 2), ZS_OK);
            if (mode / 2 == 3)
                assert_int_equal(zs_damage_columns(&r, 1), ZS_OK);
            for (int frame = 0; frame < 6; frame++) {
                uint32_t pixels = 0;
                const struct zs_sink sink = { .submit = keep_px, .ctx = &pixels };
                w.instance[1].pose.pos[0] += frame == 1 || frame == 4 ? 300 : 0;
                w.scene.background = (uint16_t)(w.scene.background + (frame == 3));
                assert_int_equal(zs_render(&r, &w.scene, &w.camera, &sink), ZS_OK);
                assert_non_null(r.touch); /* accelerators are still there */
                if (ask) {
                    assert_memory_equal(plain[frame], glass_px, sizeof glass_px);
                    assert_int_equal(sent[frame], pixels);
                    assert_memory_equal(&counted[frame], zs_frame_stats(&r), sizeof counted[0]);
                    const struct zs_stats before = *zs_frame_stats(&r);
                    w.scene.n_instances = frame % 2 ? 1 : 2; /* of other scenes, too */
                    w.instance[0].pose.pos[2] -= 100000;
                    assert_int_equal(zs_explain(&r, &w.scene, &w.camera, hear, &words), frame % 2);
                    assert_int_not_equal(zs_explain_instance(&r, &w.scene, &w.camera, 0, hear, &words), 0);
                    w.instance[0].pose.pos[2] += 100000;
                    w.scene.n_instances = 2;
                    assert_int_not_equal(zs_explain_instance(&r, &w.scene, &w.camera, 0, hear, &words), 0);
                    assert_memory_equal(&before, zs_frame_stats(&r), sizeof before);
                } else {
                    memcpy(plain[frame], glass_px, sizeof glass_px);
                    sent[frame] = pixels;
                    counted[frame] = *zs_frame_stats(&r);
                }
            }
        }
    }
}

/* One instance, and questions that cannot be answered. */
static void one_instance(void **state)
{
    struct world w;
    struct zs_renderer r;
    static uint32_t arena[20000];
    struct words words = { .n = 0 };
    struct zs_strip strip;
    memset(&r, 0, sizeof r);
    world_cube(&w);
    world_two(&w);
    w.instance[1].pose.pos[2] = -90000;
    assert_int_equal(zs_explain(NULL, &w.scene, &w.camera, hear, &words), 1);
    assert_int_equal(zs_explain(&r, &w.scene, &w.camera, hear, &words), 1);
    assert_non_null(strstr(words.text, "the renderer is NULL.\nthe renderer is not set up"));
    assert_int_equal(zs_init(&r, &w.config, arena, sizeof arena), ZS_OK);
    memset(&words, 0, sizeof words);
    assert_int_equal(zs_explain(&r, NULL, &w.camera, hear, &words), 1);
    assert_int_equal(zs_explain(&r, &w.scene, NULL, hear, &words), 1);
    assert_string_equal(words.text, "the scene is NULL.\nthe camera is NULL.\n");
    assert_int_equal(zs_frame_begin(&r, &w.scene, &w.camera), ZS_OK);
    assert_int_equal(zs_explain(&r, &w.scene, &w.camera, hear, &words), 1);
    assert_non_null(strstr(words.text, "a frame is open"));
    assert_int_equal(zs_frame_strip(&r, &strip), 1); /* it still is */
    assert_int_equal(zs_frame_end(&r), ZS_OK);
    memset(&words, 0, sizeof words);
    assert_int_equal(zs_explain_instance(&r, &w.scene, &w.camera, 0, hear, &words), 1);
    assert_int_equal(zs_explain_instance(&r, &w.scene, &w.camera, 1, hear, &words), 1);
    assert_int_equal(zs_explain_instance(&r, &w.scene, &w.camera, 2, hear, &words), 1);
    struct picture p;
    w.scene.n_instances = 1;
    p = picture_draw(&w.config, &w.scene, &w.camera);
    char want[300];
    (void)snprintf(
        want, sizeof want,
        "instance 0 colours %u pixels where nothing hides it: %u of 12 triangles are drawn, %u face away, 0 are "
        "beside the picture, 0 before near, 0 beyond far.\ninstance 1 is out of view: it begins *\nthere is no "
        "instance 2: n_instances is 2.\n",
        p.covered, p.stats.tris_drawn, p.stats.tris_facing);
    char *star = strchr(want, '*'), *at = strstr(words.text, "it begins ");
    *star = 0;
    assert_memory_equal(words.text, want, strlen(want));
    assert_non_null(at);
    assert_string_equal(strchr(at, '\n'), star + 1);
    picture_free(&p);
}

/* There is an end to what is said. */
static void at_most_16(void **state)
{
    static struct zs_instance many[40];
    struct world w;
    struct words words;
    uint32_t said;
    world_cube(&w);
    for (int k = 0; k < 40; k++) {
        many[k] = w.instance[0];
        many[k].pose.pos[1] = k; /* not two in one place */
    }
    w.scene.instance = many;
    w.scene.n_instances = 40;
    w.config.max_tris = w.config.max_verts = 500;
    assert_right(&w, "40 instances");
    for (int k = 0; k < 40; k++)
        many[k].pose.pos[0] = INT32_MAX;
    assert_int_equal(world_hear(&w, &words, &said), ZS_ERR_RANGE);
    assert_int_equal(said, 16);
    assert_int_equal(lines(&words), 16);
    for (int k = 0; k < 40; k++)
        many[k].pose.pos[0] = 100000;
    assert_int_equal(world_hear(&w, &words, &said), ZS_OK);
    assert_int_equal(said, 8);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(nothing_is_seen),
    cmocka_unit_test(it_is_dark),
    cmocka_unit_test(parts_are_wrong),
    cmocka_unit_test(it_is_slow),
    cmocka_unit_test(one_pass_is_one),
    cmocka_unit_test(no_pool_is_enough),
    cmocka_unit_test(errors_name_the_thing),
    cmocka_unit_test(more_mistakes),
    cmocka_unit_test(sizes_are_wrong),
    cmocka_unit_test(more_is_refused),
    cmocka_unit_test(set_up_is_refused),
    cmocka_unit_test(parts_of_it_are_wrong),
    cmocka_unit_test(causes_are_right),
    cmocka_unit_test(damage_tracking_is_explained),
    cmocka_unit_test(no_accelerators),
    cmocka_unit_test(scenes_are_right),
    cmocka_unit_test(examples_are_right),
    cmocka_unit_test(unusual_is_right),
    CASES_TEST(random_scenes_are_right, right_case, 400),
    CASES_COUNTS(named_pools_suffice, pools_case, 48, { "of triangles", &pools_named[0], 3 },
                 { "of lines", &pools_named[1], 3 }, { "of dashes", &pools_named[2], 10 },
                 { "of points", &pools_named[3], 3 }),
    cmocka_unit_test(asking_changes_nothing),
    cmocka_unit_test(one_instance),
    cmocka_unit_test(at_most_16),
};

CASES_MAIN(tests)
