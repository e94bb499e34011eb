#!/bin/sh
# glint farm: what is refused; scripts that a shell and shellcheck accept, with names of all kinds; manifests by a schema;
# tasks run by hand, and what 'status' says of them.
# Usage: run_scripts.sh GLINT SOURCE_FOLDER WORK_FOLDER REPORT_TOOL
. "$(dirname -- "$0")/../cli/lib.sh"
tool=$4
export XDG_CACHE_HOME="$work/cache"
export GLINT="$glint"
cat >scene.yaml <<'S'
glint: 1
image: {width: 40, height: 48}
camera: {position: [0, 0, 6]}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}}
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: blue}]
S
turn='camera.position=[{6*sin(360*frame/8)}, 0.5, {6*cos(360*frame/8)}]'

# ---- what is refused
expect 'an engine' 2 - "there is no engine 'pbs'" "$glint" farm pbs scene.yaml
expect 'no scene' 2 - 'needs slurm' "$glint" farm slurm
expect 'standard input' 2 - 'tasks read a file' "$glint" farm slurm -
expect 'frames that nothing moves' 2 - 'nothing depends on the frame' "$glint" farm slurm scene.yaml --frames 0..3 --chunk 1
expect 'frames of one name' 2 - 'more than one of them' "$glint" farm slurm scene.yaml --frames 0..3 --set "$turn" -o o.png
expect 'an unknown word' 2 - 'no word that is known' "$glint" farm slurm scene.yaml --frames 0..3 --set "$turn" -o 'o.%04d%v.png'
expect 'a part' 2 - 'name the picture' "$glint" farm slurm scene.yaml --tiles 2 -o o.part
expect 'standard output' 2 - 'a task writes files' "$glint" farm slurm scene.yaml -o -
expect 'a kind of file' 2 - 'must end in' "$glint" farm slurm scene.yaml -o o.txt
expect 'hosts for Slurm' 2 - "only 'parallel'" "$glint" farm slurm scene.yaml --sshlogin a
expect 'an image for Slurm' 2 - "only 'k8s'" "$glint" farm slurm scene.yaml --image a
expect 'a package on paper' 2 - "'--pack' would have no effect" "$glint" farm slurm scene.yaml --pack
expect 'a chunk without frames' 2 - "'--chunk' would have no effect" "$glint" farm slurm scene.yaml --chunk 2
expect 'too many tiles' 2 - 'at most 6 parts' "$glint" farm slurm scene.yaml --tiles 7 --frames 0..1 --set "$turn" --chunk 1
expect 'pixels that end by their error' 2 - 'not rendered in parts' "$glint" farm slurm scene.yaml --tiles 2 --frames 0..1 --chunk 1 \
    --set "$turn" --set image.error=0.01 --set image.samples=64 --set image.min_samples=4
expect 'a scene with a mistake' 1 - 'E[0-9]*' "$glint" farm slurm scene.yaml --frames 0..1 --chunk 1 --set "$turn" --set spheres[0].radius=x
expect 'a line end in a name' 2 - 'control character' "$glint" farm slurm "sc
ene.yaml"
expect 'no camera' 2 - 'no camera .none.' "$glint" farm slurm scene.yaml --camera none --frames 0..1 --chunk 1 --set "$turn"
expect 'a folder without a plan' 3 - 'farm.plan:1:1: error: cannot be read' "$glint" farm status .
mkdir broken && printf 'glint farm 1\nengine slurm\ntiles 0\n' >broken/farm.plan
expect 'a broken plan' 3 - 'not a plan' "$glint" farm status broken
expect 'status of frames' 2 - "'--frames' would have no effect" "$glint" farm status broken --frames 0..1

