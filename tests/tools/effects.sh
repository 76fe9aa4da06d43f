#!/bin/sh
# Options of effects of zsim render: what a picture shows, pixel by pixel, and what is refused.
# Usage: tests/tools/effects.sh ZSIM WORKDIR     from the repository's top
#
# Most models are drawn by the camera `plain`: 240x240, one unit to a pixel, (x, y, z) at pixel (120 + x, 120 - y), 120
# units away where z = 0.
# SPDX-License-Identifier: MIT
. tests/tools/zsim.sh

obj quad 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' 'f 1 2 3 4'
# Two cards behind each other, the nearer one last in the file and on the right
obj cards 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' \
    'v 0 -50 40' 'v 90 -50 40' 'v 90 50 40' 'v 0 50 40' 'f 5 6 7 8' 'f 1 2 3 4'
# A ball of 24 x 12 cells, radius 60
awk 'BEGIN { pi = atan2(0, -1); n = 24; m = 12
    for (i = 0; i <= m; i++) for (j = 0; j < n; j++)
        printf "v %.6f %.6f %.6f\n", 60 * sin(pi * i / m) * sin(2 * pi * j / n), 60 * cos(pi * i / m),
            60 * sin(pi * i / m) * cos(2 * pi * j / n)
    for (i = 0; i < m; i++) for (j = 0; j < n; j++) {
        a = i * n + j + 1; b = i * n + (j + 1) % n + 1
        print "f", a, a + n, b + n, b } }' >ball.obj

bare='--ambient 1 --diffuse 0' # colours as they are
effect() { # NAME MODEL OPTION...    a picture, out/NAME.png
    as=$1
    shift
    rm -f "out/$as.png"
    z render "$@" --out "out/$as.png"
    [ $status -eq 0 ] || wrong "status $status: $(said)"
    [ ! -s stdout ] && [ ! -s stderr ] || wrong "it talks in a pipe: $(said)"
}
codes() { # NAME X Y W H WANT_R WANT_G WANT_B    mean codes in thousandths, within 1000
    look codes "out/$1.png" "$2" "$3" "$4" "$5"
    # shellcheck disable=SC2086
    set -- "$1" "$6" "$7" "$8" $seen
    for k in 2 3 4; do
        eval "want=\${$k} have=\${$((k + 3))}"
        [ "$have" -ge $((want - 1000)) ] && [ "$have" -le $((want + 1000)) ] ||
            wrong "$1 has codes $5 $6 $7 for $2 $3 $4"
    done
}
pixel() { # NAME X Y RRGGBB
    look pixel "out/$1.png" "$2" "$3"
    is "out/$1.png at $2,$3" "$seen" "$4"
}
darker() { # LEAST MOST    codes in $dark, of those in $seen
    awk -v a="$dark" -v b="$seen" -v least="$1" -v most="$2" 'BEGIN {
        split(a, d); split(b, l)
        for (k = 1; k <= 3; k++) if (d[k] < least * l[k] || d[k] > most * l[k]) exit 1 }' ||
        wrong "in the shadow $dark, outside $seen"
}
same_png() { # A B
    cmp "out/$1.png" "out/$2.png" >/dev/null 2>&1 || wrong "out/$1.png and out/$2.png differ"
}

# ---- Transparency ----------------------------------------------------------------------------------------------------
begin alpha_mixes_with_what_is_behind
effect plain quad.obj $plain $bare --color ff0000 --background 0000ff
effect half quad.obj $plain $bare --color ff0000 --background 0000ff --alpha 0.5
pixel half 40 120 0000ff
codes half 80 80 80 80 15500 0 15500
effect none quad.obj $plain $bare --color ff0000 --background 0000ff --alpha 0
look count out/none.png 0000ff
is "pixels without a trace at alpha 0" "$seen" 57600
effect all quad.obj $plain $bare --color ff0000 --background 0000ff --alpha 1
same_png all plain

