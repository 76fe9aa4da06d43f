#!/bin/sh
# zstrip as other build systems take it: BUILD/package/zstrip-VERSION, a folder that is at once a CMake project, an
# Arduino library, a PlatformIO library and a component of ESP-IDF; the same as .tar.gz; and a Debian package.
# Usage: firmware/package/make.sh BUILD      from the repository's top
#
# SPDX-License-Identifier: MIT
set -eu
build=$1
version=$(sed -n 's/^#define ZS_VERSION_STRING "\(.*\)"/\1/p' firmware/zstrip/zstrip.h)
at=firmware/package
name=zstrip-$version
rm -rf "$build/package"
tree=$build/package/$name
mkdir -p "$tree/package"

# What stands in every one of them
cp -r firmware/zstrip "$tree/src"
cp -r hal "$tree/hal"
rm -f "$tree"/src/*.md
cp -r $at/sinks "$tree/sinks"
cp LICENSE "$tree/"
cp $at/README.md $at/CHANGELOG.md "$tree/"
mkdir "$tree/docs"
for f in DESIGN NUMERICS HISTORY README; do cp "firmware/zstrip/$f.md" "$tree/docs/"; done

# Build systems
for f in CMakeLists.txt; do sed "s/@VERSION@/$version/" $at/$f >"$tree/$f"; done
for f in library.properties library.json idf_component.yml; do sed "s/@VERSION@/$version/" $at/$f.in >"$tree/$f"; done
cp $at/*.pc.in "$tree/package/"

# Sketches, each with what it draws
for sketch in "$at"/sketches/*/; do
    to=$tree/examples/$(basename "$sketch")
    mkdir -p "$to"
    cp "$sketch"/*.ino $at/sketches/spinning_cube.c $at/sketches/spinning_cube.h "$to/"
done

(cd "$build/package" && tar --sort=name --owner=0 --group=0 --numeric-owner --mtime=@0 -czf "$name.tar.gz" "$name")

# Debian: what the CMake project installs
if command -v cmake >/dev/null && command -v dpkg-deb >/dev/null; then
    arch=$(dpkg --print-architecture)
    root=$build/package/debian
    tuple=$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || gcc -print-multiarch)
    cmake -S "$tree" -B "$build/package/cmake" -DCMAKE_RULE_MESSAGES=OFF -DCMAKE_BUILD_TYPE=Release \
        -DCMAKE_C_FLAGS="-ffile-prefix-map=$PWD=." -DCMAKE_INSTALL_PREFIX=/usr -DCMAKE_INSTALL_LIBDIR="lib/$tuple" \
        >"$build/package/cmake.log"
    cmake --build "$build/package/cmake" -j"$(nproc)" >>"$build/package/cmake.log"
    DESTDIR=$root cmake --install "$build/package/cmake" --strip >>"$build/package/cmake.log"
    doc=$root/usr/share/doc/libzstrip-dev
    mkdir -p "$doc" "$root/DEBIAN"
    sed "s/@VERSION@/$version/" $at/debian-copyright >"$doc/copyright"
    sed "s/@VERSION@/$version/" $at/debian-changelog | gzip -9n >"$doc/changelog.gz"
    gzip -9nc $at/CHANGELOG.md >"$doc/NEWS.gz"
    size=$(du -sk "$root/usr" | cut -f1)
    sed "s/@VERSION@/$version/; s/@ARCH@/$arch/; s/@SIZE@/$size/" $at/debian-control >"$root/DEBIAN/control"
    (cd "$root" && find usr -type f | sort | xargs md5sum) >"$root/DEBIAN/md5sums"
    find "$root" -type d -exec chmod 755 {} +
    find "$root" -type f -exec chmod 644 {} +
    dpkg-deb --root-owner-group --build "$root" "$build/package/libzstrip-dev_${version}_$arch.deb" >/dev/null
    rm -rf "$root" "$build/package/cmake"
else
    echo 'no Debian package: cmake or dpkg-deb is missing'
fi
echo "packages: $build/package"
ls "$build/package"
