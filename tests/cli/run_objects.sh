#!/bin/sh
# run_objects.sh GLINT SOURCE_FOLDER WORK_FOLDER: objects and their instances from the command line.
. "${0%/*}/lib.sh"

cat >room.yaml <<'S'
glint: 1
image: {width: 64, height: 48}
camera: {position: [0.5, 2.5, 4], look_at: [0.4, 0.4, 0], fov: 50}
lights: [{position: [3, 6, 4]}]
materials: {oak: {diffuse_color: [0.6, 0.4, 0.2]}, red: {diffuse_color: [0.8, 0.1, 0.1]}}
parameters: {seat: 0.45}
objects:
  chair:
    parameters: {h: seat, top: h + 0.55, paint: "#208040"}
    boxes:
      - {center: [0, h, 0], size: [0.45, 0.05, 0.34]}
      - {name: back, center: [0, (h + top)/2, -0.2], size: [0.45, top - h, 0.05], material: {diffuse_color: paint}}
    cylinders: [{for: {x: [-0.18, 0.18], z: [-0.18, 0.18]}, from: [x, 0, z], to: [x, h - 0.03, z], radius: 0.02}]
    lights: [{position: [0, 2, 0], intensity: 0.2}]
instances:
  - name: left
    rotation: [0, 20, 0]
    material: oak
    object:
      instances:
        - {for: {x: [-0.35, 0.35]}, object: chair, translation: [x, 0, -0.55]}
        - {name: small, object: chair, with: {h: 0.3, paint: "#2040c0"}, material: red, scale: -0.5, translation: [0, 0.4, 0.55]}
  - {for: {i: 2}, if: i > 0, object: chair, matrix: [[0, 0, 1, i], [0, 1.5, 0, 0.2], [-1, 0, 0, 0]], material: red}
spheres: [{center: [0, 0.2, 1], radius: 0.2, material: red}]
S
sed -i 's/    cylinders: /    models: /; s/for: {x: \[-0.18, 0.18\], z: \[-0.18, 0.18\]}, from: .*$/for: {x: [-0.18, 0.18], z: [-0.18, 0.18]}, mesh: leg.obj, scale: [0.04, h, 0.04], translation: [x, 0, z]}]/' room.yaml
printf 'v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n' >leg.obj
expect "no findings" 0 - - "$glint" check room.yaml

# Written out, and in the other spellings, it is the same picture.
"$glint" render room.yaml -q --device reference -o room.pfm
for other in plain.yaml plain.xml plain.json; do
    expect "expanded, $other" 0 - '' "$glint" convert room.yaml "$other" --expanded
    expect "nothing is computed" 1 - - grep -E 'Parameter|parameters|object="|object: [a-z]|For |for:' "$other"
    expect "drawn" 0 - '' "$glint" render "$other" -q --device reference -o other.pfm
    expect "the same picture, $other" 0 - - cmp other.pfm room.pfm
    expect "and once more" 0 - '' "$glint" convert "$other" again.yaml --expanded
    expect "the same text" 0 - - cmp plain.yaml again.yaml
done
same_twins room.yaml room.pfm

# The scene as it is written, in one text for both spellings, and what it comes to.
"$glint" inspect --ir room.yaml --set parameters.seat=0.5 >room.ir
for pattern in 'seat: 0.5' 'top: h [+] 0.55' 'center: \[0, [(]h [+] top[)]/2, -0.2\]' 'object: chair' 'if: i > 0' '[[] *-0.35, 0.35[]]'; do
    expect "as written: $pattern" 0 "$pattern" - cat room.ir
done
"$glint" inspect --ir twin.xml --set parameters.seat=0.5 | cmp -s - room.ir && pass 'of twins, the same' || fail 'of twins, the same'
cp room.ir again.yaml
"$glint" inspect --ir again.yaml | cmp -s - room.ir && pass 'it is a scene, of the same text' || fail 'it is a scene, of the same text'
expect 'evaluated' 0 'center: \[0, 0.775, -0.2\]' - "$glint" inspect --ir=evaluated room.yaml --set parameters.seat=0.5
cp out.txt plain.ir
expect 'nothing is computed' 1 - - grep -E '^    parameters|object: [a-z]|for:|if:' plain.ir

# An instance that changes nothing, and steps that computers do exactly, change no bit.
cat >plain.yaml <<'S'
glint: 1
image: {width: 48, height: 32}
camera: {position: [0, 1, 9]}
lights: [{position: [4, 8, 5]}]
materials: {m: {diffuse_color: {checker: {colors: [[0.9, 0.8, 0.7], [0.2, 0.3, 0.4]], size: 0.5}}}}
boxes: [{center: [-2, 0.5, 0], size: [1, 2, 1], rotation: [0, 30, 10], material: m}]
spheres: [{center: [0.5, 1, 0], radius: 0.75, material: m, rotation: [10, 20, 30]}]
cylinders: [{from: [2, 0, 0], to: [2.5, 1.5, 0.5], radius: 0.5, material: m}]
rectangles: [{corner: [-4, -1, 3], edge_u: [8, 0, 0], edge_v: [0, 0, -8], material: m}]
models: [{mesh: leg.obj, translation: [0, -1, 2], rotation: [0, 15, 0], smooth: true, material: m}]
S
"$glint" render plain.yaml -q --device reference -o plain.pfm
inside() { # NAME PLACE...: the scene's bodies and lights in instances, each PLACE within the one before
    name=$1
    shift
    awk -v places="$*" '/^(boxes|spheres|cylinders|rectangles|models|lights):/ { body = body (body ? ", " : "") $0; next } { print }
        END { n = split(places, place, "|"); text = "{" body "}"
              for (i = n; i > 0; i--) text = (i > 1 ? "{instances: " : "instances: ") "[{" place[i] ", object: " text "}]" (i > 1 ? "}" : "")
              print text }' plain.yaml >"inside.yaml"
    expect "$name: drawn" 0 - '' "$glint" render inside.yaml -q --device reference -o inside.pfm
    expect "$name: not a bit is another" 0 - - cmp inside.pfm plain.pfm
}
inside "identity" "scale: 1"
inside "nested identity" "scale: 1|rotation: [0, 0, 0]|translation: [0, 0, 0]"
inside "a quarter turn and back" "rotation: [0, 90, 0]|rotation: [0, -90, 0]"
inside "twice as large and back" "scale: 2|scale: 0.5"
inside "moved and back" "translation: [4, -2, 8]|translation: [-4, 2, -8]"
inside "a matrix" "matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]"
inside "turned by a matrix and back" "matrix: [[0, -1, 0, 2], [1, 0, 0, 0], [0, 0, 1, 0]]|matrix: [[0, 1, 0, 0], [-1, 0, 0, 2], [0, 0, 1, 0]]"

