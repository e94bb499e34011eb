# What the tests with real clients of reports share: scenes to report on.
. "$(dirname -- "$0")/../../clients.sh"
tool=$4
manual=docs/ci.md

cat >wrong.glint.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5]}
lights: [{position: [0, 5, 5]}]
materials:
  unused: {}
spheres:
  - {center: [0, 0, 0], radius: -1}
  - {center: [0, 0, 0], radius: 1, material: unusd}
S
cat >warned.glint.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5]}
lights: [{position: [0, 5, 5]}]
models:
  - {mesh: open.obj, material: {albedo: [0.1, 0, 0, 0.9], refractive_index: 1.5}}
S
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >open.obj

# A repository in `repo` with 30 scenes, of which 25 read a file of materials; then one of these materials is renamed, in
# the file and in no scene. Git does not read the settings of who runs the test.
rename_a_material() {
    GIT_CONFIG_GLOBAL=$work/gitconfig
    export GIT_CONFIG_GLOBAL
    git config --global user.name tester
    git config --global user.email tester@localhost
    git config --global init.defaultBranch main
    mkdir -p repo/scenes repo/lib
    printf 'glint: 1\nmaterials: {gold: {diffuse_color: [1, 0.8, 0.2]}}\n' >repo/lib/metals.yaml
    printf 'glint: 1\ncamera: {position: [0, 0, 9]}\nlights: [{position: [0, 5, 5]}]\n' >plain.yaml
    printf 'spheres: [{center: [0, 0, 0], radius: 1}]\n' >>plain.yaml
    sed 's|^camera|include: [../lib/metals.yaml]\n&|; s|radius: 1|&, material: gold|' plain.yaml >gold.yaml
    for i in 01 02 03 04 05 06 07 08 09 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25; do
        cp gold.yaml repo/scenes/gold$i.glint.yaml
    done
    for i in 1 2 3 4 5; do cp plain.yaml repo/scenes/plain$i.glint.yaml; done
    : >repo/.glintrc.yaml
    (cd repo && git init -q && git add -A && git commit -q -m scenes)
    sed -i 's/gold:/oro:/' repo/lib/metals.yaml
    (cd repo && git add -A)
}
