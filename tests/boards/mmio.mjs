// node mmio.mjs IMAGE.elf --until TEXT [--seconds N] [--frame BYTES] [--stream FILE] [--reads 1]
//
// Boots an image in QEMU's netduinoplus2 (STM32F405) and follows what it writes to registers, by QEMU's trace of its
// memory-mapped devices, until its USART6 has said a line with TEXT (or --seconds, 30, have passed: a problem). GPIO
// writes give the levels of the panel's pins, SPI1's data register the bytes, in order. Prints "name value" lines: what
// the registers of clock, pins and SPI1 say, the transfers by DMA (which QEMU does not run), the text of the USART
// after "text", what broke the rules of the wire after "problem".
//
// --stream  FILE gets what went over the wire: a little-endian uint16 for each byte, bits 0-7 the byte, bit 8 D/C;
//           marks: bit 9 RESET went low, bit 10 a picture ends here, bit 11 CS went high. A picture is --frame bytes
//           after memory-write commands; the first is the driver's black, and has no mark.
// --reads   follow reads, too (slow): pins of the panel move only after SPI1's status was read since the last byte.
//
// The registers of RCC, flash, GPIO and DMA are not QEMU's: they read 0, so that a read-modify-write writes what it
// adds. Fields are taken or-ed from all writes for that reason. Time does not pass on this wire: SPI1 is never busy.
//
// SPDX-License-Identifier: MIT
import { spawn } from 'node:child_process';
import fs from 'node:fs';

// RM0090: registers (2.3, and each block's map)
const RCC = 0x40023800, FLASH_ACR = 0x40023c00, GPIO = 0x40020000, SPI1 = 0x40013000, USART6 = 0x40011400;
const DMA2 = 0x40026400, TIM3 = 0x40000400, TIM5 = 0x40000c00;
const PLLCFGR = RCC + 0x04, CFGR = RCC + 0x08, APB2RSTR = RCC + 0x24, AHB1ENR = RCC + 0x30, APB1ENR = RCC + 0x40;
const APB2ENR = RCC + 0x44;
const CR1 = SPI1, CR2 = SPI1 + 4, SR = SPI1 + 8, DR = SPI1 + 12, USART_DR = USART6 + 4;
const LIFCR = DMA2 + 0x08, S3CR = DMA2 + 0x58, S3NDTR = DMA2 + 0x5c, S3PAR = DMA2 + 0x60, S3M0AR = DMA2 + 0x64;
const S3FCR = DMA2 + 0x6c;
const NVIC_ISER1 = 0xe000e104; // Armv7-M manual, B3.4
const A = 0, C = 2; // ports
const PIN = { // as in hal/stm32f4/pins.h
    cs: [A, 4], dc: [A, 6], reset: [C, 4], sck: [A, 5], mosi: [A, 7], backlight: [C, 7], text: [C, 6],
};
const HSI_HZ = 16e6;
const MEMORY_WRITE = 0x2c; // of the MIPI command set
const MARK = { reset: 0x200, frame: 0x400, deselect: 0x800 };

function options(args) {
    const o = { until: '', seconds: 30, frame: 0, stream: '', reads: 0 };
    for (let i = 1; i < args.length; i += 2) {
        const name = args[i].replace('--', '');
        o[name] = typeof o[name] === 'number' ? Number(args[i + 1]) : args[i + 1];
    }
    return { image: args[0], ...o };
}

const o = options(process.argv.slice(2));
const problems = [], facts = new Map();
const said = new Map();    // register: all that was written to it, or-ed
const last = new Map();    // register: what was written last
let text = '', n_bytes = 0;

function problem(what) {
    if (!problems.includes(what))
        problems.push(what);
}

// ---- The wire

const level = { cs: 1, dc: 1, reset: 1 };
let stream = new Uint16Array(1 << 20), n_stream = 0;
let pixels = 0, writing = false, pictures = -1, seen = true; // seen: SPI1's status was read since the last byte

function put(word) {
    if (n_stream === stream.length) {
        const more = new Uint16Array(2 * n_stream);
        more.set(stream);
        stream = more;
    }
    stream[n_stream++] = word;
}

function spi_byte(value) {
    if (n_bytes++ === 0)
        check_set_up();
    if (level.cs)
        problem('a byte leaves while CS is high');
    if (!level.reset)
        problem('a byte leaves while RESET is low');
    if (value > 255)
        problem(`a byte of ${value.toString(16)}`);
    if (level.dc)
        pixels += writing;
    else
        writing = value === MEMORY_WRITE;
    seen = false;
    put(level.dc << 8 | value);
}

function cs_rises() {
    put(MARK.deselect);
    if (o.frame && pixels === o.frame) {
        if (++pictures > 0)
            put(MARK.frame);
        pixels = 0;
    } else if (o.frame && pixels > o.frame) {
        problem(`a picture of ${pixels} bytes`);
    }
}

