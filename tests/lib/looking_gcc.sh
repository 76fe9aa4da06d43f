#!/bin/sh
# gcc OPTION... -c SOURCE -o FILE, that looks at the source and compiles nothing: so a cache of compilers, which does
# not keep -fsyntax-only, keeps what gcc says. In FILE is a word, since one that is empty is not kept.
#
# SPDX-License-Identifier: MIT
CCACHE_DISABLE=1 gcc -fsyntax-only "$@" || exit
while [ "$1" != -o ]; do shift; done
echo looked >"$2"
