# What tests of zsim from outside share: $1 is zsim, $2 a folder to work in,
# which is emptied and entered. Sourced from the repository's top.
#
# `ok NAME`, `FAILED NAME: reason` or `SKIPPED NAME: reason` a test. A reason holds the command that failed; the models
# it names stay in the folder.
set -u
zsim=$1
work=$2
case $zsim in /*) ;; *) zsim=$PWD/$zsim ;; esac
top=$PWD
rm -rf "$work"
mkdir -p "$work"
work=$(cd "$work" && pwd) || exit 1
# Started hundreds of times, in half the time without shared libraries
gcc -O2 -Wall -Wextra -Werror -c tests/tools/look.c -o "$work/look.o" || exit 1
gcc -static "$work/look.o" -lpng -lz -lm -o "$work/look" 2>/dev/null ||
    gcc "$work/look.o" -lpng -o "$work/look" || exit 1
rm "$work/look.o"
LSAN_OPTIONS=suppressions=$top/tests/lib/lsan.txt:print_suppressions=0
ASAN_OPTIONS=detect_leaks=1:handle_sigill=2:exitcode=99:quarantine_size_mb=16
export LSAN_OPTIONS ASAN_OPTIONS
cd "$work" || exit 1

# SEED BOXES TRIANGLES: an OBJ of boxes that reach through one another, and of long thin triangles
boxes() {
    awk -v seed="$1" -v boxes="$2" -v triangles="$3" 'BEGIN { srand(seed); n = 0
        split("0 1 3 2 4 6 7 5 0 4 5 1 2 3 7 6 0 2 6 4 1 5 7 3", q, " ")
        for (b = 0; b < boxes; b++) {
            for (k = 0; k < 3; k++) { c[k] = rand() * 4 - 2; d[k] = rand() * 1.2 + 0.1 }
            for (v = 0; v < 8; v++)
                printf "v %.5f %.5f %.5f\n", c[0] + d[0] * (int(v / 4) * 2 - 1),
                    c[1] + d[1] * (int(v / 2) % 2 * 2 - 1), c[2] + d[2] * (v % 2 * 2 - 1)
            for (f = 0; f < 6; f++)
                print "f", n + q[4 * f + 1] + 1, n + q[4 * f + 2] + 1, n + q[4 * f + 3] + 1, n + q[4 * f + 4] + 1
            n += 8 }
        for (t = 0; t < triangles; t++) {
            for (v = 0; v < 3; v++) printf "v %.5f %.5f %.5f\n", rand() * 8 - 4, rand() * 8 - 4, rand() * 8 - 4
            print "f", n + 1, n + 2, n + 3; n += 3 } }'
}

# ---- What a test is made of --------------------------------------------------------------------
n_failed=0
name=none
bad=''
note=''
skip=''
begin() { # NAME    ends the test before it; $note, if set by then, is shown beside its verdict
    finish
    name=$1
    bad=''
    note=''
    skip=''
}
skipped() { # REASON    the test could not be made here
    skip=$1
}
finish() {
    if [ "$name" != none ]; then
        if [ -z "$bad" ] && [ -n "$skip" ]; then
            echo "SKIPPED $name: $skip"
        elif [ -z "$bad" ]; then
            echo "ok $name${note:+ ($note)}"
        else
            echo "FAILED $name: $bad"
            n_failed=$((n_failed + 1))
        fi
    fi
    name=none
}
wrong() { # REASON    the first one counts
    [ -n "$bad" ] || bad="$(printf '%s' "$1" | tr '\n' ' ') [cd $work;$last]"
}
last=''
said() { # the first lines of standard error
    head -c 400 stderr | tr '\n' '|'
}
z() { # ARGUMENT...    zsim, its exit status in $status
    last=' zsim'
    for arg in "$@"; do
        case $arg in
        *[!A-Za-z0-9_./,=:-]* | '') last="$last '$arg'" ;;
        *) last="$last $arg" ;;
        esac
    done
    "$zsim" "$@" >stdout 2>stderr </dev/null
    status=$?
}
is() { # WHAT HAVE WANT
    [ "$2" = "$3" ] || wrong "$1 is '$2' instead of '$3'"
}
look() { # COMMAND...    its words in $seen; a file that is not as it should be fails the test
    if ! seen=$("$work/look" "$@"); then
        wrong "look $*: $seen"
        seen='-1 -1 -1 -1 -1 -1 -1'
    fi
}
word() { # N WORD...
    n=$1
    shift "$n"
    echo "$1"
}
# The four files out/NAME.png pgm u32 json of one render. Nothing may be said.
draw() { # NAME MODEL OPTION...
    as=$1
    shift
    for f in "out/$as".*; do
        [ ! -e "$f" ] || : >"$f" # emptied
    done
    z render "$@" --out "out/$as.png" --depth-out "out/$as.pgm" --id-out "out/$as.u32" \
        --stats "out/$as.json"
    [ $status -eq 0 ] || wrong "status $status: $(said)"
    [ ! -s stdout ] && [ ! -s stderr ] || wrong "it talks in a pipe: $(said)"
    for f in png pgm u32 json; do
        [ -s "out/$as.$f" ] || wrong "out/$as.$f is missing"
    done
}
# Do the pictures, depths and ids of two renders agree byte for byte?
same() { # A B
    look same "out/$1" "out/$2" png pgm u32
}
other() { # A B FILE-ENDING    must differ
    if cmp "out/$1.$3" "out/$2.$3" >/dev/null 2>&1; then
        wrong "out/$1.$3 and out/$2.$3 are the same: the option did nothing"
    fi
}
covered() { # NAME    in $(): pixels that a triangle covers, at 240x240
    exec "$work/look" covered "out/$1.u32" 240
}
stat_of() { # NAME KEY    in $()
    exec "$work/look" json "out/$1.json" "$2"
}
plain='--projection orthographic --eye 0,0,120 --at 0,0,0 --fov 90 --near 20 --far 420'

# What a refusal is asked about runs in the shell: a process takes as long to start as zsim to refuse.
# The only line of a file in $the_line; no line, more of them or half of one fails the test.
only_line() { # FILE
    lines=0 the_line=''
    while IFS= read -r next_line; do
        lines=$((lines + 1)) the_line=$next_line
    done <"$1"
    [ $lines -eq 1 ] && [ -z "$next_line" ] || wrong "$1 has $lines lines instead of 1, and then '$next_line'"
}
# Is the folder the old one: one older file, unchanged, and nothing else?
untouched() {
    for f in refused/* refused/.*; do
        case $f in refused/old.png | refused/. | refused/.. | 'refused/.*') ;; *) wrong "there is $f" ;; esac
    done
    only_line refused/old.png
    is "old.png" "$the_line" older
}
one_line() { # STATUS TEXT...    what the one line on standard error holds
    [ $status -eq "$1" ] || wrong "status $status instead of $1: $(said)"
    [ ! -s stdout ] || wrong "standard output is not empty: $(head -c 200 stdout)"
    only_line stderr
    shift
    for text; do
        case $the_line in *"$text"*) ;; *) wrong "'$text' is not in: $the_line" ;; esac
    done
}
refused() { # NAME WHAT-THE-LINE-HOLDS MODEL OPTION...
    begin "refused_$1"
    what=$2
    input=$3
    shift 3
    z render "$input" --out refused/old.png --depth-out refused/d.pgm --id-out refused/i.u32 \
        --stats refused/s.json "$@"
    one_line 1 "$input" "$what"
    case $name in refused_missing*) ;; *) [ -e "$input" ] || wrong "there is no $input to refuse" ;; esac
    untouched
}
usage() { # NAME WHAT-THE-LINE-HOLDS ARGUMENT...
    begin "usage_$1"
    what=$2
    shift 2
    z "$@"
    one_line 2 "$what"
    untouched
}
taken() { # NAME MODEL OPTION...    the frame is in out/NAME.*
    begin "taken_$1"
    draw "$@"
    look drawn "out/$1.u32" "out/$1.pgm"
}
obj() { # NAME LINE...
    to=$1.obj
    shift
    printf '%s\n' "$@" >"$to"
}

# What `plain` sees of an OBJ in the plane z = 0, by another way: at every STEPth pixel "X Y ID", where
# ID is the first fan triangle in file order that holds the pixel's centre, nearest edges left out.
# CULL: back, or none.
oracle() { # FILE.obj CULL STEP
    awk -v cull="$2" -v step="$3" '
    function add(a, b, c,  area) {
        n++
        area = (vx[b] - vx[a]) * (vy[c] - vy[a]) - (vx[c] - vx[a]) * (vy[b] - vy[a])
        if (area == 0 || (area < 0 && cull == "back")) return
        k++; id[k] = n; s[k] = area > 0 ? 1 : -1
        ax[k] = vx[a]; ay[k] = vy[a]; bx[k] = vx[b]; by[k] = vy[b]; cx[k] = vx[c]; cy[k] = vy[c]
    }
    function edge(px, py, x0, y0, x1, y1) {
        return ((x1 - x0) * (py - y0) - (y1 - y0) * (px - x0)) / \
            (sqrt((x1 - x0) ^ 2 + (y1 - y0) ^ 2) + 1e-30)
    }
    { sub(/\r$/, "") }
    $1 == "v" { vx[++nv] = $2 + 0; vy[nv] = $3 + 0 }
    $1 == "f" {
        for (i = 2; i <= NF; i++) { v = $i; sub(/\/.*/, "", v); v += 0; w[i - 1] = v < 0 ? nv + 1 + v : v }
        for (i = 2; i < NF - 1; i++) add(w[1], w[i], w[i + 1])
    }
    END {
        for (y = 0; y < 240; y += step) for (x = 0; x < 240; x += step) {
            px = x + 0.5 - 120; py = 120 - y - 0.5; hit = 0; near = 1
            for (i = 1; i <= k && !hit; i++) {
                e = s[i] * edge(px, py, ax[i], ay[i], bx[i], by[i])
                f = s[i] * edge(px, py, bx[i], by[i], cx[i], cy[i])
                g = s[i] * edge(px, py, cx[i], cy[i], ax[i], ay[i])
                m = e < f ? e : f; m = m < g ? m : g
                if (m > -0.02 && m < 0.02) { near = 0; break }
                if (m > 0) hit = id[i]
            }
            if (near) print x, y, hit
        }
    }' "$1"
}
by_oracle() { # NAME FILE.obj CULL STEP LEAST    ids of out/NAME.u32; at least LEAST pixels are compared
    oracle "$2" "$3" "$4" >points
    seen=$("$work/look" points "out/$1.u32" 240 <points) || wrong "$seen"
    case $seen in *[!0-9]*) ;; *) [ "$seen" -ge "$5" ] || wrong "only $seen pixels compared" ;; esac
}

mkdir out refused
echo older >refused/old.png
obj quad 'v -50 -50 0' 'v 50 -50 0' 'v 50 50 0' 'v -50 50 0' 'f 1 2 3 4'
