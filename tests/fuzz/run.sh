#!/bin/sh
# The fuzzers: a small, fixed part of them, or both for some time, side by side.
# Usage: tests/fuzz/run.sh BUILD cut
#        tests/fuzz/run.sh BUILD SECONDS [SEED]
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
fuzz=${1:-build}/fuzz
ASAN_OPTIONS=detect_leaks=1
export ASAN_OPTIONS

if [ "${2:-cut}" = cut ]; then
    "$fuzz/fuzz_api" 1 cases 4000 || exit 1
    "$fuzz/cards" 1 cases 2500
    exit
fi
seconds=$2
seed=${3:-1}
mkdir -p "$fuzz/corpus"
"$fuzz/cards" write "$fuzz/corpus" 200 || exit 1
echo "for $seconds seconds, from seed $seed"
"$fuzz/fuzz_mesh" -max_total_time="$seconds" -seed="$seed" -max_len=12000 -timeout=60 -artifact_prefix="$fuzz/" \
    "$fuzz/corpus" >"$fuzz/fuzz_mesh.log" 2>&1 &
mesh=$!
"$fuzz/fuzz_api" "$seed" seconds "$seconds"
failed=$?
if wait "$mesh"; then
    echo "ok fuzz_mesh: $(grep '^Done' "$fuzz/fuzz_mesh.log"); $(grep 'cov:' "$fuzz/fuzz_mesh.log" | tail -1)"
else
    failed=1
    grep -E '^wrong|ERROR|SUMMARY|    #[0-9] ' "$fuzz/fuzz_mesh.log" | head -20
    file=$(sed -n 's/.*Test unit written to //p' "$fuzz/fuzz_mesh.log")
    echo "FAILED fuzz_mesh: replay with: $fuzz/cards replay $file"
fi
exit "$failed"
