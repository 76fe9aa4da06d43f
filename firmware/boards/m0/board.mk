# QEMU's micro:bit as a Cortex-M0 to count and to check, without a panel: 256 KB of flash, 16 KB of RAM. BOARD=microbit
# is the part itself. QEMU gives it a SysTick that the nRF51 lacks; at 16 MHz two ticks are 125 instructions.
BOARD_ABOUT = Cortex-M0 in QEMU (microbit), to count instructions; no panel
include firmware/boards/cortexm/cortexm.mk
BOARD_CPU = -mcpu=cortex-m0 -mthumb -DHAL_TICK_INSTRUCTIONS_X2=125
BOARD_HAL = mps2
BOARD_SRC += hal/null/bus.c hal/cortexm/semihost.c
BOARD_RUN = qemu-system-arm -M microbit $(QEMU_COUNTS)
