# What the editor tests share.
. "$(dirname -- "$0")/../clients.sh"
generate=$4
manual=docs/editors.md

# The folder of a node module: GLINT_NODE_MODULES, or what npm has installed for all.
node_module() {
    needs node
    for folder in "${GLINT_NODE_MODULES:-}" "$(npm root -g 2>/dev/null || true)"; do
        if [ -n "$folder" ] && [ -d "$folder/$1" ]; then
            modules=$folder
            return
        fi
    done
    skip "the node module $1 is not installed"
}
# XML cases of the invalid corpus: "NAME good" or "NAME bad", by what a schema can see.
xml_cases() {
    for folder in "$source"/tests/invalid/*/; do
        name=$(basename "$folder")
        [ -f "$folder/case.xml" ] || continue
        case $name in *_command) continue ;; esac
        if grep -q ': error: ' "$folder/expected.txt" && ! grep -qx "$name" "$source/tests/invalid/checker_only.txt"; then
            echo "$name bad"
        else
            echo "$name good"
        fi
    done
}
xml_scenes() { find "$source/scenes" "$source/tests/scenes" -name '*.xml' | sort; }
# editor PROGRAM [fetched]: the program that is installed, or that of build/editors-root, where tools/editors.sh has put it. glint is found too.
editor() {
    if [ "${2:-}" = fetched ]; then
        root=${GLINT_EDITORS:-$source/build/editors-root}
        [ -x "$root/bin/$1" ] || skip "no $1 of Debian 13; tools/editors.sh fetches it"
        PATH=$root/bin:$PATH
    fi
    needs "$1"
    PATH=$(dirname "$glint"):$PATH
}
# recipe NAME: the lines of docs/editors.md for an editor, as a user copies them.
recipe() {
    sed -n "/^$1 (/,/^[A-Z]/{/^$1 (/b;/^[A-Z]/q;s/^    //p}" "$source/docs/editors.md" >recipe
    [ -s recipe ] || fail "docs/editors.md has no recipe for $1"
}
