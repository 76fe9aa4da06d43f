#!/bin/sh
# The fuzzers: a small, fixed part of them, or each for some time, two side by side.
# Usage: tests/lab/fuzz/run.sh BUILD cut
#        tests/lab/fuzz/run.sh BUILD SECONDS [SEED]
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../../.." || exit 2
fuzz=${1:-build}/fuzz
ASAN_OPTIONS=detect_leaks=1:handle_sigill=2
LSAN_OPTIONS=suppressions=tests/lib/lsan.txt:print_suppressions=0
export ASAN_OPTIONS LSAN_OPTIONS

if [ "${2:-cut}" = cut ]; then
    failed=0
    "$fuzz/fuzz_api" 1 cases 4000 || failed=1
    "$fuzz/cards" 1 cases 2500 || failed=1
    "$fuzz/fuzz_scan" tests/lab/fuzz/corpus/scan.txt 1 cases 20000 || failed=1
    "$fuzz/fuzz_options" tests/lab/fuzz/corpus/options.txt 1 cases 10000 || failed=1
    "$fuzz/fuzz_panel" tests/lab/fuzz/corpus/panel.txt 1 cases 400 || failed=1
    exit $failed
fi
seconds=$2
seed=${3:-1}

# NAME PROGRAM REPLAY MAX_LEN: a libFuzzer target, from build/fuzz/corpus-NAME, which grows.
lib() {
    "$fuzz/$2" -max_total_time="$seconds" -seed="$seed" -max_len="$4" -timeout=60 -artifact_prefix="$fuzz/$1-" \
        "$fuzz/corpus-$1" >"$fuzz/$1.log" 2>&1 && {
        echo "ok $1: $(grep '^Done' "$fuzz/$1.log"); $(grep 'cov:' "$fuzz/$1.log" | tail -1)"
        return
    }
    grep -E '^wrong|ERROR|SUMMARY|    #[0-9] ' "$fuzz/$1.log" | head -20
    file=$(sed -n 's/.*Test unit written to //p' "$fuzz/$1.log")
    echo "FAILED $1: replay with: $fuzz/$3 replay $file"
    return 1
}

for name in mesh scan options panel; do
    mkdir -p "$fuzz/corpus-fuzz_$name"
done
"$fuzz/cards" write "$fuzz/corpus-fuzz_mesh" 200 || exit 1
for name in scan options panel; do
    "$fuzz/fuzz_$name" "tests/lab/fuzz/corpus/$name.txt" write "$fuzz/corpus-fuzz_$name" || exit 1
done
echo "each for $seconds seconds, from seed $seed"
(
    lane=0
    lib fuzz_mesh fuzz_mesh cards 12000 || lane=1
    lib fuzz_options lf_fuzz_options fuzz_options 400 || lane=1
    exit $lane
) &
beside=$!
failed=0
"$fuzz/fuzz_api" "$seed" seconds "$seconds" || failed=1
lib fuzz_scan lf_fuzz_scan fuzz_scan 2000 || failed=1
lib fuzz_panel lf_fuzz_panel fuzz_panel 4000 || failed=1
wait "$beside" || failed=1
exit "$failed"
