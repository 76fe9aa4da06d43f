/* What is wrong with a picture, in sentences, with the cure. For the time in which a scene is set
 * up: a black, dark or slow picture is often one of the scene's numbers.
 *
 *     static void say(void *uart, const char *text) { ... send text ... }
 *     ...
 *     err = zs_render(&screen, &scene, &camera, &sink);
 *     (void)zs_explain(&screen, &scene, &camera, say, uart);
 *
 * prints for example
 *
 *     instance 0 is out of view: it begins 87047 beyond far = 20000; move it, or raise far.
 *     the light's diffuse is 1/65536: was ZS_Q16_ONE meant?
 *     the frame takes 14 passes; one needs max_tris 128 (it is 20).
 *
 * Nothing is said of a picture in which nothing is wrong. Instances are told by their place in the
 * scene. zs_mesh_check and zs_texture_check (zs_check.h) are part of it.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ZS_EXPLAIN_H
#define ZS_EXPLAIN_H

#include "zstrip.h"

ZS_C_BEGIN

/* Say what is wrong with a frame, the worst first. The scene is drawn again for that, several times
 * where it cannot be seen: nothing is sent.
 *
 * r       not while a frame is open. Its statistics stay those of the last frame, and damage
 *         tracking what it was; its strip buffers are written to.
 * scene, camera  those of the frame. What a frame of passes (zs_pass.h) draws: one pass at a time,
 *         as if it were the whole frame.
 * say     is called with pieces of sentences: at most 47 characters and a 0 each, the caller's
 *         until it returns. Each sentence ends with ".\n" or "?\n".
 * Says    why zs_render refuses the frame, by instance; or, of an instance each, why nothing is
 *         seen; why all is dark; flaws of meshes, textures, shaders, poses, depth states, light and
 *         camera; a hole in an instance that no other one overlaps; what near, far, a resolve hook,
 *         an item of an overlay or missing depth memory spoils; what damage tracking has missed;
 *         what is slow. At most 16 sentences.
 * Not found  what is no property of the scene: swapped colours and an offset (the panel), a plain
 *         struct zs_material for a shader that reads more; counts and sizes that leave no hole to
 *         be seen: triangles left out on the far side, log2_w of a texture of less than 4 x 8.
 * Cost    that of the frame, four times that of each instance, and of a check of all meshes; up to
 *         40 times the frame where nothing is seen. 33 KB of flash with zs_check.h (Cortex-M3,
 *         -O2), and 1.3 KB for zs_overlay_draw, where the program has none; 1.7 KB of stack beside
 *         the frame's.
 * Return  the number of sentences. */
uint32_t zs_explain(struct zs_renderer *r, const struct zs_scene *scene,
                    const struct zs_camera *camera, void (*say)(void *ctx, const char *text),
                    void *ctx);

/* Say what becomes of one instance, seen or not; otherwise as zs_explain. number: 0 ..
 * n_instances - 1. Return the number of sentences, at least 1. */
uint32_t zs_explain_instance(struct zs_renderer *r, const struct zs_scene *scene,
                             const struct zs_camera *camera, uint32_t number,
                             void (*say)(void *ctx, const char *text), void *ctx);

/* Say why zs_init refuses its arguments, field by field. r is set up if nothing is wrong, else as
 * zs_init leaves it. Return the number of sentences. */
uint32_t zs_explain_init_build(struct zs_renderer *r, const struct zs_config *config, void *arena,
                               size_t bytes, void (*say)(void *ctx, const char *text), void *ctx,
                               uint32_t build);
static inline uint32_t zs_explain_init(struct zs_renderer *r, const struct zs_config *config,
                                       void *arena, size_t bytes,
                                       void (*say)(void *ctx, const char *text), void *ctx)
{
    return zs_explain_init_build(r, config, arena, bytes, say, ctx, ZS_BUILD);
}

ZS_C_END

#endif
