#!/bin/sh
# `zsim view` on an X server of its own (Xvfb), with keys and a mouse that are pressed (xdotool), looked at from outside
# (desktop.c): what is in the window is what `zsim render` and `zsim demo` write, pixel by pixel.
# Usage: tests/tools/view.sh ZSIM WORKDIR     as tests/tools/cli.sh
#
# Nothing waits for a time: each step waits until what it wants is there, up to two minutes.
. tests/tools/zsim.sh
gcc -O2 -Wall -Wextra -Werror -I"$top/firmware/zstrip" "$top/tests/tools/desktop.c" \
    "$top/firmware/zstrip/overlay/font.c" -lX11 -lpng -o desktop || exit 1
unset WAYLAND_DISPLAY XDG_SESSION_TYPE SDL_VIDEODRIVER
DISPLAY=
server=''
pid=''
trap 'kill $server $pid 2>/dev/null' EXIT
trap 'exit 1' INT TERM

until_() { # WHAT COMMAND...    at most two minutes, and not longer than the window is there
    waited=0
    what=$1
    shift
    until "$@"; do
        waited=$((waited + 1))
        if [ $waited -gt ${patience:-1200} ] || { [ -n "$pid" ] && ! kill -0 "$pid" 2>/dev/null; }; then
            wrong "waited for $what in vain: $(head -c 400 win_err)"
            patience=20 # what follows need not wait as long
            return 1
        fi
        sleep 0.1
    done
}

# ---- The desktop -------------------------------------------------------------------------------
mkfifo number
Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp -noreset 3>number >xvfb.log 2>&1 &
server=$!
read -r screen <number
DISPLAY=:$screen
export DISPLAY

there() {
    window=$(xdotool search --name '^zsim: ' 2>xdotool.log | tail -n 1)
    [ -n "$window" ]
}
focused() {
    xdotool windowfocus "$window" 2>xdotool.log
    [ "$(xdotool getwindowfocus 2>>xdotool.log)" = "$window" ]
}
open_() { # ARGUMENT...    a window; its picture may still come
    last=" zsim view $*"
    : >win_out
    : >win_err
    n_printed=0
    "$zsim" view "$@" >>win_out 2>>win_err </dev/null &
    pid=$!
    until_ "a window" there && until_ "the focus" focused
}
press() { # KEY...
    xdotool key --delay 1 "$@"
}
end() { # how it ended
    ended=$pid
    pid=''
    wait "$ended"
    is "status at its end" $? 0
}
sees() { # PICTURE    where it is, in $place
    place=$(./desktop find "$window" "$1")
}
shown() { # PICTURE
    until_ "$1 in the window" sees "$1"
}
words() { # PATTERN    a sentence on standard error
    grep -q -- "$1" win_err
}
marked() { # as many pixels of the accent's colour below the picture
    ./desktop count "$window" ffb252 0 $(($(height) - 120)) $(($(width) - 440)) 0
}
width() {
    xdotool getwindowgeometry --shell "$window" | sed -n 's/^WIDTH=//p'
}
height() {
    xdotool getwindowgeometry --shell "$window" | sed -n 's/^HEIGHT=//p'
}
says_so() {
    [ "$(marked)" -gt 20 ]
}
says_nothing() {
    [ "$(marked)" -eq 0 ]
}
printed() { # COUNT    so many commands were printed
    [ "$(grep -c '^zsim ' win_out)" -ge "$1" ]
}
# Press p, and run what it prints: the same picture, which is in the window, too. The command is in $line
written() { # FILE
    file=$1
    n_printed=$((n_printed + 1))
    press p
    until_ "a command" printed $n_printed || return
    line=$(grep '^zsim ' win_out | sed -n "${n_printed}p")
    mv "$file" ours.png
    eval "set -- $line"
    shift
    "$zsim" "$@" >again.txt 2>&1 || wrong "'$line': $(head -c 300 again.txt)"
    cmp -s ours.png "$file" || wrong "'$line' draws another picture"
    shown "$file"
}
# What is written in the window, as a reader sees it
reads() { # PATTERN    a line of it
    ./desktop text "$window" >text.txt && grep -qE -- "$1" text.txt
}
written_there() { # PATTERN
    until_ "'$1' in the window" reads "$1"
}
box() { # a box of sides $1 x $2 x $3, and a smaller one behind it
    awk -v a="$1" -v b="$2" -v c="$3" 'BEGIN {
        for (k = 0; k < 2; k++) { for (i = 0; i < 8; i++)
            print "v", (i % 2 - 0.5) * a + k, (int(i / 2) % 2 - 0.5) * b - k / 2, (int(i / 4) - 0.5) * c - 3 * k
        n = split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", v)
        for (i = 1; i <= n; i += 4) print "f", v[i] + 8 * k, v[i + 1] + 8 * k, v[i + 2] + 8 * k, v[i + 3] + 8 * k } }'
}
box 2 1 3 >box.obj
box 3 3 1 >other.obj
small='--size 64x48'

