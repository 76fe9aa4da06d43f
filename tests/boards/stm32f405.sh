#!/bin/sh
# The STM32F405's images on QEMU's netduinoplus2, whose every write to a register is followed (mmio.mjs): what its panel
# shows is what the simulator draws. QEMU has no DMA: pictures come from images with -DSPI_DMA=0; of the image that is
# flashed, what it tells the DMA, and that it does not hang where that never ends.
# Usage: tests/boards/stm32f405.sh BUILD   from the repository's top; BUILD/zsim and BUILD/gen
#
# SPDX-License-Identifier: MIT
set -u
build=$1
out=$build/stm32f405
fw=$build/fw/stm32f405
. tests/boards/image.sh

STEP=13 # frames of the animation between two that are drawn

# STEM MMIO-OPTIONS...   run STEM.elf, leaving STEM.txt
run() {
    at=$1
    shift
    node tests/boards/mmio.mjs "$at.elf" "$@" >"$at.txt" 2>&1
}

# STEM PANEL ZSIM-OPTIONS...   what is seen on the glass, as STEM_N.bin and .png
decode() {
    at=$1 panel=$2
    shift 2
    rm -f "$at"_*.bin "$at"_*.png
    "$build/zsim" panel --panel "$panel" "$@" --decode "$at.stream" --out "${at}_%d.png" --raw "${at}_%d.bin" \
        >"$at.panel.txt" 2>&1 || echo "the panel would not have understood it: $(tail -1 "$at.panel.txt")"
}

# STEM SCENE FRAMES   say which of the pictures are not the simulator's
same() {
    k=0
    while [ $k -lt "$3" ]; do
        cmp -s "$1_$k.bin" "$out/truth/$2_$(printf %03d $((k * STEP))).bin" || echo "picture $k differs: $1_$k.png"
        k=$((k + 1))
    done
    [ -e "$1_$k.bin" ] && echo "more than $3 pictures"
}

# STEM EXPECTED   lines that STEM.txt must have, in this order, and no others of the same names
says() {
    echo "$2" | sed 's/ .*//' | sort -u >"$1.names"
    [ "$(grep -wFf "$1.names" "$1.txt" | grep -v '^text')" = "$2" ] ||
        echo "not '$(echo "$2" | tr '\n' ' ')' but '$(grep -wFf "$1.names" "$1.txt" | tr '\n' ' ')'"
}

# The first error, where there are some: FILE
first() { head -3 "$1" | tr '\n' ' '; }

# ---- Pictures -----------------------------------------------------------------------------------------------

# Instructions a frame: the show believes its clocks, which say 16 MHz, as no PLL locks here; QEMU's SysTick counts
# 168 MHz. So a us of the show is 16 ticks, each of 1000/168 virtual ns, and -icount shift=0 gives an instruction one.
# Stack and microseconds stand in the show's line.
table_row() { # SCENE FLASH RAM
    sed -n "s/^text $1,//p" "$out/$1.txt" | awk -F, -v scene="$1" -v flash="$2" -v ram="$3" '
        { printf "stm32f405 %s %d %d %d %d\n", scene, flash, ram, $8, $3 * 16 * 1000 / 168 }'
}

pictures() { # SCENE FRAMES
    image stm32f405 APP=show SCENE="$1"
    flashed=$(sizes)
    image stm32f405 APP=show SCENE="$1" DEFINES=-DSPI_DMA=0 OUT="$fw-polled"
    stops_after "$fw-polled/$1.elf" "$out/$1.elf" "$2" $STEP
    truth "$out/truth" "$1" "$2" $STEP
    run "$out/$1" --until "$1," --frame 115200 --stream "$out/$1.stream"
    {
        decode "$out/$1" st7789:240x240 --invert
        same "$out/$1" "$1" "$2"
        grep -E '^(problem|text #)' "$out/$1.txt"
        says "$out/$1" 'backlight 255
spi_divider 2
spi_mode 0
pll_hz 168000000
apb1_hz 42000000
apb2_hz 84000000
wait_states 5
caches 7'
    } >"$out/$1.bad"
    verdict "stm32f405_$1_pictures" "$(first "$out/$1.bad")"
    # shellcheck disable=SC2086
    table_row "$1" $flashed >>"$out/table.txt"
}

