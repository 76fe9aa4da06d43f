// node tests/lab/effects/error.mjs BUILD BOARD.mjs: how far estimates of frames with effects are from what these take
// in an emulated RP2040, the prebuilt show of sim/web with each frame in it. Ends with 1 where one is further off than
// sim_effects_error says. BOARD.mjs: sim/web/pico/board.js with its emulator.
//
// SPDX-License-Identifier: MIT
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';

import { createEngine } from '../../../sim/web/engine.js';
import { imageWith } from '../../../sim/web/page/uf2.js';

const [ build, bundle ] = process.argv.slice(2);
const { Board } = await import(resolve(bundle));
const engine = await createEngine(readFileSync(`${build}/web/engine.wasm`));
const stem = `${build}/fw/pico-model/show_model`;
const show = { symbols : {}, arena : 0, image : new Uint8Array(readFileSync(`${stem}.bin`)) };
for (const line of readFileSync(`${stem}.txt`, 'utf8').trim().split('\n')) {
    const [name, at, , kind, bytes] = line.split('|').map((word) => word.trim());
    show.symbols[name] = parseInt(at, 16) | (kind === 'FUNC' ? 1 : 0);
    if (name === 'show_model_arena') show.arena = parseInt(bytes, 16);
}

// A ball of a x b quads: small triangles, or large ones in perspective.
function ball(a, b) {
    const positions = [], uvs = [], indices = [];
    for (let j = 0; j <= b; j++)
        for (let i = 0; i <= a; i++) {
            const t = 2 * Math.PI * i / a, p = Math.PI * j / b;
            positions.push(Math.sin(p) * Math.cos(t), Math.cos(p), Math.sin(p) * Math.sin(t));
            uvs.push(2 * i / a, j / b);
        }
    for (let j = 0; j < b; j++)
        for (let i = 0; i < a; i++) {
            const q = j * (a + 1) + i;
            indices.push(q, q + 1, q + a + 2, q, q + a + 2, q + a + 1);
        }
    const rgba = new Uint8Array(32 * 32 * 4).map((_, i) => i % 4 === 3 ? 255 : i * 37 & 255);
    return {
        name : 'ball', positions : Float64Array.from(positions), uvs : Float64Array.from(uvs),
        indices : Uint32Array.from(indices), materials : [ { texture : 0 } ],
        textures : [ { width : 32, height : 32, rgba } ], triMaterial : new Uint32Array(indices.length / 3)
    };
}
const lit = { light : 'dir:1,2,3' }, point = { light : 'point:2,2,2' }, bright = { specular : '20:0.5' };
const looks = [
    { shade : 'flat' }, { shade : 'smooth' }, { shade : 'textured' }, { shade : 'flat', ...lit },
    { shade : 'smooth', ...lit, ...bright }, { shade : 'smooth', ...point }, { shade : 'smooth', perPixel : true },
    { shade : 'smooth', perPixel : true, ...bright }, { shade : 'smooth', perPixel : true, ...point },
    { shade : 'smooth', dither : 'ordered' }, { shade : 'flat', fog : 'linear:1:6:808080' },
    { shade : 'textured', fog : 'linear:1:6:808080' }, { shade : 'flat', shadow : 'planar' },
    { shade : 'smooth', shadow : 'map' }, { shade : 'textured', filter : 'bilinear' },
    { shade : 'textured', filter : 'mipmap' }, { shade : 'textured', ...bright }, { shade : 'textured', ...lit },
    { shade : 'textured', perPixel : true },
    ...[ 'flat', 'smooth', 'textured' ].flatMap(
        (shade) => [ 'alpha', 'add', 'screen-door' ].map((blend) => ({ shade, alpha : 0.5, blend })))
];
const none = Object.fromEntries(looks.flatMap((look) => Object.keys(look)).map((name) => [ name, undefined ]));
const must = (answer) => { if (!answer.ok) throw new Error(answer.error); return answer; };

let worst = 0, most = 0;
for (const [what, model] of [ [ 'ball of 2,320', ball(40, 30) ], [ 'ball of 64', ball(8, 5) ] ])
    for (const look of looks) {
        must(engine.configure({ ...none, panel : 'st7789:240x240', width : 240, height : 240, strip : 24 }));
        must(engine.setModel(model));
        must(engine.configure(look));
        engine.render();
        const part = engine.parts().find((one) => one.name === 'rp2040');
        const flash = must(engine.flash({ frames : 1, arena : show.arena, flash : 1 << 20 }));
        const board = new Board(imageWith(show, flash).image, show.symbols);
        board.patch('show_test', 0, 1 << 30);
        board.picture(); // caches and the panel are set up
        const { cycles } = board.picture(), off = part.drawMs * part.mhz * 1e3 / cycles - 1;
        worst = Math.max(worst, Math.abs(off));
        most = Math.max(most, 100 * part.fpsError);
        const figure = (value, digits) => value.toFixed(digits).padStart(7);
        const estimated = figure(part.drawMs * part.mhz / 1e3, 2), measured = figure(cycles / 1e6, 2);
        console.log(`${what.padEnd(14)} ${JSON.stringify(look).padEnd(64)} estimated ${estimated} M, measured ${
            measured} M ${figure(100 * off, 1)} %`);
    }
const far = 100 * worst > most;
const said = `estimates of effects: at most ${(100 * worst).toFixed(1)} % off, of ${most.toFixed(0)} %`;
console.log(`${far ? 'FAILED' : 'ok'} ${said}`);
process.exit(far ? 1 : 0);
