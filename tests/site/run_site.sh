#!/bin/sh
# The documentation as HTML: run_site.sh GLINT SOURCE WORK links|browser PAGE, where PAGE is a page that was made, or is not there.
# tools/site.sh fetches what reads Markdown once; where it has not, or there is no Chromium, the test is skipped.
. "$2/tests/clients.sh"
manual=docs/site.md
what=$4
page=$5
needs node
needs npm
GLINT_SITE_MODULES=${GLINT_SITE_MODULES:-$source/build/site-root}
cmp -s "$source/web/site/package-lock.json" "$GLINT_SITE_MODULES/package-lock.json" || skip "what reads Markdown is not there; tools/site.sh fetches it"
export GLINT_SITE_MODULES

# make FOLDER PAGE: the site.
make() {
    GLINT_PAGE=$2 "$source/tools/site.sh" "$1" >made.txt 2>&1 || { cat made.txt; fail "the site is not made"; }
}

# refuses WHY SED FILE: the check finds what a change of a made page breaks.
refuses() {
    rm -rf broken
    cp -R one broken
    sed -i "$2" "broken/$3"
    cmp -s "one/$3" "broken/$3" && fail "nothing changed: $2"
    node "$source/web/site/check.mjs" broken "$GLINT_SITE_MODULES" >said.txt 2>&1 && fail "not found: $2"
    grep -q "$1" said.txt || { cat said.txt; fail "not said: $1"; }
}

# Every code has its page, and each page is what `glint explain` says.
codes() {
    "$glint" explain --list | sed -n 's/^\([EWN][0-9]*\) .*/\1/p' | sort >codes.txt
    [ "$(wc -l <codes.txt)" -gt 100 ] || fail "no list of codes"
    ls one/codes | sed 's/\.html$//' | sort | cmp - codes.txt || fail "not every code has a page"
    for code in E206 W401 E709; do
        [ -f "one/codes/$code.html" ] || continue
        title=$("$glint" explain --color never "$code" | sed -n '1s/^[^:]*: //p')
        grep -q "<h1 id=\"[^\"]*\">$code: $title</h1>" "one/codes/$code.html" || fail "$code is not '$title'"
    done
    grep -q 'it must be from 1e-18 to 1e18 \[E206\]' one/codes/E206.html || fail "E206 has no example"
}

case $what in
links)
    make one "$work/none"
    mkdir -p elsewhere/deeper
    make elsewhere/deeper/two "$work/none"
    diff -r one elsewhere/deeper/two || fail "two builds differ"
    codes
    for anchor in w401-refraction-through-an-open-mesh w434-a-panel-in-the-plane-of-a-face; do
        grep -q "id=\"$anchor\"" one/lint.html || fail "docs/lint.md has lost #$anchor"
    done
    grep -rl 'playground/index.html' one --include=*.html && fail "links to a playground that is not there"
    grep -q 'The playground is not part of this copy' one/page.html || fail "nothing says that there is no playground"
    grep -rlF "$source" one && fail "it names the folder that it was made in"
    refuses "'nowhere.html' is not there" 's|href="tutorial.html"|href="nowhere.html"|' gallery.html
    refuses "has no such anchor" 's|<h2 id="w405-|<h2 id="w4o5-|' lint.html
    refuses "is not beside the site" 's|src="site.js"|src="https://example.org/site.js"|' index.html
    refuses "is not beside the site" 's|href="tutorial.html"|href="/tutorial.html"|' index.html
    refuses "two elements with the id" 's|<main id="content"|<main id="pages"|' index.html
    rm -rf broken two
    ;;
browser)
    [ -x /usr/bin/chromium ] || skip "chromium is not installed ($manual says how)"
    [ -f "$page/scenes.json" ] || page=$source/build/page
    make site "$page"
    exec node "$source/tests/site/browse.mjs" "$work/site" "$GLINT_SITE_MODULES" "$work"
    ;;
esac
