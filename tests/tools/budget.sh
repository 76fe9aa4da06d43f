#!/bin/sh
# `zsim budget` and `zlab costs`: bytes are those of sizeof and ZS_ARENA_BYTES on this machine and on Cortex-M, the
# wire's are those of the driver, what fits fits and one more does not, limits are kept, the textbook is right; what
# makes no sense is refused by name.
# Usage: tests/tools/budget.sh ZSIM WORKDIR     as tests/tools/cli.sh; ZLAB is beside ZSIM
set -u
. tests/tools/zsim.sh
ARM=${ARM:-arm-none-eabi-}

budget() {
    z budget "$@"
    [ $status -eq 0 ] || wrong "status $status: $(said)"
    [ ! -s stderr ] || wrong "it talks: $(said)"
}
costs() { # ARGUMENT...    zlab costs, as z
    zsim=${zsim%zsim}zlab
    z costs "$@"
    zsim=${zsim%zlab}zsim
}
csv() { # FIGURE    of the last budget --csv
    sed -n "s/^$1,\([^,]*\),.*/\1/p" stdout
}

# ---- Bytes ----------------------------------------------------------------------------------------------
# Random configurations, each a line: width height rows tris verts words buffers instances track columns
awk 'BEGIN { srand(7)
    for (i = 0; i < 12; i++) {
        h = 1 + int(rand() * 320); r = 1 + int(rand() * 40); if (r > h) r = h
        print 1 + int(rand() * 400), h, r, 1 + int(rand() * 9000), 3 + int(rand() * 7000), substr("0323", 1 + i % 4, 1),
            1 + int(rand() * 2), 1 + int(rand() * 300), int(rand() * 50), int(rand() * 20) } }' >configs
shade_of() { # WORDS
    case $1 in 0) echo flat ;; 2) echo unlit ;; 3) echo smooth ;; esac
}
# What the compiler says: a line each of pools, arena, statics
{
    echo '#include "zs_damage.h"'
    echo '#define ROW(w, h, r, t, v, a, b, n, k, c) \'
    echo '    ZS_COLOR_BYTES(w, r, b), ZS_DEPTH_BYTES(w, r), ZS_DRAWN_BYTES(r) + ZS_BOUND_BYTES(w, h, r), \'
    echo '    ZS_BIN_BYTES(h, r), ZS_TRI_BYTES(t), ZS_VERT_BYTES(v, a), ZS_ARENA_BYTES(w, h, r, t, v, a, b), \'
    echo '    sizeof(struct zs_renderer), \'
    echo '    sizeof(struct zs_scene) + sizeof(struct zs_camera) + sizeof(struct zs_config) + \'
    echo '    n * sizeof(struct zs_instance), \'
    echo '    8u * c * ZS_STRIPS(h, r), k ? 4u * ZS_DAMAGE_WORDS(k, h, r) : 0u, \'
    echo '    sizeof(struct zs_tri) * t, sizeof(struct zs_vertex) * v,'
    echo 'const uint32_t budget_rows[] __attribute__((section(".budget"), used)) = {'
    sed 's/ /, /g; s/^/ROW(/; s/$/)/' configs
    echo '};'
} >rows.c
columns=13
cat >print.c <<'END'
#include <stdio.h>
#include "rows.c"
int main(void)
{
    for (unsigned i = 0; i < sizeof budget_rows / 4; i++)
        printf("%u\n", budget_rows[i]);
    return 0;
}
END
machine() { # NAME    rows of all configurations into NAME.rows
    paste -d ' ' - - - - - - - - - - - - - <"$1.numbers" >"$1.rows"
}
gcc -I"$top/firmware/zstrip" print.c -o print && ./print >host.numbers && machine host
for cpu in cortex-m0plus cortex-m3; do
    "${ARM}gcc" -mcpu=$cpu -mthumb -I"$top/firmware/zstrip" -c rows.c -o $cpu.o &&
        "${ARM}objcopy" -O binary -j .budget $cpu.o $cpu.bin
    od -An -v -tu4 -w4 $cpu.bin | tr -d ' ' >$cpu.numbers
    machine $cpu
done

begin bytes_are_those_of_the_compilers
[ "$(wc -w <host.rows)" -eq $((12 * columns)) ] || wrong "$(wc -w <host.rows) numbers from the host's compiler"
n=0
while read -r w h r t v a b instances track watch; do
    n=$((n + 1))
    budget --size "${w}x$h" --strip "$r" --tris "$t" --verts "$v" --shade "$(shade_of "$a")" --buffers "$b" \
        --instances "$instances" --track "$track" --watch "$watch" --csv
    pools="$(csv color) $(csv depth) $(csv tiles) $(csv bins) $(csv tris)"
    ours="$pools $(($(csv verts) + $(csv numbers) + $(csv attrs))) $(csv arena)"
    rest="$(csv renderer) $(csv scene) $(csv watch) $(csv track) $(csv tris) $(csv verts)"
    for m in host cortex-m0plus cortex-m3; do
        row=$(sed -n "${n}p" $m.rows)
        is "pools and arena, $w $h $r $t $v $a $b on $m" "$ours" "$(echo "$row" | cut -d' ' -f1-7)"
        [ $m = host ] || is "statics on $m" "$rest" "$(echo "$row" | cut -d' ' -f8-13)"
    done
    is "all of it" "$(csv ram)" \
        $(($(csv arena) + $(csv renderer) + $(csv scene) + $(csv watch) + $(csv track) + $(csv panel) +
            $(csv scratch) + $(csv stack)))
done <configs
note="$n configurations, host, Cortex-M0+ and M3"

