#!/bin/sh
# `zsim study`: small sweeps. Rows, shards, resuming, the page, what is refused; what is measured against the formulas;
# and, with frames counted on the emulated M3, that no setting beats the default.
# Usage: tests/tools/study.sh ZSIM WORKDIR BUILD     as tests/tools/cli.sh; BUILD has what firmware is made of
set -u
unset LANG LC_ALL LC_CTYPE # what it writes is UTF-8 in any locale
build=$(cd "$3" && pwd)
. tests/tools/zsim.sh

study() { # STATUS ARGUMENT...
    want=$1
    shift
    z study "$@"
    [ $status -eq "$want" ] || wrong "status $status instead of $want: $(said)"
}
refuses() { # NAME STATUS PATTERN ARGUMENT...    in one line
    begin "study_refuses_$1"
    want=$2
    what=$3
    shift 3
    z study "$@"
    one_line "$want" "$what"
}
same_bytes() { # A B
    cmp "$1" "$2" >/dev/null 2>&1 || wrong "$1 and $2 differ: $(cmp "$1" "$2" 2>&1)"
}
runs() { # CSV
    tail -n +2 "$1" | wc -l | tr -d ' '
}

finds_nothing() { # AWK-PROGRAM CSV    it prints what is wrong
    awk -F, "$1" "$2" >bad || wrong "no $2"
    [ ! -s bad ] || wrong "$(head -1 bad)"
}

# ---- Every study: rows and page -------------------------------------------------------------------------------------
for which in depth stability memory time; do
    begin "study_${which}_rows"
    study 0 $which --quick --out all
    [ ! -s stderr ] || wrong "it talks in a pipe: $(said)"
    awk -F, -v name=$which '
        NR == 1 { n = NF; if ($0 !~ /^study,build,effort,run,/) bad = "header " $0; next }
        NF != n { bad = "row " NR " has " NF " fields of " n }
        $1 != name || $3 != "quick" || $4 != NR - 2 { bad = "row " NR ": " $0 }
        END { if (NR < 10) bad = NR " lines"; printf "%s", bad }' all/$which.csv >bad
    is "what is wrong" "$(cat bad)" ''
    note="$(runs all/$which.csv) runs"
done

begin study_page_needs_no_other_file
grep -oE '(src|href)=[^ >]{0,30}' all/index.html | grep -v '^src="data:image/' >links
[ ! -s links ] || wrong "$(head -1 links)"
grep -qiE '<script|<link|@import|url\(' all/index.html && wrong "it loads something"
for id in depth stability memory time; do
    grep -q "section id=$id>" all/index.html || wrong "no section $id"
