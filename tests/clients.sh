# What the tests with programs of others share. Each is run as NAME.sh GLINT SOURCE_FOLDER WORK_FOLDER PROGRAM of ours; it
# exits 77 and says so where its client is not installed: $manual tells how to install it.
set -eu
glint=$1
source=$2
work=$3
"$source/tools/emptied" "$work"
cd "$work"

skip() {
    echo "skipped: $1"
    exit 77
}
fail() {
    echo "FAIL $*"
    exit 1
}
needs() {
    command -v "$1" >/dev/null 2>&1 || skip "$1 is not installed ($manual says how)"
}
