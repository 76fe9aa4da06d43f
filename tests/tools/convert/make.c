/* Models and pictures for tests/tools/convert.sh, written as they are asked for.
 *
 *     make torus ACROSS AROUND REPEATS LIBRARY >M.obj   uv, normals; LIBRARY: a .mtl to name, or -
 *     make teapot >M.obj                      the demo scenes' own, whole numbers
 *     make boxes N COLORS >M.obj              N boxes in rows of 20, of materials in turn
 *     make boxes.mtl COLORS >boxes.mtl
 *     make soup N SEED >M.obj                 N triangles that share nothing, some without area
 *     make png KIND W H FILE.png              KIND: a number of colours, or photo
 *     make jpeg W H FILE.jpg
 *     make gltf FOLDER                        four materials, two of them textured
 *     make leaf W H MODE FILE.png             green, RGBA; MODE hole: a disc of alpha 255 in 0; fade: 0 to 255 across
 *     make looks FOLDER NAME MORE MATERIAL... bowls in a row, a glTF material each; textures 0: hole.png, 1: fade.png,
 *                                             2: red.png. MORE: mesh, scene or both have what is not carried over; -
 *     make psnr A.png B.ppm                   how alike they are, dB
 *     make sum A.png...                       of each FNV-1a of its RGB565 values, high byte first; its colours
 *
 * SPDX-License-Identifier: MIT
 */
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

#include "meshes.h"
#include "paint.h"

#define PI 3.14159265358979323846

static void torus(int across, int around, double repeats, const char *library)
{
    if (strcmp(library, "-") != 0)
        printf("mtllib %s\nusemtl skin\n", library);
    for (int i = 0; i < across; i++)
        for (int j = 0; j < around; j++) {
            const double a = 2 * PI * i / across, b = 2 * PI * j / around;
            printf("v %.6f %.6f %.6f\n", (1 + 0.4 * cos(b)) * cos(a) + 3.1, 0.4 * sin(b) - 7.0,
                   -(1 + 0.4 * cos(b)) * sin(a));
            printf("vn %.6f %.6f %.6f\n", cos(b) * cos(a), sin(b), -cos(b) * sin(a));
        }
    for (int i = 0; i <= across; i++)
        for (int j = 0; j <= around; j++)
            printf("vt %.6f %.6f\n", repeats * i / across, 2.0 * j / around);
    for (int i = 0; i < across; i++)
        for (int j = 0; j < around; j++) {
            printf("f");
            for (int k = 0; k < 4; k++) {
                const int x = i + (k == 1 || k == 2), y = j + (k >= 2);
                const int v = x % across * around + y % around + 1;
                printf(" %d/%d/%d", v, x * (around + 1) + y + 1, v);
            }
            printf("\n");
        }
}

static void teapot(void)
{
    const struct zs_mesh *m = &mesh_teapot;
    for (uint32_t i = 0; i < m->n_verts; i++)
        printf("v %d %d %d\n", m->pos[i][0], m->pos[i][1], m->pos[i][2]);
    for (uint32_t i = 0; i < m->n_tris; i++)
        printf("f %d %d %d\n", m->tri[i][0] + 1, m->tri[i][1] + 1, m->tri[i][2] + 1);
}

static void boxes(int n, int colors)
{
    static const int quad[6][4] = { { 1, 2, 4, 3 }, { 5, 7, 8, 6 }, { 1, 5, 6, 2 },
                                    { 3, 4, 8, 7 }, { 1, 3, 7, 5 }, { 2, 6, 8, 4 } };
    printf("mtllib boxes.mtl\n");
    for (int i = 0; i < n; i++) {
        for (int v = 0; v < 8; v++)
            printf("v %.1f %.1f %.1f\n", 1.5 * (i % 20) + v / 4, 2.0 * (i / 20) + v / 2 % 2 * 1.5,
                   v % 2 * 0.5);
        printf("usemtl paint%d\n", i % colors);
        for (int f = 0; f < 6; f++)
            printf("f %d %d %d %d\n", 8 * i + quad[f][0], 8 * i + quad[f][1], 8 * i + quad[f][2],
                   8 * i + quad[f][3]);
    }
}

