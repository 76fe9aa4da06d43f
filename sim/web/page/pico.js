/* The firmware itself: the prebuilt show with what is drawn in it, to be downloaded, or run here in an emulated Pico
 * whose panel is decoded onto a canvas.
 *
 * SPDX-License-Identifier: MIT
 */
import { bytes, count, id, make } from './dom.js';
import { flashLeft, imageWith, prebuilt, uf2Of } from './uf2.js';
import { packed } from './wasm.js';

const FRAMES = 120; /* that go once round what is drawn */
const SIDE = 240; /* px */
const PANEL = 'st7789:240x240';

/* RGB of a panel onto the canvas; the same as words. */
function paint(rgb) {
    const context = id('pico-glass').getContext('2d'),
        image = context.createImageData(SIDE, SIDE),
        seen = new Uint32Array(image.data.buffer);
    for (let i = 0; i < seen.length; i++)
        seen[i] = 0xff000000 | (rgb[3 * i + 2] << 16) | (rgb[3 * i + 1] << 8) | rgb[3 * i];
    context.putImageData(image, 0, 0);
    return seen;
}

/** A list's term and what it is. */
const fact = (term, is) => make('div', {}, make('dt', {}, term), make('dd', {}, is));

/** The section. current: gives {engine, estimate: ms of drawing that the page says of an RP2040, or null, view: the
 * stage's, orbit(view): sets the engine's camera}. save(name, bytes): downloads. */
export class Firmware {
    #show = null;
    #worker = null;
    #first = null; /* of the first frame: by how many percent its estimate is off */
    #run = 0; /* a number for each start; answers of others are not looked at */

    constructor(current, save) {
        this.current = current;
        this.save = save;
        id('get-uf2').addEventListener('click', () => this.#guarded(() => this.#download()));
        id('pico-run').addEventListener('click', () =>
            this.#guarded(() => (this.#worker ? this.stop() : this.#start())),
        );
    }

    async #guarded(what) {
        id('pico-why').textContent = '';
        try {
            await what();
        } catch (e) {
            id('pico-why').textContent = e.message;
        }
        document.documentElement.dataset.pico = String(Number(document.documentElement.dataset.pico || 0) + 1);
    }

    /* The image of what is drawn now. */
    async #image() {
        this.#show ??= await prebuilt();
        const show = this.#show,
            { engine, orbit } = this.current();
        orbit();
        const model = engine.flash({ frames: FRAMES, arena: show.arena, flash: flashLeft(show) });
        if (!model.ok) throw new Error(model.error);
        const made = imageWith(show, model);
        id('chip').hidden = false;
        id('pico-facts').replaceChildren(
            fact('flash', bytes(show.image.length + model.bytes.length)),
            fact('of it the model', bytes(model.bytes.length)),
            fact('strips', `${model.rows} rows`),
            fact('triangles at a time', count(model.tris)),
            fact('vertices at a time', count(model.verts)),
        );
        id('pico-note').textContent = model.shrunk
            ? 'Its RAM does not hold the frame in one pass: pools are smaller, which takes time and no pixel.'
            : '';
        return { ...made, frames: model.frames };
    }

    async #download() {
        const made = await this.#image();
        this.save('show.uf2', uf2Of(made));
    }

    async #start() {
        const made = await this.#image(),
            run = ++this.#run,
            { engine, view } = this.current();
        const begun = engine.panelBegins(PANEL, true);
        if (!begun.ok) throw new Error(begun.error);
        const code = new TextDecoder().decode(await packed('emulator'));
        const url = URL.createObjectURL(new Blob([code], { type: 'text/javascript' }));
        const worker = new Worker(url);
        URL.revokeObjectURL(url);
        this.#worker = worker;
        this.#say(true);
        id('chip').classList.add('runs');
        document.documentElement.dataset.picoFrame = '0';
        id('pico-say').textContent = 'The chip boots…';
        const from = { ...view };
        let frame = 0;
        worker.onmessage = ({ data }) => {
            if (run !== this.#run) return;
            if (data.error) {
                id('pico-why').textContent = `The emulated chip: ${data.error}`;
                this.stop();
                return;
            }
            this.#shown(data, from, frame++, made.frames);
            worker.postMessage({});
        };
        worker.postMessage({ image: made.image, symbols: this.#show.symbols });
    }

    /* A picture has reached the panel: onto the canvas, and against the page's own of the same frame. */
    #shown({ words, cycles, ns }, from, frame, frames) {
        const { engine, estimate, orbit } = this.current(),
            step = frame % frames,
            got = engine.panelTakes(words);
        if (!got.ok) {
            id('pico-why').textContent = got.error;
            this.stop();
            return;
        }
        const differ = this.#compare(paint(got.rgb), { ...from, yaw: from.yaw + (360 * step) / frames });
        orbit();
        engine.render();
        if (step === 0) this.#first = estimate ? Math.round(100 * (estimate / (cycles / 125e3) - 1)) : null;
        const root = document.documentElement.dataset;
        root.picoFrame = String(frame + 1);
        root.picoCycles = String(cycles);
        root.picoDiffer = String(Math.max(differ, frame > 0 ? Number(root.picoDiffer) : 0));
        id('pico-cycles').textContent = count(cycles);
        const off = this.#first;
        const by = off ? `${Math.abs(off)} % too ${off < 0 ? 'short' : 'long'}` : 'to half a percent';
        id('pico-say').replaceChildren(
            `Frame ${frame + 1}: ${(cycles / 125e3).toFixed(1)} ms of drawing at 125 MHz` +
                (frame > 0 ? `, ${(1e9 / ns).toFixed(1)} frames a second with the wire. ` : '. '),
            make('b', {}, differ > 0 ? `${count(differ)} pixels differ.` : 'Every pixel is the page\u2019s.'),
            off === null ? '' : ` The first frame was estimated ${by}.`,
        );
    }

    /* How many pixels of the panel are not those that the page draws from there. */
    #compare(seen, view) {
        const { engine, orbit } = this.current(),
            rgba = new Uint8ClampedArray(4 * SIDE * SIDE);
        orbit(view);
        if (!engine.render().ok) return seen.length;
        engine.rgba(rgba);
        const wanted = new Uint32Array(rgba.buffer);
        return seen.reduce((n, v, i) => n + (v !== wanted[i]), 0);
    }

    /** End it; nothing happens where it does not run. */
    stop() {
        if (!this.#worker) return;
        this.#worker.terminate();
        this.#worker = null;
        this.#run++;
        this.#say(false);
    }

    #say(runs) {
        id('pico-run').setAttribute('aria-pressed', String(runs));
        id('pico-run').textContent = runs ? 'Stop the emulator' : 'Run it in an emulated Pico';
    }
}
