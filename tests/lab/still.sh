#!/bin/sh
# What a still scene and one moving thing cost with zs_damage_track, on QEMU's Cortex-M3 (instructions, not cycles).
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/still
mkdir -p "$out"
firmware="make -s -f firmware/boards/firmware.mk BOARD=mps2 APP=still B=$top"
if $firmware >"$out/log" 2>&1 && timeout 120 $firmware run >"$out/csv" 2>"$out/err"; then
    cat "$out/err" >>"$out/csv" # semihosting may write to either
    n=$(grep -c '^[a-z_-]*,[0-9]' "$out/csv")
    ok "a still scene takes at most 2 % of a full frame: $n scenes"
    ok "one thing that moved and is small takes at most two fifths of it, by columns; no more than 5 % over strips:" \
        "$n scenes"
else
    cat "$out/log" "$out/err" "$out/csv"
    bad "what zs_damage_track saves" "see above"
fi
echo "Instructions a frame (QEMU mps2-an385 -icount): all strips; with zs_damage_track the first frame, nothing"
echo "changed, the last instance moved: by strips and by columns (zs_damage_columns); %: of all strips, and of their"
echo "pixels what was sent"
awk -F, '$2 + 0 > 0 && NF == 16 {
    if (!n++)
        printf "%-14s %9s %9s %8s %6s %9s %6s %-9s %6s %9s %6s %6s\n", "scene", "full", "first", "still", "%",
               "moved", "%",
               "strips", "sent %", "columns", "%", "sent %"
    printf "%-14s %9d %9d %8d %6.2f %9d %6.1f %2d of %-3d %6.1f %9d %6.1f %6.1f\n", $1, $2, $5, $8, 100 * $8 / $2, $11,
           100 * $11 / $2, $12, $3, 100 * $13 / $4, $14, 100 * $14 / $2, 100 * $16 / $4 }' "$out/csv"
exit $failed
