#!/bin/sh
# glint pick as a user sees it, and faults of numbers from the picture to the path that shows them.
# Usage: run_pick.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

# A glass ball before a mirror of one quad, on a floor, two lights; the camera looks along -z.
printf 'v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\n# a mirror\nusemtl front\nf 1 2 3 4\n' >wall.obj
cat >scene.yaml <<'END'
glint: 1
image: {width: 64, height: 64}
camera: {position: [0, 0, 4]}
background: {color: 0.25}
trace: {max_depth: 6}
lights:
  - {name: sun, direction: [0, -1, -0.2]}
  - {position: [0, -5, 0]}
materials:
  glass: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.5}
  mirror: {albedo: [0.1, 0, 0.9, 0]}
spheres:
  - {name: ball, center: [0, 0, 0], radius: 1, material: glass}
rectangles:
  - {corner: [-9, -3, 9], edge_u: [18, 0, 0], edge_v: [0, 0, -18]}
models:
  - {name: wall, mesh: wall.obj, material: mirror, translation: [0, 0, -6]}
END

expect "a place outside" 2 - 'from 0,0 to 63,63' "$glint" pick scene.yaml 64,0 --device reference
expect "a place below 0" 2 - '^command-line:1:23: .*option .-1,600' "$glint" pick scene.yaml -1,600 --device reference
expect "told once" 0 '^1$' - sh -c '"$0" pick scene.yaml -1,600 2>&1 | grep -c error:' "$glint"
expect "no place" 2 - "such as 320,200, not '1;2'" "$glint" pick scene.yaml '1;2' --device reference
expect "an unknown kind" 2 - 'xml' "$glint" pick scene.yaml 1,2 --device reference --format xml
printf 'glint: 9\n' >bad.yaml
expect "a broken scene" 1 - 'bad.yaml:1:8: error' "$glint" pick bad.yaml 1,2 --device reference
expect "a missing scene" 3 - 'error' "$glint" pick missing.yaml 1,2 --device reference
expect "the reference alone" 0 "^sees       sphere 'ball', scene.yaml:13:12" - "$glint" pick scene.yaml 32,32 --device reference
also "its material" "^with       material 'glass', scene.yaml:10:3" -
expect "the line of a mesh" 0 '^face       triangle [01], wall.obj:7$' - "$glint" pick scene.yaml 20,10 --device reference
expect "the background" 0 '^sees       the background' - "$glint" pick scene.yaml 32,0 --device reference --set 'models='

if "$glint" devices | grep -q .; then
    expect "two paths" 0 '^differences: 0$' - "$glint" pick scene.yaml 32,32
    also "a refracted ray" '^ +[0-9]+  refracted from 0, weight 0.8: sphere .ball., at 1.9' -
    also "a cut ray" 'the background, stopped by max_depth' -
    expect "another sample" 0 'sample 2 of 4$' - "$glint" pick scene.yaml 32,32 --sample 2 --set image.samples=4
    also "the colours of all" '^sample 3   .* \(device\), .* \(reference\)$' -
    expect "no such sample" 2 - 'the picture has 1 sample per pixel, counted from 0' "$glint" pick scene.yaml 32,32 --sample 1
    expect "a shadow" 0 "rectangles\[0\], at [0-9.]+; 'sun' in shadow; adds 0 0 0" - "$glint" pick scene.yaml 32,63
    expect "a light below" 0 "rectangles\[0\], at [0-9.]+; 'sun' lit; adds 0\.[0-9]" - "$glint" pick scene.yaml 4,62
    # Below what single precision resolves: a plane behind another is met, and a lid under a lamp not seen.
    cat >behind.yaml <<'END'
glint: 1
image: {width: 64, height: 64}
camera: {position: [0, 0, 3]}
trace: {precision: single}
lights: [{position: [0, 0, 9]}]
rectangles:
  - {name: behind, corner: [-2, -2, -1.0e-9], edge_u: [4, 0, 0], edge_v: [0, 4, 0]}
  - {name: before, corner: [-2, -2, 0], edge_u: [4, 0, 0], edge_v: [0, 4, 0]}
END
    expect "another body" 0 "the reference, ray 0, has rectangle 'before'" - "$glint" pick behind.yaml 32,32
    expect "its kind" 0 '"of": "body"' - "$glint" pick behind.yaml 32,32 --format json
    cat >lid.yaml <<'END'
glint: 1
image: {width: 64, height: 64}
camera: {position: [0, -3, 0.7], look_at: [0, 0, 0], up: [0, 0, 1], fov: 20}
trace: {precision: single}
lights: [{name: lamp, position: [0, 0, 1]}]
rectangles:
  - {corner: [-2, -2, 0], edge_u: [4, 0, 0], edge_v: [0, 4, 0]}
  - {corner: [-0.5, -0.5, 0.999999999], edge_u: [1, 0, 0], edge_v: [0, 1, 0]}
END
    expect "another light" 0 "the reference, ray 0, .*; 'lamp' in shadow" - "$glint" pick lid.yaml 32,32
    expect "that is a difference of lights" 0 '"of": "lights"' - "$glint" pick lid.yaml 32,32 --format json
    # Cells that single precision cannot tell apart: the same place and the same light, but another colour.
    cat >cells.yaml <<'END'
glint: 1
image: {width: 8, height: 8}
camera: {position: [0, 0, 10000.3], fov: 1}
trace: {precision: single}
lights: [{direction: [0, 0, -1]}]
rectangles:
  - corner: [-900, -900, 0]
    edge_u: [1800, 0, 0]
    edge_v: [0, 1800, 0]
    material: {diffuse_color: {checker: {colors: [1, 0.25], size: 0.000001}}}
