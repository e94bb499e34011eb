#!/bin/sh
# glint deps and glint pack: what they list, and that a package means and shows the same elsewhere.
# Usage: run_pack.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"

# A scene whose files lie in many places, some under one name, spelled in many ways.
mkdir -p in/sub/deep in/one in/two other
cat >in/one/tri.obj <<'S'
mtllib tri.mtl
v 0 0 0
v 1 0 0
v 0 1 0
usemtl red
f 1 2 3
S
sed 's/^v 1 0 0/v 2 0 0/' in/one/tri.obj >in/two/tri.obj
sed 's/tri.mtl/..\\mats\\deep.mtl/' in/one/tri.obj >other/away.obj
printf 'newmtl red\nKd 1 0 0\n' >in/one/tri.mtl
printf 'newmtl red\nKd 0 1 0\n' >in/two/tri.mtl
mkdir -p mats && printf 'newmtl red\nKd 0 0 1\n' >mats/deep.mtl
: >.glintrc.yaml
convert_png() { cp "$source/tests/golden/minimal.png" "$1"; }
convert_png in/two/sky.png
cat >in/sub/scene.yaml <<'S'
# kept: a comment
glint: 1
include: [deep/parts.xml, "../two/more.yaml"]
x-path: &shared ../one/tri.obj
image: {width: 24, height: 16}
background: {image: '../two/sky.png'}   # kept too
camera: {position: [0.3, 0.3, 4]}
models:
  - mesh: ../one/tri.obj
  - {mesh: *shared, translation: [0, 0, -1]}
  - mesh: &other "../../other/away.obj"
    translation: [-1, 0, 0]
  - mesh: *other
    translation: [-1, -1, 0]
S
cat >in/sub/deep/parts.xml <<'S'
<?xml version="1.0"?>
<Scene glint="1">
  <!-- kept -->
  <Light><Position x="5" y="5" z="5"/></Light>
  <Model mesh='../../two/tri.obj'><Translation x="0" y="-1" z="0"/></Model>
</Scene>
S
printf 'glint: 1\r\nmodels:\r\n- {mesh: tri.obj, translation: [1, 1, 0]}\r\n' >in/two/more.yaml

# ---- deps
cat >wanted.txt <<'S'
.glintrc.yaml
in/one/tri.mtl
in/one/tri.obj
in/sub/deep/parts.xml
in/sub/scene.yaml
in/two/more.yaml
in/two/sky.png
in/two/tri.mtl
in/two/tri.obj
mats/deep.mtl
other/away.obj
S
"$glint" deps in/sub/scene.yaml | while read -r file; do realpath --relative-to=. "$file"; done | sort >deps.txt
same "deps lists every file once" deps.txt wanted.txt
"$glint" deps in/sub/scene.yaml in/two/more.yaml | wc -l >count.txt
[ "$(cat count.txt)" -eq 11 ] && pass "deps of two scenes tells a file once" || fail "deps of two scenes"
expect "deps tells roles" 0 '"role": "materials"' - "$glint" deps --format json in/sub/scene.yaml
expect "deps tells places" 0 '"line": 11' - "$glint" deps --format json in/sub/scene.yaml
"$glint" deps --format make in/sub/scene.yaml >scene.d
printf 'all: scene.png\ninclude scene.d\nscene.png: ; @echo built\n' >makefile
if command -v make >/dev/null 2>&1; then expect "make reads the rule" 0 built - make -s -f makefile; else
    echo "skip make reads the rule: make is not installed"
fi
odd=$(printf 'x\377.yaml')
printf 'glint: 1\n' >"$odd"
tells "deps tells of a name that is no text" 0 "$(printf '"scene": "x\357\277\275.yaml"')" "$glint" deps --format json "$odd"
printf 'glint: 1\nmodels: [{mesh: gone.obj}]\n' >gone.yaml
expect "deps of a scene with a missing mesh" 1 'gone.yaml$' 'gone.yaml:2:17: error: .*E601' "$glint" deps gone.yaml
expect "deps knows its formats" 2 - make "$glint" deps --format mak gone.yaml

mkdir -p linked/conf && printf 'max_messages: 9\n' >linked/conf/settings && ln -s conf/settings linked/.glintrc.yaml
cp in/two/more.yaml in/two/tri.obj in/two/tri.mtl linked/
expect "deps tells settings that are a link" 0 '/linked/\.glintrc\.yaml$' - "$glint" deps linked/more.yaml

