/* One page out of page/: styles, scripts and the engine in one file. Each module becomes a function that gives what it
 * exports, in the order in which they need each other, so that nothing is imported when the page opens from a file.
 *
 * Usage: node sim/web/bundle.mjs ENGINE.WASM SHOW EMULATOR.JS PAGE.HTML
 * SHOW.bin is the Pico's prebuilt show, SHOW.txt what nm -f sysv says of it.
 *
 * SPDX-License-Identifier: MIT
 */
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';

const folder = resolve(dirname(fileURLToPath(import.meta.url)), 'page');
const [wasm, show, emulator, to] = process.argv.slice(2);
const IMPORT = /^import \{([^}]*)\} from '([^']+)';$/gm;
const EXPORT = /^export (?=(?:async )?(?:function|class|const) ?\*? ?(\w+))/gm;
const numbers = new Map(),
    parts = [];

function add(file) {
    if (numbers.has(file)) return;
    numbers.set(file, null); // modules that need each other would leave a name undefined
    let text = readFileSync(file, 'utf8');
    text = text.replace(IMPORT, (_, names, from) => {
        const other = resolve(dirname(file), from);
        add(other);
        if (numbers.get(other) === null) throw new Error(`${file} and ${other} import each other`);
        return `const {${names.replace(/ as /g, ': ')}} = module${numbers.get(other)};`;
    });
    const exported = [...text.matchAll(EXPORT)].map((m) => m[1]);
    text = text.replace(EXPORT, '');
    const left = /^\s*(import|export)\b(?!\()/m.exec(text);
    if (left) throw new Error(`${file}: an ${left[1]} that is not understood`);
    numbers.set(file, parts.length);
    parts.push(
        `/* ${relative(folder, file)} */\nconst module${parts.length} = (() => {\n${text}\n` +
            `return { ${exported.join(', ')} };\n})();\n`,
    );
}

add(resolve(folder, 'main.js'));
/* Without comments and indents; names stay as they are in sim/web. */
const bare = execFileSync('esbuild', ['--minify-whitespace', '--format=esm', '--target=es2022', '--log-level=error'], {
    input: parts.join('\n'),
    encoding: 'utf8',
});
const script = bare
    .replace(/<\/(script)/gi, '<\\/$1')
    .replace(/<!--/g, '<\\!--');

/* Addresses of what the show holds, by name, those of functions with the bit of Thumb code; and its arena's bytes. */
function symbolsOf(file) {
    const symbols = {};
    let arena = 0;
    for (const line of readFileSync(file, 'utf8').trim().split('\n')) {
        const [name, at, , kind, bytes] = line.split('|').map((word) => word.trim());
        symbols[name] = parseInt(at, 16) | (kind === 'FUNC' ? 1 : 0);
        if (name === 'show_model_arena') arena = parseInt(bytes, 16);
    }
    return { symbols, arena };
}
const head = Buffer.from(JSON.stringify(symbolsOf(`${show}.txt`))),
    length = Buffer.alloc(4);
length.writeUInt32LE(head.length);
/* Compressed, four bytes as five characters: page/wasm.js reads it. A text of 4 n + k bytes has 5 n + k + 1 of them. */
function pack(bytes) {
    const from = deflateRawSync(bytes, { level: 9 }),
        out = [];
    for (let i = 0; i < from.length; i += 4) {
        let word = 0,
            five = '';
        for (let k = 0; k < 4; k++) word = word * 256 + (i + k < from.length ? from[i + k] : 0);
        for (let k = 0; k < 5; k++, word = Math.floor(word / 85)) five = String.fromCharCode(40 + (word % 85)) + five;
        out.push(five.slice(0, Math.min(4, from.length - i) + 1));
    }
    return out.join('').replaceAll('<', '~');
}
const styles = execFileSync('esbuild', ['--loader=css', '--minify-whitespace', '--log-level=error'], {
    input: readFileSync(resolve(folder, 'style.css')),
    encoding: 'utf8',
});
const packed = pack(readFileSync(wasm));
const page = readFileSync(resolve(folder, 'index.html'), 'utf8')
    .replace('/*STYLE*/', () => styles)
    .replace('/*WASM*/', () => packed)
    .replace('/*SHOW*/', () => pack(Buffer.concat([length, head, readFileSync(`${show}.bin`)])))
    .replace('/*EMULATOR*/', () => pack(readFileSync(emulator)))
    .replace('/*SCRIPT*/', () => `\n${script}`);
writeFileSync(to, page);
console.log(`built ${to}: ${page.length} bytes, ${packed.length} of them the engine`);
