#!/bin/sh
# `zsim render --panel` and `zsim panel`: every panel at every rotation shows its viewer the frame that is drawn
# without a panel; streams are decoded; what cannot be done is refused by name.
# Usage: tests/tools/panels.sh ZSIM WORKDIR     as tests/tools/cli.sh
set -u
. tests/tools/zsim.sh
. "$top/tests/tools/panel.sh"

# Boxes of many sizes in a heap, from no side the same
boxes 3 14 0 >heap.obj
look='--background 204060 --color ff9040 --light 2,3,1'

# ---- Every panel ----------------------------------------------------------------------------------
panels='st7789:240x240 st7789:240x320 st7789:135x240 st7789:172x320 ili9341:240x320 gc9a01:240x240
    ssd1351:128x128 ssd1351:128x96 ssd0323:128x64 ssd1306:128x64 ssd1306:128x32 ssd1306:64x48 ssd1306:72x40'
for panel in $panels; do
    begin "shows_the_frame_$(echo "$panel" | tr : _)"
    for degrees in 0 90 180 270; do
        size=$(turned "${panel#*:}" $degrees)
        z render heap.obj --out "frame_$size.png" --size "$size" $look
        [ $status -eq 0 ] || wrong "status $status: $(said)"
        for rows in 8 24; do
            rm -f panel.png panel.json
            z render heap.obj --out panel.png --panel "$panel" --rotate $degrees --strip $rows $look
            [ $status -eq 0 ] || wrong "status $status: $(said)"
            [ ! -s stdout ] && [ ! -s stderr ] || wrong "it talks: $(said)"
            if ! shown=$("$work/seen" panel.png "frame_$size.png" "$(kind "$panel")"); then
                wrong "$shown"
            elif [ "${shown##* }" -lt 2 ]; then
                wrong "an empty picture: $shown"
            fi
        done
    done
done

begin wire_is_as_fast_as_the_controller_takes_it
for of in st7789:240x240=62500000 gc9a01:240x240=62500000 ili9341:240x320=10000000 ssd1351:128x128=20000000 \
    ssd1306:128x64=10000000 ssd0323:128x64=4000000; do
    z render heap.obj --panel "${of%=*}" --out panel.png --stats panel.json
    look json panel.json panel_spi_hz
    is "clock of ${of%=*}" "$seen" "${of#*=}"
    z budget heap.obj --panel "${of%=*}"
    mhz=$(awk "BEGIN { printf \"%.1f\", ${of#*=} / 1e6 }")
    grep -q " ms at $mhz MHz$" stdout || wrong "$of: $(grep ' MHz' stdout | head -1)"
done

begin glass_that_is_inverted_or_bgr
z render heap.obj --out frame.png --size 240x240 $look
for options in '--invert' '--bgr' '--invert --bgr'; do
    for panel in st7789 gc9a01; do
        z render heap.obj --out panel.png --panel $panel:240x240 $options $look
        [ $status -eq 0 ] || wrong "status $status: $(said)"
        cmp -s panel.png frame.png || wrong "another picture"
    done
done

# 240 rows in 15 strips: a window of 2 x 5 bytes and RAMWR each; the wire at 62.5 MHz, 8 bits a byte
begin figures_of_the_wire
z render heap.obj --out panel.png --panel st7789:240x240 --stats panel.json $look
for want in 'panel_pixel_bytes 115200' 'panel_bytes 115365' 'panel_windows 15' 'panel_transactions 90' \
    'panel_spi_hz 62500000' 'panel_wire_us 14766.719999999999'; do
    look json panel.json "${want% *}"
    is "${want% *}" "$seen" "${want#* }"
done
z render heap.obj --out panel.png --panel st7789:240x240 --spi 1000000 --stats panel.json $look
look json panel.json panel_wire_us
is panel_wire_us "$seen" 922920
z render heap.obj --out panel.png --panel ssd1306:128x64 --stats panel.json $look
look json panel.json panel_spi_hz
is panel_spi_hz "$seen" 10000000
z render heap.obj --out panel.png --stats panel.json $look
grep -q panel_ panel.json && wrong "figures of a panel without one"

