#!/bin/sh
# How long a newcomer takes from a clean clone to a moving picture of a model that nobody here made, in the emulated
# Pico: the steps of the README, one after the other, in a folder of their own. Packages are installed on the way, where
# they are missing; what is there already shortens it, and is said.
#
# Usage: tests/lab/stopwatch.sh BUILD [MODEL]   MODEL: a truck of Debian's assimp-testmodels, unless said
# Exit status: 1 where a step fails, or all take more than ten minutes.
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
build=$(cd "$1" && pwd) || exit 2
model=${2:-/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf}
out=$build/stopwatch
BAR=600 # seconds

[ -e "$model" ] || { echo "FAILED stopwatch: no model $model; apt-get install assimp-testmodels"; exit 1; }
rm -rf "$out"
mkdir -p "$out"
start=$(date +%s)
step() { # NAME COMMAND...
    name=$1 from=$(date +%s)
    shift
    "$@" >"$out/log" 2>&1 || { tail -5 "$out/log"; echo "FAILED stopwatch: $name"; exit 1; }
    printf '%5d s  %s\n' $(($(date +%s) - from)) "$name"
}
missing=
for tool in arm-none-eabi-gcc node; do command -v $tool >/dev/null || missing="$missing $tool"; done
[ -e /usr/include/assimp/cimport.h ] || missing="$missing libassimp"
step 'git clone' git clone -q . "$out/zstrip"
step 'make sim: packages, zsim' make -C "$out/zstrip" sim
step 'zsim try MODEL: a turntable, frames a second' "$out/zstrip/build/zsim" try "$model" --out "$out/try"
step 'zsim new MODEL: a project' "$out/zstrip/build/zsim" new "$model" --board pico --out "$out/my3d"
step 'make show SCENE=teapot: the other packages, the emulator' make -C "$out/zstrip" show SCENE=teapot
step 'make -C my3d show: the moving picture' make -C "$out/my3d" show
grep -E '^(fps|frames) ' "$out/log" | sed 's/^/         /'
[ -s "$out/my3d/build/pico/show.png" ] || { echo "FAILED stopwatch: no picture"; exit 1; }
took=$(($(date +%s) - start))
echo "missing before:${missing:- nothing}"
[ $took -le $BAR ] || { echo "FAILED stopwatch: $took s, more than $BAR"; exit 1; }
echo "ok stopwatch: $took of $BAR s"
