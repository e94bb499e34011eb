# What the tests with real clients share. Each is run as `NAME.sh GLINT REPORT_TOOL SOURCE_FOLDER WORK_FOLDER`; it exits 77
# and says so where its client is not installed.
set -eu
glint=$1
tool=$2
source=$3
work=$4

needs() {
    command -v "$1" >/dev/null && return 0
    echo "skipped: $1 is not installed (docs/ci.md says how)"
    exit 77
}

fail() {
    echo "FAIL $*"
    exit 1
}

rm -rf "$work"
mkdir -p "$work"
cd "$work"
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
