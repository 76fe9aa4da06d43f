#!/bin/sh
# Promise 7: without firmware/zstrip/fast nothing changes but time. Programs that are compiled without it draw what
# those draw that name accelerators: golden checksums by two compilers at two levels and on big-endian PowerPC, and
# every bench scene on Cortex-M3 and in Armv6-M code in all the bench's configurations. tests/property/scene_sums.sh has
# the demo scenes. That it is so: no name of fast/ is in these programs, all are in the full one, and they take more
# instructions than those on record.
# Usage: tests/property/bare.sh BUILD          from the repository's top; needs BUILD/test (checksum-programs),
#                                              BUILD/gen
#        tests/property/bare.sh BUILD bench    the bench alone
#
# SPDX-License-Identifier: MIT
set -u
export LC_ALL=C
build=$1
out=$build/bare
. tests/lib/ok.sh
mkdir -p "$out"

# ---- Bench scenes: "scene checksum" of every line; the full build's are of this machine ------------------------------
# Instructions are counted of one-pass frames, each drawn once more

firmware() { # MAKE-VARIABLES... GOAL
    timeout 600 make -s -j"$(nproc)" -f firmware/boards/firmware.mk B="$build" NAME=bench APP_SRC=firmware/app/bench.c \
        APP_FLAGS='-DBENCH_RUNS=1 -DBENCH_BAR_RUNS=0' "$@"
}
bench() { # NAME MAKE-VARIABLES...
    name=$1
    shift
    firmware "$@" all >"$out/$name.log" 2>&1 || { cat "$out/$name.log"; return 1; }
    firmware "$@" run >"$out/$name.csv" 2>&1
    grep -q '^# ok' "$out/$name.csv"
}
frames() { # NAME
    awk -F, 'NF == 17 && $1 != "scene" { print $1, $12 }' "$out/$1.csv" | sort -u
}
# Names that a program defines, without what the compiler appends to those of parts and copies
names() { # NM PROGRAM
    "$1" --plugin= "$2" | awk 'NF == 3 && $2 ~ /[tTrRdD]/ { sub(/\..*/, "", $3); if ($3 != "") print $3 }' | sort -u
}
none_of_fast() { # NAME NM PROGRAM
    found=$(names "$2" "$3" | grep -xF -f "$out/fast.names" | tr '\n' ' ')
    if [ -n "$found" ]; then bad "$1" "these names are of fast/: $found"
    elif [ "$(names "$2" "$3" | wc -l)" -lt 100 ]; then bad "$1" "$3 has no names"
    else ok "$1: none of $(wc -l <"$out/fast.names") names of fast/"; fi
}

firmware BOARD=host all >"$out/full.log" 2>&1 && "$build/fw/host/bench.elf" >"$out/full.csv" 2>&1 ||
    bad bare_bench "the full build's bench fails: $out/full.csv, $(tail -1 "$out/full.log")"
frames full >"$out/full.frames"

# Names that fast/ defines and no other file has as a word; the full program has all accelerators and these loops of
# theirs, or they prove nothing
for o in "$build"/fw/host/firmware/zstrip/fast/*.o; do names nm "$o"; done | sort -u >"$out/of_fast.names"
find firmware/zstrip firmware/app firmware/scenes hal tests/property/checksum.c tests/lib/shapes.h "$build/gen" \
    -name '*.[ch]' | grep -v '^firmware/zstrip/fast/' | xargs cat |
    tr -cs 'A-Za-z0-9_' '\n' | grep -v '^zs_fast_' | sort -u >"$out/words"
comm -23 "$out/of_fast.names" "$out/words" >"$out/fast.names"
names nm "$build/fw/host/bench.elf" >"$out/full.names"
gone=$(for name in $(sed -n 's/^extern const struct zs_fast //p' firmware/zstrip/zs_fast.h | sed 's/;.*//; s/,/ /g') \
    solid_walk small_draw tiny_cuts texture_rows touch_piece tiles_cover zs_batch_bin; do
    grep -qxF "$name" "$out/fast.names" || echo "$name in fast/"
    case $name in # scenes of the bench have no clusters, colours at vertices or four-bit texels
    zs_fast_clusters | zs_fast_smooth | zs_fast_pal4) continue ;;
    esac
    grep -qxF "$name" "$out/full.names" || echo "$name"
