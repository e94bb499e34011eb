#!/bin/sh
# glint view on a display in memory, with real keys and mouse: fly, orbit, pick, other ways to look, an edited material,
# a mistake, mended, another size, minimised, closed. What P writes is what glint render makes from there.
# Usage: run_view.sh GLINT SOURCE_FOLDER WORK_FOLDER X_EVENTS
. "$(dirname -- "$0")/../cli/lib.sh"
. "$(dirname -- "$0")/live.sh"
events=$4
export XDG_CACHE_HOME="$work/cache"
unset DISPLAY WAYLAND_DISPLAY

mkdir meshes
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >meshes/face.obj
cat >scene.yaml <<'S'
glint: 1
image: {width: 96, height: 72}
trace: {precision: single}
cameras:
  front: {position: [0, 0, 6], fov: 40}
  side: {position: [6, 1, 0], fov: 40}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}}
spheres: [{name: ball, center: [-0.9, 0, 0], radius: 0.9, material: blue}]
models: [{mesh: meshes/face.obj, translation: [0.9, 0, 0]}]
S
if ! "$glint" render scene.yaml -o probe.pfm -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit 77
fi

tells 'no display' 4 'no window.*E708' "$glint" view scene.yaml
grep -q 'render SCENE --watch' out.txt || fail 'and what to do without'
if grep -q 'without GLFW' out.txt; then
    echo "skip: built without GLFW"
    exit 77
fi
tells 'not of standard input' 2 'follows a file' "$glint" view -
tells 'not by the reference' 2 'needs a device' "$glint" view scene.yaml --device reference
if ! command -v Xvfb >/dev/null || [ ! -x "$events" ]; then
    echo "skip: Xvfb or libxtst is not installed (xvfb, libxtst-dev, libx11-dev)"
    exit 77
fi

Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp 3>number.txt >xvfb.txt 2>&1 &
server=$!
trap 'kill "$server" 2>/dev/null' EXIT
for _ in $(seq 100); do
    [ -s number.txt ] && break
    sleep 0.1
done
DISPLAY=:$(cat number.txt)
export DISPLAY

# does WORD...: real events; a failure is one of the test.
does() { "$events" scene.yaml "$@" || fail "events: $*"; }

# written: what the key P writes, when it is there.
writes=0
written() {
    rm -f out.pfm
    writes=$((writes + 1))
    does key p
    for _ in $(seq 300); do
        [ -s out.pfm ] && return
        sleep 0.1
    done
    fail 'no picture was written'
}

# as_rendered NAME OPTION...: P writes what glint render makes.
as_rendered() {
    name=$1
    shift
    written
    for _ in $(seq 50); do
        samples=$(sed -n 's/^glint: wrote out.pfm.* \([0-9]*\) samples*$/\1/p' said.txt | tail -1)
        [ "$(grep -c '^glint: wrote' said.txt)" -ge "$writes" ] && break
        sleep 0.1
    done
    "$glint" render scene.yaml -o new.pfm -q --samples "$samples" "$@" 2>/dev/null
    same "$name" new.pfm out.pfm
}

# other NAME FILE FILE
other() {
    if cmp -s "$2" "$3"; then fail "$1"; else pass "$1"; fi
}

begin "$glint" view scene.yaml -o out.pfm --stats=json
trap 'kill "$process" "$server" 2>/dev/null' EXIT
does await
loaded 'a window' '"report": "glint view"' '"load": 1, "broken": false'
as_rendered 'the picture of glint render'
does shot home.ppm
grep -aq '^96 72' home.ppm || fail 'in its size'
other 'which is in the window' home.ppm /dev/null

# Left of the middle is the ball, which is line 10 of the scene.
does move 28 36 press 1 release 1 sleep 300
for _ in $(seq 100); do
    grep -q "scene.yaml:10:.*: sphere 'ball', material 'blue'" loads.json && break
    sleep 0.1
done
if grep -q "^scene.yaml:9:.*: material 'blue'" loads.json; then pass 'a click names the body'; else fail 'a click names the body'; fi

cp out.pfm front.pfm
does down w sleep 400 up w
written
other 'W flies' front.pfm out.pfm
cp out.pfm near.pfm
does move 60 36 press 3 move 70 37 move 85 40 release 3
written
other 'the right button turns around what was clicked' near.pfm out.pfm
cp out.pfm there.pfm
: >camera.txt
does key c sleep 500
sed -n '/^cameras:/,$p; /^camera:/,$p' loads.json >camera.txt
sed '/^cameras:/,/side:/d' scene.yaml >pasted.yaml
cat camera.txt >>pasted.yaml
expect 'C prints the camera, to paste' 0 '' '' "$glint" render pasted.yaml -o pasted.pfm
expect 'which sees the same' 0 '' '' "$glint" compare pasted.pfm there.pfm --max-rmse 0.02

does key 2
as_rendered 'another camera' --camera side
does key 1 down a sleep 200 up a key r
as_rendered 'R goes back'

# changes NAME FILE: what the window shows becomes another picture than FILE; it is in now.ppm.
changes() {
    for _ in $(seq 300); do
        does shot now.ppm
        cmp -s "$2" now.ppm || break
        sleep 0.1
    done
    other "$1" "$2" now.ppm
}
does key h sleep 300 shot last.ppm
for mode in normals depth cost error colour; do
    does key Tab
    changes "Tab shows $mode" last.ppm
    cp now.ppm last.ppm
done

sed -i 's/#1020ff/#10ff20/' scene.yaml
loaded 'a material' '"broken": false, "whole": false' '"meshes_read": 0, "images_read": 0, "trees_built": 0' '"pipelines_made": 0'
as_rendered 'its picture'

cp scene.yaml good.yaml
cp out.pfm green.pfm
does sleep 300 shot good.ppm
sed -i 's/radius: 0.9/radius: -1/' scene.yaml
loaded 'a mistake' '"broken": true'
grep -q 'scene.yaml:10:.*error' said.txt || fail 'is told with its place'
changes 'and is in the window' good.ppm
written
expect 'the picture stays' 0 '' '' "$glint" compare green.pfm out.pfm --max-rmse 0.02
mv good.yaml scene.yaml
loaded 'mended' '"broken": false' '"meshes_read": 0'

does size 120 90 sleep 300
as_rendered 'another size' --size 120x90
does hide sleep 300 show await sleep 300
written
does close
wait "$process"
got=$?
if [ $got -eq 0 ]; then pass 'closed'; else fail "closed: exit $got"; fi

begin "$glint" view scene.yaml -q --stats=json
trap 'kill "$process" "$server" 2>/dev/null' EXIT
does await
loaded 'again' '"broken": false'
does key Escape
wait "$process" || fail 'Escape ends it'
[ ! -s said.txt ] && pass 'quiet says nothing'

begin "$glint" view scene.yaml -q
does await
ends 'SIGTERM ends it' TERM 0
kill "$server"
exit $failed
