#!/bin/sh
# tests/mutation/run.sh [-n COUNT] [-s SEED] [-b FOLDER] [-p PRESET] [-t TESTS] [-j JOBS] [-l] [-f] [-m LINE] [FILE]...
#
# Mutation testing: changes the code that both tracers stand on, one place at a time, and tells whether a test
# sees it. Takes COUNT mutants (60; 0: all) of the files (assets/ and its readers, scene/view.c and transform.c, bodies.c and shape.c,
# tracer/flatten/) in an order that SEED (1) decides, each in a copy of the working tree in FOLDER
# (build/mutation), builds what the tests whose names match TESTS need as PRESET says (dev, whose sanitizers see a
# place read beyond its end), and runs them. Prints a line a mutant, `killed`, `survived`, `unbuilt`, or
# `same` with the reason for those that equivalent.txt says change nothing, which are not built; and at the end the
# score: killed of those built. -l only lists the mutants that would be taken; -m takes one line of such a list. The
# status is 0 where all were told of, whatever the score.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
cd "$here/../.."

count=60 seed=1 folder=build/mutation preset=dev jobs=2 list=false files=false one=
tests='^unit/(mesh|mesh_shape|mesh_triangulate|mesh_material|mesh_robust|mesh_files|mesh_format|gltf_robust|assets|view|lint|flatten|flatten_items|precision|choose_precision|session)$'
while getopts n:s:b:p:t:j:lfm: option; do
    case $option in
    n) count=$OPTARG ;;
    s) seed=$OPTARG ;;
    b) folder=$OPTARG ;;
    p) preset=$OPTARG ;;
    t) tests=$OPTARG ;;
    j) jobs=$OPTARG ;;
    l) list=true ;;
    f) files=true ;;
    m) one=$OPTARG ;;
    *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
export LC_ALL=C
[ $# -gt 0 ] || set -- assets/*.c assets/file/*.c assets/obj/*.c assets/ply/*.c assets/stl/*.c assets/gltf/*.c scene/view.c scene/transform.c scene/bodies.c scene/shape.c tracer/flatten/*.c
if $files; then
    printf '%s\n' "$@"
    exit 0
fi

# A number of its own for each place, whatever the others are: a changed line changes nobody else's turn. Knuth's
# multiplicative hash, in what a double holds.
shuffled() {
    awk -v seed="$seed" 'BEGIN { for (i = 1; i < 256; i++) code[sprintf("%c", i)] = i }
        { hash = seed % 65536; for (i = 1; i <= length($0); i++) hash = (hash * 40503 + code[substr($0, i, 1)]) % 4294967296
          for (i = 0; i < 4; i++) hash = (hash * 40503 + int(hash / 65536)) % 4294967296
          printf "%.0f\t%s\n", hash, $0 }' | sort -n -k1,1 -s | cut -f2-
}
taken() {
    if [ -n "$one" ]; then
        printf '%s\n' "$one" | cut -f1-6
    elif [ "$count" -eq 0 ]; then
        awk -f "$here/mutants.awk" "$@" | shuffled
    else
        awk -f "$here/mutants.awk" "$@" | shuffled | sed "${count}q"
    fi
}
chosen() {
    taken "$@" | awk -f "$here/equivalent.awk" "$here/equivalent.txt" -
}
if $list; then
    chosen "$@"
    exit 0
fi

mkdir -p "$folder"
folder=$(CDPATH='' cd -- "$folder" && pwd)
tree=$folder/tree
chosen "$@" >"$folder/mutants.txt"
mkdir -p "$tree"
# Files that did not change keep their times, so that a second run builds little.
git ls-files -z --cached --others --exclude-standard | tar --null --ignore-failed-read -T - -cf - | tar -xf - -C "$tree" --skip-old-files
git ls-files --cached --others --exclude-standard | while read -r path; do
    [ ! -f "$path" ] || cmp -s "$path" "$tree/$path" || cp "$path" "$tree/$path"
done
(
    cd "$tree"
    cmake --preset "$preset" -B build >build.log 2>&1
    # Some mutants loop for ever; these tests take seconds.
    find build -name CTestTestfile.cmake -exec sed -i 's/TIMEOUT "[0-9]*"/TIMEOUT "30"/' {} +
    ctest --test-dir build -N -V -R "$tests" | grep -o '/tests/[a-z_0-9]*"' | tr -d '"' | sed 's|.*/||' | sort -u >targets.txt
) || {
    cat "$tree/build.log"
    exit 1
}
build() {
    # shellcheck disable=SC2046 # one word a target
    ninja -C "$tree/build" -j"$jobs" $(cat "$tree/targets.txt") >"$tree/build.log" 2>&1
}
try() { # whether the tests pass
    timeout 600 ctest --test-dir "$tree/build" -j"$jobs" --stop-on-failure -R "$tests" >"$tree/test.log" 2>&1
}
if ! build || ! try; then
    tail -n 40 "$tree/build.log"
    [ ! -f "$tree/test.log" ] || tail -n 40 "$tree/test.log"
    echo "mutation: the tests must pass before a mutant is made"
    exit 1
fi

# Puts the mutant of a line of mutants.txt into the tree's file.
apply() {
    awk -v header="$tree/tests/mutation/rounded.h" -v line="$2" -v column="$3" -v size="$4" -v text="$(printf '%s' "$6" | sed 's/[\\&]/\\&/g')" '
        FNR == 1 { printf "#include \"%s\"\n#line 1\n", header }
        FNR == line { $0 = substr($0, 1, column - 1) text substr($0, column + size) }
        { print }' "$1" >"$tree/$1"
}
killed=0 survived=0 unbuilt=0 same=0
tab=$(printf '\t')
while IFS=$tab read -r path line column size kind text reason; do
    was=$(awk -v line="$line" -v column="$column" -v size="$size" 'FNR == line { print substr($0, column, size) }' "$path")
    told="$path:$line:$column: $kind \"$was\" became \"$text\""
    if [ -n "$reason" ]; then
        printf 'same     %s: %s\n' "$told" "$reason"
        same=$((same + 1))
        continue
    fi
    apply "$path" "$line" "$column" "$size" "$kind" "$text"
    if ! build; then
        verdict=unbuilt unbuilt=$((unbuilt + 1))
    elif try; then
        verdict=survived survived=$((survived + 1))
    else
        verdict=killed killed=$((killed + 1))
    fi
    cp "$path" "$tree/$path"
    printf '%-8s %s\n' $verdict "$told"
done <"$folder/mutants.txt"
built=$((killed + survived))
[ $built -gt 0 ] || built=1
echo "mutation: $killed of $((killed + survived)) killed, $((100 * killed / built)) %; $unbuilt did not build, $same change nothing"
