#!/bin/sh
# What is known from a baseline, what is new, and what is gone.
# Usage: run_baseline.sh GLINT SOURCE_FOLDER WORK_FOLDER REPORT_TOOL
. "$(dirname -- "$0")/../cli/lib.sh"
tool=$4

view='camera: {position: [0, 0, 5]}
lights: [{position: [0, 5, 5]}]'
mkdir -p scenes parts
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >parts/open.obj
pane='  - {mesh: open.obj, material: {albedo: [0.1, 0, 0, 0.9], refractive_index: 1.5}}'
printf 'glint: 1\nmodels:\n%s\n' "$pane" >parts/pane.yaml
: >.glintrc.yaml
printf 'glint: 1\ninclude: [../parts/pane.yaml]\n%s\n' "$view" >scenes/a.glint.yaml
cp scenes/a.glint.yaml scenes/b.glint.yaml
printf 'glint: 1\n%s\nspheres:\n  - {center: [0, 0, 0], radius: -1}\n  - {center: [0, 0, 0], radius: -2}\n' "$view" >scenes/c.glint.yaml
check() { "$glint" check scenes --only W401 "$@"; }

tells "without one they are reported" 1 '2 errors, 2 warnings in 3 files$' check
tells "it is written" 0 '^glint: 3 findings written to known.txt$' check --write-baseline known.txt
cat >wanted.txt <<'S'
parts/pane.yaml	W401	1	scenes/a.glint.yaml
scenes/c.glint.yaml	E206	1	
scenes/c.glint.yaml	E206	1	
S
grep '^[^#g]' known.txt | awk -F '\t' -v OFS='\t' '{ print $1, $2, $3, $6 }' >got.txt
same "sorted, once for two scenes that read one file" got.txt wanted.txt
tells "what is known is silent" 0 - check --baseline known.txt
tells "warnings too, where they fail" 0 - check --baseline known.txt --fail-on warning
check --write-baseline again.txt 2>/dev/null
same "it is written the same" known.txt again.txt
cp known.txt parts/known.txt
(cd scenes && "$glint" check . --only W401 --baseline ../known.txt) >out.txt 2>&1
ok "from another folder as well" test ! -s out.txt
sed 's/$/\r/' known.txt >crlf.txt
tells "with other line ends" 0 - check --baseline crlf.txt
for format in json sarif github gitlab junit; do
    check --baseline known.txt --format $format >report.$format 2>said.txt
    ok "it passes as $format" test $? -eq 0
    ok "and lists nothing" sh -c "! grep -qE 'E206|W401' report.$format"
done
ok "JSON counts what is known" test "$("$tool" get report.json scenes/2/in_baseline)" = 2
ok "and is valid" "$tool" validate "$source/docs/schema/check-report.schema.json" report.json
ok "no finding is counted" test "$("$tool" get report.json counts)" = '{"errors":0,"notes":0,"warnings":0}'

# ---- lines move, others are added
sed -i '1a # a line more\n\n' scenes/c.glint.yaml
sed -i '1a # and here' parts/pane.yaml
tells "moved lines are not new" 0 - check --baseline known.txt
sed 's/^/  /' scenes/c.glint.yaml >deeper && mv deeper scenes/c.glint.yaml
tells "nor are lines that are deeper" 0 - check --baseline known.txt
printf '    - {center: [0, 0, 0], radius: -1}\n' >>scenes/c.glint.yaml
tells "one more of the same is" 1 'c.glint.yaml:10:[0-9]+: error: .*E206' check --baseline known.txt
ok "the old ones stay silent" test "$(grep -c 'error: ' out.txt)" -eq 1
ok "what is known is counted" grep -q '^glint: 1 error in 3 files; 2 clean; 4 in the baseline$' out.txt
sed -i '$d' scenes/c.glint.yaml
printf 'glint: 1\ninclude: [../parts/pane.yaml]\n%s\n' "$view" >scenes/d.glint.yaml
tells "a further scene that reads a known file has nothing new" 0 - check --baseline known.txt
printf '%s\n' "$pane" | sed 's/1.5/1.4/' >>parts/pane.yaml
tells "a changed line in it is new, in each scene" 0 '3 warnings in 4 files; 1 clean; 5 in the baseline' check --baseline known.txt
sed -i '$d' parts/pane.yaml

