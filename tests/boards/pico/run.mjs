// node run.mjs STEM [--frames N] [--step S] [--gap NS] [--hold FRAME.STRIP [--tail 1] [--head 1]] [--stream FILE]
//             [--until TEXT] [--doze NS] [--profile N] [--second MODE] [--stop FRAME.STRIP] [--fault FRAME.STRIP]
//             [--refuse FRAME] [--xip 1] [--seconds N]
//
// Boots STEM.bin, lets the show draw frames 0, S, 2 S ... and stop (--until: lets it run by the clock, as it does on a
// desk, until the UART has said TEXT), and prints what was measured, "name value" a line; the text of the UART after
// "text", problems after "problem". FILE gets what went over the wire: a little-endian uint16 for each byte, bits 0-7
// the byte, bit 8 D/C; marks: bit 9 RESET went low, bit 10 a picture ends here, bit 11 CS went high.
// --hold: in this strip of this frame, from its first word or (--tail) when the DMA has handed its last one
// over, or (--head, two cores) from the panel's command before its pixels, no word ends before the bus gives up.
// --doze: NS pass right before each WFI. --profile: the N functions that draw longest, "function NAME CYCLES" a line:
// cycles a frame, callees not counted. --second: a mode of second.mjs. --stop: core 1 stands still in what it draws
// when core 0 begins to send this strip of this frame, or draws next. --fault: it has a hard fault there. --refuse:
// this frame's scene is one that no renderer takes.
//
// --xip: reading the flash takes time (xip.mjs). --seconds: of this machine's time, after which it is broken off.
//
// Of an image for two cores a frame is what leaves from its first strip to its last; cycles are counted from one
// frame's end to the next, by core. A picture that was broken off, or of which nothing was sent, ends where the next
// one begins. With --profile, functions are those of both cores.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';

import { alone } from './alone.mjs';
import { Pico } from './pico.mjs';

const PHASE_DRAW = 1; // enum show_phase of firmware/app/show.c
const RAM = 0x20000000, HEIGHT = 240; // HEIGHT: of a picture of two cores

function options(args) {
    const o = { frames: 4, step: 1, gap: 0, doze: 0, profile: 0, xip: 0, hold: '', tail: 0, head: 0, refuse: -1,
        seconds: Infinity, stream: '', until: '', second: '', stop: '', fault: '' };
    for (let i = 1; i < args.length; i += 2) {
        const name = args[i].replace('--', '');
        o[name] = typeof o[name] === 'number' ? Number(args[i + 1]) : args[i + 1];
    }
    return { stem: args[0], ...o };
}

