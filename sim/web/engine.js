// The renderer and what of zsim a page needs, out of engine.wasm. An ES module without dependencies, for
// browsers and node.
//
// SPDX-License-Identifier: MIT

/** @typedef {{ok: boolean, error: string}} Answer  error: one sentence, '' where ok */

/** An error of the engine itself: it ran out of memory, or a file is not engine.wasm. */
export class EngineError extends Error {}

const ALIASES = {
    tris: 'maxTriangles',
    verts: 'maxVertices',
    depth: 'depthMapping',
    show: 'falseColors'
};
const camel = (name) => ALIASES[name] ?? name.replace(/-(.)/g, (_, letter) => letter.toUpperCase());

/** What the C library asks of its system: two streams of text and a clock. Everything else is refused. */
function system(said) {
    const REFUSED = 52;  // ENOSYS
    const text = new TextDecoder();
    let memory;
    const view = () => new DataView(memory().buffer);
    const calls = {
        fd_write(fd, vectors, n, written) {
            let bytes = 0;
            for (let i = 0; i < n; i++) {
                const at = view().getUint32(vectors + 8 * i, true), size = view().getUint32(vectors + 8 * i + 4, true);
                said(fd, text.decode(new Uint8Array(memory().buffer, at, size)));
                bytes += size;
            }
            view().setUint32(written, bytes, true);
            return 0;
        },
        clock_time_get(id, precision, to) {
            view().setBigUint64(to, BigInt(Math.round(performance.now() * 1e6)), true);
            return 0;
        },
        fd_fdstat_get(fd, to) {
            new Uint8Array(memory().buffer, to, 24).fill(0);
            view().setUint8(to, 4);  // a regular file, so that it is no terminal
            return 0;
        },
        proc_exit(status) { throw new EngineError(`the engine stopped (${status})`); },
    };
    const table = new Proxy(calls, {get: (all, name) => all[name] ?? (() => REFUSED)});
    return {table, bind: (get) => (memory = get)};
}

/** A material as struct web_paint of given.h. */
function paintNumbers(paint) {
    const flag = (on, bit) => (on ? bit : 0);
    const modes = {opaque: 0, mask: 1, blend: 2};
    const opacity = paint.opacity ?? 1;
    return [
        ...(paint.color ?? [ -1, 0, 0 ]),
        ...(paint.emission ?? [ 0, 0, 0 ]),
        ...(paint.specular ?? [ 0, 0, 0 ]),
        paint.power ?? 0,
        opacity,
        paint.alphaLeast ?? 128 / 255,
        ...(paint.textureFactor ?? [ 1, 1, 1 ]),
        modes[paint.alpha] ?? (opacity < 1 ? 2 : 0),
        flag(paint.twoSided, 1) | flag(paint.unlit, 2) | flag(paint.clampU, 4) | flag(paint.clampV, 8) |
            flag(paint.saysAlpha, 16) | flag(paint.mirrorU, 32) | flag(paint.mirrorV, 64),
        paint.texture ?? -1,
        ...(paint.textured ? [ ...(paint.textured.specular ?? [ 0, 0, 0 ]), paint.textured.power ?? 0 ] :
                             [ 0, 0, 0, -1 ]),
    ];
}

/**
 * @param {ArrayBuffer|Uint8Array} wasmBytes  engine.wasm
 * @returns {Promise<Engine>}
 */
export async function createEngine(wasmBytes) {
    const module = await WebAssembly.compile(wasmBytes);
    return new Engine(module);
}

export class Engine {
    #module;
    #c;  // exports
    #said = '';
    #args = {};
    #panel = {};  // the last one, and how it was rotated: for the wire of false colours
    #figured = null;
    #name = '';

    /** Use createEngine. */
    constructor(module) {
        this.#module = module;
        this.#start();
    }

