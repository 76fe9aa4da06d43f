// engine.wasm against what boards and zsim draw and say.
// Usage: node tests/web/engine.mjs ENGINE.WASM ZSIM WORKDIR    from the repository's top
//
// SPDX-License-Identifier: MIT
import {spawnSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';

import {createEngine} from '../../sim/web/engine.js';

import {readPng, writePng} from './png.mjs';

const [wasm, zsim, work] = process.argv.slice(2);
const engine = await createEngine(readFileSync(wasm));
let failed = 0;

function test(name, run) {
    const wrong = [];
    try {
        run((what, is, be) => {
            if (JSON.stringify(is) !== JSON.stringify(be))
                wrong.push(`${what}: ${JSON.stringify(is)}, not ${JSON.stringify(be)}`);
        });
    } catch (error) {
        wrong.push(String(error.stack).split('\n').slice(0, 3).join(' '));
    }
    console.log(wrong.length === 0 ? `ok ${name}` : `FAILED ${name}: ${wrong.slice(0, 3).join('; ').slice(0, 900)}`);
    failed |= wrong.length > 0;
}

/** Options that are set are these alone. */
function configure(options) {
    const none = Object.fromEntries(engine.options().map((one) => [one.name, undefined]));
    return engine.configure({...none, ...options});
}

function run(...words) {
    const {status, stdout, stderr} = spawnSync(zsim, words, {encoding: 'utf8'});
    return {status, stdout, stderr};
}

/** The same as fnv1a of firmware/app/checksums.c, of 16-bit values with their high bytes first. */
function sum(values) {
    let high = 0xcbf29ce4, low = 0x84222325;
    const add = (byte) => {
        const l = (low ^ byte) >>> 0, a = (l & 0xffff) * 0x1b3, b = (l >>> 16) * 0x1b3 + (a >>> 16);
        high = (Math.imul(high, 0x1b3) + (l << 8) + (b >>> 16)) >>> 0;
        low = (b << 16 | a & 0xffff) >>> 0;
    };
    for (const v of values) {
        add(v >>> 8);
        add(v & 255);
    }
    const hex = (n) => n.toString(16).padStart(8, '0');
    return hex(high) + hex(low);
}

// ---- Scenes: what every board draws, whatever strips and pools

const record =
    [ 'scenes', 'pieces' ].flatMap((name) => readFileSync(`tests/records/${name}.txt`, 'utf8').trim().split('\n'));
test('web_engine_scenes', (is) => {
    const ways = [
        {strip: 24}, {strip: 7, buffers: 1}, {strip: 16, maxTriangles: 400, maxVertices: 600},
        {strip: 240, fast: 'none'}
    ];
    const known = new Set(engine.scenes().map((one) => one.name));
    is('scenes on record', [...new Set(record.map((line) => line.split(' ')[0])) ].filter((name) => !known.has(name)),
        []);
    is('scenes not on record', [...known ].filter((name) => !record.some((line) => line.startsWith(name + ' '))), []);
    record.forEach((line, i) => {
        const [name, frame, bits, pixels, keys] = line.split(' ');
        const sorted =
            name === 'stilllife' || name === 'cockpit' || name === 'forest';  // what is sorted needs its pool
        const way = sorted ? {strip: 24} : ways[i % ways.length];
        is(`${name} with ${JSON.stringify(way)}`, [ configure(way), engine.setScene(name) ].map((one) => one.error),
            [ '', '' ]);
        is(`${name} bits`, engine.configure({subpixel: bits}).error, '');
        engine.setTime(Number(frame));
        const drawn = engine.render();
        is(`${name} ${frame} ${bits}`, [ drawn.error, sum(drawn.pixels), sum(drawn.depth) ], [ '', pixels, keys ]);
    });
});

// ---- Models: pixels and keys of zsim render

/** OBJ text and what setModel takes for it: a ring of quads with normals, texture coordinates and two materials. */
function ring(across, around, {normals, uvs, materials}) {
    const lines = [], corner = [], model = {positions: [], indices: [], normals: [], uvs: [], triMaterial: []};
    for (let i = 0; i < across; i++)
        for (let j = 0; j < around; j++) {
            const a = 2 * Math.PI * i / across, b = 2 * Math.PI * j / around,
                  r = 1 + 0.4 * Math.cos(b) + 0.05 * Math.sin(5 * a + 3 * b);
            const round = (v) => v.map((x) => Number(x.toFixed(7)));
            const one = {
                v: round([ r * Math.cos(a), 0.4 * Math.sin(b), r * Math.sin(a) ]),
                vt: round([ 3 * i / across, j / around ]),
                vn: round([ Math.cos(b) * Math.cos(a), Math.sin(b), Math.cos(b) * Math.sin(a) ])
            };
            corner.push(one);
            for (const kind of ['v', ...(uvs ? [ 'vt' ] : []), ...(normals ? [ 'vn' ] : [])])
                lines.push(`${kind} ${one[kind].join(' ')}`);
        }
    if (materials) lines.unshift('mtllib ring.mtl');
    for (let i = 0; i < across; i++) {
        if (materials && i % (across / 2) === 0) lines.push(`usemtl ${i === 0 ? 'red' : 'picture'}`);
        for (let j = 0; j < around; j++) {
            const at = (p, q) => p % across * around + q % around,
                  face = [ at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j) ];
            lines.push('f ' +
                face.map((n) => `${n + 1}${uvs || normals ? '/' : ''}${uvs ? n + 1 : ''}${normals ? `/${n + 1}` : ''}`)
                    .join(' '));
            for (const n of [face[0], face[1], face[2], face[0], face[2], face[3]]) model.indices.push(n);
            model.triMaterial.push(i < across / 2 ? 0 : 1, i < across / 2 ? 0 : 1);
        }
    }
    for (const one of corner) {
        model.positions.push(...one.v);
        model.normals.push(...one.vn);
        model.uvs.push(...one.vt);
    }
    return {
        text: lines.join('\n') + '\n',
        model: {
            name: 'ring.obj',
            positions: Float64Array.from(model.positions),
            indices: Uint32Array.from(model.indices),
            normals: normals ? Float32Array.from(model.normals) : undefined,
            uvs: uvs ? Float64Array.from(model.uvs) : undefined,
            triMaterial: materials ? Uint32Array.from(model.triMaterial) : undefined,
            ...(materials ?? {})
        },
    };
}

