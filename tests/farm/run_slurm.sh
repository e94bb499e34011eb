#!/bin/sh
# The script of glint farm under Slurm: 16 tiles over two nodes, and a merge; a node that dies and a task that is
# preempted lose nothing. Skipped where Slurm is not installed: apt-get install slurm-wlm munge.
# Usage: run_slurm.sh GLINT SOURCE_FOLDER WORK_FOLDER
here=$(cd "$(dirname -- "$0")" && pwd)
. "$here/../cli/lib.sh"
. "$here/slurm_cluster.sh"
for program in slurmctld slurmd sbatch munged setpriv; do
    PATH=$PATH:/usr/sbin command -v $program >/dev/null || {
        echo "skip: $program is not installed (packages slurm-wlm and munge)"
        exit 77
    }
done
PATH=$PATH:/usr/sbin
[ "$(id -u)" = 0 ] || {
    echo "skip: a Slurm of its own needs root"
    exit 77
}
export XDG_CACHE_HOME="$work/cache"
export GLINT="$glint"
cat >scene.yaml <<'S'
glint: 1
image: {width: 320, height: 256, samples: 16}
camera: {position: [0, 1, 6]}
background: {color: [0.3, 0.5, 0.8]}
lights: [{position: [-5, 8, 5]}]
materials: {blue: {diffuse_color: "#1020ff", albedo: [0.6, 0.3, 0.1, 0]}, red: {diffuse_color: "#ff2010"}}
spheres: [{center: [-0.9, 0, 0], radius: 0.9, material: blue}, {center: [1, 0, 0], radius: 0.9, material: red}]
S
if ! "$glint" render scene.yaml -o whole.png -q 2>err.txt; then
    cat err.txt
    echo "skip: no Vulkan device"
    exit 77
fi

folder=$(mktemp -d)
trap 'cluster_stop; rm -rf -- "$folder"' EXIT
trap 'exit 2' INT TERM
cluster_start "$folder/cluster" || {
    cat "$folder"/cluster/log/*
    fail 'Slurm starts'
    exit 1
}

# ended: until no job is left; a task that was requeued waits otherwise, as Slurm gives the node time.
ended() {
    tries=0
    while jobs=$(squeue -h -o '%A %t %r') && [ -n "$jobs" ]; do
        echo "$jobs" | while read -r job state reason; do
            [ "$state $reason" != 'PD BeginTime' ] || scontrol update JobId="$job" StartTime=now
        done
        tries=$((tries + 1))
        [ $tries -lt 600 ] || return 1
        sleep 0.3
    done
}

# whole NAME FOLDER: its picture is that of one process.
whole() {
    if cmp -s "$2/out.png" whole.png; then pass "$1"; else
        fail "$1"
        head -50 "$2"/log/*
    fi
}

# ---- 16 tiles over two nodes
"$glint" farm slurm scene.yaml --tiles 16 --folder 'a farm' -o 'a farm/out.png' -q || fail 'the script is written'
sh 'a farm/job.sh' >out.txt 2>&1 || fail "submit: $(cat out.txt)"
ended || fail 'the jobs end'
whole 'tiles by Slurm' 'a farm'
[ "$(cat 'a farm'/log/*.jsonl | grep -c '"status": 0')" = 16 ] && pass '16 tasks logged' || fail '16 tasks logged'
nodes=$(cat 'a farm'/log/*.jsonl | sed 's/.*"host": "\([^"]*\)".*/\1/' | sort -u | tr '\n' ' ')
[ "$nodes" = 'n1 n2 ' ] && pass 'on both nodes' || fail "on both nodes: $nodes"
expect 'status' 0 '16 of 16 tasks done' - "$glint" farm status 'a farm'

# ---- a task that is preempted goes to the end
slow='--samples 2400'
"$glint" render scene.yaml $slow -o whole.png -q
"$glint" farm slurm scene.yaml $slow --tiles 4 --folder 'preempted' -o 'preempted/out.png' -q
sh preempted/job.sh >out.txt 2>&1 || fail "submit: $(cat out.txt)"
cluster_wait '^2$' sh -c "squeue -h -t R -n glint-farm -o x | wc -l" || fail 'two tasks run'
sbatch -p high -N2 -o /dev/null --wrap 'srun -N2 sleep 1' >/dev/null
cluster_wait . squeue -h -p high -t R || fail 'the other job runs'
[ -z "$(squeue -h -p low -t R -o %A)" ] && pass 'tasks were preempted' || fail 'tasks were preempted'
ended || fail 'the jobs end'
whole 'tasks that were preempted' preempted

# ---- a node dies in the middle
"$glint" farm slurm scene.yaml $slow --tiles 4 --folder 'killed' -o 'killed/out.png' -q
sh killed/job.sh >out.txt 2>&1 || fail "submit: $(cat out.txt)"
cluster_wait '^2$' sh -c "squeue -h -t R -n glint-farm -o x | wc -l" || fail 'two tasks run'
job=$(squeue -h -w n2 -o %A)
# What runs the task, which has the job in its name a moment after the job runs, and then the daemon, so that neither ends the other.
step_of() {
    for process in $(cluster_processes | sed -n 's/ slurmstepd.*//p'); do
        tr '\0' ' ' <"/proc/$process/cmdline" | grep -qF "[$1." && echo "$process"
    done 2>/dev/null
}
cluster_wait . step_of "$job" || {
    fail "job $job has no step"
    squeue -a
    cluster_processes
}
killed=0
for process in $(cat "$cluster/slurmd.n2.pid") $(step_of "$job"); do
    kill -9 "$process" && killed=$((killed + 1))
done
[ "$killed" -ge 2 ] && pass 'a node was killed' || fail "a node was killed: $killed processes of job $job"
cluster_wait down sinfo -h -n n2 -o %t || fail 'Slurm sees it'
ended || fail 'the jobs end'
whole 'a node that died' killed
grep -q REQUEUE "$cluster/log/ctld.log" || grep -qi requeue "$cluster/log/ctld.log" && pass 'the task was requeued' || fail 'requeued'
exit $failed