begin shows_what_render_draws
z render box.obj $small --out want.png
open_ box.obj $small
shown want.png
[ "$(word 1 $place)" -ge 4 ] || wrong "64x48 pixels are enlarged only $(word 1 $place) times"
xdotool windowsize "$window" 900 800
written_there '^zsim render box.obj --size=64x48'
is_wide() { [ "$(width)" -eq "$1" ]; }
until_ "the window's other size" is_wide 900
shown want.png
press h
gone() { ! sees want.png; }
until_ "the keys" gone
written_there '^h, F1 +these keys'
# Each row of the table of keys, from the source, is there to be read
sed -n '/rows\[\]\[2\] = {/,/};/s/.*{ "\(.*\)", "\(.*\)" }.*/\1\t\2/p' "$top/sim/view/desk.c" >keys.txt
is "rows of keys" "$(wc -l <keys.txt | tr -d ' ')" 12
while IFS="$(printf '\t')" read -r key what; do
    grep -qF -- "$key" text.txt && grep -qF -- "$what" text.txt || wrong "the keys leave out '$key': '$what'"
done <keys.txt
press F1
shown want.png

begin mouse
angle() { # FILE.json    degrees about the upright axis, and distance from --at
    for key in eye_x eye_y eye_z at_x at_y at_z; do
        look json "$1" $key
        echo "$seen"
    done | awk '{ v[NR] = $1 } END { x = v[1] - v[4]; y = v[2] - v[5]; z = v[3] - v[6]
        print atan2(x, z) * 57.29577951, atan2(y, sqrt(x * x + z * z)) * 57.29577951, sqrt(x * x + y * y + z * z) }'
}
z render box.obj $small --out want.png --stats before.json
xdotool mousemove --window "$window" 200 200 mousedown 1 mousemove --window "$window" 240 190 mouseup 1
written view.png
case $line in *--eye=*) ;; *) wrong "a drag does not move the eye: $line" ;; esac
eval "set -- $line"
shift
"$zsim" "$@" --stats after.json
echo "$(angle before.json) $(angle after.json)" | awk '{
    exit !(($1 - $4 - 20) ^ 2 < 0.001 && ($2 - $5 - 5) ^ 2 < 0.001 &&
    ($6 / $3 - 1) ^ 2 < 1e-8) }' || wrong "40 and 10 px turn it from $(angle before.json) to $(angle after.json)"
xdotool mousemove --window "$window" 200 200 click 4 click 4
written view.png
eval "set -- $line"
shift
"$zsim" "$@" --stats near.json
echo "$(angle after.json) $(angle near.json)" | awk '{
    exit !(($6 / $3 - 0.81) ^ 2 < 1e-8 && ($4 - $1) ^ 2 < 0.001) }' ||
    wrong "the wheel goes from $(angle after.json) to $(angle near.json)"
xdotool mousemove --window "$window" 200 200 mousedown 3 mousemove --window "$window" 220 200 mouseup 3
written view.png
case $line in *--at=*) ;; *) wrong "another button does not move what it looks at: $line" ;; esac
press 0
shown want.png

