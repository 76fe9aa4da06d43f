# Stellaris LM3S6965EVB: Cortex-M3 at 50 MHz, 256 KB of flash, 64 KB of RAM; its OLED has 128x64 pixels of 16 greys.
# QEMU has all of it, and draws the OLED: in a window where Debian's qemu-system-gui is installed, else over VNC. The
# wiring: hal/lm3s6965/pins.h.
BOARD_ABOUT = Stellaris LM3S6965EVB: Cortex-M3; SSD0323 128x64 grey, which QEMU draws
BOARD_FLASH = 262144
BOARD_RAM = 65536
BOARD_IMAGES = bin
include firmware/boards/cortexm/cortexm.mk
BOARD_CPU = -mcpu=cortex-m3 -mthumb
BOARD_SRC += hal/cortexm/board.c hal/spi/spi_bus.c
BOARD_HAL = lm3s6965
BOARD_FLAGS = -DSHOW_WIDTH=128 -DSHOW_HEIGHT=64 -DSHOW_PANEL=panel_ssd0323 -DSHOW_PIXEL_BITS=4 -DSHOW_INVERT=0 \
              -DSHOW_BUFFERS=1 -DSHOW_ROWS_MAX=8 -DSHOW_TRIS_MAX=1280 -DSHOW_VERTS_MAX=1664
BOARD_RUN = qemu-system-arm -M lm3s6965evb -serial stdio -kernel
