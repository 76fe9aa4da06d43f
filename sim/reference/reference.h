/*
 * reference.h - what a triangle scene truly looks like, in double precision.
 *
 * The judge of the integer renderer: it shares no code with firmware/ and makes none of its
 * compromises. Vertices are never snapped or quantised, every pixel is decided at its centre,
 * visibility compares true distances, and only the last step (key, RGB565) rounds.
 *
 * World: right-handed, y up, any length unit. Camera: looks along its own -z; "z" in this file is
 * always the distance along the viewing axis, positive in front. Screen: pixels, y down, pixel
 * (i, j) sampled at (i + 0.5, j + 0.5):
 *   pinhole       x = W/2 + focal * xc / z          y = H/2 - focal * yc / z
 *   orthographic  x = W/2 + xc * H / height         y = H/2 - yc * H / height
 * Front faces are counter-clockwise seen in a y-up view.
 *
 * Exactness: projection rounds each vertex to doubles (about 1e-13 px); from there coverage and
 * facing are exact, the top-left rule included, so triangles which share bit-identical vertices
 * share out the samples without gap or overlap, even a sample on a vertex. Whether a sample meant
 * to lie on an edge does lie on it hangs on that rounding; it surely does where the inputs make the
 * projection exact (for example an orthographic view of small dyadic coordinates). z and colours
 * are interpolated in plain doubles: relative errors of about 1e-14, worse (1e-10) only on
 * triangles thousands of times larger than their distance. Coordinates and sizes below about 1e-60
 * (but not 0) may underflow.
 *
 * Threads: no global state; calls on different images may run at once.
 */
#ifndef SIM_REFERENCE_H
#define SIM_REFERENCE_H

#include <stddef.h>
#include <stdint.h>

#define REF_KEY_NOTHING 65535u /* key of a pixel on which nothing was drawn, whatever the bits */
#define REF_MAX_SIDE 32768     /* greatest image width and height, pixels */

enum ref_status {
    REF_OK = 0,
    REF_BAD_ARGUMENT = -1, /* an argument out of the range given at its declaration */
    REF_NO_MEMORY = -2     /* scratch memory (at most 16 bytes a pixel, with layers 80) could not be had */
};

enum ref_shade {
    REF_SHADE_RAW = 0,   /* triangle's `raw`, unlit */
    REF_SHADE_FLAT = 1,  /* rgb[0], lit once with the face normal */
    REF_SHADE_SMOOTH = 2, /* rgb[k] lit with n[k] at each vertex, then interpolated in space */
    REF_SHADE_TEXTURE = 3,       /* the texel, unlit */
    REF_SHADE_TEXTURE_FLAT = 4,  /* the texel times the intensity at the face normal */
    REF_SHADE_TEXTURE_SMOOTH = 5 /* the texel times those at n[k], interpolated in space */
};

enum ref_cull { REF_CULL_BACK = 0, REF_CULL_FRONT = 1, REF_CULL_NONE = 2 };

enum ref_mapping {
    REF_DEPTH_RECIP = 0, /* (1/n - 1/z) / (1/n - 1/f) * (2^bits - 1) */
    REF_DEPTH_LINEAR = 1, /* (z - n) / (f - n) * (2^bits - 1) */
    /* r = n / z as a float of e exponent and m = bits - e mantissa bits, taken from 2^bits: with
     * 2^-(k+1) <= r <= 2^-k, k at most 2^e - 2, it is 2^bits - ((2^e - 2 - k) 2^m + r 2^(k+1+m)).
     * Pinholes only. */
    REF_DEPTH_E3M13 = 2,
    REF_DEPTH_E4M12 = 3,
    REF_DEPTH_E5M11 = 4
};

/*
 * A picture on a surface. u runs right and v down, both 0..1 over the picture; what is seen is the
 * texel in column floor(u * width), row floor(v * height). Beyond 0..1 an axis repeats, or, where
 * it is clamped, its first or last texel goes on. A coordinate up to 1e-9 texel before a border counts
 * as on it: samples that are meant to lie there belong to the texel right of or below it.
 * Exactly one of the two kinds of texels is given; rows from the top.
 */
