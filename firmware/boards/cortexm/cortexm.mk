# Cortex-M boards with SysTick; a board.mk that includes this may add to each
BOARD_CC = arm-none-eabi-gcc
DATA_CPU = -mcpu=cortex-m0 -mthumb
BOARD_SRC = firmware/boards/cortexm/startup.c hal/stack/stack.c hal/cortexm/systick.c
BOARD_LD = firmware/boards/$(BOARD)/$(BOARD).ld
BOARD_DEPS = $(BOARD_LD) firmware/boards/cortexm/sections.ld
BOARD_LINK = -T $(BOARD_LD) -Lfirmware/boards -nostartfiles
