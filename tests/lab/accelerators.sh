#!/bin/sh
# What each accelerator is worth: instructions on QEMU's Cortex-M3 with all that a scene lists, with none, and with each
# one left out; and the flash that it takes by itself.
#
# Usage: tests/lab/accelerators.sh BUILD
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/accelerators
mkdir -p "$out"

# SHADER TEXEL LIST: flash of a program for the Cortex-M3 that draws with one shader, a texel format or none, and a list
flash_of() {
    texture=0
    [ -z "$2" ] || texture='&texture'
    {
        echo '#include "zs_fast.h"'
        [ -z "$2" ] || echo "const struct zs_texture texture = { .format = &zs_texel_$2 };"
        cat <<END
struct zs_renderer renderer;
ZS_ARENA(arena, ZS_ARENA_BYTES(240, 240, 24, 500, 500, 3, 1));
struct zs_camera camera;
struct zs_material material = { .shader = &zs_shade_$1, .texture = $texture };
struct zs_mesh mesh;
struct zs_instance instance = { .mesh = &mesh, .material = &material };
struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
struct zs_sink sink;
static const struct zs_fast *const fast[] = { $3, 0 };
int main(void)
{
    const struct zs_config config = { .width = 240, .height = 240, .strip_h = 24, .max_tris = 500, .max_verts = 500,
                                      .varyings = 3, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                      .depth = &zs_depth_float, .fast = fast };
    if (zs_init(&renderer, &config, arena, sizeof arena))
        return 1;
    return zs_render(&renderer, &scene, &camera, &sink);
}
END
    } >"$out/flash.c"
    # shellcheck disable=SC2086
    ${ARM}gcc -std=c11 -mcpu=cortex-m3 -mthumb $OPT -Ifirmware/zstrip "$out/flash.c" "$out"/flash/*.o -nostartfiles \
        -Wl,--gc-sections,-e,main -o "$out/flash.elf" && ${ARM}size "$out/flash.elf" | awk 'NR == 2 { print $1 + $2 }'
}
# NAME SHADER [TEXEL]: what zs_fast_NAME takes of it
fast_bytes() {
    with=$(flash_of "$2" "${3:-}" "&zs_fast_$1") && without=$(flash_of "$2" "${3:-}" 0) && echo $((with - without))
}
firmware() { # GOAL
    make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD=mps2 B="$top" NAME=bench_fast \
        APP_SRC=firmware/app/bench.c APP_FLAGS=-DBENCH_FAST=1 "$@"
}
firmware all >"$out/make.log" 2>&1 || { cat "$out/make.log"; bad "bench of accelerators" "does not build"; exit 1; }
firmware run >"$out/fast.csv" 2>"$out/fast.err"
cat "$out/fast.err" >>"$out/fast.csv"
none "frames with each accelerator left out" "$(grep -E '^# FAILED|error:' "$out/fast.csv" | tr ' ' '_')"
grep -q '^# ok' "$out/fast.csv" || bad "bench of accelerators ends" "see $out/fast.csv"
compile firmware/zstrip cortex-m3 "$out/flash" || bad "flash of accelerators" "the renderer does not compile"
while read -r name shader texel; do
    echo "$name $(fast_bytes "$name" "$shader" "$texel")"
done >"$out/flash.txt" <<END
batch flat
touch flat
tiles flat
clusters flat
edges flat
raw raw
flat flat
smooth smooth
texture texture 565
texture_flat texture_flat 565
texture_smooth texture_smooth 565
565 texture 565
pal8 texture pal8
pal4 texture pal4
END
none "flash of each accelerator" "$(awk 'NF != 2 || $2 <= 0' "$out/flash.txt" | tr ' ' '_')"
none "flash in zs_fast.h (bytes that it does not say)" "$(while read -r name bytes; do
    said=$(echo "$bytes" | sed 's/\([0-9]\)\([0-9][0-9][0-9]\)$/\1,\2/')
    tr -s '\n* ' ' ' <firmware/zstrip/zs_fast.h | grep -q " $said\( bytes\|,\| and\)" || echo "$name:$said"
done <"$out/flash.txt")"
echo "What each accelerator is worth on the Cortex-M3: instructions with all that the scene lists, times as many with"
echo "none, and times as many with one left out. Below 1: it costs more than it saves there. All rows have pools for"
echo "everything."
echo "flash: bytes that it takes there by itself, -O2, beside what it is for; what several share counts with each."
awk -F, '
    FILENAME ~ /flash.txt$/ { split($0, f, " "); name[++names] = f[1]; bytes[f[1]] = f[2]; next }
    NF != 17 || $1 == "scene" { next }
    !($1 in all) { scene[++n] = $1; all[$1] = 0 }
    $2 == "all" { all[$1] = $13; next }
    { times[$1, $2] = $13 / all[$1] }
    function short(text) { sub(/^texture_/, "tex_", text); return text }
    END {
        printf "%-16s %9s %6s", "scene", "all", "none"
        for (k = 1; k <= names; k++) printf " %*s", width(k), short(name[k])
        for (i = 1; i <= n; i++) {
            printf "\n%-16s %8.2fM %6.3f", scene[i], all[scene[i]] / 1e6, times[scene[i], "none"]
            for (k = 1; k <= names; k++)
                printf " %*s", width(k),
                    (scene[i], name[k]) in times ? sprintf("%.3f", times[scene[i], name[k]]) : "-" }
        printf "\n%-16s %9s %6s", "flash", "", ""
        for (k = 1; k <= names; k++) printf " %*d", width(k), bytes[name[k]]
        print "" }
    function width(k) { return length(short(name[k])) < 6 ? 6 : length(short(name[k])) }' "$out/flash.txt" \
        "$out/fast.csv"
exit $failed
