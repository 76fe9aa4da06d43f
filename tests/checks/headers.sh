#!/bin/sh
# The public headers, all in a file, and a program that uses their macros are clean C99 to C17 and C++11 to C++20 by gcc
# and clang. So is each header alone in the oldest and the newest of these dialects: what it says in one between them,
# it says in one of the two. What their comments show is C++20. The library is C11. And such a program, C99 or C++11,
# links with the C library and draws. One that was compiled with another ZS_VARYINGS_MAX or ZS_SIZE_MAX than the library
# is refused by zs_init.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

HEADERS="$(echo firmware/zstrip/*.h) firmware/scenes/scenes.h hal/hal.h hal/second.h hal/panel/panel.h"
INC='-Ifirmware/zstrip -Ifirmware/scenes -Ihal -Ihal/panel'
# Freestanding, because glibc's own headers make _Static_assert C99
STRICT='-ffreestanding -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wundef -Werror'
C="$STRICT -Wshadow -Wstrict-prototypes" # no -Wshadow in C++: a function is called as its struct, as in POSIX's stat
CXX="$STRICT -Wold-style-cast"

dir=$B/headers
rm -rf "$dir"
mkdir -p "$dir"

# ---- The programs: a square, half as wide and high as the frame ---------------------------------------------------

cat >"$dir/main.c" <<'END'
#include "zs_damage.h"
#include "zs_fast.h"
#include "zstrip.h"

