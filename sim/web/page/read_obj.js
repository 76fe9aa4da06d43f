/* OBJ and MTL. Positions keep double precision, as zsim's do, so that the same pixels come out.
 *
 * SPDX-License-Identifier: MIT
 */
import { BadModel, Corners } from './read_text.js';

/* What stands before a picture's name in a map_ line. */
const MAP_OPTIONS =
    /^(-(s|o|t|mm|bm|texres|boost)(\s+[-+]?[\d.]+(e[-+]?\d+)?)+\s+|-(clamp|blendu|blendv|cc)\s+(on|off)\s+|-imfchan\s+\S\s+)+/i;

/** Materials of an MTL file by name: kd, ke, ks, ns, d, map. */
export function readMtl(text) {
    const materials = new Map();
    let now = null;
    for (const raw of text.split(/\r\n|\n|\r/)) {
        const word = raw.replace(/#.*/, '').trim().split(/\s+/);
        const key = word[0].toLowerCase();
        const numbers = word.slice(1).map(Number);
        if (key === 'newmtl') {
            now = { name: raw.trim().slice(6).trim(), color: [1, 1, 1] };
            materials.set(now.name, now);
        } else if (now === null) {
            continue;
        } else if (key === 'kd' && numbers.length >= 3) {
            now.color = numbers.slice(0, 3);
        } else if (key === 'ke' && numbers.length >= 3) {
            now.emission = numbers.slice(0, 3);
        } else if (key === 'ks' && numbers.length >= 3) {
            now.specular = numbers.slice(0, 3);
        } else if (key === 'ns') {
            now.power = numbers[0];
        } else if (key === 'd' && Number.isFinite(numbers[0])) {
            now.opacity = numbers[0];
        } else if (key === 'tr' && Number.isFinite(numbers[0])) {
            now.opacity = 1 - numbers[0];
        } else if (key === 'map_kd') {
            const said = raw.trim().slice(6).trim();
            now.map = said.replace(MAP_OPTIONS, '');
            now.moved = /-[so]\s/i.test(said.slice(0, said.length - now.map.length));
        }
    }
    return materials;
}

/** Read an OBJ.
 * @param {string} name of the file, for messages
 * @param {string} text
 * @param {(mtl: string) => string|null} other the text of a file that it names; null: it was not given
 * @return what engine.setModel takes; textures are names of files */
export function readObj(name, text, other = () => null) {
    const points = [],
        tints = [],
        normals = [],
        uvs = [];
    const corners = new Corners(),
        losses = [];
    const lost = new Set();
    let library = new Map();
    const materials = [],
        numberOf = new Map(),
        textures = [];
    let material = 0;

    const lines = text
        .replace(/^\ufeff/, '')
        .replace(/((?:^|[ \t\r\n])#[^\r\n]*?)\\+(?=[ \t]*\r?\n)/g, '$1') // a comment does not go on
        .replace(/\\\r?\n/g, ' \x01 ') // a line goes on
        .split(/\r\n|\n|\r/);
    const fail = (line, why) => {
        throw new BadModel(name, line + 1, why);
    };
    const number = (word, line) => {
        const v = word === undefined || word === '' ? NaN : Number(word),
            shown = String(word).split('\0')[0].slice(0, 32);
        if (/^[+-]?(nan|inf(inity)?)$/i.test(word) || Math.abs(v) === Infinity)
            fail(line, `'${shown}' is not a finite number; export the model again without it`);
        if (Number.isNaN(v)) fail(line, `'${shown}' is not a number`);
        return v;
    };
    const take = (word, n, what, line) => {
        if (word.length - 1 < n)
            fail(line, `${what} with ${word.length - 1} of its ${n} numbers; the file may be cut off`);
        const out = [];
        for (let i = 1; i <= n; i++) out.push(number(word[i], line));
        return out;
    };
    const index = (word, count, what, line, corner) => {
        const i = Number(word);
        if (!/^[+-]?\d+$/.test(word)) fail(line, `'${corner}' is not a corner of a face`);
        if (i === 0) fail(line, `${what} index 0; indices count from 1, or back from -1`);
        if (i < -count) fail(line, `${what} index ${i} is out of range: there are ${count} so far`);
        return i > 0 ? i - 1 : count + i;
    };
    const use = (wanted) => {
        if (!numberOf.has(wanted)) {
            const from = library.get(wanted);
            const made = from ? { ...from } : { name: wanted };
            if (from && from.map !== undefined && from.color.some((c) => c > 0))
                made.textureFactor = from.color.map((c) => Math.min(c, 1));
            if (made.map !== undefined) {
                if (made.moved) lost.add('-s and -o of map_Kd');
                made.texture = textures.indexOf(made.map);
                if (made.texture < 0) made.texture = textures.push(made.map) - 1;
            }
            numberOf.set(wanted, materials.push(made) - 1);
        }
        material = numberOf.get(wanted);
    };

    /* A corner of a face: numbers of its point, texture coordinates and normal; -1: none. */
    const cornerOf = (word, line) => {
        const part = word.split('/');
        if (part.length > 3) fail(line, `'${word}' is not a corner of a face`);
        const [p, t, n] = [points, uvs, normals].map((all, k) => {
            if (k > 0 && (part[k] === undefined || part[k] === '')) return -1;
            return index(part[k], all.length, ['vertex', 'texture', 'normal'][k], line, word);
        });
        if (t >= texture.most) texture = { most: t + 1, line };
        return { p, t, n };
    };
    const faces = []; /* they may stand before their vertices */
    let texture = { most: 0, line: 0 },
        goesOn = 0; /* lines that went on so far */

    /* Material files come first, wherever they are named: one name with blanks, or several */
    for (const raw of lines) {
        const names = /^\s*mtllib\s+([^#]*)/.exec(raw.replaceAll('\x01', ''))?.[1].trim();
        if (!names) continue;
        const files = other(names) === null && names.split(/\s+/).some((one) => other(one) !== null)
            ? names.split(/\s+/)
            : [names];
        for (const file of files) {
            const got = other(file);
            if (got === null) losses.push(`material file ${file} was not given: drop it with the model`);
            else library = new Map([...library, ...readMtl(got)]);
        }
    }

    for (let at = 0; at < lines.length; at++) {
        const line = at + goesOn;
        goesOn += lines[at].split('\x01').length - 1;
        const body = lines[at].split('#', 1)[0].replaceAll('\x01', '').trim();
        if (body === '') continue;
        const word = body.split(/\s+/);
        if (word[0] === 'v') {
            points.push(take(word, 3, 'a vertex', line));
            tints.push(word.length >= 7 ? [4, 5, 6].map((i) => number(word[i], line)) : null);
        } else if (word[0] === 'vn') {
            normals.push(take(word, 3, 'a normal', line));
        } else if (word[0] === 'vt') {
            const uv = [number(word[1], line), word.length > 2 ? number(word[2], line) : 0];
            uvs.push(uv);
        } else if (word[0] === 'f') {
            if (word.length < 4) fail(line, `a face of ${word.length - 1} vertices; it needs at least 3`);
            if (materials.length === 0) use('');
            faces.push({ corners: word.slice(1).map((w) => cornerOf(w, line)), material, line });
        } else if (word[0] === 'usemtl') {
            use(lines[at].replaceAll('\x01', '').trim().slice(6).trim());
        } else if (word[0] === 'mtllib') {
            continue;
        } else if (word[0] === 'l' || word[0] === 'p') {
            lost.add('lines and points');
        } else if (
            !/^(o|g|s|vp|usemap|lod|bevel|c_interp|d_interp)$/.test(word[0]) &&
            points.length === 0 &&
            line > 20
        ) {
            fail(line, `'${word[0].slice(0, 20)}' is no element of OBJ text`);
        }
    }
    const beyond = (line, what, n, all) => fail(line, `${what} index ${n} is out of range: the file has ${all.length}`);
    for (const face of faces)
        for (const { p, n } of face.corners) {
            if (p >= points.length) beyond(face.line, 'vertex', p + 1, points);
            if (n >= normals.length) beyond(face.line, 'normal', n + 1, normals);
        }
    if (texture.most > uvs.length) beyond(texture.line, 'texture', texture.most, uvs);
    for (const face of faces)
        corners.polygon(
            face.corners.map(({ p, t, n }) =>
                corners.vertex(`${p}/${t}/${n}`, points[p], normals[n] ?? null, uvs[t] ?? null, tints[p]),
            ),
            face.material,
        );
    if (corners.indices.length === 0)
        throw new BadModel(name, 0, 'no faces in it; zsim draws `f` elements of OBJ text');
    for (const what of lost) losses.push(`${what} are left out`);
    return corners.model(name, { materials, textures, losses, single: false });
}
