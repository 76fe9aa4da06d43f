/* The page as a browser shows it: opened from a file, with models dropped into it.
 *
 * Usage: node tests/web/page.mjs PAGE.html FOLDER
 * FOLDER has models, bad.obj, and of each good one MODEL.png, as zsim drew it.
 *
 * SPDX-License-Identifier: MIT
 */
import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Browser } from './browser.mjs';
import { readPng } from './png.mjs';

const [page, folder] = process.argv.slice(2);
const MOST_BYTES = 1500000;
const url = `file://${page}`;
let failed = 0;

const ok = (name, what = '') => console.log(`ok ${name}${what ? ` (${what})` : ''}`);
const bad = (name, why) => {
    console.log(`FAILED ${name}: ${String(why).replace(/\n/g, ' | ')}`);
    failed = 1;
};
/* A test: `what` gives a note, or throws. */
async function test(name, what) {
    try {
        ok(name, await what());
    } catch (e) {
        bad(name, e.message);
    }
}
function must(truth, why) {
    if (!truth) throw new Error(why);
}
function same(got, wanted, what) {
    must(got === wanted, `${what}: ${JSON.stringify(got)} in place of ${JSON.stringify(wanted)}`);
}

/* How much slower this machine is now than an idle one: a loop that takes 300 ms there. */
function slowness() {
    const times = [];
    for (let i = 0; i < 3; i++) {
        const begun = performance.now();
        let h = 1;
        for (let k = 0; k < 6e7; k++) h = Math.imul(h ^ k, 0x9e3779b1) + (h >>> 15);
        times.push((performance.now() - begun) / 300 + (h === 7 ? 1 : 0));
    }
    return Math.max(1, ...times);
}

const READY = 'document.documentElement.dataset.ready';
const text = (id) => `document.getElementById('${id}').textContent`;
/* The pixels on the glass, c its size, read from a copy; and a checksum of them. */
const PIXELS = `const c = document.getElementById('glass'), copy = new OffscreenCanvas(c.width, c.height);
    const on = copy.getContext('2d', { willReadFrequently: true }); on.drawImage(c, 0, 0);
    const d = on.getImageData(0, 0, c.width, c.height).data;`;
const SUM = `(() => { ${PIXELS}
    let h = 2166136261; for (const v of d) h = Math.imul(h ^ v, 16777619);
    return (h >>> 0) + ' ' + c.width + 'x' + c.height; })()`;
const set = (id, value, event) => `(() => { const e = document.getElementById('${id}'); e.value = '${value}';
    e.dispatchEvent(new Event('${event}', { bubbles: true })); })()`;
/* Until the figures beside the picture are those of what is set now. */
const settled = async (p, from) => p.until(`Number(document.documentElement.dataset.settled) > ${from}`, 'figures');
const count = (p) => p.value('Number(document.documentElement.dataset.settled || 0)');
async function change(p, id, value, event = 'change') {
    const from = await count(p);
    await p.value(set(id, value, event));
    await settled(p, from);
}
async function take(p, ...names) {
    const from = await p.value('Number(document.documentElement.dataset.taken || 0)');
    await p.pick(
        '#pick',
        names.map((n) => join(folder, n)),
    );
    await p.until(`Number(document.documentElement.dataset.taken) > ${from}`, 'the model is taken');
}

const browser = await Browser.start(process.env.CHROMIUM || 'chromium');
const p = await browser.page({ width: 1280, height: 900 });
const pictures = process.env.WEB_PICTURES;

await test('web_size', () => {
    const bytes = statSync(page).size;
    must(bytes < MOST_BYTES, `${bytes} bytes, ${MOST_BYTES} is too many`);
    return `${bytes} bytes`;
});

await test('web_opens', async () => {
    await p.open(url);
    await p.until(READY);
    const slow = slowness(),
        ms = Number(await p.value('document.documentElement.dataset.firstPicture'));
    must(
        ms < 1000 * slow,
        `the first picture came after ${ms} ms on a machine that is ${slow.toFixed(1)} times slower`,
    );
    const colors = await p.value(`(() => { ${PIXELS} return new Set(new Uint32Array(d.buffer)).size; })()`);
    must(colors > 20, `a picture of ${colors} colours`);
    return `first picture after ${ms} ms, machine ${slow.toFixed(1)} times slower`;
});

