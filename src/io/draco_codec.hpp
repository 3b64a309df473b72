#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace skelgen::io::detail {

/// An attribute of a Draco mesh to be decoded.
struct DracoAttribute {
    std::size_t id = 0; ///< its unique one
    std::size_t columns = 0;
};

/// What a Draco mesh holds.
struct DracoMesh {
    std::size_t points = 0;
    std::vector<std::array<std::size_t, 3>> triangles;
    std::vector<std::vector<double>> attributes; ///< in the order asked for; points x columns
};

/// Decodes a mesh of glTF's extension KHR_draco_mesh_compression.
/// \throws Error bad_input when it is damaged, lacks an attribute, or this build lacks Draco, which the message then
/// says.
[[nodiscard]] DracoMesh decode_draco(std::string_view bytes, const std::vector<DracoAttribute>& attributes);

} // namespace skelgen::io::detail