begin alpha_sorts_triangles # the nearer card is first in the file; where both are, it is mixed last
effect two cards.obj $plain $bare --color ffffff --alpha 0.5
codes two 80 100 10 10 15500 31500 15500
codes two 180 100 10 10 15500 31500 15500
codes two 130 100 10 10 23250 47250 23250

begin blend_add
effect add quad.obj $plain $bare --color ff0000 --background 4040ff --alpha 0.5 --blend add
codes add 80 80 80 80 23500 16000 31000
effect full quad.obj $plain $bare --color ff0000 --background c040ff --alpha 1 --blend add
pixel full 120 120 ff41ff

begin blend_screen_door
for alpha in 0.25 0.5 0.75; do
    effect door quad.obj $plain $bare --color ff0000 --background 0000ff --alpha $alpha --blend screen-door
    look count out/door.png ff0000
    many=$(awk -v a=$alpha 'BEGIN { print int(10000 * a) }')
    [ "$seen" -ge $((many - 200)) ] && [ "$seen" -le $((many + 200)) ] || wrong "$seen pixels of 10000 at alpha $alpha"
    reds=$seen
    look count out/door.png 0000ff
    is "all other pixels" "$seen" $((57600 - reds))
done

# ---- Samples ---------------------------------------------------------------------------------------------------------
begin four_samples_are_the_mean_of_a_frame_twice_as_large
effect big ball.obj --size 240x160
effect small ball.obj --size 120x80 --samples 4
look halved out/big.png out/small.png
[ "$seen" -ge 300 ] || wrong "only $seen pixels are mixed"
effect strips ball.obj --size 120x80 --samples 4 --strip 7 --buffers 1 --tris 100 --verts 90
same_png small strips
effect one ball.obj --size 120x80 --samples 1
effect plainly ball.obj --size 120x80
same_png one plainly

# ---- Fog -------------------------------------------------------------------------------------------------------------
begin fog_by_distance
effect fog quad.obj $plain $bare --color ff0000 --fog linear:20:220:0000ff
codes fog 80 80 80 80 15500 0 15500
pixel fog 10 10 000000
effect before quad.obj $plain $bare --color ff0000 --fog linear:125:220:0000ff
pixel before 120 120 ff0000
effect beyond quad.obj $plain $bare --color ff0000 --fog linear:20:110:0000ff
pixel beyond 120 120 0000ff
effect thick quad.obj $plain $bare --color ff0000 --fog exp:0.00577623:0000ff # exp(-120 * that) = 1/2
codes thick 80 80 80 80 15500 0 15500

# ---- Dither ----------------------------------------------------------------------------------------------------------
begin dither_keeps_the_mean
effect sharp ball.obj $plain --shade smooth --color 909090
for kind in ordered blue; do
    effect $kind ball.obj $plain --shade smooth --color 909090 --dither $kind
    look codes out/sharp.png 100 100 16 16
    # shellcheck disable=SC2086
    codes $kind 100 100 16 16 $seen
    ! cmp out/sharp.png out/$kind.png >/dev/null || wrong "--dither $kind did nothing"
done
effect off ball.obj $plain --shade smooth --color 909090 --dither none
same_png off sharp
begin dither_to_one_bit # the quad's grey is 128 of 255: half of its pixels are white
for kind in ordered blue; do
    effect mono quad.obj --projection orthographic --eye 0,0,120 --at 0,0,0 --fov 26 --near 20 --far 420 $bare \
        --color 808080 --panel ssd1306:128x64 --dither $kind
    look png out/mono.png
    is "size and colours of $kind" "$seen" "128 64 2"
    look count out/mono.png ffffff
    [ "$seen" -ge 3700 ] && [ "$seen" -le 4500 ] || wrong "$seen white pixels of 8192"
done

