# Images of boards and what they should draw, for tests of boards. Sourced with BUILD in $build, a folder of the test's
# own in $out. `ok NAME` or `FAILED NAME: reason` a test.
#
# SPDX-License-Identifier: MIT
. tests/lib/ok.sh
mkdir -p "$out"

verdict() { # NAME REASON-OR-NOTHING
    if [ -z "$2" ]; then ok "$1"; else bad "$1" "$2"; fi
}
field() { # FILE NAME    the value in lines "name value"
    sed -n "s/^$2 //p" "$1"
}

# Build what is flashed: BOARD MAKE-ARGUMENTS...   as build/fw/BOARD/NAME.elf
image() {
    board=$1
    shift
    make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD="$board" B="$build" "$@" image \
        >"$out/make.log" 2>&1 && return
    cat "$out/make.log"
    bad "${board}_builds $*" "see above"
    exit 1
}

sizes() { # of the image built last: FLASH RAM
    sed -n 's/.*: flash \([0-9]*\) .* RAM \([0-9]*\) .*/\1 \2/p' "$out/make.log"
}

# Draw what the simulator draws: STEM SCENE FRAMES STEP ZSIM-OPTIONS...   as STEM/SCENE_NNN.bin, .png
truth() {
    stem=$1 scene=$2 frames=$3 step=$4
    shift 4
    "$build/zsim" demo --scene "$scene" --frames "$frames" --step "$step" --raw --out "$stem" "$@" >"$stem.txt" 2>&1 ||
        { cat "$stem.txt"; bad "zsim demo" "$scene $*"; }
}

# Words of a const in a copy of an image: IN.elf OUT.elf SYMBOL[+BYTES] WORD...
patch() {
    [ -x "$out/patch" ] || gcc -std=c11 -O1 -Wall -Wextra tests/boards/patch.c -o "$out/patch" || exit 1
    "$out/patch" "$@"
}

# The show draws frames 0, STEP .. and stops: ELF COPY FRAMES STEP   a patched copy of the image
stops_after() {
    patch "$1" "$2" show_test "$3" "$4"
}
