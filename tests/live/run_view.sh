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

display || fail 'no display'
trap 'kill "$server" 2>/dev/null' EXIT

# does WORD...: real events; a failure is one of the test.
does() { "$events" scene.yaml "$@" || fail "events: $*"; }

# still FILE: the window, once it has all its samples and does not change any more.
still() {
    does shot "$1"
    for _ in $(seq 600); do
        does sleep 300 shot stiller.ppm
        cmp -s "$1" stiller.ppm && return
        mv stiller.ppm "$1"
    done
    fail 'the window does not come to rest'
}

# changes NAME FILE [WORD...]: after the events, what the window shows becomes another picture than FILE; it is in now.ppm.
changes() {
    name=$1
    file=$2
    shift 2
    [ $# -eq 0 ] || does "$@"
    for _ in $(seq 600); do
        does shot now.ppm
        cmp -s "$file" now.ppm || break
        sleep 0.1
    done
    other "$name" "$file" now.ppm
}

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

# margin FILE: how many rows of a picture of the window are above its text, whose dots are the brightest of it.
margin() {
    wide=$(sed -n '2s/ .*//p' "$1")
    head=$(head -3 "$1" | wc -c)
    tail -c +$((head + 1)) "$1" | od -An -v -tu1 -w$((3 * wide)) | awk '{ for (i = 1; i <= NF; i += 3) if ($i == 240) { print NR - 1; exit } }'
}

# same_text NAME WANTED GOT
same_text() {
    if [ "$2" = "$3" ]; then pass "$1"; else fail "$1: $3, wanted $2"; fi
}

# other NAME FILE FILE
other() {
    if cmp -s "$2" "$3"; then fail "$1"; else pass "$1"; fi
}

# While it is loaded a bar grows along the lower edge: seen in part before the first picture. The machine may be done
# before anybody looks: then once more.
awk 'BEGIN { n = 150
    for (y = 0; y <= n; y++) for (x = 0; x <= n; x++) printf "v %g %g %g\n", x / n - 0.5, sin(x) / n, y / n - 0.5
    for (y = 0; y < n; y++) for (x = 1; x <= n; x++) { i = y * (n + 1) + x; printf "f %d %d %d %d\n", i, i + 1, i + n + 2, i + n + 1 } }' >meshes/sea.obj
sed 's/face.obj/sea.obj/' scene.yaml >slow.yaml
for _ in 1 2 3 4 5; do
    begin "$glint" view slow.yaml -q --size 200x150
    trap 'kill "$process" "$server" 2>/dev/null' EXIT
    "$events" slow.yaml await color 1 148 3f8fe0 bar.ppm
    seen_bar=$?
    kill "$process"
    wait "$process"
    [ $seen_bar -eq 0 ] && break
done
if [ $seen_bar -eq 0 ]; then pass 'a bar while it loads'; else fail 'a bar while it loads'; fi
# The last pixel of its row, and one in the middle of the window: the picture is not there yet.
at_pixel() { tail -c +$(($(head -3 bar.ppm | wc -c) + 1 + 3 * ($2 * 200 + $1))) bar.ppm | head -c 3 | od -An -tx1 | tr -d ' '; }
same_text 'which is not full' 181818 "$(at_pixel 199 148)"
same_text 'before there is a picture' 303030 "$(at_pixel 100 75)"

begin "$glint" view scene.yaml -o out.pfm --stats=json
trap 'kill "$process" "$server" 2>/dev/null' EXIT
does await
loaded 'a window' '"report": "glint view"' '"load": 1, "broken": false'
as_rendered 'the picture of glint render'
does shot home.ppm
points=$(margin home.ppm)
grep -aq '^96 72' home.ppm || fail 'in its size'
other 'which is in the window' home.ppm /dev/null

# Left of the middle is the ball, which is line 10 of the scene.
does move 28 36 press 1 release 1
for _ in $(seq 600); do
    grep -q "scene.yaml:10:.*: sphere 'ball', material 'blue'" loads.json && break
    sleep 0.1
done
if grep -q "^scene.yaml:9:.*: material 'blue'" loads.json; then pass 'a click names the body'; else fail 'a click names the body'; fi

