/* OBJ and MTL. Positions keep double precision, as zsim's do, so that the same pixels come out.
 *
 * SPDX-License-Identifier: MIT
 */
import { BadModel, Corners, highlightsOf } from './read_text.js';

/* The finite numbers that words begin with, `most` of them at most. */
function numbersOf(words, most) {
    const n = words.findIndex((w) => !/^[-+.\d]/.test(w) || !Number.isFinite(Number(w)));
    return words.slice(0, Math.min(most, n < 0 ? words.length : n)).map(Number);
}

/* Options of a map line that take one word, whatever it is. */
const ONE = /^-(blendu|blendv|boost|texres|bm|imfchan|type|cc)$/i;

/* What a map_Kd line says: options, then a name, which may hold blanks. Texture coordinates are times scale, plus
 * shift. */
function mapOf(said) {
    const map = { scale: [1, 1], shift: [0, 0], clamp: false };
    let rest = said;
    for (;;) {
        const [option, ...words] = rest.split(/\s+/),
            most = { '-s': 3, '-o': 3, '-t': 3, '-mm': 2 }[option.toLowerCase()],
            numbers = most ? numbersOf(words, most) : [];
        const skip = most ? numbers.length : 1;
        if (/^-s$/i.test(option)) numbers.slice(0, 2).forEach((v, k) => (map.scale[k] = v));
        else if (/^-o$/i.test(option)) numbers.slice(0, 2).forEach((v, k) => (map.shift[k] = v));
        else if (/^-clamp$/i.test(option)) map.clamp = /^on$/i.test(words[0] || '');
        else if (!most && !ONE.test(option)) return { ...map, name: rest }; /* or it begins with a minus */
        rest = rest.replace(new RegExp(`^(\\S+\\s*){${skip + 1}}`), '');
    }
}

/** Materials of an MTL file by name: as setModel takes them; what their texture is, its factor, and map_d. */
export function readMtl(text) {
    const materials = new Map();
    let now = null;
    for (const raw of text.replace(/^\ufeff/, '').split(/[\r\n]/)) {
        const [key, ...words] = raw.trim().split(/\s+/),
            said = raw.trim().slice(key.length).trim(),
            numbers = numbersOf(words, 3);
        const all = numbers.length > 0 ? [0, 1, 2].map((k) => numbers[Math.min(k, numbers.length - 1)]) : null;
        const is = (word) => key.toLowerCase() === word;
        if (is('newmtl')) {
            now = { name: said, color: [1, 1, 1], factor: [1, 1, 1], power: 0 };
            materials.set(said, now);
        } else if (now === null) continue;
        else if (is('kd') && all) now.color = now.factor = all;
        else if (is('ke') && all) now.emission = all;
        else if (is('ks') && all) now.specular = all;
        else if (is('ns') && all) [now.power] = numbers;
        else if ((is('d') || is('tr')) && all) now.opacity = is('d') ? numbers[0] : 1 - numbers[0];
        else if (is('map_kd')) now.map = said ? mapOf(said) : undefined;
        else if (is('map_d')) now.mask = said ? mapOf(said).name : undefined;
        else if (/^(map_(?!aat$)|(bump|norm|disp|refl|decal)$)/i.test(key)) now.others = true;
    }
    return materials;
}

/* A material of an MTL file as it is drawn: set_specular and take_mtl of sim/load/material.c. */
function lookOf({ map, mask, others, factor, specular = [0, 0, 0], power, opacity = 1, ...rest }) {
    const d = Math.min(Math.max(opacity, 0), 1),
        clear = Math.floor(255 * d + 0.5) < 255;
    return {
        ...rest,
        ...highlightsOf(specular, power),
        opacity: d,
        alpha: clear ? 'blend' : mask ? 'mask' : 'opaque',
        clampU: map?.clamp,
        clampV: map?.clamp,
        textureFactor: factor.some((c) => c !== 0) ? factor.map((c) => Math.min(Math.max(c, 0), 1)) : undefined,
    };
}

/* Texture coordinates as a map's options move them. */
const moved = (uv, map) => (map ? uv.map((c, k) => map.scale[k] * c + map.shift[k]) : uv);

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
        moves = [] /* of their texture coordinates */,
        numberOf = new Map(),
        textures = [];
    let material = 0;

    const lines = text
        .replace(/^\ufeff/, '')
        .replace(/((?:^|[ \t\r\n])#[^\r\n]*?)\\+(?=[ \t]*\r?\n)/g, '$1') // a comment does not go on
        .replace(/^([ \t]*(?:usemtl|mtllib)[ \t][^\r\n]*\\)(?=\r?\n)/gm, '$1 ') // nor does a name
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
            const made = from ? lookOf(from) : { name: wanted };
            if (from?.map) {
                made.texture = textures.indexOf(from.map.name);
                if (made.texture < 0) made.texture = textures.push(from.map.name) - 1;
            }
            if (from?.others || (from?.mask && from.mask !== from.map?.name)) lost.add('maps other than map_Kd');
            moves.push(from?.map ?? null);
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
        const body = lines[at].replace(/(^|[\s\x01])#.*/, '').replaceAll('\x01', '').trim();
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
        } else if (word[0] === 'curv' || word[0] === 'surf') {
            lost.add('curves and surfaces');
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
                corners.vertex(
                    `${p}/${t}/${n}/${moves[face.material] ? face.material : ''}`,
                    points[p],
                    normals[n] ?? null,
                    t < 0 ? null : moved(uvs[t], moves[face.material]),
                    tints[p],
                ),
            ),
            face.material,
        );
    if (corners.indices.length === 0)
        throw new BadModel(name, 0, 'no faces in it; zsim draws `f` elements of OBJ text');
    for (const what of lost) losses.push(`${what} are left out`);
    return corners.model(name, { materials, textures, losses, single: false });
}
