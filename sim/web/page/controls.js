/* Controls, made from the engine's own table of options: what it adds is there without a change here.
 *
 * SPDX-License-Identifier: MIT
 */
import { id, make } from './dom.js';

const GROUPS = [
    ['Memory', ['strip', 'buffers', 'maxTriangles', 'maxVertices', 'tris', 'verts', 'fast', 'threads']],
    ['Depth', ['depthMapping', 'depth', 'depthBits', 'near', 'far']],
    ['Picture', ['shade', 'method', 'samples', 'textureFormat', 'subpixel', 'projection', 'fov', 'cull', 'style',
        'background', 'color']],
];
const LABEL = {
    strip: 'Strip height', buffers: 'Strip buffers', maxTriangles: 'Triangles in memory', maxVertices: 'Vertices in memory',
    tris: 'Triangles in memory', verts: 'Vertices in memory', depthMapping: 'Depth mapping', depth: 'Depth mapping',
    depthBits: 'Bits of a depth key', near: 'Near plane', far: 'Far plane', shade: 'Shading', method: 'Method',
    samples: 'Samples a pixel', textureFormat: 'Texels', subpixel: 'Sub-pixel bits', fast: 'Accelerators',
    fov: 'Field of view', cull: 'Sides not drawn', width: 'Width', height: 'Height', spi: 'Clock of the wire',
};
const UNIT = { strip: 'rows', near: '', far: '', fov: '°', width: 'px', height: 'px' };

export const labelOf = (name) => LABEL[name] ||
    name.replace(/([A-Z])/g, (c) => ` ${c.toLowerCase()}`).replace(/^./, (c) => c.toUpperCase());

export class Controls {
    /** change: called with a name and a value that a person chose. */
    constructor(change) {
        this.change = change;
        this.fields = new Map();
    }

    /** Make the fields of all options but those in `elsewhere`. */
    build(options, elsewhere) {
        const at = id('groups'), rest = options.filter((o) => !elsewhere.has(o.name));
        at.textContent = '';
        for (const [title, names] of GROUPS) {
            const these = names.map((n) => rest.find((o) => o.name === n)).filter(Boolean);
            if (these.length === 0) continue;
            at.append(make('fieldset', {}, make('legend', {}, title), ...these.map((o) => this.field(o))));
        }
        const others = rest.filter((o) => !GROUPS.some(([, names]) => names.includes(o.name)));
        if (others.length > 0)
            at.append(make('fieldset', {}, make('legend', {}, 'More'), ...others.map((o) => this.field(o))));
    }

    field(option) {
        const name = option.name, why = make('span', { className: 'why', id: `why-${name}` });
        why.setAttribute('role', 'status');
        const shown = make('output', { id: `out-${name}` });
        const said = make('span', {}, labelOf(name), shown);
        const input = this.input(option);
        input.id = `set-${name}`;
        input.setAttribute('aria-describedby', why.id);
        if (option.text) input.title = option.text;
        const field = make('label', { className: option.kind === 'flag' ? 'field check' : 'field', for: input.id },
            ...(option.kind === 'flag' ? [input, said] : [said, input]), why);
        this.fields.set(name, { option, input, shown, why });
        this.show(option);
        return field;
    }

    input(option) {
        const { name, kind } = option;
        let input;
        if (kind === 'choice') {
            input = make('select', {}, ...option.choices.map((c) => {
                const value = typeof c === 'object' ? c.value : c;
                return make('option', { value, textContent: typeof c === 'object' ? c.text : String(c) });
            }));
            input.addEventListener('change', () => this.change(name, this.valueOf(option, input)));
        } else if (kind === 'flag') {
            input = make('input', { type: 'checkbox' });
            input.addEventListener('change', () => this.change(name, input.checked));
        } else {
            const span = option.max - option.min;
            const range = kind === 'number' && Number.isFinite(span) && span <= 4096 && span > 0;
            input = make('input', { type: kind === 'number' ? (range ? 'range' : 'number') : 'text' });
            if (option.min !== undefined && Number.isFinite(option.min)) input.min = option.min;
            if (option.max !== undefined && Number.isFinite(option.max)) input.max = option.max;
            input.step = option.step || 'any';
            input.addEventListener(range ? 'input' : 'change', () => this.change(name, this.valueOf(option, input)));
        }
        return input;
    }

    valueOf(option, input) {
        if (option.kind === 'number') return input.value === '' ? null : Number(input.value);
        const first = option.choices && option.choices[0];
        return typeof first === 'number' ? Number(input.value) : input.value;
    }

    /** Put an option's value into its field. */
    show(option) {
        const field = this.fields.get(option.name);
        if (!field) return;
        field.option = option;
        if (option.kind === 'flag') field.input.checked = !!option.value;
        else if (document.activeElement !== field.input || field.input.type !== 'number') field.input.value = option.value ?? '';
        if (field.input.type === 'range') field.shown.textContent = `${option.value} ${UNIT[option.name] ?? ''}`.trim();
    }

    /** What the engine says of a value that it does not take; '' where all is well. */
    refuse(name, sentence) {
        for (const [n, field] of this.fields) {
            field.why.textContent = n === name ? sentence : '';
            field.input.setAttribute('aria-invalid', n === name && sentence !== '' ? 'true' : 'false');
        }
        return this.fields.has(name);
    }
}
