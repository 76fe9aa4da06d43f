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
    [ ! -f "$out/truth" ] || rm "$out/truth" # of an older tree; a folder now
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

# Run SCENE[-2] without gaps, recorded; and beside it with them: in the tests those of $SCENES_2 alone, as gaps are the
# wire's. For the table once more, with gaps and a flash that takes its time. -2: the image for both cores.
image_of() {
    case $1 in *-2) echo "$fw-2/${1%-2}" ;; *) echo "$fw/$1" ;; esac
}
frames_of() { # SCENE[-2]
    case $only/$1 in /cubes*) echo $FRAMES ;; /*) echo $FRAMES_FEW ;; *) echo $FRAMES ;; esac
}
run_scene() {
    n=$(frames_of "$1")
    node "$out/run.mjs" "$(image_of "$1")" --frames "$n" --step $STEP --stream "$out/$1.stream" >"$out/$1.txt" 2>&1 &
    first=$!
    second=0
    : >"$out/$1.gap.txt"
    case "$only/ $SCENES_2 " in
    ?*/* | */*" ${1%-2} "*)
        node "$out/run.mjs" "$(image_of "$1")" --frames "$n" --step $STEP --gap $GAP >"$out/$1.gap.txt" 2>&1
        second=$? ;;
    esac
    : >"$out/$1.xip.txt"
    if [ -n "$only" ] && [ $second -eq 0 ]; then
        node "$out/run.mjs" "$(image_of "$1")" --frames "$n" --step $STEP --gap $GAP --xip 1 >"$out/$1.xip.txt" 2>&1
        second=$?
    fi
    wait $first && [ $second -eq 0 ] ||
        bad "pico_$1" "$(grep -hm1 Error "$out/$1.txt" "$out/$1.gap.txt" "$out/$1.xip.txt")"
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
    miss=$(node "$out/cache.mjs" cycles)
    echo "Emulated (rp2040js): no bus contention, so that cycles are a lower bound; draw cycles and the first fps"
    echo "are of a flash without wait states. +$GAP ns: with that pause after each 16-bit word, as real chips make"
    echo "in SPI mode 0. +flash: with pauses and a flash that takes $miss cycles for each word that its cache"
    echo "lacks; misses: of these, in drawing a frame. strip us: drawing the slowest strip, without those waits;"
    echo "its wire: a strip of pixels on the wire. hidden: the share of drawing (core 0's) that went on while the"
    echo "wire was busy. late: frames that took longer than the scene's step. gain: fps by those of one core. Two"
    echo "cores: what they wait for each other at a bank of RAM or at the flash is not counted."
}

# ---- Tests -------------------------------------------------------------------------------------------------

parts() {
    twin=$out/twin
    mkdir -p "$twin"
    libgcc=$(arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -print-libgcc-file-name)
    for member in _udivsi3.o _divsi3.o; do
        arm-none-eabi-ar p "$libgcc" $member >"$twin/$member" &&
            arm-none-eabi-objcopy --prefix-symbols=libgcc_ "$twin/$member" || bad pico_twin "no $member in libgcc"
    done
    image pico NAME=parts APP_SRC=tests/boards/pico/parts.c EXTRA="$twin/_udivsi3.o $twin/_divsi3.o"
    node "$out/parts.mjs" "$fw/parts" >"$out/parts.txt" 2>&1 || bad pico_parts "$(grep -m1 Error "$out/parts.txt")"
    grep -E '^(ok|FAILED) ' "$out/parts.txt"
    grep -q '^FAILED ' "$out/parts.txt" && failed=1
    [ "$(grep -cE '^ok ' "$out/parts.txt")" = 8 ] || bad pico_parts "not all of them ran"
    wire='c2c | c36 81 00 fe | 11 22 33 44 55 66 | 11 22 33 44 55 | 22 33 44 55 | 11 |'
    [ "$(field "$out/parts.txt" wire)" = "$wire" ] || bad pico_wire "$(field "$out/parts.txt" wire)"
    verdict pico_parts_without_problems "$(field "$out/parts.txt" problem)"
}

# A strip whose words stop, at once or just before its last ones: said so, the rest of the frame is dropped, and
# all other frames are right.
broken_strip() { # NAME OPTIONS...
    name=$1
    shift
    stem=$out/$name
    node "$out/run.mjs" "$fw/cubes" --frames $FRAMES --step $STEP --stream "$stem.stream" "$@" >"$stem.txt" 2>&1
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
    timeout 60 node "$out/run.mjs" "$fw-2/cubes" --frames "$n" --step $STEP --stream "$stem.stream" "$@" \
        >"$stem.txt" 2>&1
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
    sed -n 's/^#define SIZES_2_\([a-z]*\) .*/\1/p' firmware/scenes/sizes.h >"$out/scenes_2.txt"
    while read -r of; do
        make -s -f firmware/boards/firmware.mk BOARD=pico B="$build" APP=show SCENE="$of" CORES=2 image \
            >"$out/fits.log" 2>&1 || echo "$of: $(grep -o 'overflowed by.*' "$out/fits.log" || tail -1 "$out/fits.log")"
    done <"$out/scenes_2.txt" >"$out/fits.bad"
    [ "$(wc -l <"$out/scenes_2.txt")" -ge 9 ] || echo "scenes are missing in sizes.h" >>"$out/fits.bad"
    verdict pico_images_for_both_cores_fit "$(tr '\n' ' ' <"$out/fits.bad")"
}

