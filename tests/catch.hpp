#pragma once

// Catch2 2 (Debian 12) and Catch2 3 under one include.

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif

/// Ends the test case as skipped, saying why; CTest shows it as skipped.
#define SKELGEN_SKIP(reason)                                                                                           \
    do {                                                                                                               \
        std::cout << "\nTEST SKIPPED: " << (reason) << std::endl;                                                      \
        return;                                                                                                        \
    } while (false)

namespace skelgen::test {

/// The folder of real bodies (it holds meshes/ and truth/) that the environment variable SKELGEN_BODIES names, if any.
inline std::optional<std::filesystem::path> bodies_folder() {
    const char* folder = std::getenv("SKELGEN_BODIES");
    if (folder == nullptr || *folder == '\0') return std::nullopt;
    return std::filesystem::path(folder);
}

} // namespace skelgen::test
