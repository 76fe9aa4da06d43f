#!/bin/sh
# The programs of firmware/examples on QEMU's Cortex-M3: the pictures are this machine's, and flash, RAM and
# instructions are what the table of firmware/examples/README.md says.
# Usage: tests/tools/examples.sh BUILD          the check
#        tests/tools/examples.sh BUILD write    first write the table's figures anew
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/examples
readme=firmware/examples/README.md
mkdir -p "$out"
for board in mps2 host; do
    firmware() {
        make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD=$board NAME=examples B="$top" \
            APP_SRC="tests/tools/examples/first_frames.c $(echo firmware/examples/*.c)" \
            APP_FLAGS='-Ifirmware/app -Ifirmware/examples' "$@"
    }
    counted examples "$out" $board
    sed -n 's/^\([a-z_]*\),[0-9]*,\([0-9]*\)\r*$/\1 \2/p' "$out/$board.csv" >"$out/$board.sums"
done
n=$(find firmware/examples -name '*.c' | wc -l)
none "pictures of examples are the same on M3 and host, $(wc -l <"$out/mps2.sums") of them" \
    "$(diff "$out/mps2.sums" "$out/host.sums" | tr ' ' _)$([ "$(wc -l <"$out/mps2.sums")" -eq "$n" ] || echo "of $n")"

# Each alone, with what it names of the renderer: its function is where the program begins
objects=$top/fw/mps2
for source in firmware/examples/*.c; do
    name=$(basename "$source" .c)
    # shellcheck disable=SC2046
    ${ARM}gcc -mcpu=cortex-m3 -mthumb -nostartfiles -Wl,--gc-sections,-e,"example_$name" -o "$out/$name.elf" \
        "$objects/of-examples/firmware/examples/$name.o" $(find "$objects/firmware/zstrip" -name '*.o') || exit 1
    ${ARM}size "$out/$name.elf" | awk -v name="$name" 'NR == 2 { print name, $1 + $2, $2 + $3 }'
done >"$out/sizes"
awk -F '[ ,]' '
    function kb(n) { return sprintf("%.1f", n / 1000) }
    FILENAME ~ /sizes$/ { flash[$1] = kb($2); ram[$1] = kb($3); next }
    FILENAME ~ /csv$/ { if (NF == 3) thousand[$1] = sprintf("%.0f", $2 / 1000); next }
    match($0, /\[[a-z_]*\.c\]/) {
        name = substr($0, RSTART + 1, RLENGTH - 4)
        split($0, cell, " [|] ")
        print cell[1] " | " cell[2] " | " cell[3] " | " flash[name] " | " ram[name] " | " thousand[name] " |"
        next }
    { print }' "$out/sizes" "$out/mps2.csv" $readme >"$out/README.md"
[ "${2:-}" != write ] || cp "$out/README.md" $readme
sed -n 's/^| *\([0-9]*\) | \[\(.*\.c\)\].* | \([0-9.]* | [0-9.]* | [0-9]*\) |$/\1 \2 \3/p' "$out/README.md" |
    awk 'BEGIN { printf "%3s %-18s %9s %8s %13s\n", "", "", "flash, KB", "RAM, KB", "1000 instr." }
        { printf "%3d %-18s %9s %8s %13s\n", $1, $2, $3, $5, $7 }'
none "every example stands in its README's table, in order" "$(
    sed -n 's/^| *\([0-9]*\) | \[.*/\1/p' $readme | awk '$1 != NR' | tr ' ' _
    for source in firmware/examples/*.c; do
        grep -qF "[$(basename "$source")]($(basename "$source"))" $readme || echo "$source"
    done)"
if other_compiler; then
    ok "figures of examples: printed only, another compiler made the table"
else
    none "flash, RAM and instructions of $n examples are as their README says" \
        "$(diff $readme "$out/README.md" | grep '^>' | tr ' ' _ | head -3)"
fi
none "every example has under 60 lines" \
    "$(wc -l firmware/examples/*.c | awk '$1 >= 60 && $2 != "total" { print $2 "_" $1 }')"
exit $failed
