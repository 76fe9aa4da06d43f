/* What studies share: a frame against the double-precision reference, mappings by name, formulas.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_STUDY_MEASURE_H
#define SIM_STUDY_MEASURE_H

#include <stdint.h>

#include "reference.h"
#include "study.h"
#include "zstrip.h"

#define STUDY_MAPPINGS 6
struct study_mapping {
    const char *name;
    const struct zs_depth *depth;
    const char *color; /* in plots */
};
extern const struct study_mapping study_mapping[STUDY_MAPPINGS]; /* the last: float, the default */

/* Width of a bucket at a distance z, in the unit of near and far: NUMERICS.md, Depth. mapping: number in study_mapping.
 */
double study_bucket(int mapping, int bits, double near_z, double far_z, double z);
/* The key at z, unrounded, by the same formulas. */
double study_key(int mapping, int bits, double near_z, double far_z, double z);

/* A frame and how far it is from the reference. */
struct study_frame {
    struct zs_stats stats;
    uint32_t arena_bytes;
    uint64_t checksum; /* FNV-1a, 64 bits, over its bytes as they leave: as in firmware/app/bench.c */
    struct ref_diff diff;
    size_t surface;     /* drawn in both, and ours shows a triangle of another plane */
    double key_beyond;  /* worst |key - exact|, less what snapping explains, buckets */
    size_t unexplained; /* pixels that show another triangle, and no snapping or tie explains it (error_bound.h) */
    uint16_t *rgb565;   /* [height][width] */
    uint8_t *wrong;     /* [height][width]: 1 where the surface is wrong */
};

/* ZS_OK; an enum zs_err: the renderer refused it; SIM_FRAME_BROKEN, or below it: the reference did. *f is to be freed
 * where ZS_OK was returned. */
int study_frame_open(struct study_frame *f, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config);
void study_frame_free(struct study_frame *f);

/* FNV-1a, 64 bits, over n RGB565 values as they leave. */
uint64_t study_checksum(const uint16_t *rgb565, size_t n);

/* Name of an enum zs_err as in zstrip.h, ZS_ERR_NEAR and so on; "OK". */
const char *study_error_name(int err);

/* Copy a picture to (x0, y0) of a sheet of 8-bit RGB; wrong pixels (NULL: none are marked) in magenta. */
void study_sheet_put(uint8_t *rgb, unsigned sheet_width, unsigned x0, unsigned y0, const uint16_t *rgb565,
                     const uint8_t *wrong, unsigned width, unsigned height);

#endif
