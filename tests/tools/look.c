/* Looks into the files that zsim writes, for tests/tools/cli.sh. Shares no code with zsim.
 *
 *   look png F.png                     "WIDTH HEIGHT COLOURS"; 8-bit RGB of repeated RGB565 bits only
 *   look pixel F.png X Y               "RRGGBB"
 *   look count F.png RRGGBB            "COUNT" of pixels of this colour, as `pixel` prints it
 *   look codes F.png X Y W H           "R G B": mean codes of RGB565 over a rectangle, in thousandths
 *   look halved BIG.png SMALL.png      is each pixel of SMALL the mean of 2x2 of BIG, by code, rounded to nearest,
 *                                      halves up? "COUNT" of pixels that are not the same four times
 *   look halves FULL.png HALF.png      "MOST": by how many codes HALF is off half of FULL, rounded up, at most
 *   look mixed F.png A.png B.png       "NEITHER A B": pixels of F that are as in neither; as in A alone; as in B alone
 *   look texels F.png <LIST            lines "X Y COLUMN ROW": what texel of fixture's `numbers` is
 *                                      there? "COUNT SAME MOST_APART", the last in texels each way
 *   look decode F.png I.u32            does the picture of --shade id hold the ids' low 16 bits?
 *   look bare F.png D.pgm RRGGBB       is just what has key 65535 of this colour? "COUNT" of it
 *   look pgm D.pgm W H                 "DRAWN LEAST LARGEST"; the file byte for byte as promised
 *   look key D.pgm X Y                 the key
 *   look ids I.u32 W H                 "COVERED DISTINCT LARGEST X0 Y0 X1 Y1", a box with both ends
 *   look covered I.u32 W               "COVERED" alone
 *   look id I.u32 W X Y                the id
 *   look points I.u32 W <LIST          are the ids those of the lines "X Y ID"? "COUNT" of them
 *   look drawn I.u32 D.pgm             have the same pixels an id and a key?
 *   look differ A.u32 B.u32            "PIXELS" that differ
 *   look same A B ENDING...            are A.ENDING and B.ENDING there, not empty, and the same bytes?
 *   look unlike F A...                 does F hold other bytes than each of the others?
 *   look keys A.pgm B.pgm              "BOTH MORE_THAN_1_APART MOST_APART"
 *   look slope A.pgm A.u32 B.pgm B.u32  do keys differ by no more than snapping moves them? "COUNT"
 *   look json F.json [KEY]             one flat object of numbers? the number of KEY, or "COUNT"
 *
 * Exit 0; 1 with a sentence on standard output where the file is not what it should be.
 *
 * SPDX-License-Identifier: MIT
 */
#include <ctype.h>
#include <png.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void __attribute__((format(printf, 1, 2), noreturn)) wrong(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vprintf(format, args);
    va_end(args);
    putchar('\n');
    exit(1);
}

struct bytes {
    uint8_t *b;
    size_t n;
};

static struct bytes load(const char *name)
{
    struct bytes f = { NULL, 0 };
    FILE *in = fopen(name, "rb");
    if (in == NULL)
        wrong("%s is not there", name);
    for (size_t got = 1, room = 1 << 18; got != 0; f.n += got, room *= 2) {
        f.b = realloc(f.b, room);
        got = fread(f.b + f.n, 1, room - f.n, in);
    }
    fclose(in);
    return f;
}

/* ---- PNG ------------------------------------------------------------------------------------- */

struct picture {
    uint32_t w, h;
    uint16_t *px; /* RGB565 */
};

