#!/bin/sh
# Every README.md as its reader follows it: each command in a code block is run, each C program compiled and run, each
# link and make target looked up, each figure that a command prints compared with what it prints now.
# Usage: tests/tools/readme.sh BUILD           BUILD/libcore.a, BUILD/libmeshes.a, BUILD/zsim
#        tests/tools/readme.sh BUILD write     first write the tables and outputs in the READMEs anew
#
# Blocks of code:
#   ```sh           run, all of a README in order, in a copy of the repository where MODEL.obj and T.png lie. Targets
#                   of make that take long are looked up only (make -n); other parts of make test run what they run.
#   ```sh not run: REASON
#   ```text         what the ```sh before it prints, to the letter
#   ```c            a program; see below for each
#   others          lines that begin with make, sh or build/ are run
#
# SPDX-License-Identifier: MIT
set -eu
build=$(cd "$1" && pwd)
mode=${2:-}
top=$PWD
out=$(mkdir -p "$1/test/readme" && cd "$1/test/readme" && pwd)
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES
. tests/lib/positional.sh
designated_headers "$out/headers" "$top"
find . \( -name README.md -o -name CONTRIBUTING.md \) -not -path './.git/*' -not -path '*/build/*' | sed 's/^..//' |
    sort >"$out/readmes"
if command -v ccache >/dev/null; then
    REAL_GCC=$(PATH=$(echo "$PATH" | tr ':' '\n' | grep -v ccache | paste -sd :) && command -v gcc) # not ccache itself
    mkdir -p "$out/bin"
    cp tests/tools/gcc_by_file.sh "$out/bin/gcc"
    chmod +x "$out/bin/gcc"
    GCC_KEPT=$out/kept
    rm -rf "$GCC_KEPT"
    export REAL_GCC GCC_KEPT PATH="$out/bin:$PATH"
fi
section() { # README HEADING
    awk -v want="## $2" '/^## / { in_it = $0 == want } in_it' "$1"
}
code() {
    awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on'
}

# ---- The table beside others ---------------------------------------------------------------------------------------
golden=$(find tests -name bench.txt)
peers=$(find tests -name peers.txt)
"$build/zsim" demo --scene sheet,slivers --frames 1 --out "$out/frames" >"$out/wrong.txt"
"$build/zsim" budget --scene relief --size 320x240 --strip 8 >"$out/budget.txt"
"$build/zsim" budget --scene sheet --size 320x240 --strip 24 --buffers 1 >"$out/sheet.txt"
awk '
    FILENAME ~ /bench.txt$/ { if ($1 == "M3") ours[$2] = three($3 / 1e6); next }
    FILENAME ~ /wrong.txt$/ {
        if (!/%/ || ($1 != "sheet" && $1 != "slivers")) next
        split($0, part, "|"); n = split(part[5], f, " "); ours["wrong " $1] = sprintf("%.2f %%", f[1]); next }
    FILENAME ~ /budget.txt$/ {
        if (/^Flash/) flash = 1
        if ($1 == "together" && !flash) ours["RAM"] = sprintf("%.0f KB", $2 / 1000)
        if ($1 == "renderer" && flash) ours["flash"] = sprintf("%.0f KB", $2 / 1000)
        next }
    FILENAME ~ /sheet.txt$/ {
        if ($1 == "together" && !sheet++) ours["RAM sheet"] = sprintf("%.0f KB", $2 / 1000)
        next }
    /^#/ { next }
    { peer[$1 " " $2, $3] = $4 }
    function three(x) { return x < 10 ? sprintf("%.2f", x) : sprintf("%.1f", x) }
    function row(name, own, key, unit, i, line, value) {
        line = "| " name " | " own " |"
        for (i = 1; i <= 4; i++) {
            value = peer[key, who[i]]
            if (value == "" && key == "flash" && (("flash least", who[i]) in peer)) {
                value = peer["flash least", who[i]]
                if (peer["flash most", who[i]] != value) value = value " to " peer["flash most", who[i]]
            }
            line = line " " (value == "" ? "–" : value unit) " |"
        }
        print line
    }
    END {
        split("small3dlib Pico3D TinyGL TGX", who, " ")
        print "| | zstrip | small3dlib | Pico3D | TinyGL | TGX |"
        print "|---|---|---|---|---|---|"
        row("head, one colour a face", ours["relief"], "M3 relief", "")
        row("head, textured", ours["relief_tex"], "M3 relief_tex", "")
        row("`layers`, front to back", ours["layers_ftb"], "M3 layers_ftb", "")
        row("`layers`, back to front", ours["layers_btf"], "M3 layers_btf", "")
        row("`sheet`", ours["sheet"], "M3 sheet", "")
        row("wrong pixels, `sheet`", ours["wrong sheet"], "wrong sheet", " %")
        row("wrong pixels, `slivers`", ours["wrong slivers"], "wrong slivers", " %")
        row("RAM, head", ours["RAM"], "RAM 320x240", " KB")
        row("RAM, `sheet`", ours["RAM sheet"], "RAM 320x240", " KB")
        row("flash", ours["flash"], "flash", " KB")
        print "| arithmetic | integers | integers | integers | floats | floats |"
        print "| textures | perspective | affine; perspective on request | affine | perspective | perspective |"
        print "| brings | panel drivers, simulator, model converter | one header | a game | OpenGL calls | 2D drawing |"
    }' "$golden" "$out/wrong.txt" "$out/budget.txt" "$out/sheet.txt" "$peers" >"$out/table"