# ---- Methods ----------------------------------------------------------------------------------------------
begin methods_share_out_the_same_pools
for m in zbuffer hiz painter depthsort coverage raycast; do
    budget --size 200x100 --strip 10 --tris 500 --verts 400 --buffers 1 --method $m --csv
    is "arena of $m" "$(($(csv color) + $(csv depth) + $(csv tiles) + $(csv bins) + $(csv tris) + $(csv verts) +
        $(csv numbers) + $(csv attrs)))" "$(csv arena)"
    case $m in zbuffer | hiz | raycast) want=4000 ;; *) want=0 ;; esac
    is "keys of $m" "$(csv depth)" $want
    budget --size 200x100 --strip 10 --tris 500 --verts 400 --buffers 1 --method $m
    case $m in zbuffer | hiz | painter) want= ;; *) want=3912 ;; esac # it holds 174 triangles
    is "records of $m" "$(sed -n "s/^ *of these *\([0-9]*\) .*/\1/p" stdout)" "$want"
done

begin methods_draw_in_the_pools_of_the_budget
for m in painter depthsort coverage raycast; do
    budget --scene cubes --strip 24 --method $m --csv
    tris=$(($(csv tris) / 12)) verts=$(($(csv verts) / 12))
    budget --scene cubes --strip 24 --method $m --tris $tris --verts $verts
    grep -q ', 1 pass, ' stdout || wrong "$m: $(head -1 stdout)"
done

# A pane before another: drawn in order, by zs_method_transparent, which takes the pools that are given or one pass
printf 'newmtl glass\nKd 1 0 0\nd 0.5\n' >panes.mtl
printf 'mtllib panes.mtl\nusemtl glass\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n' >panes.obj
printf 'f 1 2 3\nf 4 5 6\n' >>panes.obj
begin transparent_models_are_sorted_whatever_the_pools
for pools in '' '--tris 40 --verts 40' '--tris 40' '--verts 40' '--tris 2 --verts 6'; do
    z budget panes.obj --csv $pools
    [ $status -eq 0 ] || wrong "status $status with '$pools': $(said)"
    drawn=$(csv draw_RP2040)
    sed '/^d /d' panes.mtl >solid.mtl
    sed 's/panes/solid/' panes.obj >solid.obj
    z budget solid.obj --csv $pools
    [ "${drawn:-0}" -gt "$(csv draw_RP2040)" ] || wrong "with '$pools' glass takes $drawn, solid $(csv draw_RP2040)"
done
z budget panes.obj --tris 1 --verts 40
one_line 1 'panes.obj: '

begin material_file_that_is_missing_is_named
sed 's/panes.mtl/gone.mtl/' panes.obj >gone.obj
z budget gone.obj
[ $status -eq 0 ] || wrong "status $status: $(said)"
only_line stderr
is "what is said" "${the_line#*: }" \
    'gone.obj: material file gone.mtl cannot be read: its colours and textures are missing'

begin largest_scene_in_16_KB
budget --methods --size 128x64 --strip 8 --buffers 1 --csv
cp stdout methods.csv
is "methods" "$(cut -d, -f1 methods.csv | tr '\n' ' ')" 'method zbuffer hiz painter depthsort coverage raycast '
sed 1d methods.csv >methods.rows
while IFS=, read -r m tris verts _ _ _ arena ram; do
    for more in 0 1; do
        n=$((tris + more))
        case $m in zbuffer | hiz | painter) pool=$n ;; *) pool=$((n * 5 / 2 + 64)) ;; esac
        budget --size 128x64 --strip 8 --buffers 1 --tris $pool --verts $(((n * 700 + 999) / 1000)) --method "$m" \
            --core M0 --csv
        [ $more -eq 1 ] || is "$m: arena and RAM" "$(csv arena) $(csv ram)" "$arena $ram"
        [ $(($(csv ram) <= 16384)) -eq $((1 - more)) ] || wrong "$m: $(csv ram) bytes with $n, $verts"
    done
done <methods.rows
budget --methods --ram 2000 --size 128x64 --strip 8
is "nothing fits" "$(grep -c 'too small' stdout)" 6

begin methods_take_what_was_measured_within_30_percent
for m in painter depthsort coverage raycast hiz; do
    budget --scene city --strip 24 --buffers 1 --method $m --csv
    took=$(sed -n "s/^M3 $m city //p" "$top/tests/records/methods.txt")
    awk -v now="$(csv draw_M3)" -v took="$took" 'BEGIN { exit !(now > 0.7 * took && now < 1.3 * took) }' ||
        wrong "city by $m: $(csv draw_M3), $took on record"
done
budget --scene city --method painter --frame 3 --part stm32f103c8 --csv
is "ms of 72 MHz, 1.4 cycles each" "$(csv draw_ms)" \
    "$(awk -v n="$(csv draw_M3)" 'BEGIN { printf "%.3f", n * 1.4 / 72000 }')"
budget --size 200x100 --tris 500 --verts 400 --method painter --part stm32f103c8 --csv
is "no time of numbers alone" "$(csv draw_ms)$(csv fps)" ''