two_cores() {
    for of in $SCENES_2; do
        scene_tests "$of-2"
    done
    fits_twice
    image pico APP=show SCENE=mine CORES=2
    by_the_clock second
    image pico NAME=second APP_SRC=tests/boards/pico/second.c CORES=2
    timeout 60 node "$out/parts.mjs" "$fw-2/second" >"$out/second.txt" 2>&1 ||
        bad pico_second "$(grep -m1 Error "$out/second.txt")"
    grep -E '^(ok|FAILED) ' "$out/second.txt" | sed 's/ / pico_/'
    grep -q '^FAILED ' "$out/second.txt" && failed=1
    [ "$(grep -cE '^(ok|FAILED) ' "$out/second.txt")" = 7 ] || bad pico_second "not all of them ran"
    verdict pico_second_without_problems "$(field "$out/second.txt" problem)"
    goes_wrong second_absent 'core 1 does not answer: core 0 draws alone' 4 '0 1 2 3' --second dead
    cmp -s "$out/second_absent.stream" "$out/cubes-2.stream" && ok pico_second_same_wire ||
        bad pico_second_same_wire "what leaves is not what core 0 alone sends"
    goes_wrong second_garbled '' 4 '0 1 2 3' --second garble
    goes_wrong second_wakes_up '' 4 '0 1 2 3' --doze 4000000
    goes_wrong second_stops 'core 1 stopped: core 0 draws alone' 5 '0 1 4' --stop 2.5
    goes_wrong second_stopped_strip 'the bus did not end in its time' 5 '0 1 3 4' --hold 2.1
    goes_wrong second_refused 'a required pointer is NULL' 5 '0 1 3 4' --refuse 2
    goes_wrong second_stopped_tail 'the bus did not end in its time' 5 '0 1 4' --hold 2.6 --tail 1
    # what leaves ends in a command without its arguments: of no use to a decoder
    timeout 60 node "$out/run.mjs" "$fw-2/cubes" --frames 5 --step $STEP --hold 2.3 --head 1 >"$out/command.txt" 2>&1
    [ "$(field "$out/command.txt" frames) $(field "$out/command.txt" text | grep '^#')" = \
        '5 # the bus did not end in its time' ] && ok pico_second_stopped_command ||
        bad pico_second_stopped_command "$(field "$out/command.txt" text | tail -1)"
    node "$out/run.mjs" "$fw-2/cubes" --frames 4 --step $STEP --fault 1.3 >"$out/fault.txt" 2>&1
    [ "$(field "$out/fault.txt" text | tail -1)" = 'pico: hard fault on core 1' ] && ok pico_second_faults ||
        bad pico_second_faults "$(tail -1 "$out/fault.txt")"
}

# Interrupts at each instruction of a transfer, and the timer's wrap at each moment.
sweep() {
    image pico NAME=sweep APP_SRC=tests/boards/pico/sweep.c
    node "$out/sweep.mjs" "$fw/sweep" >"$out/sweep.txt" 2>&1 || bad pico_sweep "$(grep -m1 Error "$out/sweep.txt")"
    grep -E '^(ok|FAILED) ' "$out/sweep.txt"
    grep -q '^FAILED ' "$out/sweep.txt" && failed=1
    [ "$(grep -cE '^(ok|FAILED) ' "$out/sweep.txt")" = 6 ] || bad pico_sweep "not all of them ran"
    # 220 rounds of a kind; of each, those without a hook end asleep
    awk '$1 == "swept" && ($3 < 220 || $2 == 5 && $3 < 302 || $2 < 4 && ($4 < 40 || $4 > 180)) { print }' \
        "$out/sweep.txt" >"$out/sweep.bad"
    field "$out/sweep.txt" problem >>"$out/sweep.bad"
    verdict pico_sweep_without_problems "$(head -3 "$out/sweep.bad" | tr '\n' ' ')"
}

# The interrupt that is waited for comes between the question and the sleep: no wake-up is lost.
wakes_up() {
    node "$out/run.mjs" "$fw/cubes" --frames $FRAMES --step $STEP --doze 4000000 --stream "$out/doze.stream" \
        >"$out/doze.txt" 2>&1
    decode "$out/doze" >"$out/doze.bad"
    same "$out/doze" cubes 0 1 2 3 >>"$out/doze.bad"
    field "$out/doze.txt" problem >>"$out/doze.bad"
    grep -m1 Error "$out/doze.txt" >>"$out/doze.bad"
    verdict pico_wakes_up "$(head -3 "$out/doze.bad" | tr '\n' ' ')"
}

