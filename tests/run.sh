#!/bin/sh
# Run every test that `make test` has built, two or three parts at a time: a line each with its seconds and its tests,
# what was skipped, which parts took longest, and at the end "N passed, N failed".
# Usage: tests/run.sh BUILD [PATTERN]           only the parts whose name holds PATTERN
#        tests/run.sh BUILD '' names            what there is
#        tests/run.sh BUILD '' record           tests/parts.txt with the seconds of the last whole run, on standard
#                                               output
#        tests/run.sh BUILD PATTERN lane LANE   one of the three workers: of use to this script alone
#
# tests/parts.txt lists the parts. The longest is started first, unless it waits for another or uses what one that runs
# uses. Of those that start many processes (`starts`) the first worker takes all that it can, and the second the others:
# two of them at once wait for each other in the kernel. A third worker takes those that sleep much of their time
# (`sleeps`). Seconds are of CPU, user and system.
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1
only=${2:-}
logs=$build/test/logs
skipped=$logs/skipped.txt
mode=${3:-}
parts=tests/parts.txt
. tests/lib/tally.sh
WERROR=-Werror # what parts compile by make
DEBUG= # and no test looks at what a debugger would: a fifth less to compile for boards
export WERROR DEBUG
. tests/lib/ccache.sh
# zsim and zlab are those that users have; with SANITIZE=1 the parts that run them, and no others, have them with ASan
# and UBSan (make sanitize): these start in five times the time, and each case of zsim's starts one
# shellcheck disable=SC2034
if [ -n "${SANITIZE:-}" ]; then
    zsim=$build/test/zsim zlab=$build/test/zlab only_if='[$]z(sim|lab)'
else
    zsim=$build/zsim zlab=$build/zlab only_if=
fi

