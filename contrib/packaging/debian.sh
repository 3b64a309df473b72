#!/usr/bin/env bash
# Builds the Debian packages of what is committed, into build/package, and has lintian look at them.
#
# debian.sh [REVISION]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
version=$(sed -n 's/^skelgen (\([^)]*\)).*/\1/p;q' contrib/packaging/debian/changelog)
work=$PWD/build/package/skelgen-$version
rm -rf "$work" build/package/*.deb
mkdir -p "$work"
git archive "${1:-HEAD}" | tar -x -C "$work"
cp -r "$work/contrib/packaging/debian" "$work/debian"
cd "$work"
dpkg-buildpackage --no-sign --build=binary -j"${SKELGEN_JOBS:-$(nproc)}" >../build.log 2>&1 || {
    tail -n 40 ../build.log >&2
    exit 1
}
lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs ../*.changes
ls -l ../*.deb
