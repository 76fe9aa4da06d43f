/* A libFuzzer target: command lines. The first byte chooses: r zsim render, c zsim convert, l zstrip-linux; the rest
 * are the words, ended by line feeds.
 *
 *   what is refused is refused with one line, and the words stay as they are
 *   what is taken has every number in the range that --help gives it
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "convert_options.h"
#include "linux_options.h"
#include "render_options.h"
#include "sim.h"
#include "target.h"

#define WORDS 64

const char target_name[] = "fuzz_options";
const char *const target_words[] = { "\n--out\n",
                                     "\n--depth-out\n",
                                     "\n--id-out\n",
                                     "\n--stats\n",
                                     "\n--reference\n",
                                     "\n--compare\n",
                                     "\n--show\n",
                                     "overdraw",
                                     "\n--size\n",
                                     "240x240",
                                     "4096x1",
                                     "4097x1",
                                     "0x0",
                                     "-1",
                                     "\n--strip\n",
                                     "\n--depth\n",
                                     "e4m12",
                                     "\n--depth-bits\n",
                                     "16",
                                     "\n--subpixel\n",
                                     "8",
                                     "\n--tris\n",
                                     "65534",
                                     "65535",
                                     "\n--verts\n",
                                     "\n--buffers\n",
                                     "\n--fast\n",
                                     "all-tiles-touch",
                                     "batch,565",
                                     "\n--threads\n",
                                     "\n--panel\n",
                                     "st7789:240x240",
                                     "ssd1306:128x64",
                                     "\n--rotate\n",
                                     "90",
                                     "\n--invert\n",
                                     "\n--bgr\n",
                                     "\n--spi\n",
                                     "62500000",
                                     "\n--eye\n",
                                     "1,2,3",
                                     "\n--at\n",
                                     "\n--up\n",
                                     "0,0,0",
                                     "\n--fov\n",
                                     "180",
                                     "\n--near\n",
                                     "\n--far\n",
                                     "1e300",
                                     "\n--projection\n",
                                     "orthographic",
                                     "\n--shade\n",
                                     "textured-flat",
                                     "\n--texture\n",
                                     "\n--texture-format\n",
                                     "pal4",
                                     "\n--wrap\n",
                                     "clamp",
                                     "\n--cull\n",
                                     "none",
                                     "\n--background\n",
                                     "ff8000",
                                     "\n--color\n",
                                     "\n--light\n",
                                     "\n--ambient\n",
                                     "\n--diffuse\n",
                                     "0.5",
                                     "nan",
                                     "inf",
                                     "\n--help\n",
                                     "=",
                                     "\n--name\n",
                                     "\n--unit\n",
                                     "\n--texels\n",
                                     "\n--map\n",
                                     "\n--texture-size\n",
                                     "\n--keep-origin\n",
                                     "\n--precise\n",
                                     "\n--dither\n",
                                     "\n--dc\n",
                                     "GPIO25",
                                     "\n--reset\n",
                                     "\n--backlight\n",
                                     "\n--te\n",
                                     "\n--scene\n",
                                     "teapot",
                                     "\n--model\n",
                                     "\n--speed\n",
                                     "\n--frames\n",
                                     "\n--step\n",
                                     "\n--partial\n",
                                     "\n--dry-run\n",
                                     "99999999999999999999",
                                     NULL };

size_t target_seed(uint32_t k, uint8_t *to, size_t room)
{
    (void)k, (void)to, (void)room; /* all in the corpus's text */
    return 0;
}

static int within(double v, double lo, double hi)
{
    return v >= lo && v <= hi;
}

