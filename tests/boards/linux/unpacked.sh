#!/bin/sh
# A zImage's kernel, unpacked, as an uImage that QEMU starts: unpacking by itself, emulated, takes as long as booting.
# Usage: tests/boards/linux/unpacked.sh VMLINUZ OUT    where it is not packed by xz, OUT is VMLINUZ itself
#
# SPDX-License-Identifier: MIT
set -u
be32() { # N    as what printf writes
    printf '\\%03o\\%03o\\%03o\\%03o' $(($1 >> 24)) $(($1 >> 16 & 255)) $(($1 >> 8 & 255)) $(($1 & 255))
}
# RAM's begin and 0x208000, where Debian's armmp unpacks itself to: TEXT_OFFSET in arch/arm/Makefile, of MSM8X60
at=$(be32 $((0x40208000)))
# The unpacker holds these bytes too, before what it unpacks
for offset in $(LC_ALL=C grep -obUaP '\xfd7zXZ\x00' "$1" | cut -d : -f 1); do
    tail -c +$((offset + 1)) "$1" | xz -dc --single-stream >"$2.image" 2>"$2.txt" || continue
    # magic, two checksums and a time that nobody reads, and then: Linux, ARM, kernel, not packed; no name
    size=$(be32 "$(wc -c <"$2.image")") zero=$(be32 0)
    printf "\\047\\005\\031\\126$zero$zero$size$at$at$zero\\005\\002\\002\\000" >"$2"
    head -c 32 /dev/zero | cat - "$2.image" >>"$2"
    rm "$2.image" "$2.txt"
    exit
done
rm -f "$2.image" "$2.txt"
cp "$1" "$2"
