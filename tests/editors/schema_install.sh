#!/bin/sh
# glint schema install: the line that tells editors the schema, and nothing else of the file.
. "$(dirname -- "$0")/lib.sh"

printf '# a comment\nglint: 1\n' >a.yaml
printf '<?xml version="1.0"?>\r\n<Scene glint="1"/>\r\n' >b.xml
printf '<Scene glint="1"/>' >c.xml
printf '\357\273\277glint: 1\n' >d.yaml
printf 'glint: 1\rimage: {width: 3}\r' >e.yaml
mkdir deep && cp a.yaml deep/
"$glint" schema install a.yaml b.xml c.xml d.yaml e.yaml deep/a.yaml || fail "install"

printf '# yaml-language-server: $schema=glint.schema.json\n# a comment\nglint: 1\n' >wanted
cmp a.yaml wanted || fail "a comment before the first key"
pi='<?xml-model href="glint.rng" type="application/xml" schematypens="http://relaxng.org/ns/structure/1.0"?>'
printf '<?xml version="1.0"?>\r\n%s\r\n<Scene glint="1"/>\r\n' "$pi" >wanted
cmp b.xml wanted || fail "behind the declaration, with its line ends"
printf '%s\n<Scene glint="1"/>' "$pi" >wanted
cmp c.xml wanted || fail "no declaration, no last line end"
printf '\357\273\277# yaml-language-server: $schema=glint.schema.json\nglint: 1\n' >wanted
cmp d.yaml wanted || fail "behind the byte order mark"
printf '# yaml-language-server: $schema=glint.schema.json\rglint: 1\rimage: {width: 3}\r' >wanted
cmp e.yaml wanted || fail "line ends of one carriage return"
for file in a.yaml b.xml c.xml d.yaml e.yaml deep/a.yaml; do "$glint" check $file || fail "$file is still a scene"; done

# The schema lies beside the scene, and is what the program prints.
"$glint" schema json >wanted
cmp glint.schema.json wanted || fail "the schema beside the scene"
cmp deep/glint.schema.json wanted || fail "the schema beside the scene below"
"$glint" schema relaxng >wanted
cmp glint.rng wanted || fail "the RELAX NG beside the scene"

# A second time changes nothing; another address changes the line alone; an old schema is renewed.
cp a.yaml wanted && "$glint" schema install a.yaml && cmp a.yaml wanted || fail "twice"
"$glint" schema install --schema https://example.org/glint.schema.json a.yaml
printf '# yaml-language-server: $schema=https://example.org/glint.schema.json\n# a comment\nglint: 1\n' >wanted
cmp a.yaml wanted || fail "another address"
echo '{}' >glint.schema.json
"$glint" schema install d.yaml
"$glint" schema json >wanted
cmp glint.schema.json wanted || fail "an old schema is renewed"
"$glint" schema install --schema a.rnc b.xml && grep -q 'relax-ng-compact-syntax' b.xml || fail "compact syntax"

status=0 && "$glint" schema install 2>err || status=$?
[ $status -eq 2 ] || fail "no file named"
status=0 && "$glint" schema install gone.yaml 2>err || status=$?
[ $status -eq 3 ] || fail "a file that is not there"
printf '{"glint": 1}\n' >e.json
cp e.json wanted
status=0 && "$glint" schema install e.json 2>err || status=$?
[ $status -eq 2 ] && cmp e.json wanted || fail "JSON has no comments"
status=0 && "$glint" schema jso 2>err || status=$?
[ $status -eq 2 ] && grep -q "did you mean 'json'" err || fail "a kind that is none"
echo ok
