#!/bin/sh
# Every scene's frames on every core and compiler here: one table of their checksums, which must all be the same, and
# those on record (tests/records/scenes.txt). A frame that differs is drawn again, and its first differing pixel named.
# The program is firmware/app/checksums.c; its head says what is summed up. Strip heights and pools are a column's own.
# Usage: tests/property/scene_sums.sh BUILD           from the repository's top; needs BUILD/gen
#        tests/property/scene_sums.sh BUILD record    the same frames as lines for records/scenes.txt, from gcc -O0
#        tests/property/scene_sums.sh BUILD column C  one column's lines into BUILD/scene_sums/C.txt
# SUMS_PIECES=1: the showpieces in place of the scenes, on fewer machines; their record is tests/records/pieces.txt
# SUMS_PICO=1: the Cortex-M0+ is that of the emulated Pico, with its divider, and takes minutes. Without, as in make
# test, its code runs on QEMU's M3; tests/boards/pico.sh looks at the emulated Pico's own pictures, of the demo scenes.
#
# SPDX-License-Identifier: MIT
set -u
build=$1
out=$build/scene_sums
record=tests/records/scenes.txt
COLUMNS='gcc_O0 clang_O3 cortex_m0 cortex_m0plus cortex_m3 cortex_m4 cortex_m7 rv32
         ppc bare_m0 bare_m3' # ppc: PowerPC, big-endian; bare: no accelerators, -Os
[ -z "${SUMS_PICO:-}" ] || COLUMNS="$COLUMNS gcc_O3 clang_O0 bare_x86" # make test has these in checksums.sh and bare.sh
SOURCES=firmware/app/checksums.c
if [ -n "${SUMS_PIECES:-}" ]; then
    out=$build/piece_sums
    record=tests/records/pieces.txt
    COLUMNS='gcc_O0 clang_O3 cortex_m0plus cortex_m3 ppc'
    SOURCES="$SOURCES $(echo firmware/scenes/pieces/*.c)"
fi
SCENES=$(grep -oE '&demo_[a-z_]+' firmware/scenes/demos.c | sed 's/&demo_//')
. tests/boards/image.sh
. tests/lib/checksum_core.sh

# ---- One column ------------------------------------------------------------------------------------------------

# Where a column is drawn: its board, what make is told besides, what memory the program takes
column_is() { # COLUMN
    with= cpu= emulator=
    case $1 in
    gcc_* | clang_*)
        # clang's -Wconversion asks for more than gcc's
        board=host memory=
        with="BOARD_CC=${1%_*} OPT=-${1#*_} OUT=$build/fw/host_$1 BOARD_FLAGS=-Wno-sign-conversion DEBUG="
        with="$with $(checksum_core "$build" "${1%_*}-${1#*_}")" ;;
    ppc) # a program for Linux
        board=host memory= emulator=qemu-ppc-static
        with="BOARD_CC=powerpc-linux-gnu-gcc BOARD_LINK=-static OUT=$build/fw/host_$1 DEBUG="
        with="$with $(checksum_core "$build" powerpc-O2)" ;;
    bare_x86) board=host memory= with="LEAN=1 OUT=$build/fw/host_$1 DEBUG=" ;;
    bare_m0) board=m0 memory='-DSUMS_ROWS=5 -DSUMS_ARENA=10688' with=LEAN=1 ;;
    bare_m3) board=mps2 memory=-DSUMS_ROWS=9 with=LEAN=1 ;;
    cortex_m0) # 16 KB of RAM; its flash takes a few scenes at a time, and the largest with the smaller code alone
        board=m0 memory='-DSUMS_ROWS=4 -DSUMS_ARENA=10688'
        with="OPT=-Os OUT=$build/fw/m0_small DEBUG=" ;;
    cortex_m0plus) # the Pico's code, with the library's division, on the machine of the M3
        board=mps2 memory='-DSUMS_ROWS=16 -DSUMS_ARENA=160000'
        cpu='-mcpu=cortex-m0plus -mthumb' with="OPT=-O3 OUT=$build/fw/mps2-m0plus"
        [ -z "${SUMS_PICO:-}" ] || board=pico cpu= with= ;;
    cortex_m3) board=mps2 memory=-DSUMS_ROWS=8 ;;
    cortex_m4) board=mps2-m4 memory=-DSUMS_ROWS=17 ;;
    cortex_m7) board=mps2-m7 memory=-DSUMS_ROWS=240 ;;
    rv32) board=rv32 memory=-DSUMS_ROWS=60 ;;
    esac
}

# Lines of scenes that fit the Cortex-M0's flash together, those that share meshes above all; others are by themselves.
TOGETHER='layers_btf layers_ftb layers_mixed cubes corridor slivers flyover knot city
teapot mesh mesh_lit relief
china globe
mesh_tex_smooth mesh_tex_lit
crowd_btf crowd_ftb'
groups() {
    echo "$TOGETHER"
    together=$(echo $TOGETHER)
    for scene in $SCENES; do
        case " $together " in *" $scene "*) ;; *) echo "$scene" ;; esac
    done
}

