/* What readers of model files share: errors that name the file and the line, a growing list of corners.
 *
 * SPDX-License-Identifier: MIT
 */

import { cutPolygon } from './polygon.js';

/** A file that is not taken. The message is one sentence: what is wrong, where, and what to do. */
export class BadModel extends Error {
    /** @param {string} file @param {number} line 0: none @param {string} why */
    constructor(file, line, why) {
        super(line > 0 ? `${file}:${line}: ${why}` : `${file}: ${why}`);
        this.name = 'BadModel';
    }
}

/** Highlights of a share of light and a power: too faint or wide ones are none, and brighter ones than full keep their
 * hue. */
export function highlightsOf(rgb, power) {
    const most = Math.max(...rgb);
    return most >= 0.1 && power >= 1 ? { specular: rgb.map((c) => c / Math.max(most, 1)), power } : {};
}

/** The loss of a mesh's vertex colours whose alphas these are; '': none. All 0 are those of colours without one, as
 * zsim has it. */
export function lossOfAlpha(alphas) {
    const clear = alphas.some((a) => a < 0.998) && alphas.some((a) => a !== 0);
    return clear ? 'alpha of vertex colours is left out' : '';
}

/** Corners of triangles in file order, each with what the file gives it. A vertex is a distinct set of those. */
export class Corners {
    constructor() {
        this.positions = [];
        this.normals = [];
        this.uvs = [];
        this.colors = [];
        this.indices = [];
        this.triMaterial = [];
        this.hasNormals = this.hasUvs = this.hasColors = false;
        this.known = new Map();
    }

    /** The number of a vertex. key: what makes it distinct; normal, uv and color may be null. */
    vertex(key, position, normal, uv, color) {
        let n = key === null ? undefined : this.known.get(key);
        if (n !== undefined) return n;
        n = this.positions.length / 3;
        if (key !== null) this.known.set(key, n);
        this.positions.push(position[0], position[1], position[2]);
        const at = normal || [0, 0, 0];
        this.normals.push(at[0], at[1], at[2]);
        const to = uv || [NaN, NaN];
        this.uvs.push(to[0], to[1]);
        const tint = color || [NaN, NaN, NaN];
        this.colors.push(tint[0], tint[1], tint[2]);
        this.hasNormals ||= !!normal;
        this.hasUvs ||= !!uv;
        this.hasColors ||= !!color;
        return n;
    }

    /** A polygon: its vertices, in order. */
    polygon(corners, material) {
        const at = (n) => [this.positions[3 * n], this.positions[3 * n + 1], this.positions[3 * n + 2]];
        const triangles = corners.length > 3 ? cutPolygon(corners.map(at)) : [[0, 1, 2]];
        for (const t of triangles) {
            this.indices.push(corners[t[0]], corners[t[1]], corners[t[2]]);
            this.triMaterial.push(material);
        }
    }

    /** What engine.setModel takes. single: the format has single precision; uvDown: v counts from a picture's top. */
    model(name, { materials = [], textures = [], losses = [], uvDown = false, flat = false, single = true } = {}) {
        return {
            name,
            positions: Float64Array.from(this.positions),
            single,
            indices: Uint32Array.from(this.indices),
            normals: this.hasNormals ? Float32Array.from(this.normals) : undefined,
            uvs: this.hasUvs ? Float64Array.from(this.uvs) : undefined,
            uvDown,
            flat,
            colors: this.hasColors ? Float32Array.from(this.colors) : undefined,
            materials,
            triMaterial: Uint32Array.from(this.triMaterial),
            textures,
            losses,
        };
    }
}
