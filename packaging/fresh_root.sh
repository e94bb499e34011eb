#!/bin/sh
# A small Debian 12 in a folder, in which a package is tried out: packaging/fresh_root.sh DEB [FOLDER], which is build/fresh-root
# if none is named. Needs mmdebstrap, a network, and root. It holds what the package says that it depends on, and nothing else.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
deb=${1:?the package, as cpack -G DEB makes it}
folder=${2:-$here/build/fresh-root}
# "libyaml-0-2 (>= 0.2), a | b" -> "libyaml-0-2,a"
needs=$(dpkg-deb -f "$deb" Depends | tr ',' '\n' | sed 's/[(|].*//; s/ //g' | paste -sd,)
rm -rf "$folder"
mkdir -p "$(dirname -- "$folder")"
mmdebstrap --quiet --variant=apt --include="$needs" bookworm "$folder" "${GLINT_MIRROR:-http://deb.debian.org/debian}"
