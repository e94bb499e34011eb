#!/bin/sh
# glint extremes as a user sees it.
# Usage: run_extremes.sh GLINT SOURCE_FOLDER WORK_FOLDER [whole | light | SCENE...]
# whole: more of the axes, and studies of what can be wrong. light: the axes of what light does. With scenes: each at the
# default bounds, small, the other axes.
. "$(dirname -- "$0")/lib.sh"
shift 3

"$glint" devices | grep -q . || {
    echo "skip: no Vulkan device"
    exit 77
}

mode=${1-}
if [ "$mode" = light ]; then
    # Each axis on what has it and little else: most of the time goes into kernels.
    cat >plain.yaml <<'END'
glint: 1
image: {width: 64, height: 48}
camera: {position: [0.3, 1.1, 5.2], look_at: [0.1, 0.2, 0]}
background: {color: [0.2, 0.3, 0.4]}
lights: [{position: [3.1, 5.3, 2.7]}, {direction: [0.4, -1, -0.3], intensity: 0.4}]
materials:
  floor: {diffuse_color: {checker: {colors: [0.8, 0.2], size: 0.3}}}
spheres: [{center: [0.11, 0.83, 0.07], radius: 0.8}]
rectangles: [{corner: [-4, 0, 4], edge_u: [8, 0, 0], edge_v: [0, 0, -8], material: floor}]
END
    cat >glass.yaml <<'END'
glint: 1
camera: {position: [0.3, 1.1, 5.2], look_at: [0.1, 0.2, 0]}
background: {color: [0.2, 0.3, 0.4]}
trace: {max_depth: 6}
lights: [{direction: [0.4, -1, -0.3]}]
materials:
  glass: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.5}
spheres: [{center: [0.11, 0.83, 0.07], radius: 0.8, material: glass}]
rectangles: [{corner: [-4, 0, 4], edge_u: [8, 0, 0], edge_v: [0, 0, -8]}]
END
    expect "what light does, at its ends" 0 ' 0 left out, 0 broken, ' '' "$glint" extremes plain.yaml --size 48x36 -q \
        --axis light_radius,light_angle,aperture,focus,texture,occlusion,emission,error,min_samples
    # radius, angle, aperture, focus twice, texture twice, occlusion, emission
    ok "each is its limit there" test "$(grep -cE ' 0\.00[0-9]*  *$' out.txt)" -eq 9
    expect "rough glass, coloured glass and balls in balls" 0 ' 0 left out, 0 broken, ' '' \
        "$glint" extremes glass.yaml --size 48x36 -q --axis roughness,density,nested
    ok "as well" test "$(grep -cE ' 0\.00000 *$' out.txt)" -eq 4
    # A scaled scene gives the same picture: its lens is scaled too, and so is what an orthographic
    # camera takes in and how far occlusion reaches.
    sed '/^camera:/d' plain.yaml >body.yaml
    { cat body.yaml && echo 'camera: {position: [0.3, 1.1, 5.2], look_at: [0.1, 0.2, 0], projection: orthographic, size: 3}'; } >flat.yaml
    { cat plain.yaml && echo 'ambient: {color: [1, 1, 1], intensity: 0.5, occlusion: 0.7}'; } >near.yaml
    { cat body.yaml && echo 'camera: {position: [0.3, 1.1, 5.2], look_at: [0.1, 0.2, 0], aperture: 0.4, focus: 2}'; } >lens.yaml
    { cat body.yaml && echo 'camera: {position: [0.3, 1.1, 5.2], look_at: [0.1, 0.2, 0], aperture: 0.4, focus_at: [0.1, 0.8, 2]}'; } >point.yaml
    for kind in near flat lens point; do
        expect "scaled: $kind" 0 ' 0 left out, 0 broken, ' '' "$glint" extremes $kind.yaml --size 48x36 -q --axis scale
    done
    sed 's/^lights: .*/lights: [{direction: [0.4, -1, -0.3], angle: 5}]/' plain.yaml >disc.yaml
    expect "a sun that comes down to a surface" 0 ' 0 left out, 0 broken, ' '' "$glint" extremes disc.yaml --size 24x18 -q --axis light
    printf 'v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n' >square.obj
    { sed '/^lights:/d; /^spheres:/d' plain.yaml && cat <<'END'; } >panel.yaml
