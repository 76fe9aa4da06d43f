#!/bin/sh
# The README's C example, as it stands there: compiled as it would be on a board (C and C++ warnings
# on), run, and its picture looked at by number.
# Usage: tests/readme.sh BUILD
set -eu
out=$1/test/readme
mkdir -p "$out"
awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' README.md >"$out/example.c"
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
gcc -std=c11 -Wall -Wextra -Werror -Wconversion -Ifirmware/zstrip -I"$out" "$out/main.c" \
    firmware/zstrip/*.c -o "$out/example"
# shellcheck disable=SC2046
set -- $("$out/example")
[ "$lines" -le 40 ] && echo "ok readme_example_is_$lines""_lines" || echo "FAILED readme_example: $lines lines"
if [ "$1" -eq 0 ] && [ "$2" -eq 15 ] && [ "$3" -gt 8000 ] && [ "$3" -lt 40000 ]; then
    echo "ok readme_example_draws_a_cube ($3 pixels in $2 strips)"
else
    echo "FAILED readme_example_draws_a_cube: error $1, $2 strips, $3 pixels"
fi