# The image is that of the scene and the settings that were asked for last, whatever was built before under its name.
# Leaves my_scene's.
as_asked() {
    : >"$out/asked.bad"
    image pico APP=show SCENE=mine
    cp "$fw/my_scene.uf2" "$out/mine.uf2"
    sed 's/^#define FRAMES 90u/#define FRAMES 91u/' firmware/app/my_scene.c >"$out/my_scene.c"
    image pico APP=show APP_SCENE="$out/my_scene.c"
    cmp -s "$fw/my_scene.uf2" "$out/mine.uf2" && echo "another file of the same name is not built" >>"$out/asked.bad"
    image pico APP=show SCENE=mine
    cmp -s "$fw/my_scene.uf2" "$out/mine.uf2" || echo "not my_scene.c's after another's" >>"$out/asked.bad"
    image pico APP=show SCENE=mine DEFINES=-DPIN_RESET=14
    cmp -s "$fw/my_scene.uf2" "$out/mine.uf2" && echo "DEFINES change nothing" >>"$out/asked.bad"
    image pico APP=show SCENE=mine
    cmp -s "$fw/my_scene.uf2" "$out/mine.uf2" || echo "DEFINES stay" >>"$out/asked.bad"
    verdict pico_image_is_as_asked "$(tr '\n' ' ' <"$out/asked.bad")"
}

# Glass that is not square, turned: all of the picture arrives, background in its corners and something in its middle.
turned() {
    image pico APP=show SCENE=mine DEFINES='-DSHOW_WIDTH=240 -DSHOW_HEIGHT=135 -DSHOW_ROTATE=1'
    rm -f "$out/turned_0.bin"
    : >"$out/turned.bad"
    node "$out/run.mjs" "$fw/my_scene" --frames 1 --stream "$out/turned.stream" >"$out/turned.txt" 2>&1
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

# As it runs on a desk: 32 frames of the scene to be changed, at its 30 a second, none late: [second]
by_the_clock() {
    node "$out/run.mjs" "$fw$([ $# = 0 ] || echo -2)/my_scene" --until 'mine,32,' >"$out/clock.txt" 2>&1
    : >"$out/clock.bad"
    fps=$(field "$out/clock.txt" fps) late=$(late "$out/clock.txt")
    [ "$fps $late" = '30.0 0/32' ] || echo "$fps frames a second, late $late" >"$out/clock.bad"
    field "$out/clock.txt" problem >>"$out/clock.bad"
    verdict "pico_${1:+$1_}by_the_clock" "$(head -3 "$out/clock.bad" | tr '\n' ' ')"
}

set_up
[ "$only" = set-up ] && exit 0
if [ "$only" = sweep ]; then
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
    for scene in $SCENES_2; do
        image pico APP=show SCENE="$scene" CORES=2
        run_scene "$scene-2"
    done
    two_cores
    exit $failed
fi
if [ -n "$only" ]; then
    [ -n "${PICO_SCENES:-}" ] || SCENES="$SCENES $PIECES"
    SCENES_2=$(for scene in $SCENES; do ! grep -q "SIZES_2_$scene " firmware/scenes/sizes.h || echo "$scene"; done)
fi
for scene in $SCENES; do
    image pico APP=show SCENE="$scene"
    run_scene "$scene"
done
for scene in $SCENES_2; do
    image pico APP=show SCENE="$scene" CORES=2
    run_scene "$scene-2"
done
if [ -z "$only" ]; then
    for scene in $SCENES; do
        scene_tests "$scene"
    done
    node "$out/image.mjs" "$fw/${SCENES%% *}" >"$out/image.txt" 2>&1
    grep -E '^(ok|FAILED) ' "$out/image.txt"
    node "$out/cache.mjs" >"$out/cache.txt" 2>&1
    grep -E '^(ok|FAILED) ' "$out/cache.txt"
    [ "$(grep -cE '^ok ' "$out/cache.txt")" = 6 ] || failed=1
    [ "$(grep -cE '^ok ' "$out/image.txt")" = 4 ] || failed=1
    verdict pico_no_float_no_heap "$(arm-none-eabi-nm --plugin= "$fw/${SCENES%% *}.elf" |
        grep -oE '__aeabi_[cdf][a-z]*[0-9]?[a-z]*$|(m|c|re)alloc$|_sbrk$' | grep -vE 'clz|ctz' | tr '\n' ' ')"
    turned
    as_asked
    by_the_clock
    parts
    sweep
    wakes_up
    broken_strip stopped_strip --hold 2.1
    broken_strip stopped_tail --hold 2.2 --tail 1
    two_cores
fi
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
