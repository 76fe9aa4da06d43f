/* Controls, made from the engine's own table of options: what it adds is there without a change here.
 *
 * SPDX-License-Identifier: MIT
 */
import { id, make } from './dom.js';

const GROUPS = [
    ['Memory', ['strip', 'buffers', 'maxTriangles', 'maxVertices']],
    ['Depth', ['depthMapping', 'depthBits', 'near', 'far']],
    ['Picture', ['shade', 'method', 'samples', 'textureFormat', 'filter', 'fov']],
    [
        'Light and effects',
        ['light', 'ambient', 'diffuse', 'perPixel', 'specular', 'shadow', 'mirror', 'fog', 'alpha', 'blend', 'dither'],
    ],
];
const LABEL = {
    strip: 'Strip height',
    buffers: 'Strip buffers',
    maxTriangles: 'Triangles in memory',
    maxVertices: 'Vertices in memory',
    depthMapping: 'Depth mapping',
    depthBits: 'Bits of a depth key',
    near: 'Near plane',
    far: 'Far plane',
    shade: 'Shading',
    method: 'Visible surfaces by',
    samples: 'Samples a pixel',
    textureFormat: 'Texels',
    subpixel: 'Sub-pixel bits',
    fast: 'Accelerators',
    fov: 'Field of view',
    cull: 'Sides not drawn',
    width: 'Width',
    height: 'Height',
    spi: 'Clock of the wire, Hz',
    filter: 'Texture filter',
    perPixel: 'Light at each pixel',
    mirror: 'A mirror for a floor',
    shadow: 'Shadow',
    lineWidth: 'Width of lines',
    light: 'Light',
    specular: 'Highlights',
    blend: 'Transparent by',
    dither: 'Dithering',
    alpha: 'Opacity',
};
/* What texts look like */
const EXAMPLE = {
    light: '1,2,3 or point:2,2,2',
    specular: '20:0.5',
    fog: 'linear:1:4:808080',
    background: '203040',
    color: '4080c0',
    eye: '0,1,3',
    at: '0,0,0',
    up: '0,1,0',
};
const UNIT = { strip: 'rows', fov: '°', lineWidth: 'px', depthBits: 'bits' };
const CHOICE = {
    zbuffer: 'depth buffer',
    hiz: 'hierarchical depth buffer',
    painter: 'painter’s algorithm',
    depthsort: 'depth sort',
    coverage: 'coverage bits',
    raycast: 'ray casting',
    565: 'RGB565',
    pal8: '256 colours',
    pal4: '16 colours',
    recip: 'recip (1/z)',
    float: 'float (by far / near)',
};
/* Where a slider ends, of options whose table has no ends, or ends that nobody means */
const ENDS = {
    strip: [1, 120, 1],
    fov: [5, 120, 1],
    lineWidth: [1, 16, 1],
    ambient: [0, 1, 0.05],
    diffuse: [0, 1, 0.05],
    alpha: [0, 1, 0.05],
    depthBits: [8, 16, 1],
};
/* Sliders by factors of what fits, which is in the middle: to a hundredth and a hundred times */
const FITTED = new Set(['near', 'far']);
/* Sliders by powers, whose right end is "as many as it takes" */
const POWERS = { maxTriangles: [16, 8192], maxVertices: [16, 8192] };
const STEPS = 100;

/** Options that demo scenes have; the others are for models. */
export const OF_SCENES = new Set([
    'strip',
    'buffers',
    'maxTriangles',
    'maxVertices',
    'depthMapping',
    'depthBits',
    'method',
    'subpixel',
    'fast',
    'rotate',
    'width',
    'height',
]);

export const labelOf = (name) =>
    LABEL[name] || name.replace(/([A-Z])/g, (c) => ` ${c.toLowerCase()}`).replace(/^./, (c) => c.toUpperCase());

/** What an option is where nothing is set, as its help says at the end of a sentence: "... (16)". */
export function usualOf(option) {
    const words = [...option.text.matchAll(/\(([\w.-]+)[:)]/g)].map((m) => m[1]);
    if (option.kind === 'choice') return words.find((w) => option.choices.includes(w));
    if (option.kind === 'number') return words.map(Number).find(Number.isFinite);
    return undefined;
}

const many = (name, step) => {
    const [lo, hi] = POWERS[name];
    return step >= STEPS ? undefined : Math.round(lo * (hi / lo) ** (step / (STEPS - 1)));
};
const stepOf = (name, value) => {
    const [lo, hi] = POWERS[name];
    return value === undefined
        ? STEPS
        : Math.round(((STEPS - 1) * Math.log(Math.max(lo, value) / lo)) / Math.log(hi / lo));
};

export class Controls {
    /** change: called with a name and a value that a person chose; undefined: the usual. */
    constructor(change) {
        this.change = change;
        this.fields = new Map();
        this.fits = { near: 1, far: 1 };
    }

    /** Where the planes are that fit, of a model whose planes are not set. */
    planes(near, far) {
        for (const [name, at] of Object.entries({ near, far }))
            if (at > 0 && this.fields.get(name)?.option.value === undefined) this.fits[name] = at;
    }

