#!/bin/sh
# Structs of the public headers are initialised by the names of their fields everywhere but in the renderer: in scenes,
# applications, what generators write, the simulator and the tests.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"
. tests/lib/positional.sh

gen=${1:-build}/gen
dir=$B/designated
rm -rf "$dir"
mkdir -p "$dir/made" "$dir/gen"
if ! designated_headers "$dir"; then
    bad "headers for designated initialisers" "the headers have not all of: $DESIGNATED"
    exit 1
fi
# What other scripts write for applications and for the study
cat >"$dir/made/model.h" <<'END'
#include "zstrip.h"
#define MODEL_VARYINGS 0
#define MODEL_INSTANCES 1u
#define MODEL_MIDDLE { 0, 0, 0 }
#define MODEL_RADIUS 1
extern const struct zs_instance model_instance[1];
END
echo '#define STUDY_ARENA 4' >"$dir/made/study_settings.h"
echo '#define STUDY_BUILD ""' >"$dir/gen/study_build.h"

# NAME FLAGS FILES...
by_name() {
    name=$1 flags=$2
    shift 2
    files "$name" "$1" || return
    # shellcheck disable=SC2086
    found=$(positional "$dir/looked.o" -std=gnu11 -D_GNU_SOURCE -DZS_STATS=1 -I"$dir" -Ifirmware/scenes \
        -Ifirmware/scenes/pieces -Ifirmware/examples $flags -- "$@")
    none "$name" "$found"
}
SIM="-Ihal -Ihal/panel -Ihal/fault -I$gen -I$dir/gen $(printf -- '-I%s ' sim/*/)-Ihal/linux"
by_name "examples name fields" "" firmware/examples/*.c
by_name "scenes name fields" "-I$gen" firmware/scenes/*.c firmware/scenes/pieces/*.c
by_name "mesh generators name fields" "" firmware/scenes/gen/*.c
by_name "generated meshes name fields" "-I$gen" "$gen"/*.c
by_name "applications name fields" \
    "-Ihal -Ihal/panel -Ifirmware/app -I$gen -I$dir/made -DFRAME_DEMO=teapot -DSHOW_DEMO=teapot" firmware/app/*.c
by_name "the simulator names fields" "$SIM -Ifirmware/app -DSTAGE_ORBIT=1" sim/*/*.c # of the page, too
by_name "tests name fields" "$SIM -Itests/lib -Itests/lab/fuzz -Itests/lab/stress -Ifirmware/app" \
    tests/lib/*.c tests/unit/*.c tests/property/*.c tests/tools/*.c tests/lab/fuzz/*.c tests/lab/stress/*.c \
    tests/lab/effects/*.c
LIST=$FAST_ALL minimal "$dir/minimal.c" flat recip "$EVERYTHING $OWN"
echo "$OTHERS $OWN_SHADER" >>"$dir/minimal.c"
by_name "firmware of checks names fields" "" "$dir/minimal.c"
exit $failed
