#pragma once

#include <skelgen/applications/segmentation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/part_shares.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>

namespace skelgen::applications {
namespace detail {

inline constexpr std::array<std::string_view, 5> trunk_parts{"head", "neck", "chest", "abdomen", "pelvis"};
inline constexpr std::array<std::string_view, 7> sided_parts{"shoulder", "upper_arm", "forearm", "hand",
                                                             "thigh",    "calf",      "foot"};
inline constexpr std::array<std::string_view, 2> sides{"left_", "right_"};

/// Which end of the body a part is on; a part of the trunk is on none.
enum class LimbEnd { none, head, left_hand, right_hand, left_foot, right_foot };

/// Index of a part of the set `bones`; `side` 0 for left.
inline int trunk_part(std::string_view name) {
    return static_cast<int>(std::find(trunk_parts.begin(), trunk_parts.end(), name) - trunk_parts.begin());
}
inline int sided_part(std::string_view name, std::size_t side) {
    return static_cast<int>(trunk_parts.size() + side * sided_parts.size()) +
           static_cast<int>(std::find(sided_parts.begin(), sided_parts.end(), name) - sided_parts.begin());
}

/// A place on the skeleton and how thick the body is there.
template <typename Scalar>
struct AxisPoint {
    Vector3<Scalar> place;
    Scalar radius = 0;
};

template <typename Scalar>
AxisPoint<Scalar> between(const AxisPoint<Scalar>& a, const AxisPoint<Scalar>& b, Scalar along) {
    return {a.place + along * (b.place - a.place), a.radius + along * (b.radius - a.radius)};
}

/// A straight piece of the skeleton and the part around it.
template <typename Scalar>
struct PartAxis {
    int part = 0;
    LimbEnd end = LimbEnd::none; ///< vertices nearest to this end alone may belong to it; none: all
    AxisPoint<Scalar> from, to;
    Scalar reluctance_before = Scalar(0.05); ///< see `distance_to_axis`
};

/// The axes of all parts. Between two joints of the trunk, parts meet half-way: what a waist or a chest is lies around
/// its joint.
template <typename Scalar>
std::vector<PartAxis<Scalar>> part_axes(const KinematicSkeleton<Scalar>& skeleton) {
    using Point = AxisPoint<Scalar>;
    const auto at = [&](const std::string& name) {
        const Vector3<Scalar> place = joint_place(skeleton, name);
        return Point{place, skeleton.joints[static_cast<std::size_t>(find_joint(skeleton, name))].radius};
    };
    const auto end = [&](const std::string& name, const std::string& joint) {
        return Point{end_place(skeleton, name, joint), Scalar(0)};
    };
    const Scalar half = Scalar(0.5);
    const Point crotch = at("crotch"), waist = at("waist"), chest = at("chest"), neck = at("neck"), head = at("head");
    const Point hip_bone = between(crotch, waist, half), ribs = between(waist, chest, half);
    const Point throat = between(neck, head, half); // the jaw hangs below the head's joint
    std::vector<PartAxis<Scalar>> axes;
    axes.push_back({trunk_part("pelvis"), LimbEnd::none, crotch, hip_bone});
    axes.push_back({trunk_part("abdomen"), LimbEnd::none, hip_bone, waist});
    axes.push_back({trunk_part("abdomen"), LimbEnd::none, waist, ribs});
    axes.push_back({trunk_part("chest"), LimbEnd::none, ribs, chest});
    axes.push_back({trunk_part("chest"), LimbEnd::none, chest, neck});
    axes.push_back({trunk_part("neck"), LimbEnd::none, neck, throat});
    axes.push_back({trunk_part("head"), LimbEnd::none, throat, head});
    axes.push_back({trunk_part("head"), LimbEnd::none, head, end("head_top", "head")});
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const std::string side(sides[s]);
        const LimbEnd hand = s == 0 ? LimbEnd::left_hand : LimbEnd::right_hand;
        const LimbEnd foot = s == 0 ? LimbEnd::left_foot : LimbEnd::right_foot;
        const Point shoulder = at(side + "shoulder"), elbow = at(side + "elbow"), wrist = at(side + "wrist");
        const Point hip = at(side + "hip"), knee = at(side + "knee"), ankle = at(side + "ankle");
        const Point knuckles = at(side + "hand"), ball = at(side + "foot");
        axes.push_back({sided_part("shoulder", s), LimbEnd::none, chest, shoulder});
        axes.push_back({sided_part("upper_arm", s), hand, shoulder, elbow});
        axes.push_back({sided_part("forearm", s), hand, elbow, wrist});
        axes.push_back({sided_part("hand", s), hand, wrist, knuckles});
        axes.push_back({sided_part("hand", s), hand, knuckles, end(side + "fingertip", side + "hand")});
        axes.push_back({trunk_part("pelvis"), LimbEnd::none, crotch, hip});
        axes.push_back({sided_part("thigh", s), foot, hip, knee});
        axes.push_back({sided_part("calf", s), foot, knee, ankle});
        // The heel is as far behind the ankle as below it, and belongs to the foot.
        axes.push_back({sided_part("foot", s), foot, ankle, ball, Scalar(0.02)});
        axes.push_back({sided_part("foot", s), foot, ball, end(side + "toe", side + "foot")});
    }
    return axes;
}

/// Distance from a place to an axis, less a quarter of how thick the body is there, so that a trunk's side is the
/// trunk's though an arm hangs beside it. Beyond an axis's end both axes that meet there are equally near: a little is
/// added for how far beyond, so that they share by the plane that halves the angle between them.
template <typename Scalar>
Scalar distance_to_axis(const Vector3<Scalar>& place, const PartAxis<Scalar>& axis) {
    constexpr Scalar reluctance = Scalar(0.05);
    const Vector3<Scalar> from = axis.from.place, bone = axis.to.place - from;
    const core::NearestOnSegment<Scalar> nearest = core::nearest_on_segment<Scalar, 3>(place, from, axis.to.place);
    const Scalar radius = between(axis.from, axis.to, nearest.along).radius, length = bone.norm();
    const Scalar distance = nearest.distance - radius / 4;
    if (!(length > 0)) return distance;
    const Scalar along = (place - from).dot(bone) / length;
    return distance + axis.reluctance_before * std::max(Scalar(0), -along) +
           reluctance * std::max(Scalar(0), along - length);
}

/// The vertex in which each end of the body lies, by LimbEnd.
template <typename Scalar>
std::vector<int> end_vertices(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    std::vector<int> out{-1}; // of `none`
    for (const auto& [name, joint] : {std::pair("head_top", "head"), std::pair("left_fingertip", "left_hand"),
                                      std::pair("right_fingertip", "right_hand"), std::pair("left_toe", "left_foot"),
                                      std::pair("right_toe", "right_foot")})
        out.push_back(core::nearest_vertex(body.mesh, end_place(skeleton, name, joint)));
    return out;
}

/// For each vertex the end of the body that is nearest along the surface.
template <typename Scalar>
std::vector<LimbEnd> nearest_ends(const Body<Scalar>& body, const std::vector<int>& end_vertices) {
    std::vector<core::Source<Scalar>> sources;
    for (std::size_t end = 1; end < end_vertices.size(); ++end)
        sources.push_back({Scalar(0), static_cast<int>(end), end_vertices[end]});
    std::vector<LimbEnd> ends;
    for (const int label : core::nearest_source(body.graph, sources))
        ends.push_back(label < 0 ? LimbEnd::none : static_cast<LimbEnd>(label));
    return ends;
}

/// For each vertex the part of the nearest axis among those that `is_candidate` names for it.
template <typename Scalar, typename Candidate>
int nearest_part(const Vector3<Scalar>& place, const std::vector<PartAxis<Scalar>>& axes,
                 const Candidate& is_candidate) {
    int part = 0;
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (const PartAxis<Scalar>& axis : axes) {
        if (!is_candidate(axis)) continue;
        const Scalar distance = distance_to_axis(place, axis);
        if (distance < least) {
            least = distance;
            part = axis.part;
        }
    }
    return part;
}

/// Distance along the surface from the nearest vertex of which `is_source` holds; infinite without any.
template <typename Scalar, typename IsSource>
std::vector<Scalar> distance_from(core::CurveGraph<Scalar> graph, const IsSource& is_source) {
    const int all = graph.size(); // one node more, to which all sources are joined
    graph.neighbours.emplace_back();
    for (int v = 0; v < all; ++v)
        if (is_source(v)) graph.neighbours.back().emplace_back(v, Scalar(0));
    std::vector<Scalar> distance = core::shortest_paths(graph, all).distance;
    distance.pop_back();
    return distance;
}

/// For each vertex the part of the nearest axis. A limb is in one piece: what of a trunk's side is nearer to an arm
/// that hangs beside it belongs to the trunk all the same.
template <typename Scalar>
std::vector<int> nearest_parts(const Body<Scalar>& body, const std::vector<PartAxis<Scalar>>& axes,
                               const std::vector<int>& end_vertices) {
    const std::vector<LimbEnd> ends = nearest_ends(body, end_vertices);
    const auto place = [&](std::size_t v) { return core::point(body.mesh.vertices, static_cast<Eigen::Index>(v)); };
    std::vector<int> parts;
    for (std::size_t v = 0; v < ends.size(); ++v)
        parts.push_back(nearest_part(place(v), axes, [&](const PartAxis<Scalar>& axis) {
            return axis.end == LimbEnd::none || axis.end == ends[v];
        }));
    std::vector<LimbEnd> end_of_part(part_names(PartSet::bones).size(), LimbEnd::none);
    for (const PartAxis<Scalar>& axis : axes) end_of_part[static_cast<std::size_t>(axis.part)] = axis.end;
    const auto limb_of = [&](std::size_t v) { return end_of_part[static_cast<std::size_t>(parts[v])]; };
    std::vector<bool> reached(parts.size(), false);
    for (std::size_t end = 1; end < end_vertices.size(); ++end) {
        std::vector<int> front{end_vertices[end]};
        while (!front.empty()) {
            const auto v = static_cast<std::size_t>(front.back());
            front.pop_back();
            if (reached[v] || limb_of(v) != static_cast<LimbEnd>(end)) continue;
            reached[v] = true;
            for (const auto& [neighbour, length] : body.graph.neighbours[v]) front.push_back(neighbour);
        }
    }
    for (std::size_t v = 0; v < parts.size(); ++v)
        if (limb_of(v) != LimbEnd::none && !reached[v])
            parts[v] =
                nearest_part(place(v), axes, [](const PartAxis<Scalar>& axis) { return axis.end == LimbEnd::none; });
    return parts;
}

/// Gives the trunk's vertices near an arm to the shoulder, and what was a shoulder's elsewhere to the trunk.
template <typename Scalar>
std::vector<int> with_shoulders(const std::vector<int>& parts, const Body<Scalar>& body,
                                const std::vector<PartAxis<Scalar>>& axes, double reach) {
    const auto is_shoulder = [](int part) {
        return part == sided_part("shoulder", 0) || part == sided_part("shoulder", 1);
    };
    const auto is_trunk = [&](int part) {
        return is_shoulder(part) || part == trunk_part("chest") || part == trunk_part("abdomen");
    };
    const auto is_part = [&](int part) {
        return [&parts, part](int v) { return parts[static_cast<std::size_t>(v)] == part; };
    };
    std::vector<int> out = parts;
    for (std::size_t v = 0; v < out.size(); ++v)
        if (is_shoulder(parts[v]))
            out[v] = nearest_part(core::point(body.mesh.vertices, static_cast<Eigen::Index>(v)), axes,
                                  [&](const PartAxis<Scalar>& axis) {
                                      return axis.part == trunk_part("chest") || axis.part == trunk_part("abdomen") ||
                                             axis.part == trunk_part("pelvis");
                                  });
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const std::vector<Scalar> from_arm = distance_from(body.graph, is_part(sided_part("upper_arm", s)));
        Scalar to_neck = std::numeric_limits<Scalar>::infinity();
        for (std::size_t v = 0; v < parts.size(); ++v)
            if (parts[v] == trunk_part("neck")) to_neck = std::min(to_neck, from_arm[v]);
        if (to_neck == std::numeric_limits<Scalar>::infinity()) continue;
        for (std::size_t v = 0; v < parts.size(); ++v)
            if (is_trunk(parts[v]) && from_arm[v] < static_cast<Scalar>(reach) * to_neck)
                out[v] = sided_part("shoulder", s);
    }
    return out;
}