begin effects_take_what_is_on_record
budget --effects --size 100x50 --strip 10 --buffers 1 --tris 10 --verts 30 --csv
is "as many as on record" "$(grep -c '^pixel\|^vertex' stdout)" "$(grep -c '^M3' "$top/tests/records/effects.txt")"
want=$(awk '$3 == "texture" && NF == 3 { n[$1] = $2 / 100 }
    END { printf "%.2f,%.2f,%.2f", n["M0"], n["M3"], n["RP2040"] }' "$top/tests/records/effects.txt")
is "texture, on three cores" "$(sed -n 's/^pixel,"texture",//p' stdout)" "$want"
is "a shadow map" "$(sed -n 's/^ram,shadow map, 64x64,\([0-9]*\).*/\1/p' stdout)" 8192
more=$(sed -n 's/^ram,four samples a pixel,\([0-9]*\).*/\1/p' stdout)
budget --size 100x50 --strip 10 --buffers 1 --tris 10 --verts 30 --csv
single=$(csv arena)
budget --size 200x100 --strip 20 --buffers 1 --tris 10 --verts 30 --csv
is "four samples" "$more" $(($(csv arena) - single))
budget --effects --size 100x50
grep -q '^  a vertex: lit  *[0-9]*  *[0-9]*  *[0-9]*$' stdout || wrong "no vertex"

begin report_and_csv_agree
budget --panel st7789:240x240 --tris 2000 --verts 1200 --shade smooth --csv
want="$(csv color) $(csv tris) $(csv arena) $(csv ram) $(csv wire_bytes)"
budget --panel st7789:240x240 --tris 2000 --verts 1200 --shade smooth
have="$(sed -n 's/^  strip buffers *\([0-9]*\).*/\1/p' stdout) $(sed -n 's/^  triangles *\([0-9]*\).*/\1/p' stdout)"
have="$have $(sed -n 's/^  arena *\([0-9]*\).*/\1/p' stdout) $(sed -n 's/^  together *\([0-9]*\)  M0.*/\1/p' stdout)"
is "the report" "$have $(sed -n 's/^  \([0-9]*\) bytes, .* windows.*/\1/p' stdout)" "$want"
for part in rp2040 stm32f103c8 stm32f405 stm32f411 nrf51822 nrf52832 lm3s6965 esp32-c3; do
    grep -q "^$part " stdout || wrong "no line for $part"
done

budget --watch 4 --track 3
is "rows of the report's RAM out of its columns" \
    "$(sed -n '/^RAM/,/^$/p' stdout | grep -v '^RAM\|^$' | grep -cvE '^  .{16}[ 0-9]{7}[0-9]($| )')" 0
is "zs_damage_compare and zs_damage_track" "$(grep -cE '  zs_damage_(compare, 4 columns|track, 3 of them)$' stdout)" 2

# ---- The wire ---------------------------------------------------------------------------------------------
begin wire_is_the_drivers
obj tri 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'f 1 2 3'
mkdir -p out
for panel in st7789:240x240,16 st7789:135x240,7 ssd0323:128x64,10 ssd1306:128x64,8; do
    z render tri.obj --panel "${panel%,*}" --strip "${panel#*,}" --out out/p.png --stats out/p.json
    [ $status -eq 0 ] || wrong "status $status: $(said)"
    want="$(stat_of p panel_bytes) $(stat_of p panel_windows) $(stat_of p panel_wire_us)"
    budget --panel "${panel%,*}" --strip "${panel#*,}" --csv
    is "bytes, windows, time of $panel" "$(csv wire_bytes) $(csv wire_windows) $(csv wire_ms)" \
        "$(echo "$want" | awk '{ printf "%d %d %.3f", $1, $2, $3 / 1000 }')"
done
budget --panel ssd1306:128x64 --strip 8 --csv
is "what a one-bit panel converts in" "$(csv scratch)" 128
budget --panel st7789:240x240 --spi 31250000 --csv
is "twice the time at half the clock" "$(csv wire_ms)" "$(awk 'BEGIN { printf "%.3f", 115365 * 8 / 31250 }')"

begin wire_is_no_faster_than_the_part
budget --panel st7789:240x240 --part stm32f103c8 --csv
is "18 MHz" "$(csv wire_ms)" "$(awk 'BEGIN { printf "%.3f", 115365 * 8 / 18000 }')"
budget --panel st7789:240x240 --part stm32f103c8 --spi 36000000 --csv
is "what was asked for" "$(csv wire_ms)" "$(awk 'BEGIN { printf "%.3f", 115365 * 8 / 36000 }')"
budget --panel st7789:240x240 --part nrf52840 --csv
alone="$(csv wire_ms | awk '{ printf "%.1f", $1 }') $(csv fps)"
budget --panel st7789:240x240
is "in the table of all parts" "$(awk '$1 == "nrf52840" { print $7, $9 }' stdout)" "$alone"

begin part_by_how_its_name_begins
budget --part nRF51 --csv
begun=$(csv ram_left)
budget --part nrf51822 --csv
is "nRF51" "$begun" "$(csv ram_left)"

# ---- Scenes ------------------------------------------------------------------------------------------------
begin scene_is_counted
budget --scene layers_ftb --strip 24
grep -q ': 14 of 16 triangles seen, 1 pass, 76800 pixels tested' stdout || wrong "$(head -1 stdout)"
budget --scene cubes --size 120x80 --tris 20 --csv
is "the pool that was asked for" "$(csv tris)" 240
budget tri.obj --size 100x100 --shade smooth --csv
is "a vertex of a model: 12, 4 and 3 words" "$(csv verts) $(csv numbers) $(csv attrs)" "36 16 20"
is "a triangle's mesh, material, instance and cluster" "$(csv flash_data)" \
    "$((72 + 16 + 64 + 3 * (6 + 6) + 6 + 20))"
budget tri.obj --size 100x100 --shade flat --csv
is "the same, flat" "$(csv flash_data)" "$((72 + 16 + 64 + 3 * 6 + 6 + 6 + 20))"
for core in M0 M3; do # the lists of models have ZS_FAST_CLUSTERS, and flyover's
    budget tri.obj --size 100x100 --shade flat --core $core --csv
    model=$(csv flash_zstrip)
    budget --size 100x100 --shade flat --core $core --csv
    with=$(sed -n 's/.* record_clusters.* { { \([0-9]*\), 0 }, { \([0-9]*\), 0 } };/\1 \2/p' \
        "$top/sim/budget/record_sizes.h")
    [ $core = M3 ] && with=${with#* } || with=${with% *}
    is "clusters' accelerator on $core" $((model - $(csv flash_zstrip))) "$with"
done
flat=$(csv flash_zstrip)
budget --scene flyover --core M3 --csv
is "of a scene that lists it" $(($(csv flash_zstrip) - flat)) "$with"
budget --scene cubes --core M3 --csv
is "of one that does not" $(($(csv flash_zstrip) - flat)) 0
z budget --scene cubes --frame 7 --csv && frame7=$(csv draw_M3)
z budget --scene cubes --csv
[ "$frame7" != "$(csv draw_M3)" ] || wrong "--frame changes nothing"

begin flash_says_what_it_is_without
while IFS=, read -r options want; do
    # shellcheck disable=SC2086
    budget $options
    is "$options" "$(sed -n 's/^Flash, bytes, -O2      Cortex-M3      M0+//p' stdout)" "$want"
done <<'END'
--scene cubes,
--scene cubes --method painter,   without the method's own
--scene stilllife,   without the effects' own
END

begin more_of_anything_takes_longer
base="--size 240x240 --tris 2000 --verts 1200 --shade smooth"
# shellcheck disable=SC2086
budget $base --csv
least=$(csv draw_M3)
for more in '--tris 3000' '--scene-tris 9000' '--verts 2400' '--coverage 90' '--complexity 4' '--strip 4' \
    '--depth linear'; do
    # shellcheck disable=SC2086
    budget $base $more --csv
    [ "$(csv draw_M3)" -gt "$least" ] || wrong "$more: $(csv draw_M3) instructions, $least without"
done
# Of shaders, the same with light or colours besides: smooth and textured are drawn in ways of their own, as dear as
# each other
for more in 'flat smooth' 'unlit textured'; do
    # shellcheck disable=SC2086
    budget $base --shade "${more% *}" --csv
    least=$(csv draw_M3)
    # shellcheck disable=SC2086
    budget $base --shade "${more#* }" --csv
    [ "$(csv draw_M3)" -gt "$least" ] || wrong "$more: $(csv draw_M3) instructions, $least without"
done
budget --size 240x240 --shade flat --csv
flat=$(csv flash_zstrip)
budget --size 240x240 --shade textured --state --watch 4 --track 3 --csv
[ "$(csv flash_zstrip)" -gt "$flat" ] || wrong "textures, states, zs_damage_compare and zs_damage_track take no flash"

begin numbers_alone_are_a_third_off_at_most # of what the scene's frame takes
for one in M3,mesh_lit,320x240,816,2520,1262,34.2,1,flat M3,teapot,240x240,1688,3130,1647,58,1.13,smooth \
    M0,city,240x240,1282,2404,1544,60,1.14,flat M3,sheet,320x240,20000,20000,10201,93,1,id; do
    echo "$one" | tr ',' ' ' >one
    read -r core scene size tris all verts part times shade <one
    budget --size "$size" --strip 24 --buffers 1 --tris "$tris" --scene-tris "$all" --verts "$verts" \
        --scene-verts "$verts" --coverage "$part" --complexity "$times" --shade "$shade" --csv
    off=0.34
    [ "$scene" != sheet ] || off=0.2 # its counts are near what is guessed
    awk -v a="$(csv draw_$core)" -v off=$off \
        -v b="$(sed -n "s/^$core $scene //p" "$top/tests/records/bench.txt")" \
        'BEGIN { exit !(b > 0 && a / b < 1 + off && a / b > 1 - off) }' || wrong "$scene: $(csv draw_$core) on $core"
done

begin frames_a_second
budget --panel st7789:240x240 --part rp2040 --csv
awk -v f="$(csv frame_ms)" -v d="$(csv draw_ms)" -v w="$(csv wire_ms)" \
    'BEGIN { e = f - (d > w ? d + w / 15 : w + d / 15); exit !(f > 0 && e < 0.002 && e > -0.002) }' ||
    wrong "two buffers, strips alike: $(csv draw_ms) and $(csv wire_ms) make $(csv frame_ms)"
is "frames a second" "$(csv fps)" "$(awk -v f="$(csv frame_ms)" 'BEGIN { printf "%.1f", 1000 / f }')"
budget --scene city --part rp2040 --strip 24 --csv # without a wire
is "two buffers without a wire" "$(csv frame_ms)" "$(csv draw_ms)"
budget --scene city --panel st7789:240x240 --part rp2040 --strip 24 --csv
awk -v f="$(csv frame_ms)" -v d="$(csv draw_ms)" -v w="$(csv wire_ms)" \
    'BEGIN { exit !(d > w && f > 1.1 * d && f < d + w) }' || # the sky's strips are drawn sooner than they are sent
    wrong "two buffers, strips that differ: $(csv draw_ms) and $(csv wire_ms) make $(csv frame_ms)"
budget --scene city --panel st7789:240x240 --part rp2040 --strip 240 --csv
is "one strip is drawn, then sent" "$(csv fps)" "$(awk -v d="$(csv draw_ms)" -v w="$(csv wire_ms)" \
    'BEGIN { printf "%.1f", 1000 / (d + w) }')"
budget --panel st7789:240x240 --part rp2040 --buffers 1 --csv
awk -v f="$(csv frame_ms)" -v d="$(csv draw_ms)" -v w="$(csv wire_ms)" \
    'BEGIN { e = f - d - w; exit !(f > 0 && e < 0.0015 && e > -0.0015) }' || # each is rounded to 0.001
    wrong "one buffer: $(csv draw_ms) and $(csv wire_ms) make $(csv frame_ms)"
budget --core M3 --mhz 50 --cpi 2 --csv
part_row() { # NAME    of the table of parts in the last report
    awk -v part="$1" '$1 == part { $1 = ""; print substr($0, 2) }' stdout
}
of_core="M3 50 - - $(csv draw_ms | awk '{ printf "%.1f", $1 }') 0.0"
is "instructions to time" "$(csv draw_ms)" "$(awk -v n="$(csv draw_M3)" 'BEGIN { printf "%.3f", n * 2 / 50000 }')"
budget --core M3 --mhz 50 --cpi 2
is "a row of --core and --mhz" "$(part_row --core | cut -d' ' -f1-6)" "$of_core"
is "besides those of parts" "$(part_row stm32f405 | cut -d' ' -f1-2)" 'M4 168'
budget --core M3
is "no row without a clock" "$(part_row --core)" ''

begin slowest_strip
for strip in 60 16 1; do
    budget --scene teapot --strip $strip --part rp2040 --csv
    awk -v s="$(csv strip_ms)" -v d="$(csv draw_ms)" -v n=$((240 / strip)) 'BEGIN { exit !(s > d / n && s < d) }' ||
        wrong "strips of $strip rows: $(csv strip_ms) of $(csv draw_ms) ms"
done
budget --scene teapot --strip 240 --part rp2040 --csv
is "one strip is the frame" "$(csv strip_ms)" "$(csv draw_ms)"
# pools that take several walks: each band's first strip holds one
budget --scene teapot --strip 16 --tris 400 --verts 500 --part rp2040 --csv
awk -v s="$(csv strip_ms)" -v d="$(csv draw_ms)" 'BEGIN { exit !(s > d / 15 && s < d / 2) }' ||
    wrong "in several walks: $(csv strip_ms) of $(csv draw_ms) ms"

# ---- What fits -------------------------------------------------------------------------------------------------
ram_left() { # PART OPTION...
    part=$1
    shift
    budget --part "$part" "$@" --csv
    csv ram_left
}
begin what_fits_fits_and_no_more
for one in rp2040,240x240,2000,1200 nrf52832,160x128,700,500 stm32f405,320x240,1500,1501; do
    echo "$one" | tr ',' ' ' >one
    read -r part size tris verts <one
    budget --fit "$part" --size "$size" --strip 12 --tris "$tris" --verts "$verts" --shade smooth --csv
    rows=$(csv fit_strip) most=$(csv fit_tris) with=$(csv fit_verts)
    [ "$rows" -gt 1 ] && [ "$most" -gt 1 ] || { wrong "$part: $rows rows, $most triangles"; continue; }
    set -- --size "$size" --shade smooth
    [ "$(ram_left "$part" "$@" --tris "$tris" --verts "$verts" --strip "$rows")" -ge 0 ] ||
        wrong "$part: $rows rows do not fit"
    [ "$rows" -eq "${size#*x}" ] ||
        [ "$(ram_left "$part" "$@" --tris "$tris" --verts "$verts" --strip $((rows + 1)))" -lt 0 ] ||
        wrong "$part: $((rows + 1)) rows fit too"
    [ "$(ram_left "$part" "$@" --tris "$most" --verts "$with" --strip 12)" -ge 0 ] ||
        wrong "$part: $most triangles do not fit"
    with=$((((most + 1) * verts + tris - 1) / tris))
    [ "$(ram_left "$part" "$@" --tris $((most + 1)) --verts $with --strip 12)" -lt 0 ] ||
        wrong "$part: $((most + 1)) triangles fit too"
done
budget --fit nrf51822 --panel ssd1306:128x64 --strip 8 --csv
is "pages of 8 rows" $(($(csv fit_strip) % 8)) 0
last_most=$(csv fit_tris)
budget --fit nrf51822 --panel ssd1306:128x64 --strip 8 --app-ram 1200 --csv
less=$((last_most - $(csv fit_tris)))
is "1,200 bytes are up to 100 triangles less, and their vertices" $((less < 100 && less > 40)) 1

# Code in RAM: what an image of the Pico takes is never more than was said, and not much less
z render tri.obj --size 64x64 --background 4060c0 --out skin.png
printf 'newmtl skin\nmap_Kd skin.png\n' >skin.mtl
corners='vn 0 0 1 vn 1 0 1 vn 0 1 1 vt 0 0 vt 1 0 vt 0 1'
corners=$(echo "$corners" | sed 's/ v/\nv/g')
cp tri.obj flat.obj
{ printf '%s\n' "$corners"; sed 's|^f .*|f 1//1 2//2 3//3|' tri.obj; } >smooth.obj
{ printf 'mtllib skin.mtl\nusemtl skin\n%s\n' "$corners"; sed 's|^f .*|f 1/1/1 2/2/2 3/3/3|' tri.obj; } >textured.obj
image() { # NAME    RAM of a project's image for the Pico; its pools in $tris and $verts
    z new "$1.obj" --board pico --out "$1"
    [ $status -eq 0 ] || wrong "$1: $(said)"
    tris=$(sed -n 's/^#define TRIS \([0-9]*\).*/\1/p' "$1/main.c")
    verts=$(sed -n 's/^#define VERTS \([0-9]*\).*/\1/p' "$1/main.c")
    make -s --no-print-directory -C flat/zstrip -f firmware/boards/firmware.mk BOARD=pico image B="$work/pico" \
        NAME="$1" APP_SRC="$work/$1/main.c $work/$1/display.c $work/$1/model.c" >image.txt 2>&1 ||
        wrong "$(tail -3 image.txt)"
    ram=$(sed -n 's/.*, RAM \([0-9]*\) of .*/\1/p' image.txt)
}
begin ram_of_an_image_is_never_more_than_was_said
for kind in flat smooth textured; do
    image $kind
    set -- $kind.obj --panel st7789:240x240 --strip 24 --tris "$tris" --verts "$verts"
    budget "$@" --part rp2040 --csv
    awk -v image="${ram:-0}" -v said="$(csv ram)" \
        'BEGIN { exit !(image > 0 && said >= image && said < image * 1.08) }' ||
        wrong "$kind: an image takes $ram bytes, $(csv ram) are said"
    is "left of $kind" "$(csv ram_left)" $((264 * 1024 - $(csv ram)))
    all=$(csv ram) code=$(csv code_in_ram) left=$(csv ram_left)
    budget "$@" --part rp2040
    is "code in RAM in the report" "$(sed -n 's/^  code in RAM *\([0-9]*\) .*/\1/p' stdout)" "$code"
    is "all of it there" "$(sed -n 's/^  on the RP2040 *\([0-9]*\)$/\1/p' stdout)" "$all"
    budget "$@"
    is "left in the table of parts" "$(awk '$1 == "rp2040" { print $4 }' stdout)" "$left"
    grep -q 'code in RAM' stdout && wrong 'of no part, code in RAM is said'
    note="$note${note:+, }$kind: image $ram, said $all"
done
budget --core M0 --csv
is "no code in RAM on another core" "$(csv code_in_ram)$(csv stack_reserved)" 00

# ---- Limits -------------------------------------------------------------------------------------------------------
limits() { # LINE...
    printf '%s\n' "$@" >limits
}
on_m4='--panel st7789:240x240 --part stm32f411'
begin limits_kept
limits '# ours' 'ram = 131072' '' ' flash=400000 # with meshes' 'fps = 5' 'stack = 2048' 'wire_ms = 20' \
    'frame_ms=400' 'ram_left = 0'
# shellcheck disable=SC2086
z budget $on_m4 --check limits
[ $status -eq 0 ] || wrong "status $status: $(said)"
is "limits" "$(grep -c '^ok ' stdout)" 7
begin limits_exceeded
limits 'ram = 40000' 'flash = 400000' 'fps = 5000'
# shellcheck disable=SC2086
z budget $on_m4 --check limits
[ $status -eq 1 ] || wrong "status $status instead of 1"
is "exceeded" "$(sed -n 's/^EXCEEDED \([a-z_]*\):.*/\1/p' stdout | tr '\n' ' ')" 'ram fps '
grep -q 'limits: 2 of 3 limits exceeded' stderr || wrong "$(said)"
not_limits() { # NAME SAID LINE...
    begin "limits_$1"
    what=$2
    shift 2
    limits "$@"
    z budget --check limits
    one_line 1 "$what"
}
not_limits unknown 'limits:2: rom is not known here; there are ram, arena, stack, flash' '# x' 'rom = 3'
for one in fps draw_ms strip_ms frame_ms; do
    not_limits "$one" "limits:1: $one needs a clock: give --part, or --core and --mhz" "$one = 3"
done
not_limits wire_ms 'limits:1: wire_ms needs a --panel' 'wire_ms = 3'
not_limits ram_left 'limits:1: ram_left needs a --part' 'ram_left = 3'
begin limits_of_a_strip_of_numbers
limits 'strip_ms = 3'
z budget --part rp2040 --check limits
one_line 1 'limits:1: strip_ms needs a frame that is counted: give --scene or a model'
limits 'fps = 3'
z budget --method painter --part rp2040 --check limits
one_line 1 'limits:1: fps needs more than numbers with this method: give --scene or a model'
for one in ram flash ram_left flash_left; do
    begin "limits_of_risc_v_$one"
    for part in esp32-c3 gd32vf103; do
        limits "$one = 0"
        z budget --strip 4 --tris 9 --verts 27 --part $part --check limits
        one_line 1 "limits:1: $one needs an --elf: flash and stack of RISC-V parts are not known"
    done
done
begin limits_of_risc_v_stack
limits 'stack = 9999'
z budget --core rv32imc --check limits
one_line 1 'limits:1: stack needs a Cortex-M: flash and stack of RISC-V parts are not known'
begin risc_v_has_no_figures_of_a_cortex_m
for one in '--part esp32-c3' '--core rv32imc'; do
    # shellcheck disable=SC2086
    budget $one --strip 4 --tris 9 --verts 27 --csv
    is "$one" "$(cut -d, -f1 stdout | grep -xE 'ram.*|stack|flash.*' | tr '\n' ' ')" 'flash_data '
done
not_known='^-: flash and stack of RISC-V parts are not known; .* with the Cortex-M3.s stack[.]$'
for one in '' '--part gd32vf103'; do
    # shellcheck disable=SC2086
    budget $one
    is "flash left" "$(awk '$1 == "gd32vf103" { print $5 }' stdout)" -
    is "it is said" "$(grep -c "$not_known" stdout)" 1
done
budget --part stm32f405
is "of a Cortex-M nothing is said" "$(grep -c 'RISC-V' stdout)" 0
budget --fit gd32vf103 --strip 4
is "it is said of what fits" "$(grep -c 'RISC-V parts are not known: the Cortex-M3.s stack stands in$' stdout)" 1
not_limits not_a_number 'limits:1: a limit reads name = number' 'ram = much'
for endless in inf nan -inf infinity; do
    not_limits "of_$endless" 'limits:1: a limit reads name = number' "ram = $endless"
done
not_limits not_a_line 'limits:1: a limit reads name = number' 'ram 65536'
not_limits none 'holds no limit' '# nothing'

begin a_build_in_place_of_sums
cat >tiny.c <<'END'
int table[100] = { 1 }, zeros[1000];
const int fixed[50] = { 2 };
int main(void) { return table[zeros[0]] + fixed[zeros[1]]; }
END
"${ARM}gcc" -mcpu=cortex-m3 -mthumb -O1 -nostdlib -Wl,-e,main tiny.c -o tiny.elf 2>/dev/null
want=$("${ARM}size" -B tiny.elf | awk 'NR == 2 { print $1 + $2, $2 + $3 }')
budget --part lm3s6965 --elf tiny.elf --csv
is "flash and RAM" "$(csv flash) $(csv ram)" "$want"
left="$(csv ram_left) $(csv flash_left)"
budget --part lm3s6965 --elf tiny.elf
is "left of them in the part's row" "$(part_row lm3s6965 | cut -d' ' -f3-4)" "$left"
"${ARM}gcc" -mcpu=cortex-m3 -mthumb -O1 -c tiny.c -o tiny.o
z budget --elf tiny.o
one_line 1 'tiny.o: --elf: no linked program'
limits 'ram = 4399' # 4,400 are taken
z budget --elf tiny.elf --check limits
[ $status -eq 1 ] || wrong "status $status: a build beyond its limit passes"
limits 'ram = 4400' 'flash_left = 1' # a build is known of RISC-V, too
z budget --part esp32-c3 --elf tiny.elf --check limits
is "a build for RISC-V" "$status $(grep -c '^ok ' stdout)" '0 2'
budget --part esp32-c3 --elf tiny.elf
is "in the table" "$(part_row esp32-c3 | cut -d' ' -f4) $(grep -c 'RISC-V' stdout)" \
    "$((4096 * 1024 - ${want% *})) 0"

# The Pico's image: code that is copied to RAM takes both
begin a_build_with_code_in_ram
want=$("${ARM}size" -A pico/fw/pico/textured.elf | awk '{ n[$1] = $2 } END {
    print n[".boot2"] + n[".vectors"] + n[".once"] + n[".text"] + n[".ARM.exidx"] + n[".data"],
        n[".stack"] + n[".data"] + n[".bss"] }')
budget --part rp2040 --elf pico/fw/pico/textured.elf --csv
is "flash and RAM" "$(csv flash) $(csv ram)" "$want"
is "what make image says" "$(sed -n 's/.*: flash \([0-9]*\) of .*, RAM \([0-9]*\) of .*/\1 \2/p' image.txt)" "$want"

# ---- The textbook --------------------------------------------------------------------------------------------------
begin textbook
budget --textbook
is "24 MB, 100 MB with four samples, 105 MB a frame" \
    "$(sed 's/.* \([0-9.]*\) MB$/\1/' stdout | tr '\n' ' ')" '24.9 99.5 104.9 '
budget --buffer 1920x1080 --color 64 --depth-bits 32 --samples 4 --csv
is "colour, depth, both" "$(csv buffer_color) $(csv buffer_depth) $(csv buffer)" '66355200 33177600 99532800'
budget --buffer 1280x1024 --fragments 4 --accesses 5 --csv
is "traffic" "$(csv traffic)" 104857600
budget --buffer 240x240 --color 16 --depth-bits 16 --csv
is "this panel's frame, and why there are strips" "$(csv buffer)" 230400

# ---- Costs -----------------------------------------------------------------------------------------------------------
begin costs_on_record
costs
[ $status -eq 0 ] || wrong "status $status: $(said)"
for core in M0 M3 M4 M7 rv32imc RP2040; do
    head -1 stdout | grep -q " $core" || wrong "no column of $core"
done
awk 'NR > 1 && /  vertex to the screen, depth float/ {
        for (i = 2; i <= 7; i++) if ($i < 20 || $i > 5000) bad = 1; seen = 1 }
    END { exit bad || !seen }' stdout || wrong "a vertex costs $(grep 'depth float$' stdout)"
begin error_is_stated
# the RP2040's, the last
stated=$(sed -n 's/^static const double stage_error.* \([0-9.]*\) };$/\1/p' "$top/sim/budget/stage_costs.h")
budget --scene cubes --part rp2040
is "percent" "$(sed -n 's/^  Of the demo .* none is more than \([0-9]*\) % off on this core.$/\1/p' stdout)" \
    "$(awk -v e="$stated" 'BEGIN { n = int(e); print n < e ? n + 1 : n }')"
awk -v e="$stated" 'BEGIN { exit !(e > 0 && e < 15) }' || wrong "$stated % is not under 15"
begin counts_of_a_scene
costs --scene layers_ftb
[ $status -eq 0 ] || wrong "status $status: $(said)"
is "pixels without a test, rows, runs, bounds, instances asked" "$(awk '
    / key of a pixel drawn without a test$/ { px = $2 } / row with pixels, more where nothing/ { rows = $2 }
    / run of pixels that win, any other way$/ { runs = $2 } / more where it does$/ { bounds = $2 }
    / more where it may lie behind large triangles$/ { asked = $2 }
    END { print px, rows, runs, bounds, asked }' stdout)" '76800 480 480 2 7'
costs --scene moon
one_line 1 'moon: is no demo or bench scene'
begin error_of_estimates
grep -E '^M3 (mesh|cubes|sheet|hall) ' "$top/tests/records/bench.txt" >scenes
costs --error scenes
[ $status -eq 0 ] || wrong "status $status: $(tail -1 stdout) $(said)"
note=$(tail -1 stdout)
sed 's/^\(M3 mesh\) .*/\1 3000000/' scenes >far
z budget --error far
[ $status -eq 1 ] && grep -q 'too far' stdout || wrong "status $status: a scene 40 % off passes"
begin probes_of_another_build
printf 'probe,name,instructions,checksum\n0,raw_c18_f1_z10_s24,744560,1\n' >other.csv
costs --m3 other.csv
one_line 1 'other.csv:2: raw_c18_f1_z10_s24: its frame is not the one that this zlab draws'

# ---- Refused --------------------------------------------------------------------------------------------------------
mkdir -p refused && echo older >refused/old.png
no() { # NAME STATUS SAID ARGUMENT...
    begin "budget_$1"
    code=$2 what=$3
    shift 3
    z budget "$@"
    one_line "$code" "$what"
}
no part 1 '--part z80: there is no such part; there are rp2040, stm32f103c8' --part z80
no parts 1 '--part nrf52: which of them? There are nrf52832, nrf52840' --part nrf52
no fits 1 '--fit stm32f103: which of them? There are stm32f103c8, stm32f103rc' --fit stm32f103
no fit 1 '--fit z80: there is no such part' --fit z80
no fit_none 1 'not even one triangle fits' --fit nrf51822 --size 240x240 --strip 240
no scene 1 '--scene moon: there is no such scene; there are teapot, cubes' --scene moon
no model 1 'none.obj' none.obj
no panel 1 '--panel oled is not known; there are st7789:240x240' --panel oled
no strip 1 '--strip 12: ssd1306:128x64 takes 8 rows at a time' --panel ssd1306:128x64 --strip 12
no tris 1 '--tris 70000 is outside its range' --tris 70000
no scene_tris 1 '--scene-tris 5 is less than the 1000 of --tris' --scene-tris 5
no check 1 'nowhere: cannot be read' --check nowhere
no elf 1 'tri.obj: --elf: no linked program' --elf tri.obj
no error 1 'nowhere: cannot be read' --error nowhere
no core 2 '--core is the part' --part rp2040 --core M3
for two in '--fit rp2040:--check limits' '--methods:--check limits' '--effects:--check limits' \
    '--textbook:--check limits' '--buffer 2x2:--check limits' '--error scenes:--check limits' '--methods:--fit rp2040' \
    '--textbook:--buffer 2x2'; do
    one=${two%%:*} other=${two#*:}
    # shellcheck disable=SC2086
    no "two_answers_${one%% *}" 2 "${one%% *}" $one $other
    case $the_line in *"${other%% *}"*' are two answers: ask for one of them'*) ;; *) wrong "$the_line" ;; esac
