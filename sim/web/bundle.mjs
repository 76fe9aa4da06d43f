/* One page out of page/: styles, scripts and the engine in one file. Each module becomes a function that gives what it
 * exports, in the order in which they need each other, so that nothing is imported when the page opens from a file.
 *
 * Usage: node sim/web/bundle.mjs ENGINE.WASM PAGE.HTML
 *
 * SPDX-License-Identifier: MIT
 */
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';

const folder = resolve(dirname(fileURLToPath(import.meta.url)), 'page');
const [wasm, to] = process.argv.slice(2);
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
const script = parts
    .join('\n')
    .replace(/<\/(script)/gi, '<\\/$1')
    .replace(/<!--/g, '<\\!--');
const packed = deflateRawSync(readFileSync(wasm), { level: 9 }).toString('base64');
const page = readFileSync(resolve(folder, 'index.html'), 'utf8')
    .replace('/*STYLE*/', () => readFileSync(resolve(folder, 'style.css'), 'utf8'))
    .replace('/*WASM*/', () => packed)
    .replace('/*SCRIPT*/', () => `\n${script}`);
writeFileSync(to, page);
console.log(`built ${to}: ${page.length} bytes, ${packed.length} of them the engine`);