lights: [{rectangle: {corner: [-1, 4, -1], edge_u: [2, 0, 0], edge_v: [0, 0.5, 2]}}]
models: [{mesh: square.obj, scale: [1.5, 0.8, 3], rotation: [-50, 25, 10], translation: [0.1, 1, 0]}]
END
    expect "a panel and a camera on a turned model" 0 '^12 cells, 0 left out, 0 broken' '' "$glint" extremes panel.yaml --size 24x18 -q \
        --axis light,camera
    expect "an axis that the scene lacks" 0 'left out: no material reflects or refracts' '' "$glint" extremes plain.yaml --size 24x18 -q --axis roughness
    exit $failed
fi
if [ $# -gt 0 ] && [ "$mode" != whole ]; then
    for scene; do
        expect "$scene keeps the default bounds" 0 ' 0 broken, ' '' "$glint" extremes "$source/$scene" --size 96x72 -q \
            --axis move,scale,distance,index,exponent,sliver,light,camera,coplanar,gap
    done
    exit $failed
fi

cat >scene.yaml <<'END'
glint: 1
image: {width: 64, height: 48}
camera: {position: [0.3, 1.1, 5.2], look_at: [0.1, 0.2, 0]}
background: {color: [0.2, 0.3, 0.4]}
trace: {max_depth: 4}
lights: [{position: [3.1, 5.3, 2.7]}]
materials:
  floor: {diffuse_color: [0.5, 0.6, 0.7]}
spheres:
  - {center: [0.11, 0.83, 0.07], radius: 0.8}
rectangles:
  - {corner: [-4, 0, 4], edge_u: [8, 0, 0], edge_v: [0, 0, -8], material: floor}
END

if [ "$mode" = whole ]; then
    printf 'all:\n  - {error: 100}\nscale:\n  - {to: 1.0e-6, error: 0}\n' >strict.yaml
    expect "a broken bound" 1 '^  scaled by 1e-06: mean absolute difference .*, at most 0' - "$glint" extremes scene.yaml --axis scale --size 24x16 -q --thresholds strict.yaml
    also "only where it holds" '^13 cells, 0 left out, 1 broken' -
    # What is measured can be wrong: other tracers' ways are.
    expect "leaks" 1 '^  gap between plates 1e-05: leaks per million [1-9]' - "$glint" extremes scene.yaml --axis gap --size 24x16 -q --study 'offset 1e-3'
    expect "self-hits" 1 '^  scaled by 1000000: self-hits per million [1-9]' - "$glint" extremes scene.yaml --axis scale --size 24x16 -q --study 'offset 1e-7'
    expect "missing triangles" 1 '^  scaled by 1e-06: wrong hits per million, at silhouettes [1-9]' - "$glint" extremes scene.yaml --axis scale --size 24x16 -q --study moeller-trumbore
    # Not by the first ray: the tips of a tetrahedron are thinner than the offset, and mirrors send rays there.
    printf 'v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >tetra.obj
    cat >room.yaml <<'END'
glint: 1
camera: {position: [0.0001, 0.0001, 0.0002], look_at: [-1, 0.4, -1], fov: 90}
background: {color: [0.2, 0.3, 0.4]}
trace: {max_depth: 12}
lights: [{position: [0.0001, 0.0003, 0.0002]}]
materials:
  mirror: {albedo: {diffuse: 0.1, reflection: 0.9}}
models:
  - {mesh: tetra.obj, material: mirror, rotation: [13, 29, 41], scale: 0.001}
END
    expect "escapes" 1 'escapes out of closed bodies per million [1-9]' - "$glint" extremes room.yaml --axis coplanar --size 24x16 -q --study 'offset 1e-4'
    ok "which no first ray shows" sh -c '! grep -q "^  copl.*holes" out.txt'
    expect "none by glint's own ways" 0 '^4 cells, 0 left out, 0 broken' - "$glint" extremes room.yaml --axis coplanar --size 24x16 -q --format text
    expect "JSON" 0 '"axis": "camera", "value": 0.001, "precision": "single"' - "$glint" extremes scene.yaml --axis camera --size 24x16 -q --format json
    expect "a report" 0 'cells' - "$glint" extremes scene.yaml --axis light,gap --size 24x16 -q -o report.html
    expect "its matrix" 0 '<svg ' '' cat report.html
    ok "a title for each cell" test "$(grep -c '<title>' report.html)" -eq 12
    exit $failed
fi

expect "an unknown axis" 2 - "did you mean 'scale'" "$glint" extremes scene.yaml --axis scal
expect "an unknown kind" 2 - 'csv' "$glint" extremes scene.yaml --format csv
expect "no axis" 2 - 'names no axis' "$glint" extremes scene.yaml --axis ''
expect "the reference is no device to measure" 2 - 'choose a device' "$glint" extremes scene.yaml --device reference
expect "a report of another kind" 2 - 'must end in \.html' "$glint" extremes scene.yaml -o report.txt
expect "a missing file of bounds" 3 - 'none.yaml:1:1: error: the file of bounds' "$glint" extremes scene.yaml --thresholds none.yaml
printf 'move:\n  - {of: 0.1}\n  - {off: -1}\nscal:\n  - {off: 0}\nlight: 3\n' >bad.yaml
expect "an unknown metric" 1 - "^bad.yaml:2:6: error: there is no metric 'of'" "$glint" extremes scene.yaml --thresholds bad.yaml
expect "a bad bound" 1 - '^bad.yaml:3:11: error: a bound must be a number that is not negative' "$glint" extremes scene.yaml --thresholds bad.yaml
expect "an unknown axis of bounds" 1 - "^bad.yaml:4:1: error: there is no axis 'scal'" "$glint" extremes scene.yaml --thresholds bad.yaml
expect "no list of bounds" 1 - '^bad.yaml:6:8: error: an axis must have a list of bounds' "$glint" extremes scene.yaml --thresholds bad.yaml
printf 'move:\n  - {from: 10, to: 1, off: 0}\n  - {to: 1}\n' >empty.yaml
: >void.yaml
expect "no bound at all" 1 - '^void.yaml:1:1: error: the file contains no bounds' "$glint" extremes scene.yaml --thresholds void.yaml
expect "a bound that holds nowhere" 1 - "^empty.yaml:2:5: error: 'from' is above 'to'" "$glint" extremes scene.yaml --thresholds empty.yaml
expect "a bound of nothing" 1 - '^empty.yaml:3:5: error: this bounds nothing' "$glint" extremes scene.yaml --thresholds empty.yaml
expect "a missing scene" 3 - 'error' "$glint" extremes missing.yaml

# Told before the work, which would take longer than this.
expect "a report that cannot be written" 3 - 'E802' within 20 "$glint" extremes "$source/scenes/showcase.glint.yaml" -o nowhere/r.html
printf 'mtllib none.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >tri.obj
{ cat scene.yaml && echo 'models: [{mesh: tri.obj}]'; } >mesh.yaml
expect "gaps" 0 '^5 cells, 0 left out, 0 broken' 'tri.obj:1:1: warning: .*\[W601\]' "$glint" extremes mesh.yaml --axis gap --size 24x16 -q -o report.html
expect "their matrix" 0 '<svg ' '' cat report.html
ok "a title for each gap" test "$(grep -c "<title>" report.html)" -eq 6
expect "an axis that the scene lacks" 0 'left out: no material refracts' - "$glint" extremes scene.yaml --axis index --size 24x16 -q
printf 'all:\n  - {error: 0}\n' >strict.yaml
expect "broken bounds" 1 '"broken": 5,' '' "$glint" extremes scene.yaml --axis gap --size 24x16 -q --thresholds strict.yaml --format json
also "JSON" '"axis": "gap", "value": .*"precision": "single"' ''
also "no escapes where nothing is mirrored or refracted" '"holes": 0(\.0)?, "not_finite"' ''
expect "an unknown study" 2 - "did you mean 'offset 1e-3'" "$glint" extremes scene.yaml --study 'offset 1e-2'
exit $failed
