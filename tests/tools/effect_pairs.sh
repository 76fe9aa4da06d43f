#!/bin/sh
# Every two options of effects of zsim render together, on a model in flat, smooth and textured shading: which are
# drawn, which are refused and with what sentence. Where two are drawn, each of them is seen in the picture.
# Usage: tests/tools/effect_pairs.sh ZSIM WORKDIR     from the repository's top; ZSIM built with ASan and UBSan
#
# SPDX-License-Identifier: MIT
. tests/tools/zsim.sh

gcc -O1 -Wall -Wextra -Werror "$top/tests/tools/fixture.c" -lpng -lturbojpeg -o "$work/fixture" || exit 1
mkdir -p out
# A ball of 16 x 8 cells, radius 60, with texture coordinates
awk 'BEGIN { pi = atan2(0, -1); n = 16; m = 8
    for (i = 0; i <= m; i++) for (j = 0; j <= n; j++) {
        printf "v %.6f %.6f %.6f\n", 60 * sin(pi * i / m) * sin(2 * pi * j / n), 60 * cos(pi * i / m),
            60 * sin(pi * i / m) * cos(2 * pi * j / n)
        printf "vt %.6f %.6f\n", 3 * j / n, i / m }
    for (i = 0; i < m; i++) for (j = 0; j < n; j++) {
        a = i * (n + 1) + j + 1; b = a + 1; c = a + n + 1; d = c + 1
        print "f", a "/" a, c "/" c, d "/" d, b "/" b } }' >ball.obj
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
look_of() { # SHADE: the shading's options
    case $1 in textured) echo --shade textured --texture fine.png ;; *) echo "--shade $1 --color c08040" ;; esac
}
option_of() { # NAME    its kind and options in $kind and $option; a loop costs less than a program for each of 500
    while read -r named kind option; do
        [ "$named" != "$1" ] || return 0
    done <options.txt
    return 1
}
letter() { # the sentence of a refusal, in a letter; two options that do not go together are both named
    IFS= read -r sentence <stderr
    case $sentence in
    *'--per-pixel needs --shade smooth or textured'*) echo n ;;
    *'--filter needs --shade textured, textured-flat or unlit, or an --environment'*) echo f ;;
    *'colours are dithered with --shade smooth alone; for fewer colours name a grey or one-bit --panel'*) echo d ;;
    *'--environment needs --shade smooth'*) echo e ;;
    *'--environment has its lights in its picture: leave --'*' out, or'*) echo L ;;
    *'--dither and --'*'leave one out, or name a grey or one-bit --panel'*) echo B ;;
    *) echo '?' ;;
    esac
}
together() { # SHADE NAME NAME: its letter in $seen
    option_of "$2" && first=$option
    option_of "$3" && second=$option
    [ "$2" != "$3" ] || second=
    # shellcheck disable=SC2046,SC2086
    z render ball.obj $(look_of "$1") $view $first $second --out "out/$2-$3.png"
    case $status in 0) seen=+ ;; 1 | 2) seen=$(letter) ;; *) seen='?' ;; esac
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
