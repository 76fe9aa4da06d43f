# QEMU's micro:bit: Cortex-M0 (Armv6-M, the instruction set of the M0+), 256 KB of flash, 16 KB of RAM. QEMU gives it
# a SysTick that the real nRF51 lacks; at 16 MHz two ticks are 125 instructions under -icount shift=0.
BOARD_CC = arm-none-eabi-gcc
BOARD_CPU = -mcpu=cortex-m0plus -mthumb -DHAL_TICK_INSTRUCTIONS_X2=125
BOARD_HAL = mps2
BOARD_SRC = firmware/boards/mps2/startup.c
BOARD_DEPS = firmware/boards/microbit/microbit.ld
BOARD_LINK = -T firmware/boards/microbit/microbit.ld -nostartfiles
BOARD_RUN = qemu-system-arm -M microbit -display none -monitor none -serial null \
            -semihosting-config enable=on,target=native -icount shift=0 -kernel
