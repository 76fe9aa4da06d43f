/* What lies compressed as base64 in elements of the page: the engine, and what is only read on request.
 * SPDX-License-Identifier: MIT */

/** An ArrayBuffer of an element, by its id. */
export async function packed(id) {
    const text = document.getElementById(id).textContent;
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    return new Response(stream).arrayBuffer();
}
