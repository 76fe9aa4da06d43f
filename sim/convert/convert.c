/* Options, model, grid, meshes, textures, files, in this order. Files come last and all at once, so
 * that whatever is refused leaves none.
 *
 * SPDX-License-Identifier: MIT
 */
#include "convert.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output_file.h"
#include "sim.h"

#define N_OUTPUTS 3

/* ---- Reading --------------------------------------------------------------------------------- */

/* Does the file begin as a PNG or a JPEG? What cannot be read is left to the loader to refuse. */
int sim_is_picture(const char *file)
{
    static const unsigned char png[4] = { 0x89, 'P', 'N', 'G' }, jpeg[3] = { 0xff, 0xd8, 0xff };
    unsigned char head[4] = { 0 };
    struct stat st;
    FILE *f = stat(file, &st) == 0 && S_ISREG(st.st_mode) ? fopen(file, "rb") : NULL;
    if (f == NULL)
        return 0;
    const size_t n = fread(head, 1, sizeof head, f);
    (void)fclose(f);
    return n == sizeof head &&
           (memcmp(head, png, sizeof png) == 0 || memcmp(head, jpeg, sizeof jpeg) == 0);
}

/* A picture becomes a model's only texture, without the model. */
static int read_picture(struct sim_conversion *c)
{
    const struct sim_convert_options *o = &c->options;
    struct sim_image image;
    if (o->for_models)
        return sim_refuse(o->input, 0, "is a picture, and %s is for models; leave it out",
                          o->model_option);
    const int status = sim_image_load(&image, o->input, 0);
    if (status != SIM_OK)
        return status;
    c->model.texture = sim_alloc(1, sizeof *c->model.texture);
    c->model.n_textures = 1;
    sim_texture_make(&c->model.texture[0], &image, o->input, NULL);
    c->model.texture[0].clamp = o->wrap == SIM_WRAP_CLAMP ? ZS_CLAMP_U | ZS_CLAMP_V : 0;
    if (c->model.texture[0].image.alpha != NULL)
        sim_lose(c->made.pieces.lost, SIM_LOST_TEXEL_ALPHA, "");
    c->made.packed = sim_alloc(1, sizeof *c->made.packed);
    const int made = sim_packed_make(&c->made.packed[0], &c->model.texture[0], o->input, o);
    c->made.n_packed = made == SIM_OK;
    return made;
}

static int read_model(struct sim_conversion *c)
{
    const int status = sim_convert_load(&c->model, &c->options);
    return status == SIM_OK ? sim_converted_make(&c->made, &c->model, &c->options) : status;
}


/* ---- Files ----------------------------------------------------------------------------------- */

/* DIR/NAME.c, .h and the map; malloc'ed, NULL where it is not wanted. */
static void name_files(char *path[N_OUTPUTS], const struct sim_convert_options *o)
{
    static const char *const ends[2] = { ".h", ".c" };
    const size_t room = strlen(o->out) + strlen(o->name) + 4;
    for (int i = 0; i < 2; i++) {
        path[i] = sim_alloc(room, 1);
        (void)snprintf(path[i], room, "%s/%s%s", o->out, o->name, ends[i]);
    }
    path[2] = o->map != NULL ? strcpy(sim_alloc(strlen(o->map) + 1, 1), o->map) : NULL;
}

/* The output folder may be missing, but not its parent. *made: it was. */
static int make_folder_in_parent(const char *folder, int *made)
{
    struct stat st;
    *made = 0;
    if (mkdir(folder, 0777) == 0) {
        *made = 1;
        return SIM_OK;
    }
    if (errno == EEXIST && stat(folder, &st) == 0 && S_ISDIR(st.st_mode))
        return SIM_OK;
    return sim_refuse(folder, 0, "cannot be made a folder: %s",
                      strerror(errno == EEXIST ? ENOTDIR : errno));
}

static int write_files(const struct sim_conversion *c, char *path[N_OUTPUTS])
{
    struct sim_output out[N_OUTPUTS];
    size_t n = 0;
    int status = SIM_OK;
    for (int i = 0; status == SIM_OK && i < N_OUTPUTS; i++) {
        if (path[i] == NULL)
            continue;
        status = sim_output_check(path[i], c->options.input);
        if (status == SIM_OK)
            status = sim_output_open(&out[n], path[i]);
        if (status != SIM_OK)
            break;
        FILE *f = out[n++].file;
        if (i == 0)
            sim_convert_header(f, c);
        else if (i == 1)
            sim_convert_source(f, c);
        else
            sim_convert_map(f, c);
    }
    return sim_output_end(status, out, n);
}

static int write_all(const struct sim_conversion *c)
{
    char *path[N_OUTPUTS];
    int made;
    name_files(path, &c->options);
    int status = make_folder_in_parent(c->options.out, &made);
    if (status == SIM_OK && path[2] != NULL &&
        (sim_output_same(path[2], path[0]) || sim_output_same(path[2], path[1])))
        status = sim_refuse(path[2], 0, "is named for two outputs; give --map another");
    if (status == SIM_OK)
        status = write_files(c, path);
    if (status != SIM_OK && made)
        (void)rmdir(c->options.out);
    for (int i = 0; i < N_OUTPUTS; i++)
        free(path[i]);
    return status;
}

/* ---- Command --------------------------------------------------------------------------------- */

int sim_convert(int argc, char **argv)
{
    struct sim_conversion *c = sim_alloc(1, sizeof *c);
    int status = sim_convert_parse(&c->options, argc, argv);
    if (status == SIM_OK && c->options.help) {
        sim_convert_help();
    } else if (status == SIM_OK) {
        status = sim_is_picture(c->options.input) ? read_picture(c) : read_model(c);
        if (status == SIM_OK)
            status = write_all(c);
        sim_progress_end();
        if (status == SIM_OK) {
            (void)printf("%s/%s.h, %s/%s.c\n", c->options.out, c->options.name, c->options.out,
                         c->options.name);
            sim_convert_figures(stdout, c, "  ");
        }
    }
    sim_converted_free(&c->made);
    sim_model_free(&c->model);
    free(c->options.command);
    free(c);
    return status;
}
