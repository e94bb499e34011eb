#!/bin/sh
# Pictures say how they were made, and glint verify tells what differs: by the reference, so that no device is needed.
# Usage: run_verify.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
export XDG_CACHE_HOME="$work/cache" GLINT_DEVICE=reference

cat >scene.yaml <<'S'
glint: 1
image: {width: 12, height: 8, samples: 2}
cameras:
  front: {position: [0, 0, 4]}
  side: {position: [4, 0, 0], look_at: [0, 0, 0]}
lights: [{position: [-5, 8, 5]}]
background: {color: [0.3, 0.5, 0.8]}
spheres: [{center: [0, 0, 0], radius: 1}]
models: [{mesh: face.obj, translation: [0.9, 0, 0]}]
S
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >face.obj

formats='png jpg hdr'
"$glint" render scene.yaml -q -o probe.exr 2>/dev/null && formats="$formats exr"
for kind in $formats; do
    expect "a $kind" 0 - - "$glint" render scene.yaml -q -o a.$kind
    expect "again, and other options that change no pixel" 0 - '' \
        "$glint" render scene.yaml --size 12x8 --samples 2 --camera front -o b.$kind
    cmp -s a.$kind b.$kind && pass "have the same bytes" || fail "have the same bytes"
    for text in 'glint [0-9]' '[0-9a-f]{32}' reference '12 x 8 pixels, 2 samples, double precision' \
        'glint render scene.yaml --size 12x8 --samples 2 --device reference'; do
        grep -aqE "$text" a.$kind && pass "it says $text" || fail "it says $text"
    done
    expect "verified" 0 'a\.'$kind': verified' - "$glint" verify a.$kind
    also "with the same bytes" '^File +the same bytes' -
done

# All that changes pixels comes back from the record.
expect "many settings" 0 - - "$glint" render scene.yaml -q -o "it's a name.png" --size 10x7 --samples 3 --camera side \
    --set 'spheres[0].radius=0.8' --set "description=it's" --depth 16 --as-file --asset-path .
expect "are read back" 0 'verified' - "$glint" verify "it's a name.png"
cp scene.yaml 'ein Würfel.yaml'
expect "a name with spaces and letters" 0 - - "$glint" render 'ein Würfel.yaml' -q -o name.png --quality 70 -o name.jpg
expect "is read back" 0 'verified' - "$glint" verify name.png
expect "and a quality" 0 'the same bytes' - "$glint" verify name.jpg

# The scene.
sed 's/radius: 1/radius: 1.001/' scene.yaml >other.yaml
expect "another scene is told" 1 'Scene hash DIFFERS' 'other.yaml was changed since the picture was made' "$glint" verify a.png other.yaml
also "and its pixels" 'DIFFER: [0-9]+ of 96, the worst at [0-9]+,[0-9]+ in ' ''
mkdir -p far && sed 's/^lights.*/lights: [{position: [-5, 8, 5]}] # a comment/' scene.yaml >far/moved.yaml && cp face.obj far/
expect "a scene that was moved, with a comment, is the same" 0 'verified' - "$glint" verify a.png far/moved.yaml
expect "its twin too" 0 - - "$glint" convert scene.yaml twin.xml
expect "is the same scene" 0 'verified' - "$glint" verify a.png twin.xml
sed 's/v 0 1 0/v 0 1 0.01/' face.obj >far/face.obj
expect "a mesh that was changed is told" 1 'Scene hash DIFFERS' 'was changed' "$glint" verify a.png far/moved.yaml
mv scene.yaml kept.yaml
expect "a scene that is gone" 3 - 'if it is elsewhere now: glint verify a.png SCENE' "$glint" verify a.png
mv kept.yaml scene.yaml

# Each byte of the file. A record without its texts is one of those that say nothing.
for kind in $formats; do
    size=$(wc -c <a.$kind)
    step=$((size / 24 + 1))
    at=3 quiet=0
    while [ $at -lt "$size" ]; do
        byte=$(od -An -tu1 -j$at -N1 a.$kind | tr -d ' ')
        cp a.$kind broken.$kind
        printf "\\$(printf %o $(((byte + 1) % 256)))" | dd of=broken.$kind bs=1 seek=$at conv=notrunc 2>/dev/null
        "$glint" verify broken.$kind >out.txt 2>err.txt
        got=$?
        { [ $got -eq 1 ] || [ $got -eq 3 ] || grep -qE 'other bytes, the first at '$at'|DIFFERS' out.txt; } ||
            { quiet=$((quiet + 1)); echo "byte $at of a.$kind: exit $got"; }
        at=$((at + step))
    done
    [ $quiet -eq 0 ] && pass "a changed byte of a $kind is told" || fail "a changed byte of a $kind is told: $quiet were not"
