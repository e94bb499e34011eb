# What the tests with real clients of reports share: scenes to report on.
. "$(dirname -- "$0")/../../clients.sh"
tool=$4
manual=docs/ci.md

cat >wrong.glint.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5]}
lights: [{position: [0, 5, 5]}]
materials:
  unused: {}
spheres:
  - {center: [0, 0, 0], radius: -1}
  - {center: [0, 0, 0], radius: 1, material: unusd}
S
cat >warned.glint.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5]}
lights: [{position: [0, 5, 5]}]
models:
  - {mesh: open.obj, material: {albedo: [0.1, 0, 0, 0.9], refractive_index: 1.5}}
S
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >open.obj