/// For each vertex the label of which there is most after random walks of that length.
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

/// Labels with each in one piece: of several pieces the one with the most vertices stays, the others take the label of
/// most of what borders on them.
template <typename Scalar>
std::vector<int> in_one_piece(const Body<Scalar>& body, std::vector<int> labels, int count) {
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

/// Each part of the set `bones` as one of the set `body`.
inline std::vector<int> merged_parts() {
    const std::vector<std::string> bones = part_names(PartSet::bones), body = part_names(PartSet::body);
    std::vector<int> out;
    for (const std::string& bone : bones) {
        const auto same = std::find(body.begin(), body.end(), bone);
        const std::string other = bone == "neck" ? "head" : "torso";
        out.push_back(
            static_cast<int>((same != body.end() ? same : std::find(body.begin(), body.end(), other)) - body.begin()));
    }
    return out;
}

/// Of each face the part of most of its corners, of three different ones that of the first.
inline std::vector<int> face_parts(const Triangles& faces, const std::vector<int>& vertex_part) {
    std::vector<int> out;
    out.reserve(static_cast<std::size_t>(faces.rows()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        const auto part = [&](int k) { return vertex_part[static_cast<std::size_t>(faces(f, k))]; };
        out.push_back(part(1) == part(2) ? part(1) : part(0));
    }
    return out;
}

} // namespace detail

SKELGEN_INLINE void validate(const SegmentationOptions& options) {
    core::require_in_range("segmentation.smoothing", options.smoothing, 0.001, 0.2);
    core::require_in_range("segmentation.shoulder", options.shoulder, 0.0, 1.0);
}

SKELGEN_INLINE std::vector<std::string> part_names(PartSet set) {
    std::vector<std::string> names;
    if (set == PartSet::bones)
        names.assign(detail::trunk_parts.begin(), detail::trunk_parts.end());
    else
        names = {"head", "torso"};
    for (const std::string_view side : detail::sides)
        for (const std::string_view part : detail::sided_parts)
            if (set == PartSet::bones || part != "shoulder") names.push_back(std::string(side) + std::string(part));
    return names;
}

template <typename Scalar>
Segmentation segment(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton, PartSet set,
                     const SegmentationOptions& options) {
    validate(options);
    const KinematicSkeleton<Scalar> inside = surface::to_body(body, skeleton);
    const std::vector<detail::PartAxis<Scalar>> axes = detail::part_axes(inside);
    std::vector<int> parts = detail::nearest_parts(body, axes, detail::end_vertices(body, inside));
    parts = detail::with_shoulders(parts, body, axes, options.shoulder);
    if (set == PartSet::body) {
        const std::vector<int> merged = detail::merged_parts();
        for (int& part : parts) part = merged[static_cast<std::size_t>(part)];
    }
    Segmentation out;
    out.parts = part_names(set);
    const double size = std::sqrt(static_cast<double>(core::surface_area(body.mesh)));
    const auto count = static_cast<int>(out.parts.size());
    out.vertex_part =
        detail::in_one_piece(body, detail::smoothed_labels(body, parts, count, options.smoothing * size), count);
    out.face_part = detail::face_parts(body.mesh.faces, out.vertex_part);
    return out;
}

template <typename Scalar>
Segmentation to_input(const Segmentation& segmentation, const Body<Scalar>& body, const TriangleMesh<Scalar>& input) {
    Segmentation out;
    out.parts = segmentation.parts;
    for (const int v : standing_for(body, input.vertices))
        out.vertex_part.push_back(segmentation.vertex_part[static_cast<std::size_t>(v)]);
    out.face_part = detail::face_parts(input.faces, out.vertex_part);
    return out;
}

} // namespace skelgen::applications
