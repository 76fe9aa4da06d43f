/* What a frame costs, stage by stage: how often each thing is done in it, and what one takes on a core. Counts come
 * from the renderer itself, which is given shaders, texel formats, a depth mapping and accelerators that look on and
 * pass on; so they follow whatever ways it takes. What one takes is fitted from the probes (firmware/scenes/probes.h)
 * by make costs-record.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_COSTS_H
#define SIM_COSTS_H

#include <stdint.h>

#include "zstrip.h"

/* name, stage, of what it is the cost of one. Where one kind includes another the text says "more". */
#define SIM_COSTS(X)                                                                                            \
    X(frame, "frame", "frame: begin and end")                                                                   \
    X(strip, "strip", "strip: list, hand-over, the call")                                                       \
    X(clear_px, "strip", "pixel cleared, colour and depth")                                                     \
    X(instance, "instance", "instance walked in a frame")                                                       \
    X(instance_culled, "instance", "instance whose sphere is out of view")                                      \
    X(instance_asked, "instance", "more where it may lie behind large triangles")                               \
    X(vertex, "vertex", "vertex to the screen, depth float")                                                    \
    X(vertex_recip, "vertex", "vertex to the screen, depth recip")                                              \
    X(vertex_linear, "vertex", "vertex to the screen, depth linear")                                            \
    X(vertex_ortho, "vertex", "vertex to the screen, orthographic")                                             \
    X(vertex_test, "vertex", "more where near, far or guard band are near")                                     \
    X(vertex_out, "vertex", "vertex outside of those")                                                          \
    X(vertex_fine, "vertex", "more with pos_lo")                                                                \
    X(light_smooth, "vertex", "its light, smooth")                                                              \
    X(attr_texture, "vertex", "its texture coordinates")                                                        \
    X(light_texture, "vertex", "its texture coordinates and light")                                             \
    X(tri, "triangle", "triangle looked at and turned away")                                                    \
    X(tri_looked, "triangle", "more where the pool does not hold the mesh")                                     \
    X(tri_noted, "triangle", "more where the rows of its part are noted")                                       \
    X(vertex_packed, "vertex", "vertex in a full pool that is packed")                                          \
    X(tri_asked, "triangle", "more where it is 128 px wide or high, or the frame at most 160")                  \
    X(tri_box, "triangle", "more where it faces the eye: box, off screen or empty")                             \
    X(tri_bin, "triangle", "more where it is seen: bin")                                                        \
    X(face_flat, "triangle", "more for its light, flat, normal from its edges")                                 \
    X(face_flat_given, "triangle", "more for its light, flat, normal given")                                    \
    X(tri_clip, "clip", "triangle cut at near, far or the guard band")                                          \
    X(tri_hidden, "set-up", "triangle in a strip, found hidden")                                                \
    X(cover, "set-up", "triangle of 64 columns or more: may it hide others")                                    \
    X(bound, "set-up", "more where it does")                                                                    \
    X(bound_strip, "set-up", "strip all of whose rows it passes")                                               \
    X(setup_small, "set-up", "small triangle of one colour in a strip")                                         \
    X(setup_small_texel, "set-up", "small triangle with a texture, affine")                                      \
    X(setup_small_lit, "set-up", "more where that is lit")                                                      \
    X(tilt_small, "set-up", "more where its keys differ")                                                       \
    X(setup, "set-up", "any other triangle in a strip, of one colour")                                          \
    X(tilt, "set-up", "more where its keys differ")                                                             \
    X(setup_wide, "set-up", "more beyond 64 px, or of hardly any area")                                         \
    X(plane_mid, "set-up", "colour or coordinate over a triangle of those")                                     \
    X(plane_wide, "set-up", "key, colour or coordinate beyond 256 px, width and height")                        \
    X(edge, "set-up", "edge taken up for up to 16 rows")                                                        \
    X(edge_tiny, "set-up", "the same of a triangle of up to 64 px")                                             \
    X(edge_div, "set-up", "more where it is not steep, or entered below its first row")                         \
    X(edge_div64, "set-up", "the same, of 128 px and more: entered below")                                      \
    X(setup_empty, "set-up", "triangle in a strip without a pixel there")                                       \
    X(setup_small_empty, "set-up", "small triangle in a strip without a pixel there")                           \
    X(edge_small_div, "set-up", "edge of a small triangle that a core without a divider divides for")           \
    X(setup_octaves, "set-up", "more where depth float crosses an octave")                                      \
    X(setup_linear, "set-up", "more with depth linear")                                                         \
    X(setup_untouched, "set-up", "more where nothing was drawn before it")                                      \
    X(start_smooth, "set-up", "more for colours, affine")                                                       \
    X(start_smooth_w, "set-up", "more for colours in perspective")                                              \
    X(start_texture, "set-up", "more for texels, affine")                                                       \
    X(start_texture_w, "set-up", "more for texels in perspective")                                              \
    X(start_light, "set-up", "more for their light between vertices")                                           \
    X(row_small, "row", "row of a small triangle")                                                              \
    X(row_small_texel, "row", "row of a small triangle with a texture")                                         \
    X(row, "row", "row of any other: its two edges")                                                            \
    X(row_untouched, "row", "row with pixels, more where nothing was drawn before it")                          \
    X(row_clear, "row", "row of a strip, drawn on so: what is left of it is cleared")                           \
    X(span_small, "span", "row with pixels, small triangle")                                                    \
    X(span_small_texel, "span", "row with pixels, small triangle with a texture")                               \
    X(span_small_lit, "span", "more where that is lit")                                                         \
    X(span_solid, "span", "row with pixels, one colour")                                                        \
    X(span_smooth, "span", "row with pixels, smooth, affine")                                                   \
    X(span_direct, "span", "row with pixels, texels, affine, unlit or lit palette")                             \
    X(span_runs, "span", "row with pixels, any other way")                                                      \
    X(span_linear, "span", "more with depth linear")                                                            \
    X(piece, "span", "piece of a row, where depth float crosses an octave")                                     \
    X(px_small, "pixel", "pixel tested, small triangle")                                                        \
    X(px_small_texel, "pixel", "pixel tested, small triangle with a texture")                                   \
    X(px_solid, "pixel", "pixel tested, one colour")                                                            \
    X(px_smooth, "pixel", "pixel tested, smooth")                                                               \
    X(px_direct, "pixel", "pixel tested, texels")                                                               \
    X(px_runs, "pixel", "pixel tested, any other way")                                                          \
    X(px_linear, "pixel", "pixel tested, depth linear")                                                         \
    X(px_state, "pixel", "pixel tested, with a state")                                                          \
    X(px_untouched, "pixel", "key of a pixel drawn without a test")                                             \
    X(fill_px, "pixel", "pixel of one colour filled where nothing was drawn")                                   \
    X(won_small, "pixel", "more where it wins, small triangle")                                                 \
    X(won_small_lit, "pixel", "more where it wins and a texture is lit, small triangle")                        \
    X(won_solid, "pixel", "more where it wins, one colour")                                                     \
    X(won_smooth, "pixel", "more where it wins, smooth")                                                        \
    X(won_565, "pixel", "more where it wins, texel 565")                                                        \
    X(won_pal8, "pixel", "more where it wins, texel pal8")                                                      \
    X(won_pal4, "pixel", "more where it wins, texel pal4")                                                      \
    X(won_runs, "pixel", "more where it wins, any other way: its depth")                                        \
    X(run, "run", "run of pixels that win, any other way")                                                      \
    X(run_untouched, "run", "more where nothing was drawn before it")                                           \
    X(run_solid_px, "run", "pixel of one colour in a run")                                                      \
    X(run_smooth_px, "run", "pixel of smooth colour in a run")                                                  \
    X(run_smooth_part, "run", "part of up to 16 smooth pixels in perspective")                                  \
    X(fetch, "run", "part of texels fetched")                                                                   \
    X(fetch_group, "run", "more where its ends are divided: up to 32 in perspective")                           \
    X(fetch_one, "run", "more where it is one texel in perspective")                                            \
    X(fetch_clamped, "run", "more where the texture is clamped")                                                \
    X(fetch_single, "run", "texel of a clamped texture, fetched by itself")                                     \
    X(fetch_565_px, "run", "texel 565 fetched")                                                                 \
    X(fetch_pal8_px, "run", "texel pal8 fetched")                                                               \
    X(fetch_pal4_px, "run", "texel pal4 fetched")                                                               \
    X(divide, "run", "part of up to 16 texels, each divided")                                                   \
    X(divide_px, "run", "texel by a division of its own")                                                       \
    X(shine, "run", "call to light a part or a palette")                                                        \
    X(shine_px, "run", "pixel or colour of a palette lit")                                                      \
    X(sorted, "method", "triangle of a strip sorted by depth")                                                  \
    X(sorted_log, "method", "more, by the binary logarithm of how many there are")                              \
    X(run_plain, "method", "run of pixels coloured without a depth test")                                       \
    X(run_plain_px, "method", "pixel of one colour in such a run")                                              \
    X(span_painter, "method", "painter: row with pixels")                                                       \
    X(pair, "method", "pair of triangles whose depths overlap")                                                 \
    X(pair_boxes, "method", "more where their boxes on the screen meet")                                        \
    X(pair_row, "method", "row at which two triangles are compared")                                            \
    X(setup_order, "method", "more for a triangle or a piece in a strip")                                       \
    X(span_sorted, "method", "depth sort: row of a triangle")                                                   \
    X(span_covered, "method", "coverage: row of a triangle")                                                    \
    X(run_covered, "method", "coverage: run of its pixels that are drawn")                                      \
    X(word_covered, "method", "coverage: 32 pixels of it, of which some are drawn")                              \
    X(tile_triangle, "method", "hiz: triangle looked up in the tiles")                                          \
    X(tile_row, "method", "hiz: row of a tile, looked at as the strip is cleared")                              \
    X(span_tiles, "method", "hiz: row of a triangle")                                                           \
    X(tile, "method", "hiz: piece of a row compared with a tile")                                               \
    X(px_tile_hidden, "method", "hiz: pixel that a tile hides")                                                 \
    X(tile_px_untested, "method", "hiz: pixel drawn without a test")                                            \
    X(ray, "method", "ray")                                                                                     \
    X(ray_box, "method", "box that a ray is tested against")                                                    \
    X(ray_tri, "method", "triangle in whose box on the screen a ray is")                                        \
    X(ray_side, "method", "edge of a triangle that a ray is tested against")                                         \
    X(ray_plane, "method", "plane of a triangle's keys found for a ray")                                        \
    X(ray_curved, "method", "key found where a triangle's keys are not linear")                                 \
    X(ray_piece, "method", "piece of its row, looked at for that")                                              \
    X(span_ray, "method", "row of a triangle, coloured where rays hit it")                                      \
    X(px_ray, "method", "pixel of it looked at")                                                                \
    SIM_EFFECT_COSTS(X)

