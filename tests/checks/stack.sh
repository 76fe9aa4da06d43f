#!/bin/sh
# The worst case of the stack, from the compiler's own numbers: no recursion, no VLA, a bound for each
# public function on Cortex-M0+ and M3, with all accelerators and without any. How: stack.mjs.
# What functions of zs_sink, of a program's own fragment, background and resolve stages and of a panel's bus and hooks
# take comes on top, as do interrupts.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

LIMIT=${STACK_LIMIT:-$(most_here 2048)} # bytes, any public function, of a program without effects
EFFECTS_LIMIT=${EFFECTS_STACK_LIMIT:-$(most_here 2704)} # ... with all of them, in any combination; most cannot happen
EXPLAIN_LIMIT=${EXPLAIN_STACK_LIMIT:-$(most_here 3456)} # zs_explain and its like, which draw a frame within
PANEL_LIMIT=${PANEL_STACK_LIMIT:-$(most_here 288)} # bytes, any function of panel.h

# Folders are bound by one process, which reads an object that many have once: what is to be bound, of stack.mjs
folders=$B/stack.txt
: >"$folders"
stack() { # NAME DIR ARGUMENTS of stack.mjs...
    name=$1 dir=$2
    shift 2
    echo "$(echo "$name" | tr ' ' _) $dir $*" >>"$folders"
}
render() { # CPU NAME EMPTY [FLAGS]: EMPTY as of stack.mjs
    c=$1 of=$2 empty=$3 dir=$B/stack-$2
    # shellcheck disable=SC2086
    core "$c" "$dir" ${4:-} || { bad "$of compiles (-Wvla -Werror)" "see above"; return; }
    LIST=$FAST_ALL minimal "$dir/main.c" flat recip "$EVERYTHING $OWN"
    echo "$OTHERS $OWN_SHADER" >>"$dir/main.c"
    rm -rf "$dir-all" && cp -a "$dir" "$dir-all"
    flags=${4:-}
    none=zs_method.begin,zs_shader.place,zs_shader.span,zs_reflection,zs_mirror_ops,zs_mask
    bound "$2" '' "$(echo "$empty,$none" | sed 's/^-,//')"
    copy "$2-explain"
    hook "$dir/hook"
    bound "$2-explain" '' "$(echo "$empty,$none,zs_item_kind" | sed 's/^-,//')"
    case $2 in bare-*) return ;; esac
    copy "$2-share"
    bound "$2-share" '' "$(echo "$empty,$none" | sed 's/^-,//')"
    for method in painter_sort_farthest hiz_hiz.bounds depthsort_coverage_order_newell_pieces_order.depth_sort \
        raycast_rays_ray.nodes_sort; do
        copy "$2-${method%%_*}"
        bound "$2-${method%%_*}" "$method" "$(echo "$empty,$none" | sed 's/^-,//; s/zs_method.begin,//')"
    done
    for method in layers_sort_farthest depthsort_coverage_order_newell_pieces_order.depth_sort \
        raycast_rays_ray.nodes_sort; do
        copy "$2-effects-${method%%_*}"
        bound "$2-effects-${method%%_*}" "$method" "$(echo "$empty,zs_shader.place" | sed 's/^-,//')"
    done
}
hook() { # FILE: the hook of a program with an overlay, which zs_explain looks for, as an object beside the others
    printf '#include "zs_overlay.h"\nconst struct zs_resolve hook = { .draw = zs_overlay_draw };\n' >"$1.c"
    # shellcheck disable=SC2086
    measured -std=c11 -mcpu="$c" -mthumb $OPT $flags -Ifirmware/zstrip -c "$1.c" -o "$1.o"
}
copy() { # NAME: a folder of all objects
    dir=$B/stack-$1
    rm -rf "$dir" && cp -a "$B/stack-$of-all" "$dir"
}
# A renderer has one method, so each is bound by itself, and the usual one, the depth buffer, without them.
bound() { # NAME METHOD EMPTY. METHOD: files of method/ and effect/ that stay, _ between, and . for _ in a name
    gone=
    for m in painter sort farthest hiz hiz.bounds depthsort coverage order newell pieces order.depth raycast rays \
        ray.nodes layers; do
        case $m in *.*) file=${m%.*}_${m#*.} ;; *) file=$m ;; esac
        case _${2}_ in *_"$m"_*) ;; *) gone="$gone $dir/method_$file.* $dir/effect_$file.*" ;; esac
    done
    # shellcheck disable=SC2086
    rm -f $gone
    case $1 in *-share) ;; *) rm -f "$dir/fast_share".* ;; esac # of programs for two cores: zs_share.h
    most=$EFFECTS_LIMIT
    case $1 in
    *-effects-*) ;;
    *-explain) rm -f "$dir"/effect_*.* && # it looks at the items of an overlay, by its list
        find "$dir" -name 'overlay_*' ! -name 'overlay_overlay.*' -exec rm {} + ;;
    *) most=$LIMIT && rm -f "$dir"/effect_*.* "$dir"/overlay_*.* ;;
    esac
    prefix=zs_ first=zs_render
    case $1 in
    *-explain) prefix=zs_explain first=zs_explain most=$EXPLAIN_LIMIT ;;
    *) rm -f "$dir"/support_explain*.* ;;
    esac
    # shellcheck disable=SC2086
    link "$c" "$dir" "$dir/main.c" "$dir/all.elf" -Wl,--no-gc-sections $flags || { bad "$1 links" "see above"; return; }
    stack "$1" "$dir" "$most" $prefix \
        zs_sink,zs_shader.fragment,zs_shader.position,zs_background,zs_resolve,zs_explainer.say "$3" $first \
        zs_render zs_init zs_frame_begin zs_frame_strip zs_frame_end zs_pose_turn zs_pose_rotate \
        zs_camera_perspective zs_camera_orthographic zs_camera_look_at zs_camera_look_along zs_camera_orbit zs_unit \
        zs_mesh_check zs_texture_check
}
for c in $CPUS; do
    case $c in *m0*) empty=zs_fast.edges,zs_fast.draw ;; *) empty=- ;; esac # nothing on a core that cannot divide
    render "$c" "$c" $empty
    render "$c" "bare-$c" zs_fast "$BARE"
