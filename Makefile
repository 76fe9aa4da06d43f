# zstrip. Everything lands in build/. `make help` lists the targets.
CC = gcc
ARM = arm-none-eabi-
B = build
WARN = -Wall -Wextra -Werror -Wconversion -Wshadow -Wvla -Wstrict-prototypes \
       -Wmissing-prototypes -Wdouble-promotion
INC = -Ifirmware/zstrip -Ifirmware/scenes -I$(B)/gen -Isim -Isim/reference
CFLAGS = -O2 -g
HOST = $(CC) -std=gnu11 $(CFLAGS) $(WARN) $(INC) -MMD -MP
CORE = $(wildcard firmware/zstrip/*.c)
SCENES = $(wildcard firmware/scenes/*.c)
SIM = $(wildcard sim/*.c sim/reference/*.c)
GEN = $(wildcard firmware/scenes/gen/*.c)
HEADERS = $(wildcard firmware/*/*.h firmware/scenes/gen/*.h hal/*.h sim/*.h sim/reference/*.h tests/*.h)
obj = $(patsubst %.c,$(B)/$(1)/%.o,$(2))

PKG_SIM = gcc libc6-dev libassimp-dev libpng-dev
PKG_TEST = $(PKG_SIM) g++ clang libcmocka-dev gcc-arm-none-eabi libnewlib-arm-none-eabi \
           qemu-system-arm

## all: the simulator
all: sim
.DEFAULT_GOAL := all

## demo: set up, draw the demo scenes as a board would into build/demo/, print what they took
demo: sim
	$(B)/zsim demo --out $(B)/demo

## test: set up and run every test
test: $(B)/.setup-test
	@$(MAKE) --no-print-directory sim
	@sh tests/run.sh $(B)

## bench: instructions a frame on a Cortex-M3 (QEMU counts; needs no board)
bench: $(B)/.setup-test
	@sh tests/bench.sh $(B)

## sim: build/zsim
sim: $(B)/.setup-sim
	@$(MAKE) --no-print-directory $(B)/zsim

## pictures: the README's pictures
pictures: sim
	sh sim/pictures/make.sh $(B)

## size, stack, check: flash and RAM, worst-case stack, rules on the Cortex-M objects
size stack: $(B)/.setup-test
	@sh tests/checks/$@.sh
check: $(B)/.setup-test
	@for c in objects includes stack; do sh tests/checks/$$c.sh || exit 1; done

## clean: remove build/
clean:
	rm -rf $(B)

## help: this list
help:
	@sed -n 's/^## /  /p' Makefile

$(B)/.setup-sim $(B)/.setup-test:
	@mkdir -p $(B)
	@.ci/setup $(if $(findstring test,$@),$(PKG_TEST),$(PKG_SIM))
	@touch $@

$(B)/sim/%.o: %.c $(HEADERS) | $(B)/gen/meshes.h
	@mkdir -p $(@D)
	$(HOST) -DZS_STATS=1 -c $< -o $@
$(B)/zsim: $(call obj,sim,$(CORE) $(SCENES) $(SIM)) $(B)/gen/.built
	$(CC) $(CFLAGS) $(filter %.o,$^) $(B)/gen/*.o -o $@ -lassimp -lpng -lm
