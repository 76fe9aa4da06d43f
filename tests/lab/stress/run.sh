#!/bin/sh
# The stress runner: triangles against whole numbers, frames against the plainest way. What was reached is kept in
# BUILD/stress/tris.txt and frames.txt; another run goes on behind the last seed.
# Usage: tests/lab/stress/run.sh BUILD SECONDS [tris|frames] [fast]   so long, both kinds half of it each, under ASan
#                                            and UBSan; fast: as shipped, without them
#        tests/lab/stress/run.sh BUILD cut       a small, fixed part; what was reached stays as it is
#        tests/lab/stress/run.sh BUILD figures   what was reached
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../../.." || exit 2
S=${1:-build}/stress
ASAN_OPTIONS=detect_leaks=1:handle_sigill=2
export ASAN_OPTIONS

# The code that runs: the commit that changed the renderer last, with a + where it was changed since.
code() {
    commit=$(git log -1 --format=%h -- firmware/zstrip 2>/dev/null)
    [ -z "$(git status --porcelain firmware/zstrip 2>/dev/null)" ] || commit=$commit+
    echo "${commit:-unknown}"
}

figures() { # the first line as tests/records/age.sh reads it: the code of the newest seeds
    newest=$(tail -qn 1 "$S"/tris.txt "$S"/frames.txt 2>/dev/null | cut -d/ -f1 | tr -d + | tail -1)
    echo "Of commit $newest: firmware/zstrip"
    echo
    echo "Stress (make stress): what has been reached with which commit of the renderer; san: under ASan and UBSan"
    echo
    echo "kind    renderer   build      seeds                triangles        frames          pixels  a CPU s findings"
    for kind in tris frames; do
        [ -f "$S/$kind.txt" ] || continue
        awk -v kind=$kind '{
            split($1, n, "/")
            units = $5
            printf "%-7s %-10s %-10s %-16s %13.0f %13.0f %15.0f %8.0f %9d\n", kind, n[1], n[2], $2 "-" $3 - 1,
                   $7, kind == "tris" ? $6 : $5, $8, $10 ? units / $10 : 0, $9
        }' "$S/$kind.txt"
    done
    echo
    for kind in tris:7:1000000000:triangles frames:5:10000000:frames; do
        IFS=: read -r name column goal words <<END
$kind
END
        [ -f "$S/$name.txt" ] || continue
        awk -v column="$column" -v goal="$goal" -v words="$words" '
            $1 ~ /\/san$/ { n += $column; s += $10; bad += $9 }
            END { if (s) printf "%s under ASan and UBSan: %.0f of %.0f, %.2f %%; %d findings; " \
                                "all would take %.1f hours of a core\n",
                         words, n, goal, 100 * n / goal, bad, goal / (n / s) / 3600 }' "$S/$name.txt"
    done
    for kind in tris frames; do
        [ -f "$S/$kind.txt" ] && echo && "$S/san" $kind seen "$S/$kind.txt"
    done
    cat <<'END'

tris: random triangles of all kinds whose corners lie on 1/256 px, thousands a frame, in strips, pools and with
accelerators at random. Each pixel is that of the nearest triangle that covers it by whole numbers (within 1.0101
buckets, exactly where keys are flat), its key within 0.505 bucket of the exact plane; hidden triangles count by the
pixels that they test.
frames: scenes that move, 64x64 (mostly) to 160x96, all shaders, mappings, states, clusters; strips, pools,
buffers, accelerators, zs_damage_compare, zs_damage_track, zs_invalidate and shared strips at random, each frame eight
ways against one strip, large pools and no accelerators. Counted are the ways compared, of frames of which 32 triangles
and more were drawn (smaller ones were compared too). It did something: touch, tiles, clusters by what a frame's counts
say; shaders and texel formats where an instance has them; batch and edges always.
Pixels of tris are covered ones, of frames all.
END
}

case ${2:-} in
cut)
    cases=230
    failed=0
    for kind in tris frames; do
        rm -f "$S/cut-$kind.txt"
        if ! "$S/cut" $kind "$S/cut-$kind.txt" cut cases $((cases - 1)) >"$S/cut.log" 2>&1 ||
            ! "$S/cut" $kind "$S/cut-$kind.txt" cut cases 1 >>"$S/cut.log" 2>&1; then
            cat "$S/cut.log"
            failed=1
            continue
        fi
        if "$S/cut" $kind seen "$S/cut-$kind.txt" >"$S/cut.log"; then
            echo "ok stress_${kind}_seen: every accelerator listed and not, and all else that frames should have had"
        else
            echo "FAILED stress_${kind}_seen: never were:"
            cat "$S/cut.log"
            failed=1
        fi
        awk -v cases="$cases" -v kind=$kind '
            { good = $2 == 1 && $3 == cases + 1 && $4 == cases && $9 == 0 && $5 > 0 && NR == 1 }
            END { printf "%s stress_%s: seeds 1 to %d in two runs: %d triangles, %d frames, %d pixels\n",
                         good ? "ok" : "FAILED", kind, $3 - 1, $7, $6, $8
                  exit !good }' "$S/cut-$kind.txt" || failed=1
    done
    exit $failed
    ;;
figures)
    figures
    exit
    ;;
esac
seconds=$2
kinds=${3:-tris frames}
build=${4:-san}
[ "$kinds" = "tris frames" ] && seconds=$((seconds / 2))
failed=0
for kind in $kinds; do
    nice "$S/$build" "$kind" "$S/$kind.txt" "$(code)/$build" "$seconds" || failed=1
done
figures >"$S/figures.txt"
grep ' of .*findings' "$S/figures.txt"
exit $failed
