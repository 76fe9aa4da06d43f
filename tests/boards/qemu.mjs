// A machine of QEMU's: its serial port, what its screen shows, and stops at functions of the firmware.
//
// node qemu.mjs STEM [--elf FILE --break FUNCTION --stops N] [--until PATTERN] [--zoom N [--rotate DEGREES]]
//                    [--seconds N] -- QEMU ARGUMENTS...
//   runs QEMU; takes a screendump at each of N calls of FUNCTION (STEM_0, STEM_1 ...) and one (STEM_end) when a line on
//   the first serial port matches PATTERN; then ends it. Writes STEM_*.ppm and .png; with --zoom, STEM_*.bin: greys of
//   0 to 15, a byte a pixel, where the screen shows each N times as wide and high, as who sees it has turned it: the
//   picture lies turned clockwise on the screen by DEGREES (0). STEM.txt is the serial port's text, STEM.err what QEMU
//   complained of. Longer than --seconds (60) is a failure.
//
// SPDX-License-Identifier: MIT
import child_process from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

import { read_elf } from './elf.mjs';

const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// A socket that QEMU listens on soon, as long as it runs.
async function connect(file, child) {
    for (;;) {
        if (child.exitCode !== null || child.signalCode !== null || !child.pid)
            return new Promise(() => {}); // who waits for this is told of its end
        const socket = net.connect(file);
        const error = await new Promise((done) => {
            socket.once('connect', () => done(null));
            socket.once('error', done);
        });
        if (!error)
            return socket;
        await pause(20);
    }
}

// What arrives, cut into messages: take(text) returns [message, rest] or nothing.
function messages(socket, take) {
    const waiting = [], ready = [];
    let text = '';
    socket.setEncoding('latin1').on('data', (data) => {
        text += data;
        for (let got; (got = take(text));) {
            text = got[1];
            if (waiting.length)
                waiting.shift()(got[0]);
            else
                ready.push(got[0]);
        }
    });
    return () => new Promise((done) => (ready.length ? done(ready.shift()) : waiting.push(done)));
}

// QEMU, stopped before the first instruction.
export class Machine {
    static async start(command, args, seconds) {
        const m = new Machine();
        m.folder = fs.mkdtempSync(path.join(os.tmpdir(), 'qemu-'));
        const qmp = path.join(m.folder, 'qmp'), gdb = path.join(m.folder, 'gdb');
        m.serial = m.complaints = '';
        m.child = child_process.spawn(command, [...args, '-S', '-display', 'none', '-monitor', 'none',
            '-serial', 'stdio', '-qmp', `unix:${qmp},server=on,wait=off`, '-gdb', `unix:${gdb},server=on,wait=off`]);
        m.child.stdin.end();
        m.child.stdout.setEncoding('latin1').on('data', (text) => { m.serial += text; });
        m.child.stderr.setEncoding('utf8').on('data', (text) => { m.complaints += text; });
        m.ended = new Promise((done) => m.child.on('close', done).on('error', done));
        m.failed = new Promise((_, fail) => {
            const last = () => JSON.stringify(m.serial.slice(-80));
            m.timer = setTimeout(() => fail(new Error(`not done after ${seconds} s; its text ends ${last()}`)),
                seconds * 1000);
            m.ended.then((how) => fail(new Error(`QEMU ended (${how}): ${m.complaints.trim()}`)));
        });
        m.failed.catch(() => {});
        try {
            await m.or_failed(m.connect_to(qmp, gdb));
        } catch (error) {
            await m.end();
            throw error;
        }
        return m;
    }

    or_failed(promise) {
        return Promise.race([promise, this.failed]);
    }