cp out.pfm front.pfm
still home.ppm
changes 'W shows another place' home.ppm down w
does up w
written
other 'W flies' front.pfm out.pfm
cp out.pfm near.pfm
does move 60 36 press 3 move 70 37 move 85 40 release 3
written
other 'the right button turns around what was clicked' near.pfm out.pfm
cp out.pfm there.pfm
: >camera.txt
does key c
for _ in $(seq 600); do
    grep -q '^camera.*' loads.json && grep -q 'position' loads.json && break
    sleep 0.1
done
sed -n '/^cameras:/,$p; /^camera:/,$p' loads.json >camera.txt
sed '/^cameras:/,/side:/d' scene.yaml >pasted.yaml
cat camera.txt >>pasted.yaml
samples=$(sed -n 's/^glint: wrote out.pfm.* \([0-9]*\) samples*$/\1/p' said.txt | tail -1)
expect 'C prints the camera, to paste' 0 '' '' "$glint" render pasted.yaml -o pasted.pfm --samples "${samples:-1}"
expect 'which sees the same' 0 '' '' "$glint" compare pasted.pfm there.pfm --max-rmse 0.02

does key 2
as_rendered 'another camera' --camera side
does key 1
still front.ppm
changes 'A flies to the left' front.ppm down a
does up a key r
as_rendered 'R goes back'


# The wheel says how fast, and the text what it is.
still now.ppm
cp now.ppm slow.ppm
changes 'the wheel makes it faster' slow.ppm press 4 release 4
still now.ppm
cp now.ppm fast.ppm
changes 'and slower' fast.ppm press 5 release 5
still now.ppm
same 'as it was' slow.ppm now.ppm

cp now.ppm last.ppm
changes 'H hides the text' last.ppm key h
still last.ppm
changes 'F1 shows the keys' last.ppm key F1
cp last.ppm plain.ppm
does key F1
still last.ppm
same 'and hides them' plain.ppm last.ppm
for mode in normals depth cost error colour; do
    changes "Tab shows $mode" last.ppm key Tab
    still last.ppm
done

sed -i 's/#1020ff/#10ff20/' scene.yaml
loaded 'a material' '"broken": false, "whole": false' '"meshes_read": 0, "images_read": 0, "trees_built": 0' '"pipelines_made": 0'
as_rendered 'its picture'

cp scene.yaml good.yaml
cp out.pfm green.pfm
still good.ppm
sed -i 's/radius: 0.9/radius: -1/' scene.yaml
loaded 'a mistake' '"broken": true'
grep -q 'scene.yaml:10:.*error' said.txt || fail 'is told with its place'
changes 'and is in the window' good.ppm
written
expect 'the picture stays' 0 '' '' "$glint" compare green.pfm out.pfm --max-rmse 0.02
mv good.yaml scene.yaml
loaded 'mended' '"broken": false' '"meshes_read": 0'

still now.ppm
does size 120 90
still now.ppm
grep -aq '^120 90' now.ppm || fail 'it does not get the size'
as_rendered 'another size' --size 120x90
# Minimised it goes on to follow the files, and draws when it is back.
does hide
sed -i 's/#10ff20/#ff1020/' scene.yaml
loaded 'a change while it is minimised' '"broken": false' '"meshes_read": 0, "images_read": 0, "trees_built": 0' '"pipelines_made": 0'
does show await
as_rendered 'its picture' --size 120x90
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

# At 192 dpi a point is two pixels wide: of the window, of the text in it, and where a click goes.
"$events" none dpi 192 || fail 'another dpi'
begin "$glint" view scene.yaml -o out.pfm --stats=json
trap 'kill "$process" "$server" 2>/dev/null' EXIT
does await
loaded 'at 192 dpi' '"broken": false'
writes=0
as_rendered 'a window of twice the size' --size 192x144
still now.ppm
grep -aq '^192 144' now.ppm || fail 'which its picture fills'
pixels=$(margin now.ppm)
same_text 'text in its place' 4 "$points"
same_text 'and twice as large' 8 "$pixels"
does move 28 72 press 1 release 1 sleep 100 move 56 72 press 1 release 1
for _ in $(seq 600); do
    grep -q "scene.yaml:10:.*: sphere 'ball'" loads.json && break
    sleep 0.1
done
if grep -v '^{' loads.json | head -2 | tr '\n' ' ' | grep -q "^the background scene.yaml:10:.*: sphere 'ball'"; then
    pass 'a click is where it is seen'
else
    fail 'a click is where it is seen'
    cat loads.json
fi
ends 'SIGTERM ends it, too' TERM 0
kill "$server"
exit $failed
