/* Time on a part against error, a dot for each of many settings, and a mark that follows those that are set.
 *
 * Time is what drawing takes on the part, as zsim budget estimates it; error is how many pixels are not those of the
 * double-precision reference. SPDX-License-Identifier: MIT
 */
import { id, make } from './dom.js';

const BITS = [16, 14, 12, 10, 8];
/* What is tried: one change each, of what is set. */
const TRIED = [
    ...['float', 'recip', 'linear'].flatMap((depthMapping) =>
        BITS.map((depthBits) => ({ kind: depthMapping, set: { depthMapping, depthBits } })),
    ),
    ...[4, 8, 16, 32, 64].map((strip) => ({ kind: 'strip', set: { strip } })),
    ...[4, 8].map((subpixel) => ({ kind: 'sub-pixel bits', set: { subpixel } })),
];
const TINTS = { float: '--c0', recip: '--c5', linear: '--c2', strip: '--c1', 'sub-pixel bits': '--c3' };
const textOf = ({ kind, set }) =>
    set.depthBits ? `${kind}, ${set.depthBits} bits` : kind === 'strip' ? `strips of ${set.strip} rows` :
        `${set.subpixel} ${kind}`;

/* Draw the view of wrong pixels with a change, take the figures of it, and put back what was there. null: it was
 * refused. */
function measure({ engine, part, view }, set) {
    const changes = { ...set, ...view };
    const before = {};
    for (const o of engine.options()) if (o.name in changes) before[o.name] = o.value;
    let point = null;
    if (engine.configure(changes).ok) {
        const got = engine.render();
        const on = engine.parts().find((p) => p.name === part);
        const s = got.stats,
            wrong = (s.wrong_missing || 0) + (s.wrong_extra || 0) + (s.wrong_color || 0);
        if (got.ok && on && on.drawMs > 0) point = { ms: on.drawMs, wrong, of: got.width * got.height };
    }
    engine.configure(before);
    return point;
}

const SVG = 'http://www.w3.org/2000/svg';
function draw(tag, attributes, ...children) {
    const e = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
    e.append(...children);
    return e;
}

const W = 640,
    H = 300,
    BOX = { left: 62, right: 620, top: 14, bottom: 252 };

function plot(points, now, trail) {
    const all = [...points, ...(now ? [now] : []), ...trail];
    const most = Math.max(...all.map((p) => p.ms)) * 1.06,
        least = Math.min(...all.map((p) => p.ms)) * 0.94,
        worst = Math.max(10, ...all.map((p) => p.wrong));
    const x = (ms) => BOX.left + ((BOX.right - BOX.left) * (ms - least)) / (most - least);
    const y = (wrong) => BOX.bottom - ((BOX.bottom - BOX.top) * Math.log1p(wrong)) / Math.log1p(worst);
    const svg = draw('svg', { viewBox: `0 0 ${W} ${H}`, role: 'img', class: 'scatter',
        'aria-label': 'Time on the part against wrong pixels, a dot for each setting; the table has the figures' });
    for (const tick of [0, 1, 10, 100, 1000, 10000].filter((t) => t <= worst))
        svg.append(
            draw('line', { x1: BOX.left, x2: BOX.right, y1: y(tick), y2: y(tick), class: 'grid' }),
            draw('text', { x: BOX.left - 8, y: y(tick) + 4, 'text-anchor': 'end' }, tick.toLocaleString('en-US')),
        );
    const step = round((most - least) / 4);
    for (let ms = Math.ceil(least / step) * step; ms <= most; ms += step)
        svg.append(
            draw('text', { x: x(ms), y: BOX.bottom + 20, 'text-anchor': 'middle' }, String(Number(ms.toPrecision(6)))),
        );
    svg.append(
        draw('text', { x: BOX.right, y: H - 6, 'text-anchor': 'end' }, 'ms of drawing on the part'),
        draw('text', { x: BOX.left, y: H - 6 }, '↑ wrong pixels'),
    );
    for (const p of points)
        svg.append(
            draw('circle', { cx: x(p.ms), cy: y(p.wrong), r: 6, style: `fill:var(${TINTS[p.kind]})` },
                draw('title', {}, `${p.text}: ${p.ms.toFixed(2)} ms, ${p.wrong} wrong pixels`)),
        );
    if (trail.length > 0 && now)
        svg.append(draw('polyline', { class: 'trail',
            points: [...trail, now].map((p) => `${x(p.ms)},${y(p.wrong)}`).join(' ') }));
    if (now) svg.append(draw('circle', { cx: x(now.ms), cy: y(now.wrong), r: 10, class: 'now' },
        draw('title', {}, 'what is set')));
    return svg;
}

