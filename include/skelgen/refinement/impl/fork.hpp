#pragma once

#include <skelgen/core/geometry.hpp>
#include <skelgen/refinement/fork.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace skelgen::refinement {

template <typename Scalar>
Points<Scalar> way_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a, const EndPoint<Scalar>& b,
                           Scalar reach, Scalar step) {
    const auto most = static_cast<int>(std::floor(reach / step));
    const auto count = static_cast<std::size_t>(2 * most + 1);
    std::vector<Scalar> nearest(count, std::numeric_limits<Scalar>::infinity());
    std::vector<Vector3<Scalar>> places(count);
    const auto difference = [&](int v) { return a.distance[v] - b.distance[v]; };
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            int u = mesh.faces(f, k), v = mesh.faces(f, (k + 1) % 3);
            if (difference(v) < difference(u)) std::swap(u, v);
            const Scalar at_u = difference(u), at_v = difference(v);
            if (!std::isfinite(at_u) || !std::isfinite(at_v) || at_u > reach || at_v < -reach) continue;
            const int last = std::min(most, static_cast<int>(std::floor(at_v / step)));
            for (int i = std::max(-most, static_cast<int>(std::ceil(at_u / step))); i <= last; ++i) {
                const Scalar level = static_cast<Scalar>(i) * step;
                const Scalar t = at_v > at_u ? (level - at_u) / (at_v - at_u) : Scalar(0);
                const Scalar distance = (1 - t) * a.distance[u] + t * a.distance[v];
                const auto slot = static_cast<std::size_t>(i + most);
                if (distance >= nearest[slot]) continue;
                nearest[slot] = distance;
                places[slot] = (1 - t) * core::point(mesh.vertices, u) + t * core::point(mesh.vertices, v);
            }
        }
    Points<Scalar> way(static_cast<Eigen::Index>(count), 3);
    Eigen::Index found = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (std::isfinite(nearest[i])) way.row(found++) = places[i].transpose();
    return way.topRows(found);
}

template <typename Scalar>
std::optional<Vector3<Scalar>> fork_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a,
                                            const EndPoint<Scalar>& b) {
    const Points<Scalar> way = way_between(mesh, a, b, Scalar(0), Scalar(1));
    if (way.rows() == 0) return std::nullopt;
    return core::point(way, 0);
}

template <typename Scalar>
Vector3<Scalar> highest_on(const Points<Scalar>& way, const Vector3<Scalar>& place, const Vector3<Scalar>& up) {
    const auto height = [&](Eigen::Index i) -> Scalar {
        const Vector3<Scalar> from = core::point(way, i) - place;
        const Scalar along = from.dot(up);
        return along - (from - along * up).norm();
    };
    Eigen::Index highest = 0;
    for (Eigen::Index i = 1; i < way.rows(); ++i)
        if (height(i) > height(highest)) highest = i;
    return core::point(way, highest);
}

} // namespace skelgen::refinement
