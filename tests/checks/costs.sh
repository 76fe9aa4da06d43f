#!/bin/sh
# What a stage of the renderer costs on each core: probes (firmware/scenes/probes.h) on QEMU's Cortex-M0 to M7 and RISC-V in
# instructions, on the emulated RP2040 in cycles; fitted, and held against the demo and bench scenes, which are not in the
# fit. M0: as in bench.sh.
#
# Usage: tests/checks/costs.sh BUILD          the table, and how far it is from the scenes: what make bench has on record
#                                             and, where make pico was run before, what it measured
#        tests/checks/costs.sh BUILD record   sim/stage_costs.h from it
#        tests/checks/costs.sh BUILD quick    a test: Cortex-M3 alone; what is on record still is what probes say, and no
#                                             scene is more than 15 % off
# Needs BUILD/zsim and BUILD/gen.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

top=${B%/checks}
what=${2:-}
out=$top/costs
record=tests/golden/bench.txt
mkdir -p "$out"

firmware() { # BOARD GOAL
    board=$1 goal=$2
    set -- B="$top" NAME=costs APP_SRC=firmware/app/costs.c
    [ "$board" != m0 ] || set -- "$@" BOARD_CPU='-mcpu=cortex-m0 -mthumb' OUT="$top/fw/mps2-armv6m"
    [ "$board" != pico ] || set -- "$@" APP_FLAGS=-DCOSTS_FEW=1
    [ "$board" != m0 ] || board=mps2
    make -s -j2 -f firmware/boards/firmware.mk BOARD="$board" "$@" "$goal"
}
if [ "$what" = run ]; then # BOARD, by xargs
    if [ "$3" = pico ]; then
        timeout 600 node "$top/pico/parts.mjs" "$top/fw/pico/costs" >"$out/pico.csv" 2>&1
    else
        timeout 300 sh "$0" "$top" go "$3" >"$out/$3.csv" 2>&1
    fi
    exit
elif [ "$what" = go ]; then
    firmware "$3" run
    exit
fi

boards="pico m0 mps2 mps2-m4 mps2-m7 rv32"
[ "$what" != quick ] || boards=mps2
for board in $boards; do
    goal=all
    [ $board != pico ] || goal=image
    firmware $board $goal >"$out/$board.log" 2>&1 || { cat "$out/$board.log" >&2; echo "costs for $board do not build" >&2; exit 1; }
    [ $board != pico ] || sh tests/pico.sh "$top" set-up || exit 1
done
# shellcheck disable=SC2086
printf '%s\n' $boards | xargs -P 2 -n 1 sh "$0" "$top" run

files="--m3 $out/mps2.csv"
[ "$what" = quick ] ||
    files="$files --m0 $out/m0.csv --m4 $out/mps2-m4.csv --m7 $out/mps2-m7.csv --rv32 $out/rv32.csv --rp2040 $out/pico.csv"

# shellcheck disable=SC2086
case $what in
record)
    "$top/zsim" costs $files --header >"$out/stage_costs.h" && mv "$out/stage_costs.h" sim/stage_costs.h
    exit ;;
quick)
    grep '^M3 ' "$record" >"$out/scenes.txt"
    if "$top/zsim" costs $files --drift 5 >"$out/quick.txt" 2>&1; then ok "costs on record are what probes take: $(tail -1 "$out/quick.txt")"
    else bad "costs on record are what probes take" "$(tail -1 "$out/quick.txt"); make costs-record"; fi
    if "$top/zsim" costs --error "$out/scenes.txt" >"$out/error.txt" 2>&1; then ok "no scene is 15 % off: $(tail -1 "$out/error.txt")"
    else bad "no scene is 15 % off" "$(tail -1 "$out/error.txt")"; fi
    exit $failed ;;
esac
cat "$record" >"$out/scenes.txt"
[ ! -s "$top/pico/table.txt" ] || awk '$1 == "pico" { print "RP2040", $2, $6 }' "$top/pico/table.txt" >>"$out/scenes.txt"
echo "Instructions of one (QEMU -icount), cycles on the RP2040 (rp2040js)"
"$top/zsim" costs $files --error "$out/scenes.txt"
