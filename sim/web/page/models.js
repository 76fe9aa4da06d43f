/* Files that were dropped or picked, to what engine.setModel takes. SPDX-License-Identifier: MIT */
import { BadModel } from './read_text.js';
import { readObj } from './read_obj.js';
import { readStl } from './read_stl.js';
import { readPly } from './read_ply.js';
import { dataUri, readGltf } from './read_gltf.js';
import { decodePicture } from './picture.js';

const FORMATS = 'OBJ, PLY, STL and glTF: export the model as one of these';
const MODEL = /\.(obj|stl|ply|gltf|glb)$/i;
/* %20 and the like as what they stand for, where that is text. */
const decoded = (uri) => uri.replace(/(%[\da-f]{2})+/gi, (s) => {
    try {
        return decodeURIComponent(s);
    } catch {
        return s;
    }
});
const baseName = (path) => path.split(/[\\/]/).pop();

/* A texture's bytes: those of a file, a data URI, or of the model itself. null: they were not given. */
function bytesOf(texture, given) {
    if (typeof texture !== 'string') return texture;
    if (texture.startsWith('data:')) return dataUri(texture);
    return [texture, decoded(texture)].map((at) => given.get(baseName(at).toLowerCase())).find((at) => at) || null;
}

/* The mean colour of a picture, which is times a factor. */
function meanOf(rgba, factor) {
    const sum = [0, 0, 0];
    for (let i = 0; i < rgba.length; i += 4)
        for (let k = 0; k < 3; k++) sum[k] += Math.round(rgba[i + k] * Math.min(Math.max(factor[k], 0), 1));
    return sum.map((s) => s / (255 * (rgba.length / 4)));
}

/* Textures are names of files, data URIs or bytes; what cannot be loaded is said, and its faces are drawn plain. */
async function loadTextures(model, given) {
    const numbers = [],
        textures = [];
    for (const [i, texture] of model.textures.entries()) {
        const isFile = typeof texture === 'string' && !texture.startsWith('data:'),
            name = isFile ? baseName(decoded(texture)) : `${model.name}, picture *${i}`,
            what = isFile ? texture : `texture ${i + 1}`;
        let why = `${what} is no picture that this browser reads: its faces are plain`,
            number = -1;
        try {
            const bytes = texture === null ? null : bytesOf(texture, given);
            if (texture === null) why = `${what} names no picture that is read: its faces are plain`;
            else if (!bytes) why = `${what} was not given: drop it with the model`;
            if (bytes) {
                const { rounded, ...picture } = await decodePicture(bytes);
                why = rounded ? `colours of ${what} are rounded where it has alpha: there is no WebGL` : '';
                number = textures.push({ name, ...picture }) - 1;
            }
        } catch (e) {
            /* what `why` says */
        }
        numbers.push(number);
        if (why) model.losses.push(why);
    }
    for (const m of model.materials) {
        m.texture = m.texture === undefined ? undefined : numbers[m.texture];
        if (m.texture === undefined || m.texture < 0) delete m.texture;
        else if (m.shineOf) m.textured = m.shineOf(meanOf(textures[m.texture].rgba, m.textureFactor));
    }
    model.textures = textures;
    return model;
}

/* The bits of a character, 16 or 32, of text in which each has one byte that is not 0; else 0. The first one may be a
 * byte order mark. */
function wideText(bytes) {
    for (const unit of [2, 4]) {
        const most = Math.min(bytes.length, 64),
            places = new Set();
        let at = unit;
        for (; at + unit <= most; at += unit)
            places.add(String([...bytes.subarray(at, at + unit)].map((b) => +(b !== 0))));
        const is = (k) => places.has(String(Array.from({ length: unit }, (_, i) => +(i === k))));
        if (at >= 5 * unit && places.size === 1 && (is(0) || is(unit - 1))) return 8 * unit;
    }
    return 0;
}

/* Throws BadModel where a file is text of wider characters. */
function refuseWide(name, bytes) {
    const wide = wideText(bytes);
    if (wide) throw new BadModel(name, 0, `is UTF-${wide} text; save it as UTF-8, as by iconv -f UTF-${wide} -t UTF-8`);
}

function textOf(name, bytes) {
    refuseWide(name, bytes);
    return new TextDecoder().decode(bytes);
}

/** Read a model. files: of a drop or a file picker. Throws BadModel with one sentence. */
export async function readModel(files) {
    const given = new Map();
    for (const file of files) given.set(baseName(file.name).toLowerCase(), new Uint8Array(await file.arrayBuffer()));
    const file = [...files].find((f) => MODEL.test(f.name));
    if (!file) {
        const first = files[0] ? files[0].name : 'nothing';
        throw new BadModel(first, 0, `is of no format that is known by its name; this page reads ${FORMATS}`);
    }
    const bytes = given.get(baseName(file.name).toLowerCase());
    if (bytes.length === 0) throw new BadModel(file.name, 0, 'is empty; get the model again');
    const other = (path) => given.get(baseName(path).toLowerCase()) || null;
    refuseWide(file.name, bytes);
    const kind = MODEL.exec(file.name)[1].toLowerCase();
    const model =
        kind === 'obj'
            ? readObj(file.name, textOf(file.name, bytes), (path) => (other(path) ? textOf(path, other(path)) : null))
            : kind === 'stl'
              ? readStl(file.name, bytes)
              : kind === 'ply'
                ? readPly(file.name, bytes)
                : readGltf(file.name, bytes, other);
    return loadTextures(model, given);
}
