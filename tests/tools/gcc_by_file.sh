#!/bin/sh
# gcc for what READMEs say: a command that compiles several sources into a program does so one by one through ccache, as
# the library's are the same each time. Any other command is gcc's own. $REAL_GCC is gcc.
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
n=0 flags= next=
for arg in "$@"; do
    case $next$arg in
    o*) ;;
    -o | *.c) ;;
    *) flags="$flags $arg" ;;
    esac
    next=
    [ "$arg" != -o ] || next=o
done
for arg in "$@"; do
    case $arg in *.c) ;; *) continue ;; esac
    n=$((n + 1))
    # shellcheck disable=SC2086
    CCACHE_NOHASHDIR=1 ccache "$REAL_GCC" $flags -c "$arg" -o "$dir/$n.o" || exit 1
done
# shellcheck disable=SC2086
"$REAL_GCC" "$dir"/*.o $flags -o "$program"
