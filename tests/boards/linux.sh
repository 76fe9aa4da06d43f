#!/bin/sh
# zstrip-linux on real kernels: Debian's own for armhf in QEMU, of two releases, each with its libgpiod, with a panel
# on the pins of a PL061. What QEMU traces on the pins goes into the model of the panel's controller; the pictures must
# be those of `zsim demo`, byte for byte. This machine's own kernel needs no GPIO and no SPI for it. Needs build/zsim.
# Usage: tests/boards/linux.sh BUILD
#
# Not seen by it: time on the wire (QEMU's trace has no times), how much of the drawing goes on behind it (on one
# emulated core, threads take turns), a real SPI controller's clock, DMA and speed limit, voltages. The kernel bit-bangs
# SPI (spi-gpio) below the same spidev.
# Where a release's packages cannot be reached, its half is SKIPPED, in as many words. What was fetched once stays in
# BUILD.
#
# SPDX-License-Identifier: MIT
# shellcheck disable=SC2046,SC2086,SC2317
set -u
build=$1
out=$build/linux
. tests/boards/image.sh
STEP=13

# ---- What runs ----------------------------------------------------------------------------------------------------

app='/zstrip-linux --spi /dev/spidev0.0'
run="$app --dc PANEL_DC --reset PANEL_RESET --backlight PANEL_BACKLIGHT"
user='user=1000 groups=20,21'   # an ordinary user in the groups of the chip and of the spidev
full='--panel st7789:135x240 --invert'
turned='--panel ssd1351:128x96 --rotate 180'
colour='--panel ssd1351:128x96'
grey='--panel ssd0323:128x64 --rotate 270'
mono='--panel ssd1306:128x64'
tiny='--panel ssd1306:64x48'

cubes="--scene cubes --step $STEP --frames"

# Lines for init.c: NAME SETTINGS : COMMAND
# A KB on the wire takes 0.1 s of this machine: 16,000 edges that QEMU traces. So panels are small, and frames few.
list() {
    cat <<END
colour $user : $run $colour --scene knot --step $STEP --frames 2 --stats
grey $user : $app --dc gpiochip0:4 --reset gpiochip0:5 $grey $cubes 2
mono $user : $app --dc 9030000.pl061:4 --reset 9030000.pl061:PANEL_RESET $mono $cubes 2
te $user : $run $tiny --te PANEL_TE $cubes 4
free $user : $run $tiny $cubes 4
noedge $user : $app --dc PANEL_DC --reset PANEL_RESET --te PANEL_BACKLIGHT $tiny $cubes 2
term $user term=2500 : $run $tiny --scene cubes
int $user int=2500 : $run $tiny --scene cubes
dry $user : $run $tiny --mode 3 --scene cubes --dry-run
held $user hold=4 : $run $tiny $cubes 1
otherspi $user : /zstrip-linux --spi /dev/spidev7.0 --dc PANEL_DC --reset PANEL_RESET $tiny $cubes 1
nospi $user hide=/dev/spidev0.0 : $run $tiny $cubes 1
nochip $user hide=/dev/gpiochip0 : $run $tiny $cubes 1
noline $user : $app --dc PANEL_DCX --reset PANEL_RESET $tiny $cubes 1
nogpio user=1000 groups=21 : $run $tiny $cubes 1
nospigroup user=1000 groups=20 : $run $tiny $cubes 1
END
}
# What is long on the wire, and calls nothing of libgpiod that the above does not: by one release.
list_full() {
    echo "full $user : $run $full --scene teapot --step $STEP --frames 1"
}
list_turned() {
    echo "turned $user : $run $turned --scene globe --step $STEP --frames 3 --partial"
}
list_small() { # where the kernel takes 1024 bytes at a time
    echo "small $user : $run $colour --scene knot --step $STEP --frames 1"
}

# ---- The machine --------------------------------------------------------------------------------------------------

