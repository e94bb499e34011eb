# What the lint scripts share. A script is run as `NAME.sh FOLDER`, the folder being the repository's root
# or a small tree with a planted violation; it prints `file:line: what is wrong` for each and exits 1 where
# there is one, 77 where a tool that it needs is missing.
set -eu
LC_ALL=C
export LC_ALL
LINT=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
cd "$1"

# Our files whose path matches the pattern: those that git knows or would, else all.
ours() {
    if [ -e .git ] && git ls-files >/dev/null 2>&1; then
        git ls-files -co --exclude-standard
    else
        find . \( -path ./build -o -path ./.git \) -prune -o -type f -print | sed 's|^\./||'
    fi | sort -u | while IFS= read -r path; do
        [ -f "$path" ] && printf '%s\n' "$path"
    done | grep -E "$1" || true
}

# Reads the violations found; shows them and fails where there are any.
verdict() {
    found=$(cat)
    [ -z "$found" ] && return 0
    printf '%s\n' "$found"
    exit 1
}

# The C code of the files named on stdin as `path:line:code`, comments and the insides of literals left out.
code() {
    files=$(cat)
    [ -z "$files" ] && return 0
    # shellcheck disable=SC2086 -- our paths hold no blanks
    awk -f "$LINT/code.awk" $files
}

# The objects of the build in this folder that were made from the files of rooms.
objects() {
    for room in $(sed -n 's/^\([a-z][^:]*\):.*/\1/p' cmake/rooms.txt); do
        [ -d "$1/$room/CMakeFiles" ] || continue
        find "$1/$room/CMakeFiles" -name '*.c.o' | sort | while IFS= read -r object; do
            source=${object#*.dir/}
            [ ! -f "$room/${source%.o}" ] || printf '%s\n' "$object"
        done
    done
}
