/* What flies with the eye: an instrument panel and the bow above it, in view space; a tail fin behind; and a cloud.
 * Half of the picture's shorter side is 1000 steps at the depth COCKPIT_DEPTH.
 *
 * SPDX-License-Identifier: MIT
 */
#include "gen.h"

#include "../view.h"

static const struct gen_rgb white = { 255, 255, 255 };

/* ---- The panel: a hood that is rounded towards the eye, and a plane below it, row by row from afar -------------- */

#define COLUMNS 16
#define HALF_WIDE 2200

static void panel(void)
{
    static const struct {
        int64_t y, z;      /* y below the hood's line; z towards the eye, from the plane that y is measured in */
        int64_t normal[2]; /* y, z */
        struct gen_rgb rgb;
    } row[] = {
        { 0, -260, { 30, -4 }, { 84, 78, 74 } }, { 12, 60, { 30, 6 }, { 92, 86, 82 } },
        { -6, 210, { 20, 22 }, { 92, 86, 82 } }, { -44, 250, { 2, 30 }, { 66, 62, 60 } },
        { -44, 240, { 2, 30 }, { 16, 16, 18 } }, { -80, 0, { 3, 30 }, { 20, 22, 26 } },
        { -260, 0, { 3, 30 }, { 62, 68, 78 } },  { -800, 0, { 3, 30 }, { 40, 44, 52 } },
        { -2000, 0, { 3, 30 }, { 24, 26, 32 } },
    };
    const uint32_t n_rows = sizeof row / sizeof row[0];
    struct gen_mesh *m = gen_begin("cockpit_panel");
    for (uint32_t k = 0; k < n_rows; k++)
        for (int64_t i = 0; i <= COLUMNS; i++) {
            const int64_t x = i * 2 * HALF_WIDE / COLUMNS - HALF_WIDE, line = -270 - x * x / 9000;
            const int64_t depth = COCKPIT_DEPTH - row[k].z;
            const int64_t pos[3] = { gen_div(x * depth, COCKPIT_DEPTH),
                                     gen_div((line + row[k].y) * depth, COCKPIT_DEPTH), -depth };
            const int64_t normal[3] = { gen_div(x * row[k].normal[0], 4500), row[k].normal[0], row[k].normal[1] };
            gen_vert_normal(m, pos, normal, row[k].rgb);
        }
    for (uint32_t k = 0; k + 1 < n_rows; k++)
        for (uint32_t i = 0; i < COLUMNS; i++) {
            const uint32_t a = k * (COLUMNS + 1) + i, c = a + COLUMNS + 1;
            gen_quad(m, a, c, c + 1, a + 1, white);
        }
    gen_write(m, GEN_NORMAL | GEN_VERTEX_RGB, COCKPIT_SCALE);
}

/* ---- The bow: half an ellipse of a tube that is oval ------------------------------------------------------------ */

#define BOW_STEPS 24
#define BOW_SIDES 6

static void bow(void)
{
    static const struct gen_rgb paint = { 128, 122, 116 };
    struct gen_mesh *m = gen_begin("cockpit_bow");
    for (int64_t i = 0; i <= BOW_STEPS; i++) {
        const int64_t a = i * 32768 / BOW_STEPS, c = gen_cos(a), s = gen_sin(a);
        for (int64_t k = 0; k < BOW_SIDES; k++) {
            const int64_t b = k * 65536 / BOW_SIDES, out = gen_cos(b), near = gen_sin(b);
            const int64_t rx = 1130 + gen_div(46 * out, GEN_Q30), ry = 1430 + gen_div(46 * out, GEN_Q30);
            const int64_t pos[3] = { gen_div(rx * c, GEN_Q30), -500 + gen_div(ry * s, GEN_Q30),
                                     -COCKPIT_DEPTH - 100 +
                                         gen_div(46 * near, GEN_Q30) }; /* its feet are behind the panel */
            const int64_t normal[3] = { gen_div(out * c, GEN_Q30), gen_div(out * s, GEN_Q30), near };
            gen_vert_normal(m, pos, normal, paint);
        }
    }
    for (uint32_t i = 0; i < BOW_STEPS; i++)
        for (uint32_t k = 0; k < BOW_SIDES; k++) {
            const uint32_t now = i * BOW_SIDES, next = now + BOW_SIDES, j = (k + 1) % BOW_SIDES;
            gen_quad(m, now + k, next + k, next + j, now + j, paint);
        }
    gen_write(m, GEN_NORMAL | GEN_VERTEX_RGB, COCKPIT_SCALE);
}

