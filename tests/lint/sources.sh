#!/bin/sh
# Every source file is built: a CMakeLists.txt at its folder or above names it. Each file of GLSL is included by another.
. "$(dirname -- "$0")/lib.sh"

{
    included=$(ours '^shaders/.*\.(glsl|comp)$|^tests/.*\.comp$')
    # shellcheck disable=SC2086 -- our paths hold no blanks
    [ -z "$included" ] || included=$(sed -n 's/^[ \t]*#[ \t]*include "\([^"]*\)".*/\1/p' $included | sort -u)
    ours '^shaders/.*\.glsl$' | while IFS= read -r path; do
        printf '%s\n' "$included" | grep -qxF "${path#shaders/}" || echo "$path:1: no GLSL includes it"
    done
    ours '\.(c|comp)$' | while IFS= read -r path; do
        base=${path##*/}
        stem=${base%.c}
        found=no
        folder=./$path
        while [ "$folder" != . ]; do
            folder=${folder%/*}
            list=$folder/CMakeLists.txt
            [ -f "$list" ] || continue
            grep -qE "(^|[^A-Za-z0-9_-])$base([^A-Za-z0-9_]|\$)" "$list" && found=yes
            # glint_unit_test(NAME ...) builds test_NAME.c
            case $stem in test_*) grep -qE "(^|[^A-Za-z0-9_-])${stem#test_}([^A-Za-z0-9_]|\$)" "$list" && found=yes ;; esac
            # A room's library takes every C file of its folder and of those inside.
            grep -qE '^ *glint_room\(|GLOB.*\*\.(c|\[ch\])' "$list" && found=yes
        done
        [ $found = yes ] || echo "$path:1: no CMakeLists.txt builds it"
    done
} | verdict
