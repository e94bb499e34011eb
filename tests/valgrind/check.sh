#!/bin/sh
# The parser under valgrind: no invalid access, no leak, over the scenes that ship and the invalid corpus.
# Usage: check.sh GLINT SOURCE_FOLDER WORK_FOLDER; exit 77 where valgrind is not installed.
set -u
glint=$1
source=$2
work=$3
command -v valgrind >/dev/null || {
    echo "valgrind is not installed"
    exit 77
}
cd "$work" || exit 2
failed=0

# clean NAME arguments...: the program may find mistakes; valgrind must not.
clean() {
    name=$1
    shift
    valgrind --quiet --error-exitcode=99 --leak-check=full --show-leak-kinds=all --log-file=valgrind.txt \
        "$glint" "$@" >out.txt 2>&1
    status=$?
    # valgrind of Debian 12 does not know openat2 and says so; files are then opened in the other way (files/door.c).
    sed -i '/unhandled amd64-linux syscall: 437$/,/bug_reports\.html\.$/d' valgrind.txt
    if [ $status -eq 99 ] || [ -s valgrind.txt ]; then
        echo "FAIL $name"
        head -60 valgrind.txt
        failed=1
    else
        echo "ok   $name"
    fi
}

clean "scenes in YAML" check -v "$source"/scenes/*.glint.yaml "$source"/scenes/elements/*.yaml
clean "scenes in XML" check -v "$source"/scenes/*.xml "$source"/scenes/elements/*.xml
clean "the invalid corpus" check -v --limit messages=1000000 "$source"/tests/invalid/*/case.*
clean "options" check "$source/scenes/tinyraytracer.glint.yaml" --set 'image.width=' --set 'camera.fov=200' \
    --set 'lights[0]={position: [1' --set 'spheres[0].material={albedo: 1}' --set 'nothing.at[all]=1'
clean "the canonical dump" inspect --ir=evaluated "$source/scenes/showcase.glint.xml"
clean "to YAML" convert "$source/scenes/showcase.glint.xml" showcase.yaml
clean "to XML" convert "$source/scenes/showcase.glint.yaml" showcase.xml
clean "to JSON" convert "$source/scenes/showcase.glint.yaml" showcase.json
clean "a mesh" check "$source/scenes/meshes/fox.obj"
clean "a schema" schema json
clean "an explanation" explain material
clean "a command line that is wrong" chekc --limit scene-byte=1
exit $failed
