#!/bin/sh
# The micro:bit's flash images in QEMU, which has its core, memories, timers and UART but no SPI: the panel's wire goes
# over the UART (PANEL_ON_UART). What the panel shows, frame by frame, is what the simulator draws; RAM and stack hold.
# Usage: tests/boards/microbit.sh BUILD   from the repository's top; BUILD/zsim, BUILD/gen
#
# Leaves BUILD/microbit/table.txt: microbit SCENE FLASH RAM STACK INSTRUCTIONS, of drawing a frame, without the panel.
# Flash and RAM are those of the image with SPI, stack and instructions those of the one that runs here.
# The image with SPI, which is what is flashed, is seen by the registers that it reads and writes (spi_log.mjs). What
# pins and clocks do, no emulator here can tell.
set -u
build=$1
out=$build/microbit
fw=$build/fw/microbit
SCENES=${MICROBIT_SCENES:-'cubes teapot hall'} # cubes among them; there are china knot flyover city globe too
FRAMES=4 # of the scenes of table.sh, and of the image that is flashed
STEP=13
RAM=16384
rm -rf "$out"
. tests/boards/image.sh

# Boot ELF until OUT, what its UART says, holds a line with UNTIL; the high bytes of text words do not count.
#   boot ELF OUT UNTIL [QEMU-OPTIONS...]
boot() {
    elf=$1 serial=$2 until=$3
    shift 3
    qemu-system-arm -M microbit -display none -monitor none -serial "file:$serial" -kernel "$elf" "$@" \
        2>"$out/qemu.txt" &
    qemu=$!
    left=200
    while [ $left -gt 0 ] && kill -0 $qemu 2>/dev/null; do
        sleep 0.3 # asleep, it takes no time of a processor
        left=$((left - 1))
        [ -s "$serial" ] && tr -d '\020' <"$serial" | grep -aq "$until" &&
            [ -z "$(tail -c 2 "$serial" | tr -d '\020' | tail -c 1)" ] && break
    done
    kill $qemu 2>/dev/null
    wait $qemu 2>/dev/null
    [ $left -gt 0 ] || echo "after a minute it had not said $until"
}

# ---- Pictures -----------------------------------------------------------------------------------------------------

# The same over the UART, beside the one that is flashed: MAKE-ARGUMENTS...   as $fw-uart/NAME.elf
# Its glass is smaller, as the driver blackens all of it and each byte takes its time; the image that is flashed has its
# own (spi).
uart_image() {
    image microbit OUT="$fw-uart" DEFINES='-DPANEL_ON_UART=1 -DSHOW_PANEL=panel_st7789 -DSHOW_INVERT=1 -DSHOW_BGR=0
        -DSHOW_GLASS_WIDTH=135 -DSHOW_GLASS_HEIGHT=240 -DSHOW_X=40 -DSHOW_Y=3' "$@"
}
glass_uart() {
    panel='st7789:135x240 --invert' glass=240x135 x=40 y=3
}
glass_spi() {
    panel='ili9341:240x320 --bgr' glass=320x240 x=80 y=56
}
glass_uart

# Draw frames of ELF's scene and decode what the panel got: STEM ELF SCENE FRAMES
frames() {
    boot "$2" "$1.stream" "$3,$(($4 - 1))," -icount shift=0
    decode "$1" "$4"
}
decode() { # STEM FRAMES   its .stream to STEM_N.bin, .png
    node tests/boards/frame_marks.mjs "$1.stream" "$1.marked" "$2" 2>&1 | grep '^Error'
    # shellcheck disable=SC2086
    "$build/zsim" panel --panel $panel --rotate 90 --decode "$1.marked" --out "$1_%d.png" \
        --raw "$1_%d.bin" >"$1.txt" 2>&1 || echo "the panel would not have understood it: $(tail -1 "$1.txt")"
    grep '^text #' "$1.txt"
}
# STEM TRUTH SCENE FRAMES
same() {
    stem=$1 truth=$2 scene=$3 n=$4 k=0
    set --
    while [ $k -lt "$n" ]; do
        set -- "$@" "${stem}_$k.bin" "$(printf '%s/%s_%03d.bin' "$truth" "$scene" $((k * STEP)))"
        k=$((k + 1))
    done
    node tests/boards/inside.mjs $glass 160x128 $x $y "$@" 2>&1
}
frames_of() { # SCENE METHOD   a picture, and one after it, where no table wants more
    case $1$2 in cubes | teapot) echo $FRAMES ;; *) echo 2 ;; esac
}
reasons() { # FILE    on a line, the first ones
    head -3 "$1" | tr '\n' ' '
}

