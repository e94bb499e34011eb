#!/bin/sh
# The RELAX NG schema accepts every XML scene that ships and generated ones, and refuses what glint refuses.
# usage: relaxng.sh GENERATE_SCENE WORK_FOLDER    (from the source folder)
set -eu
generate=$1
work=$2
schema=docs/schema/glint.rng
command -v xmllint >/dev/null || { echo "skipped: xmllint is not installed"; exit 77; }
tools/emptied "$work"

accepts() { xmllint --noout --relaxng "$schema" "$@" 2>"$work/report"; }

find scenes tests/scenes -name '*.xml' >"$work/list"
test -s "$work/list" || { echo "no XML scenes"; exit 1; }
while read -r scene; do
    accepts "$scene" || { echo "refused: $scene"; cat "$work/report"; exit 1; }
done <"$work/list"

seed=0
while [ $seed -lt 40 ]; do
    "$generate" $seed xml >"$work/generated$seed.xml"
    seed=$((seed + 1))
done
accepts "$work"/generated*.xml || { echo "refused a generated scene"; cat "$work/report"; exit 1; }

refuses() {
    printf '%s\n' "$1" >"$work/bad.xml"
    if accepts "$work/bad.xml"; then
        echo "accepted: $1"
        exit 1
    fi
}
refuses '<Scene/>'
refuses '<Scene glint="2"/>'
refuses '<scene glint="1"/>'
refuses '<Scene glint="1" colour="red"/>'
refuses '<Scene glint="1"><Image width="0"/></Scene>'
refuses '<Scene glint="1"><Image width="10.5"/></Scene>'
refuses '<Scene glint="1"><Image/><Image/></Scene>'
refuses '<Scene glint="1"><Image tone="Clip"/></Scene>'
refuses '<Scene glint="1"><Trace shadows="1"/></Scene>'
refuses '<Scene glint="1"><Camera fov="361"/></Scene>'
refuses '<Scene glint="1"><Camera fov="60deg"/></Scene>'
refuses '<Scene glint="1"><Camera name="2nd"/></Scene>'
refuses '<Scene glint="1"><Camera><Position x="0" y="0"/></Camera></Scene>'
refuses '<Scene glint="1"><Camera><LookAt x="0" y="0" z="1"/><Direction x="0" y="0" z="1"/></Camera></Scene>'
refuses '<Scene glint="1"><Light/></Scene>'
refuses '<Scene glint="1"><Light color="#12345"><Position x="0" y="0" z="1"/></Light></Scene>'
refuses '<Scene glint="1"><Material/></Scene>'
refuses '<Scene glint="1"><Material name="m" diffuse_color="0.5"><DiffuseColor r="1" g="1" b="1"/></Material></Scene>'
refuses '<Scene glint="1"><Sphere radius="1"/></Scene>'
refuses '<Scene glint="1"><Sphere radius="-1"><Center x="0" y="0" z="0"/></Sphere></Scene>'
refuses '<Scene glint="1"><Sphere radius="1"><Center x="0" y="0" z="0"/>text</Sphere></Scene>'
refuses '<Scene glint="1"><Model mesh=""/></Scene>'
refuses '<Scene glint="1"><Model mesh="a.obj" scale="0"/></Scene>'
echo "$(wc -l <"$work/list") scenes, $seed generated"
