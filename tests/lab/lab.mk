# The lab
#
# What developers of the renderer run: how exact and how fast it is, what it costs, and what shows that tests are good
SECONDS = 600
SEED = 1
MUTANTS = 300

## fuzz: each of the five fuzzers for SECONDS=600, two side by side, from SEED=1
fuzz: $(B)/.setup-fuzz
	+@$(MAKE_ALL) fuzz-programs lib-fuzz-programs
	@sh tests/lab/fuzz/run.sh $(B) $(SECONDS) $(SEED)

## sanitize: the parts of make test that run zsim or zlab, with these under AddressSanitizer and UBSan; ten minutes
sanitize: $(B)/.setup-test
	+@$(MAKE_ALL) $(B)/zsim $(B)/test/zsim $(B)/test/zlab $(B)/test/libtest.a $(B)/libcore.a
	@SANITIZE=1 sh tests/run.sh $(B)

## stress: random triangles against whole numbers, random frames against the plainest way, for SECONDS=600 more
stress: $(B)/.setup-test $(B)/gen/meshes.h
	+@$(MAKE_ALL) stress-programs $(if $(filter fast,$(BUILD)),$(B)/stress/fast)
	@sh tests/lab/stress/run.sh $(B) $(SECONDS) '$(KIND)' $(BUILD)
## stress-record: what all runs have reached becomes tests/records/STRESS.txt
stress-record:
	@sh tests/lab/stress/run.sh $(B) figures >$(B)/stress/figures.txt
	@cp $(B)/stress/figures.txt tests/records/STRESS.txt

## prove: no overflow, bad shift, division by zero or stray access in the kernels, over all their inputs; minutes
prove:
	@mkdir -p $(B) && .ci/setup $(PKG_PROVE)
	@sh tests/lab/prove/run.sh $(B) $(PROOFS)

## coverage: lines and branches of firmware/zstrip and hal/panel that the unit tests reach
coverage: $(B)/.setup-test
	@.ci/setup $(PKG_COVERAGE)
	+@$(MAKE_ALL) B=$(B)/coverage SAN='--coverage -fprofile-update=atomic' coverage-programs
	@sh tests/lab/coverage.sh $(B)

## complexity: of functions, and what the code says twice
complexity:
	@.ci/setup $(PKG_COMPLEXITY)
	@sh tests/lab/complexity.sh

## mutate: MUTANTS=300 of the renderer, SEED=1: which of them the unit tests catch; goes on where it was stopped
mutate: $(B)/.setup-test
	+@$(MAKE_ALL) B=$(B)/mutate/plain SAN= mutate-link
	@node tests/lab/mutate/mutate.mjs $(B) $(MUTANTS) $(SEED)

## bench: what frames take and how exact they are: instructions on Cortex-M0 to M7, RISC-V and here, cycles on an RP2040
bench: sim $(B)/.setup-bench $(B)/gen/meshes.h
	@sh tests/lab/bench.sh $(B) all
## bench-record: what the bench's frames take now becomes what make test compares them with
bench-record: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/bench.sh $(B) record >$(B)/bench.txt && mv $(B)/bench.txt tests/records/bench.txt

## accelerators: what each accelerator is worth, in instructions of every scene on a Cortex-M3, and its flash;
## accelerators-record: as the report
accelerators: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/accelerators.sh $(B)
accelerators-record: $(B)/.setup-test $(B)/gen/meshes.h
	@{ echo "Of commit $$(git rev-parse --short HEAD): firmware/zstrip"; echo; \
	    sh tests/lab/accelerators.sh $(B) | sed '/^ok /d'; } >$(B)/accelerators.txt && \
	    mv $(B)/accelerators.txt tests/records/ACCELERATORS.txt

## strangers: zsim budget on twelve models of others against the emulated Pico; minutes
strangers: sim $(B)/.setup-show
	@.ci/setup assimp-testmodels
	@mkdir -p $(B)/pico
	@sh tests/lab/strangers.sh $(B)
## stopwatch: from a clean clone to a moving picture of a model of others in the emulated Pico, step by step
stopwatch:
	@.ci/setup assimp-testmodels
	@mkdir -p $(B)
	@sh tests/lab/stopwatch.sh $(B)

## scale: how instructions grow with triangles, pixels, strips, passes, depth complexity: CSV and plots in build/scale
scale: $(B)/.setup-scale $(B)/gen/meshes.h
	@sh tests/lab/scale.sh $(B) plots

