#include "xml_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace skelgen::render {
namespace {

/// Length of the UTF-8 sequence at the start of `text`, 0 if there is none that XML allows. Overlong forms of
/// two bytes are refused; surrogates and longer overlong forms too.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
    const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0U) != 0x80U) return 0;
    const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
    const bool surrogate = lead == 0xED && byte(1) > 0x9F;
    const bool beyond_unicode = lead == 0xF4 && byte(1) > 0x8F;
    const bool non_character = lead == 0xEF && byte(1) == 0xBF && byte(2) > 0xBD; // U+FFFE, U+FFFF
    return overlong || surrogate || beyond_unicode || non_character ? 0 : length;
}

} // namespace

std::string xml_text(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0)
            out += '?';
        else if (text[0] == '&')
            out += "&amp;";
        else if (text[0] == '<')
            out += "&lt;";
        else if (text[0] == '>')
            out += "&gt;";
        else if (text[0] == '"')
            out += "&quot;";
        else
            out += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return out;
}

std::string decimal(double value) {
    const double rounded = std::round(value * 100) / 100;
    std::array<char, 64> buffer{};
    // Adding zero turns a negative zero into a plain one.
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded + 0.0);
    return {buffer.data(), result.ptr};
}

} // namespace skelgen::render
