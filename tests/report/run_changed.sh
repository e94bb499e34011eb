#!/bin/sh
# glint check --changed: the scenes that read what changed, by git's word or the user's.
# Usage: run_changed.sh GLINT SOURCE_FOLDER WORK_FOLDER REPORT_TOOL
. "$(dirname -- "$0")/../cli/lib.sh"

view='camera: {position: [0, 0, 9]}
lights: [{position: [0, 5, 5]}]'
mkdir -p repo/scenes repo/lib && cd repo || exit 2
printf 'glint: 1\nmaterials:\n  gold: {diffuse_color: [1, 0.8, 0.2]}\n  tin: {diffuse_color: 0.7}\n' >lib/metals.yaml
printf 'mtllib three.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl blue\nf 1 2 3\n' >lib/three.obj
printf 'newmtl blue\nKd 0 0 1\n' >lib/three.mtl
cp "$source/tests/data/image/interlaced.png" lib/sky.png
: >.glintrc.yaml
for i in 1 2 3; do
    printf 'glint: 1\ninclude: [../lib/metals.yaml]\n%s\nspheres:\n  - {center: [0, 0, 0], radius: 1, material: gold}\n' "$view" \
        >scenes/gold$i.glint.yaml
done
printf 'glint: 1\n%s\nmodels: [{mesh: ../lib/three.obj}]\n' "$view" >scenes/mesh.glint.yaml
printf 'glint: 1\n%s\nbackground: {image: ../lib/sky.png}\nspheres: [{center: [0, 0, 0], radius: 1}]\n' "$view" >scenes/sky.glint.yaml
printf 'glint: 1\n%s\nspheres: [{center: [0, 0, 0], radius: 1}]\n' "$view" >scenes/alone.glint.yaml
changed() { "$glint" check --changed "$@"; }

