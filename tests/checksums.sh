#!/bin/sh
# Stress case 28: one checksum a scene, whatever the compiler and the level; and the one on record.
# Usage: tests/checksums.sh BUILD
set -u
status=0
for program in "$1"/test/checksum-gcc-O0 "$1"/test/checksum-gcc-O3 "$1"/test/checksum-clang-O0 \
    "$1"/test/checksum-clang-O3; do
    name=$(basename "$program" | tr - _)
    "$program" >"$program.out" 2>&1
    if diff "$program.out" tests/golden/checksums.txt >"$program.diff"; then
        echo "ok stress_28_$name ($(wc -l <"$program.out") scenes)"
    else
        echo "FAILED stress_28_$name: differs from tests/golden/checksums.txt (< now, > on record)"
        cat "$program.diff"
        status=1
    fi
done
exit $status
