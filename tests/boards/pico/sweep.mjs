// node sweep.mjs STEM: boot the image of sweep.c and do to its transfers what it asks for. Prints its text; "swept K N
// ASLEEP", of N rounds of a kind, how many found the core asleep already; "problem ..." for each problem.
//
// SPDX-License-Identifier: MIT
import { alone } from './alone.mjs';
import { Pico } from './pico.mjs';

const NONE = 0, DONE = 1, TIMEOUT = 2, BOTH = 3, SPURIOUS = 4, WRAP = 5; // enum sweep of sweep.c
const TIMER_IRQ = 0, DMA_IRQ = 11, CTRL_TRIG = 0x0c;
const WRAP_NS = 2 ** 32 * 1000;

export function run([stem]) {
    const pico = new Pico(stem);
    const { chip, core, clock } = pico, { dma } = chip, spi = chip.spi[0];
    const next = pico.elf.symbols.sweep_next & ~1, stop = pico.elf.symbols.hal_exit & ~1;
    const swept = Array.from({ length: 6 }, () => ({ rounds: 0, asleep: 0 }));
    let kind = NONE, place = 0, since = -1; // instructions since the transfer's start; -1: none was started
    let held = false;                       // the DMA's interrupt waits for its place
    let begins = 0;                         // of the round's words in the stream

    const forward = chip.setInterrupt.bind(chip);
    chip.setInterrupt = (irq, value) => {
        if (irq === DMA_IRQ && value && (kind === DONE || kind === BOTH) && since <= place) {
            held = true;
            return;
        }
        forward(irq, value);
    };

    const write = dma.writeUint32.bind(dma);
    dma.writeUint32 = (offset, value) => {
        write(offset, value);
        if (offset % 0x40 === CTRL_TRIG && offset < 0x300 && kind !== NONE && since < 0)
            since = 0;
    };

    // The timer's own time, ahead of the emulator's clock: moving that would have all else catch up.
    const timer = chip.peripherals[0x40054];
    let ahead = 0; // ns
    timer.clock = { get nanos() { return clock.nanos + ahead; } };

    function strike() {
        const done = kind;
        kind = NONE;
        swept[done].rounds++;
        swept[done].asleep += core.waiting ? 1 : 0;
        if (done !== DONE && done !== SPURIOUS)
            forward(TIMER_IRQ, true);
        if (done === SPURIOUS || (done !== TIMEOUT && held))
            forward(DMA_IRQ, true);
    }

    // What went over the wire since the last call: pixels of a round that was not broken off, then those of the good
    // one.
    function look() {
        const words = [...pico.stream.from(begins)].filter((word) => word < 0x200);
        begins = pico.stream.length;
        const ends = [0x2c, 0x101, 0x101, 0x102, 0x103, 0x104, 0x105, 0x106].join();
        if (words.length && words.slice(-8).join() !== ends && !words.every((word, i) => word === 0x100 + i + 1))
            pico.problem(`on the wire: ${words.map((word) => word.toString(16)).join(' ')}`);
    }

    function asked() {
        const [what, where] = core.registers;
        if (what === WRAP) { // to come in so many ns
            ahead = (Math.floor(timer.clock.nanos / WRAP_NS) + 1) * WRAP_NS - where * 8 - clock.nanos;
            swept[WRAP].rounds++;
            return;
        }
        if (what !== NONE)
            look();
        kind = what;
        place = where;
        since = -1;
        held = false;
        pico.holding = what === TIMEOUT;
    }

    pico.boot();
    while (core.PC !== stop) {
        if (core.PC === next)
            asked();
        if (since >= 0 && kind !== NONE && (since++ === place || (core.waiting && place < 1000)) &&
            (held || (kind !== DONE && kind !== BOTH)))
            strike();
        else if (since > place && held && kind !== NONE)
            strike(); // the transfer ended later than its place
        pico.step();
        if (pico.holding && !spi.busy && since >= 0 && kind === NONE) // the bus was reset
            pico.release();
    }
    look();
    const lines = swept.map((s, k) => `swept ${k} ${s.rounds} ${s.asleep}\n`).slice(1);
    return pico.text + lines.join('') + pico.problems.map((problem) => `problem ${problem}\n`).join('');
}
alone(import.meta.url, run);