done
[ "$(grep -c 'data:image/svg+xml;base64,' all/index.html)" -ge 5 ] || wrong "fewer than 5 plots"
[ "$(grep -c 'data:image/png;base64,' all/index.html)" -ge 5 ] || wrong "fewer than 5 pictures"
! grep -q 'nan\b' all/*.section || wrong "a number that is none"

begin study_page_says_what_was_varied_and_what_follows
for id in depth stability memory time; do
    grep -q '<p>Varied' all/$id.section || wrong "$id does not say what was varied"
    grep -q 'orst case' all/$id.section || wrong "$id shows no worst case"
done
# how many runs, what was varied, and two of what follows; time: below, where it is counted
for id in depth stability; do
    [ "$(grep -c '^<p>' all/$id.section)" -ge 4 ] || wrong "$id says less than two sentences of what follows"
done

begin study_page_says_what_was_not_run
study 0 stability --quick --out one
grep -q 'Not run yet: zsim study depth' one/index.html || wrong "it does not"

# ---- Shards, resuming ------------------------------------------------------------------------------------------------
begin study_shards_merge_to_one_run
for i in 1 2 3; do
    study 0 depth --quick --out shards --shard $i/3
done
[ ! -e shards/index.html ] || wrong "a shard makes a page"
study 0 merge shards/depth.3-of-3.csv shards/depth.1-of-3.csv shards/depth.2-of-3.csv --out merged
same_bytes merged/depth.csv all/depth.csv
[ -s merged/index.html ] || wrong "no page"
for which in stability memory time; do
    study 0 $which --quick --out shards --shard 1/2
    study 0 $which --quick --out shards --shard 2/2
    study 0 merge shards/$which.2-of-2.csv shards/$which.1-of-2.csv --out merged
    same_bytes merged/$which.csv all/$which.csv
done
note="all four"

begin study_goes_on_after_a_kill
mkdir -p killed
"$zsim" study depth --quick --out killed >/dev/null 2>&1 &
pid=$!
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    sleep 0.05
    [ "$(cat killed/depth.csv.part 2>/dev/null | wc -l)" -lt 4 ] || break
done
kill -9 $pid 2>/dev/null
wait $pid 2>/dev/null
[ ! -e killed/depth.csv ] || wrong "it was too quick to be killed"
note="after $(wc -l <killed/depth.csv.part) lines"
printf 'depth,half a ro' >>killed/depth.csv.part
study 0 depth --quick --out killed
same_bytes killed/depth.csv all/depth.csv
[ ! -e killed/depth.csv.part ] || wrong "the part is left"

begin study_keeps_rows
mkdir -p kept
head -5 all/depth.csv | sed '2s/,[^,]*,,,$/,9.999,,,/' >kept/depth.csv.part # a result that no run would give
study 0 depth --quick --out kept
grep -q ',9.999,,,$' kept/depth.csv || wrong "a row that was there was measured again"
is "runs" "$(runs kept/depth.csv)" "$(runs all/depth.csv)"
study 0 depth --quick --out kept --redo
grep -q ',9.999,,,$' kept/depth.csv || wrong "--redo measures again what is its own"

begin study_shard_goes_on
mkdir -p again
head -4 shards/depth.2-of-3.csv >again/depth.2-of-3.csv.part
study 0 depth --quick --out again --shard 2/3
same_bytes again/depth.2-of-3.csv shards/depth.2-of-3.csv

mkdir -p other effort param columns
sed '2,$s/^\([a-z]*\),[0-9a-f]*,/\1,00000000,/' all/stability.csv >other/stability.csv
cp other/stability.csv other/before
refuses rows_of_another_build 1 'another build' stability --quick --out other
same_bytes other/stability.csv other/before
cp all/stability.csv effort/stability.csv
refuses rows_of_another_effort 1 'another effort' stability --out effort
sed '3s/,scale,-8,/,scale,-9,/' all/stability.csv >param/stability.csv.part
refuses rows_of_other_parameters 1 'parameters' stability --quick --out param
sed '1s/value/values/' all/stability.csv >columns/stability.csv
refuses other_columns 1 'columns' stability --quick --out columns
# Results that no run gives, in what is whole and in what is in the making; --redo starts over
mkdir -p damaged torn
for cell in 1x9 nan inf - '1 2'; do
    sed "4s/^\(.*,\)[^,]*,\([^,]*,[^,]*,[^,]*,[^,]*\)$/\1$cell,\2/" all/depth.csv >damaged/depth.csv
    cp damaged/depth.csv damaged/before
    refuses "damaged_result_$cell" 1 'its row of run 2 has no result in column' depth --quick --out damaged
    same_bytes damaged/depth.csv damaged/before
done
sed '3s/,\([0-9a-f]\{16\}\),/,x\1,/' all/memory.csv >damaged/memory.csv.part
refuses damaged_checksum 1 'its row of run 1 has no result in column checksum' memory --quick --out damaged
sed '3s/,OK,/,ok,/' all/stability.csv >damaged/stability.csv
refuses damaged_status 1 'its row of run 1 has no result in column status' stability --quick --out damaged
sed '5s/,$//' all/depth.csv >torn/depth.csv
refuses fewer_cells 1 'its row of run 3 has no result in column' depth --quick --out torn
sed '5s/$/,/' all/depth.csv >torn/depth.csv
refuses more_cells 1 'its row of run 3 has no result in column key' depth --quick --out torn
refuses merge_of_a_damaged_row 1 'damaged/before:4: run 2 has no result in column' merge damaged/before --out m
begin study_redo_of_damage
study 0 depth --quick --out damaged --redo
same_bytes damaged/depth.csv all/depth.csv

# What is not a regular file is not read, which might not end
mkdir -p special
ln -s /dev/full special/depth.csv
ln -s /dev/full special/stability.csv.part
mkfifo special/memory.csv
for one in depth:depth.csv stability:stability.csv.part memory:memory.csv; do
    refuses "link_to_no_file_${one%%:*}" 1 "special/${one#*:}: is not a regular file" "${one%%:*}" --quick --redo \
        --out special
done
begin study_redo
study 0 stability --quick --out other --redo
same_bytes other/stability.csv all/stability.csv

# ---- What is refused -------------------------------------------------------------------------------------------------
refuses no_name 2 'time, depth, memory, stability' --quick
refuses unknown_name 2 "'speed'" speed
refuses two_names 2 "'time'" depth time
refuses shard_beyond 2 "'4/3'" depth --shard 4/3
refuses shard_none 2 "'0/3'" depth --shard 0/3
refuses shard_words 2 "'1of3'" depth --shard 1of3
refuses quick_and_full 2 'not both' depth --quick --full
refuses counts_of_depth 2 'no --counts' depth --counts m3=x
refuses settings_of_depth 2 'no board' depth --settings
refuses counts_without_file 1 'nowhere.csv' time --quick --counts m3=nowhere.csv
refuses run_beyond 2 '--run' time --quick --run 99999
refuses merge_of_nothing 2 'merge' merge
refuses merge_of_two_shards 1 'is in none of the files' merge shards/depth.3-of-3.csv shards/depth.2-of-3.csv --out m
refuses merge_of_two_studies 1 'same study' merge shards/depth.3-of-3.csv all/stability.csv --out m
refuses merge_of_another_build 1 'another build' merge other/before --out m
sed '2s/,0.03[0-9]*,/,0.04,/' shards/depth.1-of-3.csv >differs.csv
refuses merge_of_rows_that_differ 1 'another row' merge shards/depth.1-of-3.csv differs.csv --out m
printf 'not a table\n' >text.txt
refuses merge_of_a_text 1 'no rows' merge text.txt --out m
printf 'a\nb,c\n' >text.txt
refuses merge_of_another_table 1 'no row of a study' merge text.txt --out m
echo x >file
refuses folder_that_is_a_file 1 'file' stability --quick --out file
begin study_merge_leaves_nothing_half
[ ! -e m/depth.csv ] && [ ! -e m/index.html ] || wrong "files in m/"

begin study_without_gnuplot
PATH=/nowhere "$zsim" study stability --quick --out plain >stdout 2>stderr
status=$?
[ $status -eq 1 ] || wrong "status $status"
is "lines on standard error" "$(wc -l <stderr | tr -d ' ')" 1
grep -q 'gnuplot is not installed (package gnuplot-nox)' stderr || wrong "$(said)"
same_bytes plain/stability.csv all/stability.csv
grep -q 'id=stability' plain/index.html || wrong "no page"

# ---- What was measured -----------------------------------------------------------------------------------------------
begin study_separation_is_the_formula
# recip and linear by formulas of this script's own; all of them within 5 %
finds_nothing '
    $5 != "separation" { next }
    $6 == "recip" { w = $10 * $10 * ($9 - $8) / ($9 * $8 * (2 ^ $7 - 1)) }
    $6 == "linear" { w = ($9 - $8) / (2 ^ $7 - 1) }
    $6 ~ /^e/ { e = substr($6, 2, 1); k = int(log($10 / $8) / log(2) + 1e-9); top = 2 ^ e - 2; if (k > top) k = top
                w = $10 * $10 / $8 * 2 ^ -(k + 1 + $7 - e) }
    $6 == "float" { next }
    { if ($13 < w * 0.999 || $13 > w * 1.001) print $6, $7, $10, "formula", w, $13 }
    w < 0.02 * $10 { n++; if ($12 < 0.97 * w || $12 > 1.05 * w) print $6, $7, $10, "measured", $12, w }
    END { if (n < 10) print n + 0, "rows compared" }' all/depth.csv

begin study_separation_at_0.8_of_far # far at 10 times near, keys of 16 bits, percent: as in NUMERICS.md
for one in 675:recip:0.0109:0.0111 702:linear:0.0017:0.0018 729:e3m13:0.0119:0.0123; do
    echo "$one" | tr : ' ' >far.txt
    read -r shard mapping least most <far.txt
    study 0 depth --out far --shard "$shard/100000"
    finds_nothing "NR == 2 { n++
        if (\$5 != \"separation\" || \$6 != \"$mapping\" || \$7 != 16 || \$9 != 10 || \$10 != 7.9) print \"row\", \$0
        if (!(100 * \$12 / \$10 > $least && 100 * \$12 / \$10 < $most)) print \$6, 100 * \$12 / \$10 }
        END { if (!n) print \"no row\" }" "far/depth.$shard-of-100000.csv"
done

begin study_keys_are_the_formula
finds_nothing '
    $5 != "curve" { next }
    { n++ }
    $6 == "recip" { key = 65535 * (1 / $8 - 1 / $10) / (1 / $8 - 1 / $9) }
    $6 == "linear" { key = 65535 * ($10 - $8) / ($9 - $8) }
    ($6 == "recip" || $6 == "linear") && ($17 - key > 3 || key - $17 > 3) { print $6, $10, $17, key }
    END { if (n < 12) print n + 0, "rows" }' all/depth.csv

begin study_cures_help
finds_nothing '$5 == "cure" { wrong[$11] = $15; all = $16 }
    END { if (wrong["as it is"] < all / 10) print "nothing to cure"
          if (wrong["near plane at 40"] * 10 > wrong["as it is"]) print "near plane: " wrong["near plane at 40"]
          if (wrong["16 bits"] * 10 > wrong["as it is"]) print "bits: " wrong["16 bits"]
          if (wrong["default mapping and 16 bits"] + wrong["offset of 2 buckets"] > 0) print "default, offset" }' \
        all/depth.csv

begin study_ranges_end_by_name
finds_nothing '
    $7 != "OK" { refused[$5] = $7; next }
    $5 != "rotation" && $5 != "wander" && ($11 != 0 || $12 > 0.505) { print $5, $6, "not explained:", $11, $12 }
    ($5 == "rotation" || $5 == "wander") && !($15 < 1) { print $5, $6, $15 }
    { ok[$5]++ }
    END { if (refused["scale"] != "ZS_ERR_RANGE" || refused["near"] != "ZS_ERR_NEAR" ||
              refused["distance"] != "ZS_ERR_CAMERA")
              print refused["scale"], refused["near"], refused["distance"]
          for (p in ok) n++
          if (n != 7) print n, "parts" }' all/stability.csv

begin study_memory_changes_no_pixel
finds_nothing 'NR > 1 { sum[$5] = sum[$5] ? sum[$5] : $23; if ($23 != sum[$5]) print "row", NR, $23
    if ($14 != $15 + $16 + $17 + $18) print "row", NR, "arena", $14
    if ($9 == 100 && $12 == 1 && $19 != 1) print "row", NR, $19, "passes"; many += $19 > 1 }
    END { if (!many) print "no run of more than one pass" }' all/memory.csv

begin study_variants_are_for_studies_alone
variant() { # FLAG...
    gcc -std=c11 -fsyntax-only -I"$top/firmware/zstrip" "$@" "$top/firmware/zstrip/shade/texture.c" 2>log
}
for flag in -DZS_RECIP_STEPS=0 -DZS_TEXEL_COARSE_LOG2=31 -DZS_SPAN_BOUND_LOG2=3; do
    ! variant $flag || wrong "$flag builds"
    variant $flag -DZS_STUDY=1 || wrong "$flag does not build with ZS_STUDY"
done
variant || wrong "the default does not build"

# ---- Counted on the M3 -----------------------------------------------------------------------------------------------
begin study_time_counted
cores=m3
if command -v valgrind >/dev/null; then
    cores='m3 host'
else
    echo 'SKIPPED study_time_counted on the host: valgrind is not installed'
fi
(cd "$top" && ZSIM=$zsim OUT=$work/counted CORES=$cores sh sim/study/study.sh "$build" time --quick) >stdout 2>stderr
status=$?
last=" sim/study/study.sh BUILD time --quick"
[ $status -eq 0 ] || wrong "status $status: $(said)"
finds_nothing 'NR > 1 && !($27 > 500000 && $27 < ($13 == "raycast" ? 200000000 : 20000000)) { print "row", NR, $27 }
    END { if (NR < 27) print NR, "rows" }' counted/time.csv
grep -q 'The default (float 16, S 8) is one of them' counted/time.section ||
    wrong "the page does not say where the default is"
[ "$cores" = m3 ] || finds_nothing '
    NR > 1 && $7 == 8 && $9 == 16 && !($30 > 500000 && $30 < 200000000) { print "row", NR, $30 }
    NR > 1 && !($7 == 8 && $9 == 16) && $30 != "" { print "row", NR, "is not counted on the host:", $30 }' \
        counted/time.csv
# The folder is given by its whole name here, and as build by others: both are to know an object by one name, or what
# depends on a header that changes is not made anew.
grep -l '^/' "$build"/fw/mps2/firmware/zstrip/core/*.d >whole &&
    wrong "$(head -n 1 whole): whole paths; remove build/fw"
[ -e "$build/fw/mps2/firmware/zstrip/core/raster.d" ] || wrong "no raster.d"
note="on $cores"
begin study_time_methods # the painter is wrong where surfaces cross; no other has more wrong pixels than the buffer
finds_nothing 'NR == 1 || $5 != "corridor" || $7 != 8 || $8 == "recip" { next }
    { wrong[$13] = $16 + $17; time[$13] = $27; depth[$13] = $19 }
    END {
        if (!(wrong["painter"] > 1)) print "painter", wrong["painter"]
        for (m in wrong) if (m != "painter" && !(wrong[m] <= wrong["zbuffer"])) print m, wrong[m]
        if (!(time["painter"] < time["zbuffer"] && time["zbuffer"] < time["hiz"] && time["hiz"] < time["raycast"]))
            print "times", time["painter"], time["zbuffer"], time["hiz"], time["raycast"]
        if (depth["painter"] != "" || depth["depthsort"] != "" || !(depth["hiz"] > 0)) print "errors of depth"
        for (m in wrong) n++
        if (n != 6) print n, "methods"
    }' counted/time.csv
begin study_default_is_on_the_front
grep -qx 'default: on the front' stdout || wrong "$(head -1 stdout)"
begin study_refuses_counts_of_another_frame
sed '1s/,\([0-9a-f]*\),/,0123456789abcdef,/' counted/counts/time-m3.csv >other.csv
z study time --quick --out other_counts --counts m3=other.csv
one_line 1 'is not this zsim'

finish
[ $n_failed -eq 0 ]
