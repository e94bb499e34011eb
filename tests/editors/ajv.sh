#!/bin/sh
# ajv, the validator behind many tools, and the checker agree on the invalid corpus and on what ships.
. "$(dirname -- "$0")/lib.sh"
node_module ajv
node_module yaml
"$glint" schema json >glint.schema.json
GLINT_MODULES=$modules node "$source/tests/editors/ajv.js" glint.schema.json "$source"