# Name, seconds, uses and after of every part of this run, the longest first
list() {
    printf '%s\n' tests/*/test_*.c test_raster_narrow.c test_texture_narrow.c test_xform_narrow.c |
        awk -v only="$only" -v only_if="$only_if" '
            FILENAME != "-" { # what has a line
                if ($0 !~ /^#/) { listed[$1] = 1; if (index($1, only) && $0 ~ only_if) print $1, $2, $3, $4 }
                next
            }
            { # the programs that have none yet
                sub(/.*\//, ""); sub(/\.c$/, "")
                if (!($0 in listed) && index($0, only) && only_if == "") print $0 " - - -"
            }' $parts - | sort -k 2,2rn
}

# The command of a part: the rest of its line, or the program of its name
start() { # NAME
    command=$(awk -v name="$1" '$1 == name { $1 = $2 = $3 = $4 = ""; print }' $parts)
    case $command in
    *[!\ ]*) eval "$command" ;;
    *) "$build/test/$1" ;;
    esac
}

run() { # NAME
    begun=$(date +%s%N)
    : >"$logs/$1.times"
    (
        start "$1" >"$logs/$1.log" 2>&1
        status=$?
        times >"$logs/$1.times"
        exit $status
    )
    status=$?
    ms=$((($(date +%s%N) - begun) / 1000000))
    tally "$1" "$logs/$1.log" $status
    # what the shell itself took, and what all took that it has waited for
    cpu=$(tr 'ms' '  ' <"$logs/$1.times" | awk '{ s += $1 * 60 + $2 + $3 * 60 + $4 } END { printf "%.1f", s }')
    ( # one log after the other: the lock goes with the descriptor
        flock 9
        # shellcheck disable=SC2154
        echo "== $1: $ok passed, $bad failed, $((ms / 1000)).$((ms % 1000 / 100)) s, of CPU $cpu s"
        grep -vE '^(\[( RUN  |======|  PASSED)|SKIPPED )' "$logs/$1.log" # verdicts and what was measured
        grep '^SKIPPED ' "$logs/$1.log" | tee -a "$skipped"
        echo "$1 $ok $bad $ms $cpu" >>"$logs/counts"
    ) 9>"$logs/lock"
}

nobody_at_work() { # a worker's file holds its process while it runs a part or looks for one
    for lane in 1 2 3; do
        [ ! -s "$logs/lane.$lane" ] || ! kill -0 "$(cat "$logs/lane.$lane")" 2>/dev/null || return 1
    done
}

# What is to be run next; - where all that is left waits for something that runs; nothing at the end
next() { # LANE
    (
        flock 8
        awk -v begun="$logs/begun" -v counts="$logs/counts" -v lane="$1" '
            function free(uses, n, use, i) {
                n = split(uses, use, ",")
                for (i = 1; i <= n; i++)
                    if (use[i] !~ /^(-|starts|sleeps)$/ && use[i] in used) return 0
                return 1
            }
            function mine(name) { # the lane whose it is
                return uses[name] ~ /(^|,)sleeps(,|$)/ ? 3 : uses[name] ~ /(^|,)starts(,|$)/ ? 1 : 2
            }
            function ready(after, n, name, i) {
                n = split(after, name, ",")
                for (i = 1; i <= n; i++)
                    if (name[i] in uses && !(name[i] in ended)) return 0
                return 1
            }
            { order[++n] = $1; uses[$1] = $3; after[$1] = $4 }
            END {
                while ((getline line <counts) > 0) { split(line, f, " "); ended[f[1]] = 1 }
                while ((getline name <begun) > 0) {
                    started[name] = 1
                    if (name in ended) continue
                    m = split(uses[name], use, ",")
                    for (i = 1; i <= m; i++) used[use[i]] = 1
                }
                for (i = 1; i <= 2 * n; i++) { # its own first, then any
                    name = order[i > n ? i - n : i]
                    if (name in started || (i <= n || lane == 3) && mine(name) != lane) continue
                    if (free(uses[name]) && ready(after[name])) { print name; print name >>begun; exit }
                    left++
                }
                if (left) print "-"
            }' "$logs/queue"
    ) 8>"$logs/queue.lock"
}

case $mode in
names)
    list | cut -d ' ' -f 1
    exit ;;
lane)
    echo $$ >"$logs/lane.$4"
    waits=0
    while name=$(next "$4") && [ -n "$name" ]; do
        if [ "$name" != - ]; then
            waits=0
            run "$name"
            continue
        fi
        : >"$logs/lane.$4"
        ! nobody_at_work || waits=$((waits + 1))
        [ $waits -lt 10 ] || exit # who had the part that is waited for was ended by force
        sleep 0.2
        echo $$ >"$logs/lane.$4"
    done
    : >"$logs/lane.$4"
    exit ;;
record)
    awk 'FILENAME != "'$parts'" { seconds[$1] = $5; next }
        /^#/ || !($1 in seconds) { print; next }
        { line = $0; sub(/^[^ ]+ +[^ ]+/, "", line); s = seconds[$1]
          printf "%-20s %5.1f%s\n", $1, (s > 0.1 ? s : 0.1), line }' "$logs/counts" $parts
    exit ;;
'') ;;
*)
    echo "tests/run.sh: $mode is not names, record or lane" >&2
    exit 1 ;;
esac

queue=$(list)
if [ -z "$queue" ]; then
    # shellcheck disable=SC2046
    echo "tests/run.sh: no name holds '$only'; there are" $(sh tests/run.sh "$build" '' names) >&2
    exit 1
fi
mkdir -p "$logs"
echo "$queue" >"$logs/queue"
for file in counts begun skipped.txt lane.1 lane.2 lane.3; do : >"$logs/$file"; done
begun=$(date +%s)
# In groups of their own, so that they end with this one, whatever they are at.
setsid sh tests/run.sh "$build" "$only" lane 1 &
lane_1=$!
setsid sh tests/run.sh "$build" "$only" lane 2 &
lane_2=$!
setsid sh tests/run.sh "$build" "$only" lane 3 &
lane_3=$!
end_all() {
    kill -TERM "-$lane_1" 2>/dev/null
    kill -TERM "-$lane_2" 2>/dev/null
    kill -TERM "-$lane_3" 2>/dev/null
    wait
}
trap 'trap "" PIPE; end_all; exit 1' HUP INT PIPE TERM
wait

# Seconds, and shares scaled by what this machine took for all of it: part, passed, failed, seconds, of CPU, share
awk -v seconds=$(($(date +%s) - begun)) '
    FILENAME ~ /queue$/ { share[$1] = $2; next }
    { line[++n] = $0; name[n] = $1; cpu[n] = $5; all += $5; if (share[$1] > 0) { known += $5; shares += share[$1] } }
    END {
        scale = shares ? known / shares : 1
        for (i = 1; i <= n; i++) {
            split(line[i], f, " ")
            printf "%-20s %6d %6d %8.1f %8.1f %8s\n", f[1], f[2], f[3], f[4] / 1000, f[5],
                (share[f[1]] > 0 ? sprintf("%.1f", share[f[1]] * scale) : "-")
        }
        printf "all %d %.1f\n", seconds, all
    }' "$logs/queue" "$logs/counts" >"$logs/times"
{
    printf '%-20s %6s %6s %8s %8s %8s\n' part passed failed seconds CPU share
    grep -v '^all ' "$logs/times" | sort -k 5,5rn
} >"$logs/times.txt"

echo
head -16 "$logs/times.txt"
awk '$1 == "all" { printf "%d s, of CPU %d s; every part: '"$logs"'/times.txt\n", $2, $3 }' "$logs/times"
[ -z "${BEGUN:-}" ] || echo "$(($(date +%s) - BEGUN)) s in all, with what was set up and built"
# more than twice its share is told, not failed; half a second more or less does not count
awk '$1 != "all" && $6 > 0 && $5 > 2 * $6 + 1 {
        print "SLOW " $1 ": " $5 " s of CPU, its share is " $6 " s (tests/parts.txt)" }
    $1 != "all" && $6 == "-" { print "NO SHARE " $1 ": it has no seconds in tests/parts.txt" }' "$logs/times"
cat "$skipped"
awk '
    FILENAME ~ /queue$/ { todo[$1] = 1; next }
    { delete todo[$1]; passed += $2; failed += $3 }
    END {
        for (name in todo) { print "FAILED " name ": it was not run to its end"; failed++ }
        print passed + 0 " passed, " failed + 0 " failed"
        exit failed > 0 }' "$logs/queue" "$logs/counts"
