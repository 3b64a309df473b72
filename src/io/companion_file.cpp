#include "companion_file.hpp"

#include <algorithm>
#include <system_error>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

namespace skelgen::io::detail {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& reference, const std::string& message) {
    throw Error(ErrorCode::bad_input, "the scene's file '" + reference + "' " + message);
}

bool is_below(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

} // namespace

std::string read_companion(const fs::path& folder, const std::string& reference) {
    std::error_code error;
    const fs::path base = fs::canonical(folder.empty() ? "." : folder, error);
    const fs::path path = fs::weakly_canonical(base / reference, error);
    if (error || reference.empty() || reference.find('\0') != std::string::npos || !is_below(path, base))
        refuse(reference, "is not in the scene's own folder; put it there");
    if (!fs::is_regular_file(path, error)) refuse(reference, "is missing; put it beside the scene");
    try {
        return read_file(path);
    } catch (const Error& failure) {
        refuse(reference, failure.what());
    }
}

std::string refuse_companion(const std::string& reference) {
    throw Error(ErrorCode::bad_input,
                "the scene refers to a file beside it, '" + reference +
                    "', which cannot be looked for here; name the scene's own file, or export it as GLB");
}

} // namespace skelgen::io::detail
