#!/bin/sh
# glint render --resume of many pictures: what is written is not rendered again, and nothing is lost.
# Usage: run_frames.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"

cat >scene.yaml <<'S'
glint: 1
image: {width: 96, height: 72, samples: 16}
cameras: {front: {position: [0, 0, 6]}, side: {position: [5, 1, 3], look_at: [0, 0, 0]}}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
spheres: [{center: [-0.9, 0, 0], radius: 0.9}]
trace: {precision: single}
S
if ! "$glint" render scene.yaml --size 8x8 -o probe.png -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit $failed
fi
turn='cameras.front.position=[{6*sin(frame/8)}, 0.5, {6*cos(frame/8)}]'
frames() { "$glint" render "$1" --frames "0..$2" --set "$turn" -o "$3.%02d.png" --resume; }

# Stops it when so many pictures are there.
stopped() {
    wanted=$1 signal=$2
    shift 2
    "$@" >out.txt 2>err.txt </dev/null &
    process=$!
    while kill -0 $process 2>/dev/null && [ "$(ls f.*.png 2>/dev/null | wc -l)" -lt "$wanted" ]; do :; done
    kill -"$signal" $process 2>/dev/null
    wait $process
    got=$?
}
"$glint" render scene.yaml --frames 0..59 --set "$turn" -o 'whole.%02d.png' -q
stopped 5 TERM "$glint" render scene.yaml --frames 0..59 --set "$turn" -o 'f.%02d.png' --resume
[ $got -eq 75 ] && pass 'SIGTERM leaves 75' || { fail "SIGTERM leaves 75, not $got"; cat err.txt; }
written=$(ls f.*.png | wc -l)
also 'and says what is there' '' "stopped: $written of 60 pictures are written; the same command with --resume goes on"
stat -c '%n %i' f.*.png >before.txt
rm -f f.03.png
sed 's/radius: 0.9/radius: 0.8/' scene.yaml >changed.yaml
cp scene.yaml kept.yaml
cp changed.yaml scene.yaml
expect 'another scene' 2 '' "'f.00.png.checkpoint' is of another scene than this one" frames scene.yaml 59 f
cp kept.yaml scene.yaml
expect 'another list' 2 '' 'is of other pictures, settings or another device' frames scene.yaml 58 f
expect 'going on' 0 '' "$((written - 1)) of 60 pictures are written already" frames scene.yaml 59 f
grep -v f.03.png before.txt >wanted.txt
stat -c '%n %i' $(cut -d' ' -f1 wanted.txt) | cmp -s - wanted.txt && pass 'pictures that are there stay' || fail 'pictures that are there stay'
for file in whole.*.png; do cmp -s "$file" "f${file#whole}" || fail "$file differs"; done
[ ! -e f.00.png.checkpoint ] && pass 'the checkpoint is gone' || fail 'the checkpoint is gone'

# A sweep over two scenes and all cameras; a picture that fails is the one that is left.
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n' >bad.yaml
expect 'one of three fails' 1 '' '1 of 3 pictures failed' "$glint" render scene.yaml bad.yaml changed.yaml -o 's.%s.png' --resume
expect 'and is all that is done again' 1 '' '2 of 3 pictures are written already' \
    "$glint" render scene.yaml bad.yaml changed.yaml -o 's.%s.png' --resume
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: 1}]\n' >bad.yaml
expect 'until it is right' 0 '' 'wrote s.bad.png, 1 picture' "$glint" render scene.yaml bad.yaml changed.yaml -o 's.%s.png' --resume
expect 'all cameras are a list' 0 '' 'wrote 2 pictures, c.front.png to c.side.png' "$glint" render scene.yaml --camera all -o c.png --resume
"$glint" render scene.yaml --camera side -o one.png -q
same 'with the bytes of one' c.side.png one.png
printf 'not mine\n' >c.front.png.checkpoint
expect 'something else' 2 '' 'is not a checkpoint of many pictures' "$glint" render scene.yaml --camera all -o c.png --resume
expect 'a film is whole' 2 '' 'a film is whole or not there' "$glint" render scene.yaml --frames 0..3 --set "$turn" -o f.y4m --resume
expect 'a sheet too' 2 '' 'a sheet is whole or not there' "$glint" render scene.yaml --sweep image.samples=1,2 --montage --resume
expect 'no bands of many' 2 '' 'many pictures are rendered whole' "$glint" render scene.yaml changed.yaml --bands
exit $failed
