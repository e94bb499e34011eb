#!/bin/sh
# Standard input as a scene, colours where they are asked for, and files that are something else.
# Usage: run_stream.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
unset GLINT_DEVICE NO_COLOR CLICOLOR_FORCE

# from FILE command...: with the file as standard input.
from() {
    input=$1
    shift
    "$@" <"$input"
}

mkdir -p parts
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >parts/tri.obj
printf 'glint: 1\nimage: {width: 8, height: 8}\nmodels: [{mesh: tri.obj}]\n' >good.yaml
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n' >bad.yaml
printf '<Scene glint="1"><Image width="8" height="8"/><Sphere radius="1"><Center x="0" y="0" z="0"/></Sphere></Scene>\n' >good.xml

expect "a scene" 0 - - from good.xml "$glint" check -
expect "a mistake has its place" 1 - 'standard input:2:39: error: .*\[E206\]' from bad.yaml "$glint" check -
expect "paths are relative to the current folder" 1 - 'standard input:3:17: error: the mesh .tri.obj. does not exist' from good.yaml "$glint" check -
expect "or to --base" 0 - - from good.yaml "$glint" check - --base parts
: >parts/.glintrc.yaml
printf 'limits: {scene-triangles: 1}\n' >parts/.glintrc.yaml
cp parts/tri.obj parts/other.obj # a mesh counts once
printf 'glint: 1\nmodels: [{mesh: tri.obj}, {mesh: other.obj, translation: [5, 0, 0]}]\n' >two.yaml
expect "settings are those of --base" 1 - 'scene-triangles is 1' from two.yaml "$glint" check - --base parts
rm parts/.glintrc.yaml
expect "beside files" 1 - 'standard input:2:39: error' from bad.yaml "$glint" check - good.xml
expect "in reports" 1 '"file": "standard input"' '' from bad.yaml "$glint" check - --format json
expect "XML by its first character" 0 'radius: 1' - from good.xml "$glint" inspect --ir -
expect "or by --as" 1 - 'standard input.xml:1:1: error: this comes before the first element' from good.yaml "$glint" check - --as xml
expect "as what it is not" 1 - 'standard input.yaml:1:1: error' from good.xml "$glint" check - --as yaml
expect "--as takes" 2 - '--as takes yaml or xml' from good.xml "$glint" check - --as jsn
expect "inspect" 0 'spheres +1' '' from good.xml "$glint" inspect -
expect "convert from one stream to the other" 0 'spheres:' - from good.xml "$glint" convert - -
expect "convert into another folder" 0 - - from good.yaml "$glint" convert - out.xml --base parts
expect "paths follow" 0 'mesh="parts/tri.obj"' - cat out.xml
expect "deps" 0 '^parts/tri.obj$' - from good.yaml "$glint" deps - --base parts
ok "which are files only" sh -c '! grep -q "standard input" out.txt'
expect "no rule without a name" 2 - 'needs the scene.s name' from good.xml "$glint" deps - --format make
expect "diff with a file" 0 - - from good.xml "$glint" diff - good.xml
expect "on either side" 1 'spheres' - from good.xml "$glint" diff good.yaml -
expect "both sides" 2 - 'standard input can be read only once' from good.xml "$glint" diff - -
expect "pick" 0 'sphere' '' from good.xml "$glint" pick - 4,4 --device reference
expect "render" 0 - 'wrote s.png, 8 x 8' from good.xml "$glint" render - -o s.png --device reference --no-cache
expect "from stream to stream" 0 'PNG' '' from good.xml "$glint" render - -o - --device reference --no-cache
expect "where to" 2 - 'command-line:1:14: error: a picture of standard input has no name' from good.xml "$glint" render -
expect "no fix in place" 2 - 'standard input cannot be changed' from bad.yaml "$glint" check - --fix
printf 'glint: 1\nsphere: [{center: [0, 0, 0], radius: 1}]\n' >near.yaml
expect "but a patch" 1 '^\+spheres' '' from near.yaml "$glint" check - --fix=all --diff -q
expect "a package needs a name" 2 - 'standard input has none' from good.xml "$glint" pack - x.zip
expect "a base that is no folder" 2 - '--base: .good.xml. is not a folder' from good.xml "$glint" check - --base good.xml
expect "--base without a stream" 2 - "'--base' would have no effect" "$glint" check good.xml --base parts
expect "--as without a stream" 2 - "'--as' would have no effect" "$glint" format good.xml --as xml
expect "format takes --as" 0 'glint: 1' - from good.yaml "$glint" format - --as yaml
expect "a limit of streams" 3 - 'larger than the limit scene-bytes' from good.xml "$glint" check - --limit scene-bytes=10
expect "an empty stream" 1 - 'standard input:1:1: error' from /dev/null "$glint" check -
expect "a folder as a stream" 3 - 'standard input cannot be read: Is a directory' from . "$glint" check -

