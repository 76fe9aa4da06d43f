/* Teaching cards: each method on 8x8 pixels, and how depth mappings spend their keys. SPDX-License-Identifier: MIT */
import { make } from './dom.js';
import { BARS, coverage, depthsort, hiz, N, painter, raycast, zbuffer } from './toy.js';

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const redraws = [];
function redrawAll() {
    for (const redraw of redraws) redraw();
}

/* A canvas of that many CSS pixels, sharp on any screen, twice as large too. draw is called with its context. */
function plot(width, height, label, draw) {
    const ratio = 2 * Math.max(1, Math.min(2, Math.ceil(window.devicePixelRatio || 1)));
    const canvas = make('canvas', { width: width * ratio, height: height * ratio, role: 'img', 'aria-label': label });
    const again = () => {
        const c = canvas.getContext('2d', { willReadFrequently: true }); // small, and tests read it
        c.setTransform(ratio, 0, 0, ratio, 0, 0);
        c.clearRect(0, 0, width, height);
        draw(c, width, height);
    };
    redraws.push(again);
    return { canvas, again };
}

/* ---- Methods ---- */

const CELL = 22,
    GAP = 24;

function drawState(c, s) {
    c.font = `500 10px ${css('--mono')}`;
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    for (let i = 0; i < N * N; i++) {
        const x = 8 + (i % N) * CELL,
            y = 8 + Math.floor(i / N) * CELL,
            right = x + N * CELL + GAP;
        c.fillStyle = s.color[i] ? css(s.color[i].tint) : css('--paper');
        c.fillRect(x, y, CELL - 1, CELL - 1);
        if (s.wrong && s.wrong.has(i)) {
            c.strokeStyle = css('--bad');
            c.lineWidth = 3;
            c.strokeRect(x + 2, y + 2, CELL - 5, CELL - 5);
        }
        const value = s.depth ? s.depth[i] : s.bits ? s.bits[i] : '';
        const part = s.depth ? value / 99 : s.bits ? 1 - value : 1;
        c.fillStyle = css('--paper');
        c.fillRect(right, y, CELL - 1, CELL - 1);
        if (s.depth || s.bits) {
            const dark = 0.85 * (1 - part) + 0.05;
            c.globalAlpha = dark;
            c.fillStyle = css('--ink');
            c.fillRect(right, y, CELL - 1, CELL - 1);
            c.globalAlpha = 1;
            c.fillStyle = css(dark > 0.56 ? '--card' : part < 1 ? '--ink' : '--soft');
            c.fillText(String(value), right + CELL / 2 - 0.5, y + CELL / 2);
        }
        if (s.mark.has(i)) {
            c.strokeStyle = css('--ink');
            c.lineWidth = 1.5;
            c.strokeRect(x + 0.75, y + 0.75, CELL - 2.5, CELL - 2.5);
        }
    }
    if (s.tiles) {
        c.strokeStyle = css('--gold');
        c.lineWidth = 2;
        for (let t = 0; t < 4; t++)
            c.strokeRect(
                8 + N * CELL + GAP + (t % 2) * 4 * CELL - 0.5,
                8 + Math.floor(t / 2) * 4 * CELL - 0.5,
                4 * CELL,
                4 * CELL,
            );
    }
    if (!s.depth && !s.bits) {
        c.fillStyle = css('--soft');
        c.font = `13px ${css('--mono')}`;
        c.fillText('no depth memory', 8 + N * CELL * 1.5 + GAP, 8 + (N * CELL) / 2);
    }
}

function methodCard(title, about, method) {
    let order = [...(method.bars || BARS)],
        run = method(order),
        state,
        timer = 0;
    const width = 16 + 2 * N * CELL + GAP,
        height = 16 + N * CELL;
    const { canvas, again } = plot(width, height, `${title}: the picture, and what is in memory`, (c) =>
        drawState(c, state),
    );
    const say = make('p', { className: 'say', role: 'status' });
    const show = () => {
        say.textContent = state.say;
        canvas.dataset.colors = state.color.map((p) => (p ? p.name : '-')).join(' ');
        canvas.dataset.values = (state.depth || state.bits || []).join(' ');
        canvas.dataset.tiles = (state.tiles || []).join(' ');
        again();
    };
    const begin = () => {
        run = method(order);
        state = run.next().value;
        show();
    };
    const stop = () => {
        clearInterval(timer);
        timer = 0;
        play.textContent = 'Play';
        play.setAttribute('aria-pressed', 'false');
    };
    const step = () => {
        const next = run.next();
        if (next.done) return false;
        state = next.value;
        show();
        return true;
    };
    const button = (text, what) => {
        const b = make('button', { type: 'button' }, text);
        b.addEventListener('click', what);
        return b;
    };
    const play = button('Play', () => {
        if (timer) {
            stop();
            return;
        }
        if (!step()) begin();
        play.textContent = 'Stop';
        play.setAttribute('aria-pressed', 'true');
        timer = setInterval(() => step() || stop(), 900);
    });
    const next = button('Step', () => {
        stop();
        if (!step()) begin();
    });
    const other = button('Other order', () => {
        stop();
        order.push(order.shift());
        begin();
    });
    for (const last of run) state = last; // shown done at first
    show();
    return make(
        'article',
        { className: 'card' },
        make('h3', {}, title),
        make('p', {}, about),
        canvas,
        say,
        make('div', { className: 'row' }, play, next, other),
    );
}

