#!/bin/sh
# pre-commit runs the hook of this repository, from a copy of the working tree.
. "$(dirname -- "$0")/lib.sh"
needs pre-commit
needs git

HOME=$work PRE_COMMIT_HOME=$work/cache GIT_CONFIG_GLOBAL=$work/gitconfig
PATH=$(dirname -- "$glint"):$PATH
export HOME PRE_COMMIT_HOME GIT_CONFIG_GLOBAL PATH
git config --global user.name tester
git config --global user.email tester@localhost
git config --global init.defaultBranch main
mkdir hooks scenes
cp "$source/.pre-commit-hooks.yaml" hooks
mv ./*.glint.yaml open.obj scenes
(cd hooks && git init -q && git add -A && git commit -q -m hooks)
cd scenes
git init -q
git add -A
if pre-commit try-repo ../hooks glint-check --all-files >../said.txt 2>&1; then
    fail "a wrong scene passed: $(cat ../said.txt)"
fi
grep -q 'wrong.glint.yaml:7:33: error: ' ../said.txt || fail "$(cat ../said.txt)"
grep -q 'open.obj' ../said.txt || fail "$(cat ../said.txt)"
git rm -q --cached wrong.glint.yaml
rm wrong.glint.yaml
pre-commit try-repo ../hooks glint-check --all-files >../said.txt 2>&1 || fail "$(cat ../said.txt)"

# What a commit breaks in scenes that it does not touch.
cd ..
rename_a_material
cd repo
pre-commit try-repo ../hooks glint-check >../said.txt 2>&1 && fail "a renamed material passed: $(cat ../said.txt)"
[ "$(grep -c "error: there is no material 'gold'" ../said.txt)" -eq 25 ] || fail "$(cat ../said.txt)"
sed -i 's/oro:/gold:/' lib/metals.yaml && printf '\n' >>lib/metals.yaml && git add -A
pre-commit try-repo ../hooks glint-check >../said.txt 2>&1 || fail "$(cat ../said.txt)"
git rm -q --cached lib/metals.yaml && rm lib/metals.yaml
pre-commit try-repo ../hooks glint-check >../said.txt 2>&1 && fail "a deleted file passed: $(cat ../said.txt)"
cd ../scenes

# A hook that changes a file fails once, and is content with what it wrote.
printf 'glint:   1\n' >loose.glint.yaml
git add loose.glint.yaml
pre-commit try-repo ../hooks glint-format --files loose.glint.yaml >../said.txt 2>&1 && fail "nothing was laid out"
[ "$(cat loose.glint.yaml)" = "glint: 1" ] || fail "$(cat ../said.txt loose.glint.yaml)"
git add loose.glint.yaml
pre-commit try-repo ../hooks glint-format --files loose.glint.yaml >../said.txt 2>&1 || fail "$(cat ../said.txt)"
