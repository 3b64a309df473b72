#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <skelgen/synth/hand_shape.hpp>
#include <skelgen/synth/pose.hpp>

#include "anatomy.hpp"
#include "kinematics.hpp"
#include "primitives.hpp"
#include "proportions.hpp"
#include "spine.hpp"

namespace skelgen::synth {

/// A part of the body that moves as one. The trunk bends with the spine, all others are rigid.
struct Part {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity(); ///< of its joint, see PosedSkeleton
    double side = 1;                                         ///< -1: modelled as a left part, mirrored
    bool limb = false;                                       ///< modelled with z down the limb instead of up
    double twist = 0;  ///< radians about z per metre: the forearm between elbow and wrist
    double length = 0; ///< where the twist ends
    std::vector<Blob> blobs;
    std::vector<std::vector<Blob>> clothes; ///< layers over the blobs, in the same coordinates
    std::vector<Capsule> hull;              ///< the part lies inside their union, world coordinates
    bool absent = false;
    std::vector<Vec3> probes; ///< points on or near its surface in world coordinates, to find parts that touch

    [[nodiscard]] Vec3 to_local(const Vec3& world) const;
    [[nodiscard]] Vec3 to_world(const Vec3& local) const;
    [[nodiscard]] double distance_bound(const Vec3& world) const; ///< at most the distance to the part
};

/// How a part blends with the one it hangs on: strongly around their joint, weakly elsewhere, so that an arm along the
/// body stays an arm. Lengths in metres.
struct Joining {
    Vec3 joint = Vec3::Zero();
    double range = 1; ///< from the joint to where the blend is weak
    double weak = 0;
    double strong = 0;
};

/// The parts in the order in which they are united.
enum class PartName {
    trunk,
    head,
    left_upper_arm,
    left_forearm,
    left_hand,
    right_upper_arm,
    right_forearm,
    right_hand,
    left_thigh,
    left_calf,
    left_foot,
    right_thigh,
    right_calf,
    right_foot
};
inline constexpr int part_count = 14;

/// The part `steps` further down the limb, 2 at most.
[[nodiscard]] constexpr PartName next(PartName part, int steps) {
    return static_cast<PartName>(static_cast<int>(part) + steps);
}

/// A posed human body as a field: negative inside, close to a distance near the surface. Neighbouring parts blend
/// around their joint, others meet sharply.
class ImplicitBody {
public:
    ImplicitBody(const Proportions& proportions, const BodyPose& pose, const std::array<HandShape, 2>& hands = {});

    [[nodiscard]] double operator()(const Vec3& p) const;

    /// Leaves out the limb from a shoulder, elbow, wrist, knee or ankle on; what is left ends in a round stump.
    /// \throws Error usage for other joints.
    void leave_out(BodyJoint joint);

    /// Puts a layer of blobs, in the part's coordinates, over a part; it reaches out `thickness` at most.
    void wear(PartName name, std::vector<Blob> layer, double thickness);

    /// Hangs a thing on the body that moves with none of its parts: blobs in a frame of their own.
    void carry(const Eigen::Isometry3d& frame, std::vector<Blob> blobs);

    /// Where a point of the rest pose's trunk is.
    [[nodiscard]] Vec3 trunk_to_world(const Vec3& rest) const { return spine_.to_world(rest); }

    /// The point on the surface of the trunk nearest to one close to it, in world coordinates.
    [[nodiscard]] Vec3 onto_trunk(Vec3 p) const;

    /// How fine the surface is around p: 1 on the trunk, smaller (the ratio of edge lengths) on hands, feet and face.
    [[nodiscard]] double grain(const Vec3& p) const;

    /// The smallest gap between parts that are no neighbours, negative where they sink into each other. An estimate
    /// from probes: good to a few millimetres.
    [[nodiscard]] double clearance() const;

    /// One part by itself: its own field near it, a distance that is too small elsewhere.
    [[nodiscard]] double part_alone(PartName name, const Vec3& p) const;

    /// A point in the coordinates that the part is modelled in: y from front to back.
    [[nodiscard]] Vec3 in_part(PartName name, const Vec3& p) const;

    /// A point inside the part, between its joints.
    [[nodiscard]] Vec3 part_middle(PartName name) const;

    /// The part lies within this ball around its middle.
    [[nodiscard]] Ball part_bound(PartName name) const;

    /// How far from a place what hangs on the body reaches at most.
    [[nodiscard]] double reach_of_carried(const Vec3& from) const;

    [[nodiscard]] const PosedSkeleton& skeleton() const { return skeleton_; }
    [[nodiscard]] const Part& part(PartName name) const { return parts_[static_cast<std::size_t>(name)]; }

    /// Positions of head_top, left_fingertip, right_fingertip, left_toe, right_toe near the surface, in that order.
    [[nodiscard]] const std::array<Vec3, 5>& extremities() const { return extremities_; }

    /// The digits of the left and of the right hand, whether these are there or not; what is fused, as the surface with
    /// all that is worn has it.
    [[nodiscard]] std::vector<DigitTruth> digits() const;

    /// What a hand holds, with the hand's part and in its coordinates.
    [[nodiscard]] const std::vector<std::pair<PartName, RoundCone>>& held() const { return held_; }

private:
    void build_arm(const Proportions& proportions, const BodyPose& pose, const HandShape& shape, PartName first,
                   BodyJoint shoulder, Vec3& fingertip);
    void build_leg(const Proportions& proportions, const BodyPose& pose, PartName first, BodyJoint hip, Vec3& toe);
    [[nodiscard]] double part_value(PartName name, const Vec3& p) const;
    /// The limb of three parts that begins with `first`; parts further away than `limit` left out.
    [[nodiscard]] double limb_value(PartName first, const Vec3& p, double limit) const;

    PosedSkeleton skeleton_;
    SpineBend spine_;
    double scale_;
    std::array<Part, part_count> parts_;
    std::array<Joining, part_count> joining_{};
    std::vector<Part> carried_;
    std::vector<Blob> mouth_; ///< what is cut out of head and neck, in the head's coordinates
    std::array<Vec3, 5> extremities_;
    std::vector<std::pair<PartName, HandDigit>> digits_; ///< with their part and in its coordinates
    std::vector<std::pair<PartName, RoundCone>> held_;
};

} // namespace skelgen::synth
