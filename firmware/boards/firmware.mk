# An application for a board: make -f firmware/boards/firmware.mk BOARD=mps2 APP=bench [run]
# From the repository's top. Lands in $(B)/fw/$(BOARD)/$(APP).elf. Needs the meshes in $(B)/gen.
#
# APP=show SCENE=teapot, or APP_SCENE=path/to/scene.c: the show of that scene, $(B)/fw/$(BOARD)/teapot.elf (scene.elf);
#   APP_SCENE='scene.c thing.c': with what else it is made of, such as a converted model
# NAME=name APP_SRC=files [APP_FLAGS=flags] [EXTRA=objects] [APP_LINK=flags]: any other program; flags of the compiler
#   and of the linker
# DEFINES='-DPIN_RESET=14 -DSPI_DIVIDER=4': what sources leave to the compiler's -D, before what the board says of them;
#   another choice compiles all anew that sees it: the renderer sees -DZS_... alone
# METHOD=painter: the show by a method of hidden-surface removal (zs_method.h), $(ELF) with _painter in its name
# LEAN=1: least flash: no accelerators (firmware/zstrip/fast is not compiled), -Os; $(B)/fw/$(BOARD)-lean
# CORES=2: the show is drawn by two cores, $(B)/fw/$(BOARD)-2
#
# A board is a folder with a board.mk, which says:
#   BOARD_ABOUT  one line for `make help`           BOARD_CC, BOARD_CPU  compiler, and its flags for the core
#   DATA_CPU     the same for data alone, where cores share it; BOARD_CPU where it is not set
#   BOARD_HAL    folder of hal/, all of it linked    BOARD_SRC   other sources: start-up, shared parts of HALs
#   BOARD_LINK   flags for the linker, BOARD_DEPS    files that they name, BOARD_LIBS    libraries
#   BOARD_RUN    command that takes the .elf         BOARD_IMAGES  what is flashed: bin, hex; more by rules of its own
#   BOARD_FLAGS  -D for the application (show.h has them), BOARD_FLASH, BOARD_RAM  bytes of the part
#   BOARD_SECOND sources of hal/second.h, for CORES=2; not set where the part has one core
MAKEFLAGS += -r # as in Makefile
BOARD = mps2
APP = bench
SCENE = teapot
B = build
override B := $(patsubst $(CURDIR)/%,%,$(B))# one name for an object, or what depends on a header is not made anew
LEAN = 0
CORES = 1
OPT = -O2
DEBUG ?= -g
OUT = $(B)/fw/$(BOARD)$(if $(filter 1,$(LEAN)),-lean)$(if $(filter 2,$(CORES)),-2)

NAME = $(APP)
APP_SRC = firmware/app/$(APP).c
ifeq ($(APP),show)
ifeq ($(SCENE),mine)
APP_SCENE = firmware/app/my_scene.c
endif
ifdef APP_SCENE
ifneq ($(words $(wildcard $(APP_SCENE))),$(words $(APP_SCENE)))
$(error APP_SCENE=$(APP_SCENE): no such file; copy firmware/app/my_scene.c to begin one)
endif
NAME = $(basename $(notdir $(firstword $(APP_SCENE))))
APP_SRC += $(APP_SCENE)
else
ifeq ($(shell grep 'define SIZES_$(SCENE) ' firmware/scenes/sizes.h),)
$(error SCENE=$(SCENE): not in firmware/scenes/sizes.h, and not mine)
endif
NAME = $(SCENE)
APP_SRC += firmware/app/show_demo.c
APP_FLAGS = -DSHOW_DEMO=$(SCENE)
ifneq ($(wildcard firmware/scenes/pieces/$(SCENE).c),)
ifeq ($(CORES)$(shell grep 'define SIZES_2_$(SCENE) ' firmware/scenes/sizes.h),2)
$(error SCENE=$(SCENE): CORES=1; there is no SIZES_2_$(SCENE) in firmware/scenes/sizes.h)
endif
APP_SRC += firmware/scenes/pieces/$(SCENE).c
APP_FLAGS += -DSHOW_PIECE=1
endif
endif
METHODS_KNOWN := $(shell sed -n 's/^extern const struct zs_method zs_method_\([a-z]*\);/\1/p' \
                          firmware/zstrip/zs_method.h)