struct ref_texture {
    int width, height;      /* 1..REF_MAX_SIDE */
    const uint8_t *rgb;     /* [height][width][3], 255 is 1; or NULL */
    const uint16_t *rgb565; /* [height][width], codes / 31, / 63, / 31; or NULL */
    int clamp_u, clamp_v;   /* flags */
    int bilinear;           /* flag: texels are mixed of the four whose centres are around the point */
    /* Mipmaps: this picture at half its width and height; NULL: none. Level k is seen, from 0 on, where the larger
     * change of u or v to the next pixel, in texels of this one, is 2^(k - 1/2) and more; bilinear in the level. */
    const struct ref_texture *half;
};

/*
 * One triangle. Coordinates are finite, magnitude at most 1e60. Normals are used as given: they
 * should be of unit length and are not turned towards the viewer, so a back side lit through
 * REF_CULL_NONE gets what its normal says (lighting is one-sided). Base colours are 0..1 by
 * channel. Fields a shade mode does not name above are ignored.
 */
struct ref_triangle {
    double p[3][3];   /* vertices, world */
    double n[3][3];   /* vertex normals, world, unit (smooth) */
    double rgb[3][3]; /* base colour by vertex (smooth); rgb[0] is the whole face's (flat) */
    double face_n[3]; /* face normal, world, unit (flat), if has_face_n */
    int has_face_n;   /* 0: flat uses the geometric normal of the counter-clockwise winding */
    uint16_t raw;     /* RGB565 (raw) */
    uint32_t id;      /* not 0 if the image asks for ids; need not be unique */
    int shade;        /* enum ref_shade */
    int cull;         /* enum ref_cull: which side is not drawn */
    double uv[3][2];  /* texture coordinates (texture modes), magnitude at most 1e9 */
    const struct ref_texture *texture; /* texture modes; borrowed */
    /* Read only in the light of lamps (ref_light): */
    double specular[3]; /* colour of highlights, 0..1 */
    double power;       /* of highlights; 0: none */
    double emission[3]; /* light of its own, 0..1 */
    int two_sided;      /* flag: normals that point away from the eye are turned round; per pixel if the face's does */
};

/*
 * A camera. right, up, back: orthonormal, right-handed, world. Only geometry with
 * near_z <= z <= far_z is seen, decided at each sample. near_z < far_z, both finite; near_z > 0
 * with a pinhole or with a mapping that is not linear.
 */
struct ref_camera {
    double eye[3];   /* world; in an orthographic view the point z is measured from */
    double right[3]; /* screen +x */
    double up[3];    /* screen -y */
    double back[3];  /* against the viewing direction */
    int orthographic;
    double focal;  /* pinhole: pixels, > 0; unused when orthographic */
    double height; /* orthographic: world height of the image, > 0; unused with a pinhole */
    double near_z; /* world */
    double far_z;  /* world */
};

enum ref_lamp_kind { REF_LAMP_DIR = 0, REF_LAMP_POINT = 1, REF_LAMP_SPOT = 2 };

struct ref_lamp {
    int kind;            /* enum ref_lamp_kind */
    double at[3];        /* dir: towards it, any length but 0; else where it is, world */
    double aim[3];       /* spot: the way in which it shines, any length but 0 */
    double rgb[3];       /* its colour times its strength */
    double range;        /* times (1 - (d / range)^2)^2 at a distance d below it; 0: no limit */
    double inner, outer; /* spot: cosines of the angles up to which it is full, from which on it is dark; between
                            them t^2 (3 - 2 t) */
};

/* Colours fade into one with the distance z: linearly from start to end, or by 1 - exp(-density z). */
struct ref_fog {
    double start, end; /* world */
    double density;    /* > 0: exponential; start and end are not read */
    double rgb[3];     /* 0..1 */
};

