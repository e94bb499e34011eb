#!/bin/sh
# Every room of cmake/rooms.txt says what it holds, in a README.md of at most ten lines or in the header of its name, and a
# folder of sources is in one. How large rooms are is printed, for people: files that belong together stay together.
. "$(dirname -- "$0")/lib.sh"

sources=$(ours '\.(c|h|glsl|comp|def)$')
rooms=$(sed -n 's/^\([a-z][^:]*\):.*/\1/p' cmake/rooms.txt)
{
    printf '%s\n' "$rooms" | while IFS= read -r room; do
        if [ -f "$room/README.md" ]; then
            lines=$(wc -l <"$room/README.md")
            [ "$lines" -le 10 ] || echo "$room/README.md:11: more than ten lines"
        elif [ ! -f "$room/${room##*/}.h" ]; then
            echo "$room:1: neither README.md nor ${room##*/}.h says what it holds"
        fi
    done
} | verdict
printf '%s\n' "$sources" | awk '
FILENAME == "cmake/rooms.txt" {
    if (/^[a-z]/) rooms[substr($0, 1, index($0, ":") - 1)]
    next
}
{
    path = $0
    while (sub(/\/[^\/]*$/, "", path))
        if (path in rooms) {
            files[path]++
            break
        }
}
END { for (room in files) if (files[room] > 40) print "advice: " room " has " files[room] " source files" }' cmake/rooms.txt - | sort