begin keys_are_options
for pair in s:--shade=id v:--method=hiz d:--depth=recip b:--depth-bits=14 r:--strip=24 t:--tris=2000 e:--verts=2000 \
    n:--near= o:--projection=orthographic c:--cull=front l:--style=wire f:--show=depth a:--fast=none Left:--eye=; do
    press BackSpace "${pair%%:*}"
    written view.png
    case $line in *" ${pair#*:}"*) ;; *) wrong "key ${pair%%:*} gives '$line'" ;; esac
    value=$(echo "$line" | sed -n "s/.* ${pair#*:}\([^ ]*\).*/\1/p") # of --near: as it is written
    option=${pair#*:}
    [ "${pair%%:*}" = Left ] || written_there "^${pair%%:*} .* ${option#*=}$value( |\$)"
done
press BackSpace shift+b shift+f
written view.png
case $line in *--depth-bits=8*--show=strips*) ;; *) wrong "Shift does not step back: $line" ;; esac
press BackSpace s shift+s
written view.png
is "a setting stepped to and back" "$line" "zsim render box.obj --size=64x48 --out=view.png"
press g k
written view.png
case $line in
*--size*) wrong "--size stays beside a panel: $line" ;;
*--panel=*:*--rotate=90*) ;;
*) wrong "$line" ;;
esac
press BackSpace

begin figures_are_budgets
written view.png
"$zsim" budget box.obj $small --shade flat --csv --part rp2040 >budget.csv
"$zsim" budget box.obj $small --shade flat --csv --part stm32f405 >ram.csv
ram=$(sed -n 's/^# RAM \([0-9]*\) bytes;.*/\1/p' win_out | tail -n 1)
fps=$(sed -n 's/^# RAM .* rp2040 \([0-9.]*\) .*/\1/p' win_out | tail -n 1)
is "RAM" "$ram" "$(sed -n 's/^ram,\([0-9]*\),.*/\1/p' ram.csv)"
sed -n 's/^draw_ms,\([0-9.]*\),.*/\1/p' budget.csv | awk -v fps="$fps" '{ n++; d = 1000 / fps - $1 }
    END { exit !(n == 1 && d < 0.0006 && d > -0.0006) }' || wrong "$fps frames a second; $(grep draw_ms budget.csv)"

written_there "^together, with the stack +$ram( |\$)"
written_there "^rp2040 +$fps( |\$)"
# The sums' parts, too, are the budget's
"$zsim" budget box.obj $small --shade flat --csv --part rp2040 >/dev/null
sum=0
for pool in 'strip buffers' 'depth keys, tiles, bins' triangles vertices 'renderer, scene, panel'; do
    part=$(sed -n "s/^$pool  *\([0-9]*\)$/\1/p" text.txt | tail -n 1)
    sum=$((sum + ${part:-0}))
done
stack=$(sed -n 's/^stack,\([0-9]*\).*/\1/p' ram.csv)
is "the parts of RAM, and the stack" $((sum + stack)) "$ram"

press a
written view.png
last_line=$(grep '^# RAM' win_out | tail -n 1)
case $last_line in *"rp2040 unknown"*) ;; *) wrong "without accelerators: $last_line" ;; esac
press a
written view.png

begin what_is_refused
press BackSpace v v v
written view.png
good=$line
until_ "silence" says_nothing
: >win_err
press d
until_ "a sentence" words '^zsim: --method depthsort brings its depth mapping: leave --depth out'
until_ "the sentence in the window" says_so
written_there '^--method depthsort brings its'
shown view.png
is "lines on standard error" "$(wc -l <win_err | tr -d ' ')" 1
written view.png
is "the command of what is seen" "$line" "$good"
press shift+d
until_ "silence again" says_nothing
press BackSpace r r r r r r r shift+g shift+g shift+g shift+g
until_ "the strip's sentence" words '^zsim: box.obj: --strip 1: ssd1306:128x64 takes 8 rows at a time'
until_ "the sentence in the window" says_so
press BackSpace
shown want.png

begin reloads
z render other.obj $small --out other.png
: >win_err
cp box.obj kept.obj
cp other.obj box.obj
shown other.png
printf 'v 1 2 3\nf 1 2 99\n' >box.obj
"$zsim" render box.obj --out none.png 2>sentence.txt >again.txt && wrong "the broken file is drawn"
broken() { grep -qxF -- "$(cat sentence.txt)" win_err; }
until_ "the broken file's sentence" broken
until_ "it in the window" says_so
shown other.png
press Left
other_gone() { ! sees other.png; }
until_ "the last model to turn" other_gone
until_ "it in the window, still" says_so
press 0
shown other.png
cp kept.obj box.obj
shown want.png
until_ "silence" says_nothing
press q
end

