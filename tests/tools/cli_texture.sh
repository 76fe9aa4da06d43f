#!/bin/sh
# Textures and float depth of zsim, from outside: loading, orientation, wrapping, light, the reference
# against values worked out here, the renderer against the reference, refusals.
# Usage: tests/tools/cli_texture.sh ZSIM WORKDIR     as tests/tools/cli.sh
#
# The camera `plain` shows the quad -50..50 at z = 0 on pixels 70..169, one unit to a pixel: u runs
# with x, v with y.
set -u
. tests/tools/zsim.sh
gcc -O1 -Wall -Wextra -Werror "$top/tests/tools/fixture.c" -lpng -lturbojpeg -o "$work/fixture" || exit 1

# ---- What these tests are made of -----------------------------------------------------------------
color() { # NAME X Y RRGGBB    of out/NAME.png
    look pixel "out/$1.png" "$2" "$3"
    is "colour of $1 at $2,$3" "$seen" "$4"
}
# The four quarters of the quad: top left, top right, bottom left, bottom right
quarters() { # NAME TL TR BL BR
    color "$1" 80 80 "$2"
    color "$1" 160 80 "$3"
    color "$1" 80 160 "$4"
    color "$1" 160 160 "$5"
}
both() { # NAME MODEL OPTION...    out/NAME and out/NAME_ref
    as=$1
    shift
    draw "$as" "$@"
    draw "${as}_ref" "$@" --reference
}
four='ff0000 00ff00 0000ff ffffff'
at_most() { # WHAT HAVE MOST
    awk -v a="$2" -v b="$3" 'BEGIN { exit !(a != "" && a + 0 <= b + 0) }' ||
        wrong "$1 is $2, more than $3"
}
at_least() { # WHAT HAVE LEAST
    awk -v a="$2" -v b="$3" 'BEGIN { exit !(a != "" && a + 0 >= b + 0) }' ||
        wrong "$1 is $2, less than $3"
}
quad_obj() { # NAME MATERIAL-LINES... (into NAME.mtl)    uv 0..1
    quad=$1
    shift
    obj "$quad" "mtllib $quad.mtl" 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' \
        'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' 'usemtl A' 'f 1/1 2/2 3/3 4/4'
    printf '%s\n' 'newmtl A' "$@" >"$quad.mtl"
}
uv_obj() { # NAME U0 V0 U1 V1    the quad with uv from its lower left to its upper right, no material
    obj "$1" 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' \
        "vt $2 $3" "vt $4 $3" "vt $4 $5" "vt $2 $5" 'f 1/1 2/2 3/3 4/4'
}
# A refusal that names the picture, not the model
picture_refused() { # NAME WHO WHAT-THE-LINE-HOLDS MODEL OPTION...
    begin "refused_$1"
    who=$2
    what=$3
    shift 3
    z render "$@" --out refused/old.png --stats refused/s.json
    one_line 1 "$who"
    grep -qF -- "$what" stderr || wrong "'$what' is not in: $(said)"
    untouched
}
le32() {
    printf "$(awk -v n="$1" 'BEGIN { for (i = 0; i < 4; i++) { printf "\\%03o", n % 256; n = int(n / 256) } }')"
}
p='\000\000\110\102' m='\000\000\110\302' o='\000\000\000\000' i='\000\000\200\077' # 50, -50, 0, 1
quad_bin() { # corners, uv with v down, 6 indices: 92 bytes
    printf "$m$m$o$p$m$o$p$p$o$m$p$o" && printf "$o$i$i$i$i$o$o$o"
    printf '\000\000\001\000\002\000\000\000\002\000\003\000'
}
# IMAGE, BUFFER and SAMPLER are what stands between their braces; MORE follows in lists, or is empty
gltf() { # IMAGE BUFFER [FACTOR [SAMPLER [MORE-OF-TEXTURE [MORE-VIEWS]]]]
    printf '{"asset":{"version":"2.0"},"extensionsUsed":["KHR_texture_transform"],'
    printf '"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{'
    printf '"attributes":{"POSITION":0,"TEXCOORD_0":2},"indices":1,"material":0}]}],'
    printf '"materials":[{"name":"M","pbrMetallicRoughness":{"baseColorFactor":[%s],' "${3:-1,1,1,1}"
    printf '"baseColorTexture":{"index":0%s}}}],"textures":[{"source":0,"sampler":0}],' "${5:-}"
    printf '"samplers":[{%s}],"images":[{%s}],"accessors":[' "${4:-}" "$1"
    printf '{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-50,-50,0],"max":[50,50,0]},'
    printf '{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},'
    printf '{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"}],"bufferViews":['
    printf '{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":80,"byteLength":12},'
    printf '{"buffer":0,"byteOffset":48,"byteLength":32}%s],"buffers":[{%s}]}' "${6:-}" "$2"
}
bin='"uri":"quad.bin","byteLength":92'

# ---- Models -----------------------------------------------------------------------------------------
./fixture png rgb four.png 2 2 $four
./fixture numbers numbers.png
./fixture png rgb white.png 1 1 ffffff
quad_bin >quad.bin
quad_obj four 'map_Kd four.png'
uv_obj bare 0 0 1 1
# A ball of radius 1, the picture once around it
awk 'BEGIN { pi = atan2(0, -1); n = 24; m = 12
    for (i = 0; i <= m; i++) for (j = 0; j <= n; j++) {
        printf "v %.6f %.6f %.6f\n", sin(pi * i / m) * sin(2 * pi * j / n), cos(pi * i / m),
            sin(pi * i / m) * cos(2 * pi * j / n)
        printf "vt %.6f %.6f\n", j / n, 1 - i / m }
    for (i = 0; i < m; i++) for (j = 0; j < n; j++) {
        a = 1 + i * (n + 1) + j
        printf "f %d/%d %d/%d %d/%d %d/%d\n", a, a, a + n + 1, a + n + 1, a + n + 2, a + n + 2, a + 1, a + 1 } }' \
    >ball.obj

# ---- Loading ------------------------------------------------------------------------------------------
begin help_names_texture_options
z render --help
is status $status 0
for option in --texture --texture-format --wrap textured-flat unlit e5m11; do
    grep -qF -- "$option" stdout || wrong "--help does not name $option"
done

begin obj_first_row_is_the_top
both four four.obj $plain --shade unlit
quarters four $four
quarters four_ref $four
cmp -s out/four.png out/four_ref.png || wrong "ours and the reference differ"
is "textures in the statistics" "$(stat_of four textures)" 1
is "resampled" "$(stat_of four texture_resampled)" 0
is "texels" "$(stat_of four_ref texture_texels)" 4

begin gltf_picture_in_a_file
gltf '"uri":"four.png"' "$bin" >file.gltf
both file file.gltf $plain --shade unlit
quarters file $four
quarters file_ref $four

