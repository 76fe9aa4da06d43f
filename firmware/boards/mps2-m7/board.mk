# QEMU's mps2-an500: Cortex-M7. Built for soft float: nothing switches the FPU on, so an instruction of it is a fault.
# No caches, no double issue: what is counted are instructions.
include firmware/boards/mps2/board.mk
BOARD_ABOUT = Cortex-M7 in QEMU (mps2-an500), to count instructions; no panel
BOARD_CPU = -mcpu=cortex-m7 -mfloat-abi=soft -mthumb
MPS2 = mps2-an500
