#!/usr/bin/env bash
# Submits a batch as a job array, and the job that merges what the array has done. Submitted again it goes on where it
# was left.
set -euo pipefail

usage() {
    cat <<'TEXT'
usage: submit.sh [-r REPORT] MESHES OUT SHARDS [SBATCH OPTION...] [-- BATCH OPTION...]

  MESHES    what skelgen batch takes: a folder, a mesh, or a quoted pattern
  OUT       folder for OUT/skeletons (all results), OUT/shards (each shard's) and OUT/logs
  SHARDS    into how many tasks the meshes are divided
  -r FILE   also a page that shows all meshes, failures first

  SKELGEN   the program, where it is not in the PATH of the nodes

Prints the numbers of both jobs.
TEXT
}

report=
while getopts hr: option; do
    case $option in
    r) report=$OPTARG ;;
    h) usage && exit ;;
    *) usage >&2 && exit 2 ;;
    esac
done
shift $((OPTIND - 1))
if (($# < 3)) || [[ ! $3 =~ ^[1-9][0-9]*$ ]]; then
    usage >&2
    exit 2
fi
meshes=$1 out=$2 shards=$3
shift 3

# Both jobs take the options of sbatch, but for which tasks there are.
array_options=() merge_options=()
while (($# > 0)) && [[ $1 != -- ]]; do
    array_options+=("$1")
    [[ $1 == --array=* ]] || merge_options+=("$1")
    shift
done
(($# == 0)) || shift # the --

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
mkdir -p "$out/logs"
logs=${out//%/%%}/logs # a % means something to sbatch
array=$(sbatch --parsable --array="1-$shards" --output="$logs/shard-%a.log" "${array_options[@]}" \
    "$here/shard.sbatch" "$meshes" "$out" "$shards" "$@")
array=${array%%;*} # behind it the cluster's name
# After whatever end of the tasks: what one of them has not done, the merge names.
merge=$(sbatch --parsable --dependency="afterany:$array" --output="$logs/merge.log" "${merge_options[@]}" \
    "$here/merge.sbatch" "$meshes" "$out" "$shards" ${report:+--report "$report"})
printf 'array %s\nmerge %s\n' "$array" "${merge%%;*}"
