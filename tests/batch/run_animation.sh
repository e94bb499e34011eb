#!/bin/sh
# A scene that says itself how it moves: a frame has the bytes of the scene with that frame's values, in both spellings,
# alone and among others; a picture without a frame those of the scene without its animation.
# Usage: run_animation.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
export XDG_CACHE_HOME="$work/cache"
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 1 4 2\n' >face.obj
cat >still.yaml <<'S'
glint: 1
image: {width: 40, height: 30, transfer: srgb}
camera: {position: [0, 0, 6], look_at: [0, 0, 0], fov: 40}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}, red: {diffuse_color: 0.5}}
spheres: [{name: ball, center: [-0.9, 0, 0], radius: 0.9, material: blue}]
models: [{name: face, mesh: face.obj, translation: [0.9, 0, 0], material: red}]
S
cat still.yaml - >scene.yaml <<'S'
animation:
  frames: 20
  rate: 10
  tracks:
    camera.position: [6*sin(360*frame/20), 0.5, 6*cos(360*frame/20)]
    models[face].translation.x: {interpolation: ease, loop: mirror, keys: [{frame: 0, value: 0.9}, {frame: 8, value: 1.9}]}
    materials.red.diffuse_color: {keys: [{frame: 0, value: "#404040"}, {frame: 10, value: [0.25, 0.5, 1]}]}
    spheres[ball].radius: 0.9 + time/10
S
"$glint" convert scene.yaml scene.xml && pass 'converted' || fail 'converted'

# What the tracks say of frame 4, worked out by hand: a fifth of a turn, half of the way of an eased key, 0.4 of a colour.
at4="--set camera.position=[5.706339097770921,0.5,1.8541019662496847] --set models[face].translation.x=1.4"
at4="$at4 --set spheres[ball].radius=0.94"
"$glint" inspect --ir=evaluated scene.yaml --frame 4 >frame.ir
matches 'position: \[5.70633909777092[0-9]*, 0.5, 1.8541019662496[0-9]*\]' frame.ir &&
    matches 'translation: \[1.4, 0, 0\]' frame.ir && matches 'radius: 0.94' frame.ir &&
    matches 'diffuse_color: \[0.1307' frame.ir && pass 'values of a frame' || fail 'values of a frame'
"$glint" inspect --ir=evaluated scene.xml --frame 4 | cmp -s - frame.ir && pass 'twins in a frame' || fail 'twins in a frame'
grep -q animation frame.ir && fail 'a frame has no animation' || pass 'a frame has no animation'
"$glint" inspect --ir=evaluated scene.yaml | grep -q 'frames: 20' && pass 'the scene keeps it' || fail 'the scene keeps it'

# Files that include each other: tracks of both.
cat >base.yaml <<'S'
glint: 1
spheres: [{name: ball, center: [0, 0, 0], radius: 1}]
animation: {frames: 5, tracks: {"spheres[ball].radius": 1 + frame}}
S
printf 'glint: 1\ninclude: [base.yaml]\nanimation: {frames: 10, tracks: {camera.fov: 30 + frame}}\ncamera: {fov: 30}\n' >both.yaml
"$glint" inspect --ir=evaluated both.yaml --frame 7 >both.ir && matches 'fov: 37' both.ir && matches 'radius: 8' both.ir &&
    pass 'tracks of two files' || fail 'tracks of two files'
tells 'a frame after the end' 1 'no frame 20: the animation has 20 frames' "$glint" check scene.yaml --frame 20
tells 'a frame of nothing' 1 'has no animation' "$glint" check still.yaml --frame 2
tells 'all frames of nothing' 2 'has no animation' "$glint" render still.yaml --frames all
tells 'frames after the end' 2 'has 20 frames, 0 to 19' "$glint" render scene.yaml --frames 15..25
tells 'no number' 2 'takes a whole number' "$glint" check scene.yaml --frame x
tells 'a farm' 0 - "$glint" farm slurm scene.yaml --frames all --chunk 5 -o 'f.%d.png' --folder farm -q
matches 'first=0 last=19 ' farm/job.sh && pass 'its frames' || fail 'its frames'

