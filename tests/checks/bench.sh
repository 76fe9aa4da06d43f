#!/bin/sh
# The bench on QEMU's Cortex-M3 beside the same program on this machine: every frame's checksum, counts
# and pools must agree line by line. Instructions are reported, not judged; they are not cycles.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

top=${B%/checks}
out=$top/bench
mkdir -p "$out" "$top/gen"
newer=$(find firmware/scenes/gen firmware/scenes/*.h -newer "$top/gen/meshes.h" 2>/dev/null | head -1)
if [ ! -e "$top/gen/meshes.h" ] || [ -n "$newer" ]; then
    gcc -O1 -std=c11 firmware/scenes/gen/*.c -o "$out/gen_meshes" && "$out/gen_meshes" "$top/gen" >/dev/null ||
        { bad "meshes" "the generator failed"; exit 1; }
fi
for board in host mps2; do
    if ! make -s -f firmware/boards/firmware.mk BOARD=$board APP=bench B="$top" >"$out/$board.log" 2>&1; then
        cat "$out/$board.log"
        bad "bench for $board" "does not build"
        exit 1
    fi
    timeout 300 make -s -f firmware/boards/firmware.mk BOARD=$board APP=bench B="$top" run \
        >"$out/$board.csv" 2>"$out/$board.err"
    status=$?
    cat "$out/$board.err" >>"$out/$board.csv" # QEMU's semihosting may write to either
    none "bench on $board" "$(grep -E '^# FAILED|error:' "$out/$board.csv" | tr ' ' '_')"
    { [ $status = 0 ] && grep -q '^# ok' "$out/$board.csv"; } || bad "bench on $board ends" "status $status"
    cut -d, -f1-12 "$out/$board.csv" | grep , | grep -v '^#' >"$out/$board.frames"
done
if cmp -s "$out/host.frames" "$out/mps2.frames" && [ "$(wc -l <"$out/mps2.frames")" -gt 1 ]; then
    ok "Cortex-M3 and host agree: $(($(wc -l <"$out/mps2.frames") - 1)) configurations, frames bit for bit"
else
    bad "Cortex-M3 and host agree" "$(diff "$out/host.frames" "$out/mps2.frames" | grep -m1 '^>')"
fi

echo
echo "Cortex-M3 instructions a frame (QEMU mps2-an385 -icount; not cycles). One pass: strips of 24 rows, one buffer."
echo "64 KB: the quickest of strips of 24, 16 and 8 rows, two buffers; RAM is arena, renderer, scene state and stack."
awk -F, '
    /^#/ || $1 == "scene" || NF < 17 { next }
    $2 == "one-pass" { order[++n] = $1; one[$1] = $0; next }
    !($1 in least) || $13 < least[$1] { least[$1] = $13; small[$1] = $0 }
    END {
        printf "%-13s %6s %6s %7s %7s %8s %7s %7s %7s | %7s %8s %6s %6s  %s\n", "scene", "in", "drawn", "tested",
            "setups", "instr", "a tri", "a frag", "arena", "64 KB", "instr", "passes", "RAM", "checksum"
        for (i = 1; i <= n; i++) {
            split(one[order[i]], a, ","); split(small[order[i]], s, ",")
            printf "%-13s %6d %6d %7d %7d %7.2fM %7.0f %7.1f %7d | %7s %7.2fM %6d %6d  %s\n", a[1], a[6], a[7], a[10],
                a[8], a[13] / 1e6, a[14], a[15], a[11], s[2], s[13] / 1e6, s[5], s[17], a[12] } }' "$out/mps2.csv"
exit $failed
