#!/bin/sh
# What a farm costs beside tracing: files opened and bytes read by a task, the merge's time by picture, and how two
# processes on a core each compare with one (weak scaling: twice the tiles in the same time).
# Usage: bench/farm.sh GLINT [SCENE]. Needs strace and taskset; the machine should be idle.
set -eu
glint=$(realpath -- "$1")
scene=$(realpath -- "${2:-$(dirname -- "$0")/../scenes/showcase.glint.yaml}")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd "$work"
size=1920x1080
seconds() {
    began=$(date +%s%N)
    "$@"
    echo "$(date +%s%N) $began" | awk '{ printf "%.2f", ($1 - $2) / 1e9 }'
}

# A task, at the scene's own files: what it opens below the scene's folder is on the shared folder, the rest (libraries,
# the driver, its cache) on each machine.
"$glint" render "$scene" --size 64x64 -o warm.png -q
strace -f -qq -e trace=openat,open,read,pread64 -e signal=none -y -o trace.txt \
    "$glint" render "$scene" --size 64x64 --tile 1/4 -o 1.part -q
folder=$(dirname -- "$scene")
awk -v folder="$folder" '
    index($0, folder) && /open/ && !/ENOENT/ { opened++ }
    index($0, folder) && /read/ { bytes += $NF }
    /open/ && !/ENOENT/ { all++ }
    END { printf "a task opens %d files of the scene and reads %d bytes of them; it opens %d in all\n", opened, bytes, all }' trace.txt

for tile in 1 2 3 4; do
    "$glint" render "$scene" --size $size --samples 1 --tile $tile/4 -o $tile.part -q
done
echo "4 parts of $size: $(cat ./?.part | wc -c) bytes, merged in $(seconds "$glint" merge out.png 1.part 2.part 3.part 4.part -q) s"
echo "a task that is done already: $(seconds "$glint" render "$scene" --size $size --samples 1 --tile 1/4 -o 1.part --skip-done -q) s"

# One process on one core, then two on a core each, a tile of equal work each: the same tile twice.
one() { taskset -c "$1" "$glint" render "$scene" --size $size --tile 2/8 -o "weak$1.part" -q; }
both() {
    one 0 &
    one 1
    wait
}
for _ in 1 2 3; do
    alone=$(seconds one 0)
    together=$(seconds both)
    echo "$alone $together" | awk '{ printf "weak scaling: one process %.2f s, two of them %.2f s: %.0f %%\n", $1, $2, 100 * $1 / $2 }'
done