enum ref_layers { REF_OPAQUE = 0, REF_MIX = 1, REF_ADD = 2 };

/* One light at infinity. intensity = ambient + diffuse * max(0, n . dir); colour * intensity is
 * clamped to 0..1 by channel, at the vertex or face, before any interpolation. With a texture the
 * intensity is interpolated and texel * intensity is clamped at the pixel. */
struct ref_light {
    double dir[3]; /* unit, world, from the surface towards the light */
    double ambient;
    double diffuse;
    /* Lamps in its place: ambient, and these. At a point, a channel is, clamped to 0..1,
     *     colour * (ambient + sum(lamp * max(0, n . l))) + specular * sum(lamp * highlight) + emission
     * as lamps.h has it: once for a face, at its centre; at the vertices, clamped there and interpolated in space
     * (with a texture, whose colour is the pixel's, the first bracket is clamped to 2 and the rest to 1); or per
     * pixel, by normals that are interpolated. */
    const struct ref_lamp *lamp; /* [n_lamps]; NULL: the light above */
    int n_lamps;
    int per_pixel;             /* flag; smooth modes with lamps */
    /* How all triangles are laid over each other and the background: REF_OPAQUE; else every layer of a pixel, from far
     * to near by its own distance: colour * alpha + what is behind * (1 - alpha), or + what is behind, at most 1. At
     * equal distances the earlier triangle is behind. Fog is on each layer; with REF_ADD it takes light away. */
    int layers;   /* enum ref_layers */
    double alpha; /* 0..1 */
    const struct ref_fog *fog; /* NULL: none. Where nothing is drawn there is none */
};

/* How z becomes a key; near and far are the camera's. */
struct ref_depth {
    int mapping; /* enum ref_mapping */
    int bits;    /* 8..16 */
};

/*
 * An image: buffers owned by the caller, each NULL if not wanted, else width * height entries (rgb:
 * three times that), rows top to bottom, no padding. Contents need not be initialised.
 */
struct ref_image {
    uint16_t *rgb565;  /* round(c * 31), round(c * 63), round(c * 31); background where nothing */
    uint16_t *key;     /* exact_key rounded to nearest, in 0..2^bits - 2; REF_KEY_NOTHING */
    uint32_t *id;      /* id of the visible triangle; 0 where nothing */
    double *z;         /* true distance along the axis, world; INFINITY where nothing */
    double *exact_key; /* key before rounding and saturation; INFINITY where nothing */
    double *rgb;       /* r, g, b before rounding, 0..1; raw and background: code / 31 or / 63 */
    double *u, *v;     /* exact texture coordinates, beyond 0..1 too; NAN where no texture */
    uint32_t *texel;   /* row * width + column + 1 of the texel seen; 0 where no texture */
    const struct ref_texture **texture; /* the texture seen; NULL where none */
};

/* Called now and then with the number of triangles done, lastly with done == total. */
typedef void (*ref_progress)(void *user, size_t done, size_t total);

/*
 * Fills the camera's eye and axes; leaves its other fields alone. eye, at, up: world; up need not
 * be unit nor square to the view. REF_BAD_ARGUMENT (camera untouched) if eye == at, if up is
 * parallel to the view or zero (sine below 1e-12), or if any is not finite.
 */
int ref_camera_look_at(struct ref_camera *camera, const double eye[3], const double at[3],
                       const double up[3]);

/* Focal length in pixels of a vertical field of view (radians, 0 < fov_y < pi). */
double ref_focal(double fov_y, int height);

/* Unrounded key of a distance z, by the camera's near and far; not saturated. */
double ref_exact_key(const struct ref_depth *depth, const struct ref_camera *camera, double z);

/* An unrounded key to nearest (halves up), saturated to 0..2^bits - 2. */
uint16_t ref_round_key(const struct ref_depth *depth, double exact_key);

