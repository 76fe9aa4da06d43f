#!/bin/sh
# Flash of the renderer by what a firmware uses of it, and RAM by pool for some configurations. Figures to
# read in review; a budget that is exceeded fails.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

FLASH_MAX=${FLASH_MAX:-59392}           # everything but clusters, Cortex-M3
FLASH_CLUSTERS_MAX=${FLASH_CLUSTERS_MAX:-3328} # what clusters take
FLASH_FLAT_MAX=${FLASH_FLAT_MAX:-26880} # flat and recip alone, Cortex-M3
# ZS_LEAN, -Os, Cortex-M3. The goals are 6,144 bytes for flat alone, 12,288 with textures, lighting and clipping.
LEAN_FLAT_MAX=${LEAN_FLAT_MAX:-11520}       # flat and recip alone
LEAN_TEXTURE_MAX=${LEAN_TEXTURE_MAX:-14848} # a texture lit at the vertices, recip
LEAN_MAX=${LEAN_MAX:-29440}                 # everything
FLASH_PANEL_MAX=${FLASH_PANEL_MAX:-3072} # a panel that converts nothing

# MAP PATTERN: bytes that the link took from objects whose path matches.
taken() {
    awk -v want="$2" '
        /^Linker script and memory map/ { on = 1 }
        !on || /^ \*fill\*/ { next }
        /^ \.(text|rodata|data)[^ ]*$/ { wrapped = 1; next }         # a long name: the rest follows
        wrapped || /^ \.(text|rodata|data)/ {
            wrapped = 0
            for (i = 1; i < NF; i++)
                if ($i ~ /^0x/ && $(i + 1) ~ /^0x/) {
                    if ($(i + 2) ~ want) print substr($(i + 1), 3)
                    break } }' "$1" | { sum=0; while read -r hex; do sum=$((sum + 0x$hex)); done; echo $sum; }
}
# LABEL SHADER DEPTH [STATEMENTS [DECLARATIONS]]; lean: flags of the lean build, or nothing
flash() {
    minimal "$dir/main.c" "$2" "$3" "${4:-}"
    echo "${5:-}" >>"$dir/main.c"
    # shellcheck disable=SC2086
    if ! link "$c" "$dir" "$dir/main.c" "$dir/size.elf" $lean -Wl,-Map,"$dir/size.map"; then
        bad "$c $1" "does not link"
        return
    fi
    core_bytes=$(taken "$dir/size.map" "$dir/")
    lib_bytes=$(taken "$dir/size.map" 'lib(gcc|c|c_nano)\\.a')
    printf '  %-34s %8d %8d\n' "$1" "$core_bytes" "$lib_bytes"
}

within() { # NAME BYTES MOST
    if [ "$2" -le "$3" ]; then ok "$1 within $3 bytes: $2"; else bad "$1 within $3 bytes" "$2"; fi
}

lean=
for c in $CPUS; do
    dir=$B/size-$c
    core "$c" "$dir" || { bad "$c compiles" "see above"; continue; }
    printf '%-36s %8s %8s\n' "Flash, bytes, $c -O2" zstrip "libgcc+c"
    flash "raw, recip" raw recip
    flash "flat, recip" flat recip
    flat=$core_bytes
    flash "flat, linear" flat linear
    flash "smooth, recip" smooth recip
    flash "smooth, linear" smooth linear
    flash "flat, e3m13" flat e3m13
    flash "texture 565, recip" texture recip '
         extern struct zs_texture texture; material.texture = &texture;' \
        'struct zs_texture texture = { .format = &zs_texel_565 };'
    flash "texture pal8 smooth, e3m13" texture_smooth e3m13 '
         extern struct zs_texture texture; material.texture = &texture;' \
        'struct zs_texture texture = { .format = &zs_texel_pal8 };'
    flash "flat, recip, a state" flat recip '
         extern const struct zs_state state; instance.state = &state;' 'const struct zs_state state = ZS_STATE(1, 1, 2, 3);'
    flash "flat, recip, turn and look at" flat recip \
        'zs_pose_turn(&instance.pose, 1, 2, 3);
         (void)zs_camera_look_at(&camera, (int32_t *)anything, (int32_t *)anything + 3, (int32_t *)anything + 6);'
    flash "flat, recip, clusters" flat recip 'mesh.cluster_kernel = &zs_cluster_kernel;'
    clusters=$((core_bytes - flat))
    flash "everything, clusters" flat recip "$EVERYTHING $CULLING" "$OTHERS"
    flash "everything but clusters" flat recip "$EVERYTHING" "$OTHERS"
    if [ "$c" = cortex-m3 ]; then
        within "$c flat alone" "$flat" "$FLASH_FLAT_MAX"
        within "$c clusters" "$clusters" "$FLASH_CLUSTERS_MAX"
        within "$c everything but clusters" "$core_bytes" "$FLASH_MAX"
    fi
