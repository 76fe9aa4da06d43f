# The test programs: every tests/test_*.c, with the helpers beside it, the core, the scenes, the panels and their
# models, under ASan and UBSan and with the kernels' preconditions checked. zsim is built like that too.
SAN = -fsanitize=address,undefined -fno-sanitize-recover=all
# make quick: optimised, with what costs next to nothing; where it fails is a signal
SAN_QUICK = -O2 -fsanitize=signed-integer-overflow,shift,bounds,integer-divide-by-zero -fsanitize-undefined-trap-on-error
# -g1: lines for the sanitizers' reports; all of -g takes a fifth longer to compile
TEST_CC = $(CC) -std=gnu11 -O1 -g1 $(SAN) -Wall -Wextra -Werror -Wshadow -Wno-missing-field-initializers $(INC) -Itests \
          -DZS_STATS=1 '-DZS_ASSERT(c)=((c)?(void)0:__builtin_trap())'
TESTS = $(wildcard tests/test_*.c)
MODEL = $(wildcard sim/panel_model/*.c) sim/panel/panel_bus.c hal/fault/fault.c
TEST_HELP = $(filter-out $(TESTS) tests/checksum.c,$(wildcard tests/*.c))
t = $(patsubst %.c,$(B)/test/%.o,$(1))

# Unit tests by name, and those that T= names
UNITS = $(TESTS:tests/%.c=%) test_xform_narrow
UNITS_T = $(strip $(if $(T),$(foreach u,$(UNITS),$(if $(findstring $(T),$(u)),$(u)))))

unit-programs: $(UNITS:%=$(B)/test/%)
	@:
test-programs: unit-programs $(B)/test/zsim checksum-programs mutate-link
.PHONY: unit-programs

.SECONDARY: $(call t,$(TESTS))
TEST_NOTE := $(call note,$(B)/test/cc,$(TEST_CC))
# The oracle, the judge, is not slowed down by AddressSanitizer.
$(B)/test/tests/oracle.o: override SAN := $(if $(SAN),$(SAN_QUICK))
$(B)/test/%.o: %.c $(TEST_NOTE) | $(B)/gen/meshes.h
	@mkdir -p $(@D)
	@$(TEST_CC) $(DEP) -c $< -o $@
$(B)/test/libtest.a: $(call t,$(CORE) $(SCENES) $(PANELS) $(MODEL) $(TEST_HELP))
	@rm -f $@ && ar rcs $@ $^
$(B)/test/test_%: $(B)/test/tests/test_%.o $(B)/test/libtest.a $(B)/libmeshes.a
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group -lcmocka -lm -o $@
# The same with the rows of a matrix as cores have them that do not add products to 64 bits (wide.h): what reads rows is
# compiled so, the rest is no other (renderer.h gives rows one size)
NARROW = tests/test_xform.c $(shell grep -lwE 'ZS_ROW_WORDS|zs_rows' $(CORE))
$(B)/test/narrow/%.o: %.c $(TEST_NOTE)
	@mkdir -p $(@D)
	@$(TEST_CC) -DZS_ROW_WIDE=0 $(DEP) -c $< -o $@
$(B)/test/test_xform_narrow: $(NARROW:%.c=$(B)/test/narrow/%.o) $(B)/test/libtest.a $(B)/libmeshes.a
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group -lcmocka -lm -o $@
$(B)/test/test_examples: $(call t,$(wildcard firmware/examples/*.c))
$(B)/test/test_pass $(B)/test/test_painter: $(call t,tests/fuzz/world.c)
$(B)/test/test_counts: $(call t,sim/frame/pixel_counts.c sim/frame/frame.c sim/frame/scene_share.c sim/cli/sim.c)
$(B)/test/test_threads $(B)/test/test_golden: $(call t,sim/frame/frame.c sim/frame/scene_share.c sim/cli/sim.c)
$(B)/test/zsim: $(call t,$(SIM)) $(B)/test/libtest.a $(B)/libmeshes.a
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group $(LIBS) -o $@

# firmware/app/pair.c, each of whose accesses to memory is a call into test_pair.c, which has neither renderer nor HAL
$(B)/test/test_pair: override SAN =
$(B)/test/test_pair: tests/test_pair.c firmware/app/pair.c $(TEST_NOTE)
	@mkdir -p $(@D)
	@$(TEST_CC) -Ifirmware/app $(DEP) -MT $@ -fsanitize=thread -c firmware/app/pair.c -o $@.pair.o
	@$(TEST_CC) -Ifirmware/app $(DEP) -MT $@ -MF $@.d $< $@.pair.o -lcmocka -o $@
-include $(wildcard $(B)/test/test_pair*.d)

# zstrip-linux on a machine that test_linux.c makes up, in place of libgpiod and of these calls of the C library;
# drawing takes as long as it wants
LINUX_FAKED = open ioctl stat lstat access opendir nanosleep getgrgid sigaction zs_raster_strip
$(B)/test/hal/linux/%.o $(B)/test/sim/linux/%.o $(B)/test/tests/test_linux.o: \
    TEST_CC += -Ihal/linux -Isim/linux -pthread
$(B)/test/sim/linux/main.o: TEST_CC += -Dmain=zstrip_linux
$(B)/test/test_linux: $(call t,tests/test_linux.c $(LINUX) $(filter-out $(MODEL) sim/cli/main.c,$(SIM))) \
                      $(B)/test/libtest.a $(B)/libmeshes.a $(B)/test/zsim
	@$(CC) $(SAN) -pthread $(LINUX_FAKED:%=-Wl,--wrap=%) -Wl,--start-group $(filter-out %/zsim,$^) -Wl,--end-group \
	    -lcmocka $(LIBS) -o $@

# One program, two compilers at two levels, and one for a big-endian machine, run by QEMU: its checksums must be the same;
# those of bare-NAME too, which have no accelerators
CHECKSUM_HOST = $(foreach c,gcc clang,$(foreach o,O0 O3,$(c)-$(o)))
CHECKSUMS = $(CHECKSUM_HOST:%=$(B)/test/checksum-%) $(foreach o,O0 O2 Os,$(B)/test/checksum-powerpc-$(o))
CHECKSUMS_BARE = $(patsubst %,$(B)/test/bare-%,$(CHECKSUM_HOST) powerpc-Os)
$(B)/test/checksum-powerpc-% $(B)/test/bare-powerpc-%: CHECKSUM_CC = powerpc-linux-gnu-gcc -static
CHECKSUM_CC = $(word 2,$(subst -, ,$(@F)))
checksum-programs: $(CHECKSUMS) $(CHECKSUMS_BARE)
$(CHECKSUMS): tests/checksum.c $(CORE) $(HEADERS)
$(CHECKSUMS_BARE): tests/checksum.c $(filter-out firmware/zstrip/fast/%,$(CORE)) $(HEADERS)
$(CHECKSUMS_BARE): INC += -DZS_NO_FAST=1
$(CHECKSUMS) $(CHECKSUMS_BARE):
	@mkdir -p $(@D)
	@$(CHECKSUM_CC) -std=c11 -$(word 3,$(subst -, ,$(@F))) $(INC) $(filter %.c,$^) -o $@

# Fuzzers: the interface by seeds (fuzz_api); cards of meshes and textures by libFuzzer (fuzz_mesh, make fuzz
# alone) and by mutations of its seeds (cards); model files, command lines and panels' streams likewise, by libFuzzer
# (lf_NAME, make fuzz alone) and by mutations of their corpora (NAME)
fuzz_objects = $(call t,$(patsubst %,tests/fuzz/%.c,$(1))) $(B)/test/libtest.a
FUZZ_TARGETS = fuzz_scan fuzz_options fuzz_panel
fuzz-programs: $(B)/fuzz/fuzz_api $(B)/fuzz/cards $(FUZZ_TARGETS:%=$(B)/fuzz/%)
lib-fuzz-programs: $(B)/fuzz/fuzz_mesh $(FUZZ_TARGETS:%=$(B)/fuzz/lf_%)
$(B)/test/tests/fuzz/%.o $(B)/fuzz/clang/%.o: TEST_CC += -Itests/fuzz -Isim/linux -Ihal/linux -D_GNU_SOURCE
FUZZ_SIM = $(filter-out $(MODEL) sim/cli/main.c,$(SIM)) sim/linux/linux_options.c
$(FUZZ_TARGETS:%=$(B)/fuzz/%): $(B)/fuzz/%: $(B)/test/tests/fuzz/%.o $(call t,$(FUZZ_SIM)) $(B)/test/libtest.a \
                                            $(call fuzz_objects,drive input replay said) $(B)/libmeshes.a
	@mkdir -p $(@D)
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group $(LIBS) -o $@
$(B)/fuzz/clang/%.o: %.c $(TEST_NOTE) | $(B)/gen/meshes.h
	@mkdir -p $(@D)
	@$(subst $(CC) ,clang ,$(TEST_CC)) -fsanitize=fuzzer-no-link $(DEP) -c $< -o $@
$(FUZZ_TARGETS:%=$(B)/fuzz/lf_%): $(B)/fuzz/lf_%: $(B)/fuzz/clang/tests/fuzz/%.o $(B)/fuzz/clang/tests/fuzz/said.o \
    $(patsubst %.c,$(B)/fuzz/clang/%.o,$(FUZZ_SIM) $(MODEL) $(CORE) $(SCENES) $(PANELS)) $(B)/libmeshes.a
	@clang $(SAN) -fsanitize=fuzzer $^ $(LIBS) -o $@
$(B)/fuzz/fuzz_api: $(call fuzz_objects,fuzz_api replay world)
	@mkdir -p $(@D)
	@$(CC) $(SAN) $^ -o $@
$(B)/fuzz/cards: $(call fuzz_objects,cards fuzz_mesh input replay world)
	@mkdir -p $(@D)
	@$(CC) $(SAN) $^ -o $@
$(B)/fuzz/fuzz_mesh: tests/fuzz/fuzz_mesh.c tests/fast_lists.c tests/own.c tests/picture.c $(CORE) $(HEADERS)
	@mkdir -p $(@D)
	@$(subst $(CC) ,clang ,$(TEST_CC)) -Itests/fuzz -O2 -fsanitize=fuzzer $(filter %.c,$^) -o $@

# Stress: triangles against the oracle and frames against the plainest way, by seeds; under the sanitizers, and as
# shipped. The oracle, the judge, is not slowed down by sanitizers. cut is for make test: of its objects, at -O1.
STRESS_CC = $(CC) -std=gnu11 $(CFLAGS) -Wall -Wextra -Werror -Wshadow -Wno-missing-field-initializers $(INC) -Itests \
            -Itests/fuzz -Itests/stress
stress-cut: $(B)/stress/cut
stress-programs: $(B)/stress/san
$(B)/test/tests/stress/%.o: TEST_CC += -Itests/fuzz -Itests/stress
$(B)/stress/cut: $(call t,$(wildcard tests/stress/*.c) tests/fuzz/replay.c) $(B)/test/libtest.a
	@mkdir -p $(@D)
	@$(CC) $(SAN) $^ -lm -o $@
.PHONY: stress-cut
$(B)/stress/oracle.o: tests/oracle.c tests/oracle.h
	@mkdir -p $(@D)
	@$(STRESS_CC) -c $< -o $@
STRESS = $(wildcard tests/stress/*.c) tests/fuzz/replay.c tests/clusters.c tests/fast_lists.c tests/own.c tests/picture.c $(CORE)
$(B)/stress/san: $(STRESS) $(B)/stress/oracle.o $(HEADERS)
	@$(STRESS_CC) $(SAN) -DZS_STATS=1 '-DZS_ASSERT(c)=((c)?(void)0:__builtin_trap())' $(STRESS) $(B)/stress/oracle.o \
	    -lm -o $@
$(B)/stress/fast: $(STRESS) $(B)/stress/oracle.o $(HEADERS)
	@$(STRESS_CC) $(STRESS) $(B)/stress/oracle.o -lm -o $@

# Mutants (tests/mutate): the units that run the renderer, as in make test but, by B and SAN, without sanitizers, all in
# one program; make test links it as well
MUTATE_TESTS = $(filter-out test_linux test_pair test_examples test_panel%,$(TESTS:tests/%.c=%))
MUTATE_SIM = tests/fuzz/world.c sim/frame/pixel_counts.c sim/frame/frame.c sim/frame/scene_share.c sim/cli/sim.c
mutate-settings:
	$(info tests $(MUTATE_TESTS))
	$(info sources $(SCENES) $(TEST_HELP) $(MUTATE_SIM))
	$(info cc $(TEST_CC))
	$(info link $(call mutate_link,OBJECTS,OUT))
	@:
mutate_link = $(CC) $(SAN) -Wl,--wrap=_cmocka_run_group_tests -Wl,--start-group $1 $(call t,$(MUTATE_SIM)) \
    $(B)/test/libtest.a $(B)/libmeshes.a -Wl,--end-group -lcmocka -lm -pthread -o $2
mutate-link: $(B)/test/mutate/runner
	@:
MUTATE_MAINS := $(call note,$(B)/test/mutate/programs.h,$(patsubst %,PROGRAM(%),$(MUTATE_TESTS)))
$(B)/test/mutate/runner.o: tests/mutate/runner.c $(MUTATE_MAINS) $(TEST_NOTE)
	@$(TEST_CC) -I$(B)/test/mutate -c $< -o $@
$(B)/test/mutate/tests/%.o: $(B)/test/tests/%.o # each main by a name of its own
	@mkdir -p $(@D)
	@objcopy --redefine-sym main=main_$* $< $@
$(B)/test/mutate/runner: $(B)/test/mutate/runner.o $(MUTATE_TESTS:%=$(B)/test/mutate/tests/%.o) $(call t,$(MUTATE_SIM)) \
                         $(B)/test/libtest.a $(B)/libmeshes.a
	@$(call mutate_link,$(filter $(B)/test/mutate/%,$^),$@)
.PHONY: mutate-settings mutate-link
coverage-programs: $(filter-out %/test_linux %/test_pair,$(TESTS:tests/%.c=$(B)/test/%))
.PHONY: coverage-programs
