#!/bin/sh
# The page in a headless browser: opens from a file, draws what zsim draws, says what it refuses, loads nothing.
# Usage: tests/web/page.sh BUILD    BUILD has web/index.html and zsim. WEB_PICTURES=FOLDER: pictures of the page there.
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$1
work=$build/test/web
. tests/lib/ok.sh
needs=index.html
. tests/web/made.sh
rm -rf "$work"
mkdir -p "$work"

# A model with two materials, quads, a concave polygon, a negative index and numbers that single precision does not hold
awk 'BEGIN {
    print "mtllib held.mtl"
    for (j = 0; j <= 12; j++)
        for (i = 0; i < 24; i++) {
            a = i * 6.283185307 / 24; r = 0.3 + 0.7 * sin(j * 0.2617993878) ^ 2
            printf "v %.11f %.11f %.11f\n", 100.1 + r * cos(a), j / 5 - 1.2, 40.7 + r * sin(a)
        }
    print "usemtl clay"
    for (j = 0; j < 12; j++) {
        if (j == 6) print "usemtl blue"
        for (i = 0; i < 24; i++)
            printf "f %d %d %d %d\n", j * 24 + i + 1, (j + 1) * 24 + i + 1, (j + 1) * 24 + (i + 1) % 24 + 1,
                j * 24 + (i + 1) % 24 + 1
    }
    print "f -1 -2 -3"
    # a star of 16 corners, every other one of which turns inwards, in a plane that leans
    for (i = 0; i < 16; i++) {
        a = i * 6.283185307 / 16; r = i % 2 ? 0.35 : 0.9
        printf "v %.11f %.11f %.11f\n", 100.1 + r * cos(a), 1.5 + 0.3 * r * cos(a), 40.7 + r * sin(a)
    }
    print "f -1 -2 -3 -4 -5 -6 -7 -8 -9 -10 -11 -12 -13 -14 -15 -16"
}' >"$work/held.obj"
# One with transparency and with highlights
{ echo 'mtllib glass.mtl'; grep -v mtllib "$work/held.obj"; } >"$work/glass.obj"
printf 'newmtl clay\nKd 0.8 0.45 0.2\nKs 0.7 0.7 0.7\nNs 40\nnewmtl blue\nKd 0.1 0.3 0.7\nd 0.5\n' >"$work/glass.mtl"
printf 'newmtl clay\nKd 0.8 0.45 0.2\nnewmtl blue\nKd 0.1 0.3 0.7\n' >"$work/held.mtl"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# a face that is not there\nf 1 2 9\n' >"$work/bad.obj"
broken=$work/bad
mkdir -p "$broken"
node tests/web/models.mjs "$work" || bad web_models "they could not be made"
for model in glass.obj held.obj ring.obj ring.stl ring.ply big.ply ring.glb opaque.glb blend.glb mirrored.glb \
    sparse.glb strip.glb; do
    "$build/zsim" render "$work/$model" --panel st7789:240x240 --out "$work/$model.png" 2>"$work/zsim.log" ||
        bad "web_zsim_$model" "zsim render: $(head -c 300 "$work/zsim.log")"