done

# The lean build, by size. The full one beside it is above.
lean='-DZS_LEAN=1 -Os'
for c in $CPUS; do
    dir=$B/size-lean-$c
    # shellcheck disable=SC2086
    core "$c" "$dir" $lean || { bad "lean, $c compiles" "see above"; continue; }
    printf '%-36s %8s %8s\n' "Flash, bytes, $c, ZS_LEAN -Os" zstrip "libgcc+c"
    flash "raw, recip" raw recip
    flash "flat, recip" flat recip
    flat=$core_bytes
    flash "smooth, recip" smooth recip
    flash "flat, e3m13" flat e3m13
    flash "texture 565, recip" texture recip '
         extern struct zs_texture texture; material.texture = &texture;' \
        'struct zs_texture texture = { .format = &zs_texel_565 };'
    flash "texture 565 smooth, recip" texture_smooth recip '
         extern struct zs_texture texture; material.texture = &texture;' \
        'struct zs_texture texture = { .format = &zs_texel_565 };'
    texture=$core_bytes
    flash "texture pal8 smooth, e3m13" texture_smooth e3m13 '
         extern struct zs_texture texture; material.texture = &texture;' \
        'struct zs_texture texture = { .format = &zs_texel_pal8 };'
    flash "everything" flat recip "$EVERYTHING" "$OTHERS"
    [ "$c" = cortex-m3 ] || continue
    within "lean, $c flat alone (goal 6144)" "$flat" "$LEAN_FLAT_MAX"
    within "lean, $c texture, light, clipping (goal 12288)" "$texture" "$LEAN_TEXTURE_MAX"
    within "lean, $c everything" "$core_bytes" "$LEAN_MAX"
done

# Panels: panel.c, the type, the conversion that it brings along; sizes as commonly sold
for c in $CPUS; do
    dir=$B/size-panels-$c
    panels "$c" "$dir" || { bad "panels, $c compile" "see above"; continue; }
    printf '%-36s %8s %8s\n' "Flash, bytes, $c -O2" panel "libgcc+c"
    for one in "st7789 240 240" "ili9341 240 320" "gc9a01 240 240" "ssd1351 128 128" "ssd0323 128 64" "ssd1306 128 64"; do
        # shellcheck disable=SC2086
        minimal_panel "$dir/main.c" $one
        if ! link "$c" "$dir" "$dir/main.c" "$dir/size.elf" -Wl,-Map,"$dir/size.map"; then
            bad "$c $one" "does not link"
            continue
        fi
        panel_bytes=$(taken "$dir/size.map" "$dir/")
        printf '  %-34s %8d %8d\n' "${one%% *}" "$panel_bytes" "$(taken "$dir/size.map" 'lib(gcc|c|c_nano)\\.a')"
        [ "${one%% *}" = st7789 ] && first=$panel_bytes
    done
    if [ "$first" -le "$FLASH_PANEL_MAX" ]; then ok "$c st7789 alone within $FLASH_PANEL_MAX bytes: $first"
    else bad "$c st7789 alone within $FLASH_PANEL_MAX bytes" "$first"; fi
done

