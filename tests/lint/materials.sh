#!/bin/sh
# A material has one list: with an invented field in a copy of scene/material_fields.h, the one place that does not compile is what
# fills the device's record; with its place in a copy of shaders/records.h all compiles, and the field is compared, hashed and
# packed; where it is not, a test of the list names it. Usage: materials.sh ROOT BUILD, whose libraries have no sanitizers
. "$(dirname -- "$0")/lib.sh"
build=$2
command -v "${CC:-cc}" >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/scene" "$work/shaders"

add_field() { # SHARE RECORD FROM
    sed "s|FIELD(NUMBER, alpha, |FIELD(NUMBER, sheen, $1, $2, $3) &|" scene/material_fields.h >"$work/scene/material_fields.h"
}

compile() { # the copies come first
    "${CC:-cc}" -std=c11 -I"$work" -I. -Itests/unit/kit -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE "$@"
}

files=$(ours '\.c$' | xargs grep -lE 'scene_material|gpu_material|SCENE_MATERIAL_FIELDS|include "reference/reference_internal.h"')
lacks() {
    for file in $files; do
        ! compile -fsyntax-only "$file" 2>&1 | grep -q 'error:' || echo "$file"
    done
}

# What needs a library that is not here, as the peer with embree, compiles without the field no more than with it.
absent=$(lacks)
for file in $absent; do
    echo "skipped: $file does not compile here as it is"
done
files=$(echo "$files" | tr ' ' '\n' | grep -vxF "${absent:-none}")

# The libraries of rooms that do not know the list.
libraries=$(for room in assets picture grammar diag files core tracer/bvh shaders; do find "$build/$room" -name 'libglint_*.a'; done)
tests() { # made anew with the rooms that know the list: prints what they say of it
    objects=
    for file in $(ours '^(scene|reference|tracer/flatten)/[a-z_]*\.c$|^tests/unit/kit/flat_kit\.c$'); do
        object=$work/$(echo "$file" | tr / _).o
        compile -w -c -o "$object" "$file"
        objects="$objects $object"
    done
    for test in scene/test_media scene/test_materials tracer/test_material_records; do
        # shellcheck disable=SC2086 -- our paths hold no blanks
        compile -w -o "$work/test" "tests/unit/$test.c" $objects -Wl,--start-group $libraries -Wl,--end-group \
            -lcmocka -lpng -lz -ljpeg -lOpenEXRCore -lwebp -lm -pthread
        "$work/test" >"$work/said" 2>&1 || grep -oE "(changes|change with) 'sheen'" "$work/said" || cat "$work/said"
    done
}

{
    add_field MEDIUM MATERIAL 'ir->roughness'
    [ "$(lacks)" = tracer/flatten/flatten_light.c ] || echo "scene/material_fields.h:1: a new field stops $(lacks | tr '\n' ' ')"
    sed -e 's/FLOAT(alpha, 5, w, 6, w)/FLOAT(sheen, 7, x, 8, x) &/' -e 's/^\(#define MATERIAL_WORDS *\)7/\18/' \
        -e 's/^\(#define MATERIAL64_WORDS *\)8/\19/' shaders/records.h >"$work/shaders/records.h"
    lacks | sed 's|$|:1: does not compile with a new field of a material|'
    tests | sed 's|^|scene/material_fields.h:1: a new field is not packed, compared and filled: |'
    add_field MEDIUM APART 'ir->roughness'
    tests | grep -q "change with 'sheen'" || echo "scene/material_fields.h:1: nothing sees that a field is not packed"
    add_field MEDIUM MATERIAL 1
    tests | grep -q "changes 'sheen'" || echo "scene/material_fields.h:1: nothing sees that a field is not filled"
} 2>&1 | verdict
