# For the Cortex-M: the renderer and panels as objects, the least firmware, linking; and verdicts on lists. Sourced,
# not run. Each script may be given a build directory (build).
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
top=${1:-build}
B=$top/checks
ARM=${ARM:-arm-none-eabi-}
CPUS="cortex-m0plus cortex-m3"
OPT="-O2 -ffunction-sections -fdata-sections"
WARN="-Wall -Wextra -Werror -Wconversion -Wshadow -Wvla -Wstrict-prototypes -Wmissing-prototypes
      -Wno-missing-field-initializers -Wdouble-promotion"
. tests/lib/ok.sh
mkdir -p "$B"

# NAME LIST: fails where the list is not empty, and shows it on one line.
none() {
    if [ -z "$2" ]; then ok "$1"; else bad "$1" "$(echo "$2" | sort -u | tr '\n' ' ')"; fi
}

# NAME FILE...: whether there is such a file; says so where a pattern matched none.
files() {
    [ -e "$2" ] || bad "$1" "no files: $2"
    [ -e "$2" ]
}

# NAME SECONDS OPTION...: build a program with these options of firmware.mk, and run it on the emulated Pico, so long at
# most: its text.
on_pico() {
    name=$1 seconds=$2
    shift 2
    sh tests/boards/pico.sh "$top" set-up >&2 || return 1
    make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD=pico NAME="$name" "$@" B="$top" OUT="$top/fw/$name-pico" \
        image >&2 && timeout "$seconds" node "$top/pico/parts.mjs" "$top/fw/$name-pico/$name"
}

# WHAT DIR NAME: `firmware`, a function of the script's, builds a program, and runs it with `run`: what it writes is
# DIR/NAME.csv. Where it does not build or run, all of that is shown, and the script ends.
counted() {
    if ! firmware >"$2/log" 2>&1 || ! firmware run >"$2/$3.csv" 2>"$2/err"; then
        cat "$2/log" "$2/err" "$2/$3.csv"
        bad "$1 on $3" "see above"
        exit 1
    fi
    cat "$2/err" >>"$2/$3.csv" # semihosting may write to either
}

# CPU DIR [FLAGS...]: firmware/zstrip, or hal/panel, as objects, and what the compiler says of their stack. With BARE,
# which is in the flags then, without accelerators.
BARE='-DZS_NO_FAST=1 -Os'
core() {
    compile firmware/zstrip "$@"
}
panels() {
    compile hal/panel "$@" -Ihal -ffreestanding
}
# With -o OBJECT.o: an object, with its functions' frames and the call graph in OBJECT.su
measured() { # OPTION... of gcc
    # shellcheck disable=SC2046,SC2086
    MEASURED_GCC=${ARM}gcc CCACHE_COMPILERTYPE=gcc CCACHE_COMPILERCHECK=string:$measured_id \
        $(command -v ccache) tests/lib/measured_gcc.sh -g -MMD -fstack-usage "$@"
}
measured_id=$({ ${ARM}gcc --version && cat tests/lib/measured_gcc.sh; } 2>&1 | cksum | tr -d ' ')
frames() { # DIR: what the objects' functions take, a line each
    cat "$1"/*.su | grep -vE '^(graph|node|edge|\})'
}
# Of one core and flags it is compiled once for all who ask, and anew where a source or this file is newer.
compile() {
    from=$1 cpu=$2 dir=$3
    shift 3
    kept=$B/compiled/$(echo "$from $cpu $* $ARM $OPT $WARN" | cksum | cut -d ' ' -f 1)
    rm -rf "$dir"
    mkdir -p "$kept"
    (
        flock 9
        if [ ! -e "$kept/made" ] ||
            [ -n "$(find firmware/zstrip hal tests/lib/cortexm.sh -newer "$kept/made" | head -1)" ]; then
            rm -rf "${kept:?}"/*
            touch "$kept/begun"
            for src in "$from"/*.c "$from"/*/*.c; do
                [ -e "$src" ] || continue
                case "$src $*" in */fast/*ZS_NO_FAST=1*) continue ;; esac
                name=${src#"$from"/}
                name=${name%.c}
                case $name in */*) name=${name%/*}_${name#*/} ;; esac
                # shellcheck disable=SC2086
                measured -std=c11 -mcpu="$cpu" -mthumb $OPT $WARN "$@" -Ifirmware/zstrip \
                    -c "$src" -o "$kept/$name.o" || exit 1
            done
            mv "$kept/begun" "$kept/made"
        fi
        cp -a "$kept" "$dir"
    ) 9>"$kept.lock"
}

