#!/bin/sh
# Reports, folders, settings and comments, as a user meets them.
# Usage: run_report.sh GLINT SOURCE_FOLDER WORK_FOLDER REPORT_TOOL
. "$(dirname -- "$0")/../cli/lib.sh"
tool=$4

get() { [ "$("$tool" get "$1" "$2")" = "$3" ]; }
lacks() { ! grep -qE -e "$2" "$1"; }

# ---- every format, over all that is wrong and all that is right
cd "$source" || exit 2
corpus="$(ls -d tests/invalid/*/case.yaml tests/invalid/*/case.xml)"
for format in json sarif gitlab junit github text; do
    # shellcheck disable=SC2086 -- our paths hold no blanks
    "$glint" check $corpus --format $format -o "$work/corpus.$format" >/dev/null 2>&1
    "$glint" check scenes --format $format -o "$work/scenes.$format" >"$work/said.txt" 2>&1 || failed=1
    [ ! -s "$work/said.txt" ] || failed=1
    "$glint" check --verbose README.md none.yaml --format $format -o "$work/odd.$format" >/dev/null 2>&1
    printf 'glint: 1\n' >"$work/minimal.yaml"
    "$glint" check "$work/minimal.yaml" --format $format -o "$work/minimal.$format"
done
cd "$work" || exit 2
ok "JSON by its schema" "$tool" validate "$source/docs/schema/check-report.schema.json" corpus.json scenes.json odd.json minimal.json
ok "SARIF by its schema" "$tool" validate "$source/tests/report/sarif.schema.json" corpus.sarif scenes.sarif odd.sarif minimal.sarif
ok "GitLab by its schema" "$tool" validate "$source/tests/report/gitlab.schema.json" corpus.gitlab scenes.gitlab
ok "fingerprints differ" "$tool" unique corpus.gitlab '*/fingerprint'
ok "fingerprints differ in SARIF" "$tool" unique corpus.sarif 'runs/0/results/*/partialFingerprints/primaryLocationLineHash'
if command -v xmllint >/dev/null; then
    ok "JUnit by its schema" xmllint --noout --schema "$source/tests/report/junit.xsd" corpus.junit scenes.junit odd.junit minimal.junit
fi
ok "good scenes are silent as text" test ! -s scenes.text
ok "good scenes are silent as annotations" test ! -s scenes.github
ok "a wrong corpus is not" test -s corpus.text
tells "good scenes pass" 0 - "$glint" check "$source/scenes"
tells "a note is not told" 0 - "$glint" check minimal.yaml
tells "but with --verbose" 0 'note: .*\[N401\]' "$glint" check --verbose minimal.yaml
for format in json sarif gitlab junit; do ok "and in $format" grep -q N401 minimal.$format; done
ok "but not in annotations" test ! -s minimal.github
tells "as an annotation with --verbose" 0 '^::notice .*N401' "$glint" check --verbose minimal.yaml --format github
ok "ten errors are annotated" test "$(grep -c '^::error ' corpus.github)" -eq 10
ok "ten warnings are annotated" test "$(grep -c '^::warning ' corpus.github)" -eq 10
ok "no notice without --verbose but the last" test "$(grep -c '^::notice ' corpus.github)" -eq 1
ok "what was left out of the ten is counted" grep -qE '^::notice title=glint::[0-9]+ more findings' corpus.github
ok "nothing else is a command" lacks corpus.github '^ *::(set|add|stop|debug|group)|##\['
ok "the worst first" sh -c 'grep "^::" corpus.github | sed "s/^:://;s/ .*//" | uniq | tr "\n" " " | grep -qx "error warning notice "'

# ---- what a report holds
cat >bad.glint.yaml <<'S'
glint: 1
materials:
  glass: {albedo: [0, 0.5, 0.1, 0.8]}
spheres:
  - {center: [0, 0, 0], radius: 1, material: glas}
  - {center: [0, 0, 0], radius: 1, material: {refractive_index: 99}}
rectangles:
  - {corner: [0, 0, 0], edge_u: [1, 0, 0], edge_v: [0, 1, 0], material: glass, name: same}
  - {corner: [0, 0, 0], edge_u: [1, 0, 0], edge_v: [0, 1, 0], material: glass, name: same}
