# A Slurm cluster of two nodes on this host, for tests: no systemd, loopback only, all files in one folder. To be sourced;
# needs root, slurmctld, slurmd and munged.
#
#     cluster_start FOLDER   the folder is made; false: why is in FOLDER/log
#     cluster_stop           ends what cluster_start began, and nothing else

cluster_start() {
    cluster=$1
    cluster_host=$(uname -n | cut -d. -f1)
    # Three ports that nobody listens on, as far as can be known.
    cluster_port=$((20000 + $$ % 10000 / 4 * 4))
    mkdir -p "$cluster/state" "$cluster/log" "$cluster/munge"
    head -c 1024 /dev/urandom >"$cluster/munge/key"
    chown -R munge: "$cluster/munge" && chmod 755 "$cluster/.." "$cluster" "$cluster/munge" && chmod 400 "$cluster/munge/key"
    cat >"$cluster/slurm.conf" <<END
ClusterName=loop
SlurmctldHost=$cluster_host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/sock
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
SlurmdParameters=config_overrides
SlurmdTimeout=5
KillWait=3
ReturnToService=2
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
SlurmctldPort=$cluster_port
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.%n.pid
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool.%n
SlurmctldLogFile=$cluster/log/ctld.log
SlurmdLogFile=$cluster/log/slurmd.%n.log
NodeName=n[1-2] NodeHostname=$cluster_host NodeAddr=127.0.0.1 Port=[$((cluster_port + 1))-$((cluster_port + 2))] CPUs=1 State=UNKNOWN
PartitionName=low Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP PriorityTier=1
PartitionName=high Nodes=n[1-2] MaxTime=INFINITE State=UP PriorityTier=10 PreemptMode=off
END
    export SLURM_CONF="$cluster/slurm.conf"
    setpriv --reuid=munge --regid=munge --clear-groups munged --socket="$cluster/munge/sock" \
        --key-file="$cluster/munge/key" --pid-file="$cluster/munge/pid" --log-file="$cluster/munge/log" \
        --seed-file="$cluster/munge/seed" --num-threads=2 2>"$cluster/log/munged.txt" || return 1
    slurmctld -f "$SLURM_CONF" 2>"$cluster/log/start.txt" || return 1
    cluster_node n1 && cluster_node n2 && cluster_wait '^2$' sh -c 'sinfo -h -p low -t idle -o %D'
}

cluster_node() {
    slurmd -f "$SLURM_CONF" -N "$1" 2>>"$cluster/log/start.txt"
}

# cluster_wait PATTERN command...: until what it prints matches, for a minute at most.
cluster_wait() {
    pattern=$1
    shift
    tries=0
    until "$@" 2>/dev/null | grep -q "$pattern"; do
        tries=$((tries + 1))
        [ $tries -lt 300 ] || return 1
        sleep 0.2
    done
}

# Slurm's processes of this cluster, by the logs that they hold open.
cluster_processes() {
    for place in /proc/[0-9]*; do
        name=$(cat "$place/comm" 2>/dev/null)
        case $name in
        slurm*) readlink "$place"/fd/* 2>/dev/null | grep -qF "$cluster/" && echo "${place#/proc/} $name" ;;
        esac
    done
}

cluster_stop() {
    [ -n "${cluster:-}" ] || return 0
    scancel --quiet -u root 2>/dev/null
    for file in "$cluster"/slurmd.*.pid "$cluster/slurmctld.pid" "$cluster/munge/pid"; do
        [ -f "$file" ] && kill "$(cat "$file")" 2>/dev/null
    done
    tries=0
    while [ -n "$(cluster_processes)" ] && [ $tries -lt 50 ]; do
        tries=$((tries + 1))
        sleep 0.2
    done
    cluster_processes | while read -r process name; do
        kill -9 "$process" 2>/dev/null
    done
    cluster=
}
