/* The whole contract with hardware. One implementation is linked into a binary: hal/null (what a porter copies),
 * hal/host (a program on a PC), hal/linux (a panel on spidev), hal/rp2040 (Raspberry Pi Pico), hal/nrf51 (micro:bit),
 * hal/lm3s6965, hal/stm32f4, and for cores in QEMU without a panel hal/mps2 (Cortex-M) and hal/rv32. They are peers;
 * hal/spi, hal/cortexm and hal/stack hold what several of them share.
 *
 * This header knows nothing of the renderer: it moves text, ticks and a panel's bytes. A bus (struct hal_bus)
 * is a value, so that wrappers are peers too: hal/fault makes another bus fail, the simulator's ends in a
 * model of the panel.
 * A second core, where a board has one, is second.h's.
 * Nothing here may be called from an interrupt unless its comment says so. Errors are negative and
 * below -100, so that a sink can pass them through the renderer without being taken for its own.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef HAL_H
#define HAL_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum hal_err {
    HAL_ERR_NONE = 0, /* not HAL_OK, which is STM32Cube's */
    HAL_ERR_STATE = -101,   /* hal_init missing, or a transfer begun while one is still out */
    HAL_ERR_ARG = -102,     /* a NULL pointer, or an empty transfer */
    HAL_ERR_CHANGED = -103, /* hal/host: borrowed bytes were written to */
    HAL_ERR_BUS = -104,     /* the transfer failed: bytes may be missing on the panel's side */
    HAL_ERR_TIMEOUT = -105, /* it did not end in its time, and was broken off */
    HAL_ERR_BUSY = -106     /* hooks.lock: another user of the bus kept it */
};

/* ---- The panel's bus ------------------------------------------------------------------------------- */

/* What a program puts into a bus between hal_bus and the first use of it. Each may be NULL. */
struct hal_hooks {
    void *ctx;              /* passed to all four */
    void (*idle)(void *ctx); /* called again and again while wait waits, instead of the bus's own way (WFI where there
                               is one): take a semaphore, yield, feed a watchdog. May return at any time */
    void (*done)(void *ctx); /* called when bytes begun by data are out, also when that failed: gives the semaphore.
                               From an interrupt, where the bus has one: must be ISR-safe */
    int (*lock)(void *ctx);  /* before a panel uses the bus (SPI shared with a card, a touch controller). May block.
                               Not 0: the bus is not used, and the panel function returns HAL_ERR_BUSY */
    void (*unlock)(void *ctx); /* after that, also where it failed; both in what calls the panel: an interrupt only
                                  where strips are sent in one, as firmware/app/pair.h does */
};

/* The verbs that a panel driver speaks. One panel hangs on a bus; every verb concerns that panel alone. An
 * implementation makes this the first member of its own struct. */
struct hal_bus {
    /* Send a command byte (D/C low) and its n argument bytes (D/C high).
     * Buffer  args is not kept. args may be NULL where n is 0.
     * Blocks  until they are out (some microseconds).
     * Return  HAL_ERR_NONE; HAL_ERR_STATE while data is out; HAL_ERR_ARG; _BUS, _TIMEOUT. */
    int (*command)(struct hal_bus *bus, uint8_t command, const uint8_t *args, uint32_t n);

    /* Begin to send n bytes of pixels (D/C high).
     * Buffer  borrowed and not to be written from this call until wait returns; not borrowed on a negative
     *         return. 2-byte aligned. Where data caches are on, this call cleans the range.
     * Blocks  no longer than it takes to begin; a bus without DMA sends here.
     * Return  HAL_ERR_NONE; HAL_ERR_ARG (NULL, or n is 0); HAL_ERR_STATE while other data is out; _BUS, _TIMEOUT. */
    int (*data)(struct hal_bus *bus, const uint8_t *bytes, uint32_t n);

    /* Wait until the data is out, the last bit included. Nothing is out: HAL_ERR_NONE at once.
     * Blocks  for the rest of the transfer, at most a small multiple of its time. Interrupts are on afterwards:
     *         where one ends the transfer, it could not end with them off.
     * Return  HAL_ERR_NONE, or why the transfer failed. In both cases nothing is out any more and the bytes are the
     *         caller's. */
    int (*wait)(struct hal_bus *bus);

    /* Pull the panel's RESET line for as long as the controllers here want (10 us and more), and release it.
     * Without such a line: nothing. Blocks that long. Not while data is out (HAL_ERR_STATE). */
    int (*reset)(struct hal_bus *bus);

    /* Let at least us microseconds pass; before hal_init: none. Blocks. */
    void (*delay)(struct hal_bus *bus, uint32_t us);

    struct hal_hooks hooks;
};

/* ---- The board ----------------------------------------------------------------------------------------- */

/* Bring clocks, the tick counter and the bus up. First call of a program; again: no effect.
 * Blocks  a moment.
 * Return  HAL_ERR_NONE, or a negative code: nothing else may be called then but hal_exit. */
int hal_init(void);

/* Stop. status 0 is success. Flushes text. Never returns: a board without a host waits for reset. */
void hal_exit(int status);

/* Write text, ending at its NUL, to whatever a person reads: semihosting, a UART, stdout.
 * Blocks  until the text has been taken over; text is not kept. */
void hal_write(const char *text);

/* Ticks since hal_init, never backwards; does not wrap in practice.
 * Blocks  no. ISR-safe  no: below the tick's own interrupt it would miss a wrap. */
uint64_t hal_ticks(void);

/* Ticks to a second of real time; 0: ticks are not time. Blocks  no. ISR-safe  yes. */
uint32_t hal_tick_hz(void);

/* What a tick is worth in executed instructions; 0: ticks say nothing of instructions.
 * Instructions are not cycles: print them as what they are. Blocks  no. ISR-safe  yes. */
uint32_t hal_tick_instructions(void);

/* The bus of the board's panel, the same at each call, from hal_init on; never NULL. A board without a panel has
 * one that takes everything and sends it nowhere. Static storage. */
struct hal_bus *hal_bus(void);

/* Light behind the glass: 0 dark, 255 full; where it can only be switched, from 1 on full. Panels that make their own
 * light take panel_brightness; a board without such a line does nothing. Blocks  no. */
void hal_backlight(uint8_t level);

/* Fill the unused part of the stack with a pattern. Blocks  a moment. */
void hal_stack_paint(void);

/* Bytes of stack, counted from its top, that have been touched since hal_stack_paint, the caller's own
 * included; 0: this HAL cannot tell. Blocks  a moment. */
uint32_t hal_stack_used(void);

#ifdef __cplusplus
}
#endif

#endif