/* ---- Depth mappings ---- */

const MAPPINGS = [
    ['recip', '--c5', (z, n, f, keys) => ((keys - 1) * (1 / n - 1 / z)) / (1 / n - 1 / f)],
    ['linear', '--c2', (z, n, f, keys) => ((keys - 1) * (z - n)) / (f - n)],
    ['e3m13', '--c1', (z, n, f, keys) => floatKey(z, n, 3, keys)],
    ['e4m12', '--c0', (z, n, f, keys) => floatKey(z, n, 4, keys)],
    ['e5m11', '--c3', (z, n, f, keys) => floatKey(z, n, 5, keys)],
];

/* The exponent bits that zstrip's mapping float takes for that far / near. */
const floatBits = (n, f) => (f <= 128 * n ? 3 : f <= 32768 * n ? 4 : 5);
/* A name as 16 bits have it, for any number of them. */
const nameOf = (name, bits) => (name[0] === 'e' ? `e${name[1]}m${bits - Number(name[1])}` : name);

/* near / z as an unsigned float of e exponent bits. */
function floatKey(z, n, e, keys) {
    const m = Math.log2(keys) - e,
        r = n / z;
    const k = Math.min(2 ** e - 2, Math.floor(-Math.log2(r) + 1e-12)),
        octave = 2 ** e - 1 - k;
    return keys - ((octave - 1) * 2 ** m + r * 2 ** (k + 1 + m));
}

/* How far apart two surfaces at z must be for two different keys. */
const apart = (key, z, n, f, keys) => {
    const h = z * 1e-6;
    return (2 * h) / Math.max(1e-30, key(z + h, n, f, keys) - key(z - h, n, f, keys));
};
const length = (m) =>
    m >= 1000
        ? `${(m / 1000).toPrecision(3)} km`
        : m >= 1
          ? `${m.toPrecision(3)} m`
          : m >= 0.01
            ? `${(100 * m).toPrecision(2)} cm`
            : `${(1000 * m).toPrecision(2)} mm`;

