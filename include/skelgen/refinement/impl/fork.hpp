#pragma once

#include <skelgen/core/geometry.hpp>
#include <skelgen/refinement/fork.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace skelgen::refinement {

template <typename Scalar>
std::vector<Crossing<Scalar>> crossings_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a,
                                                const EndPoint<Scalar>& b, Scalar reach, Scalar step) {
    const auto most = static_cast<int>(std::floor(reach / step));
    std::vector<Crossing<Scalar>> out;
    const auto difference = [&](int v) { return a.distance[v] - b.distance[v]; };
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        const Scalar d0 = difference(mesh.faces(f, 0)), d1 = difference(mesh.faces(f, 1)),
                     d2 = difference(mesh.faces(f, 2));
        if ((d0 > reach && d1 > reach && d2 > reach) || (d0 < -reach && d1 < -reach && d2 < -reach)) continue;
        for (int k = 0; k < 3; ++k) {
            int u = mesh.faces(f, k), v = mesh.faces(f, (k + 1) % 3);
            if (difference(v) < difference(u)) std::swap(u, v);
            const Scalar at_u = difference(u), at_v = difference(v);
            if (!std::isfinite(at_u) || !std::isfinite(at_v) || at_u > reach || at_v < -reach) continue;
            const int last = std::min(most, static_cast<int>(std::floor(at_v / step)));
            for (int i = std::max(-most, static_cast<int>(std::ceil(at_u / step))); i <= last; ++i) {
                const Scalar level = static_cast<Scalar>(i) * step;
                const Scalar t = at_v > at_u ? (level - at_u) / (at_v - at_u) : Scalar(0);
                out.push_back({i, (1 - t) * a.distance[u] + t * a.distance[v],
                               (1 - t) * core::point(mesh.vertices, u) + t * core::point(mesh.vertices, v)});
            }
        }
    }
    return out;
}

template <typename Scalar>
std::optional<Vector3<Scalar>> fork_between(const TriangleMesh<Scalar>& mesh, const EndPoint<Scalar>& a,
                                            const EndPoint<Scalar>& b) {
    const auto crossings = crossings_between(mesh, a, b, Scalar(0), Scalar(1));
    const auto nearest = std::min_element(crossings.begin(), crossings.end(),
                                          [](const auto& p, const auto& q) { return p.way < q.way; });
    if (nearest == crossings.end()) return std::nullopt;
    return nearest->place;
}

template <typename Scalar>
Vector3<Scalar> fork_along(const std::vector<Crossing<Scalar>>& crossings, const Vector3<Scalar>& place,
                           const Vector3<Scalar>& up) {
    struct Lowest {
        Scalar cost;
        const Crossing<Scalar>* crossing;
    };
    std::map<int, Lowest> levels;
    for (const Crossing<Scalar>& crossing : crossings) {
        const Scalar cost = crossing.way + (crossing.place - place).dot(up);
        const auto [level, is_first] = levels.try_emplace(crossing.level, Lowest{cost, &crossing});
        if (!is_first && cost < level->second.cost) level->second = {cost, &crossing};
    }
    const auto height = [&](const auto& level) -> Scalar {
        const Vector3<Scalar> from = level.second.crossing->place - place;
        const Scalar along = from.dot(up);
        return along - (from - along * up).norm();
    };
    const auto highest = std::max_element(levels.begin(), levels.end(),
                                          [&](const auto& a, const auto& b) { return height(a) < height(b); });
    return highest->second.crossing->place;
}

} // namespace skelgen::refinement
