#!/bin/sh
# Draw the README's pictures again. Usage: sim/pictures/make.sh BUILD
set -eu
cd "$(dirname "$0")/../.."
"$1"/zsim demo --scene stilllife,cockpit,forest --frames 12 --step 6 --size 160x160 --out "$1/pictures" \
    --moving sim/pictures/scenes.gif --delay 180
