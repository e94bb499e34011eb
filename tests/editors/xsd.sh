#!/bin/sh
# The XML Schema is one, and accepts every scene that ships and generated ones: it serves completion.
. "$(dirname -- "$0")/lib.sh"
needs xmllint
"$glint" schema xsd >glint.xsd
seed=0
while [ $seed -lt 40 ]; do
    "$generate" $seed xml >generated$seed.xml
    seed=$((seed + 1))
done
# shellcheck disable=SC2046
xmllint --noout --schema glint.xsd $(xml_scenes) generated*.xml >report 2>&1 || {
    grep -v ' validates$' report | head -20
    fail "a scene is refused"
}
grep -c ' validates$' report
printf '<Scene glint="1"><Image widht="3"/></Scene>\n' >bad.xml
xmllint --noout --schema glint.xsd bad.xml 2>/dev/null && fail "a misspelt attribute is accepted"
printf '<Scene glint="1"><Image tone="Clip"/></Scene>\n' >bad.xml
xmllint --noout --schema glint.xsd bad.xml 2>/dev/null && fail "a word that is none is accepted"
# And RELAX NG, by the same program, on the invalid corpus.
"$glint" schema relaxng >glint.rng
xml_cases | while read -r name verdict; do
    got=bad
    xmllint --noout --relaxng glint.rng "$source/tests/invalid/$name/case.xml" >/dev/null 2>&1 && got=good
    [ $got = "$verdict" ] || fail "$name is $verdict, and RELAX NG takes it for $got"
done
