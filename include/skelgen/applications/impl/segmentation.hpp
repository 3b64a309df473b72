#pragma once

#include <skelgen/applications/segmentation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include <skelgen/applications/alignment.hpp>
#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/applications/impl/surface_labels.hpp>
#include <skelgen/applications/part_axes.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/header_only.hpp>
#include <skelgen/core/options.hpp>
#include <skelgen/surface/contours.hpp>

namespace skelgen::applications {
namespace detail {

/// The vertex in which each end of the body lies, by LimbEnd.
template <typename Scalar>
std::vector<int> end_vertices(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    std::vector<int> out{-1}; // of `none`
    const SkeletonTemplate& own = own_template(skeleton);
    for (const auto& [role, side] : {std::pair(JointRole::head, Side::none), std::pair(JointRole::hand, Side::left),
                                     std::pair(JointRole::hand, Side::right), std::pair(JointRole::foot, Side::left),
                                     std::pair(JointRole::foot, Side::right)}) {
        const TemplateJoint& joint = own.joint(find_joint(own, role, side));
        out.push_back(body.tree.nearest_corner(body.mesh, end_place(skeleton, end_point_name(own, joint), joint.name)));
    }
    for (const auto& [name, place] : skeleton.end_points)
        if (name == "tail_tip") out.push_back(body.tree.nearest_corner(body.mesh, place));
    return out;
}

/// Distances along the surface from each end of the body, by LimbEnd; none of `none`.
template <typename Scalar>
using EndDistances = std::vector<std::vector<Scalar>>;

template <typename Scalar>
EndDistances<Scalar> end_distances(const Body<Scalar>& body, const std::vector<int>& end_vertices) {
    EndDistances<Scalar> out(1);
    for (std::size_t end = 1; end < end_vertices.size(); ++end)
        out.push_back(core::distances_from(body.graph, {end_vertices[end]}));
    return out;
}

/// May a vertex belong to the limb that ends there? No other end is nearer; of arms, which are as far from the hand at
/// their roots as from the crown, the head does not count, and tails, of all lengths, have no say.
template <typename Scalar>
bool may_be_of(LimbEnd limb, const EndDistances<Scalar>& distances, std::size_t v) {
    const bool is_arm = limb == LimbEnd::left_hand || limb == LimbEnd::right_hand;
    if (limb == LimbEnd::tail) return true;
    for (std::size_t end = 1; end < distances.size(); ++end) {
        if (static_cast<LimbEnd>(end) == LimbEnd::tail) continue;
        if (is_arm && static_cast<LimbEnd>(end) == LimbEnd::head) continue;
        if (distances[end][v] < distances[static_cast<std::size_t>(limb)][v]) return false;
    }
    return true;
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

/// For each vertex the part of the nearest axis. A limb is in one piece: what of a trunk's side is nearer to an arm
/// that hangs beside it belongs to the trunk all the same.
template <typename Scalar>
std::vector<int> nearest_parts(const Body<Scalar>& body, const std::vector<PartAxis<Scalar>>& axes, std::size_t count,
                               const std::vector<int>& end_vertices, const EndDistances<Scalar>& distances) {
    const auto place = [&](std::size_t v) { return core::point(body.mesh.vertices, static_cast<Eigen::Index>(v)); };
    std::vector<int> parts;
    for (std::size_t v = 0; v < body.graph.neighbours.size(); ++v)
        parts.push_back(nearest_part(place(v), axes, [&](const PartAxis<Scalar>& axis) {
            return axis.end == LimbEnd::none || may_be_of(axis.end, distances, v);
        }));
    std::vector<LimbEnd> end_of_part(count, LimbEnd::none);
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

inline bool is_of_spine(int part) {
    return part == trunk_part("chest") || part == trunk_part("abdomen") || part == trunk_part("pelvis");
}

/// Where the trunk is divided: across the pelvis's own direction above the hips, and across the line from there to the
/// neck. Planes, as bodies with a belly have their joints far in front of what is behind.
template <typename Scalar>
struct TrunkBorders {
    Vector3<Scalar> hips, pelvis_up, spine; ///< between the hips; of length 1; from there to the neck
    Scalar length = 0;                      ///< from the hips over the waist to the neck

    [[nodiscard]] int part_of(const Vector3<Scalar>& place) const {
        constexpr Scalar top_of_pelvis = Scalar(0.22), top_of_abdomen = Scalar(0.475); // of people who stand
        const Vector3<Scalar> from_hips = place - hips;
        const Scalar above_pelvis = from_hips.dot(pelvis_up) - top_of_pelvis * length;
        const Scalar above_abdomen = from_hips.dot(spine) / spine.norm() - top_of_abdomen * spine.norm();
        if (above_abdomen > 0 && above_abdomen > -above_pelvis) return trunk_part("chest");
        return trunk_part(above_pelvis > 0 ? "abdomen" : "pelvis");
    }
};

template <typename Scalar>
TrunkBorders<Scalar> trunk_borders(const KinematicSkeleton<Scalar>& skeleton) {
    const Vector3<Scalar> hips = (joint_place(skeleton, "left_hip") + joint_place(skeleton, "right_hip")) / 2;
    const Vector3<Scalar> waist = joint_place(skeleton, "waist"), neck = joint_place(skeleton, "neck");
    return {hips, pelvis_directions(skeleton).up.stableNormalized(), neck - hips,
            (waist - hips).norm() + (neck - waist).norm()};
}

/// Lets arms begin below their shoulders, and gives what is between the arm and the trunk's end to the shoulder.
template <typename Scalar>
std::vector<int> with_shoulders(std::vector<int> parts, const Body<Scalar>& body,
                                const KinematicSkeleton<Scalar>& skeleton, const EndDistances<Scalar>& distances,
                                const SegmentationOptions& options) {
    constexpr Scalar reach = Scalar(0.5); // of a shoulder around its joint, in upper arms
    constexpr Scalar lean = Scalar(0.6);  // of an arm's begin towards the collarbone; 1 would halve the angle
    const TrunkBorders<Scalar> trunk = trunk_borders(skeleton);
    const Vector3<Scalar> chest = joint_place(skeleton, "chest"), neck = joint_place(skeleton, "neck");
    const Vector3<Scalar> middle = (chest + neck) / 2;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const std::string side(sides[s]);
        const LimbEnd hand = s == 0 ? LimbEnd::left_hand : LimbEnd::right_hand;
        const int upper_arm = sided_part("upper_arm", s), shoulder = sided_part("shoulder", s);
        const Vector3<Scalar> joint = joint_place(skeleton, side + "shoulder");
        const Vector3<Scalar> arm = joint_place(skeleton, side + "elbow") - joint, collar = joint - middle;
        const Vector3<Scalar> across =
            (arm.stableNormalized() + lean * (joint - chest).stableNormalized()).stableNormalized();
        for (std::size_t v = 0; v < parts.size(); ++v) {
            const Vector3<Scalar> place = core::point(body.mesh.vertices, static_cast<Eigen::Index>(v));
            const bool above_arm = (place - joint).dot(across) < static_cast<Scalar>(options.upper_arm) * arm.norm();
            const bool leaves_arm = parts[v] == upper_arm && above_arm;
            if (!leaves_arm && parts[v] != shoulder && !is_of_spine(parts[v])) continue;
            const bool is_shoulder =
                (place - joint).norm() < reach * arm.norm() && may_be_of(hand, distances, v) &&
                (place - middle).dot(collar) > static_cast<Scalar>(options.shoulder) * collar.squaredNorm();
            parts[v] = is_shoulder ? shoulder : trunk.part_of(place);
        }
    }
    return parts;
}

/// Lets thighs begin where the legs fork.
template <typename Scalar>
std::vector<int> with_thighs(std::vector<int> parts, const Body<Scalar>& body,
                             const KinematicSkeleton<Scalar>& skeleton, const EndDistances<Scalar>& distances,
                             double begin) {
    constexpr Scalar reach = Scalar(0.6), slope = Scalar(0.4); // of a thigh; of the groin, outwards and up
    const Vector3<Scalar> left = joint_place(skeleton, "left_hip") - joint_place(skeleton, "right_hip");
    const Vector3<Scalar> down = -pelvis_directions(skeleton).up.stableNormalized();
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const std::string side(sides[s]);
        const LimbEnd foot = s == 0 ? LimbEnd::left_foot : LimbEnd::right_foot;
        const int thigh_part = sided_part("thigh", s);
        const Vector3<Scalar> hip = joint_place(skeleton, side + "hip");
        const Vector3<Scalar> thigh = joint_place(skeleton, side + "knee") - hip;
        const Vector3<Scalar> outwards = (s == 0 ? left : Vector3<Scalar>(-left)).stableNormalized();
        const Vector3<Scalar> across =
            (slope * outwards + (down + thigh.stableNormalized()).stableNormalized()).stableNormalized();
        for (std::size_t v = 0; v < parts.size(); ++v) {
            if (parts[v] != thigh_part && parts[v] != trunk_part("pelvis")) continue;
            const Vector3<Scalar> from_hip = core::point(body.mesh.vertices, static_cast<Eigen::Index>(v)) - hip;
            if (from_hip.norm() > reach * thigh.norm() || !may_be_of(foot, distances, v)) continue;
            const bool is_thigh = from_hip.dot(across) > static_cast<Scalar>(begin) * left.norm();
            parts[v] = is_thigh ? thigh_part : trunk_part("pelvis");
        }
    }
    return parts;
}

/// How far from a limb's end its surface is around a place on its bone, and how thick the limb is there.
template <typename Scalar>
struct LimbLevel {
    Scalar distance = 0, radius = 0;
};

template <typename Scalar>
std::optional<LimbLevel<Scalar>> limb_level(const Body<Scalar>& body, const std::vector<Scalar>& to_end,
                                            const Vector3<Scalar>& place, const Vector3<Scalar>& across) {
    constexpr Scalar reach = Scalar(0.02); // of a joint that has come out of a thin limb
    if (across.isZero()) return std::nullopt;
    const auto section = surface::contour_around(body.mesh, body.adjacency, body.tree, place, across, reach);
    if (!section) return std::nullopt;
    LimbLevel<Scalar> level;
    for (const int face : section->faces)
        level.distance +=
            to_end[static_cast<std::size_t>(body.mesh.faces(face, 0))] / static_cast<Scalar>(section->faces.size());
    for (std::size_t i = 0; i < section->points.size(); ++i)
        level.radius += (section->points[(i + 1) % section->points.size()] - section->points[i]).norm() /
                        static_cast<Scalar>(2 * std::numbers::pi);
    return level;
}

/// Where the bones of a bent limb come near each other, a vertex belongs to the one that is as far from the limb's end:
/// none that is farther from it than the joint, by more than most of the limb's radius, to what is beyond the joint,
/// and none that is nearer to what is before it.
template <typename Scalar>
std::vector<int> without_folds(std::vector<int> parts, const Body<Scalar>& body,
                               const KinematicSkeleton<Scalar>& skeleton, const EndDistances<Scalar>& distances) {
    struct Fold {
        JointRole before, joint, after;
        const char *upper, *lower; ///< parts, of people and of animals
        const char *upper_of_animal, *lower_of_animal;
        std::array<LimbEnd, 2> ends;
    };
    static constexpr std::array<Fold, 2> folds{{{JointRole::shoulder,
                                                 JointRole::elbow,
                                                 JointRole::wrist,
                                                 "upper_arm",
                                                 "forearm",
                                                 "fore_upper",
                                                 "fore_lower",
                                                 {LimbEnd::left_hand, LimbEnd::right_hand}},
                                                {JointRole::hip,
                                                 JointRole::knee,
                                                 JointRole::ankle,
                                                 "thigh",
                                                 "calf",
                                                 "hind_upper",
                                                 "hind_lower",
                                                 {LimbEnd::left_foot, LimbEnd::right_foot}}}};
    const BodyKind plan = own_template(skeleton).plan;
    const std::vector<std::string> names = part_names(PartSet::bones, plan);
    const auto part = [&](std::string_view side, const char* of_person, const char* of_animal) {
        const std::string name = std::string(side) + (plan == BodyKind::human ? of_person : of_animal);
        return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    constexpr Scalar slack = Scalar(0.7); // of the radius: how far geodesic rings lean where a limb is straight
    for (const Fold& fold : folds)
        for (std::size_t s = 0; s < sides.size(); ++s) {
            const Side side = s == 0 ? Side::left : Side::right;
            const Vector3<Scalar> joint = joint_place(skeleton, fold.joint, side);
            const Vector3<Scalar> across = ((joint - joint_place(skeleton, fold.before, side)).stableNormalized() +
                                            (joint_place(skeleton, fold.after, side) - joint).stableNormalized())
                                               .stableNormalized();
            const std::vector<Scalar>& to_end = distances[static_cast<std::size_t>(fold.ends[s])];
            const auto level = limb_level(body, to_end, joint, across);
            if (!level) continue;
            const int upper = part(sides[s], fold.upper, fold.upper_of_animal),
                      lower = part(sides[s], fold.lower, fold.lower_of_animal);
            for (std::size_t v = 0; v < parts.size(); ++v) {
                if (parts[v] == lower && to_end[v] > level->distance + slack * level->radius)
                    parts[v] = upper;
                else if (parts[v] == upper && to_end[v] < level->distance - slack * level->radius)
                    parts[v] = lower;
            }
        }
    return parts;
}

/// Takes the trunk's side from an arm that hangs beside it: what is farther from the hand than the arm's begin, by more
/// than its thickness, is the trunk's.
template <typename Scalar>
std::vector<int> without_flanks(std::vector<int> parts, const Body<Scalar>& body,
                                const KinematicSkeleton<Scalar>& skeleton, const EndDistances<Scalar>& distances,
                                double begin) {
    const TrunkBorders<Scalar> trunk = trunk_borders(skeleton);
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const std::string side(sides[s]);
        const Vector3<Scalar> joint = joint_place(skeleton, side + "shoulder");
        const Vector3<Scalar> arm = joint_place(skeleton, side + "elbow") - joint;
        const std::vector<Scalar>& to_end =
            distances[static_cast<std::size_t>(s == 0 ? LimbEnd::left_hand : LimbEnd::right_hand)];
        const auto level = limb_level<Scalar>(body, to_end, joint + static_cast<Scalar>(0.5 + begin / 2) * arm,
                                              arm.stableNormalized());
        if (!level) continue;
        const Scalar farthest = level->distance + static_cast<Scalar>(0.5 - begin / 2) * arm.norm() + 2 * level->radius;
        for (std::size_t v = 0; v < parts.size(); ++v)
            for (const char* part : {"upper_arm", "forearm", "hand"})
                if (parts[v] == sided_part(part, s) && to_end[v] > farthest)
                    parts[v] = trunk.part_of(core::point(body.mesh.vertices, static_cast<Eigen::Index>(v)));
    }
    return parts;
}

/// Each part of the set `bones` as one of the set `body`.
inline std::vector<int> merged_parts(BodyKind plan) {
    const std::vector<std::string> bones = part_names(PartSet::bones, plan), body = part_names(PartSet::body, plan);
    std::vector<int> out;
    for (const std::string& bone : bones) {
        const auto same = std::find(body.begin(), body.end(), bone);
        const std::string other = bone == "neck" ? "head" : "torso";
        out.push_back(
            static_cast<int>((same != body.end() ? same : std::find(body.begin(), body.end(), other)) - body.begin()));
    }
    return out;
}

/// Of each part the one on the other side; itself where it has none.
inline std::vector<int> mirrored_parts(const std::vector<std::string>& names) {
    std::vector<int> out;
    for (const std::string& name : names) {
        std::string other = name;
        if (name.starts_with(sides[0])) other = std::string(sides[1]) + name.substr(sides[0].size());
        if (name.starts_with(sides[1])) other = std::string(sides[0]) + name.substr(sides[1].size());
        out.push_back(static_cast<int>(std::find(names.begin(), names.end(), other) - names.begin()));
    }
    return out;
}

} // namespace detail

SKELGEN_INLINE void validate(const SegmentationOptions& options) {
    core::require_in_range("segmentation.smoothing", options.smoothing, 0.001, 0.2);
    core::require_in_range("segmentation.upper_arm", options.upper_arm, 0.0, 1.0);
    core::require_in_range("segmentation.shoulder", options.shoulder, 0.0, 2.0);
    core::require_in_range("segmentation.thigh", options.thigh, 0.0, 1.0);
}

template <typename Scalar>
Segmentation segment(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton, PartSet set,
                     const SegmentationOptions& options) {
    validate(options);
    const KinematicSkeleton<Scalar> inside = surface::to_body(body, skeleton);
    const BodyKind plan = own_template(skeleton).plan;
    const std::vector<PartAxis<Scalar>> axes = part_axes(inside);
    const std::vector<int> ends = detail::end_vertices(body, inside);
    const detail::EndDistances<Scalar> distances = detail::end_distances(body, ends);
    std::vector<int> parts =
        detail::nearest_parts(body, axes, part_names(PartSet::bones, plan).size(), ends, distances);
    if (plan == BodyKind::human) {
        parts = detail::without_flanks(parts, body, inside, distances, options.upper_arm);
        parts = detail::with_shoulders(parts, body, inside, distances, options);
        parts = detail::with_thighs(parts, body, inside, distances, options.thigh);
    }
    parts = detail::without_folds(parts, body, inside, distances);
    if (set == PartSet::body) {
        const std::vector<int> merged = detail::merged_parts(plan);
        for (int& part : parts) part = merged[static_cast<std::size_t>(part)];
    }
    Segmentation out;
    out.parts = part_names(set, plan);
    const double size = std::sqrt(static_cast<double>(core::surface_area(body.mesh)));
    const auto count = static_cast<int>(out.parts.size());
    out.vertex_part = in_one_piece(
        body, smoothed_labels(body, parts, detail::mirrored_parts(out.parts), options.smoothing * size), count);
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
