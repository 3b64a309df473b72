#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <skelgen/applications/impl/part_shares.hpp>
#include <skelgen/applications/impl/short_borders.hpp>
#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// For each vertex the label of which there is most after random walks of that length (`part_shares`), with short
/// borders (`with_short_borders`). `labels`: one for each vertex of the body, of those that `mirrored` has an entry
/// for: the label on the other side, or itself; `length` in the body's unit. \throws Error as `part_shares`. O(n^1.5 +
/// n labels).
template <typename Scalar>
std::vector<int> smoothed_labels(const Body<Scalar>& body, const std::vector<int>& labels,
                                 const std::vector<int>& mirrored, double length) {
    const Eigen::MatrixX<core::Accumulator> shares =
        part_shares(body, labels, static_cast<int>(mirrored.size()), length);
    std::vector<int> out;
    out.reserve(labels.size());
    for (Eigen::Index v = 0; v < shares.rows(); ++v) {
        Eigen::Index most = 0;
        shares.row(v).maxCoeff(&most);
        out.push_back(static_cast<int>(most));
    }
    return with_short_borders(body, std::move(out), shares, length, mirrored);
}

namespace detail {

/// The pieces that vertices of one label hang together in, in the order of their first vertices.
template <typename Scalar>
std::vector<std::vector<int>> label_pieces(const Body<Scalar>& body, const std::vector<int>& labels) {
    std::vector<bool> seen(labels.size(), false);
    std::vector<std::vector<int>> pieces;
    for (std::size_t start = 0; start < labels.size(); ++start) {
        if (seen[start]) continue;
        std::vector<int> members{static_cast<int>(start)};
        seen[start] = true;
        for (std::size_t i = 0; i < members.size(); ++i)
            for (const auto& [next, length] : body.graph.neighbours[static_cast<std::size_t>(members[i])])
                if (!seen[static_cast<std::size_t>(next)] && labels[static_cast<std::size_t>(next)] == labels[start]) {
                    seen[static_cast<std::size_t>(next)] = true;
                    members.push_back(next);
                }
        pieces.push_back(std::move(members));
    }
    return pieces;
}

/// The label that most of what borders on a piece has; -1 where nothing does.
template <typename Scalar>
int label_around(const Body<Scalar>& body, const std::vector<int>& labels, int count, const std::vector<int>& piece) {
    const int own = labels[static_cast<std::size_t>(piece.front())];
    std::vector<int> votes(static_cast<std::size_t>(count), 0);
    for (const int v : piece)
        for (const auto& [next, length] : body.graph.neighbours[static_cast<std::size_t>(v)])
            if (const int other = labels[static_cast<std::size_t>(next)]; other != own)
                ++votes[static_cast<std::size_t>(other)];
    const auto most = std::max_element(votes.begin(), votes.end());
    return *most == 0 ? -1 : static_cast<int>(most - votes.begin());
}

} // namespace detail

/// Labels, as above, with each in one piece: of several pieces the one with the most vertices stays, the others, the
/// smallest first, take the label of most of what borders on them. O(pieces (n + count)).
template <typename Scalar>
std::vector<int> in_one_piece(const Body<Scalar>& body, const std::vector<int>& labels, int count) {
    std::vector<int> out = labels;
    for (;;) {
        // The smallest first: a strip of another label may be all that divides a part.
        const std::vector<std::vector<int>> pieces = detail::label_pieces(body, out);
        const auto label_of = [&](const std::vector<int>& piece) {
            return out[static_cast<std::size_t>(piece.front())];
        };
        std::vector<std::size_t> largest(static_cast<std::size_t>(count), 0);
        for (const std::vector<int>& piece : pieces) {
            std::size_t& most = largest[static_cast<std::size_t>(label_of(piece))];
            most = std::max(most, piece.size());
        }
        std::vector<bool> has_largest(static_cast<std::size_t>(count), false);
        const std::vector<int>* smallest = nullptr;
        int label = -1;
        for (const std::vector<int>& piece : pieces) {
            const auto own = static_cast<std::size_t>(label_of(piece));
            if (piece.size() == largest[own] && !has_largest[own]) {
                has_largest[own] = true;
                continue;
            }
            if (smallest != nullptr && piece.size() >= smallest->size()) continue;
            const int around = detail::label_around(body, out, count, piece);
            if (around < 0) continue; // a surface of its own
            smallest = &piece;
            label = around;
        }
        if (smallest == nullptr) return out;
        for (const int v : *smallest) out[static_cast<std::size_t>(v)] = label;
    }
}

/// Of each face the label of most of its corners, of three different ones that of the first. O(faces).
inline std::vector<int> face_labels(const Triangles& faces, const std::vector<int>& vertex_labels) {
    std::vector<int> out;
    out.reserve(static_cast<std::size_t>(faces.rows()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const auto label = [&](int k) { return vertex_labels[static_cast<std::size_t>(faces(f, k))]; };
        out.push_back(label(1) == label(2) ? label(1) : label(0));
    }
    return out;
}

} // namespace skelgen::applications