if [ "$mode" = write ]; then
    awk -v table="$out/table" '
        /^\| \| zstrip \|/ { while ((getline line <table) > 0) { print line; rows++ } old = rows }
        old > 0 && /^\|/ { old--; next }
        { old = 0; print }' README.md >"$out/new" && cp "$out/new" README.md
fi
awk '/^\| \| zstrip \|/ { on = 1 } on && !/^\|/ { exit } on' README.md >"$out/table.is"
if other=$(grep -vxFf "$out/table.is" "$out/table"); then
    echo "FAILED readme_beside_others: now $(echo "$other" | head -1) (sh tests/tools/readme.sh build write)"
elif ! grep -q "1560 of 2520 triangles" "$out/budget.txt"; then
    echo "FAILED readme_beside_others: $(head -1 "$out/budget.txt")"
else
    echo "ok readme_beside_others: $(($(wc -l <"$out/table") - 2)) rows as measured"
fi
# Frames a second that a wire carries
awk '/^\| [0-9]+x[0-9]+, RGB565 / {
        split($2, size, /[x,]/); split("10 20 32 62.5", mhz, " ")
        line = "| " $2 " RGB565 |"
        for (i = 1; i <= 4; i++) {
            rate = mhz[i] * 1e6 / (size[1] * size[2] * 16)
            line = line sprintf(rate < 10 ? " %.1f |" : " %.0f |", rate)
        }
        n++
        if (line != $0) { print "FAILED readme_wire: " $0 " is " line; bad = 1 }
    }
    END { if (!bad) print (n == 3 ? "ok" : "FAILED") " readme_wire: " n + 0 " rows" }' hal/linux/README.md

# ---- What a pixel of an effect takes --------------------------------------------------------------------------------
# tests/tools/effect_rows.txt: rows of the table, and which of tests/records/effects.txt they show
awk '
    FILENAME ~ /effects.txt$/ {
        if ($1 != "M3" && $1 != "M0") next
        at = $1; n = $2; sub(/^[^ ]+ [^ ]+ /, ""); of[at, $0] = sprintf("%.0f", n / 100)
        next }
    /^#/ { next }
    function figure(x) { return x + 0 >= 1000 ? int(x / 1000) sprintf(",%03d", x % 1000) : x }
    function filled(text, at, name) {
        while (match(text, /\{[^}]*\}/)) {
            name = substr(text, RSTART + 1, RLENGTH - 2)
            if (!((at, name) in of)) return "no " at " " name
            text = substr(text, 1, RSTART - 1) figure(of[at, name]) substr(text, RSTART + RLENGTH)
        }
        return text
    }
    BEGIN { print "| | M3 | M0 |"; print "| --- | --- | --- |" }
    { split($0, part, " [|] "); print "| " part[1] " | " filled(part[2], "M3") " | " filled(part[2], "M0") " |" }
    ' tests/records/effects.txt tests/tools/effect_rows.txt >"$out/effects.table"
