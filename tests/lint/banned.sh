#!/bin/sh
# Calls that have no place here, those that have none in a library, and those that few files may make.
. "$(dirname -- "$0")/lib.sh"

call='(^|[^A-Za-z0-9_.>])'
anywhere='strcpy|strcat|stpcpy|sprintf|vsprintf|gets|atoi|atol|atoll|atof|strtok|setlocale|tmpnam|mktemp'
ends='exit|_exit|_Exit|quick_exit|abort'
prints='printf|vprintf|puts|putchar|perror'
outputs='output_open|output_whole|output_part'
opens='fopen|freopen|open|openat|creat|opendir|mmap|realpath'
# Where memory ends, arena_guarded is the one way out; beside it only files whose library reports its errors by
# a jump may catch one. No more than six files in all.
jumps='(sig|_|__builtin_)?(set|long)jmp'
may_jump='core/arena\.c|picture/write/encode_(jpeg|png)\.c|picture/read/read_(jpeg|png)\.c'
# Where the system has no memory left is said in one place, whoever asked.
allocates='malloc|calloc|realloc|reallocarray|strdup|strndup|aligned_alloc|posix_memalign|open_memstream|asprintf|vasprintf|getline'
code=$(mktemp)
trap 'rm -f "$code"' EXIT
# A program that a library's folder holds may do as a program does.
rooms=$(sed -n 's/^\([a-z][a-z/]*\):.*/\1/p' cmake/rooms.txt | grep -vE '^cli(/|$)' | tr '\n' '|')
ours "^(${rooms%|})/[^/]*\.[ch]\$" | grep -vE '(^|[/_])main\.c$' | code >"$code"
{
    ours '\.[ch]$' | code | grep -E "$call($anywhere)[ ]*\(" | sed 's/$/   <- a banned call/' || true
    ours '\.[ch]$' | code | grep -E "$call$jumps[ ]*\(" | grep -vE "^($may_jump):" |
        sed 's/$/   <- arena_guarded is the one way out of memory/' || true
    grep -E "$call($ends)[ ]*\(" "$code" | grep -vE '^core/arena\.c:[0-9]*:.*abort|^files/spawn\.c:[0-9]*:.*_exit' |
        sed 's/$/   <- a library does not end the program/' || true
    grep -E "$call($prints)[ ]*\(|$call(stdout|stderr)([^A-Za-z0-9_]|\$)" "$code" |
        grep -v '^files/output\.[ch]:' | sed 's/$/   <- a library does not print/' || true
    grep -E "$call($allocates)[ ]*\(" "$code" | grep -vE '^(core/heap\.c|grammar/emit/emit_main\.c|tools/.*):' |
        sed 's/$/   <- core\/heap.h is the one door to the heap/' || true
    grep -E "$call($opens)[ ]*\(" "$code" | grep -vE '^files/' |
        sed 's/$/   <- the room files is the one door to the file system/' || true
    ours '^cli/commands/' | grep '\.[ch]$' | code | grep -E "$call($outputs)[ ]*\(" |
        sed 's/$/   <- cli\/made.h opens what commands write/' || true
} | verdict
