#!/bin/sh
# The binder walks the table: it names no element and no attribute of the language.
# Usage: bind.sh ROOT NAMES, where the program NAMES prints what the table names.
. "$(dirname -- "$0")/lib.sh"

names=$("$2")
[ -n "$names" ] || exit 1
ours '^parser/bind/.*\.[ch]$' | while IFS= read -r path; do
    awk -v path="$path" -v names="$names" '
    BEGIN {
        count = split(names, name)
        for (i = 1; i <= count; i++) {
            symbol[i] = "&SCHEMA_" toupper(name[i]) "([^A-Z_]|$)"
            root[i] = name[i] == "scene" || name[i] == "Scene" # where the binder starts
        }
    }
    {
        sub(/\/\/.*/, "")
        for (i = 1; i <= count; i++) {
            if (index($0, "\"" name[i] "\""))
                print path ":" FNR ": names \"" name[i] "\" of the language"
            if (!root[i] && $0 ~ symbol[i])
                print path ":" FNR ": knows the element " name[i]
        }
    }' "$path"
done | verdict
