# What a test's log comes to, and the sanitizers' options that all tests have. Sourced.
#
# SPDX-License-Identifier: MIT
# 16 MB of freed memory are held back, not 256: pages are used again, which is half a second in eight of test programs
ASAN_OPTIONS=detect_leaks=1:handle_sigill=2:quarantine_size_mb=16
LSAN_OPTIONS=suppressions=tests/lib/lsan.txt:print_suppressions=0
export ASAN_OPTIONS LSAN_OPTIONS

# Count lines of a log into $ok and $bad: ok and FAILED from scripts, [  OK ] and [ FAILED ] from cmocka. A program that
# ends badly without having said so is a failure of its own. A part that cannot be set up says SKIPPED and why.
tally() { # NAME LOG STATUS
    ok=$(grep -cE '^(ok |\[ +OK \])' "$2")
    bad=$(grep -E '^(FAILED |\[  FAILED  \] [a-z0-9_]+$)' "$2" | sort -u | wc -l) # cmocka says it twice
    if [ "$3" -ne 0 ] && [ "$bad" -eq 0 ]; then
        echo "FAILED $1: ended with status $3" >>"$2"
        bad=1
    fi
    if [ "$3" -eq 0 ] && [ "$ok" -eq 0 ] && [ "$bad" -eq 0 ] && ! grep -q '^SKIPPED ' "$2"; then
        echo "FAILED $1: ran no test" >>"$2"
        bad=1
    fi
}
