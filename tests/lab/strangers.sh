#!/bin/sh
# What zsim budget says of models that nobody here made, and what the program that zsim new makes of each takes on an
# emulated RP2040. The models are those of Debian's assimp-testmodels, which have a licence of the BSD's kind.
#
# Usage: tests/lab/strangers.sh BUILD [MODEL...]   BUILD/zsim; the report of tests/records on standard output. A model:
#        a path below the package's folder, "/" before any other
#
# Three views of each, a quarter of a turn apart. Measured: all that the core runs for a frame, with the panel's driver
# and the counter over the picture. `ok` or `FAILED` a line, and the estimate's error, in per cent of what was measured.
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
. tests/lib/ok.sh
build=$(cd "$1" && pwd) || exit 2
shift
models=/usr/share/assimp/models
out=$build/strangers
BAR=10 # per cent
[ $# -gt 0 ] || set -- OBJ/WusonOBJ.obj OBJ/spider.obj STL/Spider_binary.stl STL/Wuson.stl STL/3DSMaxExport.STL \
    STL/sphereWithHole.stl OBJ/regr01.obj OBJ/empty_mat.obj glTF/CesiumMilkTruck/CesiumMilkTruck.gltf \
    glTF2/BoxTextured-glTF-Binary/BoxTextured.glb glTF2/ClearCoat-glTF/ClearCoatTest.gltf \
    glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb
mkdir -p "$out"

macro() { # NAME
    sed -n "s/^#define MODEL_$1 \([^/]*\).*/\1/p" "$project/model.h" | tr -d '{},u'
}
# Options of the view in which frame FRAME of the project's program shows the model: the eye turns where there the model
# does, about the upright axis through the point that the converter made the origin.
view() { # FRAME
    echo "$(macro MIDDLE) $(macro RADIUS) $1 $placed" | awk '{
        rad = 3.14159265358979 / 180; turn = -$5 / 48 * 360 * rad; yaw = 22 * rad + turn; tilt = 19 * rad; far = 3 * $4
        x = cos(turn) * $1 + sin(turn) * $3; z = cos(turn) * $3 - sin(turn) * $1
        eye_x = x + far * sin(yaw) * cos(tilt); eye_y = $2 + far * sin(tilt); eye_z = z + far * cos(yaw) * cos(tilt)
        printf "--at %.9g,%.9g,%.9g ", x / $6 + $7, $2 / $6 + $8, z / $6 + $9
        printf "--eye %.9g,%.9g,%.9g ", eye_x / $6 + $7, eye_y / $6 + $8, eye_z / $6 + $9
        printf "--fov 45 --near %.9g --far %.9g", $4 / $6, 5 * $4 / $6 }'
}
pool() { # NAME
    cat "$project/main.c" "$project/display.h" |
        sed -n "s/^#define $1 \([0-9]*\) .*/\1/p; s/^#define $1 \([0-9]*\)$/\1/p" | head -1
}
one() { # MODEL
    case $1 in /*) model=$1 ;; *) model=$models/$1 ;; esac
    name=of_$(basename "$1" | tr -c 'A-Za-z0-9\n' _)
    project=$out/$name
    rm -rf "$project"
    "$build/zsim" new "$model" --board pico --out "$project" >"$out/$name.txt" 2>&1 ||
        { bad "$name" "zsim new: $(tail -1 "$out/$name.txt")"; return; }
    # world units to a unit of the model, and where the converter put the origin, in the model's units
    placed=$(sed -n 's/^ *position = \([^,]*\), \([^,]*\), \([^ ]*\) + .*; \([0-9.e+]*\) world.*/\4 \1 \2 \3/p' \
        "$out/$name.txt")
    mkdir -p "$project/build/pico"
    make -s -C "$project" image ZSIM="$build/zsim" >>"$out/$name.txt" 2>&1 ||
        { bad "$name" "its program does not build"; return; }
    cp -r "$build/pico/node_modules" "$project/zstrip/emulator/"
    node "$project/zstrip/emulator/frames.mjs" "$project/build/fw/pico/$name" --frames 37 --cycles 1 --seconds 200 \
        --stream "$project/stream" >"$out/$name.frames" 2>&1 ||
        { bad "$name" "$(tail -1 "$out/$name.frames")"; return; }
    for frame in 12 24 36; do
        # shellcheck disable=SC2046
        "$build/zsim" budget "$model" --part rp2040 --size 240x240 --strip "$(pool ROWS)" --buffers 2 \
            --tris "$(pool TRIS)" --verts "$(pool VERTS)" $(view $frame) --csv >"$out/$name.csv" 2>>"$out/$name.txt" ||
            { bad "$name" "zsim budget: $(tail -1 "$out/$name.txt")"; return; }
        echo "$(sed -n 's/^draw_RP2040,\([0-9]*\),.*/\1/p' "$out/$name.csv") \
            $(sed -n "s/^frame $frame //p" "$out/$name.frames")"
    done | awk -v name="$name" -v tris="$(macro TRIANGLES)" -v bar=$BAR '
        NF == 2 { told += $1; ran += $2; n++ }
        END { if (n != 3) { print "FAILED " name ": not counted"; exit 1 }
              off = 100 * (told / ran - 1)
              within = off < bar && -off < bar
              printf "%s %-28s %6d triangles  estimated %6.2f  measured %6.2f M cycles  %+5.1f %%\n",
                  within ? "ok" : "FAILED", name, tris, told / n / 1e6, ran / n / 1e6, off
              exit !within }' || failed=1
}

sh tests/boards/pico.sh "$build" set-up
echo "Of commit $(git log -1 --format=%h -- firmware/zstrip sim/budget 2>/dev/null): firmware/zstrip sim/budget"
echo
echo "zsim budget on models of others (make strangers): cycles of drawing a frame on an emulated RP2040, 240x240"
for stranger in "$@"; do
    one "$stranger"
done
exit $failed