firmware() { # NAME FLAGS GOAL
    # shellcheck disable=SC2086
    timeout 600 make -s -f firmware/boards/firmware.mk BOARD=$board B="$build" ${cpu:+"BOARD_CPU=$cpu"} $with \
        NAME="${SUMS_PIECES:+piece_}$1" QEMU_ICOUNT= APP_SRC="$SOURCES" \
        APP_FLAGS="$memory ${SUMS_PIECES:+-DSUMS_PIECES=1} $2" "$3"
}

# Build the program under a name with these flags, run it, and write what it says. Instructions are not counted.
say() { # NAME FLAGS
    case $board in
    host) firmware "$1" "$2" all && $emulator "$build/fw/host_$column/${SUMS_PIECES:+piece_}$1.elf" ;;
    pico) firmware "$1" "$2" image >&2 && node "$build/pico/parts.mjs" "$build/fw/pico/$1" | grep -v '^wire' ;;
    *) firmware "$1" "$2" run 2>&1 ;; # semihosting writes to either
    esac
}

# All of a column: its checksums, or the pixels of the bands in FILE, lines of "scene frame bits y"
column() { # COLUMN [FILE]
    column=$1
    column_is "$1"
    kind=sums
    [ $# = 1 ] || kind=pixels
    bands() { # [SCENE]
        [ $kind = sums ] || awk -v scene="${1:-}" 'BEGIN { printf "-DSUMS_PIXELS=\"" }
            scene == "" || $1 == scene { printf "SUMS_BAND(%s,%s,%s,%s)", $1, $2, $3, $4 } END { print "\"" }' "$file"
    }
    file=${2:-}
    {
        if [ "$board" = m0 ]; then
            groups | while read -r scenes; do
                some=$(for scene in $scenes; do printf 'SUMS_ONE(%s)' "$scene"; done)
                [ $kind = pixels ] || say "sums_${scenes%% *}" "-DSUMS_SCENES=\"$some\"" </dev/null
                for scene in $scenes; do
                    [ $kind = sums ] || ! grep -q "^$scene " "$file" ||
                        say "pixels_$scene" "$(bands "$scene")" </dev/null
                done
            done
        elif [ "$board/$kind" = pico/sums ]; then # the slowest: two at a time
            firmware sums_0 '-DSUMS_PART=0 -DSUMS_PARTS=2u' all
            say sums_1 '-DSUMS_PART=1 -DSUMS_PARTS=2u' >"$out/$1.half" &
            say sums_0 '-DSUMS_PART=0 -DSUMS_PARTS=2u'
            wait $!
            cat "$out/$1.half"
        else
            say $kind "$(bands)"
        fi
    } >"$out/$1.$kind.log" 2>"$out/$1.$kind.err"
    grep -E '^[a-z_]+,[0-9]+,[48],' "$out/$1.$kind.log" >"$out/$1.$kind"
}

case ${2:-} in
column) column "$3"; exit ;;
record)
    column gcc_O0
    awk -F, '{ k = $1 " " $2 " " $3; if (!(k in last)) order[++n] = k; last[k] = $5 " " $6 }
        END { for (i = 1; i <= n; i++) print order[i], last[order[i]] }' "$out/gcc_O0.sums"
    exit ;;
esac

# ---- All of them -------------------------------------------------------------------------------------------------