effects=firmware/zstrip/effect/README.md
if [ "$mode" = write ]; then
    awk -v table="$out/effects.table" '
        /^[|] [|] M3 [|] M0 [|]/ { while ((getline line <table) > 0) print line; old = 1 }
        old && /^[|]/ { next }
        { old = 0; print }' $effects >"$out/new" && cp "$out/new" $effects
fi
awk '/^[|] [|] M3 [|] M0 [|]/ { on = 1 } on && !/^[|]/ { exit } on' $effects >"$out/effects.is"
if cmp -s "$out/effects.is" "$out/effects.table"; then
    echo "ok readme_effects: $(($(wc -l <"$out/effects.table") - 2)) rows as on record"
else
    other=$(diff "$out/effects.is" "$out/effects.table" | grep '^>' | head -1)
    echo "FAILED readme_effects: now $other (sh tests/tools/readme.sh build write)"
fi

# ---- Words, links, make targets --------------------------------------------------------------------------------------
words=$(wc -w <README.md)
if [ "$words" -le 1200 ]; then
    echo "ok readme_is_short ($words words)"
else
    echo "FAILED readme_is_short: $words words, at most 1200"
fi
links=0
broken=
while read -r file; do
    at=$(dirname "$file")
    for link in $(grep -oE '\]\([^)# ]+' "$file" | cut -c3- | grep -v '://'); do
        links=$((links + 1))
        [ -e "$at/$link" ] || broken="$broken $file:$link"
    done
done <"$out/readmes"
if [ -z "$broken" ]; then echo "ok readme_links ($links)"; else echo "FAILED readme_links:$broken"; fi
targets=$(xargs grep -ohE '`make [a-z][a-z-]*' <"$out/readmes" | cut -d ' ' -f 2 | sort -u)
missing=
for target in $targets; do
    grep -qE "^(## )?([a-z-]+ )*$target( [a-z-]+)*:" Makefile $(find firmware sim tests hal -name "*.mk") ||
        missing="$missing $target"
done
if [ -z "$missing" ]; then
    echo "ok readme_targets ($(echo "$targets" | wc -w))"
else
    echo "FAILED readme_targets:$missing"
fi

# ---- firmware/zstrip: the cube, as it would be compiled for a board ---------------------------------------------
section firmware/zstrip/README.md 'A first picture' | code >"$out/example.c"
lines=$(wc -l <"$out/example.c")
cat >"$out/main.c" <<'MAIN'
#include <stdio.h>
#include "example.c"
static uint32_t drawn, sum, strips;
static int send(void *ctx, const struct zs_strip *s)
{
    (void)ctx;
    for (uint32_t i = 0; i < s->n_bytes; i += 2) {
        const uint32_t c = (uint32_t)s->px[i] << 8 | s->px[i + 1];
        drawn += c != zs_rgb565(10, 20, 60);
        sum = sum * 31u + c;
    }
    strips++;
    return 0;
}
int main(void)
{
    const int err = start() ? 1 : draw_cube(4000, send, 0);
    printf("%d %u %u\n", err, (unsigned)strips, (unsigned)drawn);
    return err != 0;
}
MAIN
gcc -std=c11 -Wall -Wextra -Werror -Wconversion -I"$out/headers" -Ifirmware/zstrip -I"$out" "$out/main.c" \
    "$build/libcore.a" -o "$out/example"
# shellcheck disable=SC2046
set -- $("$out/example")
[ "$lines" -le 40 ] && echo "ok readme_example_is_$lines""_lines" || echo "FAILED readme_example: $lines lines"
if [ "$1" -eq 0 ] && [ "$2" -eq 15 ] && [ "$3" -gt 8000 ] && [ "$3" -lt 40000 ]; then
    echo "ok readme_example_draws_a_cube ($3 pixels in $2 strips)"
else
    echo "FAILED readme_example_draws_a_cube: error $1, $2 strips, $3 pixels"
fi

# ---- hal/panel: compiled as it stands, and three frames of a scene through it -----------------------------------
code <hal/panel/README.md >"$out/panel_example.c"
cat >"$out/panel_main.c" <<'MAIN'
#include <stdio.h>
#include "panel_example.c"
static const struct zs_config config = { .width = W, .height = H, .strip_h = ROWS, .max_tris = 8, .max_verts = 8,
                                         .varyings = ZS_VARYINGS_FLAT, .buffers = 2,
                                         .depth = &zs_depth_recip };