done
no three_answers 2 '--fit and --methods are two answers' --csv --methods --fit rp2040
for pair in 'ram 2000:--methods' 'bar 3:--error' 'color 3:--buffer' 'depth-bits 3:--buffer' 'samples 3:--buffer' \
    'fragments 3:--buffer' 'accesses 3:--buffer' 'access-bits 3:--buffer'; do
    one=--${pair%%:*}
    # shellcheck disable=SC2086
    no "of_an_answer_${one%% *}" 2 "${one%% *} is for ${pair#*:}, which is missing" $one
done
for one in '--check limits' --textbook '--error scenes'; do
    # shellcheck disable=SC2086
    no "no_csv_${one%% *}" 2 "--csv: ${one%% *} has none" --csv $one
done
no elf_of_fit 2 '--elf is for the report, --csv and --check' --elf tiny.elf --fit rp2040
# What a demo scene, a model or numbers do not take
for one in '--eye 1,2,3' '--at 1,2,3' '--up 0,1,0' '--fov 40' '--near 1' '--far 9' '--projection orthographic' \
    '--texture skin.png' --precise '--simplify 9' --allow-outside '--load-memory 99' '--load-seconds 9'; do
    # shellcheck disable=SC2086
    no "no_model_${one%% *}" 2 "${one%% *} is for a model, which is missing" $one
    # shellcheck disable=SC2086
    no "of_a_scene_${one%% *}" 2 "${one%% *} is for a model, which is missing" $one --scene cubes
