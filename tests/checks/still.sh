#!/bin/sh
# What a still scene and one moving thing cost with zs_track, on QEMU's Cortex-M3 (instructions, not cycles).
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

out=${B%/checks}/still
mkdir -p "$out"
firmware="make -s -f firmware/boards/firmware.mk BOARD=mps2 APP=still B=${B%/checks}"
if $firmware >"$out/log" 2>&1 && timeout 120 $firmware run >"$out/csv" 2>"$out/err"; then
    cat "$out/err" >>"$out/csv" # semihosting may write to either
    ok "a still scene takes at most 2 % of a full frame: $(grep -c '^[a-z_-]*,[0-9]' "$out/csv") scenes"
else
    cat "$out/log" "$out/err" "$out/csv"
    bad "a still scene takes at most 2 % of a full frame" "see above"
fi
echo "Instructions a frame (QEMU mps2-an385 -icount): all strips; the first frame with zs_track; nothing changed; the last instance moved"
awk -F, '$2 + 0 > 0 && NF == 9 {
    if (!n++) printf "%-14s %9s %9s %8s %6s %9s %6s %s\n", "scene", "full", "first", "still", "%", "moved", "%", "strips"
    printf "%-14s %9d %9d %8d %6.2f %9d %6.1f %d of %d\n", $1, $2, $4, $6, 100 * $6 / $2, $8, 100 * $8 / $2, $9, $3 }' "$out/csv"
exit $failed
