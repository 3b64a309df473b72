#pragma once

#include <skelgen/applications/engine_bones.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <skelgen/applications/canonical_frame.hpp>
#include <skelgen/applications/lowest_place.hpp>
#include <skelgen/applications/skinning.hpp>
#include <skelgen/core/error.hpp>
#include <skelgen/core/geometry.hpp>

namespace skelgen::applications {
namespace detail {

/// 0 up to `from`, 1 beyond `to`, level at both.
template <typename Scalar>
Scalar ramp(Scalar x, Scalar from, Scalar to) {
    const Scalar t = std::clamp((x - from) / (to - from), Scalar(0), Scalar(1));
    return t * t * (3 - 2 * t);
}

template <typename Scalar>
int joint_named(const std::vector<RigJoint<Scalar>>& joints, std::string_view name) {
    const auto found =
        std::find_if(joints.begin(), joints.end(), [&](const auto& joint) { return joint.name == name; });
    return found == joints.end() ? -1 : static_cast<int>(found - joints.begin());
}

/// A bone that halves a twist: which joint carries it, whose joint is at the other end.
struct TwistBone {
    std::string_view name;
    JointRole carrier, next;
    bool is_at_end; ///< has the half towards the next joint, and takes half of that one's twist; else gives half back
};
inline constexpr std::array<TwistBone, 3> twist_bones{
    {{"upper_arm_twist", JointRole::shoulder, JointRole::elbow, false},
     {"forearm_twist", JointRole::elbow, JointRole::wrist, true},
     {"thigh_twist", JointRole::hip, JointRole::knee, false}}};

/// The template's joint of a role and side; those that were added have names of their own.
template <typename Scalar>
int joint_of(const std::vector<RigJoint<Scalar>>& joints, JointRole role, Side side) {
    const auto is_it = [&](const RigJoint<Scalar>& joint) { return joint.role == role && joint.side == side; };
    const auto found = std::find_if(joints.begin(), joints.end(), is_it);
    return found == joints.end() ? -1 : static_cast<int>(found - joints.begin());
}

/// A rig that is given joints one by one, each behind the joint that carries it.
template <typename Scalar>
class GrowingRig {
public:
    explicit GrowingRig(Rig<Scalar> rig)
        : rig_(std::move(rig)), weights_(Eigen::MatrixX<Scalar>::Zero(rig_.skin.joints.rows(),
                                                                      static_cast<Eigen::Index>(rig_.joints.size()))) {
        for (Eigen::Index v = 0; v < weights_.rows(); ++v)
            for (int k = 0; k < Skin<Scalar>::influences; ++k)
                weights_(v, rig_.skin.joints(v, k)) += rig_.skin.weights(v, k);
    }

    [[nodiscard]] const Rig<Scalar>& rig() const { return rig_; }
    [[nodiscard]] const RigJoint<Scalar>& joint(int j) const { return rig_.joints[static_cast<std::size_t>(j)]; }
    [[nodiscard]] Rig<Scalar> take() {
        rig_.skin = strongest_influences<Scalar>(weights_);
        return std::move(rig_);
    }

    /// Puts a joint in place `at`, behind its parent, and has it carry `carried`, given as they are numbered before. It
    /// was brought to rest by what brought joint `with` there.
    void insert(int at, RigJoint<Scalar> joint, const std::vector<int>& carried, int with) {
        std::vector<bool> is_carried(rig_.joints.size(), false);
        for (const int child : carried) is_carried[static_cast<std::size_t>(child)] = true;
        for (std::size_t j = 0; j < rig_.joints.size(); ++j) {
            int& parent = rig_.joints[j].parent;
            parent = is_carried[j] ? at : parent + (parent >= at ? 1 : 0);
        }
        rig_.joints.insert(rig_.joints.begin() + at, std::move(joint));
        if (!rig_.motions.empty() && static_cast<std::size_t>(at) <= rig_.motions.size()) {
            const RigidMotion<Scalar> motion = rig_.motions[static_cast<std::size_t>(with)];
            rig_.motions.insert(rig_.motions.begin() + at, motion);
        }
        Eigen::MatrixX<Scalar> wider = Eigen::MatrixX<Scalar>::Zero(weights_.rows(), weights_.cols() + 1);
        wider.leftCols(at) = weights_.leftCols(at);
        wider.rightCols(weights_.cols() - at) = weights_.rightCols(weights_.cols() - at);
        weights_ = std::move(wider);
    }

