#!/bin/sh
# Promise 1 on the Cortex-M objects of firmware/zstrip and hal/panel, not by eye: no float, no allocator, no global
# state, nothing called that is not named here.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"

# Soft-float helpers: the Arm ABI's names and libgcc's own.
FLOAT='__aeabi_(f|d|cf|cd|h)[a-z0-9]+|__aeabi_(i|ui|l|ul)2[fd]'
FLOAT="$FLOAT|__(add|sub|mul|div|neg|cmp|eq|ne|lt|le|gt|ge|unord|pow)[sdtx]f[0-9]*|__(float|fix|extend|trunc)[a-z0-9]+"
FLOAT="^($FLOAT|(sqrt|sin|cos|tan|atan2?|floor|ceil|fabs|pow|exp|log|fmod|round)f?)\$"
HEAP='^_?(malloc|calloc|realloc|free|memalign|aligned_alloc|alloca|sbrk|_sbrk|malloc_r|free_r)(_r)?$'
# What may stay undefined: integer division and multiplication, counting zeros, switch tables (M0+),
# block moves.
ALLOWED='__aeabi_u?idiv(mod)?|__aeabi_u?ldivmod|__aeabi_lmul|__aeabi_l(lsl|lsr|asr)|__clz[sd]i2'
ALLOWED="^($ALLOWED|__gnu_thumb1_case_(u?qi|u?hi|si)|mem(set|cpy|move))\$"

# NAME CPU DIR [FLAGS...]: the objects of a folder, and a program in DIR/main.c that uses all of them
rules() {
    name=$1 c=$2 dir=$3
    shift 3
    ${ARM}ld -r "$dir"/*.o -o "$dir/all.rel" || bad "$name partial link" "see above"
    undefined=$(${ARM}nm --plugin= -u "$dir/all.rel" | awk '{ print $NF }')
    none "$name no soft-float helper" "$(echo "$undefined" | grep -E "$FLOAT")"
    none "$name no allocator" "$(echo "$undefined" | grep -E "$HEAP")"
    none "$name no other undefined symbol" \
        "$(echo "$undefined" | grep -Ev "$ALLOWED" | grep -Ev "$FLOAT" | grep -Ev "$HEAP")"
    none "$name no writable global" "$(${ARM}nm --plugin= "$dir/all.rel" | awk '$2 ~ /^[bBdDC]$/ { print $3 }')"
    if ! link "$c" "$dir" "$dir/main.c" "$dir/all.elf" "$@"; then
        bad "$name links" "see above"
        return
    fi
    none "$name linked: no FPU instruction" "$(${ARM}objdump -d --no-show-raw-insn "$dir/all.elf" |
        awk '/>:$/ { f = $2 } $2 ~ /^(v[a-z]|f(add|sub|mul|div|cpy|ld|st|cmp|to|sito|uito))/ { print f $2 }')"
    linked=$(${ARM}nm --plugin= "$dir/all.elf" | awk '{ print $NF }')
    none "$name linked: no soft float" "$(echo "$linked" | grep -E "$FLOAT")"
    none "$name linked: no allocator" "$(echo "$linked" | grep -E "$HEAP")"
}

for c in $CPUS; do
    dir=$B/objects-$c
    if core "$c" "$dir"; then
        LIST=$FAST_ALL minimal "$dir/main.c" flat recip "$EVERYTHING $OWN"
        echo "$OTHERS $OWN_SHADER" >>"$dir/main.c"
        rules "$c" "$c" "$dir"
    else
        bad "$c compiles" "see above"
    fi
    dir=$B/objects-bare-$c
    # shellcheck disable=SC2086
    if core "$c" "$dir" $BARE; then
        cp "$B/objects-$c/main.c" "$dir/main.c"
        rules "bare, $c" "$c" "$dir" $BARE
    else
        bad "bare, $c compiles" "see above"
    fi
    dir=$B/objects-panels-$c
    if panels "$c" "$dir"; then
        minimal_panel "$dir/main.c" st7789 240 240 "$ALL_PANELS"
        rules "panels, $c" "$c" "$dir"
    else
        bad "panels, $c compile" "see above"
    fi
done

# The same source for a core that has an FPU. There GCC moves and saves 64-bit integers through FPU
# registers (vldr, vpush, vmov); arithmetic, comparison and conversion would be float in the source.
dir=$B/objects-fpu
if core cortex-m4 "$dir" -mfloat-abi=hard -mfpu=fpv4-sp-d16; then
    fpu=$(${ARM}objdump -d --no-show-raw-insn "$dir"/*.o | awk '/file format/ { o = $1; sub(/.*\//, "", o) }
        />:$/ { f = $2; n++ }
        $2 ~ /^v[a-z]+/ && $2 !~ /^v(ldr|str|push|pop|mov|ldm|stm)/ { print o f $2 }
        END { if (n < 300) print "functions:" n + 0 }')
    none "cortex-m4f no FPU arithmetic" "$fpu"
else
    bad "cortex-m4f compiles" "see above"
fi

# And as written: the words themselves, comments aside.
WORDS='(^|[^A-Za-z0-9_])(float|double|malloc|calloc|realloc|alloca)([^A-Za-z0-9_]|$)'
for f in firmware/zstrip/*.h firmware/zstrip/*/*.[ch] hal/panel/*.[ch]; do
    printf '\nwords_of %s\n' "$f"
    cat "$f"
done >"$B/words.c"
words=$(${ARM}gcc -fpreprocessed -dD -E -P "$B/words.c" | awk -v words="$WORDS" '
    /^#define ZS_DEPTH_EACH\(X\) / { sub(/X\(float, /, "X(") } # where the mapping zs_depth_float has its name
    $1 == "words_of" { file = $0; gsub(/words_of| /, "", file); n++; next }
    $0 ~ words "|[0-9][.][0-9]*f?([^A-Za-z0-9_\"]|$)" && !/"[^"]*[0-9]\.[^"]*"/ { gsub(/ /, "_"); print file ":" $0 }
    END { if (n < 100) print "files:" n + 0 }')
none "source: no float, no allocator" "$words"
exit $failed
