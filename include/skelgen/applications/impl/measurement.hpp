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

/// An end of a limb, the joint before it and what the length between is called.
struct NamedEnd {
    const char* name;
    const char* end;
    const char* joint;
};

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

/// What is measured of bodies of one plan.
struct Measured {
    std::vector<NamedBone> trunk_bones, sided_bones, trunk_widths;
    NamedEnd head;
    std::array<NamedEnd, 2> sided_ends; ///< of arm or fore leg, and of leg or hind leg
    std::vector<GirthPlace> trunk_girths, sided_girths;
};

inline const Measured& measured_of_people() {
    using Choice = GirthPlace::Choice;
    static const Measured people{
        {{"lower_spine", "crotch", "waist", false, false},
         {"upper_spine", "waist", "chest", false, false},
         {"neck_base", "chest", "neck", false, false},
         {"neck", "neck", "head", false, false}},
        {{"clavicle", "chest", "shoulder", false, true},
         {"upper_arm", "shoulder", "elbow", true, true},
         {"forearm", "elbow", "wrist", true, true},
         {"palm", "wrist", "hand", true, true},
         {"pelvis", "crotch", "hip", false, true},
         {"thigh", "hip", "knee", true, true},
         {"calf", "knee", "ankle", true, true},
         {"foot", "ankle", "foot", true, true}},
        {{"shoulder_width", "left_shoulder", "right_shoulder", false, false},
         {"hip_width", "left_hip", "right_hip", false, false}},
        {"head", "head_top", "head"},
        {{{"fingers", "fingertip", "hand"}, {"toes", "toe", "foot"}}},
        {{"head", "neck", "head_top", 0.35, 0.65, Choice::largest, {"head"}},
         {"neck", "neck", "head_top", 0.0, 0.4, Choice::smallest, {"head", "neck", "chest"}, nullptr, true},
         {"chest", "hips", "neck", 0.42, 0.62, Choice::largest, {"abdomen", "chest", "shoulder"}},
         {"waist", "hips", "neck", 0.22, 0.42, Choice::smallest, {"pelvis", "abdomen", "chest"}},
         {"hip", "crotch", "waist", -0.3, 0.5, Choice::largest, {"pelvis", "abdomen", "thigh"}}},
        {// Where an arm is thick its begin reaches this far on the inner side.
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
         {"ankle", "knee", "ankle", 0.8, 1.0, Choice::smallest, {"calf", "foot"}}}};
    return people;
}

/// Girths of a chest behind the fore legs, of the flanks, of the neck, and of each leg where it is thinnest.
inline const Measured& measured_of_animals() {
    using Choice = GirthPlace::Choice;
    static const Measured animals{
        {{"lower_spine", "hips", "spine1", false, false},
         {"middle_spine", "spine1", "spine2", false, false},
         {"upper_spine", "spine2", "chest", false, false},
         {"neck_base", "chest", "neck1", false, false},
         {"lower_neck", "neck1", "neck2", false, false},
         {"upper_neck", "neck2", "head", false, false}},
        {{"shoulder_blade", "fore_girdle", "fore_upper", true, true},
         {"fore_upper", "fore_upper", "fore_lower", true, true},
         {"fore_lower", "fore_lower", "fore_ankle", true, true},
         {"fore_foot", "fore_ankle", "fore_foot", true, true},
         {"hind_upper", "hind_upper", "hind_lower", true, true},
         {"hind_lower", "hind_lower", "hind_ankle", true, true},
         {"hind_foot", "hind_ankle", "hind_foot", true, true}},
        {{"shoulder_width", "left_fore_upper", "right_fore_upper", false, false},
         {"hip_width", "left_hind_upper", "right_hind_upper", false, false}},
        {"head", "head_tip", "head"},
        {{{"fore_toes", "fore_toe", "fore_foot"}, {"hind_toes", "hind_toe", "hind_foot"}}},
        {{"neck", "neck1", "head", 0.2, 0.9, Choice::smallest, {"neck", "head", "chest"}},
         {"chest", "spine2", "chest", 0.2, 0.9, Choice::largest, {"chest", "abdomen", "fore_upper"}},
         {"waist", "hips", "spine2", 0.3, 0.9, Choice::smallest, {"abdomen", "pelvis", "hind_upper"}}},
        {{"fore_lower", "fore_lower", "fore_ankle", 0.3, 0.8, Choice::smallest, {"fore_lower"}},
         {"hind_lower", "hind_lower", "hind_ankle", 0.3, 0.8, Choice::smallest, {"hind_lower"}}}};
    return animals;
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
    return (joint_place(skeleton, JointRole::hip, Side::left) + joint_place(skeleton, JointRole::hip, Side::right)) / 2;
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
    const Vector3<Scalar> left = (joint_place(skeleton, JointRole::shoulder, Side::left) -
                                  joint_place(skeleton, JointRole::shoulder, Side::right))
                                     .stableNormalized();
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

/// From the shoulder blades along both fore legs' bones to the toes, the mean of both.
template <typename Scalar>
Scalar withers_height(const KinematicSkeleton<Scalar>& skeleton) {
    Scalar sum = 0;
    for (const Side side : {Side::left, Side::right}) {
        Vector3<Scalar> before = joint_place(skeleton, JointRole::shoulder_girdle, side);
        for (const JointRole role : {JointRole::shoulder, JointRole::elbow, JointRole::wrist, JointRole::hand}) {
            const Vector3<Scalar> place = joint_place(skeleton, role, side);
            sum += (place - before).norm() / 2;
            before = place;
        }
        const std::string prefix(side_prefix(side));
        sum += (end_place(skeleton, prefix + "fore_toe", prefix + "fore_foot") - before).norm() / 2;
    }
    return sum;
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
    if (own_template(skeleton).plan == BodyKind::quadruped)
        return static_cast<double>(body.similarity.scale * detail::withers_height(inside));
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
        parts.parts != part_names(PartSet::bones, own_template(skeleton).plan))
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
    const bool is_human = own_template(skeleton).plan == BodyKind::human;
    const detail::Measured& measured = is_human ? detail::measured_of_people() : detail::measured_of_animals();
    for (const detail::NamedBone& bone : measured.trunk_bones)
        out.lengths.emplace_back(bone.name, between(bone.from, bone.to));
    out.lengths.emplace_back(measured.head.name, end_bone(measured.head.end, measured.head.joint));
    for (const detail::NamedBone& width : measured.trunk_widths)
        out.lengths.emplace_back(width.name, between(width.from, width.to));
    if (is_human) out.arm_span = between("left_shoulder", "right_shoulder");
    for (const std::string side : {"left_", "right_"}) {
        for (const detail::NamedBone& bone : measured.sided_bones)
            out.lengths.emplace_back(side + bone.name, between((bone.from_is_sided ? side : "") + bone.from,
                                                               (bone.to_is_sided ? side : "") + bone.to));
        for (const detail::NamedEnd& end : measured.sided_ends)
            out.lengths.emplace_back(side + end.name, end_bone(side + end.end, side + end.joint));
        if (is_human)
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
    for (const detail::GirthPlace& place : measured.trunk_girths) add_girth(place, "");
    for (const std::string side : {"left_", "right_"})
        for (const detail::GirthPlace& place : measured.sided_girths) add_girth(place, side);
    return out;
}

} // namespace skelgen::applications
