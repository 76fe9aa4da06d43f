#!/bin/sh
# The public headers, each alone in a file, and a program that uses their macros are clean C99 to C17 and C++11 to C++20 by gcc
# and clang; the library is C11. And such a program, C99 or C++11, links with the C library and draws.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

HEADERS='firmware/zstrip/zstrip.h firmware/zstrip/zs_fast.h firmware/zstrip/zs_shader.h firmware/zstrip/config.h firmware/zstrip/renderer.h firmware/scenes/scenes.h
         hal/hal.h hal/second.h hal/panel/panel.h'
INC='-Ifirmware/zstrip -Ifirmware/scenes -Ihal -Ihal/panel'
# Freestanding, because glibc's own headers make _Static_assert C99
STRICT='-ffreestanding -Wall -Wextra -Wpedantic -Wconversion -Wundef -Werror'
C="$STRICT -Wshadow -Wstrict-prototypes" # no -Wshadow in C++: a function is called as its struct, as in POSIX's stat
CXX="$STRICT -Wold-style-cast"

dir=$B/headers
rm -rf "$dir"
mkdir -p "$dir"

# ---- The programs: a square, half as wide and high as the frame ---------------------------------------------------

cat >"$dir/main.c" <<'END'
#include "zs_fast.h"
#include "zstrip.h"

ZS_ARENA(arena, ZS_ARENA_BYTES(16, 16, 4, 8, 8, ZS_VARYINGS_FLAT, 2));
static struct zs_renderer renderer;
static uint32_t memory[ZS_DAMAGE_WORDS(1, 16, 4)];
static uint64_t sums[ZS_STRIPS(16, 4)];
static struct zs_strip_hashes panel;
static const int16_t pos[4][3] = { { -9, -9, 0 }, { 9, -9, 0 }, { 9, 9, 0 }, { -9, 9, 0 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_material material = { .shader = &zs_shade_raw, .rgb = { 255, 255, 255 } };
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
    static const struct zs_config config = {
        .width = 16,
        .height = 16,
        .strip_h = 4,
        .max_tris = 8,
        .max_verts = 8,
        .varyings = ZS_VARYINGS_FLAT,
        .buffers = 2,
        .subpixel_bits = 8,
        .depth_bits = 16,
        .depth = &zs_depth_linear,
        .fast = fast,
    };
    static const int32_t eye[3] = { 0, 0, 100 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    uint32_t lit = 0;
    struct zs_sink sink = { count, 0, 0 };
    sink.ctx = &lit;
    mesh.pos = pos;
    mesh.tri = tri;
    mesh.n_verts = 4;
    mesh.n_tris = 2;
    mesh.scale = ZS_Q16_ONE;
    mesh.radius = 13;
    instance.mesh = &mesh;
    instance.material = &material;
    instance.depth_state = &state;
    zs_pose_identity(&instance.pose);
    scene.instance = &instance;
    scene.n_instances = 1;
    scene.background = zs_rgb565(0, 0, 0);
    if (zs_camera_orthographic(&camera, 36, 1, 200) || zs_camera_look_at(&camera, eye, at, up))
        return 2;
    if (ZS_WORLD_MAX > ZS_FAR_MAX || ZS_FOCAL_MIN > ZS_FOCAL_MAX || camera.height < ZS_HEIGHT_MIN ||
        instance.pose.rot[0] != ZS_Q30_ONE || zs_arena_bytes(&config) > sizeof arena)
        return 4;
    if (zs_init(&renderer, &config, arena, sizeof arena) || zs_strip_hashes_init(&panel, sums, 16, 16, 4, 1) || zs_damage_compare(&renderer, &panel) ||
        zs_damage_track(&renderer, memory, 1))
        return 5;
    if (zs_render(&renderer, &scene, &camera, &sink))
        return 6;
    return lit == 2 * 8 * 8 ? 0 : 1; /* two bytes a pixel */
}
END
cat >"$dir/main.cpp" <<'END'
#include "zs_fast.h"
#include "zstrip.h"

namespace {
constexpr uint32_t bytes = ZS_ARENA_BYTES(16, 16, 4, 8, 8, ZS_VARYINGS_FLAT, 2);
ZS_ARENA(arena, bytes);
zs_renderer renderer;
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
    mesh.scale = ZS_Q16_ONE;
    mesh.radius = 13;
    const zs_material material{ &zs_shade_raw, { 255, 255, 255 }, ZS_CULL_BACK, nullptr };
    zs_instance instance{ &mesh, &material, {}, &state };
    zs_pose_identity(&instance.pose);
    zs_scene scene{};
    scene.instance = &instance;
    scene.n_instances = 1;
    scene.background = zs_rgb565(0, 0, 0);
    zs_camera camera{};
    const int32_t eye[3] = { 0, 0, 100 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    if (zs_camera_orthographic(&camera, 36, 1, 200) || zs_camera_look_at(&camera, eye, at, up))
        return 2;
    if (camera.height < ZS_HEIGHT_MIN || instance.pose.rot[0] != ZS_Q30_ONE)
        return 4;
    const zs_config config{ 16, 16, 4, 8, 8, ZS_VARYINGS_FLAT, 2, 8, 16, &zs_depth_linear, fast };
    if (zs_init(&renderer, &config, arena, sizeof arena) || zs_strip_hashes_init(&panel, sums, 16, 16, 4, 1) || zs_damage_compare(&renderer, &panel) ||
        zs_damage_track(&renderer, memory, 1))
        return 5;
    uint32_t lit = 0;
    const zs_sink sink{ count, nullptr, &lit };
    if (zs_render(&renderer, &scene, &camera, &sink))
        return 6;
    return lit == 2 * 8 * 8 ? 0 : 1; /* two bytes a pixel */
}
END

# ---- Every dialect ------------------------------------------------------------------------------------------------

# A line of what is wrong with a compiler's words, or nothing
first_error() {
    grep -m1 -E 'error|undefined' "$B/headers.txt" || head -n 1 "$B/headers.txt"
}
# COMPILER STD SUFFIX FLAGS: each file by itself; the compiler takes them all at once
clean() {
    for none in 0 1; do
        # shellcheck disable=SC2086
        "$1" -std="$2" $4 -DZS_NO_FAST=$none $INC -fsyntax-only "$dir"/*."$3" 2>"$B/headers.txt" || {
            bad "headers as $2 by $1, ZS_NO_FAST=$none" "$(first_error)"
            return
        }
    done
    ok "headers as $2 by $1"
}
for h in $HEADERS; do
    name=$(basename "$h")
    # twice, and a declaration, because config.h has none and C asks for one
    printf '#include "%s"\n' "$name" "$name" | sed '$a extern int declared;' | tee "$dir/only_${name%.h}.c" >"$dir/only_${name%.h}.cpp"
done
for compiler in gcc clang; do
    for std in c99 c11 c17; do clean $compiler $std c "$C"; done
done
for compiler in g++ clang++; do
    for std in c++11 c++14 c++17 c++20; do clean $compiler $std cpp "$CXX"; done
done

# ---- Linked -------------------------------------------------------------------------------------------------------

# NAME COMPILER...
draws() {
    name=$1
    shift
    if "$@" -Ifirmware/zstrip "${B%/checks}/libcore.a" -o "$dir/main" 2>"$B/headers.txt"; then
        "$dir/main"
        status=$?
        if [ $status = 0 ]; then ok "$name program draws"; else bad "$name program draws" "exit $status"; fi
    else
        bad "$name program links" "$(first_error)"
    fi
}
draws C99 gcc -std=c99 "$dir/main.c"
draws C++11 g++ -std=c++11 "$dir/main.cpp"
exit $failed
