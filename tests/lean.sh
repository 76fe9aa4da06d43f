#!/bin/sh
# The lean build (ZS_LEAN, firmware/zstrip/config.h) draws what the full one draws: golden checksums by two compilers at two
# levels and on big-endian PowerPC, every bench scene on Cortex-M3 and on Armv6-M code in all the bench's configurations,
# and the unit tests that draw. tests/scene_sums.sh has the demo scenes.
# Usage: tests/lean.sh BUILD          from the repository's top; needs BUILD/lean (make lean-programs) and BUILD/gen
#        tests/lean.sh BUILD bench    the bench alone
#
# SPDX-License-Identifier: MIT
set -u
build=$1
lean=$build/lean
out=$build/lean/frames
. tests/ok.sh
mkdir -p "$out"

# ---- Bench scenes: "scene checksum" of every line; the full build's are of this machine ---------------------------------

bench() { # NAME MAKE-VARIABLES...
    name=$1
    shift
    make -s -j2 -f firmware/boards/firmware.mk B="$build" NAME=bench APP_SRC=firmware/app/bench.c "$@" all \
        >"$out/$name.log" 2>&1 || { cat "$out/$name.log"; return 1; }
    timeout 600 make -s -f firmware/boards/firmware.mk B="$build" NAME=bench APP_SRC=firmware/app/bench.c "$@" run \
        >"$out/$name.csv" 2>&1
    grep -q '^# ok' "$out/$name.csv"
}
frames() { # NAME
    awk -F, 'NF == 17 && $1 != "scene" { print $1, $12 }' "$out/$1.csv" | sort -u
}
make -s -j2 -f firmware/boards/firmware.mk BOARD=host B="$build" NAME=bench APP_SRC=firmware/app/bench.c all >"$out/full.log" 2>&1 &&
    "$build/fw/host/bench.elf" >"$out/full.csv" 2>&1 || bad lean_bench "the full build's bench fails: $out/full.csv"
frames full >"$out/full.frames"
for name in m3 armv6m; do
    set -- BOARD=mps2 LEAN=1
    [ $name = m3 ] || set -- BOARD=mps2 LEAN=1 BOARD_CPU='-mcpu=cortex-m0 -mthumb' OUT="$build/fw/mps2-armv6m-lean"
    if ! bench $name "$@"; then
        bad "lean_bench_$name" "see $out/$name.csv: $(grep -m 1 -E 'FAILED|error' "$out/$name.csv")"
        continue
    fi
    frames $name >"$out/$name.frames"
    if [ -s "$out/full.frames" ] && differ=$(diff "$out/full.frames" "$out/$name.frames"); then
        ok "lean_bench_$name ($(wc -l <"$out/full.frames") scenes, $(grep -c '^[a-z_]*,' "$out/$name.csv") configurations)"
    else
        bad "lean_bench_$name" "other frames than the full build: $differ"
    fi
done
echo 'Instructions of one-pass frames, millions, and times those on record of the full build (tests/golden/bench.txt)'
for name in m3 armv6m; do
    awk -v core="$([ $name = m3 ] && echo M3 || echo M0)" -F '[ ,]' '
        FILENAME ~ /golden/ { if ($1 == core) full[$2] = $3; next }
        $2 == "one-pass" && NF == 17 && $1 in full { printf "  %-4s %-16s %8.2f %6.2f\n", core, $1, $13 / 1e6, $13 / full[$1] }' \
        tests/golden/bench.txt "$out/$name.csv"
done
[ "${2:-}" != bench ] || exit $failed

# ---- Golden checksums, unit tests -----------------------------------------------------------------------------------------

for program in gcc-O0 gcc-O3 clang-O0 clang-O3 powerpc-Os; do
    name=lean_checksum_$(echo $program | tr - _)
    case $program in powerpc-*) emulator=qemu-ppc-static ;; *) emulator= ;; esac
    $emulator "$lean/test/checksum-$program" >"$out/$name.out" 2>&1
    if diff "$out/$name.out" tests/golden/checksums.txt >"$out/$name.diff"; then
        ok "$name ($(wc -l <"$out/$name.out") scenes)"
    else
        bad "$name" "differs from tests/golden/checksums.txt: $(head -3 "$out/$name.diff" | tr '\n' ' ')"
    fi
done
ls "$lean"/test/test_* | grep -vE '\.(o|d)$' | xargs -P 2 -n 1 sh -c '
    "$1" >"$0/$(basename "$1").log" 2>&1
    echo $? >"$0/$(basename "$1").status"' "$out"
for program in "$lean"/test/test_*; do
    name=$(basename "$program")
    log=$out/$name.log
    if [ "$(cat "$out/$name.status")" = 0 ]; then
        ok "lean_$name ($(grep -c '^\[ *OK \]' "$log") tests)"
    else
        bad "lean_$name" "$(grep -E '^\[  FAILED  \] [a-z0-9_]+$|runtime error|Sanitizer' "$log" | sort -u | tr '\n' ' ')"
    fi
done
exit $failed
