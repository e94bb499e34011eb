#!/bin/sh
# bench/smooth_glass.sh [GLINT]
#
# How wrong smooth glass is by the size of its faces: a ball and a thin-walled bowl of n faces around, of index 1.5, before a
# checker. Prints, for each n, by how many degrees normals differ from the faces at most, and the mean difference of the
# picture from that of a sphere (of the bowl: from one of 512 faces around), in hundredths of the range of displayed values,
# over the pixels that show the body. lint/rules_facets.c has its limit from here (W437).
set -eu
glint=$(CDPATH='' cd -- "$(dirname -- "${1:-build/release/glint}")" && pwd)/$(basename -- "${1:-build/release/glint}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# A profile "r y" a line, which begins and ends on the axis, turned around it in $1 faces.
turned() {
    awk -v pi=3.14159265358979 -v n="$1" '
    {
        r[NR] = $1; y[NR] = $2
    }
    END {
        for (j = 1; j <= NR; j++)
            for (i = 0; i < n; i++)
                printf "v %.9g %.9g %.9g\n", 0 + r[j] * cos(i * 2 * pi / n), y[j], 0 - r[j] * sin(i * 2 * pi / n)
        for (j = 0; j < NR - 1; j++)
            for (i = 0; i < n; i++)
                printf "f %d %d %d %d\n", j * n + i + 1, j * n + (i + 1) % n + 1, (j + 1) * n + (i + 1) % n + 1, (j + 1) * n + i + 1
    }'
}
ball() {
    awk -v pi=3.14159265358979 -v m="$(($1 / 2))" 'BEGIN { for (j = 0; j <= m; j++) print (j % m ? sin(j * pi / m) : 0), -cos(j * pi / m) }'
}
bowl() {
    awk -v pi=3.14159265358979 -v m="$(($1 / 4))" 'BEGIN {
        for (j = 0; j <= m; j++) print (j ? sin(j * pi / 2 / m) : 0), -cos(j * pi / 2 / m)
        for (j = 1; j < m; j++) print 0.97 + 0.03 * cos(j * pi / m), 0.03 * sin(j * pi / m)
        for (j = m; j >= 0; j--) print (j ? 0.94 * sin(j * pi / 2 / m) : 0), -0.94 * cos(j * pi / 2 / m)
    }'
}
scene() { # name, body
    cat >"$1.yaml" <<END
glint: 1
image: {width: 160, height: 160, samples: 16, transfer: srgb}
background: {color: [0.6, 0.7, 0.8]}
camera: {position: [0, 1.2, 7], look_at: [0, -0.35, 0], fov: 8}
lights: [{position: [-5, 8, 6], intensity: 1.5}]
trace: {max_depth: 12}
materials:
  glass: {albedo: [0, 0.3, 0.1, 0.85], refractive_index: 1.5, specular_exponent: 100}
  tiles: {diffuse_color: {checker: {colors: [0.8, 0.3], size: 0.5}}}
rectangles:
  - {corner: [-8, -1.05, 4], edge_u: [16, 0, 0], edge_v: [0, 0, -20], material: tiles}
  - {corner: [-8, -1.05, -9], edge_u: [16, 0, 0], edge_v: [0, 8, 0], material: tiles}
$2
END
    "$glint" render -q "$1.yaml" -o "$1.png"
}
scene ball 'spheres: [{center: [0, 0, 0], radius: 1, material: glass}]'
bowl 512 | turned 512 >bowl.obj
scene bowl 'models: [{mesh: bowl.obj, smooth: true, material: glass}]'
printf 'faces  body  degrees  percent\n'
for n in 16 24 32 40 48 64 96 128; do
    for body in ball bowl; do
        "$body" "$n" | turned "$n" >"$body$n.obj"
        scene "$body$n" "models: [{mesh: $body$n.obj, smooth: true, material: glass}]"
        off=$("$glint" check "$body$n.yaml" 2>&1 | sed -n 's/.*at most \([0-9]*\).*W437.*/\1/p')
        mae=$("$glint" compare "$body$n.png" "$body.png" | awk '$1 == "mae" { print 100 * $2 }')
        printf '%5d  %s  %7s  %7.2f\n' "$n" "$body" "${off:--}" "$mae"
    done
done
