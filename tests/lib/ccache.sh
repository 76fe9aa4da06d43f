# Sourced with $build: compilers through ccache, where it is installed. Many programs and parts compile the same source
# with the same options: once. The cache is the user's own, so that another build folder or clone finds there what it
# compiles alike; CCACHE_DIR says another place, and where neither can be written it is in the build folder. Headers are
# those that the compiler names (-MMD), without running the preprocessor by itself. Neither the folder of a copy of the
# repository matters nor the terminal's language: paths in the copy, such as CMake's, are taken as relative ones.
ccache=$(command -v ccache)
if [ -n "$ccache" ] && mkdir -p "$build/ccache/bin"; then
    ccache_links=$(cd "$build/ccache/bin" && pwd)
    for compiler in gcc g++ cc clang clang++ arm-none-eabi-gcc arm-linux-gnueabihf-gcc riscv64-unknown-elf-gcc \
        powerpc-linux-gnu-gcc; do
        ln -sf "$ccache" "$ccache_links/$compiler"
    done
    PATH=$ccache_links:$PATH
    CCACHE_DIR=${CCACHE_DIR:-$(ccache --get-config cache_dir)}
    mkdir -p "$CCACHE_DIR" && [ -w "$CCACHE_DIR" ] || CCACHE_DIR=$(dirname "$ccache_links")
    CCACHE_DEPEND=1 CCACHE_NOHASHDIR=1 CCACHE_BASEDIR=$PWD CCACHE_NOCOMPRESS=1 CCACHE_SLOPPINESS=locale
    # Large pages for the compilers and the linker: a link takes a quarter less
    GLIBC_TUNABLES=${GLIBC_TUNABLES:-glibc.malloc.hugetlb=1}
    export PATH GLIBC_TUNABLES
    export CCACHE_DIR CCACHE_DEPEND CCACHE_NOHASHDIR CCACHE_BASEDIR CCACHE_NOCOMPRESS CCACHE_SLOPPINESS
fi