# A scene that names the frame that it shows by itself has the others too.
sed 's/^  rate: 10/&\n  frame: 4/' scene.yaml >shown.yaml
"$glint" inspect --ir=evaluated shown.yaml | cmp -s - frame.ir && pass 'the frame of the file' || fail 'the frame of the file'
"$glint" inspect --ir=evaluated shown.yaml --frame 9 >9.ir
"$glint" inspect --ir=evaluated scene.yaml --frame 9 | cmp -s - 9.ir && pass 'another one' || fail 'another one'
tells 'a farm for it' 0 - "$glint" farm slurm shown.yaml --frames all --chunk 5 -o 'f.%d.png' --folder shown -q
matches 'first=0 last=19 ' shown/job.sh && pass 'all of its frames' || fail 'all of its frames'
sed 's|radius: 0.9 + time/10|radius: 0.9 - time|' shown.yaml >small.yaml
tells 'a frame that is not shown' 1 'E222|must be' "$glint" check small.yaml
tells 'one frame is asked for' 0 - "$glint" check small.yaml --frame 3

if ! "$glint" render still.yaml -o still.pfm -q 2>/dev/null; then
    [ $failed -eq 0 ] || exit 1
    echo "skip: no Vulkan device: of an animation only its values"
    exit 77
fi
"$glint" render scene.yaml -o plain.pfm -q && cmp -s still.pfm plain.pfm && pass 'no frame: as written' || fail 'no frame: as written'
"$glint" render scene.yaml --frames all -o 'f.%02d.png' --stats 2>stats.txt
"$glint" render shown.yaml --frames all -o 's.%02d.png' -q
for f in f.*.png; do
    "$glint" compare "$f" "s.${f#f.}" --max-largest 0 >compared.txt || fail "a scene that names a frame: $f"
done
[ "$(ls f.*.png | wc -l)" = 20 ] && pass 'all frames' || fail 'all frames'
matches '1 mesh and 0 images read' stats.txt && pass 'nothing is read twice' || {
    fail 'nothing is read twice'
    cat stats.txt
}
# What `auto` found holds while a scene stays like it was: not where the finest thing gets four times as small with each frame, or the
# camera looks elsewhere.
asked() { sed -n 's/.*"precision_asked": \([0-9]*\).*/\1/p'; }
n=$("$glint" render scene.yaml --frames all -o 'p.%02d.pfm' -q --stats=json | asked)
[ "$n" -ge 2 ] && [ "$n" -le 6 ] && pass "precision asked for $n of 20 frames" || fail "precision asked for $n of 20 frames"
n=$("$glint" render still.yaml --frames 0..4 --set 'spheres[ball].radius={0.9/4^frame}' -o 'p.%02d.pfm' -q --stats=json | asked)
[ "$n" -ge 3 ] && pass 'again where the finest shrinks' || fail "for $n of 5 frames of what shrinks"
n=$("$glint" render still.yaml --frames 0..4 --set 'camera.position=[{6*(frame%2)}, 0, {6-6*(frame%2)}]' -o 'p.%02d.pfm' -q --stats=json | asked)
[ "$n" = 5 ] && pass 'for each cut' || fail "for $n of 5 cuts"
n=$("$glint" render scene.yaml --sweep camera.fov=39:41:3 -o 'p.%02d.pfm' -q --stats=json | asked)
[ "$n" = 3 ] && pass 'for each value of a sweep' || fail "for $n of 3 values of a sweep"
"$glint" render scene.yaml --frame 4 -o one.png -q && cmp -s one.png f.04.png && pass 'one frame' || fail 'one frame'
"$glint" render scene.xml --frames 4 -o xml.png -q && "$glint" compare xml.png f.04.png --max-mae 0 >/dev/null &&
    pass 'the other spelling' || fail 'the other spelling'
# shellcheck disable=SC2086 # options
"$glint" render still.yaml $at4 --set 'materials.red.diffuse_color=[0.13076269033984853, 0.2307626903398485, 0.43076269033984853]' -o hand.pfm -q
"$glint" render scene.yaml --frame 4 -o four.pfm -q && "$glint" compare hand.pfm four.pfm >compared.txt 2>&1 &&
    pass 'the values by hand' || {
    fail 'the values by hand'
    cat compared.txt
}
"$glint" verify f.04.png >/dev/null 2>&1 && pass 'verified' || fail 'verified'
"$glint" render scene.yaml --frames all -o 'f.%02d.png' --skip-done 2>&1 | grep -q '20 of 20 pictures are done' &&
    pass 'done already' || fail 'done already'
"$glint" render scene.yaml --frames all -o film.y4m -q && head -c 30 film.y4m | grep -q 'F10:1' && pass 'its rate' || fail 'its rate'
# Expressions of the command line go on top, with the animation's time.
"$glint" render scene.yaml --frames 4..5 --set 'spheres[ball].center.y={time}' -o 'g.%d.png' -q &&
    "$glint" render scene.yaml --frame 4 --set 'spheres[ball].center.y=0.4' -o h.png -q &&
    "$glint" compare g.4.png h.png --max-mae 0 >/dev/null && pass 'with --set' || fail 'with --set'
exit $failed
