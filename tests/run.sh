#!/bin/sh
# Run every test that `make test` has built, two side by side, show each by its name, and end with what was skipped and
# "N passed, N failed".
# Usage: tests/run.sh BUILD [PATTERN]          only the programs and scripts whose name holds PATTERN
#        tests/run.sh BUILD '' names            what there is
#        tests/run.sh BUILD PATTERN lane LANE   one of the two, host or boards: of use to this script alone
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1
only=${2:-}
logs=$build/test/logs
skipped=$logs/skipped.txt
mode=${3:-}
. tests/tally.sh

tell() { # NAME LOG STATUS
    tally "$@"
    ( # one log after the other: the lock goes with the descriptor
        flock 9
        echo "== $1: $ok passed, $bad failed"
        grep -vE '^\[( RUN  |======|  PASSED)' "$2" # verdicts and what was measured
    ) 9>"$logs/lock"
    grep '^SKIPPED ' "$2" >>"$skipped"
    echo "$ok $bad" >>"$counts"
}

run() { # NAME COMMAND...
    name=$1
    shift
    case $name in *"$only"*) ;; *) return 0 ;; esac
    [ "$mode" = names ] && echo "$name" && return
    "$@" >"$logs/$name.log" 2>&1
    tell "$name" "$logs/$name.log" $?
}

# What runs on this machine, and what has no accelerators, whose boards' objects are apart from others': scene_sums has
# some of them too, and waits for it.
host() {
    run bare flock "$logs/bare" sh tests/bare.sh "$build"
    for program in "$build"/test/test_*; do
        case $program in *.o | *.d) continue ;; esac
        [ -x "$program" ] && run "$(basename "$program")" "$program"
    done
    run readme sh tests/readme.sh "$build"
    run checksums sh tests/checksums.sh "$build"
    run convert sh tests/convert.sh "$build"
    run fuzz sh tests/fuzz/run.sh "$build" cut
    run stress sh tests/stress/run.sh "$build" cut
    run accuracy sh tests/accuracy.sh "$build/test/zsim"
    run cli sh tests/cli.sh "$build/test/zsim" "$build/test/cli"
    run cli_texture sh tests/cli_texture.sh "$build/test/zsim" "$build/test/cli_texture"
    run panels sh tests/panels.sh "$build/test/zsim" "$build/test/panels"
    run budget sh tests/budget.sh "$build/test/zsim" "$build/test/budget"
    run demo sh tests/demo.sh "$build/test/zsim" "$build/test/demo"
}

# What builds firmware, one after the other, because they share objects.
boards() {
    run pico sh tests/pico.sh "$build"
    run lm3s6965 sh tests/boards/lm3s6965.sh "$build"
    run stm32f405 sh tests/boards/stm32f405.sh "$build"
    run microbit sh tests/boards/microbit.sh "$build"
    run linux sh tests/linux.sh "$build"
    run scene_sums flock "$logs/bare" sh tests/scene_sums.sh "$build"
    for check in wide objects kernels hal includes shape designated headers stack size still cull scale bench; do
        run "$check" sh "tests/checks/$check.sh" "$build"
    done
    run study sh tests/study.sh "$build/test/zsim" "$build/test/study" "$build"
    run costs sh tests/checks/costs.sh "$build" quick
}

if [ "$mode" = names ]; then
    host
    boards
    exit
fi
mkdir -p "$logs"
# Each ends with a line of its own: one that stopped half way must not pass.
if [ "$mode" = lane ]; then
    counts=$logs/counts.$4
    : >"$counts"
    "$4"
    echo end >>"$counts"
    exit
fi

if [ -z "$(sh tests/run.sh "$build" "$only" names)" ]; then
    # shellcheck disable=SC2046
    echo "tests/run.sh: no name holds '$only'; there are" $(sh tests/run.sh "$build" '' names) >&2
    exit 1
fi
rm -f "$logs"/counts.*
: >"$skipped"
# In groups of their own, so that they end with this one, whatever they are at.
setsid sh tests/run.sh "$build" "$only" lane boards &
lane_boards=$!
setsid sh tests/run.sh "$build" "$only" lane host &
lane_host=$!
end_both() {
    kill -TERM "-$lane_boards" 2>/dev/null
    kill -TERM "-$lane_host" 2>/dev/null
    wait
}
trap 'trap "" PIPE; end_both; exit 1' HUP INT PIPE TERM
wait

echo
cat "$skipped"
for lane in host boards; do cat "$logs/counts.$lane"; done | awk '
    $1 == "end" { ends++; next }
    { passed += $1; failed += $2 }
    END {
        if (ends != 2) { print "FAILED tests: not all of them were run"; failed++ }
        print passed + 0 " passed, " failed + 0 " failed"
        exit failed > 0 }'
