#!/bin/sh
# How instructions grow with triangles, pixels, strips, passes, depth complexity and less RAM (firmware/app/scale.c), on
# QEMU's Cortex-M3: no series may grow worse than linearly. The same frames on this machine must be the same, bit for
# bit. Instructions are not cycles.
#
# A series' exponent is that of the power of x that fits its points best (least squares of logarithms). It may not be
# above 1.02, and between any two points of which one has twice the other's x, or more, not above 1.05. Points that take
# more passes than the series' first lie on another line, because the pools do not hold the scene and it is walked
# again: a pass of them may not take more than linear growth allows the whole.
#
# Layers: the first is drawn without a clear and without a test, at half of what any other takes, so that a power
# through it says nothing about the others. The series "layers tested" draws all alike and is held to the rule above.
# The same frames as they are drawn may nowhere cost more than those; and what the layers beyond the first take is held
# to the rule, against their number.
#
# RAM: no point may cost over 8 % more than one with less RAM. All points are printed, with how many times they take of
# what the last one does.
#
# Usage: tests/lab/scale.sh BUILD         the check
#        tests/lab/scale.sh BUILD plots   besides: CSV and a plot a series in BUILD/scale; needs gnuplot
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

out=$top/scale
mkdir -p "$out"
for board in host mps2; do
    firmware="make -s -j$(nproc) -f firmware/boards/firmware.mk BOARD=$board APP=scale B=$top"
    if ! $firmware all >"$out/log" 2>&1; then
        cat "$out/log"
        bad "scale on $board" "does not build"
        exit 1
    fi
    timeout 300 $firmware run >"$out/$board.csv" 2>"$out/$board.err" || bad "scale on $board ends" "status $?"
    cat "$out/$board.err" >>"$out/$board.csv" # semihosting may write to either
    none "scale on $board" "$(grep -iE 'error|^# failed' "$out/$board.csv" | tr ' ' '_')"
    grep -q '^# ok' "$out/$board.csv" || bad "scale on $board" "does not end"
    cut -d, -f1-10 "$out/$board.csv" | grep , >"$out/$board.frames"
done
if cmp -s "$out/host.frames" "$out/mps2.frames" && [ "$(wc -l <"$out/mps2.frames")" -gt 100 ]; then
    ok "M3 and host agree: $(($(wc -l <"$out/mps2.frames") - 1)) frames bit for bit"
else
    bad "M3 and host agree" "$(diff "$out/host.frames" "$out/mps2.frames" | grep -m1 '^>')"
fi

# series|scene|points|first x|last x|first|last instructions|exponent|steepest step|passes of the last|verdict
awk -F, '
    function exponent(a, b) { return log((count[b] - first) / (count[a] - first)) / log((x[b] - less) / (x[a] - less)) }
    function finish(    i, j, sx, sy, sxx, sxy, m, e, steepest, why, twin, from) {
        from = 1; first = less = 0
        twin = scene
        if (sub(/^layers /, "layers tested ", twin) && (series, twin, x[1]) in cost) {
            from = 2; first = count[1]; less = x[1]
            for (i = 1; i <= n; i++)
                if (!((series, twin, x[i]) in cost) || count[i] > cost[series, twin, x[i]])
                    why = why sprintf(" %d layers cost more than where all are tested;", x[i])
        }
        for (i = 1; i <= n; i++) {
            if (series != "passes" && passes[i] > passes[1]) {
                e = count[i] / passes[i] / x[i] / (count[last] / x[last])
                if (e > 1) why = why sprintf(" a pass at %d takes %.2f times what is linear;", x[i], e)
                continue
            }
            last = i; m++
            sx += log(x[i]); sy += log(count[i]); sxx += log(x[i]) ^ 2; sxy += log(x[i]) * log(count[i])
            for (j = from; j < i; j++)
                if (x[i] >= 2 * x[j] && (steepest == "" || exponent(j, i) > steepest)) steepest = exponent(j, i)
        }
        if (m < 5 || steepest == "") why = why " too few points;"
        else {
            e = (m * sxy - sx * sy) / (m * sxx - sx * sx)
            if (e > 1.02) why = why " fits a power above 1.02;"
            if (steepest > 1.05) why = why " grows by a power above 1.05;"
        }
        printf "%s|%s|%d|%d|%d|%d|%d|%.3f|%.3f|%d|%s\n", series, scene, n, x[1], x[n], count[1], count[n], e, steepest,
            passes[n], why
        n = 0; last = 0
    }
    /^#/ || $1 == "series" || $1 == "ram" || NF != 11 { next }
    NR == FNR { cost[$1, $2, $3] = $11; next }
    n && ($1 != series || $2 != scene) { finish() }
    { series = $1; scene = $2; n++; x[n] = $3; passes[n] = $4; count[n] = $11 }
    END { if (n) finish() }' "$out/mps2.csv" "$out/mps2.csv" >"$out/fits"
for order in 'front to back' 'back to front' mixed; do
    grep -q "^depth|layers tested $order|" "$out/fits" || bad "layers tested $order" "not measured"
done

# More RAM for the same frames, but for 8 %
awk -F, '
    $1 != "ram" || NF != 11 { next }
    $2 != scene { scene = $2; least = 0 }
    least && $11 > least * 1.08 { printf "%s in %d KB: %.2f times what less takes\n", scene, $3, $11 / least }
    !least || $11 < least { least = $11 }' "$out/mps2.csv" >"$out/bumps"
grep -q '^ram,' "$out/mps2.csv" || bad "more RAM costs no more" "not measured"
none "more RAM costs no more" "$(tr ' ' '_' <"$out/bumps")"