# ---- what is gone
sed -i 's/radius: -2/radius: 2/' scenes/c.glint.yaml
tells "a scene that still has errors is not asked" 0 - check --baseline known.txt
sed -i 's/radius: -1/radius: 1/' scenes/c.glint.yaml
tells "what is gone is told, and nothing fails" 0 '^glint: 2 findings in known.txt are gone \(lines 5, 6\); --write-baseline known.txt writes it anew$' \
    check --baseline known.txt
tells "quiet is quiet" 0 - check --baseline known.txt -q
check --baseline known.txt --format json >report.json 2>beside.txt
ok "beside other formats" grep -q '2 findings in known.txt are gone' beside.txt
tells "not of scenes that were not checked" 0 - "$glint" check --only W401 scenes/a.glint.yaml --baseline known.txt
sed -i 's/0, 0, 0.9/0, 0, 0/' parts/pane.yaml
tells "nor through another scene" 0 - "$glint" check --only W401 scenes/b.glint.yaml --baseline known.txt
rm scenes/c.glint.yaml
tells "but of those that were removed" 0 '^glint: 2 findings in known.txt are gone' \
    "$glint" check --only W401 scenes/b.glint.yaml --baseline known.txt
check --write-baseline known.txt 2>/dev/null
ok "written again it is empty" test "$(grep -c '^[^#g]' known.txt)" -eq 0

# ---- what it cannot hold
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}]\n' >one.yaml
tells "a scene that cannot be read stays an error" 3 "not written: 'none.yaml' could not be checked" \
    "$glint" check one.yaml none.yaml --write-baseline odd.txt
tells "and so do options" 3 'command-line|--set' "$glint" check one.yaml --set image.width=0 --write-baseline odd.txt
ok "then nothing is written" test ! -e odd.txt
"$glint" check one.yaml --write-baseline odd.txt 2>/dev/null
tells "an option is not known either" 1 'E206' "$glint" check one.yaml --set image.width=0 --baseline odd.txt
printf 'fail_on: never\n' >.glintrc.yaml
tells "settings stay errors" 2 'E806' "$glint" check one.yaml --baseline odd.txt
: >.glintrc.yaml
tells "notes are not written" 0 'glint: 1 finding written' "$glint" check one.yaml --write-baseline odd.txt

# ---- what is no baseline
tells "one that does not exist" 2 "none.txt:1:1: error: the baseline does not exist \[E601\]" "$glint" check one.yaml --baseline none.txt
tells "a scene" 2 'one.yaml:1:1: error: this is not a baseline of glint \[E809\]' "$glint" check one.yaml --baseline one.yaml
{
    cat odd.txt
    echo '<<<<<<< ours'
} >broken.txt
tells "a line that is none" 2 'broken.txt:5:1: error: this is not an entry.*\[E809\]' "$glint" check one.yaml --baseline broken.txt
tells "both at once" 2 'does not go with --baseline' "$glint" check one.yaml --baseline odd.txt --write-baseline odd.txt
cp odd.txt kept.txt
chmod 444 kept.txt
tells "a folder that does not exist" 3 'none/x.txt:1:1: error: cannot be written' "$glint" check one.yaml --write-baseline none/x.txt
printf 'glint: 1\nspheres: [{center: [0, 0, 0], radius: -1}] # \001\377\n' | tr '\001' '\t' >'odd	name.yaml'
"$glint" check 'odd	name.yaml' --write-baseline bytes.txt >/dev/null 2>&1
ok "odd names and bytes keep to their line" test "$(wc -l <bytes.txt)" -ge 4
tells "and are known again" 0 - "$glint" check 'odd	name.yaml' --baseline bytes.txt

exit $failed
