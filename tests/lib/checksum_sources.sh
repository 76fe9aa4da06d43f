#!/bin/sh
# Which sources a program of tests/property/checksum.c links, a line each, for other compilers and levels: of gcc -O0,
# which leaves no call out. Behind each 1 where its text is another one without accelerators, by the preprocessor, and 0
# where it is the same.
# Usage: tests/lib/checksum_sources.sh PROGRAM COMPILER... -- SOURCE.c...     PROGRAM is .../checksum-gcc-O0, made
#
# SPDX-License-Identifier: MIT
set -eu
program=$1
shift
compiler=
while [ "$1" != -- ]; do
    compiler="$compiler $1"
    shift
done
shift
rm -f "$program.a"
ar rcs "$program.a" "$program.o"/firmware-*.o
# shellcheck disable=SC2086
$compiler "$program.o/tests-property-checksum.o" "$program.a" -Wl,-Map,"$program.map" -o "$program.linked"
members=$(awk '/^Archive member/ { on = 1 } /^(Discarded|Merging|As-needed|Memory)/ { on = 0 }
    on && match($1, /\(.*\.o\)$/) { print substr($1, RSTART + 1, RLENGTH - 2) }' "$program.map")
rm -f "$program.a" "$program.map" "$program.linked"
text() { # SOURCE OPTION...    as the compiler has it
    # shellcheck disable=SC2086
    $compiler -E -P "$@" | cksum
}
for source; do
    member=$(echo "${source%.c}.o" | tr / -)
    case " $(echo $members) tests-property-checksum.o " in
    *" $member "*)
        again=1
        [ "$(text "$source")" != "$(text "$source" -DZS_NO_FAST=1)" ] || again=0
        echo "$source $again" ;;
    esac
done
