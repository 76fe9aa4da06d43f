#!/bin/sh
# $MEASURED_GCC OPTION... -o OBJECT.o, and the call graph that it writes (OBJECT.ci) at the end of OBJECT.su: a cache of
# compilers keeps the .su and does not know the .ci.
#
# SPDX-License-Identifier: MIT
CCACHE_DISABLE=1 "$MEASURED_GCC" -fcallgraph-info=su "$@" || exit
while [ $# -gt 1 ]; do
    [ "$1" = -o ] && object=$2
    shift
done
graph=${object%.o}.ci
[ ! -e "$graph" ] || { cat "$graph" >>"${object%.o}.su" && rm "$graph"; }