# QEMU's own device tree, and the panel on it.
device_tree() {
    qemu-system-arm -M virt,dumpdtb="$out/virt.dtb" -cpu cortex-a15 -smp 1 -m 128 -net none -nographic \
        >"$out/dtb.txt" 2>&1 && dtc -q -I dtb -O dts "$out/virt.dtb" >"$out/virt.dts" &&
        cat "$out/virt.dts" tests/boards/linux/panel.dts >"$out/panel.dts" &&
        dtc -q -I dts -O dtb -o "$out/panel.dtb" "$out/panel.dts" 2>>"$out/dtb.txt" && return
    bad linux_device_tree "$(tail -1 "$out/dtb.txt")"
    exit 1
}

# Run a list of tests: BOOT LIST KERNEL-OPTIONS   in $at; leaves boot_BOOT.txt, of each test NAME.txt, .stream, .wire
boot() {
    names=$(sed 's/ .*//' "$2")
    for name in $names; do # nothing of a run before is judged
        rm -f "$at/$name.txt" "$at/$name.stream" "$at/$name.wire"
    done
    rm -rf "$at/tree" && mkdir -p "$at/tree/etc"
    cp "$out/init" "$at/tree/init"
    cp "$at/zstrip-linux" "$at/tree/"
    cp "$2" "$at/tree/tests"
    printf 'root:x:0:\nlines:x:20:\nwires:x:21:\n' >"$at/tree/etc/group"
    (cd "$at/tree" && find . | cpio -o -H newc -R 0:0 --quiet) >"$at/initrd"
    # Line 3 is pulsed, as long as there is a reader.
    while sleep 0.4 && echo system_powerdown; do :; done 2>/dev/null |
        timeout 200 qemu-system-arm -M virt -cpu cortex-a15 -smp 1 -m 128 -net none -display none -monitor stdio \
            -serial file:"$at/boot_$1.raw" -kernel "$at/kernel" -dtb "$out/panel.dtb" -initrd "$at/initrd" \
            -append "console=ttyAMA0 quiet loglevel=1 panic=-1 $3" -no-reboot \
            -trace pl061_set_output -trace pl061_input_change 2>&1 >"$at/monitor.txt" |
        "$out/wire" "$at" $names 2>"$at/boot_$1.err"
    tr -d '\r' <"$at/boot_$1.raw" >"$at/boot_$1.txt"
    for name in $names; do
        # its text, its status, and what the lines were afterwards
        awk -v name="$name" '$1 == "begin" { on = $2 == name; next } on && $1 == "end" { print "status " $3; next }
            on' "$at/boot_$1.txt" >"$at/$name.txt"
    done
    verdict "${half}_boot_$1" "$(grep -qx 'done' "$at/boot_$1.txt" || echo "it did not come to its end:" \
        "$(cat "$at/boot_$1.txt" "$at/boot_$1.err" | tail -n 3 | tr '\n' ' ' | cut -c1-300)")"
}

# ---- The decoder itself --------------------------------------------------------------------------------------------

