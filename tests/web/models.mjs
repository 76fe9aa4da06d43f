/* Models of each format that the page reads, of one ring, with a texture where the format has one.
 *
 * Usage: node tests/web/models.mjs FOLDER: ring.obj, ring.mtl, ring.png, ring.stl, ring.ply, big.ply, ring.glb,
 * opaque.glb, blend.glb, mirrored.glb, sparse.glb, strip.glb, draco.gltf; and into FOLDER/bad what nothing can be made
 * of
 *
 * SPDX-License-Identifier: MIT
 */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { deflateSync } from 'node:zlib';

const A = 24,
    B = 12,
    SIDE = 32;
const points = [],
    normals = [],
    uvs = [],
    indices = [];
const write = (name, data) => writeFileSync(join(process.argv[2], name), data);

for (let i = 0; i <= A; i++)
    for (let j = 0; j <= B; j++) {
        const a = (i / A) * 2 * Math.PI,
            b = (j / B) * 2 * Math.PI,
            r = 1 + 0.4 * Math.cos(b);
        points.push([r * Math.cos(a), 0.4 * Math.sin(b) + 0.1 * Math.sin(3 * a), r * Math.sin(a)]);
        normals.push([Math.cos(b) * Math.cos(a), Math.sin(b), Math.cos(b) * Math.sin(a)]);
        uvs.push([(3 * i) / A, j / B]);
    }
for (let i = 0; i < A; i++)
    for (let j = 0; j < B; j++) {
        const q = i * (B + 1) + j;
        indices.push(q, q + 1, q + B + 2, q, q + B + 2, q + B + 1);
    }
const triangles = Array.from({ length: indices.length / 3 }, (_, t) => indices.slice(3 * t, 3 * t + 3));

/* ---- A texture ---- */

function crc(bytes) {
    let c = ~0;
    for (const v of bytes) {
        c ^= v;
        for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
    }
    return ~c >>> 0;
}
function chunk(name, data) {
    const out = Buffer.alloc(12 + data.length);
    out.writeUInt32BE(data.length, 0);
    out.write(name, 4, 'latin1');
    data.copy(out, 8);
    out.writeUInt32BE(crc(out.subarray(4, 8 + data.length)), 8 + data.length);
    return out;
}
/* Of squares; channels: 3, or 4 with alpha, of which some is 0 and some nearly so. */
function picture(channels) {
    const raw = Buffer.alloc(SIDE * (channels * SIDE + 1)),
        head = Buffer.alloc(13);
    for (let y = 0; y < SIDE; y++)
        for (let x = 0; x < SIDE; x++)
            raw.set(
                [((x >> 3) ^ (y >> 3)) & 1 ? 230 : 30, 8 * x, 8 * y, [0, 3, 100, 255][(x >> 2) & 3]].slice(0, channels),
                y * (channels * SIDE + 1) + 1 + channels * x,
            );
    head.writeUInt32BE(SIDE, 0);
    head.writeUInt32BE(SIDE, 4);
    head.set([8, channels === 4 ? 6 : 2], 8);
    return Buffer.concat([
        Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]),
        chunk('IHDR', head),
        chunk('IDAT', deflateSync(raw)),
        chunk('IEND', Buffer.alloc(0)),
    ]);
}
const png = picture(3);
write('ring.png', png);

/* ---- OBJ, STL, PLY ---- */

const rows = (list, word) => list.map((v) => `${word}${v.join(' ')}\n`).join('');
write('ring.mtl', 'newmtl m\nKd 0.9 0.8 1\nmap_Kd ring.png\n');
write(
    'ring.obj',
    `mtllib ring.mtl\nusemtl m\n${rows(points, 'v ')}${rows(uvs, 'vt ')}${rows(normals, 'vn ')}` +
        rows(
            triangles.map((t) => t.map((v) => `${v + 1}/${v + 1}/${v + 1}`)),
            'f ',
        ),
);

const stl = Buffer.alloc(84 + 50 * triangles.length);
stl.writeUInt32LE(triangles.length, 80);
triangles.forEach((t, i) =>
    t.forEach((v, k) => points[v].forEach((p, c) => stl.writeFloatLE(p, 84 + 50 * i + 12 + 12 * k + 4 * c))),
);
write('ring.stl', stl);

write(
    'ring.ply',
    `ply\nformat ascii 1.0\nelement vertex ${points.length}\n${rows(
        ['x', 'y', 'z'].map((c) => ['float', c]),
        'property ',
    )}` +
        `${rows(
            ['red', 'green', 'blue'].map((c) => ['uchar', c]),
            'property ',
        )}element face ${triangles.length}\n` +
        `property list uchar int vertex_indices\nend_header\n${rows(
            points.map((p, i) => [...p, (i * 7) % 256, (i * 3) % 256, 90]),
            '',
        )}` +
        rows(
            triangles.map((t) => [3, ...t]),
            '',
        ),
);

