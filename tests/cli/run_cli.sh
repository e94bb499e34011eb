#!/bin/sh
# The command line as a user sees it: exit codes, where output goes, messages of usage.
# Usage: run_cli.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
unset GLINT_DEVICE

cat >good.yaml <<'S'
glint: 1
# a small picture
image: {width: 48, height: 32}
camera: {position: [0, 0, 5]}
cameras_unused: 1
S
sed -i '/cameras_unused/d' good.yaml
cat >>good.yaml <<'S'
lights:
  - {position: [5, 5, 5]}
spheres:
  - {center: [0, 0, 0], radius: 1, material: {albedo: [1, 0.5, 0.2, 0]}}
S
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n' >bad.yaml
printf 'glint: 1\nimage: {width: 16, height: 16}\ncameras: {left: {position: [-1, 0, 5]}, right: {position: [1, 0, 5]}}\nspheres: [{center: [0, 0, 0], radius: 1}]\n' >two.yaml
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >tri.obj

expect "version" 0 '^glint [0-9]+\.[0-9]+' - "$glint" --version
expect "program help" 0 '^Usage: glint COMMAND' - "$glint" --help
for command in render check inspect convert schema explain devices compare; do
    expect "help of $command" 0 "^Usage: glint $command" - "$glint" $command --help
    expect "help names $command" 0 "^  $command " - "$glint" --help
done
expect "help of a command by its name" 0 '^Usage: glint check' - "$glint" help check
expect "help of no command" 2 - "command-line:1:12: error: there is no command 'chek'" "$glint" help chek
expect "no command" 2 - 'command-line:1:1: error: a command is needed' "$glint"
expect "unknown command" 2 - "command-line:1:7: error: there is no command 'rendr'" "$glint" rendr good.yaml
expect "nearest command" 2 - "did you mean 'render'" "$glint" rendr good.yaml
expect "unknown option" 2 - "unknown or ambiguous option '--szie'" "$glint" render good.yaml --szie 3x3
expect "nearest option" 2 - "did you mean '--size'" "$glint" render good.yaml --szie 3x3
expect "option of another command" 2 - 'error:' "$glint" check good.yaml --size 3x3
expect "missing value" 2 - "option '-o' needs a value" "$glint" render good.yaml -o
expect "bad size" 2 - 'WIDTHxHEIGHT' "$glint" render good.yaml --size 3by3
expect "size of zero" 2 - 'WIDTHxHEIGHT' "$glint" render good.yaml --size 0x4
expect "bad samples" 2 - 'from 1 to 4096' "$glint" render good.yaml --samples 0
expect "unknown limit" 2 - "did you mean 'mesh-bytes'" "$glint" check good.yaml --limit mesh-byte=1
expect "limit out of range" 2 - 'from 1 to' "$glint" check good.yaml --limit mesh-bytes=0
expect "limits listed" 0 '^scene-bytes' - "$glint" check --limit help
expect "too few operands" 2 - 'needs SCENE' "$glint" render
expect "too many operands" 2 - 'no more than 1 argument' "$glint" inspect good.yaml two.yaml
expect "the place of what is too much" 2 - 'command-line:1:52: error: .*no more than 2 arguments' \
    "$glint" convert good.yaml --limit messages=9 out.xml x
expect "no argument at all" 2 - "'glint devices' takes no argument" "$glint" devices x
expect "an empty path" 2 - 'command-line:1:13: error: .* is empty' "$glint" check ''
expect "an asset path that is no folder" 2 - 'command-line:1:23: error: --asset-path: .good.yaml. is not a folder' \
    "$glint" check good.yaml --asset-path good.yaml
expect "the place of a bad output" 2 - 'command-line:1:24: error: the output' "$glint" render good.yaml -o out.gif --size 8x8
expect "all cameras into one stream" 2 - "'--camera all' writes a file for each camera" \
    "$glint" render two.yaml --camera all -o -
