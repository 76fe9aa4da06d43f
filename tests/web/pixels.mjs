/* The pixels of a PNG as zsim writes it: 8 bits, RGB. Usage: node pixels.mjs IN.png OUT.rgb; prints width and height.
 *
 * SPDX-License-Identifier: MIT
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { inflateSync } from 'node:zlib';

const png = readFileSync(process.argv[2]),
    data = [];
let width = 0,
    height = 0;
for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    const kind = png.toString('latin1', at + 4, at + 8),
        body = png.subarray(at + 8, at + 8 + png.readUInt32BE(at));
    if (kind === 'IHDR') {
        width = body.readUInt32BE(0);
        height = body.readUInt32BE(4);
        if (body[8] !== 8 || body[9] !== 2 || body[12] !== 0) throw new Error('not 8 bits of RGB');
    }
    if (kind === 'IDAT') data.push(body);
}
const raw = inflateSync(Buffer.concat(data)),
    row = 3 * width,
    out = Buffer.alloc(row * height);
const paeth = (a, b, c) => {
    const p = a + b - c,
        pa = Math.abs(p - a),
        pb = Math.abs(p - b),
        pc = Math.abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
};
for (let y = 0; y < height; y++) {
    const filter = raw[y * (row + 1)];
    for (let x = 0; x < row; x++) {
        const a = x >= 3 ? out[y * row + x - 3] : 0,
            b = y > 0 ? out[(y - 1) * row + x] : 0;
        const c = x >= 3 && y > 0 ? out[(y - 1) * row + x - 3] : 0;
        const add = [0, a, b, (a + b) >> 1, paeth(a, b, c)][filter];
        out[y * row + x] = raw[y * (row + 1) + 1 + x] + add;
    }
}
writeFileSync(process.argv[3], out);
console.log(width, height);
