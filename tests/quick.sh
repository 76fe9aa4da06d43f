#!/bin/sh
# Run unit test programs, as many side by side as there are processors, those first that took longest the last time:
# a line each with its seconds, the log of what fails, and at the end "N passed, N failed".
# Usage: tests/quick.sh BUILD NAME...
#        tests/quick.sh BUILD one NAME   of use to this script alone
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1
shift
logs=$build/test/logs
counts=$logs/counts.quick
mkdir -p "$logs"
. tests/lib/tally.sh

if [ "$1" = one ]; then
    name=$2
    log=$logs/$name.log
    start=$(date +%s%N)
    "$build/test/$name" >"$log" 2>&1
    tally "$name" "$log" $?
    ms=$((($(date +%s%N) - start) / 1000000))
    echo "$ms" >"$logs/$name.ms"
    echo "$ok $bad" >>"$counts"
    ( # one log after the other: the lock goes with the descriptor
        flock 9
        printf '%-20s %4d.%d s  %3d passed, %d failed\n' "$name" $((ms / 1000)) $((ms % 1000 / 100)) "$ok" "$bad"
        [ "$bad" -eq 0 ] || cat "$log"
    ) 9>"$logs/lock"
    exit
fi

: >"$counts"
start=$(date +%s)
for name; do
    echo "$(cat "$logs/$name.ms" 2>/dev/null || echo 999999) $name"
done | sort -rn | cut -d ' ' -f 2 | xargs -P "$(nproc)" -n 1 sh tests/quick.sh "$build" one
echo "$# programs in $(($(date +%s) - start)) s"
[ -z "${BEGUN:-}" ] || echo "$(($(date +%s) - BEGUN)) s in all, with what was built"
awk -v programs=$# '
    { passed += $1; failed += $2 }
    END {
        if (NR != programs) { print "FAILED tests: not all of them were run"; failed++ }
        print passed + 0 " passed, " failed + 0 " failed"
        exit failed > 0 }' "$counts"
