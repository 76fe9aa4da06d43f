#!/bin/sh
# A study with its frames counted on emulated cores: firmware/app/study.c draws what zsim draws, on QEMU's Cortex-M3 and on
# the same machine as Armv6-M (M0). BUILD/study/NAME.csv, plots, and BUILD/study/index.html. Instructions, not cycles.
# Usage: sim/study.sh BUILD NAME [OPTION...]     options of zsim study: --quick, --full, --redo; NAME time or memory;
#        CORES='m3 m0', ZSIM and OUT may be set in the environment
#
# SPDX-License-Identifier: MIT
set -eu
cd "$(dirname "$0")/.."
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
    folder=$build/fw/mps2
    [ "$core" != m0 ] || folder=$build/fw/mps2-armv6m
    defines=
    [ "$3,$4,$5" = 1,10,3 ] || {
        defines="-DZS_STUDY=1 -DZS_RECIP_STEPS=$3 -DZS_TEXEL_COARSE_LOG2=$4 -DZS_SPAN_BOUND_LOG2=$5"
        folder=$folder-$3-$4-$5
    }
    cpu=cortex-m3
    [ "$core" != m0 ] || cpu=cortex-m0
    make -s -j2 -f firmware/boards/firmware.mk BOARD=mps2 B="$build" OUT="$folder" BOARD_CPU="-mcpu=$cpu -mthumb" \
        NAME="study_$name" APP_SRC=firmware/app/study.c APP_FLAGS="-I$settings" DEFINES="$defines" "$goal"
}
# Builds that the runs ask for: "steps coarse bound", a line each
builds=$(awk '/^\{/ { gsub(/[{},]/, " "); print $(NF - 2), $(NF - 1), $NF }' "$settings/study_settings.h" | sort -u)
which=
for core in ${CORES:-m3 m0}; do
    : >"$counts/$name-$core.part"
    echo "$builds" | while read -r steps coarse bound; do
        firmware all "$core" "$steps" "$coarse" "$bound"
        firmware run "$core" "$steps" "$coarse" "$bound" >>"$counts/$name-$core.part" 2>&1 || {
            echo "the frames of study $name could not be drawn on $core: see $counts/$name-$core.part" >&2
            exit 1
        }
    done
    mv "$counts/$name-$core.part" "$counts/$name-$core.csv"
    which="$which${which:+,}$core=$counts/$name-$core.csv"
done
exec "$zsim" study "$name" "$@" --out "$out" --counts "$which"
