#!/bin/sh
# `make package`: consumers that are built from what it wrote alone, moved elsewhere. CMake, pkg-config and Debian for
# real; Arduino, ESP-IDF, pico-sdk, STM32Cube, Zephyr and LVGL over stubs of their libraries, into whose display each
# draws the same picture; PlatformIO's and Arduino's files by the rules of their formats.
# Usage: tests/tools/package.sh BUILD     from the repository's top
set -u
build=$1
top=$PWD
work=$build/test/package
. tests/lib/cmake.sh
. tests/lib/ok.sh
rm -rf "$work"
mkdir -p "$work"
work=$(cd "$work" && pwd)
here=$top/tests/tools/package

verdict() { # NAME FILE    the file says why not, or is empty
    if [ -s "$2" ]; then bad "$1" "$(tail -3 "$2" | tr '\n' ' ')"; else ok "$1"; fi
}
sh firmware/package/make.sh "$build" >"$work/made.txt" 2>&1 || { bad package "$(tail -3 "$work/made.txt")"; exit 1; }
version=$(sed -n 's/^#define ZS_VERSION_STRING "\(.*\)"/\1/p' firmware/zstrip/zstrip.h)
cp "$build/package/zstrip-$version.tar.gz" "$build"/package/*.deb "$work/"
cd "$work" || exit 1
tar -xzf "zstrip-$version.tar.gz"
zs=$work/zstrip-$version
grep -rlF "$top" "$zs" >paths.txt
verdict package_names_no_path_of_this_machine paths.txt
CC="gcc -std=c11 -O1 -Wall -Wextra -Werror"
CXX="g++ -std=gnu++11 -Wall -Wextra -Werror"
compiled() { # OPTION... -- SOURCE...: their objects, $made; a file a call is what ccache keeps
    options= made=
    while [ "$1" != -- ]; do options="$options $1" && shift; done
    shift
    for source; do
        object=${source##*/}
        object=${object%.*}.o made="$made ${object%.*}.o"
        case $source in
        *.c) $CC $options -MMD -c "$source" -o "$object" || return ;;
        *) $CXX $options -MMD -c "$source" -o "$object" || return ;;
        esac
    done
}

# ---- CMake -------------------------------------------------------------------------------------------------------
consumer() { # FOLDER, the lines that find zstrip
    mkdir -p "$1"
    { echo 'cmake_minimum_required(VERSION 3.14)'; echo 'project(consumer C)'; cat; cat <<'END'
add_executable(consumer ../run_none.c ../spinning_cube.c ../stub.c)
target_include_directories(consumer PRIVATE .. ../stubs)
target_link_libraries(consumer zstrip::zstrip)
END
    } >"$1/CMakeLists.txt"
}
cp "$here/run_none.c" "$here/stubs/stub.c" "$zs"/examples/TFT_eSPI_cube/spinning_cube.[ch] .
cp -r "$here/stubs" .
built() { # NAME FOLDER CMAKE-OPTIONS...    and draws
    of=$1 folder=$2
    shift 2
    { configured "$folder" "$folder/build" "$@" && cmake --build "$folder/build" -j2 --target consumer &&
        "$folder/build/consumer" "$folder/got.bin" && cmp want.bin "$folder/got.bin"; } >"$folder.log" 2>&1 &&
        : >"$folder.log"
    verdict "$of" "$folder.log"
}
consumer fetched <<END
include(FetchContent)
FetchContent_Declare(zstrip URL "$work/zstrip-$version.tar.gz" SOURCE_DIR "$zs")
FetchContent_MakeAvailable(zstrip)
END
configured fetched fetched/build >fetched.log 2>&1 && cmake --build fetched/build -j2 >>fetched.log 2>&1 &&
    fetched/build/consumer want.bin && : >fetched.log
verdict package_cmake_fetchcontent fetched.log
[ "$(od -An -v -tx2 -w2 want.bin | sort -u | wc -l)" -ge 3 ] || bad package_picture 'no cube can be seen'
libraries=$work/fetched/build/_deps/zstrip-build
lib=$libraries/libzstrip.a panel=$libraries/libzstrip_panel.a
consumer added <<END
add_subdirectory("$zs" zstrip_added)
END
built package_cmake_add_subdirectory added
{ configured "$zs" installing -DCMAKE_INSTALL_PREFIX="$work/root" -DZSTRIP_VARYINGS_MAX=8 &&
    cmake --build installing -j2 && cmake --install installing; } >install.log 2>&1 && : >install.log