## costs: what each stage costs on each core, fitted from scenes that isolate it, and how far that is from other scenes
costs: lab $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/costs.sh $(B)
## costs-record: what stages cost now, and flash, stack and sizes on Cortex-M, become what zsim budget reckons with
costs-record: lab $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/costs.sh $(B) record
	+@$(MAKE_ALL) $(B)/zsim

## effects-error: how far estimates of frames with effects are from what these take in the emulated Pico; minutes
effects-error: web
	@NODE_PATH=$(B)/pico/node_modules esbuild sim/web/pico/board.js --bundle --format=esm --log-level=error \
	    --outfile=$(B)/web/board.mjs
	@node tests/lab/effects/error.mjs $(B) $(B)/web/board.mjs

## still: instructions of a still scene and of one moving thing with zs_damage_track, on Cortex-M3
still: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/still.sh $(B)

## methods: methods of hidden-surface removal side by side on Cortex-M0 and M3; methods-record: as make test's record
methods: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/methods.sh $(B)
methods-record: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/methods.sh $(B) record >$(B)/methods.txt && mv $(B)/methods.txt tests/records/methods.txt
## methods-worlds: every method against the depth buffer on 10,000 random worlds; methods-worlds-record: as the report
## methods-lines: hidden lines against exact visible segments, 1,000 views of four models; methods-lines-record: ditto
methods-worlds methods-worlds-record methods-lines methods-lines-record: $(B)/.setup-test
	+@$(MAKE_ALL) B=$(B)/quick SAN='$(SAN_QUICK)' \
	    $(B)/quick/test/$(if $(findstring lines,$@),test_hidden_lines,test_methods)
	@sh tests/lab/worlds.sh $(B)/quick $(if $(findstring lines,$@),lines,worlds) \
	    $(if $(findstring record,$@),>$(B)/$@.txt && \
	        mv $(B)/$@.txt tests/records/$(if $(findstring lines,$@),LINES,WORLDS).txt)
## effects: what a pixel takes by each effect and overlay, on Cortex-M0 and M3; effects-record: as the record
effects: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/effects.sh $(B)
effects-record: $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/effects.sh $(B) record >$(B)/effects.txt && mv $(B)/effects.txt tests/records/effects.txt && \
	    sh tests/lab/effects.sh $(B) header >$(B)/effects.h && mv $(B)/effects.h sim/budget/record_effects.h
## looks: how far estimates of effects together, of mirrors and of showpieces are from what these take on M3 and M0
looks: lab $(B)/.setup-test $(B)/gen/meshes.h
	@sh tests/lab/looks.sh $(B)
## gallery: build/gallery/index.html, every method on one page, with instructions on a Cortex-M3
gallery: sim methods
	@$(B)/zsim gallery --out $(B)/gallery --m3 $(B)/methods/mps2.csv

## cull: instructions of 10,000 instances of which 20 are in view, and of a large model from afar, close by and within
cull: sim $(B)/.setup-test
	@sh tests/lab/cull.sh $(B)

## depth: which depth mapping separates what, and what each costs on Cortex-M3 and M0
depth: sim $(B)/.setup-test
	@sh tests/lab/depth.sh $(B)

## hiz: what the hierarchical depth buffer skips, in three orders and by three tests; depth strips packed as planes
hiz: $(B)/.setup-test $(B)/gen/meshes.h
	+@$(MAKE_ALL) $(B)/hiz/study
	@sh tests/lab/hiz.sh $(B)