# Prints the table; $out/differ gets "column reference scene frame bits y" for each frame that differs, y the first row
# of its first band that does, or - where the column has no such frame. The reference is the first column that agrees
# with what is on record; where none does, the first one.
table() {
    (cd "$out" && awk -v columns="$COLUMNS" -v differ=differ '
        function has(c, k) { return (c, k, rows[k]) in sum }
        function frame(name) { if (!(name in known)) { known[name] = 1; order[++frames] = name } }
        FILENAME == "record" { k = $1 " " $2 " " $3; frame(k); record[k] = $4 " " $5; next }
        {
            split($0, f, ","); k = f[1] " " f[2] " " f[3]; frame(k)
            c = FILENAME; sub(/\.sums$/, "", c)
            sum[c, k, f[4] + 0] = f[5] " " f[6]
            if (f[4] + 0 > rows[k]) rows[k] = f[4] + 0
        }
        END {
            n = split(columns, column, " ")
            printf "%-16s %5s %4s  %-16s  %-16s", "scene", "frame", "bits", "pixels", "depth keys"
            for (i = 1; i <= n; i++) {
                short = column[i]; sub(/^cortex_m/, "M", short); sub(/plus$/, "+", short); sub(/_O/, "", short)
                printf " %6s", short
            }
            print " record"
            printf "" >differ
            for (j = 1; j <= frames; j++) {
                k = order[j]; split(k, f, " "); ref = ""
                for (i = n; i >= 1; i--) if (has(column[i], k)) ref = column[i]
                for (i = n; i >= 1; i--)
                    if (has(column[i], k) && k in record && sum[column[i], k, rows[k]] == record[k]) ref = column[i]
                right = ref == "" ? "none none" : sum[ref, k, rows[k]]; split(right, s, " ")
                printf "%-16s %5s %4s  %16s  %16s", f[1], f[2], f[3], s[1], s[2]
                for (i = 1; i <= n; i++) {
                    c = column[i]; cell = "="
                    if (!has(c, k)) { cell = "none"; print c, ref, k, "-" >differ }
                    else if (sum[c, k, rows[k]] != right) {
                        for (y = 0; sum[c, k, y + 8] == sum[ref, k, y + 8] && y + 8 < rows[k]; y += 8) { }
                        cell = "y" y; print c, ref, k, y >differ
                    }
                    printf " %6s", cell
                }
                same = k in record && record[k] == right
                print same ? "      =" : k in record ? "      x" : "   none"
                if (!same) print "record", ref, k, "-" >differ
            } }' record $(for c in $COLUMNS; do echo "$c.sums"; done))
}

# The first pixels that differ, a line a frame of COLUMN: draws the bands again, here and on the reference.
explain() { # COLUMN
    awk -v c="$1" '$1 == c && $6 == "-" { if (!n++) first = $3 ", frame " $4 ", " $5 " sub-pixel bits" }
        END { if (n) print n " frames are missing, the first: " first }' "$out/differ"
    for ref in $(awk -v c="$1" '$1 == c && $6 != "-" { print $2 }' "$out/differ" | sort -u); do
        awk -v c="$1" -v r="$ref" '$1 == c && $2 == r && $6 != "-" { print $3, $4, $5, $6 }' "$out/differ" >"$out/bands"
        column "$1" "$out/bands"
        column "$ref" "$out/bands"
        awk -F, -v ref="$ref" '
            FNR == NR { here[$1, $2, $3, $4, $5] = $6 ", key " $7; next }
            {
                k = $1 ", frame " $2 ", " $3 " sub-pixel bits"; p = $6 ", key " $7
                if (!(k in said)) { order[++n] = k; said[k] = ": drawn again it does not differ" ; y[k] = $5 }
                h = here[$1, $2, $3, $4, $5]
                if (!(k in found) && h != p) {
                    found[k] = 1
                    said[k] = ": rows " y[k] " to " y[k] + 7 ", x " $4 ", y " $5 ": " (h == "" ? "nothing" : h) "; " \
                        ref " has " p
                }
            }
            END { for (i = 1; i <= n; i++) print order[i] said[order[i]] }' "$out/$1.pixels" "$out/$ref.pixels"
    done
}

rm -f "$out"/*.sums
first=
if [ -n "${SUMS_PICO:-}" ]; then
    sh tests/boards/pico.sh "$build" set-up || exit 1
    first=cortex_m0plus
    column $first
fi
for c in $(echo "$COLUMNS" | grep -ow cortex_m0) $COLUMNS; do echo "$c"; done |
    awk -v first="$first" '$0 != first && !n[$0]++' |
    xargs -P "$(nproc)" -n 1 sh tests/property/scene_sums.sh "$build" column
touch "$record" && cp "$record" "$out/record"
echo "Checksums (FNV-1a, 64 bits) of frames: x86-64 by gcc and clang, Cortex-M0 to M7, RISC-V, PowerPC."
echo "=: the same; y16: differs from row 16 on, in bands of eight rows; none: no such frame; record: $record"
table | tee "$out/table"
n=$(($(wc -l <"$out/table") - 1))
for name in $COLUMNS; do
    grep '^problem ' "$out/$name.sums.log" && bad "checksums_$name" "the emulator has seen a problem, see above"
    grep -q "^$name " "$out/differ" || { ok "checksums_$name ($n frames)"; continue; }
    explain "$name" >"$out/$name.why"
    sed "s/^/$name: /" "$out/$name.why"
    grep -q 'frames are missing' "$out/$name.why" &&
        cat "$out/$name.sums.log" "$out/$name.sums.err" | grep -vE ',[0-9a-f]{16}$' | tail -5
    bad "checksums_$name" "$(grep -c "^$name " "$out/differ") of $n frames differ; $(head -1 "$out/$name.why")"
done
differ=$(grep -c '^record ' "$out/differ")
renew="${SUMS_PIECES:+SUMS_PIECES=1 }sh $0 $build record >$record"
[ "$differ" = 0 ] && ok "checksums_on_record ($n frames)" ||
    bad checksums_on_record "$differ frames are not those of $record; where that is meant: $renew"
exit $failed
