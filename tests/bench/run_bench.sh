#!/bin/sh
# bench/run over a small scene: its table, its report by the published schema, its gate and its page.
# Usage: run_bench.sh GLINT SOURCE_FOLDER WORK_FOLDER REPORT_TOOL BUILD_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
tool=$4 build=$5
command -v python3 >/dev/null || {
    echo "skip: python3 is not installed"
    exit 77
}
"$glint" devices >/dev/null 2>&1 || {
    echo "skip: no Vulkan device"
    exit 77
}
bench="$source/bench/run --build $build --work $work/made"

cat >ball.yaml <<'S'
glint: 1
image: {width: 48, height: 32}
trace: {max_depth: 3}
camera: {position: [0, 1, 6], look_at: [0, 0, 0]}
lights: [{position: [-5, 8, 5]}]
spheres:
  - {center: [-1, 0, 0], radius: 0.9, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.5}}
  - {center: [1, 0, 0], radius: 0.9, material: {albedo: [1, 0.3, 0.3, 0]}}
rectangles: [{corner: [-3, -1, -3], edge_u: [0, 0, 6], edge_v: [6, 0, 0]}]
S
# shellcheck disable=SC2086 -- words
expect "a small scene" 0 '^ball: ' '' $bench --scene ball.yaml --rounds 1 --json report.json --against "$glint" --targets
also "has whole processes" '^  glint, no shader cache ' ''
also "and what was aimed at" 'not measured here' ''
ok "its report is valid by its schema" "$tool" validate "$source/docs/schema/bench-report.schema.json" report.json
if [ -x "$build/bench/turns_embree" ]; then
    also "with Embree" '^  Embree  *[0-9]' ''
    expect "whose rays are glint's" 0 '^1536$' - "$tool" get report.json scenes/0/groups/0/systems/1/facts/rays/primary
    # Of pixels off: those at edges of the balls at most.
    share=$("$tool" get report.json scenes/0/groups/0/agreement/0/share)
    ok "and whose picture is" awk -v share="$share" 'BEGIN { exit !(share <= 0.02) }'
    # Models of one mesh, each with the triangles of its own and as instances of one tree.
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n' >wedge.obj
    cat >wedges.yaml <<'S'
glint: 1
image: {width: 48, height: 32}
camera: {position: [0, 1, 6], look_at: [0, 0, 0]}
lights: [{position: [-5, 8, 5]}]
models:
  - {mesh: wedge.obj, translation: [-1, 0, 0]}
  - {mesh: wedge.obj, translation: [1, -0.5, 0], scale: 1.5, rotation: [0, 40, 0], smooth: true}
  - {mesh: wedge.obj, translation: [0, 1, -1], scale: [-1, 1, 1]}
S
    for system in embree instances; do
        expect "wedges by $system" 0 '"triangles": 12' - "$build/bench/turns_embree" wedges.yaml --system $system --whole $system.png
    done
    "$glint" render wedges.yaml -o wedges.png -q --device reference || fail "the wedges' picture"
    for system in embree instances; do
        expect "$system shows the same" 0 '' - "$glint" compare $system.png wedges.png --threshold 0.005 --max-share 0.002
    done
else
    also "without Embree" 'skipped: Embree: ' ''
fi

# shellcheck disable=SC2086
{
    again="$bench --from report.json --expected expected.json"
    expect "the gate without what is expected" 1 'has nothing of what was measured' - $again --check
    expect "what is expected" 0 '' - $again --renew
    expect "is met" 0 '^0 of [0-9]+ worse' - $again --check
    sed -E '/"scene_bytes"/s/"value": [0-9]+/"value": 7/' expected.json >less.json
    expect "or is not" 1 'scene_bytes +7 .*WORSE' - $again --check --expected less.json
    expect "a scene that does not exist" 1 - "there is no scene 'none'" $bench --scene none
    expect "a page of reports" 0 '' '' $bench --page page.md report.json
    ok "shows them" grep -q '^## ' page.md
    expect "a page of none" 1 - 'needs the reports' $bench --page page.md
    expect "a file that is not a report" 1 - 'is not a report of bench/run' $bench --from "$source/docs/schema/glint.schema.json"
    sed 's/"scene": "ball"/"scene": "venus-1000"/' report.json >many.json
    expect "a target that is reached" 0 '^1000 models, memory on the device .* aim met$' '' $bench --from many.json --targets
    sed -E 's/"scene_bytes": [0-9]+/"scene_bytes": 99000000/' many.json >large.json
    expect "or missed" 0 '^1000 models, memory on the device .* MISSED$' '' $bench --from large.json --targets
}
exit $failed