ZS_ARENA(arena, ZS_ARENA_BYTES(W, H, ROWS, 8, 8, ZS_VARYINGS_FLAT, 2));
int main(void)
{
    static struct zs_renderer r;
    struct zs_scene scene = { .background = 7 };
    struct zs_camera camera;
    int err = zs_init(&r, &config, arena, sizeof arena);
    err = err ? err : zs_camera_perspective(&camera, 8192, H, 10, 1000);
    const int32_t eye[3] = { 0, 0, 5 }, at[3] = { 0, 0, 0 }, up[3] = { 0, 1, 0 };
    err = err ? err : zs_camera_look_at(&camera, eye, at, up);
    err = err ? err : start_panel(&r);
    for (int i = 0; !err && i < 3; i++)
        err = zs_render(&r, &scene, &camera, &sink);
    printf("%d %u\n", err, (unsigned)zs_frame_stats(&r)->strips_clean);
    return err != 0;
}
MAIN
gcc -std=c11 -Wall -Wextra -Werror -Wconversion -I"$out/headers" -Ifirmware/zstrip -Ihal -Ihal/panel -I"$out" \
    "$out/panel_main.c" "$build/libcore.a" hal/panel/*.c hal/null/*.c -o "$out/panel_example"
said=$("$out/panel_example")
[ "$said" = "0 15" ] && echo "ok readme_panel_example" || echo "FAILED readme_panel_example: $said"

# ---- sim/README.md: a model of one's own, to the letter -------------------------------------------------------------
# A folder as the reader has it: zsim built, the library, a model; then the section's program and commands.
own='Write a program around it'
follow() { # NAME LEAST-PIXELS MOST-PIXELS COLOURS    MODEL.obj and what belongs to it lie in $out/NAME
    home=$out/$1
    ln -sfn "$top/firmware" "$home/firmware"
    ln -sfn "$build" "$home/build"
    section sim/README.md "$own" | code >"$home/picture.c"
    section sim/README.md "$own" | awk '/^```sh$/ { on = 1; next } /^```$/ { on = 0 } on' >"$home/commands"
    if ! (cd "$home" && [ "$(wc -l <commands)" -eq 3 ] && sh -eu commands >log 2>&1); then
        echo "FAILED readme_own_$1: $(tail -3 "$home/log" | tr '\n' ' ')"
        return
    fi
    if grep -q warning "$home/log"; then
        echo "FAILED readme_own_$1: $(grep warning "$home/log" | head -1)"
        return
    fi
    # pixels that are not the background, colours among them
    # shellcheck disable=SC2046
    set -- "$@" $(tail -c 172800 "$home/picture.ppm" | od -An -v -tx1 -w3 | sort | uniq -c |
        awk '$2 $3 $4 != "081438" { n += $1; colors++ } END { print n + 0, colors + 0 }')
    if [ "$(head -1 "$home/picture.ppm")" = 'P6 240 240 255' ] && [ "$(wc -c <"$home/picture.ppm")" -eq 172815 ] &&
        [ "$5" -ge "$2" ] && [ "$5" -le "$3" ] && [ "$6" -ge "$4" ]; then
        echo "ok readme_own_$1 ($5 of 57600 pixels, $6 colours)"
    else
        echo "FAILED readme_own_$1: $5 pixels of $6 colours, $(wc -c <"$home/picture.ppm") bytes"
    fi
}
make=$out/make
gcc -O1 -Ifirmware/zstrip -I"$build/gen" tests/tools/convert/make.c \
    "$build/libmeshes.a" "$build/libcore.a" -lpng -lturbojpeg -lm -o "$make"
mkdir -p "$out/teapot" "$out/boxes" "$out/torus"
"$make" teapot >"$out/teapot/MODEL.obj"
"$make" boxes 5 3 >"$out/boxes/MODEL.obj"
"$make" boxes.mtl 3 >"$out/boxes/boxes.mtl"
"$make" torus 48 24 4 torus.mtl >"$out/torus/MODEL.obj"
printf 'newmtl skin\nmap_Kd photo.png\n' >"$out/torus/torus.mtl"
"$make" png photo 128 128 "$out/torus/photo.png"
lines=$(section sim/README.md "$own" | code | wc -l)
if [ "$lines" -gt 0 ] && [ "$lines" -lt 40 ]; then
    echo "ok readme_own_is_$lines""_lines"
else
    echo "FAILED readme_own: $lines lines"
fi
follow teapot 8000 30000 20
follow boxes 2000 30000 6
follow torus 8000 40000 500

# ---- All commands of all READMEs ---------------------------------------------------------------------------------
# A copy of the repository, as old as it is, with the build folder's programs; images for boards are built in its own.
tree=$out/tree
rm -rf "$tree"
mkdir -p "$tree/build"
cp -a Makefile .ci firmware hal sim tests README.md LICENSE "$tree"
for file in "$build"/* "$build"/.setup*; do
    case ${file##*/} in fw | test | demo | study | shards | pictures | quick) ;; *) ln -s "$file" "$tree/build/" ;; esac
