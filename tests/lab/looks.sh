#!/bin/sh
# Frames with effects together, in several passes, and showpieces (sim/lab/looks.c): what they take on QEMU's Cortex-M3
# and in Armv6-M code, against what sim/budget estimates of the same frames. Their pictures are the same on both.
#
# Usage: tests/lab/looks.sh BUILD          the check and a table; needs BUILD/zlab, or BUILD/test/zlab
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/looks
mkdir -p "$out"
for core in M3 M0; do
    firmware() {
        [ $core != M0 ] || set -- BOARD_CPU='-mcpu=cortex-m0 -mthumb' "$@"
        make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD=mps2 NAME=looks \
            APP_SRC="tests/lab/effects/looks_app.c sim/lab/looks.c $(echo firmware/scenes/pieces/*.c)" \
            APP_FLAGS='-Ifirmware/app -Isim/lab' DEFINES=-DZS_VARYINGS_MAX=8 B="$top" OUT="$top/fw/effects-$core" "$@"
    }
    counted looks "$out" $core
    sed -n 's/,[0-9]*,\([0-9]*\)$/ \1/p' "$out/$core.csv" >"$out/$core.sums"
done
none "pictures of looks are the same on M3 and M0, $(wc -l <"$out/M3.sums") of them" \
    "$(diff "$out/M3.sums" "$out/M0.sums" | tr ' ' _)$([ "$(wc -l <"$out/M3.sums")" -ge 36 ] || echo too_few)"
if other_compiler; then
    ok "estimates of looks: not held, another compiler made the record"
    exit $failed
fi
zlab=$top/test/zlab
[ -x "$zlab" ] || zlab=$top/zlab
for core in M3:15 M0:18; do
    table=$out/table-${core%:*}
    "$zlab" looks --"$(echo "${core%:*}" | tr A-Z a-z)" "$out/${core%:*}.csv" --bar "${core#*:}" >"$table" 2>&1
    reason=$?
    grep '%$' "$table"
    none "no estimate of a look is ${core#*:} % off: $(tail -1 "$table")" \
        "$([ $reason = 0 ] || echo status_$reason)"
done
exit $failed