    #start() {
        const host = system((fd, text) => (this.#said += text));
        const needed = WebAssembly.Module.imports(this.#module).map((one) => one.name);
        const wasi = Object.fromEntries(needed.map((name) => [name, host.table[name]]));
        const instance = new WebAssembly.Instance(this.#module, {wasi_snapshot_preview1: wasi});
        this.#c = instance.exports;
        host.bind(() => this.#c.memory);
        this.#c._initialize();
        this.#c.begin();
    }

    #bytes(at, n) { return new Uint8Array(this.#c.memory.buffer, at, n); }

    #text(at) {
        const all = new Uint8Array(this.#c.memory.buffer);
        return new TextDecoder().decode(all.subarray(at, all.indexOf(0, at)));
    }

    /** Call with bytes in the engine's memory; they are freed. */
    #with(bytes, call) {
        const at = this.#c.take(bytes.length);
        this.#bytes(at, bytes.length).set(bytes);
        try {
            return call(at);
        } finally {
            this.#c.give(at);
        }
    }

    #changed(name) {
        this.#name = name;
        this.#figured = null;
    }

    /** @returns {Answer} */
    #ask(call) {
        this.#said = '';
        const status = call();
        const lines = this.#said.split('\n').filter((line) => line !== '');
        const plain = (line) => line.replace(/^zstrip: /, '').replace(/; see zstrip --help$/, '');
        return {ok: status === 0, error: status === 0 ? '' : plain(lines.at(-1) ?? 'it was refused')};
    }

    /** The demo scenes: those of firmware/scenes, and showpieces with effects.
     * @returns {{name: string, text: string, width: number, height: number, frames: number, triangles: number,
     *            textured: boolean, moving: boolean, bench: boolean, effects: boolean}[]} */
    scenes() { return JSON.parse(this.#text(this.#c.scenes())); }

    /** What configure takes: the options of `zsim render`, by its own table. A name is zsim's without dashes, in camel
     * case, but for width and height (--size), maxTriangles, maxVertices (--tris, --verts), depthMapping (--depth) and
     * falseColors (--show, and 'wrong': pixels that are not the reference's). zsim: the option's own
     * name. value: what is set; undefined: the engine chooses.
     * @returns {{name: string, zsim: string, kind: 'number'|'choice'|'flag'|'text', choices?: string[], min?: number,
     *            max?: number, step?: number, value: any, text: string}[]} */
    options() {
        const rows = JSON.parse(this.#text(this.#c.options()));
        const out = [];
        for (const row of rows) {
            const text = row.text.replaceAll('{range}', row.min === undefined ? '' : `${row.min} to ${row.max}`);
            const base = {zsim: `--${row.name}`, text};
            if (row.name === 'size') {
                for (const name of ['width', 'height'])
                    out.push({name, ...base, kind: 'number', min: row.min, max: row.max, step: 1});
                continue;
            }
            const one = {name: camel(row.name), ...base, kind: 'text'};
            if (row.words !== undefined)
                Object.assign(one, {kind: 'choice', choices: row.words.split('|')});
            else if (row.kind === 'flag')
                one.kind = 'flag';
            else if (row.kind === 'count' || row.kind === 'number')
                Object.assign(
                    one, {kind: 'number', step: row.kind === 'count' ? 1 : 'any', min: row.min, max: row.max});
            out.push(one);
        }
        out.find((one) => one.name === 'falseColors').choices.push('wrong');
        for (const one of out) one.value = this.#args[one.name];
        return out;
    }

    /** Show a demo scene.
     * @param {string} name
     * @returns {Answer} */
    setScene(name) {
        const answer = this.#ask(() => this.#with(new TextEncoder().encode(name + '\0'), (at) => this.#c.scene(at)));
        if (answer.ok) this.#changed(name);
        return answer;
    }

    /** Draw a model from here on. Where it is refused what was drawn before stays.
     * Colours are 0 .. 1 a channel. A vertex without texture coordinates has NaN there.
     * @param {{name?: string, positions: Float64Array|Float32Array, indices: Uint32Array|Uint16Array|number[],
     *          normals?: Float32Array, uvs?: Float64Array|Float32Array, uvDown?: boolean, single?: boolean,
     *          flat?: boolean, colors?: Float32Array,
     *          triMaterial?: Uint32Array, materials?: Material[], textures?: Texture[], losses?: string[]}} model
     *   single: positions came through single precision, as those of a Float32Array did
     *   flat: faces without normals are flat where others have some, as glTF wants it
     *   uvDown: v counts from the top of the picture, as in glTF; else from its bottom, as in OBJ
     * @typedef {{name?: string, color?: number[], emission?: number[], specular?: number[], power?: number,
     *            opacity?: number, alpha?: 'opaque'|'mask'|'blend', alphaLeast?: number, twoSided?: boolean,
     *            unlit?: boolean, texture?: number, textureFactor?: number[], clampU?: boolean, clampV?: boolean,
     *            mirrorU?: boolean, mirrorV?: boolean, saysAlpha?: boolean,
     *            textured?: {specular?: number[], power?: number}}} Material
     *   texture: into textures; saysAlpha: its format says what alpha does; textured: highlights where the texture is
     *   drawn, if they are others
     * @typedef {{name?: string, width: number, height: number, rgba: Uint8Array|Uint8ClampedArray}} Texture
     * @returns {Answer & {losses: string[]}} losses: what of the file is not carried over */
    setModel(model) {
        const c = this.#c, name = (text) => new TextEncoder().encode((text ?? '') + '\0');
        const verts = Math.floor(model.positions.length / 3), tris = Math.floor(model.indices.length / 3);
        const paints = model.materials ?? [], images = model.textures ?? [];
        const answer = this.#ask(() => {
            this.#with(
                name(model.name ?? 'model'), (at) => c.model_begin(at, verts, tris, paints.length, images.length));
            const put = (which, Type, from, n) => {
                if (from === undefined || from === null) return;
                const at = c.model_array(which);  // the memory may grow, and its buffer become another one
                new Type(c.memory.buffer, at, n).set(from.length > n ? from.subarray(0, n) : from);
            };
            put(0, Float64Array, model.positions, 3 * verts);
            if (model.uvs) {
                const at = c.model_array(1);
                const uvs = new Float64Array(c.memory.buffer, at, 2 * verts).fill(NaN);
                uvs.set(model.uvs);
                if (!model.uvDown)
                    for (let i = 1; i < uvs.length; i += 2) uvs[i] = 1 - uvs[i];
            }
            put(2, Float32Array, model.normals, 3 * verts);
            put(3, Float32Array, model.colors, 3 * verts);
            put(4, Uint32Array, model.indices, 3 * tris);
            put(5, Uint32Array, model.triMaterial, tris);
            paints.forEach((paint, i) => {
                const at = this.#with(name(paint.name), (text) => c.model_paint(i, text));
                new Float64Array(c.memory.buffer, at, 22).set(paintNumbers(paint));
            });
            images.forEach((image, i) => {
                const at = this.#with(name(image.name), (text) => c.model_image(i, text, image.width, image.height));
                if (at !== 0) this.#bytes(at, 4 * image.width * image.height).set(image.rgba);
            });
            return c.model_end(0, model.single ?? model.positions instanceof Float32Array ? 1 : 0, model.flat ? 1 : 0);
        });
        if (answer.ok) this.#changed(model.name ?? 'model');
        const losses = answer.ok ? this.#text(c.losses()).split('\n').filter((line) => line !== '') : [];
        return {...answer, losses: [...(answer.ok ? model.losses ?? [] : []), ...losses ]};
    }

    #words(args) {
        const words = [];
        const known = new Map(this.options().map((one) => [one.name, one]));
        if (args.width !== undefined || args.height !== undefined)
            words.push(`--size=${args.width ?? 240}x${args.height ?? 240}`);
        for (const [name, value] of Object.entries(args)) {
            const one = known.get(name);
            if (name === 'width' || name === 'height') continue;
            if (name === 'falseColors' && value === 'wrong') {
                words.push('--compare');
                continue;
            }
            if (one?.kind === 'flag') {
                if (value) words.push(one.zsim);
            } else {
                words.push(`${one?.zsim ?? '--' + name}=${value}`);
            }
        }
        return words;
    }