const side = 24, rgb = Uint8Array.from({length: 3 * side * side}, (_, i) => (i * 37 ^ i >> 5) & 255);
const rgba = Uint8Array.from({length: 4 * side * side}, (_, i) => (i % 4 === 3 ? 255 : rgb[3 * (i >> 2) + i % 4]));
writeFileSync(`${work}/picture.png`, writePng(side, side, rgb));
writeFileSync(`${work}/ring.mtl`,
    'newmtl red\nKd 0.9 0.2 0.1\nKs 0.5 0.5 0.5\nNs 20\nnewmtl picture\nKd 0.8 1 0.7\nmap_Kd picture.png\n');
const looks = {
    materials: [
        {name: 'red', color: [ 0.9, 0.2, 0.1 ], specular: [ 0.5, 0.5, 0.5 ], power: 20},
        {name: 'picture', color: [ 0.8, 1, 0.7 ], texture: 0, textureFactor: [ 0.8, 1, 0.7 ]}
    ],
    textures: [ {name: 'picture.png', width: side, height: side, rgba} ],
};

const picture = () => {
    const {width, height} = engine.pictureSize(), out = new Uint8Array(4 * width * height);
    engine.rgba(out);
    return {width, height, rgb: out.filter((_, i) => i % 4 !== 3)};
};
const differ = (a, b) => (a.length !== b.length ? -1 : a.reduce((n, v, i) => n + (v !== b[i]), 0));

