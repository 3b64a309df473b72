#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skelgen::cli {

/// The word of a list that someone may have meant who has typed another one: with one letter in four, and a letter at
/// least, changed, lost, added or swapped with the next. Empty where none is so near. O(sum of lengths times length).
[[nodiscard]] std::string nearest_word(std::string_view typed, const std::vector<std::string>& words);

} // namespace skelgen::cli
