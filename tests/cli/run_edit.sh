#!/bin/sh
# What changes files, and what tells changes: format, check --fix, diff.
# Usage: run_edit.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

# ---- format
printf 'glint:  1\n# a comment\nimage: { width: 3 }\n' >loose.glint.yaml
printf 'glint: 1\n# a comment\nimage: {width: 3}\n' >tight.yaml
cp loose.glint.yaml kept.yaml
expect "format --check names a file" 1 '^loose.glint.yaml$' - "$glint" format --check loose.glint.yaml tight.yaml
mkdir -p linked elsewhere
printf 'glint:   1\n' >elsewhere/a.glint.yaml
cp elsewhere/a.glint.yaml linked.yaml
ln -s ../elsewhere/a.glint.yaml linked/a.glint.yaml
printf 'secret:   [\n' >elsewhere/secret
ln -s ../elsewhere/secret linked/b.glint.yaml
expect "format of a folder with links out of it" 3 - 'linked/a.glint.yaml:1:1: error: the scene file lies outside .*E602' "$glint" format linked
expect "quotes nothing of it" 1 - - grep -q secret: err.txt
same "and writes nothing there" elsewhere/a.glint.yaml linked.yaml
expect "nor shows it" 3 - E602 "$glint" format --diff linked
expect "a link that is named is formatted" 0 - - "$glint" format linked/a.glint.yaml
expect "in its place" 0 '^glint: 1$' - cat elsewhere/a.glint.yaml
rm -r linked elsewhere
expect "format --check of a folder" 1 '^./loose.glint.yaml$|^loose.glint.yaml$' 'warning: this begins as a scene does, .*W803' "$glint" format --check .
expect "format --check of good files" 0 - - "$glint" format --check tight.yaml
expect "format --diff" 0 '^-glint:  1$' - "$glint" format --diff loose.glint.yaml
expect "format --check --diff" 1 '^[+]image: .width: 3.$' - "$glint" format --check --diff loose.glint.yaml
same "--check and --diff write nothing" loose.glint.yaml kept.yaml
expect "format to standard output" 0 '^image: .width: 3.$' - "$glint" format loose.glint.yaml -o -
expect "format to a file" 0 - - "$glint" format loose.glint.yaml -o out.yaml
same "format to a file writes it" out.yaml tight.yaml
"$glint" format - <loose.glint.yaml >piped.yaml 2>err.txt || failed=1
same "format from standard input" piped.yaml tight.yaml
printf '<Scene   glint="1"/>' | "$glint" format - >piped.xml
printf '<Scene glint="1"/>' >want.xml
same "XML from standard input" piped.xml want.xml
expect "format in place" 0 - - "$glint" format loose.glint.yaml
same "format in place writes it" loose.glint.yaml tight.yaml
expect "format --upgrade of today's version" 0 - - "$glint" format --upgrade --check loose.glint.yaml
printf 'glint: [1\n' >broken.yaml
expect "format of what cannot be read" 1 - 'broken.yaml:1:8: error: .*E101' "$glint" format broken.yaml
expect "format of a missing file" 3 - 'missing.yaml:1:1: error' "$glint" format missing.yaml
expect "-o with two files" 2 - 'one file' "$glint" format tight.yaml kept.yaml -o x
printf 'glint: 1\ncamera: {fvo: 1}\nimage:   {}\n' >wrong.yaml
expect "mistakes of meaning do not matter" 1 '^wrong.yaml$' - "$glint" format --check wrong.yaml
expect "the scenes that ship are formatted" 0 - - "$glint" format --check "$source/scenes"

