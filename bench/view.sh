#!/bin/sh
# From a saved scene to what its window shows: bench/view.sh [EDITS], by build/release/glint view on a display in memory, of
# scenes/tinyraytracer.glint.yaml at 512x384. Its background changes from green to red and back; printed is the median of the
# milliseconds, by the clock, from the end of the write until a pixel of the window has the other colour: in the first picture
# after the save, which has fewer pixels where all of them would take longer. Needs Xvfb and build/release/tests/x_events.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=$PWD/build/release/glint
events=$PWD/build/release/tests/x_events
edits=${1:-15}
work=$(mktemp -d)
process=
server=
trap 'kill $process $server 2>/dev/null; rm -rf "$work"' EXIT
Xvfb -noreset -displayfd 3 -screen 0 640x480x24 -nolisten tcp 3>"$work/number" >"$work/xvfb" 2>&1 &
server=$!
until [ -s "$work/number" ]; do sleep 0.05; done
DISPLAY=:$(cat "$work/number")
export DISPLAY
sed 's/0\.2, 0\.7, 0\.8/0, 1, 0/' scenes/tinyraytracer.glint.yaml >"$work/green.yaml"
sed 's/0, 1, 0\]/1, 0, 0]/' "$work/green.yaml" >"$work/red.yaml"
cd "$work"
cat green.yaml >scene.yaml
"$glint" view scene.yaml --size 512x384 -q &
process=$!
"$events" scene.yaml await color 5 200 00ff00 shot.ppm
: >spent.txt
for edit in $(seq "$edits"); do
    sleep 1
    if [ $((edit % 2)) -eq 1 ]; then name=red color=ff0000; else name=green color=00ff00; fi
    cat $name.yaml >scene.yaml
    begun=$(date +%s%N)
    "$events" scene.yaml color 5 200 $color shot.ppm
    echo $((($(date +%s%N) - begun) / 1000000)) >>spent.txt
done
echo "median of $edits: $(sort -g spent.txt | sed -n "$(((edits + 1) / 2))p") ms; least $(sort -g spent.txt | head -1), most $(sort -g spent.txt | tail -1)"
