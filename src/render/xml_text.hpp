#pragma once

#include <string>
#include <string_view>

namespace skelgen::render {

/// `text` as XML character data or attribute value in UTF-8: special characters escaped, what XML cannot hold (control
/// characters, bytes that are no UTF-8) replaced by question marks.
[[nodiscard]] std::string xml_text(std::string_view text);

/// A number with at most two decimals, the same in every locale.
[[nodiscard]] std::string decimal(double value);

} // namespace skelgen::render
