#!/bin/sh
# Scenes for POV-Ray and Tachyon: what they hold, and, where the tools are installed, that these show about glint's picture.
# Usage: run_export.sh GLINT SOURCE_FOLDER WORK_FOLDER BENCH_EXPORT
. "$(dirname -- "$0")/../cli/lib.sh"
export=$4

# Bright and flat, so that pictures of other tracers can be compared at all: everything that is told apart by place is there.
cat >scene.yaml <<'S'
glint: 1
image: {width: 64, height: 48}
camera: {position: [0.5, 1, 6], look_at: [0.2, 0.4, 0], fov: 50}
background: {color: [0.2, 0.4, 0.8]}
lights: [{position: [-20, 30, 20]}]
materials:
  red: {albedo: [1, 0, 0, 0], diffuse_color: [0.8, 0.1, 0.1]}
  green: {albedo: [1, 0, 0, 0], diffuse_color: [0.1, 0.7, 0.1]}
  cells: {albedo: [1, 0, 0, 0], diffuse_color: {checker: {colors: [0.9, [0.1, 0.1, 0.5]], size: 1.5}}}
spheres: [{center: [-1.6, 0.5, 0], radius: 0.9, material: red}]
rectangles: [{corner: [-3, -0.6, -3], edge_u: [0, 0, 6], edge_v: [6, 0, 0], material: cells}]
models: [{mesh: wedge.obj, translation: [1.2, 0, 0], smooth: true, material: green}]
S
printf 'v 0 -0.6 0\nv 1.5 -0.6 0\nv 0 1.5 0\nv 0 -0.6 -1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n' >wedge.obj

expect "for POV-Ray" 0 '"lacks": "", "srgb": false, "width": 64, "height": 48' - "$export" pov scene.yaml scene.pov
ok "with all triangles" grep -q 'face_indices { 4' scene.pov
expect "for Tachyon" 0 '"lacks": "no checkers"' - "$export" tachyon scene.yaml scene.dat
expect "with all triangles" 0 '^6$' - grep -cE '^S?TRI ' scene.dat
expect "of another size" 0 '"width": 32, "height": 24' - "$export" pov scene.yaml small.pov --size 32x24
expect "a scene with a mistake" 1 - 'E206' "$export" pov scene.yaml bad.pov --set camera.fov=-1
ok "nothing is written then" test ! -e bad.pov
printf 'P6\n# made by hand\n2 1 255\nabcdef' >two.ppm
expect "a PPM as PNG" 0 - - "$export" png two.ppm two.png
expect "which has its pixels" 0 'share +0 ' - "$glint" compare two.png two.png
printf 'P6 2 1 255\nabcde' >short.ppm
expect "one that ends too early" 1 - 'ends too early' "$export" png short.ppm short.png

"$glint" render scene.yaml -o glint.png -q --device reference || fail "glint's picture"
# near NAME FILE.ppm SHARE: at most this share of its pixels differ much from glint's.
near() {
    expect "$1: PNG" 0 - - "$export" png "$2" "$1.png"
    expect "$1: near glint's picture" 0 '' - "$glint" compare "$1.png" glint.png --threshold 0.06 --max-share "$3"
}
if command -v povray >/dev/null; then
    expect "POV-Ray takes it" 0 '' '' povray +Iscene.pov +Oscene.ppm +FP +W64 +H48 -D -A File_Gamma=1 -GA
    near povray scene.ppm 0.02
else
    echo "skip: povray is not installed"
fi
if command -v tachyon >/dev/null; then
    # Its cells are all of one colour.
    expect "Tachyon takes it" 0 'Ray Tracing Time' '' tachyon scene.dat -format PPM -o tachyon.ppm
    near tachyon tachyon.ppm 0.25
else
    echo "skip: tachyon is not installed"
fi
exit $failed
