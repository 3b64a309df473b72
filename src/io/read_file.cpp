#include <skelgen/io/read_file.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>

#include <skelgen/core/error.hpp>

namespace skelgen::io {
namespace {

[[noreturn]] void throw_unreadable(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

[[noreturn]] void throw_too_large() { throw_unreadable("is larger than 2 GiB; simplify the mesh first"); }

} // namespace

std::string read_file(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) throw_unreadable("is a folder; name a file");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file)
        throw_unreadable("cannot be opened: " + std::generic_category().message(errno) +
                         "; check its name and permissions");

    // The size is a guess only: that of a pipe is unknown, and another program may be writing the file.
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > max_file_bytes) throw_too_large();
    constexpr std::size_t least_room = std::size_t{1} << 16U;
    std::string content(error ? least_room : std::max<std::size_t>(size + 1, least_room), '\0');
    std::size_t used = 0;
    while (const std::size_t got = std::fread(content.data() + used, 1, content.size() - used, file.get())) {
        used += got;
        if (used > max_file_bytes) throw_too_large();
        if (used == content.size()) content.resize(std::min(2 * used, max_file_bytes + 1));
    }
    if (std::ferror(file.get()) != 0) throw_unreadable("cannot be read to its end; check the disk or the network");
    content.resize(used);
    return content;
}

} // namespace skelgen::io
