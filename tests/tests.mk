# Tests of the tree and of what it builds
#
# The test programs: every test_*.c, with tests/lib, the core, the scenes, the panels and their models, under ASan and
# UBSan and with the kernels' preconditions checked. zsim is built like that too, for models that are hostile
# (tests/tools/loading.sh), for test_linux, and for make sanitize.
# What UBSan finds is an illegal instruction, which AddressSanitizer reports with its line (handle_sigill, tally.sh):
# without UBSan's own texts objects are a quarter cheaper to compile, zsim is half as large and starts in two thirds of
# the time. As no pie: of AddressSanitizer's tables of globals relocations are left otherwise to each start.
# leak_roots: tests/lib/leaks.c
SAN = -fsanitize=address,undefined -fsanitize-undefined-trap-on-error -fno-pie -no-pie -Wl,-u,leak_roots \
      -Wno-unused-command-line-argument
# make quick: optimised, with what costs next to nothing; where it fails is a signal
SAN_QUICK = -O2 -fsanitize=signed-integer-overflow,shift,bounds,integer-divide-by-zero \
            -fsanitize-undefined-trap-on-error
# -g1: lines for the sanitizers' reports; all of -g takes a fifth longer to compile. -Og for the tests' own files and
# for sim/: half of -O1's time, and they run about as fast
TEST_O = -O1
TEST_WARN = -Wall -Wextra -Werror -Wshadow -Wno-missing-field-initializers -Wno-unused-parameter
TEST_CC = $(CC) -std=gnu11 $(TEST_O) -g1 $(SAN) $(TEST_WARN) $(INC) \
          -Itests/lib -DZS_STATS=1 -DZS_VARYINGS_MAX=8 '-DZS_ASSERT(c)=((c)?(void)0:__builtin_trap())'
