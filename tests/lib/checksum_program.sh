#!/bin/sh
# tests/property/checksum.c with the renderer, by one compiler at one level; or the same without accelerators, of which
# only those objects are compiled again whose text is another one.
# Usage: tests/lib/checksum_program.sh PROGRAM COMPILER... -- SOURCE.c...         PROGRAM is .../checksum-NAME
#        tests/lib/checksum_program.sh PROGRAM COMPILER... -- of LIST             those of checksum_sources.sh alone
#        tests/lib/checksum_program.sh PROGRAM COMPILER... -- bare LIST WITH      WITH: the program with accelerators
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
rm -rf "$program.o"
mkdir -p "$program.o"
with= more=
case $1 in
of) plan=$(awk '{ print $1, 1 }' "$2") ;;
bare)
    plan=$(grep -v '^firmware/zstrip/fast/' "$2")
    with=$3 more=-DZS_NO_FAST=1 ;;
*) plan=$(printf '%s 1\n' "$@") ;;
esac
objects=
while read -r source again; do
    object=$(echo "${source%.c}.o" | tr / -)
    if [ "$again" = 0 ]; then
        objects="$objects $with.o/$object"
        continue
    fi
    # shellcheck disable=SC2086
    $compiler $more -c "$source" -o "$program.o/$object"
    objects="$objects $program.o/$object"
done <<END
$plan
END
# shellcheck disable=SC2086
$compiler $objects -o "$program"