begin size_of_its_own_may_be_given
z render heap.obj --out panel.png --panel ssd1351:128x96 --rotate 270 --size 96x128 $look
[ $status -eq 0 ] || wrong "status $status: $(said)"

refused panel_unknown '--panel st7735:128x160 is not known; there are st7789:240x240,' quad.obj --panel st7735:128x160
refused panel_size 'ssd1306:72x40' quad.obj --panel ssd1306:128x65
refused other_size 'is not the picture of --panel st7789:135x240 --rotate 90, 240x135; leave it out' quad.obj \
    --panel st7789:135x240 --rotate 90 --size 135x240
refused strip_cuts_a_page \
    '--strip 12: ssd1306:128x64 takes 8 rows at a time, so give a multiple of that, such as 16' \
    quad.obj --panel ssd1306:128x64 --strip 12
refused strip_cuts_a_byte \
    '--strip 9: ssd0323:128x64 takes 2 rows at a time, so give a multiple of that, such as 10' \
    quad.obj --panel ssd0323:128x64 --rotate 90 --strip 9
refused spi_out_of_range '--spi 10 is outside its range' quad.obj --panel st7789:240x240 --spi 10
usage rotate_45 '--rotate wants 0|90|180|270' render quad.obj --out refused/x.png --panel st7789:240x240 --rotate 45
usage rotate_alone '--rotate is for a --panel' render quad.obj --out refused/x.png --rotate 90
usage spi_alone '--spi is for a --panel' render quad.obj --out refused/x.png --spi 1000000
usage panel_reference 'leave --panel out' render quad.obj --out refused/x.png --panel st7789:240x240 --reference

begin whole_picture_as_one_strip
z render heap.obj --out frame.png --size 72x40 $look
z render heap.obj --out panel.png --panel ssd1306:72x40 --strip 100 $look
[ $status -eq 0 ] || wrong "status $status: $(said)"
shown=$("$work/seen" panel.png frame.png mono) || wrong "$shown"

