#!/bin/sh
# engine.wasm against boards and zsim: checksums of every scene's frames, pixels and keys of models, refusals, budgets,
# explanations and converted files, all as they are on record or as zsim has them.
# Usage: tests/web/engine.sh BUILD    BUILD has web/engine.wasm and zsim
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 1
build=$1
work=$build/test/web_engine
needs=engine.wasm
. tests/web/made.sh
rm -rf "$work"
mkdir -p "$work"
node tests/web/engine.mjs "$build/web/engine.wasm" "$build/zsim" "$work"
status=$?
node tests/web/readers.mjs "$build/web/engine.wasm" "$build/zsim" "$work" && [ $status = 0 ]