const NAMES = {
    size: null,
    tris: 'maxTriangles',
    verts: 'maxVertices',
    depth: 'depthMapping',
    show: 'falseColors'
};
function asOptions(words) {
    const out = {};
    for (const word of words) {
        const [name, value] = word.slice(2).split('=');
        if (name === 'size')
            [out.width, out.height] = value.split('x').map(Number);
        else
            out[NAMES[name] ?? name.replace(/-(.)/g, (_, c) => c.toUpperCase())] = value ?? true;
    }
    return out;
}

const models = [
    [
        'plain', {},
        [
            [], [ '--shade=smooth', '--samples=4' ], [ '--method=painter' ], [ '--tris=50', '--strip=5' ],
            [ '--style=hidden-line' ], [ '--show=overdraw' ], [ '--simplify=200' ], [ '--panel=ssd1306:128x64' ],
            [ '--panel=gc9a01:240x240' ], [ '--panel=ssd1351:128x96', '--invert', '--bgr' ],
            [ '--panel=ili9341:240x320', '--rotate=90' ]
        ]
    ],
    [
        'normals', {normals: true},
        [
            [], [ '--shade=flat', '--depth=linear', '--size=100x80' ], [ '--eye=0.1,0.5,1.2', '--near=0.3' ],
            [ '--mesh=file', '--subpixel=4', '--depth-bits=8' ], [ '--projection=orthographic' ],
            [ '--fog=linear:1:4:203040' ]
        ]
    ],
    [
        'textured', {normals: true, uvs: true, materials: looks},
        [
            [], [ '--texture-format=pal4' ], [ '--shade=unlit', '--wrap=clamp' ],
            [ '--filter=bilinear', '--shade=textured' ], [ '--color=4080c0' ]
        ]
    ],
];
for (const [name, what, cases] of models)
    test(`web_engine_model_${name}`, (is) => {
        const {text, model} = ring(48, 20, what);
        writeFileSync(`${work}/ring.obj`, text);
        configure({});
        is('setModel', engine.setModel(model).error, '');
        for (const words of cases) {
            const made = run('render', `${work}/ring.obj`, '--out', `${work}/ring.png`, ...words);
            const said = configure(asOptions(words)).error, drawn = engine.render();
            is(`${words}: refusals`, [ made.status, said, drawn.error ], [ 0, '', '' ]);
            const want = readPng(readFileSync(`${work}/ring.png`)), got = picture();
            is(`${words}: size`, [ got.width, got.height ], [ want.width, want.height ]);
            is(`${words}: pixels that differ`, differ(got.rgb, want.rgb), 0);
            is(`${words}: something is drawn`, new Set(drawn.pixels).size > 1, true);
        }
        const made = run('render', `${work}/ring.obj`, '--out', `${work}/ring.png`, '--depth-out', `${work}/ring.pgm`,
            '--stats', `${work}/ring.json`);
        configure({});
        const drawn = engine.render(), pgm = readFileSync(`${work}/ring.pgm`),
              keys = pgm.subarray(pgm.length - 2 * 240 * 240);
        is('depth-out', made.status, 0);
        is('keys that differ',
            differ([...drawn.depth ], Array.from({length: 240 * 240}, (_, i) => keys.readUInt16BE(2 * i))), 0);
        const stats = JSON.parse(readFileSync(`${work}/ring.json`, 'utf8'));
        for (const key of ['triangles_drawn', 'pixels_tested', 'passes', 'arena_bytes', 'rejected_facing'])
            is(key, drawn.stats[key], stats[key]);
    });