$(B)/hiz/study: $(patsubst %.c,$(B)/sim/%.o,$(CORE) $(SCENES) $(wildcard tests/lab/hiz/*.c)) $(B)/libmeshes.a
	@mkdir -p $(@D)
	@$(CC) $(CFLAGS) $^ -o $@

## lab: build/zlab, which measures how exact the renderer is and what its stages cost
lab: $(B)/.setup-sim
	+@$(MAKE_ALL) $(B)/zlab

## accuracy: how exact it is, against whole numbers and the double-precision reference; about a minute
accuracy: lab
	@$(B)/zlab accuracy

## records-age: which reports of tests/records are of an older commit than what they speak of
records-age:
	@sh tests/records/age.sh

.PHONY: effects-error
.PHONY: lab records-age fuzz sanitize stress stress-record prove coverage complexity mutate bench bench-record \
        strangers accelerators accelerators-record \
        stopwatch scale costs costs-record still cull methods methods-record methods-worlds methods-worlds-record \
        methods-lines methods-lines-record \
        effects effects-record looks gallery depth hiz accuracy fuzz-programs lib-fuzz-programs stress-programs

# Fuzzers: the interface by seeds (fuzz_api); cards of meshes and textures by libFuzzer (fuzz_mesh, make fuzz
# alone) and by mutations of its seeds (cards); model files, command lines and panels' streams likewise, by libFuzzer
# (lf_NAME, make fuzz alone) and by mutations of their corpora (NAME)
fuzz_objects = $(call t,$(patsubst %,tests/lab/fuzz/%.c,$(1))) $(B)/test/libtest.a
FUZZ_TARGETS = fuzz_scan fuzz_options fuzz_panel
fuzz-programs: $(B)/fuzz/fuzz_api $(B)/fuzz/cards $(FUZZ_TARGETS:%=$(B)/fuzz/%)
lib-fuzz-programs: $(B)/fuzz/fuzz_mesh $(FUZZ_TARGETS:%=$(B)/fuzz/lf_%)
$(B)/test/tests/lab/fuzz/%.o $(B)/fuzz/clang/%.o: TEST_CC += -Itests/lab/fuzz -Isim/linux -Ihal/linux -D_GNU_SOURCE=
FUZZ_SIM = $(filter-out $(MODEL) sim/cli/main.c,$(SIM)) sim/linux/linux_options.c
$(FUZZ_TARGETS:%=$(B)/fuzz/%): $(B)/fuzz/%: $(B)/test/tests/lab/fuzz/%.o $(call t,$(FUZZ_SIM)) $(B)/test/libtest.a \
                                            $(call fuzz_objects,drive input replay said) $(B)/libmeshes.a
	$(folder)
	@$(CC) $(SAN) -Wl,--start-group $^ -Wl,--end-group $(LIBS) -o $@
$(B)/fuzz/clang/%.o: %.c $(TEST_NOTE) | $(B)/gen/meshes.h
	@mkdir -p $(@D)
	@$(subst $(CC) ,clang ,$(TEST_CC)) -fsanitize=fuzzer-no-link $(DEP) -c $< -o $@
$(FUZZ_TARGETS:%=$(B)/fuzz/lf_%): $(B)/fuzz/lf_%: \
    $(B)/fuzz/clang/tests/lab/fuzz/%.o $(B)/fuzz/clang/tests/lab/fuzz/said.o \
    $(patsubst %.c,$(B)/fuzz/clang/%.o,$(FUZZ_SIM) $(MODEL) $(CORE) $(SCENES) $(PIECES) $(PANELS)) $(B)/libmeshes.a
	@clang $(SAN) -fsanitize=fuzzer $^ $(LIBS) -o $@
# Of these clang compiles all, in make test, quickly; the core it compiles for checksum-clang-O3
CLANGED = $(FUZZ_SIM) $(MODEL) $(SCENES) $(PIECES) $(LINUX) $(wildcard $(addsuffix /*.c,\
    sim/lab sim/view firmware/examples hal/fault hal/host tests/unit tests/property tests/tools tests/lib \
    tests/lab/fuzz tests/lab/stress))
clang-objects: $(patsubst %.c,$(B)/clang/%.o,$(sort $(CLANGED)))
$(B)/clang/%.o: %.c $(TEST_NOTE) | $(B)/gen/meshes.h
	$(folder)
	@clang -std=gnu11 -O0 -D_GNU_SOURCE= $(TEST_WARN) $(INC) -Ihal/linux -Isim/linux -Isim/lab -Itests/lib \
	    -Itests/lab/fuzz -DZS_STATS=1 -DZS_VARYINGS_MAX=8 $(DEP) -c $< -o $@
.PHONY: clang-objects
$(B)/fuzz/fuzz_api: $(call fuzz_objects,fuzz_api replay world)
	@mkdir -p $(@D)
	@$(CC) $(SAN) $^ -o $@
$(B)/fuzz/cards: $(call fuzz_objects,cards fuzz_mesh input replay world)
	@mkdir -p $(@D)
	@$(CC) $(SAN) $^ -o $@
$(B)/fuzz/fuzz_mesh: tests/lab/fuzz/fuzz_mesh.c $(patsubst %,tests/lib/%.c,fast_lists own) $(PICTURE) $(CORE) $(HEADERS)
	@mkdir -p $(@D)
	@$(subst $(CC) ,clang ,$(TEST_CC)) -Itests/lab/fuzz -O2 -fsanitize=fuzzer $(filter %.c,$^) -o $@

# Stress: triangles against the oracle and frames against the plainest way, by seeds; under the sanitizers, and as
# shipped. The oracle, the judge, is not slowed down by sanitizers. cut is for make test: of its objects, at -O1.
STRESS_CC = $(CC) -std=gnu11 $(CFLAGS) -Wall -Wextra -Werror -Wshadow -Wno-missing-field-initializers $(INC) \
            -Itests/lib -Itests/lab/fuzz -Itests/lab/stress -DZS_VARYINGS_MAX=8
stress-cut: $(B)/stress/cut
stress-programs: $(B)/stress/san
$(B)/test/tests/lab/stress/%.o: TEST_CC += -Itests/lab/fuzz -Itests/lab/stress
$(B)/stress/cut: $(call t,$(wildcard tests/lab/stress/*.c) tests/lab/fuzz/replay.c) $(B)/test/libtest.a
	@mkdir -p $(@D)
	@$(CC) $(SAN) $^ -lm -o $@
.PHONY: stress-cut
$(B)/stress/oracle.o: tests/lib/oracle.c tests/lib/oracle.h
	@mkdir -p $(@D)
	@$(STRESS_CC) -c $< -o $@
STRESS = $(wildcard tests/lab/stress/*.c) tests/lab/fuzz/replay.c tests/lab/fuzz/effects.c \
         $(patsubst %,tests/lib/%.c,clusters fast_lists own) $(PICTURE) $(CORE)
$(B)/stress/san: $(STRESS) $(B)/stress/oracle.o $(HEADERS)
	@$(STRESS_CC) $(SAN) -DZS_STATS=1 '-DZS_ASSERT(c)=((c)?(void)0:__builtin_trap())' $(STRESS) $(B)/stress/oracle.o \
	    -lm -o $@
$(B)/stress/fast: $(STRESS) $(B)/stress/oracle.o $(HEADERS)
	@$(STRESS_CC) $(STRESS) $(B)/stress/oracle.o -lm -o $@

# Mutants (tests/lab/mutate): the units that run the renderer, as in make test but, by B and SAN, without sanitizers,
# all in one program; make test links it as well
MUTATE_NOT = explain.c linux.c pair.c examples.c help.c model_pack.c polygon.c panel.c panel_model.c panel_bytes.c \
             panel_picture.c
MUTATE_FILES = $(filter-out $(MUTATE_NOT:%=\%/test_%),$(TESTS))
MUTATE_TESTS = $(basename $(notdir $(MUTATE_FILES)))
MUTATE_SIM = sim/frame/pixel_counts.c sim/frame/demo_frame.c $(FRAME) sim/reference/reference.c \
             sim/reference/lamps.c sim/reference/rays.c
mutate-settings:
	$(info tests $(MUTATE_TESTS))
	$(info files $(MUTATE_FILES))
	$(info sources $(SCENES) $(PIECES) $(TEST_HELP) $(MUTATE_SIM))
	$(info cc $(TEST_CC))
	$(info link $(call mutate_link,OBJECTS,OUT))
	@:
mutate_link = $(CC) $(SAN) -Wl,--wrap=_cmocka_run_group_tests -Wl,--start-group $1 $(call t,$(MUTATE_SIM)) \
    $(B)/test/libtest.a $(B)/libmeshes.a -Wl,--end-group -lcmocka -lm -pthread -o $2
mutate-link: $(B)/test/mutate/runner
	@:
MUTATE_MAINS := $(call note,$(B)/test/mutate/programs.h,$(patsubst %,PROGRAM(%),$(MUTATE_TESTS)))
$(B)/test/mutate/runner.o: tests/lab/mutate/runner.c $(MUTATE_MAINS) $(TEST_NOTE)
	@$(TEST_CC) -I$(B)/test/mutate -c $< -o $@
$(B)/test/mutate/tests/%.o: $(B)/test/tests/%.o # each main by a name of its own
	@mkdir -p $(@D)
	@objcopy --redefine-sym main=main_$(*F) $< $@
$(B)/test/mutate/runner: $(B)/test/mutate/runner.o $(MUTATE_FILES:%.c=$(B)/test/mutate/%.o) $(call t,$(MUTATE_SIM)) \
                         $(B)/test/libtest.a $(B)/libmeshes.a
	@$(call mutate_link,$(filter $(B)/test/mutate/%,$^),$@)
.PHONY: mutate-settings mutate-link
coverage-programs: $(filter-out %/test_linux %/test_pair,$(patsubst %.c,$(B)/test/%,$(notdir $(TESTS))))
.PHONY: coverage-programs
