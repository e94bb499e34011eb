#!/bin/sh
# Fetches the editors of Debian 13 (Neovim, Helix, Emacs) into a folder, to run the recipes of docs/editors.md with them: tools/editors.sh
# [FOLDER], which is build/editors-root if none is named, gets bin/nvim, bin/hx and bin/emacs. apt checks the packages' signatures; nothing
# is installed. They run with their own C library, so any Debian will do.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/editors-root}
"$here/tools/emptied" "$folder"
mkdir -p "$folder/root" "$folder/bin"
cd "$folder"
suite=trixie
kind=deb
. "$here/tools/apt_apart.sh"
apt-get install -y -qq --download-only --no-install-recommends neovim hx emacs-nox elpa-yaml-mode >apt/log 2>&1 || {
    tail -n 20 apt/log
    exit 1
}
for package in apt/cache/archives/*.deb; do
    dpkg-deb -x "$package" root
done
rm -rf apt root/usr/share/doc root/usr/share/man root/usr/share/locale

# program NAME FILE [SETTING=VALUE...]: bin/NAME, which runs the file with its own loader and libraries.
loader=$(find root/usr -name 'ld-linux-*.so.*' -type f | head -n 1)
libraries=$(dirname -- "$(find root/usr -name libc.so.6 | head -n 1)")
program() {
    name=$1
    file=$2
    shift 2
    {
        echo '#!/bin/sh'
        [ $# = 0 ] || printf 'export %s\n' "$@"
        printf 'exec "%s" --library-path "%s" "%s" %s"$@"\n' "$folder/$loader" "$folder/$libraries" "$folder/$file" "${options:-}"
    } >"bin/$name"
    chmod +x "bin/$name"
}
program nvim root/usr/bin/nvim "VIM=$folder/root/usr/share/nvim" "VIMRUNTIME=$folder/root/usr/share/nvim/runtime"
program hx root/usr/lib/hx/hx "HELIX_RUNTIME=$folder/root/usr/lib/hx/runtime"
lisp=$(find root/usr/share/emacs -maxdepth 2 -name lisp -type d)
yaml=$(find root/usr/share/emacs/site-lisp/elpa-src -maxdepth 1 -name 'yaml-mode-*')
options="--dump-file=\"$folder/$(find root/usr/libexec/emacs -name '*.pdmp')\" "
program emacs root/usr/bin/emacs-nox "EMACSLOADPATH=$folder/$lisp:$folder/$yaml" "EMACSDATA=$folder/$(dirname -- "$lisp")/etc" \
    "EMACSPATH=$folder/$(dirname -- "$(find root/usr/libexec/emacs -name '*.pdmp')")"
for name in nvim hx emacs; do
    "bin/$name" --version | head -n 1
done
