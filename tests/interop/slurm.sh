#!/usr/bin/env bash
# slurm.sh SKELGEN MESHES EXPECTED OUT: has contrib/slurm work on the meshes, on a cluster of two nodes that it sets up on this
# machine. One node is lost in the middle of a shard and comes back, a worker is killed on the other, and that one is drained.
# Fails where the results are not those in EXPECTED, which one batch has made, or anything was lost or done twice.
# Any user may run it. The cluster's files and ports are its own; it takes all down with it.
set -euo pipefail

skelgen=$1 meshes=$2 expected=$3 out=$4
shards=8
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
contrib=$here/../../contrib/slurm
cluster=$(mktemp -d) # a short name: those of sockets may not be long
declare -A daemons=()

fail() {
    printf 'slurm.sh: %s\n' "$*" >&2
    sinfo -N -l >&2 || true
    squeue >&2 || true
    tail -n 15 "$cluster"/*.log "$out"/logs/*.log >&2 || true
    exit 1
}

# All processes of jobs on a node of this cluster, or on any.
job_processes() {
    local process
    for process in /proc/[0-9]*; do
        if grep -qsxzF "SLURM_CONF=$cluster/slurm.conf" "$process/environ" &&
            grep -qsxz "SLURMD_NODENAME=${1:-.*}" "$process/environ"; then basename "$process"; fi
    done
}

parent_of() { sed -n 's/^PPid:\t//p' "/proc/$1/status" 2>/dev/null || true; }
name_of() { cat "/proc/$1/comm" 2>/dev/null || true; }

# What runs a node's jobs: slurmstepd, which is the parent of the script.
step_daemons() {
    local process parent
    for process in $(job_processes "${1:-}"); do
        parent=$(parent_of "$process")
        [[ -n $parent && $(name_of "$parent") == slurmstepd* ]] && echo "$parent"
    done
    return 0
}

# shellcheck disable=SC2317 # the trap calls it
take_down() {
    local status=$?
    trap - EXIT
    mapfile -t left < <(step_daemons && job_processes)
    kill -KILL "${left[@]}" "${daemons[@]}" 2>/dev/null || true
    { wait; } 2>/dev/null # or bash tells of each that it was killed
    rm -rf "$cluster"
    exit "$status"
}
trap take_down EXIT

# wait_for SECONDS WHAT COMMAND...: until the command succeeds.
wait_for() {
    local end=$((SECONDS + $1)) what=$2
    shift 2
    until "$@"; do
        ((SECONDS < end)) || fail "$what: not within its time"
        sleep 0.2
    done
}

free_ports() {
    python3 -c 'import socket
sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(3)]
print(*(s.getsockname()[1] for s in sockets))'
}

start_node() {
    "$(type -P slurmd)" -D -N "$1" -f "$cluster/slurm.conf" >>"$cluster/$1.out.log" 2>&1 &
    daemons[$1]=$!
}

set_up() {
    local name ports user
    name=$(hostname -s) user=$(id -un)
    read -ra ports < <(free_ports)
    cat >"$cluster/slurm.conf" <<TEXT
ClusterName=skelgen
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$cluster/munge.socket,cred_expire=5
StateSaveLocation=$cluster/state
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdSpoolDir=$cluster/%n.spool
SlurmdPidFile=$cluster/%n.pid
SlurmdLogFile=$cluster/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=10
KillWait=5
NodeName=node1 NodeHostname=$name NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=1
NodeName=node2 NodeHostname=$name NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=1
PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP
TEXT
    echo CgroupPlugin=cgroup/v1 >"$cluster/cgroup.conf" # the one that needs no systemd to be left alone
    mkdir "$cluster/state" "$cluster/node1.spool" "$cluster/node2.spool"
    export SLURM_CONF=$cluster/slurm.conf

    head -c 1024 /dev/urandom >"$cluster/munge.key"
    chmod 400 "$cluster/munge.key"
    munged --foreground --force --num-threads=2 --key-file="$cluster/munge.key" --socket="$cluster/munge.socket" \
        --pid-file="$cluster/munged.pid" --log-file="$cluster/munged.log" --seed-file="$cluster/munged.seed" \
        >"$cluster/munged.out.log" 2>&1 &
    daemons[munged]=$!
    wait_for 20 "munge" test -S "$cluster/munge.socket"
    slurmctld -D -f "$cluster/slurm.conf" >"$cluster/slurmctld.out.log" 2>&1 &
    daemons[slurmctld]=$!
    start_node node1
    start_node node2
    wait_for 60 "nodes that wait for work" is_idle 2
}

is_idle() { [[ $(sinfo -h -N -t idle -o %N 2>/dev/null | wc -l) == "$1" ]]; }
has_state() { [[ $(sinfo -h -N -n "$1" -o %T) == "$2" ]]; }

# shard_on NODE: the number of the shard that runs there.
shard_on() { squeue -h -r -t running -w "$1" -n skelgen-shard -o %K; }

# Whether a node is well into a shard, and not nearly done.
is_in_the_middle() {
    local shard lines
    shard=$(shard_on "$1")
    [[ -n $shard ]] || return 1
    lines=$({ wc -l <"$out/shards/$shard-of-$shards/summary.jsonl"; } 2>/dev/null || echo 0)
    ((lines >= 5 && lines <= 25))
}

worker_on() {
    local process
    for process in $(job_processes "$1"); do
        if [[ $(name_of "$process") == skelgen && $(name_of "$(parent_of "$process")") == skelgen ]]; then
            echo "$process"
            return
        fi
    done
    return 1
}

# Kills the worker on node1; whether the log of that shard tells of it, and not that it was between two meshes.
is_killed_at() {
    kill -KILL "$(worker_on node1)" 2>/dev/null || true
    sleep 0.5
    log_of "$1" | grep -q 'died of signal 9'
}

# Holds a node's job well into a shard: what is held does not end between the look and the blow.
is_held_in_the_middle() {
    local processes
    is_in_the_middle "$1" || return 1
    mapfile -t processes < <(job_processes "$1")
    kill -STOP "${processes[@]}" 2>/dev/null || true
    is_in_the_middle "$1" && return
    kill -CONT "${processes[@]}" 2>/dev/null || true
    return 1
}

lose_node() {
    local processes
    mapfile -t processes < <(step_daemons "$1" && job_processes "$1")
    kill -KILL "${daemons[$1]}" "${processes[@]}" || true
    wait "${daemons[$1]}" 2>/dev/null || true
}

has_ended() { [[ -z $(squeue -h -o %i) ]]; }
log_of() { cat "$out/logs/shard-$1.log"; }

set_up
rm -rf "$out"
mapfile -t submitted < <(SKELGEN=$skelgen "$contrib/submit.sh" "$meshes" "$out" "$shards" -- --timeout 60)
merge=${submitted[1]#merge }

wait_for 60 "node2 at a shard" is_held_in_the_middle node2
lost=$(shard_on node2)
lose_node node2

wait_for 60 "node1 at a shard" is_in_the_middle node1
crashed=$(shard_on node1)
wait_for 20 "a killed worker" is_killed_at "$crashed"
scontrol update nodename=node1 state=drain reason=maintenance

wait_for 60 "the loss of node2 to be seen" has_state node2 down\*
wait_for 60 "node1 to be drained" has_state node1 drained
start_node node2
wait_for 300 "the end of all jobs" has_ended

[[ $lost != "$crashed" ]] || fail "one shard for both mishaps"
log_of "$lost" | grep -q 'on node2, start 1$' || fail "shard $lost of the lost node was not begun again"
log_of "$lost" | grep -qE ' [1-9][0-9]* done before' || fail "shard $lost did not go on where it was left"
log_of "$crashed" | grep -qE ' [1-9] done now, .* 0 failed' || fail "the killed worker's mesh was not tried again"
[[ $(cat "$out"/logs/shard-*.log | grep -c ' on node1, ') -lt $shards ]] || fail "node1 was not drained"
scontrol show job "$merge" | grep -q 'ExitCode=0:0' || fail "the merge did not end well"
total=$(find "$meshes" -type f | wc -l)
grep -q "$total done, 0 failed, 0 missing, 0 contradictory, 0 done twice" "$out/logs/merge.log" || fail "not all is there once"
[[ $(cat "$out"/shards/*/summary.jsonl | wc -l) == "$total" ]] || fail "the shards have not one line for each mesh"
printf 'SLURM: node2 lost at shard %s, worker killed at shard %s, node1 drained: ' "$lost" "$crashed"
python3 "$here/same_results.py" "$expected" "$out/skeletons"
