#!/bin/sh
# `zsim new`: projects that build, draw and pass their own test, away from this tree; bad input leaves nothing behind.
# Usage: tests/tools/new.sh ZSIM WORK BUILD     from the repository's top; BUILD/pico has the emulator, if it was set up
. tests/lib/cmake.sh
. tests/tools/zsim.sh
case $3 in /*) build=$3 ;; *) build=$top/$3 ;; esac

cat >box.obj <<'END'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 2
v 1 0 2
v 1 1 2
v 0 1 2
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
END

# ---- Refusals --------------------------------------------------------------------------------------------------

refuses() { # NAME STATUS WORDS ARGUMENTS...
    begin "new_refuses_$1"
    want=$2 words=$3
    shift 3
    z new "$@"
    [ "$status" = "$want" ] || wrong "exit $status, not $want: $(said)"
    grep -qF -- "$words" stderr || wrong "does not say '$words': $(said)"
    [ "$(wc -l <stderr)" = 1 ] || wrong "not one line: $(said)"
    [ ! -e made ] || wrong 'a folder was left'
    rm -rf made
}
refuses no_model 2 'a model is missing' --out made
refuses no_folder 2 '--out is missing' box.obj
refuses unknown_board 2 '--board' box.obj --out made --board toaster
refuses missing_model 1 'nothing.obj' nothing.obj --out made
refuses a_name_for_the_model 2 '--name is not taken' box.obj --name thing --out made
refuses options_of_convert_that_are_wrong 1 '--texture-size' box.obj --out made --texture-size 3x3
refuses a_name_that_make_would_not_take 1 "the folder's name becomes" box.obj --out 'my model'
"$zsim" render box.obj --out box.png
refuses a_picture 1 'is a picture; zsim new takes a model' box.png --out made
begin new_refuses_to_copy_into_what_it_copies
z new box.obj --out "$top/firmware/zstrip/made"
[ "$status" = 1 ] && grep -q "is among zstrip's sources" stderr || wrong "exit $status: $(said)"
[ ! -e "$top/firmware/zstrip/made" ] || wrong 'a folder was left'
begin new_stopped_leaves_nothing
tries=0
while [ $tries -lt 20 ]; do
    tries=$((tries + 1))
    "$zsim" new box.obj --out stopped >stdout 2>stderr &
    pid=$!
    while [ ! -e stopped ] && kill -0 $pid 2>/dev/null; do sleep 0.01; done
    kill -TERM $pid 2>/dev/null
    wait $pid
    status=$?
    [ $status = 0 ] || break # it was done before
    rm -rf stopped
done
[ $status = 143 ] || wrong "exit $status"
[ ! -e stopped ] || wrong "left: $(find stopped | wc -l) files"
begin new_refuses_a_folder_that_is_there
mkdir there && echo mine >there/main.c
z new box.obj --out there
[ "$status" = 1 ] && grep -q 'is there already' stderr || wrong "exit $status: $(said)"
[ "$(cat there/main.c)" = mine ] || wrong 'its file was changed'
begin new_refuses_without_sources
ZSTRIP=$work/there z new box.obj --out made
[ "$status" = 1 ] && grep -q 'ZSTRIP' stderr && [ ! -e made ] || wrong "exit $status: $(said)"

# ---- Projects --------------------------------------------------------------------------------------------------

# The project's own make, in which a warning is an error; leak checks are not for what it runs.
project() { # DIR ARGUMENTS...
    last=" make -C $*"
    make --no-print-directory -C "$@" WERROR=-Werror >made.txt 2>&1
}
# What another project has compiled for a board is taken for this one's, where both have the same sources. Make compiles
# what is not among it, or all that sees DEFINES where these are others.
shares() { # DIR FROM BOARD
    diff -rq --exclude=emulator "$2/zstrip" "$1/zstrip" >words || { wrong "$(head -1 words)"; return; }
    mkdir -p "$1/build/fw/$3"
    (cd "$2/build/fw/$3" && cp -a firmware hal defines* "$work/$1/build/fw/$3/")
    find "$1/build/fw/$3" -name '*.o' -exec touch {} + # its sources are newer
}
for board in pico stm32f405 lm3s6965 host linux; do
    begin "new_$board"
    z new --shade flat box.obj --board=$board --out "$board"
    [ "$status" = 0 ] || wrong "$(said)"
    grep -q '^/\* box.obj turns' "$board/main.c" || wrong "main.c begins with $(head -1 "$board/main.c")"
    code=$(gcc -fpreprocessed -dD -E -P -x c "$board/main.c" | grep -c .)
    [ "$code" -le 40 ] || wrong "main.c has $code lines without comments and blank ones, more than 40"
    grep -rlE '@[A-Z_]+@' $board --include='*' --exclude-dir=zstrip >words && wrong "words are left: $(cat words)"
    [ $board = pico ] || shares $board pico host
    [ $board = host ] || project $board image || wrong "$(tail -3 made.txt)"
    if [ $board = linux ]; then # here is no panel: it says what is not there
        ./linux/build/fw/linux/linux.elf >made.txt 2>&1 && wrong 'it found a panel'
        grep -q 'spidev\|/dev/gpiochip' made.txt || wrong "it does not say what is not there: $(tail -3 made.txt)"
    fi
    project $board test BOARD=host || wrong "$(tail -3 made.txt)"
    [ "$(grep -c '^ok ' made.txt)" = 3 ] || wrong "its test: $(tail -3 made.txt)"
done

# Materials that are transparent and that shine: effects are linked, the panes are seen through
cat >panes.mtl <<'END'
newmtl glass
Kd 0.2 0.5 0.9
d 0.4
newmtl shiny
Kd 0.8 0.3 0.2
Ks 0.9 0.9 0.9
Ns 40
END
{ echo 'mtllib panes.mtl'; sed '/^f 1 2 6 5/i usemtl shiny' box.obj | sed '0,/^f /s//usemtl glass\nf /'; } >panes.obj
begin new_of_materials
z new panes.obj --out panes
[ "$status" = 0 ] || wrong "$(said)"
shares panes pico pico
shares panes pico host
project panes image || wrong "pico: $(tail -3 made.txt)"
project panes test BOARD=host || wrong "$(tail -3 made.txt)"
project panes image BOARD=host || wrong "host: $(tail -3 made.txt)"
sed -i 's/^d 0.4$/d 1/' panes.mtl
z new panes.obj --out opaque
shares opaque panes pico
shares opaque panes host
project opaque test BOARD=host || wrong "$(tail -3 made.txt)"
cmp -s panes/build/host/test_1.bin opaque/build/host/test_1.bin && wrong 'glass is as opaque as what is not'

# A texture that shines has four varyings: all of the project is compiled so
z render box.obj --size 64x64 --background 4060c0 --out skin.png
printf 'newmtl wet\nmap_Kd skin.png\nKs 0.9 0.9 0.9\nNs 9\n' >wet.mtl
{ printf 'mtllib wet.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wet\n'
    sed 's|^f \(.\) \(.\) \(.\) \(.\)|f \1/1 \2/2 \3/3 \4/4|' box.obj; } >wet.obj
begin new_of_highlights_on_textures
z new wet.obj --out wet
[ "$status" = 0 ] || wrong "$(said)"
grep -q zs_shade_texture_gloss wet/model.c || wrong 'no highlights'
project wet image BOARD=pico || wrong "$(tail -3 made.txt)"
project wet test BOARD=host || wrong "$(tail -3 made.txt)"
{ configured wet wet/cmake && cmake --build wet/cmake -j2; } >made.txt 2>&1 || wrong "$(tail -3 made.txt)"
HAL_STREAM=cmake.stream ./wet/cmake/wet >made.txt 2>&1 || wrong "$(tail -3 made.txt)"
cmp -s cmake.stream wet/build/host/stream && wrong 'three frames are 48'
sed -i '/^Ks/d' wet.mtl
z new wet.obj --out dry
shares dry panes host
project dry test BOARD=host || wrong "$(tail -3 made.txt)"
cmp -s wet/build/host/test_1.bin dry/build/host/test_1.bin && wrong 'it shines no more than without'

# Two halves of a wall in the same paint, of which one shines: the same light makes them one colour
obj wall 'mtllib wall.mtl' 'v 0 0 0' 'v 1 0 0' 'v 1 1 0' 'v 0 1 0' 'v 2 0 0' 'v 2 1 0' 'usemtl gloss' 'f 1 2 3 4' \
    'usemtl plain' 'f 2 5 6 3'
printf 'newmtl gloss\nKd 0.8 0.2 0.2\nKs 0.3 0.3 0.3\nNs 900\nnewmtl plain\nKd 0.8 0.2 0.2\n' >wall.mtl
begin new_has_one_light
z new wall.obj --shade flat --out wall
[ "$status" = 0 ] || wrong "$(said)"
grep -q '^#define MODEL_LITS 1u' wall/model.h || wrong 'nothing shines'
shares wall panes host
project wall test BOARD=host || wrong "$(tail -3 made.txt)"
look png wall/build/host/test_1.png
is 'colours: background, counter, wall' "$(word 3 $seen)" 3

begin new_says_what_does_not_fit
sed -i 's/^#define ROWS .*/#define ROWS 240/; s/^#define TRIS .*/#define TRIS 9000/' opaque/display.h opaque/main.c
project opaque image BOARD=pico && wrong 'it fits'
grep -q '^pico: opaque does not fit it. Pools take most of the RAM' made.txt || wrong "$(tail -3 made.txt)"

