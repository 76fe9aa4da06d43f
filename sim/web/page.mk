# The page
#
# index.html: page/, engine.wasm, the Pico's prebuilt show and its emulator as one file

# The show that page/uf2.js puts models into; what it holds of the renderer is what firmware/app/show_model.c names
SHOW_MODEL = $(B)/fw/pico-model/show_model
SHOW_SRC = $(wildcard firmware/zstrip/*.h firmware/zstrip/*/*.[ch] firmware/scenes/pieces/*.h firmware/app/show*.[ch] \
                      firmware/boards/*.mk firmware/boards/pico/* hal/*.h hal/*/*.[ch])
SHOW_AT = $(shell sed -n 's/.*define SHOW_MODEL \(0x[0-9a-f]*\).*/\1/p' firmware/app/show_model.h)
SHOW_KEPT = zs_(shade|blend|add|stipple|texel|depth|method)_[a-z0-9_]+|show_(model(_.*)?|test|phase)|zs_fog_draw \
            |zs_frame_end|hal_exit
$(SHOW_MODEL).txt: $(SHOW_SRC) $(B)/gen/made sim/web/page.mk
	+@$(MAKE_ALL) -s -f firmware/boards/firmware.mk B=$(B) BOARD=pico NAME=show_model OUT=$(@D) DEBUG= \
	    APP_SRC='firmware/app/show.c firmware/app/show_model.c' APP_FLAGS=-DSHOW_PIECE=1 DEFINES=-DZS_VARYINGS_MAX=8 \
	    APP_LINK='-Wl,--defsym=show=$(SHOW_AT),--defsym=show_model=$(SHOW_AT),-u,show_model_parts' image
	@arm-none-eabi-nm -f sysv $(SHOW_MODEL).elf | grep -E '^($(subst  |,|,$(SHOW_KEPT))) *\|' >$@
# rp2040js as tests/boards has it, and the board around it
$(B)/web/emulator.js: sim/web/pico/worker.js sim/web/pico/board.js tests/boards/pico/package-lock.json
	@mkdir -p $(B)/pico && sh tests/boards/pico.sh $(B) set-up && [ -d $(B)/pico/node_modules ]
	@NODE_PATH=$(B)/pico/node_modules esbuild $< --bundle --minify --format=iife --target=es2020 --log-level=warning \
	    --outfile=$@

WEB_PAGE = $(wildcard sim/web/page/*) sim/web/engine.js sim/web/bundle.mjs
# For `make test`: where it cannot be made, tests/web/made.sh says why, and all other parts are run
web-page:
	+@$(MAKE_ALL) $(B)/web/index.html >$(B)/web.log 2>&1 || rm -f $(B)/web/index.html
	@cat $(B)/web.log
.PHONY: web-page
$(B)/web/index.html: $(B)/web/engine.wasm $(SHOW_MODEL).txt $(B)/web/emulator.js $(WEB_PAGE)
	@node sim/web/bundle.mjs $< $(SHOW_MODEL) $(B)/web/emulator.js $@
