/* The page: settings in, a frame and its figures out.
 *
 * SPDX-License-Identifier: MIT
 */
import { createEngine } from '../engine.js';
import { Controls } from './controls.js';
import { id, later, make } from './dom.js';
import { showPart, showParts, showStats } from './figures.js';
import { buildCards } from './learn.js';
import { readLink, writeLink } from './link.js';
import { readModel } from './models.js';
import { PANELS } from './panels.js';
import { Firmware } from './pico.js';
import { HOME, Stage } from './stage.js';
import { Tradeoff } from './tradeoff.js';
import { packed } from './wasm.js';

/* Options that have a place of their own on the page, or are none for a page */
const PLACED = new Set([
    'width',
    'height',
    'falseColors',
    'panel',
    'turntable',
    'explain',
    'reference',
    'compare',
    'precise',
    'mesh',
    'threads',
    'eye',
    'at',
    'up',
    'invert',
    'bgr',
    'wrap',
    'loadMemory',
    'loadSeconds',
    'allowOutside',
    'color',
    'light',
    'help',
    'simplify',
    'wrongPixels',
]);
const VIEWS = {
    frame: 'Picture',
    overdraw: 'Overdraw',
    depth: 'Depth',
    wrong: 'Wrong pixels',
    complexity: 'Layers',
    tested: 'Compared',
    strips: 'Set-ups',
};
const RADIANS = Math.PI / 180;

const app = {
    engine: null,
    controls: null,
    stage: null,
    options: new Map(),
    scene: '',
    model: null,
    part: '',
    panel: PANELS[0],
    rotate: undefined /* of the panel, as the option has it */,
    shown: 'frame',
    scale: 0,
    time: 0,
    turning: false,
    moving: false,
    dirty: false,
    lastFrame: null,
    parts: [],
};

/* ---- What is said ---- */

function say(sentence) {
    id('error').textContent = sentence;
    id('error').hidden = sentence === '';
}

let toastTimer = 0;
function toast(text) {
    id('toast').textContent = text;
    id('toast').classList.add('on');
    clearTimeout(toastTimer);
    toastTimer = setTimeout(() => id('toast').classList.remove('on'), 2200);
}

/* ---- Frames ---- */

function want() {
    if (app.dirty) return;
    app.dirty = true;
    requestAnimationFrame(frame);
}

function frame(now) {
    app.dirty = false;
    if (!draw()) return;
    if (!app.turning) {
        settle();
        return;
    }
    const scene = app.engineScenes.find((s) => s.name === app.scene);
    if (app.scene && scene && scene.moving) app.time++;
    else app.stage.view.yaw = (app.stage.view.yaw + 0.02 * Math.min(100, now - (app.turned || now))) % 360;
    app.turned = now;
    settleSometimes(now);
    want();
}

/* Set the engine's camera. */
function orbit(v = app.stage.view) {
    app.engine.orbit((v.yaw - HOME.yaw) * RADIANS, (v.pitch - HOME.pitch) * RADIANS, v.distance);
}

/* Draw a frame; 1: there is a new picture. */
function draw() {
    const { engine } = app,
        begun = performance.now();
    orbit();
    engine.setTime(app.time);
    const got = engine.render();
    const took = performance.now() - begun;
    if (!got.ok) {
        say(got.error);
        return false;
    }
    if (app.modelError === undefined) say('');
    app.lastFrame = got;
    app.controls.planes(got.stats.view_near, got.stats.view_far);
    paint();
    tempo(took);
    return true;
}

/* The last frame, or its false colours, onto the glass. */
function paint() {
    const { engine, stage } = app,
        size = engine.pictureSize();
    stage.resize(size.width, size.height);
    engine.rgba(stage.image.data);
    stage.show();
    if (document.documentElement.dataset.firstPicture === undefined)
        document.documentElement.dataset.firstPicture = performance.now().toFixed(0);
}

let mean = 0,
    told = 0;
function tempo(ms) {
    mean = mean ? mean + 0.1 * (ms - mean) : ms;
    if (performance.now() - told < 250) return;
    told = performance.now();
    id('tempo').textContent = `${mean.toFixed(1)} ms a frame here`;
    document.documentElement.dataset.frameMs = mean.toFixed(2);
}