S
"$glint" check bad.glint.yaml --format json >bad.json
ok "a path in the scene" get bad.json scenes/0/findings/0/path 'spheres[0].material'
ok "a path through what stands in place" get bad.json scenes/0/findings/1/path 'spheres[1].material.refractive_index'
ok "a fix" get bad.json scenes/0/findings/0/fix/text glass
ok "the end of a finding" get bad.json scenes/0/findings/0/end_column 50
ok "a related place" get bad.json scenes/0/findings/2/related/0/line 8
ok "the state" get bad.json scenes/0/state failed
ok "statistics" get bad.json scenes/0/statistics/rectangles 2
ok "counts" get bad.json counts '{"errors":3,"notes":0,"warnings":0}'
# A finding about copies says which they are.
cat >copies.yaml <<'S'
glint: 1
parameters: {paint: "#c08050"}
objects: {row: {parameters: {ink: paint, at: [0, 1, 0]}, spheres: [{for: {i: 12, lit: [true]}, center: at, radius: 0.5 - 0.05*i, material: {diffuse_color: ink}}]}}
instances: [{object: row}]
spheres: [{for: {i: 3}, center: [i, 0, 0], radius: i + 1e-30, material: {albedo: [1, 1, 0.1, 0.8]}}, {center: [0, 0, 0], radius: -1}]
S
"$glint" check copies.yaml --format json >copies.json
ok "a report with copies by its schema" "$tool" validate "$source/docs/schema/check-report.schema.json" copies.json
ok "the values of a copy" get copies.json scenes/0/findings/0/with '{"at":[0,1,0],"i":10,"ink":"#c08050","lit":true}'
ok "and of how many it holds" get copies.json scenes/0/findings/0/copies 2
ok "also of one" get copies.json scenes/0/findings/1/copies 1
ok "what is about no copy has none" lacks copies.json '"message": "[^"]*is -1;[^"]*"copies"'
"$glint" check copies.yaml --format sarif >copies.sarif
ok "SARIF with copies by its schema" "$tool" validate "$source/tests/report/sarif.schema.json" copies.sarif
ok "the values in SARIF" get copies.sarif runs/0/results/1/properties '{"copies":1,"with":{"i":0}}'
"$glint" check bad.glint.yaml --format json --max-messages 1 >short.json
ok "a truncated report says so" get short.json truncated true
ok "and counts on" get short.json scenes/0/left_out 2
ok "and keeps one" get short.json counts/errors 3
mkdir -p 'odd folder'
sed 's/glass, name: same/glass/' bad.glint.yaml >'odd folder/50%,a:b.glint.yaml'
"$glint" check 'odd folder' --format sarif >odd-name.sarif
ok "a URI is escaped" get odd-name.sarif runs/0/results/0/locations/0/physicalLocation/artifactLocation/uri \
    'odd%20folder/50%25%2Ca%3Ab.glint.yaml'
"$glint" check 'odd folder' --format github >odd-name.github
ok "properties are escaped" grep -q '^::error file=odd folder/50%25%2Ca%3Ab.glint.yaml,line=5,' odd-name.github
"$glint" check "$PWD/bad.glint.yaml" --format gitlab >absolute.gitlab
ok "paths below the folder become relative" get absolute.gitlab 0/location/path bad.glint.yaml
# A finding in an option has a place as well.
for format in json sarif gitlab junit; do
    "$glint" check minimal.yaml --set image.width=0 --format $format >option.$format && failed=1
done
ok "options in JSON" "$tool" validate "$source/docs/schema/check-report.schema.json" option.json
ok "options in SARIF" "$tool" validate "$source/tests/report/sarif.schema.json" option.sarif
ok "options for GitLab" "$tool" validate "$source/tests/report/gitlab.schema.json" option.gitlab
ok "they stand in the scene" get option.gitlab 0/location/path minimal.yaml
# Fingerprints hold while lines before them come.
"$glint" check bad.glint.yaml --format sarif >before.sarif
sed -i '1a # a line more' bad.glint.yaml
"$glint" check bad.glint.yaml --format sarif >after.sarif
hash=runs/0/results/1/partialFingerprints/primaryLocationLineHash
ok "fingerprints are stable" get after.sarif $hash "$("$tool" get before.sarif $hash)"

