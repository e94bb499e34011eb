#!/bin/sh
# The script of glint farm under GNU parallel: tiles of frames have the bytes of whole ones; what failed is done by the
# same command. Skipped where it is not installed: apt-get install parallel.
# Usage: run_parallel.sh GLINT SOURCE_FOLDER WORK_FOLDER
. "$(dirname -- "$0")/../cli/lib.sh"
parallel --version 2>/dev/null | grep -q 'GNU parallel' || {
    echo "skip: GNU parallel is not installed (package parallel)"
    exit 77
}
export XDG_CACHE_HOME="$work/cache" PARALLEL_HOME="$work/home"
mkdir -p "$PARALLEL_HOME"
cat >scene.yaml <<'S'
glint: 1
image: {width: 40, height: 48}
camera: {position: [0, 0, 6]}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff"}}
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: blue}]
S
turn='camera.position=[{6*sin(360*frame/8)}, 0.5, {6*cos(360*frame/8)}]'
"$glint" render scene.yaml --frames 0..3 --set "$turn" -o 'w.%04d.png' -q 2>err.txt || {
    cat err.txt
    echo "skip: no Vulkan device"
    exit 77
}
# A glint that fails in task 1, as long as there is a file.
cat >sometimes <<S
#!/bin/sh
case "\$*" in *'--tile 2/3'*) [ ! -f break ] || exit 9 ;; esac
exec "$glint" "\$@"
S
chmod +x sometimes
export GLINT="$work/sometimes"
: >break
"$glint" farm parallel scene.yaml --frames 0..3 --tiles 3 --chunk 2 --set "$turn" --folder "f 'x" -o "f 'x/o \$(y).%04d.png" -q || fail 'the script'
expect 'a task that fails' 2 '' 'cannot be read' sh "f 'x/job.sh"
[ "$(grep -c '"status": 9' "f 'x/log/1.jsonl")" = 3 ] && pass 'it is tried three times' || fail "tries: $(cat "f 'x/log/1.jsonl")"
[ "$(grep -c . "f 'x/log/0.jsonl")" = 1 ] && pass 'the others once' || fail 'the others once'
expect 'status' 1 '4 of 6 tasks done, 2 failed' - "$glint" farm status "f 'x"
rm break
expect 'the same command' 0 '' '' sh "f 'x/job.sh"
[ "$(cat "f 'x"/log/*.jsonl | grep -c '"status": 0')" = 6 ] && pass 'each task once more at most' || fail 'each task once more at most'
expect 'all' 0 '6 of 6 tasks done' - "$glint" farm status "f 'x"
for frame in 0000 0001 0002 0003; do
    cmp -s w.$frame.png "f 'x/o \$(y).$frame.png" && pass "frame $frame" || fail "frame $frame"
done
rm "f 'x/o \$(y).0001.png" "f 'x/o \$(y).0001.2.part"
"$glint" farm status "f 'x" | tail -1 >rest.sh
grep -q 'submit 1$' rest.sh && pass 'the rest is named' || fail "the rest: $(cat rest.sh)"
expect 'the rest' 0 '' '' sh rest.sh
cmp -s w.0001.png "f 'x/o \$(y).0001.png" && pass 'the frame that was removed' || fail 'the frame that was removed'
# Over ssh, as to another host: parallel's own program in the place of ssh.
"$glint" farm parallel scene.yaml --frames 0..3 --set "$turn" --chunk 1 --gpus=2 --sshlogin 'one,two' --folder g -q
grep -q -e "--jobs 2 --sshlogin 'one,two'" g/job.sh && pass 'hosts' || fail 'hosts'

# Over ssh for real, on the loopback: a server of our own with keys made for it. As root it needs the folder /run/sshd, which
# its package makes where it is started as a service.
sshd=$(command -v sshd || ls /usr/sbin/sshd 2>/dev/null)
if [ -z "$sshd" ] || ! command -v ssh >/dev/null || { [ "$(id -u)" = 0 ] && [ ! -d /run/sshd ]; }; then
    echo "note: not over ssh: no sshd that can be started (package openssh-server; as root with /run/sshd)"
    exit $failed
fi
mkdir ssh && chmod 700 ssh
ssh-keygen -q -t ed25519 -N '' -f ssh/host && ssh-keygen -q -t ed25519 -N '' -f ssh/own && cp ssh/own.pub ssh/allowed
port=$((20000 + $$ % 20000))
cat >ssh/sshd.conf <<S
Port $port
ListenAddress 127.0.0.1
HostKey $work/ssh/host
AuthorizedKeysFile $work/ssh/allowed
PidFile none
UsePAM no
StrictModes no
PasswordAuthentication no
PermitRootLogin prohibit-password
MaxStartups 100
S
cat >ssh/config <<S
Host first second
  HostName 127.0.0.1
  Port $port
  IdentityFile $work/ssh/own
  IdentitiesOnly yes
  BatchMode yes
  StrictHostKeyChecking no
  UserKnownHostsFile $work/ssh/known
  LogLevel ERROR
S
"$sshd" -D -e -f "$work/ssh/sshd.conf" 2>ssh/log.txt &
server=$!
trap 'kill $server 2>/dev/null' EXIT
tries=0
until ssh -F ssh/config first true 2>ssh/err.txt || [ $tries -ge 40 ] || ! kill -0 $server 2>/dev/null; do
    sleep 0.1
    tries=$((tries + 1))
done
if ! ssh -F ssh/config first true 2>ssh/err.txt; then
    echo "note: not over ssh: $(cat ssh/err.txt; tail -1 ssh/log.txt)"
    exit $failed
fi
export PARALLEL_SSH="ssh -F $work/ssh/config" GLINT="$glint"
"$glint" farm parallel scene.yaml --frames 0..3 --set "$turn" --chunk 1 --sshlogin 'first,second' --folder s -o 's.%04d.png' -q
expect 'tasks over ssh' 0 '' '' sh s/job.sh
for frame in 0000 0003; do
    cmp -s w.$frame.png s.$frame.png && pass "frame $frame over ssh" || fail "frame $frame over ssh"
done
[ "$(cut -f2 s/log/parallel.txt | grep -cE '^(first|second)$')" = 4 ] && pass 'on both hosts' || fail "hosts: $(cat s/log/parallel.txt)"
exit $failed
