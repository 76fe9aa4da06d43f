#!/bin/sh
# Shaders, mappings, accelerators and panels are linked only where they are named: what a scene or a board does not need
# is not in its firmware. And the core needs nothing of any of them by name.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

# What no test below asks for but where it is named
TEXTURE='zs_shade_texture|zs_texel|fetch|texture_|light$'
FLOAT='zs_depth_(e[345]|float)|float_|any_row|(e[345]|any)_setup'

# Checks of loaded data, what finds changes, what a program's own shaders need: in no firmware that does not name them.
CHECKS='zs_damage_compare zs_damage_track track_check track_due zs_raster_leave zs_mesh_check zs_texture_check
        zs_flaw_string zs_strip_hashes_init zs_fragments_start zs_fragments_run'

# Names that each object defines: "file name" a line
names() {
    ${ARM}nm --plugin= -A "$dir"/*.o | awk '$2 ~ /[tTrRdD]/ && $3 !~ /^[$.]/ {
        sub(/\.o:.*/, "", $1); sub(/.*\//, "", $1); print $1, $3 }' >"$dir/names.txt"
}
# Names that files of fast/ alone define, FILES by a pattern
names_of() {
    awk -v want="^fast_($1)\$" '$1 ~ want { ours[$2] } $1 !~ want { others[$2] }
        END { for (n in ours) if (!(n in others)) print n }' "$dir/names.txt"
}
# SHADER DEPTH PATTERN [FILES]: a firmware with these, and LIST, must hold no symbol that matches, and nothing of these
# files of fast/; without a list, of none.
without() {
    name="$c $1 and $2 alone${LIST:+, $LIST}"
    minimal "$dir/main.c" "$1" "$2"
    if link "$c" "$dir" "$dir/main.c" "$dir/part.elf"; then
        ${ARM}nm --plugin= "$dir/part.elf" | awk '{ print $NF }' >"$dir/part.txt"
        names_of "${4:-.*}" >"$dir/fast.txt"
        # shellcheck disable=SC2086
        none "$name" "$(grep -E "$3|^($(echo $CHECKS | tr ' ' '|'))" "$dir/part.txt"
            grep -xF -f "$dir/fast.txt" "$dir/part.txt")"
        [ "$(wc -l <"$dir/fast.txt")" -ge 5 ] || bad "$name: names of fast/" "$(cat "$dir/fast.txt")"
    else
        bad "$name" "does not link"
    fi
}

