#!/bin/sh
# The extension for VS Code, in VS Code: run_vscode.sh GLINT SOURCE WORK BUILD, where BUILD is a folder for the module (that of builds/web).
# tools/vscode.sh fetches the host once; where it has not, or there is no Chromium, the test is skipped. WORK/extension.png is how it looked.
. "$2/tests/clients.sh"
manual=docs/editors.md
build=$4
needs emcc
needs node
[ -x /usr/bin/chromium ] || skip "chromium is not installed ($manual says how)"
GLINT_WEB=${GLINT_WEB:-$source/build/web-root}
GLINT_VSCODE_MODULES=${GLINT_VSCODE_MODULES:-$source/build/vscode-root}
[ -d "$GLINT_WEB/root" ] || skip "no libraries for WebAssembly; tools/vscode.sh builds them"
cmp -s "$source/web/vscode/package-lock.json" "$GLINT_VSCODE_MODULES/package-lock.json" || skip "the host is not there; tools/vscode.sh fetches it"
export GLINT_WEB GLINT_VSCODE_MODULES
export GLINT_WEB_BUILD="$build"

# ---- the archive

"$source/tools/vscode.sh" "$work/one" || fail "the extension is not made"
node "$source/web/vscode/build.mjs" "$work/elsewhere/two" "$GLINT_VSCODE_MODULES" "$build/glint-lint" "$source" || fail "the extension is not made again"
archive=$(ls "$work"/one/glint-*.vsix)
cmp "$archive" "$work/elsewhere/two/$(basename "$archive")" || fail "the archive made again has other bytes"
size=$(wc -c <"$archive")
[ "$size" -le 850000 ] || fail "the archive has $size bytes, more than 850 000"
mkdir unpacked
if command -v unzip >/dev/null 2>&1; then
    unzip -q "$archive" -d unpacked || fail "the archive cannot be unpacked"
    diff -r unpacked/extension "$work/one/extension" || fail "the archive holds something else"
    extension=$work/unpacked/extension
else
    extension=$work/one/extension
fi

# ---- in the host

mkdir -p scenes/meshes
cp "$source"/scenes/meshes/fox.* scenes/meshes
sed 's,\.\./meshes,meshes,' "$source/scenes/elements/models.glint.yaml" >scenes/picture.glint.yaml
cat >scenes/cameras.glint.xml <<'END'
<Scene glint="1">
  <Image width="160" height="120" samples="4"/>
  <Camera name="front"><Position x="0" y="0" z="5"/><LookAt x="0" y="0" z="0"/></Camera>
  <Camera name="side"><Position x="5" y="0" z="0"/><LookAt x="0" y="0" z="0"/></Camera>
  <Light><Position x="5" y="5" z="5"/></Light>
  <Sphere radius="0.5"><Center x="0" y="0" z="0"/></Sphere>
  <Sphere radius="0.5"><Center x="0" y="1" z="1"/></Sphere>
</Scene>
END
head='glint: 1
camera: {position: [0, 0, 5], look_at: [0, 0, 0]}
lights: [{position: [5, 5, 5]}]'
cat >scenes/wrong.glint.yaml <<END
$head
include: [materials.yaml]
spheres:
  - {centre: [0, 0, 0], radius: 1, material: glass}
END
cat >scenes/materials.yaml <<'END'
glint: 1
materials:
  glass: {albedo: [0, 0.5, 0.1, 0.8], refractive_index: 1.5}
END
cat >scenes/missing.glint.yaml <<END
$head
models:
  - {mesh: later.obj}
END
cat >scenes/wrong.glint.xml <<'END'
<Scene glint="1">
  <Sphere radus="1"><Center x="0" y="0" z="0"/></Sphere>
</Scene>
END
printf 'name: [1, 2\n' >scenes/other.yaml
(cd scenes && "$glint" render picture.glint.yaml --device reference --as-file --no-cache --quiet -o "$work/native.png") || fail "the native picture"
(cd scenes && "$glint" render cameras.glint.xml --camera side --device reference --as-file --no-cache --quiet -o "$work/side.png") || fail "the native picture"
GLINT_PICTURE=$(sha256sum <native.png | cut -d' ' -f1)
GLINT_SIDE=$(sha256sum <side.png | cut -d' ' -f1)
export GLINT_PICTURE GLINT_SIDE
exec node "$source/tests/vscode/host.mjs" "$extension" "$GLINT_VSCODE_MODULES" "$work"
