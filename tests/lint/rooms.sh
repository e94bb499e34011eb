#!/bin/sh
# Every room of cmake/rooms.txt says what it holds, in a README.md of at most ten lines or in the header of its
# name, and is small enough to be known: at most 40 source files, 6 000 lines. A folder inside a room is a room.
. "$(dirname -- "$0")/lib.sh"

sources=$(ours '\.(c|h|glsl|comp|def)$')
rooms=$(sed -n 's/^\([a-z][^:]*\):.*/\1/p' cmake/rooms.txt)
{
    # shellcheck disable=SC2086 -- our paths hold no blanks
    printf '%s\n' "$sources" | awk -v rooms="$(echo $rooms)" '
    BEGIN {
        count = split(rooms, name, " ")
        for (i = 1; i <= count; i++) {
            is_room[name[i]] = 1
            sub(/\/.*/, "", name[i])
            is_top[name[i]] = 1
        }
    }
    {
        folder = top = $0
        sub(/\/[^\/]*$/, "", folder)
        sub(/\/.*/, "", top)
        if (top in is_top && !(folder in is_room) && !seen[folder]++)
            print folder ":1: is not a room of cmake/rooms.txt, but holds " substr($0, length(folder) + 2)
    }'
    printf '%s\n' "$rooms" | while IFS= read -r room; do
        if [ -f "$room/README.md" ]; then
            lines=$(wc -l <"$room/README.md")
            [ "$lines" -le 10 ] || echo "$room/README.md:11: more than ten lines"
        elif [ ! -f "$room/${room##*/}.h" ]; then
            echo "$room:1: neither README.md nor ${room##*/}.h says what it holds"
        fi
        files=$(printf '%s\n' "$sources" | grep -E "^$room/[^/]*\$" || true)
        [ -n "$files" ] || continue
        count=$(printf '%s\n' "$files" | wc -l)
        [ "$count" -le 40 ] || echo "$room:1: $count source files, more than 40"
        # shellcheck disable=SC2086 -- our paths hold no blanks
        lines=$(cat $files | wc -l)
        [ "$lines" -le 6000 ] || echo "$room:1: $lines lines, more than 6000"
    done
} | verdict
