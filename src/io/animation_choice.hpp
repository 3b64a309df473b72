#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skelgen::io::detail {

/// Which of the animations with these names `choice` means: the first of that name or, where none has it, the one of
/// that number, counted from 1.
/// \throws Error usage, listing the names, when there is none.
[[nodiscard]] std::size_t choose_animation(const std::vector<std::string>& names, const std::string& choice);

} // namespace skelgen::io::detail
