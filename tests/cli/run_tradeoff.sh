#!/bin/sh
# glint tradeoff, and the settings that it chooses, as a user sees them.
# Usage: run_tradeoff.sh GLINT SOURCE_FOLDER WORK_FOLDER [whole|same]
#   else: studies that a small budget cuts short. whole: whole ones, and what they promise. same: the showcase's
#   choice in 10 of 10 runs.
. "$(dirname -- "$0")/lib.sh"
mode=${4:-}
export XDG_CACHE_HOME="$work/cache"

cat >small.yaml <<'S'
glint: 1
image: {width: 24, height: 16}
trace: {max_depth: 6}
camera: {position: [0, 1, 6], look_at: [0, 0.6, 0], fov: 40}
background: {color: [0.3, 0.5, 0.8]}
lights:
  - {position: [-5, 8, 5]}
materials:
  glass: {albedo: [0, 0.5, 0.2, 0.7], refractive_index: 1.5}
spheres:
  - {center: [-0.7, 0.7, 0], radius: 0.7, material: glass}
  - {center: [0.9, 0.6, -0.5], radius: 0.6, material: {albedo: [0.4, 0.4, 0.6, 0]}}
rectangles:
  - {corner: [-4, 0, -4], edge_u: [8, 0, 0], edge_v: [0, 0, 7], material: {diffuse_color: {checker: {colors: [0.8, 0.2]}}}}
S
expect "no such metric" 2 - "did you mean 'flip'" "$glint" tradeoff small.yaml --max-error flp=1
expect "a metric without a value" 2 - 'such as mae=0\.01' "$glint" tradeoff small.yaml --max-error mae
expect "a negative error" 2 - 'such as mae=0\.01, not .mae=-1' "$glint" tradeoff small.yaml --max-error mae=-1
expect "a report of another kind" 2 - 'must end in \.html' "$glint" tradeoff small.yaml -o report.pdf
expect "a bad budget" 2 - 'budget takes a number' "$glint" tradeoff small.yaml --budget 0
expect "the reference is no device to study" 2 - 'choose a device' "$glint" tradeoff small.yaml --device reference
expect "a scene with errors" 1 - 'E206' "$glint" tradeoff small.yaml --set spheres[0].radius=-1
if ! "$glint" render small.yaml -o probe.png -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit $failed
fi

# Told before the study, which would take longer than this.
expect "a report that cannot be written" 3 - 'E802' within 20 "$glint" tradeoff "$source/scenes/showcase.glint.yaml" -o nowhere/r.html
expect "a picture that cannot be written" 3 - 'E802' within 20 "$glint" render "$source/scenes/showcase.glint.yaml" --max-error flip=0.1 -o nowhere/r.png

