// node image.mjs STEM: what the boot ROM would say of STEM.bin, and whether STEM.uf2 brings exactly that to flash;
// and how the second stage leaves what reads the flash.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

import { alone } from './alone.mjs';
import { Pico } from './pico.mjs';

const verdict = (name, wrong) => `${wrong ? 'FAILED' : 'ok'} ${name}${wrong ? `: ${wrong}` : ''}\n`;

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

export function run([stem]) {
    const bin = fs.readFileSync(`${stem}.bin`), uf2 = fs.readFileSync(`${stem}.uf2`);

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

    // Run to the program's entry. The flash's clock of 62.5 MHz wants a pad of 8 mA and fast slew, its data no Schmitt
    // trigger; the interface: on, divided by 2, sampled a cycle late, 3Bh with 24 bits of address and 8 clocks of
    // pause.
    function reads_flash() {
        const pico = new Pico(stem), { chip, core } = pico, entry = bin.readUInt32LE(260) & ~1;
        pico.boot();
        for (let i = 0; core.PC !== entry; i++) {
            if (i === 1000)
                return 'the program is not entered';
            pico.step();
        }
        const wants = [
            ['SCLK', 0x40020004, 0x31, 0x21], ['SD0', 0x40020008, 2, 0], ['SD1', 0x4002000c, 2, 0],
            ['CTRLR0', 0x18000000, ~0, 0x003f0300], ['CTRLR1', 0x18000004, ~0, 0], ['SSIENR', 0x18000008, 1, 1],
            ['BAUDR', 0x18000014, ~0, 2], ['RX_SAMPLE_DLY', 0x180000f0, ~0, 1],
            ['SPI_CTRLR0', 0x180000f4, ~0, 0x3b004218], ['VTOR', 0xe000ed08, ~0, 0x10000100],
        ];
        for (const [name, at, bits, value] of wants)
            if ((chip.readUint32(at) & bits) !== value)
                return `${name} is ${(chip.readUint32(at) >>> 0).toString(16)}`;
        return core.SP === bin.readUInt32LE(256) ? '' : `stack pointer ${core.SP.toString(16)}`;
    }

    return verdict('pico_second_stage_checksum', stage2()) + verdict('pico_second_stage_reads_flash', reads_flash()) +
        verdict('pico_vectors', vectors()) + verdict('pico_uf2', blocks());
}
alone(import.meta.url, run);