begin compiles_a_scene
cp "$top/firmware/app/my_scene.c" scene.c
cp scene.c kept.c
mkdir -p scenes
drawn() { # FILE.c FRAME    as zsim demo draws it, into scenes/
    "$zsim" demo --scene "$1" --start "$2" --frames 1 --out scenes >again.txt 2>&1 || wrong "$1: $(cat again.txt)"
}
drawn scene.c 0
mv scenes/scene_000.png first.png
open_ scene.c --out scenes
shown first.png
press Right Right
written scenes/scene_002.png
is "command" "$line" "zsim demo --scene=scene.c --out=scenes --start=2 --frames=1"
written_there '^of the animation +2 of 90'
sed 's/struct zs_mesh pyramid/struct zs_mesch pyramid/' kept.c >scene.c
: >win_err
until_ "the compiler's sentence" words '^zsim: scene.c: does not compile: scene.c:[0-9]*:[0-9]*: error: '
until_ "it in the window" says_so
written_there '^scene.c: does not compile'
shown scenes/scene_002.png
press Left
written_there '^of the animation +1 of 90' # the last good scene goes on
written_there '^scene.c: does not compile'
# What it includes is looked at, too, and a shorter animation begins anew
printf '#define SKY 0x802010\n' >sky.h
sed 's/#include "show.h"/&\n#include "sky.h"/; s/ZS_RGB565(0x141c34)/ZS_RGB565(SKY)/; s/FRAMES 90u/FRAMES 1u/' \
    kept.c >scene.c
until_ "silence" says_nothing
written_there '^of the animation +0 of 1'
drawn scene.c 0
shown scenes/scene_000.png
printf '#define SKY 0x208010\n' >sky.h
shown_not() { ! sees scenes/scene_000.png; }
until_ "another sky" shown_not
drawn scene.c 0
shown scenes/scene_000.png
press q
end
sed 's/f->scene.background/if (t == 7) *(volatile int *)8 = 1;\n    &/' kept.c >crash.c
z view crash.c
one_line 1 'crashes at frame 7'
printf 'int nothing;\n' >nothing.c
z view nothing.c
one_line 1 'it ends with SHOW'
sed 's/\.mesh = &pyramid/.mesh = \&other/
    s/^static const struct zs_material grey/extern const struct zs_mesh other;\n&/' kept.c >two.c
z view two.c
one_line 1 'other; name the file that has it, too, as in view scene.c thing.c or, in quotes, --scene "scene.c thing.c"'
z view two.c --scene cubes
one_line 2 'leave one out'
CC=no-such-compiler z view kept.c
one_line 1 'wants a C compiler, and no-such-compiler cannot be run'
leftover=$(find "${TMPDIR:-/tmp}" -maxdepth 1 -name 'zsim-??????' -newer first.png | head -n 1)
is "what is left in TMPDIR" "$leftover" ""

begin ends
open_ box.obj $small
press Escape
end
open_ box.obj $small
./desktop close "$window" || wrong "the window's button cannot be pressed"
end

begin windows_of_any_size # a tiling desktop asks nobody
open_ box.obj $small
for size in '300 300' '430 774' '800 60' '5 5' '900 800'; do
    # shellcheck disable=SC2086
    xdotool windowsize "$window" $size
    until_ "a window of $size" is_wide "${size% *}"
    press h h
done
press Escape
end

begin turns
open_ box.obj $small --background 402010
z render box.obj $small --background 402010 --out want.png
shown want.png
press space
until_ "it to turn" gone
press space
written view.png
press q
end

begin scenes
mkdir -p seen
"$zsim" demo --scene cubes --size 80x60 --frames 1 --out seen >again.txt 2>&1 || wrong "$(cat again.txt)"
open_ --scene cubes --size=80x60 --out frames
shown seen/cubes_000.png
press Right Right f
written frames/cubes_002.png
is "command" "$line" "zsim demo --scene=cubes --size=80x60 --out=frames --start=2 --frames=1 --show=depth"
press Left f
written frames/cubes_001.png
press BackSpace
written frames/cubes_000.png
is "command" "$line" "zsim demo --scene=cubes --size=80x60 --out=frames --start=0 --frames=1"
# Its camera, too, goes around
xdotool mousemove --window "$window" 200 200 mousedown 1 mousemove --window "$window" 240 190 mouseup 1
written frames/cubes_000.png
is "command" "$line" "zsim demo --scene=cubes --size=80x60 --out=frames --start=0 --frames=1 --orbit=-20,-5,1"
cmp -s frames/cubes_000.png seen/cubes_000.png && wrong "a drag does not turn the scene"
xdotool mousemove --window "$window" 200 200 click 4 click 4
written frames/cubes_000.png
is "command" "$line" "zsim demo --scene=cubes --size=80x60 --out=frames --start=0 --frames=1 --orbit=-20,-5,0.81"
fps=$(sed -n 's/^# .*rp2040 //p' win_out | tail -n 1)
[ "$fps" != "$(sed -n 's/^# .*rp2040 //p' win_out | head -n 1)" ] || wrong "from nearer it takes as long: $fps"
press 0
shown seen/cubes_000.png
press q
end
# ... of one with effects before its mirror is drawn
"$zsim" demo --scene stilllife --size 80x60 --orbit 30,0,1 --frames 1 --out seen >again.txt 2>&1 ||
    wrong "$(cat again.txt)"
