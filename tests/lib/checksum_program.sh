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
# A line a source: its object's name, and for the bare program whether it is to be compiled again, as a file that it
# reads names one of these. Of zs_fast.h and core/fast.h it is macros that read ZS_NO_FAST: what names one of them
# counts.
names='ZS_NO_FAST|ZS_IF_FAST|ZS_FAST_[A-Z0-9_]+'
naming=
# shellcheck disable=SC2046
[ -z "$with" ] || naming=$(grep -lE "$names" $(cat "$with.o"/*.d | tr -s ' \\' '\n\n' | grep '\.[ch]$' | sort -u |
    grep -vE '/(zs_config|zs_fast)\.h$|/core/fast\.h$') | tr '\n' ' ')
objects=
# shellcheck disable=SC2086
plan=$(printf '%s\n' $sources | awk -v with="$with" -v naming="$naming" '
    BEGIN { n = split(naming, f, " "); for (i = 1; i <= n; i++) names[f[i]] = 1 }
    {
        object = $1; sub(/\.c$/, "", object); gsub("/", "-", object)
        again = with == ""
        while (!again && (getline line <(with ".o/" object ".d")) > 0) {
            n = split(line, f, /[ \\]+/)
            for (i = 1; i <= n; i++) again = again || f[i] in names
        }
        print $1, object ".o", again
    }')
more=-MMD
[ -z "$with" ] || more=-DZS_NO_FAST=1
while read -r source object again; do
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
