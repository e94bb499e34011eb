#!/bin/sh
# Films by ffmpeg itself: as many frames, as large and as fast as was said, in the colours of BT.709 within a step of 255.
# Usage: run_ffmpeg.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
export XDG_CACHE_HOME="$work/cache"
cat >scene.yaml <<'S'
glint: 1
image: {width: 64, height: 48, transfer: srgb}
camera: {position: [0, 0, 6]}
background: {color: "#cf5a26"}
lights: [{position: [-5, 8, 5]}]
spheres: [{name: ball, center: [0, 0, 0], radius: 0.2}]
animation: {frames: 12, rate: 24, tracks: {"spheres[ball].radius": 0.2 + frame/20}}
S
for program in ffmpeg ffprobe; do
    command -v $program >/dev/null || {
        echo "skip: $program is not installed"
        exit 77
    }
done
expect 'the scene' 0 '' - "$glint" check scene.yaml -q
"$glint" render scene.yaml --frame 0 -o still.png -q 2>/dev/null || {
    [ $failed -eq 0 ] || exit 1
    echo "skip: no Vulkan device"
    exit 77
}

# film FILE SIZE CODEC FORMAT Y U V: the upper left corner of its last frame is the background.
film() {
    expect "$1" 0 '' '' "$glint" render scene.yaml --frames all --size "$2" -o "$1" -q
    ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,nb_read_frames,avg_frame_rate,pix_fmt -of csv=p=0 "$1" >told.txt
    width=${2%x*} height=${2#*x}
    matches "^$3,$width,$height,$4,24/1,12\$" told.txt && pass "$1 is what was asked for" || fail "$1: $(cat told.txt)"
    [ $# -gt 4 ] || return
    ffmpeg -v error -nostdin -y -i "$1" -vf "select=eq(n\\,11)" -f rawvideo -pix_fmt "$4" raw
    chroma=$((width * height)) part=$((width * height))
    [ "$4" = yuv444p ] || part=$((width * height / 4))
    set -- "$1" "$5" "$6" "$7" "$(od -An -tu1 -j0 -N1 raw)" "$(od -An -tu1 -j$chroma -N1 raw)" "$(od -An -tu1 -j$((chroma + part)) -N1 raw)"
    echo "$2 $3 $4 $5 $6 $7" | awk '{ for (i = 1; i <= 3; i++) if (($i - $(i + 3)) ^ 2 > 1) exit 1 }' &&
        pass "$1 has the background's colour" || fail "$1: $5 $6 $7, and not $2 $3 $4"
}
# 207, 90, 38 of 255: y = 0.4358, Y = 16 + 219 y, U = 128 + 224 (0.1490 - y) / 1.8556, V = 128 + 224 (0.8118 - y) / 1.5748
film even.mp4 64x48 h264 yuv420p 111 93 181
film odd.mp4 65x49 h264 yuv444p 111 93 181
film even.webm 64x48 vp9 yuv420p 111 93 181
ffprobe -v error -show_entries stream=color_space,color_transfer,color_primaries,color_range -of csv=p=0 even.mp4 >told.txt
matches '^tv,bt709,bt709,bt709$' told.txt && pass 'it says which colours it has' || fail "colours: $(cat told.txt)"
expect 'a GIF' 0 '' '' "$glint" render scene.yaml --frames all -o film.gif -q
ffmpeg -v error -nostdin -y -i film.gif -vf "select=eq(n\\,11)" -f rawvideo -pix_fmt rgb24 raw
[ "$(od -An -tu1 -N3 raw | tr -s ' ')" = ' 207 90 38' ] && pass 'its palette has the background' || fail "GIF: $(od -An -tu1 -N3 raw)"
exit $failed
