/*
 * reference.c - see reference.h.
 *
 * Coverage uses homogeneous edge functions (Olano & Greer): with vertices v = (X, Y, w) such that
 * the screen position is (X/w, Y/w), the line through two of them is their cross product, and a
 * sample s = (sx, sy, 1) lies in the visible triangle where all three lines have the sign of
 * det(v0, v1, v2). That holds for vertices behind the eye too, so nothing has to be clipped; and
 * the line values divided by their sum are the weights of the vertices at the point seen in space.
 * Screen coordinates here are relative to the image centre, which costs no rounding.
 *
 * The projected vertices are rounded doubles; from there on the side of a line a sample lies on is
 * decided without error, by expansions (sums of doubles that stand for one exact number, after
 * Shewchuk 1997) wherever plain arithmetic could be wrong. So triangles that share vertices share
 * out the samples exactly, even samples on a vertex. This needs IEEE doubles and must not be
 * compiled with -ffast-math; contraction to fused multiply-add does no harm.
 */
#include "reference.h"

#include "lamps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define NO_TRIANGLE SIZE_MAX
#define MAX_UV 1e9
#define ON_BORDER 1e-9 /* texels */
#define MAX_COORDINATE 1e60 /* its cube, scaled to pixels, is still far from overflow */
#define PROGRESS_STEP 1024u

/* A line value smaller than this part of its terms is computed exactly instead. 1e-15 would do for
 * the signs; the rest buys accurate weights in slivers and is still rarely taken. */
#define DOUBTFUL 1e-9

/* A number, exactly the sum of its parts; least part first, the last decides the sign. */
struct expansion {
    double part[24]; /* six products of three doubles, four parts each */
    int n;
};

/* What sampling one triangle needs. */
struct setup {
    double v[3][3];    /* homogeneous screen vertices: centre-relative pixels times w, and w */
    double z[3];       /* distance of the vertices along the axis */
    double line[3][3]; /* line k lies opposite vertex k; positive inside */
    double doubt[3];   /* values of line k up to this size are computed exactly */
    double sign;       /* of the line from vertex k+1 to k+2 relative to line k */
    int owns_zero[3];  /* top or left edge: samples exactly on it are inside */
};

/* Pixels x0 <= x < x1, y0 <= y < y1. */
struct box {
    int x0, y0, x1, y1;
};

/* One call of ref_render. */
struct job {
    const struct ref_triangle *triangles;
    size_t n;
    const struct ref_camera *camera;
    const struct ref_light *light;
    const struct ref_depth *depth;
    int width, height;
    double *z;      /* least distance by pixel so far */
    size_t *winner; /* its triangle, or NO_TRIANGLE */
    /* Layers, from far to near: the one before by pixel, and the picture so far; else NULL. z and winner are those of
     * the farthest one nearer than that. */
    double *last_z, *under;
    size_t *last;
};

/* ---- vectors ---- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void sub(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Scales to unit length; returns the length it had (0: left alone). */
static double normalise(double a[3])
{
    double length = sqrt(dot(a, a));

    for (int k = 0; k < 3 && length > 0; k++)
        a[k] /= length;
    return length;
}

/* ---- exact determinants ---- */

/* Adds b without error (Shewchuk's grow-expansion), dropping parts that are 0. */
static void expansion_add(struct expansion *e, double b)
{
    int kept = 0;

    for (int i = 0; i < e->n; i++) {
        double a = e->part[i], sum = a + b, b_seen = sum - a;
        double lost = (a - (sum - b_seen)) + (b - b_seen);

        if (lost != 0)
            e->part[kept++] = lost;
        b = sum;
    }
    if (b != 0)
        e->part[kept++] = b;
    e->n = kept;
}

/* Adds x * y without error, barring underflow. */
static void expansion_add_product(struct expansion *e, double x, double y)
{
    double product = x * y;

    expansion_add(e, fma(x, y, -product));
    expansion_add(e, product);
}

static void expansion_add_triple(struct expansion *e, double x, double y, double z)
{
    double product = x * y;

    expansion_add_product(e, fma(x, y, -product), z);
    expansion_add_product(e, product, z);
}

/* det(a, b, c), the sign always right and the value to about an ulp. */
static double exact_det(const double a[3], const double b[3], const double c[3])
{
    struct expansion e = { .n = 0 };
    double value = 0;

    for (int k = 0; k < 3; k++) {
        int k1 = (k + 1) % 3, k2 = (k + 2) % 3;

        if (c[k] == 0) /* speed only */
            continue;
        expansion_add_triple(&e, a[k1], b[k2], c[k]);
        expansion_add_triple(&e, -a[k2], b[k1], c[k]);
    }
    for (int i = 0; i < e.n; i++)
        value += e.part[i];
    return value;
}

/* Is the sign of det(a, b, c) that of the plain sum of its six products? Each is off by less than 2^-50 of itself. */
static int plain_sign(const double a[3], const double b[3], const double c[3], double *det)
{
    double sum = 0, size = 0;

    for (int k = 0; k < 3; k++) {
        const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        const double plus = a[k1] * b[k2] * c[k], minus = a[k2] * b[k1] * c[k];

        sum += plus - minus;
        size += fabs(plus) + fabs(minus);
    }
    *det = sum;
    return fabs(sum) > 1e-12 * size;
}

/* Part c of the cross product of a and b, the sign always right and the value to about an ulp: the errors of both
 * products count, and where these are nearly alike all is exact. */
static double exact_cross(const double a[3], const double b[3], int c)
{
    const int i = (c + 1) % 3, j = (c + 2) % 3;
    const double plus = a[i] * b[j], minus = a[j] * b[i];
    const double sum = plus - minus, seen = plus - sum, lost = (plus - (sum + seen)) + (seen - minus);

    if (fabs(sum) < 1e-3 * fabs(plus)) {
        const double axis[3] = { c == 0, c == 1, c == 2 };

        return exact_det(a, b, axis);
    }
    return sum + (lost + (fma(a[i], b[j], -plus) - fma(a[j], b[i], -minus)));
}

