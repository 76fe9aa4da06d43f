// A Raspberry Pi Pico around rp2040js: it boots a flash image through its second stage, with a panel's wire of real
// speed on SPI0. What the emulator leaves out is added here, and what a real chip would not forgive is a problem:
//
//   - words take their bits' time on the wire (and a gap, if asked for); the transmit FIFO empties at that rate
//   - D/C, CS and RESET stay as they are while a word is on the wire; CS is low; word length changes while SPI0 is idle
//     and off
//   - division results are read no sooner than eight cycles after the operands; an interrupt leaves the divider as it
//   was
//   - resets reset SPI0; DMA aborts can be waited for; WFI returns when an interrupt is pending, masked or not, but in
//     a handler for those of higher priority alone
//   - every register that is used is known
//   - a second core, once it is started: second.mjs
//
// Cycles are the Cortex-M0+'s, from the emulator's table: no bus contention (DMA, the other core), interrupts enter and
// leave at no cost, and flash is read without waiting unless { xip: true } asks for the model of xip.mjs. They are a
// lower bound.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

import { RP2040 } from 'rp2040js';

import { read_elf } from './elf.mjs';
import { Second } from './second.mjs';
import { Xip } from './xip.mjs';

const STAGE2_AT = 0x20041f00; // where the boot ROM copies the second stage
const FLASH = 0x10000000, RAM = 0x20000000;
const FLASH_BYTES = 2 << 20, RAM_BYTES = 264 << 10; // of the board
const WFI = 0xbf30, WFE = 0xbf20; // opcodes
export const CYCLE_NS = 8;    // at 125 MHz
const PIN = { cs: 17, dc: 20, reset: 21 };
const SPI0_RESET = 1 << 16;
const PAINT = 0xa5a5a5a5;
const LOOK_CYCLES = 1e7;      // some tenths of a second of this machine's
const TIME_MAX_S = 60;        // nothing in the tests takes a minute: a longer sleep is one without an end

// Registers that the emulator does not have and that need none: UARTDMACR, its DMA is always on.
const HARMLESS = /^UART0: Unimplemented peripheral write to 0x48/;

// The emulator's chip, in less time.
class Chip extends RP2040 {
    // All of its 16 MB of flash would be filled.
    reset() {
        this.core.reset();
        this.pwm.reset();
        this.flash.fill(0xff, 0, FLASH_BYTES);
    }

    // Asked at each write of a word: in RAM there is none.
    findPeripheral(address) {
        return address >= RAM && address < RAM + RAM_BYTES ? undefined : super.findPeripheral(address);
    }
}

// What went over the wire.
class Words {
    constructor() {
        this.words = new Uint16Array(1 << 19);
        this.length = 0;
    }

    push(word) {
        if (this.length === this.words.length) {
            const { words } = this;
            this.words = new Uint16Array(2 * words.length);
            this.words.set(words);
        }
        this.words[this.length++] = word;
    }

    from(first = 0) {
        return this.words.subarray(first, this.length);
    }
}

export class Pico {
    constructor(stem, { gap_ns = 0, doze_ns = 0, second = '', xip = false, most_s = TIME_MAX_S,
        real_s = Infinity } = {}) {
        this.elf = read_elf(`${stem}.elf`);
        this.gap_ns = gap_ns;
        this.most_ns = most_s * 1e9;
        this.latest = Date.now() + real_s * 1000; // of this machine's time
        this.look_at = LOOK_CYCLES;               // what a core has run when all this is looked at
        this.doze_ns = doze_ns; // passes before each WFI (WFE, with two cores), as if what is waited for came just then
        this.problems = [];
        this.text = '';
        this.stream = new Words(); // as run.mjs writes them
        this.busy_ns = 0;
        this.spi = { hz: 0, mode0: false }; // as the last word found it
        this.holding = false; // true: words that begin do not end
        this.stalled = false; // a word waits for holding to end
        const chip = new Chip();
        chip.logger = {
            debug() {},
            info: (who, what) => { if (what === 'SEV') this.second.send_event(); },
            warn: (who, what) => this.#complain(`${who}: ${what}`),
            error: (who, what) => this.#complain(`${who}: ${what}`),
        };
        this.chip = chip;
        this.clock = chip.clock;
        this.core = chip.core;
        this.prepare(this.core);
        chip.flash.set(fs.readFileSync(`${stem}.bin`), 0);
        chip.uart[0].onByte = (byte) => { this.text += String.fromCharCode(byte); };
        this.#wire();
        this.second = new Second(this, second);
        if (xip) {
            this.xip = new Xip();
            this.xip.watch(this.core);
            this.xip.watch(this.second.core);
        }
        this.#dma();
        this.#resets();
    }