done

# Devices, and what is no record.
sed 's/^# Device: reference/# Device: another/' a.hdr >moved.hdr
expect "another device is told" 0 'Device     DIFFERS: another' - "$glint" verify moved.hdr
sed 's/^# Settings: 12 x 8/# Settings: 12 x 9/' a.hdr >changed.hdr
expect "changed settings are told" 1 'Settings   DIFFERS' - "$glint" verify changed.hdr
sed 's/^# Command: glint render/# Command: glint remove/' a.hdr >changed.hdr
expect "another command is not run" 1 - 'cannot be understood' "$glint" verify changed.hdr
sed 's/--samples 2/-o lost.png --samples 2/' a.hdr >changed.hdr
expect "nor one that writes" 1 - 'cannot be understood' "$glint" verify changed.hdr
expect "nothing was written" 1 - - test -e lost.png
expect "a picture without a record" 1 - 'does not say how it was made' "$glint" verify "$source/tests/golden/minimal.png"
expect "no picture" 1 - 'is not a' "$glint" verify scene.yaml
expect "none there" 3 - 'does not exist' "$glint" verify none.png
"$glint" render - -q -o piped.png <scene.yaml
expect "of standard input: which scene is asked for" 2 - 'standard input: name a file' "$glint" verify piped.png
expect "and taken" 0 'verified' - "$glint" verify piped.png scene.yaml
expect "JSON" 0 '"verified": true' - "$glint" verify a.png --format json
"$glint" render scene.yaml -q -o a.pfm
expect "a PFM has no place" 1 - 'does not say how it was made' "$glint" verify a.pfm

# glint inspect of a picture: what its record says, without the scene.
for kind in $formats; do
    expect "inspect a $kind" 0 'scene hash  [0-9a-f]{32}$' - "$glint" inspect a.$kind
    also "its kind and size" '^kind +[A-Z]+, 12 x 8 pixels$' -
    also "its command" '^command +glint render scene.yaml --size 12x8 --samples 2 --device reference' -
    also "and nothing of a missing record" '^device +reference$' -
    grep -q '^record' out.txt && fail "a record is not missing in a $kind"
done
expect "as JSON" 0 '"settings": "12 x 8 pixels, 2 samples' - "$glint" inspect --format json a.png
expect "one without a record" 0 '^record +none: the picture does not say' - "$glint" inspect "$source/tests/golden/minimal.png"
expect "as JSON" 0 '"recorded": false' - "$glint" inspect --format json "$source/tests/golden/minimal.png"
also "without a command" '"command": null' -
expect "a PFM" 0 'the format has no place for it' - "$glint" inspect a.pfm
"$glint" render scene.yaml -q -o a.webp 2>/dev/null &&
    expect "a WebP" 0 'the format has no place for it' - "$glint" inspect a.webp
sed 's/^# Command: glint render/# Command: glint remove/' a.hdr >changed.hdr
expect "a command that is not glint's" 0 'record +not understood' - "$glint" inspect changed.hdr
printf '# Device: \033[31mred\n' >>head.txt
sed '2r head.txt' a.hdr >colored.hdr
expect "bytes for a terminal are not passed on" 0 'device +.\[31mred' - "$glint" inspect colored.hdr
grep -q "$(printf '\033')" out.txt && fail "an escape sequence was passed on"
expect "a picture that is not there" 3 - 'does not exist' "$glint" inspect none.png
head -c 40 a.png >broken.png
expect "a broken one" 1 - 'broken.png:1:1: error' "$glint" inspect broken.png
cp scene.yaml scene.png
expect "a scene that is named as a picture" 1 - 'is not a' "$glint" inspect scene.png
expect "an option of scenes" 2 - "'--ir' would have no effect" "$glint" inspect a.png --ir
expect "and one of neither: scenes have a language of their own" 2 - "'--format' would have no effect" "$glint" inspect scene.yaml --ir --format json
exit $failed