await test('web_turns', async () => {
    const before = await p.value(SUM),
        from = await count(p);
    await p.value('document.getElementById("glass").focus()');
    await p.key('ArrowRight');
    await settled(p, from);
    const after = await p.value(SUM);
    must(before !== after, 'the right arrow does not turn the picture');
    const again = await count(p);
    await p.key('0', 'Digit0');
    await settled(p, again);
    same(await p.value(SUM), before, 'after 0');
});

/* A teaching card: what its canvas has in memory, and the colours in the middle of the picture's cells. */
const CARD = (title) => `(() => {
    const card = [...document.querySelectorAll('.card')].find((c) => c.querySelector('h3').textContent === '${title}'),
        canvas = card.querySelector('canvas'), ratio = canvas.width / 392, dot = document.createElement('canvas'),
        c = dot.getContext('2d', { willReadFrequently: true }), style = getComputedStyle(document.documentElement),
        tints = { gold: '--c1', blue: '--c2', green: '--c0', '-': '--paper' },
        rgb = (name) => { c.fillStyle = style.getPropertyValue(tints[name]).trim(); c.fillRect(0, 0, 1, 1);
            return c.getImageData(0, 0, 1, 1).data.join(); },
        names = Object.fromEntries(Object.keys(tints).map((name) => [rgb(name), name[0]]));
    let cells = '';
    for (let y = 0; y < 8; y++) {
        for (let x = 0; x < 8; x++)
            cells += names[canvas.getContext('2d').getImageData((8 + x * 22 + 10) * ratio, (8 + y * 22 + 10) * ratio,
                1, 1).data.join()] || '?';
        cells += ' ';
    }
    return { ...canvas.dataset, cells: cells.trim(), said: card.querySelector('.say').textContent }; })()`;
const press = (title, button) =>
    p.value(`[...[...document.querySelectorAll('.card')].find((c) => c.querySelector('h3').textContent === '${title}')
        .querySelectorAll('button')].find((b) => b.textContent === '${button}').click()`);
const letters = (colors) =>
    colors.split(' ').map((name) => name[0]).join('').replace(/.{8}/g, '$& ').trim();

/* The 8x8 buffers of tests/unit/test_zbuffer_examples.c, worked out by hand: 99 is its ZS_DEPTH_CLEAR. */
await test('web_cards_zbuffer', async () => {
    const title = 'Depth buffer',
        empty = new Array(64).fill(99).join(' '),
        five = new Array(64).fill().map((_, i) => ((i & 7) + (i >> 3) <= 6 ? 5 : 99)).join(' '),
        both =
            '5 5 5 5 5 5 5 99 3 5 5 5 5 5 99 99 4 3 5 5 5 99 99 99 5 4 3 5 99 99 99 99 ' +
            '5 5 4 3 99 99 99 99 5 5 5 4 3 99 99 99 5 7 6 5 4 3 99 99 99 99 99 99 99 99 99 99',
        slope =
            '99 99 99 99 99 99 99 99 3 99 99 99 99 99 99 99 4 3 99 99 99 99 99 99 5 4 3 99 99 99 99 99 ' +
            '6 5 4 3 99 99 99 99 7 6 5 4 3 99 99 99 8 7 6 5 4 3 99 99 99 99 99 99 99 99 99 99';
    const steps = [
        [empty, new Array(8).fill('--------').join(' ')],
        [five, 'ggggggg- gggggg-- ggggg--- gggg---- ggg----- gg------ g------- --------'],
        [both, 'ggggggg- bggggg-- bbggg--- gbbg---- ggbb---- ggbbb--- gbbbbb-- --------'],
    ];
    for (const [k, [keys, cells]] of steps.entries()) {
        await press(title, 'Step'); // after the last step, the first again
        const is = await p.value(CARD(title));
        same(is.values, keys, `step ${k}`);
        same(is.cells, cells, `step ${k}: pixels`);
    }
    await press(title, 'Other order');
    await press(title, 'Step');
    same((await p.value(CARD(title))).values, slope, 'the slope alone');
    await press(title, 'Step');
    const last = await p.value(CARD(title));
    same(last.values, both, 'the same keys');
    same(last.cells, 'ggggggg- bggggg-- bbggg--- bbbg---- gbbb---- ggbbb--- gbbbbb-- --------', 'the first stays');
});