    /** Change options, by their names of options(); undefined or null gives one back to the engine. What is refused
     * changes nothing.
     * @param {Object<string, any>} changes
     * @returns {Answer} */
    configure(changes) {
        const args = {...this.#args, ...changes};
        for (const name of Object.keys(args))
            if (args[name] === undefined || args[name] === null) delete args[name];
        const words = this.#words(args);
        const bytes = new TextEncoder().encode(words.map((word) => word + '\0').join('') || '\0');
        const answer = this.#ask(() => this.#with(bytes, (at) => this.#c.configure(at, bytes.length, words.length)));
        if (answer.ok) {
            this.#args = args;
            const {panel, rotate} = args;
            if (panel !== undefined || args.falseColors === undefined) this.#panel = {panel, rotate};
            this.#changed(this.#name);
        }
        return answer;
    }

    /** Options as `zsim render` takes them.
     * @returns {string[]} */
    commandLine() { return this.#words(this.#args); }

    /** Turn the camera about the middle of what is drawn, from where it would stand.
     * @param {number} yaw  radians
     * @param {number} pitch  radians
     * @param {number} [distance]  factor, 1 is its own */
    orbit(yaw, pitch, distance = 1) { this.#c.orbit(yaw, pitch, distance); }

    /** The frame of a scene's animation.
     * @param {number} frame  any whole number */
    setTime(frame) {
        this.#figured = null;
        this.#c.time(frame >>> 0);
    }

    /** Draw a frame. Where it is refused the last good one stays. pixels and depth are views of the engine's memory,
     * good until its next call.
     * @returns {{ok: boolean, error: string, width: number, height: number, pixels: Uint16Array, depth: ?Uint16Array,
     *            stats: Object<string, number>, passes: number}} */
    render() {
        const answer = this.#ask(() => this.#c.render());
        const width = this.#c.width(), height = this.#c.height(), n = width * height;
        const view = (at) => (at !== 0 ? new Uint16Array(this.#c.memory.buffer, at, n) : null);
        const stats = n > 0 ? JSON.parse(this.#text(this.#c.stats())) : {};
        return {
            ...answer,
            width,
            height,
            pixels: view(this.#c.pixels()) ?? new Uint16Array(0),
            depth: view(this.#c.keys()),
            stats,
            passes: stats.passes ?? 0,
        };
    }

    /** The size of the picture that rgba writes: the frame's, or with false colours the frame's with its legend.
     * @returns {{width: number, height: number}} */
    pictureSize() {
        const shown = this.#c.shown() !== 0;
        return shown ? {width: this.#c.shown_width(), height: this.#c.shown_height()} :
                       {width: this.#c.width(), height: this.#c.height()};
    }

    /** The last frame, or its false colours, as RGBA.
     * @param {Uint8ClampedArray|Uint8Array} target  four bytes a pixel of pictureSize() */
    rgba(target) {
        const {width, height} = this.pictureSize(), n = width * height, at = this.#c.shown();
        const out = new Uint32Array(target.buffer, target.byteOffset, n);
        if (at !== 0) {
            const rgb = this.#bytes(at, 3 * n);
            for (let i = 0; i < n; i++) out[i] = 0xff000000 | rgb[3 * i + 2] << 16 | rgb[3 * i + 1] << 8 | rgb[3 * i];
            return;
        }
        const pixels = new Uint16Array(this.#c.memory.buffer, this.#c.pixels(), n);
        for (let i = 0; i < n; i++) {
            const c = pixels[i], r = c >> 11, g = c >> 5 & 63, b = c & 31;
            out[i] = 0xff000000 | (b << 3 | b >> 2) << 16 | (g << 2 | g >> 4) << 8 | (r << 3 | r >> 2);
        }
    }

    #figures() {
        if (this.#figured === null) {
            let answer = null;
            const {panel = '', rotate = 0} = this.#args.panel === undefined ? this.#panel : {};
            const {error} = this.#ask(() => this.#with(new TextEncoder().encode(panel + '\0'), (at) => {
                const text = this.#c.figures(at, rotate / 90);
                answer = text !== 0 ? JSON.parse(this.#text(text)) : null;
                return answer === null ? 1 : 0;
            }));
            this.#figured = answer ?? {ram: {pools: [], arena: 0, total: 0}, parts: [], error};
        }
        return this.#figured;
    }

    /** RAM that a frame takes on a Cortex-M3, by pool; where no pools were set, those that hold the scene in one pass.
     * @returns {{pools: {name: string, bytes: number}[], arena: number, total: number, error?: string}} */
    ram() {
        const {ram, error} = this.#figures();
        return error ? {...ram, error} : ram;
    }

    /** What a frame takes on each part that zsim budget knows. fps, flashUsed: null where not known; why says so of
     * fps. fpsError: a share: as far off as estimates of demo scenes are, which the estimate was not fitted to.
     * @returns {{name: string, text: string, core: string, mhz: number, ramBytes: number, flashBytes: number,
     *            ramUsed: number, flashUsed: ?number, ramFits: boolean, flashFits: boolean, drawMs: ?number,
     *            wireMs: number, fps: ?number, fpsError: number, limit: 'drawing'|'wire', why?: string}[]} */
    parts() { return this.#figures().parts; }

    /** What is wrong with the picture, if anything is.
     * @returns {string[]} */
    explain() {
        this.#said = '';
        this.#c.explain();
        return this.#said.split('\n')
            .filter((line) => line !== '')
            .map((line) => line.replace(/^zstrip: [^ ]*: /, ''));
    }

    /** The model as C for firmware, as `zsim convert` writes it with the options that are set.
     * @param {string} name  a C identifier
     * @returns {Object<string, string>} text by file name; of a scene, or a name that is none, an
     *   EngineError is thrown */
    files(name) {
        const SHARED = [ '--cull', '--precise', '--texture-format', '--wrap', '--color', '--simplify' ];
        const words = this.#words(this.#args).filter((word) => SHARED.includes(word.split('=')[0]));
        if (this.#args.shade !== undefined)
            words.push(`--shade=${this.#args.shade === 'id' ? 'raw' : this.#args.shade}`);
        words.unshift('--name', name, '--out', '.');
        words.push('--', this.#name);
        const bytes = new TextEncoder().encode(words.map((word) => word + '\0').join(''));
        let out = null;
        const answer = this.#ask(() => this.#with(bytes, (at) => {
            const text = this.#c.convert(at, bytes.length, words.length);
            out = text !== 0 ? JSON.parse(this.#text(text)) : null;
            return out === null ? 1 : 0;
        }));
        if (out === null) throw new EngineError(answer.error);
        return {[`${name}.c`] : out.c, [`${name}.h`] : out.h};
    }

    /** What is set, as a header for firmware: a renderer with its pools, mapping, method and accelerators.
     * @returns {string} an EngineError is thrown where there is none */
    config() {
        let out = null;
        const answer = this.#ask(() => {
            const text = this.#c.config();
            out = text !== 0 ? this.#text(text) : null;
            return out === null ? 1 : 0;
        });
        if (out === null) throw new EngineError(answer.error);
        return out;
    }

    /** What is drawn now as the Pico's prebuilt show takes it (firmware/app/show_model.h): its bytes, with addresses of
     * flash from `base` on; `names` are words in them, by place, that become addresses of what the show holds.
     * @param {{frames: number, arena: number, flash: number}} room  frames that go once round it; bytes of RAM and
     *   flash that the show leaves
     * @returns {Answer & {bytes?: Uint8Array, base?: number, frames?: number, rows?: number, tris?: number,
     *   verts?: number, shrunk?: boolean, names?: [number, string, string][]}}  names: place, name, and the effect that
     *   it is part of; shrunk: pools or strips are smaller than what takes the frame in one pass */
    flash({frames, arena, flash}) {
        let got = null;
        const answer = this.#ask(() => {
            const text = this.#c.flash(frames, arena, flash);
            got = text !== 0 ? JSON.parse(this.#text(text)) : null;
            return got === null ? 1 : 0;
        });
        return got === null ? answer : {...answer, ...got, bytes: this.#bytes(got.at, got.bytes).slice()};
    }

    /** A panel's module, powered on, for panelTakes. invert: its glass shows negatives until it is told to invert.
     * @returns {Answer} */
    panelBegins(name, invert) {
        return this.#ask(() => this.#with(new TextEncoder().encode(name + '\0'),
                                          (at) => this.#c.glass_begin(at, invert ? 1 : 0)));
    }

    /** Feed it with words of a wire: bits 0-7 a byte, bit 8 D/C; bit 9 alone: RESET went low; bit 11 alone: CS went
     * high. Then what is seen on it.
     * @param {Uint16Array} words
     * @returns {Answer & {rgb: Uint8Array}} rgb: [height][width][3], a view that is good until the next call */
    panelTakes(words) {
        const bytes = new Uint8Array(words.buffer, words.byteOffset, words.byteLength);
        this.#with(bytes, (at) => this.#c.glass_feed(at, words.length));
        let at = 0;
        const answer = this.#ask(() => {
            at = this.#c.glass_picture();
            return at === 0 ? 1 : 0;
        });
        return {...answer, rgb: at === 0 ? new Uint8Array(0) : new Uint8Array(this.#c.memory.buffer, at)};
    }
}