done
for one in '--shade flat' '--texture-format pal8' '--depth recip'; do
    # shellcheck disable=SC2086
    no "of_a_scene_${one%% *}" 2 "${one%% *} is for a model or numbers: a demo scene has its own" $one --scene cubes
done
for one in '--coverage 40' '--complexity 2' '--instances 2' '--scene-tris 2000' '--scene-verts 2000'; do
    # shellcheck disable=SC2086
    no "of_a_scene_${one%% *}" 2 "${one%% *} is for numbers alone: leave --scene and the model out" $one --scene cubes
    # shellcheck disable=SC2086
    no "of_a_model_${one%% *}" 2 "${one%% *} is for numbers alone: leave --scene and the model out" $one tri.obj
done
no frame_of_a_model 2 '--frame is for a --scene, which is missing' --frame 3 tri.obj
no two_mappings 2 '--method painter brings its depth mapping: leave --depth out' --method painter --depth recip
for shade in '' '--shade flat' '--shade smooth' '--shade id' 'tri.obj --shade flat'; do
    # shellcheck disable=SC2086
    no "no_texels_$(echo "$shade" | tr -d ' -')" 2 '--texture-format is for a --shade with textures' \
        --texture-format pal8 $shade
done
begin what_applies_is_taken
for line in 'tri.obj --texture-format pal8' '--shade unlit --texture-format pal4' \
    'tri.obj --depth recip --shade smooth' '--method hiz --depth recip' '--csv --fit rp2040' \
    '--method painter --scene cubes'; do
    # shellcheck disable=SC2086
    budget $line
done
no clock 2 '--mhz is for a --part or a --core, which is missing' --mhz 50
no both 2 '--scene and a model' tri.obj --scene cubes
no two 2 'one model at a time' tri.obj tri.obj
no files 2 "ring.c: files of one scene are in quotes, as in --scene \"lit.c ring.c\"" --scene lit.c ring.c
for near in M23:M0 M33:M4 M55:M4 M85:M7; do
    core=${near%:*}
    no "near_$core" 2 "--core wants M0|M3|M4|M7|rv32imc|RP2040, not '$core'; take ${near#*:}" --core "$core"
    no "near_is_$core" 2 "not '$core'; take ${near#*:}" "--core=$core"
done
cp "$top/firmware/app/my_scene.c" mine.c && echo 'int ring;' >ring.c
begin files_of_one_scene_in_quotes
budget --scene 'mine.c ring.c'
no spi 2 '--spi is for a --panel' --spi 1000000
no unknown 2 "unknown option '--rows'" --rows 3
no word 2 '--shade wants id|flat' --shade metal
no value 2 '--tris wants a whole number' --tris many
finish
exit $((n_failed > 0))