/* ---- camera and depth ---- */

int ref_camera_look_at(struct ref_camera *camera, const double eye[3], const double at[3],
                       const double up[3])
{
    double back[3], right[3], true_up[3], up_unit[3];

    memcpy(up_unit, up, sizeof up_unit);
    sub(eye, at, back);
    if (!(normalise(back) > 0) || !(normalise(up_unit) > 0))
        return REF_BAD_ARGUMENT;
    cross(up_unit, back, right);
    if (!(normalise(right) > 1e-12) || !isfinite(dot(eye, eye))) /* a NaN fails the first */
        return REF_BAD_ARGUMENT;
    cross(back, right, true_up);
    memcpy(camera->eye, eye, sizeof camera->eye);
    memcpy(camera->right, right, sizeof camera->right);
    memcpy(camera->up, true_up, sizeof camera->up);
    memcpy(camera->back, back, sizeof camera->back);
    return REF_OK;
}

double ref_focal(double fov_y, int height)
{
    return height / 2.0 / tan(fov_y / 2);
}

static double key_scale(const struct ref_depth *depth)
{
    return (double)((1 << depth->bits) - 1);
}

/* Exponent bits of a float mapping; 0 for the others. */
static int exponent_bits(const struct ref_depth *depth)
{
    return depth->mapping == REF_DEPTH_E3M13   ? 3
           : depth->mapping == REF_DEPTH_E4M12 ? 4
           : depth->mapping == REF_DEPTH_E5M11 ? 5
                                               : 0;
}

/* r in 2^-(k+1)..2^-k has the exponent k, at most 2^e - 2; at near it may round beyond 1. */
static double float_key(const struct ref_depth *depth, double r)
{
    int e = exponent_bits(depth), m = depth->bits - e, most = (1 << e) - 2, k;

    (void)frexp(r, &k);
    k = -k < 0 ? 0 : -k > most ? most : -k;
    return ldexp(1, depth->bits) - (ldexp(most - k, m) + ldexp(r, k + 1 + m));
}

/* The r whose key it is; 0 for 2^bits. */
static double float_share(const struct ref_depth *depth, double key)
{
    int e = exponent_bits(depth), m = depth->bits - e, most = (1 << e) - 2;
    double code = ldexp(1, depth->bits) - key;
    int step = (int)fmin(fmax(floor(ldexp(code, -m)) - 1, 0), most);

    return ldexp(code - ldexp(step, m), -(most - step + 1 + m));
}

double ref_exact_key(const struct ref_depth *depth, const struct ref_camera *camera, double z)
{
    double n = camera->near_z, f = camera->far_z;

    if (exponent_bits(depth))
        return float_key(depth, n / z);
    if (depth->mapping == REF_DEPTH_LINEAR)
        return (z - n) / (f - n) * key_scale(depth);
    return (1 / n - 1 / z) / (1 / n - 1 / f) * key_scale(depth);
}

uint16_t ref_round_key(const struct ref_depth *depth, double exact_key)
{
    double top = key_scale(depth) - 1;

    return (uint16_t)fmin(fmax(floor(exact_key + 0.5), 0), top);
}

double ref_key_to_z(const struct ref_depth *depth, const struct ref_camera *camera, double key)
{
    double n = camera->near_z, f = camera->far_z, share = key / key_scale(depth);

    if (exponent_bits(depth))
        return n / float_share(depth, key);
    if (depth->mapping == REF_DEPTH_LINEAR)
        return n + share * (f - n);
    return 1 / (1 / n - share * (1 / n - 1 / f));
}

/* ---- arguments ---- */

static int depth_is_valid(const struct ref_depth *depth, const struct ref_camera *camera)
{
    double n = camera->near_z, f = camera->far_z;

    if (depth->mapping < REF_DEPTH_RECIP || depth->mapping > REF_DEPTH_E5M11)
        return 0;
    if (depth->bits < 8 || depth->bits > 16)
        return 0;
    if (depth->mapping != REF_DEPTH_LINEAR && !(n > 0))
        return 0;
    if (exponent_bits(depth) && camera->orthographic)
        return 0;
    return isfinite(n) && isfinite(f) && n < f;
}

static int camera_is_valid(const struct ref_camera *camera)
{
    if (camera->orthographic)
        return isfinite(camera->height) && camera->height > 0;
    return isfinite(camera->focal) && camera->focal > 0 && camera->near_z > 0;
}

static int size_is_valid(int width, int height)
{
    return width >= 1 && height >= 1 && width <= REF_MAX_SIDE && height <= REF_MAX_SIDE;
}

static int is_textured(const struct ref_triangle *t)
{
    return t->shade >= REF_SHADE_TEXTURE;
}

static int texture_is_valid(const struct ref_triangle *t)
{
    const struct ref_texture *texture = t->texture;

    for (int k = 0; k < 6; k++) {
        if (!(fabs(t->uv[k / 2][k % 2]) <= MAX_UV))
            return 0;
    }
    return texture && size_is_valid(texture->width, texture->height) &&
           !texture->rgb != !texture->rgb565;
}

static int triangle_is_valid(const struct ref_triangle *t, int want_id, int have_light)
{
    for (int k = 0; k < 9; k++) {
        if (!(fabs(t->p[k / 3][k % 3]) <= MAX_COORDINATE)) /* false for a NaN */
            return 0;
    }
    if (t->shade < REF_SHADE_RAW || t->shade > REF_SHADE_TEXTURE_SMOOTH)
        return 0;
    if (is_textured(t) && !texture_is_valid(t))
        return 0;
    if (t->cull < REF_CULL_BACK || t->cull > REF_CULL_NONE)
        return 0;
    return (t->id != 0 || !want_id) &&
           (have_light || t->shade == REF_SHADE_RAW || t->shade == REF_SHADE_TEXTURE);
}

