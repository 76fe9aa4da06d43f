#!/bin/sh
# The public headers are valid C++, and a C++ program links with the C library and draws.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

for h in firmware/zstrip/zstrip.h firmware/scenes/scenes.h hal/hal.h hal/panel/panel.h; do
    for std in c++11 c++14 c++20; do
        if g++ -x c++ -std=$std -Wall -Wextra -Werror -pedantic -fsyntax-only -Ifirmware/zstrip -Ihal "$h" \
            2>"$B/cxx.txt"; then
            ok "$(basename "$h") as $std"
        else
            bad "$(basename "$h") as $std" "$(grep -m1 error "$B/cxx.txt")"
        fi
    done
done

dir=$B/cplusplus
rm -rf "$dir"
mkdir -p "$dir"
for src in firmware/zstrip/*/*.c; do
    gcc -std=c11 -O1 -Ifirmware/zstrip -c "$src" -o "$dir/$(basename "$src" .c).o" || failed=1
done
cat >"$dir/main.cpp" <<'END'
#include "zstrip.h"

namespace {
constexpr uint32_t bytes = ZS_ARENA_BYTES(16, 16, 4, 8, 8, ZS_ATTRS_FLAT, 2);
ZS_ARENA(arena, bytes);
zs_renderer renderer;
const int16_t pos[4][3] = { { -9, -9, 0 }, { 9, -9, 0 }, { 9, 9, 0 }, { -9, 9, 0 } };
const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };

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
    zs_material material{};
    material.shader = &zs_shade_raw;
    material.rgb = { 255, 255, 255 };
    zs_instance instance{};
    instance.mesh = &mesh;
    instance.material = &material;
    zs_pose_identity(&instance.pose);
    zs_scene scene{};
    scene.instance = &instance;
    scene.n_instances = 1;
    scene.background = zs_rgb565(0, 0, 0);
    zs_camera camera{};
    const int32_t eye[3] = { 0, 0, 100 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    if (zs_camera_orthographic(&camera, 36, 1, 200) || zs_camera_look_at(&camera, eye, at, up))
        return 2;
    zs_config config{};
    config.width = config.height = 16;
    config.strip_h = 4;
    config.max_tris = config.max_verts = 8;
    config.attrs = ZS_ATTRS_FLAT;
    config.buffers = 2;
    config.subpixel_bits = 8;
    config.depth_bits = 16;
    config.depth = &zs_depth_linear;
    if (zs_init(&renderer, &config, arena, sizeof arena))
        return 3;
    uint32_t lit = 0;
    zs_sink sink{};
    sink.submit = count;
    sink.ctx = &lit;
    if (zs_render(&renderer, &scene, &camera, &sink))
        return 4;
    return lit == 2 * 8 * 8 ? 0 : 1; /* half the frame's width and height, two bytes a pixel */
}
END
if g++ -std=c++14 -Wall -Wextra -Werror -pedantic -Ifirmware/zstrip "$dir/main.cpp" "$dir"/*.o \
    -o "$dir/main" 2>"$B/cxx.txt"; then
    "$dir/main"
    status=$?
    if [ $status = 0 ]; then ok "C++ program draws"; else bad "C++ program draws" "exit $status"; fi
else
    bad "C++ program links" "$(grep -m1 -E 'error|undefined' "$B/cxx.txt")"
fi
exit $failed
