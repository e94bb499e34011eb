#!/bin/sh
# Limits that many models reach together: check, inspect and render say the same of them, at the same place.
# Usage: run_limits.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

# A square of 2 * 160 * 160 triangles, and triangles without a height that single precision could tell.
awk 'BEGIN {
    n = 160
    for (i = 0; i <= n; i++) for (k = 0; k <= n; k++) print "v", i, k, 0
    for (i = 0; i < n; i++) for (k = 0; k < n; k++) { a = i * (n + 1) + k + 1; print "f", a, a + 1, a + n + 2, a + n + 1 }
}' >square.obj
awk 'BEGIN { for (i = 0; i < 600; i++) printf "v %g 0 0\nv %.12g 1e-9 1\nv %g 0 2\nf -3 -2 -1\n", i * 0.01, i * 0.01 + 1e-8, i * 0.01 }' >thin.obj
scene() { # MESH COUNT
    printf 'glint: 1\ncamera: {position: [0, 0, 900]}\nlights: [{position: [5, 5, 5]}]\nmodels:\n'
    awk -v mesh="$1" -v count="$2" 'BEGIN { for (i = 0; i < count; i++)
        printf "  - {mesh: %s, material: {}, translation: [%d, %d, %d], rotation: [%d, 3, 7]}\n", mesh, i % 50 * 3, int(i / 50) % 50 * 3, -int(i / 2500) * 3, i % 90 }'
}
agree() { # NAME EXIT PATTERN_ERR SCENE OPTIONS...
    what=$1 wanted=$2 err=$3 file=$4
    shift 4
    expect "$what: check" "$wanted" '' "$err" "$glint" check "$file" "$@"
    expect "$what: inspect" "$wanted" '' "$err" "$glint" inspect "$file" "$@"
    expect "$what: render" "$wanted" '' "$err" "$glint" render "$file" --size 8x6 -q -o out.png "$@"
    expect "$what: the reference" "$wanted" '' "$err" "$glint" render "$file" --size 8x6 -q -o out.png --device reference "$@"
}
# 51 200 triangles each: the 20 972nd model is one too many (2^30 - 3 items can be numbered).
scene square.obj 20972 >many.glint.yaml
agree "items that cannot be numbered" 1 '^many.glint.yaml:20976:5: error: with this body all models together show more than 1073741821 triangles' many.glint.yaml
# Without copies in double precision, which such a scene needs.
scene thin.obj 1000 >thin.glint.yaml
agree "thin triangles share in double precision" 0 '' thin.glint.yaml --limit scene-triangles=1000
own="^thin.glint.yaml:5:5: error: models have 600000 triangles of their own, because not all"
for command in inspect "render -q --size 8x6 -o out.png"; do
    # shellcheck disable=SC2086
    expect "and not in single: ${command%% *}" 1 '' "$own" "$glint" $command thin.glint.yaml --limit scene-triangles=1000 --set trace.precision=single
done
exit "$failed"
