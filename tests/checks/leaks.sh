#!/bin/sh
# LeakSanitizer, as tests/lib/leaks.c directs it: a block that nothing points to is found, one that a variable of the
# program or of a library points to is not, nor a block of sim/cli/kept.c that was given back; and the test programs are
# directed so.
#
# SPDX-License-Identifier: MIT
. "$(dirname "$0")/../lib/cortexm.sh"
. tests/lib/tally.sh # its options of the sanitizers

dir=$B/leaks
rm -rf "$dir"
mkdir -p "$dir"
echo 'void *library_keeps; /* not static, so that no compiler leaves it away */' >"$dir/library.c"
cp "$dir/library.c" "$dir/later.c"
sed -i 's/library_keeps/later_keeps/' "$dir/later.c"
cat >"$dir/main.c" <<'END'
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include "kept.h"
extern void *library_keeps;
void *program_keeps;
static void get(void **to) { *to = malloc(100); }
static void lose(void *volatile block) { block = malloc(100); }
static void lose_kept(void *volatile block) { block = sim_kept(70000); }
static void give_back(void *volatile block) { block = sim_kept(70000), sim_kept_end(block); }
static void wipe(volatile char *here) /* the stack, where a copy may be */
{
    volatile char many[20000];
    memset((char *)many, 0, sizeof many);
    *here = many[100];
}
int main(int argc, char **argv)
{
    char c;
    void *later = argc > 2 ? dlopen(argv[2], RTLD_NOW) : NULL;
    if (!strcmp(argv[1], "program"))
        get(&program_keeps);
    if (!strcmp(argv[1], "library"))
        get(&library_keeps);
    if (!strcmp(argv[1], "later"))
        get(dlsym(later, "later_keeps"));
    if (!strcmp(argv[1], "nothing"))
        lose(NULL);
    if (!strcmp(argv[1], "nothing_kept"))
        lose_kept(NULL);
    if (!strcmp(argv[1], "kept"))
        give_back(NULL);
    wipe(&c);
    return 0;
}
END
SAN='-fsanitize=address,undefined -fno-pie -no-pie -Wl,-u,leak_roots'
# shellcheck disable=SC2086
if ! gcc -shared -fPIC "$dir/library.c" -o "$dir/libkeeps.so" ||
    ! gcc -shared -fPIC "$dir/later.c" -o "$dir/later.so" ||
    ! gcc -fPIC -O0 $SAN -Isim/cli "$dir/main.c" sim/cli/kept.c tests/lib/leaks.c -L"$dir" -lkeeps \
        -Wl,-rpath,"$dir" -o "$dir/main"; then
    bad "leaks: it compiles" "see above"
    exit 1
fi
# WHO [BYTES]: what points to the block, and the bytes of a leak
search() {
    "$dir/main" "$1" "$dir/later.so" 2>"$dir/said.txt"
    status=$?
    if { [ $# = 1 ] && [ $status = 0 ]; } ||
        { [ $# = 2 ] && [ $status != 0 ] && grep -q "$2 byte(s) leaked in 1 alloc" "$dir/said.txt"; }; then
        ok "a block that $1 points to"
    else
        bad "a block that $1 points to" "status $status: $(head -n 3 "$dir/said.txt")"
    fi
}
for who in program library later; do search $who; done
search nothing 100
search nothing_kept 131072 # one of sim/cli/kept.c's that its user has lost
search kept                # and one that it has back
without=$(for program in "$top"/test/zsim "$top"/test/zlab "$top"/test/test_*; do
    case $program in *.* | */test_pair) continue ;; esac # test_pair has no memory of its own
    [ ! -x "$program" ] || grep -q leak_roots "$program" || basename "$program"
done)
none "test programs search like this" "$without"
exit $failed
