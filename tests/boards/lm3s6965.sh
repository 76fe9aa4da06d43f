#!/bin/sh
# The LM3S6965EVB's flash images in QEMU, which draws the board's OLED by a model of its own: what it shows, frame by
# frame, is what the simulator draws.
# Usage: tests/boards/lm3s6965.sh BUILD   from the repository's top; BUILD/zsim, BUILD/gen
#
# Leaves BUILD/lm3s6965/table.txt: lm3s6965 SCENE FLASH RAM STACK INSTRUCTIONS, of drawing a frame, without the panel.
# QEMU's model has the SSD0323's windows, its two directions of addresses and its commands' lengths. It takes and
# ignores A0h's mirrors and splits, offset, inversion, contrast, on and off, power and timing: those are the panel
# model's matter (tests/unit/test_panel_model.c). Its SSI0 and UART0 have no speed, and no pin but D/C and the card's
# select reaches the panel.
set -u
build=$1
out=$build/lm3s6965
fw=$build/fw/lm3s6965
SCENES='teapot china cubes knot flyover city hall globe'
FRAMES=4 # of the scenes of table.sh; of others a picture, and one after it
STEP=13
RAM=65536
shift=0 # an instruction takes 2^shift ns
. tests/boards/image.sh

# Boot ELF's image: STEM ELF OPTIONS-OF-QEMU.MJS...   What QEMU says of what it lacks is known, and how often: of a
# SysTick without clock once, before the first instruction; of $resets resets of a block, into one and out of it each
# time that the bus is set up. More or less of it, and all else, is trouble.
resets=2
boot() {
    stem=$1 elf=$2
    shift 2
    rm -f "$stem"_*
    arm-none-eabi-objcopy -O binary "$elf" "$stem.bin"
    node tests/boards/qemu.mjs "$stem" --elf "$elf" "$@" -- qemu-system-arm -M lm3s6965evb -icount shift=$shift \
        -d guest_errors,unimp -kernel "$stem.bin" >"$stem.log" 2>&1 ||
        head -1 "$stem.log"
    awk -v resets="$resets" '
        $0 == "Timer with period zero, disabling" { timers++; next }
        $0 == "Peripheral reset not implemented" { blocks++; next }
        { print }
        END { if (timers != 1 || blocks != resets)
                  print timers + 0 " timers without period, " blocks + 0 " resets, not 1 and " resets }
    ' "$stem.err"
    grep '^#' "$stem.txt"
}

# Frames at the end of each, with all of its bytes in the panel: STEM ELF SCENE FRAMES DEGREES
frames() {
    stops_after "$2" "$1.elf" "$4" $STEP
    boot "$1" "$1.elf" --break zs_frame_end --stops "$4" --until "^$3,$(($4 - 1))," --zoom 4 --rotate "$5"
}

# STEM TRUTH SCENE FRAMES
same() {
    for k in $(seq 0 $(($4 - 1))); do
        cmp -s "$1_$k.bin" "$2/$3_$(printf %03d $((k * STEP))).bin" || { echo "picture $k differs: $1_$k.png"; return; }
    done
}

# The last line of statistics: STEM SCENE FIELD
statistic() {
    sed -n "s/^$2,/$2,/p" "$1.txt" | tail -1 | cut -d, -f"$3"
}

scene_tests() { # SCENE
    case $1 in cubes | teapot) n=$FRAMES ;; *) n=2 ;; esac
    image lm3s6965 APP=show SCENE="$1"
    truth "$out/truth" "$1" $n $STEP --panel ssd0323:128x64
    frames "$out/$1" "$fw/$1.elf" "$1" $n 0 >"$out/$1.bad"
    same "$out/$1" "$out/truth" "$1" $n >>"$out/$1.bad"
    cmp -s "$out/$1_end.bin" "$out/$1_$((n - 1)).bin" || echo "the last picture did not stay" >>"$out/$1.bad"
    [ "$(head -1 "$out/$1.txt")" = 'scene,frames,frames/s,draw us,wire us,hidden %,late,passes,stack' ] ||
        echo "the text begins with $(head -1 "$out/$1.txt")" >>"$out/$1.bad"
    verdict "lm3s6965_$1_pictures" "$(head -3 "$out/$1.bad" | tr '\n' ' ')"
    used=$(statistic "$out/$1" "$1" 9)
    reserve=$(arm-none-eabi-size -A "$fw/$1.elf" | awk '$1 == ".stack" { print $2 }')
    [ "${used:-0}" -gt 0 ] && [ "$used" -lt $((reserve * 3 / 4)) ] ||
        bad "lm3s6965_$1_stack" "$used of $reserve bytes, more than three quarters"
    # shellcheck disable=SC2046
    set -- "$1" $(sizes)
    [ "$3" -lt $RAM ] || bad "lm3s6965_$1_ram" "$3 bytes"
    echo "lm3s6965 $1 $2 $3 $used $(statistic "$out/$1" "$1" 4)000" >>"$out/table.txt"
}

