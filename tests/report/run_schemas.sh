#!/bin/sh
# What commands print for programs is valid by its published schema, and has all that the schema describes.
# Usage: run_schemas.sh GLINT SOURCE_FOLDER WORK_FOLDER REPORT_TOOL
. "$(dirname -- "$0")/../cli/lib.sh"
tool=$4
export XDG_CACHE_HOME="$work/cache"

# json NAME EXIT command...: keeps the report as NAME.json.
json() {
    name=$1 wanted=$2
    shift 2
    expect "$name" "$wanted" '^[[{]' '' "$@"
    cp out.txt "$name.json"
}

# by_schema REPORT FILE...
by_schema() {
    schema=$source/docs/schema/$1-report.schema.json
    shift
    ok "$* valid by ${schema##*/}" "$tool" validate "$schema" "$@"
    ok "all of ${schema##*/} is reported" "$tool" covers "$schema" "$@"
}

mkdir meshes
printf 'mtllib face.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl red\nf 1 2 3\n' >meshes/face.obj
printf 'newmtl red\nKd 1 0 0\n' >meshes/face.mtl
printf 'glint: 1\nmaterials: {glass: {albedo: [0, 0.5, 0.2, 0.7], refractive_index: 1.5}}\n' >parts.yaml
cat >scene.yaml <<'S'
glint: 1
include: [parts.yaml]
image: {width: 24, height: 16}
trace: {max_depth: 3, precision: single}
camera: {position: [0, 0, 6]}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: glass}]
models: [{mesh: meshes/face.obj, translation: [0.9, 0, 0]}]
S

cat >twins.yaml <<'S'
glint: 1
include: [parts.yaml]
parameters: {side: {value: 0.9, min: 0.5, max: 1, description: from the middle}, there: [side, 0, 0], is_used: true}
camera: {position: [0, 0, 6]}
models:
  - {mesh: meshes/face.obj, translation: there, smooth: is_used}
  - {mesh: meshes/face.obj, translation: [-0.9, 0, 0]}
spheres:
  - {center: [0, 0, -5], radius: 1, material: glass}
  - {center: [0, 0.5, -5], radius: 1, material: glass}
  - {for: {i: 3}, center: [i, 0, -5], radius: 0.4, material: glass}
objects: {pair: {boxes: [{for: {i: 2}, center: [i, 2, -5], size: 0.2}]}}
instances: [{object: pair}]
S
printf 'glint: 1\nlights: [{position: [0, 1, 0]}]\n' >empty.yaml

json deps 0 "$glint" deps scene.yaml --format json
json deps_missing 3 "$glint" deps none.yaml scene.yaml --format json
by_schema deps deps.json deps_missing.json

sed 's/fov: 40/fov: 50/; s/radius: 0.9/radius: 0.8/; s/^lights.*/lights: []/; s/max_depth: 3, //' scene.yaml >other.yaml
json diff 1 "$glint" diff scene.yaml other.yaml --format json
json diff_back 1 "$glint" diff other.yaml scene.yaml --format json
json diff_none 0 "$glint" diff scene.yaml scene.yaml --format json
by_schema diff diff.json diff_back.json diff_none.json

expect "a picture of the reference" 0 - '' "$glint" render scene.yaml -o exact.pfm --device reference
expect "and one of another size" 0 - '' "$glint" render other.yaml -o other.pfm --device reference
json compare 0 "$glint" compare exact.pfm other.pfm --format json
json compare_bounds 1 "$glint" compare exact.pfm other.pfm --format json --max-mae 0 --min-psnr 10
json compare_same 0 "$glint" compare exact.pfm exact.pfm --format json --max-largest 0
by_schema compare compare.json compare_bounds.json compare_same.json

expect "a picture that says how it was made" 0 - '' "$glint" render scene.yaml -o made.hdr -q --device reference
sed 's/^# Device: reference/# Device: another/' made.hdr >moved.hdr
json verify 0 "$glint" verify made.hdr --format json
json verify_changed 1 "$glint" verify made.hdr other.yaml --format json
json verify_device 0 "$glint" verify moved.hdr --device reference --format json
by_schema verify verify.json verify_changed.json verify_device.json
json inspect_scene 0 "$glint" inspect scene.yaml --format json
json inspect_twins 0 "$glint" inspect twins.yaml --format json
json inspect_empty 0 "$glint" inspect empty.yaml --format json
by_schema inspect-scene inspect_scene.json inspect_twins.json inspect_empty.json
json inspect 0 "$glint" inspect made.hdr --format json
json inspect_none 0 "$glint" inspect exact.pfm --format json
mkdir tested
cp scene.yaml tested/a.glint.yaml && cp -r meshes parts.yaml tested/ && cp tested/a.glint.yaml tested/b.glint.yaml
printf 'pictures: refs\ntests:\n  c.png: {scene: a.glint.yaml, camera: main, bounds: {flip: 0.1, ssim: 0.9}}\n' >tested/glint-test.yaml
sed -i 's/^camera: .*/cameras: {main: {position: [0, 0, 6]}}/' tested/a.glint.yaml
json test_bless 0 "$glint" test tested --format json --bless --device reference
cp tested/refs/c.png tested/refs/unused.png
sed -i 's/radius: 0.9/radius: 0.8/' tested/a.glint.yaml
json test_changed 1 "$glint" test tested --format json --device reference
by_schema test test_bless.json test_changed.json
by_schema inspect inspect.json inspect_none.json

