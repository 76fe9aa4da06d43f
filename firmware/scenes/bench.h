/* The bench scenes' geometry in integers: what gen/bench.c and bench.c agree upon. A pinhole with
 * a focal length of 320 px, near 128 and far 16384 bench units.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef BENCH_H
#define BENCH_H

#define BENCH_UNIT 4096 /* world units to a bench unit */
#define BENCH_NEAR 128  /* bench units */
#define BENCH_FAR 16384

/* mesh: a ball of 28000 steps */
#define BENCH_BUMPY_Z 2000 /* bench units */
#define BENCH_BUMPY_SCALE 5148000u /* uq16_16: see its fragments in bench.c */

/* relief: a head of 20000 steps, through z = 4096 bench units */
#define BENCH_RELIEF_Z 4160
#define BENCH_RELIEF_SCALE 13750000u /* uq16_16 */

/* layers: layer k is the mesh, scaled so that BENCH_LAYER_Z steps are 1500 * 1.2^k bench units */
#define BENCH_LAYER_Z 30000

/* plain: of so many bench units under the eye */
#define BENCH_PLAIN_Y (-360)

/* sheet: at 6000 bench units 1 px is 18.75 of them, or BENCH_STEPS_PX steps of 384 world units */
#define BENCH_STEPS_PX 200
#define BENCH_SHEET_Z 64000 /* steps */
#define BENCH_SHEET_SCALE (384u << 16)

/* slivers: at 2000 bench units 1 px is 6.25 of them, or BENCH_SLIVER_PX steps of 32 world units */
#define BENCH_SLIVER_PX 800
#define BENCH_SLIVER_SCALE (32u << 16)
#define BENCH_SLIVER_Z 2000 /* bench units */

#endif
