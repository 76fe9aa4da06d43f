#!/bin/sh
# One checksum a scene, whatever the compiler, the level and the order of bytes; and the one on record.
# PowerPC is big-endian, and its programs run in QEMU.
# Usage: tests/property/checksums.sh BUILD
set -u
status=0
for program in "$1"/test/checksum-gcc-O0 "$1"/test/checksum-gcc-O3 "$1"/test/checksum-clang-O0 \
    "$1"/test/checksum-clang-O3 "$1"/test/checksum-powerpc-O0 "$1"/test/checksum-powerpc-O2 \
        "$1"/test/checksum-powerpc-Os; do
    name=$(basename "$program" | tr - _)
    case $name in *powerpc*) emulator=qemu-ppc-static ;; *) emulator= ;; esac
    $emulator "$program" >"$program.out" 2>&1
    if diff "$program.out" tests/records/checksums.txt >"$program.diff"; then
        echo "ok stress_28_$name ($(wc -l <"$program.out") scenes)"
    else
        echo "FAILED stress_28_$name: differs from tests/records/checksums.txt (< now, > on record)"
        cat "$program.diff"
        status=1
    fi
done
exit $status
