# QEMU's micro:bit as a Cortex-M0 to count and to check, without a panel. BOARD=microbit is the part itself. QEMU gives
# it a SysTick that the nRF51 lacks, at 16 MHz: a tick is 62.5 instructions, and hal_tick_instructions says 0.
include firmware/boards/microbit/board.mk
BOARD_ABOUT = Cortex-M0 in QEMU (microbit), to count instructions; no panel
BOARD_IMAGES =
BOARD_FLAGS = -DHAL_TICK_INSTRUCTIONS=0
BOARD_HAL = mps2
BOARD_SRC := $(filter-out hal/spi/spi_bus.c hal/cortexm/board.c,$(BOARD_SRC)) hal/cortexm/systick.c hal/null/bus.c \
             hal/cortexm/semihost.c hal/semihosting/semihosting.c
BOARD_LD = firmware/boards/microbit/microbit.ld
BOARD_RUN = qemu-system-arm -M microbit $(QEMU_COUNTS)
