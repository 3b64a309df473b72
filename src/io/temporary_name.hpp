#pragma once

#include <filesystem>
#include <string>

#include <sys/types.h>

namespace skelgen::io::detail {

/// A name in the folder of `target` that no other thread, process or earlier call of this one uses.
[[nodiscard]] std::filesystem::path make_temporary_name(const std::filesystem::path& target);

/// The process that made the temporary name `name` (a file's name without its folder); 0 if it is none.
[[nodiscard]] ::pid_t temporary_name_owner(const std::string& name);

} // namespace skelgen::io::detail
