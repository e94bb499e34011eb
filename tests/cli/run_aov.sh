#!/bin/sh
# glint render --aov: closed forms of a ball before a wall, pick, device against reference, layers and mattes.
# Usage: run_aov.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

all=depth,normal,position,albedo,object,material,index,samples,cost
cat >scene.yaml <<'S'
glint: 1
image: {width: 65, height: 65, samples: 4}
camera: {position: [0, 0, 0], direction: [0, 0, -1], fov: 90}
lights: [{position: [0, 3, 0]}]
materials:
  red: {albedo: [0.5, 0, 0, 0], diffuse_color: [0.8, 0.2, 0.4]}
  mirror: {albedo: [0, 0, 0.9, 0]}
spheres:
  - {name: ball, center: [0, 0, -5], radius: 1, material: red}
rectangles:
  - {name: floor, corner: [-50, -1, 5], edge_u: [100, 0, 0], edge_v: [0, 0, -100], material: mirror}
  - {corner: [-2, 1, -9], edge_u: [1, 0, 0], edge_v: [0, 1, 0], material: red}
S

# value FILE X Y CHANNEL: of a PFM of 65 x 65, whose rows begin at the bottom.
value() {
    od -An -tf4 -v -w4 -j $(($(head -n 3 "$1" | wc -c) + 4 * (3 * ((64 - $3) * 65 + $2) + $4))) -N4 "$1" | tr -d ' '
}
# near NAME GOT WANTED
near() {
    awk -v a="$2" -v b="$3" 'BEGIN { d = a - b; exit !(a != "" && d < 2e-5 && d > -2e-5) }' && pass "$1" ||
        fail "$1: $2, wanted $3"
}

# closed_forms STEM
closed_forms() {
    near "$1: depth of the ball" "$(value "$1.depth.pfm" 32 32 0)" 4
    near "$1: its normal" "$(value "$1.normal.pfm" 32 32 2)" 1
    near "$1: its place" "$(value "$1.position.pfm" 32 32 2)" -4
    near "$1: its albedo" "$(value "$1.albedo.pfm" 32 32 1)" 0.1
    near "$1: its number" "$(value "$1.object.pfm" 32 32 0)" 1
    near "$1: its only triangle" "$(value "$1.index.pfm" 32 32 0)" 1
    # Where the ray of row 60 meets y = -1: down by s = 2 * 60.5 / 65 - 1 for each unit ahead.
    near "$1: depth of the floor" "$(value "$1.depth.pfm" 32 60 0)" "$(awk 'BEGIN { s = 121 / 65 - 1; print sqrt(1 + s * s) / s }')"
    near "$1: its height" "$(value "$1.position.pfm" 32 60 1)" -1
    near "$1: its normal" "$(value "$1.normal.pfm" 32 60 1)" 1
    near "$1: a mirror has no albedo" "$(value "$1.albedo.pfm" 32 60 0)" 0
    near "$1: nor a shadow ray, but a mirrored one" "$(value "$1.cost.pfm" 32 60 0)" 2
    near "$1: the camera's ray and one to the light" "$(value "$1.cost.pfm" 32 32 0)" 2
    near "$1: above is nothing" "$(value "$1.depth.pfm" 32 2 0)" 0
    near "$1: nobody" "$(value "$1.object.pfm" 32 2 0)" 0
    near "$1: no triangle" "$(value "$1.index.pfm" 32 2 0)" 0
    near "$1: one ray" "$(value "$1.cost.pfm" 32 2 0)" 1
    near "$1: samples" "$(value "$1.samples.pfm" 32 2 0)" 4
}

expect 'by the reference' 0 - 'wrote exact.names.json' \
    "$glint" render scene.yaml --device reference --no-cache --aov $all -o exact.png
closed_forms exact
"$glint" render scene.yaml --device reference --no-cache -o plain.png -q
cmp -s plain.png exact.png && pass 'the picture stays the same' || fail 'the picture stays the same'
grep -q '"id": 3, "name": "rectangles\[1\]", "kind": "rectangle", "place": "scene.yaml:12:' exact.names.json &&
    pass 'who has no name has a place' || fail 'who has no name has a place'
# A lamp that is seen, before the ball and beside it before nothing, is no surface. seen STEM LIKE [OPTION...]
sed 's/^lights: .*/lights: [{position: [0, 3, 0]}, {position: [0, 0, -2.5], radius: 0.4, intensity: 9, visible: true}, {position: [-2, 2, -3], radius: 0.3, visible: true}]/' \
    scene.yaml >lamps.yaml
seen() {
    stem=$1 like=$2
    shift 2
    "$glint" render lamps.yaml "$@" --aov depth,normal,position,albedo,object,material,index -o "$stem.png" -o "$stem.pfm" -q
    near "$stem: the lamp is in the picture" "$(awk -v a="$(value "$stem.pfm" 32 32 0)" 'BEGIN { print (a > 9) }')" 1
    near "$stem: the other too" "$(awk -v a="$(value "$stem.pfm" 10 10 0)" 'BEGIN { print (a > 1) }')" 1
    for name in depth normal position albedo object material index; do
        cmp -s "$stem.$name.pfm" "$like.$name.pfm" && pass "$stem hides nothing: $name" || fail "$stem hides nothing: $name"
    done
    near "$stem: no lamp has a number" "$(value "$stem.object.pfm" 10 10 0)" 0
}
seen lamps exact --device reference --no-cache

