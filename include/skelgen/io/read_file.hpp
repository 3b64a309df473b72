#pragma once

#include <filesystem>
#include <string>

namespace skelgen::io {

/// All bytes of a file. Pipes can be read too. Linear in the file's size.
/// \throws Error bad_input when there is no such file, it is a folder, or it cannot be read to its end.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

} // namespace skelgen::io
