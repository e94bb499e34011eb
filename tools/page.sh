#!/bin/sh
# Makes the page, glint in a browser, as static files: tools/page.sh [FOLDER], which is build/page if none is named. Any web server can
# serve them; `node web/page/serve.mjs build/page` does so on this machine. Needs what tools/web.sh needs, which it runs where its
# libraries are not there yet, and npm, which fetches the editor and the bundler once, by web/page/package-lock.json with its hashes.
# What tools/webgpu.sh has made goes with it, if it is there.
# Scenes whose meshes and images are made (scenes/generated) are left out where these are not there.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/page}
libraries=${GLINT_WEB:-$here/build/web-root}
modules=${GLINT_PAGE_MODULES:-$here/build/page-root}
for program in emcc cmake node; do
    command -v "$program" >/dev/null || {
        echo "tools/page.sh: needs $program" >&2
        exit 1
    }
done

# log COMMAND...: its output only where it fails.
log() {
    "$@" >"$here/build/page.log" 2>&1 || {
        tail -n 40 "$here/build/page.log" >&2
        exit 1
    }
}
mkdir -p "$here/build"
[ -d "$libraries/root" ] || "$here/tools/web.sh" "$libraries"
cd "$here"
export GLINT_WEB="$libraries"
web=${GLINT_WEB_BUILD:-$here/build/web}
log cmake --preset web -B "$web"
log cmake --build "$web" --parallel 2 --target npm_package
if ! cmp -s web/page/package-lock.json "$modules/package-lock.json"; then
    rm -rf "$modules"
    mkdir -p "$modules"
    cp web/page/package.json "$modules"
    cp web/page/package-lock.json "$modules/lock.tmp"
    (cd "$modules" && cp lock.tmp package-lock.json && log npm ci --ignore-scripts --no-audit --no-fund) || {
        rm -rf "$modules"
        exit 1
    }
    rm "$modules/lock.tmp"
fi
new=$folder.new
rm -rf "$new"
gpu=${GLINT_WEBGPU:-$here/build/webgpu}
[ -f "$gpu/glint-gpu.wasm" ] || gpu=
node web/page/build.mjs "$new" "$modules" "$web/glint-lint" "$here" $gpu
rm -rf "$folder"
mv "$new" "$folder"
web/page/weigh "$folder"
