#pragma once

#include <sstream>
#include <string_view>

#include <skelgen/core/error.hpp>

namespace skelgen::core {

/// For the options that stages take. \throws Error usage with the range in its text when `value` is not from `least` to
/// `most`, or is no number.
template <typename Number>
void require_in_range(std::string_view option, Number value, Number least, Number most) {
    if (value >= least && value <= most) return;
    std::ostringstream text;
    text << "option " << option << " is " << value << ": it must be from " << least << " to " << most;
    throw Error(ErrorCode::usage, text.str());
}

} // namespace skelgen::core