# ---- many that are alike: each has its place, and what is left out is counted
awk 'BEGIN { print "glint: 1\nspheres:"; for (i = 0; i < 150; i++) print "  - {center: [0, 0, 0], radius: -1}" }' >alike.yaml
counted() { "$glint" check alike.yaml --format "$1" --max-messages "$2" >alike.$1; }
counted json 1000
ok "all places in JSON" "$tool" unique alike.json 'scenes/0/findings/*/path'
ok "the last one too" get alike.json scenes/0/findings/149/line 152
ok "nothing is left out" get alike.json scenes/0/left_out 0
counted json 100
ok "what is left out is true" get alike.json scenes/0/left_out_codes '[{"code":"E206","count":50}]'
ok "with what lists it" get alike.json scenes/0/max_messages 150
ok "and valid" "$tool" validate "$source/docs/schema/check-report.schema.json" alike.json
counted sarif 1000
ok "all places in SARIF" get alike.sarif runs/0/results/149/locations/0/physicalLocation/region/startLine 152
ok "nothing is said to be left out" lacks alike.sarif invocations
counted sarif 100
ok "SARIF says what it lacks" get alike.sarif runs/0/invocations/0/toolExecutionNotifications/0/message/text \
    '50 more findings of alike.yaml are not listed (E206: 50); --max-messages 150 lists all'
ok "by its schema" "$tool" validate "$source/tests/report/sarif.schema.json" alike.sarif
counted junit 100
ok "and so does JUnit" grep -q '^50 more findings of alike.yaml are not listed (E206: 50)' alike.junit
counted github 100
ok "and GitHub" grep -q ': 90 in the log, 50 not listed; --max-messages 150 lists all$' alike.github
tells "text says how to see all" 1 '^glint: 100 more messages not shown \(E206: 100\); --limit messages=150 shows all$' "$glint" check alike.yaml
tells "and shows all" 1 '^alike.yaml:152:' "$glint" check alike.yaml --max-messages 150
ok "each" test "$(grep -c 'error: ' out.txt)" -eq 150
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
awk 'BEGIN { print "glint: 1\nmodels:"; for (i = 0; i < 450; i++) print "  - {mesh: one.obj}" }' >shared.yaml
tells "a mesh counts once" 0 - "$glint" check shared.yaml --limit scene-triangles=1 --only W401
awk 'BEGIN { print "glint: 1\nmodels:"
  for (i = 0; i < 450; i++) { print "  - {mesh: one" i ".obj}"; printf "v %d 0 0\nv %d.5 0 0\nv %d 1 0\nf 1 2 3\n", i, i, i >("one" i ".obj"); close("one" i ".obj") } }' >instances.yaml
tells "meshes past a limit are one error" 1 'raise the limit: --limit scene-triangles=450' \
    "$glint" check instances.yaml --limit scene-triangles=100
ok "with their number" grep -q '= note: 349 further models do not fit either; with all of them the scene has 450 triangles' out.txt
ok "and one only" test "$(grep -c 'E501' out.txt)" -eq 1
tells "with that limit they fit" 0 - "$glint" check instances.yaml --limit scene-triangles=450 --only W401
awk 'BEGIN { for (i = 0; i < 3; i++) print "glint: 1\nmaterials: {m" i ": {}}" >"part" i ".yaml"
  print "glint: 1\ninclude: [part0.yaml, part1.yaml, part2.yaml]\nspheres: [{center: [0, 0, 0], radius: 1}]" >"parts.yaml" }'
tells "so are includes past theirs" 1 'parts.yaml:2:23: error: .* too many files: 3, where the limit include-files is 1 \[E501\]' \
    "$glint" check parts.yaml --limit include-files=1
ok "with what would do" grep -q -- '--limit include-files=3' out.txt
ok "once" test "$(grep -c 'E501' out.txt)" -eq 1

# ---- the closing line
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n' >one-error.yaml
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: 1}]\n' >no-error.yaml
tells "one finding in one file needs none" 1 '^one-error' "$glint" check one-error.yaml
ok "and has none" lacks out.txt '^glint:'
tells "several files have one" 1 '^glint: 1 error in 2 files; 1 clean$' "$glint" check one-error.yaml no-error.yaml
tells "ignored ones are not clean" 1 '^glint: 1 error in 3 files; 1 clean, 1 ignored$' \
    "$glint" check one-error.yaml no-error.yaml alike.yaml --ignore alike.yaml
tells "notes count where they are shown" 1 '^glint: 1 error, 2 notes in 2 files$' "$glint" check -v one-error.yaml no-error.yaml
tells "quiet leaves it out" 1 '^one-error' "$glint" check one-error.yaml no-error.yaml -q
ok "as asked" lacks out.txt '^glint:'
tells "clean files are silent" 0 - "$glint" check no-error.yaml "$source/scenes/elements/spheres.glint.yaml"