function gpio(port, value) {
    for (const [name, [at, bit]] of Object.entries(PIN)) {
        const set = value >> bit & 1, clear = value >> bit + 16 & 1;
        if (at !== port || !(name in level) || !(set || clear) || level[name] === set)
            continue;
        if (o.reads && !seen)
            problem(`${name} moves, and nobody has asked whether SPI1 is busy`);
        level[name] = set;
        if (name === 'cs' && set)
            cs_rises();
        if (name === 'reset' && !set)
            put(MARK.reset);
    }
}

// ---- Set-up: what must have been written before the first byte

function field(register, at, bits) {
    return (said.get(register) ?? 0) >>> at & (1 << bits) - 1;
}

function pin_is(name, mode, alternate) {
    const [port, bit] = PIN[name], base = GPIO + 0x400 * port;
    const is = field(base, 2 * bit, 2), af = field(base + 0x20 + 4 * (bit >> 3), 4 * (bit & 7), 4);
    if (is !== mode || (mode === 2 && af !== alternate))
        problem(`${name}: mode ${is}, alternate function ${af}`);
    if (field(base + 8, 2 * bit, 2) < 2)
        problem(`${name}: slow edges`);
    if (!field(AHB1ENR, port, 1))
        problem(`${name}: its port has no clock`);
}

function check_set_up() {
    for (const name of ['cs', 'dc', 'reset'])
        pin_is(name, 1);
    pin_is('sck', 2, 5);
    pin_is('mosi', 2, 5);
    if (!field(APB2ENR, 12, 1))
        problem('SPI1 has no clock');
    const cr1 = last.get(CR1) ?? 0;
    facts.set('spi_cr1', `0x${cr1.toString(16)}`);
    facts.set('spi_divider', 2 << (cr1 >> 3 & 7));
    facts.set('spi_mode', cr1 & 3);
    // BIDIMODE, BIDIOE, SSM, SSI, SPE, MSTR; 8 bits, most significant first, no CRC
    if ((cr1 & ~0x3b) !== 0xc344)
        problem(`SPI1_CR1 ${cr1.toString(16)}`);
    const pll = last.get(PLLCFGR) ?? 0, cfgr = said.get(CFGR) ?? 0;
    const hz = HSI_HZ / (pll & 63) * (pll >> 6 & 511) / (2 * (pll >> 16 & 3) + 2);
    const divided = (ppre) => hz / (ppre & 4 ? 2 << (ppre & 3) : 1);
    facts.set('pll_hz', pll >> 22 & 1 ? 'from the crystal' : hz);
    facts.set('apb1_hz', divided(cfgr >> 10 & 7));
    facts.set('apb2_hz', divided(cfgr >> 13 & 7));
    facts.set('wait_states', (said.get(FLASH_ACR) ?? 0) & 7);
    facts.set('caches', (said.get(FLASH_ACR) ?? 0) >> 8 & 7);
    if ((last.get(CFGR) ?? 0) !== 0 || !field(RCC, 24, 1))
        problem('the PLL that does not lock is not left alone');
}

// Text leaves at 115200 baud of the 16 MHz that are left where the PLL does not lock; a USART takes 2 % off.
function check_text() {
    pin_is('text', 2, 8);
    if (!field(APB2ENR, 5, 1) || last.get(USART6 + 12) !== (1 << 13 | 1 << 3)) // UE, TE
        problem('USART6 is not on');
    if (Math.abs(HSI_HZ / (last.get(USART6 + 8) ?? 1) / 115200 - 1) > 0.02)
        problem(`USART6_BRR ${last.get(USART6 + 8)}`);
}

// TIM3 by 1 MHz of the same, in steps of 255: channel 2 in PWM mode 1 with preload.
function check_light() {
    pin_is('backlight', 2, 2);
    const is = [0, 0x18, 0x20, 0x28, 0x2c].map((at) => last.get(TIM3 + at));
    if (!field(APB1ENR, 1, 1) || `${is}` !== `${[0x81, 0x6800, 0x10, 15, 254]}`)
        problem(`TIM3: CR1, CCMR1, CCER, PSC, ARR ${is}`);
}

// ---- DMA2, stream 3: each start, and whether the steps before it are those of RM0090, 10.3.17

// TIM5 runs by 1 MHz, once, and may interrupt, as the DMA may (interrupts 50 and 59).
function check_deadline() {
    const is = [0, 0x0c, 0x28].map((at) => last.get(TIM5 + at));
    if (!field(APB1ENR, 3, 1) || `${is}` !== `${[0x0d, 1, 15]}`)
        problem(`TIM5: CR1, DIER, PSC ${is}`);
    if (!field(NVIC_ISER1, 18, 1) || !field(NVIC_ISER1, 27, 1))
        problem('interrupts of TIM5 and DMA2_S3 are not enabled');
}

const starts = [];
let steps = [];

