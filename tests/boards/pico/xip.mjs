// What reading the flash costs an RP2040: a core waits while a word comes over the serial flash. The emulator reads at
// no cost; this is a model of the cache in front of the flash, with a stated cost a miss.
//
//   cache   16 KB, two ways, lines of 8 bytes (RP2040 datasheet, 2.6.3.1). A line is filled by halves: a miss fetches
//           the word of 4 bytes that was asked for (measured by others: pico-feedback, issue 307). The older of two
//           lines goes
//   miss    the clocks of one read as firmware/boards/pico/boot2.S sets it up, "fast read, dual output": 8 of command,
//           24 of address, 8 of pause, 16 of data, each two cycles at 125 MHz: 112 cycles
//
// Not modelled: what two cores that miss at once wait for each other, and the flash chip's own time to select, some
// cycles. Neither has been held against silicon.
//
// SPDX-License-Identifier: MIT
const FLASH = 0x10000000, FLASH_END = 0x11000000; // the mirror that is cached
const SETS = 16384 / 8 / 2;
export const MISS_CYCLES = (8 + 24 + 8 + 16) * 2;

export class Xip {
    constructor() {
        this.line = new Int32Array(2 * SETS).fill(-1); // of a set: the line used last, then the other one
        this.half = new Uint8Array(2 * SETS);          // bits: which words of it are there
        this.misses = 0;
        this.stall = 0; // cycles that the instruction in hand waits
    }

    // Reads of a core, its instructions among them, go by way of the cache.
    watch(core) {
        for (const name of ['readUint32', 'readUint16', 'readUint8']) {
            const read = core[name].bind(core);
            core[name] = (address) => {
                address >>>= 0;
                if (address >= FLASH && address < FLASH_END)
                    this.#look_up(address - FLASH);
                return read(address);
            };
        }
    }

    #look_up(offset) {
        const { line, half } = this, wanted = offset >>> 3, word = 1 << (offset >>> 2 & 1);
        const first = 2 * (wanted % SETS), second = first + 1;
        if (line[first] !== wanted) {
            const words = line[second] === wanted ? half[second] : 0;
            line[second] = line[first];
            half[second] = half[first];
            line[first] = wanted;
            half[first] = words;
        }
        if (half[first] & word)
            return;
        half[first] |= word;
        this.misses++;
        this.stall += MISS_CYCLES;
    }

    // The cycles that were waited since this was asked last.
    waited() {
        const { stall } = this;
        this.stall = 0;
        return stall;
    }
}