# A reader that has seen enough. It is gone before glint begins: what is short would fit into the pipe.
for command in 'schema json' 'deps - --base parts' 'inspect --ir -' 'check - --format json' '--help'; do
    rm -f gone.txt
    expect "$command, and no one reads" 141 - - sh -c '{ until [ -e gone.txt ]; do sleep 0.01; done; "$1" $2 <good.yaml; echo $? >status.txt; } | { exec <&-; : >gone.txt; }; exit $(cat status.txt)' sh "$glint" "$command"
done

# Colours.
coloured() { [ "$(tr -dc '\033' <err.txt | wc -c)" -gt 0 ]; }
plain() { ! coloured; }
expect "none into a file" 1 - 'error' "$glint" check bad.yaml
ok "plain" plain
expect "always" 1 - 'error' "$glint" check bad.yaml --color always
ok "coloured" coloured
expect "of the program's own mistakes too" 2 - 'error' "$glint" check bad.yaml --nonsense --color always
ok "coloured" coloured
expect "CLICOLOR_FORCE" 1 - 'error' env CLICOLOR_FORCE=1 "$glint" check bad.yaml
ok "coloured" coloured
expect "which 0 does not ask for" 1 - 'error' env CLICOLOR_FORCE=0 "$glint" check bad.yaml
ok "plain" plain
expect "NO_COLOR before it" 1 - 'error' env CLICOLOR_FORCE=1 NO_COLOR=1 "$glint" check bad.yaml
ok "plain" plain
expect "never before both" 1 - 'error' env CLICOLOR_FORCE=1 "$glint" check bad.yaml --color never
ok "plain" plain
expect "always before NO_COLOR" 0 "$(printf '\033')" - env NO_COLOR=1 "$glint" explain E206 --color always
expect "--color takes" 2 - '--color takes auto, always or never' "$glint" check bad.yaml --color sometimes

# What is no scene says what it is.
printf 'PK\003\004xx' >p.zip
printf 'ply\nformat ascii 1.0\n' >x.scan
cp p.zip scene.yaml
cp "$source/tests/data/image/interlaced.png" sky.png
printf 'facet' >m.off
printf 'newmtl a\n' >m.mtl
for case in 'p.zip:a ZIP archive:unpack it' 'scene.yaml:a ZIP archive:unpack it' 'x.scan:a PLY mesh:let it end in .ply' \
    'sky.png:a PNG picture:background' 'm.off:an OFF mesh:glint reads Wavefront OBJ' 'm.mtl:a material file of a mesh:name the mesh'; do
    file=${case%%:*} rest=${case#*:}
    expect "$file" 3 - "$file:1:1: error: this is ${rest%%:*}, not a scene \[E605\]" "$glint" check "$file"
    also "and what to do" '' "help: .*${rest#*:}"
done
for command in 'render p.zip' 'inspect p.zip' 'convert p.zip x.yaml' 'pack p.zip x'; do
    # shellcheck disable=SC2086 -- a command and its arguments
    expect "$command" 3 - 'this is a ZIP archive, not a scene' "$glint" $command
done
expect "on standard input too" 3 - 'standard input:1:1: error: this is a ZIP archive' from p.zip "$glint" check -
cp good.xml scene.pov
expect "a scene is one whatever it is called" 0 - - "$glint" check scene.pov

expect "no driver" 4 - 'E701' env -u VK_ICD_FILENAMES VK_DRIVER_FILES=/nonexistent.json "$glint" render good.xml
also "which is named, with a way without one" '' "VK_DRIVER_FILES names, '/nonexistent.json'.*--device reference"
expect "none at all" 4 - 'E701' env -u VK_DRIVER_FILES VK_ICD_FILENAMES= "$glint" devices
also "the variable that is empty" '' "VK_ICD_FILENAMES names"
if "$glint" devices >devices.txt 2>/dev/null; then
    first=$(sed -n 's/^[* ] 0  \(.*\) (.*/\1/p;q' devices.txt | cut -d'(' -f1)
    expect "what there is instead of a number" 4 - "GLINT_DEVICE:1:1: error: no Vulkan device matches '7'" env GLINT_DEVICE=7 "$glint" render good.xml
    also "by name" '' "help: there is: 0  $first"
fi
exit $failed