test('web_engine_single', (is) => {
    const {model} = ring(48, 20, {}),
          far = Float32Array.from(model.positions,
              (v, i) => Math.round(200 * v) / 10 + (i % 3 === 0 ? 300 : 0));  // tenths, which single precision has not
    const rows = (n, of) => Array.from({length: n}, (_, i) => of(i)).join('\n');
    writeFileSync(`${work}/ring.ply`,
        `ply\nformat ascii 1.0\nelement vertex ${far.length / 3}\nproperty float x\nproperty float y\n` +
            `property float z\nelement face ${
                model.indices.length / 3}\nproperty list uchar int vertex_indices\nend_header\n` +
            rows(far.length / 3, (i) => far.slice(3 * i, 3 * i + 3).join(' ')) + '\n' +
            rows(model.indices.length / 3, (i) => `3 ${model.indices.slice(3 * i, 3 * i + 3).join(' ')}`) + '\n');
    configure({});
    is('setModel', engine.setModel({...model, name: 'ring.ply', positions: far}).error, '');
    for (const words of [[], [ '--precise', '--shade=smooth' ], [ '--mesh=file' ]]) {
        const made = run('render', `${work}/ring.ply`, '--out', `${work}/ring.png`, ...words);
        is(`${words}: refusals`, [ made.status, configure(asOptions(words)).error ], [ 0, '' ]);
        engine.render();
        is(`${words}: pixels that differ`, differ(picture().rgb, readPng(readFileSync(`${work}/ring.png`)).rgb), 0);
    }
});

// ---- Sentences

const ending = (stderr) => stderr.trim()
                               .split('\n')
                               .at(-1)
                               .replace(/^zsim: /, '')
                               .replace(/; see zsim render --help$/, '')
                               .replace(/^.*ring\.obj: /, '');
test('web_engine_refusals', (is) => {
    const {text, model} = ring(12, 8, {});
    writeFileSync(`${work}/ring.obj`, text);
    configure({});
    engine.setModel(model);
    const before = sum(engine.render().pixels);
    for (const words of [[ '--strip=0' ], [ '--depth-bits=99' ], [ '--depth=deep' ], [ '--near=5', '--far=2' ],
             [ '--shade=textured' ], [ '--method=painter', '--depth=linear' ],
             [ '--projection=orthographic', '--depth=recip' ], [ '--panel=none:1x1' ], [ '--eye=0,0,0', '--at=0,0,0' ],
             [ '--filter=bilinear' ], [ '--simplify=many' ]]) {
        const made = run('render', `${work}/ring.obj`, '--out', `${work}/none.png`, ...words),
              answer = configure(asOptions(words));
        is(`${words}: refused`, [ answer.ok, made.status > 0 ], [ false, true ]);
        is(`${words}`, answer.error.replace(/^(ring\.obj|model): /, ''), ending(made.stderr));
        is(`${words}: no option changes`, engine.options().filter((one) => one.value !== undefined), []);
        is(`${words}: nothing changes`, sum(engine.render().pixels), before);
    }
    is('no model',
        engine.setModel({name: 'none.obj', positions: new Float64Array(9), indices: new Uint32Array(0)}).error,
        'none.obj: no faces in it; zsim draws polygons');
    is('an index', engine.setModel({...model, indices: Uint32Array.from([ 0, 1, 999 ])}).error,
        'ring.obj: vertex index 999 of face 1 is out of range: 96 exist');
    is('a number', engine.setModel({...model, positions: model.positions.map((v, i) => (i === 4 ? NaN : v))}).ok,
        false);
    is('what was there stays', sum(engine.render().pixels), before);
    is('no scene', engine.setScene('nowhere').error, "there is no scene 'nowhere'");
});

test('web_engine_explain', (is) => {
    const {text, model} = ring(12, 8, {});
    writeFileSync(`${work}/ring.obj`, text);
    configure({});
    engine.setModel(model);
    is('nothing is wrong', engine.explain(), []);
    for (const words of [[ '--near=100' ], [ '--cull=front', '--eye=0,9,0', '--up=0,0,1', '--at=0,0,0' ],
             [ '--eye=0,0,9', '--at=0,0,20' ]]) {
        const made = run('render', `${work}/ring.obj`, '--out', `${work}/ring.png`, '--explain', ...words);
        is(`${words}: drawn`, configure(asOptions(words)).error, '');
        const want = made.stderr.trim()
                         .split('\n')
                         .filter((line) => line !== '')
                         .map((line) => line.replace(/^.*ring\.obj: /, ''));
        is(`${words}`, engine.explain(), want);
    }
});

