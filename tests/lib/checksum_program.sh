#!/bin/sh
# tests/property/checksum.c with the renderer, by one compiler at one level; or the same without accelerators. Most
# objects of the latter are those of the former: what is compiled again reads ZS_NO_FAST, by itself or by a header.
# Usage: tests/lib/checksum_program.sh PROGRAM COMPILER... -- SOURCE.c...           PROGRAM is .../checksum-NAME
#        tests/lib/checksum_program.sh PROGRAM COMPILER... -- SOURCE.c... bare WITH  WITH: the program with accelerators
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
sources=
while [ $# -gt 0 ] && [ "$1" != bare ]; do
    sources="$sources $1"
    shift
done
with=${2:-}
rm -rf "$program.o"
mkdir -p "$program.o"
# of zs_fast.h and core/fast.h it is macros that read it: what names one of them
names='ZS_NO_FAST|ZS_IF_FAST|ZS_FAST_[A-Z0-9_]+'
for source in $sources; do
    object=$(echo "${source%.c}" | tr / -).o
    if [ -n "$with" ]; then
        reads=$(sed 's/^[^:]*://; s/\\$//' "$with.o/${object%.o}.d" | tr ' ' '\n' |
            grep -vE '^$|/(zs_config|zs_fast)\.h$|/core/fast\.h$')
        # shellcheck disable=SC2086
        if ! grep -qE "$names" $reads; then
            objects="${objects:-} $with.o/$object"
            continue
        fi
        # shellcheck disable=SC2086
        $compiler -DZS_NO_FAST=1 -c "$source" -o "$program.o/$object"
    else
        # shellcheck disable=SC2086
        $compiler -MMD -c "$source" -o "$program.o/$object"
    fi
    objects="${objects:-} $program.o/$object"
done
# shellcheck disable=SC2086
$compiler $objects -o "$program"
