#include "gltf_component.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "binary_reader.hpp"

namespace skelgen::io::detail {
namespace {

template <typename T>
double read_number(BinaryReader& reader, bool normalized) {
    const auto value = static_cast<double>(reader.read<T>());
    if (!normalized || !std::numeric_limits<T>::is_integer) return value;
    return std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double read_component(BinaryReader& reader, int type, bool normalized) {
    switch (type) {
    case 5120:
        return read_number<std::int8_t>(reader, normalized);
    case 5121:
        return read_number<std::uint8_t>(reader, normalized);
    case 5122:
        return read_number<std::int16_t>(reader, normalized);
    case 5123:
        return read_number<std::uint16_t>(reader, normalized);
    case 5125:
        return read_number<std::uint32_t>(reader, normalized);
    default:
        return read_number<float>(reader, normalized);
    }
}

} // namespace

std::size_t component_bytes(int component_type, const GltfValue& place) {
    switch (component_type) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    case 5125:
    case 5126:
        return 4;
    default:
        place.fail("has the component type " + std::to_string(component_type) + ", which glTF does not have");
    }
}

std::size_t component_count(const GltfValue& type) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 5> counts{
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};
    for (const auto& [name, count] : counts)
        if (type.text() == name) return count;
    type.fail("is '" + type.text() + "'; of a mesh it must be SCALAR, VEC2, VEC3, VEC4 or MAT4");
}

GltfArray read_rows(GltfArray array, std::string_view bytes, const GltfRows& rows, const GltfValue& place) {
    const std::size_t row_bytes = array.columns * component_bytes(rows.component_type, place);
    const std::size_t stride = rows.stride == 0 ? row_bytes : rows.stride;
    if (stride < row_bytes) place.fail("has rows that overlap: its byteStride is too small");
    // Divided, not multiplied: no count of a file makes this overflow.
    const bool fits = array.rows == 0 || (rows.offset <= bytes.size() && row_bytes <= bytes.size() - rows.offset &&
                                          array.rows - 1 <= (bytes.size() - rows.offset - row_bytes) / stride);
    if (!fits) place.fail("reaches beyond its bytes");

    array.values.reserve(array.rows * array.columns);
    for (std::size_t row = 0; row < array.rows; ++row) {
        BinaryReader reader(bytes.substr(rows.offset + row * stride, row_bytes), std::endian::little, "scene");
        for (std::size_t column = 0; column < array.columns; ++column)
            array.values.push_back(read_component(reader, rows.component_type, rows.normalized));
    }
    return array;
}

} // namespace skelgen::io::detail
