#!/bin/sh
# The simulator's contract, sentence by sentence, from outside: options, files, refusals.
# Usage: tests/tools/cli.sh ZSIM WORKDIR     from the repository's top
#
# Most models are drawn by the camera `plain`: 240x240, one unit to a pixel, (x, y, z) at pixel
# (120 + x, 120 - y), a quarter of the depth range away where z = 0.
. tests/tools/zsim.sh

# ---- Models --------------------------------------------------------------------------------------
obj marks 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' \
    'v 60 -10 0' 'v 80 -10 0' 'v 80 10 0' 'v 60 10 0' 'f 1 2 3' 'f 1 3 4' 'f 5 6 7' 'f 5 7 8'
# A ball of 24 x 12 quads and triangles, radius 1
awk 'BEGIN { pi = atan2(0, -1); n = 24; m = 12
    print "v 0 1 0"
    for (i = 1; i < m; i++) for (j = 0; j < n; j++)
        printf "v %.6f %.6f %.6f\n", sin(pi * i / m) * sin(2 * pi * j / n), cos(pi * i / m),
            sin(pi * i / m) * cos(2 * pi * j / n)
    print "v 0 -1 0"; last = 2 + (m - 1) * n
    for (j = 0; j < n; j++) print "f", 1, 2 + j, 2 + (j + 1) % n
    for (i = 0; i < m - 2; i++) for (j = 0; j < n; j++) {
        a = 2 + i * n + j; b = 2 + i * n + (j + 1) % n
        print "f", a, a + n, b + n, b }
    for (j = 0; j < n; j++) print "f", last - n + (j + 1) % n, last - n + j, last }' >ball.obj
grid() { # N    N x N vertices over 269.1 units of the plane
    awk -v n="$1" 'BEGIN { d = 269.1 / (n - 1)
        for (i = 0; i < n; i++) for (j = 0; j < n; j++) printf "v %.4f %.4f 0\n", j * d - 134.55, i * d - 134.55
        for (i = 0; i < n - 1; i++) for (j = 0; j < n - 1; j++) {
            a = i * n + j + 1; print "f", a, a + 1, a + n + 1; print "f", a, a + n + 1, a + n } }'
}
hills() { # the same with hills, for views along it
    awk '$1 == "v" { printf "v %s %s %.3f\n", $2, $3, 6 * sin($2 / 9) * cos($3 / 7); next } { print }'
}
grid 268 >grid.obj # 71,824 vertices, 142,578 triangles
hills <grid.obj >hills.obj
grid 100 | hills >dunes.obj
# Boxes that reach through one another, and long thin triangles
boxes 7 30 100 >mess.obj
p='\000\000\110\102' m='\000\000\110\302' o='\000\000\000\000' # 50, -50, 0 as floats
P='\102\110\000\000' M='\302\110\000\000'
ply() { # FORMAT
    printf 'ply\nformat %s 1.0\ncomment a quad\nelement vertex 4\nproperty float x\n' "$1"
    printf 'property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n'
}
{ ply ascii && printf -- '-50 -50 0\n50 -50 0\n50 50 0\n-50 50 0\n4 0 1 2 3\n'; } >quad_ascii.ply
{ ply binary_little_endian && printf "$m$m$o$p$m$o$p$p$o$m$p$o" &&
    printf '\004\000\000\000\000\001\000\000\000\002\000\000\000\003\000\000\000'; } >quad_le.ply
{ ply binary_big_endian && printf "$M$M$o$P$M$o$P$P$o$M$P$o" &&
    printf '\004\000\000\000\000\000\000\000\001\000\000\000\002\000\000\000\003'; } >quad_be.ply
{
    echo 'solid quad'
    for t in '-50 -50 0,50 -50 0,50 50 0' '-50 -50 0,50 50 0,-50 50 0'; do
        printf 'facet normal 0 0 1\n outer loop\n  vertex %s\n' "$(echo "$t" | cut -d, -f1)"
        printf '  vertex %s\n  vertex %s\n endloop\nendfacet\n' "$(echo "$t" | cut -d, -f2)" \
            "$(echo "$t" | cut -d, -f3)"
    done
    echo 'endsolid quad'
} >quad_ascii.stl
one='\000\000\200\077'
{ printf '%-80s' 'binary' && printf '\002\000\000\000' &&
    printf "$o$o$one$m$m$o$p$m$o$p$p$o\000\000$o$o$one$m$m$o$p$p$o$m$p$o\000\000"; } >quad_binary.stl
