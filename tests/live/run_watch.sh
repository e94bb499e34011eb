#!/bin/sh
# glint render --watch, as a process whose files change: each way of saving them gives a new picture, which is that of a
# program that starts then; a scene with errors leaves the old one; counters say what was done for it.
# Usage: run_watch.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
. "$(dirname -- "$0")/live.sh"
export XDG_CACHE_HOME="$work/cache"

mkdir meshes
face() { printf 'v -1 -1 0\nv 1 -1 0\nv 0 %s 0\nv 0 0 -1\nf 1 2 3\nf 1 4 2\n' "$1" >"$2"; }
face 1 meshes/face.obj
echo 'glint: 1
materials: {red: {diffuse_color: "#ff2010"}}' >parts.yaml
cat >scene.yaml <<'S'
glint: 1
include: [parts.yaml]
image: {width: 40, height: 30}
trace: {precision: single}
camera: {position: [0, 0, 6]}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}}
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: blue}]
models: [{mesh: meshes/face.obj, translation: [0.9, 0, 0], material: red}]
S
if ! "$glint" render scene.yaml -o probe.pfm -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit 77
fi

# What does not go together with it is said, and nothing is rendered.
tells 'not by the reference' 2 'not by the reference' "$glint" render scene.yaml --watch --device reference
tells 'not to standard output' 2 'name one with -o' "$glint" render scene.yaml --watch -o -
tells 'not of standard input' 2 'standard input' "$glint" render - --watch -o out.png
tells 'not of all cameras' 2 'one camera' "$glint" render scene.yaml --watch --camera all -o out.png
for option in '--repeat 3' '--time 2' '--audit' '--stats --count-rays'; do
    # shellcheck disable=SC2086 -- an option and its value
    tells "not with $option" 2 'would have no effect' "$glint" render scene.yaml --watch $option
done
tells 'a scene that is not there' 3 'does not exist' "$glint" render none.yaml --watch -o out.png

# as_new NAME [FILE]: the picture is the one that a new program makes.
as_new() {
    "$glint" render scene.yaml -o new.pfm -q 2>/dev/null
    same "$1" new.pfm out.pfm
}
cheap='"meshes_read": 0, "images_read": 0, "trees_built": 0'
compiled='"pipelines_made": 0'

begin "$glint" render scene.yaml --watch -o out.pfm --stats=json
loaded 'a picture at once' '"load": 1, "broken": false' '"meshes_read": 1' '"trees_built": 2' '"pipelines_made": 1'
as_new 'as without --watch'
cp out.pfm first.pfm

sed -i 's/#1020ff/#10ff20/' scene.yaml
loaded 'a material' "$cheap" "$compiled" '"whole": false'
as_new 'its picture'
cmp -s first.pfm out.pfm && fail 'it is another one'

sed 's/-5, 8, 5/5, 8, 5/' scene.yaml >new.yaml
mv new.yaml scene.yaml
loaded 'a light, by a new file of the name' "$cheap" "$compiled"
as_new 'its picture'

sed -i 's/0, 0, 6/0.5, 0.2, 5.5/' scene.yaml
loaded 'a camera' "$cheap" "$compiled"
sed -i 's/0.5, 0.2, 5.5/0, 0, 6/' scene.yaml
loaded 'and back' "$cheap" "$compiled"
as_new 'its picture'

sed -i 's/width: 40/width: 48/' scene.yaml
loaded 'the size of the picture' "$cheap" "$compiled" '"width": 48'
as_new 'its picture'

sed -i 's/ff2010/f0f010/' parts.yaml
loaded 'an include' "$cheap" "$compiled"
as_new 'its picture'

sed -i 's/material: red/material: blue/' scene.yaml
loaded 'another material of a body' "$cheap" "$compiled"
as_new 'its picture'

sed -i 's/0.9, 0, 0\], material/0.8, 0.1, 0], material/' scene.yaml
loaded 'a body in another place' '"meshes_read": 0' '"trees_built": 1' '"trees_kept": 1' "$compiled"
as_new 'its picture'

face 1.5 meshes/face.obj
loaded 'a mesh' '"meshes_read": 1' '"trees_built": 1, "trees_kept": 1'
as_new 'its picture'

cp out.pfm before.pfm
cp scene.yaml good.yaml
sed -i 's/radius: 0.9/radius: -1/' scene.yaml
loaded 'a mistake' '"broken": true'
same 'leaves the picture' before.pfm out.pfm
grep -q 'scene.yaml:9:.*error' said.txt || fail 'and is told with its place'
printf 'glint: 1\nspheres: [' >scene.yaml
loaded 'text that is not YAML' '"broken": true'
rm scene.yaml
loaded 'no file at all' '"broken": true'
same 'leave it, too' before.pfm out.pfm
cp good.yaml scene.yaml
loaded 'mended' '"broken": false' "$cheap" "$compiled"
as_new 'its picture'

