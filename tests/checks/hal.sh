#!/bin/sh
# Boards are peers: each one's HAL defines every function of hal.h once; hal/null compiles with anything.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

wanted=$(gcc -fpreprocessed -dD -E -P hal/hal.h | tr '\n' ' ' |
    grep -oE '\<hal_[a-z_]+\([^()]*\);' | sed 's/(.*//' | sort -u)
WARN="-Wall -Wextra -Werror -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes"
mkdir -p "$B/hal"

[ "$(echo "$wanted" | wc -l)" -ge 8 ] && ok "functions found in hal.h: $(echo "$wanted" | wc -l)" ||
    bad "functions found in hal.h" "$wanted"

# NAME COMPILER FLAGS FILES: compile them, and look at what they define.
peer() {
    defined=
    for f in $4; do
        # shellcheck disable=SC2086
        $2 $3 -std=c11 -O2 $WARN -Ihal -Ihal/null -Ihal/cortexm -Ihal/semihosting -Ihal/spi -c "$f" -o "$B/hal/$1.o" ||
            bad "$1 compiles" "$f"
        defined="$defined
$("${2%gcc}nm" --plugin= "$B/hal/$1.o" | awk '$2 ~ /[TDBRC]/ { print $3 }')"
    done
    none "$1 defines every function of hal.h once" \
        "$(for f in $wanted; do [ "$(echo "$defined" | grep -cx "$f")" = 1 ] || echo "$f"; done)"
}
peer null gcc '' "$(echo hal/null/*.c)"
for mk in firmware/boards/*/board.mk; do
    board=$(basename "$(dirname "$mk")")
    make -s -f firmware/boards/firmware.mk BOARD="$board" B="$top" hal >"$B/hal/$board.txt"
    peer "$board" "$(sed -n 1p "$B/hal/$board.txt")" "$(sed -n 2p "$B/hal/$board.txt")" \
        "$(sed -n 3p "$B/hal/$board.txt")"
done

not=
for cc in "gcc" "gcc -m32 -ffreestanding" "clang" "${ARM}gcc -mcpu=cortex-m0plus -mthumb" \
    "${ARM}gcc -mcpu=cortex-m3 -mthumb" "${ARM}gcc -mcpu=cortex-m7 -mthumb"; do
    for std in c99 c11 c17; do
        # shellcheck disable=SC2086
        for f in hal/null/*.c; do
            $cc -std=$std -pedantic $WARN -Ihal -c "$f" -o "$B/hal/null.o" || not="$not $cc $std,"
        done
    done
done
none "null compiles with gcc, clang and arm-none-eabi-gcc, c99 to c17" "$not"
exit $failed
