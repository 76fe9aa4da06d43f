#!/bin/sh
# `zsim gallery`: every method has a card, its figures are those of its nature, the page needs no other file. `zsim
# render` by every method and style. What cannot be done is refused by name.
# Usage: tests/tools/gallery.sh ZSIM WORKDIR     as tests/tools/cli.sh
set -u
. tests/tools/zsim.sh

figure() { # SCENE METHOD COLUMN
    awk -v scene="$1" -v method="$2" -v column="$3" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == column) at = i
    next }
        $1 == scene && $2 == method { print $(column == "wrong" ? NF : at) }' table
}
begin gallery
printf 'painter,cubes,123456,1\n' >counts
z gallery --out page --m3 counts
[ $status -eq 0 ] || wrong "status $status: $(said)"
[ ! -s stderr ] || wrong "it talks: $(said)"
sed 's/M3 instr\./instructions/' stdout >table
is "what is written" "$(ls page)" index.html
methods=$(awk 'NR > 1 && NF == 12 { print $2 }' table | sort -u | tr '\n' ' ')
for m in $methods; do
    grep -q "<section id=$m>" page/index.html || wrong "no card of $m"
    "$zsim" render --help | grep -q "[|  ]$m" || wrong "zsim render --help does not name $m"
done
is "pictures in the page" "$(grep -c 'src="data:image/png;base64,' page/index.html)" \
    $(($(echo $methods | wc -w) * 8 + 22))
for e in wire hidden-line outline dashed points lights per-pixel textured-highlights alpha add screen-door bilinear \
    mipmap samples fog dither shadow-planar shadow-map shadow-lights environment mirror together; do
    grep -q "<section id=$e " page/index.html || wrong "no card of $e"
done
grep -q 'src="[^d]\|href=' page/index.html && wrong "the page needs another file"
is "RAM and instructions on cards" \
    "$(grep -c '^<figcaption>.*; .*<br>[1-9][0-9]* bytes of RAM, .* M instructions' page/index.html)" \
    $(($(echo $methods | wc -w) * 4))
is "depth memory of painter" "$(figure corridor painter depth)" 0
is "depth memory of zbuffer" "$(figure corridor zbuffer depth)" 15360
is "instructions as given" "$(figure cubes painter instructions)" 123456
now=$(figure corridor painter instructions)
case $now in "~"[1-9]*) ;; *) wrong "no estimate: $now" ;; esac
is "painter writes each fragment" "$(figure corridor painter writes)" "$(figure corridor painter fragments)"
[ "$(figure corridor zbuffer wrong)" -le 10 ] || wrong "zbuffer: $(figure corridor zbuffer wrong) wrong pixels"
[ "$(figure corridor painter wrong)" -ge 5000 ] || wrong "painter: only $(figure corridor painter wrong) wrong pixels"

begin gallery_refusals
z gallery --out none --m3 nothing
one_line 1 'nothing: cannot be read'
printf 'painter,moon,1\n' >counts
z gallery --out none --m3 counts
[ ! -e none ] || wrong "a refused command leaves a folder"
one_line 1 'counts: has no line METHOD,SCENE,INSTRUCTIONS'
z gallery --size 9x9
one_line 2 "unknown option '--size'"

begin render_by_methods
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >tri.obj
for m in zbuffer $methods; do
    z render tri.obj --out $m.png --stats $m.json --method $m
    [ $status -eq 0 ] || wrong "$m: status $status: $(said)"
    cmp -s $m.png zbuffer.png || wrong "$m draws another triangle"
done
for m in depthsort coverage; do # with room for their own records: few rectangles
    [ "$(sed -n 's/^ *"sorted": \([0-9]*\),/\1/p' $m.json)" -le 30 ] || wrong "$m sorts one triangle too often"
