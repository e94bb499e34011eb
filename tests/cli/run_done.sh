#!/bin/sh
# --skip-done, --frames with --tile, glint merge --frames: what is there is not rendered again, what is damaged or of
# another scene, size or device is; frames made of tiles have the bytes of whole ones.
# Usage: run_done.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
export XDG_CACHE_HOME="$work/cache"
cat >scene.yaml <<'S'
glint: 1
image: {width: 40, height: 48}
cameras: {front: {position: [0, 0, 6]}, side: {position: [5, 1, 3], look_at: [0, 0, 0]}}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}}
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: blue}]
S
turn='cameras.front.position=[{6*sin(360*frame/8)}, 0.5, {6*cos(360*frame/8)}]'

# ---- what does not go together
expect 'an audit' 2 - "'--audit' needs a picture that is rendered now" "$glint" render scene.yaml --skip-done --audit -o a.png
expect 'a format that says nothing' 2 - 'does not say how it was made' "$glint" render scene.yaml --skip-done -o a.pfm
expect 'standard output' 2 - 'is gone' "$glint" render scene.yaml --skip-done -o -
expect 'a region as a picture' 2 - 'only as a file that ends in .part' "$glint" render scene.yaml --skip-done --tile 1/2 -o a.png
expect 'a film' 2 - "'--skip-done' would have no effect" "$glint" render scene.yaml --skip-done --frames 0..1 --set "$turn" -o a.y4m
expect 'a film of tiles' 2 - "'--tile' would have no effect" "$glint" render scene.yaml --tile 1/2 --frames 0..1 --set "$turn" -o a.y4m
expect 'frames of one name' 2 - 'the same file in all frames' "$glint" merge --frames 0..1 o.png '%d.part'
expect 'an unknown word' 2 - 'no word that is known' "$glint" merge --frames 0..1 'o.%x.png' '%d.part'
expect 'no part' 1 - 'failed: o.0.png' "$glint" merge --frames 0..1 'o.%d.png' '%d.part'

if ! "$glint" render scene.yaml -o probe.pfm -q 2>/dev/null; then
    [ $failed -eq 0 ] || exit 1
    echo "skip: no Vulkan device: only what is refused"
    exit 77
fi

# again NAME PATTERN command...: the command with --skip-done says PATTERN; what it leaves is what it writes without.
again() {
    name=$1 pattern=$2
    shift 2
    expect "$name" 0 '' "$pattern" "$@" --skip-done
}

# ---- one picture
"$glint" render scene.yaml -o a.png -o a.exr -q && cp a.png kept.png
touch -d 2001-01-01 a.png
again 'done' 'a.png is done already' "$glint" render scene.yaml -o a.png -o a.exr
[ "$(date -r a.png +%Y)" = 2001 ] && pass 'it was not written' || fail 'it was written again'
mkdir -p elsewhere && cp scene.yaml elsewhere/other.yaml
again 'the scene elsewhere' 'a.png is done already' "$glint" render elsewhere/other.yaml -o a.png
again 'one of two outputs' 'wrote b.png' "$glint" render scene.yaml -o a.png -o b.png
head -c $(($(wc -c <a.png) / 2)) kept.png >a.png
again 'half a file' 'wrote a.png' "$glint" render scene.yaml -o a.png
cmp -s a.png kept.png && pass 'the same bytes' || fail 'other bytes'
again 'another size' 'wrote a.png' "$glint" render scene.yaml -o a.png --size 41x48
again 'other samples' 'wrote a.png' "$glint" render scene.yaml -o a.png --samples 2
again 'another setting' 'wrote a.png' "$glint" render scene.yaml -o a.png --set materials.blue.diffuse_color="#ff0000"
again 'other bits' 'wrote a.png' "$glint" render scene.yaml -o a.png --depth 16
again 'another tracer' 'wrote a.png' "$glint" render scene.yaml -o a.png --device reference
again 'the same tracer' 'a.png is done already' "$glint" render scene.yaml -o a.png --device reference
again 'precision that is named' 'wrote a.png' "$glint" render scene.yaml -o a.png --set trace.precision=double
again 'the same one' 'a.png is done already' "$glint" render scene.yaml -o a.png --set trace.precision=double
"$glint" render scene.yaml --camera all -o c.png -q && rm c.side.png
again 'the camera that is missing' 'wrote c.side.png' "$glint" render scene.yaml --camera all -o c.png
also 'and not the other' '' 'c.front.png is done already'