# ---- pack
expect "pack into a folder" 0 - - "$glint" pack in/sub/scene.yaml packed
(cd packed && find . -type f | sort) >packed.txt
cat >wanted.txt <<'S'
./images/sky.png
./includes/more.yaml
./includes/parts.xml
./mats/deep.mtl
./meshes-2/tri.mtl
./meshes-2/tri.obj
./meshes/away.obj
./meshes/tri.mtl
./meshes/tri.obj
./scene.yaml
S
same "pack's layout" packed.txt wanted.txt
sed -e 's|deep/parts.xml|includes/parts.xml|; s|"../two/more.yaml"|includes/more.yaml|' \
    -e "s|&shared ../one|\&shared meshes-2|; s|'../two/sky.png'|images/sky.png|" \
    -e 's|mesh: ../one/tri|mesh: meshes-2/tri|; s|&other "../../other/away.obj"|\&other meshes/away.obj|' \
    in/sub/scene.yaml >wanted.txt
same "pack changes paths alone" packed/scene.yaml wanted.txt
[ "$(grep -c 'kept' packed/includes/parts.xml)" -eq 1 ] && pass "pack keeps comments" || fail "pack keeps comments"
[ "$(tr -dc '\r' <packed/includes/more.yaml | wc -c)" -eq 3 ] && pass "pack keeps line ends" || fail "pack keeps line ends"
mkdir elsewhere && mv packed elsewhere/scene && mv in away && mv other away2
"$glint" render elsewhere/scene/scene.yaml -o packed.pfm -q || fail "the package renders"
mv away in && mv away2 other
"$glint" render in/sub/scene.yaml -o whole.pfm -q || fail "the scene renders"
same "a package renders the same elsewhere" whole.pfm packed.pfm

"$glint" pack in/sub/scene.yaml one.zip && "$glint" pack in/sub/scene.yaml two.zip || fail "pack into archives"
same "equal scenes give equal archives" one.zip two.zip
if command -v unzip >/dev/null 2>&1; then
    mkdir unzipped && (cd unzipped && unzip -q ../one.zip) && (cd unzipped && find . -type f | sort) >unzipped.txt
    same "an archive holds the folder's files" unzipped.txt packed.txt
    diff -r unzipped elsewhere/scene >/dev/null && pass "and their bytes" || fail "and their bytes"
else
    echo "skip what an archive holds: unzip is not installed"
