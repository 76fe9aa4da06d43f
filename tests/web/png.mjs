// PNG of 8-bit RGB, in and out, by zlib alone.
//
// SPDX-License-Identifier: MIT
import {deflateSync, inflateSync} from 'node:zlib';

/** @returns {{width: number, height: number, rgb: Uint8Array}} */
export function readPng(file) {
    const parts = [];
    let width, height;
    for (let at = 8; at < file.length; at += 12 + file.readUInt32BE(at)) {
        const n = file.readUInt32BE(at), kind = file.toString('latin1', at + 4, at + 8);
        if (kind === 'IHDR') {
            width = file.readUInt32BE(at + 8);
            height = file.readUInt32BE(at + 12);
            if (file[at + 16] !== 8 || file[at + 17] !== 2) throw new Error('not a PNG of 8-bit RGB');
        }
        if (kind === 'IDAT') parts.push(file.subarray(at + 8, at + 8 + n));
    }
    const data = inflateSync(Buffer.concat(parts)), row = 3 * width, rgb = new Uint8Array(row * height);
    for (let y = 0; y < height; y++) {
        const filter = data[y * (row + 1)];
        for (let x = 0; x < row; x++) {
            const at = y * row + x;
            const left = x >= 3 ? rgb[at - 3] : 0, up = y > 0 ? rgb[at - row] : 0,
                  corner = x >= 3 && y > 0 ? rgb[at - row - 3] : 0;
            rgb[at] = data[y * (row + 1) + 1 + x] + predicted(filter, left, up, corner);
        }
    }
    return {width, height, rgb};
}

function predicted(filter, left, up, corner) {
    const p = left + up - corner, a = Math.abs(p - left), b = Math.abs(p - up), c = Math.abs(p - corner);
    return [ 0, left, up, left + up >> 1, a <= b && a <= c ? left : b <= c ? up : corner ][filter];
}

const table = Array.from({length: 256}, (_, i) => {
    let c = i;
    for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ c >>> 1 : c >>> 1;
    return c;
});
const sum = (bytes) => ~bytes.reduce((c, b) => table[(c ^ b) & 255] ^ c >>> 8, ~0) >>> 0;

/** A PNG file of [height][width][3]. */
export function writePng(width, height, rgb) {
    const chunk = (kind, data) => {
        const body = Buffer.concat([ Buffer.from(kind, 'latin1'), data ]), out = Buffer.alloc(8);
        out.writeUInt32BE(data.length, 0);
        out.writeUInt32BE(sum(body), 4);
        return Buffer.concat([ out.subarray(0, 4), body, out.subarray(4) ]);
    };
    const head = Buffer.from([ 0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0 ]), rows = Buffer.alloc((3 * width + 1) * height);
    head.writeUInt32BE(width, 0);
    head.writeUInt32BE(height, 4);
    for (let y = 0; y < height; y++)
        rows.set(rgb.subarray(3 * width * y, 3 * width * (y + 1)), (3 * width + 1) * y + 1);
    return Buffer.concat([
        Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head), chunk('IDAT', deflateSync(rows)),
        chunk('IEND', Buffer.alloc(0))
    ]);
}
