# For tests/boards/linux.sh: zstrip-linux for armhf, static, with libgpiod of two Debian releases
# (tests/boards/linux/packages.sh); the virtual machine's first process; the decoder of its pins.
# --no-fix-cortex-a8: where a branch lies across a page's end, binutils 2.40 redirects it, as that part's erratum asks,
# and forgets that memcpy is an ifunc in a static program: strncpy at such an address called memcpy's resolver and
# copied nothing.
# The linker warns of getgrgid in a static program: that it reads /etc/group there too is seen in the tests' sentences.
# Use: make -f tests/boards/linux/linux.mk B=build bookworm trixie
MAKEFLAGS += -r # as in Makefile
ARMHF = arm-linux-gnueabihf-
STATIC = -static -Wl,--no-fix-cortex-a8
CFLAGS = -O2 -Wall -Wextra -Werror -Wno-missing-field-initializers
B = build
D = $(B)/linux
INC = -Ifirmware/zstrip -Ifirmware/scenes -Ihal -Ihal/panel -Ihal/linux $(patsubst %/,-I%,$(wildcard sim/*/)) -I$(B)/gen
SOURCES := $(shell $(MAKE) -s --no-print-directory -f Makefile B=$(B) linux-sources)
OBJECTS = $(patsubst %.c,$(D)/obj/%.o,$(SOURCES)) $(D)/obj/gen/meshes.o

bookworm trixie: %: $(D)/%/zstrip-linux $(D)/%/kernel $(D)/init $(D)/wire
.PHONY: bookworm trixie
.DELETE_ON_ERROR:

$(D)/obj/gen/%.o: $(B)/gen/%.c
	@mkdir -p $(@D)
	@$(ARMHF)gcc -std=c11 -O1 $(INC) -c $< -o $@
$(D)/obj/%.o: %.c
	@mkdir -p $(@D)
	@$(ARMHF)gcc -std=gnu11 $(CFLAGS) $(INC) -pthread -DLINUX_MODELS=0 -DZS_STATS=1 -MMD -MP -c $< -o $@
$(D)/bookworm/zstrip-linux: hal/linux/gpio_v1.c
$(D)/trixie/zstrip-linux: hal/linux/gpio_v2.c
$(D)/%/zstrip-linux: $(D)/%/versions $(OBJECTS)
	@$(ARMHF)gcc -std=gnu11 $(CFLAGS) $(INC) -I$(D)/$*/include -pthread $(STATIC) $(filter %.c %.o,$^) \
	    $(D)/$*/lib/libgpiod.a -lm -o $@
$(D)/%/kernel: $(D)/%/versions tests/boards/linux/unpacked.sh
	@sh tests/boards/linux/unpacked.sh $(D)/$*/vmlinuz $@
$(D)/init: tests/boards/linux/init.c
	@mkdir -p $(@D)
	@$(ARMHF)gcc -std=gnu11 $(CFLAGS) $(STATIC) $< -o $@
$(D)/wire: tests/boards/linux/wire.c
	@mkdir -p $(@D)
	@gcc -std=c11 $(CFLAGS) $< -o $@

-include $(patsubst %.o,%.d,$(filter-out $(D)/obj/gen/%,$(OBJECTS)))