verdict package_cmake_installs install.log
mv root moved
consumer found <<'END'
find_package(zstrip 0.9 REQUIRED)
END
built package_cmake_find_package found -DCMAKE_PREFIX_PATH="$work/moved"
consumer newer <<'END'
find_package(zstrip 1.0 REQUIRED)
END
configured newer newer/build -DCMAKE_PREFIX_PATH="$work/moved" >newer.log 2>&1 &&
    bad package_cmake_refuses_another_version 'it was taken' || ok package_cmake_refuses_another_version

# ---- pkg-config, Debian ------------------------------------------------------------------------------------------
by_pkg_config() { # NAME FOLDER-OF-PC-FILES OPTION...
    of=$1 at=$2
    shift 2
    PKG_CONFIG_PATH=$at pkg-config "$@" --cflags --libs zstrip >flags.txt 2>&1 &&
        { compiled -I. -Istubs $(cat flags.txt) -- run_none.c spinning_cube.c stub.c &&
            $CC $made $(cat flags.txt) -o by_pkg; } >pkg.log 2>&1 &&
        ./by_pkg got.bin &&
        cmp want.bin got.bin >pkg.log 2>&1 && : >pkg.log || cat flags.txt >>pkg.log
    verdict "$of" pkg.log
}
by_pkg_config package_pkg_config "$(find "$work/moved" -name pkgconfig)" --define-prefix
# what a program was compiled for is the library's: 8 here
{ compiled -I. -Istubs -Imoved/include/zstrip -- run_none.c spinning_cube.c stub.c &&
    $CC $made "$(find moved -name libzstrip.a)" -o other; } 2>other.log && ./other got.bin &&
    bad package_refuses_other_varyings 'a library for 8 values took a program for 3' ||
    ok package_refuses_other_varyings
deb=$(echo libzstrip-dev_*.deb)
dpkg-deb -x "$deb" debian
export PKG_CONFIG_SYSROOT_DIR="$work/debian" # the package is unpacked, not installed
by_pkg_config package_debian "$(find "$work/debian" -name pkgconfig)"
cat >linux.c <<'END'
#include "linux.h"
#include "panel.h"
int main(void)
{
    static const struct linux_wiring wiring = { .spi = "/dev/none", .hz = 1000, .dc = "GPIO25" };
    linux_wire(&wiring);
    return hal_init() ? linux_why()[0] == '\0' : 1;
}
END
gcc linux.c $(PKG_CONFIG_PATH=$(find "$work/debian" -name pkgconfig) pkg-config --cflags zstrip-panel) \
    "$(find debian -name libzstrip_linux.a)" "$(find debian -name libzstrip_panel.a)" \
    -lgpiod -pthread -o linux >linux.log 2>&1 && ./linux 2>linux.log && : >linux.log
verdict package_linux linux.log
# the project has no mail address yet
lintian --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$deb" 2>&1 | grep -E '^[EW]:' >lintian.log
verdict package_lintian lintian.log