# Sizes, and stack of an image that has run, into the table: SCENE STEM ELF FLASH RAM [METHOD]
figures() {
    last=$(sed -n "s/^text $1,//p" "$2.txt" | tail -1)
    used=${last##*,} draw=$(echo "$last" | cut -d, -f3)
    reserve=$(arm-none-eabi-size -A "$3" | awk '$1 == ".stack" { print $2 }')
    [ "${used:-0}" -gt 0 ] && [ "$used" -lt $((reserve * 3 / 4)) ] ||
        bad "microbit_$1${6:+_$6}_stack" "$used of $reserve bytes, more than three quarters"
    [ "$5" -le $RAM ] || bad "microbit_$1${6:+_$6}_ram" "$5 of $RAM bytes"
    echo "microbit $1${6:+_$6} $4 $5 $used ${draw}000" >>"$out/table.txt"
}

scene_tests() { # SCENE [METHOD]
    name=$1${2:+_$2}
    image microbit APP=show SCENE="$1" METHOD="${2:-}"
    flashed=$(sizes)
    uart_image APP=show SCENE="$1" METHOD="${2:-}"
    count=$(frames_of "$1" "${2:-}")
    truth "$out/truth${2:-}" "$1" "$count" $STEP --size 160x128 --subpixel 4 ${2:+--method $2}
    stops_after "$fw-uart/$name.elf" "$out/$name.elf" "$count" $STEP
    frames "$out/$name" "$out/$name.elf" "$1" "$count" >"$out/$name.bad"
    same "$out/$name" "$out/truth${2:-}" "$1" "$count" >>"$out/$name.bad"
    verdict "microbit_${name}_pictures" "$(reasons "$out/$name.bad")"
    # shellcheck disable=SC2086
    figures "$1" "$out/$name" "$fw-uart/$name.elf" $flashed "${2:-}"
}

pixel() { # FILE X Y    of 240 px wide RGB565
    od -An -tx1 -j $((2 * ($2 + 240 * $3))) -N 2 "$1" | tr -d ' \n'
}
# The scene to be changed: its background above, its floor below, the edge of the picture, and that it moves.
mine() {
    image microbit APP=show SCENE=mine
    flashed=$(sizes)
    uart_image APP=show SCENE=mine
    stops_after "$fw-uart/my_scene.elf" "$out/mine.elf" 2 $STEP
    frames "$out/mine" "$out/mine.elf" mine 2 >"$out/mine.bad"
    for at in 40,3,10e6 199,3,10e6 40,130,4a6b 199,130,4a6b 39,3,0000 200,130,0000; do
        got=$(pixel "$out/mine_1.bin" "$(echo $at | cut -d, -f1)" "$(echo $at | cut -d, -f2)")
        [ "$got" = "${at##*,}" ] || echo "pixel $at is $got" >>"$out/mine.bad"
    done
    cmp -s "$out/mine_0.bin" "$out/mine_1.bin" && echo "nothing moves" >>"$out/mine.bad"
    verdict microbit_mine_pictures "$(reasons "$out/mine.bad")"
    # shellcheck disable=SC2086
    figures mine "$out/mine" "$fw-uart/my_scene.elf" $flashed
}

# Pools that take many passes: of them the pictures above must not differ.
takes_passes() {
    passes=$(sed -n 's/^text hall,//p' "$out/hall.txt" | cut -d, -f7)
    [ "${passes:-0}" -gt 9 ] && ok "microbit_hall_takes_passes ($passes)" || bad microbit_hall_takes_passes "$passes"
}

# The comparison sees other sub-pixel bits, and a cube with one other colour.
sees_differences() {
    truth "$out/truth8" cubes $FRAMES $STEP --size 160x128 --subpixel 8
    same "$out/cubes" "$out/truth8" cubes $FRAMES >"$out/sees.txt"
    [ "$(grep -c 'pixels differ' "$out/sees.txt")" = $FRAMES ] && ok microbit_comparison_sees_subpixel_bits ||
        bad microbit_comparison_sees_subpixel_bits "$(reasons "$out/sees.txt")"
    stops_after "$fw-uart/cubes.elf" "$out/two.elf" 2 $STEP
    patch "$out/two.elf" "$out/flipped.elf" mesh_cube_face_rgb 0x01020304
    frames "$out/flipped" "$out/flipped.elf" cubes 2 >"$out/sees.txt"
    same "$out/flipped" "$out/truth" cubes 2 >>"$out/sees.txt"
    [ "$(grep -c 'pixels differ' "$out/sees.txt")" = 2 ] && ok microbit_comparison_sees_a_colour ||
        bad microbit_comparison_sees_a_colour "$(reasons "$out/sees.txt")"
}

# ---- The HAL ------------------------------------------------------------------------------------------------

# microbit.c, hours of it: with sleep=off, time in which the core sleeps passes at once.
parts() {
    uart_image NAME=parts APP_SRC=tests/boards/microbit.c
    boot "$fw-uart/parts.elf" "$out/parts.stream" 'hard fault' -icount shift=0,sleep=off
    "$build/zsim" panel --panel st7789:240x240 --decode "$out/parts.stream" --out "$out/parts.png" \
        >"$out/parts.txt" 2>&1
    sed -nE 's/^text ((ok|FAILED) .*)/\1/p' "$out/parts.txt"
    grep -q '^text FAILED ' "$out/parts.txt" && failed=1
    [ "$(grep -c '^text ok ' "$out/parts.txt")" = 9 ] || bad microbit_parts "not all of them ran"
    grep -q '^text too early' "$out/parts.txt" && bad microbit_parts "text before hal_init"
    grep -qx 'text microbit: hard fault' "$out/parts.txt" && ok microbit_says_hard_fault ||
        bad microbit_says_hard_fault "no such line"
    wire=$(od -An -v -tx2 -w2 "$out/parts.stream" | grep -v ' 10' | tr -d '\n')
    [ "$wire" = ' 0200 002c 0800 0036 0111 0122 0800 0111 0122 0133 0144 0155 0166 0800 0122 0800' ] &&
        ok microbit_words_of_the_wire || bad microbit_words_of_the_wire "$wire"
}

# What is flashed: the registers of SPI and pins, told by QEMU, give the same picture.
spi() {
    image microbit APP=show SCENE=cubes
    stops_after "$fw/cubes.elf" "$out/spi.elf" $FRAMES $STEP
    boot "$out/spi.elf" "$out/spi.said" "cubes,$((FRAMES - 1))," -icount shift=0 \
        -d unimp -trace nrf51_gpio_write -trace nrf51_uart_write -D "$out/spi.log" >"$out/spi.bad"
    node tests/boards/spi_log.mjs "$out/spi.log" "$out/spi.stream" 2>&1 | grep -E '^(Error|problem)' >>"$out/spi.bad"
    rm -f "$out/spi.log" # 50 MB
    glass_spi
    decode "$out/spi" $FRAMES >>"$out/spi.bad"
    same "$out/spi" "$out/truth" cubes $FRAMES >>"$out/spi.bad"
    glass_uart
    sed -n 's/^text //p' "$out/spi.txt" | cmp -s - "$out/spi.said" || echo "the UART says otherwise" >>"$out/spi.bad"
    verdict microbit_spi_pictures "$(reasons "$out/spi.bad")"
    [ -s "$fw/cubes.hex" ] && ok microbit_hex || bad microbit_hex "there is none"
}

# At SPI1 nothing answers: the time-out is told, not waited for for ever.
silent_spi() {
    image microbit APP=show SCENE=cubes DEFINES=-DSPI_INSTANCE=1 OUT="$fw-spi1"
    boot "$fw-spi1/cubes.elf" "$out/silent.said" ' in its time' -icount shift=0 >"$out/silent.bad"
    [ "$(sed -n 1p "$out/silent.said")" = '# the bus did not end in its time' ] ||
        echo "it says: $(sed -n 1p "$out/silent.said")" >>"$out/silent.bad"
    verdict microbit_says_that_no_spi_answers "$(reasons "$out/silent.bad")"
}

for scene in $SCENES; do
    scene_tests "$scene"
done
# Without depth keys: 8 rows of 160 of them are 2,560 bytes.
for method in painter depthsort coverage; do
    scene_tests cubes $method
done
mine
takes_passes
sees_differences
parts
silent_spi
spi
sed 's/^/note /' "$out/table.txt"
exit $failed