/* Those of effects are not fitted: they are differences of what make effects-record has measured (effect_costs.c). */
#define SIM_EFFECT_COSTS(X)                                                                                     \
    X(lit_vertex, "vertex", "its light by lamps")                                                               \
    X(lit_shine, "vertex", "more with a highlight")                                                             \
    X(lit_face, "triangle", "its light by lamps, and a highlight")                                              \
    X(gloss_vertex, "vertex", "its texture coordinates, light by lamps and highlight")                          \
    X(gloss_start, "set-up", "more for a highlight on a texture")                                               \
    X(gloss_px, "run", "more for a pixel of a highlight on a texture")                                          \
    X(cutout_px, "run", "more for a pixel whose texel may be clear")                                            \
    X(cutout_pal_px, "run", "more for one of them by a palette")                                                 \
    X(cutout_tested_px, "pixel", "more where its texel may be clear")                                            \
    X(cutout_run, "run", "more for a run of those")                                                             \
    X(blend_px, "run", "more for a pixel that is blended")                                                      \
    X(blend_run, "run", "more for a run of those")                                                              \
    X(blend_texel_run, "run", "more for a run of texels with alpha that are blended")                           \
    X(add_px, "run", "more for a pixel that is added")

#define SIM_COST_ENUM(name, stage, what) SIM_COST_##name,
enum sim_cost { SIM_COSTS(SIM_COST_ENUM) SIM_COST_N };

