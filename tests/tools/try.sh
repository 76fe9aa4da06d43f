#!/bin/sh
# `zsim try`, `zsim render --turntable` and --simplify: pictures are read by another program than writes them, views are
# those that zsim render draws, models are whole in all of them, and figures are those of zsim budget and zsim convert.
# Usage: tests/tools/try.sh ZSIM WORKDIR     as tests/tools/cli.sh
. tests/tools/zsim.sh
gcc -O1 -Wall -Wextra -Werror -fsanitize=address,undefined -fsanitize-undefined-trap-on-error \
    "$top/tests/tools/moving.c" "$top/tests/lib/leaks.c" -lz -o moving || exit 1

# A ball of 16 x 8 quads and triangles, radius 1; $1: 1 inside out, 2 half of it, open at the top, 3 upright along z
ball() {
    awk -v how="$1" 'BEGIN { pi = atan2(0, -1); n = 16; m = 8
        v(0, 1, 0)
        for (i = 1; i < m; i++) for (j = 0; j < n; j++)
            v(sin(pi * i / m) * sin(2 * pi * j / n), cos(pi * i / m), sin(pi * i / m) * cos(2 * pi * j / n))
        v(0, -1, 0); last = 2 + (m - 1) * n
        for (j = 0; j < n; j++) f(1, 2 + j, 2 + (j + 1) % n)
        for (i = 0; i < (how == 2 ? m / 2 - 1 : m - 2); i++) for (j = 0; j < n; j++) {
            a = 2 + i * n + j; b = 2 + i * n + (j + 1) % n
            f(a, a + n, b + n); f(a, b + n, b) }
        for (j = 0; j < n && how != 2; j++) f(last - n + (j + 1) % n, last - n + j, last) }
        function v(x, y, z) { if (how == 3) printf "v %.6f %.6f %.6f\n", x, -z, y
            else if (how == 2) printf "v %.6f %.6f %.6f\n", x, -y, -z; else printf "v %.6f %.6f %.6f\n", x, y, z }
        function f(a, b, c) { if (how == 1) print "f", a, c, b; else print "f", a, b, c }'
}
ball 0 >ball.obj
ball 1 >inverted.obj
ball 2 >half.obj
ball 3 >upright.obj
awk '$1 == "v" { x[++n] = $2 " " $3 " " $4 } $1 == "f" {
    print "facet normal 0 0 0\nouter loop\nvertex " x[$2] "\nvertex " x[$3] "\nvertex " x[$4] "\nendloop\nendfacet" }
    BEGIN { print "solid ball" } END { print "endsolid ball" }' upright.obj >upright.stl
# A long thing that is not upright
awk 'BEGIN {
    for (i = 0; i <= 40; i++) { y = 0.2 * i; print "v", i, y, 0; print "v", i, y + 1, 0; print "v", i, y, 1 }
    for (i = 0; i < 40; i++) { a = 3 * i + 1; for (k = 0; k < 3; k++) { b = a + k; c = a + (k + 1) % 3
        print "f", b, c, c + 3; print "f", b, c + 3, b + 3 } } }' >long.obj
moving() { # ARGUMENT...
    if ! seen=$(./moving "$@"); then wrong "moving $*: $seen"; fi
}
frame() { # FILE K TO [PART]    its pixels
    of=$1 number=$2 pixels=$3
    shift 3
    ./moving "$of" "$number" "$@" >"$pixels" || wrong "frame $number of $of: $(head -c 100 "$pixels")"
}
trial() { # DIR MODEL OPTION...
    dir=$1
    shift
    rm -rf "$dir"
    z try "$@" --out "$dir"
    [ $status -eq 0 ] && [ ! -s stderr ] || wrong "status $status: $(said)"
}

begin writes_a_turntable_and_a_sheet
trial a ball.obj
is "files" "$(ls -A a | tr '\n' ' ')" "sheet.png turntable.png "
is "named" "$(head -n 1 stdout)" "a/turntable.png, a/sheet.png"
moving a/turntable.png
is "width, height, frames, ms" "${seen% *}" "240 240 36 2988"
[ "${seen##* }" -lt $((240 * 240 * 34)) ] || wrong "each frame is all of the picture: ${seen##* } pixels"
moving a/sheet.png
is "width, height, frames, ms of the sheet" "${seen% *}" "960 480 1 0"
trial b long.obj --frames 8 --size 100x60 --gif
is "files with --gif" "$(ls -A b | tr '\n' ' ')" "sheet.png turntable.gif turntable.png "
frame b/turntable.png all frames.rgb
frame b/turntable.gif all gif.rgb
cmp -s frames.rgb gif.rgb || wrong "a frame of the GIF, of fewer than 256 colours, is not the PNG's"
for k in 0 1 2 3 4 5 6 7; do
    frame b/turntable.png $k frame.rgb
    frame b/sheet.png 0 cell.rgb $((k % 4 * 100)) $((k / 4 * 60)) 100 60
    cmp -s frame.rgb cell.rgb || wrong "view $k of the sheet is not frame $k"
    [ "$k" -eq 0 ] || ! cmp -s frame.rgb before.rgb || wrong "frame $k is the one before"
    mv frame.rgb before.rgb
