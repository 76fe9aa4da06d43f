// node inside.mjs GLASSxSIZE PICTURExSIZE X Y [GLASS.bin PICTURE.bin]...: is each picture what its glass shows from X,
// Y on, with black around it? RGB565, row by row. Says what is not so; nothing where all is.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

const [glass_size, size, ...at] = process.argv.slice(2, 6);
const [glass_w, glass_h] = glass_size.split('x').map(Number), [w, h] = size.split('x').map(Number);
const [x0, y0] = at.map(Number);

function look(glass_file, file) {
    const glass = fs.readFileSync(glass_file), picture = fs.readFileSync(file);
    if (glass.length !== 2 * glass_w * glass_h || picture.length !== 2 * w * h)
        return `${glass_file} or ${file} is not of its size`;
    let wrong = 0, first = '';
    for (let y = 0; y < glass_h; y++) {
        for (let x = 0; x < glass_w; x++) {
            const inside = x >= x0 && x < x0 + w && y >= y0 && y < y0 + h;
            const wanted = inside ? picture.readUInt16BE(2 * ((y - y0) * w + x - x0)) : 0;
            if (glass.readUInt16BE(2 * (y * glass_w + x)) !== wanted && wrong++ === 0)
                first = `${x}, ${y}`;
        }
    }
    return wrong ? `${glass_file}: ${wrong} pixels differ from ${file} or from black; the first at ${first}` : '';
}

const files = process.argv.slice(6);
for (let i = 0; i < files.length; i += 2) {
    let said;
    try {
        said = look(files[i], files[i + 1]);
    } catch (error) {
        said = `${error}`;
    }
    if (said)
        console.log(said);
}
