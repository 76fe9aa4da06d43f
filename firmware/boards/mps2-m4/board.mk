# QEMU's mps2-an386: Cortex-M4. Built for soft float: nothing switches the FPU on, so an instruction of it is a fault.
include firmware/boards/mps2/board.mk
BOARD_ABOUT = Cortex-M4 in QEMU (mps2-an386), to count instructions; no panel
BOARD_CPU = -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
MPS2 = mps2-an386