# ---- a library
printf 'glint: 1\nmaterials: {gold: {diffuse_color: [1, 0.8, 0.2]}}\n' >library.yaml
printf 'glint: 1\ninclude: [library.yaml]\n' >more-library.yaml
printf 'glint: 1\nlights: [{position: [0, 5, 5]}]\n' >lights.yaml
tells "materials for others need no camera" 0 - "$glint" check -v library.yaml more-library.yaml lights.yaml
printf 'background: {color: 0.5}\n' >>library.yaml
tells "but a background is seen" 0 'N401' "$glint" check -v library.yaml

# A scene of many long mistakes: no report passes 64 KB.
awk 'BEGIN { x = "x"; for (i = 0; i < 9; i++) x = x x
  print "glint: 1\nspheres:"
  for (i = 0; i < 2000; i++) printf "  - {center: [0, %s], radius: -1, materiel%d: %s}\n", x, i, x }' >many.yaml
for format in text json sarif github gitlab junit; do
    "$glint" check many.yaml --format $format >many.txt 2>&1
    ok "no more than 64 KB of $format" test "$(wc -c <many.txt)" -le 65536
    ok "and no less than 8 KB" test "$(wc -c <many.txt)" -ge 8192
done

# ---- folders, order, outputs
mkdir -p tree/b tree/a tree/.hidden
for name in tree/b/2.glint.yaml tree/a/1.glint.yaml tree/3.glint.xml tree/.hidden/4.glint.yaml tree/5.yaml tree/a/6.glint.yml; do
    printf 'glint: 1\nspheres: [{center: [0, 0, 0]}]\n' >$name
done
printf '<Scene glint="1"><Sphere radius="1"/></Scene>\n' >tree/3.glint.xml
"$glint" check tree >/dev/null 2>order.txt
printf '%s\n' tree/3.glint.xml tree/a/1.glint.yaml tree/a/6.glint.yml tree/b/2.glint.yaml tree/5.yaml >wanted.txt
grep -oE '^tree[^:]*' order.txt | uniq >places.txt
ok "a folder's scenes, in order" cmp places.txt wanted.txt
"$glint" check tree >/dev/null 2>again.txt
ok "the order is stable" cmp order.txt again.txt
command -v taskset >/dev/null && taskset -c 0 "$glint" check tree 2>alone.txt
[ ! -e alone.txt ] || ok "one processor says the same" cmp order.txt alone.txt
"$glint" check tree $(grep -v 5.yaml places.txt | cut -d: -f1) >/dev/null 2>again.txt
ok "a scene that is named twice is checked once" cmp order.txt again.txt
# What a link leads to is read only where the scene may read it anyway; else not one word of it is shown.
mkdir -p outside links/in/deep
printf 'password: hunter2\nglint: [1\n' >outside/secret
printf 'glint: 1\nspheres: [{center: [0, 0, 0]}]\n' >links/in/real.glint.yaml
ln -s ../../outside/secret links/in/leak.glint.yaml
ln -s ../real.glint.yaml links/in/deep/inner.glint.yaml
"$glint" check links >links.txt 2>&1
ok "a folder with a link to elsewhere fails" test $? -eq 3
ok "the link is named" grep -q '^links/in/leak.glint.yaml:1:1: error: the scene file lies outside .*\[E602\]' links.txt
ok "and not what it leads to" test "$(grep -cE 'hunter2|password|E101' links.txt)" -eq 0
ok "a link to a scene in the folder is checked" grep -q '^links/in/deep/inner.glint.yaml:2:11: error: .*\[E204\]' links.txt
for format in json sarif github gitlab junit; do
    "$glint" check links --format $format >links.$format 2>&1
    ok "nor in $format" sh -c "grep -q E602 links.$format && ! grep -qE 'hunter2|password' links.$format"
