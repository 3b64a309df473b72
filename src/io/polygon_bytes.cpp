#include "polygon_bytes.hpp"

#include <bit>
#include <cstdint>
#include <vector>

#include "binary_reader.hpp"

namespace skelgen::io::detail {
namespace {

template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

template <typename T>
std::vector<T> take(BinaryReader& reader) {
    const auto count = reader.read<std::uint64_t>();
    if (count > reader.bytes_left() / sizeof(T)) reader.fail("the mesh is cut short");
    std::vector<T> values(count);
    for (T& value : values) value = reader.read<T>();
    return values;
}

} // namespace

std::string to_bytes(const PolygonMesh& mesh) {
    std::string bytes;
    append(bytes, mesh.coordinates);
    append(bytes, mesh.corners);
    append(bytes, mesh.sizes);
    append(bytes, std::vector<int>{mesh.placeless});
    return bytes;
}

PolygonMesh polygons_from_bytes(std::string_view bytes) {
    BinaryReader reader(bytes, std::endian::native);
    PolygonMesh mesh;
    mesh.coordinates = take<double>(reader);
    mesh.corners = take<int>(reader);
    mesh.sizes = take<int>(reader);
    const std::vector<int> placeless = take<int>(reader);
    mesh.placeless = placeless.empty() ? 0 : placeless.front();
    return mesh;
}

} // namespace skelgen::io::detail