static int job_is_valid(const struct job *job, const struct ref_image *image)
{
    if (!size_is_valid(job->width, job->height) || !camera_is_valid(job->camera))
        return 0;
    if (!depth_is_valid(job->depth, job->camera))
        return 0;
    for (size_t i = 0; i < job->n; i++) {
        if (!triangle_is_valid(&job->triangles[i], image->id != NULL, job->light != NULL))
            return 0;
    }
    return 1;
}

/* ---- from triangle to lines ---- */

static void project(const struct ref_camera *camera, int height, const double p[3], double v[3],
                    double *z)
{
    double rel[3], x, y;

    sub(p, camera->eye, rel);
    x = dot(rel, camera->right);
    y = dot(rel, camera->up);
    *z = -dot(rel, camera->back);
    v[0] = camera->orthographic ? x * height / camera->height : x * camera->focal;
    v[1] = camera->orthographic ? -y * height / camera->height : -y * camera->focal;
    v[2] = camera->orthographic ? 1 : *z;
}

/*
 * The lines, positive inside; their coefficients are right to the last bit or so, in sign always.
 * A line growing rightwards is a left edge, and a level one growing downwards a top edge.
 */
static void make_lines(const struct job *job, struct setup *s)
{
    for (int k = 0; k < 3; k++) {
        const double *a = s->v[(k + 1) % 3], *b = s->v[(k + 2) % 3];
        double *line = s->line[k];

        for (int c = 0; c < 3; c++)
            line[c] = s->sign * exact_cross(a, b, c);
        s->owns_zero[k] = line[0] > 0 || (line[0] == 0 && line[1] > 0);
        s->doubt[k] = DOUBTFUL * (fabs(line[0]) * job->width / 2 +
                                  fabs(line[1]) * job->height / 2 + fabs(line[2]));
    }
}

/* Returns 0 if the triangle is culled, has no area on the screen or is outside near..far. */
static int setup_triangle(const struct job *job, const struct ref_triangle *t, struct setup *s)
{
    double det;

    for (int k = 0; k < 3; k++)
        project(job->camera, job->height, t->p[k], s->v[k], &s->z[k]);
    if (fmax(s->z[0], fmax(s->z[1], s->z[2])) < job->camera->near_z)
        return 0;
    if (fmin(s->z[0], fmin(s->z[1], s->z[2])) > job->camera->far_z)
        return 0;
    if (!plain_sign(s->v[0], s->v[1], s->v[2], &det))
        det = exact_det(s->v[0], s->v[1], s->v[2]);
    /* y points down here, so counter-clockwise in a y-up view is negative */
    if (det == 0 || t->cull == (det < 0 ? REF_CULL_FRONT : REF_CULL_BACK))
        return 0;
    s->sign = det < 0 ? -1 : 1;
    make_lines(job, s);
    return 1;
}

/* ---- where it can lie ---- */

static void box_add(double box[4], const double v[3])
{
    box[0] = fmin(box[0], v[0] / v[2]);
    box[1] = fmin(box[1], v[1] / v[2]);
    box[2] = fmax(box[2], v[0] / v[2]);
    box[3] = fmax(box[3], v[1] / v[2]);
}

/* The point of a-b at depth w; a and b lie on different sides of it. */
static void cut_at(const double a[3], const double b[3], double w, double out[3])
{
    double t = (w - a[2]) / (b[2] - a[2]);

    out[0] = a[0] + t * (b[0] - a[0]);
    out[1] = a[1] + t * (b[1] - a[1]);
    out[2] = w;
}

static int to_index(double x, int limit)
{
    if (!(x > 0))
        return 0;
    return x < limit ? (int)x : limit;
}

/*
 * Pixels the triangle may cover. The part behind half the near distance is cut off to keep the
 * projection finite: half, so that samples which rounding puts at or before near stay in the box.
 * One pixel of margin absorbs the rounding of the rest. (Orthographic: w is 1, nothing is cut.)
 */
static struct box bound(const struct job *job, const struct setup *s)
{
    double w_min = (job->camera->orthographic ? 1 : job->camera->near_z) / 2;
    double box[4] = { INFINITY, INFINITY, -INFINITY, -INFINITY }, cut[3];
    double half_w = job->width / 2.0, half_h = job->height / 2.0;
    struct box out;

    for (int k = 0; k < 3; k++) {
        const double *a = s->v[k], *b = s->v[(k + 1) % 3];

        if (a[2] >= w_min)
            box_add(box, a);
        if ((a[2] >= w_min) != (b[2] >= w_min)) {
            cut_at(a, b, w_min, cut);
            box_add(box, cut);
        }
    }
    out.x0 = to_index(box[0] + half_w - 1, job->width);
    out.y0 = to_index(box[1] + half_h - 1, job->height);
    out.x1 = to_index(box[2] + half_w + 2, job->width);
    out.y1 = to_index(box[3] + half_h + 2, job->height);
    return out;
}

/*
 * Cuts x0..x1 of a row to where line k is not negative, give or take a pixel; `base` is the line's
 * value at the row's centre. Speed only: what is left is still tested.
 */
static void narrow(const struct setup *s, int k, double base, int width, int *x0, int *x1)
{
    double slope = s->line[k][0], most = base + s->doubt[k], zero_at;

    if (slope == 0) {
        *x1 = most < 0 ? *x0 : *x1;
        return;
    }
    zero_at = -most / slope + width / 2.0 - 0.5; /* as a pixel index */
    if (slope > 0) {
        int from = to_index(zero_at - 1, width);
        *x0 = from > *x0 ? from : *x0;
    } else {
        int to = to_index(zero_at + 3, width);
        *x1 = to < *x1 ? to : *x1;
    }
}

