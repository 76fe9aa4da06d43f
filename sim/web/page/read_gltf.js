/* glTF 2.0, .gltf and .glb: triangles of the scene's nodes in their places, base colours and their textures.
 *
 * SPDX-License-Identifier: MIT
 */
import { BadModel, Corners, highlightsOf, lossOfAlpha } from './read_text.js';

const NO_FACES = 'no faces in it; zsim draws polygons',
    NOT_THERE = 'it names parts that are not there; export the model again',
    NO_SENSE = 'an accessor makes no sense; export the model again';
const SIZE = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };
const VALUE = {
    5120: ['getInt8', 1, 127],
    5121: ['getUint8', 1, 255],
    5122: ['getInt16', 2, 32767],
    5123: ['getUint16', 2, 65535],
    5125: ['getUint32', 4, 1],
    5126: ['getFloat32', 4, 1],
};

/** The bytes of a data URI. */
export function dataUri(uri) {
    const comma = uri.indexOf(','),
        body = decodeURIComponent(uri.slice(comma + 1));
    return Uint8Array.from(/;base64$/.test(uri.slice(0, comma)) ? atob(body) : body, (c) => c.charCodeAt(0));
}

function splitGlb(name, bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length < 20 || view.getUint32(8, true) > bytes.length)
        throw new BadModel(name, 0, 'cut off: it is shorter than its header says; get the whole file');
    if (view.getUint32(4, true) !== 2)
        throw new BadModel(name, 0, `is glTF ${view.getUint32(4, true)}, which is not read; export it as glTF 2.0`);
    const length = view.getUint32(12, true);
    const json = new TextDecoder().decode(bytes.subarray(20, 20 + length));
    const at = 20 + length;
    return { json, bin: at + 8 <= bytes.length ? bytes.subarray(at + 8, at + 8 + view.getUint32(at, true)) : null };
}

/* A matrix, column by column, of a node: in single precision, as assimp has it, so that zsim's vertices come out. */
function matrixOf(node) {
    const f = Math.fround;
    if (node.matrix) return node.matrix.map(f);
    const [x, y, z, w] = (node.rotation || [0, 0, 0, 1]).map(f),
        s = (node.scale || [1, 1, 1]).map(f);
    const t = (node.translation || [0, 0, 0]).map(f);
    const one = (a, b) => f(1 - f(2 * f(f(a * a) + f(b * b))));
    const sum = (a, b, c, d, sign) => f(2 * f(f(a * b) + sign * f(c * d)));
    const r = [
        one(y, z),
        sum(x, y, z, w, 1),
        sum(x, z, y, w, -1),
        sum(x, y, z, w, -1),
        one(x, z),
        sum(y, z, x, w, 1),
        sum(x, z, y, w, 1),
        sum(y, z, x, w, -1),
        one(x, y),
    ];
    const m = r.map((v, i) => f(v * s[Math.floor(i / 3)]));
    return [m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, t[0], t[1], t[2], 1];
}

function times(a, b) {
    const out = new Array(16);
    for (let c = 0; c < 4; c++)
        for (let r = 0; r < 4; r++)
            out[4 * c + r] =
                a[r] * b[4 * c] + a[4 + r] * b[4 * c + 1] + a[8 + r] * b[4 * c + 2] + a[12 + r] * b[4 * c + 3];
    return out;
}

class Gltf {
    constructor(name, json, bin, other) {
        this.name = name;
        this.json = json;
        this.corners = new Corners();
        this.losses = new Set();
        this.buffers = (json.buffers || []).map((b, i) => {
            const got =
                b.uri === undefined
                    ? bin
                    : b.uri.startsWith('data:')
                      ? dataUri(b.uri)
                      : other(decodeURIComponent(b.uri));
            if (!got) throw new BadModel(name, 0, `its buffer ${b.uri || i} was not given; drop it with the model`);
            return got;
        });
    }

    fail(why) {
        throw new BadModel(this.name, 0, why);
    }

