#!/usr/bin/env bash
# Builds the Debian packages of what is committed, into build/package, and has lintian look at them.
#
# debian.sh [--quick] [REVISION]: --quick compiles as ./dev release does, without Debian's flags, so that a compiler's cache has
# most of it; not for a release.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if [[ ${1:-} == --quick ]]; then
    shift
    quick=true
    export DEB_CXXFLAGS_SET= DEB_CFLAGS_SET= DEB_CPPFLAGS_SET= SKELGEN_CMAKE_OPTIONS=-DSKELGEN_WERROR=ON
    export CCACHE_DIR=${CCACHE_DIR:-$HOME/.cache/ccache} CCACHE_NOHASHDIR=1
fi
version=$(sed -n 's/^skelgen (\([^)]*\)).*/\1/p;q' contrib/packaging/debian/changelog)
work=$PWD/build/package/skelgen-$version
rm -rf "$work" build/package/*.deb
mkdir -p "$work"
git archive "${1:-HEAD}" | tar -x -C "$work"
cp -r "$work/contrib/packaging/debian" "$work/debian"
cd "$work"
export CCACHE_BASEDIR=$work
dpkg-buildpackage --no-sign --build=binary -j"${SKELGEN_JOBS:-$(nproc)}" >../build.log 2>&1 || {
    tail -n 40 ../build.log >&2
    exit 1
}
if ${quick:-false}; then # without Debian's flags there is nothing in it
    rm -f ../*-dbgsym*.deb
    sed -i '/-dbgsym/d' ../*.changes
fi
lintian --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs ../*.changes
ls -l ../*.deb
