#!/bin/sh
# zsim convert, from outside: what it writes is compiled, checked and drawn, and compared with what zsim draws
# of the original.
# Usage: tests/tools/convert.sh BUILD ZSIM     from the repository's top; BUILD/zsim, BUILD/test/zsim,
#        BUILD/libcore.a, BUILD/test/libtest.a
#
# `ok NAME` or `FAILED NAME: reason` a test; models and programs stay in BUILD/test/convert.
set -u
build=$(cd "$1" && pwd) || exit 1
SAN='-fsanitize=address,undefined -fsanitize-undefined-trap-on-error -fno-pie -no-pie -Wl,-u,leak_roots' # as tests.mk
set -- "$2" "$build/test/convert"
. tests/tools/zsim.sh
. "$top/tests/lib/positional.sh"
designated_headers headers "$top" || exit 1
gcc -O1 -Wall -Wextra -Werror -I"$top/firmware/zstrip" -I"$build/gen" "$top/tests/tools/convert/make.c" \
    "$build/libmeshes.a" "$build/libcore.a" -lpng -lturbojpeg -lm -o make || exit 1

above() { # WHAT HAVE LIMIT
    awk -v a="$2" -v b="$3" 'BEGIN { exit !(a == a + 0 && a + 0 > b + 0) }' || wrong "$1 is $2, not above $3"
}
holds() { # FILE TEXT    fixed text that a file must hold
    grep -qF -- "$2" "$1" || wrong "no '$2' in $1"
}
lacks() { # FILE TEXT
    ! grep -qF -- "$2" "$1" || wrong "there is '$2' in $1"
}
run() { # PROGRAM ARGUMENT...    of the tests, which is not asked for leaks: its words in $seen
    seen=$(ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 "$@" 2>run.err) || wrong "$*: $seen $(head -c 300 run.err)"
}

# Convert as name m into to/, map to to.u32; nothing may be said on stderr.
convert() { # TO INPUT OPTION...
    to=$1
    shift
    rm -rf "$to" "$to.u32"
    case $1 in
    *.png | *.jpg) z convert "$@" --name m --out "$to" ;;
    *) z convert "$@" --name m --out "$to" --map "$to.u32" ;;
    esac
    [ $status -eq 0 ] || wrong "status $status: $(head -c 300 stderr)"
    [ ! -s stderr ] || wrong "it talks in a pipe: $(head -c 300 stderr)"
    [ -s "$to/m.h" ] && [ -s "$to/m.c" ] || wrong "m.h or m.c is missing"
    place_of "$to"
}
place_of() { # TO
    to=$1
    place=$(awk '
        /a unit of the model is [^ ]* of them/ { unit = $0; sub(/.*model is /, "", unit); sub(/ .*/, "", unit) }
        sub(/^ \* Positions *in the model.s units: /, "") {
            print $1, $2, $3, $5, unit; exit }' "$to/m.h")
}

# Three compilers' warnings, then by the fourth a program of the converted file and the library, which has sanitizers.
# The file names the fields that it sets, which C++ takes since C++20; its header is for older C++ too. The three take
# each form of file once, to an assembler's text, which ccache keeps: what differs in numbers alone, and in how many
# rows an array has, has the same form; a file of megabytes has that of others, with more meshes. The fourth takes all,
# and a number that does not fit is an error there.
touch forms # what is left of them without numbers, names and comments, a line each
looked_at() { # TO    what of it has a form of its own, in $new; what the compiler is told for it, in $varyings
    new=$(awk 'BEGIN { while ((getline line <"forms") > 0) known[line] = 1 }
        FNR == 1 { last = "" }
        /ZS_VARYINGS_TEXTURE_GLOSS/ && FILENAME ~ /[.]h$/ { gloss = 1 }
        (bytes += length($0) + 1) >= 2000000 { exit }
        /^ *\*/ || /^ *\/\*/ { next }
        { gsub(/[0-9][0-9a-fx.]*/, "0"); gsub(/-0/, "0"); gsub(/"[^"]*"/, "\"\"")
          gsub(/[{][ 0{},]*[}]/, "{ 0 }"); gsub(/0(, 0)+/, "0") }
        $0 == last { next }
        { form = form "\001" (last = $0) }
        FILENAME ~ /[.]h$/ { header = form }
        END {
            if (gloss) printf "varyings "
            if (bytes >= 2000000) exit
            if (!(form in known)) { printf "file "; print form >>"forms" }
            if (!(header in known)) { printf "header"; print header >>"forms" }
        }' "$1/m.h" "$1/m.c")
    varyings=
    case $new in varyings*) varyings=-DZS_VARYINGS_MAX=4 ;; esac
}
linker= # the quicker one, where it is
! command -v ld.gold >/dev/null || linker=-fuse-ld=gold
compile() { # TO PROGRAM.c
    looked_at "$1"
    case $new in *file*) syntax "$1" ;; esac
    case $new in *header*) header_syntax "$1" ;; esac
    { [ -f "$1/m.o" ] || # of the round trip
        gcc -std=c11 -O0 -c -Wall -Wextra -Wpedantic -Werror -Iheaders $varyings "$1/m.c" -o "$1/m.o" \
            >cc.log 2>&1; } &&
        gcc -std=gnu11 -O0 -c -Wall -Wextra -Werror -DZS_VARYINGS_MAX=8 -I"$top/firmware/zstrip" -I"$1" \
            "$top/tests/tools/convert/$2.c" -o "$1/$2.o" >cc.log 2>&1 &&
        gcc $SAN $linker "$1/$2.o" "$1/m.o" "$build/test/libtest.a" -lm -o "$1/$2" >cc.log 2>&1 ||
        wrong "$(head -c 400 cc.log)"
}
syntax() { # TO
    for compiler in 'g++ -x c++ -std=c++20' 'clang -std=c11' 'clang++ -x c++ -std=c++20'; do
        $compiler -Wall -Wextra -Wpedantic -Werror -Wno-missing-field-initializers -MMD -S $varyings \
            -I"$top/firmware/zstrip" "$1/m.c" -o "$1/looked.s" >cc.log 2>&1 ||
            wrong "$compiler: $(head -c 400 cc.log)"
    done
}
header_syntax() { # TO
    echo '#include "m.h"' >"$1/header.cc"
    for compiler in 'g++ -std=c++14' 'clang++ -std=c++14'; do
        $compiler -Wall -Wextra -Wpedantic -Werror -MMD -S $varyings -I"$top/firmware/zstrip" \
            "$1/header.cc" -o "$1/looked.s" >cc.log 2>&1 || wrong "$compiler, the header: $(head -c 400 cc.log)"
    done
}
for_a_cortex_m() { # TO    of compile; to/arm.o, if it is not there from the round trip
    [ -f "$1/arm.o" ] || arm-none-eabi-gcc -mcpu=cortex-m3 -mthumb -std=c11 -Os -fdata-sections -c $varyings \
        -I"$top/firmware/zstrip" "$1/m.c" -o "$1/arm.o" || wrong "the Cortex-M compiler refuses it"
}
# What is printed as flash is what a Cortex-M's linker would take.
same_flash() { # TO
    for_a_cortex_m "$1"
    linked=$(arm-none-eabi-nm --plugin= -S --defined-only "$1/arm.o" |
        awk 'function hex(s,  i, n) {
                 for (i = 1; i <= length(s); i++) n = 16 * n + index("123456789abcdef", substr(s, i, 1))
                 return n
             }
             { sum += hex($2) } END { print sum }')
    printed=$(awk '$1 == "flash" { is = $2 } $NF == "bytes" && $1 != "flash" { s += $(NF - 1) }
        END { print is, s }' stdout)
    is "flash" "${printed% *}" "$linked"
    is "flash, by its parts" "${printed#* }" "${printed% *}"
    printed=${printed% *}
    note="$printed bytes"
}
sound() { # TO
    run "$1/probe" check
}
# Every pixel of every view: the same triangle, or a reason. What zsim draws is the same without sanitizers; of the file
# that it converts, the program of that has them.
same_pixels() { # TO INPUT
    all=0 view=0
    # shellcheck disable=SC2086
    run "$1/probe" views 0 $place
    options_of_views=$seen
    while read -r options; do
        # shellcheck disable=SC2086
        "$build/zsim" render "$2" $options --out "$1/o.png" --id-out "$1/$view.u32" >stdout.render 2>&1 ||
            wrong "$(cat stdout.render)"
        view=$((view + 1))
    done <<END
$options_of_views
END
    # shellcheck disable=SC2086
    run "$1/probe" compare 0 $place "$1.u32" "$1/0.u32" "$1/1.u32" "$1/2.u32" "$1/3.u32"
    compared=0
    while read -r pixels differ _; do
        case $pixels$differ in *[!0-9]*) continue ;; esac # a reason, which run has told
        [ "$pixels" -gt 500 ] || wrong "$pixels pixels of a view, not above 500"
        all=$((all + differ)) compared=$((compared + 1))
    done <<END
$seen
END
    is "views" "$view $compared" '4 4'
    note="$note${note:+, }$all pixels differ, all at edges or equally far"
}
# The pictures too, by the model's own shaders and textures, against zsim's of the original, in the same views.
same_colours() { # TO INPUT SHADE    after same_pixels
    view=0
    while read -r options; do
        # shellcheck disable=SC2086
        "$build/zsim" render "$2" $options --shade "$3" --light 4,7,7 --background 0a143c --out "$1/o.png" \
            >stdout.render 2>&1 || wrong "$(cat stdout.render)"
        "$1/probe" draw $view >"$1/o.ppm" || wrong "$1/probe draw $view"
        run ./make psnr "$1/o.png" "$1/o.ppm"
        above "PSNR of view $view" "$seen" 42
        note="$note, $seen dB"
        view=$((view + 1))
    done <<END
$options_of_views
END
    is "views" $view 4
}
same_places() { # TO FILE.obj STEP-SHARE    coordinates to half a step, or a share of it
    # shellcheck disable=SC2086
    run "$1/probe" places 0 $place "$2" "$1.u32"
    far=$(echo "$seen $3 $place" | awk '
        function below(what, have, limit) {
            if (!(have == have + 0 && have + 0 < limit)) print what " is " have ", not below " limit
        }
        { below("error of a coordinate", $1, $(8) * $4)
          below("error of u or v", $2, 0.0001)
          below("error of a normal, degrees", $3, 0.003) }')
    [ -z "$far" ] || wrong "$far"
}
round_trip() { # NAME INPUT OPTION...
    begin "$1"
    convert "$@"
    trip=$1
    shift
    printf '%s\t%s\n' "$trip" "$*" >>trips
    set -- "$trip" "$@"
    compile "$1" probe
    same_flash "$1"
    sound "$1"
    same_pixels "$1" "$2"
    case $2 in *.obj) same_places "$1" "$2" 0.5002 ;; esac
}

