#!/bin/sh
# What a frame of a film costs beyond tracing where the scene's text is long: bench/film.sh [SPHERES], 50 000 in 2.7 MB of YAML unless
# you say otherwise, by build/release/glint, or by $GLINT. A film of 34 frames of 32x24 against one of 2, in which the background's
# colour moves, and then the camera's field of view; the least processor time (user and system) of three rounds, per frame; and the time of `glint check`.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=${GLINT:-$PWD/build/release/glint}
spheres=${1:-50000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk -v n="$spheres" 'BEGIN {
    srand(1)
    print "glint: 1\ncamera: {position: [0, 0, 30], look_at: [0, 0, 0], fov: 40}\nbackground: {color: [0.1, 0.2, 0.3]}"
    print "lights: [{position: [5, 9, 20]}]\ntrace: {precision: single}\nspheres:"
    for (i = 0; i < n; i++)
        printf "  - {center: [%.4f, %.4f, %.4f], radius: 0.%02d}\n", 18 * rand() - 9, 18 * rand() - 9, -9 * rand(), 11 + 80 * rand()
}' >"$work/scene.yaml"
timed() { # seconds of a command
    bash -c 'TIMEFORMAT="%U %S"; time "$@" >/dev/null 2>&1' bash "$@" 2>"$work/time.txt"
    awk '{ print $1 + $2 }' "$work/time.txt"
}
least() { awk -v best="$1" -v now="$2" 'BEGIN { print best == "" || now < best ? now : best }'; }
frame() { # WHAT SET: a line
    few='' many=''
    for _ in 1 2 3; do
        few=$(least "$few" "$(timed "$glint" render "$work/scene.yaml" --size 32x24 -q --frames 0..1 --set "$2" -o "$work/f.y4m")")
        many=$(least "$many" "$(timed "$glint" render "$work/scene.yaml" --size 32x24 -q --frames 0..33 --set "$2" -o "$work/f.y4m")")
    done
    awk -v what="$1" -v few="$few" -v many="$many" 'BEGIN { printf "%-28s %.4f s a frame\n", what, (many - few) / 32 }'
}
frame "the background moves" 'background.color=[0.1, {0.01*frame}, 0.3]'
frame "the field of view moves" 'camera.fov={40+frame*0.2}'
printf '%-28s %.4f s\n' "glint check of the text" "$(timed "$glint" check "$work/scene.yaml")"
