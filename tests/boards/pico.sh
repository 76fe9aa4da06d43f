#!/bin/sh
# The Raspberry Pi Pico's flash images on an emulated RP2040 (rp2040js): what its panel shows, frame by frame, is what
# the simulator draws; what a frame takes.
# Usage: tests/boards/pico.sh BUILD          from the repository's top; BUILD/zsim and BUILD/gen
#        tests/boards/pico.sh BUILD table    the table alone
#        tests/boards/pico.sh BUILD set-up   the emulator alone, in BUILD/pico
#        tests/boards/pico.sh BUILD sweep    interrupts at each instruction alone
#        tests/boards/pico.sh BUILD cores    both cores alone
#        tests/boards/pico.sh BUILD profile  cycles a frame by function, of the scenes in PICO_SCENES
#
# `ok NAME` or `FAILED NAME: reason` a test; images, streams and pictures stay in BUILD/pico and BUILD/fw/pico.
set -u
build=$1
only=${2:-}
out=$build/pico
fw=$build/fw/pico
SCENES=${PICO_SCENES:-'teapot china cubes knot flyover city hall globe'}
PIECES='stilllife cockpit forest' # in the table
SCENES_2='teapot cubes' # of these, the tests' with both cores; the table has all
FRAMES=4     # of cubes, and for the table; tests draw FRAMES_FEW of the others
FRAMES_FEW=3 # the least of which run.mjs has figures
STEP=13    # frames of the animation between two that are drawn
GAP=30     # ns between words, as measured on real chips in SPI mode 0
. tests/boards/image.sh

# ---- Set-up --------------------------------------------------------------------------------------------------