# RAM: the macros give the same on every machine; the renderer itself holds pointers, so ask the M3.
echo '#include "zstrip.h"
char renderer_bytes[sizeof(struct zs_renderer)];' >"$B/probe.c"
renderer_bytes() { # FLAGS
    ${ARM}gcc -std=c11 -mcpu=cortex-m3 -mthumb "$@" -Ifirmware/zstrip -c "$B/probe.c" -o "$B/probe.o"
    echo $((0x$(${ARM}nm -S "$B/probe.o" | awk '/renderer_bytes/ { print $2 }')))
}
cat >"$B/ram.c" <<'END'
#include "zstrip.h"
#include <stdio.h>
#include <stdlib.h>
int main(int argc, char **argv)
{
    static const struct { const char *name; uint16_t w, h, rows, tris, verts; uint8_t attrs, buffers; } t[] = {
        { "240x240x24, 2 buffers, flat", 240, 240, 24, 500, 400, 0, 2 },
        { "240x240x16, 2 buffers, smooth", 240, 240, 16, 600, 400, 3, 2 },
        { "240x240x8, 1 buffer, flat", 240, 240, 8, 250, 200, 0, 1 },
        { "320x240x24, 2 buffers, flat", 320, 240, 24, 500, 400, 0, 2 },
        { "320x240x16, 2 buffers, flat", 320, 240, 16, 820, 1270, 0, 2 },
        { "320x240x16, 2 buffers, smooth", 320, 240, 16, 800, 700, 3, 2 },
        { "320x240x24, 1 buffer, sheet whole", 320, 240, 24, 20000, 10201, 0, 1 },
        { "128x64x8, 1 buffer, flat", 128, 64, 8, 200, 150, 0, 1 },
    };
    const unsigned renderer = argc > 1 ? (unsigned)atoi(argv[1]) : 0u;
    int wrong = 0;
    printf("%-36s %6s %6s %7s %7s %5s %7s %7s %8s\n", "RAM, bytes", "tris", "verts", "color", "depth", "bins",
           "tris", "verts", "arena");
    for (unsigned i = 0; i < sizeof t / sizeof t[0]; i++) {
        const struct zs_config c = { .width = t[i].w, .height = t[i].h, .strip_h = t[i].rows, .max_tris = t[i].tris,
                                     .max_verts = t[i].verts, .attrs = t[i].attrs, .buffers = t[i].buffers,
                                     .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip };
        const unsigned arena = ZS_ARENA_BYTES(t[i].w, t[i].h, t[i].rows, t[i].tris, t[i].verts, t[i].attrs, t[i].buffers);
        printf("  %-34s %6u %6u %7u %7u %5u %7u %7u %8u\n", t[i].name, t[i].tris, t[i].verts,
               (unsigned)ZS_COLOR_BYTES(t[i].w, t[i].rows, t[i].buffers), (unsigned)ZS_DEPTH_BYTES(t[i].w, t[i].rows),
               (unsigned)ZS_BIN_BYTES(t[i].h, t[i].rows), (unsigned)ZS_TRI_BYTES(t[i].tris),
               (unsigned)ZS_VERT_BYTES(t[i].verts, t[i].attrs), arena);
        wrong |= arena != zs_arena_bytes(&c);
    }
    printf("  and %u bytes of struct zs_renderer (Cortex-M), and the stack\n", renderer);
    return wrong;
}
END
for lean in 0 1; do
    [ $lean = 0 ] || { name=", ZS_LEAN"; echo "The same with ZS_LEAN=1"; }
    renderer=$(renderer_bytes -DZS_LEAN=$lean)
    if gcc -std=c11 -DZS_LEAN=$lean -Ifirmware/zstrip "$B/ram.c" firmware/zstrip/*/*.c -o "$B/ram" && "$B/ram" "$renderer"; then
        ok "ZS_ARENA_BYTES equals zs_arena_bytes${name:-}"
    else
        bad "ZS_ARENA_BYTES equals zs_arena_bytes${name:-}" "see above"
    fi
done
exit $failed
