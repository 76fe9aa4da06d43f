#!/bin/sh
# Instructions of one frame by function, on a board that QEMU counts (mps2, mps2-m4, mps2-m7, rv32): strips of 24 rows,
# one pass, as the bench's. m0: code for Armv6-M on mps2, as there. Instructions are not cycles.
# Usage: tests/boards/profile.sh BUILD BOARD SCENE [FUNCTION]     FUNCTION: its listing, with how often each line ran
#
# SPDX-License-Identifier: MIT
set -u
build=$1 board=$2 scene=$3 function=${4:-}
out=$build/profile
stem=$out/${board}_$scene
. tests/boards/image.sh

mkdir -p "$out"
set -- NAME="frame_$scene" APP_SRC=firmware/app/frame.c APP_FLAGS="-DFRAME_DEMO=$scene"
if [ "$board" = m0 ]; then # QEMU's only M0 has 16 KB of RAM
    set -- "$@" BOARD_CPU='-mcpu=cortex-m0 -mthumb' OUT="$build/fw/mps2-armv6m"
    board=mps2
    elf=$build/fw/mps2-armv6m/frame_$scene.elf
else
    elf=$build/fw/$board/frame_$scene.elf
fi
image "$board" "$@"
LOG='-display none -monitor none -serial null -semihosting-config enable=on,target=native'
LOG="$LOG -d in_asm,exec,nochain -D /dev/stdout -kernel"
{
    make -s -f firmware/boards/firmware.mk BOARD="$board" B="$build" "$@" QEMU_COUNTS="$LOG" run
    echo "ended with $?" >"$stem.end"
} | node tests/boards/profile.mjs "$elf" 40 $function >"$stem.txt" || exit 1
[ "$(cat "$stem.end")" = "ended with 0" ] || { bad "profile of $scene" "the frame $(cat "$stem.end")"; exit 1; }
echo "$scene on $board: instructions of a frame by function, callees not counted; $(field "$stem.txt" total) in all"
sed -n 's/^function //p' "$stem.txt" | awk '{ printf "%10d  %s\n", $2, $1 }'
[ -z "$function" ] && exit
objdump=$(make -s -f firmware/boards/firmware.mk BOARD="$board" B="$build" hal | head -1 | sed 's/gcc$/objdump/')
"$objdump" -d --disassemble="$function" "$elf" | awk '
    NR == FNR { if ($1 == "at") runs[$2] = $3; next }
    { at = $1; sub(/:$/, "", at); if (/^ *[0-9a-f]+:\t/) printf "%9s %s\n", (at in runs) ? runs[at] : ".", $0 }' \
        "$stem.txt" -
