/* Panel drivers through the simulator's bus into the model of their controllers: what rectangles, rotation,
 * inversion, sleep and brightness look like to the viewer, on every module that the model knows, against a picture
 * that is kept here by the formulas of panel.h. The model must have nothing to say about the bytes, times included.
 *
 * SPDX-License-Identifier: MIT
 */
#include <string.h>

#include "cases.h"
#include "panel.h"
#include "panel_bus.h"
#include "glass_level.h"

#define PIXELS (320 * 240)

/* A module with its driver, and what its viewer should see. */
struct scene {
    struct panel_config config;
    struct pm_glass glass;
    struct sim_panel_bus bus;
    struct panel panel;
    uint8_t lit_with_noise; /* flag: the glass was once lit and showed more than black while panel_init ran */
};

static struct scene s;
static uint8_t want[PIXELS][3], seen[PIXELS][3], on_glass[PIXELS][3];
static _Alignas(4) uint8_t px[2 * PIXELS + 4096], scratch[2 * PIXELS];

/* "ssd1306:64x48, ...": the nth of the model's list; 0: there are not so many. */
static int nth_module(unsigned n, char name[32])
{
    const char *at = pm_glass_list();
    for (; n > 0 && at != NULL; n--) {
        at = strchr(at, ',');
        at = at != NULL ? at + 2 : NULL;
    }
    if (at == NULL)
        return 0;
    (void)snprintf(name, 32, "%.*s", (int)strcspn(at, ","), at);
    return 1;
}

static const struct panel_type *driver_of(const char *name)
{
    for (uint32_t i = 0; i < n_panel_types; i++)
        if (strncmp(panel_name(panel_types[i]), name, strlen(panel_name(panel_types[i]))) == 0)
            return panel_types[i];
    return NULL;
}

/* ---- What is seen -------------------------------------------------------------------------------------- */

static void look(void)
{
    pm_picture(s.bus.model, on_glass[0], NULL);
    pm_view(&s.glass, s.panel.config.rotate, on_glass, seen, 3);
}

static int check(const char *after)
{
    const int w = panel_width(&s.panel), h = panel_height(&s.panel);
    const struct pm_problem *problem;
    if (pm_problems(s.bus.model, &problem) > 0)
        return case_wrong("%s %dx%d, rotate %d, %s: %s", panel_name(s.config.type), w, h, s.panel.config.rotate,
                          after, problem[0].text);
    look();
    for (int i = 0; i < w * h; i++)
        if (memcmp(seen[i], want[i], 3) != 0)
            return case_wrong("%s %dx%d, rotate %d, %s: at %d, %d %02x%02x%02x instead of %02x%02x%02x",
                              panel_name(s.config.type), w, h, s.panel.config.rotate, after, i % w, i / w, seen[i][0],
                              seen[i][1], seen[i][2], want[i][0], want[i][1], want[i][2]);
    return 1;
}

/* A pixel of the picture as it should be seen. */
static void wanted(uint8_t out[3], unsigned v, unsigned x, unsigned y)
{
    const unsigned r5 = v >> 11, g6 = v >> 5 & 63, b5 = v & 31;
    const unsigned r = r5 * 8 + r5 / 4, g = g6 * 4 + g6 / 16, b = b5 * 8 + b5 / 4;
    const enum panel_format format = panel_format(s.config.type);
    const unsigned one = format == PANEL_GREY4 ? 17 * quantise_level(r, g, b) : 255 * quantise_bit(r, g, b, x, y);
    out[0] = (uint8_t)(format == PANEL_RGB565 ? r : one);
    out[1] = (uint8_t)(format == PANEL_RGB565 ? g : one);
    out[2] = (uint8_t)(format == PANEL_RGB565 ? b : one);
}

/* ---- Set-up: the glass is dark until it is black ------------------------------------------------------- */

static int (*model_command)(struct hal_bus *, uint8_t, const uint8_t *, uint32_t);
static int (*model_wait)(struct hal_bus *);

static void watch(void)
{
    if (!pm_lit(s.bus.model))
        return;
    pm_picture(s.bus.model, on_glass[0], NULL);
    for (int i = 0; i < s.glass.width * s.glass.height; i++)
        s.lit_with_noise |= (on_glass[i][0] | on_glass[i][1] | on_glass[i][2]) != 0;
}

