#!/bin/sh
# Kernels are linked only when used: what a scene does not need is not in its firmware.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

# Checks of loaded data: in no firmware that does not call them.
CHECKS='zs_mesh_check zs_texture_check zs_strflaw'

# SHADER DEPTH PATTERN...: a firmware with these must hold no symbol that matches.
without() {
    name="$c $1 and $2 alone"
    minimal "$dir/main.c" "$1" "$2"
    if link "$c" "$dir" "$dir/main.c" "$dir/part.elf"; then
        none "$name" "$(${ARM}nm "$dir/part.elf" | awk '{ print $NF }' |
            grep -E "$3|^($(echo "$CHECKS" | tr ' ' '|'))")"
    else
        bad "$name" "does not link"
    fi
}

for c in $CPUS; do
    dir=$B/kernels-$c
    core "$c" "$dir" || { bad "$c compiles" "see above"; continue; }
    without raw recip '^(zs_shade_(flat|smooth)|(flat|smooth)_|zs_light|zs_depth_linear|linear_|zs_(sin|cos|unit_|pose|camera|strerror))'
    without flat recip '^(zs_shade_(raw|smooth)|(raw|smooth)_|zs_depth_linear|linear_|zs_(sin|cos|pose|camera|strerror))'
    without smooth recip '^(zs_shade_(raw|flat)|(raw|flat)_|zs_solid_|zs_depth_linear|linear_|zs_(sin|cos|pose|camera|strerror))'
    without flat linear '^(zs_shade_(raw|smooth)|(raw|smooth)_|zs_depth_recip|recip_(setup|vertex|inverse)|zs_(sin|cos|pose|camera|strerror))'
    # the names above must exist, or the patterns prove nothing
    minimal "$dir/main.c" flat recip "$EVERYTHING"
    echo "$OTHERS" >>"$dir/main.c"
    link "$c" "$dir" "$dir/main.c" "$dir/all.elf" || bad "$c everything links" "see above"
    all=$(${ARM}nm "$dir/all.elf" | awk '{ print $NF }')
    gone=
    for s in zs_shade_raw zs_shade_flat zs_shade_smooth raw_face flat_face smooth_face zs_depth_recip \
        zs_depth_linear recip_setup linear_setup linear_rows zs_solid_rows zs_pose_turn \
        zs_camera_orbit zs_strerror $CHECKS; do
        echo "$all" | grep -q "^$s" || gone="$gone $s"
    done
    none "$c everything holds every name looked for" "$gone"
done
exit $failed
