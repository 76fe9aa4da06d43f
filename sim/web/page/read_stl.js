/* STL, binary and text. A face of a binary one may have a colour; equal positions are welded by the engine.
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
    return /^[ \t\r\n]*solid/i.test(head) && !head.includes('\0');
}

/* A vertex of a solid. */
function notFinite(name, vertex, solid) {
    throw new BadModel(
        name,
        0,
        `vertex ${vertex + 1} of mesh '${solid}' has a coordinate that is not finite; export the model again`,
    );
}

/* Colours of a binary file's faces, of their attribute words: a word without bit 15 is none. Materialise Magics names
 * its own in the header, and one that faces without have; zsim takes them as they stand, which is a loss. */
function colorsOf(bytes, words, losses) {
    const at = String.fromCharCode(...bytes.subarray(0, 80)).indexOf('COLOR='),
        magics = at >= 0 && at <= 74,
        [r, g, b, a] = bytes.subarray(at + 6, at + 10);
    if (magics) losses.add('colours of Materialise Magics are in another form');
    if (!words.some((w) => w & 0x8000)) return words.map(() => null);
    return words.map((w) => {
        const [low, middle, high] = [w & 31, (w >> 5) & 31, (w >> 10) & 31].map((c) => c / 31);
        if (w & 0x8000) return magics ? [low, middle, high] : [high, middle, low];
        return magics && a === 255 ? [r / 255, g / 255, b / 255] : null;
    });
}

function readBinary(name, bytes, corners, losses) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const n = view.getUint32(80, true),
        takes = 84 + 50 * n;
    const said = `${n} faces take ${takes} bytes, it has ${bytes.length}`;
    if (takes > bytes.length) throw new BadModel(name, 0, `cut off: ${said}; get the whole file`);
    if (n > 0 && takes < bytes.length)
        throw new BadModel(name, 0, `is longer than it says: ${said}; export the model again`);
    const words = Array.from({ length: n }, (_, t) => view.getUint16(84 + 50 * t + 48, true)),
        colors = colorsOf(bytes, words, losses);
    for (let t = 0; t < n; t++) {
        const face = [];
        for (let k = 0; k < 3; k++) {
            const at = 84 + 50 * t + 12 + 12 * k;
            const p = [0, 4, 8].map((i) => view.getFloat32(at + i, true));
            if (!p.every(Number.isFinite)) notFinite(name, 3 * t + k, '');
            face.push(corners.vertex(`${p}/${colors[t]}`, p, null, null, colors[t]));
        }
        corners.polygon(face, 0);
    }
}

/* The first facet from word k on; -1: none. */
const facetsFrom = (word, k) => word.findIndex((w, i) => i >= k && w === 'facet' && word[i + 1] === 'normal');

function readText(name, text, corners, losses) {
    let face = [],
        solid = '',
        open = false,
        vertices = 0;
    const lines = text.split(/\r\n|\n|\r/);
    if (!/^s/i.test(text))
        throw new BadModel(name, 0, 'begins with blanks in place of `solid`; export the model again');
    const [last] = /[^\n\r]*$/.exec(text.trimEnd());
    if (!/(^|[ \t])endsolid([ \t]|$)|^[ \t]*end[ \t](.*[ \t])?solid([ \t]|$)/i.test(last))
        throw new BadModel(name, 0, 'cut off: its last line is not `endsolid`; get the whole file');
    for (let line = 0; line < lines.length; line++) {
        const plain = lines[line].trim(),
            word = plain.toLowerCase().split(/\s+/);
        if (!open && /^(facet|outer|vertex|endloop|endfacet)$/.test(word[0])) {
            const why = `'${plain.slice(0, 40)}' is outside a solid; put \`solid\` before it`;
            throw new BadModel(name, line + 1, why);
        }
        let facets = 0; // the word where facets begin
        if (word[0] === 'solid') {
            facets = facetsFrom(word, 1);
            solid = plain.split(/\s+/).slice(1, facets < 0 ? undefined : facets).join(' ');
            vertices = 0;
            open = true;
        } else if (!/^(facet|outer|vertex|endloop|endfacet|endsolid)$/.test(word[0])) {
            open &&= !word.includes('endsolid');
            continue;
        }
        for (let k = facets < 0 ? word.length : facets; k < word.length && open; k++) {
            if (word[k] === 'endsolid') {
                if (facetsFrom(word, k) >= 0)
                    throw new BadModel(name, line + 1, 'facets stand behind `endsolid`; begin a line there');
                open = false;
            } else if (word[k] === 'vertex') {
                const given = word.slice(k + 1, k + 4),
                    p = given.map((w) => Math.fround(Number(w)));
                if (p.length === 3 && given.some((w) => /^[+-]?(nan|inf)/i.test(w))) notFinite(name, vertices, solid);
                vertices++;
                if (p.length < 3 || !p.every(Number.isFinite)) {
                    const [from] = new RegExp(`(\\S+\\s+){${word.length - k - 1}}\\S+$`).exec(plain);
                    const why = `'${from.toLowerCase().slice(0, 40)}' is not a vertex of three numbers`;
                    throw new BadModel(name, line + 1, why);
                }
                face.push(corners.vertex(p.join(), p));
            } else if (word[k] === 'endloop') {
                if (face.length < 3)
                    throw new BadModel(name, line + 1, `a face of ${face.length} vertices; it needs at least 3`);
                if (face.length > 3) losses.add('vertices of facets beyond the third are left out');
                corners.polygon(face.slice(0, 3), 0);
                face = [];
            }
        }
    }
}

/** Read an STL. @param {string} name @param {Uint8Array} bytes @return what engine.setModel takes */
export function readStl(name, bytes) {
    const corners = new Corners(),
        losses = new Set(),
        head = String.fromCharCode(...bytes.subarray(0, 8)),
        plain = /^\xef\xbb\xbf/.test(head) ? bytes.subarray(3) : bytes;
    if (plain !== bytes && isText(plain))
        throw new BadModel(name, 0, 'begins with a UTF-8 byte order mark; save it without one, as by tail -c +4');
    if (isText(bytes)) readText(name, new TextDecoder().decode(bytes), corners, losses);
    else if (bytes.length >= 84) readBinary(name, bytes, corners, losses);
    else throw new BadModel(name, 0, `cut off: ${bytes.length} bytes are no STL file; get the whole file`);
    if (corners.indices.length === 0) throw new BadModel(name, 0, 'no faces in it');
    return corners.model(name, { losses: [...losses] });
}
