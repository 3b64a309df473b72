#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "text_scanner.hpp"

namespace skelgen::io::detail {

enum class PlyEncoding { text, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] constexpr bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

[[nodiscard]] constexpr std::size_t size_of(PlyType type) {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
        return 4;
    case PlyType::float64:
        break;
    }
    return 8;
}

/// One value, or a list of values behind its length.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> length_type; ///< of a list
};

/// `count` rows of the same properties.
struct PlyElement {
    std::string name;
    std::int64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::text;
    std::vector<PlyElement> elements; ///< in the order of their rows
    std::string texture_file;         ///< "comment TextureFile NAME", as MeshLab has it; empty: none
};

/// Reads up to and with the line `end_header`. \throws Error bad_input
[[nodiscard]] PlyHeader parse_ply_header(TextScanner& scanner);

} // namespace skelgen::io::detail
