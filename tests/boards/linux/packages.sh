#!/bin/sh
# A Debian release's armhf kernel and libgpiod, from where this machine's own packages come: nothing is installed, and
# nothing of the machine's apt is changed, so that any user may run it. What is there already is kept.
# Usage: tests/boards/linux/packages.sh FOLDER RELEASE
# Leaves FOLDER/vmlinuz, FOLDER/include/gpiod.h, FOLDER/lib/libgpiod.a and FOLDER/versions, or says in one line why not.
#
# SPDX-License-Identifier: MIT
set -u
mkdir -p "$1" && root=$(cd "$1" && pwd) || exit 1
release=$2
apt=$root/apt
[ -e "$root/versions" ] && exit 0

why() { # WHAT LOG    what went wrong, and apt's own first words on it
    echo "$1: $(sed -n 's/^E: //p' "$2" | head -1 | cut -c1-200)"
    exit 1
}

# The archive: that of the machine's own Debian, not its security or update suites.
. /etc/os-release
site=$(apt-get indextargets --format '$(SITE) $(RELEASE) $(COMPONENT)' 'Identifier: Packages' 2>/dev/null |
    awk -v own="${VERSION_CODENAME:-}" '$3 == "main" && ($2 == own || $2 ~ /^(old)?stable$/) { print $1; exit }')
if [ -z "$site" ]; then
    echo "apt names no archive of this machine's own Debian release"
    exit 1
fi

rm -rf "$apt" && mkdir -p "$apt/lists/partial" "$apt/archives/partial" "$apt/tree" "$apt/none" || exit 1
: >"$apt/status"
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $site $release main" >"$apt/sources.list"
# The machine's proxies and checks stay; its hooks, other sources and packages do not.
{
    apt-config dump | grep -E '^Acquire::(https?|Check)'
    cat <<END
Dir::Etc::SourceList "$apt/sources.list";
Dir::Etc::SourceParts "$apt/none";
Dir::Etc::Main "/dev/null";
Dir::Etc::Parts "$apt/none";
Dir::Etc::Preferences "/dev/null";
Dir::Etc::PreferencesParts "$apt/none";
Dir::State "$apt";
Dir::State::Status "$apt/status";
Dir::Cache "$apt";
APT::Architecture "armhf";
APT::Architectures { "armhf"; };
APT::Sandbox::User "";
Acquire::Languages "none";
Acquire::Retries "1";
Acquire::http::Timeout "20";
Acquire::https::Timeout "20";
END
} >"$apt/apt.conf"
export APT_CONFIG="$apt/apt.conf"

apt-get update -q -o APT::Update::Error-Mode=any >"$apt/log" 2>&1 || why "$release cannot be reached" "$apt/log"
image=$(apt-cache depends linux-image-armmp 2>>"$apt/log" |
    sed -n 's/^ *Depends: \(linux-image-[^ ]*\)$/\1/p' | head -1)
[ -n "$image" ] || why "$release has no armhf kernel" "$apt/log"
cd "$apt/tree" || exit 1
apt-get download -q "$image" libgpiod-dev >>"$apt/log" 2>&1 || why "$image, libgpiod-dev" "$apt/log"
for deb in *.deb; do
    dpkg-deb --fsys-tarfile "$deb" |
        tar -xf - --wildcards './boot/vmlinuz*' './usr/include/*' './usr/lib/*/libgpiod.a' 2>/dev/null
done
mkdir -p "$root/include" "$root/lib"
cp boot/vmlinuz-* "$root/vmlinuz" && cp usr/include/gpiod.h "$root/include/" && cp usr/lib/*/libgpiod.a "$root/lib/" ||
    { echo "the packages hold no kernel or no static libgpiod"; exit 1; }
for deb in *.deb; do
    dpkg-deb -W "$deb"
done >"$apt/versions"
cd "$root" && mv "$apt/versions" versions && rm -rf "$apt"
