#!/bin/sh
# Both syntaxes of RELAX NG say the same to jing: on scenes, on generated ones, on the invalid corpus.
. "$(dirname -- "$0")/lib.sh"
needs jing
"$glint" schema rnc >glint.rnc
"$glint" schema relaxng >glint.rng
seed=0
while [ $seed -lt 20 ]; do
    "$generate" $seed xml >generated$seed.xml
    seed=$((seed + 1))
done
# shellcheck disable=SC2046
jing -c glint.rnc $(xml_scenes) generated*.xml || fail "the compact syntax refuses a scene"
# shellcheck disable=SC2046
jing glint.rng $(xml_scenes) generated*.xml || fail "the XML syntax refuses a scene"
# jing names each file that it refuses, and stops at one that is no XML, whatever the schema: those are put away.
xml_cases >verdicts
mkdir cases && : >no_xml
while read -r name verdict; do cp "$source/tests/invalid/$name/case.xml" "cases/$name.xml"; done <verdicts
while jing glint.rng cases/*.xml >report 2>&1 || true && grep ': fatal: ' report >fatal; do
    name=$(sed 's|.*/\([^/]*\)\.xml:.*: fatal: .*|\1|' fatal)
    echo "/$name.xml:" >>no_xml
    rm "cases/$name.xml"
done
: >disagree
for syntax in "-c glint.rnc" "glint.rng"; do
    # shellcheck disable=SC2086
    jing $syntax cases/*.xml >report 2>&1 || true
    grep ': fatal: ' report && fail "jing $syntax stopped"
    cat no_xml report >refused
    while read -r name verdict; do
        got=good
        grep -q "/$name.xml:" refused && got=bad
        [ $got = "$verdict" ] || echo "$name is $verdict, and jing $syntax takes it for $got" >>disagree
    done <verdicts
done
[ ! -s disagree ] || fail "$(cat disagree)"
wc -l <verdicts
