#!/bin/sh
# glint render --bands, --resume and --partial: the bytes of the picture that is rendered whole, in the memory of a
# band, from as many processes as it takes.
# Usage: run_bands.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"

scene=$source/scenes/elements/spheres.glint.yaml
if ! "$glint" render "$source/scenes/elements/minimal.glint.yaml" --size 8x8 -o probe.png -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit $failed
fi
single='--set trace.precision=single' # no trial
picture="--size 203x131 --samples 3 $single"
render() { "$glint" render "$scene" $picture -q "$@"; }

# ---- the same bytes

render -o whole.png -o whole.pfm -o whole.exr -o whole.hdr -o whole.jpg
ok 'in bands' render --bands=20 -o bands.png -o bands.pfm -o bands.exr -o bands.hdr
for ending in png pfm exr hdr; do
    same "of the same bytes, .$ending" bands.$ending whole.$ending
done
ok 'in bands of one row of tiles' render --bands=1 -o bands.png
same 'of the same bytes' bands.png whole.png
ok 'in one band' render --bands -o bands.png -o bands.jpg
same 'of the same bytes, .png beside .jpg' bands.png whole.png
same 'and .jpg' bands.jpg whole.jpg
render --region 13,9,150,80 -o whole.png
ok 'a region' render --region 13,9,150,80 --bands=16 -o bands.png
same 'of the same bytes' bands.png whole.png
for i in 1 2 3; do
    ok "tile $i as a part" render --tile $i/3 --bands=8 -o tile$i.part
    render --tile $i/3 -o whole.part
    same 'of the same bytes' tile$i.part whole.part
done
"$glint" merge -q merged.pfm tile3.part tile1.part tile2.part
same 'and merged' merged.pfm whole.pfm
other=$source/scenes/elements/soft_lights.glint.yaml
set -- --size 64x48 --samples 4 $single --set camera.aperture=0.1 --set camera.focus=4 --set image.tone=normalize -q
"$glint" render "$other" "$@" -o soft.png
ok 'soft light, a lens and a tone' "$glint" render "$other" "$@" --bands=8 -o bands.png
same 'of the same bytes' bands.png soft.png
cat >faulty.yaml <<'END'
glint: 1
lights: [{position: [-5, 8, 5]}]
cameras: {front: {position: [0, 0, 6]}}
materials: {m: {albedo: [0.1, 0, 0.9, 0]}}
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: m}, {center: [0.95, 0, 0], radius: 0.9, material: m}]
trace: {precision: single, max_depth: 60}
END
set -- --size 120x90 --samples 2 --limit path-segments=6 -q
expect 'faulty pixels' 1 - '[0-9]+ pixels needed more rays than the limit' "$glint" render faulty.yaml "$@" -o whole.png
cp err.txt whole.txt
expect 'in bands' 1 - '' "$glint" render faulty.yaml "$@" --bands=8 -o bands.png
same 'are told in the same words' err.txt whole.txt
same 'and are the same' bands.png whole.png
printf 'glint: 1\ntrace: {precision: single}\ncameras: {a: {position: [0, 0, 5]}, b: {position: [1, 0, 5]}}\nspheres: [{center: [0, 0, 0], radius: 1}]\n' >two.yaml
"$glint" render two.yaml --size 40x30 --camera all -q -o two.png
ok 'all cameras' "$glint" render two.yaml --size 40x30 --camera all --bands=8 -q -o both.png
same 'of the same bytes, a' both.a.png two.a.png
same 'and b' both.b.png two.b.png
[ -z "$(ls ./*.checkpoint ./.glint-* 2>/dev/null)" ] && pass 'no checkpoint is left' || fail 'no checkpoint is left'

# ---- on several devices: the same one twice
render -o whole.png
expect 'two devices' 0 '' 'bands on 2 devices' "$glint" render "$scene" $picture --bands=8 --device 0,0 -o bands.png
same 'make the same bytes' bands.png whole.png
expect 'three, of which one has nothing to do' 0 '' '' "$glint" render "$scene" $picture --bands=80 --device 0,0,0 -o bands.png -q
same 'make the same bytes' bands.png whole.png
expect 'all that are equal' 0 '' 'bands on [0-9]+ device' "$glint" render "$scene" $picture --device all -o bands.png
same 'make the same bytes' bands.png whole.png
expect 'one that is not there' 4 - "no Vulkan device matches '77'" render --device 0,77 -o no.png
[ ! -e no.png.checkpoint ] && pass 'leaves no checkpoint' || fail 'leaves no checkpoint'
expect 'not by other commands' 4 - "no Vulkan device matches 'all'" "$glint" pick "$scene" 1,1 --device all
expect 'and not for many pictures' 4 - "matches 'all'" "$glint" render "$scene" "$scene" -o 'no.%d.png' --device all