begin new_draws_in_the_emulator_as_on_the_host
if [ -d "$build/pico/node_modules" ]; then
    cp -r "$build/pico/node_modules" pico/zstrip/emulator/
    project pico test || wrong "$(tail -3 made.txt)"
    [ "$(grep -c '^ok ' made.txt)" = 7 ] || wrong "its test: $(tail -3 made.txt)"
    project pico show SHOWN=4 || wrong "$(tail -3 made.txt)"
    grep -qE '^fps [0-9]' made.txt || wrong "no frames a second: $(tail -3 made.txt)"
    grep -qE '^flash_percent [0-9]+$' made.txt || wrong "no share of waits for the flash: $(tail -3 made.txt)"
    [ -s pico/build/pico/003.png ] && [ ! -e pico/build/pico/004.png ] || wrong 'not four pictures'
else
    skipped 'the emulator of boards is not set up'
fi

begin new_of_another_size
sed -i 's/^#define H .*/#define H 320/' host/display.h
project host show BOARD=host SHOWN=3 || wrong "$(tail -3 made.txt)"
is 'width, height' "$(od -An -tu1 -j16 -N8 host/build/host/002.png | tr -s ' ')" ' 0 0 0 240 0 0 1 64'
[ ! -e host/build/host/003.png ] || wrong 'more than three pictures'
project host test || wrong "$(tail -3 made.txt)"
sed -i 's/^#define H .*/#define H 240/' host/display.h

