#!/bin/sh
# run_parameters.sh GLINT SOURCE_FOLDER WORK_FOLDER: parameters and expressions from the command line.
. "${0%/*}/lib.sh"

cat >row.yaml <<'S'
glint: 1
parameters:
  count: {value: 3, min: 1, max: 8}
  pitch: 1.5
  length: (count - 1)*pitch
  where: [length/2, 0, 0]
image: {width: 48, height: 32}
camera: {position: [length/2, 1, 8], look_at: where}
lights: [{position: [-5, 8, 5]}]
spheres:
  - {center: [0, 0, 0], radius: pitch/3}
  - {center: where, radius: pitch/3}
S
expect "parameters are listed" 0 '^  length  *3 = .count - 1.\*pitch$' - "$glint" inspect row.yaml
expect "a vector too" 0 '^  where  *.1.5, 0, 0. = length/2, 0, 0$' - "$glint" inspect row.yaml
expect "bounds too" 0 '^  count  *3, at least 1, at most 8$' - "$glint" inspect row.yaml
expect "another value" 0 '^  length  *6 = ' - "$glint" inspect row.yaml --set parameters.count=5
expect "an expression" 0 '^  length  *4.5 = ' - "$glint" inspect row.yaml --set 'parameters.pitch=4.5/2'
expect "of another parameter" 0 '^  length  *6 = ' - "$glint" inspect row.yaml --set parameters.pitch=count
expect "beyond its bound" 1 - "parameter 'count' is 9; it must be at most 8" "$glint" check row.yaml --set parameters.count=9
expect "no such parameter" 1 - "did you mean 'count'" "$glint" check row.yaml --set parameters.cout=9

# However many are computed from each other.
awk 'BEGIN {print "glint: 1\nparameters:"; for (i = 0; i < 100000; i++) printf "  p%d: p%d + 1\n", i, i + 1
    print "  p100000: 1\nspheres: [{center: [0, 0, 0], radius: p0}]"}' >chain.yaml
expect "a long chain" 0 - '' "$glint" check chain.yaml
sed 's/p100000: 1/p100000: p0/' chain.yaml >ring.yaml
expect "a long ring" 1 - "'p0' depends on itself, by way of: p0, p1, p2, p3, p4, p5, p6, p7 and 99993 more" "$glint" check ring.yaml

# What is set is what would be written.
sed 's/pitch: 1.5/pitch: 0.9/' row.yaml >written.yaml
expect "drawn as set" 0 - '' "$glint" render row.yaml -q --device reference --set parameters.pitch=0.9 -o set.pfm
expect "and as written" 0 - '' "$glint" render written.yaml -q --device reference -o written.pfm
expect "the same picture" 0 - - cmp set.pfm written.pfm

# Values in the place of what is computed.
for plain in plain.yaml plain.xml plain.json; do
    expect "expanded, $plain" 0 - '' "$glint" convert row.yaml "$plain" --expanded
    expect "nothing is computed" 1 - - grep -E 'arameter|pitch|length' "$plain"
    expect "drawn" 0 - '' "$glint" render "$plain" -q --device reference -o plain.pfm
    "$glint" render row.yaml -q --device reference -o row.pfm
    expect "the same picture, $plain" 0 - - cmp plain.pfm row.pfm
done
mkdir -p parts
printf 'glint: 1\nparameters: {tone: 0.25}\nmaterials: {red: {diffuse_color: [tone*2, 0, 0]}}\n' >parts/part.yaml
sed 's,^parameters:,include: [parts/part.yaml]\n&,; s/radius: pitch.3}$/radius: pitch\/3, material: red}/' row.yaml >whole.yaml
expect "with its includes" 0 'DiffuseColor r="0.5" g="0"' '' "$glint" convert whole.yaml - --expanded
expect "the parts' parameters too" 0 '^  tone  *0.25$' - "$glint" inspect whole.yaml

# A file of parameters, or of light from all sides, is a library that is used (W409 is of one that adds nothing).
printf 'glint: 1\nparameters: {tall: 0.5}\n' >library.yaml
printf 'glint: 1\nambient: {color: 0.2}\n' >ambient.yaml
sed 's|^parameters:|include: [library.yaml, ambient.yaml]\n&|; s|pitch/3}$|tall}|' row.yaml >user.yaml
expect "used by its parameters" 0 - '' "$glint" check user.yaml

