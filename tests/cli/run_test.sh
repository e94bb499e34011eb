#!/bin/sh
# glint test: folders of pictures, in the order in which a newcomer meets them: by the reference, so that no device is needed.
# Usage: run_test.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
export XDG_CACHE_HOME="$work/cache" GLINT_DEVICE=reference

mkdir -p scenes/lamps
cat >scenes/hall.glint.yaml <<'S'
glint: 1
image: {width: 24, height: 16}
cameras:
  front: {position: [0, 0, 4]}
  side: {position: [4, 0, 0], look_at: [0, 0, 0]}
lights: [{position: [-5, 8, 5]}]
background: {color: [0.3, 0.5, 0.8]}
spheres: [{center: [0, 0, 0], radius: 1}]
S
sed 's/radius: 1/radius: 0.5/' scenes/hall.glint.yaml >scenes/lamps/desk.glint.yaml
printf 'glint: 1\nmaterials: {red: {diffuse_color: [0.4, 0, 0]}}\n' >scenes/parts.glint.yaml

# A fresh folder.
expect "nothing is there yet" 1 '^MISSING  hall: there is no picture scenes/hall.png$' - "$glint" test scenes
also "what to do" '^glint: if the new pictures are right, --bless keeps them$' -
also "a scene for others to use has no picture" '^glint: 2 pictures: 2 are missing; ' -
expect "the first references" 0 '^wrote    lamps/desk: scenes/lamps/desk.png, which is new$' - "$glint" test scenes/ --bless
expect "are within their bounds" 0 '^ok       hall: the same pixels$' - "$glint" test scenes
expect "quietly" 0 - - "$glint" test scenes -q
cp scenes/hall.png hall.png
expect "are kept" 0 '^kept     hall: the same pixels$' - "$glint" test scenes --bless
same "as they are" hall.png scenes/hall.png
expect "say how they were made" 0 '^command +glint render scenes/hall.glint.yaml --size 24x16' - "$glint" inspect scenes/hall.png
expect "and can be verified" 0 'verified' - "$glint" verify scenes/hall.png
(cd scenes && "$glint" test . >../out.txt 2>&1) && pass "from inside of the folder" || fail "from inside of the folder"
"$glint" convert scenes/hall.glint.yaml scenes/hall.glint.xml
expect "both spellings are one picture" 0 '^glint: 2 pictures' - "$glint" test scenes
rm scenes/hall.glint.xml

# What differs.
sed -i 's/radius: 1/radius: 1.1/' scenes/hall.glint.yaml
expect "a change is found" 1 '^DIFFERS  hall: mae [0-9.e-]+ \(at most 0.000392\), share [0-9.]+ \(at most 0.005\), the worst at [0-9]+,[0-9]+ in ' - \
    "$glint" test scenes --html report.html --junit report.xml
also "with its reason" '^ +the scene, or a file that it reads, was changed since$' -
also "and the others are not touched" '^ok       lamps/desk' -
cp out.txt text.txt
grep -q 'failures="1"' report.xml && grep -q '<failure message="mae' report.xml && pass "JUnit has it" || fail "JUnit has it"
if command -v xmllint >xmllint.txt; then
    xmllint --noout --schema "$source/tests/report/junit.xsd" report.xml 2>xsd.txt && pass "and is valid" || fail "JUnit is not valid"
