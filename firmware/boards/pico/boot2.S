/* The second stage of the boot ROM: the first 256 bytes of flash, copied to RAM by the ROM and entered there (RP2040
 * datasheet, 2.8.1.3). Makes the flash readable at 0x10000000 and enters the program at 0x10000100.
 *
 * Flash is read by 3Bh, "fast read, dual output": command and 24-bit address on one line, eight clocks of pause, data
 * on two. Flash chips know it without a mode being set first, and at 62.5 MHz. Its 56 clocks a word are half the time
 * of plain 03h, which ends at 50 MHz. What an emulator cannot tell: all of this; its flash needs no set-up.
 *
 * Any address will do. At most 252 bytes; the checksum behind them comes from host/seal.c.
 *
 * SPDX-License-Identifier: MIT
 */
    .syntax unified
    .cpu cortex-m0plus
    .thumb

    /* 4.10.13: the flash interface (SSI) */
    .equ SSI, 0x18000000
    .equ CTRLR0, 0x00
    .equ CTRLR1, 0x04
    .equ SSIENR, 0x08
    .equ BAUDR, 0x14
    .equ RX_SAMPLE_DLY, 0xf0
    .equ SPI_CTRLR0, 0xf4
    .equ DUAL_READ, 1 << 21 | 31 << 16 | 3 << 8 /* data on two lines; 32 bits a word; command, address, then read */
    .equ CMD_3B, 0x3b << 24 | 8 << 11 | 2 << 8 | 6 << 2 | 0 /* pause of 8 clocks, 8-bit command, 6 * 4 bits of address,
                                                              both on one line */
    .equ DIVIDER, 2                             /* even: SCK is 62.5 MHz when clk_sys has come to 125 */
    .equ LATE, 1                                /* cycles of clk_sys by which data is sampled late at that rate */

    /* 2.19.6.3: the flash's pads. As reset leaves them, edges of a clock of 62.5 MHz are slow and data comes in late */
    .equ PADS, 0x40020000
    .equ PADS_CLEAR, PADS + 0x3000              /* 2.1.2: bits written there are cleared */
    .equ SCLK, 0x04
    .equ SD0, 0x08
    .equ SD1, 0x0c
    .equ QUICK_OUT, 2 << 4 | 1                  /* 8 mA, fast slew, no input */
    .equ SCHMITT, 1 << 1

    .equ VTOR, 0xe000ed08                       /* 2.4.8 */
    .equ PROGRAM, 0x10000100

    .section .boot2, "ax"
    .global boot2
boot2:
    ldr r3, =PADS
    movs r0, #QUICK_OUT
    str r0, [r3, #SCLK]
    ldr r3, =PADS_CLEAR
    movs r0, #SCHMITT
    str r0, [r3, #SD0]
    str r0, [r3, #SD1]

    ldr r3, =SSI
    movs r2, #0
    str r2, [r3, #SSIENR] /* registers can be written while it is off */
    movs r0, #DIVIDER
    str r0, [r3, #BAUDR]
    movs r1, #RX_SAMPLE_DLY
    movs r0, #LATE
    str r0, [r3, r1]
    ldr r0, =DUAL_READ
    str r0, [r3, #CTRLR0]
    str r2, [r3, #CTRLR1] /* one word an access */
    movs r1, #SPI_CTRLR0
    ldr r0, =CMD_3B
    str r0, [r3, r1]
    movs r0, #1
    str r0, [r3, #SSIENR]

    ldr r0, =PROGRAM      /* its vector table: stack pointer, entry */
    ldr r1, =VTOR
    str r0, [r1]
    ldm r0, {r0, r1}
    msr msp, r0
    bx r1
    .ltorg