// ---- Figures and files

test('web_engine_budget', (is) => {
    configure({panel: 'st7789:240x240', strip: 24});
    engine.setScene('teapot');
    const part = engine.parts().find((one) => one.name === 'stm32f405');
    const figures = (...words) => Object.fromEntries(
        run('budget', ...words, '--csv').stdout.trim().split('\n').map((line) => line.split(',').slice(0, 2)));
    const figure = figures('--scene', 'teapot', '--panel', 'st7789:240x240', '--strip', '24', '--part', 'stm32f405');
    is('RAM', part.ramUsed, Number(figure.ram));
    is('flash', part.flashUsed, Number(figure.flash));
    is('frames a second', part.fps.toFixed(1), figure.fps);
    is('drawing', part.drawMs.toFixed(3), figure.draw_ms);
    is('pools', engine.ram().pools.reduce((n, one) => n + one.bytes, 0), Number(figure.ram));
    is('parts', engine.parts().length > 10, true);
    is('the small one is too small', engine.parts().find((one) => one.name === 'nrf51822').ramFits, false);
    engine.configure({method: 'painter', width: 200, height: 100, panel: undefined});
    is('another method', engine.parts()[0].fps > 0, true);
    engine.configure({fast: 'none'});
    const bare = engine.parts()[0];
    is('no accelerators: no time, no flash', [ bare.fps, bare.drawMs, bare.flashUsed, bare.why ],
        [ null, null, null, 'Time and flash are known only of all accelerators together.' ]);
    engine.configure({fast: undefined});
    engine.configure({method: undefined, width: undefined, height: undefined});
    for (const scene of [ 'stilllife', 'cockpit', 'forest' ]) { // as zsim budget has them
        configure({panel: 'st7789:240x240', strip: 24});
        engine.setScene(scene);
        const one = engine.parts().find((part) => part.name === 'rp2040');
        const said = figures('--scene', scene, '--panel', 'st7789:240x240', '--strip', '24', '--part', 'rp2040');
        is(`${scene}: drawing`, one.drawMs.toFixed(3), said.draw_ms);
        is(`${scene}: RAM`, [ one.ramUsed, engine.ram().total > 10000 ], [ Number(said.ram), true ]);
    }
});

// Each option of an effect has a time of its own, and the error of effects.
test('web_engine_effects', (is) => {
    const {model} = ring(24, 12, {normals: true});
    const pico = () => engine.parts().find((one) => one.name === 'rp2040');
    configure({panel: 'st7789:240x240', strip: 24, shade: 'smooth'});
    engine.setModel(model);
    const plain = pico();
    const dear = {fog: 'linear:1:4:808080', light: 'point:2,2,2', specular: '20:0.5', perPixel: true, shadow: 'map',
        samples: 4, alpha: 0.5, dither: 'ordered'};
    for (const [option, value] of Object.entries(dear)) {
        is(`${option}: taken`, engine.configure({[option]: value}).error, '');
        const part = pico();
        is(`${option}: dearer, by a known time`, part.drawMs > plain.drawMs, true);
        is(`${option}: its error`, part.fpsError > plain.fpsError || option === 'specular' || option === 'alpha', true);
        engine.configure({[option]: undefined});
    }
    is('without again', pico().drawMs, plain.drawMs);
    engine.configure({mirror: true});
    is('a mirror: dearer, by a known time', pico().drawMs > plain.drawMs, true);
    engine.configure({mirror: undefined});
    for (const both of [ {alpha: 0.5, specular: '20:0.5'}, {shadow: 'map', specular: '20:0.5'} ]) {
        is('two: taken', engine.configure(both).error, '');
        is('two: dearer than each, by a known time', pico().drawMs > Math.max(...Object.entries(both).map(
            ([ option, value ]) => {
                engine.configure({alpha: undefined, specular: undefined, shadow: undefined});
                engine.configure({[option]: value});
                const {drawMs} = pico();
                engine.configure(both);
                return drawMs;
            })), true);
        engine.configure({alpha: undefined, specular: undefined, shadow: undefined});
    }
});