    async connect_to(qmp, gdb) {
        this.qmp = await connect(qmp, this.child);
        this.from_qmp = messages(this.qmp, (text) => {
            const end = text.indexOf('\n');
            return end < 0 ? null : [JSON.parse(text.slice(0, end)), text.slice(end + 1)];
        });
        this.gdb = await connect(gdb, this.child);
        this.from_gdb = messages(this.gdb, (text) => {
            const found = /^[^$]*\$([^#]*)#../.exec(text);
            return found ? [found[1], text.slice(found[0].length)] : null;
        });
        await this.from_qmp(); // its greeting
        await this.ask('qmp_capabilities');
    }

    async ask(execute, args = {}) {
        this.qmp.write(JSON.stringify({ execute, arguments: args }));
        for (;;) {
            const said = await this.or_failed(this.from_qmp());
            if (said.error)
                throw new Error(`${execute}: ${said.error.desc}`);
            if ('return' in said)
                return said.return;
        }
    }

    // A packet of GDB's remote protocol, acknowledged, and the answer to it.
    async remote(packet) {
        let sum = 0;
        for (const c of packet)
            sum += c.charCodeAt(0);
        this.gdb.write(`$${packet}#${(sum & 255).toString(16).padStart(2, '0')}`);
        const answer = await this.or_failed(this.from_gdb());
        this.gdb.write('+');
        return answer;
    }

    // Run to the next call of a function at this address; not the one where it stands.
    async run_to(address) {
        await this.remote('s');
        await this.remote(`Z0,${address.toString(16)},2`);
        const why = await this.remote('c');
        await this.remote(`z0,${address.toString(16)},2`);
        if (!/^[TS]05/.test(why))
            throw new Error(`stopped by ${why}`);
    }

    // Go on, until a line of the serial port's matches.
    async run_until(pattern) {
        this.gdb.write('$c#63');
        const line = new RegExp(`${pattern}.*\n`, 'm');
        while (!line.test(this.serial))
            await this.or_failed(pause(20));
        await this.ask('stop');
    }

    async screendump(stem, zoom, rotate) {
        await this.ask('screendump', { filename: `${stem}.png`, format: 'png' });
        await this.ask('screendump', { filename: `${stem}.ppm` });
        if (zoom)
            fs.writeFileSync(`${stem}.bin`, upright(greys(fs.readFileSync(`${stem}.ppm`), zoom), rotate));
    }

    async end() {
        clearTimeout(this.timer);
        if (this.child.pid) // of one that was not found, kill would mean this process's group
            this.child.kill('SIGKILL');
        await this.ended;
        fs.rmSync(this.folder, { recursive: true, force: true });
    }
}

// Levels of 0 to 15, rows of them, of a grey picture (PPM) that shows each pixel zoom times as wide and high.
function greys(ppm, zoom) {
    const head = /^P6\s(\d+)\s(\d+)\s255\s/.exec(ppm.toString('latin1', 0, 40));
    const w = Number(head[1]), h = Number(head[2]), rows = [];
    for (let y = 0; y < h; y++)
        for (let x = 0; x < w; x++) {
            const at = head[0].length + 3 * (y * w + x), level = ppm[at] / 17;
            const row = rows[Math.floor(y / zoom)] ??= [], first = row[Math.floor(x / zoom)] ??= level;
            if (level !== first || !Number.isInteger(level) || ppm[at + 1] !== ppm[at] || ppm[at + 2] !== ppm[at])
                throw new Error(`${x}, ${y} of ${w}x${h}: not one of 16 greys, each ${zoom} times as wide and high`);
        }
    return rows;
}

// Its bytes, turned back.
function upright(rows, degrees) {
    for (let turned = degrees; turned; turned -= 90)
        rows = rows[0].map((_, x) => rows.map((row) => row[row.length - 1 - x]));
    return Buffer.from(rows.flat());
}

async function main() {
    const split = process.argv.indexOf('--'), [command, ...args] = process.argv.slice(split + 1);
    const { values: v, positionals: [stem] } = parseArgs({
        args: process.argv.slice(2, split), allowPositionals: true,
        options: { elf: { type: 'string' }, break: { type: 'string' }, stops: { type: 'string', default: '0' },
            until: { type: 'string' }, zoom: { type: 'string' }, rotate: { type: 'string', default: '0' },
            seconds: { type: 'string', default: '60' } },
    });
    const zoom = Number(v.zoom ?? 0), rotate = Number(v.rotate);
    const machine = await Machine.start(command, args, Number(v.seconds));
    try {
        const at = v.break && read_elf(v.elf).symbols[v.break];
        if (v.break && at === undefined)
            throw new Error(`${v.elf}: no ${v.break}`);
        for (let k = 0; k < Number(v.stops); k++) {
            await machine.run_to(at & ~1);
            await machine.screendump(`${stem}_${k}`, zoom, rotate);
        }
        if (v.until) {
            await machine.run_until(v.until);
            await machine.screendump(`${stem}_end`, zoom, rotate);
        }
    } finally {
        await machine.end();
        fs.writeFileSync(`${stem}.txt`, machine.serial);
        fs.writeFileSync(`${stem}.err`, machine.complaints);
    }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    try {
        await main();
    } catch (error) {
        console.error(error.message);
        process.exitCode = 1;
    }
}
