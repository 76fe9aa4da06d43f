/* PLY, text and binary of both orders of bytes: positions, normals, colours and texture coordinates of vertices.
 *
 * SPDX-License-Identifier: MIT
 */
import { BadModel, Corners } from './read_text.js';

const TYPES = {
    char: ['getInt8', 1],
    int8: ['getInt8', 1],
    uchar: ['getUint8', 1],
    uint8: ['getUint8', 1],
    short: ['getInt16', 2],
    int16: ['getInt16', 2],
    ushort: ['getUint16', 2],
    uint16: ['getUint16', 2],
    int: ['getInt32', 4],
    int32: ['getInt32', 4],
    uint: ['getUint32', 4],
    uint32: ['getUint32', 4],
    float: ['getFloat32', 4],
    float32: ['getFloat32', 4],
    double: ['getFloat64', 8],
    float64: ['getFloat64', 8],
};

function readHeader(name, bytes) {
    const head = new TextDecoder('latin1').decode(bytes.subarray(0, 65536));
    const end = /(^|\n)end_header\s*?\r?\n/.exec(head);
    const lines = head.slice(0, end ? end.index + 1 : undefined).split(/\r?\n/);
    if (lines[0].trim() !== 'ply') throw new BadModel(name, 1, 'not a PLY file: its first line is not `ply`');
    if (!end) throw new BadModel(name, lines.length, 'cut off: its header has no end; get the whole file');
    const header = { format: '', elements: [], start: end.index + end[0].length, lines: lines.length };
    for (let i = 1; i < lines.length; i++) {
        const word = lines[i].trim().split(/\s+/);
        const element = header.elements[header.elements.length - 1];
        if (word[0] === 'format') header.format = word[1];
        else if (word[0] === 'element')
            header.elements.push({ name: word[1], count: Number(word[2]), properties: [] });
        else if (word[0] === 'property' && element) {
            const list = word[1] === 'list';
            const type = TYPES[word[list ? 3 : 1]],
                length = list ? TYPES[word[2]] : null;
            if (!type || (list && !length)) throw new BadModel(name, i + 1, 'a property of unknown type');
            element.properties.push({ name: word[list ? 4 : 2], type, length, kind: word[list ? 3 : 1] });
        }
    }
    if (!/^(ascii|binary_(little|big)_endian)$/.test(header.format))
        throw new BadModel(name, 0, `unknown format '${header.format}'`);
    return header;
}

/* A function that gives the next value of a type, and throws where the file ends. */
function valuesOf(name, bytes, header) {
    if (header.format === 'ascii') {
        const words = new TextDecoder()
            .decode(bytes.subarray(header.start))
            .split(/\s+/)
            .filter((w) => w !== '');
        let at = 0;
        return (type) => {
            if (at === words.length)
                throw new BadModel(name, 0, 'cut off: numbers are missing at its end; get the whole file');
            const v = Number(words[at++]);
            if (!Number.isFinite(v)) throw new BadModel(name, 0, `'${words[at - 1].slice(0, 20)}' is not a number`);
            return type[0] === 'getFloat32' ? Math.fround(v) : v;
        };
    }
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const little = header.format === 'binary_little_endian';
    let at = header.start;
    return (type) => {
        if (at + type[1] > bytes.length)
            throw new BadModel(name, 0, 'cut off: bytes are missing at its end; get the whole file');
        const v = view[type[0]](at, little);
        at += type[1];
        return v;
    };
}

/** Read a PLY. @param {string} name @param {Uint8Array} bytes @return what engine.setModel takes */
export function readPly(name, bytes) {
    const header = readHeader(name, bytes),
        next = valuesOf(name, bytes, header),
        corners = new Corners();
    const rows = [];
    let known = null;
    for (const element of header.elements) {
        if (!(element.count >= 0 && element.count < 2 ** 31))
            throw new BadModel(name, 0, `element ${element.name} has no count that makes sense`);
        for (let i = 0; i < element.count; i++) {
            const row = {};
            for (const p of element.properties) {
                if (!p.length) {
                    row[p.name] = next(p.type);
                    continue;
                }
                const n = next(p.length);
                if (!(n >= 0 && n < 65536)) throw new BadModel(name, 0, `${element.name} ${i + 1} is a list of ${n}`);
                row[p.name] = Array.from({ length: n }, () => next(p.type));
            }
            if (element.name === 'vertex') {
                known ||= new Map(element.properties.map((p) => [p.name, p]));
                rows.push(row);
            } else if (element.name === 'face') {
                const list = row.vertex_indices || row.vertex_index || [];
                if (list.length < 3)
                    throw new BadModel(name, 0, `face ${i + 1} has ${list.length} vertices; it needs at least 3`);
                const bad = list.find((v) => !(v >= 0 && v < rows.length));
                if (bad !== undefined)
                    throw new BadModel(
                        name,
                        0,
                        `face ${i + 1} names vertex ${bad}; there are ${rows.length}, from 0`,
                    );
                corners.polygon(
                    list.map((v) => vertexOf(corners, rows, v, known, name)),
                    0,
                );
            }
        }
    }
    if (corners.indices.length === 0) throw new BadModel(name, 0, 'no faces in it; zsim draws polygons');
    return corners.model(name);
}

function vertexOf(corners, rows, v, known, name) {
    const row = rows[v],
        p = [row.x, row.y, row.z];
    if (!p.every(Number.isFinite)) throw new BadModel(name, 0, `vertex ${v + 1} has a coordinate that is not finite`);
    const scale = known.has('red') && /char|int8/.test(known.get('red').kind) ? 255 : 1;
    const u = row.s ?? row.u ?? row.texture_u,
        w = row.t ?? row.v ?? row.texture_v;
    return corners.vertex(
        v,
        p,
        known.has('nx') ? [row.nx, row.ny, row.nz] : null,
        u === undefined || w === undefined ? null : [u, w],
        known.has('red') ? [row.red / scale, row.green / scale, row.blue / scale] : null,
    );
}