    /// Divides what follows joint `from` among it and others: `shares(place)` is how much of it each other has.
    template <typename Shares>
    void divide(int from, const std::vector<int>& others, const Shares& shares) {
        for (Eigen::Index v = 0; v < weights_.rows(); ++v) {
            const Scalar whole = weights_(v, from);
            if (!(whole > 0)) continue;
            const auto parts = shares(core::point(rig_.mesh.vertices, v));
            for (std::size_t i = 0; i < others.size(); ++i) {
                weights_(v, others[i]) += whole * parts[i];
                weights_(v, from) -= whole * parts[i];
            }
            weights_(v, from) = std::max(weights_(v, from), Scalar(0)); // but for rounding
        }
    }

private:
    Rig<Scalar> rig_;
    Eigen::MatrixX<Scalar> weights_; ///< of each vertex, per joint
};

/// A joint between two others, held as the first is.
template <typename Scalar>
RigJoint<Scalar> joint_like(const RigJoint<Scalar>& model, std::string name, int parent,
                            const Vector3<Scalar>& position, const Vector3<Scalar>& end) {
    RigJoint<Scalar> joint = model;
    joint.name = std::move(name);
    joint.parent = parent;
    joint.position = position;
    joint.end = end;
    return joint;
}

template <typename Scalar>
void add_trunk_bones(GrowingRig<Scalar>& growing) {
    // Anatomy: the inner end of the clavicle is 3 of 17 cm from the midline to the shoulder joint.
    constexpr Scalar inner_end = Scalar(0.18), middle_of_chest = Scalar(0.4);
    const auto& joints = growing.rig().joints;
    const int chest = joint_of(joints, JointRole::chest, Side::none),
              neck = joint_of(joints, JointRole::neck, Side::none);
    const std::array<int, 2> shoulders{joint_of(joints, JointRole::shoulder, Side::left),
                                       joint_of(joints, JointRole::shoulder, Side::right)};
    if (chest < 0 || neck < 0 || shoulders[0] < 0 || shoulders[1] < 0) return;
    const Vector3<Scalar> from = growing.joint(chest).position, top = growing.joint(neck).position;
    const std::array<Vector3<Scalar>, 2> balls{growing.joint(shoulders[0]).position,
                                               growing.joint(shoulders[1]).position};
    const Vector3<Scalar> between = (balls[0] + balls[1]) / 2;
    const RigJoint<Scalar> model = growing.joint(chest);
    const int upper = chest + 1;
    growing.insert(upper, joint_like<Scalar>(model, "upper_chest", chest, from + middle_of_chest * (top - from), top),
                   {neck, shoulders[0], shoulders[1]}, chest);
    std::array<Vector3<Scalar>, 2> inner;
    std::vector<int> added{upper};
    for (const std::size_t side : {0U, 1U}) {
        const int shoulder = joint_of(growing.rig().joints, JointRole::shoulder, side == 0 ? Side::left : Side::right);
        const Vector3<Scalar> ball = balls[side];
        inner[side] = between + inner_end * (ball - between);
        RigJoint<Scalar> clavicle =
            joint_like<Scalar>(model, side == 0 ? "left_clavicle" : "right_clavicle", upper, inner[side], ball);
        clavicle.side = side == 0 ? Side::left : Side::right;
        // As arms are, mirrored from side to side.
        clavicle.axes = axes_along<Scalar>(ball - inner[side], growing.joint(shoulder).axes * Vector3<Scalar>::UnitX());
        growing.insert(shoulder, std::move(clavicle), {shoulder}, chest);
        added.push_back(shoulder);
    }
    // The second clavicle may have gone before the first.
    for (const std::size_t side : {0U, 1U})
        added[side + 1] = joint_named(growing.rig().joints, side == 0 ? "left_clavicle" : "right_clavicle");
    const Vector3<Scalar> up = (top - from).normalized();
    const Scalar height = (top - from).norm();
    growing.divide(chest, added, [&](const Vector3<Scalar>& place) {
        std::array<Scalar, 3> shares{};
        Scalar left = 1;
        for (const std::size_t side : {0U, 1U}) {
            const Vector3<Scalar> bone = balls[side] - inner[side];
            const Scalar along = (place - inner[side]).dot(bone) / bone.squaredNorm();
            const Scalar below = (inner[side] - place).dot(up) / bone.norm();
            const Scalar outward = ramp<Scalar>(along, 0, 1), above = 1 - ramp<Scalar>(below, 0, Scalar(1.2));
            shares[side + 1] = outward * above * left;
            left -= shares[side + 1];
        }
        if (height > 0) shares[0] = left * ramp<Scalar>((place - from).dot(up) / height, 0, 2 * middle_of_chest);
        return shares;
    });
}

template <typename Scalar>
void add_root(GrowingRig<Scalar>& growing) {
    const auto& joints = growing.rig().joints;
    RigJoint<Scalar> root = joints.front();
    root.name = "root";
    root.parent = -1;
    root.end = root.position;
    root.position[1] = lowest_place<Scalar>(growing.rig().mesh, Vector3<Scalar>::UnitY(), places_of(joints));
    root.axes.setIdentity();
    growing.insert(0, std::move(root), {0}, 0);
}

template <typename Scalar>
void add_twist_bones(GrowingRig<Scalar>& growing) {
    for (const TwistBone& kind : twist_bones)
        for (const Side side : {Side::left, Side::right}) {
            const int carrier = joint_of(growing.rig().joints, kind.carrier, side);
            const int next = joint_of(growing.rig().joints, kind.next, side);
            if (carrier < 0 || next < 0) continue;
            const Vector3<Scalar> from = growing.joint(carrier).position, to = growing.joint(next).position;
            const Vector3<Scalar> bone = to - from;
            if (!(bone.squaredNorm() > 0)) continue;
            const Vector3<Scalar> middle = (from + to) / 2;
            growing.insert(carrier + 1,
                           joint_like<Scalar>(growing.joint(carrier), std::string(side_prefix(side)).append(kind.name),
                                              carrier, kind.is_at_end ? middle : from, kind.is_at_end ? to : middle),
                           {}, carrier);
            growing.divide(carrier, {carrier + 1}, [&](const Vector3<Scalar>& place) {
                const Scalar share =
                    ramp<Scalar>((place - from).dot(bone) / bone.squaredNorm(), Scalar(0.2), Scalar(0.8));
                return std::array<Scalar, 1>{kind.is_at_end ? share : 1 - share};
            });
        }
}

/// The part of a turn that is about an axis, halved.
template <typename Scalar>
Eigen::Quaternion<Scalar> half_twist(const Eigen::Quaternion<Scalar>& turn, const Vector3<Scalar>& axis) {
    const Scalar angle = 2 * std::atan2(turn.vec().dot(axis), turn.w());
    constexpr Scalar around = 2 * static_cast<Scalar>(3.14159265358979323846);
    return Eigen::Quaternion<Scalar>(Eigen::AngleAxis<Scalar>(std::remainder(angle, around) / 2, axis));
}

} // namespace detail

template <typename Scalar>
Rig<Scalar> with_engine_bones(Rig<Scalar> rig, const EngineBones& bones) {
    const bool has_root = detail::joint_named(rig.joints, "root") >= 0;
    const bool has_twist = detail::joint_named(rig.joints, "left_upper_arm_twist") >= 0;
    const bool is_whole = (!bones.engine || has_root) && (!bones.twist || has_twist);
    if (rig.joints.empty() || is_whole) return rig;
    detail::GrowingRig<Scalar> growing(std::move(rig));
    if (bones.twist && !has_twist) detail::add_twist_bones(growing);
    if (bones.engine && !has_root) {
        detail::add_trunk_bones(growing);
        detail::add_root(growing);
    }
    return growing.take();
}

template <typename Scalar>
Animation<Scalar> with_engine_bones(Animation<Scalar> animation, const Rig<Scalar>& plain, const Rig<Scalar>& rig) {
    std::vector<int> old; // per joint of the rig, -1 for those that were added
    for (const RigJoint<Scalar>& joint : rig.joints) old.push_back(detail::joint_named(plain.joints, joint.name));
    if (std::count_if(old.begin(), old.end(), [](int j) { return j >= 0; }) !=
        static_cast<std::ptrdiff_t>(plain.joints.size()))
        throw Error(ErrorCode::usage, "the rig has not all joints of the one that the animation is of");
    const int chest = detail::joint_of(plain.joints, JointRole::chest, Side::none);
    const bool has_root = old.front() < 0;
    for (RigPose<Scalar>& frame : animation.frames) {
        if (frame.axes.size() != plain.joints.size())
            throw Error(ErrorCode::usage, "a pose must have as many axes as the rig has joints");
        const auto turn_of = [&](int joint) { // from rest
            const auto j = static_cast<std::size_t>(joint);
            return Eigen::Quaternion<Scalar>(frame.axes[j] * plain.joints[j].axes.conjugate());
        };
        RigPose<Scalar> held;
        held.root = frame.root;
        for (std::size_t j = 0; j < rig.joints.size(); ++j) {
            const RigJoint<Scalar>& joint = rig.joints[j];
            const std::string_view name = split_side(joint.name).plain;
            const auto* const twist = std::find_if(detail::twist_bones.begin(), detail::twist_bones.end(),
                                                   [&](const detail::TwistBone& one) { return one.name == name; });
            if (old[j] >= 0) {
                held.axes.push_back(frame.axes[static_cast<std::size_t>(old[j])]);
            } else if (joint.parent < 0) {
                held.axes.push_back(joint.axes);
            } else if (twist != detail::twist_bones.end()) {
                const int carrier = detail::joint_of(plain.joints, twist->carrier, joint.side);
                const int other = twist->is_at_end ? detail::joint_of(plain.joints, twist->next, joint.side)
                                                   : plain.joints[static_cast<std::size_t>(carrier)].parent;
                // How the hand is turned from the forearm, or the trunk from the limb, as at rest they are not.
                const Eigen::Quaternion<Scalar> from = turn_of(carrier), to = turn_of(other);
                const Vector3<Scalar> axis = joint.axes * Vector3<Scalar>::UnitY();
                held.axes.push_back(
                    (from * detail::half_twist<Scalar>(from.conjugate() * to, axis) * joint.axes).normalized());
            } else {
                held.axes.push_back((turn_of(chest) * joint.axes).normalized());
            }
        }
        if (has_root) { // upright, below the hips; how high these are is their own
            const Vector3<Scalar> rest = rig.joints.front().position;
            held.root[1] = rest[1];
            held.lift = frame.root[1] - plain.joints.front().position[1];
        }
        frame = std::move(held);
    }
    return animation;
}

} // namespace skelgen::applications
