#!/bin/sh
# A table of the boards that have a panel: cubes and teapot, on each part's own panel, size and profile. Each row comes
# out of the board's own test, which compares the pictures as well; that fails where it does.
# Usage: tests/boards/table.sh BUILD   from the repository's top
set -u
build=$1
failed=0
mkdir -p "$build/boards"
rows=$build/boards/table.txt
: >"$rows"

# BOARD WHAT RAM-OF-THE-PART SCRIPT...: run its test and keep its lines of the two scenes
board() {
    name=$1 what=$2 ram=$3
    shift 3
    [ ! -t 2 ] || printf '%s ...\r' "$name" >&2
    "$@" >"$build/boards/$name.log" 2>&1 || {
        grep '^FAILED' "$build/boards/$name.log"
        failed=1
        return
    }
    awk -v board="$name" -v what="$what" -v ram="$ram" '$1 == board && ($2 == "cubes" || $2 == "teapot") {
        printf "%-10s %-34s %-7s %7d %7d of %7d %6d %10d %s\n", board, what, $2, $3, $4, ram, $5, $6,
            board == "pico" ? "cycles" : "instructions" }' "$build/$name/table.txt" >>"$rows"
}

board pico 'Cortex-M0+, ST7789 240x240' 270336 env PICO_SCENES='cubes teapot' sh tests/boards/pico.sh "$build" table
board microbit 'Cortex-M0, ILI9341 160x128, 4 bits' 16384 sh tests/boards/microbit.sh "$build"
board lm3s6965 'Cortex-M3, SSD0323 128x64 grey' 65536 sh tests/boards/lm3s6965.sh "$build"
board stm32f405 'Cortex-M4, ST7789 240x240' 131072 sh tests/boards/stm32f405.sh "$build"
printf '%-10s %-34s %-7s %7s %7s    %7s %6s %10s\n' board 'core, panel' scene flash RAM '' stack 'a frame'
sort -s -k1,1 "$rows" | awk '/ cubes /{ print; next } { last[n++] = $0 } END { for (i = 0; i < n; i++) print last[i] }'
echo "Bytes; RAM is statics, arena and the stack's reserve, of what the part has; stack is what was used of it."
echo "A frame: of drawing, the panel's part not counted; instructions as QEMU counts them, cycles as rp2040js:"
echo "neither is silicon."
echo "Boards without a panel: make bench (instructions by core), make checksums."
exit $failed
