#!/bin/sh
# Puts what a build of 32 bits needs into a folder, without installing anything: tools/i386.sh [FOLDER], which is
# build/i386 if none is named. Debian's packages, unpacked; apt checks their signatures. cmake/i386.cmake uses them.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/i386}
packages="libc6 linux-libc-dev libgcc-12-dev libgcc-s1 $("$here/tools/setup.sh" check-only --list | grep -e '-dev$')"

rm -rf "$folder"
mkdir -p "$folder/apt/state" "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial" "$folder/packages"
cd "$folder"
folder=$(pwd)
: >apt/status
mirror=${GLINT_MIRROR:-http://deb.debian.org/debian}
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror bookworm main" >apt/sources
cat >apt/conf <<END
APT::Architecture "i386";
APT::Architectures { "i386"; };
APT::Sandbox::User "";
Dir::State "$folder/apt/state";
Dir::State::lists "$folder/apt/lists";
Dir::State::status "$folder/apt/status";
Dir::Cache "$folder/apt/cache";
Dir::Etc::sourcelist "$folder/apt/sources";
Dir::Etc::sourceparts "/dev/null";
END
export APT_CONFIG="$folder/apt/conf"
apt-get update -qq
# shellcheck disable=SC2086
(cd packages && apt-get download -qq $packages)
for package in packages/*.deb; do
    dpkg -x "$package" root
done
rm -r apt packages