    /** Values of an accessor, a row an element. A sparse one replaces some rows, of zeros where it has no others. */
    rows(number) {
        const a = (this.json.accessors || [])[number];
        if (!a) this.fail(NOT_THERE);
        const { sparse } = a,
            n = SIZE[a.type];
        if (!n) this.fail(NO_SENSE);
        if (!sparse && a.bufferView === undefined) this.fail('an accessor has no data; export the model again');
        const out =
            sparse && a.bufferView === undefined
                ? Array.from({ length: a.count }, () => new Array(n).fill(0))
                : this.values(a, a, a.count, n);
        if (!sparse) return out;
        const { count, indices, values } = sparse;
        if (!indices || !values) this.fail(NO_SENSE);
        const at = this.values(indices, indices, count, 1);
        this.values(values, a, count, n).forEach((row, i) => {
            if (at[i][0] >= a.count) this.fail(`accessor ${number} replaces element ${at[i][0]} of ${a.count}`);
            out[at[i][0]] = row;
        });
        return out;
    }

    /* count rows of n numbers of the type of `a`, from where `place` says. */
    values(place, a, count, n) {
        const type = VALUE[a.componentType],
            v = (this.json.bufferViews || [])[place.bufferView];
        if (!type || !v) this.fail(NO_SENSE);
        const bytes = this.buffers[v.buffer],
            start = (v.byteOffset || 0) + (place.byteOffset || 0);
        const stride = v.byteStride || n * type[1],
            end = start + stride * (count - 1) + n * type[1];
        if (!bytes || end > bytes.length)
            this.fail('an accessor goes beyond its buffer; get the whole file');
        const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength),
            out = [];
        for (let i = 0; i < count; i++) {
            const row = [];
            for (let k = 0; k < n; k++) {
                const raw = view[type[0]](start + i * stride + k * type[1], true);
                row.push(a.normalized ? Math.max(raw / type[2], -1) : raw);
            }
            out.push(row);
        }
        return out;
    }

    primitive(p, m, mesh) {
        const mode = p.mode ?? 4;
        if (mode < 4) {
            this.losses.add('points and lines are left out');
            return;
        }
        if (p.material !== undefined && !this.materialOf(p)) this.fail(NOT_THERE);
        if (p.extensions && p.extensions.KHR_draco_mesh_compression)
            this.fail('its meshes are compressed by Draco, which is not read; export it without');
        if (p.attributes.POSITION === undefined) return;
        const points = this.rows(p.attributes.POSITION);
        const normals = p.attributes.NORMAL === undefined ? null : this.rows(p.attributes.NORMAL);
        const uvs = this.uvsOf(p);
        const colors = this.colorsOf(p);
        const given = p.attributes.COLOR_0 === undefined ? [] : this.rows(p.attributes.COLOR_0);
        const lost = lossOfAlpha(given.map((row) => row[3] ?? 1));
        if (lost) this.losses.add(lost);
        const order = p.indices === undefined ? points.map((_, i) => i) : this.rows(p.indices).map((r) => r[0]);
        const step = mode === 4 ? 3 : 1;
        /* corners of the triangle that begins there; of a strip every other one is the other way round */
        const cornersAt = (t) =>
            [mode === 6 ? 0 : mode === 5 ? t + (t % 2) : t, mode === 5 ? t + 1 - (t % 2) : t + 1, t + 2].map(
                (k) => order[k],
            );
        if (order.some((i) => i >= points.length)) {
            const is = (t) => cornersAt(t).every((i) => i < points.length);
            const some = order.some((_, t) => t % step === 0 && t + 2 < order.length && is(t));
            this.fail(some ? 'its faces name vertices that are not there; export the model again' : NO_FACES);
        }
        const cof = cofactors(m),
            made = new Array(points.length);
        const vertex = (i) => {
            if (made[i] !== undefined) return made[i];
            const [x, y, z] = points[i];
            const at = [0, 1, 2].map((r) => m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r]);
            if (!at.every(Number.isFinite))
                this.fail(
                    `vertex ${i + 1} of mesh '${mesh}' has a coordinate that is not finite; export the model again`,
                );
            const n = normals && [0, 1, 2].map((r) => cof.row[r].reduce((s, c, k) => s + c * normals[i][k], 0));
            const length = n ? Math.hypot(...n) : 0;
            return (made[i] = this.corners.vertex(
                null,
                at,
                length > 0 ? n.map((c) => c / length) : null,
                uvs ? uvs[i] : null,
                colors ? colors[i] : null,
            ));
        };
        for (let t = 0; t + 2 < order.length; t += step) {
            const c = cornersAt(t).map(vertex);
            this.corners.polygon(cof.mirrored ? [c[0], c[2], c[1]] : c, p.material ?? this.plain());
        }
    }

    /* What an object says by an extension that the file says it uses; else undefined. */
    extension(of, name) {
        return (this.json.extensionsUsed || []).includes(name) ? of.extensions?.[name] : undefined;
    }

    /* A material's numbers: its base colour, which its texture is times; its own colour; its texture. */
    looksOf(m = {}) {
        const pbr = m.pbrMetallicRoughness || {},
            glossy = this.extension(m, 'KHR_materials_pbrSpecularGlossiness'),
            base = pbr.baseColorFactor || [1, 1, 1, 1];
        const color = glossy ? glossy.diffuseFactor || [1, 1, 1, 1] : base;
        return { pbr, base, color, map: pbr.baseColorTexture || glossy?.diffuseTexture };
    }

    materialOf(p) {
        return (this.json.materials || [])[p.material];
    }

    /* Of a primitive's vertices: times its material's colour, in single precision as zsim has it. */
    colorsOf(p) {
        const { color } = this.looksOf(this.materialOf(p));
        const black = shownColor(color).every((c) => toByte(c) === 0);
        if (p.attributes.COLOR_0 === undefined || black) return null;
        return this.rows(p.attributes.COLOR_0).map((row) => row.map((c, k) =>
            (k < 3 ? shown(Math.fround(Math.fround(c) * Math.fround(color[k]))) : c)));
    }

    /* Of a primitive: those that its texture names, as KHR_texture_transform moves them. */
    uvsOf(p) {
        const { map = {} } = this.looksOf(this.materialOf(p)),
            by = this.extension(map, 'KHR_texture_transform'),
            from = p.attributes[`TEXCOORD_${by?.texCoord ?? map.texCoord ?? 0}`];
        if (from === undefined) return null;
        const { offset: [x, y] = [0, 0], scale: [sx, sy] = [1, 1], rotation = 0 } = by || {},
            [c, s] = [Math.cos(rotation), Math.sin(rotation)];
        return this.rows(from).map(([u, v]) =>
            by ? [x + c * sx * u + s * sy * v, y - s * sx * u + c * sy * v] : [u, v]);
    }

    plain() {
        this.usesPlain = true;
        return (this.json.materials || []).length;
    }

    walk() {
        const { scenes = [], nodes = [], scene = 0 } = this.json;
        const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
        if (!scenes[scene]) this.fail('no scene in it; export the model again');
        const stack = [...(scenes[scene].nodes || [])].reverse().map((n) => [n, identity, 0]);
        while (stack.length > 0) {
            const [number, parent, depth] = stack.pop(),
                node = nodes[number];
            if (!node) this.fail(NOT_THERE);
            if (depth > nodes.length) this.fail('its nodes hold each other in a ring; export the model again');
            if (depth > 256) this.fail('nodes stand more than 256 deep; flatten the model');
            const m = times(parent, matrixOf(node));
            const mesh = node.mesh === undefined ? null : (this.json.meshes || [])[node.mesh];
            if (mesh === undefined) this.fail(NOT_THERE);
            (mesh ? mesh.primitives : []).forEach((p, i, all) => {
                const of = mesh.name || `meshes[${node.mesh}]`;
                this.primitive(p, m, all.length > 1 ? `${of}-${i}` : of);
            });
            for (const child of [...(node.children || [])].reverse()) stack.push([child, m, depth + 1]);
            if (node.skin !== undefined) this.losses.add('skins are left out: the model stands as it was built');
        }
        if ((this.json.animations || []).length > 0) this.losses.add('animations are left out');
    }

    materials() {
        const out = (this.json.materials || []).map((m, i) => {
            const { pbr, base, color, map } = this.looksOf(m);
            const made = {
                name: m.name || `material ${i + 1}`,
                color: shownColor(color),
                opacity: m.alphaMode === 'BLEND' ? base[3] : 1,
                alpha: (m.alphaMode || 'OPAQUE').toLowerCase(),
                alphaLeast: (m.alphaCutoff ?? 0.5) / (base[3] || 1), // texels are times its alpha
                twoSided: !!m.doubleSided,
                saysAlpha: true,
                textureFactor: shownColor(base),
            };
            if (map) Object.assign(made, this.texture(map.index));
            if (m.emissiveFactor && !m.emissiveTexture && m.emissiveFactor.some((c) => c > 0))
                made.emission = shownColor(m.emissiveFactor);
            Object.assign(made, shineOf(pbr, made.color.map(toByte)));
            if (pbr.metallicFactor !== 0) made.shineOf = (mean) => shineOf(pbr, mean);
            if (m.extensions?.KHR_materials_unlit) made.unlit = true;
            return made;
        });
        if (this.usesPlain) out.push({ name: '', color: [1, 1, 1], opacity: 1, alpha: 'opaque', saysAlpha: true });
        return out;
    }

    /* A material's texture, and what is beyond its picture. */
    texture(index) {
        const { sampler } = (this.json.textures || [])[index] || {},
            { wrapS, wrapT } = (this.json.samplers || [])[sampler] || {};
        return {
            texture: index,
            clampU: wrapS === 33071,
            clampV: wrapT === 33071,
            mirrorU: wrapS === 33648,
            mirrorV: wrapT === 33648,
        };
    }

    textures() {
        return (this.json.textures || []).map((t) => {
            const image = (this.json.images || [])[t.source] || {};
            if (image.bufferView === undefined) return image.uri || null;
            const v = this.json.bufferViews[image.bufferView];
            return this.buffers[v.buffer].subarray(v.byteOffset || 0, (v.byteOffset || 0) + v.byteLength);
        });
    }
}

