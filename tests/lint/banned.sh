#!/bin/sh
# Calls that have no place here, and those that have none in a library.
. "$(dirname -- "$0")/lib.sh"

call='(^|[^A-Za-z0-9_.>])'
anywhere='strcpy|strcat|stpcpy|sprintf|vsprintf|gets|atoi|atol|atoll|atof|strtok|setlocale|tmpnam|mktemp'
ends='exit|_exit|_Exit|quick_exit|abort'
prints='printf|vprintf|puts|putchar|perror'
opens='fopen|freopen|open|openat|creat|opendir|mmap|realpath'
code=$(mktemp)
trap 'rm -f "$code"' EXIT
# A program that a library's folder holds may do as a program does.
rooms=$(sed -n 's/^\([a-z][a-z/]*\):.*/\1/p' cmake/rooms.txt | grep -v '^cli$' | tr '\n' '|')
ours "^(${rooms%|})/[^/]*\.[ch]\$" | grep -vE '(^|[/_])main\.c$' | code >"$code"
{
    ours '\.[ch]$' | code | grep -E "$call($anywhere)[ ]*\(" | sed 's/$/   <- a banned call/' || true
    grep -E "$call($ends)[ ]*\(" "$code" | grep -v '^core/arena\.c:[0-9]*:.*abort' |
        sed 's/$/   <- a library does not end the program/' || true
    grep -E "$call($prints)[ ]*\(|$call(stdout|stderr)([^A-Za-z0-9_]|\$)" "$code" |
        grep -v '^files/output\.[ch]:' | sed 's/$/   <- a library does not print/' || true
    grep -E "$call($opens)[ ]*\(" "$code" | grep -vE '^files/' |
        sed 's/$/   <- the room files is the one door to the file system/' || true
} | verdict
