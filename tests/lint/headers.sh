#!/bin/sh
# Every header says first what it is, and compiles alone, twice in one file, without a warning; with what every build defines
# (cmake/glint.cmake).
. "$(dirname -- "$0")/lib.sh"
command -v "${CC:-cc}" >/dev/null || exit 77

ours '\.h$' | while IFS= read -r header; do
    head -n 1 "$header" | grep -q '^/[/*] [^ ]' || echo "$header:1: does not open with what it is"
    printf '#include "%s"\n#include "%s"\ntypedef int glint_lint;\n' "$header" "$header" |
        "${CC:-cc}" -std=c11 -Wall -Wextra -Wpedantic -Wstrict-prototypes -Werror -D_POSIX_C_SOURCE=200809L \
            -D_DEFAULT_SOURCE -DCLI_HAS_DEVICES=1 -S -o /dev/null -I . -x c - >/dev/null 2>&1 ||
        echo "$header:1: does not compile alone, as #include \"$header\""
done | verdict
