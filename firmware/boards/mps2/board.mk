# QEMU's mps2-an385: Cortex-M3, no FPU, 4 MB of code RAM, 4 MB of RAM. To count and to check, without a panel.
BOARD_ABOUT = Cortex-M3 in QEMU (mps2-an385), to count instructions; no panel
include firmware/boards/cortexm/cortexm.mk
BOARD_CPU = -mcpu=cortex-m3 -mthumb
BOARD_HAL = mps2
BOARD_SRC += hal/null/bus.c hal/cortexm/semihost.c hal/semihosting/semihosting.c
MPS2 = mps2-an385
BOARD_LD = firmware/boards/mps2/mps2.ld
BOARD_RUN = qemu-system-arm -M $(MPS2) $(QEMU_COUNTS)