# Three checksums with colours of zsim's frames, three with triangles of the program's. Leaves frames in $before, the
# last triangles in $facing.
same_sums() { # SUM COLOURS... SUM FACING...
    before='' facing=''
    [ $# -eq 12 ] || { wrong "not three frames of each, but $*"; return; }
    is "checksum of view 0" "$1" "$7"
    is "checksum of view 1" "$3" "$9"
    is "checksum of view 2" "$5" "${11}"
    for colors in "$2" "$4" "$6"; do
        [ "$colors" -gt 8 ] || wrong "a view has $colors colours, not above 8"
    done
    [ "$1" != "$3" ] && [ "$3" != "$5" ] && [ "$5" != "$1" ] || wrong "a view shows what another shows"
    before=" $1 $3 $5" facing=${12}
}

# One road: the frame of a program around the converted file is that of zsim render, bit by bit, in several views; and
# zsim budget counts the bytes of the object. What a round trip has converted is not converted again.
one_road() { # NAME INPUT OPTION...    options of render and convert alike
    begin "one_road_$1"
    road=road_$1
    shift
    same=$(awk -F '\t' -v what="$*" '$2 == what { print $1 }' trips)
    if [ -n "$same" ]; then
        road=$same
        place_of "$road"
    else
        convert "$road" "$@"
    fi
    compile "$road" same
    # shellcheck disable=SC2086
    run "$road/same" views $place
    view=0
    while read -r camera; do # in the last view triangles are counted, in the program's strips
        [ $view -lt 2 ] || camera="$camera --strip 20 --stats $road/o.json"
        # shellcheck disable=SC2086
        "$build/zsim" render "$@" $camera --out "$road/$view.png" >stdout.render 2>&1 || wrong "$(cat stdout.render)"
        view=$((view + 1))
    done <<END
$seen
END
    is "views" $view 3
    run ./make sum "$road/0.png" "$road/1.png" "$road/2.png"
    of_render=$seen
    run "$road/same" draw
    # shellcheck disable=SC2086
    same_sums $of_render $seen
    look json "$road/o.json" rejected_facing
    is "triangles that no cluster left out" "$seen" "$facing"
    for_a_cortex_m "$road"
    linked=$(arm-none-eabi-size -A "$road/arm.o" | awk '/^\.(text|rodata|data|bss)/ { sum += $2 } END { print sum }')
    "$build/zsim" budget "$@" --csv >stdout 2>stderr || wrong "$(cat stderr)"
    is "scene data of zsim budget" "$(awk -F, '$1 == "flash_data" { print $2 }' stdout)" "$linked"
    note="frames$before; $linked bytes"
}

# ---- Models ------------------------------------------------------------------------------------
./make torus 48 24 4 - >torus.obj
printf 'newmtl skin\nmap_Kd photo.png\n' >torus.mtl
./make torus 48 24 4 torus.mtl >skinned.obj
./make torus 330 200 1 - >large.obj # more vertices than an index of 16 bits can name
./make teapot >teapot.obj
./make soup 300 5 >soup.obj
./make boxes 3 2 >boxes3.obj
./make boxes 300 3 >boxes300.obj
./make boxes 130 130 >colors130.obj
./make boxes.mtl 130 >boxes.mtl
mkdir gltf
./make gltf gltf
awk '$1 == "v" { n++; for (k = 0; k < 3; k++) p[n, k] = $(k + 2) }
    $1 == "f" { print "facet normal 0 0 0\nouter loop"
        for (i = 2; i < 5; i++) print "vertex", p[$i, 0], p[$i, 1], p[$i, 2]
        print "endloop\nendfacet" }
    BEGIN { print "solid teapot" } END { print "endsolid teapot" }' teapot.obj >teapot.stl
awk '$1 == "v" { v = v $2 " " $3 " " $4 " " 20 * (n % 12) " 90 200\n"; n++ }
    $1 == "f" { f = f "3 " $2 - 1 " " $3 - 1 " " $4 - 1 "\n"; m++ }
    END { print "ply\nformat ascii 1.0\nelement vertex " n "\nproperty float x\nproperty float y\nproperty float z"
        print "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face " m
        printf "property list uchar int vertex_indices\nend_header\n%s%s", v, f }' teapot.obj >teapot.ply
le32() {
    printf "$(awk -v n="$1" 'BEGIN { for (i = 0; i < 4; i++) { printf "\\%03o", n % 256; n = int(n / 256) } }')"
}
glb_of() { # FILE.gltf FILE.bin    its pictures stay files
    json=$(sed "s/\"uri\":\"${2##*/}\",//" "$1")
    while [ $((${#json} % 4)) -ne 0 ]; do json="$json "; done
    bytes=$(wc -c <"$2")
    printf 'glTF' && le32 2 && le32 $((${#json} + bytes + 28)) && le32 ${#json} && printf 'JSON%s' "$json" &&
        le32 "$bytes" && printf 'BIN\000' && cat "$2"
}
mkdir looks
cp gltf/red.png looks
./make leaf 64 64 hole looks/hole.png
./make leaf 64 32 fade looks/fade.png
./make leaf 64 64 fade looks/square.png
pbr() { # PROPERTIES
    echo "\"pbrMetallicRoughness\":{\"metallicFactor\":0,$1}"
}
both_sides="{\"name\":\"both sides\",\"doubleSided\":true,$(pbr '"baseColorFactor":[1,0.6,0.2,1]')}"
cut='"alphaMode":"MASK","alphaCutoff":0.5'
opaque='"alphaMode":"OPAQUE"'
all_maps='"normalTexture":{"index":2},"occlusionTexture":{"index":2},"emissiveTexture":{"index":2}'
./make looks looks looks - "{\"name\":\"leaf\",$cut,$(pbr '"baseColorTexture":{"index":0}')}" \
    "{\"name\":\"fade\",\"alphaMode\":\"BLEND\",\"doubleSided\":true,$(pbr '"baseColorTexture":{"index":1}')}" \
    "{\"name\":\"glass\",\"alphaMode\":\"BLEND\",$(pbr '"baseColorFactor":[0.2,0.6,1,0.4]')}" "$both_sides" \
    "{\"name\":\"lamp\",\"emissiveFactor\":[1,0.8,0.2],$(pbr '"baseColorFactor":[0,0,0,1]')}" \
    "{\"name\":\"unlit\",\"extensions\":{\"KHR_materials_unlit\":{}},$(pbr '"baseColorTexture":{"index":2}')}" \
    "{\"name\":\"solid\",$opaque,$(pbr '"baseColorTexture":{"index":0},"baseColorFactor":[1,1,1,0.3]')}"
./make looks looks lossy both \
    "{\"name\":\"gloss\",\"emissiveFactor\":[0,0,0.2],$(pbr \
        '"roughnessFactor":0.4,"baseColorFactor":[0.7,0.1,0.1,1]')}" \
    "{\"name\":\"maps\",$all_maps,$(pbr \
        '"metallicRoughnessTexture":{"index":2},"baseColorTexture":{"index":3}')}" "$both_sides" \
    "{\"name\":\"wet\",\"emissiveFactor\":[0.2,0,0],$(pbr '"roughnessFactor":0.3,"baseColorTexture":{"index":2}')}" \
    "{\"name\":\"damp\",$(pbr '"roughnessFactor":0.6,"baseColorTexture":{"index":2}')}"
cut='"alphaMode":"MASK","alphaCutoff":0.3'
./make looks looks fence - "{\"name\":\"fence\",$cut,$(pbr '"baseColorTexture":{"index":1}')}"
metal() { # NAME ROUGHNESS MORE
    echo "{\"name\":\"$1\",$3\"pbrMetallicRoughness\":{\"metallicFactor\":1,\"roughnessFactor\":$2,"
    echo '"baseColorFactor":[1,0.5,0,1]}}'
}
./make looks looks metal - "$(metal gold 0.6 '"doubleSided":true,')" "$(metal mirror 0 '')" "$(metal rough 1 '')" \
    "$(metal cloth 0.5 '' | sed 's/"baseColorFactor":/"baseColorTexture":{"index":2},&/')"
{
    echo 'mtllib glass.mtl'
    i=0
    for material in plain tinted leaf pane odd; do
        printf 'usemtl %s\nv %d 0 %d\nv %d 0 0\nv %d 1 0\nv %d 1 %d\n' $material $i $((i % 2)) $((i + 2)) \
            $((i + 2)) $i $((i % 2))
        echo 'vt 0 0
vt 1 0
vt 1 1
vt 0 1
f -4/-4 -3/-3 -2/-2 -1/-1
f -1/-1 -2/-2 -3/-3 -4/-4'
        i=$((i + 1))
    done
} >looks/glass.obj
echo 'newmtl plain
Kd 0.8 0.2 0.2
d 1
newmtl tinted
Kd 0.1 0.4 0.9
Tr 0.75
newmtl leaf
map_Kd red.png
map_d -imfchan m hole.png
map_Bump -bm 0.5 red.png
newmtl pane
map_Kd fade.png
newmtl odd
map_Kd red.png
map_d fade.png' >looks/glass.mtl
for k in 4 16 200 photo; do ./make png $k 256 128 $k.png; done
./make png photo 100 50 odd.png
./make jpeg 64 64 photo.jpg
tetra='v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 1 4 3'
echo "$tetra" >tetra.obj

# ---- Round trips -------------------------------------------------------------------------------
round_trip torus_smooth torus.obj
holds stdout 'normals: off by at most 0.00'
same_colours torus_smooth torus.obj smooth
holds torus_smooth/m.c zs_shade_smooth
round_trip torus_precise torus.obj --precise --shade flat
holds torus_precise/m.c pos_lo
round_trip torus_textured skinned.obj --texture-format 565
same_colours torus_textured skinned.obj textured
holds torus_textured/m.c 'zs_shade_texture_smooth'
holds torus_textured/m.c '&m_texture[0]'
round_trip torus_own_origin torus.obj --center no
holds torus_own_origin/m.h '0,0,0 is the model'\''s own origin'
is "origin" "$(word 1 $place) $(word 2 $place) $(word 3 $place)" "0 0 0"
round_trip torus_by_unit torus.obj --unit 25.4 --cull none
is "unit" "$(word 5 $place)" 25.4
holds torus_by_unit/m.c ZS_CULL_NONE
round_trip teapot teapot.obj
same_colours teapot teapot.obj flat
round_trip triangle_soup soup.obj
holds stdout '30 triangles left out'
round_trip boxes_by_face boxes3.obj
round_trip boxes_by_material boxes300.obj
round_trip many_materials gltf/balls.gltf
same_colours many_materials gltf/balls.gltf textured
holds many_materials/m.c '4 meshes, 4 materials'
round_trip large_in_parts large.obj
holds stdout '2 meshes, 1 material'
case $name in large_in_parts) above "vertices" "$(awk '/triangles,/ { print $3 }' stdout)" 65999 ;; esac

begin exact_coordinates_are_exact
convert exact boxes300.obj
compile exact probe
same_places exact boxes300.obj 1e-9
holds stdout 'positions: exact'

begin step_uses_the_range
convert range torus.obj
above "largest coordinate" \
    "$(tr '{},' '\n' <range/m.c | awk '/tri_0/ { exit } $1 + 0 > m { m = $1 + 0 } END { print m }')" 32750

# ---- One road ------------------------------------------------------------------------------------
one_road obj teapot.obj
one_road obj_smooth torus.obj
one_road obj_textured skinned.obj
one_road obj_precise torus.obj --precise
one_road obj_large_in_parts large.obj
rm -f large_in_parts/m.o large_in_parts/arm.o
one_road gltf gltf/balls.gltf
gltf=$before
glb_of gltf/balls.gltf gltf/ball.bin >gltf/balls.glb
one_road glb gltf/balls.glb
is "frames of the .glb" "$before" "$gltf"
one_road stl teapot.stl
one_road ply teapot.ply
one_road materials looks/looks.gltf
for shade in flat textured-flat unlit smooth; do
    one_road "materials_$(echo $shade | tr - _)" looks/looks.gltf --shade $shade
done
one_road mask_of_many_alphas looks/fence.gltf --texture-format 565
one_road mtl looks/glass.obj
one_road highlights looks/lossy.gltf
one_road highlights_flat looks/lossy.gltf --shade flat
one_road metals looks/metal.gltf --shade smooth
one_road metals_with_textures looks/metal.gltf

# ---- Materials -----------------------------------------------------------------------------------
# What is drawn is seen in the frame; what is not carried over is named, by convert and by render alike.
said_of() { # FILE LINE...    all that is said
    "$build/zsim" render "$1" --out said.png 2>said.render >said.out || wrong "status $?"
    [ ! -s said.out ] || wrong "render talks: $(head -c 200 said.out)"
    "$build/zsim" convert "$1" --name m --out said >said.convert 2>said.err || wrong "status $?"
    [ ! -s said.err ] || wrong "convert complains: $(head -c 200 said.err)"
    file=$1
    shift
    : >said.want
    for line; do echo "not carried over: $line" >>said.want; done
    sed "s|^zsim: $file: ||" said.render | cmp -s said.want - ||
        wrong "render of $file says $(tr '\n' '|' <said.render)"
    grep -F 'not carried over' said.convert | sed 's/^  //' | cmp -s said.want - ||
        wrong "convert of $file says $(grep -F 'not carried over' said.convert | tr '\n' '|')"
    grep -F 'not carried over' said/m.c | sed 's/^ \*   //' | cmp -s said.want - ||
        wrong "m.c of $file says something else"
}
begin materials_that_are_written
convert look looks/looks.gltf
white='.rgb = { 255, 255, 255 }' # other factors by sRGB's curve: 0.2 is 124, 0.6 203, 0.8 231
line() { # SHADER COLOUR REST
    holds look/m.c "{ .shader = &zs_$1, $2, .cull = ZS_CULL_$3"
}
line shade_cutout_smooth "$white" 'BACK, .texture = &m_texture[0] }, /* "leaf" */'
line blend_texture_smooth "$white" 'NONE, .texture = &m_texture[1] }, .alpha = 255 }, /* "fade" */'
line blend_smooth '.rgb = { 124, 203, 255 }' 'BACK }, .alpha = 102 }, /* "glass" */'
line shade_smooth '.rgb = { 255, 203, 124 }' 'NONE }, /* "both sides" */'
line shade_raw '.rgb = { 255, 231, 124 }' 'BACK }, /* "lamp" */'
line shade_texture "$white" 'BACK, .texture = &m_texture[2] }, /* "unlit" */'
line shade_texture_smooth "$white" 'BACK, .texture = &m_texture[3] }, /* "solid" */'
holds look/m.c '.alpha_least = 128'
holds stdout '"hole.png": 64 x 64, pal4a'
holds stdout '"fade.png": 64 x 32, 4444'
holds stdout '"hole.png": 64 x 64, pal4,'
holds look/m.h '#define M_METHOD (&zs_method_transparent)'
for format in 565:4444 pal8:pal8a pal4:pal4a; do
    convert look looks/looks.gltf --texture-format ${format%:*}
    holds stdout "\"hole.png\": 64 x 64, ${format#*:}"
    compile look same
    run look/same draw
done
begin highlights_and_emission_that_are_written
convert look looks/lossy.gltf
holds look/m.c '{ .material = { .shader = &zs_shade_lit, .rgb = { 218, 89, 89 }, .cull = ZS_CULL_BACK },'
# power 2 / 0.4^4 - 2, rounded down; 0.04 * (power + 8) / 8 of 255
holds look/m.c '.shine = &m_shine_76, .specular = { 107, 107, 107 }, .emission = { 0, 0, 124 } }, /* "gloss" */'
holds look/m.h 'extern struct zs_lamp m_lamp[1];'
lacks look/m.h M_METHOD
convert look looks/metal.gltf
holds look/m.c '.specular = { 255, 188, 0 }, .emission = { 0, 0, 0 }, .flags = ZS_LIT_TWO_SIDED }, /* "gold" */'
line shade_smooth '.rgb = { 255, 188, 0 }' 'BACK }, /* "rough" */'
begin highlights_on_textures_that_are_written
holds look/m.c '.specular = { 255, 240, 0 }, .emission = { 0, 0, 0 } }, /* "cloth" */' # by red.png's mean
convert look looks/lossy.gltf
line_of_gloss='{ .material = { .shader = &zs_shade_texture_gloss, .rgb = { 255, 255, 255 }, .cull = ZS_CULL_BACK'
holds look/m.c "$line_of_gloss, .texture = &m_texture[0] },"
holds look/m.c '.shine = &m_shine_128, .specular = { 173, 173, 173 }, .emission = { 124, 0, 0 } }, /* "wet" */'
line shade_texture_smooth "$white" 'BACK, .texture = &m_texture[0] }, /* "damp" */'
holds look/m.h '#define M_VARYINGS ZS_VARYINGS_TEXTURE_GLOSS '
gcc -fsyntax-only -Iheaders look/m.c 2>cc.log && wrong 'three varyings are taken'
holds cc.log 'm.h: highlights on textures have four varyings; compile this and all of zstrip with -DZS_VARYINGS_MAX=4'
grep '^#define M_FAST' look/m.h | grep -q TEXTURE_SMOOTH || wrong 'no accelerator for "damp"'
convert look looks/metal.gltf
grep '^#define M_FAST' look/m.h | grep -qE 'TEXTURE|565|PAL' && wrong 'accelerators that nothing uses'
begin alpha_of_a_picture_alone_is_named
convert look looks/hole.png
holds stdout '  not carried over: alpha of a texture (1)'
begin plain_materials_need_no_method
lacks many_materials/m.h M_METHOD
lacks many_materials/m.c zs_filter.h
begin materials_that_are_named
said_of looks/looks.gltf 'double-sidedness: light on back sides (2, the first of material "fade")'
said_of looks/lossy.gltf 'animation (1, "walk")' 'skin (5, the first of mesh "bowl0")' \
    'morph targets (5, the first of mesh "bowl0")' 'camera (1, "eye")' 'light (1, "lamp")' \
    'further texture coordinates (5, the first of mesh "bowl0")' 'texture that cannot be loaded (1, "gone.png")' \
    'normal or height map (1, of material "maps")' 'metallic-roughness map (1, of material "maps")' \
    'emission map (1, of material "maps")' 'occlusion map (1, of material "maps")' \
    'double-sidedness: light on back sides (1, of material "both sides")' \
    'highlights on a texture, too faint for what they cost (1, of material "damp")'
said_of gltf/balls.gltf
said_of looks/glass.obj 'alpha of a texture (1, "fade.png")' 'normal or height map (1, of material "leaf")' \
    'opacity map (1, of material "odd")'
begin opacity_is_named_where_an_option_draws_its_own_way
for option in '--method hiz' '--fog exp:0.1:ffffff' '--style wire' '--threads 2' '--shadow planar'; do
    # shellcheck disable=SC2086
    z render looks/looks.gltf $option --out o.png
    is "status of $option" $status 0
    holds stderr 'not carried over: opacity (3, the first of material "leaf")'
done
# shellcheck disable=SC2086
z render looks/looks.gltf --samples 4 --out o.png
lacks stderr opacity

# ---- What is written, and no more --------------------------------------------------------------
arrays() { # TO    the arrays of its first mesh
    sed -n 's/^static const [a-z0-9_ ]* m_\([a-z_]*\)_0\[.*/\1/p' "$1/m.c" | tr '\n' ' '
}
shade() { # SHADE INPUT ARRAYS SHADERS
    begin "shade_$(echo "$1" | tr - _)_writes_what_it_reads_of_${2%.obj}"
    convert shaded "$2" --shade "$1"
    is "arrays" "$(arrays shaded)" "$3 "
    is "shaders" "$(sed -n 's/.*&zs_shade_\([a-z_]*\),.*/\1/p' shaded/m.c | sort -u | tr '\n' ' ')" "$4 "
    compile shaded probe
    run shaded/probe check
    run shaded/probe draw 0 >/dev/null
}
shade flat skinned.obj 'pos tri face_normal cluster' flat
shade smooth skinned.obj 'pos tri normal cluster' smooth
shade textured skinned.obj 'texel pos tri normal uv cluster' texture_smooth
shade textured-flat skinned.obj 'texel pos tri face_normal uv cluster' texture_flat
shade unlit skinned.obj 'texel pos tri uv cluster' texture
shade raw skinned.obj 'pos tri cluster' raw
shade raw colors130.obj 'pos tri face_raw cluster' raw
shade flat colors130.obj 'pos tri face_normal face_rgb cluster' flat
shade smooth colors130.obj 'pos tri normal vertex_rgb cluster' smooth
begin shade_unlit_without_texture_is_raw
convert shaded gltf/balls.gltf --shade unlit
is "shaders" "$(sed -n 's/.*&zs_shade_\([a-z_]*\),.*/\1/p' shaded/m.c | sort | tr '\n' ' ')" "raw raw texture texture "
begin face_normals_are_left_out_on_request
convert shaded torus.obj --shade flat --face-normals no
is "arrays" "$(arrays shaded)" 'pos tri cluster '
begin hierarchy_holds_all_triangles
for more in '' --precise; do
    # shellcheck disable=SC2086
    convert shaded torus.obj --shade flat --bvh $more
    is "arrays" "$(arrays shaded | sed 's/pos_lo //')" 'pos tri face_normal cluster bvh '
    compile shaded probe
    same_flash shaded
    sound shaded
    same_pixels shaded torus.obj
done
begin one_colour_for_all
convert shaded colors130.obj --color 3366cc
holds shaded/m.c '{ 51, 102, 204 }'
is "arrays" "$(arrays shaded)" 'pos tri face_normal cluster '
begin colours_take_the_smaller_form
convert shaded boxes3.obj
holds stdout '1 mesh, 1 material'
convert shaded boxes300.obj
holds stdout '3 meshes, 3 materials'
holds shaded/m.c '"paint2"'

# ---- Textures ----------------------------------------------------------------------------------
picture() { # NAME KIND W H FORMAT EXACT LEAST-DB INPUT OPTION...
    begin "picture_$1"
    kind=$2 w=$3 h=$4 format=$5 exact=$6 least=$7
    shift 7
    convert pic "$@"
    compile pic texels
    same_flash pic
    holds pic/m.c "zs_texel_$format"
    run pic/texels "$kind" "$w" "$h"
    # shellcheck disable=SC2086
    set -- $seen
    is "exactness" "$1" "$exact"
    above "PSNR" "$2" "$least"
    block=$4 levels=$5 coarse=$6
    note="$format, PSNR $2 dB"
    holds stdout "PSNR $2 dB, a channel off by at most $3 of 255"
}
picture of_4_colours 4 256 128 pal4 exact 38 4.png
picture of_16_colours 16 256 128 pal4 exact 38 16.png
picture of_200_colours 200 256 128 pal8 exact 38 200.png
picture of_many photo 256 128 565 exact 41 photo.png
picture of_many_in_256 photo 256 128 pal8 near 28.3 photo.png --texture-format pal8
undithered=$block
picture of_many_in_256_dithered photo 256 128 pal8 near 26 photo.png --texture-format pal8 --dither
above "PSNR of means of 8 x 8 texels, dithered" "$block" "$(awk -v b="$undithered" 'BEGIN { print b + 1 }')"
picture of_many_in_16 photo 256 128 pal4 near 18.7 photo.png --texture-format pal4
picture in_565_dithered photo 256 128 565 near 38 photo.png --texture-format 565 --dither
above "PSNR of means of 8 x 8 texels, dithered" "$block" 66 # 56 without
picture halved photo 256 128 565 exact 41 photo.png --texture-size 64x32
holds stdout '64 x 32'
picture in_4_colours_dithered_stays_exact 4 256 128 pal4 exact 38 4.png --dither
mipmap() { # LEVELS LEAST-DB: of the picture converted last
    is "levels" "$levels" "$1"
    above "PSNR of the worst level" "$coarse" "$2"
    holds stdout ", $1 levels"
    holds pic/m.c ".n_levels = $1 "
}
picture mipmap photo 256 128 565 exact 41 photo.png --mipmap
mipmap 8 38
picture mipmap_halved_dithered photo 256 128 565 near 38 photo.png --mipmap --texture-size 64x32 \
    --texture-format 565 --dither
mipmap 6 37
picture mipmap_in_256 photo 256 128 pal8 near 28.3 photo.png --mipmap --texture-format pal8
mipmap 8 23
picture mipmap_in_16 photo 256 128 pal4 near 18.7 photo.png --mipmap --texture-format pal4
mipmap 8 14
lacks pic/m.h n_levels
picture no_mipmap photo 256 128 565 exact 41 photo.png
is "levels" "$levels" 0
lacks pic/m.c n_levels
begin picture_of_odd_size
convert pic odd.png
holds stdout '128 x 64'
begin picture_jpeg_clamped
convert pic photo.jpg --wrap clamp
holds stdout '64 x 64'
holds pic/m.c 'ZS_CLAMP_U | ZS_CLAMP_V'
begin picture_header_has_no_mesh
lacks pic/m.h instance
holds pic/m.h 'm_texture[M_TEXTURES]'
begin texture_in_place_of_the_models
convert pic skinned.obj --texture 4.png --shade unlit
holds stdout 'texture 0 "4.png": 256 x 128, pal4, 4 colours'

# ---- The same bytes, wherever and whenever -----------------------------------------------------
begin deterministic
convert same1 gltf/balls.gltf --dither --texture-format pal8
mkdir -p elsewhere
cp -r gltf elsewhere/there
(cd elsewhere && LC_ALL=C.UTF-8 "$zsim" convert "$work/elsewhere/there/balls.gltf" --dither --texture-format pal8 \
    --name m --out "$work/same2" >/dev/null) || wrong "status $?"
for built in "$build" "$build/test"; do
    "$built/zsim" convert gltf/balls.gltf --dither --texture-format pal8 --name m --out same3 >/dev/null ||
        wrong "status $?"
    cmp same1/m.h same3/m.h >/dev/null && cmp same1/m.c same3/m.c >/dev/null ||
        wrong "it depends on the compiler's options: $built"
done
for f in m.h m.c; do
    cmp same1/$f same2/$f >/dev/null || wrong "$f depends on the folder"
done
begin first_line_names_the_command
is "first line" "$(head -1 same1/m.c)" '/* Made by: zsim convert balls.gltf --dither --texture-format pal8 --name m'
lacks same1/m.c "$work"
lacks same1/m.h gltf/
begin names_that_would_end_a_comment
cp tetra.obj 'a *? b\.obj'
convert odd 'a *? b\.obj'
compile odd probe
holds odd/m.c 'convert a____b_.obj'
holds many_materials/m.c '"red __ paint"'

# ---- Refused -----------------------------------------------------------------------------------
mkdir kept
echo old >kept/m.h
refused() { # NAME STATUS TEXT ARGUMENT...    nothing is written or touched
    begin "refused_$1"
    want=$2 text=$3
    shift 3
    z convert "$@"
    one_line "$want" "$text"
    [ ! -e none ] || wrong "none/ was made"
    for f in kept/* kept/.*; do
        case $f in kept/m.h | kept/. | kept/.. | 'kept/.*') ;; *) wrong "there is $f" ;; esac
    done
    only_line kept/m.h
    is "kept/m.h" "$the_line" old
}
n=0
for bad_name in 1a a-b 'a b' _a 'a*/' ü; do
    n=$((n + 1))
    refused "name_${n}_$(printf %s "$bad_name" | tr -c 'a-z0-9' _)" 1 'is not a C identifier' \
        tetra.obj --name "$bad_name" --out none
done
for word in int class static_assert while; do
    refused name_$word 1 'is a keyword' tetra.obj --name $word --out none
done
refused name_of_a_header 1 'would hide the header math.h' tetra.obj --name math --out none
refused name_of_the_library 1 'belongs to the library' tetra.obj --name zs_x --out none
refused name_too_long 1 'more than 40' tetra.obj --name a123456789012345678901234567890123456789012345 --out none
refused name_empty 2 '--name wants a name' tetra.obj --name '' --out none
refused no_name 2 '--name is missing' tetra.obj --out none
refused no_out 2 '--out is missing' tetra.obj --name m
refused no_model 2 'a model is missing' --name m --out none
refused two_models 2 'one too many' tetra.obj teapot.obj --name m --out none
refused unknown_option 2 "'--wat'" tetra.obj --name m --out none --wat
refused option_of_words 2 '--unit wants a number' tetra.obj --name m --out none --unit ten
refused choice 2 'flat|smooth|textured|textured-flat|unlit|raw' tetra.obj --name m --out none --shade phong
refused flag_with_a_value 2 '--precise wants no value' tetra.obj --name m --out none --precise=1
refused value_missing 2 '--unit wants a value' tetra.obj --name m --out none --unit
refused missing_file 1 'nowhere.obj' nowhere.obj --name m --out none
refused missing_parent 1 'no/where' tetra.obj --name m --out no/where
refused folder_is_a_file 1 'Not a directory' tetra.obj --name m --out tetra.obj
refused picture_with_a_unit 1 'is a picture, and --unit is for models' 4.png --name m --out none --unit 3
refused missing_picture 1 'cut.png' cut.png --name m --out none
head -c 200 4.png >cut.png
refused broken_picture 1 'cut.png' cut.png --name m --out none
refused texture_size 1 'a power of two' 4.png --name m --out none --texture-size 100x64
refused texture_size_huge 1 'a power of two' 4.png --name m --out none --texture-size 2048x64
./make png 4 1 8 thin.png
refused pal4_of_one_column 1 'take pal8' thin.png --name m --out none --texture-format pal4
refused texture_that_is_not_shown 1 '--texture needs' skinned.obj --texture 4.png --shade flat --name m --out none
refused textured_without_texture 1 'unwrap it in a modeller' teapot.obj --shade textured --name m --out none
./make torus 8 4 1 gone.mtl >lost.obj
refused textured_without_material_file 1 'gone.mtl cannot be read' lost.obj --shade unlit --name m --out none
refused unit_0 1 'outside its range' tetra.obj --name m --out none --unit 0
refused unit_below_0 1 'outside its range' tetra.obj --name m --out none --unit -2
refused unit_nan 1 'outside its range' tetra.obj --name m --out none --unit nan
refused unit_too_large 1 'the world ends' tetra.obj --name m --out none --unit 1e12
begin unit_that_a_refusal_names
for size in 0.7 1.3 3.1; do # three digits of the limit: rounded down, up and up
    printf 'v -%s 0 0\nv %s 0 0\nv 0 %s %s\nf 1 2 3\n' $size $size $size $size >wide.obj
    z convert wide.obj --name m --out none --unit 1e12
    lacks stderr '--center'
    told=$(sed -n 's/.*give --unit \([0-9.e+]*\) or less.*/\1/p' stderr)
    z convert wide.obj --name m --out told --unit "$told"
    is "status with --unit $told" "$status" 0
done
refused unit_too_small 1 'give --unit' tetra.obj --name m --out none --unit 0.5
printf 'v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n' >point.obj
refused no_extent 1 'no extent' point.obj --name m --out none
printf 'v 0 0 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\n' >line.obj
refused no_area 1 'no triangle in it has an area' line.obj --name m --out none
printf 'v 0 0 0\nv 1 0 0\nv 3 0 0\n' >empty.obj
refused no_triangles 1 'no faces' empty.obj --name m --out none
printf 'v 1000000.5 0.3 0\nv 1000001.7 0 0\nv 1000000 1 0\nf 1 2 3\n' >far.obj
refused far_from_its_origin 1 'or --center yes' far.obj --name m --out none --center no
refused too_far_from_its_origin 1 'steps wide; give --center yes' far.obj --name m --out none --center no --unit 100
{
    printf 'mtllib torus.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\n'
    printf 'vt 0 0\nvt 400 0\nvt 0 400\nf 1/1 2/2 3/3\n'
} >wide.obj
refused texture_coordinates_too_wide 1 'repeat the picture less often' wide.obj --name m --out none
refused map_onto_the_output 1 'two outputs' tetra.obj --name m --out kept --map kept/m.c
refused map_onto_the_model 1 'it is the model itself' tetra.obj --name m --out kept --map tetra.obj
refused map_on_a_full_disk 1 '/dev/full' tetra.obj --name m --out kept --map /dev/full
refused full_disk_and_new_folder 1 '/dev/full' tetra.obj --name m --out none --map /dev/full
begin taken_wide_but_smaller_texture
convert wide wide.obj --texture-size 64x64
holds stdout '64 x 64'
begin taken_without_material_file
convert lost lost.obj
holds stdout '"gone.mtl" cannot be read'
begin taken_far_from_its_origin
convert far far.obj
compile far probe
run far/probe check

begin material_files_of_one_line
mkdir -p named
printf 'newmtl a\nKd 1 0 0\n' >named/one.mtl
printf 'newmtl b\nKd 0 1 0\nd 0.5\nmap_Kd gone.png\n' >named/two.mtl
tri='v 0 0 0\nv 1 0 0\nv 0 1 0\n'
printf "mtllib one.mtl two.mtl\\n${tri}usemtl a\\nf 1 2 3\\nusemtl c\\nf 1 3 2\\n" >named/several.obj
said_of named/several.obj 'material that no material file has (1, "c")'
holds said/m.c '{255,0,0},{204,204,204}'
printf "mtllib one.mtl none.mtl\\n${tri}usemtl a\\nf 1 2 3\\n" >named/one_is_gone.obj
z render named/one_is_gone.obj --out o.png
holds stderr 'material file named/none.mtl cannot be read'
begin a_texture_without_coordinates_is_named
printf "mtllib two.mtl\\n${tri}usemtl b\\nf 1 2 3\\n" >named/bare.obj
said_of named/bare.obj 'texture of faces without texture coordinates (1, of material "b")'
begin carriage_returns_alone
z render named/bare.obj --out want.png
tr '\n' '\r' <named/two.mtl >named/cr.mtl
sed 's/two/cr/' named/bare.obj | tr '\n' '\r' >named/cr.obj
z render named/cr.obj --out got.png
is "status" $status 0
cmp -s want.png got.png || wrong 'a picture of its own'
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n' >named/tri.ply
printf 'element face 1\nproperty list uchar int vertex_indices\nend_header\n' >>named/tri.ply
printf '0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >>named/tri.ply
tr '\n' '\r' <named/tri.ply >named/cr.ply
z render named/tri.ply --out want.png
z render named/cr.ply --out got.png
is "status of a PLY" $status 0
cmp -s want.png got.png || wrong 'a PLY with a picture of its own'
begin elements_of_a_ply_that_have_another_name
sed 's/^element vertex/element foo 2\nproperty list uchar int bar\n&/
    s/^element face/element more 2\nproperty float a\n&/; s/^end_header/&\n2 7 8\n1 9/; s/^3 0 1 2/5\n6\n&/' \
    named/tri.ply >named/foo.ply
z render named/foo.ply --out got.png
is "status" $status 0
is "said" "$(cat stderr)" ''
cmp -s want.png got.png || wrong 'a picture of its own'
{ sed 's/^format.*/format binary_little_endian 1.0/; s/^element face/element foo 2\nproperty uchar a\n&/
    /^end_header/q' named/tri.ply && printf '\000\000\000\000\000\000\000\000\000\000\000\000' &&
    printf '\000\000\200\077\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000' &&
    printf 'ab\003\000\000\000\000\001\000\000\000\002\000\000\000'; } >named/foo.ply
z render named/foo.ply --out got.png
cmp -s want.png got.png || wrong 'a picture of its own where it is binary'
sed 's/^element face/element tristrips 1\nproperty list int int vertex_indices\n&/; s/^3 0 1 2/3 0 1 2\n&/' \
    named/tri.ply >named/strips.ply
said_of named/strips.ply 'triangle strips (1)'
begin extensions_that_a_gltf_requires
sed '0,/{/s//{ "extensionsUsed": ["FOO_bar"], "extensionsRequired": ["KHR_texture_transform", "FOO_bar"],/' \
    gltf/balls.gltf >gltf/required.gltf
said_of gltf/required.gltf 'glTF extension (1, "FOO_bar")'
begin extensions_of_looks
used='"KHR_materials_transmission", "EXT_mesh_gpu_instancing", "KHR_materials_unlit", "FOO_bar"'
used="$used, \"KHR_materials_emissive_strength\""
sed "0,/{/s//{ \"extensionsUsed\": [$used], \"extensionsRequired\": [\"KHR_materials_transmission\"],/" \
    gltf/balls.gltf >gltf/used.gltf
said_of gltf/used.gltf 'glTF extension (3, the first "KHR_materials_transmission")'
begin points_and_lines_of_an_obj
printf "${tri}p 1 2\\nf 1 2 3\\nl 1 2 3\\nl 2 3\\n" >named/lines.obj
said_of named/lines.obj 'points and lines (3)'
begin curves_and_surfaces_of_an_obj
printf "${tri}f 1 2 3\\ncstype bezier\\ndeg 1\\ncurv 0 1 1 2\\nend\\nsurf 0 1 0 1 1 2 3 1\\nend\\n" >named/curves.obj
said_of named/curves.obj 'curves and surfaces (2)'
begin facets_of_more_than_three_vertices
corner='vertex 1 0 0\nvertex 0 1 0\nvertex 0 0 %s\n'
facet="facet normal 0 0 1\\nouter loop\\n$corner$corner\\nendloop\\nendfacet\\n"
# shellcheck disable=SC2059 # the format is above
printf "solid x\\n$facet$facet${facet%%vertex*}${corner}endloop\\nendfacet\\nendsolid x\\n" 1 2 3 4 5 >named/facets.stl
said_of named/facets.stl 'vertices of facets beyond the third (2)'
begin colours_that_become_a_mean
printf 'v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 0 0\nf 1 2 3\nf 1 1 4 2\n' >named/mean.obj
said_of named/mean.obj 'vertex colours, but for their mean on each face: smooth shading has them (1)'
z render named/mean.obj --shade flat --out said.png
is "said of what is asked for" "$(cat stderr)" ''
sed 's/ [01] [01] [01]$/ 1 0 0/' named/mean.obj >named/one.obj
said_of named/one.obj
begin maps_of_other_names
printf 'newmtl a\nmap_refl r.png\nmap_disp d.png\nmap_opacity o.png\nmap_Ps s.png\nmap_emissive e.png\nmap_aat on\n' \
    >named/maps.mtl
printf "mtllib maps.mtl\\n${tri}usemtl a\\nf 1 2 3\\n" >named/maps.obj
said_of named/maps.obj 'normal or height map (1, of material "a")' 'emission map (1, of material "a")' \
    'opacity map (1, of material "a")' 'map of another kind (1, of material "a")'
begin colours_in_another_form
sed 's/^property list.*/&\nproperty uchar red\nproperty uchar green\nproperty uchar blue/; s/^3 0 1 2/& 255 0 0/' \
    named/tri.ply >named/faces.ply
said_of named/faces.ply 'colours in another form (1, "of faces")'
sed 's/^property float z/&\nproperty uchar diffuse_red/; s/^[01] [01] 0$/& 255/' named/tri.ply >named/diffuse.ply
said_of named/diffuse.ply 'colours in another form (1, "diffuse_red")'
for head in 'OFF\n# it\n3 2 0' 'OFF 3 2 0' 'OFF # it\n\n3 2 0'; do
    printf "$head\\n0 0 0\\n1 0 0\\n0 1 0\\n3 0 1 2\\n3 0 2 1 255 0 0\\n" >named/faces.off
    case $head in OFF' '3*) z render named/faces.off --out o.png ;; *)
        said_of named/faces.off 'colours in another form (1, "of faces")' ;; esac
done
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # red\n' >named/plain.off
said_of named/plain.off
stl() { # HEADER ATTRIBUTE...    a triangle for each
    printf '%-80s' "$1" && shift && printf "\\00$#\\000\\000\\000"
    for attribute; do
        printf '\000\000\000\000\000\000\000\000\000\000\200\077' # normal 0 0 1; then corners 0 0 0, 1 0 0, 0 1 0
        printf '\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000'
        printf "\\000\\000\\000\\000\\000\\000\\200\\077\\000\\000\\000\\000$attribute"
    done
}
stl "$(printf %74s)COLOR=" '\037\000' >named/magics.stl
said_of named/magics.stl 'colours in another form (1, "of Materialise Magics")'
stl 'COLOR=abcd,MATERIAL=' '\037\000' >named/magics.stl
said_of named/magics.stl 'colours in another form (1, "of Materialise Magics")'
begin alpha_of_colours_that_have_none
stl plain '\000\374' '\000\000' >named/half.stl
said_of named/half.stl
holds said/m.c '{255,0,0},{204,204,204}'
colors='{"buffer":0,"byteLength":72}],"buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,'
{
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{'
    printf '"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1}}]}],"accessors":['
    printf '{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},'
    printf '{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC3"}],'
    printf '"bufferViews":[%s' "$colors"
    { tail -c +97 named/magics.stl | head -c 36 && tail -c +97 named/magics.stl | head -c 36; } | base64 -w0
    echo '"}]}'
} >named/three.gltf
said_of named/three.gltf 'vertex colours, but for their mean on each face: smooth shading has them (1)'
begin masks_of_materials_that_have_alpha
mask() { # ALPHA CUTOFF    of the first material
    sed "s/\"pbrMetallicRoughness\":{/\"alphaMode\":\"MASK\",\"alphaCutoff\":$2,&\"baseColorFactor\":[1,1,1,$1],/" \
        masked/balls.gltf >masked/mask.gltf
}
cp -r gltf masked
cp looks/hole.png masked/red.png
mask 0.8 0.5 # texels are drawn from 0.5 / 0.8 of 255 on
convert look masked/mask.gltf
holds look/m.c '.alpha_least = 159'
said_of masked/mask.gltf
mask 0.4 0.5
said_of masked/mask.gltf 'opacity (1, of material "red __ paint")'
begin names_of_gltf_are_uris
bin=$(grep -o '"[^"]*\.bin"' gltf/balls.gltf | head -1 | tr -d '"')
[ -n "$bin" ] || wrong 'no buffer beside it'
cp "gltf/$bin" 'gltf/a buffer.bin'
sed "s|$bin|a%20buffer.bin|" gltf/balls.gltf >gltf/escaped.gltf
z render gltf/balls.gltf --out want.png
z render gltf/escaped.gltf --out got.png
is "status" $status 0
cmp -s want.png got.png || wrong 'a picture of its own'
begin one_file_for_two_outputs
rm -rf twice && mkdir twice
z render named/bare.obj --out twice/new.png --stats "../${PWD##*/}/twice/./new.png"
is "status of render" $status 1
holds stderr 'is named for two outputs'
z convert named/bare.obj --name m --out twice --map "../${PWD##*/}/twice/m.c"
is "status of convert" $status 1
holds stderr 'is named for two outputs'
is 'what is left' "$(ls twice)" ''
begin no_triangle_would_be_left
boxes 1 1 0 >named/box.obj
z convert named/box.obj --name m --out said --simplify 1
holds stdout 'not simplified: no triangle would be left'
begin help_lists_every_option
z convert --help
is status $status 0
for option in --name --out --shade --unit --center --precise --face-normals --cull --color --map --texture --wrap \
    --texture-size --texture-format --dither --mipmap; do
    holds stdout "  $option "
done
while read -r line; do
    [ ${#line} -le 110 ] || wrong "a line of ${#line} characters"
done <stdout
finish
[ $n_failed -eq 0 ]
