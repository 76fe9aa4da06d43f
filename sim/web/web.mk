# The simulator in a page
#
# engine.wasm: the renderer, the demo scenes and what of zsim a page needs, by clang for WebAssembly with a small C
# library

WEB_SIM = $(wildcard $(patsubst %,sim/%/*.c,effect frame compare reference panel panel_model web)) \
          $(addprefix sim/cli/,accelerator_names.c kept.c option_help.c option_table.c render.c render_options.c sim.c \
              value.c) \
          $(addprefix sim/load/,losses.c mirrored.c model_shape.c picture.c) \
          $(addprefix sim/convert/,cluster.c convert_arrays.c convert_figures.c convert_options.c convert_text.c \
              convert_write.c converted.c grid_step.c hierarchy.c mesh_cut.c mesh_groups.c mesh_pieces.c palette.c \
              quantise.c quantise_file.c quantise_textures.c quantise_view.c resample.c scene_parts.c simplify.c \
              texel_pack.c) \
          $(addprefix sim/budget/,budget_figures.c budget_parts.c budget_scene.c budget_times.c costs.c costs_copy.c \
              costs_count.c costs_effect.c costs_error.c costs_lamps.c costs_look.c costs_method.c costs_shape.c \
              effect_costs.c) \
          firmware/scenes/gen/font.c
# meshoptimizer: the source of the library that zsim is linked with, so that models get the same meshes
MESHOPT = $(B)/web/meshoptimizer/source/src
MESHOPT_O = $(patsubst %,$(B)/web/meshopt_%.o,allocator clusterizer indexgenerator simplifier vcacheanalyzer \
              vfetchoptimizer)
WEB_CC = clang --target=wasm32-wasi -std=gnu11 -O3 -DNDEBUG $(INC) -Isim/web/include -Isim/web -I$(MESHOPT) \
         -include web_system.h -DSTAGE_ORBIT=1 -DZS_STATS=1 -DZS_VARYINGS_MAX=8
WEB_NOTE := $(call note,$(B)/web/cc,$(WEB_CC))
WEB_O = $(patsubst %.c,$(B)/web/%.o,$(CORE) $(SCENES) $(PIECES) $(PANELS) \
              $(filter-out sim/frame/moving_%,$(WEB_SIM)))

$(MESHOPT)/meshoptimizer.h:
	@.ci/source meshoptimizer libmeshoptimizer-dev $(B)/web/meshoptimizer
$(MESHOPT_O): $(B)/web/meshopt_%.o: $(MESHOPT)/meshoptimizer.h $(WEB_NOTE)
	@clang++ --target=wasm32-wasi -O3 -DNDEBUG -fno-exceptions -fno-rtti -c $(MESHOPT)/$*.cpp -o $@
$(B)/web/%.o: %.c $(WEB_NOTE) | $(B)/gen/meshes.h $(MESHOPT)/meshoptimizer.h
	@mkdir -p $(@D)
	@$(WEB_CC) $(DEP) -c $< -o $@
$(B)/web/meshes.o: $(B)/gen/made $(WEB_NOTE)
	$(folder)
	@$(WEB_CC) -c $(B)/gen/meshes.c -o $@
# One section for each function and mesh, so that what the page does not call stays out
$(B)/web/engine.wasm: $(WEB_O) $(MESHOPT_O) $(B)/web/meshes.o
	@clang --target=wasm32-wasi -O3 -mexec-model=reactor $^ -Wl,--gc-sections,--strip-all,-z,stack-size=1048576 -o $@
	@echo 'built $@'
## engine: build/web/engine.wasm, the simulator for pages (sim/web/engine.js)
engine: $(B)/.setup-engine
	+@$(MAKE_ALL) $(B)/web/engine.wasm
.PHONY: engine
