#pragma once

#include <skelgen/surface/pockets.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/parallel.hpp>
#include <skelgen/surface/impl/without_faces.hpp>

namespace skelgen::surface {
namespace detail {

/// How far from each other a pocket's walls are at most, in units of the square root of the area, 1.34 m on an adult: a
/// mouth wide open is 6 cm high. A working value.
inline constexpr double widest_pocket = 0.06;

/// Of the surface, below which a pocket draws no curve aside: a fifth of a mouth's cavity. A working value.
inline constexpr double least_pocket = 0.001;

/// How many times as much surface a pocket has as a flat lid on its mouth. No patch that can be unrolled, as the two
/// sides of a gap between limbs together, has more than once that (the isoperimetric inequality), half a sphere has
/// twice that.
inline constexpr double deeper_than_wide = 3;

/// Faces that are asked first whether another one is opposite; those beside one that has are asked as well. Of the
/// smallest pocket it is one or two.
inline constexpr Eigen::Index first_asked = 1000;

/// Does a face see another one before it, across less than a pocket's width?
template <typename Scalar>
bool is_facing(const Body<Scalar>& body, Eigen::Index f) {
    const TriangleMesh<Scalar>& mesh = body.mesh;
    const Vector3<Scalar> across = core::face_area_vector(mesh, f);
    const Scalar length = across.norm();
    if (!(length > 0)) return false;
    const Vector3<Scalar> normal = across / length;
    const Vector3<Scalar> centre =
        (core::point(mesh.vertices, mesh.faces(f, 0)) + core::point(mesh.vertices, mesh.faces(f, 1)) +
         core::point(mesh.vertices, mesh.faces(f, 2))) /
        3;
    const Vector3<Scalar> lifted = centre + std::sqrt(length) / 1000 * normal;
    const auto hit = body.tree.first_along(mesh, lifted, normal, static_cast<Scalar>(widest_pocket));
    return hit.face >= 0 && core::face_area_vector(mesh, hit.face).dot(normal) < 0;
}

/// Those that do, as connected groups. Groups that hold none of the first faces asked are not found.
template <typename Scalar>
std::vector<std::vector<int>> facing_groups(const Body<Scalar>& body) {
    const Eigen::Index faces = body.mesh.faces.rows();
    const Eigen::Index stride = std::max<Eigen::Index>(1, faces / first_asked);
    constexpr std::size_t in_a_row = 64;
    std::vector<std::uint8_t> first_facing(static_cast<std::size_t>((faces - stride / 2 + stride - 1) / stride));
    core::parallel_for(first_facing.size(), in_a_row, [&](std::size_t i) {
        first_facing[i] = is_facing(body, stride / 2 + static_cast<Eigen::Index>(i) * stride) ? 1 : 0;
    });
    std::vector<bool> is_known(static_cast<std::size_t>(faces), false);
    std::vector<std::vector<int>> groups;
    for (std::size_t i = 0; i < first_facing.size(); ++i) {
        const auto first = static_cast<std::size_t>(stride / 2) + i * static_cast<std::size_t>(stride);
        if (first_facing[i] == 0 || is_known[first]) continue;
        is_known[first] = true;
        std::vector<int> group{static_cast<int>(first)};
        for (std::size_t g = 0; g < group.size(); ++g)
            for (int k = 0; k < 3; ++k) {
                const int next = body.adjacency(group[g], k);
                if (next < 0 || is_known[static_cast<std::size_t>(next)]) continue;
                is_known[static_cast<std::size_t>(next)] = true;
                if (is_facing(body, next)) group.push_back(next);
            }
        groups.push_back(std::move(group));
    }
    return groups;
}

/// A group of faces with what it encloses of the surface, such as the bottom of a pocket, which looks out of it: parts
/// of the rest that are no larger than the group. O(faces of the group), besides a byte for each face of the surface.
inline std::vector<int> with_enclosed(const std::vector<int>& group, const Triangles& adjacency) {
    enum class Side : std::uint8_t { unknown, inside, outside };
    std::vector<Side> places(static_cast<std::size_t>(adjacency.rows()), Side::unknown);
    const auto place = [&](int f) -> Side& { return places[static_cast<std::size_t>(f)]; };
    for (const int f : group) place(f) = Side::inside;
    /// From a face on, until the part ends, or is too large, or known to be outside.
    const auto part_from = [&](int first) {
        std::vector<int> part{first};
        place(first) = Side::inside;
        bool is_outside = false;
        for (std::size_t i = 0; i < part.size() && !is_outside; ++i) {
            is_outside = part.size() > group.size();
            for (int k = 0; k < 3; ++k) {
                const int next = adjacency(part[i], k);
                if (next < 0 || place(next) == Side::outside) is_outside = true;
                if (next < 0 || place(next) != Side::unknown) continue;
                place(next) = Side::inside;
                part.push_back(next);
            }
        }
        if (is_outside)
            for (const int f : part) place(f) = Side::outside;
        return is_outside ? std::vector<int>{} : part;
    };
    std::vector<int> out = group;
    for (const int f : group)
        for (int k = 0; k < 3; ++k) {
            const int next = adjacency(f, k);
            if (next < 0 || place(next) != Side::unknown) continue;
            const std::vector<int> part = part_from(next);
            out.insert(out.end(), part.begin(), part.end());
        }
    return out;
}

/// Does a group of faces enclose a space outside the surface, behind a mouth that is narrow for it?
template <typename Scalar>
bool is_pocket(const Body<Scalar>& body, const std::vector<int>& group) {
    const TriangleMesh<Scalar>& mesh = body.mesh;
    std::vector<bool> in_group(static_cast<std::size_t>(mesh.faces.rows()), false);
    for (const int f : group) in_group[static_cast<std::size_t>(f)] = true;
    core::Accumulator area = 0, rim = 0;
    Vector3<Scalar> middle = Vector3<Scalar>::Zero(); // of the rim
    for (const int f : group) {
        area += core::face_area_vector(mesh, f).norm();
        for (int k = 0; k < 3; ++k) {
            const int next = body.adjacency(f, k);
            if (next < 0) return false;
            if (in_group[static_cast<std::size_t>(next)]) continue;
            const Vector3<Scalar> a = core::point(mesh.vertices, mesh.faces(f, k)),
                                  b = core::point(mesh.vertices, mesh.faces(f, (k + 1) % 3));
            rim += (b - a).norm();
            middle += (b - a).norm() * (a + b) / 2;
        }
    }
    if (!(area > least_pocket) || !(rim > 0)) return false;
    if (area < deeper_than_wide * rim * rim / (4 * std::numbers::pi)) return false;
    middle /= static_cast<Scalar>(rim);
    core::Accumulator volume = 0; // between the faces and a lid of triangles with the middle of the rim: three times
    for (const int f : group)
        volume += core::face_area_vector(mesh, f).dot(core::point(mesh.vertices, mesh.faces(f, 0)) - middle);
    return volume < 0;
}

/// The pockets of a body, and the faces in them.
struct Pockets {
    int count = 0;
    std::vector<bool> has_face;
};

/// Larger groups first: what one of them encloses is part of its pocket, and none by itself.
template <typename Scalar>
Pockets find_pockets(const Body<Scalar>& body) {
    const auto area_of = [&](const std::vector<int>& faces) {
        core::Accumulator area = 0;
        for (const int f : faces) area += core::face_area_vector(body.mesh, f).norm();
        return area;
    };
    std::vector<std::vector<int>> groups = facing_groups(body);
    std::erase_if(groups, [&](const std::vector<int>& group) { return area_of(group) < least_pocket / 2; });
    std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    Pockets out{0, std::vector<bool>(static_cast<std::size_t>(body.mesh.faces.rows()), false)};
    for (const std::vector<int>& group : groups) {
        if (out.has_face[static_cast<std::size_t>(group.front())]) continue;
        const std::vector<int> whole = with_enclosed(group, body.adjacency);
        if (!is_pocket(body, whole)) continue;
        ++out.count;
        for (const int f : whole) out.has_face[static_cast<std::size_t>(f)] = true;
    }
    return out;
}

} // namespace detail

template <typename Scalar>
std::optional<Body<Scalar>> close_pockets(const Body<Scalar>& body) {
    const detail::Pockets pockets = detail::find_pockets(body);
    if (pockets.count == 0) return std::nullopt;
    Body<Scalar> out = without_faces(body, pockets.has_face);
    out.repairs.push_back("cavities closed: " + std::to_string(pockets.count));
    return out;
}

} // namespace skelgen::surface
