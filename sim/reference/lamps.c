/*
 * lamps.c - lamps and fog by the formulas of a textbook (Blinn-Phong).
 */
#include "lamps.h"

#include <math.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double normalise(double a[3])
{
    const double length = sqrt(dot(a, a));

    for (int k = 0; k < 3 && length > 0; k++)
        a[k] /= length;
    return length;
}

/* How much of a lamp's light arrives at p; l: unit, towards it. */
static double arrives(const struct ref_lamp *lamp, const double p[3], double l[3])
{
    double left = 1, distance;

    for (int k = 0; k < 3; k++)
        l[k] = lamp->kind == REF_LAMP_DIR ? lamp->at[k] : lamp->at[k] - p[k];
    distance = normalise(l);
    if (lamp->kind == REF_LAMP_DIR)
        return 1;
    if (distance <= 0)
        return 0;
    if (lamp->range > 0) {
        double part = 1 - distance / lamp->range * (distance / lamp->range);
        left = part > 0 ? part * part : 0;
    }
    if (lamp->kind == REF_LAMP_SPOT) {
        double aim[3] = { -lamp->aim[0], -lamp->aim[1], -lamp->aim[2] }, t;
        normalise(aim);
        t = (dot(aim, l) - lamp->outer) / (lamp->inner - lamp->outer);
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        left *= t * t * (3 - 2 * t);
    }
    return left;
}

void ref_lamps_at(const struct ref_light *light, const struct ref_triangle *t, const struct ref_camera *camera,
                  const double p[3], const double n[3], const double side[3], double diffuse[3],
                  double more[3])
{
    double unit[3] = { n[0], n[1], n[2] }, eye[3];

    for (int k = 0; k < 3; k++) {
        diffuse[k] = light->ambient;
        more[k] = t->emission[k];
        eye[k] = camera->orthographic ? camera->back[k] : camera->eye[k] - p[k];
    }
    if (normalise(unit) <= 0)
        return;
    for (int k = 0; k < 3 && t->two_sided && dot(side, eye) < 0; k++)
        unit[k] = -unit[k];
    for (int i = 0; i < light->n_lamps; i++) {
        const struct ref_lamp *lamp = &light->lamp[i];
        double l[3], h[3], gloss = 0;
        const double left = arrives(lamp, p, l), lambert = dot(unit, l);

        if (lambert <= 0)
            continue;
        for (int k = 0; k < 3; k++)
            h[k] = l[k] + camera->back[k];
        if (t->power > 0 && normalise(h) > 0)
            gloss = pow(fmax(0, dot(unit, h)), t->power);
        for (int k = 0; k < 3; k++) {
            diffuse[k] += lamp->rgb[k] * left * lambert;
            more[k] += t->specular[k] * lamp->rgb[k] * left * gloss;
        }
    }
}

double ref_fog_at(const struct ref_fog *fog, double z)
{
    const double part = fog->density > 0 ? 1 - exp(-fog->density * z) : (z - fog->start) / (fog->end - fog->start);

    return part > 0 ? (part < 1 ? part : 1) : 0;
}