done
trial c ball.obj
cmp -s a/turntable.png c/turntable.png && cmp -s a/sheet.png c/sheet.png || wrong "not the same again"

begin gif_of_many_colours
obj colors 'v 0 0 0 1 0 0' 'v 4 0 0 0 1 0' 'v 4 3 0 0 0 1' 'v 0 3 0 1 1 1' 'v 2 1 2 0 0 0' \
    'f 1 2 5' 'f 2 3 5' 'f 3 4 5' 'f 4 1 5' 'f 1 4 3 2'
z render colors.obj --shade smooth --turntable 5 --out colors.gif --size 200x150
z render colors.obj --shade smooth --turntable 5 --out colors.png --size 200x150
z render colors.obj --shade smooth --out still.png --size 200x150
frame still.png 0 still.rgb
frame colors.png 0 png.rgb
cmp -s still.rgb png.rgb || wrong "the first frame is not what render draws"
frame colors.gif all gif.rgb
frame colors.png all png.rgb
is "bytes of pixels of the GIF" "$(wc -c <gif.rgb)" "$(wc -c <png.rgb)"
cmp -l gif.rgb png.rgb | awk 'function dec(o) { return int(o / 100) * 64 + int(o / 10) % 10 * 8 + o % 10 }
    { d = dec($2) - dec($3); sum[int(($1 - 1) / 90000)] += d * d }
    END { for (k in sum) if (sum[k] / (200 * 150 * 3) > 40) { print k, sum[k] / 90000; exit 1 } }' >far ||
    wrong "frame $(cat far) mean square error of the GIF"

begin mp4_by_ffmpeg
# In place of ffmpeg: what it is told, and the frames that it gets
mkdir -p fake bare
cat >fake/ffmpeg <<'EOF'
#!/bin/sh
printf '%s\n' "$@" >told.txt
cat >got.rgb
for to; do :; done
echo film >"$to"
EOF
chmod +x fake/ffmpeg
path=$PATH
PATH=$PWD/fake:$path z render colors.obj --shade smooth --turntable 5 --out colors.mp4 --size 200x150
is "the file" "$(cat colors.mp4)" film
frame colors.png all all.rgb
cmp -s got.rgb all.rgb || wrong "ffmpeg does not get the frames of the PNG"
told=$(tr '\n' ' ' <told.txt)
case $told in *' -s 200x150 -framerate 1000/600 '*) ;; *) wrong "ffmpeg is told $told" ;; esac
printf '#!/bin/sh\necho "no encoder" >&2\nexit 1\n' >fake/ffmpeg
rm colors.mp4
PATH=$PWD/fake:$path z render colors.obj --turntable 5 --out colors.mp4 --size 200x150
one_line 1 'colors.mp4: cannot be written by ffmpeg: no encoder'
PATH=$PWD/bare z render colors.obj --turntable 5 --out colors.mp4 --size 200x150
one_line 1 'colors.mp4: is written by ffmpeg, which is not installed'
is "what is left" "$(ls -A | grep -c 'colors.mp4')" 0

begin mp4_of_ffmpeg_itself
if command -v ffmpeg >/dev/null; then
    z render colors.obj --shade smooth --turntable 5 --out colors.MP4 --size 101x75
    is "kind of file" "$(dd if=colors.MP4 bs=1 skip=4 count=4 2>/dev/null)" ftyp
else
    skipped 'ffmpeg is not installed'
fi

