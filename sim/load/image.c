/* PNG by libpng's simplified interface, JPEG by TurboJPEG. What needs neither is in picture.c.
 *
 * SPDX-License-Identifier: MIT
 */
#include "image.h"

#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <turbojpeg.h>

#include "output_file.h"
#include "sim.h"

#define PIXELS_MAX ((uint64_t)1 << 27)

/* ---- Out of memory and files ----------------------------------------------------------------- */

static int begin(struct sim_image *out, const char *name, uint64_t width, uint64_t height)
{
    if (width < 1 || height < 1 || width > SIM_IMAGE_MAX || height > SIM_IMAGE_MAX ||
        width * height > PIXELS_MAX)
        return sim_refuse(name, 0,
                          "a picture of %llu x %llu px; zsim reads up to %d each way and %llu in "
                          "all: save it smaller",
                          (unsigned long long)width, (unsigned long long)height, SIM_IMAGE_MAX,
                          (unsigned long long)PIXELS_MAX);
    out->width = (uint32_t)width;
    out->height = (uint32_t)height;
    out->rgb = sim_alloc(width * height, sizeof *out->rgb);
    return SIM_OK;
}

/* A PNG without what it says of its gamma and profile, malloc'ed; *n: bytes, as they are then. */
static uint8_t *without_profile(const uint8_t *png, size_t *n)
{
    static const char *const left_out[] = { "gAMA", "cHRM", "iCCP", "sRGB" };
    uint8_t *const out = sim_alloc(*n, 1);
    size_t at = 8, to = 8;
    memcpy(out, png, 8);
    while (at < *n) {
        const size_t left = *n - at;
        size_t chunk = left;
        int taken = 1;
        if (left >= 12) {
            const size_t length = (size_t)png[at] << 24 | (size_t)png[at + 1] << 16 | (size_t)png[at + 2] << 8 |
                                  png[at + 3];
            chunk = length <= left - 12 ? length + 12 : left;
            for (size_t i = 0; i < sizeof left_out / sizeof left_out[0]; i++)
                taken &= memcmp(png + at + 4, left_out[i], 4) != 0;
        }
        if (taken)
            memcpy(out + to, png + at, chunk);
        to += taken ? chunk : 0;
        at += chunk;
    }
    *n = to;
    return out;
}

static int decode_png(struct sim_image *out, const char *name, const void *bytes, size_t n)
{
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&image, bytes, n))
        return sim_refuse(name, 0, "a broken PNG: %s; save it again", image.message);
    int status = begin(out, name, image.width, image.height);
    if (status == SIM_OK) {
        image.format = PNG_FORMAT_RGBA;
        image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB; /* as 8-bit ones: nothing is made brighter */
        const size_t pixels = (size_t)out->width * out->height;
        uint8_t(*rgba)[4] = sim_alloc(pixels, sizeof *rgba);
        if (!png_image_finish_read(&image, NULL, rgba, 0, NULL))
            status = sim_refuse(name, 0, "a broken PNG: %s; save it again", image.message);
        unsigned least = 255;
        for (size_t i = 0; i < pixels; i++) {
            memcpy(out->rgb[i], rgba[i], sizeof out->rgb[i]);
            least = rgba[i][3] < least ? rgba[i][3] : least;
        }
        out->alpha = least < 255 ? sim_alloc(pixels, 1) : NULL;
        for (size_t i = 0; out->alpha != NULL && i < pixels; i++)
            out->alpha[i] = rgba[i][3];
        free(rgba);
    }
    png_image_free(&image);
    return status;
}

/* A decoder's complaint as something to refuse the file for. What a decoder only warns of is passed
 * over, but not that the file ends too early. */
static int jpeg_failed(tjhandle jpeg, int result)
{
    return result != 0 && (tjGetErrorCode(jpeg) == TJERR_FATAL ||
                           strstr(tjGetErrorStr2(jpeg), "remature end") != NULL);
}

