#pragma once

#include <skelgen/applications/measurement.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Geometry>

#include <skelgen/applications/body_coordinates.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/surface/contours.hpp>

namespace skelgen::applications {
namespace detail {

/// A bone by the joints that it joins; on both sides where `is_sided`.
struct NamedBone {
    const char* name;
    const char* from;
    const char* to;
    bool from_is_sided, to_is_sided;
};

inline constexpr std::array<NamedBone, 4> trunk_bones{{{"lower_spine", "crotch", "waist", false, false},
                                                       {"upper_spine", "waist", "chest", false, false},
                                                       {"neck_base", "chest", "neck", false, false},
                                                       {"neck", "neck", "head", false, false}}};
inline constexpr std::array<NamedBone, 8> sided_bones{{{"clavicle", "chest", "shoulder", false, true},
                                                       {"upper_arm", "shoulder", "elbow", true, true},
                                                       {"forearm", "elbow", "wrist", true, true},
                                                       {"palm", "wrist", "hand", true, true},
                                                       {"pelvis", "crotch", "hip", false, true},
                                                       {"thigh", "hip", "knee", true, true},
                                                       {"calf", "knee", "ankle", true, true},
                                                       {"foot", "ankle", "foot", true, true}}};

/// Where a girth is taken: across the line from one joint to another or to an end point, from `begin` to `end` along it
/// (0 and 1: at the joints; hips: between them), and which of the girths there counts.
struct GirthPlace {
    enum class Choice { largest, smallest };
    const char* name;
    const char* from;
    const char* to;
    double begin, end;
    Choice choice;
    std::vector<std::string> parts; ///< that a section may run through; those of a limb without their side
    const char* before = nullptr;   ///< the joint before `from`: the section halves the angle there
    bool is_tilted = false;         ///< sections tilted forward and back count, too
    double share = 0;               ///< of a section's faces that the first of the parts has at least
};

inline const std::vector<GirthPlace>& trunk_girths() {
    using Choice = GirthPlace::Choice;
    static const std::vector<GirthPlace> places{
        {"head", "neck", "head_top", 0.35, 0.65, Choice::largest, {"head"}},
        {"neck", "neck", "head_top", 0.0, 0.4, Choice::smallest, {"head", "neck", "chest"}, nullptr, true},
        {"chest", "hips", "neck", 0.42, 0.62, Choice::largest, {"abdomen", "chest", "shoulder"}},
        {"waist", "hips", "neck", 0.22, 0.42, Choice::smallest, {"pelvis", "abdomen", "chest"}},
        {"hip", "crotch", "waist", -0.3, 0.5, Choice::largest, {"pelvis", "abdomen", "thigh"}}};
    return places;
}

inline const std::vector<GirthPlace>& sided_girths() {
    using Choice = GirthPlace::Choice;
    static const std::vector<GirthPlace> places{
        // Where an arm is thick its begin reaches this far on the inner side.
        {"upper_arm",
         "shoulder",
         "elbow",
         0.5,
         0.5,
         Choice::largest,
         {"upper_arm", "shoulder", "chest"},
         nullptr,
         false,
         0.5},
        {"elbow", "elbow", "wrist", 0.0, 0.0, Choice::largest, {"upper_arm", "forearm"}, "shoulder"},
        {"forearm", "elbow", "wrist", 0.1, 0.4, Choice::largest, {"forearm"}},
        {"wrist", "elbow", "wrist", 0.85, 1.05, Choice::smallest, {"forearm", "hand"}},
        {"thigh", "hip", "knee", 0.25, 0.4, Choice::largest, {"thigh"}},
        {"mid_thigh", "hip", "knee", 0.5, 0.5, Choice::largest, {"thigh"}},
        {"knee", "knee", "ankle", 0.0, 0.0, Choice::largest, {"thigh", "calf"}, "hip"},
        {"calf", "knee", "ankle", 0.2, 0.5, Choice::largest, {"calf"}},
        {"ankle", "knee", "ankle", 0.8, 1.0, Choice::smallest, {"calf", "foot"}}};
    return places;
}

/// The parts that sections of one place may run through, and the one that they are of; one entry for each part.
struct SectionParts {
    std::vector<bool> allowed, own;
    double share = 0; ///< of a section's faces that have to be of its own part
};

/// The girth at one place across a direction, in the body's unit; none where the section is missing or runs through
/// another part than those that it may, or too little through its own.
template <typename Scalar>
std::optional<Scalar> girth_at(const Body<Scalar>& body, const Segmentation& parts, const SectionParts& wanted,
                               const Vector3<Scalar>& place, const Vector3<Scalar>& direction) {
    constexpr Scalar reach = Scalar(0.02); // of a joint that has come out of a thin limb
    const auto contour = surface::contour_around(body.mesh, body.adjacency, body.tree, place, direction, reach);
    if (!contour) return std::nullopt;
    double own = 0;
    for (const int face : contour->faces) {
        const auto part = static_cast<std::size_t>(parts.face_part[static_cast<std::size_t>(face)]);
        if (!wanted.allowed[part]) return std::nullopt;
        if (wanted.own[part]) own += 1 / static_cast<double>(contour->faces.size());
    }
    if (own < wanted.share) return std::nullopt;
    return tape_length(contour->points, direction);
}

/// Where the line begins or ends that girths are across.
template <typename Scalar>
Vector3<Scalar> girth_end(const KinematicSkeleton<Scalar>& skeleton, const std::string& name) {
    if (name != "hips") return end_place(skeleton, name, name);
    return (joint_place(skeleton, "left_hip") + joint_place(skeleton, "right_hip")) / 2;
}

/// A girth with the plane that it is in, in the body's coordinates and unit.
template <typename Scalar>
struct Girth {
    Scalar length = 0;
    Vector3<Scalar> place, normal;
};

/// The girth that counts among those at a place; `side` in front of the names of joints and parts that have one.
template <typename Scalar>
std::optional<Girth<Scalar>> girth_of(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                                      const Segmentation& parts, const GirthPlace& place, const std::string& side) {
    constexpr int steps = 12; // along the place: girths change slowly
    const auto is_allowed = [&](const std::string& part) {
        return std::any_of(place.parts.begin(), place.parts.end(), [&](const std::string& name) {
            return part == side + name || part == name || (side.empty() && part == "left_" + name) ||
                   (side.empty() && part == "right_" + name);
        });
    };
    SectionParts wanted{{}, {}, place.share};
    for (const std::string& part : parts.parts) {
        wanted.allowed.push_back(is_allowed(part));
        wanted.own.push_back(part == side + place.parts.front());
    }
    const Vector3<Scalar> from = girth_end(skeleton, side + place.from), to = girth_end(skeleton, side + place.to);
    Vector3<Scalar> direction = (to - from).stableNormalized();
    if (place.before != nullptr)
        direction =
            (direction + (from - joint_place(skeleton, side + place.before)).stableNormalized()).stableNormalized();
    const Vector3<Scalar> left =
        (joint_place(skeleton, "left_shoulder") - joint_place(skeleton, "right_shoulder")).stableNormalized();
    const int last = place.end > place.begin ? steps : 0, tilts = place.is_tilted ? 3 : 0;
    std::optional<Girth<Scalar>> chosen;
    for (int tilt = -tilts; tilt <= tilts; ++tilt) {
        const Eigen::AngleAxis<Scalar> turn(Scalar(tilt) * static_cast<Scalar>(std::numbers::pi / 18), left);
        for (int i = 0; i <= last; ++i) {
            const auto along = static_cast<Scalar>(place.begin + (place.end - place.begin) * i / steps);
            const Vector3<Scalar> at = from + along * (to - from), normal = turn * direction;
            const auto girth = girth_at<Scalar>(body, parts, wanted, at, normal);
            if (!girth) continue;
            const bool counts = !chosen || (place.choice == GirthPlace::Choice::largest ? *girth > chosen->length
                                                                                        : *girth < chosen->length);
            if (counts) chosen = {*girth, at, normal};
        }
    }
    return chosen;
}

/// How far an ankle is above the sole of its foot, in the body's unit.
template <typename Scalar>
Scalar ankle_height(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton, const std::string& side) {
    const Vector3<Scalar> ankle = joint_place(skeleton, side + "ankle");
    const Vector3<Scalar> calf = (ankle - joint_place(skeleton, side + "knee")).stableNormalized();
    const Vector3<Scalar> foot = (joint_place(skeleton, side + "foot") - ankle).stableNormalized();
    const SkeletonTemplate& rest = builtin_template("human21");
    const int joint = find_joint(rest, JointRole::ankle, Side::left),
              ball = find_joint(rest, JointRole::foot, Side::left);
    const auto slope = static_cast<Scalar>(
        -(rest.joint(ball).position - rest.joint(joint).position).normalized().y()); // cosine to straight down
    const Vector3<Scalar> across = (calf - calf.dot(foot) * foot).stableNormalized();
    const Vector3<Scalar> down = slope * foot + std::sqrt(1 - slope * slope) * across;
    const auto hit = body.tree.first_along(body.mesh, ankle, down);
    return hit.face >= 0 ? hit.distance : Scalar(0);
}

} // namespace detail

template <typename Scalar>
Scalar tape_length(const std::vector<Vector3<Scalar>>& points, const Vector3<Scalar>& normal) {
    using Flat = Eigen::Matrix<Scalar, 2, 1>;
    const Vector3<Scalar> u = normal.unitOrthogonal(), v = normal.cross(u);
    std::vector<Flat> flat;
    flat.reserve(points.size());
    for (const Vector3<Scalar>& p : points) flat.emplace_back(p.dot(u), p.dot(v));
    std::sort(flat.begin(), flat.end(),
              [](const Flat& a, const Flat& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
    const auto turns_right = [](const Flat& a, const Flat& b, const Flat& c) {
        return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x() <= 0;
    };
    // Andrew's monotone chain: the lower half from left to right, the upper one back.
    const auto half = [&](auto first, auto end) {
        std::vector<Flat> chain;
        for (auto p = first; p != end; ++p) {
            while (chain.size() > 1 && turns_right(chain[chain.size() - 2], chain.back(), *p)) chain.pop_back();
            chain.push_back(*p);
        }
        Scalar length = 0;
        for (std::size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
        return length;
    };
    return half(flat.begin(), flat.end()) + half(flat.rbegin(), flat.rend());
}

template <typename Scalar>
double standing_height(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton) {
    const KinematicSkeleton<Scalar> inside = surface::to_body(body, skeleton);
    const auto at = [&](const std::string& name) { return joint_place(inside, name); };
    const auto between = [&](const std::string& a, const std::string& b) { return (at(a) - at(b)).norm(); };
    const Vector3<Scalar> hips = (at("left_hip") + at("right_hip")) / 2;
    Scalar height = (end_place(inside, "head_top", "head") - at("neck")).norm() + between("neck", "chest") +
                    between("chest", "waist") + (at("waist") - hips).norm();
    for (const std::string side : {"left_", "right_"})
        height += (between(side + "hip", side + "knee") + between(side + "knee", side + "ankle") +
                   detail::ankle_height(body, inside, side)) /
                  2;
    return static_cast<double>(body.similarity.scale * height);
}

template <typename Scalar>
Measurements measure(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton, const Segmentation& parts) {
    if (parts.face_part.size() != static_cast<std::size_t>(body.mesh.faces.rows()) ||
        parts.parts != part_names(PartSet::bones))
        throw Error(ErrorCode::usage, "measures need the body's own parts, of the set bones");
    const KinematicSkeleton<Scalar> inside = surface::to_body(body, skeleton);
    const auto unit = static_cast<double>(body.similarity.scale);
    const auto between = [&](const std::string& a, const std::string& b) {
        return unit * static_cast<double>((joint_place(inside, a) - joint_place(inside, b)).norm());
    };
    const auto end_bone = [&](const std::string& end, const std::string& joint) {
        return unit * static_cast<double>((end_place(inside, end, joint) - joint_place(inside, joint)).norm());
    };
    Measurements out;
    out.height = standing_height(body, skeleton);
    out.area = unit * unit * static_cast<double>(core::surface_area(body.mesh));
    out.volume = unit * unit * unit * static_cast<double>(core::enclosed_volume(body.mesh));
    for (const detail::NamedBone& bone : detail::trunk_bones)
        out.lengths.emplace_back(bone.name, between(bone.from, bone.to));
    out.lengths.emplace_back("head", end_bone("head_top", "head"));
    out.lengths.emplace_back("shoulder_width", between("left_shoulder", "right_shoulder"));
    out.lengths.emplace_back("hip_width", between("left_hip", "right_hip"));
    out.arm_span = between("left_shoulder", "right_shoulder");
    for (const std::string side : {"left_", "right_"}) {
        for (const detail::NamedBone& bone : detail::sided_bones)
            out.lengths.emplace_back(side + bone.name, between((bone.from_is_sided ? side : "") + bone.from,
                                                               (bone.to_is_sided ? side : "") + bone.to));
        out.lengths.emplace_back(side + "fingers", end_bone(side + "fingertip", side + "hand"));
        out.lengths.emplace_back(side + "toes", end_bone(side + "toe", side + "foot"));
        out.arm_span += between(side + "shoulder", side + "elbow") + between(side + "elbow", side + "wrist") +
                        between(side + "wrist", side + "hand") + end_bone(side + "fingertip", side + "hand");
    }
    const auto add_girth = [&](const detail::GirthPlace& place, const std::string& side) {
        const auto girth = detail::girth_of(body, inside, parts, place, side);
        out.girths.emplace_back(side + place.name,
                                girth ? std::optional(unit * static_cast<double>(girth->length)) : std::nullopt);
        out.girth_planes.emplace_back();
        if (!girth) return;
        out.girth_planes.back() = {body.similarity.to_input(girth->place).template cast<double>(),
                                   body.similarity.direction_to_input(girth->normal).template cast<double>()};
    };
    for (const detail::GirthPlace& place : detail::trunk_girths()) add_girth(place, "");
    for (const std::string side : {"left_", "right_"})
        for (const detail::GirthPlace& place : detail::sided_girths()) add_girth(place, side);
    return out;
}

} // namespace skelgen::applications