gltf() { # BUFFER-PROPERTIES
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],'
    printf '"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],'
    printf '"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",'
    printf '"min":[-50,-50,0],"max":[50,50,0]},'
    printf '{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],'
    printf '"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],'
    printf '"buffers":[{%s"byteLength":60}]}' "$1"
}
quad_bin() {
    printf "$m$m$o$p$m$o$p$p$o$m$p$o" && printf '\000\000\001\000\002\000\000\000\002\000\003\000'
}
quad_bin >quad.bin
gltf '"uri":"quad.bin",' >quad.gltf
le32() {
    printf "$(awk -v n="$1" 'BEGIN { for (i = 0; i < 4; i++) { printf "\\%03o", n % 256; n = int(n / 256) } }')"
}
json=$(gltf '')
while [ $((${#json} % 4)) -ne 0 ]; do json="$json "; done
{ printf 'glTF' && le32 2 && le32 $((${#json} + 88)) && le32 ${#json} && printf 'JSON%s' "$json" &&
    le32 60 && printf 'BIN\000' && quad_bin; } >quad.glb

# ---- Done: files and formats ---------------------------------------------------------------------
begin help_names_every_option
z render --help
is status $status 0
for option in --out --size --strip --eye --at --up --fov --near --far --projection --depth \
    --depth-bits --shade --cull --subpixel --background --tris --verts --depth-out --id-out --stats \
    --reference --show --fast --threads; do
    grep -qE -- "^ .*$option( |,|\$)" stdout || wrong "--help does not name $option"
done

# Shapes with corners that turn inwards, as polygons from each of their corners on, and made of triangles
notched() { # NAME N 'v ...' ... TRIANGLES    N corners; TRIANGLES: 'f 1 2 3,f 1 3 4'
    name=$1 n=$2
    shift 2
    points=$(printf '%s\n' "$@" | head -$n)
    for last; do :; done
    { echo "$points"; echo "$last" | tr , '\n'; } >${name}_0.obj
    draw ${name}_0 ${name}_0.obj $plain
    corners=$(seq -s ' ' $n)
    for turned in $(seq $n); do
        { echo "$points"; echo "f $corners"; } >${name}_$turned.obj
        draw ${name}_$turned ${name}_$turned.obj $plain
        cmp -s out/${name}_0.png out/${name}_$turned.png || wrong "$name begun at corner $turned is another picture"
        corners="${corners#* } ${corners%% *}"
    done
}
begin polygons_with_notches
notched notch 6 'v 0 0 0' 'v 90 0 0' 'v 90 30 0' 'v 30 30 0' 'v 30 90 0' 'v 0 90 0' \
    'f 1 2 4,f 2 3 4,f 1 4 6,f 4 5 6'
notched dart 4 'v -80 -70 0' 'v 0 -10 0' 'v 80 -70 0' 'v 0 80 0' 'f 1 2 4,f 2 3 4'
notched star 10 'v 0 100 0' 'v -20 30 0' 'v -95 31 0' 'v -35 -12 0' 'v -59 -81 0' 'v 0 -40 0' 'v 59 -81 0' \
    'v 35 -12 0' 'v 95 31 0' 'v 20 30 0' \
    'f 1 2 10,f 2 3 4,f 4 5 6,f 6 7 8,f 8 9 10,f 2 4 6,f 2 6 8,f 2 8 10'

begin frame_of_a_quad
draw quad quad.obj $plain
look png out/quad.png
is "png: width, height, colours" "$seen" "240 240 2"
look pgm out/quad.pgm 240 240
is "pgm: drawn, least and largest key" "$seen" "10000 16384 16384"
look ids out/quad.u32 240 240
is "ids: covered, distinct, largest, box" "$seen" "10000 2 2 70 70 169 169"
look drawn out/quad.u32 out/quad.pgm
look bare out/quad.png out/quad.pgm 000000
by_oracle quad quad.obj back 1 57000
# The first key drawn, 0x4000, lies at byte 17 + 2 * (70 * 240 + 70); nothing is ff ff
is "two bytes of the pgm" "$(od -An -tx1 -j33755 -N4 out/quad.pgm | tr -d ' ')" ffff4000
is "eight bytes of the ids" "$(od -An -tx1 -j67476 -N8 out/quad.u32 | tr -d ' ')" 0000000002000000

begin top_left_rule_at_pixel_centres
obj half 'v -49.5 -49.5 0' 'v 49.5 -49.5 0' 'v 49.5 49.5 0' 'v -49.5 49.5 0' 'f 1 2 3 4'
draw half half.obj $plain
look ids out/half.u32 240 240
is "ids: covered, distinct, largest, box" "$seen" "9801 2 2 70 70 168 168"

begin size_of_every_file
draw size ball.obj --size 37x23
look png out/size.png
is "png: width and height" "$(word 1 $seen) $(word 2 $seen)" "37 23"
look pgm out/size.pgm 37 23
look ids out/size.u32 37 23
is "json: width" "$(stat_of size width)" 37
draw size2 ball.obj --size 23x37
look png out/size2.png
is "png: width and height" "$(word 1 $seen) $(word 2 $seen)" "23 37"

begin only_the_files_asked_for
rm -f only.png
z render ball.obj --out only.png
is status $status 0
is files "$(ls only*)" only.png

begin files_are_replaced_whole
head -c 300000 /dev/zero >out/old.png
cp out/old.png out/old.pgm
z render quad.obj $plain --out out/old.png --depth-out out/old.pgm
is status $status 0
cmp -s out/old.png out/quad.png || wrong "the picture differs from one in a new file"
cmp -s out/old.pgm out/quad.pgm || wrong "the keys differ from those in a new file"

begin same_again
draw again quad.obj $plain
same quad again

begin defaults
draw defaults ball.obj
draw given ball.obj --size 240x240 --strip 16 --up 0,1,0 --fov 45 --projection perspective \
    --depth float --depth-bits 16 --shade flat --cull back --subpixel 8 --background 000000
same defaults given
cmp -s out/defaults.json out/given.json || wrong "their statistics differ"

begin default_camera_frames_the_model
for view in '' '--projection orthographic' '--fov 10' '--fov 120' '--size 300x60' '--size 60x300' \
    '--eye 3,1,-2' '--at 2,0,0'; do
    draw frame ball.obj $view
    w=240 h=240
    case $view in *300x60) w=300 h=60 ;; *60x300) w=60 h=300 ;; esac
    look ids out/frame.u32 $w $h
    [ "$(word 1 $seen)" -gt $((h * w / 50)) ] || wrong "only $(word 1 $seen) pixels are covered"
    case $view in --eye* | --at*) continue ;; esac
    [ "$(word 4 $seen)" -gt 0 ] && [ "$(word 5 $seen)" -gt 0 ] && [ "$(word 6 $seen)" -lt $((w - 1)) ] &&
        [ "$(word 7 $seen)" -lt $((h - 1)) ] || wrong "the model touches the frame's border: box $seen"
done
draw all ball.obj --cull none
look pgm out/all.pgm 240 240
[ "$(word 3 $seen)" -lt 65534 ] || wrong "the far plane cuts it: key $(word 3 $seen)"

begin equals_form
draw equals quad.obj --projection=orthographic --eye=0,0,120 --at=0,0,0 --fov=90 --near=20 --far=420
same quad equals
z render quad.obj $plain --out=out/e.png --depth-out=out/e.pgm --id-out=out/e.u32 --stats=out/e.json
is status $status 0
same quad e

begin minus_is_standard_output
z render quad.obj $plain --out out/f.png --stats -
cp stdout out/minus.json
is "triangles" "$(stat_of minus triangles_drawn)" 2
z render quad.obj $plain --out - --stats out/f.json
cmp -s stdout out/f.png || wrong 'the picture on standard output is another one'
[ ! -e - ] || wrong 'a file is called -'
z render quad.obj $plain --out - --stats -
one_line 1 '-: is named for two outputs'

begin model_after_the_options
z render $plain --out out/e.png --depth-out out/e.pgm --id-out out/e.u32 quad.obj
is status $status 0
same quad e

# ---- Options -------------------------------------------------------------------------------------
begin camera_eye_at_up
draw right marks.obj $plain
by_oracle right marks.obj back 1 50000
is "id at +x" "$(look id out/right.u32 240 190 125 && echo $seen)" 3
draw turned marks.obj $plain --up 1,0,0
is "id upwards after --up 1,0,0" "$(look id out/turned.u32 240 125 47 && echo $seen)" 3
draw moved marks.obj $plain --eye 100,0,120 --at 100,0,0
is "id after moving by 100 units" "$(look id out/moved.u32 240 90 125 && echo $seen)" 3
draw behind marks.obj $plain --eye 0,0,-120 --cull front
is "id at +x from behind" "$(look id out/behind.u32 240 50 125 && echo $seen)" 3
draw behind marks.obj $plain --eye 0,0,-120
is "pixels of back faces" "$(covered behind)" 0

begin fov_is_vertical
for size in 240x240 300x240 100x240; do
    draw fov quad.obj --eye 0,0,120 --at 0,0,0 --fov 90 --near 20 --far 420 --size $size
    w=${size%x240}
    look ids out/fov.u32 "$w" 240
    x=$((w / 2 - 50))
    is "box at $size" "$(word 4 $seen) $(word 5 $seen) $(word 6 $seen) $(word 7 $seen)" "$x 70 $((x + 99)) 169"
done
draw fov quad.obj --eye 0,0,120 --at 0,0,0 --fov 53.13010235415598 --near 20 --far 420
look ids out/fov.u32 240 240
is "box at tan(fov / 2) = 0.5" "$(word 4 $seen) $(word 7 $seen)" "20 219"

begin depth_bits_and_mapping
for bits in 8 9 10 11 12 13 14 15 16; do
    draw bits quad.obj $plain --depth-bits $bits
    look pgm out/bits.pgm 240 240
    is "linear keys at $bits bits" "$seen" "10000 $((1 << (bits - 2))) $((1 << (bits - 2)))"
    # (1/20 - 1/120) / (1/20 - 1/420) = 0.875
    draw bits quad.obj --eye 0,0,120 --at 0,0,0 --fov 90 --near 20 --far 420 --depth recip --depth-bits $bits
    want=$((((1 << bits) - 1) * 7 / 8))
    look pgm out/bits.pgm 240 240
    is "recip keys at $bits bits" "$seen" "10000 $want $want"
done
draw bits quad.obj --eye 0,0,120 --at 0,0,0 --fov 90 --near 20 --far 420 --depth linear
look pgm out/bits.pgm 240 240
is "linear keys in perspective" "$seen" "10000 16384 16384"

begin depth_key_range
obj ramp 'v -50 -50 100' 'v 50 -50 100' 'v 50 50 -300' 'v -50 50 -300' 'f 1 2 3 4'
for bits in 8 11 16; do
    draw ramp ramp.obj $plain --depth-bits $bits
    look pgm out/ramp.pgm 240 240
    is "pixels drawn from near to far" "$(word 1 $seen)" 10000
    [ "$(word 2 $seen)" -le $(((1 << bits) / 128 + 1)) ] || wrong "least key $(word 2 $seen) at $bits bits"
    [ "$(word 3 $seen)" -le $(((1 << bits) - 2)) ] &&
        [ "$(word 3 $seen)" -ge $((((1 << bits) - 2) * 99 / 100)) ] ||
        wrong "largest key $(word 3 $seen) at $bits bits"
done

begin near_and_far_cut
draw cut ramp.obj $plain --near 120 --far 320
look ids out/cut.u32 240 240
is "rows left between z 0 and -200" "$(word 5 $seen) $(word 7 $seen)" "95 144"
[ "$(stat_of cut triangles_clipped)" -gt 0 ] || wrong "no triangle counts as clipped"

begin shade_id_decodes_to_ids
for model in quad ball mess; do
    draw raw $model.obj --shade id --cull none
    look decode out/raw.png out/raw.u32
done

begin shade_flat_and_smooth
draw flat ball.obj --shade flat
draw smooth ball.obj --shade smooth
look png out/flat.png
flat=$(word 3 $seen)
look png out/smooth.png
[ "$flat" -gt 20 ] && [ "$(word 3 $seen)" -gt 20 ] || wrong "$flat and $(word 3 $seen) colours"
other flat smooth png
for f in pgm u32; do cmp -s out/flat.$f out/smooth.$f || wrong "shading moves .$f"; done
# Every triangle has one colour under flat
draw flatquad quad.obj $plain --shade flat
look png out/flatquad.png
is "colours of a flat quad" "$(word 3 $seen)" 2

begin cull
obj two 'v -50 -50 0' 'v 0 -50 0' 'v 0 50 0' 'v -50 50 0' 'v 50 -50 0' 'v 50 50 0' 'f 1 2 3 4' 'f 2 3 6 5'
for cull in back front none; do
    draw cull two.obj $plain --cull $cull
    look ids out/cull.u32 240 240
    case $cull in
    back) want='5000 2 2 70 70 119 169' ;;
    front) want='5000 2 4 120 70 169 169' ;;
    none) want='10000 4 4 70 70 169 169' ;;
    esac
    is "with --cull $cull" "$seen" "$want"
done

begin subpixel_bits
# The left edge is 0.02 px right of pixel centres: on them once snapped to sixteenths
obj fine 'v -49.48 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -49.48 50 0' 'f 1 2 3 4'
draw fine8 fine.obj $plain --subpixel 8
draw fine4 fine.obj $plain --subpixel 4
is "pixels with 8 bits" "$(covered fine8)" 9900
is "pixels with 4 bits" "$(covered fine4)" 10000

begin background
for color in ff0000 00ff00 0000FF ffffff 84c642; do
    draw back quad.obj $plain --background $color
    look bare out/back.png out/back.pgm $color
    is "bare pixels of $color" "$seen" 47600
    look pixel out/back.png 0 0
    [ $color = 84c642 ] || is "a bare pixel" "$seen" "$(echo $color | tr F f)"
done

begin strips_of_any_height
for model in ball mess; do
    view='--cull none'
    [ $model = mess ] && view='--shade smooth --eye 0.5,0.2,1 --at 0,0,0 --near 0.3 --far 5'
    draw strips $model.obj $view --strip 16
    for rows in 1 2 3 5 8 240 1000 100000; do
        draw strip $model.obj $view --strip $rows
        same strips strip
        n=$(((240 + rows - 1) / rows))
        is "strips of $rows rows" "$(stat_of strip strips)" $n
    done
done

begin fewer_triangles_and_vertices_take_passes
for view in '--cull none' '--shade smooth --eye 0.5,0.2,1 --at 0,0,0 --near 0.3 --far 5'; do
    draw ample mess.obj $view --size 120x120
    is "passes of ample pools" "$(stat_of ample passes)" 1
    before=1
    bytes=$(stat_of ample arena_bytes)
    for pools in '--tris 200 --verts 200' '--tris 16 --verts 20' '--tris 1 --verts 3'; do
        draw few mess.obj $view --size 120x120 $pools
        same ample few
        passes=$(stat_of few passes)
        now=$(stat_of few arena_bytes)
        [ "$passes" -gt "$before" ] || wrong "$passes passes after $before"
        [ "$now" -lt "$bytes" ] || wrong "$now bytes of arena after $bytes"
        before=$passes
        bytes=$now
    done
    for pool in '--tris 16' '--verts 20'; do
        draw few mess.obj $view --size 120x120 $pool
        same ample few
        [ "$(stat_of few passes)" -gt 1 ] || wrong "one pass with $pool"
        [ "$(stat_of few arena_bytes)" -lt "$(stat_of ample arena_bytes)" ] || wrong "no fewer bytes"
    done
done

begin threads_draw_the_same_frame
for model in ball mess; do
    draw one $model.obj --shade smooth --cull none --strip 7
    for n in 1 2 3 5 64; do
        for pool in '' '--tris 40 --verts 50'; do
            draw many $model.obj --shade smooth --cull none --strip 7 $pool --threads $n
            same one many
            is "threads" "$(stat_of many threads)" $n
            is "triangles drawn" "$(stat_of many triangles_drawn)" "$(stat_of one triangles_drawn)"
            is "strips" "$(stat_of many strips)" "$(stat_of one strips)"
        done
    done
done

# ---- False colours -------------------------------------------------------------------------------
# Eight layers of 160 x 100 px, the nearest first; they cover tiles of 32 columns
awk 'BEGIN { for (k = 0; k < 8; k++) { z = 14 - 4 * k
    printf "v -56 -50 %d\nv 104 -50 %d\nv 104 50 %d\nv -56 50 %d\nf %d %d %d %d\n", z, z, z, z, 4*k+1, 4*k+2, 4*k+3,
        4*k+4
} }' >layers.obj
color_at() { # NAME X Y
    look pixel "out/$1.png" "$2" "$3"
    echo "$seen"
}
# The legend's block of a count, of 0 to 8
block() { # NAME COUNT
    color_at "$1" $((($2 * 2 + 1) * 240 / 18)) $((240 + 18))
}
# Each pixel as its legend says, the sum as statistics say
show() { # NAME KIND SUM-OF MEAN-COUNT-IN-THE-MIDDLE OPTION...
    as=$1 kind=$2 key=$3 count=$4
    shift 4
    draw "$as" layers.obj $plain --mesh file --show "$kind" "$@"
    look png "out/$as.png"
    is "size of $as" "$(word 1 $seen) $(word 2 $seen)" "240 276"
    is "sum of $as" "$(stat_of "$as" show_sum)" "$(stat_of "$as" "$key")"
    is "most of $as" "$(stat_of "$as" show_most)" "$count"
    is "the middle of $as" "$(color_at "$as" 120 120)" "$(block "$as" "$count")"
    is "beside $as" "$(color_at "$as" 60 120)" "$(block "$as" 0)"
}
begin show_eight_layers_before_and_after
show tested tested pixels_tested 8 --fast all-tiles-touch
show overdraw overdraw pixels_written 1 --fast all-tiles
show complexity complexity pixels_tested 8 --fast all-tiles
is "eight layers" "$(stat_of tested pixels_tested)" 128000
before=$(stat_of tested show_sum)
draw after layers.obj $plain --mesh file --show tested
is "sum after" "$(stat_of after show_sum)" $(($(stat_of after pixels_tested) - $(stat_of after pixels_untested)))
[ "$(stat_of after show_sum)" -lt "$((before / 2))" ] ||
    wrong "accelerators left $(stat_of after show_sum) of $before tests"
