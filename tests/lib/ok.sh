# What each script of tests says of a test: `ok NAME`, or `FAILED NAME: REASON`, which leaves 1 in $failed. Sourced.
#
# SPDX-License-Identifier: MIT
failed=0

ok() { echo "ok $*"; }
bad() { # NAME REASON
    echo "FAILED $1: $2"
    failed=1
}

# Figures on record are of the compiler that tests/records/bench.txt names. Under another one they are printed, and only
# what is far off fails: a limit of MOST becomes one and a quarter of it.
other_compiler() { # whether Arm's compiler here is another one
    ! grep -q "^compiler Arm $(${ARM:-arm-none-eabi-}gcc -dumpversion)\$" tests/records/bench.txt
}
most_here() { # MOST
    if other_compiler; then echo $(($1 * 5 / 4)); else echo "$1"; fi
}
