#!/bin/sh
# What culling by clusters saves, and what instances out of view cost, on QEMU's Cortex-M3 (instructions, not cycles).
# Needs BUILD/zsim.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/cull
mkdir -p "$out"
# A torus of 9,600 triangles
awk 'BEGIN { n = 80; m = 60; pi = atan2(0, -1)
    for (i = 0; i < n; i++) for (k = 0; k < m; k++) { a = 2 * pi * i / n; b = 2 * pi * k / m; r = 3 + cos(b)
        printf "v %.6f %.6f %.6f\n", r * cos(a), sin(b), -r * sin(a) }
    for (i = 0; i < n; i++) for (k = 0; k < m; k++) { i1 = (i + 1) % n; k1 = (k + 1) % m
        p = i * m + k + 1; q = i1 * m + k + 1; s = i1 * m + k1 + 1; t = i * m + k1 + 1
        printf "f %d %d %d\nf %d %d %d\n", p, q, s, p, s, t } }' >"$out/model.obj"
if ! "$top/zsim" convert "$out/model.obj" --name model --out "$out" >"$out/convert.txt" 2>&1; then
    cat "$out/convert.txt"
    bad "a model for cull" "zsim convert fails"
    exit 1
fi
firmware="make -s -f firmware/boards/firmware.mk BOARD=mps2 NAME=cull B=$top APP_FLAGS=-I$out"
if $firmware APP_SRC="firmware/app/cull.c $out/model.c" >"$out/log" 2>&1 &&
    timeout 300 $firmware APP_SRC="firmware/app/cull.c $out/model.c" run >"$out/csv" 2>"$out/err"; then
    cat "$out/err" >>"$out/csv" # semihosting may write to either
    ok "instances out of view and clusters change no picture"
else
    cat "$out/log" "$out/err" "$out/csv"
    bad "instances out of view, clusters" "see above"
fi
echo "Instructions a frame (QEMU mps2-an385 -icount), 320x240, strips of 24 rows:"
awk -F, 'NF == 9 {
    if (!n++) {
        printf "%-18s %-12s %10s %9s %7s %8s %8s %8s %9s\n", "scene", "", $3, $4, $5, $6, $7, $8, "drawn"
        next
    }
    printf "%-18s %-12s %10s %9s %7s %8s %8s %8s %9s\n", $1, $2, $3, $4, $5, $6, $7, $8, $9 }' "$out/csv"
exit $failed
