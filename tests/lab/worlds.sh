#!/bin/sh
# Long runs of two tests of methods, as make quick builds them; the report of tests/records on standard output:
#   worlds  every method of hidden-surface removal against the depth buffer on random worlds with cycles and
#           intersections (tests/property/test_methods.c, of which make test runs 150 under ASan and UBSan)
#   lines   hidden lines against the exact visible parts of edges (tests/unit/test_hidden_lines.c, of which make test
#           runs 40 views)
#
# Usage: tests/lab/worlds.sh BUILD worlds [N]   N worlds, 10,000 unless said
#        tests/lab/worlds.sh BUILD lines [N]    N views of four models, 1,000 unless said
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
commit=$(git log -1 --format=%h -- firmware/zstrip 2>/dev/null)
[ -z "$(git status --porcelain firmware/zstrip 2>/dev/null)" ] || commit=$commit+
out=$1/methods
mkdir -p "$out"
log=$out/$2.log
echo "Of commit ${commit:-unknown}: firmware/zstrip/method firmware/zstrip/core firmware/zstrip/depth"
echo
if [ "$2" = worlds ]; then
    ZS_WORLDS=${3:-10000} "$1/test/test_methods" >"$log" 2>&1
    status=$?
    echo "Methods against the depth buffer (make methods-worlds), 40x40 px, strips, pools and accelerators at random"
    sed -n '/worlds/p' "$log" | fold -s -w 118 | sed 's/ $//'
else
    ZS_VIEWS=${3:-1000} "$1/test/test_hidden_lines" >"$log" 2>&1
    status=$?
    echo "Hidden lines against the visible parts of edges in doubles (make methods-lines), 240x240 px. Visible points"
    echo "with no pixel within one of them; pixels with no visible point within one, and whose own line has none. Of"
    echo "the teapot, whose parts pierce each other, 1 pixel of 2,000 may be hidden"
    sed -n '/ views: /p' "$log"
fi
[ "$status" -eq 0 ] || { echo "FAILED:"; cat "$log"; }
exit "$status"
