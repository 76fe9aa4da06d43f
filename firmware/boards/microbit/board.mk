# BBC micro:bit v1: nRF51822, Cortex-M0 at 16 MHz, 16 KB of RAM, 256 KB of flash. The wiring: hal/nrf51/pins.h. The
# ILI9341's 320x240 shows 160x128 in its middle: one strip of 8 rows and a small pool are what RAM holds beside the
# stack. DEFINES=-DPANEL_ON_UART=1: for QEMU, and without a panel.
BOARD_ABOUT = BBC micro:bit v1: nRF51822, Cortex-M0, 16 KB of RAM; ILI9341, of it 160x128
BOARD_FLASH = 262144
BOARD_RAM = 16384
BOARD_IMAGES = hex
include firmware/boards/cortexm/cortexm.mk
BOARD_CPU = -mcpu=cortex-m0 -mthumb
BOARD_HAL = nrf51
BOARD_SRC := $(filter-out hal/cortexm/systick.c,$(BOARD_SRC)) hal/cortexm/board.c hal/spi/spi_bus.c
BOARD_RUN = echo Drag onto the drive of the micro:bit the .hex of
BOARD_FLAGS = -DSHOW_PANEL=panel_ili9341 -DSHOW_GLASS_WIDTH=240 -DSHOW_GLASS_HEIGHT=320 -DSHOW_ROTATE=1 \
    -DSHOW_INVERT=0 -DSHOW_BGR=1 -DSHOW_WIDTH=160 -DSHOW_HEIGHT=128 -DSHOW_X=80 -DSHOW_Y=56 -DSHOW_SUBPIXEL=4 \
    -DSHOW_BUFFERS=1 -DSHOW_ROWS_MAX=8 -DSHOW_TRIS_MAX=96 -DSHOW_VERTS_MAX=184
