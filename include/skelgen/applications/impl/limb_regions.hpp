#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <skelgen/applications/impl/bones.hpp>
#include <skelgen/core/curve_graph.hpp>
#include <skelgen/core/geometry.hpp>
#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/surface/body.hpp>

namespace skelgen::applications {

/// Where a joint's bone is in an arm or a leg, by ways along the bones from the limb's end.
struct BoneOfLimb {
    core::Accumulator limb = 0;           ///< the way to the limb's first joint; 0 where the joint is of no arm or leg
    core::Accumulator begin = 0, end = 0; ///< the same for a hand and a foot: ways on these go around thumbs and heels
};

/// Where the limbs of a body are on its surface: arms, legs, and neck and head.
struct LimbRegions {
    std::vector<int> of_joint;  ///< per joint the limb that it moves; -1 for the trunk, and for a limb without length
    std::vector<int> of_vertex; ///< per vertex of the body the limb that it may belong to; -1 where no path leads
    std::vector<core::Accumulator> from_end = {}; ///< per vertex the way to it along the surface from that limb's end
    std::vector<BoneOfLimb> bones = {};           ///< per joint
};

namespace detail {

/// The joints of a limb, from its end to its first joint: an arm's or a leg's, or head and neck.
inline std::vector<int> joints_of_limb(const SkeletonTemplate& skeleton_template, int end) {
    std::vector<int> joints;
    const auto role = [&](int j) { return skeleton_template.joint(j).role; };
    const auto is_of_limb = [&](int j) {
        return part_of(role(j)) != BodyPart::trunk || role(j) == JointRole::head || role(j) == JointRole::neck;
    };
    for (int j = end; j >= 0 && is_of_limb(j); j = skeleton_template.joint(j).parent) joints.push_back(j);
    return joints;
}

} // namespace detail

/// The limb that each vertex may belong to: the one whose end is nearest along the surface, each in its own length from
/// the end to its first joint; a head, which may be as wide as it is high, in that over its surface. So hands that hold
/// each other, or lie on a thigh, are told apart, as they are far from each other along the surface; where regions meet
/// lies in the trunk. A limb that is cut ends where its last joint is. `skeleton` in the coordinates of the body. One
/// search along the surface per limb, O(n). \throws Error usage when the skeleton's joints are not the template's.
template <typename Scalar>
LimbRegions limb_regions(const Body<Scalar>& body, const KinematicSkeleton<Scalar>& skeleton,
                         const SkeletonTemplate& skeleton_template) {
    LimbRegions out;
    out.of_joint.assign(skeleton.joints.size(), -1);
    out.of_vertex.assign(static_cast<std::size_t>(body.mesh.vertices.rows()), -1);
    out.from_end.assign(out.of_vertex.size(), 0);
    out.bones.resize(skeleton.joints.size());
    std::vector<Scalar> least(out.of_vertex.size(), std::numeric_limits<Scalar>::infinity());
    for (std::size_t end = 0; end < skeleton.joints.size(); ++end) {
        if (!ends_limb(skeleton_template.joints[end].role)) continue;
        const std::vector<int> joints = detail::joints_of_limb(skeleton_template, static_cast<int>(end));
        const Vector3<Scalar> tip = bone_end(skeleton, skeleton_template, static_cast<int>(end));
        const bool is_limb = part_of(skeleton_template.joints[end].role) != BodyPart::trunk;
        Scalar length = 0;
        Vector3<Scalar> last = tip;
        for (const int j : joints) {
            const Vector3<Scalar> place = skeleton.joints[static_cast<std::size_t>(j)].position;
            const Scalar before = length;
            length += (place - last).norm();
            last = place;
            if (!is_limb) continue;
            BoneOfLimb& bone = out.bones[static_cast<std::size_t>(j)];
            bone.begin = static_cast<core::Accumulator>(length);
            bone.end = static_cast<core::Accumulator>(j == static_cast<int>(end) ? length : before);
        }
        for (const int j : joints)
            if (is_limb) out.bones[static_cast<std::size_t>(j)].limb = static_cast<core::Accumulator>(length);
        if (!(length > 0)) continue;
        for (const int j : joints) out.of_joint[static_cast<std::size_t>(j)] = static_cast<int>(end);
        const int source = body.tree.nearest_corner(body.mesh, tip);
        const std::vector<Scalar> distances = core::distances_from(body.graph, {source});
        if (skeleton_template.joints[end].role == JointRole::head) {
            const Scalar over_surface = distances[static_cast<std::size_t>(core::nearest_vertex(body.mesh, last))];
            if (std::isfinite(over_surface)) length = std::max(length, over_surface);
        }
        for (std::size_t v = 0; v < distances.size(); ++v) {
            if (!(distances[v] < least[v] * length)) continue;
            least[v] = distances[v] / length;
            out.of_vertex[v] = static_cast<int>(end);
            out.from_end[v] = static_cast<core::Accumulator>(distances[v]);
        }
    }
    return out;
}

} // namespace skelgen::applications