/* ---- Figures, which take longer than a frame: once things are still, or twice a second ---- */

const call = (name, other) => (app.engine[name] ? app.engine[name]() : other);

function figures() {
    const got = app.lastFrame;
    if (!got) return;
    const parts = call('parts', []),
        ram = call('ram', []);
    app.parts = parts;
    const pools = Array.isArray(ram) ? ram : ram.pools;
    const total = Array.isArray(ram) ? ram.reduce((s, p) => s + p.bytes, 0) : ram.total;
    if (parts.length > 0) {
        if (!parts.some((p) => p.name === app.part)) app.part = parts[0].name;
        fillParts(parts);
        showPart(
            parts.find((p) => p.name === app.part),
            { pools: pools.filter((p) => p.bytes > 0), total },
        );
        showParts(parts, app.part, choosePart);
    }
    showStats(got.stats, got.passes);
    caption(got.stats);
    id('sentences').replaceChildren(...call('explain', []).map((s) => make('li', {}, s)));
    command();
    keepLink();
    if (app.tradeoff && !app.turning && app.shown === 'frame') app.tradeoff.follow();
    document.documentElement.dataset.settled = String(Number(document.documentElement.dataset.settled || 0) + 1);
}
/* What false colours mean that have no legend of their own. */
function caption(s) {
    const at = id('caption');
    at.hidden = app.shown !== 'wrong';
    const n = (name) => (s[name] || 0).toLocaleString('en-US');
    at.textContent =
        `Against a renderer in double precision: ${n('wrong_missing')} pixels are missing (red), ${n('wrong_extra')} ` +
        `too many (yellow), ${n('wrong_color')} of another colour (magenta), ` +
        `${n('wrong_one_step')} one step off (blue).`;
}
const settle = later(140, figures);
let settledAt = 0;
function settleSometimes(now) {
    if (now - settledAt < 600) return;
    settledAt = now;
    figures();
}

function fillParts(parts) {
    const select = id('part');
    if (select.options.length !== parts.length)
        select.replaceChildren(
            ...parts.map((p) =>
                make('option', { value: p.name, textContent: p.text ? `${p.name}: ${p.text}` : p.name }),
            ),
        );
    select.value = app.part;
}

function choosePart(name) {
    app.part = name;
    figures();
}

/* ---- Settings ---- */

/* Hand a change to the engine. What it refuses is said beside the control, and changes nothing. */
function configure(changes, by) {
    const answer = app.engine.configure(changes);
    if (!answer.ok) {
        if (!by || !app.controls.refuse(by, answer.error)) say(answer.error);
        return false;
    }
    app.controls.refuse('', '');
    app.firmware?.stop();
    say('');
    app.modelError = undefined;
    for (const option of app.engine.options()) {
        const o = option.name === 'rotate' ? { ...option, value: app.rotate } : option;
        app.options.set(o.name, o);
        app.controls.show(o);
    }
    app.stage.rule(rows());
    want();
    return true;
}

const rows = () => app.options.get('strip').value ?? 16;

/* What a view of a panel asks of the engine. False colours do not go through a panel's driver: they are drawn at the
 * size of its picture. */
function asked(view, panel = app.panel, rotate = app.rotate) {
    if (view === 'frame' && panel.name)
        return { panel: panel.name, rotate, width: undefined, height: undefined, falseColors: undefined };
    const { width, height } = pictureOf(panel, rotate),
        falseColors = view === 'frame' ? undefined : view;
    return { panel: undefined, rotate: undefined, width, height, falseColors };
}

/* The size of the picture on a panel that is rotated. */
function pictureOf({ width, height }, rotate) {
    return rotate === '90' || rotate === '270' ? { width: height, height: width } : { width, height };
}

function choosePanel(name) {
    const chosen = PANELS.find((p) => p.name === name);
    const panel = chosen.name ? chosen : { ...chosen, ...pictureOf(app.panel, app.rotate) };
    const before = app.rotate;
    if (!panel.name) app.rotate = undefined;
    if (!configure(asked('frame', panel), 'panel')) {
        app.rotate = before;
        id('panel').value = app.panel.name;
        return false;
    }
    app.panel = panel;
    showPanel();
    return true;
}

