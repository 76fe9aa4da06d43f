#!/bin/sh
# `zsim demo`: scenes as a board and panel of any size would show them; which frames; what cannot be done is refused by
# name.
# Usage: tests/tools/demo.sh ZSIM WORKDIR     as tests/tools/cli.sh
set -u
. tests/tools/zsim.sh
. "$top/tests/tools/panel.sh"

demo() { # FOLDER OPTION...    its table is in FOLDER/table
    to=$1
    shift
    rm -rf "$to"
    z demo --out "$to" "$@"
    [ $status -eq 0 ] || wrong "status $status: $(said)"
    [ ! -s stderr ] || wrong "it talks: $(said)"
    [ ! -d "$to" ] || cp stdout "$to/table"
}
holds() { # FOLDER FILE...    these and no others, in the order of ls
    have=$(cd "$1" && ls | grep -v '^table$' | tr '\n' ' ')
    shift
    is "what is written" "$have" "$* "
}
row() { # FOLDER SCENE
    grep "^$2 " "$1/table"
}
arena() { # FOLDER SCENE    bytes, from the table
    row "$1" "$2" | awk -F'|' '{ split($4, word, " "); print word[1] }'
}
png_size() { # FILE
    od -An -tu1 -j 16 -N 8 "$1" | awk '{ print $3 * 256 + $4 "x" $7 * 256 + $8 }'
}
shows() { # PANEL-PICTURE FRAME PANEL [VALUES]
    if ! shown=$("$work/seen" "$1" "$2" "$(kind "$3")" ${4:+"$4"}); then
        wrong "$shown"
    elif [ "${shown##* }" -lt 2 ]; then
        wrong "an empty picture: $1: $shown"
    fi
}

# ---- Without a panel ------------------------------------------------------------------------------
begin scenes_of_their_own_size
demo own --scene teapot,sheet --frames 2
holds own contact.png sheet_000.png teapot_000.png teapot_001.png
is "a frame" "$(png_size own/teapot_001.png)" 240x240
is "a bench scene" "$(png_size own/sheet_000.png)" 320x240
is "the sheet" "$(png_size own/contact.png)" 1280x240
[ -n "$(row own teapot)" ] && [ -n "$(row own sheet)" ] || wrong "not a row for each scene"
[ -z "$(row own cubes)" ] || wrong "a row for cubes"

begin size_of_ones_own
demo sized --scene teapot,sheet --size 90x50 --frames 1 --raw
holds sized contact.png sheet_000.bin sheet_000.png teapot_000.bin teapot_000.png
for scene in teapot sheet; do
    is "a frame" "$(png_size sized/${scene}_000.png)" 90x50
    shows sized/${scene}_000.png sized/${scene}_000.png st7789 sized/${scene}_000.bin
done
is "the sheet" "$(png_size sized/contact.png)" 360x50

begin false_colours
demo shown --scene layers_btf,cubes --frames 1 --show overdraw --fast all-tiles
holds shown contact.png cubes_000.png layers_btf_000.png
is "a picture and its legend" "$(png_size shown/layers_btf_000.png)" 320x276
is "the sheet" "$(png_size shown/contact.png)" 1280x276
look pixel shown/layers_btf_000.png 160 120
is "eight times over" "$seen" ffffff
demo shown --scene layers_btf --frames 1 --show overdraw
look pixel shown/layers_btf_000.png 160 120
[ "$seen" != ffffff ] || wrong "accelerators made no difference"
z demo --out shown --scene cubes --show overdraw --panel st7789:240x240
one_line 2 --show
z demo --out shown --scene cubes --fast all-none
one_line 2 --fast

