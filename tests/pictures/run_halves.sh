#!/bin/sh
# The same shape said in two ways is the same picture, to the bit and in both precisions: a box and six rectangles, a cylinder and a
# cone of two equal radii. Shapes, places and materials are random, four of each in a picture; numbers of boxes are multiples of 1/64, so
# that both ways have the same corners. Usage, as cli/lib.sh has it: run_halves.sh GLINT SOURCE_FOLDER WORK_FOLDER.
. "$(dirname -- "$0")/../cli/lib.sh"
"$glint" devices | grep -q . || exit 77
scene() { # KIND SEED
    echo 'glint: 1
image: {width: 96, height: 64, samples: 2}
background: {color: [0.3, 0.4, 0.5]}
camera: {position: [1, 2.5, 8], look_at: [0, 0, 0], fov: 45}
lights: [{position: [-5, 8, 6], intensity: 1.2}, {direction: [-1, -2, -0.5], intensity: 0.5}]
materials:
  paint: {albedo: [0.7, 0.4, 0.2, 0], diffuse_color: [0.7, 0.3, 0.2], specular_exponent: 30}
  steel: {albedo: [0, 0.8, 0.7, 0], specular_exponent: 200}
  glass: {albedo: [0, 0.4, 0.1, 0.85], refractive_index: 1.5}'
    awk -v kind="$1" -v seed="$2" '
    function part(least, most) { return (int(64 * (least + (most - least) * rand())) + 0.0) / 64 }
    function rectangle(x, y, z, a, b, c, d, e, f) {
        printf "  - {corner: [%.9g, %.9g, %.9g], edge_u: [%.9g, %.9g, %.9g], edge_v: [%.9g, %.9g, %.9g], material: %s}\n", x, y, z, a, b, c, d, e, f, m
    }
    BEGIN {
        srand(seed)
        split("paint steel glass", materials, " ")
        print kind ":"
        for (i = 0; i < 4; i++) {
            m = materials[1 + int((kind == "boxes" || kind == "rectangles" ? 2 : 3) * rand())]
            x = part(-2, 2); y = part(-1, 1); z = part(-2, 2); a = part(0.25, 1); b = part(0.25, 1); c = part(0.25, 1)
            if (kind == "boxes")
                printf "  - {center: [%.9g, %.9g, %.9g], size: [%.9g, %.9g, %.9g], material: %s}\n", x, y, z, 2 * a, 2 * b, 2 * c, m
            else if (kind == "rectangles") {
                rectangle(x - a, y - b, z + c, 2 * a, 0, 0, 0, 2 * b, 0)
                rectangle(x + a, y - b, z - c, -2 * a, 0, 0, 0, 2 * b, 0)
                rectangle(x + a, y - b, z + c, 0, 0, -2 * c, 0, 2 * b, 0)
                rectangle(x - a, y - b, z - c, 0, 0, 2 * c, 0, 2 * b, 0)
                rectangle(x - a, y + b, z + c, 2 * a, 0, 0, 0, 0, -2 * c)
                rectangle(x - a, y - b, z - c, 2 * a, 0, 0, 0, 0, 2 * c)
            } else
                printf "  - {from: [%.9g, %.9g, %.9g], to: [%.9g, %.9g, %.9g], %s, material: %s}\n", x, y, z, x + 2 * rand(), y + rand() + 0.1,
                    z - rand(), kind == "cones" ? "radius_from: " a / 2 ", radius_to: " a / 2 : "radius: " a / 2, m
        }
    }'
}
for seed in 1 2 3; do
    for pair in "boxes rectangles" "cylinders cones"; do
        for precision in single double; do
            for kind in $pair; do
                scene "$kind" "$seed" >"$kind.glint.yaml"
                expect "$kind, seed $seed, $precision" 0 '' '' "$glint" render -q "$kind.glint.yaml" --set trace.precision=$precision -o "$kind.pfm"
            done
            expect "$pair are the same" 0 '' '' cmp "${pair% *}.pfm" "${pair#* }.pfm"
        done
    done
done
exit $failed