fi
[ "$(grep -o 'src="data:image/png;base64,' report.html | wc -l)" -eq 5 ] && pass "the page has the pictures" || fail "the page has the pictures"
grep -qE '(src|href)="?(http|//)' report.html && fail "the page needs something from outside"
grep -q 'prefers-color-scheme:dark' report.html || fail "the page has no dark colours"
sed -n 's/.*reference of hall" src="data:image\/png;base64,\([^"]*\)".*/\1/p' report.html | head -1 | base64 -d >shown.png
expect "a picture of the page is the reference" 0 'largest +0' - "$glint" compare shown.png scenes/hall.png --max-largest 0
expect "JSON" 1 '"state": "differs"' - "$glint" test scenes --format json
expect "only one" 0 '^glint: 1 picture: 1 within its bounds; --only left out 2; ' - "$glint" test scenes --only desk
expect "by a pattern" 0 '^ok       lamps/desk' - "$glint" test scenes --only 'lamps/*'
expect "that matches nothing" 2 - "no picture's name matches 'dsek'" "$glint" test scenes --only dsek
also "with a suggestion" '' "."
cp scenes/hall.png old.png
expect "a reference is renewed" 0 '^wrote    hall: scenes/hall.png, mae ' - "$glint" test scenes --bless --only hall
cmp -s old.png scenes/hall.png && fail "the reference is the old one"
expect "and holds" 0 '2 within their bounds' - "$glint" test scenes
[ -z "$(find scenes -name '*.png.*' -o -name '.*.png*')" ] || fail "a temporary file was left behind"

# Each bound can fail and be kept, by a hair.
cat >scenes/glint-test.yaml <<'S'
bounds: {share: 1, mae: 1, flip: 1, rmse: 9, relmse: 9, largest: 1, psnr: 0, ssim: -1}
S
sed -i 's/radius: 1.1/radius: 1.2/' scenes/hall.glint.yaml
expect "figures of all metrics" 0 '"ssim"' - "$glint" test scenes --format json --only hall
cp out.txt figures.json
for metric in mae rmse relmse largest flip share psnr ssim; do
    value=$(grep -o '"metrics": {[^}]*}' figures.json | grep -o "\"$metric\": [0-9.e-]*" | sed 's/.*: //')
    more=$(awk "BEGIN { printf \"%.9g\", $value * 1.0001 }") less=$(awk "BEGIN { printf \"%.9g\", $value * 0.9999 }")
    case $metric in psnr | ssim) swap=$more more=$less less=$swap ;; esac
    printf 'bounds: {share: 1, mae: 1, %s: %s}\n' "$metric" "$more" | awk '{ sub(/share: 1, mae: 1, share/, "mae: 1, share"); sub(/mae: 1, mae/, "mae"); print }' >bounds.yaml
    expect "$metric is kept" 0 '^ok       hall' - "$glint" test scenes --only hall --bounds bounds.yaml
    sed -i "s/$metric: $more/$metric: $less/" bounds.yaml
    expect "$metric is broken" 1 "^DIFFERS  hall: $metric " - "$glint" test scenes --only hall --bounds bounds.yaml
done
rm scenes/glint-test.yaml
"$glint" test scenes --bless -q >out.txt

# Settings. They may name what is below the root.
: >.glintrc.yaml
cat >scenes/glint-test.yaml <<'S'
pictures: ../refs/small
size: 12x8
skip: [lamps, parts.glint.yaml]
tests:
  hall-side.png: {scene: hall.glint.yaml, camera: side, samples: 2, set: ["background.color=[0, 0, 0]"]}
  deep/hall.exr: {scene: hall.glint.yaml, size: 9x9}
S
mkdir refs
expect "settings, and folders that are made" 0 '^glint: 2 pictures: 2 written' - "$glint" test scenes --bless
expect "hold" 0 '^glint: 2 pictures: 2 within their bounds' - "$glint" test scenes
expect "the camera, samples and values of one" 0 "render scenes/hall.glint.yaml --size 12x8 --samples 2 --camera side --set 'background.color=" - \
    "$glint" inspect refs/small/hall-side.png
expect "the size of the other" 0 'EXR, 9 x 9 pixels|PNG' - "$glint" inspect refs/small/deep/hall.exr
expect "two pictures of a scene with its settings: it is read twice" 0 '"scenes_read": 2' - "$glint" test scenes --format json
cp refs/small/hall-side.png refs/small/lost.png
expect "a picture without a scene is named" 0 '^glint: no scene has the picture scenes/../refs/small/lost.png$' - "$glint" test scenes
cat >two.yaml <<'S'
pictures: two
size: 12x8
skip: [lamps, parts.glint.yaml]
tests:
  front.png: {scene: scenes/hall.glint.yaml}
  side.png: {scene: scenes/hall.glint.yaml, camera: side}
