/* Panels that hal/panel drives, as zsim names them, and what glass they come on. SPDX-License-Identifier: MIT */

/** name: zsim's --panel; '' draws without a panel's driver, at the width and height that are set. */
export const PANELS = [
    { name: 'st7789:240x240', title: 'ST7789', text: '240 × 240, RGB565', width: 240, height: 240 },
    { name: 'st7789:240x320', title: 'ST7789', text: '240 × 320, RGB565', width: 240, height: 320 },
    { name: 'st7789:135x240', title: 'ST7789', text: '135 × 240, RGB565', width: 135, height: 240 },
    { name: 'ili9341:240x320', title: 'ILI9341', text: '240 × 320, RGB565', width: 240, height: 320 },
    {
        name: 'gc9a01:240x240',
        title: 'GC9A01',
        text: '240 × 240, round, RGB565',
        width: 240,
        height: 240,
        round: true,
    },
    { name: 'ssd1351:128x128', title: 'SSD1351', text: '128 × 128, OLED, RGB565', width: 128, height: 128 },
    { name: 'ssd0323:128x64', title: 'SSD0323', text: '128 × 64, 16 greys', width: 128, height: 64, bits: 4 },
    { name: 'ssd1306:128x64', title: 'SSD1306', text: '128 × 64, one bit', width: 128, height: 64, bits: 1 },
    { name: '', title: 'Any', text: 'of your own size', width: 240, height: 240 },
];