# A firmware of the least kind: FILE SHADER DEPTH [EXTRA STATEMENTS]; LIST, ending with a comma: its accelerators, if
# any
minimal() {
    list=0 declared=
    [ -z "${LIST:-}" ] || list=fast declared="static const struct zs_fast *const fast[] = { $LIST ZS_FAST_END };"
    cat >"$1" <<END
#include "zs_check.h"
#include "zs_damage.h"
#include "zs_fast.h"
#include "zs_shader.h"
struct zs_renderer renderer;
ZS_ARENA(arena, ZS_ARENA_BYTES(240, 240, 24, 500, 500, 3, 1));
struct zs_camera camera;
struct zs_material material = { .shader = &zs_shade_$2, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_BACK };
struct zs_mesh mesh;
struct zs_instance instance = { .mesh = &mesh, .material = &material };
struct zs_scene scene = { .instance = &instance, .n_instances = 1 };
struct zs_sink sink;
extern uint32_t anything[];
uint32_t anything[16];
$declared
int main(void)
{
    const struct zs_config config = { .width = 240, .height = 240, .strip_h = 24, .max_tris = 500, .max_verts = 500,
                                      .varyings = 3, .buffers = 1, .subpixel_bits = 8, .depth_bits = 16,
                                      .depth = &zs_depth_$3, .fast = $list };
    if (zs_init(&renderer, &config, arena, sizeof arena))
        return 1;
    ${4:-}
    return zs_render(&renderer, &scene, &camera, &sink);
}
END
}
# What a firmware that uses all of it would also call.
EVERYTHING='extern struct zs_material other[5];
    extern struct zs_texture texture[3];
    extern const struct zs_depth_state state;
    static const struct zs_depth *const all_depths[] = { &zs_depth_linear, &zs_depth_e3m13, &zs_depth_e4m12,
                                                         &zs_depth_e5m11, &zs_depth_float };
    const struct zs_depth *volatile depth = all_depths[anything[5]];
    const int32_t *v = (const int32_t *)anything;
    struct zs_pose *pose = &instance.pose;
    anything[0] = depth != 0;
    anything[1] = (uint32_t)zs_error_string((int)anything[2])[0];
    zs_pose_identity(pose);
    zs_pose_turn(pose, 1, 2, 3);
    (void)zs_pose_rotate(pose, v, 5);
    (void)zs_camera_perspective(&camera, 8192, 240, 1, 100);
    (void)zs_camera_orthographic(&camera, 10, 1, 100);
    (void)zs_camera_look_at(&camera, v, v + 3, v + 6);
    (void)zs_camera_look_along(&camera, v, v + 3, v + 6);
    (void)zs_camera_orbit(&camera, v, 10, 20, 30);
    (void)zs_frame_skip(&renderer);
    (void)zs_strip_hashes_init((struct zs_strip_hashes *)anything, (uint64_t *)anything, 240, 240, 24, 1);
    (void)zs_damage_compare(&renderer, (struct zs_strip_hashes *)anything);
    (void)zs_damage_track(&renderer, anything, 1);
    anything[3] = zs_frame_stats(&renderer)->passes;
    anything[7] = (uint32_t)zs_flaw_string(zs_mesh_check(&mesh, anything))[0];
    anything[8] = (uint32_t)zs_texture_check((const struct zs_texture *)anything, anything);
    instance.depth_state = &state;
    material = other[anything[4]];
    material.texture = &texture[anything[6]];'
# Accelerators that a program names of which it uses flat shading, or lit textures
FAST_FLAT='ZS_FAST_FRAME, ZS_FAST_FLAT,'
FAST_TEXTURE='ZS_FAST_FRAME, ZS_FAST_TEXTURE_SMOOTH, ZS_FAST_565,'
FAST_ALL='ZS_FAST_ALL,'
OTHERS='struct zs_material other[5] = { { .shader = &zs_shade_raw }, { .shader = &zs_shade_smooth },
    { .shader = &zs_shade_texture }, { .shader = &zs_shade_texture_flat }, { .shader = &zs_shade_texture_smooth } };
