#pragma once

#include <string>
#include <variant>

#include <skelgen/core/mesh.hpp>
#include <skelgen/render/scene.hpp>

namespace skelgen::render {

/// Directions relative to the body: `side` is from the person's own left, `top` from above the head.
enum class NamedView { front, back, side, top, three_quarter };

/// Where a picture is taken from: a direction of the body, or the vector towards the viewer in mesh coordinates.
using View = std::variant<NamedView, Vector3<double>>;

/// Reads `front`, `back`, `side`, `top`, `three-quarter` or three numbers `x,y,z`.
/// \throws Error usage when `text` is neither, or all three numbers are zero.
[[nodiscard]] View parse_view(const std::string& text);

/// An orthographic camera: three orthonormal axes with right x up = toward, so no picture is ever mirrored.
struct Camera {
    Vector3<double> right = Vector3<double>::UnitX();
    Vector3<double> up = Vector3<double>::UnitY();
    Vector3<double> toward = Vector3<double>::UnitZ(); ///< from the scene to the viewer
};

/// The camera of a view. The body's own directions are the skeleton's frame; without a skeleton the principal axes of
/// the mesh stand in: the longest is up, the shortest points forward, and both signs are arbitrary but fixed.
/// O(vertices).
[[nodiscard]] Camera look_at(const Scene& scene, const View& view);

} // namespace skelgen::render