if [ -z "$mode" ]; then
    expect "a study cut short" 0 'the budget cut the study short' - "$glint" tradeoff small.yaml -q --budget 1 -o report.html
    cp out.txt study.txt
    expect "its file's own row" 0 '^  0 .*as the file says' - cat study.txt
    expect "the report is one file" 0 '<svg.*time against error' - cat report.html
    # The reference's share of the budget grows with the processors.
    expect "a truth cut short, whatever the depth of the file" 0 'allowed the reference only [0-9]+ rays per sample; those' - \
        "$glint" tradeoff small.yaml -q --budget 1 --size 80x60 --samples $((8 * $(nproc))) --set trace.max_depth=0
    # What light does: the little budget leaves only the first rows; the whole studies have all.
    expect "a file whose pixels end by their error" 0 '^  0 .*as the file says' - "$glint" tradeoff small.yaml -q --budget 1 \
        --set image.error=0.05 --set image.min_samples=4 --samples 16
    expect "a search says how many samples there are" 0 - 'image.error=0' "$glint" render small.yaml --max-error flip=0.5 \
        --set image.error=0.02 --set image.samples=64 --size 20x15 -o chosen.png
    expect "and its choice has no finding" 1 - - grep -q W429 err.txt
    expect "both bounds" 0 '^cheapest that fits both' - \
        "$glint" tradeoff small.yaml -q --budget 1 --max-error flip=0.9 --max-time 100000
    expect "nothing fits" 1 '"misses_by"' - "$glint" tradeoff small.yaml -q --max-error mae=0 --budget 1 --format json
    printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\377\377\377\377' >sky.hdr
    printf 'glint: 1\nimage: {width: 16, height: 16}\ncamera: {}\nbackground: {image: sky.hdr, intensity: 4}\n' >endless.yaml
    expect "no picture of numbers fits" 1 '"nearest": null,' - "$glint" tradeoff endless.yaml -q --max-error mae=1 --budget 1 --format json
    expect "render says so too" 1 - 'E807' "$glint" render small.yaml -q --max-time 0.000001 --budget 1 -o none.png
    expect "and writes nothing" 1 - - test -e none.png
    expect "render by an error" 0 - 'chosen: row' "$glint" render small.yaml --size 40x30 --max-error flip=0.5 -o chosen.png
    also "its picture has the size asked for" - 'wrote chosen\.png, 40 x 30'
    mv chosen.png first.png
    expect "again: nothing is measured" 0 - 'found by an earlier call' \
        "$glint" render small.yaml --size 40x30 --max-error flip=0.5 -o chosen.png
    expect "and the picture is the same" 0 - - cmp first.png chosen.png
    expect "another bound is another search" 0 - 'flip at most 0\.4' "$glint" render small.yaml --size 40x30 --max-error flip=0.4 -o chosen.png
    also "it is measured" - 'settings tried on [^;]*; [0-9.]+ s'
    for entry in cache/glint/studies/*.study; do
        printf X | dd of="$entry" bs=1 seek=300 conv=notrunc 2>dd.txt
    done
    expect "a damaged entry does not matter" 0 - 'settings tried on [^;]*; [0-9.]+ s' \
        "$glint" render small.yaml --size 40x30 --max-error flip=0.5 -o chosen.png
    # Which settings are the cheapest that fit, another search may see otherwise: it measures times.
    also "and another search makes a picture" - 'wrote chosen\.png, 40 x 30'
    for entry in cache/glint/studies/*.study; do : >"$entry"; done
    expect "an empty one neither" 0 - 'settings tried on [^;]*; [0-9.]+ s' \
        "$glint" render small.yaml --size 40x30 --max-error flip=0.5 -o chosen.png
    expect "without a cache nothing is found" 0 - 'settings tried on [^;]*; [0-9.]+ s' \
        "$glint" render small.yaml --no-cache --size 40x30 --max-error flip=0.5 -o chosen.png
    expect "a smaller picture, where it may be" 0 - 'scaled up, as --allow-resolution allows' \
        "$glint" render small.yaml --size 40x30 --max-error flip=0.7 --allow-resolution -o chosen.png
    also "of the size asked for" - 'wrote chosen\.png, 40 x 30'
    expect "--allow-resolution alone" 2 - 'for settings that --max-error or --max-time' "$glint" render small.yaml --allow-resolution
    expect "by a time" 0 - 'best flip within 10000 ms' "$glint" render small.yaml --size 40x30 --max-time 10000 -o chosen.png

    expect "in time: the samples that it has are told" 0 - 'one sample, the least' "$glint" render small.yaml --samples 9 --time 0.001 -o timed.png
    also "one is made" - 'time 0\.001 allowed 1 of 9 samples'
    expect "the same as one sample" 0 - - "$glint" render small.yaml --samples 1 -q -o one.png
    expect "byte for byte" 0 - - cmp one.png timed.png
    expect "with time enough there is nothing to tell" 0 - '^glint: wrote [^:]*$' "$glint" render small.yaml --samples 3 --time 1000 -o timed.png
    expect "all samples" 0 - - "$glint" render small.yaml --samples 3 -q -o three.png
    expect "are there" 0 - - cmp three.png timed.png
    expect "in time, with an audit" 0 - 'traced again' "$glint" render small.yaml --samples 2 --time 1000 --audit -o timed.png
    expect "--time and --repeat" 2 - 'works for one frame on a device' "$glint" render small.yaml --time 1 --repeat 2
    expect "--time of 0" 2 - 'number from 0\.001' "$glint" render small.yaml --time 0
    exit $failed
fi

if [ "$mode" = same ]; then
    scene="$source/scenes/showcase.glint.yaml"
    for run in 1 2 3 4 5 6 7 8 9 10; do
        choice=$("$glint" tradeoff "$scene" -q --size 64x48 --max-error flip=0.08 --budget 1000 --format json | tr -d '\n' |
            sed 's/.*"cheapest": {[^}]*"options": "\([^"]*\)".*/\1/')
        echo "run $run: $choice"
        echo "$choice" >>choices.txt
    done
    sort choices.txt | uniq -c >counted.txt
    expect "the same choice in 10 of 10 runs" 0 '^ *10 --set ' - cat counted.txt
    exit $failed
fi

# column NAME FILE: the number of a column of the CSV.
column() {
    head -n 1 "$2" | tr ',' '\n' | grep -nx -- "$1" | cut -d: -f1
}

# falls PREFIX COLUMN FILE: along the rows whose setting is PREFIX and a number, and the file's own behind them.
falls() {
    awk -F, -v prefix="\"$1 [0-9.e-]*\"$" -v column="$(column "$2" "$3")" '
        NR > 1 && $2 ~ "^" prefix {
            if (count++ && $column > last * 1.0000001) { print $2, "rises from", last, "to", $column; bad = 1 }
            last = $column
        }
        END { exit bad || count < 3 }' "$3"
}

