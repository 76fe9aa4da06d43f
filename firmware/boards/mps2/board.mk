# QEMU's mps2-an385: Cortex-M3, no FPU, 4 MB of code RAM, 4 MB of RAM.
BOARD_CC = arm-none-eabi-gcc
BOARD_CPU = -mcpu=cortex-m3 -mthumb
BOARD_HAL = mps2
BOARD_SRC = firmware/boards/mps2/startup.c
BOARD_DEPS = firmware/boards/mps2/mps2.ld
BOARD_LINK = -T firmware/boards/mps2/mps2.ld -nostartfiles
BOARD_RUN = qemu-system-arm -M mps2-an385 -display none -monitor none -serial null \
            -semihosting-config enable=on,target=native -icount shift=0 -kernel
