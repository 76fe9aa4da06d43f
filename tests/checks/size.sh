#!/bin/sh
# Flash of the renderer by what a firmware uses of it, and RAM by pool for some configurations. Figures to
# read in review; a budget that is exceeded fails. Needs BUILD/libcore.a.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

FLASH_MAX=${FLASH_MAX:-60809}           # everything but clusters, Cortex-M3 -O2
FLASH_CLUSTERS_MAX=${FLASH_CLUSTERS_MAX:-3334} # what clusters take
FLASH_FLAT_MAX=${FLASH_FLAT_MAX:-29566} # flat and recip, and the accelerators that such a program names, Cortex-M3 -O2
# No accelerators, Cortex-M3 -Os
BARE_FLAT_MAX=${BARE_FLAT_MAX:-14398}   # flat and recip; the goal is 12800
BARE_TEXTURE_MAX=${BARE_TEXTURE_MAX:-17700} # a texture lit at the vertices, recip; the goal is 16384
BARE_MAX=${BARE_MAX:-34105}             # everything
FLASH_PANEL_MAX=${FLASH_PANEL_MAX:-3072} # a panel that converts nothing

# LABEL SHADER DEPTH [STATEMENTS [DECLARATIONS]]; LIST: its accelerators; flags: those of the objects, if any
flash() {
    minimal "$dir/main.c" "$2" "$3" "${4:-}"
    echo "${5:-}" >>"$dir/main.c"
    # shellcheck disable=SC2086
    if ! link "$c" "$dir" "$dir/main.c" "$dir/size.elf" ${flags:-} -Wl,-Map,"$dir/size.map"; then
        bad "$c $1" "does not link"
        core_bytes=0
        return
    fi
    core_bytes=$(taken "$dir/size.map" "$dir/")
    lib_bytes=$(taken "$dir/size.map" 'lib(gcc|c|c_nano)\\.a')
    printf '  %-34s %8d %8d\n' "$1" "$core_bytes" "$lib_bytes"
}
textured() { # LABEL SHADER DEPTH TEXELS
    flash "$1" "$2" "$3" 'extern struct zs_texture texture; material.texture = &texture;' \
        "struct zs_texture texture = { .format = &zs_texel_$4 };"
}

within() { # NAME BYTES MOST
    most=$(most_here "$3")
    if [ "$2" -gt 0 ] && [ "$2" -le "$most" ]; then
        ok "$1 within $most bytes: $2"
    else
        bad "$1 within $most bytes" "$2"
    fi
}

# The core alone. Limits are of -Os on the M3; make size prints all.
for c in $CPUS; do
    for level in -Os -O2; do
        [ "$c$level" = cortex-m3-Os ] || [ -n "${SIZE_ALL:-}" ] || continue
        flags="-DZS_NO_FAST=1 $level" dir=$B/size-bare$level-$c LIST=
        # shellcheck disable=SC2086
        core "$c" "$dir" $flags || { bad "bare, $c compiles" "see above"; continue; }
        printf '%-36s %8s %8s\n' "Flash, bytes, $c $level, no fast/" zstrip "libgcc+c"
        flash "raw, recip" raw recip
        flash "flat, recip" flat recip
        flat=$core_bytes
        flash "smooth, recip" smooth recip
        flash "flat, e3m13" flat e3m13
        textured "texture 565, recip" texture recip 565
        textured "texture 565 smooth, recip" texture_smooth recip 565
        texture=$core_bytes
        textured "texture pal8 smooth, e3m13" texture_smooth e3m13 pal8
        flash "everything" flat recip "$EVERYTHING" "$OTHERS"
        [ "$c$level" = cortex-m3-Os ] || continue
        within "bare, $c flat alone (goal 12800)" "$flat" "$BARE_FLAT_MAX"
        within "bare, $c texture, light, clipping (goal 16384)" "$texture" "$BARE_TEXTURE_MAX"
        within "bare, $c everything" "$core_bytes" "$BARE_MAX"
    done
done

# With the accelerators that a program names
FRAME='ZS_FAST_FRAME,'
names='batch touch tiles edges clusters raw flat smooth texture texture_flat texture_smooth 565 pal8 pal4'
declared=$(sed -n '/^extern const struct zs_fast /{s/;.*//; s/.*struct zs_fast //; s/zs_fast_//g; s/, / /g; p}' \
    firmware/zstrip/zs_fast.h)
