# Debian packages: what the simulator and zstrip-linux are built from, and what tests and fuzzers need besides
PKG_SIM = gcc libc6-dev libassimp-dev libmeshoptimizer-dev libpng-dev zlib1g-dev libturbojpeg0-dev
PKG_VIEW = $(PKG_SIM) libsdl2-dev
PKG_LINUX = $(PKG_SIM) libgpiod-dev pkg-config
PKG_TEST = $(PKG_LINUX) libsdl2-dev libx11-dev xvfb xdotool ccache $(PKG_PACKAGE) $(PKG_WEB_TEST) lintian \
           gnuplot-nox g++ clang binutils libcmocka-dev \
           gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm \
           $(PKG_RISCV) qemu-system-misc gcc-arm-linux-gnueabihf libc6-dev-armhf-cross device-tree-compiler cpio \
           gcc-powerpc-linux-gnu libc6-dev-powerpc-cross qemu-user-static $(if $(shell command -v npm),,nodejs npm)
PKG_BENCH = $(PKG_TEST) valgrind
PKG_SCALE = $(PKG_TEST) gnuplot-nox
PKG_FUZZ = $(PKG_TEST) libclang-rt-14-dev
PKG_REPORT = $(PKG_SIM) gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm gnuplot-nox \
             valgrind $(if $(shell command -v npm),,nodejs npm)
PKG_SHOW = $(PKG_SIM) gcc-arm-none-eabi libnewlib-arm-none-eabi $(if $(shell command -v npm),,nodejs npm)
PKG_ENGINE = gcc libc6-dev libmeshoptimizer-dev clang lld wasi-libc libclang-rt-14-dev-wasm32
PKG_WEB = $(PKG_ENGINE) gcc-arm-none-eabi libnewlib-arm-none-eabi esbuild $(if $(shell command -v npm),,nodejs npm)
PKG_WEB_TEST = $(PKG_WEB) chromium
PKG_PACKAGE = gcc libc6-dev cmake dpkg-dev libgpiod-dev pkg-config
PKG_PROVE = gcc libc6-dev frama-c-base
PKG_COVERAGE = gcovr
PKG_COMPLEXITY = pmccabe similarity-tester
PKG_RISCV = gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf
# Of the board that is asked for
PKG_FW = gcc libc6-dev $(if $(filter rv32,$(BOARD)),$(PKG_RISCV),gcc-arm-none-eabi libnewlib-arm-none-eabi)

# $(B)/.setup-NAME: these are installed; and so are those of the names after it
define setup
$(B)/.setup-$1:
	@mkdir -p $(B) && .ci/setup $$(PKG_$2) && touch $(foreach s,$1 $3,$(B)/.setup-$s)
endef
$(eval $(call setup,sim,SIM))
$(eval $(call setup,view,VIEW,sim))
$(eval $(call setup,linux,LINUX,sim))
$(eval $(call setup,test,TEST,linux view sim engine web))
$(eval $(call setup,bench,BENCH,test linux sim))
$(eval $(call setup,scale,SCALE,test linux sim))
$(eval $(call setup,fuzz,FUZZ,test linux sim))
$(eval $(call setup,report,REPORT,sim))
$(eval $(call setup,package,PACKAGE))
$(eval $(call setup,engine,ENGINE))
$(eval $(call setup,web,WEB,engine))
$(eval $(call setup,show,SHOW,sim fw-pico))
$(B)/.setup-fw-$(BOARD):
	@$(SHOW) hal >/dev/null # a wrong name is told before anything is installed
	@mkdir -p $(B) && .ci/setup $(PKG_FW) && touch $@
