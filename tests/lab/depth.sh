#!/bin/sh
# What chooses a depth mapping: the separation that each keeps, drawn on this machine, and what each costs on two
# emulated cores, one with CLZ and 64-bit products (Cortex-M3), one without (Cortex-M0, Armv6-M as the M0+).
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/depth
mkdir -p "$out"
"$top/zsim" study depth --out "$top/study" || bad "zsim study depth" "see above"
echo "Least separation of two walls that is never swapped, keys of 16 bits, percent of the distance, the worst one:"
awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
    $at["part"] == "separation" && $at["bits"] == 16 {
        far = $at["far"]; map = $at["mapping"]; gap = $at["separation"]
        if (!(map in is)) { is[map] = 1; name[++k] = map }
        of = gap == "" ? "none" : 100 * gap / $at["z"]
        if (of == "none" || worst[far, map] != "none" && of > worst[far, map]) worst[far, map] = of }
    END {
        printf "%-12s", "far / near"; for (j = 1; j <= k; j++) printf " %9s", name[j]; print ""
        for (far = 10; far <= 100000; far *= 10) {
            printf "%-12s", far
            for (j = 1; j <= k; j++) {
                of = worst[far, name[j]]
                if (of == "none") printf " %9s", of; else printf " %8.4f%%", of }
            print "" } }' "$top/study/depth.csv"
for board in mps2 m0; do
    if make -s -f firmware/boards/firmware.mk BOARD=$board APP=depth B="$top" >"$out/$board.log" 2>&1 &&
        timeout 300 make -s -f firmware/boards/firmware.mk BOARD=$board APP=depth B="$top" run \
            >"$out/$board.csv" 2>"$out/$board.err"; then
        cat "$out/$board.err" >>"$out/$board.csv" # semihosting may write to either
    else
        cat "$out/$board.log" "$out/$board.err"
        bad "cost on $board" "see above"
    fi
done
echo
echo "Instructions a pixel tested, whole frames of 96x72 in strips of 8 rows with pools of 160 (QEMU -icount, not" \
    "cycles):"
awk -F, '
    function note(cpu, per_tick) {
        if (!($1 in seen)) { seen[$1] = 1; scene[++n] = $1 }
        if (!(($2) in is)) { is[$2] = 1; map[++k] = $2 }
        cost[cpu, $1, $2] = $3 * per_tick / $4; whole[cpu, $1, $2] = $3 * per_tick }
    NF == 5 { note(FILENAME ~ /mps2/ ? "M3" : "M0", FILENAME ~ /mps2/ ? 40 : 62.5) }
    END {
        printf "%-22s", ""; for (j = 1; j <= k; j++) printf " %9s", map[j]; print ""
        for (c = 1; c <= 2; c++) for (i = 1; i <= n; i++) {
            cpu = c == 1 ? "M3" : "M0"
            printf "%-3s %-18s", cpu, scene[i]
            for (j = 1; j <= k; j++) printf " %9.1f", cost[cpu, scene[i], map[j]]
            print "" } }' "$out/mps2.csv" "$out/m0.csv"
exit $failed