static uint32_t be32(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static struct picture load_png(const char *name)
{
    const struct bytes f = load(name);
    png_image image = { .version = PNG_IMAGE_VERSION };
    if (f.n < 33 || memcmp(f.b, "\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16) != 0)
        wrong("%s does not begin as a PNG does", name);
    if (f.b[24] != 8 || f.b[25] != 2 || f.b[28] != 0)
        wrong("%s: depth %d, colour type %d, interlace %d instead of 8, 2, 0", name, f.b[24],
              f.b[25], f.b[28]);
    if (!png_image_begin_read_from_memory(&image, f.b, f.n))
        wrong("%s: %s", name, image.message);
    image.format = PNG_FORMAT_RGB;
    const size_t n = (size_t)image.width * image.height;
    uint8_t *rgb = malloc(3 * n);
    if (!png_image_finish_read(&image, NULL, rgb, 0, NULL))
        wrong("%s: %s", name, image.message);
    struct picture p = { be32(f.b + 16), be32(f.b + 20), malloc(n * sizeof *p.px) };
    for (size_t i = 0; i < n; i++) {
        const unsigned r = rgb[3 * i] >> 3, g = rgb[3 * i + 1] >> 2, b = rgb[3 * i + 2] >> 3;
        if (rgb[3 * i] != (r << 3 | r >> 2) || rgb[3 * i + 1] != (g << 2 | g >> 4) ||
            rgb[3 * i + 2] != (b << 3 | b >> 2))
            wrong("%s: pixel %zu,%zu is %02x%02x%02x, no RGB565 bits repeated", name, i % p.w,
                  i / p.w, rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
        p.px[i] = (uint16_t)(r << 11 | g << 5 | b);
    }
    free(rgb);
    free(f.b);
    return p;
}

static unsigned rgb_of(unsigned v)
{
    const unsigned red = v >> 11, green = v >> 5 & 63, blue = v & 31;
    return (red << 3 | red >> 2) << 16 | (green << 2 | green >> 4) << 8 | (blue << 3 | blue >> 2);
}

static void look_count(const char *png, const char *rgb)
{
    const struct picture p = load_png(png);
    const unsigned long wanted = strtoul(rgb, NULL, 16);
    size_t n = 0;
    for (size_t i = 0; i < (size_t)p.w * p.h; i++)
        n += rgb_of(p.px[i]) == wanted;
    printf("%zu\n", n);
}

static void look_codes(const char *png, const size_t at[4])
{
    const struct picture p = load_png(png);
    const size_t n = at[2] * at[3];
    unsigned long long sum[3] = { 0 };
    if (n == 0 || at[0] + at[2] > p.w || at[1] + at[3] > p.h)
        wrong("%s has no such rectangle", png);
    for (size_t y = at[1]; y < at[1] + at[3]; y++)
        for (size_t x = at[0]; x < at[0] + at[2]; x++) {
            const unsigned v = p.px[y * p.w + x];
            sum[0] += v >> 11;
            sum[1] += v >> 5 & 63;
            sum[2] += v & 31;
        }
    printf("%llu %llu %llu\n", 1000 * sum[0] / n, 1000 * sum[1] / n, 1000 * sum[2] / n);
}

static void look_halved(const char *big, const char *small)
{
    static const struct {
        unsigned shift, mask;
    } part[3] = { { 11, 31 }, { 5, 63 }, { 0, 31 } };
    const struct picture b = load_png(big), s = load_png(small);
    size_t mixed = 0;
    if (b.w != 2 * s.w || b.h != 2 * s.h)
        wrong("%s is not twice as wide and high as %s", big, small);
    for (size_t y = 0; y < s.h; y++)
        for (size_t x = 0; x < s.w; x++) {
            const uint16_t *at = b.px + 2 * y * b.w + 2 * x;
            const unsigned of[4] = { at[0], at[1], at[b.w], at[b.w + 1] };
            unsigned mean = 0;
            for (int c = 0; c < 3; c++) {
                unsigned sum = 2;
                for (int k = 0; k < 4; k++)
                    sum += of[k] >> part[c].shift & part[c].mask;
                mean |= sum / 4 << part[c].shift;
            }
            if (s.px[y * s.w + x] != mean)
                wrong("pixel %zu,%zu of %s is %06x instead of %06x", x, y, small, rgb_of(s.px[y * s.w + x]),
                      rgb_of(mean));
            mixed += of[0] != of[1] || of[0] != of[2] || of[0] != of[3];
        }
    printf("%zu\n", mixed);
}

static void look_halves(const char *full, const char *half)
{
    const struct picture f = load_png(full), h = load_png(half);
    int most = 0;
    if (f.w != h.w || f.h != h.h)
        wrong("%s and %s have other sizes", full, half);
    for (size_t i = 0; i < (size_t)f.w * f.h; i++)
        for (int c = 0; c < 3; c++) {
            const int shift = c == 0 ? 11 : c == 1 ? 5 : 0, mask = c == 1 ? 63 : 31;
            const int off = abs((f.px[i] >> shift & mask) - 2 * (h.px[i] >> shift & mask));
            most = (off + 1) / 2 > most ? (off + 1) / 2 : most;
        }
    printf("%d\n", most);
}

static void look_mixed(const char *file, const char *one, const char *other)
{
    const struct picture f = load_png(file), a = load_png(one), b = load_png(other);
    size_t n[3] = { 0, 0, 0 };
    if (f.w != a.w || f.h != a.h || f.w != b.w || f.h != b.h)
        wrong("%s, %s and %s have other sizes", file, one, other);
    for (size_t i = 0; i < (size_t)f.w * f.h; i++) {
        n[0] += f.px[i] != a.px[i] && f.px[i] != b.px[i];
        n[1] += f.px[i] == a.px[i] && f.px[i] != b.px[i];
        n[2] += f.px[i] != a.px[i] && f.px[i] == b.px[i];
    }
    printf("%zu %zu %zu\n", n[0], n[1], n[2]);
}

static int count_colors(const struct picture *p)
{
    static uint8_t seen[65536];
    int n = 0;
    for (size_t i = 0; i < (size_t)p->w * p->h; i++) {
        n += !seen[p->px[i]];
        seen[p->px[i]] = 1;
    }
    return n;
}

static uint16_t rgb565_of(const char *hex)
{
    const unsigned long v = strtoul(hex, NULL, 16);
    return (uint16_t)((v >> 19 & 31) << 11 | (v >> 10 & 63) << 5 | (v >> 3 & 31));
}

/* ---- PGM and u32 ----------------------------------------------------------------------------- */

struct map {
    size_t w, h, n;
    uint32_t *v;
};

static struct map load_pgm(const char *name)
{
    const struct bytes f = load(name);
    unsigned w, h, most;
    int at = 0;
    if (sscanf((const char *)f.b, "P5 %u %u %u%n", &w, &h, &most, &at) != 3 || most != 65535 ||
        f.b[at] != '\n')
        wrong("%s: its header is not P5, sizes, 65535", name);
    at++;
    struct map m = { w, h, (size_t)w * h, NULL };
    if (f.n != (size_t)at + 2 * m.n)
        wrong("%s: %zu bytes, a header of %d and %ux%u keys take %zu", name, f.n, at, w, h,
              (size_t)at + 2 * m.n);
    m.v = malloc(m.n * sizeof *m.v);
    for (size_t i = 0; i < m.n; i++)
        m.v[i] = (uint32_t)f.b[(size_t)at + 2 * i] << 8 | f.b[(size_t)at + 2 * i + 1];
    free(f.b);
    return m;
}

static struct map load_u32(const char *name, size_t w)
{
    const struct bytes f = load(name);
    struct map m = { w, 0, f.n / 4, malloc(f.n + 4) };
    if (f.n % 4 != 0 || m.n % w != 0)
        wrong("%s: %zu bytes are no rows of %zu ids", name, f.n, w);
    m.h = m.n / w;
    for (size_t i = 0; i < m.n; i++)
        m.v[i] = f.b[4 * i] | (uint32_t)f.b[4 * i + 1] << 8 | (uint32_t)f.b[4 * i + 2] << 16 |
                 (uint32_t)f.b[4 * i + 3] << 24;
    free(f.b);
    return m;
}

static int by_value(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void look_ids(const char *name, size_t w, size_t h)
{
    const struct map m = load_u32(name, w);
    size_t covered = 0, distinct = 0, x0 = w, y0 = h, x1 = 0, y1 = 0;
    if (m.h != h)
        wrong("%s: %zu rows instead of %zu", name, m.h, h);
    for (size_t i = 0; i < m.n; i++)
        if (m.v[i] != 0) {
            covered++;
            x0 = i % w < x0 ? i % w : x0;
            x1 = i % w > x1 ? i % w : x1;
            y0 = i / w < y0 ? i / w : y0;
            y1 = i / w > y1 ? i / w : y1;
        }
    qsort(m.v, m.n, sizeof *m.v, by_value);
    for (size_t i = 0; i < m.n; i++)
        distinct += m.v[i] != 0 && (i == 0 || m.v[i] != m.v[i - 1]);
    printf("%zu %zu %u %zu %zu %zu %zu\n", covered, distinct, m.v[m.n - 1], x0, y0, x1, y1);
}

static void look_pgm(const char *name, size_t w, size_t h)
{
    const struct bytes f = load(name);
    char header[64];
    const int n = snprintf(header, sizeof header, "P5\n%zu %zu\n65535\n", w, h);
    if (f.n < (size_t)n || memcmp(f.b, header, (size_t)n) != 0)
        wrong("%s does not begin with P5, %zu %zu, 65535 on lines of their own", name, w, h);
    const struct map m = load_pgm(name);
    size_t drawn = 0;
    uint32_t lo = 65535, hi = 0;
    for (size_t i = 0; i < m.n; i++)
        if (m.v[i] != 65535) {
            drawn++;
            lo = m.v[i] < lo ? m.v[i] : lo;
            hi = m.v[i] > hi ? m.v[i] : hi;
        }
    printf("%zu %u %u\n", drawn, lo, hi);
}

static void look_points(const char *name, size_t w)
{
    const struct map m = load_u32(name, w);
    size_t n = 0, x, y;
    for (uint32_t id; scanf("%zu %zu %u", &x, &y, &id) == 3; n++)
        if (y * w + x >= m.n || m.v[y * w + x] != id)
            wrong("pixel %zu,%zu should show triangle %u, not %u", x, y, id,
                  y * w + x < m.n ? m.v[y * w + x] : 0);
    printf("%zu\n", n);
}

/* ---- JSON ------------------------------------------------------------------------------------ */

static const char *skip(const char *p)
{
    while (*p == ' ' || *p == '\t' || *p == '\r' || *p == '\n')
        p++;
    return p;
}

/* RFC 8259's number; NULL where it is none. */
static const char *number(const char *p)
{
    p += *p == '-';
    if (!isdigit((unsigned char)*p) || (p[0] == '0' && isdigit((unsigned char)p[1])))
        return NULL;
    while (isdigit((unsigned char)*p))
        p++;
    if (*p == '.') {
        if (!isdigit((unsigned char)*++p))
            return NULL;
        while (isdigit((unsigned char)*p))
            p++;
    }
    if (*p == 'e' || *p == 'E') {
        p++;
        p += *p == '+' || *p == '-';
        if (!isdigit((unsigned char)*p))
            return NULL;
        while (isdigit((unsigned char)*p))
            p++;
    }
    return p;
}

static void look_json(const char *name, const char *wanted)
{
    struct bytes f = load(name);
    f.b = realloc(f.b, f.n + 1);
    f.b[f.n] = '\0';
    static char keys[65536];
    const char *p = skip((const char *)f.b), *value = NULL;
    int n = 0;
    if (*p++ != '{')
        wrong("%s is no JSON object", name);
    for (;; n++) {
        char key[80];
        p = skip(p);
        const size_t length = *p == '"' ? strcspn(p + 1, "\"\\") : 0;
        if (length == 0 || length > 70 || p[length + 1] != '"')
            wrong("%s: key expected at '%.20s'", name, p);
        snprintf(key, sizeof key, "\"%.*s\"", (int)length, p + 1);
        if (strstr(keys, key) != NULL)
            wrong("%s has %s twice", name, key);
        strcat(keys, key);
        p = skip(p + length + 2);
        if (*p++ != ':')
            wrong("%s: no colon after %s", name, key);
        p = skip(p);
        const char *end = number(p);
        if (end == NULL)
            wrong("%s: %s is '%.12s', no number", name, key, p);
        if (wanted != NULL && strlen(wanted) == length && memcmp(key + 1, wanted, length) == 0)
            value = p;
        p = skip(end);
        if (*p == '}')
            break;
        if (*p++ != ',')
            wrong("%s: comma expected after %s", name, key);
    }
    if (*skip(p + 1) != '\0' || (size_t)(skip(p + 1) - (const char *)f.b) != f.n)
        wrong("%s goes on after its object", name);
    if (wanted == NULL)
        printf("%d\n", n + 1);
    else if (value == NULL)
        wrong("%s has no %s", name, wanted);
    else
        printf("%.*s\n", (int)(number(value) - value), value);
}

/* ---- Two files ------------------------------------------------------------------------------- */

static void look_decode(const char *png, const char *u32)
{
    const struct picture p = load_png(png);
    const struct map m = load_u32(u32, p.w);
    for (size_t i = 0; i < m.n && m.h == p.h; i++)
        if (p.px[i] != (m.v[i] & 0xffff))
            wrong("pixel %zu,%zu decodes to %u, its triangle is %u", i % p.w, i / p.w, p.px[i],
                  m.v[i]);
    if (m.h != p.h)
        wrong("%s has %zu rows, %s %u", u32, m.h, png, p.h);
}

static void look_bare(const char *png, const char *pgm, const char *color)
{
    const struct picture p = load_png(png);
    const struct map m = load_pgm(pgm);
    const uint16_t c = rgb565_of(color);
    size_t n = 0;
    for (size_t i = 0; i < m.n; n += m.v[i++] == 65535)
        if ((m.v[i] == 65535) != (p.px[i] == c))
            wrong("pixel %zu,%zu: key %u and colour %04x", i % p.w, i / p.w, m.v[i], p.px[i]);
    printf("%zu\n", n);
}

static void look_drawn(const char *u32, const char *pgm)
{
    const struct map k = load_pgm(pgm), m = load_u32(u32, k.w);
    if (m.h != k.h)
        wrong("%s has %zu rows, %s %zu", u32, m.h, pgm, k.h);
    for (size_t i = 0; i < m.n; i++)
        if ((m.v[i] != 0) != (k.v[i] != 65535))
            wrong("pixel %zu,%zu: id %u and key %u", i % k.w, i / k.w, m.v[i], k.v[i]);
}

static void look_differ(const char *a, const char *b)
{
    const struct map ma = load_u32(a, 1), mb = load_u32(b, 1);
    size_t n = 0;
    if (ma.n != mb.n)
        wrong("%zu pixels and %zu", ma.n, mb.n);
    for (size_t i = 0; i < ma.n; i++)
        n += ma.v[i] != mb.v[i];
    printf("%zu\n", n);
}

static void look_same(const char *one, const char *other, char **ending)
{
    for (; *ending != NULL; ending++) {
        char a[256], b[256];
        snprintf(a, sizeof a, "%s.%s", one, *ending);
        snprintf(b, sizeof b, "%s.%s", other, *ending);
        const struct bytes fa = load(a), fb = load(b);
        if (fa.n == 0 || fa.n != fb.n || memcmp(fa.b, fb.b, fa.n) != 0)
            wrong("%s and %s differ", a, b);
    }
}

static void look_unlike(char **name)
{
    const struct bytes f = load(name[0]);
    for (char **other = name + 1; *other != NULL; other++) {
        const struct bytes g = load(*other);
        if (f.n == g.n && memcmp(f.b, g.b, f.n) == 0)
            wrong("%s is %s", name[0], *other);
    }
}

static void look_keys(const char *a, const char *b)
{
    const struct map ma = load_pgm(a), mb = load_pgm(b);
    size_t both = 0, off = 0;
    uint32_t most = 0;
    if (ma.w != mb.w || ma.h != mb.h)
        wrong("%zux%zu and %zux%zu", ma.w, ma.h, mb.w, mb.h);
    for (size_t i = 0; i < ma.n; i++)
        if (ma.v[i] != 65535 && mb.v[i] != 65535) {
            const uint32_t d = ma.v[i] > mb.v[i] ? ma.v[i] - mb.v[i] : mb.v[i] - ma.v[i];
            both++;
            off += d > 1;
            most = d > most ? d : most;
        }
    printf("%zu %zu %u\n", both, off, most);
}

/* Keys where both files show one triangle: snapping moves a vertex by 1/512 px at most each way, so
 * the key may move by the slope of the triangle times that, and both are rounded. The slope comes
 * from the second file's neighbours; where no neighbour is of the triangle nothing is said. */
static void look_slope(char **name)
{
    const struct map ka = load_pgm(name[0]), kb = load_pgm(name[2]);
    const struct map a = load_u32(name[1], ka.w), b = load_u32(name[3], kb.w);
    size_t n = 0;
    for (size_t i = 0; i < a.n && a.n == b.n && ka.n == kb.n; i++) {
        const size_t x = i % a.w, y = i / a.w, step[2] = { 1, a.w };
        const int before[2] = { x > 0, y > 0 }, after[2] = { x + 1 < a.w, y + 1 < a.h };
        double slope = 2.0; /* of two rounded keys each way */
        int known = a.v[i] != 0 && a.v[i] == b.v[i];
        for (int k = 0; k < 2; k++) {
            const size_t j = after[k] && b.v[i + step[k]] == b.v[i]    ? i + step[k]
                             : before[k] && b.v[i - step[k]] == b.v[i] ? i - step[k]
                                                                       : i;
            known = known && j != i;
            slope += abs((int)kb.v[i] - (int)kb.v[j]);
        }
        n += (size_t)known;
        const int d = abs((int)ka.v[i] - (int)kb.v[i]);
        if (known && d > 1.51 + slope / 512.0)
            wrong("pixel %zu,%zu of triangle %u: keys %u and %u, a slope of %g", x, y, a.v[i],
                  ka.v[i], kb.v[i], slope - 2.0);
    }
    printf("%zu\n", n);
}

static void look_texels(const char *name)
{
    const struct picture p = load_png(name);
    size_t n = 0, same = 0;
    int most = 0, x, y, column, row;
    while (scanf("%d %d %d %d", &x, &y, &column, &row) == 4) {
        if (x < 0 || y < 0 || (uint32_t)x >= p.w || (uint32_t)y >= p.h)
            wrong("%s has no pixel %d,%d", name, x, y);
        const unsigned c = p.px[(size_t)y * p.w + (size_t)x], blue = c & 31;
        if (blue != 0 && blue != 31)
            wrong("%s: pixel %d,%d is no texel of the numbers", name, x, y);
        const int dx = abs((int)(c >> 11 << 1 | (blue != 0)) - column);
        const int dy = abs((int)(c >> 5 & 63) - row);
        n++;
        same += dx == 0 && dy == 0;
        most = dx > most ? dx : most;
        most = dy > most ? dy : most;
    }
    printf("%zu %zu %d\n", n, same, most);
}

/* What is asked of two files, or of a file and a name. */
static const struct of_two {
    const char *what;
    void (*look)(const char *, const char *);
} of_two[] = {
    { "count", look_count }, { "halved", look_halved }, { "halves", look_halves }, { "decode", look_decode },
    { "drawn", look_drawn }, { "differ", look_differ }, { "keys", look_keys },
};

static int looked_of_two(const char *what, char **name)
{
    for (size_t i = 0; i < sizeof of_two / sizeof of_two[0]; i++)
        if (strcmp(what, of_two[i].what) == 0) {
            of_two[i].look(name[0], name[1]);
            return 1;
        }
    return 0;
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    const size_t a = argc > 3 ? strtoul(argv[3], NULL, 10) : 0;
    const size_t b = argc > 4 ? strtoul(argv[4], NULL, 10) : 0;
    const size_t c = argc > 5 ? strtoul(argv[5], NULL, 10) : 0;
    if (argc == 4 && looked_of_two(what, argv + 2))
        return 0;
    if (strcmp(what, "png") == 0 && argc == 3) {
        const struct picture p = load_png(argv[2]);
        printf("%u %u %d\n", p.w, p.h, count_colors(&p));
    } else if (strcmp(what, "pixel") == 0 && argc == 5) {
        const struct picture p = load_png(argv[2]);
        if (a >= p.w || b >= p.h)
            wrong("%s has no pixel %zu,%zu", argv[2], a, b);
        printf("%06x\n", rgb_of(p.px[b * p.w + a]));
    } else if (strcmp(what, "codes") == 0 && argc == 7) {
        const size_t at[4] = { a, b, strtoul(argv[5], NULL, 10), strtoul(argv[6], NULL, 10) };
        look_codes(argv[2], at);
    } else if (strcmp(what, "mixed") == 0 && argc == 5) {
        look_mixed(argv[2], argv[3], argv[4]);
    } else if (strcmp(what, "texels") == 0 && argc == 3) {
        look_texels(argv[2]);
    } else if (strcmp(what, "bare") == 0 && argc == 5) {
        look_bare(argv[2], argv[3], argv[4]);
    } else if (strcmp(what, "pgm") == 0 && argc == 5) {
        look_pgm(argv[2], a, b);
    } else if (strcmp(what, "key") == 0 && argc == 5) {
        const struct map m = load_pgm(argv[2]);
        if (a >= m.w || b >= m.h)
            wrong("%s has no pixel %zu,%zu", argv[2], a, b);
        printf("%u\n", m.v[b * m.w + a]);
    } else if (strcmp(what, "ids") == 0 && argc == 5 && a > 0) {
        look_ids(argv[2], a, b);
    } else if (strcmp(what, "covered") == 0 && argc == 4 && a > 0) {
        const struct map m = load_u32(argv[2], a);
        size_t n = 0;
        for (size_t i = 0; i < m.n; i++)
            n += m.v[i] != 0;
        printf("%zu\n", n);
    } else if (strcmp(what, "id") == 0 && argc == 6 && a > 0) {
        const struct map m = load_u32(argv[2], a);
        if (b >= a || c >= m.h)
            wrong("%s has no pixel %zu,%zu", argv[2], b, c);
        printf("%u\n", m.v[c * a + b]);
    } else if (strcmp(what, "points") == 0 && argc == 4 && a > 0) {
        look_points(argv[2], a);
    } else if (strcmp(what, "same") == 0 && argc > 4) {
        look_same(argv[2], argv[3], argv + 4);
    } else if (strcmp(what, "unlike") == 0 && argc > 3) {
        look_unlike(argv + 2);
    } else if (strcmp(what, "slope") == 0 && argc == 6) {
        look_slope(argv + 2);
    } else if (strcmp(what, "json") == 0 && (argc == 3 || argc == 4)) {
        look_json(argv[2], argc == 4 ? argv[3] : NULL);
    } else {
        wrong("look: no such thing: %s", what);
    }
    return 0;
}