for c in $CPUS; do
    dir=$B/kernels-$c
    core "$c" "$dir" || { bad "$c compiles" "see above"; continue; }
    names
    POSE='zs_(sin|cos|pose|camera|strerror)'
    RECIP='zs_depth_recip|recip_(setup|vertex|inverse)' LINEAR='zs_depth_linear|linear_p'
    without raw recip \
        "^(zs_shade_(flat|smooth)|(flat|smooth)_|zs_light|$LINEAR|zs_unit_|$POSE|$TEXTURE|$FLOAT)"
    without flat recip "^(zs_shade_(raw|smooth)|(raw|smooth)_|$LINEAR|$POSE|$TEXTURE|$FLOAT)"
    without smooth recip "^(zs_shade_(raw|flat)|(raw|flat)_|zs_solid_|$LINEAR|$POSE|$TEXTURE|$FLOAT)"
    without flat linear "^(zs_shade_(raw|smooth)|(raw|smooth)_|$RECIP|$POSE|$TEXTURE|$FLOAT)"
    OTHER_SHADERS='zs_shade_(raw|flat|smooth|texture_)|zs_solid_|zs_light|zs_texture_light|smooth_'
    without texture recip "^($OTHER_SHADERS|zs_depth_walk|$LINEAR|zs_texel|fetch_(565|pal)|$FLOAT)"
    without flat e3m13 "^(zs_shade_(raw|smooth)|$RECIP|$LINEAR|zs_depth_(e4m12|e5m11)|e[45]_setup|$TEXTURE)"
    LIST='ZS_FAST_FRAME,'
    without flat recip '^(zs_fast_(raw|flat))' 'cluster.*|solid|smooth|less|texture|texels'
    LIST=$FAST_FLAT
    without flat recip '^(zs_fast_raw|zs_shade_(raw|smooth)|'"$TEXTURE"')' 'cluster.*|smooth|less|texture|texels'
    LIST='ZS_FAST_FRAME, ZS_FAST_SMOOTH,'
    without smooth recip "^($TEXTURE)" 'cluster.*|solid|texture|texels'
    LIST='ZS_FAST_FRAME, ZS_FAST_TEXTURE,'
    without texture recip '^(zs_fast_texture_|zs_shade_texture_|zs_texel|fetch_(565|pal))' \
        'cluster.*|solid|smooth|texels'
    LIST=$FAST_TEXTURE
    PALETTE='zs_fast_pal|zs_texel_pal|(fetch|rows|gather|small|small_lit)_pal'
    without texture_smooth recip "^(zs_fast_texture(_flat|\$)|zs_shade_texture(_flat)?\$|$PALETTE)" \
        'cluster.*|solid|smooth'
    LIST=ZS_FAST_CLUSTERS,
    without flat recip '^(zs_fast_(touch|batch|edges)|batch_)' 'first_touch|edges|solid|smooth|less|texture|texels'
    LIST=
    # the names above must exist, or the patterns prove nothing
    LIST=$FAST_ALL minimal "$dir/main.c" flat recip "$EVERYTHING $OWN"
    echo "$OTHERS $OWN_SHADER" >>"$dir/main.c"
    link "$c" "$dir" "$dir/main.c" "$dir/all.elf" || bad "$c everything links" "see above"
    all=$(${ARM}nm --plugin= "$dir/all.elf" | awk '{ print $NF }')
    named="$CHECKS zs_shade_raw zs_shade_flat zs_shade_smooth zs_raw_face zs_flat_face zs_depth_recip
        zs_depth_linear zs_recip_setup linear_setup linear_planes zs_solid_run zs_pose_turn zs_fast_touch
        zs_fast_tiles zs_fast_batch zs_fast_clusters zs_fast_edges zs_fast_raw zs_fast_flat zs_fast_smooth
        zs_fast_texture zs_fast_texture_flat zs_fast_texture_smooth zs_fast_565 zs_fast_pal8 zs_fast_pal4
        zs_fast_less zs_cluster_open solid_rows smooth_rows texture_rows touch_piece tiles_cover
        zs_batch_bin zs_camera_orbit zs_error_string zs_shade_texture zs_shade_texture_flat
        zs_shade_texture_smooth zs_texel_565 zs_texel_pal8 zs_texel_pal4 fetch_565 fetch_pal8 fetch_pal4
        rows_565 rows_pal8 rows_pal4 fetch_wide zs_texture_run zs_texture_light zs_texture_start
        zs_depth_e3m13 zs_depth_e4m12 zs_depth_e5m11 float_planes any_row e3_setup e4_setup e5_setup
        any_setup"
    gone=$(echo "$all" | awk -v named="$(echo "$named" | tr '\n' ' ')" '
        { have[NR] = $0 }
        END {
            n = split(named, name, " ")
            for (i = 1; i <= n; i++) {
                for (k = 1; k <= NR && index(have[k], name[i]) != 1; k++);
                if (k > NR) print name[i]
            }
            if (n < 60) print "names:" n
        }')
    none "$c everything holds every name looked for" "$gone"
    # What core/ needs, core/ has, or the compiler's library: renamed objects are core_NAME.o
    ${ARM}ld -r "$dir"/core_*.o -o "$dir/core.rel" || bad "$c core/ links" "see above"
    ${ARM}nm --plugin= -g "$dir"/[!c]*.o 2>/dev/null | awk 'NF == 3 && $2 ~ /[TRD]/ { print $3 }' >"$dir/others.txt"
    none "$c core/ needs nothing of other folders" \
        "$(${ARM}nm --plugin= -u "$dir/core.rel" | awk '{ print $NF }' | grep -xF -f "$dir/others.txt")"
    if [ "$(wc -l <"$dir/others.txt")" -ge 50 ]; then ok "$c names of other folders: $(wc -l <"$dir/others.txt")"
    else bad "$c names of other folders" "$(cat "$dir/others.txt")"; fi
done

# Panels: what one brings along is panel.c and the conversion that it needs.
ALL='panel_(st7789|ili9341|gc9a01|ssd1351|ssd0323|ssd1306|types|strerror|name)|panel_convert_(swap|grey4|mono)|bayer'
panel_alone() { # TYPE WIDTH HEIGHT OWN
    name="$c $1 alone"
    minimal_panel "$dir/main.c" "$1" "$2" "$3"
    if link "$c" "$dir" "$dir/main.c" "$dir/part.elf"; then
        none "$name" "$(${ARM}nm --plugin= "$dir/part.elf" | awk '{ print $NF }' | grep -E "^($ALL)\$" |
            grep -vE "^(panel_$1|$4)\$")"
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
    all=$(${ARM}nm --plugin= "$dir/all.elf" | awk '{ print $NF }' | grep -cE "^($ALL)\$")
    if [ "$all" -eq 13 ]; then ok "$c all panels hold every name looked for"
    else bad "$c all panels hold every name looked for" "$all of 13"; fi
done
exit $failed
