# QEMU's virt board with one RISC-V hart, rv32imc in machine mode: any instruction beyond i, m, c (and the CSRs') traps.
# To count and to check, without a panel. C library: picolibc.
BOARD_ABOUT = RISC-V in QEMU (virt, rv32imc), to count instructions; no panel
BOARD_CC = riscv64-unknown-elf-gcc
BOARD_CPU = -march=rv32imc -mabi=ilp32 -msmall-data-limit=0 --specs=picolibc.specs
BOARD_HAL = rv32
BOARD_SRC = firmware/boards/rv32/startup.c hal/null/bus.c hal/semihosting/semihosting.c \
            hal/stack/stack.c
BOARD_DEPS = firmware/boards/rv32/rv32.ld firmware/boards/cortexm/sections.ld
BOARD_LINK = -T firmware/boards/rv32/rv32.ld -Lfirmware/boards -nostartfiles
BOARD_FLASH = 4194304
BOARD_RAM = 4194304
RV32_NOT = a f d h s u sstc Zifencei Zihintpause zba zbb zbc zbs mmu pmp
BOARD_RUN = qemu-system-riscv32 -M virt -bios none -cpu rv32 $(RV32_NOT:%=-global rv32-riscv-cpu.%=off) $(QEMU_COUNTS)
