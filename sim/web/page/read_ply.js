/* PLY, text and binary of both orders of bytes: positions, normals, colours and texture coordinates of vertices,
 * texture coordinates of corners, and a texture.
 *
 * SPDX-License-Identifier: MIT
 */
import { BadModel, Corners, lossOfAlpha } from './read_text.js';

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
    const end = /(^|[\r\n])end_header[ \t]*(\r\n|\n|\r)/.exec(head);
    const lines = head.slice(0, end ? end.index + 1 : undefined).split(/\r\n|\n|\r/);
    if (lines[0].trim() !== 'ply') throw new BadModel(name, 1, 'not a PLY file: its first line is not `ply`');
    if (!end) throw new BadModel(name, lines.length, 'cut off: its header has no end; get the whole file');
    const header = { format: '', texture: null, elements: [], start: end.index + end[0].length, lines: lines.length };
    for (let i = 1; i < lines.length - 1; i++) {
        const word = lines[i].trim().split(/\s+/);
        if (word[0] === 'comment' && word[1] === 'TextureFile' && word.length > 2) {
            const texture = lines[i].replace(/^\s*comment\s+TextureFile\s*/, '').trimEnd();
            header.further ||= header.texture !== null && header.texture !== texture;
            header.texture = texture;
        }
        if (/^(comment|obj_info|)$/.test(word[0])) continue;
        const wrong = (why) => {
            throw new BadModel(name, i + 1, why);
        };
        const element = header.elements[header.elements.length - 1];
        if (word[0] === 'format') {
            header.format = word[1];
            if (!/^(ascii|binary_(little|big)_endian)$/.test(word[1]))
                wrong(`unknown format '${word[1]}'`);
        } else if (word[0] === 'element') {
            if (word.length !== 3 || word[2][0] === '-') wrong('an element that makes no sense');
            if (!/^\d+$/.test(word[2])) wrong(`'${word[2]}' is not a count`);
            header.elements.push({ name: word[1], count: Number(word[2]), properties: [] });
        } else if (word[0] === 'property') {
            const list = word.length === 5 && word[1] === 'list';
            if (!element || (!list && word.length !== 3)) wrong('a property that makes no sense here');
            const type = TYPES[word[list ? 3 : 1]],
                length = list ? TYPES[word[2]] : null;
            if (!type || (list && (!length || /Float/.test(length[0])))) wrong('a property of unknown type');
            element.properties.push({ name: word[list ? 4 : 2], type, length });
        } else wrong(`'${word[0]}' does not belong in a header`);
    }
    if (header.format === '') throw new BadModel(name, 0, 'a header without a format');
    const places = header.elements.map((e) => e.name);
    if (places.includes('face') && places.indexOf('face') < places.indexOf('vertex'))
        throw new BadModel(name, 0, 'its faces stand before its vertices; export the model again');
    const face = header.elements.find((e) => e.name === 'face');
    if (face && !face.properties.some((p) => p.length && /^vertex_ind(ex|ices)$/.test(p.name))) face.count = 0;
    const vertex = header.elements.find((e) => e.name === 'vertex' && e.count > 0);
    if (vertex && vertex.properties.filter((p) => !p.length && /^[xyz]$/.test(p.name)).length !== 3)
        throw new BadModel(name, 0, 'its vertices have no x, y and z; export the model again');
    return header;
}

/* Values of the body, one after the other. Text has a record a line, and its errors a line's number. */
class Body {
    constructor(name, bytes, header) {
        this.name = name;
        this.ascii = header.format === 'ascii';
        this.line = this.ascii ? header.lines + 1 : 0;
        this.little = header.format === 'binary_little_endian';
        this.at = this.ascii ? 0 : header.start;
        if (this.ascii) this.text = new TextDecoder('latin1').decode(bytes.subarray(header.start));
        else this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
        this.skip(false);
    }

    fail(why, line = this.line) {
        throw new BadModel(this.name, line, why);
    }

    cutOff(element, i) {
        this.fail(`cut off: it ends in ${element.name} ${i + 1} of ${element.count}; get the whole file`);
    }

    /* Text: what is left of a record's line, and empty lines before the next one. */
    skip(rest) {
        if (!this.ascii) return;
        const { text } = this;
        while (rest && this.at < text.length && !'\r\n'.includes(text[this.at])) this.at++;
        for (; this.at < text.length && ' \t\r\n'.includes(text[this.at]); this.at++)
            if (text[this.at] === '\n' || (text[this.at] === '\r' && text[this.at + 1] !== '\n')) this.line++;
    }

    next(type, element, i) {
        if (!this.ascii) {
            if (this.at + type[1] > this.view.byteLength) this.cutOff(element, i);
            this.at += type[1];
            return this.view[type[0]](this.at - type[1], this.little);
        }
        const word = /[ \t]*([^ \t\r\n]*)/y;
        word.lastIndex = this.at;
        const found = word.exec(this.text)[1];
        this.at = word.lastIndex;
        if (found === '') this.cutOff(element, i);
        const infinite = /^[+-]?(nan|inf(inity)?)$/i.test(found),
            v = Number(found);
        if (Number.isNaN(v) && !infinite) this.fail(`${element.name} ${i + 1} holds something that is not a number`);
        return type[0] === 'getFloat32' ? Math.fround(v) : v;
    }
}