static int watched_command(struct hal_bus *bus, uint8_t code, const uint8_t *args, uint32_t n)
{
    const int err = model_command(bus, code, args, n);
    watch();
    return err;
}

static int watched_wait(struct hal_bus *bus)
{
    const int err = model_wait(bus);
    watch();
    return err;
}

static int open_scene(const char *name, uint8_t rotate, uint8_t inverted, uint8_t bgr, uint8_t lsb_first)
{
    memset(&s, 0, sizeof s);
    assert_true(pm_glass_named(&s.glass, name));
    s.glass.inverted = inverted;
    s.glass.bgr = bgr;
    struct pm_model *model = pm_new(&s.glass);
    assert_non_null(model);
    sim_panel_bus_init(&s.bus, model);
    s.config = (struct panel_config){ driver_of(name), s.glass.width, s.glass.height, .rotate = rotate,
                                      .invert = inverted, .bgr = bgr, .lsb_first = lsb_first };
    assert_non_null(s.config.type);
    model_command = s.bus.bus.command;
    model_wait = s.bus.bus.wait;
    s.bus.bus.command = watched_command;
    s.bus.bus.wait = watched_wait;
    const int err = panel_init(&s.panel, &s.config, &s.bus.bus, scratch, panel_scratch_bytes(&s.config, PIXELS));
    s.bus.bus.command = model_command;
    s.bus.bus.wait = model_wait;
    memset(want, 0, sizeof want);
    if (err != HAL_ERR_NONE)
        return case_wrong("%s: panel_init says %s", name, panel_strerror(err));
    if (s.lit_with_noise || !pm_lit(s.bus.model))
        return case_wrong("%s: the glass is %s", name, s.lit_with_noise ? "lit before it is black" : "dark");
    return check("set up");
}

static void close_scene(void)
{
    pm_free(s.bus.model);
}

/* ---- Rectangles ---------------------------------------------------------------------------------------- */

static uint32_t below(uint32_t *seed, uint32_t n)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (uint32_t)(((uint64_t)*seed * n) >> 32);
}

/* A random rectangle of random pixels, its rows apart or not. */
static int send_some(uint32_t *seed)
{
    const struct panel_grain grain = panel_grain(&s.panel.config);
    const uint32_t across = (uint32_t)(panel_width(&s.panel) / grain.x);
    const uint32_t down = (uint32_t)(panel_height(&s.panel) / grain.y);
    const uint32_t x = below(seed, across), y = below(seed, down);
    const uint32_t w = 1 + below(seed, across - x), h = 1 + below(seed, down - y);
    const struct panel_rect r = { (uint16_t)(x * grain.x), (uint16_t)(y * grain.y), (uint16_t)(w * grain.x),
                                  (uint16_t)(h * grain.y) };
    uint32_t stride = below(seed, 2) ? 2u * r.w + 2u * below(seed, 6) : 0;
    if (stride * r.h > sizeof px)
        stride = 0;
    const uint32_t step = stride ? stride : 2u * r.w;
    for (uint32_t row = 0; row < r.h; row++)
        for (uint32_t column = 0; column < r.w; column++) {
            const uint32_t v = below(seed, 65536);
            uint8_t *to = px + row * step + 2 * column;
            to[s.config.lsb_first ? 1 : 0] = (uint8_t)(v >> 8);
            to[s.config.lsb_first ? 0 : 1] = (uint8_t)v;
            wanted(want[(r.y + row) * panel_width(&s.panel) + r.x + column], v, r.x + column, r.y + row);
        }
    int err = panel_send(&s.panel, &r, px, stride);
    err = err ? err : panel_wait(&s.panel);
    return err ? case_wrong("a rectangle %u,%u %ux%u: %s", r.x, r.y, r.w, r.h, panel_strerror(err)) : 1;
}

static int rectangles(uint64_t number)
{
    char name[32];
    uint32_t seed = (uint32_t)number * 2654435761u;
    unsigned modules = 0;
    while (nth_module(modules, name))
        modules++;
    assert_true(nth_module((unsigned)(number % modules), name));
    const uint8_t rotate = (uint8_t)(number / modules % 4), inverted = (uint8_t)below(&seed, 2);
    const uint8_t bgr = panel_format(driver_of(name)) == PANEL_RGB565 ? (uint8_t)below(&seed, 2) : 0;
    int right = open_scene(name, rotate, inverted, bgr, (uint8_t)below(&seed, 2));
    for (int i = 0; right && i < 6; i++)
        right = send_some(&seed);
    right = right && check("rectangles");
    close_scene();
    return right;
}