# ---- Filters ---------------------------------------------------------------------------------------------------------
gcc -O1 -Wall -Wextra -Werror "$top/tests/tools/fixture.c" -lpng -lturbojpeg -o "$work/fixture" || exit 1
begin filter_bilinear
obj card 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' 'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' 'f 1/1 2/2 3/3 4/4'
./fixture png rgb two.png 2 1 ff0000 0000ff
effect near card.obj $plain --shade unlit --texture two.png --wrap clamp
pixel near 90 120 ff0000
pixel near 150 120 0000ff
effect mixed card.obj $plain --shade unlit --texture two.png --wrap clamp --filter bilinear
pixel mixed 80 120 ff0000
pixel mixed 160 120 0000ff
codes mixed 119 100 2 20 15500 0 15500
codes mixed 107 100 1 20 23250 0 7750

begin filter_mipmap # a checker of single texels, far away, becomes one colour
./fixture png rgb fine.png 64 64 $(awk 'BEGIN {
    for (y = 0; y < 64; y++) for (x = 0; x < 64; x++) printf (x + y) % 2 ? "ffffff " : "000000 " }')
small='--projection orthographic --eye 0,0,120 --at 0,0,0 --fov 160 --near 20 --far 420'
effect aliased card.obj $small --shade unlit --texture fine.png
effect smoothed card.obj $small --shade unlit --texture fine.png --filter mipmap
look png out/smoothed.png
[ "$(word 3 $seen)" -le 3 ] || wrong "mipmapped: $seen colours"
codes smoothed 115 115 10 10 15500 31500 15500

# ---- Lights ----------------------------------------------------------------------------------------------------------
lit='--shade flat --ambient 0 --diffuse 1 --color ffffff'
begin lights_have_colors
effect red quad.obj $plain $lit --light dir:0,0,1:ff0000
pixel red 120 120 ff0000
effect both quad.obj $plain $lit --light dir:0,0,1:ff0000 --light dir:0,0,5:0000ff
pixel both 120 120 ff00ff
effect slanted quad.obj $plain $lit --light dir:1.7320508,0,1 # 60 degrees from the normal
codes slanted 100 100 20 20 15500 31500 15500
effect behind quad.obj $plain $lit --light dir:0,0,-1
pixel behind 120 120 000000
obj dot 'v -3 -3 0' 'v 3 -3 0' 'v 3 3 0' 'v -3 3 0' 'f 1 2 3 4'
begin light_at_a_point # faces are lit at their middles, 30 in front of which it stands
effect point dot.obj $plain $lit --light point:0,0,30
pixel point 120 120 ffffff
effect faded dot.obj $plain $lit --light point:0,0,30:ffffff:60 # times (1 - 1/4)^2
codes faded 119 119 2 2 17400 35400 17400
effect far dot.obj $plain $lit --light point:0,0,30:ffffff:29
pixel far 120 120 000000
begin light_in_a_cone # aimed at the middle: what is beyond 28 degrees is dark
obj two_squares 'v -30 -5 0' 'v -20 -5 0' 'v -20 5 0' 'v -30 5 0' 'v -3 -3 0' 'v 3 -3 0' 'v 3 3 0' 'v -3 3 0' \
    'f 1 2 3 4' 'f 5 6 7 8'
effect spot two_squares.obj $plain $lit --light spot:0,0,40
pixel spot 120 120 ffffff
pixel spot 95 120 000000
begin highlights
effect dull ball.obj $plain --shade smooth --color 400000 --light 0,0,1
effect shiny ball.obj $plain --shade smooth --color 400000 --light 0,0,1 --specular 20:1
effect phong ball.obj $plain --shade smooth --color 400000 --light 0,0,1 --specular 20:1 --per-pixel
look pixel out/dull.png 120 120
case $seen in ??0000) ;; *) wrong "without highlights the middle is $seen" ;; esac
codes phong 119 119 2 2 31000 47250 23250
look pixel out/phong.png 175 120
case $seen in ??0000) ;; *) wrong "the edge shines: $seen" ;; esac
! cmp out/shiny.png out/phong.png >/dev/null || wrong '--per-pixel did nothing'