function mappingCard() {
    const set = { near: 1, far: 1000, bits: 16, at: 300 };
    const say = make('p', { className: 'say', role: 'status' }),
        legend = make('p', { className: 'legend' });
    const box = { left: 14, top: 12, right: 386, bottom: 186 };
    const xOf = (z) => box.left + ((box.right - box.left) * Math.log(z / 0.05)) / Math.log(4000 / 0.05);
    const zOf = (x) => 0.05 * (4000 / 0.05) ** ((x - box.left) / (box.right - box.left));
    const { canvas, again } = plot(
        400,
        216,
        'How keys are spent between near and far, a curve for each mapping',
        (c) => {
            const keys = 2 ** set.bits;
            c.fillStyle = css('--paper');
            c.fillRect(xOf(set.near), box.top, xOf(set.far) - xOf(set.near), box.bottom - box.top);
            c.lineWidth = 2.5;
            for (const [, tint, key] of MAPPINGS) {
                c.strokeStyle = css(tint);
                c.beginPath();
                for (let x = xOf(set.near); x <= xOf(set.far); x += 1)
                    c.lineTo(
                        x,
                        box.bottom -
                            (box.bottom - box.top) *
                                Math.min(1, key(Math.min(set.far, zOf(x)), set.near, set.far, keys) / keys),
                    );
                c.stroke();
            }
            c.font = `12px ${css('--mono')}`;
            c.textAlign = 'center';
            for (const [name, tint] of [
                ['near', '--ink'],
                ['far', '--ink'],
                ['at', '--gold'],
            ]) {
                const x = xOf(set[name]);
                c.strokeStyle = c.fillStyle = css(tint);
                c.lineWidth = 2;
                c.beginPath();
                c.moveTo(x, box.top);
                c.lineTo(x, box.bottom);
                c.stroke();
                c.beginPath();
                c.arc(x, box.bottom, 6, 0, 7);
                c.fill();
                if (name === 'at') c.fillStyle = css('--gold-ink');
                c.fillText(name === 'at' ? length(set.at) : name, Math.min(372, Math.max(28, x)), box.bottom + 20);
            }
        },
    );
    const fields = [];
    const update = () => {
        set.far = Math.max(set.far, set.near * 1.5);
        set.at = Math.min(set.far, Math.max(set.near, set.at));
        const gaps = MAPPINGS.map(([name, , key]) => {
            const gap = length(apart(key, set.at, set.near, set.far, 2 ** set.bits));
            return `${nameOf(name, set.bits)} ${gap}`;
        });
        const taken = nameOf(`e${floatBits(set.near, set.far)}`, set.bits);
        say.textContent =
            `At ${length(set.at)}, two surfaces get different keys if they are so far apart: ${gaps.join(', ')}. ` +
            `For this far and near, float is ${taken}.`;
        legend.replaceChildren(
            ...MAPPINGS.map(([name, tint]) => make('span', { style: `--k:var(${tint})` }, nameOf(name, set.bits))),
        );
        for (const f of fields) f();
        again();
    };
    const slider = (title, name, min, max, step, show, to = (v) => v, from = (v) => v) => {
        const input = make('input', { type: 'range', min, max, step }),
            out = make('b');
        input.addEventListener('input', () => {
            set[name] = to(Number(input.value));
            update();
        });
        fields.push(() => {
            input.value = from(set[name]);
            out.textContent = show(set[name]);
        });
        return make('label', { className: 'field' }, make('span', {}, title, out), input);
    };
    const power = [(v) => 10 ** v, Math.log10];
    const row = make(
        'div',
        { className: 'row' },
        slider('Near', 'near', -1.3, 2, 0.01, length, ...power),
        slider('Far', 'far', 0.3, 3.6, 0.01, length, ...power),
        slider('Bits', 'bits', 8, 16, 1, String),
    );
    let held = null;
    const placeOf = (e) =>
        ((e.clientX - canvas.getBoundingClientRect().left) * 400) / canvas.getBoundingClientRect().width;
    canvas.style.touchAction = 'pan-y';
    canvas.addEventListener('pointerdown', (e) => {
        const x = placeOf(e);
        held = ['at', 'near', 'far'].sort((a, b) => Math.abs(xOf(set[a]) - x) - Math.abs(xOf(set[b]) - x))[0];
        canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener('pointermove', (e) => {
        if (!held) return;
        const z = Math.min(4000, Math.max(0.05, zOf(placeOf(e))));
        set[held] = held === 'near' ? Math.min(z, set.far / 1.5) : held === 'far' ? Math.max(z, set.near * 1.5) : z;
        update();
    });
    for (const end of ['pointerup', 'pointercancel'])
        canvas.addEventListener(end, () => {
            held = null;
        });
    update();
    return make(
        'article',
        { className: 'card double' },
        make('h3', {}, 'What a depth key is worth'),
        make(
            'p',
            {},
            'Keys are few: 65,536 of 16 bits. A mapping says how they are spent from near to far; e3m13 is a float ' +
                'of 3 exponent and 13 mantissa bits. Drag near, far, and the distance that you ask about.',
        ),
        canvas,
        legend,
        say,
        row,
    );
}

/** Make all cards. */
export function buildCards(at) {
    at.append(
        methodCard(
            'Depth buffer',
            'Each pixel keeps the key of what is nearest so far. What is farther is left out. ' +
                'Two bytes a pixel, but only for one strip.',
            zbuffer,
        ),
        methodCard(
            'Painter’s algorithm',
            'Paint from far to near: no depth memory. It fails where things overlap in a cycle, as these do.',
            painter,
        ),
        methodCard(
            'Depth sort',
            'Painter’s algorithm that cuts a surface where no order is right. ' +
                'No depth memory, right pixels, more work.',
            depthsort,
        ),
        methodCard(
            'Coverage',
            'From near to far, with one bit a pixel: each pixel is coloured once, ' +
                'which pays where shading is expensive.',
            coverage,
        ),
        methodCard(
            'Hierarchical depth buffer',
            'Each tile knows its farthest key. What lies behind it is left out without a look at its pixels.',
            hiz,
        ),
        methodCard(
            'Ray casting',
            'The loops the other way round: for each pixel, find the nearest surface.',
            raycast,
        ),
        mappingCard(),
    );
    addEventListener('zstrip-theme', redrawAll);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redrawAll);
}