/* ---- visibility ---- */

/* A value at the point seen, from those at the vertices. Exactly theirs if all three are equal. */
static double blend(const double weight[3], double a0, double a1, double a2)
{
    return a0 + weight[1] * (a1 - a0) + weight[2] * (a2 - a0);
}

/* Weights of the vertices from the values of the lines, in place. Returns 0 if they vanish. */
static int normalise_weights(double weight[3])
{
    double sum = weight[0] + weight[1] + weight[2];

    for (int k = 0; k < 3 && sum != 0; k++)
        weight[k] /= sum;
    return sum != 0;
}

static int is_inside(const struct setup *s, const double value[3])
{
    for (int k = 0; k < 3; k++) {
        if (!(value[k] > 0 || (value[k] == 0 && s->owns_zero[k])))
            return 0;
    }
    return 1;
}

static double sample_x(const struct job *job, int i)
{
    return i + 0.5 - job->width / 2.0;
}

static double sample_y(const struct job *job, int j)
{
    return j + 0.5 - job->height / 2.0;
}

/* Values of the three lines at the centre of a row, from which lines_at goes on sideways. */
static void row_base(const struct setup *s, double sy, double base[3])
{
    for (int k = 0; k < 3; k++)
        base[k] = s->line[k][1] * sy + s->line[k][2];
}

/* Values of the three lines at a sample, their signs certain. */
static void lines_at(const struct setup *s, const double base[3], double sx, double sy,
                     double value[3])
{
    const double sample[3] = { sx, sy, 1 };

    for (int k = 0; k < 3; k++) {
        value[k] = s->line[k][0] * sx + base[k];
        if (fabs(value[k]) <= s->doubt[k])
            value[k] = s->sign * exact_det(s->v[(k + 1) % 3], s->v[(k + 2) % 3], sample);
    }
}

/* Is it nearer than the layer before, and farther than the one found so far? Of equally far ones the first. */
static int is_next_layer(const struct job *job, double z, size_t pixel, size_t index)
{
    const double last = job->last_z[pixel];
    const int nearer = z < last || (z == last && job->last[pixel] != NO_TRIANGLE && index > job->last[pixel]);

    return nearer && (job->winner[pixel] == NO_TRIANGLE || z > job->z[pixel]);
}

static void try_pixel(const struct job *job, const struct setup *s, double value[3], size_t pixel,
                      size_t index)
{
    double z;

    if (!is_inside(s, value) || !normalise_weights(value))
        return;
    z = blend(value, s->z[0], s->z[1], s->z[2]);
    if (job->last) {
        if (z >= job->camera->near_z && z <= job->camera->far_z && is_next_layer(job, z, pixel, index)) {
            job->z[pixel] = z;
            job->winner[pixel] = index;
        }
        return;
    }
    if (z >= job->camera->near_z && z <= job->camera->far_z && z < job->z[pixel]) {
        job->z[pixel] = z;
        job->winner[pixel] = index;
    }
}

static void draw_row(const struct job *job, const struct setup *s, int y, struct box box,
                     size_t index)
{
    size_t row = (size_t)y * (size_t)job->width;
    double base[3], value[3], sy = sample_y(job, y);

    row_base(s, sy, base);
    for (int k = 0; k < 3; k++)
        narrow(s, k, base[k], job->width, &box.x0, &box.x1);
    for (int x = box.x0; x < box.x1; x++) {
        lines_at(s, base, sample_x(job, x), sy, value);
        try_pixel(job, s, value, row + (size_t)x, index);
    }
}

static void draw_triangle(const struct job *job, size_t index)
{
    struct setup s;
    struct box box;

    if (!setup_triangle(job, &job->triangles[index], &s))
        return;
    box = bound(job, &s);
    for (int y = box.y0; y < box.y1; y++)
        draw_row(job, &s, y, box, index);
}

static void draw_all(const struct job *job, ref_progress progress, void *user)
{
    for (size_t i = 0; i < job->n; i++) {
        if (progress && i % PROGRESS_STEP == 0)
            progress(user, i, job->n);
        draw_triangle(job, i);
    }
    if (progress)
        progress(user, job->n, job->n);
}

/* ---- colour ---- */

/* To 0..1; a NaN becomes 0. */
static double clamp01(double c)
{
    return c > 0 ? (c < 1 ? c : 1) : 0;
}

static void unpack(uint16_t code, double rgb[3])
{
    rgb[0] = (code >> 11) / 31.0;
    rgb[1] = (code >> 5 & 63) / 63.0;
    rgb[2] = (code & 31) / 31.0;
}

static uint16_t pack(const double rgb[3])
{
    unsigned r = (unsigned)round(clamp01(rgb[0]) * 31);
    unsigned g = (unsigned)round(clamp01(rgb[1]) * 63);
    unsigned b = (unsigned)round(clamp01(rgb[2]) * 31);

    return (uint16_t)(r << 11 | g << 5 | b);
}

static double intensity(const struct ref_light *light, const double n[3])
{
    return light->ambient + light->diffuse * fmax(0, dot(n, light->dir));
}

static void light_colour(const struct ref_light *light, const double n[3], const double base[3],
                         double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = clamp01(base[c] * intensity(light, n));
}

static void face_normal(const struct ref_triangle *t, double n[3])
{
    double a[3], b[3];

    if (t->has_face_n) {
        memcpy(n, t->face_n, 3 * sizeof n[0]);
        return;
    }
    sub(t->p[1], t->p[0], a);
    sub(t->p[2], t->p[0], b);
    cross(a, b, n);
    normalise(n);
}

