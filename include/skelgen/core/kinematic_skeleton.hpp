#pragma once

#include <string>
#include <utility>
#include <vector>

#include <skelgen/core/mesh.hpp>

namespace skelgen {

/// One joint of a kinematic skeleton.
template <typename Scalar = double>
struct Joint {
    std::string name;
    int parent = -1; ///< index into the joints, always smaller than the joint's own; -1 for the root
    Vector3<Scalar> position = Vector3<Scalar>::Zero();
    Scalar radius = 0; ///< mean distance from the joint to the surface around it, same unit as the position
    double confidence =
        1; ///< 0 to 1: how well its bones agree with those of the other side and with people's proportions
    bool is_present = true; ///< false: its limb ends before it; `position` is then where that is, confidence 0
};

/// The person's own directions. (left, forward, up) is a LEFT-handed triple: left x forward = -up.
template <typename Scalar = double>
struct BodyFrame {
    Vector3<Scalar> origin = Vector3<Scalar>::Zero(); ///< the root joint
    Vector3<Scalar> left = Vector3<Scalar>::UnitX();
    Vector3<Scalar> forward = Vector3<Scalar>::UnitY();
    Vector3<Scalar> up = Vector3<Scalar>::UnitZ();
};

/// One witness to which side is the left one.
struct SideVote {
    std::string witness;
    double strength = 0; ///< added to the log odds; positive: for the sides as they are labelled
};

/// How far the result may be trusted.
struct Quality {
    double sides_confidence = 0;       ///< 0 (a coin toss) to 1 (every witness agrees)
    int matched_nodes = 0;             ///< nodes of the reduced template found in the curve skeleton
    std::vector<std::string> warnings; ///< one sentence each
    std::vector<SideVote> side_votes;  ///< what each kind of witness says: symmetry::SideWitness
};

/// The result: joints in template order (parents before children), end points on the surface, frame and quality.
template <typename Scalar = double>
struct KinematicSkeleton {
    std::string template_name;
    std::vector<Joint<Scalar>> joints;
    std::vector<std::pair<std::string, Vector3<Scalar>>> end_points; ///< head_top, left_fingertip, ... in fixed order
    BodyFrame<Scalar> frame;
    Quality quality;
};

/// Index of the joint of that name, or -1. O(joints).
template <typename Scalar>
[[nodiscard]] int find_joint(const KinematicSkeleton<Scalar>& skeleton, const std::string& name) {
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
        if (skeleton.joints[i].name == name) return static_cast<int>(i);
    return -1;
}

/// Mean confidence of the joints that are there: how likely they are right together. 0 where there are none. O(joints).
template <typename Scalar>
[[nodiscard]] double mean_confidence(const KinematicSkeleton<Scalar>& skeleton) {
    double sum = 0, count = 0;
    for (const Joint<Scalar>& joint : skeleton.joints) {
        if (!joint.is_present) continue;
        sum += joint.confidence;
        count += 1;
    }
    return count > 0 ? sum / count : 0;
}

} // namespace skelgen
