# Headers of zstrip whose structs take designated initialisers alone, and what GCC then says. Sourced.
#
# SPDX-License-Identifier: MIT

# Structs whose fields may be reordered, added or removed. Not zs_rgb and zs_rect, whose order is known to all, nor
# those that macros of its headers make.
DESIGNATED='texture cluster mesh material pose instance light scene camera config strip sink depth_state background
    resolve pass blend lighting lamp dither shadowed_material'

# DIR [REPOSITORY]: firmware/zstrip's headers, of a repository or of this one; fails where a struct is not found.
designated_headers() {
    mkdir -p "$1" && to=$(cd "$1" && pwd) && (cd "${2:-.}/firmware/zstrip" && cp --parents ./*.h ./*/*.h "$to") ||
        return 1
    for struct in $DESIGNATED; do
        sed -i "s/^struct zs_$struct {/struct __attribute__((designated_init)) zs_$struct {/" "$1"/*.h
        grep -q "designated_init)) zs_$struct {" "$1"/*.h || return 1
    done
}

# TO OPTION... -- FILE...: "file:line" of positional initialisers, but { 0 } and those that a macro of zstrip's headers
# makes on lines of its own (ZS_HIDDEN_LINE_STATE, which C++ takes, too), and errors, by gcc. Each file is compiled to
# TO, in a call of its own: ccache keeps what gcc says of it, and nothing of -fsyntax-only (tests/lib/ccache.sh).
positional() {
    to=$1 options=''
    shift
    while [ "$1" != -- ]; do
        options="$options $1"
        shift
    done
    shift
    for file in "$@"; do
        # shellcheck disable=SC2086
        LC_ALL=C gcc $options -Wdesignated-init -fdiagnostics-color=never -MMD -S "$file" -o "$to"
    done 2>&1 | awk '
        / error: / { print; next }
        /\[-Wdesignated-init\]/ {
            split($1, at, ":")
            getline
            sub(/^ *[0-9]+ \| /, "")
            if (substr($0, at[3] - 2, 5) != "{ 0 }" && !(at[1] ~ /(^|\/)zs_[a-z_]*\.h$/ && /\\$/))
                print at[1] ":" at[2]
        }'
}
