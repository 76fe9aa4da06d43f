/* The prebuilt show of the Pico with a model put into its flash, as the image that a board boots and as the file that
 * is dragged onto it.
 *
 * UF2 (github.com/microsoft/uf2, "File format"): blocks of 512 bytes, words least significant byte first.
 *
 * SPDX-License-Identifier: MIT
 */
import { packed } from './wasm.js';

const FLASH = 0x10000000,
    FLASH_BYTES = 2 << 20;
const PAYLOAD = 256,
    BLOCK = 512;
const FAMILY_RP2040 = 0xe48bff56,
    FLAG_FAMILY = 0x2000;

/** The show as make web built it: {image: Uint8Array from the start of flash, symbols: addresses by name, arena: bytes
 * of RAM for pools}. */
export async function prebuilt() {
    const bytes = await packed('show'),
        n = new DataView(bytes).getUint32(0, true);
    return {
        ...JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, n))),
        image: new Uint8Array(bytes, 4 + n),
    };
}

/** Bytes of flash that a model may take. */
export const flashLeft = (show) => FLASH + FLASH_BYTES - show.symbols.show_model;

/** The show's flash with a model in it, from engine.flash. Throws a sentence where the show lacks what it names. */
export function imageWith(show, model) {
    if (model.base !== show.symbols.show_model) throw new Error('the show in this page is of another version');
    const from = model.base - FLASH,
        image = new Uint8Array(from + model.bytes.length).fill(255);
    image.set(show.image);
    image.set(model.bytes, from);
    const view = new DataView(image.buffer, from),
        lacks = new Set();
    for (const [at, name, effect] of model.names) {
        if (show.symbols[name] === undefined) lacks.add(effect || name);
        else view.setUint32(at, show.symbols[name], true);
    }
    if (lacks.size > 0)
        throw new Error(
            `the prebuilt show lacks ${[...lacks].join(', ')}; leave it out, or make a project with zsim new`,
        );
    return {
        image,
        parts: [
            [0, show.image.length],
            [from, model.bytes.length],
        ],
    };
}

/** A UF2 file of an image: of its parts, [from, bytes], whole blocks. */
export function uf2Of({ image, parts }) {
    const places = parts.flatMap(([from, bytes]) =>
        Array.from({ length: Math.ceil(bytes / PAYLOAD) }, (_, i) => from + i * PAYLOAD),
    );
    const file = new Uint8Array(places.length * BLOCK);
    places.forEach((at, i) => {
        const head = new DataView(file.buffer, i * BLOCK, BLOCK);
        [0x0a324655, 0x9e5d5157, FLAG_FAMILY, FLASH + at, PAYLOAD, i, places.length, FAMILY_RP2040].forEach((word, k) =>
            head.setUint32(4 * k, word, true),
        );
        file.set(image.subarray(at, at + PAYLOAD), i * BLOCK + 32);
        head.setUint32(BLOCK - 4, 0x0ab16f30, true);
    });
    return file;
}