# shellcheck disable=SC2086
none "accelerators are those of zs_fast.h" "$(printf '%s\n' $names $declared | sort | uniq -u)"
flags=
for c in $CPUS; do
    dir=$B/size-$c LIST=
    core "$c" "$dir" || { bad "$c compiles" "see above"; continue; }
    printf '%-36s %8s %8s\n' "Flash, bytes, $c -O2" zstrip "libgcc+c"
    LIST="$FRAME ZS_FAST_RAW," flash "raw, recip" raw recip
    LIST=$FAST_FLAT
    flash "flat, recip" flat recip
    flat=$core_bytes
    flash "flat, linear" flat linear
    flash "flat, e3m13" flat e3m13
    flash "flat, recip, a state" flat recip '
         extern const struct zs_depth_state state; instance.depth_state = &state;' \
        'const struct zs_depth_state state = { .func = ZS_DEPTH_LESS_EQUAL, .read_only = 1, .bias = 2,
             .slope_bias = 3 };'
    flash "flat, recip, turn and look at" flat recip \
        'zs_pose_turn(&instance.pose, 1, 2, 3);
         (void)zs_camera_look_at(&camera, (int32_t *)anything, (int32_t *)anything + 3, (int32_t *)anything + 6);'
    flash "flat, recip, a shader of its own" flat recip "$OWN" "$OWN_SHADER"
    LIST="$FAST_FLAT ZS_FAST_CLUSTERS," flash "flat, recip, clusters" flat recip
    clusters=$((core_bytes - flat))
    LIST="$FRAME ZS_FAST_SMOOTH," flash "smooth, recip" smooth recip
    LIST="$FRAME ZS_FAST_SMOOTH," flash "smooth, linear" smooth linear
    LIST="$FRAME ZS_FAST_TEXTURE, ZS_FAST_565," textured "texture 565, recip" texture recip 565
    LIST=$FAST_TEXTURE textured "texture 565 smooth, recip" texture_smooth recip 565
    LIST="$FRAME ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_PAL8," textured "texture pal8 smooth, e3m13" texture_smooth e3m13 pal8
    LIST= flash "everything, no accelerator" flat recip "$EVERYTHING" "$OTHERS"
    LIST=$FAST_ALL flash "everything" flat recip "$EVERYTHING" "$OTHERS"
    all=$core_bytes without_clusters=0
    for name in $names; do # each is linked for itself: without it something is gone
        LIST=
        for other in $names; do [ "$other" = "$name" ] || LIST="$LIST &zs_fast_$other,"; done
        flash "everything but zs_fast_$name" flat recip "$EVERYTHING" "$OTHERS" >"$dir/but.txt"
        grep FAILED "$dir/but.txt"
        printf '    %-32s %8d\n' "of which zs_fast_$name" $((all - core_bytes))
        [ "$core_bytes" -gt 0 ] && [ $((all - core_bytes)) -gt 0 ] ||
            bad "$c zs_fast_$name left out is gone" "$core_bytes of $all bytes"
        [ "$name" = clusters ] && without_clusters=$core_bytes
    done
    ok "$c bytes go with each accelerator that is left out"
    if [ "$c" = cortex-m3 ]; then
        within "$c flat and its accelerators" "$flat" "$FLASH_FLAT_MAX"
        within "$c clusters" "$clusters" "$FLASH_CLUSTERS_MAX"
        within "$c everything but clusters" "$without_clusters" "$FLASH_MAX"
    fi
done
LIST=

# Panels: panel.c, the type, the conversion that it brings along; sizes as commonly sold
for c in $CPUS; do
    dir=$B/size-panels-$c
    panels "$c" "$dir" || { bad "panels, $c compile" "see above"; continue; }
    printf '%-36s %8s %8s\n' "Flash, bytes, $c -O2" panel "libgcc+c"
    for one in "st7789 240 240" "ili9341 240 320" "gc9a01 240 240" "ssd1351 128 128" "ssd0323 128 64" \
        "ssd1306 128 64"; do
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
    echo $((0x$(${ARM}nm --plugin= -S "$B/probe.o" | awk '/renderer_bytes/ { print $2 }')))
}
cat >"$B/ram.c" <<'END'
#include "zstrip.h"
#include <stdio.h>
#include <stdlib.h>
int main(int argc, char **argv)
{
    static const struct { const char *name; uint16_t w, h, rows, tris, verts; uint8_t varyings, buffers; } t[] = {
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
                                     .max_verts = t[i].verts, .varyings = t[i].varyings, .buffers = t[i].buffers,
                                     .subpixel_bits = 8, .depth_bits = 16, .depth = &zs_depth_recip };
        const unsigned arena =
            ZS_ARENA_BYTES(t[i].w, t[i].h, t[i].rows, t[i].tris, t[i].verts, t[i].varyings, t[i].buffers);
        printf("  %-34s %6u %6u %7u %7u %5u %7u %7u %8u\n", t[i].name, t[i].tris, t[i].verts,
               (unsigned)ZS_COLOR_BYTES(t[i].w, t[i].rows, t[i].buffers), (unsigned)ZS_DEPTH_BYTES(t[i].w, t[i].rows),
               (unsigned)ZS_BIN_BYTES(t[i].h, t[i].rows), (unsigned)ZS_TRI_BYTES(t[i].tris),
               (unsigned)ZS_VERT_BYTES(t[i].verts, t[i].varyings), arena);
        wrong |= arena != zs_arena_bytes(&c);
    }
    printf("  and %u bytes of struct zs_renderer (Cortex-M), and the stack\n", renderer);
    return wrong;
}
END
renderer=$(renderer_bytes)
if gcc -std=c11 -Ifirmware/zstrip "$B/ram.c" "$top/libcore.a" -o "$B/ram" && "$B/ram" "$renderer"; then
    ok "ZS_ARENA_BYTES equals zs_arena_bytes"
else
    bad "ZS_ARENA_BYTES equals zs_arena_bytes" "see above"
fi
[ "$(renderer_bytes -DZS_NO_FAST=1)" = "$renderer" ] && ok "struct zs_renderer is the same without accelerators" ||
    bad "struct zs_renderer is the same without accelerators" "$(renderer_bytes -DZS_NO_FAST=1), not $renderer"
exit $failed