await test('web_cards_methods', async () => {
    const right = '---gg--- ---gg--- --bbgg-- --bbgg-- --bbgg-- gbbggggg gbbggggg -bb--gg-'; // green or gold: g
    const wrong = right.replaceAll('---gg---', '---bb---');
    same((await p.value(CARD('Ray casting'))).cells, right, 'rays');
    same((await p.value(CARD('Depth sort'))).cells, right, 'depth sort');
    const painted = await p.value(CARD('Painter’s algorithm'));
    same(letters(painted.colors), wrong, 'painted in a cycle'); // the wrong ones are marked
    same(painted.values, '', 'no keys');
    must(painted.said.startsWith('4 pixels are wrong'), painted.said);
    const taken = await p.value(CARD('Coverage'));
    same(taken.values, right.replaceAll(' ', '').replace(/./g, (c) => `${c === '-' ? 0 : 1} `).trim(), 'bits');
    const hiz = 'Hierarchical depth buffer',
        tiles = ['99 99 99 99', '14 99 18 99', '14 99 18 99', '14 99 18 99'];
    for (const [k, farthest] of tiles.entries()) {
        await press(hiz, 'Step');
        same((await p.value(CARD(hiz))).tiles, farthest, `step ${k}: the farthest of each tile`);
    }
    const done = await p.value(CARD(hiz));
    same(done.values, [0, 1, 2, 3, 4, 5, 6, 7].map((y) => `${`${11 + y} `.repeat(4)}${
        y === 2 || y === 3 ? '45 46 47 48' : '99 99 99 99'}`).join(' '), 'keys');
    must(done.said.includes('all that it touches are skipped'), done.said);
});

/* Of 65536 keys between 1 and 1000 m, at 300 m: z^2 / 65535 * 0.999, 999 / 65535, and z^2 times a step of near / z,
 * which of 12 bits of mantissa is 2^-21 there. */
await test('web_cards_mappings', async () => {
    const said = await p.value(`document.querySelector('.card.double .say').textContent`);
    for (const words of ['At 300 m', 'recip 1.37 m', 'linear 1.5 cm', 'e3m13 8.6 cm', 'e4m12 4.3 cm', 'e5m11 8.6 cm',
        'float is e4m12'])
        must(said.includes(words), `'${words}' is not in: ${said}`);
});

await test('web_effects_turn', async () => {
    const taken = async (what) => {
        const from = await count(p);
        await what();
        await settled(p, from);
        return p.value(SUM);
    };
    for (const scene of ['stilllife', 'cockpit', 'forest']) {
        const before = await taken(() => p.value(`document.querySelector('[data-scene=${scene}]').click()`));
        await p.value('document.getElementById("glass").focus()');
        for (const key of ['ArrowRight', 'ArrowUp'])
            must((await taken(() => p.key(key))) !== before, `${scene}: ${key} does not turn it`);
        same(await taken(() => p.value('document.getElementById("home").click()')), before, `${scene}, put back`);
    }
    await taken(() => p.value('document.querySelector("[data-scene=teapot]").click()'));
});

await test('web_rate', async () => {
    const ms = await p.value(`(async () => { const t = document.getElementById('turn'); t.click();
        const frames = [], root = document.documentElement;
        for (let i = 0; i < 40; i++) await new Promise(requestAnimationFrame);
        t.click(); return Number(root.dataset.frameMs); })()`);
    must(ms > 0 && ms < 16 * slowness(), `${ms} ms a frame`);
    return `teapot at 240x240: ${ms} ms a frame, ${Math.round(1000 / ms)} a second`;
});

