#!/bin/sh
# Kernels and panels are linked only when used: what a scene or a board does not need is not in its firmware.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

# What no test below asks for but where it is named
TEXTURE='zs_shade_texture|zs_texel|fetch|rows_|texture_|light$'
STATE='zs_state|state_'
FLOAT='zs_depth_(e[345]|float)|float_|(e[345]|any)_setup'

# Checks of loaded data, and what finds changes: in no firmware that does not call them.
CHECKS='zs_watch watch_look zs_track track_check track_due zs_raster_pass zs_mesh_check zs_texture_check zs_strflaw
        zs_cluster_kernel cluster_open cluster_verts cluster_run'

# SHADER DEPTH PATTERN...: a firmware with these must hold no symbol that matches.
without() {
    name="$c $1 and $2 alone"
    minimal "$dir/main.c" "$1" "$2"
    if link "$c" "$dir" "$dir/main.c" "$dir/part.elf"; then
        none "$name" "$(${ARM}nm "$dir/part.elf" | awk '{ print $NF }' |
            grep -E "$3|^($(echo $CHECKS | tr ' ' '|'))")"
    else
        bad "$name" "does not link"
    fi
}

for c in $CPUS; do
    dir=$B/kernels-$c
    core "$c" "$dir" || { bad "$c compiles" "see above"; continue; }
    without raw recip '^(zs_shade_(flat|smooth)|(flat|smooth)_|zs_light|zs_depth_linear|linear_|zs_(sin|cos|unit_|pose|camera|strerror)|'"$TEXTURE|$STATE|$FLOAT"')'
    without flat recip '^(zs_shade_(raw|smooth)|(raw|smooth)_|zs_depth_linear|linear_|zs_(sin|cos|pose|camera|strerror)|'"$TEXTURE|$STATE|$FLOAT"')'
    without smooth recip '^(zs_shade_(raw|flat)|(raw|flat)_|zs_solid_|zs_depth_linear|linear_|zs_(sin|cos|pose|camera|strerror)|'"$TEXTURE|$STATE|$FLOAT"')'
    without flat linear '^(zs_shade_(raw|smooth)|(raw|smooth)_|zs_depth_recip|recip_(setup|vertex|inverse)|zs_(sin|cos|pose|camera|strerror)|'"$TEXTURE|$STATE|$FLOAT"')'
    without texture recip '^(zs_shade_(raw|flat|smooth)|zs_solid_|zs_light|light|zs_depth_linear|linear_|zs_texel|fetch_(565|pal)|zs_shade_texture_|smooth_|'"$STATE|$FLOAT"')'
    without flat e3m13 '^(zs_shade_(raw|smooth)|zs_depth_(recip|linear|e4m12|e5m11)|recip_(setup|vertex|inverse)|linear_|e[45]_setup|'"$TEXTURE|$STATE"')'
    # the names above must exist, or the patterns prove nothing
    minimal "$dir/main.c" flat recip "$EVERYTHING $CULLING"
    echo "$OTHERS" >>"$dir/main.c"
    link "$c" "$dir" "$dir/main.c" "$dir/all.elf" || bad "$c everything links" "see above"
    all=$(${ARM}nm "$dir/all.elf" | awk '{ print $NF }')
    gone=
    for s in $CHECKS zs_shade_raw zs_shade_flat zs_shade_smooth raw_face flat_face zs_depth_recip \
        zs_depth_linear recip_setup linear_setup linear_rows zs_solid_rows zs_pose_turn \
        zs_camera_orbit zs_strerror zs_shade_texture zs_shade_texture_flat zs_shade_texture_smooth zs_texel_565 \
        zs_texel_pal8 zs_texel_pal4 fetch_565 fetch_pal8 fetch_pal4 rows_565 rows_pal8 rows_pal4 fetch_wide texture_run light texture_start \
        zs_state_kernel state_span state_bias zs_depth_e3m13 zs_depth_e4m12 zs_depth_e5m11 float_rows e3_setup e4_setup e5_setup any_setup; do
        echo "$all" | grep -q "^$s" || gone="$gone $s"
    done
    none "$c everything holds every name looked for" "$gone"
done

# Panels: what one brings along is panel.c and the conversion that it needs.
ALL='panel_(st7789|ili9341|gc9a01|ssd1351|ssd0323|ssd1306|types|strerror|name)|panel_convert_(swap|grey4|mono)|bayer'
panel_alone() { # TYPE WIDTH HEIGHT OWN
    name="$c $1 alone"
    minimal_panel "$dir/main.c" "$1" "$2" "$3"
    if link "$c" "$dir" "$dir/main.c" "$dir/part.elf"; then
        none "$name" "$(${ARM}nm "$dir/part.elf" | awk '{ print $NF }' | grep -E "^($ALL)\$" | grep -vE "^(panel_$1|$4)\$")"
    else
        bad "$name" "does not link"
    fi
}
for c in $CPUS; do
    dir=$B/kernels-panels-$c
    panels "$c" "$dir" || { bad "panels, $c compile" "see above"; continue; }
    panel_alone st7789 240 240 none
    panel_alone ili9341 240 320 panel_convert_swap
    panel_alone gc9a01 240 240 panel_convert_swap
    panel_alone ssd1351 128 128 panel_convert_swap
    panel_alone ssd0323 128 64 panel_convert_grey4
    panel_alone ssd1306 128 64 'panel_convert_mono|bayer'
    minimal_panel "$dir/main.c" st7789 240 240 "$ALL_PANELS"
    link "$c" "$dir" "$dir/main.c" "$dir/all.elf" || bad "$c all panels link" "see above"
    all=$(${ARM}nm "$dir/all.elf" | awk '{ print $NF }' | grep -cE "^($ALL)\$")
    if [ "$all" -eq 13 ]; then ok "$c all panels hold every name looked for"
    else bad "$c all panels hold every name looked for" "$all of 13"; fi
done
exit $failed
