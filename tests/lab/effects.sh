#!/bin/sh
# What a pixel takes by each shader and hook of effect/ and overlay/, in instructions on QEMU's Cortex-M3 and, for
# Armv6-M code, on the same board (not cycles). Pictures are the same there and on this machine, and no row may take
# over 2 % more than tests/records/effects.txt has on record.
#
# Usage: tests/lab/effects.sh BUILD          the check and a table
#        tests/lab/effects.sh BUILD record   the record on standard output, with cycles on the emulated RP2040
#        tests/lab/effects.sh BUILD header   sim/budget/record_effects.h from the record
#        tests/lab/effects.sh BUILD pico     those cycles alone
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

. tests/lib/checksum_core.sh

out=$top/effects
record=tests/records/effects.txt
mkdir -p "$out"
pico() { # lines "RP2040 CYCLES NAME"
    on_pico effects 1800 APP_SRC=tests/lab/effects/effects.c APP_FLAGS='-Ifirmware/app -DCYCLES_A_TICK=125' \
        DEFINES=-DZS_VARYINGS_MAX=8 >"$out/pico.csv" || return 1
    sed -n 's/^\([^#]*\),\([0-9][0-9]*\),[0-9]*\r*$/RP2040 \2 \1/p' "$out/pico.csv"
}
if [ "${2:-}" = header ]; then
    cat <<'END'
/* Instructions of 100 pixels, or of 100 vertices, by each effect, cycles on the RP2040, as tests/records/effects.txt
 * has them (make effects-record).
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef SIM_RECORD_EFFECTS_H
#define SIM_RECORD_EFFECTS_H

static const struct {
    const char *core, *name;
    double hundred;
} record_effects[] = {
END
    sed -n 's/^\(M[0-9]\|RP2040\) \([0-9]*\) \(.*\)/    { "\1", "\3", \2 },/p' $record
    printf '};\n\n#endif\n'
    exit
elif [ "${2:-}" = pico ]; then
    pico
    exit
fi
for core in M3 M0 host; do
    firmware() {
        [ $core != M0 ] || set -- BOARD_CPU='-mcpu=cortex-m0 -mthumb' "$@"
        board=mps2
        [ $core != host ] || board=host
        # shellcheck disable=SC2046
        [ $core != host ] || set -- $(checksum_core "$top" gcc-O3) "$@"
        make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD=$board NAME=effects \
            APP_SRC=tests/lab/effects/effects.c \
            APP_FLAGS=-Ifirmware/app DEFINES=-DZS_VARYINGS_MAX=8 B="$top" OUT="$top/fw/effects-$core" "$@"
    }
    counted effects "$out" $core
    sed -n 's/^\([^#]*\),[0-9]*,\([0-9][0-9]*\)$/\2 \1/p' "$out/$core.csv" >"$out/$core.sums"
    [ $core = host ] || sed -n "s/^\\([^#]*\\),\\([0-9][0-9]*\\),[0-9]*\$/$core \\2 \\1/p" "$out/$core.csv"
done >"$out/now"
if [ "${2:-}" = record ]; then
    echo "# Instructions of 100 pixels by each effect (tests/lab/effects.sh). Recorded by make effects-record."
    echo "compiler Arm $(${ARM}gcc -dumpversion)"
    cat "$out/now"
    pico
    exit
fi
for core in M0 host; do # Armv6-M code has none of what arch/held.h has for Armv7-M
    none "pictures of effects are the same on M3 and $core, $(wc -l <"$out/M3.sums") of them" \
        "$(diff "$out/M3.sums" "$out/$core.sums" | tr ' ' _)$([ "$(wc -l <"$out/$core.sums")" -ge 28 ] || echo too_few)"
done
if other_compiler; then
    ok "instructions of effects: printed only, another compiler made the record"
else
    none "no effect takes over 2 % more than on record, in $(grep -c '^M' $record) rows" "$(awk '
        NR == FNR { if (/^M/) { k = $1; n = $2; $1 = $2 = ""; was[k $0] = n }; next }
        { k = $1; n = $2; $1 = $2 = ""; k = k $0; seen++; delete left[k] }
        !(k in was) || n > was[k] * 1.02 { print k ":" n ",was:" was[k] }
        END { if (seen < 40) print "only " seen " rows" }' $record "$out/now" | tr ' ' _)"
fi
echo "Instructions a pixel (QEMU -icount), depth-tested, without accelerators:"
awk '{ core = $1; n = $2; $1 = $2 = ""; name = substr($0, 3) }
    core == "M3" { m3[name] = n; order[++k] = name; next }
    { m0[name] = n }
    END {
        printf "  %-32s %8s %8s   a vertex: by a sheet, less raw\n", "", "M3", "M0"
        for (i = 1; i <= k; i++) printf "  %-32s %8.1f %8.1f\n", order[i], m3[order[i]] / 100, m0[order[i]] / 100
    }' "$out/now"
exit $failed