/* The same, binary, the most significant byte first */
const big = Buffer.alloc(12 * points.length + 13 * triangles.length);
points.forEach((p, i) => p.forEach((c, k) => big.writeFloatBE(c, 12 * i + 4 * k)));
triangles.forEach((t, i) => {
    const at = 12 * points.length + 13 * i;
    big.writeUInt8(3, at);
    t.forEach((v, k) => big.writeInt32BE(v, at + 1 + 4 * k));
});
const bigHead = Buffer.from(
    `ply\nformat binary_big_endian 1.0\nelement vertex ${points.length}\nproperty float x\nproperty float y\n` +
        `property float z\nelement face ${triangles.length}\nproperty list uchar int vertex_indices\nend_header\n`,
);
write('big.ply', Buffer.concat([bigHead, big]));
big.writeFloatBE(NaN, 12 * 5);
write('bad/big.ply', Buffer.concat([bigHead, big]));
stl.writeFloatLE(NaN, 84 + 50 * 7 + 12);
write('bad/nan.stl', stl);
stl.writeUInt32LE(3, 80);
write('bad/longer.stl', stl);

/* ---- glTF: one mesh at two places, turned, and mirrored; in sparse.glb some of its points are replaced ---- */

const floats = (list) => Buffer.from(Float32Array.from(list.flat()).buffer);
const replaced = points.map((_, i) => i).filter((i) => i % 5 === 2);
const strip = [];
for (let i = 0; i < A; i++)
    for (let j = 0; j <= B; j++) {
        const q = i * (B + 1) + j;
        strip.push(...(j === 0 ? [q, q] : []), q, q + B + 1, ...(j === B ? [q + B + 1, q + B + 1] : []));
    }
const buffers = [
    floats(points),
    floats(normals),
    floats(uvs),
    Buffer.from(Uint16Array.from(indices).buffer),
    png,
    Buffer.from(Uint16Array.from(replaced).buffer),
    floats(replaced.map((i) => points[i].map((c) => c * 1.25))),
    Buffer.from(Uint16Array.from(strip).buffer),
    picture(4),
];
let bytes = 0;
const bufferViews = buffers.map((b) => {
    const view = { buffer: 0, byteOffset: bytes, byteLength: b.length };
    bytes += (b.length + 3) & ~3;
    return view;
});
const bin = Buffer.alloc(bytes);
buffers.forEach((b, i) => b.copy(bin, bufferViews[i].byteOffset));
const accessor = (bufferView, componentType, count, type) => ({ bufferView, componentType, count, type });
const gltf = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0, 1] }],
    nodes: [
        { mesh: 0, rotation: [0.2588190451, 0, 0, 0.9659258263], scale: [1, 1.2, 1] },
        { mesh: 0, translation: [0.5, 1.3, 0], scale: [-0.5, 0.5, 0.5] },
    ],
    meshes: [
        { primitives: [{ attributes: { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2 }, indices: 3, material: 0 }] },
    ],
    materials: [
        {
            name: 'm',
            pbrMetallicRoughness: {
                baseColorFactor: [1, 0.9, 0.8, 1],
                baseColorTexture: { index: 0 },
                metallicFactor: 0,
            },
        },
    ],
    textures: [{ source: 0 }],
    images: [{ bufferView: 4, mimeType: 'image/png' }],
    bufferViews,
    buffers: [{ byteLength: bytes }],
    accessors: [
        { ...accessor(0, 5126, points.length, 'VEC3'), min: [-2, -2, -2], max: [2, 2, 2] },
        accessor(1, 5126, points.length, 'VEC3'),
        accessor(2, 5126, points.length, 'VEC2'),
        accessor(3, 5123, indices.length, 'SCALAR'),
        accessor(7, 5123, strip.length, 'SCALAR'),
    ],
};
const words = (...n) => Buffer.from(Uint32Array.from(n).buffer);
function glb(name) {
    const text = Buffer.from(JSON.stringify(gltf)),
        json = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 32)]);
    const head = [Buffer.from('glTF'), words(2, 28 + json.length + bytes, json.length), Buffer.from('JSON')];
    write(name, Buffer.concat([...head, json, words(bytes), Buffer.from('BIN\0'), bin]));
}
glb('ring.glb');
/* With a part changed. */
function changed(name, change) {
    const kept = structuredClone(gltf);
    change();
    glb(name);
    Object.assign(gltf, kept);
}
changed('strip.glb', () => {
    gltf.meshes = [{ primitives: [{ attributes: { POSITION: 0 }, indices: 4, mode: 5 }] }];
});
changed('opaque.glb', () => {
    gltf.images[0].bufferView = 8;
});
changed('blend.glb', () => {
    gltf.images[0].bufferView = 8;
    gltf.materials[0].alphaMode = 'BLEND';
});
changed('bad/material.glb', () => {
    gltf.meshes[0].primitives[0].material = 7;
});
changed('bad/beyond.glb', () => {
    gltf.accessors[3].count = 1e6;
});
changed('bad/vertices.glb', () => {
    gltf.accessors[0].count -= 5;
});
changed('bad/ring.glb', () => {
    gltf.nodes[0].children = [0];
});
changed('bad/scene.glb', () => {
    gltf.scenes = [];
});
gltf.samplers = [{ wrapS: 33648, wrapT: 33071 }];
gltf.textures[0].sampler = 0;
glb('mirrored.glb');
delete gltf.textures[0].sampler;
gltf.accessors[0].sparse = {
    count: replaced.length,
    indices: { bufferView: 5, componentType: 5123 },
    values: { bufferView: 6 },
};
glb('sparse.glb');
const draco = 'KHR_draco_mesh_compression';
gltf.meshes[0].primitives[0].extensions = { [draco]: { bufferView: 0, attributes: { POSITION: 0 } } };
gltf.extensionsRequired = [draco];
gltf.buffers[0].uri = `data:application/octet-stream;base64,${bin.toString('base64')}`;
write('draco.gltf', JSON.stringify(gltf));