# ---- check --fix
cat >fix.yaml <<'S'
glint: 1
image: {width: 0100, height: 20}
camrea: {position: [0, 0, 1], fvo: 50}
background: {color: #ff0000}
trace: {shadows: yes, max_depth: 8}
spheres:
	- {center: [0, 0, 0], radius: 1, material: 'rde'}
	- {center: [3, 0, 0], radius: 1, material: red}
materials:
  red: {diffuse_color: 0.5}
S
cat >fixed.yaml <<'S'
glint: 1
image: {width: 100, height: 20}
camera: {position: [0, 0, 1], fov: 50}
background: {color: "#ff0000"}
trace: {shadows: true, max_depth: 8}
spheres:
  - {center: [0, 0, 0], radius: 1, material: 'red'}
  - {center: [3, 0, 0], radius: 1, material: red}
materials:
  red: {diffuse_color: 0.5}
S
cp fix.yaml kept.yaml
expect "--diff alone shows what --fix would write" 1 '^[+]camera: .position: .0, 0, 1., fov: 50.$' 'error' "$glint" check --diff fix.yaml
same "--diff alone writes nothing" fix.yaml kept.yaml
expect "--fix takes 'all'" 2 - "takes 'all'" "$glint" check --fix=most fix.yaml
expect "check --fix --diff" 1 '^[+]camera: .position: .0, 0, 1., fov: 50.$' 'error' "$glint" check --fix --diff fix.yaml
same "check --fix --diff writes nothing" fix.yaml kept.yaml
"$glint" check --fix --diff fix.yaml 2>err.txt >fix.patch
cp fix.yaml patched.yaml
if command -v patch >command.txt 2>&1; then
    patch -s patched.yaml fix.patch || failed=1
    same "the patch does the same" patched.yaml fixed.yaml
fi
expect "check --fix" 0 - 'fix.yaml: 7 fixes made' "$glint" check --fix fix.yaml
same "check --fix writes the file" fix.yaml fixed.yaml
expect "nothing is left to fix" 0 - - "$glint" check --fix fix.yaml

printf 'glint: 1\nspheres: [{center: 0, radius: 1}, {radius: 1, centre: [0, 0, 0], material: "a&b"}]\n' >more.yaml
sed 's/centre/center/' more.yaml >safe.yaml
sed 's/center: 0/center: [0, 0, 0]/' safe.yaml >all.yaml
expect "--fix makes what is safe alone" 1 - 'more.yaml: 1 fix made' "$glint" check --fix more.yaml
same "and no suggestion" more.yaml safe.yaml
expect "--fix=all makes suggestions" 1 - 'more.yaml: 1 fix made' "$glint" check --fix=all more.yaml
same "the suggestion is written" more.yaml all.yaml
printf '<Scene glint="1"><Image width="3" / ><Light intensity="2"><position x="0" y="1" z="2"/></Light><Modle mesh="a.obj"><Scale x="1" y="2" z="1"/></Modle></Scene>' >fix.xml
sed 's, / >, />,;s,<position,<Position,;s,Modle,Model,g' fix.xml >want.xml
"$glint" check --fix fix.xml >out.txt 2>err.txt
same "check --fix of XML" fix.xml want.xml

# What people write who come from elsewhere.
cat >habits.yaml <<'S'
camera:
  position:[0, 0, 8]
  fov:45
background: {color: [255, 128, 0]}
materials:
  “glass”: {diffuse_color: “#f80”, specular_color: red}
spheres:
  - {center: (0, -1.5, -2), radius: 1,5, material: glass}
  - {center: [3, 0, −2], radius: 1, material: glass}
models: []
S
cat >mended.yaml <<'S'
glint: 1
camera:
  position: [0, 0, 8]
  fov: 45
background: {color: "#ff8000"}
materials:
  glass: {diffuse_color: "#ff8800", specular_color: "#ff0000"}
spheres:
  - {center: [0, -1.5, -2], radius: 1.5, material: glass}
  - {center: [3, 0, -2], radius: 1, material: glass}
models: []
S
expect "check --fix=all of habits" 0 - 'fixes made' "$glint" check --fix=all habits.yaml
same "habits are mended" habits.yaml mended.yaml

cat >habits.xml <<'S'
<scene description="a & b">
  <Camera position="0 0 8" fov="40" lookat='0,0,0'/>
  <Light position="(0, 10, 5)" intensity="2" name="a_b">
  </Light>
  <Material name="red" albedo="1,0,0,0" diffuse_color="1 0 0" specular_exponent="8"/>
  <Sphere radius="1" material="red" center="0 0 0" />
</scene>
S
cat >mended.xml <<'S'
<Scene glint="1" description="a &amp; b">
  <Camera fov="40"><Position x="0" y="0" z="8"/><LookAt x="0" y="0" z="0"/></Camera>
  <Light intensity="2" name="a_b"><Position x="0" y="10" z="5"/>
  </Light>
  <Material name="red" specular_exponent="8"><Albedo diffuse="1"/><DiffuseColor r="1" g="0" b="0"/></Material>
  <Sphere radius="1" material="red"><Center x="0" y="0" z="0"/></Sphere>
</Scene>
S
expect "check --fix of habits in XML" 0 - 'fixes made' "$glint" check --fix habits.xml
same "habits in XML are mended" habits.xml mended.xml

# All or nothing, and only where the file can be read afterwards.
printf 'glint: 1\ncamrea: {fov: 3}\nimage: {width: 3\n' >half.yaml
cp half.yaml kept.yaml
expect "a file that stays broken" 1 - 'not changed: the fixes would' "$glint" check --fix half.yaml
same "is not written" half.yaml kept.yaml

# A mistake in an included file is mended there.
printf 'glint: 1\ninclude: [part.yaml]\nspheres: [{center: [0, 0, 0], radius: 1, material: rde}]\n' >main.yaml
printf 'glint: 1\nmaterials: {red: {albdo: [1, 0, 0, 0]}}\n' >part.yaml
expect "check --fix over an include" 0 - 'part.yaml: 1 fix made' "$glint" check --fix main.yaml
expect "both are mended" 0 'albedo' - cat part.yaml

# ---- diff
cat >a.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5]}
materials:
  glass: {refractive_index: 1.5}
  red: {diffuse_color: [1, 0, 0]}
