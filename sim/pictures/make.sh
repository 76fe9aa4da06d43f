#!/bin/sh
# Draw the README's pictures again. Usage: sim/pictures/make.sh BUILD
set -eu
cd "$(dirname "$0")/../.."
"$1"/zsim demo --scene teapot,flyover,hall,globe --frames 1 --out "$1/pictures"
cp "$1/pictures/contact.png" sim/pictures/scenes.png