# Its pools are too small for one pass: the pictures above are the simulator's, whose pools suffice, all the same.
several_passes() {
    passes=$(statistic "$out/flyover" flyover 8)
    [ "$passes" -gt 1 ] && ok "lm3s6965_flyover_takes_passes ($passes)" || bad lm3s6965_flyover_takes_passes "$passes"
}

# One byte of the driver's set-up is another, A0h 56h for 52h: addresses run down columns.
wrong_byte() {
    patch "$fw/cubes.elf" "$out/wrong_one.elf" setup+8 0x00a10252
    cmp -s "$fw/cubes.elf" "$out/wrong_one.elf" || bad lm3s6965_wrong_byte "A0h is not where it was in the set-up"
    patch "$fw/cubes.elf" "$out/wrong_one.elf" setup+8 0x00a10256
    frames "$out/wrong" "$out/wrong_one.elf" cubes 2 0 >"$out/wrong.bad"
    verdict lm3s6965_wrong_byte_is_seen "$(
        cat "$out/wrong.bad"
        for k in 0 1; do
            cmp -s "$out/wrong_$k.bin" "$out/cubes_$k.bin" && echo "picture $k is the same"
            [ -f "$out/wrong_$k.bin" ] || echo "no picture $k"
        done)"
}

turned() { # QUARTERS DEFINES
    image lm3s6965 APP=show SCENE=cubes OUT="$fw-turned" DEFINES="-DSHOW_ROTATE=$1 ${2:-}"
    truth "$out/truth_turned_$1" cubes 2 $STEP --panel ssd0323:128x64 --rotate $((90 * $1))
    frames "$out/turned_$1" "$fw-turned/cubes.elf" cubes 2 $((90 * $1)) >"$out/turned_$1.bad"
    same "$out/turned_$1" "$out/truth_turned_$1" cubes 2 >>"$out/turned_$1.bad"
    verdict "lm3s6965_turned_$((90 * $1))" "$(head -3 "$out/turned_$1.bad" | tr '\n' ' ')"
}

# As it runs on a desk: the very image, about as quick as the part, 32 frames at the animation's 30 a second, none late.
# (The time to draw the last one counts: 29.9 or less.)
by_the_clock() {
    shift=4
    boot "$out/clock" "$fw/cubes.elf" --until '^cubes,32,' >"$out/clock.bad"
    shift=0
    cmp -s "$out/clock.bin" "$fw/cubes.bin" || echo "the image is not the ELF file's" >>"$out/clock.bad"
    case $(statistic "$out/clock" cubes 3)/$(statistic "$out/clock" cubes 7) in
    29.[5-9]/0) ;;
    *) tail -1 "$out/clock.txt" >>"$out/clock.bad" ;;
    esac
    verdict lm3s6965_by_the_clock "$(head -3 "$out/clock.bad" | tr '\n' ' ')"
}

bus() {
    image lm3s6965 NAME=bus APP_SRC=tests/boards/lm3s6965.c
    resets=4 # the bus is set up twice
    boot "$out/bus" "$fw/bus.elf" --until '^end' >"$out/bus.bad"
    resets=2
    grep -E '^(ok|FAILED) ' "$out/bus.txt"
    grep -q '^FAILED ' "$out/bus.txt" && failed=1
    [ "$(grep -c '^ok ' "$out/bus.txt")" = 7 ] || echo "not all parts ran" >>"$out/bus.bad"
    verdict lm3s6965_bus "$(head -3 "$out/bus.bad" | tr '\n' ' ')"
}

: >"$out/table.txt"
for scene in $SCENES; do
    scene_tests "$scene"
done
several_passes
wrong_byte
turned 2
turned 1 '-DSHOW_WIDTH=64 -DSHOW_HEIGHT=128'
by_the_clock
bus
echo
echo 'LM3S6965EVB in QEMU: bytes of flash, RAM and stack, and instructions of drawing a frame'
awk '{ printf "%-9s %8d %7d %6d %11d\n", $2, $3, $4, $5, $6 }' "$out/table.txt"
exit $failed
