/* STL, binary and text. A face has no colour and no shared vertices; equal positions are welded by the engine.
 *
 * SPDX-License-Identifier: MIT
 */
import { BadModel, Corners } from './read_text.js';

function isBinary(bytes) {
    if (bytes.length < 84) return false;
    const n = new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
    if (84 + 50 * n === bytes.length) return true;
    return String.fromCharCode(...bytes.subarray(0, 5)).toLowerCase() !== 'solid';
}

function readBinary(name, bytes, corners) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const n = view.getUint32(80, true),
        takes = 84 + 50 * n;
    if (takes > bytes.length)
        throw new BadModel(
            name,
            0,
            `cut off: ${n} faces take ${takes} bytes, it has ${bytes.length}; get the whole file`,
        );
    for (let t = 0; t < n; t++) {
        const face = [];
        for (let k = 0; k < 3; k++) {
            const at = 84 + 50 * t + 12 + 12 * k;
            const p = [0, 4, 8].map((i) => view.getFloat32(at + i, true));
            if (!p.every(Number.isFinite))
                throw new BadModel(
                    name,
                    0,
                    `face ${t + 1} has a coordinate that is not finite; export the model again`,
                );
            face.push(corners.vertex(p.join(), p));
        }
        corners.polygon(face, 0);
    }
}

function readText(name, text, corners) {
    let face = [];
    const lines = text.split(/\r\n|\n|\r/);
    for (let line = 0; line < lines.length; line++) {
        const word = lines[line].trim().split(/\s+/);
        if (word[0] === 'vertex') {
            const p = word.slice(1, 4).map((w) => Math.fround(Number(w)));
            if (p.length < 3 || !p.every(Number.isFinite))
                throw new BadModel(
                    name,
                    line + 1,
                    `'${lines[line].trim().slice(0, 40)}' is not a vertex of three numbers`,
                );
            face.push(corners.vertex(p.join(), p));
        } else if (word[0] === 'endloop') {
            if (face.length < 3)
                throw new BadModel(name, line + 1, `a face of ${face.length} vertices; it needs at least 3`);
            corners.polygon(face, 0);
            face = [];
        }
    }
    if (!/endsolid[^\n]*\s*$/.test(text))
        throw new BadModel(name, 0, 'cut off: its last line is not `endsolid`; get the whole file');
}

/** Read an STL. @param {string} name @param {Uint8Array} bytes @return what engine.setModel takes */
export function readStl(name, bytes) {
    const corners = new Corners();
    if (bytes.length < 84 && !/^\s*solid/.test(String.fromCharCode(...bytes)))
        throw new BadModel(name, 0, `cut off: ${bytes.length} bytes are no STL file; get the whole file`);
    if (isBinary(bytes)) readBinary(name, bytes, corners);
    else readText(name, new TextDecoder().decode(bytes), corners);
    if (corners.indices.length === 0) throw new BadModel(name, 0, 'no faces in it');
    return corners.model(name);
}
