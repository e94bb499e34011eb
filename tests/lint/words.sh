#!/bin/sh
# No notes to oneself, and no path of one machine.
. "$(dirname -- "$0")/lib.sh"

# Taken apart, so that this file does not hold what it looks for.
notes='TO''DO|FIX''ME|XX''X|HA''CK'
folders='wo''rk|ro''ot|ho''me|Us''ers|t''mp'
texts=$(ours '(\.(c|h|def|glsl|comp|sh|awk|cmake|md|txt|json|ya?ml|xml|in|py)|(^|/)(run|check|CMakeLists\.txt))$')
[ -z "$texts" ] && exit 0
# The system's folder for temporary files may be what its variable defaults to. Meshes and pictures are data.
# shellcheck disable=SC2086
awk -v notes="(^|[^A-Za-z0-9_])($notes)([^A-Za-z0-9_]|\$)" -v fallback='[{]TMPDIR:-/t''mp[}]' \
    -v machine="(^|[] \"'=(,:\`[])/($folders)(/|[]\"' ),;\`]|\$)" '
{ gsub(fallback, "") }
FILENAME !~ /\.md$/ && $0 ~ notes { print FILENAME ":" FNR ": a note to oneself" }
$0 ~ machine { print FILENAME ":" FNR ": a path of one machine" }' $texts | verdict
