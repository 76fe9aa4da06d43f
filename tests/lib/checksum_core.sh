# The renderer as a checksum program has it (tests.mk), for programs of this machine: what the same compiler would make
# again at the same level would say nothing new. Sourced, from the repository's top.
#
# SPDX-License-Identifier: MIT

# BUILD NAME: options of firmware.mk; nothing where the program is not there, or a source is newer
checksum_core() {
    program=$1/test/checksum-$2
    [ -x "$program" ] && [ -z "$(find firmware/zstrip -name '*.[ch]' -newer "$program" | head -1)" ] || return 0
    echo "CORE_OBJ=$program.o DEFINES=-DZS_VARYINGS_MAX=8"
}
