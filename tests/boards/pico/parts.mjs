// node parts.mjs STEM: boot STEM.bin, print the text of its UART, then "wire" with what followed the last RESET:
// command bytes with a c, data plain, "|" where CS rose; and a line "problem ..." for each problem.
//
// SPDX-License-Identifier: MIT
import { Pico } from './pico.mjs';

const pico = new Pico(process.argv[2]);
const stop = pico.elf.symbols.hal_exit & ~1;
pico.boot();
while (pico.core.PC !== stop)
    pico.step();
const hex = (word) => (word & 0x800 ? '|' : (word & 0x100 ? '' : 'c') + (word & 0xff).toString(16).padStart(2, '0'));
process.stdout.write(pico.text);
console.log('wire', pico.stream.slice(pico.stream.lastIndexOf(0x200) + 1).map(hex).join(' '));
for (const problem of pico.problems)
    console.log('problem', problem);
