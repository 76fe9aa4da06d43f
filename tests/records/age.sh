#!/bin/sh
# How old the reports of this folder are. The first line of each, "Of commit HASH: PATH...", says which commit it was
# made of and what it speaks of: a line each, with the commits since that changed one of these paths.
# Usage: tests/records/age.sh
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
git rev-parse --git-dir >/dev/null 2>&1 || { echo "no git here: commits cannot be told"; exit 2; }
# shellcheck disable=SC2086
for file in tests/records/*.txt; do
    of=$(sed -n '1s/^Of commit \([0-9a-f]*\): .*/\1/p' "$file")
    paths=$(sed -n '1s/^Of commit [0-9a-f]*: //p' "$file")
    case $(basename "$file") in
    [A-Z]*) ;;
    *) continue ;; # make test compares these with what it has
    esac
    if [ -z "$of" ] || ! since=$(git rev-list --count "$of..HEAD" -- $paths 2>/dev/null); then
        echo "$file: its commit is not known"
    elif [ "$since" -eq 0 ]; then
        echo "$file: of $of, as $paths is"
    else
        echo "$file: of $of, $(git log -1 --format=%as "$of"); older than $paths: $since commits since," \
            "$(git diff --shortstat "$of" HEAD -- $paths | sed 's/^ *\([0-9]*\) files\{0,1\} changed.*/\1/') files"
    fi
done