# The emulator, as locked; scripts stand beside it, where they find it.
set_up() {
    if ! cmp -s tests/boards/pico/package-lock.json "$out/package-lock.json" ||
        [ ! -d "$out/node_modules/rp2040js" ]; then
        cp tests/boards/pico/package.json tests/boards/pico/package-lock.json "$out/"
        (cd "$out" && npm ci --loglevel error --no-audit --no-fund) >"$out/npm.log" 2>&1 || {
            rm -f "$out/package-lock.json"
            if grep -qE 'ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ETIMEDOUT|ENETUNREACH' "$out/npm.log"; then
                echo "SKIPPED pico: its emulator cannot be fetched: $(grep -oE 'reason: .*' "$out/npm.log" | head -1)"
                exit 0
            fi
            bad pico_emulator "npm ci: $(head -c 300 "$out/npm.log")"
            exit 1
        }
    fi
    cp tests/boards/pico/*.mjs tests/boards/elf.mjs "$out/"
}

# All that follows is gone through twice: while $asking, images are built and runs of the emulator are asked for; then
# these are made, and looked at. One process makes all of one core, and one all of two (many.mjs): each would load the
# emulator and compile it anew.
asking=
build() { # MAKE-ARGUMENTS...
    [ -z "$asking" ] || image pico "$@"
}
emulated() { # CORES TO SCRIPT ARGUMENTS...: whether it is there to be looked at, in TO
    [ -n "$asking" ] || return 0
    cores=$1
    shift
    : >"$1"
    echo "$*" >>"$out/asked.$cores"
    return 1
}
ask() {
    rm -f "$out"/*.stream
    : >"$out/asked.1"
    : >"$out/asked.2"
    asking=yes
}
emulate() {
    asking=
    node "$out/many.mjs" "$out/asked.1" >"$out/many.1" 2>&1 &
    first=$!
    node "$out/many.mjs" "$out/asked.2" >"$out/many.2" 2>&1
    second=$?
    wait $first || second=1
    [ $second -eq 0 ] || bad pico_emulator "$(cat "$out/many.1" "$out/many.2")"
}

# -2: the image for both cores
image_of() {
    case $1 in *-2) echo "$fw-2/${1%-2}" ;; *) echo "$fw/$1" ;; esac
}
frames_of() { # SCENE[-2]
    case $only/$1 in /cubes*) echo $FRAMES ;; /*) echo $FRAMES_FEW ;; *) echo $FRAMES ;; esac
}
# Run SCENE[-2] without gaps, recorded
run_scene() {
    cores=1
    case $1 in *-2) cores=2 ;; esac
    build APP=show SCENE="${1%-2}" CORES=$cores
    [ -z "$asking" ] || : >"$out/$1.gap.txt" >"$out/$1.xip.txt"
    emulated $cores "$out/$1.txt" run.mjs "$(image_of "$1")" --frames "$(frames_of "$1")" --step $STEP \
        --stream "$out/$1.stream" && ended "$1" "$out/$1.txt"
}
# With gaps: in the tests those of $SCENES_2 alone, as gaps are the wire's. For the table once more, with gaps and a
# flash that takes its time. After those without: the emulator's code is then compiled for numbers of one kind.
run_gaps() { # SCENE[-2]
    cores=1 n=$(frames_of "$1")
    case $1 in *-2) cores=2 ;; esac
    [ "$only/$n" != /$FRAMES_FEW ] || n=2 # a picture, and one after it
    case "$only/ $SCENES_2 " in
    ?*/* | */*" ${1%-2} "*)
        emulated $cores "$out/$1.gap.txt" run.mjs "$(image_of "$1")" --frames "$n" --step $STEP --gap $GAP &&
            ended "$1" "$out/$1.gap.txt" ;;
    esac
    [ -z "$only" ] || ! emulated $cores "$out/$1.xip.txt" run.mjs "$(image_of "$1")" --frames "$n" --step $STEP \
        --gap $GAP --xip 1 || ended "$1" "$out/$1.xip.txt"
}
ended() { # SCENE[-2] FILE
    ! grep -q Error "$2" || bad "pico_$1" "$(grep -m1 Error "$2")"
}

# ---- Pictures -----------------------------------------------------------------------------------------------------

decode() { # STEM
    rm -f "$1"_*.bin "$1"_*.png
    "$build/zsim" panel --panel st7789:240x240 --invert --decode "$1.stream" --out "$1_%d.png" \
        --raw "$1_%d.bin" >"$1.panel.txt" 2>&1 ||
        echo "the panel would not have understood it: $(tail -1 "$1.panel.txt")"
}
truth_of() { # SCENE NUMBER    its k-th picture, named for the frame of the animation
    printf '%s/truth/%s_%03d.bin' "$out" "$1" $(($2 * STEP))
}
same() { # STEM SCENE NUMBERS...
    stem=$1 scene=$2
    shift 2
    for k in "$@"; do
        cmp -s "${stem}_$k.bin" "$(truth_of "$scene" "$k")" ||
            { echo "picture $k differs: ${stem}_$k.png"; return; }
    done
}

scene_tests() { # SCENE, SCENE-2
    scene=${1%-2} n=$(frames_of "$1")
    decode "$out/$1" >"$out/$1.bad"
    rm -f "$out/truth/$scene"_*
    # in strips of another height, from other pools than the board's; one more for those that stumble
    truth "$out/truth" "$scene" $((n + 1)) $STEP --size 240x240 --strip 17
    same "$out/$1" "$scene" $(seq 0 $((n - 1))) >>"$out/$1.bad"
    [ "$(field "$out/$1.txt" frames)" = "$n" ] || echo "not $n pictures" >>"$out/$1.bad"
    field "$out/$1.txt" problem >>"$out/$1.bad"
    field "$out/$1.gap.txt" problem >>"$out/$1.bad"
    field "$out/$1.txt" text | grep '^#' >>"$out/$1.bad"
    verdict "pico_$1_pictures" "$(head -3 "$out/$1.bad" | tr '\n' ' ')"
    # frames may be right and slow; these cycles repeat, other compilers may take a tenth more
    [ "$1" != "$scene" ] || [ "$n" -gt 4 ] ||
        awk -v scene="$1" -v now="$(field "$out/$1.txt" draw_cycles)" '
            $1 == scene && (now > 0) && now < $2 * 1.1 { found = 1 } END { exit !found }' tests/records/pico.txt ||
        bad "pico_$1_cycles" "$(field "$out/$1.txt" draw_cycles) a frame; tests/records/pico.txt has $(
            sed -n "s/^$1 //p" tests/records/pico.txt)"
    [ "$(field "$out/$1.txt" spi_hz)/$(field "$out/$1.txt" spi_mode0)" = 62500000/1 ] ||
        bad "pico_$1_spi" "$(field "$out/$1.txt" spi_hz) Hz"
    awk -v p="$(field "$out/$1.txt" in_flash_percent)" 'BEGIN { exit !(p < 1) }' ||
        bad "pico_$1_runs_from_ram" "$(field "$out/$1.txt" in_flash_percent) % of the drawing's cycles are in flash"
    for stack in stack $([ "$1" = "$scene" ] || echo stack_1); do
        used=$(field "$out/$1.txt" ${stack}_used) reserve=$(field "$out/$1.txt" ${stack}_reserve)
        [ "$used" -gt 0 ] && [ "$used" -lt $((reserve * 3 / 4)) ] ||
            bad "pico_$1_$stack" "$used of $reserve bytes, more than three quarters"
    done
}

# ---- The table ------------------------------------------------------------------------------------------------------

table_head() {
    echo
    echo "Raspberry Pi Pico, RP2040 at 125 MHz, ST7789 240x240 at 62.5 MHz: $(frames_of teapot) frames, $STEP apart," \
        "of each scene$([ -n "$only" ] || echo " ($FRAMES of cubes)")."
    printf '%-9s %11s %8s %8s %6s %6s %6s %7s %8s %8s %7s %5s %7s %8s %6s\n' scene 'draw cycles' 'wire us' \
        "+$GAP ns" fps \
        "+$GAP ns" +flash misses 'strip us' 'its wire' hidden late RAM flash stack
}
late() { # FILE    of how many frames, from the last line of statistics
    field "$1" text | awk -F, 'NF > 5 && $2 + 0 { last = $7 "/" $2 } END { print last }'
}
with_gaps() { # FILE NAME    -: it did not run with them
    of=$(field "$1" "$2")
    echo "${of:--}"
}
table_row() { # SCENE
    a=$out/$1.txt b=$out/$1.gap.txt c=$out/$1.xip.txt
    echo "pico $1 $(field "$a" flash) $(field "$a" ram) $(field "$a" stack_used) $(field "$a" draw_cycles)" \
        >>"$out/table.txt"
    printf '%-9s %11d %8d %8s %6.1f %6s %6s %7s %8d %8d %6d%% %5s %7d %8d %6d\n' "$1" "$(field "$a" draw_cycles)" \
        "$(field "$a" wire_us)" "$(with_gaps "$b" wire_us)" "$(field "$a" fps)" "$(with_gaps "$b" fps)" \
        "$(with_gaps "$c" fps)" "$(with_gaps "$c" flash_misses)" $(($(field "$a" worst_strip_cycles) / 125)) \
        $(($(field "$a" wire_us) / $(field "$a" strips))) "$(field "$a" hidden_percent)" "$(late "$a")" \
        "$(field "$a" ram)" "$(field "$a" flash)" "$(field "$a" stack_used)"
}
# Both cores draw: cycles of each, and what that gains.
table_2_head() {
    echo
    echo "The same with CORES=2: the cores bin a part of the scene each, and draw whichever strip is next."
    printf '%-9s %9s %9s %8s %6s %6s %6s %7s %6s %6s %5s %7s %8s %6s %7s\n' scene 'core 0' 'core 1' 'wire us' fps \
        "+$GAP ns" \
        +flash misses gain hidden late RAM flash stack 'stack 1'
}
table_2_row() { # SCENE
    a=$out/$1-2.txt b=$out/$1-2.gap.txt c=$out/$1-2.xip.txt
    printf '%-9s %9d %9d %8d %6.1f %6s %6s %7s %6.2f %5d%% %5s %7d %8d %6d %7d\n' "$1" "$(field "$a" draw_cycles)" \
        "$(field "$a" draw_cycles_1)" "$(field "$a" wire_us)" "$(field "$a" fps)" "$(with_gaps "$b" fps)" \
        "$(with_gaps "$c" fps)" "$(with_gaps "$c" flash_misses)" \
        "$(awk -v one="$(field "$out/$1.txt" fps)" -v two="$(field "$a" fps)" 'BEGIN { print two / one }')" \
        "$(field "$a" hidden_percent)" "$(late "$a")" "$(field "$a" ram)" "$(field "$a" flash)" \
        "$(field "$a" stack_used)" "$(field "$a" stack_1_used)"
}
table_foot() {
    miss=$(field "$out/cache.txt" miss)
    echo "Emulated (rp2040js): no bus contention, so that cycles are a lower bound; draw cycles and the first fps"
    echo "are of a flash without wait states. +$GAP ns: with that pause after each 16-bit word, as real chips make"
    echo "in SPI mode 0. +flash: with pauses and a flash that takes $miss cycles for each word that its cache"
    echo "lacks; misses: of these, in drawing a frame. strip us: drawing the slowest strip, without those waits;"
    echo "its wire: a strip of pixels on the wire. hidden: the share of drawing (core 0's) that went on while the"
    echo "wire was busy. late: frames that took longer than the scene's step. gain: fps by those of one core. Two"
    echo "cores: what they wait for each other at a bank of RAM or at the flash is not counted."
}

# ---- Tests -------------------------------------------------------------------------------------------------

# What parts.mjs and its like have printed on FILE: N tests, the names of which get PREFIX
tests_of() { # NAME FILE N [PREFIX]
    sed -nE "s/^(ok|FAILED) /\\1 ${4:-}/p" "$2"
    ! grep -q '^FAILED ' "$2" || failed=1
    [ "$(grep -cE '^(ok|FAILED) ' "$2")" = "$3" ] || bad "$1" "not all of them ran: $(grep -m1 Error "$2")"
}

parts() {
    emulated 1 "$out/parts.txt" parts.mjs "$fw/parts" || { build_parts; return; }
    tests_of pico_parts "$out/parts.txt" 9
    wire='c2c | c36 81 00 fe | 11 22 33 44 55 66 | 11 22 33 44 55 | 22 33 44 55 | 11 |'
    [ "$(field "$out/parts.txt" wire)" = "$wire" ] || bad pico_wire "$(field "$out/parts.txt" wire)"
    verdict pico_parts_without_problems "$(field "$out/parts.txt" problem)"
}
build_parts() {
    twin=$out/twin
    mkdir -p "$twin"
    libgcc=$(arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -print-libgcc-file-name)
    for member in _udivsi3.o _divsi3.o; do
        arm-none-eabi-ar p "$libgcc" $member >"$twin/$member" &&
            arm-none-eabi-objcopy --prefix-symbols=libgcc_ "$twin/$member" || bad pico_twin "no $member in libgcc"
    done
    build NAME=parts APP_SRC=tests/boards/pico/parts.c EXTRA="$twin/_udivsi3.o $twin/_divsi3.o"
}

# A strip whose words stop, at once or just before its last ones: said so, the rest of the frame is dropped, and
# all other frames are right.
broken_strip() { # NAME OPTIONS...
    name=$1
    shift
    stem=$out/$name
    emulated 1 "$stem.txt" run.mjs "$fw/cubes" --frames $FRAMES --step $STEP --stream "$stem.stream" "$@" || return
    decode "$stem" >"$stem.bad"
    same "$stem" cubes 0 1 3 >>"$stem.bad"
    grep -q '^text # the bus did not end in its time' "$stem.txt" || echo "nothing was reported" >>"$stem.bad"
    cmp -s "${stem}_2.bin" "$(truth_of cubes 2)" && echo "nothing was broken" >>"$stem.bad"
    field "$stem.txt" problem >>"$stem.bad"
    verdict "pico_$name" "$(head -3 "$stem.bad" | tr '\n' ' ')"
}

# Both cores, and something goes wrong: NAME TEXT FRAMES PICTURES OPTIONS...   FRAMES of cubes are drawn; of the
# pictures those numbers are right, one other at least is not (where less than FRAMES are named), and the UART says
# TEXT, or nothing.
goes_wrong() {
    name=$1 says=$2 n=$3 right=$4
    shift 4
    stem=$out/$name
    emulated 2 "$stem.txt" run.mjs "$fw-2/cubes" --frames "$n" --step $STEP --seconds 60 --stream "$stem.stream" "$@" ||
        return
    decode "$stem" >"$stem.bad"
    # shellcheck disable=SC2086
    same "$stem" cubes $right >>"$stem.bad"
    [ "$(echo "$right" | wc -w)" -eq "$n" ] ||
        for k in $(seq 0 $((n - 1))); do cmp -s "${stem}_$k.bin" "$(truth_of cubes "$k")" || echo broken; done |
        grep -q broken || echo "nothing was broken" >>"$stem.bad"
    said=$(field "$stem.txt" text | sed -n 's/^# //p')
    [ "$said" = "$says" ] || echo "said: $said" >>"$stem.bad"
    grep -m1 Error "$stem.txt" >>"$stem.bad"
    field "$stem.txt" problem >>"$stem.bad"
    verdict "pico_$name" "$(head -3 "$stem.bad" | tr '\n' ' ')"
}
# The images of all scenes for both cores fit into the RAM; only some of them are run.
fits_twice() {
    [ -z "$asking" ] || return
    sed -n 's/^#define SIZES_2_\([a-z]*\) .*/\1/p' firmware/scenes/sizes.h >"$out/scenes_2.txt"
    while read -r of; do
        make -s -f firmware/boards/firmware.mk BOARD=pico B="$build" APP=show SCENE="$of" CORES=2 image \
            >"$out/fits.log" 2>&1 || echo "$of: $(grep -o 'overflowed by.*' "$out/fits.log" || tail -1 "$out/fits.log")"
    done <"$out/scenes_2.txt" >"$out/fits.bad"
    [ "$(wc -l <"$out/scenes_2.txt")" -ge 9 ] || echo "scenes are missing in sizes.h" >>"$out/fits.bad"
    verdict pico_images_for_both_cores_fit "$(tr '\n' ' ' <"$out/fits.bad")"
}

