// node spi_log.mjs LOG STREAM: what an nRF51's registers were told (QEMU's log of -d unimp and of -trace
// nrf51_gpio_write and nrf51_uart_write), as the words of `zsim panel --decode`, text included. Prints what breaks the
// rules of the wire.
//
// QEMU's micro:bit has a mere stand-in for the I2C that shares SPI0's addresses: it logs, and every event reads 1. What
// the part does is told here, by the nRF51 Series Reference Manual's chapter on the SPI master: two bytes may be on
// their way, one on the wire and one in TXD; a byte has ended when RXD was read after READY; READY is cleared before
// that.
//
// SPDX-License-Identifier: MIT
import fs from 'node:fs';
import readline from 'node:readline';

const PIN = { mosi: 21, sck: 23, cs: 16, dc: 18, reset: 22 }; // as in hal/nrf51/pins.h
const OUTSET = 0x508, OUTCLR = 0x50c, DIRSET = 0x518, PIN_CNF = 0x700; // of GPIO
const READY = 0x108, ENABLE = 0x500, RXD = 0x518, TXD = 0x51c;         // of SPI, and TXD of the UART
const WANTED = { 0x508: PIN.sck, 0x50c: PIN.mosi, 0x510: 0xffffffff, 0x524: 0x80000000, 0x554: 0 }; // 8 MHz, mode 0
const OUTPUT = 3, HIGH_DRIVE = 0x303;
const DATA = 0x100, RESET = 0x200, DESELECT = 0x800, TEXT = 0x1000;

const [log, to] = process.argv.slice(2);
const words = [], problems = new Set();
const told = {}, pin_set_up = {};
let high = 0, on = 0, on_the_way = 0, cleared = 0;

const is_high = (pin) => high >>> pin & 1;

function levels(now) {
    for (const name of ['cs', 'dc', 'reset'])
        if ((now ^ high) >>> PIN[name] & 1 && on_the_way)
            problems.add(`${name} changes while ${on_the_way} bytes are on their way`);
    if (is_high(PIN.reset) && !(now >>> PIN.reset & 1))
        words.push(RESET);
    if (!is_high(PIN.cs) && now >>> PIN.cs & 1 && pin_set_up[PIN.cs])
        words.push(DESELECT);
    high = now;
}

function gpio(offset, value) {
    if (offset === OUTSET)
        levels(high | value);
    else if (offset === OUTCLR)
        levels(high & ~value);
    else if (offset >= PIN_CNF) {
        const pin = (offset - PIN_CNF) / 4;
        pin_set_up[pin] = value;
        if ([PIN.cs, PIN.dc, PIN.reset].includes(pin) && !is_high(pin))
            problems.add(`P0.${pin} is driven low when it is set up`);
    } else if (offset !== DIRSET)
        problems.add(`GPIO 0x${offset.toString(16)} is written`);
}

function enabled() {
    for (const [offset, value] of Object.entries(WANTED))
        if (told[offset] !== value)
            problems.add(`SPI 0x${Number(offset).toString(16)} is ${told[offset]} when it is turned on`);
    for (const [name, pin] of Object.entries(PIN))
        if (pin_set_up[pin] !== (name === 'sck' || name === 'mosi' ? HIGH_DRIVE : OUTPUT))
            problems.add(`${name} is no output, or of another drive`);
    if (on_the_way)
        problems.add('turned on with bytes on their way');
}

function spi_write(offset, value) {
    if (offset === TXD) {
        if (!on || is_high(PIN.cs) || !is_high(PIN.reset))
            problems.add('a byte is sent with SPI off, CS high or RESET low');
        if (++on_the_way > 2)
            problems.add('a third byte is sent before the first has ended');
        words.push(value | (is_high(PIN.dc) ? DATA : 0));
    } else if (offset === READY) {
        cleared = value === 0;
    } else if (offset === ENABLE) {
        on = value === 1;
        if (on)
            enabled();
    } else {
        told[offset] = value;
    }
}

function spi_read(offset) {
    if (offset === READY)
        cleared = 0;
    else if (offset === RXD && on_the_way) {
        if (!cleared)
            problems.add('RXD is read before READY was seen and cleared');
        cleared = 0;
        on_the_way--;
    }
}

const number = (text) => parseInt(text, 16);
for await (const line of readline.createInterface({ input: fs.createReadStream(log) })) {
    let f;
    if ((f = /^microbit_i2c_write: 0x(\w+) <- 0x(\w+)/.exec(line)))
        spi_write(number(f[1]), number(f[2]));
    else if ((f = /^microbit_i2c_read: 0x(\w+)/.exec(line)))
        spi_read(number(f[1]));
    else if ((f = /^nrf51_gpio_write offset 0x(\w+) value 0x(\w+)/.exec(line)))
        gpio(number(f[1]), number(f[2]));
    else if ((f = /^nrf51_uart_write addr 0x0*51c value 0x(\w+)/.exec(line)))
        words.push(TEXT | number(f[1]));
}
if (on_the_way || !is_high(PIN.cs))
    problems.add('it ends with bytes on their way, or CS low');
fs.writeFileSync(to, Buffer.from(Uint16Array.from(words).buffer));
for (const problem of problems)
    console.log(`problem: ${problem}`);