ifneq ($(filter-out $(METHODS_KNOWN),$(METHOD)),)
$(error METHOD=$(METHOD): no such method; there are $(METHODS_KNOWN), and none: the depth buffer)
endif
ifdef METHOD
ifneq ($(filter -DSHOW_PIECE=1,$(APP_FLAGS)),)
$(error METHOD=$(METHOD): SCENE=$(SCENE) is drawn in passes or has effects, by a method of its own)
endif
NAME := $(NAME)_$(METHOD)
APP_FLAGS += -include zs_method.h -DSHOW_METHOD=zs_method_$(METHOD) \
             $(if $(filter painter,$(METHOD)),-DSHOW_NO_KEYS=1 -DSHOW_MAPPING=\&zs_depth_none) \
             $(if $(filter depthsort coverage,$(METHOD)),-DSHOW_NO_KEYS=1 -DSHOW_MAPPING=\&zs_depth_order) \
             $(if $(filter depthsort coverage raycast,$(METHOD)),-DSHOW_RECORDS=1)
endif
endif
ELF = $(OUT)/$(NAME).elf

DEFINES =

all: $(ELF)
ifeq ($(wildcard firmware/boards/$(BOARD)/board.mk),)
BOARDS = $(notdir $(patsubst %/board.mk,%,$(wildcard firmware/boards/*/board.mk)))
$(error BOARD=$(BOARD): no such board; there are $(BOARDS))
endif
# What runs images whose ticks are instructions: one takes one virtual nanosecond. Without QEMU_ICOUNT they are not, and
# a run is over sooner
QEMU_ICOUNT = -icount shift=0
QEMU_COUNTS = -display none -monitor none -serial null -semihosting-config enable=on,target=native \
              $(QEMU_ICOUNT) -kernel
OBJCOPY = $(BOARD_CC:gcc=objcopy)
SIZE = $(BOARD_CC:gcc=size)
include firmware/boards/$(BOARD)/board.mk
ifneq ($(LEAN),0)
ifneq ($(LEAN)$(CORES),11)
$(error LEAN=$(LEAN) CORES=$(CORES): LEAN is 0, or 1 with CORES=1: two cores share a scene by an accelerator)
endif
OPT = -Os
endif
ifneq ($(CORES),1)
ifneq ($(CORES)$(if $(BOARD_SECOND),,none),2)
$(error CORES=$(CORES): 1, or 2 where the board has a second core: pico)
endif
BOARD_SRC += $(BOARD_SECOND)
BOARD_FLAGS += -DSHOW_CORES=2
ifeq ($(APP),show)
APP_SRC += firmware/app/pair.c
endif
endif

# What names no scene is compiled once, the rest once a scene
# method/, effect/, overlay/, zs_explain and hal/panel/ are compiled where the program's own sources, headers of
# their names, or in a project of its own any header beside them, name something of them
NAMING := $(APP_SRC) $(wildcard $(APP_SRC:.c=.h) \
                                $(addsuffix *.h,$(filter-out firmware/%,$(sort $(dir $(APP_SRC))))))
METHODS := $(METHOD)$(shell grep -lE 'zs_method|zs_lines|zs_points|zs_depth_order|zs_shade_(plain|none)' $(NAMING))
EFFECTS := $(shell grep -lE '[<"]zs_(lights|filter|blend|environment|shadow|supersample|dither)\.h[>"]|ZS_POSITIONS' \
                        $(NAMING))
OVERLAYS := $(shell grep -lE '[<"]zs_(overlay|fog|dither)\.h[>"]' $(NAMING))
EXPLAINS := $(shell grep -lE '[<"]zs_explain\.h[>"]' $(NAMING))
CORE := $(filter-out $(if $(filter 1,$(LEAN)),firmware/zstrip/fast/%) \
                    $(if $(EXPLAINS),,firmware/zstrip/support/explain%) \
                    $(if $(METHODS)$(EFFECTS),,firmware/zstrip/method/%) \
                    $(if $(EFFECTS),,firmware/zstrip/effect/%) $(if $(OVERLAYS),,firmware/zstrip/overlay/%),\
                    $(wildcard firmware/zstrip/*/*.c))
PANELS := $(if $(shell grep -lE '[<"]panel\.h[>"]' $(NAMING)),$(wildcard hal/panel/*.c))
# CORE_OBJ=DIR: the renderer as objects that lie there, made by tests/lib/checksum_program.sh with DEFINES
CORE_OBJ =
COMMON := $(PANELS) $(if $(CORE_OBJ),,$(CORE)) $(wildcard firmware/scenes/*.c $(B)/gen/meshes.c)
SRC := $(wildcard hal/$(BOARD_HAL)/*.c) $(BOARD_SRC) $(COMMON)
OBJ := $(patsubst %,$(OUT)/%.o,$(basename $(SRC))) $(patsubst %.c,$(OUT)/of-$(NAME)/%.o,$(APP_SRC)) \
      $(if $(CORE_OBJ),$(foreach c,$(CORE:.c=.o),$(CORE_OBJ)/$(subst /,-,$c)))
CFLAGS = -std=c11 $(BOARD_CPU) $(OPT) $(DEBUG) -ffunction-sections -fdata-sections -MMD -MP \
         -Wall -Wextra $(WERROR) -Wconversion -Wshadow -Wvla -Wstrict-prototypes -Wmissing-prototypes \
         -Wno-missing-field-initializers \
         -Ihal -Ihal/null -Ihal/cortexm -Ihal/semihosting -Ihal/spi -Ihal/panel -Ifirmware/app -Ifirmware/zstrip \
         -Ifirmware/scenes -Ifirmware/scenes/pieces $(GEN) \
         $(if $(filter 1,$(LEAN)),-DZS_NO_FAST=1) $(BOARD_FLAGS) \
         $(foreach d,$(DEFINES),-U$(firstword $(subst =, ,$(d:-D%=%))) $d)

# Notes of what was built last, written anew where that changes: objects and images are as old as these
include firmware/boards/note.mk
DEFINED := $(call note,$(OUT)/defines,$(DEFINES))
DEFINED_ZS := $(call note,$(OUT)/defines-zs,$(filter -DZS_%,$(DEFINES)))
FLAGGED := $(call note,$(OUT)/of-$(NAME)/flags,$(APP_FLAGS))
LINKED := $(call note,$(OUT)/of-$(NAME)/objects,$(OBJ) $(EXTRA) $(APP_LINK))

# All of the renderer, for make library: $(OUT)/libzstrip.a
LIBRARY_OBJ := $(patsubst %.c,$(OUT)/%.o,$(filter-out $(if $(filter 1,$(LEAN)),firmware/zstrip/fast/%),\
                                                     $(wildcard firmware/zstrip/*/*.c)))