draw after layers.obj $plain --mesh file --show complexity
is "complexity after" "$(stat_of after show_sum)" "$before"
note="$before keys tested, $(stat_of after pixels_tested) with accelerators"

# Accelerators change no bit of a frame, but what it takes
begin fast_lists_change_no_frame
draw fast_all layers.obj $plain
for list in none all-tiles all-touch all-batch-edges-clusters all-flat-texture batch touch tiles,flat; do
    draw fast layers.obj $plain --fast $list
    same fast_all fast
    case $list in
    none | batch | all-touch) is "$list: untested" "$(stat_of fast pixels_untested)" 0 ;;
    *) [ "$(stat_of fast pixels_untested)" -gt 0 ] || [ "$list" = tiles,flat ] ||
        wrong "$list: every pixel is tested" ;;
    esac
    hidden=$(stat_of fast triangles_hidden)
    case $list in
    all-tiles | none | batch | touch) is "$list: hidden" "$hidden" 0 ;;
    *) [ "$hidden" -gt 0 ] || wrong "$list: no triangle is hidden" ;;
    esac
done

begin show_leaves_the_other_files_alone
draw bare layers.obj $plain
draw shown layers.obj $plain --show strips
for f in pgm u32; do cmp -s out/bare.$f out/shown.$f || wrong "out/bare.$f and out/shown.$f differ"; done
is "sum of set-ups" "$(stat_of shown show_sum)" "$(stat_of shown triangle_setups)"