begin highlights_on_textures # a dark blue texture, on which white light falls in the middle
./fixture png rgb blue.png 1 1 000040
awk '/^f/ { print "f", $2 "/1", $3 "/1", $4 "/1", $5 "/1"; next } { print }' ball.obj |
    sed '1i vt 0.5 0.5' >skin.obj
skin='--shade textured --texture blue.png --light 0,0,1'
effect dull skin.obj $plain $skin
look pixel out/dull.png 120 120
case $seen in 0000*) ;; *) wrong "without highlights the middle is $seen" ;; esac
effect shiny skin.obj $plain $skin --specular 20:1
codes shiny 119 119 2 2 22750 46500 31000
effect phong skin.obj $plain $skin --specular 20:1 --per-pixel
codes phong 119 119 2 2 23250 47250 31000
effect colored skin.obj $plain --shade textured --texture blue.png --light dir:0,0,1:ff0000 --specular 20:1
look pixel out/colored.png 120 120
case $seen in [b-c]?00*) ;; *) wrong "red light shines $seen" ;; esac
for of in shiny phong; do # far from the highlight, the texture is as it was
    look codes out/dull.png 172 118 3 3
    # shellcheck disable=SC2086
    codes $of 172 118 3 3 $seen
done
! cmp out/shiny.png out/phong.png >/dev/null || wrong '--per-pixel did nothing'

# ---- Shadows ---------------------------------------------------------------------------------------------------------
begin shadow_planar # from above: the light comes from the right, the shadow lies to the left of the ball
sideways='--light 1,1,0 --shadow planar --shade smooth'
top='--projection orthographic --eye 0,120,1 --at 0,0,0 --fov 90 --near 20 --far 420'
effect down ball.obj $top $sideways
look codes out/down.png 21 121 3 1 # of a cell of the same shade as the next
dark=$seen
look codes out/down.png 208 121 3 1
darker 0.3 0.47

begin shadow_map # the same shadow, to a texel of 120 / 256 and its neighbours; the ball shadows itself
effect flat ball.obj $top $sideways
effect map ball.obj $top --light 1,1,0 --shadow map --shade smooth
look codes out/map.png 21 121 3 1
dark=$seen
look codes out/map.png 208 121 3 1
darker 0.25 0.5
effect colored ball.obj $plain --light 0,0,1 --shadow map --shade smooth --color ff0000
pixel colored 120 120 ff0000

# Lamps: the shadow lies where a flattened one does; a spot lights its cone alone; textures are shadowed, too
begin shadow_map_of_lamps
for lamp in point:150,150,0 spot:150,150,0 dir:1,1,0; do
    effect lamp ball.obj $top --light $lamp --shadow map --shade smooth
    look codes out/lamp.png 21 121 3 1
    dark=$seen
    look codes out/lamp.png 208 121 3 1
    [ "${lamp%%:*}" != spot ] && darker 0.2 0.6
    effect flattened ball.obj $top --light $lamp --shadow planar --shade smooth
done
effect white ball.obj $top --light point:150,150,0:ffffff --shadow map --shade smooth
effect red ball.obj $top --light point:150,150,0:ff0000 --shadow map --shade smooth
look codes out/white.png 208 121 3 1
dark=${seen%% *}
look codes out/red.png 208 121 3 1
[ "${seen%% *}" = "$dark" ] || wrong "red light has another red: $seen, $dark"
begin shadow_map_on_textures # the upper card's shadow on the lower one
obj steps 'v -50 0 50' 'v 50 0 50' 'v 50 0 -50' 'v -50 0 -50' 'v -20 40 20' 'v 20 40 20' 'v 20 40 -20' 'v -20 40 -20' \
    'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' 'f 1/1 2/2 3/3 4/4' 'f 5/1 6/2 7/3 8/4'