# ---- Streams --------------------------------------------------------------------------------------
words() { # HEX...    16-bit words, least significant byte first, of four digits each
    for w in "$@"; do printf "\\$(printf %03o "0x${w#??}")\\$(printf %03o "0x${w%??}")"; done
}
# Reset, awake, 16 bits, on, turned; two frames: a pixel at 5, 7 of the picture, then one at 6, 7
{
    words 0200 0011 003a 0155 0036 0160 0800 0029
    words 002a 0100 0105 0100 0106 002b 0100 0107 0100 0107 002c 01f8 0100 0400
    words 0107 01e0 0400
} >stream.bin
begin decodes_a_stream
z panel --panel st7789:240x240 --rotate 90 --decode stream.bin --out 'd_%03d.png' --raw 'd_%03d.raw'
[ $status -eq 0 ] || wrong "status $status: $(said)"
[ ! -s stderr ] || wrong "it talks: $(said)"
for line in 'frames 2' 'bytes 21' 'command_bytes 7' 'data_bytes 14' 'pixels 2' 'windows 1' 'problems 0'; do
    grep -qx "$line" stdout || wrong "'$line' is not printed: $(tr '\n' ' ' <stdout)"
done
pixel() { # FILE X Y    of 240 px wide RGB565
    od -An -tx1 -j $((2 * ($2 + 240 * $3))) -N 2 "$1" | tr -d ' \n'
}
is "pixel 5,7 of frame 0" "$(pixel d_000.raw 5 7)" f800
is "pixel 5,7 of frame 1" "$(pixel d_001.raw 5 7)" f800
is "pixel 6,7 of frame 1" "$(pixel d_001.raw 6 7)" 07e0
is "bytes of a frame" "$(wc -c <d_000.raw | tr -d ' ')" 115200
[ "$(pixel d_000.raw 6 7)" != 07e0 ] || wrong "frame 0 holds what came after it"
[ -s d_001.png ] && [ ! -e d_002.png ] || wrong "not two pictures"

begin text_of_a_stream # in the middle of a command, of two frames: what is seen and counted stays
{
    words 1048 1069 100a 0200 0011 003a 0155 0036 0160 0800 0029
    words 002a 0100 0105 1078 0100 0106 1009 002b 0100 0107 0100 0107 100a 002c 01f8 0100 0400
    words 0107 01e0 0400 106f 106b
} >text.bin
cp stdout stdout.without
z panel --panel st7789:240x240 --rotate 90 --decode text.bin --out 't_%03d.png'
[ $status -eq 0 ] || wrong "status $status: $(said)"
is text "$(grep '^text ' stdout | tr '\n' ';')" 'text Hi;text x?;text ok;'
is "what else is said" "$(grep -v '^text ' stdout)" "$(cat stdout.without)"
cmp -s t_001.png d_001.png || wrong "another picture"

begin levels_of_a_stream # six NOPs: dark
{ words 0200 00e3 00e3 00e3 00e3 00e3 00e3; } >dark.bin
z panel --panel ssd1306:72x40 --decode dark.bin --out dark.png --raw dark.raw
[ $status -eq 0 ] || wrong "status $status: $(said)"
is "bytes of a frame" "$(wc -c <dark.raw | tr -d ' ')" 2880
is "what is lit" "$(tr -d '\000' <dark.raw | wc -c | tr -d ' ')" 0

begin problems_of_a_stream_are_told
{ words 0200 0011 0099 0029 002a 0100 0105; } >wrong.bin
z panel --panel st7789:240x240 --decode wrong.bin --out wrong.png
is status $status 1
grep -qx 'problems 2' stdout || wrong "no 'problems 2'"
grep -qx 'byte 1: 0x99 is not a command of this controller' stdout || wrong "the first is missing"
grep -q '^byte 6: the stream ends inside CASET' stdout || wrong "the second is missing"
grep -q 'wrong.bin: byte 1: 0x99 is not a command' stderr || wrong "not on standard error: $(said)"
[ -s wrong.png ] || wrong "no picture"

stream_refused() { # NAME WHAT ARGUMENT...
    begin "refused_$1"
    what=$2
    shift 2
    z panel "$@"
    is status $status 1
    is "lines on standard error" "$(wc -l <stderr | tr -d ' ')" 1
    grep -qF -- "$what" stderr || wrong "'$what' is not in: $(said)"
}
printf 'abc' >odd.bin
words 0011 2029 >bits.bin
words 1141 >letter.bin
words 0511 >both.bin
stream_refused stream_missing 'none.bin: cannot be read' --panel st7789:240x240 --decode none.bin --out x.png
mkfifo pipe.bin
cat stream.bin >pipe.bin &
stream_refused stream_pipe 'pipe.bin: is not a regular file; write its bytes to one' --panel st7789:240x240 \
    --decode pipe.bin --out x.png
stream_refused stream_folder '.: is not a regular file; name a file in it' --panel st7789:240x240 --decode . --out x.png
stream_refused stream_odd 'odd.bin: has 3 bytes' --panel st7789:240x240 --decode odd.bin --out x.png
stream_refused stream_bits 'word 1 is 0x2029' --panel st7789:240x240 --decode bits.bin --out x.png
stream_refused stream_mark 'word 0 is 0x0511' --panel st7789:240x240 --decode both.bin --out x.png
stream_refused stream_text 'word 0 is 0x1141' --panel st7789:240x240 --decode letter.bin --out x.png
stream_refused stream_panel 'there are st7789:240x240' --panel st7789 --decode stream.bin --out x.png
stream_refused frames_one_name 'number them' --panel st7789:240x240 --decode stream.bin --out x.png
usage panel_out 'panel: --out is missing' panel --panel st7789:240x240 --decode stream.bin
usage panel_pattern "takes one number" panel --panel st7789:240x240 --decode stream.bin --out '%s.png'
usage panel_option "unknown option '--turn'" panel --turn 90
usage panel_rotate "0|90|180|270" panel --rotate 91

begin panel_help
z panel --help
is status $status 0
for option in --panel --decode --out --raw --rotate --invert --bgr ssd1306:72x40; do
    grep -qF -- "$option" stdout || wrong "$option is not named"
done

finish
[ $n_failed -eq 0 ]