open_ --scene stilllife --size=80x60 --out frames
xdotool mousemove --window "$window" 200 200 mousedown 1 mousemove --window "$window" 140 200 mouseup 1
shown seen/stilllife_000.png
cp seen/stilllife_000.png turned.png
"$zsim" demo --scene stilllife --size 80x60 --frames 1 --out seen >again.txt 2>&1 || wrong "$(cat again.txt)"
cmp -s turned.png seen/stilllife_000.png && wrong "a drag does not turn a scene with effects"
press 0
shown seen/stilllife_000.png
press q
end
z demo --scene cubes --orbit 0,0,9
one_line 2 'a distance is 0.1 to 8 times'

begin explains_an_empty_picture
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >away.obj
open_ away.obj --eye=0,0,-5 --at=0,0,0 --cull=back
until_ "the reason" words 'triangles face away'
press q
end

begin a_low_desktop
home=$DISPLAY
Xvfb -displayfd 3 -screen 0 1024x768x24 -nolisten tcp -noreset 3>number >xvfb768.log 2>&1 &
low=$!
read -r screen <number
DISPLAY=:$screen
open_ box.obj $small
[ "$(height)" -le 732 ] || wrong "the window is $(height) px high on a screen of 768"
written_there '^  *esp32-c3 +[0-9.]+$|esp32-c3 +[0-9.]+$'
press q
end
kill $low
DISPLAY=$home

begin no_desktop
Xvfb -displayfd 3 -screen 0 1280x1024x16 -nolisten tcp -noreset 3>number >xvfb16.log 2>&1 &
pid=$!
read -r screen <number
DISPLAY=:$screen last=' zsim view box.obj' # on a desktop of 16 bits a pixel
timeout 60 "$zsim" view box.obj >stdout 2>stderr </dev/null
status=$?
one_line 1 'it takes a desktop of 24 or 32 bits a pixel'
kill $pid
pid=
DISPLAY=:4321
timeout 60 "$zsim" view box.obj >stdout 2>theirs </dev/null
status=$?
grep '^zsim: ' theirs >stderr # Wayland's library may say a line of its own
one_line 1 'no window can be opened'
unset DISPLAY
z view box.obj
one_line 1 'no window can be opened'

begin no_sdl
printf '#include "window.h"\nint main(void)\n{\n    int w, h;\n    return view_desktop_size(&w, &h);\n}\n' >without.c
gcc -std=gnu11 -Wall -Wextra -Werror -DVIEW_SDL=0 -I"$top/sim/view" -I"$top/sim/cli" without.c \
    "$top/sim/view/window.c" \
    "$top/sim/cli/sim.c" -o without || wrong "it does not compile"
./without >stdout 2>stderr
status=$?
one_line 1 'the package libsdl2-dev is missing'

begin refusals
z view
one_line 2 'a model is missing'
z view none.obj
one_line 1 'none.obj: cannot be read'
z view box.obj --stats s.json
one_line 2 '--stats has no use in a window'
z view box.obj --scene cubes
one_line 2 'leave one out'
z view --scene none
one_line 1 'there is no such scene'
z view box.obj --strip 0
one_line 1 'a strip has at least 1 row'
z view --help
[ $status -eq 0 ] && grep -q '^  --scene NAME' stdout && grep -q '^  --strip ROWS' stdout &&
    ! grep -q '^  --stats' stdout ||
    wrong "help: status $status"
finish
[ $n_failed -eq 0 ]
