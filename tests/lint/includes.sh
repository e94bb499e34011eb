#!/bin/sh
# Who may include whom: the table of cmake/rooms.txt, and which room may see which library. In GLSL an include is a
# path from shaders/.
. "$(dirname -- "$0")/lib.sh"

sources=$(ours '\.[ch]$')
kernels=$(ours '^shaders/.*\.(glsl|comp)$')
[ -z "$sources$kernels" ] && exit 0
{
    # shellcheck disable=SC2086 -- our paths hold no blanks
    [ -z "$kernels" ] || grep -nE '^[ \t]*#[ \t]*include' /dev/null $kernels | while IFS= read -r line; do
        target=${line#*[\"<]} target=${target%%[\">]*}
        number=${line#*:} place=${line%%:*}:${number%%:*}
        case $target in
        *../* | */./*) ;;
        *) [ -f "shaders/$target" ] && continue ;;
        esac
        echo "$place: \"$target\" is not a path from shaders/"
    done
    # shellcheck disable=SC2086
    [ -z "$sources" ] || awk '
    FILENAME == "cmake/rooms.txt" {
        if (!/^[a-z]/) next
        room = $0
        sub(/:.*/, "", room)
        sub(/^[^:]*:/, "")
        rooms[room] = 1
        allowed[room, "core"] = 1
        count = split($0, may)
        for (i = 1; i <= count; i++) allowed[room, may[i]] = 1
        next
    }
    function room_of(path) {
        while (sub(/\/[^\/]*$/, "", path))
            if (path in rooms) return path
        return ""
    }
    function own(path, target,    room, other) {
        if (path ~ /^(tests|bench|tools)\//) return 1
        room = room_of(path)
        other = room_of(target)
        return room != "" && (other == room || (room, other) in allowed || (room, target) in allowed)
    }
    function foreign(path, target) {
        # Which says their versions.
        if (path ~ /^cli\/about\// && target ~ /^(yaml|expat|jansson|png|zlib|jpeglib)\.h$/) return 1
        if (target ~ /^yaml\.h$/) return path ~ /^(parser\/yaml\/|bench\/bench_check)/
        if (target ~ /^expat/) return path ~ /^(parser\/xml\/|bench\/bench_check)/
        if (target ~ /^(volk|vulkan)/) return path ~ /^(tracer\/gpu|tests\/faults|bench\/pipeline)\//
        if (target ~ /^embree/) return path ~ /^bench\/embree\//
        if (target ~ /^stb/) return path ~ /^(tools|tests|bench)\//
        if (target ~ /^png\.h/) return path ~ /^(picture|bench|tests)\//
        if (target ~ /^zlib/) return path ~ /^(shaders|tools|picture\/(read|write))\//
        if (target ~ /^(jpeglib|jerror)\.h/) return path ~ /^(picture|bench|tests\/unit\/picture|tests\/analytic)\//
        if (target ~ /^jansson/) return path ~ /^(grammar\/emit|lsp|tests)\//
        if (target ~ /^minizip/) return path ~ /^edit\/pack\/pack_zip/
        if (target ~ /^cmocka/) return path ~ /^tests\//
        if (target ~ /^GLFW\//) return path == "window/window.c"
        if (target ~ /^X11\//) return path ~ /^tests\/live\//
        if (target ~ /^xxhash/) return path ~ /^core\//
        if (target ~ /^pthread/) return path ~ /^(core|tests)\//
        return room_of(target) == ""
    }
    /^[ \t]*#[ \t]*include[ \t]*["<]/ {
        target = $0
        quoted = target ~ /^[^<]*"/
        sub(/^[^"<]*["<]/, "", target)
        sub(/[">].*/, "", target)
        place = FILENAME ":" FNR ": "
        if (!quoted) {
            if (!foreign(FILENAME, target)) print place "<" target "> is not for this folder"
        } else if (target ~ /^\.\.?\// || target ~ /\/\.\.?\//) {
            print place "\"" target "\" is not a path from the root"
        } else if (target !~ /\//) {
            if (FILENAME !~ /^(tests|bench|tools)\//) print place "\"" target "\" lacks its folder"
        } else if (!own(FILENAME, target)) {
            print place "\"" target "\" is not for this folder"
        }
    }' cmake/rooms.txt $sources
} | verdict
