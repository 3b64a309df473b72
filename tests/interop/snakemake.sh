#!/usr/bin/env bash
# snakemake.sh SKELGEN MESHES EXPECTED OUT: has contrib/snakemake work on the meshes with two jobs at a time. A worker is killed,
# then the batch of a shard, and then Snakemake itself, which is started again. Fails where the results are not those in
# EXPECTED, which one batch has made, or anything was lost or done twice.
set -euo pipefail

skelgen=$1 meshes=$2 expected=$3 out=$4
shards=8
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
snakefile=$(realpath "$here/../../contrib/snakemake/Snakefile")
run=

fail() {
    printf 'snakemake.sh: %s\n' "$*" >&2
    tail -n 15 "$out"/*.log "$out"/logs/*.log >&2 || true
    exit 1
}

parent_of() { sed -n 's/^PPid:\t//p' "/proc/$1/status" 2>/dev/null || true; }
name_of() { cat "/proc/$1/comm" 2>/dev/null || true; }

# Processes of this run: they have its mark in their environment.
export SKELGEN_SNAKEMAKE_TEST=$$
processes() { grep -lsxzF "SKELGEN_SNAKEMAKE_TEST=$$" /proc/[0-9]*/environ | cut -d/ -f3 || true; }

# shellcheck disable=SC2317 # the trap calls it
take_down() {
    local status=$?
    trap - EXIT
    end_run
    exit "$status"
}
trap take_down EXIT

start() {
    snakemake --snakefile "$snakefile" --directory "$out" --cores 2 --nocolor --config skelgen="$skelgen" meshes="$meshes" \
        out="$out" shards="$shards" options="--timeout 60" >>"$out/snakemake.log" 2>&1 &
    run=$!
}

# signal_run NAME: to Snakemake and all that it has started; twice, for what was started meanwhile.
signal_run() {
    local process
    for _ in 1 2; do
        for process in $(processes); do
            ((process == $$ || process == BASHPID)) || kill "-$1" "$process" 2>/dev/null || true
        done
    done
}

# Without a chance to say goodbye.
end_run() {
    signal_run KILL
    wait 2>/dev/null || true
}

# Of the batches that run the processes that are workers, or those that have them.
batches() {
    local process
    for process in $(processes); do
        [[ $(name_of "$process") == skelgen ]] || continue
        if [[ $(name_of "$(parent_of "$process")") == skelgen ]]; then
            [[ $1 == workers ]] && echo "$process"
        else
            [[ $1 == parents ]] && echo "$process"
        fi
    done
    return 0
}

lines() { cat "$out"/shards/*/summary.jsonl 2>/dev/null | wc -l; }

# hold_at LINES: has the run stand still once so many meshes are done. It does dozens a second: more than could be looked at.
hold_at() {
    local end=$((SECONDS + 120))
    until (($(lines) >= $1)); do
        kill -0 "$run" 2>/dev/null || fail "it has ended too soon"
        ((SECONDS < end)) || fail "$1 meshes not done within their time"
        sleep 0.02
    done
    signal_run STOP
}

# kill_one workers|parents LINES: once so many meshes are done, one of those that are at work; the run goes on.
kill_one() {
    local process='' end=$((SECONDS + 120))
    until [[ -n $process ]]; do
        hold_at "$2"
        read -r process < <(batches "$1") || true
        [[ -z $process ]] || kill -KILL "$process"
        signal_run CONT
        ((SECONDS < end)) || fail "nothing to kill within its time"
    done
}

total=$(find "$meshes" -type f | wc -l)
rm -rf "$out"
mkdir -p "$out"
start
until cat "$out"/logs/shard-*.log 2>/dev/null | grep -q 'died of signal 9'; do # it may have been between two meshes
    kill_one workers $((total / 8))
    sleep 0.2
done
kill_one parents $((total / 4))
hold_at $((total / 2))
end_run
done_before=$(cat "$out"/shards/*/summary.jsonl | grep -c '"status":"ok".*}$') # and not that of the killed worker
((done_before < total)) || fail "it was all done before it was ended"
touch "$out/restart"
snakemake --snakefile "$snakefile" --directory "$out" --unlock --cores 2 --config meshes="$meshes" out="$out" \
    >>"$out/snakemake.log" 2>&1
start
wait "$run" || fail "it did not end well"

[[ $(find "$out/shards" -name '*.json' ! -newer "$out/restart" | wc -l) == "$done_before" ]] ||
    fail "what was done before it was ended was not left alone"
grep -q "$total done, 0 failed, 0 missing, 0 contradictory, 0 done twice" "$out/logs/merge.log" || fail "not all is there once"
[[ $(cat "$out"/shards/*/summary.jsonl | wc -l) == "$total" ]] || fail "the shards have not one line for each mesh"
printf 'Snakemake: a worker, a batch and Snakemake itself killed: '
python3 "$here/same_results.py" "$expected" "$out/skeletons"