/* ---- The tail as the mirror shows it, from before: spine, planes and fin, of flat faces; +z is aft -------------- */

static void fin(void)
{
    static const struct gen_rgb red = { 214, 48, 40 }, pale = { 244, 240, 230 }, grey = { 186, 188, 194 };
    static const int16_t at[][3] = {
        { -300, -420, 0 },    { 0, -150, 0 },     { 300, -420, 0 },   { -70, -120, 900 },
        { 0, -30, 900 },      { 70, -120, 900 }, /* 0: the spine */
        { -55, -40, 860 },    { 55, -40, 860 },   { 0, 820, 1050 },   { -50, 790, 1250 },
        { 50, 790, 1250 },    { -60, -40, 1250 }, { 60, -40, 1250 }, /* 6: the fin */
        { -1150, 130, 1000 }, { -1150, 80, 980 }, { 0, 10, 880 },     { 0, -90, 860 },
        { 1150, 130, 1000 },  { 1150, 80, 980 },  { -800, 108, 966 }, { -800, 32, 945 },
        { 800, 108, 966 },    { 800, 32, 945 }, /* 13: planes */
    };
    static const struct {
        uint8_t v[3];
        const struct gen_rgb *rgb;
    } face[] = {
        { { 0, 4, 1 }, &pale },    { { 0, 3, 4 }, &pale },    { { 1, 4, 5 }, &grey },    { { 1, 5, 2 }, &grey },
        { { 6, 7, 8 }, &red },     { { 6, 8, 9 }, &red },     { { 6, 9, 11 }, &pale },   { { 7, 12, 10 }, &pale },
        { { 7, 10, 8 }, &red },    { { 13, 14, 19 }, &red },  { { 14, 20, 19 }, &red },  { { 19, 20, 15 }, &pale },
        { { 20, 16, 15 }, &pale }, { { 15, 16, 21 }, &pale }, { { 16, 22, 21 }, &pale }, { { 21, 22, 17 }, &red },
        { { 22, 18, 17 }, &red },
    };
    struct gen_mesh *m = gen_begin("cockpit_fin");
    for (uint32_t i = 0; i < sizeof at / sizeof at[0]; i++)
        gen_vert(m, at[i][0] * 4, at[i][1] * 4, at[i][2] * 4);
    for (uint32_t i = 0; i < sizeof face / sizeof face[0]; i++)
        gen_tri(m, face[i].v[0], face[i].v[1], face[i].v[2], *face[i].rgb);
    gen_write(m, GEN_FACE_RGB, COCKPIT_SCALE / 4);
}

/* ---- A cloud: heaps of noise, level below ----------------------------------------------------------------------- */

static void cloud(void)
{
    static const struct gen_rgb lit = { 255, 252, 244 }, shade = { 178, 194, 216 };
    struct gen_image *im = gen_image("cloud", 64, 32);
    for (int64_t y = 0; y < im->h; y++)
        for (int64_t x = 0; x < im->w; x++) {
            const int64_t at[3] = { x * 65536 / 14, y * 65536 / 11, 0 };
            const int64_t n = gen_fractal(at, 64, 3, 71), dx = 2 * x - 63, up = 25 - y;
            const int64_t dome = 65536 - dx * dx * 18 - (up > 0 ? up * up * 110 : up * up * 1500);
            const int64_t thick = (dome * 3 / 4 + n - 46000) / 1500;
            im->alpha[y][x] = (uint8_t)(thick <= 0 ? 0 : thick >= 8 ? 232 : thick * 29);
            const int64_t light = (up * 10 + n / 400) / 16;
            gen_dot(im, x, y, gen_mix(shade, lit, light < 0 ? 0 : light > 15 ? 15 : light, 15));
        }
    gen_texture(im, GEN_PAL8A, GEN_CLAMP);
    struct gen_mesh *m = gen_begin("cloud");
    const int64_t corner[3] = { -4000, 2000, 0 }, right[3] = { 8000, 0, 0 }, down[3] = { 0, -4000, 0 };
    const int64_t uv[2][2] = { { 0, 0 }, { 1 << 12, 1 << 12 } };
    m->uv_bits = 12;
    gen_panel(m, corner, right, down, uv);
    gen_write(m, GEN_UV, 65536);
}

void gen_cockpit(void)
{
    panel();
    bow();
    fin();
    cloud();
}
