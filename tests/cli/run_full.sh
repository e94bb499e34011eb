#!/bin/sh
# A file system that takes no more: one exit status for every command that writes, the file that the user named in the
# message, and nothing left behind. A limit of the size of files stands for a full disk: it takes the same way back.
# Usage: run_full.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

mkdir out tested fixed
cat >hall.glint.yaml <<'S'
glint: 1
image: {width: 32, height: 24}
camera: {position: [0, 0, 5]}
lights: [{position: [5, 5, 5]}]
spheres:
  - {center: [0, 0, 0], radius: 1, material: {albedo: [1, 0.5, 0.2, 0]}}
S
cp hall.glint.yaml tested
sed 's/: /:   /' hall.glint.yaml >fixed/loose.glint.yaml
printf 'glint: 1\ncamera: {}\nshperes: []\n' >fixed/wrong.glint.yaml
for tile in 1 2; do "$glint" render hall.glint.yaml -q --tile $tile/2 -o $tile.part || fail "a part"; done

moves='--frames 0..3 --set camera.position=[0,0,{5+frame}]'
# One line a command: what it names in its message; the command.
cat >commands.txt <<S
out/x.png render hall.glint.yaml -q -o out/x.png
out/x.png render hall.glint.yaml -q -o out/x.png --device reference
out/x.exr render hall.glint.yaml -q -o out/x.exr
out/x.part render hall.glint.yaml -q --tile 1/2 -o out/x.part
out/x.png render hall.glint.yaml -q -o out/x.png --size 2000x2000
out/x.png.checkpoint render hall.glint.yaml -q -o out/x.png --samples 64 --resume
out/0.png render hall.glint.yaml -q $moves -o out/%d.png
out/x.y4m render hall.glint.yaml -q $moves -o out/x.y4m
out/0.png.checkpoint render hall.glint.yaml -q --resume $moves -o out/%d.png
out/x.exr render hall.glint.yaml -q --aov depth -o out/x.exr
out/x.png merge out/x.png 1.part 2.part
out/farm/job.sh farm slurm hall.glint.yaml $moves --chunk 2 -o out/%d.png --folder out/farm
out/farm/job.yaml farm k8s hall.glint.yaml $moves --chunk 2 -o out/%d.png --folder out/farm
out/farm/job.sh farm parallel hall.glint.yaml $moves --chunk 2 -o out/%d.png --folder out/farm
out/farm/scene farm parallel hall.glint.yaml $moves --chunk 2 -o out/%d.png --folder out/farm --pack
out/x.zip pack hall.glint.yaml out/x.zip
out/folder pack hall.glint.yaml out/folder
out/x.glint.xml convert hall.glint.yaml out/x.glint.xml
fixed/loose.glint.yaml format fixed/loose.glint.yaml
fixed/wrong.glint.yaml check --fix=all fixed/wrong.glint.yaml
out/x.sarif check hall.glint.yaml --format sarif -o out/x.sarif
out/x.txt check hall.glint.yaml --write-baseline out/x.txt
tested/hall.png test tested --bless
out/x.html test tested --html out/x.html
S
listing() { find out tested fixed -type f -exec cksum {} + -o -print | sort; }
listing >before.txt
while read -r named command; do
    # shellcheck disable=SC2086 # no word of these commands has a blank
    { (ulimit -f 0 && exec "$glint" $command) </dev/null 2>&1 || echo "status $?"; } | cat >said.txt
    if [ "$(tail -n 1 said.txt)" = "status 3" ] && grep -q "^$named:1:1: error: .*File too large \[E802\]\$" said.txt &&
        ! grep -q '\.glint-' said.txt && listing | cmp -s - before.txt; then
        pass "$command"
    else
        fail "$command"
        cat said.txt
        listing | diff before.txt -
        rm -rf out && mkdir out
    fi
done <commands.txt
[ "$(grep -c . commands.txt)" -eq 24 ] || fail "the commands were not all read"
# A folder that was there before stays, with what it holds.
mkdir out/farm && : >out/farm/mine
{ (ulimit -f 0 && exec "$glint" farm slurm hall.glint.yaml --chunk 1 --frames 0..3 -o out/%d.png --folder out/farm) 2>&1; } | cat >said.txt
[ "$(ls -A out/farm)" = mine ] && pass "a folder that was there" || fail "a folder that was there"
exit "$failed"