/* What a triangle brings to its pixels. */
struct paint {
    double colour[3][3]; /* of the vertices; all the same unless smooth */
    double light[3];     /* textured: intensity at the vertices */
    int lamps;           /* flag: textured or per pixel, by lamps; of the vertices: */
    double diffuse[3][3], more[3][3];
};

static double held(double c, double most)
{
    return c > 0 ? (c < most ? c : most) : 0;
}

/* A surface of that colour in the light at a point. */
static void lamp_colour(const double base[3], const double diffuse[3], const double more[3], double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = clamp01(base[c] * diffuse[c] + more[c]);
}

static int is_smooth(const struct ref_triangle *t)
{
    return t->shade == REF_SHADE_SMOOTH || t->shade == REF_SHADE_TEXTURE_SMOOTH;
}

/* Returns 0 where lamps do not matter. */
static int paint_lamps(const struct job *job, const struct ref_triangle *t, struct paint *out)
{
    double n[3], middle[3];

    if (!job->light || !job->light->lamp || t->shade == REF_SHADE_RAW || t->shade == REF_SHADE_TEXTURE)
        return 0;
    out->lamps = is_textured(t) || (is_smooth(t) && job->light->per_pixel);
    face_normal(t, n);
    for (int c = 0; c < 3; c++)
        middle[c] = (t->p[0][c] + t->p[1][c] + t->p[2][c]) / 3;
    for (int k = 0; k < 3; k++) {
        const double *at = is_smooth(t) ? t->p[k] : middle, *normal = is_smooth(t) ? t->n[k] : n;

        ref_lamps_at(job->light, t, job->camera, at, normal, normal, out->diffuse[k], out->more[k]);
        lamp_colour(t->rgb[is_smooth(t) ? k : 0], out->diffuse[k], out->more[k], out->colour[k]);
        for (int c = 0; c < 3; c++) {
            out->diffuse[k][c] = held(out->diffuse[k][c], 2);
            out->more[k][c] = held(out->more[k][c], 1);
        }
    }
    return 1;
}

static void paint_texture(const struct ref_triangle *t, const struct ref_light *light,
                          struct paint *out)
{
    double n[3];

    for (int k = 0; k < 3; k++) {
        out->light[k] = 1;
        if (t->shade == REF_SHADE_TEXTURE_SMOOTH)
            out->light[k] = intensity(light, t->n[k]);
        if (t->shade == REF_SHADE_TEXTURE_FLAT) {
            face_normal(t, n);
            out->light[k] = intensity(light, n);
        }
    }
}

static void paint(const struct job *job, const struct ref_triangle *t, struct paint *out)
{
    const struct ref_light *light = job->light;
    double n[3];

    out->lamps = 0;
    if (paint_lamps(job, t, out))
        return;
    for (int k = 0; k < 3; k++) {
        if (t->shade == REF_SHADE_SMOOTH) {
            light_colour(light, t->n[k], t->rgb[k], out->colour[k]);
        } else if (t->shade == REF_SHADE_FLAT) {
            face_normal(t, n);
            light_colour(light, n, t->rgb[0], out->colour[k]);
        } else if (t->shade == REF_SHADE_RAW) {
            unpack(t->raw, out->colour[k]);
        }
    }
    if (is_textured(t))
        paint_texture(t, light, out);
}

/* ---- textures ---- */

/* The texel of a coordinate along an axis of n texels. */
static int texel_at(double coordinate, int n, int clamped)
{
    double at = floor(coordinate * n + ON_BORDER);

    if (!clamped)
        at -= n * floor(at / n);
    return (int)fmin(fmax(at, 0), n - 1);
}

static size_t texel_index(const struct ref_texture *t, double u, double v)
{
    return (size_t)texel_at(v, t->height, t->clamp_v) * (size_t)t->width +
           (size_t)texel_at(u, t->width, t->clamp_u);
}

static void texel_colour(const struct ref_texture *t, size_t index, double rgb[3])
{
    if (t->rgb565)
        unpack(t->rgb565[index], rgb);
    for (int c = 0; c < 3 && !t->rgb565; c++)
        rgb[c] = t->rgb[3 * index + (size_t)c] / 255.0;
}

/* The mean of the four texels around a point, by how near their centres are. */
static void mixed_colour(const struct ref_texture *t, double u, double v, double rgb[3])
{
    const double x = u * t->width - 0.5, y = v * t->height - 0.5, x0 = floor(x), y0 = floor(y);

    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int k = 0; k < 4; k++) {
        const int i = k & 1, j = k >> 1;
        const double weight = (i ? x - x0 : 1 - (x - x0)) * (j ? y - y0 : 1 - (y - y0));
        double one[3];

        texel_colour(t, texel_index(t, (x0 + i + 0.5) / t->width, (y0 + j + 0.5) / t->height), one);
        for (int c = 0; c < 3; c++)
            rgb[c] += weight * one[c];
    }
}

/* The colour of the level that a pixel sees; change: of u or v to the next pixel, in texels. */
static void level_colour(const struct ref_texture *t, double change, double u, double v, double rgb[3])
{
    for (; t->half && change >= 1.4142135623730951; change /= 2)
        t = t->half;
    mixed_colour(t, u, v, rgb);
}

/* ---- from visibility to picture ---- */

static void put_colour(struct ref_image *image, size_t pixel, const double rgb[3])
{
    if (image->rgb565)
        image->rgb565[pixel] = pack(rgb);
    if (image->rgb)
        memcpy(image->rgb + 3 * pixel, rgb, 3 * sizeof rgb[0]);
}

static void put_depth(const struct job *job, struct ref_image *image, size_t pixel)
{
    int drawn = job->winner[pixel] != NO_TRIANGLE;
    double key = drawn ? ref_exact_key(job->depth, job->camera, job->z[pixel]) : (double)INFINITY;

    if (image->exact_key)
        image->exact_key[pixel] = key;
    if (image->key)
        image->key[pixel] = drawn ? ref_round_key(job->depth, key) : REF_KEY_NOTHING;
}

