#!/bin/sh
# Draw the README's pictures again. Usage: sim/pictures/make.sh BUILD
set -eu
cd "$(dirname "$0")/../.."
"$1"/zsim demo --scene stilllife,cockpit,forest --frames 16 --step 5 --size 200x200 --out "$1/pictures" \
    --moving sim/pictures/scenes.png --delay 160
