#pragma once

#include <skelgen/surface/unpaired_pieces.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/pieces.hpp>

namespace skelgen::surface {
namespace detail {

/// A plane through the middle of a body: points p with normal . p = offset.
template <typename Scalar>
struct MiddlePlane {
    Vector3<Scalar> normal = Vector3<Scalar>::UnitX();
    Scalar offset = 0;

    [[nodiscard]] Scalar distance(const Vector3<Scalar>& place) const { return normal.dot(place) - offset; }
    [[nodiscard]] Vector3<Scalar> mirrored(const Vector3<Scalar>& place) const {
        return place - 2 * distance(place) * normal;
    }
};

/// Where the area of a piece has its centre.
template <typename Scalar>
Vector3<Scalar> centre_of(const TriangleMesh<Scalar>& mesh, const FaceSet<Scalar>& piece) {
    Vector3<core::Accumulator> sum = Vector3<core::Accumulator>::Zero();
    for (const int f : piece.faces)
        for (int k = 0; k < 3; ++k)
            sum += core::face_area_vector(mesh, f).norm() *
                   core::point(mesh.vertices, mesh.faces(f, k)).template cast<core::Accumulator>();
    return (sum / (3 * std::max(piece.area, std::numeric_limits<core::Accumulator>::min()))).template cast<Scalar>();
}

} // namespace detail

template <typename Scalar>
std::optional<PairedPieces> without_lone_pieces(const TriangleMesh<Scalar>& mesh, Twins twins) {
    constexpr std::size_t most_pieces = 40;
    constexpr double least_area = 0.002, alike = 0.05; // of all, of the piece
    constexpr Scalar apart = Scalar(0.05), same_place = Scalar(0.03), through = Scalar(0.02),
                     beside = Scalar(0.06);                       // of the extent
    constexpr double least_left_out = 0.005, most_left_out = 0.5; // of the area
    const std::vector<detail::FaceSet<Scalar>> pieces = detail::connected_sets(mesh);
    core::Accumulator area = 0;
    Eigen::AlignedBox<Scalar, 3> box;
    std::vector<Vector3<Scalar>> centres;
    for (const auto& piece : pieces) {
        area += piece.area;
        box.extend(piece.box);
        centres.push_back(detail::centre_of(mesh, piece));
    }
    const Scalar extent = pieces.empty() ? Scalar(0) : box.sizes().maxCoeff();
    std::size_t large = 0;
    while (large < std::min(most_pieces, pieces.size()) && pieces[large].area > least_area * area) ++large;

    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < large; ++a)
        for (std::size_t b = a + 1; b < large; ++b)
            if (pieces[a].faces.size() == pieces[b].faces.size() &&
                pieces[a].area - pieces[b].area < alike * pieces[a].area &&
                (centres[a] - centres[b]).norm() > apart * extent)
                pairs.emplace_back(a, b);
    const auto are_mirrored = [&](const auto& pair, const detail::MiddlePlane<Scalar>& plane) {
        return (plane.mirrored(centres[pair.first]) - centres[pair.second]).norm() < same_place * extent;
    };
    detail::MiddlePlane<Scalar> middle;
    core::Accumulator most = 0;
    for (const auto& [a, b] : pairs) {
        detail::MiddlePlane<Scalar> plane{(centres[a] - centres[b]).normalized()};
        plane.offset = plane.normal.dot(centres[a] + centres[b]) / 2;
        core::Accumulator support = 0;
        for (const auto& pair : pairs)
            if (are_mirrored(pair, plane)) support += pieces[pair.first].area + pieces[pair.second].area;
        for (std::size_t i = 0; i < large; ++i)
            if (std::abs(plane.distance(centres[i])) < through * extent) support += pieces[i].area;
        if (support <= most) continue;
        most = support;
        middle = plane;
    }
    if (pairs.empty()) return std::nullopt;

    std::vector<bool> is_paired(pieces.size(), false);
    for (const auto& pair : pairs)
        if (twins == Twins::alike || are_mirrored(pair, middle)) is_paired[pair.first] = is_paired[pair.second] = true;
    PairedPieces out;
    core::Accumulator dropped = 0;
    std::vector<int> kept;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (is_paired[i] || std::abs(middle.distance(centres[i])) <= beside * extent) {
            kept.insert(kept.end(), pieces[i].faces.begin(), pieces[i].faces.end());
            continue;
        }
        ++out.dropped;
        dropped += pieces[i].area;
    }
    out.left_out = static_cast<double>(dropped / area);
    if (out.left_out < least_left_out || out.left_out > most_left_out) return std::nullopt;
    std::sort(kept.begin(), kept.end());
    out.faces.resize(static_cast<Eigen::Index>(kept.size()), 3);
    for (std::size_t i = 0; i < kept.size(); ++i) out.faces.row(static_cast<Eigen::Index>(i)) = mesh.faces.row(kept[i]);
    return out;
}

} // namespace skelgen::surface