await test('web_strip', async () => {
    const home = await count(p);
    await p.value('document.getElementById("home").click()');
    await settled(p, home);
    const before = await p.value(SUM);
    await change(p, 'set-strip', '48', 'input');
    same(await p.value(text('out-strip')), '48 rows', 'what the slider says');
    must((await p.value(text('took-lead'))).includes('in 5 strips'), `strips: ${await p.value(text('took-lead'))}`);
    same(await p.value(SUM), before, 'strips change no pixel');
    must((await p.value('location.hash')).includes('strip=48'), 'the link does not hold it');
});

await test('web_parts', async () => {
    const rows = JSON.parse(
        await p.value(`JSON.stringify([...document.querySelectorAll('.part')].map((r) => [r.dataset.part,
        r.querySelector('.rate').textContent, r.querySelectorAll('.over').length]))`),
    );
    const of = (name) => rows.find((r) => r[0] === name);
    must(rows.length >= 10, `${rows.length} parts`);
    must(Number(of('rp2040')[1].split(' ')[0]) > 5 && of('rp2040')[2] === 0, `rp2040: ${of('rp2040')}`);
    must(of('nrf51822')[2] > 0 && of('nrf51822')[1] === '–', `nrf51822 has 16 KB: ${of('nrf51822')}`);
    const before = await p.value(text('fps')),
        from = await count(p);
    await p.value('document.querySelector("[data-part=stm32f746]").click()');
    await settled(p, from);
    const after = await p.value(text('fps'));
    must(Number(after) > Number(before), `an STM32F746 draws ${after} frames a second, an RP2040 ${before}`);
    await change(p, 'part', 'rp2040');
    same(await p.value(text('fps')), before, 'back on the RP2040');
    must(/binds/.test(await p.value(text('fps-note'))), 'nothing binds');
    const bytes = await p.value(text('ram-meter'));
    await change(p, 'set-strip', '96', 'input');
    must((await p.value(text('ram-meter'))) !== bytes, 'higher strips take no more RAM');
    await change(p, 'set-strip', '48', 'input');
    same(await p.value(text('ram-meter')), bytes, 'RAM of strips of 48 rows');
});

await test('web_refused', async () => {
    const before = await p.value(SUM);
    await p.value(set('set-width', '5000', 'change'));
    await p.until(`${text('why-width')} !== ''`, 'a sentence');
    const why = await p.value(text('why-width'));
    must(/4096/.test(why), why);
    same(await p.value(SUM), before, 'the last good picture');
});

await test('web_views', async () => {
    const before = await p.value(SUM);
    for (const view of ['overdraw', 'depth']) {
        const from = await count(p);
        await p.value(`document.querySelector('[data-view=${view}]').click()`);
        await settled(p, from);
        must((await p.value(SUM)) !== before, `${view} is the picture`);
    }
    const from = await count(p);
    await p.value('document.querySelector("[data-view=frame]").click()');
    await settled(p, from);
    same(await p.value(SUM), before, 'back at the picture');
});

await test('web_link', async () => {
    const hash = await p.value('location.hash'),
        sum = await p.value(SUM);
    const other = await browser.page({ width: 1280, height: 900 });
    await other.open(url + hash);
    await other.until(READY);
    same(await other.value(SUM), sum, 'the same picture');
    same(await other.value(text('out-strip')), '48 rows', 'the same strips');
    same(other.errors.join(), '', 'console');
    await other.send('Page.close');
});

