#!/bin/sh
# Puts what a build of 32 bits needs into a folder, without installing anything: tools/i386.sh [FOLDER], which is
# build/i386 if none is named. Debian's packages, unpacked; apt checks their signatures. cmake/i386.cmake uses them.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/i386}
packages="libc6 linux-libc-dev libgcc-12-dev libgcc-s1 $("$here/tools/setup.sh" check-only --list | grep -e '-dev$') libbrotli-dev" # and what FreeType needs

"$here/tools/emptied" "$folder"
mkdir -p "$folder/packages"
cd "$folder"
suite=bookworm
kind=deb
architecture=i386
. "$here/tools/apt_apart.sh"
# shellcheck disable=SC2086
(cd packages && apt-get download -qq $packages)
for package in packages/*.deb; do
    dpkg -x "$package" root
done
rm -r apt packages
