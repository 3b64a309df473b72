#!/usr/bin/env bash
# Tries the Debian packages in a bare Debian 12: installed, used by program, manual page and consumer, removed without a trace.
#
# try_debian.sh FOLDER_WITH_PACKAGES [STATIC_PROGRAM]: as root; the system is made by debootstrap in a folder of its own.
set -euo pipefail
packages=$(realpath "$1")
static=${2:+$(realpath "$2")}
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
bare=${SKELGEN_BARE_SYSTEM:-$PWD/build/package/bare}
fail() {
    printf 'try_debian: %s\n' "$*" >&2
    exit 1
}
# What apt says is of interest where it fails alone.
quietly() { "$@" >"$bare/tmp/try/log" 2>&1 || { cat "$bare/tmp/try/log" >&2 && exit 1; }; }
inside() { chroot "$bare" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
files() { (cd "$bare" && find etc opt usr -xdev | grep -v -e "^etc/ld.so.cache$" -e "^usr/share/doc" | sort); }

mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' 'Label: Debian' | head -1)
if [[ ! -e $bare/etc/debian_version ]]; then
    debootstrap --variant=minbase bookworm "$bare" "${mirror%/}" >/dev/null
fi
cp /etc/resolv.conf "$bare/etc/resolv.conf"
mkdir -p "$bare/tmp/try"
quietly inside apt-get update -qq
cp "$packages"/skelgen_*.deb "$packages"/libskelgen-dev_*.deb "$bare/tmp/try/"
cp -r contrib/packaging/consumer data/sample "$bare/tmp/try/"

if [[ -n $static ]]; then
    echo "== the static program, in a system that has nothing at all"
    mkdir -p "$bare/tmp/try/nothing/tmp"
    cp "$static" data/sample/body.off "$bare/tmp/try/nothing/"
    chroot "$bare/tmp/try/nothing" "/$(basename "$static")" --version
    chroot "$bare/tmp/try/nothing" "/$(basename "$static")" rig /body.off -o /body.glb
    head -c 4 "$bare/tmp/try/nothing/body.glb" | grep -q glTF
fi

echo "== the program"
quietly inside apt-get autoremove --purge -y -qq # of an earlier trial
before=$(files)
quietly inside sh -c 'apt-get install -y -qq --no-install-recommends /tmp/try/skelgen_*.deb'
inside sh -ec 'cd /tmp/try && skelgen --version && skelgen extract sample/body.off -o body.json && skelgen rig sample/body.off -o body.glb && head -c 4 body.glb | grep -q glTF'
inside sh -ec 'test -s /usr/share/bash-completion/completions/skelgen'
quietly inside apt-get purge -y -qq skelgen
quietly inside apt-get autoremove --purge -y -qq
after=$(files)
[[ $before == "$after" ]] || fail "removed, the program leaves behind: $(diff <(echo "$before") <(echo "$after") | head)"

echo "== the manual page, by man"
# A bare system leaves manual pages out; who has man wants them.
quietly inside apt-get install -y -qq --no-install-recommends man-db
rm -f "$bare/etc/dpkg/dpkg.cfg.d/docker"
quietly inside sh -c 'apt-get install -y -qq --no-install-recommends /tmp/try/skelgen_*.deb'
inside sh -c 'man skelgen | grep -q "EXIT STATUS"' || fail "there is no manual page"
inside sh -c 'man skelgen-rig | grep -q -e "--names"' || fail "there is no manual page of skelgen rig"

echo "== the library"
quietly inside sh -c 'apt-get install -y -qq --no-install-recommends cmake g++ make /tmp/try/libskelgen-dev_*.deb'
inside sh -ec 'cmake -S /tmp/try/consumer -B /tmp/try/build -DCMAKE_BUILD_TYPE=Release >/dev/null && cmake --build /tmp/try/build >/dev/null
    /tmp/try/build/joints /tmp/try/sample/body.off | grep "^left_knee "'
quietly inside apt-get purge -y -qq skelgen libskelgen-dev
left=$(inside find / -xdev -iname '*skelgen*' -not -path '/tmp/*' -not -path '/proc/*' -not -path '/var/cache/man/*') # what man itself keeps
[[ -z $left ]] || fail "removed, the packages leave behind: $left"
rm -rf "$bare/tmp/try"
echo "installed, used and removed without a trace"
