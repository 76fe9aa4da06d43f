# STM32F405RG: Cortex-M4 at 168 MHz, 1 MB of flash, 128 KB of RAM. The wiring: hal/stm32f4/pins.h. Strips of 40 rows and
# 3200 vertices leave room for the pools of every scene; flyover asks for more, and may take a second pass.
BOARD_ABOUT = STM32F405 (Pyboard, Feather STM32F405): Cortex-M4; ST7789 240x240
BOARD_FLASH = 1048576
BOARD_RAM = 131072
BOARD_IMAGES = bin hex
include firmware/boards/cortexm/cortexm.mk
BOARD_CPU = -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
BOARD_SRC += hal/cortexm/board.c hal/spi/spi_bus.c
BOARD_HAL = stm32f4
BOARD_FLAGS = -DSHOW_ROWS_MAX=40 -DSHOW_VERTS_MAX=3200
BOARD_RUN = echo Flash at 0x08000000 the .bin, or the .hex, of