struct zs_texture texture[3] = { { .format = &zs_texel_565 }, { .format = &zs_texel_pal8 },
    { .format = &zs_texel_pal4 } };
extern const struct zs_depth_state state;
const struct zs_depth_state state = { .func = ZS_DEPTH_LESS_EQUAL, .bias = 1, .slope_bias = 2 };'

# A shader of its own, besides
OWN='extern const struct zs_shader own;
    if (anything[9])
        material.shader = &own;'
OWN_SHADER='const struct zs_shader own = { ZS_FRAGMENTS };'

# A firmware that has one panel and sends a rectangle: FILE TYPE WIDTH HEIGHT [EXTRA STATEMENTS]
minimal_panel() {
    cat >"$1" <<END
#include "panel.h"
#include "hal/null/bus.c"
#include "hal/null/hal.c"
struct panel panel;
uint8_t px[4096], scratch[4096];
volatile int anything;
int main(void)
{
    static const struct panel_config config = { .type = &panel_$2, .width = $3, .height = $4, .rotate = 1 };
    static const struct panel_rect rect = { 0, 0, 16, 16 };
    if (hal_init() || panel_init(&panel, &config, hal_bus(), scratch, sizeof scratch))
        return 1;
    ${5:-}
    return panel_send(&panel, &rect, px, 0) + panel_wait(&panel);
}
END
}
# What a firmware with all panels would also call.
ALL_PANELS='struct panel_config other = config;
    other.type = panel_types[(uint32_t)anything % n_panel_types];
    anything = panel_init(&panel, &other, hal_bus(), scratch, panel_scratch_bytes(&other, 256));
    anything = panel_rotate(&panel, 2) + panel_invert(&panel, 1) + panel_brightness(&panel, 9) + panel_sleep(&panel) +
        panel_wake(&panel) + panel_strerror(anything)[0] + panel_name(other.type)[0] + panel_grain(&other).x +
        panel_width(&panel) + panel_height(&panel) + (int)panel_format(other.type);'

# CPU OBJECTS_DIR MAIN.c OUT.elf [FLAGS...]: link as a board would, unused sections dropped. MAIN.c becomes an object by
# a call of its own, which ccache keeps, and beside the folder: it is not one of the folder's.
link() {
    cpu=$1 dir=$2 main=$3 out=$4
    shift 4
    object=$dir.${out##*/}.o of_main=
    for flag in "$@"; do
        case $flag in -Wl,*) ;; *) of_main="$of_main $flag" ;; esac
    done
    # shellcheck disable=SC2086
    ${ARM}gcc -std=c11 -mcpu="$cpu" -mthumb $OPT -Ifirmware/zstrip -I. -Ihal -Ihal/null -Ihal/panel $of_main \
        -MMD -c "$main" -o "$object" &&
        ${ARM}gcc -mcpu="$cpu" -mthumb $OPT "$object" "$dir"/*.o -nostartfiles -Wl,--gc-sections,-e,main "$@" \
            -o "$out"
}

# MAP PATTERN: bytes that the link took from objects whose path matches, by the linker's map.
taken() {
    awk -v want="$2" '
        function hex(s, n, i) {
            n = 0
            for (i = 3; i <= length(s); i++) n = n * 16 + index("0123456789abcdef", substr(s, i, 1)) - 1
            return n }
        /^Linker script and memory map/ { on = 1 }
        !on || /^ \*fill\*/ { next }
        /^ \.(text|rodata|data)[^ ]*$/ { wrapped = 1; next }         # a long name: the rest follows
        wrapped || /^ \.(text|rodata|data)/ {
            wrapped = 0
            for (i = 1; i < NF; i++)
                if ($i ~ /^0x/ && $(i + 1) ~ /^0x/) {
                    if ($(i + 2) ~ want) sum += hex($(i + 1))
                    break } }
        END { print sum + 0 }' "$1"
}
