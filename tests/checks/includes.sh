#!/bin/sh
# Includes point one way: sim, tests -> firmware/app -> firmware/zstrip, hal/hal.h. hal never includes
# firmware, zstrip never includes hal, sim/reference knows neither. In zstrip: fast -> shade; fast, shade, depth,
# damage, support, method -> core -> arch, and all of them the headers at its root; no circle.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

STD='<(stdint|stddef)\.h>'
HOSTED='<[a-z0-9/]+\.h>'

# FILES...: "file: include" for each #include line. A macro as argument stays visible and matches nothing.
includes() {
    grep -nE '^[[:space:]]*(#|\?\?=|%:)[[:space:]]*(include|import)' "$@" /dev/null |
        sed -E 's/^([^:]*):[0-9]+:[^i]*i[a-z_]+[[:space:]]*/\1: /; s,[[:space:]]*(/\*.*|//.*)?$,,'
}
# NAME ALLOWED FILES...: every include must match the pattern as a whole.
only() {
    name=$1 allowed=$2
    shift 2
    files "$name" "$1" || return
    none "$name" "$(includes "$@" | grep -vE ": ($allowed)\$" | tr -d ' ')"
}
# "a.h" or "b.h": the headers of some folders, as a pattern.
headers() {
    names=
    for dir in "$@"; do
        for h in "$dir"/*.h; do
            h=${h##*/}
            [ "$h" = '*.h' ] || names="$names${names:+|}${h%.h}\\.h"
        done
    done
    [ -z "$names" ] || printf '"(%s)"\n' "$names"
}
# NAME FORBIDDEN FILES...: no file may reach a forbidden path through any number of headers.
reach() {
    name=$1 forbidden=$2
    shift 2
    # shellcheck disable=SC2046
    gcc -MM -Ifirmware/zstrip -Ifirmware/scenes -Ifirmware/scenes/pieces -Ihal -Ihal/null -Ihal/cortexm \
        -Ihal/semihosting -Ihal/spi -Ihal/panel \
        $(printf -- '-I%s ' sim/*/) "$@" >"$B/reach.txt" 2>"$B/reach.err" ||
        bad "$name: compiles" "$(cat "$B/reach.err")"
    # a rule a file: what is made, the file, what it includes
    none "$name" "$(awk -v forbidden="$forbidden" -v files=$# '
        {
            for (i = 1; i <= NF; i++) {
                if ($i ~ /:$/) { file = ""; n++ }
                else if ($i != "\\" && file == "") file = $i
                if ($i != "\\" && $i !~ /:$/ && $i ~ forbidden) print file "->" $i
            }
        }
        END { if (n != files) print "rules:" n + 0 ",_not_" files }' "$B/reach.txt")"
}

zstrip=$(cd firmware/zstrip && ls ./*.h ./*/*.h | sed 's|^\./||; s/\./\\./' | tr '\n' '|')
only "zstrip includes its own headers, stdint and stddef" "\"($zstrip)\"|$STD" \
    firmware/zstrip/*.h firmware/zstrip/*/*.[ch]
reach "zstrip reaches nothing else" '^(hal|sim|tests|firmware/[^z])' firmware/zstrip/*/*.c

# Arrows between files, "from to", firmware/zstrip/ left out.
includes firmware/zstrip/*.h firmware/zstrip/*/*.[ch] | grep -v '<' | tr -d '":' | sed 's|firmware/zstrip/||' |
    awk '$1 != $2' >"$B/arrows.txt"
awk 'function folder(f) { return sub(/\/.*/, "", f) ? f : "root" }
    { n[folder($1), folder($2)]++; at[folder($1)]; at[folder($2)] }
    END {
        k = split("root arch core depth shade damage support method overlay effect fast", order, " ")
        for (f in at) { known = 0; for (i = 1; i <= k; i++) known += order[i] == f; if (!known) order[++k] = f }
        printf "%-9s", "includes"; for (j = 1; j <= k; j++) printf " %7s", order[j]; print ""
        for (i = 1; i <= k; i++) { printf "%-9s", order[i]
            for (j = 1; j <= k; j++) printf " %7s", n[order[i], order[j]] ? n[order[i], order[j]] : "."
            print "" } }' "$B/arrows.txt"
# core/fast.h has the types of accelerators; that core needs none of them by name, kernels.sh sees.
wrong=$(awk 'function folder(f) { return sub(/\/.*/, "", f) ? f : "root" }
    BEGIN { may["root"] = "root"; may["arch"] = "root arch"; may["core"] = "root arch core"
        may["depth"] = may["shade"] = may["damage"] = may["support"] = may["method"] = may["overlay"] = may["core"]
        may["effect"] = may["core"] " shade method"; may["fast"] = may["core"] " shade" }
    { from = folder($1); to = folder($2)
        if (from != to && index(" " may[from] " ", " " to " ") == 0) print $1 "->" $2 }' "$B/arrows.txt" | tr ' ' ':')
if [ "$(wc -l <"$B/arrows.txt")" -ge 40 ]; then
    none "zstrip: effect, overlay, fast, shade, depth, damage, support, method -> core -> arch" "$wrong"
else bad "zstrip: arrows are found" "$(wc -l <"$B/arrows.txt")"; fi
none "zstrip: no circle of includes" "$(tsort "$B/arrows.txt" 2>&1 >"$B/order.txt" | sed 's/.*: //' | tr '\n' ' ')"

only "hal.h includes standard headers" "$STD" hal/*.h
# what is shared is null's bus, cortexm, semihosting and spi; only host and linux are hosted programs
for dir in hal/*/; do
    case $dir in hal/panel/) continue ;; hal/host/ | hal/linux/) std=$HOSTED ;; *) std=$STD ;; esac
    only "${dir%/} includes hal.h, its own and shared headers" \
        "\"hal\\.h\"|$(headers "$dir" hal/null hal/cortexm hal/semihosting hal/spi)|$std" "$dir"*.[ch]
