#!/bin/sh
# What a new shape of bodies lacks, by the compiler, is what CONTRIBUTING.md lists: with another enumerator in a copy of the header,
# each switch over shapes, or over what trees hold, is an error. Usage: shapes.sh ROOT
. "$(dirname -- "$0")/lib.sh"
command -v "${CC:-cc}" >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/scene"
sed 's/^    SCENE_MESH,/&\n    SCENE_OTHER,/' scene/scene.h >"$work/scene/scene.h"
sed 's/^    SHAPE_TRIANGLES,/&\n    SHAPE_OTHER,/' scene/shape.h >"$work/scene/shape.h"
for file in $(ours '\.c$' | grep -v '^tests/' | xargs grep -lE '^ *case (SCENE|SHAPE)_'); do
    "${CC:-cc}" -std=c11 -fsyntax-only -Wswitch -I"$work" -I. -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE "$file" 2>&1
done | LC_ALL=C awk '/In function/ { sub(/:.*/, "", $1); gsub(/[^a-z_0-9]/, "", $4); at = $1 ": " $4 }
    /(SCENE|SHAPE)_OTHER.* not handled/ { print at }' | sort -u >"$work/lacks"
# `FILE.c`: `FUNCTION`, `FUNCTION`
sed -n '/^## How to add a kind of body/,/^## How to add a feature/p' CONTRIBUTING.md | grep -oE '`[a-z_/]+\.c`: `[a-z_]+`(, `[a-z_]+`)*' |
    tr -d '`,' | awk '{ for (i = 2; i <= NF; i++) print $1, $i }' | sort -u >"$work/listed"
{
    comm -23 "$work/lacks" "$work/listed" | sed 's|^|CONTRIBUTING.md:1: does not list |'
    comm -13 "$work/lacks" "$work/listed" | sed 's|^|CONTRIBUTING.md:1: lists what a new shape does not need: |'
    [ -s "$work/lacks" ] || echo "CONTRIBUTING.md:1: no switch lacks a new shape"
} | verdict
