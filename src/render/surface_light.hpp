#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen::render {

/// Unit normals at the vertices (n x 3), out of the body even where the whole mesh is inside out; zero at vertices
/// without a face. O(faces).
[[nodiscard]] Points<double> outward_normals(const TriangleMesh<double>& mesh);

/// How much of the sky each vertex sees, 0 to 1: the light of an overcast day, which gives armpits and the space
/// between the legs their soft shadow. Independent of the view. O(faces) with a large constant.
[[nodiscard]] std::vector<double> ambient_light(const TriangleMesh<double>& mesh, const Points<double>& normals);

} // namespace skelgen::render