done
only "hal/rp2040/second includes hal.h, second.h and its HAL's own" \
    "\"(hal|second|\.\./parts|\.\./regs)\.h\"|$STD" hal/rp2040/second/*.c
only "panels include hal.h and their own headers" "\"hal\\.h\"|$(headers hal/panel)|$STD" hal/panel/*.[ch]
reach "hal reaches nothing of firmware" '^(firmware|sim|tests)' hal/*.h hal/*/*.c hal/*/*/*.c
APP='zstrip|zs_fast|zs_damage|zs_method|zs_lines|scenes|pieces|sizes|hal|second|panel|show|pair|number|line|report'
APP="$APP|model|show_model|zs_blend|zs_filter|zs_lights|zs_shadow|zs_dither|zs_environment|zs_fog|zs_share"
only "app sees public headers, hal.h, panel.h, scenes and its own" \
    "\"($APP|bench|probes|study_settings)\\.h\"|$STD" firmware/app/*.[ch]
only "showpieces see public headers and scenes'" \
    "\"(zs_[a-z]+|meshes)\\.h\"|$(headers firmware/scenes firmware/scenes/pieces)|$STD" firmware/scenes/pieces/*.[ch]
only "scenes see zstrip.h, zs_fast.h, zs_method.h and their own" \
    "\"(zstrip|zs_fast|zs_method|meshes)\\.h\"|$(headers firmware/scenes)|$STD" firmware/scenes/*.[ch]
only "mesh generators see their own" \
    "$(headers firmware/scenes | sed 's|"(|"\\.\\./(|')|$(headers firmware/scenes/gen)|$HOSTED" \
    firmware/scenes/gen/*.[ch]
only "boards see nothing of ours but startup.h" "\"\\.\\./startup\\.h\"|$STD" firmware/boards/*/*.c
# A judge in sim: includes its own and standard headers, reaches nothing of what it judges, has header names of its
# own (or an include could mean the other one), and uses no name that begins with a prefix of theirs.
judge() { # FOLDER PREFIXES
    only "$(basename "$1") includes its own and standard headers" "$(headers "$1")|$HOSTED" "$1"/*.[ch]
    reach "$(basename "$1") reaches nothing of firmware or hal" '^(firmware|hal)' "$1"/*.c
    twins=$(for h in "$1"/*.h; do
        ls firmware/*/"$(basename "$h")" hal/"$(basename "$h")" hal/*/"$(basename "$h")" 2>/dev/null
    done)
    none "$(basename "$1")'s header names are its own" "$twins"
    names=$(for f in "$1"/*.[ch]; do
        gcc -fpreprocessed -dD -E -P "$f" 2>/dev/null | grep -oE "\\<($2)_[A-Za-z0-9_]+" | sed "s|^|$(basename "$f"):|"
    done)
    none "$(basename "$1") uses no name of theirs" "$names"
}
judge sim/reference 'zs|ZS|hal|HAL|panel|PANEL'
judge sim/panel_model 'zs|ZS|hal|HAL|PANEL'
exit $failed
