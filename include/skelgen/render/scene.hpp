#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::render {

/// A point worth pointing at, such as a reference joint: drawn as a small red cross on top of everything.
struct Mark {
    std::string name;
    Vector3<double> position = Vector3<double>::Zero();
};

/// What a picture shows, all of it in the mesh's own coordinates. Everything is optional, even the mesh: a picture of
/// nothing but its failure is a legitimate cell of a contact sheet.
struct Scene {
    TriangleMesh<double> mesh;
    std::optional<CurveSkeleton<double>> curve;
    std::optional<KinematicSkeleton<double>> skeleton;
    std::vector<Mark> marks;
    std::string caption; ///< below the picture, UTF-8; letters outside ASCII show as boxes in a PNG
    std::string failure; ///< why something is missing: below the caption in red, and a red frame around the picture
    /// Red, green and blue for each vertex: such a body is opaque but over its skeleton; none at all: translucent skin.
    std::vector<std::array<std::uint8_t, 3>> colours;
};

} // namespace skelgen::render
