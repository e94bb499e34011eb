#!/bin/sh
# What knows no scene is not silently green: names of scenes, the root of a work tree, includes that cannot be read.
# Usage: run_names.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
GIT_CEILING_DIRECTORIES=$work GIT_CONFIG_GLOBAL=$work/gitconfig HOME=$work
export GIT_CEILING_DIRECTORIES GIT_CONFIG_GLOBAL HOME
ball='spheres: [{center: [0, 0, 0], radius: 1}]'
view='camera: {position: [0, 0, 9]}
lights: [{position: [0, 5, 5]}]'

# ---- scenes with other names
mkdir -p plain && cd plain || exit 2
printf '\357\273\277# a comment\n\n---\nglint: 1\n%s\n%s\n' "$view" "$ball" >scene.yaml
printf '<?xml version="1.0"?>\n<!-- > -->\n<Scene\n  glint="1"><Sphere radius="-1"/></Scene>\n' >other.xml
printf '{"glint": 1}\n' >json.json
printf 'glinting: 1\n' >no.yaml
printf '<Scenes glint="1"/>\n' >no.xml
printf 'a: glint\nglint: 1\n' >late.yaml
for command in check format test; do
    tells "$command of a folder without scenes" 2 "error: there is no scene in the folder '\.' \[E801\]" "$glint" $command .
    ok "names those that may be meant" grep -q '= help: .*json.json, other.xml, scene.yaml begin as scenes do' out.txt
done
tells "the error names three of many" 2 'm/a.yaml, m/b.yaml, m/c.yaml and 1 more begin' sh -c "mkdir m; for i in a b c d; do cp scene.yaml m/\$i.yaml; done; '$glint' check m"
rm -r m
cp scene.yaml good.glint.yaml
tells "beside a scene they are warned of" 0 '^glint: 3 warnings in 4 files; 1 clean$' "$glint" check .
ok "each by its name" sh -c "grep -q '^scene.yaml:1:1: warning: .*W803' out.txt && grep -q \"rename it to 'other.glint.xml'\" out.txt"
ok "and nothing else is" test "$(grep -c W803 out.txt)" -eq 3
tells "which fails if warnings do" 1 W803 "$glint" check . --fail-on warning
tells "and can be turned off by path" 0 - "$glint" check . --ignore '*.json' --ignore other.xml --ignore scene.yaml
tells "a file that is named is checked" 1 '^other.xml:4:.*E206' "$glint" check . other.xml
"$glint" format . >out.txt 2>&1
ok "format warns too" test "$(grep -c W803 out.txt)" -eq 3
cp scene.yaml capital.glint.YAML
tells "capitals in an ending hide no scene" 0 "^capital.glint.YAML:1:1: warning: .*W803" "$glint" check .
ok "nor confuse its new name" grep -q "rename it to 'capital.glint.yaml'" out.txt
{ seq -f '# line %.0f of a long licence' 20000; tail -c +4 scene.yaml; } >long.yaml
{ echo '<!--'; seq -f 'line %.0f of a long licence' 20000; echo '-->'; tail -n 2 other.xml; } >long.xml
tells "a long comment before it hides none" 0 '^long.yaml:1:1: warning: .*W803' "$glint" check .
ok "in XML neither" grep -q '^long.xml:1:1: warning: .*W803' out.txt
rm capital.glint.YAML long.yaml long.xml
tells "a file is checked once, however often it is named" 0 '^glint: 3 warnings in 4 files; 1 clean$' "$glint" check . ./good.glint.yaml "$PWD/good.glint.yaml" ../plain/good.glint.yaml
printf 'include: [scene.yaml]\nglint: 1\n%s\n' "$view" >good.glint.yaml
tells "what a scene reads is no scene that was forgotten" 0 '^glint: 2 warnings in 3 files' "$glint" check .
"$glint" format --check . >out.txt 2>&1
ok "for format neither" test "$(grep -c W803 out.txt)" -eq 2
cd .. || exit 2

# ---- nothing is left
mkdir -p left/drafts && cd left || exit 2
printf 'glint: 1\nspheres: [{radius: -1}]\n' >drafts/a.glint.yaml
printf 'ignore: ["drafts/**"]\n' >.glintrc.yaml
for format in text json sarif; do
    tells "a folder that is ignored as a whole, $format" 2 "error: nothing was checked: 'ignore' leaves out 1 scene" "$glint" check . --format $format
done
tells "a file that is named may be" 0 "^glint: nothing was checked: 'ignore' leaves out 1 scene\$" "$glint" check drafts/a.glint.yaml
printf 'glint: 1\n%s\n%s\n' "$view" "$ball" >good.glint.yaml
tells "one that is left is enough" 0 - "$glint" check .
cd .. || exit 2

# ---- --changed
if ! command -v git >/dev/null; then
    echo "skipped: git is not installed"
    exit $failed