/* A share of light, or of each colour, as a share of 255, by sRGB's curve: sim_srgb of sim/load/material.c. */
const shown = (light) => Math.fround(light > 0.0031308 ? 1.055 * light ** (1 / 2.4) - 0.055 : 12.92 * light);
const shownColor = (color) => color.slice(0, 3).map((c) => shown(Math.fround(c)));

/* A colour as a byte has it. */
const toByte = (c) => Math.round(255 * Math.min(Math.max(Math.fround(c), 0), 1)) / 255;

/* Metallic-roughness as Blinn-Phong: set_roughness of sim/load/material.c. */
function shineOf({ roughnessFactor: rough = 1, metallicFactor = 1 }, base) {
    const metal = Math.min(Math.max(Math.fround(metallicFactor), 0), 1),
        r = Math.fround(rough),
        power = Math.min(2 / Math.max(r, 0.1) ** 4 - 2, 128),
        rgb = base.slice(0, 3).map((c) => ((0.04 + metal * (c - 0.04)) * (power + 8)) / 8);
    return r < 0.95 ? highlightsOf(rgb, power) : {};
}

/* How normals go with a placement: its cofactors, with the sign that keeps outside outside. */
function cofactors(m) {
    const at = (r, c) => m[4 * c + r],
        row = [];
    for (let i = 0; i < 3; i++)
        row.push(
            [0, 1, 2].map(
                (j) =>
                    at((i + 1) % 3, (j + 1) % 3) * at((i + 2) % 3, (j + 2) % 3) -
                    at((i + 1) % 3, (j + 2) % 3) * at((i + 2) % 3, (j + 1) % 3),
            ),
        );
    const mirrored = at(0, 0) * row[0][0] + at(0, 1) * row[0][1] + at(0, 2) * row[0][2] < 0;
    return { mirrored, row: mirrored ? row.map((r) => r.map((c) => -c)) : row };
}

/** Read glTF. other: the bytes of a file that it names, or null. @return what engine.setModel takes; textures are names
 * of files, data URIs, bytes, or null: none; a material's shineOf gives its highlights by the mean of its texture */
export function readGltf(name, bytes, other = () => null) {
    const binary = bytes.length >= 4 && String.fromCharCode(...bytes.subarray(0, 4)) === 'glTF';
    const { json, bin } = binary ? splitGlb(name, bytes) : { json: new TextDecoder().decode(bytes), bin: null };
    let parsed;
    try {
        parsed = JSON.parse(json);
    } catch (e) {
        const why = 'its JSON does not end or is broken, or it is no glTF 2.0';
        throw new BadModel(name, 0, `${why}; get the whole file, or export it as glTF 2.0`);
    }
    if (!parsed || typeof parsed !== 'object') throw new BadModel(name, 0, 'no scene in it; export the model again');
    const gltf = new Gltf(name, parsed, bin, other);
    gltf.walk();
    if (gltf.corners.indices.length === 0) throw new BadModel(name, 0, NO_FACES);
    return gltf.corners.model(name, {
        materials: gltf.materials(),
        textures: gltf.textures(),
        losses: [...gltf.losses],
        uvDown: true,
        flat: true,
    });
}
