#!/bin/sh
# The README's C, as it stands there: compiled as it would be on a board (warnings on), run, and its pictures
# looked at by number. The section about a model of one's own is followed to the letter: its commands too.
# Usage: tests/tools/readme.sh BUILD     BUILD/libcore.a, BUILD/libmeshes.a
set -eu
build=$1
out=$(mkdir -p "$1/test/readme" && cd "$1/test/readme" && pwd)
. tests/lib/positional.sh
designated_headers "$out/headers"
section() { # HEADING
    awk -v want="## $1" '/^## / { in_it = $0 == want } in_it' README.md
}
code() {
    awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on'
}
section 'Use the library' | code >"$out/example.c"
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

# ---- On a panel: compiled as it stands, and three frames of a scene through it ---------------------------------
section 'On a panel' | code >"$out/panel_example.c"
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
gcc -std=c11 -Wall -Wextra -Werror -Wconversion -I"$out/headers" -Ifirmware/zstrip -Ihal -Ihal/panel -I"$out" "$out/panel_main.c" \
    "$build/libcore.a" hal/panel/*.c hal/null/*.c -o "$out/panel_example"
said=$("$out/panel_example")
[ "$said" = "0 15" ] && echo "ok readme_panel_example" || echo "FAILED readme_panel_example: $said"

# ---- From your .obj to a picture on a board ------------------------------------------------------
# A folder as the reader has it: zsim built, the library, a model; then the section's program and commands.
follow() { # NAME LEAST-PIXELS MOST-PIXELS COLOURS    MODEL.obj and what belongs to it lie in $out/NAME
    home=$out/$1
    ln -sfn "$PWD/firmware" "$home/firmware"
    ln -sfn "$PWD/build" "$home/build"
    [ "$build" = "$PWD/build" ] || ln -sfn "$build" "$home/build"
    section 'From your .obj to a picture on a board' | code >"$home/picture.c"
    section 'From your .obj to a picture on a board' | sed -n 's/^    \(build\|gcc\|\.\/\)/\1/p' >"$home/commands"
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
build=$(cd "$build" && pwd)
make=$out/make
gcc -O1 -Ifirmware/zstrip -I"$build/gen" tests/tools/convert/make.c \
    "$build/libcore.a" "$build/libmeshes.a" -lpng -lturbojpeg -lm -o "$make"
mkdir -p "$out/teapot" "$out/boxes" "$out/torus"
"$make" teapot >"$out/teapot/MODEL.obj"
"$make" boxes 5 3 >"$out/boxes/MODEL.obj"
"$make" boxes.mtl 3 >"$out/boxes/boxes.mtl"
"$make" torus 48 24 4 torus.mtl >"$out/torus/MODEL.obj"
printf 'newmtl skin\nmap_Kd photo.png\n' >"$out/torus/torus.mtl"
"$make" png photo 128 128 "$out/torus/photo.png"
lines=$(section 'From your .obj to a picture on a board' | code | wc -l)
[ "$lines" -lt 40 ] && echo "ok readme_own_is_$lines""_lines" || echo "FAILED readme_own: $lines lines"
follow teapot 8000 30000 20
follow boxes 2000 30000 6
follow torus 8000 40000 500
