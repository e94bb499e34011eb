#!/bin/sh
# What measures: one small run of each kind, for the build with sanitizers; the tests of these commands themselves are
# of the release build.
# Usage: run_studies.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

cat >glass.yaml <<'S'
glint: 1
image: {width: 16, height: 12, samples: 4, error: 0.2, min_samples: 2}
trace: {max_depth: 3}
camera: {position: [0, 1, 6], look_at: [0, 0.6, 0], fov: 40}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5], radius: 0.5}]
materials:
  glass: {albedo: [0, 0.5, 0.2, 0.7], refractive_index: 1.5}
spheres:
  - {name: ball, center: [-0.7, 0.7, 0], radius: 0.7, material: glass}
  - {center: [0.9, 0.6, -0.5], radius: 0.6}
S
"$glint" devices | grep -q . || {
    echo "skip: no Vulkan device"
    exit 77
}
expect "a study cut short" 0 '^  0 .*as the file says' - "$glint" tradeoff glass.yaml -q --budget 1 -o report.html
# Whether a setting is found within a second depends on the machine.
ok "a search for settings" sh -c '"$0" render glass.yaml --max-error flip=0.9 --budget 1 -o chosen.png 2>err.txt; [ $? -le 1 ] &&
    grep -q "settings tried on" err.txt' "$glint"
expect "a picture in time, audited" 0 - 'traced again' "$glint" render glass.yaml --time 1000 --audit -o timed.png
expect "an end of its numbers" 0 ' 0 broken' '' "$glint" extremes glass.yaml --size 8x6 -q --axis gap -o report.html
expect "two paths" 0 "sphere 'ball'" - "$glint" pick glass.yaml 6,6 --sample 1
exit $failed
