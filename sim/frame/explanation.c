/* zs_explain on a renderer of its own.
 *
 * SPDX-License-Identifier: MIT
 */
#include "explanation.h"

#include <stdlib.h>
#include <string.h>

#include "sim.h"
#include "zs_explain.h"

struct line {
    const char *file;
    char text[512];
    size_t n;
    int has_length; /* flag: one of them names a length of the world */
};

/* What stands beside such a length. */
static int names_length(const char *text)
{
    static const char *const words[] = { "near = ", "far = ", "behind the eye", " ahead", "whose radius is",
                                         "across, its centre", "its height is", "the camera's height is",
                                         "world units" };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strstr(text, words[i]) != NULL)
            return 1;
    return 0;
}

/* A piece of a sentence; its last one ends with a line feed. */
static void say(void *ctx, const char *text)
{
    struct line *line = ctx;
    for (; *text != '\0'; text++)
        if (*text != '\n') {
            if (line->n + 1 < sizeof line->text)
                line->text[line->n++] = *text;
        } else {
            line->text[line->n] = '\0';
            line->has_length |= names_length(line->text);
            (void)sim_refuse(line->file, 0, "%s", line->text);
            line->n = 0;
        }
}

uint32_t sim_explain(const char *file, const struct zs_scene *scene, const struct zs_camera *camera,
                     const struct zs_config *config, double unit)
{
    struct line line = { .file = file };
    struct zs_renderer renderer;
    const uint32_t bytes = zs_arena_bytes(config);
    void *arena = sim_alloc(bytes / 4 + 1, 4);
    const uint32_t n = zs_init(&renderer, config, arena, bytes) == ZS_OK
                           ? zs_explain(&renderer, scene, camera, say, &line)
                           : zs_explain_init(&renderer, config, arena, bytes, say, &line);
    free(arena);
    if (line.has_length)
        (void)sim_refuse(file, 0, "lengths are in world units, of which a unit of the model has %.6g", 1.0 / unit);
    return n;
}