# Edges, such as 2- for line 2 goes low, decoded as a run of this name: NAME EDGES...
decode_edges() {
    name=$1
    shift
    for e in 2+ 5+ 7+ "$@" 7-; do
        echo "pl061_set_output /a setting output ${e%[+-]} to $(echo "${e#?}" | tr +- 10)"
    done | "$out/wire" "$out" "$name"
}
# A run with this fault is told so: NAME WORDS EDGES...
finds() {
    name=$1 words=$2
    shift 2
    decode_edges "$name" "$@"
    grep -q "^problem .*$words" "$out/$name.wire" || echo "not found: $words"
}
decoder_test() {
    c='0+ 0-' # a clock
    decode_edges good 4- 2- 1+ $c $c 1- $c $c $c $c $c 1+ $c 2+ 4+ 2- $c $c $c $c 1- $c $c $c $c 2+ 5- 5+
    [ "$(od -An -tx2 "$out/good.stream" | tr -d '\n')" = ' 00c1 0800 01f0 0400 0800 0200' ] ||
        echo "not c1, data f0, a frame, a reset: $(od -An -tx2 "$out/good.stream")"
    field "$out/good.wire" problem
    finds cut 'a byte was cut short' 2- $c $c $c 2+
    finds moved 'D/C changed in the middle' 2- $c 4+ $c $c $c $c $c $c $c 2+
    finds mosi 'MOSI changed while the clock was high' 2- 0+ 1+ 0- $c $c $c $c $c $c $c 2+
    finds idle 'chip select changed while the clock was high' 0+ 2- 0- 2+
    finds unselected 'clock without chip select' $c
    finds reset 'clock while RESET is low' 5- 2- $c $c $c $c $c $c $c $c 2+
    finds left 'chip select was left low' 2-
}

# ---- Judging ------------------------------------------------------------------------------------------------------

wire() { # TEST KEY
    field "$at/$1.wire" "$2"
}
status_is() { # TEST STATUS
    [ "$(field "$at/$1.txt" status)" = "$2" ] ||
        echo "status $(field "$at/$1.txt" status), not $2: $(grep -v '^line ' "$at/$1.txt" | head -1 | cut -c1-200)"
}
decoded() { # TEST PANEL-OPTIONS...   into pictures 0, 1 ...
    name=$1
    shift
    rm -f "$at/$name"_*.bin "$at/$name"_*.png
    "$build/zsim" panel "$@" --decode "$at/$name.stream" --out "$at/${name}_%d.png" --raw "$at/${name}_%d.bin" \
        >"$at/$name.panel.txt" 2>&1 || echo "the panel would not have understood it: $(tail -1 "$at/$name.panel.txt")"
    field "$at/$name.wire" problem | head -1
}
same() { # TEST PICTURE TRUTH FRAME
    cmp -s "$at/$1_$2.bin" "$out/truth/$3_$(printf %03d $(($4 * STEP))).bin" || echo "picture $2 differs: $at/$1_$2.png"
}

# Every frame on its own: TEST SCENE FRAMES PANEL-OPTIONS...   picture 0 is the driver's clearing
pictures() {
    name=$1 scene=$2 frames=$3
    shift 3
    status_is "$name" 0
    decoded "$name" "$@"
    [ "$(wire "$name" frames)" = $((frames + 1)) ] || echo "$(wire "$name" frames) pictures, not $((frames + 1))"
    for k in $(seq "$frames"); do
        same "$name" "$k" "$name/$scene" $((k - 1))
    done
}
# What the glass shows in the end: TEST SCENE FRAMES PANEL-OPTIONS...
last_picture() {
    name=$1 scene=$2 frames=$3
    shift 3
    status_is "$name" 0
    decoded "$name" "$@"
    same "$name" "$(ls "$at/$name"_*.bin | wc -l | awk '{ print $1 - 1 }')" "$name/$scene" $((frames - 1))
}
judge() { # NAME COMMAND...   what the command writes is what is wrong
    name=$1
    shift
    verdict "${half}_$name" "$("$@" | head -3 | tr '\n' ' ')"
}

# A refusal: TEST WORDS...   status 1, one sentence that holds all the words, nothing on the wire, no line kept
refusal() {
    name=$1
    shift
    status_is "$name" 1
    text=$(said "$name")
    for words in "$@"; do
        case $text in *"$words"*) ;; *) echo "not said: $words; but: $(echo "$text" | head -1)" ;; esac
    done
    untouched "$name"
    released "$name"
}
said() { # TEST
    grep -vE '^(line .*|status .*|done|)$' "$at/$1.txt"
}
untouched() { # TEST
    [ "$(wire "$1" bytes)$(wire "$1" pins)" = 0 ] || echo "pins moved:$(wire "$1" pins)"
}
released() { # TEST   the panel's lines belong to nobody
    for line in 3 4 5 6; do
        grep -q "^line $line .*: free\$" "$at/$1.txt" || echo "not free: $(grep "^line $line " "$at/$1.txt")"
    done
}
# Ended by a signal: TEST STATUS   something was shown; then asleep, dark, lines released
put_out() {
    status_is "$1" "$2"
    decoded "$1" $tiny
    [ "$(wire "$1" frames)" -ge 3 ] || echo "$(wire "$1" frames) frames before the signal"
    [ "$(wire "$1" end)" = 'ae 8d 10' ] || echo "the last commands are $(wire "$1" end)"
    [ "$(wire "$1" levels)" = 'RESET1 BACKLIGHT0' ] || echo "left at $(wire "$1" levels)"
    released "$1"
}
# Every frame waits for an edge, and without --te none does.
after_edges() {
    pictures te cubes 4 $tiny
    for n in $(wire te frame_edges); do
        [ "$n" -ge 1 ] || echo "a frame began before its edge: $(wire te frame_edges)"
    done
    case " $(wire free frame_edges)" in
        *' 0'*) ;;
        *) echo "edges came so often that nothing is shown by it: $(wire free frame_edges) without --te" ;;
    esac
}
# One line of names, one of averages: bytes are the picture's and the windows', messages have bufsiz bytes at most.
sane_stats() {
    said colour | awk -F, 'NR == 1 { n = NF } NR == 2 && NF == n && $1 == "knot" && $2 == 2 && $3 > 0 && $8 > 24576 &&
        $8 < 24776 && $9 >= 7 && $9 < 60 { sane = 1 }
        END { if (!sane || NR != 2) print "not as expected:", $0 }'
}
# --dry-run says what there is, and touches nothing.
looks_only() {
    status_is dry 0
    for words in /dev/spidev0.0 'mode 3' PANEL_DC PANEL_RESET PANEL_BACKLIGHT gpiochip0; do
        said dry | grep -q -e "$words" || echo "not said: $words"
    done
    untouched dry
    released dry
}
# An input without edges: said so, and drawn without them.
says_and_draws() {
    last_picture noedge cubes 2 $tiny
    said noedge | grep -q -- '--te PANEL_BACKLIGHT: no edge came' || echo "not said: no edge came"
}
# The light goes on behind the first picture, and off before the panel is put to sleep.
light() {
    set -- $(wire colour frame_bytes) $(wire colour pins | tr ' ' '\n' | sed -n 's/:BACKLIGHT.$//p')
    [ "$#" = 5 ] && [ "$4" -ge $(($1 + $2)) ] && [ "$5" -lt "$(wire colour bytes)" ] ||
        echo "of $(wire colour bytes) bytes, pictures $1 $2: $(wire colour pins)"
}
# The first frame is whole; of the later ones, changed columns of changed strips alone. They are more
# than three strips of 4096 bytes; all of four would be 16384.
fewer_bytes() {
    set -- $(wire turned frame_bytes)
    [ "$#" = 4 ] && [ "$2" -ge 24576 ] &&
        [ "$3" -gt 12288 ] && [ "$3" -lt 15000 ] && [ "$4" -gt 12288 ] && [ "$4" -lt 15000 ] || echo "$*"
}
split() { # TEST BYTES
    [ "$(wire "$1" longest)" = "$2" ] || echo "at most $(wire "$1" longest) bytes at a time, not $2"
}