# ---- the memory of a band

cat >large.yaml <<'END'
glint: 1
cameras: {a: {position: [0, 0, 5]}}
spheres: [{center: [0, 0, 0], radius: 1}]
trace: {precision: single}
END
peak() { sed -n 's/.*"peak_memory_bytes": *\([0-9]*\).*/\1/p' "$1"; }
"$glint" render large.yaml --size 4096x2048 -q -o whole.png
"$glint" render large.yaml --size 4096x2048 -q --stats=json -o bands.png --bands=64 >bands.json
same '8 megapixels' bands.png whole.png
"$glint" render large.yaml --size 64x48 -q --stats=json -o small.png --bands >small.json
more=$(($(peak bands.json) - $(peak small.json)))
# The picture has 101 MB of floats, of which a band has 3; what a file of rows is made in has 40.
[ "$more" -lt 60000000 ] && pass "in $more bytes more than a small one" || fail "in $more bytes more than a small one"

# ---- more than 8 megapixels

# A whole picture of 4096 x 4096 takes 300 MB more than a small one, as that of a JPEG file does.
(ulimit -d 350000 && exec env LP_NUM_THREADS=2 "$glint" render large.yaml --size 4096x4096 -q -o spared.png) &&
    pass '16 megapixels in 350 MB' || fail '16 megapixels in 350 MB'
(ulimit -d 350000 && exec env LP_NUM_THREADS=2 "$glint" render large.yaml --size 4096x4096 -q -o spared.jpg) 2>/dev/null &&
    fail 'a JPEG file is made of all pixels' || pass 'a JPEG file is made of all pixels'
"$glint" render large.yaml --size 4096x4096 -q -o spared.pfm
"$glint" render large.yaml --size 4096x4096 -q --repeat 1 -o at_once.pfm 2>/dev/null
same 'the bytes of the whole picture' spared.pfm at_once.pfm
rm -f spared.* at_once.pfm

# ---- more than 64 megapixels

huge='--size 16384x16384'
expect 'a corner of a huge picture' 0 - - "$glint" render large.yaml $huge --region 9000,8000,40,30 -q -o corner.png
expect 'a part of it' 0 - - "$glint" render large.yaml $huge --tile 1000/2048 -q -o tile.part
"$glint" render large.yaml $huge --bands=8 -q -o huge.png 2>stopped.txt &
process=$!
while kill -0 $process 2>/dev/null && [ ! -e huge.png.checkpoint ]; do sleep 0.05; done
kill -TERM $process
wait $process
got=$?
[ $got -eq 75 ] && grep -q 'of 2048 bands are in huge.png.checkpoint' stopped.txt && pass 'a huge picture is rendered in bands' ||
    fail "a huge picture is rendered in bands: exit $got"
rm -f huge.png.checkpoint
expect 'not as JPEG' 2 - "'huge.jpg' is of a format whose file is made of all pixels at once" "$glint" render large.yaml $huge -o huge.jpg
also 'with a remedy' - 'write .png, .exr, .pfm or .hdr'
expect 'nor to standard output' 2 - 'name one with -o' "$glint" render large.yaml $huge -o -
expect 'nor with an audit' 2 - 'rendered in bands: an audit is about a whole picture' "$glint" render large.yaml $huge --audit -o no.png
expect 'nor with errors' 1 - 'at most 67108864 can be held at once \[E408\]' \
    "$glint" render large.yaml $huge --samples 64 --noise 0.1 -o no.png
expect 'nor by the reference' 1 - 'E408' "$glint" render large.yaml $huge --device reference -o no.png
expect 'nor as one of many' 1 - 'E408' "$glint" render large.yaml $huge --sweep trace.max_depth=1,2 -o no%d.png
expect 'nor picked from' 1 - 'E408' "$glint" pick large.yaml $huge 1,1
printf 'glint: 1\nimage: {width: 16384, height: 16384}\nspheres: [{center: [0, 0, 0], radius: 1}]\n' >huge.yaml
expect 'it is no mistake of a scene' 0 '' '' "$glint" check huge.yaml

# ---- what does not go together

