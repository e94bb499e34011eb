#!/bin/sh
# run_gltf.sh GLINT SOURCE_FOLDER WORK_FOLDER MAKE_GLTF: glTF files rendered, imported, checked, listed and packed.
make_gltf=$4
. "$(dirname -- "$0")/../cli/lib.sh"
"$make_gltf" . || exit 2
small='--size 96x64 --samples 1'

# render NAME FILE [OPTION...]: NAME.pfm
render() {
    name=$1 file=$2
    shift 2
    # shellcheck disable=SC2086 -- options
    "$glint" render "$file" $small -q -o "$name.pfm" "$@" 2>"$name.err" || fail "render $file: $(cat "$name.err")"
}
same() {
    if cmp -s "$2.pfm" "$3.pfm"; then pass "$1"; else fail "$1: the pictures differ"; fi
}

render glb sample.glb
render embedded embedded.gltf
render beside beside.gltf
same 'bytes inside the file or beside it: one picture' glb embedded
same 'images beside the file: one picture' glb beside
render above sample.glb --camera above
if cmp -s glb.pfm above.pfm; then fail 'another camera'; else pass 'another camera'; fi

expect 'import' 0 - 'glint: wrote scene.yaml' "$glint" import sample.glb -o scene.yaml
[ "$(ls scene_image_*.png | wc -l)" -eq 20 ] && pass 'twenty images are written' || fail 'twenty images'
expect 'the scene is right' 0 '' '' "$glint" check scene.yaml
expect 'it is laid out as glint format does it' 0 '' '' "$glint" format --check scene.yaml
render imported scene.yaml
same 'import renders as the file does' glb imported
for spelling in xml json; do
    expect "import as $spelling" 0 - '' "$glint" import embedded.gltf -o "as_$spelling.$spelling" -q
    render "as_$spelling" "as_$spelling.$spelling"
    same "import as $spelling renders as the file does" glb "as_$spelling"
done
expect 'import of files beside' 0 - 'wrote beside.yaml' "$glint" import beside.gltf -o beside.yaml
grep -q 'image 3.png' beside.yaml && pass 'its images are named where they are' || fail 'image 3.png'
render beside_imported beside.yaml
same 'and renders as the file does' glb beside_imported

expect 'nothing is overwritten' 3 - 'scene_image_0.png:1:1: error: the file exists' "$glint" import sample.glb -o scene.yaml
also 'and it says how to' - '--force'
expect 'nothing is written then' 3 - 'error: the file exists' "$glint" import sample.glb -o scene.xml
[ ! -e scene.xml ] && pass 'no scene beside what exists' || fail 'scene.xml was written'
mv scene_image_0.png kept.png
cp scene.yaml kept.yaml
mkdir -p within && mv scene.yaml within/ && ln -s ../outside.png within/scene_image_0.png
expect 'an image is not written through a link that leads out' 5 - 'scene_image_0.png:1:1: error: is not written: it leads out' \
    "$glint" import sample.glb -o within/scene.yaml --force -q
[ ! -e outside.png ] && cmp -s kept.yaml within/scene.yaml && pass 'and nothing is' || fail 'something was written'
rm -r within
mv kept.yaml scene.yaml
mv kept.png scene_image_0.png
expect 'with --force it is' 0 - 'wrote scene.yaml' "$glint" import sample.glb -o scene.yaml --force
expect 'to standard output' 0 'spot: {direction: .*, angle: 60, softness: 0.5}' - "$glint" import sample.glb -o -
mkdir below
expect 'another folder' 0 - 'W604' "$glint" import sample.glb -o below/scene.yaml -q
expect 'an ending that is none' 2 - "must end in" "$glint" import sample.glb -o scene.txt
expect 'a file that is none' 2 - "is not a glTF file" "$glint" import "$source/scenes/meshes/suzanne.obj" -o x.yaml
expect 'a scene is not imported' 2 - "is not a glTF file" "$glint" import scene.yaml -o x.yaml

printf 'glint: 1\nimage: {transfer: srgb}\nmodels:\n  - {mesh: sample.glb, part: box 3}\n  - {mesh: sample.glb, part: node 24}\n  - {mesh: sample.glb, part: gme}\n' >parts.yaml
expect 'a part that is not there' 1 - "parts.yaml:6:" "$glint" check parts.yaml
also 'its name is corrected' - "did you mean 'gem'"
printf 'glint: 1\nmodels: [{mesh: beside.gltf, smooth: true}]\n' >whole.yaml
expect 'deps lists buffers and images' 0 'sample data.bin' '' "$glint" deps whole.yaml
also 'images, too' 'image 19.png' ''
expect 'pack takes them along' 0 - '' "$glint" pack whole.yaml packed
"$glint" render packed/whole.yaml $small -q -o packed.pfm 2>/dev/null
"$glint" render whole.yaml $small -q -o whole.pfm 2>/dev/null
same 'the package renders the same' packed whole
expect 'pack takes a glTF file by itself' 0 - '' "$glint" pack beside.gltf by_itself
render by_itself by_itself/beside.glint.yaml
same 'and its package renders as the file does' glb by_itself
cp "$source/scenes/meshes/crate.obj" "$source/scenes/meshes/crate.mtl" .
expect 'pack takes a mesh by itself' 0 '' '' "$glint" pack crate.obj crate
expect 'the scene around it is in the package' 0 'meshes/crate.mtl' '' "$glint" deps crate/crate.glint.yaml
render crate_packed crate/crate.glint.yaml
render crate crate.obj
same 'and renders as the mesh does' crate crate_packed

exit $failed
