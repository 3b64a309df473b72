#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// The corners of a triangle.
template <typename Scalar>
using Corners = std::array<Vector3<Scalar>, 3>;

/// Calls visit(Corners) for the faces of a mesh in their order, those with an edge longer than `longest` halved at
/// their longest edges until no part has one: the boxes of large faces would hold mostly what is far from them.
/// O(faces + area / longest^2), for faces that are not slivers.
template <typename Scalar, typename Visit>
void for_each_small_part(const TriangleMesh<Scalar>& mesh, Scalar longest, Visit&& visit) {
    std::vector<Corners<Scalar>> pending;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const auto corner = [&](int k) { return core::point(mesh.vertices, mesh.faces(f, k)); };
        pending.push_back({corner(0), corner(1), corner(2)});
        while (!pending.empty()) {
            const Corners<Scalar> t = pending.back();
            pending.pop_back();
            std::size_t k = 0; // the longest edge, from corner k to the next
            const auto squared = [&](std::size_t i) { return (t[(i + 1) % 3] - t[i]).squaredNorm(); };
            for (std::size_t i = 1; i < 3; ++i)
                if (squared(i) > squared(k)) k = i;
            if (squared(k) <= longest * longest) {
                visit(t);
                continue;
            }
            const Vector3<Scalar> middle = (t[k] + t[(k + 1) % 3]) / 2;
            pending.push_back({t[k], middle, t[(k + 2) % 3]});
            pending.push_back({middle, t[(k + 1) % 3], t[(k + 2) % 3]});
        }
    }
}

} // namespace skelgen::surface
