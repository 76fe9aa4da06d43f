# An application for a board: make -f firmware/boards/firmware.mk BOARD=mps2 APP=bench [run]
# From the repository's top. Lands in $(B)/fw/$(BOARD)/$(APP).elf. Needs the meshes in $(B)/gen.
#
# APP=show SCENE=teapot, or APP_SCENE=path/to/scene.c: the show of that scene, $(B)/fw/$(BOARD)/teapot.elf (scene.elf)
# NAME=name APP_SRC=files [EXTRA=objects]: any other program
# DEFINES='-DPIN_RESET=14 -DSPI_DIVIDER=4': what sources leave to the compiler's -D; another choice compiles all anew
BOARD = mps2
APP = bench
SCENE = teapot
B = build
OPT = -O2
OUT = $(B)/fw/$(BOARD)

NAME = $(APP)
APP_SRC = firmware/app/$(APP).c
ifeq ($(APP),show)
ifeq ($(SCENE),mine)
APP_SCENE = firmware/app/my_scene.c
endif
ifdef APP_SCENE
ifeq ($(wildcard $(APP_SCENE)),)
$(error APP_SCENE=$(APP_SCENE): no such file; copy firmware/app/my_scene.c to begin one)
endif
NAME = $(basename $(notdir $(APP_SCENE)))
APP_SRC += $(APP_SCENE)
else
ifeq ($(shell grep 'define SIZES_$(SCENE) ' firmware/scenes/sizes.h),)
$(error SCENE=$(SCENE): not in firmware/scenes/sizes.h, and not mine)
endif
NAME = $(SCENE)
APP_SRC += firmware/app/show_demo.c
APP_FLAGS = -DSHOW_DEMO=$(SCENE)
endif
endif
ELF = $(OUT)/$(NAME).elf

DEFINES =

all: $(ELF)
image: $(ELF)
ifeq ($(wildcard firmware/boards/$(BOARD)/board.mk),)
$(error BOARD=$(BOARD): no such board; there are $(notdir $(patsubst %/board.mk,%,$(wildcard firmware/boards/*/board.mk))))
endif
include firmware/boards/$(BOARD)/board.mk

# What names no scene is compiled once, the rest once a scene
SRC = $(wildcard hal/$(BOARD_HAL)/*.c hal/panel/*.c) $(BOARD_SRC) $(wildcard firmware/zstrip/*.c) \
      $(wildcard firmware/scenes/*.c) $(wildcard $(B)/gen/*.c)
OBJ = $(patsubst %,$(OUT)/%.o,$(basename $(SRC))) $(patsubst %.c,$(OUT)/of-$(NAME)/%.o,$(APP_SRC))
CFLAGS = -std=c11 $(BOARD_CPU) $(OPT) -g -ffunction-sections -fdata-sections -MMD -MP \
         -Wall -Wextra -Werror -Wconversion -Wshadow -Wvla -Wstrict-prototypes -Wmissing-prototypes \
         -Wno-missing-field-initializers \
         -Ihal -Ihal/panel -Ifirmware/app -Ifirmware/zstrip -Ifirmware/scenes -I$(B)/gen $(DEFINES)

# Notes of what was built last, written anew where that changes: objects and images are as old as these
note = $(shell mkdir -p $(dir $1); echo '$2' | cmp -s - $1 || echo '$2' >$1)$1
DEFINED := $(call note,$(OUT)/defines,$(DEFINES))
LINKED := $(call note,$(OUT)/of-$(NAME)/objects,$(OBJ) $(EXTRA))

.DELETE_ON_ERROR:
run: $(ELF)
	@$(BOARD_RUN) $(ELF)
$(ELF): $(OBJ) $(EXTRA) $(BOARD_DEPS) $(LINKED)
	$(BOARD_CC) $(BOARD_CPU) $(OPT) -Wl,--gc-sections $(BOARD_LINK) $(OBJ) $(EXTRA) -o $@
$(OUT)/of-$(NAME)/%.o: %.c firmware/boards/$(BOARD)/board.mk $(DEFINED)
	@mkdir -p $(@D)
	$(BOARD_CC) $(CFLAGS) $(APP_FLAGS) -c $< -o $@
$(OUT)/%.o: %.c firmware/boards/$(BOARD)/board.mk $(DEFINED)
	@mkdir -p $(@D)
	$(BOARD_CC) $(CFLAGS) -c $< -o $@
$(OUT)/%.o: %.S firmware/boards/$(BOARD)/board.mk
	@mkdir -p $(@D)
	$(BOARD_CC) $(BOARD_CPU) -c $< -o $@
-include $(OBJ:.o=.d)
.PHONY: all image run
