#!/bin/sh
# Makes the page, glint in a browser, as static files: tools/page.sh [FOLDER], which is build/page if none is named. Any web server can
# serve them; `node web/page/serve.mjs build/page` does so on this machine. Needs what tools/web.sh needs, which it runs where its
# libraries are not there yet, and npm, which fetches the editor and the bundler once, by web/page/package-lock.json with its hashes.
# What tools/webgpu.sh has made goes with it, if it is there.
# Scenes whose meshes and images are made (scenes/generated) are left out where these are not there.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/page}
source=page
modules=${GLINT_PAGE_MODULES:-$here/build/page-root}
. "$here/tools/web_parts.sh"
new=$folder.new
rm -rf "$new"
gpu=${GLINT_WEBGPU:-$here/build/webgpu}
[ -f "$gpu/glint-gpu.wasm" ] || gpu=
node web/page/build.mjs "$new" "$modules" "$web/glint-lint" "$here" $gpu
"$here/tools/emptied" "$folder"
rmdir "$folder"
mv "$new" "$folder"
web/page/weigh "$folder"
