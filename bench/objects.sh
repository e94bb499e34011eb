#!/bin/sh
# What objects and their instances cost, beside the same written out: bench/objects.sh, by build/release/glint, or by $GLINT.
# Processor time and memory of `glint inspect`, and bytes on the device; then the memory of a million bodies in objects; then
# scenes that would make too much, and what they take until they are refused.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=${GLINT:-$PWD/build/release/glint}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# Prints seconds and megabytes of a command, which may fail.
taken() {
    command time -f '%U %M' -o one.txt "$@" >said.txt 2>&1 || :
    tail -n 1 one.txt
}
# chairs X Z BOXES: as many instances of an object of boxes.
chairs() {
    cat <<S
glint: 1
camera: {position: [0, 60, 160], look_at: [0, 0, 0], fov: 60}
lights: [{position: [0, 100, 50]}]
objects:
  chair:
    boxes: [{for: {i: $3}, center: ["0.31*(i % 5)", "0.17*floor(i/5)", 0.013*i], size: 0.08, rotation: [0, 7*i, 0]}]
instances: [{for: {x: $1, z: $2}, object: chair, translation: [2*(x - $1/2), 0, 2*(z - $2/2)], rotation: [0, x*z, 0]}]
S
}
measure() { # SCENE: into SCENE.txt
    for _ in 1 2 3; do taken "$glint" inspect "$1" --format json; done | awk '{ s = NR == 1 || $1 < s ? $1 : s; m = $2 > m ? $2 : m } END { print s, m / 1024 }' >"$1.txt"
    awk '/"buffers"/ { inside = 1 } inside && /"bytes"/ { gsub(/[^0-9]/, ""); sum += $0 } END { print sum / 1e6 }' said.txt >"$1.bytes"
    awk -v what="$1" -v bytes="$(cat "$1.bytes")" '{ printf "%-14s %6.2f s %6.0f MB, %.1f MB on the device\n", what, $1, $2, bytes }' "$1.txt"
}
chairs 50 40 50 >objects.yaml
# Written out: each box with its own place in the world.
awk 'BEGIN {
    pi = 3.141592653589793
    print "glint: 1\ncamera: {position: [0, 60, 160], look_at: [0, 0, 0], fov: 60}\nlights: [{position: [0, 100, 50]}]\nboxes:"
    for (x = 0; x < 50; x++) for (z = 0; z < 40; z++) for (i = 0; i < 50; i++) {
        a = x*z*pi/180; px = 0.31*(i % 5); pz = 0.013*i
        printf "  - {center: [%.9g, %.9g, %.9g], size: 0.08, rotation: [0, %d, 0]}\n", 2*(x - 25) + cos(a)*px + sin(a)*pz, 0.17*int(i/5), 2*(z - 20) - sin(a)*px + cos(a)*pz, x*z + 7*i
    } }' >written.yaml
measure objects.yaml
measure written.yaml
cat objects.yaml.txt objects.yaml.bytes written.yaml.txt written.yaml.bytes | tr '\n' ' ' |
    awk '{ printf "ratio          %6.2f   %6.2f   %6.2f of the bytes\n", $1 / $4, $2 / $5, $3 / $6 }'

chairs 1 1 50 >few.yaml
chairs 200 100 49 >many.yaml
few=$(taken "$glint" check few.yaml)
many=$(taken "$glint" check many.yaml --limit evaluations=1000000000)
! grep 'error: ' said.txt || exit 1
echo "$few $many" | awk '{ printf "980 000 boxes in 20 000 instances: %.2f s, %.0f bytes a box\n", $3, ($4 - $2) * 1024 / 980000 }'

bomb() { # WHAT, the scene on standard input
    cat >bomb.yaml
    taken "$glint" check bomb.yaml | awk -v what="$1" '{ printf "%-28s %6.2f s %6.0f MB\n", what, $1, $2 / 1024 }'
    grep -q '^bomb.yaml:.*error: ' said.txt || { echo "it is not refused" && false; }
}
nest() { # LEVELS EACH
    awk -v levels="$1" -v each="$2" 'BEGIN { print "glint: 1\nobjects:"
        for (i = 0; i < levels; i++) printf "  o%d: {instances: [{for: {i: %d}, object: o%d, translation: [i, 0, 0]}]}\n", i, each, i + 1
        printf "  o%d: {boxes: [{center: [0, 0, 0], size: 1}]}\ninstances: [{object: o0}]\n", levels }'
}
nest 10 10 | bomb "10 levels of 10"
nest 14 3 | bomb "14 levels of 3"
nest 40 2 | bomb "40 levels of 2"
printf 'glint: 1\nobjects: {a: {boxes: [{for: {i: 1000000}, if: false, center: [i, 0, 0], size: 0.1}]}}\ninstances: [{for: {k: 1000000}, object: a}]\n' | bomb "none kept of 10^12"
printf 'glint: 1\nobjects: {a: {parameters: {n: 3}, boxes: [{for: {i: n}, center: [i, 0, 0], size: 0.1}]}}\ninstances: [{for: {k: 100000}, object: a, with: {n: k}}]\n' | bomb "counts that are given"
printf 'glint: 1\nobjects: {a: {instances: [{object: b}]}, b: {instances: [{object: a}]}}\ninstances: [{object: a}]\n' | bomb "a ring"
awk 'BEGIN { print "glint: 1\nobjects:"; for (i = 0; i < 10000; i++) printf "  o%d: {instances: [{object: o%d}]}\n", i, (i + 1) % 10000; print "instances: [{object: o0}]" }' | bomb "a ring of 10 000"