    // What is known of a core besides; set of both in one order, or they are of two kinds to the compiler of the
    // emulator's code, which then takes longer.
    prepare(core) {
        core.ran = 0; // cycles
        core.at = 0;  // ns, where two cores run: when its next instruction begins
        core.dozes = 0;
        core.slept = false;
        ({ exceptionEntry: core.exceptionEntry, exceptionReturn: core.exceptionReturn } = core);
    }

    problem(what) {
        if (!this.problems.includes(what))
            this.problems.push(what);
    }

    #complain(what) {
        if (!HARMLESS.test(what))
            this.problem(`emulator: ${what}`);
    }

    // ---- SPI0 and the panel's pins

    #wire() {
        const { chip } = this, spi = chip.spi[0];
        this.level = { cs: 1, dc: 1, reset: 1 };
        this.done = chip.clock.createAlarm(() => this.#word_ends());
        for (const name of ['cs', 'dc', 'reset'])
            chip.gpio[PIN[name]].addListener((value) => this.#pin(name, value === 1 ? 1 : 0));
        spi.onTransmit = (value) => this.#word_begins(value);
        const write = spi.writeUint32.bind(spi);
        spi.writeUint32 = (offset, value) => {
            if (offset === 0 && value !== spi.control0 && (spi.control1 & 2 || spi.busy))
                this.problem('SSPCR0 is changed while SPI0 is on or busy');
            if (offset === 4 && !(value & 2) && (spi.busy || !spi.txFIFO.empty))
                this.problem('SPI0 is switched off while it sends');
            write(offset, value);
        };
    }

    #pin(name, level) {
        if (this.level[name] === level)
            return;
        if (this.chip.spi[0].busy)
            this.problem(`${name} changes while a word is on the wire`);
        this.level[name] = level;
        if (name === 'cs' && level)
            this.#mark(1 << 11);
        if (name === 'reset' && !level)
            this.#mark(1 << 9);
    }

    #mark(bit) {
        this.stream.push(bit);
        if (bit === 1 << 11)
            this.on_release?.();
    }

    mark_picture() {
        this.#mark(1 << 10);
    }

    #word_begins(value) {
        const { level, stream } = this, spi = this.chip.spi[0], bits = spi.dataBits, hz = spi.clockFrequency;
        if (level.cs)
            this.problem('a word begins while CS is high');
        if (!level.reset)
            this.problem('a word begins while RESET is low');
        if (!spi.enabled)
            this.problem('a word begins while SPI0 is off');
        this.spi.hz = hz;
        this.spi.mode0 = !(spi.control0 & 0xc0);
        const dc = level.dc ? 0x100 : 0;
        if (bits === 16)
            stream.push(value >> 8 | dc);
        if (bits === 16 || bits === 8)
            stream.push(value & 0xff | dc);
        else
            this.problem(`words of ${bits} bits`);
        if (this.holding) {
            this.stalled = true;
            return;
        }
        const ns = bits * 1e9 / hz + this.gap_ns;
        this.busy_ns += ns;
        this.done.schedule(ns);
    }

    #word_ends() {
        this.chip.spi[0].completeTransmit(0);
    }

    release() {
        this.holding = false;
        if (this.stalled && this.chip.spi[0].busy)
            this.#word_ends();
        this.stalled = false;
    }

    // ---- What the emulator leaves out

    // What reads a core's own divider: no result before its time.
    divider(sio, core_of) {
        const update = sio.updateHardwareDivider.bind(sio), read = sio.readUint32.bind(sio);
        const ready = () => core_of().ran - since >= 8;
        let since = 0;
        sio.updateHardwareDivider = (signed) => {
            since = core_of().ran;
            update(signed);
        };
        return (offset) => {
            if ((offset === 0x70 || offset === 0x74) && !ready())
                this.problem('a division is read before its eight cycles are over');
            return offset === 0x78 ? read(offset) & ~1 | ready() : read(offset); // DIV_CSR
        };
    }

    // A handler may divide where it puts the divider back: what it interrupts may be about to read a result.
    guard_divider(core, unit) {
        const { exceptionEntry, exceptionReturn } = core, before = [];
        const state = () => [unit.divDividend, unit.divDivisor, unit.divQuotient, unit.divRemainder]
            .map((value) => Math.trunc(value) >>> 0).join();
        core.exceptionEntry = (number) => {
            before.push(state());
            exceptionEntry.call(core, number);
        };
        core.exceptionReturn = (how) => {
            exceptionReturn.call(core, how);
            if (before.pop() !== state())
                this.problem('an interrupt leaves the divider changed');
        };
    }

    #dma() {
        const { dma } = this.chip;
        const read = dma.readUint32.bind(dma);
        dma.readUint32 = (offset) => offset === 0x444 ? 0 : read(offset); // CHAN_ABORT: done at once
    }

    #resets() {
        const { chip } = this, block = chip.peripherals[0x4000c], spi = chip.spi[0];
        const write = block.writeUint32.bind(block), read = block.readUint32.bind(block);
        block.writeUint32 = (offset, value) => {
            write(offset, value);
            if (offset === 0 && value & SPI0_RESET) {
                this.done.cancel();
                this.stalled = false;
                spi.busy = false;
                spi.txFIFO.reset();
                spi.rxFIFO.reset();
                spi.control0 = spi.control1 = spi.clockDivisor = spi.dmaControl = spi.intEnable = 0;
                spi.fifosUpdated();
            }
        };
        block.readUint32 = (offset) => offset === 8 ? ~block.reset & 0x1ffffff : read(offset);
    }

    // ---- Running

    // As the boot ROM does: the second stage to RAM, and into it.
    boot() {
        const { chip, core } = this;
        chip.sram.set(chip.flash.subarray(0, 256), STAGE2_AT - RAM);
        core.LR = 0;
        core.SP = STAGE2_AT;
        core.PC = STAGE2_AT;
    }

    // One instruction of core 0, or its sleep until the next event; with what core 1 does before it. Returns the cycles
    // of core 0; 0 for a sleep.
    step() {
        if (this.second.runs || this.two)
            return this.#step_two();
        const { core, clock } = this;
        if (core.waiting) {
            if (this.#interrupted(core)) {
                core.waiting = false;
                return 0;
            }
            this.#sleep();
            return 0;
        }
        if (this.doze_ns && this.chip.readUint16(core.PC) === WFI)
            clock.tick(this.doze_ns);
        const cycles = this.#execute(core);
        this.#pass(clock.nanosCounter + cycles * CYCLE_NS);
        return cycles;
    }

    // What ends a sleep: in a handler, only what could interrupt it.
    #interrupted(core) {
        const pending = core.pendingInterrupts & core.enabledInterrupts;
        if (!pending || !core.IPSR)
            return pending;
        const own = core.exceptionPriority(core.IPSR);
        return core.interruptPriorities.some((which, priority) => priority < own && which & pending);
    }

    #sleep() {
        const { clock } = this;
        if (!clock.nextAlarm || clock.nanosCounter > this.most_ns)
            throw new Error('asleep, and nothing will wake it');
        clock.tick(clock.nanosToNextAlarm);
    }

    #execute(core) {
        const cycles = core.executeInstruction() + (this.xip?.waited() ?? 0);
        core.ran += cycles;
        if (core.ran > this.look_at)
            this.#end_in_time(core.ran);
        return cycles;
    }

    #end_in_time(ran) {
        if (ran > this.most_ns / CYCLE_NS || Date.now() > this.latest)
            throw new Error('does not end');
        this.look_at = ran + LOOK_CYCLES;
    }

    // Let it be `now`, ns; what was to come before comes.
    #pass(now) {
        const { clock } = this, { nextAlarm } = clock;
        if (nextAlarm && nextAlarm.nanos <= now)
            clock.tick(now - clock.nanosCounter);
        else
            clock.nanosCounter = now;
    }

    // The core whose next instruction begins first has its turn; the clock stands where that begins. on_second gets the
    // address and cycles of core 1's.
    #step_two() {
        const { core, clock, chip, second } = this;
        if (this.two !== second.runs) { // core 1 was started, or stopped
            if (second.runs)
                core.at = clock.nanos;
            else if (!core.waiting)
                this.#pass(Math.max(core.at, clock.nanos));
            this.two = second.runs;
            return 0;
        }
        for (;;) {
            const other = second.core;
            this.#wake(core);
            this.#wake(other);
            if (core.waiting && other.waiting) {
                this.#sleep();
                return 0;
            }
            const turn = core.waiting || (!other.waiting && other.at <= core.at) ? other : core;
            const at = turn.PC & ~1; // it is odd in what interrupts enter
            if (this.doze_ns && turn.dozes !== at && [WFI, WFE].includes(chip.readUint16(at))) {
                turn.dozes = at; // all else goes on
                turn.at += this.doze_ns;
                this.#pass(this.#earlier(core, other));
                continue;
            }
            turn.dozes = 0;
            chip.core = turn;
            const cycles = this.#execute(turn);
            chip.core = core;
            turn.at += cycles * CYCLE_NS;
            turn.slept = turn.waiting;
            const awake = core.waiting && other.waiting ? turn.at : this.#earlier(core, other);
            this.#pass(Math.max(awake, clock.nanosCounter));
            if (turn === core)
                return cycles;
            this.on_second?.(at, cycles);
            if (core.waiting || !second.runs)
                return 0;
        }
    }

    // When the next instruction begins of those that are awake; one is.
    #earlier(core, other) {
        if (core.waiting || other.waiting)
            return core.waiting ? other.at : core.at;
        return Math.min(core.at, other.at);
    }

    // What has woken goes on from now.
    #wake(core) {
        if (core.waiting && this.#interrupted(core))
            core.waiting = false;
        if (core.slept && !core.waiting) {
            core.slept = false;
            core.at = Math.max(core.at, this.clock.nanos);
        }
    }

    u32(symbol) {
        const address = this.elf.symbols[symbol];
        return this.chip.readUint32(address);
    }

    // A word of the flash image.
    patch(symbol, index, value) {
        this.chip.flashView.setUint32(this.elf.symbols[symbol] - FLASH + 4 * index, value, true);
    }

    ram_index(symbol) {
        return this.elf.symbols[symbol] - RAM;
    }

    // core: 0, 1
    stack_used(core = 0) {
        const [limit, top] = this.#stack(core);
        let at = limit;
        while (at < top && this.chip.readUint32(at) === PAINT)
            at += 4;
        return top - at;
    }

    stack_reserve(core) {
        const [limit, top] = this.#stack(core);
        return top - limit;
    }

    #stack(core) {
        const { symbols } = this.elf, which = core ? '__stack1' : '__stack';
        return [symbols[`${which}_limit`], symbols[`${which}_top`]];
    }

    sizes() {
        const n = this.elf.bytes_of;
        return {
            flash: n['.boot2'] + n['.vectors'] + n['.text'] + (n['.ARM.exidx'] ?? 0) + n['.data'],
            ram: n['.stack'] + n['.data'] + n['.bss'],
        };
    }
}
