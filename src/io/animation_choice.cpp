#include "animation_choice.hpp"

#include <algorithm>
#include <charconv>

#include <skelgen/core/error.hpp>

namespace skelgen::io::detail {

std::size_t choose_animation(const std::vector<std::string>& names, const std::string& choice) {
    const auto found = std::find(names.begin(), names.end(), choice);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());

    std::size_t number = 0;
    const char* const end = choice.data() + choice.size();
    const auto parsed = std::from_chars(choice.data(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end && number >= 1 && number <= names.size()) return number - 1;

    if (names.empty()) throw Error(ErrorCode::usage, "has no animations; leave the option out");
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
    throw Error(ErrorCode::usage, "has no animation '" + choice + "'; choose one of " + list +
                                      ", or its number from 1 to " + std::to_string(names.size()));
}

} // namespace skelgen::io::detail
