#!/bin/sh
# What a stage of the renderer costs on each core: probes (firmware/scenes/probes.h) on QEMU's Cortex-M0 to M7 and
# RISC-V in instructions, on the emulated RP2040 in cycles; fitted, and held against the demo and bench scenes, which
# are not in the fit. M0: as in bench.sh.
#
# Usage: tests/lab/costs.sh BUILD          the table, and how far it is from the scenes: what make bench has on
# record
#                                             and, where make pico was run before, what it measured
#        tests/lab/costs.sh BUILD record   sim/budget/stage_costs.h from it; record_sizes.h beside it (sizes_record.sh)
#        tests/lab/costs.sh BUILD quick    a test: probes on the Cortex-M3 alone; what is on record still is what
#                                             they say, and on no core is a scene more than 15 % off
# Needs BUILD/zlab and BUILD/gen.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

what=${2:-}
out=$top/costs
record=tests/records/bench.txt
methods=tests/records/methods.txt
mkdir -p "$out"

firmware() { # BOARD GOAL
    board=$1 goal=$2
    set -- B="$top" NAME=costs APP_SRC=firmware/app/costs.c
    [ "$board" != m0 ] || set -- "$@" BOARD_CPU='-mcpu=cortex-m0 -mthumb' OUT="$top/fw/mps2-armv6m"
    [ "$board" != pico ] && [ -z "${COSTS_FEW:-}" ] || set -- "$@" APP_FLAGS=-DCOSTS_FEW=1
    [ "$board" != m0 ] || board=mps2
    make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD="$board" "$@" "$goal"
}
if [ "$what" = run ]; then # BOARD, by xargs
    if [ "$3" = pico ]; then
        timeout 1800 node "$top/pico/parts.mjs" "$top/fw/pico/costs" >"$out/pico.csv" 2>&1
    else
        timeout 300 sh "$0" "$top" go "$3" >"$out/$3.csv" 2>&1
    fi
    exit
elif [ "$what" = go ]; then
    firmware "$3" run
    exit
fi

boards="pico m0 mps2 mps2-m4 mps2-m7 rv32"
if [ "$what" = quick ]; then
    boards=mps2
    COSTS_FEW=1
    export COSTS_FEW
fi
for board in $boards; do
    goal=all
    [ $board != pico ] || goal=image
    firmware $board $goal >"$out/$board.log" 2>&1 ||
        { cat "$out/$board.log" >&2; echo "costs for $board do not build" >&2; exit 1; }
    [ $board != pico ] || sh tests/boards/pico.sh "$top" set-up || exit 1
done
# shellcheck disable=SC2086
printf '%s\n' $boards | xargs -P "$(nproc)" -n 1 sh "$0" "$top" run

files="--m3 $out/mps2.csv"
[ "$what" = quick ] ||
    files="$files --m0 $out/m0.csv --m4 $out/mps2-m4.csv --m7 $out/mps2-m7.csv --rv32 $out/rv32.csv
        --rp2040 $out/pico.csv"

# What scenes take: on record, and of the RP2040 what make pico has measured here
cat "$record" "$methods" >"$out/scenes.txt"
for scene in teapot china cubes knot flyover city hall globe; do
    grep -qx 'frames 4' "$top/pico/$scene.txt" 2>/dev/null && # make test draws fewer of some
        sed -n "s/^draw_cycles /RP2040 $scene /p" "$top/pico/$scene.txt" >>"$out/scenes.txt"
done
# shellcheck disable=SC2086
case $what in
record)
    "$top/zlab" costs $files --header --error "$out/scenes.txt" >"$out/stage_costs.h" &&
        mv "$out/stage_costs.h" sim/budget/stage_costs.h || exit 1
    sh tests/lab/sizes_record.sh "$top" >"$out/record_sizes.h" && mv "$out/record_sizes.h" sim/budget/record_sizes.h
    exit ;;
