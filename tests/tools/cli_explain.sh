#!/bin/sh
# zsim render --explain, from outside: the sentence that says why a picture is empty, dark or slow; nothing of one
# that is right, and nothing in a pipe that was not asked for.
# Usage: tests/tools/cli_explain.sh ZSIM WORKDIR     as tests/tools/cli.sh
set -u
. tests/tools/zsim.sh
mkdir -p out

cat >cube.obj <<'OBJ'
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
f 5 6 7 8
f 2 1 4 3
f 6 2 3 7
f 1 5 8 4
f 8 7 3 4
f 1 2 6 5
OBJ
printf 'v -1 0 -1\nv 1 0 -1\nv 0 0 1\nf 1 2 3\n' >below.obj

# The first line on stderr, and the exit status 0; nothing on stdout
says() { # NAME SENTENCE MODEL OPTION...
    begin "explain_$1"
    sentence=$2
    shift 2
    z render "$@" --explain --out out/x.png
    [ $status -eq 0 ] && [ ! -s stdout ] || wrong "status $status: $(said)"
    head -n 1 stderr | grep -qE -- "^zsim: [a-z]*\.obj: $sentence" || wrong "'$sentence' is not in: $(said)"
}
units() { # COUNT    lines that say what a world unit is
    is "lines about world units" "$(grep -c 'world units, of which' stderr)" "$1"
}
silent() { # NAME MODEL OPTION...
    begin "silent_$1"
    shift
    z render "$@" --out out/x.png
    [ $status -eq 0 ] && [ ! -s stdout ] && [ ! -s stderr ] || wrong "status $status: $(said)"
}

silent right cube.obj --explain
silent smooth cube.obj --explain --shade smooth --samples 4
silent orthographic cube.obj --explain --projection orthographic
silent depthsort cube.obj --explain --method depthsort
silent not_asked cube.obj --eye 0,0,50 --near 1 --far 20
says far 'instance 0 is out of view: it begins [0-9]* beyond far = [0-9]*; move it, or raise far\.$' \
    cube.obj --eye 0,0,50 --near 1 --far 20
is "the last line" "$(tail -n 1 stderr | cut -c -52)" "zsim: cube.obj: lengths are in world units, of which"
says behind 'instance 0 is behind the camera: it ends [0-9]* behind the eye' cube.obj --eye 0,0,9 --at 0,0,20
units 1
says inside 'the camera is inside instance 0' cube.obj --eye 0,0,0 --at 0,0,1
units 1
says narrow 'the camera sees less than one degree: was ZS_DEGREES meant' cube.obj --fov 0.5
says facing 'instance 0: 1 of 1 triangles face away: the winding is wrong' below.obj --eye 0,5,1
says dark "the light's ambient and diffuse are 0" cube.obj --ambient 0 --diffuse 0
units 0
says black "instance 0 is black: its material's rgb is 0; give it a colour" cube.obj --color 000000 --background 4060ff
says background "instance 0 has the background's colour" cube.obj --color 000000 --background 000000
says pools 'the frame takes [0-9]* passes; one needs max_tris [0-9]* \(it is 3\)' cube.obj --tris 3 --verts 5
says strips 'strips of 1 rows are slow' cube.obj --strip 1
units 0

begin refused_by_instance
z render cube.obj --explain --out out/y.png --near 1e-9
[ $status -eq 1 ] && [ ! -e out/y.png ] || wrong "status $status: $(said)"
head -n 1 stderr | grep -q 'instance 0 is refused: the near plane is too close' || wrong "$(said)"

# On a terminal it is said without being asked for, if nothing is seen.
begin terminal
script -qec "'$zsim' render cube.obj --eye 0,0,9 --at 0,0,20 --out out/x.png" /dev/null </dev/null >tty_words 2>&1
grep -q 'instance 0 is behind the camera' tty_words || wrong "$(head -c 300 tty_words)"
finish
[ $n_failed -eq 0 ]
