# Sourced with $build and $needs, a file of build/web: where there is none, end here in one line, SKIPPED if it is for
# want of a network. `make test` has built them, or written build/web.log.
#
# SPDX-License-Identifier: MIT
# shellcheck disable=SC2154
if [ ! -f "$build/web/$needs" ]; then
    why=$(sed -n 's/^SKIPPED pico: //p; s/^zstrip: \(.*\) Is there a network?$/\1/p' "$build/web.log" 2>/dev/null |
        head -1)
    if [ -n "$why" ]; then
        echo "SKIPPED web: there is no $needs: $why"
        exit 0
    fi
    echo "FAILED web_is_made: there is no $needs: $(tail -n 3 "$build/web.log" 2>&1 | tr '\n' ' ' | cut -c1-300)"
    exit 1
fi