struct sim_cost_name {
    const char *name, *stage, *what;
};
extern const struct sim_cost_name sim_cost_names[SIM_COST_N];

enum sim_core { SIM_CORE_M0, SIM_CORE_M3, SIM_CORE_M4, SIM_CORE_M7, SIM_CORE_RV32, SIM_CORE_RP2040, SIM_CORES };
extern const char *const sim_core_names[SIM_CORES]; /* as tests/records/bench.txt names them; "RP2040" is in cycles */

#define SIM_COUNT_STRIPS 240u
struct sim_counted {
    double n[SIM_COST_N];  /* how often in the frame */
    double worst[SIM_CORES]; /* instructions (RP2040: cycles) of the slowest strip; 0: strips were not looked at */
    /* The same of each, or of so many neighbours together; n_strips 0: strips were not looked at */
    double strip[SIM_CORES][SIM_COUNT_STRIPS];
    uint32_t n_strips, neighbours;
    double effects[SIM_CORES]; /* what effects take beside that; NAN: one of them was not measured, which is ... */
    const char *unknown;       /* ... this; NULL: none */
    int has_effects;           /* flag: there is something in that */
    int has_own; /* flag: a stage, sky or item of a program's own is in it, as one of the library's that is like it */
    struct zs_stats stats; /* of it */
    uint32_t checksum;     /* FNV-1a, 32 bits, of its bytes as they leave */
};

/* The shader of shade/ that an effect's is counted as, with what it takes more; NULL: it is no effect's that is known.
 */