function rotate(value) {
    const before = app.rotate;
    app.rotate = value;
    if (!configure({ ...asked(app.shown), ...(app.panel.name ? {} : { rotate: value }) }, 'rotate'))
        app.rotate = before;
}

function showPanel() {
    const p = app.panel;
    id('panel').value = p.name;
    id('board').classList.toggle('round', !!p.round && app.shown === 'frame');
    id('silk-name').textContent = p.title === 'Any' ? 'zstrip' : p.title;
    id('silk-size').textContent = `${p.width} × ${p.height}`;
    id('size-fields').hidden = p.name !== '';
    chooseView('frame');
}

function chooseView(name) {
    if (!configure(asked(name))) return;
    app.shown = name;
    id('board').classList.toggle('round', !!app.panel.round && name === 'frame');
    for (const b of id('views').children) b.setAttribute('aria-pressed', String(b.dataset.view === name));
}

function chooseScene(name) {
    const answer = app.engine.setScene(name);
    if (!answer.ok) {
        say(answer.error);
        return;
    }
    mean = 0;
    app.firmware?.stop();
    app.scene = name;
    app.model = null;
    app.time = 0;
    app.modelError = undefined;
    id('losses').textContent = '';
    say('');
    markScene();
    app.stage.goHome();
}

function markScene() {
    for (const b of id('scenes').children) b.setAttribute('aria-pressed', String(b.dataset.scene === app.scene));
    id('files').hidden = !(app.model && app.engine.files);
    app.controls.enable(!!app.model);
    id('for-models').hidden = !!app.model;
}

async function takeFiles(files) {
    if (files.length === 0) return;
    try {
        const model = await readModel(files),
            answer = app.engine.setModel(model);
        if (!answer.ok) throw new Error(answer.error);
        mean = 0;
        app.firmware.stop();
        app.model = model;
        app.scene = '';
        app.modelError = undefined;
        app.controls.refuse('', '');
        say('');
        const triangles = model.indices.length / 3;
        id('losses').textContent = [
            `${model.name}: ${triangles.toLocaleString('en-US')} triangle${triangles === 1 ? '' : 's'}`,
            ...new Set([...model.losses, ...(answer.losses || [])]),
        ].join('\n');
        markScene();
        app.stage.goHome();
        draw();
    } catch (e) {
        app.modelError = e.message;
        say(e.message);
    }
    document.documentElement.dataset.taken = String(Number(document.documentElement.dataset.taken || 0) + 1);
}

/* ---- The command, the link, the files ---- */

