#!/bin/sh
# How large the renderer's files are: lines of code, without comments and blank ones; the longest file, function and
# line. Where a goal is not met yet, the limit is what there is, and what is above the goal is named.
# Usage: tests/checks/shape.sh BUILD          from the repository's top
#        tests/checks/shape.sh BUILD columns  the lines that are too long, besides
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

CORE_MAX=${CORE_MAX:-4197}         # lines of code in core/ and the public headers; the goal is 4200
ALL_MAX=${ALL_MAX:-12694}           # ... in all of firmware/zstrip; the goal is 7000
EFFECTS_MAX=${EFFECTS_MAX:-4986}   # ... in effect/ and its public headers
OVERLAYS_MAX=${OVERLAYS_MAX:-1385} # ... in overlay/ and its public headers
EXPLAIN_MAX=${EXPLAIN_MAX:-2043}   # ... in support/explain* and zs_explain.h
METHODS_MAX=${METHODS_MAX:-2200}   # ... in method/ and its public headers
DEPTHSORT_MAX=${DEPTHSORT_MAX:-749} # ... of depth sort; the goal is 600
SHADE_MAX=${SHADE_MAX:-1500}       # ... in shade/
FILE_MAX=${FILE_MAX:-450}     # lines of a file
FUNCTION_MAX=${FUNCTION_MAX:-60}   # lines of code of a function, from { to }
COLUMNS_MAX=${COLUMNS_MAX:-100}    # columns of a line in firmware/zstrip
COLUMNS_MANY=${COLUMNS_MANY:-0}    # ... and lines that have more
ELSE_MAX=${ELSE_MAX:-126}          # columns of a line of what else is written here; the goal is 120
ELSE_MANY=${ELSE_MANY:-0}

# "FILE lines code" of each file; of each function "function FILE:LINE NAME code"
lines() {
    for f in "$@"; do
        awk -v f="${f#firmware/zstrip/}" '
            {
                s = $0; code = ""
                while (s != "") { # what of the line is no comment
                    if (inside) { i = index(s, "*/"); if (!i) break; s = substr(s, i + 2); inside = 0; continue }
                    if (match(s, /"([^"\\]|\\.)*"|\/\*|\/\//)) {
                        t = substr(s, RSTART, RLENGTH); code = code substr(s, 1, RSTART - 1)
                        s = substr(s, RSTART + RLENGTH)
                        if (t == "//") break
                        if (t == "/*") inside = 1; else code = code t
                    } else { code = code s; break }
                }
                if (code !~ /[^ \t]/) next
                n++
                if (code ~ /^\{/) { from = n; at = FNR; name = before }
                if (code ~ /^\}/ && from) { print "function", f ":" at, name, n - from + 1; from = 0 }
                if (match(code, /[a-z_0-9]+\(/) && code ~ /^[a-zA-Z]/) before = substr(code, RSTART, RLENGTH - 1)
            }
            END { print f, FNR, n + 0 }' "$f"
    done
}
lines firmware/zstrip/*.h firmware/zstrip/*/*.[ch] >"$B/shape.txt"

within() { # WHAT FIGURE LIMIT [GOAL]
    if [ "$2" -le "$3" ]; then ok "$1: $2 of $3${4:+, goal $4}"; else bad "$1 within $3" "$2"; fi
}
code() { # PATTERN of files [PATTERN of those to leave out]: their lines of code
    awk -v p="$1" -v but="${2:-^$}" 'NF == 3 && $1 ~ p && $1 !~ but { n += $3 } END { print n + 0 }' "$B/shape.txt"
}
awk 'NF == 3 { split($1, p, "/"); d = index($1, "/") ? p[1] "/" : "public headers"; files[d]++
        code[d] += $3; lines[d] += $2 }
    END { for (d in files) printf "  %-16s %3d files %6d lines %6d of code\n", d, files[d], lines[d], code[d] }' \
        "$B/shape.txt" | sort