    /** Make the fields of all options but those in `elsewhere`. */
    build(options, elsewhere) {
        const at = id('groups'),
            rest = options.filter((o) => !elsewhere.has(o.name));
        at.textContent = '';
        for (const [title, names] of GROUPS) {
            const these = names.map((n) => rest.find((o) => o.name === n)).filter(Boolean);
            if (these.length === 0) continue;
            at.append(make('fieldset', {}, make('legend', {}, title), ...these.map((o) => this.field(o))));
        }
        const others = rest.filter((o) => !GROUPS.some(([, names]) => names.includes(o.name)));
        if (others.length > 0)
            at.append(
                make(
                    'details',
                    { className: 'more' },
                    make('summary', {}, 'More settings'),
                    make('fieldset', {}, ...others.map((o) => this.field(o))),
                ),
            );
    }

    field(option) {
        const name = option.name,
            why = make('span', { className: 'why', id: `why-${name}`, role: 'status' });
        const shown = make('output', { id: `out-${name}` });
        const said = make('span', {}, labelOf(name), shown);
        const input = this.input(option);
        input.id = `set-${name}`;
        input.setAttribute('aria-describedby', why.id);
        const row = make(
            'label',
            { className: option.kind === 'flag' ? 'field check' : 'field', for: input.id, title: option.text },
            ...(option.kind === 'flag' ? [input, said] : [said, input]),
        );
        this.fields.set(name, { option, input, shown, why, row });
        this.show(option);
        return make('div', { className: 'setting' }, row, why);
    }

    input(option) {
        const { name, kind } = option,
            usual = usualOf(option);
        let input;
        if (kind === 'choice') {
            const own =
                usual === undefined ? [make('option', { value: '', textContent: 'as the model has it' })] : [];
            input = make(
                'select',
                {},
                ...own,
                ...option.choices.map((value) => make('option', { value, textContent: CHOICE[value] || value })),
            );
            input.addEventListener('change', () =>
                this.change(name, input.value === '' || input.value === usual ? undefined : input.value),
            );
        } else if (kind === 'flag') {
            input = make('input', { type: 'checkbox' });
            input.addEventListener('change', () => this.change(name, input.checked || undefined));
        } else if (POWERS[name]) {
            input = make('input', { type: 'range', min: 0, max: STEPS, step: 1 });
            input.addEventListener('input', () => this.change(name, many(name, Number(input.value))));
        } else if (FITTED.has(name)) {
            input = make('input', { type: 'range', min: 0, max: STEPS, step: 1 });
            input.addEventListener('input', () => {
                const by = 100 ** (Number(input.value) / (STEPS / 2) - 1);
                this.change(name, by === 1 ? undefined : Number((this.fits[name] * by).toPrecision(3)));
            });
        } else if (ENDS[name]) {
            const [min, max, step] = ENDS[name];
            input = make('input', { type: 'range', min, max, step });
            input.addEventListener('input', () => this.change(name, Number(input.value)));
        } else {
            input = make('input', { type: kind === 'number' ? 'number' : 'text' });
            if (kind === 'number') input.step = option.step || 'any';
            input.placeholder = usual ?? (EXAMPLE[name] ? `such as ${EXAMPLE[name]}` : '');
            const take = () =>
                this.change(
                    name,
                    input.value === '' ? undefined : kind === 'number' ? Number(input.value) : input.value,
                );
            input.addEventListener('change', take);
        }
        return input;
    }

    /** Put an option's value into its field. */
    show(option) {
        const field = this.fields.get(option.name);
        if (!field) return;
        field.option = option;
        const { input, shown } = field,
            value = option.value ?? usualOf(option);
        if (option.kind === 'flag') input.checked = !!option.value;
        else if (POWERS[option.name]) {
            input.value = stepOf(option.name, option.value);
            shown.textContent = option.value === undefined ? 'ample' : String(option.value);
        } else if (FITTED.has(option.name)) {
            const by = option.value === undefined ? 1 : option.value / this.fits[option.name];
            input.value = Math.round((STEPS / 2) * (1 + Math.log(by) / Math.log(100)));
            shown.textContent = option.value === undefined ? 'as it fits' : String(option.value);
        } else if (input.type === 'range') {
            input.value = value;
            shown.textContent = `${Number(input.value) === value ? value : value} ${UNIT[option.name] ?? ''}`.trim();
        } else if (document.activeElement !== input || input.tagName === 'SELECT') {
            input.value = option.kind === 'choice' ? (value ?? '') : (option.value ?? '');
        }
    }

    /** Which fields mean something: all for a model, OF_SCENES for a scene. */
    enable(model) {
        for (const [name, { input, row }] of this.fields) {
            input.disabled = !model && !OF_SCENES.has(name);
            row.classList.toggle('off', input.disabled);
        }
    }

    /** What the engine says of a value that it does not take; '' where all is well. */
    refuse(name, sentence) {
        for (const [n, { why, input }] of this.fields) {
            why.textContent = n === name ? sentence : '';
            input.setAttribute('aria-invalid', String(n === name && sentence !== ''));
        }
        return this.fields.has(name);
    }
}