/* ---- The other functions ------------------------------------------------------------------------------- */

/* Negative of what should be seen. */
static void negate(void)
{
    for (size_t i = 0; i < sizeof want; i++)
        (&want[0][0])[i] = (uint8_t)(255 - (&want[0][0])[i]);
}

/* The register that panel_brightness sets: SSD1351's master current is the fourth. */
static int level(void)
{
    return pm_light(s.bus.model).level[s.config.type == &panel_ssd1351 ? 3 : 0];
}

static int manners(uint64_t number)
{
    char name[32];
    uint32_t seed = (uint32_t)number;
    if (!nth_module((unsigned)number - 1, name))
        return case_wrong("there is no module %u", (unsigned)number);
    int right = open_scene(name, (uint8_t)(number % 4), 0, 0, 0) && send_some(&seed);
    const int light = level();
    right = right && panel_brightness(&s.panel, 40) == HAL_ERR_NONE;
    if (right && level() >= light)
        right = case_wrong("%s: brightness 40 is level %d, full was %d", name, level(), light);
    right = right && check("dimmed");
    if (right && panel_invert(&s.panel, 1) == HAL_ERR_NONE) {
        negate();
        right = check("inverted");
        (void)panel_invert(&s.panel, 0);
        negate();
    }
    if (right && (panel_sleep(&s.panel) != HAL_ERR_NONE || pm_lit(s.bus.model)))
        right = case_wrong("%s: not dark asleep", name);
    if (right && (panel_wake(&s.panel) != HAL_ERR_NONE || !pm_lit(s.bus.model)))
        right = case_wrong("%s: dark awake", name);
    right = right && check("awake");
    for (uint8_t rotate = 0; right && rotate < 4; rotate++) {
        right = panel_rotate(&s.panel, rotate) == HAL_ERR_NONE;
        memset(want, 0, sizeof want);
        right = right && check("turned") && send_some(&seed) && check("turned and sent");
    }
    close_scene();
    return right;
}

static void light_sleep_and_turning(void **state)
{
    char name[32];
    unsigned modules = 0;
    while (nth_module(modules, name))
        modules++;
    CASES(manners, modules);
}

/* The bus itself: what it must not let pass. */
static void cruel_bus(void **state)
{
    static _Alignas(4) uint8_t two[2] = { 0x12, 0x34 };
    assert_true(pm_glass_named(&s.glass, "st7789:240x240"));
    struct pm_model *m = pm_new(&s.glass);
    struct sim_panel_bus bus;
    sim_panel_bus_init(&bus, m);
    struct hal_bus *b = &bus.bus;
    assert_int_equal(b->command(b, 0x36, NULL, 1), HAL_ERR_ARG);
    assert_int_equal(b->data(b, NULL, 2), HAL_ERR_ARG);
    assert_int_equal(b->data(b, two, 0), HAL_ERR_ARG);
    assert_int_equal(b->data(b, two + 1, 1), HAL_ERR_ARG); /* odd address */
    assert_int_equal(b->wait(b), HAL_ERR_NONE);
    assert_int_equal(b->command(b, 0x2c, NULL, 0), HAL_ERR_NONE);
    assert_int_equal(b->data(b, two, 2), HAL_ERR_NONE);
    assert_int_equal(b->data(b, two, 2), HAL_ERR_STATE);
    assert_int_equal(b->command(b, 0x00, NULL, 0), HAL_ERR_STATE);
    assert_int_equal(b->reset(b), HAL_ERR_STATE);
    assert_int_equal(b->wait(b), HAL_ERR_NONE);
    assert_int_equal(b->data(b, two, 2), HAL_ERR_NONE);
    two[0] ^= 1;
    assert_int_equal(b->wait(b), HAL_ERR_CHANGED);
    assert_int_equal(b->wait(b), HAL_ERR_NONE);
    assert_int_equal(pm_counts(m)->data_bytes, 4);
    pm_free(m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASES_TEST(rectangles_are_where_they_belong, rectangles, 240),
        cmocka_unit_test(light_sleep_and_turning),
        cmocka_unit_test(cruel_bus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