# ---- scripts that shells accept
cp scene.yaml "a 'b\" \$(exit 3)\`.yaml"
pictures="o 'u\" \$(exit 3)\`%%.%04d.png"
accepted() {
    sh -n "$2" 2>err.txt && pass "$1: sh -n" || fail "$1: $(cat err.txt)"
    ! command -v shellcheck >/dev/null || shellcheck "$2" >err.txt 2>&1 && pass "$1: shellcheck" || fail "$1: $(cat err.txt)"
}
for engine in slurm parallel; do
    for more in '' '--tiles 3' '--gpus' '--tiles 2 --gpus=2 --size 32x24 --samples 2 --depth 16 --fps 12.5'; do
        # shellcheck disable=SC2086
        "$glint" farm $engine "a 'b\" \$(exit 3)\`.yaml" --frames 0..6:2 --chunk 2 --set "$turn" -o "$pictures" $more -q >job.sh
        accepted "$engine $more" job.sh
    done
    "$glint" farm $engine scene.yaml --chunk 2 --frames 0..3 --set "$turn" --folder "f $engine" -q
    accepted "$engine in a folder" "f $engine/job.sh"
done
expect 'a folder that is taken' 2 - 'holds the plan of a farm' "$glint" farm slurm scene.yaml --chunk 2 --frames 0..3 --set "$turn" --folder 'f slurm'
expect 'or overwritten' 0 - '4 tasks of 1 frame' "$glint" farm slurm scene.yaml --chunk 1 --frames 0..3 --set "$turn" --folder 'f slurm' --force
expect 'pictures in the folder itself' 0 - '4 tasks of 1 frame' "$glint" farm slurm scene.yaml --chunk 1 --frames 0..3 --set "$turn" --folder own -o 'own/%02d.png'

# ---- more tasks than an array takes: several arrays, of which each begins at a task of its own
mkdir fake
cat >fake/sbatch <<'S'
#!/bin/sh
echo "$*" >>"$FAKE_LOG"
wc -l <"$FAKE_LOG"
S
printf '#!/bin/sh\necho "MaxArraySize            = 12"\n' >fake/scontrol
chmod +x fake/sbatch fake/scontrol
export FAKE_LOG="$work/fake.log"
# tasks_of: those of all arrays that were submitted, one a line.
tasks_of() {
    sed -n 's/.*--array=\([^ ]*\) .* from \([0-9]*\)$/\2 \1/p' "$FAKE_LOG" | while read -r first indices; do
        for range in $(echo "$indices" | tr , ' '); do
            seq "$((first + ${range%-*}))" "$((first + ${range#*-}))"
        done
    done
}
"$glint" farm slurm scene.yaml --frames 0..29 --tiles 2 --chunk 1 --set "$turn" -o 'o.%d.png' -q >array.sh
PATH="$PWD/fake:$PATH" sh array.sh >err.txt 2>&1 || fail "arrays: $(cat err.txt)"
[ "$(tasks_of)" = "$(seq 0 59)" ] && [ "$(grep -c array= "$FAKE_LOG")" = 5 ] && pass 'sixty tasks in arrays of twelve' || fail "arrays: $(cat "$FAKE_LOG")"
grep -q 'dependency=afterany:1:2:3:4:5 ' "$FAKE_LOG" && pass 'a merge after all of them' || fail 'a merge after all of them'
[ "$(sed -n 's/.*--array=\([^ ]*\) .*/\1/p' "$FAKE_LOG" | tr ',-' '\n\n' | sort -n | tail -1)" = 11 ] && pass 'indices that Slurm takes' || fail 'indices that Slurm takes'
: >"$FAKE_LOG"
PATH="$PWD/fake:$PATH" sh array.sh submit 3,10-13,59 >err.txt 2>&1
[ "$(tasks_of | tr '\n' ' ')" = '3 10 11 12 13 59 ' ] && pass 'a list over several arrays' || fail "a list: $(cat "$FAKE_LOG")"

# ---- manifests: each document by our schema of the fields that are used (tests/farm/job.schema.json)
for more in '' '--tiles 3' '--tiles 2 --gpus --image registry/glint:1'; do
    # shellcheck disable=SC2086
    "$glint" farm k8s "a 'b\" \$(exit 3)\`.yaml" --frames 0..6:2 --chunk 2 --set "$turn" -o "$pictures" $more -q >job.yaml
    awk '/^---$/ { n++; next } { print > ("document" n + 0 ".yaml") }' job.yaml
    for document in document*.yaml; do
        "$tool" validate-yaml "$source/tests/farm/job.schema.json" "$document" >err.txt 2>&1 &&
            pass "k8s $more: $document" || fail "k8s $more: $document: $(cat err.txt)"
    done
    rm document*.yaml
