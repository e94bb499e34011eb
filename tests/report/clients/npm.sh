#!/bin/sh
# The action, the template for GitLab and the hooks for pre-commit with the npm package, from its archive: no registry is asked.
. "$(dirname -- "$0")/lib.sh"
needs node
needs npm
package=$source/build/web/glint-lint
[ -f "$package/glint.wasm" ] || skip "the npm package is not built; 'cmake --build --preset web' does so"
# Only its own cache, and no line to a registry.
npm_config_cache=$work/cache npm_config_offline=true npm_config_update_notifier=false HOME=$work
export npm_config_cache npm_config_offline npm_config_update_notifier HOME
npm pack --silent --pack-destination "$work" "$package" >/dev/null || fail "npm pack"
archive=$(ls "$work"/glint-lint-*.tgz)
[ "$(basename "$archive")" = "glint-lint-$(cat "$source/VERSION").tgz" ] || fail "the archive is $archive"

mkdir scenes
mv ./*.glint.yaml open.obj scenes
block() {
    awk -v wanted="$2" '
    /^ *run: \|$/ { count++; inside = count == wanted; match($0, /^ */); depth = RLENGTH; next }
    inside { match($0, /^ */); if (RLENGTH <= depth && NF) inside = 0; else print }' "$1"
}
block "$source/action.yml" 1 >find.sh
block "$source/action.yml" 2 >check.sh
GITHUB_OUTPUT=$work/output RUNNER_TEMP=$work/temp GLINT='' GLINT_PACKAGE=$archive GLINT_BUILD=false GLINT_ACTION=$source
export GITHUB_OUTPUT RUNNER_TEMP GLINT GLINT_PACKAGE GLINT_BUILD GLINT_ACTION
begin=$(date +%s%N)
sh -e find.sh 2>said.txt || fail "the first step: $(cat said.txt)"
GLINT=$(sed -n 's/^glint=//p' output)
GLINT_PATHS=scenes GLINT_FAIL_ON=error GLINT_SARIF=glint.sarif GLINT_OPTIONS= GLINT_CHANGED=
export GLINT GLINT_PATHS GLINT_FAIL_ON GLINT_SARIF GLINT_OPTIONS GLINT_CHANGED
sh -e check.sh >said.txt 2>&1 && fail "a wrong scene passed"
echo "the action, with nothing there: $((($(date +%s%N) - begin) / 1000000)) ms"
grep -q '^::error file=scenes/wrong.glint.yaml,line=7,' said.txt || fail "$(cat said.txt)"
"$glint" check scenes --format sarif -o native.sarif >/dev/null 2>&1 || true
cmp -s glint.sarif native.sarif || fail "the report has other bytes than the native one"

# The template installs it where no glint is.
sed -n '/^  before_script:$/,/^  script:$/s/^    - //p' "$source/tools/ci/gitlab.yml" >before.sh
sed -n '/^  script:$/,/^  artifacts:$/s/^    - //p' "$source/tools/ci/gitlab.yml" >gitlab.sh
mkdir bin
for program in sh node npm git env cat grep; do ln -s "$(command -v $program)" bin/$program; done
(
    PATH=$work/bin:$work/global/bin npm_config_prefix=$work/global GLINT_PACKAGE=$archive
    export PATH npm_config_prefix GLINT_PACKAGE
    sh -e before.sh >said.txt 2>&1 || fail "before_script: $(cat said.txt)"
    sh -e gitlab.sh >said.txt 2>&1 && fail "a wrong scene passed"
    grep -q 'wrong.glint.yaml:7:33: error: ' said.txt || fail "GitLab: $(cat said.txt)"
) || exit 1

# Hooks name the version that is here.
grep -q "additional_dependencies: \[glint-lint@$(cat "$source/VERSION")\]" "$source/.pre-commit-hooks.yaml" || fail "hooks name another version"
needs git
command -v pre-commit >/dev/null || {
    echo "pre-commit is not installed: its hooks are not run"
    exit 0
}
PRE_COMMIT_HOME=$work/pre-commit GIT_CONFIG_GLOBAL=$work/gitconfig
export PRE_COMMIT_HOME GIT_CONFIG_GLOBAL
git config --global user.name tester
git config --global user.email tester@localhost
git config --global init.defaultBranch main
mkdir hooks
cp "$source/.pre-commit-hooks.yaml" "$source/package.json" hooks
sed -i "s#glint-lint@[0-9.]*#$archive#" hooks/.pre-commit-hooks.yaml
(cd hooks && git init -q && git add -A && git commit -q -m hooks)
cd scenes
git init -q
git add -A
pre-commit try-repo ../hooks glint-check-node --all-files >../said.txt 2>&1 && fail "a wrong scene passed: $(cat ../said.txt)"
grep -q 'wrong.glint.yaml:7:33: error: ' ../said.txt || fail "$(cat ../said.txt)"
git rm -q --cached wrong.glint.yaml
rm wrong.glint.yaml
pre-commit try-repo ../hooks glint-check-node --all-files >../said.txt 2>&1 || fail "$(cat ../said.txt)"
printf 'glint:   1\n' >loose.glint.yaml
git add loose.glint.yaml
pre-commit try-repo ../hooks glint-format-node --files loose.glint.yaml >../said.txt 2>&1 && fail "nothing was laid out"
[ "$(cat loose.glint.yaml)" = "glint: 1" ] || fail "$(cat ../said.txt loose.glint.yaml)"