done
cp "$out/torus/MODEL.obj" "$out/torus/torus.mtl" "$out/torus/photo.png" "$tree"
cp "$out/torus/photo.png" "$tree/T.png"
cp "$out/torus/picture.c" "$tree"
cat >"$out/prelude" <<'PRELUDE'
make() {
    case " $* " in
    *' CORES=2 '* | *' LEAN=1 '* | *' -f '*) command make -n "$@" >make.log ;; # as pico, bare and scene_sums build
    *' demo '* | *' sim '* | *' help '* | *' firmware '*) command make "$@" ;;
    *) command make -n "$@" >make.log ;;
    esac
}
sh() {
    case $1 in
    tests/*) command sh -n "$1" ;;
    *) command sh "$@" ;;
    esac
}
PRELUDE
# Each block into DIR/NNN.sh or DIR/NNN.text
split_blocks() { # README DIR
    awk -v dir="$2" '
        function open_file(kind) { n++; file = sprintf("%s/%03d.%s", dir, n, kind); printf "" >file; now = kind }
        !now && match($0, /^ *```/) {
            indent = RLENGTH - 3
            info = substr($0, RLENGTH + 1)
            open_file(info == "sh" ? "sh" : info == "text" ? "text" : info == "c" ? "c" : \
                info ~ /^sh not run: ./ ? "unrun" : "other")
            next }
        now && /^ *```$/ { now = ""; next }
        now == "other" { if (/^(\$ )?(make|sh|build\/)/) { sub(/^\$ /, ""); print >file }; next }
        now { print substr($0, indent + 1) >file; next }
        /^    +(make|sh|build\/)[^:]/ { open_file("other"); now = ""; sub(/^ +/, ""); print >file }' "$1"
}
while read -r file; do
    name=$(dirname "$file" | sed 's/^\.$/top/' | tr / _)
    blocks=$out/blocks/$name
    rm -rf "$blocks"
    mkdir -p "$blocks"
    split_blocks "$file" "$blocks"
    ran=0
    unrun=0
    failed=
    last=
    for block in "$blocks"/*; do
        case $block in
        *.sh | *.other)
            ran=$((ran + $(grep -cvE '^ |^#|^$' "$block" || :)))
            last=$block.out
            cat "$out/prelude" "$block" >"$tree/commands"
            (cd "$tree" && timeout 300 sh -eu commands >"$last" 2>"$block.err" </dev/null) || {
                failed="$(tail -1 "$block"): $(tail -2 "$block.err" | tr '\n' ' ')"
                break
            } ;;
        *.unrun) unrun=$((unrun + 1)) ;;
        *.text)
            if [ "$mode" = write ]; then # the block's place is the n-th fence of the file
                awk -v want="$(basename "$block" .text)" -v text="$last" '
                    !now && /^ *```/ { n++; now = 1; print; skip = n == want + 0
                        if (skip) while ((getline line <text) > 0) print line
                        next }
                    now && /^ *```$/ { now = skip = 0 }
                    !skip' "$file" >"$out/new" && cp "$out/new" "$file"
            elif ! cmp -s "$last" "$block"; then
                failed="prints now $(diff "$block" "$last" | grep -m1 '^[<>]') (sh tests/tools/readme.sh build write)"
                break
            fi ;;
        esac
    done
    if [ -n "$failed" ]; then
        echo "FAILED readme_commands_$name: $failed"
    else
        echo "ok readme_commands_$name ($ran run, blocks not run: $unrun)"
    fi
done <"$out/readmes"
