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

# As an author draws it at first: no priorities, or the same faces twice.
for order in overlap turned; do
    sed 's/, priority: 1//' $order.yaml >$order-plain.yaml
    expect "$order: equal priorities are told" 0 '' "model '(drink|bottle)' crosses model '(drink|bottle)', and both refract with priority 0.*W418" "$glint" check $order-plain.yaml
    expect "$order: and mended" 0 '' '1 fix made' "$glint" check --fix=all $order-plain.yaml
    expect "$order: for good" 0 - - "$glint" check $order-plain.yaml
done
expect "the drink gives way to its glass" 0 'name: drink.*priority: -1' - cat overlap-plain.yaml
expect "whichever comes first" 0 'glass: .*priority: 1' - cat turned-plain.yaml
sed 's/within.obj/inner.obj/' overlap.yaml >coincident.yaml
expect "coincident faces are told" 0 - "faces of model 'drink' and of model 'bottle' lie in the same plane and overlap.*W410" "$glint" check coincident.yaml
also "and what to do" - "help: let one reach into the other, and give the material of the one that fills that place the higher 'priority'"

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

# A glass that is open above, of points (radius, height) from the middle of its bottom, around and back: drawn as a glass
# with water that reaches into its wall; and as one body up to the water's surface with the water in it, whose faces are those
# between the two.
lathe() {
    awk -v n=24 'BEGIN { pi = 3.14159265358979 }
    { r[NR] = $1; y[NR] = $2 }
    END {
        printf "v 0 %.9g 0\n", y[1]
        for (i = 2; i < NR; i++)
            for (k = 0; k < n; k++)
                printf "v %.9g %.9g %.9g\n", r[i] * cos(2 * pi * k / n), y[i], r[i] * sin(2 * pi * k / n)
        printf "v 0 %.9g 0\n", y[NR]
        last = (NR - 2) * n + 2
        for (k = 0; k < n; k++) {
            j = (k + 1) % n
            print "f", 1, 2 + k, 2 + j
            for (i = 0; i < NR - 3; i++)
                print "f", 2 + i * n + j, 2 + i * n + k, 2 + (i + 1) * n + k, 2 + (i + 1) * n + j
            print "f", last - n + j, last - n + k, last
        }
    }'
}
outside='0 0,0.5 0,0.55 0.5,0.6 1'
cavity='0.5 0.5,0.45 0.1,0 0.1'
echo "$outside,0.55 1,$cavity" | tr , '\n' | lathe >open.obj
echo "0 0.05,0.48 0.05,0.525 0.5,0 0.5" | tr , '\n' | lathe >reaching.obj
echo "$outside,0.55 1,0.5 0.5,0 0.5" | tr , '\n' | lathe >solid.obj
echo "0 0.1,0.45 0.1,0.5 0.5,0.5 0.50001,0 0.50001" | tr , '\n' | lathe >exactly.obj
scene reaching.yaml <<'END'
models:
  - {name: open, mesh: open.obj, material: glass, scale: 1.6, translation: [0, -1, 0]}
  - {name: drink, mesh: reaching.obj, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.33}, scale: 1.6, translation: [0, -1, 0]}
END
scene exactly.yaml <<'END'
models:
  - {name: open, mesh: solid.obj, material: glass, scale: 1.6, translation: [0, -1, 0]}
  - {name: drink, mesh: exactly.obj, material: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.33, priority: 2}, scale: 1.6, translation: [0, -1, 0]}
END
for open in reaching exactly; do
    expect "an open glass, $open" 0 - - "$glint" check $open.yaml
    ok "and its picture" "$glint" render $open.yaml --device reference --as-file --no-cache --size 320x240 -q -o $open.pfm
done
expect "an open glass of water" 0 '' - "$glint" compare reaching.pfm exactly.pfm --max-share 0.001

expect "what a ray is inside" 0 "refracted from 0, weight 0.8, inside sphere 'ball'" - "$glint" pick two.yaml 48,36 --device reference
also "and that it passes" "sphere 'kernel', at .*passes unseen: the medium stays the same" -
expect "the same in JSON" 0 '"inside": "sphere .ball."' - "$glint" pick two.yaml 48,36 --device reference --format json
also "and there" '"passes": true' -
expect "what is lost on the way" 0 'tinted 0\.[0-9]+ 0\.[0-9]+ 0\.' - "$glint" pick coloured.yaml 48,36 --device reference

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

unset GLINT_DEVICE

# The medium of the kernel is that of the ball: each pixel's ray comes to it twice, without being another ray after it.
cat >counted.yaml <<'END'
glint: 1
image: {width: 16, height: 12}
trace: {shadows: false, min_weight: 0}
camera: {position: [0, 0, 5], look_at: [0, 0, 0], fov: 1}
lights: [{position: [0, 9, 5]}]
materials: {glass: {albedo: [0, 0, 0, 1], refractive_index: 1.5}}
spheres:
  - {center: [0, 0, 0], radius: 1, material: glass}
  - {center: [0, 0, 0], radius: 0.5, material: glass}
