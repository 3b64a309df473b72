#pragma once

#include <skelgen/applications/surface_labels.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <skelgen/applications/part_shares.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {

template <typename Scalar>
std::vector<int> smoothed_labels(const Body<Scalar>& body, const std::vector<int>& labels, int count, double length) {
    const Eigen::MatrixX<core::Accumulator> shares = part_shares(body, labels, count, length);
    std::vector<int> out;
    out.reserve(labels.size());
    for (Eigen::Index v = 0; v < shares.rows(); ++v) {
        Eigen::Index most = 0;
        shares.row(v).maxCoeff(&most);
        out.push_back(static_cast<int>(most));
    }
    return out;
}

template <typename Scalar>
std::vector<int> in_one_piece(const Body<Scalar>& body, const std::vector<int>& labels, int count) {
    std::vector<int> piece_of(labels.size(), -1);
    std::vector<std::vector<int>> pieces;
    for (std::size_t start = 0; start < labels.size(); ++start) {
        if (piece_of[start] >= 0) continue;
        const auto piece = static_cast<int>(pieces.size());
        std::vector<int> members{static_cast<int>(start)};
        piece_of[start] = piece;
        for (std::size_t i = 0; i < members.size(); ++i)
            for (const auto& [next, length] : body.graph.neighbours[static_cast<std::size_t>(members[i])])
                if (piece_of[static_cast<std::size_t>(next)] < 0 &&
                    labels[static_cast<std::size_t>(next)] == labels[start]) {
                    piece_of[static_cast<std::size_t>(next)] = piece;
                    members.push_back(next);
                }
        pieces.push_back(std::move(members));
    }
    const auto label_of = [&](std::size_t piece) { return labels[static_cast<std::size_t>(pieces[piece].front())]; };
    std::vector<int> largest(static_cast<std::size_t>(count), -1);
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
        int& most = largest[static_cast<std::size_t>(label_of(piece))];
        if (most < 0 || pieces[piece].size() > pieces[static_cast<std::size_t>(most)].size())
            most = static_cast<int>(piece);
    }
    std::vector<int> out = labels;
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
        if (largest[static_cast<std::size_t>(label_of(piece))] == static_cast<int>(piece)) continue;
        std::vector<int> votes(static_cast<std::size_t>(count), 0);
        for (const int v : pieces[piece])
            for (const auto& [next, length] : body.graph.neighbours[static_cast<std::size_t>(v)])
                if (labels[static_cast<std::size_t>(next)] != label_of(piece))
                    ++votes[static_cast<std::size_t>(labels[static_cast<std::size_t>(next)])];
        const auto most = std::max_element(votes.begin(), votes.end());
        if (*most == 0) continue; // a surface of its own
        for (const int v : pieces[piece]) out[static_cast<std::size_t>(v)] = static_cast<int>(most - votes.begin());
    }
    return out;
}

SKELGEN_INLINE std::vector<int> face_labels(const Triangles& faces, const std::vector<int>& vertex_labels) {
    std::vector<int> out;
    out.reserve(static_cast<std::size_t>(faces.rows()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const auto label = [&](int k) { return vertex_labels[static_cast<std::size_t>(faces(f, k))]; };
        out.push_back(label(1) == label(2) ? label(1) : label(0));
    }
    return out;
}

} // namespace skelgen::applications