begin show_strips_as_bars
draw strips mess.obj $view --strip 40 --show strips
most=$(stat_of strips show_most)
[ "$most" -gt 8 ] || wrong "only $most set-ups"
full=0
for y in 5 45 85 125 165 205; do [ "$(color_at strips 239 $y)" != ffffff ] || full=$((full + 1)); done
[ $full -ge 1 ] || wrong "no bar as wide as the frame"
[ $full -lt 6 ] || wrong "all bars are as wide as the frame"

begin show_distance_from_near_to_far
obj steps 'v -50 -50 0' 'v 0 -50 0' 'v 0 50 0' 'v -50 50 0' 'v 0 -50 -60' 'v 50 -50 -60' 'v 50 50 -60' 'v 0 50 -60' \
    'f 1 2 3 4' 'f 5 6 7 8'
draw depth steps.obj $plain --show depth
is "nearest" "$(color_at depth 90 120)" ffffff
is "farthest" "$(color_at depth 150 120)" "$(color_at depth 239 258)"
is "nothing drawn" "$(color_at depth 10 10)" 000000
draw depth quad.obj $plain --show depth --eye 0,0,1000 --at 0,0,0
is "nothing in view" "$(color_at depth 120 120)" 000000

begin show_of_small_frames_has_room_for_its_legend
draw small ball.obj --size 1x1 --show overdraw
look png out/small.png
is size "$(word 1 $seen) $(word 2 $seen)" "220 37"

begin stats_hold_what_was_promised
draw stats mess.obj --tris 50 --verts 60
look json out/stats.json
[ "$seen" -ge 30 ] || wrong "only $seen numbers"
for key in triangles_in triangles_drawn triangles_clipped rejected_near rejected_far rejected_facing \
    rejected_offscreen rejected_zero_area rejected_empty vertices_transformed pixels_tested \
    pixels_written pixels_visible depth_complexity overdraw strips passes arena_bytes \
    tris_bytes_given tris_bytes_used verts_bytes_given verts_bytes_used color_bytes_given \
    color_bytes_used depth_bytes_given depth_bytes_used bins_bytes_given bins_bytes_used; do
    look json out/stats.json $key
done
is "triangles in" "$(stat_of stats triangles_in)" 460
is "pixels visible" "$(stat_of stats pixels_visible)" "$(covered stats)"
draw stats quad.obj $plain
is "tested, written, visible" \
    "$(stat_of stats pixels_tested) $(stat_of stats pixels_written) $(stat_of stats pixels_visible)" "10000 10000 10000"
is "complexity and overdraw" "$(stat_of stats depth_complexity) $(stat_of stats overdraw)" "1 1"
is "triangles, vertices" "$(stat_of stats triangles_drawn) $(stat_of stats vertices_transformed)" "2 4"
draw stats two.obj $plain
is "facing away" "$(stat_of stats rejected_facing)" 2
draw stats quad.obj $plain --eye 0,0,1000 --at 0,0,0
is "drawn beyond the far plane" "$(stat_of stats triangles_drawn) $(stat_of stats pixels_tested)" "0 0"
is "complexity of nothing" "$(stat_of stats depth_complexity)" 0

begin no_progress_and_no_words_in_a_pipe
{ "$zsim" render dunes.obj --size 2000x2000 --reference --out out/pipe.png 2>&1 | cat >words; } &
last=" zsim render dunes.obj --size 2000x2000 --reference --out out/tty.png"
script -qec "'$zsim' ${last# zsim }" /dev/null </dev/null >tty_words 2>&1
status=$?
wait
[ ! -s words ] || wrong "it says $(head -c 200 words)"

begin progress_on_a_terminal
is "status" $status 0
grep -q 'zsim: .*%' tty_words || wrong "no progress in $(wc -c <tty_words) bytes on a terminal"
cmp -s out/pipe.png out/tty.png || wrong "two pictures"
rm -f out/pipe.png out/tty.png