FOLDERS := $(shell mkdir -p $(sort $(dir $(OBJ) $(LIBRARY_OBJ)))) # all at once, not one before each object

# What knows nothing of the board is compiled the same for all boards of a core, once where ccache is in the path: of
# DEFINES it takes the library's alone, -DZS_...
COMMON_OBJ := $(patsubst %.c,$(OUT)/%.o,$(COMMON))
GEN = -I$(B)/gen
# The renderer and the panels do not see the build folder either, so that ccache has them for projects elsewhere, too
$(LIBRARY_OBJ) $(patsubst %.c,$(OUT)/%.o,$(PANELS)): GEN =
$(sort $(COMMON_OBJ) $(LIBRARY_OBJ)): BOARD_FLAGS =
$(sort $(COMMON_OBJ) $(LIBRARY_OBJ)): override DEFINES := $(filter -DZS_%,$(DEFINES))
$(sort $(COMMON_OBJ) $(LIBRARY_OBJ)): $(DEFINED_ZS)
$(filter-out $(COMMON_OBJ) $(LIBRARY_OBJ) $(CORE_OBJ:%=%/%),$(OBJ)): $(DEFINED)
# Meshes are data: the same for all cores of a kind
MESH_OBJ = $(OUT)/$(B)/gen/meshes.o
$(MESH_OBJ): override BOARD_CPU := $(or $(DATA_CPU),$(BOARD_CPU))
$(MESH_OBJ): override OPT = -O1
$(MESH_OBJ): override DEBUG =
$(MESH_OBJ): override LEAN = 0
$(MESH_OBJ): override DEFINES =

