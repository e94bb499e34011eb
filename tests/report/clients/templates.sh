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
grep -q 'check \$GLINT_PATHS' check.sh || fail "action.yml has no such step"

GITHUB_OUTPUT=$work/output GLINT=$glint GLINT_ACTION=$source
export GITHUB_OUTPUT GLINT GLINT_ACTION
sh -e find.sh || fail "the first step"
[ "$(cat output)" = "glint=$glint" ] || fail "the first step tells '$(cat output)'"
GLINT_PATHS=scenes GLINT_FAIL_ON=error GLINT_SARIF=glint.sarif GLINT_OPTIONS="--only W401"
export GLINT_PATHS GLINT_FAIL_ON GLINT_SARIF GLINT_OPTIONS
sh -e check.sh >said.txt 2>&1 && fail "a wrong scene passed"
grep -q '^::error file=scenes/wrong.glint.yaml,line=7,' said.txt || fail "$(cat said.txt)"
"$tool" validate "$source/tests/report/sarif.schema.json" glint.sarif || fail "the SARIF report"
GLINT_PATHS=scenes/warned.glint.yaml sh -e check.sh >said.txt 2>&1 || fail "a warning failed"
grep -q '^::warning file=scenes/warned.glint.yaml,line=5,' said.txt || fail "$(cat said.txt)"
GLINT_PATHS=scenes/warned.glint.yaml GLINT_FAIL_ON=warning sh -e check.sh >said.txt 2>&1 && fail "a warning passed"

PATH=$(dirname -- "$glint"):$PATH
export PATH
sed -n 's/^    - \(glint check .*\)$/\1/p' "$source/tools/ci/gitlab.yml" >gitlab.sh
[ "$(wc -l <gitlab.sh)" -eq 3 ] || fail "tools/ci/gitlab.yml has other commands"
GLINT_FAIL_ON=error sh -e gitlab.sh >said.txt 2>&1 && fail "a wrong scene passed"
"$tool" validate "$source/tests/report/gitlab.schema.json" gl-code-quality-report.json || fail "the report for GitLab"
grep -q '<failure ' glint-junit.xml || fail "the report of tests"
