#!/bin/sh
# Releases.
#     tools/release.sh bump major|minor|patch   the next version into VERSION, and the changelog's topmost section gets it and a date
#     tools/release.sh notes [VERSION]          that version's section of the changelog
#     tools/release.sh make FOLDER [--once] [--native]
#                                               all artefacts of HEAD and their SHA-256, into a new folder; each is built twice, in
#                                               two folders, and the bytes are compared. --native: without those of WebAssembly,
#                                               which need what tools/page.sh and tools/vscode.sh need
# A version is MAJOR.MINOR.PATCH: major where scenes or reports that were right stop to be so, minor where something is new,
# patch where something is mended. Nothing is published and no tag is made: `git tag -s vVERSION` is the last step.
set -eu
cd "$(dirname -- "$0")/.."

# The section of CHANGELOG.md, without its heading.
notes() {
    awk -v version="$1" '/^## / { on = $2 == version; next } on' CHANGELOG.md
}

bump() {
    today=$(date -u -d "@${SOURCE_DATE_EPOCH:-$(date +%s)}" +%Y-%m-%d)
    next=$(awk -F. -v part="$1" 'NR == 1 {
        if (part == "major") print $1 + 1 ".0.0"
        if (part == "minor") print $1 "." $2 + 1 ".0"
        if (part == "patch") print $1 "." $2 "." $3 + 1
    }' VERSION)
    [ -n "$next" ] || { echo "release: bump by major, minor or patch" >&2; exit 2; }
    heading=$(sed -n '/^## /{p;q}' CHANGELOG.md)
    case $heading in
    *"(unreleased)") ;;
    *) echo "release: CHANGELOG.md does not begin with what is unreleased, but with '$heading'" >&2; exit 1 ;;
    esac
    # What was never released keeps its number.
    if [ "$(git tag -l "v$(cat VERSION)")" = "" ] && [ "${heading#*"$(cat VERSION)"}" != "$heading" ]; then
        next=$(cat VERSION)
    fi
    printf '%s\n' "$next" >VERSION.tmp && mv VERSION.tmp VERSION
    sed -i "s/glint-lint@[0-9.]*/glint-lint@$next/" .pre-commit-hooks.yaml
    awk -v next_version="$next" -v today="$today" '/^## / && !done { print "## " next_version " (" today ")"; done = 1; next } 1' \
        CHANGELOG.md >CHANGELOG.md.tmp && mv CHANGELOG.md.tmp CHANGELOG.md
    echo "$next"
}

# build SOURCE OUT: from an unpacked archive, without git.
build() {
    (
        cd "$1"
        for preset in release check-only; do
            cmake --preset $preset -DGLINT_ZSH_DIR=share/zsh/vendor-completions >configure.log
            cmake --build build/$preset --parallel 2 --target glint >build.log
            (cd build/$preset && cpack -G DEB -B "$2" >cpack.log)
        done
        cmake --preset check-only -B build/static -DGLINT_STATIC=ON "-DCMAKE_C_FLAGS_RELEASE=-O2 -DNDEBUG" >configure.log
        cmake --build build/static --parallel 2 --target glint >build.log
        packaging/static.sh build/static "$2"
        packaging/sbom.sh glint "$version" build/release/glint >"$2/glint-$version.spdx.json"
        packaging/sbom.sh glint-check "$version" build/static/glint >"$2/glint-check-$version.spdx.json"
    )
    rm -rf "$2/_CPack_Packages"
}

# build_web SOURCE OUT: likewise; the libraries of the module are the same for both folders.
build_web() {
    (
        cd "$1"
        GLINT_WEB="$work/web-root" GLINT_PAGE_MODULES="$work/page-root" tools/page.sh build/page >page.log
        GLINT_WEB="$work/web-root" GLINT_VSCODE_MODULES="$work/vscode-root" tools/vscode.sh build/vscode >vscode.log
        cp "build/vscode/glint-$version.vsix" "$2"
        npm pack --silent --pack-destination "$2" ./build/web/glint-lint >pack.log
        tar -C build/page --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" --format=gnu \
            --transform="s|^\.|glint-page-$version|" -cf - . | xz -9 -T1 >"$2/glint-page-$version.tar.xz"
    )
}

make_all() {
    out=${1:?a new folder for the artefacts}
    shift
    once=
    native=
    for word; do
        case $word in
        --once) once=1 ;;
        --native) native=1 ;;
        *) echo "release: there is no '$word'" >&2 && exit 2 ;;
        esac
    done
    version=$(cat VERSION)
    for program in emcc npm; do
        [ -n "$native" ] || command -v $program >/dev/null || {
            echo "release: the npm package, the page and the extension need $program; --native makes the rest" >&2
            exit 1
        }
    done
    [ -z "$(git status --porcelain)" ] || { echo "release: the working tree has changes" >&2; exit 1; }
    [ ! -e "$out" ] || { echo "release: $out exists" >&2; exit 1; }
    mkdir -p "$out"
    whole=$(cd "$out" && pwd)
    out=$whole.new
    rm -rf "$out"
    rmdir "$whole"
    mkdir "$out"
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
    GLINT_COMMIT=$(git rev-parse --short=12 HEAD)
    export SOURCE_DATE_EPOCH GLINT_COMMIT
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    git archive --format=tar --prefix="glint-$version/" HEAD | xz -9 -T1 >"$out/glint-$version.tar.xz"
    mkdir -p "$work/one" "$work/another/folder" "$work/second"
    tar -C "$work/one" -xf "$out/glint-$version.tar.xz"
    build "$work/one/glint-$version" "$out"
    [ -n "$native" ] || build_web "$work/one/glint-$version" "$out"
    if [ -z "$once" ]; then
        tar -C "$work/another/folder" -xf "$out/glint-$version.tar.xz"
        build "$work/another/folder/glint-$version" "$work/second"
        [ -n "$native" ] || build_web "$work/another/folder/glint-$version" "$work/second"
        for file in "$work/second"/*; do
            cmp "$file" "$out/${file##*/}" || { echo "release: ${file##*/} is not the same from another folder" >&2; exit 1; }
        done
    fi
    notes "$version" >"$out/notes.md"
    (cd "$out" && sha256sum -- * >"$work/sums" && mv "$work/sums" SHA256SUMS)
    mv "$out" "$whole"
    cat "$whole/SHA256SUMS"
}

case "${1:-}" in
bump) bump "${2:-}" ;;
notes) notes "${2:-$(cat VERSION)}" ;;
make)
    shift
    make_all "$@"
    ;;
*)
    sed -n '2,8s/^# //p' "$0" >&2
    exit 2
    ;;
esac
