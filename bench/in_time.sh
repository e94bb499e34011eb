#!/bin/sh
# How well render --time keeps its time: from the start of the process to its end, the file written.
# Usage: in_time.sh GLINT SOURCE_FOLDER WORK_FOLDER
# A line for each scene, time and bound: samples made, seconds, and by how much it is over; then the worst. A
# picture whose first sample alone takes longer is told apart: nothing can make it in time.
set -u
glint=$1 source=$2 work=$3
export XDG_CACHE_HOME="$work/cache"
mkdir -p "$work"
now() { date +%s%N; }

# run SCENE SECONDS [option...]
run() {
    scene=$1 seconds=$2
    shift 2
    start=$(now)
    "$glint" render "$source/scenes/$scene.glint.yaml" --size 480x320 --samples 256 --time "$seconds" "$@" \
        -o "$work/in_time.png" 2>"$work/err.txt"
    status=$?
    end=$(now)
    note=$(grep -oE 'allowed [0-9]+ of|one sample, the least|E807' "$work/err.txt" | tr '\n' ' ')
    awk -v ns=$((end - start)) -v wanted="$seconds" -v what="$scene $*" -v note="$note" -v status=$status 'BEGIN {
        printf "%-44s %6.2f s of %5g  %+6.1f %%  exit %d  %s\n", what, ns / 1e9, wanted, 100 * (ns / 1e9 / wanted - 1), status, note
    }' | tee -a "$work/in_time.txt"
}

: >"$work/in_time.txt"
for scene in showcase tinyraytracer elements/refraction elements/lights elements/smooth elements/spheres; do
    for seconds in 1 2 5 10; do
        run $scene $seconds
    done
    run $scene 10 --audit
    run $scene 12 --max-error flip=0.1
    run $scene 12 --max-error flip=0.05
done
grep -v 'one sample' "$work/in_time.txt" | sed -E 's/.*([+-] *[0-9.]+) %.*/\1/' | tr -d ' ' | sort -g | tail -n 1 |
    sed 's/^/the worst, where more than one sample was made: /; s/$/ %/'