# ---- Triangle numbers ----------------------------------------------------------------------------
begin ids_in_file_order_across_groups
awk 'BEGIN {
    split("o g usemtl s", word, " ")
    for (i = 0; i < 100; i++) {
        x = i % 10 * 20 - 100; y = int(i / 10) * 20 - 100
        printf "v %d %d 0\nv %d %d 0\nv %d %d 0\nv %d %d 0\n", x, y, x + 19, y, x + 19, y + 19, x, y + 19
        print word[i % 4 + 1], i % 4 == 3 ? i % 2 : "name" i % 3
        print (i % 5 == 0) ? "f -4 -3 -2 -1" : (i % 5 == 1) ? "f -4 -3 -2\nf -4 -2 -1" : \
            "f " 4 * i + 1 " " 4 * i + 2 " " 4 * i + 3 " " 4 * i + 4 } }' >groups.obj
draw groups groups.obj $plain
by_oracle groups groups.obj back 3 5000
draw groups groups.obj $plain --reference
by_oracle groups groups.obj back 3 5000

begin convex_polygons_are_fans_from_their_first_vertex
awk 'BEGIN { pi = atan2(0, -1); for (i = 0; i < 200; i++)
        printf "v %.6f %.6f 0\n", 100 * cos(i * pi / 100), 100 * sin(i * pi / 100)
    printf "f"; for (i = 1; i <= 200; i++) printf " %d", i; print "" }' >round.obj
for cull in back none; do
    draw fan round.obj $plain --cull $cull --mesh file
    by_oracle fan round.obj $cull 2 10000
done
look ids out/fan.u32 240 240
[ "$(word 3 $seen)" -gt 190 ] || wrong "the largest number in a face of 200 vertices is $(word 3 $seen)"

begin mesh_beyond_65535_vertices
draw grid grid.obj $plain
by_one=$(awk 'BEGIN { d = 269.1 / 267; for (y = 0; y < 240; y++) for (x = 0; x < 240; x++) {
    u = (x + 0.5 - 120 + 134.55) / d; v = (120 - y - 0.5 + 134.55) / d; i = int(v); j = int(u)
    du = u - j; dv = v - i
    if (du > 0.02 && du < 0.98 && dv > 0.02 && dv < 0.98 && (du - dv > 0.02 || dv - du > 0.02))
        print x, y, 2 * (i * 267 + j) + (dv > du) + 1 } }' | ./look points out/grid.u32 240) || wrong "$by_one"
look ids out/grid.u32 240 240
is "pixels covered" "$(word 1 $seen)" 57600
[ "$(word 3 $seen)" -gt 131072 ] || wrong "the largest number is $(word 3 $seen)"
is "triangles in" "$(stat_of grid triangles_in)" 142578
z render grid.obj $plain --shade id --out out/gridid.png
look decode out/gridid.png out/grid.u32

begin no_seams_between_the_parts_of_a_large_mesh
draw hills hills.obj --eye 10,-20,70 --at 0,5,0 --near 10 --far 300 --cull none
is "pixels covered" "$(covered hills)" 57600
draw hillsref hills.obj --eye 10,-20,70 --at 0,5,0 --near 10 --far 300 --cull none --reference
is "pixels covered in the reference" "$(covered hillsref)" 57600
look differ out/hills.u32 out/hillsref.u32
[ "$seen" -lt 1000 ] || wrong "$seen ids differ from the reference"

# ---- Reference -----------------------------------------------------------------------------------
begin reference_makes_the_same_files
draw ref quad.obj $plain --reference
look png out/ref.png
is "png" "$seen" "240 240 2"
same quad ref
[ "$(stat_of ref triangles_in)" = 2 ] || wrong "statistics"
draw ref ball.obj --shade id --reference --size 37x23 --depth-bits 10
look decode out/ref.png out/ref.u32

begin reference_agrees
# MODEL, most wrong ids in 57,600, keys more than 1 apart, options
while read -r model most far view; do
    draw ours $model.obj $view
    draw ref $model.obj $view --reference
    look differ out/ours.u32 out/ref.u32
    [ "$seen" -le "$most" ] || wrong "$seen ids of $model.obj differ ($view)"
    look keys out/ours.pgm out/ref.pgm
    [ "$(word 1 $seen)" -gt 5000 ] || wrong "only $(word 1 $seen) pixels in both"
    [ "$(word 2 $seen)" -le "$far" ] || wrong "$(word 2 $seen) keys of $model are more than 1 apart ($view)"
    look slope out/ours.pgm out/ours.u32 out/ref.pgm out/ref.u32
    [ "$seen" -gt 5000 ] || wrong "only $seen keys compared"
done <<END
ball 30 0 --depth-bits 11
ball 30 2000 --shade smooth
ball 30 5 --projection orthographic --depth-bits 10
ball 30 0 --depth linear --depth-bits 11
dunes 100 30 --eye 0,-160,60 --at 0,0,0
mess 60 2000 --cull none
mess 60 2000 --eye 0.5,0.2,1 --at 0,0,0 --near 0.3 --far 5 --shade flat --precise
END

begin reference_options_and_refusals
z render quad.obj --reference --near 5 --far 4 --out refused/x.png
one_line 1 quad.obj
untouched
for bits in 8 16; do
    draw ref ramp.obj $plain --reference --depth-bits $bits
    look pgm out/ref.pgm 240 240
    [ "$(word 3 $seen)" -le $(((1 << bits) - 2)) ] || wrong "key $(word 3 $seen) at $bits bits"
done

# ---- Taken ---------------------------------------------------------------------------------------
tab=$(printf '\t')
cr=$(printf '\r')
obj negative 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' 'f -4 -3 -2 -1'
taken negative_indices negative.obj $plain
same quad negative_indices

sed "s/\$/$cr/" quad.obj >crlf.obj
taken crlf crlf.obj $plain
same quad crlf
printf '%s' "$(cat quad.obj)" >no_newline.obj
taken no_final_newline no_newline.obj $plain
same quad no_final_newline
tr '\n' '\r' <quad.obj >cr.obj
taken carriage_returns_alone cr.obj $plain
same quad carriage_returns_alone
obj blanks '# a comment' '' "v$tab-50$tab-50 ${tab}0   " '  v 50 -50 0 # corner' "$tab" 'v 50 50 0' \
    'vt 0 0' 'vn 0 0 1' 'v -50 50 0' '' 'g' 's off' "f$tab 1/1/1  2/1/1${tab}3/1/1 4/1/1 # done" '#'
taken comments_tabs_and_blanks blanks.obj $plain
same quad comments_tabs_and_blanks
obj forms 'v -50 -50 0 1' 'v 5e1 -50. +0' 'v 50 5.0E+1 -0' 'v -50.000 50 0' 'vt 0' 'vn 0 0 1' 'f 1 2/1 3//1 4/1/1'
taken number_and_corner_forms forms.obj $plain
same quad number_and_corner_forms