test('web_engine_files', (is) => {
    const {text, model} = ring(12, 8, {normals: true});
    writeFileSync(`${work}/ring.obj`, text);
    configure({shade: 'smooth', color: '4080c0'});
    engine.setModel(
        {...model, materials: [ {name: 'DefaultMaterial'} ]});  // the name that the loader of zsim makes up
    const made =
        run('convert', `${work}/ring.obj`, '--name', 'thing', '--out', work, '--color=4080c0', '--shade=smooth');
    const files = engine.files('thing');
    is('status', made.status, 0);
    const body = (source) => source.replace(/^.*Made by:.*$/m, '');
    for (const end of ['thing.c', 'thing.h'])
        is(end, body(files[end]) === body(readFileSync(`${work}/${end}`, 'utf8')), true);
});

// The configuration is C that compiles, for an arena of the bytes that are shown.
test('web_engine_config', (is) => {
    engine.setModel(ring(12, 8, {normals: true}).model);
    for (const options of [ {shade: 'smooth'}, {method: 'hiz', strip: 8, depthMapping: 'linear'},
            {method: 'painter', subpixel: 4, buffers: 1}, {depthBits: 12, maxTriangles: 50, depthMapping: 'recip'} ]) {
        configure({panel: 'st7789:240x240', ...options});
        engine.render();
        const bytes = engine.ram().pools.filter((one) => /strip|keys|tiles|bins|triangles|vert/.test(one.name))
                          .reduce((n, one) => n + one.bytes, 0);
        const check = options.method === 'painter' ? '' : `_Static_assert(sizeof screen_arena == ${bytes}, "");`;
        writeFileSync(`${work}/screen.c`, `${engine.config()}int main(void) { return screen_begin(); }\n${check}\n`);
        const made = spawnSync('gcc', [ '-std=c11', '-fsyntax-only', '-Wall', '-Wextra', '-Werror', '-Ifirmware/zstrip',
            `${work}/screen.c` ], {encoding: 'utf8'});
        is(JSON.stringify(options), made.stderr.split('\n')[0], '');
    }
    is('the method', /&zs_method_hiz;/.test((configure({method: 'hiz'}), engine.render(), engine.config())), true);
    configure({samples: 4});
    let said = '';
    try {
        engine.config();
    } catch (error) {
        said = error.message;
    }
    is('four samples', /see zs_supersample.h/.test(said), true);
});

test('web_engine_wrong', (is) => {
    const {text, model} = ring(48, 20, {});
    writeFileSync(`${work}/ring.obj`, text);
    configure({});
    engine.setModel(model);
    is('compare',
        run('render', `${work}/ring.obj`, '--out', `${work}/ring.png`, '--compare', '--stats', `${work}/ring.json`)
            .status,
        0);
    const stats = JSON.parse(readFileSync(`${work}/ring.json`, 'utf8'));
    is('drawn', configure({falseColors: 'wrong'}).error, '');
    const own = engine.render().stats;
    is('missing and extra', [ own.wrong_missing, own.wrong_extra ], [ stats.compare_missing, stats.compare_extra ]);
    engine.setScene('corridor');
    const right = engine.render().stats;
    is('the depth buffer is right', right.wrong_color + right.wrong_missing + right.wrong_extra < 30, true);
    is('the painter', configure({method: 'painter', falseColors: 'wrong'}).error, '');
    is('is not', engine.render().stats.wrong_color > 1000, true);
    const {rgb} = picture();
    const marks = rgb.filter((v, i) => i % 3 === 0 && v === 255 && rgb[i + 1] === 64 && rgb[i + 2] === 255).length;
    is('as many are marked', marks, engine.render().stats.wrong_color);
    configure({falseColors: 'wrong'});
    is('a scene', engine.setScene('knot').error, '');
    is('nearly none', engine.render().stats.wrong_missing < 20, true);
    is('effects', engine.setScene('cockpit').error, 'cockpit: effects have no reference; choose a scene without');
});