static void put_id(const struct job *job, struct ref_image *image, size_t pixel)
{
    size_t winner = job->winner[pixel];

    if (image->id)
        image->id[pixel] = winner == NO_TRIANGLE ? 0 : job->triangles[winner].id;
}

/* Weights of a triangle's vertices at a pixel that it covers. */
static void weights_at(const struct job *job, const struct setup *s, size_t pixel, double weight[3])
{
    size_t width = (size_t)job->width;
    double sx = sample_x(job, (int)(pixel % width)), sy = sample_y(job, (int)(pixel / width));
    double base[3];

    row_base(s, sy, base);
    lines_at(s, base, sx, sy, weight);
    normalise_weights(weight);
}

static void put_texture(struct ref_image *image, size_t pixel, const struct ref_texture *texture,
                        double u, double v, uint32_t texel)
{
    if (image->u)
        image->u[pixel] = u;
    if (image->v)
        image->v[pixel] = v;
    if (image->texel)
        image->texel[pixel] = texel;
    if (image->texture)
        image->texture[pixel] = texture;
}

/* Light of lamps at the pixel: from the vertices, or that of the point. */
static void lamps_at_pixel(const struct job *job, const struct ref_triangle *t, const struct paint *p,
                           const double weight[3], double diffuse[3], double more[3])
{
    double at[3], n[3], side[3];

    for (int c = 0; c < 3; c++) {
        at[c] = blend(weight, t->p[0][c], t->p[1][c], t->p[2][c]);
        n[c] = blend(weight, t->n[0][c], t->n[1][c], t->n[2][c]);
        diffuse[c] = blend(weight, p->diffuse[0][c], p->diffuse[1][c], p->diffuse[2][c]);
        more[c] = blend(weight, p->more[0][c], p->more[1][c], p->more[2][c]);
    }
    if (job->light->per_pixel && is_smooth(t)) {
        face_normal(t, side);
        ref_lamps_at(job->light, t, job->camera, at, n, side, diffuse, more);
    }
}

/* The larger change of u or v over a pixel, in texels. */
static double texels_a_pixel(const struct job *job, const struct setup *s, const struct ref_triangle *t, size_t pixel)
{
    const size_t width = (size_t)job->width;
    const double sx = sample_x(job, (int)(pixel % width)), sy = sample_y(job, (int)(pixel / width));
    double most = 0;

    for (int down = 0; down < 2; down++) {
        double uv[2][2];

        for (int k = 0; k < 2; k++) {
            double base[3], weight[3];

            row_base(s, sy + (down ? k - 0.5 : 0), base);
            for (int i = 0; i < 3; i++)
                weight[i] = s->line[i][0] * (sx + (down ? 0 : k - 0.5)) + base[i];
            normalise_weights(weight);
            for (int i = 0; i < 2; i++)
                uv[k][i] = blend(weight, t->uv[0][i], t->uv[1][i], t->uv[2][i]);
        }
        most = fmax(most, fmax(fabs(uv[1][0] - uv[0][0]) * t->texture->width,
                               fabs(uv[1][1] - uv[0][1]) * t->texture->height));
    }
    return most;
}

static void seen_texel(const struct job *job, const struct setup *s, const struct ref_triangle *t,
                       const struct paint *p, const double weight[3], struct ref_image *image, size_t pixel,
                       double rgb[3])
{
    double u = blend(weight, t->uv[0][0], t->uv[1][0], t->uv[2][0]);
    double v = blend(weight, t->uv[0][1], t->uv[1][1], t->uv[2][1]);
    double light = blend(weight, p->light[0], p->light[1], p->light[2]), diffuse[3], more[3];
    size_t index = texel_index(t->texture, u, v);

    if (t->texture->half)
        level_colour(t->texture, texels_a_pixel(job, s, t, pixel), u, v, rgb);
    else if (t->texture->bilinear)
        mixed_colour(t->texture, u, v, rgb);
    else
        texel_colour(t->texture, index, rgb);
    if (p->lamps) {
        lamps_at_pixel(job, t, p, weight, diffuse, more);
        lamp_colour(rgb, diffuse, more, rgb);
    } else {
        for (int c = 0; c < 3; c++)
            rgb[c] = clamp01(rgb[c] * light);
    }
    put_texture(image, pixel, t->texture, u, v, (uint32_t)index + 1);
}

static void seen_colour(const struct job *job, const struct ref_triangle *t, const struct paint *p,
                        const double weight[3], double rgb[3])
{
    double base[3], diffuse[3], more[3];

    for (int c = 0; c < 3; c++) {
        rgb[c] = blend(weight, p->colour[0][c], p->colour[1][c], p->colour[2][c]);
        base[c] = blend(weight, t->rgb[0][c], t->rgb[1][c], t->rgb[2][c]);
    }
    if (p->lamps) {
        lamps_at_pixel(job, t, p, weight, diffuse, more);
        lamp_colour(base, diffuse, more, rgb);
    }
}

static void seen_fog(const struct job *job, size_t pixel, double rgb[3])
{
    const struct ref_fog *fog = job->light ? job->light->fog : NULL;
    const double part = fog ? ref_fog_at(fog, job->z[pixel]) : 0;

    for (int c = 0; c < 3 && fog; c++)
        rgb[c] += part * ((job->light->layers == REF_ADD ? 0 : fog->rgb[c]) - rgb[c]);
}

/* Lay a layer's colour over what is there. */
static void lay_over(const struct job *job, const double under[3], double rgb[3])
{
    const double alpha = job->light->alpha;

    for (int c = 0; c < 3; c++)
        rgb[c] = job->light->layers == REF_ADD ? fmin(under[c] + alpha * rgb[c], 1)
                                               : alpha * rgb[c] + (1 - alpha) * under[c];
}

