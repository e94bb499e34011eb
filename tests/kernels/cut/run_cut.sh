#!/bin/sh
# What a scene does not ask for costs nothing: for each feature the kernel made of GLSL without the feature's statements
# is, once pruned, the same to the byte as the one that ships, pruned with the feature switched off. So nothing of the
# feature is left there, be it a type or the order of two constants. What is in all kernels in the GLSL itself, such as a
# field of a struct, this does not see.
# Usage: run_cut.sh SHADERS FOLDER GLSLANG SPIRV_VAL SPIRV_EXACT SAME_KERNEL, the folder being emptied
set -eu
shaders=$1 work=$2 glslang=$3 validate=$4 exact=$5 same=$6
failures=0 gone=0 number=0
"${0%/*}/../../../tools/emptied" "$work"
cp -r "$shaders" "$work/cut"
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
cd "$shaders"
files=$(find . -name '*.glsl' -o -name trace.comp)
for feature in $(sed -n 's/^ *ROW(\([A-Z_]*\),.*/\1/p' features.h); do
    name=HAS_$feature
    grep -q "^const bool $name = " scene.glsl || name=$feature
    # shellcheck disable=SC2086 # a list
    lines=$(awk -v name="$name" -v out="$work/cut" -f "$here/cut.awk" $files)
    "$glslang" --quiet -g0 --target-env vulkan1.1 -S comp -I"$work/cut" -o "$work/plain.spv" "$work/cut/trace.comp"
    "$exact" "$work/plain.spv" "$work/cut.spv"
    "$same" "$work/cut.spv" "$number" "$work/pruned.spv" || {
        echo "$feature: its $lines lines leave something in kernels without it" >&2
        failures=$((failures + 1))
    }
    "$validate" --target-env vulkan1.1 "$work/pruned.spv" || failures=$((failures + 1))
    number=$((number + 1)) gone=$((gone + lines))
done
echo "$number features, $gone lines taken out, $failures differ"
[ "$failures" = 0 ] && [ "$gone" -gt 300 ]
