#!/bin/sh
# Makes the extension for Visual Studio Code: tools/vscode.sh [FOLDER], which is build/vscode if none is named, gets glint-VERSION.vsix, and the
# same as a folder. Needs what tools/web.sh needs, which it runs where its libraries are not there yet, node 20.15 or later, and npm, which
# fetches the language client and the bundler once, by web/vscode/package-lock.json with its hashes. What the archive is made of alone decides
# its bytes.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/vscode}
source=vscode
modules=${GLINT_VSCODE_MODULES:-$here/build/vscode-root}
. "$here/tools/web_parts.sh"
rm -rf "$folder.new"
node web/vscode/build.mjs "$folder.new" "$modules" "$web/glint-lint" "$here"
"$here/tools/emptied" "$folder"
rmdir "$folder"
mv "$folder.new" "$folder"
