#!/bin/sh
# A firmware of the Pico's, whatever it draws, in the emulator: pictures, and frames a second.
# Usage: tests/boards/show.sh BUILD STEM [FRAMES]     STEM.bin, STEM.elf; into BUILD/show
#
# SPDX-License-Identifier: MIT
set -u
build=$1
stem=$2
out=$build/show
frames=${3:-48}
sh tests/boards/pico.sh "$build" set-up || exit 1
rm -rf "$out"
mkdir -p "$out"
node "$build/pico/frames.mjs" "$stem" --size 240x240 --gap 30 --xip 1 --frames "$frames" \
    --stream "$out/stream" || exit 1
"$build/zsim" panel --panel st7789:240x240 --invert --full --decode "$out/stream" --out "$out/%03d.png" \
    --moving "$out/show.png" >"$out/panel.txt" || exit 1
echo "$out/show.png: the moving picture; single ones beside it"
