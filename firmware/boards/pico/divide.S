/* 32-bit division by the RP2040's divider (datasheet, 2.3.1.5) in place of libgcc's loop: 20 cycles and the call, for
 * any operands.
 *
 * The divider has two operands and needs eight cycles; then quotient and remainder can be read. By libgcc's rules
 * n / 0 is what __aeabi_idiv0(0) returns, 0 unless a program has its own, and the remainder is n; -2^31 / -1 is -2^31.
 *
 * Interrupts: a handler that divides would take the operands away from the program. Those of this board do not divide;
 * those that call what others wrote save the divider around it (hal/rp2040/parts.h). A handler of yours has to do the
 * same.
 * Each core has a divider of its own, at the same addresses.
 *
 * The names: Run-time ABI for the Arm Architecture, 4.3.1.
 *
 * SPDX-License-Identifier: MIT
 */
    .syntax unified
    .cpu cortex-m0plus
    .thumb

    .equ UDIVIDEND, 0x60 /* from SIO, 0xd0000000 */
    .equ UDIVISOR, 0x64
    .equ SDIVIDEND, 0x68
    .equ SDIVISOR, 0x6c
    .equ QUOTIENT, 0x70
    .equ REMAINDER, 0x74

    .macro function name
    .global \name
    .type \name, %function
    .thumb_func
\name:
    .endm

    /* r0 / r1: quotient to r0, remainder to r1 */
    .macro divide dividend, divisor
    cmp r1, #0
    beq by_zero
    movs r2, #0xd0
    lsls r2, #24
    str r0, [r2, #\dividend]
    str r1, [r2, #\divisor]
    b 1f /* four taken branches: eight cycles */
1:  b 2f
2:  b 3f
3:  b 4f
4:  ldr r1, [r2, #REMAINDER]
    ldr r0, [r2, #QUOTIENT] /* last: it tells a debugger that the result has been taken */
    bx lr
    .endm

    .section .text.divide, "ax"
    .balign 4
    function __aeabi_uidiv
    function __aeabi_uidivmod
    function __udivsi3
    divide UDIVIDEND, UDIVISOR

by_zero:
    push {r0, lr}
    movs r0, #0
    bl __aeabi_idiv0
    pop {r1, pc}

    .balign 4
    function __aeabi_idiv
    function __aeabi_idivmod
    function __divsi3
    divide SDIVIDEND, SDIVISOR
