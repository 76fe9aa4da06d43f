#!/bin/sh
# The bench on QEMU's Cortex-M0, M3, M4, M7 and RISC-V beside the same program on this machine: every frame's checksum,
# counts and pools must agree line by line, and no one-pass frame may take over 2 % more instructions than
# tests/golden/bench.txt has on record. Instructions are not cycles.
#
# M0: code for Armv6-M, counted on the machine of the M3, which has the same instructions and more of them; QEMU's
# only M0 has 16 KB of RAM.
#
# Usage: tests/checks/bench.sh BUILD          the checks, and what frames take
#        tests/checks/bench.sh BUILD all      besides: each frame's error, what each skip is worth; CSV in BUILD/bench;
#                                             needs BUILD/zsim
#        tests/checks/bench.sh BUILD record   the one-pass frames as lines for tests/golden/bench.txt
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

top=${B%/checks}
what=${2:-}
out=$top/bench
record=tests/golden/bench.txt
boards="m0 mps2 mps2-m4 mps2-m7 rv32"
mkdir -p "$out" "$top/gen"

core() { # BOARD
    case $1 in m0) echo M0 ;; mps2) echo M3 ;; mps2-m4) echo M4 ;; mps2-m7) echo M7 ;; rv32) echo rv32imc ;; esac
}
firmware() { # BOARD NAME FLAGS GOAL
    set -- "$1" "$4" NAME="$2" APP_SRC=firmware/app/bench.c APP_FLAGS="$3"
    board=$1
    shift
    [ "$board" != m0 ] || set -- "$@" BOARD_CPU='-mcpu=cortex-m0 -mthumb' OUT="$top/fw/mps2-armv6m"
    [ "$board" != m0 ] || board=mps2
    make -s -j2 -f firmware/boards/firmware.mk BOARD="$board" B="$top" "$@"
}
build() { # BOARD NAME FLAGS
    firmware "$1" "$2" "$3" all >"$out/$1.log" 2>&1 && return
    cat "$out/$1.log"
    bad "$2 for $1" "does not build"
    exit 1
}
if [ "$what" = run ]; then # BOARD
    timeout 300 sh "$0" "$top" go "$3" >"$out/$3.csv" 2>"$out/$3.err"
    echo $? >"$out/$3.status"
    cat "$out/$3.err" >>"$out/$3.csv" # QEMU's semihosting may write to either
    exit
elif [ "$what" = go ]; then
    firmware "$3" bench '' run
    exit
fi

