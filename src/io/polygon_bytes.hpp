#pragma once

#include <string>
#include <string_view>

#include <skelgen/io/polygon_mesh.hpp>

namespace skelgen::io::detail {

/// A mesh as bytes, to be sent from one process to another of the same program.
[[nodiscard]] std::string to_bytes(const PolygonMesh& mesh);

/// The mesh that `to_bytes` made into these bytes. \throws Error bad_input when they are cut short.
[[nodiscard]] PolygonMesh polygons_from_bytes(std::string_view bytes);

} // namespace skelgen::io::detail
