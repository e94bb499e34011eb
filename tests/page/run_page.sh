#!/bin/sh
# The page in a browser, typed at: run_page.sh GLINT SOURCE WORK BUILD, where BUILD is a folder for the module (that of builds/web).
# tools/page.sh fetches the editor once; where it has not, or there is no Chromium, the test is skipped.
. "$2/tests/clients.sh"
manual=docs/page.md
build=$4
needs emcc
needs node
[ -x /usr/bin/chromium ] || skip "chromium is not installed ($manual says how)"
GLINT_WEB=${GLINT_WEB:-$source/build/web-root}
GLINT_PAGE_MODULES=${GLINT_PAGE_MODULES:-$source/build/page-root}
[ -d "$GLINT_WEB/root" ] || skip "no libraries for WebAssembly; tools/page.sh builds them"
cmp -s "$source/web/page/package-lock.json" "$GLINT_PAGE_MODULES/package-lock.json" || skip "the editor is not there; tools/page.sh fetches it"
export GLINT_WEB GLINT_PAGE_MODULES
GLINT_WEB_BUILD=$build "$source/tools/page.sh" "$work/page" || fail "the page is not made"
"$source/web/page/weigh" "$work/page" 950000 >/dev/null || fail "the page is heavier than 950 000 bytes"
exec node "$source/tests/page/typing.mjs" "$work/page" "$glint" "$source/scenes" "$GLINT_PAGE_MODULES" "$work"
