// node image.mjs STEM: what the boot ROM would say of STEM.bin, and whether STEM.uf2 brings exactly that to flash.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

const stem = process.argv[2];
const bin = fs.readFileSync(`${stem}.bin`), uf2 = fs.readFileSync(`${stem}.uf2`);

const verdict = (name, wrong) => console.log(wrong ? `FAILED ${name}: ${wrong}` : `ok ${name}`);

// CRC-32 as the remainder of a division of polynomials: no table, no shift register.
function remainder(bytes) {
    const poly = 0x104c11db7n;
    let message = BigInt('0x' + bytes.toString('hex')) << 32n;
    message ^= 0xffffffffn << BigInt(bytes.length * 8); // begun with all ones: the first 32 bits inverted
    for (let bit = BigInt(bytes.length * 8 + 31); bit >= 32n; bit--)
        if (message >> bit & 1n)
            message ^= poly << bit - 32n;
    return Number(message);
}

function stage2() {
    const has = bin.readUInt32LE(252), wants = remainder(bin.subarray(0, 252));
    return has === wants ? '' : `checksum ${has.toString(16)}, not ${wants.toString(16)}`;
}

function vectors() {
    const stack = bin.readUInt32LE(256), entry = bin.readUInt32LE(260);
    if (stack & 7 || stack < 0x20000000 || stack > 0x20042000)
        return `stack pointer ${stack.toString(16)}`;
    return entry & 1 && entry > 0x10000100 && entry < 0x10000000 + bin.length ? '' : `entry ${entry.toString(16)}`;
}

function blocks() {
    const n = Math.ceil(bin.length / 256), seen = Buffer.alloc(n * 256);
    if (uf2.length !== n * 512)
        return `${uf2.length} bytes for ${n} blocks`;
    for (let i = 0; i < n; i++) {
        const b = uf2.subarray(i * 512, i * 512 + 512), word = (k) => b.readUInt32LE(k);
        const head = [word(0), word(4), word(8), word(12), word(16), word(20), word(24), word(28), word(508)];
        const want = [0x0a324655, 0x9e5d5157, 0x2000, 0x10000000 + 256 * i, 256, i, n, 0xe48bff56, 0x0ab16f30];
        for (let k = 0; k < head.length; k++)
            if (head[k] !== want[k])
                return `block ${i}, field ${k}: ${head[k].toString(16)}`;
        if (b.subarray(288, 508).some((byte) => byte))
            return `block ${i}: not zero beyond the payload`;
        b.copy(seen, i * 256, 32, 288);
    }
    return seen.subarray(0, bin.length).equals(bin) ? '' : 'its payload is not the image';
}

verdict('pico_second_stage_checksum', stage2());
verdict('pico_vectors', vectors());
verdict('pico_uf2', blocks());
