#!/bin/sh
# glint render of many pictures: each has the bytes that a process of its own gives it, counters say that nothing is done
# twice, a failed one is told and the rest are there, films are whole or not there.
# Usage: run_batch.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
export XDG_CACHE_HOME="$work/cache"
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 1 4 2\n' >face.obj
cat >scene.yaml <<'S'
glint: 1
image: {width: 40, height: 30}
cameras: {front: {position: [0, 0, 6]}, side: {position: [5, 1, 3], look_at: [0, 0, 0]}}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}, red: {diffuse_color: "#ff2010"}}
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: blue}]
models: [{mesh: face.obj, translation: [0.9, 0, 0], material: red}]
S
sed 's/#1020ff/#10ff20/' scene.yaml >other.yaml

# What is wrong with the command line is said at its place, and nothing is rendered.
turn='cameras.front.position=[{6*sin(360*frame/8)}, 0.5, {6*cos(360*frame/8)}]'
tells 'frames that nothing moves' 2 'nothing depends on the frame' "$glint" render scene.yaml --frames 0..3 -o 'o.%d.png'
tells 'frames backwards' 2 'ends before it begins' "$glint" render scene.yaml --frames 3..0
tells 'no frames' 2 'A\.\.B:STEP' "$glint" render scene.yaml --frames 1..x
tells 'an unknown function' 2 'set:1:25: error: there is no function' "$glint" render scene.yaml --frames 0..3 \
    --set 'cameras.front.fov={30+1+wave(frame)}'
tells 'a parenthesis' 2 "'\\)' is missing" "$glint" render scene.yaml --frames 0..3 --set 'cameras.front.fov={sin(frame}'
tells 'one name' 2 'more than one of them' "$glint" render scene.yaml --frames 0..3 --set "$turn" -o out.png
tells 'an unknown word in a name' 2 'no word that is known' "$glint" render scene.yaml --frames 0..3 --set "$turn" -o 'o.%x.png'
tells 'a sweep of nothing' 2 'sweep takes PATH' "$glint" render scene.yaml --sweep materials.blue
tells 'a count of rays' 2 'would have no effect' "$glint" render scene.yaml other.yaml --stats --count-rays
tells 'an audit' 2 'would have no effect' "$glint" render scene.yaml other.yaml --audit
tells 'the reference' 2 'not by the reference' "$glint" render scene.yaml other.yaml --device reference
tells 'a list that is not there' 3 'none.txt:1:1: error: cannot be read' "$glint" render --list none.txt
tells 'a film without frames' 2 'say which frames' "$glint" render scene.yaml -o film.mp4
tells 'no scene' 2 'needs SCENE' "$glint" render
[ -z "$(find . -name '*.png')" ] && pass 'nothing was rendered' || fail 'something was rendered'

if ! "$glint" render scene.yaml -o probe.pfm -q 2>/dev/null; then
    [ $failed -eq 0 ] || exit 1
    echo "skip: no Vulkan device: of many pictures only what is refused"
    exit 77
fi

# count KEY: of the report in stats.json.
count() { sed -n "s/.*\"$1\": \([0-9]*\).*/\1/p" stats.json; }
counts() {
    name=$1
    shift
    for pair in "$@"; do
        [ "$(count "${pair%=*}")" = "${pair#*=}" ] || { fail "$name: $(cat stats.json), wanted $pair"; return; }
    done
    pass "$name"
}

# ---- frames
"$glint" render scene.yaml --frames 0..8:4 --set "$turn" -o 'f.%03d.pfm' --stats=json -q >stats.json 2>err.txt || fail "frames: $(cat err.txt)"
for frame in 0 4; do
    z=$([ $frame -eq 0 ] && echo 6 || echo -6)
    x=$([ $frame -eq 0 ] && echo 0 || echo 7.347880794884119e-16)
    "$glint" render scene.yaml --set "cameras.front.position=[$x, 0.5, $z]" -o one.pfm -q
    same "frame $frame is the picture of a process of its own" one.pfm f.00$frame.pfm
done
cmp -s f.000.pfm f.004.pfm && fail 'frames differ' || pass 'frames differ'
counts 'nothing is read twice' pictures=3 written=3 failed=0 loads=3 meshes_read=1
"$glint" render scene.yaml --frames 8 --set "$turn" -o alone.pfm -q
same 'a frame alone has the same bytes' alone.pfm f.008.pfm

# ---- a sweep of settings: no tree again, no kernel again
"$glint" render scene.yaml --sweep 'materials.blue.diffuse_color=[1, 0, 0],[0, 1, 0]' --sweep cameras.front.fov=40:60:3 --set trace.precision=single \
    -o 'g.%d.pfm' --stats=json -q >stats.json || fail 'a grid'
cp stats.json grid.json
"$glint" render scene.yaml --sweep cameras.front.fov=40,60 --set trace.precision=single -o 'two.%d.pfm' --stats=json -q >stats.json
kernels=$(count pipelines_made)
cp grid.json stats.json
counts 'a grid compiles what two pictures compile' pictures=6 written=6 meshes_read=1 pipelines_made="$kernels"
[ "$(count trees_built)" -le 2 ] && [ "$(count trees_kept)" -ge 5 ] && pass 'and builds its trees once' || fail "trees: $(cat stats.json)"
"$glint" render scene.yaml --set trace.precision=single --set 'materials.blue.diffuse_color=[0, 1, 0]' --set cameras.front.fov=50 -o one.pfm -q
same 'the last sweep changes fastest' one.pfm g.4.pfm
expect 'a sheet' 0 '' 'wrote sheet.pfm, 6 pictures in rows of 3' "$glint" render scene.yaml --sweep 'materials.blue.diffuse_color=[1, 0, 0],[0, 1, 0]' \
    --sweep cameras.front.fov=40:60:3 --set trace.precision=single --montage -o sheet.pfm
