// node profile.mjs ELF N [FUNCTION] <LOG
//
// LOG is what QEMU says of one frame with -d in_asm,exec,nochain: each translated block's instructions, then the first
// address of each block that runs. Prints the N functions that take most instructions from zs_render on, "function NAME
// INSTRUCTIONS" a line, callees not counted, and "total". FUNCTION: how often each of its instructions ran, "at ADDRESS
// COUNT" a line.
//
// SPDX-License-Identifier: MIT
import { read_elf } from './elf.mjs';

const [path, count, only] = process.argv.slice(2);
const { functions, symbols } = read_elf(path);
const begin = symbols.zs_render - (symbols.zs_render & 1);
const blocks = new Map(); // by first address: { at: addresses, runs }
let block = null, started = false;

function line(text) {
    if (text.startsWith('Trace ')) {
        const first = parseInt(text.slice(text.indexOf('/') + 1), 16);
        started ||= first === begin;
        const found = blocks.get(first);
        if (started && found)
            found.runs++;
    } else if (text.startsWith('IN:')) {
        block = [];
    } else if (block && text.startsWith('0x')) {
        const at = parseInt(text, 16);
        if (!block.length && !blocks.has(at))
            blocks.set(at, { at: block, runs: 0 });
        block.push(at);
    } else if (!text) {
        block = null;
    }
}

let rest = '';
for await (const chunk of process.stdin) {
    const lines = (rest + chunk.toString('latin1')).split('\n');
    rest = lines.pop();
    lines.forEach(line);
}

const runs = new Map(); // by address
for (const { at, runs: n } of blocks.values())
    for (const a of n ? at : [])
        runs.set(a, (runs.get(a) ?? 0) + n);
const sums = new Map();
let k = 0, total = 0;
for (const [at, n] of [...runs].sort((a, b) => a[0] - b[0])) {
    while (k + 1 < functions.length && functions[k + 1].at <= at)
        k++;
    const { name } = functions[k];
    sums.set(name, (sums.get(name) ?? 0) + n);
    total += n;
    if (name === only)
        console.log('at', at.toString(16), n);
}
for (const [name, n] of [...sums].sort((a, b) => b[1] - a[1]).slice(0, Number(count)))
    console.log('function', name, n);
console.log('total', total);
