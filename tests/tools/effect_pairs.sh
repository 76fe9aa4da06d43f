#!/bin/sh
# Every two options of effects of zsim render together, on a model in flat, smooth and textured shading: which are
# drawn, which are refused and with what sentence. Where two are drawn, each of them is seen in the picture.
# Usage: tests/tools/effect_pairs.sh ZSIM WORKDIR     from the repository's top
#
# SPDX-License-Identifier: MIT
. tests/tools/zsim.sh

gcc -O1 -Wall -Wextra -Werror "$top/tests/tools/fixture.c" -lpng -lturbojpeg -o "$work/fixture" || exit 1
mkdir -p out
# A ball of 16 x 8 cells, radius 60, with texture coordinates; as glTF, which assimp reads in half of an OBJ's time
node <<'END'
const n = 16, m = 8, pos = [], uv = [], tri = [];
for (let i = 0; i <= m; i++)
    for (let j = 0; j <= n; j++) {
        const a = Math.PI * i / m, b = 2 * Math.PI * j / n;
        pos.push(60 * Math.sin(a) * Math.sin(b), 60 * Math.cos(a), 60 * Math.sin(a) * Math.cos(b));
        uv.push(3 * j / n, 1 - i / m);
        if (i === m || j === n)
            continue;
        const k = i * (n + 1) + j;
        tri.push(k, k + n + 1, k + n + 2, k, k + n + 2, k + 1);
    }
const parts = [new Float32Array(pos), new Float32Array(uv), new Uint32Array(tri)].map((a) => Buffer.from(a.buffer));
const bin = Buffer.concat(parts);
const views = parts.map((part, k) => ({ buffer: 0, byteLength: part.length,
    byteOffset: parts.slice(0, k).reduce((sum, before) => sum + before.length, 0) }));
const vertices = pos.length / 3;
const json = Buffer.from(JSON.stringify({ asset: { version: '2.0' },
    scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2 }] }],
    accessors: [
        { bufferView: 0, componentType: 5126, count: vertices, type: 'VEC3', min: [-60, -60, -60], max: [60, 60, 60] },
        { bufferView: 1, componentType: 5126, count: vertices, type: 'VEC2' },
        { bufferView: 2, componentType: 5125, count: tri.length, type: 'SCALAR' }],
    bufferViews: views, buffers: [{ byteLength: bin.length }] }).replace(/$/, '   '));
const text = json.subarray(0, json.length & ~3); // padded by spaces to words
const words = (...n) => Buffer.from(new Uint32Array(n).buffer);
require('fs').writeFileSync('ball.glb', Buffer.concat([words(0x46546c67, 2, 12 + 8 + text.length + 8 + bin.length),
    words(text.length, 0x4e4f534a), text, words(bin.length, 0x4e4942), bin]));
END
./fixture png rgb sphere.png 2 1 ff0000 0000ff
./fixture png rgb fine.png 32 32 $(awk 'BEGIN {
    for (y = 0; y < 32; y++) for (x = 0; x < 32; x++) printf (int(x / 2) + int(y / 2)) % 2 ? "f0e0c0 " : "204080 " }')

# WRITE=1: the tables as they are, to look at

