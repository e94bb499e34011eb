#!/bin/sh
# glint compare as a user sees it.
# Usage: run_compare.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"

# 2 x 1: 0.5 grey and 1 grey; the same with 0.25 in place of 0.5; one with a NaN; a larger one.
half='\000\000\000\077' one='\000\000\200\077' quarter='\000\000\200\076' nan='\000\000\300\177'
# shellcheck disable=SC2059
{
    printf "PF\n2 1\n-1\n$half$half$half$one$one$one" >half.pfm
    printf "PF\n2 1\n-1\n$quarter$quarter$quarter$one$one$one" >quarter.pfm
    printf "PF\n2 1\n-1\n$nan$half$half$one$one$one" >nan.pfm
    printf "Pf\n1 3\n-1\n$half$half$one" >tall.pfm
    printf "PF\n2 1\n-1\n$half$half$half$one$one" >short.pfm
}

expect "equal pictures" 0 '^  psnr +infinite' - "$glint" compare half.pfm half.pfm --max-largest 0 --min-ssim 1
expect "their FLIP" 0 '^  flip +0 ' - "$glint" compare half.pfm half.pfm
expect "closed forms" 0 '^  mae +0\.125 ' - "$glint" compare half.pfm quarter.pfm
expect "the place" 0 'largest difference is at 0,0 in red: 0\.5 against 0\.25' - "$glint" compare half.pfm quarter.pfm
expect "a share" 0 '^1 of 2 pixels differ by more than 0\.00392157' - "$glint" compare half.pfm quarter.pfm
expect "a threshold" 0 '^0 of 2 pixels differ by more than 0\.3' - "$glint" compare half.pfm quarter.pfm --threshold 0.3
expect "linear" 0 'compared as linear values' - "$glint" compare half.pfm quarter.pfm
expect "displayed" 0 '^  mae +0\.0991' - "$glint" compare half.pfm quarter.pfm --space displayed --transfer srgb
expect "a bound kept" 0 'at most 0\.125: passed' - "$glint" compare half.pfm quarter.pfm --max-mae 0.125
expect "a bound not kept" 1 'at most 0\.12: FAILED' - "$glint" compare half.pfm quarter.pfm --max-mae 0.12
expect "a lower bound not kept" 1 'at least 40: FAILED' - "$glint" compare half.pfm quarter.pfm --min-psnr 40
expect "one of several" 1 '"bounds_kept": false' - "$glint" compare half.pfm quarter.pfm --max-mae 0.5 --max-flip 0 --format json
expect "JSON" 0 '"rmse": \{"value": 0\.1767766' - "$glint" compare half.pfm quarter.pfm --format json
expect "not a number is told" 0 '^1 pixels are infinite or not a number' - "$glint" compare nan.pfm half.pfm
expect "not a number keeps no bound" 1 'FAILED' - "$glint" compare nan.pfm half.pfm --max-mae 1
expect "unless it may" 0 '' - "$glint" compare nan.pfm half.pfm --max-mae 1 --max-not-finite 1
expect "heat map" 0 'mae' - "$glint" compare half.pfm quarter.pfm --heatmap map.png
expect "heat map is a PNG" 0 PNG '' head -c 4 map.png
expect "heat map of FLIP" 0 'mae' - "$glint" compare half.pfm quarter.pfm --heatmap flip.png --heatmap-of flip
expect "8-bit pictures" 0 'compared as displayed values' - "$glint" compare map.png flip.png
expect "mixed kinds" 0 'compared as displayed values' - "$glint" compare map.png half.pfm
printf '%s\n' 'glint: 1' 'image: {width: 8, height: 8, transfer: srgb}' 'camera: {position: [0, 0, 0]}' \
    'background: {color: [0.2, 0.4, 0.8]}' >sky.yaml
for kind in png pfm; do
    "$glint" render sky.yaml -o sky.$kind --device reference --no-cache -q || failed=1
done
expect "another display is named" 0 'mae' "closer with '--tone clip --transfer srgb': mae 0\.00" "$glint" compare sky.png sky.pfm
expect "but not where it was said" 0 'mae +0\.00' - "$glint" compare sky.png sky.pfm --transfer srgb
expect "no linear values in 8 bits" 2 - 'command-line:.*an 8-bit picture has only displayed values' "$glint" compare map.png half.pfm --space linear
expect "sizes" 2 - 'command-line:1:24: error: the pictures differ in size: 2 x 1 and 1 x 3 pixels' "$glint" compare half.pfm tall.pfm
expect "a missing picture" 3 - '^none\.png:1:1: error: .*E601' "$glint" compare half.pfm none.png
expect "a cut picture" 3 - '^short\.pfm:1:1: error: the file ends before its last pixel \[E620\]' "$glint" compare short.pfm half.pfm
echo text >text.png
expect "no picture" 3 - '^text\.png:1:1: error: .*E621' "$glint" compare half.pfm text.png
expect "a folder" 3 - 'E603' "$glint" compare half.pfm .
expect "too many pixels" 3 - 'image-memory' "$glint" compare half.pfm half.pfm --limit image-memory=1
expect "one picture" 2 - 'needs PICTURE REFERENCE' "$glint" compare half.pfm
expect "a bad bound" 2 - 'max-mae takes a number of at least 0' "$glint" compare half.pfm half.pfm --max-mae -1
expect "a bad word" 2 - "space takes auto, displayed or linear, not 'log'" "$glint" compare half.pfm half.pfm --space log
expect "a bad format" 2 - 'it takes one of: text, json' "$glint" compare half.pfm half.pfm --format html
expect "a heat map of another kind" 2 - 'must end in \.png' "$glint" compare half.pfm half.pfm --heatmap map.jpg
expect "a heat map that cannot be written" 3 - 'E802' "$glint" compare half.pfm half.pfm --heatmap nowhere/map.png
exit $failed
