#!/bin/sh
# Every method of hidden-surface removal against the depth buffer on random worlds with cycles and intersections
# (tests/property/test_methods.c, of which make test runs 150 under ASan and UBSan), as make quick builds it.
#
# Usage: tests/lab/worlds.sh BUILD [N]   N worlds, 10,000 unless said; the report of tests/records on standard output
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
commit=$(git log -1 --format=%h -- firmware/zstrip 2>/dev/null)
[ -z "$(git status --porcelain firmware/zstrip 2>/dev/null)" ] || commit=$commit+
out=$1/methods
mkdir -p "$out"
ZS_WORLDS=${2:-10000} "$1/test/test_methods" >"$out/worlds.log" 2>&1
status=$?
echo "Of commit ${commit:-unknown}: firmware/zstrip/method firmware/zstrip/core firmware/zstrip/depth"
echo
echo "Methods against the depth buffer (make methods-worlds), 40x40 px, strips, pools and accelerators at random"
sed -n '/worlds/p' "$out/worlds.log" | fold -s -w 118 | sed 's/ $//'
[ "$status" -eq 0 ] || { echo "FAILED:"; cat "$out/worlds.log"; }
exit "$status"
