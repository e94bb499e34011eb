#!/bin/sh
# What of the scenes of another version has changed: the bytes of their pictures, and the processor time of some, by turns.
# Usage: before.sh GLINT OTHER_GLINT OTHER_SOURCE WORK [SCENE SIZE]...
# OTHER_SOURCE has that version's scenes, with scenes/generated made; a SCENE is below it. Without any, the six that
# docs/accuracy.md has figures of. Ends with 1 where a picture differs.
set -eu
glint=$1 other=$2 source=$3 work=$4
shift 4
mkdir -p "$work"
count=0 differ=0
for scene in "$source"/scenes/*.glint.yaml "$source"/scenes/*/*.glint.yaml; do
    "$other" render -q "$scene" --size 120x90 -o "$work/before.pfm" 2>/dev/null || continue
    count=$((count + 1))
    if ! "$glint" render -q "$scene" --size 120x90 -o "$work/now.pfm" || ! cmp -s "$work/before.pfm" "$work/now.pfm"; then
        differ=$((differ + 1))
        echo "another picture: $scene"
    fi
done
echo "$count scenes, $differ with another picture"

# Processor time of a command and its children, in hundredths of a second.
cost() {
    "$@" >/dev/null 2>&1
    times >"$work/times.txt"
    awk 'NR == 2 { for (i = 1; i <= 2; i++) { split($i, t, /[ms]/); sum += 60 * t[1] + t[2] }; print int(100 * sum + 0.5) }' "$work/times.txt"
}
[ $# -gt 0 ] || set -- tinyraytracer 1024x768 showcase 480x270 elements/checker 1024x768 elements/refraction 640x480 \
    elements/models 800x600 elements/lights 1024x768
while [ $# -gt 1 ]; do
    least_before=999999 least_now=999999
    for round in 1 2 3 4 5; do
        taken=$(cost "$other" render -q "$source/scenes/$1.glint.yaml" --size "$2" -o "$work/time.pfm")
        [ "$taken" -ge "$least_before" ] || least_before=$taken
        taken=$(cost "$glint" render -q "$source/scenes/$1.glint.yaml" --size "$2" -o "$work/time.pfm")
        [ "$taken" -ge "$least_now" ] || least_now=$taken
    done
    awk -v name="$1 $2" -v a="$least_before" -v b="$least_now" \
        'BEGIN { printf "%-40s before %.2f s, now %.2f s: %.3f of it\n", name, a / 100, b / 100, b / a }'
    shift 2
done
[ "$differ" -eq 0 ]
