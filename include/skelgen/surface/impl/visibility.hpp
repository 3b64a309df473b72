#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/face_tree.hpp>

namespace skelgen::surface {

/// What rays from some faces of a mesh meet: how many there were, and which part of them left from the front (where the
/// normal points) or the back and met nothing.
struct Visibility {
    int rays = 0; ///< from each side
    double front = 0, back = 0;
};

/// Looks out from up to `samples` of the given faces, spread evenly over the list: rays along the normal and slanted
/// around it, from both sides. `tree` as of the mesh. O(samples log faces).
template <typename Scalar>
Visibility look_out(const TriangleMesh<Scalar>& mesh, const FaceTree<Scalar>& tree, const std::vector<int>& faces,
                    int samples) {
    Visibility out;
    int front = 0, back = 0;
    const std::size_t stride = std::max<std::size_t>(1, faces.size() / static_cast<std::size_t>(samples));
    for (std::size_t i = stride / 2; i < faces.size(); i += stride) {
        const int f = faces[i];
        const Vector3<Scalar> area = core::face_area_vector(mesh, f);
        const Scalar length = area.norm();
        if (!(length > 0)) continue;
        const Vector3<Scalar> normal = area / length;
        const Vector3<Scalar> a = core::point(mesh.vertices, mesh.faces(f, 0)),
                              b = core::point(mesh.vertices, mesh.faces(f, 1)),
                              c = core::point(mesh.vertices, mesh.faces(f, 2));
        const Vector3<Scalar> centre = (a + b + c) / 3, along = (b - a).normalized(), across = normal.cross(along);
        // Off the face by more than rounding at its place, and by little for its size.
        const Scalar lift = std::max(std::sqrt(length) / 1000, core::rounding<Scalar>() * centre.norm());
        const std::array<Vector3<Scalar>, 4> slants{Vector3<Scalar>::Zero(), along,
                                                    Vector3<Scalar>(-along / 2 + across * Scalar(0.866)),
                                                    Vector3<Scalar>(-along / 2 - across * Scalar(0.866))};
        for (const Vector3<Scalar>& slant : slants) {
            const Vector3<Scalar> out_of_front = (normal + slant).normalized();
            const Vector3<Scalar> out_of_back = (slant - normal).normalized();
            front += tree.first_along(mesh, centre + lift * normal, out_of_front).face < 0;
            back += tree.first_along(mesh, centre - lift * normal, out_of_back).face < 0;
            ++out.rays;
        }
    }
    if (out.rays > 0) {
        out.front = static_cast<double>(front) / out.rays;
        out.back = static_cast<double>(back) / out.rays;
    }
    return out;
}

} // namespace skelgen::surface
