#!/usr/bin/env bash
# Tries the static program in base file systems of other Linux distributions: skeleton, character, measures, and a batch.
#
# try_static.sh PROGRAM ROOT...: as root; each ROOT is a folder that holds such a system, as debootstrap makes one.
set -euo pipefail
(($# > 1)) || { sed -n '2,4s/^# \?//p' "$0" >&2 && exit 2; }
program=$(realpath "$1")
shift
sample=$(realpath "$(dirname "$0")/../../data/sample/body.off")
for root in "$@"; do
    name=$(sed -n 's/^PRETTY_NAME="\{0,1\}\([^"]*\)"\{0,1\}$/\1/p' "$root/etc/os-release")
    work=$(mktemp -d "$root/tmp/skelgen.XXXXXX")
    trap 'rm -rf "$work"' EXIT
    install -m 755 "$program" "$work/skelgen"
    mkdir "$work/meshes"
    cp "$sample" "$work/meshes/body.off"
    chroot "$root" /bin/sh -ec "cd /tmp/$(basename "$work")
        ./skelgen extract meshes/body.off -o body.json && grep -q left_knee body.json
        ./skelgen rig meshes/body.off -o body.vrm && head -c 4 body.vrm | grep -q glTF
        ./skelgen measure meshes/body.off --csv | grep -q body.off
        ./skelgen batch meshes -o out -q" || { echo "the static program fails in $name" >&2 && exit 1; }
    rm -rf "$work"
    echo "$name: the static program works"
done
