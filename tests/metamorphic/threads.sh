#!/bin/sh
# Usage: threads.sh GLINT SCENE
# However many threads flatten the scene (one processor, or all) and trace it (lavapipe's), the picture is the same.
set -eu
glint=$1
scene=$2
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
"$glint" devices >/dev/null 2>&1 || exit 77

for precision in single double; do
    first=$folder/$precision.pfm
    "$glint" render "$scene" --set trace.precision=$precision -q -o "$first"
    for threads in 0 1 2 5; do
        LP_NUM_THREADS=$threads "$glint" render "$scene" --set trace.precision=$precision -q -o "$folder/again.pfm"
        cmp "$first" "$folder/again.pfm"
    done
    if command -v taskset >/dev/null; then
        taskset -c 0 "$glint" render "$scene" --set trace.precision=$precision -q -o "$folder/again.pfm"
        cmp "$first" "$folder/again.pfm"
    fi
    echo "ok   $precision"
done
