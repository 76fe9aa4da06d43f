// node cache.mjs: tests of the model of the flash's cache (xip.mjs), a line `ok NAME` or `FAILED NAME: reason` each;
// and what a miss takes, "miss CYCLES".
//
// SPDX-License-Identifier: MIT
import { alone } from './alone.mjs';
import { MISS_CYCLES, Xip } from './xip.mjs';

const FLASH = 0x10000000, WAY = 8192; // bytes after which lines share a set

function misses_of(addresses) {
    const xip = new Xip(), core = { readUint32() {}, readUint16() {}, readUint8() {} };
    xip.watch(core);
    for (const address of addresses)
        core.readUint32(address);
    return [xip.misses, xip.waited(), xip.waited()].join(' ');
}
function test(name, addresses, misses) {
    const got = misses_of(addresses), wanted = `${misses} ${misses * MISS_CYCLES} 0`;
    return got === wanted ? `ok pico_${name}\n` : `FAILED pico_${name}: ${got}, not ${wanted}\n`;
}
const at = (...offsets) => offsets.map((offset) => FLASH + offset);

export function run() {
    return test('cache_word_is_kept', at(0, 0, 2, 3), 1) +
        test('cache_line_is_filled_by_halves', at(0, 4, 0, 4), 2) +
        test('cache_has_two_ways', at(0, WAY, 0, WAY), 2) +
        test('cache_drops_the_older_line', at(0, WAY, 0, 2 * WAY, 0, WAY), 4) +
        test('cache_moved_line_keeps_its_halves', at(0, 4, WAY, 0, 4), 3) +
        test('cache_is_of_flash_alone', [0x20000000, 0x11000000, 0x0ffffffc], 0) +
        `miss ${MISS_CYCLES}\n`;
}
alone(import.meta.url, run);