done
# Models that nothing can be made of; beside each what zsim says
: >"$broken/empty.obj"
printf 'hello\n' >"$broken/words.obj"
printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n' >"$broken/nan.obj"
printf 'v 0 0 0\nv 1 0 0\nv one 1 0\nf 1 2 3\n' >"$broken/one.obj"
printf 'v 0 0 0\nv 1 0 0\nf 1 2\n' >"$broken/two.obj"
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >"$broken/line.obj"
iconv -f UTF-8 -t UTF-16 "$work/bad.obj" >"$broken/wide.obj"
iconv -f UTF-8 -t UTF-32BE "$work/bad.obj" >"$broken/wider.obj"
printf 'mtllib material.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n' >"$broken/material.obj"
printf 'newmtl a\nKd 1 0 0\n' | iconv -f UTF-8 -t UTF-16 >"$broken/material.mtl"
printf 'v 0 0 0\nv 1 0 \\\n0\nv 0 1 0\nf 1 2 \\\n9\n' >"$broken/goes_on.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/5\n' >"$broken/texture.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3/1/1/1\n' >"$broken/corner.obj"
head -c 2000 "$work/ring.glb" >"$broken/cut.glb"
head -c 200 "$work/draco.gltf" >"$broken/cut.gltf"
printf 'glTF\001\0\0\0\024\0\0\0\0\0\0\0\0\0\0\0' >"$broken/one.glb"
head -c 300 "$work/ring.stl" >"$broken/cut.stl"
head -c 50 "$work/ring.stl" >"$broken/head.stl"
facet='facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 %s 0\nvertex 0 1 0\nendloop\nendfacet\n'
printf 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n' >"$broken/text.stl"
# shellcheck disable=SC2059 # the format is above
for row in 0 one nan; do
    { printf 'solid x\n' && printf "$facet" "$row" && printf 'endsolid x\n'; } >"$broken/text_$row.stl"
done
sed -i '1s/^/ /' "$broken/text_0.stl"
sed 's/^vertex 1 nan/endsolid x\n; a comment\nVERTEX 1 0/' "$broken/text_nan.stl" >"$broken/outside.stl"
sed 's/^property float z$//' "$work/ring.ply" >"$broken/flat.ply"
head -c 700 "$work/ring.ply" >"$broken/cut.ply"
sed 's/^element face/element tristrips/' "$work/ring.ply" >"$broken/strips.ply"
ply='ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n'
ply="${ply}property list uchar int vertex_indices\nend_header\n0 0 0\n%b\n0 1 0\n%b\n"
# shellcheck disable=SC2059 # the format is above
for row in 'index|1 0 0|3 0 1 7' 'nan|1 nan 0|3 0 1 2' 'two|1 0 0|2 0 1' 'word|1 0 0|3 0 x 1' 'short|1 0|3 0 1 2'; do
    values=${row#*|}
    printf "$ply" "${values%|*}" "${values#*|}" >"$broken/${row%%|*}.ply"
done
for model in "$broken"/*.obj "$broken"/*.stl "$broken"/*.ply "$broken"/*.gl*; do
    "$build/zsim" render "$model" --out "$work/none.png" 2>"$work/zsim.log" && bad web_zsim "$model is drawn"
    tail -n 1 "$work/zsim.log" | sed "s|^zsim: $broken/||" >"$model.txt"
done
page=$(cd "$build/web" && pwd)/index.html
node tests/web/page.mjs "$page" "$(cd "$work" && pwd)" || failed=1

# The .uf2 of a model: what the emulator of the boards' tests shows on its panel is what zsim draws
[ -f "$build/pico/run.mjs" ] || sh tests/boards/pico.sh "$build" set-up
for model in glass.obj held.obj ring.obj; do
    stem=$work/$model.show
    node tests/web/uf2.mjs "$work/$model.uf2" "$stem.bin" >"$stem.log" 2>&1 &&
        cp "$build/fw/pico-model/show_model.elf" "$stem.elf" &&
        node "$build/pico/run.mjs" "$stem" --frames 3 --stream "$stem.stream" >"$stem.txt" 2>&1 &&
        ! grep '^problem' "$stem.txt" >"$stem.log" &&
        "$build/zsim" panel --panel st7789:240x240 --invert --decode "$stem.stream" --out "$stem.%d.png" \
            >"$stem.log" 2>&1 &&
        node tests/web/same.mjs "$stem.0.png" "$work/$model.png" >"$stem.log" 2>&1
    if [ $? -eq 0 ]; then
        ok "web_uf2_$model: $(sed -n 's/^draw_cycles //p' "$stem.txt") cycles a frame"
    else
        bad "web_uf2_$model" "$(cat "$stem.log" "$stem.txt" 2>/dev/null | grep -v '^text' | head -c 300 | tr '\n' '|')"
    fi
done
exit $failed
