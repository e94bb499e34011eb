#!/bin/sh
# Glass in glass as a user sees it: bodies that are one, water that reaches into its glass, what inspect and pick say.
# Usage: run_media.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

# A closed ball of triangles around the origin. ball RADIUS SIDES SIGN FIRST: faces turned inwards with SIGN -1, whose
# vertices are numbered from FIRST on.
ball() {
    awk -v r="$1" -v n="$2" -v sign="$3" -v first="$4" 'BEGIN {
        pi = 3.14159265358979
        printf "v 0 %.9g 0\n", r
        for (i = 1; i < n; i++)
            for (k = 0; k < 2 * n; k++)
                printf "v %.9g %.9g %.9g\n", r * sin(pi * i / n) * cos(pi * k / n), r * cos(pi * i / n), r * sin(pi * i / n) * sin(pi * k / n)
        printf "v 0 %.9g 0\n", -r
        last = first + 1 + (n - 1) * 2 * n
        for (k = 0; k < 2 * n; k++) {
            j = (k + 1) % (2 * n)
            face(first, first + 1 + j, first + 1 + k)
            for (i = 0; i < n - 2; i++) {
                a = first + 1 + i * 2 * n
                b = a + 2 * n
                face(a + k, a + j, b + k)
                face(a + j, b + j, b + k)
            }
            a = first + 1 + (n - 2) * 2 * n
            face(a + k, a + j, last)
        }
    }
    function face(x, y, z) { if (sign > 0) print "f", x, y, z; else print "f", x, z, y }'
}

head='glint: 1
image: {width: 96, height: 72}
camera: {position: [0, 0.6, 5], look_at: [0, 0, 0], fov: 35}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [3, 6, 4]}]
materials:
  floor: {diffuse_color: {checker: {colors: [0.9, 0.2], size: 0.5}}}
  glass: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.5, priority: 1}
rectangles:
  - {name: floor, corner: [-5, -1.2, 5], edge_u: [10, 0, 0], edge_v: [0, 0, -10], material: floor}'
scene() { # FILE: and what comes after the head
    { echo "$head" && cat; } >"$1"
}

ball 1 12 1 1 >outer.obj
ball 0.85 12 1 1 >inner.obj
ball 0.92 12 1 1 >within.obj
{ ball 1 12 1 1 && ball 0.85 12 -1 267; } >hollow.obj

scene one.yaml <<'END'
spheres:
  - {name: ball, center: [0, 0, 0], radius: 1, material: glass}
END
scene two.yaml <<'END'
spheres:
  - {name: ball, center: [0, 0, 0], radius: 1, material: glass}
  - {name: kernel, center: [0.2, 0.1, 0.1], radius: 0.5, material: glass}
END
# A bottle whose wall has an inner side, and water that reaches into it; and the same with one face between the two.
scene overlap.yaml <<'END'
models:
  - {name: bottle, mesh: hollow.obj, material: glass}
  - {name: drink, mesh: within.obj, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.33}}
END
scene turned.yaml <<'END'
models:
  - {name: drink, mesh: within.obj, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.33}}
  - {name: bottle, mesh: hollow.obj, material: glass}
END
scene exact.yaml <<'END'
models:
  - {name: bottle, mesh: outer.obj, material: glass}
  - {name: drink, mesh: inner.obj, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.33, priority: 1}}
END

expect "nesting needs no advice" 0 - - "$glint" check two.yaml
expect "nor does water in a glass" 0 - - "$glint" check overlap.yaml
expect "nobody asks what it is inside" 0 'not required:.* media' - "$glint" inspect one.yaml
expect "and who asks" 0 "media +two.yaml:[0-9]+:12: sphere 'kernel' may share a place with sphere 'ball'" - "$glint" inspect two.yaml
scene coloured.yaml <<'END'
spheres:
  - {name: amber, center: [0, 0, 0], radius: 1, material: {albedo: [0, 0, 0, 1], refractive_index: 1.5, attenuation_color: [0.9, 0.5, 0.1]}}
END
expect "a colour asks, too" 0 "media +coloured.yaml:[0-9]+:12: sphere 'amber' is coloured inside" '' "$glint" inspect coloured.yaml

# same NAME A B OPTION...: pictures of two scenes, byte for byte.
same() {
    name=$1 a=$2 b=$3
    shift 3
    ok "$name: one" "$glint" render "$a" "$@" -q -o a.pfm
    ok "$name: the other" "$glint" render "$b" "$@" -q -o b.pfm
    if cmp -s a.pfm b.pfm; then pass "$name"; else fail "$name: other bytes"; fi
}
ok() {
    name=$1
    shift
    expect "$name" 0 '' '' "$@"
}

devices=reference
if "$glint" devices | grep -q .; then
    devices="0 reference"
fi
for device in $devices; do
    [ "$device" = 0 ] || export GLINT_DEVICE="$device"
    for precision in single double; do
        [ "$device" = 0 ] || [ "$precision" = double ] || continue
        set -- --set trace.precision=$precision
        ok "a ball" "$glint" render one.yaml "$@" -q -o one.png
        ok "a ball in a ball" "$glint" render two.yaml "$@" -q -o two.png
        expect "a ball of glass in glass is not there" 0 '^0 of 6912 pixels differ by more than 0$' - "$glint" compare two.png one.png --threshold 0
        same "order does not matter" overlap.yaml turned.yaml "$@"
        ok "the exact interface" "$glint" render exact.yaml "$@" -q -o exact.pfm
        expect "water that reaches into glass" 0 '' - "$glint" compare a.pfm exact.pfm --max-share 0.001
    done
done
unset GLINT_DEVICE

expect "what a ray is inside" 0 "refracted from 0, weight 0.8, inside sphere 'ball'" - "$glint" pick two.yaml 48,36 --device reference
also "and that it passes" "sphere 'kernel', at .*passes unseen: the medium stays the same" -
expect "the same in JSON" 0 '"inside": "sphere .ball."' - "$glint" pick two.yaml 48,36 --device reference --format json
also "and there" '"passes": true' -
expect "what is lost on the way" 0 'attenuated to 0\.[0-9]+ 0\.[0-9]+ 0\.' - "$glint" pick coloured.yaml 48,36 --device reference

{
    echo 'spheres:'
    for i in 1 2 3 4 5 6 7 8 9 10; do
        echo "  - {center: [0, 0, 0], radius: $i, material: {albedo: [0, 0, 0, 1], refractive_index: 1.$i}}"
    done
} | scene nested.yaml
expect "nine around one are too many" 1 - 'is inside 9 other bodies that refract; at most 8 may surround a ray \[E501\]' "$glint" check nested.yaml
for device in $devices; do
    [ "$device" = 0 ] || export GLINT_DEVICE="$device"
    expect "and a picture says so" 1 - 'show rays that are inside more than 8 bodies at once that refract.*E501' "$glint" render nested.yaml --set camera.position.z=50 -o nested.pfm
done
exit $failed