two_cores() {
    [ -n "$asking" ] ||
        for of in $SCENES_2; do
            scene_tests "$of-2"
        done
    fits_twice
    by_the_clock 2 second
    build NAME=second APP_SRC=tests/boards/pico/second.c CORES=2
    if emulated 2 "$out/second.txt" parts.mjs "$fw-2/second" 60; then
        tests_of pico_second "$out/second.txt" 7 pico_
        verdict pico_second_without_problems "$(field "$out/second.txt" problem)"
    fi
    goes_wrong second_absent 'core 1 does not answer: core 0 draws alone' 4 '0 1 2 3' --second dead
    [ -n "$asking" ] || verdict pico_second_same_wire \
        "$(cmp "$out/second_absent.stream" "$out/cubes-2.stream" 2>&1)" # what core 0 alone sends
    goes_wrong second_garbled '' 4 '0 1 2 3' --second garble
    goes_wrong second_wakes_up '' 4 '0 1 2 3' --doze 4000000
    goes_wrong second_stops 'core 1 stopped: core 0 draws alone' 5 '0 1 4' --stop 2.5
    goes_wrong second_stopped_strip 'the bus did not end in its time' 5 '0 1 3 4' --hold 2.1
    goes_wrong second_refused 'a required pointer is NULL' 5 '0 1 3 4' --refuse 2
    goes_wrong second_stopped_tail 'the bus did not end in its time' 5 '0 1 4' --hold 2.6 --tail 1
    # what leaves ends in a command without its arguments: of no use to a decoder
    if emulated 2 "$out/command.txt" run.mjs "$fw-2/cubes" --frames 5 --step $STEP --hold 2.3 --head 1 --seconds 60
    then
        verdict pico_second_stopped_command \
            "$(says "$out/command.txt" '5 # the bus did not end in its time' "$(field "$out/command.txt" frames) $(
                field "$out/command.txt" text | grep '^#')")"
    fi
    if emulated 2 "$out/fault.txt" run.mjs "$fw-2/cubes" --frames 4 --step $STEP --fault 1.3; then
        verdict pico_second_faults \
            "$(says "$out/fault.txt" 'pico: hard fault on core 1' "$(field "$out/fault.txt" text | tail -1)")"
    fi
}
says() { # FILE WANTED FOUND: where they differ, what was found and the end of FILE
    [ "$2" = "$3" ] || echo "$3; $(tail -1 "$1")"
}