for series in triangles pixels strips passes depth; do
    none "instructions grow at most linearly with $series" \
        "$(awk -F'|' -v s=$series '$1 == s && $11 != "" { print $2 ":" $11 }' "$out/fits" | tr ' ' '_')"
    grep -q "^$series|" "$out/fits" || bad "instructions grow at most linearly with $series" "not measured"
done

echo
echo "Growth on the Cortex-M3 (QEMU mps2-an385 -icount): instructions from the first to the last x, the power that"
echo "fits, and the steepest between points of twice x and more (of layers that are not all tested: of those beyond"
echo "the first)."
awk -F'|' '
    BEGIN {
        printf "%-10s %-27s %8s %8s %9s %9s %6s %9s\n", "x", "scene", "from", "to", "M instr", "", "power", "steepest"
    }
    { printf "%-10s %-27s %8d %8d %9.3f %9.3f %6.2f %9.2f%s\n", $1, $2, $4, $5, $6 / 1e6, $7 / 1e6, $8, $9,
        ($1 != "passes" && $10 > 1) ? sprintf("  the last in %d passes", $10) : "" }' "$out/fits"
echo
echo "RAM, everything counted (one strip buffer), KB: M instructions in passes, and times what the last point takes."
awk -F, '
    $1 != "ram" || NF != 11 { next }
    { if (!($2 in n)) order[++scenes] = $2; k = ++n[$2]; kb[$2, k] = $3; passes[$2, k] = $4; count[$2, k] = $11 }
    END {
        for (i = 1; i <= scenes; i++) {
            s = order[i]
            print s
            for (k = 1; k <= n[s]; k++)
                printf "  %4d KB %9.3f in %4d %8.2f\n", kb[s, k], count[s, k] / 1e6, passes[s, k],
                    count[s, k] / count[s, n[s]]
        }
    }' "$out/mps2.csv"
[ "${2:-}" = plots ] || exit $failed

# ---- Plots ------------------------------------------------------------------------------------------------------

# SERIES X-AXIS TICS
plot() {
    series=$1
    {
        echo "set terminal pngcairo size 960,600 font ',11'"
        echo "set output '$out/$series.png'"
        echo "set datafile separator ','; set colorsequence podo; set logscale xy; set grid"
        echo "set key outside right top noenhanced"
        echo "set xlabel '$2'; set ylabel 'instructions a frame, Cortex-M3'; set format y '%.0s %c'; set xtics ($3)"
        awk -F'|' -v series="$series" '
            $1 != series { next }
            !x1 || $5 > x1 { x1 = $5 }
            !x0 || $4 < x0 { x0 = $4 }
            !y1 || $7 > y1 { y1 = $7 }
            !y0 || $6 < y0 { y0 = $6 }
            END { printf "set xrange [%g:%g]; set yrange [%g:%g]\n", x0 / 1.1, x1 * 1.1, y0 / 1.5, y1 * 1.5 }
        ' "$out/fits"
        printf 'plot '
        awk -F'|' -v series="$series" -v csv="$out/mps2.csv" -v q="'" '$1 == series {
            printf "%s%s< grep \"^%s,%s,\" %s%s using 3:11 with linespoints lw 2 ps %g title %s%s, power %.2f%s%s",
                n++ ? ", " : "", q, $1, $2, csv, q, 2.5 / n, q, $2, $8,
                ($1 != "passes" && $10 > 1) ? "; last: " $10 " passes" : "", q }' "$out/fits"
        # linear growth, up to the dearest of the last points that took as many passes as the first
        awk -F, -v series="$series" -v q="'" '
            $1 != series || NF != 11 || (series != "passes" && $4 > 1) || $3 < x { next }
            { if ($3 > x || $11 > y) y = $11; x = $3 }
            END { printf ", %.6g * x with lines dashtype 2 lc rgb %s#888888%s title %slinear%s\n", y / x, q, q, q, q }
        ' "$out/mps2.csv"
    } >"$out/$series.gnuplot"
    gnuplot "$out/$series.gnuplot" || bad "plot of $series" "gnuplot says no"
}
plot triangles 'triangles that came in; 320x240' '100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000, 100000'
plot pixels 'pixels of the frame' \
    '"64x64" 4096, "128x128" 16384, "256x256" 65536, "512x512" 262144, "1024x1024" 1048576'
plot strips 'strips of a 320x240 frame' '1, 2, 3, 5, 10, 15, 30, 60, 120, 240'
plot passes 'passes that smaller pools take' '1, 2, 5, 10, 20, 50, 100, 200, 500'
plot depth 'layers that fill 320x240; balls behind each other' '1, 2, 4, 8, 16, 32, 64'
{
    echo "set terminal pngcairo size 960,600 font ',11'; set output '$out/ram.png'"
    echo "set datafile separator ','; set colorsequence podo; set logscale xy; set grid"
    echo "set key outside right top noenhanced"
    echo "set xlabel 'KB of RAM, everything counted'; set ylabel 'instructions a frame, Cortex-M3'"
    echo "set format y '%.0s %c'"
    echo "set xtics (8, 16, 32, 64, 128)"
    awk -F, -v csv="$out/mps2.csv" -v q="'" '$1 == "ram" && NF == 11 && !($2 in seen) {
        printf "%s%s< grep \"^ram,%s,\" %s%s using 3:11 with linespoints lw 2 title %s%s%s", n++ ? ", " : "plot ",
            q, $2, csv, q, q, $2, q
        seen[$2] = 1 }' "$out/mps2.csv"
} >"$out/ram.gnuplot"
gnuplot "$out/ram.gnuplot" || bad "plot of ram" "gnuplot says no"
for series in triangles pixels strips passes depth ram; do
    grep -E "^series|^$series," "$out/mps2.csv" >"$out/$series.csv"
done
echo
echo "CSV and plots: $out/triangles.csv, .png, and the same of pixels, strips, passes, depth, ram"
exit $failed
