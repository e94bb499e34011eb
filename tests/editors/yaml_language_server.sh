#!/bin/sh
# yaml-language-server, the one behind most editors, against the emitted schema: diagnostics, hover, completion.
. "$(dirname -- "$0")/lib.sh"
node_module yaml-language-server
"$glint" schema json >glint.schema.json
node "$source/tests/editors/yaml_language_server.js" "$modules/yaml-language-server" "$work" "$source"