static void render_right(const struct sim_options *o)
{
    EXPECT(o->model && o->out);
    EXPECT(within((double)o->size[0], 1, 4096) && within((double)o->size[1], 1, 4096) && o->strip >= 1);
    EXPECT(within((double)o->depth_bits, 8, 16) && (o->subpixel == 4 || o->subpixel == 8));
    EXPECT(within((double)o->buffers, 1, 2));
    int n = 0;
    while (n <= SIM_FAST_MAX && o->fast.list[n])
        n++;
    EXPECT(n <= SIM_FAST_MAX);
    EXPECT(within((double)o->tris, 0, ZS_POOL_MAX) && within((double)o->verts, 0, ZS_POOL_MAX));
    EXPECT(within(o->fov, 0, 180) && within(o->ambient, 0, 1) && within(o->diffuse, 0, 1));
    EXPECT(within((double)o->threads, 0, 64) && within((int)o->cull, 0, 2));
    EXPECT(within((int)o->depth, 0, SIM_DEPTH_DEFAULT));
    for (int k = 0; k < 3; k++)
        EXPECT(within(o->eye[k], -1e300, 1e300) && within(o->at[k], -1e300, 1e300) && within(o->up[k], -1e300, 1e300));
    EXPECT(!o->has_near || o->near_z == o->near_z);
    EXPECT(!o->has_near || !o->has_far || o->near_z < o->far_z);
    EXPECT(!o->has_light || o->light[0] != 0 || o->light[1] != 0 || o->light[2] != 0);
}

static int render(int argc, char **argv)
{
    struct sim_options o;
    const int status = sim_options_parse(&o, argc, argv);
    if (status == SIM_OK && !o.help)
        render_right(&o);
    return status;
}

static int convert(int argc, char **argv)
{
    struct sim_convert_options o;
    const int status = sim_convert_parse(&o, argc, argv);
    if (status == SIM_OK && !o.help) {
        EXPECT(o.input && o.name && o.out && o.command && within(o.look, 0, SIM_LOOK_DEFAULT) && within(o.cull, 0, 2));
        EXPECT(!o.has_unit || (o.unit > 0 && o.unit < 1e300));
        EXPECT(!strchr(o.command, '\n') && !strstr(o.command, "*/")); /* it goes into a comment */
        for (int k = 0; k < 2; k++)
            EXPECT(within((double)o.texture_size[k], 1, 1024) && !(o.texture_size[k] & (o.texture_size[k] - 1)));
        EXPECT(strspn(o.name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_") == strlen(o.name));
    }
    free(o.command);
    return status;
}

static int linux_(int argc, char **argv)
{
    struct linux_options o;
    const int status = linux_options_parse(&o, argc, argv);
    if (status == SIM_OK && !o.help) {
        EXPECT(o.panel.name && o.spi && o.dc && !o.scene != !o.model);
        EXPECT((!o.has_speed || within((double)o.speed, 1000, 1e9)) && (o.subpixel == 4 || o.subpixel == 8));
        EXPECT(o.frames >= 0 && o.strip >= 1);
        EXPECT(within((double)o.size[0], 1, 4096) && within((double)o.size[1], 1, 4096));
    }
    return status;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct said said;
    char *word[WORDS + 1] = { NULL }, *kept[WORDS];
    int n = 0;
    if (!size)
        return 0;
    for (size_t at = 1; at < size && n < WORDS;) { /* each word in a block of its own */
        const uint8_t *end = memchr(data + at, '\n', size - at);
        const size_t bytes = end ? (size_t)(end - data) - at : size - at;
        word[n] = calloc(bytes + 1, 1);
        kept[n] = calloc(bytes + 1, 1);
        if (!word[n] || !kept[n])
            abort();
        memcpy(word[n], data + at, bytes);
        memcpy(kept[n], data + at, bytes);
        n++;
        at += bytes + 1;
    }
    said_begin(&said);
    const int status = data[0] == 'r' ? render(n, word) : data[0] == 'c' ? convert(n, word) : linux_(n, word);
    said_end(&said);
    EXPECT(status == SIM_OK || status == SIM_REFUSED || status == SIM_USAGE);
    EXPECT(said.lines == (status != SIM_OK));
    for (int i = 0; i < n; i++) {
        EXPECT(strcmp(word[i], kept[i]) == 0);
        free(word[i]);
        free(kept[i]);
    }
    return 0;
}