begin models_are_whole_and_large
for model in ball.obj long.obj half.obj colors.obj; do
    for size in 240x240 300x100 90x200; do
        trial whole $model --frames 8 --size $size
        w=${size%x*} h=${size#*x} widest=0 highest=0 k=0
        frame whole/turntable.png all boxes box
        while read -r left top right bottom _; do
            [ "$left" -gt 0 ] && [ "$top" -gt 0 ] && [ "$right" -lt $((w - 1)) ] && [ "$bottom" -lt $((h - 1)) ] ||
                wrong "$model at $size touches the border in view $k: $left $top $right $bottom"
            wide=$((right - left)) high=$((bottom - top))
            [ $wide -le $widest ] || widest=$wide
            [ $high -le $highest ] || highest=$high
            k=$((k + 1))
        done <boxes
        is "boxes of $model at $size" $k 8
        [ $((100 * widest)) -gt $((60 * w)) ] || [ $((100 * highest)) -gt $((60 * h)) ] ||
            wrong "$model at $size is small: $widest x $highest"
    done
done

begin choices
trial a ball.obj
grep -q 'shading  *flat, front sides' stdout || wrong "of a ball: $(grep shading stdout)"
moving a/turntable.png 0 box
is "behind what is bright" "$(word 5 $seen)" 293042
for model in inverted half; do
    trial a $model.obj
    grep -q 'shading  *flat, both sides' stdout || wrong "of $model: $(grep shading stdout)"
done
sed 's/^f \(.*\) \(.*\) \(.*\)/f \1\/\1\/\1 \2\/\2\/\2 \3\/\3\/\3/
    s/^v \(.*\)/v \1\nvn \1\nvt 0 0/' ball.obj >smooth.obj
trial a smooth.obj
grep -q 'shading  *smooth' stdout || wrong "with normals: $(grep shading stdout)"
{ echo 'mtllib dark.mtl'; echo 'usemtl dark'; cat smooth.obj; } >dark.obj
printf 'newmtl dark\nKd 0.1 0.1 0.1\n' >dark.mtl
trial a dark.obj
moving a/turntable.png 0 box
is "behind what is dark" "$(word 5 $seen)" dee3e7
printf 'newmtl dark\nKd 1 1 1\nmap_Kd b/sheet.png\n' >dark.mtl
trial a dark.obj
grep -q 'shading  *textured,' stdout || wrong "with a texture: $(grep shading stdout)"
printf 'newmtl other\n' >dark.mtl
mv dark.mtl other.mtl
trial a dark.obj
grep -q 'not used: material file dark.mtl' stdout || wrong "it does not say what it leaves out"
trial a upright.stl
trial b upright.obj --up 0,0,1
cmp -s a/turntable.png b/turntable.png || wrong "an STL does not stand upright along z"
trial b upright.obj
! cmp -s a/turntable.png b/turntable.png || wrong "--up does nothing"

begin figures
trial a ball.obj
grep -q '^ball.obj: 224 triangles, 114 points, 1 material, 0 textures$' stdout || wrong "$(sed -n 2p stdout)"
data=$(sed -n 's/^  flash  *\([0-9]*\) bytes of scene data.*/\1/p' stdout)
ram=$(sed -n 's/^  RAM  *\([0-9]*\) bytes.*/\1/p' stdout)
for part in rp2040 stm32f405 esp32-c3; do
    fps=$(sed -n "s/^  $part  *\([0-9.]*\) frames a second at [0-9]* MHz, estimated\$/\1/p" stdout)
    awk -v a="$fps" 'BEGIN { exit !(a > 1 && a < 5000) }' || wrong "$part: '$fps' frames a second"
done
z budget ball.obj --shade flat
is "scene data" "$data" "$(awk '$1 == "scene" && $2 == "data" { print $3 }' stdout)"
awk -v ours="$ram" '/^Flash/ { exit } $1 == "together" { exit !(ours > 0.9 * $2 && ours < 1.1 * $2) }' stdout ||
    wrong "RAM is $ram, of zsim budget $(grep together stdout | head -n 1)"

begin materials_are_those_of_triangles
{ echo 'mtllib three.mtl'; echo 'usemtl b'; cat ball.obj; } >three.obj
printf 'newmtl a\nnewmtl b\nKd 1 0 0\nnewmtl c\n' >three.mtl
trial a three.obj
grep -q '^three.obj: 224 triangles, 114 points, 1 material, 0 textures$' stdout || wrong "$(sed -n 2p stdout)"

begin triangles_without_an_area_are_named
{ cat ball.obj; echo 'f 1 1 2'; echo 'f 2 3 2'; } >flat_too.obj
trial a flat_too.obj
grep -q '^  not used: 2 triangles without an area$' stdout || wrong "$(sed -n 2,4p stdout)"
trial a ball.obj
! grep -q 'not used' stdout || wrong "$(grep 'not used' stdout)"

begin render_turntable
for size in 60x60 50x80; do
    z render colors.obj --turntable 4 --out turn.png --size $size --eye 1,2,9 --at 1,1,0.5 --cull none
    is status $status 0
    for view in '0 1,2,9' '1 9.5,2,0.5' '2 1,2,-8' '3 -7.5,2,0.5'; do
        z render colors.obj --out still.png --size $size --eye ${view#* } --at 1,1,0.5 --cull none
        frame turn.png ${view% *} turn.rgb
        frame still.png 0 still.rgb
        cmp -s turn.rgb still.rgb || wrong "view ${view% *} is not what is seen from ${view#* }"
    done
done
z render colors.obj --turntable 1 --out turn.png
z render colors.obj --out still.png
frame turn.png 0 turn.rgb
frame still.png 0 still.rgb
cmp -s turn.rgb still.rgb || wrong "a turn of one view is not the frame"
z render colors.obj --turntable 3 --out turn.png --panel ssd1306:128x64
moving turn.png
is "of a panel" "$(word 1 $seen)x$(word 2 $seen), $(word 3 $seen)" "128x64, 3"
z render colors.obj --turntable 3 --out turn.png --stats s.json
one_line 2 'turntable writes pictures alone'
z render colors.obj --turntable 0 --out turn.png
one_line 1 'turntable 0 is outside its range'

begin losses_are_named_as_by_render
z render ball.obj --out dot.png --size 8x8
obj lossy 'mtllib lossy.mtl' 'v 0 0 0 1 0 0' 'v 1 0 0 1 0 0' 'v 0 1 0 1 0 0' 'vt 0 0' 'vt 1 0' 'vt 0 1' 'usemtl a' \
    'f 1/1 2/2 3/3'
printf 'newmtl a\nmap_Kd dot.png\nKs 0.1 0.1 0.1\nNs 9\n' >lossy.mtl
for what in 'vertex colours under a texture (1, of material "a")' \
    'highlights on a texture, too faint for what they cost (1, of material "a")'; do
    echo "not carried over: $what"
done >want
z render lossy.obj --out still.png
sed 's/^zsim: lossy.obj: //' stderr | cmp -s want - || wrong "render says $(said)"
z render lossy.obj --turntable 2 --out turn.png
is status $status 0
sed 's/^zsim: lossy.obj: //' stderr | cmp -s want - || wrong "render --turntable says $(said)"
trial a lossy.obj
sed -n 's/^  not carried/not carried/p' stdout | cmp -s want - || wrong "try says $(tr '\n' '|' <stdout)"

# ---- Simplified ---------------------------------------------------------------------------------
awk 'BEGIN { n = 60; pi = atan2(0, -1)
    for (i = 0; i <= n; i++) for (j = 0; j <= n; j++) {
        printf "v %g %g %g\nvt %g %g\n", i / n * 4, sin(pi * i / n) * sin(pi * j / n), j / n * 4, i / n, j / n }
    for (i = 0; i < n; i++) for (j = 0; j < n; j++) { a = i * (n + 1) + j + 1
        printf "f %d/%d %d/%d %d/%d\nf %d/%d %d/%d %d/%d\n", a, a, a + 1, a + 1, a + n + 2, a + n + 2, a, a,
            a + n + 2, a + n + 2, a + n + 1, a + n + 1 } }' >hill.obj
# Its triangles one by one, each with a normal of its own
awk '$1 == "v" { x[++n] = $2; y[n] = $3; z[n] = $4 } $1 == "f" {
    for (k = 1; k <= 3; k++) { split($(k + 1), p, "/"); i[k] = p[1] }
    for (k = 1; k <= 3; k++) printf "v %s %s %s\n", x[i[k]], y[i[k]], z[i[k]]
    ax = x[i[2]] - x[i[1]]; ay = y[i[2]] - y[i[1]]; az = z[i[2]] - z[i[1]]
    bx = x[i[3]] - x[i[1]]; by = y[i[3]] - y[i[1]]; bz = z[i[3]] - z[i[1]]
    printf "vn %g %g %g\nf -3//-1 -2//-1 -1//-1\n", ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx }' \
    hill.obj >faces.obj
