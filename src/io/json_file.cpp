#include "json_file.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

#include <skelgen/core/error.hpp>

namespace skelgen::detail {

std::string read_text_file(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) throw Error(ErrorCode::bad_input, "is a folder; give a file");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
    if (!file.is_open() || file.bad()) {
        const int reason = errno != 0 ? errno : EIO;
        throw Error(ErrorCode::bad_input, "cannot be read: " + std::generic_category().message(reason) +
                                              "; check the name and the permissions");
    }
    return text.str();
}

nlohmann::ordered_json parse_json(std::string_view text) {
    try {
        return nlohmann::ordered_json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorCode::bad_input, std::string("is no valid JSON (") + error.what() + "); repair it");
    }
}

} // namespace skelgen::detail
