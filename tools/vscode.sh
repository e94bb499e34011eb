#!/bin/sh
# Makes the extension for Visual Studio Code: tools/vscode.sh [FOLDER], which is build/vscode if none is named, gets glint-VERSION.vsix, and the
# same as a folder. Needs what tools/web.sh needs, which it runs where its libraries are not there yet, node 20.15 or later, and npm, which
# fetches the language client and the bundler once, by web/vscode/package-lock.json with its hashes. What the archive is made of alone decides
# its bytes.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/vscode}
libraries=${GLINT_WEB:-$here/build/web-root}
modules=${GLINT_VSCODE_MODULES:-$here/build/vscode-root}
for program in emcc cmake node; do
    command -v "$program" >/dev/null || {
        echo "tools/vscode.sh: needs $program" >&2
        exit 1
    }
done

# log COMMAND...: its output only where it fails.
log() {
    "$@" >"$here/build/vscode.log" 2>&1 || {
        tail -n 40 "$here/build/vscode.log" >&2
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
if ! cmp -s web/vscode/package-lock.json "$modules/package-lock.json"; then
    rm -rf "$modules"
    mkdir -p "$modules"
    cp web/vscode/package.json "$modules"
    cp web/vscode/package-lock.json "$modules/lock.tmp"
    (cd "$modules" && cp lock.tmp package-lock.json && log npm ci --ignore-scripts --no-audit --no-fund) || {
        rm -rf "$modules"
        exit 1
    }
    rm "$modules/lock.tmp"
fi
rm -rf "$folder.new"
node web/vscode/build.mjs "$folder.new" "$modules" "$web/glint-lint" "$here"
rm -rf "$folder"
mv "$folder.new" "$folder"
