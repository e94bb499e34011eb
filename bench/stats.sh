#!/bin/sh
# What `render --stats` costs beside the picture: bench/stats.sh [SCENE SIZE]..., by build/release/glint, or by $GLINT. Each scene is rendered
# in 16 pairs, without and with --stats, one or the other first by turns; then the same with --count-rays, and with --audit. The ratios
# are those of the least processor times (user and system of the whole process).
set -eu
cd "$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)"
glint=${GLINT:-$PWD/build/release/glint}
[ $# -gt 0 ] || set -- scenes/language/lens.glint.yaml 96x72 scenes/language/lens.glint.yaml 320x240 scenes/showcase.glint.yaml 320x240
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
timed() { # SCENE SIZE OPTION...: seconds, on standard output
    scene=$1 size=$2
    shift 2
    TIMEFORMAT='%U %S' bash -c 'time "$@" >/dev/null 2>&1' bash "$glint" render "$scene" --size "$size" -q -o "$work/o.png" "$@" 2>&1
}
ratio() { # SCENE SIZE OPTION...
    for _ in 1 2 3 4 5 6 7 8; do
        timed "$1" "$2" | sed 's/^/plain /'
        timed "$@" | sed 's/^/with /'
        timed "$@" | sed 's/^/with /'
        timed "$1" "$2" | sed 's/^/plain /'
    done | awk '!($1 in best) || $2 + $3 < best[$1] { best[$1] = $2 + $3 } END { printf "%.3f of %.3f s", best["with"] / best["plain"], best["plain"] }'
}
while [ $# -ge 2 ]; do
    printf '%s, %s: --stats %s' "$1" "$2" "$(ratio "$1" "$2" --stats=json)"
    printf ', --count-rays %s' "$(ratio "$1" "$2" --stats=json --count-rays)"
    printf ', --audit %s\n' "$(ratio "$1" "$2" --stats=json --audit)"
    shift 2
done
