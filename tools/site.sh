#!/bin/sh
# Makes the documentation as static HTML: tools/site.sh [FOLDER], which is build/site if none is named. It can be opened from the disk, or
# served from any folder of any server. Needs node and npm, which fetches what reads Markdown once, by web/site/package-lock.json with its
# hashes. Where tools/page.sh has made the page (build/page), the playground is in it. A dead link is an error, and leaves FOLDER as it was.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/site}
modules=${GLINT_SITE_MODULES:-$here/build/site-root}
page=${GLINT_PAGE:-$here/build/page}
for program in node npm; do
    command -v "$program" >/dev/null || {
        echo "tools/site.sh: needs $program" >&2
        exit 1
    }
done
# The packages, into another folder first: what is there is always whole.
if ! cmp -s "$here/web/site/package-lock.json" "$modules/package-lock.json"; then
    rm -rf "$modules" "$modules.new"
    mkdir -p "$modules.new"
    cp "$here/web/site/package.json" "$here/web/site/package-lock.json" "$modules.new"
    (cd "$modules.new" && npm ci --ignore-scripts --no-audit --no-fund >npm.log 2>&1) || {
        tail -n 40 "$modules.new/npm.log" >&2
        exit 1
    }
    mv "$modules.new" "$modules"
fi
new=$folder.new
rm -rf "$new"
mkdir -p "$(dirname -- "$folder")"
if [ -f "$page/scenes.json" ]; then
    node "$here/web/site/build.mjs" "$new" "$modules" "$here" "$page"
else
    node "$here/web/site/build.mjs" "$new" "$modules" "$here"
fi
node "$here/web/site/check.mjs" "$new" "$modules"
"$here/tools/emptied" "$folder"
rmdir "$folder"
mv "$new" "$folder"
