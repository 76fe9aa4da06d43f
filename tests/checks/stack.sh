#!/bin/sh
# The worst case of the stack, from the compiler's own numbers: no recursion, no VLA, a bound for each
# public function on Cortex-M0+ and M3.
#
# Frames are those of -fcallgraph-info=su. Calls are the compiler's call graph and, so that calls which
# it adds later (division, counting zeros, block moves) are in too, the relocations of each function's
# section. Helpers of libgcc and newlib are measured on the linked image: every push and subtraction from
# sp in them, summed, and the deepest callee.
#
# Calls through pointers. The compiler gives the place of each; the source line there must read
# shader->FIELD(, depth->FIELD(, kernel->FIELD(, texel->FIELD(, watch->FIELD(, track->FIELD(, cluster->FIELD( or
# sink->FIELD(. All but the last may reach every function that stands in that FIELD of any zs_shader, zs_depth,
# zs_state_kernel, zs_texel, zs_watch_kernel, zs_track_kernel or zs_cluster_kernel table (from the tables' relocations);
# sink functions are the caller's: their stack, and interrupts', comes on top. Any other pointer call fails.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/common.sh"

LIMIT=${STACK_LIMIT:-2048} # bytes, any public function
PANEL_LIMIT=${PANEL_STACK_LIMIT:-288} # bytes, any function of panel.h

# Fields of a struct of function pointers in pipeline.h, in order: STRUCT
fields() {
    awk -v s="struct $1 {" -v lean="${lean:+1}" 'index($0, s) == 1 { on = 1 } on && /^};/ { exit }
        /^#if !ZS_LEAN/ { skip = lean } /^#if ZS_LEAN/ { skip = !lean } /^#endif/ { skip = 0 } skip { next }
        on && match($0, /\(\*[a-z_]+\)/) { print substr($0, RSTART + 2, RLENGTH - 3) }' \
        firmware/zstrip/core/pipeline.h
}

# One line a fact: frame FN BYTES KIND | call FN FN | pointer FN FILE:LINE | slot TABLE FIELD FN
facts() { # CPU DIR
    for o in "$2"/*.o; do
        unit=$(basename "$o" .o)
        # static functions are UNIT:NAME, as two units may have one of a name
        awk -v u="$unit" '
            function name(s) { n = split(s, p, ":"); return n > 1 ? u ":" p[n] : s }
            /^node:/ && / bytes \(/ {
                match($0, /title: "[^"]*"/); t = substr($0, RSTART + 8, RLENGTH - 9)
                match($0, /[0-9]+ bytes \([a-z,]*\)/); b = substr($0, RSTART, RLENGTH)
                split(b, q, " "); print "frame", name(t), q[1], q[3] }
            /^edge:/ {
                split($0, q, "\""); s = name(q[2]); d = q[4]
                if (d == "__indirect_call") { split(q[6], w, ":"); print "pointer", s, w[1] ":" w[2] }
                else print "call", s, name(d) }' "$2/$unit.ci"
        ${ARM}nm "$o" | awk '$2 == "t" { print "local", $3 }' >"$2/$unit.locals"
        ${ARM}objdump -r "$o" | awk -v u="$unit" '
            $1 == "local" { l[$2] = 1; next }
            function name(s) { sub(/[+-]0x.*/, "", s); return s in l ? u ":" s : s }
            /^RELOCATION RECORDS FOR/ { s = $4; gsub(/\[|\]|:/, "", s)
                fn = s ~ /^\.text\./ ? name(substr(s, 7)) : ""; table = s ~ /\.zs_(shade|depth|texel|state|fresh|watch|track|cluster)_/ ? s : "" }
            fn != "" && $2 ~ /^R_ARM_THM_(CALL|JUMP)/ && $3 !~ /^\./ { print "call", fn, name($3) }
            table != "" && $2 == "R_ARM_ABS32" { print "slot", table, $1, name($3) }' "$2/$unit.locals" - |
            while read -r kind table offset fn; do
                if [ "$kind" = slot ]; then
                    case $table in
                    *zs_shade_*) kind=shader struct=zs_shader ;;
                    *zs_texel_*) kind=texel struct=zs_texel ;;
                    *zs_state_* | *zs_fresh_*) kind=kernel struct=zs_state_kernel ;;
                    *zs_watch_*) kind=watch struct=zs_watch_kernel ;;
                    *zs_track_*) kind=track struct=zs_track_kernel ;;
                    *zs_cluster_*) kind=cluster struct=zs_cluster_kernel ;;
                    *) kind=depth struct=zs_depth ;;
                    esac
                    index=$((0x$offset / 4 + 1))
                    echo "slot $kind $(fields $struct | sed -n "${index}p") $fn"
                else
                    echo "$kind $table $offset"
                fi
            done
    done
}

