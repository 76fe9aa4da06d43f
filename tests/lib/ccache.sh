# Sourced with $build: compilers through ccache, where it is installed. Many programs and parts compile the same source
# with the same options: once. The cache is of this build folder. Headers are those that the compiler names (-MMD),
# without running the preprocessor by itself; where a copy of the repository lies does not matter.
ccache=$(command -v ccache)
if [ -n "$ccache" ] && mkdir -p "$build/ccache/bin"; then
    CCACHE_DIR=$(cd "$build/ccache" && pwd)
    for compiler in gcc cc clang arm-none-eabi-gcc arm-linux-gnueabihf-gcc riscv64-unknown-elf-gcc \
        powerpc-linux-gnu-gcc; do
        ln -sf "$ccache" "$CCACHE_DIR/bin/$compiler"
    done
    PATH=$CCACHE_DIR/bin:$PATH
    CCACHE_DEPEND=1 CCACHE_NOHASHDIR=1 CCACHE_NOCOMPRESS=1
    export PATH CCACHE_DIR CCACHE_DEPEND CCACHE_NOHASHDIR CCACHE_NOCOMPRESS
fi