done
"$glint" check links --fix=all --diff >links.txt 2>&1
ok "nor as a patch" test "$(grep -cE 'hunter2|password' links.txt)" -eq 0
"$glint" check links/in/leak.glint.yaml >links.txt 2>&1
ok "who names the link has it read" grep -q 'leak.glint.yaml:1:1: error: .*E805\|leak.glint.yaml:[12]:' links.txt
"$glint" check links links/in/leak.glint.yaml >links.txt 2>&1
ok "in a folder that is named too as well" grep -q 'leak.glint.yaml:[12]:' links.txt
rm links/in/leak.glint.yaml
ln -s ../outside/secret links/.glintrc.yaml
"$glint" check links >links.txt 2>&1
ok "settings that are a link to elsewhere are an error of usage" test $? -eq 2
ok "which is named" grep -q '^links/.glintrc.yaml:1:1: error: the configuration is a link .*\[E602\]' links.txt
ok "and not quoted" test "$(grep -cE 'hunter2|password' links.txt)" -eq 0
rm links/.glintrc.yaml
mv links/in/real.glint.yaml outside
printf 'severity: {W401: off}\n' >settings.yaml && mv settings.yaml links/in
ln -s in/settings.yaml links/.glintrc.yaml
ln -sf ../../../outside/real.glint.yaml links/in/deep/inner.glint.yaml
tells "settings may be a link to a file below" 3 'inner.glint.yaml:1:1: error: .*\[E602\]' "$glint" check links
printf '' >.glintrc.yaml && rm links/.glintrc.yaml
tells "below a marked root links may lead to all of it" 1 'inner.glint.yaml:2:11: error: .*\[E204\]' "$glint" check links
rm .glintrc.yaml

mkdir -p empty
tells "a folder without scenes" 2 'command-line:1:13: error: there is no scene in the folder' "$glint" check empty
tells "text into a file" 1 - "$glint" check tree -o text.txt
ok "it is the text" cmp text.txt order.txt
tells "no such format" 2 "did you mean 'sarif'" "$glint" check tree --format sarf
tells "an output that cannot be written" 3 'cannot be written' "$glint" check tree --format json -o none/report.json
"$glint" check minimal.yaml none.yaml --format junit >unreadable.junit
ok "a file that cannot be read is an error of the suite" grep -q 'failures="0" errors="1"' unreadable.junit

# ---- settings
cat >w.glint.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5]}
lights: [{position: [0, 5, 5]}]
models:
  - {mesh: open.obj, material: {albedo: [0.1, 0, 0, 0.9], refractive_index: 1.5}}
S
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >open.obj
tells "a warning does not fail" 0 'w.glint.yaml:5:[0-9]+: warning: .*\[W401\]' "$glint" check --only W401 w.glint.yaml
tells "unless asked" 1 'W401' "$glint" check w.glint.yaml --fail-on warning --only W4xx
tells "a severity by option" 1 'error: .*\[W401\]' "$glint" check w.glint.yaml --severity W401=error
tells "a code ignored" 0 - "$glint" check w.glint.yaml --ignore Wxxx --ignore W401 --only W401
tells "off" 0 - "$glint" check w.glint.yaml --severity W401=off --only W401
tells "only others" 0 - "$glint" check w.glint.yaml --only W601
tells "a path ignored" 0 "^glint: nothing was checked: 'ignore' leaves out 1 scene$" "$glint" check bad.glint.yaml --ignore 'bad*'
tells "a path of another folder" 1 E301 "$glint" check bad.glint.yaml --ignore 'tree/bad*'
tells "errors are not silenced" 2 "errors cannot be silenced" "$glint" check bad.glint.yaml --ignore E301
tells "errors pass --only" 1 'E301' "$glint" check bad.glint.yaml --only W401
tells "an unknown code" 2 "there is no code 'W999'" "$glint" check bad.glint.yaml --only W999
tells "an unknown severity" 2 "did you mean 'warning'" "$glint" check bad.glint.yaml --severity W401=warnin
tells "an unknown level" 2 "did you mean 'error'" "$glint" check bad.glint.yaml --fail-on eror

