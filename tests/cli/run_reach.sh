#!/bin/sh
# Files that reach out of their folder: whatever a repository, a list of references, a record, a scene or a cache names,
# nothing outside is read, shown or written. The same with --untrusted, and by strace, where that is installed.
# Usage: run_reach.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/lib.sh"
export XDG_CACHE_HOME="$work/cache" GLINT_DEVICE=reference

secret='root:x:0:0 OPEN-SESAME'
# Nothing is quoted, and nothing outside is another than it was.
outside() {
    if grep -q OPEN-SESAME out.txt err.txt || [ "$(cat home/secret)" != "$secret" ] || [ "$(cat home/evil.png)" != precious ] ||
        [ "$(ls home)" != "evil.png
secret" ]; then
        fail "$1: something outside was read or written: $(ls home)"
        sed 's/^/     err: /' err.txt
    fi
}
mkdir -p home repo/pictures
# The work folder is itself in a work tree: the repository is one of its own.
git init -q repo 2>git.txt || mkdir repo/.git
echo "$secret" >home/secret
echo precious >home/evil.png
cat >repo/hall.glint.yaml <<'S'
glint: 1
image: {width: 24, height: 16}
cameras: {front: {position: [0, 0, 4]}}
lights: [{position: [-5, 8, 5]}]
background: {color: [0.3, 0.5, 0.8]}
spheres: [{center: [0, 0, 0], radius: 1}]
S
ln -s ../home repo/link
ln -s ../home/new.png repo/nowhere.png
ln -s ../home/evil.png repo/there.png
ln -s ../../home/new.png repo/pictures/hall.png
mkfifo repo/pipe.png

# What a list of references names. A status of 5 is a refusal.
n=0
while IFS= read -r list; do
    n=$((n + 1))
    printf '%s\n' "$list" | sed "s|@|$work|" >repo/glint-test.yaml
    expect "test: $list" 5 '' 'E602|E603|E802' within 20 "$glint" test repo
    outside "test: $list"
    expect "test --bless: $list" 5 '' 'E602|E603|E802' within 20 "$glint" test repo --bless --only a
    outside "test --bless: $list"
done <<'S'
tests: {@/home/evil.png: {scene: hall.glint.yaml}}
tests: {"../home/a.png": {scene: hall.glint.yaml}}
tests: {"link/a.png": {scene: hall.glint.yaml}}
tests: {"no/../../home/a.png": {scene: hall.glint.yaml}}
pictures: ../home
pictures: link
pictures: @/home
pictures: ../../../../../../../../etc
tests: {a.png: {scene: @/home/secret}}
tests: {a.png: {scene: ../home/secret}}
tests: {a.png: {scene: link/secret}}
tests: {a.png: {scene: /etc/passwd}}
S
[ "$n" -eq 12 ] || fail "the lists were not all tried: $n"
for picture in nowhere there pipe; do
    printf 'tests: {%s.png: {scene: hall.glint.yaml}}\n' "$picture" >repo/glint-test.yaml
    for force in '' --force; do
        expect "a link or a pipe is not written over: $picture $force" 5 '' 'is not written|E602' \
            within 20 "$glint" test repo --bless --only "$picture" $force
        outside "$picture $force"
    done
done
rm -f repo/glint-test.yaml
expect "nor one that has a scene's name" 5 '' 'is not written' within 20 "$glint" test repo --bless
outside "a link that has a scene's name"
rm repo/pictures/hall.png
ln -s ../../home/secret repo/glint-test.yaml
ln -sf ../home/secret repo/glint-test.yaml
expect "the list itself is a link" 5 '' 'E602' "$glint" test repo
outside "the list itself is a link"
rm repo/glint-test.yaml

# What is not a picture is replaced by --force only; a damaged picture is one.
echo 'my notes' >repo/notes.png
printf 'tests: {notes.png: {scene: hall.glint.yaml}, new/dir/a.png: {scene: hall.glint.yaml}}\n' >repo/glint-test.yaml
expect "text is kept" 5 '' 'what is there is not a picture' "$glint" test repo --bless --only notes
[ "$(cat repo/notes.png)" = 'my notes' ] && pass "as it was" || fail "the notes are gone"
expect "and replaced on request" 0 '^wrote' - "$glint" test repo --bless --force --only notes
head -c 60 repo/notes.png >cut.png && cp cut.png repo/notes.png
expect "a damaged picture is replaced" 0 '^wrote' - "$glint" test repo --bless --only notes
expect "folders below are made" 0 '^wrote .*new/dir/a.png' - "$glint" test repo --bless --only new/dir/a
rm repo/glint-test.yaml

# What a record names. PNG: the text of a chunk is exchanged, and its checksum with it.
mkdir -p shots other
cp repo/hall.glint.yaml shots/s.yaml
cp repo/hall.glint.yaml other/s.yaml
"$glint" render shots/s.yaml -q -o shots/good.png
cat >record.py <<'P'
import struct, sys, zlib
source, target, old, new = sys.argv[1:]
data, out, at = open(source, 'rb').read(), b'', 8
while at < len(data):
    size, = struct.unpack('>I', data[at:at + 4])
    kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
    if kind in (b'tEXt', b'iTXt'):
        body = body.replace(old.encode(), new.encode())
    out += struct.pack('>I', len(body)) + kind + body + struct.pack('>I', zlib.crc32(kind + body))
    at += 12 + size
open(target, 'wb').write(data[:8] + out)
P
expect "a record of the folder" 0 'verified' - "$glint" verify shots/good.png
if command -v python3 >python.txt; then
    echo 'v 0 0 0 OPEN-SESAME' >other/m.obj
    ln -s ../home/secret shots/link.yaml
    ln -s ../home shots/away
    for scene in "$work/home/secret" /etc/passwd home/secret shots/../home/secret shots/link.yaml shots/away/secret other/s.yaml other/m.obj; do
        python3 record.py shots/good.png shots/bad.png shots/s.yaml "$scene"
        expect "a record names $scene" 5 - 'E602' "$glint" verify shots/bad.png
        outside "a record names $scene"
    done
    python3 record.py shots/good.png shots/bad.png shots/s.yaml other/s.yaml
    expect "trusted, it is read" 0 'verified' '' "$glint" verify shots/bad.png --trust-record
    expect "named by the user, too" 0 'verified' '' "$glint" verify shots/bad.png other/s.yaml
    for folder in /etc home shots/away; do
        python3 record.py shots/good.png shots/bad.png ' --size' " --asset-path $folder --size"
        expect "a record allows $folder" 5 - 'E602' "$glint" verify shots/bad.png
        expect "also beside a scene of the user's" 5 - 'E602' "$glint" verify shots/bad.png shots/s.yaml
    done
    python3 record.py shots/good.png shots/bad.png ' --size' " --set background.image=$work/home/secret --size"
    expect "a record sets a path" 1 - 'E602' "$glint" verify shots/bad.png
    outside "a record sets a path"
else
    echo "skip what records name: python3 is not installed"
fi

# What has the name of a cache's entry: the renders end, and what a link leads to stays.
rm -rf cache
"$glint" render shots/s.yaml -q -o one.png
find cache -type f >entries.txt
[ -s entries.txt ] && pass "the cache has entries" || fail "the cache has no entry"
for kind in pipe link; do
    while read -r entry; do
        rm -f "$entry"
        if [ "$kind" = pipe ]; then mkfifo "$entry"; else ln -s "$work/home/secret" "$entry"; fi
    done <entries.txt
    expect "a $kind for an entry" 0 '' - timeout 60 "$glint" render shots/s.yaml -q -o two.png
    outside "a $kind for an entry"
    same_bytes=$(cmp one.png two.png 2>&1) && pass "the picture is the same" || fail "another picture: $same_bytes"
    [ "$(find cache -type f | wc -l)" -ge "$(wc -l <entries.txt)" ] && pass "and is kept" || fail "the entry is not kept"
done

# Names of pictures that nobody gave: the scene's, through a link that a repository brings.
ln -s "$work/home/evil.png" repo/hall.png
expect "a default name" 5 - 'hall.png:1:1: error: is not written: it leads out of the folder .E602.' \
    sh -c "cd repo && '$glint' render hall.glint.yaml -q"
outside "a default name"
rm repo/hall.png
ln -s pictures/own.png repo/hall.png
expect "a link within" 5 - E602 sh -c "cd repo && '$glint' render hall.glint.yaml -q"
: >repo/pictures/own.png
expect "that leads to a file" 0 - - sh -c "cd repo && '$glint' render hall.glint.yaml -q"
rm repo/hall.png repo/pictures/own.png

# --untrusted: one status for what is refused, whatever it is.
printf 'glint: 1\ninclude: [../home/secret]\n' >repo/bad.glint.yaml
expect "check: an include outside" 1 '' E602 "$glint" check repo
expect "check --untrusted" 5 '' E602 "$glint" check repo --untrusted
outside "check --untrusted"
rm repo/bad.glint.yaml
expect "what is good" 0 - - "$glint" check repo --untrusted
expect "by what changed: git is asked before" 0 '' '' "$glint" check --untrusted --changed repo/hall.glint.yaml repo
expect "render" 0 '' - "$glint" render repo/hall.glint.yaml --untrusted -q -o three.png
"$glint" render repo/hall.glint.yaml -q -o four.png
cmp -s three.png four.png && pass "has the same bytes" || fail "--untrusted changes the picture"
expect "verify" 0 verified - "$glint" verify shots/good.png --untrusted
expect "test" 0 '' - "$glint" test repo --untrusted --bless
expect "format" 0 '' - "$glint" format repo --untrusted
if env -u GLINT_DEVICE "$glint" render repo/hall.glint.yaml -q -o three.png 2>err.txt; then
    expect "no program is started" 5 '' 'ffmpeg' env -u GLINT_DEVICE "$glint" render repo/hall.glint.yaml \
        --frames 0..3 --set 'cameras.front.position=[0,0,{4+frame}]' --untrusted -o film.mp4
    ln -s "$work/home/new.png" repo/hall.0001.png
    ln -s "$work/home/evil.png" repo/hall.png
    expect "names of frames" 5 - 'hall.0001.png:1:1: error: is not written' sh -c "cd repo && env -u GLINT_DEVICE '$glint' render \
        hall.glint.yaml -q --frames 0..2 --set 'cameras.front.position=[0,0,{4+frame}]'"
    outside "names of frames"
    expect "watched" 5 - E602 sh -c "cd repo && env -u GLINT_DEVICE '$glint' render hall.glint.yaml --watch"
    outside "watched"
    rm repo/hall.png repo/hall.0001.png
    expect "a driver reads what it needs" 0 '' - env -u GLINT_DEVICE "$glint" render repo/hall.glint.yaml --untrusted -q -o four.png
    cmp -s three.png four.png && pass "and draws the same" || fail "--untrusted changes the device's picture"
else
    echo "skip the device: there is none"
fi
expect "time" 5 '' 'refused: more time' "$glint" render repo/hall.glint.yaml --size 4000x4000 --samples 64 --untrusted=1 -q -o long.png
expect "memory" 5 '' 'refused' "$glint" render repo/hall.glint.yaml --size 4000x4000 --untrusted=60,8 -q -o long.png
expect "not a number" 2 '' 'takes seconds' "$glint" check repo --untrusted=fast
[ -z "$(find . -name '.glint-*.tmp')" ] && pass "nothing is left behind" || fail "a temporary file is left"

# By the system's own record: after the restriction, nothing is opened but what is below the folder.
if command -v strace >strace.txt && strace -o strace.txt true 2>strace.txt; then
    printf 'glint: 1\ninclude: [../home/secret, /etc/passwd, link/secret]\nmodels: [{mesh: ../home/m.obj}, {mesh: /etc/hosts}]\n' >repo/bad.glint.yaml
    strace -f -e trace=open,openat,openat2,execve,execveat,landlock_restrict_self -o trace.txt "$glint" check repo --untrusted >out.txt 2>err.txt
    [ $? -eq 5 ] && pass "strace: refused" || fail "strace: not refused"
    if grep -q restrict_self trace.txt; then
        sed '1,/restrict_self/d' trace.txt >after.txt
    else
        echo "note: the kernel has no Landlock"
        sed '1,/"\/dev\/null"/d' trace.txt | grep -v /proc/self/statm >after.txt
    fi
    opened=$(grep -E 'open|exec' after.txt | grep -v ' = -1 ')
    [ -n "$opened" ] && pass "strace: scenes are opened" || fail "strace: no scene is opened"
    strays=$(echo "$opened" | grep -vE "\"(repo|repo/[^.\"][^\"]*|$work/repo/[^\"]*)\"")
    [ -z "$strays" ] && pass "strace: nothing outside" || fail "strace: opened outside: $strays"
else
    echo "skip strace: it is not installed, or may not trace"
fi
exit "$failed"