taken face_of_200_vertices round.obj $plain
is "triangles" "$(stat_of face_of_200_vertices triangles_in)" 198
taken strip_taller_than_the_frame quad.obj $plain --strip 4097
same quad strip_taller_than_the_frame
taken frame_of_one_pixel quad.obj --size 1x1
look png out/frame_of_one_pixel.png
is "png" "$seen" "1 1 1"
is "its id" "$(look ids out/frame_of_one_pixel.u32 1 1 && word 1 $seen)" 1
for size in 1x4096 4096x1; do
    taken frame_of_$size ball.obj --size $size
    look png out/frame_of_$size.png
    is "png" "$(word 1 $seen)x$(word 2 $seen)" $size
done
taken frame_of_4096x4096 quad.obj --size 4096x4096
look ids out/frame_of_4096x4096.u32 4096 4096
rm -f out/frame_of_4096x4096.*

obj duplicate 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' 'f 1 2 3 4' 'f 1 2 3 4' 'f 1 2 3' 'f 4 1 2'
taken duplicate_faces duplicate.obj $plain --mesh file
same quad duplicate_faces
is "triangles" "$(stat_of duplicate_faces triangles_in)" 6
obj degenerate 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' 'v 0 -50 0' 'v 0 -50 0' \
    'f 1 1 2' 'f 1 5 2' 'f 5 6 2' 'f 3 3 3' 'f 1 2 3 4' 'f 1 2 2 3'
taken degenerate_faces degenerate.obj $plain --cull none
by_oracle degenerate_faces degenerate.obj none 1 50000
is "pixels" "$(covered degenerate_faces)" 10000
obj line 'v -50 0 0' 'v 50 0 0' 'v 0 0 0' 'f 1 2 3'
taken nothing_to_see line.obj $plain --mesh file
is "pixels" "$(covered nothing_to_see)" 0
taken near_below_0_orthographic quad.obj $plain --near -20 --far 300
[ "$(covered near_below_0_orthographic)" -eq 10000 ] || wrong "$seen"
obj far_off 'v 999950 -50 0' 'v 1000050 -50 0' 'v 1000050 50 0' 'v 999950 50 0' 'f 1 2 3 4'
taken far_from_the_origin far_off.obj $plain --eye 1000000,0,120 --at 1000000,0,0
same quad far_from_the_origin

cp quad.obj 'a b %s%n 100%.obj'
taken name_with_blanks_and_percents 'a b %s%n 100%.obj' $plain
same quad name_with_blanks_and_percents
cp quad.obj -- "--dash.obj"
begin taken_name_with_dashes
z render --out out/dash.png $plain -- --dash.obj
is status $status 0
cmp -s out/dash.png out/quad.png || wrong "another picture"

for model in quad_ascii.ply quad_le.ply quad_be.ply quad_ascii.stl quad_binary.stl quad.gltf quad.glb; do
    format=format_$(echo "$model" | tr . _)
    taken "$format" $model $plain --color cccccc
    same quad "$format"
done
sed "s/\$/$cr/" quad_ascii.ply >crlf.ply
taken ply_crlf crlf.ply $plain
same quad ply_crlf

# Two solids of a facet each, in ways that assimp reads half of, or none
between() { # TEXT    what stands between them
    sed "0,/^endfacet/s//endfacet\n$1/" quad_ascii.stl
}
tr a-z A-Z <quad_ascii.stl >stl_capitals.stl
between 'endsolid quad\n; a comment\n\nsolid b' >stl_comment.stl
between 'endsolid quad\nSOLID b' >stl_mixed.stl
between 'endsolid quad\nendsolid\nsolid Facet' >stl_twice.stl
sed '9,$s/facet/Facet/; 9,$s/vertex/VERTEX/' quad_ascii.stl >stl_facets.stl
between '' | tr '\n' '~' | sed 's/endfacet~endsolid/endfacet endsolid/' | tr '~' '\n' >stl_last_line.stl
sed 's/endsolid quad/end solid/' quad_ascii.stl >stl_two_words.stl
tr '\n' ' ' <quad_ascii.stl >stl_one_line.stl
tr a-z A-Z <stl_one_line.stl >stl_one_line_of_capitals.stl
between '' | awk '{ printf "%s%s", $0, /^(solid|endfacet)/ ? "\n" : " " }' >stl_a_line_a_facet.stl
draw stl quad_ascii.stl $plain
for how in capitals comment mixed twice facets last_line two_words one_line one_line_of_capitals a_line_a_facet; do
    taken stl_$how stl_$how.stl $plain
    same stl stl_$how
done

# ---- Refused -------------------------------------------------------------------------------------
refused missing_file 'No such file' nowhere.obj
refused missing_folder 'No such file' no/where.obj
mkdir folder.obj
refused directory 'directory' folder.obj
: >empty.obj
refused empty_file 'empty' empty.obj
for end in ply stl glb gltf off xyz; do
    : >empty.$end
    refused empty_$end 'empty' empty.$end
done
obj cut1 'v 0 0 0' 'v 1 0 0' 'v 0 1'
refused truncated_vertex 'cut1.obj:3:' cut1.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2' >cut2.obj
refused truncated_face 'cut2.obj:4:' cut2.obj
obj cut3 'v 0 0 0' 'v 1 0 0' 'f 1 2 3'
refused truncated_vertices 'cut3.obj:3:' cut3.obj
for model in quad_ascii.ply quad_le.ply quad_be.ply quad_ascii.stl quad_binary.stl quad.glb quad.gltf; do
    size=$(wc -c <$model)
    head -c $((size / 2)) $model >cut_half_$model
    head -c $((size - 8)) $model >cut_end_$model
    refused "truncated_half_$(echo $model | tr . _)" '' cut_half_$model
    refused "truncated_end_$(echo $model | tr . _)" '' cut_end_$model
done
head -c 30 quad.bin >short.bin
sed 's/quad.bin/short.bin/' quad.gltf >short.gltf
refused gltf_with_a_short_buffer '' short.gltf
refused no_area 'no triangle in it has an area' line.obj
obj points 'v 0 0 0' 'v 1 0 0' 'v 0 1 0'
refused no_faces 'no faces' points.obj
obj lines 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'l 1 2 3' 'p 1'
refused no_faces_but_lines 'no faces' lines.obj
sed -e 's/element face 1/element face 0/' -e '$d' quad_ascii.ply >points.ply
refused no_faces_ply 'no faces' points.ply
sed -e 's/element face 1/element tristrips 1/' quad_ascii.ply >strips.ply
refused strips_ply 'its faces are triangle strips, which are not read; export it with faces' strips.ply
printf 'solid x\nendsolid x\n' >points.stl
refused no_faces_stl 'no faces' points.stl
{ cat quad_ascii.stl && sed -n '/^facet/,/^endfacet/p' quad_ascii.stl; } | sed '$s/$/\nendsolid/' >outside.stl
what="outside.stl:17: 'facet normal 0 0 1' is outside a solid; put \`solid\` before it"
refused outside_a_solid_stl "$what" outside.stl
cat quad_ascii.stl quad_ascii.stl | tr '\n' ' ' >stl_twice_on_a_line.stl
refused twice_on_a_line_stl 'stl_twice_on_a_line.stl:1: facets stand behind `endsolid`; begin a line there' \
    stl_twice_on_a_line.stl