// What was measured, as text.
export function run(args) {
    const o = options(args);
    const pico = new Pico(o.stem, { gap_ns: o.gap, doze_ns: o.doze, second: o.second, xip: o.xip !== 0,
        real_s: o.seconds });
    const { symbols } = pico.elf, two = 'pair_phase' in symbols;
    const frame_end = symbols.zs_frame_end & ~1, strip_call = symbols.zs_frame_strip & ~1, stop = symbols.hal_exit & ~1;
    const place = (text) => text ? text.split('.').map(Number) : [-1, -1];
    const [hold_frame, hold_strip] = place(o.hold), [stop_frame, stop_strip] = place(o.stop);
    const [fault_frame, fault_strip] = place(o.fault);
    const channel = pico.chip.dma.channels[0];
    const frames = []; // what was known when each was on the glass
    let strips = 0, armed = false, ending = false, draw = 0, draw_1 = 0, hidden = 0, in_flash = 0;
    let misses = 0;                                  // of the flash's cache, while drawing
    // drawing cycles up to the strip in hand; of the slowest strip, and its number
    let strip_from = 0, worst = 0, worst_strip = 0;
    let strips_most = 0;

    if (!o.until) {
        pico.patch('show_test', 0, o.frames);
        pico.patch('show_test', 1, o.step);
    }
    function on_glass() {
        ending = false;
        pico.mark_picture();
        frames.push({ ns: pico.clock.nanos, draw, draw_1, hidden, misses, wire: pico.busy_ns });
    }
    pico.on_release = () => {
        if (ending && (!two || (pixels && !channel.active)))
            on_glass();
    };
    pico.boot();

    const phase_at = pico.ram_index(two ? 'pair_phase' : 'show_phase');
    const { sram } = pico.chip, { core } = pico, spi = pico.chip.spi[0];
    const cycles_at = o.profile ? new Map() : null; // while drawing, by address
    let said = 0;  // characters of text that have been looked at
    let drawn = 0; // frames that zs_frame_end has closed
    let harm = () => {}; // to core 1
    pico.on_second = (at, cycles) => {
        if (sram[phase_at + 1] !== PHASE_DRAW)
            return;
        harm();
        draw_1 += cycles;
        cycles_at?.set(at, (cycles_at.get(at) ?? 0) + cycles);
        if (at < RAM)
            in_flash += cycles;
    };

    // Two cores: what panel_send is given says where in the picture the wire is.
    const send_call = symbols.panel_send & ~1, frame_call = symbols.pair_frame & ~1;
    let asked = -1, wire_frame = -1, wire_strip = 0, pixels = false;
    let starts = false; // holding, and no word has begun yet
    function sends() {
        const rect = core.registers[1], y = pico.chip.readUint16(rect + 2), h = pico.chip.readUint16(rect + 6);
        if (y === 0) {
            while (frames.length < asked) // dropped
                on_glass();
            wire_frame = asked;
            wire_strip = -1;
        }
        wire_strip++;
        pixels = false;
        ending = y + h === HEIGHT;
        armed = wire_frame === hold_frame && wire_strip === hold_strip;
        if (armed && o.head) {
            pico.holding = starts = true;
            armed = false;
        }
        if (wire_frame === stop_frame && wire_strip === stop_strip)
            harm = () => pico.second.stop();
        if (wire_frame === fault_frame && wire_strip === fault_strip)
            harm = () => pico.second.fault();
    }
    let kept = 0; // the scene's instances, while it has none
    function refuse() {
        const scene = core.registers[0];
        if (kept)
            pico.chip.writeUint32(scene, kept);
        kept = asked + 1 === o.refuse ? pico.chip.readUint32(scene) : 0;
        if (kept)
            pico.chip.writeUint32(scene, 0);
    }
    // The strip that was drawn last is over. The first frame is not like others: nothing is in caches, damage is
    // everywhere.
    function strip_ends() {
        if (drawn > 0 && strips > 0 && draw - strip_from > worst) {
            worst = draw - strip_from;
            worst_strip = strips - 1;
        }
        strip_from = draw;
    }
    function one_core_at(pc) {
        if (pc === frame_end) {
            ending = true;
            strip_ends();
            drawn++;
            strips = 0;
        } else if (pc === strip_call) {
            if (strips > 0) // the first one's begins with the frame's
                strip_ends();
            strips++;
            strips_most = Math.max(strips_most, strips);
            // strip k is on the wire while strip k + 1 is drawn
            armed = drawn === hold_frame && strips === hold_strip + 2;
        }
    }
    while (core.PC !== stop) {
        if (!two)
            one_core_at(core.PC);
        else if ((core.PC & ~1) === send_call) // odd in what interrupts enter
            sends();
        else if (channel.active)
            pixels = true;
        if (armed && (!o.tail || !channel.active) && (!two || pixels)) {
            pico.holding = spi.busy;
            armed = false;
        }
        if (core.PC === frame_call)
            refuse();
        const at = core.PC, missed = pico.xip?.misses ?? 0, cycles = pico.step();
        if (at === frame_call && core.PC === at + 2) // else an interrupt came first
            asked++;
        if (sram[phase_at] === PHASE_DRAW) {
            draw += cycles;
            misses += (pico.xip?.misses ?? 0) - missed;
            cycles_at?.set(at, (cycles_at.get(at) ?? 0) + cycles);
            if (spi.busy)
                hidden += cycles;
            if (core.PC < RAM)
                in_flash += cycles;
        }
        if (starts)
            starts = !spi.busy;
        else if (pico.holding && !spi.busy) // the bus was reset
            pico.release();
        if (o.until && pico.text.length !== said) {
            said = pico.text.length;
            if (pico.text.includes(o.until))
                break;
        }
    }

    // The longest functions of a sum by address.
    function longest(count) {
        const sums = new Map(), { functions } = pico.elf;
        let k = 0;
        for (const [at, cycles] of [...cycles_at].sort((a, b) => a[0] - b[0])) {
            while (k + 1 < functions.length && functions[k + 1].at <= at)
                k++;
            sums.set(functions[k].name, (sums.get(functions[k].name) ?? 0) + cycles);
        }
        return [...sums].sort((a, b) => b[1] - a[1]).slice(0, count);
    }

    const sizes = pico.sizes();
    const lines = [];
    const out = (name, value) => lines.push(`${name} ${value}\n`);
    const first = frames[1] ?? frames[0], last = frames[frames.length - 1], n = frames.length - 2;
    out('frames', frames.length);
    out('spi_hz', pico.spi.hz);
    out('spi_mode0', pico.spi.mode0 ? 1 : 0);
    out('clk_sys', pico.chip.clkSys);
    if (n > 0) {
        out('draw_cycles', Math.round((last.draw - first.draw) / n));
        if (two)
            out('draw_cycles_1', Math.round((last.draw_1 - first.draw_1) / n));
        out('hidden_percent', Math.round((last.hidden - first.hidden) / (last.draw - first.draw) * 100));
        if (!two) {
            out('strips', strips_most - 1); // zs_frame_strip is called once more
            out('worst_strip', worst_strip);
            out('worst_strip_cycles', worst);
        }
        if (pico.xip)
            out('flash_misses', Math.round((last.misses - first.misses) / n));
        out('wire_us', Math.round((last.wire - first.wire) / n / 1000));
        out('fps', (n / (last.ns - first.ns) * 1e9).toFixed(1));
    }
    out('in_flash_percent', (in_flash / (draw + draw_1) * 100).toFixed(2)); // of the drawing cycles
    out('flash', sizes.flash);
    out('ram', sizes.ram);
    out('stack_reserve', pico.stack_reserve(0));
    out('stack_used', pico.stack_used(0));
    if (two) {
        out('stack_1_reserve', pico.stack_reserve(1));
        out('stack_1_used', pico.stack_used(1));
    }
    if (o.profile)
        for (const [name, cycles] of longest(o.profile))
            out('function', `${name} ${Math.round(cycles / o.frames)}`);
    for (const line of pico.text.split('\n').filter(Boolean))
        out('text', line);
    for (const problem of pico.problems)
        out('problem', problem);
    if (o.stream)
        fs.writeFileSync(o.stream, pico.stream.from());
    return lines.join('');
}
alone(import.meta.url, run);