spheres:
  - {center: [0, 0, 0], radius: 1, material: glass}
  - {center: [2, 0, 0], radius: 1, material: red}
S
"$glint" convert a.yaml a.xml || failed=1
expect "twins do not differ" 0 - - "$glint" diff a.yaml a.xml
expect "a default that is written is no difference" 0 - - sh -c "sed 's/5\]}/5], fov: 60}/' a.yaml >b.yaml; '$glint' diff a.yaml b.yaml"
sed 's/index: 1.5/index: 1.33/' a.yaml >b.yaml
expect "a value that changed" 1 '^changed materials.glass.refractive_index: 1.5 -> 1.33$' - "$glint" diff a.yaml b.yaml
expect "its places" 1 '^    b.yaml:4:29$' - "$glint" diff a.xml b.yaml
expect "its place in XML" 1 '^    a.xml:[0-9]+:[0-9]+$' - "$glint" diff a.xml b.yaml
sed 's/glass/crystal/' a.yaml >b.yaml
expect "a material that was renamed" 1 '^renamed materials.glass -> materials.crystal$' - "$glint" diff a.yaml b.yaml
expect "and nothing else" 1 '^1 difference$' - "$glint" diff a.yaml b.yaml
sed 's/material: red/material: {diffuse_color: [1, 0, 0]}/' a.yaml >b.yaml
expect "a material in place of its name is no difference" 0 - - "$glint" diff a.yaml b.yaml
sed '$d' a.yaml >b.yaml
expect "a body that went" 1 '^removed spheres.1.: .center: .2, 0, 0., radius: 1, material: red.$' - "$glint" diff a.yaml b.yaml
expect "a body that came" 1 '^added spheres.1.' - "$glint" diff b.yaml a.yaml
sed -n '1,6p' a.yaml >b.yaml
sed -n 8p a.yaml >>b.yaml
sed -n 7p a.yaml >>b.yaml
expect "a body that moved" 1 '^moved spheres' - "$glint" diff a.yaml b.yaml
# A path is the file that it names.
mkdir -p shapes/deep
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >shapes/pane.obj
printf 'glint: 1\nmodels: [{mesh: shapes/pane.obj}]\n' >a-mesh.yaml
printf 'glint: 1\nmodels: [{mesh: pane.obj}]\n' >shapes/mesh.yaml
expect "one mesh by two paths" 0 - - "$glint" diff a-mesh.yaml shapes/mesh.yaml
cp shapes/pane.obj shapes/deep/
cp shapes/mesh.yaml shapes/deep/
expect "two meshes by one path" 1 '^changed models.0..mesh: pane.obj -> pane.obj$' - "$glint" diff shapes/mesh.yaml shapes/deep/mesh.yaml
expect "diff as JSON" 1 '"kind": "moved"' - "$glint" diff --format json a.yaml b.yaml
expect "diff of a broken scene" 1 - 'E101' "$glint" diff a.yaml broken.yaml
expect "diff of a missing scene" 3 - 'missing.yaml:1:1: error' "$glint" diff a.yaml missing.yaml
for scene in "$source"/scenes/*.glint.yaml "$source"/scenes/elements/*.yaml; do
    expect "twins: $(basename "$scene")" 0 - - "$glint" diff "$scene" "${scene%.yaml}.xml"
done

# A row that the file lacks is written beside another one, as that is written.
for case in yaml yaml_default yaml_most xml; do
    cp "$source"/tests/invalid/w429_$case/case.* .
    file=case.${case%%_*}
    expect "w429_$case: mended" 0 - "$file: 1 fix made" "$glint" check --fix=all $file
    expect "w429_$case: for good" 0 - - "$glint" check $file
    case $case in
    yaml_default) expect "on a line of its own" 0 '^  samples: 256$' - cat $file ;;
    yaml_most) expect "the other row" 0 'samples: 2000, error: 0.01, min_samples: 16.$' - cat $file ;;
    *) expect "in its place" 0 'samples(: |=")256.* error' - cat $file ;;
    esac
done
printf '<Scene glint="1"><Image error="0.01"/><Sphere radius="1"><Center x="0" y="0" z="-4"/></Sphere></Scene>\n' >error.xml
"$glint" check --fix=all error.xml >out.txt 2>err.txt
expect "as an attribute" 0 '<Image error="0.01" samples="256"/>' - cat error.xml

# Vectors: what the help says is what the fix writes.
cp "$source/tests/invalid/e209_yaml_flow/case.yaml" flow.yaml
expect "brackets around numbers in a flow map" 1 - 'flow.yaml: 6 fixes made' "$glint" check --fix flow.yaml
expect "all that has enough of them" 0 'position: .0, 2, 8., look_at: .0, 0, 0., fov: 40' - cat flow.yaml
expect "the rest is left" 1 - "^flow.yaml:3:.*not '5, 5'" "$glint" check flow.yaml
printf '<Scene glint="1">\n  <Camera><Position x="1" y="2"/></Camera>\n  <Sphere radius="1"><Center z="3"></Center></Sphere>\n  <Sphere radius="1"><Center x="1"><!-- why --></Center></Sphere>\n</Scene>\n' >vectors.xml
expect "components that are missing are not certain" 1 - 'lacks .z.' "$glint" check --fix vectors.xml
expect "with all suggestions" 1 - 'vectors.xml: 2 fixes made' "$glint" check --fix=all vectors.xml
expect "as the help says" 0 '<Position x="1" y="2" z="0"/>' - cat vectors.xml
expect "in a pair of tags" 0 '<Center x="0" y="0" z="3"/>' - cat vectors.xml
expect "no comment is lost" 0 '<Center x="1"><!-- why --></Center>' - cat vectors.xml
printf 'glint: 1\nspheres: [{center: {x: 1, z: 2}, radius: 1}]\n' >vectors.yaml
expect "in YAML" 0 - 'vectors.yaml: 1 fix made' "$glint" check --fix=all vectors.yaml
expect "as a list" 0 'center: .1, 0, 2.' - cat vectors.yaml
expect "an index after a point" 1 - 'help: write spheres.0.$' "$glint" check vectors.yaml --set spheres.0.radius=2
expect "a name after a point" 1 - 'help: for example spheres.0. or spheres.ball.$' "$glint" check vectors.yaml --set spheres.ball.radius=2

# Corners in the opposite order: each as it is written, with the comments between them.
cp "$source"/tests/invalid/w414_yaml_order/case.yaml order.yaml
expect "faces in the wrong order" 0 - 'order.yaml: 3 fixes made' "$glint" check --fix=all order.yaml
expect "in brackets" 0 '^        - .4, 3, 5.$' - cat order.yaml
expect "with words" 0 '^        - corners: .{vertex: 1}, {vertex: 4}, {vertex: 5}, {vertex: 2}.$' - cat order.yaml
expect "where a comment stays" 0 '^          - 2 # away from the eaves$' - cat order.yaml
expect "are in order" 0 - - "$glint" check --fail-on warning order.yaml
cp "$source"/tests/invalid/w414_xml_order/case.xml order.xml
expect "and in XML" 0 - 'order.xml: 1 fix made' "$glint" check --fix=all order.xml
expect "with the comment" 0 '^          <Corner vertex="0"/> <!-- at the edge -->$' - cat order.xml
expect "too" 0 - - "$glint" check --fail-on warning order.xml
printf 'glint: 1\nlights: [{position: [0, 0, 9]}]\nmodels:\n  - mesh:\n      faces:\n        vertices: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]\n        faces: [[0, &b 1, &c 2], [3, *b, *c]]\n' >order.yaml
expect "a corner that stands for another place" 0 - 'W414' "$glint" check --fix=all order.yaml
expect "is left" 0 'faces: ..0, &b 1, &c 2., .3, .b, .c..$' - cat order.yaml
exit $failed