END
for device in $devices; do
    [ "$device" = 0 ] || export GLINT_DEVICE="$device"
    expect "a ray that goes on unseen" 0 '"unseen_crossings": 384,' - "$glint" render counted.yaml --stats=json --count-rays -q -o counted.png
    also "is still the same ray" '"refracted": 384,' -
    also "from the camera too" '"primary": 192,' -
    expect "the same in words" 0 - 'unseen crossings +384$' "$glint" render counted.yaml --stats --count-rays -q -o counted.png
done
unset GLINT_DEVICE
# The floor's 192 shadow rays each pass through the ball and, unseen, through its kernel.
cat >shone.yaml <<'END'
glint: 1
image: {width: 16, height: 12}
trace: {transparent_shadows: true, min_weight: 0}
camera: {position: [0, -1.5, 0], look_at: [0, -2, 0], fov: 1}
lights: [{position: [0, 9, 0]}]
materials: {glass: {albedo: [0, 0, 0, 1], refractive_index: 1.5}}
spheres:
  - {center: [0, 0, 0], radius: 1, material: glass}
  - {center: [0, 0, 0], radius: 0.5, material: glass}
rectangles: [{corner: [-9, -2, -9], edge_u: [18, 0, 0], edge_v: [0, 0, 18], material: {diffuse_color: 1}}]
END
for device in $devices; do
    [ "$device" = 0 ] || export GLINT_DEVICE="$device"
    expect "a shadow ray that goes on unseen" 0 '"unseen_crossings": 384,' - "$glint" render shone.yaml --stats=json --count-rays -q -o shone.png
    also "is still the same shadow ray" '"shadow": 576,' -
done
unset GLINT_DEVICE

# Nine balls that all cross each other, and nine cubes that do: around the camera, and above it.
{
    echo 'spheres:'
    for i in 1 2 3 4 5 6 7 8 9; do
        echo "  - {center: [0.$i, 0, 0], radius: 1, material: {albedo: [0, 0, 0, 1], refractive_index: 1.$i, priority: $i}}"
    done
} | scene crossing.yaml
expect "a camera in nine that cross each other" 1 - 'the camera is inside 9 bodies that refract; at most 8 may surround a ray \[E501\]' "$glint" check crossing.yaml --set camera.position='[0.5, 0.1, 0]'
for device in $devices; do
    [ "$device" = 0 ] || export GLINT_DEVICE="$device"
    expect "and no picture" 1 - 'the camera is inside 9 bodies that refract.*E501' "$glint" render crossing.yaml --set camera.position='[0.5, 0.1, 0]' -o crossing.pfm
    expect "nor a pick" 1 - 'the camera is inside 9 bodies that refract.*E501' "$glint" pick crossing.yaml 1,1 --set camera.position='[0.5, 0.1, 0]'
done
unset GLINT_DEVICE
[ ! -e crossing.pfm ] || fail "there is a picture all the same"

# box.obj: a cube; lid.obj: the same, and what covers it lets nothing through.
cube='v -1 -1 -1\nv 1 -1 -1\nv 1 -1 1\nv -1 -1 1\nv -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\n'
sides='f 1 2 3 4\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n'
printf "${cube}${sides}f 8 7 6 5\n" >box.obj
printf "${cube}usemtl tank\n${sides}usemtl lid\nf 8 7 6 5\n" >lid.obj
{
    echo 'spheres: [{center: [0, 0, 0], radius: 0.5, material: {albedo: [0, 0, 0, 1], refractive_index: 1.5}}]'
    echo 'models:'
    for i in 1 2 3 4 5 6 7 8 9; do
        echo "  - {mesh: box.obj, scale: [9, 0.5, 9], translation: [0, 3.$i, 0], material: {albedo: [0, 0, 0, 1], refractive_index: 1.$i}}"
    done
} | scene above.yaml
scene tank.yaml <<'END'
models:
  - {name: tank, mesh: lid.obj, material: {albedo: [0, 0, 0, 1], refractive_index: 1.5}, material_map: {lid: floor}}
spheres:
  - {name: bubble, center: [0, 0, -0.5], radius: 0.2, material: {albedo: [0, 0, 0.1, 0.9], refractive_index: 1}}
END
expect "a camera under nine cubes is in none of them" 0 '0  camera, weight 1: spheres' - "$glint" pick above.yaml 44,33 --set camera.position='[0, 2, 0.1]' --device reference
if [ "$devices" != reference ]; then
    # against NAME SCENE OPTION...: device and reference.
    against() {
        name=$1 of=$2
        shift 2
        ok "$name: device" "$glint" render "$of" "$@" --set trace.precision=double -q -o a.pfm
        ok "$name: reference" "$glint" render "$of" "$@" --device reference --as-file --no-cache -q -o b.pfm
        expect "$name" 0 '' - "$glint" compare a.pfm b.pfm --max-share 0
    }
    expect "and on the device" 0 '0  camera, weight 1: spheres' - "$glint" pick above.yaml 44,33 --set camera.position='[0, 2, 0.1]'
    against "a camera below an opaque lid" tank.yaml --set camera.position='[0.03, 0.05, 0.52]'
fi
exit $failed
