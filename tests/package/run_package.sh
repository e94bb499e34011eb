#!/bin/sh
# Packages: run_package.sh GLINT SOURCE WORK BUILD deb|fresh-root, where BUILD is that of the preset check-only which the test
# builds/check-only has made. Their bytes are the same each time, and what they install works and goes again.
build=$4
kind=$5
. "$2/tests/cli/lib.sh"
skip() {
    echo "skipped: $1"
    exit 77
}
command -v dpkg-deb >/dev/null && command -v dpkg-shlibdeps >/dev/null || skip "dpkg-deb and dpkg-shlibdeps are not installed"
[ -x "$build/glint" ] || skip "builds/check-only has built nothing"
SOURCE_DATE_EPOCH=1700000000
export SOURCE_DATE_EPOCH
version=$(cat "$source/VERSION")
deb=glint-check_${version}_$(dpkg --print-architecture).deb

# pack FOLDER
pack() { (cd "$build" && cpack -G DEB -B "$work/$1" >"$work/$1.log" 2>&1) || cat "$work/$1.log"; }
pack one
[ -s "one/$deb" ] || {
    ls one
    fail "there is no $deb"
    exit 1
}

if [ "$kind" = deb ]; then
    sleep 1 # another time of day
    pack two
    cmp "one/$deb" "two/$deb" && pass "the same bytes again"
    [ "$(dpkg-deb -f "one/$deb" Conflicts)" = glint ] && pass "not beside the whole program" || fail "Conflicts"
    dpkg-deb -f "one/$deb" Depends | grep -q 'libyaml-0-2' && pass "its libraries" || fail "Depends"
    dpkg-deb -f "one/$deb" Depends | grep -qi vulkan && fail "it depends on Vulkan"
    dpkg-deb -c "one/$deb" | awk '$2 != "root/root" || $1 !~ /^(drwxr-xr-x|-rw-r--r--|-rwxr-xr-x)$/ { print; bad = 1 } END { exit bad }' &&
        pass "owners and modes" || fail "owners and modes"
    if command -v lintian >/dev/null; then
        lintian --allow-root "one/$deb" >lintian.txt 2>&1
        grep '^E:' lintian.txt && fail "lintian" || pass "lintian"
    else
        echo "skip lintian is not installed"
    fi
    "$source/packaging/sbom.sh" glint-check "$version" "$build/glint" >sbom.json && grep -q '"SPDX-2.3"' sbom.json &&
        pass "bill of materials" || fail "bill of materials"
    if command -v python3 >/dev/null; then
        python3 -c 'import json, sys
d = json.load(open("sbom.json"))
ids = {p["SPDXID"] for p in d["packages"]}
assert all(r["relatedSpdxElement"] in ids for r in d["relationships"]) and len(ids) == len(d["packages"]) > 1' &&
            pass "it is JSON, and its names are there" || fail "bill of materials"
    fi

    # ---- versions
    mkdir -p repository/tools && cp "$source/tools/release.sh" repository/tools &&
        cp "$source/.pre-commit-hooks.yaml" repository && cd repository || exit 2
    git init -q . && echo 1.2.3 >VERSION
    printf '# Changelog\n\n## next (unreleased)\n\n- new\n\n## 1.2.3 (2001-01-01)\n\n- old\n' >CHANGELOG.md
    expect "a new part" 0 '^1.3.0$' - tools/release.sh bump minor
    [ "$(cat VERSION)" = 1.3.0 ] && grep -q '^## 1.3.0 (2023-11-14)$' CHANGELOG.md && pass "version and section" || fail "bump"
    grep -q 'glint-lint@1\.3\.0\]' .pre-commit-hooks.yaml && pass "the version of its hooks" || fail "hooks"
    expect "its notes" 0 '^- new$' - tools/release.sh notes
    grep -q old out.txt && fail "notes of another version"
    expect "nothing is unreleased" 1 - "does not begin with what is unreleased" tools/release.sh bump patch
    expect "no such part" 2 - "major, minor or patch" tools/release.sh bump little
    exit $failed
fi

# ---- a fresh root

root=${GLINT_FRESH_ROOT:-$source/build/fresh-root}
[ "$(id -u)" = 0 ] && unshare -m true 2>/dev/null || skip "only root can enter a fresh root"
if [ ! -x "$root/usr/bin/dpkg" ]; then
    command -v mmdebstrap >/dev/null || skip "there is no fresh root, and no mmdebstrap to make one"
    "$source/packaging/fresh_root.sh" "one/$deb" "$root" >root.txt 2>&1 || skip "packaging/fresh_root.sh made no root: $(tail -n 1 root.txt)"
fi
cp "$source/scenes/tutorial/step-7.glint.yaml" scene.glint.yaml
sed 's/radius: [0-9.]*/radius: -1/' scene.glint.yaml >wrong.glint.yaml
mkdir upper below merged
cat >inside.sh <<'END'
set -eu
cd /trial
find / -xdev -newer /trial/stamp ! -path '/trial*' >before.txt
begin=$(date +%s%N)
dpkg -i ./*.deb >dpkg.log 2>&1 || { cat dpkg.log; exit 1; }
glint check scene.glint.yaml
echo "installed and checked in $((($(date +%s%N) - begin) / 1000000)) ms"
glint --version
status=0
glint check wrong.glint.yaml >wrong.txt 2>&1 || status=$?
grep -q E206 wrong.txt && [ $status = 1 ]
glint render scene.glint.yaml --device reference --size 32x24 -o picture.png && [ -s picture.png ]
[ -s /usr/share/doc/glint-check/copyright ]
dpkg -r glint-check >dpkg.log 2>&1
dpkg --purge glint-check >>dpkg.log 2>&1
! command -v glint
! find /usr /etc -name '*glint*' | grep .
END
touch stamp
if unshare -m sh -c '
    mount -t tmpfs none upper && mkdir upper/up upper/work upper/trial &&
        mount -t overlay none -o lowerdir="$1",upperdir=upper/up,workdir=upper/work merged &&
        mkdir merged/trial && cp scene.glint.yaml wrong.glint.yaml inside.sh stamp one/*.deb merged/trial &&
        chroot merged /bin/sh /trial/inside.sh' sh "$root" >inside.txt 2>&1; then
    pass "installed, run and removed"
    grep -E '^(installed|glint)' inside.txt
else
    cat inside.txt
    fail "a fresh root"
fi
exit $failed
