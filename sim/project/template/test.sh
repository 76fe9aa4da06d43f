#!/bin/sh
# Does the program draw? On this machine, and on the board where it has an emulator: every picture shows more than one
# colour, the model turns, no error is reported; the board's pictures are this machine's.
# Usage: test.sh BOARD     ZSIM and GLASS are in the environment
set -u
board=$1
failed=0

pictures() { # BOARD
    make -s run BOARD="$1" SHOWN=3 >"build/$1.txt" 2>&1 || { tail -3 "build/$1.txt"; return 1; }
    # shellcheck disable=SC2086
    "$ZSIM" panel --panel $GLASS --full --decode "build/$1/stream" --out "build/$1/test_%d.png" \
        --raw "build/$1/test_%d.bin" >"build/$1/seen.txt" || { tail -3 "build/$1/seen.txt"; return 1; }
}
check() { # NAME, a command that succeeds
    name=$1
    shift
    if "$@" >/dev/null 2>&1; then echo "ok $name"; else echo "FAILED $name"; failed=1; fi
}
drawn() { [ "$(od -An -v -tx@UNIT@ -w@UNIT@ "$1" | sort -u | wc -l)" -gt 1 ]; }
differ() { ! cmp -s "$1" "$2" && [ -s "$1" ] && [ -s "$2" ]; }

mkdir -p build
check draws_on_host pictures host
check host_picture_has_colours drawn build/host/test_1.bin
check host_model_turns differ build/host/test_1.bin build/host/test_2.bin
if [ "$board" = pico ]; then
    check draws_on_pico pictures pico
    for i in 0 1 2; do
        check "pico_picture_${i}_is_the_hosts" cmp "build/host/test_$i.bin" "build/pico/test_$i.bin"
    done
fi
exit $failed
