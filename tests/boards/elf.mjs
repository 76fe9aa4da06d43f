// What a test needs of a 32-bit little-endian ELF file: symbols, functions by address, and the sizes of sections.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

export function read_elf(path) {
    const bytes = fs.readFileSync(path);
    const at = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
    const u32 = (offset) => at.getUint32(offset, true);
    const u16 = (offset) => at.getUint16(offset, true);
    const text = (offset) => bytes.toString('latin1', offset, bytes.indexOf(0, offset));
    const first = u32(32), size = u16(46), count = u16(48);
    const sections = [];
    for (let i = 0; i < count; i++) {
        const s = first + i * size;
        sections.push({ name: u32(s), type: u32(s + 4), flags: u32(s + 8), address: u32(s + 12), offset: u32(s + 16),
            bytes: u32(s + 20), link: u32(s + 24) });
    }
    const names = sections[u16(50)].offset;
    const bytes_of = {}, symbols = {}, functions = [];
    for (const s of sections) {
        bytes_of[text(names + s.name)] = s.bytes;
        for (let o = s.offset; s.type === 2 && o < s.offset + s.bytes; o += 16) { // SHT_SYMTAB
            const name = text(sections[s.link].offset + u32(o)), value = u32(o + 4);
            symbols[name] = value;
            if ((bytes[o + 12] & 15) === 2) // STT_FUNC; bit 0 of its address says Thumb
                functions.push({ name, at: value - (value & 1) });
        }
    }
    functions.sort((a, b) => a.at - b.at);
    return { symbols, functions, bytes_of, sections };
}
