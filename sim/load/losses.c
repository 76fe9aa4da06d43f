/* Noting and saying what is not carried over.
 *
 * SPDX-License-Identifier: MIT
 */
#include "losses.h"

#include <ctype.h>
#include <string.h>

#include "sim.h"

void sim_lose(struct sim_lost *lost, enum sim_lost_kind kind, const char *name)
{
    struct sim_lost *l = &lost[kind];
    if (l->n++ == 0)
        (void)snprintf(l->first, sizeof l->first, "%.39s", name);
}

/* ---- Saying ---------------------------------------------------------------------------------- */

void sim_lost_materials_print(FILE *f, const char *lead, const char *materials)
{
    if (materials != NULL)
        (void)fprintf(f, "%smaterial file %s cannot be read: its colours and textures are missing\n", lead, materials);
}

void sim_losses_print(FILE *f, const char *lead, const struct sim_lost *lost)
{
    static const struct {
        const char *what, *of;
    } words[SIM_LOST_KINDS] = {
        [SIM_LOST_ANIMATION] = { "animation", "" },
        [SIM_LOST_SKIN] = { "skin", "of mesh " },
        [SIM_LOST_MORPH] = { "morph targets", "of mesh " },
        [SIM_LOST_CAMERA] = { "camera", "" },
        [SIM_LOST_LIGHT] = { "light", "" },
        [SIM_LOST_LINES] = { "points and lines", "of mesh " },
        [SIM_LOST_CURVES] = { "curves and surfaces", "" },
        [SIM_LOST_STRIPS] = { "triangle strips", "" },
        [SIM_LOST_CORNERS] = { "vertices of facets beyond the third", "" },
        [SIM_LOST_UV_SETS] = { "further texture coordinates", "of mesh " },
        [SIM_LOST_VERTEX_COLOR] = { "vertex colours under a texture", "of material " },
        [SIM_LOST_VERTEX_ALPHA] = { "alpha of vertex colours", "of mesh " },
        [SIM_LOST_MEAN_COLOR] = { "vertex colours, but for their mean on each face: smooth shading has them", "" },
        [SIM_LOST_COLORS] = { "colours in another form", "" },
        [SIM_LOST_TEXTURE] = { "texture that cannot be loaded", "" },
        [SIM_LOST_FURTHER_TEXTURE] = { "texture beside the last that the file names", "" },
        [SIM_LOST_UNPLACED] = { "texture of faces without texture coordinates", "of material " },
        [SIM_LOST_MATERIAL] = { "material that no material file has", "" },
        [SIM_LOST_EXTENSION] = { "glTF extension", "" },
        [SIM_LOST_TEXEL_ALPHA] = { "alpha of a texture", "" },
        [SIM_LOST_TEXTURE_TURN] = { "rotation of a texture", "of material " },
        [SIM_LOST_NORMAL_MAP] = { "normal or height map", "of material " },
        [SIM_LOST_METAL_MAP] = { "metallic-roughness map", "of material " },
        [SIM_LOST_EMISSION_MAP] = { "emission map", "of material " },
        [SIM_LOST_OCCLUSION_MAP] = { "occlusion map", "of material " },
        [SIM_LOST_SPECULAR_MAP] = { "specular map", "of material " },
        [SIM_LOST_OPACITY_MAP] = { "opacity map", "of material " },
        [SIM_LOST_OTHER_MAP] = { "map of another kind", "of material " },
        [SIM_LOST_OPACITY] = { "opacity", "of material " },
        [SIM_LOST_TWO_SIDED] = { "double-sidedness: light on back sides", "of material " },
        [SIM_LOST_SPECULAR] = { "highlights", "of material " },
        [SIM_LOST_FAINT_SPECULAR] = { "highlights on a texture, too faint for what they cost", "of material " },
        [SIM_LOST_EMISSION] = { "emission", "of material " },
    };
    for (int kind = 0; kind < SIM_LOST_KINDS; kind++) {
        const struct sim_lost *l = &lost[kind];
        if (l->n == 0)
            continue;
        (void)fprintf(f, "%snot carried over: %s (%u", lead, words[kind].what, (unsigned)l->n);
        if (l->first[0] != '\0')
            (void)fprintf(f, l->n > 1 ? ", the first %s\"" : ", %s\"", words[kind].of);
        for (const char *p = l->first; *p != '\0'; p++) /* it may stand in a comment */
            (void)fputc(isascii((unsigned char)*p) &&
                                (isalnum((unsigned char)*p) || strchr(" ._,+=@#-()", *p) != NULL)
                            ? *p
                            : '_',
                        f);
        (void)fputs(l->first[0] != '\0' ? "\")\n" : ")\n", f);
    }
}