json pick_reference 0 "$glint" pick scene.yaml 8,8 --format json --device reference
json render_reference 0 "$glint" render scene.yaml --set image.error=0.05 --set image.samples=64 --samples 1 -o exact.png --device reference --stats=json -q
if ! "$glint" render scene.yaml -o probe.png -q 2>/dev/null; then
    echo "skip: no Vulkan device: of render, pick and tradeoff only what needs none"
    exit $failed
fi

json render 0 "$glint" render scene.yaml -o out.png --stats=json --count-rays --audit -q
# So far away that single precision is wrong.
cat >far.yaml <<'S'
glint: 1
image: {width: 24, height: 16}
trace: {precision: single}
camera: {position: [0.3, 0.2, 5], fov: 1.0e-6}
lights: [{position: [3, 4, 5]}]
spheres: [{center: [0.1, 0, -123456789.3], radius: 0.8}]
S
json render_off 0 "$glint" render far.yaml -o far.png --stats=json --audit -q
json render_noise 0 "$glint" render scene.yaml --noise 0.05 -o noise.png --stats=json -q
json render_unused 0 "$glint" render scene.yaml --set image.error=0.05 --set image.samples=64 --samples 8 -o noise.png --stats=json -q
by_schema render render.json render_off.json render_noise.json render_unused.json render_reference.json

json batch 0 "$glint" render scene.yaml --sweep image.samples=1,2 -o 'many.%d.png' --stats=json -q
by_schema batch batch.json
"$glint" render scene.yaml --watch -o watch.png --stats=json -q >loads.json 2>/dev/null </dev/null &
watcher=$!
for lines in 1 2; do
    for _ in $(seq 600); do
        [ "$(wc -l <loads.json)" -lt $lines ] && kill -0 $watcher 2>/dev/null || break
        sleep 0.1
    done
    [ $lines -eq 1 ] && cp scene.yaml kept.yaml && echo 'spheres: 1' >>scene.yaml
done
kill $watcher
wait $watcher
cp kept.yaml scene.yaml
for line in 1 2; do sed -n ${line}p loads.json >watch$line.json; done
by_schema watch watch1.json watch2.json

json pick 0 "$glint" pick scene.yaml 8,8 --format json
json pick_mesh 0 "$glint" pick scene.yaml 14,8 --format json
json pick_bytes 0 "$glint" pick "$source/tests/fuzz/seeds/ply/little.ply" 512,384 --format json
json pick_off 0 "$glint" pick far.yaml 12,8 --format json
json pick_image 0 "$glint" pick "$source/scenes/language/paint.glint.yaml" 98,90 --device reference --format json
# Inside of two coloured bodies.
cat >media.yaml <<'S'
glint: 1
image: {width: 24, height: 16}
camera: {position: [0, 0, 6]}
background: {color: [0.3, 0.5, 0.8]}
materials:
  glass: {albedo: [0, 0, 0.1, 0.9], refractive_index: 1.5, priority: 1, attenuation_color: [0.5, 1, 0.5]}
  water: {albedo: [0, 0, 0.1, 0.9], refractive_index: 1.3, attenuation_color: [0.5, 0.5, 1]}
spheres: [{center: [0, 0, 0], radius: 1, material: glass}, {center: [0.5, 0, 0], radius: 1, material: water}]
S
json pick_media 0 "$glint" pick media.yaml 12,8 --format json
sed 's/, {center: \[0.5, 0, 0\]/, {for: {i: 2}, center: [0.5 + i, 0, 0]/' media.yaml >copies.yaml
sed 's/^spheres: \(.*\)/instances: [{name: both, object: {spheres: \1}}]/' media.yaml >inside.yaml
json pick_inside 0 "$glint" pick inside.yaml 12,8 --format json
json pick_copy 0 "$glint" pick copies.yaml 12,8 --format json
json pick_light 0 "$glint" pick "$source/scenes/elements/seen_lights.glint.yaml" 145,70 --device reference --format json
by_schema pick pick.json pick_mesh.json pick_bytes.json pick_off.json pick_reference.json pick_media.json pick_image.json pick_copy.json pick_inside.json pick_light.json

json tradeoff 0 "$glint" tradeoff scene.yaml --format json --budget 5 -q --max-error mae=0.5 --max-time 10000
json tradeoff_none 1 "$glint" tradeoff scene.yaml --format json --budget 1 -q --max-time 0.000001
json tradeoff_error 0 "$glint" tradeoff scene.yaml --format json --budget 1 -q --set image.error=0.05 --set image.min_samples=4 --samples 8
by_schema tradeoff tradeoff.json tradeoff_none.json tradeoff_error.json
exit $failed
