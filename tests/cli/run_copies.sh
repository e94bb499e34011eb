#!/bin/sh
# run_copies.sh GLINT SOURCE_FOLDER WORK_FOLDER: copies from the command line.
. "${0%/*}/lib.sh"

cat >board.yaml <<'S'
glint: 1
parameters: {size: 3, pitch: 1.5}
image: {width: 48, height: 32}
camera: {position: [1.5, 6, 9], look_at: [1.5, 0, 1]}
lights: [{for: {s: [-1, 1]}, position: [5*s, 8, 5], intensity: 0.6}]
spheres:
  - {center: [0, 3, 0], radius: 0.3}
  - name: pawn
    for: {row: 2, i: size}
    if: i != row
    center: [pitch*i, 0, 2*row]
    radius: 0.4
    material: {diffuse_color: "hsv(60*i, 0.8, 1)"}
boxes: [{for: {layer: 3, x: 3 - layer}, center: [x, 0.2*layer, -2], size: 0.2}]
S
expect "copies are listed" 0 "^  sphere 'pawn'    4 .board.yaml:8:11.$" - "$glint" inspect board.yaml
expect "those without a name too" 0 '^  boxes.0.         6 ' - "$glint" inspect board.yaml
expect "counted in the lists" 0 '^spheres *5$' - "$glint" inspect board.yaml
expect "as JSON" 0 '"count": 4' - "$glint" inspect board.yaml --format json
expect "another count" 0 "^  sphere 'pawn'    7 " '' "$glint" inspect board.yaml --set 'spheres[pawn].for.i=4' --set 'spheres[pawn].if=i > 0 or row == 1'
expect "by a parameter" 0 "^  sphere 'pawn'    8 " - "$glint" inspect board.yaml --set parameters.size=5
expect "none" 0 "^  sphere 'pawn'    0 " - "$glint" inspect board.yaml --set parameters.size=0
expect "a copy has no values" 1 - 'a copy has no values of its own' "$glint" check board.yaml --set 'spheres[pawn][1][0].radius=1'
expect "not by its name either" 1 - 'a copy has no values of its own' "$glint" check board.yaml --set 'spheres[pawn[1][0]].radius=1'
expect "sweeps of the entry" 0 - 'wrote 2 pictures' "$glint" render board.yaml --sweep 'spheres[pawn].radius=0.2,0.3' -o 'swept-%v.png'

# Names and places of copies.
expect "what a pixel shows" 0 'pawn.1..2.' - "$glint" pick board.yaml 29,17 --device reference
expect "each has a matte" 0 '"pawn.1..0."' - sh -c "'$glint' render board.yaml -q --device reference --aov object -o board.pfm && cat board*.json"
expect "focus on a copy" 0 - '' "$glint" check board.yaml --set 'camera.focus_on="pawn[0][2]"' --set camera.aperture=0.1
expect "not on what is left out" 1 - "there is no body 'pawn.0..0.': of 'pawn' there are 4 copies" "$glint" check board.yaml --set 'camera.focus_on="pawn[0][0]"' --set camera.aperture=0.1

# Written out, and in the other spellings, it is the same picture.
"$glint" render board.yaml -q --device reference -o board.pfm
for other in plain.yaml plain.xml plain.json; do
    expect "expanded, $other" 0 - '' "$glint" convert board.yaml "$other" --expanded
    expect "nothing is copied" 1 - - grep -E '<For|for:|"for"|diffuse_color: hsv' "$other"
    expect "drawn" 0 - '' "$glint" render "$other" -q --device reference -o other.pfm
    expect "the same picture, $other" 0 - - cmp other.pfm board.pfm
done
same_twins board.yaml board.pfm
sed 's/radius: 0.4/radius: 0.4 + 0.1*(i > 1)/' board.yaml >larger.yaml
sed 's/0.4 + 0.1.(i > 1)/0.5 if i > 1 else 0.4/' larger.yaml >other.yaml
expect "a difference of copies" 1 'changed spheres.pawn.0..2...radius: 0.4 -> 0.5' '' "$glint" diff board.yaml other.yaml

# One message for a mistake in all copies, with the values of one.
sed 's/radius: 0.4$/radius: 0.4 - 0.2*i/' board.yaml >wrong.yaml
expect "the mistake" 1 - "'radius' of sphere 'pawn.0..2.' is 0, with row = 0, i = 2; it must be" "$glint" check wrong.yaml
expect "once" 1 - 'so it is with 1 more of its copies' "$glint" check wrong.yaml
expect "an answer for programs" 1 '"notes"' - "$glint" check wrong.yaml --format json

# A track moves all copies of its entry; what there is does not depend on the frame.
{ cat board.yaml; printf 'animation:\n  frames: 4\n  tracks: {"spheres[pawn].center.y": frame/2}\n'; } >moving.yaml
expect "moved" 0 '    center: \[1.5, 1, 0\]' '' "$glint" inspect moving.yaml --frame 2 --ir=evaluated
expect "all" 0 '    center: \[0, 1, 2\]' '' "$glint" inspect moving.yaml --frame 2 --ir=evaluated
sed 's/frame.2}/frame\/2, parameters.size: 2 + frame}/' moving.yaml >growing.yaml
expect "a count that moves" 1 - 'how many copies there are depends on the frame' "$glint" check growing.yaml

# Bombs end at a limit, before anything is made of them.
bomb() {
    printf 'glint: 1\nspheres: [{for: {%s}, %s center: [0, 0, 0], radius: 1}]\n' "$2" "$3" >bomb.yaml
    expect "$1" 1 - 'limit copies' sh -c "ulimit -v 1000000; timeout 60 '$glint' check bomb.yaml"
}
bomb "10^12 bodies" 'a: 1000000, b: 1000000' ''
bomb "none of 10^9 is kept" 'a: 1000000000' 'if: false,'
bomb "counts that grow" 'a: 1000, b: 1000*a, c: b*b' ''
bomb "16 variables" "$(awk 'BEGIN {for (i = 0; i < 16; i++) printf "%sv%d: 9", i ? ", " : "", i}')" ''
bomb "mostly empty" 'a: 1000000, b: 1000000, c: 0*b' ''
awk 'BEGIN {printf "glint: 1\nspheres: [{for: {"; for (i = 0; i < 64; i++) printf "%sv%d: 1", i ? ", " : "", i; print "}, center: [0, 0, 0], radius: 1}]"}' >many.yaml
expect "64 variables" 1 - 'an entry can have 16 variables; this one has 64' "$glint" check many.yaml
awk 'BEGIN {printf "glint: 1\nspheres: [{for: {i: 1000000}, radius: 1, center: [i"; for (i = 0; i < 200; i++) printf " + sin(i)"; print ", 0, 0]}]"}' >costly.yaml
expect "costly values" 1 - 'limit evaluations' "$glint" check costly.yaml

exit $failed
