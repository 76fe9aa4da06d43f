#!/bin/sh
# The hierarchical depth buffer: what it skips and what strips of depth take as planes (BUILD/hiz/study, on this
# machine), and instructions on QEMU's Cortex-M3 (not cycles).
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/hiz
"$out/study" || failed=1
firmware="make -s -f firmware/boards/firmware.mk BOARD=mps2 APP=hiz B=$top"
if $firmware >"$out/log" 2>&1 && timeout 300 $firmware run >"$out/csv" 2>"$out/err"; then
    cat "$out/err" >>"$out/csv" # semihosting may write to either
    ok "zs_method_hiz draws the depth buffer's pictures on a Cortex-M3"
else
    cat "$out/log" "$out/err" "$out/csv"
    bad "zs_method_hiz on a Cortex-M3" "see above"
fi
echo "Thousand instructions a frame (QEMU mps2-an385 -icount), 320x240, strips of 24 rows: the depth buffer alone, with"
echo "the scene's accelerators but tiles, with all; the method alone, with accelerators; its weaker tests:"
awk -F, 'NF == 8 {
    printf "%-13s", $1
    for (k = 2; k <= NF; k++)
        if (n) printf " %13.0f", $k / 1000; else printf " %13s", $k
    print ""
    n++ }' "$out/csv"
exit $failed