done)
if [ -z "$gone" ]; then ok "bare_names: $(wc -l <"$out/fast.names") of fast/, the full program has accelerators"
else bad bare_names "not there: $(echo "$gone" | tr '\n' ' ')"; fi

for name in m3 armv6m; do
    set -- BOARD=mps2 LEAN=1
    elf=$build/fw/mps2-lean/bench.elf
    [ $name = m3 ] || {
        elf=$build/fw/mps2-armv6m-lean/bench.elf
        set -- BOARD=mps2 LEAN=1 BOARD_CPU='-mcpu=cortex-m0 -mthumb' OUT="$build/fw/mps2-armv6m-lean"
    }
    if ! bench $name "$@"; then
        bad "bare_bench_$name" "see $out/$name.csv: $(grep -m 1 -E 'FAILED|error' "$out/$name.csv")"
        continue
    fi
    frames $name >"$out/$name.frames"
    if [ -s "$out/full.frames" ] && differ=$(diff "$out/full.frames" "$out/$name.frames"); then
        configurations=$(grep -c '^[a-z_]*,' "$out/$name.csv")
        ok "bare_bench_$name ($(wc -l <"$out/full.frames") scenes, $configurations configurations)"
    else
        bad "bare_bench_$name" "other frames than the full build: $differ"
    fi
    none_of_fast "bare_names_$name" arm-none-eabi-nm "$elf"
done
echo 'Instructions of one-pass frames, millions, and times those on record with accelerators (tests/records/bench.txt)'
for name in m3 armv6m; do
    awk -v core="$([ $name = m3 ] && echo M3 || echo M0)" -F '[ ,]' '
        FILENAME ~ /records/ { if ($1 == core) full[$2] = $3; next }
        $2 == "one-pass" && NF == 17 && $1 in full {
            printf "  %-4s %-16s %8.2f %6.2f\n", core, $1, $13 / 1e6, $13 / full[$1] }' \
        tests/records/bench.txt "$out/$name.csv" | tee "$out/$name.times"
    # each scene takes longer: accelerators do something, and these programs have none
    quick=$(awk '$4 <= 1.02 { print $2, $4 }' "$out/$name.times" | tr '\n' ' ')
    if [ -z "$quick" ] && [ "$(wc -l <"$out/$name.times")" -ge 8 ]; then ok "bare_slower_$name"
    else bad "bare_slower_$name" "no longer than with accelerators, or too few scenes: $quick"; fi
done
[ "${2:-}" != bench ] || exit $failed

for lean in LEAN=yes 'LEAN=1 CORES=2'; do # neither is another image than the one asked for
    # shellcheck disable=SC2086
    make -n -f firmware/boards/firmware.mk BOARD=pico B="$build" APP=show SCENE=cubes $lean >"$out/lean.txt" 2>&1
    if grep -q 'LEAN is 0, or 1 with CORES=1' "$out/lean.txt"; then ok "bare_refused_$(echo "$lean" | tr '= ' '__')"
    else bad "bare_refused_$(echo "$lean" | tr '= ' '__')" "$(tail -1 "$out/lean.txt")"; fi
done

# ---- Golden checksums ------------------------------------------------------------------------------------------------

for program in gcc-O0 gcc-O3 clang-O0 clang-O3 powerpc-Os; do
    name=bare_checksum_$(echo $program | tr - _)
    case $program in powerpc-*) emulator=qemu-ppc-static nm=powerpc-linux-gnu-nm ;; *) emulator='' nm=nm ;; esac
    $emulator "$build/test/bare-$program" >"$out/$name.out" 2>&1
    if diff "$out/$name.out" tests/records/checksums.txt >"$out/$name.diff"; then
        ok "$name ($(wc -l <"$out/$name.out") scenes)"
    else
        bad "$name" "differs from tests/records/checksums.txt: $(head -3 "$out/$name.diff" | tr '\n' ' ')"
    fi
    none_of_fast "$name has" $nm "$build/test/bare-$program"
done
exit $failed
