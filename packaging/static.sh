#!/bin/sh
# A tarball of a static glint-check, with the licences of what is linked into it: packaging/static.sh BUILD OUT, where BUILD was
# configured by the preset check-only with GLINT_STATIC=ON. The same build gives the same bytes.
set -eu
build=$1
out=$2
: "${SOURCE_DATE_EPOCH:?the time of all files}"
name=glint-check-$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")-$(uname -m)-linux
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/$name" --strip >/dev/null
for library in libbrotli1 libc6 libexpat1 libfreetype6 libjansson4 libjpeg62-turbo libminizip1 libpng16-16 libyaml-0-2 zlib1g; do
    [ -f "/usr/share/doc/$library/copyright" ] || continue
    mkdir -p "$work/$name/share/doc/glint-check/licences"
    cp "/usr/share/doc/$library/copyright" "$work/$name/share/doc/glint-check/licences/$library"
done
find "$work/$name" -type d -exec chmod 755 {} + -o -type f -exec chmod u=rwX,go=rX {} +
tar -C "$work" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --format=ustar -cf - "$name" |
    xz -9 -T1 >"$out/$name.tar.xz"
