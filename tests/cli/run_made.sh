#!/bin/sh
# Names that glint makes of a name: of a camera, a frame, a layer, a part, a plan, a log, an image, a schema. Where a
# repository has a link out of the folder, or what is no file, at such a name, nothing is rendered and nothing written.
# What the user typed himself may be a link.
# Usage: run_made.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
export XDG_CACHE_HOME="$work/cache"

mkdir -p home repo/sub
echo precious >home/precious
cd repo || exit 2
cat >hall.glint.yaml <<'G'
glint: 1
image: {width: 24, height: 16}
cameras: {front: {position: [0, 0, 4]}, side: {position: [4, 0, 0]}}
lights: [{position: [-5, 8, 5]}]
background: {color: [0.3, 0.5, 0.8]}
spheres: [{center: [0, 0, 0], radius: 1}]
G
cat >moves.glint.yaml <<'G'
glint: 1
image: {width: 24, height: 16}
camera: {position: [0, 0, 4]}
lights: [{position: [-5, 8, 5]}]
spheres: [{center: [0, 0, 0], radius: 1}]
G
# outside NAME: nothing there is another than it was.
outside() {
    if [ "$(cat ../home/precious)" != precious ] || [ "$(ls ../home)" != precious ]; then
        fail "$1: something outside was written: $(ls ../home)"
    fi
}
# files: all names, but those that expect itself writes.
files() { find . ! -name out.txt ! -name err.txt ! -name '.*.txt' | sort; }
# made NAME command...: is refused where NAME leads out, or is no file; then nothing is made, not even what comes
# before it. NAME is free at last, and the command is good.
made() {
    target=$1
    shift
    for kind in there nowhere pipe; do
        case $kind in
        there) ln -s "$work/home/precious" "$target" ;;
        nowhere) ln -s "$work/home/new" "$target" ;;
        pipe) mkfifo "$target" ;;
        esac
        files >../before.txt
        case $kind in pipe) why='it is not a regular file' ;; *) why='it leads out of the folder' ;; esac
        expect "$kind $target: $*" 5 - "^$target:1:1: error: is not written: $why" timeout 20 "$@"
        outside "$kind $target: $*"
        files >../after.txt
        same "$kind $target: nothing is written" ../before.txt ../after.txt
        rm "$target"
    done
    expect "free $target: $*" 0 '' - timeout 20 "$@"
    [ -f "$target" ] && pass "free $target: is a file" || fail "free $target: is not there"
    outside "free $target: $*"
    files >../after.txt
    sort ../before.txt >../b.txt
    comm -13 ../b.txt ../after.txt | while IFS= read -r path; do rm -rf "$path"; done
    rm -rf "$target"
}

device=reference
"$glint" render hall.glint.yaml --size 8x8 -o ../probe.png -q 2>../probe.txt && device=
[ -n "$device" ] && export GLINT_DEVICE=$device
made hall.png "$glint" render hall.glint.yaml -q
made out.side.png "$glint" render hall.glint.yaml -q --camera all -o out.png
made sub/out.front.png "$glint" render hall.glint.yaml -q --camera all -o sub/out.png -o other.png
made out.depth.pfm "$glint" render hall.glint.yaml -q --aov depth -o out.png
made out.names.json "$glint" render hall.glint.yaml -q --aov object -o out.exr
made out.side.names.json "$glint" render hall.glint.yaml -q --aov object --camera all -o out.exr
if [ -z "$device" ]; then
    made f0002.png "$glint" render moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' -o f%04d.png
    made sub/f2.png "$glint" render moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' -o sub/f%d.png
    made v0.5.png "$glint" render hall.glint.yaml -q --sweep spheres[0].radius=0.5,1 -o v%v.png
    made sheet.png "$glint" render moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' --montage
    made moves.png "$glint" render hall.glint.yaml moves.glint.yaml -q
    for camera in front side; do
        made out.$camera.png "$glint" render hall.glint.yaml -q --camera all --sweep spheres[0].radius=1 -o out.png
    done
    # A folder of a pattern leads out as well as a file.
    ln -s ../home two2
    expect 'a folder of a frame' 5 - 'error: is not written: it leads out' \
        "$glint" render moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' -o 'two%d/precious.png'
    outside 'a folder of a frame'
    rm two2
    ln -s ../home/precious out.partial.png
    expect 'partial' 5 - 'out.partial.png:1:1: error: is not written' \
        "$glint" render hall.glint.yaml -q --bands --partial -o out.png
    outside 'partial'
    rm out.partial.png
    for kind in precious new; do
        ln -s ../home/$kind out.png.bands
        expect "a checkpoint takes the place of a link: $kind" 0 - - "$glint" render hall.glint.yaml -q --bands -o out.png
        outside "a checkpoint: $kind"
        rm -f out.png.bands out.png
    done
    for i in 1 2; do "$glint" render moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' --tile $i/2 -o "t%d.$i.part"; done
    made m1.png "$glint" merge -q --frames 0..2 m%d.png t%d.1.part t%d.2.part
    ln -s ../home/new hall.2.part
    expect 'a part of a farm' 5 - 'hall.2.part:1:1: error: is not written: it leads out' \
        "$glint" farm parallel hall.glint.yaml -q --tiles 2 -o hall.png
    rm hall.2.part