# Another panel, turned, by a slower wire in mode 3.
turned() {
    image stm32f405 APP=show SCENE=cubes OUT="$fw-turned" DEFINES='-DSPI_DMA=0 -DSPI_DIVIDER=4 -DSPI_MODE=3
        -DSHOW_PANEL=panel_ili9341 -DSHOW_WIDTH=320 -DSHOW_HEIGHT=240 -DSHOW_ROTATE=1 -DSHOW_INVERT=0 -DSHOW_BGR=1'
    stops_after "$fw-turned/cubes.elf" "$out/turned.elf" 2 $STEP
    truth "$out/truth" cubes 2 $STEP --size 320x240
    run "$out/turned" --until cubes, --frame 153600 --stream "$out/turned.stream"
    {
        decode "$out/turned" ili9341:240x320 --rotate 90 --bgr
        same "$out/turned" cubes 2
        grep -E '^(problem|text #)' "$out/turned.txt"
        says "$out/turned" 'spi_divider 4
spi_mode 3'
    } >"$out/turned.bad"
    verdict stm32f405_ili9341_turned "$(first "$out/turned.bad")"
}

# After pictures cubes: one byte of the driver's data (COLMOD) is another.
control() {
    stops_after "$fw-polled/cubes.elf" "$out/right.elf" 2 $STEP
    LC_ALL=C sed 's/\x02\x3a\x55\x01\x13/\x02\x3a\x66\x01\x13/' "$out/right.elf" >"$out/flipped.elf"
    cmp -s "$out/right.elf" "$out/flipped.elf" && bad stm32f405_flipped_byte 'there is none to flip'
    run "$out/flipped" --until cubes, --frame 115200 --stream "$out/flipped.stream"
    decode "$out/flipped" st7789:240x240 --invert >"$out/flipped.bad"
    same "$out/flipped" cubes 2 >>"$out/flipped.bad"
    [ "$(grep -c differs "$out/flipped.bad")" = 2 ] && ok stm32f405_flipped_byte_is_seen ||
        bad stm32f405_flipped_byte_is_seen 'a picture is the same'
}

# ---- The DMA ---------------------------------------------------------------------------------------------------

# The image that is flashed: the driver's black, 128 bytes of flash, is asked for by the book; the DMA never ends, which
# is said, tried again from RESET on, and said again.
no_dma() {
    cp "$fw/cubes.elf" "$out/no_dma.elf"
    run "$out/no_dma" --until '# the bus did not end in its time
# the bus did not end in its time'
    black=$(arm-none-eabi-nm --plugin= "$out/no_dma.elf" |
        sed -n 's/^\([0-9a-f]*\) [rt] black\..*/0x\1/p' | sed 's/0x0*/0x/')
    {
        grep '^problem' "$out/no_dma.txt"
        [ "$(grep -c '^text' "$out/no_dma.txt")" = 2 ] || grep '^text' "$out/no_dma.txt"
        says "$out/no_dma" "spi_resets 3
spi_divider 2
deadline_us $((1000 + 128 * 32 / 16))
dma $black 128 asked
dma $black 128 asked"
    } >"$out/no_dma.bad"
    verdict stm32f405_dma_that_never_ends "$(first "$out/no_dma.bad")"
}

# The bus's own test, with a DMA of its own. On its wire: a byte with c where D/C is low, | where CS rises; the long
# transfer, which the test itself compares, by its length. --reads: no pin of the panel moves before SPI1 was asked
# whether it is busy.
parts() {
    image stm32f405 NAME=parts APP_SRC=tests/boards/stm32f405.c OUT="$fw-parts" DEFINES=-DDMA2=0x2001f000u
    cp "$fw-parts/parts.elf" "$out/parts.elf"
    run "$out/parts" --until 'the end' --reads 1 --stream "$out/parts.stream"
    sed -nE 's/^text ((ok|FAILED) )/\1/p' "$out/parts.txt"
    grep -q '^text FAILED ' "$out/parts.txt" && failed=1
    [ "$(grep -c '^text ok ' "$out/parts.txt")" = 13 ] || bad stm32f405_parts 'not all of them passed'
    wire='c2c | c36 81 00 fe | 11 22 33 44 55 | 11 | | | | 11 22 33 | 11 22 | 11 22 | 11 22 |'
    words=$(echo "$wire" | wc -w)
    {
        grep '^problem' "$out/parts.txt"
        is=$(od -An -v -tx2 -w2 -N $((2 * words)) "$out/parts.stream" |
            sed 's/ 00/ c/; s/ 01/ /; s/ 0800/ |/' | tr -d '\n')
        [ "$is" = " $wire" ] || echo "$is"
        [ "$(wc -c <"$out/parts.stream")" = $((2 * (words + 70001))) ] || echo 'not 70000 bytes after that'
    } >"$out/parts.bad"
    verdict stm32f405_wire "$(first "$out/parts.bad")"
}

: >"$out/table.txt"
pictures cubes 3
control
pictures teapot 2
turned
no_dma
parts
cat "$out/table.txt"
exit $failed
