#!/bin/sh
# From a saved scene to its picture: bench/watch.sh [SCENE | BUNNY.ply] [OPTION...], by build/release/glint render --watch, at
# 512x384 with one sample unless options say otherwise. A mesh of the Stanford bunny is shown four times in a scene made here.
# Each kind of edit that the scene has a place for is made WATCH_EDITS times (11); printed are medians, in milliseconds: the whole,
# from the end of the write to the new file of the picture; what glint says of it; and the processor time that a save took,
# all threads together, which says more than the clock where others work on the machine, too.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=$PWD/build/release/glint
edits=${WATCH_EDITS:-11}
scene=${1:-scenes/showcase.glint.yaml}
[ $# -eq 0 ] || shift
work=$(mktemp -d)
copy=$work/scene.glint.yaml
process=
trap 'kill $process 2>/dev/null; rm -rf "$work" "$copy"' EXIT
case $scene in
*.ply)
    cp "$scene" "$work/mesh.ply"
    {
        printf 'glint: 1\ncamera: {position: [0.04, 0.25, 0.55], look_at: [-0.017, 0.11, -0.05], fov: 42}\nbackground: {color: 0.2}\n'
        printf 'lights: [{position: [0.45, 0.89, 0.62], intensity: 1.4}]\nmaterials: {fur: {diffuse_color: "#f04a28"}}\nmodels:\n'
        for at in '0, 0, 0' '0.17, 0, 0' '-0.17, 0, 0' '0, 0, -0.17'; do
            echo "  - {mesh: mesh.ply, material: fur, translation: [$at]}"
        done
    } >"$copy" ;;
*)
    # Beside the scene, so that its paths are right; gone at the end.
    copy=$(dirname -- "$scene")/.bench-watch.glint.yaml
    cp "$scene" "$copy" ;;
esac
: >"$work/loads.json"
"$glint" render "$copy" --watch -o "$work/out.png" --size 512x384 --samples 1 --stats=json -q "$@" >"$work/loads.json" 2>"$work/said.txt" &
process=$!
loads=0

await() {
    loads=$((loads + 1))
    until [ "$(wc -l <"$work/loads.json")" -ge "$loads" ]; do
        kill -0 "$process" || { cat "$work/said.txt" >&2; exit 1; }
        sleep 0.05
    done
    # A scene with errors is soon loaded: its times say nothing.
    if tail -1 "$work/loads.json" | grep -q '"broken": true'; then cat "$work/said.txt" >&2; exit 1; fi
    sleep 0.2
}

# value KEY: of the last load; 0 where it has none.
value() { tail -1 "$work/loads.json" | sed -n "s/.*\"$1\": \([0-9.e+-]*\).*/\1/p"; }
# milliseconds of processor time, in steps of ten, of all threads that there were
spent() { sed 's/.*) //' "/proc/$process/stat" | awk -v tick="$(getconf CLK_TCK)" '{ print 1e3 * ($12 + $13) / tick }'; }

# edit NAME SED SED: there and back.
edit() {
    sed "$2" "$copy" >"$work/next.yaml"
    if cmp -s "$copy" "$work/next.yaml"; then return; fi
    : >"$work/lines"
    begun=$(spent)
    for step in $(seq "$edits"); do
        if [ $((step % 2)) -eq 1 ]; then change=$2; else change=$3; fi
        sed "$change" "$copy" >"$work/next.yaml"
        cat "$work/next.yaml" >"$copy"
        await
        whole=$(printf '%s %s' "$(stat -c %.9Y "$work/out.png")" "$(stat -c %.9Y "$copy")" | awk '{ print $1 - $2 }')
        echo "$whole $(value total_s) $(value coarse_s) $(value read_s) $(value assets_s) $(value flatten_s) $(value upload_s) $(value frame_s) $(value encode_s)" >>"$work/lines"
    done
    processor=$(echo "$begun $(spent) $edits" | awk '{ print ($2 - $1) / $3 }')
    line=
    for column in 1 2 3 4 5 6 7 8 9; do
        line="$line $(cut -d ' ' -f $column "$work/lines" | sort -g | sed -n "$(((edits + 1) / 2))p")"
    done
    echo "$line $processor $(value meshes_read) $(value trees_built) $(value pipelines_made) $(value bytes_written)" |
        awk -v name="$1" '{ printf "%-9s %6.1f ms, processor %.0f; by itself %.1f: coarse %.1f, read %.1f, assets %.1f, flatten %.1f, upload %.1f, frame %.1f, encode %.1f; %d meshes read, %d trees built, %d pipelines made, %d bytes written\n",
            name, 1e3 * $1, $10, 1e3 * $2, 1e3 * $3, 1e3 * $4, 1e3 * $5, 1e3 * $6, 1e3 * $7, 1e3 * $8, 1e3 * $9, $11, $12, $13, $14 }'
}

await
edit material 's/#f04a28/#20f028/; s/0\.0522876/0.2522876/; s/ivory: {albedo: \[0\.9/ivory: {albedo: [0.8/' \
    's/#20f028/#f04a28/; s/0\.2522876/0.0522876/; s/ivory: {albedo: \[0\.8/ivory: {albedo: [0.9/'
edit light 's/intensity: 1.4/intensity: 1.0/; s/\[-20, 20, 20\]/[-25, 20, 20]/' 's/intensity: 1.0/intensity: 1.4/; s/\[-25, 20, 20\]/[-20, 20, 20]/'
edit camera 's/position: \[0, 1.6, 8\]/position: [0.3, 1.7, 8]/; s/0.04, 0.25, 0.55/0.05, 0.24, 0.55/; s/fov: 60.1/fov: 50.1/' \
    's/position: \[0.3, 1.7, 8\]/position: [0, 1.6, 8]/; s/0.05, 0.24, 0.55/0.04, 0.25, 0.55/; s/fov: 50.1/fov: 60.1/'
edit image 's/max_depth: 12/max_depth: 11/' 's/max_depth: 11/max_depth: 12/'
edit sphere 's/center: \[-0.5, 0.2, 2.7\]/center: [-0.6, 0.2, 2.7]/' 's/center: \[-0.6, 0.2, 2.7\]/center: [-0.5, 0.2, 2.7]/'
edit model 's/translation: \[2.15, 0, 1.3\]/translation: [2.2, 0, 1.3]/; s/translation: \[0.17, 0, 0\]/translation: [0.18, 0, 0]/; s/-1.5, -5.5/-1.4, -5.5/' \
    's/translation: \[2.2, 0, 1.3\]/translation: [2.15, 0, 1.3]/; s/translation: \[0.18, 0, 0\]/translation: [0.17, 0, 0]/; s/-1.4, -5.5/-1.5, -5.5/'