fi
for scene in "$source"/scenes/*.glint.yaml "$source"/scenes/*.xml "$source"/scenes/elements/*.yaml; do
    [ -f "$scene" ] || continue
    name=$(basename "$scene")
    mkdir -p all
    "$glint" pack "$scene" "all/$name.d" >err.txt 2>&1 || {
        fail "pack $name"
        head -5 err.txt
    }
    rm -rf "all/$name.d"
done
[ $failed -eq 0 ] && pass "every scene that ships can be packed"

# ---- names that others stumble over
mkdir -p odd/A odd/a odd/blobs
long=$(printf 'n%.0s' $(seq 1 250)).obj
for name in '50% a b.obj' '-dash.obj' 'a=b.obj' 'a$b.obj' 'a: b #c.obj' 'x[1]*?.obj' '~home.obj' 'a|b.obj' "$long" A/Tri.obj; do
    cp in/two/tri.obj "odd/$name"
done
cp in/one/tri.obj odd/a/tri.obj
cp in/one/tri.obj odd/blobs/0123 && ln -s blobs/0123 odd/link.obj
{
    printf 'glint: 1\nmodels:\n'
    for name in '50% a b.obj' '-dash.obj' 'a=b.obj' 'a$b.obj' 'a: b #c.obj' 'x[1]*?.obj' '~home.obj' 'a|b.obj' "$long" \
        A/Tri.obj a/tri.obj link.obj; do
        printf '  - {mesh: "%s"}\n' "$name"
    done
} >odd/-s.yaml
expect "pack of odd names" 0 - W601 "$glint" pack -- odd/-s.yaml odd-packed
find odd-packed -name '*.obj' | wc -l >count.txt
[ "$(cat count.txt)" -eq 12 ] && pass "every odd name is packed" || fail "every odd name is packed"
[ -f odd-packed/meshes/link.obj ] && pass "a link's file is packed under the link's name" || fail "links"
[ -f odd-packed/meshes/Tri.obj ] && [ -f odd-packed/meshes-2/tri.obj ] && pass "names differ without regard to case" || fail "case"
expect "pack into an archive with a long name" 0 - W601 "$glint" pack odd/-s.yaml "${long%obj}zip"
if command -v python3 >/dev/null 2>&1; then
    expect "python reads the archive" 0 '^None 13$' - python3 -c \
        'import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); print(z.testzip(), len(z.namelist()))' "${long%obj}zip"
else
    echo "skip python reads the archive: python3 is not installed"
fi
cp in/two/more.yaml in/two/meshes
expect "a scene that is called as a folder of the package" 0 - - "$glint" pack in/two/meshes called
"$glint" deps --format make odd/-s.yaml 2>err.txt | sed 's/^[^ ]*:/every:/' >odd.d
printf '\t@echo %s files\n' '$(words $^)' >>odd.d
if command -v make >/dev/null 2>&1; then expect "make finds every odd name" 0 files - make -s -f odd.d every; else
    echo "skip make finds every odd name: make is not installed"
fi
mkdir limited
printf 'limits: {mesh-corners: 70000}\n' >limited.yaml
cp in/two/more.yaml in/two/tri.obj in/two/tri.mtl limited/
expect "pack with limits that were raised" 0 - '^limited.d: needs limits that were raised: use it with --config and its limits.yaml$' \
    "$glint" pack limited/more.yaml limited.d --limit include-files=300 --config limited.yaml
printf 'limits:\n  include-files: 300\n  mesh-corners: 70000\n' >wanted.txt
same "raised limits go along" limited.d/limits.yaml wanted.txt
expect "to be used by who trusts them" 0 - - "$glint" check limited.d/more.yaml --config limited.d/limits.yaml
mv limited/more.yaml limited/limits.yaml
expect "pack a scene called limits.yaml" 0 - 'limits-2.yaml' "$glint" pack limited/limits.yaml limited.e --limit include-files=300
expect "both are there" 0 'include-files: 300' - cat limited.e/limits-2.yaml

mkdir -p shared/a shared/b
cp in/one/tri.obj shared/a/ && cp in/two/tri.obj shared/b/ && cp in/one/tri.mtl shared/a/ && ln -s ../a/tri.mtl shared/b/tri.mtl
printf 'glint: 1\nmodels: [{mesh: a/tri.obj}, {mesh: b/tri.obj}]\n' >shared/scene.yaml
expect "pack with a material file of two meshes" 0 - - "$glint" pack shared/scene.yaml shared.d
same "it lies beside each of them" shared.d/meshes/tri.mtl shared.d/meshes-2/tri.mtl

# ---- what must not happen
mkdir full && : >full/mine
expect "pack into a folder with files" 3 - 'is not an empty folder' "$glint" pack in/sub/scene.yaml full
expect "pack of a mesh" 0 - '' "$glint" pack in/one/tri.obj mesh_alone
expect "and what is in it" 0 'mesh_alone/meshes/tri.mtl' '' "$glint" deps mesh_alone/tri.glint.yaml
expect "pack into a folder that is not there" 3 - 'error: .*E802' "$glint" pack in/sub/scene.yaml nowhere/x
expect "pack of a scene with a missing mesh" 1 - 'E601' "$glint" pack gone.yaml x
printf 'glint: 1\nmodels:\n  - mesh: >-\n      in/one/tri.obj\n' >block.yaml
"$glint" pack block.yaml block >err.txt 2>&1
status=$?
if [ $status -eq 0 ]; then
    "$glint" check block/block.yaml && pass "a path in a block is packed" || fail "a path in a block is packed"
elif grep -q 'on one line' err.txt && [ ! -e block ]; then pass "a path in a block is refused"; else fail "a path in a block"; fi
printf 'mtllib %s/mats/deep.mtl\n' "$(pwd -P)" >abs.obj
sed 1d in/one/tri.obj >>abs.obj
printf 'glint: 1\nmodels: [{mesh: abs.obj}]\n' >abs.yaml
expect "pack of a mesh with an absolute path" 1 - 'E804' "$glint" pack abs.yaml x
# A signal while it works: the folder may be there in whole or not at all.
mkdir large
awk 'BEGIN { for (i = 0; i < 100000; i++) printf "v %d 0 0\nv %d 1 0\nv %d 0 1\nf -1 -2 -3\n", i, i, i }' >large/large.obj
printf 'glint: 1\nmodels: [{mesh: large.obj}]\n' >large/scene.yaml
"$glint" pack large/scene.yaml large.d 2>err.txt &
pid=$!
tries=0
while [ $tries -lt 2400 ] && [ ! -e large.d ] && ! ls -d .glint-* >/dev/null 2>&1; do
    tries=$((tries + 1))
    sleep 0.05
done
kill -TERM $pid 2>/dev/null
wait $pid
status=$?
if [ $status -eq 143 ] && [ ! -e large.d ] && grep -q interrupted err.txt; then pass "a signal leaves nothing"; elif
    [ $status -eq 0 ] && [ -f large.d/scene.yaml ]
then echo "skip a signal leaves nothing: it came too late"; else fail "a signal leaves nothing: exit $status"; fi
find . -maxdepth 1 -name '.glint-*' | grep . && fail "nothing is left behind" || pass "nothing is left behind"
exit $failed