begin gamma_of_a_picture # of a model's own it is passed over
./fixture png rgb grey.png 1 1 808080
{
    head -c 33 grey.png
    printf '\000\000\000\004gAMA\000\001\206\240\061\350\226\137' # 1
    tail -c +34 grey.png
} >linear.png
gltf '"uri":"linear.png"' "$bin" >linear.gltf
gltf "\"uri\":\"data:image/png;base64,$(base64 -w0 linear.png)\"" "$bin" >inside.gltf
for model in linear inside; do
    draw gamma $model.gltf $plain --shade unlit
    color gamma 80 80 848284
done
draw gamma bare.obj $plain --shade unlit --texture linear.png
color gamma 80 80 bdbabd # 188 is half of light

begin gltf_picture_in_a_data_uri
gltf "\"uri\":\"data:image/png;base64,$(base64 -w0 four.png)\"" \
    "\"uri\":\"data:application/octet-stream;base64,$(base64 -w0 quad.bin)\",\"byteLength\":92" >data.gltf
draw data data.gltf $plain --shade unlit
same four data

begin glb_picture_inside
n=$(wc -c <four.png)
pad=$(((4 - (92 + n) % 4) % 4))
json=$(gltf '"bufferView":3,"mimeType":"image/png"' "\"byteLength\":$((92 + n + pad))" '' '' '' \
    ",{\"buffer\":0,\"byteOffset\":92,\"byteLength\":$n}")
