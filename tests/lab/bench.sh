#!/bin/sh
# The bench on QEMU's Cortex-M0, M3, M4, M7 and RISC-V beside the same program on this machine: every frame's checksum,
# counts and pools must agree line by line, and no one-pass frame may take over 2 % more instructions than
# tests/records/bench.txt has on record. Strips cost less than 15 % more than one strip of the frame's height; frames
# fit into the RAM that is promised. Instructions are not cycles.
#
# M0: code for Armv6-M, counted on the machine of the M3, which has the same instructions and more of them; QEMU's
# only M0 has 16 KB of RAM.
#
# Usage: tests/lab/bench.sh BUILD          the checks, and what frames take
#        tests/lab/bench.sh BUILD all      besides: each frame's error, cycles on an emulated RP2040, instructions on
#                                             this machine (callgrind), what others take, what each accelerator is worth
#                                             (accelerators.sh); CSV in BUILD/bench; needs BUILD/zsim, valgrind, npm
#        tests/lab/bench.sh BUILD record   the one-pass frames as lines for tests/records/bench.txt
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

what=${2:-}
out=$top/bench
record=tests/records/bench.txt
peers=tests/lab/peers.txt
boards="m0 mps2 mps2-m4 mps2-m7 rv32"
counted= # where what a frame takes is counted from outside
[ "$what" != all ] || counted="pico $(uname -m)"
STRIPS_MAX=15                   # per cent that strips of 24 rows may cost on top of one strip ...
STRIPS_OF="mesh mesh_tex relief relief_tex layers_ftb layers_btf layers_mixed sheet" # there
ORDER_MAX=10                    # per cent that another order than front to back may cost
PICO_ARENA=188416               # bytes that the bench's code and data leave of the RP2040's RAM, and some room
mkdir -p "$out" "$top/gen"

core() { # BOARD
    case $1 in
    m0) echo M0 ;; mps2) echo M3 ;; mps2-m4) echo M4 ;; mps2-m7) echo M7 ;; rv32) echo rv32imc ;; pico) echo RP2040 ;;
    x86_64) echo x86-64 ;; *) echo "$1" ;;
    esac
}
firmware() { # BOARD NAME FLAGS GOAL
    set -- "$1" "$4" NAME="$2" APP_SRC=firmware/app/bench.c APP_FLAGS="$3"
    board=$1
    shift
    [ "$board" != m0 ] || set -- "$@" BOARD_CPU='-mcpu=cortex-m0 -mthumb' OUT="$top/fw/mps2-armv6m"
    [ "$board" != m0 ] || board=mps2
    make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD="$board" B="$top" "$@"
}
build() { # BOARD NAME FLAGS [GOAL]
    firmware "$1" "$2" "$3" "${4:-all}" >"$out/$1.log" 2>&1 && return
    cat "$out/$1.log"
    bad "$2 for $1" "does not build"
    exit 1
}
progress() { # TEXT    on a terminal alone
    [ ! -t 2 ] || printf '\r\033[K%s' "${1:+$1 ...}" >&2
}
# Callgrind writes a file a call of bench_frame, numbered from 1: their totals in place of the scenes' instructions
host_counts() {
    rm -f "$out"/calls.out*
    valgrind --tool=callgrind --toggle-collect=bench_frame --dump-after=bench_frame \
        --callgrind-out-file="$out/calls.out" "$top/fw/host/bench_counted.elf" >"$out/calls.csv" 2>"$out/calls.err" ||
        { cat "$out/calls.err"; return 1; }
    awk -F, -v OFS=, -v stem="$out/calls.out." '
        NF == 17 && $13 == 0 {
            n++
            file = stem n
            while ((getline text <file) > 0)
                if (text ~ /^totals: /) $13 = substr(text, 9) + 0
            close(file)
            $14 = sprintf("%.1f", $13 / $6); $15 = sprintf("%.1f", $13 / $10) }
        { print }' "$out/calls.csv"
    rm -f "$out"/calls.out*
}
if [ "$what" = run ]; then # BOARD
    progress "$(core "$3")"
    timeout 600 sh "$0" "$top" go "$3" >"$out/$3.csv" 2>"$out/$3.err"
    echo $? >"$out/$3.status"
    cat "$out/$3.err" >>"$out/$3.csv" # QEMU's semihosting may write to either
    exit
