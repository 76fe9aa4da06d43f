# What tests of pictures on panels share; after tests/tools/zsim.sh.
gcc -O1 -Wall -Wextra -Werror "$top/tests/tools/seen.c" -lpng -o "$work/seen" || exit 1
kind() { # PANEL
    case $1 in ssd0323*) echo grey ;; ssd1306*) echo mono ;; *) echo colour ;; esac
}
turned() { # WxH DEGREES
    case $2 in 90 | 270) echo "${1#*x}x${1%x*}" ;; *) echo "$1" ;; esac
}
