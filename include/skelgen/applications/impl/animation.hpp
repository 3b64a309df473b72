#pragma once

#include <skelgen/applications/animation.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include <skelgen/applications/lowest_place.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

/// The vertices that may touch the floor: of those that each joint moves most, the farthest in 26 directions, without
/// what is below the floor at rest.
template <typename Scalar>
std::vector<Eigen::Index> outermost_vertices(const Rig<Scalar>& rig) {
    std::vector<bool> is_used(static_cast<std::size_t>(rig.mesh.vertices.rows()), false);
    for (Eigen::Index i = 0; i < rig.mesh.faces.size(); ++i)
        is_used[static_cast<std::size_t>(rig.mesh.faces.data()[i])] = true;
    const Scalar floor = lowest_place<Scalar>(rig.mesh, Vector3<Scalar>::UnitY(), places_of(rig.joints));
    for (std::size_t v = 0; v < is_used.size(); ++v)
        if (rig.mesh.vertices(static_cast<Eigen::Index>(v), 1) < floor) is_used[v] = false;
    std::vector<Eigen::Index> out;
    std::vector<Eigen::Index> farthest(rig.joints.size());
    std::vector<Scalar> most(rig.joints.size());
    for (int direction = 0; direction < 27; ++direction) {
        const Eigen::Vector3i steps(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
        if (steps.isZero()) continue;
        const Vector3<Scalar> along = steps.template cast<Scalar>();
        std::fill(farthest.begin(), farthest.end(), -1);
        std::fill(most.begin(), most.end(), -std::numeric_limits<Scalar>::infinity());
        for (Eigen::Index v = 0; v < rig.mesh.vertices.rows(); ++v) {
            const auto joint = static_cast<std::size_t>(rig.skin.joints(v, 0));
            const Scalar how_far = along.dot(core::point(rig.mesh.vertices, v));
            if (!is_used[static_cast<std::size_t>(v)] || !(how_far > most[joint])) continue;
            most[joint] = how_far;
            farthest[joint] = v;
        }
        std::copy_if(farthest.begin(), farthest.end(), std::back_inserter(out), [](Eigen::Index v) { return v >= 0; });
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

/// The rows of a rig's mesh and skin that these vertices have.
template <typename Scalar>
std::pair<Points<Scalar>, Skin<Scalar>> rows_of(const Rig<Scalar>& rig, const std::vector<Eigen::Index>& vertices) {
    Points<Scalar> points = rig.mesh.vertices(vertices, Eigen::all);
    Skin<Scalar> skin;
    skin.joints = rig.skin.joints(vertices, Eigen::all);
    skin.weights = rig.skin.weights(vertices, Eigen::all);
    return {std::move(points), std::move(skin)};
}

} // namespace detail

template <typename Scalar>
std::vector<RigidMotion<Scalar>> motions(const std::vector<RigJoint<Scalar>>& joints, const RigPose<Scalar>& pose) {
    if (pose.axes.size() != joints.size())
        throw Error(ErrorCode::usage, "a pose must have as many axes as the rig has joints");
    std::vector<RigidMotion<Scalar>> out;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const RigJoint<Scalar>& joint = joints[j];
        Vector3<Scalar> place =
            joint.parent < 0 ? pose.root : out[static_cast<std::size_t>(joint.parent)](joint.position);
        if (joint.parent >= 0 && joint.role == JointRole::pelvis) place[1] += pose.lift;
        RigidMotion<Scalar> motion;
        motion.rotation = (pose.axes[j] * joint.axes.conjugate()).normalized();
        motion.translation = place - motion.rotation * joint.position;
        out.push_back(motion);
    }
    return out;
}

template <typename Scalar>
TriangleMesh<Scalar> posed(const Rig<Scalar>& rig, const RigPose<Scalar>& pose) {
    return {skinned(rig.mesh.vertices, rig.skin, motions(rig.joints, pose)), rig.mesh.faces};
}

template <typename Scalar>
Animation<Scalar> on_floor(const Rig<Scalar>& rig, Animation<Scalar> animation) {
    const auto [points, skin] = detail::rows_of(rig, detail::outermost_vertices(rig));
    if (points.rows() == 0 || animation.frames.empty()) return animation;
    std::vector<Scalar> lowest;
    for (const RigPose<Scalar>& frame : animation.frames)
        lowest.push_back(skinned(points, skin, motions(rig.joints, frame)).col(1).minCoeff());
    const auto floor = lowest.begin() + static_cast<std::ptrdiff_t>(lowest.size() / 20);
    std::nth_element(lowest.begin(), floor, lowest.end());
    for (RigPose<Scalar>& frame : animation.frames) frame.root[1] -= *floor;
    return animation;
}

} // namespace skelgen::applications