printf 'severity: {W401: error}\nonly: [W401]\n' >.glintrc.yaml
tells "a severity by configuration" 1 'error: .*\[W401\]' "$glint" check w.glint.yaml
tells "options go before it" 0 'warning: .*\[W401\]' "$glint" check w.glint.yaml --severity W401=warning
mkdir -p sub
cp w.glint.yaml open.obj sub
tells "it holds for folders below" 1 'sub/w.glint.yaml:5:.*error: .*\[W401\]' "$glint" check sub
printf 'only: [W401]\nseverity: {W401: off}\n' >sub/.glintrc.yaml
tells "the nearest one counts" 0 - "$glint" check sub
rm sub/.glintrc.yaml
printf 'fail_on: warning\nonly: [W401]\n' >.glintrc.yaml
"$glint" check w.glint.yaml --format junit >failed.junit
ok "warnings that fail are a failed test" grep -q '<failure message="1 warning' failed.junit
tells "fail_on by configuration" 1 'warning: .*\[W401\]' "$glint" check w.glint.yaml
tells "and back by option" 0 'warning: .*\[W401\]' "$glint" check w.glint.yaml --fail-on error
printf 'ignore: ["sub/**", W401]\nonly: [W401]\n' >.glintrc.yaml
tells "paths and codes ignored" 0 - "$glint" check sub w.glint.yaml
"$glint" check sub --format json >ignored.json
ok "what is ignored is said" get ignored.json scenes/0/state ignored
printf 'max_messages: 1\nlimits: {mesh-bytes: 3}\n' >.glintrc.yaml
tells "limits by configuration" 1 'E501' "$glint" check w.glint.yaml
tells "limits by option first" 0 '' "$glint" check w.glint.yaml --limit mesh-bytes=1000
tells "max_messages by configuration" 1 '2 more messages not shown' "$glint" check bad.glint.yaml
# Limits belong to who runs glint: what lies beside the scenes can only lower them.
printf 'limits:\n  mesh-corners: 65537\n  scene-depth: 9\nmax_messages: 101\n' >.glintrc.yaml
"$glint" check w.glint.yaml >limits.txt 2>&1
ok "a limit cannot be raised beside the scenes" test $? -eq 2
ok "which is said at its place" grep -q "^.glintrc.yaml:2:17: error: .* only lower limits, and 'mesh-corners' is 65536: .*\[E806\]" limits.txt
ok "with what does" grep -q 'help: .*--limit mesh-corners=65537, or a settings file with --config' limits.txt
ok "nor can the number of messages" grep -q "^.glintrc.yaml:4:15: error: .*'messages' is 100" limits.txt
"$glint" check w.glint.yaml --format sarif >limits.sarif
ok "reports say so too" grep -q 'only lower limits' limits.sarif
"$glint" render w.glint.yaml -o none.png --device reference >limits.txt 2>&1
ok "every command refuses" test $? -eq 2
tells "the command line overrides it" 2 'messages' "$glint" check w.glint.yaml --limit mesh-corners=65538
tells "all of it" 0 '' "$glint" check w.glint.yaml --limit mesh-corners=65538 --max-messages 102
tells "a file that is named may raise limits" 0 '' "$glint" check w.glint.yaml --config .glintrc.yaml
printf 'glint: 1\nx-a: &a [1, 1, 1, 1]\nx-b: [*a, *a, *a, *a]\n' >alias.glint.yaml
printf 'limits: {alias-nodes: 15}\n' >trusted.yaml
tells "or lower them" 1 'alias.glint.yaml:.*alias-nodes.*E501' "$glint" check alias.glint.yaml --config trusted.yaml --max-messages 1 --limit mesh-corners=65538
rm .glintrc.yaml
tells "options go before it" 0 - "$glint" check alias.glint.yaml --config trusted.yaml --limit alias-nodes=100
printf 'limits: {alias-nodes: 20}\nseverity: {W401: error}\n' >trusted.yaml
printf 'limits: {alias-nodes: 15}\nseverity: {W401: off}\n' >.glintrc.yaml
tells "it goes before what lies beside the scenes" 0 - "$glint" check alias.glint.yaml --config trusted.yaml
tells "in severities too" 1 'error: .*\[W401\]' "$glint" check w.glint.yaml --config trusted.yaml
rm .glintrc.yaml
tells "settings that are not there" 2 'none.yaml:1:1: error: the configuration does not exist' "$glint" check w.glint.yaml --config none.yaml
printf 'limitss: {}\nlimits: {mesh-corners: 99999999}\n' >trusted.yaml
tells "settings that are wrong" 2 "trusted.yaml:1:1: error: there is no setting 'limitss'" "$glint" check w.glint.yaml --config trusted.yaml
tells "beyond what can be" 2 "trusted.yaml:2:24: error: 'mesh-corners' takes a whole number from 3 to 16777216" "$glint" check w.glint.yaml --config trusted.yaml
printf 'limits: {image-bytes: 1}\n' >trusted.yaml
tells "of a command that is not about scenes" 3 'E501' "$glint" compare "$source/tests/golden/minimal.png" "$source/tests/golden/minimal.png" --config trusted.yaml

