#!/bin/sh
# The bench on QEMU's Cortex-M3, M4, M7 and RISC-V beside the same program on this machine: every frame's checksum,
# counts and pools must agree line by line. Instructions are reported, not judged; they are not cycles.
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
boards="mps2 mps2-m4 mps2-m7 rv32"
core() { # BOARD
    case $1 in mps2) echo Cortex-M3 ;; mps2-m4) echo Cortex-M4 ;; mps2-m7) echo Cortex-M7 ;; rv32) echo rv32imc ;; esac
}
for board in host $boards; do
    if ! make -s -j2 -f firmware/boards/firmware.mk BOARD=$board APP=bench B="$top" >"$out/$board.log" 2>&1; then
        cat "$out/$board.log"
        bad "bench for $board" "does not build"
        exit 1
    fi
done
# shellcheck disable=SC2016,SC2086
printf '%s\n' host $boards | xargs -P 2 -n 1 sh -c 'timeout 300 make -s -f firmware/boards/firmware.mk BOARD="$3" \
    APP=bench B="$1" run >"$2/$3.csv" 2>"$2/$3.err"; echo $? >"$2/$3.status"' sh "$top" "$out"
for board in host $boards; do
    status=$(cat "$out/$board.status")
    cat "$out/$board.err" >>"$out/$board.csv" # QEMU's semihosting may write to either
    none "bench on $board" "$(grep -E '^# FAILED|error:' "$out/$board.csv" | tr ' ' '_')"
    { [ "$status" = 0 ] && grep -q '^# ok' "$out/$board.csv"; } || bad "bench on $board ends" "status $status"
    cut -d, -f1-12 "$out/$board.csv" | grep , | grep -v '^#' >"$out/$board.frames"
    [ $board = host ] && continue
    agree="$(core $board) and host agree"
    if cmp -s "$out/host.frames" "$out/$board.frames" && [ "$(wc -l <"$out/$board.frames")" -gt 1 ]; then
        ok "$agree: $(($(wc -l <"$out/$board.frames") - 1)) configurations, frames bit for bit"
    else
        bad "$agree" "$(diff "$out/host.frames" "$out/$board.frames" | grep -m1 '^>')"
    fi
done

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

echo
echo "Instructions a frame by core, in millions; one pass, strips of 24 rows (QEMU -icount; not cycles)."
(cd "$out" && awk -F, '
    FNR == 1 { boards++ }
    $2 == "one-pass" && NF == 17 { if (!($1 in seen)) { seen[$1] = 1; scene[++n] = $1 }; count[boards, $1] = $13 }
    END {
        printf "%-16s %8s %8s %8s %8s\n", "scene", "M3", "M4", "M7", "rv32imc" # in the order of boards
        for (i = 1; i <= n; i++) {
            printf "%-16s", scene[i]
            for (b = 1; b <= boards; b++) printf " %8.2f", count[b, scene[i]] / 1e6
            print "" } }' $(printf '%s.csv ' $boards))
exit $failed