for lamp in --light\ 1,1,0 '--light point:120,150,0'; do
    # shellcheck disable=SC2086
    effect steps steps.obj $top $lamp --shadow map --shade textured --texture two.png --wrap clamp
    look codes out/steps.png 84 119 3 2
    dark=$seen
    look codes out/steps.png 84 86 3 2
    darker 0.2 0.62
done

# ---- Reflection ------------------------------------------------------------------------------------------------------
./fixture png rgb sphere.png 2 1 ff0000 0000ff
begin environment_by_normals
effect map ball.obj $plain --shade smooth --environment sphere.png
pixel map 80 120 ff0000
pixel map 160 120 0000ff
pixel map 118 100 ff0000
pixel map 122 100 0000ff
begin mirror_below # from 45 degrees above: the image of the middle is 2 * 61.2 * cos(45 degrees) below it
slanted='--projection orthographic --eye 0,84.85,84.85 --at 0,0,0 --fov 90 --near 20 --far 420'
effect alone ball.obj $slanted $bare --color ff0000
pixel alone 120 206 000000
effect mirror ball.obj $slanted $bare --color ff0000 --mirror
pixel mirror 120 120 ff0000
pixel mirror 120 206 ff0000
pixel mirror 120 232 ff0000
pixel mirror 30 10 000000
look count out/mirror.png ff0000
[ "$seen" -ge 17000 ] || wrong "$seen pixels show the ball or its image"

# ---- Together --------------------------------------------------------------------------------------------------------
# Which pairs are drawn is in effect_pairs.sh; here is that what is drawn is right.
begin fog_of_glass # red glass in half of the fog over nothing: (red + blue) / 2 of alpha 1/2; where it ends, black
effect glass quad.obj $plain $bare --color ff0000 --alpha 0.5 --fog linear:20:220:0000ff
codes glass 80 80 80 80 7750 0 7750
pixel glass 20 20 000000
effect added quad.obj $plain $bare --color ff0000 --alpha 0.5 --blend add --fog linear:20:220:0000ff
codes added 80 80 80 80 7750 0 0
top='--projection orthographic --eye 0,120,1 --at 0,0,0 --fov 90 --near 20 --far 420'
begin fog_behind_glass # a floor beyond the fog, 180 to 190 away, and a card of glass before all fog
obj lid 'v -50 30 50' 'v 50 30 50' 'v 50 30 -50' 'v -50 30 -50' 'v -1 -60 1' 'v 1 -60 1' 'v 0 -60 -1' \
    'f 1 2 3 4' 'f 5 6 7'
effect lid lid.obj $top $bare --color ff0000 --alpha 0.5 --fog linear:95:120:0000ff --light 0,1,0 --shadow planar
codes lid 100 100 10 10 15500 0 15500
pixel lid 100 20 0000ff
begin fog_in_a_mirror # what is seen in it is as far away as the light's way is long
slanted='--projection orthographic --eye 0,84.85,84.85 --at 0,0,0 --fov 90 --near 20 --far 420'
effect fog ball.obj $slanted $bare --color ff0000 --mirror --fog linear:130:131:0000ff
pixel fog 120 120 ff0000
pixel fog 120 206 0000ff
pixel fog 120 232 0000ff
pixel fog 30 10 000000
effect far ball.obj $slanted $bare --color ff0000 --mirror --fog linear:300:301:0000ff
effect clear ball.obj $slanted $bare --color ff0000 --mirror
same_png far clear
begin glass_in_a_mirror # half red over black, over its image, and over the mirror's grey
effect glass ball.obj $slanted $bare --color ff0000 --mirror --alpha 0.5
pixel glass 120 60 840000
effect image ball.obj $slanted $bare --color ff0000 --mirror --alpha 1
pixel image 120 206 ff0000
look pixel out/glass.png 120 232
case $seen in 9[0-9a-f]1[0-9a-f]1[0-9a-f]) ;; *) wrong "the image of glass is $seen" ;; esac
begin mirror_in_shadow # every other cell mirrors, the others have the shadow
up='--color ff0000 --shade smooth --light 0,1,0.2'
effect glass ball.obj $slanted $up --mirror
for kind in planar map; do
    effect tiles ball.obj $slanted $up --mirror --shadow $kind
    effect matt ball.obj $slanted $up --shadow $kind
    look mixed out/tiles.png out/matt.png out/glass.png
    [ "$kind" = map ] || is "pixels that are of neither" "$(word 1 $seen)" 0 # maps shade the model in another way
    [ "$(word 2 $seen)" -ge 3000 ] && [ "$(word 3 $seen)" -ge 3000 ] || wrong "of each floor with $kind: $seen"
