/* What lies compressed in elements of the page: the engine, and what is only read on request. Four bytes are five
 * characters, digits to base 85 from the highest down, from '(' on; 0 is '(' and 84 is '|', '<' is '~' (bundle.mjs).
 * SPDX-License-Identifier: MIT */

/* The bytes of such a text; the last group may have fewer. */
function bytesOf(text) {
    const out = new Uint8Array(Math.floor((text.length * 4) / 5)),
        digit = new Uint8Array(128);
    for (let d = 0; d < 85; d++) digit[d + 40] = d;
    digit[126] = 60 - 40;
    for (let i = 0, at = 0; i < text.length; i += 5) {
        let word = 0;
        for (let k = 0; k < 5; k++) word = word * 85 + (i + k < text.length ? digit[text.charCodeAt(i + k)] : 84);
        word = Math.min(word, 0xffffffff); // a last group may be filled up beyond that
        for (let shift = 24; shift >= 0 && at < out.length; shift -= 8) out[at++] = word >>> shift;
    }
    return out;
}

/** An ArrayBuffer of an element, by its id. */
export async function packed(id) {
    const bytes = bytesOf(document.getElementById(id).textContent);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    return new Response(stream).arrayBuffer();
}