done
grep -q '"depth_bytes": 0,' painter.json || wrong "painter has depth_bytes"
z render tri.obj --out x.png --method painter --depth-out d.pgm
one_line 2 'method painter keeps no depth keys: leave --depth-out out'
z render tri.obj --out x.png --method painter --show tested
one_line 2 'method painter: of --show there is overdraw'
z render tri.obj --out x.png --method painter --depth recip
one_line 2 'method painter brings its depth mapping: leave --depth out'
z render tri.obj --out x.png --method painter --depth-bits 8
one_line 2 'method painter keeps no depth keys: leave --depth-bits out'
z render tri.obj --out x.png --method magic
one_line 2 'magic'
[ ! -e x.png ] || wrong "a file of a refused command"
begin lines_and_points # a cube: 12 edges and 6 diagonals, 8 corners; its farthest corner is hidden
printf 'v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1
f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n' >cube.obj
for style in wire hidden-line points; do
    z render cube.obj --out $style.png --stats $style.json --style $style
    [ $status -eq 0 ] || wrong "$style: status $status: $(said)"
done
count() { # STYLE FIGURE
    sed -n "s/^ *\"$2\": \([0-9]*\).*/\1/p" "$1.json"
}
is "edges of a cube" "$(count wire triangles_in)" 18
is "edges, and faces that hide" "$(count hidden-line triangles_in)" 30
is "corners of a cube" "$(count points triangles_in)" 8
[ "$(count points pixels_visible)" -eq 8 ] || wrong "points: $(count points pixels_visible) pixels"
[ "$(count wire pixels_visible)" -ge 1000 ] || wrong "wire: $(count wire pixels_visible) pixels"
for refused in "--compare" "--id-out i.u32" "--method painter" "--show overdraw"; do
    # shellcheck disable=SC2086
    z render cube.obj --out y.png --style wire $refused
    one_line 2 'style: '
done
for list in crease border silhouette border,crease,silhouette crease:--crease=91 crease,border:--crease=89; do
    edges=${list%%:*} angle=${list#"${list%%:*}"}
    # shellcheck disable=SC2086
    z render cube.obj --out y.png --stats "$list.json" --style wire --edges "$edges" ${angle#:}
    [ $status -eq 0 ] || wrong "--edges $list: status $status: $(said)"
done
is "creases, borders, silhouettes of a cube; all three" \
    "$(for list in crease border silhouette border,crease,silhouette crease:--crease=91 crease,border:--crease=89; do
        count $list triangles_in
    done | tr '\n' ' ')" '12 0 6 12 0 12 '
rm -f y.png
z render cube.obj --out solid.png --stats line.json --style wire --edges silhouette
z render cube.obj --out dashed.png --stats dash.json --style wire --edges silhouette --dash 3,6
[ $(($(count dash pixels_visible) * 100 / $(count line pixels_visible))) -le 40 ] || wrong "dashes of a third of a line"
[ $(($(count dash pixels_visible) * 100 / $(count line pixels_visible))) -ge 30 ] || wrong "dashes of a third of a line"
z render cube.obj --out y.png --edges crease
one_line 2 'edges is about lines: add --style wire or hidden-line'
z render cube.obj --out y.png --style points --dash 3,3
one_line 2 'dash is about lines: add --style wire or hidden-line'
z render cube.obj --out y.png --style wire --crease 30
one_line 2 'crease is the angle of --edges crease, which is missing'
z render cube.obj --out y.png --style wire --edges border,sharp
one_line 2 "edges: 'sharp' is none of all, border, crease, silhouette"
z render cube.obj --out y.png --style wire --edges crease --crease 181
one_line 1 'crease 181 is outside its range, 0 to 180'
for dash in 3 3, ,3 0,3 3,256 3x4 3,4,5; do
    z render cube.obj --out y.png --style hidden-line --dash "$dash"
    one_line 2 "dash wants ON,OFF, two whole numbers from 1 to 255, as 6,4; not '$dash'"
done
z render cube.obj --out y.png --style wire --line-width 65
[ $status -eq 1 ] || [ $status -eq 2 ] || wrong "a line of 65 px: status $status"
[ ! -e y.png ] || wrong "a file of a refused command"
finish
[ $n_failed -eq 0 ]