/** Read a PLY. @param {string} name @param {Uint8Array} bytes @return what engine.setModel takes */
export function readPly(name, bytes) {
    const header = readHeader(name, bytes),
        corners = new Corners(),
        rows = [];
    const countOf = (what) => (header.elements.find((e) => e.name === what) || { count: 0 }).count;
    if (!(countOf('face') > 0) && countOf('tristrips') > 0)
        throw new BadModel(name, 0, 'its faces are triangle strips, which are not read; export it with faces');
    if (!(countOf('face') > 0)) throw new BadModel(name, 0, 'no faces in it; zsim draws polygons');
    const body = new Body(name, bytes, header);
    const has = (what, names) =>
        header.elements.some((e) => e.name === what && e.properties.some((p) => names.includes(p.name)));
    const hasUvs = header.elements.some((e) =>
        e.name === 'face' && e.properties.some((p) => p.length && p.name === 'texcoord'));
    let known = null;
    for (const element of header.elements) {
        for (let i = 0; i < element.count; i++) {
            const row = readRow(body, element, i, countOf('vertex'));
            body.skip(true);
            if (element.name === 'vertex') {
                known ||= knownOf(element.properties);
                rows.push(row);
            } else if (element.name === 'face') {
                const list = row.vertex_indices || row.vertex_index || [];
                const uvs = hasUvs && uvsOf(row.texcoord, list.length);
                corners.polygon(
                    list.map((v, k) => vertexOf(corners, rows, v, known, uvs && [uvs[k]])),
                    0,
                );
            }
        }
    }
    const losses = [];
    if (has('vertex', ['diffuse_red'])) losses.push('colours of the name diffuse_red are left out');
    if (has('face', ['red', 'diffuse_red'])) losses.push('colours of faces are left out');
    if (countOf('tristrips') > 0) losses.push('triangle strips are left out');
    const alpha = known && known.alpha;
    const lost = alpha && lossOfAlpha(rows.map((row) => shareOf(row[alpha.name], alpha)));
    if (lost) losses.push(lost);
    const { texture, further } = header;
    if (further) losses.push('textures beside the last that the file names are left out');
    return corners.model(name, texture ? { losses, textures: [texture], materials: [{ texture: 0 }] } : { losses });
}

/* Of a face's corners: two numbers for each of them, or none. */
function uvsOf(values, n) {
    const own = values.length === 2 * n;
    return Array.from({ length: n }, (_, k) => (own ? values.slice(2 * k, 2 * k + 2).map(Math.fround) : null));
}

function readRow(body, element, i, vertices) {
    const row = {},
        { line } = body;
    for (const p of element.properties) {
        if (!p.length) {
            const v = (row[p.name] = body.next(p.type, element, i));
            if (element.name === 'vertex' && /^[xyz]$/.test(p.name) && !Number.isFinite(v))
                body.fail(`vertex ${i + 1} has a coordinate that is not finite; export the model again`);
            continue;
        }
        const n = body.next(p.length, element, i),
            isFace = element.name === 'face' && p.name.startsWith('vertex_ind');
        if (!(n >= 0 && n <= 1e9 && Number.isInteger(n))) body.fail(`${element.name} ${i + 1} is a list of ${n}`, line);
        if (isFace && n < 3) body.fail(`face ${i + 1} has ${n} vertices; it needs at least 3`, line);
        const list = (row[p.name] = []);
        for (let k = 0; k < n; k++) {
            const v = body.next(p.type, element, i);
            if (isFace && !(v >= 0 && v < vertices && Number.isInteger(v)))
                body.fail(
                    `vertex index ${v} of face ${i + 1} is out of range: 0 to ${vertices - 1} exist`,
                    line,
                );
            list.push(v);
        }
    }
    return row;
}

/* Of full light, a colour's value by its type, as assimp has it. */
const SHARES = {
    getUint8: (v) => v / 255,
    getInt8: (v) => (v + 127) / 255,
    getUint16: (v) => v / 65535,
    getInt16: (v) => (v + 32767) / 65535,
    getUint32: (v) => v / 65535,
    getInt32: (v) => Math.fround(v / 255) + 0.5,
};
function shareOf(value, property) {
    return Math.fround((SHARES[property.type[0]] ?? ((v) => v))(value));
}

/* What vertices have: of each colour the last property of its names; undefined: none. */
function knownOf(properties) {
    const last = (...names) => properties.filter((p) => !p.length && names.includes(p.name)).pop();
    const colors = [last('red', 'r'), last('green', 'g'), last('blue', 'b')];
    return {
        colors: colors.some((p) => p) ? colors : null,
        alpha: last('alpha', 'a'),
        normals: last('nx', 'ny', 'nz') !== undefined,
    };
}

/* own: in a list, texture coordinates of the corner alone, which may be null; undefined or false: there are none. */
function vertexOf(corners, rows, v, { colors, normals }, own) {
    const row = rows[v],
        p = [row.x, row.y, row.z].map(Math.fround);
    const u = row.s ?? row.u ?? row.texture_u,
        w = row.t ?? row.v ?? row.texture_v;
    const uv = own ? own[0] : u === undefined || w === undefined ? null : [u, w].map(Math.fround);
    return corners.vertex(
        own ? `${v}/${uv}` : v,
        p,
        normals ? [row.nx ?? 0, row.ny ?? 0, row.nz ?? 0] : null,
        uv,
        colors && colors.map((property) => (property ? shareOf(row[property.name], property) : 0)),
    );
}
