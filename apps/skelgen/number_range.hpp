#pragma once

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>

namespace skelgen::cli {

/// Checks that an option's number is in a range; CLI::Range takes NaN for in any.
inline CLI::Validator number_range(double least, double most) {
    const CLI::Range range(least, most);
    const auto check = [range](const std::string& text) {
        double number = 0;
        if (CLI::detail::lexical_cast(text, number) && std::isnan(number)) return "'" + text + "' is no number";
        return range(text);
    };
    return CLI::Validator(check, range.get_description());
}

} // namespace skelgen::cli