# Interrupts at each instruction of a transfer, and the timer's wrap at each moment.
sweep() {
    build NAME=sweep APP_SRC=tests/boards/pico/sweep.c
    emulated 1 "$out/sweep.txt" sweep.mjs "$fw/sweep" || return
    tests_of pico_sweep "$out/sweep.txt" 6
    # 220 rounds of a kind; of each, those without a hook end asleep
    awk '$1 == "swept" && ($3 < 220 || $2 == 5 && $3 < 302 || $2 < 4 && ($4 < 40 || $4 > 180)) { print }' \
        "$out/sweep.txt" >"$out/sweep.bad"
    field "$out/sweep.txt" problem >>"$out/sweep.bad"
    verdict pico_sweep_without_problems "$(head -3 "$out/sweep.bad" | tr '\n' ' ')"
}

# The interrupt that is waited for comes between the question and the sleep: no wake-up is lost.
wakes_up() {
    emulated 1 "$out/doze.txt" run.mjs "$fw/cubes" --frames $FRAMES --step $STEP --doze 4000000 \
        --stream "$out/doze.stream" || return
    decode "$out/doze" >"$out/doze.bad"
    same "$out/doze" cubes 0 1 2 3 >>"$out/doze.bad"
    field "$out/doze.txt" problem >>"$out/doze.bad"
    grep -m1 Error "$out/doze.txt" >>"$out/doze.bad"
    verdict pico_wakes_up "$(head -3 "$out/doze.bad" | tr '\n' ' ')"
}

