// node bench.mjs STEM
//
// Boots STEM.bin, a bench with BENCH_POOLS, and prints its text (the UART's) with the cycles that bench_frame took from
// its call to its return in place of a scene's instructions, and cycles a triangle and a fragment. Then "# in_flash N":
// the most per cent of a frame's cycles that ran from flash; problems after "# problem".
//
// SPDX-License-Identifier: MIT
import { Pico } from './pico.mjs';

const RAM = 0x20000000;
const TRIS = 5, FRAGMENTS = 9, COUNT = 12; // columns of the bench's lines

const pico = new Pico(process.argv[2]);
const { symbols } = pico.elf, { core } = pico;
const frame = symbols.bench_frame & ~1, stop = symbols.hal_exit & ~1;
const frames = []; // cycles: in all, and of instructions in flash
pico.boot();
while (core.PC !== stop) {
    if (core.PC !== frame) {
        pico.step();
        continue;
    }
    const end = core.LR & ~1;
    let cycles = 0, flash = 0;
    while (core.PC !== end) {
        const in_flash = core.PC < RAM, n = pico.step();
        cycles += n;
        flash += in_flash ? n : 0;
    }
    frames.push({ cycles, flash });
}
while (!core.waiting) // until the last line has left the UART
    pico.step();

let n = 0;
for (const line of pico.text.split('\n').filter(Boolean)) {
    const column = line.split(',');
    if (column[COUNT] === '0') {
        const { cycles } = frames[n++];
        const per = (count) => (cycles / count).toFixed(1);
        column.splice(COUNT, 3, cycles, per(column[TRIS]), per(column[FRAGMENTS]));
    }
    console.log(column.join(','));
}
console.log('# in_flash', Math.max(...frames.map((f) => f.flash / f.cycles * 100)).toFixed(2));
for (const problem of pico.problems)
    console.log('# problem', problem);