// ---- Orbit and speed

// A panel has the size of its picture, whichever way it is turned; false colours of that size have its wire.
test('web_engine_panel_size', (is) => {
    configure({});
    engine.setScene('teapot');
    const size = () => {
        const {error, width, height} = engine.render();
        return error || `${width}x${height}`;
    };
    const wire = () => engine.parts().find((one) => one.name === 'rp2040').wireMs;
    is('upright', [ configure({panel: 'st7789:240x320'}).error, size() ], [ '', '240x320' ]);
    is('turned', [ engine.configure({rotate: '90'}).error, size() ], [ '', '320x240' ]);
    const ms = wire();
    is('false colours', [ configure({width: 320, height: 240, falseColors: 'overdraw'}).error, size(), wire() ],
        [ '', '320x240', ms ]);
    is('a show', [ configure({panel: 'st7789:240x240', rotate: '180'}).error,
                     engine.flash({frames: 8, arena: 100000, flash: 1000000}).error ],
        [ '', 'teapot: the prebuilt show does not turn its panel; leave --rotate 0' ]);
});

test('web_engine_orbit', (is) => {
    const {model} = ring(12, 8, {});
    configure({});
    engine.setModel(model);
    const home = sum(engine.render().pixels);
    const {text} = ring(12, 8, {});
    writeFileSync(`${work}/ring.obj`, text);
    is('stats', run('render', `${work}/ring.obj`, '--out', `${work}/ring.png`, '--stats', `${work}/ring.json`).status,
        0);
    const view = JSON.parse(readFileSync(`${work}/ring.json`, 'utf8')), axes = [ 'x', 'y', 'z' ];
    const eye = axes.map((k) => view[`eye_${k}`]), at = axes.map((k) => view[`at_${k}`]);
    const [x, y, z] = eye.map((v, k) => 1.5 * (v - at[k])), [ c, s ] = [ Math.cos(0.7), Math.sin(0.7) ];
    engine.orbit(0.7, 0, 1.5);
    const orbited = Array.from(engine.render().pixels);
    engine.orbit(0, 0, 1);
    configure({eye: [ at[0] + c * x + s * z, at[1] + y, at[2] - s * x + c * z ], at});
    const placed = Array.from(engine.render().pixels);
    is('about the upright', differ(orbited, placed) < 60, true);
    is('it is another view', sum(orbited) !== home, true);
    configure({});
    is('back', sum(engine.render().pixels), home);
    engine.orbit(0, 9, 1);
    is('over the top', engine.render().error, '');
    engine.orbit(30 * Math.PI / 180, 10 * Math.PI / 180, 0.8);
    for (const scene of [ 'teapot', 'stilllife' ]) { // with effects, whose mirror sees from elsewhere, too
        engine.setScene(scene);
        engine.render();
        const words = [ '--scene', scene, '--frames', '1', '--out', `${work}/orbit` ];
        is(`${scene}: drawn`, run('demo', ...words, '--orbit', '30,10,0.8').status, 0);
        const want = readPng(readFileSync(`${work}/orbit/${scene}_000.png`)).rgb;
        is(`${scene}: pixels that differ`, differ(picture().rgb, want), 0);
    }
    engine.orbit(0, 0, 1);
});

test('web_engine_speed', (is) => {
    configure({width: 240, height: 240});
    engine.setScene('teapot');
    let least = Infinity;
    for (let i = 0; i < 96; i++) {
        const begun = performance.now();
        engine.setTime(i);
        engine.render();
        least = Math.min(least, performance.now() - begun);
    }
    console.log(`  teapot at 240x240: ${least.toFixed(2)} ms a frame at best`);
    is('60 frames a second', least < 1000 / 60, true);
});
process.exit(failed);