/* Shades the visible pixels. A triangle's setup is made again here, once for each run of pixels. */
static void resolve(const struct job *job, uint16_t background, struct ref_image *image)
{
    size_t pixels = (size_t)job->width * (size_t)job->height, current = NO_TRIANGLE;
    double weight[3], rgb[3];
    struct setup s = { 0 };
    struct paint p = { 0 };

    for (size_t i = 0; i < pixels; i++) {
        size_t winner = job->winner[i];
        const struct ref_triangle *t = winner == NO_TRIANGLE ? NULL : &job->triangles[winner];

        put_id(job, image, i);
        put_depth(job, image, i);
        put_texture(image, i, NULL, (double)NAN, (double)NAN, 0);
        unpack(background, rgb);
        if (job->under)
            memcpy(rgb, job->under + 3 * i, sizeof rgb);
        if (t && winner != current) {
            setup_triangle(job, t, &s);
            paint(job, t, &p);
            current = winner;
        }
        if (t)
            weights_at(job, &s, i, weight);
        if (t && is_textured(t))
            seen_texel(job, &s, t, &p, weight, image, i, rgb);
        else if (t)
            seen_colour(job, t, &p, weight, rgb);
        if (t)
            seen_fog(job, i, rgb);
        if (t && job->under)
            lay_over(job, job->under + 3 * i, rgb);
        if (job->under)
            memcpy(job->under + 3 * i, rgb, sizeof rgb);
        put_colour(image, i, rgb);
    }
}

/* Every layer, from far to near. What is seen of the nearest stays in the other buffers. */
static int draw_layers(struct job *job, uint16_t background, struct ref_image *image)
{
    const size_t pixels = (size_t)job->width * (size_t)job->height;
    struct ref_image colours = { .rgb565 = image->rgb565, .rgb = image->rgb };
    double *const nearest = job->z, *const z = malloc(pixels * sizeof *z);
    size_t found = 1;

    job->under = malloc(3 * pixels * sizeof *job->under);
    job->last_z = malloc(pixels * sizeof *job->last_z);
    job->last = malloc(pixels * sizeof *job->last);
    if (!job->under || !job->last_z || !job->last || !z) {
        free(z);
        return REF_NO_MEMORY;
    }
    job->z = z;
    for (size_t i = 0; i < pixels; i++) {
        unpack(background, job->under + 3 * i);
        job->last_z[i] = INFINITY;
        job->last[i] = NO_TRIANGLE;
    }
    while (found) {
        found = 0;
        for (size_t i = 0; i < pixels; i++)
            job->winner[i] = NO_TRIANGLE;
        draw_all(job, NULL, NULL);
        resolve(job, background, &colours);
        for (size_t i = 0; i < pixels; i++)
            if (job->winner[i] != NO_TRIANGLE) {
                job->last_z[i] = job->z[i];
                job->last[i] = job->winner[i];
                found++;
            }
    }
    job->z = nearest;
    free(z);
    return REF_OK;
}

/* z is the caller's own buffer if wanted, so that it comes out filled. */
static int job_alloc(struct job *job, const struct ref_image *image)
{
    size_t pixels = (size_t)job->width * (size_t)job->height;

    job->winner = malloc(pixels * sizeof *job->winner);
    job->z = image->z ? image->z : malloc(pixels * sizeof *job->z);
    if (!job->winner || !job->z)
        return REF_NO_MEMORY;
    for (size_t i = 0; i < pixels; i++) {
        job->winner[i] = NO_TRIANGLE;
        job->z[i] = INFINITY;
    }
    return REF_OK;
}

static void job_free(struct job *job, const struct ref_image *image)
{
    free(job->winner);
    free(job->under);
    free(job->last_z);
    free(job->last);
    if (!image->z)
        free(job->z);
}

int ref_render(const struct ref_triangle *triangles, size_t n, const struct ref_camera *camera,
               const struct ref_light *light, const struct ref_depth *depth, uint16_t background,
               int width, int height, struct ref_image *image, ref_progress progress, void *user)
{
    struct job job = { triangles, n, camera, light, depth, width, height, NULL, NULL, NULL, NULL, NULL };
    int status;

    if (!job_is_valid(&job, image))
        return REF_BAD_ARGUMENT;
    status = job_alloc(&job, image);
    if (status == REF_OK) {
        draw_all(&job, progress, user);
        resolve(&job, background, image);
    }
    if (status == REF_OK && light && light->layers != REF_OPAQUE)
        status = draw_layers(&job, background, image);
    job_free(&job, image);
    return status;
}

/* ---- comparison ---- */

/* One call of ref_compare. */
struct contest {
    const struct ref_image *ours, *ref;
    const struct ref_depth *depth;
    const struct ref_camera *camera;
    int have_ids, have_keys, have_colours, have_texels;
    double z_sum;      /* of relative errors */
    double square_sum; /* of 8-bit channel errors */
};

/* Who is at a pixel, as far as these images can tell; 0 for nobody. */
static uint32_t occupant(const struct contest *c, const struct ref_image *image, size_t pixel)
{
    if (c->have_ids)
        return image->id[pixel];
    return c->have_keys ? image->key[pixel] != REF_KEY_NOTHING : 1;
}

/* Counts the pixel's coverage; returns whether the images agree on a triangle there. */
static int compare_cover(const struct contest *c, struct ref_diff *d, size_t pixel)
{
    uint32_t a = occupant(c, c->ours, pixel), b = occupant(c, c->ref, pixel);

    d->ref_drawn += b != 0;
    d->missing += b != 0 && a == 0;
    d->extra += b == 0 && a != 0;
    d->id_differ += a != 0 && b != 0 && a != b;
    d->agree += a != 0 && a == b;
    return a != 0 && a == b;
}

