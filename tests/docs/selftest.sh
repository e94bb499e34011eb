#!/bin/sh
# run_docs.sh finds what is wrong in a page. Usage, as cli/lib.sh has it: selftest.sh GLINT SOURCE_FOLDER WORK_FOLDER
here=$(cd "$(dirname -- "$0")" && pwd)
. "$here/../cli/lib.sh"
mkdir -p repository/scenes repository/tests
cp -R "$source/scenes/meshes" "$source/scenes/tutorial" repository/scenes
ln -s "$source/tests/data" repository/tests/data

# page EXIT WHAT: the page on standard input is right (0) or wrong (1).
page() {
    cat >repository/page.md
    "$here/run_docs.sh" "$glint" "$work/repository" "$work/page" page.md >said.txt 2>&1
    got=$?
    if [ $got -eq "$1" ]; then
        pass "$2"
    else
        fail "$2: status $got, not $1"
        cat said.txt repository/page.md
    fi
}
block() { # LANGUAGE TEXT
    printf '%s%s\n%s\n%s\n' '```' "$1" "$2" '```'
}
mark() {
    printf '<!-- test: %s -->\n' "$1"
}

(block yaml 'spheres: [{center: [0, 0, 0], radius: 1, material: red}]'; block xml '<Image width="64"/>') | page 0 'parts of scenes'
block yaml 'spheres: [{center: [0, 0, 0], raduis: 1}]' | page 1 'a wrong part'
block xml '<Sphere/>' | page 1 'a wrong part in XML'
printf 'glint: 1\nmaterials: {red: {}}\n' >unused.txt
block yaml "$(cat unused.txt; echo 'spheres: [{center: [0, 0, -9], radius: 1}]')" | page 1 'a scene with a warning'
(mark 'finds E202'; block yaml 'sphere: []') | page 0 'an expected finding'
(mark 'finds E202'; block yaml 'spheres: []') | page 1 'an expected finding that is not there'
(mark 'not a scene: a list'; block yaml '- 1') | page 0 'not a scene'
(mark 'from scenes/tutorial/step-1.glint.yaml'; block yaml 'glint: 1') | page 0 'from a file'
(mark 'from scenes/tutorial/step-1.glint.yaml'; block yaml 'glint: 2') | page 1 'not from that file'
block sh 'glint check scene.glint.yaml' | page 0 'a command'
block sh 'glint check scene.glint.xml && glint chekc scene.glint.yaml' | page 1 'a wrong command'
block sh 'rm scene.glint.yaml' | page 1 'a command of another program'
(mark 'not run: it removes'; block sh 'rm scene.glint.yaml') | page 0 'a command that is left out'
(mark 'not run "rm": it removes'; block sh 'rm scene.glint.yaml
glint check scene.glint.yaml') | page 0 'one of two commands that is left out'
(mark 'not run "rm": it removes'; block sh 'rm scene.glint.yaml
glint check none.yaml') | page 1 'the other of the two'
(mark 'status 3 "glint check none"'; block sh 'glint check scene.glint.yaml
glint check none.yaml') | page 0 'an expected status'
(mark 'status 3'; block sh 'glint check scene.glint.yaml') | page 1 'another status'
(mark 'file ball.yaml'; block yaml 'glint: 1'; block sh 'glint check ball.yaml') | page 0 'a file of the page'
(mark 'printed by echo glint'; block '' 'glint') | page 0 'as printed'
(mark 'printed by echo glint'; block '' 'gloss') | page 1 'not as printed'
(mark 'settings'; block yaml 'fail_on: warning') | page 0 'settings'
(mark 'settings'; block yaml 'fail_on: nothing') | page 1 'wrong settings'
(mark 'from nowhere'; echo text) | page 1 'a mark without a block'
printf '%s\n' '```yaml' 'glint: 1' | page 1 'a block without an end'
exit $failed
