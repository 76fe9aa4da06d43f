# An application for a board: make -f firmware/boards/firmware.mk BOARD=mps2 APP=bench [run]
# From the repository's top. Lands in $(B)/fw/$(BOARD)/$(APP).elf. Needs the meshes in $(B)/gen.
BOARD = mps2
APP = bench
B = build
OPT = -O2
include firmware/boards/$(BOARD)/board.mk

OUT = $(B)/fw/$(BOARD)
ELF = $(OUT)/$(APP).elf
SRC = firmware/app/$(APP).c hal/$(BOARD_HAL)/hal.c $(BOARD_SRC) $(wildcard firmware/zstrip/*.c) \
      $(wildcard firmware/scenes/*.c) $(wildcard $(B)/gen/*.c)
OBJ = $(patsubst %.c,$(OUT)/%.o,$(SRC))
CFLAGS = -std=c11 $(BOARD_CPU) $(OPT) -g -ffunction-sections -fdata-sections -MMD -MP \
         -Wall -Wextra -Werror -Wconversion -Wshadow -Wvla -Wstrict-prototypes -Wmissing-prototypes \
         -Wno-missing-field-initializers \
         -Ihal -Ifirmware/zstrip -Ifirmware/scenes -I$(B)/gen

.DELETE_ON_ERROR:
all: $(ELF)
run: $(ELF)
	@$(BOARD_RUN) $(ELF)
$(ELF): $(OBJ) $(BOARD_DEPS)
	$(BOARD_CC) $(BOARD_CPU) $(OPT) -Wl,--gc-sections $(BOARD_LINK) $(OBJ) -o $@
$(OUT)/%.o: %.c firmware/boards/$(BOARD)/board.mk
	@mkdir -p $(@D)
	$(BOARD_CC) $(CFLAGS) -c $< -o $@
-include $(OBJ:.o=.d)
.PHONY: all run