# ---- A release ----------------------------------------------------------------------------------------------------

full_tests() {
    judge picture pictures full teapot 1 $full
}
turned_tests() {
    judge turned_and_partial pictures turned globe 3 $turned
    judge partial_sends_less fewer_bytes
}
small_tests() {
    judge bufsiz_1024 pictures small knot 1 $colour
    judge bufsiz_1024_is_kept split small 1024
}
pictures_tests() {
    judge stats sane_stats
    judge backlight light
    judge frames pictures colour knot 2 $colour
    judge bufsiz split colour 4096
    judge chip_and_number last_picture grey cubes 2 $grey
    judge label_and_name last_picture mono cubes 2 $mono
    judge tearing_effect after_edges
    judge without_tearing_effect says_and_draws
    judge sigterm put_out term 0
    judge sigint put_out int 0
}
refusal_tests() {
    judge dry_run looks_only
    judge line_held refusal held 'held by another' PANEL_DC
    judge other_spidev refusal otherspi 'there is no /dev/spidev7.0' /dev/spidev0.0
    judge no_spidev refusal nospi 'there is no /dev/spidev0.0' 'dtparam=spi=on' overlay
    judge no_chip refusal nochip 'no GPIO chip'
    judge no_line refusal noline PANEL_DCX PANEL_RESET 'gpiochip0:4'
    judge not_in_gpio refusal nogpio /dev/gpiochip0 'usermod -aG lines'
    judge not_in_spi refusal nospigroup /dev/spidev0.0 'usermod -aG wires'
}