mkdir -p meshes
mv open.obj meshes
printf 'asset_paths: [meshes]\n' >.glintrc.yaml
tells "asset paths by configuration" 0 'W401' "$glint" check w.glint.yaml
printf 'asset_paths: [..]\n' >.glintrc.yaml
tells "none outside" 2 '^\.glintrc\.yaml:1:15: error: .*outside.*\[E806\]' "$glint" check w.glint.yaml
printf 'fial_on: warning\nseverity: {W401: eror, W999: off, E301: off}\nlimits: {mesh-byte: 3}\nonly: W401\n' >.glintrc.yaml
"$glint" check w.glint.yaml >/dev/null 2>config.txt
tells "a wrong configuration is an error of usage" 2 '' "$glint" check w.glint.yaml
ok "an unknown setting" grep -q "^.glintrc.yaml:1:1: error: there is no setting 'fial_on' \[E805\]" config.txt
ok "and what was meant" grep -q "did you mean 'fail_on'" config.txt
ok "an unknown severity" grep -q "^.glintrc.yaml:2:18: error: 'eror' is not a severity \[E806\]" config.txt
ok "an unknown code" grep -q "^.glintrc.yaml:2:24: error: there is no code 'W999' \[E806\]" config.txt
ok "an error's code" grep -q "^.glintrc.yaml:2:35: error: errors cannot be silenced" config.txt
ok "an unknown limit" grep -q "^.glintrc.yaml:3:10: error: there is no limit 'mesh-byte' \[E806\]" config.txt
ok "a wrong form" grep -q "^.glintrc.yaml:4:7: error: 'only' takes a list of codes \[E806\]" config.txt
printf 'fail_on: [\n' >.glintrc.yaml
tells "broken YAML" 2 '^\.glintrc\.yaml:[0-9]+:[0-9]+: error: .*\[E101\]' "$glint" check minimal.yaml
printf -- '- a\n' >.glintrc.yaml
tells "no map" 2 'error: a configuration is a map of settings \[E806\]' "$glint" check minimal.yaml
printf '# nothing\n' >.glintrc.yaml
tells "an empty one marks a folder" 0 - "$glint" check minimal.yaml
rm .glintrc.yaml
mv meshes/open.obj .
# The schema for editors and glint agree.
schema=$source/docs/schema/glintrc.schema.json
mkdir -p agree
printf 'glint: 1\n' >agree/a.glint.yaml
agree() { # VERDICT SETTINGS
    printf '%s\n' "$2" >agree/.glintrc.yaml
    "$tool" validate-yaml "$schema" agree/.glintrc.yaml 2>said.txt && by_schema=good || by_schema=bad
    "$glint" check agree >said.txt 2>&1 && by_glint=good || by_glint=bad
    ok "settings, $1: $2" test "$by_schema $by_glint" = "$1 $1"
}
agree good 'severity: {W401: error, n6xx: off}'
agree good 'ignore: [W408, "drafts/**"]'
agree good 'only: [W4xx, E301]'
agree good 'fail_on: warning'
agree good 'max_messages: 20'
agree good 'limits: {mesh-bytes: 1000000}'
agree good 'asset_paths: []'
agree good 'severity:'
agree bad 'severity: {E301: off}'
agree bad 'severity: {W401: loud}'
agree bad 'severity: [W401]'
agree bad 'ignore: [E301]'
agree bad 'ignore: W401'
agree bad 'ignore: [""]'
agree bad 'only: [W4]'
agree bad 'fail_on: note'
agree bad 'fail_on:'
agree bad 'max_messages: 0'
agree bad 'max_messages: [1]'
agree bad 'limits: {mesh-byte: 1}'
agree bad 'limits: {mesh-bytes: 0}'
agree bad 'limits: {scene-depth: 2000}'
agree bad 'limits: {scene-depth: 65}'
agree bad 'max_messages: 101'
agree good 'limits: {scene-depth: 64, image-memory: 1}'
agree bad 'asset_path: [x]'
for limit in $("$glint" check --limit help | sed 's/ .*//'); do
    ok "the schema knows the limit $limit" grep -q "\"$limit\"" "$schema"
done
ok "the default bounds of extremes, by their schema" \
    "$tool" validate-yaml "$source/docs/schema/bounds.schema.json" "$source/measure/extremes/extremes.yaml"
ok "the tests of the scenes that ship, by their schema" \
    "$tool" validate-yaml "$source/docs/schema/test.schema.json" "$source/scenes/glint-test.yaml"