expect "check is silent" 0 - - "$glint" check good.yaml
expect "check finds the mistake" 1 - 'bad.yaml:2:39: error: .*\[E206\]' "$glint" check bad.yaml
expect "the highest code of several" 3 - 'none.yaml:1:1: error: .*\[E601\]' "$glint" check bad.yaml none.yaml good.yaml
# A byte of a chunk's checksum: only who decodes sees it.
printf 'glint: 1\nimage: {width: 8, height: 6}\nbackground: {image: sky.png}\n' >sky.yaml
cp "$source/tests/data/image/interlaced.png" sky.png
expect "a whole image" 0 - - "$glint" check sky.yaml
printf 'x' | dd of=sky.png bs=1 seek=30 conv=notrunc 2>dd.txt
for command in check inspect "render --device reference"; do
    expect "a damaged image: $command" 1 - "^sky.png:1:1: error: .*a chunk's checksum is wrong.*\[E620\]" "$glint" $command sky.yaml
done
# What goes on while the image is decoded says nothing before it has said what is wrong.
for more in "--camera nobody" "-o nowhere/out.png" "--set trace.precision=double"; do
    expect "a damaged image before $more" 1 - "^sky.png:1:1: error: .*E620" \
        env VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json "$glint" render sky.yaml $more
    ok "nothing of cameras, outputs and devices" sh -c '! grep -qE "E302|E70[0-9]|nowhere" err.txt'
done
expect "only the image's header" 0 - - "$glint" check sky.yaml --skip-pixels
expect "only the image's header, of inspect" 0 'background' '' "$glint" inspect sky.yaml --skip-pixels
expect "render needs the pixels" 2 - "unknown or ambiguous option '--skip-pixels'" "$glint" render sky.yaml --skip-pixels
expect "the limit is one of bytes, however few pixels are read" 1 - '^sky.yaml:3:21: error: .*limit image-memory is 1 \[E501\]' \
    "$glint" check sky.yaml --skip-pixels --limit image-memory=1
cp bad.yaml also.yaml
"$glint" check bad.yaml two.yaml none.yaml also.yaml bad.yaml >all.txt 2>&1
printf 'bad.yaml:2:39\nnone.yaml:1:1\nalso.yaml:2:39\n' >wanted.txt
grep -oE '^[a-z]+\.yaml:[0-9]+:[0-9]+' all.txt >places.txt
expect "files are reported in the order of the command line" 0 - - cmp places.txt wanted.txt
expect "no colours where no terminal is" 1 - - grep -q "$(printf '\033')" all.txt
expect "messages have a limit" 1 - '1 more message not shown \(E206: 1\); --limit messages=101 shows all' \
    "$glint" check two.yaml --set image.width=0 --set image.height=0 --limit messages=1
expect "a mesh is checked" 0 - - "$glint" check tri.obj
odd=$(printf '"q" \302\205\342\200\250#: .obj')
cp tri.obj "$odd"
expect "a mesh with an odd name is checked" 0 - - "$glint" check "$odd"
odd=$(printf 'x\377.obj')
cp tri.obj "$odd"
expect "a mesh whose name is no text is told from one that is missing" 1 - 'byte 0xFF is not part .*E103' "$glint" check "$odd"
printf 'v 0 0 0\nv 1 0\nf 1 2 3\n' >broken.obj
expect "a broken mesh shows itself alone" 1 - 'broken.obj:2:1: error: .v. needs three numbers' "$glint" check broken.obj
cp err.txt broken.txt
expect "and no scene that no one wrote" 1 - - grep -q 'mesh:' broken.txt
# However many cameras and bodies there are, each camera is looked at.
awk 'BEGIN { print "glint: 1\nlights: [{position: [0, 99, 0]}]\ncameras:"; for (i = 1; i <= 7100; i++) printf "  c%d: {position: [%d, 0, 0]}\n", i, i
             print "spheres:"; for (i = 1; i <= 7100; i++) printf "  - {center: [%d, 9, 0], radius: 0.25}\n", i
             print "  - {center: [7100, 0, 0], radius: 0.25}" }' >cameras.yaml
expect "the last of many cameras is inside a body" 1 - "camera 'c7100' is inside" "$glint" check cameras.yaml --fail-on warning --only W402
rm cameras.yaml
# Glass behind a wall, and before both more needles than a ray may try: what was not tried may hide the glass.
awk 'BEGIN { print "v -1 -1 0"; for (i = 0; i <= 17000; i++) printf "v 1 %.6f 0\n", 1 + i * 1e-5
             for (i = 2; i <= 17001; i++) print "f 1", i, i + 1 }' >comb.obj