function dma(address, value) {
    if (address === S3CR && value === 0)
        steps = [];
    steps.push([address, value]);
    if (address !== S3CR || !(value & 1))
        return;
    const [off, clear, ...set] = steps, by = new Map(set.slice(0, -2)), mode = set[set.length - 2];
    const good = off?.[0] === S3CR && clear?.[0] === LIFCR && clear[1] === 0x0f400000 && set.length === 6 &&
        by.get(S3PAR) === DR && by.has(S3M0AR) && by.has(S3NDTR) && by.get(S3FCR) === 0 &&
        mode[0] === S3CR && (mode[1] | 1) === value;
    if (!good)
        problem(`DMA2_S3 is started by ${steps.map(([a, v]) => `${(a - DMA2).toString(16)}=${v.toString(16)}`)}`);
    // channel 3, priority high, bytes to bytes, memory steps, memory to peripheral, interrupts of end and of error
    if (value !== (3 << 25 | 2 << 16 | 1 << 10 | 1 << 6 | 1 << 4 | 1 << 2 | 1))
        problem(`DMA2_S3CR ${value.toString(16)}`);
    if (!field(AHB1ENR, 22, 1))
        problem('DMA2 has no clock');
    check_deadline();
    if (level.cs || !level.dc)
        problem('DMA2_S3 is started without CS low and D/C high');
    starts.push({ from: by.get(S3M0AR), n: by.get(S3NDTR), asked: false });
}

// Before the PLL is set up the core was put on the HSI, and the PLL off.
function check_pll() {
    if (last.get(CFGR) !== 0 || !field(RCC, 0, 1) || (last.get(RCC) ?? 1 << 24) >> 24 & 1)
        problem('the PLL is set up while it may be on');
}

function write(address, value) {
    if (address === PLLCFGR)
        check_pll();
    said.set(address, said.get(address) | value);
    last.set(address, value);
    if (address >= GPIO && address < GPIO + 0xc00 && (address & 0x3ff) === 0x18)
        gpio((address - GPIO) >> 10, value);
    else if (address >= DMA2 && address < DMA2 + 0x400)
        dma(address, value);
    else if (address === CR2 && starts.length)
        starts[starts.length - 1].asked ||= value === 2; // TXDMAEN: SPI1 asks for bytes
    else if (address === APB2RSTR && value & 1 << 12)
        facts.set('spi_resets', (facts.get('spi_resets') ?? 0) + 1);
    else if (address === TIM5 + 0x2c)
        facts.set('deadline_us', value);
    else if (address === TIM3 + 0x38)
        facts.set('backlight', value);
    else if (address === USART_DR)
        text += String.fromCharCode(value);
}

// ---- The trace: "memory_region_ops_write cpu 0 mr 0x55... addr 0x4001300c value 0x2a size 4 name '...'"

function follow(line) {
    const at = line.indexOf(' addr 0x');
    if (at < 0)
        return line && !line.includes('terminating on signal') && problem(`QEMU: ${line}`);
    const comma = line.indexOf(' value 0x', at + 8);
    const address = parseInt(line.slice(at + 8, comma), 16);
    if (line.startsWith('memory_region_ops_read'))
        return void (seen ||= address === SR);
    const value = parseInt(line.slice(comma + 9, line.indexOf(' ', comma + 9)), 16);
    return address === DR ? spi_byte(value) : write(address, value);
}

function finish() {
    check_text();
    check_light();
    for (const [name, value] of facts)
        console.log(name, value);
    for (const { from, n, asked } of starts)
        console.log('dma', `0x${from.toString(16)}`, n, asked ? 'asked' : 'not asked for');
    console.log('bytes', n_bytes);
    for (const line of text.split('\n').filter(Boolean))
        console.log('text', line);
    for (const what of problems)
        console.log('problem', what);
    if (o.stream)
        fs.writeFileSync(o.stream, new Uint8Array(stream.buffer, 0, 2 * n_stream));
}

// sleep=off: asleep, the core goes on at once at its next timer. Else virtual time follows the machine's own while it
// sleeps, and runs milliseconds ahead where that is busy.
const traces = ['memory_region_ops_write', ...(o.reads ? ['memory_region_ops_read'] : [])];
const qemu = spawn('qemu-system-arm', ['-M', 'netduinoplus2', '-display', 'none', '-monitor', 'none', '-serial', 'null',
    '-icount', 'shift=0,sleep=off', ...traces.flatMap((t) => ['-trace', t]), '-kernel', o.image],
{ stdio: ['ignore', 'ignore', 'pipe'] });
const late = setTimeout(() => {
    problem(`not "${o.until}" within ${o.seconds} s`);
    qemu.kill();
}, 1000 * o.seconds);
let rest = '', over = false;
qemu.stderr.on('data', (bytes) => {
    const lines = (rest + bytes.toString('latin1')).split('\n');
    rest = lines.pop();
    for (const line of lines) {
        if (over)
            break;
        follow(line);
        over = text.endsWith('\n') && text.includes(o.until);
    }
    if (over)
        qemu.kill();
});
qemu.on('close', () => {
    clearTimeout(late);
    finish();
});