const struct zs_shader *sim_costs_plain(const struct zs_shader *shader);

/* Draw a frame and count. Return ZS_OK, or an error of the renderer; SIM_FRAME_BROKEN: pixels that were counted are not
 * those that the renderer says. Not for two threads at once. Needs ZS_STATS = 1. */
int sim_costs_count(struct sim_counted *out, const struct zs_scene *scene, const struct zs_camera *camera,
                    const struct zs_config *config);
/* The same of n passes, at most SIM_COUNT_PASSES, as zs_render_passes draws them. */
#define SIM_COUNT_PASSES 4u
struct zs_pass;
int sim_costs_count_passes(struct sim_counted *out, const struct zs_pass *pass, uint32_t n,
                           const struct zs_config *config);

/* ---- What one costs ----------------------------------------------------------------------------- */

/* Of a stage of an effect, as the effects' record has it; < 0: it is no effect's. */
double sim_effect_cost(enum sim_core core, enum sim_cost cost);
/* Instructions (RP2040: cycles) of one, as on record. */
double sim_cost_of(enum sim_core core, enum sim_cost cost);
/* The most that the estimate is off by, percent of what frames of the demo and bench scenes take, as on record. */
double sim_cost_error(enum sim_core core);
/* The same of other methods than the depth buffer, over M0, M3 and RP2040. */
double sim_cost_method_error(void);
/* Of a frame. */
double sim_costs_sum(enum sim_core core, const struct sim_counted *counted);

/* ---- Effects ------------------------------------------------------------------------------------ */

/* Work of one material with a shader of an effect. */
struct sim_effect_work {
    double px, vertices, faces, runs; /* coloured; shaded; of one colour; runs that pixels came in */
    double lit, shiny; /* of light at each pixel: lamps that reach it, summed; those whose highlight does */
    double single;     /* of zs_shade_phong: pixels that are not lit in blocks */
    double gloss;      /* of zs_shade_texture_gloss under a filter or layer: pixels of triangles with highlights */
    int fetched; /* flag: the texels of those pixels are in the stages' costs */
};
/* Add what it takes to counted->effects; material: the one that is drawn. */
void sim_effects_add(struct sim_counted *counted, const struct zs_material *material,
                     const struct sim_effect_work *work);
/* Of a material whose effect is counted by stages: add what its lamps take beyond one directional lamp. */
void sim_effects_add_lamps(struct sim_counted *counted, const struct zs_material *material,
                           const struct sim_effect_work *work);
/* Add n pixels of a hook: fog, dithering. drawn: pixels on which something is drawn, all: those of the frame. */
void sim_effects_add_hook(struct sim_counted *counted, const struct zs_resolve *hook, double drawn, double all);
/* Add n pixels of a pass that is seen in windows, and n behind which there is a sky. */
void sim_effects_add_windows(struct sim_counted *counted, double n);
/* Add n triangles of a pass in a mirror, which accelerators do not walk. */
void sim_effects_add_mirrored(struct sim_counted *counted, double n);
void sim_effects_add_sky(struct sim_counted *counted, const struct zs_background *sky, double n);
/* Add n pixels of the panel that were made of four samples each. */
void sim_effects_add_samples(struct sim_counted *counted, double n);
/* Is what a vertex of it takes, more than by a plain shader, a matter of how runs begin? */
struct sim_shader_row;
int sim_effects_begin_runs(const struct sim_shader_row *of);
/* Something is drawn that was not measured. */
void sim_effects_unknown(struct sim_counted *counted, const char *what);
/* The most that estimates of frames with effects are off by, percent, of those of tests/lab/effects/error.mjs (make
 * effects-error) on an emulated RP2040; other cores were not held against any. */
double sim_effects_error(void);

/* Put costs in the place of what is on record. */
void sim_costs_set(enum sim_core core, const double cost[SIM_COST_N]);

/* Print how far the estimate is from what frames of the demo and bench scenes took: lines "CORE SCENE NUMBER" of a
 * file, as of tests/records/bench.txt. SIM_OK; SIM_REFUSED: it cannot be read, or a scene is more than bar percent off.
 * */
int sim_costs_error(const char *file, double bar);
/* The same in numbers: the most on each core, and of other methods than the depth buffer the most on all; left alone
 * where the file has no line of it. SIM_OK; SIM_REFUSED. */
int sim_costs_worst(const char *file, double worst[SIM_CORES], double *of_methods);

/* Print what is counted in frame 0 of a demo or bench scene, drawn as make bench draws it, and what that costs. SIM_OK,
 * or SIM_REFUSED: there is no such scene. */
int sim_costs_scene(const char *name);

#endif
