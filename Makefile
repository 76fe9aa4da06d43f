# zstrip. Everything lands in build/. `make help` lists the targets.
CC = gcc
B = build
CFLAGS = -O2 -g
WARN = -Wall -Wextra -Werror -Wconversion -Wshadow -Wvla -Wstrict-prototypes \
       -Wmissing-prototypes -Wdouble-promotion -Wno-missing-field-initializers
SIM_DIRS = cli load convert frame panel budget study compare reference panel_model
INC = -Ifirmware/zstrip -Ifirmware/examples -Ifirmware/scenes -Ihal -Ihal/panel -Ihal/fault -I$(B)/gen $(SIM_DIRS:%=-Isim/%)
CORE = $(wildcard firmware/zstrip/*/*.c)
SCENES = $(wildcard firmware/scenes/*.c)
PANELS = $(wildcard hal/panel/*.c)
SIM = $(wildcard $(SIM_DIRS:%=sim/%/*.c)) firmware/scenes/gen/font.c
ZLAB = $(filter-out sim/cli/main.c,$(SIM)) $(wildcard sim/lab/*.c)
GEN = $(wildcard firmware/scenes/gen/*.c)
# zstrip-linux: libgpiod's version 1 or 2 decides which of hal/linux's two files is taken. LINUX_SIM: what it needs of
# sim where it is built without models (-DLINUX_MODELS=0)
GPIOD = $(firstword $(subst ., ,$(shell pkg-config --modversion libgpiod 2>/dev/null)))
LINUX = $(filter-out hal/linux/gpio_v%,$(wildcard hal/linux/*.c)) $(wildcard sim/linux/*.c)
LINUX_SIM = $(wildcard sim/panel_model/*.c) sim/cli/option_table.c sim/panel/panel_bus.c sim/panel/panel_frame.c sim/cli/sim.c sim/cli/value.c
HEADERS = $(wildcard firmware/*/*.h firmware/zstrip/*/*.h firmware/scenes/gen/*.h hal/*.h hal/*/*.h sim/*/*.h tests/*.h tests/*/*.h)
LIBS = -lassimp -lmeshoptimizer -lpng -lturbojpeg -lm -pthread

# An object depends on the headers that it includes, as the compiler noted them beside it (.d; HEADERS are for what is
# compiled of many files at once), and on a note of its compiler's options, written anew where they change
DEP = -MMD -MP
same = $(and $(findstring <$1>,<$2>),$(findstring <$2>,<$1>))
note = $(if $(call same,$(strip $(file <$1)),$(strip $2)),,$(shell mkdir -p $(dir $1))$(file >$1,$2))$1

# Debian packages: what the simulator and zstrip-linux are built from, and what tests and fuzzers need besides
PKG_SIM = gcc libc6-dev libassimp-dev libmeshoptimizer-dev libpng-dev libturbojpeg0-dev
PKG_LINUX = $(PKG_SIM) libgpiod-dev pkg-config
PKG_TEST = $(PKG_LINUX) ccache gnuplot-nox g++ clang binutils libcmocka-dev gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm \
           $(PKG_RISCV) qemu-system-misc gcc-arm-linux-gnueabihf libc6-dev-armhf-cross device-tree-compiler cpio \
           gcc-powerpc-linux-gnu libc6-dev-powerpc-cross qemu-user-static $(if $(shell command -v npm),,nodejs npm)
PKG_BENCH = $(PKG_TEST) valgrind
PKG_SCALE = $(PKG_TEST) gnuplot-nox
PKG_FUZZ = $(PKG_TEST) libclang-rt-14-dev
PKG_REPORT = $(PKG_SIM) gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm gnuplot-nox \
             valgrind $(if $(shell command -v npm),,nodejs npm)
PKG_PROVE = gcc libc6-dev frama-c-base
PKG_COVERAGE = gcovr
PKG_COMPLEXITY = pmccabe similarity-tester
PKG_RISCV = gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf
PKG_FW = gcc libc6-dev $(if $(filter rv32,$(BOARD)),$(PKG_RISCV),gcc-arm-none-eabi libnewlib-arm-none-eabi)
BOARD = pico
SCENE = teapot
SECONDS = 600
SEED = 1
MUTANTS = 300