fi
git config --global user.name tester
git config --global user.email tester@localhost
git init -q changed && cd changed || exit 2
mkdir 'a b'
printf 'glint: 1\nspheres: [{radius: -1}]\n' >'a b/scene.yaml'
tells "a repository that has no scene" 2 "^command-line:1:13: error: there is no scene in the folder '\.' \[E801\]" "$glint" check --changed HEAD
tells "a scene that is named is checked" 1 '^glint: 1 of 1 scene reads what changed: [0-9]+ errors?$' "$glint" check --changed HEAD 'a b/scene.yaml'
git add -A && git commit -q -m one
printf 'glint: 1\n%s\n%s\n' "$view" "$ball" >good.glint.yaml
tells "one that did not change is not warned of" 0 '^glint: 1 of 1 scene reads what changed: no findings$' "$glint" check --changed HEAD
echo '# x' >>'a b/scene.yaml'
tells "one that did is" 0 '^glint: 1 of 1 scene reads what changed: 1 warning' "$glint" check --changed HEAD
cd .. || exit 2

# ---- scenes beside lib
mkdir -p tree/scenes tree/lib && cd tree || exit 2
printf 'glint: 1\nmaterials: {gold: {diffuse_color: [1, 0.8, 0.2]}}\n' >lib/metals.yaml
printf 'glint: 1\ninclude: [../lib/metals.yaml]\n%s\nmaterials: {own: {}}\nspheres:\n' "$view" >scenes/a.glint.yaml
printf '  - {center: [%s, 0, 0], radius: 1, material: %s}\n' 0 gold 3 own 6 owm >>scenes/a.glint.yaml
tells "an include outside says what allows it" 1 "help: put an empty .glintrc.yaml into '$work/tree', .*'glint check --fix' does" "$glint" check scenes
ok "other findings are not hidden" grep -q "^scenes/a.glint.yaml:9:46: error: there is no material 'owm' \[E301\]" out.txt
ok "nor taken for certain" grep -q "note: unless it is in this file, which could not be read" out.txt
ok "names that may be in it are named" grep -q "^scenes/a.glint.yaml:7:46: note: the material 'gold' is not in the files that were read" out.txt
ok "and are no errors" test "$(grep -c 'error: ' out.txt)" -eq 2
tells "no baseline is written over it" 3 "the baseline is not written: 'scenes/a.glint.yaml' could not be checked" "$glint" check scenes --write-baseline known.txt
ok "nothing is there" test ! -e known.txt
tells "from another folder it is no certain fix" 1 "'glint check --fix=all' does" sh -c "cd scenes && '$glint' check --fix ."
ok "and not made" test ! -e .glintrc.yaml
tells "the patch has the file" 1 '^\+\+\+ .glintrc.yaml$' "$glint" check scenes --fix --diff
sed -i '/owm/d' scenes/a.glint.yaml
tells "the fix makes it" 0 '^.glintrc.yaml: created$' "$glint" check scenes --fix
tells "then all is well" 0 - "$glint" check scenes
rm .glintrc.yaml
git init -q .
tells "so it is in a work tree" 0 - "$glint" check scenes
sed -i 's|\.\./lib|../../tree/../out|' scenes/a.glint.yaml && mkdir -p ../out && cp lib/metals.yaml ../out
tells "but nothing above its top" 1 "E602" "$glint" check scenes
ok "which is said" grep -q "help: the scene may read what is below '$work/tree', the top of its git work tree" out.txt
rm -r .git && mkdir .git
tells "an empty folder is no repository" 1 "its own folder" "$glint" check scenes
rmdir .git && printf 'gitdir: elsewhere\n' >.git
sed -i 's|\.\./\.\./tree/\.\./out|../lib|' scenes/a.glint.yaml
tells "a submodule is" 0 - "$glint" check scenes
ln -s "$work/out" lib/link
sed -i 's|lib/metals|lib/link/metals|' scenes/a.glint.yaml
tells "a link that leads out is refused" 1 E602 "$glint" check scenes
sed -i 's|lib/link/metals|lib/metals|' scenes/a.glint.yaml
: >scenes/.glintrc.yaml
tells "settings go before the work tree" 1 "help: the scene may read what is below '$work/tree/scenes', the folder of the nearest .glintrc.yaml" "$glint" check scenes
rm scenes/.glintrc.yaml
if [ "$(id -u)" -eq 0 ]; then
    chown 12345 .git
    tells "nor one of another user" 1 E602 env -u SUDO_UID "$glint" check scenes
    tells "but that of who called sudo" 0 - env SUDO_UID=12345 "$glint" check scenes
    chown 0 .git
fi
GIT_CEILING_DIRECTORIES=$work/tree
tells "a ceiling holds" 1 E602 "$glint" check scenes
exit $failed