rm meshes/face.obj
loaded 'a mesh that went' '"broken": true'
face 0.7 meshes/face.obj
loaded 'and came back as another' '"broken": false' '"meshes_read": 1'
as_new 'its picture'

sed -i 's/^include:.*/include: [parts.yaml, more.yaml]/' scene.yaml
loaded 'an include that is not there' '"broken": true'
printf 'glint: 1\nspheres: [{center: [0, -1, 1], radius: 0.3}]\n' >more.yaml
loaded 'is waited for' '"broken": false'
as_new 'its picture'

touch unrelated.yaml
unloaded 'other files of the folder do not count'
[ -z "$(find . -name '*.tmp*' -o -name '.out*')" ] && pass 'nothing is left beside the picture'
ends 'SIGINT ends it' INT 0

# Of many models that show one mesh, instances on the device, one that moves costs the tree over all of them, and their records:
# neither the mesh's tree nor its triangles.
awk 'BEGIN { n = 64
    for (y = 0; y <= n; y++) for (x = 0; x <= n; x++) printf "v %g %g %g\n", x / n - 0.5, 0.1 * sin(x) * cos(y), y / n - 0.5
    for (y = 0; y < n; y++) for (x = 1; x <= n; x++) { i = y * (n + 1) + x; printf "f %d %d %d %d\n", i, i + 1, i + n + 2, i + n + 1 } }' >meshes/cloth.obj
{
    printf 'glint: 1\nimage: {width: 40, height: 30}\ntrace: {precision: single}\ncamera: {position: [0, 4, 9], look_at: [0, 0, 0]}\n'
    printf 'lights: [{position: [-5, 8, 5]}]\nmodels:\n'
    for x in -6 -5 -4 -3 -2 -1 0 1 2 3 4 5 6; do
        for z in -6 -5 -4 -3 -2 -1 0 1 2 3 4 5 6; do echo "  - {mesh: meshes/cloth.obj, translation: [$x, 0, $z]}"; done
    done
} >scene.yaml
begin "$glint" render scene.yaml --watch -o out.pfm --stats=json
loaded 'instances' '"load": 1, "broken": false' '"meshes_read": 1' '"trees_built": 2'
# written: what the last load wrote to the device, in bytes.
written() { sed -n 's/.*"bytes_written": \([0-9]*\).*/\1/p' load.json; }
# few NAME MOST
few() {
    if [ "$(written)" -gt 0 ] && [ "$(written)" -le "$2" ]; then pass "$1"; else fail "$1: $(written)"; fi
}
sed -i 's/\[2, 0, -1\]/[2.2, 0.3, -1]/' scene.yaml
loaded 'an instance in another place' '"whole": false, "meshes_read": 0' '"trees_built": 1, "trees_kept": 1' "$compiled"
few 'writes what is over the instances alone' 20000
as_new 'its picture'
sed -i 's/\[2.2, 0.3, -1\]/[2.2, 0.3, -1], rotation: [0, 30, 10], scale: 1.2/' scene.yaml
loaded 'one that is turned and scaled' '"meshes_read": 0' '"trees_built": 1, "trees_kept": 1' "$compiled"
few 'writes no more' 20000
as_new 'its picture'
sed -i '$d' scene.yaml
loaded 'one that is gone' '"meshes_read": 0' '"trees_built": 1, "trees_kept": 1' "$compiled"
as_new 'its picture'
ends 'SIGTERM ends it' TERM 0

# A frame that takes long has a picture of few pixels before it.
sed -i 's/width: 40, height: 30/width: 480, height: 360, samples: 4/' scene.yaml
begin "$glint" render scene.yaml --watch -o out.png --stats=json -q
loaded 'as PNG' '"load": 1, "broken": false'
# seconds KEY: of the last load.
seconds() { sed -n "s/.*\"$1\": \([0-9.e+-]*\).*/\1/p" load.json; }
awk "BEGIN { exit !($(seconds coarse_s) == 0) }" || fail 'nothing is known of the first'
frame=$(seconds frame_s)
sed -i 's/-5, 8, 5/5, 8, 5/' scene.yaml
loaded 'a light' "$compiled"
if awk "BEGIN { exit !(($frame > 0.12) == ($(seconds coarse_s) > 0)) }"; then pass 'few pixels first, where it takes long'; else fail "few pixels: $frame s, $(cat load.json)"; fi
"$glint" render scene.yaml -o new.png -q 2>/dev/null
expect 'then the whole picture' 0 '' '' "$glint" compare new.png out.png --max-rmse 0
ends 'SIGTERM ends it' TERM 0
[ ! -s said.txt ] && pass 'quiet says nothing'
exit $failed