static void compare_key(const struct contest *c, struct ref_diff *d, size_t pixel)
{
    int ours = c->ours->key[pixel], diff = abs(ours - c->ref->key[pixel]);

    d->key_compared++;
    d->key_off += diff > 1;
    d->key_max_diff = diff > d->key_max_diff ? diff : d->key_max_diff;
    if (c->ref->exact_key)
        d->key_max_error = fmax(d->key_max_error, fabs(ours - c->ref->exact_key[pixel]));
}

static double true_z(const struct contest *c, size_t pixel)
{
    if (c->ref->z)
        return c->ref->z[pixel];
    if (c->ref->exact_key)
        return ref_key_to_z(c->depth, c->camera, c->ref->exact_key[pixel]);
    return ref_key_to_z(c->depth, c->camera, c->ref->key[pixel]);
}

static void compare_z(struct contest *c, struct ref_diff *d, size_t pixel)
{
    unsigned key = c->ours->key[pixel];
    double z = true_z(c, pixel), error;

    if (key == REF_KEY_NOTHING || z == 0)
        return;
    error = fabs(ref_key_to_z(c->depth, c->camera, key) - z) / fabs(z);
    c->z_sum += error;
    d->z_compared++;
    d->z_max_rel = fmax(d->z_max_rel, error);
}

/* How far outside texel `at` of an axis the coordinate lies, in texels. */
static double outside(double coordinate, int n, int clamped, int at)
{
    double from_middle = coordinate * n - (at + 0.5);

    if (clamped)
        from_middle = fmin(fmax(coordinate * n, 0), n) - (at + 0.5);
    else
        from_middle -= n * round(from_middle / n);
    return fmax(0, fabs(from_middle) - 0.5);
}

/* Returns whether both show the same texel, or at least one none. */
static int compare_texel(const struct contest *c, struct ref_diff *d, size_t pixel)
{
    uint32_t a = c->ours->texel[pixel], b = c->ref->texel[pixel];
    const struct ref_texture *t = c->ref->texture ? c->ref->texture[pixel] : NULL;
    double distance;

    if (a == 0 || b == 0)
        return 1;
    d->texels++;
    d->texel_differ += a != b;
    if (a != b && t && c->ref->u && c->ref->v) {
        int at = (int)(a - 1);

        distance = fmax(outside(c->ref->u[pixel], t->width, t->clamp_u, at % t->width),
                        outside(c->ref->v[pixel], t->height, t->clamp_v, at / t->width));
        d->texel_far += distance > 0.125;
        d->texel_max_distance = fmax(d->texel_max_distance, distance);
    }
    return a == b;
}

static void split_codes(uint16_t code, int out[3])
{
    out[0] = code >> 11;
    out[1] = code >> 5 & 63;
    out[2] = code & 31;
}

static void split_bytes(uint16_t code, int out[3])
{
    split_codes(code, out);
    out[0] = out[0] << 3 | out[0] >> 2;
    out[1] = out[1] << 2 | out[1] >> 4;
    out[2] = out[2] << 3 | out[2] >> 2;
}

static void compare_codes(const struct contest *c, struct ref_diff *d, size_t pixel)
{
    int a[3], b[3];

    split_codes(c->ours->rgb565[pixel], a);
    split_codes(c->ref->rgb565[pixel], b);
    for (int k = 0; k < 3; k++) {
        int diff = abs(a[k] - b[k]);

        d->channels++;
        d->channel_off += diff > 1;
        d->channel_off_one += diff == 1;
        d->channel_max_diff = diff > d->channel_max_diff ? diff : d->channel_max_diff;
    }
}

static void compare_bytes(struct contest *c, size_t pixel)
{
    int a[3], b[3];

    split_bytes(c->ours->rgb565[pixel], a);
    split_bytes(c->ref->rgb565[pixel], b);
    for (int k = 0; k < 3; k++)
        c->square_sum += (double)(a[k] - b[k]) * (a[k] - b[k]);
}

static void compare_pixel(struct contest *c, struct ref_diff *d, size_t pixel)
{
    int agree = compare_cover(c, d, pixel);

    if (agree && c->have_keys) {
        compare_key(c, d, pixel);
        compare_z(c, d, pixel);
    }
    if (agree && c->have_texels)
        agree = compare_texel(c, d, pixel);
    if (agree && c->have_colours)
        compare_codes(c, d, pixel);
    if (c->have_colours)
        compare_bytes(c, pixel);
}

/* Means and decibels, from the sums. */
static void conclude(const struct contest *c, struct ref_diff *d)
{
    double mean_square = c->square_sum / (3.0 * (double)d->pixels);

    if (d->z_compared)
        d->z_mean_rel = c->z_sum / (double)d->z_compared;
    if (d->channels)
        d->off_one_fraction = (double)d->channel_off_one / (double)d->channels;
    d->psnr_db = mean_square > 0 ? 10 * log10(255.0 * 255.0 / mean_square) : (double)INFINITY;
}

int ref_compare(const struct ref_image *ours, const struct ref_image *reference,
                const struct ref_depth *depth, const struct ref_camera *camera, int width,
                int height, struct ref_diff *diff)
{
    struct contest c = { ours, reference, depth, camera, 0, 0, 0, 0, 0, 0 };

    if (!size_is_valid(width, height) || !depth_is_valid(depth, camera))
        return REF_BAD_ARGUMENT;
    c.have_ids = ours->id && reference->id;
    c.have_keys = ours->key && reference->key;
    c.have_colours = ours->rgb565 && reference->rgb565;
    c.have_texels = ours->texel && reference->texel;
    *diff = (struct ref_diff){ .pixels = (size_t)width * (size_t)height };
    for (size_t i = 0; i < diff->pixels; i++)
        compare_pixel(&c, diff, i);
    conclude(&c, diff);
    return REF_OK;
}