static int decode_jpeg(struct sim_image *out, const char *name, const void *bytes, size_t n)
{
    int width = 0, height = 0, sampling = 0, space = 0; /* a cut-off header may leave them alone */
    tjhandle jpeg = tjInitDecompress();
    if (jpeg == NULL)
        return sim_refuse(name, 0, "cannot be read: %s", tjGetErrorStr());
    int status = SIM_OK;
    if (jpeg_failed(jpeg, tjDecompressHeader3(jpeg, bytes, (unsigned long)n, &width, &height,
                                              &sampling, &space)) ||
        width < 1 || height < 1)
        status = sim_refuse(name, 0, "a broken JPEG: %s; save it again", tjGetErrorStr2(jpeg));
    else if (space == TJCS_CMYK || space == TJCS_YCCK)
        status = sim_refuse(name, 0, "a JPEG in CMYK colours; save it in RGB");
    else
        status = begin(out, name, (uint64_t)width, (uint64_t)height);
    if (status == SIM_OK &&
        jpeg_failed(jpeg, tjDecompress2(jpeg, bytes, (unsigned long)n, out->rgb[0], width, 0,
                                        height, TJPF_RGB, TJFLAG_ACCURATEDCT)))
        status = sim_refuse(name, 0, "a broken JPEG: %s; save it again", tjGetErrorStr2(jpeg));
    (void)tjDestroy(jpeg);
    return status;
}

int sim_image_decode(struct sim_image *out, const char *name, const void *bytes, size_t n, int as_it_is)
{
    int status;
    memset(out, 0, sizeof *out);
    if (n >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) {
        uint8_t *own = as_it_is ? without_profile(bytes, &n) : NULL;
        status = decode_png(out, name, own != NULL ? own : bytes, n);
        free(own);
    } else if (n >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0) {
        status = decode_jpeg(out, name, bytes, n);
    } else {
        status = sim_refuse(name, 0, "neither a PNG nor a JPEG; save it as one of them");
    }
    if (status != SIM_OK)
        sim_image_free(out);
    return status;
}

int sim_image_load(struct sim_image *out, const char *path, int as_it_is)
{
    struct stat st;
    memset(out, 0, sizeof *out);
    if (stat(path, &st) != 0)
        return sim_refuse(path, 0, "cannot be read: %s", strerror(errno));
    if (!S_ISREG(st.st_mode))
        return sim_refuse(path, 0, "is not a regular file; name a PNG or JPEG");
    FILE *f = fopen(path, "rb");
    if (f == NULL)
        return sim_refuse(path, 0, "cannot be read: %s", strerror(errno));
    const size_t n = (size_t)st.st_size;
    uint8_t *bytes = sim_alloc(n, 1);
    const int whole = fread(bytes, 1, n, f) == n;
    (void)fclose(f);
    const int status = whole ? sim_image_decode(out, path, bytes, n, as_it_is)
                             : sim_refuse(path, 0, "cannot be read to its end");
    free(bytes);
    return status;
}

/* ---- Into streams ---------------------------------------------------------------------------- */

int sim_png_write(FILE *f, const char *name, uint32_t width, uint32_t height, const uint8_t *rgb)
{
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGB;
    image.flags |= PNG_IMAGE_FLAG_FAST;
    if (png_image_write_to_stdio(&image, f, 0, rgb, 0, NULL))
        return SIM_OK;
    const int status = sim_refuse(name, 0, "cannot be written: %s", image.message);
    png_image_free(&image);
    return status;
}

int sim_png_save(const char *path, uint32_t width, uint32_t height, const uint8_t *rgb)
{
    struct sim_output out;
    int status = sim_output_open(&out, path);
    if (status != SIM_OK)
        return status;
    status = sim_png_write(out.file, path, width, height, rgb);
    return sim_output_end(status, &out, 1);
}

int sim_picture_save(const struct sim_picture *p, const char *png, const char *raw)
{
    struct sim_output out[2];
    size_t n = 1;
    int status = sim_output_open(&out[0], png);
    if (status != SIM_OK)
        return status;
    status = sim_png_write(out[0].file, png, p->width, p->height, p->rgb);
    if (status == SIM_OK && raw != NULL && (status = sim_output_open(&out[1], raw)) == SIM_OK)
        sim_values_write(out[n++].file, p->raw, (size_t)p->width * p->height, p->raw_bytes);
    return sim_output_end(status, out, n);
}
