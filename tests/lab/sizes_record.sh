#!/bin/sh
# What zsim budget cannot ask the host: sizes of structs on a Cortex-M, flash by what is linked, worst-case stacks, as
# sim/budget/record_sizes.h. Programs name the accelerators of the frame, of their shaders and of their texels.
#
# Usage: tests/lab/sizes_record.sh BUILD           the header on standard output
#        tests/lab/sizes_record.sh BUILD structs   sizes of structs alone: lines "name bytes"
#        tests/lab/sizes_record.sh BUILD flash CPU DEPTH MASK   of one program: "bytes library"
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

work=$top/costs
mkdir -p "$work"
SHADES="raw flat smooth texture texture_flat texture_smooth" # bits of MASK, from 1
DEPTHS="float recip linear"
TEXELS="565 pal8 pal4"
PANELS="st7789 ili9341 gc9a01 ssd1351 ssd0323 ssd1306"

# CPU DEPTH MASK [STATEMENTS [DECLARATIONS [ACCELERATORS]]]: "bytes library"
flash() {
    one=$work/flash-$1-$2-$3
    materials='' fast="ZS_FAST_FRAME,${6:-}"
    n=1
    for s in $SHADES; do
        [ $(($3 & n)) -eq 0 ] || materials="$materials { .shader = &zs_shade_$s }," fast="$fast &zs_fast_$s,"
        n=$((n * 2))
    done
    LIST=$fast minimal "$one.c" raw "$2" "extern struct zs_material other[]; material = other[anything[4]]; ${4:-}"
    sed -i '/^struct zs_material material = /s/.*/struct zs_material material;/' "$one.c"
    echo "struct zs_material other[] = {$materials }; ${5:-}" >>"$one.c"
    link "$1" "$work/core-$1" "$one.c" "$one.elf" -Wl,-Map,"$one.map" || exit 1
    echo "$(taken "$one.map" "$work/core-$1/") $(taken "$one.map" 'lib(gcc|c|c_nano)\\.a')"
    rm -f "$one.c" "$one.elf" "$one.map"
}
if [ "${2:-}" = flash ]; then
    echo "$3 $4 $5 $(flash "$3" "$4" "$5")"
    exit
fi

structs() {
    cat >"$work/structs.c" <<'END'
#include "panel.h"
#include "zstrip.h"
#define SIZE(type) char size_of_##type[sizeof(struct type)];
SIZE(zs_renderer) SIZE(zs_scene) SIZE(zs_camera) SIZE(zs_config) SIZE(zs_instance) SIZE(zs_mesh)
SIZE(zs_material) SIZE(zs_texture) SIZE(panel)
END
    ${ARM}gcc -std=c11 -mcpu="${1:-cortex-m3}" -mthumb -fno-common -Ifirmware/zstrip -Ihal -Ihal/panel \
        -c "$work/structs.c" -o "$work/structs.o" || exit 1
    ${ARM}nm --plugin= -S "$work/structs.o" | while read -r at size kind name; do
        echo "${name#size_of_} $((0x$size))"
    done
}
if [ "${2:-}" = structs ]; then
    structs "${3:-cortex-m3}"
    exit
fi

for c in $CPUS; do
    core "$c" "$work/core-$c" && panels "$c" "$work/panels-$c" || exit 1
done
for c in $CPUS; do for d in $DEPTHS; do for m in $(seq 1 63); do
    echo "$top flash $c $d $m"
done; done; done | xargs -P "$(nproc)" -L 1 sh "$0" >"$work/flash.txt" || exit 1

cat <<'END'
/* Sizes of structs on a Cortex-M, flash by what is linked and worst-case stacks, bytes: what zsim budget cannot ask the
 * host. Recorded by make costs-record.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RECORD_SIZES_H
#define SIM_RECORD_SIZES_H

enum { RECORD_M0, RECORD_M3, RECORD_CPUS }; /* Armv6-M, Armv7-M; -O2 */

/* Of one. */
END
structs | while read -r name bytes; do echo "#define RECORD_$name ${bytes}u"; done
cat <<'END'

struct record_bytes {
    unsigned zstrip, library; /* of the renderer; of libgcc and the C library */
};

/* [CPU][float, recip, linear][shaders: 1 raw, 2 flat, 4 smooth, 8 texture, 16 texture_flat, 32 texture_smooth], without
 * texel formats */
