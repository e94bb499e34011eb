#!/bin/sh
# Manifests of glint farm k8s by the schema that Kubernetes publishes. Skipped where node or the packages are not installed:
# npm install -g kubernetes-models js-yaml, or NODE_PATH.
# Usage: run_k8s.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
[ -n "${NODE_PATH:-}" ] || NODE_PATH=$(npm root -g 2>/dev/null || echo /usr/share/nodejs)
export NODE_PATH
node -e 'require("kubernetes-models/batch/v1/Job"); require("js-yaml")' 2>/dev/null || {
    echo "skipped: kubernetes-models and js-yaml are not installed (npm install -g kubernetes-models js-yaml)"
    exit 77
}
printf 'glint: 1\nspheres: [{center: [0, 0, -3], radius: 1}]\nanimation: {frames: 20, tracks: {"spheres[0].radius": 1 + frame/40}}\n' >scene.yaml
"$glint" farm k8s scene.yaml --frames all --chunk 2 -o 'o.%d.png' -q >frames.yaml
"$glint" farm k8s scene.yaml --frames all --chunk 2 --tiles 3 --gpus --image glint:1 -o 'o.%d.png' -q >tiles.yaml
"$glint" farm k8s scene.yaml --tiles 3 -o one.png -q >one.yaml
node "$source/tests/farm/manifest.js" frames.yaml tiles.yaml one.yaml || failed=1
# The schema sees what is wrong.
for change in 's/completionMode: Indexed/completionMode: 3/' 's/backoffLimitPerIndex: 3/backoffLimitPerIndex: three/' 's/containers:/container:/'; do
    sed "$change" tiles.yaml >wrong.yaml
    cmp -s wrong.yaml tiles.yaml && fail "$change changes nothing"
    node "$source/tests/farm/manifest.js" wrong.yaml >wrong.txt && fail "accepted: $change" || pass "refused: $change"
done
exit $failed