begin new_with_a_header_of_ones_own
echo '#include <zs_lights.h>' >host/world.h
sed -i 's/^#include "model.h"/&\n#include "world.h"/
    s/^    display_close/    err = err ? err : zs_lighting_check(\&(struct zs_lighting){ 0 });\n&/' host/main.c
project host test || wrong "$(tail -3 made.txt)"

begin new_test_sees_a_program_that_draws_nothing
sed -i 's/\.n_instances = MODEL_INSTANCES/.n_instances = 0/; s/\.n_resolves = 1/.n_resolves = 0/' host/main.c
project host test && wrong 'the test of an empty picture passes'
grep -q '^FAILED host_picture_has_colours' made.txt || wrong "$(tail -3 made.txt)"

begin new_builds_by_cmake
{ configured pico pico/cmake && cmake --build pico/cmake -j2; } >made.txt 2>&1 || wrong "$(tail -3 made.txt)"
HAL_STREAM=cmake.stream ./pico/cmake/pico >made.txt 2>&1 || wrong "$(tail -3 made.txt)"
cmp -s cmake.stream pico/build/host/stream && wrong 'three frames are 48'
[ "$(wc -c <cmake.stream)" -gt 10000000 ] || wrong 'no pictures came'

begin new_stands_where_it_is_moved
mv stm32f405 moved && project moved image || wrong "$(tail -3 made.txt)"
grep -rl "$top" moved --include='*.c' --include='*.md' --include='*.txt' >words && wrong "names a path: $(cat words)"
finish
exit $((n_failed > 0))