printf 'v -1 -1 0.5\nv 1 1 0.5\nv 1 1.001 0.5\nv 1 1.002 0.5\nv 1 1.003 0.5\nv 1 1.004 0.5\nv -1 -1 0\nv 20 -1 0\nv 20 20 0\nv -1 20 0
f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\nf 7 8 9\nf 7 9 10\n' >wall.obj
cat >glass.yaml <<'END'
glint: 1
image: {width: 16, height: 16}
camera: {position: [0, 0, 8], fov: 10}
trace: {max_depth: 1}
materials: {glass: {albedo: [0, 0, 0, 1], refractive_index: 1.5}}
rectangles:
  - {corner: [-1, -1, -1], edge_u: [2, 0, 0], edge_v: [0, 2, 0], material: glass}
  - {corner: [-1, -1, -2], edge_u: [2, 0, 0], edge_v: [0, 2, 0], material: glass}
models:
  - {mesh: comb.obj, translation: [0, 0, 4]}
  - {mesh: wall.obj}
END
sed '/comb/d' glass.yaml >wall.yaml
expect "glass deeper than max_depth" 0 - 'W406' "$glint" check glass.yaml --set models=
expect "glass behind a wall" 0 - - "$glint" check wall.yaml
expect "and behind more than can be tried" 0 - - "$glint" check glass.yaml
expect "a closed stream is an error of the write" 3 - 'cannot be written' sh -c '"$1" schema json >&-' sh "$glint"
expect "a full disk is an error of the write" 3 - 'cannot be written: No space' sh -c '"$1" schema json >/dev/full' sh "$glint"
expect "a closed pipe is no mistake, and has the status of SIGPIPE" 141 - - \
    sh -c '{ "$1" schema json; echo $? >status.txt; } | :; exit $(cat status.txt)' sh "$glint"
expect "closed streams do not become files" 0 - - sh -c '"$1" convert good.yaml closed.xml >&- 2>&- <&-' sh "$glint"
expect "what was written is whole" 0 - - "$glint" check closed.xml
expect "Vulkan is only looked for when it is needed" 1 - - sh -c 'ldd "$1" | grep -q vulkan' sh "$glint"
if script -qec true /dev/null >/dev/null 2>&1; then # where terminals can be made
    script -qec "$glint check bad.yaml" /dev/null >tty.txt 2>&1
    expect "colours on a terminal" 0 - - grep -q "$(printf '\033')" tty.txt
    script -qec "env NO_COLOR=1 $glint check bad.yaml" /dev/null >tty.txt 2>&1
    expect "NO_COLOR" 1 - - grep -q "$(printf '\033')" tty.txt
