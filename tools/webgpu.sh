#!/bin/sh
# Makes what draws in a page by WebGPU: tools/webgpu.sh [FOLDER], which is build/webgpu if none is named. It holds glint-gpu.js and
# glint-gpu.wasm, the program as a module, and a kernel each in trace.wgsl, resolve.wgsl, hits.wgsl and log.wgsl, made of the GLSL in
# shaders/ (glslang), through SPIR-V, by naga. tools/page.sh takes it into the page where it is. Needs what tools/web.sh needs, which it
# runs where its libraries are not there yet, glslang-tools, and npm, which fetches naga once, by web/gpu/package-lock.json with its hashes.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/webgpu}
libraries=${GLINT_WEB:-$here/build/web-root}
modules=${GLINT_WEBGPU_MODULES:-$here/build/webgpu-root}
built=${GLINT_WEBGPU_BUILD:-$here/build/webgpu-build}
for program in emcc wasm-opt cmake node glslangValidator; do
    command -v "$program" >/dev/null || {
        echo "tools/webgpu.sh: needs $program" >&2
        exit 1
    }
done
mkdir -p "$here/build"

# log COMMAND...: its output only where it fails.
log() {
    "$@" >"$built.log" 2>&1 || {
        tail -n 40 "$built.log" >&2
        exit 1
    }
}
[ -d "$libraries/root" ] || "$here/tools/web.sh" "$libraries"
if ! cmp -s "$here/web/gpu/package-lock.json" "$modules/package-lock.json"; then
    rm -rf "$modules"
    mkdir -p "$modules"
    cp "$here/web/gpu/package.json" "$modules"
    cp "$here/web/gpu/package-lock.json" "$modules/lock.tmp"
    (cd "$modules" && cp lock.tmp package-lock.json && log npm ci --ignore-scripts --no-audit --no-fund) || {
        rm -rf "$modules"
        exit 1
    }
    rm "$modules/lock.tmp"
fi
cd "$here"
export GLINT_WEB="$libraries"
log cmake --preset web -B "$built" -DGLINT_WEBGPU=ON
log cmake --build "$built" --parallel 2 --target glint
new=$folder.new
rm -rf "$new"
mkdir -p "$new"
cp "$built/glint.js" "$new/glint-gpu.js"
wasm-opt -Oz --mvp-features --enable-mutable-globals "$built/glint.wasm" -o "$new/glint-gpu.wasm"
for kernel in trace resolve hits log; do
    log glslangValidator --quiet -g0 --target-env vulkan1.1 -S comp -Ishaders -DWEBGPU -DNO_DOUBLES -o "$new/$kernel.spv" "shaders/$kernel.comp"
    node web/gpu/wgsl.mjs "$modules" "$new/$kernel.spv" "$new/$kernel.wgsl"
    rm "$new/$kernel.spv"
done
"$here/tools/emptied" "$folder"
rmdir "$folder"
mv "$new" "$folder"