done
begin shadows_with_highlights # at each pixel, and as without them where there is neither
effect map ball.obj $top --light dir:1,1,0 --shadow map --shade smooth
effect gloss ball.obj $top --light dir:1,1,0 --shadow map --shade smooth --specular 20:1
for at in '21 121' '208 121'; do
    # shellcheck disable=SC2086
    look codes out/map.png $at 3 1
    # shellcheck disable=SC2086
    codes gloss $at 3 1 $seen
done
effect phong ball.obj $top --light dir:1,1,0 --shade smooth --per-pixel --specular 20:1
look codes out/phong.png 140 119 3 2
# shellcheck disable=SC2086
codes gloss 140 119 3 2 $seen
begin shadows_of_two_lights # one from each side: each shadow has the light of the other
effect two ball.obj $top --light dir:1,1,0 --light dir:-1,1,0 --shadow map --shade smooth --diffuse 0.4
effect one ball.obj $top --light dir:1,1,0 --shadow map --shade smooth --diffuse 0.4
look codes out/one.png 208 121 3 1
# shellcheck disable=SC2086
codes two 21 121 3 1 $seen
# shellcheck disable=SC2086
codes two 208 121 3 1 $seen
begin shadow_map_of_faces # where nothing is in shadow, a face is what it is without
effect map quad.obj $plain --shade flat --light 0,0,1 --shadow map
effect alone quad.obj $plain --shade flat --light 0,0,1
look codes out/alone.png 80 80 80 80
# shellcheck disable=SC2086
codes map 80 80 80 80 $seen
effect default ball.obj --light 1,1,0.3 --shadow map
effect flat ball.obj --light 1,1,0.3 --shadow map --shade flat
same_png default flat
begin glass_with_highlights # half of what is opaque, on black
effect opaque ball.obj $plain --shade smooth --color 804020 --light dir:0,0,1 --specular 20:0.5
effect glass ball.obj $plain --shade smooth --color 804020 --light dir:0,0,1 --specular 20:0.5 --alpha 0.5 --cull back
look halves out/opaque.png out/glass.png
[ "$seen" -le 1 ] || wrong "$seen codes off"

# ---- Pools -----------------------------------------------------------------------------------------------------------
begin one_pass_where_pools_are_not_asked_for # the floor, shadows and the mirror's image count, near planes too
for with in '--shadow planar' '--shadow map --shade smooth' '--shadow planar --alpha 0.5 --blend screen-door' --mirror \
    '--mirror --samples 4' '--mirror --eye 90,20,20 --near 1' '--shadow planar --eye 90,20,20 --near 1'; do
    # shellcheck disable=SC2086
    effect ample ball.obj $with --stats out/ample.json
    is "passes of $with" "$(stat_of ample passes)" 1
done
effect ample ball.obj --mirror
effect small ball.obj --mirror --tris 100 --verts 120 --stats out/small.json
[ "$(stat_of small passes)" -gt 5 ] || wrong "--tris 100 takes $(stat_of small passes) passes"
is "triangles of --tris 100" "$(stat_of small tris_given)" 100
same_png ample small