# The image is that of the scene and the settings that were asked for last, whatever was built before under its name. In
# a folder of its own, as settings compile all anew, but for the renderer, which knows nothing of them.
ASKED=$fw-asked
asked() { # MAKE-ARGUMENTS...
    image pico OUT="$ASKED" CORE_OBJ="$out/core" APP=show "$@"
}
as_asked() {
    [ -n "$asking" ] || { verdict pico_image_is_as_asked "$(tr '\n' ' ' <"$out/asked.bad")"; return; }
    : >"$out/asked.bad"
    rm -rf "$out/core"
    mkdir -p "$out/core"
    (cd "$fw" && find firmware/zstrip -name '*.o' | tar cf - --transform 's|/|-|g' -T -) | tar xf - -C "$out/core"
    asked SCENE=mine
    cp "$ASKED/my_scene.uf2" "$out/mine.uf2"
    sed 's/^#define FRAMES 90u/#define FRAMES 91u/' firmware/app/my_scene.c >"$out/my_scene.c"
    asked APP_SCENE="$out/my_scene.c"
    cmp -s "$ASKED/my_scene.uf2" "$out/mine.uf2" && echo "another file of the same name is not built" >>"$out/asked.bad"
    asked SCENE=mine
    cmp -s "$ASKED/my_scene.uf2" "$out/mine.uf2" || echo "not my_scene.c's after another's" >>"$out/asked.bad"
    asked SCENE=mine DEFINES=-DPIN_RESET=14
    cmp -s "$ASKED/my_scene.uf2" "$out/mine.uf2" && echo "DEFINES change nothing" >>"$out/asked.bad"
    asked SCENE=mine
    cmp -s "$ASKED/my_scene.uf2" "$out/mine.uf2" || echo "DEFINES stay" >>"$out/asked.bad"
}

