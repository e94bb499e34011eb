#!/bin/sh
# glint render --noise and image.error: what is said, what is written, and what cannot be wished for.
# Usage: run_noise.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

scene=$source/scenes/elements/spheres.glint.yaml
if ! "$glint" render "$source/scenes/elements/minimal.glint.yaml" --size 8x8 -o probe.png -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit $failed
fi

expect 'a picture states its own error' 0 - 'standard error 0.00[0-9]* of displayed colours, at most 0.00[0-9]* .95 % sure., by [0-9.]* samples per pixel of at most 64' \
    "$glint" render "$scene" --size 64x48 --noise 0.02 --samples 64 --aov samples,error -o n.png
grep -q 'Accuracy' n.png && grep -q 'standard error' n.png && pass 'it is in the file' || fail 'it is in the file'
for name in error samples; do
    [ "$(head -c 2 n.$name.pfm)" = PF ] && pass "--aov writes n.$name.pfm" || fail "--aov writes n.$name.pfm"
done
expect 'the report has it' 0 '"mean_samples": [0-9.]*' '' \
    "$glint" render "$scene" --size 64x48 --noise 0.02 --stats=json -q -o report.png
expect 'as text too' 0 '' 'at most 1024 samples.*' "$glint" render "$scene" --size 64x48 --noise 0.02 --stats -q -o report.png
expect 'with an audit the file states both' 0 - 'traced again' \
    "$glint" render "$scene" --size 64x48 --noise 0.02 --samples 64 --audit -o audited.png
grep -aq 'standard error.*; .*traced again' audited.png && pass 'both are in the file' || fail 'both are in the file'
# The files say how they were made, which differs.
same_pixels() { "$glint" compare "$1" "$2" --max-largest 0 >/dev/null; }
"$glint" render "$scene" --size 64x48 --samples 64 --set image.error=0.02 -q -o same.png
"$glint" render "$scene" --size 64x48 --samples 64 --noise 0.02 -q -o option.png
same_pixels same.png option.png && pass 'the option is the attribute' || fail 'the option is the attribute'
LP_NUM_THREADS=1 "$glint" render "$scene" --size 64x48 --samples 64 --noise 0.02 -q -o one.png
cmp -s one.png option.png && pass 'threads change no byte' || fail 'threads change no byte'
"$glint" render "$scene" --size 64x48 --samples 16 -q -o plain.png
"$glint" render "$scene" --size 64x48 --samples 16 --set image.error=0.02 -q -o few.png
same_pixels plain.png few.png && pass 'with few samples all pixels take them' || fail 'with few samples all pixels take them'
expect 'filters are as wide as the reference has them' 0 - '0 % of the pixels are off' "$glint" render \
    "$source/scenes/elements/images.glint.yaml" --size 64x48 --noise 0.02 --samples 32 --max-off 0 -o audited.png

# What a pixel sees of a surface depends on how many samples share it: device and reference agree about those.
printf '%s\n' 'glint: 1' 'camera: {position: [0, 1, 3], look_at: [0, 0, 0]}' 'background: {color: 0.3}' \
    'lights: [{position: [2, 3, 2], radius: 1}]' \
    'rectangles: [{corner: [-200, -1, 20], edge_u: [400, 0, 0], edge_v: [0, 0, -400], material: {diffuse_color:' \
    '  {checker: {size: 1, colors: [1, 0], antialias: true}}}}]' >floor.yaml
expect 'where pixels end by their error' 0 - '^glint: 0 % of the pixels are off' "$glint" render floor.yaml \
    --size 48x36 --samples 256 --noise 0.01 --audit -o floor.png
expect 'where a time ends the picture' 0 - '^glint: 0 % of the pixels are off' "$glint" render floor.yaml \
    --size 48x36 --samples 64 --time 0.001 --audit -o floor.png

# Of a pixel that is not finite nothing is known: more glass around a ray than it can tell apart, in the middle.
{
    printf '%s\n' 'glint: 1' 'camera: {position: [0, 0, 5]}' 'lights: [{position: [2, 3, 4]}]' \
        'materials: {glass: {albedo: [0.2, 0, 0, 0.8], refractive_index: 1.1}}' 'spheres:'
    for radius in 1 0.95 0.9 0.85 0.8 0.75 0.7 0.65 0.6 0.55; do
        echo "  - {center: [0, 0, 0], radius: $radius, material: glass}"
    done
} >nested.yaml
expect 'pixels that are not finite are left out' 1 - 'standard error [0-9.]* .*, without [1-9][0-9]* that are not finite' \
    "$glint" render nested.yaml --size 24x16 --samples 64 --noise 0.02 --aov error -o nested.png
tail -c 4608 nested.error.pfm | od -An -v -tx4 | tr -s ' ' '\n' | grep -q '^[7f]fc' && pass 'their error is not a number' ||
    fail 'their error is not a number'
expect 'an aperture of any size is finite' 0 - 'standard error [0-9.e-]* of' \
    "$glint" render "$scene" --size 24x16 --samples 64 --noise 0.02 --set camera.aperture=1e18 --set camera.focus=4 -o wide.png

# An error that ends no pixel is never passed over in silence.
render() { "$glint" render "$scene" --size 64x48 -o unused.png "$@"; }
scene_says='--set image.error=0.02 --set image.samples=64'
expect 'too few samples in the scene' 0 - 'none ends before it has 16.*W429' render --set image.error=0.02
expect 'enough of them on the command line' 0 - 'standard error' render --set image.error=0.02 --samples 64
grep -q W429 err.txt && fail 'and then nothing is found' || pass 'and then nothing is found'
expect 'too few on the command line' 0 - 'image.error ends no pixel before it has 16 samples, and each takes 8' \
    render $scene_says --samples 8
expect 'the reference takes all' 0 - 'image.error ends no pixel: the reference takes all 2 samples' \
    render $scene_says --samples 2 --device reference --no-cache
expect 'its report says so' 0 '"unused_error": 0.02' '' \
    render $scene_says --samples 2 --device reference --no-cache --stats=json -q
expect 'a time says how many' 0 - 'image.error ends no pixel: --time says' render $scene_says --time 60
expect 'the option with too few' 2 - 'noise.* would have no effect: no pixel ends before it has image.min_samples' \
    render --noise 0.02 --samples 8

expect 'not with a time' 2 - 'noise.*--time.*E801' "$glint" render "$scene" --noise 0.02 --time 3 -o no.png
expect 'not with a search' 2 - 'noise.*E801' "$glint" render "$scene" --noise 0.02 --max-error flip=0.1 -o no.png
expect 'not by the reference' 2 - 'all samples of all pixels' "$glint" render "$scene" --noise 0.02 --device reference -o no.png
expect 'not more than all' 2 - 'a number from' "$glint" render "$scene" --noise 2 -o no.png
expect 'what is not known of a pixel' 2 - "does not know 'hue'" "$glint" render "$scene" --noise 0.1 --aov hue -o no.png
expect 'files beside a stream' 2 - 'name one with -o' "$glint" render "$scene" --noise 0.1 --aov error -o -
expect 'nothing to write' 2 - "only where pixels end by their error" "$glint" render "$scene" --aov error -o no.png
[ ! -e no.png ] && pass 'nothing was written' || fail 'nothing was written'
exit $failed
