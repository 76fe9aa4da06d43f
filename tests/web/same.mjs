// node tests/web/same.mjs A.png B.png: ends with 1 where a pixel differs.
//
// SPDX-License-Identifier: MIT
import { readFileSync } from 'node:fs';
import { readPng } from './png.mjs';

const [a, b] = process.argv.slice(2).map((name) => readPng(readFileSync(name)));
let differ = a.width === b.width && a.height === b.height ? 0 : -1;
for (let i = 0; differ >= 0 && i < a.rgb.length; i += 3)
    differ += a.rgb[i] !== b.rgb[i] || a.rgb[i + 1] !== b.rgb[i + 1] || a.rgb[i + 2] !== b.rgb[i + 2];
if (differ) {
    console.log(differ < 0 ? 'sizes differ' : `${differ} pixels differ`);
    process.exit(1);
}
