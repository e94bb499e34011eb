#!/bin/sh
# run_validator.sh GLINT SOURCE_FOLDER WORK_FOLDER MAKE_GLTF: what the Khronos validator and `glint check` say of the same
# files. It is skipped where node or the package is not installed: npm install -g gltf-validator, or NODE_PATH.
set -eu
glint=$1 source=$2 work=$3 make_gltf=$4
"$source/tools/emptied" "$work"
cd "$work"
command -v node >/dev/null 2>&1 || {
    echo "skipped: node is not installed"
    exit 77
}
[ -n "${NODE_PATH:-}" ] || NODE_PATH=$(npm root -g 2>/dev/null || echo /usr/share/nodejs)
export NODE_PATH
node -e 'require("gltf-validator")' 2>/dev/null || {
    echo "skipped: gltf-validator is not installed (npm install -g gltf-validator)"
    exit 77
}
"$make_gltf" .
exec node "$source/tests/gltf/validator.js" "$glint" sample.glb embedded.gltf beside.gltf