static const struct record_bytes record_flash[RECORD_CPUS][3][64] = {
END
for c in $CPUS; do
    echo "    {"
    for d in $DEPTHS; do
        echo "        { { 0, 0 },"
        awk -v c="$c" -v d="$d" '$1 == c && $2 == d { at[$3] = "{ " $4 ", " $5 " }" }
            END { for (m = 1; m < 64; m++)
                printf "%s%s%s", m % 6 == 1 ? "          " : " ", at[m], m == 63 ? "\n" : m % 6 ? "," : ",\n" }' \
            "$work/flash.txt"
        echo "        },"
    done
    echo "    },"
done
echo "};"
awk '$1 == "cortex-m3" && ($2 " " $3 == "float 2" || $2 " " $3 == "recip 63") {
    print "/* of which " $2 " " $3 " is " $4 " */" }' "$work/flash.txt"
echo
more() { # NAME STATEMENTS DECLARATIONS [ACCELERATORS]: what a program with all shaders and depth float takes more
    for c in $CPUS; do
        # shellcheck disable=SC2046
        set -- "$1" "$2" "$3" "${4:-}" $(flash "$c" float 63 "$2" "$3" "${4:-}") \
            $(awk -v c="$c" '$1 == c && $2 == "float" && $3 == 63 { print $4, $5 }' "$work/flash.txt")
        printf '%s %s\n' $(($5 - $7)) $(($6 - $8))
    done | awk '{ printf "%s{ %d, %d }", n++ ? ", " : "", $1 < 0 ? 0 : $1, $2 < 0 ? 0 : $2 }'
}
for x in $TEXELS; do
    echo "static const struct record_bytes record_texel_$x[RECORD_CPUS] = { $(more texel \
        'extern struct zs_texture texture; material.texture = &texture;' \
        "struct zs_texture texture = { .format = &zs_texel_$x };" " &zs_fast_$x,") };"
done
echo "static const struct record_bytes record_state[RECORD_CPUS] = { $(more state \
    'extern const struct zs_depth_state state; instance.depth_state = &state;' \
    'const struct zs_depth_state state = { .func = ZS_DEPTH_LESS_EQUAL, .read_only = 1, .bias = 2,
        .slope_bias = 3 };') };"
echo "static const struct record_bytes record_watch[RECORD_CPUS] = { $(more watch \
    'static struct zs_strip_hashes sums; (void)zs_strip_hashes_init(&sums, (uint64_t *)anything, 240, 240, 24, 1);
     (void)zs_damage_compare(&renderer, &sums);' '') };"
echo "static const struct record_bytes record_track[RECORD_CPUS] = { $(more track \
    '(void)zs_damage_track(&renderer, anything, 1);' '') };"
echo "/* Clusters' accelerator, which the list of every converted model has. */"
echo "static const struct record_bytes record_clusters[RECORD_CPUS] = { $(more clusters '' '' ' ZS_FAST_CLUSTERS,') };"
echo "/* Poses turned, a camera that looks at a point. */"
echo "static const struct record_bytes record_pose[RECORD_CPUS] = { $(more pose \
    'zs_pose_turn(&instance.pose, 1, 2, 3); (void)zs_camera_orbit(&camera, (int32_t *)anything, 10, 20, 30);
     (void)zs_camera_perspective(&camera, 8192, 240, 1, 100);' '') };"
echo
echo "/* Drivers of panels, panel.c included. */"
echo "static const struct {"
echo "    const char *name;"
echo "    unsigned bytes[RECORD_CPUS];"
echo "} record_panels[] = {"
for p in $PANELS; do
    case $p in
    ssd1351) size="128 128" ;;
    ssd0323 | ssd1306) size="128 64" ;;
    ili9341) size="240 320" ;;
    *) size="240 240" ;;
    esac
    line=''
    for c in $CPUS; do
        # shellcheck disable=SC2086
        minimal_panel "$work/panel.c" $p $size
        link "$c" "$work/panels-$c" "$work/panel.c" "$work/panel.elf" -Wl,-Map,"$work/panel.map" || exit 1
        line="$line${line:+, }$(taken "$work/panel.map" "$work/panels-$c/")"
    done
    echo "    { \"$p\", { $line } },"
done
echo "};"
echo
sh tests/checks/stack.sh "$top" >"$work/stack.txt" 2>&1
echo "/* zs_render with everything linked, without what the sink takes on top; any function of a panel, without its" \
    "bus. */"
for part in '' 'panels, '; do
    line=''
    for c in $CPUS; do
        n=$(sed -n "s/^ok $part$c stack within [0-9]* bytes: [a-z_]* \([0-9]*\).*/\1/p" "$work/stack.txt")
        [ -n "$n" ] || { cat "$work/stack.txt" >&2; echo "no stack of $part$c" >&2; exit 1; }
        line="$line${line:+, }$n"
    done
    echo "static const unsigned record_stack_$([ -z "$part" ] && echo render || echo panel)[RECORD_CPUS] = { $line };"
done
echo
echo "#endif"
