#!/bin/sh
# The programs of firmware/examples on QEMU's Cortex-M3 and on an emulated RP2040: the pictures are this machine's, and
# flash, RAM, instructions and cycles are what the table of firmware/examples/README.md says. The pictures are in
# BUILD/examples/sheet.png.
# Usage: tests/tools/examples.sh BUILD          the check
#        tests/tools/examples.sh BUILD write    first write the table's figures anew
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/examples
readme=firmware/examples/README.md
mkdir -p "$out"
firmware() { # BOARD NAME [MAKE-ARGUMENT...]
    board=$1 name=$2
    shift 2
    make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD="$board" NAME="$name" B="$top" "$@"
}
drawn() { # BOARD MAKE-ARGUMENT...
    board=$1
    shift
    firmware "$board" examples APP_SRC="tests/tools/examples/first_frames.c $(echo firmware/examples/*.c)" \
        APP_FLAGS='-Ifirmware/app -Ifirmware/examples' "$@"
}
sums_of() { # CSV    NAME SUM a line
    sed -n 's/^\([a-z_]*\),[0-9]*,\([0-9]*\)\r*$/\1 \2/p' "$1"
}
for b in mps2 host; do
    if ! drawn $b >"$out/log" 2>&1 || ! drawn $b run >"$out/$b.csv" 2>"$out/err"; then
        cat "$out/log" "$out/err" "$out/$b.csv"
        bad "examples on $b" "see above"
        exit 1
    fi
    cat "$out/err" >>"$out/$b.csv" # semihosting may write to either
    sums_of "$out/$b.csv" >"$out/$b.sums"
done

# The RP2040, with the last of the table, the show
sh tests/boards/pico.sh "$top" set-up
: >"$out/cycles"
: >"$out/show.size"
if [ -d "$top/pico/node_modules/rp2040js" ]; then
    if ! drawn pico image >"$out/log" 2>&1 ||
        ! node "$top/pico/calls.mjs" "$top/fw/pico/examples" example_ >"$out/pico.txt" 2>>"$out/log" ||
        ! firmware pico my_scene APP=show SCENE=mine image >"$out/show.size" 2>>"$out/log" ||
        ! node "$top/pico/run.mjs" "$top/fw/pico/my_scene" --frames 4 --step 13 >"$out/show.txt" 2>>"$out/log"; then
        cat "$out/log"
        bad "examples on the RP2040" "see above"
        exit 1
    fi
    sed -n 's/^text //p' "$out/pico.txt" >"$out/pico.csv"
    none "pictures of examples are the same on the RP2040" "$(
        sums_of "$out/pico.csv" | diff "$out/host.sums" - | tr ' ' _
        grep problem "$out/pico.txt" "$out/show.txt" | tr ' ' _)"
    { grep '^[a-z_]* [0-9]*$' "$out/pico.txt"; sed -n 's/^draw_cycles/my_scene/p' "$out/show.txt"; } >"$out/cycles"
fi
n=$(find firmware/examples -name '*.c' | wc -l)
none "pictures of examples are the same on M3 and host, $(wc -l <"$out/mps2.sums") of them" \
    "$(diff "$out/mps2.sums" "$out/host.sums" | tr ' ' _)$([ "$(wc -l <"$out/mps2.sums")" -eq "$n" ] || echo "of $n")"

# Each alone, with what it names of the renderer: its function is where the program begins
objects=$top/fw/mps2
find "$objects/firmware/zstrip" -name '*.o' | while read -r object; do # of sources that have moved
    source=${object#"$objects"/}
    [ -e "${source%.o}.c" ] || rm -f "$object"
done
for source in firmware/examples/*.c; do
    name=$(basename "$source" .c)
    # shellcheck disable=SC2046
    ${ARM}gcc -mcpu=cortex-m3 -mthumb -nostartfiles -Wl,--gc-sections,-e,"example_$name" -o "$out/$name.elf" \
        "$objects/of-examples/firmware/examples/$name.o" $(find "$objects/firmware/zstrip" -name '*.o') || exit 1
    ${ARM}size "$out/$name.elf" | awk -v name="$name" 'NR == 2 { print name, $1 + $2, $2 + $3 }'
done >"$out/sizes"
sed -n 's/.*: flash \([0-9]*\) .* RAM \([0-9]*\) .*/my_scene \1 \2/p' "$out/show.size" >>"$out/sizes"
awk -F '[ ,]' '
    function kb(n) { return sprintf("%.1f", n / 1000) }
    FILENAME ~ /sizes$/ { flash[$1] = kb($2); ram[$1] = kb($3); next }
    FILENAME ~ /cycles$/ { cycles[$1] = sprintf("%.0f", $2 / 1000); next }
    FILENAME ~ /csv$/ { if (NF == 3) thousand[$1] = sprintf("%.0f", $2 / 1000); next }
    match($0, /^.*\[[a-z_]*\.c\]/) && /^\|/ {
        name = substr($0, 1, RLENGTH - 3)
        sub(/.*\[/, "", name)
        split($0, cell, " [|] ")
        sub(/ [|]$/, "", cell[7])
        print cell[1] " | " cell[2] " | " cell[3] " | " (name in flash ? flash[name] : cell[4]) " | " \
            (name in ram ? ram[name] : cell[5]) " | " (name in thousand ? thousand[name] : cell[6]) " | " \
            (name in cycles ? cycles[name] : cell[7]) " |"
        next }
    { print }' "$out/sizes" "$out/cycles" "$out/mps2.csv" $readme >"$out/README.md"
[ "${2:-}" != write ] || cp "$out/README.md" $readme
awk -F ' [|] ' '
    BEGIN { printf "%3s %-18s %9s %8s %13s %12s\n", "", "", "flash, KB", "RAM, KB", "1000 instr.", "1000 cycles" }
    /^\| [0-9]/ { sub(/^\| */, ""); name = $2; gsub(/\[|\].*/, "", name); sub(/ [|]$/, "", $7)
        printf "%3d %-18s %9s %8s %13s %12s\n", $1, name, $4, $5, $6, $7 }' "$out/README.md"
none "every example stands in its README's table, in order" "$(
    sed -n 's/^| *\([0-9]*\) | \[.*/\1/p' $readme | awk '$1 != NR' | tr ' ' _
    for source in firmware/examples/*.c; do
        grep -qF "[$(basename "$source")]($(basename "$source"))" $readme || echo "$source"
    done)"
if other_compiler; then
    ok "figures of examples: printed only, another compiler made the table"
else
    none "flash, RAM, instructions and cycles of $n examples are as their README says" \
        "$(diff $readme "$out/README.md" | grep '^>' | tr ' ' _ | head -3)"
fi
# All pictures on one sheet
# shellcheck disable=SC2046
if gcc -std=gnu11 -O1 -Ifirmware/zstrip -Ifirmware/examples -Isim/load -Isim/cli tests/tools/examples/sheet.c \
    $(find "$top/fw/host/of-examples/firmware/examples" "$top/fw/host/firmware/zstrip" -name '*.o') \
    sim/load/image.c sim/load/picture.c sim/cli/sim.c sim/cli/output_file.c \
    -lpng -lturbojpeg -lz -lm -o "$out/sheet" 2>"$out/log" && "$out/sheet" "$out/sheet.png" 2>>"$out/log"; then
    ok "pictures of the examples: $out/sheet.png"
else
    bad "the sheet of the examples' pictures" "$(head -c 300 "$out/log")"
fi
none "every example has under 60 lines" \
    "$(wc -l firmware/examples/*.c | awk '$1 >= 60 && $2 != "total" { print $2 "_" $1 }')"
exit $failed
