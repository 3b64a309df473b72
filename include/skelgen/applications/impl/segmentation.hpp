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
#include <skelgen/applications/part_axes.hpp>
#include <skelgen/applications/surface_labels.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>

namespace skelgen::applications {
namespace detail {

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
std::vector<Scalar> distance_from(const core::SurfaceGraph<Scalar>& graph, const IsSource& is_source) {
    std::vector<int> sources;
    for (int v = 0; v < graph.size(); ++v)
        if (is_source(v)) sources.push_back(v);
    return core::distances_from(graph, sources);
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
    const std::vector<PartAxis<Scalar>> axes = part_axes(inside);
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
    out.vertex_part = in_one_piece(body, smoothed_labels(body, parts, count, options.smoothing * size), count);
    out.face_part = face_labels(body.mesh.faces, out.vertex_part);
    return out;
}

template <typename Scalar>
Segmentation to_input(const Segmentation& segmentation, const Body<Scalar>& body, const TriangleMesh<Scalar>& input) {
    Segmentation out;
    out.parts = segmentation.parts;
    for (const int v : standing_for(body, input.vertices))
        out.vertex_part.push_back(segmentation.vertex_part[static_cast<std::size_t>(v)]);
    out.face_part = face_labels(input.faces, out.vertex_part);
    return out;
}

} // namespace skelgen::applications
