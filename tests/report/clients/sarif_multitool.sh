#!/bin/sh
# The SARIF Multitool, with its rules for SARIF and for GitHub, finds no error and no warning in what glint writes.
. "$(dirname -- "$0")/lib.sh"
needs sarif-multitool

cd "$source"
# shellcheck disable=SC2046 -- our paths hold no blanks
"$glint" check $(ls -d tests/invalid/*/case.yaml tests/invalid/*/case.xml) --format sarif -o "$work/report.sarif" || true
cd "$work"
# The wrapper of npm hands its arguments to a shell once more.
DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 sarif-multitool validate report.sarif -o found.sarif --log ForceOverwrite \
    --rule-kind '"Sarif;Gh"' --level '"Error;Warning"' >multitool.txt 2>&1 || true
grep -q 'Analysis completed successfully' multitool.txt || fail "$(tail -20 multitool.txt)"
grep -E '(error|warning) [A-Z]+[0-9]+:' multitool.txt >said.txt || true
[ ! -s said.txt ] || fail "$(head -20 said.txt)"
# And it can say no.
sed 's/"startLine": [0-9]*/"startLine": 0/' report.sarif >broken.sarif
DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 sarif-multitool validate broken.sarif -o found.sarif --log ForceOverwrite \
    --rule-kind '"Sarif;Gh"' --level '"Error;Warning"' >multitool.txt 2>&1 || true
grep -qE 'error [A-Z]+[0-9]+:' multitool.txt || fail "a broken report was taken"