# Methods, primitives, effects, overlays and explanations have limits of their own
effects='^effect/|^zs_(lights|filter|blend|environment|shadow|supersample)\.h'
overlays='^overlay/|^zs_(overlay|fog|dither)\.h'
primitives='^method/(lines|points|quad|mesh_edges|plain)\.|^zs_lines.h'
methods="^method/|^zs_method.h|$primitives"
explain='^support/explain|^zs_explain\.h'
later="$methods|$effects|$overlays|$explain"
within "core/ and public headers, lines of code" "$(code '^core/|^[^/]*$' "$later")" "$CORE_MAX" 4200
# Object files of a build without folders would overwrite each other.
none "files of firmware/zstrip have names of their own" \
    "$(find firmware/zstrip -name '*.c' -exec basename {} \; | sort | uniq -d)"
within "firmware/zstrip without those, lines of code" "$(code . "$later")" "$ALL_MAX" 7000
within "methods, lines of code" "$(code "$methods" "$primitives")" "$METHODS_MAX"
within "effects, lines of code" "$(code "$effects")" "$EFFECTS_MAX"
within "overlays, lines of code" "$(code "$overlays")" "$OVERLAYS_MAX"
within "explanations, lines of code" "$(code "$explain")" "$EXPLAIN_MAX"
within "primitives, lines of code" "$(code "$primitives")" 800
# The longest of them, with files that it shares with coverage, and sort.c, which four methods link
within "depth sort with all that it links of method/, lines of code" \
    "$(code '^method/(depthsort|newell|order|order_depth|pieces|sort)[.]c')" "$DEPTHSORT_MAX" 600
for f in firmware/zstrip/method/*.c; do
    within "method/${f##*/}, lines of code" "$(code "^method/${f##*/}")" 600
done
within "shade/, lines of code" "$(code ^shade/)" "$SHADE_MAX"

longest() { # WHAT LIMIT GOAL: of lines "FIGURE NAME"; those that are above the goal
    sort -rn >"$B/longest.txt"
    awk -v goal="$3" '$1 > goal { print "  above the goal of " goal ": " $2, $1 }' "$B/longest.txt"
    within "$1 ($(awk 'NR == 1 { print $2 }' "$B/longest.txt"))" \
        "$(awk 'NR == 1 { print $1 } END { if (!NR) print 99999 }' "$B/longest.txt")" "$2" "$3"
}
awk 'NF == 3 { print $2, $1 }' "$B/shape.txt" | longest "longest file, lines" "$FILE_MAX" 450
awk '$1 == "function" { print $4, $2 ":" $3 }' "$B/shape.txt" |
    longest "longest function, lines of code" "$FUNCTION_MAX" 60
functions=$(grep -c ^function "$B/shape.txt")
if [ "$functions" -ge 300 ]; then ok "functions are found: $functions"; else bad "functions are found" "$functions"; fi

columns() { # WHAT GOAL MOST MANY FILES...
    what=$1 goal=$2 most=$3 many=$4
    shift 4
    LC_ALL=C.UTF-8 grep -nE "^.{$((goal + 1)),}" "$@" /dev/null >"$B/columns.txt"
    [ -z "$show" ] || sed -E 's/^([^:]*:[0-9]+):.*/  \1/' "$B/columns.txt"
    within "longest line $what, columns" "$(cat "$@" | LC_ALL=C.UTF-8 wc -L)" "$most" "$goal"
    within "lines $what of more than $goal columns, in $(cut -d: -f1 "$B/columns.txt" | sort -u | wc -l) files" \
        "$(wc -l <"$B/columns.txt")" "$many" 0
}
show=${2:-}
# Code, scripts and Makefiles. Not counted: prose (*.md), markup (*.html) and style (*.css).
columns "of firmware/zstrip" 100 "$COLUMNS_MAX" "$COLUMNS_MANY" firmware/zstrip/*.h firmware/zstrip/*/*.[ch]
# shellcheck disable=SC2046
columns elsewhere 120 "$ELSE_MAX" "$ELSE_MANY" $(find firmware hal sim tests Makefile -name '*.[chS]' -o -name '*.sh' \
    -o -name '*.mjs' -o -name '*.js' -o -name '*.mk' -o -name '*.ld' -o -name Makefile |
    grep -v '^firmware/zstrip/' | sort)
exit $failed
