#!/bin/sh
# Installs the Debian packages that are missing, and only those: `tools/setup.sh check-only` for building what checks
# scenes, `tools/setup.sh build` for building and rendering, `tools/setup.sh test` for the tests too, `tools/setup.sh packages NAME...` for
# those that are named. Needs root or sudo only where something is missing. `--list` only prints them.
set -eu

check="gcc libc6-dev cmake ninja-build pkg-config libyaml-dev libexpat1-dev libjansson-dev libpng-dev zlib1g-dev
libjpeg62-turbo-dev libopenexr-dev libwebp-dev libminizip-dev libxxhash-dev libfreetype-dev"
build="$check libstb-dev libvulkan-dev libvulkan-volk-dev libvulkan1 mesa-vulkan-drivers
glslang-tools spirv-headers spirv-tools libglfw3-dev"
test="libcmocka-dev vulkan-validationlayers valgrind libxml2-utils clang-format git xvfb libx11-dev libxtst-dev"

case "${1:-}" in
check-only) wanted=$check ;;
build) wanted=$build ;;
test) wanted="$build $test" ;;
packages)
    shift
    wanted=$*
    ;;
*)
    echo "usage: tools/setup.sh check-only|build|test [--list] | packages NAME..." >&2
    exit 2
    ;;
esac

if [ "${2:-}" = --list ]; then
    # shellcheck disable=SC2086
    printf '%s\n' $wanted
    exit 0
fi

if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "setup: this is not a Debian system; install the packages listed in tools/setup.sh by hand" >&2
    exit 0
fi

missing=
for package in $wanted; do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

echo "setup: installing$missing" >&2
if [ "$(id -u)" -eq 0 ]; then
    as_root=
elif command -v sudo >/dev/null 2>&1; then
    as_root="sudo"
else
    echo "setup: please run as root: apt-get install$missing" >&2
    exit 1
fi
export DEBIAN_FRONTEND=noninteractive
# An installation with today's lists usually works at once; old lists are renewed first otherwise.
# shellcheck disable=SC2086
$as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null 2>&1 || {
    $as_root apt-get update -qq
    $as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
}
