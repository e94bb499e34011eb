#!/bin/sh
# docs/gallery.md and its pictures are what tools/gallery makes of the scenes now, and it is seen where they are not. Nothing is rendered
# but one small picture. Usage, as cli/lib.sh has it: run_gallery.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
export GLINT="$glint" XDG_CACHE_HOME="$work/cache"
most=3000000 # bytes of all pictures

mkdir now
ok 'page and pictures as made' "$source/tools/gallery" --check "$work/now"
[ "$(cat "$source"/docs/gallery/*.jpg | wc -c)" -le $most ] || fail "the pictures of the gallery have more than $most bytes"

# A repository of one scene.
mkdir -p repository/tools repository/scenes/gallery repository/docs
cp "$source/tools/gallery" repository/tools
scene=repository/scenes/gallery/ball.glint.yaml
printf '%s\n' '# A ball.' 'glint: 1' 'description: One ball' 'image: {width: 16, height: 10}' \
    'spheres: [{center: [0, 0, -3], radius: 1}]' >$scene
ok 'its twin' "$glint" convert $scene "${scene%yaml}xml"
small() { # NAME EXIT ARGUMENT...
    name=$1 wanted=$2
    shift 2
    repository/tools/gallery "$@" >said.txt 2>&1
    got=$?
    if [ $got -eq "$wanted" ]; then
        pass "$name"
    else
        fail "$name: status $got, not $wanted"
        cat said.txt
    fi
}
small 'rendered' 0
small 'as made' 0 --check "$work/now"
grep -q '^| 16 x 10 | 1.0 |' repository/docs/gallery.md || fail 'no statistics on the page'
sed -i 's/radius: 1/radius: 2/' $scene
small 'a scene that changed' 1 --check "$work/now"
small 'its page alone' 0 --page
small 'its picture is still of the scene before' 1 --check "$work/now"
small 'rendered again' 0 ball
small 'as made again' 0 --check "$work/now"
echo >>repository/docs/gallery.md
small 'a page that somebody changed' 1 --check "$work/now"
small 'written anew' 0 --page
echo >>repository/docs/gallery/ball.jpg
small 'a picture that somebody changed' 1 --check "$work/now"
small 'rendered anew' 0
cp repository/docs/gallery/ball.jpg repository/docs/gallery/none.jpg
small 'wrong use' 2 --pages
small 'a scene that is not there' 3 none
small 'a picture without a scene' 1 --check "$work/now"
exit $failed
