#pragma once

#include <string_view>

// The one place that holds the version: the build system and the installed package read it from these three lines.
#define SKELGEN_VERSION_MAJOR 0
#define SKELGEN_VERSION_MINOR 2
#define SKELGEN_VERSION_PATCH 0

#define SKELGEN_DETAIL_TEXT_OF(number) #number
#define SKELGEN_DETAIL_TEXT(number) SKELGEN_DETAIL_TEXT_OF(number)

namespace skelgen {

/// Semantic version of this library, "major.minor.patch".
inline constexpr std::string_view version = SKELGEN_DETAIL_TEXT(SKELGEN_VERSION_MAJOR) "." SKELGEN_DETAIL_TEXT(
    SKELGEN_VERSION_MINOR) "." SKELGEN_DETAIL_TEXT(SKELGEN_VERSION_PATCH);

} // namespace skelgen

#undef SKELGEN_DETAIL_TEXT
#undef SKELGEN_DETAIL_TEXT_OF