/* How many pixels differ from those that zsim drew; a model of several files. */
async function compare(name, ...others) {
    await take(p, name, ...others);
    same(await p.value(text('error')), '', 'error');
    const { width, height, rgb: wanted } = readPng(readFileSync(join(folder, `${name}.png`)));
    const got = await p.value(`(() => { ${PIXELS}
        let s = c.width + ' ' + c.height;
        for (let i = 0; i < d.length; i += 4) s += ' ' + (d[i] << 16 | d[i + 1] << 8 | d[i + 2]);
        return s; })()`);
    const values = got.split(' ').map(Number);
    same(`${values[0]}x${values[1]}`, `${width}x${height}`, 'size');
    let wrong = 0,
        drawn = 0;
    for (let i = 0; i < width * height; i++) {
        const rgb = (wanted[3 * i] << 16) | (wanted[3 * i + 1] << 8) | wanted[3 * i + 2];
        wrong += rgb !== values[i + 2];
        drawn += rgb !== 0;
    }
    must(drawn > 10000, `zsim drew ${drawn} pixels`);
    same(wrong, 0, 'pixels that differ from those of zsim render');
    return `${drawn} pixels drawn`;
}

await test('web_model', () => compare('held.obj', 'held.mtl'));
await test('web_obj', () => compare('ring.obj', 'ring.mtl', 'ring.png'));
await test('web_stl', () => compare('ring.stl'));
await test('web_ply', () => compare('ring.ply'));
await test('web_big_endian', () => compare('big.ply'));
await test('web_strip_glb', () => compare('strip.glb'));
await test('web_glb', () => compare('ring.glb'));
/* Colours of texels with alpha are those of the file */
await test('web_opaque_alpha', () => compare('opaque.glb'));
await test('web_blended_alpha', () => compare('blend.glb'));
await test('web_mirrored', () => compare('mirrored.glb'));
await test('web_sparse', () => compare('sparse.glb'));

/* What fog takes: frames a second are fewer, and their error is that of effects. */
await test('web_effects_cost', async () => {
    await take(p, 'held.obj', 'held.mtl');
    const part = await p.value('document.getElementById("part").value');
    await change(p, 'part', 'rp2040');
    const fps = async () => [Number(await p.value(text('fps'))), await p.value(text('fps-note'))];
    const [plain] = await fps();
    await change(p, 'set-fog', 'linear:1:4:808080');
    const [fog, note] = await fps();
    must(fog > 0 && fog < plain, `${plain} frames a second, with fog ${fog}`);
    must(/give or take 30 %/.test(note), note);
    await change(p, 'set-fog', '');
    same((await fps())[0], plain, 'frames a second without fog');
    await change(p, 'part', part);
});

