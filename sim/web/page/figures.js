/* Bars of RAM and flash, frames a second, what each stage left out. SPDX-License-Identifier: MIT */
import { bytes, count, id, make } from './dom.js';

const color = (i) => `var(--c${i % 8})`;

/* A bar whose pieces are [{name, bytes}] of a whole. */
function track(pieces, whole) {
    const sum = pieces.reduce((s, p) => s + (p.bytes || 0), 0),
        scale = Math.max(sum, whole) || 1;
    return make(
        'div',
        { className: 'track' },
        ...pieces.map((p, i) =>
            make('i', {
                title: `${p.name}: ${bytes(p.bytes)}`,
                style: `width:${((100 * p.bytes) / scale).toFixed(3)}%;background:${p.color || color(i)}`,
            }),
        ),
    );
}

function meter(at, title, pieces, used, has, fits) {
    at.className = fits ? 'meter' : 'meter over';
    at.replaceChildren(
        make(
            'header',
            {},
            make('b', {}, fits ? title : `${title} does not fit`),
            make('span', {}, used === null ? `of ${bytes(has)}` : `${bytes(used)} of ${bytes(has)}`),
        ),
        used === null
            ? make('p', { className: 'hint' }, 'There is no figure for these settings.')
            : track(pieces, has),
    );
}

const has = (part, kind) => part[`${kind}Bytes`];

/* Frames a second with two significant digits. */
export const rate = (fps) =>
    !(fps > 0) ? '–' : fps >= 100 ? count(fps) : fps >= 10 ? fps.toFixed(0) : fps.toFixed(1);

/** The chosen part: its frames a second, what binds, RAM by pool, flash. */
export function showPart(part, ram) {
    const fits = part.ramFits && part.flashFits;
    id('fps').textContent = fits ? rate(part.fps) : '–';
    const error = part.fpsError > 0 ? `give or take ${Math.round(100 * part.fpsError)} %` : 'a rough estimate';
    const note = id('fps-note');
    note.replaceChildren();
    if (!fits) note.append(`It does not fit: ${part.ramFits ? 'flash' : 'RAM'} is too small.`);
    else if (!(part.fps > 0)) note.append(part.why || 'There is no estimate of time for these settings.');
    else
        note.append(
            `Estimated, ${error}. `,
            make('b', {}, part.limit === 'wire' ? 'The wire binds' : 'Drawing binds'),
            part.limit === 'wire'
                ? ': the panel takes no more.'
                : part.wireMs > 0
                  ? `: the wire would carry ${rate(1e3 / part.wireMs)} a second.`
                  : '.',
        );
    showRace(part);
    meter(id('ram-meter'), 'RAM', ram.pools, ram.total, has(part, 'ram'), part.ramFits);
    meter(
        id('flash-meter'),
        'Flash',
        [{ name: 'renderer, panel driver and scene', bytes: part.flashUsed, color: 'var(--c0)' }],
        part.flashUsed,
        has(part, 'flash'),
        part.flashFits,
    );
    id('pools').replaceChildren(
        ...ram.pools.map((p, i) =>
            make(
                'li',
                {},
                make('i', { style: `background:${color(i)}` }),
                make('span', {}, p.name),
                make('span', {}, count(p.bytes)),
            ),
        ),
    );
}

/* Drawing and wire as two bars of the same time. */
function showRace(part) {
    const rows = [
        ['drawing', part.drawMs],
        ['wire', part.wireMs],
    ].filter(([, ms]) => ms > 0);
    const most = Math.max(...rows.map(([, ms]) => ms), 1e-9);
    id('race').replaceChildren(
        ...rows.flatMap(([name, ms]) => [
            make('span', {}, name),
            make('i', { className: ms === most ? 'binds' : '', style: `width:${(100 * ms) / most}%` }),
            make('span', {}, `${ms.toFixed(1)} ms`),
        ]),
    );
}

