/* engine.wasm out of the page itself, where it lies compressed as base64. SPDX-License-Identifier: MIT */

export async function wasmBytes() {
    const text = document.getElementById('wasm').textContent;
    const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
    return new Response(stream).arrayBuffer();
}