while [ $((${#json} % 4)) -ne 0 ]; do json="$json "; done
{ printf 'glTF' && le32 2 && le32 $((${#json} + 28 + 92 + n + pad)) && le32 ${#json} &&
    printf 'JSON%s' "$json" && le32 $((92 + n + pad)) && printf 'BIN\000' &&
    cat quad.bin four.png && head -c $pad /dev/zero; } >inside.glb
mkdir alone
cp inside.glb alone
draw inside alone/inside.glb $plain --shade unlit
same four inside

begin png_of_every_kind
for kind in rgb rgb16 pal adam7; do
    ./fixture png $kind "$kind.png" 2 2 $four
    draw kind bare.obj $plain --shade unlit --texture "$kind.png"
    same four kind
done
./fixture png rgba rgba.png 2 2 ff000000 00ff0080 0000ffff ffffff01
z render bare.obj $plain --shade unlit --texture rgba.png --out out/kind.png # alpha is dropped, nothing shows through
is "status" $status 0
cmp -s out/four.png out/kind.png || wrong "alpha changes the frame"
is "what is said" "$(cat stderr)" 'zsim: bare.obj: not carried over: alpha of a texture (1, "rgba.png")'
for kind in gray gray16; do
    ./fixture png $kind "$kind.png" 2 2 000000 424242 828282 ffffff
    draw kind bare.obj $plain --shade unlit --texture "$kind.png"
    quarters kind 000000 424142 848284 ffffff
done
./fixture png bit bit.png 2 2 000000 ffffff ffffff 000000
draw kind bare.obj $plain --shade unlit --texture bit.png
quarters kind 000000 ffffff ffffff 000000

begin jpeg
./fixture jpg red.jpg 16 16 848284
draw jpeg bare.obj $plain --shade unlit --texture red.jpg
quarters jpeg 848284 848284 848284 848284
gltf "\"uri\":\"data:image/jpeg;base64,$(base64 -w0 red.jpg)\"" "$bin" >jpeg.gltf
draw again jpeg.gltf $plain --shade unlit
same jpeg again

begin picture_names
mkdir -p 'in one/deep er'
cp four.png 'in one/deep er/my four.png'
for written in 'deep er/my four.png' 'deep er\my four.png' '.\deep er\my four.png'; do
    quad_obj 'in one/named' "map_Kd $written"
    sed -i 's/^mtllib.*/mtllib named.mtl/' 'in one/named.obj'
    draw named 'in one/named.obj' $plain --shade unlit
    same four named
done
cp four.png 'in one/my four.png'
for written in 'C:\somebody\else\my four.png' '/no/such/folder/my four.png' "$work/four.png"; do
    quad_obj 'in one/named' "map_Kd $written"
    sed -i 's/^mtllib.*/mtllib .\\named.mtl/' 'in one/named.obj'
    draw named 'in one/named.obj' $plain --shade unlit --allow-outside
    same four named
done
gltf '"uri":"deep%20er/my%20four.png"' "$bin" >'in one/percent.gltf'
cp quad.bin 'in one'
draw named 'in one/percent.gltf' $plain --shade unlit
same four named

begin mtl_options_and_kd
draw twice bare.obj $plain --shade unlit --texture numbers.png
quad_obj options 'map_Kd -blendu on -mm 0 1 -o 0 0 0 -s 1 1 1 -texres 64 -imfchan m -bm 1 numbers.png'
draw options options.obj $plain --shade unlit
same twice options
uv_obj shifted 0.25 -0.5 2.25 0
draw shifted shifted.obj $plain --shade unlit --texture numbers.png
quad_obj options 'map_Kd -s 2 0.5 -o 0.25 -0.5 numbers.png'
draw options options.obj $plain --shade unlit
same shifted options
draw shifted shifted.obj $plain --shade unlit --texture numbers.png --wrap clamp
quad_obj options 'map_Kd -clamp on -o 0.25 -0.5 -s 2 0.5 1 numbers.png'
draw options options.obj $plain --shade unlit
same shifted options
quad_obj options 'Kd 1 0.5 0' 'map_Kd four.png'
draw kd options.obj $plain --shade unlit
quarters kd ff0000 008200 000000 ff8200 # 255 / 2 is 128, which is code 32 of 63
quad_obj options 'map_Kd four.png' 'Kd 0 0 0'
draw kd options.obj $plain --shade unlit
same four kd

begin gltf_factor_and_transform
gltf '"uri":"four.png"' "$bin" '1,0.5,0,1' >factor.gltf
both factor factor.gltf $plain --shade unlit
quarters factor ff0000 00ba00 000000 ffba00 # 188 of 255, as the factor is light
cmp -s out/factor.png out/factor_ref.png || wrong "ours and the reference differ"
# v' = 0.5 v + 0.125 down the picture; as an OBJ, v = 1 - v'
uv_obj moved 0.25 0.375 2.25 0.875
draw moved moved.obj $plain --shade unlit --texture four.png
gltf '"uri":"four.png"' "$bin" '' '' \
    ',"extensions":{"KHR_texture_transform":{"offset":[0.25,0.125],"scale":[2,0.5]}}' >moved.gltf
draw transform moved.gltf $plain --shade unlit
same moved transform
# It names texture coordinates, too: those count, whatever the texture names
for own in '' ',"texCoord":0' ',"texCoord":7'; do
    gltf '"uri":"four.png"' "$bin" '' '' "$own,\"extensions\":{\"KHR_texture_transform\":{\"texCoord\":1}}" |
        sed 's/"TEXCOORD_0":2/"TEXCOORD_0":3,"TEXCOORD_1":2/
            s/"VEC2"}\]/"VEC2"},{"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"}]/' >second.gltf
    z render second.gltf --out out/transform.png $plain --shade unlit
    cmp -s out/transform.png out/four.png || wrong "of the texture: $own: $(said)"
done

# u' = cos * su * u + sin * sv * v + ou, v' = -sin * su * u + cos * sv * v + ov, v down the picture
begin gltf_rotation
turn() { # NAME TRANSFORM
    gltf '"uri":"four.png"' "$bin" '' '' ",\"extensions\":{\"KHR_texture_transform\":{$2}}" >"$1.gltf"
    draw "$1" "$1.gltf" $plain --shade unlit
}
turn right '"rotation":1.5707963267948966,"offset":[0,1]' # u' = v, v' = 1 - u: the picture clockwise
quarters right 0000ff ff0000 ffffff 00ff00
turn left '"rotation":-1.5707963267948966,"offset":[1,0]' # u' = 1 - v, v' = u
quarters left 00ff00 ffffff ff0000 0000ff
# The lower left quarter, as in the format's text, and a little less
turn corner '"rotation":1.57079632679,"offset":[0.01,0.99],"scale":[0.48,0.48]'
quarters corner 0000ff 0000ff 0000ff 0000ff
# cos 0.8, sin 0.6: u' = 1.6 u + 0.3 v + 0.25, v' = -1.2 u + 0.4 v + 0.125; in an OBJ, v = 1 - v'
obj leaning 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' \
    'vt 0.55 0.475' 'vt 2.15 1.675' 'vt 1.85 2.075' 'vt 0.25 0.875' 'f 1/1 2/2 3/3 4/4'
draw leaning leaning.obj $plain --shade unlit --texture four.png
turn turned '"rotation":0.6435011087932844,"offset":[0.25,0.125],"scale":[2,0.5]'
same leaning turned

begin gltf_wrap_modes
five=',"extensions":{"KHR_texture_transform":{"offset":[-2,-2],"scale":[5,5]}}'
uv_obj five -2 -2 3 3
for mode in 10497 33071; do
    gltf '"uri":"four.png"' "$bin" '' "\"wrapS\":$mode,\"wrapT\":$mode" "$five" >wrap.gltf
    draw wrap wrap.gltf $plain --shade unlit
    draw as five.obj $plain --shade unlit --texture four.png --wrap \
        "$([ $mode = 10497 ] && echo repeat || echo clamp)"
    same as wrap
done
gltf '"uri":"four.png"' "$bin" '' '"wrapS":33071' "$five" >wrap.gltf # u alone
draw wrap wrap.gltf $plain --shade unlit
color wrap 75 75 ff0000
color wrap 75 85 0000ff
color wrap 75 95 ff0000
color wrap 165 75 00ff00
gltf '"uri":"four.png"' "$bin" '' '"wrapS":33648,"wrapT":33648' >wrap.gltf # mirrored, but inside
draw wrap wrap.gltf $plain --shade unlit
same four wrap
# Mirrored: as a picture that has its mirror image beside and below it
./fixture png rgb sixteen.png 4 4 $(for y in 0 1 1 0; do for x in 0 1 1 0; do
    echo $four | cut -d ' ' -f $((2 * y + x + 1))
done; done)
./fixture png rgb eight.png 2 4 $(for y in 0 1 1 0; do echo $four | cut -d ' ' -f $((2 * y + 1)),$((2 * y + 2)); done)
uv_obj halves -1 -0.5 1.5 2
uv_obj half -2 -0.5 3 2
gltf '"uri":"four.png"' "$bin" '' '"wrapS":33648,"wrapT":33648' "$five" >mirror.gltf
draw wrap mirror.gltf $plain --shade unlit
draw as halves.obj $plain --shade unlit --texture sixteen.png --wrap repeat
same as wrap
gltf '"uri":"four.png"' "$bin" '' '"wrapT":33648' "$five" >mirror.gltf # v alone
draw wrap mirror.gltf $plain --shade unlit
draw as half.obj $plain --shade unlit --texture eight.png --wrap repeat
same as wrap
draw repeated mirror.gltf $plain --shade unlit --wrap repeat
cmp -s out/wrap.png out/repeated.png && wrong "mirrored is as repeated"

# ---- Colours and materials --------------------------------------------------------------------------------
half() { # X0 X1 [RGB]    four vertices of the quad's height
    printf 'v %s\n' "$1 -50 0 ${3:-}" "$2 -50 0 ${3:-}" "$2 50 0 ${3:-}" "$1 50 0 ${3:-}"
}
faces='f 1 2 3 4
f 5 6 7 8'
halves() { # MODEL LEFT RIGHT    their colours
    draw halves "$1" $plain --shade flat --ambient 1 --diffuse 0
    color halves 90 120 "$2"
    color halves 150 120 "$3"
}
grey=cecbce # 204, under the light
begin obj_colours_of_some_vertices
{ half -50 0 && half 0 50 '1 0 0' && echo "$faces"; } >some.obj
halves some.obj $grey ff0000
{ half -50 0 '0 0 1 1' && half 0 50 && echo "$faces"; } >some.obj
halves some.obj 0000ff $grey
begin obj_faces_before_the_first_usemtl
printf '%s\n' 'newmtl red' 'Kd 1 0 0' 'newmtl blue' 'Kd 0 0 1' >two.mtl
{ half -50 0 && half 0 50 && printf '%s\n' 'mtllib two.mtl' 'f 1 2 3 4' 'usemtl red' 'f 5 6 7 8'; } >first.obj
halves first.obj $grey ff0000
begin obj_mtllib_behind_usemtl
{ half -50 0 && half 0 50 &&
    printf '%s\n' 'usemtl blue' 'f 1 2 3 4' 'mtllib two.mtl' 'usemtl red' 'f 5 6 7 8'; } >last.obj
halves last.obj 0000ff ff0000
begin mtl_colours_of_one_number_and_of_none
printf '%s\n' 'newmtl red' 'Kd 0.5' 'newmtl blue' 'Ns 10' >two.mtl
halves first.obj $grey 848284
halves last.obj ffffff 848284
begin obj_names_that_end_in_a_backslash
printf '%s\n' 'newmtl red' 'Kd 1 0 0' 'newmtl red\' 'Kd 0 0 1' 'newmtl a\b\' 'Kd 0 1 0' >two.mtl
{ half -50 0 && half 0 50 &&
    printf '%s\n' 'mtllib two.mtl' 'usemtl red\' 'f 1 2 3 4' 'usemtl a\b\' 'f 5 6 7 8' 'usemtl red\'; } >slash.obj
halves slash.obj 0000ff 00ff00

begin off_colours_of_whole_numbers
off() { # LEFT RIGHT    rgba of their vertices
    printf 'COFF\n8 2 0\n'
    { half -50 0 "$1" && half 0 50 "$2"; } | sed 's/^v //'
    printf '4 0 1 2 3\n4 4 5 6 7\n'
}
off '255 0 0 255' '0 128 64 255' >whole.off
halves whole.off ff0000 008242
off '1 0 0 1' '0 0.5 0.25 1' >whole.off
halves whole.off ff0000 008242

begin ply_alpha_without_colours
printf '%s\n' ply 'format ascii 1.0' 'element vertex 4' 'property float x' 'property float y' 'property float z' \
    'property uchar alpha' 'element face 1' 'property list uchar int vertex_indices' end_header '-50 -50 0 99' \
    '50 -50 0 99' '50 50 0 99' '-50 50 0 99' '4 0 1 2 3' >alpha.ply
z render alpha.ply --out out/alpha.png $plain --shade flat --ambient 1 --diffuse 0
color alpha 90 120 $grey
is "losses" "$(cat stderr)" 'zsim: alpha.ply: not carried over: alpha of vertex colours (1)'
sed 's/alpha$/g/' alpha.ply >green.ply
z render green.ply --out out/alpha.png $plain --shade flat --ambient 1 --diffuse 0
color alpha 90 120 006100

begin ply_texture_coordinates_of_corners
cornered() { # UV-OF-A-FACE...    two quads side by side that share two vertices, each with a picture of its own
    printf '%s\n' ply 'format ascii 1.0' 'comment TextureFile four.png' 'element vertex 6' 'property float x' \
        'property float y' 'property float z' 'element face 2' 'property list uchar int vertex_indices' \
        'property list uchar float texcoord' end_header '-50 -50 0' '0 -50 0' '50 -50 0' '-50 50 0' '0 50 0' '50 50 0' \
        "4 0 1 4 3 $1" "4 1 2 5 4 $2"
}
whole='8 0 0 1 0 1 1 0 1'
cornered "$whole" "$whole" >corners.ply
draw corners corners.ply $plain --shade unlit
for x in 80 130; do
    color corners $x 80 ff0000
    color corners $((x + 30)) 80 00ff00
    color corners $x 160 0000ff
    color corners $((x + 30)) 160 ffffff
done
cornered "$whole" '8 1 0 0 0 0 1 1 1' >corners.ply # turned over
draw corners corners.ply $plain --shade unlit
color corners 110 80 00ff00
color corners 130 80 00ff00
color corners 160 80 ff0000
for few in 0 '6 0 0 1 0 1 1'; do
    cornered "$whole" "$few" >corners.ply
    draw corners corners.ply $plain --shade unlit
    color corners 110 80 00ff00
    color corners 130 80 $grey
done

begin ply_with_several_textures
sed 's/^comment.*/comment TextureFile no such.png\n&\n&/' corners.ply >several.ply
z render several.ply --out out/several.png $plain --shade unlit
color several 80 80 ff0000
is "losses" "$(cat stderr)" \
    'zsim: several.ply: not carried over: texture beside the last that the file names (1, "no such.png")'

# ---- glTF's colours of vertices: times the material's. All that are no texels are light
begin gltf_colours_of_vertices
colored() { # FACTOR EMISSION COMPONENTS    a quad whose vertices are ff8040
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{'
    printf '"primitives":[{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0}]}],'
    printf '"materials":[{"name":"M","emissiveFactor":[%s],"pbrMetallicRoughness":{' "$2"
    printf '"metallicFactor":0,"roughnessFactor":1,"baseColorFactor":[%s,1]}}],"bufferViews":[' "$1"
    printf '{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":80,"byteLength":12},'
    printf '{"buffer":0,"byteOffset":92,"byteLength":16,"byteStride":4}],"accessors":['
    printf '{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},'
    printf '{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},{"bufferView":2,"componentType":5121,'
    printf '"normalized":true,"count":4,"type":"VEC%s"}],"buffers":[{"uri":"colored.bin","byteLength":108}]}\n' "$3"
}
{ quad_bin && printf '\377\200\100\377\377\200\100\377\377\200\100\377\377\200\100\377'; } >colored.bin
colored 1,1,1 0,0,0 4 >colored.gltf
halves colored.gltf ffba8c ffba8c # they are light: 188 and 137 of 255, by sRGB's curve
colored 0.5,1,0.25 0,0,0 4 >colored.gltf
halves colored.gltf bdba4a bdba4a # 188, 188 and 71
sed 's/,"COLOR_0":2//' colored.gltf >plain.gltf
halves plain.gltf bdff8c bdff8c # 188, 255 and 137
colored 0,0,0 0,0,1 4 >colored.gltf # it shines, and that is all
halves colored.gltf 0000ff 0000ff
colored 0,0,0 0,0.002,0.2 4 >colored.gltf
halves colored.gltf 00087b 00087b # 7 and 124

# ---- glTF's integers ----------------------------------------------------------------------------------------
begin gltf_integer_positions_and_texture_coordinates
five='\062\000' minus='\316\377' # 50, -50
{
    printf "$minus$minus\000\000zz$five$minus\000\000zz$five$five\000\000zz$minus$five\000\000zz"
    printf '\000\377zz\377\377zz\377\000zz\000\000zz\000\000\001\000\002\000\000\000\002\000\003\000'
} >small.bin
quad_of() { # BUFFER POSITION TEXCOORD    types of these
    printf '{"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],"scene":0,'
    printf '"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{'
    printf '"attributes":{"POSITION":0,"TEXCOORD_0":2},'
    printf '"indices":1,"material":0}]}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],'
    printf '"textures":[{"source":0}],"images":[{"uri":"four.png"}],"bufferViews":[{"buffer":0,"byteLength":32,'
    printf '"byteStride":8},{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":32,"byteLength":16,'
    printf '"byteStride":4}],"accessors":[{"bufferView":0,%s,"count":4,"type":"VEC3"},' "$2"
    printf '{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},'
    printf '{"bufferView":2,"count":4,%s,"type":"VEC2"}],"buffers":[{%s,"byteLength":60}]}\n' "$3" "$1"
}
short='"componentType":5122' byte='"componentType":5121,"normalized":true'
quad_of '"uri":"small.bin"' "$short" "$byte" >small.gltf
cp small.bin 'a small.bin'
quad_of '"uri":"a%20small.bin"' "$short" "$byte" >escaped.gltf
quad_of "\"uri\":\"data:application/octet-stream;base64,$(base64 -w0 small.bin)\"" "$short" "$byte" >inline.gltf
quad_of '"name":"own"' "$short" "$byte" >json
n=$(($(wc -c <json) + 3 & ~3))
{ printf 'glTF\002\000\000\000' && le32 $((n + 88)) && le32 $n && printf "JSON%-${n}s" "$(cat json)" && le32 60 &&
    printf 'BIN\000' && cat small.bin; } >small.glb
for model in small.gltf escaped.gltf inline.gltf small.glb; do
    draw small $model $plain --shade unlit
    same four small
done
quad_of '"uri":"small.bin"' "$short,\"sparse\":{}" "$byte" >sparse.gltf
z render sparse.gltf --out refused/old.png
one_line 1 'sparse.gltf: an accessor makes no sense; export the model again'
quad_of '"uri":"small.bin"' "$short,\"byteOffset\":40" "$byte" >beyond.gltf
z render beyond.gltf --out refused/old.png
one_line 1 'beyond.gltf: an accessor goes beyond its buffer; get the whole file'

# ---- Drawing --------------------------------------------------------------------------------------------
begin gltf_numbers_that_are_replaced
z2='\000\000'
{ # positions, 16 bytes each, the third of which is wrong; its number and it; the same in integers
    printf "$m$m${o}zzzz$p$m${o}zzzz$o$o${o}zzzz$m$p${o}zzzz"
    printf "\002\000zz$p$p$o"
    printf "$minus$minus${z2}zz$five$minus${z2}zz$z2$z2${z2}zz$minus$five${z2}zz$five$five$z2"
} >replaced.bin
replaced() { # TYPE STRIDE BASE VALUES    offsets of these
    views=",{\"buffer\":1,\"byteOffset\":$3,\"byteLength\":$((4 * $2)),\"byteStride\":$2}"
    views="$views,{\"buffer\":1,\"byteOffset\":64,\"byteLength\":4}"
    views="$views,{\"buffer\":1,\"byteOffset\":$4,\"byteLength\":$((118 - $4))}"
    sparse='"sparse":{"count":1,"indices":{"bufferView":4,"componentType":5123},"values":{"bufferView":5}}'
    gltf '"uri":"four.png"' "$bin},{\"uri\":\"replaced.bin\",\"byteLength\":118" '' '' '' "$views" |
        sed "s/{\"bufferView\":0,\"componentType\":5126,/{\"bufferView\":3,\"componentType\":$1,$sparse,/"
}
for how in '5126 16 0 68' '5122 8 80 112'; do
    # shellcheck disable=SC2086 # words of it
    replaced $how >replaced.gltf
    draw replaced replaced.gltf $plain --shade unlit
    same four replaced
done
sed 's/"componentType":5123},"values"/"componentType":5125},"values"/' replaced.gltf >beyond.gltf
z render beyond.gltf --out refused/old.png
one_line 1 'beyond.gltf: accessor 0 replaces element 2054815746 of 4'

begin repeat_and_clamp
uv_obj three -1 -1 2 2
for how in repeat clamp; do
    both $how three.obj $plain --shade unlit --texture four.png --wrap $how
    cmp -s out/$how.png out/${how}_ref.png || wrong "$how: ours and the reference differ"
done
quarters repeat $four
color repeat 100 100 ffffff # u = -0.085, v = -0.085: the last texel each way
color repeat 100 110 00ff00 # v = 0.215
quarters clamp $four
color clamp 100 100 ff0000
color clamp 140 100 00ff00
color clamp 100 140 0000ff

begin resampling
./fixture png rgb odd.png 3 5 ff0000
draw odd bare.obj $plain --shade unlit --texture odd.png
quarters odd ff0000 ff0000 ff0000 ff0000
is "resampled" "$(stat_of odd texture_resampled)" 1
is "texels of 4 x 4" "$(stat_of odd texture_texels)" 16
./fixture png rgb wide.png 2048 1 000000 ffffff
draw wide bare.obj $plain --shade unlit --texture wide.png
is "texels of 256 x 1, as zsim convert writes it" "$(stat_of wide texture_texels)" 256
draw wide bare.obj $plain --shade unlit --texture wide.png --mesh file
quarters wide 848284 848284 848284 848284 # the mean of black and white everywhere
is "texels of 1024 x 1" "$(stat_of wide texture_texels)" 1024
./fixture png rgb three.png 3 1 000000 000000 ffffff
draw three bare.obj $plain --shade unlit --texture three.png
# 4 of 3: each covers 3/4 of an old one: 0, 0, 1/3 of the white one: 1 / 3 * 255 is 85
color three 75 100 000000
color three 140 100 525552
color three 160 100 ffffff
for size in '1 1' '2 1' '1 2' '1024 2' '64 64'; do
    ./fixture png rgb kept.png $size 848284
    draw kept bare.obj $plain --shade unlit --texture kept.png --mesh file
    quarters kept 848284 848284 848284 848284
    is "resampled of $size" "$(stat_of kept texture_resampled)" 0
done

begin unlit_is_the_texel_exactly
./fixture png rgb one.png 2 2 080c10 f7fbef 7b7d7b 849ea5
draw one bare.obj $plain --shade unlit --texture one.png --light 0,0,-1 --ambient 0.1
quarters one 080c10 f7fbef 7b7d7b 849ea5

begin texel_formats
for format in 565 pal8 pal4; do
    draw stored four.obj $plain --shade unlit --texture-format $format # four colours fit
    same four stored
    is "loss of $format" "$(stat_of stored texture_psnr_db)" 999
    draw stored bare.obj $plain --shade unlit --texture white.png --texture-format $format --mesh file
    quarters stored ffffff ffffff ffffff ffffff # 1 x 1
    z render ball.obj --shade unlit --texture numbers.png --texture-format $format --out "out/$format.png" \
        --compare --stats "out/$format.json"
    is "texels that differ" "$(stat_of $format compare_texel_differ)" "$(stat_of 565 compare_texel_differ)"
done
look png out/pal4.png # the background is one more
[ "$(word 3 $seen)" -le 17 ] || wrong "pal4 shows $(word 3 $seen) colours"
look png out/pal8.png
[ "$(word 3 $seen)" -gt 17 ] && [ "$(word 3 $seen)" -le 257 ] || wrong "pal8 shows $(word 3 $seen) colours"
at_least "loss of pal8, dB" "$(stat_of pal8 texture_psnr_db)" 30
at_least "loss of pal4, dB" "$(stat_of pal4 texture_psnr_db)" 19
at_least "loss of pal8 beyond that of pal4, dB" "$(stat_of pal8 texture_psnr_db)" \
    "$(stat_of pal4 texture_psnr_db)"

begin light_times_texel
for shade in textured textured-flat; do
    both lit four.obj $plain --shade $shade --light 0,0,1
    quarters lit $four
    quarters lit_ref $four
    # ambient alone: round(31 / 4) is 8, round(63 / 4) is 16
    both dim four.obj $plain --shade $shade --light 0,0,-1
    quarters dim 420000 004100 000042 424142
    quarters dim_ref 420000 004100 000042 424142
    # 1 + 1/2 times full stays full
    both over four.obj $plain --shade $shade --light 0,0,1 --ambient 1 --diffuse 0.5
    quarters over $four
    quarters over_ref $four
done

begin edges_are_round_where_the_file_has_normals
roof() { # MORE-OF-CORNERS [LINE]    two slopes that meet at a ridge
    obj roof 'mtllib four.mtl' 'v -50 -50 0' 'v 0 -50 50' 'v 0 50 50' 'v -50 50 0' 'v 50 -50 0' 'v 50 50 0' \
        'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' ${2:+"$2"} 'usemtl A' "f 1/1$1 2/2$1 3/3$1 4/4$1" \
        "f 2/1$1 5/2$1 6/3$1 3/4$1"
}
as_is() { # SHADE OPTION...    that is what is drawn without --shade
    shade=$1
    shift
    draw usual roof.obj $plain "$@"
    draw asked roof.obj $plain "$@" --shade "$shade"
    same usual asked
}
roof ''
as_is textured-flat --light 1,0,2
draw round roof.obj $plain --light 1,0,2 --shade textured
other usual round png
z render roof.obj --out out/lamp.png $plain --light dir:1,0,2 # by normals at vertices
cmp -s out/lamp.png out/usual.png || wrong "a lamp in place of the light changes the frame"
z render roof.obj --out out/lamp.png $plain --light dir:1,0,2:ff0000
color lamp 80 80 7b0000 # 1/4 and 3/4 / sqrt(10)
color lamp 160 80 004100
sed 's/usemtl A/usemtl G/; s/four.mtl/gloss.mtl/' roof.obj >gloss.obj
printf 'newmtl G\nmap_Kd four.png\nKs 1 1 1\nNs 20\n' >gloss.mtl
z convert gloss.obj --name m --out out/roof
grep -q 'zs_shade_texture_gloss,' out/roof/m.c || wrong "without normals highlights are not written"
z render gloss.obj --out out/gloss.png $plain --light 0,0,1
is "losses" "$(cat stderr)" ''
roof /1 'vn 0 0 1'
as_is textured --light 1,0,2
z convert roof.obj --name m --out out/roof
grep -q 'zs_shade_texture_smooth,' out/roof/m.c || wrong "with normals no smooth light is written"
roof ''
z convert roof.obj --name m --out out/roof
grep -q 'zs_shade_texture_flat,' out/roof/m.c || wrong "without normals no flat light is written"

begin smooth_light_between_vertices
obj normals 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' 'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' \
    'vn 0 0 1' 'vn 1 0 0' 'f 1/1/1 2/2/2 3/3/2 4/4/1'
both shaded normals.obj $plain --shade textured --texture white.png --light 0,0,1 --ambient 0.25 --diffuse 0.75
# 1 at the left edge, 1/4 at the right: at pixel x, 1 - 0.75 (x - 69.5) / 100, in 31sts and 63rds
for x in 70 90 119 120 150 169; do
    want=$(awk -v x=$x 'BEGIN { l = 1 - 0.75 * (x - 69.5) / 100; r = int(31 * l + 0.5); g = int(63 * l + 0.5)
        printf "%02x%02x%02x", r * 8 + int(r / 4), g * 4 + int(g / 16), r * 8 + int(r / 4) }')
    color shaded_ref $x 100 "$want"
done
z render normals.obj $plain --shade textured --texture white.png --light 0,0,1 --out out/c.png --compare \
    --stats out/c.json
at_most "largest difference of a channel" "$(stat_of c compare_channel_max_diff)" 1
is "texels that differ" "$(stat_of c compare_texel_differ)" 0

# A floor seen along it: for every 3rd pixel, the texel by a ray from the eye. Eye (0, -60, 8) looks at
# 0,0,0 with z up; 240 px in 60 degrees. Samples closer than 1/50 texel to a border are left out.
begin perspective_by_rays
floor='--eye 0,-60,8 --at 0,0,0 --up 0,0,1 --near 1 --far 200 --fov 60'
awk 'BEGIN { pi = atan2(0, -1); d = sqrt(3664); f = 120 / (sin(pi / 6) / cos(pi / 6))
    by = -60 / d; bz = 8 / d # back; right is x, up = back x right = (0, bz, -by)
    for (y = 0; y < 240; y += 3) for (x = 0; x < 240; x += 3) {
        sx = x + 0.5 - 120; sy = 120 - y - 0.5
        rx = sx; ry = sy * bz - f * by; rz = -sy * by - f * bz
        if (rz >= 0) continue
        t = -8 / rz; u = (t * rx + 50) / 100; v = 1 - (-60 + t * ry + 50) / 100
        if (u < 0 || u >= 1 || v < 0 || v >= 1) continue
        a = u * 64 - int(u * 64); b = v * 64 - int(v * 64)
        if (a > 0.02 && a < 0.98 && b > 0.02 && b < 0.98) print x, y, int(u * 64), int(v * 64) } }' >points
both floor bare.obj $floor --shade unlit --texture numbers.png
look texels out/floor_ref.png <points
at_least "points compared" "$(word 1 $seen)" 3000
is "points where the reference has that texel" "$(word 2 $seen)" "$(word 1 $seen)"
look texels out/floor.png <points
at_least "points where ours has it" "$(word 2 $seen)" $(($(word 1 $seen) * 99 / 100))
at_most "texels apart" "$(word 3 $seen)" 1

begin ours_against_the_reference
for shade in textured textured-flat unlit; do
    for view in "bare.obj $floor" ball.obj 'ball.obj --eye 0.9,0.3,1.1 --at 0,0.3,0 --near 0.01 --far 4'; do
        z render $view --shade $shade --texture numbers.png --out out/c.png --compare --stats out/c.json
        [ $status -eq 0 ] || wrong "status $status: $(said)"
        grep -q '^Texels: ' stdout || wrong "--compare says nothing of texels"
        texels=$(stat_of c compare_texels)
        at_least "texels compared, $shade of $view" "$texels" 20000
        at_most "texels that differ" "$(stat_of c compare_texel_differ)" $((texels * 3 / 100))
        at_most "texels more than 1/8 off" "$(stat_of c compare_texel_far)" $((texels / 10000))
        at_most "channels more than one code off" "$(stat_of c compare_channel_off)" 0
        at_most "missing" "$(stat_of c compare_missing)" 3
        echo "measured: $shade, ${view%% *}: $(stat_of c compare_texel_differ) of $texels texels differ, at most" \
            "$(stat_of c compare_texel_max_distance) off; $(stat_of c compare_channel_off_one_fraction)" \
            "of channels one code off"
    done
done

begin strips_and_pools_change_nothing
draw whole ball.obj --shade textured --texture numbers.png
for how in '--strip 1' '--strip 240' '--tris 7' '--verts 9' '--buffers 1' '--fast none'; do
    draw part ball.obj --shade textured --texture numbers.png $how
    same whole part
done

# Faces 1 and 2: four.png; 3 and 4: a colour; 5 and 6: numbers.png; 7 and 8: four.png, but
# one corner has no uv, so the face has none
begin materials_in_file_order
obj mixed 'mtllib mixed.mtl' 'v -50 -50 0' 'v 0 -50 0' 'v 0 0 0' 'v -50 0 0' 'v 50 -50 0' 'v 50 0 0' \
    'v 0 50 0' 'v -50 50 0' 'v 50 50 0' 'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' \
    'usemtl A' 'f 4/1 3/2 7/3 8/4' 'usemtl B' 'f 3/1 6/2 9/3 7/4' 'usemtl C' 'f 1/1 2/2 3/3 4/4' \
    'usemtl A' 'f 2/1 5/2 6/3 3'
printf '%s\n' 'newmtl A' 'Kd 1 1 1' 'map_Kd four.png' 'newmtl B' 'Kd 0 1 0' 'newmtl C' \
    'map_Kd numbers.png' >mixed.mtl
draw mixed mixed.obj $plain --shade unlit --mesh file
color mixed 80 80 ff0000
color mixed 110 110 ffffff
color mixed 145 95 00ff00
color mixed 145 145 ffffff # Kd of A
is "parts" "$(stat_of mixed parts)" 4
is "textures" "$(stat_of mixed textures)" 2
draw converted mixed.obj $plain --shade unlit
same mixed converted
is "parts by material" "$(stat_of converted parts)" 3
draw plainly mixed.obj $plain --shade flat
cmp -s out/mixed.u32 out/plainly.u32 || wrong "triangles are numbered otherwise than without textures"
cmp -s out/mixed.pgm out/plainly.pgm || wrong "depth differs from that without textures"
for shade in textured:smooth textured-flat:flat; do
    z render mixed.obj --eye 3,1,120 --at 0,0,0 --fov 90 --light 1,2,3 --shade "${shade%:*}" --compare --out out/c.png \
        --stats out/c.json
    at_most "largest difference of a channel, $shade" "$(stat_of c compare_channel_max_diff)" 1
    is "triangles that differ" "$(stat_of c compare_wrong_triangle)" 0
    draw mixed mixed.obj $plain --light 1,2,3 --shade "${shade%:*}"
    draw plainly mixed.obj $plain --light 1,2,3 --shade "${shade#*:}"
    for at in '145 95' '145 145'; do # faces without a texture look as they do under plain shading
        look pixel out/plainly.png $at
        color mixed $at "$seen"
    done
done

# ---- Texture coordinates as 16-bit integers ------------------------------------------------------------
begin uv_bits
uv_obj half 0 0 0.999 0.999
for case in 'bare 15' 'half 15' 'three 14' 'five 13'; do
    draw uv "${case% *}.obj" $plain --shade unlit --texture numbers.png --mesh file
    is "bits of $case" "$(stat_of uv uv_bits_least)" "${case#* }"
    at_most "error in texels of $case" "$(stat_of uv uv_error_texels)" 0.002
done
uv_obj far 7.25 -1000.5 8.25 -999.5 # whole repeats are taken off
uv_obj near 0.25 0.5 1.25 1.5
draw far far.obj $plain --shade unlit --texture numbers.png --mesh file
draw near near.obj $plain --shade unlit --texture numbers.png --mesh file
same far near
is "bits of a picture far away" "$(stat_of far uv_bits_least)" 15
# 64 strips that go on across 192 repeats: as a whole too far for 1/16 texel, triangle by triangle not
awk 'BEGIN { for (i = 0; i <= 64; i++) {
        printf "v %.6f -50 0\nv %.6f 50 0\nvt %.6f 0\nvt %.6f 1\n", i * 1.5625 - 50, i * 1.5625 - 50, i * 3.01, i * 3.01
        if (i > 0) printf "f %d/%d %d/%d %d/%d %d/%d\n", 2*i-1, 2*i-1, 2*i+1, 2*i+1, 2*i+2, 2*i+2, 2*i, 2*i } }' \
            >many.obj
z render many.obj $plain --mesh file --shade unlit --texture numbers.png --compare --out out/c.png --stats out/c.json
is "status of many repeats" $status 0
at_most "error in texels" "$(stat_of c uv_error_texels)" 0.0625
at_least "bits" "$(stat_of c uv_bits_least)" 12
at_least "vertices" "$(stat_of c vertices_in)" 131
at_most "texels that differ" "$(stat_of c compare_texel_differ)" 300
z render many.obj $plain --shade unlit --texture numbers.png --compare --out out/c.png --stats out/c.json
is "status of many repeats, converted" $status 0
at_most "error in texels, converted" "$(stat_of c uv_error_texels)" 0.5
uv_obj whole 0 0 1000 1000 # corners that are integers are held exactly
draw whole whole.obj $plain --shade unlit --texture numbers.png
is "error" "$(stat_of whole uv_error_texels)" 0

# ---- Float depth ------------------------------------------------------------------------------------------
# key of r = near / 120 by the formula, to nearest; tests of the quad at 120
float_key() { # E BITS NEAR
    awk -v e="$1" -v b="$2" -v n="$3" 'BEGIN { m = b - e; r = n / 120; k = 0
        while (k < 2 ^ e - 2 && r < 2 ^ -(k + 1)) k++
        key = 2 ^ b - ((2 ^ e - 2 - k) * 2 ^ m + r * 2 ^ (k + 1 + m))
        key = int(key + 0.5); if (key > 2 ^ b - 2) key = 2 ^ b - 2
        print key }'
}
begin float_depth_by_the_formula
for depth in 3:e3m13 4:e4m12 5:e5m11; do
    for bits in 16 12 8; do
        for near in 120 119 60 20 7.5 1 0.3 0.01 0.0001; do
            for far in 121 1000; do
                draw key quad.obj --reference --eye 0,0,120 --at 0,0,0 --fov 90 --near $near --far $far \
                    --depth "${depth#*:}" --depth-bits $bits
                want=$(float_key "${depth%:*}" $bits $near)
                look pgm out/key.pgm 240 240
                is "key of ${depth#*:}, $bits bits, near $near, far $far" "$seen" "10000 $want $want"
            done
        done
    done
done

begin float_depth_is_the_default
for case in '20 2560 e3m13' '20 2570 e4m12' '1 32700 e4m12' '1 33000 e5m11'; do
    set -- $case
    draw float quad.obj --eye 0,0,120 --at 0,0,0 --fov 90 --near $1 --far $2
    draw named quad.obj --eye 0,0,120 --at 0,0,0 --fov 90 --near $1 --far $2 --depth $3
    same float named
    draw ref quad.obj --reference --eye 0,0,120 --at 0,0,0 --fov 90 --near $1 --far $2 --depth float
    look keys out/float.pgm out/ref.pgm
    is "keys of ours and the reference, $case" "$seen" "10000 0 0"
done

begin float_depth_ours
for depth in e3m13 e4m12 e5m11; do
    for view in 'quad.obj --eye 0,0,120 --at 0,0,0 --fov 90 --near 20 --far 420' "quad.obj $floor" \
        'ball.obj --eye 0.9,0.3,1.1 --at 0,0.3,0 --near 0.01 --far 4'; do
        for bits in 16 9; do
            z render $view --precise --depth $depth --depth-bits $bits --compare --out out/c.png --stats out/c.json
            [ $status -eq 0 ] || wrong "status $status: $(said)"
            at_most "keys more than 1 off, $depth, $bits bits, $view" "$(stat_of c compare_key_off)" \
                "$(($(stat_of c pixels_visible) / 20))"
            is "triangles that differ" "$(stat_of c compare_wrong_triangle)" 0
        done
    done
done

# ---- Refused -------------------------------------------------------------------------------------------------
quad_obj gone 'map_Kd gone.png'
refused missing_picture "'gone.png' is missing" gone.obj --shade textured
refused no_textures 'no face of it has a texture' bare.obj --shade textured
refused no_textures_ply 'no texture coordinates; unwrap it' quad.obj --shade unlit
obj lost 'mtllib lost.mtl' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'vt 0 0' 'vt 1 0' 'vt 0 1' 'usemtl A' 'f 1/1 2/2 3/3'
refused missing_mtl 'lost.mtl' lost.obj --shade unlit
refused no_coordinates 'no texture coordinates' quad.obj --shade textured --texture four.png
refused texture_without_shade '--shade textured' bare.obj --shade flat --texture four.png
uv_obj often 0 0 1000.37 1000.37
refused repeats_too_often '1/16 texel' often.obj --mesh file --shade unlit --texture numbers.png
uv_obj huge 0 0 1e30 1
refused coordinate_huge '1e+30' huge.obj --shade unlit --texture numbers.png
sed 's/quad.bin/nan.bin/' file.gltf >nan.gltf
{ head -c 48 quad.bin && printf '\000\000\300\177' && tail -c 40 quad.bin; } >nan.bin
refused coordinate_nan 'nan' nan.gltf --shade unlit
for depth in e3m13 e4m12 e5m11; do
    refused orthographic_$depth "$depth" quad.obj --depth $depth --projection orthographic
done

./fixture png rgb noise.png 64 64 \
    $(awk 'BEGIN { srand(3); for (i = 0; i < 4096; i++) printf "%06x ", rand() * 16777215 }')
./fixture jpg noise.jpg 64 64 $(awk 'BEGIN { srand(3); for (i = 0; i < 4096; i++) printf "%06x ", rand() * 16777215 }')
head -c 6000 noise.png >cut.png
head -c 3000 noise.jpg >cut.jpg
head -c 100 noise.jpg >short.jpg
head -c 8 noise.png >short.png
{ head -c 5000 noise.png && printf 'oops' && tail -c +5005 noise.png; } >bent.png
: >empty.png
cp quad.obj text.png
./fixture cmyk cmyk.jpg 8 8
./fixture png bit tall.png 1 16385 000000
for case in 'cut.png broken PNG' 'short.png broken PNG' 'bent.png broken PNG' 'cut.jpg broken JPEG' \
    'short.jpg broken JPEG' 'empty.png neither a PNG nor a JPEG' 'text.png neither a PNG nor a JPEG' \
    'cmyk.jpg CMYK' 'nowhere.png cannot be read' 'alone not a regular file' 'tall.png save it smaller'; do
    file=${case%% *}
    picture_refused "picture_$(echo "$file" | tr . _)" "$file" "${case#* }" bare.obj --shade unlit --texture "$file"
done
quad_obj broken 'map_Kd cut.png'
picture_refused picture_of_the_model cut.png 'broken PNG' broken.obj --shade unlit
gltf "\"uri\":\"data:image/png;base64,$(base64 -w0 cut.png)\"" "$bin" >broken.gltf
picture_refused picture_in_the_model 'broken.gltf, picture *0' 'broken PNG' broken.gltf --shade unlit
begin broken_pictures_do_not_matter_unless_drawn
draw flat broken.obj $plain --shade flat
draw flat gone.obj $plain --shade smooth

# ---- Scenes as the reference sees them, from inside ----------------------------------------------------------
finish
built=$(dirname "$zsim")
built=${built%/test}/test
if gcc -O1 -g -fsanitize=address,undefined -no-pie -Wall -Wextra -Werror -I"$top/sim/cli" -I"$top/sim/frame" \
    -I"$top/sim/compare" -I"$top/sim/reference" -I"$top/firmware/zstrip" "$top/tests/tools/texel_reference.c" \
    "$built/sim/compare/scene_reference.o" "$built/sim/frame/frame.o" "$built/sim/frame/frame_ids.o" \
    "$built/sim/frame/method_names.o" "$built/sim/frame/scene_share.o" "$built/sim/frame/texel_numbers.o" \
    "$built/sim/cli/sim.o" "$built/sim/reference/reference.o" "$built/sim/reference/lamps.o" "$built/libtest.a" \
    -lm -o texel_reference; then
    ./texel_reference || n_failed=$((n_failed + 1))
else
    echo 'FAILED texel_reference: tests/tools/texel_reference.c does not build'
    n_failed=$((n_failed + 1))
fi

for pair in '--shade Textured' '--wrap mirror' '--texture-format 332' '--texture-format pal2' '--depth e6m10'; do
    usage "$(echo "${pair#--}" | tr -c 'A-Za-z0-9\n' _)" "${pair%% *}" render quad.obj --out refused/x.png $pair
done
for option in --texture --texture-format --wrap; do
    usage "value_missing_$(echo "${option#--}" | tr - _)" "$option" render quad.obj --out refused/x.png $option
done

finish
[ $n_failed -eq 0 ]