ZS_RENDERER_BUFFERS(screen, 16, 16, 4, 8, 8, ZS_VARYINGS_FLAT, 2);
ZS_RENDERER(other, 16, 16, 4, 8, 8, ZS_VARYINGS_FLAT); /* at file scope, more than one */
ZS_RENDERER_NO_DEPTH(bare, 16, 16, 4, 8, 8, ZS_VARYINGS_FLAT);
static uint32_t memory[ZS_DAMAGE_WORDS(1, 16, 4)];
static uint64_t sums[ZS_STRIPS(16, 4)];
static struct zs_strip_hashes panel;
static const int16_t pos[4][3] = { { -9, -9, 0 }, { 9, -9, 0 }, { 9, 9, 0 }, { -9, 9, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_material material = { .shader = &zs_shade_raw, .rgb = ZS_RGB(0xffffff) };
static const zs_turn angle[3] = { ZS_DEGREES(45), ZS_DEGREES(-22.5), ZS_DEGREES(360u) };
static const int16_t pitch[2] = { ZS_PITCH(-15), ZS_PITCH(22.5) };
static const uint16_t navy = ZS_RGB565(0x000080);
extern char constant[ZS_DEGREES(90) == 16384 && ZS_RGB565(0xffffff) == 65535 && ZS_VERSION > 0 ? 1 : -1];
static const struct zs_depth_state state = { .func = ZS_DEPTH_LESS_EQUAL, .bias = -4 };
static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_RAW, ZS_FAST_END };
static struct zs_mesh mesh;
static struct zs_instance instance;
static struct zs_scene scene;
static struct zs_camera camera;

static int count(void *ctx, const struct zs_strip *strip)
{
    uint32_t *lit = ctx, i;
    for (i = 0; i < strip->n_bytes; i++)
        *lit += strip->px[i] == 0xff;
    return 0;
}

int main(void)
{
    static const int32_t eye[3] = { 0, 0, 100 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    uint32_t lit = 0;
    struct zs_sink sink = { .submit = count };
    sink.ctx = &lit;
    screen_config.depth = &zs_depth_linear;
    screen_config.fast = fast;
    other_config.depth = &zs_depth_linear;
    if (angle[0] != 8192 || angle[1] != 61440 || angle[2] != 0 || pitch[0] != -2731 || pitch[1] != 4096 ||
        navy != zs_rgb565(0, 0, 128))
        return 3;
    if (ZS_INIT(other) || ZS_INIT(bare) || ZS_INIT(screen))
        return ZS_INIT(screen) == ZS_ERR_BUILD ? 7 : 5;
    mesh.pos = pos;
    mesh.tri = tri;
    mesh.n_verts = 4;
    mesh.n_tris = 2;
    mesh.radius = 13;
    instance.mesh = &mesh;
    instance.material = &material;
    instance.depth_state = &state;
    scene.instance = &instance;
    scene.n_instances = 1;
    scene.background = zs_rgb565(0, 0, 0);
    if (zs_camera_orthographic(&camera, 36, 1, 200) || zs_camera_look_at(&camera, eye, at, up))
        return 2;
    if (ZS_WORLD_MAX > ZS_FAR_MAX || ZS_FOCAL_MIN > ZS_FOCAL_MAX || camera.height < ZS_HEIGHT_MIN ||
        zs_arena_bytes(&screen_config) != sizeof screen_arena)
        return 4;
    if (zs_strip_hashes_init(&panel, sums, 16, 16, 4, 1) || zs_damage_compare(&screen, &panel) ||
        zs_damage_track(&screen, memory, 1))
        return 5;
    if (zs_render(&screen, &scene, &camera, &sink))
        return 6;
    return lit == 2 * 8 * 8 ? 0 : 1; /* two bytes a pixel */
}
END
cat >"$dir/main.cpp" <<'END'
#include "zs_damage.h"
#include "zs_fast.h"
#include "zstrip.h"

ZS_RENDERER(other, 16, 16, 4, 8, 8, ZS_VARYINGS_FLAT); // at file scope, more than one
ZS_RENDERER_NO_DEPTH(bare, 16, 16, 4, 8, 8, ZS_VARYINGS_FLAT);
namespace {
ZS_RENDERER_BUFFERS(screen, 16, 16, 4, 8, 8, ZS_VARYINGS_FLAT, 2);
uint32_t memory[ZS_DAMAGE_WORDS(1, 16, 4)];
uint64_t sums[ZS_STRIPS(16, 4)];
zs_strip_hashes panel;
const int16_t pos[4][3] = { { -9, -9, 0 }, { 9, -9, 0 }, { 9, 9, 0 }, { -9, 9, 0 } };
const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
const zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_RAW, ZS_FAST_END };
zs_depth_state make_state()
{
    zs_depth_state s = zs_depth_state();
    s.func = ZS_DEPTH_LESS_EQUAL;
    s.bias = -4;
    return s;
}
const zs_depth_state state = make_state();
static_assert(ZS_WORLD_MAX < ZS_FAR_MAX && ZS_FOCAL_MIN < ZS_FOCAL_MAX, "limits are constants");
constexpr zs_turn angle[3] = { ZS_DEGREES(45), ZS_DEGREES(-22.5), ZS_DEGREES(360u) };
static_assert(ZS_PITCH(-15) == -2731 && ZS_PITCH(22.5) == 4096, "signed angles are constants");
static_assert(angle[0] == 8192 && angle[1] == 61440 && angle[2] == 0, "angles are constants");
static_assert(ZS_RGB565(0xffffff) == 65535 && ZS_VERSION > 0, "colours are constants");
constexpr zs_rgb white = ZS_RGB(0xffffff);

int count(void *ctx, const zs_strip *strip)
{
    for (uint32_t i = 0; i < strip->n_bytes; i++)
        *static_cast<uint32_t *>(ctx) += strip->px[i] == 0xff;
    return 0;
}
}

int main()
{
    zs_mesh mesh{};
    mesh.pos = pos;
    mesh.tri = tri;
    mesh.n_verts = 4;
    mesh.n_tris = 2;
    mesh.radius = 13;
    const zs_material material{ &zs_shade_raw, white, ZS_CULL_BACK, nullptr, nullptr };
    const zs_instance instance{ &mesh, &material, {}, &state };
    zs_scene scene{};
    scene.instance = &instance;
    scene.n_instances = 1;
    scene.background = zs_rgb565(0, 0, 0);
    zs_camera camera{};
    const int32_t eye[3] = { 0, 0, 100 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    if (zs_camera_orthographic(&camera, 36, 1, 200) || zs_camera_look_at(&camera, eye, at, up))
        return 2;
    if (camera.height < ZS_HEIGHT_MIN || zs_arena_bytes(&screen_config) != sizeof screen_arena)
        return 4;
    screen_config.depth = other_config.depth = &zs_depth_linear;
    screen_config.fast = fast;
    if (ZS_INIT(other) || ZS_INIT(bare) || ZS_INIT(screen))
        return ZS_INIT(screen) == ZS_ERR_BUILD ? 7 : 5;
    if (zs_strip_hashes_init(&panel, sums, 16, 16, 4, 1) || zs_damage_compare(&screen, &panel) ||
        zs_damage_track(&screen, memory, 1))
        return 5;
    uint32_t lit = 0;
    zs_sink sink{};
    sink.submit = count;
    sink.ctx = &lit;
    if (zs_render(&screen, &scene, &camera, &sink))
        return 6;
    return lit == 2 * 8 * 8 ? 0 : 1; /* two bytes a pixel */
}
END

# ---- Every dialect ------------------------------------------------------------------------------------------------

# A line of what is wrong with a compiler's words, or nothing
first_error() {
    grep -m1 -E 'error|undefined' "$B/headers.txt" || head -n 1 "$B/headers.txt"
}
# COMPILER STD FLAGS FILE...: each file by itself, to an assembler's text, which ccache keeps (tests/lib/ccache.sh);
# with ZS_NO_FAST=1, too, where a header that the compiler has read for it asks for that
asks=$(grep -lw ZS_NO_FAST firmware/zstrip/*.h firmware/zstrip/*/*.h | grep -v '/zs_config\.h$') # defines it, otherwise
asked() {
    while read -r line; do
        for header in $asks; do
            case $line in *"$header"*) return 0 ;; esac
        done
    done <"$dir/clean.d"
    return 1
}
clean() {
    compiler=$1 std=$2 flags=$3 n=0
    shift 3
    for file in "$@"; do
        for none in 0 1; do
            [ $none = 0 ] || asked || continue
            # shellcheck disable=SC2086
            $compiler -std=$std $flags -DZS_NO_FAST=$none $INC -MMD -S "$file" -o "$dir/clean.s" \
                2>"$B/headers.txt" || {
                bad "headers as $std by $compiler, ZS_NO_FAST=$none" "$(first_error)"
                return
            }
            n=$((n + none))
        done
    done
    if [ $n -gt 0 ]; then ok "headers as $std by $compiler"
    else bad "headers as $std by $compiler" "none asks for ZS_NO_FAST"; fi
}
for h in $HEADERS; do
    name=${h##*/}
    # twice, and a declaration, because zs_config.h has none and C asks for one
    for to in c cpp; do
        printf '#include "%s"\n#include "%s"\nextern int declared;\n' "$name" "$name" >"$dir/only_${name%.h}.$to"
    done
done
cat "$dir"/only_*.c | tee "$dir/all.c" >"$dir/all.cpp"
for compiler in gcc clang; do
    for std in c99 c17; do clean $compiler $std "$C" "$dir"/*.c; done
    clean $compiler c11 "$C" "$dir/all.c" "$dir/main.c"
done
for compiler in g++ clang++; do
    for std in c++11 c++20; do clean $compiler $std "$CXX" "$dir"/*.cpp; done
    for std in c++14 c++17; do clean $compiler $std "$CXX" "$dir/all.cpp" "$dir/main.cpp"; done
done

# ---- What the headers show ----------------------------------------------------------------------------------------

# C++ wants initialisers in the order of the fields, also where a macro sets some of them
cat >"$dir/shown.txt" <<'END'
#include "panel.h"
#include "zs_blend.h"
#include "zs_damage.h"
#include "zs_dither.h"
#include "zs_environment.h"
#include "zs_fog.h"
#include "zs_lights.h"
#include "zs_lines.h"
#include "zs_overlay.h"
#include "zs_shadow.h"
#include "zstrip.h"

namespace {
void vertex(const zs_shading *, uint32_t, uint16_t *out) { out[0] = out[1] = 0; }
uint16_t face(const zs_shading *, uint32_t t) { return static_cast<uint16_t>(t); }
void fragment(const zs_instance *, zs_fragment *f) { *f->color = f->paint; }
void position(const zs_shading *s, uint32_t v, int16_t out[3]) { out[0] = s->instance->mesh->pos[v][0]; }
int check(const zs_instance *, const zs_config *) { return ZS_OK; }
int send(void *, const zs_strip *) { return 0; }
}

extern const zs_shader plain, layer, tint, waves, everything;
const zs_shader plain = { .vertex = vertex, .fragment = fragment, ZS_FRAGMENTS, .n_varyings = 2 };
const zs_shader layer = { .vertex = vertex, .fragment = fragment, ZS_FRAGMENTS, .n_varyings = 2, ZS_LAYER };
const zs_shader tint = { .fragment = fragment, ZS_FRAGMENTS, ZS_LAYER };
const zs_shader waves = { .fragment = fragment, ZS_FRAGMENTS, .opaque = 1, .position = position, ZS_POSITIONS };
const zs_shader everything = { .vertex = vertex, .face = face, .fragment = fragment, ZS_FRAGMENTS, .n_varyings = 2,
                               .opaque = 0, ZS_LAYER, .check = check, .position = position, ZS_POSITIONS };

extern const zs_blend glass;
const zs_blend glass = { .material = { .shader = &zs_blend_flat, .rgb = ZS_RGB(0x40a0ff) }, .alpha = 96 };
extern const zs_lines wire;
const uint16_t pair[2][2] = { { 0, 1 }, { 1, 2 } };
const zs_lines wire = { ZS_LINES(pair, 2), .width = 1 };
extern const zs_material ink;
const zs_material ink = { .shader = &zs_shade_plain, .rgb = ZS_RGB(0xffffff), .primitive = &wire.primitive };
extern const zs_dither to_grey;
const zs_dither to_grey = { .format = &zs_dither_grey4, .pattern = &zs_dither_blue };
extern zs_fog fog;
zs_fog fog = { .color = ZS_RGB565(0x8090a0), .start = 2000, .end = 9000 };
extern const zs_resolve hook[2];
const zs_resolve hook[2] = { { .draw = zs_fog_draw, .changes = zs_fog_changes, .ctx = &fog } };
extern const zs_lit_material red;
zs_shine gloss;
const zs_lamp lamp[2] = { { .dir = { 0, ZS_Q30_ONE, 0 } },
                          { .kind = ZS_LAMP_POINT, .rgb = ZS_RGB(0xff8000), .pos = { 0, 50, 90 }, .range = 300 } };
const zs_lighting lights = { .lamp = lamp, .n_lamps = 2, .ambient = ZS_RGB(0x303030) };
const zs_lit_material red = { .material = { .shader = &zs_shade_lit, .rgb = ZS_RGB(0xc02010) },
                              .lighting = &lights, .shine = &gloss, .specular = ZS_RGB(0xffffff) };
extern zs_overlay overlay;
zs_item items[] = {
    { .kind = &zs_item_fill, .x = 4, .y = 4, .w = 60, .h = 12, .color = 0, .clear = 128 },
    { .kind = &zs_item_text, .x = 6, .y = 6, .color = 0xffff, .text = "21 \xc2\xb0" "C" } };
uint32_t memory[ZS_OVERLAY_WORDS(2)];
zs_overlay overlay = { .item = items, .n = 2, .memory = memory, .room = 2 };
extern const zs_scene scene;
const zs_mesh mesh = {};
const zs_instance thing = { .mesh = &mesh, .material = &ink };
const zs_scene scene = { .instance = &thing, .n_instances = 1 };
extern const zs_pass pass[3];
zs_camera camera;
zs_mirror mirror;
const zs_pass pass[3] = { { .scene = &scene, .camera = &camera },
                          { .scene = &scene, .camera = &camera, .viewport = { 80, 0, 80, 30 } },
                          { .scene = &scene, .camera = &camera, .mirror = &mirror, .mask = &zs_mask_window } };
extern const zs_sink sink;
const zs_sink sink = { .submit = send };
extern const panel_config config;
const panel_config config = { .type = &panel_st7789, .width = 240, .height = 240, .rotate = 1, .invert = 1 };
END
for compiler in g++ clang++; do
    # shellcheck disable=SC2086
    if $compiler -std=c++20 $CXX -Wno-missing-field-initializers $INC -x c++ -MMD -S "$dir/shown.txt" \
        -o "$dir/clean.s" 2>"$B/headers.txt"; then
        ok "initialisers of the headers' comments as c++20 by $compiler"
    else
        bad "initialisers of the headers' comments as c++20 by $compiler" "$(first_error)"
    fi
done

# ---- Linked -------------------------------------------------------------------------------------------------------

# NAME EXIT COMPILER...: what the program ends with, 0 where it draws
ends() {
    name=$1 want=$2
    shift 2
    if "$@" -Ifirmware/zstrip -MMD -o "$dir/main.o" 2>"$B/headers.txt" &&
        "$1" "$dir/main.o" "$top/libcore.a" -o "$dir/main" 2>"$B/headers.txt"; then
        "$dir/main"
        status=$?
        if [ $status = "$want" ]; then ok "$name"; else bad "$name" "exit $status, not $want"; fi
    else
        bad "$name program links" "$(first_error)"
    fi
}
ends "C99 program draws" 0 gcc -std=c99 -c "$dir/main.c"
ends "C++11 program draws" 0 g++ -std=c++11 -c "$dir/main.cpp"
# ZS_ERR_BUILD
ends "C99 program with fewer varyings than the library is refused" 7 gcc -std=c99 -DZS_VARYINGS_MAX=2 -c "$dir/main.c"
ends "C++11 program with more varyings than the library is refused" 7 \
    g++ -std=c++11 -DZS_VARYINGS_MAX=8 -c "$dir/main.cpp"
ends "C99 program with larger frames than the library is refused" 7 gcc -std=c99 -DZS_SIZE_MAX=8000 -c "$dir/main.c"

# ZS_DEGREES of a variable would be floating point at run time
printf '#include "zstrip.h"\nzs_turn turn(int x);\nzs_turn turn(int x)\n{\n    return ZS_DEGREES(x);\n}\n' \
    >"$dir/variable.c"
sed 's/(x)/(30)/' "$dir/variable.c" >"$dir/fixed.c"
for compiler in gcc clang g++ clang++; do
    flags='-O2 -Wpedantic -Werror'
    case $compiler in *++) flags="$flags -x c++ -std=c++11" ;; *) flags="$flags -std=c99" ;; esac
    # shellcheck disable=SC2086
    if $compiler $flags -Ifirmware/zstrip -MMD -c "$dir/fixed.c" -o "$dir/fixed.o" 2>"$B/headers.txt" &&
        ! $compiler $flags -Ifirmware/zstrip -c "$dir/variable.c" -o /dev/null 2>"$B/headers.txt"; then
        ok "ZS_DEGREES takes constants alone, $compiler"
    else
        bad "ZS_DEGREES takes constants alone, $compiler" "$(first_error)"
    fi
done

# A camera that stays as it was, because near was 0 and nobody looked: the compiler says which function
printf '#include "zstrip.h"\nvoid near_0(struct zs_camera *c);\nvoid near_0(struct zs_camera *c)\n{\n    %s\n}\n' \
    'zs_camera_perspective(c, 8192, 240, 0, 100);' >"$dir/not_looked.c"
sed 's/zs_camera_p/(void)zs_camera_p/' "$dir/not_looked.c" >"$dir/looked.c"
for compiler in 'gcc -std=c2x' 'clang -std=c2x' 'g++ -x c++ -std=c++17' 'clang++ -x c++ -std=c++17'; do
    if $compiler -Werror -Ifirmware/zstrip -MMD -c "$dir/looked.c" -o "$dir/looked.o" 2>"$B/headers.txt" &&
        ! $compiler -Werror -Ifirmware/zstrip -c "$dir/not_looked.c" -o /dev/null 2>"$B/headers.txt" &&
        grep -q zs_camera_perspective "$B/headers.txt"; then
        ok "an error that is not looked at is a warning, $compiler"
    else
        bad "an error that is not looked at is a warning, $compiler" "$(first_error)"
    fi
done

# Eight varyings: a library that is compiled for them interpolates all alike, whole and cut at the near plane.
cat >"$dir/eight.c" <<'END'
#include "zs_shader.h"

static unsigned seen, wrong;

static void vertex(const struct zs_shading *s, uint32_t v, uint16_t *out)
{
    const int16_t *p = s->instance->mesh->pos[v];
    for (int k = 0; k < 8; k++)
        out[k] = (uint16_t)(20000 + p[k % 3 % 2] * (100 + 50 * (k % 3)));
}
static void fragment(const struct zs_instance *instance, struct zs_fragment *f)
{
    (void)instance;
    seen++;
    for (int k = 3; k < 8; k++)
        wrong += f->v[k] != f->v[k % 3];
}
static const struct zs_shader shader = { .vertex = vertex, .fragment = fragment, ZS_FRAGMENTS, .n_varyings = 8 };
ZS_RENDERER(screen, 64, 48, 8, 40, 40, 8);
static const int16_t pos[4][3] = { { -30, -40, 60 }, { 35, -40, 70 }, { 45, 35, -70 }, { -35, 40, -90 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh mesh = { .pos = pos, .tri = tri, .n_verts = 4, .n_tris = 2, .radius = 120 };
static const struct zs_material material = { .shader = &shader, .cull = ZS_CULL_NONE };
static int take(void *ctx, const struct zs_strip *strip)
{
    (void)ctx, (void)strip;
    return 0;
}
int main(void)
{
    const struct zs_instance instance = { .mesh = &mesh, .material = &material };
    const struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
    const struct zs_sink sink = { .submit = take };
    struct zs_camera camera;
    const int32_t at[3] = { 0, 0, 0 };
    screen_config.depth = &zs_depth_recip;
    int err = zs_camera_perspective(&camera, ZS_DEGREES(60), 48, 40, 400);
    for (int32_t away = 70; away < 200 && !err; away += 30) {
        err = zs_camera_orbit(&camera, at, away, ZS_DEGREES(20), ZS_DEGREES(15));
        err = err ? err : ZS_INIT(screen);
        err = err ? err : zs_render(&screen, &scene, &camera, &sink);
        err = err ? err : zs_frame_stats(&screen)->tris_clipped == 0 && away == 70 ? 99 : 0;
    }
    return err ? 1 : wrong ? 2 : seen < 4000 ? 3 : 0;
}
END
# The library's objects are those of the checksum program, where it is there and not older: made of the same options
. tests/lib/checksum_core.sh
eight() { # SOURCE OBJECT
    gcc -std=c11 -DZS_VARYINGS_MAX=8 -Ifirmware/zstrip -MMD -c "$1" -o "$2" 2>"$B/headers.txt"
}
core_eight() {
    objects=$top/test/checksum-gcc-O0.o
    [ -z "$(checksum_core "$top" gcc-O0)" ] || return 0
    objects=$dir/eight.o
    mkdir -p "$objects"
    for source in firmware/zstrip/*/*.c; do
        object=${source##*/zstrip/}
        eight "$source" "$objects/firmware-${object%%/*}-${object##*/}.o" || return 1
    done
}
if core_eight && eight "$dir/eight.c" "$dir/only_eight.o" &&
    gcc "$dir/only_eight.o" "$objects"/firmware-*.o -o "$dir/eight" 2>"$B/headers.txt"; then
    "$dir/eight"
    status=$?
    if [ $status = 0 ]; then
        ok "eight varyings are interpolated alike"
    else
        bad "eight varyings are interpolated alike" "exit $status"
    fi
else
    bad "a library with eight varyings compiles" "$(first_error)"
fi
if gcc -std=c11 -DZS_VARYINGS_MAX=9 -Ifirmware/zstrip -c firmware/zstrip/core/frame.c -o /dev/null 2>/dev/null; then
    bad "nine varyings are refused by the compiler" "they are not"
else
    ok "nine varyings are refused by the compiler"
fi
exit $failed