elif [ "$what" = go ]; then
    case $3 in
    pico) cd "$top/pico" && exec node bench.mjs ../fw/pico/bench_counted ;;
    "$(uname -m)") host_counts ;;
    *) firmware "$3" bench '' run ;;
    esac
    exit
fi

newer=$(find firmware/scenes/gen firmware/scenes/*.h -newer "$top/gen/meshes.h" 2>/dev/null | head -1)
if [ ! -e "$top/gen/meshes.h" ] || [ -n "$newer" ]; then
    gcc -O1 -std=c11 firmware/scenes/gen/*.c -o "$out/gen_meshes" && "$out/gen_meshes" "$top/gen" >/dev/null ||
        { bad "meshes" "the generator failed"; exit 1; }
fi
for board in host $boards; do
    progress "building for $board"
    build "$board" bench ''
done
sh "$0" "$top" run host
if [ "$what" = all ]; then # the pools that take a scene in one pass, as C that the compiler includes
    awk -F, '
        $2 == "one-pass" && NF == 17 { printf "%s{ \"%s\", %s, %s }", n++ ? ", " : "#define BENCH_POOLS ", $1, $3, $4 }
        END { print "" }' "$out/host.csv" >"$out/pools.new"
    cmp -s "$out/pools.new" "$out/pools.h" || cp "$out/pools.new" "$out/pools.h"
    progress "building for the RP2040"
    build host bench_counted "-include $out/pools.h"
    build pico bench_counted "-include $out/pools.h -DBENCH_ARENA=$PICO_ARENA" image
    sh tests/boards/pico.sh "$top" set-up || exit 1
else
    build pico bench_counted "-DBENCH_ARENA=$PICO_ARENA" image # it fits; make bench runs it
fi
# shellcheck disable=SC2086
printf '%s\n' $counted $boards | xargs -P "$(nproc)" -n 1 sh "$0" "$top" run
progress

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
    echo "# Instructions of one-pass frames (tests/lab/bench.sh). Recorded by make bench-record."
    compilers
    frames
    exit
fi

for board in host $boards $counted; do
    status=$(cat "$out/$board.status")
    none "bench on $board" "$(grep -E '^# FAILED|^# problem|[Ee]rror:' "$out/$board.csv" | tr ' ' '_')"
    { [ "$status" = 0 ] && grep -q '^# ok' "$out/$board.csv"; } || bad "bench on $board ends" "status $status"
    [ "$board" != host ] || continue
    agree="$(core "$board") and host agree"
    columns=1-12
    case " $counted " in
    *" $board "*) # pools may be cut there
        columns=1,12
        none "$(core "$board") is counted" "$(awk -F, 'NF == 17 && $13 == 0 { print $1 }' "$out/$board.csv")"
        ;;
    esac
    for one in host "$board"; do
        awk -F, -v all="$columns" 'NF == 17 && (all == "1-12" || $2 == "one-pass" || $2 == "cut")' "$out/$one.csv" |
            cut -d, -f$columns >"$out/$one.frames"
    done
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
    BEGIN {
        hint = other == "" ? "" : "; the record is another compiler'\''s, this is " other
        most = other == "" ? 2 : 25 # per cent
    }
    /^#|^compiler / { next }
    FNR == NR { old[$1 " " $2] = $3; order[++n] = $1 " " $2; next }
    { k = $1 " " $2; now[k] = $3
      if (!(k in old)) { bad++; print "FAILED instructions of " k ": not on record; make bench-record" } }
    END {
        for (i = 1; i <= n; i++) {
            k = order[i]
            if (!(k in now)) { bad++; print "FAILED instructions of " k ": on record, not counted" }
            else if (now[k] * 100 > old[k] * (100 + most)) {
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
        if (n && !bad) print "ok instructions of " n " one-pass frames: none over " most " % more than on record" hint
        if (!n) print "FAILED instructions: '"$record"' is empty"
    }' "$record" "$out/frames" >"$out/verdict"
cat "$out/verdict"
! grep -q '^FAILED' "$out/verdict" || failed=1

# ---- Strips, and RAM --------------------------------------------------------------------------------------------

# SCENE: what strips of 24 rows take on top of one strip, per cent by core
for scene in $STRIPS_OF; do
    for board in $boards; do
        awk -F, -v core="$(core "$board")" -v scene="$scene" '
            $1 == scene && $2 == "one-pass" { strips = $13 }
            $1 == scene && $2 == "one-strip" { one = $13 }
            END { if (one > 0 && strips > 0) printf "%s %.1f\n", core, (strips / one - 1) * 100
                  else print core, "unknown" }' "$out/$board.csv"
    done >"$out/strips"
    name="$scene in ten strips costs less than $STRIPS_MAX % more than in one"
    over=$(awk -v most=$STRIPS_MAX '$2 == "unknown" || $2 >= most { print $1 }' "$out/strips" | tr '\n' ' ')
    said=$(awk '{ printf "%s%s +%s %%", n++ ? ", " : "", $1, $2 }' "$out/strips")
    if [ -z "$over" ]; then ok "$name: $said"; else bad "$name" "$said"; fi
done

# What the same layers cost in another order, per cent on top of front to back
for scene in layers_btf layers_mixed; do
    said=$(for board in $boards; do
        awk -F, -v core="$(core "$board")" -v scene="$scene" -v first="${scene%%_*}_ftb" '
            $2 == "one-pass" { n[$1] = $13 }
            END { if (n[first] > 0 && n[scene] > 0) printf "%s %+.1f\n", core, (n[scene] / n[first] - 1) * 100
                  else print core, "unknown" }' "$out/$board.csv"
    done)
    name="$scene costs less than $ORDER_MAX % more than front to back"
    over=$(echo "$said" | awk -v most=$ORDER_MAX '$2 == "unknown" || $2 >= most { print $1 }')
    said=$(echo "$said" | awk '{ printf "%s%s %s %%", n++ ? ", " : "", $1, $2 }')
    if [ -z "$over" ]; then ok "$name: $said"; else bad "$name" "$said"; fi
done

# The quickest of the configurations that a bar of RAM leaves, and whether it holds: SCENE BAR BYTES WHAT
bar() {
    awk -F, -v scene="$1" -v bar="$2" '
        $1 == scene && index($2, bar "-") == 1 && NF == 17 && $16 > 0 && (!best || $13 < best) { best = $13; line = $0 }
        END { print line }' "$out/mps2.csv" >"$out/bar"
    IFS=, read -r _ variant tris verts passes _ _ _ _ _ arena _ instructions _ _ stack ram <"$out/bar"
    name="$1, $4, in $3 bytes of RAM"
    [ -n "${ram:-}" ] || { bad "$name" "not measured"; return; }
    said="$ram (arena $arena, stack $stack, renderer and scene state $((ram - arena - stack)));"
    said="$said strips of ${variant#*-} rows, $tris triangles, $verts vertices, $passes passes,"
    said="$said $instructions instructions on the M3"
    if [ "$ram" -le "$3" ]; then ok "$name: $said"; else bad "$name" "$said"; fi
}
bar relief_tex 64k 65536 "320x240, two strip buffers"
bar relief_tex 48k 49152 "240x240, two strip buffers"
bar relief 16k 16384 "160x128"
bar relief_tex 16k 16384 "160x128"

# ---- Tables ------------------------------------------------------------------------------------------------------

echo
cat <<END
Cortex-M3 instructions a frame (QEMU mps2-an385 -icount; not cycles). One pass: strips of 24 rows, one buffer; strip:
times as many as in one strip of all rows. 64 KB: the quickest of strips of 24, 16 and 8 rows, two buffers; RAM is
arena, renderer, scene state and stack.
END
awk -F, '
    /^#/ || $1 == "scene" || NF < 17 { next }
    $2 == "one-pass" { order[++n] = $1; one[$1] = $0; next }
    $2 == "one-strip" { strip[$1] = $13 }
    $2 ~ /^64k/ && (!($1 in least) || $13 < least[$1]) { least[$1] = $13; small[$1] = $0 }
    END {
        printf "%-15s %6s %6s %7s %7s %8s %7s %7s %6s %7s | %7s %8s %6s %6s  %s\n", "scene", "in", "drawn", "tested",
            "setups", "instr", "a tri", "a frag", "strip", "arena", "64 KB", "instr", "passes", "RAM", "checksum"
        for (i = 1; i <= n; i++) {
            split(one[order[i]], a, ","); split(small[order[i]], s, ",")
            printf "%-15s %6d %6d %7d %7d %7.2fM %7.0f %7.1f %6.3f %7d | ", a[1], a[6], a[7], a[10], a[8], a[13] / 1e6,
                a[14], a[15], a[13] / strip[a[1]], a[11]
            if (s[2] != "") printf "%7s %7.2fM %6d %6d  %s\n", s[2], s[13] / 1e6, s[5], s[17], a[12]
            else printf "%7s %8s %6s %6s  %s\n", "-", "-", "-", "-", a[12]
        }
    }' "$out/mps2.csv"

# What the double-precision reference says of the same frames: "scene wrong cover depth colour by-one", a line each
: >"$out/errors"
if [ "$what" = all ]; then
    progress "errors of the frames"
    if "$top/zsim" demo --frames 1 --out "$out/demo" >"$out/demo.txt" 2>"$out/demo.err"; then
        awk -F'|' '$NF ~ /[0-9]%/ { split($1, name, " "); gsub(/%/, "", $NF); print name[1], $NF }' "$out/demo.txt" \
            >"$out/errors"
        [ -s "$out/errors" ] || bad "errors of the frames" "none in $out/demo.txt"
    else
        bad "errors of the frames" "$(head -c 300 "$out/demo.err")"
    fi
    progress
fi

# A line for each core and scene. Frames on all cores are the same, and so is their error. `count` is of instructions,
# on the RP2040 of cycles.
{
    echo "core,scene,count,per_triangle,per_fragment,wrong_percent,cover_percent,depth,colour_off,by_one_percent,\
passes,of"
    for board in $boards $counted; do
        of=instructions
        [ "$board" != pico ] || of=cycles
        awk -F, -v core="$(core "$board")" -v of=$of '
            FILENAME ~ /errors$/ { split($0, e, " "); errors[e[1]] = e[2] "," e[3] "," e[4] "," e[5] "," e[6]; next }
            ($2 == "one-pass" || $2 == "cut") && NF == 17 { print core "," $1 "," $13 "," $14 "," $15 "," \
                ($1 in errors ? errors[$1] : ",,,,") "," $5 "," of }' "$out/errors" "$out/$board.csv"
    done
} >"$out/bench.csv"

echo
echo "Instructions a frame by core, in millions; one pass, strips of 24 rows (QEMU -icount; not cycles)."
[ "$what" != all ] || cat <<END
RP2040: millions of cycles (rp2040js), -O3, code in RAM; the emulator has no flash wait states: a lower bound. * its RAM
does not hold the pools of one pass. $(core "$(uname -m)"): callgrind, reported alone.
END
awk -F, '
    NR == 1 { next }
    !($1 in is) { is[$1] = 1; core[++cores] = $1 }
    !($2 in seen) { seen[$2] = 1; scene[++n] = $2 }
    { count[$1, $2] = $3; passes[$1, $2] = $11; wrong[$2] = $6; rest[$2] = sprintf("%7s %9s %6s %7s", $7, $8, $9, $10) }
    END {
        with = wrong[scene[1]] != ""
        printf "%-16s", "scene"
        for (c = 1; c <= cores; c++) printf " %8s", core[c]
        print with ? " |  wrong   cover     depth colour  by one" : ""
        for (i = 1; i <= n; i++) {
            s = scene[i]
            printf "%-16s", s
            for (c = 1; c <= cores; c++)
                printf " %8s", sprintf("%s%.2f", passes[core[c], s] > 1 ? "*" : "", count[core[c], s] / 1e6)
            print with ? sprintf(" | %6s %s", wrong[s], rest[s]) : "" } }' "$out/bench.csv"
[ "$what" = all ] || exit $failed
cat <<END
Error of the same frame against the double-precision reference. wrong: % of drawn pixels that show another triangle;
cover: % missing or too many; depth: mean relative error of distances; colour: channel values more than one code
off; by one: % of them one code off.
END
awk -F, -v arena=$PICO_ARENA '$1 == "RP2040" && $11 > 1 {
    print "On the RP2040 " $2 " takes " $11 " passes: " arena " bytes of arena do not hold its pools."
}' "$out/bench.csv"
awk '$1 == "#" && $2 == "in_flash" { print "At most " $3 " % of a frame on it ran from flash." }' "$out/pico.csv"

echo
echo "The same a triangle that came in and a fragment that was tested."
awk -F, '
    NR == 1 { next }
    !($1 in is) { is[$1] = 1; core[++cores] = $1 }
    !($2 in seen) { seen[$2] = 1; scene[++n] = $2 }
    { tri[$1, $2] = $4; frag[$1, $2] = $5 }
    END {
        printf "%-16s", "scene"
        for (c = 1; c <= cores; c++) printf " %16s", core[c]
        for (i = 1; i <= n; i++) {
            printf "\n%-16s", scene[i]
            for (c = 1; c <= cores; c++) printf " %8.0f %7.1f", tri[core[c], scene[i]], frag[core[c], scene[i]] }
        print "" }' "$out/bench.csv"

# ---- Beside others ------------------------------------------------------------------------------------------------

echo
echo "Beside others: millions of instructions of the same scenes ($peers), the best of each row and what we take of it."
echo "M4F: theirs with an FPU, ours without (M4)."
awk -F, '
    FILENAME ~ /peers.txt$/ {
        if ($0 ~ /^#/) next
        split($0, p, " ")
        k = p[1] " " p[2]
        if (!(k in best)) order[++n] = k
        if (!(k in best) || p[4] < best[k]) { best[k] = p[4]; name[k] = p[3] }
        next
    }
    { count[$1 " " $2] = $3; if ($1 == "M4") count["M4F " $2] = $3 }
    END {
        printf "%-7s %-12s %8s %8s %-11s %6s\n", "core", "scene", "ours", "best", "", "ratio"
        for (i = 1; i <= n; i++) {
            k = order[i]
            if (!(k in count)) continue
            split(k, p, " ")
            ratio = count[k] / 1e6 / best[k]
            printf "%-7s %-12s %8.2f %8.2f %-11s %6.2f %s\n", p[1], p[2], count[k] / 1e6, best[k], name[k], ratio,
                ratio < 0.5 ? "" : "not under half"
            rows++; under += ratio < 0.5
        }
        print "Under half of the best other: " under + 0 " of " rows + 0 }' "$peers" "$out/bench.csv" | tee "$out/peers"

sh tests/lab/accelerators.sh "$top" || failed=1
echo
echo "CSV: $out/bench.csv, $top/accelerators/fast.csv, and $out/BOARD.csv of all configurations"
exit $failed
