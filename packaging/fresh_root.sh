#!/bin/sh
# A small Debian 12 in a folder, in which packages are tried out: packaging/fresh_root.sh [FOLDER], which is build/fresh-root if
# none is named. Needs mmdebstrap, a network, and root. It holds what the packages depend on, and nothing else.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/fresh-root}
rm -rf "$folder"
mkdir -p "$(dirname -- "$folder")"
mmdebstrap --quiet --variant=apt --include=libexpat1,libjansson4,libjpeg62-turbo,libminizip1,libpng16-16,libyaml-0-2,zlib1g \
    bookworm "$folder" "${GLINT_MIRROR:-http://deb.debian.org/debian}"