static void library(int colors)
{
    for (int i = 0; i < colors; i++)
        printf("newmtl paint%d\nKd %.6f %.6f %.6f\n", i, i % 8 * 30 / 255.0, i / 8 % 8 * 30 / 255.0,
               (40 + i / 64) / 255.0);
}

static uint32_t random_state;
static double random_unit(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    return (random_state >> 8) / 16777216.0;
}

static void soup(int n, uint32_t seed)
{
    random_state = seed;
    for (int i = 0; i < n; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = random_unit() * 10.0;
        for (int v = 0; v < 3; v++) {
            const double r = i % 10 == 9 ? 1e-6 : 0.7;
            printf("v %.9f %.9f %.9f\n", p[0] + r * random_unit(), p[1] + r * random_unit(),
                   p[2] + r * random_unit());
        }
        printf("f -3 -2 -1\n");
    }
}

static uint8_t *picture(const char *kind, unsigned w, unsigned h)
{
    uint8_t *px = malloc((size_t)w * h * 3);
    if (px == NULL)
        exit(1);
    for (unsigned i = 0; i < w * h; i++)
        paint(kind, i % w, i / w, w, h, px + 3 * i);
    return px;
}

static void png(const char *kind, unsigned w, unsigned h, const char *file)
{
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = w, .height = h, .format = PNG_FORMAT_RGB
    };
    uint8_t *px = picture(kind, w, h);
    if (!png_image_write_to_file(&image, file, 0, px, 0, NULL))
        exit(1);
    free(px);
}

static void jpeg(unsigned w, unsigned h, const char *file)
{
    unsigned char *out = NULL;
    unsigned long n = 0;
    uint8_t *px = picture("photo", w, h);
    tjhandle t = tjInitCompress();
    FILE *f = fopen(file, "wb");
    if (f == NULL ||
        tjCompress2(t, px, (int)w, 0, (int)h, TJPF_RGB, &out, &n, TJSAMP_444, 90, 0) != 0 ||
        fwrite(out, 1, n, f) != n)
        exit(1);
    fclose(f);
    tjFree(out);
    tjDestroy(t);
    free(px);
}

/* A ball of 32 x 16 squares with uv: 33 * 17 vertices of position, normal, uv; indices uint16. */
#define COLS 32
#define ROWS 16
#define N_VERTS ((COLS + 1) * (ROWS + 1))
#define N_INDEX (COLS * ROWS * 6)

static void ball(FILE *f)
{
    static float pos[N_VERTS][3], normal[N_VERTS][3], uv[N_VERTS][2];
    static uint16_t index[N_INDEX];
    int n = 0;
    for (int j = 0; j <= ROWS; j++)
        for (int i = 0; i <= COLS; i++) {
            const int v = j * (COLS + 1) + i;
            const double a = 2 * PI * i / COLS, b = PI * j / ROWS;
            const double d[3] = { sin(b) * sin(a), cos(b), sin(b) * cos(a) };
            for (int k = 0; k < 3; k++) {
                normal[v][k] = (float)d[k];
                pos[v][k] = (float)(d[k] * (1 + 0.1 * sin(5 * a) * sin(b)));
            }
            uv[v][0] = (float)(3.0 * i / COLS);
            uv[v][1] = (float)j / ROWS;
        }
    for (int j = 0; j < ROWS; j++)
        for (int i = 0; i < COLS; i++) {
            const int a = j * (COLS + 1) + i, b = a + COLS + 1;
            const int quad[6] = { a, b, b + 1, a, b + 1, a + 1 };
            for (int k = 0; k < 6; k++)
                index[n++] = (uint16_t)quad[k];
        }
    fwrite(pos, sizeof pos, 1, f);
    fwrite(normal, sizeof normal, 1, f);
    fwrite(uv, sizeof uv, 1, f);
    fwrite(index, sizeof index, 1, f);
}