else
    echo "skip many pictures: no Vulkan device"
fi

# A farm's folder.
for entry in farm.plan job.sh log; do
    mkdir -p jobs
    ln -s "$work/home/new" "jobs/$entry"
    expect "a farm: $entry" 5 - "jobs/$entry:1:1: error: is not written: it leads out" \
        "$glint" farm slurm moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' --chunk 1 -o f%d.png --folder jobs
    outside "a farm: $entry"
    [ "$(ls jobs)" = "$entry" ] && pass "a farm: $entry: nothing is written" || fail "a farm: $entry: $(ls jobs)"
    ln -sf "$work/home/precious" "jobs/$entry"
    expect "a farm, by force: $entry" 5 - "jobs/$entry:1:1: error: is not written: it" \
        "$glint" farm slurm moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' --chunk 1 -o f%d.png --folder jobs --force
    outside "a farm, by force: $entry"
    rm -r jobs
done
mkdir -p jobs/log
ln -s "$work/home/precious" jobs/log/2.jsonl
expect "a task's log" 5 - 'jobs/log/2.jsonl:1:1: error: is not written' \
    "$glint" farm slurm moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' --chunk 1 -o f%d.png --folder jobs
rm jobs/log/2.jsonl
expect "a farm whose folder has logs" 0 '' - \
    "$glint" farm slurm moves.glint.yaml -q --frames 0..2 --set 'camera.position=[0,0,{4+frame}]' --chunk 1 -o f%d.png --folder jobs
rm -r jobs

# The schema beside a scene.
made glint.schema.json "$glint" schema install hall.glint.yaml

# What was typed may lead anywhere, and a link within the folder stays one.
ln -s ../home/typed.png typed.png
expect 'what was typed' 0 - - "$glint" render hall.glint.yaml -q -o typed.png
[ -f ../home/typed.png ] && [ -L typed.png ] && pass 'is written where it leads' || fail 'the typed link is not followed'
expect 'also as one word' 0 - - "$glint" render hall.glint.yaml -q --output=typed.png
expect 'and as a letter' 0 - - "$glint" render hall.glint.yaml -q -otyped.png
rm ../home/typed.png typed.png
echo old >sub/kept.png
ln -s sub/kept.png out.front.png
expect 'a link within' 0 - - "$glint" render hall.glint.yaml -q --camera all -o out.png
[ -L out.front.png ] && [ "$(head -c 4 sub/kept.png | tail -c 3)" = PNG ] && pass 'is written at its end' || fail 'the link within is not followed'
rm out.front.png
ln -s ../home away
expect 'a folder that was typed' 0 - - "$glint" render hall.glint.yaml -q --camera all -o away/out.png
[ -f ../home/out.front.png ] && pass 'is where it leads' || fail 'the folder that was typed is not followed'
rm -f ../home/out.*.png away
[ -z "$(find .. -name '.glint-*.tmp')" ] && pass 'nothing is left behind' || fail 'a temporary file is left'
exit "$failed"
