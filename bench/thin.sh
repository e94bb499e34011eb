#!/bin/sh
# Many models of meshes with poles, whose lowest triangles rounding may leave without area: bytes on the device, processor time and
# memory of `glint inspect`. By build/release/glint, or by $GLINT.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=${GLINT:-$PWD/build/release/glint}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# ball ROWS TOLERANCE: a mesh of a ball, as a lathe.
ball() {
    awk -v rows="$1" -v tolerance="$2" 'BEGIN {
        printf "{lathe: {profile: [[0, -1]"
        for (i = 1; i < rows; i++) printf ", [%.17g, %.17g]", sin(3.14159265358979 * i / rows), -cos(3.14159265358979 * i / rows)
        printf ", [0, 1]]}, tolerance: %s}", tolerance }'
}
# figures NAME: of the scene on standard input.
figures() {
    cat >"$work/scene.yaml"
    command time -o "$work/time" -f '%U %M' "$glint" inspect "$work/scene.yaml" --format json >"$work/report" 2>"$work/errors" || {
        cat "$work/errors"
        exit 1
    }
    awk -v name="$1" -v took="$(cat "$work/time")" '
        /"buffers"/ {inside = 1} inside && /"bytes"/ {gsub(/[^0-9]/, ""); bytes += $0}
        END {split(took, t, " "); printf "%-52s %6.1f MB on the device, inspect %.1f s, %d MB\n", name, bytes / 1e6, t[1], t[2] / 1024}' "$work/report"
}
# grid COUNT PITCH MESH SCALE PRECISION
grid() {
    echo "glint: 1
trace: {precision: $5}
camera: {position: [0, 120, 260], look_at: [0, 0, 0], fov: 50}
lights: [{position: [0, 200, 50]}]
models:
  - for: {x: $1, z: $1}
    mesh: $3
    scale: $4
    translation: [\"$2*(x - $1/2) + 0.013*z\", 0, \"$2*(z - $1/2)\"]
    rotation: [x*3.3, z*2.7, 10]"
}

fine=$(ball 222 0.0001) coarse=$(ball 60 0.001)
grid 100 2.2 "$fine" 1 single | figures '10 000 balls of 99 008 triangles, single'
grid 100 2.2 "$fine" 1 double | figures '10 000 balls of 99 008 triangles, double'
grid 100 2.2 '{torus: {radius: 0.8, tube: 0.2}, tolerance: 0.000095}' 1 double | figures '10 000 rings, double'
for scale in 0.02 0.01 0.004; do
    grid 60 0.4 "$coarse" $scale single | figures "3600 balls of 8424 triangles, radius $scale, single"
done