expect 'no audit in bands' 2 - 'not possible in bands: an audit' render --bands --audit -o no.png
expect 'no reference' 2 - 'choose a device' render --bands --device reference -o no.png
expect 'no time' 2 - "leave '--time' out" render --resume --time 1 -o no.png
expect 'no error' 2 - "leave '--noise' out" render --resume --noise 0.1 -o no.png
expect 'nor by the scene' 2 - 'not rendered in bands' "$glint" render "$scene" --size 99x9 --samples 64 --set image.error=0.1 --bands -o no.png
expect 'no other image' 2 - "leave it out" render --bands --aov depth -o no.exr
expect 'no samples' 2 - 'take a smaller --region' render --bands --samples-to 1 -o no.part
expect 'no standard output' 2 - 'the checkpoint lies beside' render --bands -o -
expect 'no rows' 2 - 'bands' render --bands=0 -o no.png
expect 'a folder that is not there' 3 - 'cannot be written' render --bands -o none/no.png

# ---- stop and go on

# stopped NAME SIGNAL BANDS COMMAND...: ends it once so many of 17 bands are there.
stopped() {
    name=$1 signal=$2 least=$3
    shift 3
    "$@" >out.txt 2>err.txt </dev/null &
    process=$!
    # A band has 203 * 8 pixels of 12 bytes, and 64 of its own.
    while kill -0 $process 2>/dev/null && [ "$(stat -c %s went.png.checkpoint 2>/dev/null || echo 0)" -lt $((8192 + least * 19552)) ]; do
        sleep 0.02
    done
    kill -"$signal" $process 2>/dev/null
    wait $process
    got=$?
}
long="--size 203x131 --samples 150 $single"
"$glint" render "$scene" $long -q -o whole.png -o whole.exr
stopped 'a signal' TERM 3 "$glint" render "$scene" $long --bands=8 --partial -o went.png -o went.exr
[ $got -eq 75 ] && pass 'SIGTERM leaves 75' || { fail "SIGTERM leaves 75, not $got"; cat err.txt; }
also 'and says so' - 'stopped: [0-9]+ of 17 bands are in went.png.checkpoint; the same command with --resume goes on'
[ ! -e went.png ] && [ ! -e went.exr ] && pass 'no picture' || fail 'no picture'
[ -e went.partial.png ] && [ -e went.partial.exr ] && pass 'but a part of one' || fail 'but a part of one'
cp went.png.checkpoint kept.checkpoint
expect 'a checkpoint is not overwritten' 2 - "'went.png.checkpoint' is there" "$glint" render "$scene" $long --bands -o went.png
expect 'another scene' 2 - 'is of another scene than this one' "$glint" render "$other" $long --resume -o went.png
expect 'another size' 2 - 'of another size than this one' "$glint" render "$scene" --size 203x132 --samples 150 $single --resume -o went.png
expect 'other samples' 2 - 'with other samples than this one' "$glint" render "$scene" --size 203x131 $single --resume -o went.png
expect 'other settings' 2 - 'than this one' "$glint" render "$scene" $long --limit path-segments=99 --resume -o went.png
expect 'another part' 2 - 'of another part of the picture than this one' "$glint" render "$scene" $long --tile 1/2 --resume -o went.png
also 'with a remedy' - 'remove it to begin anew'
same 'a checkpoint that is refused stays' went.png.checkpoint kept.checkpoint
stopped 'going on' KILL 9 "$glint" render "$scene" $long --resume --device 0,0 -o went.png -o went.exr
also 'what is there is not rendered again' - '[0-9]+ of 17 bands are in went.png.checkpoint already'
expect 'going on to the end' 0 '' '' "$glint" render "$scene" $long --resume -o went.png -o went.exr --stats=json
also 'after kill -9' '' '([89]|1[0-7]) of 17 bands are in went.png.checkpoint already'
bands=$(sed -n 's/.*"bands": *\([0-9]*\).*/\1/p' out.txt)
had=$(sed -n 's/^glint: \([0-9]*\) of 17 .*/\1/p' err.txt)
[ $((bands + had)) -eq 17 ] && pass "$bands bands were rendered, $had were there" || fail "$bands bands were rendered, $had were there"
same 'the bytes of one run, .png' went.png whole.png
same 'and .exr' went.exr whole.exr
[ ! -e went.png.checkpoint ] && pass 'the checkpoint is gone' || fail 'the checkpoint is gone'
printf 'hello\n' >went.png.checkpoint
expect 'something else' 2 - 'is not a checkpoint' "$glint" render "$scene" $long --resume -o went.png
rm -f went.png.checkpoint
ok 'nothing to go on from' render --resume -o went.png
render -o whole.png
same 'is a picture from the beginning' went.png whole.png
exit $failed