# Glass that is not square, turned: all of the picture arrives, background in its corners and something in its middle.
turned() {
    [ -z "$asking" ] || image pico OUT="$fw-turned" CORE_OBJ="$out/core" APP=show SCENE=mine \
        DEFINES='-DSHOW_WIDTH=240 -DSHOW_HEIGHT=135 -DSHOW_ROTATE=1'
    rm -f "$out/turned_0.bin"
    emulated 1 "$out/turned.txt" run.mjs "$fw-turned/my_scene" --frames 1 --stream "$out/turned.stream" || return
    : >"$out/turned.bad"
    "$build/zsim" panel --panel st7789:135x240 --rotate 90 --invert --decode "$out/turned.stream" \
        --out "$out/turned_%d.png" --raw "$out/turned_%d.bin" >"$out/turned.panel.txt" 2>&1 ||
        tail -1 "$out/turned.panel.txt" >"$out/turned.bad"
    px=$(od -An -v -tx1 -w2 "$out/turned_0.bin" 2>/dev/null | tr -d ' ' | sed -n '1p;240p;16200p;32161p;32400p')
    # shellcheck disable=SC2086
    set -- $px
    [ $# = 5 ] && [ "$1$2$4$5" = 10e610e610e610e6 ] && [ "$3" != 10e6 ] ||
        echo "left and right above, middle, left and right below are" $px >>"$out/turned.bad"
    grep '^text #' "$out/turned.txt" >>"$out/turned.bad"
    field "$out/turned.txt" problem >>"$out/turned.bad"
    verdict pico_turned_glass "$(tr '\n' ' ' <"$out/turned.bad")"
}

# As it runs on a desk: 32 frames of the scene to be changed, at its 30 a second, none late: CORES [second]
by_the_clock() {
    build APP=show SCENE=mine CORES="$1"
    at=$out/clock.$1
    emulated "$1" "$at.txt" run.mjs "$(image_of "my_scene$([ "$1" = 1 ] || echo -2)")" --until 'mine,32,' || return
    : >"$at.bad"
    fps=$(field "$at.txt" fps) late=$(late "$at.txt")
    [ "$fps $late" = '30.0 0/32' ] || echo "$fps frames a second, late $late" >"$at.bad"
    field "$at.txt" problem >>"$at.bad"
    verdict "pico_${2:+$2_}by_the_clock" "$(head -3 "$at.bad" | tr '\n' ' ')"
}

set_up
[ "$only" = set-up ] && exit 0
if [ "$only" = sweep ]; then
    ask
    sweep
    emulate
    sweep
    exit $failed
fi
if [ "$only" = profile ]; then
    for scene in $SCENES; do
        image pico APP=show SCENE="$scene"
        echo "$scene: cycles of drawing a frame by function, callees not counted (emulated RP2040)"
        node "$out/run.mjs" "$fw/$scene" --frames $FRAMES --step $STEP --profile 40 >"$out/profile.txt" || exit 1
        sed -n 's/^function //p' "$out/profile.txt" | awk '{ printf "%10d  %s\n", $2, $1 }'
    done
    exit 0
fi
if [ "$only" = cores ]; then
    SCENES=
fi
if [ -n "$SCENES" ] && [ -n "$only" ]; then
    [ -n "${PICO_SCENES:-}" ] || SCENES="$SCENES $PIECES"
    SCENES_2=$(for scene in $SCENES; do ! grep -q "SIZES_2_$scene " firmware/scenes/sizes.h || echo "$scene"; done)
fi
all() {
    for scene in $SCENES; do
        run_scene "$scene"
    done
    for scene in $SCENES_2; do
        run_scene "$scene-2"
    done
    for scene in $SCENES; do
        run_gaps "$scene"
    done
    for scene in $SCENES_2; do
        run_gaps "$scene-2"
    done
    emulated 1 "$out/cache.txt" cache.mjs
    case $only in
    '') tests ;;
    cores) two_cores ;;
    esac
}
tests() {
    [ -n "$asking" ] ||
        for scene in $SCENES; do
            scene_tests "$scene"
        done
    if emulated 1 "$out/image.txt" image.mjs "$fw/${SCENES%% *}"; then
        tests_of pico_image "$out/image.txt" 4
        grep -v '^miss' "$out/cache.txt" >"$out/cache.tests"
        tests_of pico_cache "$out/cache.tests" 6
        verdict pico_no_float_no_heap "$(arm-none-eabi-nm --plugin= "$fw/${SCENES%% *}.elf" |
            grep -oE '__aeabi_[cdf][a-z]*[0-9]?[a-z]*$|(m|c|re)alloc$|_sbrk$' | grep -vE 'clz|ctz' | tr '\n' ' ')"
    fi
    as_asked
    turned
    by_the_clock 1
    parts
    sweep
    wakes_up
    broken_strip stopped_strip --hold 2.1
    broken_strip stopped_tail --hold 2.2 --tail 1
    two_cores
}
ask
all
emulate
all
[ "$only" != cores ] || exit $failed
: >"$out/table.txt"
table_head
for scene in $SCENES; do
    table_row "$scene"
done
[ -z "$SCENES_2" ] || table_2_head
for scene in $SCENES_2; do
    table_2_row "$scene"
done
table_foot
exit $failed