begin scenes_with_effects # not compared, in passes, in strips of any height, by their own method alone
demo effects --scene cockpit,cubes --size 64x48 --frames 2
holds effects cockpit_000.png cockpit_001.png contact.png cubes_000.png cubes_001.png
is "its comparison" "$(row effects cockpit | awk -F'|' '{ print $5 }' | tr -d ' ')" -----
[ "$(row effects cubes | awk -F'|' '{ print $5 }' | tr -d ' ')" != ----- ] || wrong "cubes are not compared either"
demo effects_7 --scene cockpit --size 64x48 --frames 2 --strip 7 --fast none
for t in 000 001; do
    cmp -s effects/cockpit_$t.png effects_7/cockpit_$t.png || wrong "another picture in strips of 7 rows"
done
demo effects --scene cockpit --frames 1
look pixel effects/cockpit_000.png 120 20
case $seen in # the fin, red
[89a-f]?[0-4]?[0-4]?) ;;
*) wrong "the mirror shows no tail: $seen" ;;
esac
for option in '--show overdraw' '--method painter'; do
    # shellcheck disable=SC2086
    z demo --out effects --scene cubes,cockpit $option
    one_line 2 cockpit
done

# A shader of the scene's own, which reads on beyond its struct zs_material: drawn, not compared, and counted by budget
begin a_scene_with_a_shader_of_its_own
cat >tinted.c <<'END'
#include "show.h"
#include "zs_shader.h"
struct tinted { struct zs_material material; const uint8_t *table; };
static const uint8_t table[4] = { 40, 100, 180, 255 };
static void shade(const struct zs_shading *s, uint32_t n, uint16_t *out)
{ out[0] = ((const struct tinted *)s->instance->material)->table[n & 3] * 257u; }
static void color(const struct zs_instance *in, struct zs_fragment *f)
{ *f->color = zs_wire565((uint8_t)(f->v[0] >> 8), 0, ((const struct tinted *)in->material)->table[0]); }
static const struct zs_shader tint = { .vertex = shade, .fragment = color, ZS_FRAGMENTS, .n_varyings = 1 };
static const struct tinted red = { { .shader = &tint }, table };
static const int16_t at[4][3] = { { -3, 0, 3 }, { 3, 0, 3 }, { 3, 0, -3 }, { -3, 0, -3 } };
static const uint16_t tri[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static const struct zs_mesh ground = { .pos = at, .tri = tri, .n_verts = 4, .n_tris = 2,
                                       .scale = 1000 * ZS_Q16_ONE, .radius = 5 };
static void pose(struct demo_frame *f, uint32_t t, uint16_t w, uint16_t h)
{
    static const int32_t middle[3] = { 0, 800, 0 };
    f->instance[0] = (struct zs_instance){ .mesh = &ground, .material = &red.material };
    f->scene.instance = f->instance;
    f->scene.n_instances = 1;
    (void)zs_camera_perspective(&f->camera, ZS_DEGREES(45), w < h ? w : h, 1000, 30000);
    (void)zs_camera_orbit(&f->camera, middle, 7000, (int16_t)(900 * t), ZS_PITCH(22));
}
static const struct zs_fast *const fast[] = { ZS_FAST_FRAME, ZS_FAST_END };
static const struct demo mine = { .name = "tinted", .what = "a ground", .width = SHOW_WIDTH, .height = SHOW_HEIGHT,
                                  .frames = 3, .varyings = 1, .depth = &zs_depth_float, .fast = fast, .pose = pose };
SHOW(mine, 30, 16, 100, 100, 1);
END
demo tinted --scene tinted.c --frames 3
holds tinted contact.png tinted_000.png tinted_001.png tinted_002.png
is "its comparison" "$(row tinted tinted | awk -F'|' '{ print $5 }' | tr -d ' ')" -----
look png tinted/tinted_001.png
[ "$(word 3 $seen)" -gt 20 ] || wrong "it has no shades: $seen"
z budget --scene tinted.c --size 160x120 --part rp2040
is "status of budget" $status 0
grep -qE '^  M0 [0-9.]+ M, M3 [0-9.]+ M' stdout || wrong "no instructions: $(said)"
[ "$(awk '/^Flash/ { on = 1 } on && $1 == "renderer" { print $2; exit }' stdout)" -gt 25000 ] ||
    wrong "a renderer of $(grep '^  renderer' stdout | tail -1)"

begin strips_of_any_height
demo strip_24 --scene city --size 70x60 --frames 2
for rows in 1 7 60 4096; do
    demo strip --scene city --size 70x60 --frames 2 --strip $rows
    cmp -s strip/city_001.png strip_24/city_001.png || wrong "another picture in strips of $rows rows"
    have=$(arena strip city) ample=$(arena strip_24 city)
    if [ $rows -lt 24 ]; then
        [ "$have" -lt "$ample" ] || wrong "strips of $rows rows take $have bytes, of 24 rows $ample"
    else
        [ "$have" -gt "$ample" ] || wrong "strips of $rows rows take $have bytes, of 24 rows $ample"
    fi
done

begin sub_pixel_bits
demo bits_8 --scene teapot --size 60x60 --frames 1 --subpixel 8
demo bits_4 --scene teapot --size 60x60 --frames 1 --subpixel 4
demo bits --scene teapot --size 60x60 --frames 1
cmp -s bits/teapot_000.png bits_8/teapot_000.png || wrong "8 is not the default"
cmp -s bits/teapot_000.png bits_4/teapot_000.png && wrong "4 is like 8"
wrong_8=$(row bits_8 teapot | awk -F'|' '{ print $5 + 0 }') wrong_4=$(row bits_4 teapot | awk -F'|' '{ print $5 + 0 }')
awk -v a="$wrong_8" -v b="$wrong_4" 'BEGIN { exit !(a < b) }' || wrong "$wrong_8 % wrong with 8 bits, $wrong_4 % with 4"

begin frames_from_start_by_step
demo all --scene cubes --size 32x24
is "frames" "$(ls all | grep -c '^cubes_')" 60
demo few --scene cubes --size 32x24 --start 3 --step 25
holds few contact.png cubes_003.png cubes_028.png cubes_053.png
demo two --scene cubes --size 32x24 --start 3 --step 25 --frames 2 --raw
holds two contact.png cubes_003.bin cubes_003.png cubes_028.bin cubes_028.png
for t in 003 028 053; do
    cmp -s few/cubes_$t.png all/cubes_$t.png || wrong "frame $t is another one"
done
cmp -s few/cubes_003.png few/cubes_028.png && wrong "frames 3 and 28 are the same"
grep -q '^Triangles and pixels: frame 3\.' few/table || wrong "the table is not of frame 3"
demo last --scene cubes --size 32x24 --start=59
holds last contact.png cubes_059.png

# ---- With a panel ---------------------------------------------------------------------------------
for on in ssd0323:128x64/0 ssd0323:128x64/90 ssd1306:72x40/180 ssd1306:128x64/270 st7789:135x240/90 \
    gc9a01:240x240/0; do
    panel=${on%/*} degrees=${on#*/}
    begin "shows_the_scene_$(echo "$on" | tr :/ __)"
    demo frame --scene cubes,sheet --step 40 --size "$(turned "${panel#*:}" "$degrees")" --strip 8
    demo panel --scene cubes,sheet --step 40 --panel "$panel" --rotate "$degrees" --strip 8 --raw
    for picture in cubes_000 cubes_040 sheet_000; do
        shows panel/$picture.png frame/$picture.png "$panel" panel/$picture.bin
    done
    is "the table's row, but its arena" "$(row panel cubes | cut -d '|' -f 2,3,5-)" \
        "$(row frame cubes | cut -d '|' -f 2,3,5-)"
done

begin contact_sheet_of_a_panel # the fifth of its scenes, in the second row
demo panel --scene teapot,cubes,knot,flyover,city --frames 1 --panel ssd1351:128x96
is "the sheet" "$(png_size panel/contact.png)" 512x192
n=0
for x in 0 31 64 90 127; do
    for y in 0 30 48 75 95; do
        look pixel panel/contact.png $x $((96 + y))
        have=$seen
        look pixel panel/city_000.png $x $y
        is "pixel $x,$y of the city" "$have" "$seen"
        [ "$seen" = 000000 ] || n=$((n + 1))
    done
done
[ $n -gt 5 ] || wrong "$n of 25 pixels are not black"

begin glass_that_is_inverted_and_bgr
demo frame --scene knot --frames 1 --size 128x128
demo panel --scene knot --frames 1 --panel ssd1351:128x128 --invert --bgr --raw
shows panel/knot_000.png frame/knot_000.png ssd1351 panel/knot_000.bin

# ---- Refusals -------------------------------------------------------------------------------------
demo_refused() { # NAME WHAT-THE-LINE-HOLDS OPTION...
    begin "demo_refused_$1"
    what=$2
    shift 2
    rm -rf none
    z demo --out none "$@"
    one_line 1 "$what"
    [ ! -e none ] || wrong "a folder is left"
}
demo_usage() { # NAME WHAT-THE-LINE-HOLDS OPTION...
    as=$1 what=$2
    shift 2
    rm -rf none
    usage "demo_$as" "$what" demo --out none "$@"
    [ ! -e none ] || wrong "a folder is left"
}
demo_refused scene '--scene pot: there is no such scene; there are teapot, ' --scene teapot,pot
demo_refused start '--start 48: frames of teapot are 0 to 47' --scene cubes,teapot --start 48
demo_refused start_of_all 'name scenes by --scene' --start 1
demo_refused start_below_0 '--start -1 is outside its range, 0 to' --start -1
demo_refused step_0 '--step 0 is outside its range, 1 to' --step 0
demo_refused frames_0 '--frames 0 is outside its range, 1 to' --frames 0
demo_refused size_0 '--size 0x9: the frame must be 1 to 4096 px' --size 0x9
demo_refused size_large '--size 9x4097: the frame must be 1 to 4096 px' --size 9x4097
demo_refused strip_0 '--strip 0 is outside its range, 1 to 4096' --strip 0
demo_refused panel_unknown '--panel st7735:128x160 is not known; there are st7789:240x240,' --panel st7735:128x160
demo_refused other_size 'is not the picture of --panel ssd1306:72x40 --rotate 90, 40x72; leave it out' \
    --panel ssd1306:72x40 --rotate 90 --size 72x40
demo_refused strip_cuts_a_page \
    '--strip 12: ssd1306:128x64 takes 8 rows at a time, so give a multiple of that, such as 16' \
    --panel ssd1306:128x64 --strip 12
for option in --rotate=90 --invert --bgr; do
    as=${option%=*}
    demo_usage "alone_${as#--}" "$as is for a --panel, which is missing" $option
done
demo_usage rotate_45 '--rotate wants 0|90|180|270' --panel st7789:240x240 --rotate 45
demo_usage subpixel_5 '--subpixel wants 4|8' --subpixel 5
demo_usage size_words '--size wants WIDTHxHEIGHT' --size words
demo_usage step_words '--step wants a whole number' --step 2x
demo_usage raw_value '--raw wants no value' --raw=x
demo_usage scene_missing '--scene wants a value' --scene
demo_usage unknown "unknown option '--rwa'" --rwa

begin demo_disk_full
last=' (ulimit -f 40; zsim demo --scene teapot --frames 1 --raw --out full)' # the PNG fits, the .bin does not
(
    ulimit -f 40
    "$zsim" demo --scene teapot --frames 1 --raw --out full >stdout 2>stderr
)
status=$?
is status $status 1
only_line stderr
is "what it says" "${the_line%%: cannot be written*}" 'zsim: full/teapot_000.bin'
[ -z "$(ls -A full)" ] || wrong "it leaves $(ls -A full | tr '\n' ' ')"

begin demo_help
z demo --help
is status $status 0
for word in --out --scene --size --strip --subpixel --start --step --frames --panel --rotate --invert --bgr --raw \
    slivers ssd1306:72x40; do
    grep -qF -- "$word" stdout || wrong "$word is not named"
done

finish
[ $n_failed -eq 0 ]
