#!/bin/sh
# Installs every program of others that a test drives, so that continuous integration skips none: tools/clients.sh. Debian's packages as
# root or with sudo; npm's by tools/clients/package-lock.json with its hashes, into build/clients; what is built for WebAssembly, older
# processors and newer editors into folders of build/. What is there already is kept. Nobody needs this to build, run or check glint:
# a test whose program is missing is skipped, by name. `. tools/clients.env` names the folders to a shell.
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
packages="ccache chromium emscripten dpkg-dev jing emacs-nox elpa-eglot elpa-yaml-mode neovim tmux vim pre-commit ffmpeg slurm-wlm munge
parallel povray tachyon libembree-dev mmdebstrap lintian"
command -v node >/dev/null && command -v npm >/dev/null || packages="$packages nodejs npm"
tools/setup.sh test
tools/setup.sh packages $packages
# Debian's emscripten calls the first python3 that it finds for every file: a wrapper of another one takes twice the time.
EMSDK_PYTHON=/usr/bin/python3
export EMSDK_PYTHON

# made FOLDER SOURCES COMMAND...: runs the command unless FOLDER was made by it from the same sources.
made() {
    folder=$1
    sources=$2
    shift 2
    # shellcheck disable=SC2086
    key=$(cat $sources | cksum)
    [ "$(cat "build/$folder.made" 2>/dev/null)" = "$key" ] && [ -d "build/$folder" ] && return
    echo "clients: $*" >&2
    mkdir -p build
    "$@" >"build/$folder.log" 2>&1 || {
        tail -n 40 "build/$folder.log" >&2
        exit 1
    }
    echo "$key" >"build/$folder.made"
}
npm_clients() {
    rm -rf build/clients
    mkdir -p build/clients
    cp tools/clients/package.json tools/clients/package-lock.json build/clients
    (cd build/clients && npm ci --ignore-scripts --no-audit --no-fund)
    chmod +x build/clients/node_modules/@microsoft/sarif-multitool-*/Sarif.Multitool
}
# Two at a time: what needs the libraries for the web waits for them; page and extension share a build.
made web-root 'tools/web.sh tools/apt_apart.sh' tools/web.sh &
web=$!
made clients tools/clients/package-lock.json npm_clients
made i386 'tools/i386.sh tools/apt_apart.sh' tools/i386.sh
made editors-root 'tools/editors.sh tools/apt_apart.sh' tools/editors.sh
wait $web
made webgpu-root web/gpu/package-lock.json tools/webgpu.sh &
webgpu=$!
made page-root web/page/package-lock.json tools/page.sh
made vscode-root web/vscode/package-lock.json tools/vscode.sh
made site-root web/site/package-lock.json tools/site.sh
wait $webgpu