# ---- comments
line='  - {mesh: open.obj, material: {albedo: [0.1, 0, 0, 0.9], refractive_index: 1.5}}'
head -4 w.glint.yaml >c.glint.yaml
printf '  # glint: allow W401: a pane\n%s\n' "$line" >>c.glint.yaml
tells "a comment before" 0 - "$glint" check --only W401 --only W8xx c.glint.yaml
head -4 w.glint.yaml >c.glint.yaml
printf '%s # glint: allow W401\n' "$line" >>c.glint.yaml
tells "a comment behind" 0 - "$glint" check --only W401 --only W8xx c.glint.yaml
head -4 w.glint.yaml >c.glint.yaml
printf '  # glint: allow W401\n\n  # the pane\n%s\n' "$line" >>c.glint.yaml
tells "blank lines and comments between" 0 - "$glint" check --only W401 --only W8xx c.glint.yaml
cp c.glint.yaml behind.glint.yaml
sed -i '5,$d' behind.glint.yaml
printf '  - # glint: allow W401\n    {mesh: open.obj, material: {albedo: [0.1, 0, 0, 0.9], refractive_index: 1.5}}\n' >>behind.glint.yaml
tells "a comment behind the dash of an item" 0 - "$glint" check --only W401 --only W8xx behind.glint.yaml
sed -i 's/allow W401/allow W401, W601/' c.glint.yaml
tells "an unused code" 0 'c.glint.yaml:5:24: warning: W601 does not occur .*\[W801\]' "$glint" check --only W401 --only W8xx c.glint.yaml
tells "it fails where warnings do" 1 'W801' "$glint" check --only W401 --only W8xx c.glint.yaml --fail-on warning
sed -i 's/allow W401, W601/allow W999, E301/' c.glint.yaml
"$glint" check c.glint.yaml >/dev/null 2>comment.txt
ok "an unknown code in a comment" grep -q "c.glint.yaml:5:18: warning: there is no code 'W999' \[W802\]" comment.txt
ok "an error's code in a comment" grep -q 'c.glint.yaml:5:24: warning: errors cannot be silenced, and E301 is one \[W802\]' comment.txt
ok "the finding stays" grep -q 'W401' comment.txt
printf 'mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl grey\nf 1 2 3\n' >bare.obj
head -4 w.glint.yaml >m.glint.yaml
printf '  - {mesh: bare.obj}\n' >>m.glint.yaml
tells "a finding in a mesh" 0 '^bare.obj:1:[0-9]+: warning: .*\[W601\]' "$glint" check --only W601 m.glint.yaml
tells "a mesh that is ignored" 0 - "$glint" check --only W601 --ignore '*.obj' m.glint.yaml
printf 'v 0 0 x\n' >wrong.obj
sed 's/bare/wrong/' m.glint.yaml >wrong-mesh.glint.yaml
tells "errors in it are told" 1 '^wrong.obj:1:[0-9]+: error: ' "$glint" check --ignore '*.obj' wrong-mesh.glint.yaml
sed -i '5s/$/  # glint: allow W601/' m.glint.yaml
tells "a comment where the mesh is named" 0 - "$glint" check --only W601 --only W8xx m.glint.yaml
printf 'glint: 1\ndescription: "# glint: allow W401"\n' >text.glint.yaml
tells "text is no comment" 0 - "$glint" check text.glint.yaml
cat >c.glint.xml <<'S'
<Scene glint="1">
  <Camera><Position x="0" y="0" z="5"/></Camera>
  <Light><Position x="0" y="5" z="5"/></Light>
  <!-- glint: allow W401: a pane -->
  <Model name="pane"
         mesh="open.obj" material="glass"/>
  <Material name="glass" refractive_index="1.5"><Albedo diffuse="0.1" refraction="0.9"/></Material>
</Scene>
S
tells "a comment for a tag of several lines" 0 - "$glint" check --only W401 --only W8xx c.glint.xml
sed -i 's|  <!-- glint: allow W401: a pane -->||; s|"glass"/>|"glass"/> <!-- glint: allow W401 -->|' c.glint.xml
tells "a comment behind a tag" 0 - "$glint" check --only W401 --only W8xx c.glint.xml
sed -i 's/allow W401/alow W401/' c.glint.xml
tells "a word that is none" 0 'W802' "$glint" check c.glint.xml

exit $failed
