#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "gltf_data.hpp"
#include "scene_pose.hpp"

namespace skelgen::io::detail {

/// The vertices of a primitive.
struct GltfVertices {
    std::vector<Eigen::Vector3d> positions; ///< morphed, not yet skinned
    std::size_t influences = 0;             ///< of every vertex
    std::vector<Influence> joints;          ///< positions x influences; indices into the skin's joints

    [[nodiscard]] std::span<const Influence> influences_of(std::size_t vertex) const {
        return std::span(joints).subspan(vertex * influences, influences);
    }
};

/// A primitive: triangles, of its own vertices or of those of an earlier primitive of its mesh.
struct GltfPrimitive {
    GltfVertices vertices;
    std::vector<std::array<std::size_t, 3>> triangles;
};

/// Whether a primitive is made of triangles, in one of glTF's three ways; else of points or lines.
[[nodiscard]] bool has_triangles(const GltfValue& primitive);

/// What tells a primitive's vertices from those of other ones: primitives with the same key share their vertices.
[[nodiscard]] std::string vertex_key(const GltfValue& primitive);

/// Reads a primitive that has triangles. `morph_weights`: of its targets; those that are missing are 0.
/// \throws Error bad_input when its parts do not hold together or an index names no vertex.
[[nodiscard]] GltfPrimitive read_primitive(GltfData& data, const GltfValue& primitive,
                                           const std::vector<double>& morph_weights);

/// The normals of a primitive's vertices, morphed, not yet skinned; none where it has none. \throws Error bad_input
/// when their parts do not hold together.
[[nodiscard]] std::vector<Eigen::Vector3d> read_normals(GltfData& data, const GltfValue& primitive,
                                                        const std::vector<double>& morph_weights);

/// One row per vertex.
using TextureCoordinates = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The sets of texture coordinates that a primitive has, in their order. \throws Error bad_input when their parts do
/// not hold together.
[[nodiscard]] std::vector<TextureCoordinates> read_texture_coordinates(GltfData& data, const GltfValue& primitive);

/// One row per vertex: red, green, blue and alpha.
using VertexColours = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// The colours of a primitive's vertices, 0 to 1; no rows where it has none. \throws Error as
/// `read_texture_coordinates`.
[[nodiscard]] VertexColours read_colours(GltfData& data, const GltfValue& primitive);

} // namespace skelgen::io::detail
