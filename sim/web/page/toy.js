/* Ways to find visible surfaces, on 8x8 pixels and three bars that overlap in a cycle. Each is a generator: a step
 * gives what is in memory then and a sentence. Nothing here is the renderer's code: it is small enough to be read.
 *
 * SPDX-License-Identifier: MIT
 */
export const N = 8;
const FAR = 99;

/* Convex polygons in pixels; depth = z + zx x + zy y. Each bar is in front of the next one, the last of
 * the first. */
export const BARS = [
    {
        name: 'green',
        tint: '--c0',
        points: [
            [0.2, 5],
            [7.8, 5],
            [7.8, 7],
            [0.2, 7],
        ],
        z: 18,
        zx: 6.5,
        zy: 0,
    },
    {
        name: 'gold',
        tint: '--c1',
        points: [
            [5.6, 8],
            [2.6, 0],
            [4.6, 0],
            [7.6, 8],
        ],
        z: 20,
        zx: 0,
        zy: 8,
    },
    {
        name: 'blue',
        tint: '--c2',
        points: [
            [0.4, 8],
            [3.4, 0],
            [5.4, 0],
            [2.4, 8],
        ],
        z: 44,
        zx: 0,
        zy: -5,
    },
];

const depthAt = (p, x, y) => Math.round(p.z + p.zx * x + p.zy * y);

function inside(p, x, y) {
    let side = 0;
    for (let i = 0; i < p.points.length; i++) {
        const [ax, ay] = p.points[i],
            [bx, by] = p.points[(i + 1) % p.points.length];
        const e = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
        if (e !== 0 && side !== 0 && Math.sign(e) !== side) return false;
        side = side || Math.sign(e);
    }
    return true;
}

function* pixelsOf(p) {
    for (let i = 0; i < N * N; i++) {
        const x = (i % N) + 0.5,
            y = Math.floor(i / N) + 0.5;
        if (inside(p, x, y)) yield [i, depthAt(p, x, y)];
    }
}

const empty = () => ({
    color: new Array(N * N).fill(null),
    depth: new Array(N * N).fill(null),
    mark: new Set(),
    say: '',
});

/** The right picture: of each pixel the nearest bar. */
export function truth(bars) {
    const out = empty();
    for (const p of bars)
        for (const [i, z] of pixelsOf(p))
            if (out.depth[i] === null || z < out.depth[i]) {
                out.depth[i] = z;
                out.color[i] = p;
            }
    return out;
}

const wrongOf = (s, bars) => {
    const right = truth(bars);
    return s.color.reduce((n, c, i) => n + ((c && c.name) !== (right.color[i] && right.color[i].name)), 0);
};
const middle = (p) => p.points.reduce((sum, [x, y]) => sum + p.z + p.zx * x + p.zy * y, 0) / p.points.length;

/* Draw a pixel, and mark it, if it is nearer than what is there. */
function put(s, i, z, p) {
    if (z >= s.depth[i])
        return false;
    s.depth[i] = z;
    s.color[i] = p;
    s.mark.add(i);
    return true;
}

export function* zbuffer(bars) {
    const s = empty();
    s.depth.fill(FAR);
    s.say = `Every key starts at ${FAR}, the far end.`;
    yield s;
    for (const p of bars) {
        let near = 0,
            behind = 0;
        s.mark = new Set();
        for (const [i, z] of pixelsOf(p)) {
            if (put(s, i, z, p))
                near++;
            else
                behind++;
        }
        s.say = `${p.name}: ${near} pixels are nearer than what is there, ${behind} lie behind and are left alone.`;
        yield s;
    }
    s.mark = new Set();
    s.say = 'Done. The keys are the same in any order; where two are equal, what came first stays.';
    yield s;
}

/* A textbook's two triangles: one at depth 5; one from 3 at its slanted edge, and one more for each pixel to the
 * left. */