# ---- Against the reference -------------------------------------------------------------------------------------------
compared() { # NAME MOST OPTION...    codes of a channel, at most; a model is among the options
    begin "compared_$1"
    most=$2
    shift 2
    z render "$@" --out out/c.png --compare --stats out/c.json
    [ $status -eq 0 ] || wrong "status $status: $(said)"
    seen=$(sed -n 's/^ *"compare_channel_max_diff": \([0-9]*\).*/\1/p' out/c.json)
    [ "${seen:-99}" -le "$most" ] || wrong "a channel is $seen codes off"
    seen=$(sed -n 's/^ *"compare_psnr_db": \([0-9]*\).*/\1/p' out/c.json)
    [ "${seen:-0}" -ge 38 ] || wrong "PSNR $seen dB"
}
lamps='--light point:40,80,90:ff8040:400 --light spot:-90,60,120:40ff80'
compared highlights 1 ball.obj $plain --shade smooth --specular 20:0.8
compared highlights_per_pixel 1 ball.obj $plain --shade smooth --per-pixel --specular 20:0.8
# shellcheck disable=SC2086
compared lamps 1 ball.obj $plain --shade smooth $lamps --specular 60:1
# shellcheck disable=SC2086
compared lamps_per_pixel 1 ball.obj $plain --shade smooth $lamps --specular 60:1 --per-pixel
# shellcheck disable=SC2086
compared lamps_of_faces 1 ball.obj $plain --shade flat $lamps
compared fog_linear 1 ball.obj $plain --shade smooth --fog linear:60:180:8080ff
compared fog_exponential 1 ball.obj $plain --fog exp:0.01:8080ff
compared bilinear 2 card.obj $plain $bare --shade textured --texture two.png --texture-format 565 --filter bilinear
# shellcheck disable=SC2086
compared textures_in_lamps 2 card.obj $plain --shade textured --texture two.png --texture-format 565 $lamps \
    --specular 9:0.5 --per-pixel
# Layers: of what the picture shows at a pixel each, by their true distances; edges of those behind are not compared by
# triangles, so that a code more is for them
for kind in alpha add; do
    compared "layers_$kind" 3 ball.obj $plain --shade smooth --alpha 0.5 --blend $kind --cull none
done
# shellcheck disable=SC2086
compared layers_in_lamps 1 ball.obj $plain --shade smooth --alpha 0.5 --cull none $lamps --specular 60:1
compared layers_in_fog 1 ball.obj $plain --shade smooth --alpha 0.5 --cull none --fog linear:60:180:8080ff
compared highlights_of_faces 1 ball.obj $plain --shade flat --specular 20:0.8
# Mipmaps: the level by the exact change of the coordinates, where ours goes by the distance alone
compared mipmap 9 skin.obj --size 160x160 --eye 300,420,760 --at 0,-20,0 --shade textured --texture fine.png \
    --filter mipmap
compared mipmap_layers 9 card.obj --eye 0,-300,80 --at 0,0,0 --shade textured --texture fine.png --filter mipmap \
    --alpha 0.5
echo 'newmtl shiny
Kd 0.2 0.4 0.6
Ks 0.8 0.8 0.8
Ns 12
Ke 0.2 0 0' >shiny.mtl
{ echo 'mtllib shiny.mtl'; sed '0,/^f/s//usemtl shiny\nf/' ball.obj; } >shiny.obj
compared highlights_of_materials 1 shiny.obj $plain --shade smooth
z render shiny.obj $plain --shade smooth --out out/with.png
z render ball.obj $plain --shade smooth --color 336699 --out out/without.png
cmp -s out/with.png out/without.png && wrong 'the material does not shine'

# ---- What is refused -------------------------------------------------------------------------------------------------
refuse() { # NAME WHAT-THE-LINE-HOLDS MODEL OPTION...    nothing but --out
    begin "refused_$1"
    what=$2
    shift 2
    z render "$@" --out refused/old.png
    one_line 1 "$what"
    untouched
}
refuse fog_backwards 'it must begin at 0 or beyond, and end after it begins' quad.obj --fog linear:5:2:ffffff
refuse fog_without_density 'the density must be more than 0' quad.obj --fog exp:0:ffffff
refuse light_without_direction 'has no direction' quad.obj --light dir:0,0,0
awk 'BEGIN { for (i = 0; i <= 110; i++) for (j = 0; j <= 110; j++) print "v", i, (7 * i + 3 * j) % 5, j
    for (i = 0; i < 110; i++)
        for (j = 1; j <= 110; j++) { a = 111 * i + j; print "f", a, a + 1, a + 112, a + 111 } }' >waves.obj
