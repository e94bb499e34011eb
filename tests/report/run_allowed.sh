#!/bin/sh
# run_allowed.sh GLINT SOURCE_FOLDER WORK_FOLDER: comments that allow a finding go on allowing it when the scene is converted
# to the other spelling, and back. To each scene of tests/invalid with warnings or notes a comment is added before every
# line that has one; then nothing is found in it, and as much in what it is converted to.
. "${0%/*}/../cli/lib.sh"

# codes FILE: of its findings, sorted, on one line.
codes() {
    "$glint" check --verbose "$1" 2>&1 </dev/null | sed -n 's/^.*: \(warning\|note\|error\): .*\[\([A-Z][0-9]*\)\]$/\2/p' |
        sort | tr '\n' ' '
}

count=0
for case in "$source"/tests/invalid/[wn]*/case.yaml "$source"/tests/invalid/[wn]*/case.xml; do
    folder=${case%/*} own=${case##*.}
    case ${folder##*/} in
    w202_*) continue ;; # converted, its numbers are in the range that they should be in
    w8* | n8*) continue ;; # about the comments themselves
    esac
    other=yaml open='# ' close=''
    if [ "$own" = xml ]; then open='<!-- ' close=' -->'; else other=xml; fi
    rm -rf scene
    cp -R "$folder" scene
    (cd scene && "$glint" check --verbose "case.$own" 2>&1 </dev/null) |
        sed -n "s/^case\.$own:\([0-9]*\):.*: \(warning\|note\): .*\[\([A-Z][0-9]*\)\]\$/\1 \3/p" >places.txt
    [ -s places.txt ] || continue
    awk -v open="$open" -v close_="$close" 'NR == FNR {codes[$1] = codes[$1] " " $2; next}
        FNR in codes {match($0, /^ */); printf "%*s%sglint: allow%s%s\n", RLENGTH, "", open, codes[FNR], close_}
        {print}' places.txt "$case" >"scene/one.$own"
    "$glint" convert "scene/one.$own" "scene/two.$other" >/dev/null 2>&1 || continue
    "$glint" convert "scene/two.$other" "scene/three.$own" >/dev/null 2>&1 || continue
    count=$((count + 1))
    one=$(codes "scene/one.$own") two=$(codes "scene/two.$other") three=$(codes "scene/three.$own")
    [ "$one" = "$two" ] && [ "$one" = "$three" ] ||
        fail "${folder##*/}: found '$one', converted '$two', and back '$three'"
done
# A loop over nothing proves nothing.
[ "$count" -ge 60 ] && pass "$count scenes" || fail "only $count scenes"

# What a comment covers ends with the entry that follows it.
cat >end.yaml <<'END'
glint: 1
cameras:
  # glint: allow W201: of the first only
  left:
    position: [-1, 0, 5]
    fov: 1.0472
  right:
    position: [1, 0, 5]
    fov: 1.0472
lights: [{position: [0, 5, 5]}]
spheres: [{center: [0, 0, 0], radius: 1}]
END
expect "only the entry that follows" 0 '' '^end.yaml:9:.*\[W201' "$glint" check end.yaml
[ "$(grep -c W201 err.txt)" = 1 ] && pass "once" || fail "once: $(cat err.txt)"
"$glint" convert end.yaml end.xml 2>/dev/null
expect "in XML too" 0 '' '^end.xml:.*\[W201' "$glint" check end.xml
[ "$(grep -c W201 err.txt)" = 1 ] && pass "once in XML" || fail "once in XML: $(cat err.txt)"
exit $failed