expect 'pick says the same' 0 'ball' - "$glint" pick scene.yaml 32,32 --device reference --format json
also 'its distance too' '"distance": 4,?$|"distance": 4[,}]' ''

expect 'a name that there is not' 2 - "did you mean 'depth'" "$glint" render scene.yaml --aov depht -o no.png
expect 'no name' 2 - 'needs a name' "$glint" render scene.yaml --aov '' -o no.png
expect 'nothing behind the comma' 2 - 'needs a name' "$glint" render scene.yaml --aov depth, -o no.png
expect 'a name twice' 2 - "has 'depth' twice" "$glint" render scene.yaml --aov depth,cost,depth -o no.png
expect 'no error by the reference' 2 - 'the reference takes all samples' \
    "$glint" render scene.yaml --device reference --aov error -o no.png
expect 'not with a time' 2 - 'without --time' "$glint" render scene.yaml --aov depth --time 3 -o no.png
expect 'a file beside nothing' 2 - 'name one with -o' "$glint" render scene.yaml --aov depth -o -
[ ! -e no.png ] && pass 'nothing was written' || fail 'nothing was written'
expect 'help names them all' 0 'depth.normal.position.albedo.object.material.index.samples.error.cost' - "$glint" render --help
expect 'a scene has none' 0 'glint render scene.glint.yaml -o scene.exr --aov' - sh -c '"$0" explain aov | tr -s "\n " " "' "$glint"

# A ball of radius 1 in a picture that shows 4 x 4 of an orthographic view: pi / 16 of its only pixel, to within three samples.
cat >cover.yaml <<'S'
glint: 1
image: {width: 1, height: 1, samples: 256}
camera: {position: [0, 0, 5], direction: [0, 0, -1], projection: orthographic, size: 4}
spheres: [{name: ball, center: [0, 0, 0], radius: 1}]
S
# The last row: B, then CryptoObject00 A B G R, 01, 02, G, R, object.X, by the order of names.
covers() {
    tail -c 64 "$1" >row.bin
    near "$1: coverage" "$(od -An -tf4 -j12 -N4 row.bin | awk '{ d = $1 - 0.19635; print (d < 0.01 && d > -0.01) ? 0 : $1 }')" 0
    hash=$(sed -n 's/.*"name": "ball".*"hash": "\([0-9a-f]*\)".*/\1/p' "${1%.exr}.names.json")
    [ -n "$hash" ] && [ "$(od -An -tx4 -j16 -N4 row.bin | tr -d ' ')" = "$hash" ] && pass "$1: its hash" || fail "$1: its hash"
    near "$1: one name" "$(od -An -tf4 -j4 -N4 row.bin | tr -d ' ')" 0
}
has_exr=1
"$glint" render cover.yaml --device reference --no-cache -q --aov object --compression none -o cover.exr 2>why.txt || has_exr=0
if [ $has_exr = 1 ]; then
    covers cover.exr
    "$glint" render scene.yaml --device reference --no-cache --aov $all -o exact.exr -q
    "$glint" render scene.yaml --device reference --no-cache -o plain.exr -q
    expect 'colours of OpenEXR stay the same' 0 '' - "$glint" compare plain.exr exact.exr --max-largest 0 --format json
    if command -v exrheader >/dev/null; then
        expect 'another reader knows layers and mattes' 0 'cryptomatte/3ae39a5/name .*"CryptoObject"' - exrheader exact.exr
        also 'whole numbers are whole' 'object.X, 32-bit unsigned integer' ''
        also 'the manifest has the names' '\{"ball": "[0-9a-f]{8}", "floor": "[0-9a-f]{8}", "rectangles\[1\]"' ''
    else
        echo 'skip: no exrheader'
    fi
else
    grep -q 'libopenexr' why.txt && echo 'skip: no OpenEXR' || fail 'OpenEXR'
fi

if ! "$glint" render cover.yaml -o probe.png -q 2>/dev/null; then
    echo 'skip: no Vulkan device'
    exit $failed
fi
"$glint" render scene.yaml --aov $all -o device.png -q
"$glint" render scene.yaml -o device_plain.png -q
cmp -s device.png device_plain.png && pass 'the same picture by a device' || fail 'the same picture by a device'
closed_forms device
seen seen device
for name in object material index cost samples; do
    cmp -s device.$name.pfm exact.$name.pfm && pass "device and reference: $name" || fail "device and reference: $name"
done
for name in depth normal position albedo; do
    expect "device and reference: $name" 0 '' - "$glint" compare device.$name.pfm exact.$name.pfm --max-largest 1e-3 --format json
done
[ $has_exr = 0 ] || {
    "$glint" render cover.yaml -q --aov object --compression none -o seen.exr
    covers seen.exr
    "$glint" render scene.yaml -q --noise 0.05 --samples 64 --aov error,samples,depth -o noise.exr -o noise.png
    [ ! -e noise.error.pfm ] && pass 'layers in place of files' || fail 'layers in place of files'
}
expect 'no error without noise' 2 - "add --noise" "$glint" render scene.yaml --aov error -o late.png
[ ! -e late.png ] && pass 'before the picture' || fail 'before the picture'
exit $failed