begin fewer_triangles
for model in hill faces; do
    z convert $model.obj --name m --out m --simplify 900
    is "$model, status" $status 0
    after=$(sed -n 's/^  simplified: 7200 triangles before, \([0-9]*\) after.*/\1/p' stdout)
    [ "${after:-0}" -le 900 ] && [ "${after:-0}" -gt 800 ] || wrong "$model: $(grep simplified stdout)"
    is "$model, triangles" "$(awk '$2 == "triangles," { print $1 }' stdout)" "$after"
    grep -q -- '--simplify 900' m/m.h || wrong "m.h does not say it"
done
for error in 0.01 1% 0.1%; do
    z convert hill.obj --name m --out m --simplify $error
    off=$(sed -n 's/.*off by about \([0-9.e-]*\) %.*/\1/p' stdout)
    awk -v off="$off" -v most="$error" 'BEGIN { most = most ~ /%/ ? most + 0 : 100 * most
        exit !(off > most / 20 && off <= most) }' ||
        wrong "--simplify $error: off by $off %"
done
begin simplified_surface_is_where_it_was
view='--eye 2,8,2 --at 2,0,2 --up 0,0,1 --near 1 --far 12 --projection orthographic --cull none'
view="$view --texture b/sheet.png --shade unlit"
z render hill.obj $view --out s0.png --depth-out s0.pgm
for n in 2000 800; do
    z render hill.obj $view --out s1.png --depth-out s1.pgm --simplify $n
    grep -q "^simplified: 7200 triangles before, [0-9]* after" stdout ||
        wrong "render does not say so: $(head -n 1 stdout)"
    # keys go from 0 at 1 to 65535 at 12; as many pixels are drawn, at the same height within 2 % of 4
    od -An -v -tu1 -w2 -j17 s0.pgm >k0
    od -An -v -tu1 -w2 -j17 s1.pgm >k1
    paste k0 k1 | awk '{ a = 256 * $1 + $2; b = 256 * $3 + $4
        if ((a == 65535) != (b == 65535)) edge++
        if (a == 65535 || b == 65535) next
        n++; d = (a - b) / 65535 * 11; d = d < 0 ? -d : d; if (d > most) most = d }
        END { print n, edge + 0, most; exit !(n > 5000 && edge < 60 && most > 0 && most < 0.08) }' >surface ||
        wrong "at $n triangles: pixels, of them at the edge, farthest off: $(cat surface)"
    # texture coordinates go with it: most texels are the same
    frame s0.png 0 t0
    frame s1.png 0 t1
    same=$(cmp -l t0 t1 | wc -l)
    [ "$same" -lt $((240 * 240 * 3 / 4)) ] || wrong "at $n triangles $same bytes of texels are others"
