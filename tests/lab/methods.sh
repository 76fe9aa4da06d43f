#!/bin/sh
# Methods of hidden-surface removal side by side on QEMU's Cortex-M0 and M3 and on this machine: every machine's frames
# and counts are the same, and no frame takes over 2 % more instructions than tests/records/methods.txt has on record.
#
# Usage: tests/lab/methods.sh BUILD          the checks and a table
#        tests/lab/methods.sh BUILD record   the record on standard output, with cycles on the emulated RP2040
#        tests/lab/methods.sh BUILD pico     those cycles alone; pools there hold what 180,000 bytes hold
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/methods
record=tests/records/methods.txt
mkdir -p "$out"
pico() { # lines "RP2040 METHOD SCENE CYCLES"
    on_pico methods 3000 APP_SRC=firmware/app/methods.c DEFINES='-DCYCLES_A_TICK=125 -DARENA_BYTES=180000' \
        >"$out/pico.csv" || return 1
    tr -d '\r' <"$out/pico.csv" | awk -F, '$3 + 0 > 0 && !/failed/ { print "RP2040", $1, $2, $3 }'
}
if [ "${2:-}" = pico ]; then
    pico
    exit
fi
for board in mps2 m0 host; do
    firmware() { # Armv6-M code runs on the board of the M3, which has memory enough
        if [ "$board" = m0 ]; then
            make -s -f firmware/boards/firmware.mk BOARD=mps2 APP=methods B="$top" BOARD_CPU='-mcpu=cortex-m0 -mthumb' \
                OUT="$top/fw/mps2-armv6m" "$@"
        else
            make -s -f firmware/boards/firmware.mk BOARD="$board" APP=methods B="$top" "$@"
        fi
    }
    if ! firmware >"$out/$board.log" 2>&1 ||
        ! firmware run >"$out/$board.csv" 2>"$out/$board.err"; then
        cat "$out/$board.log" "$out/$board.err" "$out/$board.csv"
        bad "methods on $board" "see above"
        exit 1
    fi
    cat "$out/$board.err" >>"$out/$board.csv" # semihosting may write to either
    grep '^[a-z]*,[a-z_]*,[0-9]' "$out/$board.csv" | cut -d, -f1,2,4- >"$out/$board.same"
done
now() {
    for core in M0:m0 M3:mps2; do
        awk -F, -v core="${core%:*}" '$3 + 0 > 0 { print core, $1, $2, $3 }' "$out/${core#*:}.csv"
    done
}
if [ "${2:-}" = record ]; then
    echo "# Instructions of a frame by each method (tests/lab/methods.sh). Recorded by make methods-record."
    echo "compiler Arm $(${ARM}gcc -dumpversion)"
    now
    pico
    exit
fi
for board in m0 host; do
    if [ -s "$out/$board.same" ] && cmp -s "$out/mps2.same" "$out/$board.same"; then
        ok "methods draw the same on mps2 and $board: $(wc -l <"$out/$board.same") frames"
    else
        bad "methods draw the same on mps2 and $board" "$(diff "$out/mps2.same" "$out/$board.same" | head -3)"
    fi
done
now >"$out/now"
if ! other_compiler; then
    none "no method takes over 2 % more than on record, in $(grep -c '^M' $record) frames" "$(awk '
        NR == FNR { if (/^M/) was[$1, $2, $3] = $4; next }
        { k = $1 SUBSEP $2 SUBSEP $3; seen++ }
        !(k in was) || $4 > was[k] * 1.02 { print $1 "," $2 "," $3 ":" $4 ",was:" was[k] }
        END { if (!seen) print "no frames" }' $record "$out/now")"
else
    ok "instructions of methods: printed only, another compiler made the record"
fi
echo "Instructions a frame (QEMU -icount), bytes of arena:"
awk -F, 'NR == FNR { if ($3 + 0 > 0) m0[$1, $2] = $3; next }
    $3 + 0 > 0 { printf "  %-12s %-11s M0 %9d  M3 %9d  arena %6d  sorted %5d  splits %5d  rays %6d\n",
        $2, $1, m0[$1, $2], $3, $4, $5, $6, $7 }' "$out/m0.csv" "$out/mps2.csv"
exit $failed