# What the linked image takes of libraries: helper NAME BYTES, for every function outside zstrip.
helpers() { # ELF
    { ${ARM}nm "$1" | awk '$2 ~ /[tTwW]/ { print "at", $1, $3 }'
        ${ARM}objdump -d --no-show-raw-insn "$1"; } | awk '
        $1 == "at" { names[$2] = names[$2] " " $3; next } # __aeabi_idiv and __divsi3 are one place
        function count(s, n, i, p, a, b, w) { # registers in {r4, r5-r7}
            sub(/.*\{/, "", s); sub(/\}.*/, "", s); n = split(s, p, ","); w = 0
            for (i = 1; i <= n; i++) w += 1
            return w }
        />:$/ { f = $2; gsub(/<|>|:/, "", f); seen[f] = $1; next }
        $2 ~ /^(push|stmdb|stmfd)/ && ($2 ~ /^push/ || $3 ~ /^sp!/) { own[f] += 4 * count($0) }
        $2 ~ /^sub/ && $3 == "sp," { s = $0; sub(/;.*/, "", s); sub(/@.*/, "", s)
            if (match(s, /#[0-9]+/)) own[f] += substr(s, RSTART + 1, RLENGTH - 1) }
        match($0, /\[sp, #-[0-9]+\]!/) { s = substr($0, RSTART, RLENGTH); gsub(/[^0-9]/, "", s); own[f] += s }
        $2 ~ /^b/ && match($0, /<[^>+]+>/) { g = substr($0, RSTART + 1, RLENGTH - 2); if (g != f) callee[f] = callee[f] " " g }
        function deep(f, level, i, n, p, m, d) {
            if (level > 20) return 100000
            m = 0; n = split(callee[f], p, " ")
            for (i = 1; i <= n; i++) { d = deep(p[i], level + 1); if (d > m) m = d }
            return own[f] + m }
        END { for (f in seen) {
                n = split(names[seen[f]], alias, " "); d = deep(f, 0)
                for (i = 1; i <= n; i++) if (alias[i] !~ /^zs_|^main$/) print "helper", alias[i], d } }'
}

bound() { # CPU FACTS: prints public functions with their bound, then problems
    awk -v cpu="$1" -v limit="$LIMIT" '
        function fail(name, why) { print "FAILED " cpu " " name ": " why; failed = 1 }
        $1 == "frame" { own[$2] = $3; if ($4 != "(static)") fail("fixed frames", $2 " " $4); next }
        $1 == "helper" { helper[$2] = $3; next }
        $1 == "slot" { key = $2 "->" $3; if (index(" " to[key] " ", " " $4 " ") == 0) to[key] = to[key] " " $4; next }
        $1 == "call" { edge($2, $3); next }
        $1 == "pointer" { n_pointer++; from[n_pointer] = $2; where[n_pointer] = $3; next }
        function edge(a, b) { if (!((a, b) in have)) { have[a, b] = 1; out[a] = out[a] " " b } }
        function resolve(k, p, line, i, text, key, n, q) {
            split(where[k], p, ":"); i = 0
            while ((getline text < p[1]) > 0) if (++i == p[2]) line = text
            close(p[1])
            if (!match(line, /(shader|depth|kernel|texel|watch|track|cluster|sink)->[a-z_]+\(/)) {
                fail("pointer calls", where[k] " is not shader->, depth->, kernel->, texel->, watch->, track->, cluster-> or sink->"); return }
            key = substr(line, RSTART, RLENGTH - 1)
            if (key ~ /^sink/) { sinks[from[k]] = 1; return }
            if (!(key in to)) { fail("pointer calls", where[k] ": no table fills " key); return }
            n = split(to[key], q, " ")
            for (i = 1; i <= n; i++) edge(from[k], q[i])
            resolved++ }
        function deep(f, i, n, p, m, d) {
            if (f in bound) return bound[f]
            if (f in open) { fail("no recursion", f " calls itself, perhaps through others"); return 0 }
            if (!(f in own)) {
                if (f in helper) return bound[f] = helper[f]
                fail("known calls", f " has no known frame"); return 0 }
            open[f] = 1; m = 0; n = split(out[f], p, " "); next_of[f] = ""
            for (i = 1; i <= n; i++) { d = deep(p[i]); if (d > m) { m = d; next_of[f] = p[i] } }
            delete open[f]
            return bound[f] = own[f] + m }
        END {
            for (k = 1; k <= n_pointer; k++) resolve(k)
            for (f in own) { d = deep(f); if (f ~ /^zs_/ && d > most) { most = d; worst = f } }
            for (f in own) if (f ~ /^zs_(init|render|frame_begin|frame_strip|frame_end|pose_|camera_|unit|mesh_check|texture_check)/)
                print "note " cpu " " f ": " bound[f] " bytes" (f in sinks ? ", and what the sink takes" : "") | "sort"
            close("sort")
            path = "zs_render(" own["zs_render"] ")"
            for (f = next_of["zs_render"]; f != ""; f = next_of[f]) path = path " " f "(" (f in own ? own[f] : helper[f]) ")"
            print "note " cpu " deepest: " path
            if (!failed) print "ok " cpu " no recursion, fixed frames, " n_pointer " pointer calls accounted for"
            if (bound["zs_render"] == 0) fail("bound", "zs_render not found")
            else if (most > limit) fail("stack within " limit " bytes", worst " takes " most)
            else print "ok " cpu " stack within " limit " bytes: zs_render " bound["zs_render"]
            exit failed }' "$2"
}

stack() { # CPU NAME; lean: flags of the lean build, or nothing
    c=$1 name=$2 dir=$B/stack-$2
    # shellcheck disable=SC2086
    core "$c" "$dir" $lean -fstack-usage -fcallgraph-info=su || { bad "$name compiles (-Wvla -Werror)" "see above"; return; }
    ok "$name no VLA, no alloca: $(cat "$dir"/*.su | wc -l) frames, $(cat "$dir"/*.su | grep -c dynamic) dynamic"
    minimal "$dir/main.c" flat recip "$EVERYTHING $CULLING"
    echo "$OTHERS" >>"$dir/main.c"
    # shellcheck disable=SC2086
    link "$c" "$dir" "$dir/main.c" "$dir/all.elf" $lean || { bad "$name links" "see above"; return; }
    { helpers "$dir/all.elf"; facts "$c" "$dir"; } >"$dir/facts.txt"
    bound "$name" "$dir/facts.txt" >"$dir/bound.txt" || failed=1
    cat "$dir/bound.txt"
}
for c in $CPUS; do
    lean=
    stack "$c" "$c"
    lean='-DZS_LEAN=1 -Os'
    stack "$c" "lean-$c"
done

# Panels: frames and calls as the compiler has them. bus->F( and hooks->F( are the caller's, type->convert( is the
# deepest conversion; division and block moves come on top.
panel_bound() { # CPU DIR
    cat "$2"/*.ci | awk -v cpu="$1" -v limit="$PANEL_LIMIT" '
        function fail(name, why) { print "FAILED panels, " cpu " " name ": " why; failed = 1 }
        /^node:/ && / bytes \(/ {
            split($0, q, "\""); f = q[2]
            match($0, /[0-9]+ bytes \([a-z,]*\)/); split(substr($0, RSTART, RLENGTH), b, " ")
            own[f] = b[1]; if (b[3] != "(static)") fail("fixed frames", f " " b[3]) }
        /^edge:/ {
            split($0, q, "\"")
            if (q[4] != "__indirect_call") { out[q[2]] = out[q[2]] " " q[4]; next }
            split(q[6], w, ":"); i = 0; line = ""
            while ((getline text < w[1]) > 0) if (++i == w[2]) line = text
            close(w[1]); pointers++
            if (line ~ /type->convert\(/) out[q[2]] = out[q[2]] " panel_convert_swap panel_convert_grey4 panel_convert_mono"
            else if (line !~ /(bus|hooks)->[a-z]+\(/) fail("pointer calls", q[6] ": not bus->, hooks-> or type->convert(") }
        function deep(f, i, n, c, m, d) {
            if (f in bound) return bound[f]
            if (f in open) { fail("no recursion", f " calls itself, perhaps through others"); return 0 }
            if (!(f in own)) { if (f !~ /^(mem(set|cpy)|__aeabi_)/) fail("known calls", f); return 0 }
            open[f] = 1; m = 0; n = split(out[f], c, " ")
            for (i = 1; i <= n; i++) { d = deep(c[i]); if (d > m) m = d }
            delete open[f]
            return bound[f] = own[f] + m }
        END {
            for (f in own) { d = deep(f); if (d > most) { most = d; worst = f } }
            if (!("panel_send" in own) || !pointers) fail("bound", "panel_send or its calls not found")
            else if (most > limit) fail("stack within " limit " bytes", worst " takes " most)
            else print "ok panels, " cpu " stack within " limit " bytes: " worst " " most ", panel_send " bound["panel_send"]
            exit failed }'
}
for c in $CPUS; do
    dir=$B/stack-panels-$c
    panels "$c" "$dir" -fstack-usage -fcallgraph-info=su || { bad "panels, $c compile" "see above"; continue; }
    panel_bound "$c" "$dir" >"$dir/bound.txt" || failed=1
    cat "$dir/bound.txt"
done

# What the boards' tests have found painted over is no more than that: drawing, and sending from it. Interrupts and the
# program's own frames are in what was painted, too.
painted() { # BOARD CPU
    [ -s "${B%/checks}/$1/table.txt" ] || { echo "note $1: its test has not run, no painted stack"; return; }
    render=$(sed -n 's/^ok .*: zs_render //p' "$B/stack-$2/bound.txt")
    send=$(sed -n 's/.*, panel_send //p' "$B/stack-panels-$2/bound.txt")
    awk -v board="$1" -v bound=$((${render:-0} + ${send:-0})) '$5 > most { most = $5; scene = $2 }
        END { if (most + 0 > 0 && most <= bound) { print "ok " board " painted stack " most " (" scene ") within the bound, " bound; exit }
            print "FAILED " board " painted stack: " most + 0 ", bound " bound; exit 1 }' "${B%/checks}/$1/table.txt" || failed=1
}
painted pico cortex-m0plus
painted microbit cortex-m0plus
painted lm3s6965 cortex-m3
painted stm32f405 cortex-m3
exit $failed
