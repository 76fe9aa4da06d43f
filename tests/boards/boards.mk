# Boards

## pico: the demo scenes on an emulated Raspberry Pi Pico: cycles, wire, frames a second
pico: $(B)/.setup-test
	+@$(MAKE_ALL) $(B)/zsim
	@sh tests/boards/pico.sh $(B) table

## boards: two demo scenes on every board with a panel: flash, RAM, stack, instructions or cycles a frame
boards: $(B)/.setup-test
	+@$(MAKE_ALL) $(B)/zsim
	@sh tests/boards/table.sh $(B)

## profile: SCENE=teapot [BOARD=mps2]: cycles a frame by function on the emulated Pico; instructions on QEMU's
profile: $(B)/.setup-test $(B)/gen/meshes.h
ifeq ($(BOARD),pico)
	@PICO_SCENES=$(SCENE) sh tests/boards/pico.sh $(B) profile
else
	@sh tests/boards/profile.sh $(B) $(BOARD) $(SCENE) $(FUNCTION)
endif
.PHONY: boards pico profile
