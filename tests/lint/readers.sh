#!/bin/sh
# No reader that fuzzing does not reach. A C file of a room is a reader where it takes bytes from outside: it
# uses a function of the C library that reads, or one of ours that hands on what such a one read (a door). Fuzzing
# reaches a file that a target uses (tests/fuzz/fuzz_*.c), or that such a file uses, and so on.
# tests/lint/readers.txt says of every other reader who makes sense of its bytes: a function that fuzzing reaches
# and that the reader uses, or else why there is nothing to make sense of.
# Usage: readers.sh ROOT BUILD, the folder of a build with all replay_* targets.
. "$(dirname -- "$0")/lib.sh"
command -v nm >/dev/null || exit 77

targets=$(ls "$2"/tests/fuzz/CMakeFiles/replay_*.dir/fuzz_*.c.o 2>/dev/null) || true
[ -n "$targets" ] || { echo "tests/fuzz/CMakeLists.txt:1: no object of a target is in $2"; exit 1; }
{
    sed 's/^/T /' tests/lint/readers.txt
    # shellcheck disable=SC2046,SC2086 -- our paths hold no blanks
    nm -A -P $(objects "$2") $targets 2>/dev/null
} | awk -v build="$2/" -f "$LINT/readers.awk" | sort | verdict
