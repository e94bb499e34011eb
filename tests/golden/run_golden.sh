#!/bin/sh
# Usage: run_golden.sh GLINT FOLDER [PATTERN]: glint test; skipped where there is no device, and never where a picture has no scene.
# The pictures are beside the scenes' folder: it is the work tree that allows them.
unset GIT_CEILING_DIRECTORIES
"$1" test "$2" ${3:+--only "$3"} >"${TMPDIR:-/tmp}/golden.$$" 2>&1
status=$?
cat "${TMPDIR:-/tmp}/golden.$$"
grep -q '^glint: no scene has the picture' "${TMPDIR:-/tmp}/golden.$$" && status=1
rm -f "${TMPDIR:-/tmp}/golden.$$"
[ "$status" -eq 4 ] && exit 77
exit "$status"
