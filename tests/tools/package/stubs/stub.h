/* The display behind every stub: 240x240 px of RGB565, most significant byte first. What arrives there is compared.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef STUB_H
#define STUB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define STUB_W 240
#define STUB_H_PX 240

/* A rectangle of pixels; swapped: least significant byte first. Exits where it is outside of the display. */
void stub_put(int x, int y, int w, int h, const void *px, int swapped);
/* The picture into the file that argv[1] names. */
int stub_write(const char *file);
/* Bytes over a panel's wire, level of D/C beside them: pixels of a memory write (0x2c), from the display's top on. */
void stub_wire(const uint8_t *bytes, uint32_t n, int data);

#ifdef __cplusplus
}
#endif

#endif
