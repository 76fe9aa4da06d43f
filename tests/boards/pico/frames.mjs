// node frames.mjs STEM [--size WxH] [--frames N] [--gap NS] [--seconds S] [--cycles 1] [--xip 1]
//                     --stream FILE
//
// Boots STEM.bin, whatever program it is, on an emulated Pico, until its panel (an ST7789 on SPI0, or another with its
// commands) has got N whole frames since it was switched on. Prints "name value" a line: frames a second, the share of
// the time in which the wire was busy, text of the UART after "text", problems after "problem". FILE gets the panel's
// bytes, for `zsim panel --full --decode`. --gap: ns between words, as real chips make some. --seconds: of the
// program's time, after which it is broken off (30). --cycles: what the core ran from each frame's end to the next
// one's, without its sleep, "frame NUMBER CYCLES" a line. --xip: reading the flash takes time (xip.mjs); flash_percent
// is the share of the time in which the core waits for it.
//
// Exit status: 0; 1 where the frames did not come.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

import { CYCLE_NS, Pico } from './pico.mjs';
import { MISS_CYCLES } from './xip.mjs';

const DATA = 0x100, MARKS = 0xe00;
const DISPLAY_ON = 0x29, MEMORY_WRITE = 0x2c;

const o = { size: '240x240', frames: 4, gap: 0, seconds: 30, cycles: 0, xip: 0, stream: '' };
const args = process.argv.slice(2);
for (let i = 1; i < args.length; i += 2) {
    const name = args[i].replace('--', '');
    o[name] = typeof o[name] === 'number' ? Number(args[i + 1]) : args[i + 1];
}
const [width, height] = o.size.split('x').map(Number);
const frame_bytes = width * height * 2;

const pico = new Pico(args[0], { gap_ns: o.gap, xip: o.xip !== 0, most_s: o.seconds + 1 });
pico.boot();

let seen = 0;               // words of the stream that were looked at
let on = false, pixels = false, bytes = 0;
const whole = [];           // when each frame was: its time and the wire's
function look() {
    for (; seen < pico.stream.length; seen++) {
        const word = pico.stream.words[seen];
        if (word & MARKS)
            continue;
        if (!(word & DATA)) {
            pixels = word === MEMORY_WRITE;
            on ||= word === DISPLAY_ON;
        } else if (on && pixels && ++bytes === frame_bytes) {
            bytes = 0;
            whole.push({ ns: pico.clock.nanos, wire: pico.busy_ns, ran: pico.core.ran, misses: pico.xip?.misses });
        }
    }
}

const stop = pico.elf.symbols.hal_exit & ~1;
while (whole.length < o.frames && (pico.core.PC & ~1) !== stop && pico.clock.nanos < o.seconds * 1e9) {
    pico.step();
    if (pico.stream.length !== seen)
        look();
}

const out = (name, value) => console.log(name, value);
const first = whole[0], last = whole[whole.length - 1], n = whole.length - 1;
out('frames', whole.length);
if (n > 0) {
    out('fps', (n / (last.ns - first.ns) * 1e9).toFixed(1));
    out('wire_percent', Math.round((last.wire - first.wire) / (last.ns - first.ns) * 100));
    if (pico.xip) {
        const waited = (last.misses - first.misses) * MISS_CYCLES * CYCLE_NS;
        out('flash_percent', Math.round(waited / (last.ns - first.ns) * 100));
    }
}
for (let k = 1; o.cycles && k < whole.length; k++)
    out('frame', `${k} ${whole[k].ran - whole[k - 1].ran}`);
for (const line of pico.text.split('\n').filter(Boolean))
    out('text', line);
for (const problem of pico.problems)
    out('problem', problem);
fs.writeFileSync(o.stream, pico.stream.from());
if (whole.length < o.frames) {
    console.error(`${whole.length} of ${o.frames} frames came: ` +
        (pico.core.PC === stop ? 'the program ended' : `${o.seconds} seconds were over`));
    process.exit(1);
}