/* The distance whose unrounded key is `key`: inverse of ref_exact_key. */
double ref_key_to_z(const struct ref_depth *depth, const struct ref_camera *camera, double key);

/*
 * Draws n triangles into the image. The least z wins a pixel; at exactly equal z (bitwise, which
 * holds for a repeated triangle and for faces square to the axis at one distance; other coplanar
 * faces differ by rounding) the earlier triangle. Triangles may lie anywhere, behind and through
 * the eye included; those whose projected area is exactly 0 draw nothing.
 *
 * width, height: 1..REF_MAX_SIDE. background: RGB565. light: may be NULL if every triangle is raw.
 * progress: may be NULL. Time: about the projected area of all triangles in pixels, plus n.
 * Returns an enum ref_status; on an error the buffers hold nothing of use.
 */
int ref_render(const struct ref_triangle *triangles, size_t n, const struct ref_camera *camera,
               const struct ref_light *light, const struct ref_depth *depth, uint16_t background,
               int width, int height, struct ref_image *image, ref_progress progress, void *user);

/*
 * What separates a picture (ours) from the reference. A pixel is "drawn" where its id is not 0; it
 * "agrees" where both are drawn with the same id. Should either image lack ids, drawn means
 * key != REF_KEY_NOTHING and any pixel drawn in both agrees; without keys too, all pixels agree.
 * Figures whose buffers are absent, or which were compared nowhere, are 0 (psnr_db: INFINITY).
 */
struct ref_diff {
    size_t pixels;    /* width * height */
    size_t ref_drawn; /* drawn in the reference */
    size_t agree;     /* drawn in both, same id */
    size_t id_differ; /* drawn in both, different ids */
    size_t missing;   /* drawn in the reference only */
    size_t extra;     /* drawn in ours only */

    /* where they agree, both keys present */
    size_t key_compared;
    size_t key_off;       /* keys further apart than 1 */
    int key_max_diff;     /* greatest |ours - reference|, key units */
    double key_max_error; /* greatest |ours - reference's exact_key|, key units; an ideal renderer
                             has at most 0.5, or 1 where the key saturates; needs exact_key */

    /* where they agree: |z of our key - true z| / |true z|. The true z is the reference's z, else
     * from its exact_key, else from its key. Our key's own rounding is part of the error. Pixels
     * with our key REF_KEY_NOTHING or a true z of 0 are left out. */
    size_t z_compared;
    double z_mean_rel;
    double z_max_rel;

    /* where they agree, both texels present and not 0. With u, v and texture in the reference, the
     * distance: how far outside our texel the true coordinate lies, in texels, along the axis where
     * that is more; 0 where they are the same. */
    size_t texels;        /* compared */
    size_t texel_differ;  /* not the reference's */
    size_t texel_far;     /* further than 1/8 */
    double texel_max_distance;

    /* where they agree, both rgb565 present, and, where both have texels, those are the same:
     * channel values in their own 5 or 6 bit codes */
    size_t channels;         /* channel values compared: 3 a pixel */
    size_t channel_off;      /* apart by more than 1 code */
    size_t channel_off_one;  /* apart by exactly 1 code */
    double off_one_fraction; /* channel_off_one / channels */
    int channel_max_diff;    /* greatest difference, codes */

    double psnr_db; /* all pixels, background too: 10 log10(255^2 / mean square error) over R, G, B
                       expanded to 8 bits by bit replication; INFINITY if equal */
};

/*
 * Compares ours with the reference. Both images: width * height, buffers as in ref_image; read
 * only. depth and camera: those both were drawn with; only mapping, bits, near and far are used.
 * ours: only id, key, rgb565 and texel are read. Returns REF_OK, or REF_BAD_ARGUMENT with *diff
 * untouched.
 */
int ref_compare(const struct ref_image *ours, const struct ref_image *reference,
                const struct ref_depth *depth, const struct ref_camera *camera, int width,
                int height, struct ref_diff *diff);

#endif
