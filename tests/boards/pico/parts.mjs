// node parts.mjs STEM [SECONDS]: boot STEM.bin, print the text of its UART, then "wire" with what followed the last
// RESET: command bytes with a c, data plain, "|" where CS rose; and a line "problem ..." for each problem. It is broken
// off after SECONDS of this machine's time.
//
// SPDX-License-Identifier: MIT
import { alone } from './alone.mjs';
import { Pico } from './pico.mjs';

const hex = (word) => (word & 0x800 ? '|' : (word & 0x100 ? '' : 'c') + (word & 0xff).toString(16).padStart(2, '0'));

export function run([stem, seconds]) {
    const pico = new Pico(stem, { real_s: Number(seconds ?? Infinity) });
    const stop = pico.elf.symbols.hal_exit & ~1;
    pico.boot();
    while (pico.core.PC !== stop)
        pico.step();
    const words = [...pico.stream.from()];
    const lines = ['wire ' + words.slice(words.lastIndexOf(0x200) + 1).map(hex).join(' ')];
    lines.push(...pico.problems.map((problem) => `problem ${problem}`));
    return pico.text + lines.join('\n') + '\n';
}
alone(import.meta.url, run);
