#pragma once

#include <filesystem>
#include <string>

namespace skelgen::io::detail {

/// Reads the file that a scene in `folder` refers to, relative to it. It must be a regular file in that folder or
/// below, also by where symbolic links lead: a scene from elsewhere must not get hold of others. \throws Error
/// bad_input naming the reference when it leads elsewhere or cannot be read.
[[nodiscard]] std::string read_companion(const std::filesystem::path& folder, const std::string& reference);

/// In place of `read_companion` where only a scene's content is known. \throws Error bad_input, always, saying so.
[[noreturn]] std::string refuse_companion(const std::string& reference);

} // namespace skelgen::io::detail