/* The next of 1, 2, 5, 10, 20 ... */
function round(step) {
    const ten = 10 ** Math.floor(Math.log10(step));
    return ten * [1, 2, 5, 10].find((n) => n * ten >= step * (1 - 1e-9));
}

function table(points) {
    const row = (cell, ...texts) => make('tr', {}, ...texts.map((t) => make(cell, {}, t)));
    return make('table', {}, row('th', 'setting', 'ms', 'wrong pixels'),
        ...[...points].sort((a, b) => a.wrong - b.wrong || a.ms - b.ms)
            .map((p) => row('td', p.text, p.ms.toFixed(2), p.wrong.toLocaleString('en-US'))));
}

/** The picture. current: gives the engine, the part, what is drawn, and what the view of wrong pixels asks of the
 * engine; ended: called when the engine's frame has to be drawn again. */
export class Tradeoff {
    #points = [];
    #trail = [];
    #now = null;
    #busy = false;
    #of = '';

    constructor(current, ended) {
        this.current = current;
        this.ended = ended;
        id('measure').addEventListener('click', () => this.run());
    }

    async run() {
        if (this.#busy) return;
        this.#busy = true;
        id('measure').disabled = true;
        this.#points = [];
        this.#trail = [];
        const of = this.current();
        this.#of = of.part + of.what;
        this.#now = measure(of, {});
        for (let i = 0; i < TRIED.length; i++) {
            id('tradeoff-say').textContent = `Drawn ${i} of ${TRIED.length} ways…`;
            await new Promise((go) => setTimeout(go));
            const now = this.current();
            if (now.part + now.what !== this.#of) break; /* what was measured is not comparable */
            const point = measure(now, TRIED[i].set);
            if (point) this.#points.push({ ...point, ...TRIED[i], text: textOf(TRIED[i]) });
        }
        this.#busy = false;
        id('measure').disabled = false;
        this.ended();
        this.#show();
    }

    /** What is set has changed. */
    follow() {
        const of = this.current();
        if (this.#busy || this.#points.length === 0) return;
        if (of.part + of.what !== this.#of) {
            this.#points = [];
            id('tradeoff').replaceChildren();
            id('tradeoff-say').textContent = 'Measure again: this is another scene or part.';
            return;
        }
        const now = measure(of, {});
        if (!now) return;
        if (this.#now && (now.ms !== this.#now.ms || now.wrong !== this.#now.wrong))
            this.#trail = [...this.#trail, this.#now].slice(-12);
        this.#now = now;
        this.ended();
        this.#show();
    }

    #show() {
        const points = this.#points;
        if (points.length === 0) {
            id('tradeoff').replaceChildren();
            id('tradeoff-say').textContent = 'There is no reference, or no estimate of time, for this scene.';
            return;
        }
        id('tradeoff-say').textContent = this.#now
            ? `The ring is what is set: ${this.#now.ms.toFixed(2)} ms on ${this.current().part}, ` +
              `${this.#now.wrong.toLocaleString('en-US')} of ${this.#now.of.toLocaleString('en-US')} pixels wrong. ` +
              'Change a setting: it moves.'
            : '';
        id('tradeoff').replaceChildren(
            plot(points, this.#now, this.#trail),
            make('p', { className: 'legend' }, ...Object.entries(TINTS).map(([kind, tint]) =>
                make('span', { style: `--k:var(${tint})` }, kind))),
            make('details', {}, make('summary', {}, 'The figures'), table(points)),
        );
    }
}