zbuffer.bars = [
    {
        name: 'gold',
        tint: '--c1',
        points: [
            [0, 0],
            [7.5, 0],
            [0, 7.5],
        ],
        z: 5,
        zx: 0,
        zy: 0,
    },
    {
        name: 'blue',
        tint: '--c2',
        points: [
            [0, 0.5],
            [6.5, 7],
            [0, 7],
        ],
        z: 2,
        zx: -1,
        zy: 1,
    },
];

export function* hiz(bars) {
    const s = empty();
    s.depth.fill(FAR);
    s.tiles = new Array(4).fill(FAR);
    s.say = 'Beside the keys, each tile of 4×4 keeps the farthest of them.';
    yield s;
    for (const p of [...bars].sort((a, b) => middle(a) - middle(b))) {
        const tiles = new Map();
        for (const hit of pixelsOf(p)) {
            const t = Math.floor(hit[0] / 32) * 2 + Math.floor((hit[0] % N) / 4);
            tiles.set(t, [...(tiles.get(t) || []), hit]);
        }
        let skipped = 0;
        s.mark = new Set();
        for (const [t, hits] of tiles) {
            if (Math.min(...hits.map(([, z]) => z)) >= s.tiles[t]) {
                skipped++;
                continue;
            }
            for (const [i, z] of hits)
                put(s, i, z, p);
            const all = s.depth.filter((_, i) => Math.floor(i / 32) * 2 + Math.floor((i % N) / 4) === t);
            s.tiles[t] = Math.max(...all);
        }
        s.say =
            skipped > 0
                ? `${p.name}: ${skipped === tiles.size ? 'all' : `${skipped} of ${tiles.size}`} that it touches are ` +
                  'skipped whole: all in them is nearer.'
                : `${p.name}: ${s.mark.size} pixels are drawn, no tile is skipped.`;
        yield s;
    }
}

/* A wall before two bars, so that there is something to hide. */
hiz.bars = [
    {
        name: 'a blue wall',
        tint: '--c2',
        points: [
            [0, 0],
            [4, 0],
            [4, 8],
            [0, 8],
        ],
        z: 10,
        zx: 0,
        zy: 1,
    },
    {
        name: 'a green bar',
        tint: '--c0',
        points: [
            [0.2, 2],
            [7.8, 2],
            [7.8, 4],
            [0.2, 4],
        ],
        z: 40,
        zx: 1,
        zy: 0,
    },
    {
        name: 'a gold bar',
        tint: '--c1',
        points: [
            [1, 5],
            [3.6, 5],
            [3.6, 7],
            [1, 7],
        ],
        z: 70,
        zx: 0,
        zy: 0,
    },
];

export function* painter(bars) {
    const s = empty(),
        order = [...bars].sort((a, b) => middle(b) - middle(a));
    s.depth = null;
    s.say = `Sorted by the depth of their middles: ${order.map((p) => p.name).join(', then ')}.`;
    yield s;
    for (const p of order) {
        s.mark = new Set();
        for (const [i] of pixelsOf(p)) {
            s.color[i] = p;
            s.mark.add(i);
        }
        s.say = `${p.name} is painted over all that is there. No key is kept.`;
        yield s;
    }
    const right = truth(bars);
    s.mark = new Set();
    s.wrong = new Set(
        s.color.flatMap((c, i) => ((c && c.name) !== (right.color[i] && right.color[i].name) ? [i] : [])),
    );
    s.say = `${s.wrong.size} pixels are wrong: the three overlap in a cycle, and no order of whole bars is right.`;
    yield s;
}

/* A polygon cut where its plane meets another's: what is before it, and what is behind. */
function cut(p, q) {
    const side = ([x, y]) => p.z + p.zx * x + p.zy * y - (q.z + q.zx * x + q.zy * y);
    const out = [[], []];
    p.points.forEach((a, i) => {
        const b = p.points[(i + 1) % p.points.length],
            da = side(a),
            db = side(b);
        if (da <= 0) out[0].push(a);
        if (da >= 0) out[1].push(a);
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
            const t = da / (da - db),
                at = [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            out[0].push(at);
            out[1].push(at);
        }
    });
    return out.filter((points) => points.length > 2).map((points) => ({ ...p, points }));
}

