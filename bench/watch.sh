#!/bin/sh
# From a saved scene to its picture: bench/watch.sh [SCENE] [OPTION...], by build/release/glint render --watch, at 512x384 with one
# sample unless options say otherwise. Each of six kinds of edits is made five times; of each the least time is printed,
# as glint measures it from when it saw the change, the time to the coarse picture before it (0: there was none), what was done,
# and each stage, in milliseconds.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=$PWD/build/release/glint
scene=${1:-scenes/showcase.glint.yaml}
[ $# -eq 0 ] || shift
work=$(mktemp -d)
# Beside the scene, so that its paths are right; gone at the end.
copy=$(dirname -- "$scene")/.bench-watch.glint.yaml
trap 'kill "$process" 2>/dev/null; rm -rf "$work" "$copy"' EXIT
cp "$scene" "$copy"
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

# edit NAME SED SED: there and back.
edit() {
    best=
    for step in 1 2 3 4 5; do
        if [ $((step % 2)) -eq 1 ]; then change=$2; else change=$3; fi
        sed "$change" "$copy" >"$work/next.yaml"
        cmp -s "$copy" "$work/next.yaml" && { echo "$1: nothing to edit"; return; }
        cat "$work/next.yaml" >"$copy"
        await
        line=$(printf '%s ' "$(value total_s)" "$(value read_s)" "$(value assets_s)" "$(value flatten_s)" "$(value upload_s)" \
            "$(value frame_s)" "$(value encode_s)" "$(value meshes_read)" "$(value trees_built)" "$(value pipelines_made)" "$(value bytes_written)" "$(value coarse_s)")
        best=$(printf '%s\n%s\n' "$best" "$line" | sed '/^$/d' | sort -g | head -1)
    done
    printf '%s\n' "$best" | awk -v name="$1" '{ printf "%-10s %6.1f ms, coarse %.1f: read %.1f, assets %.1f, flatten %.1f, upload %.1f, frame %.1f, encode %.1f; %d meshes read, %d trees built, %d pipelines made, %d bytes written\n",
        name, 1e3 * $1, 1e3 * $12, 1e3 * $2, 1e3 * $3, 1e3 * $4, 1e3 * $5, 1e3 * $6, 1e3 * $7, $8, $9, $10, $11 }'
}

await
edit material 's/#f04a28/#20f028/' 's/#20f028/#f04a28/'
edit light 's/intensity: 1.4/intensity: 1.0/' 's/intensity: 1.0/intensity: 1.4/'
edit camera 's/position: \[0, 1.6, 8\]/position: [0.3, 1.7, 8]/' 's/position: \[0.3, 1.7, 8\]/position: [0, 1.6, 8]/'
edit image 's/max_depth: 12/max_depth: 11/' 's/max_depth: 11/max_depth: 12/'
edit sphere 's/center: \[-0.5, 0.2, 2.7\]/center: [-0.6, 0.2, 2.7]/' 's/center: \[-0.6, 0.2, 2.7\]/center: [-0.5, 0.2, 2.7]/'
edit model 's/translation: \[2.15, 0, 1.3\]/translation: [2.2, 0, 1.3]/' 's/translation: \[2.2, 0, 1.3\]/translation: [2.15, 0, 1.3]/'
