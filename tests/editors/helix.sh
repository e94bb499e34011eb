#!/bin/sh
# Helix in a terminal (tmux), with glint lsp started as docs/editors.md says: diagnostics, fix, formatting. The one that is installed; with a
# last word `fetched`, that of tools/editors.sh.
. "$(dirname -- "$0")/lib.sh"
editor hx "${5:-}"
needs tmux
recipe Helix
mkdir -p config/helix
cp recipe config/helix/languages.toml
cat >scene.glint.yaml <<'S'
glint: 1
camera: {position: [0, 0, 5], look_at: [0, 0, 0]}
lights: [{position: [5, 5, 5]}]
spheres:
  - {centre: [0, 0, 0],   radius: 1}
S
# A server of its own, which ends with its window.
terminal() { tmux -S "$work/tmux" -f /dev/null "$@"; }
ends() { terminal kill-server 2>/dev/null || true; }
trap ends EXIT
trap 'exit 1' INT TERM HUP
see() {
    terminal capture-pane -p -t editor >screen 2>/dev/null || : >screen
    grep -qF -- "$1" screen
}
# appears WORDS: on the screen, within a minute.
appears() {
    for i in $(seq 600); do
        see "$1" && return
        sleep 0.1
    done
    cat screen
    fail "never on the screen: $1"
}
keys() { terminal send-keys -t editor "$@"; }
terminal new-session -d -s editor -x 120 -y 30 \
    "XDG_CONFIG_HOME='$work/config' XDG_CACHE_HOME='$work/cache' TERM=screen-256color hx '$work/scene.glint.yaml' 2>'$work/log'"
appears "{centre: [0, 0, 0],   radius"
appears "● 1" # findings, in the status line
keys ']' d
appears "a sphere has no 'centre'"
keys Space a
appears "Replace with 'center'"
keys Enter
appears "{center: [0, 0, 0],   radius"
keys :format Enter
appears "{center: [0, 0, 0], radius"
keys :write Enter
appears "written"
keys :quit Enter
for i in $(seq 100); do
    terminal has-session -t editor 2>/dev/null || break
    sleep 0.1
done
"$glint" check scene.glint.yaml || fail "the file has findings"
"$glint" format --check scene.glint.yaml >/dev/null 2>&1 || fail "the file is not formatted"
echo ok
