#include "glb_container.hpp"

#include <cstdint>
#include <limits>

#include <skelgen/core/error.hpp>

#include "little_endian.hpp"

namespace skelgen::io::detail {
namespace {

constexpr std::size_t word = 4; // chunks are of whole ones

std::size_t padded(std::size_t bytes) { return (bytes + word - 1) / word * word; }

void append_chunk(std::string& bytes, const char* type, std::string_view content, char filler) {
    append_little_endian(bytes, static_cast<std::uint32_t>(padded(content.size())));
    bytes.append(type, word);
    bytes += content;
    bytes.append(padded(content.size()) - content.size(), filler);
}

} // namespace

std::string format_glb_container(std::string json, std::string_view data) {
    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    const std::size_t size = header_bytes + 2 * chunk_header_bytes + padded(json.size()) + padded(data.size());
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::usage, "the scene is larger than the 4 GiB that GLB can hold; simplify the mesh");
    std::string bytes = "glTF";
    append_little_endian(bytes, std::uint32_t{2});
    append_little_endian(bytes, static_cast<std::uint32_t>(size));
    append_chunk(bytes, "JSON", json, ' ');
    append_chunk(bytes, "BIN\0", data, '\0');
    return bytes;
}

} // namespace skelgen::io::detail
