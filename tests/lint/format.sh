#!/bin/sh
# Everything is as clang-format would write it.
. "$(dirname -- "$0")/lib.sh"
command -v clang-format >/dev/null || exit 77

sources=$(ours '\.[ch]$')
[ -z "$sources" ] && exit 0
# shellcheck disable=SC2086
{ clang-format --dry-run -Werror $sources 2>&1 || true; } |
    sed -n 's/^\([^: ]*\):\([0-9]*\):.*\[-Wclang-format-violations\]$/\1:\2: run clang-format -i on this file/p' |
    awk -F: '!seen[$1]++' | verdict
