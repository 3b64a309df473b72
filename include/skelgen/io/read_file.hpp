#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace skelgen::io {

/// Largest file that is read: 2 GiB.
inline constexpr std::size_t max_file_bytes = std::size_t{1} << 31U;

/// All bytes of a file. Pipes can be read too. Linear in the file's size.
/// \throws Error bad_input when there is no such file, it is a folder, is larger than `max_file_bytes`, or cannot be
/// read
///         to its end.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

} // namespace skelgen::io