# ---- files that are named
for pair in lib/metals.yaml:3 lib/three.obj:1 lib/three.mtl:1 lib/sky.png:1 .glintrc.yaml:6 scenes/alone.glint.yaml:1; do
    count=${pair#*:}
    tells "who reads ${pair%:*}" 0 "^glint: $count of 6 scenes reads? what changed: no findings\$" changed "${pair%:*}"
done
printf 'x\n' >notes.txt
tells "what no scene reads" 0 '^glint: none of 6 scenes reads what changed$' changed notes.txt
tells "quiet is quiet" 0 - changed notes.txt -q
tells "several" 0 '^glint: 4 of 6 scenes' changed lib/metals.yaml lib/sky.png notes.txt
(cd lib && "$glint" check --changed three.mtl) >below.txt 2>&1
ok "the root is that of the settings" grep -q '^glint: 1 of 6 scenes reads what changed' below.txt
changed lib/three.mtl --format json >only.json
ok "reports hold those scenes only" sh -c 'grep -q mesh.glint.yaml only.json && ! grep -q gold1 only.json'
tells "in a folder" 0 '^glint: none of 1 scene reads' sh -c "mkdir -p other && cp scenes/alone.glint.yaml other && '$glint' check --changed lib/sky.png other"
rm -r other
cp scenes/gold1.glint.yaml gold4.yaml
tells "a file of another name is a scene, if it is named" 1 '^glint: 1 of 7 scenes reads what changed: 1 error$' changed gold4.yaml
ok "and read" grep -q '^gold4.yaml:2:' out.txt
rm gold4.yaml

# ---- a revision is no option of git
for word in --output=made.txt --no-index -O/etc/passwd --ext-diff; do
    tells "'$word' is no revision" 2 "is not a revision: it begins as an option does" changed -- "$word"
done
ok "and makes no file" test ! -e made.txt

# ---- a material is renamed
sed -i 's/gold:/oro:/' lib/metals.yaml
tells "scenes that a rename breaks fail" 1 '^glint: 3 of 6 scenes read what changed: 3 errors in 3 files$' changed lib/metals.yaml
ok "each at its place" test "$(grep -cE "^scenes/gold[123].glint.yaml:6:[0-9]+: error: there is no material 'gold'" out.txt)" -eq 3
sed -i 's/oro:/gold:/' lib/metals.yaml

# ---- files that are gone
mv lib/three.mtl elsewhere
tells "a material file that is gone" 0 'W601' changed scenes/alone.glint.yaml lib/three.mtl
mv elsewhere lib/three.mtl
mv lib/three.obj elsewhere
tells "a mesh that is gone" 1 '^scenes/mesh.glint.yaml:4:17: error: .*E601' changed notes.txt lib/three.obj
mv elsewhere lib/three.obj
# Another file of its name takes its place: the scene reads, but not what it did.
mkdir -p other && cp lib/three.obj other && cp lib/three.mtl other
printf 'asset_paths: [other]\n' >.glintrc.yaml
sed -i 's|../lib/three.obj|three.obj|' scenes/mesh.glint.yaml
tells "another one in the place of one that is gone" 0 '^glint: 1 of 6 scenes reads' changed notes.txt scenes/three.obj
sed -i 's|three.obj|../lib/three.obj|' scenes/mesh.glint.yaml
: >.glintrc.yaml
rm -r other
printf 'glint: [1\n' >scenes/broken.glint.yaml
tells "a scene that cannot be read counts" 1 '^glint: 1 of 7 scenes reads what changed' changed notes.txt
printf 'glint: 1\n%s\nspheres: [{center: [0, 0, 0], radius: 1, material: none}]\n' "$view" >scenes/broken.glint.yaml
tells "one that reads all its files does not" 0 '^glint: none of 7 scenes' changed notes.txt
printf 'glint: 1\n%s\nspheres: [{radius: -1, center: [0, 0]}]\n' "$view" >scenes/broken.glint.yaml
tells "nor one whose numbers are wrong" 0 '^glint: none of 7 scenes' changed notes.txt
printf 'glint: 1\n%s\nmodels: [{mess: ../lib/three.obj}]\n' "$view" >scenes/broken.glint.yaml
tells "but one that may have named it" 1 '^glint: 1 of 7 scenes reads' changed notes.txt
rm scenes/broken.glint.yaml

# ---- no git
tells "no operand asks git" 2 "git is not installed, or not in the PATH \[E810\]" env PATH=/none "$glint" check --changed
tells "files need none" 0 '^glint: 1 of 6' env PATH=/none "$glint" check --changed lib/sky.png
if ! command -v git >/dev/null; then
    echo "skipped: git is not installed"
    exit $failed
fi
GIT_CEILING_DIRECTORIES=$work GIT_CONFIG_GLOBAL=$work/gitconfig HOME=$work
export GIT_CEILING_DIRECTORIES GIT_CONFIG_GLOBAL HOME
tells "no repository" 2 'command-line:1:13: error: .*git says: fatal: not a git repository.*\[E810\]' changed
git config --global user.name tester
git config --global user.email tester@localhost
git config --global diff.renames true
git config --global diff.relative true
git init -q .
printf '*.txt\n*.json\n' >.git/info/exclude
tells "all is new before the first commit" 0 '^glint: 6 of 6 scenes' changed
git add -A && git commit -q -m one
tells "nothing changed" 0 '^glint: none of 6 scenes' changed
tells "no such revision" 2 'command-line:1:23: error: .*git says: fatal: bad revision .*\[E810\]' changed no-such
sed -i 's/gold:/oro:/' lib/metals.yaml
tells "what is not committed" 1 '^glint: 3 of 6 scenes' changed
git add -A
tells "what is staged" 1 '^glint: 3 of 6 scenes' changed HEAD
(cd lib && "$glint" check --changed) >below.txt 2>&1
ok "the whole repository, from a folder of it" grep -q '^../scenes/gold1.glint.yaml:6' below.txt
git commit -q -m two
tells "what an older commit did not have" 1 '^glint: 3 of 6 scenes' changed HEAD~1
tells "with a file too" 1 '^glint: 4 of 6 scenes' changed HEAD~1 lib/sky.png
git revert -n HEAD >/dev/null && git commit -q -m three
git mv lib/three.obj lib/tria.obj
tells "a renamed mesh" 1 '^scenes/mesh.glint.yaml:4:17: error: .*E601' changed
git reset -q --hard
git mv lib/metals.yaml lib/alloys.yaml
sed -i 's/metals/alloys/' scenes/gold1.glint.yaml
tells "a renamed include" 1 '^glint: 3 of 6 scenes read what changed: [2-9] errors' changed
git reset -q --hard
rm .glintrc.yaml
tells "settings that are gone" 0 '^glint: 6 of 6 scenes' changed
git reset -q --hard
git rm -q lib/three.mtl
tells "a deleted material file" 0 'W601' changed
git reset -q --hard
printf 'glint: 1\n%s\n' "$view" >'scenes/new one.glint.yaml'
tells "a scene that git does not track" 0 '^glint: 1 of 7 scenes reads' changed
printf '*one*\n' >.gitignore
tells "but not one that it ignores" 0 '^glint: none of 7 scenes' changed

exit $failed
