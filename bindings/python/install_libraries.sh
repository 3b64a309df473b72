#!/bin/sh
# The header-only libraries that skelgen is built with, from their sources at the versions of Debian 12: for systems whose
# packages are older or newer, as those that wheels are built on.
set -eu
work=$(mktemp -d)
install_library() { # URL TAG
    git clone --quiet --depth 1 --branch "$2" "$1" "$work/$2"
    cmake -S "$work/$2" -B "$work/$2/build" -DBUILD_TESTING=OFF -DJSON_BuildTests=OFF -DCLI11_BUILD_TESTS=OFF \
        -DCLI11_BUILD_EXAMPLES=OFF -DNANOFLANN_BUILD_EXAMPLES=OFF -DNANOFLANN_BUILD_TESTS=OFF -DFASTFLOAT_TEST=OFF
    cmake --install "$work/$2/build"
}
install_library https://gitlab.com/libeigen/eigen.git 3.4.0
install_library https://github.com/CLIUtils/CLI11.git v2.1.2
install_library https://github.com/fastfloat/fast_float.git v3.9.0
install_library https://github.com/jlblancoc/nanoflann.git v1.4.3
install_library https://github.com/nlohmann/json.git v3.11.2
install_library https://github.com/yixuan/spectra.git v1.0.1
rm -rf "$work"
