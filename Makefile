# zstrip. Everything lands in build/. `make help` lists what users want, `make help-all` the rest.
MAKEFLAGS += -r # what is built in for C, Fortran and RCS is not looked for: half a second a call
CC = gcc
B = build
CFLAGS = -O2 -g1
WARN = -Wall -Wextra -Wconversion -Wshadow -Wvla -Wstrict-prototypes \
       -Wmissing-prototypes -Wdouble-promotion -Wno-missing-field-initializers
# In tests a warning is an error, here and in firmware.mk; in other builds not, where another compiler may have more
WERROR ?=
test quick t check size stack: export WERROR = -Werror
test quick: export BEGUN := $(shell date +%s)
JOBS := $(shell nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
# Its lines begin with +, as make sees a make in a recipe only where it is written out
MAKE_ALL = $(MAKE) --no-print-directory -j$(JOBS)
ifneq ($(and $(filter 0,$(MAKELEVEL)),$(word 2,$(filter-out $(B)/%,$(MAKECMDGOALS)))),)
.NOTPARALLEL: # goals that each call such a make would build the same files at a time
endif
SIM_DIRS = cli effect load convert project frame panel gallery budget study compare reference panel_model view
INC = -Ifirmware/zstrip -Ifirmware/examples -Ifirmware/scenes -Ifirmware/scenes/pieces -Ihal -Ihal/panel -Ihal/fault \
      -I$(B)/gen $(SIM_DIRS:%=-Isim/%) -Ifirmware/app
CORE = $(wildcard firmware/zstrip/*/*.c)
SCENES = $(wildcard firmware/scenes/*.c)
PIECES = $(wildcard firmware/scenes/pieces/*.c)
PANELS = $(wildcard hal/panel/*.c)
HEADERS = $(wildcard firmware/*/*.h firmware/zstrip/*/*.h firmware/scenes/*/*.h hal/*.h hal/*/*.h sim/*/*.h \
                     tests/lib/*.h tests/lab/*/*.h)

# An object depends on the headers that it includes, as the compiler noted them beside it (.d; HEADERS are for what is
# compiled of many files at once), and on a note of its compiler's options, written anew where they change
DEP = -MMD -MP
include firmware/boards/note.mk

BOARD = pico
SCENE = teapot
all: sim
.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
include .ci/packages.mk firmware/package/package.mk sim/sim.mk sim/web/web.mk sim/web/page.mk tests/tests.mk \
        tests/boards/boards.mk tests/lab/lab.mk

## demo: set up, draw the demo scenes as a board would into build/demo/, print what they took
demo: sim
	$(B)/zsim demo --out $(B)/demo

## test: set up and run every test
test: $(B)/.setup-test
	+@build=$(B); . tests/lib/ccache.sh; \
	    $(MAKE_ALL) $(B)/zsim $(B)/zlab test-programs fuzz-programs stress-cut && $(MAKE_ALL) web-page
	@sh tests/run.sh $(B)

## quick: every unit test, for after each change: each fifth of their random cases, without AddressSanitizer, of UBSan
##     what is cheap; half a minute; t: T=raster: those whose name holds that, as make test has them
quick: $(B)/.setup-test
	+@$(MAKE_ALL) B=$(B)/quick SAN='$(SAN_QUICK)' unit-programs mutate-link
	@ZS_EVERY=$${ZS_EVERY:-5} sh tests/quick.sh $(B)/quick $(UNITS)

t: $(B)/.setup-test
	$(if $(UNITS_T),,$(error T=$(T): no unit test's name holds that; there are $(UNITS:test_%=%)))
	+@$(MAKE_ALL) $(UNITS_T:%=$(B)/test/%)
	@sh tests/quick.sh $(B) $(UNITS_T)

## sim: build/zsim
sim: $(B)/.setup-sim
	+@$(MAKE_ALL) $(B)/zsim

## view: build/zsim with windows: zsim view MODEL
view: $(B)/.setup-view
	+@$(MAKE_ALL) $(B)/zsim

SHOW = $(MAKE_ALL) -s -f firmware/boards/firmware.mk B=$(B) BOARD=$(BOARD) APP=show SCENE=$(SCENE) \
       $(if $(APP_SCENE),APP_SCENE='$(APP_SCENE)') $(if $(LEAN),LEAN=$(LEAN)) $(if $(CORES),CORES=$(CORES))
## firmware: BOARD=pico SCENE=teapot (or mine, or APP_SCENE=my.c): what is flashed, into build/fw/pico/; LEAN=1: least
##     flash, without accelerators; CORES=2: both cores of the Pico draw, build/fw/pico-2/
firmware: $(B)/.setup-fw-$(BOARD) $(B)/gen/meshes.h
	@$(SHOW) image

## show: SCENE=teapot, mine or APP_SCENE=my.c: that firmware in an emulated Pico: pictures, frames a second
show: $(B)/.setup-show $(B)/gen/meshes.h sim
	@$(SHOW) image
	@sh tests/boards/show.sh $(B) $(B)/fw/pico$(if $(filter 2,$(CORES)),-2)/$(if $(filter mine,$(SCENE)),my_scene,$(or \
	    $(basename $(notdir $(firstword $(APP_SCENE)))),$(SCENE)))

## linux: build/zstrip-linux, which drives a panel on this machine's own SPI and GPIO (a Raspberry Pi's, say)
linux: $(B)/.setup-linux
	+@$(MAKE_ALL) $(B)/zstrip-linux

## web: build/web/index.html, a page for a browser: drop a model, see it on a panel, its frames a second and RAM
web: $(B)/.setup-web
	+@$(MAKE_ALL) $(B)/web/index.html

## clean: remove build/
clean:
	rm -rf $(B)

LIST = sed -n 's/^\#\# /    /p'
## help: this list; help-all: what is behind it as well
help:
	@$(LIST) Makefile
	@echo 'Boards, BOARD=:'
	@for mk in firmware/boards/*/board.mk; do b=$${mk%/board.mk}; \
	    printf '    %-10s %s\n' "$${b##*/}" "$$(sed -n 's/^BOARD_ABOUT = //p' $$mk)"; done
help-all: help
	@for mk in $$(grep -l '^## ' $(filter-out .ci/%,$(filter %.mk,$(INCLUDED)))); do \
	    sed -n '1s/^\# \(.*\)/\1:/p' $$mk; $(LIST) $$mk; done
.PHONY: all demo test quick t sim view firmware show linux web clean help help-all

INCLUDED := $(MAKEFILE_LIST)
-include $(foreach at,core sim test test/narrow clang fuzz/clang web study/*,$(foreach of,firmware hal sim tests,\
    $(wildcard $(addprefix $(B)/$(at)/$(of)/,*.d */*.d */*/*.d))))