static void gltf(const char *folder)
{
    char path[4096];
    const int p = 12 * N_VERTS, u = 8 * N_VERTS, x = 2 * N_INDEX;
    snprintf(path, sizeof path, "%s/ball.bin", folder);
    FILE *f = fopen(path, "wb");
    if (f == NULL)
        exit(1);
    ball(f);
    fclose(f);
    snprintf(path, sizeof path, "%s/red.png", folder);
    png("16", 64, 64, path);
    snprintf(path, sizeof path, "%s/blue.png", folder);
    png("photo", 128, 64, path);
    snprintf(path, sizeof path, "%s/balls.gltf", folder);
    f = fopen(path, "w");
    if (f == NULL)
        exit(1);
    fprintf(f, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1,2,3]}],"
               "\"nodes\":[");
    fprintf(f, "{\"mesh\":0,\"translation\":[-2,0,0]},{\"mesh\":1,\"rotation\":[0,0.6,0,0.8],"
               "\"translation\":[2,0.5,0]},");
    fprintf(f, "{\"mesh\":2,\"scale\":[-1,2,0.5],\"translation\":[0,2.5,-1]},{\"mesh\":3,"
               "\"translation\":[0,-2,1]}],");
    fprintf(f, "\"meshes\":[");
    for (int m = 0; m < 4; m++)
        fprintf(f,
                "%s{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2},"
                "\"indices\":3,\"material\":%d}]}",
                m > 0 ? "," : "", m);
    fprintf(
        f, "],\"materials\":[{\"name\":\"red */ "
           "paint\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}},"
           "{\"name\":\"blue\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}},"
           "{\"name\":\"plain\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.9,0.5,0.1,1]}},"
           "{\"name\":\"other\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.1,0.7,0.3,1]}}],");
    fprintf(f, "\"textures\":[{\"source\":0},{\"source\":1}],\"images\":[{\"uri\":\"red.png\"},{"
               "\"uri\":\"blue.png\"}],");
    fprintf(
        f,
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\","
        "\"min\":[-1.2,-1,-1.2],\"max\":[1.2,1,1.2]},",
        N_VERTS);
    fprintf(f, "{\"bufferView\":1,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"},",
            N_VERTS);
    fprintf(f, "{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":\"VEC2\"},",
            N_VERTS);
    fprintf(f, "{\"bufferView\":3,\"componentType\":5123,\"count\":%d,\"type\":\"SCALAR\"}],",
            N_INDEX);
    fprintf(f,
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d},{\"buffer\":0,\"byteOffset\":%d,"
            "\"byteLength\":%d},",
            p, p, p);
    fprintf(f,
            "{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%d},{\"buffer\":0,\"byteOffset\":%d,"
            "\"byteLength\":%d}],",
            2 * p, u, 2 * p + u, x);
    fprintf(f, "\"buffers\":[{\"uri\":\"ball.bin\",\"byteLength\":%d}]}\n", 2 * p + u + x);
    fclose(f);
}

static void leaf(unsigned w, unsigned h, const char *mode, const char *file)
{
    png_image image = {
        .version = PNG_IMAGE_VERSION, .width = w, .height = h, .format = PNG_FORMAT_RGBA
    };
    uint8_t *px = malloc((size_t)w * h * 4);
    for (unsigned i = 0; px != NULL && i < w * h; i++) {
        const double u = (i % w + 0.5) / w - 0.5, v = (i / w + 0.5) / h - 0.5;
        const int in = u * u + v * v < 0.16;
        px[4 * i] = 40;
        px[4 * i + 1] = (uint8_t)(120 + 8 * (i % 11));
        px[4 * i + 2] = in ? 30 : 200; /* what is hidden has a colour of its own */
        px[4 * i + 3] = strcmp(mode, "hole") == 0 ? (uint8_t)(in ? 255 : 0)
                                                  : (uint8_t)(255 * (i % w) / (w - 1));
    }
    if (px == NULL || !png_image_write_to_file(&image, file, 0, px, 0, NULL))
        exit(1);
    free(px);
}

/* The ball's vertices, its front half's triangles, joints and weights. */
static void bowl(const char *path)
{
    static uint8_t joints[N_VERTS][4];
    static float weights[N_VERTS][4];
    FILE *f = fopen(path, "wb");
    if (f == NULL)
        exit(1);
    ball(f);
    for (int v = 0; v < N_VERTS; v++)
        weights[v][0] = 1.0f;
    fwrite(joints, sizeof joints, 1, f);
    fwrite(weights, sizeof weights, 1, f);
    fclose(f);
}