cp small.yaml whole.yaml
echo 'ambient: {color: 0.2, occlusion: 3}' >>whole.yaml
expect "a study as CSV, and its report" 0 '^0,"as the file says",1' - \
    "$glint" tradeoff whole.yaml -q --budget 1000 --format csv -o report.html
cp out.txt study.csv
expect "the report is one file" 0 '<svg.*time against error' - cat report.html
expect "with pictures inside" 0 'src="data:image/png;base64,iVBOR' - cat report.html
expect "that names nothing outside itself" 1 - - grep -qE '(src|href)="?http' report.html
for row in 'max_depth 0' 'min_weight 0\.1' 'samples 4' 'shadows off' '12 x 8' 'general shader' \
    'study: offset 1e-3' 'study: offset by distance' 'study: moeller-trumbore'; do
    expect "a row of $row" 0 "^[0-9]+,\"$row\"" - cat study.csv
done
for row in 'occlusion off",1' 'error 0\.02 by 4 to 8 samples",1'; do
    expect "a row of $row" 0 "^[0-9]+,\"$row" - cat study.csv
done
expect "none of what the scene does not have" 1 - - grep -qE '"[^"]*(transparent|extent|pinhole|roughness|filter)' study.csv
expect "some of the front end pixels by their error" 0 '^[0-9]+,"error [^"]*",1,1' - cat study.csv
# The reference knows how many samples each pixel took.
expect "the numeric part of these is rounding" 0 - - awk -F, -v n="$(column numeric study.csv)" '
    $2 ~ /^"error/ { rows++; if ($n > 0.0005) { print $2, $n; bad = 1 } }
    END { exit bad || rows < 5 }' study.csv
# Lights that rays see: the 33rd feature.
expect "a study of lights that are seen" 0 "" - "$glint" tradeoff "$source/scenes/elements/seen_lights.glint.yaml" -q \
    --size 12x8 --samples 2 --budget 1000 --format csv -o seen.html
cp out.txt seen.csv
expect "a study has every feature of its scene" 0 - - awk -F, -v n="$(column numeric seen.csv)" '
    $2 == "\"as the file says\"" { good = $n < 0.0005 }
    END { exit !good }' seen.csv
expect "what is left out is truncated" 0 - - awk -F, -v n="$(column truncation study.csv)" '
    $2 == "\"as the file says\"" { own = $n }
    $2 == "\"occlusion off\"" && $n > 10 * own { good = 1 }
    END { exit !good }' study.csv

expect "pairs" 0 '^[0-9]+,"[a-z_]+ [0-9.]+, ' - cat study.csv
expect "what is truncated falls along max_depth" 0 - - falls max_depth truncation study.csv
expect "and along min_weight" 0 - - falls min_weight truncation study.csv
expect "numeric errors fall along precision" 0 - - awk -F, -v n="$(column numeric study.csv)" '
    $2 == "\"as the file says\"" { single = $n }
    $2 == "\"precision double\"" && $n > single { exit 1 }' study.csv
expect "studies are never chosen" 1 - - grep -qE '"study[^"]*",1' study.csv

expect "nothing fits" 1 'it misses by .* flip' - "$glint" tradeoff small.yaml -q --max-error flip=1e-9 --budget 4
expect "render says so too" 1 - 'E807' "$glint" render small.yaml --max-time 0.000001 --budget 4 -o none.png
expect "and writes nothing" 1 - - test -e none.png

# The chosen settings, rendered again from the file, keep the bound.
expect "the cheapest that errs by 0.1" 0 '"runner_up": [0-9]+' - \
    "$glint" tradeoff small.yaml -q --budget 40 --max-error flip=0.1 --set image.samples=2 --format json
options=$(sed -n 's/.*"options": "\([^"]*\)".*/\1/p' out.txt)
samples=$(sed -n 's/.*"truth_samples": \([0-9]*\).*/\1/p' out.txt)
if ! echo "$options" | grep -q width; then
    "$glint" render small.yaml -q --device reference --samples "$samples" -o truth.pfm
    # shellcheck disable=SC2086
    "$glint" render small.yaml -q --set image.samples=2 $options -o again.pfm
    expect "the choice keeps the bound: $options" 0 'at most 0\.1: passed' - \
        "$glint" compare again.pfm truth.pfm --space displayed --max-flip 0.1
fi
expect "render by an error" 0 - 'chosen: row' "$glint" render small.yaml --max-error flip=0.2 --budget 20 -o chosen.png
expect "its picture" 0 PNG '' head -c 4 chosen.png

exit $failed