newer=$(find firmware/scenes/gen firmware/scenes/*.h -newer "$top/gen/meshes.h" 2>/dev/null | head -1)
if [ ! -e "$top/gen/meshes.h" ] || [ -n "$newer" ]; then
    gcc -O1 -std=c11 firmware/scenes/gen/*.c -o "$out/gen_meshes" && "$out/gen_meshes" "$top/gen" >/dev/null ||
        { bad "meshes" "the generator failed"; exit 1; }
fi
for board in host $boards; do
    build "$board" bench ''
done
# shellcheck disable=SC2086
printf '%s\n' $boards host | xargs -P 2 -n 1 sh "$0" "$top" run

# ---- One-pass frames against what is on record ------------------------------------------------------------------

compilers() {
    echo "compiler Arm $(${ARM}gcc -dumpversion)"
    echo "compiler RISC-V $(riscv64-unknown-elf-gcc -dumpversion)"
}
frames() { # "core scene instructions" a line
    for board in $boards; do
        awk -F, -v core="$(core "$board")" '$2 == "one-pass" && NF == 17 { print core, $1, $13 }' "$out/$board.csv"
    done
}
if [ "$what" = record ]; then
    for board in $boards; do
        [ "$(cat "$out/$board.status")" = 0 ] || { echo "bench on $board failed: see $out/$board.csv" >&2; exit 1; }
    done
    echo "# Instructions of one-pass frames (tests/checks/bench.sh). Recorded by make bench-record."
    compilers
    frames
    exit
fi

for board in host $boards; do
    status=$(cat "$out/$board.status")
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

compilers >"$out/compilers"
other=$(grep -vxFf "$record" "$out/compilers" | sed 's/compiler //' | tr '\n' ' ')
frames >"$out/frames"
awk -v other="$other" '
    BEGIN { hint = other == "" ? "" : "; the record is another compiler'\''s, this is " other }
    /^#|^compiler / { next }
    FNR == NR { old[$1 " " $2] = $3; order[++n] = $1 " " $2; next }
    { k = $1 " " $2; now[k] = $3
      if (!(k in old)) { bad++; print "FAILED instructions of " k ": not on record; make bench-record" } }
    END {
        for (i = 1; i <= n; i++) {
            k = order[i]
            if (!(k in now)) { bad++; print "FAILED instructions of " k ": on record, not counted" }
            else if (now[k] * 100 > old[k] * 102) {
                bad++
                printf "FAILED instructions of %s: %d a frame, %d on record, %.1f %% more%s\n", k, now[k], old[k],
                    (now[k] / old[k] - 1) * 100, hint
            } else if (now[k] * 100 < old[k] * 98) {
                better++
                printf "better: %s: %d a frame, %d on record, %.1f %% less\n", k, now[k], old[k],
                    (1 - now[k] / old[k]) * 100
            }
        }
        if (better) print better " frames take over 2 % less than on record: make bench-record"
        if (n && !bad) print "ok instructions of " n " one-pass frames: none over 2 % more than on record"
        if (!n) print "FAILED instructions: '"$record"' is empty"
    }' "$record" "$out/frames" >"$out/verdict"
cat "$out/verdict"
! grep -q '^FAILED' "$out/verdict" || failed=1

# ---- Tables ------------------------------------------------------------------------------------------------------

echo
echo "Cortex-M3 instructions a frame (QEMU mps2-an385 -icount; not cycles). One pass: strips of 24 rows, one buffer."
echo "64 KB: the quickest of strips of 24, 16 and 8 rows, two buffers; RAM is arena, renderer, scene state and stack."
awk -F, '
    /^#/ || $1 == "scene" || NF < 17 { next }
    $2 == "one-pass" { order[++n] = $1; one[$1] = $0; next }
    !($1 in least) || $13 < least[$1] { least[$1] = $13; small[$1] = $0 }
    END {
        printf "%-15s %6s %6s %7s %7s %8s %7s %7s %7s | %7s %8s %6s %6s  %s\n", "scene", "in", "drawn", "tested",
            "setups", "instr", "a tri", "a frag", "arena", "64 KB", "instr", "passes", "RAM", "checksum"
        for (i = 1; i <= n; i++) {
            split(one[order[i]], a, ","); split(small[order[i]], s, ",")
            printf "%-15s %6d %6d %7d %7d %7.2fM %7.0f %7.1f %7d | %7s %7.2fM %6d %6d  %s\n", a[1], a[6], a[7], a[10],
                a[8], a[13] / 1e6, a[14], a[15], a[11], s[2], s[13] / 1e6, s[5], s[17], a[12] } }' "$out/mps2.csv"

# What the double-precision reference says of the same frames: "scene wrong cover depth colour by-one", a line each
: >"$out/errors"
if [ "$what" = all ]; then
    if "$top/zsim" demo --frames 1 --out "$out/demo" >"$out/demo.txt" 2>"$out/demo.err"; then
        awk -F'|' '$NF ~ /[0-9]%/ { split($1, name, " "); gsub(/%/, "", $NF); print name[1], $NF }' "$out/demo.txt" \
            >"$out/errors"
        [ -s "$out/errors" ] || bad "errors of the frames" "none in $out/demo.txt"
    else
        bad "errors of the frames" "$(head -c 300 "$out/demo.err")"
    fi
fi

# A line for each core and scene. Frames on all cores are the same, and so is their error.
{
    echo "core,scene,instructions,per_triangle,per_fragment,wrong_percent,cover_percent,depth,colour_off,by_one_percent"
    for board in $boards; do
        awk -F, -v core="$(core "$board")" '
            FILENAME ~ /errors$/ { split($0, e, " "); errors[e[1]] = e[2] "," e[3] "," e[4] "," e[5] "," e[6]; next }
            $2 == "one-pass" && NF == 17 { print core "," $1 "," $13 "," $14 "," $15 "," \
                ($1 in errors ? errors[$1] : ",,,,") }' "$out/errors" "$out/$board.csv"
    done
} >"$out/bench.csv"

echo
echo "Instructions a frame by core, in millions; one pass, strips of 24 rows (QEMU -icount; not cycles)."
awk -F, '
    NR == 1 { next }
    !($1 in is) { is[$1] = 1; core[++cores] = $1 }
    !($2 in seen) { seen[$2] = 1; scene[++n] = $2 }
    { count[$1, $2] = $3; wrong[$2] = $6; rest[$2] = sprintf("%7s %9s %6s %7s", $7, $8, $9, $10) }
    END {
        with = wrong[scene[1]] != ""
        printf "%-16s", "scene"
        for (c = 1; c <= cores; c++) printf " %8s", core[c]
        print with ? " |  wrong   cover     depth colour  by one" : ""
        for (i = 1; i <= n; i++) {
            s = scene[i]
            printf "%-16s", s
            for (c = 1; c <= cores; c++) printf " %8.2f", count[core[c], s] / 1e6
            print with ? sprintf(" | %6s %s", wrong[s], rest[s]) : "" } }' "$out/bench.csv"
[ "$what" = all ] || exit $failed
echo "Error of the same frame against the double-precision reference. wrong: % of drawn pixels that show another triangle;"
echo "cover: % missing or too many; depth: mean relative error of distances; colour: channel values more than one code"
echo "off; by one: % of them one code off."

# ---- What each skip is worth --------------------------------------------------------------------------------------

build mps2 bench_skips -DBENCH_SKIPS=1
firmware mps2 bench_skips -DBENCH_SKIPS=1 run >"$out/skips.csv" 2>"$out/skips.err"
cat "$out/skips.err" >>"$out/skips.csv"
none "frames with each skip off" "$(grep -E '^# FAILED|error:' "$out/skips.csv" | tr ' ' '_')"
grep -q '^# ok' "$out/skips.csv" || bad "bench of skips ends" "see $out/skips.csv"
echo
echo "What each skip is worth on the Cortex-M3: instructions with all on, and times as many with one off. Below 1: it"
echo "costs more than it saves there. All rows have pools for everything, one pass but for bins."
awk -F, '
    NF != 17 || $1 == "scene" { next }
    $2 == "all" { all = $13; printf "%s%-16s %7.2fM", n++ ? "\n" : head(), $1, $13 / 1e6; next }
    { printf " %8.3f", $13 / all }
    function head() { return sprintf("%-16s %8s %8s %8s %8s %8s %8s %8s %8s %8s %8s\n", "scene", "all on", "frustum",
        "cliptest", "empty", "vcache", "bins", "hidden", "cluster", "cone", "bins+rows") }
    END { print "" }' "$out/skips.csv"
echo
echo "CSV: $out/bench.csv, $out/skips.csv, and $out/BOARD.csv of all configurations"
exit $failed