refuse flat_under_a_map 'map: a part of flat faces has 24200 triangles, and may have 21845; take --shade smooth' \
    waves.obj --shadow map
refuse five_lights 'at most 4 lights' quad.obj --light dir:1,1,1 --light dir:1,1,1 --light dir:1,1,1 --light dir:1,1,1 \
    --light dir:1,1,2
refuse light_range 'the range must be more than 0' quad.obj --light point:1,2,3:ff0000:0
refuse light_dir_range 'a directional light has no range' quad.obj --light dir:1,2,3:ff0000:3
refuse specular_power 'the power is outside its range, 1 to 128' quad.obj --shade smooth --specular 300:1
refuse specular_strength 'the strength is outside its range, 0 to 1' quad.obj --shade smooth --specular 30:1.5
refuse alpha '--alpha 2 is outside its range, 0 to 1' quad.obj --alpha 2
refuse dither_flat 'RGB565 colours are dithered with --shade smooth' quad.obj --dither blue
refuse shadow_from_below 'the light comes from below the floor' ball.obj --shade smooth --light 0,-1,0 --shadow planar
refuse fog_too_far 'ends too far away' quad.obj --fog linear:0:1e20:ffffff
refuse fog_too_thin 'too thin beside the model' quad.obj --fog exp:1e-12:ffffff
refuse samples_of_a_large_frame 'at most 2048 px wide and high' quad.obj --samples 4 --size 3000x10
usage light 'TYPE:X,Y,Z[:RRGGBB[:RANGE]]' render quad.obj --out refused/old.png --light sun:1,2,3
usage light_color 'TYPE:X,Y,Z[:RRGGBB[:RANGE]]' render quad.obj --out refused/old.png --light spot:1,2,3:ff
usage lights_mixed 'write it as dir:x,y,z' render quad.obj --out refused/old.png --light dir:1,2,3 --light 1,2,3
usage specular 'POWER:STRENGTH' render quad.obj --out refused/old.png --specular 20
usage fog 'linear:START:END:RRGGBB or exp:DENSITY:RRGGBB' render quad.obj --out refused/old.png --fog thick
usage blend_alone '--blend needs --alpha' render quad.obj --out refused/old.png --blend add
usage filter_without_texture '--filter needs --shade textured' render quad.obj --out refused/old.png --filter bilinear
usage samples_and_keys '--depth-out with --samples 4' render quad.obj --out refused/old.png --samples 4 \
    --depth-out d.pgm
usage effects_and_method 'effects are drawn by --method zbuffer' render quad.obj --out refused/old.png --samples 4 \
    --method painter
for effect in '--blend screen-door' '--samples 4' '--shadow planar' '--mirror'; do
    # shellcheck disable=SC2086
    usage "compared_$(echo "${effect%% [0-9ps]*}" | tr -d -)" "$effect is not known to the reference" \
        render quad.obj --out refused/old.png --alpha 0.5 $effect --compare
done
usage environment_flat '--environment needs --shade smooth' render quad.obj --out refused/old.png --environment two.png
usage shadow_map_unlit '--shadow map needs --shade flat, smooth or textured' render quad.obj --out refused/old.png \
    --shadow map --shade unlit
refuse shadow_map_from_inside 'move it to 78 or more' ball.obj --shade smooth --shadow map --light point:1,2,3
refuse shadow_planar_from_beside 'the light is 21.2 above the floor, and the model reaches up to 121.2' ball.obj \
    --light point:200,-40,0 --shadow planar
finish
[ $n_failed -eq 0 ]
