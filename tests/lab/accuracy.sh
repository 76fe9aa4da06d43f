#!/bin/sh
# `zlab accuracy`, the smaller cut: every row of its table is a test.
# Usage: tests/lab/accuracy.sh ZLAB
set -u
zlab=$1

# Rows are "  ok   WHAT  MEASURED  ALLOWED  OVER", with two or more spaces between.
table=$("$zlab" accuracy --quick)
status=$?
printf '%s\n' "$table" | awk -F '  +' '
    $2 == "ok" || $2 == "FAIL" {
        name = tolower($3)
        gsub(/[^a-z0-9.]+/, "_", name)
        printf "%s accuracy_%s: %s, allowed %s\n", $2 == "ok" ? "ok" : "FAILED", name, $4, $5
        rows++
        failed += $2 == "FAIL"
    }
    END { exit rows < 50 || failed }'
rows=$?
if [ "$status" -eq 0 ] && [ "$rows" -eq 0 ]; then
    echo "ok accuracy_ends_with_status_0"
else
    echo "FAILED accuracy_ends_with_status_0: it is $status"
    status=1
fi

refused() { # NAME ARGUMENT...    not understood: status 2 and one line
    name=$1
    shift
    said=$("$zlab" accuracy "$@" 2>&1 >/dev/null)
    if [ $? -eq 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" -eq 1 ]; then
        echo "ok $name"
    else
        echo "FAILED $name: zlab accuracy $*: $said"
        status=1
    fi
}
refused accuracy_unknown_option --slow
refused accuracy_scenes_without_a_number --scenes
refused accuracy_scenes_of_none --scenes 0
refused accuracy_seed_that_is_none --seed one
exit $status
