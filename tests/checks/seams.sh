#!/bin/sh
# What a program that uses the depth buffer alone pays for methods, lines and points: the core beside a copy whose calls
# of them are taken out. At most 128 bytes of flash (136 of the M3's program with accelerators, as DESIGN.md says), and
# 0.2 % of the instructions of any frame of the bench on the M3.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

BYTES_MAX=${BYTES_MAX:-$(most_here 128)}
BYTES_FAST_MAX=${BYTES_FAST_MAX:-$(most_here 136)} # M3 with accelerators
SHARE_MAX=${SHARE_MAX:-0.2} # per cent of a frame's instructions
work=$B/seams
copy=$work/zstrip
rm -rf "$work"
mkdir -p "$work"
cp -R firmware/zstrip "$copy"

# FILE SED: an edit that changes the copy's file; the seam is elsewhere where it changes nothing.
without() {
    sed "$2" "$copy/$1" >"$work/edited" || exit 1
    ! cmp -s "$work/edited" "$copy/$1" ||
        bad "seams are where seams.sh takes them out" "$1: nothing is like $2: name there what took its place"
    cp "$work/edited" "$copy/$1"
}
without core/frame.c '/^    if (config->method) {$/,/^    }$/d'
without core/frame.c 's/r->config\.method->strip(r);/if (r->strip >= r->band_end) zs_walk(r, r->draw_end);\
zs_raster_strip(r);/'
without core/raster.c 's/r->config\.method->list(r)/zs_scene_list(r)/'
without core/walk.c 's/r->config\.method->full(r)/zs_buffer_full(r)/'
without core/walk.c '/ \*const primitive = in->material->primitive;$/d'
without core/walk.c '/^    if (primitive) {$/,/^    }$/d'
without core/walk.c '/assemble = zs_assemble_tri;/d; /at->assemble = assemble;/d; s/at->assemble(r/zs_assemble_tri(r/'
without core/cull.c '/ \*const primitive = in->material->primitive;$/d'
without core/cull.c 's/return primitive ? .*/return ZS_OK;/'
without core/primitive.h '/ \*primitive = in->material->primitive;$/d'
without core/primitive.h 's/return primitive ? .*/return in->mesh->n_tris;/'
without fast/parts.c 's/!material->primitive && //; s/ || r->config\.method->begin//'
left=$(grep -nE 'config\.method|config->method|>primitive' "$copy"/core/*.[ch] "$copy"/fast/*.c |
    grep -vE '/fast/(share|cluster_setup)\.c:' | sed "s|^$copy/||; s/  */ /g" | tr ' ' _)
none "no seam but those: core/, fast/" "$left"
[ "$failed" = 0 ] || exit 1

# CPU DIR FLAGS...: what differs of the objects in DIR, of the copy. The flat program has no share.c and no clusters.
compiled() {
    cpu=$1 to=$2
    shift 2
    for src in "$copy"/core/*.c "$copy"/fast/parts.c; do
        case "$src $*" in */fast/*ZS_NO_FAST=1*) continue ;; esac
        object=$(echo "${src#"$copy"/}" | tr / "$between")
        # shellcheck disable=SC2086
        ${ARM}gcc -std=c11 -mcpu="$cpu" -mthumb $OPT $WARN "$@" -I"$copy" -c "$src" -o "$to/$prefix${object%.c}.o" ||
            { bad "$cpu without seams" "does not compile"; exit 1; }
    done
}
bytes_of() { # DIR FLAGS...
    minimal "$1/main.c" flat recip
    link "$c" "$1" "$1/main.c" "$1/seams.elf" -Wl,-Map,"$1/seams.map" >&2 && taken "$1/seams.map" "$1/"
}
prefix='' between=_
for c in $CPUS; do
    for flags in "$BARE" ''; do
        LIST='' what='no accelerators, -Os' most=$BYTES_MAX
        [ -n "$flags" ] || { LIST=$FAST_FLAT what="accelerators, -O2"; }
        [ "$c$flags" != cortex-m3 ] || most=$BYTES_FAST_MAX
        # shellcheck disable=SC2086
        core "$c" "$work/with" $flags || { bad "$c compiles" "see above"; exit 1; }
        rm -rf "$work/without"
        cp -R "$work/with" "$work/without"
        # shellcheck disable=SC2086
        compiled "$c" "$work/without" $flags
        with=$(bytes_of "$work/with") || { bad "$c" "does not link"; exit 1; }
        less=$(bytes_of "$work/without") || { bad "$c without seams" "does not link"; exit 1; }
        more=$((with - less))
        name="seams take at most $most bytes, $c, $what"
        if [ "$less" -gt 0 ] && [ "$more" -le "$most" ]; then ok "$name: $more of $with"
        else bad "$name" "$more of $with"; fi
    done
done

# Frames: the bench with the renderer's objects, of which those of the core are the copy's
firmware() { # NAME OPTION...
    image=$1
    shift
    make -s -f firmware/boards/firmware.mk BOARD=mps2 NAME="$image" APP_SRC=firmware/app/bench.c B="$top" "$@"
}
counts() { # NAME FILE OPTION...
    image=$1 csv=$2
    shift 2
    firmware "$image" "$@" >"$work/log" 2>&1 || { cat "$work/log"; bad "$image" "does not build"; exit 1; }
    [ "$csv" -nt "$top/fw/mps2/$image.elf" ] || firmware "$image" "$@" run >"$csv" 2>>"$csv" # the bench has run already
}
counts bench "$top/bench/mps2.csv"
prefix=firmware-zstrip- between=-
mkdir -p "$work/objects"
for object in "$top"/fw/mps2/firmware/zstrip/*/*.o; do
    cp "$object" "$work/objects/$(echo "${object#"$top"/fw/mps2/}" | tr / -)"
done
compiled cortex-m3 "$work/objects"
# once each: that instructions repeat is what the bench has seen
counts bench_seamless "$work/seamless.csv" CORE_OBJ="$work/objects" APP_FLAGS=-DBENCH_RUNS=1
awk -F, 'NF == 17 && $13 > 0 {
        if (NR == FNR) { with[$1 " " $2] = $13; sum[$1 " " $2] = $12; next }
        k = $1 " " $2
        seen += k in with
        if (sum[k] != $12) print k ":another-frame"
        else { more = (with[k] / $13 - 1) * 100; if (more > most) { most = more; worst = k } }
        if (more > '"$SHARE_MAX"') print k ":" more "%" }
    END { if (!seen) print "no-frames"
          printf "%.2f %%, %s, of %d frames\n", most, worst, seen >"'"$work/worst"'" }' \
    "$top/bench/mps2.csv" "$work/seamless.csv" >"$work/dearer"
none "seams take at most $SHARE_MAX % of a frame on the M3: $(cat "$work/worst")" "$(tr ' ' _ <"$work/dearer")"
exit $failed