done

for c in $CPUS; do
    dir=$B/stack-panels-$c
    panels "$c" "$dir" || { bad "panels, $c compile" "see above"; continue; }
    minimal_panel "$dir/main.c" st7789 240 240 "$ALL_PANELS"
    link "$c" "$dir" "$dir/main.c" "$dir/all.elf" -Wl,--no-gc-sections ||
        { bad "panels, $c link" "see above"; continue; }
    stack "panels, $c" "$dir" "$PANEL_LIMIT" panel_ hal_bus,hal_hooks - panel_send
done

ARM=$ARM node tests/checks/stack.mjs <"$folders" || failed=1
while read -r name dir _; do
    name=$(echo "$name" | tr _ ' ')
    ok "$name no VLA, no alloca: $(frames "$dir" | wc -l) frames, $(frames "$dir" | grep -c dynamic) dynamic"
    grep -q '^ok .* stack within\|^FAILED' "$dir/bound.txt" || bad "$name bound" "none was found"
    cat "$dir/bound.txt"
done <"$folders"

# What the boards' tests have found painted over is no more than that: drawing, and sending from it. Interrupts and the
# program's own frames are in what was painted, too.
painted() { # BOARD CPU
    [ -s "$top/$1/table.txt" ] || { echo "note $1: its test has not run, no painted stack"; return; }
    render=$(sed -n 's/^ok .* zs_render //p' "$B/stack-$2/bound.txt")
    send=$(sed -n 's/^ok .* panel_send //p' "$B/stack-panels-$2/bound.txt")
    awk -v board="$1" -v bound=$((${render:-0} + ${send:-0})) '$5 > most { most = $5; scene = $2 }
        END {
            if (most + 0 > 0 && most <= bound) {
                print "ok " board " painted stack " most " (" scene ") within the bound, " bound
                exit
            }
            print "FAILED " board " painted stack: " most + 0 ", bound " bound; exit 1 }' "$top/$1/table.txt" ||
                failed=1
}
painted pico cortex-m0plus
painted microbit cortex-m0plus
painted lm3s6965 cortex-m3
painted stm32f405 cortex-m3
exit $failed