fi
expect "a limit is obeyed" 3 - 'E501' "$glint" check good.yaml --limit scene-bytes=10
expect "inspect" 0 'spheres +1' '' "$glint" inspect good.yaml
expect "inspect names the reason" 0 'good.yaml:[0-9]+:[0-9]+: ' '' "$glint" inspect good.yaml
expect "inspect shows no refraction" 0 'not required:.* refraction' '' "$glint" inspect good.yaml
expect "inspect as JSON" 0 '"spheres": 1' '' "$glint" inspect good.yaml --format json
expect "which says where a feature is switched on" 0 '"place": \{"file": "good.yaml", "line": [0-9]+, "column": [0-9]+\}' '' "$glint" inspect good.yaml --format json
expect "inspect --ir" 0 'radius: 1' - "$glint" inspect --ir good.yaml
expect "explain a code" 0 'range' - "$glint" explain e206
expect "explain lists codes" 0 '^E206  error    a number outside its range$' - "$glint" explain --list
expect "explain lists a family" 0 '^W417  warning' - "$glint" explain --list w4xx
cp out.txt family.txt
expect "and no other" 1 - - grep '^[EN]' family.txt
expect "explain lists no such code" 2 - "there is no code 'X1'" "$glint" explain --list X1
expect "explain needs a word" 2 - "'glint explain --list' lists the codes" "$glint" explain
expect "explain an attribute" 0 'refraction' - "$glint" explain material.albedo
expect "explain in another style" 0 '^camera.focus_at' - "$glint" explain FocusAt
expect "explain what other programs mean too" 0 "use this word for what is here 'scene.cylinder'" - "$glint" explain tube
expect "explain a shape that is made of another" 0 'pipe: .lathe: .profile' - "$glint" explain pipes
expect "explain a path of --set" 0 '^material.albedo' - "$glint" explain materials.glass.albedo.refraction
expect "explain what others say" 0 '^material.refractive_index' - "$glint" explain ior
expect "explain which of several" 2 - "say which: 'camera.position' or 'light.position'" "$glint" explain position
expect "explain nonsense" 2 - 'error:' "$glint" explain nonsense
expect "schema json" 0 'draft-07' - "$glint" schema json
expect "schema relaxng" 0 'relaxng.org' - "$glint" schema relaxng
expect "schema of no kind" 2 - "is not a kind of schema" "$glint" schema jsn
expect "convert to xml" 0 - - "$glint" convert good.yaml good.xml
expect "twin is good" 0 - - "$glint" check good.xml
expect "the comment came along" 0 'a small picture' - cat good.xml
"$glint" inspect --ir good.yaml >a.ir && "$glint" inspect --ir good.xml >b.ir
expect "twins are equal" 0 - - cmp a.ir b.ir
expect "convert to standard output" 0 '^<Scene|^  <Image' - "$glint" convert good.yaml -
expect "convert to JSON" 0 - - "$glint" convert good.yaml good.json
expect "JSON is good" 0 - - "$glint" check good.json
"$glint" inspect --ir good.json >c.ir
expect "and the same" 0 - - cmp a.ir c.ir
cp good.yaml itself.yaml
expect "convert onto itself" 2 - 'command-line:1:27: error: OUT is the same file as IN' "$glint" convert itself.yaml ./itself.yaml
expect "which stays" 0 - - cmp good.yaml itself.yaml
printf '<Scene glint="1">\r<!-- key\r  - {position: [9, 9, 9]} -->\r<Light><Position x="1" y="1" z="1"/></Light>\r</Scene>\r' >cr.xml
expect "convert a comment with a carriage return" 0 '^  # - .position' - "$glint" convert cr.xml -
"$glint" convert cr.xml cr.yaml
expect "in which it stays one" 0 - - "$glint" diff cr.xml cr.yaml
expect "convert what is wrong" 1 - 'E206' "$glint" convert bad.yaml bad.xml
expect "writes nothing" 2 - '' ls bad.xml
expect "convert into no folder" 3 - 'none/x.xml:1:1: error: cannot be written' "$glint" convert good.yaml none/x.xml
mkdir -p moved/deep/meshes moved/out
cp tri.obj moved/deep/meshes/
printf 'glint: 1\nmaterials: {red: {}}\n' >moved/deep/red.yaml
printf '<Scene glint="1"><Include file="red.yaml"/><Model mesh="meshes/tri.obj" material="red"/></Scene>\n' >moved/deep/a.xml
expect "convert into the folder above" 0 - - "$glint" convert moved/deep/a.xml moved/up.yaml
expect "paths follow" 0 'mesh: deep/meshes/tri.obj' - cat moved/up.yaml
expect "and includes" 0 'include: \[deep/red.yaml\]' - cat moved/up.yaml
expect "and are found" 0 - - "$glint" check moved/up.yaml
expect "convert beside" 0 - 'warning: written to .moved/out/a.yaml., the scene has 2 paths .*\[W604\]' "$glint" convert moved/deep/a.xml moved/out/a.yaml
expect "which needs the way out" 1 - 'E602' "$glint" check moved/out/a.yaml
expect "that the message names" 0 - - "$glint" check moved/out/a.yaml --asset-path moved/deep
: >moved/.glintrc.yaml
expect "convert below a marked root" 0 - - "$glint" convert moved/deep/a.xml moved/out/a.yaml
expect "is good" 0 - - "$glint" check moved/out/a.yaml
expect "paths stay on standard output" 0 'mesh: meshes/tri.obj' - "$glint" convert moved/deep/a.xml -
expect "--set with a colour" 0 'color: "#ff8000"' - "$glint" inspect --ir good.yaml --set 'background.color=#ff8000'
expect "--set with blanks" 0 'fov: 30' - "$glint" inspect --ir good.yaml --set 'camera.fov = 30'
expect "--set with a whole entry" 0 'radius: 7' - "$glint" inspect --ir good.yaml --set 'spheres[0]={center: [0, 0, 0], radius: 7}'
expect "--set that cannot be read" 2 - "'=' is missing" "$glint" check good.yaml --set 'camera.fov'
expect "--set through a name" 1 - 'E221.*|to change it wherever it is used: --set materials' "$glint" check moved/up.yaml --set 'models[0].material.albedo=[1, 0, 0, 0]'
cat >preset.yaml <<'END'
glint: 1
lights: [{position: [0, 5, 0]}]
materials: {a: {preset: gold}}
spheres: [{center: [0, 0, -5], radius: 1, material: a}]
END
expect "--set of a component beside a preset's" 0 'reflection_color: .0.5, 0.776, 0.373.' - "$glint" inspect --ir=evaluated preset.yaml --set materials.a.reflection_color.r=0.5
expect "--set of a preset, and of a component beside its" 0 'reflection_color: .0.5, 0.949, 0.922.' - \
    "$glint" inspect --ir=evaluated preset.yaml --set materials.a.preset=silver --set materials.a.reflection_color.r=0.5