# A name, its kind, and the options. Two of one kind are one option twice.
cat >options.txt <<'END'
dir light --light dir:1,2,3:ffe0c0
point light --light point:120,150,90
spot light --light spot:60,150,120
two light --light dir:1,2,3 --light point:-120,150,90:ff8040
specular specular --specular 20:0.6
per-pixel per-pixel --per-pixel
alpha alpha --alpha 0.5
add alpha --alpha 0.5 --blend add
screen-door alpha --alpha 0.5 --blend screen-door
bilinear filter --filter bilinear
mipmap filter --filter mipmap
samples samples --samples 4
fog fog --fog linear:60:500:a0b0d0
dither dither --dither ordered
planar shadow --shadow planar
map shadow --shadow map
environment environment --environment sphere.png
mirror mirror --mirror
END
view='--size 64x64 --eye 100,120,220 --at 0,-20,0'
look_of() { # SHADE: the shading's options in $look
    case $1 in textured) look='--shade textured --texture fine.png' ;; *) look="--shade $1 --color c08040" ;; esac
}
# Without a process for each of 500 pairs:
option_of() { # NAME    its kind and options in $kind and $option
    while read -r named kind option; do
        [ "$named" != "$1" ] || return 0
    done <options.txt
    return 1
}
letter() { # the sentence of a refusal, in a letter, in $seen; two options that do not go together are both named
    IFS= read -r sentence <stderr
    case $sentence in
    *'--per-pixel needs --shade smooth or textured'*) seen=n ;;
    *'--filter needs --shade textured, textured-flat or unlit, or an --environment'*) seen=f ;;
    *'colours are dithered with --shade smooth alone; for fewer colours name a grey or one-bit --panel'*) seen=d ;;
    *'--environment needs --shade smooth'*) seen=e ;;
    *'--environment has its lights in its picture: leave --'*' out, or'*) seen=L ;;
    *'--dither and --'*'leave one out, or name a grey or one-bit --panel'*) seen=B ;;
    *) seen='?' ;;
    esac
}
together() { # SHADE NAME NAME: its letter in $seen
    option_of "$2" && first=$option
    option_of "$3" && second=$option
    [ "$2" != "$3" ] || second=
    look_of "$1"
    # shellcheck disable=SC2086
    z render ball.glb $look $view $first $second --out "out/$2-$3.png"
    case $status in 0) seen=+ ;; 1 | 2) letter ;; *) seen='?' ;; esac
    [ "$seen" != '?' ] || wrong "$2 and $3: status $status: $(said)"
}
changed() { # NAME NAME: each changes what the other one's picture is
    of=out/$1-$2.png one=out/$1-$1.png other_one=out/$2-$2.png
    [ -s "$one" ] || one=
    [ -s "$other_one" ] || other_one=
    # shellcheck disable=SC2086
    [ -z "$one$other_one" ] || look unlike "$of" $one $other_one
}
table() { # SHADE <TABLE    of each option a row: a letter for each one before it and for itself; - for one of its kind
    begin "pairs_$1"
    rm -f out/*.png
    while read -r this want; do
        row=
        option_of "$this" && own=$kind
        together "$1" "$this" "$this"
        alone=$seen
        for other in $before; do
            option_of "$other"
            if [ "$kind" = "$own" ]; then
                row=$row-
                continue
            fi
            together "$1" "$other" "$this"
            row=$row$seen
            [ "$seen" = + ] || continue
            changed "$other" "$this"
        done
        before="$before $this"
        is "the row of $this" "$row$alone" "$want"
        [ -z "${WRITE:-}" ] || echo "$this $row$alone"
    done
    before=
}
before=
table flat <<'END'
dir +
point -+
spot --+
two ---+
specular +++++
per-pixel nnnnnn
alpha +++++n+
add +++++n-+
screen-door +++++n--+
bilinear fffffnffff
mipmap fffffnfff-f
samples +++++n+++ff+
fog +++++n+++ff++
dither dddddndddffddd
planar +++++n+++ff++d+
map +++++n+++ff++B-+
environment eeeeeneeeeeeeeeee
mirror +++++n+++ff++d++e+
END
# What smooth and textured shading have in common: lights and transparency
lit_and_blended='dir +
point -+
spot --+
two ---+
specular +++++
per-pixel ++++++
alpha +++++++
add ++++++-+
screen-door ++++++--+'
table smooth <<END
$lit_and_blended
bilinear ffffffffff
mipmap fffffffff-f
samples +++++++++ff+
fog +++++++++ff++
dither +++++B+++ff+++
planar +++++++++ff++++
map +++++++++ff++B-+
environment LLLLLL+++++++B+++
mirror +++++++++ff+++++++
END
table textured <<END
$lit_and_blended
bilinear ++++++++++
mipmap +++++++++-+
samples ++++++++++++
fog +++++++++++++
dither dddddBdddddddd
planar +++++++++++++d+
map +++++++++++++B-+
environment eeeeeeeeeeeeeeeee
mirror +++++++++++++d++e+
END
finish
[ $n_failed -eq 0 ]