# ---- Over stubs --------------------------------------------------------------------------------------------------
src=zstrip-$version/src
for sketch in "$zs"/examples/*/*.ino; do
    of=$(basename "$sketch" .ino)
    cp "$sketch" sketch.cpp
    { compiled -Istubs "-I$src" "-I$src/../examples/$of" -include Arduino.h -- sketch.cpp "$here/run_arduino.cpp" &&
        compiled -Istubs "-I$src" -- stub.c "${sketch%/*}/spinning_cube.c" &&
        g++ sketch.o run_arduino.o stub.o spinning_cube.o "$lib" -o sketch && ./sketch got.bin &&
        cmp want.bin got.bin; } >sketch.log 2>&1 && : >sketch.log
    verdict "package_arduino_$of" sketch.log
    [ "$(wc -l <"$sketch")" -le 60 ] || bad "package_arduino_$of" 'longer than 60 lines'
done
compiled -Istubs -I. "-I$src" -- spinning_cube.c stub.c
for sink in stm32cube pico_sdk esp_idf zephyr lvgl; do
    { compiled -Istubs -I. "-I$src" "-I$src/../hal" "-I$src/../hal/panel" -- "$here/run_$sink.c" "$zs/sinks/$sink.c" &&
        $CC $made spinning_cube.o stub.o "$panel" "$lib" -o sink && ./sink got.bin &&
        cmp want.bin got.bin; } >sink.log 2>&1 && : >sink.log
    verdict "package_sink_$sink" sink.log
done

# CMake's functions of ESP-IDF and of the pico-sdk
mkdir -p idf pico
cat >idf/CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.14)
project(idf C)
set(ESP_PLATFORM 1)
set(COMPONENT_LIB component)
function(idf_component_register)
  cmake_parse_arguments(of "" "" "SRCS;INCLUDE_DIRS" \${ARGN})
  list(TRANSFORM of_INCLUDE_DIRS PREPEND "\${CMAKE_CURRENT_LIST_DIR}/")
  add_library(component STATIC \${of_SRCS})
  target_include_directories(component PUBLIC \${of_INCLUDE_DIRS})
endfunction()
add_subdirectory("$zs" zstrip)
add_executable(consumer ../run_none.c ../spinning_cube.c ../stub.c)
target_include_directories(consumer PRIVATE .. ../stubs)
target_link_libraries(consumer component)
END
built package_esp_idf_component idf -DZSTRIP_VARYINGS_MAX=5
grep -rqs -- '-DZS_VARYINGS_MAX=5' idf/build && ok package_esp_idf_has_varyings ||
    bad package_esp_idf_has_varyings 'ZSTRIP_VARYINGS_MAX=5 does nothing'
# A firmware has no place for the table that position-independent code reads
cmake -S "$zs" -B bare -DCMAKE_SYSTEM_NAME=Generic -DCMAKE_C_COMPILER=arm-none-eabi-gcc -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_FLAGS='-mcpu=cortex-m33 -mthumb' -DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >bare.log 2>&1 &&
    mkdir -p bare/CMakeFiles/zstrip.dir/src/fast && (cd bare &&
        sh -c "$(sed -n 's/^ *"command": "\(.*texture_v7m.c\)",*$/\1/p' compile_commands.json)") >bare.log 2>&1 &&
    : >bare.log
grep -q -- -fPIC bare/compile_commands.json && echo 'position-independent' >>bare.log
grep -q '"command": .*texture_v7m.c",*$' bare/compile_commands.json || echo 'nothing was compiled' >>bare.log
verdict package_cmake_for_a_microcontroller bare.log
cat >pico/CMakeLists.txt <<END
cmake_minimum_required(VERSION 3.14)
project(pico C)
set(PICO_SDK_VERSION_STRING 1.5.1)
add_subdirectory("$zs" zstrip)
add_executable(consumer ../run_none.c ../spinning_cube.c ../stub.c)
target_include_directories(consumer PRIVATE .. ../stubs)
target_link_libraries(consumer zstrip::zstrip zstrip::panel)
END
built package_pico_sdk_interface pico

# ---- The rules of formats ----------------------------------------------------------------------------------------
: >rules.log
for field in name version author maintainer sentence paragraph category architectures includes; do
    grep -qE "^$field=.+" "$zs/library.properties" || echo "library.properties: no $field" >>rules.log
done
grep -q '^category=Display$' "$zs/library.properties" || echo 'an unknown category' >>rules.log
grep -qx "version=$version" "$zs/library.properties" || echo 'another version than the headers' >>rules.log
for sketch in "$zs"/examples/*; do
    [ -f "$sketch/$(basename "$sketch").ino" ] || echo "$sketch: its .ino has another name" >>rules.log
done
find "$zs/src" -name '*.ino' -o -name 'main.c' >>rules.log
verdict package_arduino_rules rules.log
node -e '
const j = JSON.parse(require("fs").readFileSync(process.argv[1]));
const text = ["name", "version", "description", "license"], want = { keywords: "object", build: "object" };
for (const k of text) want[k] = "string";
for (const k in want) if (typeof j[k] !== want[k]) console.log("library.json: " + k);
if (!/^[0-9]+\.[0-9]+\.[0-9]+$/.test(j.version) || j.version !== process.argv[2]) console.log("version " + j.version);
const at = process.argv[3] + "/" + j.build.includeDir + "/";
for (const h of j.headers) if (!require("fs").existsSync(at + h)) console.log("no " + h);
' "$zs/library.json" "$version" "$zs" >rules.log 2>&1
verdict package_platformio_rules rules.log
grep -qx "version: \"$version\"" "$zs/idf_component.yml" && ok package_esp_idf_rules ||
    bad package_esp_idf_rules "another version"
grep -q "^## $version" "$zs/CHANGELOG.md" && ok package_changelog_has_the_version ||
    bad package_changelog_has_the_version "no $version"
exit $failed
