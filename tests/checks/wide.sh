#!/bin/sh
# What wide.h has in assembler, on emulated cores: a Cortex-M0, an M3, and an M4, which has instructions of its own.
# That no library is called for it. And what fast/ has in assembler for the Armv6-M and the Armv7-M.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

dir=$B/wide
mkdir -p "$dir"
# PROGRAM BOARD WHAT: run tests/checks/PROGRAM.c, with PROGRAM_c.c if there is one
program() {
    for target in all run; do
        make -s -f firmware/boards/firmware.mk BOARD="$2" NAME="$1" \
            APP_SRC="$(echo tests/checks/"$1".c $(ls tests/checks/"$1"_c.c 2>/dev/null))" \
            APP_FLAGS=-Isim/reference B="$top" QEMU_ICOUNT= $target >"$dir/log" 2>&1 ||
            { bad "$1 on $2" "$target: $(tr '\n' ' ' <"$dir/log")"; return; }
    done
    ok "$1 on $2: $3"
}
for board in m0 mps2 mps2-m4; do
    program wide $board "products, rows, leading zeros, filling"
done
program set_up m0 "rows, area, keys and colours of 200,000 triangles are those of the core"
for board in mps2 mps2-m7; do
    program v7m $board "30,000 lists of small triangles and 6,000 meshes are those of the functions in C"
done

cat >"$dir/calls.c" <<'END'
#include "arch/wide.h"
uint64_t f1(uint32_t, uint32_t), f2(int32_t, int32_t), f3(int32_t, uint32_t), f4(uint64_t);
uint64_t f1(uint32_t a, uint32_t b) { return zs_mul_uu(a, b) + zs_umulh(b, a + 1u); }
uint64_t f2(int32_t a, int32_t b) { return (uint64_t)zs_mul_ss(a, b) + (uint32_t)zs_mulh_ss(b, a + 1); }
uint64_t f3(int32_t a, uint32_t b) { return (uint64_t)zs_mul_su(a, b); }
uint64_t f4(uint64_t a) { return (uint64_t)zs_clz64(a); }
END
for c in $CPUS; do
    # shellcheck disable=SC2086
    ${ARM}gcc -std=c11 -mcpu="$c" -mthumb $OPT $WARN -Ifirmware/zstrip -c "$dir/calls.c" -o "$dir/calls.o" ||
        bad "$c calls" "does not compile"
    none "$c: no library call in wide.h" \
        "$(${ARM}nm --plugin= -u "$dir/calls.o" | awk '{ print $NF }' | grep -v '^zs_clz8$')"
done
exit $failed
