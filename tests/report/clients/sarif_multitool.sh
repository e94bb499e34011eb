#!/bin/sh
# The SARIF Multitool finds no error and no warning in what glint writes, but for what a command line cannot know.
. "$(dirname -- "$0")/lib.sh"
needs sarif-multitool

cd "$source"
# shellcheck disable=SC2046 -- our paths hold no blanks
"$glint" check $(ls -d tests/invalid/*/case.yaml tests/invalid/*/case.xml) --format sarif -o "$work/report.sarif" || true
cd "$work"
DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 sarif-multitool validate report.sarif -o found.sarif --log ForceOverwrite \
    --rule-kind "Sarif;Gh" --level "Error;Warning" >multitool.txt 2>&1 || true
[ -s found.sarif ] || fail "$(tail -20 multitool.txt)"
grep -oE '"ruleId": *"[A-Za-z0-9]*' found.sarif | sort | uniq -c >rules.txt || true
cat rules.txt
[ ! -s rules.txt ] || fail "the Multitool has something to say"
