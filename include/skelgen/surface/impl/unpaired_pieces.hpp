#pragma once

#include <skelgen/surface/unpaired_pieces.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/pieces.hpp>

namespace skelgen::surface {
namespace detail {

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

/// The pieces that pass a question.
template <typename Scalar, typename IsKept>
PairedPieces kept_pieces(const TriangleMesh<Scalar>& mesh, const std::vector<FaceSet<Scalar>>& pieces,
                         const IsKept& is_kept) {
    PairedPieces out;
    core::Accumulator area = 0, dropped = 0;
    std::vector<int> kept;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        area += pieces[i].area;
        if (is_kept(i)) {
            kept.insert(kept.end(), pieces[i].faces.begin(), pieces[i].faces.end());
            continue;
        }
        ++out.dropped;
        dropped += pieces[i].area;
    }
    out.left_out = area > 0 ? static_cast<double>(dropped / area) : 0;
    std::sort(kept.begin(), kept.end());
    out.faces = mesh.faces(kept, Eigen::all);
    return out;
}

} // namespace detail

template <typename Scalar>
std::optional<PairedPieces> without_lone_pieces(const TriangleMesh<Scalar>& mesh) {
    constexpr std::size_t most_pieces = 40;
    constexpr double least_area = 0.002, alike = 0.05; // of all, of the piece
    constexpr Scalar apart = Scalar(0.05), same_place = Scalar(0.03), through = Scalar(0.02),
                     beside = Scalar(0.06);                       // of the extent
    constexpr double least_left_out = 0.005, most_left_out = 0.5; // of the area
    using Plane = Eigen::Hyperplane<Scalar, 3>;
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
    const auto are_mirrored = [&](const auto& pair, const Plane& plane) {
        const Vector3<Scalar>& one = centres[pair.first];
        const Vector3<Scalar> mirrored = one - 2 * plane.signedDistance(one) * plane.normal();
        return (mirrored - centres[pair.second]).norm() < same_place * extent;
    };
    Plane middle;
    core::Accumulator most = 0;
    for (const auto& [a, b] : pairs) {
        const Plane plane(Vector3<Scalar>((centres[a] - centres[b]).normalized()),
                          Vector3<Scalar>((centres[a] + centres[b]) / 2));
        core::Accumulator support = 0;
        for (const auto& pair : pairs)
            if (are_mirrored(pair, plane)) support += pieces[pair.first].area + pieces[pair.second].area;
        for (std::size_t i = 0; i < large; ++i)
            if (plane.absDistance(centres[i]) < through * extent) support += pieces[i].area;
        if (support <= most) continue;
        most = support;
        middle = plane;
    }

    if (pairs.empty()) return std::nullopt;
    std::vector<bool> has_twin(pieces.size(), false);
    for (const auto& [a, b] : pairs) has_twin[a] = has_twin[b] = true;
    PairedPieces kept = detail::kept_pieces(
        mesh, pieces, [&](std::size_t i) { return has_twin[i] || middle.absDistance(centres[i]) <= beside * extent; });
    if (kept.left_out < least_left_out || kept.left_out > most_left_out) return std::nullopt;
    return kept;
}

} // namespace skelgen::surface
