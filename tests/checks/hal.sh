#!/bin/sh
# HALs are peers: each defines every function of hal.h and no other global name; hal/null compiles with anything.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

wanted=$(gcc -fpreprocessed -dD -E -P hal/hal.h | tr '\n' ' ' |
    grep -oE '\<hal_[a-z_]+\([^()]*\);' | sed 's/(.*//' | sort -u)
WARN="-Wall -Wextra -Werror -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes"
mkdir -p "$B/hal"

[ "$(echo "$wanted" | wc -l)" -ge 8 ] && ok "functions found in hal.h: $(echo "$wanted" | wc -l)" ||
    bad "functions found in hal.h" "$wanted"

for dir in hal/*/; do
    name=$(basename "$dir")
    [ -f "hal/$name/hal.c" ] || continue # a bus or a driver, not a board
    case $name in
    host) cc=gcc nm=nm cpu= ;;
    *) cc=${ARM}gcc nm=${ARM}nm cpu="-mcpu=cortex-m0plus -mthumb" ;;
    esac
    defined=
    for f in "$dir"*.c; do
        # shellcheck disable=SC2086
        $cc $cpu -std=c11 -O2 $WARN -Ihal -c "$f" -o "$B/hal/$name.o" || bad "$name compiles" "$f"
        defined="$defined
$($nm "$B/hal/$name.o" | awk '$2 ~ /[TDBRC]/ { print $3 }')"
    done
    none "$name defines every function of hal.h" \
        "$(for f in $wanted; do echo "$defined" | grep -qx "$f" || echo "$f"; done)"
done

not=
for cc in "gcc" "gcc -m32 -ffreestanding" "clang" "${ARM}gcc -mcpu=cortex-m0plus -mthumb" \
    "${ARM}gcc -mcpu=cortex-m3 -mthumb" "${ARM}gcc -mcpu=cortex-m7 -mthumb"; do
    for std in c99 c11 c17; do
        # shellcheck disable=SC2086
        $cc -std=$std -pedantic $WARN -Ihal -c hal/null/hal.c -o "$B/hal/null.o" || not="$not $cc $std,"
    done
done
none "null compiles with gcc, clang and arm-none-eabi-gcc, c99 to c17" "$not"
exit $failed