# What moves.
{ cat row.yaml; printf 'animation:\n  frames: 10\n  tracks: {parameters.pitch: 1 + frame/4}\n'; } >moving.yaml
expect "a track moves a parameter" 0 '^  length  *4$' - "$glint" inspect moving.yaml --frame 4
expect "which is gone in the frame" 1 - - sh -c "'$glint' inspect moving.yaml --frame 4 --ir=evaluated | grep -E 'arameter|pitch|length'"
expect "expanded, one frame" 2 - 'add --frame 0' "$glint" convert moving.yaml - --expanded
expect "this one" 0 'Center x="2" y="0"' '' "$glint" convert moving.yaml - --expanded --frame 4
expect "a frame alone" 2 - "only an '--expanded' scene stands still" "$glint" convert moving.yaml - --frame 4
sed 's/radius: pitch.3}$/radius: 0.5 + frame*0.1}/; s/^  tracks.*//' moving.yaml >formula.yaml
expect "an expression of the frame" 0 'radius="0.8"' '' "$glint" convert formula.yaml - --expanded --frame 3
expect "at rest it is frame 0" 0 'radius="0.5 \+ frame\*0.1"' '' "$glint" convert formula.yaml -
sed 's/frame\*0.1/1 - frame*0.2/' formula.yaml >shrinking.yaml
expect "checked in all frames" 1 - 'in frame 8; it must be' "$glint" check shrinking.yaml

# What a scene comes to is one text for all that mean the same; in a film, what moves stays.
cat >values.yaml <<'S'
glint: 1
parameters: {k: 0.5, shine: k/2, lit: true, red: "#ff8000", r: k + 0.1*frame}
trace: {shadows: lit}
lights: [{position: [0, 5*k, 5], spot: {look_at: [0, 0, 0], angle: 30, softness: shine}}]
spheres:
  - {center: [0, k, 0], radius: r, material: {diffuse_color: [k, k, 1]}}
  - {for: {i: 2}, center: [i, k, 1], radius: k, material: {diffuse_color: red}}
S
{ cat values.yaml; printf 'animation: {frames: 10, tracks: {"lights[0].intensity": 1 + k*frame}}\n'; } >film.yaml
evaluated() {
    to=$1
    shift
    "$glint" inspect --ir=evaluated "$@" >"$to"
}
for frame in 0 5; do
    expect "as expanded" 0 - '' "$glint" convert film.yaml plain.yaml --expanded --frame $frame
    evaluated film.ir film.yaml --frame $frame
    evaluated plain.ir plain.yaml
    expect "the same text" 0 - - cmp film.ir plain.ir
done
evaluated values.ir values.yaml
expect "without a film" 0 'softness: 0.25' - cat values.ir
expect "nothing is computed" 1 - - grep -E 'arameter|shine|red|lit|\*|[:[] ?[kr]' values.ir
evaluated film.ir film.yaml
expect "what moves stays" 0 '^  - center: .0, 0.5, 0.' - cat film.ir
expect "by its parameter" 0 '^    radius: r$' - cat film.ir
expect "as it is written" 0 '^  r: k [+] 0.1[*]frame$' - cat film.ir
expect "others are values" 0 '^  shine: 0.25$' - cat film.ir
expect "a truth is no text" 0 '^  lit: true$' - cat film.ir
cp film.ir again.yaml
evaluated again.ir again.yaml
expect "it reads back" 0 - - cmp film.ir again.ir

# Braces are filled by every command, in one frame.
expect "braces" 0 '^  length  *5 = ' '' "$glint" inspect row.yaml --set 'parameters.pitch={2 + frame + 0.5}'
expect "in a frame" 0 '^  length  *10$' '' "$glint" inspect moving.yaml --frame 4 --set 'parameters.count={frame + 2}'
expect "wrong braces" 2 - "there is no number 'fram'" "$glint" check row.yaml --set 'parameters.pitch={2 + fram}'

# Models of one mesh are one line.
printf 'o t\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >tri.obj
{ printf 'glint: 1\ncamera: {position: [0, 0, 9]}\nlights: [{position: [0, 9, 9]}]\nmodels:\n'
    for i in 1 2 3; do printf '  - {mesh: tri.obj, translation: [%d, 0, 0]}\n' $i; done
    printf '  - {name: other, mesh: two.obj}\n'; } >crowd.yaml
cp tri.obj two.obj
expect "grouped" 0 '^  3 models, tri.obj: 1 triangles, open' - "$glint" inspect crowd.yaml
expect "and one" 0 '^  other, two.obj: 1 triangles, open' - "$glint" inspect crowd.yaml
exit $failed
