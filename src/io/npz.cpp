#include <skelgen/io/npz.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

#include <zlib.h>

#include <skelgen/core/error.hpp>

#include "little_endian.hpp"

namespace skelgen::io {
namespace {

using detail::append_little_endian;

/// The code points of a text in UTF-8; what is none is the replacement character.
std::vector<std::uint32_t> code_points(const std::string& text) {
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t at) -> std::uint32_t {
            return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
        };
        const std::uint32_t first = byte(i);
        const std::size_t more = first < 0x80 ? 0 : first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 4;
        std::uint32_t point = more == 0 ? first : first & (0x3fU >> more);
        std::size_t at = i + 1;
        for (; more < 4 && at <= i + more && (byte(at) & 0xc0U) == 0x80; ++at) point = point << 6U | (byte(at) & 0x3fU);
        out.push_back(more < 4 && at == i + more + 1 ? point : 0xfffdU);
        i = at;
    }
    return out;
}

std::string npy(const std::string& type, const std::vector<std::size_t>& shape, const std::string& data) {
    std::string sizes;
    for (const std::size_t size : shape) sizes += std::to_string(size) + ",";
    std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + sizes + "), }";
    constexpr std::size_t before = 10, aligned = 64; // what is before the header; where numpy wants the data
    while ((before + header.size() + 1) % aligned != 0) header += ' ';
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    append_little_endian(bytes, static_cast<std::uint16_t>(header.size()));
    return bytes + header + data;
}

std::string npy(const NpyArray& array) {
    std::size_t count = 1;
    for (const std::size_t size : array.shape) count *= size;
    if (std::max(array.numbers.size(), array.texts.size()) != count || (!array.numbers.empty() && !array.texts.empty()))
        throw Error(ErrorCode::usage, "an array has another number of entries than its shape");
    std::string data;
    if (array.texts.empty()) {
        for (const double number : array.numbers) append_little_endian(data, number);
        return npy("<f8", array.shape, data);
    }
    std::vector<std::vector<std::uint32_t>> texts;
    std::size_t longest = 1;
    for (const std::string& text : array.texts)
        longest = std::max(longest, texts.emplace_back(code_points(text)).size());
    for (std::vector<std::uint32_t>& text : texts) {
        text.resize(longest, 0);
        for (const std::uint32_t point : text) append_little_endian(data, point);
    }
    return npy("<U" + std::to_string(longest), array.shape, data);
}

/// What ZIP says of a file both before it and in the directory at the end.
void append_description(std::string& bytes, const std::string& name, const std::string& content) {
    constexpr std::uint16_t version = 20, first_of_1980 = 33;
    for (const std::uint16_t value : {version, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, first_of_1980})
        append_little_endian(bytes, value); // no flags, not compressed, and no time: equal arrays are equal bytes
    append_little_endian(
        bytes, static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size())));
    append_little_endian(bytes, static_cast<std::uint32_t>(content.size()));
    append_little_endian(bytes, static_cast<std::uint32_t>(content.size()));
    append_little_endian(bytes, static_cast<std::uint16_t>(name.size()));
    append_little_endian(bytes, std::uint16_t{0});
}

} // namespace

std::string format_npz(const std::vector<std::pair<std::string, NpyArray>>& arrays) {
    std::string bytes, directory;
    for (const auto& [array_name, array] : arrays) {
        const std::string name = array_name + ".npy", content = npy(array);
        const std::size_t at = bytes.size();
        if (at + content.size() + directory.size() > std::numeric_limits<std::uint32_t>::max() - 1000)
            throw Error(ErrorCode::usage, "the arrays are larger than an .npz file; write fewer bodies");
        bytes += "PK\x03\x04";
        append_description(bytes, name, content);
        bytes += name + content;
        directory += std::string("PK\x01\x02\x14\x00", 6);
        append_description(directory, name, content);
        directory += std::string(10, '\0'); // no comment, on the first disk, no attributes
        append_little_endian(directory, static_cast<std::uint32_t>(at));
        directory += name;
    }
    const std::size_t begin = bytes.size();
    bytes += directory + "PK\x05\x06" + std::string(4, '\0');
    for (int twice = 0; twice < 2; ++twice) append_little_endian(bytes, static_cast<std::uint16_t>(arrays.size()));
    append_little_endian(bytes, static_cast<std::uint32_t>(directory.size()));
    append_little_endian(bytes, static_cast<std::uint32_t>(begin));
    append_little_endian(bytes, std::uint16_t{0});
    return bytes;
}

} // namespace skelgen::io
