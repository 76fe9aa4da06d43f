#!/bin/sh
# Complexity and length of functions, by pmccabe (McCabe's number, without counting && and ||: its second column; lines
# of the function), and what the code says twice, by sim_c (runs of TOKENS or more that are the same but for names).
# tests/records/COMPLEXITY.txt says why of what stands out.
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
COMPLEX=${COMPLEX:-15}
LONG=${LONG:-60}
TOKENS=${TOKENS:-60}
for part in firmware/zstrip hal sim tests; do
    # shellcheck disable=SC2046
    pmccabe $(find "$part" -name '*.c' | sort) | sort -k5,5n |
        awk -v part="$part" -v complex="$COMPLEX" -v long="$LONG" '
        { n++; m[n] = $2 + 0; l[n] = $5 + 0 }
        $2 > complex || $5 > long { out = out sprintf("    complexity %3d, %3d lines: %s %s\n", $2, $5, $6, $7) }
        function sorted(a, n, i, j, t) { for (i = 2; i <= n; i++) { t = a[i]
            for (j = i - 1; j > 0 && a[j] > t; j--) a[j + 1] = a[j]; a[j + 1] = t } }
        END { sorted(m, n); sorted(l, n); h = int((n + 1) / 2); p = int(n * .9)
            up = "median %d, nine of ten up to %d"
            printf "%s: %d functions; complexity " up "; lines " up "\n%s", \
                part, n, m[h], m[p], l[h], l[p], out }'
done
echo "Said twice, runs of $TOKENS tokens or more:"
# shellcheck disable=SC2046
sim_c -r "$TOKENS" -n $(find firmware/zstrip hal sim -name '*.c' | grep -v /gen/ | sort) | grep '|' || echo '    none'