END
    for x in 0 1 2 3 4 5 6 7; do "$glint" pick cells.yaml $x,1; done >cells.txt 2>/dev/null
    expect "another colour" 0 'ray 0: the device has rectangles\[0\].*, colour (1 1 1|0.25 0.25 0.25)$' - cat cells.txt
    also "and the reference's" '^    the reference, ray 0, has rectangles\[0\].*, colour (1 1 1|0.25 0.25 0.25)$' -
    expect "JSON" 0 '"difference_count": 0' - "$glint" pick scene.yaml 32,32 --format json
    expect "JSON's mesh line" 0 '"mesh_line": 7' - "$glint" pick scene.yaml 20,10 --format json

    # Thousands of rays between panes: what lies behind the last ray told is no difference.
    cat >panes.yaml <<'END'
glint: 1
image: {width: 8, height: 8, samples: 2}
camera: {position: [0, 0, 4]}
background: {color: 0.25}
trace: {max_depth: 20, min_weight: 0}
materials:
  pane: {albedo: [0, 0, 0.5, 0.5]}
rectangles:
  - {corner: [-9, -9, 0], edge_u: [18, 0, 0], edge_v: [0, 18, 0], material: pane}
  - {corner: [-9, -9, -1], edge_u: [18, 0, 0], edge_v: [0, 18, 0], material: pane}
  - {corner: [-9, -9, -2], edge_u: [18, 0, 0], edge_v: [0, 18, 0], material: pane}
  - {corner: [-9, -9, -3], edge_u: [18, 0, 0], edge_v: [0, 18, 0], material: pane}
  - {corner: [-9, -9, -4], edge_u: [18, 0, 0], edge_v: [0, 18, 0], material: pane}
END
    expect "a path that is not told whole" 0 '^differences: 0$' - "$glint" pick panes.yaml 4,4
    also "its colour" '^colour .*\(single precision, of the first 4096 rays\)$' -
    also "and of each sample" '^sample 1 .*\(device, of the first 4096 rays\), .* \(reference\)$' -
    expect "one that is" 0 '^sample 1 .*\(device\), .* \(reference\)$' - "$glint" pick panes.yaml 4,4 --set trace.max_depth=8

    # Values that a float does not hold, from attributes inside their ranges: weights that grow from mirror to
    # mirror, a background, a sum of samples, a light at a hair's breadth.
    sed 's/0.1, 0, 0.9, 0/0, 0, 1.0e6, 0/; s/translation: \[0, 0, -6\]/translation: [0, 0, -6]}\n  - {mesh: wall.obj, material: mirror, translation: [0, 0, 9]/; /^spheres:/d; /ball/d; s/max_depth: 6/max_depth: 20/' scene.yaml >mirrors.yaml
    expect "growing weights" 1 - "^mirrors.yaml:1[3-6]:[0-9]+: error: [0-9]+ pixels got a value that is infinite or not a number, the first at [0-9]+,[0-9]+, where the ray last hit model" "$glint" render mirrors.yaml -o mirrors.pfm
    also "the line of the mesh" - 'note: the face there is at line 7 of wall.obj'
    also "the line of the material" - "^mirrors.yaml:11:3: note: its material 'mirror'"
    expect "what helps" 1 - "magenta in PNG and HDR, and NaN in PFM; 'glint pick SCENE" "$glint" render mirrors.yaml -o mirrors.png
    expect "the marked pixels" 0 '^[1-9][0-9]* pixels are infinite or not a number' - "$glint" compare mirrors.pfm mirrors.pfm
    expect "the path" 0 'colour     .*: infinite or not a number \(single precision\)' - "$glint" pick mirrors.yaml 32,32
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\377\377\377\377' >sky.hdr
    sed 's/background: .*/background: {image: sky.hdr, intensity: 4}/' scene.yaml >sky.yaml
    expect "a background" 1 - 'pixels got a value that is infinite.*E706' "$glint" render sky.yaml -o sky.pfm
    expect "seen at once" 1 - 'E706' "$glint" render sky.yaml -o sky.pfm --set 'models=' --set 'spheres=' --set 'rectangles='
    expect "a sum of samples" 1 - 'E706' "$glint" render sky.yaml -o sky.pfm --samples 4 --set 'background.intensity=1.5' --set 'models=' --set 'spheres=' --set 'rectangles='
    expect "by the reference" 1 - '256 pixels got a value that is too large for a float, the first at 0,0 \[E706\]' "$glint" render sky.yaml -o sky.pfm --device reference --no-cache --size 16x16 --set 'models=' --set 'spheres=' --set 'rectangles='
    expect "each of them is finite" 0 - 'wrote sky.pfm' "$glint" render sky.yaml -o sky.pfm --set 'background.intensity=1.5' --set 'models=' --set 'spheres=' --set 'rectangles='
    cat >near.yaml <<'END'
glint: 1
image: {width: 16, height: 16}
camera: {}
lights: [{position: [0, 0, 0], intensity: 1.0e6, color: 1.0e6, falloff: inverse_square}]
rectangles:
  - {corner: [-1.0e-17, -1.0e-17, -1.0e-17], edge_u: [2.0e-17, 0, 0], edge_v: [0, 2.0e-17, 0], material: {diffuse_color: 1.0e6}}
END
    expect "a light nearby" 1 - "near.yaml:6:5: error: .*the ray last hit rectangles\[0\] \[E706\]" "$glint" render near.yaml -o near.pfm
    also "its material" - "near.yaml:6:[0-9]+: note: its inline material"
else
    echo "skip: no Vulkan device"
fi
exit $failed