done

# ---- tasks, run one by one
if ! "$glint" render scene.yaml -o probe.pfm -q 2>/dev/null; then
    [ $failed -eq 0 ] || exit 1
    echo "skip: no Vulkan device: scripts without tasks"
    exit 77
fi
expect 'a pilot' 0 '# .* s of start, and for each picture .* for all its tiles' 'measured 3 small pictures' \
    "$glint" farm slurm scene.yaml --frames 0..99 --set "$turn" --size 320x256
"$glint" farm slurm "a 'b\" \$(exit 3)\`.yaml" --frames 0..2 --tiles 2 --chunk 2 --set "$turn" --folder "the 'farm" --pack -o "$pictures" -q ||
    fail 'a farm with its scene'
rm "a 'b\" \$(exit 3)\`.yaml"
expect 'nothing yet' 1 "^  sh 'the '.''farm/job.sh' submit 0-3" - "$glint" farm status "the 'farm"
for task in 0 1 3; do
    sh "the 'farm/job.sh" task $task >out.txt 2>&1 || fail "task $task: $(cat out.txt)"
done
expect 'one is missing' 1 '^3 of 4 tasks done, 0 failed, 1 not begun' - "$glint" farm status "the 'farm"
GLINT=/bin/false sh "the 'farm/job.sh" task 2 && fail 'a task that fails'
expect 'one failed' 1 'task 2 ended with status 1 on ' - "$glint" farm status "the 'farm"
expect 'as JSON' 1 '"failed": .{"task": 2, "status": 1' - "$glint" farm status "the 'farm" --format json
cp out.txt failed.json
sh "the 'farm/job.sh" task 2 >out.txt 2>&1 || fail "task 2: $(cat out.txt)"
expect 'all but the merge' 1 "^  sh 'the '.''farm/job.sh' merge" - "$glint" farm status "the 'farm"
sh "the 'farm/job.sh" merge >out.txt 2>&1 || fail "merge: $(cat out.txt)"
expect 'all' 0 '^4 of 4 tasks done' - "$glint" farm status "the 'farm"
"$glint" farm status "the 'farm" --format json >done.json
"$tool" validate "$source/docs/schema/farm-report.schema.json" failed.json done.json && pass 'reports by their schema' || fail 'reports by their schema'
"$tool" covers "$source/docs/schema/farm-report.schema.json" failed.json done.json && pass 'all of the schema is reported' || fail 'all of the schema is reported'
"$glint" render scene.yaml --frames 0..2 --set "$turn" -o 'w.%04d.png' -q
for frame in 0000 0001 0002; do
    cmp -s w.$frame.png "o 'u\" \$(exit 3)\`%.$frame.png" || {
        # The record names another path of the scene: pixels are compared.
        "$glint" compare w.$frame.png "o 'u\" \$(exit 3)\`%.$frame.png" --max-largest 0 >/dev/null && pass "frame $frame" || fail "frame $frame"
    }
done
lines=$(cat "the 'farm/log/2.jsonl" | wc -l)
[ "$lines" = 2 ] && pass 'a line for each attempt' || fail "lines of two attempts: $lines"

# A signal reaches the program, whose status is the task's.
cat >slow <<'S'
#!/bin/sh
trap 'exit 75' TERM
: >begun
while :; do sleep 0.1; done
S
chmod +x slow
GLINT=$work/slow sh "the 'farm/job.sh" task 0 &
child=$!
for _ in $(seq 100); do [ -f begun ] || sleep 0.1; done
kill -TERM $child
wait $child
[ $? = 75 ] && pass 'a signal is passed on' || fail 'a signal is passed on'
grep -q '"status": 75' "the 'farm/log/0.jsonl" && pass 'and logged' || fail 'and logged'
exit $failed
