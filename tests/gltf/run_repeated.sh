#!/bin/sh
# run_repeated.sh GLINT SOURCE_FOLDER WORK_FOLDER: what `glint import` makes of nodes that occur again, and of nodes that shear.
. "$(dirname -- "$0")/../cli/lib.sh"
small='--size 64x48 --samples 4 --device reference'

# draw SCENE: SCENE.pfm
draw() {
    # shellcheck disable=SC2086 -- options
    "$glint" render "$1" $small -q -o "$1.pfm" 2>draw.err || fail "render $1: $(cat draw.err)"
}
# alike NAME A B: up to the last bits of a float.
alike() {
    expect "$1" 0 '' - "$glint" compare "$2.pfm" "$3.pfm" --space linear --max-largest 1e-6
}
# file NODES ROOTS: a.gltf with two triangles as meshes, 'kite' and one without a name.
file() {
    awk -v seed=1 -f "$source/tests/gltf/hierarchy.awk" | awk -v nodes="$1" -v roots="$2" '
        /^"nodes"/ { print "\"nodes\": [" nodes ", {\"name\": \"eye\", \"camera\": 0, \"translation\": [0, 0, 20]}],"; skip = 1 }
        /^"scenes"/ { print "\"scenes\": [{\"nodes\": [" roots "]}]}"; skip = 1 }
        !skip' >a.gltf
}
seat() { printf '{"name": "seat", "mesh": 0, "translation": [0, %s, 0]}, {"name": "back", "mesh": 1, "translation": [0, 1, -0.5], "rotation": [0, 0.70710678118655, 0, 0.70710678118655]}' "$1"; }

# Three chairs: one object. The third is stretched and turned, so that its matrix shears.
file "{\"name\": \"chair\", \"children\": [1, 2]}, $(seat 0.5), {\"name\": \"chair.001\", \"children\": [4, 5], \"translation\": [2, 0, 0]}, $(seat 0.5),
 {\"name\": \"tall\", \"scale\": [1, 2, 1], \"children\": [7]}, {\"name\": \"chair\", \"children\": [8, 9], \"translation\": [-2, 0, 0], \"rotation\": [0, 0, 0.38268343236509, 0.92387953251129]}, $(seat 0.5)" '0, 3, 6, 10'
expect 'chairs' 0 - '' "$glint" import a.gltf -o chairs.yaml -q
sed -n '/^objects:/,$p' chairs.yaml >got.txt
cat >wanted.txt <<'S'
objects:
  chair:
    models:
      - name: seat
        mesh: a.gltf
        part: kite
        material: red
        translation: [0, 0.5, 0]
      - name: back
        mesh: a.gltf
        part: mesh 1
        rotation: [0, 90, 0]
        translation: [0, 1, -0.5]

instances:
  - {name: chair, object: chair}
  - {name: chair_001, object: chair, translation: [2, 0, 0]}
  - name: chair_2
    object: chair
    matrix: [[0.7071067812, -0.7071067812, 0, -2], [1.414213562, 1.414213562, 0, 0], [0, 0, 1, 0]]
S
same 'three chairs are an object and its instances' got.txt wanted.txt
expect 'it is laid out as glint format does it' 0 '' '' "$glint" format --check chairs.yaml
expect 'without findings' 0 - - "$glint" check chairs.yaml
draw chairs.yaml
draw a.gltf
same 'the file by itself is the same picture' chairs.yaml.pfm a.gltf.pfm
for spelling in xml json; do
    expect "as $spelling" 0 - '' "$glint" import a.gltf -o "chairs.$spelling" -q
    draw "chairs.$spelling"
    same "as $spelling it is the same picture" chairs.yaml.pfm "chairs.$spelling.pfm"
done

# What is not the same, or alone, stays as it is.
file "{\"name\": \"chair\", \"children\": [1, 2]}, $(seat 0.5), {\"name\": \"chair.001\", \"children\": [4, 5], \"translation\": [2, 0, 0]}, $(seat 0.6),
 {\"name\": \"kite\", \"mesh\": 0}, {\"name\": \"kite\", \"mesh\": 0, \"translation\": [0, -2, 0]}" '0, 3, 6, 7, 8'
expect 'nothing occurs again' 0 - '' "$glint" import a.gltf -o differ.yaml -q
expect 'so there are no objects' 1 - - grep -E 'objects|instances' differ.yaml

# One body below a node, and lights.
lamp='{"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0.5, 0.5]}'
file "{\"name\": \"lamp\", \"children\": [1, 2]}, {\"mesh\": 0, \"translation\": [0, 1, 0]}, $lamp, {\"name\": \"lamp\", \"children\": [4, 5], \"translation\": [0, -2, 0]},
 {\"mesh\": 0, \"translation\": [0, 1, 0]}, $lamp" '0, 3, 6'
expect 'lamps' 0 - '' "$glint" import a.gltf -o lamps.yaml -q
expect 'are an object with its light' 0 '^    lights:' - sed -n '/^objects:/,/^instances:/p' lamps.yaml

# What an instance cannot place, and what would be too many.
file "{\"name\": \"chair\", \"children\": [1, 2]}, $(seat 0.5), {\"name\": \"chair\", \"children\": [4, 5], \"scale\": [1, 0, 1]}, $(seat 0.5),
 {\"name\": \"chair\", \"children\": [7, 8], \"translation\": [2, 0, 0]}, $(seat 0.5)" '0, 3, 6, 9'
expect 'one is flat' 0 - '' "$glint" import a.gltf -o flat.yaml -q
expect 'no error' 0 - '' "$glint" check flat.yaml
[ "$(grep -c 'object: chair' flat.yaml)" -eq 2 ] && [ "$(grep -c 'part: node' flat.yaml)" -eq 2 ] && pass 'and is no instance' || fail 'flat.yaml'
expect 'where there may be no more copies there are no objects' 0 - '' "$glint" import a.gltf -o few.yaml -q --limit copies=5
expect 'none' 1 - - grep objects few.yaml

# Random hierarchies: as without objects, and as the whole file is as one mesh.
seed=1 objects=0 matrices=0
while [ $seed -le 20 ]; do
    awk -v seed=$seed -f "$source/tests/gltf/hierarchy.awk" >a.gltf
    expect "hierarchy $seed" 0 - '' "$glint" import a.gltf -o new.yaml --force -q
    expect "hierarchy $seed, flat" 0 - '' "$glint" import a.gltf -o flat.yaml --force -q --limit object-depth=1
    expect "hierarchy $seed is right" 0 - '' "$glint" check new.yaml
    expect "hierarchy $seed is laid out" 0 '' '' "$glint" format --check new.yaml
    awk '/^(models|objects|instances):/ { skip = 1 } !skip; END { print "models: [{mesh: a.gltf}]" }' flat.yaml >whole.yaml
    objects=$((objects + $(grep -c '^objects:' new.yaml))) matrices=$((matrices + $(grep -c ' matrix:' new.yaml)))
    for scene in new flat whole; do draw $scene.yaml; done
    alike "hierarchy $seed as it was" new.yaml flat.yaml
    expect "hierarchy $seed as one mesh" 0 '' - "$glint" compare new.yaml.pfm whole.yaml.pfm --space linear --max-share 0.002 --threshold 1e-5
    seed=$((seed + 1))
done
[ $objects -gt 15 ] && [ $matrices -gt 10 ] && pass 'they have objects and matrices' || fail "$objects have objects, $matrices matrices"

exit $failed