quick)
    "$top/zlab" costs $files --drift 5 >"$out/quick.txt" 2>&1 && reason='' || reason=$(tail -1 "$out/quick.txt")
    none "costs on record are what probes take on Cortex-M3: $(sed -n 's/^M3 .*probes: //p' "$out/quick.txt")" "$reason"
    "$top/zlab" costs --error "$record" >"$out/error.txt" 2>&1 && reason='' || reason=$(tail -1 "$out/error.txt")
    grep -q ' layers_btf ' "$record" || reason="layers_btf is not among the scenes"
    off=$(sed -n 's/^\([^ ]*\) .* scenes, none.* at most \([-+0-9.]*\) %.*/\1 \2 %/p' "$out/error.txt" |
        tr '\n' ',' | sed 's/,$//; s/,/, /g')
    none "no scene's estimate is 15 % off: $off at most" "$reason"
    "$top/zlab" costs --error "$methods" --bar 20 >"$out/methods.txt" 2>&1 && reason='' ||
        reason=$(tail -1 "$out/methods.txt")
    none "no method's estimate is 20 % off, in $(grep -c '^[MR]' "$methods") frames" "$reason"
    stated=$(sed -n 's/^static const double stage_error.* { [^,]*, \([0-9.]*\),.*/\1/p' sim/budget/stage_costs.h)
    now=$(sed -n 's/^M3 .* scenes, none.* at most [-+]*\([0-9.]*\) %.*/\1/p' "$out/error.txt")
    none "the error that zsim budget states on Cortex-M3, $stated %" \
        "$(awk -v a="$stated" -v b="$now" 'BEGIN { if (b > a + 1) print "it_is_" b ":_make_costs-record" }')"
    # sizes, flash and stack on record
    if other_compiler; then
        ok "sizes, flash and stack on record are of another compiler: not compared"
        exit $failed
    fi
    for c in $CPUS; do
        sh tests/lab/sizes_record.sh "$top" structs "$c" |
            sed 's/^\([a-z_]*\) \(.*\)/#define RECORD_\1 \2u/' >"$out/structs-$c.txt"
        none "sizes of structs on record, $c" \
            "$(grep -vxFf sim/budget/record_sizes.h "$out/structs-$c.txt" | tr ' ' '_')"
    done
    core cortex-m3 "$out/core-cortex-m3" || exit 1
    reason=''
    for depth_mask in 'float 2' 'recip 63'; do
        # shellcheck disable=SC2086
        now=$(sh tests/lab/sizes_record.sh "$top" flash cortex-m3 $depth_mask | cut -d' ' -f4)
        then=$(sed -n "s|^/\* of which $depth_mask is \([0-9]*\) .*|\1|p" sim/budget/record_sizes.h)
        awk -v a="$now" -v b="$then" 'BEGIN { exit !(a > b * 1.02 || a < b * 0.98) }' &&
            reason="$reason $depth_mask: $now, $then on record: make costs-record"
    done
    none "flash on record within 2 %" "$(echo "$reason" | tr ' ' '_' | sed 's/^_//')"
    if [ -s "$top/test/logs/stack.log" ]; then
        for c in $CPUS; do
            sed -n "s/^ok $c stack within [0-9]* bytes: zs_render \([0-9]*\)/\1/p" "$top/test/logs/stack.log"
        done | tr '\n' ' ' | sed 's/ $//; s/ /, /' >"$out/stack-now.txt"
        grep -qF "record_stack_render[RECORD_CPUS] = { $(cat "$out/stack-now.txt") };" sim/budget/record_sizes.h &&
            reason='' || reason="make_stack_says_$(tr ' ' '_' <"$out/stack-now.txt"):_make_costs-record"
        none "stack on record" "$reason"
    fi
    exit $failed ;;
esac
echo "Instructions of one (QEMU -icount), cycles on the RP2040 (rp2040js)"
"$top/zlab" costs $files --error "$out/scenes.txt"
