#!/bin/sh
# A study with its frames counted on emulated cores: firmware/app/study.c draws what zsim draws, on QEMU's Cortex-M3 and
# on the same machine as Armv6-M (M0): instructions, not cycles. On an emulated RP2040 (pico): cycles, and on this
# machine (host): instructions by callgrind, of some of the runs of study time. BUILD/study/NAME.csv, plots, and
# BUILD/study/index.html.
# Usage: sim/study/study.sh BUILD NAME [OPTION...]     NAME time or memory; options of zsim study: --quick, --full,
#        --redo; CORES='m3 m0' (or m3 m0 pico host), ZSIM and OUT may be set in the environment
#
# SPDX-License-Identifier: MIT
set -eu
cd "$(dirname "$0")/../.."
build=$1
name=$2
shift 2
zsim=${ZSIM:-$build/zsim}
out=${OUT:-$build/study}
counts=$out/counts
settings=$counts/$name
mkdir -p "$settings"

"$zsim" study "$name" "$@" --settings >"$settings/now.h"
cmp -s "$settings/now.h" "$settings/study_settings.h" || cp "$settings/now.h" "$settings/study_settings.h"

firmware() { # GOAL CORE STEPS COARSE BOUND
    goal=$1
    core=$2
    board=mps2
    folder=$build/fw/mps2
    flags="-I$settings"
    cpu='-mcpu=cortex-m3 -mthumb'
    case $core in
    m0)
        folder=$build/fw/mps2-armv6m
        cpu='-mcpu=cortex-m0 -mthumb' ;;
    pico)
        board=pico
        folder=$build/fw/pico
        flags="$flags -DSTUDY_ARENA=120000u -DSTUDY_TICK=125u -DSTUDY_SHORT=1"
        cpu='-mcpu=cortex-m0plus -mthumb -DZS_RP2040=1' ;;
    host)
        board=host
        folder=$build/fw/host
        flags="$flags -DSTUDY_SHORT=1"
        cpu= ;;
    esac
    defines=
    [ "$3,$4,$5" = 1,10,2 ] || {
        defines="-DZS_STUDY=1 -DZS_RECIP_STEPS=$3 -DZS_TEXEL_COARSE_LOG2=$4 -DZS_SPAN_BOUND_LOG2=$5"
        folder=$folder-$3-$4-$5
    }
    make -s -j"$(nproc)" -f firmware/boards/firmware.mk BOARD=$board B="$build" OUT="$folder" BOARD_CPU="$cpu" \
        NAME="study_$name" APP_SRC=firmware/app/study.c APP_FLAGS="$flags" DEFINES="$defines" "$goal"
}
count() { # CORE STEPS COARSE BOUND
    if [ "$1" = pico ]; then
        firmware image "$@" >/dev/null
        node "$build/pico/parts.mjs" "$folder/study_$name"
    elif [ "$1" = host ]; then
        firmware all "$@"
        host_counts "$folder/study_$name.elf" "$counts/$name-calls"
    else
        firmware all "$@"
        firmware run "$@" 2>&1 # semihosting writes to either
    fi
}
# PROGRAM STEM: its lines, with what callgrind counted of each frame in the place of their instructions. It writes a
# file a call of study_frame, numbered from 1.
host_counts() {
    rm -f "$2".*
    valgrind --tool=callgrind --toggle-collect=study_frame --dump-after=study_frame --callgrind-out-file="$2.out" \
        "$1" >"$2.csv" 2>"$2.err" || { cat "$2.err"; return 1; }
    awk -F, -v OFS=, -v stem="$2.out." '
        NF == 3 {
            n++
            file = stem n
            while ((getline text <file) > 0)
                if (text ~ /^totals: /) $3 = substr(text, 9) + 0
            close(file)
        }
        { print }' "$2.csv"
    rm -f "$2".*
}
# Builds that the runs ask for: "steps coarse bound", a line each
builds=$(awk '/^\{/ { gsub(/[{},]/, " "); print $(NF - 2), $(NF - 1), $NF }' "$settings/study_settings.h" | sort -u)
which=
for core in ${CORES:-m3 m0}; do
    [ "$core" != pico ] || sh tests/boards/pico.sh "$build" set-up
    : >"$counts/$name-$core.part"
    echo "$builds" | while read -r steps coarse bound; do
        count "$core" "$steps" "$coarse" "$bound" >>"$counts/$name-$core.part" || {
            echo "the frames of study $name could not be drawn on $core: see $counts/$name-$core.part" >&2
            exit 1
        }
    done
    ! grep -qE 'fault|^problem' "$counts/$name-$core.part" || {
        echo "the frames of study $name failed on $core: see $counts/$name-$core.part" >&2
        exit 1
    }
    mv "$counts/$name-$core.part" "$counts/$name-$core.csv"
    which="$which${which:+,}$core=$counts/$name-$core.csv"
done
exec "$zsim" study "$name" "$@" --out "$out" --counts "$which"
