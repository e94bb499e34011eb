#!/bin/sh
# Random scenes are written so that glint can check them, the same ones for the same seed.
# Usage: run_kept.sh TEST_CHOICES GLINT FOLDER
set -eu
program=$1 glint=$2 folder=$3
"${0%/*}/../../tools/emptied" "$folder"
cd "$folder"
take() { # FOLDER, options
    mkdir "$1"
    "$program" --count 3 --family still,huge,deep --size 16x12 --max-wrong 6 --max-needless 1 --all --keep "$@" >out.txt
}
take kept || exit $?
grep -q '^3 scenes, ' out.txt
grep -qE '^  deep-0 +(right|wrong|needless|beyond) ' out.txt
[ "$(find kept -name '*.glint.yaml' | wc -l)" -eq 3 ]
"$glint" check -q kept
take again
diff -r kept again
take other --seed 1
! cmp -s kept/still-0.glint.yaml other/still-0.glint.yaml
! "$program" --keep nowhere --count 1 --all --family still >out.txt
grep -q '^FAIL ' out.txt