done
begin simplify_refusals
for value in 0 -5 1.5 0.0 200% x 3x 12.5 1e30; do
    z render hill.obj --out x.png --simplify $value
    one_line 2 'simplify wants a number of triangles'
    z convert hill.obj --name m --out n --simplify $value
    one_line 2 'simplify wants a number of triangles'
done
z convert b/sheet.png --name m --out n --simplify 5
one_line 1 'simplify is for models'
[ ! -e x.png ] && [ ! -e n ] || wrong "a refused command leaves files"

begin refusals
z try
one_line 2 'a model is missing'
z try none.obj --out none
one_line 1 'none.obj: cannot be read'
z try ball.obj --size 8x8 --out none
one_line 1 'size 8x8'
z try ball.obj --up 0,0,0 --out none
one_line 1 'up 0,0,0 has no direction'
printf 'v 0 0 0\nv 1 0 0\nf 1 2 1\n' >flat.obj
z try ball.obj --frames 361 --out none
one_line 1 'frames 361 is outside its range'
[ ! -e none ] || wrong "a refused command leaves files"
mkdir -p folder/sheet.png
z try ball.obj --out folder
one_line 1 'folder/sheet.png: cannot be written: it is a directory'
is "files beside a folder sheet.png" "$(ls -A folder)" sheet.png
last=" (ulimit -f 4; zsim try ball.obj --frames 1 --size 64x64 --out full)" # the turntable fits, the sheet does not
mkdir full_there
for dir in full full_there; do
    (
        ulimit -f 4
        "$zsim" try ball.obj --frames 1 --size 64x64 --out $dir >stdout 2>stderr
    )
    status=$?
    one_line 1 "$dir/sheet.png: cannot be written"
done
[ ! -e full ] && [ -z "$(ls -A full_there)" ] || wrong "a full disk leaves $(ls -A full full_there | tr '\n' ' ')"
z try ball.obj --out ball.obj
[ $status -eq 1 ] && [ "$(head -c 2 ball.obj)" = "v " ] || wrong "status $status where DIR is a file"
finish
[ $n_failed -eq 0 ]