head -2 sheet.pfm | tail -1 | grep -q '^120 60$' && pass 'of its size' || fail 'the size of the sheet'
# The lowest row of a PFM comes first: the first picture's is in the middle of the file.
tail -c +$((1 + $(head -3 sheet.pfm | wc -c) + 30 * 120 * 12)) sheet.pfm | head -c 480 >a.bin
tail -c +$((1 + $(head -3 g.0.pfm | wc -c))) g.0.pfm | head -c 480 >b.bin
same 'and the first picture in its corner' a.bin b.bin

# ---- scenes and cameras
printf '# a comment\nscene.yaml\n\nother.yaml\n' >list.txt
ok 'a list, all cameras' "$glint" render --list list.txt --camera all -o '%s.%c.pfm' -q
for camera in front side; do
    "$glint" render other.yaml --camera $camera -o one.pfm -q
    same "other through $camera" one.pfm other.$camera.pfm
done
[ -f scene.side.pfm ] && pass 'four pictures' || fail 'four pictures'

# ---- what fails
expect 'a scene that is not there' 3 '' 'failed: none.yaml' "$glint" render scene.yaml none.yaml other.yaml -o 'k.%d.png'
also 'is counted' '' '1 of 3 pictures failed$'
[ -f k.0.png ] && [ ! -e k.1.png ] && [ -f k.2.png ] && pass 'the rest are there' || fail 'the rest are there'
expect 'or ends it' 3 '' '1 were not begun' "$glint" render scene.yaml none.yaml other.yaml -o 'l.%d.png' --keep-going=no
[ -f l.0.png ] && [ ! -e l.2.png ] && pass 'nothing after it' || fail 'nothing after it'
expect 'an impossible frame' 1 '' 'failed: scene.yaml, frame 2' "$glint" render scene.yaml --frames 0..2 --set 'cameras.front.fov={60+60*frame}' -o 'm.%d.png'
[ -f m.1.png ] && [ ! -e m.2.png ] && pass 'leaves the others' || fail 'leaves the others'

mkdir folder.1.png
expect 'a name at which there is a folder' 5 '' 'folder.1.png:1:1: error: is not written: it is not a regular file' "$glint" render scene.yaml other.yaml scene.yaml -o 'folder.%d.png'
[ ! -e folder.0.png ] && pass 'is known before anything is rendered' || fail 'is known before anything is rendered'

# ---- films
ok 'a film' "$glint" render scene.yaml --frames 0..3 --set "$turn" -o film.y4m --fps 12.5 -q
[ "$(head -1 film.y4m)" = 'YUV4MPEG2 W40 H30 F125:10 Ip A1:1 C444 XCOLORRANGE=LIMITED' ] && pass 'its head' || fail "its head: $(head -1 film.y4m)"
[ "$(wc -c <film.y4m)" -eq $(($(head -1 film.y4m | wc -c) + 4 * (6 + 3 * 40 * 30))) ] && pass 'its size' || fail 'its size'
"$glint" render scene.yaml --frames 0..3 --set "$turn" -o - --fps 12.5 -q >pipe.y4m
same 'on standard output' pipe.y4m film.y4m
"$glint" render scene.yaml --set background.color='"#ff0000"' --set 'spheres=' --set 'models=' --frames 0 -o red.y4m -q
[ "$(tail -c +$((1 + $(head -1 red.y4m | wc -c) + 6)) red.y4m | od -An -tu1 -N1 | tr -d ' ')" = 63 ] &&
    [ "$(tail -c 1 red.y4m | od -An -tu1 | tr -d ' ')" = 240 ] && pass 'red in the limited range of BT.709' || fail 'red'
cp film.y4m before.y4m
tells 'a film with a frame that fails' 1 '1 of 3 pictures failed' "$glint" render scene.yaml --frames 0..2 --set 'cameras.front.fov={60+60*frame}' -o film.y4m
same 'leaves the old film' film.y4m before.y4m

# ffmpeg by a program of its name: what it is told, and what becomes of what it says.
mkdir bin empty
cat >bin/ffmpeg <<'S'
#!/bin/sh
printf '%s\n' "$@" >"$SAW"
for out; do :; done
[ -z "${BROKEN-}" ] || { echo 'line one' >&2; echo "Unknown encoder 'libx264'" >&2; exit 1; }
exec cat >"$out"
S
chmod +x bin/ffmpeg
export SAW="$work/saw.txt"
tells 'without ffmpeg' 3 'apt-get install ffmpeg' env PATH="$work/empty" "$glint" render scene.yaml --frames 0..3 --set "$turn" -o film.mp4
ok 'with it' env PATH="$work/bin:$PATH" "$glint" render scene.yaml --frames 0..3 --set "$turn" -o film.mp4 -q
[ "$(wc -c <film.mp4)" -eq $((4 * 3 * 40 * 30)) ] && grep -q '^40x30$' saw.txt && pass 'it gets all frames' || fail "it gets $(wc -c <film.mp4)"
cp film.mp4 before.mp4
tells 'what it says is told' 3 "Unknown encoder 'libx264'" env BROKEN=1 PATH="$work/bin:$PATH" "$glint" render scene.yaml --frames 0..3 --set "$turn" -o film.mp4
same 'and the old film stays' film.mp4 before.mp4
[ "$(find . -name 'film.glint*' | wc -l)" -eq 0 ] && pass 'nothing temporary is left' || fail 'temporary files'
exit $failed
