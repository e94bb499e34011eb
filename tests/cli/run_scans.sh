#!/bin/sh
# The same mesh from files of all formats gives the same picture, byte for byte, and a mesh by itself is the scene that
# `convert` writes. Usage: run_scans.sh GLINT SOURCE FOLDER WRITER [whole]; `whole` takes the large meshes too.
# Meshes are in GLINT_ASSETS, else in ../shared/assets; where they are absent, it is skipped.
set -eu
glint=$1 source=$2 folder=$3 writer=$4 whole=${5:-}
models=${GLINT_ASSETS:-$source/../shared/assets}/models
failed=0
"$source/tools/emptied" "$folder"
cd "$folder"

# What of the two differs; nothing is said of pictures that are the same.
same() { # WHAT PICTURE PICTURE
    if cmp -s "$2" "$3"; then
        echo "ok   $1"
    else
        echo "FAIL $1: other bytes"
        failed=1
    fi
}

picture() { # MESH OUT: with smooth normals, from a scene that is the same for all
    printf 'glint: 1\ncamera: {position: [0, 0.1, 0.6], look_at: [0, 0.1, 0], fov: 25}\nlights: [{position: [1, 2, 3]}]\nmodels: [{mesh: %s, smooth: true}]\n' \
        "$1" >scene.yaml
    "$glint" render scene.yaml -o "$2" --size 96x72 -q
}

forms() { # MODEL FORM...
    model=$1
    shift
    [ -f "$models/$model.ply" ] || return 0
    cp "$models/$model.ply" mesh.ply
    "$writer" mesh.ply . "$@"
    picture mesh.ply mesh.pfm
    for form in "$@"; do
        picture "$form" form.pfm
        same "$model as $form" mesh.pfm form.pfm
        rm -f "$form"
    done
}

if [ ! -d "$models" ]; then
    echo "skipped: $models is absent"
    exit 77
fi
forms bunny-69k as.obj text.ply little.ply big.ply text.stl binary.stl
if [ -n "$whole" ]; then
    forms nefertiti-100k as.obj big.ply binary.stl
    forms bunny-276k as.obj big.ply
    forms bunny-1104k as.obj
fi

cp "$models/bunny-69k.ply" statue.ply
"$writer" statue.ply . as.obj
"$glint" render statue.ply -o by_itself.pfm --size 48x36 --samples 2 -q
"$glint" convert statue.ply scene.yaml
"$glint" render scene.yaml -o converted.pfm --size 48x36 --samples 2 -q
same "a mesh by itself, and the scene around it" by_itself.pfm converted.pfm
"$glint" render as.obj -o as_obj.pfm --size 48x36 --samples 2 -q
same "by itself as PLY and as OBJ" by_itself.pfm as_obj.pfm
said=$("$glint" check statue.ply scene.yaml 2>&1 && echo good)
case $said in
*warning* | *error*)
    echo "FAIL check of it says: $said"
    failed=1
    ;;
*good) echo "ok   check of both" ;;
*) failed=1 ;;
esac
cd ..
rm -rf "$folder"
exit $failed
