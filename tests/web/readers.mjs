// What the page's readers (sim/web/page/read_*.js) take from a file is what zsim takes: the same pixels.
// Usage: node tests/web/readers.mjs ENGINE.WASM ZSIM WORKDIR    from the repository's top
//
// SPDX-License-Identifier: MIT
import {spawnSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';

import {createEngine} from '../../sim/web/engine.js';
import {readModel} from '../../sim/web/page/models.js';

import {readPng, writePng} from './png.mjs';

const [wasm, zsim, work] = process.argv.slice(2);
const engine = await createEngine(readFileSync(wasm));
let failed = 0;

// A browser's pictures
globalThis.createImageBitmap = async (blob) => readPng(Buffer.from(await blob.arrayBuffer()));
globalThis.OffscreenCanvas = class {
    getContext() {
        let rgb;
        return {
            drawImage: (image) => { rgb = image.rgb; },
            getImageData: () => ({data: Uint8ClampedArray.from({length: rgb.length / 3 * 4},
                                      (_, i) => (i % 4 === 3 ? 255 : rgb[(i >> 2) * 3 + i % 4]))}),
        };
    }
};
const picture = Buffer.from(writePng(4, 4, Uint8Array.from({length: 48}, (_, i) => 85 * (i * 7 % 4))));

const bytes = (name, data) => ({name, arrayBuffer: async () => Uint8Array.from(Buffer.from(data)).buffer});
/** A model of these files, the first of which is the model itself, drawn by both. */
async function same(name, files) {
    const given = Object.entries(files).map(([ file, text ]) => {
        writeFileSync(`${work}/${file}`, text);
        return bytes(file, text);
    });
    const wrong = [];
    try {
        const answer = engine.setModel(await readModel(given));
        if (answer.error) wrong.push(answer.error);
        for (const shade of [ undefined, 'flat' ]) {
            const made = spawnSync(zsim, [ 'render', `${work}/${given[0].name}`, '--background=102040', '--out',
                `${work}/z.png`, ...(shade ? [ `--shade=${shade}` ] : []) ], {encoding: 'utf8'});
            const none = Object.fromEntries(engine.options().map((one) => [one.name, undefined]));
            const taken = engine.configure({...none, background: '102040', shade});
            if (made.status !== 0 || taken.error) {
                wrong.push(made.stderr + taken.error);
                continue;
            }
            engine.render();
            const {width, height} = engine.pictureSize(), ours = new Uint8Array(4 * width * height),
                  theirs = readPng(readFileSync(`${work}/z.png`)).rgb;
            engine.rgba(ours);
            let n = 0, drawn = 0;
            for (let i = 0; i < width * height; i++) {
                n += [ 0, 1, 2 ].some((k) => ours[4 * i + k] !== theirs[3 * i + k]);
                drawn += [ 0, 1, 2 ].some((k) => theirs[3 * i + k] !== theirs[k]);
            }
            if (n > 0 || drawn < 1000) wrong.push(`${shade ?? 'as it is'}: ${n} pixels differ, ${drawn} are drawn`);
        }
    } catch (error) {
        wrong.push(String(error.stack).split('\n').slice(0, 3).join(' '));
    }
    console.log(wrong.length === 0 ? `ok web_reads_${name}` : `FAILED web_reads_${name}: ${wrong.join('; ')}`);
    failed |= wrong.length > 0;
}

// ---- OBJ and MTL

const points = 'v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 -2\nv 2 0 -2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n';
const faces = [ 'f 1/1 2/2 3/3 4/4', 'f 5/1 6/2 2/3 1/4', 'f 4 3 6 5' ];
const red = 'newmtl red\nKd 1 0 0\n', blue = 'newmtl blue\nKd 0 0 1\n';
await same('a_comment_that_ends_in_a_backslash',
    {'comment.obj': `# of C:\\models\\\n${points}${faces[0]} # and C:\\\n${faces[1]}\n`});
await same('a_material_with_a_hash', {
    'hash.obj': `mtllib hash.mtl\n${points}usemtl Material #25\n${faces.join('\n')}\n`,
    'hash.mtl': 'newmtl Material #25\nKd 1 0 0\n',
});
await same('names_that_end_in_a_backslash', {
    'backslash.obj': `mtllib backslash.mtl\n${points}usemtl red\\\n${faces[0]}\nusemtl C:\\red\\\r\n${faces[1]}\n` +
        'usemtl red\\\n',
    'backslash.mtl': 'newmtl red\\\nKd 1 0 0\nnewmtl red\nKd 0 1 0\nnewmtl C:\\red\\\nKd 0 0 1\n',
});
await same('several_material_files', {
    'several.obj': `usemtl red\nmtllib several.mtl other.mtl\n${points}${faces[0]}\nusemtl blue\n${faces[1]}\n`,
    'several.mtl': red,
    'other.mtl': blue,
});
await same('carriage_returns_and_small_letters', {
    'small.obj': `mtllib small.mtl\n${points}usemtl red\n${faces.join('\n')}\n`,
    'small.mtl': 'newmtl red\rkd 1 0 0\r',
});
/** What the page says that it leaves out of a model of these files. */
async function losses(name, files, wanted) {
    const model = await readModel(Object.entries(files).map(([ file, data ]) => bytes(file, data)));
    const answer = engine.setModel(model), said = (answer.losses ?? [ answer.error ]).join('; ');
    console.log(said === wanted ? `ok web_${name}` : `FAILED web_${name}: ${said}`);
    failed |= said !== wanted;
}
await losses('names_curves_and_surfaces',
    {'curves.obj': `${points}${faces[0]}\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\nsurf 0 1 0 1 1 2 3 4\n`},
    'curves and surfaces are left out');
for (const map of [ 'map_d other.png', 'map_Bump bump.png', 'norm normal.png' ])
    await losses(`names_${map.split(' ')[0]}`, {
        'mask.obj': `mtllib mask.mtl\n${points}usemtl t\n${faces[0]}\n`,
        'mask.mtl': `newmtl t\nmap_Kd mask.png\n${map}\n`,
        'mask.png': picture,
    }, 'maps other than map_Kd are left out');
for (const [ name, options ] of [ [ 'moved', '-o 0.25 0 -S 2 3 1 -bm 0.5' ], [ 'clamped', '-clamp on -s 1.5' ],
         [ 'with_more_options', '-imfchan r -mm 0 1 -t 1 1 1 -cc off -type cube_top -o 0.5 0.25 0' ] ])
    await same(`a_texture_${name}`, {
        [`${name}.obj`]: `mtllib ${name}.mtl\n${points}usemtl t\n${faces[0]}\nusemtl none\n${faces[1]}\n`,
        [`${name}.mtl`]: `newmtl t\nmap_Kd ${options} ${name}.png\n`,
        [`${name}.png`]: picture,
    });
for (const [ name, words ] of Object.entries({
         faint_highlights: 'Kd .3 .3 .6\nKs .05 .05 .05\nNs 30', wide_highlights: 'Kd .3 .3 .6\nKs .5 .5 .5\nNs .5',
         bright_highlights: 'Kd .3 .3 .3\nKs 2 1 0\nNs 5', grey_highlights: 'Kd .3 .3 .3\nKs .4\nNs 5 # wide',
         no_colour: 'illum 2', a_colour_of_one_number: 'Kd 0.5', what_is_no_number: 'Kd 0.5 nan 0.5',
     }))
    await same(name, {
        [`${name}.obj`]: `mtllib ${name}.mtl\nmg 1 2\n${points}usemtl m\n${faces.join('\n')}\n`,
        [`${name}.mtl`]: `newmtl m\n${words}\n`,
    });
for (const [ name, file, kd ] of [ [ 'blanks', 'my picture.png', '1 1 1' ], [ 'a_percent_sign', '100%.png', '1 1 1' ],
         [ 'a_factor_beyond_1', 'plain.png', '2 2 2' ] ])
    await same(`a_texture_with_${name}`, {
        [`${name}.obj`]: `mtllib ${name}.mtl\n${points}usemtl t\n${faces.slice(0, 2).join('\n')}\n`,
        [`${name}.mtl`]: `newmtl t\nKd ${kd}\nmap_Kd -clamp off ${file}\n`,
        [file]: picture,
    });

// ---- PLY: colours of each type, positions of another precision, other line ends

function ply(type, colors, more = {}) {
    const {position = 'float', names = [ 'red', 'green', 'blue' ], by = 1, end = '\n', face = ''} = more;
    const corners = [ [ 0.1, 0, 0 ], [ 2, 0.1, 0 ], [ 2.3, 2.1, 1 ], [ 0, 2, 0.7 ] ];
    return [
        'ply', 'format ascii 1.0', 'element vertex 4',
        ...[ 'x', 'y', 'z' ].map((name) => `property ${position} ${name}`),
        ...names.map((name) => `property ${type} ${name}`), 'element face 2', 'property list uchar int vertex_indices',
        ...(face ? [ face ] : []), 'end_header',
        ...corners.map((p, i) => [...p.map((c) => by * c), ...names.map((_, k) => colors[(i + k) % 3]) ].join(' ')),
        ...[ '3 0 1 2', '3 0 2 3' ].map((row) => row + (face ? ' 7' : '')), '',
    ].join(end);
}
const types = {char: [ -100, 0, 120 ], uchar: [ 0, 100, 255 ], short: [ -30000, 0, 32000 ], ushort: [ 0, 30000, 65535 ],
    int: [ -100, 30, 120 ], uint: [ 0, 30000, 65535 ], float: [ 0, 0.5, 1 ], double: [ 0.1, 0.5, 1 ]};
for (const [ type, colors ] of Object.entries(types))
    await same(`colours_of_${type}`, {[`${type}.ply`]: ply(type, colors)});
await same('colours_named_r_g_b', {'rgb.ply': ply('uchar', types.uchar, {names: [ 'r', 'g', 'b' ]})});
for (const names of [ [ 'red' ], [ 'green' ], [ 'alpha' ], [ 'r', 'red', 'b', 'blue', 'green', 'g' ] ])
    await same(`colours_of_${names.join('_')}`, {'some.ply': ply('uchar', types.uchar, {names})});
await same('normals_of_one_number', {'nz.ply': ply('float', types.float, {names: [ 'nz' ]})});
await same('carriage_returns_in_a_ply', {'cr.ply': ply('uchar', types.uchar, {end: '\r'})});
for (const [ name, second ] of [ [ 'corners', '6 1 1 0 0 1 0' ], [ 'some_corners', '4 0 0 1 1' ] ])
    await same(`texture_coordinates_of_${name}`, {
        [`${name}.ply`]: ply('float', [], {names: [], face: 'property list uchar float texcoord'})
            .replace('element vertex', 'comment TextureFile a picture.png\nelement vertex')
            .replace('0 1 2 7', '0 1 2 6 0 0 1 0 1 1').replace('0 2 3 7', `0 2 3 ${second}`),
        'a picture.png': picture,
    });
await same('both_line_ends_in_a_ply', {'crlf.ply': ply('uchar', types.uchar, {end: '\r\n'})});
await same('positions_of_double', {'double.ply': ply('uchar', types.uchar, {position: 'double', by: 1e8 + 1 / 3})});
const others = {
    'colours of the name diffuse_red are left out': {names: [ 'diffuse_red', 'diffuse_green', 'diffuse_blue' ]},
    'colours of faces are left out': {face: 'property uchar red'},
};
for (const [ loss, what ] of Object.entries(others))
    await losses(`names_${loss.replaceAll(' ', '_')}`, {'other.ply': ply('uchar', types.uchar, what)}, loss);
const named = ply('uchar', [], {names: []}).replace('element vertex',
    'comment TextureFile no such.png\ncomment TextureFile picture.png\nelement vertex');
await losses('names_further_textures', {'two.ply': named, 'picture.png': picture},
    'textures beside the last that the file names are left out');
const alphas = {names: [ 'red', 'green', 'blue', 'alpha' ]}, clear = 'alpha of vertex colours is left out';
await losses('names_alpha_of_vertices', {'alpha.ply': ply('uchar', types.uchar, alphas)}, clear);
await losses('names_no_alpha_that_is_full', {'full.ply': ply('uchar', [ 255, 255, 255 ], alphas)}, '');
await losses('names_no_alpha_that_is_none', {'none.ply': ply('uchar', [ 0, 0, 0 ], alphas)}, '');
const foo = 'element foo 2\nproperty list uchar int bar\n', strips = foo.replaceAll('foo 2', 'tristrips 1');
const plain = ply('uchar', types.uchar);
await same('elements_of_other_names', {'foo.ply': plain.replace('element vertex', `${foo}element vertex`)
    .replace('element face', `${foo.replaceAll('foo', 'more')}element face`)
    .replace('end_header\n', 'end_header\n2 7 8\n1 9\n').replace('3 0 1 2\n', '3 1 2 3\n1 9\n3 0 1 2\n')});
await losses('names_triangle_strips', {'strips.ply': plain.replace('element face', `${strips}element face`)
    .replace('3 0 1 2\n', '4 0 1 2 3\n3 0 1 2\n')}, 'triangle strips are left out');

// ---- STL: colours of faces, facets of four vertices

function stl(head, words) {
    const facets = [ [ 0, 0, 0, 2, 0, 0, 2, 2, 1 ], [ 0, 0, 0, 2, 2, 1, 0, 2, 0 ], [ 0, 0, 0, 0, 2, 0, 0, 1, -2 ] ];
    const out = Buffer.alloc(84 + 50 * facets.length);
    out.write(head, 0, 'latin1');
    out.writeUInt32LE(facets.length, 80);
    facets.forEach((facet, t) => {
        facet.forEach((c, k) => out.writeFloatLE(c, 84 + 50 * t + 12 + 4 * k));
        out.writeUInt16LE(words[t], 84 + 50 * t + 48);
    });
    return out;
}
const words = [ 0x801f, 0x7c00, 0xa94a ];
await same('colours_of_an_stl', {'words.stl': stl('colours', words)});
await same('no_colours_of_an_stl', {'plain.stl': stl('COLOR=\x10\x80\xff\xff', [ 1, 2, 3 ])});
for (const alpha of [ '\xff', '\x80' ])
    await same(`colours_of_magics_${alpha.charCodeAt(0)}`, {'magics.stl': stl(`COLOR=\x10\x80\xff${alpha}`, words)});
await same('colours_of_magics_at_the_end', {'end.stl': stl(`${' '.repeat(74)}COLOR=`, words)});
await losses('names_colours_of_magics', {'magics.stl': stl('COLOR=', words)},
    'colours of Materialise Magics are in another form');
const four = `solid x\nfacet normal 0 0 1\nouter loop\n${
    [ '0 0 0', '2 0 0', '2 2 1', '0 2 0' ].map((p) => `vertex ${p}\n`).join('')}endloop\nendfacet\nendsolid x\n`;
await same('facets_of_four_vertices', {'four.stl': four});
const facet = (v) => `facet normal 0 0 1\nouter loop\n${v.map((p) => `vertex ${p}\n`).join('')}endloop\nendfacet\n`;
const halves = [ facet([ '0 0 0', '2 0 0', '2 2 1' ]), facet([ '0 0 0', '2 2 1', '0 2 0' ]) ];
for (const [ name, text ] of Object.entries({
         capitals: `solid x\n${halves.join('')}endsolid x\n`.toUpperCase(),
         a_comment_between_solids: `solid x\n${halves[0]}endsolid x\n; a comment\nSOLID Facet\n${halves[1]}endsolid`,
         some_capitals: `solid x\n${halves[0]}${halves[1].toUpperCase()}endsolid x\n`,
         its_end_on_the_last_line: `solid x\n${halves.join('').trimEnd()} endsolid x\n`,
         one_line: `solid x ${halves.join('')}endsolid x`.replace(/\n/g, ' '),
         a_line_a_facet: `solid x\n${halves.map((h) => `${h.replace(/\n/g, ' ')}\n`).join('')}endsolid x`.toUpperCase(),
         two_words_at_the_end: `solid x\n${halves.join('')}end solid x\n`,
     }))
    await same(`an_stl_with_${name}`, {[`${name}.stl`]: text});
await losses('names_facets_of_four_vertices', {'four.stl': four}, 'vertices of facets beyond the third are left out');

// ---- glTF: a square of two triangles that stands across, as two meshes

const floats = (...v) => Buffer.from(Float32Array.from(v).buffer);
const square = floats(0, 0, 0, 2, 0, 0, 2, 2, 1, 0, 0, 0, 2, 2, 1, 0, 2, 1),
      across = floats(0, 0, 0, 0, 0, 2, 0, 2, 2, 0, 0, 0, 0, 2, 2, 0, 2, 0),
      uv = floats(0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0), uv1 = floats(0, .5, .5, .5, .5, 0, 0, .5, .5, 0, 0, 0),
      white = floats(...Array.from({length: 18}, (_, i) => (i % 3 === 1 ? 0.5 : 1)));
function gltf(materials, attributes = {}) {
    const parts = [ square, uv, uv1, white, across ];
    const accessors = parts.map((part, i) => ({
        bufferView: i, componentType: 5126, count: 6, type: i === 1 || i === 2 ? 'VEC2' : 'VEC3',
        ...(i === 0 ? {min: [ 0, 0, 0 ], max: [ 2, 2, 1 ]} : i === 4 ? {min: [ 0, 0, 0 ], max: [ 0, 2, 2 ]} : {}),
    }));
    let at = 0;
    const views = parts.map((part) => ({buffer: 0, byteOffset: (at += part.length) - part.length,
                                           byteLength: part.length}));
    const uri = (type, bytes) => `data:${type};base64,${Buffer.from(bytes).toString('base64')}`;
    return JSON.stringify({
        asset: {version: '2.0'}, scene: 0, scenes: [ {nodes: [ 0, 1 ]} ], nodes: [ {mesh: 0}, {mesh: 1} ],
        meshes: [
            {primitives: [ {attributes: {POSITION: 0, TEXCOORD_0: 1, TEXCOORD_1: 2, ...attributes}, material: 0} ]},
            {primitives: [ {attributes: {POSITION: 4}, material: 1} ]},
        ],
        materials: [ materials, {doubleSided: true, pbrMetallicRoughness: {baseColorFactor: [ 1, 0, 0, 1 ]}} ],
        images: [ {uri: uri('image/png', picture)} ], textures: [ {source: 0} ],
        extensionsUsed: [ 'KHR_texture_transform' ],
        accessors, bufferViews: views, buffers: [ {uri: uri('application/octet-stream', Buffer.concat(parts)),
                                                     byteLength: at} ],
    });
}
const texture = {index: 0};
for (const [ name, material, attributes ] of [
         [ 'emission_of_a_texture', {emissiveFactor: [ 1, 1, 1 ], emissiveTexture: texture} ],
         [ 'emission_and_a_dark_colour', {emissiveFactor: [ .2, .01, .001 ],
                                             pbrMetallicRoughness: {baseColorFactor: [ .001, .2, .004, 1 ]}} ],
         [ 'a_colour_that_is_black_when_it_is_light', {pbrMetallicRoughness: {baseColorFactor: [ .0005, 0, .0001, 1 ]}},
             {COLOR_0: 3} ],
         [ 'unlit_factor_of_a_texture', {extensions: {KHR_materials_unlit: {}},
             pbrMetallicRoughness: {baseColorTexture: {index: 0}, baseColorFactor: [ .2, .5, .9, 1 ]}} ],
         [ 'roughness', {pbrMetallicRoughness: {baseColorFactor: [ .8, .5, .2, 1 ], roughnessFactor: 0.4,
                            metallicFactor: 0.5}} ],
         [ 'a_texture_transform', {pbrMetallicRoughness: {baseColorTexture: {...texture, extensions:
              {KHR_texture_transform: {offset: [ .25, .5 ], scale: [ .5, .75 ], rotation: 0.5}}}}} ],
         [ 'the_second_coordinates', {pbrMetallicRoughness: {baseColorTexture: {...texture, texCoord: 1}}} ],
         [ 'coordinates_of_an_extension', {pbrMetallicRoughness: {baseColorTexture: {...texture, extensions:
              {KHR_texture_transform: {texCoord: 1, scale: [ 2, 2 ]}}}}} ],
         [ 'colours_of_one_mesh', {}, {COLOR_0: 3} ],
         [ 'colours_times_a_colour', {pbrMetallicRoughness: {baseColorFactor: [ .5, .9, .2, 1 ]}}, {COLOR_0: 3} ],
         [ 'a_metal_with_a_texture', {pbrMetallicRoughness: {baseColorTexture: texture, roughnessFactor: 0.8,
             baseColorFactor: [ 1, .4, .3, 1 ]}} ],
         [ 'colours_and_black', {pbrMetallicRoughness: {baseColorFactor: [ 0, 0, 0, 1 ]}}, {COLOR_0: 3} ],
     ])
    await same(name, {[`${name}.gltf`]: gltf({doubleSided: true, ...material}, attributes)});
{
    // The first mesh, two faces of which meet in an edge, has no normals beside one that has, or those of its faces
    const model = JSON.parse(gltf({doubleSided: true, pbrMetallicRoughness: {baseColorTexture: texture}}));
    const [ bent, other ] = model.meshes.map((mesh) => mesh.primitives[0].attributes);
    const lower = [ 0, -1, 2 ].map((c) => c / Math.sqrt(5)), upper = [ -2, 1, 2 ].map((c) => c / 3);
    const data = floats(0, 0, 0, 2, 0, 0, 2, 2, 1, 0, 0, 0, 2, 2, 1, 0, 2, -1, ...lower, ...lower, ...lower, ...upper,
        ...upper, ...upper);
    model.buffers.push({uri: `data:application/octet-stream;base64,${data.toString('base64')}`, byteLength: 144});
    for (const byteOffset of [ 0, 72 ]) model.bufferViews.push({buffer: 1, byteOffset, byteLength: 72});
    bent.POSITION = model.accessors.push({...model.accessors[0], bufferView: 5, min: [ 0, 0, -1 ]}) - 1;
    other.NORMAL = 4;
    await same('faces_without_normals_beside_others', {'some.gltf': JSON.stringify(model)});
    bent.NORMAL = model.accessors.push({bufferView: 6, componentType: 5126, count: 6, type: 'VEC3'}) - 1;
    await same('faces_with_their_own_normals', {'all.gltf': JSON.stringify(model)});
    const pictures = [ 'some', 'all' ].map((file) => {
        spawnSync(zsim, [ 'render', `${work}/${file}.gltf`, '--out', `${work}/z.png` ]);
        return readFileSync(`${work}/z.png`);
    });
    const right = pictures[0].equals(pictures[1]);
    console.log(right ? 'ok web_flat_beside_smooth' : 'FAILED web_flat_beside_smooth: zsim draws them another way');
    failed |= !right;
}
const glossy = 'KHR_materials_pbrSpecularGlossiness';
for (const [ name, says ] of [ [ 'diffuse', {diffuseFactor: [ .2, .8, .3, 1 ]} ],
         [ 'diffuse_texture', {diffuseTexture: texture} ] ]) {
    const model = JSON.parse(gltf({doubleSided: true, extensions: {[glossy]: says}}));
    await same(`an_extension_that_is_not_used_of_a_${name}`, {[`${name}_plain.gltf`]: JSON.stringify(model)});
    model.extensionsUsed.push(glossy);
    await same(`specular_glossiness_of_a_${name}`, {[`${name}.gltf`]: JSON.stringify(model)});
}
for (const [ name, Type, componentType ] of [ [ 'floats', Float32Array, 5126 ], [ 'shorts', Int16Array, 5122 ] ]) {
    // positions that are replaced, where something stands between the others
    const model = JSON.parse(gltf({doubleSided: true})), at = new Float32Array(square.buffer, square.byteOffset, 18);
    const rows = Type.from({length: 24}, (_, i) => (i % 4 < 3 && i >> 2 !== 2 ? at[3 * (i >> 2) + i % 4] : 7));
    const parts = [ rows, Uint8Array.of(2, 0, 0, 0), Type.of(2, 2, 1) ].map((part) => Buffer.from(part.buffer));
    const data = Buffer.concat(parts);
    model.buffers.push({uri: `data:application/octet-stream;base64,${data.toString('base64')}`,
        byteLength: data.length});
    for (const [ i, part ] of parts.entries())
        model.bufferViews.push({buffer: 1, byteOffset: Buffer.concat(parts.slice(0, i)).length, byteLength: part.length,
                                   ...(i === 0 ? {byteStride: 4 * Type.BYTES_PER_ELEMENT} : {})});
    Object.assign(model.accessors[0], {bufferView: 5, componentType, sparse: {count: 1,
        indices: {bufferView: 6, componentType: 5121}, values: {bufferView: 7}}});
    if (componentType !== 5126) model.extensionsRequired = [ 'KHR_mesh_quantization' ];
    await same(`positions_that_are_replaced_of_${name}`, {[`replaced_${name}.gltf`]: JSON.stringify(model)});
}
{ // normals of bytes, of which -128 is -1, too: where highlights are is seen best
    const model = JSON.parse(gltf({doubleSided: true, pbrMetallicRoughness: {roughnessFactor: 0.3}}, {NORMAL: 5}));
    const normals = Int8Array.from({length: 24}, (_, i) => [ -128, 40, 90, 0 ][i % 4] * (i < 12 ? 1 : -0.5));
    model.buffers.push({uri: `data:application/octet-stream;base64,${Buffer.from(normals.buffer).toString('base64')}`,
        byteLength: 24});
    model.bufferViews.push({buffer: 1, byteLength: 24, byteStride: 4});
    model.accessors.push({bufferView: 5, componentType: 5120, normalized: true, count: 6, type: 'VEC3'});
    model.extensionsUsed.push('KHR_mesh_quantization');
    model.extensionsRequired = [ 'KHR_mesh_quantization' ];
    await same('normals_of_bytes', {'bytes.gltf': JSON.stringify(model)});
}
{
    const textured = JSON.parse(gltf({pbrMetallicRoughness: {baseColorTexture: {index: 0}}}));
    delete textured.materials[1].doubleSided;
    const file = (image, source = 0) =>
        JSON.stringify({...textured, images: [ image ], textures: [ {source: source ?? undefined} ]});
    const a = 'a picture that is not there', plain = ': its faces are plain';
    await losses('names_pictures_that_are_missing', {'missing.gltf': file({uri: `${a}.png`})},
        `${a}.png was not given: drop it with the model`);
    await losses('names_textures_without_pictures', {'none.gltf': file({}, null)},
        `texture 1 names no picture that is read${plain}`);
    await losses('names_pictures_that_are_none', {'broken.gltf': file({uri: 'data:image/png;base64,QUJD'})},
        `texture 1 is no picture that this browser reads${plain}`);
}
{
    const model = JSON.parse(gltf({}, {COLOR_0: 5}));
    model.accessors.push({bufferView: 0, componentType: 5121, normalized: true, count: 6, type: 'VEC4'});
    delete model.materials[1].doubleSided;
    await losses('names_alpha_of_vertices_of_glTF', {'alpha.gltf': JSON.stringify(model)}, clear);
}
{
    const said = await readModel([ bytes('a.xyz', 'x') ]).then(() => '', (error) => error.message);
    const right = said === 'a.xyz: is of no format that is known by its name; this page reads OBJ, PLY, STL and ' +
        'glTF: export the model as one of these'; // as zsim says of what it reads
    console.log(right ? 'ok web_refuses_unknown_formats' : `FAILED web_refuses_unknown_formats: ${said}`);
    failed |= !right;
}
{
    const empty = JSON.parse(gltf({}));
    empty.scenes = [ {} ];
    const given = [ bytes('empty.gltf', JSON.stringify(empty)) ];
    const said = await readModel(given).then(() => '', (error) => error.message);
    const right = said === 'empty.gltf: no faces in it; zsim draws polygons'; // as zsim says of one with []
    console.log(right ? 'ok web_refuses_scenes_without_nodes' : `FAILED web_refuses_scenes_without_nodes: ${said}`);
    failed |= !right;
}
process.exit(failed);
