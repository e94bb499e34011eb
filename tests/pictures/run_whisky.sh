#!/bin/sh
# The original's glass, whisky and ice, with what a ray is inside and without. Usage, as cli/lib.sh has it:
# run_whisky.sh GLINT SOURCE_FOLDER WORK_FOLDER ALONE. Skipped where the original's meshes are not.
. "$(dirname -- "$0")/../cli/lib.sh"
alone=$4
seed=${GLINT_ASSETS:-$source/../shared/assets}/seed
if [ ! -f "$seed/water.obj" ]; then
    echo "skipped: tests/scenes/whisky.glint.yaml, whose meshes are not in $seed"
    exit 77
fi
scene=$source/tests/scenes/whisky.glint.yaml
set -- --asset-path "$seed"

expect "the scene has no findings" 0 - - "$glint" check "$scene" "$@"
sed 's/, priority: [0-9]//' "$scene" >plain.yaml
expect "without priorities the whisky crosses glass and ice" 0 '' "model 'whisky' crosses model 'glass'" "$glint" check plain.yaml "$@"
also "and the ice the whisky" '' "model 'ice' crosses model 'whisky'"
# The models in another order.
{ grep -v -- '- {name: \(glass\|whisky\)' "$scene" && grep -- '- {name: whisky' "$scene" && grep -- '- {name: glass' "$scene"; } >turned.yaml

set -- "$@" --size 160x160 --samples 1 -q
expect "with what rays are inside" 0 '' '' "$glint" render "$scene" "$@" --device reference --as-file --no-cache -o with.pfm
expect "the order of the models does not show" 0 '' '' "$glint" render turned.yaml "$@" --device reference --as-file --no-cache -o turned.pfm
expect "byte for byte" 0 '' '' cmp with.pfm turned.pfm
sed 's/width: 320, height: 320, samples: 4/width: 160, height: 160, samples: 1/' "$scene" >small.yaml
expect "each body alone in air" 0 '' '' "$alone" small.yaml without.pfm "$seed"
expect "another picture" 1 '' '' "$glint" compare without.pfm with.pfm --max-share 0.25
if "$glint" devices | grep -q .; then
    expect "on a device" 0 '' '' "$glint" render "$scene" "$@" -o device.pfm
    expect "the same" 0 '' '' "$glint" compare device.pfm with.pfm --max-share 0.002
fi
exit $failed
