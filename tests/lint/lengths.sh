#!/bin/sh
# Files of at most 600 lines, functions of at most 60; reports the median.
. "$(dirname -- "$0")/lib.sh"

sources=$(ours '\.(c|h|glsl|comp)$')
[ -z "$sources" ] && exit 0
# shellcheck disable=SC2086
wc -l $sources | grep -v ' total$' | sort -n |
    awk '{ lines[NR] = $1 } END { print "median of " NR " files: " lines[int((NR + 1) / 2)] " lines, longest " lines[NR] }'
# A function, as clang-format lays it out, opens at column 0 and closes with a brace at column 0.
# shellcheck disable=SC2086
awk '
FNR == 1 { start = 0; inside = 0 }
FNR == 601 { print FILENAME ":601: more than 600 lines" }
inside {
    if ($0 == "}") {
        if (FNR - start + 1 > 60) print FILENAME ":" start ": a function of " FNR - start + 1 " lines: " name
        inside = 0
        start = 0
    }
    next
}
/^[A-Za-z_]/ { start = FNR; name = $0 }
start && /;[ \t]*$|= \{$/ { start = 0 }
start && /\)( const)? \{$/ { inside = 1 }
' $sources | verdict