# ---- parts
"$glint" render scene.yaml --tile 2/3 -o t.part -q && cp t.part kept.part
again 'a part' 't.part is done already' "$glint" render scene.yaml --tile 2/3 -o t.part
again 'another part' 'wrote t.part' "$glint" render scene.yaml --tile 1/3 -o t.part
{ head -c 2000 kept.part; printf x; tail -c +2002 kept.part; } >t.part
again 'a damaged part' 'wrote t.part' "$glint" render scene.yaml --tile 2/3 -o t.part
cmp -s t.part kept.part && pass 'the same part' || fail 'another part'

# ---- frames of tiles
"$glint" render scene.yaml --frames 0..3 --set "$turn" -o 'w.%04d.png' -q
for tile in 1 2 3; do
    "$glint" render scene.yaml --frames 0..3 --set "$turn" --tile $tile/3 -o "f.%04d.$tile.part" -q
done
"$glint" render scene.yaml --set "cameras.front.position=[0, 0.5, 6]" --tile 2/3 -o one.part -q
cmp -s one.part f.0000.2.part || {
    # The command that each names is its own; all else is the same.
    sed 's/^record.*//' one.part >one.rest && sed 's/^record.*//' f.0000.2.part >f.rest
    [ "$(wc -c <one.rest)" = "$(wc -c <f.rest)" ] || fail 'a tile of a frame is not the tile by itself'
}
"$glint" merge --frames 0..3 'm.%04d.png' 'f.%04d.2.part' 'f.%04d.3.part' 'f.%04d.1.part' -q
for frame in 0000 0001 0002 0003; do
    cmp -s w.$frame.png m.$frame.png && pass "frame $frame of tiles" || fail "frame $frame of tiles is not the whole one"
done
rm f.0002.1.part
again 'a missing tile' '3 of 4 pictures are done already' "$glint" render scene.yaml --frames 0..3 --set "$turn" --tile 1/3 -o 'f.%04d.1.part'
also 'and only that' '' 'wrote 1 of 4 pictures'
rm m.0001.png f.0003.2.part
expect 'a frame that lacks a part' 1 - 'f.0003.2.part:1:1: error: the file cannot be read' \
    "$glint" merge --frames 0..3 'm.%04d.png' 'f.%04d.2.part' 'f.%04d.3.part' 'f.%04d.1.part' --skip-done
also 'the others are joined' '' 'wrote m.0001.png'
also 'or there' '' 'm.0002.png is done already'
expect 'a part twice' 1 - "1:52: error: 'f.0000.2.part' has pixels" \
    "$glint" merge --frames 0..1 'x.%04d.png' 'f.%04d.2.part' 'f.%04d.2.part'

# ---- sweeps, lists and cameras
again 'a sweep' 'wrote 3 pictures' "$glint" render scene.yaml --sweep image.samples=1,2,3 -o 's.%v.png'
again 'a longer one' '3 of 4 pictures are done already' "$glint" render scene.yaml --sweep image.samples=1,2,3,4 -o 's.%v.png'
cp scene.yaml two.yaml && printf 'scene.yaml\ntwo.yaml\n' >list.txt
"$glint" render --list list.txt --camera all -o '%s.%c.png' -q && rm two.side.png scene.front.png
again 'cameras of a list' '2 of 4 pictures are done already' "$glint" render --list list.txt --camera all -o '%s.%c.png'
again 'all of them' '4 of 4 pictures are done already' "$glint" render --list list.txt --camera all -o '%s.%c.png'
exit $failed