# Said where an image is too large for its board
FULL = $(BOARD): $(NAME) does not fit it. Pools take most of the RAM: give fewer triangles, vertices or \
       rows of a strip, in your program or, for the show, by \
       DEFINES="-DSHOW_TRIS_MAX=500 -DSHOW_VERTS_MAX=500 -DSHOW_ROWS_MAX=8". zsim budget says what fits.

.DELETE_ON_ERROR:
run: $(ELF)
	@$(BOARD_RUN) $(ELF)
$(ELF): $(OBJ) $(EXTRA) $(BOARD_DEPS) $(LINKED)
	$(BOARD_CC) $(BOARD_CPU) $(OPT) -Wl,--gc-sections $(BOARD_LINK) $(APP_LINK) $(OBJ) $(EXTRA) $(BOARD_LIBS) -o $@ \
	    2>$@.log || \
	    { cat $@.log >&2; ! grep -q overflowed $@.log || echo '$(FULL)' >&2; exit 1; }
	@cat $@.log >&2; rm -f $@.log
$(OUT)/of-$(NAME)/%.o: %.c firmware/boards/$(BOARD)/board.mk $(FLAGGED)
	$(BOARD_CC) $(CFLAGS) $(APP_FLAGS) -c $< -o $@
$(OUT)/%.o: %.c firmware/boards/$(BOARD)/board.mk
	$(BOARD_CC) $(CFLAGS) -c $< -o $@
$(OUT)/%.o: %.S firmware/boards/$(BOARD)/board.mk
	$(BOARD_CC) $(BOARD_CPU) -c $< -o $@

# What is flashed, and what it takes of the part: sections that lie in RAM are zeros, data and stack
image: $(ELF) $(BOARD_IMAGES:%=$(OUT)/$(NAME).%)
	@$(SIZE) -A $(ELF) | awk -v what='$(OUT)/$(NAME).elf $(addprefix .,$(BOARD_IMAGES))' -v flash='$(BOARD_FLASH)' \
	    -v ram='$(BOARD_RAM)' '{ n[$$1] = $$2 } END { printf "%s: flash %d%s bytes, RAM %d%s, of it %d for the stack\n", \
	        what, n[".boot2"] + n[".vectors"] + n[".once"] + n[".text"] + n[".rodata"] + n[".ARM.exidx"] + \
	            n[".data"], \
	        flash ? " of " flash : "", n[".stack"] + n[".data"] + n[".bss"], ram ? " of " ram : "", n[".stack"] }'
$(OUT)/$(NAME).bin: $(ELF)
	@$(OBJCOPY) -O binary $< $@
$(OUT)/$(NAME).hex: $(ELF)
	@$(OBJCOPY) -O ihex $< $@
library: $(OUT)/libzstrip.a
$(OUT)/libzstrip.a: $(LIBRARY_OBJ)
	@rm -f $@ && $(BOARD_CC:gcc=ar) rcs $@ $^
-include $(sort $(OBJ:.o=.d) $(LIBRARY_OBJ:.o=.d))
# Compiler, flags and the files of hal/ that make this board's HAL, a line each: for tests/checks/hal.sh
hal:
	@printf '%s\n' '$(BOARD_CC)' '$(BOARD_CPU)' '$(filter-out hal/panel/%,$(filter hal/%,$(SRC)))'
.PHONY: all image run library hal