S
expect "two cameras" 0 '2 written' - "$glint" test scenes --bounds two.yaml --bless
expect "are one scene that is read" 0 '"scenes_read": 1' - "$glint" test scenes --bounds two.yaml --format json
sed -i 's/size: 12x8/size: 13x8/' two.yaml
expect "another size is said" 1 '^DIFFERS  front: it has 13 x 8 pixels, and the reference 12 x 8$' - "$glint" test scenes --bounds two.yaml

# Mistakes, at their places.
# wrong NAME PATTERN TEXT
wrong() {
    printf '%b' "$3" >wrong.yaml
    expect "$1" 2 - "$2" "$glint" test scenes --bounds wrong.yaml
}
wrong "an unknown key" 'wrong.yaml:1:1: error: there is no setting .sise. \[E805\]' 'sise: 3x4\n'
also "with what may be meant" - "did you mean 'size'\?"
wrong "an unknown key of a picture" "wrong.yaml:2:14: error: there is no setting of a picture 'camra'" 'tests:\n  hall.png: {camra: side}\n'
wrong "an unknown metric" "wrong.yaml:1:10: error: there is no metric 'flp'" 'bounds: {flp: 1}\n'
wrong "a bound out of its range" "wrong.yaml:1:17: error: 'share' must be a number from 0 to 1" 'bounds: {share: 2}\n'
wrong "a size" "wrong.yaml:1:7: error: 'size' must be a width and a height" 'size: 12\n'
wrong "samples" "wrong.yaml:1:10: error: 'samples' must be a whole number from 1 to 4096" 'samples: 0\n'
wrong "an assignment" "wrong.yaml:1:7: error: 'set' must be a list of texts PATH=VALUE" 'set: [x]\n'
wrong "a scene that is not there" "wrong.yaml:2:21: error: the scene 'scenes/hal.glint.yaml' does not exist" 'tests:\n  a.png: {scene:    scenes/hal.glint.yaml}\n'
also "with the one that may be meant" - "did you mean 'scenes/hall.glint.yaml'\?"
wrong "a picture without a scene" "wrong.yaml:2:3: error: there is no scene 'hal' in the folder" 'tests:\n  hal.png:\n'
wrong "a picture of another kind" "wrong.yaml:2:3: error: a picture's name must end in" 'tests:\n  hall.gif:\n'
wrong "a list" 'wrong.yaml:1:1: error: ' '- size: 3x4\n'
wrong "YAML that breaks off" 'wrong.yaml:1:' 'bounds: {share: 1\n'
: >empty.yaml
expect "an empty file says nothing" 0 - - "$glint" test scenes --bounds empty.yaml --only hall -q
printf 'tests:\n  a.png: {scene: scenes/hall.glint.yaml, camera: sid}\n' >wrong.yaml
expect "a camera" 1 '^FAILED   a: there is no such camera' "wrong.yaml:2:50: error: scenes/hall.glint.yaml has no camera 'sid' \[E302\]" "$glint" test scenes --bounds wrong.yaml
also "with the one that may be meant" '' "did you mean 'side'\?"
rm scenes/glint-test.yaml
echo 'spheres: 3' >>scenes/lamps/desk.glint.yaml
expect "a scene with errors" 1 '^FAILED   lamps/desk: the scene has errors' 'desk.glint.yaml:[0-9]+:1: error' "$glint" test scenes --bless
also "and the others are tested" '^kept     hall' ''
rm -r scenes/lamps
head -c 60 scenes/hall.png >cut.png
cp cut.png scenes/hall.png
expect "a damaged reference" 1 '^FAILED   hall: the reference scenes/hall.png: ' - "$glint" test scenes
expect "is renewed" 0 '^wrote    hall' - "$glint" test scenes --bless
expect "a scene instead of a folder" 2 - "glint test scenes --only hall" "$glint" test scenes/hall.glint.yaml
expect "no folder" 2 - "there is no folder 'none'" "$glint" test none
mkdir empty
expect "a folder without scenes" 2 - "there is no scene in the folder" "$glint" test empty
expect "a page that cannot be written" 3 - "none/report.html:1:1: error" "$glint" test scenes --html none/report.html
exit $failed