# RELEASE NUMBER   the number is libgpiod's
release() {
    at=$out/$1
    half=linux_libgpiod_$2
    list >"$at/main.tests"
    [ "$1:$2" != "$first" ] || list_full >>"$at/main.tests"
    [ "$1:$2" != "$last" ] || list_turned >>"$at/main.tests"
    boot main "$at/main.tests" ''
    echo "$half: $(tr '\t\n' '  ' <"$at/versions")- $(sed -n '/^kernel/p' "$at/boot_main.txt")"
    if [ "$1:$2" = "$first" ]; then
        list_small >"$at/small.tests"
        boot small "$at/small.tests" spidev.bufsiz=1024
        full_tests
        small_tests
    fi
    [ "$1:$2" != "$last" ] || turned_tests
    pictures_tests
    refusal_tests
}

# ---- All of it ----------------------------------------------------------------------------------------------------

truth_of() { # TEST SCENE FRAMES PANEL-OPTIONS...
    name=$1 scene=$2 frames=$3
    shift 3
    truth "$out/truth/$name" "$scene" "$frames" "$STEP" "$@"
}
truths() {
    mkdir -p "$out/truth"
    truth_of full teapot 1 $full
    truth_of turned globe 3 $turned
    truth_of colour knot 2 $colour
    truth_of small knot 1 $colour
    truth_of grey cubes 2 $grey
    truth_of mono cubes 2 $mono
    truth_of noedge cubes 2 $tiny
    truth_of te cubes 4 $tiny
}

# This machine's own program, as make linux builds it
make -s B="$build" "$build/zstrip-linux" >"$out/own.log" 2>&1 && "$build/zstrip-linux" --help >>"$out/own.log" 2>&1 &&
    grep -q -- --dry-run "$out/own.log" && ok linux_links_here || bad linux_links_here "$(tail -1 "$out/own.log")"

halves=
for half in bookworm:1 trixie:2; do
    name=${half%:*}
    if why=$(sh tests/boards/linux/packages.sh "$out/$name" "$name"); then
        halves="$halves $half"
    else
        # tests/run.sh says it again at its end
        echo "SKIPPED linux_libgpiod_${half#*:}: nothing was tested on its kernel: $why"
    fi
done
[ -n "$halves" ] || exit 0
first=$(echo $halves | sed 's/ .*//') last=${halves##* }
releases=$(echo "$halves" | sed 's/:[0-9]//g')
make -s -j"$(nproc)" -f tests/boards/linux/linux.mk B="$build" $releases >"$out/make.log" 2>&1 ||
    { cat "$out/make.log"; bad linux_builds "see above"; exit 1; }
verdict linux_decoder "$(decoder_test | head -3 | tr '\n' ' ')"
device_tree
truths
for half in $halves; do # side by side: the machine has two cores
    release "${half%:*}" "${half#*:}" >"$out/${half%:*}.log" 2>&1 &
done
wait
for half in $halves; do
    cat "$out/${half%:*}.log"
    ! grep -q '^FAILED ' "$out/${half%:*}.log" || failed=1
done
exit $failed
