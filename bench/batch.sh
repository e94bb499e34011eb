#!/bin/sh
# Many pictures from one process: bench/batch.sh [FRAMES], 100 frames of 160x120 of a turn around two spheres by
# build/release/glint, against the same picture alone. Of three rounds, interleaved, the least of each: processor time (user and
# system) and wall time of the process, and the time of tracing, in seconds.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=$PWD/build/release/glint
last=$((${1:-100} - 1))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/scene.yaml" <<'S'
glint: 1
image: {width: 160, height: 120}
camera: {position: [0, 1, 6], look_at: [0, 0, 0]}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials:
  blue: {diffuse_color: "#1020ff"}
  glass: {albedo: {diffuse: 0, specular: 0.5, reflection: 0.1, refraction: 0.8}, refractive_index: 1.5}
spheres:
  - {center: [-0.9, 0, 0], radius: 0.9, material: blue}
  - {center: [1, 0, 1], radius: 0.7, material: glass}
S
turn="camera.position=[{6*sin(360*frame/100)}, 1, {6*cos(360*frame/100)}]"

# timed NAME command...: adds a line "NAME processor wall tracing"
timed() {
    name=$1
    shift
    bash -c 'TIMEFORMAT="%U %S %R"; time "$@" >"$0/stats.json" 2>/dev/null' "$work" "$@" 2>"$work/time.txt"
    traced=$(sed -n 's/.*"frames_s": \([0-9.e+-]*\).*/\1/p' "$work/stats.json")
    awk -v name="$name" -v traced="${traced:-0}" '{print name, $1 + $2, $3, traced}' "$work/time.txt" >>"$work/rows"
}
for _ in 1 2 3; do
    for precision in single auto; do
        set -- "$glint" render "$work/scene.yaml" --set "trace.precision=$precision" -q
        timed "one-$precision" "$@" -o "$work/one.png"
        timed "png-$precision" "$@" --frames "0..$last" --set "$turn" -o "$work/o.%04d.png" --stats=json
        timed "y4m-$precision" "$@" --frames "0..$last" --set "$turn" -o "$work/o.y4m" --stats=json
    done
done
echo "what          processor    wall  tracing"
for name in one-single png-single y4m-single one-auto png-auto y4m-auto; do
    awk -v name="$name" '$1 == name {for (i = 2; i <= 4; i++) if (!n || $i < least[i]) least[i] = $i; n++}
        END {printf "%-12s %9.3f %8.3f %8.3f\n", name, least[2], least[3], least[4]}' "$work/rows"
done
