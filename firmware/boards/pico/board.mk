# Raspberry Pi Pico: RP2040, Cortex-M0+ at 125 MHz, 264 KB of RAM, 2 MB of flash. The wiring: hal/rp2040/pins.h.
# -O3 draws some 5 % quicker than -O2, for 3 KB of RAM.
BOARD_ABOUT = Raspberry Pi Pico: RP2040, Cortex-M0+; ST7789 240x240
BOARD_FLASH = 2097152
BOARD_RAM = 270336
BOARD_IMAGES = bin uf2
BOARD_CC = arm-none-eabi-gcc
BOARD_CPU = -mcpu=cortex-m0plus -mthumb -DZS_RP2040=1
DATA_CPU = -mcpu=cortex-m0 -mthumb
OPT = -O3
BOARD_HAL = rp2040
BOARD_SRC = firmware/boards/pico/startup.c firmware/boards/pico/divide.S hal/stack/stack.c hal/cortexm/board.c \
            hal/spi/spi_bus.c
BOARD_SECOND = hal/rp2040/second/second.c
BOARD_DEPS = firmware/boards/pico/pico.ld $(OUT)/stage2.o
BOARD_LINK = -T firmware/boards/pico/pico.ld -nostartfiles $(OUT)/stage2.o
BOARD_RUN = echo Drag onto the drive of the Pico the .uf2 of

# The second stage: assembled, sealed with its checksum, linked as data
$(OUT)/stage2.bin: firmware/boards/pico/boot2.S
	@mkdir -p $(@D)
	@$(BOARD_CC) $(BOARD_CPU) -c $< -o $(OUT)/boot2.o
	@arm-none-eabi-objcopy -O binary -j .boot2 $(OUT)/boot2.o $@
$(OUT)/host/%: firmware/boards/pico/host/%.c
	@mkdir -p $(@D)
	@gcc -std=c11 -O1 -Wall -Wextra $< -o $@
$(OUT)/stage2.c: $(OUT)/stage2.bin $(OUT)/host/seal
	@$(OUT)/host/seal $< $@
$(OUT)/stage2.o: $(OUT)/stage2.c
	@$(BOARD_CC) $(BOARD_CPU) -c $< -o $@

$(OUT)/$(NAME).uf2: $(OUT)/$(NAME).bin $(OUT)/host/uf2
	@$(OUT)/host/uf2 $< $@
