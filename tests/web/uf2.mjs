// node tests/web/uf2.mjs FILE.uf2 IMAGE.bin: the flash that a UF2 file brings to an RP2040, from its start; what no
// block brings is FFh. Ends with 1 where a block is not as the boot ROM takes it.
//
// SPDX-License-Identifier: MIT
import { readFileSync, writeFileSync } from 'node:fs';

const [from, to] = process.argv.slice(2);
const FLASH = 0x10000000, PAYLOAD = 256;
const file = readFileSync(from), n = file.length / 512;
const flash = Buffer.alloc(2 << 20, 255);
let end = 0;
for (let i = 0; i < n; i++) {
    const word = (k) => file.readUInt32LE(512 * i + 4 * k);
    const head = [ word(0), word(1), word(2), word(4), word(5), word(6), word(7), word(127) ];
    const wanted = [ 0x0a324655, 0x9e5d5157, 0x2000, PAYLOAD, i, n, 0xe48bff56, 0x0ab16f30 ];
    const at = word(3) - FLASH;
    if (String(head) !== String(wanted) || at % PAYLOAD || at < 0 || at + PAYLOAD > flash.length) {
        console.error(`block ${i} of ${n}: ${head.map((w) => w.toString(16))} at ${word(3).toString(16)}`);
        process.exit(1);
    }
    file.copy(flash, at, 512 * i + 32, 512 * i + 32 + PAYLOAD);
    end = Math.max(end, at + PAYLOAD);
}
writeFileSync(to, flash.subarray(0, end));