sed 's/vertex 50 50 0/vertex 50 x 0/' stl_one_line.stl >word_on_a_line.stl
refused word_on_a_line_stl "word_on_a_line.stl:1: 'vertex 50 x 0 " word_on_a_line.stl
{ printf '\357\273\277' && cat quad_ascii.stl; } >mark.stl
refused byte_order_mark_stl 'begins with a UTF-8 byte order mark; save it without one, as by tail -c +4' mark.stl
for model in quad.obj quad_ascii.ply quad_ascii.stl quad.gltf; do
    iconv -f UTF-8 -t UTF-16 $model >"wide.${model##*.}"
    refused "utf16_${model##*.}" 'is UTF-16 text; save it as UTF-8' "wide.${model##*.}"
done
iconv -f UTF-8 -t UTF-32BE quad.obj >wide.obj
refused utf32 'is UTF-32 text; save it as UTF-8' wide.obj
echo 'no model' >words.txt
refused unknown_format 'is of no format that is known by its name or its bytes; zsim reads OBJ, PLY' words.txt
printf 'newmtl A\nKd 1 0 0\n' | iconv -f UTF-8 -t UTF-16LE >wide.mtl
obj wide_mtl 'mtllib wide.mtl' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'usemtl A' 'f 1 2 3'
what='wide.mtl: is UTF-16 text'
z render wide_mtl.obj --out refused/old.png
[ $status -eq 1 ] && [ "$(wc -l <stderr)" -eq 1 ] && grep -q "$what" stderr || wrong "UTF-16 materials: $(said)"
face() { # NAME WHAT F-LINE
    obj "face_$1" 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'vn 0 0 1' 'vt 0 0' 'f 1 2 3' "$3"
    refused "$1" "face_$1.obj:7:" "face_$1.obj"
    grep -qF -- "$2" stderr || wrong "'$2' is not in: $(said)"
}
face index_0 'index 0' 'f 0 1 2'
face index_beyond '4' 'f 1 2 4'
face index_negative_beyond '-4' 'f -4 -1 -2'
face index_huge 'out of range' 'f 1 2 99999999999999999999'
face index_wraps 'out of range' 'f 1 2 4294967297'
face index_of_normal 'ormal' 'f 1//2 2//1 3//1'
face index_of_texture 'exture' 'f 1/2 2/1 3/1'
face index_fraction '1.5' 'f 1.5 2 3'
face of_2_vertices '2' 'f 1 2'
face of_1_vertex '1' 'f 1'
face of_0_vertices '0' 'f'
face corner_of_words 'one' 'f one two three'
for v in nan NaN -nan inf -Infinity 1e999 -1e400; do
    as=$(echo "$v" | tr - m)
    obj "num_$as" 'v 0 0 0' 'v 1 0 0' "v 0 1 $v" 'f 1 2 3'
    refused "number_$as" "num_$as.obj:3:" "num_$as.obj"
done
obj num_normal 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'vn 0 nan 1' 'f 1//1 2//1 3//1'
refused nan_in_a_normal 'num_normal.obj:4:' num_normal.obj
obj num_texture 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'vt inf 0' 'f 1/1 2/1 3/1'
refused infinity_in_a_texture 'num_texture.obj:4:' num_texture.obj
obj num_word 'v 0 0 0' 'v 1 0 0x' 'v 0 1 0' 'f 1 2 3'
refused word_for_a_number 'num_word.obj:2:' num_word.obj
sed 's/^50 50 0/50 nan 0/' quad_ascii.ply >nan.ply
refused nan_ply 'nan.ply:13:' nan.ply
sed 's/^4 0 1 2 3/4 0 1 2 4/' quad_ascii.ply >index.ply
refused index_beyond_ply 'index.ply:15:' index.ply
sed 's/^4 0 1 2 3/2 0 1/' quad_ascii.ply >pair.ply
refused face_of_2_vertices_ply 'pair.ply:15:' pair.ply
sed 's/^  vertex 50 -50 0/  vertex nan -50 0/' quad_ascii.stl >nan.stl
refused nan_stl '' nan.stl
nan='\000\000\300\177' inf='\000\000\200\177'
for v in nan inf; do
    eval bits=\$$v
    { printf '%-80s' 'binary' && printf '\001\000\000\000' &&
        printf "$o$o$one$m$m$o$p$bits$o$p$p$o\000\000"; } >${v}_binary.stl
    refused ${v}_binary_stl 'finite' ${v}_binary.stl
    { ply binary_little_endian && printf "$m$m$o$p$bits$o$p$p$o$m$p$o" &&
        printf '\004\000\000\000\000\001\000\000\000\002\000\000\000\003\000\000\000'; } >${v}_le.ply
    refused ${v}_binary_ply 'finite' ${v}_le.ply
    { printf "$m$m$o$p$bits$o$p$p$o$m$p$o" && printf '\000\000\001\000\002\000\000\000\002\000\003\000'; } >$v.bin
    sed "s/quad.bin/$v.bin/" quad.gltf >$v.gltf
    refused ${v}_gltf 'finite' $v.gltf
done
{ printf "$m$m$o$p$m$o$p$p$o$m$p$o" && printf '\000\000\001\000\002\000\000\000\002\000\004\000'; } >index.bin
sed 's/quad.bin/index.bin/' quad.gltf >index.gltf
refused index_beyond_gltf '' index.gltf
head -c 5000 "$zsim" >garbage.obj
refused binary_garbage_obj '' garbage.obj
for end in ply stl glb gltf; do
    cp garbage.obj garbage.$end
    refused binary_garbage_$end '' garbage.$end
done
echo 'just text' >words.txt
refused unknown_format '' words.txt

refused near_0 'near' quad.obj --near 0
refused near_below_0 'near' quad.obj --near -1 --far 10
refused near_below_0_reference 'near' quad.obj --near -1 --far 10 --reference
refused near_equals_far 'near' quad.obj --near 3 --far 3
refused near_equals_far_orthographic "near" quad.obj --near 3 --far 3 --projection orthographic
refused near_beyond_far 'near' quad.obj --near 4 --far 3
refused near_beyond_far_orthographic 'near' quad.obj --near 4 --far 3 --projection orthographic
refused near_nan 'near' quad.obj --near nan
refused far_infinite 'far' quad.obj --far inf
refused far_0 'far' quad.obj --far 0
for size in 0x0 0x240 240x0 4097x1 1x4097 -5x10 99999999999999999999x1; do
    refused size_"$(echo $size | tr - m)" 'size' quad.obj --size $size
done
for rows in 0 -1 -99999999999999999999; do
    refused strip_"$(echo $rows | tr - m)" 'strip' quad.obj --strip $rows
done
for fov in 0 -1 180 360 nan inf; do
    refused fov_"$(echo $fov | tr - m)" 'fov' quad.obj --fov $fov
