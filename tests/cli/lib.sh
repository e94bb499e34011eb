# What tests of glint's commands share: an empty work folder, and what to expect of a command. To be sourced by
# NAME.sh GLINT SOURCE_FOLDER WORK_FOLDER ...; a failure is kept in $failed, the exit code of the whole.
set -u
glint=$1
source=$2
work=$3
failed=0
"$source/tools/emptied" "$work" || exit 2
cd "$work" || exit 2

pass() { echo "ok   $1"; }
fail() {
    echo "FAIL $1"
    failed=1
}

# matches PATTERN FILE: PATTERN is an extended regular expression; '-' means that the file is empty, '' anything.
matches() {
    if [ "$1" = - ]; then
        [ ! -s "$2" ]
    elif [ -n "$1" ]; then
        grep -qE -e "$1" "$2"
    fi
}

# expect NAME EXIT PATTERN_OUT PATTERN_ERR command...: what it prints lies in out.txt and err.txt behind it, so that
# the command itself cannot read what the one before has printed.
expect() {
    name=$1 wanted=$2 out=$3 err=$4
    shift 4
    "$@" >out.txt 2>err.txt </dev/null
    got=$?
    if [ "$got" -eq "$wanted" ] && matches "$out" out.txt && matches "$err" err.txt; then
        pass "$name"
    else
        fail "$name: exit $got, wanted $wanted with out '$out', err '$err'"
        sed 's/^/     out: /' out.txt | head -20
        sed 's/^/     err: /' err.txt | head -20
    fi
}

# also NAME PATTERN_OUT PATTERN_ERR: of what the command before has printed.
also() {
    if matches "$2" out.txt && matches "$3" err.txt; then
        pass "$1"
    else
        fail "$1: wanted out '$2', err '$3'"
    fi
}

# within SECONDS command...: of processor time.
within() {
    (
        ulimit -t "$1"
        shift
        "$@"
    )
}

# works PROCESS HUNDREDTHS: waits until it has used so many hundredths of a second of processor time; false: it ended.
works() {
    while used=$(sed 's/.*) //' "/proc/$1/stat" 2>/dev/null | awk '{print $12 + $13}') && [ -n "$used" ]; do
        [ "$used" -lt "$2" ] || return 0
        sleep 0.05
    done
    return 1
}

# tells NAME EXIT PATTERN command...: the same of standard output and error together, in out.txt.
tells() {
    name=$1 wanted=$2 pattern=$3
    shift 3
    "$@" >out.txt 2>&1 </dev/null
    got=$?
    if [ "$got" -eq "$wanted" ] && matches "$pattern" out.txt; then
        pass "$name"
    else
        fail "$name: exit $got, wanted $wanted with '$pattern'"
        head -20 out.txt
    fi
}

# ok NAME command...: it ends well.
ok() {
    name=$1
    shift
    if "$@" >said.txt 2>&1; then
        pass "$name"
    else
        fail "$name: $*"
        head -20 said.txt
    fi
}

# same NAME FILE FILE
same() {
    if cmp -s "$2" "$3"; then
        pass "$1"
    else
        fail "$1"
        diff "$2" "$3" | head -20
    fi
}

# same_twins SCENE PICTURE: the scene's twins in XML, which stays as twin.xml, and JSON have its meaning and its picture.
same_twins() {
    for other in twin.xml twin.json; do
        expect "converted, $other" 0 - '' "$glint" convert "$1" "$other"
        expect "drawn" 0 - '' "$glint" render "$other" -q --device reference -o other.pfm
        expect "the same picture, $other" 0 - - cmp other.pfm "$2"
    done
    expect "no difference" 0 - '' "$glint" diff "$1" twin.xml
}
