#!/bin/sh
# What a scene costs that is written with 'for', beside the same written out: bench/copies.sh [SIDE], SIDE x SIDE spheres, 1000
# unless you say otherwise, by build/release/glint, or by $GLINT. `glint check`: the least user time of three rounds, and the
# most memory. Then scenes that would make too much, and what they take until they are refused.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=${GLINT:-$PWD/build/release/glint}
side=${1:-1000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >copies.yaml <<S
glint: 1
camera: {position: [0, $side, $side], look_at: [0, 0, 0], fov: 90}
lights: [{position: [0, $side, 0]}]
materials: {wood: {diffuse_color: [0.5, 0.3, 0.2]}}
spheres:
  - for: {i: $side, k: $side}
    center: [1.2*(i - $side/2), 0, 1.2*(k - $side/2)]
    radius: 0.3 + 0.2*i/$side
    material: wood
S
"$glint" convert --expanded copies.yaml written.yaml
# Prints seconds and megabytes of a command, which may fail.
taken() {
    command time -f '%U %M' -o one.txt "$@" >/dev/null 2>&1 || :
    tail -n 1 one.txt
}
measure() { # SCENE: into SCENE.txt
    for _ in 1 2 3; do taken "$glint" check "$1"; done | awk '{ s = NR == 1 || $1 < s ? $1 : s; m = $2 > m ? $2 : m } END { print s, m / 1024 }' >"$1.txt"
    awk -v what="$1" '{ printf "%-14s %6.2f s %6.0f MB\n", what, $1, $2 }' "$1.txt"
}
measure copies.yaml
measure written.yaml
cat copies.yaml.txt written.yaml.txt | awk 'NR == 1 { s = $1; m = $2 } NR == 2 { printf "ratio          %6.2f   %6.2f\n", s / $1, m / $2 }'

bomb() { # WHAT FOR REST
    printf 'glint: 1\nspheres: [{for: {%s}, %s center: [0, 0, 0], radius: 1}]\n' "$2" "$3" >bomb.yaml
    taken "$glint" check bomb.yaml | awk -v what="$1" '{ printf "%-28s %6.2f s %6.0f MB\n", what, $1, $2 / 1024 }'
}
bomb "10^12 bodies" 'a: 1000000, b: 1000000' ''
bomb "none kept of 10^9" 'a: 1000000000' 'if: false,'
bomb "none kept of 10^6" 'a: 1000000' 'if: false,'
bomb "counts that grow" 'a: 1000, b: 1000*a, c: b*b' ''
bomb "16 variables of 9" "$(awk 'BEGIN { for (i = 0; i < 16; i++) printf "%sv%d: 9", i ? ", " : "", i }')" ''
bomb "64 variables" "$(awk 'BEGIN { for (i = 0; i < 64; i++) printf "%sv%d: 1", i ? ", " : "", i }')" ''
bomb "empty 10^12 times" 'a: 1000000, b: 1000000, c: 0*b' ''
