/* STL, binary and text. A face has no colour and no shared vertices; equal positions are welded by the engine.
 *
 * SPDX-License-Identifier: MIT
 */
import { BadModel, Corners } from './read_text.js';

function isText(bytes) {
    const head = String.fromCharCode(...bytes.subarray(0, 1024));
    if (bytes.length >= 84) {
        const n = new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
        if (84 + 50 * n === bytes.length) return false;
    }
    return /^[ \t\r\n]*solid/.test(head) && !head.includes('\0');
}

/* A vertex of a solid. */
function notFinite(name, vertex, solid) {
    throw new BadModel(
        name,
        0,
        `vertex ${vertex + 1} of mesh '${solid}' has a coordinate that is not finite; export the model again`,
    );
}

function readBinary(name, bytes, corners) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const n = view.getUint32(80, true),
        takes = 84 + 50 * n;
    const said = `${n} faces take ${takes} bytes, it has ${bytes.length}`;
    if (takes > bytes.length) throw new BadModel(name, 0, `cut off: ${said}; get the whole file`);
    if (n > 0 && takes < bytes.length)
        throw new BadModel(name, 0, `is longer than it says: ${said}; export the model again`);
    for (let t = 0; t < n; t++) {
        const face = [];
        for (let k = 0; k < 3; k++) {
            const at = 84 + 50 * t + 12 + 12 * k;
            const p = [0, 4, 8].map((i) => view.getFloat32(at + i, true));
            if (!p.every(Number.isFinite)) notFinite(name, 3 * t + k, '');
            face.push(corners.vertex(p.join(), p));
        }
        corners.polygon(face, 0);
    }
}

function readText(name, text, corners) {
    let face = [],
        solid = '',
        vertices = 0;
    const lines = text.split(/\r\n|\n|\r/);
    if (text[0] !== 's')
        throw new BadModel(name, 0, 'begins with blanks in place of `solid`; export the model again');
    if (!/(^|[\n\r])[ \t]*endsolid[^\n\r]*\s*$/.test(text))
        throw new BadModel(name, 0, 'cut off: its last line is not `endsolid`; get the whole file');
    for (let line = 0; line < lines.length; line++) {
        const word = lines[line].trim().split(/\s+/);
        if (word[0] === 'solid') {
            solid = word.slice(1).join(' ');
            vertices = 0;
        } else if (word[0] === 'vertex') {
            const p = word.slice(1, 4).map((w) => Math.fround(Number(w)));
            if (p.length === 3 && word.slice(1, 4).some((w) => /^[+-]?(nan|inf)/i.test(w)))
                notFinite(name, vertices, solid);
            vertices++;
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
}

/** Read an STL. @param {string} name @param {Uint8Array} bytes @return what engine.setModel takes */
export function readStl(name, bytes) {
    const corners = new Corners(),
        head = String.fromCharCode(...bytes.subarray(0, 8)),
        plain = /^\xef\xbb\xbf/.test(head) ? bytes.subarray(3) : bytes;
    if (plain !== bytes && isText(plain))
        throw new BadModel(name, 0, 'begins with a UTF-8 byte order mark; save it without one, as by tail -c +4');
    const word = head.replace(/^\xef\xbb\xbf/, '').slice(0, 5);
    if (!isText(bytes) && /^solid$/i.test(word) && !bytes.includes(0))
        throw new BadModel(
            name,
            0,
            `its words are not in small letters (\`${word}\`); write them so, as by tr A-Z a-z`,
        );
    if (isText(bytes)) readText(name, new TextDecoder().decode(bytes), corners);
    else if (bytes.length >= 84) readBinary(name, bytes, corners);
    else throw new BadModel(name, 0, `cut off: ${bytes.length} bytes are no STL file; get the whole file`);
    if (corners.indices.length === 0) throw new BadModel(name, 0, 'no faces in it');
    return corners.model(name);
}