/* Does p hide q anywhere? Asked at many points, so that a reader sees what is meant. */
function hides(p, q) {
    for (let y = 0.1; y < N; y += 0.2)
        for (let x = 0.1; x < N; x += 0.2)
            if (inside(p, x, y) && inside(q, x, y) && p.z + p.zx * x + p.zy * y < q.z + q.zx * x + q.zy * y - 1e-6)
                return true;
    return false;
}

export function* depthsort(bars) {
    const s = empty(),
        todo = [...bars];
    let splits = 0;
    s.depth = null;
    s.say = 'Paint what hides nothing that is left. Where there is no such piece, cut one.';
    yield s;
    while (todo.length > 0) {
        s.mark = new Set();
        const free = todo.findIndex((p) => todo.every((q) => q === p || !hides(p, q)));
        if (free < 0) {
            let pair = [0, 1];
            for (let i = 0; i < todo.length; i++)
                for (let j = 0; j < todo.length; j++)
                    if (i !== j && hides(todo[i], todo[j]) && cut(todo[i], todo[j]).length === 2) pair = [i, j];
            const [p, q] = [todo[pair[0]], todo[pair[1]]],
                pieces = cut(p, q);
            todo.splice(pair[0], 1, ...pieces);
            splits++;
            s.say = `A cycle: ${p.name} is cut where its plane meets that of ${q.name}.`;
        } else {
            const [p] = todo.splice(free, 1);
            for (const [i] of pixelsOf(p)) {
                s.color[i] = p;
                s.mark.add(i);
            }
            s.say = `${p.name}: ${s.mark.size} pixels, ${todo.length} pieces are left.`;
        }
        yield s;
    }
    s.mark = new Set();
    s.say = 
        `Done after ${splits === 1 ? 'one cut' : `${splits} cuts`}: ` +
        `${wrongOf(s, bars)} pixels are wrong, and no key was kept.`;
    yield s;
}

export function* coverage(bars) {
    const s = empty(),
        right = truth(bars);
    s.depth = null;
    s.bits = new Array(N * N).fill(0);
    s.say = 'One bit a pixel: is it taken? Pieces come from near to far.';
    yield s;
    for (const p of [...bars].sort((a, b) => middle(a) - middle(b))) {
        let skipped = 0;
        s.mark = new Set();
        for (const [i] of pixelsOf(p)) {
            if (s.bits[i] || right.color[i] !== p) {
                skipped += s.bits[i];
                continue; // a piece that lies behind another one comes later in depth sort's list
            }
            s.bits[i] = 1;
            s.color[i] = p;
            s.mark.add(i);
        }
        s.say = `${p.name}: ${s.mark.size} pixels are coloured, ${skipped} were taken. Each is coloured once.`;
        yield s;
    }
}

export function* raycast(bars) {
    const s = empty();
    s.depth.fill(FAR);
    s.say = 'The other order of the loops: for each pixel, all bars.';
    yield s;
    for (let y = 0; y < N; y++) {
        s.mark = new Set();
        for (let x = 0; x < N; x++) {
            const i = y * N + x,
                hit = bars.filter((p) => inside(p, x + 0.5, y + 0.5));
            s.mark.add(i);
            for (const p of hit) {
                const z = depthAt(p, x + 0.5, y + 0.5);
                if (z < s.depth[i]) {
                    s.depth[i] = z;
                    s.color[i] = p;
                }
            }
        }
        s.say = `Row ${y + 1}: ${N} rays, ${N * bars.length} questions "where does it meet this bar?"`;
        yield s;
    }
    s.mark = new Set();
    s.say = `Done: ${N * N * bars.length} questions for ${N * N} pixels.`;
    yield s;
}
