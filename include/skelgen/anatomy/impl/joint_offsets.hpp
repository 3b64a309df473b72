#pragma once

#include <algorithm>
#include <utility>

#include <skelgen/core/kinematic_skeleton.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::anatomy {

namespace detail {

/// Calibrated, see apply_joint_offsets(); as parts of the thigh, the upper arm and the bone from chest to neck, and of
/// the way from the neck to between the shoulders, which are so far below it as a part of the trunk.
struct JointOffsets {
    double knee_forward = 0.034, knee_outward = 0.021, straight_knee_up = 0.0125, bent_knee_down = 0.04;
    double bent_elbow_down = 0.03;
    double shoulder_forward = 0.035, shoulder_outwards = 0.035;
    double neck_backward = 0.065;
    double neck_between_shoulders = 0.66, neck_up_with_shoulders = 0.15, shoulders_below_neck = 0.16;
};

/// Moves the joints of one skeleton.
template <typename Scalar>
class JointMover {
public:
    JointMover(KinematicSkeleton<Scalar> skeleton, const SkeletonTemplate& skeleton_template)
        : skeleton_(std::move(skeleton)), template_(skeleton_template) {}

    /// The front of a knee is where the foot points; the more it is bent, the less flesh there is to one side only, and
    /// the farther the fold of the skin lies towards the hip from the joint.
    void move_knee(Side side) {
        using enum JointRole;
        Vector3<Scalar>* const knee_at = find(knee, side);
        const Vector3<Scalar>*const hip_at = find(hip, side), *const ankle_at = find(ankle, side),
                                    *const foot_at = find(foot, side);
        if (!knee_at || !hip_at || !ankle_at || !foot_at) return;
        const Vector3<Scalar> thigh = (*hip_at - *knee_at).normalized(), calf = (*knee_at - *ankle_at).normalized();
        const Vector3<Scalar> up = (thigh + calf).normalized();
        const Vector3<Scalar> to_toes = *foot_at - *ankle_at;
        const Vector3<Scalar> forward = (to_toes - to_toes.dot(up) * up).normalized(), left = up.cross(forward);
        if (!forward.allFinite() || !left.allFinite()) return;
        const Scalar length = (*hip_at - *knee_at).norm(), straight = std::max(Scalar(0), thigh.dot(calf));
        const Scalar leftward = side == Side::left ? part(offsets_.knee_outward) : -part(offsets_.knee_outward);
        *knee_at +=
            length *
            (straight * (part(offsets_.knee_forward) * forward + leftward * left) +
             (straight * part(offsets_.straight_knee_up) - (1 - straight) * part(offsets_.bent_knee_down)) * up);
    }

    /// The more an elbow is bent, the farther its fold lies towards the shoulder from the joint.
    void move_elbow(Side side) {
        using enum JointRole;
        Vector3<Scalar>* const elbow_at = find(elbow, side);
        const Vector3<Scalar>*const shoulder_at = find(shoulder, side), *const wrist_at = find(wrist, side);
        if (!elbow_at || !shoulder_at || !wrist_at) return;
        const Vector3<Scalar> upper = (*shoulder_at - *elbow_at).normalized();
        const Vector3<Scalar> lower = (*elbow_at - *wrist_at).normalized(), up = (upper + lower).normalized();
        const Scalar length = (*shoulder_at - *elbow_at).norm(), straight = std::max(Scalar(0), upper.dot(lower));
        *elbow_at -= length * (1 - straight) * part(offsets_.bent_elbow_down) * up;
    }

    /// The back of a neck and the front of the shoulders, by where shoulders, trunk and neck face.
    void move_shoulder_girdle() {
        using enum JointRole;
        Vector3<Scalar>*const neck_at = find(neck), *const left_at = find(shoulder, Side::left),
                              *const right_at = find(shoulder, Side::right);
        const Vector3<Scalar>* const chest_at = find(chest);
        if (!neck_at || !chest_at || !left_at || !right_at) return;
        const Vector3<Scalar> up = *neck_at - *chest_at;
        const Vector3<Scalar> forward = (*left_at - *right_at).cross(up).normalized();
        if (!forward.allFinite()) return;
        *neck_at -= part(offsets_.neck_backward) * up.norm() * forward;
        move_shoulder(*left_at, find(elbow, Side::left), forward);
        move_shoulder(*right_at, find(elbow, Side::right), forward);
        const Vector3<Scalar>* const crotch_at = find(pelvis);
        if (crotch_at && !template_.is_adapted)
            move_neck(*neck_at, (*left_at + *right_at) / 2, (*neck_at - *crotch_at).norm(), up.normalized(), forward);
    }

    [[nodiscard]] KinematicSkeleton<Scalar> result() && { return std::move(skeleton_); }

private:
    static Scalar part(double offset) { return static_cast<Scalar>(offset); }

    /// The sections of a neck go with the head; its base goes with the shoulders.
    static void move_neck(Vector3<Scalar>& neck_at, const Vector3<Scalar>& between_shoulders, Scalar trunk,
                          const Vector3<Scalar>& up, const Vector3<Scalar>& forward) {
        const Vector3<Scalar> left = up.cross(forward), way = between_shoulders - neck_at;
        const Scalar higher = way.dot(up) + part(offsets_.shoulders_below_neck) * trunk;
        neck_at += part(offsets_.neck_between_shoulders) * way.dot(left) * left +
                   part(offsets_.neck_up_with_shoulders) * higher * up;
    }

    void move_shoulder(Vector3<Scalar>& shoulder_at, const Vector3<Scalar>* elbow_at, const Vector3<Scalar>& forward) {
        if (!elbow_at) return;
        const Vector3<Scalar> arm = *elbow_at - shoulder_at;
        shoulder_at += part(offsets_.shoulder_outwards) * arm + part(offsets_.shoulder_forward) * arm.norm() * forward;
    }

    /// None where the template or the body has no such joint.
    [[nodiscard]] Vector3<Scalar>* find(JointRole role, Side side = Side::none) {
        const int j = find_joint(template_, role, side);
        if (j < 0) return nullptr;
        Joint<Scalar>& joint = skeleton_.joints[static_cast<std::size_t>(j)];
        return joint.is_present ? &joint.position : nullptr;
    }

    static constexpr JointOffsets offsets_{};
    KinematicSkeleton<Scalar> skeleton_;
    const SkeletonTemplate& template_;
};

} // namespace detail

/// The skeleton with its joints moved from the middle of their sections to their bones, which lie off the middle where
/// flesh covers them unevenly: a knee to the front and the outside of it, and towards the ankle when it is bent, a
/// bent elbow towards the wrist, the shoulder outwards along its limb and to the front, the neck's base to the back,
/// and sideways and up with the shoulders. `skeleton` is in template order, with its sides told; joints that a template
/// leaves out move nothing. The offsets are calibrated: mean offsets from 50 registered bodies and from landmarks of 11
/// people, halfway between; how a neck goes with the shoulders, on either alike, as slopes. An adapted template's
/// neck does not: figures have their shoulders at any height. O(joints).
template <typename Scalar>
KinematicSkeleton<Scalar> apply_joint_offsets(KinematicSkeleton<Scalar> skeleton,
                                              const SkeletonTemplate& skeleton_template) {
    detail::JointMover<Scalar> joints(std::move(skeleton), skeleton_template);
    for (const Side side : {Side::left, Side::right}) {
        joints.move_knee(side);
        joints.move_elbow(side);
    }
    joints.move_shoulder_girdle();
    return std::move(joints).result();
}

} // namespace skelgen::anatomy