## all: the simulator, build/zsim
all: sim
.DEFAULT_GOAL := all
.DELETE_ON_ERROR:

## demo: set up, draw the demo scenes as a board would into build/demo/, print what they took
demo: sim
	$(B)/zsim demo --out $(B)/demo

## test: set up and run every test
test: $(B)/.setup-test
	@$(MAKE) --no-print-directory -j2 $(B)/zsim $(B)/zlab test-programs fuzz-programs stress-cut
	@sh tests/run.sh $(B)

## quick: every unit test, for after each change: without AddressSanitizer, of UBSan what is cheap; half a minute
quick: $(B)/.setup-test
	@$(MAKE) --no-print-directory -j2 B=$(B)/quick SAN='$(SAN_QUICK)' unit-programs mutate-link
	@sh tests/quick.sh $(B)/quick $(UNITS)
## t: T=raster: the unit tests whose name holds that, as make test has them
t: $(B)/.setup-test
	$(if $(UNITS_T),,$(error T=$(T): no unit test's name holds that; there are $(UNITS:test_%=%)))
	@$(MAKE) --no-print-directory -j2 $(UNITS_T:%=$(B)/test/%)
	@sh tests/quick.sh $(B) $(UNITS_T)

## fuzz: each of the five fuzzers for SECONDS=600, two side by side, from SEED=1
fuzz: $(B)/.setup-fuzz
	@$(MAKE) --no-print-directory -j2 fuzz-programs lib-fuzz-programs
	@sh tests/fuzz/run.sh $(B) $(SECONDS) $(SEED)

## stress: random triangles against whole numbers, random frames against the plainest way, for SECONDS=600 more
stress: $(B)/.setup-test $(B)/gen/meshes.h
	@$(MAKE) --no-print-directory -j2 stress-programs $(if $(filter fast,$(BUILD)),$(B)/stress/fast)
	@sh tests/stress/run.sh $(B) $(SECONDS) '$(KIND)' $(BUILD)
## stress-record: what all runs have reached becomes tests/STRESS.txt
stress-record:
	@sh tests/stress/run.sh $(B) figures >$(B)/stress/figures.txt && cp $(B)/stress/figures.txt tests/STRESS.txt

## prove: no overflow, bad shift, division by zero or stray access in the kernels, over all their inputs; minutes
prove:
	@mkdir -p $(B) && .ci/setup $(PKG_PROVE)
	@sh tests/prove/run.sh $(B) $(PROOFS)

## coverage: lines and branches of firmware/zstrip and hal/panel that the unit tests reach
coverage: $(B)/.setup-test
	@.ci/setup $(PKG_COVERAGE)
	@$(MAKE) --no-print-directory B=$(B)/coverage SAN='--coverage -fprofile-update=atomic' coverage-programs
	@sh tests/checks/coverage.sh $(B)

## complexity: of functions, and what the code says twice
complexity:
	@.ci/setup $(PKG_COMPLEXITY)
	@sh tests/checks/complexity.sh

## mutate: MUTANTS=300 of the renderer, SEED=1: which of them the unit tests catch; goes on where it was stopped
mutate: $(B)/.setup-test
	@$(MAKE) --no-print-directory B=$(B)/mutate/plain SAN= mutate-link
	@node tests/mutate/mutate.mjs $(B) $(MUTANTS) $(SEED)

## bench: what frames take and how exact they are: instructions on Cortex-M0 to M7, RISC-V and here, cycles on an RP2040
bench: sim $(B)/.setup-bench $(B)/gen/meshes.h
	@sh tests/checks/bench.sh $(B) all
## bench-record: what the bench's frames take now becomes what make test compares them with
bench-record: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/checks/bench.sh $(B) record >$(B)/bench.txt && mv $(B)/bench.txt tests/golden/bench.txt

## scale: how instructions grow with triangles, pixels, strips, passes, depth complexity: CSV and plots in build/scale
scale: $(B)/.setup-scale $(B)/gen/meshes.h
	@sh tests/checks/scale.sh $(B) plots

## costs: what each stage costs on each core, fitted from scenes that isolate it, and how far that is from other scenes
costs: lab $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/checks/costs.sh $(B)
## costs-record: what stages cost now, and flash, stack and sizes on Cortex-M, become what zsim budget reckons with
costs-record: lab $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/checks/costs.sh $(B) record
	@$(MAKE) --no-print-directory -j2 $(B)/zsim

## still: instructions of a still scene and of one moving thing with zs_damage_track, on Cortex-M3
still: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/checks/still.sh $(B)

## cull: instructions of 10,000 instances of which 20 are in view, and of a large model from afar, close by and within
cull: sim $(B)/.setup-test
	@sh tests/checks/cull.sh $(B)

## checksums: every scene's frames on Cortex-M0 to M7, RISC-V, PowerPC (big-endian) and x86-64: one table of checksums, all the same
checksums: $(B)/.setup-test $(B)/gen/meshes.h
	@SUMS_PICO=1 sh tests/scene_sums.sh $(B)

## depth: which depth mapping separates what, and what each costs on Cortex-M3 and M0
depth: sim $(B)/.setup-test
	@sh tests/checks/depth.sh $(B)

## accuracy: how exact it is, against whole numbers and the double-precision reference; about a minute
accuracy: lab
	@$(B)/zlab accuracy

## report: every study, frames counted on emulated cores, into build/study/index.html; ten minutes
report: $(B)/.setup-report
	@$(MAKE) --no-print-directory -j2 $(B)/zsim study-variants
	@for s in depth stability; do $(B)/zsim study $$s --redo --out $(B)/study || exit 1; done
	@sh sim/study/study.sh $(B) memory --redo
	@CORES='m3 m0 pico host' sh sim/study/study.sh $(B) time --full --redo

SHOW = $(MAKE) --no-print-directory -s -f firmware/boards/firmware.mk B=$(B) BOARD=$(BOARD) APP=show SCENE=$(SCENE) \
       $(if $(APP_SCENE),APP_SCENE=$(APP_SCENE)) $(if $(LEAN),LEAN=$(LEAN)) $(if $(CORES),CORES=$(CORES))
## firmware: BOARD=pico SCENE=teapot (or mine, or APP_SCENE=my.c): what is flashed, into build/fw/pico/; LEAN=1: least flash,
##     without accelerators; CORES=2: both cores of the Pico draw, build/fw/pico-2/
firmware: $(B)/.setup-fw-$(BOARD) $(B)/gen/meshes.h
	@$(SHOW) image

## pico: the demo scenes on an emulated Raspberry Pi Pico: cycles, wire, frames a second
pico: $(B)/.setup-test
	@$(MAKE) --no-print-directory -j2 $(B)/zsim
	@sh tests/pico.sh $(B) table

## boards: two demo scenes on every board with a panel: flash, RAM, stack, instructions or cycles a frame
boards: $(B)/.setup-test
	@$(MAKE) --no-print-directory -j2 $(B)/zsim
	@sh tests/boards/table.sh $(B)

## profile: SCENE=teapot [BOARD=mps2]: cycles a frame by function on the emulated Pico; instructions on a board of QEMU's
profile: $(B)/.setup-test $(B)/gen/meshes.h
ifeq ($(BOARD),pico)
	@PICO_SCENES=$(SCENE) sh tests/pico.sh $(B) profile
else
	@sh tests/boards/profile.sh $(B) $(BOARD) $(SCENE) $(FUNCTION)
endif

## sim: build/zsim
sim: $(B)/.setup-sim
	@$(MAKE) --no-print-directory -j2 $(B)/zsim

## lab: build/zlab, which measures how exact the renderer is and what its stages cost
lab: $(B)/.setup-sim
	@$(MAKE) --no-print-directory -j2 $(B)/zlab

## linux: build/zstrip-linux, which drives a panel on this machine's own SPI and GPIO (a Raspberry Pi's, say)
linux: $(B)/.setup-linux
	@$(MAKE) --no-print-directory -j2 $(B)/zstrip-linux

## pictures: the README's pictures, drawn again
pictures: sim
	@sh sim/pictures/make.sh $(B)

## size: flash of the renderer and RAM by pool
## stack: worst-case stack
## check: rules on the Cortex-M objects, linking, includes, sizes of files, initialisers, headers in C and C++, and the stack
size stack: $(B)/.setup-test $(B)/libcore.a
	@sh tests/checks/$@.sh $(B)
check: $(B)/.setup-test $(B)/gen/meshes.h
	@for c in objects kernels hal includes shape designated headers stack; do sh tests/checks/$$c.sh $(B) || exit 1; done

## clean: remove build/
clean:
	rm -rf $(B)

## help: this list
help:
	@sed -n 's/^## /    /p' Makefile
	@echo 'Boards, BOARD=:'
	@for mk in firmware/boards/*/board.mk; do b=$${mk%/board.mk}; \
	    printf '    %-10s %s\n' "$${b##*/}" "$$(sed -n 's/^BOARD_ABOUT = //p' $$mk)"; done
.PHONY: all demo test quick t report study-variants accuracy fuzz stress stress-record bench bench-record scale costs costs-record still cull checksums depth firmware pico boards \
        profile sim lab linux linux-sources pictures size stack check clean help test-programs fuzz-programs lib-fuzz-programs \
        stress-programs prove coverage complexity mutate

$(B)/.setup-sim:
	@mkdir -p $(B) && .ci/setup $(PKG_SIM) && touch $@
$(B)/.setup-test:
	@mkdir -p $(B) && .ci/setup $(PKG_TEST) && touch $@ $(B)/.setup-linux $(B)/.setup-sim
$(B)/.setup-fw-$(BOARD):
	@$(SHOW) hal >/dev/null # a wrong name is told before anything is installed
	@mkdir -p $(B) && .ci/setup $(PKG_FW) && touch $@
$(B)/.setup-linux:
	@mkdir -p $(B) && .ci/setup $(PKG_LINUX) && touch $@ $(B)/.setup-sim
$(B)/.setup-bench:
	@mkdir -p $(B) && .ci/setup $(PKG_BENCH) && touch $@ $(B)/.setup-test $(B)/.setup-linux $(B)/.setup-sim
$(B)/.setup-scale:
	@mkdir -p $(B) && .ci/setup $(PKG_SCALE) && touch $@ $(B)/.setup-test $(B)/.setup-linux $(B)/.setup-sim
$(B)/.setup-report:
	@mkdir -p $(B) && .ci/setup $(PKG_REPORT) && touch $@ $(B)/.setup-sim
$(B)/.setup-fuzz:
	@mkdir -p $(B) && .ci/setup $(PKG_FUZZ) && touch $@ $(B)/.setup-test $(B)/.setup-linux $(B)/.setup-sim

# The renderer for programs of this machine that only use it: the generator of meshes, and those of tests
CORE_CC = $(CC) -std=c11 $(CFLAGS) $(WARN) -Ifirmware/zstrip
CORE_NOTE := $(call note,$(B)/core/cc,$(CORE_CC))
$(B)/core/%.o: %.c $(CORE_NOTE)
	@mkdir -p $(@D)
	@$(CORE_CC) $(DEP) -c $< -o $@
$(B)/libcore.a: $(CORE:%.c=$(B)/core/%.o)
	@rm -f $@ && ar rcs $@ $^

# Meshes: written by a generator, built into one archive
$(B)/gen_meshes: $(GEN) $(B)/libcore.a $(filter firmware/zstrip/% firmware/scenes/%,$(HEADERS))
	@mkdir -p $(B)
	@$(CC) -std=c11 $(CFLAGS) $(WARN) $(INC) $(GEN) $(B)/libcore.a -o $@
$(B)/gen/made: $(B)/gen_meshes
	@rm -rf $(B)/gen/new && mkdir -p $(B)/gen/new
	@echo 'meshes: $(B)/gen'
	@$< $(B)/gen/new >$(B)/gen/new/meshes.txt
	@cd $(B)/gen/new && for f in *; do cmp -s $$f ../$$f || { mv * ..; break; }; done # as old as what is in them
	@rm -r $(B)/gen/new && touch $@
$(B)/gen/meshes.h: $(B)/gen/made
	@:
$(B)/libmeshes.a: $(B)/gen/meshes.h
	@cd $(B)/gen && $(CC) -std=c11 -O1 -I$(CURDIR)/firmware/zstrip -c mesh_*.c
	@rm -f $@ && ar rcs $@ $(B)/gen/mesh_*.o

# Rows of studies say which sources they were measured with
$(B)/gen/study_build.h: $(CORE) $(SCENES) $(filter sim/%,$(SIM)) $(GEN) $(filter-out tests/%,$(HEADERS))
	@mkdir -p $(B)/gen
	@cat $^ | cksum | awk '{ printf "#define STUDY_BUILD \"%08x\"\n", $$1 }' >$@
$(B)/sim/sim/study/study.o $(B)/test/sim/study/study.o $(B)/fuzz/clang/sim/study/study.o: $(B)/gen/study_build.h

SIM_CC = $(CC) -std=gnu11 $(CFLAGS) $(WARN) $(INC) -DZS_STATS=1
SIM_NOTE := $(call note,$(B)/sim/cc,$(SIM_CC))
$(B)/sim/%.o: %.c $(SIM_NOTE) | $(B)/gen/meshes.h
	@mkdir -p $(@D)
	@$(SIM_CC) $(DEP) -c $< -o $@
$(B)/zsim: $(patsubst %.c,$(B)/sim/%.o,$(CORE) $(SCENES) $(PANELS) $(SIM)) $(B)/libmeshes.a
	@$(CC) $(CFLAGS) $^ $(LIBS) -o $@
	@echo 'built $@'
$(B)/zlab: $(patsubst %.c,$(B)/sim/%.o,$(CORE) $(SCENES) $(PANELS) $(ZLAB)) $(B)/libmeshes.a
	@$(CC) $(CFLAGS) $^ $(LIBS) -o $@
	@echo 'built $@'

# zsim with other reciprocals and sub-spans (zs_config.h), for the study of time: BUILD/study/NAME/zsim
STUDY_bound2 = -DZS_SPAN_BOUND_LOG2=2
STUDY_bound5 = -DZS_SPAN_BOUND_LOG2=5
STUDY_recip16 = -DZS_RECIP_STEPS=0
STUDY_texels30 = -DZS_TEXEL_COARSE_LOG2=0
STUDY_texels15 = -DZS_TEXEL_COARSE_LOG2=31
STUDY_BUILDS = bound2 bound5 recip16 texels30 texels15
STUDY_OF = $(patsubst %.c,$(1)/%.o,$(CORE) sim/study/study_time.c)
STUDY_REST = $(patsubst %.c,$(B)/sim/%.o,$(SCENES) $(PANELS) $(filter-out sim/study/study_time.c,$(SIM))) $(B)/libmeshes.a
study-variants: $(STUDY_BUILDS:%=$(B)/study/%/zsim)
define study_build
$(B)/study/$(1)/%.o: %.c $(SIM_NOTE) | $(B)/gen/meshes.h
	@mkdir -p $$(@D)
	@$(SIM_CC) -DZS_STUDY=1 $(STUDY_$(1)) $(DEP) -c $$< -o $$@
$(B)/study/$(1)/zsim: $(call STUDY_OF,$(B)/study/$(1)) $(STUDY_REST)
	@$(CC) $(CFLAGS) $$^ $(LIBS) -o $$@
	@echo 'built $$@'
endef
$(foreach v,$(STUDY_BUILDS),$(eval $(call study_build,$(v))))

$(B)/sim/hal/linux/%.o $(B)/sim/sim/linux/%.o: INC += -Ihal/linux -Isim/linux -pthread
$(B)/zstrip-linux: $(patsubst %.c,$(B)/sim/%.o,$(LINUX) hal/linux/gpio_v$(GPIOD).c $(CORE) $(SCENES) $(PANELS) \
                                                $(filter-out sim/cli/main.c,$(SIM))) $(B)/libmeshes.a
	@$(CC) $(CFLAGS) -pthread $^ $(LIBS) $$(pkg-config --libs libgpiod) -o $@
	@echo 'built $@'
# What a cross compiler takes besides $(B)/gen's meshes and hal/linux/gpio_v1.c or gpio_v2.c
linux-sources:
	@echo $(CORE) $(SCENES) $(PANELS) $(LINUX_SIM) $(LINUX)

include tests/tests.mk
-include $(foreach at,core sim test test/narrow fuzz/clang study/*,$(foreach of,firmware hal sim tests,\
    $(wildcard $(addprefix $(B)/$(at)/$(of)/,*.d */*.d */*/*.d))))
