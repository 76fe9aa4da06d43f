# The simulator
#
# zsim, zstrip-linux and what they are built of: the renderer, the scenes' meshes, the panels and their models

SIM = $(wildcard $(SIM_DIRS:%=sim/%/*.c)) firmware/scenes/gen/font.c
ZLAB = $(filter-out sim/cli/main.c,$(SIM)) $(wildcard sim/lab/*.c)
GEN = $(wildcard firmware/scenes/gen/*.c)
# zstrip-linux: libgpiod's version 1 or 2 decides which of hal/linux's two files is taken. LINUX_SIM: what it needs of
# sim where it is built without models (-DLINUX_MODELS=0)
GPIOD = $(firstword $(subst ., ,$(shell pkg-config --modversion libgpiod 2>/dev/null)))
LINUX = $(filter-out hal/linux/gpio_v%,$(wildcard hal/linux/*.c)) $(wildcard sim/linux/*.c)
LINUX_SIM = $(wildcard sim/panel_model/*.c) sim/cli/option_help.c sim/cli/option_table.c sim/panel/panel_bus.c \
            sim/panel/panel_frame.c sim/cli/sim.c sim/cli/value.c
# -rdynamic: a scene's own file (sim/project/scene_file.c) takes the renderer's functions from the program. assimp is
# loaded where a model is (sim/load/assimp_library.c)
LIBS = -rdynamic -lmeshoptimizer -lpng -lz -lturbojpeg -lm -ldl -pthread

## report: every study, frames counted on emulated cores, into build/study/index.html; ten minutes
report: $(B)/.setup-report
	+@$(MAKE_ALL) $(B)/zsim study-variants
	@for s in depth stability; do $(B)/zsim study $$s --redo --out $(B)/study || exit 1; done
	@sh sim/study/study.sh $(B) memory --redo
	@CORES='m3 m0 pico host' sh sim/study/study.sh $(B) time --full --redo

## pictures: the README's pictures, drawn again
pictures: sim
	@sh sim/pictures/make.sh $(B)

.PHONY: report pictures study-variants linux-sources

# Meshes and textures: one file, written by a generator
$(B)/gen_meshes: $(GEN) $(filter firmware/zstrip/% firmware/scenes/%,$(HEADERS))
	@mkdir -p $(B)
	@$(CC) -std=c11 $(CFLAGS) $(WARN) $(WERROR) $(INC) $(GEN) -lm -o $@
$(B)/gen/made: $(B)/gen_meshes
	@rm -rf $(B)/gen/new && mkdir -p $(B)/gen/new
	@echo 'meshes: $(B)/gen'
	@$< $(B)/gen/new >$(B)/gen/new/meshes.txt
	@cd $(B)/gen/new && for f in *; do cmp -s $$f ../$$f || { mv * ..; break; }; done # as old as what is in them
	@rm -r $(B)/gen/new && touch $@
$(B)/gen/meshes.h: $(B)/gen/made
	@:
$(B)/libmeshes.a: $(B)/gen/meshes.h
	@$(CC) -std=c11 -O1 -ffunction-sections -fdata-sections -Ifirmware/zstrip -MMD -MP -c $(B)/gen/meshes.c \
	    -o $(B)/gen/meshes.o
	@rm -f $@ && ar rcs $@ $(B)/gen/meshes.o

# Rows of studies say which sources they were measured with
$(B)/gen/study_build.h: $(CORE) $(SCENES) $(filter sim/%,$(SIM)) $(GEN) $(filter-out tests/%,$(HEADERS))
	@mkdir -p $(B)/gen
	@cat $^ | cksum | awk '{ printf "#define STUDY_BUILD \"%08x\"\n", $$1 }' >$@
$(foreach at,sim test clang fuzz/clang,$(B)/$(at)/sim/study/study.o): $(B)/gen/study_build.h

# A window is compiled anew where SDL2's headers have come or gone
VIEW_NOTE := $(call note,$(B)/sim/sdl2,SDL2: $(wildcard /usr/include/SDL2/SDL.h /usr/local/include/SDL2/SDL.h))
$(foreach at,sim test clang fuzz/clang,$(B)/$(at)/sim/view/window.o): $(VIEW_NOTE)

SIM_CC = $(CC) -std=gnu11 $(CFLAGS) $(WARN) $(INC) -DZS_STATS=1 -DZS_VARYINGS_MAX=8
SIM_NOTE := $(call note,$(B)/sim/cc,$(SIM_CC))
$(B)/sim/%.o: %.c $(SIM_NOTE) | $(B)/gen/meshes.h
	$(folder)
	@$(SIM_CC) $(WERROR) $(DEP) -c $< -o $@
# Demo scenes are seen from other sides (sim/frame/demo_frame.c), those with effects by this hook
$(foreach at,sim test clang fuzz/clang,$(B)/$(at)/firmware/scenes/pieces/%.o): INC += -DSTAGE_ORBIT=1
$(B)/zsim: $(patsubst %.c,$(B)/sim/%.o,$(CORE) $(SCENES) $(PIECES) $(PANELS) $(SIM)) $(B)/libmeshes.a
	@$(CC) $(CFLAGS) $^ $(LIBS) -o $@
	@echo 'built $@'
$(B)/zlab: $(patsubst %.c,$(B)/sim/%.o,$(CORE) $(SCENES) $(PIECES) $(PANELS) $(ZLAB)) $(B)/libmeshes.a
	@$(CC) $(CFLAGS) $^ $(LIBS) -o $@
	@echo 'built $@'

# zsim with other reciprocals and sub-spans (zs_config.h), for the study of time: BUILD/study/NAME/zsim
STUDY_bound3 = -DZS_SPAN_BOUND_LOG2=3
STUDY_bound5 = -DZS_SPAN_BOUND_LOG2=5
STUDY_recip16 = -DZS_RECIP_STEPS=0
STUDY_texels30 = -DZS_TEXEL_COARSE_LOG2=0
STUDY_texels15 = -DZS_TEXEL_COARSE_LOG2=31
STUDY_BUILDS = bound3 bound5 recip16 texels30 texels15
STUDY_OF = $(patsubst %.c,$(1)/%.o,$(CORE) sim/study/study_time.c)
STUDY_REST = $(patsubst %.c,$(B)/sim/%.o,$(SCENES) $(PIECES) $(PANELS) $(filter-out sim/study/study_time.c,$(SIM))) \
             $(B)/libmeshes.a
study-variants: $(STUDY_BUILDS:%=$(B)/study/%/zsim)
define study_build
$(B)/study/$(1)/%.o: %.c $(SIM_NOTE) | $(B)/gen/meshes.h
	@mkdir -p $$(@D)
	@$(SIM_CC) $(WERROR) -DZS_STUDY=1 $(STUDY_$(1)) $(DEP) -c $$< -o $$@
$(B)/study/$(1)/zsim: $(call STUDY_OF,$(B)/study/$(1)) $(STUDY_REST)
	@$(CC) $(CFLAGS) $$^ $(LIBS) -o $$@
	@echo 'built $$@'
endef
$(foreach v,$(STUDY_BUILDS),$(eval $(call study_build,$(v))))

$(B)/sim/hal/linux/%.o $(B)/sim/sim/linux/%.o: INC += -Ihal/linux -Isim/linux -pthread
$(B)/zstrip-linux: $(patsubst %.c,$(B)/sim/%.o,$(LINUX) hal/linux/gpio_v$(GPIOD).c $(CORE) $(SCENES) $(PIECES) \
                                                $(PANELS) $(filter-out sim/cli/main.c,$(SIM))) $(B)/libmeshes.a
	@$(CC) $(CFLAGS) -pthread $^ $(LIBS) $$(pkg-config --libs libgpiod) -o $@
	@echo 'built $@'
# What a cross compiler takes besides $(B)/gen's meshes and hal/linux/gpio_v1.c or gpio_v2.c: of the renderer not what
# the demo scenes do without
linux-sources:
	@echo $(filter-out $(patsubst %,firmware/zstrip/%,effect/% overlay/% support/explain%),$(CORE)) \
	    firmware/zstrip/effect/alpha_texels.c $(SCENES) $(PANELS) $(LINUX_SIM) $(LINUX)
