#!/bin/sh
# glint render in parts, and glint merge: parts make the bytes of the whole picture, and nothing else is a picture.
# Usage: run_parts.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

scene=$source/scenes/elements/spheres.glint.yaml
if ! "$glint" render "$source/scenes/elements/minimal.glint.yaml" --size 8x8 -o probe.png -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit $failed
fi
picture='--size 93x61 --samples 3'
render() { "$glint" render "$scene" $picture -q "$@"; }
# crop FILE X Y W H: of the PFM of 93x61 pixels, on standard output.
crop() {
    printf 'PF\n%d %d\n-1.0\n' "$4" "$5"
    y=$5
    while [ $((y -= 1)) -ge 0 ]; do
        tail -c $(((($3 + y + 1) * 93 - $2) * 12)) "$1" | head -c $(($4 * 12))
    done
}

render -o whole.png -o whole.pfm -o whole.exr
render --region 5,7,40,33 -o region.pfm
crop whole.pfm 5 7 40 33 >crop.pfm
same 'a region has the pixels of the whole' region.pfm crop.pfm
for i in 1 2 3; do render --tile $i/3 -o tile$i.part -o tile$i.png; done
for ending in png pfm exr; do
    ok "tiles make a picture, .$ending" "$glint" merge merged.$ending tile3.part tile1.part tile2.part
    same "of the same bytes, .$ending" merged.$ending whole.$ending
done
render --samples-to 1 -o s0.part
render --samples-from 1 --tile 1/2 -o s1.part
render --samples-from 1 --tile 2/2 -o s2.part
expect 'samples of different regions' 2 - 'samples 0 to 1 of the region 0,0,93,32 are missing' "$glint" merge no.png s0.part s1.part s2.part
render --samples-to 1 --tile 1/2 -o s3.part
render --samples-to 1 --tile 2/2 -o s4.part
ok 'samples make a picture' "$glint" merge samples.pfm s1.part s2.part s3.part s4.part
same 'of the same bytes' samples.pfm whole.pfm
head -c 20 tile1.part | grep -q '^glint part 1$' && pass 'a part says what it is' || fail 'a part says what it is'

# What light, lens and filter take from a pixel's place, and a tone.
other=$source/scenes/elements/soft_lights.glint.yaml
set -- --size 64x48 --samples 2 --set camera.aperture=0.1 --set camera.focus=4 --set image.tone=normalize -q
"$glint" render "$other" "$@" -o soft.png
"$glint" render "$other" "$@" --region 0,0,30,48 -o left.part
"$glint" render "$other" "$@" --region 30,0,34,48 -o right.part
ok 'soft light, a lens and a tone' "$glint" merge merged.png left.part right.part
same 'make the same bytes' merged.png soft.png
expect 'a tone is of each pixel' 0 - - "$glint" render "$other" "$@" --region 0,0,8,8 -o corner.png

expect 'a part is missing' 2 - 'the parts make no picture: no part has the pixel 0,16' "$glint" merge no.png tile1.part tile3.part
expect 'samples are missing' 2 - 'samples 0 to 1 of the region 0,0,93,32 are missing' "$glint" merge no.png s1.part s2.part s4.part
expect 'a part is there twice' 2 - "'tile1.part' has pixels and samples that are also in 'tile1.part'" \
    "$glint" merge no.png tile1.part tile2.part tile1.part tile3.part
"$glint" render "$other" $picture -q --tile 2/3 -o other.part
expect 'of another scene' 2 - "'other.part' is of another scene than 'tile1.part'" "$glint" merge no.png tile1.part other.part tile3.part
"$glint" render "$scene" --size 93x61 --samples 2 -q --tile 2/3 -o other.part
expect 'with other samples' 2 - 'is of a picture with other samples than' "$glint" merge no.png tile1.part other.part tile3.part
render --set trace.max_depth=2 --tile 2/3 -o other.part
expect 'with another depth' 2 - 'is of another scene than' "$glint" merge no.png tile1.part other.part tile3.part
head -c 9000 tile2.part >cut.part
expect 'cut off' 3 - 'cut.part:1:1: error: the file is damaged' "$glint" merge no.png tile1.part cut.part tile3.part
{ head -c 9000 tile2.part && printf x && tail -c +9002 tile2.part; } >changed.part
expect 'changed' 3 - 'the file is damaged' "$glint" merge no.png tile1.part changed.part tile3.part
expect 'no part at all' 3 - 'is not a part of a picture' "$glint" merge no.png "$scene"
expect 'not there' 3 - 'cannot be read' "$glint" merge no.png none.part
expect 'not into a part' 2 - 'a picture is written first' "$glint" merge no.part tile1.part tile2.part tile3.part

expect 'more tiles than rows' 2 - 'at most 8 parts' "$glint" render "$scene" $picture --tile 1/9 -o no.png
expect 'a tile after the last' 2 - 'part I of N' "$glint" render "$scene" --tile 3/2 -o no.png
expect 'a region outside' 2 - 'the region ends at 94,8' "$glint" render "$scene" $picture --region 90,0,4,8 -o no.png
expect 'no region' 2 - 'X,Y,W,H' "$glint" render "$scene" --region 1,2,0,4 -o no.png
expect 'two kinds of region' 2 - 'both say which pixels' "$glint" render "$scene" --region 1,2,3,4 --tile 1/2 -o no.png
expect 'samples that are not there' 2 - 'samples 1 to 9' "$glint" render "$scene" $picture --samples-from 1 --samples-to 9 -o no.part
expect 'samples as a picture' 2 - 'some of the samples make no picture' "$glint" render "$scene" $picture --samples-to 2 -o no.png
expect 'pixels that end by their error' 2 - 'not rendered in parts' "$glint" render "$scene" --noise 0.1 --tile 1/2 -o no.png
expect 'some samples of many pictures' 2 - 'many pictures have all their samples' "$glint" render "$scene" --samples-to 1 --frames 0..0 -o no%d.part
expect 'not by the reference' 2 - 'choose a device' "$glint" render "$scene" --tile 1/2 --device reference -o no.png
expect 'not with an audit' 2 - 'about a whole picture' "$glint" render "$scene" --tile 1/2 --audit -o no.png
expect 'nor with a time' 2 - 'where a time ends a picture' "$glint" render "$scene" --tile 1/2 --time 1 -o no.png
expect 'statistics of a part' 0 '"height": 16' '' "$glint" render "$scene" $picture --tile 1/3 --stats=json -q -o region.png
[ ! -e no.png ] && [ ! -e no.part ] && pass 'nothing was written' || fail 'nothing was written'
exit $failed
