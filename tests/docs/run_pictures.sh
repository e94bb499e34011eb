#!/bin/sh
# The pictures of the documentation are what glint makes of their scenes now. Usage:
# run_pictures.sh check|update GLINT SOURCE_FOLDER WORK_FOLDER ALONE
#
# docs/pictures/NAME.png is NAME.glint.yaml of scenes/tutorial or scenes/language; NAME-alone.png what tests/pictures/alone
# makes of it. It is NAME.jpg where that is there: the grain of soft light makes large PNG files. Few pixels may
# be off by much, and all of them together by little: drivers for other processors round otherwise.
mode=$1
shift
. "$(dirname -- "$0")/../cli/lib.sh"
alone=$4
largest=45000 # bytes of a file

# The steps of the tutorial are as large as each other, what moves is shown in nine frames; the other scenes say themselves how large they are.
# A picture names its scene: by its path in the repository.
render() (# SCENE FILE
    cd "$source" || exit
    set -- "${1#"$source"/}" "$2"
    case $1 in
    */tutorial/*) "$glint" render "$1" --quiet --size 320x200 -o "$2" ;;
    */animation.*) "$glint" render "$1" --quiet --frames 0..99:12 --size 160x90 --quality 80 --montage -o "$2" ;;
    *) "$glint" render "$1" --quiet -o "$2" ;;
    esac
)

compare() {
    "$glint" compare "$1" "$2" --max-share 0.005 --max-mae 0.0004 >compared.txt
}

kept() { # STEM COMMAND...: the command makes the picture in the file that is its last argument
    stem=$1
    shift
    ending=png
    [ ! -f "$source/docs/pictures/$stem.jpg" ] || ending=jpg
    kept=$source/docs/pictures/$stem.$ending
    now=$work/$stem.$ending
    [ "$mode" = check ] || now=$kept
    ok "$stem: rendered" "$@" "$now"
    ok "$stem: as kept" compare "$now" "$kept"
    [ "$(wc -c <"$kept")" -le $largest ] || fail "$stem: more than $largest bytes"
    grep -qF "pictures/$stem.$ending" "$source"/README.md "$source"/docs/*.md || fail "$stem: no page shows it"
}

for scene in "$source"/scenes/tutorial/*.glint.yaml "$source"/scenes/language/*.glint.yaml; do
    kept "$(basename "$scene" .glint.yaml)" render "$scene"
done
kept nested-alone "$alone" "$source/scenes/language/nested.glint.yaml"
# The original's meshes are not ours and mostly not here.
seed=${GLINT_ASSETS:-$source/../shared/assets}/seed
if [ -f "$seed/water.obj" ]; then
    kept original_whisky "$glint" render "$source/tests/scenes/whisky.glint.yaml" --asset-path "$seed" --quiet --size 280x280 --samples 9 -o
fi
for kept in "$source"/docs/pictures/*.png "$source"/docs/pictures/*.jpg; do
    stem=$(basename "${kept%.*}")
    stem=${stem%-alone}
    [ "$stem" != original_whisky ] || continue
    [ -f "$source/scenes/tutorial/$stem.glint.yaml" ] || [ -f "$source/scenes/language/$stem.glint.yaml" ] || fail "$kept: has no scene"
done
# The tolerance can fail: a lamp that is a little brighter.
if [ "$mode" = check ]; then
    "$glint" render "$source/scenes/tutorial/step-2.glint.yaml" --quiet --size 320x200 --set 'lights[0].intensity=1.02' -o other.png
    ! compare other.png "$source/docs/pictures/step-2.png" || fail "another picture counts as the same"
fi
exit $failed
