#!/bin/sh
# Pictures by WebGPU: run_webgpu.sh GLINT SOURCE WORK BUILD [PAGE_BUILD], where BUILD is a folder for the module; the program's own device
# draws what they are compared with. With PAGE_BUILD, a folder for the page's other module, the page is tried too, if tools/page.sh was run before.
# WEBGPU_OPTIONS has options of `glint render`, WEBGPU_SCENES=all takes every scene that ships, WEBGPU_WAIT is how many seconds a picture may take.
# tools/webgpu.sh fetches naga once; where it has not, or there is no Chromium, the test is skipped.
. "$2/tests/clients.sh"
manual=docs/decisions/webgpu.md
build=$4
needs emcc
needs node
needs glslangValidator
[ -x /usr/bin/chromium ] || skip "chromium is not installed ($manual says how)"
GLINT_WEB=${GLINT_WEB:-$source/build/web-root}
GLINT_WEBGPU_MODULES=${GLINT_WEBGPU_MODULES:-$source/build/webgpu-root}
[ -d "$GLINT_WEB/root" ] || skip "no libraries for WebAssembly; tools/webgpu.sh builds them"
cmp -s "$source/web/gpu/package-lock.json" "$GLINT_WEBGPU_MODULES/package-lock.json" || skip "naga is not there; tools/webgpu.sh fetches it"
export GLINT_WEB GLINT_WEBGPU_MODULES
GLINT_WEBGPU_BUILD=$build "$source/tools/webgpu.sh" "$work/page" || fail "the module or a kernel is not made"
GLINT_PAGE_MODULES=${GLINT_PAGE_MODULES:-$source/build/page-root}
if [ -n "${5:-}" ] && cmp -s "$source/web/page/package-lock.json" "$GLINT_PAGE_MODULES/package-lock.json"; then
    export GLINT_PAGE_MODULES
    GLINT_WEB_BUILD=$5 GLINT_WEBGPU=$work/page "$source/tools/page.sh" "$work/whole" >/dev/null || fail "the page is not made"
    node "$source/tests/webgpu/page.mjs" "$work/whole" || fail "the page"
fi
cp "$source/web/page/worker.js" "$source/tests/webgpu/index.html" "$work/page"

scenes="elements/spheres elements/cylinders language/transfer_srgb elements/seen_lights language/nested language/sky_light"
[ "${WEBGPU_SCENES:-}" != all ] || scenes=$(cd "$source/scenes" && find . -name '*.glint.yaml' ! -path '*/parts/*' | sed 's/^..//; s/.glint.yaml$//' | sort)
mkdir scenes
sed '/^glint: 1/a trace: {precision: double}' "$source/scenes/elements/spheres.glint.yaml" >scenes/double.glint.yaml
grep -q double scenes/double.glint.yaml || fail "the scene asks for nothing"
node "$source/tests/webgpu/draw.mjs" "$work/page" "$glint" "$work/scenes" "$work" "--size 32x24" double >double.out || fail "$(cat double.out)"
grep 'double: .*E707' double.out || fail "a scene that asks for double precision is not refused: $(cat double.out)"
# shellcheck disable=SC2086 # words
exec node "$source/tests/webgpu/draw.mjs" "$work/page" "$glint" "$source/scenes" "$work" "${WEBGPU_OPTIONS:---size 48x36 --samples 2}" $scenes
