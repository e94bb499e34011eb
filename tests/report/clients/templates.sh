#!/bin/sh
# The commands of the GitHub action and of the GitLab template, as their runners would start them.
. "$(dirname -- "$0")/lib.sh"

mkdir scenes
mv ./*.glint.yaml open.obj scenes
# Block number $2 of those that follow `run: |` in the action.
block() {
    awk -v wanted="$2" '
    /^ *run: \|$/ { count++; inside = count == wanted; match($0, /^ */); depth = RLENGTH; next }
    inside { match($0, /^ */); if (RLENGTH <= depth && NF) inside = 0; else print }' "$1"
}
block "$source/action.yml" 1 >find.sh
block "$source/action.yml" 2 >check.sh
grep -q 'check --untrusted \$GLINT_PATHS' check.sh || fail "action.yml has no such step"

GITHUB_OUTPUT=$work/output GLINT=$glint GLINT_ACTION=$source
export GITHUB_OUTPUT GLINT GLINT_ACTION
sh -e find.sh || fail "the first step"
[ "$(cat output)" = "glint=$glint" ] || fail "the first step tells '$(cat output)'"
GLINT_PATHS=scenes GLINT_FAIL_ON=error GLINT_SARIF=glint.sarif GLINT_OPTIONS="--only W401" GLINT_CHANGED=
export GLINT_PATHS GLINT_FAIL_ON GLINT_SARIF GLINT_OPTIONS GLINT_CHANGED
sh -e check.sh >said.txt 2>&1 && fail "a wrong scene passed"
grep -q '^::error file=scenes/wrong.glint.yaml,line=7,' said.txt || fail "$(cat said.txt)"
"$tool" validate "$source/tests/report/sarif.schema.json" glint.sarif || fail "the SARIF report"
GLINT_PATHS=scenes/warned.glint.yaml sh -e check.sh >said.txt 2>&1 || fail "a warning failed"
grep -q '^::warning file=scenes/warned.glint.yaml,line=5,' said.txt || fail "$(cat said.txt)"
GLINT_PATHS=scenes/warned.glint.yaml GLINT_FAIL_ON=warning sh -e check.sh >said.txt 2>&1 && fail "a warning passed"

PATH=$(dirname -- "$glint"):$PATH
export PATH
unset GLINT_CHANGED
sed -n '/^  script:$/,/^  artifacts:$/s/^    - //p' "$source/tools/ci/gitlab.yml" >gitlab.sh
[ "$(grep -c '^glint check ' gitlab.sh)" -eq 3 ] || fail "tools/ci/gitlab.yml has other commands"
GLINT_FAIL_ON=error sh -e gitlab.sh >said.txt 2>&1 && fail "a wrong scene passed"
"$tool" validate "$source/tests/report/gitlab.schema.json" gl-code-quality-report.json || fail "the report for GitLab"
grep -q '<failure ' glint-junit.xml || fail "the report of tests"

# ---- what a change breaks elsewhere
needs git
rename_a_material
cd repo
GLINT_PATHS=. GLINT_SARIF=
since=$(git rev-parse HEAD)
git commit -q -m rename

# As pre-commit starts the hook: with the names of the files that are there and were changed.
entry=$(sed -n '/^- id: glint-check$/,/^- id: glint-format$/s/^  entry: //p' "$source/.pre-commit-hooks.yaml")
[ -n "$entry" ] || fail "no hook"
git reset -q --soft HEAD~1
# shellcheck disable=SC2046,SC2086 -- our paths hold no blanks
$entry $(git diff --cached --name-only --diff-filter=ACMR) >../said.txt 2>&1 && fail "the hook lets a rename pass"
[ "$(grep -c "error: there is no material 'gold'" ../said.txt)" -eq 25 ] || fail "the hook: $(tail -3 ../said.txt)"
git mv lib/metals.yaml lib/alloys.yaml
$entry lib/alloys.yaml >../said.txt 2>&1 && fail "the hook lets a renamed file pass"
git mv lib/alloys.yaml lib/metals.yaml
sed -i 's/oro:/gold:/' lib/metals.yaml
printf 'glint: 1\nspheres: [{radius: -1}]\n' >scenes/old.glint.yaml
git add -A && git commit -q -m old
printf '\n' >>lib/metals.yaml && git add -A
$entry lib/metals.yaml >../said.txt 2>&1 || fail "the hook refuses a right commit: $(cat ../said.txt)"
git reset -q --hard "$since" && sed -i 's/gold:/oro:/' lib/metals.yaml && git add -A && git commit -q -m rename

GLINT_CHANGED=$since sh -e ../check.sh >../said.txt 2>&1 && fail "the action lets a rename pass"
grep -q '^::error file=scenes/gold01.glint.yaml,line=5,' ../said.txt || fail "the action: $(cat ../said.txt)"
CI_MERGE_REQUEST_DIFF_BASE_SHA=$since sh -e ../gitlab.sh >../said.txt 2>&1 && fail "GitLab lets a rename pass"
grep -q '^glint: 25 of 30 scenes read what changed: 25 errors' ../said.txt || fail "GitLab: $(cat ../said.txt)"
grep -q 'tests="25" failures="25"' glint-junit.xml || fail "GitLab's tests: $(head -2 glint-junit.xml)"

# A clone without history fetches the revision, and where it cannot, everything is checked.
rm -f glint-junit.xml gl-code-quality-report.json
cd ..
git -C repo config uploadpack.allowAnySHA1InWant true
git clone -q --depth=1 "file://$work/repo" shallow
cd shallow
GLINT_CHANGED=$since sh -e ../check.sh >../said.txt 2>&1 && fail "a shallow clone lets a rename pass"
grep -q 'every scene' ../said.txt && fail "the revision was not fetched: $(cat ../said.txt)"
GLINT_CHANGED=0123456789012345678901234567890123456789 sh -e ../check.sh >../said.txt 2>&1 && fail "a lost revision lets it pass"
grep -q '^glint: every scene is checked' ../said.txt || fail "a lost revision: $(cat ../said.txt)"
GLINT_CHANGED=0123456789012345678901234567890123456789 sh -e ../gitlab.sh >../said.txt 2>&1 && fail "GitLab, a lost revision"
grep -q '^glint: 25 errors in 30 files; 5 clean$' ../said.txt || fail "GitLab, a lost revision: $(cat ../said.txt)"
