#!/bin/sh
# gcc for what READMEs say: a command that compiles several sources into a program does so one by one through ccache.
# Any other command is gcc's own. $REAL_GCC is gcc. Objects of firmware/zstrip stay in $GCC_KEPT, by their flags:
# another command takes them from there.
#
# SPDX-License-Identifier: MIT
set -u
program=a.out next= sources=0 other=0
for arg in "$@"; do
    [ "$next" != o ] || program=$arg
    next=
    case $arg in
    *.c) sources=$((sources + 1)) ;;
    -o) next=o ;;
    -c | -S | -E | -fsyntax-only | -x) other=1 ;;
    esac
done
[ $sources -gt 1 ] && [ $other = 0 ] || exec "$REAL_GCC" "$@"
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
n=0 flags= libraries= next=
for arg in "$@"; do
    case $next$arg in
    o*) ;;
    -o) next=o && continue ;;
    *.c) ;;
    *.a | -l*) libraries="$libraries $arg" ;;
    *) flags="$flags $arg" ;;
    esac
    next=
done
kept=$GCC_KEPT/$(echo "$flags" | cksum | tr -d ' ') objects=
for arg in "$@"; do
    case $arg in
    firmware/zstrip/*.c)
        object=$kept/$arg.o
        [ -d "${object%/*}" ] || mkdir -p "${object%/*}" ;;
    *.c)
        n=$((n + 1))
        object=$dir/$n.o ;;
    *) continue ;;
    esac
    objects="$objects $object"
    [ -e "$object" ] && continue
    # shellcheck disable=SC2086
    CCACHE_NOHASHDIR=1 ccache "$REAL_GCC" $flags -c "$arg" -o "$object" || exit 1
done
# shellcheck disable=SC2086
"$REAL_GCC" $objects $flags $libraries -o "$program"
