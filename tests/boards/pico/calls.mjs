// node calls.mjs STEM PREFIX
//
// Boots STEM.bin and prints, for each function whose name begins with PREFIX, "NAME CYCLES": what its first call took,
// from there to its return. Then the lines of its text after "text", problems after "problem". The program ends by
// hal_exit.
//
// SPDX-License-Identifier: MIT
import { Pico } from './pico.mjs';

const [stem, prefix] = process.argv.slice(2);
const pico = new Pico(stem);
const { symbols } = pico.elf, { core } = pico, stop = symbols.hal_exit & ~1;
const waiting = new Map(
    Object.entries(symbols)
        .filter(([name]) => name.startsWith(prefix))
        .map(([name, at]) => [at & ~1, name.slice(prefix.length)]),
);
pico.boot();
while (core.PC !== stop) {
    const name = waiting.get(core.PC);
    if (!name) {
        pico.step();
        continue;
    }
    waiting.delete(core.PC);
    const end = core.LR & ~1;
    let cycles = 0;
    while (core.PC !== end) cycles += pico.step();
    console.log(name, cycles);
}
while (!core.waiting) pico.step(); // until the last line has left the UART
for (const line of pico.text.split('\n').filter(Boolean)) console.log('text', line);
for (const problem of pico.problems) console.log('problem', problem);