/* The planes' sliders: the middle is what fits, the ends a hundredth and a hundred times of it. */
await test('web_planes', async () => {
    const before = await p.value(SUM);
    same(await p.value(text('out-near')), 'as it fits', 'near');
    await change(p, 'set-near', '58', 'input');
    const near = Number(await p.value(text('out-near')));
    must(near > 0, `near is ${near}`);
    must((await p.value(SUM)) !== before, 'a nearer plane cuts nothing');
    must(new RegExp(`--near ${near}( |$)`).test(await p.value(text('command'))), 'the command has it');
    await change(p, 'set-near', '50', 'input');
    same(await p.value(text('out-near')), 'as it fits', 'near again');
    same(await p.value(SUM), before, 'the picture again');
});
await test('web_files', async () => {
    const got = await p.value(`new Promise((yes) => { const was = URL.createObjectURL;
        URL.createObjectURL = (b) => { URL.createObjectURL = was; b.text().then(yes); return was(b); };
        document.getElementById('get-h').click(); })`);
    must(/THING_RADIUS/.test(got) && /thing_instance/.test(got), got.slice(0, 80));
    const config = (await saved('get-config')).toString();
    must(/ZS_RENDERER_BUFFERS\(screen, 240, 240, \d+,/.test(config), config);
});

/* What a button hands out as a file. */
async function saved(button) {
    const got = await p.value(`new Promise((yes, no) => { const was = URL.createObjectURL;
        URL.createObjectURL = (b) => { URL.createObjectURL = was; const r = new FileReader();
            r.onload = () => yes(r.result.split(',')[1]); r.readAsDataURL(b); return was(b); };
        const why = document.getElementById('pico-why');
        new MutationObserver(() => why.textContent && no(new Error(why.textContent))).observe(why, { childList: true });
        document.getElementById('${button}').click(); })`);
    return Buffer.from(got, 'base64');
}
/* The sentence that a click on a button of the firmware ends with, '' where it does what it says. */
async function refusedBy(button) {
    const from = await p.value('Number(document.documentElement.dataset.pico || 0)');
    await p.value(`document.getElementById('${button}').click()`);
    await p.until(`Number(document.documentElement.dataset.pico) > ${from}`, 'an answer');
    return p.value(text('pico-why'));
}

/* page.sh runs these in the emulator of the boards' tests, and holds the picture against zsim's. */
await test('web_uf2', async () => {
    const sizes = [];
    const models = [
        ['glass.obj', 'glass.mtl'],
        ['ring.obj', 'ring.mtl', 'ring.png'],
        ['held.obj', 'held.mtl'],
    ];
    for (const [name, ...others] of models) {
        await take(p, name, ...others);
        const file = await saved('get-uf2');
        must(file.length % 512 === 0 && file.length > 50000, `${file.length} bytes`);
        writeFileSync(join(folder, `${name}.uf2`), file);
        sizes.push(`${name} ${file.length}`);
    }
    return sizes.join(', ');
});

await test('web_pico', async () => {
    const root = 'document.documentElement.dataset',
        cycles = [];
    for (const names of [
        ['glass.obj', 'glass.mtl'],
        ['held.obj', 'held.mtl'],
    ]) {
        await take(p, ...names);
        same(await refusedBy('pico-run'), '', 'why it does not run');
        await p.until(`Number(${root}.picoFrame) >= 8`, 'eight frames on the emulated panel');
        const [frame, differ, taken] = JSON.parse(
            await p.value(`JSON.stringify([${root}.picoFrame, ${root}.picoDiffer, ${root}.picoCycles].map(Number))`),
        );
        same(differ, 0, `pixels of ${names[0]}, in the worst of ${frame} frames, that differ from the page's`);
        const says = await p.value(text('pico-say'));
        must(/Every pixel is the page.s/.test(says) && /first frame was estimated/.test(says), says);
        must(Number((/estimated (\d+) %/.exec(says) || [0, 0])[1]) <= 15, says); /* glass.obj has effects */
        same(await refusedBy('pico-run'), '', 'why it does not stop');
        same(await p.value('document.getElementById("pico-run").getAttribute("aria-pressed")'), 'false', 'it runs');
        cycles.push(taken);
    }
    const colors = await p.value(`(() => { const c = document.getElementById('pico-glass');
        const { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
        return new Set(new Uint32Array(data.buffer)).size; })()`);
    must(colors > 4, `a picture of ${colors} colours on the emulated panel`);
    return `${cycles.join(', ')} cycles`;
});

await test('web_pico_refuses', async () => {
    const why = async (setting, value) => {
        await p.value(set(`set-${setting}`, value, 'change'));
        await p.until(`document.getElementById('set-${setting}').value === '${value}'`);
        const said = await refusedBy('get-uf2');
        await p.value(set(`set-${setting}`, '', 'change'));
        return said;
    };
    must(/four samples a pixel are not/.test(await why('samples', '4')), 'samples');
    const box = (name) => p.value(`document.getElementById("set-${name}").click()`);
    await box('mirror');
    const mirror = await refusedBy('get-uf2');
    must(/a mirror is not in the prebuilt show/.test(mirror), mirror);
    await box('mirror');
    await p.value(set('panel', 'gc9a01:240x240', 'change'));
    const panel = await refusedBy('get-uf2');
    must(/drives an ST7789 of 240x240; choose that panel/.test(panel), panel);
    await p.value(set('panel', 'st7789:240x240', 'change'));
    same(await refusedBy('get-uf2'), '', 'the same panel again');
});

await test('web_bad_model', async () => {
    const before = await p.value(SUM);
    await take(p, 'bad.obj');
    const why = await p.value(text('error'));
    must(/^bad\.obj:6: .*out of range/.test(why), why);
    same(await p.value(SUM), before, 'the last good picture');
    await take(p, 'draco.gltf');
    const draco = await p.value(text('error'));
    must(/^draco\.gltf: .*compressed by Draco, which is not read; export it without/.test(draco), draco);
    same(await p.value(SUM), before, 'the last good picture');
    await take(p, 'held.obj', 'held.mtl');
    same(await p.value(text('error')), '', 'error after a good model');
});

/* Of a scene: 22 settings drawn, the figures of what is set are those beside the picture, and follow it. */
await test('web_time_against_error', async () => {
    const shown = await count(p);
    await p.value('document.querySelector("[data-scene=teapot]").click()');
    await settled(p, shown);
    await change(p, 'part', 'rp2040');
    const before = await p.value(SUM);
    await p.value('document.getElementById("measure").click()');
    await p.until('!document.getElementById("measure").disabled', 'it is measured');
    const rows = JSON.parse(
        await p.value(`JSON.stringify([...document.querySelectorAll('#tradeoff tr')].slice(1)
            .map((r) => [...r.children].map((c) => c.textContent)))`),
    );
    same(rows.length, 22, 'rows');
    same(await p.value('document.querySelectorAll("#tradeoff circle").length'), 23, 'dots');
    const of = (name) => rows.find((r) => r[0] === name);
    const wrong = (name) => Number(of(name)[2].replace(',', ''));
    must(wrong('float, 8 bits') > wrong('float, 16 bits'), `8 bits have no more wrong pixels: ${rows.join('; ')}`);
    must(Number(of('strips of 64 rows')[1]) < Number(of('strips of 4 rows')[1]), 'lower strips take no more time');
    const drawing = async () => (await p.value(text('race'))).match(/drawing([\d.]+) ms/)[1];
    const set = async () => (await p.value(text('tradeoff-say'))).match(/: ([\d.]+) ms on rp2040, ([\d,]+) of/);
    const agree = async (what) => { // one figure, rounded to 0.01 and to 0.1
        const [fine, coarse] = [(await set())[1], await drawing()];
        must(Math.abs(fine - coarse) < 0.0551, `${what}: ${fine} and ${coarse}`);
        return fine;
    };
    const first = await agree('ms of what is set');
    same(await p.value(SUM), before, 'the picture afterwards');
    await change(p, 'set-strip', '96', 'input');
    const ms = await agree('ms of another strip');
    must(ms !== first, `${ms} ms of either strip`);
    /* its wrong pixels are those of the view of that name */
    const from = await count(p);
    await p.value('document.querySelector("[data-view=wrong]").click()');
    await settled(p, from);
    const seen = (await p.value(text('caption'))).match(/[\d,]+(?= pixels are missing| too many| of another)/g);
    const sum = seen.reduce((s, n) => s + Number(n.replace(',', '')), 0);
    same(Number((await set())[2].replace(',', '')), sum, 'wrong pixels');
    const back = await count(p);
    await p.value('document.querySelector("[data-view=frame]").click()');
    await settled(p, back);
});

/* Of a panel that is turned: its size is the other way round, false colours are of that size, and it is measured. */
await test('web_rotates', async () => {
    const size = () => p.value('(({ width, height }) => `${width}x${height}`)(document.getElementById("glass"))');
    const view = async (name) => {
        const from = await count(p);
        await p.value(`document.querySelector('[data-view=${name}]').click()`);
        await settled(p, from);
        same(await p.value(text('error')), '', name);
        return size();
    };
    await take(p, 'held.obj', 'held.mtl');
    await change(p, 'panel', 'st7789:240x320');
    same(await size(), '240x320', 'upright');
    const upright = await view('strips');
    await view('frame');
    await change(p, 'set-rotate', '90');
    same(await p.value(text('why-rotate')), '', 'turned');
    same(await size(), '320x240', 'turned');
    must((await p.value('location.hash')).includes('rotate=90'), 'the link does not hold it');
    must((await view('strips')) !== upright, 'false colours are upright');
    await change(p, 'set-rotate', '');
    same(await size(), upright, 'false colours, turned back');
    await change(p, 'set-rotate', '270');
    await view('frame');
    same(await size(), '320x240', 'turned the other way');
    const hash = await p.value('location.hash'),
        other = await browser.page({ width: 1280, height: 900 });
    await other.open(url + hash);
    await other.until(READY);
    same(await other.value('document.getElementById("glass").width'), 320, 'by the link');
    await other.send('Page.close');
    await p.value('document.getElementById("measure").click()');
    await p.until('!document.getElementById("measure").disabled', 'it is measured');
    same(await p.value('document.querySelectorAll("#tradeoff tr").length'), 23, 'rows');
    same(await size(), '320x240', 'afterwards');
    await change(p, 'panel', '');
    same(await size(), '320x240', 'of its own size');
    same(await p.value('document.getElementById("set-rotate").value'), '0', 'not turned');
    await change(p, 'panel', 'st7789:240x240');
});

/* Each broken model gives the sentence that zsim gives, and the picture stays. */
await test('web_bad_sentences', async () => {
    const before = await p.value(SUM),
        files = readdirSync(join(folder, 'bad')),
        all = files.filter((n) => !/\.(txt|mtl)$/.test(n));
    for (const name of all) {
        const paints = name.replace(/\w+$/, 'mtl');
        await take(p, ...[name, paints].filter((n) => files.includes(n)).map((n) => join('bad', n)));
        const said = readFileSync(join(folder, 'bad', `${name}.txt`), 'utf8').trim();
        same(await p.value(text('error')), said, name);
    }
    same(await p.value(SUM), before, 'the last good picture');
    await take(p, 'held.obj', 'held.mtl');
    must(all.length > 30, `${all.length} models`);
    return `${all.length} models`;
});

await test('web_quiet', () => {
    const said = p.errors.filter((e) => !/WebGL/.test(e)); // a software driver's words about its speed
    same(said.join(' | '), '', 'console');
    const others = p.requests.filter((r) => !/^(data|blob):/.test(r) && r.split('#')[0] !== url);
    same(others.join(' '), '', 'loaded from elsewhere');
});

await test('web_phone', async () => {
    const phone = await browser.page({ width: 390, height: 844, scale: 2, dark: true, touch: true });
    await phone.open(url);
    await phone.until(READY);
    const got = await phone.value(`JSON.stringify([document.documentElement.scrollWidth,
        document.getElementById('glass').getBoundingClientRect().width * devicePixelRatio /
            document.getElementById('glass').width,
        document.querySelectorAll('input:not([type=hidden]), select').length,
        [...document.querySelectorAll('input, select')]
            .filter((e) => !e.labels || e.labels.length === 0).map((e) => e.id).join()])`);
    const [width, factor, fields, nameless] = JSON.parse(got);
    must(width <= 390, `the page is ${width} px wide`);
    must(Number.isInteger(factor) && factor >= 1, `pixels are enlarged ${factor} times`);
    must(fields > 10, `${fields} fields`);
    same(nameless, '', 'fields without a label');
    same(phone.errors.join(), '', 'console');
    if (pictures) writeFileSync(join(pictures, 'phone.png'), await phone.picture(true));
});

await test('web_keyboard', async () => {
    await p.value('document.querySelector(".skip").focus()');
    const seen = new Set();
    for (let i = 0; i < 90; i++) {
        await p.key('Tab');
        seen.add(
            await p.value(`(() => { const e = document.activeElement, s = getComputedStyle(e), box = e.closest('.drop');
            const line = (box ? getComputedStyle(box) : s).outlineStyle; return e.id + ' ' + line; })()`),
        );
    }
    for (const id of ['pick', 'panel', 'set-strip', 'glass', 'turn', 'theme'])
        must(
            [...seen].some((s) => s.startsWith(`${id} `) && !s.endsWith(' none')),
            `Tab does not reach ${id} visibly`,
        );
});

if (pictures) writeFileSync(join(pictures, 'desktop.png'), await p.picture(true));
await browser.stop();
process.exit(failed);
