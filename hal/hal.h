/* The whole contract with hardware. One implementation is linked into a binary: hal/null (what a porter
 * copies), hal/host (a program on a PC), hal/mps2 (QEMU's Cortex-M3). They are peers.
 *
 * This header knows nothing of the renderer: it moves text, ticks and finished strips of pixels.
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
    HAL_OK = 0,
    HAL_ERR_STATE = -101,  /* hal_init missing, or a strip sent while one is still out */
    HAL_ERR_ARG = -102,    /* a NULL pointer, or an empty strip */
    HAL_ERR_CHANGED = -103 /* hal/host: a borrowed strip was written to */
};

/* Finished pixels on their way out. */
struct hal_strip {
    uint16_t x, y, w, h; /* px in the frame */
    uint16_t last;       /* 1 in the frame's last strip */
    const uint8_t *px;   /* n_bytes bytes in the panel's own format, row-major, dense */
    uint32_t n_bytes;
};

/* Bring clocks, the tick counter and the output up. First call of a program; again: no effect.
 * Blocks  a moment.
 * Return  HAL_OK, or a negative code: nothing else may be called then but hal_exit. */
int hal_init(void);

/* Stop. status 0 is success. Flushes text. Never returns: a board without a host waits for reset. */
void hal_exit(int status);

/* Write text, ending at its NUL, to whatever a person reads: semihosting, a UART, stdout.
 * Blocks  until the text has been taken over; text is not kept. */
void hal_write(const char *text);

/* Ticks since hal_init, never backwards; does not wrap in practice.
 * Blocks  no. ISR-safe  no: below the tick's own interrupt it would miss a wrap. */
uint64_t hal_ticks(void);

/* What a tick is worth in executed instructions; 0: ticks are time, and say nothing of instructions.
 * Instructions are not cycles: print them as what they are. Blocks  no. ISR-safe  yes. */
uint32_t hal_tick_instructions(void);

/* Start moving a strip out. *strip itself is copied.
 * Buffer  strip->px is borrowed and must not be written from this call until hal_strip_wait returns; on a
 *         negative return it was not borrowed. Where data caches are on, this call cleans the range itself.
 * Blocks  no longer than it takes to start a transfer; a HAL without DMA moves the strip here.
 * Return  HAL_OK; HAL_ERR_ARG; HAL_ERR_STATE where the strip before it was not waited for. */
int hal_strip_send(const struct hal_strip *strip);

/* Wait until the strip that was sent is out and its pixels are the caller's again. None is out: no effect.
 * Blocks  for the rest of the transfer.
 * Return  HAL_OK, or why that transfer failed (the pixels are the caller's all the same). */
int hal_strip_wait(void);

/* Fill the unused part of the stack with a pattern. Blocks  a moment. */
void hal_stack_paint(void);

/* Bytes of stack, counted from its top, that have been touched since hal_stack_paint, the caller's own
 * included; 0: this HAL cannot tell. Blocks  a moment. */
uint32_t hal_stack_used(void);

#ifdef __cplusplus
}
#endif

#endif
