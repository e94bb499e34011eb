#!/bin/sh
# What is given and would be dropped is an error of the command line, not silence.
# Usage: run_losses.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
unset GLINT_DEVICE

printf 'glint: 1\nimage: {width: 8, height: 8}\nspheres: [{name: ball, center: [0, 0, 0], radius: 1}, {center: [3, 0, 0], radius: 2}]\n' >a.yaml

expect "a second output" 2 - "command-line:1:33: error: option '--output' is given twice" "$glint" tradeoff a.yaml -o a.html --output b.html
also "the first is shown" '' 'command-line:1:23: note: the first one is here'
expect "glued to its letter" 2 - "command-line:1:33: error: option '--output' is given twice" "$glint" tradeoff a.yaml -o a.html -ob.html
ok "neither is written" sh -c '! ls ./*.html'
expect "a picture named twice" 2 - "a.png" "$glint" render a.yaml -o a.png -o a.png
ok "which is not written" [ ! -e a.png ]
# Every option that takes one value, in the first command whose help lists it.
"$glint" --help | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p' >commands.txt
while read -r command; do
    "$glint" "$command" --help | sed -n 's/^  .*\(--[a-z-]*\) \([A-Z][^ ]*\)  *[^. ].*/\1 \2/p' | while read -r option value; do
        case $value in # any value of the right form
        N | S | MS | DB | X | NAME\|N) value=1 ;;
        WxH) value=8x8 ;;
        FILE) value=a.png ;;
        FOLDER | DIR) value=. ;;
        LEVEL) value=error ;;
        METRIC=X) value=flip=1 ;;
        KIND) value=clip ;;
        esac
        echo "$command $option $value"
    done
done <commands.txt | sort -u -k2,2 >single.txt
ok "there are many of them" [ "$(wc -l <single.txt)" -gt 40 ]
while read -r command option value; do
    "$glint" "$command" a.yaml "$option" "$value" "$option" "$value" >twice.txt 2>&1 </dev/null
    grep -q "option '$option' is given twice" twice.txt || echo "$command $option $value"
done <single.txt >silent.txt
expect "each of them once" 0 - - cat silent.txt
expect "options that add to each other" 0 - - "$glint" check a.yaml --asset-path . --asset-path . --ignore W401 --ignore W402 --only N401 --only N402
expect "a flag twice" 0 - - "$glint" check a.yaml -q -q
expect "of two values for one path the later one counts, as documented" 0 'radius: 3' - "$glint" inspect --ir a.yaml --set 'spheres[0].radius=2' --set 'spheres[0].radius=3'
expect "a limit twice" 2 - 'the limit messages is given twice' "$glint" check a.yaml --limit messages=1 --limit messages=2
expect "by its other name" 2 - '--max-messages is another word for it' "$glint" check a.yaml --limit messages=1 --max-messages 2
expect "a severity twice" 2 - "--severity: 'w401' is given twice" "$glint" check a.yaml --severity W401=off --severity w401=error
expect "a family, then one of it" 0 - - "$glint" check a.yaml --severity W4xx=off --severity W401=error

expect "notes that are asked for and refused" 2 - "'--verbose' would have no effect" "$glint" check a.yaml -q -v
expect "frames of the reference" 2 - "'--repeat' would have no effect" "$glint" render a.yaml --repeat 2 --device reference
expect "a cache that a device does not have" 2 - "'--no-cache' would have no effect" "$glint" render a.yaml --no-cache
cp "$source/tests/data/image/interlaced.png" p.png
expect "colours of no heat map" 2 - "'--heatmap-of' would have no effect" "$glint" compare p.png p.png --heatmap-of flip

for written in scene.pov scene scene.yaml.bak; do
    expect "convert to $written" 2 - "command-line:1:22: error: the output '$written' must end in .yaml, .yml, .json or .xml" "$glint" convert a.yaml $written
    ok "which is not written" [ ! -e $written ]
done
expect "convert to an ending in capitals" 0 - - "$glint" convert a.yaml A.XML
expect "convert to a device" 0 - '' "$glint" convert a.yaml /dev/null
for written in a.tar a.tar.gz a.7z a.RAR; do
    expect "pack into $written" 2 - 'an archive that glint cannot write' "$glint" pack a.yaml $written
    ok "which is not made" [ ! -e $written ]
done
exit $failed