static void looks(const char *folder, const char *name, const char *more, int n, char **material)
{
    char path[4096];
    const int p = 12 * N_VERTS, u = 8 * N_VERTS, x = 2 * N_INDEX,
              at[6] = { 0, p, 2 * p, 2 * p + u, 2 * p + u + x, 2 * p + u + x + 4 * N_VERTS };
    const int length[6] = { p, p, u, x, 4 * N_VERTS, 16 * N_VERTS };
    const int mesh = strcmp(more, "mesh") == 0 || strcmp(more, "both") == 0;
    const int scene = strcmp(more, "scene") == 0 || strcmp(more, "both") == 0;
    snprintf(path, sizeof path, "%s/bowl.bin", folder);
    bowl(path);
    snprintf(path, sizeof path, "%s/%s.gltf", folder, name);
    FILE *f = fopen(path, "w");
    if (f == NULL)
        exit(1);
    fprintf(f, "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":[\"KHR_lights_punctual\",\"KHR_"
               "materials_unlit\"],"
               "\"scene\":0,\"scenes\":[{\"nodes\":[");
    for (int i = 0; i < n + 2 * scene; i++)
        fprintf(f, "%s%d", i ? "," : "", i);
    fprintf(f, "]}],\"nodes\":[");
    for (int i = 0; i < n; i++) /* bowl i leans over bowl i - 1 */
        fprintf(f, "%s{\"mesh\":%d,\"translation\":[%g,%g,%g]%s}", i ? "," : "", i, 1.5 * i,
                0.3 * (i % 2), 0.5 * (i % 3), mesh ? ",\"skin\":0" : "");
    if (scene)
        fprintf(f, ",{\"name\":\"eye\",\"camera\":0},{\"name\":\"lamp\",\"extensions\":{\"KHR_"
                   "lights_punctual\":{\"light\":0}}}");
    fprintf(f, "],\"meshes\":[");
    for (int i = 0; i < n; i++)
        fprintf(f,
                "%s{\"name\":\"bowl%d\",\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":"
                "1,\"TEXCOORD_0\":2%s},"
                "\"indices\":3,\"material\":%d%s}]}",
                i ? "," : "", i, mesh ? ",\"TEXCOORD_1\":2,\"JOINTS_0\":4,\"WEIGHTS_0\":5" : "", i,
                mesh ? ",\"targets\":[{\"POSITION\":1}]" : "");
    fprintf(f, "],\"materials\":[");
    for (int i = 0; i < n; i++)
        fprintf(f, "%s%s", i ? "," : "", material[i]);
    fprintf(f, "],\"textures\":[{\"source\":0},{\"source\":1},{\"source\":2},{\"source\":3}],"
               "\"images\":[{\"uri\":\"hole.png\"},"
               "{\"uri\":\"fade.png\"},{\"uri\":\"red.png\"},{\"uri\":\"gone.png\"}],");
    if (mesh)
        fprintf(f, "\"skins\":[{\"joints\":[0],\"inverseBindMatrices\":8}],");
    if (scene)
        fprintf(f,
                "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"
                "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\",\"name\":"
                "\"lamp\"}]}},"
                "\"animations\":[{\"name\":\"walk\",\"channels\":[{\"sampler\":0,\"target\":{"
                "\"node\":0,"
                "\"path\":\"translation\"}}],\"samplers\":[{\"input\":6,\"output\":7}]}],");
    fprintf(
        f,
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\","
        "\"min\":[-1.2,-1,-1.2],\"max\":[1.2,1,1.2]},{\"bufferView\":1,\"componentType\":5126,"
        "\"count\":%d,"
        "\"type\":\"VEC3\"},{\"bufferView\":2,\"componentType\":5126,\"count\":%d,\"type\":"
        "\"VEC2\"},",
        N_VERTS, N_VERTS, N_VERTS);
    fprintf(f,
            "{\"bufferView\":3,\"componentType\":5123,\"count\":%d,\"type\":\"SCALAR\"},{"
            "\"bufferView\":4,"
            "\"componentType\":5121,\"count\":%d,\"type\":\"VEC4\"},{\"bufferView\":5,"
            "\"componentType\":5126,"
            "\"count\":%d,\"type\":\"VEC4\"},",
            N_INDEX * 2 / 3, N_VERTS, N_VERTS); /* without the lowest third: one looks in */
    fprintf(f, "{\"bufferView\":5,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},{"
               "\"bufferView\":0,"
               "\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},{\"bufferView\":5,"
               "\"componentType\":5126,\"count\":1,\"type\":\"MAT4\"}],\"bufferViews\":[");
    for (int i = 0; i < 6; i++)
        fprintf(f, "%s{\"buffer\":0,\"byteOffset\":%d,\"byteLength\":%d}", i ? "," : "", at[i],
                length[i]);
    fprintf(f, "],\"buffers\":[{\"uri\":\"bowl.bin\",\"byteLength\":%d}]}\n", at[5] + length[5]);
    fclose(f);
}

static void psnr(const char *a, const char *b)
{
    png_image image = { .version = PNG_IMAGE_VERSION };
    unsigned w = 0, h = 0;
    double squared = 0.0;
    FILE *f = fopen(b, "rb");
    if (f == NULL || !png_image_begin_read_from_file(&image, a) ||
        fscanf(f, "P6 %u %u 255", &w, &h) != 2 || fgetc(f) != '\n' || image.width != w ||
        image.height != h)
        exit(1);
    image.format = PNG_FORMAT_RGB;
    uint8_t *px = malloc(PNG_IMAGE_SIZE(image));
    if (px == NULL || !png_image_finish_read(&image, NULL, px, 0, NULL))
        exit(1);
    for (size_t i = 0; i < 3 * (size_t)w * h; i++) {
        const int d = px[i] - fgetc(f);
        squared += d * d;
    }
    fclose(f);
    free(px);
    printf("%.1f\n", 10.0 * log10(65025.0 * 3.0 * w * h / squared));
}

static void sum(const char *file)
{
    png_image image = { .version = PNG_IMAGE_VERSION };
    uint8_t seen[65536] = { 0 };
    uint32_t h = 2166136261u, colors = 0;
    if (!png_image_begin_read_from_file(&image, file))
        exit(1);
    image.format = PNG_FORMAT_RGB;
    uint8_t *px = malloc(PNG_IMAGE_SIZE(image));
    if (px == NULL || !png_image_finish_read(&image, NULL, px, 0, NULL))
        exit(1);
    for (size_t i = 0; i < (size_t)image.width * image.height; i++) {
        const unsigned c = (unsigned)(px[3 * i] >> 3 << 11 | px[3 * i + 1] >> 2 << 5 |
                                      px[3 * i + 2] >> 3);
        h = (h ^ c >> 8) * 16777619u;
        h = (h ^ (c & 255)) * 16777619u;
        colors += !seen[c];
        seen[c] = 1;
    }
    free(px);
    printf("%08x %u\n", (unsigned)h, (unsigned)colors);
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (strcmp(what, "torus") == 0 && argc == 6)
        torus(atoi(argv[2]), atoi(argv[3]), atof(argv[4]), argv[5]);
    else if (strcmp(what, "teapot") == 0 && argc == 2)
        teapot();
    else if (strcmp(what, "boxes") == 0 && argc == 4)
        boxes(atoi(argv[2]), atoi(argv[3]));
    else if (strcmp(what, "boxes.mtl") == 0 && argc == 3)
        library(atoi(argv[2]));
    else if (strcmp(what, "soup") == 0 && argc == 4)
        soup(atoi(argv[2]), (uint32_t)atoi(argv[3]));
    else if (strcmp(what, "png") == 0 && argc == 6)
        png(argv[2], (unsigned)atoi(argv[3]), (unsigned)atoi(argv[4]), argv[5]);
    else if (strcmp(what, "psnr") == 0 && argc == 4)
        psnr(argv[2], argv[3]);
    else if (strcmp(what, "sum") == 0 && argc > 2)
        for (int i = 2; i < argc; i++)
            sum(argv[i]);
    else if (strcmp(what, "jpeg") == 0 && argc == 5)
        jpeg((unsigned)atoi(argv[2]), (unsigned)atoi(argv[3]), argv[4]);
    else if (strcmp(what, "leaf") == 0 && argc == 6)
        leaf((unsigned)atoi(argv[2]), (unsigned)atoi(argv[3]), argv[4], argv[5]);
    else if (strcmp(what, "looks") == 0 && argc > 5)
        looks(argv[2], argv[3], argv[4], argc - 5, argv + 5);
    else if (strcmp(what, "gltf") == 0 && argc == 3)
        gltf(argv[2]);
    else
        return 2;
    return 0;
}
