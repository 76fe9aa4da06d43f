# What each script of tests says of a test: `ok NAME`, or `FAILED NAME: REASON`, which leaves 1 in $failed. Sourced.
#
# SPDX-License-Identifier: MIT
failed=0

ok() { echo "ok $*"; }
bad() { # NAME REASON
    echo "FAILED $1: $2"
    failed=1
}
