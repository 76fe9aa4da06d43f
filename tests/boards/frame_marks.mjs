// node frame_marks.mjs STREAM MARKED FRAMES: the stream of a show that wrote a line before its first frame and one
// after its last, as words of `zsim panel --decode`, with a mark after each frame. Frames are alike in words, and begin
// alike.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

const TEXT = 0x1000, FRAME = 0x400, NEWLINE = TEXT | 10;

const [from, to, count] = process.argv.slice(2);
const bytes = fs.readFileSync(from);
const words = Array.from({ length: bytes.length >> 1 }, (_, i) => bytes.readUInt16LE(2 * i));
const first = words.indexOf(NEWLINE) + 1, end = words.findIndex((w, i) => i >= first && w & TEXT);
const size = (end - first) / count;
if (!first || end < 0 || !Number.isInteger(size) || !size)
    throw new Error(`${from}: words ${first} to ${end} are not ${count} frames between two lines`);
const marked = words.slice(0, first);
for (let at = first; at < end; at += size) {
    if (words[at] !== words[first])
        throw new Error(`${from}: a frame begins with word ${words[at]}, the first one with ${words[first]}`);
    marked.push(...words.slice(at, at + size), FRAME);
}
marked.push(...words.slice(end));
fs.writeFileSync(to, Buffer.from(Uint16Array.from(marked).buffer));
