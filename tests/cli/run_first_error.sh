#!/bin/sh
# What is wrong with the scene's file is the first thing that every command says, with one exit status for one cause.
# Usage: run_first_error.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

mkdir folder.yaml
mkfifo fifo.yaml
: >empty.yaml
printf 'glint: [1\n' >syntax.yaml
printf 'glint: 1\ncamera: {position: [0, 0, 9]}\nspheres: [{center: [0, 0, 0], radius: 1}]\n' >secret.yaml
chmod 000 secret.yaml
printf 'P' >picture.png

# One line a command: FILE is the scene.
cat >commands.txt <<'S'
check FILE
inspect FILE
deps FILE
convert FILE out.xml
format FILE
diff FILE FILE
pack FILE out.zip
render FILE -o out.png
render FILE -o out.png --device reference
render FILE -o out.part --tile 1/2
render FILE -o out.png --time 1
render FILE -o out.png --max-error flip=0.02
render FILE -o out.png --watch
render FILE --frames 0..3 -o out.%d.png
render FILE --frames all -o out.%d.png
render FILE --frames 0..3 -o out.mp4
render FILE --camera all
render FILE --sweep image.samples=1:4:2 -o out.%v.png
farm slurm FILE --frames 0..3 -o out.%d.png
farm slurm FILE --frames 0..3 --chunk 2 -o out.%d.png --folder farm
farm parallel FILE --frames all -o out.%d.png --folder farm
view FILE
pick FILE 1,1
pick FILE 1,1 --device reference
tradeoff FILE
extremes FILE
S
# Of each file: its code, and the exit status.
try() {
    kind=$1 code=$2 status=$3
    shift 3
    while read -r command; do
        words=$(echo "$command" | sed "s/FILE/$kind.yaml/g")
        case $kind:$command in
        folder:check* | folder:format*) continue ;; # they look for scenes in it
        empty:*--watch | empty:view* | syntax:*--watch | syntax:view*) continue ;; # they wait for a better text
        esac
        # shellcheck disable=SC2086
        timeout 60 "$@" "$glint" $words >out.txt 2>&1 </dev/null
        got=$?
        first=$(grep -m1 'error: ' out.txt)
        case $first in
        "$kind".yaml:1:*"[$code]") good=1 ;;
        *) good=0 ;;
        esac
        if [ "$got" -eq "$status" ] && [ $good = 1 ]; then
            pass "$words"
        else
            fail "$words: exit $got, wanted $status with $code first: $first"
        fi
    done <commands.txt
    ok "nothing is left behind by commands about $kind" sh -c '! ls -d out* farm .glint* 2>/dev/null | grep -v "^out.txt$"'
    rm -rf farm out.*
}
try missing E601 3
try folder E603 3
try fifo E603 3
try empty E105 1
try syntax E101 1
if [ "$(id -u)" -ne 0 ]; then
    try secret E604 3
elif command -v setpriv >/dev/null && chmod 777 . && setpriv --reuid 65534 --clear-groups test -x "$glint"; then
    chown -R 65534 .
    chown 0 secret.yaml
    try secret E604 3 setpriv --reuid 65534 --regid 65534 --clear-groups
fi
exit $failed
