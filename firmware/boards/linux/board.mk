# Linux with a panel on spidev and GPIO lines: a Raspberry Pi. The wiring is the program's (hal/linux/linux.h).
# libgpiod's version decides which of two files is taken.
BOARD_ABOUT = Linux, a panel on spidev and libgpiod
BOARD_CC = gcc
BOARD_CPU =
BOARD_HAL = linux/none
BOARD_SRC = $(filter-out hal/linux/gpio_v$(if $(filter 1.%,$(shell pkg-config --modversion libgpiod)),2,1).c,\
                         $(wildcard hal/linux/*.c))
BOARD_DEPS =
BOARD_FLAGS = -D_GNU_SOURCE -pthread -Ihal/linux -DHAL_LINUX=1
BOARD_LINK = -pthread
BOARD_LIBS = -lgpiod
BOARD_RUN =
