#!/bin/sh
# tests/property/checksum.c with the renderer, by one compiler at one level; or the same without accelerators, of which
# only those objects are compiled again whose text is another one.
# Usage: tests/lib/checksum_program.sh PROGRAM COMPILER... -- all SOURCE.c...     PROGRAM is .../checksum-NAME
#        tests/lib/checksum_program.sh PROGRAM COMPILER... -- list SOURCE.c...    what PROGRAM, made so, links of them,
#               on standard output: of gcc -O0, which leaves no call out. Behind each source 1 where its text is another
#               one without accelerators, by the preprocessor, else 0
#        tests/lib/checksum_program.sh PROGRAM COMPILER... -- of LIST             those of the list alone
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
mode=$2
shift 2

object() { # SOURCE: the name of its object in $object. By the shell alone: there are a thousand
    object= rest=${1%.c}
    while [ "$rest" != "${rest#*/}" ]; do
        object=$object${rest%%/*}-
        rest=${rest#*/}
    done
    object=$object$rest.o
}
text() { # SOURCE OPTION...: a checksum of it as the compiler has it
    # shellcheck disable=SC2086
    $compiler -E -P "$@" | cksum
}
linked() { # SOURCE.c...
    rm -f "$program.a"
    ar rcs "$program.a" "$program.o"/firmware-*.o
    # shellcheck disable=SC2086
    $compiler "$program.o/tests-property-checksum.o" "$program.a" -Wl,-Map,"$program.map" -o "$program.linked"
    members=$(awk '/^Archive member/ { on = 1 } /^(Discarded|Merging|As-needed|Memory)/ { on = 0 }
        on && match($1, /\(.*\.o\)$/) { printf "%s ", substr($1, RSTART + 1, RLENGTH - 2) }' "$program.map")
    rm -f "$program.a" "$program.map" "$program.linked"
    for source; do
        object "$source"
        case " $members tests-property-checksum.o " in *" $object "*) ;; *) continue ;; esac
        [ "$(text "$source")" != "$(text "$source" -DZS_NO_FAST=1)" ] && echo "$source 1" || echo "$source 0"
    done
}

with= more=
case $mode in
list)
    linked "$@"
    exit ;;
all) plan=$(printf '%s 1\n' "$@") ;;
of) plan=$(awk '{ print $1, 1 }' "$1") ;;
bare)
    plan=$(grep -v '^firmware/zstrip/fast/' "$1")
    with=$2 more=-DZS_NO_FAST=1 ;;
esac
rm -rf "$program.o"
mkdir -p "$program.o"
objects=
while read -r source again; do
    object "$source"
    if [ "$again" = 0 ]; then
        objects="$objects $with.o/$object"
        continue
    fi
    # shellcheck disable=SC2086
    $compiler $more -MMD -c "$source" -o "$program.o/$object"
    objects="$objects $program.o/$object"
done <<END
$plan
END
# shellcheck disable=SC2086
$compiler $objects -o "$program"
