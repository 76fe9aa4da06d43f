// The RP2040's second core for pico.mjs: another CortexM0Core on the same chip, and what of the chip is each core's
// own: CPUID, divider, interpolators, the two FIFOs between the cores with their status and interrupt. SEV reaches both
// cores. The power-on state machine holds core 1 in reset or lets the boot ROM's side of the launch begin: it empties
// its FIFO, sends a 0, and then answers each word by the same, when an event wakes it; after 0, 0, 1 a vector table, a
// stack and an entry start the core.
//
// What a real chip would not forgive is a problem: a full FIFO written to, an empty one read, a table, stack or entry
// that cannot be one. A word that the ROM is not woken for stays unread.
//
// Not modelled: cores that wait for each other at a bank of RAM or at the flash, SysTick of core 1.
//
// mode: '' as it should; 'dead' core 1 never answers; 'garble' its fourth answer is wrong, once
//
// SPDX-License-Identifier: MIT
const WFE = 0xbf20;           // opcode
const PROC1 = 1 << 16;        // of PSM FRCE_OFF
const SIO_IRQ = 15;           // core 0's; core 1's is the next
const FIFO_WORDS = 8;
const RESET_NS = 20000, ANSWER_NS = 400; // of the ROM: assumed
const OWN = [0x60, 0x100];    // registers of SIO that each core has for itself: divider and interpolators

export class Second {
    constructor(pico, mode) {
        this.pico = pico;
        this.chip = pico.chip;
        this.mode = mode;
        this.first = pico.chip.core;
        this.runs = false;
        this.rom = { waits: mode !== 'dead', step: 0, words: [], answers: 0 };
        this.fifo = [mode === 'dead' ? [] : [0], []]; // by the core that reads
        this.sticky = [0, 0];
        this.alarm = pico.clock.createAlarm(() => this.#rom_answers());
        this.#fresh();
        this.#sio();
        pico.guard_divider(this.first, this.units[0]);
        this.#psm();
        const chip = this.chip;
        chip.setInterrupt = (irq, value) => {
            this.first.setInterrupt(irq, value);
            this.core.setInterrupt(irq, value);
        };
    }

    #fresh() {
        this.core = new this.first.constructor(this.chip);
        this.pico.prepare(this.core);
    }

    // Core 1 stands still from here on, whatever it is at; reset alone helps.
    stop() {
        this.runs = false;
        this.rom.waits = false;
        this.mode = 'dead';
    }

    fault() {
        if (!this.core.IPSR)
            this.core.exceptionEntry(3);
    }

    // ---- SIO

    #sio() {
        const { sio } = this.chip, other = new sio.constructor(this.chip);
        this.units = [sio, other];
        const read = [sio, other].map((unit, i) => this.pico.divider(unit, () => this.#core_of(i)));
        const write = [sio, other].map((unit) => unit.writeUint32.bind(unit));
        const unit_for = (offset) => offset >= OWN[0] && offset < OWN[1] && this.chip.core === this.core ? 1 : 0;
        sio.readUint32 = (offset) => {
            switch (offset) {
            case 0: return this.#me();
            case 0x50: return this.#status();
            case 0x58: return this.#pop();
            default: return read[unit_for(offset)](offset);
            }
        };
        sio.writeUint32 = (offset, value) => {
            if (offset === 0x50)
                this.sticky[this.#me()] = 0;
            else if (offset === 0x54)
                this.#push(this.#me(), value);
            else
                write[unit_for(offset)](offset, value);
            this.#interrupts();
        };
    }

    #core_of(i) {
        return i ? this.core : this.first;
    }

    #me() {
        return this.chip.core === this.core ? 1 : 0;
    }

    #status() {
        const me = this.#me();
        return (this.fifo[me].length ? 1 : 0) | (this.fifo[1 - me].length < FIFO_WORDS ? 2 : 0) | this.sticky[me];
    }

    #push(me, value) {
        if (this.fifo[1 - me].length === FIFO_WORDS) {
            this.sticky[me] |= 4;
            this.pico.problem(`core ${me} writes to a full FIFO`);
        } else {
            this.fifo[1 - me].push(value >>> 0);
        }
    }

    #pop() {
        const me = this.#me();
        if (!this.fifo[me].length) {
            this.sticky[me] |= 8;
            this.pico.problem(`core ${me} reads an empty FIFO`);
        }
        const word = this.fifo[me].shift() ?? 0;
        this.#interrupts();
        return word;
    }

    #interrupts() {
        for (const i of [0, 1])
            this.#core_of(i).setInterrupt(SIO_IRQ + i, this.fifo[i].length > 0 || this.sticky[i] > 0);
    }

    // ---- Events

    #event(core) {
        if (core.waiting && this.chip.readUint16((core.PC & ~1) - 2) === WFE)
            core.waiting = false;
        else
            core.eventRegistered = true;
    }

    // SEV, by either core
    send_event() {
        this.#event(this.first);
        if (this.runs)
            this.#event(this.core);
        else if (this.rom.waits)
            this.alarm.schedule(ANSWER_NS);
    }

    // ---- Reset and launch

    #psm() {
        const block = this.chip.peripherals[0x40010], write = block.writeUint32.bind(block);
        block.writeUint32 = (offset, value) => {
            const was = block.frceOff;
            write(offset, value);
            if (block.frceOff & ~PROC1)
                this.pico.problem('more than core 1 is switched off');
            if (block.frceOff & PROC1) {
                this.runs = this.rom.waits = false;
                this.alarm.cancel();
            } else if (was & PROC1 && this.mode !== 'dead') {
                this.rom = { waits: true, step: -1, words: [], answers: this.rom.answers };
                this.alarm.schedule(RESET_NS);
            }
        };
    }

    #rom_answers() {
        const { rom, fifo } = this;
        if (rom.step < 0) {
            fifo[1].length = 0;
            rom.step = 0;
            this.#push(1, 0);
        } else if (fifo[1].length) {
            const word = fifo[1].shift(), garbled = this.mode === 'garble' && ++rom.answers === 4;
            this.#push(1, garbled ? ~word : word);
            this.#take(word, garbled);
        }
        this.#interrupts();
        this.#event(this.first);
        if (rom.waits && fifo[1].length)
            this.alarm.schedule(ANSWER_NS);
    }

    #take(word, garbled) {
        const { rom } = this;
        if (garbled || (rom.step < 3 && word !== [0, 0, 1][rom.step])) {
            rom.step = !garbled && word === 0 ? Math.max(rom.step, 1) : 0;
            rom.words = [];
        } else if (++rom.step > 3) {
            rom.words.push(word);
        }
        if (rom.words.length === 3)
            this.#launch(...rom.words);
    }

    #launch(table, stack, entry) {
        if (table & 0xff || stack & 7 || !(entry & 1))
            this.pico.problem(`core 1 is started with ${[table, stack, entry].map((word) => word.toString(16))}`);
        this.#fresh();
        this.core.VTOR = table;
        this.core.SP = stack;
        this.core.PC = entry & ~1;
        this.core.at = this.pico.clock.nanos;
        this.rom.waits = false;
        this.runs = true;
    }
}