# Names, places, materials that are handed down.
expect "listed by object" 0 '^  chair            4 instances .room.yaml:8:3.$' - "$glint" inspect room.yaml
expect "as JSON" 0 '"name": "chair", "instances": 4' - "$glint" inspect room.yaml --format json

"$glint" render room.yaml -q --device reference --aov object -o names.pfm && cat names*.json >names.txt
for body in 'left/instances.0..0./back' 'left/instances.0..1./boxes.0.' 'left/small/back' 'instances.1..1./boxes.0.' 'left/small/models.0..1..0.'; do
    expect "there is a $body" 0 - - grep -q "\"$body\"" names.txt
done
expect "the innermost material" 0 '<Box material="red">' - sh -c "'$glint' convert room.yaml - --expanded | sed -n '/name=\"small\"/,/<.Instance>/p'"
expect "an answer names the instance" 0 '^in +left/instances.0..1., room.yaml:21:11' - "$glint" pick room.yaml 28,18 --device reference
expect "focus on a body in an object" 0 - '' "$glint" check room.yaml --set 'camera.focus_on="left/small/back"' --set camera.aperture=0.1
expect "on an instance" 0 - '' "$glint" check room.yaml --set 'camera.focus_on=left' --set camera.aperture=0.1
expect "not on what there is not" 1 - "there is no body 'left/tall/back'" "$glint" check room.yaml --set 'camera.focus_on="left/tall/back"' --set camera.aperture=0.1

# Paths go to what is written, and move it wherever it is shown.
expect "a value in an object" 0 'size: .0.45, 1, 0.05.' '' "$glint" inspect room.yaml --ir=evaluated --set 'objects.chair.boxes[back].size.y=1'
expect "a parameter of an object" 0 'center: .0, 0.7, 0.' '' "$glint" inspect room.yaml --ir=evaluated --set 'objects.chair.parameters.h=0.7'
expect "in an object in place" 0 - '' "$glint" check room.yaml --set 'instances[left].object.instances[small].scale=0.6'
{ cat room.yaml; printf 'animation:\n  frames: 4\n  tracks: {"objects.chair.boxes[back].center.x": frame/4, "instances[left].rotation.y": 10*frame}\n'; } >moving.yaml
expect "a track moves all that is shown" 0 - - sh -c "'$glint' inspect moving.yaml --frame 2 --ir=evaluated | grep -c 'center: .0.5, ' | grep -qx 4"
expect "and instances" 0 'rotation: .0, 10, 0.' - "$glint" inspect moving.yaml --frame 1 --ir=evaluated
for frame in 0 3; do
    "$glint" render moving.yaml -q --device reference --frame $frame -o moved$frame.pfm
    "$glint" convert moving.yaml still$frame.yaml --expanded --frame $frame
    "$glint" render still$frame.yaml -q --device reference -o still$frame.pfm
    expect "frame $frame" 0 - - cmp moved$frame.pfm still$frame.pfm
done
sed 's/for: {i: 2}, if/for: {i: 2 + frame}, if/' moving.yaml >growing.yaml
expect "a count that moves" 1 - 'depends on the frame' "$glint" check growing.yaml
cat >given.yaml <<'S'
glint: 1
objects: {a: {parameters: {n: 2, m: n}, spheres: [{for: {i: m}, center: [i, 0, 0], radius: 0.3}]}}
instances: [{object: a, with: {n: 1 + frame}}]
animation: {frames: 3, tracks: {"instances[0].translation.x": frame}}
S
expect "a count that is given by what moves" 1 - 'how many copies there are depends on the frame' "$glint" check given.yaml

# A library of objects is a file of its own.
sed -n '/^objects:/,/^instances:/p' room.yaml | sed '$d; 1i glint: 1' >chairs.yaml
sed '/^objects:/,/^    lights:/d; s/^glint: 1/&\ninclude: [chairs.yaml]/' room.yaml >whole.yaml
expect "drawn" 0 - - "$glint" render whole.yaml -q --device reference -o other.pfm
expect "the same picture" 0 - - cmp other.pfm room.pfm
printf 'glint: 1\ninclude: [chairs.yaml]\nparameters: {seat: 0.4}\nboxes: [{center: [0, 0, 0], size: seat}]\n' >none.yaml
expect "a library may have more than is used" 0 - - "$glint" check none.yaml
exit $failed
