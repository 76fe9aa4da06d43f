/* A Raspberry Pi Pico that shows frames, around rp2040js: a flash image, SPI0 with a panel's wire of real speed, and
 * the words that the panel gets.
 *
 * What the emulator leaves out, and an image needs, is added here: words take their time on the wire; resets reset
 * SPI0; DMA aborts can be waited for; WFI returns when an interrupt is pending, masked or not. Cycles are the
 * Cortex-M0+'s by the emulator's table, without waits for the bus or for flash: a lower bound.
 *
 * SPDX-License-Identifier: MIT
 */
import { RP2040 } from 'rp2040js';

const RAM = 0x20000000,
    FLASH = 0x10000000,
    STAGE2_AT = 0x20041f00; /* where the boot ROM copies the second stage */
const CYCLE_NS = 8; /* at 125 MHz */
const PIN = { cs: 17, dc: 20, reset: 21 }; /* hal/rp2040/pins.h */
const SPI0_RESET = 1 << 16;
const PHASE_DRAW = 1; /* enum show_phase of firmware/app/show.c */
const ASLEEP_MOST_NS = 10e9;

/* Bits of a word of the stream, beside its byte: D/C; RESET went low; CS went high */
const DATA = 0x100,
    RESET = 0x200,
    DESELECT = 0x800;

export class Board {
    /** image: Uint8Array from the start of flash. symbols: addresses of the show's, by name. */
    constructor(image, symbols) {
        const chip = new RP2040();
        const quiet = () => {};
        chip.logger = { debug: quiet, info: quiet, warn: quiet, error: quiet };
        this.chip = chip;
        this.symbols = symbols;
        this.stream = [];
        this.text = '';
        this.cycles = 0; /* of drawing */
        this.selected = false; /* CS is low */
        chip.flash.set(image, 0);
        chip.uart[0].onByte = (byte) => (this.text += String.fromCharCode(byte));
        this.#wire();
        this.#dma();
        this.#resets();
        /* as the boot ROM does: the second stage to RAM, and into it */
        chip.sram.set(chip.flash.subarray(0, 256), STAGE2_AT - RAM);
        chip.core.SP = STAGE2_AT;
        chip.core.PC = STAGE2_AT;
    }

    /** A word of the flash image, before it runs. */
    patch(symbol, index, value) {
        this.chip.flashView.setUint32(this.symbols[symbol] - FLASH + 4 * index, value, true);
    }

    #wire() {
        const { chip } = this,
            spi = chip.spi[0];
        const level = { cs: 1, dc: 1, reset: 1 };
        this.done = chip.clock.createAlarm(() => spi.completeTransmit(0));
        for (const name of Object.keys(PIN))
            chip.gpio[PIN[name]].addListener((value) => {
                const now = value === 1 ? 1 : 0;
                if (now === level[name]) return;
                level[name] = now;
                if (name === 'cs') {
                    this.selected = !now;
                    if (now) this.stream.push(DESELECT);
                }
                if (name === 'reset' && !now) this.stream.push(RESET);
            });
        spi.onTransmit = (value) => {
            const dc = level.dc ? DATA : 0;
            if (spi.dataBits === 16) this.stream.push((value >> 8) | dc);
            this.stream.push((value & 0xff) | dc);
            this.done.schedule((spi.dataBits * 1e9) / spi.clockFrequency);
        };
    }

    #dma() {
        const { dma } = this.chip,
            read = dma.readUint32.bind(dma);
        dma.readUint32 = (offset) => (offset === 0x444 ? 0 : read(offset)); /* CHAN_ABORT: done at once */
    }

    #resets() {
        const { chip } = this,
            block = chip.peripherals[0x4000c],
            spi = chip.spi[0];
        const write = block.writeUint32.bind(block),
            read = block.readUint32.bind(block);
        block.writeUint32 = (offset, value) => {
            write(offset, value);
            if (offset !== 0 || !(value & SPI0_RESET)) return;
            this.done.cancel();
            spi.busy = false;
            spi.txFIFO.reset();
            spi.rxFIFO.reset();
            spi.control0 = spi.control1 = spi.clockDivisor = spi.dmaControl = spi.intEnable = 0;
            spi.fifosUpdated();
        };
        block.readUint32 = (offset) => (offset === 8 ? ~block.reset & 0x1ffffff : read(offset));
    }

    /* One instruction, or the sleep until the next event. Returns its cycles. */
    #step() {
        const { core, clock } = this.chip;
        if (core.waiting) {
            if (core.pendingInterrupts & core.enabledInterrupts) {
                core.waiting = false;
                return 0;
            }
            if (!clock.nextAlarm || clock.nanosToNextAlarm > ASLEEP_MOST_NS)
                throw new Error('the program sleeps, and nothing will wake it');
            clock.tick(clock.nanosToNextAlarm);
            return 0;
        }
        const cycles = core.executeInstruction(),
            now = clock.nanosCounter + cycles * CYCLE_NS;
        if (clock.nextAlarm && clock.nextAlarm.nanos <= now) clock.tick(now - clock.nanosCounter);
        else clock.nanosCounter = now;
        return cycles;
    }

    /** Run until the next picture is on the glass. Returns what the panel got since the last one, the cycles that drew
     * it, and the time that it took. */
    picture() {
        const { core, sram, clock } = this.chip,
            frameEnd = this.symbols.zs_frame_end & ~1,
            stop = this.symbols.hal_exit & ~1,
            phase = this.symbols.show_phase - RAM;
        const begun = clock.nanosCounter;
        let drawn = 0; /* the frame is, and took so many cycles; its last strip may be on the wire */
        for (;;) {
            if (core.PC === frameEnd) {
                drawn = this.cycles;
                this.cycles = 0;
            }
            if (core.PC === stop) throw new Error(this.text.trim().split('\n').at(-1) || 'the program has stopped');
            const cycles = this.#step();
            if (sram[phase] === PHASE_DRAW) this.cycles += cycles;
            if (drawn > 0 && !this.selected) break;
        }
        const words = Uint16Array.from(this.stream);
        this.stream = [];
        return { words, cycles: drawn, ns: clock.nanosCounter - begun };
    }
}
