#!/bin/sh
# No circles: neither among the rooms of cmake/rooms.txt, by what they may include and by what their objects use of each
# other, nor among the C files of all rooms, of which one needs another where it uses a function or object that the
# other defines.
# Usage: circles.sh ROOT BUILD, the folder of a build; what it has built is looked at.
. "$(dirname -- "$0")/lib.sh"
command -v nm >/dev/null || exit 77

# A room that may include a single header of another depends on that room.
room_needs() {
    awk '/^[a-z]/ {
        room = $1
        sub(/:$/, "", room)
        for (i = 2; i <= NF; i++) {
            other = $i
            if (other ~ /\.h$/) sub(/\/[^\/]*$/, "", other)
            print room, other, $i
        }
    }' cmake/rooms.txt
}

# From what nm says of them: which file uses what of which.
file_needs() {
    awk -v build="$1/" '{
        file = substr($1, length(build) + 1)
        sub(/\/CMakeFiles\/[^\/]*/, "", file)
        sub(/\.o(\[.*)?:$/, "", file)
    }
    $3 == "U" && !((file, $2) in used) { used[file, $2]; from[++count] = file; what[count] = $2 }
    $3 ~ /^[A-TV-Z]$/ { home[$2] = file }
    END { for (i = 1; i <= count; i++) if (what[i] in home) print from[i], home[what[i]], what[i] }'
}

# shellcheck disable=SC2046 -- our paths hold no blanks
found=$(nm -A -P $(objects "$2") 2>/dev/null | file_needs "$2")
[ -n "$found" ] || { echo "cmake/rooms.txt:1: no object of a room is in $2"; exit 1; }
# What rooms use of each other, by what their files do.
between_rooms() {
    printf '%s\n' "$found" | awk '
    FILENAME == "cmake/rooms.txt" {
        if (/^[a-z]/) rooms[substr($0, 1, index($0, ":") - 1)]
        next
    }
    function room_of(path) {
        while (sub(/\/[^\/]*$/, "", path))
            if (path in rooms) return path
        return path
    }
    {
        from = room_of($1)
        to = room_of($2)
        if (from != to) print from, to, $3
    }' cmake/rooms.txt -
}
{
    room_needs
    between_rooms
    printf '%s\n' "$found"
} | awk -f "$LINT/circles.awk" | verdict
