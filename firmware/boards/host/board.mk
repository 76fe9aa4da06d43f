# No board at all: the same application as a program on this machine.
BOARD_ABOUT = this machine, as a program
BOARD_CC = gcc
BOARD_CPU =
BOARD_HAL = host
BOARD_SRC =
BOARD_DEPS =
BOARD_LINK =
BOARD_RUN =
