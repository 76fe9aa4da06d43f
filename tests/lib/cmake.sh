# Projects that tests build by CMake. Sourced, not run. A process of CMake's own costs as much as three compilations out
# of the cache, so there are few: by ninja where it is installed, or else without a line for each object, and the
# compiler is found out once. What CMake then knows of it is put where it looks for that in the next build folder.
# ar, too, is told of no plugins, as it would load LLVM; it writes the index of an archive itself, without ranlib.
#
# SPDX-License-Identifier: MIT
cmake_known=
cmake_by='-G Ninja'
command -v ninja >/dev/null || cmake_by=-DCMAKE_RULE_MESSAGES=OFF
cmake_ar='<CMAKE_AR> --plugin= qc <TARGET> <LINK_FLAGS> <OBJECTS>'
configured() { # SOURCE BUILD OPTION... of cmake
    source=$1 to=$2
    shift 2
    mkdir -p "$to/CMakeFiles" && source=$(cd "$source" && pwd) && to=$(cd "$to" && pwd) || return
    if [ -n "$cmake_known" ]; then
        cp -r "$cmake_known"/CMakeFiles/[0-9]* "$to/CMakeFiles/"
        { grep -E '^CMAKE_(GENERATOR|MAKE_PROGRAM|PLATFORM_INFO_INITIALIZED):' "$cmake_known/CMakeCache.txt"
            echo "CMAKE_HOME_DIRECTORY:INTERNAL=$source"
            echo "CMAKE_CACHEFILE_DIR:INTERNAL=$to"; } >"$to/CMakeCache.txt"
    fi
    # shellcheck disable=SC2086
    cmake -S "$source" -B "$to" $cmake_by -DCMAKE_C_ARCHIVE_CREATE="$cmake_ar" -DCMAKE_C_ARCHIVE_FINISH= "$@" &&
        cmake_known=$to
}
