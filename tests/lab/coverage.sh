#!/bin/sh
# Lines and branches of firmware/zstrip and hal/panel that the unit tests reach on the host, by gcovr. What is not
# reached is printed; tests/records/COVERAGE.txt says why of each. Less than 100 % of lines or 95 % of branches
# without a reason fails.
# Usage: tests/lab/coverage.sh BUILD (built by make coverage)
#
# SPDX-License-Identifier: MIT
set -u
cd "$(dirname "$0")/../.." || exit 2
at=$1/coverage
find "$at" -name '*.gcda' -exec rm {} +
for program in "$at"/test/test_*; do
    [ -x "$program" ] || continue
    "$program" >"$program.log" 2>&1 || echo "FAILED coverage: $program"
done
gcovr --root . --filter firmware/zstrip/ --filter hal/panel/ --json "$at/all.json" "$at/test" || exit 1
node - "$at/all.json" <<'END'
const fs = require('fs');
const files = JSON.parse(fs.readFileSync(process.argv[2], 'utf8')).files;
const REPORT = 'tests/records/COVERAGE.txt';
const reasons = fs.existsSync(REPORT) ? fs.readFileSync(REPORT, 'utf8') : '';
const sum = { lines: 0, hit: 0, branches: 0, taken: 0 };
let unexplained = 0;
console.log('file                                  lines    reached   branches    taken');
for (const f of files) {
    const text = fs.readFileSync(f.file, 'utf8').split('\n');
    const of = f.lines.filter((l) => !l['gcovr/noncode']);
    const branches = of.flatMap((l) => l.branches.map((b) => ({ ...b, line: l.line_number })));
    const count = { lines: of.length, hit: of.filter((l) => l.count).length, branches: branches.length,
        taken: branches.filter((b) => b.count).length };
    for (const k in sum)
        sum[k] += count[k];
    console.log(`${f.file.padEnd(36)} ${String(count.lines).padStart(6)} ${String(count.hit).padStart(10)} ` +
        `${String(count.branches).padStart(10)} ${String(count.taken).padStart(8)}`);
    for (const l of of.filter((x) => !x.count)) {
        const code = text[l.line_number - 1].trim();
        const known = reasons.includes(`${f.file}: ${code}`);
        unexplained += !known;
        console.log(`    line ${l.line_number} not reached${known ? '' : ', no reason given'}: ${code}`);
    }
}
const percent = (a, b) => (100 * a / b).toFixed(2);
console.log(`${sum.hit} of ${sum.lines} lines, ${percent(sum.hit, sum.lines)} %; ` +
    `${sum.taken} of ${sum.branches} branches, ${percent(sum.taken, sum.branches)} %`);
const good = !unexplained && sum.taken >= 0.95 * sum.branches;
console.log(good ? 'ok coverage' :
    `FAILED coverage: ${unexplained} lines without a reason in ${REPORT}, or branches below 95 %`);
process.exit(good ? 0 : 1);
END