expect "--set of a weight beside a preset's" 0 'albedo: .0, 1, 0.25, 0.' - "$glint" inspect --ir=evaluated preset.yaml --set materials.a.albedo.reflection=0.25
"$glint" convert --expanded preset.yaml clay.glint.yaml >/dev/null && sed -i 's/gold/clay/' clay.glint.yaml
"$glint" render preset.yaml --size 16x12 --device reference --set materials.a.preset=clay -q -o one.pfm
"$glint" render clay.glint.yaml --size 16x12 --device reference -q -o other.pfm
cmp -s one.pfm other.pfm && pass "of the preset before it nothing is left" || fail "a preset that is set is another than one that is written"
expect "--set of a part of a spot that is not written" 1 - 'can only be set as a whole' "$glint" check preset.yaml --set lights[0].spot.angle=10
expect "--set changes a value" 0 'radius: 2' - "$glint" inspect --ir good.yaml --set 'spheres[0].radius=2'
expect "--set with a mistake" 1 - 'error:.*E206' "$glint" inspect --ir good.yaml --set 'spheres[0].radius=-2'
expect "--set that leads nowhere" 1 - 'error:.*E220' "$glint" check good.yaml --set 'sphere[0].radius=2'
printf 'precious' >kept.png
expect "a failed run keeps the old file" 1 - 'E206' "$glint" render bad.yaml -o kept.png
expect "it is the old file" 0 '^precious$' - cat kept.png
expect "an output of no kind" 2 - 'must end in \.png, ' "$glint" render good.yaml -o out.gif

# The reference needs no device; its cache lies where it is told.
exact() { env XDG_CACHE_HOME="$PWD/cache" "$glint" render good.yaml --device reference --size 16x8 -o exact.png "$@"; }
expect "the reference" 0 - 'reference left out at most' exact
expect "the reference, kept" 0 - 'from its cache' exact
expect "the reference as the file" 0 - 'wrote exact\.png' exact --as-file
expect "what is kept" 0 '^2$' - sh -c 'ls cache/glint/reference | wc -l'
expect "the reference, not kept" 0 - 'could add [0-9.e-]+$' exact --no-cache
expect "the reference in numbers" 0 '"device": "reference"' '' exact --stats=json
expect 'which counts rays, told to or not' 0 - 'unseen crossings' exact --stats --count-rays
expect "the reference in words" 0 - 'could add at most' exact --stats
expect "--as-file without the reference" 2 - 'works only with .--device reference' "$glint" render good.yaml --as-file
expect "a limit of the reference" 0 - 'reference left out at most' exact --limit reference-segments=3 --no-cache