done
refused eye_equals_at 'eye' quad.obj --eye 1,2,3 --at 1,2,3
refused eye_equals_the_middle 'eye' quad.obj --eye 0,0,0
refused eye_nan 'eye' quad.obj --eye 1,nan,3
refused at_infinite 'at' quad.obj --at 1,inf,3
refused up_parallel 'up' quad.obj --eye 0,5,0 --at 0,0,0
refused up_antiparallel 'up' quad.obj --eye 3,3,3 --at 0,0,0 --up -1,-1,-1
refused up_0 'up' quad.obj --up 0,0,0
refused up_nan 'up' quad.obj --up 0,nan,0
refused depth_bits_7 'depth-bits' quad.obj --depth-bits 7
refused depth_bits_17 'depth-bits' quad.obj --depth-bits 17
refused tris_0 'tris' quad.obj --tris 0
refused verts_2 'verts' quad.obj --verts 2
refused tris_too_many 'tris' quad.obj --tris 65535
refused orthographic_recip 'linear' quad.obj --projection orthographic --depth recip
refused scale_huge '1e+30' quad.obj --eye 1e31,0,0
refused eye_too_far 'the eye' quad.obj --eye 1e20,0,1 --at 0,0,0
refused far_too_far '' quad.obj --far 1e25
obj huge 'v 0 0 0' 'v 1e35 0 0' 'v 0 1 0' 'f 1 2 3'
refused model_too_large 'scale' huge.obj
obj point 'v 1 1 1' 'v 1 1 1' 'v 1 1 1' 'f 1 2 3'
refused model_of_one_point 'one point' point.obj
obj tiny 'v 0 0 0' 'v 1e-40 0 0' 'v 0 1e-40 0' 'f 1 2 3'
refused model_too_small 'scale' tiny.obj
obj lost "v 1 0 0" "v 1.0000000000000002 0 0" "v 1 2.2e-16 0" "f 1 2 3"
refused model_lost_beside_its_offset "move the model" lost.obj

obj 'bad % s %n' 'v 0 0'
refused name_with_percents 'bad % s %n.obj:1:' 'bad % s %n.obj'
begin refused_name_with_newline
newline='a
b.obj'
printf 'v 0 0\n' >"$newline"
z render "$newline" --out refused/x.png
one_line 1 'b.obj:1:'
untouched

# ---- Output that cannot be written ---------------------------------------------------------------
unwritable() { # NAME WHAT OPTION...
    begin "unwritable_$1"
    what=$2
    shift 2
    z render quad.obj "$@"
    one_line 1 "$what"
    untouched
}
unwritable folder_missing no/f.png --out no/f.png
unwritable directory folder.obj --out folder.obj
unwritable slash refused/x/ --out refused/x/
unwritable file_as_folder quad.obj/f.png --out quad.obj/f.png
unwritable id_folder_missing no/i.u32 --out refused/old.png --id-out no/i.u32
unwritable depth_folder_missing no/d.pgm --out refused/old.png --depth-out no/d.pgm
unwritable stats_folder_missing no/s.json --out refused/old.png --stats no/s.json
unwritable disk_full /dev/full --out refused/old.png --id-out /dev/full
unwritable disk_full_depth /dev/full --depth-out /dev/full --id-out refused/i.u32 --out refused/old.png
unwritable disk_full_picture /dev/full --out /dev/full --stats refused/s.json
begin unwritable_beyond_a_limit_of_size
last=" (ulimit -f 10; zsim render ball.obj --out refused/old.png --id-out refused/i.u32)"
(
    ulimit -f 10
    "$zsim" render ball.obj --out refused/old.png --id-out refused/i.u32 >stdout 2>stderr
)
status=$?
one_line 1 refused/i.u32
untouched
begin killed_while_it_writes
mkfifo fifo # opening it waits for a reader, when the picture is already on the disk
last=" zsim render ball.obj --out refused/old.png --depth-out fifo & sleep 1; kill $!"
"$zsim" render ball.obj --out refused/old.png --depth-out fifo >stdout 2>stderr &
pid=$!
sleep 1
[ "$(ls -A refused | wc -l)" -eq 2 ] || wrong "it does not write beside the old file"
kill $pid
wait $pid 2>/dev/null
is "status" $? 143
untouched

unwritable one_name_twice refused/old.png --out refused/old.png --id-out refused/old.png
unwritable model_as_output quad.obj --out quad.obj
is "the model" "$(head -c 11 quad.obj)" "v -50 -50 0"

# ---- Usage ---------------------------------------------------------------------------------------
usage no_command 'command'
usage unknown_command 'draw' draw quad.obj
usage no_model 'model' render --out refused/x.png
usage no_out 'out' render quad.obj
usage out_jpeg 'the frame is a PNG' render quad.obj --out refused/x.JPG
usage out_gif 'turntable writes GIF' render quad.obj --out refused/x.gif
usage nothing 'model' render
usage two_models 'two' render quad.obj two.obj --out refused/x.png
usage empty_model 'model' render '' --out refused/x.png
usage empty_out 'out' render quad.obj --out ''
for option in --wat --outt --siz --Size -o --depthbits; do
    usage "unknown$(echo $option | tr - _)" "$option" render quad.obj --out refused/x.png $option 1
done
for option in --out --size --strip --eye --at --up --fov --near --far --projection --depth \
    --depth-bits --shade --cull --subpixel --background --tris --verts --fast --depth-out --id-out --stats; do
    as=$(echo "${option#--}" | tr - _)
    usage "value_missing_$as" "$option" render quad.obj --out refused/x.png $option
    case $as in out | depth_out | id_out | stats) continue ;; esac
    usage "value_of_words_$as" "$option" render quad.obj --out refused/x.png $option words
    usage "value_empty_$as" "$option" render quad.obj --out refused/x.png $option=
done
n=0
for pair in '--size 240' '--size 240x' '--size x240' '--size 1x2x3' '--size 1.5x2' '--strip 1.5' \
    '--strip 4rows' '--eye 1,2' '--eye 1,2,3,4' '--eye 1,,3' '--at 1;2;3' '--up 0,1,0,' '--fov 45deg' \
    '--near 0x10' '--far 1,5' '--depth-bits 9.5' '--tris 1e3' '--subpixel 5' '--subpixel 88' \
    '--background 12345' '--background 1234567' '--background 0x1234' '--shade Flat' '--cull both' \
    '--projection ortho' '--depth recipe' '--depth lin' '--fast nothing' '--fast all-' '--fast all-tile' \
    '--fast batch,' \
    '--fast all,batch' '--fast allbatch' '--fast All'; do
    n=$((n + 1))
    as=$(echo "${pair#--}" | tr -c 'A-Za-z0-9\n' _)
    usage "${as}_$n" "${pair%% *}" render quad.obj --out refused/x.png $pair
done
usage show_of_no_kind --show render quad.obj --out refused/x.png --show depths
usage show_of_the_reference --show render quad.obj --out refused/x.png --show tested --reference
usage show_through_a_panel --show render quad.obj --out refused/x.png --show tested --panel st7789:240x240
usage threads_of_the_reference --threads render quad.obj --out refused/x.png --threads 2 --reference
usage threads_through_a_panel --threads render quad.obj --out refused/x.png --threads 2 --panel st7789:240x240
usage flag_with_a_value --reference render quad.obj --out refused/x.png --reference=1

finish
[ $n_failed -eq 0 ]
