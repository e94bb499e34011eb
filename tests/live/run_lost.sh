#!/bin/sh
# The device stops answering while glint follows a scene: it ends at once and says so, and leaves the last picture whole.
# Usage: run_lost.sh GLINT SOURCE_FOLDER WORK_FOLDER X_EVENTS LOSE_DEVICE FAULTS_LIBRARY
. "$(dirname -- "$0")/../cli/lib.sh"
. "$(dirname -- "$0")/live.sh"
events=$4
lose=$5
library=$6
export XDG_CACHE_HOME="$work/cache"
unset DISPLAY WAYLAND_DISPLAY
[ -f "$library" ] || {
    echo "skipped: the library of tests/faults is not built"
    exit 77
}
cat >scene.yaml <<'S'
glint: 1
image: {width: 96, height: 72}
camera: {position: [0, 0, 6], fov: 40}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}}
spheres: [{center: [0, 0, 0], radius: 0.9, material: blue}]
S
"$glint" render scene.yaml -o probe.pfm -q 2>/dev/null || {
    echo "skipped: no Vulkan device"
    exit 77
}

# ended NAME: the command ends by itself, with the status of devices, and says what happened.
ended() {
    for _ in $(seq 600); do
        kill -0 "$process" 2>/dev/null || break
        sleep 0.1
    done
    kill -9 "$process" 2>/dev/null && fail "$1: it goes on"
    wait "$process"
    got=$?
    if [ $got -eq 4 ] && grep -q 'error.*E70' said.txt; then
        pass "$1"
    else
        fail "$1: exit $got"
        cat said.txt
    fi
}

"$lose" plan
GLINT_TEST_FAULTS="$work/plan" LD_PRELOAD="$library" begin "$glint" render scene.yaml --watch -o out.pfm --stats=json
loaded 'a picture' '"load": 1, "broken": false'
cp out.pfm first.pfm
"$lose" plan now
sed -i 's/#1020ff/#10ff20/' scene.yaml
ended 'the device is lost while a scene is watched'
same 'the picture stays' first.pfm out.pfm
[ -z "$(find . -name '*.tmp*' -o -name '.out*')" ] && pass 'nothing is left beside it'

if "$glint" view scene.yaml 2>&1 | grep -q 'without GLFW'; then
    echo "skip: built without GLFW"
    exit $failed
fi
if ! command -v Xvfb >/dev/null || [ ! -x "$events" ] || ! display; then
    echo "skip: Xvfb or libxtst is not installed (xvfb, libxtst-dev, libx11-dev)"
    exit $failed
fi
"$lose" plan
GLINT_TEST_FAULTS="$work/plan" LD_PRELOAD="$library" begin "$glint" view scene.yaml --stats=json
trap 'kill "$process" "$server" 2>/dev/null' EXIT
"$events" scene.yaml await || fail 'no window'
loaded 'a window' '"load": 1, "broken": false'
"$lose" plan now
"$events" scene.yaml down w sleep 50 up w 2>/dev/null
ended 'the device is lost while one flies'
kill "$server"
trap - EXIT
exit $failed
