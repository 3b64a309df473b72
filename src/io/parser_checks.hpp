#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <skelgen/io/polygon_mesh.hpp>

/// Checks that all mesh parsers share. `Reader` is where the error is: a TextScanner or a BinaryReader.
namespace skelgen::io::detail {

/// A header's count, which must be one that the bytes left can hold: nothing is allocated on a lying header's word.
template <typename Reader>
std::size_t checked_count(const Reader& reader, std::int64_t count, std::size_t least_bytes, const char* what) {
    // One byte more: the last line may lack its end.
    if (count < 0 || count > std::numeric_limits<int>::max() ||
        static_cast<std::size_t>(count) > (reader.bytes_left() + 1) / least_bytes)
        reader.fail("the header promises " + std::to_string(count) + " " + what +
                    ", which a file of this size cannot hold");
    return static_cast<std::size_t>(count);
}

template <typename Reader>
int checked_index(const Reader& reader, std::int64_t index, std::size_t vertices) {
    if (index < 0 || index > std::numeric_limits<int>::max() || static_cast<std::size_t>(index) >= vertices)
        reader.fail("a face names vertex " + std::to_string(index) + " (counted from 0), but there are " +
                    std::to_string(vertices) + " vertices");
    return static_cast<int>(index);
}

template <typename Reader>
int checked_size(const Reader& reader, std::int64_t size) {
    if (size < 3 || size > max_face_corners)
        reader.fail("a face has " + std::to_string(size) + " corners; it must have 3 to " +
                    std::to_string(max_face_corners));
    return static_cast<int>(size);
}

/// Room for `faces` triangles.
inline void reserve(PolygonMesh& mesh, std::size_t vertices, std::size_t faces) {
    mesh.coordinates.reserve(3 * vertices);
    mesh.sizes.reserve(faces);
    mesh.corners.reserve(3 * faces);
}

} // namespace skelgen::io::detail