/** A row for each part. choose: called with a part's name. */
export function showParts(parts, chosen, choose) {
    const list = id('part-list');
    if (list.childElementCount !== parts.length) {
        list.replaceChildren(
            ...parts.map((p) => {
                const row = make('button', { type: 'button', className: 'part' });
                row.dataset.part = p.name;
                row.addEventListener('click', () => choose(p.name));
                return row;
            }),
        );
    }
    parts.forEach((p, i) => {
        const row = list.children[i],
            fits = p.ramFits && p.flashFits;
        row.setAttribute('aria-pressed', String(p.name === chosen));
        const bar = (kind, title, used, ok) =>
            make(
                'div',
                { className: ok ? 'bar' : 'bar over' },
                used === null
                    ? `${title} – of ${bytes(has(p, kind))}`
                    : `${title} ${bytes(used)} of ${bytes(has(p, kind))}`,
                make(
                    'div',
                    { className: 'track' },
                    make('i', {
                        style:
                            `width:${Math.min(100, (100 * used) / has(p, kind)).toFixed(2)}%;` +
                            `background:${ok ? 'var(--c0)' : 'var(--bad)'}`,
                    }),
                ),
            );
        row.replaceChildren(
            make('div', { className: 'who' }, make('b', {}, p.title || p.name), make('small', {}, p.text || '')),
            make(
                'div',
                { className: 'rate' },
                fits ? rate(p.fps) : '–',
                make('small', {}, fits && p.fps > 0 ? ' fps' : ''),
            ),
            bar('ram', 'RAM', p.ramUsed, p.ramFits),
            bar('flash', 'flash', p.flashUsed, p.flashFits),
        );
    });
}

/* ---- Statistics ---- */

function funnel(title, rows, foot) {
    const whole = rows.reduce((s, r) => s + r[1], 0);
    return make(
        'div',
        { className: 'funnel' },
        make('h3', {}, title),
        track(
            rows.map(([name, n, tint]) => ({ name, bytes: n, color: tint })),
            whole,
        ),
        make(
            'ul',
            {},
            ...rows
                .filter(([, n]) => n > 0)
                .map(([name, n, tint]) =>
                    make(
                        'li',
                        {},
                        make('i', { style: `background:${tint}` }),
                        make('span', {}, name),
                        make('b', {}, count(n)),
                    ),
                ),
        ),
        make('p', { className: 'hint' }, foot),
    );
}

/** What the frame took, and what each skip saved. */
export function showStats(s, passes) {
    const n = (name) => s[name] || 0;
    const triangles = [
        ['drawn', n('tris_drawn'), 'var(--c0)'],
        ['turned away', n('tris_facing'), 'var(--c2)'],
        ['in clusters that are out of view or turned away', n('tris_cluster'), 'var(--c6)'],
        ['in things out of view or hidden', n('tris_frustum'), 'var(--c4)'],
        ['beside the picture', n('tris_offscreen'), 'var(--c3)'],
        ['nearer than near, beyond far', n('tris_near') + n('tris_far'), 'var(--c5)'],
        ['too small to cover a pixel', n('tris_empty') + n('tris_zero'), 'var(--c7)'],
    ];
    const setups = [
        ['set up: a triangle in a strip', n('tris_setup'), 'var(--c0)'],
        ['saved: covered by what lies in front', n('tris_hidden'), 'var(--c2)'],
    ];
    const pixels = [
        ['coloured', n('pixels_written'), 'var(--c0)'],
        ['compared, and behind', Math.max(0, n('pixels_tested') - n('pixels_written')), 'var(--c1)'],
        ['left out before a comparison', n('pixels_untested'), 'var(--c2)'],
    ];
    const left = n('tris_in') - n('tris_drawn');
    id('took-lead').textContent =
        n('tris_in') === 0
            ? ''
            : `${count(n('tris_drawn'))} of ${count(n('tris_in'))} triangles are ` +
              `drawn, in ${count(n('strips'))} strips and ` +
              `${passes === 1 ? 'one pass' : `${passes} passes`} over the scene. ` +
              `${Math.round((100 * left) / n('tris_in'))} % were left out before anything was drawn of them.`;
    id('funnels').replaceChildren(
        funnel('Triangles', triangles, `${count(n('verts_transformed'))} vertices were transformed.`),
        funnel('Set-ups', setups, 'A triangle is set up once in each strip that it crosses.'),
        funnel(
            'Pixels',
            pixels,
            n('pixels_visible') > 0
                ? `${(n('pixels_written') / n('pixels_visible')).toFixed(2)} times coloured, a pixel that is seen.`
                : 'Of all triangles that cover one.',
        ),
    );
    id('counts').replaceChildren(
        ...Object.entries(s)
            .filter(([, v]) => typeof v === 'number')
            .map(([name, v]) =>
                make(
                    'div',
                    {},
                    make('dt', {}, name.replace(/_/g, ' ')),
                    make('dd', {}, Number.isInteger(v) ? count(v) : v.toPrecision(4)),
                ),
            ),
    );
}
