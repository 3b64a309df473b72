#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skelgen::io::detail {

/// Which of some extensions (".off": in lower case) a file's name has, whatever its case; none if it has another one.
inline std::optional<std::size_t> find_extension(const std::filesystem::path& path,
                                                 std::span<const std::string_view> extensions) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const auto found = std::find(extensions.begin(), extensions.end(), extension);
    if (found == extensions.end()) return std::nullopt;
    return static_cast<std::size_t>(found - extensions.begin());
}

} // namespace skelgen::io::detail