const quoted = (word) => (/^[\w.,:=+/@-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`);

/* Options that zsim demo has, too. */
const DEMO = /^--(panel|size|strip|subpixel|method|show|rotate|invert|bgr)\b/;

function command() {
    const words = app.engine.commandLine ? app.engine.commandLine() : [];
    const bare = words.map((w) => w.replace(/^(--[\w-]+)=(.*)$/s, (_, name, value) => `${name} ${quoted(value)}`));
    const v = app.stage.view,
        turned = v.yaw !== HOME.yaw || v.pitch !== HOME.pitch || v.distance !== 1;
    const step = app.scene ? app.time % app.engineScenes.find((s) => s.name === app.scene).frames : 0;
    const text = app.model
        ? `build/zsim render ${quoted(app.model.name)} ${bare.join(' ')} --out frame.png` +
          (turned ? '   # from its own camera' : '')
        : `build/zsim demo --scene ${app.scene}${step ? ` --start ${step}` : ''} --frames 1` +
          `${bare.filter((w) => DEMO.test(w)).map((w) => ` ${w}`).join('')}` +
          `${turned ? ` --orbit=${v.yaw - HOME.yaw},${v.pitch - HOME.pitch},${v.distance}` : ''} --out .`;
    /* options do not break at their hyphens */
    id('command').replaceChildren(
        ...text.split(/(--[\w-]+)/).map((part, i) => (i % 2 ? make('span', {}, part) : part)),
    );
}

function keepLink() {
    const v = app.stage.view,
        values = {};
    if (app.scene) values.scene = app.scene;
    values.part = app.part;
    values.panel = app.panel.name || `${app.panel.width}x${app.panel.height}`;
    for (const [name, o] of app.options)
        if (!['panel', 'width', 'height', 'falseColors'].includes(name) && o.value !== undefined && o.value !== null)
            values[name] = o.value;
    if (app.shown !== 'frame') values.view = app.shown;
    if (v.yaw !== HOME.yaw || v.pitch !== HOME.pitch || v.distance !== 1)
        values.at = [v.yaw, v.pitch, v.distance].map((n) => Number(n.toFixed(3))).join(',');
    if (app.time > 0 && app.scene) values.frame = app.time;
    writeLink(values);
}

function takeLink(link) {
    const typed = {};
    for (const [name, o] of app.options) {
        if (link[name] === undefined || PLACED.has(name)) continue;
        typed[name] =
            o.kind === 'number' ? Number(link[name]) : o.kind === 'flag' ? link[name] === 'true' : link[name];
    }
    app.part = link.part || 'rp2040';
    const size = /^(\d+)x(\d+)$/.exec(link.panel || '');
    app.panel = size
        ? { ...PANELS[PANELS.length - 1], width: Number(size[1]), height: Number(size[2]) }
        : PANELS.find((p) => p.name === link.panel) || PANELS[0];
    const at = (link.at || '').split(',').map(Number);
    if (at.length === 3 && at.every(Number.isFinite))
        Object.assign(app.stage.view, { yaw: at[0], pitch: at[1], distance: at[2] });
    app.time = Number(link.frame) > 0 ? Number(link.frame) : 0;
    return typed;
}

function download(name, content, type = 'text/plain') {
    const a = make('a', { href: URL.createObjectURL(new Blob([content], { type })), download: name });
    a.click();
    setTimeout(() => URL.revokeObjectURL(a.href), 1000);
}

/* ---- The page's own parts ---- */

function buildPage(scenes) {
    id('panel').append(...PANELS.map((p) => make('option', { value: p.name, textContent: `${p.title}: ${p.text}` })));
    id('panel').addEventListener('change', () => choosePanel(id('panel').value));
    id('part').addEventListener('change', () => choosePart(id('part').value));
    id('scale').append(
        make('option', { value: 0, textContent: 'as far as it fits' }),
        ...[1, 2, 3, 4, 5, 6, 8].map((n) => make('option', { value: n, textContent: `${n} times` })),
    );
    id('scale').addEventListener('change', () => {
        app.stage.wanted = Number(id('scale').value);
        app.stage.fit();
    });
    id('scenes').append(
        ...scenes.map((s) => {
            const b = make('button', { type: 'button', title: s.text || '' }, s.name);
            b.dataset.scene = s.name;
            b.addEventListener('click', () => chooseScene(s.name));
            return b;
        }),
    );
    const shown = app.options.get('falseColors');
    const choices = [...(shown ? shown.choices : ['frame'])].sort(
        (a, b) => Object.keys(VIEWS).indexOf(a) - Object.keys(VIEWS).indexOf(b),
    );
    id('views').append(
        ...choices.map((name) => {
            const b = make('button', { type: 'button' }, VIEWS[name] || name);
            b.dataset.view = name;
            b.addEventListener('click', () => chooseView(name));
            return b;
        }),
    );
    for (const name of ['width', 'height']) {
        const field = app.controls.field(app.options.get(name));
        app.controls.fields.get(name).input.value = app.panel[name];
        id('size-fields').append(field);
    }
}

function listen() {
    id('turn').addEventListener('click', () => {
        app.turning = !app.turning;
        app.turned = 0;
        id('turn').setAttribute('aria-pressed', String(app.turning));
        want();
    });
    id('slow').addEventListener('click', async () => {
        id('slow').disabled = true;
        await app.stage.playStrips();
        id('slow').disabled = false;
    });
    id('home').addEventListener('click', () => {
        app.time = 0;
        app.stage.goHome();
    });
    id('pick').addEventListener('change', async () => {
        await takeFiles([...id('pick').files]);
        id('pick').value = '';
    });
    id('controls').addEventListener('submit', (e) => e.preventDefault());
    id('theme').addEventListener('click', () => {
        const root = document.documentElement,
            dark = matchMedia('(prefers-color-scheme: dark)').matches;
        root.dataset.theme = (root.dataset.theme || (dark ? 'dark' : 'light')) === 'dark' ? 'light' : 'dark';
        try {
            localStorage.setItem('zstrip-theme', root.dataset.theme);
        } catch (e) {
            // kept for this window alone
        }
        dispatchEvent(new Event('zstrip-theme'));
    });
    const copy = (text, what) =>
        navigator.clipboard.writeText(text).then(
            () => toast(`${what} is copied`),
            () => toast(text),
        );
    id('share').addEventListener('click', () => {
        keepLink();
        copy(location.href, app.model ? 'The link, without the model,' : 'The link');
    });
    id('copy-command').addEventListener('click', () => copy(id('command').textContent, 'The command'));
    for (const [button, end] of [
        ['get-c', '.c'],
        ['get-h', '.h'],
    ])
        id(button).addEventListener('click', () => {
            const files = app.engine.files('thing'),
                name = Object.keys(files).find((n) => n.endsWith(end));
            if (name) download(name, files[name]);
        });
    id('get-config').addEventListener('click', () => {
        try {
            download('screen.h', app.engine.config());
        } catch (e) {
            say(e.message);
        }
    });
    let depth = 0;
    const veil = (on) => (id('veil').hidden = !on);
    addEventListener('dragenter', (e) => {
        e.preventDefault();
        depth++;
        veil(true);
    });
    addEventListener('dragleave', () => {
        depth--;
        if (depth <= 0) veil(false);
    });
    addEventListener('dragover', (e) => e.preventDefault());
    addEventListener('drop', (e) => {
        e.preventDefault();
        depth = 0;
        veil(false);
        takeFiles([...e.dataTransfer.files]);
    });
}

async function start() {
    app.engine = await createEngine(await packed('wasm'));
    app.controls = new Controls((name, value) => {
        if (name === 'width' || name === 'height') {
            if (configure({ [name]: value }, name)) {
                app.panel = { ...app.panel, [name]: value };
                showPanel();
            }
            return;
        }
        if (name === 'rotate') rotate(value);
        else configure({ [name]: value }, name);
    });
    app.stage = new Stage(want);
    for (const o of app.engine.options()) app.options.set(o.name, o);
    const link = readLink(),
        { rotate: turned, ...typed } = takeLink(link);
    app.engineScenes = app.engine.scenes().filter((s) => !s.bench);
    const first =
        app.engineScenes.find((s) => s.name === link.scene) ||
        app.engineScenes.find((s) => s.name === 'teapot') ||
        app.engineScenes[0];
    app.engine.setScene(first.name);
    app.scene = first.name;
    app.controls.build([...app.options.values()], PLACED);
    buildPage(app.engineScenes);
    const shown = link.view;
    showPanel();
    if (Object.keys(typed).length > 0 && !configure(typed))
        for (const [name, value] of Object.entries(typed)) configure({ [name]: value }, name);
    if (turned !== undefined) rotate(turned);
    if (shown && shown !== 'frame') chooseView(shown);
    markScene();
    listen();
    draw();
    figures();
    app.tradeoff = new Tradeoff(
        () => ({
            engine: app.engine,
            part: app.part,
            view: asked('wrong'),
            what: app.scene || (app.model && app.model.name) || '',
        }),
        draw,
    );
    app.firmware = new Firmware(
        () => ({
            engine: app.engine,
            view: app.stage.view,
            orbit,
            estimate: app.parts.find((p) => p.name === 'rp2040')?.drawMs ?? null,
        }),
        (name, content) => download(name, content, 'application/octet-stream'),
    );
    buildCards(id('cards'));
    document.documentElement.dataset.ready = '1';
}

start().catch((e) => say(`The page cannot start: ${e.message}`));
