#!/bin/sh
# glint render --max-error keeps its bound: what it renders is compared with the reference at many samples.
# Usage: run_bounds.sh GLINT SOURCE_FOLDER WORK_FOLDER [whole | random SEED FIRST COUNT]
#   else: three small scenes against 64 samples. whole: 21 scenes, three bounds each, against 256 samples; some minutes.
#   random: scenes of tests/sweep, four bounds each, and what each search took: processor time, and that of its picture alone.
. "$(dirname -- "$0")/lib.sh"
export XDG_CACHE_HOME="$work/cache"
bounds='flip=0.1 flip=0.03 mae=0.004'
scenes_of=${4:-few}
if [ "$scenes_of" = random ]; then
    size=96x72 samples=256
    bounds='mae=0.004 rmse=0.012 psnr=38 flip=0.03'
    scenes=$("${glint%/*}/tests/write_sweep" . "$5" "$6" "$7")
elif [ "$scenes_of" = whole ]; then
    size=96x72 samples=256
    scenes='showcase tinyraytracer elements/background_color elements/background_image elements/camera elements/checker
        elements/image elements/include elements/lights elements/material_map elements/materials elements/models
        elements/rectangles elements/refraction elements/seen_lights elements/shadows elements/smooth elements/spheres elements/sunlight
        elements/trace elements/word'
else
    size=48x32 samples=64
    scenes='elements/spheres elements/trace elements/seen_lights'
fi

# timed COMMAND...: its status; what it took is in taken.txt.
timed() {
    TIMEFORMAT='%U %S' bash -c '{ time "$@" 2>&3; } 3>&2 2>taken.txt' bash "$@"
}
# The same picture without a search, and what that took; a line.
alone() {
    options=$(sed -n 's/^ *options //p' bound.err)
    search=$(awk '{ print $1 + $2 }' taken.txt)
    # shellcheck disable=SC2086 # words of their own
    timed "$glint" render "$1" -q --size "$size" $options -o alone.pfm 2>alone.err
    awk -v search="$search" '{ own = $1 + $2; printf "   %.2f s, %.2f s alone%s\n", search, own, (search > 3 * own + 2 ? ": LONG" : "") }' taken.txt
}

# bound SCENE BOUND: renders, compares, and prints a line; kept, or said that nothing fits.
bound() {
    metric=${2%%=*} most=${2#*=} side=max
    [ "$metric" != psnr ] || side=min
    rm -f bound.pfm
    timed "$glint" render "$1" --size "$size" --max-error "$2" -o bound.pfm 2>bound.err
    status=$?
    if [ $status = 1 ] && grep -q E807 bound.err && [ ! -e bound.pfm ]; then
        echo "$shown $2: nothing fits: $(sed -n 's/.*help: //p' bound.err), $(cat taken.txt) s"
        return 0
    fi
    "$glint" compare bound.pfm truth.pfm --space displayed "--$side-$metric" "$most" >compared.txt
    kept=$?
    echo "$shown $2: $(awk -v metric="$metric" '$1 == metric { print $2 }' compared.txt)"
    [ "$scenes_of" != random ] || alone "$1"
    [ $status = 0 ] && [ $kept = 0 ] && echo "$shown $2" >>kept.txt
}

if ! "$glint" render "$source/scenes/elements/minimal.glint.yaml" --size 8x8 -o probe.png -q 2>/dev/null; then
    echo "skip: no Vulkan device"
    exit $failed
fi
# Samples go on beyond those of the file, which are 64 or fewer.
sampled() {
    "$glint" render "$source/scenes/elements/lens.glint.yaml" --size 40x30 --max-error mae=0.004 -o lens.png 2>lens.err &&
        samples=$(sed -n 's/^ *options .*image\.samples=\([0-9]*\).*/\1/p' lens.err) && [ "${samples:-0}" -gt 64 ]
}
expect "samples go on until the bound is kept" 0 "" "" sampled

# A stone that sends on more light than it receives: longer paths would only add to it, and max_depth is a part
# of the picture.
amplified() {
    stone="$source/scenes/elements/refraction.glint.yaml"
    "$glint" render "$stone" -q --size 40x30 --max-error mae=0.006 -o stone.pfm &&
        "$glint" render "$stone" -q --size 40x30 --samples 128 --device reference --as-file -o stone-truth.pfm &&
        "$glint" compare stone.pfm stone-truth.pfm --space displayed --max-mae 0.006
}
expect "light that grows keeps a bound at its depth" 0 "" "" amplified

# Rays are counted apart, after the picture: by another kernel, which takes time of its own.
counted() {
    "$glint" render "$source/scenes/elements/spheres.glint.yaml" -q --size 20x16 -o plain.pfm &&
        "$glint" render "$source/scenes/elements/spheres.glint.yaml" -q --size 20x16 --stats=json --count-rays -o counted.pfm >stats.json &&
        cmp plain.pfm counted.pfm && grep -qE '"count_s": *[1-9e0.-]*[1-9]' stats.json
}
expect "rays are counted after the picture" 0 "" "" counted

: >kept.txt
count=0
for shown in $scenes; do
    scene="$source/scenes/$shown.glint.yaml"
    [ "$scenes_of" != random ] || scene=$shown
    "$glint" render "$scene" -q --size "$size" --device reference --samples "$samples" -o truth.pfm
    for b in $bounds; do
        count=$((count + 1))
        expect "$shown keeps $b" 0 "" "" bound "$scene" "$b"
        sed 's/^/     /' out.txt
    done
done
echo "$(wc -l <kept.txt) of $count bounds were kept by a picture; the others were said not to be"
# Most are, or the search would be of no use.
expect "most bounds are kept by a picture" 0 "" "" test "$(($(wc -l <kept.txt) * 4))" -ge $((count * 3))
exit $failed