if "$glint" devices >devices.txt 2>/dev/null; then
    expect "render" 0 - 'out\.png' "$glint" render good.yaml -o out.png
    expect "a quiet render" 0 - - "$glint" render good.yaml -o out2.png -q
    expect "the same bytes twice" 0 - - cmp out.png out2.png
    expect "named after the scene" 0 - 'good\.png' "$glint" render good.yaml
    expect "pfm" 0 - '' "$glint" render good.yaml -o out.pfm
    expect "pfm header" 0 '^PF' '' head -c 2 out.pfm
    expect "hdr" 0 - '' "$glint" render good.yaml -o out.hdr
    expect "several pictures of one rendering" 0 - 'wrote many\.hdr' "$glint" render good.yaml -o many.png -o many.pfm -o many.hdr
    ok "as one by one" sh -c 'cmp many.png out.png && cmp many.pfm out.pfm && cmp many.hdr out.hdr'
    expect "rendered once" 0 '^1$' - sh -c '"$1" render good.yaml -o many.png -o many.pfm -q --stats=json | grep -o "\"name\": \"frame\"" | wc -l' - "$glint"
    if "$glint" render good.yaml -o many.exr -o half.exr -q 2>why.txt; then
        expect "OpenEXR holds what PFM holds" 0 '' - "$glint" compare many.exr out.pfm --max-largest 0 --format json
        expect "halves, by PIZ" 0 - - "$glint" render good.yaml -o half.exr -q --depth 16 --compression piz
        expect "nearly" 0 '' - "$glint" compare half.exr out.pfm --max-relmse 1e-6
        expect "and not quite" 1 '' - "$glint" compare half.exr out.pfm --max-largest 0
        printf 'glint: 1\nbackground: {image: many.exr}\n' >exr.yaml
        expect "an OpenEXR background" 0 - - "$glint" render exr.yaml --size 16x16 -o exr.png -q
    else
        grep -q 'was built without OpenEXR' why.txt || fail "OpenEXR cannot be written, and nothing says why"
    fi
    expect "JPEG" 0 - - "$glint" render good.yaml -o out.jpg -q
    expect "which is close" 0 '' - "$glint" compare out.jpg out.png --max-rmse 0.05
    expect "JPEG of less quality" 0 - - "$glint" render good.yaml -o less.jpg -q --quality 10
    ok "is smaller" sh -c 'test $(wc -c <less.jpg) -lt $(wc -c <out.jpg)'
    if "$glint" render good.yaml -o out.webp -q 2>why.txt; then
        expect "WebP" 0 'WEBP' - head -c 12 out.webp
    else
        grep -q 'was built without WebP' why.txt || fail "WebP cannot be written, and nothing says why"
    fi
    expect "PNG of 16 bits" 0 - - "$glint" render good.yaml -o deep.png -q --depth 16
    expect "within half of a step of 8 bits" 0 '' - "$glint" compare deep.png out.png --max-largest 0.00198
    expect "a depth that no output has" 2 - 'can have 32 bits' "$glint" render good.yaml -o a.png --depth 32
    expect "quality of a PNG" 2 - 'no output is JPEG' "$glint" render good.yaml -o a.png --quality 50
    expect "compression of a PNG" 2 - 'no output is OpenEXR' "$glint" render good.yaml -o a.png --compression piz
    expect "another compression" 2 - "takes zip, piz or none" "$glint" render good.yaml -o a.exr --compression dwaa
    expect "a WebP that is too wide" 2 - 'at most 16383 pixels' "$glint" render good.yaml -o a.webp --size 16384x1
    expect "a picture that is named twice" 2 - 'named twice' "$glint" render good.yaml -o a.png -o a.png
    expect "a second one of no known kind" 2 - 'must end in' "$glint" render good.yaml -o a.png -o a.tga
    ok "and no picture is written" test ! -e a.png
    expect "one of several on standard output" 0 'PNG' '' "$glint" render good.yaml -o many2.pfm -o -
    ok "and the other one in its file" cmp many2.pfm out.pfm
    expect "png on standard output" 0 'PNG' '' "$glint" render good.yaml -o -
    expect "a mesh is a scene" 0 - '' "$glint" render tri.obj --size 16x16 -o tri.png
    expect "all cameras" 0 - '' "$glint" render two.yaml --camera all -o two.png
    expect "a picture each" 0 - - cmp two.left.png two.left.png
    expect "they differ" 1 'differ' '' cmp two.left.png two.right.png
    expect "an unknown camera" 2 - "did you mean 'left'" "$glint" render two.yaml --camera lft
    expect "statistics" 0 '' 'device' "$glint" render good.yaml -o out.png --stats
    expect "statistics as JSON" 0 '"device"' '' "$glint" render good.yaml -o plain.pfm --stats=json -q
    # They do nothing that nobody asked for: a kernel more, or a picture traced again.
    cp out.txt plain.json
    ok "without what takes time" sh -c '! grep -qE "\"rays\"|\"audit\"|\"name\": \"count\"" plain.json'
    expect "rays are counted where they are asked for" 0 '"rays"' '' "$glint" render good.yaml -o out.png --stats=json --count-rays --audit -q
    # A picture states its own error: in the statistics and in the file, where it was asked to.
    also "the error in the statistics" '"share_at_most": 0' ''
    expect "as text too" 0 - 'total reflection' "$glint" render good.yaml -o words.png --stats --count-rays
    expect "rays need statistics" 2 - "only '--stats' shows rays" "$glint" render good.yaml -o words.png --count-rays
    # The trial of `auto` draws with the kernel of the frame.
    "$glint" render good.yaml -o one.png --stats=json -q >one.json
    expect "one kernel for trial and frame" 0 '^1$' - sh -c 'cat one.json | grep -o "\"name\": \"pipeline\"" | wc -l'
    expect "counted after the picture is made" 0 - '' "$glint" render good.yaml -o counted.pfm --stats --count-rays
    ok "whose bytes are the same" cmp out.pfm counted.pfm
    has_note() { grep -qa "tEXtAccuracy" "$1"; }
    ok "and in the picture" has_note out.png
    ok "which says nothing of it where nobody asked" sh -c '! grep -qa tEXtAccuracy one.png'
    expect "an audit" 0 - 'glint: at most 0\.09[0-9]+ % of the pixels are off by more than 1/255 \(95 % sure\): 0 of 3[0-9]{3}' "$glint" render good.yaml --size 160x120 -o noted.png --audit
    ok "in the picture too" has_note noted.png
    expect "none without it" 0 - '' "$glint" render good.yaml --size 160x120 -o plain.png
    ok "and nothing of it in the picture" sh -c '! grep -qa Accuracy plain.png'
    expect "the pixels are the same" 0 '' - "$glint" compare noted.png plain.png --max-largest 0
    expect "an audit of a Radiance picture" 0 - '' "$glint" render good.yaml --size 160x120 -o noted.hdr --audit -q
    expect "in its head" 0 '^# Accuracy: at most ' '' head -3 noted.hdr
    expect "a bound that holds" 0 - - "$glint" render good.yaml --size 160x120 -o noted.png --max-off 0.002 -q
    expect "a bound that needs more pixels" 0 - 'glint: at most 0\.0[0-4][0-9]* % .*: 0 of 1[0-9]{4} traced again' "$glint" render good.yaml --size 240x180 -o noted.png --max-off 0.0005 --set trace.precision=double
    expect "or all of them" 0 - 'glint: 0 % .*: 0 of all 19200' "$glint" render good.yaml --size 160x120 -o noted.png --max-off 0
    ok "in the picture as well" has_note noted.png
    expect "all of a small picture is traced again" 0 - '0 % of the pixels are off by more than 1/255: 0 of all 768' "$glint" render good.yaml --size 32x24 -o noted.png --max-off 0
    printf 'glint: 1\nbackground: {color: [0.1, 0.2, 0.3]}\ntrace: {precision: single}\ncamera: {position: [0.3, 0.2, 5], fov: 1.0e-6}\nlights: [{position: [3, 4, 5]}]\nspheres: [{center: [0.1, 0, -123456789.3], radius: 0.8}]\n' >far.yaml
    expect "a picture that is wrong" 1 - '[1-9][0-9]* of 3[0-9]+ traced again .*, the first at [0-9]+,[0-9]+; more than 1 %' "$glint" render far.yaml --size 160x120 -o far.png --max-off 0.01
    ok "the picture is there all the same" has_note far.png
    expect "and right in double precision" 0 - '0 of 3[0-9]{3} traced again' "$glint" render far.yaml --size 160x120 -o far.png --max-off 0.01 --set trace.precision=double
    expect "an audit of the reference" 2 - 'choose a device' "$glint" render good.yaml -o out.png --device reference --audit
    expect "a share that is none" 2 - 'from 0 to 1' "$glint" render good.yaml -o out.png --max-off 2
    expect "repeat" 0 '' 'median' "$glint" render good.yaml -o out.png --repeat 3
    expect "an unknown device" 4 - 'E702' "$glint" render good.yaml -o out.png --device nonesuch
    GLINT_DEVICE=nonesuch expect "an unknown device by environment" 4 - 'E702' env GLINT_DEVICE=nonesuch "$glint" render good.yaml -o out.png
    cp "$source/tests/data/image/interlaced.png" sky.png
    expect "a whole image, no camera of that name" 2 - 'E302' "$glint" render sky.yaml -o sky-out.png --camera nobody
    expect "a whole image, no driver" 4 - 'E701' env VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json "$glint" render sky.yaml -o sky-out.png
    expect "a whole image" 0 '"name": "image"' - "$glint" render sky.yaml -o sky-out.png -q --stats=json
    expect "no driver" 4 - 'E701' env VK_ICD_FILENAMES=/nonexistent.json VK_DRIVER_FILES=/nonexistent.json "$glint" render good.yaml -o out.png
    # Faults of pixels: exit code 1, and the picture all the same. Facing mirrors with the camera between them;
    # then mirrors whose weights grow beyond what a float holds.
    printf 'glint: 1\nimage: {width: 16, height: 16}\ncamera: {}\nbackground: {color: 0.5}\nmaterials: {mirror: {albedo: [0, 0, 0.9, 0]}}\nrectangles:\n  - {corner: [-9, -9, -1], edge_u: [18, 0, 0], edge_v: [0, 18, 0], material: mirror}\n  - {corner: [-9, -9, 1], edge_u: [18, 0, 0], edge_v: [0, 18, 0], material: mirror}\n' >mirrors.yaml
    expect "mirrors within the limit" 0 - 'mirrors\.png' "$glint" render mirrors.yaml --limit path-segments=18
    expect "rays that the reference left out" 0 - 'mirrors.yaml:[78]:5: warning: [0-9]+ pixels needed more rays than the limit reference-segments, the first at [0-9]+,[0-9]+.*\[W702\]' "$glint" render mirrors.yaml --device reference --no-cache --limit reference-segments=5 -o faulty.png
    expect "more rays than the limit" 1 - 'mirrors.yaml:[78]:5: error: [0-9]+ pixels needed more rays than the limit path-segments, the first at [0-9]+,[0-9]+.*\[E705\]' "$glint" render mirrors.yaml --limit path-segments=5 -o faulty.png
    expect "what helps" 1 - 'help: .*--limit path-segments=' "$glint" render mirrors.yaml --limit path-segments=5 -o faulty.png
    expect "the picture is written all the same" 0 'PNG' '' head -c 4 faulty.png
    sed 's/0\.9/1.0e6/' mirrors.yaml >endless.yaml
    expect "not a number" 1 - 'endless.yaml:[78]:5: error: [0-9]+ pixels got a value that is infinite or not a number.*\[E706\]' "$glint" render endless.yaml -o endless.pfm
    expect "and not taken again" 1 - 'median frame [0-9.]+ ms of 1, from' "$glint" render endless.yaml -o endless.pfm --repeat 3
    expect "that picture too" 0 'PF' '' head -c 2 endless.pfm
    # A long render, ended from outside: its own exit code, a message, and the old file.
    printf 'precious' >kept.png
    for end in INT:130 TERM:143; do
        "$glint" render good.yaml --size 2048x2048 --samples 4096 -o kept.png >/dev/null 2>interrupted.txt &
        process=$!
        works $process 60
        kill -"${end%:*}" $process
        wait $process
        expect "exit code of SIG${end%:*}" 0 "^${end#*:}$" - echo $?
        expect "a message of SIG${end%:*}" 0 'interrupted.*E803' - cat interrupted.txt
        expect "the old file after SIG${end%:*}" 0 '^precious$' - cat kept.png
    done
    ls | grep -E '\.(png|pfm|hdr)\.' >leftovers.txt
    expect "no temporary file is left" 0 - - cat leftovers.txt
else
    echo "skip: no Vulkan device"
fi
exit $failed