TESTS = $(foreach d,unit property tools,$(wildcard tests/$d/test_*.c))
MODEL = $(wildcard sim/panel_model/*.c) sim/panel/panel_bus.c hal/fault/fault.c
FRAME = $(addprefix sim/frame/,frame.c frame_ids.c frame_threads.c scene_share.c method_names.c) sim/cli/sim.c
PICTURE = tests/lib/picture.c sim/cli/kept.c # and what it stands on
TEST_HELP = $(wildcard tests/lib/*.c) sim/cli/kept.c tests/lab/fuzz/world.c tests/lab/fuzz/effects.c
t = $(patsubst %.c,$(B)/test/%.o,$(1))

# Unit tests by name, and those that T= names
UNITS = $(basename $(notdir $(TESTS))) test_xform_narrow test_raster_narrow test_texture_narrow
UNITS_T = $(strip $(if $(T),$(foreach u,$(UNITS),$(if $(findstring $(T),$(u)),$(u)))))

unit-programs: $(UNITS:%=$(B)/test/%)
	@:
test-programs: unit-programs $(B)/test/zsim checksum-programs mutate-link clang-objects $(B)/libcore.a
.PHONY: unit-programs

.SECONDARY: $(call t,$(TESTS))
TEST_NOTE := $(call note,$(B)/test/cc,$(TEST_CC))
# The oracle, the judge, is not slowed down by AddressSanitizer.
$(B)/test/tests/lib/oracle.o: override SAN := $(if $(SAN),$(SAN_QUICK))
$(B)/test/tests/%.o $(B)/test/sim/%.o: TEST_O = -Og
# loops over pixels of every test, over colours of every palette, over vertices of every cluster
$(addprefix $(B)/test/,tests/lib/picture.o tests/lib/easel.o sim/convert/palette.o sim/convert/cluster.o): TEST_O = -O2
# assimp stays the caller of operator new, as what is known of its leaks asks (tests/lib/lsan.txt)
$(B)/test/sim/load/assimp_buffer.o: TEST_O = -O2
$(B)/test/%.o: %.c $(TEST_NOTE) | $(B)/gen/meshes.h
	$(folder)
	@$(TEST_CC) $(DEP) -c $< -o $@
$(B)/test/libtest.a: $(call t,$(CORE) $(SCENES) $(PIECES) $(PANELS) $(MODEL) $(TEST_HELP))
	@rm -f $@ && ar rcs $@ $^
define test_program
$(B)/test/test_%: $(B)/test/tests/$1/test_%.o $(B)/test/libtest.a $(B)/libmeshes.a
	@$$(CC) $$(SAN) -Wl,--start-group $$^ -Wl,--end-group -lcmocka -lm -o $$@
endef
$(foreach d,unit property tools,$(eval $(call test_program,$d)))
# The same with the rows of a matrix as cores have them that do not add products to 64 bits (wide.h): what reads rows is
# compiled so, the rest is no other (zs_renderer.h gives rows one size)
NARROW = tests/unit/test_xform.c $(shell grep -lwE 'ZS_ROW_WORDS|zs_matrix_rows' $(CORE))
$(B)/test/narrow/%.o: %.c $(TEST_NOTE)
	$(folder)
	@$(TEST_CC) -DZS_ROW_WIDE=0 -DZS_64=0 $(DEP) -c $< -o $@
$(B)/test/test_xform_narrow: $(NARROW:%.c=$(B)/test/narrow/%.o) $(B)/test/libtest.a $(B)/libmeshes.a
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group -lcmocka -lm -o $@
# The same for accelerators that registers of 64 bits have in place of others
NARROW_FAST = $(shell grep -lw ZS_64 firmware/zstrip/fast/*.c)
$(B)/test/test_raster_narrow $(B)/test/test_texture_narrow: $(B)/test/test_%_narrow: $(B)/test/tests/unit/test_%.o \
    $(NARROW_FAST:%.c=$(B)/test/narrow/%.o) $(B)/test/libtest.a $(B)/libmeshes.a
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group -lcmocka -lm -o $@
$(B)/test/test_examples: $(call t,$(wildcard firmware/examples/*.c))
$(B)/test/test_explain: $(call t,$(wildcard firmware/examples/*.c))
$(B)/test/test_explain: private override SAN += -Wl,--wrap=zs_render -Wl,--wrap=zs_render_passes
$(B)/test/test_polygon: $(call t,sim/load/polygon.c sim/cli/sim.c)
$(B)/test/test_raycast: $(call t,sim/reference/reference.c sim/reference/lamps.c sim/reference/rays.c)
$(B)/test/test_lit_gloss: $(call t,sim/reference/reference.c sim/reference/lamps.c)
$(B)/test/test_counts: $(call t,sim/frame/pixel_counts.c $(FRAME))
$(B)/test/test_threads $(B)/test/test_golden $(B)/test/test_pieces $(B)/test/test_lanes: $(call t,$(FRAME))
$(B)/test/test_pieces: $(call t,sim/frame/demo_frame.c)
$(B)/test/tests/tools/test_help.o: TEST_CC += -Isim/lab -Isim/linux
$(B)/test/test_help: $(call t,tests/tools/test_help.c sim/linux/linux_options.c $(filter-out %/main.c,$(ZLAB))) \
                     $(B)/test/libtest.a $(B)/libmeshes.a
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group -lcmocka $(LIBS) -o $@
$(B)/test/test_model_pack: $(call t,tests/tools/test_model_pack.c $(filter-out sim/cli/main.c,$(SIM))) \
                           $(B)/test/libtest.a $(B)/libmeshes.a
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group -lcmocka $(LIBS) -o $@
$(B)/test/zsim: $(call t,$(SIM)) $(B)/test/libtest.a $(B)/libmeshes.a | $(B)/test/libasked.so
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group $(ASKED) $(LIBS) -o $@
$(B)/test/zlab: $(call t,$(ZLAB)) $(B)/test/libtest.a $(B)/libmeshes.a | $(B)/test/libasked.so
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group $(ASKED) $(LIBS) -o $@
# AddressSanitizer asks at each start for 46 functions that this C library does not show. Where one is missing, the
# dynamic linker makes up an error message, whose memory is 200 pages in all: a tenth of what zsim takes to start, 3,000
# times in make test. So they are there. Nobody calls them but a stack's printing the one of Swift, to which 0 says no.
# Exceptions are C++'s own, which zsim is linked with, too.
ASKED = -Wl,--push-state,--no-as-needed $(B)/test/libasked.so -Wl,--pop-state,-rpath,$(abspath $(B))/test
ASKED_NAMES = s/.*undefined symbol: \([a-z_0-9]*\) .*/long \1(void) { \1_BODY }/p
$(B)/test/libasked.so: $(TEST_NOTE)
	@echo 'int main(void) { return 0; }' | $(CC) -fsanitize=address -x c - \
	    -Wl,--no-as-needed -lstdc++ -o $(@D)/asks
	@LD_DEBUG=symbols $(@D)/asks 2>&1 | sed -n '$(ASKED_NAMES)' | sed '/ __cxa_/d; / _Unwind_/d' | \
	    sed 's/swift_demangle_BODY/return 0;/; s/[a-z_0-9]*_BODY/__builtin_trap();/' >$(@D)/asked.c
	@$(CC) -shared -fPIC -nostdlib -w -fno-builtin -Wl,-soname,$(@F) $(@D)/asked.c -o $@

# firmware/app/pair.c, each of whose accesses to memory is a call into test_pair.c, which has neither renderer nor HAL
$(B)/test/test_pair: override SAN =
$(B)/test/test_pair: tests/unit/test_pair.c firmware/app/pair.c tests/lib/cases.c $(TEST_NOTE)
	@mkdir -p $(@D)/tests/unit
	@$(TEST_CC) -Ifirmware/app $(DEP) -MT $@ -fsanitize=thread -c firmware/app/pair.c -o $(@D)/tests/unit/pair.o
	@$(TEST_CC) -O2 -Ifirmware/app $(DEP) -MT $@ -MF $(@D)/tests/unit/test_pair.d $< tests/lib/cases.c \
	    $(@D)/tests/unit/pair.o -lcmocka -o $@

# zstrip-linux on a machine that test_linux.c makes up, in place of libgpiod and of these calls of the C library;
# drawing takes as long as it wants
LINUX_FAKED = open ioctl stat lstat access opendir nanosleep getgrgid sigaction zs_raster_strip
$(B)/test/hal/linux/%.o $(B)/test/sim/linux/%.o $(B)/test/tests/unit/test_linux.o: \
    TEST_CC += -Ihal/linux -Isim/linux -pthread
$(B)/test/sim/linux/main.o: TEST_CC += -Dmain=zstrip_linux
$(B)/test/test_linux: $(call t,tests/unit/test_linux.c $(LINUX) $(filter-out $(MODEL) sim/cli/main.c,$(SIM))) \
                      $(B)/test/libtest.a $(B)/libmeshes.a $(B)/test/zsim
	@$(CC) $(SAN) -pthread $(LINUX_FAKED:%=-Wl,--wrap=%) -Wl,--start-group $(filter-out %/zsim,$^) -Wl,--end-group \
	    -lcmocka $(LIBS) -o $@

# The renderer as programs of this machine have it, of the objects that parts link as well
$(B)/libcore.a: $(CORE) $(HEADERS)
	+@$(MAKE) --no-print-directory -s -f firmware/boards/firmware.mk BOARD=host B=$(B) DEBUG= library
	@cp $(B)/fw/host/libzstrip.a $@

# One program, two compilers at two levels, and one for a big-endian machine, run by QEMU: its checksums must be the
# same; those of bare-NAME too, which have no accelerators
CHECKSUM_HOST = $(foreach c,gcc clang,$(foreach o,O0 O3,$(c)-$(o)))
CHECKSUMS = $(CHECKSUM_HOST:%=$(B)/test/checksum-%) $(foreach o,O0 O2 Os,$(B)/test/checksum-powerpc-$(o))
CHECKSUMS_BARE = $(patsubst %,$(B)/test/bare-%,$(CHECKSUM_HOST) powerpc-Os)
$(B)/test/checksum-powerpc-% $(B)/test/bare-powerpc-%: CHECKSUM_CC = powerpc-linux-gnu-gcc -static
CHECKSUM_CC = $(word 2,$(subst -, ,$(@F)))
CHECKSUM_FLAGS = -std=c11 -$(word 3,$(subst -, ,$(@F))) $(TEST_WARN) $(INC) -DZS_VARYINGS_MAX=8 -Itests/lib
CHECKSUM = sh tests/lib/checksum_program.sh $@ $(CHECKSUM_CC) $(CHECKSUM_FLAGS) --
checksum-programs: $(CHECKSUMS) $(CHECKSUMS_BARE)
$(CHECKSUMS) $(CHECKSUMS_BARE): tests/lib/checksum_program.sh $(HEADERS)
# Some have all of the renderer: scene_sums.sh and effects.sh link more of it (checksum_core.sh). The others, and those
# without accelerators, have what they link
CHECKSUMS_ALL = $(patsubst %,$(B)/test/checksum-%,gcc-O0 gcc-O3 clang-O3 powerpc-O2)
CHECKSUM_SOURCES = tests/property/checksum.c $(CORE)
LINKED = $(B)/test/checksum-sources
$(LINKED): $(B)/test/checksum-gcc-O0
	@sh tests/lib/checksum_program.sh $< gcc $(filter-out -,$(CHECKSUM_FLAGS)) -- list $(CHECKSUM_SOURCES) >$@
$(CHECKSUMS_ALL): $(CHECKSUM_SOURCES)
	@mkdir -p $(@D)
	@$(CHECKSUM) all $(CHECKSUM_SOURCES)
$(filter-out $(CHECKSUMS_ALL),$(CHECKSUMS)): $(LINKED)
	@$(CHECKSUM) of $<
$(B)/test/bare-%: $(LINKED) $(B)/test/checksum-%
	@$(CHECKSUM) bare $^

## size: flash of the renderer and RAM by pool
## stack: worst-case stack
## check: rules on the Cortex-M objects, linking, includes, sizes of files, initialisers, headers in C and C++; stack
size stack: $(B)/.setup-test $(B)/libcore.a
	@SIZE_ALL=1 sh tests/checks/$@.sh $(B)
check: $(B)/.setup-test $(B)/gen/meshes.h
	@for c in objects kernels hal includes shape designated headers stack; do sh tests/checks/$$c.sh $(B) || exit 1; done

## examples: flash, RAM, instructions and cycles of the programs of firmware/examples, and a sheet of their pictures
examples: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/tools/examples.sh $(B)

## checksums: every scene's frames on Cortex-M0 to M7, RISC-V, PowerPC (big-endian) and x86-64: one table, all the same
checksums: $(B)/.setup-test $(B)/gen/meshes.h
	@SUMS_PICO=1 sh tests/property/scene_sums.sh $(B)
.PHONY: size stack check checksums examples test-programs checksum-programs
