// node patch.mjs IN.elf OUT.elf SYMBOL WORD...: a copy of a firmware with other values in a const of 32-bit words.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

import { read_elf } from './elf.mjs';

const [from, to, symbol, ...words] = process.argv.slice(2);
const elf = read_elf(from), address = elf.symbols[symbol];
const section = elf.sections.find((s) => s.address <= address && address + 4 * words.length <= s.address + s.bytes &&
    s.type === 1 && s.flags & 2); // SHT_PROGBITS with SHF_ALLOC
if (address === undefined || !section)
    throw new Error(`${from}: no ${symbol} of ${words.length} words`);
const bytes = fs.readFileSync(from);
words.forEach((word, i) => bytes.writeUInt32LE(Number(word), section.offset + address - section.address + 4 * i));
fs.writeFileSync(to, bytes);
